"""DE: a local defect of a race or a ball in the parameters: its head, and the table of its height.

Heads of ``SIZE`` numbers lie one after the other from ``p[P.AT_DEFECTS]`` on, ``p[P.DEFECTS]`` of them: those
of one bearing; their tables follow. With the approach delta of the sound contact and the place x of the
ball's centre along the track, from the defect's middle, a table gives what is left of the approach:

    e = delta - touch(x),    eta = e - drop(e, x),    no force where e <= 0 or eta <= 0

Nodes ascend and need not be equally spaced. Outside of the places nothing acts (`prepare.defects.Table`).
"""

from fmu_bearing.engine.layout.sizes import Places

# on what it is
INNER, OUTER, BALL = 0, 1, 2
VECTOR = 3  # numbers of a direction

_at = Places()
NUMBER = _at()  # in the scene, from 0: its scale is at ``P.DEFECT_SCALE`` + number
ON = _at()  # INNER, OUTER or BALL
ANGLE = _at()  # rad: of its middle on the race
RADIUS = _at(2)  # m: of the contacts' circle on each race that meets it; on a ball both times the ball's
LENGTH = _at()  # m: along rolling
OF_BALL = _at()  # number of the ball that has it, from 0
DIRECTION = _at(VECTOR)  # unit vector from the ball's centre to it at the start, in the orbiting axes
ACROSS = _at(4)  # m: off the ball's track up to here it acts wholly, not at all beyond; at each race
AT_TABLE = _at(2)  # offset from ``p[P.AT_DEFECTS]`` of its table at each race; 0: this race does not meet it
SIZE = _at.next

# table: two counts, then the places (m), the approaches (m), rows of touch per place, rows of drop per node
_at = Places()
PLACES = _at()  # how many places along the track, 2 or more
APPROACHES = _at()  # how many approaches beyond first touch, 2 or more; the first is 0
TABLE_HEAD = _at.next

_touch = Places()
TOUCH = _touch()  # m: approach at which a rigid ball touches first; zero at both ends
TOUCH_X = _touch()  # its slope along the track; zero at both ends
TOUCH_ROW = _touch.next

# node (place i, approach k) at row i * APPROACHES + k; zeros for the first approach and both ends
_node = Places()
DROP = _node()  # m: approach lost beyond first touch
DROP_X = _node()  # its slope along the track,
DROP_E = _node()  # along the approach: zero at the last one, beyond which the drop stays,
DROP_XE = _node()  # 1/m: and along both
DROP_ROW = _node.next

# what the state keeps of each defect of a bearing, one after the other at ``S.SEEN``: see readout/defects
_seen = Places()
PASSAGES = _seen()  # balls, or contacts of its ball, whose middle has passed it
ENTRY = _seen()  # s: time of the last one that came over its edge; 0: none came yet
IMPACT = _seen()  # s: time when one last turned round near its deepest, from sinking to rising; 0: none yet
ENTERED = _seen()  # m: how far towards the race it was at the end of the step in which it came,
DEEPEST = _seen()  # m: and at its deepest since then
NEAR = _seen()  # 1 + number of the ball that is nearest, on a ball 1 + that of the race; 0: not known yet
PLACE = _seen()  # m: of its middle along the track, from that of the defect, at the end of the last step
SINKING = _seen()  # m/s: towards the race, against the ring
SEEN_SIZE = _seen.next
