"""Harmonics of 1/R and R between rings, against arbitrary-precision Legendre functions and quadrature."""

import math

import mpmath
import numpy as np
import pytest

from fmu_bearing.engine.boundary_elements.ring_potential import elliptic, static_harmonics, toroidal

EXCESSES = (1e-9, 1e-4, 0.05, 0.099, 0.101, 1.0, 30.0, 3e3)


def harmonics(dx, r, s, nx, ns, flat, orders):
    """Harmonics of 1/R, of its derivative, of R and of its derivative, shape (4, orders)."""
    work = np.zeros(5 * (orders + 2))
    static_harmonics(dx, r, s, nx, ns, flat, orders, work)
    return work.reshape(5, -1)[1:, :orders]


@pytest.mark.parametrize("excess", EXCESSES)
def test_toroidal_functions(excess):
    q = np.zeros(10)
    toroidal(excess, 9, q)
    with mpmath.workdps(40):
        chi = 1 + mpmath.mpf(excess)
        for m in range(10):
            # Abramowitz and Stegun 8.13: Q_{m-1/2}(chi) = integral of cos(m t) / sqrt(2 chi - 2 cos t), 0..pi
            exact = mpmath.legenq(m - mpmath.mpf(1) / 2, 0, chi, type=3).real
            assert abs(q[m] / exact - 1) < 1e-11


@pytest.mark.parametrize("complement", [1e-16, 1e-6, 0.3, 1.0])
def test_elliptic_integrals(complement):
    k, e = elliptic(complement)
    with mpmath.workdps(40):
        parameter = 1 - mpmath.mpf(complement)
        assert abs(k / mpmath.ellipk(parameter) - 1) < 1e-14
        assert abs(e / mpmath.ellipe(parameter) - 1) < 1e-14


@pytest.mark.parametrize(("dx", "r", "s"), [(0.001, 0.0175, 0.017), (0.02, 0.05, 0.03), (-0.08, 0.105, 0.02)])
def test_harmonics_against_the_integral(dx, r, s):
    orders = 9
    nx, ns = 0.6, -0.8
    found = harmonics(dx, r, s, nx, ns, False, orders)
    phi = 2.0 * math.pi * np.arange(4096) / 4096  # exact: the nearest approach is 1 mm at 17 mm radius
    distance = np.sqrt(dx**2 + (s - r) ** 2 + 2.0 * r * s * (1.0 - np.cos(phi)))
    along = (nx * dx + ns * (s - r * np.cos(phi))) / distance
    for values, integrand in zip(found, (1.0 / distance, -along / distance**2, distance, along), strict=True):
        exact = np.cos(np.arange(orders)[:, None] * phi) @ integrand * 2.0 * math.pi / len(phi)
        assert np.abs(values - exact).max() < 1e-11 * np.abs(exact).max()


def test_a_point_on_its_own_element_has_no_normal_distance():
    """The double layer of a straight element on itself stays finite: only curvature acts."""
    orders = 2
    found = harmonics(1e-9, 0.02, 0.02, 0.0, 1.0, True, orders)
    # A^2 times the harmonic of 1/R^3 tends to 2 / r
    assert found[1][0] == pytest.approx(-0.5 / 0.02 * (found[0][0] - 2.0 / 0.02), rel=1e-6)
