"""From one communication point to the next: inputs, internal steps, Jacobian policy, sound samples."""

from fmu_bearing.engine.choices import RK4, TRBDF2
from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.full import control
from fmu_bearing.engine.fidelities.full.methods.table import AT_ESDIRK4, AT_RK4, AT_TRBDF2, TABLEAUX
from fmu_bearing.engine.fidelities.full.progress import accept, renew_jacobian, total_energy
from fmu_bearing.engine.fidelities.full.runge_kutta import integrate_power, integrate_torque, runge_kutta_step
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import TAB, C, F, P, S, U, W, Y
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.mechanics.flexure import flexure_state
from fmu_bearing.engine.mechanics.race import wave_time
from fmu_bearing.engine.newton.block_arrow import factor
from fmu_bearing.engine.newton.modes import factor_modes
from fmu_bearing.engine.readout.losses import summarise
from fmu_bearing.engine.readout.motion import emit_samples
from fmu_bearing.engine.statics.rigid_preload import axial_speed
from fmu_bearing.engine.status import NOT_CONVERGED, OK

# Radians of the fastest wave in a step: the error estimate does not see what folds between its stages.
_WAVE = 1.6
_OLDEST = 5e-3  # s: age at which the Jacobian is renewed in any case
# Steps between measurements of the contraction, each an iteration more. Under radial load it grows within a
# few steps; what Newton's method then leaves unseen enters the error estimate. Measured every 16 steps, twice
# as many steps are rejected at 1000 N, and the run takes a twentieth longer.
_PROBE = 4
# Factors serve a step within 5 % of theirs: the wrong scale contracts by about the same 0.05.
_SAME_STEP = (0.95, 1.05)
# Contraction beyond which a new Jacobian pays: with its factors it costs as much as a dozen iterations. Runs
# under 300 and 1000 N take 6 and 4 % less than with 0.3. With 0.1 the spindle at 20,000 r/min takes 13 %
# more, because a new Jacobian contracts no better there.
_SLOW = 0.2


@kernel
def take_inputs(p, u, s, w, h):
    """Set conditions and speed ramp; what a jump of a held input does to stored energy counts as work."""
    rate = (u[U.SPEED] - s[S.SPEED]) / h
    fresh = w[W.CONDITIONS : W.CONDITIONS + C.SIZE]
    conditions(p, u, 0.5 * (s[S.SPEED] + u[U.SPEED]), fresh)
    axial = axial_speed(p, u, fresh, s, w, h) if p[P.RIGID] != 0.0 else s[S.Y + Y.V0]
    changed = axial != s[S.Y + Y.V0]
    for i in range(C.USED):
        if fresh[i] != s[S.C + i]:
            changed = True
    if changed:
        before = total_energy(p, s, w)
        for i in range(C.USED):
            s[S.C + i] = fresh[i]
        s[S.SPEED_RATE] = rate
        s[S.Y + Y.V0] = axial
        s[S.WORK] += total_energy(p, s, w) - before
    elif rate != s[S.SPEED_RATE]:
        s[S.SPEED_RATE] = rate
        total_energy(p, s, w)


@kernel
def renewal_due(s, slow):
    """Whether the Jacobian is too old, or contracts more slowly than ``slow``."""
    return s[S.TIME] - s[S.JACOBIAN_TIME] > _OLDEST or s[S.CONTRACTION] > slow


@kernel
def same_step(s, h):
    """Whether the factors serve a step ``h`` (s)."""
    ratio = h / (s[S.FACTOR_STEP] + 1e-300)
    return not (ratio < _SAME_STEP[0] or ratio > _SAME_STEP[1])


@kernel
def probes(s):
    """Whether the next step measures the contraction of Newton's method."""
    return s[S.STEPS] % _PROBE == 0.0


@kernel
def longest_step(p, s, speed):
    """Length (s) of the longest internal step on the way to the shaft ``speed`` (rad/s)."""
    longest = p[P.MAX_STEP] if p[P.MODES] == 0.0 else min(p[P.MAX_STEP], p[P.MODE_STEP])
    return min(longest, _WAVE * wave_time(p, max(abs(s[S.SPEED]), abs(speed))))


