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
from fmu_bearing.engine.lanes import sum_lanes
from fmu_bearing.engine.layout import FL, STRIDE, C, F, P, Q, R, S, W, X, Y


@kernel
def flexure_state(p):
    """Place of the flexure's part in ``s``."""
    return S.SOUND + int(p[P.SOUND_STATE])


@kernel
def bends(p, race):
    """Whether the ring of ``race`` has flexural modes."""
    found = False
    for k in range(int(p[P.MODES])):
        if int(p[int(p[P.AT_MODES]) + k * P.MODE_SIZE + P.MODE_BODY]) == race:
            found = True
    return found


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
def first_order(lanes, race, w, own):
    """Cosine and sine of each ball's angle about the displaced ring's own centre."""
    pose = W.POSE + race * X.SIZE
    for j in range(lanes):
        c = w[W.COS + j]
        s = w[W.SIN + j]
        hr = w[pose + X.H + STRIDE + j]
        ht = w[pose + X.H + 2 * STRIDE + j]
        unit = 1.0 / math.sqrt(hr * hr + ht * ht)
        own[FL.COS + j] = (c * hr - s * ht) * unit
        own[FL.SIN + j] = (s * hr + c * ht) * unit


@kernel
def raise_order(times, lanes, own, source, at):
    """Cosine and sine of the order ``times`` above that of the rows at ``source`` into those at ``at``."""
    for j in range(2 * STRIDE):
        own[at + j] = own[source + j]
    for _ in range(times):
        for j in range(lanes):
            c = own[at + j]
            s = own[at + STRIDE + j]
            c1 = own[FL.COS + j]
            s1 = own[FL.SIN + j]
            own[at + j] = c * c1 - s * s1
            own[at + STRIDE + j] = s * c1 + c * s1


@kernel
def add_mode(p, mode, lanes, spin, own, at, a, b, va, vb):
    """Add one mode's share to the rows of the groove's motion; ``at``: its cosine and sine."""
    n = p[mode + P.MODE_ORDER]
    psi_x = p[mode + P.MODE_X]
    psi_r = p[mode + P.MODE_R]
    psi_t = p[mode + P.MODE_T]
    tilt = p[mode + P.MODE_TILT]
    da = va + n * spin * b
    db = vb - n * spin * a
    for j in range(lanes):
        c = own[at + j]
        s = own[at + STRIDE + j]
        along = a * c + b * s
        across = n * (a * s - b * c)
        moving = da * c + db * s
        own[FL.X + j] += psi_x * along
        own[FL.R + j] += psi_r * along
        own[FL.GX + j] -= psi_x * across
        own[FL.GR + j] -= psi_r * across
        own[FL.VX + j] += psi_x * moving
        own[FL.VR + j] += psi_r * moving
        own[FL.VT + j] += psi_t * (da * s - db * c)
        own[FL.TURN + j] += tilt * moving


@kernel
def bend(p, lanes, race, spin, own):
    """Motion of the groove of one ring under each ball, into the rows of ``own``."""
    table = int(p[P.AT_MODES])
    q = FL.Q
    v = FL.V
    source = FL.COS
    order = 1
    for i in range(FL.COS):
        own[i] = 0.0
    for k in range(int(p[P.MODES])):
        mode = table + k * P.MODE_SIZE
        if int(p[mode + P.MODE_BODY]) == race:
            at = FL.MODES + 2 * k * STRIDE
            n = int(p[mode + P.MODE_ORDER])
            if n < order:
                source = FL.COS
                order = 1
            raise_order(n - order, lanes, own, source, at)
            source = at
            order = n
            add_mode(
                p, mode, lanes, spin, own, at, own[q + 2 * k], own[q + 2 * k + 1], own[v + 2 * k],
                own[v + 2 * k + 1],
            )  # fmt: skip


@kernel
def move_groove(p, c, lanes, race, spin, w):
    """Shift by its flexure what ``relative_pose`` left of the balls' places and velocities against a ring.

    Leaves in the rows ``FL.GX`` and ``FL.GR`` the slope of the track and the ratio of the radii that
    :func:`lean` takes, in ``FL.VT`` the circumferential velocity.
    """
    own = w[W.FLEX :]
    pose = W.POSE + race * X.SIZE
    first_order(lanes, race, w, own)
    bend(p, lanes, race, spin, own)
    held = C.RACES + race * C.RACE_SIZE
    groove_x = c[held + C.GROOVE_X]
    groove_r = c[held + C.GROOVE_RADIUS]
    for j in range(lanes):
        axial = w[pose + X.A + j] - own[FL.X + j]
        before = w[pose + X.RHO + j]
        rho = before - own[FL.R + j]
        sx = axial - groove_x
        sr = rho - groove_r
        turn = own[FL.TURN + j]
        # the section turns about the centre of the groove's circle
        vx = own[FL.VX + j] - turn * sr
        vr = own[FL.VR + j] + turn * sx
        slope = (sx * own[FL.GX + j] + sr * own[FL.GR + j]) / math.sqrt(sx * sx + sr * sr)
        own[FL.GX + j] = -slope
        own[FL.GR + j] = rho / before
        w[pose + X.A + j] = axial
        w[pose + X.RHO + j] = rho
        hx = w[pose + X.H + j]
        hr = w[pose + X.H + STRIDE + j]
        ht = w[pose + X.H + 2 * STRIDE + j]
        w[pose + X.DV + j] -= vx * w[pose + X.N + j] + vr * hx
        w[pose + X.DV + STRIDE + j] -= vx * w[pose + X.N + STRIDE + j] + vr * hr
        w[pose + X.DV + 2 * STRIDE + j] -= vx * w[pose + X.N + 2 * STRIDE + j] + vr * ht
        w[pose + X.DW + j] -= turn * w[pose + X.T + j]
        w[pose + X.DW + STRIDE + j] -= turn * w[pose + X.T + STRIDE + j]
        w[pose + X.DW + 2 * STRIDE + j] -= turn * w[pose + X.T + 2 * STRIDE + j]


