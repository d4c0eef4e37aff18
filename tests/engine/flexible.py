"""Thin-ring modes by closed forms, put into a bearing's parameters, and the right-hand side with them."""

import numpy as np

from fmu_bearing.engine import layout as at
from fmu_bearing.engine.mechanics.energy import stored_energy
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.mechanics.flexure import flexure_energy

S = at.STRIDE


def thin_ring(body, order, frequency, mass, damping=0.0, shape=(0.0, 1.0), tilt=0.0):
    """Row of the table of modes for an inextensional ring: u_t = -u_r/n, g = -2 n/(n^2 + 1).

    ``mass`` (kg) of the whole ring: one coordinate has half of it times 1 + 1/n^2. ``shape``: axial and radial.
    """
    row = np.zeros(at.MODE_SIZE)
    free = 2.0 * np.pi * frequency
    row[at.MODE_BODY], row[at.MODE_ORDER] = body, order
    row[at.MODE_MASS] = 0.5 * mass * (1.0 + 1.0 / order**2)
    row[at.MODE_STIFFNESS] = row[at.MODE_MASS] * free**2
    row[at.MODE_DAMPING] = 2.0 * damping * free
    row[at.MODE_GYROSCOPIC] = -2.0 * order / (order**2 + 1.0)
    row[at.MODE_X], row[at.MODE_R], row[at.MODE_T] = *shape, -shape[1] / order
    row[at.MODE_TILT] = tilt
    row[at.MODE_WEIGHT] = 0.5 * (row[at.MODE_X : at.MODE_TILT] ** 2).sum()
    return row


def with_modes(p, rows, step=1e-5):
    """Parameters with the modes of ``rows`` and their longest internal step (s)."""
    longer = np.concatenate([p, np.ravel(rows)])
    longer[at.P_MODES], longer[at.P_AT_MODES], longer[at.P_MODE_STEP] = len(rows), p.size, step
    return longer


class Flat:
    """The flexure's flat arrays of a work space ``w``, and its part of a state."""

    def __init__(self, p, w):
        self.count = 2 * int(p[at.P_MODES])
        self.first = at.W_SOUND + int(p[at.P_SOUND_WORK]) + 8 + (at.FLEX_ROWS + self.count) * S
        self.kept = at.S_SOUND + int(p[at.P_SOUND_STATE])
        self.w = w

    def __call__(self, array):
        begin = self.first + array * self.count
        return self.w[begin : begin + self.count]

    def state(self, s):
        """Places, velocities and accelerations, as rows."""
        return s[self.kept : self.kept + 3 * self.count].reshape(3, self.count)


class FirstOrder:
    """Balls, bodies and modes of a run as x' = F(t, x): places, rates and spins in one vector."""

    def __init__(self, run, modes=True):
        self.run = run
        self.c = run.s[at.S_C : at.S_C + at.C_SIZE].copy()
        self.angle, self.speed = run.s[at.S_ANGLE], run.s[at.S_SPEED]
        self.w = np.zeros(at.work_size(run.p))
        self.flat = Flat(run.p, self.w)
        self.f = np.zeros(at.F_SIZE)
        self.lanes = int(run.p[at.P_BALLS])

    def start(self):
        y = self.run.s[at.S_Y : at.S_Y + at.Y_SIZE]
        return self.pack(y, self.flat.state(self.run.s)[:2].ravel())

    def pack(self, y, modes):
        rows = y[: 9 * S].reshape(9, S)[:, : self.lanes]
        return np.concatenate([rows.ravel(), y[at.Y_Q :], modes])

    def unpack(self, x):
        y = np.zeros(at.Y_SIZE)
        n = 9 * self.lanes
        rows = y[: 9 * S].reshape(9, S)
        rows[:, : self.lanes] = x[:n].reshape(9, self.lanes)
        rows[:, self.lanes :] = rows[:, :1]
        y[at.Y_Q :] = x[n : n + 34]
        self.flat(at.FW_Q)[:], self.flat(at.FW_V)[:] = x[n + 34 :].reshape(2, -1)
        return y

    def evaluate(self, t, x, rate=0.0):
        """Fill ``f`` and the work space; return ``y`` and the speed."""
        y, speed = self.unpack(x), self.speed + rate * t
        angle = self.angle + t * (self.speed + 0.5 * rate * t)
        right_hand_side(self.run.p, self.c, y, angle, speed, rate, self.w, self.f)
        return y, speed

    def __call__(self, t, x, rate=0.0):
        y, _ = self.evaluate(t, x, rate)
        rates = y[3 * S : 6 * S].reshape(3, S)[:, : self.lanes]
        balls = self.f[: 6 * S].reshape(6, S)[:, : self.lanes]
        return np.concatenate(
            [rates.ravel(), balls.ravel(), y[at.Y_V :], self.f[at.F_G : at.F_G + 17],
             self.flat(at.FW_V), self.flat(at.FW_A)]
        )  # fmt: skip

    def energy(self, t, x, rate=0.0):
        """Stored energy (J)."""
        y, speed = self.evaluate(t, x, rate)
        p = self.run.p
        return stored_energy(p, self.c, y, self.w) + flexure_energy(p, y, speed, self.w)
