"""Equilibrium of equal balls under axial load alone: one unknown, no work space.

The same balls as in ``quasistatic``. A guess for other loads begins here, and places of a preload are these.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import ST, C, P
from fmu_bearing.engine.statics.ball_balance import Pose, ball_equilibrium, ball_state
from fmu_bearing.engine.status import NO_START, OK

_ROUNDS = 100
_BACK = 6  # doublings of 20 um: 1.3 mm
TOUCHING = 0.01  # N: without preload the ring is where the balls just touch, not anywhere free


@kernel
def upright(shift):
    """`Pose` of every ball for two upright rings ``shift`` (m) apart."""
    return Pose(shift, 0.0, 0.0, 1.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0)


@kernel
def axial_force(p, c, speed, shift, x, r):
    """Axial force (N) by which all balls hold the inner ring at ``shift``; the ball's place and residual."""
    pose = upright(shift)
    x, r, size = ball_equilibrium(p, c, speed, pose, x, r)
    ball = ball_state(p, c, speed, pose, x, r)
    force = ball.load_inner * ball.inner_ex - ball.friction_inner * ball.cosine_inner
    return -p[P.BALLS] * force, x, r, size


@kernel
def axial_pull(p, c, speed, way, shift, x, r):
    """As `axial_force`, in the mirror where ``way`` is -1: for a force on the inner ring towards -X."""
    force, x, r, size = axial_force(p, c, speed, way * shift, way * x, r)
    return way * force, way * x, r, size


@kernel
def quasistatic(p, c, speed, out):
    """Equilibrium under the axial preload at ``speed`` (rad/s); status code.

    ``out``: places ``ST.AXIAL_SHIFT`` to ``ST.AXIAL_RESIDUAL``. Bracketing and bisection-safe secant steps:
    bounded work. A preload towards -X, which deep groove bearings carry, too, is found in the mirror.
    """
    way = -1.0 if c[C.PRELOAD] < 0.0 else 1.0
    target = max(way * c[C.PRELOAD], TOUCHING)
    low = -2e-5
    high = 1e-5
    x = 0.0
    r = 0.0
    force = 0.0
    for _ in range(40):
        force, x, r, _ = axial_pull(p, c, speed, way, high, 0.5 * high, r)
        if force >= target:
            break
        low = high
        high += 2e-5
    above = force - target
    force, x, r, size = axial_pull(p, c, speed, way, low, 0.5 * low, 0.0)
    below = force - target
    for _ in range(_BACK):  # tight fits push the free place back
        if below <= 0.0:
            break
        high = low
        above = below
        low *= 2.0
        force, x, r, size = axial_pull(p, c, speed, way, low, 0.5 * low, 0.0)
        below = force - target
    # where nothing pushes the rings together the balls lie in the outer race alone
    shift = low
    here = 0.0
    if below < 0.0:
        for _ in range(_ROUNDS):
            margin = 0.02 * (high - low)
            shift = low - below * (high - low) / (above - below)
            if shift <= low + margin or shift >= high - margin:
                shift = 0.5 * (low + high)
            force, x, r, size = axial_pull(p, c, speed, way, shift, x, r)
            here = force - target
            if here < 0.0:
                low = shift
                below = here
            else:
                high = shift
                above = here
            if abs(here) < 1e-9 * (1.0 + target) or high - low < 1e-18:
                break
    shift *= way
    x *= way
    ball = ball_state(p, c, speed, upright(shift), x, r)
    out[ST.AXIAL_SHIFT] = shift
    out[ST.AXIAL_X] = x
    out[ST.AXIAL_R] = r
    out[ST.AXIAL_OM] = ball.orbit
    out[ST.AXIAL_WX] = ball.wx
    out[ST.AXIAL_WR] = ball.wr
    out[ST.AXIAL_RESIDUAL] = size
    return OK if abs(here) <= 1e-4 * (1.0 + target) and size < 1e-3 else NO_START
