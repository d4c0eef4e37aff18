"""How force and moment on a ball change with its motion against one body, a race or a pocket.

Each contact has three axes: e along the normal, t and m across it. Moving the ball along e presses it in;
moving it across turns the whole contact: axes, velocities and force keep their components in axes that turn.
What load and traction answer to approach, sliding and spin is found in those axes and then turned into the
ball's own. Lanes are four balls from ``j`` on.
"""

import math

from fmu_bearing.engine.choices import BALL_GUIDED
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, plus_scaled, scaled_six, select, six, splat, store, store_six
from fmu_bearing.engine.layout import FOUR, STRIDE, A, C, K, P, R, W, X, Y
from fmu_bearing.engine.mechanics.ball_waves import has_wavy_balls
from fmu_bearing.engine.mechanics.cage import in_bore, in_sphere, pocket_axis
from fmu_bearing.engine.mechanics.contact import damped_slopes, hertz
from fmu_bearing.engine.mechanics.defects import has_defects
from fmu_bearing.engine.mechanics.race import waviness_under
from fmu_bearing.engine.mechanics.triples import added, along, cross, dot, scaled, three

# m^0.5: root of the approach; where a contact opens, the slope of its damping has no bound
_SHALLOWEST = 1e-5
_NEAREST = 1e-9  # m: a ball in the middle of its pocket touches nothing, whatever the direction


@kernel
def components(v, frame):
    """Components of a vector along three axes."""
    e, t, m = frame
    return dot(v, e), dot(v, t), dot(v, m)


@kernel
def product(w, first, x):
    """Three columns from ``first`` on times three numbers."""
    a0, a1, a2, a3, a4, a5 = six(w, first, FOUR)
    b0, b1, b2, b3, b4, b5 = six(w, first + A.SIX, FOUR)
    c0, c1, c2, c3, c4, c5 = six(w, first + 2 * A.SIX, FOUR)
    return (
        dot((a0, b0, c0), x),
        dot((a1, b1, c1), x),
        dot((a2, b2, c2), x),
        dot((a3, b3, c3), x),
        dot((a4, b4, c4), x),
        dot((a5, b5, c5), x),
    )


@kernel
def both(force, moment):
    """Force and moment as six numbers."""
    fx, fr, ft = force
    mx, mr, mt = moment
    return fx, fr, ft, mx, mr, mt


@kernel
def with_moment(w, column, j, ball):
    """Column of traction as force and moment on the ball, of radius ``ball``, in the contact's axes."""
    at = W.CONTACT + K.TRACTION + column * K.TRACTION_SIZE + j
    ft = load(w, at)
    fm = load(w, at + STRIDE)
    mn, mt, mm = three(w, at + 2 * STRIDE)
    return splat(0.0), ft, fm, mn, mt - ball * fm, mm + ball * ft


@kernel
def motion_columns(ball, gradient, bumps, stiffness, film, j, w):
    """Fill the columns of velocity, spin and entrainment; return the columns of load and approach.

    ``gradient`` of the approach by the ball's place; ``bumps``: slopes of the ball's own surface towards t
    and m; ``stiffness``: load by approach and by its rate, and logarithm of the ellipse by approach;
    ``film`` (N s/m): damping along e and m, and along t. ``ball``: its radius (m).
    """
    ge, gt, gm = gradient
    bump_t, bump_m = bumps
    by_approach, by_rate, growth = stiffness
    film_across, film_t = film
    at = W.CONTACT
    _, ft, fm, me, mt, mm = with_moment(w, K.LOAD, j, ball)
    loaded = (-ge, ft - gt, fm - gm, me, mt - bump_m, mm + bump_t)
    entrained = with_moment(w, K.ENTRAIN, j, ball)
    # half the sliding is taken from the entrainment speed
    slid = plus_scaled(with_moment(w, K.UT, j, ball), -0.5, entrained)
    across = with_moment(w, K.UM, j, ball)
    about_t = plus_scaled(with_moment(w, K.AT, j, ball), -ball, across)
    about_m = plus_scaled(with_moment(w, K.AM, j, ball), ball, slid)
    fe, ft, fm, me, mt, mm = scaled_six(by_rate * ge, loaded)
    store_six(w, at + K.RATE, FOUR, (fe - film_across, ft, fm, me, mt, mm))
    fe, ft, fm, me, mt, mm = plus_scaled(slid, by_rate * gt, loaded)
    store_six(w, at + K.RATE + A.SIX, FOUR, (fe, ft - film_t, fm, me, mt, mm))
    fe, ft, fm, me, mt, mm = plus_scaled(across, by_rate * gm, loaded)
    store_six(w, at + K.RATE + 2 * A.SIX, FOUR, (fe, ft, fm - film_across, me, mt, mm))
    store_six(w, at + K.SPIN, FOUR, with_moment(w, K.AN, j, ball))
    store_six(w, at + K.SPIN + A.SIX, FOUR, plus_scaled(about_t, by_rate * bump_m, loaded))
    store_six(w, at + K.SPIN + 2 * A.SIX, FOUR, plus_scaled(about_m, -by_rate * bump_t, loaded))
    store_six(w, at + K.ENTRAINED, FOUR, entrained)
    return loaded, plus_scaled(scaled_six(by_approach, loaded), growth, with_moment(w, K.HALF, j, ball))


