"""Building blocks of the engine against slow, obviously right versions."""

import math

import numpy as np
import pytest

from fmu_bearing.engine.fidelities.full.methods.esdirk4 import ESDIRK4
from fmu_bearing.engine.fidelities.full.methods.trbdf2 import TRBDF2
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.lanes import load, store
from fmu_bearing.engine.layout import FOUR, STAGES, STRIDE, TAB, A, C, F, J, P, R, W, X
from fmu_bearing.engine.mechanics.cage import film_force, land_contact
from fmu_bearing.engine.mechanics.powers import exp2, log2
from fmu_bearing.engine.mechanics.race import waviness
from fmu_bearing.engine.mechanics.trigonometry import ball_angles, wrap
from fmu_bearing.engine.newton import block_arrow
from fmu_bearing.prepare.imperfections import Harmonics, intervals, wave_table
from tests.oracles import journal


def test_sine_and_cosine_are_right_to_rounding():
    rng = np.random.default_rng(0)
    worst = 0.0
    w = np.zeros(4 * STRIDE)
    for _ in range(500):
        angles = rng.uniform(-4 * np.pi, 4 * np.pi, STRIDE)
        ball_angles(angles, 0, STRIDE, w)
        worst = max(worst, np.abs(w[W.COS :][:STRIDE] - np.cos(angles)).max())
        worst = max(worst, np.abs(w[W.SIN :][:STRIDE] - np.sin(angles)).max())
    # two units in the last place of 1, plus the split of pi over two turns
    assert worst < 5e-16


def test_wrap_keeps_the_angle_and_its_range():
    angles = np.linspace(-20.0, 20.0, 4001)
    wrapped = np.array([wrap(a) for a in angles])
    assert np.abs(wrapped).max() <= math.pi + 1e-12
    np.testing.assert_allclose(np.cos(wrapped), np.cos(angles), atol=2e-14)
    np.testing.assert_allclose(np.sin(wrapped), np.sin(angles), atol=2e-14)


@pytest.mark.parametrize("highest", [20, 1000])
def test_wave_table_interpolates_harmonics(highest):
    orders = np.arange(2, highest + 1)
    amplitudes = np.full(orders.size, 1e-7)
    phases = np.random.default_rng(1).uniform(0, 2 * np.pi, orders.size)
    count = intervals(highest)
    p = np.zeros(P.TABLES + 4 * count)
    p[P.WAVINESS] = 1.0
    p[P.WAVE_INTERVALS] = count
    p[P.AT_WAVES] = P.TABLES
    p[P.TABLES : P.TABLES + 2 * count] = wave_table(Harmonics(amplitudes, orders, phases), count)
    c = np.zeros(C.SIZE)
    c[C.OVERSIZE_SCALE] = 1.0
    w = np.zeros(W.ROWS)
    pose = W.POSE
    w[pose + X.H + STRIDE : pose + X.H + 2 * STRIDE] = 1.0  # the ring is centred
    angles = np.random.default_rng(2).uniform(-7, 7, STRIDE)
    waviness(p, c, angles, STRIDE, 0, 0.3, w)
    row = W.RACE
    argument = np.outer(orders, angles - 0.3) + phases[:, None]
    # cubic Hermite error of order n: (2 pi n / count)^4 / 384 of its amplitude, 9e-4 at the highest of 1000;
    # errors of random phases add as squares
    share = (2.0 * np.pi * orders / count) ** 4 / 384.0
    height = 1e-7 * np.sqrt((share**2).sum()) * 4.0
    np.testing.assert_allclose(w[row + R.WAVE :][:STRIDE], 1e-7 * np.cos(argument).sum(0), atol=height)
    slope = -1e-7 * (orders[:, None] * np.sin(argument)).sum(0)
    # the slope's error, (2 pi n / count)^3 / (72 sqrt 3) times n
    share = orders * (2.0 * np.pi * orders / count) ** 3 / 124.7
    tolerance = 1e-7 * np.sqrt((share**2).sum()) * 4.0
    np.testing.assert_allclose(w[row + R.SLOPE :][:STRIDE], slope, atol=tolerance)


