"""What contacts do to a ball and to the rings as the ball leaves its place of rest: K and D_e of `operator`.

A ball at its place of rest has the loads of rest, and frozen friction across the track. What follows
the loads is in K and D_e twice: as the ball moves, and by how much contacts press where it rests, which waves
change. With low preload friction is 2 % of the load, and contacts at small angles push along the axis by 5 to
13 % more for it. Surfaces do not move along the track.
"""

from fmu_bearing.engine.complex_numbers import complex_at, real_times
from fmu_bearing.engine.fidelities.condensed.families import acting, member
from fmu_bearing.engine.fidelities.condensed.transverse import ball_stiffness
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, C, F, J, L, P, T
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.newton.body_slopes import inertia

# Where a ball counts as far from its place of rest, both chosen: contacts' forces over their loads, and the
# distance over the approach. Lost contact then steps on, and the form of a 7009C's balls is not cut.
_FAR, _WIDE = 2.0, 16.0
# Balls that all count as loaded by less do so here, too (chosen): there waves lift them off.
_LOOSE = 0.5
_HEIGHT = 1e-9  # m: of differences, 1e-4 of an approach: errors of the second order are 1e-8


@kernel
def find_restoring(p, orbit, w):
    """Put what contacts do to ball 0 per place x, r to ``T.RESTORING`` (1/s2), with its orbit's pull."""
    mass = p[P.BALL_MASS]
    xx, xr, rr = ball_stiffness(p, orbit, w)
    for i in range(L.AWAYS * J.BALL):
        w[T.RESTORING + i] = 0.0
    w[T.RESTORING] = xx / mass
    w[T.RESTORING + 1] = xr / mass
    w[T.RESTORING + L.AWAYS] = xr / mass
    w[T.RESTORING + 1 + L.AWAYS] = rr / mass


@kernel
def ring_force_by_place(w, at, pair, k):
    """Return forces x, y, z and moments y, z on a ring by place ``k`` (x, r) of ball 0, by contact alone.

    ``at``: rows of the contact; ``pair``: friction across the track (N). As `balls.forces_on_ring`.
    """
    dx, dr = (1.0, 0.0) if k == 0 else (0.0, 1.0)
    ex, er, et = w[at + T.EX], w[at + T.ER], w[at + T.ET]
    mx, mr, mt = w[at + T.MX], w[at + T.MR], w[at + T.MT]
    along = w[at + T.STIFF] * (ex * dx + er * dr)
    across = w[at + T.ACROSS] * (mx * dx + mr * dr)
    fx, fr, ft = along * ex + across * mx, along * er + across * mr, along * et + across * mt
    pressed = w[at + T.LOAD]
    now_x, now_r, now_t = pressed * ex + pair * mx, pressed * er + pair * mr, pressed * et + pair * mt
    qx, qr, qt = w[at + T.QX], w[at + T.QR], w[at + T.QT]
    gr = qt * fx - qx * ft - dx * now_t
    gt = qx * fr - qr * fx + dx * now_r - dr * now_x
    return fx, -ft, fr, -gt, gr


@kernel
def find_coupling(p, lv, speed, w):
    """Put accelerations of the rings by the balls' places x, r, by contacts alone, to ``T.COUPLING``.

    Per family four coordinates by x, then r, complex. The contacts of ball 0, at angle 0, are in ``w``.
    """
    for i in range(T.COUPLING_SIZE):
        w[T.COUPLING + i] = 0.0
    for ring in range(2):
        at = T.CONTACT if ring == 0 else T.CONTACT_OUTER
        pair = lv[L.PAIR_INNER + ring] * speed * speed
        for k in range(2):
            add_push(p, ring, k, ring_force_by_place(w, at, pair, k), w)


