"""Small motions of a mounted bearing: natural modes, Campbell diagram, stiffness and damping.

=====================  ===========================================================================
``conditions``         operating points: inputs of the model by name
``coordinates``        what the numbers of a linearised bearing are
``plain``              the engine's equations ball by ball, and their derivatives
``equilibrium``        the steady state of balls and rings without cage
``linearised``         fidelity `full` about its steady state, in fixed axes
``remarks``            what is to be said about the state it stands in
``shapes``             what moves in a mode: energies, order round the bearing, direction
``motion``             how rings and balls move in a mode
``modes``              natural frequencies and damping, with names
``set_linearised``     a set on its shaft: bearings by themselves, tied by shaft and housing
``set_modes``          its natural motions, with the line of the shaft
``points``             `modes`: of a bearing or a set, at an operating point
``lines``              excitation lines and the waves that each can move
``weak``               weakly damped modes, for which levels of rings and response are in doubt
``diagram``            modes over speed, and where they meet lines
``drawing``            what a Campbell diagram shows: colours, widths, dashes, which lines
``picture``            it as a Matplotlib figure
``campbell``           `campbell`: modes over speed, followed by shape
``impedance``          forces on the inner ring per motion, balls eliminated at the frequency
``planes``             two planes whose radial springs stand for tilt and coupling
``stiffness_table``    K and C over speed, preload and frequency, and what follows from them
``stiffness_limits``   what limits them, in sentences
``stiffness_files``    their CSV and netCDF
``ross``               bearing elements for the rotor program ROSS
``stiffness_picture``  K and C over speed
``stiffness``          `stiffness`: the table of a scene
=====================  ====================================================================
"""
