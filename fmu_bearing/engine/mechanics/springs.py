"""Springs and dampers between neighbouring balls in place of a cage (impact-noise paper, 1e5 to 2.5e7 N/m).

Each joins the centres of two balls along their chord, in the plane of the balls, and is slack where balls
lie evenly on the circle of their mean radius: a circle that grows stretches none. Pulls are equal and
opposite, so that balls that move together are free.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import F, P, W, Y


@kernel
def chord(p, y, w, j, k):
    """Length (m) of the chord from ball ``j`` to the next one ``k``, and its slopes.

    By the radius of ``j``, by that of ``k`` (1), by the angle (m) of ``k``; that by the angle of ``j`` is its
    opposite.
    """
    one = p[P.PITCH_RADIUS] + y[Y.R + j]
    two = p[P.PITCH_RADIUS] + y[Y.R + k]
    cos = w[W.COS + k] * w[W.COS + j] + w[W.SIN + k] * w[W.SIN + j]
    sin = w[W.SIN + k] * w[W.COS + j] - w[W.COS + k] * w[W.SIN + j]
    length = math.sqrt(one * one + two * two - 2.0 * one * two * cos)
    return length, (one - two * cos) / length, (two - one * cos) / length, one * two * sin / length


@kernel
def mean(p, y, row):
    """Mean over the balls of the numbers at ``y[row:]``."""
    total = 0.0
    for j in range(int(p[P.BALLS])):
        total += y[row + j] / p[P.BALLS]
    return total


@kernel
def spring_forces(p, y, w, f):
    """Add what the springs do to the balls' accelerations in ``f``; returns the power lost (W).

    Reads sines and cosines of the balls' angles in ``w``. Spare lanes get what ball 0 gets.
    """
    balls = int(p[P.BALLS])
    share = 2.0 * math.sin(PI / balls)  # of a chord in the radius of its circle
    slack = share * (p[P.PITCH_RADIUS] + mean(p, y, Y.R))
    growing = share * mean(p, y, Y.VR)
    damping = p[P.SPRING_DAMPING]
    lost = 0.0
    total = 0.0
    for j in range(balls):
        k = j + 1 if j + 1 < balls else 0
        length, by_one, by_two, by_angle = chord(p, y, w, j, k)
        rate = by_one * y[Y.VR + j] + by_two * y[Y.VR + k] + by_angle * (y[Y.OM + k] - y[Y.OM + j]) - growing
        pull = p[P.SPRINGS] * (length - slack) + damping * rate
        one = p[P.PITCH_RADIUS] + y[Y.R + j]
        two = p[P.PITCH_RADIUS] + y[Y.R + k]
        f[F.R + j] -= pull * by_one / p[P.BALL_MASS]
        f[F.R + k] -= pull * by_two / p[P.BALL_MASS]
        f[F.TH + j] += pull * by_angle / (p[P.BALL_MASS] * one * one)
        f[F.TH + k] -= pull * by_angle / (p[P.BALL_MASS] * two * two)
        total += pull
        lost += damping * rate * rate
    for j in range(balls):
        f[F.R + j] += share * total / (p[P.BALLS] * p[P.BALL_MASS])
    for lane in range(balls, int(p[P.LANES])):
        f[F.R + lane] = f[F.R]
        f[F.TH + lane] = f[F.TH]
    return lost


@kernel
def spring_energy(p, y, w):
    """Elastic energy (J) of the springs between the balls."""
    balls = int(p[P.BALLS])
    slack = 2.0 * math.sin(PI / balls) * (p[P.PITCH_RADIUS] + mean(p, y, Y.R))
    total = 0.0
    for j in range(balls):
        length, _, _, _ = chord(p, y, w, j, j + 1 if j + 1 < balls else 0)
        total += 0.5 * p[P.SPRINGS] * (length - slack) * (length - slack)
    return total
