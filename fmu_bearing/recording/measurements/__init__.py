"""Measurements on a recording, and their tables, pictures and WAV files.

=====================  ==========================================================================
``signals``            pressures in all and by component, their levels, spectra, third octaves
``kurtogram``          kurtosis of envelopes in bands: where strokes show best
``envelope``           envelope spectra of any signal, with the lines of the bearing
``envelope_lines``     where such a spectrum has the lines of a bearing
``envelope_words``     what such a spectrum says in a sentence
``measure``            spectra by component, circles, planes, power, run-ups
``tables``             such measurements as tables
``pictures``           such measurements as pictures
``envelope_files``     which signals such an analysis takes, and its files
``uff_files``          signals as universal files
``audio``              pressures as WAV files in pascals
``at_frequency``       which component and which line make the noise at a frequency
``sound_analysis``     levels, spectra, third octaves and lines in one call, and their files
=====================  ==========================================================================
"""
