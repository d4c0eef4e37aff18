"""Measurements on a recording, and their tables, pictures and WAV files.

==================  ==========================================================================
``signals``         pressures in all and by component, their levels, spectra, third octaves
``measure``         spectra by component, circles, planes, power, run-ups
``tables``          such measurements as tables
``pictures``        such measurements as pictures
``audio``           pressures as WAV files in pascals
``at_frequency``    which component and which line make the noise at a frequency
``sound_analysis``  levels, spectra, third octaves and lines in one call, and their files
==================  ==========================================================================
"""
