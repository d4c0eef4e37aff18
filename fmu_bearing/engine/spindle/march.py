"""A set from one communication point to the next: what ``fidelities.full.march`` does for one bearing."""

from fmu_bearing.engine.choices import RK4, TRBDF2
from fmu_bearing.engine.fidelities import steps
from fmu_bearing.engine.fidelities.full import control
from fmu_bearing.engine.fidelities.full.march import longest_step, probes, renewal_due, same_step
from fmu_bearing.engine.fidelities.full.methods.table import AT_ESDIRK4, AT_RK4, AT_TRBDF2, TABLEAUX
from fmu_bearing.engine.fidelities.full.progress import accept, renew_jacobian
from fmu_bearing.engine.fidelities.full.runge_kutta import integrate_power, integrate_torque
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, TAB, C, F, P, Q, S, W
from fmu_bearing.engine.newton.block_arrow import factor
from fmu_bearing.engine.readout.losses import summarise
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.coupling import factor_set, solve_set, turn_since
from fmu_bearing.engine.spindle.energy import set_energy
from fmu_bearing.engine.spindle.follow import copy_rows
from fmu_bearing.engine.spindle.inputs import bearing_conditions, growth_rate, loads_differ, take_loads
from fmu_bearing.engine.spindle.port import clear, has_port, take_motion
from fmu_bearing.engine.spindle.sound import emit_set
from fmu_bearing.engine.spindle.step import set_step
from fmu_bearing.engine.status import BAD_INPUT, NOT_CONVERGED, OK

# Contraction beyond which a new Jacobian pays. With 0.2, as for one bearing, QBC sets take 5 % more, and
# with 0.06 DB sets 7 % (rigid shaft, 7003C, 20,000 r/min, best of four runs that scatter by 3 %).
_SLOW = 0.12
_RESTING = 1e-3  # s: over so long balls and cage follow the rings
# Differences at a port. Faster ones bend friction and contact damping (10 nm in 1 us: 3 %). Small ones pass
# under the step control, which would not resolve the balls' contact modes (7 to 50 us) in short steps: 13 %
# at 5 us, 4 % at 20 us. So internal steps are parts of these; in longer ones the modes die away in time.
_NEAR = 1e-8  # m
_SLOWLY = 2e-3  # m/s
_SHORT = 2.5e-5  # s
_PARTS = 8.0
_ARM = 0.03  # m: a turn counts as what it moves that far away, about half a bearing


@kernel
def inputs_differ(p, u, s, w, h):
    """Whether the inputs ``u`` change what is held over a communication step; fresh conditions on the way."""
    own = members.own_state(p, s)
    changed = loads_differ(p, u, own)
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        bearing_conditions(p, u, b, 0.5 * (s[S.SPEED] + u[SP.U_SPEED]), w)
        for i in range(C.USED):
            if wb[W.CONDITIONS + i] != sb[S.C + i]:
                changed = True
        if growth_rate(p, u, own, b, h) != own[members.kept(p, b) + SP.OFFSET_RATE]:
            changed = True
    return changed


@kernel
def take_set_inputs(p, u, s, w, h):
    """Set conditions, loads and ramps; what a jump of them does to stored energy counts as work."""
    own = members.own_state(p, s)
    rate = (u[SP.U_SPEED] - s[S.SPEED]) / h
    changed = inputs_differ(p, u, s, w, h)
    led = has_port(p)
    if led:
        take_motion(p, u, s, own, h)
    elif not changed and rate == s[S.SPEED_RATE]:
        return
    before = set_energy(p, s, w) if changed else 0.0
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        sb[S.SPEED_RATE] = rate
        if changed:
            for i in range(C.USED):
                sb[S.C + i] = wb[W.CONDITIONS + i]
            own[members.kept(p, b) + SP.OFFSET_RATE] = growth_rate(p, u, own, b, h)
    if changed:
        take_loads(p, u, own)
        copy_rows(p, s, w)
    after = set_energy(p, s, w)
    if changed:
        own[SP.WORK] += after - before


@kernel
def renew_set(p, s, w):
    """Jacobians of all bearings at the present state."""
    for b in range(members.count(p)):
        renew_jacobian(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b))


@kernel
def factor_bearings(p, s, w, gh):
    """Factors of all bearings for steps of weight ``gh`` (s); False if singular."""
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        fac = sb[S.FAC : S.CONDENSED]
        if not factor(
            members.parameters(p, b), sb[S.JAC : S.FAC], gh, gh * gh, gh * gh, fac, members.work(p, w, b)
        ):
            return False
    return True


