"""A: factors of the Newton matrix: the balls' in groups of four lanes, then the bodies'.

A group holds all that belongs to four balls. Each *entry* is four numbers, one per ball, and entries have
the order in which the solution reads them, so that it goes through memory from end to end.
"""

from fmu_bearing.engine.layout import q as Q
from fmu_bearing.engine.layout.jacobian import BALL
from fmu_bearing.engine.layout.sizes import FOUR, MAX_BALLS, STRIDE, Places

BORDER = 20  # numbers per column of the border's inverse: 17, rounded up to whole vectors
SIX = (
    BALL * FOUR
)  # numbers of six entries: a row of the balls' blocks, or what couples them to one coordinate

_group = Places()
INVERSE = _group(BALL * SIX)  # of a ball's own block: entry (i, k) at i * SIX + k * FOUR
GB = _group(Q.SIZE * SIX)  # the bodies' rows for the ball: g * SIX + k * FOUR
W = _group(Q.SIZE * SIX)  # the inverse times the ball's rows for the bodies, by columns: g * SIX + i * FOUR
GROUP = _group.next

_at = Places()
GROUPS = _at(STRIDE // FOUR * GROUP)
S = _at(Q.SIZE * BORDER)  # inverse of what the balls leave of the bodies' block, by columns
SPRING = _at()  # coupling of neighbouring balls: strength,
SPRING_BODY = _at(Q.SIZE * STRIDE)  # bodies' responses,
SPRING_BALLS = _at(MAX_BALLS * MAX_BALLS)  # inverse Z x Z
SIZE = _at.next
