"""What a step does to the state of a bearing: renew its Jacobian, accept the step; stored energy of all."""

from fmu_bearing.engine.fidelities.full.flexible import accept_modes
from fmu_bearing.engine.fidelities.full.vectors import copy_rows
from fmu_bearing.engine.fidelities.steps import advance_clock
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, STRIDE, C, F, P, Q, S, W, Y
from fmu_bearing.engine.mechanics.ball_waves import advance_axes, turn_axes
from fmu_bearing.engine.mechanics.energy import stored_energy
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.mechanics.flexure import (
    flexure_energy,
    flexure_state,
    keep_accelerations,
    show_flexure,
)
from fmu_bearing.engine.mechanics.trigonometry import wrap
from fmu_bearing.engine.newton.jacobian import jacobian
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.follow import accelerate
from fmu_bearing.engine.spindle.shaft import shaft_energy


@kernel
def show_axes(p, s, w):
    """Rows ``W.AXES`` of the state in ``s``, for wavy balls, and the coordinates of flexible rings."""
    turn_axes(p, s[S.AXES : S.JAC], s[S.Y : S.Y + Y.SIZE], int(p[P.LANES]), 0.0, w)
    show_flexure(p, s, w)


@kernel
def bearing_energy(p, s, w):
    """Return the stored energy (J) of a bearing; refresh its right-hand side, as of free rings."""
    show_axes(p, s, w)
    right_hand_side(
        p, s[S.C : S.C + C.SIZE], s[S.Y : S.Y + Y.SIZE], s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE], w,
        s[S.F : S.F + F.SIZE],
    )  # fmt: skip
    energy = stored_energy(p, s[S.C : S.C + C.SIZE], s[S.Y : S.Y + Y.SIZE], w)
    if p[P.MODES] != 0.0:
        keep_accelerations(p, s, w)
        energy += flexure_energy(p, s[S.Y : S.Y + Y.SIZE], s[S.SPEED], w)
    return energy


@kernel
def total_energy(p, s, w):
    """Return the stored energy (J) of the state; accelerations and powers there are computed again."""
    total = 0.0
    for b in range(members.bearing_count(p)):
        total += bearing_energy(members.parameters(p, b), members.state(p, s, b), members.work(p, w, b))
    if not members.has_shaft(p):
        return total
    own = members.set_state(p, s)
    work, bent, shaken = accelerate(p, s, w, False, 0.0, s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE])
    own[SP.POWER_NOW] = work
    own[SP.POWER_NOW + 1] = bent
    own[SP.POWER_NOW + 2] = shaken
    lanes = members.padded_size(p)
    total += shaft_energy(
        p, own, own, SP.S_HEAD, SP.S_HEAD + lanes, members.set_work(p, w), members.vector(p, SP.FORCE)
    )
    return total


@kernel
def wrap_angles(y):
    """Bring the balls' angles and the cage's back into one turn."""
    for j in range(STRIDE):
        y[Y.TH + j] = wrap(y[Y.TH + j])
    cage = Y.Q0 + Q.CAGE + Q.TURN
    y[cage] = wrap(y[cage])


@kernel
def renew_jacobian(p, s, w):
    """Jacobian at the present state; marks the factors as out of date."""
    show_axes(p, s, w)
    jacobian(
        p, s[S.C : S.C + C.SIZE], s[S.Y : S.Y + Y.SIZE], s[S.ANGLE], s[S.SPEED], s[S.SPEED_RATE], w,
        s[S.JAC:S.FAC],
    )  # fmt: skip
    s[S.JACOBIAN_TIME] = s[S.TIME]
    s[S.JACOBIAN_ANGLE] = s[S.Y + Y.TH]
    s[S.FACTOR_STEP] = 0.0
    s[S.JACOBIANS] += 1.0
    s[S.CONTRACTION] = s[S.CONTRACTION + 1] = 0.1


@kernel
def accept(p, s, w, h):
    """Move the state to the end of the step just made; angles are brought back into one turn."""
    lanes = int(p[P.LANES])
    y = s[S.Y : S.Y + Y.SIZE]
    advance_axes(p, s[S.AXES : S.JAC], y, w[W.STAGE : W.STAGE + Y.SIZE], lanes, h)
    copy_rows(w[W.STAGE :], y, Y.Q0 // STRIDE, lanes)
    for i in range(Y.Q0, Y.SIZE):
        y[i] = w[W.STAGE + i]
    copy_rows(w[W.LAST :], s[S.F :], F.BODY // STRIDE, lanes)
    for i in range(F.BODY, F.SIZE):
        s[S.F + i] = w[W.LAST + i]
    accept_modes(p, s, flexure_state(p), w)
    turn = wrap(s[S.Y + Y.TH]) - s[S.Y + Y.TH]
    if turn != 0.0:
        # the orbit angle at the Jacobian turns back with the balls
        s[S.JACOBIAN_ANGLE] += turn
    wrap_angles(s[S.Y : S.Y + Y.SIZE])
    advance_clock(s, h)