@kernel
def lean(p, lanes, race, w):
    """Add the flexed track's slope to the waviness'; both over the radius before the shift."""
    own = w[W.FLEX :]
    row = W.RACE + race * R.SIZE
    for j in range(lanes):
        slope = w[row + R.SLOPE + j] + own[FL.GX + j]
        w[row + R.SLOPE + j] = slope * own[FL.GR + j]


@kernel
def slide(p, lanes, race, w):
    """Take the circumferential velocity of the groove from the sliding along the track."""
    own = w[W.FLEX :]
    row = W.RACE + race * R.SIZE
    for j in range(lanes):
        w[row + R.UT + j] -= own[FL.VT + j]


@kernel
def groove_forces(p, c, lanes, race, w, own):
    """Gather forces and moment of the balls on one ring's groove into four rows; spare lanes put none."""
    balls = int(p[P.BALLS])
    pose = W.POSE + race * X.SIZE
    force = W.FORCE + race * W.FORCE_SIZE
    row = W.RACE + race * R.SIZE
    loss = W.LOSS + race * STRIDE
    held = C.RACES + race * C.RACE_SIZE
    groove_x = c[held + C.GROOVE_X]
    groove_r = c[held + C.GROOVE_RADIUS]
    for j in range(lanes):
        live = -1.0 if j < balls else 0.0
        fx = w[force + W.FX + j]
        fr = w[force + W.FR + j]
        ft = w[force + W.FT + j]
        fn = fx * w[pose + X.N + j] + fr * w[pose + X.N + STRIDE + j] + ft * w[pose + X.N + 2 * STRIDE + j]
        fh = fx * w[pose + X.H + j] + fr * w[pose + X.H + STRIDE + j] + ft * w[pose + X.H + 2 * STRIDE + j]
        mt = (
            w[force + W.MX + j] * w[pose + X.T + j]
            + w[force + W.MR + j] * w[pose + X.T + STRIDE + j]
            + w[force + W.MT + j] * w[pose + X.T + 2 * STRIDE + j]
        )
        sx = w[pose + X.A + j] - groove_x
        sr = w[pose + X.RHO + j] - groove_r
        drag = live * w[row + R.FT + j]
        own[FL.X + j] = live * fn
        own[FL.R + j] = live * fh
        own[FL.GX + j] = drag
        own[FL.GR + j] = live * (mt + sx * fh - sr * fn)
        # the loss was taken from velocities without the groove's circumferential one
        w[loss + j] -= drag * own[FL.VT + j]


@kernel
def mode_force(p, mode, lanes, own, at, turning):
    """Generalised forces (N) of the force rows on one mode's cosine and sine coordinate.

    ``turning``: 1 with the moment on the section, 0 without.
    """
    psi_x = p[mode + P.MODE_X]
    psi_r = p[mode + P.MODE_R]
    psi_t = p[mode + P.MODE_T]
    tilt = turning * p[mode + P.MODE_TILT]
    for j in range(lanes):
        c = own[at + j]
        s = own[at + STRIDE + j]
        push = psi_x * own[FL.X + j] + psi_r * own[FL.R + j] + tilt * own[FL.GR + j]
        drag = psi_t * own[FL.GX + j]
        own[FL.VX + j] = push * c + drag * s
        own[FL.VR + j] = push * s - drag * c
    return sum_lanes(own, FL.VX, lanes), sum_lanes(own, FL.VR, lanes)


@kernel
def press_modes(p, c, lanes, race, w):
    """Generalised forces of the balls on the modes of one ring, from the forces in the rows of ``w``."""
    own = w[W.FLEX :]
    groove_forces(p, c, lanes, race, w, own)
    table = int(p[P.AT_MODES])
    out = FL.FORCE
    for k in range(int(p[P.MODES])):
        mode = table + k * P.MODE_SIZE
        if int(p[mode + P.MODE_BODY]) == race:
            cosine, sine = mode_force(p, mode, lanes, own, FL.MODES + 2 * k * STRIDE, 1.0)
            own[out + 2 * k] = cosine
            own[out + 2 * k + 1] = sine


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