@kernel
def factor_all(p, s, w, gh):
    """Factors of all bearings and the shaft for steps of weight ``gh`` (s); False if singular."""
    return factor_bearings(p, s, w, gh) and factor_set(p, s, w, gh)


@kernel
def smallest_tolerance(p, s, speed):
    """Error (m/s) allowed in the rings' velocities: the least of all bearings."""
    smallest = 1e300
    for b in range(members.count(p)):
        allowed = control.allowed_velocity(members.parameters(p, b), members.state(p, s, b), speed)
        smallest = min(smallest, allowed)
    return smallest


@kernel
def try_set_step(p, s, w, h, tableau, tolerance):
    """One attempt of length ``h``: as ``fidelities.full.march.try_step``, over all bearings."""
    explicit = TABLEAUX[tableau + TAB.GAMMA] == 0.0
    for attempt in range(2):
        fresh = s[S.JACOBIAN_TIME] == s[S.TIME] or explicit
        if not fresh and (attempt == 1 or renewal_due(s, _SLOW)):
            renew_set(p, s, w)
            fresh = True
        if not explicit and not same_step(s, h):
            if not factor_all(p, s, w, TABLEAUX[tableau + TAB.GAMMA] * h):
                if fresh:
                    return -1.0
                continue
            s[S.FACTOR_STEP] = h
        remainder = control.allowed_remainder(tolerance, h)
        if set_step(p, s, w, h, tableau, remainder, probes(s)):
            if w[W.REPORT + W.CONTRACTION] > 0.0:
                s[S.CONTRACTION] = w[W.REPORT + W.CONTRACTION]
            s[S.NEWTON] += w[W.REPORT + W.ITERATIONS]
            return w[W.REPORT + W.ERROR]
        if fresh:
            return -1.0
    return -1.0


@kernel
def accept_set(p, s, w, h, tableau):
    """Add up work and heat of the step just made, emit its sound samples and move the state to its end."""
    own = members.own_state(p, s)
    ws = members.own_work(p, w)
    n = members.padded(p)
    stages = int(TABLEAUX[tableau + TAB.COUNT])
    led = has_port(p)
    for stage in range(stages):
        weight = h * TABLEAUX[tableau + TAB.B + stage]
        power = SP.POWER + stage * SP.POWERS
        own[SP.WORK] += weight * ws[power]
        own[SP.HEAT] += weight * ws[power + 1]
        own[SP.HEAT + 1] += weight * ws[power + 2]
        for i in range(SP.PLANE if led else 0):
            own[SP.PORT_IMPULSE + i] += weight * ws[SP.PUSH + stage * SP.PLANE + i]
    last = SP.POWER + (stages - 1) * SP.POWERS
    for i in range(SP.POWERS):
        own[SP.POWER_NOW + i] = ws[last + i]
    for i in range(SP.PLANE if led else 0):
        own[SP.PORT_FORCE + i] = ws[SP.PUSH + (stages - 1) * SP.PLANE + i]
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        integrate_power(h, tableau, wb, sb[S.WORK : S.WORK + F.POWERS])
        shaft_work, torque_time = integrate_torque(h, tableau, wb, sb[S.SPEED], sb[S.SPEED_RATE])
        sb[S.SHAFT_WORK] += shaft_work
        sb[S.TORQUE_TIME] += torque_time
    emit_set(p, s, w, h)
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        accept(members.parameters(p, b), sb, members.work(p, w, b), h)
        control.follow_rings(sb, h)
        own[members.kept(p, b) + SP.OFFSET] += h * own[members.kept(p, b) + SP.OFFSET_RATE]
    end = members.vector(p, stages - 1)
    for i in range(n):
        own[SP.S_HEAD + i] = ws[members.vector(p, SP.PLACE) + i]
        own[SP.S_HEAD + n + i] = ws[members.vector(p, SP.RATE) + i]
        own[SP.S_HEAD + 2 * n + i] = ws[end + i]
    copy_rows(p, s, w)


