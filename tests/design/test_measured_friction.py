"""Friction against others' values, nothing fitted: SKF's model of a 7210B, heat of NASA's 35 mm bearing.

Constants of rolling, hysteresis and traction come from their own sources (`docs/theory.md`). Both bearings,
and what the sources leave open, are those of the page `Measured by others` (`benchmarks.measured.friction`);
`tests/test_measured.py` has the goals.
"""

import math
from statistics import median

import numpy as np
import pytest

from benchmarks.measured import friction, parts
from benchmarks.measured.sources import of
from fmu_bearing import operating_point
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import C, S
from fmu_bearing.scene import si
from fmu_bearing.steady.rest import started
from tests.oracles.friction import petroff_moment, sheared_viscosity

pytestmark = pytest.mark.filterwarnings("ignore:the ellipse of the most loaded contact")

POINTS = of("skf")
SPEEDS = of("tp2275")


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


def test_values_of_the_7210b_are_of_skfs_model():
    """Each is printed to 0.1 N mm; a program of others has the first and the last."""
    assert len(POINTS) == 27
    for one in POINTS:
        assert skf(one.speed_rpm, one.load_N, one.viscosity_mm2_s) == pytest.approx(one.published, abs=0.06)


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("words", "middle", "count"),
    [
        ("EHL force of 1987 alone", 0.792, 12),
        ("with the change to rigid surfaces", 0.864, 17),
        ("flooded inlets, K_rs 6e-8", 1.175, 16),
        ("with hysteresis: as assumed now", 0.907, 25),
    ],
)
def test_what_each_part_is_worth(words, middle, count):
    ratios = parts.ratios_7210b(parts.PARTS_7210B[words])
    assert median(ratios) == pytest.approx(middle, abs=0.005) and parts.within(ratios) == count
    if not parts.PARTS_7210B[words]:
        # light load in thick oil: rigid surfaces, 1.42 and 1.37 times SKF's
        outside = [one for one, ratio in zip(POINTS, ratios, strict=True) if not 0.8 < ratio < 1.25]
        assert [(one.viscosity_mm2_s, one.load_N, one.speed_rpm) for one in outside] == [
            (100.0, 500.0, 1500.0), (100.0, 500.0, 3000.0),
        ]  # fmt: skip
        assert max(ratios) < 1.45


def test_both_bearings_have_the_supply_of_their_source():
    old, jets = friction.at_7210b(POINTS[0]).lubricant, friction.at_35(SPEEDS[0]).lubricant
    assert (old.law_of_rolling, old.replenishment, old.largest_traction) == ("starved", 6e-8, 0.05)
    assert (jets.law_of_rolling, jets.replenishment, jets.largest_traction) == ("flooded", 3e-8, 0.04)


def test_oil_of_the_rig_has_its_viscosity_at_the_inlet():
    """4 mm2/s at 394 K with the slope of esters, 27.6 at 40 and 5.1 mm2/s at 100 degC."""
    assert friction.ester(27.6, 313.15, 373.15) == pytest.approx(5.1, rel=1e-12)
    for moved, there in (
        ({}, 4.0),
        ({"operation.oil_temperature_degC": 100.0}, friction.ester(4.0, 394.0, 373.15)),
    ):
        (found,) = operating_point(friction.at_35(SPEEDS[0], moved)).bearings
        assert found.viscosity == pytest.approx(there, rel=1e-9)


def land_viscosity(scene):
    """Pa s, of the engine."""
    return started(scene, fidelity="response").s[S.C + C.LAND_VISCOSITY]


def test_lands_have_the_oil_of_the_jets_heated_by_its_own_shear():
    """The speed of an ideal cage: half of 1 + gamma of the inner ring's."""
    for one in SPEEDS:
        scene = friction.at_35(one)
        gamma = 7.14 * math.cos(math.radians(24.0)) / 46.5
        land = 0.5e-3 * scene.bearing.cage.bore_mm - 1e-3 * scene.bearing.cage.land_clearance_mm
        slide = 0.5 * (1.0 + gamma) * land * one.speed_rpm * RPM
        heated = sheared_viscosity(
            lambda kelvin: 860e-6 * friction.ester(4.0, 394.0, kelvin), 394.0, slide, 0.14
        )
        assert land_viscosity(scene) == pytest.approx(heated, rel=1e-9)


@pytest.mark.parametrize(
    ("moved", "low", "high"),
    [
        (friction.MOVES_35["viscosity 0.7 times"], 0.7, 0.72),
        (friction.MOVES_35["no oil in the lands"], 0.0, 0.0),
    ],
)
def test_lands_follow_the_oil_unless_they_are_given_one(moved, low, high):
    usual, other = (land_viscosity(friction.at_35(SPEEDS[0], one)) for one in ({}, moved))
    assert low * usual <= other <= high * usual


def test_losses_go_to_the_parts_that_are_of_the_material():
    def losses(kind, moved):
        parts = friction.at_35(SPEEDS[0], friction.MOVES_35[moved], kind).materials
        return [one.loss for one in (parts.inner_ring, parts.outer_ring, parts.balls)]

    assert losses("steel", "hysteresis loss 0.04") == [0.04, 0.04, 0.04]
    assert losses("hybrid", "hysteresis loss 0.04") == [0.04, 0.04, 0.0]
    assert losses("steel", "ceramic with the loss of steel") == [0.021] * 3
    assert losses("hybrid", "ceramic with the loss of steel") == [0.021] * 3


@pytest.mark.heavy
def test_heat_of_the_35_mm_bearing():
    """The goal, 0.78 to 1.22, is missed by 0.02 at the two high speeds.

    The settled cage whirls at 0.6 to 0.7 of its clearance, so that the lands take more than they would about
    the middle, with which the ratios are within the goal. Clearance and width of the lands are estimates.
    """
    ratios = np.array([friction.heat_35(one) / one.published for one in SPEEDS])
    assert ratios == pytest.approx([0.855, 1.131, 1.237, 1.233], abs=0.01)
    for one in SPEEDS:
        scene = friction.at_35(one)
        run = started(scene, fidelity="full")
        assert 0.58 < run.get("cage.whirl_radius") / si(scene.bearing.cage).land_clearance < 0.7
        cage = si(scene.bearing.cage)
        lands = petroff_moment(
            land_viscosity(scene), 0.5 * cage.bore - cage.land_clearance,
            cage.width - cage.pocket_diameter, cage.land_clearance,
            turning := one.speed_rpm * RPM * (1.0 - run.get("cage.speed_ratio")),
        ) * turning  # fmt: skip
        heat = friction.heats_35(one)
        middle = heat.total - heat.cage + lands
        assert friction.centred_35(one, "steel") == pytest.approx(middle, rel=1e-3)
        assert 0.78 < middle / one.published < 1.22 and middle < heat.total
