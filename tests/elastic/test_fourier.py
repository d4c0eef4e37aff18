"""Fourier finite elements against exact and thin-ring solutions, and their own invariants."""

import dataclasses
import math

import numpy as np
import pytest

from fmu_bearing.elastic.fourier import solid
from fmu_bearing.elastic.modes import family, gyroscopic
from fmu_bearing.elastic.section import FINENESS, INNER, OUTER, grid
from tests.elastic.rings import HOLLOW, RINGS, STEEL, THIN, ring, solid_of

_X, _R, _T = range(3)


@pytest.fixture(scope="module")
def hollow():
    return solid(grid(HOLLOW), STEEL)


@pytest.fixture(scope="module")
def thin():
    return solid(grid(THIN, 6), STEEL)


def field(made, **components):
    """Vector of unknowns from functions of x and r."""
    x, r = made.points[..., 0], made.points[..., 1]
    shape = np.zeros(made.mass.shape[0])
    for index, key in enumerate("xrt"):
        shape[made.nodes[..., index]] = components.get(key, lambda x, r: 0.0 * x)(x, r)
    return shape


def translation(made):
    return field(made, r=lambda x, r: 1.0 + 0.0 * x, t=lambda x, r: -1.0 + 0.0 * x)


def tilt(made):
    return field(made, x=lambda x, r: r, r=lambda x, r: -x, t=lambda x, r: x)


def test_torsion_of_a_hollow_cylinder(hollow):
    # half a shear wave over the length
    exact = math.sqrt(STEEL.shear_modulus / STEEL.density) / (2.0 * HOLLOW.width)
    assert exact == pytest.approx(160128.15, rel=1e-7)
    frequencies, shapes = hollow.modes(0, 8)
    torsion = [
        f for f, s in zip(frequencies, shapes.T, strict=True) if f and family(hollow, 0, s) == "torsion"
    ]
    assert torsion[0] == pytest.approx(exact, rel=1e-5)


def bending(order, torsional):
    """Thin ring (Love 1927, section 293), Hz; ``torsional``: 1 in plane, EI/GJ out of plane."""
    n = order
    speed = math.sqrt(STEEL.youngs_modulus / STEEL.density)
    stretch = math.sqrt(1e-6 / 12.0) / 0.05**2  # radius of gyration of the square over the ring's squared
    return speed * stretch * n * (n**2 - 1) / math.sqrt(n**2 + torsional) / (2.0 * math.pi)


@pytest.mark.parametrize(
    ("order", "inside", "outside"), [(2, 254.65, 241.89), (3, 720.25, 701.5), (4, 1381.0, 1359.6)]
)
def test_thin_ring(thin, order, inside, outside):
    # torsion constant of a square: 0.1406 side^4 (Timoshenko and Goodier 1970, section 109)
    ratio = 2.0 * (1.0 + STEEL.poisson_ratio) / 12.0 / 0.1406
    expected = {"in-plane": bending(order, 1.0), "out-of-plane": bending(order, ratio)}
    assert list(expected.values()) == pytest.approx([inside, outside], rel=2e-4)
    frequencies, shapes = thin.modes(order, 4)
    found = {family(thin, order, shapes[:, i]): frequencies[i] for i in (1, 0)}
    assert found == pytest.approx(expected, rel=2e-3)  # thickness over radius squared, and shear


@pytest.mark.parametrize("order", [2, 3, 4, 8])
def test_gyroscopic_integral_of_a_thin_ring(thin, order):
    # without stretching psi_t = -psi_r / n (Bryan 1890), hence g = -2 n / (n^2 + 1); thickness/radius is 0.02
    frequencies, shapes = thin.modes(order, 4)
    pick = next(i for i in range(4) if family(thin, order, shapes[:, i]) == "in-plane")
    assert gyroscopic(thin, shapes[:, pick]) == pytest.approx(-2.0 * order / (order**2 + 1.0), abs=2e-3)


