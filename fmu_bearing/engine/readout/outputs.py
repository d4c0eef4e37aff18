"""From the state to the outputs. Everything here follows from the state alone."""

import math

from fmu_bearing.engine.constants import STANDSTILL
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, F, P, Q, S, Y, Z
from fmu_bearing.engine.mechanics.bodies import guiding_ring
from fmu_bearing.engine.mechanics.flexure import flexure_state
from fmu_bearing.engine.mechanics.race import wave_time
from fmu_bearing.engine.readout.contacts import contacts, knows_balls
from fmu_bearing.engine.readout.defects import observe_defects
from fmu_bearing.engine.readout.losses import seal_loss
from fmu_bearing.engine.readout.motion import sound_block
from fmu_bearing.engine.sound import accelerometer
from fmu_bearing.engine.sound.meter import levels

LITTLE_LOST = 1e-6  # of the stored energy: dissipation below it says nothing about a balance
_CENTRED_2 = 1e-16  # m2: the whirl speed of a cage within 10 nm of the middle says nothing


@kernel
def bodies(p, s, z):
    """Velocities and displacements of rings and cage."""
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
    orbit = 0.0
    count = int(p[P.BALLS])
    for j in range(count):
        orbit += s[S.Y + Y.OM + j] / count
    turning = s[v + Q.CAGE + Q.TURN] if p[P.CAGE] != 0.0 else orbit
    speed = s[S.SPEED]
    z[Z.CAGE_RATIO] = turning / speed if abs(speed) > STANDSTILL else 0.0
    z[Z.WHIRL_RADIUS] = 0.0
    z[Z.WHIRL_SPEED] = 0.0
    if p[P.CAGE] != 0.0:
        ring, _ = guiding_ring(p)
        dy = s[q + Q.CAGE + Q.Y] - s[q + ring + Q.Y]
        dz = s[q + Q.CAGE + Q.Z] - s[q + ring + Q.Z]
        vy = s[v + Q.CAGE + Q.Y] - s[v + ring + Q.Y]
        vz = s[v + Q.CAGE + Q.Z] - s[v + ring + Q.Z]
        apart2 = dy * dy + dz * dz
        z[Z.WHIRL_RADIUS] = math.sqrt(apart2)
        z[Z.WHIRL_SPEED] = (dy * vz - dz * vy) / (apart2 + _CENTRED_2)


@kernel
def balls(p, s, z):
    """Velocities of the balls in inertial axes."""
    pitch = p[P.PITCH_RADIUS]
    for j in range(int(p[P.BALLS])):
        angle = s[S.Y + Y.TH + j]
        c = math.cos(angle)
        n = math.sin(angle)
        vr = s[S.Y + Y.VR + j]
        vt = (pitch + s[S.Y + Y.R + j]) * s[S.Y + Y.OM + j]
        at = Z.BALLS + Z.PER_BALL * j
        z[at] = s[S.Y + Y.VX + j]
        z[at + 1] = -n * vr - c * vt
        z[at + 2] = c * vr - n * vt


@kernel
def losses(p, s, z):
    """Sliding of the contacts, and friction torque by source: the power lost there over the shaft speed."""
    speed = abs(s[S.SPEED])
    for i in range(2):
        z[Z.SPIN_TO_ROLL + i] = s[S.SPIN_TO_ROLL + i]
        z[Z.SLIP + i] = s[S.SLIP + i]
    for i in range(S.LOSSES):
        z[Z.TORQUE_CONTACTS + i] = s[S.LOSS + i] / s[S.SPEED] if speed > STANDSTILL else 0.0
    z[Z.TORQUE_SEALS] = 0.0
    if p[P.SEAL_TORQUE] != 0.0 and speed > STANDSTILL:
        z[Z.TORQUE_SEALS] = seal_loss(p, s) / s[S.SPEED]


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
        raceway = C.RACES + race * C.RACE_SIZE
        at = Z.FIT + Z.FIT_SIZE * race
        pressure = p[numbers + P.RACE_FIT_PRESSURE] * max(c[raceway + C.INTERFERENCE], 0.0)
        z[at + Z.FIT_INTERFERENCE] = 2.0 * c[raceway + C.INTERFERENCE]
        z[at + Z.FIT_PRESSURE] = pressure
        z[at + Z.FIT_HOOP] = p[numbers + P.RACE_HOOP] * pressure + p[numbers + P.RACE_SPIN_HOOP] * square
        z[at + Z.FIT_GROWTH] = c[raceway + C.GROWTH]


