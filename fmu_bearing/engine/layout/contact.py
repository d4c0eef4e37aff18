"""K: derivatives of a contact by motion: scratch of the Jacobian, in ``w`` from ``W.CONTACT`` on.

First what traction does, in rows of all balls; then, for four balls at a time, columns of six: change of the
force (N) and moment (N m) on the ball by a unit of one motion, in the contact's axes, later in the ball's.
"""

from fmu_bearing.engine.layout import q as Q
from fmu_bearing.engine.layout.factors import SIX
from fmu_bearing.engine.layout.sizes import FOUR, STRIDE, Places

# what traction depends on
_by = Places()
UT = _by()  # m/s: sliding along the track at the contact's middle,
UM = _by()  # and across
AN = _by()  # rad/s: spin,
AT = _by()  # turning about the track's direction,
AM = _by()  # and rolling
ENTRAIN = _by()  # m/s: entrainment speed
LOAD = _by()  # N
HALF = _by()  # logarithm of the semi-major axis
INPUTS = _by.next

FORCES = 5  # rows of traction in ``race``: FT, FM, MN, MT, MM
TRACTION_SIZE = FORCES * STRIDE  # change of those rows by one input

_at = Places()
TRACTION = _at(INPUTS * TRACTION_SIZE)
BEFORE = _at(FORCES * STRIDE)  # traction of the unmoved contact, while others are tried
# the ball's motion, in the order of its nine states
PLACE = _at(3 * SIX)
RATE = _at(3 * SIX)
SPIN = _at(3 * SIX)
ENTRAINED = _at(SIX)  # and the entrainment speed
COLUMNS = (_at.next - PLACE) // SIX
ARM = _at(3 * FOUR)  # m: entrainment speed by the ball's spin
REACTION = _at(SIX)  # forces and moments on the body: x, y, z, about its axis, about y, z
# of one body: sums of the reactions to its own motions, by coordinates, then by rates; four partial sums each
MOTIONS = 6
SUMS = _at(2 * MOTIONS * SIX)
PER_INERTIA = _at(Q.SIZE)  # of the bodies' coordinates
SIZE = _at.next