@kernel
def bent_gradient(change, pressing, by_rate, v, loaded):
    """Answer to a ``change`` (1/m) of the approach's gradient: the load leans, the approach's rate differs.

    ``pressing``: load (N); ``v``: velocity against the body; ``loaded``: answer to the load; all in the
    contact's axes.
    """
    zero = splat(0.0)
    leaning = both(scaled(-pressing, change), (zero, zero, zero))
    return plus_scaled(leaning, by_rate * dot(change, v), loaded)


@kernel
def turned_contact(turn, ball, motion, w):
    """Change of force and moment where the contact turns by ``turn``; all in the contact's axes.

    ``motion``: velocity and spin against the body, own spin, force and moment.
    """
    v, spin, own, force, moment = motion
    at = W.CONTACT
    _, _, rolled = cross(turn, own)
    carried = both(cross(turn, force), cross(turn, moment))
    carried = plus_scaled(carried, -ball * rolled, six(w, at + K.ENTRAINED, FOUR))
    carried = plus_scaled(carried, -1.0, product(w, at + K.RATE, cross(turn, v)))
    return plus_scaled(carried, -1.0, product(w, at + K.SPIN, cross(turn, spin)))


@kernel
def place_column(i, along_axis, pressed, turned, tipped, material, w):
    """Fill the column of the ball's place along the contact's axis ``i``.

    ``along_axis``: approach, turn about the body's axis and turn about -t by that place, of which the
    answers are ``pressed``, ``turned`` and ``tipped``; ``material``: velocity of the body's material under
    the ball by that place.
    """
    approach, around, over = along_axis
    column = plus_scaled(scaled_six(approach, pressed), around, turned)
    column = plus_scaled(column, over, tipped)
    column = plus_scaled(column, -1.0, product(w, W.CONTACT + K.RATE, material))
    store_six(w, W.CONTACT + K.PLACE + i * A.SIX, FOUR, column)


@kernel
def place_columns(y, body, ball, frame, gradient, pressed, bent, about, around, over, j, w):
    """Fill the columns of the ball's place, the body's motion and the ball's velocity held.

    ``pressed``: answer to the approach; ``about``: the body's axis in the contact's axes; ``around``,
    ``over``: turns about it and about -t, in rad per m along each of the three axes; ``bent``: answer to the
    gradient's own change along t, see :func:`bent_gradient`.
    """
    pose = W.POSE + body * X.SIZE
    force = W.FORCE + body * W.FORCE_SIZE
    dw = three(w, pose + X.DW + j)
    spin = three(y, Y.WX + j)
    wx, wr, wt = spin
    motion = (
        components(three(w, pose + X.DV + j), frame),
        components(dw, frame),
        components((wx - load(y, Y.OM + j), wr, wt), frame),
        components(three(w, force + W.FX + j), frame),
        components(three(w, force + W.MX + j), frame),
    )
    bx, br, bt = components(added(spin, scaled(-1.0, dw)), frame)
    turned = turned_contact(about, ball, motion, w)
    zero = splat(0.0)
    tipped = turned_contact((zero, splat(-1.0), zero), ball, motion, w)
    ge, gt, gm = gradient
    ae, at, am = around
    oe, ot, om = over
    # the body's material moves under a ball that goes along an axis: the body's spin times that axis
    place_column(0, (ge, ae, oe), pressed, turned, tipped, (zero, bt, -br), w)
    place_column(1, (gt, at, ot), pressed, turned, tipped, (-bt, zero, bx), w)
    along_t = W.CONTACT + K.PLACE + A.SIX
    store_six(w, along_t, FOUR, plus_scaled(six(w, along_t, FOUR), 1.0, bent))
    place_column(2, (gm, am, om), pressed, turned, tipped, (br, -bx, zero), w)


