"""Elastic rings, and the shaft of a set: flexural modes of a ring from its section, matrices of a shaft.

==============  ======================================================================
``section``     meridian section of a ring, groove included, and its mesh
``fourier``     the solid of revolution for one circumferential harmonic: matrices, modes
``modes``       the modes a scene asks for, as motion and sound need them; free modes
``shaft``       the shaft of a set of bearings: its matrices and how its planes move
==============  ======================================================================

Data flow: scene -> section -> mesh -> matrices (once per ring) -> modes of each order -> ``RingMode``.

Coordinates: x along the bearing's axis, r outwards, t along increasing angle theta from 12 o'clock. A mode of
order n has two amplitudes a, b (m)::

    u_x, u_r = psi_x, psi_r (a cos n theta + b sin n theta)
    u_t      = psi_t        (a sin n theta - b cos n theta)

Only rings that bend need scikit-fem (extra ``elastic``).
"""
