"""Where shaft, housing and rings rest, of a set and of a single bearing: Newton's method in displacements.

The unknowns are those of `rest_unknowns`. Contacts are springs: a step is judged by the force along it, which
must not turn round.

``z``, ``g``, ``step``: places in the set's own work space of vectors of `unknowns` numbers: the unknowns (m,
rad), the forces out of balance at them (N, N m), a step of the unknowns. Each bearing's part of the scratch
has ``SP.START_RING`` and what follows it. Other arguments: see `members`.
"""

import math

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.dense import eliminate, invert
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, SP, ST, C, P, Q, S, W
from fmu_bearing.engine.mechanics.contact import carries_both_ways
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.coupling import pedestal_matrix
from fmu_bearing.engine.spindle.port import clear, fix_rows
from fmu_bearing.engine.spindle.rest_unknowns import (
    driven_rows,
    first_unknown,
    free_rows,
    given_rows,
    on_pedestal,
    outer_row,
    put_rings,
    ring_motion,
    row_motion,
    shared_unknowns,
    start_vector,
    unknowns,
)
from fmu_bearing.engine.spindle.shaft import has_housing, shaft_forces, weighs
from fmu_bearing.engine.statics.axial import quasistatic
from fmu_bearing.engine.statics.place import pedestal_deflection
from fmu_bearing.engine.statics.quasistatic import forces_at_displacement, outer_moment
from fmu_bearing.engine.status import NO_START, OK

_ITERATIONS = 400
_BACKTRACKS = 12
_LONGEST = 5e-6  # m: step of a ring, tilts at the pitch radius; a tenth of the groove centres' distance
_FLOOR = 1.0  # N/m: moves a shaft that nothing holds by the longest step at most
_FINE = 1e-6  # of the forces: what may stay out of balance


@kernel
def weights(p, pb):
    """Weight (N) of the inner ring, and of the outer ring with the balls and the cage that it carries."""
    if not weighs(p):
        return 0.0, 0.0
    lying = pb[P.OUTER_MASS] + pb[P.BALLS] * pb[P.BALL_MASS]
    if pb[P.CAGE] != 0.0:
        lying += pb[P.CAGE_MASS]
    return GRAVITY * pb[P.INNER_MASS], GRAVITY * lying


@kernel
def pedestal_stiffness(c, i, k):
    """Entry of the stiffness of a ring's own pedestal, by rows ``i`` and ``k`` of the ring's six."""
    if i != k:
        return c[C.PEDESTAL_YZ] if i + k == Q.Y + Q.Z and i * k != 0 else 0.0
    if i == Q.X:
        return c[C.PEDESTAL_AXIAL]
    if i == Q.Y:
        return c[C.PEDESTAL_Y]
    return c[C.PEDESTAL_Z] if i == Q.Z else c[C.PEDESTAL_ROTATIONAL]


@kernel
def show_ring_forces(p, b, speed, force, s, w, out, to):
    """Put to ``out[to:]`` what quasi-static balls and weights put on all rows of both rings (N, N m).

    ``force``: of the balls on the inner ring, as `forces_at_displacement` has just found it.
    """
    ws = members.set_work(p, w)
    pb = members.parameters(p, b)
    own_weight, lying = weights(p, pb)
    for i in range(Q.OUTER):
        out[to + i] = force[i] - (own_weight if i == Q.Z else 0.0)
    for i in range(Q.OUTER, Q.RINGS):
        out[to + i] = 0.0
    for i in range(Q.TURN):
        out[to + Q.OUTER + i] = -force[i] - (lying if i == Q.Z else 0.0)
    if on_pedestal(p, b) or has_housing(p):
        wb = members.work(p, w, b)
        c = members.state(p, s, b)[S.C : S.C + C.SIZE]
        at = members.scratch(p, b)
        tilt = ws[at + SP.START_TILT : at + SP.START_TILT + 2]
        eq = wb[W.EQUILIBRIUM : W.EQUILIBRIUM + EQ.SIZE]
        my, mz = outer_moment(pb, c, speed, tilt, eq, wb[W.STATICS : W.STATICS + ST.SIZE])
        out[to + Q.OUTER + Q.BY] = my
        out[to + Q.OUTER + Q.BZ] = mz


