"""Recordings of sound channels, and measurements on them.

==============  ==========================================================================
``places``      microphones by name or by place
``heard``       pressures and levels at any microphone, from recorded channels
``recording``   `Recording`: the same with files, also from the run of an FMU
``record``      `record`: a run of a scene that keeps the channels
``listener``    levels of many short runs through the same paths
``spread``      `spread`: range of levels over seeds and the assumed surfaces
``measure``     spectra by component, circles, planes, power, run-ups
``tables``      such measurements as tables
``pictures``    such measurements as pictures
``finished``    what a comparison reads from a finished run
``compare``     `compare`: two scenes, recordings or runs side by side
``audio``       pressures as WAV files in pascals
``listen``      levels, spectra, third octaves and lines in one call, and their files
==============  ==========================================================================
"""
