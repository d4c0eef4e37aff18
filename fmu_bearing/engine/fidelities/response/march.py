"""Fidelity `response`: the rings' steady linear answer to every excitation, as a sum of lines.

The rings stand at their static equilibrium; mass, damping and stiffness are those of fidelity `rings` there,
with the balls' stiffness averaged over the orbit. Each line turns with a ball 0's angle + b shaft's angle for
whole a and b, so that phases run on through changes of speed; amplitudes are renewed with what is ``held``
(speed by 1 %, conditions by 0.1 %), and at once: the transient of the change is left out.

Between communication points nothing is stepped but the two angles; with sound, samples are interpolated
between states 19.5 us apart.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.fidelities.condensed.balls import carried, count_settled, stand
from fmu_bearing.engine.fidelities.condensed.damping import add_damping
from fmu_bearing.engine.fidelities.condensed.held import hold
from fmu_bearing.engine.fidelities.condensed.linearised import added_mass, at_rest, derivatives
from fmu_bearing.engine.fidelities.condensed.publish import publish
from fmu_bearing.engine.fidelities.condensed.rows import coordinate, keep_balls, show_balls
from fmu_bearing.engine.fidelities.condensed.shared import (
    advance,
    emit,
    flat,
    quasistatic_places,
    set_inputs,
    start_condensed,
)
from fmu_bearing.engine.fidelities.response.lines import order_amplitudes, renew_lines
from fmu_bearing.engine.fidelities.steps import begin_heats, mean_heats
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, C, F, L, P, S, T, U, W, Y
from fmu_bearing.engine.status import NO_START, NOT_CONVERGED, OK

_SAMPLING = 51_200.0  # Hz of the states that samples are interpolated between, with sound
_TRIES = 8  # of 30 sweeps
_BACK = 2e-6  # s between the two states a ball's rate is taken from, without sound


@kernel
def linearise(p, s, speed, w):
    """Renew derivatives, damping and lines at ``speed`` about ``L.MEAN``; False where there are none."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    for i in range(L.MATRIX):
        lv[L.EXTRA + i] = 0.0
    still(p, c, lv, w)
    if not derivatives(p, c, lv, 0.0, speed, 0.0, w):
        return False
    added_mass(p, c, lv, w)
    add_damping(p, s, w)
    still(p, c, lv, w)
    renew_lines(p, s, speed, w)
    return True


@kernel
def still(p, c, lv, w):
    """Trial state at the equilibrium without motion, ball 0 at angle 0, even races."""
    for i in range(Y.SIZE):
        w[W.STAGE + i] = 0.0
    for i in range(L.N):
        w[W.STAGE + Y.Q0 + i] = lv[L.MEAN + i]
    show_balls(lv, L.X3, w)
    flat(p, c, lv, w)


@kernel
def start_response(p, u, s, w, t):
    """Fill the state ``s`` for the inputs ``u`` at time ``t`` (s); status code."""
    status = start_condensed(p, u, s, w, t)
    if status != OK:
        return status
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    keep_balls(w, lv, L.X)
    keep_balls(w, lv, L.X3)
    order_amplitudes(p, lv)
    if not linearise(p, s, u[U.SPEED], w):
        return NO_START
    show(p, s, w)
    for i in range(3):
        s[S.MEAN_HEAT + i] = lv[L.HEAT + i]
    return OK


@kernel
def renew_equilibrium(p, u, s, w):
    """Renew held values, equilibrium from the old one, and lines for the speed to come; status code.

    Where Newton does not come from the old equilibrium to the new one, it starts from the quasi-static one,
    which serves itself where there is no rest (as at the start).
    """
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    speed = u[U.SPEED]
    if hold(p, u, speed, s, w) != OK:
        return NOT_CONVERGED
    c = s[S.C : S.C + C.SIZE]
    for i in range(L.MATRIX):
        lv[L.EXTRA + i] = 0.0
    still(p, c, lv, w)
    if not at_rest(p, c, lv, speed, w):
        for part in range(2):
            if quasistatic_places(p, c, speed, w) != OK:
                return NOT_CONVERGED
            flat(p, c, lv, w)
            if part == 1 or at_rest(p, c, lv, speed, w):
                break
    for i in range(L.N):
        lv[L.MEAN + i] = w[W.STAGE + Y.Q0 + i]
    keep_balls(w, lv, L.X3)
    return OK if linearise(p, s, speed, w) else NOT_CONVERGED


@kernel
def sum_lines(lv, theta, angle, orbit, speed, w):
    """Displacements, velocities and accelerations of the rings at the angles of ball 0 and shaft (rad)."""
    for i in range(L.N):
        lv[L.Q0 + i] = lv[L.MEAN + i]
        lv[L.V0 + i] = 0.0
        lv[L.A0 + i] = 0.0
    for k in range(int(lv[L.COUNT])):
        at = L.LINES + k * L.LINE_SIZE
        a = lv[at + L.LINE_BALL]
        b = lv[at + L.LINE_SHAFT]
        phase = a * theta + b * angle
        omega = a * orbit + b * speed
        co = math.cos(phase)
        si = math.sin(phase)
        for i in range(L.FORCES):
            into = coordinate(i)
            real = lv[at + L.LINE_REAL + i] * co - lv[at + L.LINE_IMAGINARY + i] * si
            turned = lv[at + L.LINE_REAL + i] * si + lv[at + L.LINE_IMAGINARY + i] * co
            lv[L.Q0 + into] += real
            lv[L.V0 + into] -= omega * turned
            lv[L.A0 + into] -= omega * omega * real


