"""From the state to the outputs. Everything here follows from the state alone."""

import math

from fmu_bearing.engine.constants import STANDSTILL
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, F, P, Q, S, Y, Z
from fmu_bearing.engine.mechanics.flexure import flexure_state
from fmu_bearing.engine.mechanics.pose import axis_cosine, resolved
from fmu_bearing.engine.mechanics.race import wave_time
from fmu_bearing.engine.readout.motion import sound_block
from fmu_bearing.engine.sound.meter import levels
from fmu_bearing.engine.statics.stiffness import series_stiffness

LITTLE_LOST = 1e-6  # of the stored energy: dissipation below it says nothing about a balance
_CENTRED_2 = 1e-16  # m2: the whirl speed of a cage within 10 nm of the middle says nothing


@kernel
def bodies(p, s, z):
    """Velocities and displacements of rings and cage, velocities of the balls in inertial axes."""
    v = S.Y + Y.V0
    q = S.Y + Y.Q0
    for i in range(3):
        z[Z.INNER_VELOCITY + i] = s[v + i]
        z[Z.OUTER_VELOCITY + i] = s[v + Q.OUTER + i]
        z[Z.CAGE_VELOCITY + i] = s[v + Q.CAGE + i]
        z[Z.INNER_PLACE + i] = s[q + i]
        z[Z.OUTER_PLACE + i] = s[q + Q.OUTER + i]
    for i in range(2):
        z[Z.TILT + i] = s[q + Q.INNER_BY + i]
    pitch = p[P.PITCH_RADIUS]
    orbit = 0.0
    balls = int(p[P.BALLS])
    for j in range(balls):
        angle = s[S.Y + Y.TH + j]
        c = math.cos(angle)
        n = math.sin(angle)
        vr = s[S.Y + Y.VR + j]
        om = s[S.Y + Y.OM + j]
        vt = (pitch + s[S.Y + Y.R + j]) * om
        at = Z.BALLS + Z.PER_BALL * j
        z[at] = s[S.Y + Y.VX + j]
        z[at + 1] = -n * vr - c * vt
        z[at + 2] = c * vr - n * vt
        orbit += om / balls
    turning = s[v + Q.CAGE + Q.TURN] if p[P.CAGE] != 0.0 else orbit
    speed = s[S.SPEED]
    z[Z.CAGE_RATIO] = turning / speed if abs(speed) > STANDSTILL else 0.0
    z[Z.WHIRL_RADIUS] = 0.0
    z[Z.WHIRL_SPEED] = 0.0
    if p[P.CAGE] != 0.0:
        dy = s[q + Q.CAGE + Q.Y] - s[q + Q.Y]
        dz = s[q + Q.CAGE + Q.Z] - s[q + Q.Z]
        vy = s[v + Q.CAGE + Q.Y] - s[v + Q.Y]
        vz = s[v + Q.CAGE + Q.Z] - s[v + Q.Z]
        apart2 = dy * dy + dz * dz
        z[Z.WHIRL_RADIUS] = math.sqrt(apart2)
        z[Z.WHIRL_SPEED] = (dy * vz - dz * vy) / (apart2 + _CENTRED_2)


@kernel
def losses(s, z):
    """Sliding of the contacts, and friction torque by source: the power lost there over the shaft speed."""
    speed = abs(s[S.SPEED])
    for i in range(2):
        z[Z.SPIN_TO_ROLL + i] = s[S.SPIN_TO_ROLL + i]
        z[Z.SLIP + i] = s[S.SLIP + i]
    for i in range(S.LOSSES):
        z[Z.TORQUE_CONTACTS + i] = s[S.LOSS + i] / s[S.SPEED] if speed > STANDSTILL else 0.0


