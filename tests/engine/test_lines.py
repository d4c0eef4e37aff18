"""What makes the lines of fidelity `response`: equations by columns, and the table of the heaviest."""

import numpy as np
import pytest

from fmu_bearing.engine import dense
from fmu_bearing.engine.fidelities.response.strongest_lines import counted, place_for
from fmu_bearing.engine.layout import FOUR, L


@pytest.mark.parametrize("n", [1, 7, 11, 30])
def test_complex_equations_by_columns(n):
    """Against NumPy, with zeros on the diagonal, which need other pivots."""
    rng = np.random.default_rng(n)
    lanes = -(-n // FOUR) * FOUR
    matrix = rng.normal(size=(n, n)) + 1j * rng.normal(size=(n, n))
    if n > 1:
        matrix[np.arange(0, n, 2), np.arange(0, n, 2)] = 0.0
    side = rng.normal(size=n) + 1j * rng.normal(size=n)
    table = np.zeros((n + 1, lanes), complex)
    table[:n, :n], table[n, :n] = matrix.T, side
    re, im = table.real.ravel().copy(), table.imag.ravel().copy()
    assert dense.solve_columns(re, im, n, lanes)
    found = (re + 1j * im)[n * lanes :]
    exact = np.linalg.solve(matrix, side)
    np.testing.assert_allclose(
        found[:n], exact, rtol=0, atol=1e-12 * np.linalg.cond(matrix) * np.abs(exact).max()
    )
    assert not found[n:].any()


def test_singular_equations_have_no_answer():
    re, im = np.zeros(3 * FOUR), np.zeros(3 * FOUR)
    re[[0, 1, FOUR, FOUR + 1]] = 1.0, 2.0, 2.0, 4.0
    assert not dense.solve_columns(re, im, 2, FOUR)


@pytest.mark.parametrize("order", ["random", "rising", "falling"])
def test_the_heaviest_lines_are_kept(order):
    """Of 1,000 weights in any order the table of 37 keeps the 37 largest."""
    most, size = 37, L.LINE_SIZE
    weights = np.random.default_rng(5).permutation(np.geomspace(1e-9, 1.0, 1000))
    if order != "random":
        weights = np.sort(weights)[:: 1 if order == "rising" else -1]
    lines, count = np.zeros(most * size), 0
    for weight in weights:
        into = place_for(lines, size, count, most, weight)
        if into >= 0:
            lines[into * size + L.LINE_WEIGHT] = weight
            count = counted(lines, size, count, most)
    assert count == most
    assert sorted(lines[L.LINE_WEIGHT :: size]) == sorted(weights)[-most:]
    assert place_for(lines, size, count, most, np.nan) == -1


def test_a_line_without_a_number_for_its_weight_is_left_out():
    assert place_for(np.zeros(L.LINE_SIZE), L.LINE_SIZE, 0, 1, np.inf) == -1
