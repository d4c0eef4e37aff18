"""Balls without modes of their own: each rests between the races, and the rings feel what it carries.

A ball's place (x, r) balances both contacts, the centrifugal force, its weight and the friction pair that
holds the gyroscopic moment. One Newton sweep for all balls at once also gives the forces on the rings at
the corrected place, to first order, so that a good guess needs no second sweep.

The balls' inertia enters as far as they follow statically (Guyan 1965): what the rings' motion makes them do
is mass added to the rings (``linearised.added_mass``), what the waves make them do is a force here. The
turning of the orbit is neglected in both, some 0.1 of a term that is itself some 0.1 of the rings' mass.

Contact damping. Fidelity `full` adds tau times the stiffness times the rate of approach to each contact. Two
such elements in series, with the same tau and no mass between them, are the series spring with that same
tau: F = K (d + tau d'). To first order in tau this is the static force at displacements advanced by tau
times their rates, which is how the kernels below are called; waviness is advanced with its race.
"""

import math

import numpy as np

from fmu_bearing.engine.constants import GRAVITY, PI
from fmu_bearing.engine.dense import times
from fmu_bearing.engine.fidelities.condensed.rows import coordinate
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import sum_lanes
from fmu_bearing.engine.layout import FOUR, STRIDE, C, F, L, P, Q, T, W, Y
from fmu_bearing.engine.mechanics.bodies import inner_ring, outer_ring
from fmu_bearing.engine.mechanics.pose import axis_cosine, seen

_PER_RADIAN = P.WAVE_INTERVALS / (2.0 * PI)  # table intervals
_FLOOR = 1e3  # N/m: keeps a ball without contact from being thrown far; 1e-5 of a loaded contact
_LONGEST = 2e-6  # m: move of a ball in one sweep, about the approach of a loaded contact
# Sum over the balls of squared moves (m2) below which the first-order forces serve: 9 nm each, whose second
# order is 9 nm squared over four approaches of 1.5 um, or 1e-11 m of ring motion, 1e-4 of what it vibrates.
_CLOSE = 1e-15
_SWEEPS = 30  # at most
_LAST = FOUR - 1  # of four lanes
_SOFT = 1e6  # N/m: moves count as if against this stiffness at most; loaded contacts have 1e8


@kernel
def stand(p, c, lv, theta, inner_angle, outer_angle, speed, w):
    """Cosines and sines of the balls' angles, height (m) of both races under each ball, its acceleration.

    ``theta``: angle of ball 0; all are evenly spaced. Heights contain half the ball's diameter deviation;
    their second derivatives by time (m/s2) are those of the table's cubics at the ``speed`` of the shaft.
    """
    lanes = int(p[P.LANES])
    c0 = math.cos(theta)
    s0 = math.sin(theta)
    scale = c[C.OVERSIZE_SCALE]
    for j in range(lanes):
        co = lv[L.COS + j]
        si = lv[L.SIN + j]
        size = scale * lv[L.SIZES + j]
        w[T.COS + j] = c0 * co - s0 * si
        w[T.SIN + j] = s0 * co + c0 * si
        w[T.INNER + j] = size
        w[T.OUTER + j] = size
        w[T.BEND + j] = 0.0
        w[T.BEND_OUTER + j] = 0.0
    if p[P.WAVINESS] == 0.0 or scale == 0.0:
        return
    for race in range(2):
        table = int(p[P.AT_WAVES]) + race * 2 * P.WAVE_INTERVALS
        start = (theta - (inner_angle if race == 0 else outer_angle)) * _PER_RADIAN
        row = T.INNER + race * STRIDE
        bend = T.BEND + race * STRIDE
        rate = (lv[L.RATIO] - (1.0 if race == 0 else 0.0)) * speed * _PER_RADIAN
        scale2 = 2.0 * scale * rate * rate
        for j in range(lanes):
            place = start + lv[L.PHI + j]
            floor = math.floor(place)
            t = place - floor
            # 32-bit integers: conversion and gathered loads are then vector instructions
            whole = np.int32(floor)
            i0 = 2 * (whole & np.int32(P.WAVE_INTERVALS - 1))
            i1 = 2 * ((whole + np.int32(1)) & np.int32(P.WAVE_INTERVALS - 1))
            h0 = p[table + i0]
            g0 = p[table + i0 + 1]
            h1 = p[table + i1]
            g1 = p[table + i1 + 1]
            d = h1 - h0
            a = g0 + g1 - 2.0 * d
            b = 3.0 * d - 2.0 * g0 - g1
            w[row + j] += scale * (h0 + t * (g0 + t * (b + t * a)))
            w[bend + j] = scale2 * (b + 3.0 * t * a)


