"""S: state, all that a later step needs and nothing else."""

from fmu_bearing.engine.choices import RESPONSE
from fmu_bearing.engine.layout import (
    c as _C,
    condensed as _L,
    defect as _DE,
    drift as _DR,
    f as _F,
    factors as _A,
    flexure as _FL,
    jacobian as _J,
    lines as _LN,
    p as _P,
    race as _R,
    spindle as _SP,
    y as _Y,
)
from fmu_bearing.engine.layout.sizes import FOUR, MAX_DEFECTS, STRIDE, Places

_at = Places()
Y = _at(_Y.SIZE)  # positions and velocities
F = _at(_F.SIZE)  # right-hand side at the state: accelerations start the next step
C = _at(_C.SIZE)  # conditions
TIME = _at()  # s
ANGLE = _at()  # rad, of the inner ring
SPEED = _at()  # rad/s, reached at TIME
SPEED_RATE = _at()  # rad/s2
WORK = _at()  # J
HEAT = _at(3)  # J: given to inner ring, outer ring, oil
ENERGY_START = _at()  # J
STEP = _at()  # s: internal step proposed next
FACTOR_STEP = _at()  # s: step for which the bearing's factors hold; 0: none
JACOBIAN_TIME = _at()  # s
JACOBIAN_ANGLE = _at()  # rad: orbit angle of the Jacobian
CONTRACTION = _at(2)  # of Newton's method in the first implicit stage and in the others, see full/jacobians
STEPS = _at()
REJECTED = _at()
MEAN_HEAT = _at(3)  # W: heats averaged over the last communication step
MEAN_TORQUE = _at()  # N m: taken from the shaft in the last communication step, see fidelities/steps
SHAFT_WORK = _at()  # J: of that torque since the communication step began,
TORQUE_TIME = _at()  # N m s: and its time integral
SAMPLE = _at()  # index of the next sound sample
START = _at()  # s: time of initialisation
NEWTON = _at()  # iterations so far
JACOBIANS = _at()
ENERGY_NOW = _at()  # J
SPIN_TO_ROLL = _at(2)  # inner, outer: means over the loaded contacts at the last communication point
SLIP = _at(2)  # m/s
LOSS = _at.next  # losses by source
LOSS_CONTACTS = _at()  # W: sliding and damping
LOSS_ROLLING = _at()
LOSS_CAGE = _at()
LOSS_DRAG = _at()
LOSSES = _at.next - LOSS  # number of sources
PLACE = _at()  # m: where rigid preload takes the inner ring
RING_SQUARE = _at()  # m2/s2: fading mean square of the rings' velocity, fidelity full
PEAK = _at()  # error estimates over what is allowed: the largest, as far as it is not forgotten
SETTLED = _at()  # what the start found of the steady state: see steady/point
RESTARTS = _at()  # of fidelities rings and response at rest, where a step had failed
GROWTH = _at()  # 1/s: of the motion that grows most by itself, in fidelities rings and response
SEEN = _at(_DE.SEEN_SIZE * MAX_DEFECTS)  # what outputs tell of local defects
CONTACTS = _at(2 * _R.KEPT)  # of the balls with both races at the last communication point
CHANGE = _at(_F.WORK)  # m/s2, rad/s2: of the accelerations towards the end of the last step of full,
CHANGE_TIME = _at()  # s: and in what time; 0: unknown
AXES = _at(3 * STRIDE)  # the balls' body-fixed axes in their orbiting axes
DEFECT_AXES = _at(
    _DE.VECTOR * MAX_DEFECTS
)  # from ball centre to each local defect on a ball, in its orbiting axes
JAC = _at(_J.SIZE)  # Jacobian
FAC = _at(_A.SIZE)  # factors
_MORE = _at(-(-max(_LN.SIZE - _J.SIZE - _A.SIZE, 0) // FOUR) * FOUR)  # the lines' scratch is larger
CONDENSED = _at(_L.SIZE)  # what fidelities rings and response keep
SET = _at(_SP.state_size(1, _L.N))  # what a set keeps of its own, where the bearing is alone
SOUND = _at.next  # sound state, then flexure (fidelity full) or lines (response)


def front(p):
    """Length of the part of ``s`` that steps go on from, which all of ``s`` is but in fidelity `response`.

    There inputs and a second such part follow, in which what is frozen is renewed (``response/renewal``),
    then what is kept of a drift (``DR``).
    """
    if _SP.has_shaft(p):
        return int(p[int(p[_P.SET]) + _SP.FRONT])
    lines = _L.TABLE_SIZE if p[_P.FIDELITY] == RESPONSE else 0
    return SOUND + int(p[_P.SOUND_STATE]) + _FL.state_size(int(p[_P.MODES])) + lines


def size(p):
    """Length of ``s`` for the parameters ``p``."""
    if p[_P.FIDELITY] != RESPONSE:
        return front(p)
    bearings, padded_size = 1, _L.COLUMN
    if _SP.has_shaft(p):
        block = int(p[_P.SET])
        bearings, padded_size = int(p[block + _SP.BEARINGS]), int(p[block + _SP.PADDED_SIZE])
    return 2 * front(p) + _SP.inputs(p) + _DR.size(bearings, _SP.inputs(p), padded_size)
