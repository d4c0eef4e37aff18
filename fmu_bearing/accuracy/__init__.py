"""What accuracy costs, and what rests on assumed values.

================  =============================================================================
``first_order``   fidelity ``full`` as x' = g(t, x), for general-purpose integrators
``reference``     the trajectory that other results are held against, by two integrators
``tradeoff``      fidelities, methods, steps, strips, terms against the reference
``chart``         error against speed, drawn
``sensitivity``   what rests on assumed values
================  =============================================================================
"""
