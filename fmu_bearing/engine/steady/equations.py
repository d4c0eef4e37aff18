"""What is out of balance in a pattern, and its derivatives by all unknowns.

In the order of the unknowns: the balls' accelerations minus what running through the pattern means; the
bodies' accelerations minus what turning with it means; then, as there is one unknown too many for each, that
the cage (without one: the mean of the balls) keeps its angle, and that a whirling cage is off its middle
along z. Forces in N, moments over a lever.
"""

import math

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import PT, STRIDE, C, F, J, P, Q, W, Y
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.newton.body_slopes import inertia
from fmu_bearing.engine.newton.jacobian import is_angle
from fmu_bearing.engine.steady.even import BOTH, OUTER
from fmu_bearing.engine.steady.pattern import (
    STENCIL,
    matrix_at,
    neighbour,
    partner,
    slope,
    slope_weight,
    tail,
)


@kernel
def rate_row(i):
    """Row of ``y`` of the rate whose change is acceleration ``i`` of a ball."""
    return Y.VX + i * STRIDE


@kernel
def ball_weight(p, c, i):
    """Return what makes a force (N) of acceleration ``i`` of a ball."""
    if i >= PT.PLACED:
        return p[P.BALL_INERTIA] / c[C.BALL_RADIUS]
    return p[P.BALL_MASS] * (p[P.PITCH_RADIUS] if i == PT.PLACED - 1 else 1.0)


@kernel
def body_weight(p, i):
    """Return what makes a force (N) of the acceleration of the bodies' coordinate ``i``."""
    if i >= Q.CAGE and p[P.CAGE] == 0.0:
        return 0.0
    return inertia(p, i) / (p[P.PITCH_RADIUS] if is_angle(i) else 1.0)


@kernel
def is_fixed(p, i, fixed):
    """Whether nothing moves the bodies' coordinate ``i``.

    ``fixed``: see `even.is_constrained`. The angle of the cage is where the pattern counts from.
    """
    if i >= Q.CAGE:
        return p[P.CAGE] == 0.0
    if i >= Q.OUTER:
        return fixed >= OUTER
    return fixed >= BOTH or (i == Q.INNER + Q.X and p[P.RIGID] != 0.0)


@kernel
def without_weight(p, w, f):
    """Take gravity out of accelerations: it does not turn with a whirl."""
    if p[P.GRAVITY] == 0.0:
        return
    for j in range(int(p[P.LANES])):
        f[F.R + j] += GRAVITY * w[W.COS + j]
        f[F.TH + j] -= GRAVITY * w[W.SIN + j] / p[P.PITCH_RADIUS]
    for i in (Q.INNER + Q.Z, Q.OUTER + Q.Z, Q.CAGE + Q.Z):
        f[F.BODY + i] += GRAVITY


@kernel
def residual(p, c, y, f, fixed, ahead, whirls, w):
    """Put what is out of balance at the state ``y`` with its right-hand side ``f`` to ``PT.RESIDUAL``.

    Returns its length (N).
    """
    balls = int(p[P.BALLS])
    at = W.PATTERN + PT.RESIDUAL
    unknown = W.PATTERN + PT.UNKNOWNS
    last = tail(p)
    whirl = w[unknown + last + PT.WHIRL]
    through = w[unknown + last + PT.ORBIT] - whirl
    if whirls:
        without_weight(p, w, f)
    total = 0.0
    for i in range(PT.BALL):
        for j in range(balls):
            value = f[F.X + i * STRIDE + j] - through * slope(p, y, rate_row(i), j, ahead)
            value *= ball_weight(p, c, i)
            w[at + i * balls + j] = value
            total += value * value
    for i in range(Q.SIZE):
        _, turns = partner(i)
        value = f[F.BODY + i] + turns * turns * whirl * whirl * w[unknown + last + i]
        value *= 0.0 if is_fixed(p, i, fixed) else body_weight(p, i)
        w[at + last + i] = value
        total += value * value
    w[at + last + PT.ORBIT] = 0.0
    w[at + last + PT.WHIRL] = 0.0
    if p[P.CAGE] == 0.0:
        for j in range(balls):
            w[at + last + PT.ORBIT] += w[unknown + 2 * balls + j]
    return math.sqrt(total)


@kernel
def out_of_balance(p, c, speed, y, fixed, ahead, whirls, w, f):
    """As :func:`residual`, with the right-hand side evaluated into ``f``."""
    right_hand_side(p, c, y, 0.0, speed, 0.0, w, f)
    return residual(p, c, y, f, fixed, ahead, whirls, w)


