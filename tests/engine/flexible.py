"""Thin-ring modes by closed forms, put into a bearing's parameters, and the right-hand side with them."""

import numpy as np

from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import FL, STRIDE, C, F, P, S, W, Y
from fmu_bearing.engine.mechanics.energy import stored_energy
from fmu_bearing.engine.mechanics.flexure import flexure_energy
from fmu_bearing.scene.mounting import Flexure as Bending


def thin_ring(body, order, frequency, mass, damping=0.0, shape=(0.0, 1.0), tilt=0.0):
    """Row of the table of modes for an inextensional ring: u_t = -u_r/n, g = -2 n/(n^2 + 1).

    ``mass`` (kg) is the whole ring's: one coordinate has half of it times 1 + 1/n^2. ``shape``: axial and
    radial.
    """
    row = np.zeros(P.MODE_SIZE)
    free = 2.0 * np.pi * frequency
    row[P.MODE_BODY], row[P.MODE_ORDER] = body, order
    row[P.MODE_MASS] = 0.5 * mass * (1.0 + 1.0 / order**2)
    row[P.MODE_STIFFNESS] = row[P.MODE_MASS] * free**2
    row[P.MODE_DAMPING] = 2.0 * damping * free
    row[P.MODE_GYROSCOPIC] = -2.0 * order / (order**2 + 1.0)
    row[P.MODE_X], row[P.MODE_R], row[P.MODE_T] = *shape, -shape[1] / order
    row[P.MODE_TILT] = tilt
    row[P.MODE_WEIGHT] = 0.5 * (row[P.MODE_X : P.MODE_TILT] ** 2).sum()
    return row


# near the 7003C's: outer n = 2, 3, inner n = 2; tilts beyond the real ones, so that an error in them shows
MODES = [
    thin_ring(0, 2, 18070.0, 0.014, damping=0.01, shape=(0.2, 0.9), tilt=40.0),
    thin_ring(1, 2, 6640.0, 0.022, damping=0.005, shape=(0.1, 1.0), tilt=60.0),
    thin_ring(1, 3, 18450.0, 0.022, damping=0.005, shape=(-0.1, 1.0), tilt=-30.0),
]
SCENE = "7003C-spindle"
FRICTIONLESS = {"MU": 0.0, "ROLLING": 0.0, "CONTACT_DAMPING": 0.0}


def bending(scene, inner=(), outer=(), **values):
    """The scene with flexible rings, without rotor and housing, which would hold them round."""
    flexure = Bending(inner_ring=inner, outer_ring=outer, **values)
    loose = {"flexure": flexure, "rotor": None, "housing": None}
    return scene.model_copy(update={"mounting": scene.mounting.model_copy(update=loose)})


def untouched(row):
    """Return the mode with a groove that does not move: the balls neither drive nor feel it."""
    row = row.copy()
    row[P.MODE_X : P.MODE_TILT + 1] = 0.0
    row[P.MODE_WEIGHT] = 0.5
    return row


def with_modes(p, rows, step=1e-5):
    """Parameters with the modes of ``rows`` and their longest internal step (s)."""
    longer = np.concatenate([p, np.ravel(rows)])
    longer[P.MODES], longer[P.AT_MODES], longer[P.MODE_STEP] = len(rows), p.size, step
    longer[P.INNER_MODES] = sum(row[P.MODE_BODY] == 0.0 for row in rows)
    return longer


class Flexure:
    """Where the flexure of a bearing is in its state and in a work space ``w``."""

    def __init__(self, p, w):
        self.count = 2 * int(p[P.MODES])
        self.kept = S.SOUND + int(p[P.SOUND_STATE])
        self.w = w

    def array(self, place):
        """One flat array over the coordinates, by its place in ``FL``."""
        begin = W.FLEX + place
        return self.w[begin : begin + self.count]

    def state(self, s):
        """Places, velocities and accelerations in ``s``, as rows."""
        return s[self.kept : self.kept + 3 * self.count].reshape(3, self.count)