@kernel
def place_in(s, ring, tilt, x, radius, co, si):
    """Axial and radial place (m) of a ball in a ring's frame; ``ring``, ``tilt``: of ``s``."""
    by = s[tilt]
    bz = s[tilt + 1]
    nx = axis_cosine(by, bz)
    qx, qr, qt, _, _, axial = resolved(co, si, x, radius, s[ring], s[ring + Q.Y], s[ring + Q.Z], by, bz, nx)
    return axial, math.sqrt(max(qx * qx + qr * qr + qt * qt - axial * axial, 0.0))


@kernel
def contacts(p, s, z):
    """Write loads, angles, pressures, shoulder margins, film over roughness and stiffness between the rings.

    The margin is the angle (rad) by which the ellipse of the most loaded contact ends before its shoulder.
    Loads are the elastic ones without the waviness of the races. Film: Hamrock and Dowson (1977), minimum
    film, with the rolling speed of a ball that does not slip.
    """
    c = s[S.C : S.C + C.SIZE]
    pitch = p[P.PITCH_RADIUS]
    balls = int(p[P.BALLS])
    ball = c[C.BALL_RADIUS]
    oversize = int(p[P.AT_OVERSIZE])
    thinnest = 1e30
    one = C.RACES
    other = C.RACES + C.RACE_SIZE
    inner = S.Y + Y.Q0
    outer = inner + Q.OUTER
    for i in range(2 * Z.CONTACT_SIZE):
        z[Z.CONTACT + i] = 0.0
    z[Z.AXIAL_STIFFNESS] = 0.0
    z[Z.RADIAL_STIFFNESS] = 0.0
    for j in range(balls):
        angle = s[S.Y + Y.TH + j]
        co = math.cos(angle)
        si = math.sin(angle)
        x = s[S.Y + Y.X + j]
        r = s[S.Y + Y.R + j]
        ax, ar = place_in(s, inner, inner + Q.INNER_BY, x, pitch + r, co, si)
        bx, br = place_in(s, outer, outer + Q.BY, x, pitch + r, co, si)
        om = s[S.Y + Y.OM + j]
        for race in range(2):
            held = C.RACES + race * C.RACE_SIZE
            numbers = P.RACES + race * P.RACE_SIZE
            sx = (ax if race == 0 else bx) - c[held + C.GROOVE_X]
            sr = (ar if race == 0 else br) - c[held + C.GROOVE_RADIUS]
            distance = math.sqrt(sx * sx + sr * sr)
            approach = max(distance - c[held + C.FREE] + 0.5 * p[oversize + j], 0.0)
            load = p[numbers + P.RACE_STIFFNESS] * approach * math.sqrt(approach)
            side = -1.0 if race == 0 else 1.0
            at = Z.CONTACT + Z.CONTACT_SIZE * race
            z[at + Z.LOAD_MEAN] += load / balls
            z[at + Z.LOAD_MAX] = max(z[at + Z.LOAD_MAX], load)
            z[at + Z.ANGLE_MEAN] += math.atan2(side * sx, side * sr) / balls
            pressure = p[numbers + P.RACE_PRESSURE] * math.sqrt(approach)
            z[at + Z.PRESSURE_MAX] = max(z[at + Z.PRESSURE_MAX], pressure)
            rolling = om if race == 1 else s[S.SPEED] - om
            speed = abs(rolling) * (pitch + ball * sr / distance)
            film = p[numbers + P.RACE_FILM] * math.exp(
                0.68 * math.log(c[C.VISCOSITY] * speed + 1e-12) - 0.073 * math.log(load + 1e-3)
            )
            thinnest = min(thinnest, film)
        kxx, _, krr = series_stiffness(
            p, c, ax - c[one + C.GROOVE_X], ar - c[one + C.GROOVE_RADIUS],
            bx - c[other + C.GROOVE_X], br - c[other + C.GROOVE_RADIUS],
        )  # fmt: skip
        z[Z.AXIAL_STIFFNESS] += kxx
        z[Z.RADIAL_STIFFNESS] += 0.5 * krr
    z[Z.LAMBDA] = thinnest / p[P.ROUGHNESS]
    for race in range(2):
        numbers = P.RACES + race * P.RACE_SIZE
        at = Z.CONTACT + Z.CONTACT_SIZE * race
        root = (z[at + Z.LOAD_MAX] / p[numbers + P.RACE_STIFFNESS]) ** (1.0 / 3.0)
        half = p[numbers + P.RACE_HALF_LENGTH] * root
        reach = math.asin(min(1.0, half / p[numbers + P.RACE_PROFILE_RADIUS]))
        z[Z.SHOULDER + race] = p[numbers + P.RACE_SHOULDER] - z[at + Z.ANGLE_MEAN] - reach


