"""Motion samples for the sound filters, at a fixed rate, interpolated within the internal step.

Velocities follow the cubic through velocities and accelerations at both ends of the step, accelerations its
derivative: both run on without a jump from step to step. All numbers of one instant share the cubic's
weights.
"""

from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FL, FOUR, MO, SD, STRIDE, F, P, Q, S, W, Y
from fmu_bearing.engine.mechanics.flexure import flexure_state
from fmu_bearing.engine.mechanics.trigonometry import cosine_and_sine


@kernel
def value_weights(h, t):
    """Weights of change, first and last rate for the cubic's value at the share ``t`` of the step ``h``."""
    u = 1.0 - t
    return t * t * (3.0 - 2.0 * t), h * t * u * u, -h * t * t * u


@kernel
def rate_weights(h, t):
    """Weights of change, first and last rate for the cubic's rate at the share ``t`` of the step ``h``."""
    u = 1.0 - t
    return 6.0 * t * u / h, u * (1.0 - 3.0 * t), t * (3.0 * t - 2.0)


@kernel
def blend(change, first, last, v0, a0, v1, a1):
    """Sum over change and rates of one number, from ``v0`` and ``a0`` to ``v1`` and ``a1``."""
    return change * (v1 - v0) + (first * a0 + last * a1)


@kernel
def body_motion(s, w, first, count, at, whole, h, t):
    """``count`` velocities (where the ``whole`` motion is wanted) and accelerations of one body.

    ``first``: its first coordinate; ``at``: place of the velocities in ``w``.
    """
    c, b, e = value_weights(h, t)
    dc, db, de = rate_weights(h, t)
    rates = at + MO.ACCELERATION - MO.VELOCITY  # the same distance for spins
    for i in range(count):
        v = Y.V0 + first + i
        f = F.BODY + first + i
        v0 = s[S.Y + v]
        v1 = w[W.STAGE + v]
        a0 = s[S.F + f]
        a1 = w[W.LAST + f]
        w[rates + i] = blend(dc, db, de, v0, a0, v1, a1)
        if whole:
            w[at + i] = v0 + blend(c, b, e, v0, a0, v1, a1)


@kernel
def bodies_motion(s, w, whole, h, t):
    """Motion of the rings and the cage. The inner ring's spin is taken about X: tilts are small."""
    inner = W.MOTION + MO.INNER
    body_motion(s, w, Q.INNER, 3, inner + MO.VELOCITY, whole, h, t)
    body_motion(s, w, Q.INNER + Q.INNER_BY, 2, inner + MO.SPIN + 1, whole, h, t)
    w[inner + MO.SPIN] = s[S.SPEED] + t * h * s[S.SPEED_RATE]
    w[inner + MO.SPIN_RATE] = s[S.SPEED_RATE]
    for body in range(2):
        first = Q.OUTER if body == 0 else Q.CAGE
        at = W.MOTION + (MO.OUTER if body == 0 else MO.CAGE)
        body_motion(s, w, first, 3, at + MO.VELOCITY, whole, h, t)
        body_motion(s, w, first + Q.TURN, 3, at + MO.SPIN, whole, h, t)


@kernel
def ball_accelerations(p, s, w, h, t):
    """Inertial accelerations of the balls, resolved in their orbiting axes; zeros in spare lanes."""
    c, b, e = value_weights(h, t)
    dc, db, de = rate_weights(h, t)
    pitch = p[P.PITCH_RADIUS]
    for j in range(int(p[P.LANES])):
        vr0 = s[S.Y + Y.VR + j]
        vr1 = w[W.STAGE + Y.VR + j]
        ar0 = s[S.F + F.R + j]
        ar1 = w[W.LAST + F.R + j]
        om0 = s[S.Y + Y.OM + j]
        om1 = w[W.STAGE + Y.OM + j]
        at0 = s[S.F + F.TH + j]
        at1 = w[W.LAST + F.TH + j]
        r0 = s[S.Y + Y.R + j]
        radius = pitch + (r0 + t * (w[W.STAGE + Y.R + j] - r0))
        vr = vr0 + blend(c, b, e, vr0, ar0, vr1, ar1)
        om = om0 + blend(c, b, e, om0, at0, om1, at1)
        w[W.MOTION + MO.BALL_ACCELERATION + j] = blend(
            dc, db, de, s[S.Y + Y.VX + j], s[S.F + F.X + j], w[W.STAGE + Y.VX + j], w[W.LAST + F.X + j]
        )
        w[W.MOTION + MO.BALL_ACCELERATION + STRIDE + j] = (
            blend(dc, db, de, vr0, ar0, vr1, ar1) - radius * om * om
        )
        w[W.MOTION + MO.BALL_ACCELERATION + 2 * STRIDE + j] = (
            radius * blend(dc, db, de, om0, at0, om1, at1) + 2.0 * vr * om
        )
    for j in range(int(p[P.BALLS]), int(p[P.LANES])):
        for k in range(3):
            w[W.MOTION + MO.BALL_ACCELERATION + STRIDE * k + j] = 0.0


