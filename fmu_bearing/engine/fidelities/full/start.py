"""The state at initialisation: the steady one under preload, radial loads, weights and misalignment.

Rings rest on their springs, bent by their loads where they are flexible; each ball has its own place, orbit
and spin. From the quasi-static state of the bearing with its imperfections, all is moved by what steady and
quasi-static state of the perfect bearing differ by.
"""

from fmu_bearing.engine.choices import FULL
from fmu_bearing.engine.fidelities.full.progress import show_axes, total_energy
from fmu_bearing.engine.fidelities.full.settle import settle
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, PT, C, F, P, Q, S, U, W, Y
from fmu_bearing.engine.mechanics.ball_waves import first_axes
from fmu_bearing.engine.mechanics.conditions import conditions
from fmu_bearing.engine.readout.losses import summarise
from fmu_bearing.engine.statics.place import equilibrium, loads, place_balls, place_cage, place_rings
from fmu_bearing.engine.statics.rigid_preload import rigid_start
from fmu_bearing.engine.statics.spin_balance import balance_spins
from fmu_bearing.engine.status import OK, TOO_SOFT
from fmu_bearing.engine.steady.even import NONE
from fmu_bearing.engine.steady.point import EVEN_BALLS, NOT_FOUND, move_to_steady, settle_perfect

FAR = 0.3  # of the pitch radius: beyond it the angles of pockets and waves, series in it, lose a micrometre


@kernel
def place_rest(p, c, y, found, s, w):
    """Place balls and cage in the state ``y`` about the rings there, from the equilibrium ``found``."""
    place_balls(p, y, found)
    if p[P.CAGE] != 0.0:
        place_cage(p, y, found)
    first_axes(p, s[S.AXES : S.JAC])
    show_axes(p, s, w)


@kernel
def become_steady(p, c, y, first, held, s, w, speed):
    """Move the quasi-static state ``y`` by what the steady state differs from ``first``, the perfect one.

    ``held``: see `steady.even`. Where no steady state is near, orbit and spins alone are balanced.
    """
    jac = s[S.JAC : S.CONDENSED]
    settled = NOT_FOUND
    # fidelities rings and response find theirs with what they hold
    if p[P.FIDELITY] == FULL:
        settled = settle_perfect(p, c, first, speed, held, w, jac)
    if p[P.MODES] != 0.0:
        # bent rings hold their balls where they are
        settled = min(settled, EVEN_BALLS)
    s[S.SETTLED] = settled
    if settled == NOT_FOUND:
        balance_spins(p, c, y, 0.0, speed, w, jac)
        if p[P.CAGE] != 0.0:
            orbit = 0.0
            for j in range(int(p[P.BALLS])):
                orbit += y[Y.OM + j] / p[P.BALLS]
            y[Y.V0 + Q.CAGE + Q.TURN] = orbit
        return
    for i in range(Y.SIZE):
        y[i] -= first[i]
    move_to_steady(p, first, settled, w)
    for i in range(Y.SIZE):
        y[i] += first[i]


@kernel
def begin_clock(p, s, speed, t):
    """Clock, and what steps and Jacobian begin with, at time ``t`` (s)."""
    s[S.TIME] = t
    s[S.START] = t
    s[S.SPEED] = speed
    s[S.SPEED_RATE] = 0.0
    s[S.STEP] = min(2e-6, p[P.MAX_STEP])
    s[S.FACTOR_STEP] = 0.0
    s[S.JACOBIAN_TIME] = -1e300
    s[S.CONTRACTION] = 0.1
    s[S.JACOBIANS] = 0.0


@kernel
def begin_means(s):
    """Mean heats (W) and torque (N m) before the first communication step: those of the start."""
    for i in range(3):
        s[S.MEAN_HEAT + i] = s[S.F + F.HEAT + i]
    s[S.MEAN_TORQUE] = s[S.F + F.TORQUE]


@kernel
def place_perfect(p, c, speed, load, carried, found, first, w):
    """Put the quasi-static state of the perfect bearing to ``first``; leave it where there is none."""
    tilt = w[W.TILT : W.TILT + 2]
    if equilibrium(p, c, speed, load, 0.0, tilt, found, w) != OK:
        return
    for i in range(Y.SIZE):
        first[i] = 0.0
    place_rings(c, first, found, tilt, c[C.LOAD_Y], carried)
    place_balls(p, first, found)
    if p[P.CAGE] != 0.0:
        place_cage(p, first, found)


@kernel
def start(p, u, s, w, t):
    """Fill the state ``s`` for the inputs ``u`` at time ``t`` (s); status code."""
    for i in range(s.size):
        s[i] = 0.0
    for i in range(W.MOTION):
        w[i] = 0.0
    c = s[S.C : S.C + C.SIZE]
    conditions(p, u, u[U.SPEED], c)
    load = w[W.LOAD : W.LOAD + EQ.FREEDOMS]
    tilt = w[W.TILT : W.TILT + 2]
    found = w[W.FOUND : W.FOUND + EQ.SIZE]
    if p[P.RIGID] != 0.0:
        status = rigid_start(p, u, c, s, w, found)
        if status != OK:
            return status
    carried = loads(p, c, load)
    status = equilibrium(p, c, u[U.SPEED], load, 1.0, tilt, found, w)
    if status != OK:
        return status
    y = s[S.Y : S.Y + Y.SIZE]
    place_rings(c, y, found, tilt, c[C.LOAD_Y], carried)
    if abs(y[Y.Q0 + Q.OUTER + Q.Y]) + abs(y[Y.Q0 + Q.OUTER + Q.Z]) > FAR * p[P.PITCH_RADIUS]:
        return TOO_SOFT
    if p[P.RIGID] != 0.0:
        y[Y.Q0] = s[S.PLACE]
    place_rest(p, c, y, found, s, w)
    settle(p, c, y, 0.0, u[U.SPEED], s, w)
    first = w[W.PATTERN + PT.FIRST_STATE : W.PATTERN + PT.EVEN_STATE]
    for i in range(Y.SIZE):
        first[i] = y[i]
    if c[C.OVERSIZE_SCALE] != 0.0 and p[P.MODES] == 0.0:
        place_perfect(p, c, u[U.SPEED], load, carried, found, first, w)
    c[C.PRELOAD] = u[U.PRELOAD]
    become_steady(p, c, y, first, NONE, s, w, u[U.SPEED])
    if p[P.RIGID] != 0.0:
        y[Y.Q0] = s[S.PLACE]
    begin_clock(p, s, u[U.SPEED], t)
    s[S.ENERGY_START] = total_energy(p, s, w)
    s[S.ENERGY_NOW] = s[S.ENERGY_START]
    summarise(p, s, w)
    begin_means(s)
    return OK
