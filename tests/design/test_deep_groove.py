"""Ratings, equivalent loads, verdicts and cautions of deep groove bearings."""

import math
import warnings

import numpy as np
import pytest

from fmu_bearing import SceneError, operating_point, read_scene, verdicts
from fmu_bearing.accuracy.alternatives import alternatives
from fmu_bearing.cautions import cautions
from fmu_bearing.design.fits import fits
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import P, U
from fmu_bearing.formulas import iso76, iso281, makers
from fmu_bearing.instance import Instance
from fmu_bearing.interface.inputs import inputs_of
from fmu_bearing.prepare.model import pack, prepare
from fmu_bearing.prepare.surfaces import mean_patches
from fmu_bearing.scene.read import catalogue
from tests.conftest import EXAMPLES

#: Balls, their diameter, bore and outside diameter (mm); C and C0 (N) that NSK prints.
PRINTED = {
    "6000": (7, 4.762, 10.0, 26.0, 4550.0, 1970.0),
    "6203": (8, 6.747, 17.0, 40.0, 9550.0, 4800.0),
    "6204": (8, 7.938, 20.0, 47.0, 12800.0, 6600.0),
    "6205": (9, 7.938, 25.0, 52.0, 14000.0, 7850.0),
    "6008": (12, 7.938, 40.0, 68.0, 16800.0, 11500.0),
    "6308": (8, 15.081, 40.0, 90.0, 40500.0, 24000.0),
}


@pytest.fixture(scope="module")
def motor():
    """A 6205 of steel under 500 N downwards at 1,500 r/min."""
    scene = read_scene(EXAMPLES / "7003C-bare.toml")
    steel = dict.fromkeys(("materials.inner_ring", "materials.outer_ring", "materials.balls"), "GCr15")
    return scene.replace(
        {
            "bearing.catalogue": "6205", **steel, "sound": None, "imperfections": None,
            "fidelity.model": "full", "mounting.preload_N": 0.0, "mounting.radial_load_z_N": -500.0,
            "operation.speed_rpm": 1500.0,
            "mounting.tilt_support": {"stiffness_N_m_rad": 4e4, "damping_ratio": 0.05},
        }
    )  # fmt: skip


@pytest.mark.parametrize("name", PRINTED)
def test_ratings_are_those_printed(name):
    balls, ball, bore, outside, dynamic, static = PRINTED[name]
    size = (balls, ball, 0.5 * (bore + outside), 0.0)
    # three digits are printed, and balls are standard ones
    assert iso281.dynamic_rating(*size) == pytest.approx(dynamic, rel=0.01)
    assert iso76.static_rating(*size) == pytest.approx(static, rel=0.01)
    entry = catalogue("bearings")[name]
    assert (entry["ball_count"], entry["ball_diameter_mm"]) == (balls, ball)


def test_equivalent_loads_by_hand():
    """ISO 281 and ISO 76 at 0 deg: below e, beyond it at a row, between two rows, axial alone."""
    # f0 Fa/C0 of 0.345: e 0.22
    assert iso281.equivalent_load(0.0, 0.345, 20.0, 100.0) == 100.0
    assert iso281.equivalent_load(0.0, 0.345, 50.0, 100.0) == pytest.approx(56.0 + 1.99 * 50.0)
    # 0.86: halfway from 1.71 to 1.55
    assert iso281.equivalent_load(0.0, 0.8595, 50.0, 100.0) == pytest.approx(56.0 + 1.63 * 50.0)
    assert iso281.equivalent_load(0.0, 20.0, 50.0, 0.0) == pytest.approx(50.0)  # the table ends at Y 1.00
    for axial, radial, wanted in (
        (0.0, 100.0, 100.0),
        (50.0, 100.0, 100.0),
        (200.0, 100.0, 160.0),
        (200.0, 0.0, 100.0),
    ):
        assert iso76.static_load(0.0, axial, radial) == pytest.approx(wanted)
    # an angular contact bearing between 0 and 14 deg still has no factors
    assert iso281.factors(5.0, 0.3) is None and iso76.axial_factor(5.0) is None


def test_life_and_verdicts_at_a_radial_load(motor):
    point = operating_point(motor)
    (one,) = point.bearings
    radial = 500.0 + 9.81 * pack(motor, np.empty(0))[P.INNER_MASS]
    assert one.radial == pytest.approx(radial) and one.axial == 0.0
    assert one.rating.equivalent == one.rating.static_load == pytest.approx(radial)
    assert one.rating.life == pytest.approx((one.rating.dynamic / radial) ** 3 * 1e6 / 60.0 / 1500.0)
    # ISO 16281 over ISO 281, for a loaded zone of less than half of the circle
    assert 0.4 < one.life / one.rating.life < 1.1
    judged = {verdict.key: verdict for verdict in verdicts(point)}
    assert judged["least_preload"].label == "load over skidding, N"
    nu = one.viscosity
    assert one.least_preload == pytest.approx(25.0 * (1.5 * nu) ** (2.0 / 3.0) * 0.385**2)
    assert judged["least_preload"].judgement == "good" and "preload_class" not in judged
    light = motor.replace({"mounting.radial_load_z_N": -1.0})
    judged = {verdict.key: verdict for verdict in verdicts(operating_point(light))}
    assert judged["least_preload"].judgement == "change"
    assert "give more load or an axial preload" in judged["least_preload"].advice


