"""A scene at rest on its quasi-static equilibrium, as the kernel finds it."""

import numpy as np

from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.engine.layout import EQ, C, P, U, W
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.statics.quasistatic import equilibrium
from fmu_bearing.engine.status import OK
from fmu_bearing.prepare.model import pack
from tests.engine.helpers import RPM


class Bearing:
    """A scene's parameters and conditions, and the kernel's answers in SI units."""

    def __init__(self, scene, **parameters):
        self.p = pack(scene, np.empty(0))
        for name, value in parameters.items():
            self.p[getattr(P, name)] = value
        self.u = np.zeros(U.SIZE)
        self.u[U.PEDESTAL] = 1e8
        self.u[U.SHAFT_T :] = REFERENCE_TEMPERATURE
        self.c = np.zeros(C.SIZE)
        self.w = np.zeros(W.size(self.p))
        self.out = np.zeros(EQ.SIZE)
        self.balls = int(self.p[P.BALLS])
        conditions(self.p, self.u, 0.0, self.c)

    def solve(self, rpm, load, offset=(0.0, 0.0), status=OK):
        """Equilibrium under (Fx, Fy, Fz, My, Mz); the bearing itself, for its rows."""
        load, offset = np.array(load, dtype=float), np.array(offset, dtype=float)
        assert equilibrium(self.p, self.c, rpm * RPM, load, offset, self.out, self.w) == status
        return self

    def row(self, at_row):
        """A quantity of all balls."""
        return self.out[at_row : at_row + self.balls].copy()

    @property
    def shift(self):
        """Displacement of the inner ring against the outer: x, y, z, tilts y and z."""
        return self.out[EQ.SHIFT : EQ.SHIFT + 5].copy()

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
