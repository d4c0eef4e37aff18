"""Flexible rings at the start: bent as the balls' loads bend them, the balls where they then carry.

The quasi-static kernel knows rigid rings. From its answer Newton's method moves the balls along and outwards
and the flexural coordinates until no acceleration is left; the bodies' places, orbit and spin stay. What the
redistributed loads then lack of balance on the bodies is small and rings down with the start's other remains.
"""

from fmu_bearing.engine.fidelities.full.flexible import solve_modes
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import in_groups
from fmu_bearing.engine.layout import FL, FOUR, STRIDE, A, F, J, P, Q, S, W, Y
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.mechanics.flexure import flexure_state, show_flexure
from fmu_bearing.engine.newton.block_arrow import factor
from fmu_bearing.engine.newton.jacobian import jacobian
from fmu_bearing.engine.newton.modes import factor_modes
from fmu_bearing.engine.statics.place import slope_round_bearing

_ORBIT = 2  # row of a ball's orbit, behind its places along x and r
_ROUNDS = 60
_SETTLED = 1e-12  # m: a millionth of the contacts' approach
_LONGEST = 1e-6  # m: change per round, of the size of the approach, so that no contact opens on the way


@kernel
def fix_orbit(jac):
    """Take the balls' orbit and spin out of a Jacobian: they neither answer nor act."""
    for i in range(J.BALL):
        for k in range(J.STATES):
            if i >= _ORBIT or k == _ORBIT:
                for j in range(STRIDE):
                    jac[J.B + (i * J.STATES + k) * STRIDE + j] = 0.0
    for i in range(_ORBIT * J.BODIES * STRIDE, J.BALL * J.BODIES * STRIDE):
        jac[J.C + i] = 0.0
    for i in range(Q.SIZE):
        for j in range(STRIDE):
            jac[J.D + (i * J.STATES + _ORBIT) * STRIDE + j] = 0.0


@kernel
def settling(p, c, y, angle, speed, s, w):
    """One round of Newton's method; returns the largest increment (m) it asks for, left in ``w[W.D:]``."""
    lanes = int(p[P.LANES])
    jac = s[S.JAC : S.FAC]
    fac = s[S.FAC : S.CONDENSED]
    flexure = s[flexure_state(p) :]
    own = w[W.FLEX :]
    d = w[W.D : W.D + F.SIZE]
    f = w[W.F : W.F + F.SIZE]
    jacobian(p, c, y, angle, speed, 0.0, w, jac)
    fix_orbit(jac)
    # accelerations over a time of 1 s: the inertia beside the contacts' stiffness is 1e-11 then
    factor(p, jac, 0.0, 1.0, 1.0, fac, w)
    factor_modes(p, jac, fac, y, 0.0, speed, 0.0, 1.0, flexure, w)
    right_hand_side(p, c, y, angle, speed, 0.0, w, f)
    for i in range(F.SIZE):
        d[i] = f[i] if i < F.TH else 0.0
    for i in range(2 * int(p[P.MODES])):
        own[FL.ACC + i] = 0.0
    solve_modes(p, flexure, 0, d, w)
    largest = 0.0
    for j in range(lanes):
        x = 0.0
        r = 0.0
        inverse = in_groups(j, A.GROUP) + A.INVERSE
        for k in range(_ORBIT):
            x += fac[inverse + k * FOUR] * d[k * STRIDE + j]
            r += fac[inverse + A.SIX + k * FOUR] * d[k * STRIDE + j]
        d[j] = x
        d[STRIDE + j] = r
        largest = max(largest, abs(x), abs(r))
    for i in range(2 * int(p[P.MODES])):
        largest = max(largest, abs(own[FL.D + i]))
    return largest


@kernel
def settle(p, c, y, angle, speed, s, w):
    """Bend the rings in ``s`` and move the balls in ``y`` to rest; leave both where that does not succeed."""
    if p[P.MODES] == 0.0:
        return
    lanes = int(p[P.LANES])
    at = flexure_state(p)
    before = w[W.FIRST_PLACES : W.FIRST_PLACES + 2 * STRIDE]
    for i in range(2 * STRIDE):
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
                y[i * STRIDE + j] += share * w[W.D + i * STRIDE + j]
        increment = W.FLEX + FL.D
        for i in range(2 * int(p[P.MODES])):
            s[at + i] += share * w[increment + i]
        if largest < _SETTLED:
            break
    if not (largest < 1e3 * _SETTLED):
        for i in range(2 * STRIDE):
            y[i] = before[i]
        for i in range(2 * int(p[P.MODES])):
            s[at + i] = 0.0
    else:
        # a ball follows the bent groove as it orbits
        for i in range(2 * STRIDE):
            before[i] = y[i] - before[i]
        for j in range(lanes):
            place = j if j < p[P.BALLS] else 0
            y[Y.VX + j] += y[Y.OM + j] * slope_round_bearing(p, before, Y.X, place)
            y[Y.VR + j] += y[Y.OM + j] * slope_round_bearing(p, before, Y.R, place)
    show_flexure(p, s, w)
