"""Quasi-static equilibrium: the first guess of the operating point (``steady``).

=================  ==========================================================================
``ball_balance``   one ball: contacts, rolling, gyroscopic friction, place
``stiffness``      contacts in series, stiffness matrix of the bearing
``quasistatic``    Jones-Harris equilibrium of the inner ring in five degrees of freedom
``held``           forces and stiffness of a bearing whose rings are held
``axial``          the same for axial load alone: one unknown
``mounted``        the equilibrium with the outer ring on its pedestal
``rigid_preload``  the inner ring's place under rigid preload, and the load it means
``place``          from an equilibrium to the state: rings, balls, cage
``spin_balance``   orbit and spin, where friction, drag and gyroscopic moments balance
=================  ==========================================================================
"""
