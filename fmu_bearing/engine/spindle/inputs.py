"""Inputs of a set as conditions of its bearings, of shaft and housing; what grows with temperature.

Arguments: see `members`.
"""

import math

from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, C, P, Q, S, U, W
from fmu_bearing.engine.mechanics.conditions import conditions, defect_scales, regrow
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.shaft import has_housing, static_load

_STILL = 1e-15  # m
_PEDESTAL = 1e8  # N/m: of a ring that is fixed, so read by nothing


@kernel
def inputs(p):
    """Return how many inputs there are."""
    return U.BEARINGS + members.bearing_count(p) * U.ROW


@kernel
def bearing_inputs(p, u, b, out):
    """Put the ``U.SIZE`` inputs of bearing ``b`` as a single one to ``out``."""
    for i in range(U.BEARINGS):
        out[i] = u[i]
    for i in range(U.ROW):
        out[U.BEARINGS + i] = u[U.BEARINGS + b * U.ROW + i]
    if not members.has_shaft(p):
        return
    # shaft and spacers load it
    out[U.PRELOAD] = 0.0
    for i in range(SP.PLANE):
        out[U.NOSE + i] = 0.0
    if p[members.row(p, b) + SP.ROW_SEAT] != SP.PEDESTAL:
        out[U.PEDESTAL] = _PEDESTAL


@kernel
def bearing_conditions(p, u, b, speed, w):
    """Conditions of bearing ``b`` into ``W.CONDITIONS`` of its work space; ``speed``: see ``conditions``."""
    given = members.set_work(p, w)[SP.INPUT : SP.INPUT + U.SIZE]
    bearing_inputs(p, u, b, given)
    wb = members.work(p, w, b)
    c = wb[W.CONDITIONS : W.CONDITIONS + C.SIZE]
    conditions(members.parameters(p, b), given, speed, c)
    # they may change between steps, when the first bearing's alone are set
    defect_scales(p, members.parameters(p, b), c)


@kernel
def grow(p, u, s, w, speed):
    """Let the races of all bearings grow to ``speed`` (rad/s), which is reached within a communication step.

    Growth that changed at communication points alone would sound at their rate.
    """
    given = members.set_work(p, w)[SP.INPUT : SP.INPUT + U.SIZE]
    for b in range(members.bearing_count(p)):
        bearing_inputs(p, u, b, given)
        regrow(members.parameters(p, b), given, speed, members.state(p, s, b)[S.C : S.C + C.SIZE])


@kernel
def offset_change(p, u, b):
    """How far (m) temperatures push the inner ring of bearing ``b`` into it, beyond 20 degC."""
    block = int(p[P.SET])
    r = members.row(p, b)
    shaft = p[block + SP.SHAFT_EXPANSION] * (u[U.SHAFT_T] - REFERENCE_TEMPERATURE)
    housing = p[block + SP.HOUSING_EXPANSION] * (u[U.HOUSING_T] - REFERENCE_TEMPERATURE)
    return p[r + SP.ROW_SIGN] * p[r + SP.ROW_POSITION] * (shaft - housing)


@kernel
def loads_differ(p, u, own):
    """Whether loads on the nose, force of springs or the housing's pedestal differ from the state's."""
    if not members.has_shaft(p):
        return False
    if own[SP.SPRING] != u[U.PRELOAD]:
        return True
    for i in range(SP.PLANE):
        if own[SP.NOSE + i] != u[U.NOSE + i]:
            return True
    return (
        has_housing(p)
        and own[SP.PEDESTAL_STIFFNESS + Q.Z] != u[U.PEDESTAL] * p[int(p[P.SET]) + SP.PEDESTAL_Z]
    )


@kernel
def take_loads(p, u, own):
    """Put loads on the nose, force of springs and pedestal of the housing into the set's own state."""
    if not members.has_shaft(p):
        return
    block = int(p[P.SET])
    own[SP.SPRING] = u[U.PRELOAD]
    for i in range(SP.PLANE):
        own[SP.NOSE + i] = u[U.NOSE + i]
    static_load(p, own)
    if not has_housing(p):
        return
    radial = u[U.PEDESTAL]
    for i in range(SP.PEDESTAL_TERMS):
        stiffness = radial
        inertia = p[block + SP.HOUSING_MASS]
        if i == Q.X:
            stiffness = radial * p[block + SP.AXIAL_RATIO]
        elif Q.TURN <= i < SP.HOUSING:
            stiffness = radial * p[block + SP.ROTATIONAL_RATIO]
            inertia = p[block + (SP.HOUSING_POLAR if i == Q.TURN else SP.HOUSING_TRANSVERSE)]
        own[SP.PEDESTAL_STIFFNESS + i] = stiffness
        own[SP.PEDESTAL_DAMPING + i] = 2.0 * p[block + SP.PEDESTAL_ZETA] * math.sqrt(stiffness * inertia)
    # along y, along z and between both, as `conditions` has them of one bearing
    for k in range(3):
        i = SP.BETWEEN if k == 2 else Q.Y + k
        own[SP.PEDESTAL_STIFFNESS + i] *= p[block + SP.PEDESTAL_Y + k]
        own[SP.PEDESTAL_DAMPING + i] *= p[block + SP.PEDESTAL_DAMPING_Y + k]


@kernel
def spread_choices(p):
    """Copy the parameters that are tunable before initialisation from the first bearing to the others."""
    for b in range(1, members.bearing_count(p)):
        pb = members.parameters(p, b)
        for i in range(P.TUNABLE):
            pb[i] = p[i]


@kernel
def growth_rate(p, u, own, b, h):
    """Rate (m/s) of the offset of bearing ``b`` on its way, in ``h`` (s), to the temperatures of ``u``."""
    at = members.per_bearing(p, b)
    away = own[at + SP.OFFSET_COLD] + offset_change(p, u, b) - own[at + SP.OFFSET]
    # rounding of the place is not worth a new speed, which would cost an evaluation each step
    return 0.0 if abs(away) < _STILL else away / h
