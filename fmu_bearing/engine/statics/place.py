"""From quasi-static balls to the state: where rings, balls and cage are, for all fidelities."""

import math

from fmu_bearing.engine.choices import BALL_GUIDED
from fmu_bearing.engine.constants import PI
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, PT, C, P, Q, W, Y
from fmu_bearing.engine.mechanics.bodies import guiding_ring
from fmu_bearing.engine.statics.quasistatic import forces_at_displacement
from fmu_bearing.engine.status import OK

_FAR = 0.3  # of the pitch radius: beyond it the angles of pockets and waves, series in it, lose a micrometre


@kernel
def pedestal_deflection(p, c, load_y, load_z):
    """Return where loads (N) push rings in line with each other, on pedestal and springs: y, z (m)."""
    along_y = c[C.PEDESTAL_Y] + p[P.SUPPORT_STIFFNESS + Q.Y]
    along_z = c[C.PEDESTAL_Z] + p[P.SUPPORT_STIFFNESS + Q.Z]
    share = c[C.PEDESTAL_YZ] / along_z
    aside = (load_y - share * load_z) / (along_y - share * c[C.PEDESTAL_YZ])
    return aside, (load_z - c[C.PEDESTAL_YZ] * aside) / along_z


@kernel
def too_far(p, y, z):
    """Whether an outer ring at ``y``, ``z`` (m) is farther than pockets and waves have equations for."""
    return abs(y) + abs(z) > _FAR * p[P.PITCH_RADIUS]


@kernel
def slope_round_bearing(p, eq, row, j):
    """Change of a ball quantity with the angle round the bearing (1/rad) between the neighbours of ``j``."""
    balls = int(p[P.BALLS])
    ahead = eq[row + (j + 1) % balls]
    behind = eq[row + (j + balls - 1) % balls]
    ahead2 = eq[row + (j + 2) % balls]
    behind2 = eq[row + (j + balls - 2) % balls]
    # fourth order: the first harmonic, that of a radial load or tilt, comes out within 0.3 % for 12 balls
    return (8.0 * (ahead - behind) - (ahead2 - behind2)) * balls / (24.0 * PI)


@kernel
def shift_balls(p, y, along_y, along_z):
    """Shift the balls of the state ``y`` by two lengths (m): the same places and velocities from farther on.

    Orbit angle and radius count from the inertial axis, so radial and tangential axes turn with a shift.
    """
    pitch = p[P.PITCH_RADIUS]
    for j in range(int(p[P.LANES])):
        angle = y[Y.TH + j]
        radius = pitch + y[Y.R + j]
        orbit = y[Y.OM + j]
        outwards = y[Y.VR + j]
        across = y[Y.WR + j]
        ahead = y[Y.WT + j]
        yb = along_y - radius * math.sin(angle)
        zb = along_z + radius * math.cos(angle)
        apart = math.sqrt(yb * yb + zb * zb)
        c = (zb * math.cos(angle) - yb * math.sin(angle)) / apart
        s = (-yb * math.cos(angle) - zb * math.sin(angle)) / apart
        y[Y.TH + j] = angle + math.atan2(s, c)
        y[Y.R + j] = apart - pitch
        y[Y.VR + j] = outwards * c + radius * orbit * s
        y[Y.OM + j] = (radius * orbit * c - outwards * s) / apart
        y[Y.WR + j] = across * c + ahead * s
        y[Y.WT + j] = ahead * c - across * s


@kernel
def shift_bearing(p, y, along_y, along_z):
    """Shift rings, cage and balls of the state ``y`` together, by two lengths (m)."""
    shift_balls(p, y, along_y, along_z)
    for body in (Q.INNER, Q.OUTER, Q.CAGE):
        y[Y.Q0 + body + Q.Y] += along_y
        y[Y.Q0 + body + Q.Z] += along_z


@kernel
def place_balls(p, y, eq):
    """Balls about the displaced outer ring, each in its own equilibrium; spare lanes copy the first.

    The first ball is at 12 o'clock. Under radial load or tilt a ball moves along and outwards as it orbits.
    """
    balls = p[P.BALLS]
    for j in range(int(p[P.LANES])):
        place = j if j < balls else 0
        orbit = eq[EQ.OM + place]
        y[Y.X + j] = eq[EQ.X + place] + y[Y.Q0 + Q.OUTER]
        y[Y.R + j] = eq[EQ.R + place]
        y[Y.TH + j] = 2.0 * PI * place / balls
        y[Y.VX + j] = orbit * slope_round_bearing(p, eq, EQ.X, place)
        y[Y.VR + j] = orbit * slope_round_bearing(p, eq, EQ.R, place)
        y[Y.OM + j] = orbit
        y[Y.WX + j] = eq[EQ.WX + place]
        y[Y.WR + j] = eq[EQ.WR + place]
        y[Y.WT + j] = 0.0
    shift_balls(p, y, y[Y.Q0 + Q.OUTER + Q.Y], y[Y.Q0 + Q.OUTER + Q.Z])


@kernel
def place_cage(p, y, eq):
    """Cage about the ring that guides it, in the plane of the balls and with their mean orbit speed.

    One that the balls guide begins half-way between both rings, as the balls are.
    """
    balls = p[P.BALLS]
    k = Y.Q0 + Q.CAGE
    ring, _ = guiding_ring(p)
    y[k] = y[Y.Q0 + Q.OUTER]
    for i in (Q.Y, Q.Z):
        y[k + i] = y[Y.Q0 + ring + i]
        if p[P.GUIDANCE] == BALL_GUIDED:
            y[k + i] = 0.5 * (y[Y.Q0 + i] + y[Y.Q0 + Q.OUTER + i])
    for j in range(int(balls)):
        angle = 2.0 * PI * j / balls
        x = eq[EQ.X + j] / balls
        y[k] += x
        y[k + Q.BY] += 2.0 * x * math.cos(angle) / p[P.PITCH_RADIUS]
        y[k + Q.BZ] += 2.0 * x * math.sin(angle) / p[P.PITCH_RADIUS]
        y[Y.V0 + Q.CAGE + Q.TURN] += eq[EQ.OM + j] / balls


@kernel
def upright_point(p, c, speed, shift, outer, y, w):
    """Quasi-static state ``y`` of the perfect bearing between upright rings in line; status code.

    ``shift``: of the inner ring against the outer one, which is at ``outer``, along the axis (m). Forces on
    the inner ring are left in ``W.LOAD``. Where balls find no place ``y`` stays.
    """
    ring = w[W.PATTERN + PT.STEP : W.PATTERN + PT.STEP + EQ.FREEDOMS]
    tilt = w[W.TILT : W.TILT + 2]
    for i in range(EQ.FREEDOMS):
        ring[i] = shift if i == Q.X else 0.0
    for i in range(2):
        tilt[i] = 0.0
    eq = w[W.EQUILIBRIUM : W.EQUILIBRIUM + EQ.SIZE]
    status = forces_at_displacement(p, c, speed, ring, tilt, 0.0, w[W.LOAD : W.LOAD + EQ.FREEDOMS], eq, w)
    if status != OK:
        return status
    for i in range(Y.SIZE):
        y[i] = 0.0
    y[Y.Q0 + Q.OUTER] = outer
    y[Y.Q0] = outer + shift
    place_balls(p, y, eq)
    if p[P.CAGE] != 0.0:
        place_cage(p, y, eq)
    return OK
