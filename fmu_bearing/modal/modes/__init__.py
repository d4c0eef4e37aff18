"""Natural motions at an operating point: frequency, damping, and what moves.

=================  ===========================================================================
``energies``       what moves in a mode: energies, order round the bearing, direction
``mode_shape``     how rings and balls move in a mode
``natural_modes``  natural frequencies and damping of a bearing, with names
``set_modes``      those of a set, with the line of the shaft
``points``         `modes`: of a bearing or a set, at an operating point given by inputs
=================  ===========================================================================
"""
