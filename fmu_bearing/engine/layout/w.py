"""W: work space. Scratch: no value survives a call.

First the rows of the force evaluation, then numbers, then the stages of a step. Some areas share places,
because they are never in use together: :data:`LEDGER` names them all with what they are used by, and a test
holds that no two of one use overlap.
"""

from typing import NamedTuple

from fmu_bearing.engine.layout import (
    c as _C,
    condensed as _L,
    contact as _K,
    defect as _DE,
    equilibrium as _EQ,
    f as _F,
    factors as _A,
    flexure as _FL,
    jacobian as _J,
    motion as _MO,
    p as _P,
    pattern as _PT,
    pose as _X,
    q as _Q,
    race as _R,
    spindle as _SP,
    statics as _ST,
    u as _U,
    y as _Y,
)
from fmu_bearing.engine.layout.sizes import FOUR, MAX_BALLS, MAX_DEFECTS, STAGES, STRIDE, Places

# force and moment of one body on the balls: rows
_force = Places()
FX = _force(STRIDE)  # N
FR = _force(STRIDE)
FT = _force(STRIDE)
MX = _force(STRIDE)  # N m
MR = _force(STRIDE)
MT = _force(STRIDE)
FORCE_SIZE = _force.next

# report of a Runge-Kutta step
_report = Places()
ERROR = _report()  # m/s: its estimate
ITERATIONS = _report()
# of each bearing of a set:
SIZE = _report()  # m/s: of Newton's last increment
CONTRACTION = _report(2)  # its increments over the set's largest before, see S: the worst found, 0: none
REPORT_SIZE = _report.next

_at = Places()
COS = _at(STRIDE)  # of the balls' angles
SIN = _at(STRIDE)
POSE = _at(3 * _X.SIZE)  # of the balls in inner ring, outer ring, cage: see pose
RACE = _at(2 * _R.SIZE)  # contacts with inner and outer race: see race
POCKET = _at(2 * STRIDE)  # m: penetration of the pocket, ahead and behind
FORCE = _at(3 * FORCE_SIZE)  # on the balls from inner ring, outer ring, cage: FX .. MT each
BODY = _at(_Q.SIZE * STRIDE)  # N, N m: generalised forces of each ball on the bodies
SHAFT = _at(STRIDE)  # N m on the inner ring about its own axis
LOSS = _at(2 * STRIDE)  # W: dissipated at inner race, outer race,
LOSS_CAGE = _at(STRIDE)  # in the pockets,
LOSS_DRAG = _at(STRIDE)  # by drag on the balls and by the dampers between them
AXES = _at(3 * STRIDE)  # the balls' body-fixed axes at the state evaluated
DEFECT_AXES = _at(_DE.VECTOR * MAX_DEFECTS)  # and the directions of local defects on balls
ROWS = _at.next
LANDS_ENERGY = _at()  # J: stored in the cage's lands
LOAD = _at(_EQ.FREEDOMS)  # N, N m: on the inner ring, for the quasi-static kernel
TILT = _at(2)  # rad: tilts y z of the outer ring that it found
CONDITIONS = _at(_C.SIZE)  # at the inputs just taken, see c
TRIAL = _at(9 * _L.COLUMN + 6 * _L.BOTH + 16 * FOUR)  # trial numbers of rings and response: see trial
REPORT = _at(REPORT_SIZE)  # of a Runge-Kutta step: ERROR, ITERATIONS, ...
WEIGHTS = _at(STAGES * FOUR)  # s: what the stages before count in this one, each for four lanes
STAGE = _at(_Y.SIZE)  # stage state
F = _at(_F.SIZE)  # right-hand side
F0 = _at(_F.SIZE)  # right-hand side where the Jacobian was made
D = _at(_F.SIZE)  # Newton increment
ACC = _at(STAGES * _F.SIZE)  # stage accelerations
VEL = _at(STAGES * _F.SIZE)  # stage velocities in the layout of accelerations
FLEX = _at(_FL.SIZE)  # flexible rings: see flexure
MOTION = _at(_MO.SIZE)  # motion sample: see motion
CONTACT = _at(_K.SIZE)  # derivatives of contacts by motion: see contact
PATTERN = _at(_PT.SIZE)  # steady state of unequal balls: see pattern
SET = _at(_SP.work_size(1, _L.N))  # work space of a set's own, where the bearing is alone
SOUND = _at.next  # work space of the sound kernels, then the matrices of PATTERN: see `steady.pattern`
SPARE = 8  # numbers between both

