"""From one communication point to the next: inputs, internal steps, sound samples.

One bearing and a set on a shaft go the same way: a single bearing is a set of one without coordinates beside
its own. Arguments: see `step`.
"""

from fmu_bearing.engine.choices import RK4, TRBDF2
from fmu_bearing.engine.constants import LONGEST_STEP, PER_STEP, USUAL_STEP
from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.full import control
from fmu_bearing.engine.fidelities.full.jacobians import (
    factor_all,
    fresh_contraction,
    keep_contraction,
    renew_jacobians,
)  # fmt: skip
from fmu_bearing.engine.fidelities.full.methods.table import AT_ESDIRK4, AT_RK4, AT_TRBDF2, TABLEAUX
from fmu_bearing.engine.fidelities.full.progress import accept, renew_jacobian, total_energy
from fmu_bearing.engine.fidelities.full.runge_kutta import integrate_power, integrate_torque
from fmu_bearing.engine.fidelities.full.stages import acceleration, keep_change
from fmu_bearing.engine.fidelities.full.start import exceeds_pedestal
from fmu_bearing.engine.fidelities.full.step import grow_all, runge_kutta_step
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, TAB, C, F, P, S, U, W, Y
from fmu_bearing.engine.mechanics.conditions import grow_on, ramp
from fmu_bearing.engine.mechanics.race import passing_time, wave_time
from fmu_bearing.engine.readout.defects import watch_defects
from fmu_bearing.engine.readout.losses import summarise
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.coupling import solve_set, turn_since
from fmu_bearing.engine.spindle.follow import copy_rows
from fmu_bearing.engine.spindle.inputs import bearing_conditions, growth_rate, loads_differ, take_loads
from fmu_bearing.engine.spindle.port import has_port, take_motion
from fmu_bearing.engine.spindle.sound_sum import emit
from fmu_bearing.engine.statics.rigid_preload import axial_speed
from fmu_bearing.engine.status import NOT_CONVERGED, OK, TOO_SOFT

# Radians of the fastest wave in a step: the error estimate does not see what folds between its stages.
_WAVE = 1.6
# Steps between measurements of the contraction, each an iteration more. Under radial load it grows within a
# few steps; what Newton's method then leaves unseen enters the error estimate. Measured every 16 steps, twice
# as many steps are rejected at 1000 N, and the run takes a twentieth longer.
_PROBE = 4


@kernel
def offset_rate(p, u, s, w, b, h):
    """Rate (m/s) at which the inner ring of bearing ``b`` moves along its axis, from where the shaft puts it.

    What grows with temperature in a set, or the way to the place of a rigid preload, over ``h`` (s).
    """
    pb = members.parameters(p, b)
    if pb[P.RIGID] != 0.0:
        wb = members.work(p, w, b)
        fresh = wb[W.CONDITIONS : W.CONDITIONS + C.SIZE]
        return axial_speed(pb, u, fresh, members.state(p, s, b), wb, h)
    return growth_rate(p, u, members.set_state(p, s), b, h)


@kernel
def inputs_differ(p, u, s, w, h):
    """Whether the inputs ``u`` change conditions held over a communication step; fresh ones on the way."""
    own = members.set_state(p, s)
    changed = loads_differ(p, u, own)
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        bearing_conditions(p, u, b, 0.5 * (s[S.SPEED] + u[U.SPEED]), w)
        if p[P.FITS] != 0.0:
            given = members.set_work(p, w)[SP.INPUT : SP.INPUT + U.SIZE]
            fresh = wb[W.CONDITIONS : W.CONDITIONS + C.SIZE]
            ramp(members.parameters(p, b), given, u[U.SPEED], sb[S.C : S.C + C.SIZE], fresh, h)
        for i in range(C.USED):
            if wb[W.CONDITIONS + i] != sb[S.C + i]:
                changed = True
        if offset_rate(p, u, s, w, b, h) != own[members.per_bearing(p, b) + SP.OFFSET_RATE]:
            changed = True
    return changed


@kernel
def take_inputs(p, u, s, w, h):
    """Set conditions, loads and ramps; what a jump of them does to stored energy counts as work."""
    own = members.set_state(p, s)
    rate = (u[U.SPEED] - s[S.SPEED]) / h
    changed = inputs_differ(p, u, s, w, h)
    if has_port(p):
        take_motion(p, u, s, own, h)
    elif not changed and rate == s[S.SPEED_RATE]:
        return
    before = total_energy(p, s, w) if changed else 0.0
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        sb[S.SPEED_RATE] = rate
        if changed:
            along = offset_rate(p, u, s, w, b, h)
            own[members.per_bearing(p, b) + SP.OFFSET_RATE] = along
            if members.parameters(p, b)[P.RIGID] != 0.0:
                sb[S.Y + Y.V0] = along
            for i in range(C.USED):
                sb[S.C + i] = wb[W.CONDITIONS + i]
    if changed:
        take_loads(p, u, own)
        copy_rows(p, s, w)
    after = total_energy(p, s, w)
    if changed:
        s[S.WORK] += after - before


