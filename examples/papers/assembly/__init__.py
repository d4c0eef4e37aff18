"""Modes of a whole bearing at rest whose balls stick to the rings or slide on them.

==============  ======================================================================
``patch``       springs of a contact patch: stiffness, and where they act
``free``        all modes of a free ring up to a frequency
``basis``       motions of a ring, free or held, and what they do at a contact
``conditions``  contact conditions C1 to C4: matrices, modes, what moves
==============  ======================================================================

Data flow: scene -> two rings by Fourier modes, twelve rigid balls -> springs of the patches between them ->
natural frequencies and shapes. Nothing turns, nothing is damped, no friction law acts: this is the model of a
finite-element program with bonded or sliding contacts (Kuan, Chen, Shen and Chang 2026, section 4.3), not
that of a running bearing, which `fmu_bearing.modal` has.

Axes at a ball: x along the bearing's axis, r outwards, t along increasing azimuth; x, r, t are right-handed.
"""
