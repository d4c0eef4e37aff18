"""One ball between two displaced rings: contacts, rolling, gyroscopic friction, and its place.

The ball may move along x and radially; its angle round the bearing is fixed. Vectors are given in the ball's
axes (x, r, theta), the outer ring's centre at the origin.
"""

import math
from typing import NamedTuple

from fmu_bearing.engine.choices import INNER_CONTROL, OUTER_CONTROL, SHARED_CONTROL
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, P, Q
from fmu_bearing.engine.mechanics.contact import approach_under, contact_axes, hertz, in_plane
from fmu_bearing.engine.mechanics.pose import axis_cosine, axis_distance

_ITERATIONS = 60
_BACKTRACKS = 8
# A ball's step is held below this (m), some tenths of the distance to a groove centre.
_LONGEST = 8e-6
# Smallest cosine between a contact's normal and the plane of rolling: a lifted ball may see a race sidewise.
_LEAST_ARM = 0.05


class Pose(NamedTuple):
    """Both rings as a ball sees them: inner ring's centre (m), both axes.

    ``deeper``: by how much (m) the ball's oversize and the race's waviness deepen the approach.
    """

    x: float
    r: float
    t: float
    inner_nx: float
    inner_nr: float
    inner_nt: float
    outer_nx: float
    outer_nr: float
    outer_nt: float
    deeper_inner: float
    deeper_outer: float


class RaceContact(NamedTuple):
    """Load (N) and geometry of the contact with one race.

    ``stiffness``: normal (N/m); ``across``: that of the load's turning, across the track (N/m); ``rho``: of
    the ball from the axis (m); ``e``: unit vector from the ball into the race; ``m``: along the major axis;
    ``cosine``: of the angle between ``e`` and the direction away from the ring's axis.
    """

    load: float
    stiffness: float
    across: float
    rho: float
    ex: float
    er: float
    et: float
    mx: float
    mr: float
    mt: float
    cosine: float


class Ball(NamedTuple):
    """Forces on a ball at one place and all that follows from the place.

    Net force (N) and its in-plane stiffness (N/m); loads (N) and the unit vectors ``e`` of `RaceContact`;
    sines and cosines of the contact angles; orbit speed and spin (rad/s); friction (N) that carries the
    gyroscopic moment.
    """

    fx: float
    fr: float
    kxx: float
    kxr: float
    krr: float
    load_inner: float
    inner_ex: float
    inner_er: float
    inner_et: float
    load_outer: float
    outer_ex: float
    outer_er: float
    outer_et: float
    sine_inner: float
    cosine_inner: float
    sine_outer: float
    cosine_outer: float
    orbit: float
    wx: float
    wr: float
    friction_inner: float
    friction_outer: float


@kernel
def pose_at(c, s, ring, offset, deeper_inner, deeper_outer):
    """`Pose` of a ball at the angle of (cos, sin) = (c, s).

    ``ring``: x y z by bz of the inner ring against the outer (m, rad); ``offset``: outer ring's tilts (rad).
    """
    by = ring[Q.INNER_BY] + offset[0]
    bz = ring[Q.INNER_BZ] + offset[1]
    oy = offset[0]
    oz = offset[1]
    return Pose(
        ring[Q.X], c * ring[Q.Z] - s * ring[Q.Y], -c * ring[Q.Y] - s * ring[Q.Z],
        axis_cosine(by, bz), -s * bz - c * by, -c * bz + s * by,
        axis_cosine(oy, oz), -s * oz - c * oy, -c * oz + s * oy,
        deeper_inner, deeper_outer,
    )  # fmt: skip


