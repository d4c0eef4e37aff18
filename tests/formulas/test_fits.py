"""Fits in closed form: figures of the specification, exact solutions, limits, and quadrature."""

import math

import numpy as np
import pytest
from scipy.integrate import dblquad, quad

from fmu_bearing.engine.constants import REFERENCE_TEMPERATURE
from fmu_bearing.formulas import fits
from fmu_bearing.formulas.fits import Solid, State, fit
from fmu_bearing.scene.entries import catalogue
from tests.formulas.seats import CASES, CERAMIC, HOUSED, HOUSED_STEEL, LARGE, RPM, STEEL, Load, material

# ---- Figures of the specification --------------------------------------------------------------------------

#: By case: interference on the radius (um), pressure, hoop stress (MPa), motion of the race (um), speed of
#: loss (r/min; None: at none); half a unit of each printed digit.
PRINTED = {
    "1": (3.5000, 18.905, 68.18, 2.7138, 97493),
    "2": (3.3527, 18.110, 69.35, 2.7538, 97493),
    "4": (1.0000, 6.7370, 24.30, 0.6478, 210082),
    "5": (3.9149, 26.375, 96.77, 2.5787, 416154),
    "7": (-0.1488, 0.0, 4.04, 0.1542, 0),
    "10": (4.0801, 4.8425, 45.98, 4.8881, 38132),
    "12": (2.0000, 2.6784, -18.81, -1.3289, None),
    "15 shaft": (0.8527, 4.6059, 20.65, 0.8154, 52112),
    "15 housing": (1.4130, 2.4794, -17.41, -1.2302, None),
}
#: Free angle (deg) cold and still, and at the state: bearing, materials of balls, shaft and housing seats
#: (their loads as in `CASES`).
ANGLES = {
    "1": ("7003C", "GCr15", ("1", None), 10.531, 10.531),
    "2": ("7003C", "GCr15", ("2", None), 10.531, 10.452),
    "4": ("7003C", "Si3N4", ("4", None), 14.061, 14.061),
    "5": ("7003C", "Si3N4", ("5", None), 14.061, 10.797),
    "7": ("7003C", "Si3N4", ("7", None), 14.445, 14.888),
    "10": ("7009C", "GCr15", ("10", None), 12.003, 10.912),
    "12": ("7003C", "GCr15", (None, "12"), 13.002, 13.002),
    "15": ("7003C", "GCr15", ("15 shaft", "15 housing"), 12.479, 10.334),
}
#: Temperatures (degC) of the outer ring where no seat holds it.
OUTER = {"1": 20.0, "2": 40.0, "4": 20.0, "5": 60.0, "7": 40.0, "10": 40.0}


@pytest.mark.parametrize("name", PRINTED)
def test_states_of_the_specification(name):
    seat, load = CASES[name]
    found = load.of(seat.fit())
    d, pressure, hoop, race, loss = PRINTED[name]
    assert 1e6 * found.interference == pytest.approx(d, abs=5.1e-5)
    assert 1e-6 * found.pressure == pytest.approx(pressure, abs=5.1e-4)
    assert 1e-6 * found.hoop == pytest.approx(hoop, abs=5.1e-3)
    assert 1e6 * found.race == pytest.approx(race, abs=5.1e-5)
    speed = load.loss(seat.fit())
    assert speed is None if loss is None else speed == pytest.approx(loss, abs=0.51)