@kernel
def clearance(s, z):
    """Write the radial clearance (m) that fits, rotation and heat leave; negative: balls are pressed."""
    c = s[S.C : S.C + C.SIZE]
    one = C.RACES
    other = C.RACES + C.RACE_SIZE
    apart = c[one + C.GROOVE_RADIUS] - c[other + C.GROOVE_RADIUS]
    z[Z.CLEARANCE] = 2.0 * (c[one + C.FREE] + c[other + C.FREE] - apart)


@kernel
def flexures(p, mics):
    """Place of the velocities of the flexural coordinates, after the balls and so many microphones."""
    return Z.BALLS + Z.PER_BALL * int(p[P.BALLS]) + (Z.PER_MIC + int(p[P.BANDS])) * mics


@kernel
def flexure(p, s, z, mics):
    """Velocities (m/s) of the flexural coordinates, after the balls and so many microphones."""
    count = 2 * int(p[P.MODES])
    to = flexures(p, mics)
    at = flexure_state(p) + count
    for i in range(count):
        z[to + i] = s[at + i]


@kernel
def observe(p, s, z):
    """Fill ``z`` (see ``layout``) from the state ``s``."""
    observe_motion(p, s, z, int(p[P.MICS]))
    if p[P.SOUND_SIZE] != 0.0 and p[P.READ_SOUND] != 0.0:
        mics = Z.BALLS + Z.PER_BALL * int(p[P.BALLS])
        levels(sound_block(p), s[S.SOUND :], z, mics)
    if p[P.READ_SENSORS] != 0.0:
        at = flexures(p, int(p[P.MICS])) + 2 * int(p[P.MODES]) + Z.PER_DEFECT * int(p[P.DEFECTS])
        accelerometer.observe(p, s, z, at)


@kernel
def observe_motion(p, s, z, mics):
    """All outputs but the microphones', for whose number ``mics`` room is left."""
    bodies(p, s, z)
    z[Z.TORQUE] = s[S.F + F.TORQUE]
    z[Z.MEAN_TORQUE] = s[S.MEAN_TORQUE]
    for i in range(3):
        z[Z.HEAT + i] = s[S.MEAN_HEAT + i]
    if knows_balls(p, s):
        balls(p, s, z)
        contacts(p, s, z)
    losses(p, s, z)
    if p[P.FITS] != 0.0:
        fits(p, s, z)
    clearance(s, z)
    flexure(p, s, z, mics)
    if p[P.DEFECTS] != 0.0:
        observe_defects(p, s, z, flexures(p, mics) + 2 * int(p[P.MODES]))
    z[Z.STEPS] = s[S.STEPS]
    z[Z.REJECTED] = s[S.REJECTED]
    z[Z.RESTARTS] = s[S.RESTARTS]
    z[Z.GROWTH] = s[S.GROWTH]
    z[Z.WAVE_TIME] = wave_time(p, s[S.SPEED])
    lost = s[S.HEAT] + s[S.HEAT + 1] + s[S.HEAT + 2]
    gained = s[S.ENERGY_NOW] - s[S.ENERGY_START]
    enough = lost > 1e-12 + LITTLE_LOST * abs(s[S.ENERGY_NOW])
    z[Z.RESIDUAL] = (s[S.WORK] - lost - gained) / lost if enough else 0.0
