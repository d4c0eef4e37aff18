"""Tiny steps of the compiled classical Runge-Kutta method for one run with rigid rings at constant speed.

The method shares nothing with the engine's integrators but the right-hand side. It is itself held against
steps in NumPy, in test_steady_state.py.
"""

import numpy as np

from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import STRIDE, C, F, Q, S, W, Y
from fmu_bearing.engine.reference.runge_kutta import AXES, DIRECTIONS, ROWS, SIZE

_PLACES = 3 * STRIDE  # of the balls: x, r, theta


class Motion:
    """The equations of a run with rigid rings from its present state on, and tiny steps on them."""

    def __init__(self, run):
        self.p, self.w = run.p, np.zeros(W.size(run.p))
        self.start = np.concatenate([run.s[S.Y : S.Y + Y.SIZE], run.s[S.AXES : S.JAC]])
        self.c = run.s[S.C : S.C + C.SIZE].copy()
        self.angle, self.speed = run.s[S.ANGLE], run.s[S.SPEED]

    def rate(self, t, y):
        """Rates of the state ``y``, ``t`` (s) after the start, without defects on balls."""
        f, out = np.zeros(F.SIZE), np.zeros_like(y)
        angle = self.angle + self.speed * t
        axes = y[AXES:DIRECTIONS].reshape(3, STRIDE)
        self.w[W.AXES :][: axes.size] = axes.ravel()
        call("right_hand_side", self.p, self.c, y[: Y.SIZE].copy(), self.w, f, angle, self.speed, 0.0)
        out[:_PLACES] = y[_PLACES : 2 * _PLACES]
        out[_PLACES : Y.Q0] = f[: F.BODY]
        out[Y.Q0 : Y.V0] = y[Y.V0 : Y.SIZE]
        out[Y.V0 : Y.SIZE] = f[F.BODY : F.BODY + Q.SIZE]
        spin = y[Y.WX : Y.Q0].reshape(3, STRIDE).copy()
        spin[0] -= y[Y.OM : Y.OM + STRIDE]
        out[AXES:DIRECTIONS] = np.cross(spin, axes, axis=0).ravel()
        return out

    def after(self, duration, h):
        """State after ``duration`` (s) by steps of ``h`` (s)."""
        y, scratch = self.start.copy(), np.zeros(ROWS * SIZE)
        steps = round(duration / h)
        call("runge_kutta", self.p, self.c, y, self.w, scratch, self.angle, self.speed, h, steps)
        return y