@kernel
def ball_velocities(p, s, w, h, t):
    """Inertial velocities, spins and their rates of the balls, resolved in their orbiting axes."""
    c, b, e = value_weights(h, t)
    dc, db, de = rate_weights(h, t)
    pitch = p[P.PITCH_RADIUS]
    for j in range(int(p[P.BALLS])):
        om0 = s[S.Y + Y.OM + j]
        om = om0 + blend(c, b, e, om0, s[S.F + F.TH + j], w[W.STAGE + Y.OM + j], w[W.LAST + F.TH + j])
        r0 = s[S.Y + Y.R + j]
        radius = pitch + (r0 + t * (w[W.STAGE + Y.R + j] - r0))
        for k in range(2):
            row = STRIDE * k + j
            v0 = s[S.Y + Y.VX + row]
            w[W.MOTION + MO.BALL_VELOCITY + row] = v0 + blend(
                c, b, e, v0, s[S.F + F.X + row], w[W.STAGE + Y.VX + row], w[W.LAST + F.X + row]
            )
        w[W.MOTION + MO.BALL_VELOCITY + 2 * STRIDE + j] = radius * om
        for k in range(3):
            row = STRIDE * k + j
            v0 = s[S.Y + Y.WX + row]
            a0 = s[S.F + F.WX + row]
            v1 = w[W.STAGE + Y.WX + row]
            a1 = w[W.LAST + F.WX + row]
            w[W.MOTION + MO.BALL_SPIN + row] = v0 + blend(c, b, e, v0, a0, v1, a1)
            w[W.MOTION + MO.BALL_SPIN_RATE + row] = blend(dc, db, de, v0, a0, v1, a1)
        # the axes turn with the orbit
        r = STRIDE + j
        th = r + STRIDE
        w[W.MOTION + MO.BALL_SPIN_RATE + r] -= om * w[W.MOTION + MO.BALL_SPIN + th]
        w[W.MOTION + MO.BALL_SPIN_RATE + th] += om * w[W.MOTION + MO.BALL_SPIN + r]


@kernel
def ball_turns(p, s, w, h, t):
    """Cosine and sine of the balls' angles."""
    c, b, e = value_weights(h, t)
    for j in range(0, int(p[P.LANES]), FOUR):
        old = S.Y + j
        new = W.STAGE + j
        th0 = load(s, old + Y.TH)
        angle = th0 + blend(c, b, e, th0, load(s, old + Y.OM), load(w, new + Y.TH), load(w, new + Y.OM))
        cosine, sine = cosine_and_sine(angle)
        store(w, W.MOTION + MO.COS + j, cosine)
        store(w, W.MOTION + MO.SIN + j, sine)


@kernel
def flexure_motion(p, s, w, h, t):
    """Second time derivatives of the flexural coordinates."""
    count = 2 * int(p[P.MODES])
    dc, db, de = rate_weights(h, t)
    old = flexure_state(p)
    v = W.FLEX + FL.V
    a = W.FLEX + FL.A
    for i in range(count):
        w[W.MOTION + MO.FLEXURES + i] = blend(
            dc, db, de, s[old + count + i], s[old + 2 * count + i], w[v + i], w[a + i]
        )


@kernel
def sound_block(p):
    """Return the sound block of a bearing's parameters."""
    return p[int(p[P.AT_SOUND]) : int(p[P.AT_SOUND]) + int(p[P.SOUND_SIZE])]


@kernel
def sample_due(s, h):
    """Whether the next sample falls into the step of length ``h`` (s) from the state ``s`` on."""
    return s[S.SAMPLE] <= (s[S.TIME] - s[S.START] + h) * SD.RAW_RATE


@kernel
def share_of_step(s, h):
    """Share of the step ``h`` (s) at which the next sample is."""
    return min(max((s[S.SAMPLE] / SD.RAW_RATE - (s[S.TIME] - s[S.START])) / h, 0.0), 1.0)


@kernel
def sample_bodies(p, s, w, h):
    """As `sample_motion`, of the rings alone, which accelerometers read."""
    t = share_of_step(s, h)
    bodies_motion(s, w, False, h, t)
    flexure_motion(p, s, w, h, t)


@kernel
def sample_motion(p, s, w, whole, h):
    """Fill ``W.MOTION`` with the motion at the next sample: old state in ``s``, new one in ``w``.

    ``whole``: velocities and angles too, which form vectors does not ask for at every sample.
    """
    t = share_of_step(s, h)
    bodies_motion(s, w, whole, h, t)
    ball_accelerations(p, s, w, h, t)
    if whole:
        ball_velocities(p, s, w, h, t)
    sample = int(s[S.SAMPLE])
    if whole or sample == 0 or sample % SD.DECIMATION == SD.TURNING:
        ball_turns(p, s, w, h, t)
    flexure_motion(p, s, w, h, t)
