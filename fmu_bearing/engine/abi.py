"""Public entry points: ``init``, ``step``, ``outputs`` over the flat arrays of ``layout``.

Each returns a status code; none raises or allocates. A refused call leaves the state as it was, except
that a step which fails to converge leaves it at the time it reached: the caller restores its copy.
"""

import math

from fmu_bearing.engine.choices import FULL, RESPONSE, RINGS
from fmu_bearing.engine.fidelities.full.march import march
from fmu_bearing.engine.fidelities.full.start import start
from fmu_bearing.engine.fidelities.response.march import march_response, start_response
from fmu_bearing.engine.fidelities.rings.march import march_rings, start_rings
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import P, U
from fmu_bearing.engine.readout.outputs import observe
from fmu_bearing.engine.status import BAD_INPUT, BAD_STEP, OK, RIGID_ONLY

_LARGEST = 1e15  # of any input, in its unit
_FASTEST = 1.1e4  # rad/s
_COLDEST_OIL = 230.0  # K
_COLDEST_RING = 200.0  # K
_LONGEST = 1e6  # s: communication step


@kernel
def inputs_usable(u):
    """Whether every input is finite and within what the equations can take."""
    for i in range(U.SIZE):
        if not (abs(u[i]) < _LARGEST):
            return False
    return (
        u[U.PEDESTAL] > 0.0
        and abs(u[U.SPEED]) <= _FASTEST
        and u[U.OIL_T] >= _COLDEST_OIL
        and u[U.INNER_T] >= _COLDEST_RING
        and u[U.OUTER_T] >= _COLDEST_RING
    )


@kernel
def init(p, u, s, z, w, t):
    """Put the state to the quasi-static one at the inputs' values and time ``t`` (s); fill the outputs."""
    if not inputs_usable(u) or not math.isfinite(t):
        return BAD_INPUT
    if p[P.MODES] != 0.0 and p[P.FIDELITY] != FULL:
        return RIGID_ONLY
    if p[P.FIDELITY] == RINGS:
        status = start_rings(p, u, s, w, t)
    elif p[P.FIDELITY] == RESPONSE:
        status = start_response(p, u, s, w, t)
    else:
        status = start(p, u, s, w, t)
    if status == OK:
        observe(p, s, z)
    return status


@kernel
def step(p, u, s, z, w, h):
    """Advance the state by ``h`` (s) with the speed ramping to its input and the other inputs held."""
    if not (h > 0.0 and h < _LONGEST):
        return BAD_STEP
    if not inputs_usable(u):
        return BAD_INPUT
    if p[P.FIDELITY] == RINGS:
        status = march_rings(p, u, s, w, h)
    elif p[P.FIDELITY] == RESPONSE:
        status = march_response(p, u, s, w, h)
    else:
        status = march(p, u, s, w, h)
    if status == OK:
        observe(p, s, z)
    return status


@kernel
def outputs(p, s, z):
    """Fill the outputs ``z`` from the state ``s``."""
    observe(p, s, z)
    return OK
