"""Equations of a set in fidelities rings and response: condensed bearings on shaft and housing.

Each bearing tells the accelerations f its rings would have alone, their masses B (``L.MASS``) and derivatives
J. With m the rings' inertia, the set's forces are those of shaft and housing and sum T^T m (f - B a), its
masses M and sum T^T m B T, and so on. Jacobians stand in fixed axes.
"""

import math

from fmu_bearing.engine.dense import times
from fmu_bearing.engine.fidelities.condensed.linearised import derivatives, step_matrix
from fmu_bearing.engine.fidelities.condensed.publish import publish, rate_error
from fmu_bearing.engine.fidelities.rings.march import begin_jacobian, differentiate, forces_anew
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, C, F, H, L, P, S, T, W, Y
from fmu_bearing.engine.newton.jacobian import is_angle
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.coupling import add_driven, invert_set, shaft_matrix
from fmu_bearing.engine.spindle.follow import keep_load
from fmu_bearing.engine.spindle.shaft import shaft_forces

_ROUNDS = 60
_LONGEST = 3e-6  # m: move of a ring in one round, about the approach of a loaded contact
THIRD = 1.0 / 3200.0  # of beta, over (omega h)^4: see rings.displace_set
_FLOOR = 2500.0  # 1/s2: (50 rad/s)^2 on soft directions, as for a single bearing


@kernel
def bends(p):
    """Whether the shaft bends: it has more coordinates than a rigid one."""
    return p[int(p[P.SET]) + SP.SHAFT] > SP.PLANE


@kernel
def show(p, s, w):
    """Put the march's places, true rates and accelerations to those of the set and of its bearings' rings."""
    own = members.own_state(p, s)
    lanes = members.padded(p)
    numbers = members.march(p)
    x = members.history(p)
    for i in range(members.coordinates(p)):
        own[SP.S_HEAD + i] = own[x + H.Q0 * lanes + i]
        own[SP.S_HEAD + lanes + i] = own[x + H.V0 * lanes + i] - rate_error(own, numbers, x, lanes, i)
        own[SP.S_HEAD + 2 * lanes + i] = own[x + H.A0 * lanes + i]
    show_rings(p, s)


@kernel
def show_rings(p, s):
    """Put places, rates and accelerations of all rings to those that the set has."""
    own = members.own_state(p, s)
    lanes = members.padded(p)
    for b in range(members.count(p)):
        lv = members.condensed(members.state(p, s, b))
        mine = members.kept(p, b)
        members.moved(p, b, own, SP.S_HEAD, lv, L.Q0)
        members.moved(p, b, own, SP.S_HEAD + lanes, lv, L.V0)
        members.moved(p, b, own, SP.S_HEAD + 2 * lanes, lv, L.A0)
        lv[L.Q0] += own[mine + SP.OFFSET]
        lv[L.V0] += own[mine + SP.OFFSET_RATE]


@kernel
def tell_march(p, s):
    """Tell the bearings the spacing of the march and how many steps are known."""
    own = members.own_state(p, s)
    numbers = members.march(p)
    for b in range(members.count(p)):
        lv = members.condensed(members.state(p, s, b))
        lv[L.SPACING] = own[numbers + H.SPACING]
        lv[L.KNOWN] = own[numbers + H.KNOWN]


@kernel
def publish_set(p, s, w):
    """Write the states of all bearings and of the set that outputs are made of."""
    show(p, s, w)
    publish_rings(p, s)


@kernel
def publish_rings(p, s):
    """Write the states of all bearings that outputs are made of, with the rings as they are shown."""
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        lv = members.condensed(sb)
        y = sb[S.Y : S.Y + Y.SIZE]
        f = sb[S.F : S.F + F.SIZE]
        publish(members.parameters(p, b), lv, sb[S.SPEED], sb[S.SPEED_RATE], False, y, f)


@kernel
def follow_trial(p, b, own, ws, wb, ahead):
    """Put trial places, rates and accelerations of the rings of bearing ``b`` into its work space ``wb``.

    ``ahead``: time (s) from the state on.
    """
    mine = members.kept(p, b)
    members.moved(p, b, ws, members.vector(p, SP.PLACE), wb, W.STAGE + Y.Q0)
    members.moved(p, b, ws, members.vector(p, SP.RATE), wb, W.STAGE + Y.V0)
    members.moved(p, b, ws, members.vector(p, SP.ACCELERATION), wb, T.A)
    wb[W.STAGE + Y.Q0] += own[mine + SP.OFFSET] + ahead * own[mine + SP.OFFSET_RATE]
    wb[W.STAGE + Y.V0] += own[mine + SP.OFFSET_RATE]


