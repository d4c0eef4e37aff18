"""Half-space contact with any gap: against integrals, Hertz, Boussinesq's punch and its own energy."""

import math

import numpy as np
import pytest
from scipy.integrate import dblquad
from scipy.ndimage import label

from fmu_bearing.formulas.half_space import grid, love, solve
from fmu_bearing.formulas.hertz import effective_modulus, point_contact

MODULUS = effective_modulus(208e9, 0.3, 208e9, 0.3)
# outer race of a 6205 under 180 N, and a ball on a flat
OUTER, BALL = (4.7774e-3, 70.137e-3, 3.87e-6), (4e-3, 4e-3, 1e-6)


def cells(radius_x, radius_y, approach, shape=(80, 120)):
    """Middles of cells over all that two smooth bodies overlap, widths, and their gap."""
    sides = [1.05 * math.sqrt(2.0 * radius * approach) for radius in (radius_x, radius_y)]
    dx, dy = (2.0 * side / number for side, number in zip(sides, shape, strict=True))
    x = (dx * (np.arange(shape[0]) + 0.5) - sides[0])[:, None]
    y = (dy * (np.arange(shape[1]) + 0.5) - sides[1])[None, :]
    return x, y, grid(*shape, dx, dy, MODULUS), x**2 / (2 * radius_x) + y**2 / (2 * radius_y) - approach


@pytest.mark.parametrize("x, y", [(0.0, 3e-3), (2e-3, 0.5e-3), (0.5e-3, 4e-3), (-3e-3, -2e-3)])
def test_influence_of_a_rectangle_is_the_integral_of_one_over_the_distance(x, y):
    dx, dy = 1e-3, 2e-3
    whole, _ = dblquad(
        lambda v, u: 1.0 / math.hypot(x - u, y - v), -dx / 2, dx / 2, -dy / 2, dy / 2, epsabs=1e-12
    )
    found = love(np.array(x), np.array(y), dx, dy, MODULUS)
    assert found == pytest.approx(2.0 / (math.pi * MODULUS) * whole, rel=1e-7)


def test_influence_at_the_middle_of_a_square_is_known():
    # int 1/r over a square of side a about its middle is 4 a asinh 1
    found = love(np.array(0.0), np.array(0.0), 1e-3, 1e-3, MODULUS)
    assert found == pytest.approx(8e-3 * math.asinh(1.0) / (math.pi * MODULUS), rel=1e-12)


def test_displacements_by_transforms_are_the_plain_sum():
    dx, dy, pressure = 2e-6, 5e-6, np.random.default_rng(1).uniform(0.0, 1e9, (7, 10))
    i, j = np.indices(pressure.shape).reshape(2, -1)
    one = love(dx * (i[:, None] - i), dy * (j[:, None] - j), dx, dy, MODULUS)
    found = grid(*pressure.shape, dx, dy, MODULUS).displaced(pressure)
    assert found == pytest.approx((one @ pressure.ravel()).reshape(pressure.shape), rel=1e-12)


@pytest.mark.parametrize("radius_x, radius_y, approach", [OUTER, BALL])
def test_smooth_bodies_are_those_of_hertz(radius_x, radius_y, approach):
    hertz = point_contact(radius_x, radius_y, MODULUS)
    *_, on, gap = cells(radius_x, radius_y, approach)
    found = solve(gap, on)
    load = hertz.stiffness * approach**1.5
    assert found.load == pytest.approx(load, rel=1e-3)
    assert found.energy == pytest.approx(0.4 * load * approach, rel=1e-3)
    assert found.pressure.max() == pytest.approx(hertz.pressure * approach**0.5, rel=5e-3)


@pytest.mark.parametrize("waves", [0.3, 0.6, 1.0, 1.5, 2.0])
def test_small_waves_change_the_load_by_the_contact_filter(waves):
    """By reciprocity sin(u)/u of the amplitude times the contact's stiffness, u half a width times 2 pi/L."""
    radius_x, radius_y, approach = OUTER
    hertz = point_contact(radius_x, radius_y, MODULUS)
    x, _, on, gap = cells(*OUTER, shape=(160, 160))  # half as wide cells as elsewhere are 1e-3 off at most
    amplitude = 1e-3 * approach
    height = amplitude * np.cos(waves / (hertz.half_width * approach**0.5) * x)
    high, low = (solve(gap - sign * height, on, tolerance=1e-7).load for sign in (1.0, -1.0))
    stiffness = 1.5 * hertz.stiffness * approach**0.5
    assert (high - low) / (2.0 * amplitude * stiffness) == pytest.approx(math.sin(waves) / waves, abs=2e-3)


