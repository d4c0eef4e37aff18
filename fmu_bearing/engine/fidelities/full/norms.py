"""How large a change of the state is: one velocity for the error of a step and of Newton's method."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import dot_lanes
from fmu_bearing.engine.layout import STRIDE, C, F, P, Q
from fmu_bearing.engine.newton.jacobian import is_angle


@kernel
def body_size(p, d, at, cage):
    """Sum of squares of the bodies' velocities (m2/s2): tilts at the pitch radius, cage times ``cage``."""
    lever = p[P.PITCH_RADIUS]
    total = 0.0
    for i in range(Q.SIZE):
        value = d[at + i]
        if is_angle(i):
            value *= lever
        if i >= Q.CAGE:
            value *= cage
        total += value * value
    return total


@kernel
def row_size(d, first, count, lanes):
    """Mean over the lanes of the sum of squares of ``count`` rows from that at ``first`` on."""
    total = 0.0
    for i in range(count):
        row = first + i * STRIDE
        total += dot_lanes(d, row, d, row, lanes)
    return total / lanes


@kernel
def newton_size(p, c, d, factor):
    """Size (m/s) of the velocity change ``factor * d``, rings and cage in full.

    The balls' axial and radial motion count a sixth, their orbit and spin a tenth and 3 % of their surface
    speeds: they matter through what they do to the rings. So does the cage, but not so little: it floats in
    films thinner than it is thrown, and what Newton's method leaves of its velocity in a hit decides the next
    one. With a tenth of it the start named in ``control`` has an error of 0.18, with all of it 8e-4.
    """
    lanes = int(p[P.LANES])
    orbit = 0.1 * p[P.PITCH_RADIUS]
    spin = 0.03 * c[C.BALL_RADIUS]
    total = body_size(p, d, F.BODY, 1.0) + 0.03 * row_size(d, F.X, 2, lanes)
    total += orbit * orbit * row_size(d, F.TH, 1, lanes) + spin * spin * row_size(d, F.WX, 3, lanes)
    return math.sqrt(total) * abs(factor)