@kernel
def race_contact(p, c, race, deeper, qx, qr, qt, nx, nr, nt):
    """`RaceContact` of a ball in one race, exact for a torus and a sphere.

    ``q``: ball's centre from the ring's (m), ``n``: ring's axis, ``deeper``: see `Pose` (m).
    """
    raceway = C.RACES + race * C.RACE_SIZE
    axial = qx * nx + qr * nr + qt * nt
    rho, hx, hr, ht = axis_distance(axial, qx, qr, qt, nx, nr, nt)
    sx, sr = axial - c[raceway + C.GROOVE_X], rho - c[raceway + C.GROOVE_RADIUS]
    distance, per, _, cosine, e, m = contact_axes(sx, sr, (nx, nr, nt), (hx, hr, ht))
    stiffness = p[P.RACES + race * P.RACE_SIZE + P.RACE_STIFFNESS]
    load, slope, _ = hertz(stiffness, distance - c[raceway + C.FREE] + deeper)
    return RaceContact(load, slope, load * per, rho, e[0], e[1], e[2], m[0], m[1], m[2], cosine)


@kernel
def inner_contact(p, c, pose, x, radius):
    """`RaceContact` in the inner race of a ball at ``x`` and ``radius`` from the outer ring's centre (m)."""
    return race_contact(
        p, c, 0, pose.deeper_inner, x - pose.x, radius - pose.r, -pose.t,
        pose.inner_nx, pose.inner_nr, pose.inner_nt,
    )  # fmt: skip


@kernel
def outer_contact(p, c, pose, x, radius):
    """`RaceContact` of the same ball in the outer race."""
    return race_contact(
        p, c, 1, pose.deeper_outer, x, radius, 0.0, pose.outer_nx, pose.outer_nr, pose.outer_nt
    )


@kernel
def rolling_kinematics(ball, control, speed, sin_i, cos_i, sin_o, cos_o, radius):
    """Orbit and spin (rad/s) of a ball that rolls without slip at the middle of both contacts.

    ``control`` (see ``choices.RACE_CONTROLS``): shared, the spin axis halfway between the contact angles; no
    spinning on the outer race; or none on the inner one (Harris 2006, ch. 5: tan b = sin a / (cos a +-
    D / (2 r))). Returns orbit speed, absolute spin about x and about r.
    """
    if control == OUTER_CONTROL:
        sb = sin_o
        cb = cos_o + ball / radius
    elif control == INNER_CONTROL:
        sb = sin_i
        cb = cos_i - ball / radius
    else:
        sb = sin_i + sin_o
        cb = cos_i + cos_o
    size = math.sqrt(sb * sb + cb * cb) + 1e-12
    sb /= size
    cb /= size
    arm_i = max(cos_i * cb + sin_i * sb, _LEAST_ARM)
    arm_o = max(cos_o * cb + sin_o * sb, _LEAST_ARM)
    # rolling: om (R + b cos a_o) = w b arm_o at the outer, (speed - om)(R - b cos a_i) = w b arm_i inside
    inner = (radius - ball * cos_i) * arm_o
    outer = (radius + ball * cos_o) * arm_i
    orbit = speed * inner / (inner + outer)
    spin = orbit * (radius + ball * cos_o) / (ball * arm_o)
    # the spin seen from the orbit runs against the orbit: this sign decides the gyroscopic moment's
    return orbit, orbit - spin * cb, spin * sb


@kernel
def friction(p, c, orbit, spin, load_inner, load_outer):
    """Friction (N) at inner and outer contact that carries the gyroscopic moment, bounded by traction.

    Shared equally, or all at the race in control. ``spin``: about r (rad/s).
    """
    if p[P.GYROSCOPIC] == 0.0:
        return 0.0, 0.0
    control = p[P.RACE_CONTROL]
    force = p[P.BALL_INERTIA] * orbit * spin / c[C.BALL_RADIUS]
    bound = load_outer if control == OUTER_CONTROL else load_inner
    if control == SHARED_CONTROL:
        force *= 0.5
        bound = min(load_inner, load_outer)
    bound *= p[P.MU]
    force = min(max(force, -bound), bound)
    return (0.0 if control == OUTER_CONTROL else force), (0.0 if control == INNER_CONTROL else force)


