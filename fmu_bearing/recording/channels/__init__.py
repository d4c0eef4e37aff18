"""Recorded channels, and the sound they give.

=====================  ==========================================================================
``microphone_places``  microphones by name or by place
``channel_history``    pressures and levels at any microphone, from recorded channels
=====================  ==========================================================================
"""
