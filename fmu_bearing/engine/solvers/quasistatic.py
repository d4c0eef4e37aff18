"""Quasi-static equilibrium under axial load (Jones 1960; Harris 2006, ch. 3), all balls alike.

The ball rolls without slip at the middle of both contacts; its spin axis pitches by the mean of the two
contact angles; the gyroscopic moment is signed and shared equally by the races as a friction pair.
"""

import math

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import (
    C_BALL_RADIUS,
    C_PRELOAD,
    C_RACE_SIZE,
    C_RACES,
    NO_START,
    OK,
    P_BALL_INERTIA,
    P_BALL_MASS,
    P_BALLS,
    P_GYROSCOPIC,
    P_PITCH_RADIUS,
    P_RACES,
    RACE_SIZE,
    RACE_STIFFNESS,
)


@kernel
def contact(p, c, race, sx, sr):
    """Load (N), sine and cosine of the contact angle, approach (m) and distance for a ball in one race.

    ``sx``, ``sr``: the ball's centre from the race's groove centre, axial and radial (m).
    """
    distance = math.sqrt(sx * sx + sr * sr)
    approach = max(distance - c[C_RACES + race * C_RACE_SIZE + 2], 0.0)
    load = p[P_RACES + race * RACE_SIZE + RACE_STIFFNESS] * approach * math.sqrt(approach)
    return load, sx / distance, sr / distance, approach, distance


@kernel
def contact_stiffness(hertz, load, approach, distance, sine, cosine):
    """In-plane stiffness (N/m) of one contact: xx, xr, rr, with the turning of the load's direction."""
    kn = 1.5 * hertz * math.sqrt(approach)
    kt = load / distance
    return (
        kn * sine * sine + kt * cosine * cosine,
        (kn - kt) * sine * cosine,
        kn * cosine * cosine + kt * sine * sine,
    )


@kernel
def rolling_kinematics(p, c, speed, sin_i, cos_i, sin_o, cos_o, radius):
    """Orbit speed and spin (x, r) (rad/s) of a ball that rolls without slip at both contact centres."""
    ball = c[C_BALL_RADIUS]
    # the inner contact's normal points to (-sin, -cos): its sines arrive with that sign turned
    pitch = 0.5 * (math.atan2(sin_i, cos_i) + math.atan2(sin_o, cos_o))
    ci = math.cos(math.atan2(sin_i, cos_i) - pitch)
    co = math.cos(math.atan2(sin_o, cos_o) - pitch)
    # rolling: om (R + r cos a_o) = w r co at the outer, (speed - om)(R - r cos a_i) = w r ci at the inner
    outer = (radius + ball * cos_o) / co
    inner = (radius - ball * cos_i) / ci
    orbit = speed * inner / (inner + outer)
    spin = -orbit * outer / ball
    # absolute spin: rolling about the pitched axis on top of the orbit's own rotation about x
    return orbit, orbit + spin * math.cos(pitch), -spin * math.sin(pitch)


@kernel
def ball_residual(p, c, x, r, shift, speed):
    """Net force (x, r) on a ball at (x, r); ``shift`` is the inner ring's axial displacement (m)."""
    radius = p[P_PITCH_RADIUS] + r
    qi, si, ci, _, _ = contact(p, c, 0, x - shift - c[C_RACES], radius - c[C_RACES + 1])
    qo, so, co, _, _ = contact(p, c, 1, x - c[C_RACES + C_RACE_SIZE], radius - c[C_RACES + C_RACE_SIZE + 1])
    orbit, _, wr = rolling_kinematics(p, c, speed, -si, -ci, so, co, radius)
    fx = -qi * si - qo * so
    fr = -qi * ci - qo * co + p[P_BALL_MASS] * radius * orbit * orbit
    if p[P_GYROSCOPIC] != 0.0:
        # moment I om wr about the tangent, given by equal friction forces at both races
        pair = 0.5 * p[P_BALL_INERTIA] * orbit * wr / c[C_BALL_RADIUS]
        fx += pair * (-ci - co)
        fr += pair * (si + so)
    return fx, fr


@kernel
def ball_equilibrium(p, c, shift, speed, x, r):
    """Newton iteration for the ball's place in the axial plane; returns ``(x, r, residual N)``."""
    step = 1e-10
    size = 1e30
    for _ in range(80):
        fx, fr = ball_residual(p, c, x, r, shift, speed)
        size = math.sqrt(fx * fx + fr * fr)
        if size < 1e-9:
            break
        ax, ar = ball_residual(p, c, x + step, r, shift, speed)
        bx, br = ball_residual(p, c, x, r + step, shift, speed)
        # a floor on the stiffness keeps a ball without contact from being thrown far
        jxx = (ax - fx) / step - 1e3
        jrx = (ar - fr) / step
        jxr = (bx - fx) / step
        jrr = (br - fr) / step - 1e3
        det = jxx * jrr - jxr * jrx
        dx = -(fx * jrr - fr * jxr) / det
        dr = -(fr * jxx - fx * jrx) / det
        length = math.sqrt(dx * dx + dr * dr)
        if length > 4e-6:
            dx *= 4e-6 / length
            dr *= 4e-6 / length
        x += dx
        r += dr
        if length < 1e-17:
            break
    return x, r, size


