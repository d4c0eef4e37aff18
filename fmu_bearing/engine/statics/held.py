"""A perfect bearing whose rings are held where they are: forces, stiffness, balls.

Bearings of a set on one shaft go where the shaft puts them, so a set is solved in displacements.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import EQ, ST, P, Q, W
from fmu_bearing.engine.statics.quasistatic import place_first, report, ring_forces, tangent
from fmu_bearing.engine.status import NO_START, OK


@kernel
def held(p, c, speed, ring, force, out, w):
    """Settle all balls with the inner ring held at ``ring`` against an upright outer one; status code.

    ``ring``: x y z by bz (m, rad); ``force``: of the balls on the inner ring, x y z (N) and moments y z about
    its centre (N m); ``out``: ``EQ.SIZE`` numbers as of ``quasistatic.equilibrium``, with the residual of the
    worst ball (N).
    """
    tilt = w[W.TILT : W.TILT + 2]
    tilt[0] = 0.0
    tilt[1] = 0.0
    return held_tilted(p, c, speed, ring, tilt, 0.0, force, out, w)


@kernel
def held_tilted(p, c, speed, ring, tilt, share, force, out, w):
    """As `held`, against an outer ring whose tilts y z are ``tilt`` (rad), with a ``share`` of imperfections.

    Nothing is kept from call to call: every ball starts on the line of the groove centres.
    """
    v = w[W.STATICS : W.STATICS + ST.SIZE]
    for i in range(EQ.SIZE):
        out[i] = 0.0
    for i in range(ST.SIZE):
        v[i] = 0.0
    none = v[ST.SYSTEM : ST.SYSTEM + EQ.FREEDOMS]  # no load
    place_first(p, c, ring[Q.X], tilt, share, v)
    worst = ring_forces(p, c, speed, none, tilt, ring, v, 0.0, force)
    for j in range(int(p[P.BALLS])):
        v[ST.X + j] = v[ST.TRIAL_X + j]
        v[ST.R + j] = v[ST.TRIAL_R + j]
    tangent(p, c, tilt, ring, v, out)
    total = 0.0
    for i in range(EQ.FREEDOMS):
        out[EQ.SHIFT + i] = ring[i]
        total += abs(force[i])
    force[Q.INNER_BY] *= p[P.PITCH_RADIUS]
    force[Q.INNER_BZ] *= p[P.PITCH_RADIUS]
    out[EQ.RESIDUAL] = worst
    report(p, c, speed, tilt, v, out)
    return OK if worst <= 1e-6 * (1.0 + total) else NO_START