@kernel
def probes(s):
    """Whether the next step measures the contraction of Newton's method."""
    return s[S.STEPS] % _PROBE == 0.0


@kernel
def follows_scene(p):
    """Whether nothing but whirls bounds the step: no waves, sound, cage, other model or given step."""
    still = abs(p[P.MAX_STEP] - USUAL_STEP) < 1e-9 * USUAL_STEP and not has_port(p)
    for b in range(members.bearing_count(p)):
        if members.parameters(p, b)[P.TURN_RATE] == 0.0:
            still = False
    return still


@kernel
def longest_step(p, s, speed):
    """Length (s) of the longest internal step on the way to the shaft ``speed`` (rad/s)."""
    longest = p[P.MAX_STEP]
    if follows_scene(p):
        longest = LONGEST_STEP
        for b in range(members.bearing_count(p)):
            turning = members.parameters(p, b)[P.TURN_RATE] * max(abs(s[S.SPEED]), abs(speed))
            longest = min(longest, PER_STEP / (turning + 1e-300))
        longest = max(longest, p[P.MAX_STEP])
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        if pb[P.MODES] != 0.0:
            longest = min(longest, pb[P.MODE_STEP])
        fastest = max(abs(s[S.SPEED]), abs(speed))
        longest = min(longest, _WAVE * wave_time(pb, fastest), passing_time(pb, fastest))
    return longest


@kernel
def smallest_tolerance(p, s, speed):
    """Error (m/s) allowed in the rings' velocities: the least of all bearings."""
    smallest = 1e300
    for b in range(members.bearing_count(p)):
        allowed = control.allowed_velocity(members.parameters(p, b), members.state(p, s, b), speed)
        smallest = min(smallest, allowed)
    return smallest


@kernel
def try_step(p, s, w, h, tableau, speed):
    """One attempt of length ``h``: with Jacobians and factors kept as long as they serve, or all renewed.

    ``speed`` (rad/s): of the shaft at the end of the communication step. Returns the error estimate over what
    is allowed, or -1 where Newton failed with fresh Jacobians.
    """
    gamma = TABLEAUX[tableau + TAB.GAMMA]
    explicit = gamma == 0.0
    grow_all(p, s, 0.0)
    for attempt in range(2):
        fresh = explicit or renew_jacobians(p, s, w, attempt == 1)
        if not explicit and not factor_all(p, s, w, h, gamma * h):
            if fresh:
                return -1.0
            continue
        remainder = control.allowed_remainder(smallest_tolerance(p, s, speed), h)
        if runge_kutta_step(p, s, w, h, tableau, remainder, probes(s), speed):
            keep_contraction(p, s, w)
            s[S.NEWTON] += w[W.REPORT + W.ITERATIONS]
            return w[W.REPORT + W.ERROR]
        if fresh:
            return -1.0
    return -1.0


@kernel
def add_shaft_powers(p, own, ws, h, tableau):
    """Add work and heat of shaft and pedestal over the step just made, and the impulse at a port."""
    stages = int(TABLEAUX[tableau + TAB.COUNT])
    led = has_port(p)
    for stage in range(stages):
        weight = h * TABLEAUX[tableau + TAB.B + stage]
        power = SP.POWER + stage * SP.POWERS
        own[SP.WORK] += weight * ws[power]
        own[SP.HEAT] += weight * ws[power + 1]
        own[SP.HEAT + 1] += weight * ws[power + 2]
        for i in range(SP.PLANE if led else 0):
            own[SP.PORT_IMPULSE + i] += weight * ws[SP.ROTOR_FORCE + stage * SP.PLANE + i]
    last = SP.POWER + (stages - 1) * SP.POWERS
    for i in range(SP.POWERS):
        own[SP.POWER_NOW + i] = ws[last + i]
    for i in range(SP.PLANE if led else 0):
        own[SP.PORT_FORCE + i] = ws[SP.ROTOR_FORCE + (stages - 1) * SP.PLANE + i]


@kernel
def accept_shaft(p, own, ws, tableau):
    """Move shaft and housing to the end of the step just made."""
    lanes = members.padded_size(p)
    place = members.vector(p, SP.PLACE)
    rate = members.vector(p, SP.RATE)
    end = acceleration(p, int(TABLEAUX[tableau + TAB.COUNT]) - 1)
    before = acceleration(p, int(TABLEAUX[tableau + TAB.CHANGE_FROM]))
    for i in range(lanes):
        own[SP.S_HEAD + i] = ws[place + i]
        own[SP.S_HEAD + lanes + i] = ws[rate + i]
        own[SP.S_HEAD + 2 * lanes + i] = ws[end + i]
        own[SP.S_HEAD + SP.CHANGE * lanes + i] = ws[end + i] - ws[before + i]


