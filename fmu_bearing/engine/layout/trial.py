"""T: work space of fidelities rings and response.

Its rows are the first ones of the full force evaluation, which is not in use meanwhile. The trial numbers
have places of their own. What is needed now and then (matrices, derivatives, lines) shares places with
the stages of a Runge-Kutta step.
"""

from fmu_bearing.engine.layout import condensed as _L, f as _F, jacobian as _J, lines as _LN, w as _W
from fmu_bearing.engine.layout.sizes import FOUR, MAX_DEFECTS, STRIDE, Places
from fmu_bearing.engine.layout.w import Area

# forces of the balls on one ring: rows
_force = Places()
FX = _force(STRIDE)  # N
FY = _force(STRIDE)
FZ = _force(STRIDE)
MY = _force(STRIDE)  # N m
MZ = _force(STRIDE)
FORCE_SIZE = _force.next

# contact of the balls with one race: rows
_contact = Places()
QX = _contact(STRIDE)  # m: ball from the ring's centre, in its orbiting axes
QR = _contact(STRIDE)
QT = _contact(STRIDE)
LOAD = _contact(STRIDE)  # N
STIFF = _contact(STRIDE)  # N/m: along the contact,
ACROSS = _contact(STRIDE)  # and across the track
EX = _contact(STRIDE)  # direction from the ball into the race
ER = _contact(STRIDE)
ET = _contact(STRIDE)
MX = _contact(STRIDE)  # direction across the track
MR = _contact(STRIDE)
MT = _contact(STRIDE)
APPROACH = _contact(STRIDE)  # m: of the sound contact; no kernel reads it of a bearing without local defects
CONTACT_SIZE = _contact.next

_at = Places()
COS = _at(STRIDE)  # of the balls' angles
SIN = _at(STRIDE)
X = _at(STRIDE)  # m: places of the balls
R = _at(STRIDE)
INNER = _at(STRIDE)  # m: race heights
OUTER = _at(STRIDE)
STEP = _at(STRIDE)  # m2: a ball's move in the last sweep, squared, as far as it is felt
MOVED = _at(STRIDE)  # m2: all of it
FORCE = _at(2 * FORCE_SIZE)  # on inner ring, then on outer ring: one row per component, see L.FORCES
# behind the forces, as the components of a line have it: m, away from the frozen point, by patterns: L.AWAYS
AWAY = _at(_L.AWAYS * _L.PATTERNS * STRIDE)
ASIDE = _at(STRIDE)  # m: the balls' places of rest across their tracks
LOADED = _at(STRIDE)  # 1 for a ball between both races, 0 for a loose one and for spare lanes
FORM_SLOPE = _at(2 * STRIDE)  # m/rad: slope of the balls' own form across the track, inner and outer
CONTACT = _at(2 * CONTACT_SIZE)  # with inner race, then with outer race
DX = _at(STRIDE)  # m: a ball's move in the last sweep
DR = _at(STRIDE)
PHASES = _at(STRIDE)  # rad: of one row of lines
# local defects: see condensed/defects
MEETS = _at(2 * STRIDE)  # 1 for a ball within reach of one, at the inner and at the outer race
OVER = _at(2 * MAX_DEFECTS * STRIDE)  # m: from each defect along the track, at the inner race first
PUSH = _at(2 * STRIDE)  # N: what they push along the track, on the race, at the inner race first
MEET_SCALE = _at(2 * MAX_DEFECTS)  # factor on its depth; 0: that race does not meet it
MEET_AHEAD = _at(2 * MAX_DEFECTS)  # m: by which the place along the track changes in the damping time
ROWS = _at.next

FORCE_OUTER = FORCE + FORCE_SIZE
FORM_SLOPE_OUTER = FORM_SLOPE + STRIDE
CONTACT_OUTER = CONTACT + CONTACT_SIZE

# trial numbers of a step
_at = Places(_W.TRIAL)
Q = _at(_L.COLUMN)  # m, rad: displacements
AHEAD = _at(_L.COLUMN)  # m, rad: their rates times the contacts' damping time
D = _at(_L.COLUMN)  # increment, and other short-lived vectors
A = _at(_L.COLUMN)  # m/s2, rad/s2: accelerations
V = _at(_L.COLUMN)  # m/s, rad/s: velocities set aside
BLENDED = _at(3 * _L.COLUMN)  # m, rad: displacements by the lines before, velocities, accelerations
_SPARE = _at(-_at.next % FOUR)
MODES_FREE = _at(_L.BOTH)  # modes of balls and cage at the end of the step if nothing drove them there,
MODES_DRIVEN = _at(4 * _L.BOTH)  # what drives them there, see L.DRIVES: the four at the end
MODES_END = _at(_L.BOTH)  # modes there
LINEAR = _at(_L.COLUMN)  # m, rad: places of the rings less the frozen ones
FAMILY_PLACES = 2 * _L.FAMILY_RINGS  # numbers of a family: complex coordinates
PLACES = _at(2 * FAMILY_PLACES)  # the same by families: of family 0, then of family 1
RATES = _at(2 * FAMILY_PLACES)  # m/s, rad/s: and their velocities
ADDED = _at(_L.COLUMN)  # m/s2, rad/s2: accelerations beside those with balls at rest
FAMILY_AWAY = 2 * _L.AWAYS  # numbers of a family, complex
AWAY_NOW = _at(2 * FAMILY_AWAY)  # m: how far balls at rest are from where these would take them: see L.AWAYS
TRIAL_END = _at.next