@kernel
def pressed_by(hertz, free, height, sx, sr):
    """Load (N), stiffness along and across (N/m), sine and cosine of the contact angle."""
    distance = math.sqrt(sx * sx + sr * sr)
    per = 1.0 / distance
    approach = max(distance - free + height, 0.0)
    root = math.sqrt(approach)
    load = hertz * root * approach
    return load, 1.5 * hertz * root, load * per, sx * per, sr * per


@kernel
def sweep(p, c, lv, speed, q, w):
    """Move every ball by one Newton step and write the forces on the rings; one vector loop.

    ``q``: the rings' ``L.N`` displacements (advanced by tau, see above); the balls' places stand in the rows
    ``T.X``, ``T.R`` of ``w`` and are moved; rows ``T.FORCE`` on take forces and moments, ``T.STEP`` the
    squares of the moves that matter, ``T.MOVED`` of all.
    """
    lanes = int(p[P.LANES])
    pitch = p[P.PITCH_RADIUS]
    ux, uy, uz, uby, ubz = q[Q.X], q[Q.Y], q[Q.Z], q[Q.INNER_BY], q[Q.INNER_BZ]
    o = Q.OUTER
    vx, vy, vz, vby, vbz = q[o + Q.X], q[o + Q.Y], q[o + Q.Z], q[o + Q.BY], q[o + Q.BZ]
    un = axis_cosine(uby, ubz)
    vn = axis_cosine(vby, vbz)
    hertz_i = p[P.RACES + P.RACE_STIFFNESS]
    hertz_o = p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS]
    one = C.RACES
    gx_i, gr_i, free_i = c[one + C.GROOVE_X], c[one + C.GROOVE_RADIUS], c[one + C.FREE]
    two = C.RACES + C.RACE_SIZE
    gx_o, gr_o, free_o = c[two + C.GROOVE_X], c[two + C.GROOVE_RADIUS], c[two + C.FREE]
    pair_i = lv[L.PAIR_INNER] * speed * speed
    pair_o = lv[L.PAIR_OUTER] * speed * speed
    orbit = lv[L.RATIO] * speed
    mass = p[P.BALL_MASS]
    pull = mass * orbit * orbit
    weight = GRAVITY * p[P.BALL_MASS] if p[P.GRAVITY] != 0.0 else 0.0
    for j in range(lanes):
        co = w[T.COS + j]
        si = w[T.SIN + j]
        x = w[T.X + j]
        r = w[T.R + j]
        radius = pitch + r
        qx, qr, qt, nr, nt, axial, rho, hx, hr, ht = seen(co, si, x, radius, ux, uy, uz, uby, ubz, un)
        load, kn, kt, sa, ca = pressed_by(hertz_i, free_i, w[T.INNER + j], axial - gx_i, rho - gr_i)
        ex, er, et = sa * un + ca * hx, sa * nr + ca * hr, sa * nt + ca * ht
        mx, mr, mt = ca * un - sa * hx, ca * nr - sa * hr, ca * nt - sa * ht
        px, pr, pt, lr, lt, axial2, rho2, kx, kr, k_t = seen(co, si, x, radius, vx, vy, vz, vby, vbz, vn)
        load2, kn2, kt2, sa2, ca2 = pressed_by(hertz_o, free_o, w[T.OUTER + j], axial2 - gx_o, rho2 - gr_o)
        fx, fr, ft = sa2 * vn + ca2 * kx, sa2 * lr + ca2 * kr, sa2 * lt + ca2 * k_t
        tx, tr, tt = ca2 * vn - sa2 * kx, ca2 * lr - sa2 * kr, ca2 * lt - sa2 * k_t
        # net force on the ball and its stiffness
        netx = -load * ex - pair_i * mx - load2 * fx - pair_o * tx
        netr = -load * er - pair_i * mr - load2 * fr - pair_o * tr + pull * radius - weight * co
        kxx = kn * ex * ex + kt * mx * mx + kn2 * fx * fx + kt2 * tx * tx + _FLOOR
        kxr = kn * ex * er + kt * mx * mr + kn2 * fx * fr + kt2 * tx * tr
        krr = kn * er * er + kt * mr * mr + kn2 * fr * fr + kt2 * tr * tr + _FLOOR
        per = 1.0 / (kxx * krr - kxr * kxr)
        # waves push the ball away from their race; the ball's inertia resists
        # (not where a contact carries less than about 1 N: with a jump there, balls would find no rest)
        pushed_i = kn * w[T.BEND + j] * (load * load / (load * load + 1.0))
        pushed_o = kn2 * w[T.BEND_OUTER + j] * (load2 * load2 / (load2 * load2 + 1.0))
        bx0 = pushed_i * ex + pushed_o * fx
        br0 = pushed_i * er + pushed_o * fr
        netx += mass * (bx0 * krr - br0 * kxr) * per
        netr += mass * (br0 * kxx - bx0 * kxr) * per
        dx = (netx * krr - netr * kxr) * per
        dr = (netr * kxx - netx * kxr) * per
        length = math.sqrt(dx * dx + dr * dr)
        share = min(1.0, _LONGEST / (length + 1e-300))
        dx *= share
        dr *= share
        w[T.X + j] = x + dx
        w[T.R + j] = r + dr
        mask = lv[L.MASK + j]
        # a ball that touches neither race goes towards one, but nothing waits for it
        touching = mask if load + load2 > 0.0 else 0.0
        # one that barely touches moves far for forces that nobody feels: 3e-8 m times _SOFT is 0.03 N
        felt = (netx * netx + netr * netr) * (1.0 / (_SOFT * _SOFT))
        w[T.MOVED + j] = dx * dx + dr * dr
        w[T.STEP + j] = touching * min(dx * dx + dr * dr, felt)
        # on the inner ring, at the moved ball
        along = load + kn * (ex * dx + er * dr)
        across = pair_i + kt * (mx * dx + mr * dr)
        ax = mask * (along * ex + across * mx)
        ar = mask * (along * er + across * mr)
        at = mask * (along * et + across * mt)
        gr = qt * ax - (qx + dx) * at
        gt = (qx + dx) * ar - (qr + dr) * ax
        w[T.FORCE + T.FX + j] = ax
        w[T.FORCE + T.FY + j] = -si * ar - co * at
        w[T.FORCE + T.FZ + j] = co * ar - si * at
        w[T.FORCE + T.MY + j] = -si * gr - co * gt
        w[T.FORCE + T.MZ + j] = co * gr - si * gt
        along2 = load2 + kn2 * (fx * dx + fr * dr)
        across2 = pair_o + kt2 * (tx * dx + tr * dr)
        bx = mask * (along2 * fx + across2 * tx)
        br = mask * (along2 * fr + across2 * tr)
        bt = mask * (along2 * ft + across2 * tt)
        hr2 = pt * bx - (px + dx) * bt
        ht2 = (px + dx) * br - (pr + dr) * bx
        w[T.FORCE_OUTER + T.FX + j] = bx
        w[T.FORCE_OUTER + T.FY + j] = -si * br - co * bt
        w[T.FORCE_OUTER + T.FZ + j] = co * br - si * bt
        w[T.FORCE_OUTER + T.MY + j] = -si * hr2 - co * ht2
        w[T.FORCE_OUTER + T.MZ + j] = co * hr2 - si * ht2


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
def carried(p, c, lv, speed, q, w):
    """Sweep until the first-order forces serve; False where the balls find no rest in bounded work."""
    lanes = int(p[P.LANES])
    for _ in range(_SWEEPS):
        sweep(p, c, lv, speed, q, w)
        if sum_lanes(w, T.STEP, lanes) < _CLOSE:
            return True
    return False


@kernel
def count_settled(lv, lanes, w):
    """Count per ball the places in a row that are places of rest: only between those is there a rate."""
    for j in range(lanes):
        resting = w[T.MOVED + j] < _CLOSE
        lv[L.SETTLED + j] = lv[L.SETTLED + j] + 1.0 if resting else 0.0


@kernel
def accelerations(p, c, lv, angle, speed, speed_rate, q, w):
    """Accelerations of the rings at the trial state ``w[W.STAGE:]`` into ``w[W.F + F.BODY:]``; False if none.

    ``q``: scratch for ``L.COLUMN`` numbers. Balls, angles and race heights stand in the trial rows of ``w``
    (:func:`stand`).
    """
    tau = p[P.CONTACT_DAMPING]
    for i in range(L.N):
        q[i] = w[W.STAGE + Y.Q0 + i] + tau * w[W.STAGE + Y.V0 + i]
    if not carried(p, c, lv, speed, q, w):
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
    times(lv, L.EXTRA, y, Y.V0, q, 0)
    for i in range(L.N):
        f[F.BODY + i] += q[i]
    return True
