"""FL: flexural modes of the rings in ``w``, from ``W.FLEX`` on, and what ``s`` keeps of them.

In ``s``, behind the sound's part (see flexure_state in mechanics/flexure): places, velocities and
accelerations of the coordinates, then what Newton's method keeps of the contacts: per ring the balls' answer
to the groove's motion (6 x 3 rows) and the groove's to the balls' (3 x 6), and four numbers per mode.
"""

from fmu_bearing.engine.layout.sizes import MAX_MODES, STAGES, STRIDE, Places

COORDINATES = 2 * MAX_MODES  # two per mode, cosine and sine
GROOVE = 3  # directions of the groove: axial, radial, circumferential
ANSWERS = 6 * GROOVE  # rows of the balls' answer to the groove's motion
FACTOR_ROWS = 2 * ANSWERS  # and of the groove's to the balls'
PER_INVERSE = 4  # numbers of the inverse per mode: own and partner's, real and imaginary

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
    return 0 if modes == 0 else 6 * modes + 2 * FACTOR_ROWS * STRIDE + PER_INVERSE * modes
