"""From the state to what people read. Everything here follows from the state alone."""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, F, P, Q, S, Y, Z
from fmu_bearing.engine.mechanics.flexure import flexure_state
from fmu_bearing.engine.mechanics.pose import axis_cosine, resolved
from fmu_bearing.engine.sound.meter import levels
from fmu_bearing.engine.statics.stiffness import series_stiffness

# places in z by name: the table of names in ``layout`` is the only one that numbers them
Z_INNER_VELOCITY = Z.BEARING_OUTPUTS.index("inner_ring.velocity.x")
Z_OUTER_VELOCITY = Z.BEARING_OUTPUTS.index("outer_ring.velocity.x")
Z_CAGE_VELOCITY = Z.BEARING_OUTPUTS.index("cage.velocity.x")
Z_TORQUE = Z.BEARING_OUTPUTS.index("friction_torque")
Z_HEAT = Z.BEARING_OUTPUTS.index("heat.inner_ring")
Z_CAGE_RATIO = Z.BEARING_OUTPUTS.index("cage.speed_ratio")
Z_INNER_PLACE = Z.BEARING_OUTPUTS.index("inner_ring.displacement.x")
Z_OUTER_PLACE = Z.BEARING_OUTPUTS.index("outer_ring.displacement.x")
Z_CONTACT = Z.BEARING_OUTPUTS.index("contact.inner.load_mean")  # four of the inner, four of the outer race
Z_LAMBDA = Z.BEARING_OUTPUTS.index("film.lambda_min")
Z_AXIAL_STIFFNESS = Z.BEARING_OUTPUTS.index("stiffness.axial")
Z_RADIAL_STIFFNESS = Z.BEARING_OUTPUTS.index("stiffness.radial")
Z_STEPS = Z.BEARING_OUTPUTS.index("solver.steps")
Z_REJECTED = Z.BEARING_OUTPUTS.index("solver.rejected")
Z_RESIDUAL = Z.BEARING_OUTPUTS.index("energy.residual")
Z_FALLBACKS = Z.BEARING_OUTPUTS.index("solver.fallbacks")
Z_TILT = Z.BEARING_OUTPUTS.index("inner_ring.tilt.y")
Z_SPIN_TO_ROLL = Z.BEARING_OUTPUTS.index("contact.inner.spin_to_roll")
Z_SLIP = Z.BEARING_OUTPUTS.index("contact.inner.slip")
Z_WHIRL_RADIUS = Z.BEARING_OUTPUTS.index("cage.whirl_radius")
Z_WHIRL_SPEED = Z.BEARING_OUTPUTS.index("cage.whirl_speed")
Z_SHOULDER = Z.BEARING_OUTPUTS.index("contact.inner.shoulder_margin")
Z_TORQUE_CONTACTS = Z.BEARING_OUTPUTS.index("friction_torque.contacts")  # then rolling, cage, drag
_PER_MIC = len(Z.MIC_OUTPUTS)
_STANDSTILL = 1e-9  # rad/s: below it nothing is divided by the shaft speed
_CENTRED_2 = 1e-16  # m2: the whirl speed of a cage within 10 nm of the middle says nothing


@kernel
def bodies(p, s, z):
    """Velocities and displacements of rings and cage, velocities of the balls in inertial axes."""
    v = S.Y + Y.V0
    q = S.Y + Y.Q0
    for i in range(3):
        z[Z_INNER_VELOCITY + i] = s[v + i]
        z[Z_OUTER_VELOCITY + i] = s[v + Q.OUTER + i]
        z[Z_CAGE_VELOCITY + i] = s[v + Q.CAGE + i]
        z[Z_INNER_PLACE + i] = s[q + i]
        z[Z_OUTER_PLACE + i] = s[q + Q.OUTER + i]
    for i in range(2):
        z[Z_TILT + i] = s[q + 3 + i]
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
        z[Z.BALLS + 3 * j] = s[S.Y + Y.VX + j]
        z[Z.BALLS + 3 * j + 1] = -n * vr - c * vt
        z[Z.BALLS + 3 * j + 2] = c * vr - n * vt
        orbit += om / balls
    turning = s[v + Q.CAGE + 3] if p[P.CAGE] != 0.0 else orbit
    speed = s[S.SPEED]
    z[Z_CAGE_RATIO] = turning / speed if abs(speed) > _STANDSTILL else 0.0
    z[Z_WHIRL_RADIUS] = 0.0
    z[Z_WHIRL_SPEED] = 0.0
    if p[P.CAGE] != 0.0:
        dy = s[q + Q.CAGE + 1] - s[q + 1]
        dz = s[q + Q.CAGE + 2] - s[q + 2]
        vy = s[v + Q.CAGE + 1] - s[v + 1]
        vz = s[v + Q.CAGE + 2] - s[v + 2]
        apart2 = dy * dy + dz * dz
        z[Z_WHIRL_RADIUS] = math.sqrt(apart2)
        z[Z_WHIRL_SPEED] = (dy * vz - dz * vy) / (apart2 + _CENTRED_2)


