"""The contact of ball and race against geometry at 40 digits and a spline, of one ball and of four."""

import numpy as np
import pytest
from mpmath import mp
from scipy.interpolate import CubicHermiteSpline

from fmu_bearing.compiled import call
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import lane, load, splat, store
from fmu_bearing.engine.layout import FOUR, C, F, P, Q, R, S, W, Y
from fmu_bearing.engine.mechanics.contact import (
    approach_under,
    contact_axes,
    damped,
    damped_slopes,
    hertz,
    in_plane,
    race_surface,
)
from fmu_bearing.engine.mechanics.pose import axis_cosine, ball_pose
from fmu_bearing.engine.statics.ball_balance import inner_contact, outer_contact, pose_at
from fmu_bearing.engine.statics.quasistatic import imperfection_approach
from tests.engine.helpers import Run

FOUND = 19  # numbers that `contact` gives, of them
ELASTIC, BY_APPROACH = 9, 13
STIFFNESS, TAU = 8e9, 5e-7  # N/m^1.5, s


@kernel
def contact(co, si, x, radius, uy, uz, by, bz, groove_x, groove_r, free, rate):
    """Return all that a contact gives, as a tuple of `FOUND` numbers."""
    nx = axis_cosine(by, bz)
    _, _, _, nr, nt, axial, rho, hx, hr, ht = ball_pose(co, si, x, radius, 0.0, uy, uz, by, bz, nx)
    n, h = (nx, nr, nt), (hx, hr, ht)
    distance, per, sine, cosine, e, m = contact_axes(axial - groove_x, rho - groove_r, n, h)
    elastic, slope, root = hertz(STIFFNESS, distance - free)
    by_approach, by_rate = damped_slopes(STIFFNESS, 1.5 * TAU, root, 1.0 / max(root, 1e-5), rate)
    xx, xr, rr = in_plane(0.0, 0.0, 0.0, slope, elastic * per, sine, cosine, cosine, -sine)
    pressing = damped(STIFFNESS, 1.5 * TAU, root, elastic, rate)
    return (
        distance, e[0], e[1], e[2], m[0], m[1], m[2], sine, cosine, elastic, slope, root, pressing,
        by_approach, by_rate, xx, xr, rr, per,
    )  # fmt: skip


@kernel
def of_one(given, out):
    """Contact of one ball, from row 0 of ``given`` by columns of four."""
    g = given
    found = contact(
        g[0], g[4], g[8], g[12], g[16], g[20], g[24], g[28], g[32], g[36], g[40], g[44]
    )  # fmt: skip
    for i in range(FOUND):
        out[FOUR * i] = found[i]


@kernel
def of_four(given, out):
    """Contacts of four balls."""
    g = given
    found = contact(
        load(g, 0), load(g, 4), load(g, 8), load(g, 12), load(g, 16), load(g, 20), load(g, 24), load(g, 28),
        load(g, 32), load(g, 36), load(g, 40), load(g, 44),
    )  # fmt: skip
    for i in range(FOUND):
        store(out, FOUR * i, found[i])


def draw(seed):
    """Four contacts by columns: ball's cosine and sine, place, ring's place and tilts, groove, free, rate."""
    rng = np.random.default_rng(seed)
    angle, tilt = rng.uniform(-np.pi, np.pi, 4), rng.normal(0.0, 1e-3, (2, 4))
    contact_angle, side = rng.uniform(-0.7, 0.7, 4), rng.choice((-1.0, 1.0), 4)
    free, pitch = rng.uniform(0.6e-4, 3e-4, 4), rng.uniform(1e-2, 4e-2, 4)
    aside = rng.normal(0.0, 1e-6, (2, 4))
    # one contact in four is open
    reach = side * (free + rng.uniform(-1e-6, 4e-6, 4))
    x, r = reach * np.sin(contact_angle), pitch + reach * np.cos(contact_angle)
    rate = rng.normal(0.0, 0.5, 4)
    zero = np.zeros(4)
    return np.array([np.cos(angle), np.sin(angle), x, r, *aside, *tilt, zero, pitch, free, rate])


