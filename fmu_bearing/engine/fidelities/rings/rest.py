"""Where rings and balls rest on their pedestal, or shaft, housing and rings of a set, without unbalance.

Arguments: see `spindle.members`.
"""

import math

from fmu_bearing.engine.fidelities.condensed.linearised import derivatives
from fmu_bearing.engine.fidelities.rings.equations import follow_trial, multiply, pull_rings, stiffness_matrix
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, C, H, L, P, S, W, Y
from fmu_bearing.engine.newton.jacobian import is_angle
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.coupling import invert_set
from fmu_bearing.engine.spindle.shaft import shaft_forces

_ROUNDS = 60
_LONGEST = 3e-6  # m: move of a ring in one round, about the approach of a loaded contact
_FLOOR = 2500.0  # 1/s2: (50 rad/s)^2 on soft directions, a hundredth of the lowest spring of a pedestal


@kernel
def find_levers(p, own):
    """Fill the levers: the most that a coordinate moves a ring or the nose, tilts at the pitch radius."""
    lanes = members.padded_size(p)
    levers = members.history(p) + H.LEVERS * lanes
    if not members.has_shaft(p):
        for i in range(L.N):
            own[levers + i] = p[P.PITCH_RADIUS] if is_angle(i) else 1.0
        return
    nose = members.table(p, SP.AT_NOSE)
    for k in range(members.coordinates(p)):
        most = 0.0
        for b in range(members.bearing_count(p)):
            t = int(p[members.row(p, b) + SP.ROW_AT_T]) + k * SP.LANES
            pitch = members.parameters(p, b)[P.PITCH_RADIUS]
            for i in range(L.N):
                most = max(most, abs(p[t + i]) * (pitch if is_angle(i) else 1.0))
            for i in range(SP.PLANE):
                most = max(most, abs(p[nose + i * lanes + k]) * (pitch if is_angle(i) else 1.0))
        # a mode of the shaft that moves none of these planes
        own[levers + k] = most if most > 0.0 else math.sqrt(p[members.table(p, SP.AT_SCALE) + k])


@kernel
def diagonal_mass(p, k):
    """Inertia of coordinate ``k`` with the rings it moves; one for the rings of a single bearing."""
    if not members.has_shaft(p):
        return 1.0
    total = p[members.table(p, SP.AT_MASS) + k * members.padded_size(p) + k]
    for b in range(members.bearing_count(p)):
        r = members.row(p, b)
        t = int(p[r + SP.ROW_AT_T]) + k * SP.LANES
        for i in range(int(p[r + SP.ROW_DRIVEN])):
            total += p[r + SP.ROW_MASS + i] * p[t + i] * p[t + i]
    return total


@kernel
def forces_at_rest(p, s, w, speed):
    """Put forces at the trial places, at rest, to the residual, and find derivatives; False if none."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    place = members.vector(p, SP.PLACE)
    rate = members.vector(p, SP.RATE)
    for i in range(members.padded_size(p)):
        ws[rate + i] = 0.0
        ws[members.vector(p, SP.ACCELERATION) + i] = 0.0
    shaft_forces(p, own, ws, place, rate, 0.0, 0.0, 0.0, ws, members.vector(p, SP.RESIDUAL))
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        lv = members.condensed(sb)
        follow_trial(p, b, own, ws, wb, members.padded_size(p), 0.0)
        wb[W.STAGE + Y.V0] = 0.0
        if not derivatives(members.parameters(p, b), sb[S.C : S.C + C.SIZE], lv, 0.0, speed, 0.0, wb):
            return False
        pull_rings(p, b, wb, ws, members.vector(p, SP.RESIDUAL))
    return True


@kernel
def rest_once(p, s, w, speed):
    """Move the trial places by one Newton step towards rest; its length (m), negative if there is none."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    if not forces_at_rest(p, s, w, speed):
        return -1.0
    at = members.matrix(p)
    stiffness_matrix(p, s, own, ws, at)
    for i in range(n):
        for k in range(n):
            floor = _FLOOR * diagonal_mass(p, i) if i == k else 0.0
            ws[at + i * n + k] = floor - ws[at + i * n + k]
    if not invert_set(p, own, ws):
        return -1.0
    increment = members.vector(p, SP.INCREMENT)
    multiply(p, own, ws, members.inverse(p), members.vector(p, SP.RESIDUAL), increment)
    levers = members.history(p) + H.LEVERS * members.padded_size(p)
    longest = 0.0
    for i in range(n):
        longest = max(longest, own[levers + i] * abs(ws[increment + i]))
    if not (longest < 1e3):
        return -1.0
    share = min(1.0, _LONGEST / (longest + 1e-300))
    for i in range(n):
        ws[members.vector(p, SP.PLACE) + i] += share * ws[increment + i]
    return longest


@kernel
def at_rest(p, s, w, speed):
    """Find where all rests without unbalance, from the guess in ``SP.PLACE``; whether found.

    Newton's method with moves of a few micrometres at most. The rest is left in ``SP.PLACE``, and the balls'
    places in their trial rows.
    """
    ws = members.set_work(p, w)
    converged = False
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        ws[members.scratch(p, b) + SP.START_ECCENTRICITY] = sb[S.C + C.ECCENTRICITY]
        sb[S.C + C.ECCENTRICITY] = 0.0
    for _ in range(_ROUNDS):
        longest = rest_once(p, s, w, speed)
        if longest < 1e-12:
            converged = longest >= 0.0
            break
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        sb[S.C + C.ECCENTRICITY] = ws[members.scratch(p, b) + SP.START_ECCENTRICITY]
    return converged
