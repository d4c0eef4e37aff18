"""Tolerances of bearings and seats against printed tables, and against the law that grades were made by."""

import math

import numpy as np
import pytest

from fmu_bearing.formulas import tolerances
from fmu_bearing.formulas.tolerances import (
    TAKES,
    ToleranceError,
    bore_limits,
    housing_limits,
    interference,
    outside_limits,
    shaft_limits,
)

ENDS = (10, 18, 30, 50, 80, 120, 180, 250)
#: Lower limits of bearings (um; upper ones are 0) by steps up to a diameter, in other tables than those the
#: package's were read in: nodeshk.com (P5), manv.in (P4), loyal.sg (P2).
BORES = {
    "P5": {10: -5, 18: -5, 30: -6, 50: -8, 80: -9, 120: -10, 180: -13, 250: -15},
    "P4": {10: -4, 18: -4, 30: -5, 50: -6, 80: -7},
    "P2": {10: -2.5, 18: -2.5, 30: -2.5, 50: -2.5, 80: -4, 120: -5, 150: -7, 180: -7},
}
OUTSIDES = {
    "P5": {18: -5, 30: -6, 50: -7, 80: -9, 120: -10, 150: -11, 180: -13, 250: -15},
    "P4": {18: -4, 30: -5, 50: -6, 80: -7, 120: -8, 150: -9},
    "P2": {30: -4, 50: -4, 80: -4, 120: -5, 150: -5, 180: -7, 250: -8},
}
#: Sumitomo, from JIS B 0401 (1999), steps up to 10, 18, 30, 50, 80 mm.
SHAFTS = {
    "g5": [(-11, -5), (-14, -6), (-16, -7), (-20, -9), (-23, -10)],
    "g6": [(-14, -5), (-17, -6), (-20, -7), (-25, -9), (-29, -10)],
    "h5": [(-6, 0), (-8, 0), (-9, 0), (-11, 0), (-13, 0)],
    "js5": [(-3, 3), (-4, 4), (-4.5, 4.5), (-5.5, 5.5), (-6.5, 6.5)],
    "k5": [(1, 7), (1, 9), (2, 11), (2, 13), (2, 15)],
    "k6": [(1, 10), (1, 12), (2, 15), (2, 18), (2, 21)],
    "m5": [(6, 12), (7, 15), (8, 17), (9, 20), (11, 24)],
}
#: germany-bearing.com, articles s67 and s70, all steps.
HOUSINGS = {
    "JS5": [(-3, 3), (-4, 4), (-4.5, 4.5), (-5.5, 5.5), (-6.5, 6.5), (-7.5, 7.5), (-9, 9), (-10, 10)],
    "K5": [(-5, 1), (-6, 2), (-8, 1), (-9, 2), (-10, 3), (-13, 2), (-15, 3), (-18, 2)],
    "K6": [(-7, 2), (-9, 2), (-11, 2), (-13, 3), (-15, 4), (-18, 4), (-21, 4), (-24, 5)],
    "M5": [(-10, -4), (-12, -4), (-14, -5), (-16, -5), (-19, -6), (-23, -8), (-27, -9), (-31, -11)],
    "M6": [(-12, -3), (-15, -4), (-17, -4), (-20, -4), (-24, -5), (-28, -6), (-33, -8), (-37, -8)],
}


@pytest.mark.parametrize("name", tolerances.BEARING_CLASSES)
def test_bearings_have_the_limits_that_others_print(name):
    for end, low in BORES[name].items():
        assert bore_limits(end, name) == bore_limits(0.95 * end, name) == (low, 0.0)
    for end, low in OUTSIDES[name].items():
        assert outside_limits(end, name) == outside_limits(0.95 * end, name) == (low, 0.0)


@pytest.mark.parametrize("name", SHAFTS)
def test_shafts_have_printed_limits(name):
    assert [shaft_limits(end, name) for end in ENDS[:5]] == SHAFTS[name]


@pytest.mark.parametrize("name", HOUSINGS)
def test_housings_have_printed_limits(name):
    assert [housing_limits(end, name) for end in ENDS] == HOUSINGS[name]


def test_a_step_of_size_includes_its_end():
    assert shaft_limits(18.0, "h5") == (-8.0, 0.0) and shaft_limits(18.001, "h5") == (-9.0, 0.0)
    assert outside_limits(150.0, "P5")[0] == -11.0 and outside_limits(150.001, "P5")[0] == -13.0


def test_grades_follow_the_law_they_were_made_by():
    """IT5 and IT6: 7 and 10 i, i = 0.45 D^(1/3) + 0.001 D um of a step's geometric mean, rounded.

    IT3, IT4: a geometric series from IT1 = 0.8 + 0.02 D to IT5. Tables are rounded to 0.5 or 1 um, by hand.
    """
    for low, high in zip((6, *ENDS[:-1]), ENDS, strict=True):
        mean = math.sqrt(low * high)
        unit = 0.45 * mean ** (1.0 / 3.0) + 0.001 * mean
        first, fifth = 0.8 + 0.02 * mean, 7.0 * unit
        laws = {4: first**0.25 * fifth**0.75, 5: fifth, 6: 10.0 * unit}
        for grade, law in laws.items():
            for limits in (shaft_limits(high, f"h{grade}"), housing_limits(high, f"H{grade}")):
                assert limits[1] - limits[0] == pytest.approx(law, abs=1.05), (high, grade)
        # IT3 is what K4 lies lower than IT4 and k4 would have it
        third = housing_limits(high, "H4")[1] - housing_limits(high, "K4")[1] - shaft_limits(high, "k4")[0]
        assert third == pytest.approx(math.sqrt(first * fifth), abs=1.05)


