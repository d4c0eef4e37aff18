"""Fidelity ``full`` as x' = g(t, x), for general-purpose integrators.

``x`` holds nine rows of one number per ball (x, r, theta, their rates, spin), then 17 coordinates of the
bodies and their 17 rates, as ``y`` in ``engine.layout.y`` without its spare lanes.
"""

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import RINGS, Arrays
from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import STRIDE, C, F, J, P, S, Y


class FirstOrder:
    """The initial value problem that starts at a bearing's present state, its speed held.

    Attributes
    ----------
    start : ndarray
        ``x`` at t = 0.
    scale : ndarray
        Typical size of each component, for absolute tolerances.
    rings : ndarray of int
        Places in ``x`` of the six ring velocities.
    """

    def __init__(self, bearing: Arrays) -> None:
        self.p = bearing.p
        balls = int(self.p[P.BALLS])
        self.c = bearing.s[S.C : S.C + C.SIZE].copy()
        self.angle = float(bearing.s[S.ANGLE])
        self.speed = float(bearing.s[S.SPEED])
        y = bearing.s[S.Y : S.Y + Y.SIZE]
        rows = y[: Y.Q0].reshape(J.STATES, STRIDE)[:, :balls]
        self.start = np.concatenate([rows.ravel(), y[Y.Q0 :]])
        self.size = self.start.size
        self.rings = RINGS - Y.Q0 + J.STATES * balls
        self.scale = np.concatenate([_BALL_SCALE.repeat(balls), _BODY_SCALE, 1e4 * _BODY_SCALE])
        self._w = np.zeros(bearing.w.size)
        self._f = np.zeros(F.SIZE)
        self._y = np.zeros(Y.SIZE)
        self._blocks = np.zeros(J.SIZE)

    def rate(self, t: float, x: NDArray[np.float64], dx: NDArray[np.float64]) -> None:
        """Fill ``dx`` with the rates at ``t`` (s), ``x``."""
        arrays = self.p, self.c, x, self._w, self._f, self._y, dx
        call("first_order", *arrays, self.angle, self.speed, t)

    def jacobian(self, t: float, x: NDArray[np.float64], out: NDArray[np.float64]) -> None:
        """Fill ``out`` (size x size, C order) with the Jacobian of the rates."""
        arrays = self.p, self.c, x, self._w, self._blocks, self._y, out
        call("first_order_jacobian", *arrays, self.angle, self.speed, t)


# Micrometres, and the velocities that go with them at some 1e4 rad/s; a ball's orbit and spin wander more.
_BALL_SCALE = np.array([1e-6, 1e-6, 1e-4, 1e-2, 1e-2, 1.0, 10.0, 10.0, 10.0])
_BODY_SCALE = np.array([1e-6] * 3 + [1e-4] * 2 + [1e-6] * 3 + [1e-4] * 3 + [1e-6] * 3 + [1e-4] * 3)
