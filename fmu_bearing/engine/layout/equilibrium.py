"""EQ: result of the quasi-static kernel (statics/quasistatic.py)."""

from fmu_bearing.engine.layout.sizes import STRIDE, Places

FREEDOMS = 5  # x y z by bz of the inner ring against the outer

_at = Places()
SHIFT = _at(FREEDOMS)  # m, rad
RESIDUAL = _at()  # N; moments over the pitch radius
ITERATIONS = _at()
STIFFNESS = _at(FREEDOMS * FREEDOMS)  # row by row: force or moment on x y z by bz per displacement
X = _at(STRIDE)  # m: a ball's place
R = _at(STRIDE)
OM = _at(STRIDE)  # rad/s: its orbit speed
WX = _at(STRIDE)  # rad/s: and spin
WR = _at(STRIDE)
WT = _at(STRIDE)
LOAD_I = _at(STRIDE)  # N
LOAD_O = _at(STRIDE)
ANGLE_I = _at(STRIDE)  # rad
ANGLE_O = _at(STRIDE)
SIZE = _at.next