def angle(name, cold):
    """Free angle (deg) of a case, at 20 degC and standstill or at its state."""
    bearing, balls, seats, *_ = ANGLES[name]
    b = catalogue("bearings")[bearing]
    given = [None if key is None else CASES[key] for key in seats]
    loads = [None if one is None else Load(one[1].d_0) if cold else one[1] for one in given]
    races = [
        0.0 if one is None else load.of(one[0].fit()).race for one, load in zip(given, loads, strict=True)
    ]
    warm = [20.0 if load is None or cold else load.ring for load in loads]
    if loads[1] is None and not cold:
        warm[1] = OUTER[name]
    seat = next(one[0] for one in given if one is not None)
    expansions = [material(one).expansion for one in (seat.ring, seat.ring, balls)]
    rises = [warm[0] - 20.0, warm[1] - 20.0, 0.5 * sum(warm) - 20.0]
    growths = tuple(1.0 + a * rise for a, rise in zip(expansions, rises, strict=True))
    return math.degrees(
        fits.free_angle(
            1e-3 * b["pitch_diameter_mm"],
            1e-3 * b["ball_diameter_mm"],
            b["inner_conformity"],
            b["outer_conformity"],
            math.radians(b["contact_angle_deg"]),
            growths,
            tuple(races),
        )
    )


@pytest.mark.parametrize("name", ANGLES)
def test_free_angles_of_the_specification(name):
    assert angle(name, cold=True) == pytest.approx(ANGLES[name][3], abs=5.1e-4)
    assert angle(name, cold=False) == pytest.approx(ANGLES[name][4], abs=5.1e-4)


#: Chance of the 7003C's ring of Si3N4 by hoop stress at the bore (MPa), for strength (MPa) and modulus.
CHANCES = {
    (900, 12): {100: 7e-10, 150: 9e-8, 200: 3e-6, 250: 4e-5},
    (600, 7): {100: 5e-4, 150: 8e-3, 200: 6e-2, 250: 0.25},
}


@pytest.mark.parametrize(("strength", "modulus"), CHANCES)
def test_chances_of_the_specification(strength, modulus):
    """One digit is printed, two of the last."""
    seat = CERAMIC.fit()
    for hoop, chance in CHANCES[strength, modulus].items():
        pressed = State(0.0, 1e6 * hoop / seat.hoop, 1e6 * hoop, 0.0)
        found = fits.breaking_chance(seat, pressed, 0.0, 1e6 * strength, modulus)
        assert float(f"{found:.{1 if chance == 0.25 else 0}e}") == pytest.approx(chance, rel=1e-9)


def test_mounting_temperatures_of_the_specification():
    assert fits.mounting_kelvin(1e-6, 8.5e-3, 11.8e-6) == pytest.approx(10.0, abs=0.05)
    assert fits.mounting_kelvin(1e-6, 8.5e-3, 3.2e-6) == pytest.approx(37.0, abs=0.5)
    assert fits.mounting_kelvin(-1e-6, 8.5e-3, 3.2e-6) == 0.0


def test_reference_is_the_engines():
    assert fits.REFERENCE == REFERENCE_TEMPERATURE


# ---- Exact solutions and limits ----------------------------------------------------------------------------


def test_solid_shaft_of_the_rings_material_has_the_textbooks_pressure():
    """Shaft as wide as the ring: E d (R^2 - a^2) / (2 a R^2), whatever Poisson's ratio."""
    a, outside, *_ = STEEL.dimensions
    wanted = 208e9 * 2e-6 * (outside**2 - a**2) / (2.0 * a * outside**2)
    assert Load(2.0).of(STEEL.fit(long=False)).pressure == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("rpm", [20000, -40000])
def test_ring_on_a_solid_shaft_turns_as_one_disc(rpm):
    """Of one material and as wide: rotation adds what it does to a disc without a seat (Timoshenko)."""
    steel, speed = material("GCr15"), rpm * RPM
    a, outside, contact, _ = STEEL.dimensions
    nu, load = steel.poisson_ratio, steel.density * speed**2
    still, turning = (Load(3.5, n).of(STEEL.fit(long=False)) for n in (0, rpm))
    growth = (1 - nu) * contact / 8 * ((3 + nu) * outside**2 - (1 + nu) * contact**2)
    assert turning.race - still.race == pytest.approx(load / steel.youngs_modulus * growth, rel=1e-9)
    stress = load / 8 * ((3 + nu) * outside**2 - (1 + 3 * nu) * a**2)
    assert turning.hoop - still.hoop == pytest.approx(stress, rel=1e-9)


