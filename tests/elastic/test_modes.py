"""Modes of a scene's rings: frequencies, masses, shapes at groove, seat and skin."""

import dataclasses
import math

import numpy as np
import pytest

from examples.papers.assembly.free import free_modes
from fmu_bearing.elastic.modes import elastic, in_plane_mode, ring_modes
from fmu_bearing.elastic.section import INNER, OUTER, Section
from tests.elastic.rings import RINGS, STEEL, THIN, bent, curved_beam, ring, solid_of

_X, _R, _T = range(3)
BOTH = "outer_ring = [2, 3, 4, 5]\ninner_ring = [2, 3]"

# Free rings, kHz: in-plane 2, 3, 4; out-of-plane 2; roll, breathing; coordinates below 25 and 60 kHz. From an
# independent Fourier finite-element prototype whose shoulders differ a little (1 % covers all of it).
PROTOTYPE = {
    ("7003C-bare", OUTER): (6.62, 18.40, 34.4, 11.86, 49.5, 51.0, 6, 20),
    ("7003C-bare", INNER): (18.03, 48.3, 86.5, 25.1, 79.7, 83.1, 2, 6),
    ("7009C-full-ceramic", OUTER): (2.84, 7.94, 14.96, 5.14, 26.0, 26.8, 12, 40),
    ("7009C-full-ceramic", INNER): (5.64, 15.5, 28.5, 8.12, 36.1, 38.0, 8, 26),
}


@pytest.fixture(scope="module")
def modes():
    return ring_modes(bent("7009C-full-ceramic", BOTH))


@pytest.mark.parametrize(("name", "body"), RINGS)
def test_free_rings_beside_the_prototype(name, body):
    *expected, below_25, below_60 = PROTOTYPE[name, body]
    found = free_modes(*ring(name, body), 90e3)

    def lowest(order, family):
        return next(mode.frequency for mode in found if (mode.order, mode.family) == (order, family)) / 1e3

    table = [lowest(order, "in-plane") for order in (2, 3, 4)]
    table += [lowest(2, "out-of-plane"), lowest(0, "roll"), lowest(0, "breathing")]
    assert table == pytest.approx(expected, rel=0.0105)
    for limit, count in ((25e3, below_25), (60e3, below_60)):
        # two coordinates per family of order 1 and above, one of order 0
        assert sum(2 if mode.order else 1 for mode in found if 0.0 < mode.frequency <= limit) == count
    assert sum(2 if mode.order else 1 for mode in found if mode.family == "rigid") == 6


@pytest.mark.parametrize(("name", "body"), RINGS)
@pytest.mark.parametrize("order", [2, 3, 4])
def test_a_curved_beam_is_near(name, body, order):
    section, material = ring(name, body)
    # the beam has no warping, its depth is not small beside its radius, its groove only thins it
    assert in_plane_mode(section, material, order).frequency == pytest.approx(
        curved_beam(section, material, order), rel=0.04
    )


def test_order_of_the_modes_is_that_of_the_coordinates(modes):
    assert [(mode.body, mode.order) for mode in modes] == [(0, 2), (0, 3), (1, 2), (1, 3), (1, 4), (1, 5)]
    assert {mode.family for mode in modes} == {"in-plane"}
    assert all(mode.groove[_R] == 1.0 for mode in modes)


def test_scene_without_flexure_has_no_modes(scene):
    assert ring_modes(scene("7003C-bare")) == ()
    assert ring_modes(bent("7003C-bare", "")) == ()


def test_modes_are_computed_once_and_stay_as_they_are(modes):
    again = ring_modes(bent("7009C-full-ceramic", BOTH + "\ndamping_ratio = 0.01"))
    assert all(first is second for first, second in zip(modes, again, strict=True))
    with pytest.raises(ValueError, match="read-only"):
        again[0].skin_shape[0, 0] = 1.0


def test_material_of_the_ring_counts():
    scene = bent("7003C-bare", "outer_ring = [2]\ninner_ring = [2]")
    soft = dataclasses.replace(STEEL, youngs_modulus=52e9)
    outer = ring("7003C-bare", OUTER)[0]
    assert elastic(scene.materials.outer_ring) == STEEL
    assert in_plane_mode(outer, soft, 2).frequency == pytest.approx(
        in_plane_mode(outer, STEEL, 2).frequency / 2.0, rel=1e-9
    )


