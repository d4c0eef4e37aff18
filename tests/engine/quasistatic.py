"""A scene at rest on its quasi-static equilibrium, as the kernel finds it."""

import numpy as np

from fmu_bearing.compiled import call
from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.engine.layout import EQ, SP, C, P, Q, S, U, W
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.status import OK
from fmu_bearing.prepare.model import pack
from tests.engine.helpers import RPM

#: N m/rad: of springs under an outer ring that is upright, and tilted, where rounding leaves 1e-9 N m
UPRIGHT, TILTED = 1e13, 1e9


class Bearing:
    """A scene's parameters and conditions, and where the kernel brings its rings to rest, in SI units."""

    def __init__(self, scene, **parameters):
        self.p = pack(scene, np.empty(0))
        for name, value in parameters.items():
            self.p[getattr(P, name)] = value
        self.u = np.zeros(U.SIZE)
        self.u[U.PEDESTAL] = 1e8
        self.u[U.SHAFT_T :] = REFERENCE_TEMPERATURE
        self.p[P.GRAVITY] = self.p[P.RIGID] = 0.0
        self.s = np.zeros(S.size(self.p))
        self.c = self.s[S.C : S.C + C.SIZE]
        self.w = np.zeros(W.size(self.p))
        self.out = np.zeros(EQ.SIZE)
        self.balls = int(self.p[P.BALLS])
        conditions(self.p, self.u, 0.0, self.c)

    def solve(self, rpm, load, offset=(0.0, 0.0), status=OK):
        """Equilibrium under (Fx, Fy, Fz, My, Mz), the outer ring tilted; the bearing itself, for its rows."""
        self.c[C.PEDESTAL_ROTATIONAL] = TILTED if any(offset) else UPRIGHT
        self.p[P.MISALIGNMENT_Y : P.MISALIGNMENT_Y + 2] = offset
        return self.rest(rpm, load, status)

    def rest(self, rpm, load, status=OK):
        """As `solve`, with the outer ring on the springs of its pedestal."""
        self.c[[C.PRELOAD, C.LOAD_Y, C.LOAD_Z]] = load[:3]
        more = members.scratch(self.p, 0) + SP.START_MORE
        self.w[W.SET + more + Q.INNER_BY :][:2] = load[3:]
        assert call("rest", self.p, self.s, self.w, rpm * RPM) == status
        self.out[:] = self.w[W.EQUILIBRIUM : W.EQUILIBRIUM + EQ.SIZE]
        return self

    def row(self, at_row):
        """A quantity of all balls."""
        return self.out[at_row : at_row + self.balls].copy()

    @property
    def shift(self):
        """Displacement of the inner ring against the outer: x, y, z, tilts y and z."""
        return self.out[EQ.SHIFT : EQ.SHIFT + 5].copy()

    @property
    def tilt(self):
        """Tilts y and z of the outer ring."""
        at = W.SET + members.scratch(self.p, 0) + SP.START_TILT
        return self.w[at : at + 2].copy()

    @property
    def stiffness(self):
        """The 5 x 5 matrix."""
        return self.out[EQ.STIFFNESS : EQ.STIFFNESS + 25].reshape(5, 5).copy()


def solve(scene, rpm, preload, **temperatures):
    """Under axial load: loads (N), angles (deg), axial displacement (m), stiffness of equal balls."""
    bearing = Bearing(scene)
    bearing.u[U.INNER_T] = temperatures.get("inner", 293.15)
    bearing.u[U.OUTER_T] = temperatures.get("outer", 293.15)
    conditions(bearing.p, bearing.u, rpm * RPM, bearing.c)
    bearing.solve(rpm, (preload, 0, 0, 0, 0))
    k = bearing.stiffness
    return {
        "load_i": bearing.row(EQ.LOAD_I)[0],
        "load_o": bearing.row(EQ.LOAD_O)[0],
        "angle_i": np.degrees(bearing.row(EQ.ANGLE_I)[0]),
        "angle_o": np.degrees(bearing.row(EQ.ANGLE_O)[0]),
        "shift": bearing.shift[0],
        "orbit": bearing.row(EQ.OM)[0],
        # axial, radial, tilt, coupling of vertical force with the tilt about Y
        "stiffness": (k[0, 0], k[2, 2], k[3, 3], k[2, 3]),
    }