@kernel
def pull_rings(p, b, lv, wb, ws):
    """Add what the rings of bearing ``b`` put on the set to its residual.

    Accelerations by the forces stand in ``W.F``, those of the trial in ``T.A``.
    """
    masses = members.row(p, b) + SP.ROW_MASS
    times(lv, L.MASS, wb, T.A, wb, T.D)
    for i in range(L.N):
        wb[T.D + i] = p[masses + i] * (wb[W.F + F.BODY + i] - wb[T.D + i])
    members.pull(p, b, wb, T.D, ws, members.vector(p, SP.RESIDUAL))


@kernel
def keep_loads(p, s, w):
    """Keep what the inner rings put on their balls, by the accelerations `pull_rings` has used."""
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    for b in range(members.count(p)):
        wb = members.work(p, w, b)
        masses = members.row(p, b) + SP.ROW_MASS
        at = members.scratch(p, b)
        times(members.condensed(members.state(p, s, b)), L.MASS, wb, T.A, wb, T.D)
        for i in range(SP.PLANE):
            # the balls' inertia is a force of theirs
            free = wb[W.F + F.BODY + i] - (wb[T.D + i] - wb[T.A + i])
            ws[at + i] = p[masses + i] * free
        keep_load(p, b, members.parameters(p, b), own, ws, at)


@kernel
def answer(p, own, ws, matrix, x, out):
    """``ws[out:] = matrix ws[x:]``, the matrix of the coordinates' size in the set's own state."""
    lanes = members.padded(p)
    for i in range(lanes):
        ws[out + i] = 0.0
    members.add_columns(own, matrix, lanes, members.coordinates(p), 1.0, ws, x, ws, out)


@kernel
def stiffness_matrix(p, s, own, ws, at):
    """Put the derivatives of the set's forces by places to ``ws[at:]``, by rows."""
    shaft_matrix(p, own, ws, s[S.SPEED], 0.0, 0.0, -1.0, at)
    for b in range(members.count(p)):
        lv = members.condensed(members.state(p, s, b))
        add_driven(p, b, lv, L.JX, 1, L.COLUMN, ws, at)


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
        answer(p, own, ws, members.squares(p), d, a)
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
def renew_rings(p, s, w):
    """Jacobians at the present state and the highest mode; the inverse is left that of the masses.

    False where balls find no rest.
    """
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    n = members.coordinates(p)
    lanes = members.padded(p)
    show(p, s, w)
    at = members.matrix(p)
    for b in range(members.count(p)):
        if not differentiate(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b)):
            return False
    shaft_matrix(p, own, ws, s[S.SPEED], 1.0, 0.0, 0.0, at)
    for b in range(members.count(p)):
        lv = members.condensed(members.state(p, s, b))
        add_driven(p, b, lv, L.MASS, 1, L.COLUMN, ws, at)
    if not invert_set(p, own, ws):
        return False
    stiffness_matrix(p, s, own, ws, at)
    column = members.vector(p, SP.INCREMENT)
    found = members.vector(p, SP.FORCE)
    for k in range(n):
        for i in range(n):
            ws[column + i] = ws[at + i * n + k]
        answer(p, own, ws, members.inverse(p), column, found)
        for i in range(lanes):
            own[members.squares(p) + k * lanes + i] = ws[found + i]
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
                total += ws[x + i * n + j] * own[squares + k * members.padded(p) + j]
            ws[out + i * n + k] = total


@kernel
def factor_rings(p, s, w, h):
    """Inverse of the set's Newton matrix for a step ``h`` (s); False if singular.

    See ``condensed.linearised.factor_step``.
    """
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    n = members.coordinates(p)
    at = members.matrix(p)
    by_place = h * h / 12.0
    beyond = h**4 / 240.0
    shaft_matrix(p, own, ws, s[S.SPEED], 1.0, 0.5 * h, by_place, at)
    for b in range(members.count(p)):
        wb = members.work(p, w, b)
        step_matrix(members.condensed(members.state(p, s, b)), 0.5 * h, by_place, wb)
        add_driven(p, b, wb, T.MATRIX, L.N, 1, ws, at)
    first = at + n * n
    second = first + n * n
    stiffness_matrix(p, s, own, ws, second)
    by_squares(p, own, ws, second, first)
    for i in range(n * n):
        ws[at + i] += beyond * ws[first + i]
    if bends(p):
        by_squares(p, own, ws, first, second)
        for i in range(n * n):
            ws[at + i] -= THIRD * h**6 * ws[second + i]
    return invert_set(p, own, ws)