@kernel
def fits(p, s, z):
    """Write the angle at which unloaded balls touch both races, and what each ring's fit does.

    Where the rings leave less than no clearance the angle is zero.
    """
    c = s[S.C : S.C + C.SIZE]
    one = C.RACES
    other = C.RACES + C.RACE_SIZE
    apart = (c[one + C.GROOVE_RADIUS] - c[other + C.GROOVE_RADIUS]) / (c[one + C.FREE] + c[other + C.FREE])
    z[Z.FREE_ANGLE] = math.acos(max(-1.0, min(1.0, apart)))
    square = s[S.SPEED] * s[S.SPEED]
    for race in range(2):
        numbers = P.RACES + race * P.RACE_SIZE
        held = C.RACES + race * C.RACE_SIZE
        at = Z.FIT + Z.FIT_SIZE * race
        pressure = p[numbers + P.RACE_FIT_PRESSURE] * max(c[held + C.INTERFERENCE], 0.0)
        z[at + Z.FIT_INTERFERENCE] = 2.0 * c[held + C.INTERFERENCE]
        z[at + Z.FIT_PRESSURE] = pressure
        z[at + Z.FIT_HOOP] = p[numbers + P.RACE_HOOP] * pressure + p[numbers + P.RACE_SPIN_HOOP] * square
        z[at + Z.FIT_GROWTH] = c[held + C.GROWTH]


@kernel
def flexure(p, s, z, mics):
    """Velocities (m/s) of the flexural coordinates, after the balls and so many microphones."""
    count = 2 * int(p[P.MODES])
    to = Z.BALLS + Z.PER_BALL * int(p[P.BALLS]) + (Z.PER_MIC + int(p[P.BANDS])) * mics
    at = flexure_state(p) + count
    for i in range(count):
        z[to + i] = s[at + i]


@kernel
def observe(p, s, z):
    """Fill ``z`` (see ``layout``) from the state ``s``."""
    observe_motion(p, s, z, int(p[P.MICS]))
    if p[P.SOUND_SIZE] != 0.0:
        mics = Z.BALLS + Z.PER_BALL * int(p[P.BALLS])
        levels(sound_block(p), s[S.SOUND :], z, mics)


@kernel
def observe_motion(p, s, z, mics):
    """All outputs but the microphones', for whose number ``mics`` room is left."""
    bodies(p, s, z)
    z[Z.TORQUE] = s[S.F + F.TORQUE]
    z[Z.MEAN_TORQUE] = s[S.MEAN_TORQUE]
    for i in range(3):
        z[Z.HEAT + i] = s[S.MEAN_HEAT + i]
    contacts(p, s, z)
    losses(s, z)
    if p[P.FITS] != 0.0:
        fits(p, s, z)
    flexure(p, s, z, mics)
    z[Z.STEPS] = s[S.STEPS]
    z[Z.REJECTED] = s[S.REJECTED]
    z[Z.RESTARTS] = s[S.RESTARTS]
    z[Z.WAVE_TIME] = wave_time(p, s[S.SPEED])
    lost = s[S.HEAT] + s[S.HEAT + 1] + s[S.HEAT + 2]
    gained = s[S.ENERGY_NOW] - s[S.ENERGY_START]
    enough = lost > 1e-12 + LITTLE_LOST * abs(s[S.ENERGY_NOW])
    z[Z.RESIDUAL] = (s[S.WORK] - lost - gained) / lost if enough else 0.0
