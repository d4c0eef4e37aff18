"""A recording: a run with the engine's sound channels kept, and what is measured on it.

==============  ==========================================================================
``heard``       pressures and levels at any microphone
``recording``   `Recording`: what such a run or an FMU's leaves behind, in files
``record``      `record`: a run with the channels kept
``measure``     spectra by component, circles, planes, power, run-ups
``tables``      such measurements as tables
``pictures``    such measurements as pictures
``listen``      all that is usually asked of a recording, measured at once
==============  ==========================================================================
"""