@kernel
def inner_force(p, c, shift, speed, x, r):
    """Axial force (N) of all balls on the inner ring against +x, friction pair included."""
    radius = p[P_PITCH_RADIUS] + r
    qi, si, ci, _, _ = contact(p, c, 0, x - shift - c[C_RACES], radius - c[C_RACES + 1])
    _, so, co, _, _ = contact(p, c, 1, x - c[C_RACES + C_RACE_SIZE], radius - c[C_RACES + C_RACE_SIZE + 1])
    force = -qi * si
    if p[P_GYROSCOPIC] != 0.0:
        orbit, _, wr = rolling_kinematics(p, c, speed, -si, -ci, so, co, radius)
        force -= 0.5 * p[P_BALL_INERTIA] * orbit * wr / c[C_BALL_RADIUS] * ci
    return p[P_BALLS] * force


@kernel
def quasistatic(p, c, speed, out):
    """Equilibrium under the axial preload at ``speed`` (rad/s); status code.

    ``out``: inner ring's axial displacement against the outer (m), ball x and r (m), orbit speed, spin x and
    r (rad/s), residual of the axial balance (N). Bracketing and bisection-safe secant steps: bounded work.
    """
    target = c[C_PRELOAD]
    x = 0.0
    r = 0.0
    low = -2e-5
    high = 1e-5
    for _ in range(40):
        x, r, _ = ball_equilibrium(p, c, high, speed, 0.5 * high, r)
        f_high = inner_force(p, c, high, speed, x, r) - target
        if f_high >= 0.0:
            break
        low = high
        high += 2e-5
    x, r, _ = ball_equilibrium(p, c, low, speed, 0.5 * low, 0.0)
    f_low = inner_force(p, c, low, speed, x, r) - target
    shift = high
    size = 0.0
    if f_low < 0.0:
        f = f_high
        for _ in range(100):
            shift = low - f_low * (high - low) / (f_high - f_low)
            if shift <= low + 0.02 * (high - low) or shift >= high - 0.02 * (high - low):
                shift = 0.5 * (low + high)
            x, r, size = ball_equilibrium(p, c, shift, speed, x, r)
            f = inner_force(p, c, shift, speed, x, r) - target
            if f < 0.0:
                low = shift
                f_low = f
            else:
                high = shift
                f_high = f
            if abs(f) < 1e-9 * (1.0 + target) or high - low < 1e-18:
                break
        if abs(f) > 1e-4 * (1.0 + target):
            return NO_START
    else:
        # nothing pushes the rings together: the balls lie in the outer race alone
        shift = low
    if not (size < 1e-3):
        return NO_START
    radius = p[P_PITCH_RADIUS] + r
    _, si, ci, _, _ = contact(p, c, 0, x - shift - c[C_RACES], radius - c[C_RACES + 1])
    _, so, co, _, _ = contact(p, c, 1, x - c[C_RACES + C_RACE_SIZE], radius - c[C_RACES + C_RACE_SIZE + 1])
    orbit, wx, wr = rolling_kinematics(p, c, speed, -si, -ci, so, co, radius)
    out[0] = shift
    out[1] = x
    out[2] = r
    out[3] = orbit
    out[4] = wx
    out[5] = wr
    out[6] = size
    return OK


@kernel
def series_stiffness(p, c, x_i, r_i, x_o, r_o):
    """In-plane stiffness (xx, xr, rr in N/m) of inner and outer contact in series, ball massless.

    ``x``, ``r``: the ball's centre from each groove centre (m). Zero when a contact is open.
    """
    qi, si, ci, di, li = contact(p, c, 0, x_i, r_i)
    qo, so, co, do, lo = contact(p, c, 1, x_o, r_o)
    if qi <= 0.0 or qo <= 0.0:
        return 0.0, 0.0, 0.0
    ixx, ixr, irr = contact_stiffness(p[P_RACES + RACE_STIFFNESS], qi, di, li, si, ci)
    oxx, oxr, orr = contact_stiffness(p[P_RACES + RACE_SIZE + RACE_STIFFNESS], qo, do, lo, so, co)
    sxx = ixx + oxx
    sxr = ixr + oxr
    srr = irr + orr
    det = sxx * srr - sxr * sxr
    # K = K_i - K_i (K_i + K_o)^-1 K_i
    axx = (srr * ixx - sxr * ixr) / det
    axr = (srr * ixr - sxr * irr) / det
    arx = (-sxr * ixx + sxx * ixr) / det
    arr = (-sxr * ixr + sxx * irr) / det
    return (
        ixx - (ixx * axx + ixr * arx),
        ixr - (ixx * axr + ixr * arr),
        irr - (ixr * axr + irr * arr),
    )


@kernel
def stiffness_matrix(p, c, out):
    """Stiffness of the inner against the outer ring at the equilibrium ``out`` of :func:`quasistatic`.

    Returns axial, radial (N/m), tilt (N m/rad) and the radial-tilt coupling (N), each with the other
    motions held; all balls alike.
    """
    radius = p[P_PITCH_RADIUS] + out[2]
    xi = out[1] - out[0] - c[C_RACES]
    ri = radius - c[C_RACES + 1]
    xo = out[1] - c[C_RACES + C_RACE_SIZE]
    ro = radius - c[C_RACES + C_RACE_SIZE + 1]
    kxx, kxr, krr = series_stiffness(p, c, xi, ri, xo, ro)
    # a tilt b about the tangent moves the groove centre by (-b R_c, b x_c)
    gx = -c[C_RACES + 1]
    gr = c[C_RACES]
    half = 0.5 * p[P_BALLS]
    tilt = half * (kxx * gx * gx + 2.0 * kxr * gx * gr + krr * gr * gr)
    coupling = half * (kxr * gx + krr * gr)
    return p[P_BALLS] * kxx, half * krr, tilt, coupling
