"""Where a ball is in the frame of a ring or the cage, and how fast it moves there."""

import math

from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import STRIDE, P, W, X, Y


@kernel
def axis_cosine(by, bz):
    """X component of a body's axis for the small tilts ``by``, ``bz`` (rad): unit length to fourth order."""
    return 1.0 - 0.5 * (by * by + bz * bz)


@kernel
def resolved(co, si, x, radius, ux, uy, uz, by, bz, nx):
    """Ball centre from a body's centre, the body's axis n and their product, in the ball's orbiting axes.

    ``co``, ``si``: of the ball's angle; ``x``, ``radius``: its place (m); ``u``: the body's displacement
    (m); ``by``, ``bz``: its tilts (rad); ``nx``: its axis along X. Returns q (x, r, theta),
    n (r, theta), q n.
    """
    qx = x - ux
    qr = radius - (co * uz - si * uy)
    qt = co * uy + si * uz
    nr = -si * bz - co * by
    nt = -co * bz + si * by
    return qx, qr, qt, nr, nt, qx * nx + qr * nr + qt * nt


@kernel
def seen(co, si, x, radius, ux, uy, uz, by, bz, nx):
    """Return what :func:`resolved` does, then the distance from the axis (m) and the radial unit vector h.

    In order: q (x, r, theta), n (r, theta), q n, distance, h (x, r, theta). Arguments as there.
    """
    qx, qr, qt, nr, nt, axial = resolved(co, si, x, radius, ux, uy, uz, by, bz, nx)
    hx = qx - axial * nx
    hr = qr - axial * nr
    ht = qt - axial * nt
    rho = math.sqrt(hx * hx + hr * hr + ht * ht)
    inv = 1.0 / rho
    return qx, qr, qt, nr, nt, axial, rho, hx * inv, hr * inv, ht * inv


@inlined
def relative_pose(p, y, lanes, body, ux, uy, uz, by, bz, vx, vy, vz, spin, dby, dbz, w):
    """Ball centres and velocities relative to one body, in each ball's orbiting axes (x, r, theta).

    ``u`` and ``v`` are the body's displacement (m) and velocity (m/s), ``by``/``bz`` its tilts (rad),
    ``spin`` its rate about its own axis (rad/s). Writes, per ball: the vector q from the body's centre,
    the body's axis n, the radial unit vector h and tangent n x h, axial and radial distances, the
    velocity of the ball's centre against the body's material there, and the relative angular velocity.
    """
    nx = axis_cosine(by, bz)
    wy = spin * bz + dby
    wz = -spin * by + dbz
    wx = spin * nx
    pitch = p[P.PITCH_RADIUS]
    base = W.POSE + body * X.SIZE
    for j in range(lanes):
        c = w[W.COS + j]
        s = w[W.SIN + j]
        radius = pitch + y[Y.R + j]
        qx, qr, qt, nr, nt, axial, rho, hx, hr, ht = seen(c, s, y[Y.X + j], radius, ux, uy, uz, by, bz, nx)
        gr = c * wz - s * wy
        gt = -c * wy - s * wz
        w[base + X.Q + j] = qx
        w[base + X.Q + STRIDE + j] = qr
        w[base + X.Q + 2 * STRIDE + j] = qt
        w[base + X.N + j] = nx
        w[base + X.N + STRIDE + j] = nr
        w[base + X.N + 2 * STRIDE + j] = nt
        w[base + X.H + j] = hx
        w[base + X.H + STRIDE + j] = hr
        w[base + X.H + 2 * STRIDE + j] = ht
        w[base + X.T + j] = nr * ht - nt * hr
        w[base + X.T + STRIDE + j] = nt * hx - nx * ht
        w[base + X.T + 2 * STRIDE + j] = nx * hr - nr * hx
        w[base + X.A + j] = axial
        w[base + X.RHO + j] = rho
        w[base + X.DV + j] = y[Y.VX + j] - vx - (gr * qt - gt * qr)
        w[base + X.DV + STRIDE + j] = y[Y.VR + j] - (c * vz - s * vy) - (gt * qx - wx * qt)
        w[base + X.DV + 2 * STRIDE + j] = radius * y[Y.OM + j] + (c * vy + s * vz) - (wx * qr - gr * qx)
        w[base + X.DW + j] = y[Y.WX + j] - wx
        w[base + X.DW + STRIDE + j] = y[Y.WR + j] - gr
        w[base + X.DW + 2 * STRIDE + j] = y[Y.WT + j] - gt


@inlined
def bearing_angle(hr, ht):
    """Angle (rad) by which a direction leaves the ball's radial one: arctangent series, 1e-18 up to 4e-3."""
    a = ht / hr
    a2 = a * a
    return a * (1.0 - a2 * (1.0 / 3.0 - 0.2 * a2))
