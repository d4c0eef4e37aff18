"""Jacobian of the accelerations, from how each contact's force follows motion (``contact_slopes``).

What a contact does depends on where the ball is and how fast it moves against one body. A body's own motion
is therefore minus the ball's, with the levers of a rigid body; where it tilts, everything turns with it. A
ball's accelerations depend on its own state and on the bodies', never on another ball's, but for springs
between balls (see ``springs``).

Left out is what ``contact_slopes`` names. By differences are the lands of the cage (``body_slopes``) and the
traction laws other than the regularised one (``traction_slopes``).
"""

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import (
    consecutive,
    load,
    plus_scaled,
    scaled_six,
    select,
    six,
    splat,
    store,
    store_six,
    sum_four,
)
from fmu_bearing.engine.layout import FOUR, STRIDE, A, C, F, J, K, P, Q, W, X, Y
from fmu_bearing.engine.mechanics.defects import has_defects
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.mechanics.triples import added, cross, dot, scaled, three
from fmu_bearing.engine.newton.body_slopes import body_slopes, cage_unbalance, inertia
from fmu_bearing.engine.newton.contact_slopes import (
    both,
    contact_columns,
    pocket_contact,
    product,
    race_contact,
)
from fmu_bearing.engine.newton.traction_slopes import clear_traction, traction_slopes


@kernel
def is_angle(i):
    """Whether body coordinate ``i`` is an angle."""
    inner = (i == Q.INNER + Q.INNER_BY) | (i == Q.INNER + Q.INNER_BZ)
    return inner | ((i >= Q.OUTER + Q.TURN) & (i < Q.CAGE)) | (i >= Q.CAGE + Q.TURN)


@kernel
def coordinate(body, i):
    """Place among the bodies' coordinates of a body's ``i``-th motion; -1: the inner ring's own rotation."""
    if body == 0:
        return i if i < Q.TURN else (-1 if i == Q.TURN else i - 1)
    return (Q.OUTER if body == 1 else Q.CAGE) + i