LAST = ACC + (STAGES - 1) * _F.SIZE  # accelerations at the end of a step, of any method
# where a run starts
EQUILIBRIUM = VEL  # result of the quasi-static kernel
STATICS = POSE  # its work space: see statics
SPIN_SYSTEM = FORCE  # equations for orbit and spin of one ball
SPINS_FIRST = ACC  # rad/s: those rates of all balls before they are balanced
# rigid preload at a start, and whenever the preload changes: see statics/rigid_preload
_still = Places(D)
STILL_INPUTS = _still(_U.SIZE)  # inputs at standstill and reference temperature,
STILL_CONDITIONS = _still(_C.SIZE)  # what they mean,
STILL_EQUILIBRIUM = _still(_ST.AXIAL_SIZE)  # and the equilibrium under axial load there
STILL_END = _still.next

# the Newton system, over forces on balls that the evaluation before has added up: while it is factored
_factor = Places(FORCE)
COLUMN = _factor(STRIDE)  # a column of the springs between balls
BORDER_SUMS = _factor(_Q.SIZE * FOUR)  # a row of the border through the balls, in four partial sums each
BORDER = _factor(_Q.SIZE * _Q.SIZE)  # what the balls leave of the bodies' block, row by row
PIVOTS = _factor(MAX_BALLS)  # of inverting it, or the springs' matrix
FACTOR_END = _factor.next
# and while it is solved
_solve = Places(FORCE)
OWN = _solve(_J.BALL * STRIDE)  # the balls' own inverses times their residual
REST = _solve(_A.BORDER)  # the bodies' residual less the balls' solutions
BODIES = _solve(_A.BORDER)  # the bodies' increment
BODY_SUMS = _solve(_Q.SIZE * FOUR)  # what the balls put on the bodies, in four partial sums each
SPRING_ORBIT = _solve(STRIDE)  # of springs between balls: U^T x, T U^T x and z of newton/springs
SPRING_PULL = _solve(STRIDE)
SPRING_RESPONSE = _solve(STRIDE)
SOLVE_END = _solve.next
# flexible rings while their modes are factored, over rows that the evaluation before has done with
_grooves = Places(FLEX + _FL.X)
GROOVE_INERTIA = _grooves(_FL.INERTIAS)  # kg: of each groove against each
GROOVE_ROW = _grooves(_J.BALL)  # kg: one direction of a groove against one ball's motion
GROOVES_END = _grooves.next
FIRST_PLACES = ACC + _F.SIZE  # m: places x, r of the balls between rigid rings, while flexible ones settle


class Area(NamedTuple):
    """Places ``first`` to ``first + size`` of ``w``, and the uses that need them at the same time."""

    name: str
    first: int
    size: int
    uses: frozenset[str]


