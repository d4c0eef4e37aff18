"""Flexure of the rings: what it does to the groove under each ball, and what the balls do to it.

A mode of order n of ring b has two coordinates a, b (m), seen from the frame that does not spin. Under a ball
at the angle phi the circle of groove centres is displaced by::

    u_x, u_r = psi_x, psi_r P,   P = a cos n phi + b sin n phi
    u_t      = psi_t T,          T = a sin n phi - b cos n phi

and the section turns by tau P about the circumferential direction. The material turns under this pattern
with the ring's spin W: its velocity against the turning ring follows from Da = a' + n W b and
Db = b' - n W a in place of a, b. The balls act through the same shapes, so energy closes to rounding; only
friction feels the circumferential motion, for a groove that slides along itself takes no normal load with it.

Equations per coordinate, with g the mode's gyroscopic number::

    m ((Da)' + (n + 2 g) W Db + d Da) + k a = Q_a
    m ((Db)' - (n + 2 g) W Da + d Db) + k b = Q_b

At constant spin and with z = a - i b they are one equation, z'' + 2 i W (n + g) z' + (k/m - n^2 W^2
- 2 n g W^2) z + d (z' + i n W z) = (Q_a - i Q_b)/m. The stiffening of the ring by its own centrifugal load
is left out.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import consecutive, load, select, splat, store, sum_four
from fmu_bearing.engine.layout import FL, FOUR, STRIDE, C, F, P, Q, R, S, W, X, Y
from fmu_bearing.engine.mechanics.triples import added, dot, scaled, store_three, three


@kernel
def flexure_state(p):
    """Place of the flexure's part in ``s``."""
    return S.SOUND + int(p[P.SOUND_STATE])


@kernel
def modes_of(p, race):
    """First mode of the ring of ``race`` in the table, and where they end: the inner ring's come first."""
    inner = int(p[P.INNER_MODES])
    return (0, inner) if race == 0 else (inner, int(p[P.MODES]))


@kernel
def bends(p, race):
    """Whether the ring of ``race`` has flexural modes."""
    first, end = modes_of(p, race)
    return first < end


@kernel
def show_flexure(p, s, w):
    """Places and velocities of the coordinates in ``s`` to where the right-hand side reads them."""
    if p[P.MODES] == 0.0:
        return
    count = 2 * int(p[P.MODES])
    flexure = s[flexure_state(p) :]
    for i in range(count):
        w[W.FLEX + FL.Q + i] = flexure[i]
        w[W.FLEX + FL.V + i] = flexure[count + i]


@kernel
def keep_accelerations(p, s, w):
    """Accelerations of the coordinates, from the right-hand side just evaluated, into ``s``."""
    if p[P.MODES] == 0.0:
        return
    count = 2 * int(p[P.MODES])
    flexure = s[flexure_state(p) + 2 * count :]
    own = w[W.FLEX + FL.A :]
    for i in range(count):
        flexure[i] = own[i]


@kernel
def first_order(race, j, w):
    """Cosine and sine of the angles of four balls about the displaced ring's own centre."""
    c = load(w, W.COS + j)
    s = load(w, W.SIN + j)
    _, hr, ht = three(w, W.POSE + race * X.SIZE + X.H + j)
    unit = 1.0 / math.sqrt(hr * hr + ht * ht)
    return (c * hr - s * ht) * unit, (s * hr + c * ht) * unit


@kernel
def groove_motion(p, race, spin, j, w, own):
    """Motion of the groove of one ring under four balls; each mode's cosine and sine into ``own``.

    Returns displacement (m) x, r, its change with the angle (m) x, r, velocity of the material (m/s)
    x, r, theta and angular velocity (rad/s) about the circumferential direction.
    """
    cosine, sine = first_order(race, j, w)
    c = cosine
    s = sine
    order = 1
    x = r = gx = gr = vx = vr = vt = turn = splat(0.0)
    first, end = modes_of(p, race)
    for k in range(first, end):
        mode = int(p[P.AT_MODES]) + k * P.MODE_SIZE
        n = p[mode + P.MODE_ORDER]
        if n < order:
            c = cosine
            s = sine
            order = 1
        for _ in range(int(n) - order):
            c, s = c * cosine - s * sine, s * cosine + c * sine
        order = int(n)
        at = FL.MODES + 2 * k * STRIDE + j
        store(own, at, c)
        store(own, at + STRIDE, s)
        psi_x = p[mode + P.MODE_X]
        psi_r = p[mode + P.MODE_R]
        a = own[FL.Q + 2 * k]
        b = own[FL.Q + 2 * k + 1]
        da = own[FL.V + 2 * k] + n * spin * b
        db = own[FL.V + 2 * k + 1] - n * spin * a
        out = a * c + b * s
        across = n * (a * s - b * c)
        moving = da * c + db * s
        x += psi_x * out
        r += psi_r * out
        gx -= psi_x * across
        gr -= psi_r * across
        vx += psi_x * moving
        vr += psi_r * moving
        vt += p[mode + P.MODE_T] * (da * s - db * c)
        turn += p[mode + P.MODE_TILT] * moving
    return x, r, gx, gr, vx, vr, vt, turn