@kernel
def losses(s, z):
    """Sliding of the contacts, and friction torque by source: the power lost there over the shaft speed."""
    speed = abs(s[S.SPEED])
    for i in range(2):
        z[Z_SPIN_TO_ROLL + i] = s[S.SPIN_TO_ROLL + i]
        z[Z_SLIP + i] = s[S.SLIP + i]
    for i in range(4):
        z[Z_TORQUE_CONTACTS + i] = s[S.LOSS + i] / s[S.SPEED] if speed > _STANDSTILL else 0.0


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
    inner = S.Y + Y.Q0
    outer = inner + Q.OUTER
    for i in range(8):
        z[Z_CONTACT + i] = 0.0
    z[Z_AXIAL_STIFFNESS] = 0.0
    z[Z_RADIAL_STIFFNESS] = 0.0
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
            sx = (ax if race == 0 else bx) - c[held]
            sr = (ar if race == 0 else br) - c[held + 1]
            distance = math.sqrt(sx * sx + sr * sr)
            approach = max(distance - c[held + 2] + 0.5 * p[oversize + j], 0.0)
            load = p[numbers + P.RACE_STIFFNESS] * approach * math.sqrt(approach)
            side = -1.0 if race == 0 else 1.0
            at = Z_CONTACT + 4 * race
            z[at] += load / balls
            z[at + 1] = max(z[at + 1], load)
            z[at + 2] += math.atan2(side * sx, side * sr) / balls
            z[at + 3] = max(z[at + 3], p[numbers + P.RACE_PRESSURE] * math.sqrt(approach))
            rolling = om if race == 1 else s[S.SPEED] - om
            speed = abs(rolling) * (pitch + ball * sr / distance)
            film = p[numbers + P.RACE_FILM] * math.exp(
                0.68 * math.log(c[C.VISCOSITY] * speed + 1e-12) - 0.073 * math.log(load + 1e-3)
            )
            thinnest = min(thinnest, film)
        kxx, _, krr = series_stiffness(
            p, c, ax - c[C.RACES], ar - c[C.RACES + 1],
            bx - c[C.RACES + C.RACE_SIZE], br - c[C.RACES + C.RACE_SIZE + 1],
        )  # fmt: skip
        z[Z_AXIAL_STIFFNESS] += kxx
        z[Z_RADIAL_STIFFNESS] += 0.5 * krr
    z[Z_LAMBDA] = thinnest / p[P.ROUGHNESS]
    for race in range(2):
        numbers = P.RACES + race * P.RACE_SIZE
        root = (z[Z_CONTACT + 4 * race + 1] / p[numbers + P.RACE_STIFFNESS]) ** (1.0 / 3.0)
        half = p[numbers + P.RACE_HALF_LENGTH] * root
        reach = math.asin(min(1.0, half / p[numbers + P.RACE_PROFILE_RADIUS]))
        z[Z_SHOULDER + race] = p[numbers + P.RACE_SHOULDER] - z[Z_CONTACT + 4 * race + 2] - reach


@kernel
def flexure(p, s, z):
    """Velocities (m/s) of the flexural coordinates, after the microphones."""
    count = 2 * int(p[P.MODES])
    to = Z.BALLS + 3 * int(p[P.BALLS]) + (_PER_MIC + int(p[P.BANDS])) * int(p[P.MICS])
    at = flexure_state(p) + count
    for i in range(count):
        z[to + i] = s[at + i]


@kernel
def observe(p, s, z):
    """Fill ``z`` (see ``layout``) from the state ``s``."""
    bodies(p, s, z)
    z[Z_TORQUE] = s[S.F + F.TORQUE]
    for i in range(3):
        z[Z_HEAT + i] = s[S.MEAN_HEAT + i]
    contacts(p, s, z)
    losses(s, z)
    flexure(p, s, z)
    z[Z_STEPS] = s[S.STEPS]
    z[Z_REJECTED] = s[S.REJECTED]
    z[Z_FALLBACKS] = s[S.FALLBACKS]
    lost = s[S.HEAT] + s[S.HEAT + 1] + s[S.HEAT + 2]
    gained = s[S.ENERGY_NOW] - s[S.ENERGY_START]
    z[Z_RESIDUAL] = (s[S.WORK] - lost - gained) / lost if lost > 1e-12 else 0.0
    if p[P.SOUND_SIZE] != 0.0:
        block = int(p[P.AT_SOUND])
        levels(p[block : block + int(p[P.SOUND_SIZE])], s[S.SOUND :], z, Z.BALLS + 3 * int(p[P.BALLS]))
