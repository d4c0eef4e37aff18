"""What holds a ball across its track and drags it along, for its own motion there (``ball_motion``).

Held between the races, a ball swings across its track at sqrt((Q_i / l_i + Q_o / l_o) / m), l from the
grooves' centres: 21.9 kHz (7003C), 4.6 kHz (7009C). Traction drags it along with the mean of both races, in
the 7003C so strongly that nothing swings. With S a ball's place there, S_0 where it would rest (the condensed
balls) and U v what the rings' velocities v would make it do by rolling,

    S'' = w^2 (S_0 - S) + c (U v - S').

The equation is linear: over a step it is solved exactly for a drive w^2 S_0 + c U v that is a polynomial
through its last values, stable however stiff. What the rings feel of all balls is in ``patterns``.
"""

import math

from fmu_bearing.engine.complex_numbers import over
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, C, F, J, L, P, Q, T, Y
from fmu_bearing.engine.mechanics.contact import in_plane

_LOADED = 1.0  # N at both races: with less a ball follows statically
# Radians per step of the balls between fixed races: below them polynomials through three and five drives are
# rounding, and one and three serve.
_FINE = 1e-2
_SMOOTH = 5e-2
# Friction times step: with more the balls follow the drive, and five drives would amplify what is fast.
_STIFF = 2.0


@kernel
def clear_transverse(lv):
    """Let the balls follow statically."""
    for i in range(L.SIDE, L.SIDE_STEP):
        lv[i] = 0.0
    lv[L.SIDE_STEP] = 0.0
    for i in range(L.SIDE_ROLLING, L.SIDE_ROLLING + L.PATTERNS * L.COLUMN):
        lv[i] = 0.0


@kernel
def ball_stiffness(p, orbit, w):
    """Return what holds ball 0 at its contacts by places x, r (N/m): xx, xr, rr, with its orbit's pull."""
    kxx, kxr, krr = 0.0, 0.0, -p[P.BALL_MASS] * orbit * orbit
    for at in (T.CONTACT, T.CONTACT_OUTER):
        xx, xr, rr = in_plane(
            0.0, 0.0, 0.0,
            w[at + T.STIFF], w[at + T.ACROSS], w[at + T.EX], w[at + T.ER], w[at + T.MX], w[at + T.MR],
        )  # fmt: skip
        kxx, kxr, krr = kxx + xx, kxr + xr, krr + rr
    return kxx, kxr, krr


@kernel
def find_direction(p, lv, speed, w):
    """Find direction and frequency of ball 0 across the track from its contacts; False where it is loose."""
    if not (w[T.CONTACT + T.LOAD] > _LOADED and w[T.CONTACT_OUTER + T.LOAD] > _LOADED):
        return False
    kxx, kxr, krr = ball_stiffness(p, lv[L.RATIO] * speed, w)
    half = 0.5 * (kxx - krr)
    soft = 0.5 * (kxx + krr) - math.sqrt(half * half + kxr * kxr)
    if not (soft > 0.0):
        return False
    x = krr - soft
    r = -kxr
    if abs(x) < abs(kxx - soft):
        x = -kxr
        r = kxx - soft
    size = math.sqrt(x * x + r * r)
    lv[L.SIDE] = x / size
    lv[L.SIDE + 1] = r / size
    lv[L.SIDE_SQUARE] = soft / p[P.BALL_MASS]
    lv[L.SIDE_STILL] = (x * w[T.X] + r * w[T.R]) / size
    return True


@kernel
def rolling_guide(c, lv, w, contact, first, tilt, share):
    """Fill ``L.SIDE_ROLLING`` of one ring: half of what its surface does at the contact of ball 0.

    ``contact``: rows of the contact; ``first``: coordinate of the ring's x; ``tilt``: of its tilt about y.
    """
    tx = lv[L.SIDE]
    tr = lv[L.SIDE + 1]
    x = w[contact + T.QX] + c[C.BALL_RADIUS] * w[contact + T.EX]
    r = w[contact + T.QR] + c[C.BALL_RADIUS] * w[contact + T.ER]
    lever = share * (tx * r - tr * x)
    lv[L.SIDE_ROLLING + first] = share * tx
    row = L.SIDE_ROLLING + L.COLUMN
    lv[row + first + Q.Z] = share * tr
    lv[row + tilt] = lever
    row += L.COLUMN
    lv[row + first + Q.Y] = share * tr
    lv[row + tilt + 1] = -lever


@kernel
def find_transverse(p, c, lv, speed, w):
    """Fill direction, frequency and rolling of the balls at the frozen point, whose contacts are in ``w``.

    Where ball 0 is not loaded by both races, the balls follow statically.
    """
    clear_transverse(lv)
    if not find_direction(p, lv, speed, w):
        return
    rolling_guide(c, lv, w, T.CONTACT, Q.INNER, Q.INNER_BY, 0.5)
    rolling_guide(c, lv, w, T.CONTACT_OUTER, Q.OUTER, Q.OUTER + Q.BY, 0.5)


