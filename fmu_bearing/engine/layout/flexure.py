"""FL: flexural modes of the rings in ``w``, from ``W.FLEX`` on, and what ``s`` keeps of them.

In ``s``, behind the sound's part (see flexure_state in mechanics/flexure): places, velocities and
accelerations of the coordinates, then what Newton's method keeps of the contacts: per ring the balls' answer
to the groove's motion (6 x 3 rows) and the groove's to the balls' (3 x 6), and four numbers per mode.
"""

from fmu_bearing.engine.layout.jacobian import BALL
from fmu_bearing.engine.layout.sizes import MAX_MODES, STAGES, STRIDE, Places

COORDINATES = 2 * MAX_MODES  # two per mode, cosine and sine
GROOVE = 3  # directions of the groove: axial, radial, circumferential
# rows of the balls' answer to the groove's motion, entry (i, k) at (i * GROOVE + k) * STRIDE, then of the
# groove's to the balls', entry (i, k) at (ANSWERS + i * BALL + k) * STRIDE
COUPLINGS = BALL * GROOVE
FACTOR_ROWS = 2 * COUPLINGS
INERTIA = GROOVE * GROOVE  # numbers of a groove's inertia against the motion of its own or the other ring's
INERTIAS = 4 * INERTIA  # inner on inner, inner on outer, outer on inner, outer on outer ring
PER_MODE = 6  # numbers of a mode's state: places, velocities, accelerations of two coordinates
# numbers of the inverse per mode: real and imaginary part each
_inverse = Places()
OWN = _inverse(2)  # of the mode's own residual,
PARTNER = _inverse(2)  # and of its partner's
PER_INVERSE = _inverse.next

# rows under each ball
_at = Places()
X = _at(STRIDE)  # m, later N: displacement, later force on the ring: axial,
R = _at(STRIDE)  # radial,
GX = _at(STRIDE)  # its change with the angle, later circumferential force
GR = _at(STRIDE)  # and moment; slope and ratio of radii
VX = _at(STRIDE)  # m/s: velocity of the material
VR = _at(STRIDE)
VT = _at(STRIDE)
TURN = _at(STRIDE)  # rad/s: angular velocity about the circumferential direction
COS = _at(STRIDE)  # of the first order,
SIN = _at(STRIDE)
MODES = _at(COORDINATES * STRIDE)  # then of each mode's
# flat, over the coordinates
Q = _at(COORDINATES)  # m
V = _at(COORDINATES)  # m/s
FORCE = _at(COORDINATES)  # m/s2
A = _at(COORDINATES)  # m/s2
D = _at(COORDINATES)  # Newton increment
ACC = _at(STAGES * COORDINATES)  # accelerations of all stages
VEL = _at(STAGES * COORDINATES)  # and velocities
SIZE = _at.next


def state_size(modes):
    """Numbers that ``modes`` flexural modes take in ``s``."""
    return 0 if modes == 0 else PER_MODE * modes + 2 * FACTOR_ROWS * STRIDE + PER_INVERSE * modes
