"""Ratings and life against printed and published figures."""

import math

import numpy as np
import pytest
from scipy.integrate import quad
from scipy.optimize import root

from fmu_bearing.formulas import iso76, iso281, iso16281, makers
from fmu_bearing.formulas.hertz import effective_modulus, point_contact
from fmu_bearing.scene.nsk import sizes

NOMINAL = math.radians(15.0)


@pytest.mark.parametrize(
    ("g", "factor"), [(0.05, 15.7), (0.09, 16.5), (0.14, 15.4), (0.17, 14.7), (0.20, 14.0)]
)
def test_static_factor_is_that_of_the_standards_table(g, factor):
    """One decimal is printed."""
    assert iso76.static_factor(g) == pytest.approx(factor, abs=0.05 + 1e-6 if g != 0.20 else 0.06)


# The standard was not at hand: these are values that public programs and makers' pages repeat as its own.
#: ISO 281:2007, table 2: f_c of single rows of radial and angular contact balls by D_w cos(alpha) / d_m.
FACTORS = {
    0.02: 35.8, 0.04: 43.8, 0.05: 46.7, 0.06: 49.1, 0.08: 52.8, 0.10: 55.5, 0.12: 57.5, 0.14: 58.8,
    0.16: 59.6, 0.18: 59.9, 0.20: 59.9, 0.22: 59.6, 0.24: 59.0, 0.26: 58.2, 0.28: 57.1, 0.30: 56.0,
    0.32: 54.6, 0.34: 53.2, 0.36: 51.7, 0.38: 50.0, 0.40: 48.4,
}  # fmt: skip
#: ISO 281:2007, table 3, single rows of 15 deg: f0 Fa / C0, e, Y (X 0.44); SKF and NSK print the same.
ROWS_15 = [
    (0.178, 0.38, 1.47), (0.357, 0.40, 1.40), (0.714, 0.43, 1.30), (1.07, 0.46, 1.23), (1.43, 0.47, 1.19),
    (2.14, 0.50, 1.12), (3.57, 0.55, 1.02), (5.35, 0.56, 1.00), (7.14, 0.56, 1.00),
]  # fmt: skip
#: ISO 281:2007, table 13: ranges of e_C for d_m below and from 100 mm on.
RANGES = {
    "extreme": ((1.0, 1.0), (1.0, 1.0)),
    "high": ((0.6, 0.8), (0.8, 0.9)),
    "normal": ((0.5, 0.6), (0.6, 0.8)),
    "slight": ((0.3, 0.5), (0.4, 0.6)),
    "typical": ((0.1, 0.3), (0.2, 0.4)),
    "severe": ((0.0, 0.1), (0.0, 0.1)),
}


@pytest.mark.parametrize(("g", "factor"), FACTORS.items())
def test_factor_of_the_dynamic_rating_is_that_of_the_standards_table(g, factor):
    """One ball of 1 mm, C = b_m f_c with b_m = 1.3. One decimal is printed; the formula is within 0.13 %."""
    found = iso281.dynamic_rating(1, 1.0, 1.0 / g, 0.0) / 1.3
    assert found == pytest.approx(factor, abs=0.05 + 1.3e-3 * factor)


@pytest.mark.parametrize(("relative", "limit", "y"), ROWS_15)
def test_equivalent_load_of_15_deg_at_all_rows_of_the_standards_table(relative, limit, y):
    below, above = 0.999 * limit * 1000.0, 1.001 * limit * 1000.0
    assert iso281.equivalent_load(15.0, relative, below, 1000.0) == 1000.0
    wanted = 440.0 + y * above
    assert iso281.equivalent_load(15.0, relative, above, 1000.0) == pytest.approx(wanted, rel=1e-12)


