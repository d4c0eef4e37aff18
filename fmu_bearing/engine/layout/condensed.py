"""L: what fidelities rings and response keep in the state, from ``S.CONDENSED`` on (``lv`` in kernels)."""

from fmu_bearing.engine.layout import c as C, history as H, pattern as PT, q as Q, y as Y
from fmu_bearing.engine.layout.sizes import FOUR, STRIDE, Places

N = Q.RINGS  # coordinates: inner x y z by bz, outer x y z angle by bz
TURN = Q.OUTER + Q.TURN  # coordinate of the outer ring's rotation: no ball force acts on it
FORCES = N - 1  # components of the balls' forces: the coordinates without TURN, in their order
COLUMN = -(-N // FOUR) * FOUR  # numbers per vector or matrix column: N, rounded up to whole vectors
DIAGONAL = COLUMN + 1  # from one entry of a matrix's diagonal to the next
MATRIX = COLUMN * N  # entry (i, k) at i + COLUMN * k
VECTOR = 3  # numbers of a vector in space
HISTORY = H.LENGTH  # places kept: now and at earlier steps
PATTERNS = 3  # of the balls' motion that move the rings: uniform, as cosine and as minus sine of their angle

# Families of motion: along the axis with the outer ring's turning, aside and tilting (complex, two planes).
FAMILY_RINGS = 4  # coordinates of the rings in one at most
INTERNAL = 13  # states of balls and cage: 3 places and 6 rates of a pattern of the balls, 2 and 2 of the cage
MODES = -(-INTERNAL // FOUR) * FOUR  # lanes of modes
COMPLEX = 2 * MODES  # a complex row of modes: real parts, then imaginary ones
BOTH = 2 * COMPLEX  # of both families
# What drives the modes: the rings' places, with the rest of what their rates do; the same of velocities; of
# places what rates alone do; the balls' places of rest, now and at three steps before.
BY_PLACE, BY_SLOPE, BY_RATE, BY_AWAY = range(4)
DRIVES = 7
# What they add in a step: by the first two at its end, at its begin, then by the last at the end and before.
GAIN_PLACE, GAIN_SLOPE, GAIN_FROM_PLACE, GAIN_FROM_SLOPE, GAIN_AWAY = (k * BOTH for k in range(5))
GAINS = 4 + HISTORY
# How far balls at rest are from linear ones: places x, r; by how much their contacts with inner and outer
# race press more (m, load over stiffness), which friction follows.
AWAYS = 4
_press = Places()
_press(2)  # of a contact of ball 0 at angle 0: direction x, r into the race,
PRESS_LEVER = _press()  # m: of its ring's tilt,
PRESS_SOFT = _press()  # m/N: one over its stiffness,
PRESS_LOAD = _press()  # N: load
PRESS_WHOLE = _press()  # of the first: one over how far the ball counts as loaded by both races
PRESS_SIZE = 2 * FOUR
_family = Places()
VALUE = _family(COMPLEX)  # 1/s: of the modes
IN_PLACE = _family(FAMILY_RINGS * COMPLEX)  # how the rings' displacements drive them,
IN_RATE = _family(FAMILY_RINGS * COMPLEX)  # velocities,
IN_WHOLE = _family(FAMILY_RINGS * COMPLEX)  # the first plus the mode's rate times the second,
IN_AWAY = _family(AWAYS * COMPLEX)  # and how far balls at rest are from linear ones: see AWAYS
OUT = _family(FAMILY_RINGS * COMPLEX)  # accelerations of the rings by the modes
SHAPE = _family(INTERNAL * COMPLEX)  # states of balls and cage by the modes
FOLLOW = _family(4 * FAMILY_RINGS * 2)  # complex: x, r at rest by the rings' places, then by velocities
COUPLING = _family(2 * FAMILY_RINGS * AWAYS)  # complex, 1/s2: accelerations of the rings by the same
FAMILY_SIZE = _family.next

MOST_LINES = 384  # of fidelity response: a 7003C has 138 at 10,000 r/min; the last 100 weigh 4e-4 below 3,000
# one line of fidelity response, in a table at the end of the state
_line = Places()
LINE_BALL = _line()  # multiple of ball 0's angle,
LINE_SHAFT = _line()  # of the shaft's,
LINE_ROLLED = _line()  # and of the balls' own turning
LINE_WEIGHT = _line()  # m2/s2: what the line weighs beside others
LINE_HEAP = _line()  # of a full table's heap by weight: number of the line at this place
LINE_REAL = _line(COLUMN)  # m, rad: complex displacements of the coordinates, zero for TURN: real parts,
LINE_IMAGINARY = _line(COLUMN)  # imaginary parts
LINE_SIZE = _line.next
# behind the lines: how many there were before those in use, and the equilibrium about which they moved
TABLE_COUNT = MOST_LINES * LINE_SIZE
TABLE_MEAN = TABLE_COUNT + FOUR
TABLE_SIZE = TABLE_MEAN + COLUMN

# What a search has found: nothing yet, the steady state, none with balls that the cage carries
UNKNOWN, FOUND, CARRIED = range(3)
IDLE, GOING, ENDED = range(3)  # of a search for the operating point; ended: its result is not in use yet
LOST = 8  # losses: heats of inner ring, outer ring, oil, four by source (W), torque on the outer ring (N m)

_at = Places()
RATIO = _at()  # orbit over shaft speed
PAIR_INNER = _at()  # kg m: friction force that balances the gyroscopic moment over shaft speed squared
PAIR_OUTER = _at()
TORQUE = _at()  # N m at FOUND_SPEED
HEAT = _at(3)  # W: inner ring, outer ring, oil
TWIST = _at()  # N m on the outer ring about its axis
FROZEN_SPEED = _at()  # rad/s of the frozen values
SPACING = _at()  # s: of the places kept below,
KNOWN = _at()  # and how many earlier ones of that spacing there are
THETA = _at()  # rad: angle of ball 0
COUNT = _at()  # of lines (fidelity response)
ROLLED = _at()  # rad: by which the balls have turned in their orbiting axes
# how they turn there, and where they touch: see condensed/ball_form
ROLL = _at()  # rate of that angle over shaft speed
ROLL_AXIS = _at(VECTOR)  # unit vector
CONTACT_AXES = _at(VECTOR * FOUR)  # rows x r theta: unit vectors into both races and across both tracks
ROLL_SIZE = _at.next - ROLL
# the balls' motion across their tracks: see condensed/transverse
SIDE = _at(2)  # unit vector (x, r) along which a ball gives way most; zero: it follows statically
SIDE_STILL = _at()  # m: a ball's place along it with even balls
SIDE_SQUARE = _at()  # 1/s2: squared frequency of a ball along it between fixed races
SIDE_RATE = _at()  # 1/s: friction per velocity and mass of a ball
SIDE_STEP = _at()  # s: step that the next two belong to; 0: none
SIDE_STAY = _at()  # free motion over it: place by place,
SIDE_COAST = _at()  # s: and by velocity
# what balls and cage do between the rings, by modes of theirs: see condensed/operator and condensed/patterns
MODES_STEP = _at()  # s: step that the next two belong to; 0: none
MODES_KNOWN = _at()  # and how many earlier drives
MODES_NEW = _at()  # 1: of a new operator: distances from where their drive would hold them
SHARE = _at()  # of the balls that both races load, lately
_SPARE = _at(-_at.next % FOUR)
MODES_NOW = _at(BOTH)  # complex: how far each mode is moved,
MODES_DRIVEN = _at(DRIVES * BOTH)  # what drives it: see DRIVES
JUMP = _at(COLUMN)  # m/s2, rad/s2: what renewals have changed in the rings' accelerations and still comes in
ADDED = _at(COLUMN)  # m/s2, rad/s2: all that is added to those with balls at rest
MODES_STAY = _at(BOTH)  # what is left of a mode after a step,
MODES_GAIN = _at(GAINS * BOTH)  # and what the drives add: see GAINS
CONDITIONS = _at(C.SIZE)  # that the frozen values were found at
Q0 = _at(COLUMN)  # m, rad: displacements of the rings,
V0 = _at(COLUMN)  # velocities
A0 = _at(COLUMN)  # and accelerations
MEAN = _at(COLUMN)  # static equilibrium of the rings
# Matrices of N x N by columns of COLUMN, so that a product is a few vector instructions.
JX = _at(MATRIX)  # derivatives of accelerations by displacements
JV = _at(MATRIX)  # and by velocities
# rows of the rings' coordinates, one per pattern of the balls
SIDE_ROLLING = _at(PATTERNS * COLUMN)  # how far rolling alone would take them across their tracks
# beside the frozen point: see condensed/contact_forces
REACH = _at(VECTOR)  # 1/m2: quadratic form xx, xr, rr of a ball's place that is one far from there
LOADED = _at()  # N2: product of its loads on both races there
PRESS = _at(2 * PRESS_SIZE)  # its contacts there
OPERATOR_BEGIN = _at.next
FROZEN_JX = _at(MATRIX)  # 1/s2: JX at the frozen point,
FROZEN_JV = _at(MATRIX)  # 1/s: and JV
# what fidelity full has beside the condensed balls, linear about a frozen point: see condensed/operator
FEEDTHROUGH_PLACE = _at(MATRIX)  # 1/s2: accelerations of the rings by displacements,
FEEDTHROUGH_RATE = _at(MATRIX)  # 1/s: and by velocities, with balls and cage fixed
AT_RINGS = _at(COLUMN)  # m, rad: places of the rings that this holds about,
AT_BALL = _at(FOUR)  # m: and x, r of a ball
OPERATOR = _at(FOUR)  # modes of family 0 and of family 1; 0: balls follow statically
FAMILY = _at(2 * FAMILY_SIZE)
# rows per ball
X = _at(STRIDE)  # m: place now
R = _at(STRIDE)
X1 = _at(STRIDE)  # and at the steps before
R1 = _at(STRIDE)
X2 = _at(STRIDE)
R2 = _at(STRIDE)
X3 = _at(STRIDE)
R3 = _at(STRIDE)
X4 = _at(STRIDE)
R4 = _at(STRIDE)
EVEN = _at(STRIDE)  # places x at the equilibrium, ball 0 at angle 0
EVEN_R = _at(STRIDE)  # and r
PHI = _at(STRIDE)  # angle from ball 0 in table intervals,
COS = _at(STRIDE)  # its cosine
SIN = _at(STRIDE)  # and sine
SIZES = _at(STRIDE)  # m: half the diameter deviation, at scale 1
MASK = _at(STRIDE)  # 1 for a ball, 0 for a spare lane
SPIN = _at(3 * STRIDE)  # spin over shaft speed: x, r, theta
SETTLED = _at(STRIDE)  # how many of the latest places are places of rest
# each ball's motion across its track: see condensed/ball_motion
OWN_PLACE = _at(STRIDE)  # m: along SIDE,
OWN_VELOCITY = _at(STRIDE)  # m/s
OWN_REST = _at(STRIDE)  # m: where it would rest
OWN_LOADED = _at(STRIDE)  # 1 for a ball between both races, 0 for a loose one
OWN_DRIVEN = _at(STRIDE)  # m/s2: what drives it, now
OWN_BEFORE = _at(STRIDE)  # a step before,
OWN_EARLIER = _at(STRIDE)  # two
OWN_EARLIEST = _at(STRIDE)  # and three
OWN_END = _at.next
OWN_GAIN = _at(HISTORY)  # s2: place after a step by the last drives, the one at its end first,
OWN_KICK = _at(HISTORY)  # s: and velocity
OWN_STEP = _at()  # s: the step they belong to; 0: none
_SPARE_OWN = _at()  # rows begin at whole vectors
Y0 = _at(Y.SIZE)  # state of the frozen point: even balls, the cage centred
LAG = _at()  # rad: of the balls in their pockets there, which Y0 is without
# what uneven balls add to what is lost there: see condensed/uneven
MORE_SPEED = _at()  # rad/s: found at this speed of the shaft
MORE_TOTAL = _at()  # W: lost with even balls there
MORE_KNOWN = _at()  # UNKNOWN, FOUND or CARRIED
MORE_RATIO = _at()  # factor on the orbit speed
MORE_AWAY = _at()  # m: how far the cage is from the middle of its lands,
MORE_WHIRL = _at()  # rad/s: how fast it goes round there
MORE_PRESSED = _at()  # 1: its pockets press on all balls
MORE = _at(LOST)  # losses added
MORE_CONDITIONS = _at(C.SIZE)
# a search for that, which goes on in pieces
SEARCH_STATE = _at()  # IDLE, GOING or ENDED
SEARCH_BEFORE = _at()  # 1: it was going when a renewal of other things began; -1: which has given it up
SEARCH_SPEED = _at()  # rad/s: of the shaft,
SEARCH_TURNING = _at()  # and at which the state is found
SEARCH_FIXED = _at()  # see steady/even
SEARCH_RATIO = _at()  # orbit over shaft speed with even balls
SEARCH_TOTAL = _at()  # W: lost with even balls,
SEARCH_LOST = _at(LOST)  # and by losses
SEARCH_CONDITIONS = _at(C.SIZE)
SEARCH_KEPT = _at(PT.KEPT_SIZE)
SIZE = _at.next

HEAT_OUTER = HEAT + 1
HEAT_OIL = HEAT + 2