@kernel
def begin_anew(p, s, w):
    """After a jump: Jacobians and accelerations at the present state; False if there are none."""
    if not renew_rings(p, s, w):
        return False
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    lanes = members.padded(p)
    residual = members.vector(p, SP.RESIDUAL)
    found = members.vector(p, SP.ACCELERATION)
    shaft_forces(
        p, own, own, SP.S_HEAD, SP.S_HEAD + lanes, s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE], ws, residual
    )  # fmt: skip
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        if not forces_anew(members.parameters(p, b), sb, wb):
            return False
        for i in range(L.COLUMN):
            wb[T.A + i] = 0.0
        pull_rings(p, b, members.condensed(sb), wb, ws)
    answer(p, own, ws, members.inverse(p), residual, found)
    for i in range(lanes):
        own[members.history(p) + H.A0 * lanes + i] = ws[found + i]
    for b in range(members.count(p)):
        members.moved(p, b, ws, found, members.work(p, w, b), T.A)
    keep_loads(p, s, w)
    return True


@kernel
def find_levers(p, own):
    """Fill the levers: the most that a coordinate moves a ring or the nose, tilts at the pitch radius."""
    lanes = members.padded(p)
    levers = members.history(p) + H.LEVERS * lanes
    nose = members.table(p, SP.AT_NOSE)
    for k in range(members.coordinates(p)):
        most = 0.0
        for b in range(members.count(p)):
            t = int(p[members.row(p, b) + SP.ROW_AT_T]) + k * SP.LANES
            pitch = members.parameters(p, b)[P.PITCH_RADIUS]
            for i in range(L.N):
                most = max(most, abs(p[t + i]) * (pitch if is_angle(i) else 1.0))
            for i in range(SP.PLANE):
                most = max(most, abs(p[nose + i * lanes + k]) * (pitch if is_angle(i) else 1.0))
        # a mode of the shaft between planes that stand still
        own[levers + k] = most if most > 0.0 else math.sqrt(p[members.table(p, SP.AT_SCALE) + k])


@kernel
def diagonal_mass(p, k):
    """Inertia of coordinate ``k`` with the rings it moves."""
    total = p[members.table(p, SP.AT_MASS) + k * members.padded(p) + k]
    for b in range(members.count(p)):
        r = members.row(p, b)
        t = int(p[r + SP.ROW_AT_T]) + k * SP.LANES
        for i in range(int(p[r + SP.ROW_DRIVEN])):
            total += p[r + SP.ROW_MASS + i] * p[t + i] * p[t + i]
    return total


@kernel
def forces_at_rest(p, s, w, speed):
    """Put forces at the trial places, at rest, to the residual, and find derivatives; False if none."""
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    place = members.vector(p, SP.PLACE)
    rate = members.vector(p, SP.RATE)
    for i in range(members.padded(p)):
        ws[rate + i] = 0.0
        ws[members.vector(p, SP.ACCELERATION) + i] = 0.0
    shaft_forces(p, own, ws, place, rate, 0.0, 0.0, 0.0, ws, members.vector(p, SP.RESIDUAL))
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        lv = members.condensed(sb)
        follow_trial(p, b, own, ws, wb, 0.0)
        wb[W.STAGE + Y.V0] = 0.0
        if not derivatives(members.parameters(p, b), sb[S.C : S.C + C.SIZE], lv, 0.0, speed, 0.0, wb):
            return False
        pull_rings(p, b, lv, wb, ws)
    return True


@kernel
def rest_once(p, s, w, speed):
    """Move the trial places by one Newton step towards rest; its length (m), negative if there is none."""
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
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
    found = members.vector(p, SP.INCREMENT)
    answer(p, own, ws, members.inverse(p), members.vector(p, SP.RESIDUAL), found)
    levers = members.history(p) + H.LEVERS * members.padded(p)
    longest = 0.0
    for i in range(n):
        longest = max(longest, own[levers + i] * abs(ws[found + i]))
    if not (longest < 1e3):
        return -1.0
    share = min(1.0, _LONGEST / (longest + 1e-300))
    for i in range(n):
        ws[members.vector(p, SP.PLACE) + i] += share * ws[found + i]
    return longest


@kernel
def at_rest(p, s, w, speed):
    """Find where the set rests without unbalance, from the guess in ``SP.PLACE``; whether found.

    As ``condensed.linearised.at_rest`` does for a single bearing.
    """
    ws = members.own_work(p, w)
    found = False
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        ws[members.scratch(p, b) + SP.START_ECCENTRICITY] = sb[S.C + C.ECCENTRICITY]
        sb[S.C + C.ECCENTRICITY] = 0.0
    for _ in range(_ROUNDS):
        longest = rest_once(p, s, w, speed)
        if longest < 1e-12:
            found = longest >= 0.0
            break
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        sb[S.C + C.ECCENTRICITY] = ws[members.scratch(p, b) + SP.START_ECCENTRICITY]
    return found
