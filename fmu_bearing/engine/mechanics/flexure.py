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

from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import (
    C_RACE_SIZE,
    C_RACES,
    F_G,
    F_HEAT,
    P_AT_MODES,
    P_BALLS,
    P_MODES,
    P_SOUND_STATE,
    POSE_ROWS,
    Q_OUTER,
    R_FT,
    R_SLOPE,
    R_UT,
    RACE_ROWS,
    S_SOUND,
    STRIDE,
    W_COS,
    W_FLEX,
    W_FORCE,
    W_LOSS,
    W_POSE,
    W_RACE,
    W_SIN,
    X_A,
    X_DV,
    X_DW,
    X_H,
    X_N,
    X_RHO,
    X_T,
    Y_V,
)
from fmu_bearing.engine.layout_flexure import (
    FLEX_ROWS,
    FR_COS,
    FR_GR,
    FR_GX,
    FR_R,
    FR_SIN,
    FR_TURN,
    FR_VR,
    FR_VT,
    FR_VX,
    FR_X,
    FW_A,
    FW_FORCE,
    FW_Q,
    FW_V,
    MODE_BODY,
    MODE_DAMPING,
    MODE_GYROSCOPIC,
    MODE_MASS,
    MODE_ORDER,
    MODE_R,
    MODE_SIZE,
    MODE_STIFFNESS,
    MODE_T,
    MODE_TILT,
    MODE_X,
)

_S = STRIDE


@kernel
def flexure_state(p):
    """Place of the flexure's part in ``s``."""
    return S_SOUND + int(p[P_SOUND_STATE])


@kernel
def bends(p, race):
    """Whether the ring of ``race`` has flexural modes."""
    found = False
    for k in range(int(p[P_MODES])):
        if int(p[int(p[P_AT_MODES]) + k * MODE_SIZE + MODE_BODY]) == race:
            found = True
    return found


@kernel
def show_flexure(p, s, w):
    """Places and velocities of the coordinates in ``s`` to where the right-hand side reads them."""
    if p[P_MODES] == 0.0:
        return
    count = 2 * int(p[P_MODES])
    kept = s[flexure_state(p) :]
    for i in range(count):
        w[W_FLEX + FW_Q + i] = kept[i]
        w[W_FLEX + FW_V + i] = kept[count + i]


@kernel
def keep_accelerations(p, s, w):
    """Accelerations of the coordinates, from the right-hand side just evaluated, into ``s``."""
    if p[P_MODES] == 0.0:
        return
    count = 2 * int(p[P_MODES])
    kept = s[flexure_state(p) + 2 * count :]
    own = w[W_FLEX + FW_A :]
    for i in range(count):
        kept[i] = own[i]


@inlined
def first_order(lanes, race, w, own):
    """Cosine and sine of each ball's angle about the displaced ring's own centre."""
    pose = (W_POSE + race * POSE_ROWS) * _S
    for j in range(lanes):
        c = w[W_COS * _S + j]
        s = w[W_SIN * _S + j]
        hr = w[pose + (X_H + 1) * _S + j]
        ht = w[pose + (X_H + 2) * _S + j]
        unit = 1.0 / math.sqrt(hr * hr + ht * ht)
        own[FR_COS * _S + j] = (c * hr - s * ht) * unit
        own[FR_SIN * _S + j] = (s * hr + c * ht) * unit


@kernel
def raise_order(times, lanes, own, source, at):
    """Cosine and sine of the order ``times`` above that of the rows at ``source`` into those at ``at``."""
    for j in range(2 * _S):
        own[at + j] = own[source + j]
    for _ in range(times):
        for j in range(lanes):
            c = own[at + j]
            s = own[at + _S + j]
            c1 = own[FR_COS * _S + j]
            s1 = own[FR_SIN * _S + j]
            own[at + j] = c * c1 - s * s1
            own[at + _S + j] = s * c1 + c * s1


@kernel
def add_mode(p, mode, lanes, spin, own, at, a, b, va, vb):
    """Add one mode's share to the rows of the groove's motion; ``at``: its cosine and sine."""
    n = p[mode + MODE_ORDER]
    psi_x = p[mode + MODE_X]
    psi_r = p[mode + MODE_R]
    psi_t = p[mode + MODE_T]
    tilt = p[mode + MODE_TILT]
    da = va + n * spin * b
    db = vb - n * spin * a
    for j in range(lanes):
        c = own[at + j]
        s = own[at + _S + j]
        along = a * c + b * s
        across = n * (a * s - b * c)
        moving = da * c + db * s
        own[FR_X * _S + j] += psi_x * along
        own[FR_R * _S + j] += psi_r * along
        own[FR_GX * _S + j] -= psi_x * across
        own[FR_GR * _S + j] -= psi_r * across
        own[FR_VX * _S + j] += psi_x * moving
        own[FR_VR * _S + j] += psi_r * moving
        own[FR_VT * _S + j] += psi_t * (da * s - db * c)
        own[FR_TURN * _S + j] += tilt * moving