def test_thin_rings_follow_their_seats():
    """Rings a thousandth of their radius thick: race by the whole interference, hoop E d / a."""
    steel, a, thin = material("GCr15"), 0.05, 5e-5
    inner = fit("inner", a, a + thin, a + thin, 0.01, steel, steel, 0.0)
    outer = fit("outer", a, a - thin, a - thin, 0.01, steel, steel, 10.0 * a)
    for seat, sign in ((inner, 1.0), (outer, -1.0)):
        found = seat.at(1e-6, 0.0, 293.15, 293.15)
        assert found.race == pytest.approx(sign * 1e-6, rel=5e-3)
        assert found.hoop == pytest.approx(sign * steel.youngs_modulus * 1e-6 / a, rel=5e-3)
    turning = inner.at(-1e-6, 1000.0, 293.15, 293.15)  # loose: a thin hoop
    assert turning.hoop == pytest.approx(steel.density * (1000.0 * a) ** 2, rel=5e-3)
    assert turning.race == pytest.approx(turning.hoop / steel.youngs_modulus * a, rel=5e-3)


@pytest.mark.parametrize("seat", [STEEL, CERAMIC, LARGE, HOUSED, HOUSED_STEEL])
def test_partners_and_rings_meet_and_balance(seat):
    """Growth of the ring's seat and way of the partner's add up to the interference, by other formulas.

    Stresses of a tube under pressure alone: radial ones of -p at the seat and 0 beyond, so that the mean of
    both principal stresses is the same everywhere; Hooke's law gives the growth of either surface.
    """
    found = seat.fit(long=False)
    state = Load(2.0).of(found)
    around = {"ring": seat_hoop(found), "partner": found.partner_hoop * state.pressure}
    solids = {"ring": material(seat.ring), "partner": material(seat.partner)}
    around["ring"] *= state.pressure
    ways = [
        found.seat_radius / s.youngs_modulus * (around[key] + s.poisson_ratio * state.pressure)
        for key, s in solids.items()
    ]
    assert abs(ways[0] - ways[1]) == pytest.approx(2e-6, rel=1e-12)


def seat_hoop(found):
    """Hoop stress of the ring at its seat over pressure; inside the outer ring it is less by 1."""
    return found.hoop if found.kind == "inner" else found.hoop + 1.0


def test_steel_on_steel_at_one_temperature_is_the_same_warm():
    for seat in (STEEL, LARGE, HOUSED_STEEL):
        assert Load(2.0, 0, 60, 60).of(seat.fit()) == pytest.approx(Load(2.0).of(seat.fit()), rel=1e-12)


def test_warmed_by_the_mounting_temperature_it_slips_on():
    for seat, warm, of in (
        (STEEL, "ring", "ring"),
        (CERAMIC, "partner", "partner"),
        (HOUSED, "ring", "ring"),
    ):
        part = material(getattr(seat, of))
        rise = fits.mounting_kelvin(2e-6, seat.dimensions[0], part.expansion)
        sign = 1.0 if (seat.kind == "inner") == (warm == "ring") else -1.0  # else it is cooled
        found = Load(2.0, **{warm: 20.0 + sign * rise}).of(seat.fit())
        assert found.interference == pytest.approx(0.0, abs=1e-18)


@pytest.mark.parametrize("seat", [STEEL, CERAMIC, LARGE])
def test_fit_lets_go_at_the_speed_of_loss(seat):
    coefficients = seat.fit()
    speed = coefficients.loss_speed(2e-6, 293.15, 293.15)
    before, after = (coefficients.at(2e-6, share * speed, 293.15, 293.15) for share in (0.999, 1.001))
    assert before.interference > 0.0 > after.interference and before.pressure > 0.0 == after.pressure
    # no jump: at the speed itself the ring is held by nothing, and grows alone
    assert after.race == pytest.approx(coefficients.race_spin * (1.001 * speed) ** 2, rel=1e-12)
    assert before.race == pytest.approx(after.race, rel=0.01)


