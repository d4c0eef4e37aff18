"""What is said of lines and parts: motion made of lines, in place of a run."""

import numpy as np
import pytest

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.metrology.at_speed import AtSpeed
from fmu_bearing.metrology.nose import PER_REVOLUTION, Nose

NM = 1e-9
TURNS = 20
CAGE, BALLS = 0.42, 12


def rates_of(cage):
    return KinematicFrequencies(1.0, cage, 2.8 + cage, BALLS * (1.0 - cage), BALLS * cage)


@pytest.fixture
def made(scene):
    """Motion along y and z of circles by order and radius (nm), an offset and noise (nm) of both."""

    def make(circles, cages=(CAGE,), offset=0.0, noise=0.0):
        angle = 2.0 * np.pi * np.arange(1, TURNS * PER_REVOLUTION + 1) / PER_REVOLUTION
        motion = np.zeros((angle.size, 5))
        for order, radius in circles.items():
            motion[:, 1:3] += radius * NM * np.column_stack([np.cos(order * angle), np.sin(order * angle)])
        motion[:, 1:3] += NM * (offset + noise * np.random.default_rng(3).normal(size=(angle.size, 2)))
        bare = scene("7003C-bare").replace({"sound": None, "operation.speed_rpm": 60.0})
        return AtSpeed(Nose(bare, TURNS, motion, tuple(map(rates_of, cages))))

    return make


def near_whole(one):
    return [line for line in one.remarks() if "nearer to a whole order" in line]


@pytest.mark.parametrize(("radius", "named"), [(1.0, True), (0.1, False)])
def test_lines_near_whole_orders_are_named_from_two_per_cent_of_the_largest_on(made, radius, named):
    """f_o is 0.04 beside order 5, nearer than 1/20; the largest line, f_c, is no such line."""
    found = near_whole(made({rates_of(CAGE).f_o: radius, CAGE: 20.0}))
    assert bool(found) == named
    if named:
        assert ": f_o (0.0400)" in found[0] and "f_c" not in found[0]


def test_nothing_is_said_of_bearings_that_make_no_line(made):
    """Two cages of nearly one rate share lines, but of order 2 alone, the shaft's, nothing is shared."""
    silent = made({2.0: 10.0}, (CAGE, CAGE + 1e-5))
    largest = silent.lines[0]
    assert largest.origin.bearing == 0 and largest.radial == pytest.approx(10.0 * NM, rel=1e-3)
    nothing = made({}, (CAGE, CAGE + 1e-5))
    assert not any("shared equally" in line for line in nothing.remarks())
    order = rates_of(CAGE).f_i - 1.0
    shared = made({order: 10.0}, (CAGE, 0.47, CAGE + 1e-5))
    # of the two others the one with the nearest rate shares it
    (words,) = [line for line in shared.remarks() if "shared equally" in line]
    largest = next(one.origin for one in shared.lines if one.origin.bearing)
    assert f"from that of bearing {4 - largest.bearing}," in words


def test_each_bearing_has_its_part(made):
    """A circle of radius r that does not repeat widens a fixed direction by 2 r."""
    one, other = rates_of(CAGE), rates_of(0.37)
    found = made({one.f_i - 1.0: 10.0, other.f_i - 1.0: 4.0}, (CAGE, 0.37))
    parts = found.per_bearing
    assert [part.bearing for part in parts] == [1, 2]
    # 20 revolutions reach a circle's ends within 1 - cos(pi / 20), and the fit 1 % of its radius
    assert [part.radial for part in parts] == pytest.approx([20.0 * NM, 8.0 * NM], rel=0.03)


def test_explained_is_a_share_of_energy(made):
    """Noise with the root mean square of a bearing's line: a half, and what the fit takes of noise."""
    found = made({CAGE: 3.0, 2.0: 7.0}, noise=3.0 / np.sqrt(2.0))
    lines = [line.origin for line in found.lines]
    taken, whole = (2.0 * sum(pick(one) for one in lines) / (TURNS * PER_REVOLUTION)
                    for pick in (lambda one: one.bearing > 0, lambda one: one.bearing == 0))  # fmt: skip
    # of the energy of 10,240 numbers by chance 1.4 %; lines less than 1/20 apart share what they take
    assert found.explained == pytest.approx((1.0 + taken) / (2.0 - whole), abs=0.05)


def test_a_mean_by_line_keeps_the_offset(made):
    found = made({2.0: 4.0}, offset=30.0)
    for direction in ("fixed y", "fixed z"):
        by_line, averaged = (found.mean_contour(direction, by_line=way) for way in (True, False))
        # the pull of the fit to small amplitudes leaves 1e-4 of the largest
        np.testing.assert_allclose(by_line, averaged, atol=0.01 * NM)
