"""Modes of balls and cage stepped in time: weights of a step against quadrature, and a driven mode."""

import numpy as np
import pytest
from scipy.integrate import quad

from fmu_bearing.engine.fidelities.condensed.phi import moments, weigh


@pytest.mark.parametrize(
    "x", [0.0, 1e-9, -0.3 + 0.2j, 1.9j, -2.1 + 0.1j, -40.0 + 3.0j, 18.0j - 4.0, -3e3 + 0j]
)
def test_moments_are_integrals_over_a_step(x):
    """exp(x), then the integrals of exp(x (1 - s)) s^m, m = 0 .. 4."""
    found = np.zeros(6, complex)
    moments(complex(x), found)
    assert found[0] == pytest.approx(np.exp(x), rel=1e-12, abs=1e-300)
    for m in range(5):
        # what stiff modes feel lies at the end of the step
        begin = max(0.0, 1.0 - 60.0 / max(abs(np.real(x)), 1e-9))
        exact = sum(
            unit * quad(lambda s, m=m, part=part: part(np.exp(x * (1 - s)) * s**m), begin, 1.0, limit=400)[0]
            for unit, part in ((1.0, np.real), (1j, np.imag))
        )
        assert found[1 + m] == pytest.approx(exact, rel=1e-8)


@pytest.mark.parametrize(
    ("known", "stiff", "degree"), [(0.0, False, 1), (2.0, False, 2), (4.0, True, 2), (4.0, False, 4)]
)
def test_weights_are_exact_for_polynomials(known, stiff, degree):
    """The drive at the end, now and at three steps before, for a mode that keeps what it gets."""
    ones = [1.0 / (m + 1) for m in range(5)]  # moments of a mode at rest
    weights = np.array(weigh(*ones, known, stiff))
    nodes = np.array([1.0, 0.0, -1.0, -2.0, -3.0])
    for power in range(degree + 1):
        assert weights @ nodes**power == pytest.approx(1.0 / (power + 1), rel=1e-13)
