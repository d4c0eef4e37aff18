"""What is held between changes of the inputs: cage speed, gyroscopic friction, torque and heats.

All come from one evaluation of the full right-hand side at the quasi-static point under the axial load
alone, with the balls' spins balanced and without imperfections. (Under a radial load the balls' own orbit
speeds differ, and before a cage has evened them out the same evaluation shows several times the settled
losses.) The torque is what puts in the heats: at that point the lands' drag still speeds up a cage that the
balls do not hold back yet, which would be 15 % more; fidelity `full` settles at the heats. They are renewed
when the speed has moved by 1 % or a condition by 0.1 %; in between orbit and spins follow the speed, the
gyroscopic friction its square, and the heats stay (below 1 rad/s they go to zero with the speed squared). A
renewal costs some 30 evaluations of the full right-hand side with its Jacobian.
"""

from fmu_bearing.engine.choices import INNER_CONTROL, OUTER_CONTROL
from fmu_bearing.engine.fidelities.condensed.ball_form import hold_rolling
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, STRIDE, C, F, L, P, Q, S, T, W, Y
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.readout.losses import summarise
from fmu_bearing.engine.statics.place import equilibrium, place_balls, place_cage, place_rings
from fmu_bearing.engine.statics.spin_balance import balance_spins
from fmu_bearing.engine.status import OK

_STANDSTILL = 1.0  # rad/s: slower shafts are given the ratios of this speed


@kernel
def quasistatic_point(p, c, speed, y, w):
    """State ``y`` at the quasi-static point under the axial load in ``c``; orbit times spin r there.

    Returns ``(status, mean over the balls of orbit speed times spin about r, (rad/s)^2)``. The one place
    that knows the quasi-static kernel.
    """
    load = w[W.LOAD : W.LOAD + EQ.FREEDOMS]
    tilt = w[W.TILT : W.TILT + 2]
    found = w[W.FOUND : W.FOUND + EQ.SIZE]
    for i in range(1, EQ.FREEDOMS):
        load[i] = 0.0
    load[0] = c[C.PRELOAD]
    status = equilibrium(p, c, speed, load, 0.0, tilt, found, w)
    if status != OK:
        return status, 0.0
    for i in range(Y.SIZE):
        y[i] = 0.0
    place_rings(c, y, found, tilt, 0.0, 0.0)
    place_balls(p, y, found)
    if p[P.CAGE] != 0.0:
        place_cage(p, y, found)
    return OK, gyroscopic_mean(p, found)


@kernel
def summarise_held(p, s, y, f, w):
    """Losses by source at the held state ``y`` with its right-hand side ``f``; the state in ``s`` stays.

    A step's first sound sample is interpolated from what ``s`` was published with.
    """
    heat = s[S.F + F.HEAT_OIL]
    s[S.F + F.HEAT_OIL] = f[F.HEAT_OIL]
    for j in range(STRIDE):
        w[T.HELD_ROWS + j] = s[S.Y + Y.OM + j]
        w[T.HELD_ROWS + STRIDE + j] = s[S.Y + Y.R + j]
        s[S.Y + Y.OM + j] = y[Y.OM + j]
        s[S.Y + Y.R + j] = y[Y.R + j]
    summarise(p, s, w)
    s[S.F + F.HEAT_OIL] = heat
    for j in range(STRIDE):
        s[S.Y + Y.OM + j] = w[T.HELD_ROWS + j]
        s[S.Y + Y.R + j] = w[T.HELD_ROWS + STRIDE + j]


@kernel
def held_speed(p, u, speed, lv, c):
    """Put the conditions ``c`` of what is held to those of ``u`` at ``speed``; a speed (rad/s) not zero."""
    conditions(p, u, speed, c)
    lv[L.FOUND_SPEED] = speed
    c[C.OVERSIZE_SCALE] = 0.0
    if abs(speed) < _STANDSTILL:
        return -_STANDSTILL if speed < 0.0 else _STANDSTILL
    return speed


