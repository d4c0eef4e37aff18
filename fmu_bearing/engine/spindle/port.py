"""A shaft that another model owns: its motion comes in at the port, X = 0, and the bearings' force goes out.

The shaft's coordinates are then given, by a cubic (Hermite) polynomial over each communication step; housing
and sliding rings stay unknown. Mass and weight of the inner rings are the rotor's: its equations have them,
the force at the port has neither. Arguments: see `members`.
"""

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, F, P, Q, S, U, W, Y
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.shaft import weighs


@kernel
def has_port(p):
    """Whether another model moves the shaft."""
    return members.has_shaft(p) and p[int(p[P.SET]) + SP.PORT] != 0.0


@kernel
def take_motion(p, u, s, own, h):
    """Find the polynomial that takes the shaft to place and rate of ``u`` in ``h`` (s)."""
    lanes = members.padded_size(p)
    own[SP.PORT_BEGIN] = s[S.TIME]
    for i in range(SP.PLANE):
        place = own[SP.S_HEAD + i]
        rate = own[SP.S_HEAD + lanes + i]
        to_rate = u[U.PORT_RATE + i]
        mean = (u[U.PORT + i] - place) / h
        own[SP.PORT_PLACE + i] = place
        own[SP.PORT_RATE + i] = rate
        own[SP.PORT_ACCELERATION + i] = (6.0 * mean - 4.0 * rate - 2.0 * to_rate) / h
        own[SP.PORT_JERK + i] = 6.0 * (rate + to_rate - 2.0 * mean) / (h * h)


@kernel
def begin_motion(p, u, own, t):
    """Put the shaft to place and rate of ``u`` at time ``t`` (s), without acceleration."""
    lanes = members.padded_size(p)
    own[SP.PORT_BEGIN] = t
    for i in range(SP.PLANE):
        own[SP.S_HEAD + i] = u[U.PORT + i]
        own[SP.S_HEAD + lanes + i] = u[U.PORT_RATE + i]
        own[SP.PORT_PLACE + i] = u[U.PORT + i]
        own[SP.PORT_RATE + i] = u[U.PORT_RATE + i]
        own[SP.PORT_ACCELERATION + i] = 0.0
        own[SP.PORT_JERK + i] = 0.0


@kernel
def prescribed_acceleration(own, s, t, out, to):
    """Put the shaft's acceleration ``t`` (s) after the state to ``out[to:]``."""
    since = s[S.TIME] - own[SP.PORT_BEGIN] + t
    for i in range(SP.PLANE):
        out[to + i] = own[SP.PORT_ACCELERATION + i] + since * own[SP.PORT_JERK + i]


@kernel
def prescribe_stage(p, s, w, stage, t):
    """Put the shaft and the inner rings to the port's motion at a stage, ``t`` (s) into the step."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    since = s[S.TIME] - own[SP.PORT_BEGIN] + t
    here = members.vector(p, stage)
    place = members.vector(p, SP.PLACE)
    rate = members.vector(p, SP.RATE)
    prescribed_acceleration(own, s, t, ws, here)
    for i in range(SP.PLANE):
        start = own[SP.PORT_ACCELERATION + i]
        jerk = own[SP.PORT_JERK + i]
        begin = own[SP.PORT_RATE + i]
        ws[rate + i] = begin + since * (start + 0.5 * since * jerk)
        ws[place + i] = own[SP.PORT_PLACE + i] + since * (begin + since * (0.5 * start + since * jerk / 6.0))
    for b in range(members.bearing_count(p)):
        wb = members.work(p, w, b)
        at = members.scratch(p, b)
        bearing_at = members.per_bearing(p, b)
        acc = W.ACC + stage * F.SIZE + F.BODY
        members.driven_motion(p, b, ws, here, ws, at)
        for i in range(SP.PLANE):
            wb[acc + i] = ws[at + i]
        members.driven_motion(p, b, ws, rate, ws, at)
        for i in range(SP.PLANE):
            wb[W.STAGE + Y.V0 + i] = ws[at + i]
        members.driven_motion(p, b, ws, place, ws, at)
        for i in range(SP.PLANE):
            wb[W.STAGE + Y.Q0 + i] = ws[at + i]
        grown = own[bearing_at + SP.OFFSET_RATE]
        wb[W.STAGE + Y.V0 + Q.X] += grown
        wb[W.STAGE + Y.Q0 + Q.X] += own[bearing_at + SP.OFFSET] + t * grown


@kernel
def fix_rows(x, at, given, count, width):
    """Take the first ``given`` unknowns out of ``count`` equations at ``x[at:]``, rows of ``width``."""
    for i in range(given):
        for k in range(count):
            x[at + i * width + k] = 0.0
            x[at + k * width + i] = 0.0
        x[at + i * width + i] = 1.0


@kernel
def add_bearing_force(p, b, pb, y, acc, ws, at, to):
    """Add the force of bearing ``b`` on the rotor to ``ws[to:]``; returns the rotor's power (W).

    ``ws[at:]``: `free_forces` of its rings (N, N m), overwritten; ``y``, ``acc``: its state (`layout.y`) and
    accelerations (`layout.f`). The force is without inertia and weight of the inner ring, the power with
    both.
    """
    r = members.row(p, b)
    power = 0.0
    for i in range(SP.PLANE):
        power += y[Y.V0 + i] * (p[r + SP.ROW_MASS + i] * acc[F.BODY + i] - ws[at + i])
    for i in range(SP.PLANE, SP.LANES):
        ws[at + i] = 0.0
    if weighs(p):
        ws[at + Q.Z] += GRAVITY * pb[P.INNER_MASS]
    members.project_forces(p, b, ws, at, ws, to)
    return power


@kernel
def clear(x, at, count):
    """Put ``count`` numbers at ``x[at:]`` to zero."""
    for i in range(count):
        x[at + i] = 0.0


@kernel
def store_rotor_force(p, ws, stage):
    """Store the force on the rotor, at ``SP.FORCE``, as the stage's."""
    force = members.vector(p, SP.FORCE)
    for i in range(SP.PLANE):
        ws[SP.ROTOR_FORCE + stage * SP.PLANE + i] = ws[force + i]


@kernel
def observe_port(p, own, z, at):
    """Fill the port's outputs; ``at``: place of the set's own in ``z``."""
    if not has_port(p):
        return
    for i in range(SP.PLANE):
        z[at + SP.Z_PORT + i] = own[SP.PORT_FORCE + i]
        z[at + SP.Z_PORT_MEAN + i] = own[SP.PORT_MEAN + i]
