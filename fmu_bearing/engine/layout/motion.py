"""MO: one motion sample for the sound kernels.

Bodies inner ring, outer ring, cage: velocity, acceleration, angular velocity and acceleration in inertial
axes (x, y, z). Then the same four vectors of the balls in their orbiting axes (x, r, theta) - inertial
quantities, only resolved there - and cosine and sine of their angles, one row of balls each; rows of spare
lanes hold zeros. Then the second time derivatives (m/s2) of the flexural coordinates, two per mode.
"""

from fmu_bearing.engine.layout.sizes import MAX_MODES, STRIDE, Places

_body = Places()
VELOCITY = _body(3)  # m/s
ACCELERATION = _body(3)  # m/s2
SPIN = _body(3)  # rad/s
SPIN_RATE = _body(3)  # rad/s2
PER_BODY = _body.next

_at = Places()
INNER = _at(PER_BODY)
OUTER = _at(PER_BODY)
CAGE = _at(PER_BODY)
BALL_VELOCITY = _at(3 * STRIDE)  # m/s: rows x, r, theta
BALL_ACCELERATION = _at(3 * STRIDE)  # m/s2
BALL_SPIN = _at(3 * STRIDE)  # rad/s
BALL_SPIN_RATE = _at(3 * STRIDE)  # rad/s2
COS = _at(STRIDE)  # of the balls' angles
SIN = _at(STRIDE)
FLEXURES = _at(2 * MAX_MODES)  # m/s2
SIZE = _at.next
