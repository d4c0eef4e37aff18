"""ST: work space of the quasi-static kernels, in ``w`` from ``W.STATICS`` on (``v`` in kernels).

First rows of the balls, then a matrix over the freedoms of the inner ring against the outer. Those are x y z
by bz (``Q.X`` to ``Q.INNER_BZ``) in inertial axes, and x r theta and the tilts about r and theta in a ball's
axes.
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

# share of one ball in the stiffness; FREEDOMS columns each
_share = Places()
FX = _share(FREEDOMS)  # N per m or rad: force on the inner ring
FR = _share(FREEDOMS)
FT = _share(FREEDOMS)
MR = _share(FREEDOMS)  # N m per m or rad: moment on it
MT = _share(FREEDOMS)
SHARE_SIZE = _share.next

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
SHARE = _at(SHARE_SIZE)  # of one ball
SIZE = _at.next
