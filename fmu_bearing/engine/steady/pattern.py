"""A pattern of the balls' places and spins that stays in axes at rest or turning, and the state it means.

Ball j of z is at the phase 2 pi j/z. What a ball does where it passes a phase the next one does a little
later: its rate is the pattern's slope times the speed at which balls run through the pattern,
n = orbit - whirl. The slope is of third order, taken more from where the balls come from: of the balls'
places and spins it keeps the first harmonics to 1e-3, and where a pocket opens or closes between two balls it
does not ring, as a spectral slope does. At rest (whirl 0) the pattern belongs to loads across the axis; a
cage that whirls in its lands takes the pattern and the rings with it; all turn at one speed.
"""

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import PT, STRIDE, P, Q, W, Y

#: Balls that a slope is made of, counted along the balls' way from two behind, and their weights.
BEHIND = -2
STENCIL = 4
_TWO_BEHIND, _BEHIND, _HERE, _AHEAD = 1.0 / 6.0, -1.0, 0.5, 1.0 / 3.0


@kernel
def slope_weight(p, k, ahead):
    """Weight (1/rad) of ball ``BEHIND + k`` in a slope; ``ahead``: 1 where balls run to larger phases, -1."""
    weight = _TWO_BEHIND if k == 0 else _BEHIND if k == 1 else _HERE if k == 2 else _AHEAD
    return ahead * weight * p[P.BALLS] / (2.0 * PI)


@kernel
def neighbour(p, j, k, ahead):
    """Ball ``BEHIND + k`` from ball ``j`` on along the balls' way."""
    balls = int(p[P.BALLS])
    step = BEHIND + k
    return (j + (step if ahead > 0.0 else -step) + 2 * balls) % balls


@kernel
def slope(p, x, row, j, ahead):
    """Slope (1/rad) at ball ``j`` of the numbers per ball at ``x[row:]``."""
    total = 0.0
    for k in range(STENCIL):
        total += slope_weight(p, k, ahead) * x[row + neighbour(p, j, k, ahead)]
    return total


@kernel
def tail(p):
    """Return the number of the first unknown behind the balls' own."""
    return PT.BALL * int(p[P.BALLS])


@kernel
def matrix_at(p, k):
    """Return the place in ``w`` of the matrix ``k`` of the unknowns: ``PT.MATRIX`` and those behind it."""
    unknowns = tail(p) + PT.TAIL
    return W.SOUND + int(p[P.SOUND_WORK]) + W.SPARE + k * unknowns * (unknowns + 1)


@kernel
def partner(i):
    """Coordinate that moves with ``i`` as its axes turn, and the sign: rate of ``i`` over speed and it.

    Its own number and 0 for what does not turn.
    """
    first = Q.INNER if i < Q.OUTER else Q.OUTER if i < Q.CAGE else Q.CAGE
    own = i - first
    if own == Q.Y:
        return i + 1, -1.0
    if own == Q.Z:
        return i - 1, 1.0
    tilt = Q.INNER_BY if first == Q.INNER else Q.BY
    if own == tilt:
        return i + 1, -1.0
    if own == tilt + 1:
        return i - 1, 1.0
    return i, 0.0


@kernel
def take(p, y, whirl, w):
    """Put the state ``y`` to the unknowns; ``whirl`` in rad/s."""
    balls = int(p[P.BALLS])
    at = W.PATTERN + PT.UNKNOWNS
    last = at + tail(p)
    orbit = 0.0
    # the pattern counts from the cage's angle; without a cage from the mean of the balls
    turned = y[Y.Q0 + Q.CAGE + Q.TURN] if p[P.CAGE] != 0.0 else 0.0
    for j in range(balls):
        w[at + j] = y[Y.X + j]
        w[at + balls + j] = y[Y.R + j]
        w[at + 2 * balls + j] = y[Y.TH + j] - 2.0 * PI * j / balls - turned
        for i in range(3):
            w[at + (PT.PLACED + i) * balls + j] = y[Y.WX + i * STRIDE + j]
        orbit += y[Y.OM + j] / balls
    for i in range(Q.SIZE):
        w[last + i] = y[Y.Q0 + i]
    w[last + Q.CAGE + Q.TURN] = 0.0
    w[last + PT.ORBIT] = orbit
    w[last + PT.WHIRL] = whirl


@kernel
def show(p, ahead, w, y):
    """Put the unknowns to the state ``y``: places and rates; spare lanes follow the first ball."""
    balls = int(p[P.BALLS])
    at = W.PATTERN + PT.UNKNOWNS
    last = at + tail(p)
    orbit = w[last + PT.ORBIT]
    whirl = w[last + PT.WHIRL]
    through = orbit - whirl
    for lane in range(int(p[P.LANES])):
        j = lane if lane < balls else 0
        y[Y.X + lane] = w[at + j]
        y[Y.R + lane] = w[at + balls + j]
        y[Y.TH + lane] = 2.0 * PI * j / balls + w[at + 2 * balls + j]
        y[Y.VX + lane] = through * slope(p, w, at, j, ahead)
        y[Y.VR + lane] = through * slope(p, w, at + balls, j, ahead)
        y[Y.OM + lane] = orbit + through * slope(p, w, at + 2 * balls, j, ahead)
        for i in range(3):
            y[Y.WX + i * STRIDE + lane] = w[at + (PT.PLACED + i) * balls + j]
    for i in range(Q.SIZE):
        other, sign = partner(i)
        y[Y.Q0 + i] = w[last + i]
        y[Y.V0 + i] = sign * whirl * w[last + other]
    if p[P.CAGE] != 0.0:
        y[Y.V0 + Q.CAGE + Q.TURN] = orbit
