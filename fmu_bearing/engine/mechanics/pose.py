"""Where a ball stands in the frame of a ring or the cage, and how fast it moves there."""

import math

from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import (
    B_OM,
    B_R,
    B_VR,
    B_VX,
    B_WR,
    B_WT,
    B_WX,
    B_X,
    P_PITCH_RADIUS,
    POSE_ROWS,
    STRIDE,
    W_COS,
    W_POSE,
    W_SIN,
    X_A,
    X_DV,
    X_DW,
    X_H,
    X_N,
    X_Q,
    X_RHO,
    X_T,
)

_S = STRIDE


@kernel
def axis_cosine(by, bz):
    """X component of a body's axis for the small tilts ``by``, ``bz`` (rad): unit length to fourth order."""
    return 1.0 - 0.5 * (by * by + bz * bz)


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
    pitch = p[P_PITCH_RADIUS]
    base = (W_POSE + body * POSE_ROWS) * _S
    for j in range(lanes):
        c = w[W_COS * _S + j]
        s = w[W_SIN * _S + j]
        radius = pitch + y[B_R * _S + j]
        qx = y[B_X * _S + j] - ux
        qr = radius - (c * uz - s * uy)
        qt = c * uy + s * uz
        nr = -s * bz - c * by
        nt = -c * bz + s * by
        axial = qx * nx + qr * nr + qt * nt
        hx = qx - axial * nx
        hr = qr - axial * nr
        ht = qt - axial * nt
        rho = math.sqrt(hx * hx + hr * hr + ht * ht)
        inv = 1.0 / rho
        hx *= inv
        hr *= inv
        ht *= inv
        gr = c * wz - s * wy
        gt = -c * wy - s * wz
        w[base + X_Q * _S + j] = qx
        w[base + (X_Q + 1) * _S + j] = qr
        w[base + (X_Q + 2) * _S + j] = qt
        w[base + X_N * _S + j] = nx
        w[base + (X_N + 1) * _S + j] = nr
        w[base + (X_N + 2) * _S + j] = nt
        w[base + X_H * _S + j] = hx
        w[base + (X_H + 1) * _S + j] = hr
        w[base + (X_H + 2) * _S + j] = ht
        w[base + X_T * _S + j] = nr * ht - nt * hr
        w[base + (X_T + 1) * _S + j] = nt * hx - nx * ht
        w[base + (X_T + 2) * _S + j] = nx * hr - nr * hx
        w[base + X_A * _S + j] = axial
        w[base + X_RHO * _S + j] = rho
        w[base + X_DV * _S + j] = y[B_VX * _S + j] - vx - (gr * qt - gt * qr)
        w[base + (X_DV + 1) * _S + j] = y[B_VR * _S + j] - (c * vz - s * vy) - (gt * qx - wx * qt)
        w[base + (X_DV + 2) * _S + j] = radius * y[B_OM * _S + j] + (c * vy + s * vz) - (wx * qr - gr * qx)
        w[base + X_DW * _S + j] = y[B_WX * _S + j] - wx
        w[base + (X_DW + 1) * _S + j] = y[B_WR * _S + j] - gr
        w[base + (X_DW + 2) * _S + j] = y[B_WT * _S + j] - gt


@inlined
def bearing_angle(hr, ht):
    """Angle (rad) by which a direction leaves the ball's radial one: arctangent series, 1e-18 up to 4e-3."""
    a = ht / hr
    a2 = a * a
    return a * (1.0 - a2 * (1.0 / 3.0 - 0.2 * a2))
