"""A bearing whose rings are held: forces, stiffness, balls (Jones 1960; Harris 2006, ch. 3 and 5).

``forces_at_displacement(p, c, speed, ring, tilt, share, force, out, w) -> status``

* ``p``, ``c``: parameters and conditions; ``speed`` of the inner ring (rad/s).
* ``ring``: x y z by bz (m, rad) of the inner ring against the outer one, ``tilt``: y z (rad) of the outer.
* ``share`` of the imperfections, ball sizes and race waviness: 1, or 0 for a perfect bearing.
* ``force``: of the balls on the inner ring, x y z (N) and moments y z about its centre (N m).
* ``out``: ``EQ.SIZE`` numbers, places of ``layout.EQ``: ``ring``, residual of the worst ball (N), stiffness
  5 x 5, then per ball place, orbit speed, spin, loads, contact angles. Outer ring's centre at the origin.
* ``w``: work space; the kernels get ``v``, its area ``W.STATICS`` with the places of ``layout.ST``.
* status ``OK``, or ``NO_START`` where a ball's residual stays above 1e-6 of the forces and 0.01 N, which slow
  balls that nothing presses may lack.

Where bearings rest is found in displacements (``spindle.rest``). The ball rolls without slip at the middle of
both contacts. Who carries the gyroscopic moment, and how the spin axis pitches, is ``P.RACE_CONTROL``.
Geometry is that of fidelity `full` (``mechanics``); ball weight, drag, cage, rolling resistance and traction
along the rolling direction are left out.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import lane, splat
from fmu_bearing.engine.layout import EQ, ST, STRIDE, C, P, Q, W
from fmu_bearing.engine.mechanics.contact import approach_under, race_surface
from fmu_bearing.engine.statics.axial import TOUCHING
from fmu_bearing.engine.statics.ball_balance import ball_equilibrium, ball_state, pose_at
from fmu_bearing.engine.statics.stiffness import add_turned, ball_share
from fmu_bearing.engine.status import NO_START, OK


@kernel
def imperfection_approach(p, c, race, j, angle):
    """How much oversize of ball ``j`` and waviness of a race at ``angle`` (rad) deepen the approach (m).

    Both rings' own angles are zero.
    """
    height = 0.5 * p[int(p[P.AT_OVERSIZE]) + j]
    if p[P.WAVINESS] != 0.0:
        wave, _, _ = race_surface(p, race, splat(angle / (2.0 * PI) * p[P.WAVE_INTERVALS]))
        height += lane(wave, 0)
    return c[C.OVERSIZE_SCALE] * height


@kernel
def place_first(p, c, shift, offset, share, v):
    """Angles and first places of the balls: on the line of groove centres, approach shared by compliance."""
    balls = int(p[P.BALLS])
    inner = C.RACES
    outer = C.RACES + C.RACE_SIZE
    sx = c[inner + C.GROOVE_X] + shift - c[outer + C.GROOVE_X]
    sr = c[inner + C.GROOVE_RADIUS] - c[outer + C.GROOVE_RADIUS]
    length = math.sqrt(sx * sx + sr * sr)
    one = approach_under(p[P.RACES + P.RACE_STIFFNESS], 1.0)
    other = approach_under(p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS], 1.0)
    part = other / (one + other)
    reach = (c[outer + C.FREE] + part * max(length - c[outer + C.FREE] - c[inner + C.FREE], 0.0)) / length
    for j in range(balls):
        angle = 2.0 * PI * j / balls
        cj = math.cos(angle)
        sj = math.sin(angle)
        lean = sj * offset[1] + cj * offset[0]
        x = c[outer + C.GROOVE_X] + reach * sx
        radius = c[outer + C.GROOVE_RADIUS] + reach * sr
        v[ST.COS + j] = cj
        v[ST.SIN + j] = sj
        for race in range(2):
            v[ST.DEEPER + race * STRIDE + j] = share * imperfection_approach(p, c, race, j, angle)
        v[ST.X + j] = x + radius * lean
        v[ST.R + j] = radius - x * lean - p[P.PITCH_RADIUS]


@kernel
def pose_of(v, j, ring, offset):
    """`Pose` of ball ``j`` with the inner ring at ``ring`` and the outer one tilted by ``offset``."""
    return pose_at(v[ST.COS + j], v[ST.SIN + j], ring, offset, v[ST.DEEPER + j], v[ST.DEEPER + STRIDE + j])


@kernel
def settle_balls(p, c, speed, offset, ring, v, g):
    """Settle all balls and put what they do to the inner ring to ``g`` (N, N m); their worst residual (N)."""
    radius = c[C.BALL_RADIUS]
    worst = 0.0
    for i in range(EQ.FREEDOMS):
        g[i] = 0.0
    for j in range(int(p[P.BALLS])):
        cj = v[ST.COS + j]
        sj = v[ST.SIN + j]
        pose = pose_of(v, j, ring, offset)
        x, r, size = ball_equilibrium(p, c, speed, pose, v[ST.X + j], v[ST.R + j])
        v[ST.X + j] = x
        v[ST.R + j] = r
        worst = max(worst, size)
        ball = ball_state(p, c, speed, pose, x, r)
        qi = ball.load_inner
        rub = ball.friction_inner
        fx = qi * ball.inner_ex - rub * ball.cosine_inner
        fr = qi * ball.inner_er + rub * ball.sine_inner
        ft = qi * ball.inner_et
        # about the ring's centre, at the contact's middle
        ax = x - pose.x + radius * ball.inner_ex
        ar = p[P.PITCH_RADIUS] + r - pose.r + radius * ball.inner_er
        at = -pose.t + radius * ball.inner_et
        mr = at * fx - ax * ft
        mt = ax * fr - ar * fx
        g[Q.X] += fx
        g[Q.Y] += -sj * fr - cj * ft
        g[Q.Z] += cj * fr - sj * ft
        g[Q.INNER_BY] += -sj * mr - cj * mt
        g[Q.INNER_BZ] += cj * mr - sj * mt
    return worst


@kernel
def outer_moment(p, c, speed, offset, found, v):
    """Moments y, z (N m) of the balls on the outer ring about its centre, ``found`` as above."""
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
def write_equilibrium(p, c, speed, offset, v, out):
    """Write each ball's place, motion, loads and contact angles into ``out``."""
    ring = out[EQ.SHIFT : EQ.SHIFT + EQ.FREEDOMS]
    for j in range(int(p[P.BALLS])):
        x = v[ST.X + j]
        r = v[ST.R + j]
        ball = ball_state(p, c, speed, pose_of(v, j, ring, offset), x, r)
        out[EQ.X + j] = x
        out[EQ.R + j] = r
        out[EQ.OM + j] = ball.orbit
        out[EQ.WX + j] = ball.wx
        out[EQ.WR + j] = ball.wr
        out[EQ.LOAD_I + j] = ball.load_inner
        out[EQ.LOAD_O + j] = ball.load_outer
        out[EQ.ANGLE_I + j] = math.atan2(ball.sine_inner, ball.cosine_inner)
        out[EQ.ANGLE_O + j] = math.atan2(ball.sine_outer, ball.cosine_outer)


