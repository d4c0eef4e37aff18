"""From the state to what people read. Everything here follows from the state alone."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    B_OM,
    B_R,
    B_TH,
    B_VR,
    B_VX,
    B_X,
    C_BALL_RADIUS,
    C_RACE_SIZE,
    C_RACES,
    C_SIZE,
    C_VISCOSITY,
    F_TORQUE,
    P_AT_OVERSIZE,
    P_AT_SOUND,
    P_BALLS,
    P_CAGE,
    P_PITCH_RADIUS,
    P_RACES,
    P_ROUGHNESS,
    P_SOUND_SIZE,
    Q_CAGE,
    Q_OUTER,
    RACE_FILM,
    RACE_PRESSURE,
    RACE_SIZE,
    RACE_STIFFNESS,
    S_C,
    S_ENERGY_NOW,
    S_ENERGY_START,
    S_F,
    S_HEAT_INNER,
    S_MEAN_INNER,
    S_REJECTED,
    S_SOUND,
    S_SPEED,
    S_STEPS,
    S_WORK,
    S_Y,
    STRIDE,
    Y_Q,
    Y_V,
    Z_BALLS,
)
from fmu_bearing.engine.mechanics.pose import axis_cosine
from fmu_bearing.engine.solvers.stiffness import series_stiffness
from fmu_bearing.engine.sound.meter import levels

_S = STRIDE


@kernel
def bodies(p, s, z):
    """Velocities and displacements of rings and cage, velocities of the balls in inertial axes."""
    v = S_Y + Y_V
    q = S_Y + Y_Q
    for i in range(3):
        z[i] = s[v + i]
        z[3 + i] = s[v + Q_OUTER + i]
        z[6 + i] = s[v + Q_CAGE + i]
        z[14 + i] = s[q + i]
        z[17 + i] = s[q + Q_OUTER + i]
    pitch = p[P_PITCH_RADIUS]
    orbit = 0.0
    balls = int(p[P_BALLS])
    for j in range(balls):
        angle = s[S_Y + B_TH * _S + j]
        c = math.cos(angle)
        n = math.sin(angle)
        vr = s[S_Y + B_VR * _S + j]
        om = s[S_Y + B_OM * _S + j]
        vt = (pitch + s[S_Y + B_R * _S + j]) * om
        z[Z_BALLS + 3 * j] = s[S_Y + B_VX * _S + j]
        z[Z_BALLS + 3 * j + 1] = -n * vr - c * vt
        z[Z_BALLS + 3 * j + 2] = c * vr - n * vt
        orbit += om / balls
    turning = s[v + Q_CAGE + 3] if p[P_CAGE] != 0.0 else orbit
    speed = s[S_SPEED]
    z[13] = turning / speed if abs(speed) > 1e-9 else 0.0


@kernel
def seen_from(s, ring, tilt, x, r, across, c, n, pitch):
    """Axial and radial place (m) of a ball in a ring's frame and the ring's tilt axis resolved there."""
    by = s[tilt]
    bz = s[tilt + 1]
    qx = x - s[ring]
    qr = pitch + r - (c * s[ring + 2] - n * s[ring + 1])
    qt = across + c * s[ring + 1] + n * s[ring + 2]
    nx = axis_cosine(by, bz)
    nr = -n * bz - c * by
    nt = -c * bz + n * by
    axial = qx * nx + qr * nr + qt * nt
    return axial, math.sqrt(max(qx * qx + qr * qr + qt * qt - axial * axial, 0.0))


@kernel
def contacts(p, s, z):
    """Write loads, angles, pressures, thinnest film over roughness and stiffness between the rings.

    Loads are the elastic ones without the waviness of the races. Film: Hamrock and Dowson (1977), minimum
    film, with the rolling speed of a ball that does not slip.
    """
    c = s[S_C : S_C + C_SIZE]
    pitch = p[P_PITCH_RADIUS]
    balls = int(p[P_BALLS])
    ball = c[C_BALL_RADIUS]
    oversize = int(p[P_AT_OVERSIZE])
    thinnest = 1e30
    for i in range(20, 28):
        z[i] = 0.0
    z[29] = 0.0
    z[30] = 0.0
    for j in range(balls):
        angle = s[S_Y + B_TH * _S + j]
        co = math.cos(angle)
        si = math.sin(angle)
        x = s[S_Y + B_X * _S + j]
        r = s[S_Y + B_R * _S + j]
        ax, ar = seen_from(s, S_Y + Y_Q, S_Y + Y_Q + 3, x, r, 0.0, co, si, pitch)
        bx, br = seen_from(s, S_Y + Y_Q + Q_OUTER, S_Y + Y_Q + Q_OUTER + 4, x, r, 0.0, co, si, pitch)
        om = s[S_Y + B_OM * _S + j]
        for race in range(2):
            held = C_RACES + race * C_RACE_SIZE
            numbers = P_RACES + race * RACE_SIZE
            sx = (ax if race == 0 else bx) - c[held]
            sr = (ar if race == 0 else br) - c[held + 1]
            distance = math.sqrt(sx * sx + sr * sr)
            approach = max(distance - c[held + 2] + 0.5 * p[oversize + j], 0.0)
            load = p[numbers + RACE_STIFFNESS] * approach * math.sqrt(approach)
            side = -1.0 if race == 0 else 1.0
            at = 20 + 4 * race
            z[at] += load / balls
            z[at + 1] = max(z[at + 1], load)
            z[at + 2] += math.atan2(side * sx, side * sr) / balls
            z[at + 3] = max(z[at + 3], p[numbers + RACE_PRESSURE] * math.sqrt(approach))
            rolling = om if race == 1 else s[S_SPEED] - om
            speed = abs(rolling) * (pitch + ball * sr / distance)
            film = p[numbers + RACE_FILM] * math.exp(
                0.68 * math.log(c[C_VISCOSITY] * speed + 1e-12) - 0.073 * math.log(load + 1e-3)
            )
            thinnest = min(thinnest, film)
        kxx, _, krr = series_stiffness(
            p, c, ax - c[C_RACES], ar - c[C_RACES + 1],
            bx - c[C_RACES + C_RACE_SIZE], br - c[C_RACES + C_RACE_SIZE + 1],
        )  # fmt: skip
        z[29] += kxx
        z[30] += 0.5 * krr
    z[28] = thinnest / p[P_ROUGHNESS]


@kernel
def observe(p, s, z):
    """Fill ``z`` (see ``layout``) from the state ``s``."""
    bodies(p, s, z)
    z[9] = s[S_F + F_TORQUE]
    for i in range(3):
        z[10 + i] = s[S_MEAN_INNER + i]
    contacts(p, s, z)
    z[31] = s[S_STEPS]
    z[32] = s[S_REJECTED]
    lost = s[S_HEAT_INNER] + s[S_HEAT_INNER + 1] + s[S_HEAT_INNER + 2]
    gained = s[S_ENERGY_NOW] - s[S_ENERGY_START]
    z[33] = (s[S_WORK] - lost - gained) / lost if lost > 1e-12 else 0.0
    if p[P_SOUND_SIZE] != 0.0:
        block = int(p[P_AT_SOUND])
        levels(p[block : block + int(p[P_SOUND_SIZE])], s[S_SOUND:], z, Z_BALLS + 3 * int(p[P_BALLS]))
