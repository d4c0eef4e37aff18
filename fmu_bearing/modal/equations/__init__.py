"""Fidelity `full` linearised about a steady state: x' = A x, of a single bearing and of a set.

===============  ===========================================================================
``coordinates``  what the numbers of a linearised bearing are
``plain``        the engine's equations ball by ball, and their derivatives
``bearing``      one bearing about its state, in fixed axes of its own
``shaft``        matrices of shaft, housing and sliding rings; a single bearing has none
``linearised``   the whole: bearings, tied by shaft and housing where there are some
``quick``        the linear operator of fidelities rings and response, from the engine
``beside_full``  a short run of rings or response beside full, and how far balls swing in their pockets
``cage_sound``   by how much levels of full fall without their cage's own sound
``remarks``      remarks on the steady state: that none was found, a soft pedestal
===============  ===========================================================================
"""
