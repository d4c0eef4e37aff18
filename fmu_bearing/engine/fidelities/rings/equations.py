"""Equations of fidelities rings and response: condensed bearings, on a pedestal or on shaft and housing.

Each bearing gives the accelerations f its rings would have alone, and their derivatives J. With m the rings'
inertia, the forces on a set are the shaft's and the housing's plus sum T^T m (f - a), its masses M plus
sum T^T m T, and so on. A single bearing is a set whose coordinates are its rings' own: T
and m are one, M is zero. Jacobians are given in fixed axes. Arguments: see `spindle.members`.
"""

import math

from fmu_bearing.engine.dense import times
from fmu_bearing.engine.fidelities.condensed.ball_motion import carry_balls
from fmu_bearing.engine.fidelities.condensed.balls import accelerations, set_angles
from fmu_bearing.engine.fidelities.condensed.linearised import derivatives
from fmu_bearing.engine.fidelities.condensed.patterns import add_step, carry_patterns
from fmu_bearing.engine.fidelities.condensed.publish import publish
from fmu_bearing.engine.fidelities.condensed.rows import show_balls
from fmu_bearing.engine.fidelities.rings.predictor import rate_error
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, SP, C, F, H, L, P, Q, S, T, W, Y
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.coupling import add_driven, invert_set, shaft_matrix
from fmu_bearing.engine.spindle.follow import keep_load
from fmu_bearing.engine.spindle.shaft import shaft_forces

THIRD = 1.0 / 3200.0  # of beta, over (omega h)^4: see `correction.displace`


@kernel
def bends(p):
    """Whether the shaft bends: it has more coordinates than a rigid one."""
    return members.has_shaft(p) and p[int(p[P.SET]) + SP.SHAFT] > SP.PLANE


@kernel
def show(p, s):
    """Copy the march's places, true rates and accelerations to the set's and to its bearings' rings."""
    own = members.set_state(p, s)
    lanes = members.padded_size(p)
    numbers = members.march(p)
    vectors = members.history(p)
    for i in range(members.coordinates(p)):
        own[SP.S_HEAD + i] = own[vectors + H.Q0 * lanes + i]
        own[SP.S_HEAD + lanes + i] = own[vectors + H.V0 * lanes + i]
        own[SP.S_HEAD + lanes + i] -= rate_error(own, numbers, vectors, lanes, i)
        own[SP.S_HEAD + 2 * lanes + i] = own[vectors + H.A0 * lanes + i]
    show_rings(p, s)


@kernel
def show_rings(p, s):
    """Put places, rates and accelerations of all rings to where the set's coordinates are."""
    own = members.set_state(p, s)
    lanes = members.padded_size(p)
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        bearing_at = members.per_bearing(p, b)
        members.place_rows(p, b, own, own, SP.S_HEAD, lv, L.Q0)
        members.driven_motion(p, b, own, SP.S_HEAD + lanes, lv, L.V0)
        members.driven_motion(p, b, own, SP.S_HEAD + 2 * lanes, lv, L.A0)
        lv[L.V0] += own[bearing_at + SP.OFFSET_RATE]


@kernel
def share_march(p, s):
    """Copy the spacing of the march and the number of known steps to all bearings."""
    own = members.set_state(p, s)
    numbers = members.march(p)
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        lv[L.SPACING] = own[numbers + H.SPACING]
        lv[L.KNOWN] = own[numbers + H.KNOWN]


@kernel
def publish_all(p, s, w):
    """Write the states of all bearings and of the set that outputs are made of."""
    show(p, s)
    publish_rings(p, s)


@kernel
def publish_rings(p, s):
    """Write the states of all bearings that outputs are made of, with the rings as they are shown."""
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        lv = members.condensed(sb)
        y = sb[S.Y : S.Y + Y.SIZE]
        f = sb[S.F : S.F + F.SIZE]
        publish(members.parameters(p, b), lv, sb[S.SPEED], sb[S.SPEED_RATE], y, f)


