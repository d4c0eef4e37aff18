"""Driven rows of the bearings' rings: places, rates and accelerations. Arguments: see `members`."""

from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import SP, F, P, Q, S, W, Y
from fmu_bearing.engine.spindle import members
from fmu_bearing.engine.spindle.port import add_bearing_force, clear, has_port, prescribed_acceleration
from fmu_bearing.engine.spindle.shaft import shaft_forces, weighs


@kernel
def copy_rows(p, s, w):
    """Put all driven rows to the places and rates that shaft and housing have in the state."""
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    lanes = members.padded_size(p)
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        r = members.row(p, b)
        at = members.scratch(p, b)
        bearing_at = members.per_bearing(p, b)
        members.place_rows(p, b, own, own, SP.S_HEAD, ws, at)
        members.driven_motion(p, b, own, SP.S_HEAD + lanes, ws, at + SP.LANES)
        for i in range(int(p[r + SP.ROW_DRIVEN])):
            axial = 1.0 if i == Q.X else 0.0
            sb[S.Y + Y.Q0 + i] = ws[at + i]
            sb[S.Y + Y.V0 + i] = ws[at + SP.LANES + i] + axial * own[bearing_at + SP.OFFSET_RATE]


@kernel
def free_forces(p, b, pb, f, ws, at):
    """Put to ``ws[at:]`` the forces on driven rows: inertia times acceleration when free, from ``f``."""
    r = members.row(p, b)
    for i in range(SP.LANES):
        ws[at + i] = 0.0
    for i in range(int(p[r + SP.ROW_DRIVEN])):
        ws[at + i] = p[r + SP.ROW_MASS + i] * f[F.BODY + i]


@kernel
def drive(p, b, f, ws, at):
    """Put the accelerations ``ws[at:]`` of the driven rows into ``f``."""
    r = members.row(p, b)
    for i in range(int(p[r + SP.ROW_DRIVEN])):
        f[F.BODY + i] = ws[at + i]


@kernel
def growth_power(p, b, own, free, actual):
    """Power (W) of a growing offset: its rate times the force that drives the inner ring along x.

    ``free``: acceleration that balls and springs give the ring, ``actual``: its true one (m/s2).
    """
    rate = own[members.per_bearing(p, b) + SP.OFFSET_RATE]
    return rate * p[members.row(p, b) + SP.ROW_MASS] * (actual - free)


@kernel
def keep_load(p, b, pb, own, ws, at):
    """Store the load of the inner ring of bearing ``b`` on its balls, from `free_forces` at ``ws[at:]``.

    The moment contains the gyroscopic one of the turning ring's tilt, too (some 1e-4 N m).
    """
    bearing_at = members.per_bearing(p, b)
    for i in range(SP.PLANE):
        own[bearing_at + SP.LOAD + i] = -ws[at + i]
    if weighs(p):
        own[bearing_at + SP.LOAD + Q.Z] -= GRAVITY * pb[P.INNER_MASS]


@kernel
def accelerate(p, s, w, stage, t, angle, speed, rate):
    """Find the accelerations of shaft and housing and put the driven rows' into all right-hand sides.

    The right-hand sides were evaluated as if all rings were free: at the state (``stage`` False: ``S.F``), or
    at the stage ``t`` (s) into the step (``W.F``). The set's accelerations go to the state, or to
    ``SP.ACCELERATION`` of its work space; the force on the rotor at a port to the state, or to ``SP.FORCE``.
    Returns power in and the heats of shaft and pedestal (W); with the power of growing offsets and of a rotor
    at the port.
    """
    own = members.set_state(p, s)
    ws = members.set_work(p, w)
    lanes = members.padded_size(p)
    force = members.vector(p, SP.FORCE)
    if stage:
        x = ws
        q = members.vector(p, SP.PLACE)
        v = members.vector(p, SP.RATE)
    else:
        x = own
        q = SP.S_HEAD
        v = SP.S_HEAD + lanes
    work, bent, shaken = shaft_forces(p, own, x, q, v, angle, speed, rate, ws, force)
    for b in range(members.bearing_count(p)):
        pb = members.parameters(p, b)
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        f = wb[W.F : W.F + F.SIZE] if stage else sb[S.F : S.F + F.SIZE]
        free_forces(p, b, pb, f, ws, members.scratch(p, b))
        if not stage:
            keep_load(p, b, pb, own, ws, members.scratch(p, b))
        members.project_forces(p, b, ws, members.scratch(p, b), ws, force)
    acceleration = members.vector(p, SP.ACCELERATION)
    for i in range(lanes):
        ws[acceleration + i] = 0.0
    members.add_product(p, members.table(p, SP.AT_INVERSE), 1.0, ws, force, ws, acceleration)
    led = has_port(p)
    if led:
        prescribed_acceleration(own, s, t, ws, acceleration)
        clear(ws, force, lanes)
    for b in range(members.bearing_count(p)):
        sb = members.state(p, s, b)
        wb = members.work(p, w, b)
        f = wb[W.F : W.F + F.SIZE] if stage else sb[S.F : S.F + F.SIZE]
        free = f[F.BODY]
        at = members.scratch(p, b)
        members.driven_motion(p, b, ws, acceleration, ws, at + SP.LANES)
        drive(p, b, f, ws, at + SP.LANES)
        if led:
            y = wb[W.STAGE : W.STAGE + Y.SIZE] if stage else sb[S.Y : S.Y + Y.SIZE]
            work += add_bearing_force(p, b, members.parameters(p, b), y, f, ws, at, force)
        else:
            work += growth_power(p, b, own, free, f[F.BODY])
    if not stage:
        for i in range(SP.PLANE):
            own[SP.PORT_FORCE + i] = ws[force + i] if led else 0.0
        for i in range(lanes):
            own[SP.S_HEAD + 2 * lanes + i] = ws[acceleration + i]
    return work, bent, shaken
