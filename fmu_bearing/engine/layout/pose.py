"""X: where the balls are in one body's frame and how fast they move there: rows of ``w`` per body."""

from fmu_bearing.engine.layout.sizes import STRIDE, Places

_at = Places()
Q = _at(3 * STRIDE)  # m: ball centre from the body's, in the ball's orbiting axes
N = _at(3 * STRIDE)  # the body's axis
H = _at(3 * STRIDE)  # the radial unit vector of the body's frame at the ball
T = _at(3 * STRIDE)  # and the circumferential one
A = _at(STRIDE)  # m: place along the axis
RHO = _at(STRIDE)  # m: distance from the axis
DV = _at(3 * STRIDE)  # m/s: velocity of the ball's centre against the body's material there
DW = _at(3 * STRIDE)  # rad/s: spin against the body's
SIZE = _at.next
