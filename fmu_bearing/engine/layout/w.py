"""W: work space. Scratch: no value survives a call.

First the rows of the force evaluation, then numbers, then the stages of a step. Some areas share places,
because they are never in use together: :data:`LEDGER` names them all with what they are used by, and a test
holds that no two of one use overlap.
"""

from typing import NamedTuple

from fmu_bearing.engine.layout import (
    c as _C,
    condensed as _L,
    equilibrium as _EQ,
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
FORCE = _at(3 * FORCE_SIZE)  # on the balls from inner ring, outer ring, cage
BODY = _at(_Q.SIZE * STRIDE)  # N, N m: generalised forces of each ball on the bodies
SHAFT = _at(STRIDE)  # N m on the inner ring about its own axis
LOSS = _at(4 * STRIDE)  # W: dissipated at inner race, outer race, cage, and by drag
AXES = _at(3 * STRIDE)  # the balls' body-fixed axes at the state evaluated
ROWS = _at.next
SCALARS = _at(64)
LOAD = _at(_EQ.FREEDOMS)  # N, N m: on the inner ring, for the quasi-static kernel
TILT = _at(2)  # rad: tilts y z of the outer ring that it found
CONDITIONS = _at(_C.SIZE)  # at the inputs just taken, see c
TRIAL = _at(4 * _L.COLUMN)  # trial numbers of fidelities rings and response: see trial
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


#: All areas of ``w``.
LEDGER: tuple[Area, ...] = (
    Area("LOAD", LOAD, _EQ.FREEDOMS, frozenset({"start", "inputs", "evaluation"})),
    Area("TILT", TILT, 2, frozenset({"start", "inputs", "evaluation"})),
    Area("CONDITIONS", CONDITIONS, _C.SIZE, frozenset({"start", "inputs", "evaluation"})),
)


def size(p):
    """Length of ``w`` for the parameters ``p``."""
    return SOUND + int(p[_P.SOUND_WORK]) + 8