def test_rigid_motion_is_free_and_turns_as_rigid_bodies_do(hollow):
    stiffness = hollow.stiffness(1)
    size = abs(stiffness).max()
    for motion in (translation(hollow), tilt(hollow)):
        assert np.abs(stiffness @ motion).max() < 1e-12 * size * np.abs(motion).max()
    assert gyroscopic(hollow, translation(hollow)) == pytest.approx(-1.0, abs=1e-13)
    inner, outer, width = HOLLOW.low, HOLLOW.high, HOLLOW.width
    polar = (inner**2 + outer**2) / 2.0
    transverse = polar / 2.0 + width**2 / 12.0
    assert 2.0 * (1.0 + gyroscopic(hollow, tilt(hollow))) == pytest.approx(polar / transverse, rel=1e-12)
    mass = STEEL.density * math.pi * (outer**2 - inner**2) * width
    assert math.pi * translation(hollow) @ hollow.mass @ translation(hollow) == pytest.approx(mass, rel=1e-12)
    assert math.pi * tilt(hollow) @ hollow.mass @ tilt(hollow) == pytest.approx(mass * transverse, rel=1e-12)


@pytest.mark.parametrize(("name", "body"), RINGS)
def test_rigid_motion_of_grooved_rings(name, body):
    section, material = ring(name, body)
    made = solid_of(name, body)
    # axial motion and spin, translation and tilt; bending from two waves on
    assert [int(np.sum(made.modes(order, 6)[0] == 0.0)) for order in range(5)] == [2, 2, 0, 0, 0]
    assert gyroscopic(made, translation(made)) == pytest.approx(-1.0, abs=1e-13)
    # the sides of the elements follow the circle to third order
    mass = math.pi * translation(made) @ made.mass @ translation(made)
    assert mass == pytest.approx(2.0 * math.pi * material.density * section.moment, rel=1e-5)


@pytest.mark.parametrize("order", [0, 1, 2, 5])
def test_modes_are_orthogonal(hollow, order):
    frequencies, shapes = hollow.modes(order, 8)
    assert shapes.T @ hollow.mass @ shapes == pytest.approx(np.eye(8), abs=1e-9)
    squares = (2.0 * np.pi * frequencies) ** 2
    stiffness = shapes.T @ hollow.stiffness(order) @ shapes
    assert stiffness == pytest.approx(np.diag(squares), abs=1e-9 * squares.max())


def test_matrices_are_symmetric(hollow):
    for matrix in (hollow.k0, hollow.k1, hollow.k2, hollow.mass, hollow.coriolis):
        assert abs(matrix - matrix.T).max() <= 1e-14 * abs(matrix).max()


def test_same_input_same_bits(hollow):
    first, second = (hollow.modes(3, 6) for _ in range(2))
    assert np.array_equal(first[0], second[0]) and np.array_equal(first[1], second[1])


@pytest.mark.parametrize("body", [INNER, OUTER])
def test_frequencies_converge_from_above(body):
    meshes = [solid_of("7003C-bare", body, fineness) for fineness in (8, FINENESS, 28)]
    for order in (2, 3, 4):
        coarse, usual, fine = (mesh.modes(order, 2)[0] for mesh in meshes)
        below = fine < 60e3
        assert np.all(coarse > usual) and np.all(usual > fine)  # Rayleigh: a stiffer approximation
        assert usual[below] == pytest.approx(fine[below], rel=1e-4)


def test_frequencies_scale_with_size_and_material():
    section = dataclasses.replace(HOLLOW, low=2 * HOLLOW.low, high=2 * HOLLOW.high, width=2 * HOLLOW.width)
    soft = dataclasses.replace(STEEL, youngs_modulus=STEEL.youngs_modulus / 4.0)
    half = solid(grid(HOLLOW, 4), soft).modes(2, 3)[0]
    assert half == pytest.approx(solid(grid(HOLLOW, 4), STEEL).modes(2, 3)[0] / 2.0, rel=1e-10)
    assert half == pytest.approx(solid(grid(section, 4), STEEL).modes(2, 3)[0], rel=1e-10)