@kernel
def bend(p, lanes, race, spin, own):
    """Motion of the groove of one ring under each ball, into the rows of ``own``."""
    table = int(p[P_AT_MODES])
    q = FW_Q
    v = FW_V
    source = FR_COS * _S
    order = 1
    for i in range(FR_COS * _S):
        own[i] = 0.0
    for k in range(int(p[P_MODES])):
        mode = table + k * MODE_SIZE
        if int(p[mode + MODE_BODY]) == race:
            at = (FLEX_ROWS + 2 * k) * _S
            n = int(p[mode + MODE_ORDER])
            if n < order:
                source = FR_COS * _S
                order = 1
            raise_order(n - order, lanes, own, source, at)
            source = at
            order = n
            add_mode(
                p, mode, lanes, spin, own, at, own[q + 2 * k], own[q + 2 * k + 1], own[v + 2 * k],
                own[v + 2 * k + 1],
            )  # fmt: skip


@inlined
def move_groove(p, c, lanes, race, spin, w):
    """Shift by its flexure what ``relative_pose`` left of the balls' places and velocities against a ring.

    Leaves in the rows ``FR_GX`` and ``FR_GR`` the slope of the track and the ratio of the radii that
    :func:`lean` takes, in ``FR_VT`` the circumferential velocity.
    """
    own = w[W_FLEX:]
    pose = (W_POSE + race * POSE_ROWS) * _S
    first_order(lanes, race, w, own)
    bend(p, lanes, race, spin, own)
    groove_x = c[C_RACES + race * C_RACE_SIZE]
    groove_r = c[C_RACES + race * C_RACE_SIZE + 1]
    for j in range(lanes):
        axial = w[pose + X_A * _S + j] - own[FR_X * _S + j]
        before = w[pose + X_RHO * _S + j]
        rho = before - own[FR_R * _S + j]
        sx = axial - groove_x
        sr = rho - groove_r
        turn = own[FR_TURN * _S + j]
        # the section turns about the centre of the groove's circle
        vx = own[FR_VX * _S + j] - turn * sr
        vr = own[FR_VR * _S + j] + turn * sx
        slope = (sx * own[FR_GX * _S + j] + sr * own[FR_GR * _S + j]) / math.sqrt(sx * sx + sr * sr)
        own[FR_GX * _S + j] = -slope
        own[FR_GR * _S + j] = rho / before
        w[pose + X_A * _S + j] = axial
        w[pose + X_RHO * _S + j] = rho
        hx = w[pose + X_H * _S + j]
        hr = w[pose + (X_H + 1) * _S + j]
        ht = w[pose + (X_H + 2) * _S + j]
        w[pose + X_DV * _S + j] -= vx * w[pose + X_N * _S + j] + vr * hx
        w[pose + (X_DV + 1) * _S + j] -= vx * w[pose + (X_N + 1) * _S + j] + vr * hr
        w[pose + (X_DV + 2) * _S + j] -= vx * w[pose + (X_N + 2) * _S + j] + vr * ht
        w[pose + X_DW * _S + j] -= turn * w[pose + X_T * _S + j]
        w[pose + (X_DW + 1) * _S + j] -= turn * w[pose + (X_T + 1) * _S + j]
        w[pose + (X_DW + 2) * _S + j] -= turn * w[pose + (X_T + 2) * _S + j]


@inlined
def lean(p, lanes, race, w):
    """Add the flexed track's slope to the waviness'; both over the radius before the shift."""
    own = w[W_FLEX:]
    row = (W_RACE + race * RACE_ROWS) * _S
    for j in range(lanes):
        slope = w[row + R_SLOPE * _S + j] + own[FR_GX * _S + j]
        w[row + R_SLOPE * _S + j] = slope * own[FR_GR * _S + j]


@inlined
def slide(p, lanes, race, w):
    """Take the circumferential velocity of the groove from the sliding along the track."""
    own = w[W_FLEX:]
    row = (W_RACE + race * RACE_ROWS) * _S
    for j in range(lanes):
        w[row + R_UT * _S + j] -= own[FR_VT * _S + j]


