"""Analysis of recordings.

===================  ==========================================================================
``field``            pressure anywhere from recorded channels, in the frequency domain
``spectrum``         spectra, kinematic frequencies
``lines``            lines that kinematics expect, lines that exceed their surroundings, what explains them
``origins``          orders of lines, and the surface and the bearing that each comes from
``third_octave``     third-octave levels (IEC 61260-1)
``order``            order spectra and maps, waterfalls, of run-ups
``directivity``      circles and planes of points, DA, DL, DV, attenuation with distance
``power``            sound power from pressures (ISO 3744) and from motion
``audio``            WAV files in pascals
``psychoacoustics``  loudness, sharpness, roughness (extra)
===================  ==========================================================================
"""
