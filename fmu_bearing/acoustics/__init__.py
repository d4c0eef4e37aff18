"""Acoustics in the workshop: transfer functions, filters for the engine, analysis of recordings.

===================  ==============================================================================
``sources``          pressure per acceleration of single bodies: exact, compact, and the paper's as printed
``effective``        effective volumes of rings and cylinders
``transfer``         the rungs ``compact`` and ``paper``: from components to microphones, on plain numbers
``fir``              decimator, and filters fitted to transfer functions
``weighting``        A-weighting, Fast and Slow, levels
``stream``           packs everything for the engine: `stream.sound_parameters`
``field``            pressure anywhere from recorded channels, in the frequency domain
``spectrum``         spectra of recordings, kinematic frequencies
``lines``            lines that kinematics expect, lines that stand out, what explains them
``third_octave``     band filters (IEC 61260-1) and levels
``order``            order spectra and maps, waterfalls, of run-ups
``directivity``      circles and planes of points, DA, DL, DV, attenuation with distance
``power``            sound power from pressures (ISO 3744) and from motion
``audio``            WAV files in pascals
``psychoacoustics``  loudness, sharpness, roughness (extra)
===================  ==============================================================================

Time factor e^{+j omega t}; transfer functions in Pa per m/s2; levels re 20 uPa.
"""