@kernel
def move_groove(p, c, lanes, race, spin, w):
    """Shift by its flexure what ``relative_pose`` left of the balls' places and velocities against a ring.

    Leaves in the rows ``FL.GX`` and ``FL.GR`` the slope of the track and the ratio of the radii that
    :func:`add_groove_slope` takes, in ``FL.VT`` the circumferential velocity.
    """
    own = w[W.FLEX :]
    pose = W.POSE + race * X.SIZE
    raceway = C.RACES + race * C.RACE_SIZE
    groove_x = c[raceway + C.GROOVE_X]
    groove_r = c[raceway + C.GROOVE_RADIUS]
    for j in range(0, lanes, FOUR):
        x, r, gx, gr, vx, vr, vt, turn = groove_motion(p, race, spin, j, w, own)
        axial = load(w, pose + X.A + j) - x
        before = load(w, pose + X.RHO + j)
        rho = before - r
        sx = axial - groove_x
        sr = rho - groove_r
        # the section turns about the centre of the groove's circle
        vx -= turn * sr
        vr += turn * sx
        store(own, FL.GX + j, -((sx * gx + sr * gr) / math.sqrt(sx * sx + sr * sr)))
        store(own, FL.GR + j, rho / before)
        store(own, FL.VT + j, vt)
        store(w, pose + X.A + j, axial)
        store(w, pose + X.RHO + j, rho)
        moved = added(scaled(vx, three(w, pose + X.N + j)), scaled(vr, three(w, pose + X.H + j)))
        store_three(w, pose + X.DV + j, added(three(w, pose + X.DV + j), scaled(-1.0, moved)))
        turned = scaled(-turn, three(w, pose + X.T + j))
        store_three(w, pose + X.DW + j, added(three(w, pose + X.DW + j), turned))


@kernel
def add_groove_slope(lanes, race, w):
    """Add the flexed track's slope to the waviness'; both over the radius before the shift."""
    own = w[W.FLEX :]
    row = W.RACE + race * R.SIZE + R.SLOPE
    for j in range(0, lanes, FOUR):
        store(w, row + j, (load(w, row + j) + load(own, FL.GX + j)) * load(own, FL.GR + j))


@kernel
def add_groove_sliding(lanes, race, w):
    """Take the circumferential velocity of the groove from the sliding along the track."""
    own = w[W.FLEX :]
    row = W.RACE + race * R.SIZE + R.UT
    for j in range(0, lanes, FOUR):
        store(w, row + j, load(w, row + j) - load(own, FL.VT + j))


@kernel
def groove_forces(p, c, lanes, race, w, own):
    """Gather forces and moment of the balls on one ring's groove into four rows; spare lanes put none."""
    pose = W.POSE + race * X.SIZE
    force = W.FORCE + race * W.FORCE_SIZE
    row = W.RACE + race * R.SIZE
    loss = W.LOSS + race * STRIDE
    raceway = C.RACES + race * C.RACE_SIZE
    groove_x = c[raceway + C.GROOVE_X]
    groove_r = c[raceway + C.GROOVE_RADIUS]
    for j in range(0, lanes, FOUR):
        live = select(consecutive(j) < p[P.BALLS], -1.0, 0.0)
        on_ball = three(w, force + W.FX + j)
        fn = dot(on_ball, three(w, pose + X.N + j))
        fh = dot(on_ball, three(w, pose + X.H + j))
        mt = dot(three(w, force + W.MX + j), three(w, pose + X.T + j))
        sx = load(w, pose + X.A + j) - groove_x
        sr = load(w, pose + X.RHO + j) - groove_r
        drag = live * load(w, row + R.FT + j)
        store(own, FL.X + j, live * fn)
        store(own, FL.R + j, live * fh)
        store(own, FL.GX + j, drag)
        store(own, FL.GR + j, live * (mt + sx * fh - sr * fn))
        # the loss was taken from velocities without the groove's circumferential one
        store(w, loss + j, load(w, loss + j) - drag * load(own, FL.VT + j))


