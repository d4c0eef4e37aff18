"""Viscosity over temperature, and the reduction of the rolling resistance, against closed forms."""

import math

import mpmath
import numpy as np
import pytest

from fmu_bearing.engine.choices import EHL_ALONE, FLOODED, STARVED
from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.engine.layout import P
from fmu_bearing.engine.mechanics.conditions import (
    rolling_reduction,
    sheared_viscosity,
    thickest_useful,
    thinning,
    viscosity,
)
from tests.oracles import friction

TEMPERATURES = [233.15, 263.15, 293.15, 313.15, 353.15, 373.15, 473.15]  # K, the range of the input
VOGEL, WALTHER = 0.0, 1.0


def oil(law, eta=0.03, density=870.0, b=879.0, c=178.0, slope=3.7):
    p = np.zeros(P.TABLES)
    p[P.VISCOSITY_LAW] = law
    p[P.VISCOSITY], p[P.OIL_DENSITY] = eta, density
    p[P.VOGEL_B], p[P.VOGEL_C] = b, c
    p[P.WALTHER_SLOPE] = slope
    return p


def walther(eta, density, slope, temperature):
    """lg lg(v + 0.7) = A - B lg T in 30 digits, as printed (ASTM D341)."""
    with mpmath.workdps(30):
        nu = mpmath.mpf(eta) / density * 10**6
        a = mpmath.log10(mpmath.log10(nu + mpmath.mpf("0.7"))) + slope * mpmath.log10(mpmath.mpf(293.15))
        raised = a - slope * mpmath.log10(mpmath.mpf(temperature))
        return float((10 ** (10**raised) - mpmath.mpf("0.7")) * density / 10**6)


@pytest.mark.parametrize("law", [VOGEL, WALTHER])
@pytest.mark.parametrize("eta", [1e-3, 0.03, 2.0])
def test_both_laws_pass_through_the_reference_point(law, eta):
    # a logarithm and back: an ulp of the logarithm, 1e-16 times up to 8, and of v + 0.7 over v
    assert viscosity(oil(law, eta), REFERENCE_TEMPERATURE) == pytest.approx(eta, rel=2e-15)


@pytest.mark.parametrize("temperature", TEMPERATURES)
def test_vogel(temperature):
    expected = 0.03 * np.exp(879.0 / (temperature - 178.0) - 879.0 / (293.15 - 178.0))
    assert viscosity(oil(VOGEL), temperature) == pytest.approx(expected, rel=1e-14)


@pytest.mark.parametrize("temperature", TEMPERATURES)
@pytest.mark.parametrize("slope", [2.0, 3.7, 5.53])
def test_walther(temperature, slope):
    # the outer exponential multiplies an ulp of its argument, at most 70 here
    expected = walther(0.03, 870.0, slope, temperature)
    assert viscosity(oil(WALTHER, slope=slope), temperature) == pytest.approx(expected, rel=1e-13)


def test_walther_of_a_vg_32_oil():
    # A VG 32 oil of viscosity index about 100: 32 mm2/s at 40 degC (ISO 3448), 5.4 at 100 degC.
    # The slope follows from these two, the viscosity at 20 degC from the slope.
    def double(nu):
        return math.log10(math.log10(nu + 0.7))

    slope = (double(32.0) - double(5.4)) / math.log10(373.15 / 313.15)
    assert slope == pytest.approx(3.7, abs=0.1)  # the scene's default
    nu_20 = 10 ** (10 ** (double(32.0) + slope * math.log10(313.15 / 293.15))) - 0.7
    assert nu_20 == pytest.approx(87.0, rel=0.05)  # data sheets of such oils: 80 to 90 mm2/s
    p = oil(WALTHER, eta=nu_20 * 870.0 / 1e6, slope=slope)
    assert viscosity(p, 313.15) / 870.0 * 1e6 == pytest.approx(32.0, rel=1e-12)
    assert viscosity(p, 373.15) / 870.0 * 1e6 == pytest.approx(5.4, rel=1e-12)


@pytest.mark.parametrize("law", [VOGEL, WALTHER])
@pytest.mark.parametrize("temperature", TEMPERATURES)
@pytest.mark.parametrize("slide", [0.0, 1e-3, 1.0, 30.0, 200.0])
def test_a_sheared_film_has_the_viscosity_of_its_own_heat(law, temperature, slide):
    """Brent's root of the same equation with the law in NumPy; from the oil that sets to the thinnest."""
    p = oil(law)
    p[P.OIL_CONDUCTIVITY] = 0.14
    wanted = friction.sheared_viscosity(lambda t: viscosity(p, t), temperature, slide, 0.14)
    found = sheared_viscosity(p, temperature, slide)
    assert found == pytest.approx(wanted, rel=1e-9)
    rise = found * slide**2 / (12.0 * 0.14)
    assert viscosity(p, temperature + rise) == pytest.approx(found, rel=1e-9)


@pytest.mark.parametrize("temperature", TEMPERATURES)
def test_what_a_kelvin_thins(temperature):
    """B/(T - C)^2 of Vogel's law; differences over 0.2 K leave (0.1/(T - C))^2 = 3e-6 of it."""
    assert thinning(oil(VOGEL), temperature) == pytest.approx(879.0 / (temperature - 178.0) ** 2, rel=4e-6)
    assert thinning(oil(VOGEL, b=0.0), temperature) == 0.0


@pytest.mark.parametrize(("law", "flat"), [(VOGEL, {"b": 0.0}), (WALTHER, {"slope": 0.0})])
def test_a_constant_of_zero_leaves_the_temperature_out(law, flat):
    for temperature in TEMPERATURES:
        assert viscosity(oil(law, **flat), temperature) == pytest.approx(0.03, rel=2e-15)


