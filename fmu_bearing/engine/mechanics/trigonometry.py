"""Sine and cosine of four balls' angles without a branch, and angles within one turn."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, select, store
from fmu_bearing.engine.layout import FOUR, W
from fmu_bearing.engine.mechanics.powers import ROUND

# Cody-Waite split of pi/2: like the rounding constant it needs strict floating point.
_TWO_OVER_PI = 0.6366197723675814
_HALF_PI_HIGH = 1.5707963267341256
_HALF_PI_LOW = 6.077100506506192e-11
TWO_PI = 6.283185307179586


@kernel
def wrap(angle):
    """Angle brought into [-pi, pi] (rad); exact to rounding for a few turns."""
    turns = (angle * (1.0 / TWO_PI) + ROUND) - ROUND
    return angle - turns * TWO_PI


@kernel
def cosine_and_sine(x):
    """Cosine and sine of four angles (rad, a few turns at most).

    Taylor series to degrees 16 and 15 on [-pi/4, pi/4]: truncation below 5e-17.
    """
    n = (x * _TWO_OVER_PI + ROUND) - ROUND
    t = (x - n * _HALF_PI_HIGH) - n * _HALF_PI_LOW
    t2 = t * t
    s = -1.0 / 39916800 + t2 * (1.0 / 6227020800 - t2 * (1.0 / 1307674368000.0))
    s = -1.0 / 5040 + t2 * (1.0 / 362880 + t2 * s)
    s = -1.0 / 6 + t2 * (1.0 / 120 + t2 * s)
    s = t + t * t2 * s
    c = 1.0 / 479001600 - t2 * (1.0 / 87178291200 - t2 * (1.0 / 20922789888000.0))
    c = 1.0 / 40320 + t2 * (-1.0 / 3628800 + t2 * c)
    c = 1.0 / 24 + t2 * (-1.0 / 720 + t2 * c)
    c = 1.0 + t2 * (-0.5 + t2 * c)
    quarter = n - 4.0 * ((n * 0.25 - 0.375 + ROUND) - ROUND)  # 0, 1, 2 or 3
    odd = (quarter == 1.0) | (quarter == 3.0)
    sine = select(odd, c, s)
    cosine = select(odd, s, c)
    cosine = select((quarter == 1.0) | (quarter == 2.0), -cosine, cosine)
    return cosine, select(quarter >= 2.0, -sine, sine)


@kernel
def ball_angles(angle, at, lanes, w):
    """Write cosine and sine of ``angle[at + j]`` (rad, a few turns at most) into their rows of ``w``."""
    for j in range(0, lanes, FOUR):
        cosine, sine = cosine_and_sine(load(angle, at + j))
        store(w, W.COS + j, cosine)
        store(w, W.SIN + j, sine)
