"""How the state is stepped from one communication point to the next: one room per fidelity.

==============  ====================================================================================
``full``        all bodies with all their degrees of freedom
``condensed``   what the two cheaper fidelities share: balls in static equilibrium between the races
``rings``       the rings' 11 degrees of freedom, stepped in time
``response``    the linear response to every excitation, as a sum of lines
``state_copy``  what of a state later steps need, for copies to go back to
``steps``       below them all: allowed error, division of a communication step, clock, mean heats
==============  ====================================================================================
"""
