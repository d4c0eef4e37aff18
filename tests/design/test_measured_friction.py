"""Friction against others' values, nothing fitted: SKF's model of a 7210B, heat of NASA's 35 mm bearing.

Constants of rolling, hysteresis and traction come from their own sources (`docs/theory.md`); what the sources
of the values leave open is the catalogue's or an estimate from dimensions, and named here.
"""

import math
from statistics import median

import numpy as np
import pytest

from fmu_bearing.engine.constants import RPM
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.estimate import cage_estimates
from tests.oracles.friction import sheared_viscosity

pytestmark = pytest.mark.filterwarnings("ignore:the ellipse of the most loaded contact")

SCENE = """
name = "measured"
[bearing]
designation = "{name}"
bore_mm = {bore}
outside_diameter_mm = {outside}
width_mm = {width}
pitch_diameter_mm = {pitch}
ball_diameter_mm = {ball}
ball_count = {count}
contact_angle_deg = {angle}
inner_conformity = {inner}
outer_conformity = {outer}
inner_ring_outer_diameter_mm = {inside_land}
outer_ring_inner_diameter_mm = {outside_land}
contact_damping_us = 2.5
race_roughness_um = 0.02
ball_roughness_um = 0.01
{cage}
[materials]
inner_ring = "GCr15"
outer_ring = "GCr15"
balls = "{balls}"
{cage_material}
[lubricant]
catalogue = "spindle-oil"
viscosity_Pa_s = {eta}
vogel_B_K = 0.0
{oil}
[mounting]
preload_N = {load}
pedestal_stiffness_N_m = 1e8
[operation]
speed_rpm = {rpm}
[fidelity.terms]
gravity = false
{terms}
"""

NO_CAGE = "cage = false"


def settled(bearing, rpm, load, eta, balls="GCr15", cage=NO_CAGE, oil="", terms=""):
    """Steady state of the full equations; torque and shares (N m)."""
    land = 0.7 * bearing["ball"]
    text = SCENE.format(
        **bearing, inside_land=bearing["pitch"] - land, outside_land=bearing["pitch"] + land, rpm=float(rpm),
        load=float(load), eta=eta, balls=balls, cage=cage, oil=oil, terms=terms,
        cage_material="" if cage == NO_CAGE else 'cage = "bakelite"',
    )  # fmt: skip
    run = Instance(prepare(read_scene_text(text)))
    run.initialise()
    return run


# --- SKF's model of a 7210B -----------------------------------------------------------------------

#: Balls from another program's table of the bearing, conformity from makers' printed stiffness.
SKF_7210B = {
    "name": "7210B", "bore": 50.0, "outside": 90.0, "width": 20.0, "pitch": 70.0, "ball": 12.7, "count": 15,
    "angle": 40.0, "inner": 0.52, "outer": 0.525,
}  # fmt: skip
POINTS = [
    (nu, load, n) for nu in (11.5, 32.0, 100.0) for load in (500, 2000, 4000) for n in (500, 1500, 3000)
]


def skf(n, axial, nu, bore=50.0, outside=90.0):
    """Rolling and sliding torque (N mm) of a single-row 72 B under axial load: SKF's catalogue of 2018.

    Pages 65 ff.; sliding coefficient 0.05, replenishment constant 6e-8.
    """
    pitch = 0.5 * (bore + outside)
    rolling = 5.03e-7 * pitch**1.97 * (1.9e-12 * pitch**4 * n**2 + 1.97 * axial) ** 0.54
    heating = 1.0 / (1.0 + 1.84e-9 * (n * pitch) ** 1.28 * nu**0.64)
    starving = math.exp(-6e-8 * nu * n * (bore + outside) * math.sqrt(4.4 / (2.0 * (outside - bore))))
    thrown = (1.91e-12 * pitch**4 * n**2) ** (4.0 / 3.0)
    sliding = 1.3e-2 * pitch**0.26 * (thrown + 0.68 * axial ** (4.0 / 3.0))
    return heating * starving * rolling * (nu * n) ** 0.6 + 0.05 * sliding


def over_skf(oil="", terms=""):
    """Ours over SKF's at all points: no drag, no cage, both with traction 0.05."""
    off = f"drag = false\n{terms}"
    return [
        1e3 * settled(SKF_7210B, n, load, 870e-6 * nu, oil=oil, terms=off).get("friction_torque")
        / skf(n, load, nu)
        for nu, load, n in POINTS
    ]  # fmt: skip


def test_skf_model_of_the_7210b():
    """The goals: 24 of 27 points within 0.8 to 1.25, median 0.85 to 1.05. Found: 25, 0.907."""
    assert skf(500, 500, 11.5) == pytest.approx(21.3, rel=3e-3)  # a program of others has these two
    assert skf(3000, 4000, 100.0) == pytest.approx(337.9, rel=1e-3)
    ratios = over_skf()
    assert median(ratios) == pytest.approx(0.907, abs=0.005)
    outside = [point for point, ratio in zip(POINTS, ratios, strict=True) if not 0.8 <= ratio <= 1.25]
    # light load in thick oil: rigid surfaces, 1.42 and 1.37 times SKF's
    assert outside == [(100.0, 500, 1500), (100.0, 500, 3000)]
    assert max(ratios) < 1.45


