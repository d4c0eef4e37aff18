"""Lower limit of the microphones: a high-pass of second order that starts settled.

Each channel is taken less its slow part, which a tracker of value and slope follows. With constant gains this
is the Butterworth high-pass exactly (`weighting.high_pass_gains`).

A run begins with large constant accelerations (the balls' centripetal one) in the midst of vibration, so
neither zero nor the first sample is the slow part. Until the constant gains have more memory (45 ms), the
slow part is therefore the mean of all samples so far, with weights that grow evenly: of a sine it keeps about
2 / (angular frequency x time)^2, and what the first milliseconds hold fades with the square of time
(expanding memory, Morrison 1969). The corner frequency falls meanwhile, as 1 / (pi x time). The gain of the
slope rises from zero with the square of time, because a sudden one would begin an offset of its own.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SD


@kernel
def high_pass(ps, ss, x, place, count):
    """Filter the channels ``x`` of sample ``count`` in place; into row ``place`` of their history."""
    n = len(x)
    at = int(ps[SD.H_AT_HIGH_PASS])
    gain = ps[at + SD.HIGH_PASS_GAIN]
    follow = ps[at + SD.HIGH_PASS_FOLLOW]
    steer = ps[at + SD.HIGH_PASS_STEER]
    grown = 0.5 * (count + 2.0) * follow
    if grown < 1.0:
        follow /= grown
        steer *= grown * grown
    if count == 0:
        gain = 0.0  # the first sample is the mean of all so far, and has no slope
        steer = 0.0
    state = int(ps[SD.H_S_HIGH_PASS])
    value = ss[state : state + n]
    slope = ss[state + n : state + 2 * n]
    for c in range(n):
        rest = x[c] - (value[c] + slope[c])
        value[c] += slope[c] + follow * rest
        slope[c] += steer * rest
        x[c] = gain * rest
    first = int(ps[SD.H_S_CHANNELS]) + place * n
    y = ss[first : first + n]
    lanes = int(ps[SD.H_AT_FORMED])
    for c in range(n):
        y[int(ps[lanes + c])] = x[c]
