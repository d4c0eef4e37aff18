"""Steady state with equal balls evenly spaced and the cage centred: a fixed point of eleven unknowns.

Unknowns: place x, r of the balls (m), their spin x, r, theta (rad/s), their orbit, which is the cage's
turning (rad/s), the inner ring along the axis, the outer one along and about it, the lead of the balls in
their pockets (rad), the cage along the axis. Each has an equation of the right-hand side: the mean of the
balls' accelerations (without weight, which the mean takes out), and the bodies' accelerations. Newton's
method with the engine's own Jacobian; steps are limited, and halved where the balance gets worse.
"""

import math

from fmu_bearing.engine.choices import OUTER_GUIDED
from fmu_bearing.engine.dense import eliminate
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import PT, STRIDE, C, F, J, P, Q, R, W, Y
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.newton.body_slopes import inertia
from fmu_bearing.engine.newton.jacobian import jacobian
from fmu_bearing.engine.steady.pattern import matrix_at

#: Rings that are fixed.
NONE, OUTER, BOTH = range(3)

_ROUNDS = 60
_HALVINGS = 8
# Longest step: about the approach of a loaded contact, and a few times the slide-to-roll ratio at which
# traction levels off.
_FAR = 3e-6  # m
_TURNED = 0.03  # of the spin
_LOADED = 1e-3  # N: with less at a race its ball is loose
_FREE = 1.0  # rad: of the outer ring on its seat
_PRESSED = 5e-7  # m: into a pocket at first; one that is not touched has no slope
# Steps below this share of the longest end the search: the next one would be the square of it.
_SETTLED = 1e-5
_BALANCED = 1e-4  # N per ball: what may then be out of balance; contacts carry 1 N and more

# unknowns, each with the equation of the same number
_ORBIT = 5  # behind x, r and the spins, with the equation of the orbit
_INNER, _OUTER, _TURN, _LEAD, _CAGE = range(_ORBIT + 1, PT.EVEN)


@kernel
def ball_column(k):
    """State of a ball (column of blocks B, D of the Jacobian) that unknown ``k`` moves."""
    if k <= 1:
        return k
    if k == _ORBIT:
        return (Y.OM - Y.X) // STRIDE
    if k == _LEAD:
        return (Y.TH - Y.X) // STRIDE
    return (Y.WX - Y.X) // STRIDE + k - 2


@kernel
def ball_equation(k):
    """Acceleration of a ball (row of block B) that equation ``k`` is made of; x, r, spins, orbit."""
    if k <= 1:
        return k
    return F.TH // STRIDE if k == _ORBIT else F.WX // STRIDE + k - 2


@kernel
def body_of(k):
    """Coordinate of the bodies that unknown or equation ``k`` belongs to; that of the cage for the lead."""
    if k == _INNER:
        return Q.INNER + Q.X
    if k == _OUTER:
        return Q.OUTER + Q.X
    if k == _TURN:
        return Q.OUTER + Q.TURN
    return Q.CAGE + Q.TURN if k == _LEAD else Q.CAGE + Q.X


@kernel
def is_constrained(p, k, fixed):
    """Whether nothing moves unknown ``k``: rigid preload, a fixed ring, no cage.

    ``fixed``: 0 no ring, 1 the outer ring, 2 both.
    """
    if k == _INNER:
        return fixed >= BOTH or p[P.RIGID] != 0.0
    if k == _OUTER or k == _TURN:
        return fixed >= OUTER
    return k > _TURN and p[P.CAGE] == 0.0


@kernel
def lever(p, c, k):
    """Length (m) that makes a force of the moment in equation ``k``; 1 for a force."""
    if k < 2 or k == _INNER or k == _OUTER or k == _CAGE:
        return 1.0
    return c[C.BALL_RADIUS] if k < _ORBIT else p[P.PITCH_RADIUS]


