"""What the papers print: their radiation models, and impact sound.

============  ==============================================================================
``scalars``   ``paper``: the multi-source paper's filters on magnitudes
``vector``    ``paper_vector``: the same filters on vectors
``contacts``  ``paper_contacts``: the sound-field paper's sources at the contact points
``impact``    balls that hit each other on one line
============  ==============================================================================
"""
