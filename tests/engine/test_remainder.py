"""Rest of the boundary elements' kernel, four azimuths at a time, against one at a time with libm's sine."""

import numpy as np
import pytest

from fmu_bearing.acoustics.radiation.bem.integrals import _azimuths, _basis, _gauss
from fmu_bearing.acoustics.radiation.bem.meridian import cylinder, mesh_of, ring
from fmu_bearing.compiled.load import call
from fmu_bearing.engine.boundary_elements.remainder import ROWS, terms
from tests.engine import ahead
from tests.oracles import bem_remainder

#: Rings half a millimetre apart, a shaft that reaches the axis: elements side by side and on one corner.
BODIES = [
    ring("outer", 1, 0.035, 0.0296, -0.005, 0.005),
    ring("cage", 2, 0.0286, 0.0234, -0.0045, 0.0045),
    cylinder("inner", 0, 0.0226, -0.005, 0.005),
]
MESH = mesh_of(BODIES, 0.004)


def both(points, own, k, orders, turns):
    """Return the fast and the slow answer, shape (2, orders, points, elements * 2)."""
    rule = _gauss(3)
    basis = _basis(rule[0])
    fast, slow = (np.zeros((2, orders, len(points), 2 * len(MESH.ends)), dtype=complex) for _ in range(2))
    less, weights = _azimuths(orders, turns)
    given = (points, own.astype(float), MESH.ends, MESH.normals, rule, basis, less, weights)
    call("remainder", *given, np.zeros(ROWS * len(less)), fast.view(float), k)
    cosines = np.cos(np.arange(max(orders, 2))[:, None] * np.pi * np.arange(turns + 1) / turns)
    bem_remainder.remainder(points, own, MESH.ends, MESH.normals, rule, basis, cosines, k, slow)
    return fast, slow


@pytest.mark.heavy
@pytest.mark.parametrize("turns", [11, 23, 24, 60])  # full rows of four, and rows that are filled up
@pytest.mark.parametrize(
    ("k", "allowed"), [(0.37, 1e-12), (20.0, 1e-13), (110.0, 1e-13), (406.0, 1e-13), (4000.0, 1e-13)]
)
@pytest.mark.parametrize("orders", [1, 9])
def test_rows_of_azimuths_give_the_slow_answer(k, allowed, turns, orders):
    """1e-13 of the largest entry of each layer: the sums have up to 60 terms of 1e-16 each.

    At 20 Hz (0.37 1/m) the rest is 1e-7 of the matrix, and what k (z - sin z) loses is not the sine's error.

    Points on the elements, in the air, on the axis and a micrometre off an element; 4000 1/m is ten times
    the highest wavenumber in use.
    """
    near = MESH.points[::5] + 1e-6 * MESH.node_normals()[::5]
    air = np.array([[0.0, 0.105], [-0.08, 1e-9], [0.5, 0.7]])
    points = np.concatenate([MESH.points, near, air])
    own = np.full(len(points), -1)
    own[: MESH.size] = np.repeat(np.arange(len(MESH.ends)), 2)
    fast, slow = both(points, own, k, orders, turns)
    assert np.isfinite(fast).all()
    for layer in range(2):
        largest = np.abs(slow[layer]).max()
        assert largest > 0.0
        assert np.abs(fast[layer] - slow[layer]).max() < allowed * largest


def filled(k, a2, twice, less, normal, lift):
    """Four rows of the remainder at azimuths, one behind the other."""
    rows = np.zeros(ROWS * len(less))
    terms(k, a2, twice, normal, lift, less, rows)
    return rows.reshape(ROWS, -1)


def test_sine_and_cosine_over_all_quarters():
    """At distances of 1 m and beyond, k R up to 2000: 2e-16 for sine and cosine, and z to rounding."""
    count = 40_000
    less = np.linspace(0.0, 4e6, count)  # (k R)^2 for a2 = 0, 2 r r' = 1
    rows = filled(1.0, 0.0, 1.0, less, 0.0, 0.0)
    z = np.sqrt(less)
    sine = -rows[1] * z  # of the imaginary part, sin(z) / R
    ordinary = z > 0.02
    # the product with z and back rounds twice
    assert np.abs(sine - np.sin(z))[ordinary].max() < 5e-16
    cosine = rows[0] * z - 0.5 * z * z + 1.0
    assert np.abs(cosine - np.cos(z))[ordinary & (z < 20.0)].max() < 1e-13
    far = z > 20.0
    exact = np.cos(z[far]) - 1.0 + 0.5 * z[far] ** 2
    assert np.abs(rows[0][far] * z[far] / exact - 1.0).max() < 1e-15


def test_no_distance_at_all():
    """A point that meets a source: finite, as in the slow version."""
    rows = filled(100.0, 0.0, 1e-4, np.zeros(8), 0.0, 1e-3)
    assert rows[0] == pytest.approx(0.0)
    assert rows[1] == pytest.approx(-100.0)
    assert rows[2:] == pytest.approx(0.0)


@pytest.mark.heavy
def test_four_azimuths_are_vector_code_on_every_processor():
    """26 multiplications of sine and cosine and 20 around them; four sums have another four."""
    found = ahead.assembly("fmu_bearing.engine.boundary_elements.remainder", "terms", "ddddda" + "a")
    assert ahead.count(found["x86-64-v3"], r"vmulpd\s.*ymm") >= 35
    assert ahead.count(found["x86-64-v3"], r"vsqrtpd\s.*ymm")
    assert not ahead.count(found["x86-64-v3"], "vsqrtsd")
