"""One ball between two displaced rings: contacts, rolling, gyroscopic friction, and its place.

The ball may move along x and radially; its angle round the bearing is held. Vectors stand in the ball's
axes (x, r, theta). ``pose`` holds eleven numbers: the inner ring's centre, its axis and the outer ring's
axis, all in the ball's axes, the outer ring's centre at the origin; then by how much (m) the ball's
oversize and the race's waviness deepen the approach, inside and outside.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import C, P
from fmu_bearing.engine.mechanics.pose import axis_cosine

_ITERATIONS = 60
_BACKTRACKS = 8
# A ball's step is held below this (m), some tenths of the distance to a groove centre.
_LONGEST = 8e-6
# Smallest cosine between a contact's normal and the plane of rolling: a lifted ball may see a race sidewise.
_LEAST_ARM = 0.05


@kernel
def poses(c, s, ring, offset, deeper_i, deeper_o):
    """Eleven numbers ``pose`` of a ball at the angle of (cos, sin) = (c, s).

    ``ring``: x y z by bz of the inner ring against the outer (m, rad); ``offset``: outer ring's tilts (rad).
    """
    by = ring[3] + offset[0]
    bz = ring[4] + offset[1]
    oy = offset[0]
    oz = offset[1]
    return (
        ring[0], c * ring[2] - s * ring[1], -c * ring[1] - s * ring[2],
        axis_cosine(by, bz), -s * bz - c * by, -c * bz + s * by,
        axis_cosine(oy, oz), -s * oz - c * oy, -c * oz + s * oy,
        deeper_i, deeper_o,
    )  # fmt: skip


@kernel
def seat(p, c, race, extra, qx, qr, qt, nx, nr, nt):
    """Load and geometry of the contact with one race, exact for a torus and a sphere.

    ``q``: ball's centre from the ring's (m), ``n``: ring's axis, ``extra``: see above
    (m). Returns load (N), normal stiffness (N/m), distances from groove centre and axis (m), the unit
    vectors e (from the ball into the race) and m (along the major axis), and the cosine towards the axis.
    """
    held = C.RACES + race * C.RACE_SIZE
    hertz = p[P.RACES + race * P.RACE_SIZE + P.RACE_STIFFNESS]
    axial = qx * nx + qr * nr + qt * nt
    hx = qx - axial * nx
    hr = qr - axial * nr
    ht = qt - axial * nt
    rho = math.sqrt(hx * hx + hr * hr + ht * ht)
    hx /= rho
    hr /= rho
    ht /= rho
    sx = axial - c[held]
    sr = rho - c[held + 1]
    distance = math.sqrt(sx * sx + sr * sr)
    sine = sx / distance
    cosine = sr / distance
    approach = max(distance - c[held + 2] + extra, 0.0)
    root = math.sqrt(approach)
    return (
        hertz * approach * root, 1.5 * hertz * root, distance, rho,
        sine * nx + cosine * hx, sine * nr + cosine * hr, sine * nt + cosine * ht,
        cosine * nx - sine * hx, cosine * nr - sine * hr, cosine * nt - sine * ht,
        cosine,
    )  # fmt: skip


@kernel
def rolling_kinematics(ball, control, speed, sin_i, cos_i, sin_o, cos_o, radius):
    """Orbit and spin (rad/s) of a ball that rolls without slip at the middle of both contacts.

    ``control``: 0 spin axis halfway between the contact angles; 1 no spinning on the outer race, 2 none on
    the inner one (Harris 2006, ch. 5: tan b = sin a / (cos a +- D / (2 r))). Returns orbit speed, absolute
    spin about x and r, and what the gyroscopic moment needs: orbit speed times spin about r.
    """
    if control == 1.0:
        sb = sin_o
        cb = cos_o + ball / radius
    elif control == 2.0:
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
def friction(p, c, orbit, spin, load_i, load_o):
    """Friction (N) at inner and outer contact that carries the gyroscopic moment, bounded by traction.

    Shared equally, or all at the race in control. ``spin``: about r (rad/s).
    """
    if p[P.GYROSCOPIC] == 0.0:
        return 0.0, 0.0
    control = p[P.RACE_CONTROL]
    force = p[P.BALL_INERTIA] * orbit * spin / c[C.BALL_RADIUS]
    bound = load_o if control == 1.0 else load_i
    if control == 0.0:
        force *= 0.5
        bound = min(load_i, load_o)
    bound *= p[P.MU]
    force = min(max(force, -bound), bound)
    return (0.0 if control == 1.0 else force), (0.0 if control == 2.0 else force)


@kernel
def ball_state(p, c, speed, pose, x, r):
    """Return the forces on a ball at (x, r) and all that follows from its place.

    Net force (x, r), its in-plane stiffness xx, xr, rr, inner load and direction e (3), outer load, sines
    and cosines of inner and outer contact angle, orbit, spin x and r, inner friction, outer e (3).
    """
    radius = p[P.PITCH_RADIUS] + r
    qi, ki, di, _, ex, er, et, _, _, _, _ = seat(
        p, c, 0, pose[9], x - pose[0], radius - pose[1], -pose[2], pose[3], pose[4], pose[5]
    )
    qo, ko, do, _, ox, o_r, o_t, _, _, _, _ = seat(
        p, c, 1, pose[10], x, radius, 0.0, pose[6], pose[7], pose[8]
    )
    plane_i = -1.0 / math.sqrt(ex * ex + er * er)
    plane_o = 1.0 / math.sqrt(ox * ox + o_r * o_r)
    si = ex * plane_i
    ci = er * plane_i
    so = ox * plane_o
    co = o_r * plane_o
    orbit, wx, wr = rolling_kinematics(c[C.BALL_RADIUS], p[P.RACE_CONTROL], speed, si, ci, so, co, radius)
    pi, po = friction(p, c, orbit, wr, qi, qo)
    fx = -qi * ex - qo * ox + pi * ci - po * co
    fr = -qi * er - qo * o_r - pi * si + po * so + p[P.BALL_MASS] * radius * orbit * orbit
    ti = qi / di
    to = qo / do
    kxx = ki * si * si + ti * ci * ci + ko * so * so + to * co * co
    kxr = (ki - ti) * si * ci + (ko - to) * so * co
    krr = ki * ci * ci + ti * si * si + ko * co * co + to * so * so
    return fx, fr, kxx, kxr, krr, qi, ex, er, et, qo, si, ci, so, co, orbit, wx, wr, pi, ox, o_r, o_t


@kernel
def thrown_out(p, c, pose, orbit):
    """Place (x, r) where a ball that only the outer race holds is balanced by the centrifugal force."""
    held = C.RACES + C.RACE_SIZE
    pitch = p[P.PITCH_RADIUS]
    force = p[P.BALL_MASS] * pitch * orbit * orbit
    press = force / p[P.RACES + P.RACE_SIZE + P.RACE_STIFFNESS]
    radius = c[held + 1] + c[held + 2] - pose[10] + math.exp(2.0 / 3.0 * math.log(press + 1e-30))
    # a tilted ring's groove circle stands beside that of the upright one
    return c[held] - c[held + 1] * pose[7], radius - pitch + c[held] * pose[7]


@kernel
def ball_equilibrium(p, c, speed, pose, x, r):
    """Newton's method for the ball's place from (x, r); returns ``(x, r, residual N)``.

    Forces of orbit and spin are held in the derivative. Contacts are springs, so a step is judged by the
    force along it, which must not turn round: that holds through free play too, where a norm says nothing.
    """
    thrown = False
    size = 0.0
    fx, fr, kxx, kxr, krr, qi, _, _, _, qo, _, _, _, _, orbit, _, _, _, _, _, _ = ball_state(
        p, c, speed, pose, x, r
    )
    for _ in range(_ITERATIONS):
        size = math.sqrt(fx * fx + fr * fr)
        if size <= 1e-11 + 2e-12 * (qi + qo):
            break
        if qi == 0.0 and not thrown:
            thrown = True
            tx, tr = thrown_out(p, c, pose, orbit)
            gx, gr, gxx, gxr, grr, gi, _, _, _, go, _, _, _, _, orbit, _, _, _, _, _, _ = ball_state(
                p, c, speed, pose, tx, tr
            )
            if gi == 0.0:
                x, r, fx, fr, kxx, kxr, krr, qo = tx, tr, gx, gr, gxx, gxr, grr, go
                continue
        # a floor far below any contact's stiffness for a ball that nothing holds
        kxx += 1e-3
        krr += 1e-3
        det = kxx * krr - kxr * kxr
        dx = (fx * krr - fr * kxr) / det
        dr = (fr * kxx - fx * kxr) / det
        length = math.sqrt(dx * dx + dr * dr)
        share = min(1.0, _LONGEST / (length + 1e-300))
        ahead = fx * dx + fr * dr
        for n in range(_BACKTRACKS):
            gx, gr, kxx, kxr, krr, qi, _, _, _, qo, _, _, _, _, orbit, _, _, _, _, _, _ = ball_state(
                p, c, speed, pose, x + share * dx, r + share * dr
            )
            after = gx * dx + gr * dr
            if after >= -0.9 * ahead or gx * gx + gr * gr < 0.25 * size * size or n == _BACKTRACKS - 1:
                break
            share *= min(max(ahead / (ahead - after), 0.1), 0.7)
        x += share * dx
        r += share * dr
        fx = gx
        fr = gr
        if share * length < 1e-17:
            break
    return x, r, math.sqrt(fx * fx + fr * fr)
