"""The two cheaper levels of the dynamics; level `full` stands in ``march`` and ``start``.

==============  =============================================================================
``places``      what these levels keep in the state, from ``S_LEVEL`` on
``condensed``   balls in static equilibrium between the races, and what they put on the rings
``held``        cage speed, friction and heats, evaluated at the quasi-static point and held
``linearised``  derivatives of the rings' accelerations, and their static equilibrium
``publish``     from a level's own state to the one that outputs and sound read
``predictor``   first guess of a step of level `rings`
``rings``       level `rings`: the rings' 11 degrees of freedom, stepped in time
``response``    level `response`: the linear answer to every excitation, as a sum of lines
==============  =============================================================================

Both leave out the cage's motion, slip and the balls' own vibration. Friction torque and heats are those of
the quasi-static point; energy is therefore not balanced but by definition: work in equals the heats.
"""
