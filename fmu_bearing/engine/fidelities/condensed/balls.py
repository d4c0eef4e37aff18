"""Balls without modes of their own: each rests between the races, and the rings feel what it carries.

A ball's place (x, r) balances both contacts, the centrifugal force, its weight and the friction pair that
holds the gyroscopic moment. One Newton sweep for all balls at once also gives the forces on the rings at
the corrected place, to first order, so that a good guess needs no second sweep.

What they do beside that - inertia, slip, spin axes that lag behind - is linear and added to the rings'
accelerations by ``patterns``.

Contact damping. Fidelity `full` adds tau times the stiffness times the rate of approach to each contact. To
first order in tau that is the force at the approach advanced by tau times its rate. The direction of the
contact, and with it the stiffness across the track, is not advanced: nothing damps it. Two contacts in
series, with the same tau and no mass between them, are the series spring with that same tau, so a ball needs
no rate: what is found as its place is advanced along the contacts. So is waviness: height plus tau times its
rate as the ball rolls over it. The height tau later is not the same: at omega tau = 0.5 it is 11 % smaller.
"""

import math

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.fidelities.condensed.ball_form import add_ball_form
from fmu_bearing.engine.fidelities.condensed.defects import meet_defects, place_defects, push_ring
from fmu_bearing.engine.fidelities.condensed.rows import coordinate
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, select, store, sum_four, sum_lanes
from fmu_bearing.engine.layout import FOUR, STRIDE, C, F, L, P, Q, T, W, Y
from fmu_bearing.engine.mechanics.bodies import inner_ring, outer_ring
from fmu_bearing.engine.mechanics.contact import contact_axes, hertz, in_plane, race_surface
from fmu_bearing.engine.mechanics.pose import axis_cosine, ball_pose
from fmu_bearing.engine.mechanics.trigonometry import TWO_PI
from fmu_bearing.engine.mechanics.triples import store_three, three

# N/m: keeps a ball without contact from being thrown far. It goes with the loads: a sweep leaves a ball short
# of its rest by it, and the rings of loaded balls on a soft support would feel a spring to where these were.
_FLOOR = 1e3
_PER_LIGHT = 400.0  # 1/N2: a contact with 0.05 N halves it (chosen)
_LONGEST = 2e-6  # m: move of a ball in one sweep, about the approach of a loaded contact
# Sum over the balls of squared moves (m2) below which the first-order forces serve: 18 nm each, whose second
# order is 18 nm squared over four approaches of 1.5 um, or 5e-11 m of ring motion, at frequencies above those
# the rings answer to: on the gate scenes 1e-16 makes no smaller error.
_CLOSE = 4e-15
_SWEEPS = 30  # at most
_WHOLE = 10  # sweeps with whole steps: a ball that still finds no rest jumps to and fro, and takes half steps
_LAST = FOUR - 1  # of four lanes
_SOFT = 1e6  # N/m: moves count as if against this stiffness at most; loaded contacts have 1e8


@kernel
def set_angles(p, c, lv, theta, rolled, inner_angle, outer_angle, speed, w):
    """Put balls and races to their angles: cosines, sines, race heights (m).

    ``theta``: angle of ball 0; all are evenly spaced; ``rolled``: angle by which the balls have turned (rad).
    Heights contain half the ball's diameter deviation. ``speed``: of the shaft (rad/s); contact damping
    advances the balls by tau at it and adds tau times the heights' rates. At zero speed nothing is added.
    """
    lanes = int(p[P.LANES])
    tau = p[P.CONTACT_DAMPING]
    orbit = lv[L.RATIO] * speed
    c0 = math.cos(theta + tau * orbit)
    s0 = math.sin(theta + tau * orbit)
    scale = c[C.OVERSIZE_SCALE]
    for j in range(0, lanes, FOUR):
        co = load(lv, L.COS + j)
        si = load(lv, L.SIN + j)
        size = scale * load(lv, L.SIZES + j)
        store(w, T.COS + j, c0 * co - s0 * si)
        store(w, T.SIN + j, s0 * co + c0 * si)
        store(w, T.INNER + j, size)
        store(w, T.OUTER + j, size)
        store(w, T.FORM_SLOPE + j, 0.0)
        store(w, T.FORM_SLOPE_OUTER + j, 0.0)
    if p[P.DEFECTS] != 0.0:
        place_defects(p, c, lv, theta, rolled, inner_angle, outer_angle, speed, w)
    if scale == 0.0:
        return
    if p[P.BALL_WAVES] != 0.0:
        add_ball_form(p, c, lv, rolled, speed, w)
    if p[P.WAVINESS] == 0.0:
        return
    per_radian = p[P.WAVE_INTERVALS] / TWO_PI
    for race in range(2):
        start = (theta - (inner_angle if race == 0 else outer_angle)) * per_radian
        ahead = tau * (orbit - speed if race == 0 else orbit) * per_radian
        row = T.INNER + race * STRIDE
        for j in range(0, lanes, FOUR):
            height, rise, _ = race_surface(p, race, start + load(lv, L.PHI + j))
            store(w, row + j, load(w, row + j) + scale * (height + ahead * rise))


