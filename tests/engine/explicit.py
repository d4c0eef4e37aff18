"""Classical Runge-Kutta steps in plain Python on the engine's right-hand side, for one run at constant speed.

The tests' only integrator: it shares nothing with the engine but the right-hand side, nor with the compiled
one of the studies' reference trajectory, which is itself held against the engine's.
"""

import numpy as np

from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import STRIDE, C, F, Q, S, W, Y

_PLACES = 3 * STRIDE  # of the balls: x, r, theta


class Motion:
    """The right-hand side of a run with rigid rings from its present state on, and tiny steps on it."""

    def __init__(self, run):
        self.p, self.w = run.p, np.zeros(W.size(run.p))
        self.start = run.s[S.Y : S.Y + Y.SIZE].copy()
        self.c = run.s[S.C : S.C + C.SIZE].copy()
        self.angle, self.speed = run.s[S.ANGLE], run.s[S.SPEED]

    def f(self, t, y):
        """Accelerations, and what else the right-hand side gives, ``t`` (s) after the start."""
        out = np.zeros(F.SIZE)
        angle = self.angle + self.speed * t
        call("right_hand_side", self.p, self.c, y, self.w, out, angle, self.speed, 0.0)
        return out

    def rate(self, t, y):
        """Rates of the state ``y``."""
        f, out = self.f(t, y), np.zeros_like(y)
        out[:_PLACES] = y[_PLACES : 2 * _PLACES]
        out[_PLACES : Y.Q0] = f[: F.BODY]
        out[Y.Q0 : Y.V0] = y[Y.V0 :]
        out[Y.V0 :] = f[F.BODY : F.BODY + Q.SIZE]
        return out

    def exact(self, times, h):
        """States at ``times`` (s, multiples of ``h``) by steps of ``h`` (s)."""
        y, found, n = self.start.copy(), {}, 0
        for time in sorted(times):
            while n < round(time / h):
                t = n * h
                k1 = self.rate(t, y)
                k2 = self.rate(t + h / 2, y + h / 2 * k1)
                k3 = self.rate(t + h / 2, y + h / 2 * k2)
                k4 = self.rate(t + h, y + h * k3)
                y = y + h / 6 * (k1 + 2 * k2 + 2 * k3 + k4)
                n += 1
            found[time] = y.copy()
        return found
