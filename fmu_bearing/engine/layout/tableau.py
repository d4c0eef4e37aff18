"""TAB: coefficients of one Runge-Kutta method, a block of ``SIZE`` numbers; unused places are zero."""

from fmu_bearing.engine.layout.sizes import STAGES, Places

_at = Places()
COUNT = _at()  # number of stages
GAMMA = _at()  # diagonal entry; zero makes the method explicit
ORDER = _at()  # of the error estimate
NODES = _at(STAGES)
ROW = STAGES - 1  # numbers of a row below the diagonal
A = _at(STAGES * ROW)  # the rows
B = _at(STAGES)  # weights
ERROR = _at(STAGES)  # differences to the weights of the embedded method
BEYOND = _at(STAGES)  # how far a stage lies beyond the one before, over how far that one beyond its own
CHANGE_FROM = _at()  # stage from which the accelerations' change to the end of the step is kept
SIZE = _at.next