@kernel
def free_ball(p, y, j, w, jac):
    """Block B of balls without contacts: inertia in orbiting axes, weight, drag and gyroscopic moments."""
    for i in range(J.BALL * J.STATES):
        store(jac, J.B + i * STRIDE + j, 0.0)
    weight = GRAVITY if p[P.GRAVITY] != 0.0 else 0.0
    drag = p[P.DRAG_FACTOR] / p[P.BALL_MASS] if p[P.DRAG] != 0.0 else 0.0
    gyro = 1.0 if p[P.GYROSCOPIC] != 0.0 else 0.0
    om = load(y, Y.OM + j)
    radius = p[P.PITCH_RADIUS] + load(y, Y.R + j)
    per_radius = 1.0 / radius
    pull = 2.0 * drag * abs(radius * om)
    r = J.B + (F.R // STRIDE) * J.STATES * STRIDE + j
    store(jac, r + Y.R, om * om)
    store(jac, r + Y.TH, weight * load(w, W.SIN + j))
    store(jac, r + Y.OM, 2.0 * radius * om)
    orbit = J.B + (F.TH // STRIDE) * J.STATES * STRIDE + j
    store(jac, orbit + Y.R, -(load(w, W.F0 + F.TH + j) + pull * om) * per_radius)
    store(jac, orbit + Y.TH, weight * load(w, W.COS + j) * per_radius)
    store(jac, orbit + Y.VR, -2.0 * om * per_radius)
    store(jac, orbit + Y.OM, -2.0 * load(y, Y.VR + j) * per_radius - pull)
    spin_r = J.B + (F.WR // STRIDE) * J.STATES * STRIDE + j
    store(jac, spin_r + Y.OM, gyro * load(y, Y.WT + j))
    store(jac, spin_r + Y.WT, gyro * om)
    spin_t = J.B + (F.WT // STRIDE) * J.STATES * STRIDE + j
    store(jac, spin_t + Y.OM, -gyro * load(y, Y.WR + j))
    store(jac, spin_t + Y.WR, -gyro * om)


@kernel
def per_inertia(p, y, j):
    """Return what turns force along, force around and moment into the balls' accelerations."""
    per_mass = splat(1.0 / p[P.BALL_MASS])
    return per_mass, per_mass / (p[P.PITCH_RADIUS] + load(y, Y.R + j)), splat(1.0 / p[P.BALL_INERTIA])


@kernel
def as_accelerations(per, column):
    """Force and moment on the ball as accelerations of its six; ``per``: see :func:`per_inertia`."""
    fx, fr, ft, mx, mr, mt = column
    straight, around, turning = per
    return fx * straight, fr * straight, ft * around, mx * turning, mr * turning, mt * turning


@kernel
def reaction(body, column, j, w):
    """Change of forces and moments on the body along and about x, y, z; its own axis in place of x.

    ``column``: change of the force on the ball and of the moment, with what the lever's own change adds.
    """
    fx, fr, ft, mx, mr, mt = column
    pose = W.POSE + body * X.SIZE
    about = added(cross(three(w, pose + X.Q + j), (fx, fr, ft)), (mx, mr, mt))
    _, ar, at = about
    c = load(w, W.COS + j)
    s = load(w, W.SIN + j)
    spin = -dot(about, three(w, pose + X.N + j))
    return -fx, s * fr + c * ft, s * ft - c * fr, spin, s * ar + c * at, s * at - c * ar


@kernel
def add_arm(body, moved, column, j, w):
    """Add to a column the moment of the present force where the ball has ``moved`` against the body (m)."""
    fx, fr, ft, mx, mr, mt = column
    turning = cross(moved, three(w, W.FORCE + body * W.FORCE_SIZE + W.FX + j))
    return both((fx, fr, ft), added((mx, mr, mt), turning))


@kernel
def body_column(per, live, k, motion, column, reacting, j, w, jac):
    """Put the answer to a body's ``motion`` into column ``k`` of block C and the reaction into its sums.

    ``per``: see :func:`per_inertia`; ``live``: 0 for spare lanes, else 1.
    """
    store_six(jac, J.C + k * STRIDE + j, J.BODIES * STRIDE, as_accelerations(per, column))
    sums = W.CONTACT + K.SUMS + motion * A.SIX
    store_six(w, sums, FOUR, plus_scaled(six(w, sums, FOUR), live, reacting))


@kernel
def sum_reactions(body, w, jac):
    """Block E from the sums of one body's reactions to its own motions."""
    for motion in range(2 * K.MOTIONS):
        rate = motion // K.MOTIONS
        k = coordinate(body, motion - rate * K.MOTIONS)
        for i in range(K.MOTIONS):
            row = coordinate(body, i)
            if row >= 0 and k >= 0:
                total = sum_four(load(w, W.CONTACT + K.SUMS + motion * A.SIX + i * FOUR))
                jac[J.E + row * J.BODIES + k + rate * Q.SIZE] = total * w[W.CONTACT + K.PER_INERTIA + row]


@kernel
def direction(k, n, c, s):
    """Return the body's axis (k = 0), y or z in the balls' orbiting axes."""
    nx, nr, nt = n
    own = 1.0 if k == 0 else 0.0
    y = 1.0 if k == 1 else 0.0
    z = 1.0 if k == 2 else 0.0
    return own * nx, own * nr - y * s + z * c, own * nt - y * c - z * s


@kernel
def shift_columns(body, per, live, j, w, jac):
    """Put what a body does by its translation and velocity into blocks C and E."""
    at = W.CONTACT
    zero = splat(0.0)
    along_x = (splat(1.0), zero, zero)
    c = load(w, W.COS + j)
    s = load(w, W.SIN + j)
    for i in range(Q.TURN):
        k = coordinate(body, i)
        # the ball's motion against the body
        back = scaled(-1.0, direction(i, along_x, c, s))
        place = product(w, at + K.PLACE, back)
        reacting = reaction(body, add_arm(body, back, place, j, w), j, w)
        body_column(per, live, k, i, place, reacting, j, w, jac)
        rate = product(w, at + K.RATE, back)
        body_column(per, live, k + Q.SIZE, i + K.MOTIONS, rate, reaction(body, rate, j, w), j, w, jac)


@kernel
def turn_rate(d, q, arm, w):
    """Answer of force and moment to a body's angular velocity about ``d``.

    ``q``: the ball from the body's centre (m); ``arm``: entrainment speed by the ball's own spin (m), which
    the body's does not change.
    """
    at = W.CONTACT
    rate = plus_scaled(product(w, at + K.RATE, cross(q, d)), dot(arm, d), six(w, at + K.ENTRAINED, FOUR))
    return plus_scaled(rate, -1.0, product(w, at + K.SPIN, d))


@kernel
def turn_columns(y, body, turning, per, live, j, w, jac):
    """Put what a body does by its rotation and angular velocity into blocks C and E.

    The body's place turns about its centre: that is the ball's turning back, its velocity, spin, force and
    moment seen from the body. ``turning``: the body's spin (rad/s).
    """
    pose = W.POSE + body * X.SIZE
    force = W.FORCE + body * W.FORCE_SIZE
    at = W.CONTACT
    q = three(w, pose + X.Q + j)
    n = three(w, pose + X.N + j)
    h = three(w, pose + X.H + j)
    on_ball = three(w, force + W.FX + j)
    about_ball = three(w, force + W.MX + j)
    own = three(y, Y.WX + j)
    whole_turn = added(own, scaled(-1.0, three(w, pose + X.DW + j)))
    # the rate of the tilt itself is given in fixed axes and does not turn with the body
    tilting = added(whole_turn, scaled(-turning, n))
    v = added(three(w, pose + X.DV + j), cross(whole_turn, q))
    spin = added(own, scaled(-1.0, tilting))
    zero = splat(0.0)
    orbit = added((load(y, Y.OM + j), zero, zero), scaled(-1.0, tilting))
    arm = (load(w, at + K.ARM), load(w, at + K.ARM + FOUR), load(w, at + K.ARM + 2 * FOUR))
    whole = added(cross(q, on_ball), about_ball)
    hx, _, _ = h
    for i in range(K.MOTIONS - Q.TURN):
        motion = Q.TURN + i
        k = coordinate(body, motion)
        if k >= 0:
            d = direction(i, n, load(w, W.COS + j), load(w, W.SIN + j))
            rate = turn_rate(d, q, arm, w)
            reacting = reaction(body, rate, j, w)
            body_column(per, live, k + Q.SIZE, motion + K.MOTIONS, rate, reacting, j, w, jac)
            if i > 0:
                # a tilt leaves the angle about X from which the place along the body counts
                d = added(d, scaled(hx * dot(h, d), n))
            place = both(cross(d, on_ball), cross(d, about_ball))
            place = plus_scaled(place, 1.0, product(w, at + K.PLACE, cross(q, d)))
            against = added(cross(v, d), cross(cross(d, tilting), q))
            place = plus_scaled(place, 1.0, product(w, at + K.RATE, against))
            place = plus_scaled(place, 1.0, product(w, at + K.SPIN, cross(spin, d)))
            place = plus_scaled(place, dot(arm, cross(d, orbit)), six(w, at + K.ENTRAINED, FOUR))
            rx, ry, rz, spinning, mx, my = reaction(body, place, j, w)
            # the axis about which the body's own rotation is counted tilts, too
            spinning -= dot(whole, cross(d, n))
            body_column(per, live, k, motion, place, (rx, ry, rz, spinning, mx, my), j, w, jac)


@kernel
def ball_columns(p, y, body, per, live, j, w, jac):
    """Block D, and one body's share of B: from the columns of a contact to the ball's nine states.

    ``per``: see :func:`per_inertia`; ``live``: 0 for spare lanes, which follow ball 0 and put nothing on the
    bodies, else 1.
    """
    at = W.CONTACT
    zero = splat(0.0)
    om = load(y, Y.OM + j)
    radius = p[P.PITCH_RADIUS] + load(y, Y.R + j)
    vt = radius * om
    by_r = at + K.PLACE + A.SIX
    by_th = at + K.PLACE + 2 * A.SIX
    by_om = at + K.RATE + 2 * A.SIX
    onward = six(w, by_om, FOUR)
    # along the orbit the ball's velocity and spin turn with it
    turned = scaled_six(radius, six(w, by_th, FOUR))
    turned = plus_scaled(turned, 1.0, product(w, at + K.RATE, (zero, -vt, load(y, Y.VR + j))))
    turned = plus_scaled(turned, 1.0, product(w, at + K.SPIN, (zero, -load(y, Y.WT + j), load(y, Y.WR + j))))
    store_six(w, by_r, FOUR, plus_scaled(six(w, by_r, FOUR), om, onward))
    store_six(w, by_th, FOUR, turned)
    rolled = six(w, at + K.ENTRAINED, FOUR)
    store_six(w, by_om, FOUR, plus_scaled(scaled_six(radius, onward), -load(w, at + K.ARM), rolled))
    for k in range(J.STATES):
        column = six(w, at + K.PLACE + k * A.SIX, FOUR)
        if k < J.PLACED:
            along_t = radius * (1.0 if k == 2 else 0.0)
            moved = (splat(1.0 if k == 0 else 0.0), splat(1.0 if k == 1 else 0.0), along_t)
            column = add_arm(body, moved, column, j, w)
        store_six(w, at + K.REACTION, FOUR, reaction(body, column, j, w))
        for i in range(K.MOTIONS):
            row = coordinate(body, i)
            if row >= 0:
                share = live * w[at + K.PER_INERTIA + row]
                value = load(w, at + K.REACTION + i * FOUR) * share
                store(jac, J.D + (row * J.STATES + k) * STRIDE + j, value)
    # the axes of the ball's force turn with it, too
    force = W.FORCE + body * W.FORCE_SIZE
    _, fr, ft = three(w, force + W.FX + j)
    _, mr, mt = three(w, force + W.MX + j)
    store_six(w, by_th, FOUR, plus_scaled(turned, 1.0, (zero, ft, -fr, zero, mt, -mr)))
    for k in range(J.STATES):
        answer = as_accelerations(per, six(w, at + K.PLACE + k * A.SIX, FOUR))
        own = J.B + k * STRIDE + j
        so_far = six(jac, own, J.STATES * STRIDE)
        store_six(jac, own, J.STATES * STRIDE, plus_scaled(so_far, 1.0, answer))


@kernel
def without_cage(lanes, jac):
    """Zeros where a cage would answer and act."""
    for k in range(Q.CAGE, Q.SIZE):
        for j in range(0, lanes, FOUR):
            for i in range(J.BALL):
                row = J.C + (i * J.BODIES + k) * STRIDE + j
                store(jac, row, 0.0)
                store(jac, row + Q.SIZE * STRIDE, 0.0)
            for i in range(J.STATES):
                store(jac, J.D + (k * J.STATES + i) * STRIDE + j, 0.0)


@kernel
def clear(p, jac, w):
    """Begin a Jacobian: no sums in block E, and what the bodies' forces are divided by."""
    for i in range(Q.SIZE * J.BODIES):
        jac[J.E + i] = 0.0
    for i in range(Q.SIZE):
        # rigid preload: no force moves the inner ring along its axis
        fixed = i == Q.X and p[P.RIGID] != 0.0
        w[W.CONTACT + K.PER_INERTIA + i] = 0.0 if fixed else 1.0 / inertia(p, i)


@kernel
def jacobian(p, c, y, angle, speed, speed_rate, w, jac):
    """Fill the blocks B, C, D, E of ``jac`` at state ``y``, as ``layout.jacobian`` places them.

    The right-hand side there is at ``W.F0`` afterwards.
    """
    lanes = int(p[P.LANES])
    right_hand_side(p, c, y, angle, speed, speed_rate, w, w[W.F0 : W.F0 + F.SIZE])
    clear(p, jac, w)
    defective = has_defects(p, c)
    for j in range(0, lanes, FOUR):
        free_ball(p, y, j, w, jac)
    for body in range(2 if p[P.CAGE] == 0.0 else 3):
        turning = speed
        turned = angle
        clear_traction(w)
        if body < 2:
            traction_slopes(p, c, lanes, body, w)
        if body > 0:
            turning = y[Y.V0 + coordinate(body, Q.TURN)]
            turned = y[Y.Q0 + coordinate(body, Q.TURN)]
        for i in range(2 * K.MOTIONS * A.SIX):
            w[W.CONTACT + K.SUMS + i] = 0.0
        for j in range(0, lanes, FOUR):
            if body < 2:
                contact = race_contact(p, c, y, body, turned, j, w)
            else:
                contact = pocket_contact(p, c, y, turned, j, w)
            contact_columns(y, body, splat(c[C.BALL_RADIUS]), contact, defective and body < 2, j, w)
            per = per_inertia(p, y, j)
            live = select(consecutive(j) < p[P.BALLS], 1.0, 0.0)
            shift_columns(body, per, live, j, w, jac)
            turn_columns(y, body, turning, per, live, j, w, jac)
            ball_columns(p, y, body, per, live, j, w, jac)
        sum_reactions(body, w, jac)
    body_slopes(p, c, y, speed, jac)
    if p[P.CAGE] == 0.0:
        without_cage(lanes, jac)
    elif c[C.CAGE_ECCENTRICITY] != 0.0:
        cage_unbalance(p, c, y, lanes, w, jac)