@kernel
def accept_all(p, s, w, h, tableau):
    """Add up work and heat of the step just made, emit its sound samples and move the state to its end."""
    own = members.set_state(p, s)
    together = members.has_shaft(p)
    if together:
        add_shaft_powers(p, own, members.set_work(p, w), h, tableau)
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        integrate_power(h, tableau, wb, sb[S.WORK : S.WORK + F.POWERS])
        shaft_work, torque_time = integrate_torque(h, tableau, wb, sb[S.SPEED], sb[S.SPEED_RATE])
        sb[S.SHAFT_WORK] += shaft_work
        sb[S.TORQUE_TIME] += torque_time
    emit(p, s, w, h)
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        pb = members.parameters(p, b)
        wb = members.work(p, w, b)
        keep_change(pb, sb, wb, h, tableau)
        accept(pb, sb, wb, h)
        if pb[P.DEFECTS] != 0.0:
            watch_defects(pb, sb, h)
        if p[P.FITS] != 0.0:
            grow_on(sb[S.C : S.C + C.SIZE], h)
        control.follow_rings(sb, h)
        own[members.per_bearing(p, b) + SP.OFFSET] += h * own[members.per_bearing(p, b) + SP.OFFSET_RATE]
    if together:
        accept_shaft(p, own, members.set_work(p, w), tableau)
        copy_rows(p, s, w)


@kernel
def begin_step(p, s):
    """Store the sums at the begin of a communication step; :func:`end_step` turns them into means."""
    own = members.set_state(p, s)
    for b in range(members.bearing_count(p)):
        steps.begin_means(members.state(p, s, b))
    for i in range(2):
        own[SP.MEAN_HEAT + i] = own[SP.HEAT + i]
    for i in range(SP.PLANE):
        own[SP.PORT_IMPULSE + i] = 0.0


@kernel
def end_step(p, s, w, speed, end, h):
    """Clock, stored energy, losses and means at the end of the communication step ``h`` (s).

    One evaluation at the end point gives stored energy for the balance, and accelerations and torque that do
    not carry the last Newton iteration's remainder.
    """
    own = members.set_state(p, s)
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        sb[S.TIME] = end
        sb[S.SPEED] = speed
    s[S.ENERGY_NOW] = total_energy(p, s, w)
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        summarise(members.parameters(p, b), sb, members.work(p, w, b))
        steps.end_means(sb, h)
    for i in range(2):
        own[SP.MEAN_HEAT + i] = (own[SP.HEAT + i] - own[SP.MEAN_HEAT + i]) / h
    for i in range(SP.PLANE):
        own[SP.PORT_MEAN + i] = own[SP.PORT_IMPULSE + i] / h


@kernel
def march(p, u, s, w, h):
    """Advance the state by the communication step ``h`` (s); status code."""
    begin_step(p, s)
    take_inputs(p, u, s, w, h)
    if exceeds_pedestal(p, s):
        return TOO_SOFT
    tableau = AT_TRBDF2 if p[P.METHOD] == TRBDF2 else AT_RK4 if p[P.METHOD] == RK4 else AT_ESDIRK4
    order = TABLEAUX[tableau + TAB.ORDER]
    speed = u[U.SPEED]
    begin = s[S.TIME]
    end = begin + h
    longest = longest_step(p, s, speed)
    # bounded work: no more attempts than a hundred times what the largest internal step would need
    # (a thousand times for explicit steps, which stability keeps below 0.1 us)
    left = steps.most_attempts(h, min(longest, p[P.MAX_STEP]), 1000.0 if tableau == AT_RK4 else 100.0)
    remaining = h
    while steps.unfinished(remaining, h, end):
        length = steps.even_length(remaining, min(s[S.STEP], longest))
        left -= 1.0
        if left < 0.0:
            return NOT_CONVERGED
        error = try_step(p, s, w, length, tableau, speed)
        if error < 0.0 or not (error <= 1.0):
            if not steps.rejected(s, length * control.shrinkage(s, error, order), h):
                return NOT_CONVERGED
            continue
        control.propose(s, error, fresh_contraction(p, s), length, longest, order)
        accept_all(p, s, w, length, tableau)
        remaining = end - s[S.TIME]
    end_step(p, s, w, speed, end, h)
    return OK


@kernel
def solve_at_state(p, s, w, gh):
    """Solve Newton's equations with Jacobians made at the state; their places: see `solve_set`."""
    for b in range(members.bearing_count(p)):
        renew_jacobian(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b))
    fine = factor_all(p, s, w, gh, gh)
    if fine:
        turn_since(p, s, w, 0.0)
        solve_set(p, s, w)
    for b in range(members.bearing_count(p)):
        members.state(p, s, b)[S.FACTOR_STEP] = 0.0  # of what step is not known
    return OK if fine else NOT_CONVERGED
