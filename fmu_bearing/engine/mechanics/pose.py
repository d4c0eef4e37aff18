"""Where a ball is in the frame of a ring or the cage, and how fast it moves there."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store
from fmu_bearing.engine.layout import FOUR, P, W, X, Y
from fmu_bearing.engine.mechanics.triples import cross, store_three


@kernel
def axis_cosine(by, bz):
    """X component of a body's axis for the small tilts ``by``, ``bz`` (rad): unit length to fourth order."""
    return 1.0 - 0.5 * (by * by + bz * bz)


@kernel
def ball_in_orbiting_axes(co, si, x, radius, ux, uy, uz, by, bz, nx):
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
def axis_distance(axial, qx, qr, qt, nx, nr, nt):
    """Distance (m) of a ball's centre q from a body's axis n, then the unit vector h; ``axial``: q n (m)."""
    hx = qx - axial * nx
    hr = qr - axial * nr
    ht = qt - axial * nt
    rho = math.sqrt(hx * hx + hr * hr + ht * ht)
    inv = 1.0 / rho
    return rho, hx * inv, hr * inv, ht * inv


@kernel
def ball_pose(co, si, x, radius, ux, uy, uz, by, bz, nx):
    """Return what `ball_in_orbiting_axes` does, then distance from the axis (m) and radial unit vector h.

    In order: q (x, r, theta), n (r, theta), q n, distance, h (x, r, theta). Arguments as there.
    """
    qx, qr, qt, nr, nt, axial = ball_in_orbiting_axes(co, si, x, radius, ux, uy, uz, by, bz, nx)
    rho, hx, hr, ht = axis_distance(axial, qx, qr, qt, nx, nr, nt)
    return qx, qr, qt, nr, nt, axial, rho, hx, hr, ht


@kernel
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
    for j in range(0, lanes, FOUR):
        c = load(w, W.COS + j)
        s = load(w, W.SIN + j)
        radius = pitch + load(y, Y.R + j)
        x = load(y, Y.X + j)
        qx, qr, qt, nr, nt, axial, rho, hx, hr, ht = ball_pose(c, s, x, radius, ux, uy, uz, by, bz, nx)
        q = (qx, qr, qt)
        n = (splat(nx), nr, nt)
        h = (hx, hr, ht)
        spin_r = c * wz - s * wy
        spin_t = -c * wy - s * wz
        # the body's material moves with its centre and turns about it
        mx, mr, mt = cross((splat(wx), spin_r, spin_t), q)
        store_three(w, base + X.Q + j, q)
        store_three(w, base + X.N + j, n)
        store_three(w, base + X.H + j, h)
        store_three(w, base + X.T + j, cross(n, h))
        store(w, base + X.A + j, axial)
        store(w, base + X.RHO + j, rho)
        dvx = load(y, Y.VX + j) - vx - mx
        dvr = load(y, Y.VR + j) - (c * vz - s * vy) - mr
        dvt = radius * load(y, Y.OM + j) + (c * vy + s * vz) - mt
        store_three(w, base + X.DV + j, (dvx, dvr, dvt))
        dwx = load(y, Y.WX + j) - wx
        dwr = load(y, Y.WR + j) - spin_r
        dwt = load(y, Y.WT + j) - spin_t
        store_three(w, base + X.DW + j, (dwx, dwr, dwt))


@kernel
def bearing_angle(hr, ht):
    """Angle (rad) by which a direction leaves the ball's radial one: arctangent series, 1e-18 up to 4e-3."""
    a = ht / hr
    a2 = a * a
    return a * (1.0 - a2 * (1.0 / 3.0 - 0.2 * a2))
