"""Solvers.

===================  ==========================================================================
``quasistatic``      Jones-Harris equilibrium under axial load: where a run starts; stiffness
``rigid_preload``    the inner ring's place under rigid preload, and the load it means
``spin_balance``     orbit and spin at the start, where friction, drag and gyroscopic moments balance
``jacobian``         blocks of the Jacobian by differences, all balls per perturbation
``block_arrow``      factors and solves the Newton system: small blocks per ball, one border
``spring_coupling``  springs between balls in that system: a small dense correction
``esdirk``           ESDIRK4(3) with accelerations as unknowns; step control
===================  ==========================================================================
"""
