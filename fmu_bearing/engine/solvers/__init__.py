"""Solvers.

================  ==========================================================================
``quasistatic``   Jones-Harris equilibrium under axial load: where a run starts; stiffness
``spin_balance``  orbit and spin at the start, where friction, drag and gyroscopic moments balance
``jacobian``      blocks of the Jacobian by differences, all balls per perturbation
``block_arrow``   factors and solves the Newton system: small blocks per ball, one border
``esdirk``        ESDIRK4(3) with accelerations as unknowns; step control
================  ==========================================================================
"""