def test_thin_shaft_of_steel_tightens_a_ceramic_ring():
    """A steel tube of 1 mm grows faster than the ring of Si3N4: no speed loosens it."""
    thin = fit("inner", *CERAMIC.dimensions, material("Si3N4"), material("GCr15"), 7.5e-3)
    assert thin.spin > 0.0 and thin.loss_speed(2e-6, 293.15, 293.15) is None
    assert thin.loss_speed(-1e-9, 293.15, 293.15) == 0.0


# ---- Length of the partner ---------------------------------------------------------------------------------


@pytest.mark.parametrize("width", [2e-3, 10e-3, 60e-3])
def test_band_on_a_thin_tube_is_a_beam_on_its_foundation(width):
    """Mean deflection under a band by quadrature of the line load's (Hetenyi), over that of an endless band.

    A tube of a hundredth: what thick walls add is below 0.3 %.
    """
    inside, outside, nu = 0.0995, 0.1005, 0.3
    t, m = outside - inside, 0.5 * (outside + inside)
    decay = (3.0 * (1.0 - nu**2)) ** 0.25 / math.sqrt(m * t)

    def line(x, s):
        z = decay * abs(x - s)
        return 0.5 * decay * math.exp(-z) * (math.cos(z) + math.sin(z))

    mean = 2.0 * dblquad(line, 0.0, width, 0.0, lambda x: x, epsabs=1e-12, epsrel=1e-9)[0] / width
    assert fits.length_factor(outside, inside, width, nu) == pytest.approx(mean, abs=3e-3)


def test_band_without_end_is_a_tube_as_wide():
    assert fits.length_factor(0.1, 0.09, 100.0, 0.3) == pytest.approx(1.0, abs=1e-3)
    assert fits.length_factor(0.02, 0.0, 100.0, 0.3) == pytest.approx(1.0, abs=1e-3)


# ---- Chance of breaking ------------------------------------------------------------------------------------


@pytest.mark.parametrize(("pressure", "rpm", "modulus"), [(27e6, 0, 12), (27e6, 60000, 7), (0.0, 60000, 30)])
def test_chance_is_weibulls_integral_over_the_volume(pressure, rpm, modulus):
    """Hoop stress by Lame and of a turning annulus, written out; adaptive quadrature."""
    silicon, speed, strength = material("Si3N4"), rpm * RPM, 400e6
    a, c, _, width = CERAMIC.dimensions
    nu, load = silicon.poisson_ratio, silicon.density * speed**2 / 8.0

    def stress(r):
        held = pressure * a**2 * (r**2 + c**2) / (r**2 * (c**2 - a**2))
        return held + load * ((3 + nu) * (a**2 + c**2 + (a * c / r) ** 2) - (1 + 3 * nu) * r**2)

    bar = 360e-9 / (2.0 * (modulus + 1.0) ** 2)
    scale = strength / math.gamma(1.0 + 1.0 / modulus) * bar ** (1.0 / modulus)
    risk = quad(lambda r: 2.0 * math.pi * r * width * (stress(r) / scale) ** modulus, a, c, epsrel=1e-11)[0]
    state = State(0.0, pressure, math.nan, math.nan)
    found = fits.breaking_chance(CERAMIC.fit(), state, speed, strength, modulus)
    assert found == pytest.approx(-math.expm1(-risk), rel=1e-9)