@kernel
def settle_bearing(p, s, w, b, speed, share, z, g):
    """Settle bearing ``b`` where the unknowns at ``z`` put its rings; add its forces to those at ``g``.

    ``share`` of the imperfections (0 or 1). Returns its status.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    wb = members.work(p, w, b)
    c = members.state(p, s, b)[S.C : S.C + C.SIZE]
    at = members.scratch(p, b)
    put_rings(p, b, ws, own, z)
    ring = ws[at + SP.START_RING : at + SP.START_RING + SP.PLANE]
    tilt = ws[at + SP.START_TILT : at + SP.START_TILT + 2]
    force = ws[at + SP.START_FORCE : at + SP.START_FORCE + SP.PLANE]
    eq = wb[W.EQUILIBRIUM : W.EQUILIBRIUM + EQ.SIZE]
    status = forces_at_displacement(members.parameters(p, b), c, speed, ring, tilt, share, force, eq, wb)
    pull = at + SP.START_LOAD
    outer = at + SP.START_OUTER
    show_ring_forces(p, b, speed, force, s, w, ws, pull)
    for i in range(SP.PLANE):
        force[i] += ws[at + SP.START_MORE + i]
    for k in range(Q.RINGS):
        ws[pull + k] += ws[at + SP.START_MORE + k]
    for i in range(SP.HOUSING if on_pedestal(p, b) else 0):
        for k in range(SP.HOUSING):
            away = ws[outer + k]
            if k >= Q.BY:
                away -= members.parameters(p, b)[P.MISALIGNMENT_Y + k - Q.BY]
            ws[pull + Q.OUTER + i] -= pedestal_stiffness(c, i, k) * away
    mine = g + first_unknown(p, b)
    for i in range(free_rows(p, b)):
        ws[mine + i] = ws[pull + Q.OUTER + outer_row(i)]
    for k in range(driven_rows(p, b), SP.LANES):
        ws[pull + k] = 0.0
    members.project_forces(p, b, ws, pull, ws, g)
    return status


@kernel
def forces_at(p, s, w, speed, share, z, g):
    """Put forces out of balance for the unknowns at ``z`` to ``g``; the worst status of a bearing."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    count = unknowns(p)
    still = members.vector(p, SP.RATE)
    for i in range(members.coordinates(p)):
        ws[still + i] = 0.0
    for i in range(count):
        ws[g + i] = 0.0
    shaft_forces(p, own, ws, z, still, 0.0, 0.0, 0.0, ws, g)
    if not members.has_shaft(p):
        ws[g + Q.X] = s[S.C + C.PRELOAD]
        ws[g + Q.Y] = s[S.C + C.LOAD_Y]
        ws[g + Q.Z] = s[S.C + C.LOAD_Z]
        for i in range(SP.PLANE):
            ws[g + i] -= p[P.SUPPORT_STIFFNESS + i] * ws[z + i]
    status = OK
    for b in range(members.bearing_count(p)):
        here = settle_bearing(p, s, w, b, speed, share, z, g)
        if here != OK:
            status = here
    clear(ws, g, given_rows(p))
    return status


@kernel
def upright_stiffness(p, i, k):
    """Entry, by shared unknowns, of the stiffness of the shaft and of its springs to ground."""
    if not members.has_shaft(p):
        return p[P.SUPPORT_STIFFNESS + i] if i == k else 0.0
    return p[members.table(p, SP.AT_STIFFNESS) + k * members.padded_size(p) + i]


