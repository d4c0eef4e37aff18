"""From the state of a set to its outputs: every bearing's, in shaft axes, and the shaft's."""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, P, Q, S, Z
from fmu_bearing.engine.readout.contacts import knows_balls
from fmu_bearing.engine.readout.outputs import LITTLE_LOST, observe_motion
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.port import observe_port
from fmu_bearing.engine.spindle.shaft import has_housing
from fmu_bearing.engine.spindle.sound_sum import levels_of_set, observe_accelerometers


@kernel
def mirror(pb, sign, known, z):
    """Turn outputs along a bearing's own axis into shaft axes, where its ``sign`` is -1.

    ``known``: whether the balls' were written.
    """
    if sign > 0.0:
        return
    for place in (Z.INNER_VELOCITY, Z.OUTER_VELOCITY, Z.CAGE_VELOCITY, Z.INNER_PLACE, Z.OUTER_PLACE):
        z[place] = -z[place]
    for i in range(2):
        z[Z.TILT + i] = -z[Z.TILT + i]
    for j in range(int(pb[P.BALLS]) if known else 0):
        z[Z.BALLS + Z.PER_BALL * j] = -z[Z.BALLS + Z.PER_BALL * j]


@kernel
def observe_bearings(p, s, z):
    """Fill the outputs of every bearing, and those that add up over them."""
    own = members.set_state(p, s)
    at = int(p[int(p[P.SET]) + SP.AT_Z])
    for i in range(Z.HEAT_SIZE):
        z[at + SP.Z_HEAT + i] = 0.0
    z[at + SP.Z_TORQUE] = 0.0
    z[at + SP.Z_MEAN_TORQUE] = 0.0
    z[at + SP.Z_WAVE_TIME] = 1.0
    for b in range(members.bearing_count(p)):
        zb = members.outputs(p, z, b)
        sign = p[members.row(p, b) + SP.ROW_SIGN]
        pb = members.parameters(p, b)
        observe_motion(pb, members.state(p, s, b), zb, 0)
        mirror(pb, sign, knows_balls(p, members.state(p, s, b)), zb)
        for i in range(Z.HEAT_SIZE):
            z[at + SP.Z_HEAT + i] += zb[Z.HEAT + i]
        z[at + SP.Z_TORQUE] += zb[Z.TORQUE]
        z[at + SP.Z_MEAN_TORQUE] += zb[Z.MEAN_TORQUE]
        z[at + SP.Z_WAVE_TIME] = min(z[at + SP.Z_WAVE_TIME], zb[Z.WAVE_TIME])
        to = at + SP.Z_FORCES + SP.Z_FORCE * b
        for i in range(SP.PLANE):
            along = i == Q.X or i >= Q.INNER_BY
            z[to + i] = own[members.per_bearing(p, b) + SP.LOAD + i] * (sign if along else 1.0)
    for i in range(2):
        z[at + SP.Z_HEAT + i] += own[SP.MEAN_HEAT + i]


@kernel
def observe_shaft(p, s, z):
    """Nose of the shaft, what resists it, and the housing."""
    own = members.set_state(p, s)
    lanes = members.padded_size(p)
    at = int(p[int(p[P.SET]) + SP.AT_Z])
    nose = members.table(p, SP.AT_NOSE)
    for i in range(SP.PLANE):
        place = 0.0
        rate = 0.0
        for k in range(lanes):
            place += p[nose + i * lanes + k] * own[SP.S_HEAD + k]
            rate += p[nose + i * lanes + k] * own[SP.S_HEAD + lanes + k]
        z[at + SP.Z_NOSE + i] = place
        if i < Q.INNER_BY:
            z[at + SP.Z_NOSE_VELOCITY + i] = rate
    for i in range(3):
        z[at + SP.Z_STIFFNESS + i] = own[SP.SHAFT_STIFFNESS + i]
    if has_housing(p):
        h = SP.S_HEAD + int(p[int(p[P.SET]) + SP.SHAFT])
        lever = p[int(p[P.SET]) + SP.HOUSING_X]
        for i in range(2):
            out = at + (SP.Z_HOUSING if i == 0 else SP.Z_HOUSING_VELOCITY)
            x = h + i * lanes
            z[out] = own[x]
            z[out + Q.Y] = own[x + Q.Y] + lever * own[x + Q.BZ]
            z[out + Q.Z] = own[x + Q.Z] - lever * own[x + Q.BY]


@kernel
def observe_set(p, s, z):
    """Fill ``z`` of a set from its state."""
    observe_bearings(p, s, z)
    observe_shaft(p, s, z)
    levels_of_set(p, s, z)
    mics = int(p[P.MICS])
    alone = members.z_mics(p) + (Z.PER_MIC + int(p[P.BANDS])) * mics
    observe_accelerometers(p, s, z, alone + members.bearing_count(p) * mics)
    own = members.set_state(p, s)
    at = int(p[int(p[P.SET]) + SP.AT_Z])
    observe_port(p, own, z, at)
    z[at + SP.Z_STEPS] = s[S.STEPS]
    z[at + SP.Z_REJECTED] = s[S.REJECTED]
    z[at + SP.Z_RESTARTS] = s[S.RESTARTS]
    z[at + SP.Z_GROWTH] = s[S.GROWTH]
    work = own[SP.WORK]
    lost = own[SP.HEAT] + own[SP.HEAT + 1]
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        work += sb[S.WORK]
        lost += sb[S.HEAT] + sb[S.HEAT + 1] + sb[S.HEAT + 2]
    gained = s[S.ENERGY_NOW] - s[S.ENERGY_START]
    enough = lost > 1e-12 + LITTLE_LOST * abs(s[S.ENERGY_NOW])
    z[at + SP.Z_RESIDUAL] = (work - lost - gained) / lost if enough else 0.0
