"""One evaluation per step: Newmark's method with one Newton iteration, for a bearing that has settled.

Trapezoidal rates; places with beta = 1/12 for rings and cage (Fox and Goodwin 1949: fourth order for free
vibration), for the balls 1/12 as well where the step resolves their modes and 1/4 where it does not. The
rates it keeps are off the true ones by h^2/12 times the rate of the accelerations; :func:`true_rates` takes
that away for what people read. It gives no estimate of its error: ``fast`` measures one every few steps.
"""

from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import F, Q, W, Y
from fmu_bearing.engine.layout.sizes import STRIDE
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.newton.block_arrow import solve

PLACES = 3 * STRIDE
RATES = 6 * STRIDE
BETA = 1.0 / 12.0
BETA_BALL = 0.25


@inlined
def advance(x, v, a, h, out, n):
    """``out = x + h v + h^2/2 a`` over ``n`` numbers."""
    half = 0.5 * h * h
    for i in range(n):
        out[i] = x[i] + h * v[i] + half * a[i]


@inlined
def add(x, scale, y, n):
    """``x += scale * y`` over ``n`` numbers."""
    for i in range(n):
        x[i] += scale * y[i]


@kernel
def predict(y, a, h, new, new_a):
    """Places and rates after ``h`` at unchanged accelerations ``a``."""
    advance(y[:PLACES], y[PLACES:], a, h, new[:PLACES], PLACES)
    advance(y[Y.Q0 : Y.V0], y[Y.V0 :], a[F.BODY :], h, new[Y.Q0 : Y.V0], Q.SIZE)
    rates = new[PLACES : PLACES + RATES]
    old = y[PLACES : PLACES + RATES]
    for i in range(RATES):
        rates[i] = old[i] + h * a[i]
    for i in range(Q.SIZE):
        new[Y.V0 + i] = y[Y.V0 + i] + h * a[F.BODY + i]
    for i in range(F.SIZE):
        new_a[i] = a[i]


@inlined
def iterate(p, c, angle, speed, speed_rate, h, beta_ball, fac, co, si, new, new_a, w):
    """One Newton iteration on the state ``new`` and its accelerations; the increment stays in ``w[W_D:]``.

    ``angle``, ``speed`` at the end of the step; ``co``, ``si`` of the orbit angle since the Jacobian.
    """
    d = w[W.D : W.D + F.SIZE]
    f = w[W.F : W.F0]
    right_hand_side(p, c, new, angle, speed, speed_rate, w, f)
    for i in range(RATES + Q.SIZE):
        d[i] = f[i] - new_a[i]
    solve(p, fac, co, si, d, w)
    add(new_a, 1.0, d, RATES + Q.SIZE)
    add(new[PLACES : PLACES + RATES], 0.5 * h, d, RATES)
    add(new[:PLACES], beta_ball * h * h, d, PLACES)
    add(new[Y.V0 :], 0.5 * h, d[F.BODY :], Q.SIZE)
    add(new[Y.Q0 : Y.V0], BETA * h * h, d[F.BODY :], Q.SIZE)
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
    rates = y[PLACES : PLACES + RATES]
    for i in range(RATES):
        rates[i] -= third * (3.0 * a[i] - 4.0 * before[i] + earlier[i])
    for i in range(Q.SIZE):
        y[Y.V0 + i] -= third * (3.0 * a[F.BODY + i] - 4.0 * before[F.BODY + i] + earlier[F.BODY + i])