@kernel
def write_contacts(p, c, race, first, tilt, heights, row, q, w):
    """Write the contacts of all balls with one race into its rows from ``row`` on, see ``T.CONTACT``.

    ``first``, ``tilt``: coordinates of the ring's displacement and tilts in ``q``, and of their rates times
    tau in ``T.AHEAD``; ``heights``: row of the race's heights.
    """
    stiffness = p[P.RACES + race * P.RACE_SIZE + P.RACE_STIFFNESS]
    raceway = C.RACES + race * C.RACE_SIZE
    groove_x, groove_r, free = c[raceway + C.GROOVE_X], c[raceway + C.GROOVE_RADIUS], c[raceway + C.FREE]
    pitch = p[P.PITCH_RADIUS]
    ux, uy, uz, by, bz = q[first + Q.X], q[first + Q.Y], q[first + Q.Z], q[tilt], q[tilt + 1]
    v = T.AHEAD + first
    vx, vy, vz, dby, dbz = w[v + Q.X], w[v + Q.Y], w[v + Q.Z], w[T.AHEAD + tilt], w[T.AHEAD + tilt + 1]
    nx = axis_cosine(by, bz)
    for j in range(0, int(p[P.LANES]), FOUR):
        x = load(w, T.X + j)
        radius = pitch + load(w, T.R + j)
        co = load(w, T.COS + j)
        si = load(w, T.SIN + j)
        qx, qr, qt, nr, nt, axial, rho, hx, hr, ht = ball_pose(co, si, x, radius, ux, uy, uz, by, bz, nx)
        n, h = (nx, nr, nt), (hx, hr, ht)
        distance, per, sa, ca, e, m = contact_axes(axial - groove_x, rho - groove_r, n, h)
        ex, er, _ = e
        # the rate of approach; products of the ring's tilt and its rates along the track are left out
        leaving = ex * vx + er * (co * vz - si * vy) + (sa * qr - ca * axial) * (co * dby + si * dbz)
        approach = distance - free + load(w, heights + j) - leaving
        pressed, stiff, _ = hertz(stiffness, approach)
        at = row + j
        store_three(w, at + T.QX, (qx, qr, qt))
        store(w, at + T.LOAD, pressed)
        store(w, at + T.STIFF, stiff)
        store(w, at + T.ACROSS, pressed * per)
        store_three(w, at + T.EX, e)
        store_three(w, at + T.MX, m)
        store(w, at + T.APPROACH, approach)


@kernel
def loaded_share(load_i, load_o):
    """Return how far four balls with these loads (N) are loaded by both races, 0 to 1.

    A ball that is not has no place across the track of its own. Twice a smooth step goes from 0.07 at 1 N to
    0.97 at 3 N, for many a light ball together must not count as a loose one.
    """
    square_i, square_o = load_i * load_i, load_o * load_o
    share = square_i * square_o / ((square_i + 1.0) * (square_o + 1.0))
    share *= share * (3.0 - 2.0 * share)
    return share * share * (3.0 - 2.0 * share)


