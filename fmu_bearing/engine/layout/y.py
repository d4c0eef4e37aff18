"""Y: positions and velocities of the mechanics, at the head of ``s`` and at each stage of a step.

Nine rows per ball in the axes that orbit with it, then the bodies' coordinates and their rates.
"""

from fmu_bearing.engine.layout import q as Q
from fmu_bearing.engine.layout.sizes import STRIDE, Places

_at = Places()
X = _at(STRIDE)  # m
R = _at(STRIDE)  # m, from the pitch radius
TH = _at(STRIDE)  # rad: angle from 12 o'clock
VX = _at(STRIDE)  # m/s
VR = _at(STRIDE)  # m/s
OM = _at(STRIDE)  # rad/s: orbit
WX = _at(STRIDE)  # rad/s: absolute spin about x, r, theta
WR = _at(STRIDE)
WT = _at(STRIDE)
Q0 = _at(Q.SIZE)  # m, rad: the bodies' coordinates, see q
V0 = _at(Q.SIZE)  # m/s, rad/s: their rates
SIZE = _at.next

PLACES = VX - X  # numbers of the balls that have both place and rate
RATES = Q0 - VX  # numbers of the balls that have accelerations
ROWS = 9