FILM = journal.Film(viscosity=0.006, radius=11.66e-3, length=2.25e-3, clearance=0.04e-3)
FACTOR = FILM.viscosity * FILM.radius * FILM.length**3 / FILM.clearance**2


@pytest.mark.parametrize("ratio", [0.0, 1e-6, 0.05, 0.5, 0.9, 0.96])
@pytest.mark.parametrize(
    ("rate", "wedge"),
    [(0.0, 800.0), (300.0, 800.0), (-200.0, -500.0), (900.0, -3000.0), (-500.0, 0.0), (500.0, 0.0)],
)
def test_land_film_against_the_integrated_pressure(ratio, rate, wedge):
    """Wedge and squeeze in any proportion, at any eccentricity, with pressure where it is positive."""
    if ratio == 0.0 and rate == 0.0:
        return  # no film moves
    c = FILM.clearance
    motion = journal.Motion(ratio * c, rate * c, 0.7, 0.0, wedge, 0.0)
    radial, tangential = FACTOR * np.array(film_force(ratio, rate, -0.5 * wedge * ratio))
    along, across = journal.force_by_quadrature(FILM, motion)
    # the kernel rounds the motion's direction over 0.01 1/s; the slowest motion that turns it here is 20 1/s,
    # but for the nearly centred wedge, whose force is 1e-5 of any other in the table
    size = np.hypot(along, across) + 1e-4 * FACTOR * film_force(ratio, 20.0, 0.0)[0]
    np.testing.assert_allclose((-radial, tangential), (along, across), rtol=0.0, atol=2e-6 * size)


@pytest.mark.parametrize("ratio", [0.0, 0.3, 0.9])
def test_land_film_is_smooth_where_the_motion_turns(ratio):
    """Through a reversal of wedge and squeeze the slope of the force changes by bounded steps."""
    angles = np.linspace(0.0, 2.0 * np.pi, 2001)
    for size in (1e-3, 1.0, 1e3):
        push = np.array([film_force(ratio, size * np.cos(a), size * np.sin(a)) for a in angles])
        bend = np.abs(np.diff(push, 2, axis=0)).max()
        # a harmonic of order n bends by (n pi/1000)^2 of its size; a corner would be 300 times as sharp
        assert bend < (10.0 * np.pi / 1000) ** 2 * np.abs(push).max()


def test_land_is_isotropic_in_its_middle():
    """The cage crosses the middle at any direction and speed: force and slope do not jump there."""
    p = np.zeros(P.TABLES)
    p[P.LAND_RADIUS], p[P.LAND_LENGTH] = 11.66e-3, 2.25e-3
    p[P.LAND_STOP_FRACTION], p[P.LAND_STOP_SLIP] = 0.96, 0.1
    way = np.array([0.6, -0.8])
    velocity = 0.01, 0.03
    places = np.linspace(-2e-7, 2e-7, 41)
    forces = np.array(
        [land_contact(p, (0.006, 4e-5), *(x * way), *velocity, 2094.0, 880.0)[:2] for x in places]
    )
    still = np.array(land_contact(p, (0.006, 4e-5), 0.0, 0.0, *velocity, 2094.0, 880.0)[:2])
    np.testing.assert_allclose(forces[20], still, rtol=1e-14)
    # squeezed evenly all round: against the velocity, half of a full film
    factor = 0.5 * np.pi * 0.006 * 11.66e-3 * 2.25e-3**3 / 4e-5**3
    np.testing.assert_allclose(still, -factor * np.array(velocity), rtol=1e-4)
    straight = still + np.outer(places, (forces[-1] - forces[0]) / (places[-1] - places[0]))
    # what bends goes with the square of the offset over the clearance, 0.005: four times that
    np.testing.assert_allclose(forces, straight, rtol=0.0, atol=2e-4 * np.abs(still).max())


