"""Complex numbers in flat arrays against NumPy's."""

import cmath

import numpy as np
import pytest

from fmu_bearing.engine.complex_numbers import complex_at, over, root
from fmu_bearing.engine.jit import kernel


@kernel
def _doubled(x, at, count):
    z = complex_at(x, at, count)
    for i in range(count):
        z[i] *= 1j
    return z[count - 1]


def test_a_view_writes_where_it_is():
    x = np.arange(10.0)
    assert _doubled(x, 3, 2) == -6 + 5j
    assert x.tolist() == [0, 1, 2, -4, 3, -6, 5, 7, 8, 9]


@pytest.mark.parametrize("z", [0j, 4 + 0j, -4 + 0j, complex(-4.0, -0.0), -3 - 4j, 1e-200j, 1e150 + 1j])
def test_roots_are_the_principal_ones(z):
    assert root(z) == pytest.approx(cmath.sqrt(z), rel=4e-16, abs=0.0)


def test_a_quotient():
    assert over(3 - 1j, 2 + 5j) == pytest.approx((3 - 1j) / (2 + 5j), rel=1e-15)
