"""One evaluation per step: Newmark's method with one Newton iteration, for a bearing that has settled.

Trapezoidal rates; places with beta = 1/12 for rings and cage (Fox and Goodwin 1949: fourth order for free
vibration), for the balls 1/12 as well where the step resolves their modes and 1/4 where it does not. The
rates it keeps are off the true ones by h^2/12 times the rate of the accelerations; :func:`true_rates` takes
that away for the outputs. It gives no estimate of its error: ``blocks`` measures one every few steps.
"""

from fmu_bearing.engine.fidelities.full.vectors import add_scaled, sum_scaled
from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import F, Q, W, Y
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.newton.block_arrow import solve

BETA = 1.0 / 12.0
BETA_BALL = 0.25


@inlined
def advance(x, v, a, h, out, n):
    """``out = x + h v + h^2/2 a`` over ``n`` numbers."""
    half = 0.5 * h * h
    for i in range(n):
        out[i] = x[i] + h * v[i] + half * a[i]


@kernel
def predict(y, a, h, new, new_a):
    """Places and rates after ``h`` at unchanged accelerations ``a``."""
    advance(y[: Y.PLACES], y[Y.VX :], a, h, new[: Y.PLACES], Y.PLACES)
    advance(y[Y.Q0 : Y.V0], y[Y.V0 :], a[F.BODY :], h, new[Y.Q0 : Y.V0], Q.SIZE)
    sum_scaled(y[Y.VX : Y.Q0], h, a, new[Y.VX : Y.Q0], Y.RATES)
    sum_scaled(y[Y.V0 :], h, a[F.BODY :], new[Y.V0 :], Q.SIZE)
    for i in range(F.SIZE):
        new_a[i] = a[i]


@inlined
def iterate(p, c, angle, speed, speed_rate, h, beta_ball, fac, co, si, new, new_a, w):
    """One Newton iteration on the state ``new`` and its accelerations; the increment stays in ``w[W.D:]``.

    ``angle``, ``speed`` at the end of the step; ``co``, ``si`` of the orbit angle since the Jacobian.
    """
    d = w[W.D : W.D + F.SIZE]
    f = w[W.F : W.F + F.SIZE]
    right_hand_side(p, c, new, angle, speed, speed_rate, w, f)
    for i in range(Y.RATES + Q.SIZE):
        d[i] = f[i] - new_a[i]
    solve(p, fac, co, si, d, w)
    add_scaled(1.0, d, new_a, Y.RATES + Q.SIZE)
    add_scaled(0.5 * h, d, new[Y.VX : Y.Q0], Y.RATES)
    add_scaled(beta_ball * h * h, d, new[: Y.PLACES], Y.PLACES)
    add_scaled(0.5 * h, d[F.BODY :], new[Y.V0 :], Q.SIZE)
    add_scaled(BETA * h * h, d[F.BODY :], new[Y.Q0 : Y.V0], Q.SIZE)
    for i in range(F.WORK, F.SIZE):
        new_a[i] = f[i]


@kernel
def true_rates(kept, h, a, before, earlier, y):
    """State ``y`` with the rates freed of the trapezoidal rule's lead, from three accelerations ``h`` apart.

    ``h`` negative turns true rates into the method's own.
    """
    for i in range(Y.SIZE):
        y[i] = kept[i]
    third = h / 24.0
    rates = y[Y.VX : Y.Q0]
    for i in range(Y.RATES):
        rates[i] -= third * (3.0 * a[i] - 4.0 * before[i] + earlier[i])
    for i in range(Q.SIZE):
        y[Y.V0 + i] -= third * (3.0 * a[F.BODY + i] - 4.0 * before[F.BODY + i] + earlier[F.BODY + i])
