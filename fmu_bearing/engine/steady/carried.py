"""Quasi-static balls where no steady state is found: loaded ones roll, the cage carries the others.

Under a load across the axis with little or none along it most balls leave the inner race: centrifugal force
and weight alone hold them to the outer one, and nothing but the cage drives them round. Patterns have
contacts that open between two balls then, and there are no even balls. So each ball stays where the
quasi-static kernel has put it, with its own loads, and its rates alone are balanced, by the right-hand side:
rolling resistance, sliding, drag and gyroscopic moments of each contact, as in a run.

The cage turns with the balls that races hold, the mean of their own orbits by their loads. A ball may orbit
as much faster or slower as its pocket's clearance lets it over half a turn. One that would go beyond is
carried: it has that speed, and the wall of its pocket puts the force on it that it lacks. The cage lies in
its lands where their film carries its weight and the balls' forces. Not in balance are the moment about the
cage's axis, by which loaded balls push it on or hold it back, and what the balls' way through the loads adds.
"""

import math

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.dense import eliminate
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import PT, ST, STRIDE, C, F, J, P, Q, R, W, Y
from fmu_bearing.engine.mechanics.bodies import guiding_ring, land_forces
from fmu_bearing.engine.mechanics.contact import approach_under
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.newton.jacobian import jacobian

_ROUNDS = 60
# Rounds after which steps are halved, and a ball that still goes to and fro between its own orbit and the one
# that the cage prescribes is carried: loaded balls take some ten.
_PATIENCE = 30
# Of the load on all balls: lighter ones need not settle, they slide at forces that nobody feels.
_LIGHT = 0.02
# Of the spin, in a round: see `spin_balance`.
_STRIDE_LIMIT = 2.5e-3
_ALONG = 2e-6  # m, in a round: along the orbit, about the depth of a pocket's contact
_SETTLED = 1e-8  # of the longest steps
# N, of all balls at the inner race: with less nothing turns balls and cage
_HELD = 1e-3
_ALONE = 0.01  # of the orbit speed: what balls without pockets may differ by (assumed)
_HALVINGS = 60
_FARTHEST = 1.2  # of the lands' clearance, beyond the dry stop
_NOWHERE = 1e9  # steps, where equations have no solution

_ANSWER = F.TH // STRIDE  # orbit and spin among the accelerations,
_ORBIT = Y.OM // STRIDE  # among the rates
_PLACE = Y.TH // STRIDE  # and the angle among the places of a ball


@kernel
def mean_orbit(p, y, w):
    """Mean orbit speed (rad/s) of the balls by their loads at the inner race, and the sum of these (N)."""
    total = 0.0
    orbit = 0.0
    for j in range(int(p[P.BALLS])):
        load = w[W.RACE + R.LOAD + j]
        total += load
        orbit += load * y[Y.OM + j]
    return orbit / (total + 1e-300), total


@kernel
def slack(p):
    """How much faster or slower than the cage a ball may orbit, over the cage's speed.

    Over half a turn it then goes from one wall of its pocket to the other.
    """
    if p[P.CAGE] == 0.0:
        return _ALONE
    return 2.0 * p[P.POCKET_CLEARANCE] / (math.pi * p[P.PITCH_RADIUS])


@kernel
def solve_ball(unknown, first, j, jac, f, rows):
    """Newton's step of ball ``j`` into the last column of ``rows``; False where there is none.

    Unknowns: orbit or place, by its column ``unknown``, and spin; ``first`` 1: spin alone.
    """
    n = ST.SPIN_RATES - first
    width = n + 1
    for i in range(n):
        row = J.B + (_ANSWER + first + i) * J.STATES * STRIDE + j
        for k in range(n):
            state = unknown if first + k == 0 else _ORBIT + first + k
            rows[i * width + k] = jac[row + state * STRIDE]
        rows[i * width + n] = -f[F.TH + (first + i) * STRIDE + j]
    return eliminate(rows, 0, n)


@kernel
def spin_of(y, j):
    """Size (rad/s) of the spin of ball ``j``, never 0."""
    return math.sqrt(y[Y.WX + j] ** 2 + y[Y.WR + j] ** 2 + y[Y.WT + j] ** 2) + 1e-3