@kernel
def weight(p, c, k):
    """Return what makes a force (N) per ball of the acceleration in equation ``k``."""
    if k < 2:
        return p[P.BALL_MASS]
    if k == _ORBIT:
        return p[P.BALL_MASS] * p[P.PITCH_RADIUS]
    if k < _ORBIT:
        return p[P.BALL_INERTIA] / c[C.BALL_RADIUS]
    return inertia(p, body_of(k)) / (lever(p, c, k) * p[P.BALLS])


@kernel
def out_of_balance(p, c, f, fixed, w):
    """Put forces (N per ball) out of balance, by equation, to ``PT.RESIDUAL``; their length."""
    at = W.PATTERN + PT.RESIDUAL
    total = 0.0
    balls = int(p[P.BALLS])
    for k in range(PT.EVEN):
        value = 0.0
        if k <= _ORBIT:
            row = ball_equation(k) * STRIDE
            for j in range(balls):
                value += f[row + j] / p[P.BALLS]
        elif not is_constrained(p, k, fixed):
            value = f[F.BODY + body_of(k)]
        value *= weight(p, c, k)
        w[at + k] = value
        total += value * value
    return math.sqrt(total)


@kernel
def column(p, k, i, jac):
    """Return the derivative of equation ``i`` by unknown ``k``, from the full Jacobian."""
    total = 0.0
    balls = int(p[P.BALLS])
    body = body_of(k)
    of_balls = k <= _ORBIT or k == _LEAD
    state = ball_column(k) if of_balls else 0
    if i <= _ORBIT:
        row = ball_equation(i)
        for j in range(balls):
            if of_balls:
                total += jac[J.B + (row * J.STATES + state) * STRIDE + j]
            else:
                total += jac[J.C + (row * J.BODIES + body) * STRIDE + j]
            if k == _ORBIT and p[P.CAGE] != 0.0:
                total += jac[J.C + (row * J.BODIES + Q.SIZE + Q.CAGE + Q.TURN) * STRIDE + j]
        return total / p[P.BALLS]
    row = body_of(i)
    if of_balls:
        for j in range(balls):
            total += jac[J.D + (row * J.STATES + state) * STRIDE + j]
        if k == _ORBIT and p[P.CAGE] != 0.0:
            total += jac[J.E + row * J.BODIES + Q.SIZE + Q.CAGE + Q.TURN]
        return total
    return jac[J.E + row * J.BODIES + body]


@kernel
def longest(p, c, k, spin):
    """Longest step of unknown ``k`` in its own unit; ``spin`` of a ball (rad/s)."""
    if 1 < k <= _ORBIT:
        return _TURNED * spin
    if k == _TURN:
        return _FREE  # no contact knows it
    return _FAR / lever(p, c, k)


@kernel
def newton_step(p, c, y, fixed, w, jac):
    """Put Newton's step, in shares of the longest, to ``PT.STEP``; its largest share, negative if none."""
    at = matrix_at(p, PT.MATRIX)
    spin = math.sqrt(y[Y.WX] * y[Y.WX] + y[Y.WR] * y[Y.WR] + y[Y.WT] * y[Y.WT]) + 1e-3
    for i in range(PT.EVEN):
        row = at + i * PT.EVEN_ROW
        largest = 0.0
        for k in range(PT.EVEN):
            value = 0.0
            if is_constrained(p, i, fixed) or is_constrained(p, k, fixed):
                value = 1.0 if i == k else 0.0
            else:
                value = weight(p, c, i) * column(p, k, i, jac) * longest(p, c, k, spin)
            w[row + k] = value
            largest = max(largest, abs(value))
        w[row + PT.EVEN] = -w[W.PATTERN + PT.RESIDUAL + i]
        per = 1.0 / (largest + 1e-300)
        for k in range(PT.EVEN_ROW):
            w[row + k] *= per
    if not eliminate(w, at, PT.EVEN):
        return -1.0
    most = 0.0
    for k in range(PT.EVEN):
        share = w[at + k * PT.EVEN_ROW + PT.EVEN]
        if not (abs(share) < 1e9):
            return -1.0
        most = max(most, abs(share))
        w[W.PATTERN + PT.STEP + k] = share * longest(p, c, k, spin)
    return most


