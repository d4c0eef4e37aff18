"""What all ways of stepping share: allowed error, division of a communication step, clock, mean heats."""

import math

from fmu_bearing.engine.constants import STANDSTILL
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import P, S
from fmu_bearing.engine.mechanics.trigonometry import wrap

# A step (s) that must be shorter has not converged. Where a cage is flung through its lands' film the film's
# force swings over within 0.3 ns, which takes steps of 10 ps.
SHORTEST = 1e-12
# Amplitude (m) whose velocity at shaft speed the relative tolerance refers to: 10 mm/s at 20,000 r/min, as
# rings vibrate there; the slowest speed (rad/s) for which it shrinks with speed.
_AMPLITUDE = 5e-6
_SLOWEST = 20.0


@kernel
def velocity_tolerance(p, speed):
    """Error (m/s) allowed in the rings' velocities at a shaft speed (rad/s)."""
    return p[P.TOLERANCE] * _AMPLITUDE * max(abs(speed), _SLOWEST)


@kernel
def most_attempts(h, longest, factor):
    """Return the attempts allowed over ``h`` (s): ``factor`` times what the longest step (s) would need."""
    return 2000.0 + factor * math.ceil(h / longest)


@kernel
def unfinished(remaining, h, end):
    """Whether ``remaining`` (s) of the communication step ``h`` to time ``end`` is more than rounding."""
    return remaining > 1e-12 * h + 4e-16 * abs(end)


@kernel
def even_length(remaining, longest):
    """Length (s) of equal steps over ``remaining`` (s), none longer than ``longest``."""
    return remaining / max(1.0, math.ceil(remaining / longest - 1e-9))


@kernel
def rejected(s, shorter, h):
    """Count a rejected step, propose ``shorter`` (s); whether that is long enough to go on with.

    ``h``: the communication step (s), which may itself be short.
    """
    s[S.REJECTED] += 1.0
    s[S.STEP] = shorter
    return not (shorter < min(SHORTEST, 0.01 * h))


@kernel
def advance_clock(s, h):
    """Shaft angle, speed, time and count at the end of a step ``h`` (s)."""
    s[S.ANGLE] = wrap(s[S.ANGLE] + h * (s[S.SPEED] + 0.5 * h * s[S.SPEED_RATE]))
    s[S.SPEED] += h * s[S.SPEED_RATE]
    s[S.TIME] += h
    s[S.STEPS] += 1.0


@kernel
def begin_means(s):
    """Keep the heats so far (J) where :func:`end_means` turns them into means; no work of the shaft yet."""
    for i in range(3):
        s[S.MEAN_HEAT + i] = s[S.HEAT + i]
    s[S.SHAFT_WORK] = 0.0
    s[S.TORQUE_TIME] = 0.0


@kernel
def end_means(s, h):
    """Mean heats (W) and torque (N m) over the communication step ``h`` (s) since :func:`begin_means`.

    The torque is the shaft's work over the angle turned, so that mean torque times mean speed is the mean
    power. Where the shaft is still or turns back, the work says nothing about the torque: there it is the
    mean over time.
    """
    for i in range(3):
        s[S.MEAN_HEAT + i] = (s[S.HEAT + i] - s[S.MEAN_HEAT + i]) / h
    begin = s[S.SPEED] - h * s[S.SPEED_RATE]
    turning = 0.5 * (begin + s[S.SPEED])
    # the speed at the begin, known but for rounding, must not decide where a run-up starts from rest
    slowest = min(begin, s[S.SPEED]) if turning > 0.0 else -max(begin, s[S.SPEED])
    if slowest >= -STANDSTILL and abs(turning) > STANDSTILL:
        s[S.MEAN_TORQUE] = s[S.SHAFT_WORK] / (turning * h)
    else:
        s[S.MEAN_TORQUE] = s[S.TORQUE_TIME] / h
