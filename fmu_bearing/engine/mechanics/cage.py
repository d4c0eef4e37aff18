"""The cage: pockets that drive and retain the balls, and lands that ride on the inner ring."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import consecutive, load, select, store
from fmu_bearing.engine.layout import FOUR, C, P, W, X
from fmu_bearing.engine.mechanics.pose import bearing_angle
from fmu_bearing.engine.mechanics.trigonometry import TWO_PI, wrap
from fmu_bearing.engine.mechanics.triples import added, cross, dot, scaled, store_three, three


@kernel
def in_pocket(p, angle, turned, j, w):
    """Place of four balls from their pockets' middles: along the axis, along the track, and distance (m).

    ``angle``: of the balls, ``turned``: of the cage (rad).
    """
    pose = W.POSE + 2 * X.SIZE
    number = consecutive(j)
    _, hr, ht = three(w, pose + X.H + j)
    lead = load(angle, j) + bearing_angle(hr, ht)
    axial = load(w, pose + X.A + j)
    spacing = TWO_PI / p[P.BALLS]
    around = p[P.PITCH_RADIUS] * wrap(lead - turned - select(number < p[P.BALLS], number, 0.0) * spacing)
    return axial, around, math.sqrt(axial * axial + around * around + 1e-30)


@kernel
def pockets(p, c, angle, lanes, turned, w):
    """Pocket forces and moments on the balls and the power lost there.

    A pocket is a radial bore with clearance: Hertz contact with Hunt-Crossley damping once the clearance
    is used up, Coulomb friction (regularised) on the spinning ball, and film damping at all times.
    ``turned`` is the cage's angle (rad).
    """
    pose = W.POSE + 2 * X.SIZE
    out = W.FORCE + 2 * W.FORCE_SIZE
    pitch = p[P.PITCH_RADIUS]
    clearance = p[P.POCKET_CLEARANCE]
    stiffness = p[P.POCKET_STIFFNESS]
    damping = p[P.POCKET_DAMPING]
    film = p[P.POCKET_FILM]
    mu = p[P.POCKET_FRICTION]
    floor = p[P.POCKET_SLIP]
    ball = c[C.BALL_RADIUS]
    for j in range(0, lanes, FOUR):
        live = consecutive(j) < p[P.BALLS]
        n = three(w, pose + X.N + j)
        t = three(w, pose + X.T + j)
        dv = three(w, pose + X.DV + j)
        dw = three(w, pose + X.DW + j)
        axial, around, apart = in_pocket(p, angle, turned, j, w)
        px = axial / apart
        pt = around / apart
        lever = pitch / load(w, pose + X.RHO + j)
        push = max(apart - clearance, 0.0)
        vn = dot(n, dv)
        vt = dot(t, dv)
        rate = px * vn + pt * lever * vt
        elastic = stiffness * push * math.sqrt(push)
        pressing = max(elastic * (1.0 + damping * rate), 0.0)
        # contact point on the ball: radius along g; sliding there without its normal part
        g = added(scaled(px, n), scaled(pt, t))
        slip = added(dv, scaled(ball, cross(dw, g)))
        slip = added(slip, scaled(-dot(slip, g), g))
        drag = scaled(-mu * pressing / math.sqrt(dot(slip, slip) + floor * floor), slip)
        fn = -pressing * px - film * vn
        ft = -pressing * pt * lever - film * vt
        force = added(added(drag, scaled(fn, n)), scaled(ft, t))
        moment = scaled(ball, cross(g, drag))
        store(w, W.POCKET + j, push)
        store_three(w, out + W.FX + j, force)
        store_three(w, out + W.MX + j, moment)
        lost = -dot(force, dv) - dot(moment, dw) - elastic * rate
        store(w, W.LOSS_CAGE + j, select(live, lost, 0.0))


@kernel
def film_force(viscosity, radius, length, clearance, ratio, ratio_rate, wedge):
    """Radial and tangential force (N) of a short journal film, half-Sommerfeld (Ocvirk 1952; with squeeze).

    ``ratio`` is eccentricity over clearance (below 1), ``ratio_rate`` its rate (1/s), ``wedge`` the sum of
    both surfaces' speeds less twice the whirl speed (rad/s). The journal is pushed back along the line of
    centres by the first and across it, in the sense of ``wedge``, by the second.
    """
    gap = 1.0 - ratio * ratio
    root = math.sqrt(gap)
    factor = viscosity * radius * length * length * length / (clearance * clearance)
    # |wedge| rounded over 1 rad/s: the force stays smooth where the wedge changes sign
    size = math.sqrt(wedge * wedge + 1.0)
    radial = factor * (
        size * ratio * ratio / (gap * gap)
        + 0.5 * math.pi * ratio_rate * (1.0 + 2.0 * ratio * ratio) / (gap * gap * root)
    )
    tangential = factor * (
        0.25 * math.pi * wedge * ratio / (gap * root)
        + 2.0 * ratio * ratio_rate / (gap * gap) * (wedge / size)
    )
    return radial, tangential


@kernel
def land(p, dy, dz, vy, vz, journal, sleeve):
    """Force (N) on the cage in y and z at one land, friction torques (N m) and stored energy (J).

    ``d`` and ``v`` are the cage centre's offset (m) and velocity (m/s) against the inner ring's at the land,
    ``journal`` and ``sleeve`` the spin rates (rad/s) of inner ring and cage. Returns
    ``(fy, fz, torque on the inner ring, torque on the cage, energy, power lost)``.
    """
    clearance = p[P.LAND_CLEARANCE]
    radius = p[P.LAND_RADIUS]
    length = p[P.LAND_LENGTH]
    viscosity = p[P.LAND_VISCOSITY]
    limit = p[P.LAND_STOP_FRACTION] * clearance
    apart2 = dy * dy + dz * dz
    apart = math.sqrt(apart2 + 1e-24)
    ey = dy / apart
    ez = dz / apart
    # beyond the dry stop the film keeps the thickness it has there
    wet = min(apart, limit)
    ratio = wet / clearance
    rate = (ey * vy + ez * vz) / clearance
    across = ey * vz - ez * vy
    # the whirl of a nearly centred cage is undefined but harmless: its force vanishes with the offset
    whirl = across * apart / (apart2 + 1e-16)
    radial, tangential = film_force(
        viscosity, radius, length, clearance, ratio, rate, journal + sleeve - 2.0 * whirl
    )
    # Seen from the sleeve the journal is at -d. The film pushes it back and across, the cage takes the
    # opposite force.
    fy = -radial * ey - tangential * ez
    fz = -radial * ez + tangential * ey
    # The pair acts half-way between the centres, so that its moments balance as well.
    couple = 0.5 * (dy * fz - dz * fy)
    shear = TWO_PI * viscosity * radius * radius * radius * length / clearance
    shear *= (journal - sleeve) / math.sqrt(1.0 - ratio * ratio)
    push = max(apart - limit, 0.0)
    stiffness = p[P.LAND_STOP_STIFFNESS]
    stop = stiffness * push
    slip = p[P.LAND_STOP_SLIP]
    # Rubbing where the journal's surface meets the bore, a radius behind the inner ring's centre.
    rub = across + radius * journal - (radius + apart) * sleeve
    friction = -p[P.LAND_STOP_FRICTION] * stop * rub / math.sqrt(rub * rub + slip * slip)
    fy += -stop * ey - friction * ez
    fz += -stop * ez + friction * ey
    on_journal = -shear - couple + radius * friction
    on_sleeve = shear - couple - (radius + apart) * friction
    energy = 0.5 * stiffness * push * push
    lost = -(fy * vy + fz * vz + on_journal * journal + on_sleeve * sleeve) - stop * clearance * rate
    return fy, fz, on_journal, on_sleeve, energy, lost
