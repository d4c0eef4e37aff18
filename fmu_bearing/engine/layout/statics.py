"""ST: work space of the quasi-static kernels, in ``w`` from ``W.STATICS`` on (``v`` in kernels).

First rows of the balls, then vectors and matrices over the freedoms of the inner ring against the outer.
Those freedoms are x y z by bz (``Q.X`` to ``Q.INNER_BZ``) in inertial axes, and x r theta and the tilts about
r and theta in a ball's axes.
"""

from fmu_bearing.engine.layout import y as Y
from fmu_bearing.engine.layout.equilibrium import FREEDOMS
from fmu_bearing.engine.layout.sizes import STRIDE, Places

# freedoms in a ball's axes
_freedom = Places()
ALONG = _freedom()  # m: x
OUTWARDS = _freedom()  # m: r
AROUND = _freedom()  # m: theta
TILT_R = _freedom()  # rad
TILT_T = _freedom()  # rad

# share of one ball in the stiffness, and how its place follows the ring; FREEDOMS columns each
_share = Places()
FX = _share(FREEDOMS)  # N per m or rad: force on the inner ring
FR = _share(FREEDOMS)
FT = _share(FREEDOMS)
MR = _share(FREEDOMS)  # N m per m or rad: moment on it
MT = _share(FREEDOMS)
STIFFNESS_SIZE = _share.next
DX = _share(FREEDOMS)  # m per m or rad: place of the ball
DR = _share(FREEDOMS)
SHARE_SIZE = _share.next

ROW = FREEDOMS + 1  # numbers of an equation: its matrix row, then its right-hand side
SYSTEM_SIZE = FREEDOMS * ROW

# orbit and spin of one ball (statics/spin_balance.py)
SPIN_RATES = (Y.Q0 - Y.OM) // STRIDE  # orbit, then spin about x, r, theta
SPIN_ROW = SPIN_RATES + 1
SPIN_SYSTEM_SIZE = SPIN_RATES * SPIN_ROW

# equilibrium of equal balls under axial load alone (statics/axial.py)
_axial = Places()
AXIAL_SHIFT = _axial()  # m: inner ring against the outer
AXIAL_X = _axial()  # m: a ball's place
AXIAL_R = _axial()
AXIAL_OM = _axial()  # rad/s: its orbit speed
AXIAL_WX = _axial()  # rad/s: and spin
AXIAL_WR = _axial()
AXIAL_RESIDUAL = _axial()  # N, of a ball
AXIAL_SIZE = _axial.next

_at = Places()
COS = _at(STRIDE)  # of the balls' angles
SIN = _at(STRIDE)
DEEPER = _at(2 * STRIDE)  # m: by how much oversize and waviness deepen the approach, inner and outer
X = _at(STRIDE)  # m: place of the balls
R = _at(STRIDE)
TRIAL_X = _at(STRIDE)  # m: the same at the trial place of the ring
TRIAL_R = _at(STRIDE)
FOLLOW_X = _at(FREEDOMS * STRIDE)  # m per m or rad: how they follow each freedom, in the ball's axes
FOLLOW_R = _at(FREEDOMS * STRIDE)
RING = _at(FREEDOMS)  # m, rad: inner ring against the outer
TRIAL_RING = _at(FREEDOMS)
FORCE = _at(FREEDOMS)  # N: forces on the inner ring, moments over the pitch radius
TRIAL_FORCE = _at(FREEDOMS)
STEP = _at(FREEDOMS)  # m, rad: step of the ring
SHARE = _at(SHARE_SIZE)  # of one ball
SYSTEM = _at(SYSTEM_SIZE)  # equations for the step
SUPPORT = _at(SYSTEM_SIZE)  # equations for how the ring follows a tilt of the outer one
SIZE = _at.next
