"""Thin-ring modes by closed forms, put into a bearing's parameters, and the right-hand side with them."""

import numpy as np

from fmu_bearing.engine import layout as at
from fmu_bearing.engine import layout_flexure as places
from fmu_bearing.engine.mechanics.energy import stored_energy
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.mechanics.flexure import flexure_energy

S = at.STRIDE


def thin_ring(body, order, frequency, mass, damping=0.0, shape=(0.0, 1.0), tilt=0.0):
    """Row of the table of modes for an inextensional ring: u_t = -u_r/n, g = -2 n/(n^2 + 1).

    ``mass`` (kg) is the whole ring's: one coordinate has half of it times 1 + 1/n^2. ``shape``: axial and
    radial.
    """
    row = np.zeros(places.MODE_SIZE)
    free = 2.0 * np.pi * frequency
    row[places.MODE_BODY], row[places.MODE_ORDER] = body, order
    row[places.MODE_MASS] = 0.5 * mass * (1.0 + 1.0 / order**2)
    row[places.MODE_STIFFNESS] = row[places.MODE_MASS] * free**2
    row[places.MODE_DAMPING] = 2.0 * damping * free
    row[places.MODE_GYROSCOPIC] = -2.0 * order / (order**2 + 1.0)
    row[places.MODE_X], row[places.MODE_R], row[places.MODE_T] = *shape, -shape[1] / order
    row[places.MODE_TILT] = tilt
    row[places.MODE_WEIGHT] = 0.5 * (row[places.MODE_X : places.MODE_TILT] ** 2).sum()
    return row


def untouched(row):
    """Return the mode with a groove that does not move: the balls neither drive nor feel it."""
    row = row.copy()
    row[places.MODE_X : places.MODE_TILT + 1] = 0.0
    row[places.MODE_WEIGHT] = 0.5
    return row


def with_modes(p, rows, step=1e-5):
    """Parameters with the modes of ``rows`` and their longest internal step (s)."""
    longer = np.concatenate([p, np.ravel(rows)])
    longer[at.P_MODES], longer[at.P_AT_MODES], longer[at.P_MODE_STEP] = len(rows), p.size, step
    return longer


class Flexure:
    """Where the flexure of a bearing stands in its state and in a work space ``w``."""

    def __init__(self, p, w):
        self.count = 2 * int(p[at.P_MODES])
        self.kept = at.S_SOUND + int(p[at.P_SOUND_STATE])
        self.w = w

    def array(self, place):
        """One flat array over the coordinates, by its place in ``modes_layout``."""
        begin = at.W_FLEX + place
        return self.w[begin : begin + self.count]

    def state(self, s):
        """Places, velocities and accelerations in ``s``, as rows."""
        return s[self.kept : self.kept + 3 * self.count].reshape(3, self.count)


class FirstOrder:
    """Balls, bodies and modes of a run as x' = F(t, x): places, rates and spins in one vector."""

    def __init__(self, run, speed_rate=0.0):
        self.p, self.w = run.p, np.zeros(at.work_size(run.p))
        self.c = run.s[at.S_C : at.S_C + at.C_SIZE].copy()
        self.angle, self.speed, self.speed_rate = run.s[at.S_ANGLE], run.s[at.S_SPEED], speed_rate
        self.flexure = Flexure(run.p, self.w)
        self.f = np.zeros(at.F_SIZE)
        self.balls = int(run.p[at.P_BALLS])
        self.modes_at = 9 * self.balls + 34
        y = run.s[at.S_Y : at.S_Y + at.Y_SIZE]
        rows = y[: 9 * S].reshape(9, S)[:, : self.balls]
        self.start = np.concatenate([rows.ravel(), y[at.Y_Q :], self.flexure.state(run.s)[:2].ravel()])

    def evaluate(self, t, x):
        """Fill ``f`` and the work space; return ``y`` and the speed."""
        y = np.zeros(at.Y_SIZE)
        rows = y[: 9 * S].reshape(9, S)
        rows[:, : self.balls] = x[: 9 * self.balls].reshape(9, self.balls)
        rows[:, self.balls :] = rows[:, :1]
        y[at.Y_Q :] = x[9 * self.balls : self.modes_at]
        places_and_rates = x[self.modes_at :].reshape(2, -1)
        self.flexure.array(places.FW_Q)[:], self.flexure.array(places.FW_V)[:] = places_and_rates
        speed = self.speed + self.speed_rate * t
        angle = self.angle + t * (self.speed + 0.5 * self.speed_rate * t)
        right_hand_side(self.p, self.c, y, angle, speed, self.speed_rate, self.w, self.f)
        return y, speed

    def __call__(self, t, x):
        """Rates of ``x``."""
        y, _ = self.evaluate(t, x)
        rates = y[3 * S : 6 * S].reshape(3, S)[:, : self.balls]
        balls = self.f[: 6 * S].reshape(6, S)[:, : self.balls]
        v, a = self.flexure.array(places.FW_V), self.flexure.array(places.FW_A)
        g = self.f[at.F_G : at.F_G + 17]
        return np.concatenate([rates.ravel(), balls.ravel(), y[at.Y_V :], g, v, a])

    def energy(self, t, x):
        """Stored energy (J)."""
        y, speed = self.evaluate(t, x)
        return stored_energy(self.p, self.c, y, self.w) + flexure_energy(self.p, y, speed, self.w)

    def contact_forces(self, x):
        """Generalised forces (N) of the balls on the modes."""
        self.evaluate(0.0, x)
        return self.flexure.array(places.FW_FORCE).copy()


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
