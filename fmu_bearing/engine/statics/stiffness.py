"""Stiffness of the contacts of one ball in series, on its own and as part of the bearing's 5 x 5 matrix.

The ball is massless and free in its axial plane; centrifugal and friction forces are held.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, ST, P
from fmu_bearing.engine.mechanics.contact import hertz, in_plane
from fmu_bearing.engine.statics.ball_balance import inner_contact, outer_contact


@kernel
def contact_stiffness(contact):
    """In-plane stiffness (N/m) of one contact, see :func:`series_stiffness`: xx, xr, rr."""
    stiffness, approach, distance, sine, cosine = contact
    load, slope, _ = hertz(stiffness, approach)
    return in_plane(0.0, 0.0, 0.0, slope, load / distance, sine, cosine, cosine, -sine)


@kernel
def series_stiffness(inner, outer):
    """In-plane stiffness (xx, xr, rr in N/m) of inner and outer contact in series, ball massless.

    Of each contact: stiffness constant (N/m^1.5), approach (m), distance of the ball's centre from that of
    the groove (m), sine and cosine of the contact angle. Zero when a contact is open.
    """
    if inner[1] <= 0.0 or outer[1] <= 0.0:
        return 0.0, 0.0, 0.0
    ixx, ixr, irr = contact_stiffness(inner)
    oxx, oxr, orr = contact_stiffness(outer)
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
def contact_tensor(seat):
    """Stiffness of one contact (N/m) as six numbers xx, xr, xt, rr, rt, tt: kn ee + Q/d mm + Q cos/rho tt.

    ``seat``: a `Seat`; t = e x m.
    """
    kn = seat.stiffness
    ex, er, et = seat.ex, seat.er, seat.et
    mx, mr, mt = seat.mx, seat.mr, seat.mt
    kt = seat.across
    kc = seat.load * seat.cosine / seat.rho
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
    """Stiffness of the inner ring through one ball, which follows, into ``a`` (``ST.SHARE_SIZE``).

    Rows ``ST.FX`` to ``ST.MT``: forces and moments on the ring; columns ``ST.ALONG`` to ``ST.TILT_T``:
    displacements and tilts of the ring, all in the ball's axes. ``pose``: see `Pose`;
    ``x``, ``r``: the ball's place (m). Zero where the inner contact is open.
    """
    for i in range(ST.SHARE_SIZE):
        a[i] = 0.0
    radius = p[P.PITCH_RADIUS] + r
    qx = x - pose.x
    qr = radius - pose.r
    qt = -pose.t
    inner = inner_contact(p, c, pose, x, radius)
    if inner.load <= 0.0:
        return
    fx = -inner.load * inner.ex
    fr = -inner.load * inner.er
    ft = -inner.load * inner.et
    xx, xr, xt, rr, rt, tt = contact_tensor(inner)
    oxx, oxr, _, orr, _, _ = contact_tensor(outer_contact(p, c, pose, x, radius))
    sxx = xx + oxx + 1e-3
    sxr = xr + oxr
    srr = rr + orr + 1e-3
    det = sxx * srr - sxr * sxr
    for k in range(EQ.FREEDOMS):
        # what the ring's material at the ball does, and what its turning does to the load
        tilt_r = k == ST.TILT_R
        tilt_t = k == ST.TILT_T
        px = 1.0 if k == ST.ALONG else qt if tilt_r else -qr if tilt_t else 0.0
        pr = 1.0 if k == ST.OUTWARDS else qx if tilt_t else 0.0
        pt = 1.0 if k == ST.AROUND else -qx if tilt_r else 0.0
        bx = xx * px + xr * pr + xt * pt + (ft if tilt_r else -fr if tilt_t else 0.0)
        br = xr * px + rr * pr + rt * pt + (fx if tilt_t else 0.0)
        bt = xt * px + rt * pr + tt * pt + (-fx if tilt_r else 0.0)
        dx = (srr * bx - sxr * br) / det
        dr = (sxx * br - sxr * bx) / det
        gx = bx - xx * dx - xr * dr
        gr = br - xr * dx - rr * dr
        gt = bt - xt * dx - rt * dr
        ux = dx - (1.0 if k == ST.ALONG else 0.0)
        ur = dr - (1.0 if k == ST.OUTWARDS else 0.0)
        ut = -1.0 if k == ST.AROUND else 0.0
        a[ST.FX + k] = gx
        a[ST.FR + k] = gr
        a[ST.FT + k] = gt
        # moment of the force about the ring's own, moving, centre
        a[ST.MR + k] = ut * fx - ux * ft + qt * gx - qx * gt
        a[ST.MT + k] = ux * fr - ur * fx + qx * gr - qr * gx


@kernel
def add_turned(c, s, a, out, at):
    """Add the stiffness of a ball's axes in ``a`` to ``out[at:]`` in inertial axes; overwrites ``a``."""
    n = EQ.FREEDOMS
    for i in range(n):
        for k in (ST.OUTWARDS, ST.TILT_R):  # the pairs that turn: r, theta and the tilts about them
            along = a[n * i + k]
            across = a[n * i + k + 1]
            a[n * i + k] = -s * along - c * across
            a[n * i + k + 1] = c * along - s * across
    for i in range(n):
        for k in (ST.OUTWARDS, ST.TILT_R):
            along = a[n * k + i]
            across = a[n * (k + 1) + i]
            a[n * k + i] = -s * along - c * across
            a[n * (k + 1) + i] = c * along - s * across
    for i in range(ST.SHARE_SIZE):
        out[at + i] += a[i]
