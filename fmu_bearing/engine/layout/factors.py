"""A: factors of the Newton matrix, in rows of balls but for the border's inverse."""

from fmu_bearing.engine.layout import q as Q
from fmu_bearing.engine.layout.jacobian import BALL
from fmu_bearing.engine.layout.sizes import MAX_BALLS, STRIDE, Places

BORDER = 20  # numbers per column of the border's inverse: 17, rounded up to whole vectors

_at = Places()
INVERSE = _at(BALL * BALL * STRIDE)  # of a ball's own block: entry (i, k) at (i * BALL + k) * STRIDE
W = _at(BALL * Q.SIZE * STRIDE)  # that times the ball's rows for the bodies: (i * Q.SIZE + g) * STRIDE
GB = _at(Q.SIZE * BALL * STRIDE)  # the bodies' rows for the ball: (g * BALL + k) * STRIDE
S = _at(Q.SIZE * BORDER)  # inverse of what the balls leave of the bodies' block, by columns
SPRING = _at()  # coupling of neighbouring balls: strength,
SPRING_BODY = _at(Q.SIZE * STRIDE)  # bodies' answers,
SPRING_BALLS = _at(MAX_BALLS * MAX_BALLS)  # inverse Z x Z
SIZE = _at.next
