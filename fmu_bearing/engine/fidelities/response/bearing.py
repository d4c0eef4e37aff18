"""One bearing's part of fidelity `response`: derivatives, its own lines, balls between the rings."""

from fmu_bearing.engine.fidelities.condensed.ball_motion import move_balls
from fmu_bearing.engine.fidelities.condensed.balls import count_settled, set_angles, solve_balls
from fmu_bearing.engine.fidelities.condensed.linearised import derivatives
from fmu_bearing.engine.fidelities.condensed.rows import (
    angles_at,
    from_equilibrium,
    keep_balls,
    show_balls,
)
from fmu_bearing.engine.fidelities.condensed.shared import flat
from fmu_bearing.engine.fidelities.response.lines import begin_lines
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, splat, store
from fmu_bearing.engine.layout import FOUR, STRIDE, C, L, P, S, T, W, Y
from fmu_bearing.engine.mechanics.race import wave_time
from fmu_bearing.engine.mechanics.trigonometry import ball_angles

_SAMPLING = 51_200.0  # Hz of the states that samples are interpolated between, with sound: no fewer
_WAVE = 1.26  # rad of the fastest wave between two such states: the cubic between them errs by 0.6 %
_TRIES = 8  # of 30 sweeps
_NEAR = 0.05  # rad of orbit: a radially loaded ball moves by 15 um at most meanwhile, mostly by 0.5
BACK = 2e-6  # s between the two states a ball's rate is taken from, without sound


