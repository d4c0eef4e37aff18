"""Orbit and spin of each ball at the start: where friction, drag and gyroscopic moments balance.

Rolling at the middle of both contacts leaves sliding elsewhere on the ellipses (Heathcote), which would
show as a false friction torque in the first microseconds. Newton's method on the four rates of each ball
removes it; places and loads stay as the quasi-static kernel found them.
"""

import math

from fmu_bearing.engine.dense import eliminate
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import ST, STRIDE, F, J, P, W, Y
from fmu_bearing.engine.newton.jacobian import jacobian

_ROUNDS = 40
# Largest change per round over the spin speed: half the default slide-to-roll ratio at which traction
# saturates, so that one round does not cross from one sign of sliding to the other's plateau.
_STRIDE_LIMIT = 2.5e-3
# orbit and spin among the accelerations and among the state of a ball
_ANSWER = F.TH // STRIDE
_STATE = Y.OM // STRIDE


@kernel
def residual(f, lanes):
    """Sum of squares of the balls' angular accelerations (rad/s2), orbit and spin."""
    total = 0.0
    for i in range(ST.SPIN_RATES):
        row = F.TH + i * STRIDE
        for j in range(lanes):
            total += f[row + j] * f[row + j]
    return total


@kernel
def balance_spins(p, c, y, angle, speed, w, jac):
    """Move orbit and spin rates in ``y`` to their balance; leave them where Newton does not get there."""
    lanes = int(p[P.LANES])
    rates = ST.SPIN_RATES
    rows = w[W.SPIN_SYSTEM : W.SPIN_SYSTEM + ST.SPIN_SYSTEM_SIZE]
    first = 0.0
    last = 0.0
    for n in range(_ROUNDS):
        jacobian(p, c, y, angle, speed, 0.0, w, jac)
        f = w[W.F0 :]
        last = residual(f, lanes)
        if n == 0:
            first = last
            for i in range(rates * STRIDE):
                w[W.SPINS_FIRST + i] = y[Y.OM + i]
        if not (last > 1e-16 * first):
            break
        for j in range(lanes):
            spin = math.sqrt(y[Y.WX + j] ** 2 + y[Y.WR + j] ** 2 + y[Y.WT + j] ** 2) + 1e-3
            for i in range(rates):
                row = J.B + (_ANSWER + i) * J.STATES * STRIDE + j
                for k in range(rates):
                    rows[i * ST.SPIN_ROW + k] = jac[row + (_STATE + k) * STRIDE]
                rows[i * ST.SPIN_ROW + rates] = -f[F.TH + i * STRIDE + j]
            if not eliminate(rows, 0, rates):
                continue
            largest = 0.0
            for i in range(rates):
                largest = max(largest, abs(rows[i * ST.SPIN_ROW + rates]))
            share = min(1.0, _STRIDE_LIMIT * spin / (largest + 1e-300))
            for i in range(rates):
                y[Y.OM + i * STRIDE + j] += share * rows[i * ST.SPIN_ROW + rates]
    if not (last < 1e-4 * first):
        for i in range(rates * STRIDE):
            y[Y.OM + i] = w[W.SPINS_FIRST + i]