def test_equivalent_load_between_and_beyond_the_rows():
    """Linear between two rows, the last one beyond them; steeper angles have one row each."""
    assert iso281.equivalent_load(15.0, 2.855, 1000.0, 0.0) == pytest.approx(1070.0)  # of 1.12 and 1.02
    assert iso281.equivalent_load(15.0, 2.855, 524.0, 1000.0) == 1000.0  # e = 0.525
    assert iso281.equivalent_load(15.0, 0.01, 1000.0, 0.0) == pytest.approx(1470.0)
    assert iso281.equivalent_load(15.0, 20.0, 1000.0, 0.0) == pytest.approx(1000.0)
    assert iso281.equivalent_load(25.0, 1.0, 679.0, 1000.0) == 1000.0
    assert iso281.equivalent_load(25.0, 1.0, 681.0, 1000.0) == pytest.approx(410.0 + 0.87 * 681.0)
    # 40 deg: NSK (BEA), FGFA and LYC print e 1.14, X 0.35, Y 0.57
    assert iso281.equivalent_load(40.0, 1.0, 1139.0, 1000.0) == 1000.0
    assert iso281.equivalent_load(40.0, 1.0, 2000.0, 1000.0) == pytest.approx(350.0 + 0.57 * 2000.0)
    # 30 deg: LYC's double row has 1.625 times 0.39 and 0.76: 0.63 and 1.24, with e 0.80
    assert iso281.equivalent_load(30.0, 1.0, 2000.0, 1000.0) == pytest.approx(390.0 + 0.76 * 2000.0)
    two = [1.625 * value for value in iso281.factors(30.0, 1.0)[1:]]
    assert two == pytest.approx([0.63, 1.24], abs=0.005)  # the last digit printed
    assert iso281.equivalent_load(12.0, 1.0, 681.0, 1000.0) is None


@pytest.mark.parametrize("angle", [20.0, 25.0, 30.0, 35.0, 40.0, 45.0])
def test_factors_by_the_formulas_of_the_standard(angle):
    """ISO/TR 1281-1, 7.2.1: X = 1 - 0.4 * 1.25 / eta, eta = 1 - sin(alpha) / 2.75; P is one at e."""
    e, x, y = iso281.factors(angle, 1.0)
    eta = 1.0 - math.sin(math.radians(angle)) / 2.75
    assert x == pytest.approx(1.0 - 0.5 / eta, abs=0.005)  # two digits are printed
    # half of the last digits of X, Y and e
    assert x + y * e == pytest.approx(1.0, abs=0.005 + 0.005 * (y + e))


def test_factors_between_the_angles():
    assert iso281.factors(27.5, 1.0) == pytest.approx((0.74, 0.40, 0.815))
    assert iso281.factors(17.5, 2.14) == pytest.approx((0.535, 0.435, 1.06))
    assert iso281.factors(13.0, 1.0) is None is iso281.factors(47.0, 1.0)


@pytest.mark.parametrize("clean", RANGES)
def test_cleanliness_counts_in_the_middle_of_the_standards_range(clean):
    assert set(RANGES) == set(iso281.CLEANLINESS)
    middles = [0.5 * (low + high) for low, high in RANGES[clean]]
    assert iso281.CLEANLINESS[clean] == pytest.approx(middles, rel=1e-12)


@pytest.mark.parametrize(
    ("kappa", "factor"),
    [
        (0.1, 0.10021),
        (0.2, 0.22367),
        (0.4, 0.42947),
        (0.5, 0.86169),
        (0.8, 3.5525),
        (1.0, 6.9181),
        (2.0, 15.113),
        (4.0, 33.285),
    ],
)
def test_life_modification_by_the_standards_equations(kappa, factor):
    """ISO 281:2007, eqs. 31 to 33 for e_C C_u / P = 0.2, evaluated by hand beside the program.

    Some programs have an exponent of 0.019087 in the second: then the laws do not meet at kappa = 0.4, where
    the term in the bracket would be 2.381 from below and 2.034 from above.

    C0 = 22 kN and d_m = 50 mm give C_u = 1000 N; cleanliness extreme, e_C = 1; P = 5000 N.
    """
    found = iso281.life_modification(kappa, "extreme", 22_000.0, 5000.0, 50.0)
    assert found == pytest.approx(factor, rel=1e-4)


def test_rating_of_large_balls_grows_more_slowly_without_a_jump():
    below, above = (iso281.dynamic_rating(12, ball, 200.0, NOMINAL) for ball in (25.399, 25.401))
    assert above == pytest.approx(below, rel=1e-3)