@kernel
def move_spin(y, rows, first, share, j):
    """Go ``share`` of the step of the spin of ball ``j``."""
    n = ST.SPIN_RATES - first
    for i in range(1, ST.SPIN_RATES):
        y[Y.OM + i * STRIDE + j] += share * rows[(i - first) * (n + 1) + n]


@kernel
def longest_spin(rows, first):
    """Largest step (rad/s) of the rates, of the spin alone where ``first`` is 1."""
    n = ST.SPIN_RATES - first
    most = 0.0
    for i in range(n):
        most = max(most, abs(rows[i * (n + 1) + n]))
    return most


@kernel
def roll_once(y, low, high, lanes, least, late, jac, f, rows, w):
    """Move the rates of all balls by a step, orbits within ``low`` and ``high`` (rad/s).

    ``least``: load (N) at the inner race from which on a ball counts; ``late``: beyond `_PATIENCE`, when
    balls that do not settle are marked in ``PT.SCALE`` and carried. Returns the largest step over the longest
    one, of all balls and of those that count.
    """
    most = 0.0
    felt = 0.0
    mark = W.PATTERN + PT.SCALE
    for j in range(lanes):
        bound = min(max(y[Y.OM + j], low), high)
        first = 0
        if w[mark + j] != 0.0 or not solve_ball(_ORBIT, 0, j, jac, f, rows):
            first = 1
        else:
            step = rows[ST.SPIN_RATES]
            if (bound <= low and step < 0.0) or (bound >= high and step > 0.0):
                first = 1
        if first == 1 and not solve_ball(_ORBIT, 1, j, jac, f, rows):
            most = _NOWHERE
            felt = _NOWHERE
            continue
        longest = _STRIDE_LIMIT * spin_of(y, j)
        ahead = longest_spin(rows, first) / longest
        share = (0.5 if late else 1.0) / max(ahead, 1.0)
        if first == 0:
            before = y[Y.OM + j]
            y[Y.OM + j] = min(max(before + share * rows[ST.SPIN_RATES], low), high)
            if late and ahead > 1.0:
                w[mark + j] = 1.0
                y[Y.OM + j] = low if f[F.TH + j] < 0.0 else high
        else:
            y[Y.OM + j] = bound
        move_spin(y, rows, first, share, j)
        most = max(most, ahead)
        if w[W.RACE + R.LOAD + j] > least:
            felt = max(felt, ahead)
    return most, felt


@kernel
def roll(p, c, y, speed, low, high, load, w, jac):
    """Balance the rates of the balls in ``y`` with their pockets out of reach; whether that succeeds.

    ``load``: of the inner race on all balls (N).
    """
    rows = w[W.SPIN_SYSTEM : W.SPIN_SYSTEM + ST.SPIN_SYSTEM_SIZE]
    f = w[W.F0 : W.F0 + F.SIZE]
    pocket = c[C.POCKET]
    c[C.POCKET] = 0.0
    lanes = int(p[P.LANES])
    for j in range(lanes):
        w[W.PATTERN + PT.SCALE + j] = 0.0
    felt = 1.0
    for n in range(_ROUNDS):
        jacobian(p, c, y, 0.0, speed, 0.0, w, jac)
        most, felt = roll_once(y, low, high, lanes, _LIGHT * load, n >= _PATIENCE, jac, f, rows, w)
        if most < _SETTLED:
            break
    c[C.POCKET] = pocket
    return felt < 1.0


@kernel
def is_carried(y, j, low, high):
    """Whether the cage carries ball ``j``: it would be slower or faster than its pocket lets it."""
    return y[Y.OM + j] <= low or y[Y.OM + j] >= high


@kernel
def find_pushes(p, y, low, high, w):
    """Put to ``PT.SCALE`` what the cage has to put on each ball along its orbit (N), by the last evaluation.

    Returns the forces y, z (N) of the balls on the cage.
    """
    aside = 0.0
    above = 0.0
    push = W.PATTERN + PT.SCALE
    for j in range(int(p[P.LANES])):
        w[push + j] = 0.0
        if is_carried(y, j, low, high):
            radius = p[P.PITCH_RADIUS] + y[Y.R + j]
            w[push + j] = -p[P.BALL_MASS] * radius * w[W.F0 + F.TH + j]
        if j < p[P.BALLS]:
            aside += w[push + j] * math.cos(y[Y.TH + j])
            above += w[push + j] * math.sin(y[Y.TH + j])
    return aside, above