@kernel
def equations(p, s, w, damping):
    """Put the stiffness matrix of all unknowns to `members.matrix`, by rows of one number more.

    With the bearings as they were settled last, and ``damping`` (N/m) times each unknown's inertia.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    n = shared_unknowns(p)
    count = unknowns(p)
    at = members.matrix(p)
    width = count + 1
    spare = start_vector(p, SP.MOTIONS)
    for i in range(count * width):
        ws[at + i] = 0.0
    for i in range(n):
        for k in range(n):
            ws[at + i * width + k] += upright_stiffness(p, i, k)
    if has_housing(p):
        h = int(p[int(p[P.SET]) + SP.SHAFT])
        pedestal_matrix(p, own, SP.PEDESTAL_STIFFNESS, 1.0, ws, at + h * width + h, width, spare)
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        c = members.state(p, s, b)[S.C : S.C + C.SIZE]
        for i in range(SP.PLANE):
            ring_motion(p, b, i, ws, spare + i * count)
        for i in range(SP.PLANE):
            for k in range(SP.PLANE):
                stiffness = wb[W.EQUILIBRIUM + EQ.STIFFNESS + EQ.FREEDOMS * i + k]
                for m in range(count):
                    share = stiffness * ws[spare + i * count + m]
                    if share != 0.0:
                        for h in range(count):
                            ws[at + m * width + h] += share * ws[spare + k * count + h]
        mine = first_unknown(p, b)
        for i in range(free_rows(p, b)):
            for k in range(free_rows(p, b)):
                ws[at + (mine + i) * width + mine + k] += pedestal_stiffness(c, outer_row(i), outer_row(k))
        own_pedestal = on_pedestal(p, b) and driven_rows(p, b) == SP.DRIVEN
        for entry in range(SP.HOUSING * SP.HOUSING if own_pedestal else 0):
            i = entry // SP.HOUSING
            k = entry % SP.HOUSING
            stiffness = pedestal_stiffness(c, i, k)
            for m in range(n if stiffness != 0.0 else 0):
                share = stiffness * row_motion(p, b, Q.OUTER + i, m)
                for h in range(n):
                    ws[at + m * width + h] += share * row_motion(p, b, Q.OUTER + k, h)
    for i in range(count):
        ws[at + i * width + i] += damping * inertia(p, i)


@kernel
def inertia(p, i):
    """Inertia of unknown ``i`` over the shaft's along its axis; it makes forces and moments comparable."""
    if members.has_shaft(p) and i < members.coordinates(p):
        return p[members.table(p, SP.AT_SCALE) + i]
    # unknowns of one ring: x y z by bz
    lever = p[P.PITCH_RADIUS]
    return 1.0 if (i - shared_unknowns(p)) % SP.PLANE < Q.INNER_BY else lever * lever


@kernel
def force_size(p, ws, g):
    """Length (N) of the forces at ``ws[g:]``, each over the root of its inertia."""
    total = 0.0
    for i in range(unknowns(p)):
        total += ws[g + i] * ws[g + i] / inertia(p, i)
    return math.sqrt(total)


@kernel
def newton_step(p, s, w, g, step, damping):
    """Step of the unknowns for the forces at ``g``; the work along it, not positive if unfit."""
    ws = members.set_work(p, w)
    count = unknowns(p)
    equations(p, s, w, damping)
    at = members.matrix(p)
    fix_rows(ws, at, given_rows(p), count, count + 1)
    for i in range(count):
        ws[at + i * (count + 1) + count] = ws[g + i]
    if not eliminate(ws, at, count):
        return -1.0
    for i in range(count):
        ws[step + i] = ws[at + i * (count + 1) + count]
    longest = 0.0
    spare = start_vector(p, SP.MOTIONS)
    for b in range(members.bearing_count(p)):
        lever = members.parameters(p, b)[P.PITCH_RADIUS]
        for i in range(SP.PLANE):
            ring_motion(p, b, i, ws, spare)
            move = 0.0
            for k in range(count):
                move += ws[spare + k] * ws[step + k]
            longest = max(longest, abs(move) * (1.0 if i < Q.INNER_BY else lever))
    share = min(1.0, _LONGEST / (longest + 1e-300))
    ahead = 0.0
    for i in range(count):
        ws[step + i] *= share
        ahead += ws[step + i] * ws[g + i]
    return ahead


