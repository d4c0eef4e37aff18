"""Step control: how large an error may be, and how long the next step is."""

import math

from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import P, Q, S, Y

# What the tolerance refers to at least and at most, over the velocity of a 5 um amplitude at shaft speed, of
# which rings of usual waviness reach 0.4 to 2.4. Rings at rest need not be resolved. Where a jump of load
# throws them at metres per second, the balls still move on their own scale; the energy balance needs them.
_QUIET = 0.1
_LOUD = 4.0
_MEMORY = 2e-3  # s, of the rings' mean square velocity: some periods of their modes
_AT_ONCE = 0.25  # of the present square: rings thrown by a jump of load need not be seen for milliseconds
# Share of the tolerance that one step's estimate may take. Errors of many steps add up while the rings' modes
# ring: over 20 ms and ten cases the error was one to thirty times the largest estimate.
_SHARE = 0.1
# Share of the tolerance that Newton's method may leave in a stage, in steps of 10 us and more. Shorter ones
# are many, and each leaves its remainder: half a millisecond after its start under radial load a bare 7003C
# at 20,000 r/min takes steps of 2 us. Bound for 5 us and more, the error over 5 ms is 5e-2 there, not 8e-4.
# With a half the spindle under 1000 N has an error of 1.2e-3 at a tolerance of 1e-3, not 9e-4.
_NEWTON = 0.35
_USUAL = 1e-5  # s
_SAFETY = 0.9  # of the length that would just be allowed
_FADE = 0.8  # per step: how fast a large estimate is forgotten
# A change of length costs a factorisation, as much as four iterations: no longer step for less than half as
# long again, no shorter one before the estimate comes near to what is allowed.
_WORTHWHILE = 1.5
_NEAR = 0.9
_LARGEST = 2.0  # growth at once
_SMALLEST = 0.2  # shrinkage at once
_DIVERGED = 0.5  # shrinkage where Newton's method failed
# Contraction with a new Jacobian that halves the way to failure: each stage then takes three iterations.
_SLOWEST = 0.5


@kernel
def allowed_velocity(p, s, speed):
    """Error (m/s) in the rings' velocities that the tolerance means at present.

    It is relative to the rings' own root mean square velocity over the last milliseconds, within bounds that
    go with the shaft ``speed`` (rad/s).
    """
    usual = steps.velocity_tolerance(p, speed)
    return min(_LOUD * usual, max(_QUIET * usual, p[P.TOLERANCE] * math.sqrt(s[S.RING_SQUARE])))


@kernel
def allowed_estimate(tolerance):
    """Estimate (m/s) of a step's error that is accepted under a ``tolerance`` (m/s)."""
    return _SHARE * tolerance


@kernel
def allowed_remainder(tolerance, h):
    """Error (m/s) that Newton's method may leave in a stage of a step ``h`` (s)."""
    share = min(1.0, h / _USUAL)
    return _NEWTON * tolerance * share * share


@kernel
def follow_rings(s, h):
    """Take the rings' velocities at the end of a step ``h`` (s) into their fading mean square."""
    square = 0.0
    for i in range(3):
        inner = s[S.Y + Y.V0 + i]
        outer = s[S.Y + Y.V0 + Q.OUTER + i]
        square += inner * inner + outer * outer
    faded = s[S.RING_SQUARE] + (square - s[S.RING_SQUARE]) * h / (_MEMORY + h)
    s[S.RING_SQUARE] = max(faded, _AT_ONCE * square)


@kernel
def shrinkage(s, error, order):
    """Factor on a rejected step's length; ``error`` over what is allowed, -1 where Newton's method failed."""
    if not (error > 0.0):
        s[S.PEAK] = 1.0
        return _DIVERGED
    factor = max(_SMALLEST, _SAFETY * error ** (-1.0 / order))
    s[S.PEAK] = min(1.0, error * factor**order)
    return factor


@kernel
def propose(s, error, contraction, length, longest, order):
    """Set the next step's length (s) in ``s`` after an accepted one of ``length``.

    ``error``: estimate over what is allowed; ``contraction``: measured with a Jacobian made for this step, or
    0; ``order``: of the estimate. Newton's method contracts about in proportion to the step.
    """
    present = max(error, (contraction / _SLOWEST) ** order)
    peak = max(present, _FADE * s[S.PEAK])
    s[S.PEAK] = peak
    grow = min(_LARGEST, _SAFETY * (peak + 1e-6) ** (-1.0 / order))
    # a step cut to meet the communication point says nothing against a longer one
    longer = grow >= _WORTHWHILE and length > 0.5 * s[S.STEP]
    shorter = grow < 1.0 and present > _NEAR
    if longer or shorter:
        wanted = max(length * grow, s[S.STEP]) if longer else length * grow
        s[S.STEP] = min(longest, wanted)
        s[S.PEAK] = min(1.0, peak * (s[S.STEP] / length) ** order)
