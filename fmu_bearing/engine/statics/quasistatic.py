"""Quasi-static equilibrium of the bearing in five degrees of freedom (Jones 1960; Harris 2006, ch. 3 and 5).

``equilibrium(p, c, speed, load, offset, out, w) -> status``

* ``p``, ``c``: parameters and conditions; ``speed`` of the inner ring (rad/s).
* ``load``: forces x y z (N) and moments y z (N m) on the inner ring about its centre.
* ``offset``: tilts y z (rad) of the outer ring, which is held; the tilt support of the inner ring
  (``P_TILT_STIFFNESS``) has its neutral place at zero.
* ``out``: ``Q5_SIZE`` numbers, places ``Q5_...`` of ``layout``: displacement of the inner ring against the
  outer, residual (N), iterations, stiffness 5 x 5 (bearing alone, without the tilt support), then per ball
  place, orbit speed, spin, loads, contact angles. Outer ring's centre at the origin.
* ``w``: work space; its rows from ``W_POSE`` on are used.
* status ``OK``, or ``NO_START`` where the residual stays above 1e-6 of the load.

The ball rolls without slip at the middle of both contacts. Who carries the gyroscopic moment, and how the
spin axis pitches, is ``P_RACE_CONTROL``. Geometry is that of the full level (``mechanics.pose``, ``race``);
ball weight, drag, cage, rolling resistance and traction along the rolling direction are left out.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.dense import eliminate
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, C, P, W
from fmu_bearing.engine.layout.sizes import STRIDE
from fmu_bearing.engine.statics.ball_balance import ball_equilibrium, ball_state, poses
from fmu_bearing.engine.statics.stiffness import add_turned, ball_share
from fmu_bearing.engine.status import NO_START, OK

_ITERATIONS = 200
_BACKTRACKS = 10
# Longest step of the ring (m; tilts times pitch radius): some tenths of the groove centres' distance.
_LONGEST = 2e-5
_PATIENCE = 25
_MOVE = 1e-10
_FLOOR = 1.0  # N/m: Levenberg term; moves a ring that nothing holds by the longest step at most
# scratch rows and scalars in the slice of w from W_POSE on
_COS, _SIN, DEEPER, _X, _R, _X1, _R1, _PX, _PR = 0, 1, 2, 4, 5, 6, 7, 8, 13  # prediction: 5 rows each
_RING = 18 * STRIDE  # ring 5, trial 5, forces 5, trial forces 5, step 5
_TRIAL, _G, _G1, _STEP = _RING + 5, _RING + 10, _RING + 15, _RING + 20
_A = _RING + 25  # a ball's share: 35
_ROWS = _A + 35  # linear system: 5 x 6


@kernel
def axial_guess(p, c, force):
    """Axial displacement (m) of equal static balls under ``force`` (N); coarse: it starts a Newton method."""
    o = C.RACES + C.RACE_SIZE
    apart = c[C.RACES] - c[o]
    across = c[C.RACES + 1] - c[o + 1]
    free = c[C.RACES + 2] + c[o + 2]
    k = 2.0 / 3.0
    series = math.exp(-k * math.log(p[P.RACES + P.RACE_STIFFNESS]))
    series += math.exp(-k * math.log(p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS]))
    series = p[P.BALLS] * math.exp(-1.5 * math.log(series))
    side = 1.0 if force >= 0.0 else -1.0
    # distance of the groove centres along x, where the balls just touch and where they certainly carry it
    low = math.sqrt(max(free * free - across * across, 0.0))
    high = low + 0.5 * free
    for _ in range(30):
        reach = 0.5 * (low + high)
        length = math.sqrt(reach * reach + across * across)
        approach = max(length - free, 0.0)
        if series * approach * math.sqrt(approach) * reach / length > abs(force):
            high = reach
        else:
            low = reach
    return side * low - apart


@kernel
def deeper(p, c, race, j, angle):
    """How much oversize of ball ``j`` and waviness of a race at ``angle`` (rad) deepen the approach (m).

    Both rings' own angles are zero. The table is that of ``mechanics.race.waves``, linear between its points.
    """
    scale = c[C.OVERSIZE_SCALE]
    height = 0.5 * p[int(p[P.AT_OVERSIZE]) + j]
    if p[P.WAVINESS] != 0.0:
        table = int(p[P.AT_WAVES]) + race * 2 * P.WAVE_INTERVALS
        place = angle / (2.0 * PI) * P.WAVE_INTERVALS
        below = int(place)
        part = place - below
        first = p[table + 2 * (below % P.WAVE_INTERVALS)]
        second = p[table + 2 * ((below + 1) % P.WAVE_INTERVALS)]
        height += first + part * (second - first)
    return scale * height


@kernel
def place_first(p, c, shift, offset, share, v):
    """Angles and first places of the balls: on the line of groove centres, approach shared by compliance."""
    balls = int(p[P.BALLS])
    o = C.RACES + C.RACE_SIZE
    sx = c[C.RACES] + shift - c[o]
    sr = c[C.RACES + 1] - c[o + 1]
    length = math.sqrt(sx * sx + sr * sr)
    ratio = p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS] / p[P.RACES + P.RACE_STIFFNESS]
    part = 1.0 / (1.0 + math.exp(2.0 / 3.0 * math.log(ratio)))
    reach = (c[o + 2] + part * max(length - c[o + 2] - c[C.RACES + 2], 0.0)) / length
    for j in range(balls):
        angle = 2.0 * PI * j / balls
        cj = math.cos(angle)
        sj = math.sin(angle)
        lean = sj * offset[1] + cj * offset[0]
        x = c[o] + reach * sx
        radius = c[o + 1] + reach * sr
        v[_COS * STRIDE + j] = cj
        v[_SIN * STRIDE + j] = sj
        for race in range(2):
            v[(DEEPER + race) * STRIDE + j] = share * deeper(p, c, race, j, angle)
        v[_X * STRIDE + j] = x + radius * lean
        v[_R * STRIDE + j] = radius - x * lean - p[P.PITCH_RADIUS]


@kernel
def ring_forces(p, c, speed, load, offset, ring, v, share, g):
    """Settle all balls and sum what acts on the inner ring: ``g`` forces (N), moments over pitch radius (N).

    Balls start where the last tangent and ``share`` of the step put them; returns their worst residual.
    """
    ball = c[C.BALL_RADIUS]
    worst = 0.0
    for i in range(5):
        g[i] = load[i]
    step = v[_STEP : _STEP + 5]
    for j in range(int(p[P.BALLS])):
        cj = v[_COS * STRIDE + j]
        sj = v[_SIN * STRIDE + j]
        pose = poses(cj, sj, ring, offset, v[DEEPER * STRIDE + j], v[(DEEPER + 1) * STRIDE + j])
        x = v[_X * STRIDE + j]
        r = v[_R * STRIDE + j]
        if share > 0.0:
            across = -cj * step[1] - sj * step[2]
            along = cj * step[2] - sj * step[1]
            lean_r = cj * step[4] - sj * step[3]
            lean_t = -cj * step[3] - sj * step[4]
            for k in range(5):
                move = step[0]
                if k == 1:
                    move = along
                elif k == 2:
                    move = across
                elif k == 3:
                    move = lean_r
                elif k == 4:
                    move = lean_t
                x += share * move * v[(_PX + k) * STRIDE + j]
                r += share * move * v[(_PR + k) * STRIDE + j]
        x, r, size = ball_equilibrium(p, c, speed, pose, x, r)
        v[_X1 * STRIDE + j] = x
        v[_R1 * STRIDE + j] = r
        worst = max(worst, size)
        state = ball_state(p, c, speed, pose, x, r)
        qi = state[5]
        rub = state[17]
        fx = qi * state[6] - rub * state[11]
        fr = qi * state[7] + rub * state[10]
        ft = qi * state[8]
        # about the ring's centre, at the contact's middle
        ax = x - pose[0] + ball * state[6]
        ar = p[P.PITCH_RADIUS] + r - pose[1] + ball * state[7]
        at = -pose[2] + ball * state[8]
        mr = at * fx - ax * ft
        mt = ax * fr - ar * fx
        g[0] += fx
        g[1] += -sj * fr - cj * ft
        g[2] += cj * fr - sj * ft
        g[3] += -sj * mr - cj * mt
        g[4] += cj * mr - sj * mt
    for k in range(2):
        g[3 + k] -= p[P.TILT_STIFFNESS] * (ring[3 + k] + offset[k])
        g[3 + k] /= p[P.PITCH_RADIUS]
    return worst


@kernel
def tangent(p, c, offset, ring, v, out):
    """Stiffness of the inner ring against the outer into ``out``; motion of the balls with it into ``v``."""
    for i in range(25):
        out[EQ.STIFFNESS + i] = 0.0
    a = v[_A : _A + 35]
    for j in range(int(p[P.BALLS])):
        cj = v[_COS * STRIDE + j]
        sj = v[_SIN * STRIDE + j]
        pose = poses(cj, sj, ring, offset, v[DEEPER * STRIDE + j], v[(DEEPER + 1) * STRIDE + j])
        ball_share(p, c, pose, v[_X * STRIDE + j], v[_R * STRIDE + j], a)
        for k in range(5):
            v[(_PX + k) * STRIDE + j] = a[25 + k]
            v[(_PR + k) * STRIDE + j] = a[30 + k]
        add_turned(cj, sj, a, out, EQ.STIFFNESS)


@kernel
def difference(p, c, speed, load, offset, ring, v, out):
    """As ``tangent`` but with all forces moving, by differences, the tilt support left out again."""
    g1 = v[_G1 : _G1 + 5]
    pitch = p[P.PITCH_RADIUS]
    for k in range(5):
        scale = 1.0 if k < 3 else pitch
        kept = ring[k]
        ring[k] = kept + _MOVE / scale
        ring_forces(p, c, speed, load, offset, ring, v, 0.0, g1)
        ring[k] = kept
        for i in range(5):
            slope = (v[_G + i] - g1[i]) / _MOVE * scale * (1.0 if i < 3 else pitch)
            out[EQ.STIFFNESS + 5 * i + k] = slope - (p[P.TILT_STIFFNESS] if i == k and i > 2 else 0.0)


@kernel
def newton_step(p, out, damping, v):
    """Step of the ring into ``v``, at most ``_LONGEST``; the work along it (N m), not positive if unfit."""
    pitch = p[P.PITCH_RADIUS]
    rows = v[_ROWS : _ROWS + 30]
    step = v[_STEP : _STEP + 5]
    for i in range(5):
        scale = 1.0 if i < 3 else 1.0 / pitch
        for k in range(5):
            rows[6 * i + k] = scale * (1.0 if k < 3 else 1.0 / pitch) * out[EQ.STIFFNESS + 5 * i + k]
        rows[7 * i] += damping + (p[P.TILT_STIFFNESS] / (pitch * pitch) if i > 2 else 0.0)
        rows[6 * i + 5] = v[_G + i]
    if not eliminate(rows, 0, 5):
        return -1.0
    length = 0.0
    for i in range(5):
        length = max(length, abs(rows[6 * i + 5]))
    share = min(1.0, _LONGEST / (length + 1e-300))
    ahead = 0.0
    for i in range(5):
        move = share * rows[6 * i + 5]
        ahead += move * v[_G + i]
        step[i] = move if i < 3 else move / pitch
    return ahead


@kernel
def report(p, c, speed, offset, v, out):
    """Write each ball's place, motion, loads and contact angles into ``out``."""
    ring = out[EQ.SHIFT : EQ.SHIFT + 5]
    for j in range(int(p[P.BALLS])):
        x = v[_X * STRIDE + j]
        r = v[_R * STRIDE + j]
        cj = v[_COS * STRIDE + j]
        sj = v[_SIN * STRIDE + j]
        pose = poses(cj, sj, ring, offset, v[DEEPER * STRIDE + j], v[(DEEPER + 1) * STRIDE + j])
        state = ball_state(p, c, speed, pose, x, r)
        out[EQ.X + j] = x
        out[EQ.R + j] = r
        out[EQ.OM + j] = state[14]
        out[EQ.WX + j] = state[15]
        out[EQ.WR + j] = state[16]
        out[EQ.LOAD_I + j] = state[5]
        out[EQ.LOAD_O + j] = state[9]
        out[EQ.ANGLE_I + j] = math.atan2(state[10], state[11])
        out[EQ.ANGLE_O + j] = math.atan2(state[12], state[13])