@kernel
def try_step(p, s, w, h, tableau, tolerance):
    """One attempt of length ``h`` with Jacobian and factors kept as long as they serve.

    Returns the error estimate over what is allowed, or -1 where Newton failed with a fresh Jacobian.
    """
    report = w[W.REPORT : W.REPORT + W.REPORT_SIZE]
    explicit = TABLEAUX[tableau + TAB.GAMMA] == 0.0
    for attempt in range(2):
        fresh = s[S.JACOBIAN_TIME] == s[S.TIME] or explicit
        if not fresh and (attempt == 1 or renewal_due(s, _SLOW)):
            renew_jacobian(p, s, w)
            fresh = True
        if not explicit and not same_step(s, h):
            gh = TABLEAUX[tableau + TAB.GAMMA] * h
            if not factor(p, s[S.JAC : S.FAC], gh, gh * gh, gh * gh, s[S.FAC : S.CONDENSED], w):
                if fresh:
                    return -1.0
                continue
            factor_modes(
                p, s[S.JAC:S.FAC], s[S.FAC:S.CONDENSED], s[S.Y : S.Y + Y.SIZE],
                s[S.Y + Y.TH] - s[S.JACOBIAN_ANGLE], s[S.SPEED], gh, gh * gh, s[flexure_state(p) :], w,
            )  # fmt: skip
            s[S.FACTOR_STEP] = h
        fine = runge_kutta_step(
            p, s[S.C : S.C + C.SIZE], s[S.Y : S.Y + Y.SIZE], s[S.F : S.F + F.SIZE], s[S.AXES:S.JAC],
            s[flexure_state(p) :], s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE], h, tableau, s[S.FAC:S.CONDENSED],
            s[S.Y + Y.TH] - s[S.JACOBIAN_ANGLE], control.allowed_remainder(tolerance, h),
            s[S.CONTRACTION], probes(s), w, report,
        )  # fmt: skip
        if fine:
            if report[W.CONTRACTION] > 0.0:
                s[S.CONTRACTION] = report[W.CONTRACTION]
            s[S.NEWTON] += report[W.ITERATIONS]
            return report[W.ERROR] / control.allowed_estimate(tolerance)
        if fresh:
            return -1.0
    return -1.0


@kernel
def march(p, u, s, w, h):
    """Advance the state by the communication step ``h`` (s); status code."""
    steps.begin_means(s)
    take_inputs(p, u, s, w, h)
    tableau = AT_TRBDF2 if p[P.METHOD] == TRBDF2 else AT_RK4 if p[P.METHOD] == RK4 else AT_ESDIRK4
    order = TABLEAUX[tableau + TAB.ORDER]
    begin = s[S.TIME]
    end = begin + h
    longest = longest_step(p, s, u[U.SPEED])
    # bounded work: no more attempts than a hundred times what the largest internal step would need
    # (a thousand times for explicit steps, which stability keeps below 0.1 us)
    left = steps.most_attempts(h, longest, 1000.0 if tableau == AT_RK4 else 100.0)
    remaining = h
    while steps.unfinished(remaining, h, end):
        length = steps.even_length(remaining, min(s[S.STEP], longest))
        left -= 1.0
        if left < 0.0:
            return NOT_CONVERGED
        error = try_step(p, s, w, length, tableau, control.allowed_velocity(p, s, u[U.SPEED]))
        if error < 0.0 or not (error <= 1.0):
            if not steps.rejected(s, length * control.shrinkage(s, error, order), h):
                return NOT_CONVERGED
            continue
        integrate_power(length, tableau, w, s[S.WORK : S.WORK + F.POWERS])
        shaft_work, torque_time = integrate_torque(length, tableau, w, s[S.SPEED], s[S.SPEED_RATE])
        s[S.SHAFT_WORK] += shaft_work
        s[S.TORQUE_TIME] += torque_time
        emit_samples(p, s, w, length)
        fresh = s[S.JACOBIAN_TIME] == s[S.TIME]
        control.propose(s, error, s[S.CONTRACTION] if fresh else 0.0, length, longest, order)
        accept(p, s, w, length)
        control.follow_rings(s, length)
        remaining = end - s[S.TIME]
    s[S.TIME] = end
    s[S.SPEED] = u[U.SPEED]
    # One evaluation at the end point: stored energy for the balance, and accelerations and torque that do
    # not carry the last Newton iteration's remainder.
    s[S.ENERGY_NOW] = total_energy(p, s, w)
    summarise(p, s, w)
    steps.end_means(s, h)
    return OK