@pytest.mark.parametrize(("journal_speed", "sleeve"), [(2094.0, 880.0), (880.0, 2094.0), (-2094.0, -880.0)])
def test_the_dry_stop_drags_the_cage_along_and_brakes_the_ring(journal_speed, sleeve):
    """Coulomb's law at the place behind the ring's centre where both surfaces touch; no oil."""
    p = np.zeros(P.TABLES)
    clearance, radius, share, stiffness, mu, slip = 4e-5, 11.66e-3, 0.96, 5e6, 0.05, 0.1
    p[P.LAND_RADIUS], p[P.LAND_LENGTH] = radius, 2.25e-3
    p[P.LAND_STOP_FRACTION], p[P.LAND_STOP_STIFFNESS] = share, stiffness
    p[P.LAND_STOP_FRICTION], p[P.LAND_STOP_SLIP] = mu, slip
    way, apart = np.array([0.6, -0.8]), 3.9e-5
    *force, on_ring, on_cage, energy, lost = land_contact(
        p, (0.0, clearance), *(apart * way), 0.0, 0.0, journal_speed, sleeve
    )
    push = apart - share * clearance
    # both touch at -way; a spin about x moves a point at r by spin x r
    ahead = np.array([way[1], -way[0]])
    sliding = radius * journal_speed - (radius + apart) * sleeve
    drag = mu * stiffness * push * sliding / math.hypot(sliding, slip)
    np.testing.assert_allclose(force, -stiffness * push * way + drag * ahead, rtol=1e-12)
    assert on_ring == pytest.approx(-radius * drag, rel=1e-12)
    # about the ring's centre nothing is left over; what rubs is lost
    moment = apart * (way[0] * force[1] - way[1] * force[0])
    assert on_ring + on_cage + moment == pytest.approx(0.0, abs=1e-12 * abs(on_ring))
    assert energy == pytest.approx(0.5 * stiffness * push**2, rel=1e-9)
    assert lost == pytest.approx(drag * sliding, rel=1e-9) and lost > 0.0


def random_blocks(rng, p, lanes, balls):
    jac = np.zeros(J.SIZE)
    jac[: J.E] = rng.normal(size=J.E)
    # spare lanes put no forces on the bodies
    jac[J.D : J.E].reshape(-1, STRIDE)[:, balls:] = 0.0
    jac[J.E :] = rng.normal(size=17 * 34)
    return jac


def dense(jac, balls, cv, cx):
    """The same Newton matrix as one dense array."""
    n = 6 * balls + 17
    m = np.eye(n)

    def block(base, rows, columns, lane):
        return np.array(
            [[jac[base + (i * columns + k) * STRIDE + lane] for k in range(columns)] for i in range(rows)]
        )

    border = slice(6 * balls, n)
    for j in range(balls):
        own = slice(6 * j, 6 * j + 6)
        b, c, d = block(J.B, 6, 9, j), block(J.C, 6, 34, j), block(J.D, 17, 9, j)
        m[own, own] -= cv * b[:, 3:]
        m[own, 6 * j : 6 * j + 3] -= cx * b[:, :3]
        m[own, border] = -cv * c[:, 17:] - cx * c[:, :17]
        m[border, own] = -cv * d[:, 3:]
        m[border, 6 * j : 6 * j + 3] -= cx * d[:, :3]
    e = jac[J.E :].reshape(17, 34)
    m[border, border] -= cv * e[:, 17:] + cx * e[:, :17]
    return m


def solve_both(p, springs, angle=0.0, balls=11, lanes=12):
    """Solution of a random system by the engine and by the dense matrix ``springs`` is added to."""
    rng = np.random.default_rng(3)
    p[P.BALLS], p[P.LANES] = balls, lanes
    jac = random_blocks(rng, p, lanes, balls)
    cv, cx = 0.03, 0.01
    fac, w = np.zeros(A.SIZE), np.zeros(W.SOUND)
    assert block_arrow.factor(p, jac, cv, cx, cx, fac, w)
    d = np.zeros(F.SIZE)
    rows = rng.normal(size=(6, balls))
    for i in range(6):
        d[i * STRIDE : i * STRIDE + balls] = rows[i]
    d[F.BODY : F.BODY + 17] = rng.normal(size=17)
    turned = np.eye(6 * balls + 17)
    for k in (1, 3, 6, 9, 12, 15):
        at_k = slice(6 * balls + k, 6 * balls + k + 2)
        turned[at_k, at_k] = [[np.cos(angle), -np.sin(angle)], [np.sin(angle), np.cos(angle)]]
    right = np.concatenate([rows.T.ravel(), d[F.BODY : F.BODY + 17]])
    expected = turned @ np.linalg.solve(dense(jac, balls, cv, cx) + springs(cv, cx), turned.T @ right)
    block_arrow.solve(p, fac, math.cos(angle), math.sin(angle), d, w)
    got = np.concatenate(
        [np.array([d[i * STRIDE : i * STRIDE + balls] for i in range(6)]).T.ravel(), d[F.BODY : F.BODY + 17]]
    )
    return got, expected


