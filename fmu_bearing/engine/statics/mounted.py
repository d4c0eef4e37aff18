"""Quasi-static equilibrium with the outer ring on its pedestal: the tilt at which its moments balance."""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.dense import eliminate
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, C, P, W
from fmu_bearing.engine.layout.sizes import STRIDE
from fmu_bearing.engine.statics.ball_balance import ball_state, friction, poses
from fmu_bearing.engine.statics.quasistatic import DEEPER, solve_ring
from fmu_bearing.engine.status import OK

_ROUNDS = 25
_LARGEST = 2e-3  # rad: longest step of the outer ring's tilt
_REACH = 5e-3  # rad: beyond it equations for small tilts mean little
_SYSTEM = W.POSE + 40 * STRIDE  # scratch behind that of ``solve_ring``: 5 x 6


@kernel
def outer_moment(p, c, speed, offset, found, w):
    """Moments y, z (N m) of the balls on the outer ring about its centre at the equilibrium ``found``."""
    ball = c[C.BALL_RADIUS]
    my = 0.0
    mz = 0.0
    for j in range(int(p[P.BALLS])):
        angle = 2.0 * PI * j / p[P.BALLS]
        cj = math.cos(angle)
        sj = math.sin(angle)
        low = w[W.POSE + DEEPER * STRIDE + j]
        high = w[W.POSE + DEEPER * STRIDE + STRIDE + j]
        pose = poses(cj, sj, found[EQ.SHIFT : EQ.SHIFT + 5], offset, low, high)
        x = found[EQ.X + j]
        r = found[EQ.R + j]
        state = ball_state(p, c, speed, pose, x, r)
        load = state[9]
        _, rub = friction(p, c, state[14], state[16], state[5], load)
        ex, er, et = state[18], state[19], state[20]
        fx = load * ex + rub * state[13]
        fr = load * er - rub * state[12]
        ft = load * et
        ax = x + ball * ex
        ar = p[P.PITCH_RADIUS] + r + ball * er
        at = ball * et
        mr = at * fx - ax * ft
        mt = ax * fr - ar * fx
        my += -sj * mr - cj * mt
        mz += cj * mr - sj * mt
    return my, mz


@kernel
def support_column(p, k, found, w):
    """How the inner ring's tilts (y, z) follow a unit tilt ``k`` (0 y, 1 z) of the outer ring (rad/rad)."""
    rows = w[_SYSTEM : _SYSTEM + 30]
    pitch = p[P.PITCH_RADIUS]
    for i in range(5):
        for n in range(5):
            rows[6 * i + n] = found[EQ.STIFFNESS + 5 * i + n]
        rows[6 * i + 5] = rows[6 * i + 3 + k]
        # the floor is that of solve_ring: N/m, at the pitch radius
        rows[7 * i] += 1.0 if i < 3 else p[P.TILT_STIFFNESS] + pitch * pitch
    if not eliminate(rows, 0, 5):
        return 0.0, 0.0
    return rows[23], rows[29]


@kernel
def kept_near(middle, tilt):
    """``tilt`` (rad) held near the seat's: a lone ring on a very soft seat tips over under load."""
    return min(max(tilt, middle - _REACH), middle + _REACH)


@kernel
def mounted_equilibrium(p, c, speed, load, share, tilt, found, w):
    """Equilibrium of the inner ring (``found``, see ``quasistatic``) and the outer ring's ``tilt`` (rad).

    The pedestal's rotational springs have their neutral place at the misalignment of the seat. Newton's
    method in the two tilts: a moment on the outer ring changes with its tilt only through the tilt support
    of the inner ring, which follows freely without one. Returns the status of the last ring equilibrium.
    """
    turn = c[C.PEDESTAL_ROTATIONAL]
    tilt[0] = p[P.MISALIGNMENT_Y]
    tilt[1] = p[P.MISALIGNMENT_Z]
    status = OK
    for n in range(_ROUNDS):
        status = solve_ring(p, c, speed, load, tilt, share, found, w)
        if status != OK:
            break
        my, mz = outer_moment(p, c, speed, tilt, found, w)
        my -= turn * (tilt[0] - p[P.MISALIGNMENT_Y])
        mz -= turn * (tilt[1] - p[P.MISALIGNMENT_Z])
        support = p[P.TILT_STIFFNESS]
        yy, zy = support_column(p, 0, found, w)
        yz, zz = support_column(p, 1, found, w)
        yy = turn + support * yy
        zz = turn + support * zz
        yz *= support
        zy *= support
        det = yy * zz - yz * zy
        dy = (zz * my - yz * mz) / det
        dz = (yy * mz - zy * my) / det
        # the balls found belong to the tilt they were found at: after the last round it stays
        if abs(dy) + abs(dz) < 1e-9 or n == _ROUNDS - 1:
            break
        tilt[0] = kept_near(p[P.MISALIGNMENT_Y], tilt[0] + min(max(dy, -_LARGEST), _LARGEST))
        tilt[1] = kept_near(p[P.MISALIGNMENT_Z], tilt[1] + min(max(dz, -_LARGEST), _LARGEST))
    return status
