"""Fidelity `full` linearised about a steady state: x' = A x, of a bearing and of a set.

==================  ===========================================================================
``coordinates``     what the numbers of a linearised bearing are
``plain``           the engine's equations ball by ball, and their derivatives
``equilibrium``     the steady state of balls and rings without cage
``linearised``      fidelity `full` about its steady state, in fixed axes
``set_linearised``  a set on its shaft: bearings by themselves, tied by shaft and housing
``remarks``         what is to be said about the steady state
==================  ===========================================================================
"""