@kernel
def into_ball_axes(frame, w):
    """Turn all columns from the contact's axes into the ball's."""
    e, t, m = frame
    for i in range(K.COLUMNS):
        at = W.CONTACT + K.PLACE + i * A.SIX
        fe, ft, fm, me, mt, mm = six(w, at, FOUR)
        store_six(w, at, FOUR, both(along(fe, e, ft, t, fm, m), along(me, e, mt, t, mm, m)))
    ex, er, et = e
    tx, tr, tt = t
    mx, mr, mt = m
    for first in (K.PLACE, K.RATE, K.SPIN):
        at = W.CONTACT + first
        x = product(w, at, (ex, tx, mx))
        r = product(w, at, (er, tr, mr))
        theta = product(w, at, (et, tt, mt))
        store_six(w, at, FOUR, x)
        store_six(w, at + A.SIX, FOUR, r)
        store_six(w, at + 2 * A.SIX, FOUR, theta)


@kernel
def own_spin(arm, w):
    """Add to the columns of spin what the ball's own does through entrainment; ``arm``: by how much (m)."""
    entrained = six(w, W.CONTACT + K.ENTRAINED, FOUR)
    x, r, theta = arm
    at = W.CONTACT + K.SPIN
    store_six(w, at, FOUR, plus_scaled(six(w, at, FOUR), x, entrained))
    store_six(w, at + A.SIX, FOUR, plus_scaled(six(w, at + A.SIX, FOUR), r, entrained))
    store_six(w, at + 2 * A.SIX, FOUR, plus_scaled(six(w, at + 2 * A.SIX, FOUR), theta, entrained))
    store(w, W.CONTACT + K.ARM, x)
    store(w, W.CONTACT + K.ARM + FOUR, r)
    store(w, W.CONTACT + K.ARM + 2 * FOUR, theta)


@kernel
def deepen_columns(ball, deeper, pressing, bent, j, w):
    """Add what a defect's second derivatives do to the columns of the ball's place along e and t.

    ``deeper``: change (1/m) of the approach's gradient along e, the answer to which is ``bent``; the load
    that goes with it, along both, brings its traction.
    """
    by_e, by_t, _ = deeper
    with_load = with_moment(w, K.LOAD, j, ball)
    along_e = W.CONTACT + K.PLACE
    along_t = along_e + A.SIX
    column = plus_scaled(six(w, along_e, FOUR), 1.0, bent)
    store_six(w, along_e, FOUR, plus_scaled(column, pressing * by_e, with_load))
    store_six(w, along_t, FOUR, plus_scaled(six(w, along_t, FOUR), pressing * by_t, with_load))


@kernel
def contact_columns(y, body, ball, contact, defective, j, w):
    """Fill all columns of a contact, in the ball's axes; the columns of traction are there.

    ``ball``: its radius (m); ``contact``: as :func:`race_contact` and :func:`pocket_contact` give it. That
    is its axes; the gradient of the approach by the ball's place, and the ball's own slopes towards t and m;
    load by approach, load by its rate and logarithm of the ellipse by approach; load, and damping of a film
    along e and m and along t; the axis of one turn, of a race the body's; turns about it and about -t, by
    places along the three axes; change of the gradient along e, only over ``defective`` races, and along t;
    entrainment speed by the ball's spin.
    """
    frame, gradient, bumps, stiffness, pressing, film, about, around, over, deeper, change, arm = contact
    loaded, pressed = motion_columns(ball, gradient, bumps, stiffness, film, j, w)
    _, by_rate, _ = stiffness
    v = components(three(w, W.POSE + body * X.SIZE + X.DV + j), frame)
    bent = bent_gradient(change, pressing, by_rate, v, loaded)
    place_columns(y, body, ball, frame, gradient, pressed, bent, about, around, over, j, w)
    if defective:
        deepen_columns(ball, deeper, pressing, bent_gradient(deeper, pressing, by_rate, v, loaded), j, w)
    into_ball_axes(frame, w)
    own_spin(arm, w)


