"""Studies of accuracy: error against cost, and sensitivity to assumed values.

================  =============================================================================
``first_order``   fidelity ``full`` as x' = g(t, x), for other integrators
``reference``     reference trajectory from two integrators, to which other results are compared
``tradeoff``      fidelities, methods, steps, strips, terms against the reference
``chart``         error against speed, drawn
``sensitivity``   changes of the figures when an assumed value changes
================  =============================================================================
"""
