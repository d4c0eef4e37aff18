"""Derivatives of the force at a port by the motion there: a step made twice, with a change to either side."""

from fmu_bearing.engine.fidelities.full.march import march
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, P, Q, U
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.inputs import inputs
from fmu_bearing.engine.spindle.port import has_port
from fmu_bearing.engine.status import BAD_INPUT, OK

_RESTING = 1e-3  # s: over so long balls and cage follow the rings
# Differences at a port. Faster ones bend friction and contact damping (10 nm in 1 us: 3 %). Small ones pass
# under the step control, which would not resolve the balls' contact modes (7 to 50 us) in short steps: 13 %
# at 5 us, 4 % at 20 us. So internal steps are parts of these; in longer ones the modes die away in time.
_NEAR = 1e-8  # m
_SLOWLY = 2e-3  # m/s
_SHORT = 2.5e-5  # s
_PARTS = 8.0
_ARM = 0.03  # m: a turn counts as what it moves that far away, about half a bearing


@kernel
def port_derivative(p, u, s, z, w, h):
    """Change of the port's force in ``z`` for a change of place and rate at the end of a step of ``h`` (s).

    ``u``: inputs, then their change; ``s``: state, then room for a copy; both are lost. The step is made
    twice, with the change to either side. Status code; ``z`` is left as it is where other inputs change.
    """
    if not has_port(p):
        return BAD_INPUT
    n = inputs(p)
    size = 0.0
    for i in range(n):
        if i >= U.PORT and i < U.PORT + 2 * SP.PLANE:
            of_rates = i >= U.PORT_RATE
            if of_rates and h == 0.0:
                u[n + i] = 0.0
            turns = (i - U.PORT) % SP.PLANE >= Q.INNER_BY
            moved = (_ARM if turns else 1.0) * (0.5 * h if of_rates else 1.0) * u[n + i]
            size = max(size, abs(moved))
        elif u[n + i] != 0.0:
            return OK
    to = int(p[int(p[P.SET]) + SP.AT_Z]) + SP.Z_PORT
    for i in range(SP.PLANE):
        z[to + i] = 0.0
    if size == 0.0:
        return OK
    length = h if h > 0.0 else _RESTING
    scale = min(_NEAR, _SLOWLY * length) / size
    longest = p[P.MAX_STEP]
    if length <= _SHORT:
        p[P.MAX_STEP] = min(longest, length / _PARTS)
    half = s.size // 2
    status = OK
    for k in range(2):
        side = 1.0 - 2.0 * k
        mine = s[half:] if k == 0 else s[:half]
        for i in range(half if k == 0 else 0):
            mine[i] = s[i]
        for i in range(U.PORT, U.PORT + 2 * SP.PLANE):
            u[i] += side * (1.0 + k) * scale * u[n + i]
        if status == OK:
            status = march(p, u[:n], mine, w, length)
        own = members.set_state(p, mine)
        for i in range(SP.PLANE):
            z[to + i] += side * own[SP.PORT_FORCE + i] / (2.0 * scale)
    p[P.MAX_STEP] = longest
    return status
