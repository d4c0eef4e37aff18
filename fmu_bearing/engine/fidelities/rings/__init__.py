"""Fidelity rings: the rings' degrees of freedom, stepped in time; of a set, its coordinates.

=================  ==========================================================================
``predictor``      first guess of a step
``equations``      the equations of condensed bearings, on a pedestal or on shaft and housing
``rest``           where all rests, without unbalance
``frozen_points``  what the bearings hold between changes of the inputs
``growth``         the motion that grows most by itself
``correction``     the trial state of a step, and what its corrections leave
``march``          steps and their control
``start``          where rings and balls begin at rest
``restart``        from one communication point to the next; rest, where a step fails
=================  ==========================================================================
"""