def test_axial_load_counts_either_way(motor):
    ratings = [
        operating_point(motor.replace({"mounting.preload_N": sign * 300.0})).bearings[0]
        for sign in (1.0, -1.0)
    ]
    for one in ratings:
        assert one.axial == pytest.approx(300.0, rel=1e-6)
        relative = iso76.static_factor(7.938 / 38.5) * 300.0 / one.rating.static
        assert one.rating.equivalent == pytest.approx(
            iso281.equivalent_load(0.0, relative, 300.0, one.radial)
        )
    assert ratings[0].life == pytest.approx(ratings[1].life, rel=1e-6)


def test_ranges_follow_the_static_rating(motor):
    """XJTU-SY loads bearings of a 6205's size with 12 kN; axial forces reach as far both ways."""
    assert motor.replace({"mounting.radial_load_z_N": 12e3, "mounting.preload_N": -5e3})
    rows = {one.name: one for one in inputs_of(motor)}
    assert (rows["preload"].min, rows["preload"].max) == (-16e3, 16e3)
    assert (rows["radial_load.z"].min, rows["radial_load.z"].max) == (-16e3, 16e3)
    angular = read_scene(EXAMPLES / "7003C-bare.toml")
    with pytest.raises(SceneError, match=r"mounting.preload_N = -1.0 is refused; allowed: 0 to 1\d*"):
        angular.replace({"mounting.preload_N": -1.0})


def test_starvation_takes_the_constant_of_deep_groove_bearings(motor):
    found = pack(motor, np.empty(0))[P.STARVATION]
    constant = motor.lubricant.replenishment
    assert found == pytest.approx(constant * (25.0 + 52.0) * math.sqrt(3.1 / (2.0 * (52.0 - 25.0))))


def test_cautions_ask_for_a_load_and_not_for_a_preload(motor):
    with warnings.catch_warnings():
        warnings.simplefilter("error")  # none with a radial load alone
        Instance(prepare(motor)).initialise()
    texts = [one.before + one.after for one in cautions(prepare(motor))]
    assert not any(text.startswith("preload =") for text in texts)
    idle = motor.replace({"mounting.radial_load_z_N": 0.0, "fidelity.terms.gravity": False})
    with pytest.warns(UserWarning, match="the bearing is unloaded; .* give it a load, or a preload"):
        Instance(prepare(idle)).initialise()
    hot = motor.replace({"operation.inner_ring_temperature_degC": 120.0})
    with pytest.warns(
        UserWarning, match=r"leave a radial clearance of -\d+.\d um, so that balls are pressed"
    ):
        Instance(prepare(hot)).initialise()


def test_seats_are_judged_by_the_clearance_left(motor):
    fit = {"preload": "unmounted", "shaft": {"interference_um": 12.0, "material": "GCr15", "long": True}}
    fitted = motor.replace({"mounting.fit": fit})
    (point,) = fits(fitted).columns[0].bearings
    (judged,) = (one for one in verdicts(point_of(fitted)) if one.key == "clearance")
    left = point.together.clearance(1500.0 * RPM)
    assert judged.value == pytest.approx(left, abs=1e-12) and judged.judgement == "good"
    assert math.cos(point.free_angles["drawing"]) == pytest.approx(1.0 - 0.5 * 12.5e-3 / (0.05 * 7.938))
    tight = motor.replace({"mounting.fit": fit | {"shaft": fit["shaft"] | {"interference_um": 40.0}}})
    (judged,) = (one for one in verdicts(point_of(tight)) if one.key == "clearance")
    assert judged.judgement == "change" and "looser fits, or a larger clearance" in judged.advice


def point_of(scene):
    """The operating point of a scene whose warnings are known."""
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        return operating_point(scene)


def test_what_to_change_is_the_clearance(motor):
    words = [one.words for one in alternatives(motor) if one.topic in ("clearance", "contact angle")]
    assert words == ["clearance CN -> C2", "clearance CN -> C3", "clearance CN -> C4"]
    for one in alternatives(motor):
        if one.topic == "clearance":
            assert motor.replace(one.values).bearing.clearance == one.values["bearing.clearance"]


def test_waves_are_filtered_over_loaded_contacts(motor):
    """The mean load over the balls of a radial load F is 1.216 F/Z: at rest a contact's width follows it."""
    (inner, _), (none, _) = (
        mean_patches(scene) for scene in (motor, motor.replace({"mounting.radial_load_z_N": 0.0}))
    )
    assert none.half_width == 0.0 < inner.half_width
    double = mean_patches(motor.replace({"mounting.radial_load_z_N": -1000.0}))[0]
    assert double.half_width / inner.half_width == pytest.approx(2.0 ** (1.0 / 3.0))


def test_no_maker_class_and_no_limit_of_spindles(motor):
    assert makers.speed_limit(motor.bearing.nominal_angle_deg, False) is None
    assert motor.bearing.nominal_angle == 0.0 and motor.bearing.free_angle_deg == pytest.approx(10.2, abs=0.1)
    assert prepare(motor).inputs[U.PRELOAD] == 0.0