@kernel
def balance(p, lv, speed, part, w):
    """Move every ball by a ``part`` of a Newton step towards its rest, from the contacts in ``T.CONTACT``.

    Writes the moves ``T.DX``, ``T.DR`` and their squares, the new places, and those across the track,
    ``T.ASIDE``.
    """
    mass = p[P.BALL_MASS]
    softx = lv[L.SIDE]
    softr = lv[L.SIDE + 1]
    still = lv[L.SIDE_STILL]
    orbit = lv[L.RATIO] * speed
    pull = mass * orbit * orbit
    weight = GRAVITY * mass if p[P.GRAVITY] != 0.0 else 0.0
    held_i = lv[L.PAIR_INNER] * speed * speed
    held_o = lv[L.PAIR_OUTER] * speed * speed
    for j in range(0, int(p[P.LANES]), FOUR):
        i = T.CONTACT + j
        o = T.CONTACT_OUTER + j
        load_i, kn, kt = load(w, i + T.LOAD), load(w, i + T.STIFF), load(w, i + T.ACROSS)
        ex, er, mx, mr = load(w, i + T.EX), load(w, i + T.ER), load(w, i + T.MX), load(w, i + T.MR)
        load_o, kn2, kt2 = load(w, o + T.LOAD), load(w, o + T.STIFF), load(w, o + T.ACROSS)
        fx, fr, tx, tr = load(w, o + T.EX), load(w, o + T.ER), load(w, o + T.MX), load(w, o + T.MR)
        x = load(w, T.X + j)
        r = load(w, T.R + j)
        # a bump that lies aside turns the contact's direction
        pair_i = held_i + kt * load(w, T.FORM_SLOPE + j)
        pair_o = held_o + kt2 * load(w, T.FORM_SLOPE_OUTER + j)
        # net force on the ball and its stiffness
        netx = -load_i * ex - pair_i * mx - load_o * fx - pair_o * tx
        netr = -load_i * er - pair_i * mr - load_o * fr - pair_o * tr
        netr += pull * (p[P.PITCH_RADIUS] + r) - weight * load(w, T.COS + j)
        floor = _FLOOR / ((_PER_LIGHT * load_i * load_i + 1.0) * (_PER_LIGHT * load_o * load_o + 1.0))
        kxx, kxr, krr = in_plane(0.0, 0.0, 0.0, kn, kt, ex, er, mx, mr)
        kxx, kxr, krr = in_plane(kxx, kxr, krr, kn2, kt2, fx, fr, tx, tr)
        kxx += floor
        krr += floor
        per = 1.0 / (kxx * krr - kxr * kxr)
        dx = part * (netx * krr - netr * kxr) * per
        dr = part * (netr * kxx - netx * kxr) * per
        moved = dx * dx + dr * dr
        if not (sum_four(moved) <= _LONGEST * _LONGEST):
            share = min(1.0, _LONGEST / (math.sqrt(moved) + 1e-300))
            dx *= share
            dr *= share
            moved = dx * dx + dr * dr
        store(w, T.X + j, x + dx)
        store(w, T.R + j, r + dr)
        store(w, T.DX + j, dx)
        store(w, T.DR + j, dr)
        touched = load(lv, L.MASK + j) * loaded_share(load_i, load_o)
        store(w, T.LOADED + j, touched)
        store(w, T.ASIDE + j, touched * (softx * (x + dx) + softr * (r + dr) - still))
        # a ball that touches neither race goes towards one, but nothing waits for it
        touching = select(load_i + load_o > 0.0, load(lv, L.MASK + j), 0.0)
        # one that barely touches moves far for forces that nobody feels: 3e-8 m times _SOFT is 0.03 N
        felt = (netx * netx + netr * netr) * (1.0 / (_SOFT * _SOFT))
        store(w, T.MOVED + j, moved)
        store(w, T.STEP + j, touching * min(moved, felt))


@kernel
def forces_on_ring(lv, lanes, pair, lean, row, force, w):
    """Write forces and moments of the moved balls on one ring into its rows from ``force`` on.

    ``pair``: friction (N) across the track; ``lean``, ``row``: rows of the balls' slopes there and of the
    contacts with the ring.
    """
    for j in range(0, lanes, FOUR):
        at = row + j
        co = load(w, T.COS + j)
        si = load(w, T.SIN + j)
        dx = load(w, T.DX + j)
        dr = load(w, T.DR + j)
        mask = load(lv, L.MASK + j)
        ex, er, et = three(w, at + T.EX)
        mx, mr, mt = three(w, at + T.MX)
        qx, qr, qt = three(w, at + T.QX)
        qx, qr = qx + dx, qr + dr
        along = mask * (load(w, at + T.LOAD) + load(w, at + T.STIFF) * (ex * dx + er * dr))
        across = mask * (pair + load(w, at + T.ACROSS) * (load(w, lean + j) + (mx * dx + mr * dr)))
        fx = along * ex + across * mx
        fr = along * er + across * mr
        ft = along * et + across * mt
        gr = qt * fx - qx * ft
        gt = qx * fr - qr * fx
        into = force + j
        store(w, into + T.FX, fx)
        store(w, into + T.FY, -si * fr - co * ft)
        store(w, into + T.FZ, co * fr - si * ft)
        store(w, into + T.MY, -si * gr - co * gt)
        store(w, into + T.MZ, co * gr - si * gt)


