"""Recordings of sound channels, and measurements on them.

================  ==========================================================================
``channels``      recorded channels, and the pressures and levels they give at any microphone
``measurements``  spectra, circles, power, lines of a recording; tables, pictures, WAV files
``recording``     `Recording`: channels with files, also from the run of an FMU
``record``        `record`: a run of a scene that keeps the channels
``studies``       what several runs say: range of levels, two runs side by side
================  ==========================================================================
"""
