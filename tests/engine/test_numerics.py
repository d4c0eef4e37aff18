"""Building blocks of the engine against slow, obviously right versions."""

import math

import numpy as np
import pytest

from fmu_bearing.engine import layout as at
from fmu_bearing.engine.mechanics.cage import film_force
from fmu_bearing.engine.mechanics.race import waves
from fmu_bearing.engine.mechanics.trigonometry import ball_angles, wrap
from fmu_bearing.engine.solvers import block_arrow, esdirk
from fmu_bearing.prepare.imperfections import wave_table
from tests.oracles import journal

S = at.STRIDE


def test_sine_and_cosine_are_right_to_rounding():
    rng = np.random.default_rng(0)
    worst = 0.0
    w = np.zeros(4 * S)
    for _ in range(500):
        angles = rng.uniform(-4 * np.pi, 4 * np.pi, S)
        ball_angles(angles, 0, S, w)
        worst = max(worst, np.abs(w[at.W_COS * S :][:S] - np.cos(angles)).max())
        worst = max(worst, np.abs(w[at.W_SIN * S :][:S] - np.sin(angles)).max())
    # two units in the last place of 1, plus the split of pi over two turns
    assert worst < 5e-16


def test_wrap_keeps_the_angle_and_its_range():
    angles = np.linspace(-20.0, 20.0, 4001)
    wrapped = np.array([wrap(a) for a in angles])
    assert np.abs(wrapped).max() <= math.pi + 1e-12
    np.testing.assert_allclose(np.cos(wrapped), np.cos(angles), atol=2e-14)
    np.testing.assert_allclose(np.sin(wrapped), np.sin(angles), atol=2e-14)


def test_wave_table_interpolates_harmonics():
    orders = np.arange(2, 21)
    amplitudes = np.full(orders.size, 1e-7)
    phases = np.random.default_rng(1).uniform(0, 2 * np.pi, orders.size)
    p = np.zeros(at.P_TABLES + 4 * at.WAVE_INTERVALS)
    p[at.P_WAVINESS] = 1.0
    p[at.P_AT_WAVES] = at.P_TABLES
    p[at.P_TABLES : at.P_TABLES + 2 * at.WAVE_INTERVALS] = wave_table(amplitudes, orders, phases)
    c = np.zeros(at.C_SIZE)
    c[at.C_OVERSIZE_SCALE] = 1.0
    w = np.zeros(at.W_ROWS * S)
    pose = at.W_POSE * S
    w[pose + (at.X_H + 1) * S : pose + (at.X_H + 2) * S] = 1.0  # the ring is centred
    angles = np.random.default_rng(2).uniform(-7, 7, S)
    waves(p, c, angles, S, 0, 0.3, w)
    row = at.W_RACE * S
    argument = np.outer(orders, angles - 0.3) + phases[:, None]
    # cubic Hermite error h^4/384 f'''' : (2 pi/2048)^4 20^4 / 384 is 4e-8 of the amplitude
    np.testing.assert_allclose(w[row + at.R_WAVE * S :][:S], 1e-7 * np.cos(argument).sum(0), atol=1e-14)
    slope = -1e-7 * (orders[:, None] * np.sin(argument)).sum(0)
    np.testing.assert_allclose(w[row + at.R_SLOPE * S :][:S], slope, atol=2e-11)


@pytest.mark.parametrize("ratio", [0.05, 0.5, 0.9])
@pytest.mark.parametrize(
    ("rate", "wedge"), [(0.0, 800.0), (300.0, 800.0), (-200.0, -500.0), (900.0, -3000.0)]
)
def test_land_film_against_the_integrated_pressure(ratio, rate, wedge):
    film = journal.Film(viscosity=0.006, radius=11.66e-3, length=2.25e-3, clearance=0.04e-3)
    c = film.clearance
    motion = journal.Motion(ratio * c, rate * c, 0.7, 0.0, wedge, 0.0)
    numbers = (film.viscosity, film.radius, film.length, c)
    radial, tangential = film_force(*numbers, ratio, rate, wedge)
    along, across = journal.force_by_quadrature(film, motion)
    # the kernel rounds |wedge| over 1 rad/s, (1/500)^2/2 relative, and parts of the force may cancel
    np.testing.assert_allclose((-radial, tangential), (along, across), atol=1e-5 * np.hypot(along, across))


