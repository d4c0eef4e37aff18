"""Bodies that radiate: pressure at microphones per acceleration, against frequency.

==================  ==============================================================================
``frequencies``     where transfer functions are evaluated, and interpolation between
``sources``         single bodies: exact, compact, and the multi-source paper's as printed
``radiators``       what sounds, the air, and a path from one channel to microphones
``circle``          microphones on one circle, and the paths that radiation models share
``bem``             boundary elements on bodies of revolution
``effective``       effective volumes of rings and cylinders
``compact``         the radiation model ``compact``: dipoles and exact spheres
``table``           the radiation model ``table``: transfer functions that the user brings
``paper_scalars``   ``paper``: the multi-source paper's filters on magnitudes
``paper_vector``    ``paper_vector``: the same filters on vectors
``paper_contacts``  ``paper_contacts``: the sound-field paper's sources at the contact points
==================  ==============================================================================
"""
