"""Stiffness of the contacts of one ball in series, on its own and as part of the bearing's 5 x 5 matrix.

The ball is massless and free in its axial plane; centrifugal and friction forces are held.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, P
from fmu_bearing.engine.statics.ball_balance import seat


@kernel
def contact(p, c, race, sx, sr):
    """Load (N), sine and cosine of the contact angle, approach (m) and distance for a ball in one race.

    ``sx``, ``sr``: the ball's centre from the race's groove centre, axial and radial (m).
    """
    distance = math.sqrt(sx * sx + sr * sr)
    approach = max(distance - c[C.RACES + race * C.RACE_SIZE + 2], 0.0)
    load = p[P.RACES + race * P.RACE_SIZE + P.RACE_STIFFNESS] * approach * math.sqrt(approach)
    return load, sx / distance, sr / distance, approach, distance


@kernel
def contact_stiffness(hertz, load, approach, distance, sine, cosine):
    """In-plane stiffness (N/m) of one contact: xx, xr, rr, with the turning of the load's direction."""
    kn = 1.5 * hertz * math.sqrt(approach)
    kt = load / distance
    return (
        kn * sine * sine + kt * cosine * cosine,
        (kn - kt) * sine * cosine,
        kn * cosine * cosine + kt * sine * sine,
    )


@kernel
def series_stiffness(p, c, x_i, r_i, x_o, r_o):
    """In-plane stiffness (xx, xr, rr in N/m) of inner and outer contact in series, ball massless.

    ``x``, ``r``: the ball's centre from each groove centre (m). Zero when a contact is open.
    """
    qi, si, ci, di, li = contact(p, c, 0, x_i, r_i)
    qo, so, co, do, lo = contact(p, c, 1, x_o, r_o)
    if qi <= 0.0 or qo <= 0.0:
        return 0.0, 0.0, 0.0
    ixx, ixr, irr = contact_stiffness(p[P.RACES + P.RACE_STIFFNESS], qi, di, li, si, ci)
    oxx, oxr, orr = contact_stiffness(p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS], qo, do, lo, so, co)
    sxx = ixx + oxx
    sxr = ixr + oxr
    srr = irr + orr
    det = sxx * srr - sxr * sxr
    # K = K_i - K_i (K_i + K_o)^-1 K_i
    axx = (srr * ixx - sxr * ixr) / det
    axr = (srr * ixr - sxr * irr) / det
    arx = (-sxr * ixx + sxx * ixr) / det
    arr = (-sxr * ixr + sxx * irr) / det
    return (
        ixx - (ixx * axx + ixr * arx),
        ixr - (ixx * axr + ixr * arr),
        irr - (ixr * axr + irr * arr),
    )


@kernel
def contact_tensor(load, kn, distance, rho, ex, er, et, mx, mr, mt, cosine):
    """Stiffness of one contact (N/m) as six numbers xx, xr, xt, rr, rt, tt: kn ee + Q/d mm + Q cos/rho tt."""
    kt = load / distance
    kc = load * cosine / rho
    tx = er * mt - et * mr
    tr = et * mx - ex * mt
    tt = ex * mr - er * mx
    return (
        kn * ex * ex + kt * mx * mx + kc * tx * tx,
        kn * ex * er + kt * mx * mr + kc * tx * tr,
        kn * ex * et + kt * mx * mt + kc * tx * tt,
        kn * er * er + kt * mr * mr + kc * tr * tr,
        kn * er * et + kt * mr * mt + kc * tr * tt,
        kn * et * et + kt * mt * mt + kc * tt * tt,
    )


@kernel
def ball_share(p, c, pose, x, r, a):
    """Stiffness of the inner ring through one ball into ``a[:25]``, the ball's own motion into ``a[25:35]``.

    Both in the ball's axes: rows force x, r, theta and moment r, theta; columns displacements x, r, theta
    and tilts r, theta. ``pose``: see ``ball_balance``; ``x``, ``r``: the ball's place (m).
    """
    for i in range(35):
        a[i] = 0.0
    radius = p[P.PITCH_RADIUS] + r
    qx = x - pose[0]
    qr = radius - pose[1]
    qt = -pose[2]
    load, kn, distance, rho, ex, er, et, mx, mr, mt, cosine = seat(
        p, c, 0, pose[9], qx, qr, qt, pose[3], pose[4], pose[5]
    )
    if load <= 0.0:
        return
    fx = -load * ex
    fr = -load * er
    ft = -load * et
    xx, xr, xt, rr, rt, tt = contact_tensor(load, kn, distance, rho, ex, er, et, mx, mr, mt, cosine)
    load, kn, distance, rho, ex, er, et, mx, mr, mt, cosine = seat(
        p, c, 1, pose[10], x, radius, 0.0, pose[6], pose[7], pose[8]
    )
    oxx, oxr, _, orr, _, _ = contact_tensor(load, kn, distance, rho, ex, er, et, mx, mr, mt, cosine)
    sxx = xx + oxx + 1e-3
    sxr = xr + oxr
    srr = rr + orr + 1e-3
    det = sxx * srr - sxr * sxr
    for k in range(5):
        # what the ring's material at the ball does, and what its turning does to the load
        px = 1.0 if k == 0 else qt if k == 3 else -qr if k == 4 else 0.0
        pr = 1.0 if k == 1 else qx if k == 4 else 0.0
        pt = 1.0 if k == 2 else -qx if k == 3 else 0.0
        bx = xx * px + xr * pr + xt * pt + (ft if k == 3 else -fr if k == 4 else 0.0)
        br = xr * px + rr * pr + rt * pt + (fx if k == 4 else 0.0)
        bt = xt * px + rt * pr + tt * pt + (-fx if k == 3 else 0.0)
        dx = (srr * bx - sxr * br) / det
        dr = (sxx * br - sxr * bx) / det
        gx = bx - xx * dx - xr * dr
        gr = br - xr * dx - rr * dr
        gt = bt - xt * dx - rt * dr
        ux = dx - (1.0 if k == 0 else 0.0)
        ur = dr - (1.0 if k == 1 else 0.0)
        ut = -1.0 if k == 2 else 0.0
        a[k] = gx
        a[5 + k] = gr
        a[10 + k] = gt
        # moment of the force about the ring's own, moving, centre
        a[15 + k] = ut * fx - ux * ft + qt * gx - qx * gt
        a[20 + k] = ux * fr - ur * fx + qx * gr - qr * gx
        a[25 + k] = dx
        a[30 + k] = dr


@kernel
def add_turned(c, s, a, out, at):
    """Add the 5 x 5 of a ball's axes in ``a`` to ``out[at:]`` in inertial axes; overwrites ``a``."""
    for i in range(5):
        for k in range(1, 4, 2):
            along = a[5 * i + k]
            across = a[5 * i + k + 1]
            a[5 * i + k] = -s * along - c * across
            a[5 * i + k + 1] = c * along - s * across
    for i in range(5):
        for k in range(1, 4, 2):
            along = a[5 * k + i]
            across = a[5 * (k + 1) + i]
            a[5 * k + i] = -s * along - c * across
            a[5 * (k + 1) + i] = c * along - s * across
    for i in range(25):
        out[at + i] += a[i]
