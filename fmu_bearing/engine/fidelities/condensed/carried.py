"""Losses where no steady state is found: those of quasi-static balls under the loads across the axis.

Each ball has its own load there, and rolls or is carried by the cage (``steady.carried``). Few are loaded, so
that the sum changes by up to a quarter while one ball takes the place of the next. What is frozen is its mean
over places of the balls within one pitch, with the same loads across on the inner ring.
"""

import math

from fmu_bearing.engine.fidelities.condensed.ball_form import freeze_rolling
from fmu_bearing.engine.fidelities.condensed.uneven import copy_losses, freeze_losses, set_losses
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, PT, STRIDE, L, P, Q, R, S, T, W, Y
from fmu_bearing.engine.statics.place import place_balls, place_cage
from fmu_bearing.engine.statics.quasistatic import forces_at_displacement
from fmu_bearing.engine.steady.carried import carry_balls
from fmu_bearing.engine.steady.point import state_at

_PHASES = 3  # places of the balls within one pitch
_ROUNDS = 4  # of Newton's method for the same loads: forces are then balanced to 1e-6 of them
_LONGEST = 5e-6  # m, in a round: about the approach of a loaded contact


@kernel
def turn(v, k, cosine, sine):
    """Give the pair y, z at ``v[k:]`` in axes that are turned about x."""
    y, z = v[k], v[k + 1]
    v[k] = cosine * y + sine * z
    v[k + 1] = cosine * z - sine * y


@kernel
def place_turned(p, c, first, angle, speed, y, w):
    """Quasi-static state ``y`` under the loads of ``first`` with balls ``angle`` (rad) further back.

    Given in axes that are turned with the balls: ball 0 is at 12 o'clock, and rings and loads are turned. The
    inner ring moves across the axis until the balls put the same force on it.
    """
    ring = w[W.PATTERN + PT.STEP : W.PATTERN + PT.STEP + EQ.FREEDOMS]
    tilt = w[W.TILT : W.TILT + 2]
    eq = w[W.EQUILIBRIUM : W.EQUILIBRIUM + EQ.SIZE]
    force = w[W.LOAD : W.LOAD + EQ.FREEDOMS]
    outer = Y.Q0 + Q.OUTER
    for i in range(EQ.FREEDOMS):
        ring[i] = first[Y.Q0 + i] - first[outer + (i if i < Q.TURN else i + 1)]
    for i in range(2):
        tilt[i] = first[outer + Q.BY + i]
    forces_at_displacement(p, c, speed, ring, tilt, 0.0, force, eq, w)
    cosine, sine = math.cos(angle), math.sin(angle)
    turn(force, Q.Y, cosine, sine)
    want_y, want_z = force[Q.Y], force[Q.Z]
    turn(ring, Q.Y, cosine, sine)
    turn(ring, Q.INNER_BY, cosine, sine)
    turn(tilt, 0, cosine, sine)
    for _ in range(_ROUNDS if angle != 0.0 else 0):
        forces_at_displacement(p, c, speed, ring, tilt, 0.0, force, eq, w)
        more_y, more_z = force[Q.Y] - want_y, force[Q.Z] - want_z
        row = EQ.STIFFNESS + EQ.FREEDOMS * Q.Y
        yy, yz = eq[row + Q.Y], eq[row + Q.Z]
        row += EQ.FREEDOMS
        zy, zz = eq[row + Q.Y], eq[row + Q.Z]
        size = yy * zz - yz * zy
        if not (size > 0.0):
            break
        dy = (more_y * zz - more_z * yz) / size
        dz = (more_z * yy - more_y * zy) / size
        share = min(1.0, _LONGEST / (math.sqrt(dy * dy + dz * dz) + 1e-300))
        ring[Q.Y] += share * dy
        ring[Q.Z] += share * dz
    forces_at_displacement(p, c, speed, ring, tilt, 0.0, force, eq, w)
    for i in range(Y.SIZE):
        y[i] = 0.0
    y[outer] = first[outer]
    for i in range(2):
        y[outer + Q.BY + i] = tilt[i]
    for i in range(EQ.FREEDOMS):
        y[Y.Q0 + i] = y[outer + (i if i < Q.TURN else i + 1)] + ring[i]
    place_balls(p, y, eq)
    if p[P.CAGE] != 0.0:
        place_cage(p, y, eq)


@kernel
def freeze_motion(p, y, turning, s, w):
    """Keep how balls turn and roll in the state ``y``, whose rows are in ``w``.

    Each ball passes through all loads: its spin is the mean of all balls by their loads.
    """
    lv = s[S.CONDENSED :]
    freeze_rolling(p, lv, y, turning, w)
    total = 0.0
    for j in range(int(p[P.BALLS])):
        total += w[W.RACE + R.LOAD + j]
    for i in range(3):
        mean = 0.0
        for j in range(int(p[P.BALLS])):
            mean += w[W.RACE + R.LOAD + j] / total * y[Y.WX + i * STRIDE + j]
        for j in range(int(p[P.LANES])):
            lv[L.SPIN + i * STRIDE + j] = mean / turning


@kernel
def orbit_of(p, y):
    """Return the orbit speed (rad/s) of the state ``y``: that of the cage, or the mean of the balls."""
    if p[P.CAGE] != 0.0:
        return y[Y.V0 + Q.CAGE + Q.TURN]
    mean = 0.0
    for j in range(int(p[P.BALLS])):
        mean += y[Y.OM + j] / p[P.BALLS]
    return mean


@kernel
def freeze_carried(p, c, first, speed, turning, s, w):
    """Put losses and orbit of the quasi-static state ``first`` in the place of those of even balls.

    ``c``: conditions without imperfections; ``speed`` of the shaft (rad/s), ``turning`` one that is not zero.
    Where balls have no balance those of even ones stay.
    """
    lv = s[S.CONDENSED :]
    y = state_at(w, PT.REST_STATE)
    mean = W.PATTERN + PT.RESIDUAL
    own = W.PATTERN + PT.UNKNOWNS
    orbit = 0.0
    for i in range(L.LOST):
        w[mean + i] = 0.0
    copy_losses(lv, s, w, T.FROZEN_LOST)
    for k in range(_PHASES):
        angle = 2.0 * math.pi * k / (_PHASES * p[P.BALLS])
        place_turned(p, c, first, angle, turning, y, w)
        if not carry_balls(p, c, y, turning, w, s[S.JAC : S.CONDENSED]):
            set_losses(lv, s, w, T.FROZEN_LOST)
            return
        freeze_losses(p, c, y, speed, turning, s, w)
        if k == 0:
            freeze_motion(p, y, turning, s, w)
        copy_losses(lv, s, w, own)
        for i in range(L.LOST):
            w[mean + i] += w[own + i] / _PHASES
        orbit += orbit_of(p, y) / _PHASES
    set_losses(lv, s, w, mean)
    lv[L.RATIO] = orbit / turning
    lv[L.TORQUE] = 0.0
    if speed != 0.0:
        lv[L.TORQUE] = (lv[L.HEAT] + lv[L.HEAT_OUTER] + lv[L.HEAT_OIL]) / speed
