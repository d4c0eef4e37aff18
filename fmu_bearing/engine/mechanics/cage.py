"""The cage: pockets that drive and retain the balls, and lands on either ring that carry it.

A cage guided by a ring has radial bores as pockets and two lands, short journal bearings: the inner ring runs
in the cage, or the cage in the outer ring. A cage guided by the balls has spherical pockets and no lands.
"""

import math

from fmu_bearing.engine.choices import BALL_GUIDED, OUTER_GUIDED
from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import consecutive, load, select, store
from fmu_bearing.engine.layout import FOUR, C, P, W, X
from fmu_bearing.engine.mechanics.contact import hertz
from fmu_bearing.engine.mechanics.trigonometry import TWO_PI, cosine_and_sine
from fmu_bearing.engine.mechanics.triples import added, cross, dot, scaled, store_three, three

# 1/s: a land's film turns its pressing side round where it moves by less than this share of its clearance
_CALM = 0.01
_NOWHERE = 1e-30  # m


@kernel
def pocket_axis(p, angle, turned, j, w):
    """Return unit vectors along four balls' pockets, outwards, in the balls' orbiting axes.

    ``angle``: of the balls, ``turned``: of the cage (rad). A pocket is fixed in the cage: its azimuth in the
    plane YZ is the cage's, and its axis runs across the cage's.
    """
    pose = W.POSE + 2 * X.SIZE
    number = consecutive(j)
    spacing = TWO_PI / p[P.BALLS]
    ahead = turned + select(number < p[P.BALLS], number, 0.0) * spacing - load(angle, j)
    co, si = cosine_and_sine(ahead)
    _, nr, nt = three(w, pose + X.N + j)
    # 1/nx and the root of 1 + lean^2 by their series for small tilts, 1e-16 up to 2 mrad
    small = 0.5 * (nr * nr + nt * nt)
    lean = -(nr * co + nt * si) * (1.0 + small * (1.0 + small))
    square = lean * lean
    per = 1.0 - square * (0.5 - 0.375 * square)
    return lean * per, co * per, si * per


@kernel
def in_bore(p, angle, turned, j, w):
    """Where four balls are in their bores: offsets from the bores' axes, and the bores' own directions.

    ``angle``: of the balls, ``turned``: of the cage (rad). Returns the offset along the cage's axis and
    around (m), its length, and the unit vectors along the bore and around, in the balls' orbiting axes.
    """
    pose = W.POSE + 2 * X.SIZE
    bore = pocket_axis(p, angle, turned, j, w)
    t = cross(three(w, pose + X.N + j), bore)
    axial = load(w, pose + X.A + j)
    around = dot(three(w, pose + X.Q + j), t)
    return axial, around, math.sqrt(axial * axial + around * around + 1e-30), bore, t


@kernel
def in_sphere(p, angle, turned, j, w):
    """Return offsets of four balls from the middles of their spherical pockets (m), and their lengths.

    As `in_bore`; the middles are on the cage's pitch circle.
    """
    pose = W.POSE + 2 * X.SIZE
    outwards = pocket_axis(p, angle, turned, j, w)
    offset = added(three(w, pose + X.Q + j), scaled(-p[P.PITCH_RADIUS], outwards))
    return offset, math.sqrt(dot(offset, offset) + 1e-30)


@kernel
def pocket_pressure(p, c, apart, rate):
    """Penetration (m), elastic force and force (N) of balls ``apart`` (m) from their pockets' middles.

    ``rate`` (m/s): of that distance. Hertz contact with Hunt-Crossley damping once the clearance is used up.
    """
    penetration = max(apart - p[P.POCKET_CLEARANCE], 0.0)
    elastic, _, _ = hertz(c[C.POCKET], penetration)
    return penetration, elastic, max(elastic * (1.0 + p[P.POCKET_DAMPING] * rate), 0.0)


@kernel
def pocket_friction(p, c, g, pressing, dv, dw):
    """Coulomb friction (regularised) of a pocket on the spinning ball, and its lever: force and moment.

    ``g``: unit vector from the ball's middle to the contact; ``dv``, ``dw``: velocity and spin of the ball
    against the cage.
    """
    floor = p[P.POCKET_SLIP]
    ball = c[C.BALL_RADIUS]
    # sliding at the contact without its normal part
    slip = added(dv, scaled(ball, cross(dw, g)))
    slip = added(slip, scaled(-dot(slip, g), g))
    drag = scaled(-p[P.POCKET_FRICTION] * pressing / math.sqrt(dot(slip, slip) + floor * floor), slip)
    return drag, scaled(ball, cross(g, drag))


