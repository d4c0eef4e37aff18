"""Recorded channels, and the sound they give.

=====================  ==========================================================================
``microphone_places``  microphones by name or by place
``sources``            what radiates in a scene, bearing by bearing, with places in the axes of each
``turning``            how cage and balls turned in the run, and how the cage whirled
``accelerometers``     what accelerometers read, and their noise
``channel_history``    pressures and levels at any microphone, from recorded channels
``recorded_signals``   signals by name: pressures, accelerations of the rings, variables
=====================  ==========================================================================
"""