@pytest.mark.parametrize(("name", "body"), RINGS)
@pytest.mark.parametrize("order", [2, 5])
def test_modal_mass_and_g_by_another_quadrature(name, body, order):
    """Simpson's rule over the mapped grid, with its own shape: the assembly has no part in it."""
    mode = in_plane_mode(*ring(name, body), order)
    made = solid_of(name, body)
    frequencies, shapes = made.modes(order, 6)
    shape = shapes[:, np.abs(frequencies - mode.frequency).argmin()]
    shape = shape / shape[made.nodes[made.grid.contact, made.grid.race_row, _R]]
    psi, points = shape[made.nodes], made.points
    density = made.material.density * points[..., 1]
    mass = math.pi * simpson(density * np.sum(psi**2, axis=2), points)
    turned = math.pi * simpson(2.0 * density * psi[..., _R] * psi[..., _T], points)
    assert mode.modal_mass == pytest.approx(mass, rel=2e-4)
    assert mode.gyroscopic == pytest.approx(turned / mass, rel=2e-4)


def simpson(values, points):
    """Integral over the section of values at (half column, half row)."""
    weights = np.array([1.0, 4.0, 1.0]) / 6.0
    # derivative of the quadratic through three nodes one apart by 1/2, at these nodes
    slope = np.array([[-3.0, 4.0, -1.0], [-1.0, 0.0, 1.0], [1.0, -4.0, 3.0]])
    total = 0.0
    for i in range(0, len(values) - 1, 2):
        for j in range(0, values.shape[1] - 1, 2):
            cell = points[i : i + 3, j : j + 3]
            along = np.einsum("ab,bcd->acd", slope, cell)
            across = np.einsum("cb,abd->acd", slope, cell)
            area = along[..., 0] * across[..., 1] - along[..., 1] * across[..., 0]
            total += weights @ (area * values[i : i + 3, j : j + 3]) @ weights
    return total


@pytest.mark.parametrize("order", [2, 3, 4])
def test_modal_mass_of_a_thin_ring(order):
    mode = in_plane_mode(THIN, STEEL, order, 6)
    # psi_t = -psi_r / n; thickness/radius is 0.02
    mass = math.pi * STEEL.density * 1e-6 * 0.05 * (1.0 + 1.0 / order**2)
    assert mode.modal_mass == pytest.approx(mass, rel=1e-2)
    # on the inner side, half the thickness off, the turn of the section adds to it
    inside = -1.0 / order - 0.01 * (order - 1.0 / order)
    assert mode.groove[_T] == pytest.approx(inside, abs=2e-3)
    assert mode.seat == pytest.approx(1.0, abs=1e-3)
    # a square section sees the groove mid-race: nothing tilts there
    assert mode.groove[_X] == pytest.approx(0.0, abs=1e-6)
    assert mode.groove_tilt == pytest.approx(0.0, abs=1e-4)  # beside n / R = 40 to 80 rad per m


def test_seat_is_the_mean_square_on_the_skin(modes):
    for mode in modes:
        x, r = mode.skin_points.T
        seat = r.min() if mode.body == INNER else r.max()
        on = np.abs(r - seat) < 1e-12
        order = np.argsort(x[on])
        across, radial = x[on][order], mode.skin_shape[on, _R][order]
        across, first = np.unique(across, return_index=True)
        mean = np.trapezoid(radial[first] ** 2, across) / (across[-1] - across[0])
        assert mode.seat == pytest.approx(mean, rel=1e-4)


