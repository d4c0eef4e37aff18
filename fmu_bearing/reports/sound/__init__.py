"""Sections about sound.

``levels_and_spectra``    levels, spectra, third octaves, ranking, lines
``waterfall``             levels over frequency and time, or speed
``directivity_balloon``   level over direction
``playback``              sounds to play
"""
