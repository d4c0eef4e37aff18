"""Newton solve with springs between the balls: exact correction of the block-arrow one.

One block per ball does not see that a spring ties a ball to its neighbours. With U picking the orbit row of
each ball, M = M0 - U T U^T, T = -t L, L the cyclic second difference (2, -1, -1) and
t = cos^2(pi / Z) (cv d + cx k) / m on the pitch circle: what a chord along the balls' ways gives. What it
gives across them, up to a tenth of a contact's stiffness at 2.5e7 N/m, and balls' own radii, which differ by
1e-4, are left to the iterations of a modified Newton method.

Sherman, Morrison and Woodbury: M^-1 r = x + M0^-1 U z with x = M0^-1 r, z = (I - T G)^-1 T U^T x and
G = U^T M0^-1 U. M0^-1 U is not stored: with b_j the bodies' response to a unit on ball j's orbit row, the
correction is one change of the bodies' part and one column of each ball's own inverse, both before the balls
are substituted back.
"""

import math

from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import in_groups
from fmu_bearing.engine.layout import FOUR, STRIDE, A, F, J, P, Q, W

_ORBIT = 2  # row of a ball's accelerations


@kernel
def spring_matrix(p, cv, cx, fac, w):
    """Bodies' response b_j and the matrix I - T G into ``fac`` (Z x Z at ``A.SPRING_BALLS``, to be inverted).

    ``cv``, ``cx``: weights of velocity and position as in ``block_arrow.factor``, whose factors are in
    ``fac`` already.
    """
    balls = int(p[P.BALLS])
    along = math.cos(PI / balls)
    strength = along * along * (cv * p[P.SPRING_DAMPING] + cx * p[P.SPRINGS]) / p[P.BALL_MASS]
    fac[A.SPRING] = strength
    for j in range(balls):
        ball = in_groups(j, A.GROUP)
        for h in range(Q.SIZE):
            total = 0.0
            for k in range(J.BALL):
                own = fac[ball + A.INVERSE + k * A.SIX + _ORBIT * FOUR]
                total += fac[ball + A.GB + h * A.SIX + k * FOUR] * own
            w[W.COLUMN + h] = total
        for g in range(Q.SIZE):
            total = 0.0
            for h in range(Q.SIZE):
                total -= fac[A.S + h * A.BORDER + g] * w[W.COLUMN + h]
            fac[A.SPRING_BODY + g * STRIDE + j] = total
    for j in range(balls):
        for i in range(balls):
            ball = in_groups(i, A.GROUP)
            total = fac[ball + A.INVERSE + _ORBIT * A.SIX + _ORBIT * FOUR] if i == j else 0.0
            for g in range(Q.SIZE):
                total -= fac[ball + A.W + g * A.SIX + _ORBIT * FOUR] * fac[A.SPRING_BODY + g * STRIDE + j]
            w[W.COLUMN + i] = total  # column j of G
        for i in range(balls):
            ahead = i + 1 if i + 1 < balls else 0
            behind = i - 1 if i > 0 else balls - 1
            second = 2.0 * w[W.COLUMN + i] - w[W.COLUMN + ahead] - w[W.COLUMN + behind]
            fac[A.SPRING_BALLS + i * balls + j] = strength * second + (1.0 if i == j else 0.0)


@kernel
def couple_springs(p, fac, d, w):
    """Correct the bodies' part in ``d`` and the balls' in the scratch rows, before the back substitution.

    On entry the rows ``W.OWN`` hold the balls' own inverses times their residual and ``d[F.BODY:]`` the
    bodies' solution, both without springs.
    """
    balls = int(p[P.BALLS])
    for j in range(balls):
        ball = in_groups(j, A.GROUP)
        total = w[W.OWN + _ORBIT * STRIDE + j]
        for g in range(Q.SIZE):
            total -= fac[ball + A.W + g * A.SIX + _ORBIT * FOUR] * d[F.BODY + g]
        w[W.SPRING_ORBIT + j] = total
    for j in range(balls):
        ahead = j + 1 if j + 1 < balls else 0
        behind = j - 1 if j > 0 else balls - 1
        second = 2.0 * w[W.SPRING_ORBIT + j] - w[W.SPRING_ORBIT + ahead] - w[W.SPRING_ORBIT + behind]
        w[W.SPRING_PULL + j] = -fac[A.SPRING] * second
    for i in range(balls):
        total = 0.0
        for j in range(balls):
            total += fac[A.SPRING_BALLS + i * balls + j] * w[W.SPRING_PULL + j]
        w[W.SPRING_RESPONSE + i] = total
    for j in range(balls, int(p[P.LANES])):
        w[W.SPRING_RESPONSE + j] = w[W.SPRING_RESPONSE]
    for g in range(Q.SIZE):
        total = d[F.BODY + g]
        for j in range(balls):
            total += fac[A.SPRING_BODY + g * STRIDE + j] * w[W.SPRING_RESPONSE + j]
        d[F.BODY + g] = total
    for j in range(int(p[P.LANES])):
        own = in_groups(j, A.GROUP) + A.INVERSE + _ORBIT * FOUR
        for k in range(J.BALL):
            w[W.OWN + k * STRIDE + j] += fac[own + k * A.SIX] * w[W.SPRING_RESPONSE + j]
