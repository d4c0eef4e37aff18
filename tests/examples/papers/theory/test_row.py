"""Modes of balls in a row: closed forms of rigid balls, and Lamb's modes under a force on a pole.

The ball is that of the three-ball test: 22.2 mm, 195 GPa, 0.3, 7900 kg/m3 (Kuan et al. 2026, table 1).
"""

import dataclasses
import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.special import spherical_jn

from examples.papers.impact.chain import Sphere, hertz_stiffness
from examples.papers.impact.lamb import pole_modes, surface_acceleration, wave_speeds
from examples.papers.impact.row import row_modes

# What only the papers' pages use.
pytestmark = pytest.mark.heavy

BALL = Sphere(11.1e-3, 7900.0, 195e9, 0.3)
PATCH = 0.2e-3
STIFFNESS = 2.0 * 195e9 / (2.0 * (1.0 - 0.3**2)) * PATCH  # 2 E* a
INERTIA = 0.4 * BALL.mass * BALL.radius**2


def test_patch_stiffness_is_the_slope_of_hertz():
    load = 400.0
    k = hertz_stiffness(BALL, BALL)
    closer = (load / k) ** (2.0 / 3.0)
    patch = math.sqrt(BALL.radius / 2.0 * closer)
    chain = row_modes([BALL] * 2, patch, bonded=False)
    slope = 1.5 * k * math.sqrt(closer)
    assert chain.axial == pytest.approx([0.0, math.sqrt(2.0 * slope / BALL.mass) / (2.0 * math.pi)])


@pytest.mark.parametrize("bonded", [False, True])
def test_three_rigid_balls_along_the_line(bonded):
    found = row_modes([BALL] * 3, PATCH, bonded=bonded)
    unit = math.sqrt(STIFFNESS / BALL.mass) / (2.0 * math.pi)
    assert found.axial == pytest.approx([0.0, unit, math.sqrt(3.0) * unit], rel=1e-12)
    assert found.axial[1:] / 1e3 == pytest.approx([4.898, 8.483], abs=5e-4)
    # sliding: one motion along, three turns about the line, three of each plane's displacements and turns
    assert found.zero_modes == (6 if bonded else 1 + 3 + 2 * 6)


def test_two_bonded_balls_turn_and_slide():
    found = row_modes([BALL] * 2, PATCH, bonded=True)
    tangential, spread = 0.82 * STIFFNESS, 4.0 / 3.0 * PATCH**2
    two_pi = 2.0 * math.pi
    twist = math.sqrt(2.0 * tangential * spread / INERTIA) / two_pi
    turn = math.sqrt(2.0 * STIFFNESS * spread / 2.0 / INERTIA) / two_pi
    slide = math.sqrt(tangential * (2.0 / BALL.mass + 2.0 * BALL.radius**2 / INERTIA)) / two_pi
    assert found.twist == pytest.approx([0.0, twist])
    assert found.transverse == pytest.approx([0.0, 0.0, turn, slide])


def test_breathing_moves_the_pole_as_its_integral_says():
    """u = j_1(k r) of order 0: the modal mass is 4 pi rho times the integral of u^2 r^2."""
    frequencies, poles = pole_modes(BALL, 0, 800e3)
    assert len(frequencies) == 3
    for frequency, pole in zip(frequencies, poles, strict=True):
        k = 2.0 * math.pi * frequency / wave_speeds(BALL)[0]
        square, _ = quad(lambda r, k=k: (spherical_jn(1, k * r) * r) ** 2, 0.0, BALL.radius)
        exact = spherical_jn(1, k * BALL.radius) / math.sqrt(4.0 * math.pi * BALL.density * square)
        assert pole == pytest.approx(abs(exact), rel=1e-6)


@pytest.mark.parametrize("order", [0, 2, 5])
def test_modes_add_up_to_the_response_at_rest(order):
    """Sum of poles^2 / w_k^2 beside the displacement of the sphere at 100 Hz; the rest falls as 1/k."""
    highest = 2e6
    frequencies, poles = pole_modes(BALL, order, highest)
    summed = np.sum((poles / (2.0 * np.pi * frequencies)) ** 2)
    omega = 2.0 * math.pi * 100.0
    moved = -surface_acceleration(BALL, order, np.array([100.0]))[0] / omega**2
    exact = moved * (2 * order + 1) / (4.0 * math.pi * BALL.radius**2)
    assert 0.85 * exact < summed < exact  # all terms are positive, the rest is cut off
    assert frequencies.size >= 7


def test_elastic_balls_are_softer_in_proportion_to_what_is_counted():
    """Modes to 500 kHz: 4.69 and 8.16 kHz (independent prototype). A point force sees them all."""
    steps = [row_modes([BALL] * 3, PATCH, bonded=False, highest=h).axial[1:3] for h in (250e3, 500e3)]
    assert steps[1] / 1e3 == pytest.approx([4.69, 8.16], abs=0.005)
    rigid = row_modes([BALL] * 3, PATCH, bonded=False).axial[1:3]
    assert np.all(steps[0] > steps[1]) and np.all(rigid > steps[0])
    # compliance, as 1/f^2, grows with the number of modes under the limit: about as the limit itself
    added = (1.0 / steps[1] ** 2 - 1.0 / rigid**2) / (1.0 / steps[0] ** 2 - 1.0 / rigid**2)
    assert np.all((added > 1.8) & (added < 3.0))


def test_order_of_balls_along_the_row_does_not_matter():
    small = dataclasses.replace(BALL, radius=5e-3)
    one = row_modes([BALL, small, BALL, small], PATCH, bonded=True, highest=150e3)
    other = row_modes([small, BALL, small, BALL], PATCH, bonded=True, highest=150e3)
    for key in ("axial", "twist", "transverse"):
        assert getattr(one, key) == pytest.approx(getattr(other, key), rel=1e-9, abs=1.0)


def test_refusals():
    with pytest.raises(ValueError, match="1 balls do not make a row"):
        row_modes([BALL], PATCH, bonded=True)
    with pytest.raises(ValueError, match="patch radius"):
        row_modes([BALL] * 2, 0.0, bonded=True)
