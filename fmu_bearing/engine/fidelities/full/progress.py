"""What every way of stepping does to the state: renew the Jacobian, take a step over, add up energy."""

from fmu_bearing.engine.fidelities.full.flexible import accept_modes
from fmu_bearing.engine.jit import inlined, kernel
from fmu_bearing.engine.layout import (
    C_SIZE,
    F_SIZE,
    P_LANES,
    P_MODES,
    P_TOLERANCE,
    Q_CAGE,
    S_ANGLE,
    S_AXES,
    S_C,
    S_CONTRACTION,
    S_F,
    S_FAC,
    S_FACTOR_STEP,
    S_JAC,
    S_JACOBIAN_ANGLE,
    S_JACOBIAN_TIME,
    S_JACOBIANS,
    S_SPEED,
    S_SPEED_RATE,
    S_STEPS,
    S_TIME,
    S_Y,
    STRIDE,
    W_LAST,
    W_Y,
    Y_Q,
    Y_SIZE,
)
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

_S = STRIDE
# Amplitude (m) whose velocity at shaft speed the relative tolerance refers to: 10 mm/s at 20,000 r/min, as
# rings vibrate there; the slowest speed (rad/s) for which it shrinks with speed.
_AMPLITUDE = 5e-6
_SLOWEST = 20.0


@kernel
def velocity_tolerance(p, speed):
    """Error (m/s) allowed in the rings' velocities at a shaft speed (rad/s)."""
    return p[P_TOLERANCE] * _AMPLITUDE * max(abs(speed), _SLOWEST)


@kernel
def show_axes(p, s, w):
    """Rows ``W_AXES`` of the state in ``s``, for wavy balls, and the coordinates of flexible rings."""
    turn_axes(p, s[S_AXES:S_JAC], s[S_Y : S_Y + Y_SIZE], int(p[P_LANES]), 0.0, w)
    show_flexure(p, s, w)


@inlined
def total_energy(p, s, w):
    """Return the stored energy (J) of the state in ``s``; refresh its right-hand side on the way."""
    show_axes(p, s, w)
    right_hand_side(
        p, s[S_C : S_C + C_SIZE], s[S_Y : S_Y + Y_SIZE], s[S_ANGLE], s[S_SPEED], s[S_SPEED_RATE], w,
        s[S_F : S_F + F_SIZE],
    )  # fmt: skip
    energy = stored_energy(p, s[S_C : S_C + C_SIZE], s[S_Y : S_Y + Y_SIZE], w)
    if p[P_MODES] != 0.0:
        keep_accelerations(p, s, w)
        energy += flexure_energy(p, s[S_Y : S_Y + Y_SIZE], s[S_SPEED], w)
    return energy


@kernel
def wrap_angles(y):
    """Bring the balls' angles and the cage's back into one turn."""
    for j in range(_S):
        y[2 * _S + j] = wrap(y[2 * _S + j])
    y[Y_Q + Q_CAGE + 3] = wrap(y[Y_Q + Q_CAGE + 3])


@inlined
def renew_jacobian(p, s, w):
    """Jacobian at the present state; marks the factors as out of date."""
    show_axes(p, s, w)
    jacobian(
        p, s[S_C : S_C + C_SIZE], s[S_Y : S_Y + Y_SIZE], s[S_ANGLE], s[S_SPEED], s[S_SPEED_RATE], w,
        s[S_JAC:S_FAC],
    )  # fmt: skip
    s[S_JACOBIAN_TIME] = s[S_TIME]
    s[S_JACOBIAN_ANGLE] = s[S_Y + 2 * _S]
    s[S_FACTOR_STEP] = 0.0
    s[S_JACOBIANS] += 1.0
    s[S_CONTRACTION] = 0.1


@kernel
def accept(p, s, w, h):
    """Move the state to the end of the step just made; angles are brought back into one turn."""
    y = s[S_Y : S_Y + Y_SIZE]
    advance_axes(p, s[S_AXES:S_JAC], y, w[W_Y : W_Y + Y_SIZE], int(p[P_LANES]), h)
    for i in range(Y_SIZE):
        s[S_Y + i] = w[W_Y + i]
    for i in range(F_SIZE):
        s[S_F + i] = w[W_LAST + i]
    accept_modes(p, s, flexure_state(p), w)
    turn = wrap(s[S_Y + 2 * _S]) - s[S_Y + 2 * _S]
    if turn != 0.0:
        # the orbit angle at the Jacobian turns back with the balls
        s[S_JACOBIAN_ANGLE] += turn
    wrap_angles(s[S_Y : S_Y + Y_SIZE])
    s[S_ANGLE] = wrap(s[S_ANGLE] + h * (s[S_SPEED] + 0.5 * h * s[S_SPEED_RATE]))
    s[S_SPEED] += h * s[S_SPEED_RATE]
    s[S_TIME] += h
    s[S_STEPS] += 1.0
