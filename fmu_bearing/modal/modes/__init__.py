"""Natural motions at an operating point: frequency, damping, and what moves.

=================  ===========================================================================
``mode``           a natural motion, its remark, its row in a table
``energies``       kinetic energies of a bearing's parts, order, direction, modal assurance
``bodies``         what moves: parts of the bearings, of a set its shaft and housing too
``mode_shape``     how rings and balls of a bearing move in a mode
``shaft_line``     how the shaft of a set moves in a mode, and the picture of it
``mode_files``     their shapes as a universal file
``natural_modes``  `Modes`: all at one operating point, cautions, table
``solve``          eigenvalues of the equations as modes: ringing, or put apart
``points``         `modes`: of a scene, at an operating point given by inputs
``growth``         what grows by itself, with the cage as it runs
=================  ===========================================================================
"""