def from_geometry(given):
    """The same numbers from the nearest point of the groove's circle in space, and Hertz's law."""
    co, si, x, radius, uy, uz, by, bz, groove_x, groove_r, free, rate = map(mp.mpf, map(float, given))
    nx = 1 - (by**2 + bz**2) / 2
    # in the ball's axes x, r, theta; the ring's axis is of unit length to the fourth order of its tilts
    n = mp.matrix([nx, -si * bz - co * by, -co * bz + si * by])
    q = mp.matrix([x, radius - (co * uz - si * uy), co * uy + si * uz])
    one = mp.matrix([-n[1], n[0], mp.mpf(0)]) / mp.hypot(n[0], n[1])
    other = mp.matrix([
        n[1] * one[2] - n[2] * one[1], n[2] * one[0] - n[0] * one[2], n[0] * one[1] - n[1] * one[0],
    ])  # fmt: skip

    def apart(turn):
        return q - groove_x * n - groove_r * (mp.cos(turn) * one + mp.sin(turn) * other)

    def square(turn):
        return (apart(turn).T * apart(turn))[0]

    turn = mp.findroot(lambda turn: mp.diff(square, turn), mp.mpf(0))
    gap = apart(turn)
    distance = mp.norm(gap)
    e = gap / distance
    sine = (e.T * n)[0]
    away = mp.cos(turn) * one + mp.sin(turn) * other
    cosine = (e.T * away)[0]
    m = cosine * n - sine * away

    def law(approach):
        return STIFFNESS * max(approach, 0) ** mp.mpf("1.5")

    approach = distance - free
    elastic, root = law(approach), mp.sqrt(max(approach, 0))
    slope = mp.diff(law, approach) if approach > 0 else mp.mpf(0)
    bend = mp.diff(law, approach, 2) if approach > 0 else mp.mpf(0)
    pressing = max(elastic + TAU * slope * rate, 0)

    def push(x, r):
        """In-plane force by a small place of the ball in the section through the contact."""
        where = mp.matrix([distance * sine + x, distance * cosine + r])
        return law(mp.norm(where) - free) * where / mp.norm(where)

    h = mp.mpf(10) ** -15
    columns = [(push(h, 0) - push(-h, 0)) / (2 * h), (push(0, h) - push(0, -h)) / (2 * h)]
    plane = (columns[0][0], columns[1][0], columns[1][1]) if approach > 0 else (0, 0, 0)
    return [
        distance, *e, *m, sine, cosine, elastic, slope, root, pressing,
        slope + TAU * bend * rate, TAU * slope, *plane, 1 / distance,
    ]  # fmt: skip


@pytest.mark.parametrize("seed", range(6))
def test_one_ball_and_four_have_equal_bits_and_the_geometry_at_40_digits(seed):
    given = draw(seed)
    one, four = np.zeros((FOUR, FOUND, FOUR)), np.zeros((FOUND, FOUR))
    of_four(given.ravel(), four.ravel())
    for j in range(FOUR):
        of_one(np.roll(given, -j, axis=1).ravel(), one[j].ravel())
    np.testing.assert_array_equal(one[:, :, 0].T, four)
    with mp.workdps(40):
        wanted = np.array([[float(x) for x in from_geometry(given[:, j])] for j in range(FOUR)]).T
    # Lengths are rounded to 1e-17 m at the pitch circle. Directions: that over the distance, and the axis of
    # the tilted ring, which is 1e-12 short at 1e-3 rad. Approach: 1e-17 m of 1e-7 m and more, so 1e-10 of it.
    size = np.abs(wanted).max(axis=1)[:, None]
    four[BY_APPROACH] *= wanted[ELASTIC] > 0.0  # callers ask for slopes of contacts that carry load
    np.testing.assert_allclose(four[0], wanted[0], rtol=1e-11)
    np.testing.assert_allclose(four[1:9], wanted[1:9], atol=2e-11)
    np.testing.assert_allclose(four[9:] / size[9:], wanted[9:] / size[9:], atol=1e-8)