@kernel
def linearise(p, s, speed, w):
    """Renew derivatives at ``speed`` about ``L.MEAN`` and begin lines; False where there are none."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    still(p, c, lv, w)
    out_of_round(p, c, lv, w)
    if not derivatives(p, c, lv, 0.0, speed, 0.0, w):
        return False
    still(p, c, lv, w)
    begin_lines(p, s, speed, w)
    return True


@kernel
def out_of_round(p, c, lv, w):
    """Add order 2 of the outer race to its heights under the balls.

    It loads the balls at two opposite sides more than those between them, always at the same place, so the
    radial stiffness differs along and across. Other orders make no such difference to first order, and the
    inner race's turns with the shaft. With 3 or 4 balls it would change as they turn: left out.
    """
    if p[P.WAVINESS] == 0.0 or p[P.WAVE_ORDERS] < 2.0 or p[P.BALLS] < 5.0:
        return
    at = int(p[P.AT_ORDERS]) + 2 * int(p[P.WAVE_ORDERS]) + 2
    scale = c[C.OVERSIZE_SCALE]
    for j in range(0, int(p[P.LANES]), FOUR):
        co = load(lv, L.COS + j)
        si = load(lv, L.SIN + j)
        height = p[at] * (co * co - si * si) - p[at + 1] * (2.0 * si * co)
        store(w, T.OUTER + j, load(w, T.OUTER + j) + scale * height)


@kernel
def still(p, c, lv, w):
    """Trial state at the equilibrium without motion, ball 0 at angle 0, even races."""
    for i in range(Y.SIZE):
        w[W.STAGE + i] = 0.0
    for i in range(L.N):
        w[W.STAGE + Y.Q0 + i] = lv[L.MEAN + i]
    show_balls(lv, L.EVEN, w)
    flat(p, c, lv, w)


@kernel
def sum_lines(lv, lines, count, mean, theta, rolled, angle, speed, w, out):
    """Displacements about ``mean``, velocities and accelerations of the rings, to ``out``, at three angles.

    ``theta``: of ball 0; ``rolled``: by which the balls have turned; ``angle``: of the shaft (rad). Cosines
    and sines are taken for a row of lines at a time, the coordinates of a line four at a time.
    """
    orbit = lv[L.RATIO] * speed
    q0, q1, q2 = load(mean, 0), load(mean, FOUR), load(mean, 2 * FOUR)
    v0, v1, v2 = splat(0.0), splat(0.0), splat(0.0)
    a0, a1, a2 = splat(0.0), splat(0.0), splat(0.0)
    for first in range(0, count, STRIDE):
        many = min(count - first, STRIDE)
        for k in range(many):
            at = (first + k) * L.LINE_SIZE
            phase = lines[at + L.LINE_BALL] * theta + lines[at + L.LINE_SHAFT] * angle
            w[T.PHASES + k] = phase + lines[at + L.LINE_ROLLED] * rolled
        # what follows the last line is a phase of another time, and not used
        ball_angles(w, T.PHASES, (many + FOUR - 1) // FOUR * FOUR, w)
        for k in range(many):
            at = (first + k) * L.LINE_SIZE
            omega = lines[at + L.LINE_BALL] * orbit + lines[at + L.LINE_SHAFT] * speed
            omega += lines[at + L.LINE_ROLLED] * (lv[L.ROLL] * speed)
            co = w[T.COS + k]
            si = w[T.SIN + k]
            re = at + L.LINE_REAL
            im = at + L.LINE_IMAGINARY
            x0, y0 = turned(lines, re, im, co, si)
            x1, y1 = turned(lines, re + FOUR, im + FOUR, co, si)
            x2, y2 = turned(lines, re + 2 * FOUR, im + 2 * FOUR, co, si)
            squared = omega * omega
            q0 += x0
            q1 += x1
            q2 += x2
            v0 -= omega * y0
            v1 -= omega * y1
            v2 -= omega * y2
            a0 -= squared * x0
            a1 -= squared * x1
            a2 -= squared * x2
    store_twelve(out, 0, q0, q1, q2)
    store_twelve(out, L.COLUMN, v0, v1, v2)
    store_twelve(out, 2 * L.COLUMN, a0, a1, a2)


@kernel
def turned(lines, re, im, co, si):
    """Real and imaginary parts of four coordinates of a line, at ``re`` and ``im``, turned by a phase."""
    real = load(lines, re)
    imaginary = load(lines, im)
    return real * co - imaginary * si, real * si + imaginary * co


@kernel
def store_twelve(lv, at, first, second, third):
    """Write ``L.COLUMN`` numbers."""
    store(lv, at, first)
    store(lv, at + FOUR, second)
    store(lv, at + 2 * FOUR, third)


@kernel
def find_places(p, c, lv, theta, speed, near, q, w):
    """Places of rest for the rings at ``q``: from the last ones if ``near``, or else from the equilibrium's.

    The last ones are far off after a long step or a jump of the load: a ball moves by 2 um per sweep, and
    one left behind by 50 um would show 30 times its load. What is found in the end is shown in any case:
    nearer than anything older.
    """
    if near:
        show_balls(lv, L.X, w)
        if solve_balls(p, c, lv, speed, q, w):
            return
    from_equilibrium(p, lv, theta, w)
    for _ in range(_TRIES):
        if solve_balls(p, c, lv, speed, q, w):
            return


@kernel
def settle(p, s, ahead, near, w):
    """Places of rest of the balls between the rings as they are in ``lv``; arguments: see `march.place`."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    theta, rolled, angle, speed = angles_at(s, ahead)
    tau = p[P.CONTACT_DAMPING]
    set_angles(p, c, lv, theta, rolled, angle, lv[L.Q0 + L.TURN], speed, w)
    q = w[T.Q : T.Q + L.COLUMN]
    for i in range(L.N):
        q[i] = lv[L.Q0 + i]
        w[T.AHEAD + i] = tau * lv[L.V0 + i]
    find_places(p, c, lv, theta, speed, near, q, w)
    keep_balls(w, lv, L.X)
    count_settled(lv, int(p[P.LANES]), w)


@kernel
def is_near(s, speed, h):
    """Whether the balls' last places are good guesses after a step ``h`` (s) to ``speed`` (rad/s)."""
    return abs(h * s[S.CONDENSED + L.RATIO]) * max(abs(s[S.SPEED]), abs(speed)) < _NEAR


@kernel
def sample_spacing(p, s, speed):
    """Longest time (s) between two states that samples are interpolated between, on the way to ``speed``."""
    return min(1.0 / _SAMPLING, _WAVE * wave_time(p, max(abs(s[S.SPEED]), abs(speed))))


@kernel
def begin_spacing(s, step):
    """Note the time ``step`` (s) from one state to the next; those at another one are forgotten."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    if abs(step - lv[L.SPACING]) > 1e-6 * step:
        lv[L.SPACING] = step
        lv[L.KNOWN] = 0.0


@kernel
def follow_balls(p, s, step, w):
    """Move the balls across their tracks over a ``step`` (s) to where rings and places of rest now are."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    move_balls(p, lv, step, lv, L.V0, w)
    lv[L.KNOWN] += 1.0


@kernel
def keep_back(s):
    """Let the balls' places be those ``BACK`` before the present time."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    for i in range(2 * STRIDE):
        lv[L.X1 + i] = lv[L.X + i]
    lv[L.SPACING] = BACK
    lv[L.KNOWN] = 1.0
