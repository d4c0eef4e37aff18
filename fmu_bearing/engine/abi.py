"""Entries ``init``, ``step``, ``outputs``, ``derivative``, ``copy`` over the flat arrays of ``layout``.

Each returns a status code; none raises or allocates. A refused call leaves the state as it was, except
that a step which fails to converge leaves it at the time it reached: the caller restores its copy.
"""

import math

from fmu_bearing.engine.choices import FULL, RESPONSE, RINGS
from fmu_bearing.engine.fidelities.condensed.publish import find_contacts
from fmu_bearing.engine.fidelities.full.march import march
from fmu_bearing.engine.fidelities.full.port_derivative import port_derivative
from fmu_bearing.engine.fidelities.full.start import start
from fmu_bearing.engine.fidelities.response.march import march_response, start_response
from fmu_bearing.engine.fidelities.rings.restart import march_rings
from fmu_bearing.engine.fidelities.rings.start import start_rings
from fmu_bearing.engine.fidelities.state_copy import copy_live
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, P, U
from fmu_bearing.engine.readout.contacts import keep_contacts, knows_balls
from fmu_bearing.engine.readout.outputs import observe
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.inputs import bearing_inputs, inputs, spread_choices
from fmu_bearing.engine.spindle.outputs import observe_set
from fmu_bearing.engine.spindle.port import has_port
from fmu_bearing.engine.spindle.sound_sum import finish
from fmu_bearing.engine.status import BAD_INPUT, BAD_STEP, OK, OTHER_FIDELITY, RIGID_ONLY

_LARGEST = 1e15  # of any input, in its unit
# rad/s; m/s of the balls' circle, were it a wheel: 5 % beyond the ranges of scenes, `Bearing.most_speed`
_FASTEST, _FASTEST_RIM = 1.1e4, 143.0
_COLDEST_OIL = 230.0  # K
_COLDEST_RING = 200.0  # K
_LONGEST = 1e6  # s: communication step
# s: a shorter one counts as this long, in which nothing moves; below 1e-50 s powers of the length, up to the
# sixth, are no numbers, nor are rates of inputs
_SHORTEST = 1e-15


@kernel
def in_range(p, u):
    """Whether speed and temperatures of a bearing are within what the equations can take."""
    return (
        abs(u[U.SPEED]) <= max(_FASTEST, _FASTEST_RIM / p[P.PITCH_RADIUS])
        and u[U.OIL_T] >= _COLDEST_OIL
        and u[U.INNER_T] >= _COLDEST_RING
        and u[U.OUTER_T] >= _COLDEST_RING
        and u[U.SHAFT_T] >= _COLDEST_RING
        and u[U.HOUSING_T] >= _COLDEST_RING
    )


@kernel
def usable(p, u, w):
    """Whether every input is finite and within what the equations can take."""
    for i in range(inputs(p)):
        if not (abs(u[i]) < _LARGEST):
            return False
    if not u[U.PEDESTAL] > 0.0:
        return False
    given = members.set_work(p, w)[SP.INPUT : SP.INPUT + U.SIZE]
    for b in range(members.bearing_count(p)):
        bearing_inputs(p, u, b, given)
        if not in_range(members.parameters(p, b), given):
            return False
    return True


@kernel
def computed(p):
    """Whether the parameters are made for their fidelity.

    A ring on a pedestal of its own is among a set's coordinates in all fidelities but `full`, which alone
    follows the motion of a port. The state of a set has room for lines in `response` alone.
    """
    if not members.has_shaft(p):
        return True
    if has_port(p) and p[P.FIDELITY] != FULL:
        return False
    if p[P.FIDELITY] == RESPONSE and p[int(p[P.SET]) + SP.LINED] == 0.0:
        return False
    for b in range(members.bearing_count(p)):
        r = members.row(p, b)
        follows = p[r + SP.ROW_DRIVEN] == SP.DRIVEN
        if p[r + SP.ROW_SEAT] == SP.PEDESTAL and follows == (p[P.FIDELITY] == FULL):
            return False
    return True


@kernel
def bends(p):
    """Whether a ring has flexural modes."""
    flexible = False
    for b in range(members.bearing_count(p)):
        flexible = flexible or members.parameters(p, b)[P.MODES] != 0.0
    return flexible


@kernel
def keep(p, s, w):
    """Keep in the state what outputs need of the contacts, whose rows are in ``w`` after steps of `full`.

    Contacts of balls that nobody reads stay as they are: see `knows_balls`.
    """
    for b in range(members.bearing_count(p)):
        pb, sb, wb = members.parameters(p, b), members.state(p, s, b), members.work(p, w, b)
        if not knows_balls(p, sb):
            continue
        if p[P.FIDELITY] != FULL:
            find_contacts(pb, sb, wb)
        keep_contacts(pb, sb, wb)


@kernel
def outputs(p, s, z):
    """Fill the outputs ``z`` from the state ``s``."""
    if members.has_shaft(p):
        observe_set(p, s, z)
    else:
        observe(p, s, z)
    return OK


@kernel
def copy(p, s, kept):
    """Copy to ``kept`` what later steps need of the state ``s``; with both exchanged, go back to it.

    Neither is a state to be stored: what is left out of ``kept`` stays as it was.
    """
    copy_live(p, s, kept)
    return OK


@kernel
def init(p, u, s, z, w, t):
    """Put the state to the steady one at the inputs' values and time ``t`` (s); fill the outputs."""
    if not usable(p, u, w) or not math.isfinite(t):
        return BAD_INPUT
    if not computed(p):
        return OTHER_FIDELITY
    if bends(p) and p[P.FIDELITY] != FULL:
        return RIGID_ONLY
    if p[P.FIDELITY] == RINGS:
        status = start_rings(p, u, s, w, t)
    elif p[P.FIDELITY] == RESPONSE:
        status = start_response(p, u, s, w, t)
    else:
        status = start(p, u, s, w, t)
    if status == OK:
        keep(p, s, w)
        outputs(p, s, z)
    return status


@kernel
def step(p, u, s, z, w, h):
    """Advance the state by ``h`` (s) with the speed ramping to its input and the other inputs held."""
    if not (h > 0.0 and h < _LONGEST):
        return BAD_STEP
    h = max(h, _SHORTEST)
    if not usable(p, u, w):
        return BAD_INPUT
    spread_choices(p)  # a state put back brings the head of p with it, that of the first bearing alone
    if p[P.FIDELITY] == RINGS:
        status = march_rings(p, u, s, w, h)
    elif p[P.FIDELITY] == RESPONSE:
        status = march_response(p, u, s, w, h)
    else:
        status = march(p, u, s, w, h)
    finish(p, s, w)
    if status == OK:
        keep(p, s, w)
        outputs(p, s, z)
    return status


@kernel
def derivative(p, u, s, z, w, h):
    """Put the change of outputs to ``z`` for a change of inputs over one step of ``h`` (s) from the state.

    ``u``: inputs, then their change; ``s``: a copy of the state, then room for another; both are lost. Known
    are force and moment at a set's port by place and rate; what is not known is no number. Without a step
    behind (``h`` 0) places change them as at rest, rates do not.
    """
    for i in range(z.size):
        z[i] = math.nan
    if not (h >= 0.0 and h < _LONGEST):
        return BAD_STEP
    if not members.has_shaft(p) or not usable(p, u, w):
        return BAD_INPUT
    spread_choices(p)
    return port_derivative(p, u, s, z, w, h)