@inlined
def groove_forces(p, c, lanes, race, w, own):
    """Gather forces and moment of the balls on one ring's groove into four rows; spare lanes put none."""
    balls = int(p[P_BALLS])
    pose = (W_POSE + race * POSE_ROWS) * _S
    force = (W_FORCE + race * 6) * _S
    row = (W_RACE + race * RACE_ROWS) * _S
    loss = (W_LOSS + race) * _S
    groove_x = c[C_RACES + race * C_RACE_SIZE]
    groove_r = c[C_RACES + race * C_RACE_SIZE + 1]
    for j in range(lanes):
        live = -1.0 if j < balls else 0.0
        fx = w[force + j]
        fr = w[force + _S + j]
        ft = w[force + 2 * _S + j]
        fn = (
            fx * w[pose + X_N * _S + j]
            + fr * w[pose + (X_N + 1) * _S + j]
            + ft * w[pose + (X_N + 2) * _S + j]
        )
        fh = (
            fx * w[pose + X_H * _S + j]
            + fr * w[pose + (X_H + 1) * _S + j]
            + ft * w[pose + (X_H + 2) * _S + j]
        )
        mt = (
            w[force + 3 * _S + j] * w[pose + X_T * _S + j]
            + w[force + 4 * _S + j] * w[pose + (X_T + 1) * _S + j]
            + w[force + 5 * _S + j] * w[pose + (X_T + 2) * _S + j]
        )
        sx = w[pose + X_A * _S + j] - groove_x
        sr = w[pose + X_RHO * _S + j] - groove_r
        drag = live * w[row + R_FT * _S + j]
        own[FR_X * _S + j] = live * fn
        own[FR_R * _S + j] = live * fh
        own[FR_GX * _S + j] = drag
        own[FR_GR * _S + j] = live * (mt + sx * fh - sr * fn)
        # the loss was taken from velocities without the groove's circumferential one
        w[loss + j] -= drag * own[FR_VT * _S + j]


@kernel
def row_sum(own, at, lanes):
    """Sum of one row over the lanes, in four partial sums of fixed order."""
    a = 0.0
    b = 0.0
    c = 0.0
    d = 0.0
    for k in range(lanes // 4):
        j = at + 4 * k
        a += own[j]
        b += own[j + 1]
        c += own[j + 2]
        d += own[j + 3]
    return (a + b) + (c + d)


@kernel
def mode_force(p, mode, lanes, own, at, turning):
    """Generalised forces (N) of the force rows on one mode's cosine and sine coordinate.

    ``turning``: 1 with the moment on the section, 0 without.
    """
    psi_x = p[mode + MODE_X]
    psi_r = p[mode + MODE_R]
    psi_t = p[mode + MODE_T]
    tilt = turning * p[mode + MODE_TILT]
    for j in range(lanes):
        c = own[at + j]
        s = own[at + _S + j]
        push = psi_x * own[FR_X * _S + j] + psi_r * own[FR_R * _S + j] + tilt * own[FR_GR * _S + j]
        drag = psi_t * own[FR_GX * _S + j]
        own[FR_VX * _S + j] = push * c + drag * s
        own[FR_VR * _S + j] = push * s - drag * c
    return row_sum(own, FR_VX * _S, lanes), row_sum(own, FR_VR * _S, lanes)


@inlined
def press_modes(p, c, lanes, race, w):
    """Generalised forces of the balls on the modes of one ring, from the forces in the rows of ``w``."""
    own = w[W_FLEX:]
    groove_forces(p, c, lanes, race, w, own)
    table = int(p[P_AT_MODES])
    out = FW_FORCE
    for k in range(int(p[P_MODES])):
        mode = table + k * MODE_SIZE
        if int(p[mode + MODE_BODY]) == race:
            cosine, sine = mode_force(p, mode, lanes, own, (FLEX_ROWS + 2 * k) * _S, 1.0)
            own[out + 2 * k] = cosine
            own[out + 2 * k + 1] = sine


@kernel
def flexure_equations(p, y, speed, speed_rate, w, f):
    """Accelerations of the coordinates from their forces; their damping heats the rings (rows of ``f``)."""
    own = w[W_FLEX:]
    table = int(p[P_AT_MODES])
    q = FW_Q
    v = FW_V
    force = FW_FORCE
    out = FW_A
    for k in range(int(p[P_MODES])):
        mode = table + k * MODE_SIZE
        inner = p[mode + MODE_BODY] == 0.0
        spin = speed if inner else y[Y_V + Q_OUTER + 3]
        rate = speed_rate if inner else f[F_G + Q_OUTER + 3]
        n = p[mode + MODE_ORDER]
        mass = p[mode + MODE_MASS]
        stiff = p[mode + MODE_STIFFNESS] / mass
        damping = p[mode + MODE_DAMPING]
        whirl = (n + 2.0 * p[mode + MODE_GYROSCOPIC]) * spin
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
        f[F_HEAT + (0 if inner else 1)] += damping * mass * (da * da + db * db)


@kernel
def flexure_energy(p, y, speed, w):
    """Kinetic and strain energy (J) of the modes, seats included, for the coordinates last evaluated."""
    own = w[W_FLEX:]
    table = int(p[P_AT_MODES])
    q = FW_Q
    v = FW_V
    total = 0.0
    for k in range(int(p[P_MODES])):
        mode = table + k * MODE_SIZE
        turn = p[mode + MODE_ORDER] * (speed if p[mode + MODE_BODY] == 0.0 else y[Y_V + Q_OUTER + 3])
        a = own[q + 2 * k]
        b = own[q + 2 * k + 1]
        da = own[v + 2 * k] + turn * b
        db = own[v + 2 * k + 1] - turn * a
        total += 0.5 * p[mode + MODE_MASS] * (da * da + db * db)
        total += 0.5 * p[mode + MODE_STIFFNESS] * (a * a + b * b)
    return total
