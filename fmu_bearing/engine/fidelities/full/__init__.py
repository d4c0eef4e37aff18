"""Fidelity full: rings, cage and every ball with all their degrees of freedom; shaft and housing of a set.

A single bearing goes the way of a set: it is one without coordinates beside its own.

===================  =========================================================================
``norms``            how large a change of the state is
``vectors``          sums of scaled vectors
``methods``          the Runge-Kutta methods as data
``flexible``         flexural modes in a Runge-Kutta step
``runge_kutta``      one bearing's part of a step of such a method, implicit or explicit
``control``          how large an error may be, and how long the next step is
``stages``           stages of a step, and where Newton's method begins
``step``             one step: the stages of every bearing and of the shaft together
``jacobians``        when Jacobians and factors are made again
``progress``         what a step does to the state: Jacobian, energy, acceptance
``settle``           flexible rings at the start
``start``            the state at initialisation
``march``            from one communication point to the next
``port_derivative``  derivatives of the force at a port
===================  =========================================================================
"""
