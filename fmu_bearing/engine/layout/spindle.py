"""SP: a set of bearings on one shaft: its block in ``p``, its state, outputs and work space.

The arrays of a set hold the arrays of its bearings one after the other, each as of a single bearing, then the
set's own part: in ``p`` its block, at ``p[P.SET]``; in ``s``, ``w`` and ``z`` at places that the block holds
(``AT_S``, ``AT_W``, ``AT_Z``). Its n coordinates belong to the shaft, then to a housing that moves: x y z
(m), rotation about X, tilts about y and z (rad) at X = 0; the last ones are the places of sliding outer rings
along their bearings' own axes. Vectors of coordinates, and columns of their matrices, have `padded_size`
numbers: whole groups of four lanes, the spare ones zero. *Driven* rows of a bearing's bodies follow the
coordinates by ``T q`` (T constrains these degrees of freedom) and an offset along the bearing's own axis.
"""

from fmu_bearing.engine.layout import condensed as _L, history as _H, p as _P, q as _Q, u as _U, z as _Z
from fmu_bearing.engine.layout.sizes import FOUR, STAGES, Places

PLANE = _Q.OUTER  # coordinates of a plane of the shaft: x y z by bz
HOUSING = _Q.CAGE - _Q.OUTER  # of a housing
BETWEEN, PEDESTAL_TERMS = HOUSING, HOUSING + 1  # of a pedestal: what couples y and z, behind its diagonal
DRIVEN = _Q.RINGS  # rows that can be driven: of both rings,
LANES = -(-DRIVEN // FOUR) * FOUR  # in whole groups of four
FIXED, SLIDING, PEDESTAL = range(3)  # seats
TOUCHING, SPACER, SPRING = range(3)  # kinds of preload

# --- block in p: head -------------------------------------------------------------------------------
_at = Places()
BEARINGS = _at()  # how many
SHAFT = _at()  # coordinates of the shaft
HOUSED = _at()  # 1: the housing moves
COUNT = _at()  # coordinates of shaft, housing and sliding rings,
PADDED_SIZE = _at()  # in whole groups of four
SPRUNG = _at()  # 1: there is such a stiffness
UNBALANCED = _at()  # 1: it has heavy spots, or all that turns is eccentric
PORT = _at()  # 1: another model moves the shaft
LINED = _at()  # 1: the state has room for lines (fidelity response)
AT_S = _at()  # places of the set's own in s, w, z
AT_W = _at()
AT_Z = _at()
FRONT = _at()  # lengths of s, w, z with all bearings; of s: see the same place in s.py
SIZE_W = _at()
SIZE_Z = _at()
# tables, at places counted from the block's begin; matrices by padded columns
AT_ROWS = _at()  # ROW numbers per bearing
AT_MASS = _at()  # n x n, without rings that are driven
AT_INVERSE = _at()  # n x n: inverse of the mass with them
AT_STIFFNESS = _at()  # n x n, of the shaft and of springs at sliding rings
AT_DAMPING = _at()
AT_GYROSCOPIC = _at()  # per rad/s of the shaft's speed
AT_HEAVY = _at()  # a vector: force per acceleration along Z (kg)
AT_NOSE = _at()  # PLANE padded rows: what the nose does
AT_SPRINGS = _at()  # a vector: how far springs at sliding rings are pressed together
AT_SCALE = _at()  # a vector: inertia over that along the axis
AT_UNBALANCE = _at()  # two vectors: force over squared speed at angle zero, then a quarter turn on; of heavy
# spots, then two of the eccentricity of all that turns, which is scaled as other imperfections are
# preload and what grows with temperature
PRELOAD_KIND = _at()
ONE_WAY = _at()  # 1: all bearings carry the same way
SHAFT_EXPANSION = _at()  # 1/K
HOUSING_EXPANSION = _at()
# pedestal of the housing
HOUSING_X = _at()  # m: its plane
HOUSING_MASS = _at()  # kg: of housing and outer rings, as its damping ratio counts them
HOUSING_TRANSVERSE = _at()  # kg m2
HOUSING_POLAR = _at()
PEDESTAL_Y = _at()  # radial stiffness along y, along z and between both, over the pedestal's
PEDESTAL_Z = _at()
PEDESTAL_YZ = _at()
PEDESTAL_DAMPING_Y = _at()  # the same of the damping
PEDESTAL_DAMPING_Z = _at()
PEDESTAL_DAMPING_YZ = _at()
AXIAL_RATIO = _at()
ROTATIONAL_RATIO = _at()  # m2
PEDESTAL_ZETA = _at()
# inner rings as part of the rotor at a port
PORT_MASS = _at()  # kg
PORT_STATIC = _at()  # kg m: sum of mass times X
PORT_TRANSVERSE = _at()  # kg m2: about y or z at X = 0
HEAD = _at.next

# per bearing, at AT_ROWS
_row = Places()
ROW_P = _row()  # places and lengths of its arrays
ROW_P_SIZE = _row()
ROW_S = _row()
ROW_S_SIZE = _row()
ROW_W = _row()
ROW_W_SIZE = _row()
ROW_Z = _row()
ROW_Z_SIZE = _row()
ROW_SIGN = _row()  # 1 where it carries force on the shaft towards +X, else -1
ROW_POSITION = _row()  # m
ROW_SEAT = _row()
ROW_SHARE = _row()  # of the preload: its load over the preload asked
ROW_STICKOUT = _row()  # m
ROW_SEAT_TILT = _row(2)  # rad: tilts y z of the seat that holds its outer ring, in its own axes
ROW_DRIVEN = _row()  # how many rows are driven: of the inner ring, or of both
ROW_MASS = _row(LANES)  # kg, kg m2: inertia of each of these
ROW_AT_T = _row()  # their motion by columns of LANES
ROW_COLUMNS = _row()  # how many of these are not zero,
ROW_AT_COLUMNS = _row()  # and which
ROW = _row.next

# --- outputs ----------------------------------------------------------------------------------------
OUTPUTS = (
    "shaft.nose.displacement.x", "shaft.nose.displacement.y", "shaft.nose.displacement.z",
    "shaft.nose.tilt.y", "shaft.nose.tilt.z", "shaft.nose.velocity.x", "shaft.nose.velocity.y",
    "shaft.nose.velocity.z", "shaft.stiffness.axial", "shaft.stiffness.radial", "shaft.stiffness.tilt",
    "housing.displacement.x", "housing.displacement.y", "housing.displacement.z",
    "housing.velocity.x", "housing.velocity.y", "housing.velocity.z", "friction_torque",
    "friction_torque_mean", "heat.inner_ring", "heat.outer_ring", "heat.oil", "solver.steps",
    "solver.rejected", "solver.restarts", "solver.growth", "solver.wave_time", "energy.residual",
    "port.force.x", "port.force.y", "port.force.z", "port.moment.y", "port.moment.z", "port.force_mean.x",
    "port.force_mean.y", "port.force_mean.z", "port.moment_mean.y", "port.moment_mean.z",
)  # fmt: skip
BEARING_OUTPUTS = ("force.x", "force.y", "force.z", "moment.y", "moment.z")  # of the inner ring on the balls
Z_NOSE = OUTPUTS.index("shaft.nose.displacement.x")  # m, m, m, rad, rad
Z_NOSE_VELOCITY = OUTPUTS.index("shaft.nose.velocity.x")  # m/s
Z_STIFFNESS = OUTPUTS.index("shaft.stiffness.axial")  # N/m, N/m, N m/rad
Z_HOUSING = OUTPUTS.index("housing.displacement.x")  # m
Z_HOUSING_VELOCITY = OUTPUTS.index("housing.velocity.x")
Z_TORQUE = OUTPUTS.index("friction_torque")  # N m
Z_MEAN_TORQUE = OUTPUTS.index("friction_torque_mean")
Z_HEAT = OUTPUTS.index("heat.inner_ring")  # W: sums over the bearings, then outer rings, oil
Z_STEPS = OUTPUTS.index("solver.steps")
Z_REJECTED = OUTPUTS.index("solver.rejected")
Z_RESTARTS = OUTPUTS.index("solver.restarts")
Z_GROWTH = OUTPUTS.index("solver.growth")  # 1/s
Z_WAVE_TIME = OUTPUTS.index("solver.wave_time")
Z_RESIDUAL = OUTPUTS.index("energy.residual")
Z_PORT = OUTPUTS.index("port.force.x")  # N, N m: of the bearings on the rotor,
Z_PORT_MEAN = OUTPUTS.index("port.force_mean.x")  # and their mean over the last communication step
Z_FORCES = len(OUTPUTS)  # N, N m: per bearing BEARING_OUTPUTS
Z_FORCE = len(BEARING_OUTPUTS)
# behind the forces: microphones (z_mics), levels of each bearing alone (z_alone), then accelerometers

POWERS = 3
# --- state: conditions of a communication step, sums; then vectors, numbers per bearing, matrices ----
_at = Places()
NOSE = _at(PLANE)  # N, N m on the nose
SPRING = _at()  # N: on each sliding ring
PEDESTAL_STIFFNESS = _at(PEDESTAL_TERMS)  # N/m, N m/rad: along x y z, about x y z, between y and z,
PEDESTAL_DAMPING = _at(PEDESTAL_TERMS)  # and its damping
WORK = _at()  # J: of loads and unbalance on the shaft, of what grows,
HEAT = _at(2)  # J: lost in the bending shaft, in the pedestal
POWER_NOW = _at(POWERS)  # W: work, heats of shaft and pedestal at the state
MEAN_HEAT = _at(2)  # W
SHAFT_STIFFNESS = _at(3)  # N/m, N/m, N m/rad: axial, radial, against tilts, where the set rested last
PORT_BEGIN = _at()  # s: of the communication step; place and derivatives of the shaft there:
PORT_PLACE = _at(PLANE)  # m, rad
PORT_RATE = _at(PLANE)
PORT_ACCELERATION = _at(PLANE)
PORT_JERK = _at(PLANE)
PORT_FORCE = _at(PLANE)  # N, N m: on the rotor at the state,
PORT_IMPULSE = _at(PLANE)  # N s, N m s: since the communication step began,
PORT_MEAN = _at(PLANE)  # N, N m: and over the last one
S_HEAD = _at.next
MOTION = 5  # vectors behind the head: places (m, rad), rates, accelerations,
STATIC_LOAD = 3  # N, N m: loads on the nose and of springs as forces on the coordinates,
CHANGE = 4  # m/s2, rad/s2: and the accelerations' change, see S.CHANGE
_bearing = Places()
OFFSET = _bearing()  # m: along the bearing's own axis, of its inner ring from where the shaft puts it,
OFFSET_RATE = _bearing()  # m/s,
OFFSET_COLD = _bearing()  # m: and that at standstill and 20 degC
LOAD = _bearing(PLANE)  # N, N m: of the inner ring on the balls, at the last communication point
FROZEN_OFFSET = _bearing()  # m: that the bearing's quasi-static point was frozen with (fidelity rings)
EXCESS = (
    _bearing()
)  # N: by which its steady force along the axis exceeds the quasi-static one where it rested
RESTED = _bearing(2 * PLANE + 2 + HOUSING)  # START_RING to START_FORCE there, see steady.keep_rest
SCHUR = _bearing(LANES * DRIVEN)  # R^-1 of the driven rows, by columns of LANES
PER_BEARING = _bearing.next
# fidelity rings, behind the inverse: numbers, then the vectors of history, and by padded columns B^-1 J_x
MARCH = 0  # numbers of the march: see history
_march = Places(_H.NUMBERS)
FROZEN_NOSE = _march(PLANE)  # N, N m: what the quasi-static points were frozen with: loads on the nose,
FROZEN_SPRING = _march()  # N,
FROZEN_PEDESTAL = _march()  # N/m: and the pedestal
LINES = _march()  # how many lines there are (fidelity response)
PIECES = _march()  # of renewals: due and not made yet
PAUSE = _march()  # until the next one may begin
# a renewal that goes on in pieces: see response/renewal, and rings/march
STAGE = _march()
MEMBER = _march()  # bearing,
KIND = _march()  # kind of its lines,
CURSOR = _march()  # and how many candidates for them were tried
AIM = _march()  # rad/s: for which all is found
TURN = _march()  # pieces so far,
MADE = _march()  # of this renewal,
MADE_LAST = _march()  # of the last one
RAMP = _march(2)  # rad/s2: of the shaft, smoothed, and its magnitude
EXCHANGED = _march()  # s: when the lines in use were exchanged for the ones before
TOKEN = _march()  # what the sound in the work space is of
# search for a motion that grows by itself: see rings/growth
NEW = _march()  # 1: what bearings hold was renewed since it began
WAITED = _march()  # s: since its last round
SEARCH = _march()  # number of the start that it goes on from, from 1; 0: it rests
ROUND = _march()  # rounds from that start,
RATE_NOW = _march(2)  # 1/s, rad/s: the complex rate reached
RATE_MOST = _march(2)  # that of the motion found that grows most,
RATE_KNOWN = _march(2)  # and in the last search; zero: none
MARCHED = _march.next

# fidelity response, at the end: lines, each with the complex displacements of the padded coordinates
_line = Places()
LINE_BALL = _line()  # multiples of the angles as of a single bearing's lines, its weight and the heap,
LINE_SHAFT = _line()
LINE_ROLLED = _line()
LINE_WEIGHT = _line()
LINE_HEAP = _line()
LINE_MEMBER = _line()  # of which bearing,
LINE_REAL = _line.next  # m, rad: real parts; imaginary parts follow
TAIL_MEAN = FOUR  # behind the lines, from how many there were before those in use to their equilibrium

# what the equations of all lines are made of: matrices of the coordinates by padded columns
LINE_MASS, LINE_DAMPING, LINE_STIFFNESS = range(3)
LINE_MATRICES = 3

# --- work space -------------------------------------------------------------------------------------
_at = Places()
INPUT = _at(_U.SIZE)  # inputs of one bearing
POWER = _at(STAGES * POWERS)  # W: work, heats of shaft and pedestal, per stage
ROTOR_FORCE = _at(STAGES * PLANE)  # N, N m: on the rotor at a port, per stage
NOSE_COMPLIANCE = _at(2 * PLANE * PLANE)  # of the nose by loads, then its inverse, row by row
W_HEAD = _at.next
# vectors of n numbers: accelerations and rates of each stage, then
VELOCITIES = STAGES
VECTORS = Places(2 * STAGES)
PLACE = VECTORS()  # m, rad: of the stage,
RATE = VECTORS()
RESIDUAL = VECTORS()  # N, N m: of Newton's equations,
INCREMENT = VECTORS()  # and their solution
FORCE = VECTORS()  # N, N m
ACCELERATION = VECTORS()  # m/s2, rad/s2
NEWMARK = VECTORS()  # m/s, rad/s: Newmark's velocities (fidelity rings)
VECTORS = VECTORS.next
# where a set starts: numbers per bearing, over the same
_start = Places()
START_RING = _start(PLANE)  # m, rad: inner ring against the outer one,
START_TILT = _start(2)  # rad: of the outer ring,
START_OUTER = _start(HOUSING)  # m, rad: and its place
START_FORCE = _start(PLANE)  # N, N m: on the inner ring
START_LOAD = _start(LANES)  # N, N m: on both rings, then on the driven rows
START_MORE = _start(LANES)  # N, N m: on both rings, by which steady forces exceed quasi-static ones
START_BEFORE = _start(LANES)  # N, N m: and the quasi-static ones
START_ECCENTRICITY = _start()  # m: set aside
START_ASIDE = _start(2)  # m: y z of the outer ring, which was put on the axis
TURNED = 3 * LANES  # cosine and sine of a bearing's orbit angle since its Jacobian
SCRATCH = max(TURNED + 2, _start.next)  # per bearing: its compliance in driven rows, what drives them, other
# equations: rows of one more than unknowns; then vectors
_vector = Places()
UNKNOWNS = _vector()  # m, rad
TRIALS = _vector()
FORCES = _vector()  # N, N m
TRIAL_FORCES = _vector()
STEPS = _vector()
MOTIONS = _vector(PLANE)  # of a bearing's inner ring against the outer one
START_VECTORS = 1 + _vector.next  # with the right side


def first(p, place):
    """Place in ``p`` of the set's table that begins where ``place`` of its block says."""
    return int(p[_P.SET]) + int(p[int(p[_P.SET]) + place])


def has_shaft(p):
    """Whether the parameters ``p`` are of a set on a shaft: a single bearing has no other coordinates."""
    return p[_P.SET] != 0.0 and p[_P.ALONE] == 0.0


def inputs(p):
    """Length of ``u`` for the parameters ``p``."""
    count = int(p[int(p[_P.SET]) + BEARINGS]) if has_shaft(p) else 1
    return _U.BEARINGS + count * _U.ROW


def padded_size(count):
    """Return how many numbers a vector of ``count`` coordinates has: whole groups of four."""
    return -(-count // FOUR) * FOUR


def line_size(count):
    """How many numbers a line has for ``count`` coordinates."""
    return LINE_REAL + 2 * padded_size(count)


def state_size(bearings, count, mics=0, lines=False):
    """Length of the set's own in ``s``: head, vectors, per bearing, inverse, march, levels, ``lines``."""
    own = S_HEAD + MOTION * padded_size(count) + bearings * PER_BEARING + count * padded_size(count)
    own += MARCHED + (_H.VECTORS + count) * padded_size(count) + bearings * mics
    table = _L.MOST_LINES * bearings * line_size(count) + TAIL_MEAN + padded_size(count)
    return own + (table if lines else 0)


def work_size(bearings, count):
    """Length of the set's own in ``w``: head, stages, Newton's vectors, bearings, the start's equations."""
    start = padded_size(count) + HOUSING * bearings
    own = W_HEAD + VECTORS * padded_size(count) + bearings * SCRATCH
    equations = start * (start + START_VECTORS) + 2 * count * padded_size(count)
    # of lines, with the three matrices they are made of, and what balls and cage add by rows
    complex_ones = (2 * (count + 1) + LINE_MATRICES * count) * padded_size(count) + 2 * count * count
    return own + max(equations, complex_ones) + FOUR


def z_mics(bearings):
    """Place of the microphones among the set's own in ``z``: as of a single bearing, third octaves behind."""
    return Z_FORCES + Z_FORCE * bearings


def z_alone(bearings, mics, bands):
    """Place of the first microphone's levels of each bearing alone; the next microphone's follow."""
    return z_mics(bearings) + (_Z.PER_MIC + bands) * mics


def z_accelerometers(bearings, mics, bands):
    """Place of the first accelerometer's first output, behind the levels of each bearing alone."""
    return z_alone(bearings, mics, bands) + bearings * mics


def output_size(bearings, mics=0, bands=0, accelerometers=0):
    """Length of the set's own in ``z``."""
    return z_accelerometers(bearings, mics, bands) + _Z.PER_ACCELEROMETER * accelerometers
