"""What is frozen between changes of the inputs: cage speed, gyroscopic friction, torque and heats.

All come from the full right-hand side at the steady state: forces from the one under the axial load alone,
with even balls and a centred cage (``steady.even``), losses from the whole (``uneven``), without
imperfections. The torque is what puts in the heats. They are renewed when the speed has moved by 1 % or a
condition by 0.1 %; in between orbit and spins follow the speed, the friction across the tracks its square,
and the heats stay (below 1 rad/s they go to zero with the speed squared). A renewal costs some 30 evaluations
of the full right-hand side with its Jacobian.
"""

from fmu_bearing.engine.fidelities.condensed.ball_form import freeze_rolling
from fmu_bearing.engine.fidelities.condensed.uneven import freeze_losses, race_growth
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import PT, STRIDE, C, L, P, Q, R, S, U, W, Y
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.statics.rigid_preload import cold_place
from fmu_bearing.engine.statics.spin_balance import balance_spins
from fmu_bearing.engine.status import OK
from fmu_bearing.engine.steady.even import between_races, equalise_balls, settle_evenly

_STANDSTILL = 1.0  # rad/s: slower shafts are given the ratios of this speed


@kernel
def nonzero_speed(speed):
    """Return the speed (rad/s), not zero, at which the state that is frozen at ``speed`` turns."""
    if abs(speed) < _STANDSTILL:
        return -_STANDSTILL if speed < 0.0 else _STANDSTILL
    return speed


@kernel
def frozen_conditions(p, u, speed, lv, c):
    """Put the conditions ``c`` of what is frozen to ``u``'s at ``speed``; return a speed (rad/s) not zero."""
    conditions(p, u, speed, c)
    lv[L.FROZEN_SPEED] = speed
    c[C.OVERSIZE_SCALE] = 0.0
    c[C.ECCENTRICITY] = 0.0
    c[C.CAGE_ECCENTRICITY] = 0.0
    return nonzero_speed(speed)


@kernel
def apply_rigid_preload(p, u, s, w):
    """Let rigid preload put the inner ring to its place for a new preload in ``u``, at once."""
    lv = s[S.CONDENSED :]
    place, status = cold_place(p, u, u[U.PRELOAD], w)
    if status == OK:
        s[S.PLACE] = place
        lv[L.MEAN + Q.X] = place
        lv[L.Q0 + Q.X] = place


@kernel
def transverse_friction(race, w):
    """Friction (N) of a race on ball 0 across its track, in the last right-hand side; see `balls.balance`."""
    row = W.RACE + race * R.SIZE
    force = W.FORCE + race * W.FORCE_SIZE
    return w[force + W.FR] * w[row + R.SINA] - w[force + W.FX] * w[row + R.COSA]


@kernel
def freeze_at(p, speed, turning, rings_fixed, s, w):
    """Renew what is frozen with even balls, from the quasi-static point and its conditions in the state.

    At ``speed`` (rad/s) of the shaft; ``turning``: one that is not zero; ``rings_fixed``: see `steady.even`.
    """
    lv = s[S.CONDENSED :]
    c = lv[L.CONDITIONS : L.CONDITIONS + C.SIZE]
    y = lv[L.Y0 : L.Y0 + Y.SIZE]
    jac = s[S.JAC : S.CONDENSED]
    quasistatic = w[W.PATTERN + PT.REST_STATE : W.PATTERN + PT.WHIRL_STATE]
    for i in range(Y.SIZE):
        quasistatic[i] = y[i]
    equalise_balls(p, c, y, turning)
    if not settle_evenly(p, c, y, turning, rings_fixed, w, jac):
        for i in range(Y.SIZE):
            y[i] = quasistatic[i]
        balance_spins(p, c, y, 0.0, turning, w, jac)
    balls = int(p[P.BALLS])
    mean = 0.0
    for j in range(balls):
        mean += y[Y.OM + j] / balls
    lv[L.RATIO] = mean / turning
    if p[P.CAGE] != 0.0:
        y[Y.V0 + Q.CAGE + Q.TURN] = mean
    for j in range(int(p[P.LANES])):
        for i in range(3):
            lv[L.SPIN + i * STRIDE + j] = y[Y.WX + i * STRIDE + j] / turning
    freeze_losses(p, c, y, speed, turning, s, w)
    freeze_rolling(p, lv, y, turning, w)
    # nothing holds a loose ball across its track
    share = 1.0 / (turning * turning) if between_races(w) else 0.0
    lv[L.PAIR_INNER] = share * transverse_friction(0, w)
    lv[L.PAIR_OUTER] = share * transverse_friction(1, w)
    # the rings' motion is found with balls that are free in their pockets
    lag = y[Y.TH]
    lv[L.LAG] = lag
    for j in range(int(p[P.LANES])):
        y[Y.TH + j] -= lag


@kernel
def deviation(lv, c, speed):
    """How far speed and conditions are from those of the frozen values; 1: as far as they may be at rest."""
    most = abs(speed - lv[L.FROZEN_SPEED]) / (0.01 * abs(lv[L.FROZEN_SPEED]) + 1e-3)
    for i in (C.PRELOAD, C.LOAD_Y, C.LOAD_Z, C.VISCOSITY, C.PEDESTAL, C.BALL_RADIUS):
        frozen = lv[L.CONDITIONS + i]
        most = max(most, abs(c[i] - frozen) / (1e-3 * abs(frozen) + 1e-12))
    # 1e-3 of a contact's approach
    return max(most, race_growth(c, lv, L.CONDITIONS) / 1e-9)