@kernel
def norm(g):
    """Length of five numbers."""
    return math.sqrt(g[0] * g[0] + g[1] * g[1] + g[2] * g[2] + g[3] * g[3] + g[4] * g[4])


@kernel
def keep_trial(p, v):
    """Make the trial place of the balls and the forces there the present ones."""
    for j in range(int(p[P.BALLS])):
        v[_X * STRIDE + j] = v[_X1 * STRIDE + j]
        v[_R * STRIDE + j] = v[_R1 * STRIDE + j]
    for i in range(5):
        v[_RING + i] = v[_TRIAL + i]
        v[_G + i] = v[_G1 + i]


@kernel
def search(p, c, speed, load, offset, size, ahead, v):
    """Go along the step in ``v`` until the force along it does not turn round; returns the share gone.

    As for a ball: contacts are springs, and the force along a step tells more than a norm of the residual.
    """
    share = 1.0
    g1 = v[_G1 : _G1 + 5]
    for n in range(_BACKTRACKS):
        for i in range(5):
            v[_TRIAL + i] = v[_RING + i] + share * v[_STEP + i]
        ring_forces(p, c, speed, load, offset, v[_TRIAL : _TRIAL + 5], v, share, g1)
        after = 0.0
        for i in range(5):
            after += g1[i] * v[_STEP + i] * (1.0 if i < 3 else p[P.PITCH_RADIUS])
        if after >= -0.9 * ahead or norm(g1) < 0.5 * size:
            return share
        if n < _BACKTRACKS - 1:
            share *= min(max(ahead / (ahead - after), 0.1), 0.7)
    return share


