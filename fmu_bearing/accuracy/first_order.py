"""Fidelity ``full`` as x' = g(t, x), for general-purpose integrators.

``x`` holds nine rows of one number per ball (x, r, theta, their rates, spin), then 17 coordinates of the
bodies and their 17 rates, as ``y`` in ``engine.layout.y`` without its spare lanes.
"""

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.jit import entry, kernel
from fmu_bearing.engine.layout import STRIDE, C, F, J, P, Q, S, Y
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.newton.jacobian import jacobian
from fmu_bearing.run.arrays import RINGS, Arrays


@kernel
def spread(p, x, y):
    """Copy ``x`` into ``y``; the spare lanes take ball 0, as everywhere in the engine."""
    balls = int(p[P.BALLS])
    for i in range(J.STATES):
        for j in range(int(p[P.LANES])):
            y[i * STRIDE + j] = x[i * balls + (j if j < balls else 0)]
    for i in range(J.BODIES):
        y[Y.Q0 + i] = x[J.STATES * balls + i]


@entry
def first_order(p, c, angle, speed, t, x, w, f, y, dx):
    """Fill ``dx`` with the rates of ``x`` (SI) at ``t`` (s) after the shaft stood at ``angle`` (rad).

    ``p`` parameters, ``c`` conditions, ``speed`` of the shaft (rad/s, constant); ``w``, ``f``, ``y`` scratch.
    """
    balls = int(p[P.BALLS])
    rates = J.PLACED * balls
    body = J.STATES * balls
    spread(p, x, y)
    right_hand_side(p, c, y, angle + speed * t, speed, 0.0, w, f)
    for i in range(rates):
        dx[i] = x[rates + i]
    for i in range(J.BALL):
        for j in range(balls):
            dx[rates + i * balls + j] = f[i * STRIDE + j]
    for i in range(Q.SIZE):
        dx[body + i] = y[Y.V0 + i]
        dx[body + Q.SIZE + i] = f[F.BODY + i]


@entry
def first_order_jacobian(p, c, angle, speed, t, x, w, blocks, y, out):
    """Fill the dense matrix ``out`` with d(dx)/dx from the blocks of the engine's own Jacobian."""
    balls = int(p[P.BALLS])
    rates = J.PLACED * balls
    body = J.STATES * balls
    spread(p, x, y)
    jacobian(p, c, y, angle + speed * t, speed, 0.0, w, blocks)
    for i in range(out.shape[0]):
        for k in range(out.shape[0]):
            out[i, k] = 0.0
    for j in range(balls):
        for k in range(J.PLACED):
            out[k * balls + j, rates + k * balls + j] = 1.0
        for i in range(J.BALL):
            for k in range(J.STATES):
                out[rates + i * balls + j, k * balls + j] = blocks[J.B + (i * J.STATES + k) * STRIDE + j]
            for g in range(J.BODIES):
                out[rates + i * balls + j, body + g] = blocks[J.C + (i * J.BODIES + g) * STRIDE + j]
        for i in range(Q.SIZE):
            for k in range(J.STATES):
                out[body + Q.SIZE + i, k * balls + j] = blocks[J.D + (i * J.STATES + k) * STRIDE + j]
    for i in range(Q.SIZE):
        out[body + i, body + Q.SIZE + i] = 1.0
        for g in range(J.BODIES):
            out[body + Q.SIZE + i, body + g] = blocks[J.E + i * J.BODIES + g]


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
        first_order(self.p, self.c, self.angle, self.speed, t, x, self._w, self._f, self._y, dx)

    def jacobian(self, t: float, x: NDArray[np.float64], out: NDArray[np.float64]) -> None:
        """Fill ``out`` (size x size, C order) with the Jacobian of the rates."""
        first_order_jacobian(
            self.p, self.c, self.angle, self.speed, t, x, self._w, self._blocks, self._y, out
        )


# Micrometres, and the velocities that go with them at some 1e4 rad/s; a ball's orbit and spin wander more.
_BALL_SCALE = np.array([1e-6, 1e-6, 1e-4, 1e-2, 1e-2, 1.0, 10.0, 10.0, 10.0])
_BODY_SCALE = np.array([1e-6] * 3 + [1e-4] * 2 + [1e-6] * 3 + [1e-4] * 3 + [1e-6] * 3 + [1e-4] * 3)