@kernel
def race_contact(p, c, y, race, turned, j, w):
    """Return what :func:`contact_columns` needs of the contact with one race, turned by ``turned`` (rad).

    Left out: the change of a flexed groove's place and of a wavy ball's slope with the ball's own place, and
    that a flexed groove's slope does not turn with its ring; at most 4e-4 of the largest entries.
    """
    row = W.RACE + race * R.SIZE
    pose = W.POSE + race * X.SIZE
    ball = c[C.BALL_RADIUS]
    m = three(w, row + R.EM + j)
    frame = (three(w, row + R.EN + j), three(w, pose + X.T + j), m)
    sina = load(w, row + R.SINA + j)
    cosa = load(w, row + R.COSA + j)
    rho = load(w, pose + X.RHO + j)
    per_distance = load(w, row + R.PER_GROOVE + j)
    per_rho = 1.0 / rho
    root = math.sqrt(max(load(w, row + R.APPROACH + j), 0.0))
    per_root = 1.0 / max(root, _SHALLOWEST)
    touching = load(w, row + R.LOAD + j) > 0.0
    defective = has_defects(p, c)
    rate = load(w, row + R.RATE + j)
    if defective:
        rate = rate * load(w, row + R.GAIN + j)
    by_approach, by_rate = damped_slopes(
        p[P.RACES + race * P.RACE_SIZE + P.RACE_STIFFNESS], 1.5 * p[P.CONTACT_DAMPING], root, per_root, rate
    )
    growth = 0.5 * per_root * per_root
    zero = splat(0.0)
    deeper = (zero, zero, zero)
    bend = zero
    if defective:
        gain = load(w, row + R.GAIN + j)
        by_approach = gain * gain * by_approach
        by_rate = gain * gain * by_rate
        growth = gain * growth
        turning = load(w, row + R.BEND_T + j) / gain
        deeper = (load(w, row + R.BEND_N + j) / gain, turning, zero)
        bend = load(w, row + R.BEND_TT + j) / gain
    stiffness = (select(touching, by_approach, 0.0), select(touching, by_rate, 0.0), growth)
    lean = load(w, row + R.SLOPE + j) * per_rho
    tip = zero
    bump_t = zero
    bump_m = zero
    if has_wavy_balls(p, c) or defective and p[P.BALL_DEFECTS] != 0.0:
        bump_t = load(w, row + R.BUMP_T + j)
        bump_m = load(w, row + R.BUMP_M + j)
        lean += bump_t * cosa * per_rho
        tip = bump_m * per_distance
    curvature = zero
    if p[P.WAVINESS] != 0.0:
        _, _, curvature = waviness_under(p, c, y[Y.TH : Y.TH + STRIDE], race, turned, j, w)
    _, along, _ = deeper
    change = (zero, curvature * per_rho * per_rho, zero)
    if defective:
        change = (along, curvature * per_rho * per_rho + bend, zero)
    return (
        frame,
        (splat(1.0), lean, tip),
        (bump_t, bump_m),
        stiffness,
        load(w, row + R.LOAD + j),
        (zero, zero),
        (sina, zero, cosa),
        (zero, per_rho, zero),
        (zero, zero, per_distance),
        deeper,
        change,
        scaled(ball, m),
    )