@kernel
def add_push(p, ring, k, pushed, w):
    """Add forces x, y, z and moments y, z of ball 0 on a ring to ``T.COUPLING``, for ``k`` of ``L.AWAYS``."""
    fx, fy, fz, my, mz = pushed
    pushes = complex_at(w, T.COUPLING, T.COUPLING_SIZE // 2)
    pushes[L.AWAYS * ring + k] += acting(p, 0) * fx / inertia(p, member(0, 0, ring))
    at = L.AWAYS * (L.FAMILY_RINGS + 2 * ring) + k
    pushes[at] += real_times(acting(p, 1) / inertia(p, member(1, 0, 2 * ring)), complex(fz, fy))
    per = acting(p, 1) / inertia(p, member(1, 0, 2 * ring + 1))
    pushes[at + L.AWAYS] += real_times(per, complex(my, -mz))


@kernel
def store_contacts(p, lv, w):
    """Put what `find_load_friction` needs of both contacts of ball 0, which are in ``w``, to ``T.PRESSED``.

    Direction x, r, stiffness, the contact from the ring's centre, radius of the ball's orbit. After
    `find_restoring`. ``L.REACH`` takes the quadratic form of a place x, r that is one where the contacts'
    forces are `_FAR` times their loads, and at `_WIDE` times their approach; then the product of both loads.
    """
    stiff = 1e-300
    reach = 0.0
    for race in range(2):
        at = T.CONTACT if race == 0 else T.CONTACT_OUTER
        to = T.PRESSED + race * T.PRESSED_SIZE
        half = 0.5 * p[P.DIAMETER]
        ex, er = w[at + T.EX], w[at + T.ER]
        w[to + T.TOWARDS], w[to + T.TOWARDS + 1], w[to + T.STIFFNESS] = ex, er, w[at + T.STIFF]
        w[to + T.TOUCHED_X] = w[at + T.QX] + half * ex
        w[to + T.TOUCHED_R] = w[at + T.QR] + half * er
        w[to + T.TOUCHED_T] = w[at + T.QT]
        w[to + T.ORBIT] = p[P.PITCH_RADIUS] + w[T.R]
        to = L.PRESS + race * L.PRESS_SIZE
        lv[to], lv[to + 1] = ex, er
        lv[to + L.PRESS_LEVER] = ex * w[at + T.QR] - er * w[at + T.QX]
        lv[to + L.PRESS_SOFT] = 1.0 / w[at + T.STIFF] if w[at + T.STIFF] > 0.0 else 0.0
        lv[to + L.PRESS_LOAD] = w[at + T.LOAD]
        reach += 1.5 * w[at + T.LOAD] / w[at + T.STIFF] if w[at + T.STIFF] > 0.0 else 0.0
        stiff += w[at + T.STIFF] / p[P.BALL_MASS]
    per = 1.0 / (_FAR * _FAR * stiff * reach * reach + 1e-300)
    wide = 1.0 / (_WIDE * _WIDE * reach * reach + 1e-300)
    lv[L.REACH] = per * abs(w[T.RESTORING]) + wide
    lv[L.REACH + 1] = per * w[T.RESTORING + 1]
    lv[L.REACH + 2] = per * abs(w[T.RESTORING + 1 + L.AWAYS]) + wide
    lv[L.LOADED] = w[T.CONTACT + T.LOAD] * w[T.CONTACT_OUTER + T.LOAD]
    lv[L.PRESS + L.PRESS_WHOLE] = 1.0 / max(w[T.LOADED], _LOOSE)


@kernel
def add_load_friction(p, race, k, towards, force, w):
    """Add what friction by load does to a ring as ball 0 moves along ``k`` (x, r) to `T.COUPLING`.

    ``towards``: by how much that presses the contact; ``force``: forces x, r, theta (N/m) on the ball per
    height of the race.
    """
    at = T.PRESSED + race * T.PRESSED_SIZE
    fx, fr, ft = -force[0] * towards, -force[1] * towards, -force[2] * towards
    qx, qr, qt = w[at + T.TOUCHED_X], w[at + T.TOUCHED_R], w[at + T.TOUCHED_T]
    add_push(p, race, k, (fx, -ft, fr, qr * fx - qx * fr, qt * fx - qx * ft), w)


@kernel
def find_load_friction(p, c, y, speed, w):
    """Count in ``T.RESTORING`` and ``T.COUPLING`` that friction follows the load of a contact.

    A ball at its place of rest has the load of rest, and friction of it: what leads there and what comes of
    it are those of how far contacts press, friction included; so is what a load does that changes while the
    ball rests, as under a wave. By differences of the right-hand side at the
    frozen point ``y``, by the heights of both races; after `store_contacts`.
    """
    f = w[T.FROZEN_F : T.FROZEN_F + F.SIZE]
    for race in range(2):
        at = T.PRESSED + race * T.PRESSED_SIZE
        free = C.RACES + race * C.RACE_SIZE + C.FREE
        kept = c[free]
        for i in range(J.BALL):
            w[T.HEIGHTENED + i] = 0.0
        for sign in range(-1, 2, 2):
            c[free] = kept - sign * _HEIGHT
            right_hand_side(p, c, y, 0.0, speed, 0.0, w, f)
            for i in range(J.BALL):
                w[T.HEIGHTENED + i] += sign * f[F.X + i * STRIDE] / (2.0 * _HEIGHT)
        c[free] = kept
        # the contact itself is in both tables
        mass = p[P.BALL_MASS]
        for k in range(2):
            w[T.HEIGHTENED + k] += w[at + T.STIFFNESS] * w[at + T.TOWARDS + k] / mass
        force = (
            mass * w[T.HEIGHTENED],
            mass * w[T.HEIGHTENED + 1],
            mass * w[at + T.ORBIT] * w[T.HEIGHTENED + 2],
        )
        for k in range(2):
            for i in range(J.BALL):
                w[T.RESTORING + L.AWAYS * i + k] -= w[at + T.TOWARDS + k] * w[T.HEIGHTENED + i]
            add_load_friction(p, race, k, w[at + T.TOWARDS + k], force, w)
        for i in range(J.BALL):
            w[T.RESTORING + L.AWAYS * i + 2 + race] = w[T.HEIGHTENED + i]
        # what is in `T.COUPLING` is taken from the rings, a contact that presses more adds
        add_load_friction(p, race, 2 + race, -1.0, force, w)
