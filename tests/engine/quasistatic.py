"""A scene at rest on its quasi-static equilibrium, as the kernel finds it."""

import numpy as np

from fmu_bearing.engine import layout as at
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.solvers.quasistatic import equilibrium
from fmu_bearing.prepare.model import pack
from tests.engine.helpers import RPM


class Bearing:
    """A scene's parameters and conditions, and the kernel's answers in SI units."""

    def __init__(self, scene, **parameters):
        self.p = pack(scene, np.empty(0))
        for name, value in parameters.items():
            self.p[getattr(at, name)] = value
        self.u = np.array([0.0, 0.0, 1e8, 0, 0, 293.15, 293.15, 293.15])
        self.c = np.zeros(at.C_SIZE)
        self.w = np.zeros(at.work_size(self.p))
        self.out = np.zeros(at.Q5_SIZE)
        self.balls = int(self.p[at.P_BALLS])
        conditions(self.p, self.u, 0.0, self.c)

    def solve(self, rpm, load, offset=(0.0, 0.0), status=at.OK):
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
        return self.out[at.Q5_SHIFT : at.Q5_SHIFT + 5].copy()

    @property
    def stiffness(self):
        """The 5 x 5 matrix."""
        return self.out[at.Q5_STIFFNESS : at.Q5_STIFFNESS + 25].reshape(5, 5).copy()


def solve(scene, rpm, preload, **temperatures):
    """Under axial load: loads (N), angles (deg), axial displacement (m), stiffness of equal balls."""
    bearing = Bearing(scene)
    bearing.u[at.U_INNER_T] = temperatures.get("inner", 293.15)
    bearing.u[at.U_OUTER_T] = temperatures.get("outer", 293.15)
    conditions(bearing.p, bearing.u, rpm * RPM, bearing.c)
    bearing.solve(rpm, (preload, 0, 0, 0, 0))
    k = bearing.stiffness
    return {
        "load_i": bearing.row(at.Q5_LOAD_I)[0],
        "load_o": bearing.row(at.Q5_LOAD_O)[0],
        "angle_i": np.degrees(bearing.row(at.Q5_ANGLE_I)[0]),
        "angle_o": np.degrees(bearing.row(at.Q5_ANGLE_O)[0]),
        "shift": bearing.shift[0],
        "orbit": bearing.row(at.Q5_OM)[0],
        # axial, radial, tilt, coupling of vertical force with the tilt about Y
        "stiffness": (k[0, 0], k[2, 2], k[3, 3], k[2, 3]),
    }
