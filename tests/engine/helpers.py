"""Run the engine on small variations of the example scenes."""

import numpy as np
from scipy.special import comb

from fmu_bearing.compiled import call
from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE, RPM
from fmu_bearing.engine.layout import MAX_DEFECTS, STRIDE, P, Q, S, U, W, Z
from fmu_bearing.engine.status import OK
from fmu_bearing.prepare.model import pack
from fmu_bearing.prepare.surfaces import form_rows
from tests.engine.flexible import with_modes

#: Stiffness and damping of the springs that hold an inner ring against tilting.
TILT_STIFFNESS, TILT_DAMPING = (
    slice(first + Q.INNER_BY, first + Q.OUTER) for first in (P.SUPPORT_STIFFNESS, P.SUPPORT_DAMPING)
)
#: Springs and dampers between inner ring and ground: N/m, N m/rad, N s/m, N m s/rad.
SUPPORTED = {
    "SUPPORT_STIFFNESS": [5e6, 2e7, 2e7, 3e4, 3e4],
    "SUPPORT_DAMPING": [300.0, 900.0, 900.0, 2.0, 2.0],
}


def quiet(scene):
    """The scene without imperfections and without sound."""
    return scene.model_copy(update={"imperfections": None, "sound": None})


def wavy_balls(p, amplitudes, seed=5):
    """Parameters with ball waviness: amplitudes (m) of orders 1, 2, ... and random axes."""
    balls = int(p[P.BALLS])
    axes = np.empty((3, STRIDE))
    # as many draws for all bearings, whatever the layout: their first balls have the same axes
    axes[:, :balls] = np.random.default_rng(seed).normal(size=(3, max(24, balls)))[:, :balls]
    axes[:, balls:] = axes[:, :1]
    axes /= np.linalg.norm(axes, axis=0)
    rows = form_rows(amplitudes)
    longer = np.concatenate([p, rows, axes.ravel()])
    longer[P.BALL_WAVES], longer[P.AT_FORM], longer[P.AT_AXES] = len(amplitudes), p.size, p.size + rows.size
    return longer


def ball_amplitudes(p):
    """Zonal amplitudes (m) of orders 1, 2, ... that parameters hold, divided by (2n)! / (2^n n!^2) again."""
    orders = np.arange(1, int(p[P.BALL_WAVES]) + 1)
    first = int(p[P.AT_FORM]) + P.FORM_ROW + P.FORM_HEIGHT
    return p[first :: P.FORM_ROW][: orders.size] * 2.0**orders / comb(2 * orders, orders)


class Run:
    """A bearing on bare arrays: parameters from a scene without sound, inputs at will.

    Rings are rigid but for ``modes``, rows of the table of flexural modes, or ``bends``: the scene's own.
    """

    def __init__(
        self, scene, rpm, preload=None, pedestal=None, ball_waves=None, modes=None, bends=False, **parameters
    ):
        self.p = pack(scene if bends else scene.with_rigid_rings(), np.empty(0))
        if ball_waves is not None:
            self.p = wavy_balls(self.p, ball_waves)
        if modes is not None:
            self.p = with_modes(self.p, modes)
        for name, value in parameters.items():
            place = getattr(P, name)
            self.p[place : place + np.size(value)] = value
        self.p.setflags(write=False)
        mounting = scene.mounting
        self.u = np.zeros(U.SIZE)
        self.u[U.SHAFT_T :] = REFERENCE_TEMPERATURE
        self.u[U.SPEED] = rpm * RPM
        self.u[U.PRELOAD] = mounting.preload_N if preload is None else preload
        self.u[U.PEDESTAL] = mounting.pedestal_stiffness_N_m if pedestal is None else pedestal
        self.s = np.zeros(S.size(self.p))
        self.w = np.zeros(W.size(self.p))
        # with room for defects, which a test may put into the parameters
        self.z = np.zeros(Z.size(int(self.p[P.BALLS]), 0, 0, int(self.p[P.MODES]), MAX_DEFECTS))

    def init(self):
        status = call("init", self.p, self.u, self.s, self.z, self.w, 0.0)
        assert status == OK
        return self

    def step(self, h):
        return call("step", self.p, self.u, self.s, self.z, self.w, h)

    def run(self, duration, h=1e-4):
        """Step for ``duration`` (s); rows of z after each step."""
        rows = []
        for _ in range(round(duration / h)):
            assert self.step(h) == OK
            rows.append(self.z.copy())
        return np.array(rows)

    def value(self, name, rows=None):
        """An output by name, from rows of z or the last one."""
        k = Z.BEARING_OUTPUTS.index(name)
        return self.z[k] if rows is None else rows[:, k]

    @property
    def heat(self):
        """Dissipated so far (J)."""
        return self.s[S.HEAT : S.HEAT + 3].sum()

    @property
    def imbalance(self):
        """Work in less dissipation less change of stored energy (J)."""
        return self.s[S.WORK] - self.heat - (self.s[S.ENERGY_NOW] - self.s[S.ENERGY_START])