@kernel
def march_set(p, u, s, w, h):
    """Advance the state of a set by the communication step ``h`` (s); status code."""
    own = members.own_state(p, s)
    for b in range(members.count(p)):
        steps.begin_means(members.state(p, s, b))
    for i in range(2):
        own[SP.MEAN_HEAT + i] = own[SP.HEAT + i]
    clear(own, SP.PORT_IMPULSE, SP.PLANE)
    take_set_inputs(p, u, s, w, h)
    tableau = AT_TRBDF2 if p[P.METHOD] == TRBDF2 else AT_RK4 if p[P.METHOD] == RK4 else AT_ESDIRK4
    order = TABLEAUX[tableau + TAB.ORDER]
    end = s[S.TIME] + h
    speed = u[SP.U_SPEED]
    longest = longest_step(p, s, speed)
    for b in range(1, members.count(p)):
        longest = min(longest, longest_step(members.parameters(p, b), s, speed))
    left = steps.most_attempts(h, longest, 1000.0 if tableau == AT_RK4 else 100.0)
    remaining = h
    while steps.unfinished(remaining, h, end):
        length = steps.even_length(remaining, min(s[S.STEP], longest))
        left -= 1.0
        if left < 0.0:
            return NOT_CONVERGED
        error = try_set_step(p, s, w, length, tableau, smallest_tolerance(p, s, speed))
        if error < 0.0 or not (error <= 1.0):
            if not steps.rejected(s, length * control.shrinkage(s, error, order), h):
                return NOT_CONVERGED
            continue
        fresh = s[S.JACOBIAN_TIME] == s[S.TIME]
        control.propose(s, error, s[S.CONTRACTION] if fresh else 0.0, length, longest, order)
        accept_set(p, s, w, length, tableau)
        remaining = end - s[S.TIME]
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        sb[S.TIME] = end
        sb[S.SPEED] = speed
    own[SP.ENERGY_NOW] = set_energy(p, s, w)
    for b in range(members.count(p)):
        sb = members.state(p, s, b)
        summarise(members.parameters(p, b), sb, members.work(p, w, b))
        steps.end_means(sb, h)
    for i in range(2):
        own[SP.MEAN_HEAT + i] = (own[SP.HEAT + i] - own[SP.MEAN_HEAT + i]) / h
    for i in range(SP.PLANE):
        own[SP.PORT_MEAN + i] = own[SP.PORT_IMPULSE + i] / h
    return OK


@kernel
def answer_set(p, s, w, gh):
    """Solve Newton's equations with Jacobians made at the state; where they stand: see `solve_set`."""
    renew_set(p, s, w)
    if not factor_all(p, s, w, gh):
        return NOT_CONVERGED
    turn_since(p, s, w, 0.0)
    solve_set(p, s, w)
    return OK


@kernel
def port_derivative(p, u, s, z, w, h):
    """Change of the port's force in ``z`` for a change of place and rate at the end of a step of ``h`` (s).

    ``u``: inputs, then their change; ``s``: state, then room for a copy; both are lost. The step is made
    twice, with the change to either side. Status code; ``z`` is left as it is where other inputs change.
    """
    block = int(p[P.SET])
    if not has_port(p):
        return BAD_INPUT
    n = int(p[block + SP.SIZE_U])
    size = 0.0
    for i in range(n):
        if i >= SP.U_PORT and i < SP.U_PORT + 2 * SP.PLANE:
            of_rates = i >= SP.U_PORT_RATE
            if of_rates and h == 0.0:
                u[n + i] = 0.0
            turns = (i - SP.U_PORT) % SP.PLANE >= Q.INNER_BY
            moved = (_ARM if turns else 1.0) * (0.5 * h if of_rates else 1.0) * u[n + i]
            size = max(size, abs(moved))
        elif u[n + i] != 0.0:
            return OK
    to = int(p[block + SP.AT_Z]) + SP.Z_PORT
    for i in range(SP.PLANE):
        z[to + i] = 0.0
    if size == 0.0:
        return OK
    length = h if h > 0.0 else _RESTING
    scale = min(_NEAR, _SLOWLY * length) / size
    longest = p[P.MAX_STEP]
    if length <= _SHORT:
        p[P.MAX_STEP] = min(longest, length / _PARTS)
    half = s.size // 2
    status = OK
    for k in range(2):
        side = 1.0 - 2.0 * k
        mine = s[half:] if k == 0 else s[:half]
        for i in range(half if k == 0 else 0):
            mine[i] = s[i]
        for i in range(SP.U_PORT, SP.U_PORT + 2 * SP.PLANE):
            u[i] += side * (1.0 + k) * scale * u[n + i]
        if status == OK:
            status = march_set(p, u[:n], mine, w, length)
        own = members.own_state(p, mine)
        for i in range(SP.PLANE):
            z[to + i] += side * own[SP.PORT_FORCE + i] / (2.0 * scale)
    p[P.MAX_STEP] = longest
    return status