@kernel
def find_friction(lv, jac):
    """Friction across the track from the full Jacobian of ball 0, whose spin yields."""
    if lv[L.SIDE_SQUARE] == 0.0:
        return
    tx = lv[L.SIDE]
    tr = lv[L.SIDE + 1]
    x = J.B + F.X // STRIDE * J.STATES * STRIDE
    r = J.B + F.R // STRIDE * J.STATES * STRIDE
    spin = J.B + F.WT // STRIDE * J.STATES * STRIDE
    own = tx * (tx * jac[x + Y.VX] + tr * jac[x + Y.VR]) + tr * (tx * jac[r + Y.VX] + tr * jac[r + Y.VR])
    by_spin = tx * jac[x + Y.WT] + tr * jac[r + Y.WT]
    of_spin = tx * jac[spin + Y.VX] + tr * jac[spin + Y.VR]
    if jac[spin + Y.WT] < 0.0:
        own -= by_spin * of_spin / jac[spin + Y.WT]
    lv[L.SIDE_RATE] = max(-own, 0.0)


@kernel
def free_motion(lv, h):
    """Fill what a pattern's place and velocity become of over ``h`` (s) if nothing drives it."""
    half = 0.5 * lv[L.SIDE_RATE]
    inside = half * half - lv[L.SIDE_SQUARE]
    if inside < 0.0:
        turning = math.sqrt(-inside)
        decay = math.exp(-half * h)
        lv[L.SIDE_COAST] = decay * math.sin(turning * h) / turning
        lv[L.SIDE_STAY] = decay * math.cos(turning * h) + half * lv[L.SIDE_COAST]
    else:
        root = math.sqrt(inside) + 1e-9 * half
        fast = math.exp(-(half + root) * h)
        slow = math.exp(-lv[L.SIDE_SQUARE] / (half + root) * h)
        lv[L.SIDE_COAST] = (slow - fast) / (2.0 * root)
        lv[L.SIDE_STAY] = 0.5 * (slow + fast) + half * lv[L.SIDE_COAST]
    lv[L.SIDE_STEP] = h


@kernel
def moved_on(lv, h, place, velocity, drive, b1, b2, b3, b4):
    """Place and velocity of a pattern after ``h`` (s), driven by ``drive + b1 t + b2 t^2 + ...`` (m/s2)."""
    per = 1.0 / lv[L.SIDE_SQUARE]
    rate = lv[L.SIDE_RATE]
    # a polynomial that obeys the equation, then the free motion of what is left
    c4 = per * b4
    c3 = per * (b3 - 4.0 * rate * c4)
    c2 = per * (b2 - 3.0 * rate * c3 - 12.0 * c4)
    c1 = per * (b1 - 2.0 * rate * c2 - 6.0 * c3)
    c0 = per * (drive - rate * c1 - 2.0 * c2)
    off = place - c0
    fast = velocity - c1
    stay, coast = lv[L.SIDE_STAY], lv[L.SIDE_COAST]
    at = c0 + h * (c1 + h * (c2 + h * (c3 + h * c4))) + stay * off + coast * fast
    moving = c1 + h * (2.0 * c2 + h * (3.0 * c3 + h * 4.0 * c4))
    return at, moving - lv[L.SIDE_SQUARE] * coast * off + (stay - rate * coast) * fast


@kernel
def continued(lv, h, end, now, before, earlier, earliest):
    """Coefficients of the drive's polynomial over a step ``h`` (s) through its values, ``end`` at the end.

    The number of values that count is that of what is known, three where the balls just follow the drive, and
    one in the finest steps.
    """
    turned = lv[L.SIDE_SQUARE] * h * h
    if turned < _FINE * _FINE:
        return end, 0.0, 0.0, 0.0, 0.0
    per = 1.0 / h
    if lv[L.KNOWN] < 1.0:
        return now, (end - now) * per, 0.0, 0.0, 0.0
    if lv[L.KNOWN] < 3.0 or lv[L.SIDE_RATE] * h > _STIFF or turned < _SMOOTH * _SMOOTH:
        b2 = 0.5 * (end - 2.0 * now + before) * per * per
        return now, 0.5 * (end - before) * per, b2, 0.0, 0.0
    per /= 24.0
    b1 = (6.0 * end + 20.0 * now - 36.0 * before + 12.0 * earlier - 2.0 * earliest) * per
    per /= h
    b2 = (11.0 * end - 20.0 * now + 6.0 * before + 4.0 * earlier - earliest) * per
    per /= h
    b3 = (6.0 * end - 20.0 * now + 24.0 * before - 12.0 * earlier + 2.0 * earliest) * per
    per /= h
    b4 = (end - 4.0 * now + 6.0 * before - 4.0 * earlier + earliest) * per
    return now, b1, b2, b3, b4


@kernel
def guided(lv, k, x, rates):
    """Velocity (m/s) that rolling alone gives pattern ``k``, the rings' velocities at ``x[rates:]``."""
    total = 0.0
    for i in range(L.N):
        total += lv[L.SIDE_ROLLING + k * L.COLUMN + i] * x[rates + i]
    return total


@kernel
def pattern_receptance(lv, omega):
    """Place of a pattern at ``omega`` (rad/s) by what drives it: complex (s2)."""
    return over(complex(1.0, 0.0), complex(lv[L.SIDE_SQUARE] - omega * omega, omega * lv[L.SIDE_RATE]))
