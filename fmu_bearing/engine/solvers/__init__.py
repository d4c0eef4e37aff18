"""Solvers.

================  ==========================================================================
``quasistatic``   Jones-Harris equilibrium of the inner ring in five degrees of freedom
``axial``         the same for axial load alone: one unknown
``ball_balance``  its balls: contacts, rolling, gyroscopic friction, place of one ball
``stiffness``     contacts in series, stiffness matrix of the bearing
``mounted``       the equilibrium with the outer ring on its pedestal: where a run starts
``spin_balance``  orbit and spin at the start, where friction, drag and gyroscopic moments balance
``jacobian``      blocks of the Jacobian by differences, all balls per perturbation
``block_arrow``   factors and solves the Newton system: small blocks per ball, one border
``elimination``   small linear systems
``esdirk``        ESDIRK4(3) with accelerations as unknowns; step control
================  ==========================================================================
"""