@kernel
def sweep(p, c, lv, speed, part, q, w):
    """Move every ball by a ``part`` of a Newton step and write the forces on the rings, four balls at a time.

    ``q``: the rings' ``L.N`` displacements; their rates times tau are in ``T.AHEAD`` of ``w``, the balls'
    places in the rows ``T.X``, ``T.R``, which are moved; rows ``T.FORCE`` on take forces and moments,
    ``T.STEP`` the squares of the moves that matter, ``T.MOVED`` of all. Each loop is short: one ball's roots
    and divisions wait for each other, and the processor fills the time with the next balls only if it sees
    them.
    """
    lanes = int(p[P.LANES])
    write_contacts(p, c, 0, Q.INNER, Q.INNER_BY, T.INNER, T.CONTACT, q, w)
    write_contacts(p, c, 1, Q.OUTER, Q.OUTER + Q.BY, T.OUTER, T.CONTACT_OUTER, q, w)
    if p[P.DEFECTS] != 0.0:
        meet_defects(p, c, 0, T.INNER, T.CONTACT, w)
        meet_defects(p, c, 1, T.OUTER, T.CONTACT_OUTER, w)
    balance(p, lv, speed, part, w)
    forces_on_ring(lv, lanes, lv[L.PAIR_INNER] * speed * speed, T.FORM_SLOPE, T.CONTACT, T.FORCE, w)
    forces_on_ring(
        lv, lanes, lv[L.PAIR_OUTER] * speed * speed, T.FORM_SLOPE_OUTER, T.CONTACT_OUTER, T.FORCE_OUTER, w
    )
    if p[P.DEFECTS] != 0.0:
        push_ring(p, 0, T.CONTACT, T.FORCE, w)
        push_ring(p, 1, T.CONTACT_OUTER, T.FORCE_OUTER, w)


@kernel
def sum_forces(lanes, w, f):
    """Write the sums of the force rows over the lanes (spare ones hold zero) into the body rows of ``f``.

    Both rings at once, each from its first four lanes on: a third of the time that `sum_lanes` takes.
    """
    for i in range(Q.OUTER):
        a = T.FORCE + i * STRIDE
        b = T.FORCE_OUTER + i * STRIDE
        a0 = w[a]
        a1 = w[a + 1]
        a2 = w[a + 2]
        a3 = w[a + _LAST]
        b0 = w[b]
        b1 = w[b + 1]
        b2 = w[b + 2]
        b3 = w[b + _LAST]
        for j in range(FOUR, lanes, FOUR):
            a0 += w[a + j]
            a1 += w[a + j + 1]
            a2 += w[a + j + 2]
            a3 += w[a + j + _LAST]
            b0 += w[b + j]
            b1 += w[b + j + 1]
            b2 += w[b + j + 2]
            b3 += w[b + j + _LAST]
        f[F.BODY + i] = (a0 + a1) + (a2 + a3)
        f[F.BODY + coordinate(Q.OUTER + i)] = (b0 + b1) + (b2 + b3)


@kernel
def solve_balls(p, c, lv, speed, q, w):
    """Sweep until the first-order forces serve; False where the balls find no rest in bounded work."""
    lanes = int(p[P.LANES])
    for n in range(_SWEEPS):
        sweep(p, c, lv, speed, 1.0 if n < _WHOLE else 0.5, q, w)
        if sum_lanes(w, T.STEP, lanes) < _CLOSE:
            return True
    return False


@kernel
def count_settled(lv, lanes, w):
    """Count per ball the places in a row that are places of rest: only between those is there a rate."""
    for j in range(0, lanes, FOUR):
        resting = load(w, T.MOVED + j) < _CLOSE
        store(lv, L.SETTLED + j, select(resting, load(lv, L.SETTLED + j) + 1.0, 0.0))


@kernel
def accelerations(p, c, lv, angle, speed, speed_rate, q, w):
    """Accelerations of the rings at the trial state ``w[W.STAGE:]`` into ``w[W.F + F.BODY:]``; False if none.

    ``q``: scratch for ``L.COLUMN`` numbers. Balls, angles and race heights are in the trial rows of ``w``
    (:func:`set_angles`).
    """
    tau = p[P.CONTACT_DAMPING]
    for i in range(L.N):
        q[i] = w[W.STAGE + Y.Q0 + i]
        w[T.AHEAD + i] = tau * w[W.STAGE + Y.V0 + i]
    if not solve_balls(p, c, lv, speed, q, w):
        return False
    lanes = int(p[P.LANES])
    f = w[W.F : W.F + F.SIZE]
    for i in range(F.WORK, F.SIZE):
        f[i] = 0.0
    sum_forces(lanes, w, f)
    f[F.BODY + L.TURN] = lv[L.TWIST]
    y = w[W.STAGE : W.STAGE + Y.SIZE]
    inner_ring(p, c, y, angle, speed, speed_rate, f)
    outer_ring(p, c, y, f)
    return True