@kernel
def copy_trial(ws, w):
    """As `follow_trial`, for a single bearing, whose coordinates are its rings' own."""
    for i in range(0, L.COLUMN, FOUR):
        store(w, W.STAGE + Y.Q0 + i, load(ws, SP.W_HEAD + SP.PLACE * L.COLUMN + i))
    for i in range(0, L.COLUMN, FOUR):
        store(w, W.STAGE + Y.V0 + i, load(ws, SP.W_HEAD + SP.RATE * L.COLUMN + i))
        store(w, T.A + i, load(ws, SP.W_HEAD + SP.ACCELERATION * L.COLUMN + i))


@kernel
def rings_residual(p, w, ws, residual):
    """Put what is out of balance at the rings of a single bearing to ``ws[residual:]``, as `pull_rings`.

    A rigidly fixed inner ring keeps its place.
    """
    for i in range(L.N):
        ws[residual + i] = w[W.F + F.BODY + i] - w[T.A + i]
    ws[residual + L.N] = 0.0
    if p[P.RIGID] != 0.0:
        ws[residual + Q.X] = -w[T.A + Q.X]


@kernel
def follow_trial(p, b, own, ws, wb, lanes, ahead):
    """Put trial places, rates and accelerations of the rings of bearing ``b`` into its work space ``wb``.

    ``ahead``: time (s) from the state on.
    """
    if not members.has_shaft(p):
        copy_trial(ws, wb)
        return
    members.driven_motion(p, b, ws, members.vector_at(lanes, SP.PLACE), wb, W.STAGE + Y.Q0)
    members.driven_motion(p, b, ws, members.vector_at(lanes, SP.RATE), wb, W.STAGE + Y.V0)
    members.driven_motion(p, b, ws, members.vector_at(lanes, SP.ACCELERATION), wb, T.A)
    members.add_seat_tilt(p, b, wb, W.STAGE + Y.Q0)
    bearing_at = members.per_bearing(p, b)
    wb[W.STAGE + Y.Q0] += own[bearing_at + SP.OFFSET] + ahead * own[bearing_at + SP.OFFSET_RATE]
    wb[W.STAGE + Y.V0] += own[bearing_at + SP.OFFSET_RATE]


@kernel
def pull_rings(p, b, wb, ws, residual):
    """Add what the rings of bearing ``b`` put on the set to its residual, at ``ws[residual:]``.

    Accelerations by the forces are in ``W.F``, the trial's in ``T.A``.
    """
    masses = members.row(p, b) + SP.ROW_MASS
    for i in range(L.N):
        wb[T.D + i] = p[masses + i] * (wb[W.F + F.BODY + i] - wb[T.A + i])
    wb[T.D + L.N] = 0.0
    members.project_forces(p, b, wb, T.D, ws, residual)


@kernel
def keep_loads(p, s, w):
    """Store the load of each inner ring on its balls, by the accelerations `pull_rings` has used."""
    if not members.has_shaft(p):
        return
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        masses = members.row(p, b) + SP.ROW_MASS
        at = members.scratch(p, b)
        for i in range(SP.PLANE):
            ws[at + i] = p[masses + i] * wb[W.F + F.BODY + i]
        keep_load(p, b, members.parameters(p, b), own, ws, at)


@kernel
def multiply(p, own, ws, matrix, x, out):
    """``ws[out:] = matrix ws[x:]``, the matrix of the coordinates' size in the set's own state."""
    if not members.has_shaft(p):
        times(own, matrix, ws, x, ws, out)
        return
    lanes = members.padded_size(p)
    for i in range(lanes):
        ws[out + i] = 0.0
    members.add_columns(own, matrix, lanes, members.coordinates(p), 1.0, ws, x, ws, out)


@kernel
def stiffness_matrix(p, s, own, ws, at):
    """Put the derivatives of the set's forces by places to ``ws[at:]``, by rows."""
    shaft_matrix(p, own, ws, s[S.SPEED], 0.0, 0.0, -1.0, at)
    for b in range(members.bearing_count(p)):
        lv = members.condensed(members.state(p, s, b))
        add_driven(p, b, lv, L.JX, 1, L.COLUMN, ws, at)