@kernel
def mode_force(p, mode, lanes, own, at, turning):
    """Generalised forces (N) of the force rows on one mode's cosine and sine coordinate.

    ``at``: rows of its cosine and sine under the balls; ``turning``: 1 with the moment on the section, 0
    without.
    """
    psi_x = p[mode + P.MODE_X]
    psi_r = p[mode + P.MODE_R]
    psi_t = p[mode + P.MODE_T]
    tilt = turning * p[mode + P.MODE_TILT]
    cosine = splat(0.0)
    sine = splat(0.0)
    for j in range(0, lanes, FOUR):
        c = load(own, at + j)
        s = load(own, at + STRIDE + j)
        radial_force = psi_x * load(own, FL.X + j) + psi_r * load(own, FL.R + j) + tilt * load(own, FL.GR + j)
        drag = psi_t * load(own, FL.GX + j)
        cosine += radial_force * c + drag * s
        sine += radial_force * s - drag * c
    return sum_four(cosine), sum_four(sine)


@kernel
def modal_forces(p, c, lanes, race, w):
    """Generalised forces of the balls on the modes of one ring, from the forces in the rows of ``w``."""
    own = w[W.FLEX :]
    groove_forces(p, c, lanes, race, w, own)
    first, end = modes_of(p, race)
    for k in range(first, end):
        mode = int(p[P.AT_MODES]) + k * P.MODE_SIZE
        i = 2 * k
        own[FL.FORCE + i], own[FL.FORCE + i + 1] = mode_force(p, mode, lanes, own, FL.MODES + i * STRIDE, 1.0)


@kernel
def flexure_equations(p, y, speed, speed_rate, w, f):
    """Accelerations of the coordinates from their forces; their damping heats the rings (rows of ``f``)."""
    own = w[W.FLEX :]
    table = int(p[P.AT_MODES])
    q = FL.Q
    v = FL.V
    force = FL.FORCE
    out = FL.A
    for k in range(int(p[P.MODES])):
        mode = table + k * P.MODE_SIZE
        inner = p[mode + P.MODE_BODY] == 0.0
        spin = speed if inner else y[Y.V0 + Q.OUTER + Q.TURN]
        rate = speed_rate if inner else f[F.BODY + Q.OUTER + Q.TURN]
        n = p[mode + P.MODE_ORDER]
        mass = p[mode + P.MODE_MASS]
        stiff = p[mode + P.MODE_STIFFNESS] / mass
        damping = p[mode + P.MODE_DAMPING]
        whirl = (n + 2.0 * p[mode + P.MODE_GYROSCOPIC]) * spin
        a = own[q + 2 * k]
        b = own[q + 2 * k + 1]
        va = own[v + 2 * k]
        vb = own[v + 2 * k + 1]
        da = va + n * spin * b
        db = vb - n * spin * a
        own[out + 2 * k] = (
            own[force + 2 * k] / mass - stiff * a - damping * da - whirl * db - n * (spin * vb + rate * b)
        )
        own[out + 2 * k + 1] = (
            own[force + 2 * k + 1] / mass - stiff * b - damping * db + whirl * da + n * (spin * va + rate * a)
        )
        f[F.HEAT if inner else F.HEAT_OUTER] += damping * mass * (da * da + db * db)


@kernel
def flexure_energy(p, y, speed, w):
    """Kinetic and strain energy (J) of the modes, seats included, for the coordinates last evaluated."""
    own = w[W.FLEX :]
    table = int(p[P.AT_MODES])
    q = FL.Q
    v = FL.V
    total = 0.0
    for k in range(int(p[P.MODES])):
        mode = table + k * P.MODE_SIZE
        spin = speed if p[mode + P.MODE_BODY] == 0.0 else y[Y.V0 + Q.OUTER + Q.TURN]
        turn = p[mode + P.MODE_ORDER] * spin
        a = own[q + 2 * k]
        b = own[q + 2 * k + 1]
        da = own[v + 2 * k] + turn * b
        db = own[v + 2 * k + 1] - turn * a
        total += 0.5 * p[mode + P.MODE_MASS] * (da * da + db * db)
        total += 0.5 * p[mode + P.MODE_STIFFNESS] * (a * a + b * b)
    return total
