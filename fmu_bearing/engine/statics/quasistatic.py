"""Quasi-static equilibrium of the bearing in five degrees of freedom (Jones 1960; Harris 2006, ch. 3 and 5).

``equilibrium(p, c, speed, load, offset, out, w) -> status``

* ``p``, ``c``: parameters and conditions; ``speed`` of the inner ring (rad/s).
* ``load``: forces x y z (N) and moments y z (N m) on the inner ring about its centre.
* ``offset``: tilts y z (rad) of the outer ring, which is held; the tilt support of the inner ring
  (``P.TILT_STIFFNESS``) has its neutral place at zero.
* ``out``: ``EQ.SIZE`` numbers, places of ``layout.EQ``: displacement of the inner ring against the outer,
  residual (N), iterations, stiffness 5 x 5 (bearing alone, without the tilt support), then per ball place,
  orbit speed, spin, loads, contact angles. Outer ring's centre at the origin.
* ``w``: work space; the kernels get ``v``, its area ``W.STATICS`` with the places of ``layout.ST``.
* status ``OK``, or ``NO_START`` where the residual stays above 1e-6 of the load.

The ball rolls without slip at the middle of both contacts. Who carries the gyroscopic moment, and how the
spin axis pitches, is ``P.RACE_CONTROL``. Geometry is that of fidelity `full` (``mechanics``);
ball weight, drag, cage, rolling resistance and traction along the rolling direction are left out.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.dense import eliminate
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import lane, splat
from fmu_bearing.engine.layout import EQ, ST, STRIDE, C, P, Q, W
from fmu_bearing.engine.mechanics.contact import approach_under, hertz, race_surface
from fmu_bearing.engine.statics.ball_balance import ball_equilibrium, ball_state, pose_at
from fmu_bearing.engine.statics.stiffness import add_turned, ball_share
from fmu_bearing.engine.status import NO_START, OK

_ITERATIONS = 200
_BACKTRACKS = 10
# Longest step of the ring (m; tilts times pitch radius): some tenths of the groove centres' distance.
_LONGEST = 2e-5
_PATIENCE = 25
_MOVE = 1e-10
_FLOOR = 1.0  # N/m: Levenberg term; moves a ring that nothing holds by the longest step at most


@kernel
def axial_guess(p, c, force):
    """Axial displacement (m) of equal static balls under ``force`` (N); coarse: it starts a Newton method."""
    inner = C.RACES
    outer = C.RACES + C.RACE_SIZE
    apart = c[inner + C.GROOVE_X] - c[outer + C.GROOVE_X]
    across = c[inner + C.GROOVE_RADIUS] - c[outer + C.GROOVE_RADIUS]
    free = c[inner + C.FREE] + c[outer + C.FREE]
    under = approach_under(p[P.RACES + P.RACE_STIFFNESS], 1.0)  # a newton, of both contacts
    under += approach_under(p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS], 1.0)
    side = 1.0 if force >= 0.0 else -1.0
    # distance of the groove centres along x, where the balls just touch and where they certainly carry it
    low = math.sqrt(max(free * free - across * across, 0.0))
    high = low + 0.5 * free
    for _ in range(30):
        reach = 0.5 * (low + high)
        length = math.sqrt(reach * reach + across * across)
        carried, _, _ = hertz(p[P.BALLS], (length - free) / under)
        if carried * reach / length > abs(force):
            high = reach
        else:
            low = reach
    return side * low - apart


@kernel
def deeper(p, c, race, j, angle):
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
            v[ST.DEEPER + race * STRIDE + j] = share * deeper(p, c, race, j, angle)
        v[ST.X + j] = x + radius * lean
        v[ST.R + j] = radius - x * lean - p[P.PITCH_RADIUS]


@kernel
def pose_of(v, j, ring, offset):
    """`Pose` of ball ``j`` with the inner ring at ``ring`` and the outer one tilted by ``offset``."""
    return pose_at(v[ST.COS + j], v[ST.SIN + j], ring, offset, v[ST.DEEPER + j], v[ST.DEEPER + STRIDE + j])


@kernel
def follow(v, j, share, x, r):
    """Place of ball ``j`` after ``share`` of the ring's step, from (x, r) along the last tangent."""
    cj = v[ST.COS + j]
    sj = v[ST.SIN + j]
    step = v[ST.STEP : ST.STEP + EQ.FREEDOMS]
    around = -cj * step[Q.Y] - sj * step[Q.Z]
    outwards = cj * step[Q.Z] - sj * step[Q.Y]
    tilt_r = cj * step[Q.INNER_BZ] - sj * step[Q.INNER_BY]
    tilt_t = -cj * step[Q.INNER_BY] - sj * step[Q.INNER_BZ]
    for k in range(EQ.FREEDOMS):
        move = step[Q.X]
        if k == ST.OUTWARDS:
            move = outwards
        elif k == ST.AROUND:
            move = around
        elif k == ST.TILT_R:
            move = tilt_r
        elif k == ST.TILT_T:
            move = tilt_t
        x += share * move * v[ST.FOLLOW_X + k * STRIDE + j]
        r += share * move * v[ST.FOLLOW_R + k * STRIDE + j]
    return x, r


