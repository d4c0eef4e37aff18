"""MO: one motion sample for the sound kernels.

Bodies inner ring, outer ring, cage: velocity, acceleration, angular velocity and acceleration in inertial
axes (x, y, z). Then per ball the same four vectors in its orbiting axes (x, r, theta) - inertial quantities,
only resolved there - and cosine and sine of its angle; then the second time derivatives (m/s2) of the
flexural coordinates, two per mode.
"""

from fmu_bearing.engine.layout.sizes import MAX_BALLS, MAX_MODES, Places

_body = Places()
VELOCITY = _body(3)  # m/s
ACCELERATION = _body(3)  # m/s2
SPIN = _body(3)  # rad/s
SPIN_RATE = _body(3)  # rad/s2
PER_BODY = _body.next
COS = _body()  # of a ball's angle
SIN = _body()
PER_BALL = _body.next

_at = Places()
INNER = _at(PER_BODY)
OUTER = _at(PER_BODY)
CAGE = _at(PER_BODY)
BALLS = _at.next


def flexures(n_balls):
    """Place of the flexural accelerations in a motion sample for ``n_balls`` balls."""
    return BALLS + PER_BALL * n_balls


def size(n_balls, n_modes=0):
    """Length of a motion sample for ``n_balls`` balls and ``n_modes`` flexural modes."""
    return flexures(n_balls) + 2 * n_modes


MAX_SIZE = size(MAX_BALLS, MAX_MODES)