def test_bars_break_at_their_mean_strength_on_average():
    """A thin ring under even stress with the effective volume of a bar in 3-point bending is such a bar.

    Stress grows from the outer rollers to the middle and from the axis to the surface, half is compression.
    """
    steel, a, modulus, strength = material("GCr15"), 0.05, 10.0, 500e6
    share = quad(lambda x: x**modulus, 0.0, 1.0)[0]
    wall = 3e-3 * 4e-3 * 30e-3 * share * 0.5 * share / (2.0 * math.pi * a * 0.01)
    ring = fit("inner", a, a + wall, a, 0.01, steel, steel, 0.0)

    def whole(hoop):
        state = State(0.0, hoop / ring.hoop, hoop, 0.0)
        return 1.0 - fits.breaking_chance(ring, state, 0.0, strength, modulus)

    assert quad(whole, 0.0, 3.0 * strength)[0] == pytest.approx(strength, rel=1e-3)


def test_chance_at_its_ends():
    seat = CERAMIC.fit()
    assert fits.breaking_chance(seat, Load(-1.0).of(seat), 0.0, 900e6, 12) == 0.0
    assert fits.breaking_chance(seat, Load(1e6).of(seat), 0.0, 900e6, 60) == 1.0
    housed = HOUSED.fit()
    assert fits.breaking_chance(housed, Load(5.0).of(housed), 0.0, 900e6, 12) == 0.0


# ---- Free angle, creep, refusals ---------------------------------------------------------------------------


def test_free_angle_by_the_clearance():
    """1 - P_d / (2 A): the clearance left falls by twice what the races lose."""
    dimensions = (26e-3, 4.5e-3, 0.515, 0.52, math.radians(15.0))
    assert fits.free_angle(*dimensions) == pytest.approx(math.radians(15.0), rel=1e-12)
    distance = 0.035 * 4.5e-3
    clearance = 2.0 * distance * (1.0 - math.cos(math.radians(15.0)))
    found = fits.free_angle(*dimensions, races=(1.5e-6, -0.5e-6))
    assert math.cos(found) == pytest.approx(1.0 - (clearance - 4e-6) / (2.0 * distance), rel=1e-12)
    assert fits.free_angle(*dimensions, races=(0.501 * clearance, 0.0)) == 0.0  # radially tight


def test_creep_by_the_makers_rule_and_by_friction():
    """Bore 40 mm, width 20 mm, 5000 N: 8 um on diameter. Torque: friction on the seat at its radius."""
    assert 2e6 * fits.creep_interference(0.02, 0.02, 5000.0) == pytest.approx(8.0, rel=1e-12)
    area = 2.0 * math.pi * 0.02 * 0.015
    assert fits.creep_torque(1e6, 0.02, 0.015, 0.12) == pytest.approx(0.12 * 1e6 * area * 0.02, rel=1e-12)


@pytest.mark.parametrize(
    ("kind", "radii", "words"),
    [
        (
            "inner",
            (0.02, 0.02, 0.0),
            "inner ring has no wall: effective_radius = 0.02 m; give more than 0.02 m",
        ),
        ("outer", (0.02, 0.03, 0.04), "outer ring has no wall: effective_radius = 0.03 m; give 0 to 0.02 m"),
        ("inner", (0.02, 0.03, 0.02), r"shaft has no wall: .* = 0.02 m; give 0 \(solid\) to 0.02 m"),
        ("outer", (0.02, 0.01, 0.02), "housing has no wall: .* = 0.02 m; give more than 0.02 m"),
    ],
)
def test_walls_without_thickness_are_refused(kind, radii, words):
    steel = Solid(208e9, 0.3, 7800.0, 11.8e-6)
    seat, effective, other = radii
    with pytest.raises(ValueError, match=words):
        fit(kind, seat, effective, effective, 0.01, steel, steel, other)


def test_contact_is_where_the_section_has_it():
    for seat in (STEEL, CERAMIC, LARGE, HOUSED):
        assert seat.dimensions[2] == pytest.approx(seat.section().contact[1], rel=1e-12)
        assert np.isclose(seat.section().width, seat.dimensions[3], rtol=1e-12)
