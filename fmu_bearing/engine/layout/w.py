"""W: work space. Scratch: no value survives a call.

First the rows of the force evaluation, then numbers, then the stages of a step. Some areas share places,
because they are never in use together: :data:`LEDGER` names them all with what they are used by, and a test
holds that no two of one use overlap.
"""

from typing import NamedTuple

from fmu_bearing.engine.layout import (
    f as _F,
    motion as _MO,
    p as _P,
    pose as _X,
    q as _Q,
    race as _R,
    y as _Y,
)
from fmu_bearing.engine.layout.sizes import BLOCK, STAGES, STRIDE, Places

# force and moment of one body on the balls: rows
_force = Places()
FX = _force(STRIDE)  # N
FR = _force(STRIDE)
FT = _force(STRIDE)
MX = _force(STRIDE)  # N m
MR = _force(STRIDE)
MT = _force(STRIDE)
FORCE_SIZE = _force.next

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
ROWS = _at.next
SCALARS = _at(64)
LANDS_ENERGY = _at()  # J: stored in the cage's lands
STAGE = _at(_Y.SIZE)  # stage state
F = _at(_F.SIZE)  # right-hand side
F0 = _at(_F.SIZE)  # unperturbed right-hand side
D = _at(_F.SIZE)  # Newton increment
ACC = _at(STAGES * _F.SIZE)  # stage accelerations
VEL = _at(STAGES * _F.SIZE)  # stage velocities in the layout of accelerations
# a block of one-evaluation steps: accelerations two and one step back, now and new; their states
BLOCK_A = _at((BLOCK + 3) * _F.SIZE)
BLOCK_Y = _at((BLOCK + 1) * _Y.SIZE)
MOTION = _at(_MO.MAX_SIZE)  # motion sample: see motion
BODY_0 = _at(_Q.SIZE * STRIDE)  # unperturbed generalised forces
SOUND = _at.next  # work space of the sound kernels

LAST = ACC + (STAGES - 1) * _F.SIZE  # accelerations at the end of a step, of any method
FLEX = BLOCK_A  # flexible rings: never together with one-evaluation steps; see flexure
FOUND = VEL  # result of the quasi-static kernel at a start


class Area(NamedTuple):
    """Places ``first`` to ``first + size`` of ``w``, and the uses that need them at the same time."""

    name: str
    first: int
    size: int
    uses: frozenset[str]


# The right-hand side is evaluated in the course of all these; what is read from its rows afterwards (energy,
# losses) is read before anything else begins.
_EVALUATED = frozenset({"evaluation", "jacobian", "step", "block", "inputs"})
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
    # the state at the end of a step is sampled; in fidelities rings and response the trial state
    Area(
        "STAGE",
        STAGE,
        _Y.SIZE,
        frozenset({"evaluation", "solve", "step", "block", "sample", "start", "condensed", "lines"}),
    ),
    Area("F", F, _F.SIZE, frozenset({"evaluation", "jacobian", "solve", "step", "block", "condensed"})),
    Area("F0", F0, _F.SIZE, frozenset({"jacobian"})),
    Area("BODY_0", BODY_0, _Q.SIZE * STRIDE, frozenset({"jacobian"})),
    Area("D", D, _F.SIZE, frozenset({"solve", "step", "block"})),
)


def size(p):
    """Length of ``w`` for the parameters ``p``."""
    return SOUND + int(p[_P.SOUND_WORK]) + 8
