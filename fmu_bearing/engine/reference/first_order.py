"""Fidelity ``full`` as x' = g(t, x), for general-purpose integrators.

``x`` holds nine rows of one number per ball (x, r, theta, their rates, spin), then 17 coordinates of the
bodies and their 17 rates, as ``y`` in ``engine.layout.y`` without its spare lanes.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, F, J, P, Q, Y
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.newton.jacobian import jacobian


@kernel
def spread(p, x, y):
    """Copy ``x`` into ``y``; the spare lanes take ball 0, as everywhere in the engine."""
    balls = int(p[P.BALLS])
    for i in range(J.STATES):
        for j in range(int(p[P.LANES])):
            y[i * STRIDE + j] = x[i * balls + (j if j < balls else 0)]
    for i in range(J.BODIES):
        y[Y.Q0 + i] = x[J.STATES * balls + i]


@kernel
def first_order(p, c, angle, speed, t, x, w, f, y, dx):
    """Fill ``dx`` with the rates of ``x`` (SI) at ``t`` (s) after the shaft was at ``angle`` (rad).

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


@kernel
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
