"""Acoustics in the workshop: transfer functions, filters for the engine, analysis of recordings.

=============  ==============================================================================
``sources``    pressure per acceleration of single bodies: exact, compact, and the paper's as printed
``effective``  effective volumes of rings and cylinders
``transfer``   the rungs ``compact`` and ``paper``: from components to microphones, on plain numbers
``paper_vector``, ``contacts``, ``table``  three more rungs: printed filters on vectors, sources at the
               contact points, the user's transfer functions
``rungs``      which paths a rung leads from channels to microphones
``fir``        decimator, and filters fitted to transfer functions
``blocks``     direct form or convolution by blocks, whichever costs less
``pack``       lays everything flat for the engine
``weighting``  A-weighting, Fast and Slow, levels
``stream``     from a scene to the engine's block: `stream.sound_parameters`; how well filters follow
``spectrum``   spectra of recordings, kinematic frequencies
=============  ==============================================================================

Time factor e^{+j omega t}; transfer functions in Pa per m/s2; levels re 20 uPa.
"""