@kernel
def from_equilibrium(p, lv, theta, w):
    """Balls' places between those at the equilibrium, for ball 0 at ``theta`` (rad): linear in the angle."""
    balls = int(p[P.BALLS])
    turned = theta * balls / (2.0 * PI)
    whole = math.floor(turned)
    part = turned - whole
    for j in range(int(p[P.LANES])):
        near = int((j + whole) % balls)
        next_one = (near + 1) % balls
        for i in range(2):
            row = L.X3 + i * STRIDE
            w[T.X + i * STRIDE + j] = (1.0 - part) * lv[row + near] + part * lv[row + next_one]


@kernel
def find_places(p, c, lv, theta, speed, q, w):
    """Places of rest for the rings at ``q``: from the last ones, else from the equilibrium's.

    The last ones are far off after a long step or a jump of the load: a ball moves by 2 um per sweep, and
    one left behind by 50 um would show 30 times its load. What is found in the end is shown in any case:
    nearer than anything older.
    """
    show_balls(lv, L.X, w)
    if carried(p, c, lv, speed, q, w):
        return
    from_equilibrium(p, lv, theta, w)
    for _ in range(_TRIES):
        if carried(p, c, lv, speed, q, w):
            return


@kernel
def place(p, s, ahead, w):
    """Rings and balls at ``ahead`` (s, may be negative) from the present time into ``lv``."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    c = s[S.C : S.C + C.SIZE]
    speed = s[S.SPEED] + ahead * s[S.SPEED_RATE]
    turned = ahead * (s[S.SPEED] + 0.5 * ahead * s[S.SPEED_RATE])
    theta = lv[L.THETA] + lv[L.RATIO] * turned
    angle = s[S.ANGLE] + turned
    sum_lines(lv, theta, angle, lv[L.RATIO] * speed, speed, w)
    tau = p[P.CONTACT_DAMPING]
    stand(p, c, lv, theta + tau * lv[L.RATIO] * speed, angle + tau * speed, lv[L.Q0 + L.TURN], speed, w)
    q = w[T.Q : T.Q + L.COLUMN]
    for i in range(L.N):
        q[i] = lv[L.Q0 + i] + tau * lv[L.V0 + i]
    find_places(p, c, lv, theta, speed, q, w)
    keep_balls(w, lv, L.X)
    count_settled(lv, int(p[P.LANES]), w)


@kernel
def show(p, s, w):
    """State for outputs at the present time, the balls' rates from two places a little apart."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    place(p, s, -_BACK, w)
    for i in range(2 * STRIDE):
        lv[L.X1 + i] = lv[L.X + i]
    place(p, s, 0.0, w)
    lv[L.SPACING] = _BACK
    lv[L.KNOWN] = 1.0
    publish(p, lv, s[S.SPEED], s[S.SPEED_RATE], False, s[S.Y : S.Y + Y.SIZE], s[S.F : S.F + F.SIZE])


@kernel
def march_response(p, u, s, w, h):
    """Advance the state by the communication step ``h`` (s); status code."""
    lv = s[S.CONDENSED : S.CONDENSED + L.SIZE]
    begin_heats(s)
    if set_inputs(p, u, s, w, h):
        status = renew_equilibrium(p, u, s, w)
        if status != OK:
            return status
        lv[L.KNOWN] = 0.0
    end = s[S.TIME] + h
    if p[P.SOUND_SIZE] != 0.0:
        count = math.ceil(h * _SAMPLING - 1e-9)
        step = h / count
        if abs(step - lv[L.SPACING]) > 1e-6 * step:
            lv[L.SPACING] = step
            lv[L.KNOWN] = 0.0
        for _ in range(int(count)):
            for i in range(2 * STRIDE):
                lv[L.X2 + i] = lv[L.X1 + i]
                lv[L.X1 + i] = lv[L.X + i]
            place(p, s, step, w)
            lv[L.KNOWN] += 1.0
            lv[L.THETA] += lv[L.RATIO] * step * (s[S.SPEED] + 0.5 * step * s[S.SPEED_RATE])
            emit(p, s, w, step, False)
            advance(s, step)
    else:
        lv[L.THETA] += lv[L.RATIO] * h * (s[S.SPEED] + 0.5 * h * s[S.SPEED_RATE])
        advance(s, h)
    s[S.TIME] = end
    s[S.SPEED] = u[U.SPEED]
    if p[P.SOUND_SIZE] == 0.0:
        show(p, s, w)
    mean_heats(s, h)
    return OK