@pytest.mark.parametrize("law", [VOGEL, WALTHER])
@pytest.mark.parametrize("extreme", [{"eta": 2.0, "b": 3000.0, "c": 220.0, "slope": 8.0}, {"eta": 1e-3}])
def test_extremes_stay_finite_and_fall(law, extreme):
    p = oil(law, density=2000.0 if extreme["eta"] < 1.0 else 500.0, **extreme)
    values = [viscosity(p, temperature) for temperature in TEMPERATURES]
    assert np.all(np.isfinite(values)) and np.all(np.diff(values) <= 0.0) and values[-1] > 0.0
    for wrong in (0.0, 100.0, 220.0, 1e4):  # inputs beyond their range: a number, not NaN
        assert math.isfinite(viscosity(p, wrong)) and viscosity(p, wrong) > 0.0


def reduction(p, eta, speed, power=0.66):
    """By how much the resistance, which goes with a power of the viscosity, is reduced."""
    felt, heating, starving = rolling_reduction(p, eta, speed)
    return felt**power * heating * starving


def test_reduction_of_the_rolling_resistance():
    p = oil(VOGEL)
    p[P.SHEAR_HEATING], p[P.STARVATION] = 1.84e-9 * 26.0**1.28, 6e-8 * 52.0 * math.sqrt(4.4 / 36.0)
    assert rolling_reduction(p, 0.03, 2000.0) == (1.0, 1.0, 1.0)  # left out
    p[P.REDUCTION] = 1.0
    n, nu = 2000.0 * 30.0 / math.pi, 0.03 / 870.0 * 1e6
    heating = 1.0 / (1.0 + 1.84e-9 * (n * 26.0) ** 1.28 * nu**0.64)
    starving = math.exp(-6e-8 * nu * n * 52.0 * math.sqrt(4.4 / (2.0 * 18.0)))
    for speed in (2000.0, -2000.0):  # 1e-6 r/min of the speed's floor is 7e-11 of the factor
        assert reduction(p, 0.03, speed) == pytest.approx(heating * starving, rel=1e-9)
    assert reduction(p, 0.03, 0.0) == pytest.approx(1.0, abs=1e-12)


@pytest.mark.parametrize(("law", "power"), [(EHL_ALONE, 0.66), (STARVED, 0.66), (FLOODED, 0.75)])
@pytest.mark.parametrize("rpm", [200.0, 5_000.0, 20_000.0, 60_000.0])
def test_thick_oil_lowers_no_rolling_resistance_where_starvation_is_held(rpm, law, power):
    """The resistance nu^power/(1 + a nu^0.64) exp(-b nu) up to its maximum, found on a grid, then that."""
    p = oil(VOGEL)
    p[P.ROLLING_LAW] = law
    p[P.REDUCTION], p[P.SHEAR_HEATING] = 1.0, 1.84e-9 * 26.0**1.28
    p[P.STARVATION] = 6e-8 * 52.0 * math.sqrt(4.4 / (2.0 * 18.0))
    speed = rpm * math.pi / 30.0
    nu = np.geomspace(0.1, 1e6, 7001)  # mm2/s, from hot water to pitch
    heated, starved = p[P.SHEAR_HEATING] * rpm**1.28, p[P.STARVATION] * rpm
    resistance = nu**power / (1.0 + heated * nu**0.64) * np.exp(-starved * nu)
    most = np.maximum.accumulate(resistance)
    assert most[-1] > 2.0 * resistance[-1]  # the cold end is beyond the maximum at every speed
    for held, wanted in ((0.0, resistance), (1.0, most)):
        p[P.STARVATION_HELD] = held
        found = nu**power * [reduction(p, 870e-6 * one, speed, power) for one in nu]
        # the grid of 0.23 % misses a maximum by its square at most
        np.testing.assert_allclose(found, wanted, rtol=1e-5, atol=1e-300)


def test_held_starvation_at_standstill_and_without_any():
    p = oil(VOGEL)
    p[P.REDUCTION], p[P.SHEAR_HEATING], p[P.STARVATION_HELD] = 1.0, 1.84e-9 * 26.0**1.28, 1.0
    for starvation in (0.0, 1e-6):
        p[P.STARVATION] = starvation
        assert reduction(p, 1e9, 0.0) == pytest.approx(1.0, abs=1e-3)
    p[P.STARVATION] = 0.0
    assert 0.0 < reduction(p, 1e3, 2000.0) < 0.1  # inlet shear heating alone


@pytest.mark.parametrize("power", [0.66, 0.75])
@pytest.mark.parametrize("heated", [1e-6, 1e-2, 1.0])
@pytest.mark.parametrize("starved", [1e-5, 1e-3])
def test_the_thickest_useful_oil_has_the_largest_resistance(power, heated, starved):
    """Of nu^power exp(-starved nu)/(1 + heated nu^0.64), among viscosities beside it; thinner oil stays."""

    def logarithm(nu):
        return power * math.log(nu) - starved * nu - math.log1p(heated * nu**0.64)

    largest = thickest_useful(power, heated, starved, 1e9)
    assert all(logarithm(largest) > logarithm(largest * share) for share in (0.5, 0.999, 1.001, 2.0))
    # where the slope of the logarithm vanishes
    x = heated * largest**0.64
    assert starved * largest + 0.64 * x / (1.0 + x) == pytest.approx(power, rel=1e-9)
    assert thickest_useful(power, heated, starved, 0.9 * largest) == 0.9 * largest