@kernel
def store_pocket(p, penetration, force, moment, stored_rate, dv, dw, j, w):
    """Keep what four pockets do to their balls; ``stored_rate`` (W): what their contacts take up."""
    out = W.FORCE + 2 * W.FORCE_SIZE
    store(w, W.POCKET + j, penetration)
    store_three(w, out + W.FX + j, force)
    store_three(w, out + W.MX + j, moment)
    lost = -dot(force, dv) - dot(moment, dw) - stored_rate
    store(w, W.LOSS_CAGE + j, select(consecutive(j) < p[P.BALLS], lost, 0.0))


@kernel
def bore_forces(p, c, angle, lanes, turned, w):
    """As `pocket_forces`, of pockets that are radial bores."""
    pose = W.POSE + 2 * X.SIZE
    film = p[P.POCKET_FILM]
    for j in range(0, lanes, FOUR):
        n = three(w, pose + X.N + j)
        dv = three(w, pose + X.DV + j)
        dw = three(w, pose + X.DW + j)
        axial, around, apart, _, t = in_bore(p, angle, turned, j, w)
        px = axial / apart
        pt = around / apart
        vn = dot(n, dv)
        vt = dot(t, dv)
        rate = px * vn + pt * vt
        penetration, elastic, pressing = pocket_pressure(p, c, apart, rate)
        g = added(scaled(px, n), scaled(pt, t))
        drag, moment = pocket_friction(p, c, g, pressing, dv, dw)
        fn = -pressing * px - film * vn
        ft = -pressing * pt - film * vt
        force = added(added(drag, scaled(fn, n)), scaled(ft, t))
        store_pocket(p, penetration, force, moment, elastic * rate, dv, dw, j, w)


@kernel
def sphere_forces(p, c, angle, lanes, turned, w):
    """As `pocket_forces`, of pockets that are spheres."""
    pose = W.POSE + 2 * X.SIZE
    film = p[P.POCKET_FILM]
    for j in range(0, lanes, FOUR):
        dv = three(w, pose + X.DV + j)
        dw = three(w, pose + X.DW + j)
        offset, apart = in_sphere(p, angle, turned, j, w)
        g = scaled(1.0 / apart, offset)
        rate = dot(g, dv)
        penetration, elastic, pressing = pocket_pressure(p, c, apart, rate)
        drag, moment = pocket_friction(p, c, g, pressing, dv, dw)
        force = added(added(drag, scaled(-pressing, g)), scaled(-film, dv))
        store_pocket(p, penetration, force, moment, elastic * rate, dv, dw, j, w)


@kernel
def pocket_forces(p, c, angle, lanes, turned, w):
    """Pocket forces and moments on the balls and the power lost there.

    A pocket is a radial bore, or the sphere of a cage that the balls guide, with clearance: contact with
    friction once the clearance is used up, and film damping at all times. ``turned`` is the cage's angle
    (rad).
    """
    if p[P.GUIDANCE] == BALL_GUIDED:
        sphere_forces(p, c, angle, lanes, turned, w)
    else:
        bore_forces(p, c, angle, lanes, turned, w)


@kernel
def film_force(ratio, closing, carried):
    """Radial and tangential force of a short, cavitating journal film, over eta R L^3/c^2 (N s).

    Short bearing (Ocvirk 1952) with wedge and squeeze; pressure counts where it is positive. ``ratio`` is
    eccentricity over clearance (below 1), ``closing`` its rate (1/s), ``carried`` the journal's speed across
    the line of centres over the clearance, less half the sum of both surfaces' speeds times ``ratio`` (1/s).
    The journal is pushed back along the line of centres by the first and forward across it by the second.

    At an angle a from the thinnest place the pressure goes as (closing cos a + carried sin a)/(1 - ratio
    cos a)^3, positive over the half turn about its own direction (cosine ``k``, sine ``s``). Integrals over
    that half turn by Sommerfeld's substitution, whose variable passes through twice ``half`` there. The
    direction is rounded where nothing moves; elsewhere nothing is.
    """
    square = ratio * ratio
    root = math.sqrt(1.0 - square)
    per_gap = 1.0 / (1.0 - square)
    per_cube = per_gap * per_gap * root
    per_size = 1.0 / math.sqrt(closing * closing + carried * carried + _CALM * _CALM)
    k = closing * per_size
    s = carried * per_size
    flat = s * s * square
    per = 1.0 / (1.0 - flat)
    along = ratio * k * root
    half = 0.5 * PI + math.atan(along * per_gap)
    swing = along * (s * s - k * k - flat) * per * per
    cc = ((1.0 + 2.0 * square) * half + swing + 4.0 * along * per) * per_cube * per_gap
    cs = 2.0 * ratio * s * s * s * per * per
    ss = (half - swing) * per_cube
    return closing * cc + carried * cs, -(closing * cs + carried * ss)