@kernel
def ball_rows(p, c, y, ahead, w, jac):
    """Rows of the balls' equations."""
    balls = int(p[P.BALLS])
    last = tail(p)
    size = last + PT.TAIL
    unknown = W.PATTERN + PT.UNKNOWNS
    first = matrix_at(p, PT.MATRIX)
    whirl = w[unknown + last + PT.WHIRL]
    through = w[unknown + last + PT.ORBIT] - whirl
    turn = Q.CAGE + Q.TURN
    for i in range(PT.BALL):
        for j in range(balls):
            row = first + (i * balls + j) * (size + 1)
            own = J.B + i * J.STATES * STRIDE + j
            by_body = J.C + i * J.BODIES * STRIDE + j
            by_orbit = jac[own + (PT.PLACED + 2) * STRIDE]
            by_whirl = 0.0
            for k in range(PT.BALL):
                by_rate = jac[own + (PT.PLACED + k) * STRIDE]
                if k < PT.PLACED:
                    w[row + k * balls + j] += jac[own + k * STRIDE]
                    rising = slope(p, w, unknown + k * balls, j, ahead)
                    by_orbit += by_rate * rising
                    by_whirl -= by_rate * rising
                    for n in range(STENCIL):
                        near = row + k * balls + neighbour(p, j, n, ahead)
                        w[near] += through * slope_weight(p, n, ahead) * by_rate
                else:
                    w[row + k * balls + j] += by_rate
            # what running through the pattern means: a rate's slope, and a place's twice
            for n in range(STENCIL):
                near = neighbour(p, j, n, ahead)
                share = through * slope_weight(p, n, ahead)
                if i >= PT.PLACED:
                    w[row + i * balls + near] -= share
                    continue
                for m in range(STENCIL):
                    second = row + i * balls + neighbour(p, near, m, ahead)
                    w[second] -= share * through * slope_weight(p, m, ahead)
            bend = 0.0
            if i >= PT.PLACED:
                bend = slope(p, w, unknown + i * balls, j, ahead)
            else:
                for n in range(STENCIL):
                    near = neighbour(p, j, n, ahead)
                    bend += 2.0 * through * slope_weight(p, n, ahead) * slope(
                        p, w, unknown + i * balls, near, ahead
                    )  # fmt: skip
            if p[P.CAGE] != 0.0:
                by_orbit += jac[by_body + (Q.SIZE + turn) * STRIDE]
            for k in range(Q.SIZE):
                other, sign = partner(k)
                by_rate = sign * jac[by_body + (Q.SIZE + k) * STRIDE]
                w[row + last + k] += jac[by_body + k * STRIDE]
                w[row + last + other] += whirl * by_rate
                by_whirl += by_rate * w[unknown + last + other]
            w[row + last + PT.ORBIT] = by_orbit - bend
            w[row + last + PT.WHIRL] = by_whirl + bend
            factor = ball_weight(p, c, i)
            for k in range(size):
                w[row + k] *= factor


@kernel
def body_rows(p, fixed, ahead, w, jac):
    """Rows of the bodies' equations, and the two behind them."""
    balls = int(p[P.BALLS])
    last = tail(p)
    size = last + PT.TAIL
    unknown = W.PATTERN + PT.UNKNOWNS
    first = matrix_at(p, PT.MATRIX)
    whirl = w[unknown + last + PT.WHIRL]
    through = w[unknown + last + PT.ORBIT] - whirl
    turn = Q.CAGE + Q.TURN
    for i in range(Q.SIZE):
        row = first + (last + i) * (size + 1)
        if is_fixed(p, i, fixed):
            w[row + last + i] = 1.0
            continue
        by_orbit = jac[J.E + i * J.BODIES + Q.SIZE + turn] if p[P.CAGE] != 0.0 else 0.0
        by_whirl = 0.0
        for k in range(PT.BALL):
            for j in range(balls):
                by = J.D + i * J.STATES * STRIDE + j
                by_rate = jac[by + (PT.PLACED + k) * STRIDE]
                if k >= PT.PLACED:
                    w[row + k * balls + j] += by_rate
                    continue
                w[row + k * balls + j] += jac[by + k * STRIDE]
                rising = slope(p, w, unknown + k * balls, j, ahead)
                by_orbit += by_rate * rising
                by_whirl -= by_rate * rising
                if k == PT.PLACED - 1:
                    by_orbit += by_rate
                for n in range(STENCIL):
                    near = row + k * balls + neighbour(p, j, n, ahead)
                    w[near] += through * slope_weight(p, n, ahead) * by_rate
        for k in range(Q.SIZE):
            other, sign = partner(k)
            by_rate = sign * jac[J.E + i * J.BODIES + Q.SIZE + k]
            w[row + last + k] += jac[J.E + i * J.BODIES + k]
            w[row + last + other] += whirl * by_rate
            by_whirl += by_rate * w[unknown + last + other]
        _, turns = partner(i)
        w[row + last + i] += turns * turns * whirl * whirl
        by_whirl += 2.0 * turns * turns * whirl * w[unknown + last + i]
        w[row + last + PT.ORBIT] = by_orbit
        w[row + last + PT.WHIRL] = by_whirl
        factor = body_weight(p, i)
        for k in range(size):
            w[row + k] *= factor


@kernel
def last_rows(p, whirls, w):
    """Rows behind the bodies' own: where the pattern counts from, and how a whirl lies in its axes."""
    balls = int(p[P.BALLS])
    last = tail(p)
    width = last + PT.TAIL + 1
    row = matrix_at(p, PT.MATRIX) + (last + PT.ORBIT) * width
    if p[P.CAGE] != 0.0:
        w[row + last + Q.CAGE + Q.TURN] = 1.0
    else:
        for j in range(balls):
            w[row + 2 * balls + j] = 1.0
    row += width
    w[row + last + (Q.CAGE + Q.Y if whirls else PT.WHIRL)] = 1.0


@kernel
def derivatives(p, c, y, fixed, ahead, whirls, w, jac):
    """Fill ``PT.MATRIX`` with the derivatives of the balance by the unknowns, from the full Jacobian."""
    size = tail(p) + PT.TAIL
    at = matrix_at(p, PT.MATRIX)
    for i in range(size * (size + 1)):
        w[at + i] = 0.0
    ball_rows(p, c, y, ahead, w, jac)
    body_rows(p, fixed, ahead, w, jac)
    last_rows(p, whirls, w)