@pytest.mark.parametrize(
    ("oil", "terms", "middle", "within"),
    [
        ('rolling_law = "houpert-1987-ehl"', "rolling_hysteresis = false", 0.79, 12),
        ("", "rolling_hysteresis = false", 0.865, 17),
        ('supply = "jet"\nreplenishment_constant = 6e-8', "", 1.175, 16),
    ],
)
def test_what_each_part_is_worth(oil, terms, middle, within):
    """EHL force alone, the change to rigid surfaces without hysteresis, and the law of flooded inlets."""
    ratios = over_skf(oil, terms)
    assert median(ratios) == pytest.approx(middle, abs=0.005)
    assert sum(0.8 <= ratio <= 1.25 for ratio in ratios) == within


# --- NASA's bearing of 35 mm ----------------------------------------------------------------------

#: Geometry and conformity as others give them; width, lands and cage from the dimensions.
NASA_35 = {
    "name": "35 mm", "bore": 35.0, "outside": 62.0, "width": 14.0, "pitch": 46.5, "ball": 7.14, "count": 16,
    "angle": 24.0, "inner": 0.535, "outer": 0.535,
}  # fmt: skip
#: W at r/min, 667 N, oil jet at 394 K: NASA TP-2275 (Parker 1984), figure 3, read off by others within 3 %.
MEASURED = {28_000: 350.0, 48_000: 700.0, 64_000: 1100.0, 72_000: 1400.0}
INLET, DENSITY, CONDUCTIVITY = 394.0, 860.0, 0.14  # K; kg/m3 and W/(m K), assumed


def ester(temperature):
    """Viscosity (Pa s) of the rig's oil: 4 mm2/s at the inlet, with the slope of 27.6 at 40, 5.1 at 100."""

    def double(nu):
        return math.log10(math.log10(nu + 0.7))

    slope = (double(27.6) - double(5.1)) / math.log10(373.15 / 313.15)

    def nu(t):
        return 10 ** (10 ** (double(27.6) - slope * math.log10(t / 313.15))) - 0.7

    return 1e-6 * DENSITY * 4.0 / nu(INLET) * nu(temperature)


def heat(rpm, balls):
    """Heat (W), the lands in the jet's oil, heated by its shear; 5 kg/m3 of oil and air, traction 0.04."""
    cage = {rule.key: float(rule.value) for rule in cage_estimates(35.0, 62.0, 14.0, NASA_35["ball"])}
    cage |= {
        "outside_diameter_mm": 46.5 + 0.38 * 7.14,
        "bore_mm": 46.5 - 0.55 * 7.14,
        "mass_eccentricity_um": 0.0,
    }
    gamma = 7.14 * math.cos(math.radians(24.0)) / 46.5
    radius = 0.5e-3 * cage["bore_mm"] - 1e-3 * cage["land_clearance_mm"]
    slide = 0.5 * (1.0 + gamma) * radius * rpm * RPM  # the cage turns at half of 1 - gamma of the speed
    lands = sheared_viscosity(ester, INLET, slide, CONDUCTIVITY)
    table = "[bearing.cage]\n" + "\n".join(f"{key} = {value}" for key, value in cage.items())
    oil = f'supply = "jet"\ndensity_kg_m3 = {DENSITY}\ntraction_max = 0.04\nland_viscosity_Pa_s = {lands}'
    run = settled(NASA_35, rpm, 667.0, ester(INLET), balls, table, oil)
    return run.get("friction_torque") * rpm * RPM


@pytest.fixture(scope="module")
def heats():
    return {balls: np.array([heat(rpm, balls) for rpm in MEASURED]) for balls in ("GCr15", "Si3N4")}


def test_heat_of_the_35_mm_bearing(heats):
    """The goal, 0.78 to 1.22, is missed by 0.02 at the two high speeds.

    The settled cage whirls at 0.6 to 0.7 of its clearance, so that the lands take 63 to 300 W where they
    would take 47 to 227 W about the middle; with these the ratios are 0.81, 1.06, 1.18 and 1.18. Clearance
    and width of the lands are estimates.
    """
    ratios = heats["GCr15"] / list(MEASURED.values())
    assert ratios == pytest.approx([0.85, 1.13, 1.24, 1.23], abs=0.01)


def test_ceramic_balls_save_what_others_measured(heats):
    """ASME 98/4/553, the same bearing: hybrid over steel 0.80 to 0.90; the goal is 0.82 to 0.92."""
    shares = heats["Si3N4"] / heats["GCr15"]
    assert np.all((shares > 0.82) & (shares < 0.92)), shares