@kernel
def ring_forces(p, c, speed, load, offset, ring, v, share, g):
    """Settle all balls and sum what acts on the inner ring: ``g`` forces (N), moments over pitch radius (N).

    Balls start where the last tangent and ``share`` of the step put them; returns their worst residual.
    """
    radius = c[C.BALL_RADIUS]
    worst = 0.0
    for i in range(EQ.FREEDOMS):
        g[i] = load[i]
    for j in range(int(p[P.BALLS])):
        cj = v[ST.COS + j]
        sj = v[ST.SIN + j]
        pose = pose_of(v, j, ring, offset)
        x = v[ST.X + j]
        r = v[ST.R + j]
        if share > 0.0:
            x, r = follow(v, j, share, x, r)
        x, r, size = ball_equilibrium(p, c, speed, pose, x, r)
        v[ST.TRIAL_X + j] = x
        v[ST.TRIAL_R + j] = r
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
    for k in range(2):
        tilt = Q.INNER_BY + k
        g[tilt] -= p[P.TILT_STIFFNESS] * (ring[tilt] + offset[k])
        g[tilt] /= p[P.PITCH_RADIUS]
    return worst


@kernel
def tangent(p, c, offset, ring, v, out):
    """Stiffness of the inner ring against the outer into ``out``; motion of the balls with it into ``v``."""
    for i in range(ST.STIFFNESS_SIZE):
        out[EQ.STIFFNESS + i] = 0.0
    a = v[ST.SHARE : ST.SHARE + ST.SHARE_SIZE]
    for j in range(int(p[P.BALLS])):
        ball_share(p, c, pose_of(v, j, ring, offset), v[ST.X + j], v[ST.R + j], a)
        for k in range(EQ.FREEDOMS):
            v[ST.FOLLOW_X + k * STRIDE + j] = a[ST.DX + k]
            v[ST.FOLLOW_R + k * STRIDE + j] = a[ST.DR + k]
        add_turned(v[ST.COS + j], v[ST.SIN + j], a, out, EQ.STIFFNESS)


@kernel
def difference(p, c, speed, load, offset, ring, v, out):
    """As ``tangent`` but with all forces moving, by differences, the tilt support left out again."""
    g1 = v[ST.TRIAL_FORCE : ST.TRIAL_FORCE + EQ.FREEDOMS]
    pitch = p[P.PITCH_RADIUS]
    for k in range(EQ.FREEDOMS):
        scale = 1.0 if k < Q.INNER_BY else pitch
        unmoved = ring[k]
        ring[k] = unmoved + _MOVE / scale
        ring_forces(p, c, speed, load, offset, ring, v, 0.0, g1)
        ring[k] = unmoved
        for i in range(EQ.FREEDOMS):
            tilt = i >= Q.INNER_BY
            slope = (v[ST.FORCE + i] - g1[i]) / _MOVE * scale * (pitch if tilt else 1.0)
            support = p[P.TILT_STIFFNESS] if i == k and tilt else 0.0
            out[EQ.STIFFNESS + EQ.FREEDOMS * i + k] = slope - support


@kernel
def newton_step(p, out, damping, v):
    """Step of the ring into ``v``, at most ``_LONGEST``; the work along it (N m), not positive if unfit."""
    pitch = p[P.PITCH_RADIUS]
    rows = v[ST.SYSTEM : ST.SYSTEM + ST.SYSTEM_SIZE]
    step = v[ST.STEP : ST.STEP + EQ.FREEDOMS]
    last = EQ.FREEDOMS
    for i in range(EQ.FREEDOMS):
        at = ST.ROW * i
        scale = 1.0 if i < Q.INNER_BY else 1.0 / pitch
        for k in range(EQ.FREEDOMS):
            stiffness = out[EQ.STIFFNESS + EQ.FREEDOMS * i + k]
            rows[at + k] = scale * (1.0 if k < Q.INNER_BY else 1.0 / pitch) * stiffness
        rows[at + i] += damping + (p[P.TILT_STIFFNESS] / (pitch * pitch) if i >= Q.INNER_BY else 0.0)
        rows[at + last] = v[ST.FORCE + i]
    if not eliminate(rows, 0, EQ.FREEDOMS):
        return -1.0
    length = 0.0
    for i in range(EQ.FREEDOMS):
        length = max(length, abs(rows[ST.ROW * i + last]))
    share = min(1.0, _LONGEST / (length + 1e-300))
    ahead = 0.0
    for i in range(EQ.FREEDOMS):
        move = share * rows[ST.ROW * i + last]
        ahead += move * v[ST.FORCE + i]
        step[i] = move if i < Q.INNER_BY else move / pitch
    return ahead


