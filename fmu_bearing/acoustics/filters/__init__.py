"""Filters for the engine, from transfer functions to the packed sound block.

=============  ==============================================================================
``fir``        the decimator, and filters fitted to transfer functions
``designed``   filters of fixed rates as numbers
``weighting``  A-weighting, third octaves, levels
``blocks``     direct form or convolution by blocks, whichever costs less
``shares``     what the work on a block costs, and which samples do it
``pack``       lays everything flat for the engine
``design``     from a scene to the engine's block; how well filters follow
``bearings``   what the bearings of a set radiate
``sensing``    accelerometers: what one reads of the motion, and the block of those of a bearing
=============  ==============================================================================
"""
