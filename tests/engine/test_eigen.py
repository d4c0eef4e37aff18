"""Eigenvalues and eigenvectors of small complex matrices, against NumPy."""

import numpy as np
import pytest

from fmu_bearing.engine.eigen import eigen


def solved(matrix):
    """Eigenvalues and eigenvectors by the kernel."""
    n = len(matrix)
    found, vectors = np.zeros((2, n, n), complex), np.zeros((n, n), complex)
    found[0] = matrix
    assert eigen(found.ravel(), np.zeros(n * n, complex), vectors.ravel(), n)
    return found[0].diagonal(), vectors


@pytest.mark.parametrize("seed", range(40))
def test_each_vector_is_one_of_the_matrix(seed):
    random = np.random.default_rng(seed)
    n = int(random.integers(1, 14))
    matrix = random.standard_normal((n, n)) + 1j * random.standard_normal((n, n)) * (seed % 2)
    values, vectors = solved(matrix)
    # backward stable: some n times rounding
    assert np.abs(matrix @ vectors - vectors * values).max() < 1e-13 * np.linalg.norm(matrix)
    np.testing.assert_allclose(np.linalg.norm(vectors, axis=0), 1.0, rtol=1e-12)
    assert np.sum(values) == pytest.approx(np.trace(matrix), rel=1e-12, abs=1e-12)


def test_values_of_very_different_size():
    """Friction and a free place: 3e7 and 0 1/s in one matrix."""
    matrix = np.array([[0.0, 1.0, 0.0], [0.0, -1e-7, 0.0], [0.3, 0.2, -300.0]], dtype=complex)
    values, _ = solved(matrix)
    np.testing.assert_allclose(sorted(values.real), [-300.0, -1e-7, 0.0], rtol=1e-6, atol=1e-13)


def test_equal_values_without_coupling():
    values, vectors = solved(np.diag([2.0, 2.0, 5.0]).astype(complex))
    assert sorted(values.real) == [2.0, 2.0, 5.0]
    assert abs(np.linalg.det(vectors)) == pytest.approx(1.0)
