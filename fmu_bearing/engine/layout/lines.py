"""LN: scratch of fidelity response while it renews its lines (``x`` in kernels).

It begins at ``S.JAC`` in ``s`` and uses the blocks of Jacobian and factors, which this fidelity does not need
then: forces of one ball on the rings, sampled round the orbit, and their circumferential orders. A complex
vector is ``COMPONENTS`` numbers, each its real part, then its imaginary one.
"""

from fmu_bearing.engine.layout.condensed import AWAYS, FORCES, PATTERNS, N as RINGS
from fmu_bearing.engine.layout.sizes import BALL_ORDERS, FOUR, STRIDE, Places

AWAY = FORCES  # components of the balls' forces, then m: how they rest in each pattern, see L.AWAYS
PLACES = AWAY + AWAYS * PATTERNS
COMPONENTS = PLACES + 2  # and their places x, r between the races (m)
REACH = 8  # highest circumferential order of the balls' unequal loads
AZIMUTHS = 96  # samples over the orbit at most
TURNS = 2 * (BALL_ORDERS + 1)  # samples over a ball's own turning at most

COMPLEX = 2 * COMPONENTS  # numbers of a complex vector

# kinds of sample
FORCE = 0  # N, N m
BY_HEIGHT = 1  # per m of race height under the ball: inner, outer
BY_LEAN = 3  # per m/rad of the balls' slope across the track: inner, outer
KINDS = 5
FORMS = 4  # a ball's heights under both races, then its slopes across both tracks

_at = Places()
COS = _at(TURNS)  # of the azimuths, later of the parts of a ball's turning
SIN = _at(TURNS)
BALL_COS = _at(STRIDE)  # of the balls' azimuths from ball 0
BALL_SIN = _at(STRIDE)
# orders 0 .. REACH of each kind from BY_HEIGHT on: see `order_of` in response/lines
TABLE = _at((KINDS - BY_HEIGHT) * (REACH + 1) * COMPLEX)
FORCE_ORDER = _at(COMPLEX)  # one order of the force
TURNED = _at(FORMS * TURNS)  # m, m/rad: forms of one ball over its turning
# what the balls sound by, see response/ball_sound: orders 0 .. REACH of the balls' places (m) as their loads
# leave them, and of how they follow the rings' coordinates; four numbers each: x real, imaginary, r likewise
REST = _at((REACH + 1) * FOUR)
FOLLOW = _at((REACH + 1) * RINGS * FOUR)
# samples round the orbit: entry (kind, i, m) at (kind * COMPONENTS + i) * AZIMUTHS + m
SAMPLES = _at(KINDS * COMPONENTS * AZIMUTHS)
# when they are no longer needed, orders of the balls' forms: real and imaginary row of (form, order m) at
# ((m - 1) * FORMS + form) * 2 * STRIDE
FORM = SAMPLES
FORM_SIZE = 2 * STRIDE
SIZE = max(_at.next, FORM + BALL_ORDERS * FORMS * FORM_SIZE)