@kernel
def film_at(p, c, y, speed, apart, w):
    """Force y, z (N) of the lands on a cage that lies ``apart`` (m) along y from the middle of its lands."""
    f = w[W.F : W.F + F.SIZE]
    for i in range(F.SIZE):
        f[i] = 0.0
    ring, _ = guiding_ring(p)
    y[Y.Q0 + Q.CAGE + Q.Y] = y[Y.Q0 + ring + Q.Y] + apart
    y[Y.Q0 + Q.CAGE + Q.Z] = y[Y.Q0 + ring + Q.Z]
    land_forces(p, c, y, speed, f, w)
    return f[F.BODY + Q.CAGE + Q.Y], f[F.BODY + Q.CAGE + Q.Z]


@kernel
def hang_cage(p, c, y, speed, aside, above, w):
    """Put the cage where the film of its lands carries its weight and the forces y, z (N) on it.

    In the middle where the lands are dry or nothing acts. The film is the same all round: by how far off the
    cage is follows the size of its force, and then the direction.
    """
    ring, _ = guiding_ring(p)
    middle_y, middle_z = y[Y.Q0 + ring + Q.Y], y[Y.Q0 + ring + Q.Z]
    if p[P.GRAVITY] != 0.0:
        above -= GRAVITY * p[P.CAGE_MASS]
    size = math.sqrt(aside * aside + above * above)
    near = 0.0
    far = _FARTHEST * c[C.LAND_CLEARANCE]
    if size > 0.0:
        for _ in range(_HALVINGS):
            middle = 0.5 * (near + far)
            fy, fz = film_at(p, c, y, speed, middle, w)
            if fy * fy + fz * fz < size * size:
                near = middle
            else:
                far = middle
    fy, fz = film_at(p, c, y, speed, far, w)
    held = math.sqrt(fy * fy + fz * fz)
    if size == 0.0 or not (held > 0.5 * size):
        far = 0.0
    # turned by the angle from this force to the one that is needed
    per = 1.0 / (size * held + 1e-300)
    cosine = -(fy * aside + fz * above) * per
    sine = (fz * aside - fy * above) * per
    y[Y.Q0 + Q.CAGE + Q.Y] = middle_y + far * cosine
    y[Y.Q0 + Q.CAGE + Q.Z] = middle_z + far * sine


@kernel
def lean_on_pocket(p, c, y, push, j):
    """Put ball ``j`` to where its pocket's wall puts ``push`` (N) on it along its orbit.

    A ball that needs no push stays, unless its pocket lies elsewhere: then it just touches the wall.
    """
    k = Y.Q0 + Q.CAGE
    place = j if j < p[P.BALLS] else 0
    pocket = y[k + Q.TURN] + 2.0 * math.pi * place / p[P.BALLS]
    radius = p[P.PITCH_RADIUS] + y[Y.R + j]
    apart = p[P.POCKET_CLEARANCE] + approach_under(c[C.POCKET], abs(push))
    axial = y[Y.X + j] - y[k + Q.X]
    if abs(axial) >= apart:
        return
    wall = math.sqrt(apart * apart - axial * axial)
    moved = -math.cos(pocket) * y[k + Q.Y] - math.sin(pocket) * y[k + Q.Z]
    around = radius * math.sin(y[Y.TH + j] - pocket) - moved
    if push == 0.0:
        around = min(max(around, -wall), wall)
    else:
        around = -math.copysign(wall, push)
    y[Y.TH + j] = pocket + math.asin(min(max((around + moved) / radius, -1.0), 1.0))


