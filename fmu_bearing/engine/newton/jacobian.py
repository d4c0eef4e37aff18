"""Jacobian of the accelerations by forward differences.

A ball's accelerations depend on its own state and on the bodies', never on another ball's, so one
perturbation serves all balls at once: nine evaluations for the ball columns. For the 34 of the
bodies only the forces of the body that moves are evaluated.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, F, J, P, Q, W, Y
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
    if i < Q.INNER + Q.INNER_BY:
        return p[P.INNER_MASS]
    if i < Q.OUTER:
        return p[P.INNER_TRANSVERSE]
    if i < Q.OUTER + Q.TURN:
        return p[P.OUTER_MASS]
    if i == Q.OUTER + Q.TURN:
        return p[P.OUTER_POLAR]
    if i < Q.CAGE:
        return p[P.OUTER_TRANSVERSE]
    if i < Q.CAGE + Q.TURN:
        return p[P.CAGE_MASS]
    if i == Q.CAGE + Q.TURN:
        return p[P.CAGE_POLAR]
    return p[P.CAGE_TRANSVERSE]


@kernel
def is_angle(i):
    """Whether body coordinate ``i`` is an angle."""
    inner = (i == Q.INNER + Q.INNER_BY) | (i == Q.INNER + Q.INNER_BZ)
    return inner | ((i >= Q.OUTER + Q.TURN) & (i < Q.CAGE)) | (i >= Q.CAGE + Q.TURN)


@kernel
def ball_columns(p, c, y, angle, speed, w, jac):
    """Blocks B and D: all balls moved at once; the unmoved answers stand at ``W.F0`` and ``W.BODY_0``."""
    lanes = int(p[P.LANES])
    f = w[W.F : W.F + F.SIZE]
    f0 = w[W.F0 : W.F0 + F.SIZE]
    caged = p[P.CAGE] != 0.0
    for k in range(J.STATES):
        row = k * STRIDE
        if row < Y.VX:
            step = _ANGLE if row == Y.TH else _DISPLACEMENT
        else:
            step = _VELOCITY if row < Y.OM else _RATE
        for j in range(lanes):
            y[row + j] += step
        ball_forces(p, c, y, angle, speed, w)
        ball_accelerations(p, y, w, f)
        per = 1.0 / step
        for j in range(lanes):
            y[row + j] -= step
        for i in range(J.BALL):
            out = J.B + (i * J.STATES + k) * STRIDE
            for j in range(lanes):
                jac[out + j] = (f[i * STRIDE + j] - f0[i * STRIDE + j]) * per
        for i in range(Q.SIZE):
            scale = per / inertia(p, i)
            if i >= Q.CAGE and not caged or i == 0 and p[P.RIGID] != 0.0:
                scale = 0.0
            out = J.D + (i * J.STATES + k) * STRIDE
            for j in range(lanes):
                jac[out + j] = (w[W.BODY + i * STRIDE + j] - w[W.BODY_0 + i * STRIDE + j]) * scale


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
    """Fill the blocks B, C, D, E of ``jac`` at state ``y``, as ``layout.jacobian`` places them."""
    lanes = int(p[P.LANES])
    f = w[W.F : W.F + F.SIZE]
    f0 = w[W.F0 : W.F0 + F.SIZE]
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
            for n in range(J.BALL):
                out = J.C + (n * J.BODIES + k) * STRIDE
                for j in range(lanes):
                    jac[out + j] = (f[n * STRIDE + j] - f0[n * STRIDE + j]) * per
            for n in range(Q.SIZE):
                jac[J.E + n * J.BODIES + k] = (f[F.BODY + n] - f0[F.BODY + n]) * per
        if i == Q.OUTER - 1 or i == Q.CAGE - 1:
            # the next coordinates are another body's: this one's rows go back to the unmoved state
            moved_forces(p, c, y, angle, speed, i, w)
