"""Solvers.

===================  ==========================================================================
``quasistatic``      Jones-Harris equilibrium of the inner ring in five degrees of freedom
``axial``            the same for axial load alone: one unknown
``ball_balance``     its balls: contacts, rolling, gyroscopic friction, place of one ball
``stiffness``        contacts in series, stiffness matrix of the bearing
``mounted``          the equilibrium with the outer ring on its pedestal: where a run starts
``rigid_preload``    the inner ring's place under rigid preload, and the load it means
``spin_balance``     orbit and spin at the start, where friction, drag and gyroscopic moments balance
``jacobian``         blocks of the Jacobian by differences, all balls per perturbation
``block_arrow``      factors and solves the Newton system: small blocks per ball, one border
``spring_coupling``  springs between balls in that system: a small dense correction
``elimination``      small linear systems
``tableaux``         coefficients of the Runge-Kutta methods
``runge_kutta``      one step of such a method with accelerations as unknowns
``newmark``          one evaluation per step, for a bearing that has settled
===================  ==========================================================================
"""
