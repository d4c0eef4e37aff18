"""Fidelity full: rings, cage and every ball with all their degrees of freedom.

===============  =============================================================================
``norms``        how large a change of the state is
``vectors``      sums of scaled vectors
``methods``      the Runge-Kutta methods as data
``flexible``     flexural modes in a Runge-Kutta step
``runge_kutta``  one step of such a method, implicit or explicit
``progress``     what a step does to the state: Jacobian, energy, acceptance
``settle``       flexible rings at the start
``start``        the state at initialisation
``control``      how large an error may be, and how long the next step is
``march``        from one communication point to the next
===============  =============================================================================
"""
