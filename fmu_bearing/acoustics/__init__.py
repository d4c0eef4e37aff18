"""From motion to sound: transfer functions, filters for the engine, analysis of recordings.

==============  ==============================================================================
``radiation``   bodies that radiate, and the transfer functions of the radiation models
``registry``    which radiation models there are, and the paths each takes
``filters``     filters for the engine: decimator, fits, blocks, weighting, the packed sound block
``analysis``    spectra, lines, orders, directivity, power and audio of recordings
==============  ==============================================================================

Time factor e^{+j omega t}; transfer functions in Pa per m/s2; levels re 20 uPa.
"""
