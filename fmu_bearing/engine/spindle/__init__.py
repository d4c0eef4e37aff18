"""Bearings together: arrays of each, shaft and housing, their joint equations, rest, sound and outputs.

A bearing of a set keeps its arrays and kernels. Rows of its rings that follow shaft or housing are *driven*
(constrained degrees of freedom): their accelerations are the shaft's. With the rest of the bearing condensed
onto them, the shaft's equations are few and dense; what they find goes back into each bearing (substructures;
Craig and Bampton 1968 for the shaft's own coordinates). A single bearing is a set of one without shaft,
coordinates and driven rows.

=================  ===========================================================================================
``members``        arrays and numbers of one bearing; its motion with the shaft; arguments of all kernels here
``shaft``          loads, springs, energy of shaft and housing
``port``           a shaft that another model owns
``inputs``         inputs as conditions of the bearings; what grows with temperature
``follow``         driven rows: places, rates, accelerations, and what holds them there
``elimination``    one bearing in Newton's equations: condensed onto its driven rows, solved with these given
``coupling``       Newton's equations of all bearings and the shaft
``rest_unknowns``  what moves there: the unknowns of a rest, and the rings by them
``rest``           where shaft, housing and outer rings rest: Newton's method in displacements
``steady``         that rest with the steady forces of the bearings
``sound_sum``      sound samples of all bearings at the same instants, and levels of their sum
``outputs``        from the state to the outputs
=================  ===========================================================================================
"""