def settled(clearance, radial, axial):
    """Displacements (um, um, mrad) of a ring without moment, and the loads (N) of its balls, by our contacts.

    7 balls of 11.5 mm, d_m 43.5 mm, grooves 0.52 and 0.53, steel of 210 GPa and 0.3; one ball stands in the
    radial load's direction. The tilt moves the ring axially at the pitch circle, by which the printed tilt
    is met; the inner groove's circle would make it 1 % smaller and change nothing else. Lengths in mm.
    """
    ball, pitch, around = 11.5, 43.5, 2.0 * np.pi * np.arange(7) / 7
    modulus, g = effective_modulus(210e9, 0.3, 210e9, 0.3), 11.5 / 43.5
    races = [
        point_contact(0.5e-3 * ball * side, 0.5e-3 * ball / (1.0 - 0.5 / groove), modulus)
        for side, groove in ((1.0 - g, 0.52), (1.0 + g, 0.53))
    ]
    stiffness = sum(race.stiffness ** (-2.0 / 3.0) for race in races) ** -1.5 * 1e-3**1.5
    apart = 0.05 * ball
    free = math.acos(1.0 - clearance / (2.0 * apart))

    def contacts(x):
        outwards = apart * math.cos(free) + x[0] * np.cos(around)
        along = x[1] + 0.5 * pitch * x[2] * np.cos(around)
        load = stiffness * np.clip(np.hypot(outwards, along) - apart, 0.0, None) ** 1.5
        return load, np.arctan2(along, outwards)

    def left(x):
        load, angle = contacts(x)
        thrust = load * np.sin(angle)
        return [
            radial - np.sum(load * np.cos(angle) * np.cos(around)),
            axial - np.sum(thrust),
            np.sum(thrust * np.cos(around)),
        ]

    start = [0.02, apart * math.sin(free) + 0.01, 1e-3] if axial else [0.02, 0.0, 0.0]
    found = root(left, start)
    assert found.success, found.message
    return 1e3 * found.x, contacts(found.x)[0]


@pytest.mark.parametrize(
    ("clearance", "radial", "axial", "printed", "life"),
    [
        (0.0, 1000.0, 0.0, (15.1101, 0.0, 0.0), 13163.019),
        (0.0, 0.0, 1000.0, (0.0, 133.5381, 0.0), 2222.7318),
        (0.01, 1000.0, 0.0, (21.223, 0.0, 0.0), 10795.7948),
        (0.01, 0.0, 1000.0, (0.0, 149.1717, 0.0), 3115.8781),
        (0.01, 1000.0, 1000.0, (19.5923, 146.4603, -2.6872), 1630.5367),
    ],
)
def test_reference_life_of_a_deep_groove_bearing(clearance, radial, axial, printed, life):
    """The bearing of `settled` with C 23,400: displacements (um, um, mrad) and L10r (Mrev) by MASTA.

    Test_BallBearing.py of a public program for ISO 16281 (minzhun/ISO16281, 2019) prints them as examples 1
    to 5 (the sign of the tilt is ours). An older version has six balls of 11.1 mm; why its figures lie up to
    6 % from ours is not known.
    """
    moved, loads = settled(clearance, radial, axial)
    # one digit beyond rounding, for the other program's solver and constants; life goes with 1/Q^3
    assert moved == pytest.approx(printed, rel=5e-5, abs=1e-6)
    ratings = iso16281.race_ratings(23_400.0, 7, 11.5 / 43.5, 0.0, (0.52, 0.53))
    assert iso16281.reference_life(ratings, loads, loads) == pytest.approx(life, rel=1.5e-4)


def test_basic_life_of_a_makers_examples():
    """SKF, Rolling bearings: 6309, C 55.3 kN, 10 kN, 3000 r/min: 169 Mrev, 940 h.

    A pump's pair of 7312 BECBP back to back at 3000 r/min, 1.45 kN radially and 11.5 kN axially: P 11.52 kN,
    17,400 h. C of the pair is 1.62 times that of one bearing, 104 kN, which the life confirms within 0.1 %. X
    and Y of a pair are 1.625 times ours of a single row; SKF's have two digits.
    """
    turns = iso281.basic_life(55.3, 10.0)
    # half of the last digits printed
    assert turns == pytest.approx(169.0, abs=0.5)
    assert iso281.hours(turns, 3000.0) == pytest.approx(940.0, abs=5.0)
    assert iso281.hours(iso281.basic_life(1.62 * 104.0, 11.52), 3000.0) == pytest.approx(17_400.0, abs=50.0)
    pair = 1.625 * iso281.equivalent_load(40.0, 1.0, 11.5, 1.45)
    assert pair == pytest.approx(11.52, abs=0.005 * (1.45 + 11.5))


def test_reference_life_of_equal_loads_needs_no_mean():
    ratings = (1300.0, 2000.0)
    life = iso16281.reference_life(ratings, np.full(9, 100.0), np.full(9, 100.0))
    shares = (13.0 ** (-10 / 3) + 20.0 ** (-10 / 3)) ** -0.9
    assert life == pytest.approx(shares, rel=1e-12)
    # life goes with the cube of the load
    double = iso16281.reference_life(ratings, np.full(9, 200.0), np.full(9, 200.0))
    assert life / double == pytest.approx(2.0**3, rel=1e-12)
    assert iso16281.reference_life(ratings, np.zeros(9), np.zeros(9)) == math.inf


