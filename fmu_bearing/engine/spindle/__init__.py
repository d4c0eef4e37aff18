"""Fidelities of sets of bearings on one shaft: each by its own kernels, joined on the shaft.

A bearing of the set keeps its arrays and kernels. Rows of its rings that follow shaft or housing are
*driven*: their accelerations are those of the shaft. With the rest of the bearing condensed onto them, the
shaft's equations are few and dense; what they find goes back into each bearing (substructures; Craig and
Bampton 1968 for the shaft's own coordinates).

=============  ==========================================================================
``members``    arrays and numbers of one bearing of a set; its motion with the shaft
``shaft``      loads, springs, energy of shaft and housing
``energy``     stored energy of a set
``follow``     driven rows: places, rates, accelerations, and what holds them there
``coupling``   Newton's equations of all bearings and the shaft
``port``       a shaft that another model owns
``stages``     stages of a step, and where Newton's method begins
``step``       one Runge-Kutta step of a set
``inputs``     inputs of a set as conditions of its bearings; what grows with temperature
``rest``       where shaft, housing and outer rings rest: Newton's method in displacements
``steady``     that rest with the steady forces of the bearings
``start``      the state at initialisation
``sound``      sound samples of all bearings at the same instants, and levels of their sum
``march``      from one communication point to the next
``condensed``  fidelities rings and response: the equations of condensed bearings, shaft and housing
``held``       fidelities rings and response: what the bearings hold, as the set loads them
``rings``      fidelity rings: start, steps and their control
``restart``    fidelity rings: from one communication point to the next; rest, where a step fails
``lines``      fidelity response: what each bearing excites in the whole set
``response``   fidelity response: start, and the state at any time
``outputs``    from the state to the outputs
=============  ==========================================================================
"""
