"""Studies of a scene: error against cost, sensitivity to assumed values and to a designer's choices.

================  =============================================================================
``reference``     reference trajectory from two integrators, to which other results are compared
``tradeoff``      fidelities, methods, steps, strips, terms against the reference
``chart``         error against speed, drawn
``sensitivity``   changes of the figures when an assumed value changes
``alternatives``  what a designer can choose otherwise in a scene
``change_levels`` levels before and after a change, with the same seeds
``changed``       what choices change: ranked, as table and in words
``changes``       `changes`: level, life and torque when a designer chooses otherwise
================  =============================================================================
"""