# Heavy, as is the next, because these kernels are compiled by themselves here, in 11 s.
@pytest.mark.heavy
def test_block_arrow_solves_the_dense_system():
    got, expected = solve_both(np.zeros(P.TABLES), lambda cv, cx: 0.0)
    np.testing.assert_allclose(got, expected, rtol=1e-10, atol=1e-12)


@pytest.mark.heavy
@pytest.mark.parametrize("angle", [0.0, 0.6])
@pytest.mark.parametrize("stiffness", [1.0, 1e6])
def test_springs_between_balls_solve_the_dense_system(angle, stiffness):
    p, balls = np.zeros(P.TABLES), 11
    p[P.SPRINGS], p[P.SPRING_DAMPING], p[P.BALL_MASS] = stiffness, 7.0, 0.4

    def springs(cv, cx):
        matrix = np.zeros((6 * balls + 17,) * 2)
        for j in range(balls):
            rows = 6 * j + 2, 6 * ((j + 1) % balls) + 2
            matrix[np.ix_(rows, rows)] += (
                np.cos(np.pi / balls) ** 2
                * (cv * 7.0 + cx * stiffness)
                / 0.4
                * np.array([[1.0, -1.0], [-1.0, 1.0]])
            )
        return matrix

    got, expected = solve_both(p, springs, angle)
    np.testing.assert_allclose(got, expected, rtol=1e-9, atol=1e-10)


@pytest.mark.parametrize(("block", "order", "companion"), [(ESDIRK4, 4, 3), (TRBDF2, 2, 3)])
def test_tableaux_meet_the_order_conditions(block, order, companion):
    stages = int(block[TAB.COUNT])
    a = np.zeros((STAGES, STAGES))
    a[:, : TAB.ROW] = block[TAB.A : TAB.B].reshape(STAGES, TAB.ROW)
    a = a[:stages, :stages] + np.diag([0.0] + [block[TAB.GAMMA]] * (stages - 1))
    c = a.sum(1)
    b = block[TAB.B : TAB.ERROR][:stages]
    low = b - block[TAB.ERROR :][:stages]
    np.testing.assert_allclose(c, block[TAB.NODES :][:stages], atol=1e-14)
    np.testing.assert_allclose(a[-1], b, atol=1e-14)  # stiffly accurate
    for weights, reached in ((b, order), (low, companion)):
        conditions = [
            (1, weights.sum(), 1),
            (2, weights @ c, 1 / 2),
            (3, weights @ c**2, 1 / 3),
            (3, weights @ a @ c, 1 / 6),
            (4, weights @ c**3, 1 / 4),
            (4, (weights * c) @ a @ c, 1 / 8),
            (4, weights @ a @ c**2, 1 / 12),
            (4, weights @ a @ a @ c, 1 / 24),
        ]
        for needed, got, want in conditions:
            if needed <= reached:
                assert got == pytest.approx(want, abs=1e-13)


def test_powers_of_two_are_right_to_rounding():
    @kernel
    def both(x, n, logs, back):
        for j in range(0, n, FOUR):
            store(logs, j, log2(load(x, j)))
            store(back, j, exp2(load(logs, j)))

    x = np.exp(np.random.default_rng(5).uniform(-300, 300, 4000))
    logs, back = np.zeros(x.size), np.zeros(x.size)
    both(x, x.size, logs, back)
    np.testing.assert_allclose(logs, np.log2(x), rtol=1e-15, atol=2e-15)
    # the logarithm's own rounding, up to 430 * 1e-16, comes back as a relative error
    np.testing.assert_allclose(back, x, rtol=1e-13)