@kernel
def solve_ring(p, c, speed, load, offset, share, out, w):
    """As ``equilibrium``, with ``share`` of the imperfections: ball sizes, race waviness (0: none)."""
    v = w[W.POSE :]
    for i in range(EQ.SIZE):
        out[i] = 0.0
    shift = axial_guess(p, c, load[0])
    place_first(p, c, shift, offset, share, v)
    for i in range(5):
        v[_RING + i] = shift if i == 0 else 0.0
        v[_STEP + i] = 0.0
    ring = v[_RING : _RING + 5]
    g = v[_G : _G + 5]
    ring_forces(p, c, speed, load, offset, ring, v, 0.0, g)
    for i in range(5):
        v[_TRIAL + i] = ring[i]
        v[_G1 + i] = g[i]
    keep_trial(p, v)
    pitch = p[P.PITCH_RADIUS]
    total = abs(load[0]) + abs(load[1]) + abs(load[2]) + (abs(load[3]) + abs(load[4])) / pitch
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
    for i in range(5):
        out[EQ.SHIFT + i] = ring[i]
    out[EQ.RESIDUAL] = size
    out[EQ.ITERATIONS] = done
    report(p, c, speed, offset, v, out)
    return OK if size <= 1e-6 * (1.0 + total) else NO_START


@kernel
def equilibrium(p, c, speed, load, offset, out, w):
    """Equilibrium of the inner ring of a perfect bearing (see the module); status code."""
    return solve_ring(p, c, speed, load, offset, 0.0, out, w)
