"""Jacobian of the accelerations by forward differences.

A ball's accelerations depend on its own state and on the bodies', never on another ball's, so one
perturbation serves all balls at once: 9 evaluations for the ball columns. For the bodies' 34 only the forces
of the body that moves are evaluated.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import F, J, P, Q, W, Y
from fmu_bearing.engine.layout.sizes import STRIDE
from fmu_bearing.engine.mechanics.equations import (
    add_up,
    ball_accelerations,
    ball_forces,
    cage_forces,
    inner_forces,
    outer_forces,
    right_hand_side,
)

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
        return p[P.INNER_MASS]
    if i < 5:
        return p[P.INNER_TRANSVERSE]
    if i < 8:
        return p[P.OUTER_MASS]
    if i == 8:
        return p[P.OUTER_POLAR]
    if i < 11:
        return p[P.OUTER_TRANSVERSE]
    if i < 14:
        return p[P.CAGE_MASS]
    if i == 14:
        return p[P.CAGE_POLAR]
    return p[P.CAGE_TRANSVERSE]


@kernel
def is_angle(i):
    """Whether body coordinate ``i`` is an angle."""
    return (i == 3) | (i == 4) | ((i >= 8) & (i < 11)) | (i >= 14)


@kernel
def ball_columns(p, c, y, angle, speed, w, jac):
    """Blocks B and D: all balls moved at once; the unmoved answers stand in ``w[W_F0:]`` and ``w[W_G0:]``."""
    lanes = int(p[P.LANES])
    f = w[W.F : W.F0]
    f0 = w[W.F0 : W.F0 + (W.F0 - W.F)]
    caged = p[P.CAGE] != 0.0
    for k in range(9):
        step = _DISPLACEMENT if k < 2 else (_ANGLE if k == 2 else (_VELOCITY if k < 5 else _RATE))
        for j in range(lanes):
            y[k * STRIDE + j] += step
        ball_forces(p, c, y, angle, speed, w)
        ball_accelerations(p, y, w, f)
        per = 1.0 / step
        for j in range(lanes):
            y[k * STRIDE + j] -= step
        for i in range(6):
            for j in range(lanes):
                jac[J.B + (i * 9 + k) * STRIDE + j] = (f[i * STRIDE + j] - f0[i * STRIDE + j]) * per
        for i in range(Q.SIZE):
            scale = per / inertia(p, i)
            if i >= Q.CAGE and not caged or i == 0 and p[P.RIGID] != 0.0:
                scale = 0.0
            for j in range(lanes):
                jac[J.D + (i * 9 + k) * STRIDE + j] = (
                    w[W.BODY + i * STRIDE + j] - w[W.BODY_0 + i * STRIDE + j]
                ) * scale


@kernel
def moved_forces(p, c, y, angle, speed, i, w):
    """Evaluate anew the forces on the body to which coordinate ``i`` belongs: the others' rows hold."""
    if i < Q.OUTER:
        inner_forces(p, c, y, angle, speed, w)
    elif i < Q.CAGE:
        outer_forces(p, c, y, w)
    else:
        cage_forces(p, c, y, w)


@kernel
def jacobian(p, c, y, angle, speed, speed_rate, w, jac):
    """Fill the blocks B, C, D, E of ``jac`` at state ``y`` (rows per lane; E is 17 x 34, row-major)."""
    lanes = int(p[P.LANES])
    f = w[W.F : W.F0]
    f0 = w[W.F0 : W.F0 + (W.F0 - W.F)]
    right_hand_side(p, c, y, angle, speed, speed_rate, w, f0)
    for i in range(Q.SIZE * STRIDE):
        w[W.BODY_0 + i] = w[W.BODY + i]
    ball_columns(p, c, y, angle, speed, w, jac)
    ball_forces(p, c, y, angle, speed, w)
    for i in range(Q.SIZE):
        for rate in range(2):
            k = i + rate * Q.SIZE
            if rate == 0:
                step = _ANGLE if is_angle(i) else _DISPLACEMENT
            else:
                step = _RATE if is_angle(i) else _VELOCITY
            kept = y[Y.Q0 + k]
            y[Y.Q0 + k] = kept + step
            moved_forces(p, c, y, angle, speed, i, w)
            add_up(p, c, y, angle, speed, speed_rate, w, f)
            y[Y.Q0 + k] = kept
            per = 1.0 / step
            for n in range(6):
                for j in range(lanes):
                    jac[J.C + (n * 34 + k) * STRIDE + j] = (f[n * STRIDE + j] - f0[n * STRIDE + j]) * per
            for n in range(Q.SIZE):
                jac[J.E + n * 34 + k] = (f[F.BODY + n] - f0[F.BODY + n]) * per
        if i == Q.OUTER - 1 or i == Q.CAGE - 1:
            # the next coordinates are another body's: this one's rows go back to the unmoved state
            moved_forces(p, c, y, angle, speed, i, w)