@kernel
def move(p, y, share, w):
    """Go ``share`` of the step in ``PT.STEP`` from the state ``y``."""
    step = W.PATTERN + PT.STEP
    for k in range(PT.EVEN):
        by = share * w[step + k]
        if k <= _ORBIT or k == _LEAD:
            row = Y.X + ball_column(k) * STRIDE
            for j in range(int(p[P.LANES])):
                y[row + j] += by
        else:
            y[Y.Q0 + body_of(k)] += by
        if k == _ORBIT and p[P.CAGE] != 0.0:
            y[Y.V0 + Q.CAGE + Q.TURN] += by


@kernel
def equalise_balls(p, c, y, speed):
    """Make all balls of the state ``y`` equal, evenly spaced about a centred cage that they press."""
    balls = int(p[P.BALLS])
    outer = Y.Q0 + Q.OUTER
    for row in range(Y.ROWS):
        mean = 0.0
        for j in range(balls):
            value = y[row * STRIDE + j]
            if row == Y.R // STRIDE:
                # about the middle of the outer ring, which a soft pedestal lets down by millimetres
                radius = p[P.PITCH_RADIUS] + value
                aside = -radius * math.sin(y[Y.TH + j]) - y[outer + Q.Y]
                above = radius * math.cos(y[Y.TH + j]) - y[outer + Q.Z]
                value = math.sqrt(aside * aside + above * above) - p[P.PITCH_RADIUS]
            mean += value / p[P.BALLS]
        if row == Y.VX // STRIDE or row == Y.VR // STRIDE:
            mean = 0.0
        for j in range(int(p[P.LANES])):
            y[row * STRIDE + j] = mean
    # balls lag in the pockets of a cage that the inner ring drives, and lead in those of one that the outer
    # ring brakes; of one that balls guide nothing drives, and either side serves
    lag = (p[P.POCKET_CLEARANCE] + _PRESSED) / p[P.PITCH_RADIUS] if p[P.CAGE] != 0.0 else 0.0
    if (speed < 0.0) != (p[P.GUIDANCE] == OUTER_GUIDED):
        lag = -lag
    for j in range(int(p[P.LANES])):
        y[Y.TH + j] = (2.0 * math.pi * j / p[P.BALLS] if j < balls else 0.0) - lag
    for i in range(Q.SIZE):
        axial = i == Q.INNER or i == Q.OUTER or i == Q.CAGE or i == Q.OUTER + Q.TURN
        if not axial:
            y[Y.Q0 + i] = 0.0
        y[Y.V0 + i] = 0.0
    if p[P.CAGE] != 0.0:
        y[Y.V0 + Q.CAGE + Q.TURN] = y[Y.OM]


@kernel
def between_races(w):
    """Whether ball 0 presses both races at the state evaluated last; else nothing holds the rings."""
    return w[W.RACE + R.LOAD] > _LOADED and w[W.RACE + R.SIZE + R.LOAD] > _LOADED


@kernel
def settle_evenly(p, c, y, speed, fixed, w, jac):
    """Bring the state ``y`` of equal balls to rest at shaft ``speed`` (rad/s); whether that succeeds.

    ``y`` comes from :func:`equalise_balls`, ``c`` has no imperfections; ``fixed``: see
    :func:`is_constrained`; ``jac``: scratch for a Jacobian. On failure ``y`` is where Newton's method was
    left.
    """
    f = w[W.F0 : W.F0 + F.SIZE]
    for _ in range(_ROUNDS):
        jacobian(p, c, y, 0.0, speed, 0.0, w, jac)
        before = out_of_balance(p, c, f, fixed, w)
        most = newton_step(p, c, y, fixed, w, jac)
        if most < 0.0:
            return False
        share = 1.0 / max(most, 1.0)
        move(p, y, share, w)
        for _ in range(_HALVINGS):
            right_hand_side(p, c, y, 0.0, speed, 0.0, w, f)
            after = out_of_balance(p, c, f, fixed, w)
            if most < _SETTLED and after < _BALANCED:
                return between_races(w)
            if after < before:
                break
            share *= 0.5
            move(p, y, -share, w)
    return False