# what differences by the height of a race need of a contact: see condensed/contact_forces
_pressed = Places()
TOWARDS = _pressed(2)  # direction x, r from the ball into the race
STIFFNESS = _pressed()  # N/m
TOUCHED_X = _pressed()  # m: the contact from the ring's centre, in its orbiting axes
TOUCHED_R = _pressed()
TOUCHED_T = _pressed()
ORBIT = _pressed()  # m: radius of the ball's orbit
PRESSED_SIZE = _pressed.next

_at = Places(_W.ACC)
# derivatives of the accelerations
BASE = _at(_L.N)  # accelerations at the unmoved state
BALLS = _at(2 * STRIDE)  # m: balls' places there, x and r
FOLLOW_SIZE = 2 * STRIDE  # rows x and r
FOLLOW = _at(2 * _L.N * FOLLOW_SIZE)  # their change with coordinate i at FOLLOW + i * FOLLOW_SIZE, then rates
# inverse of a matrix of the rings, both by rows
MATRIX = _at(_L.N * _L.N)
INVERSE = _at(_L.N * _L.N)
# balls and cage between the rings: complex matrices by rows, see condensed/operator
_INNER = _L.INTERNAL * _L.INTERNAL
STATES = _at(4 * _INNER)  # rates of the states by states, twice
TURNS = _at(2 * _INNER)
VECTORS = _at(2 * _INNER)  # modes in columns
MODES_INVERSE = _at(4 * _INNER)  # rows of the modes and of a unit matrix, which becomes their inverse
BY_RINGS = _at(4 * _L.INTERNAL * _L.FAMILY_RINGS)  # rates by the rings' places and velocities
RESTORING = _at(_L.AWAYS * _J.BALL)  # 1/s2: of a ball by its place of rest, by contacts: see L.AWAYS
COUPLING_SIZE = 2 * 2 * _L.AWAYS * _L.FAMILY_RINGS  # numbers of
COUPLING = _at(COUPLING_SIZE)  # 1/s2: accelerations of the rings by them
PRESSED = _at(2 * PRESSED_SIZE)  # of each race
HEIGHTENED = _at(_J.BALL)  # a ball's accelerations by the height of a race
KEPT = _at(4 * _L.INTERNAL)  # states of balls and cage over a renewal, complex
OPERATOR_END = _at.next
# lines of fidelity response
LINE_SIDE = _L.N * _L.COLUMN  # right side of the rings' equations: behind the columns of coefficients
LINE_RE = _at(LINE_SIDE + _L.COLUMN)
LINE_IM = _at(LINE_SIDE + _L.COLUMN)
MODAL_RESPONSE = _at(2 * _L.BOTH)  # modes of balls and cage at a frequency, per drive: forward, then backward
DRIVEN = _at(2 * _L.FAMILY_RINGS * _L.COMPLEX)  # and driven by each coordinate of a family
FEEDTHROUGH_RE = _at(_L.MATRIX)  # 1/s2: of the rings by them, and by what goes beside balls at rest
FEEDTHROUGH_IM = _at(_L.MATRIX)
LINE_FORCE = _at(_LN.COMPLEX)  # N, N m: one line's excitation
# frozen values, which are found before the modes
_at = Places(STATES)
FROZEN_F = _at(_F.SIZE)  # right-hand side at the frozen state
FROZEN_ROWS = _at(2 * STRIDE)  # orbit speeds and places of the published state, set aside
FROZEN_LOST = _at(_L.LOST)  # losses with even balls, set aside

_CONDENSED = frozenset({"condensed"})
_LINES = frozenset({"lines"})
_BOTH = _CONDENSED | _LINES
_FROZEN = frozenset({"start", "inputs"})  # what is frozen is found with the full right-hand side
#: Areas of ``w`` that only these fidelities use; see W.LEDGER.
LEDGER: tuple[Area, ...] = (
    Area("T rows", 0, ROWS, _BOTH),
    Area("T.Q", Q, _L.COLUMN, _BOTH),
    Area("T.AHEAD", AHEAD, _L.COLUMN, _BOTH),
    Area("T.D", D, _L.COLUMN, _BOTH),
    Area("T.A", A, _L.COLUMN, _BOTH),
    Area("T.V", V, _L.COLUMN, _BOTH),
    Area("T modes of balls", MODES_FREE, TRIAL_END - MODES_FREE, _BOTH),
    Area("T.BASE", BASE, _L.N, _CONDENSED),
    Area("T.BALLS", BALLS, 2 * STRIDE, _CONDENSED),
    Area("T.FOLLOW", FOLLOW, 2 * _L.N * FOLLOW_SIZE, _CONDENSED),
    Area("T.MATRIX", MATRIX, _L.N * _L.N, _CONDENSED),
    Area("T.INVERSE", INVERSE, _L.N * _L.N, _CONDENSED),
    Area("T operator", STATES, OPERATOR_END - STATES, _CONDENSED),
    Area("T.LINE_RE", LINE_RE, LINE_SIDE + _L.COLUMN, _LINES),
    Area("T.LINE_IM", LINE_IM, LINE_SIDE + _L.COLUMN, _LINES),
    Area("T.MODAL_RESPONSE", MODAL_RESPONSE, 2 * _L.BOTH, _LINES),
    Area("T.DRIVEN", DRIVEN, 2 * _L.FAMILY_RINGS * _L.COMPLEX, _LINES),
    Area("T.BESIDE", FEEDTHROUGH_RE, 2 * _L.MATRIX, _LINES),
    Area("T.LINE_FORCE", LINE_FORCE, _LN.COMPLEX, _LINES),
    Area("T.FROZEN_F", FROZEN_F, _F.SIZE, _FROZEN),
    Area("T.FROZEN_ROWS", FROZEN_ROWS, 2 * STRIDE, _FROZEN),
    Area("T.FROZEN_LOST", FROZEN_LOST, _L.LOST, _FROZEN),
)
