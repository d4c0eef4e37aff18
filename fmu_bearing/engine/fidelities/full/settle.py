"""Flexible rings at the start: bent as the balls' loads bend them, the balls where they then carry.

The quasi-static kernel knows rigid rings. From its answer Newton's method moves the balls along and outwards
and the flexural coordinates until no acceleration is left; the bodies' places, orbit and spin stay. What the
redistributed loads then lack of balance on the bodies is small and rings down with the start's other remains.
"""

from fmu_bearing.engine.fidelities.full.flexible import solve_modes
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    A_INV,
    B_OM,
    B_R,
    B_VR,
    B_VX,
    B_X,
    F_SIZE,
    J_B,
    J_C,
    J_D,
    N_BODY,
    P_BALLS,
    P_LANES,
    P_MODES,
    PI,
    S_FAC,
    S_FAST,
    S_JAC,
    STRIDE,
    W_ACC,
    W_D,
    W_F,
    W_F0,
    W_FLEX,
)
from fmu_bearing.engine.layout_flexure import (
    FW_ACC,
    FW_D,
)
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.mechanics.flexure import flexure_state, show_flexure
from fmu_bearing.engine.newton.block_arrow import factor
from fmu_bearing.engine.newton.jacobian import jacobian
from fmu_bearing.engine.newton.modes import factor_modes

_S = STRIDE
_ROUNDS = 60
_SETTLED = 1e-12  # m: a millionth of the contacts' approach
_LONGEST = 1e-6  # m: change per round, of the size of the approach, so that no contact opens on the way


@kernel
def around(p, found, row, j):
    """Change of a ball quantity with the angle round the bearing (1/rad) between the neighbours of ``j``."""
    balls = int(p[P_BALLS])
    ahead = found[row + (j + 1) % balls]
    behind = found[row + (j + balls - 1) % balls]
    ahead2 = found[row + (j + 2) % balls]
    behind2 = found[row + (j + balls - 2) % balls]
    # fourth order: the first harmonic, that of a radial load or tilt, comes out within 0.3 % for 12 balls
    return (8.0 * (ahead - behind) - (ahead2 - behind2)) * balls / (24.0 * PI)


@kernel
def hold_orbit(jac):
    """Take the balls' orbit and spin out of a Jacobian: they neither answer nor act."""
    for i in range(6):
        for k in range(9):
            if i >= 2 or k == 2:
                for j in range(_S):
                    jac[J_B + (i * 9 + k) * _S + j] = 0.0
    for i in range(2 * 34 * _S, 6 * 34 * _S):
        jac[J_C + i] = 0.0
    for i in range(N_BODY):
        for j in range(_S):
            jac[J_D + (i * 9 + 2) * _S + j] = 0.0


@kernel
def settling(p, c, y, angle, speed, s, w):
    """One round of Newton's method; returns the largest increment (m) it asks for, left in ``w[W_D:]``."""
    lanes = int(p[P_LANES])
    jac = s[S_JAC:S_FAC]
    fac = s[S_FAC:S_FAST]
    kept = s[flexure_state(p) :]
    own = w[W_FLEX:]
    d = w[W_D : W_D + F_SIZE]
    f = w[W_F:W_F0]
    jacobian(p, c, y, angle, speed, 0.0, w, jac)
    hold_orbit(jac)
    # accelerations over a time of 1 s: the inertia beside the contacts' stiffness is 1e-11 then
    factor(p, jac, 0.0, 1.0, 1.0, fac, w)
    factor_modes(p, jac, fac, y, 0.0, speed, 0.0, 1.0, kept, w)
    right_hand_side(p, c, y, angle, speed, 0.0, w, f)
    for i in range(F_SIZE):
        d[i] = f[i] if i < 2 * _S else 0.0
    for i in range(2 * int(p[P_MODES])):
        own[FW_ACC + i] = 0.0
    solve_modes(p, kept, 0, d, w)
    largest = 0.0
    for j in range(lanes):
        x = 0.0
        r = 0.0
        for k in range(2):
            x += fac[A_INV + k * _S + j] * d[k * _S + j]
            r += fac[A_INV + (6 + k) * _S + j] * d[k * _S + j]
        d[j] = x
        d[_S + j] = r
        largest = max(largest, abs(x), abs(r))
    for i in range(2 * int(p[P_MODES])):
        largest = max(largest, abs(own[FW_D + i]))
    return largest


@kernel
def settle(p, c, y, angle, speed, s, w):
    """Bend the rings in ``s`` and move the balls in ``y`` to rest; leave both where that does not succeed."""
    if p[P_MODES] == 0.0:
        return
    lanes = int(p[P_LANES])
    at = flexure_state(p)
    before = w[W_ACC : W_ACC + 2 * _S]
    for i in range(2 * _S):
        before[i] = y[i]
    largest = 1.0
    for _ in range(_ROUNDS):
        show_flexure(p, s, w)
        largest = settling(p, c, y, angle, speed, s, w)
        if not (largest < 1e3):
            break
        share = min(1.0, _LONGEST / (largest + 1e-300))
        for i in range(2):
            for j in range(lanes):
                y[i * _S + j] += share * w[W_D + i * _S + j]
        found = W_FLEX + FW_D
        for i in range(2 * int(p[P_MODES])):
            s[at + i] += share * w[found + i]
        if largest < _SETTLED:
            break
    if not (largest < 1e3 * _SETTLED):
        for i in range(2 * _S):
            y[i] = before[i]
        for i in range(2 * int(p[P_MODES])):
            s[at + i] = 0.0
    else:
        # a ball follows the bent groove as it orbits
        for i in range(2 * _S):
            before[i] = y[i] - before[i]
        for j in range(lanes):
            place = j if j < p[P_BALLS] else 0
            y[B_VX * _S + j] += y[B_OM * _S + j] * around(p, before, B_X * _S, place)
            y[B_VR * _S + j] += y[B_OM * _S + j] * around(p, before, B_R * _S, place)
    show_flexure(p, s, w)