class FirstOrder:
    """Balls, bodies and modes of a run as x' = F(t, x): places, rates and spins in one vector."""

    def __init__(self, run, speed_rate=0.0):
        self.p, self.w = run.p, np.zeros(W.size(run.p))
        self.c = run.s[S.C : S.C + C.SIZE].copy()
        self.angle, self.speed, self.speed_rate = run.s[S.ANGLE], run.s[S.SPEED], speed_rate
        self.flexure = Flexure(run.p, self.w)
        self.f = np.zeros(F.SIZE)
        self.balls = int(run.p[P.BALLS])
        self.modes_at = 9 * self.balls + 34
        y = run.s[S.Y : S.Y + Y.SIZE]
        rows = y[: 9 * STRIDE].reshape(9, STRIDE)[:, : self.balls]
        self.start = np.concatenate([rows.ravel(), y[Y.Q0 :], self.flexure.state(run.s)[:2].ravel()])

    def evaluate(self, t, x):
        """Fill ``f`` and the work space; return ``y`` and the speed."""
        y = np.zeros(Y.SIZE)
        rows = y[: 9 * STRIDE].reshape(9, STRIDE)
        rows[:, : self.balls] = x[: 9 * self.balls].reshape(9, self.balls)
        rows[:, self.balls :] = rows[:, :1]
        y[Y.Q0 :] = x[9 * self.balls : self.modes_at]
        places_and_rates = x[self.modes_at :].reshape(2, -1)
        self.flexure.array(FL.Q)[:], self.flexure.array(FL.V)[:] = places_and_rates
        speed = self.speed + self.speed_rate * t
        angle = self.angle + t * (self.speed + 0.5 * self.speed_rate * t)
        call("right_hand_side", self.p, self.c, y, self.w, self.f, angle, speed, self.speed_rate)
        return y, speed

    def __call__(self, t, x):
        """Rates of ``x``."""
        y, _ = self.evaluate(t, x)
        rates = y[3 * STRIDE : 6 * STRIDE].reshape(3, STRIDE)[:, : self.balls]
        balls = self.f[: 6 * STRIDE].reshape(6, STRIDE)[:, : self.balls]
        v, a = self.flexure.array(FL.V), self.flexure.array(FL.A)
        g = self.f[F.BODY : F.BODY + 17]
        return np.concatenate([rates.ravel(), balls.ravel(), y[Y.V0 :], g, v, a])

    def energy(self, t, x):
        """Stored energy (J)."""
        y, speed = self.evaluate(t, x)
        return stored_energy(self.p, self.c, y, self.w) + flexure_energy(self.p, y, speed, self.w)

    def contact_forces(self, x):
        """Generalised forces (N) of the balls on the modes."""
        self.evaluate(0.0, x)
        return self.flexure.array(FL.FORCE).copy()


def shaken(problem, seed=1, size=1e-6):
    """The problem's start with balls, bodies and modes displaced by about ``size`` (m), and moving."""
    rng = np.random.default_rng(seed)
    n, x = problem.balls, problem.start.copy()
    rows = x[: 9 * n].reshape(9, n)
    spread = rng.uniform(-1.0, 1.0, (9, n))
    rows[0] += 0.5 * size * spread[0]
    rows[1] += 0.3 * size * spread[1]
    rows[2] += 0.4 + 1e-3 * spread[2]
    rows[3:5] = 0.02 * spread[3:5]
    rows[5] *= 1.0 + 0.02 * spread[5]
    rows[6:] += 0.02 * np.hypot(rows[6], rows[7]) * spread[6:]
    q, v = x[9 * n : 9 * n + 17], x[9 * n + 17 : 9 * n + 34]
    q[:3] += 0.3 * size * rng.uniform(-1, 1, 3)
    q[5:8] += 0.3 * size * rng.uniform(-1, 1, 3)
    q[14] += 0.4
    v[:3], v[5:8], v[8] = 0.01 * rng.uniform(-1, 1, 3), 0.01 * rng.uniform(-1, 1, 3), 2.0
    flexure = x[problem.modes_at :].reshape(2, -1)
    flexure[0] = size * rng.uniform(-1, 1, flexure.shape[1])
    flexure[1] = 1e4 * size * rng.uniform(-1, 1, flexure.shape[1])
    return x
