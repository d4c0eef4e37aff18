"""Seals: a torque between the rings whose amount is constant, against their turning.

Seals sit in the outer ring and rub on the inner one. Their torque takes sense and size from the speed between
both: as x/(1 + x^8)^(1/8), x over 1 rad/s, below which rolling resistance is rounded, too. Above 13 rad/s the
torque is whole to 2e-10, where an x/(1 + x^2)^(1/2) would leave out 3e-3. All that is lost heats the inner
ring: it arises on its surface, and rubber conducts less than a hundredth of what steel does.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import F, P, Q, Y


@kernel
def seal_moment(p, slide):
    """Return the moment (N m) of the seals where the inner ring turns by ``slide`` (rad/s) in the outer."""
    square = slide * slide
    fourth = square * square
    return p[P.SEAL_TORQUE] * slide / math.sqrt(math.sqrt(math.sqrt(1.0 + fourth * fourth)))


@kernel
def seal_slope(p, slide):
    """Return the derivative (N m s/rad) of `seal_moment` by the speed."""
    square = slide * slide
    fourth = square * square
    whole = 1.0 + fourth * fourth
    return p[P.SEAL_TORQUE] / (whole * math.sqrt(math.sqrt(math.sqrt(whole))))


@kernel
def seal_friction(p, y, speed, f):
    """Add the seals to shaft torque, moment on the outer ring (in the body rows of ``f``) and heat."""
    slide = speed - y[Y.V0 + Q.OUTER + Q.TURN]
    moment = seal_moment(p, slide)
    f[F.BODY + Q.OUTER + Q.TURN] += moment
    f[F.TORQUE] += moment
    f[F.HEAT] += moment * slide