def test_flat_round_punch_is_that_of_boussinesq():
    """Load E' a d, pressure in the middle E' d/(2 pi a): Johnson, Contact mechanics (1985), eq. 3.34."""
    radius, approach, number = 1e-3, 1e-6, 160
    width = 2.1 * radius / number
    x = width * (np.arange(number) + 0.5) - 1.05 * radius
    inside = x[:, None] ** 2 + x**2 < radius**2
    found = solve(np.where(inside, -approach, radius), grid(number, number, width, width, MODULUS))
    # the pressure is infinite at the edge, which lies within half a cell
    assert found.load == pytest.approx(MODULUS * radius * approach, rel=0.01)
    middle = MODULUS * approach / (2.0 * math.pi * radius)
    assert found.pressure[number // 2, number // 2] == pytest.approx(middle, rel=0.01)


@pytest.mark.parametrize("parts, pit", [(2, (0.3e-3, 9.0)), (2, (9.0, 0.6e-3)), (4, (0.1e-3, 0.2e-3))])
def test_contact_that_breaks_into_parts_fits_everywhere(parts, pit):
    x, y, on, gap = cells(OUTER[0], OUTER[1], 8e-6)
    cut = (np.abs(x) < pit[0] / 2) & (np.abs(y) < pit[1] / 2)
    if parts == 4:  # a cross
        cut = (np.abs(x) < pit[0] / 2) | (np.abs(y) < pit[1] / 2)
    gap = gap + np.where(cut, 1e-4, 0.0)
    found = solve(gap, on)
    left = gap + on.displaced(found.pressure)
    assert label(found.pressure > 0.0)[1] == parts
    assert (found.pressure >= 0.0).all() and left.min() > -2e-3 * 8e-6
    assert np.sum(found.pressure * np.abs(left)) < 1e-4 * np.sum(found.pressure * np.abs(gap))


def test_load_and_moving_gaps_are_slopes_of_the_energy():
    x, _, on, gap = cells(*OUTER)
    pit = 2e-6 * np.exp(-((x - 0.05e-3) ** 2) / 0.1e-3**2)
    step, tight = 1e-9, 1e-8
    found = solve(gap + pit, on, tolerance=tight)
    energies = [solve(gap + pit - sign * step, on, tolerance=tight).energy for sign in (1.0, -1.0)]
    assert (energies[0] - energies[1]) / (2.0 * step) == pytest.approx(found.load, rel=1e-6)
    energies = [solve(gap + (1.0 + sign * 1e-4) * pit, on, tolerance=tight).energy for sign in (1.0, -1.0)]
    moved = -float(np.sum(found.pressure * pit)) * on.area
    assert (energies[0] - energies[1]) / 2e-4 == pytest.approx(moved, rel=1e-6)


def test_start_from_another_contact_finds_the_same():
    *_, on, gap = cells(*OUTER)
    there = solve(gap, on, tolerance=1e-7)
    again = solve(gap, on, start=there.pressure)
    assert again.steps == 0 and again.load == pytest.approx(there.load, rel=1e-12)
    other = solve(gap, on, start=solve(gap + 1e-6, on).pressure, tolerance=1e-7)
    assert other.load == pytest.approx(there.load, rel=1e-6)


def test_bodies_apart_carry_nothing():
    *_, on, gap = cells(*OUTER)
    found = solve(gap + 4e-6, on)
    assert found.load == found.energy == 0.0 and not found.pressure.any()


def test_errors_say_what_is_wrong():
    *_, on, gap = cells(*OUTER, shape=(20, 20))
    with pytest.raises(ValueError, match=r"gap of \(20, 19\) cells on a grid of \(20, 20\)"):
        solve(gap[:, :-1], on)
    with pytest.raises(ValueError, match="finite"):
        solve(np.where(gap < 0.0, np.nan, gap), on)
    with pytest.raises(ArithmeticError, match="20 x 20 cells, overlap 3.8.* um: no solution after"):
        solve(gap, on, tolerance=0.0)
