"""Quasi-static equilibrium with the outer ring on its pedestal: the tilt at which its moments balance."""

from fmu_bearing.engine.dense import eliminate
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, ST, C, P, Q, W
from fmu_bearing.engine.statics.ball_balance import ball_state
from fmu_bearing.engine.statics.quasistatic import pose_of, solve_ring
from fmu_bearing.engine.status import OK

_ROUNDS = 25
_LARGEST = 2e-3  # rad: longest step of the outer ring's tilt
_REACH = 5e-3  # rad: beyond it equations for small tilts mean little


@kernel
def outer_moment(p, c, speed, offset, found, v):
    """Moments y, z (N m) of the balls on the outer ring about its centre at the equilibrium ``found``."""
    radius = c[C.BALL_RADIUS]
    ring = found[EQ.SHIFT : EQ.SHIFT + EQ.FREEDOMS]
    my = 0.0
    mz = 0.0
    for j in range(int(p[P.BALLS])):
        cj = v[ST.COS + j]
        sj = v[ST.SIN + j]
        x = found[EQ.X + j]
        r = found[EQ.R + j]
        ball = ball_state(p, c, speed, pose_of(v, j, ring, offset), x, r)
        load = ball.load_outer
        rub = ball.friction_outer
        ex, er, et = ball.outer_ex, ball.outer_er, ball.outer_et
        fx = load * ex + rub * ball.cosine_outer
        fr = load * er - rub * ball.sine_outer
        ft = load * et
        ax = x + radius * ex
        ar = p[P.PITCH_RADIUS] + r + radius * er
        at = radius * et
        mr = at * fx - ax * ft
        mt = ax * fr - ar * fx
        my += -sj * mr - cj * mt
        mz += cj * mr - sj * mt
    return my, mz


@kernel
def support_column(p, k, found, v):
    """How the inner ring's tilts (y, z) follow a unit tilt ``k`` (0 y, 1 z) of the outer ring (rad/rad)."""
    rows = v[ST.SUPPORT : ST.SUPPORT + ST.SYSTEM_SIZE]
    pitch = p[P.PITCH_RADIUS]
    last = EQ.FREEDOMS
    for i in range(EQ.FREEDOMS):
        at = ST.ROW * i
        for n in range(EQ.FREEDOMS):
            rows[at + n] = found[EQ.STIFFNESS + EQ.FREEDOMS * i + n]
        rows[at + last] = rows[at + Q.INNER_BY + k]
        # the floor is that of solve_ring: N/m, at the pitch radius
        rows[at + i] += 1.0 if i < Q.INNER_BY else p[P.TILT_STIFFNESS] + pitch * pitch
    if not eliminate(rows, 0, EQ.FREEDOMS):
        return 0.0, 0.0
    return rows[ST.ROW * Q.INNER_BY + last], rows[ST.ROW * Q.INNER_BZ + last]


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
    v = w[W.STATICS : W.STATICS + ST.SIZE]
    turn = c[C.PEDESTAL_ROTATIONAL]
    tilt[0] = p[P.MISALIGNMENT_Y]
    tilt[1] = p[P.MISALIGNMENT_Z]
    status = OK
    for n in range(_ROUNDS):
        status = solve_ring(p, c, speed, load, tilt, share, found, v)
        if status != OK:
            break
        my, mz = outer_moment(p, c, speed, tilt, found, v)
        my -= turn * (tilt[0] - p[P.MISALIGNMENT_Y])
        mz -= turn * (tilt[1] - p[P.MISALIGNMENT_Z])
        support = p[P.TILT_STIFFNESS]
        yy, zy = support_column(p, 0, found, v)
        yz, zz = support_column(p, 1, found, v)
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
