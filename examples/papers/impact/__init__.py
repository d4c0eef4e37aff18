"""Impact sound of balls that hit each other on one line.

================  ==========================================================================
``chain``         who hits whom, when and how hard: Hertz contacts of spheres on a line
``sphere_field``  sound of one free rigid sphere in time, exact
``multipoles``    spherical waves on one axis, scaled to stay of order one
``scattering``    spheres on one axis in each other's sound: multipoles in frequency, histories in time
``lamb``          the elastic sphere: natural frequencies, and what its surface does under a contact force
``row``           modes of balls in a row that touch, stuck together or sliding
``impact_sound``  pressure at microphones over time
================  ==========================================================================

The line is the x axis. Points are pairs (x, s), s the distance from the axis, both in m. Air does not act
back on the balls. Viscosity is left out, in the gaps too.

Source of the test these modules were made for: Kuan, Chen, Shen and Chang (2026), "Prediction and validation
of impact noise radiation from ball bearings under elastic contact", section 3.
"""
