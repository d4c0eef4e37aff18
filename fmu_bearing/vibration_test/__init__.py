"""The vibration test of a bearing by itself, as makers run it: radial velocity of the outer ring in bands.

============  ===========================================================================
``rig``       `rig`: the scene of the test, from the scene of a bearing
``reading``   `reading`: what the sensor of the tester reads, from one run
============  ===========================================================================
"""
