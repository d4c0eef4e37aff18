"""What a step is held against: explicit integration, and the equations for general-purpose integrators.

================  =============================================================================
``runge_kutta``   classical Runge-Kutta of fourth order over the right-hand side alone
``first_order``   the equations as x' = g(t, x) with their Jacobian
``playback``      motion samples played to the sound block
================  =============================================================================
"""