@kernel
def show_present(p, s, w):
    """Put the present state of rings, balls and races to the trial places."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    for i in range(L.N):
        w[W.STAGE + Y.Q0 + i] = lv[L.Q0 + i]
        w[W.STAGE + Y.V0 + i] = lv[L.V0 + i]
    show_balls(lv, L.X, w)
    set_angles(
        p, s[S.C : S.C + C.SIZE], lv, lv[L.THETA], lv[L.ROLLED], s[S.ANGLE], lv[L.Q0 + L.TURN], s[S.SPEED], w
    )


@kernel
def differentiate(p, s, w):
    """Jacobian at the present state, with balls at rest; False if there is none."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    show_present(p, s, w)
    if not derivatives(p, c, lv, s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE], w):
        return False
    s[S.JACOBIANS] += 1.0
    return True


@kernel
def step_matrix(lv, cv, cx, w):
    """Put ``1 - cv J_v - cx J_x`` of a bearing's rings to ``T.MATRIX``, row by row.

    With what they do to themselves through balls and cage within a step.
    """
    for k in range(L.N):
        for i in range(L.N):
            at = i + L.COLUMN * k
            own = 1.0 if i == k else 0.0
            w[T.MATRIX + i * L.N + k] = own - cv * lv[L.JV + at] - cx * lv[L.JX + at]
    if cv != 0.0:
        add_step(lv, cv, cx, w, T.MATRIX, L.N, 1)


@kernel
def begin_jacobian(x, numbers, highest):
    """Note a Jacobian at the present state with the ``highest`` mode (rad/s); ``numbers``: place in ``x``."""
    x[numbers + H.HIGHEST] = highest
    x[numbers + H.FACTOR_STEP] = 0.0
    x[numbers + H.CONTRACTION] = 0.1
    x[numbers + H.FRESH] = 1.0


@kernel
def present_forces(p, s, w):
    """After a jump and new derivatives: accelerations by the forces at the present state; False if none."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    # the derivatives leave the rows of the balls moved
    q = w[T.Q : T.Q + L.COLUMN]
    if not accelerations(p, s[S.C : S.C + C.SIZE], lv, s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE], q, w):
        return False
    carry_patterns(p, lv, w)
    if p[P.SOUND_SIZE] != 0.0:
        carry_balls(p, lv, w)
    return True


@kernel
def highest_mode(p, own, ws):
    """Angular frequency (rad/s) of the highest mode, by power iteration."""
    n = members.coordinates(p)
    d = members.vector(p, SP.INCREMENT)
    a = members.vector(p, SP.FORCE)
    for i in range(n):
        ws[d + i] = 1.0 + 0.1 * i
    size = 0.0
    for _ in range(40):
        multiply(p, own, ws, members.squares(p), d, a)
        total = 0.0
        before = 0.0
        for i in range(n):
            total += ws[a + i] * ws[a + i]
            before += ws[d + i] * ws[d + i]
        size = math.sqrt(total / before)
        for i in range(n):
            ws[d + i] = -ws[a + i] / (size + 1e-300)
    return math.sqrt(size)


@kernel
def within_step(lv, w):
    """Put the derivatives by places that rings feel within a step to ``T.MATRIX``, row by row.

    What balls and cage cannot follow in it stays behind.
    """
    for k in range(L.N):
        for i in range(L.N):
            w[T.MATRIX + i * L.N + k] = lv[L.JX + i + L.COLUMN * k]
    add_step(lv, 0.0, -1.0, w, T.MATRIX, L.N, 1)


@kernel
def keep_squares(p, own, ws, at):
    """Store B^-1 J_x, from J_x at ``ws[at:]`` by rows; B: the masses with all rings'."""
    n = members.coordinates(p)
    lanes = members.padded_size(p)
    inverse = members.table(p, SP.AT_INVERSE) if members.has_shaft(p) else 0
    for k in range(n):
        for i in range(n):
            total = ws[at + i * n + k]
            if members.has_shaft(p):
                total = 0.0
                for j in range(n):
                    total += p[inverse + j * lanes + i] * ws[at + j * n + k]
            own[members.squares(p) + k * lanes + i] = total
        for i in range(n, lanes):
            own[members.squares(p) + k * lanes + i] = 0.0