@kernel
def pocket_traction(p, pressing, ut, um, j, w):
    """Columns of the friction in a pocket: one point of contact, the law of ``cage.pocket_forces``."""
    floor = p[P.POCKET_SLIP]
    per_square = 1.0 / (ut * ut + um * um + floor * floor)
    share = -p[P.POCKET_FRICTION] * math.sqrt(per_square)
    pull = share * pressing
    at = W.CONTACT + K.TRACTION + j
    by_um = at + K.UM * K.TRACTION_SIZE
    by_load = at + K.LOAD * K.TRACTION_SIZE
    store(w, at, pull * (1.0 - ut * ut * per_square))
    store(w, at + STRIDE, -pull * ut * um * per_square)
    store(w, by_um, -pull * ut * um * per_square)
    store(w, by_um + STRIDE, pull * (1.0 - um * um * per_square))
    store(w, by_load, share * ut)
    store(w, by_load + STRIDE, share * um)


@kernel
def bore_axes(p, y, turned, j, w):
    """Axes of the contact with a bore, and how far the ball is from the bore's axis (m); t is along it."""
    n = three(w, W.POSE + 2 * X.SIZE + X.N + j)
    axial, along_track, apart, bore, t = in_bore(p, y[Y.TH : Y.TH + STRIDE], turned, j, w)
    px = axial / apart
    pt = along_track / apart
    return (added(scaled(px, n), scaled(pt, t)), bore, added(scaled(px, t), scaled(-pt, n))), apart


@kernel
def sphere_axes(p, y, turned, j, w):
    """Axes of the contact with a sphere, and how far the ball is from its middle (m).

    t and m are any two across e that make a right-handed frame. The one made of the pocket's axis fails where
    the ball is off along that axis, and the one made of the cage's where it is off along this: whichever is
    farther from e is taken.
    """
    offset, apart = in_sphere(p, y[Y.TH : Y.TH + STRIDE], turned, j, w)
    e = scaled(1.0 / apart, offset)
    n = three(w, W.POSE + 2 * X.SIZE + X.N + j)
    bx, br, bt = pocket_axis(p, y[Y.TH : Y.TH + STRIDE], turned, j, w)
    nx, nr, nt = n
    steep = abs(dot(e, (bx, br, bt))) > abs(dot(e, n))
    other = (select(steep, nx, bx), select(steep, nr, br), select(steep, nt, bt))
    t = added(other, scaled(-dot(other, e), e))
    t = scaled(1.0 / math.sqrt(dot(t, t)), t)
    return (e, t, cross(e, t)), apart


@kernel
def pocket_contact(p, c, y, turned, j, w):
    """Return what :func:`contact_columns` needs of the contact with a pocket, turned by ``turned`` (rad).

    The columns of its friction are filled here.
    """
    pose = W.POSE + 2 * X.SIZE
    ball = c[C.BALL_RADIUS]
    spherical = p[P.GUIDANCE] == BALL_GUIDED
    if spherical:
        frame, apart = sphere_axes(p, y, turned, j, w)
    else:
        frame, apart = bore_axes(p, y, turned, j, w)
    per_apart = 1.0 / max(apart, _NEAREST)
    ve, vt, vm = components(three(w, pose + X.DV + j), frame)
    _, wt, wm = components(three(w, pose + X.DW + j), frame)
    elastic, slope, _ = hertz(c[C.POCKET], apart - p[P.POCKET_CLEARANCE])
    damped = 1.0 + p[P.POCKET_DAMPING] * ve
    touching = damped > 0.0
    pressing = max(elastic * damped, 0.0)
    zero = splat(0.0)
    stiffness = (
        select(touching, slope * damped, 0.0),
        select(touching, elastic * p[P.POCKET_DAMPING], 0.0),
        zero,
    )
    pocket_traction(p, pressing, vt + ball * wm, vm - ball * wt, j, w)
    nothing = (zero, zero, zero)
    # a bore is fixed in the cage: the contact turns only as the ball goes round the bore's axis, t; in a
    # sphere it turns about m, too, as the ball goes along t, and the film is the same all round
    sphere = 1.0 if spherical else 0.0
    return (
        frame,
        (splat(1.0), zero, zero),
        (zero, zero),
        stiffness,
        pressing,
        (splat(p[P.POCKET_FILM]), splat(sphere * p[P.POCKET_FILM])),
        (zero, zero, splat(sphere)),
        (zero, sphere * per_apart, zero),
        (zero, zero, per_apart),
        nothing,
        nothing,
        nothing,
    )
