"""T: work space of fidelities rings and response.

Its rows are the first ones of the full force evaluation, which is not in use meanwhile. The trial numbers
have places of their own. What is needed now and then (matrices, derivatives, lines) shares places with
the stages of a Runge-Kutta step.
"""

from fmu_bearing.engine.layout import condensed as _L, f as _F, jacobian as _J, lines as _LN, w as _W
from fmu_bearing.engine.layout.sizes import STRIDE, Places
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
ASIDE = _at(_L.PATTERNS * STRIDE)  # m: patterns of the balls' places of rest across their tracks
HELD = _at(STRIDE)  # 1 for a ball between both races, 0 for a loose one and for spare lanes
BEND = _at(2 * STRIDE)  # m/s2: second time derivative of the race heights, inner and outer
LEAN = _at(2 * STRIDE)  # m/rad: slope of the balls' own form across the track, inner and outer
CONTACT = _at(2 * CONTACT_SIZE)  # with inner race, then with outer race
DX = _at(STRIDE)  # m: a ball's move in the last sweep
DR = _at(STRIDE)
PHASES = _at(STRIDE)  # rad: of one row of lines
ROWS = _at.next

FORCE_OUTER = FORCE + FORCE_SIZE
BEND_OUTER = BEND + STRIDE
LEAN_OUTER = LEAN + STRIDE
CONTACT_OUTER = CONTACT + CONTACT_SIZE

# trial numbers of a step
_at = Places(_W.TRIAL)
Q = _at(_L.COLUMN)  # m, rad: displacements
AHEAD = _at(_L.COLUMN)  # m, rad: their rates times the contacts' damping time
D = _at(_L.COLUMN)  # increment, and other short-lived vectors
A = _at(_L.COLUMN)  # m/s2, rad/s2: accelerations
V = _at(_L.COLUMN)  # m/s, rad/s: velocities set aside
BLENDED = _at(3 * _L.COLUMN)  # m, rad: displacements by the lines before, velocities, accelerations
SIDE_REST = _at(_L.PATTERNS)  # m, m/s, m/s2: as L.SIDE_REST and so on, on trial
SIDE_PLACE = _at(_L.PATTERNS)
SIDE_VELOCITY = _at(_L.PATTERNS)
SIDE_DRIVEN = _at(_L.PATTERNS)
SIDE_FREE = _at(_L.PATTERNS)  # m: place at the end of the step if nothing drove the balls there
SIDE_COASTING = _at(_L.PATTERNS)  # m/s: and velocity
SIDE_END = _at.next

_at = Places(_W.ACC)
# derivatives of the accelerations
BASE = _at(_L.N)  # accelerations at the unmoved state
BALLS = _at(2 * STRIDE)  # m: balls' places there, x and r
FOLLOW_SIZE = 2 * STRIDE  # rows x and r
FOLLOW = _at(2 * _L.N * FOLLOW_SIZE)  # their change with coordinate i at FOLLOW + i * FOLLOW_SIZE, then rates
# inverse of a matrix of the rings, both by rows
MATRIX = _at(_L.N * _L.N)
INVERSE = _at(_L.N * _L.N)
# mass and damping of the rings' modes: matrices of one family by rows, scaled to own masses of 1
FAMILY = 4  # coordinates of the larger family,
CAGED = 2  # and of the cage in one
BLOCK = FAMILY * FAMILY
WHOLE = (FAMILY + CAGED) ** 2
# in one plane, and what acts a quarter turn on, from the other: see condensed/whirls
STILL = _at(2 * BLOCK)  # 1/s2: stiffness with balls at rest,
DAMPER = _at(2 * BLOCK)  # 1/s: damping,
HEAVY = _at(2 * BLOCK)  # and mass
FULL_RE = _at(WHOLE)  # 1/s2: equations of a whirl by the full ones, rings and cage
FULL_IM = _at(WHOLE)
WHIRL_RE = _at(BLOCK)  # 1/s2: equations of the rings alone, or of the condensed rings
WHIRL_IM = _at(BLOCK)
MEAN_RE = _at(BLOCK)  # 1/s2: accelerations by the full equations, mean of both whirls
MEAN_IM = _at(BLOCK)
VALUES = _at(BLOCK)  # eigenvalues on the diagonal,
VECTORS = _at(BLOCK)  # and their vectors in columns
SHAPES = _at(BLOCK)  # mode shapes in rows
BACK = _at(BLOCK)  # and the matrix that takes them back
PARTS = 4
ADDED = _at(PARTS * FAMILY)  # what each mode's mass and damping (1/s) lack, then what acts a quarter turn on
PAIR = 4
POLES = _at(PAIR * FAMILY)  # 1/s: complex frequencies of a mode's forward and backward whirl
FOUND = _at(FAMILY)  # whether it has any
FOLLOWS = _at(FAMILY)  # the family's L.SIDE_FOLLOW, scaled,
LEADS = _at(FAMILY)  # L.SIDE_LEAD
GUIDES = _at(FAMILY)  # and L.SIDE_GUIDE
RIGHT = _at(2 * FAMILY)  # a whirl's shape: real, then imaginary parts,
LEFT = _at(2 * FAMILY)  # and that of the matrix with rows for columns
ROWS_RE = _at(FAMILY * (FAMILY + 1))  # equations of one iteration of a shape
ROWS_IM = _at(FAMILY * (FAMILY + 1))
BALL_ROW = _J.BALL + FAMILY + CAGED  # numbers per equation of a ball: coefficients, then right sides
BALL_RE = _at(_J.BALL * BALL_ROW)
BALL_IM = _at(_J.BALL * BALL_ROW)
MODES_END = _at.next

