"""Quasi-static balls: what they put on rings that are held. Where rings rest: ``spindle.rest``.

=================  ==========================================================================
``ball_balance``   one ball: contacts, rolling, gyroscopic friction, place
``stiffness``      contacts in series, stiffness matrix of the bearing
``quasistatic``    forces and stiffness at a prescribed displacement of the rings, after Jones and Harris
``axial``          equilibrium under axial load alone: one unknown
``place``          from quasi-static balls to the state: balls, cage, a bearing that is shifted
``rigid_preload``  the inner ring's place under a preload, how it moves to another
``spin_balance``   orbit and spin, where friction, drag and gyroscopic moments balance
=================  ==========================================================================
"""