_FLEXED = frozenset({"evaluation", "jacobian", "factor", "solve", "step", "inputs", "start", "sample"})
# The right-hand side is evaluated in the course of all these; what is read from its rows afterwards (energy,
# losses) is read before anything else begins.
_EVALUATED = frozenset({"evaluation", "jacobian", "step", "inputs"})
#: All areas of ``w``.
LEDGER: tuple[Area, ...] = (
    Area("COS", COS, STRIDE, _EVALUATED),
    Area("SIN", SIN, STRIDE, _EVALUATED),
    Area("POSE", POSE, 3 * _X.SIZE, _EVALUATED),
    Area("RACE", RACE, 2 * _R.SIZE, _EVALUATED),
    Area("POCKET", POCKET, 2 * STRIDE, _EVALUATED),
    Area("FORCE", FORCE, 3 * FORCE_SIZE, _EVALUATED),
    Area("BODY", BODY, _Q.SIZE * STRIDE, _EVALUATED),
    Area("SHAFT", SHAFT, STRIDE, _EVALUATED),
    Area("LOSS", LOSS, 2 * STRIDE, _EVALUATED),
    Area("LOSS_CAGE", LOSS_CAGE, STRIDE, _EVALUATED),
    Area("LOSS_DRAG", LOSS_DRAG, STRIDE, _EVALUATED),
    Area("LANDS_ENERGY", LANDS_ENERGY, 1, _EVALUATED),
    # turned once per stage, then read by every evaluation between solutions; at a start between factors too
    Area("AXES", AXES, 3 * STRIDE, _EVALUATED | {"factor", "solve"}),
    Area("DEFECT_AXES", DEFECT_AXES, _DE.VECTOR * MAX_DEFECTS, _EVALUATED | {"factor", "solve"}),
    # the state at the end of a step is sampled; in fidelities rings and response the trial state
    Area(
        "STAGE",
        STAGE,
        _Y.SIZE,
        frozenset({"evaluation", "solve", "step", "sample", "start", "condensed", "lines"}),
    ),
    Area("F", F, _F.SIZE, frozenset({"evaluation", "jacobian", "solve", "step", "condensed"})),
    Area("F0", F0, _F.SIZE, frozenset({"jacobian"})),
    Area("CONTACT", CONTACT, _K.SIZE, frozenset({"jacobian"})),
    Area("D", D, _F.SIZE, frozenset({"solve", "step"})),
    Area("PATTERN", PATTERN, _PT.SIZE, _EVALUATED | {"start"}),
    Area("STATICS", STATICS, _ST.SIZE, frozenset({"start"})),
    Area("SPIN_SYSTEM", SPIN_SYSTEM, _ST.SPIN_SYSTEM_SIZE, frozenset({"start"})),
    Area("SPINS_FIRST", SPINS_FIRST, _ST.SPIN_RATES * STRIDE, frozenset({"start", "jacobian", "evaluation"})),
    Area("MOTION", MOTION, _MO.SIZE, frozenset({"sample"})),
    Area("STILL", STILL_INPUTS, STILL_END - STILL_INPUTS, frozenset({"start", "inputs"})),
    Area("LOAD", LOAD, _EQ.FREEDOMS, frozenset({"start", "inputs", "evaluation"})),
    Area("TILT", TILT, 2, frozenset({"start", "inputs", "evaluation"})),
    Area("CONDITIONS", CONDITIONS, _C.SIZE, frozenset({"start", "inputs", "evaluation"})),
    Area("REPORT", REPORT, REPORT_SIZE, frozenset({"step"})),
    Area("WEIGHTS", WEIGHTS, STAGES * FOUR, frozenset({"step"})),
    Area("ACC", ACC, (STAGES - 1) * _F.SIZE, frozenset({"step", "solve"})),
    # the last stage of ACC: the sound samples of a step and the new state are taken from it, by any method
    Area("LAST", LAST, _F.SIZE, frozenset({"step", "solve", "sample"})),
    Area("VEL", VEL, STAGES * _F.SIZE, frozenset({"step", "solve"})),
    Area("EQUILIBRIUM", EQUILIBRIUM, _EQ.SIZE, frozenset({"start"})),
    Area("FIRST_PLACES", FIRST_PLACES, 2 * STRIDE, frozenset({"start", "evaluation", "jacobian", "factor"})),
    Area("factor", FORCE, FACTOR_END - FORCE, frozenset({"factor"})),
    Area("solve", FORCE, SOLVE_END - FORCE, frozenset({"solve"})),
    Area("FLEX rows", FLEX, _FL.COS, frozenset({"evaluation", "solve"})),
    Area("GROOVES", GROOVE_INERTIA, GROOVES_END - GROOVE_INERTIA, frozenset({"factor"})),
    Area("FLEX", FLEX + _FL.COS, _FL.SIZE - _FL.COS, _FLEXED),
)


def size(p):
    """Length of ``w`` for the parameters ``p``."""
    if _SP.has_shaft(p):
        return int(p[int(p[_P.SET]) + _SP.SIZE_W])
    unknowns = _PT.BALL * int(p[_P.BALLS]) + _PT.TAIL
    return SOUND + int(p[_P.SOUND_WORK]) + SPARE + _PT.MATRICES * unknowns * (unknowns + 1)
