"""Contacts of the balls with both races: from what a step computed to the state, from there to the outputs.

Outputs follow from the state alone, so the state keeps the rows of `layout.race` that they are made of: with
sizes, surfaces and damping, as the balls feel them.
"""

import math

from fmu_bearing.engine.choices import RESPONSE
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, C, L, P, R, S, W, Y, Z
from fmu_bearing.engine.mechanics.contact import approach_under, carries_both_ways
from fmu_bearing.engine.statics.stiffness import series_stiffness


@kernel
def knows_balls(p, s):
    """Whether a bearing's balls are where they belong at its state: always, but in `response` unread ones."""
    return p[P.FIDELITY] != RESPONSE or s[S.CONDENSED + L.KNOWN] > 0.0


@kernel
def keep_contacts(p, s, w):
    """Keep what outputs need of the rows of both races in ``w``."""
    for race in range(2):
        row = W.RACE + race * R.SIZE
        to = S.CONTACTS + race * R.KEPT
        for j in range(0, int(p[P.LANES]), FOUR):
            store(s, to + R.KEPT_APPROACH + j, load(w, row + R.APPROACH + j))
            store(s, to + R.KEPT_LOAD + j, load(w, row + R.LOAD + j))
            store(s, to + R.KEPT_SINA + j, load(w, row + R.SINA + j))
            store(s, to + R.KEPT_COSA + j, load(w, row + R.COSA + j))


@kernel
def kept(p, c, s, race, j):
    """Contact of ball ``j`` with a race as `series_stiffness` takes it."""
    at = S.CONTACTS + race * R.KEPT + j
    free = c[C.RACES + race * C.RACE_SIZE + C.FREE]
    approach = max(s[at + R.KEPT_APPROACH], 0.0)
    stiffness = p[P.RACES + race * P.RACE_SIZE + P.RACE_STIFFNESS]
    return stiffness, approach, free + approach, s[at + R.KEPT_SINA], s[at + R.KEPT_COSA]


@kernel
def nearest_shoulder(p, s, race):
    """Least angle (rad) by which an ellipse at a race with two shoulders ends before the nearer one."""
    numbers = P.RACES + race * P.RACE_SIZE
    least = p[numbers + P.RACE_SHOULDER]
    for j in range(int(p[P.BALLS])):
        at = S.CONTACTS + race * R.KEPT + j
        if s[at + R.KEPT_LOAD] > 0.0:
            approach = approach_under(p[numbers + P.RACE_STIFFNESS], s[at + R.KEPT_LOAD])
            half = p[numbers + P.RACE_HALF_LENGTH] * math.sqrt(approach)
            angle = math.asin(min(1.0, abs(s[at + R.KEPT_SINA])))
            reach = math.asin(min(1.0, half / p[numbers + P.RACE_PROFILE_RADIUS]))
            least = min(least, p[numbers + P.RACE_SHOULDER] - angle - reach)
    return least


@kernel
def contacts(p, s, z):
    """Write loads, angles, pressures, shoulder margins, film over roughness and stiffness between the rings.

    The margin is the angle (rad) by which the ellipse of the most loaded contact ends before its shoulder; of
    a deep groove bearing the least of all contacts, each to its nearer shoulder.
    Loads are those that the balls feel, with sizes, surfaces and damping; pressures are those of the
    approach. Film: Hamrock and Dowson (1977), minimum film, with the rolling speed of a ball that does not
    slip.
    """
    c = s[S.C : S.C + C.SIZE]
    pitch = p[P.PITCH_RADIUS]
    balls = int(p[P.BALLS])
    ball = c[C.BALL_RADIUS]
    thinnest = 1e30
    for i in range(2 * Z.CONTACT_SIZE):
        z[Z.CONTACT + i] = 0.0
    z[Z.AXIAL_STIFFNESS] = 0.0
    z[Z.RADIAL_STIFFNESS] = 0.0
    for j in range(balls):
        om = s[S.Y + Y.OM + j]
        for race in range(2):
            numbers = P.RACES + race * P.RACE_SIZE
            carried = s[S.CONTACTS + race * R.KEPT + R.KEPT_LOAD + j]
            _, approach, _, sine, cosine = kept(p, c, s, race, j)
            side = -1.0 if race == 0 else 1.0
            at = Z.CONTACT + Z.CONTACT_SIZE * race
            z[at + Z.LOAD_MEAN] += carried / balls
            z[at + Z.LOAD_MAX] = max(z[at + Z.LOAD_MAX], carried)
            z[at + Z.ANGLE_MEAN] += math.atan2(side * sine, side * cosine) / balls
            pressure = p[numbers + P.RACE_PRESSURE] * math.sqrt(approach)
            z[at + Z.PRESSURE_MAX] = max(z[at + Z.PRESSURE_MAX], pressure)
            rolling = om if race == 1 else s[S.SPEED] - om
            speed = abs(rolling) * (pitch + ball * cosine)
            film = p[numbers + P.RACE_FILM] * math.exp(
                0.68 * math.log(c[C.VISCOSITY] * speed + 1e-12) - 0.073 * math.log(carried + 1e-3)
            )
            thinnest = min(thinnest, film)
        kxx, _, krr = series_stiffness(kept(p, c, s, 0, j), kept(p, c, s, 1, j))
        z[Z.AXIAL_STIFFNESS] += kxx
        z[Z.RADIAL_STIFFNESS] += 0.5 * krr
    z[Z.LAMBDA] = thinnest / p[P.ROUGHNESS]
    for race in range(2):
        numbers = P.RACES + race * P.RACE_SIZE
        at = Z.CONTACT + Z.CONTACT_SIZE * race
        approach = approach_under(p[numbers + P.RACE_STIFFNESS], z[at + Z.LOAD_MAX])
        half = p[numbers + P.RACE_HALF_LENGTH] * math.sqrt(approach)
        reach = math.asin(min(1.0, half / p[numbers + P.RACE_PROFILE_RADIUS]))
        z[Z.SHOULDER + race] = p[numbers + P.RACE_SHOULDER] - z[at + Z.ANGLE_MEAN] - reach
        if carries_both_ways(p):
            z[Z.SHOULDER + race] = nearest_shoulder(p, s, race)