MASS_TURNED = 2 * FAMILY  # places in ADDED
DAMPER_TURNED = 3 * FAMILY
# lines of fidelity response
LINE_SIDE = _L.N * _L.COLUMN  # right side of the rings' equations: behind the columns of coefficients
LINE_RE = _at(LINE_SIDE + _L.COLUMN)
LINE_IM = _at(LINE_SIDE + _L.COLUMN)
LINE_FORCE = _at(_LN.COMPLEX)  # N, N m: one line's excitation
BY_HEIGHT = _at(_LN.COMPLEX)  # one order of the force per height,
BY_BEND = _at(_LN.COMPLEX)  # and per second time derivative of the height
# held values, which are found before the modes
_at = Places(STILL)
HELD_F = _at(_F.SIZE)  # right-hand side at the held state
HELD_ROWS = _at(2 * STRIDE)  # orbit speeds and places of the published state, set aside
HELD_LOST = _at(_L.LOST)  # losses with even balls, set aside

_CONDENSED = frozenset({"condensed"})
_LINES = frozenset({"lines"})
_BOTH = _CONDENSED | _LINES
_HELD = frozenset({"start", "inputs"})  # what is held is found with the full right-hand side
#: Areas of ``w`` that only these fidelities use; see W.LEDGER.
LEDGER: tuple[Area, ...] = (
    Area("T rows", 0, ROWS, _BOTH),
    Area("T.Q", Q, _L.COLUMN, _BOTH),
    Area("T.AHEAD", AHEAD, _L.COLUMN, _BOTH),
    Area("T.D", D, _L.COLUMN, _BOTH),
    Area("T.A", A, _L.COLUMN, _BOTH),
    Area("T.V", V, _L.COLUMN, _BOTH),
    Area("T side", SIDE_REST, SIDE_END - SIDE_REST, _BOTH),
    Area("T.BASE", BASE, _L.N, _CONDENSED),
    Area("T.BALLS", BALLS, 2 * STRIDE, _CONDENSED),
    Area("T.FOLLOW", FOLLOW, 2 * _L.N * FOLLOW_SIZE, _CONDENSED),
    Area("T.MATRIX", MATRIX, _L.N * _L.N, _CONDENSED),
    Area("T.INVERSE", INVERSE, _L.N * _L.N, _CONDENSED),
    Area("T modes", STILL, MODES_END - STILL, _CONDENSED),
    Area("T.LINE_RE", LINE_RE, LINE_SIDE + _L.COLUMN, _LINES),
    Area("T.LINE_IM", LINE_IM, LINE_SIDE + _L.COLUMN, _LINES),
    Area("T.LINE_FORCE", LINE_FORCE, _LN.COMPLEX, _LINES),
    Area("T.BY_HEIGHT", BY_HEIGHT, _LN.COMPLEX, _LINES),
    Area("T.BY_BEND", BY_BEND, _LN.COMPLEX, _LINES),
    Area("T.HELD_F", HELD_F, _F.SIZE, _HELD),
    Area("T.HELD_ROWS", HELD_ROWS, 2 * STRIDE, _HELD),
    Area("T.HELD_LOST", HELD_LOST, _L.LOST, _HELD),
)