@kernel
def land_contact(p, gap, dy, dz, vy, vz, journal, sleeve):
    """Force (N) on the sleeve in y and z at one land, friction torques (N m) and stored energy (J).

    ``gap``: viscosity (Pa s) and clearance (m); ``d`` and ``v`` are the sleeve centre's offset (m) and
    velocity (m/s) against the journal's at the land, ``journal`` and ``sleeve`` their spin rates (rad/s).
    Returns ``(fy, fz, torque on the journal, torque on the sleeve, energy, power lost)``.
    """
    viscosity, clearance = gap
    radius = p[P.LAND_RADIUS]
    length = p[P.LAND_LENGTH]
    limit = p[P.LAND_STOP_FRACTION] * clearance
    apart = math.sqrt(dy * dy + dz * dz)
    # in the very middle the film is the same all round: any direction serves
    per_apart = 1.0 / apart if apart > _NOWHERE else 0.0
    ey = dy * per_apart if apart > _NOWHERE else 1.0
    ez = dz * per_apart
    # beyond the dry stop the film keeps the thickness it has there
    wet = min(apart, limit)
    per_clearance = 1.0 / clearance
    ratio = wet * per_clearance
    rate = (ey * vy + ez * vz) * per_clearance
    across = ey * vz - ez * vy
    within = limit * per_apart if apart > limit else 1.0
    back, on = film_force(ratio, rate, within * across * per_clearance - 0.5 * (journal + sleeve) * ratio)
    factor = viscosity * radius * length * length * length * per_clearance * per_clearance
    radial = factor * back
    tangential = factor * on
    # Seen from the sleeve the journal is at -d. The film pushes it back and across, the sleeve takes the
    # opposite force.
    fy = -radial * ey - tangential * ez
    fz = -radial * ez + tangential * ey
    # The pair acts half-way between the centres, so that its moments balance as well.
    couple = 0.5 * (dy * fz - dz * fy)
    shear = TWO_PI * viscosity * radius * radius * radius * length * per_clearance
    shear *= (journal - sleeve) / math.sqrt(1.0 - ratio * ratio)
    penetration = max(apart - limit, 0.0)
    stiffness = p[P.LAND_STOP_STIFFNESS]
    stop = stiffness * penetration
    slip = p[P.LAND_STOP_SLIP]
    # Rubbing where the journal's surface meets the bore, a radius behind the journal's centre.
    rub = across + radius * journal - (radius + apart) * sleeve
    friction = -p[P.LAND_STOP_FRICTION] * stop * rub / math.sqrt(rub * rub + slip * slip)
    fy += -stop * ey - friction * ez
    fz += -stop * ez + friction * ey
    on_journal = -shear - couple + radius * friction
    on_sleeve = shear - couple - (radius + apart) * friction
    energy = 0.5 * stiffness * penetration * penetration
    lost = -(fy * vy + fz * vz + on_journal * journal + on_sleeve * sleeve) - stop * clearance * rate
    return fy, fz, on_journal, on_sleeve, energy, lost


@kernel
def guiding_land(p, gap, dy, dz, vy, vz, ring, cage):
    """As `land_contact`, of the ring that guides the cage: force on the cage, torques on ring and cage.

    ``d`` and ``v``: offset and velocity of the cage's centre against that ring's at the land, ``ring`` and
    ``cage`` their spin rates (rad/s). In an outer ring the cage is the journal.
    """
    outside = p[P.GUIDANCE] == OUTER_GUIDED
    # one call for both: its code is long
    side = -1.0 if outside else 1.0
    journal = cage if outside else ring
    sleeve = ring if outside else cage
    fy, fz, on_journal, on_sleeve, energy, lost = land_contact(
        p, gap, side * dy, side * dz, side * vy, side * vz, journal, sleeve
    )
    on_ring = on_sleeve if outside else on_journal
    on_cage = on_journal if outside else on_sleeve
    return side * fy, side * fz, on_ring, on_cage, energy, lost