@kernel
def lean_once(p, y, low, high, jac, f, rows, w):
    """Move carried balls into their pockets' walls and balance all spins by a step; as `roll_once`."""
    most = 0.0
    push = W.PATTERN + PT.SCALE
    for j in range(int(p[P.LANES])):
        carried = is_carried(y, j, low, high)
        # next to no push may turn round as the pocket rubs on the ball: then that is left
        leans = carried and w[push + j] != 0.0 and w[W.POCKET + j] > 0.0
        first = 1 if carried and not leans else 0
        if not solve_ball(_PLACE if leans else _ORBIT, first, j, jac, f, rows):
            most = _NOWHERE
            continue
        longest = _STRIDE_LIMIT * spin_of(y, j)
        ahead = 0.0
        n = ST.SPIN_RATES - first
        for i in range(n):
            step = abs(rows[i * (n + 1) + n])
            far = _ALONG / p[P.PITCH_RADIUS] if leans and i == 0 else longest
            ahead = max(ahead, step / far)
        share = 1.0 / max(ahead, 1.0)
        if leans:
            y[Y.TH + j] += share * rows[ST.SPIN_RATES]
        elif first == 0:
            y[Y.OM + j] = min(max(y[Y.OM + j] + share * rows[ST.SPIN_RATES], low), high)
        move_spin(y, rows, first, share, j)
        most = max(most, ahead)
    return most


@kernel
def lean_on_pockets(p, c, y, speed, low, high, w, jac):
    """Let the pockets' walls carry balls; whether that finds a balance."""
    rows = w[W.SPIN_SYSTEM : W.SPIN_SYSTEM + ST.SPIN_SYSTEM_SIZE]
    f = w[W.F0 : W.F0 + F.SIZE]
    push = W.PATTERN + PT.SCALE
    for j in range(int(p[P.LANES])):
        lean_on_pocket(p, c, y, w[push + j], j)
    most = 1.0
    for _ in range(_ROUNDS):
        jacobian(p, c, y, 0.0, speed, 0.0, w, jac)
        most = lean_once(p, y, low, high, jac, f, rows, w)
        if most < _SETTLED:
            break
    return most < 1.0


@kernel
def roll_loose(p, c, y, orbit, w):
    """Let balls that the outer race alone touches, by the last evaluation, roll about the bearing's axis.

    The quasi-static kernel has them roll on both races, on the inner one at the angle at which it is near.
    """
    ball = c[C.BALL_RADIUS]
    outer = W.RACE + R.SIZE
    for j in range(int(p[P.LANES])):
        cosine = w[outer + R.COSA + j]
        if w[W.RACE + R.LOAD + j] > 0.0 or not (cosine > 0.5):
            continue
        radius = p[P.PITCH_RADIUS] + y[Y.R + j]
        y[Y.OM + j] = orbit
        y[Y.WX + j] = orbit - orbit * (radius + ball * cosine) / (ball * cosine)
        y[Y.WR + j] = 0.0
        y[Y.WT + j] = 0.0


@kernel
def copy_state(source, at, target, to):
    """Copy a state from ``source[at:]`` to ``target[to:]``."""
    for i in range(Y.SIZE):
        target[to + i] = source[at + i]


@kernel
def carry_balls(p, c, y, speed, w, jac):
    """Balance the rates of the quasi-static balls in ``y``, and cage and pockets where there are any.

    ``speed`` of the shaft (rad/s), not zero; ``jac``: scratch for a Jacobian. False where no ball is held by
    the races, or no balance is found: ``y`` then stays.
    """
    kept = W.PATTERN + PT.EIGEN
    right_hand_side(p, c, y, 0.0, speed, 0.0, w, w[W.F : W.F + F.SIZE])
    orbit, load = mean_orbit(p, y, w)
    if not (load > _HELD):
        return False
    copy_state(y, 0, w, kept)
    roll_loose(p, c, y, orbit, w)
    low = 0.0
    high = 0.0
    # the orbits of rolling at the middle of both contacts first, then the balls' own
    for _ in range(2):
        low = orbit - abs(orbit) * slack(p)
        high = orbit + abs(orbit) * slack(p)
        if p[P.CAGE] != 0.0:
            y[Y.V0 + Q.CAGE + Q.TURN] = orbit
        if not roll(p, c, y, speed, low, high, load, w, jac):
            copy_state(w, kept, y, 0)
            return False
        orbit, _ = mean_orbit(p, y, w)
    if p[P.CAGE] == 0.0:
        return True
    copy_state(y, 0, w, kept)
    aside, above = find_pushes(p, y, low, high, w)
    if p[P.LAND] != 0.0:
        hang_cage(p, c, y, speed, aside, above, w)
    # without the pockets' friction, and the cage in the middle
    if not lean_on_pockets(p, c, y, speed, low, high, w, jac):
        copy_state(w, kept, y, 0)
    return True
