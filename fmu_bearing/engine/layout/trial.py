"""T: work space of fidelities rings and response.

Its rows are the first ones of the full force evaluation, which is not in use meanwhile.
"""

from fmu_bearing.engine.layout import w as W
from fmu_bearing.engine.layout.condensed import COLUMN
from fmu_bearing.engine.layout.sizes import STRIDE, Places

FORCES = 5  # of a ball on one ring: x y z, moments y z

_at = Places()
COS = _at(STRIDE)  # of the balls' angles
SIN = _at(STRIDE)
X = _at(STRIDE)  # m: places of the balls
R = _at(STRIDE)
INNER = _at(STRIDE)  # m: race heights
OUTER = _at(STRIDE)
STEP = _at(STRIDE)  # m2: a ball's move in the last sweep, squared
MOVED = _at(STRIDE)
FORCE = _at(2 * FORCES * STRIDE)  # N, N m: on inner ring, then on outer ring
BEND = _at(2 * STRIDE)  # m/s2: second time derivative of the race heights, inner and outer
ROWS = _at.next

_at = Places(W.SCALARS + 16)
Q = _at(COLUMN)  # trial numbers of a step
D = _at(COLUMN)
A = _at(COLUMN)
V = _at(COLUMN)
SPARE = W.ACC  # for matrices and balls' derivatives