def random_blocks(rng, p, lanes, balls):
    jac = np.zeros(at.J_SIZE)
    jac[: at.J_E] = rng.normal(size=at.J_E)
    jac[at.J_E :] = rng.normal(size=17 * 34)
    return jac


def dense(jac, balls, cv, cx):
    """The same Newton matrix as one dense array."""
    n = 6 * balls + 17
    m = np.eye(n)

    def block(base, rows, columns, lane):
        return np.array(
            [[jac[base + (i * columns + k) * S + lane] for k in range(columns)] for i in range(rows)]
        )

    border = slice(6 * balls, n)
    for j in range(balls):
        own = slice(6 * j, 6 * j + 6)
        b, c, d = block(at.J_B, 6, 9, j), block(at.J_C, 6, 34, j), block(at.J_D, 17, 9, j)
        m[own, own] -= cv * b[:, 3:]
        m[own, 6 * j : 6 * j + 3] -= cx * b[:, :3]
        m[own, border] = -cv * c[:, 17:] - cx * c[:, :17]
        m[border, own] = -cv * d[:, 3:]
        m[border, 6 * j : 6 * j + 3] -= cx * d[:, :3]
    e = jac[at.J_E :].reshape(17, 34)
    m[border, border] -= cv * e[:, 17:] + cx * e[:, :17]
    return m


def test_block_arrow_solves_the_dense_system():
    rng = np.random.default_rng(3)
    balls, lanes = 11, 12
    p = np.zeros(at.P_TABLES)
    p[at.P_BALLS], p[at.P_LANES] = balls, lanes
    jac = random_blocks(rng, p, lanes, balls)
    cv, cx = 0.03, 0.01
    fac, w = np.zeros(at.A_SIZE), np.zeros(at.W_SOUND)
    assert block_arrow.factor(p, jac, cv, cx, cx, fac, w)
    d = np.zeros(at.F_SIZE)
    rows = rng.normal(size=(6, balls))
    for i in range(6):
        d[i * S : i * S + balls] = rows[i]
    d[at.F_G : at.F_G + 17] = rng.normal(size=17)
    right = np.concatenate([rows.T.ravel(), d[at.F_G : at.F_G + 17]])
    expected = np.linalg.solve(dense(jac, balls, cv, cx), right)
    block_arrow.solve(p, fac, 0.0, d, w)
    got = np.concatenate(
        [np.array([d[i * S : i * S + balls] for i in range(6)]).T.ravel(), d[at.F_G : at.F_G + 17]]
    )
    np.testing.assert_allclose(got, expected, rtol=1e-10, atol=1e-12)


def test_tableau_meets_the_order_conditions():
    a = np.zeros((6, 6))
    a[:, :5] = esdirk.A.reshape(6, 5)
    a += np.diag([0] + [esdirk.GAMMA] * 5)
    c = a.sum(1)
    np.testing.assert_allclose(c, esdirk.NODES, atol=1e-14)
    np.testing.assert_allclose(a[5], esdirk.B, atol=1e-14)  # stiffly accurate
    for weights, order in ((esdirk.B, 4), (esdirk.B_LOW, 3)):
        conditions = [
            (weights.sum(), 1),
            (weights @ c, 1 / 2),
            (weights @ c**2, 1 / 3),
            (weights @ a @ c, 1 / 6),
        ]
        if order == 4:
            conditions += [
                (weights @ c**3, 1 / 4),
                ((weights * c) @ a @ c, 1 / 8),
                (weights @ a @ c**2, 1 / 12),
                (weights @ a @ a @ c, 1 / 24),
            ]
        for got, want in conditions:
            assert got == pytest.approx(want, abs=1e-13)