def test_reference_life_is_the_basic_one_for_the_load_distribution_behind_it():
    """C is that of a radial load on half the circle, J_r(0.5): L10r is (C/F)^3 but for rounded factors."""
    g, balls, rating, load = 0.15, 200, 10_000.0, 1000.0
    jr = quad(lambda t: math.cos(t) ** 2.5, -math.pi / 2, math.pi / 2)[0] / (2 * math.pi)
    angle = 2.0 * np.pi * (np.arange(balls) + 0.5) / balls
    loads = load / (balls * jr) * np.clip(np.cos(angle), 0.0, None) ** 1.5
    ratings = iso16281.race_ratings(rating, balls, g, 0.0, (0.52, 0.53))
    life = iso16281.reference_life(ratings, loads, loads)
    assert life == pytest.approx((rating / load) ** 3, rel=0.02)


@pytest.mark.parametrize(
    ("rpm", "pitch", "reference"), [(500.0, 50.0, 36.6), (1000.0, 50.0, 20.1), (10_000.0, 26.0, 8.83)]
)
def test_reference_viscosity(rpm, pitch, reference):
    """45,000 n^-0.83 d^-0.5 below 1000 r/min, 4500 (n d)^-0.5 above, in mm2/s."""
    assert iso281.viscosity_ratio(reference, rpm, pitch) == pytest.approx(1.0, rel=2e-3)
    assert math.isnan(iso281.viscosity_ratio(10.0, 0.0, pitch))


def test_life_modification_grows_with_film_and_cleanliness_within_its_bounds():
    def factor(kappa, clean="high", static=10_000.0, load=1000.0, pitch=50.0):
        return iso281.life_modification(kappa, clean, static, load, pitch)

    values = [factor(kappa) for kappa in (0.05, 0.1, 0.2, 0.39999, 0.4, 0.99999, 1.0, 2.0, 4.0, 9.0)]
    assert np.all(np.diff(values) > -1e-3 * np.array(values[1:]))  # where two laws meet, their digits end
    assert values[0] == values[1] and values[-1] == values[-2]  # kappa counts from 0.1 to 4
    # the three laws meet within their printed digits
    assert factor(0.4) == pytest.approx(factor(0.39999), rel=0.02)
    assert factor(1.0) == pytest.approx(factor(0.99999), rel=1e-3)
    by_class = [factor(1.0, clean) for clean in iso281.CLEANLINESS]
    assert by_class == sorted(by_class, reverse=True)
    assert factor(4.0, "extreme", load=1.0) == 50.0 and factor(0.1, "severe", load=1e6) == pytest.approx(
        0.1, rel=1e-3
    )
    # the fatigue limit falls with the root of large pitch diameters, where the same oil counts as cleaner
    assert factor(1.0, "extreme", pitch=400.0) == pytest.approx(factor(1.0, "extreme", static=5000.0))


@pytest.mark.parametrize(("angle", "y"), [(15.0, 0.46), (25.0, 0.38), (30.0, 0.33), (40.0, 0.26)])
def test_static_equivalent_load(angle, y):
    assert iso76.static_load(angle, 1000.0, 100.0) == 50.0 + y * 1000.0
    assert iso76.static_load(angle, 10.0, 100.0) == 100.0
    assert iso76.static_load(12.0, 10.0, 100.0) is None


def test_makers_rules():
    assert makers.preload_classes(20.0) == pytest.approx((0.00675, 0.020, 0.0405))
    assert makers.speed_limit(15.0, False) == 1.75e6 and makers.speed_limit(25.0, True) == 1.25 * 1.5e6
    assert makers.speed_limit(40.0, True) is None
    # GMN: 80, 70 and 50 % of the single bearing's speed
    assert makers.RIGID_SPEED == {"extra light": 0.8, "light": 0.8, "medium": 0.7, "heavy": 0.5}
    assert makers.least_preload(10, math.radians(45.0), -2.0) == pytest.approx(22.0)


def test_grease_has_a_limit_of_its_own():
    """NSK prints both for each of 60 sizes; limits by angle agree with its grease speeds within 1 %."""
    for size in sizes().values():
        limit = makers.speed_limit(size.angle, False, grease=True)
        assert size.grease_speed * size.pitch == pytest.approx(limit, rel=0.01)
        assert limit < makers.speed_limit(size.angle, False)