@kernel
def gyroscopic_mean(p, found):
    """Mean over the balls of orbit speed times spin about r ((rad/s)^2) at the equilibrium ``found``."""
    gyroscopic = 0.0
    balls = int(p[P.BALLS])
    for j in range(balls):
        gyroscopic += found[EQ.OM + j] * found[EQ.WR + j] / balls
    return gyroscopic


@kernel
def hold(p, u, speed, s, w):
    """Renew everything held at ``speed`` (rad/s) and the inputs ``u``; status code, old values on failure."""
    lv = s[S.CONDENSED :]
    c = lv[L.CONDITIONS : L.CONDITIONS + C.SIZE]
    y = lv[L.Y0 : L.Y0 + Y.SIZE]
    turning = held_speed(p, u, speed, lv, c)
    status, gyroscopic = quasistatic_point(p, c, turning, y, w)
    if status == OK:
        hold_at(p, speed, turning, gyroscopic, s, w)
    return status


@kernel
def hold_at(p, speed, turning, gyroscopic, s, w):
    """Renew what is held, at ``speed`` (rad/s), with the quasi-static point and its conditions in the state.

    ``turning``: a shaft speed that is not zero; ``gyroscopic``: see `quasistatic_point`.
    """
    lv = s[S.CONDENSED :]
    c = lv[L.CONDITIONS : L.CONDITIONS + C.SIZE]
    y = lv[L.Y0 : L.Y0 + Y.SIZE]
    square = turning * turning
    pair = p[P.BALL_INERTIA] * gyroscopic / (c[C.BALL_RADIUS] * square)
    if p[P.GYROSCOPIC] == 0.0:
        pair = 0.0
    outer = 0.5
    if p[P.RACE_CONTROL] == OUTER_CONTROL:
        outer = 1.0
    elif p[P.RACE_CONTROL] == INNER_CONTROL:
        outer = 0.0
    lv[L.PAIR_INNER] = (1.0 - outer) * pair
    lv[L.PAIR_OUTER] = outer * pair
    balance_spins(p, c, y, 0.0, turning, w, s[S.JAC : S.CONDENSED])
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
    f = w[T.HELD_F : T.HELD_F + F.SIZE]
    right_hand_side(p, c, y, 0.0, turning, 0.0, w, f)
    hold_rolling(p, lv, y, turning, w)
    summarise_held(p, s, y, f, w)
    share = speed / turning
    lv[L.TORQUE] = share * (f[F.HEAT] + f[F.HEAT_OUTER] + f[F.HEAT_OIL]) / turning
    for i in range(3):
        lv[L.HEAT + i] = share * share * f[F.HEAT + i]
    for i in range(4):
        s[S.LOSS + i] *= share * share
    twist = 0.0
    for j in range(balls):
        twist += w[W.BODY + (Q.OUTER + Q.TURN) * STRIDE + j]
    lv[L.TWIST] = share * twist


@kernel
def out_of_date(lv, c, speed):
    """Whether speed or a condition has left the neighbourhood of the held values."""
    far = abs(speed - lv[L.FOUND_SPEED]) > 0.01 * abs(lv[L.FOUND_SPEED]) + 1e-3
    for i in (C.PRELOAD, C.LOAD_Y, C.LOAD_Z, C.VISCOSITY, C.PEDESTAL, C.BALL_RADIUS):
        if abs(c[i] - lv[L.CONDITIONS + i]) > 1e-3 * abs(lv[L.CONDITIONS + i]) + 1e-12:
            far = True
    for race in range(2):
        # groove circles and free distance move by micrometres: 1e-3 of a contact's approach
        for i in (C.GROOVE_X, C.GROOVE_RADIUS, C.FREE):
            k = C.RACES + race * C.RACE_SIZE + i
            if abs(c[k] - lv[L.CONDITIONS + k]) > 1e-9:
                far = True
    return far
