"""Jacobian of the accelerations by forward differences.

A ball's accelerations depend on its own state and on the bodies', never on another ball's, so one
perturbation serves all balls at once: 9 evaluations for the ball columns. For the bodies' 34 only the forces
of the body that moves are evaluated.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    F_G,
    J_B,
    J_C,
    J_D,
    J_E,
    N_BODY,
    P_CAGE,
    P_CAGE_MASS,
    P_CAGE_POLAR,
    P_CAGE_TRANSVERSE,
    P_INNER_MASS,
    P_INNER_TRANSVERSE,
    P_LANES,
    P_OUTER_MASS,
    P_OUTER_POLAR,
    P_OUTER_TRANSVERSE,
    P_RIGID,
    Q_CAGE,
    Q_OUTER,
    STRIDE,
    W_F,
    W_F0,
    W_G,
    W_G0,
    Y_Q,
)
from fmu_bearing.engine.mechanics.equations import (
    add_up,
    ball_accelerations,
    ball_forces,
    cage_forces,
    inner_forces,
    outer_forces,
    right_hand_side,
)

_S = STRIDE
# Small against the contact approach (2e-6 m) and the traction law's slip scale (1e-3 m/s), large against
# rounding: the difference keeps about five digits.
_DISPLACEMENT = 1e-10
_ANGLE = 1e-8
_VELOCITY = 1e-6
_RATE = 1e-4


@kernel
def inertia(p, i):
    """Mass or moment of inertia that belongs to body coordinate ``i``."""
    if i < 3:
        return p[P_INNER_MASS]
    if i < 5:
        return p[P_INNER_TRANSVERSE]
    if i < 8:
        return p[P_OUTER_MASS]
    if i == 8:
        return p[P_OUTER_POLAR]
    if i < 11:
        return p[P_OUTER_TRANSVERSE]
    if i < 14:
        return p[P_CAGE_MASS]
    if i == 14:
        return p[P_CAGE_POLAR]
    return p[P_CAGE_TRANSVERSE]


@kernel
def is_angle(i):
    """Whether body coordinate ``i`` is an angle."""
    return (i == 3) | (i == 4) | ((i >= 8) & (i < 11)) | (i >= 14)


@kernel
def ball_columns(p, c, y, angle, speed, w, jac):
    """Blocks B and D: all balls moved at once; the unmoved answers stand in ``w[W_F0:]`` and ``w[W_G0:]``."""
    lanes = int(p[P_LANES])
    f = w[W_F:W_F0]
    f0 = w[W_F0 : W_F0 + (W_F0 - W_F)]
    caged = p[P_CAGE] != 0.0
    for k in range(9):
        step = _DISPLACEMENT if k < 2 else (_ANGLE if k == 2 else (_VELOCITY if k < 5 else _RATE))
        for j in range(lanes):
            y[k * _S + j] += step
        ball_forces(p, c, y, angle, speed, w)
        ball_accelerations(p, y, w, f)
        per = 1.0 / step
        for j in range(lanes):
            y[k * _S + j] -= step
        for i in range(6):
            for j in range(lanes):
                jac[J_B + (i * 9 + k) * _S + j] = (f[i * _S + j] - f0[i * _S + j]) * per
        for i in range(N_BODY):
            scale = per / inertia(p, i)
            if i >= Q_CAGE and not caged or i == 0 and p[P_RIGID] != 0.0:
                scale = 0.0
            for j in range(lanes):
                jac[J_D + (i * 9 + k) * _S + j] = (w[(W_G + i) * _S + j] - w[W_G0 + i * _S + j]) * scale


@kernel
def moved_forces(p, c, y, angle, speed, i, w):
    """Evaluate anew the forces on the body to which coordinate ``i`` belongs: the others' rows hold."""
    if i < Q_OUTER:
        inner_forces(p, c, y, angle, speed, w)
    elif i < Q_CAGE:
        outer_forces(p, c, y, w)
    else:
        cage_forces(p, c, y, w)


@kernel
def jacobian(p, c, y, angle, speed, speed_rate, w, jac):
    """Fill the blocks B, C, D, E of ``jac`` at state ``y`` (rows per lane; E is 17 x 34, row-major)."""
    lanes = int(p[P_LANES])
    f = w[W_F:W_F0]
    f0 = w[W_F0 : W_F0 + (W_F0 - W_F)]
    right_hand_side(p, c, y, angle, speed, speed_rate, w, f0)
    for i in range(N_BODY * _S):
        w[W_G0 + i] = w[W_G * _S + i]
    ball_columns(p, c, y, angle, speed, w, jac)
    ball_forces(p, c, y, angle, speed, w)
    for i in range(N_BODY):
        for rate in range(2):
            k = i + rate * N_BODY
            if rate == 0:
                step = _ANGLE if is_angle(i) else _DISPLACEMENT
            else:
                step = _RATE if is_angle(i) else _VELOCITY
            kept = y[Y_Q + k]
            y[Y_Q + k] = kept + step
            moved_forces(p, c, y, angle, speed, i, w)
            add_up(p, c, y, angle, speed, speed_rate, w, f)
            y[Y_Q + k] = kept
            per = 1.0 / step
            for n in range(6):
                for j in range(lanes):
                    jac[J_C + (n * 34 + k) * _S + j] = (f[n * _S + j] - f0[n * _S + j]) * per
            for n in range(N_BODY):
                jac[J_E + n * 34 + k] = (f[F_G + n] - f0[F_G + n]) * per
        if i == Q_OUTER - 1 or i == Q_CAGE - 1:
            # the next coordinates are another body's: this one's rows go back to the unmoved state
            moved_forces(p, c, y, angle, speed, i, w)