@kernel
def renew(p, s, w):
    """Jacobians at the present state and the highest mode; the inverse is left that of the masses.

    False where balls find no rest.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    show(p, s)
    at = members.matrix(p)
    for b in range(members.bearing_count(p)):
        if not differentiate(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b)):
            return False
    shaft_matrix(p, own, ws, s[S.SPEED], 1.0, 0.0, 0.0, at)
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        step_matrix(members.condensed(members.state(p, s, b)), 0.0, 0.0, wb)
        add_driven(p, b, wb, T.MATRIX, L.N, 1, ws, at)
    if not invert_set(p, own, ws):
        return False
    stiffness_matrix(p, s, own, ws, at)
    keep_squares(p, own, ws, at)
    begin_jacobian(own, members.march(p), highest_mode(p, own, ws))
    return True


@kernel
def by_squares(p, own, ws, x, out):
    """``ws[out:] = X B^-1 J_x`` for the coordinates' matrix X at ``ws[x:]``, both by rows."""
    n = members.coordinates(p)
    squares = members.squares(p)
    for i in range(n):
        for k in range(n):
            total = 0.0
            for j in range(n):
                total += ws[x + i * n + j] * own[squares + k * members.padded_size(p) + j]
            ws[out + i * n + k] = total


@kernel
def factor_step(p, s, w, h):
    """Inverse of the set's Newton matrix for a step ``h`` (s); False if singular."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    n = members.coordinates(p)
    at = members.matrix(p)
    by_place = h * h / 12.0
    beyond = h**4 / 240.0
    shaft_matrix(p, own, ws, s[S.SPEED], 1.0, 0.5 * h, by_place, at)
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        step_matrix(members.condensed(members.state(p, s, b)), 0.5 * h, by_place, wb)
        add_driven(p, b, wb, T.MATRIX, L.N, 1, ws, at)
    first = at + n * n
    second = first + n * n
    shaft_matrix(p, own, ws, s[S.SPEED], 0.0, 0.0, -1.0, second)
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        within_step(members.condensed(members.state(p, s, b)), wb)
        add_driven(p, b, wb, T.MATRIX, L.N, 1, ws, second)
    keep_squares(p, own, ws, second)
    by_squares(p, own, ws, second, first)
    for i in range(n * n):
        ws[at + i] += beyond * ws[first + i]
    if bends(p):
        by_squares(p, own, ws, first, second)
        for i in range(n * n):
            ws[at + i] -= THIRD * h**6 * ws[second + i]
    return invert_set(p, own, ws)


@kernel
def restart_march(p, s, w):
    """After a jump: Jacobians and accelerations at the present state; False if there are none."""
    if not renew(p, s, w):
        return False
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    lanes = members.padded_size(p)
    residual = members.vector(p, SP.RESIDUAL)
    acceleration = members.vector(p, SP.ACCELERATION)
    shaft_forces(
        p, own, own, SP.S_HEAD, SP.S_HEAD + lanes, s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE], ws, residual
    )  # fmt: skip
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        if not present_forces(members.parameters(p, b), sb, wb):
            return False
        for i in range(L.COLUMN):
            wb[T.A + i] = 0.0
        pull_rings(p, b, wb, ws, residual)
    multiply(p, own, ws, members.inverse(p), residual, acceleration)
    if not members.has_shaft(p) and p[P.RIGID] != 0.0:
        ws[acceleration + Q.X] = 0.0
    for i in range(lanes):
        own[members.history(p) + H.A0 * lanes + i] = ws[acceleration + i]
    for b in range(members.bearing_count(p)):
        members.driven_motion(p, b, ws, acceleration, members.work(p, w, b), T.A)
    keep_loads(p, s, w)
    return True