@kernel
def nose_compliance(p, s, w, j, to):
    """Put to ``ws[to:]``, by rows, how far a unit load on row ``j`` of the nose moves it; False if singular.

    Shaft, housing and rings give way, the bearings with the stiffness where they were settled last.
    """
    ws = members.set_work(p, w)
    count = unknowns(p)
    at = members.matrix(p)
    nose = members.table(p, SP.AT_NOSE)
    lanes = members.padded_size(p)
    equations(p, s, w, _FLOOR)
    for i in range(count):
        ws[at + i * (count + 1) + count] = p[nose + j * lanes + i] if i < members.coordinates(p) else 0.0
    if not eliminate(ws, at, count):
        return False
    for i in range(SP.PLANE):
        total = 0.0
        for k in range(members.coordinates(p)):
            total += p[nose + i * lanes + k] * ws[at + k * (count + 1) + count]
        ws[to + i * SP.PLANE + j] = total
    return True


@kernel
def keep_stiffness(p, s, w):
    """Store the stiffness of the shaft at X = 0 where the bearings were settled last; zeros if singular.

    Axial and radial with its other motions fixed, against a tilt with the shaft free to move aside.
    """
    if not members.has_shaft(p):
        return
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    give = SP.NOSE_COMPLIANCE
    stiff = give + SP.PLANE * SP.PLANE
    for i in range(3):
        own[SP.SHAFT_STIFFNESS + i] = 0.0
    for j in range(SP.PLANE):
        if not nose_compliance(p, s, w, j, give):
            return
    if not invert(ws, give, SP.PLANE, ws, stiff):
        return
    z = stiff + Q.Z * SP.PLANE
    turn = stiff + Q.INNER_BY * SP.PLANE
    radial = ws[z + Q.Z]
    own[SP.SHAFT_STIFFNESS] = ws[stiff]
    own[SP.SHAFT_STIFFNESS + 1] = radial
    own[SP.SHAFT_STIFFNESS + 2] = ws[turn + Q.INNER_BY] - ws[z + Q.INNER_BY] * ws[turn + Q.Z] / radial


@kernel
def begin_rest(p, s, w, speed):
    """Begin the unknowns at the coordinates; of a single bearing where axial load and pedestal put its rings.

    Where there is no rest under axial load alone, the guess is where that search ended. A deep groove bearing
    without axial load begins in its middle: from where it touches aside, a ring that is free to tilt may end
    tilted about its loaded zone.
    """
    ws = members.set_work(p, w)
    z = start_vector(p, SP.UNKNOWNS)
    if members.has_shaft(p):
        for i in range(members.coordinates(p)):
            ws[z + i] = members.set_state(p, s)[SP.S_HEAD + i]
        return
    c = s[S.C : S.C + C.SIZE]
    axial = w[W.STILL_EQUILIBRIUM : W.STILL_END]
    quasistatic(p, c, speed, axial)
    own_weight, lying = weights(p, p)
    aside, down = pedestal_deflection(p, c, c[C.LOAD_Y], c[C.LOAD_Z] - own_weight - lying)
    for place in (z, z + SP.PLANE):
        ws[place + Q.X] = c[C.PRELOAD] / c[C.PEDESTAL_AXIAL]
        ws[place + Q.Y] = aside
        ws[place + Q.Z] = down
        ws[place + Q.INNER_BY] = p[P.MISALIGNMENT_Y]
        ws[place + Q.INNER_BZ] = p[P.MISALIGNMENT_Z]
    shift = axial[ST.AXIAL_SHIFT]
    if c[C.PRELOAD] == 0.0 and carries_both_ways(p):
        shift = 0.0
    ws[z + Q.X] = s[S.PLACE] if p[P.RIGID] != 0.0 else ws[z + Q.X] + shift


