"""What a scene's bearings do in their steady state, without a run: rest, loads, stiffness, lift-off.

=============  =========================================================================
``impedance``  forces of a linearised bearing on its inner ring per motion of that ring
``rest``       the engine started at the operating point, and what is read from it
``member``     one bearing of a set by itself, its rings fixed
``axial``      lift-off, spacing that keeps the preload
``statics``    `statics`: what a scene's bearings carry under a load
``stiffness``  `stiffness`: K and C of the bearings, stiffness of their shaft
=============  =========================================================================

Shaft axes: X from the nose to the rear, Z up, origin at the nose. A bearing that carries force on the shaft
towards -X is mirrored, not turned: its own x' and tilts change sign; y, z, azimuths and spin stay.
"""
