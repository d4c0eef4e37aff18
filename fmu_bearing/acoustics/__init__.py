"""Acoustics in the workshop: transfer functions, filters for the engine, analysis of recordings.

===================  ==============================================================================
``sources``          pressure per acceleration of single bodies: exact, compact, and the paper's as printed
``effective``        effective volumes of rings and cylinders
``radiators``        what sounds, the air, and a path from one channel to microphones
``rungs``            the ladder: which paths each rung takes
``transfer``         the rungs ``compact`` and ``paper``: from components to microphones, on plain numbers
``paper_vector``     the rung of that name; ``contacts``: the rung ``paper_contacts``; ``table``: a user's
``bem``              the rung ``bem``: boundary elements on bodies of revolution
``fir``              decimator, and filters fitted to transfer functions
``weighting``        A-weighting, Fast and Slow, levels
``stream``           designs the filters of a scene: `stream.sound_parameters`; ``pack``, ``blocks``: layout
``field``            pressure anywhere from recorded channels, in the frequency domain
``spectrum``         spectra of recordings, kinematic frequencies
``lines``            lines that kinematics expect, lines that stand out, what explains them
``third_octave``     band filters (IEC 61260-1) and levels
``order``            order spectra and maps, waterfalls, of run-ups
``directivity``      circles and planes of points, DA, DL, DV, attenuation with distance
``power``            sound power from pressures (ISO 3744) and from motion
``audio``            WAV files in pascals
``psychoacoustics``  loudness, sharpness, roughness (extra)
``impact``           balls that hit each other on one line: Hertz chain, multiple scattering, elastic spheres
===================  ==============================================================================

Time factor e^{+j omega t}; transfer functions in Pa per m/s2; levels re 20 uPa.
"""