@kernel
def report(p, c, speed, offset, v, out):
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
def norm(g):
    """Length of the five forces ``g``."""
    forces = g[Q.X] * g[Q.X] + g[Q.Y] * g[Q.Y] + g[Q.Z] * g[Q.Z]
    return math.sqrt(forces + g[Q.INNER_BY] * g[Q.INNER_BY] + g[Q.INNER_BZ] * g[Q.INNER_BZ])


@kernel
def keep_trial(p, v):
    """Make the trial place of the balls and the forces there the present ones."""
    for j in range(int(p[P.BALLS])):
        v[ST.X + j] = v[ST.TRIAL_X + j]
        v[ST.R + j] = v[ST.TRIAL_R + j]
    for i in range(EQ.FREEDOMS):
        v[ST.RING + i] = v[ST.TRIAL_RING + i]
        v[ST.FORCE + i] = v[ST.TRIAL_FORCE + i]


@kernel
def search(p, c, speed, load, offset, size, ahead, v):
    """Go along the step in ``v`` until the force along it does not turn round; returns the share gone.

    As for a ball: contacts are springs, and the force along a step says more than a norm of the residual.
    """
    share = 1.0
    ring = v[ST.TRIAL_RING : ST.TRIAL_RING + EQ.FREEDOMS]
    g1 = v[ST.TRIAL_FORCE : ST.TRIAL_FORCE + EQ.FREEDOMS]
    for n in range(_BACKTRACKS):
        for i in range(EQ.FREEDOMS):
            ring[i] = v[ST.RING + i] + share * v[ST.STEP + i]
        ring_forces(p, c, speed, load, offset, ring, v, share, g1)
        after = 0.0
        for i in range(EQ.FREEDOMS):
            after += g1[i] * v[ST.STEP + i] * (1.0 if i < Q.INNER_BY else p[P.PITCH_RADIUS])
        if after >= -0.9 * ahead or norm(g1) < 0.5 * size:
            return share
        if n < _BACKTRACKS - 1:
            share *= min(max(ahead / (ahead - after), 0.1), 0.7)
    return share


@kernel
def solve_ring(p, c, speed, load, offset, share, out, v):
    """As ``equilibrium``, with ``share`` of the imperfections: ball sizes, race waviness (0: none)."""
    for i in range(EQ.SIZE):
        out[i] = 0.0
    shift = axial_guess(p, c, load[Q.X])
    place_first(p, c, shift, offset, share, v)
    for i in range(EQ.FREEDOMS):
        v[ST.RING + i] = shift if i == Q.X else 0.0
        v[ST.STEP + i] = 0.0
    ring = v[ST.RING : ST.RING + EQ.FREEDOMS]
    g = v[ST.FORCE : ST.FORCE + EQ.FREEDOMS]
    ring_forces(p, c, speed, load, offset, ring, v, 0.0, g)
    for i in range(EQ.FREEDOMS):
        v[ST.TRIAL_RING + i] = ring[i]
        v[ST.TRIAL_FORCE + i] = g[i]
    keep_trial(p, v)
    pitch = p[P.PITCH_RADIUS]
    moment = abs(load[Q.INNER_BY]) + abs(load[Q.INNER_BZ])
    total = abs(load[Q.X]) + abs(load[Q.Y]) + abs(load[Q.Z]) + moment / pitch
    rubbed = speed != 0.0 and p[P.GYROSCOPIC] != 0.0
    limit = 1e-8 + 1e-9 * total
    damping = _FLOOR
    done = 0.0
    size = norm(g)
    tangent(p, c, offset, ring, v, out)
    while size > limit and done < _ITERATIONS:
        done += 1.0
        ahead = newton_step(p, out, damping, v)
        if not (ahead > 0.0):
            damping = max(10.0 * damping, 1e3)
            continue
        gone = search(p, c, speed, load, offset, size, ahead, v)
        damping = max(0.3 * damping, _FLOOR) if gone > 0.5 else 4.0 * damping
        keep_trial(p, v)
        size = norm(g)
        tangent(p, c, offset, ring, v, out)
        if rubbed and done > _PATIENCE and size > limit:
            difference(p, c, speed, load, offset, ring, v, out)
    tangent(p, c, offset, ring, v, out)
    for i in range(EQ.FREEDOMS):
        out[EQ.SHIFT + i] = ring[i]
    out[EQ.RESIDUAL] = size
    out[EQ.ITERATIONS] = done
    report(p, c, speed, offset, v, out)
    return OK if size <= 1e-6 * (1.0 + total) else NO_START


@kernel
def equilibrium(p, c, speed, load, offset, out, w):
    """Equilibrium of the inner ring of a perfect bearing (see the module); status code."""
    return solve_ring(p, c, speed, load, offset, 0.0, out, w[W.STATICS : W.STATICS + ST.SIZE])