def test_an_open_contact_carries_nothing_and_the_law_turns_round():
    assert hertz(STIFFNESS, -1e-6) == (0.0, 0.0, 0.0)
    # a pull by damping is none
    load, _, root = hertz(STIFFNESS, 1e-6)
    assert damped(STIFFNESS, 1.5 * TAU, root, load, -10.0) == 0.0
    assert approach_under(STIFFNESS, load) == pytest.approx(1e-6, rel=1e-14)


@kernel
def surface_at(p, race, place, out):
    """Height and derivatives at four places, then at the first of them alone."""
    found = race_surface(p, race, load(place, 0))
    single = race_surface(p, race, splat(place[0]))
    for i in range(3):
        store(out, FOUR * i, found[i])
        out[3 * FOUR + i] = lane(single[i], 0)


def test_a_race_is_a_cubic_spline_through_its_table():
    count, rng = 64, np.random.default_rng(3)
    table = rng.normal(size=(2, count, 2))
    p = np.concatenate([np.zeros(P.TABLES), table.ravel()])
    p[P.WAVE_INTERVALS], p[P.AT_WAVES] = count, P.TABLES
    for race in range(2):
        closed = np.vstack([table[race], table[race, :1]])
        spline = CubicHermiteSpline(np.arange(count + 1), closed[:, 0], closed[:, 1])
        for place in rng.uniform(-3 * count, 3 * count, (50, FOUR)):
            out = np.zeros(3 * FOUR + 3)
            surface_at(p, race, place, out)
            wanted = np.array([spline(place % count, order) for order in range(3)])
            # derivatives of a cubic with coefficients up to 20, rounded
            np.testing.assert_allclose(out[: 3 * FOUR].reshape(3, FOUR), wanted, atol=1e-11)
            np.testing.assert_array_equal(out[3 * FOUR :], out[: 3 * FOUR : FOUR])


@pytest.mark.parametrize("name", ["7003C-spindle", "7009C-steel"])
@pytest.mark.parametrize(("scale", "aside"), [(1.0, 0.0), (0.0, 1.0)])
def test_statics_have_the_contacts_of_the_right_hand_side(scene, name, scale, aside):
    """Loads of both races: with sizes and waves between upright rings, and without between tilted ones.

    Statics read waves at the ball's angle about the bearing's centre, not about that of a displaced ring.
    """
    run = Run(scene(name), 0.0).init()
    p, c, rng = run.p, run.s[S.C : S.C + C.SIZE].copy(), np.random.default_rng(8)
    balls, lanes = int(p[P.BALLS]), int(p[P.LANES])
    c[C.OVERSIZE_SCALE] = scale
    # about the preloaded state, seen from the outer ring's centre; angles as statics have them
    y = run.s[S.Y : S.Y + Y.SIZE].copy()
    y[Y.X : Y.X + lanes] -= y[Y.Q0 + Q.OUTER]
    axial = y[Y.Q0] - y[Y.Q0 + Q.OUTER]
    ring = np.array([axial, *rng.normal(0.0, aside * 3e-7, 2), *rng.normal(0.0, aside * 1e-4, 2)])
    y[Y.Q0 :] = 0.0
    y[Y.Q0 : Y.Q0 + ring.size] = ring
    y[Y.TH : Y.TH + lanes] = 2.0 * np.pi * np.where(np.arange(lanes) < balls, np.arange(lanes), 0) / balls
    call("right_hand_side", p, c, y, run.w, np.zeros(F.SIZE), 0.0, 0.0, 0.0)
    elastic = [run.w[W.RACE + race * R.SIZE + R.ELASTIC :][:balls].copy() for race in range(2)]
    for j in range(balls):
        angle = 2.0 * np.pi * j / balls
        depths = [imperfection_approach(p, c, race, j, angle) for race in range(2)]
        pose = pose_at(np.cos(angle), np.sin(angle), ring, np.zeros(2), *depths)
        radius = p[P.PITCH_RADIUS] + y[Y.R + j]
        for race, seat in enumerate((inner_contact, outer_contact)):
            # places are rounded to 2e-18 m, of an approach of 1e-7 m and more
            found = seat(p, c, pose, y[Y.X + j], radius).load
            assert found == pytest.approx(elastic[race][j], rel=1e-9, abs=1e-7)