def test_skin_is_a_closed_contour_that_turns_left(modes):
    for mode in modes:
        section, _ = ring("7009C-full-ceramic", mode.body)
        points = mode.skin_points
        assert points.shape[1] == 2 and mode.skin_shape.shape == (len(points), 3)
        assert np.array_equal(points[0], points[-1])
        assert np.array_equal(mode.skin_shape[0], mode.skin_shape[-1])
        assert points[0] == pytest.approx([-section.width / 2.0, section.low])
        steps = np.linalg.norm(np.diff(points, axis=0), axis=1)
        assert 0.05e-3 < steps.min() and steps.max() <= 0.3e-3
        # volume per radian by Gauss's theorem: positive if the contour turns left
        x, r = points.T
        dx, middle = np.diff(x), (r[1:] ** 2 + r[1:] * r[:-1] + r[:-1] ** 2) / 3.0
        assert -np.sum(dx * middle) / 2.0 == pytest.approx(section.moment, rel=3e-4)  # chords
        # the groove is on it, and moves as the mode says
        nearest = np.linalg.norm(points - section.contact, axis=1)
        assert nearest.min() < 1e-12
        assert mode.skin_shape[nearest.argmin()] == pytest.approx(mode.groove, abs=1e-12)


def test_groove_tilt_is_the_turn_of_the_surface_there(modes):
    for mode in modes:
        section, _ = ring("7009C-full-ceramic", mode.body)
        here = np.linalg.norm(mode.skin_points - section.contact, axis=1).argmin()
        near = slice(here - 5, here + 6)
        along = np.concatenate(
            ([0.0], np.linalg.norm(np.diff(mode.skin_points[near], axis=0), axis=1).cumsum())
        )
        tangent = mode.skin_points[here + 1] - mode.skin_points[here - 1]
        tangent /= np.linalg.norm(tangent)
        # across the surface, to its left: the turn is the slope of this motion, less the arc's own bend
        across = np.polyfit(along, mode.skin_shape[near, :2] @ [-tangent[1], tangent[0]], 2)
        turn = np.polyval(np.polyder(across), along[5])
        assert mode.groove_tilt == pytest.approx(turn, rel=0.05)  # 5 points to each side beside 15 degrees


def test_mirrored_groove_gives_the_mirrored_mode(modes):
    section, material = ring("7009C-full-ceramic", OUTER)
    groove = dataclasses.replace(section.groove, x=-section.groove.x, angle=-section.groove.angle)
    mirrored = in_plane_mode(dataclasses.replace(section, groove=groove), material, 2)
    mode = modes[2]
    for key in ("frequency", "modal_mass", "gyroscopic", "seat"):
        assert getattr(mirrored, key) == pytest.approx(getattr(mode, key), rel=1e-7)
    assert mirrored.groove == pytest.approx(mode.groove * [-1, 1, 1], rel=1e-6)
    assert mirrored.groove_tilt == pytest.approx(-mode.groove_tilt, rel=1e-6)


def test_symmetric_groove_keeps_the_plane():
    section, material = ring("7003C-bare", INNER)
    groove = dataclasses.replace(section.groove, x=0.0, angle=0.0)
    mode = in_plane_mode(dataclasses.replace(section, groove=groove), material, 3)
    assert mode.groove[_X] == pytest.approx(0.0, abs=1e-8)
    assert mode.groove_tilt == pytest.approx(0.0, abs=1e-5)  # beside 4 rad per m at the contact angle


def test_in_plane_is_picked_where_it_is_not_the_lowest():
    washer = Section(OUTER, 0.045, 0.055, 0.002)  # bends out of its plane five times more easily
    found = free_modes(washer, STEEL, 5e3)
    lowest = next(mode for mode in found if mode.order == 2)
    mode = in_plane_mode(washer, STEEL, 2)
    assert lowest.family == "out-of-plane"
    assert mode.frequency > 3.0 * lowest.frequency
    assert mode.frequency == pytest.approx(curved_beam(washer, STEEL, 2), rel=0.02)


def test_frequencies_beyond_the_mesh_are_refused():
    with pytest.raises(ValueError, match=r"highest = 1e\+07 Hz is refused; allowed: above 0 to 8.54e\+05 Hz"):
        free_modes(*ring("7003C-bare", OUTER), 1e7)
    with pytest.raises(ValueError, match="highest = 0 Hz is refused"):
        free_modes(*ring("7003C-bare", OUTER), 0.0)


def test_disc_without_bending_in_its_plane_is_refused():
    # a thin plate with a small hole: six families bend out of its plane before one in it
    plate = Section(OUTER, 0.002, 0.050, 0.0004)
    with pytest.raises(
        ValueError, match="outer ring has no in-plane mode of order 2 among its 6 lowest: leave"
    ):
        in_plane_mode(plate, STEEL, 2)