@kernel
def forces_at_displacement(p, c, speed, ring, tilt, share, force, out, w):
    """Settle all balls between held rings, see the module; status code.

    Nothing is kept from call to call: every ball starts on the line of the groove centres.
    """
    v = w[W.STATICS : W.STATICS + ST.SIZE]
    for i in range(EQ.SIZE):
        out[i] = 0.0
    place_first(p, c, ring[Q.X], tilt, share, v)
    worst = settle_balls(p, c, speed, tilt, ring, v, force)
    a = v[ST.SHARE : ST.SHARE + ST.SHARE_SIZE]
    for j in range(int(p[P.BALLS])):
        ball_share(p, c, pose_of(v, j, ring, tilt), v[ST.X + j], v[ST.R + j], a)
        add_turned(v[ST.COS + j], v[ST.SIN + j], a, out, EQ.STIFFNESS)
    total = 0.0
    for i in range(EQ.FREEDOMS):
        out[EQ.SHIFT + i] = ring[i]
        total += abs(force[i]) / (1.0 if i < Q.INNER_BY else p[P.PITCH_RADIUS])
    out[EQ.RESIDUAL] = worst
    write_equilibrium(p, c, speed, tilt, v, out)
    return OK if worst <= TOUCHING + 1e-6 * total else NO_START
