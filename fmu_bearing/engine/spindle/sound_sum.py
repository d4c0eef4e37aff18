"""Sound of a set: filters of all bearings over the same instants, their pressures added before metering.

Each bearing has a sound block of its own, with the microphones' places in its own axes. The outputs of its
filters are added to the first bearing's rows, and the first bearing's meters read the sum:
pressures add, with form scalars energies as between the sources of one bearing. Accelerometers are a
bearing's own.
"""

from fmu_bearing.engine.choices import VECTORS
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SD, P, S, W, Z
from fmu_bearing.engine.readout.motion import sample_bodies, sample_due, sample_motion, sound_block
from fmu_bearing.engine.sound import accelerometer, meter
from fmu_bearing.engine.sound.radiate import filtered, push, waiting
from fmu_bearing.engine.spindle import members


@kernel
def reads_sensors(p):
    """Whether there are accelerometers that are read."""
    return p[P.ACCELEROMETERS] != 0.0 and p[P.READ_SENSORS] != 0.0


@kernel
def sampled(p):
    """Whether motion may be sampled."""
    return p[P.SOUND_SIZE] != 0.0 or p[P.ACCELEROMETERS] != 0.0


@kernel
def emit(p, s, w, h):
    """Take every sample that falls into the step just made; where enough of them wait, filter them."""
    audible = p[P.SOUND_SIZE] != 0.0 and p[P.READ_SOUND] != 0.0 and sound_block(p)[SD.H_LINES] == 0.0
    if not (audible or reads_sensors(p)):
        return
    whole = audible and int(sound_block(p)[SD.H_FORM]) != VECTORS
    while sample_due(s, h):
        for b in range(members.bearing_count(p)):
            pb = members.parameters(p, b)
            sb = members.state(p, s, b)
            wb = members.work(p, w, b)
            if audible:
                sample_motion(pb, sb, wb, whole, h)
                push(sound_block(pb), sb[S.SOUND :], wb[W.MOTION : W.SOUND])
            else:
                sample_bodies(pb, sb, wb, h)
            if reads_sensors(p):
                accelerometer.sense(pb, sb, wb, p[P.METERING_START])
            sb[S.SAMPLE] += 1.0
        if audible and waiting(s[S.SOUND :]) >= SD.BATCH:
            finish_sound(p, s, w)


@kernel
def finish(p, s, w):
    """Let all samples that wait pass every bearing's filters and the meters behind them."""
    finish_sound(p, s, w)
    if reads_sensors(p):
        for b in range(members.bearing_count(p)):
            pb, sb, wb = members.parameters(p, b), members.state(p, s, b), members.work(p, w, b)
            accelerometer.settle(pb, sb, wb, p[P.METERING_START])


@kernel
def finish_sound(p, s, w):
    """Let all samples that wait pass every bearing's filters, then the meters of each and of their sum."""
    if p[P.SOUND_SIZE] == 0.0 or sound_block(p)[SD.H_LINES] != 0.0:
        return
    batch = 0
    for b in range(members.bearing_count(p)):
        ps = sound_block(members.parameters(p, b))
        ss = members.state(p, s, b)[S.SOUND :]
        ws = members.work(p, w, b)[W.SOUND :]
        batch = filtered(ps, ss, ws)
        meter.gather(ps, ss, ws, batch)
    for k in range(batch):
        meter_alone(p, s, w, k)
    for b in range(1, members.bearing_count(p)):
        ps = sound_block(members.parameters(p, b))
        meter.add(sound_block(p), w[W.SOUND :], ps, members.work(p, w, b)[W.SOUND :], batch)
    for k in range(batch):
        meter.follow(sound_block(p), s[S.SOUND :], w[W.SOUND :], k, p[P.TIME_WEIGHTING], p[P.METERING_START])
        for b in range(members.bearing_count(p)):
            members.state(p, s, b)[S.SOUND + SD.SS_COUNT] += 1.0


@kernel
def meter_alone(p, s, w, k):
    """Move the meters of every bearing of a set alone by sample ``k`` of those that wait."""
    count = s[S.SOUND + SD.SS_COUNT] + k
    if not members.has_shaft(p) or not meter.begun(count, p[P.METERING_START]):
        return
    own = members.set_state(p, s)
    fraction = meter.fraction_of(p[P.TIME_WEIGHTING])
    for b in range(members.bearing_count(p)):
        ps = sound_block(members.parameters(p, b))
        ws = members.work(p, w, b)[W.SOUND :]
        at = members.alone(p, b)
        for mic in range(int(p[P.MICS])):
            own[at + mic] += fraction * (meter.square(ps, ws, k, mic) - own[at + mic])


@kernel
def observe_accelerometers(p, s, z, first):
    """Write what all accelerometers read, to ``z[first:]``."""
    if reads_sensors(p):
        for b in range(members.bearing_count(p)):
            accelerometer.observe(members.parameters(p, b), members.state(p, s, b), z, first)


@kernel
def levels_of_set(p, s, z):
    """Write what the microphones read of the sum, then the level of each bearing alone."""
    if p[P.SOUND_SIZE] == 0.0 or p[P.READ_SOUND] == 0.0:
        return
    bearings = members.bearing_count(p)
    mics = int(p[P.MICS])
    meter.levels(sound_block(p), s[S.SOUND :], z, members.z_mics(p))
    own = members.set_state(p, s)
    ss = s[S.SOUND :]
    weight = ss[SD.SS_WEIGHT] if ss[SD.SS_METERED] > 0.0 else 1.0
    to = members.z_mics(p) + (Z.PER_MIC + int(p[P.BANDS])) * mics
    for mic in range(mics):
        for b in range(bearings):
            z[to + mic * bearings + b] = meter.decibel(own[members.alone(p, b) + mic] / weight)