@pytest.mark.parametrize("name", tolerances.SHAFT_CLASSES)
def test_every_class_is_as_wide_as_its_grade(name):
    grade = name[-1]
    hole = {"js": "JS", "g": "H", "h": "H"}.get(name[:-1], name[:-1].upper()) + grade
    assert hole in tolerances.HOUSING_CLASSES
    for end in ENDS:
        low, high = shaft_limits(end, f"h{grade}")
        assert np.diff(shaft_limits(end, name)) == np.diff(housing_limits(end, hole)) == high - low > 0.0


def test_interference_of_makers_and_of_the_specification():
    """Shaft of 17 mm, js4 on P4: 2.0 um of -2.5 to 6.5; k5 on P4: 7 um, of 45 mm 10.5 um."""
    loose = (shaft_limits(17, "js4"), bore_limits(17, "P4"))
    assert [interference(*loose, take) for take in ("min", "mean", "max")] == [-2.5, 2.0, 6.5]
    assert interference(shaft_limits(17, "k5"), bore_limits(17, "P4"), "mean") == 7.0
    assert interference(shaft_limits(45, "k5"), bore_limits(45, "P4"), "mean") == 10.5


def test_a_housing_is_tight_where_its_bore_is_small():
    """K5 of 35 mm, -9 to 2 um, on P4, -6 to 0: from the largest bore to the smallest."""
    parts = (housing_limits(35, "K5"), outside_limits(35, "P4"))
    assert [interference(*parts, take, housing=True) for take in ("min", "mean", "max")] == [-8.0, 0.5, 9.0]


@pytest.mark.parametrize("housing", [False, True])
def test_probable_values_are_three_deviations_of_drawn_parts(housing):
    part, bearing = (-5.0, 3.0), (-6.0, 0.0)
    draws = np.random.default_rng(1).standard_normal((2, 400_000))
    sizes = [
        0.5 * (low + high) + (high - low) / 6.0 * z
        for (low, high), z in zip((part, bearing), draws, strict=True)
    ]
    tight = (sizes[0] - sizes[1]) * (-1.0 if housing else 1.0)
    found = [interference(part, bearing, take, housing) for take in TAKES]
    # the deviation of 400,000 draws is known to 0.1 %, one in a hundred of the tails to 1 %
    assert found[2] == pytest.approx(tight.mean(), abs=0.02)
    assert found[3] - found[2] == pytest.approx(3.0 * tight.std(), rel=0.01)
    assert found == sorted(found) and found[2] - found[1] == pytest.approx(found[3] - found[2])


@pytest.mark.parametrize(
    ("call", "words"),
    [
        (lambda: bore_limits(17, "P6"), r"bearing_class = 'P6' .*P5, P4, P2; or give interference_um"),
        (lambda: outside_limits(35, "p4"), r"bearing_class = 'p4' .*P5, P4, P2; or give interference_um"),
        (lambda: shaft_limits(17, "H5"), r"shaft_class = 'H5' .*g4, .* js4, .*m6; or give interference_um"),
        (lambda: housing_limits(35, "h5"), r"housing_class = 'h5' .*H4, .* M6; or give interference_um"),
        (lambda: bore_limits(6, "P4"), r"bore of 6 mm: .*more than 6, up to 250 mm; give interference_um"),
        (lambda: outside_limits(251, "P4"), r"outside diameter of 251 mm: .*250 mm; give interference_um"),
        (lambda: shaft_limits(math.nan, "h5"), r"shaft of nan mm: .*give interference_um"),
        (lambda: housing_limits(-1, "H5"), r"housing of -1 mm: .*give interference_um"),
        (lambda: interference((0, 1), (0, 1), "most"), r"take = 'most' .*min, probable min, mean, "),
    ],
)
def test_what_no_table_has_is_refused_with_a_way_out(call, words):
    with pytest.raises(ToleranceError, match=words):
        call()


@pytest.mark.parametrize(
    ("shaft", "most", "least"), [("k5", 22.0, 5.0), ("k6", 26.0, 6.0), ("m5", 29.0, 12.0), ("m6", 33.0, 13.0)]
)
def test_probable_interference_of_a_makers_table(shaft, most, least):
    """SKF prints whole um; these are the figures of bores over 30 to 50 mm, class Normal (-12 to 0 um)."""
    limits = shaft_limits(40, shaft)
    found = [interference(limits, (-12.0, 0.0), take) for take in ("probable max", "probable min")]
    assert found == pytest.approx([most, least], abs=0.5)