@kernel
def ball_state(p, c, speed, pose, x, r):
    """`Ball` at (x, r) (m) between the rings at ``pose``; ``speed`` of the inner one (rad/s)."""
    radius = p[P.PITCH_RADIUS] + r
    inner = inner_contact(p, c, pose, x, radius)
    outer = outer_contact(p, c, pose, x, radius)
    qi = inner.load
    qo = outer.load
    plane_i = -1.0 / math.sqrt(inner.ex * inner.ex + inner.er * inner.er)
    plane_o = 1.0 / math.sqrt(outer.ex * outer.ex + outer.er * outer.er)
    si = inner.ex * plane_i
    ci = inner.er * plane_i
    so = outer.ex * plane_o
    co = outer.er * plane_o
    orbit, wx, wr = rolling_kinematics(c[C.BALL_RADIUS], p[P.RACE_CONTROL], speed, si, ci, so, co, radius)
    pi, po = friction(p, c, orbit, wr, qi, qo)
    fx = -qi * inner.ex - qo * outer.ex + pi * ci - po * co
    fr = -qi * inner.er - qo * outer.er - pi * si + po * so + p[P.BALL_MASS] * radius * orbit * orbit
    kxx, kxr, krr = in_plane(0.0, 0.0, 0.0, inner.stiffness, inner.across, si, ci, ci, -si)
    kxx, kxr, krr = in_plane(kxx, kxr, krr, outer.stiffness, outer.across, so, co, co, -so)
    return Ball(
        fx, fr, kxx, kxr, krr,
        qi, inner.ex, inner.er, inner.et, qo, outer.ex, outer.er, outer.et,
        si, ci, so, co, orbit, wx, wr, pi, po,
    )  # fmt: skip


@kernel
def thrown_out(p, c, pose, orbit):
    """Place (x, r) where a ball that only the outer race holds is balanced by the centrifugal force."""
    raceway = C.RACES + C.RACE_SIZE
    groove_x = c[raceway + C.GROOVE_X]
    groove_radius = c[raceway + C.GROOVE_RADIUS]
    pitch = p[P.PITCH_RADIUS]
    force = p[P.BALL_MASS] * pitch * orbit * orbit
    approach = approach_under(p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS], force)
    radius = groove_radius + c[raceway + C.FREE] - pose.deeper_outer + approach
    # a tilted ring's groove circle lies beside the circle of the upright one
    return groove_x - groove_radius * pose.outer_nr, radius - pitch + groove_x * pose.outer_nr


@kernel
def ball_equilibrium(p, c, speed, pose, x, r):
    """Newton's method for the ball's place from (x, r); returns ``(x, r, residual N)``.

    Forces of orbit and spin are held in the derivative. Contacts are springs, so a step is judged by the
    force along it, which must not turn round: that holds through free play too, where a norm says nothing.
    """
    thrown = False
    size = 0.0
    here = ball_state(p, c, speed, pose, x, r)
    for _ in range(_ITERATIONS):
        fx = here.fx
        fr = here.fr
        size = math.sqrt(fx * fx + fr * fr)
        if size <= 1e-11 + 2e-12 * (here.load_inner + here.load_outer):
            break
        if here.load_inner == 0.0 and not thrown:
            thrown = True
            tx, tr = thrown_out(p, c, pose, here.orbit)
            there = ball_state(p, c, speed, pose, tx, tr)
            if there.load_inner == 0.0:
                x = tx
                r = tr
                here = there
                continue
        # a floor far below any contact's stiffness for a ball that nothing holds
        kxx = here.kxx + 1e-3
        kxr = here.kxr
        krr = here.krr + 1e-3
        det = kxx * krr - kxr * kxr
        dx = (fx * krr - fr * kxr) / det
        dr = (fr * kxx - fx * kxr) / det
        length = math.sqrt(dx * dx + dr * dr)
        share = min(1.0, _LONGEST / (length + 1e-300))
        ahead = fx * dx + fr * dr
        for n in range(_BACKTRACKS):
            here = ball_state(p, c, speed, pose, x + share * dx, r + share * dr)
            after = here.fx * dx + here.fr * dr
            if (
                after >= -0.9 * ahead
                or here.fx * here.fx + here.fr * here.fr < 0.25 * size * size
                or n == _BACKTRACKS - 1
            ):
                break
            share *= min(max(ahead / (ahead - after), 0.1), 0.7)
        x += share * dx
        r += share * dr
        if share * length < 1e-17:
            break
    return x, r, math.sqrt(here.fx * here.fx + here.fr * here.fr)
