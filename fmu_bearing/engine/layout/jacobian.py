"""J: blocks of the Jacobian of the accelerations, in rows of balls but for the last.

For each ball B (its accelerations by its own state) and C (by the bodies'), D (the bodies' accelerations by
its state); for the bodies E (17 x 34, row by row: by coordinates, then by rates).
"""

from fmu_bearing.engine.layout import q as Q
from fmu_bearing.engine.layout.sizes import STRIDE, Places

BALL = 6  # unknown accelerations of a ball
STATES = 9  # of a ball: three places, then six rates
PLACED = 3  # of which places
BODIES = 2 * Q.SIZE  # coordinates, then rates

_at = Places()
B = _at(BALL * STATES * STRIDE)  # entry (i, k) at B + (i * STATES + k) * STRIDE
C = _at(BALL * BODIES * STRIDE)  # C + (i * BODIES + k) * STRIDE
D = _at(Q.SIZE * STATES * STRIDE)  # D + (i * STATES + k) * STRIDE
E = _at(Q.SIZE * BODIES)  # E + i * BODIES + k
SIZE = _at.next
