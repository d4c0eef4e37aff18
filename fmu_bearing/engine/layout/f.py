"""F: the right-hand side at one state. Accelerations have the order of the rates in ``y``."""

from fmu_bearing.engine.layout import q as Q
from fmu_bearing.engine.layout.sizes import STRIDE, Places

_at = Places()
X = _at(STRIDE)  # m/s2: the balls' accelerations in their orbiting axes
R = _at(STRIDE)  # m/s2
TH = _at(STRIDE)  # rad/s2
WX = _at(STRIDE)  # rad/s2: of the spin
WR = _at(STRIDE)
WT = _at(STRIDE)
BODY = _at(Q.SIZE)  # m/s2, rad/s2: of the bodies' coordinates
WORK = _at()  # W: power in
HEAT = _at(3)  # W: dissipated, given to inner ring, outer ring, oil
TORQUE = _at()  # N m: taken from the shaft
SIZE = _at.next

POWERS = TORQUE - WORK  # work and heats, in the order of the sums from S.WORK on
HEAT_OUTER = HEAT + 1
HEAT_OIL = HEAT + 2
