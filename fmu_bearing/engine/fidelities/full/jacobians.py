"""When Jacobians and factors are made again: those of the bearings that need it, as long as the others serve.

How a set contracts is the worst of its bearings' shares (`step.measure_contraction`), so renewing that
bearing's Jacobian is enough while the others' shares are small. Factors belong to the bearings, too; the
shaft's matrix is put together from all of them whenever one has changed. Where Newton's method fails, all
Jacobians are renewed. Arguments: see `step`.
"""

from fmu_bearing.engine.fidelities.full.progress import renew_jacobian
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import S, W, Y
from fmu_bearing.engine.mechanics.flexure import flexure_state
from fmu_bearing.engine.newton.block_arrow import factor
from fmu_bearing.engine.newton.modes import factor_modes
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.coupling import factor_set
from fmu_bearing.engine.spindle.elimination import condense_bearing

_OLDEST = 5e-3  # s: age at which the Jacobian is renewed in any case
# Factors serve a step within 5 % of theirs: the wrong scale contracts by about the same 0.05.
_SAME_STEP = (0.95, 1.05)
# Contraction beyond which a new Jacobian pays, over the number of bearings: with its factors it costs as much
# as five iterations of one bearing, and an iteration is one of them all. Runs of one bearing under 300 and
# 1000 N take 6 and 4 % less than with 0.3. With 0.1 the spindle at 20,000 r/min takes 13 % more, because a
# new Jacobian contracts no better there. With 0.1 for a bearing of any set, the QBC set of the benchmark
# takes 3 to 6 % more, with 0.05 the DB set 7 % (rigid shaft, 20,000 r/min, runs that scatter by 3 %).
_SLOW = 0.2


@kernel
def slowest(sb):
    """Return how a bearing contracts: as the worst of its stages."""
    return max(sb[S.CONTRACTION], sb[S.CONTRACTION + 1])


@kernel
def renewal_due(sb, slow):
    """Whether a bearing's Jacobian is too old, or contracts by more than ``slow``."""
    return sb[S.TIME] - sb[S.JACOBIAN_TIME] > _OLDEST or slowest(sb) > slow


@kernel
def renew_jacobians(p, s, w, every):
    """Renew the Jacobians that are due, or ``every`` one, unless made at the present state.

    Returns whether all belong to the present state now.
    """
    slow = _SLOW / members.bearing_count(p)
    fresh = True
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        if sb[S.JACOBIAN_TIME] == sb[S.TIME]:
            continue
        if every or renewal_due(sb, slow):
            renew_jacobian(members.parameters(p, b), sb, members.work(p, w, b))
        else:
            fresh = False
    return fresh


@kernel
def fresh_contraction(p, s):
    """How Newton's method contracts with Jacobians made for this step; 0 without any."""
    worst = 0.0
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        if sb[S.JACOBIAN_TIME] == sb[S.TIME]:
            worst = max(worst, slowest(sb))
    return worst


@kernel
def kind_of(stage):
    """Return which contraction in ``S.CONTRACTION`` a stage has: 0 the first implicit stage, 1 the others.

    They are met from guesses of different quality. What is left of a good guess is what the Jacobian knows
    least, and contracts slower than most of a poor one does.
    """
    return 0 if stage == 1 else 1


@kernel
def expected_contraction(p, s, stage):
    """How Newton's method is expected to contract in the first iteration of a stage."""
    worst = 0.0
    for b in range(members.bearing_count(p)):
        worst = max(worst, members.state(p, s, b)[S.CONTRACTION + kind_of(stage)])
    return worst


@kernel
def keep_contraction(p, s, w):
    """Store what the step just made has measured; nothing where it took one iteration a stage."""
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        sb = members.state(p, s, b)
        for kind in range(2):
            measured = wb[W.REPORT + W.CONTRACTION + kind]
            if measured > 0.0:
                sb[S.CONTRACTION + kind] = measured


@kernel
def same_step(sb, h):
    """Whether a bearing's factors serve a step ``h`` (s)."""
    ratio = h / (sb[S.FACTOR_STEP] + 1e-300)
    return not (ratio < _SAME_STEP[0] or ratio > _SAME_STEP[1])


@kernel
def factor_bearing(pb, sb, wb, gh):
    """Factors of a bearing for steps of weight ``gh`` (s); False if singular."""
    jac = sb[S.JAC : S.FAC]
    fac = sb[S.FAC : S.CONDENSED]
    if not factor(pb, jac, gh, gh * gh, gh * gh, fac, wb):
        return False
    factor_modes(
        pb, jac, fac, sb[S.Y : S.Y + Y.SIZE], sb[S.Y + Y.TH] - sb[S.JACOBIAN_ANGLE], sb[S.SPEED], gh,
        gh * gh, sb[flexure_state(pb) :], wb,
    )  # fmt: skip
    return True


@kernel
def factor_all(p, s, w, h, gh):
    """Factors for steps ``h`` (s) of weight ``gh`` (s), of bearings that have none and the shaft's.

    False if singular: the factors that were to change are none then.
    """
    changed = False
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        if same_step(sb, h):
            continue
        changed = True
        sb[S.FACTOR_STEP] = 0.0
        pb = members.parameters(p, b)
        if not factor_bearing(pb, sb, members.work(p, w, b), gh) or not condense_bearing(p, s, w, b):
            return False
    if changed and not factor_set(p, s, w, gh):
        return False
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        if sb[S.FACTOR_STEP] == 0.0:
            sb[S.FACTOR_STEP] = h
    return True