@kernel
def begin_in_middle(p, s, w, speed):
    """As `begin_rest`, of a single bearing with the groove circles of both rings in one plane.

    There a ring rests that loads across its axis alone hold: where it would touch under an axial load is some
    hundredths of a millimetre aside.
    """
    begin_rest(p, s, w, speed)
    ws = members.set_work(p, w)
    z = start_vector(p, SP.UNKNOWNS)
    c = s[S.C : S.C + C.SIZE]
    apart = c[C.RACES + C.RACE_SIZE + C.GROOVE_X] - c[C.RACES + C.GROOVE_X]
    ws[z + Q.X] = ws[z + SP.PLANE + Q.X] + apart


@kernel
def rest(p, s, w, speed, share):
    """Bring the unknowns to rest; status code. Bearings are left settled where their rings then are.

    ``share`` of the imperfections (0 or 1). The rest of a ring that hangs on a few balls, with no axial load,
    may not be found from where its balls would touch under an axial load: then from the middle. Where there
    is none, one with a little axial load serves, a start from which such a ring sets itself moving anyway.
    """
    status = balance(p, s, w, speed, share)
    if status != OK and not members.has_shaft(p) and p[P.RIGID] == 0.0:
        begin_in_middle(p, s, w, speed)
        status = balance(p, s, w, speed, share)
    if status != OK and not members.has_shaft(p):
        c = s[S.C : S.C + C.SIZE]
        load = c[C.PRELOAD]
        more = 1.0 + 0.05 * (abs(load) + abs(c[C.LOAD_Y]) + abs(c[C.LOAD_Z]))
        c[C.PRELOAD] += more if load >= 0.0 else -more
        begin_rest(p, s, w, speed)
        status = balance(p, s, w, speed, share)
        c[C.PRELOAD] = load
    return status


@kernel
def balance(p, s, w, speed, share):
    """As `rest`, with the loads as they are."""
    ws = members.set_work(p, w)
    count = unknowns(p)
    z = start_vector(p, SP.UNKNOWNS)
    trial = start_vector(p, SP.TRIALS)
    g = start_vector(p, SP.FORCES)
    after = start_vector(p, SP.TRIAL_FORCES)
    step = start_vector(p, SP.STEPS)
    status = forces_at(p, s, w, speed, share, z, g)
    total = 100.0
    for b in range(members.bearing_count(p)):
        total += abs(ws[members.scratch(p, b) + SP.START_FORCE])
    damping = _FLOOR
    for _ in range(_ITERATIONS):
        size = force_size(p, ws, g)
        if size <= 1e-8 + 1e-10 * total:
            break
        ahead = newton_step(p, s, w, g, step, damping)
        if not (ahead > 0.0):
            damping = max(10.0 * damping, 1e3)
            continue
        gone = 1.0
        for n in range(_BACKTRACKS):
            for i in range(count):
                ws[trial + i] = ws[z + i] + gone * ws[step + i]
            status = forces_at(p, s, w, speed, share, trial, after)
            along = 0.0
            for i in range(count):
                along += ws[after + i] * ws[step + i]
            smaller = force_size(p, ws, after) < 0.5 * size
            if along >= -0.9 * ahead or smaller or n == _BACKTRACKS - 1:
                break
            gone *= min(max(ahead / (ahead - along), 0.1), 0.7)
        damping = max(0.3 * damping, _FLOOR) if gone > 0.5 else 4.0 * damping
        for i in range(count):
            ws[z + i] = ws[trial + i]
            ws[g + i] = ws[after + i]
    return status if force_size(p, ws, g) <= _FINE * total else NO_START
