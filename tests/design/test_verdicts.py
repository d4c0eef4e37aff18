"""Verdicts: at, below and above each limit, and what is not judged."""

import math
from dataclasses import replace
from typing import get_args

import numpy as np
import pytest

from fmu_bearing.accuracy import changed
from fmu_bearing.design import rating as rate
from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.design.verdicts import bearing_verdicts, cautions
from fmu_bearing.formulas import iso281, makers
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.lubricant import Cleanliness
from tests.conftest import EXAMPLES

GOOD, WATCH, CHANGE, NONE = "good", "watch", "change", "not judged"


@pytest.fixture(scope="module")
def hybrid():
    return bearing_at(read_scene(EXAMPLES / "7003C-spindle.toml"))


@pytest.fixture(scope="module")
def steel():
    return bearing_at(read_scene(EXAMPLES / "7009C-steel.toml"))


@pytest.fixture(scope="module")
def ceramic():
    return bearing_at(read_scene(EXAMPLES / "7009C-full-ceramic.toml"))


def bearing_at(scene):
    """The bearing of a scene at its operating point."""
    return operating_point(scene).bearings[0]


def found(point):
    return {one.key: one for one in bearing_verdicts(point)}


def contact(point, **values):
    """The point with other figures at both races."""
    return replace(point, contacts={ring: {**old, **values} for ring, old in point.contacts.items()})


def mounted(point, table="mounting", **values):
    scene = point.scene.replace({f"{table}.{key}": value for key, value in values.items()})
    force = np.array([scene.mounting.preload_N, *point.load.force[1:]])
    return replace(point, scene=scene, load=replace(point.load, force=force))


UP, DOWN = 1.0 + 1e-9, 1.0 - 1e-9


@pytest.mark.parametrize(
    ("pressure", "judgement", "words"),
    [
        (1.5e9 * DOWN, GOOD, ""),
        (1.5e9, GOOD, ""),
        (1.5e9 * UP, WATCH, "above the 1.50 GPa of makers' heaviest preload class"),
        (2.0e9, WATCH, "1.50 GPa"),
        (2.0e9 * UP, CHANGE, "above 2.0 GPa (rule of the field, no standard)"),
        (4.2e9 * UP, CHANGE, "above 4.2 GPa, where races of steel are dented at once (ISO 76)"),
    ],
)
def test_pressure(hybrid, pressure, judgement, words):
    verdict = found(contact(hybrid, pressure_max=pressure))["pressure"]
    assert (verdict.judgement, verdict.value) == (judgement, pressure)
    assert words in verdict.advice and bool(verdict.advice) == (judgement != GOOD)
    assert "GMN" in verdict.source and "no standard" in verdict.source


def test_pressure_of_steel_has_its_own_class_and_of_ceramic_rings_no_limit(steel, ceramic):
    assert found(contact(steel, pressure_max=1.34e9 * UP))["pressure"].judgement == WATCH
    assert "1.34" in found(steel)["pressure"].limit
    # no limit of steel is one of ceramics
    for pressure in (0.97e9, 1.9e9, 4.3e9):
        verdict = found(contact(ceramic, pressure_max=pressure))["pressure"]
        assert (verdict.judgement, verdict.value, verdict.advice) == (NONE, pressure, "")
        assert "races of steel" in verdict.source


@pytest.mark.parametrize(("safety", "judgement"), [(2.0, GOOD), (1.99, WATCH), (1.0, WATCH), (0.99, CHANGE)])
def test_static_safety(hybrid, steel, safety, judgement):
    for point, share in ((hybrid, 0.7), (steel, 1.0)):
        load = share * point.rating.static / safety * DOWN
        verdict = found(replace(point, rating=point.rating._replace(static_load=load)))["static_safety"]
        assert (verdict.judgement, verdict.value) == (judgement, pytest.approx(safety))
        assert ("0.7 C0 for ceramic balls (GMN)" in verdict.source) == (share == 0.7)
    pressed = contact(hybrid, pressure_max=4.2e9 / safety ** (1 / 3) * DOWN)
    assert found(pressed)["static_safety_pressure"].judgement == judgement


def test_static_safety_of_the_designers_case(hybrid):
    """500 N on the 7003C: S0 15.1 for steel, 0.7 of it for ceramic balls; 10.9 from 1.89 GPa."""
    weightless = bearing_at(hybrid.scene.replace({"fidelity.terms.gravity": False}))
    assert found(weightless)["static_safety"].value == pytest.approx(0.7 * 15.1, rel=0.01)
    # 12 N of rotor: P0 grows by 0.5 of it over 0.46 of the preload
    assert found(hybrid)["static_safety"].value < found(weightless)["static_safety"].value
    assert found(contact(hybrid, pressure_max=1.89e9))["static_safety_pressure"].value == pytest.approx(
        10.97, rel=1e-3
    )


def test_life_is_judged_by_what_is_asked_for_or_assumed(hybrid):
    life = found(hybrid)["life"]
    # 1198 h
    assert (life.judgement, life.limit) == (CHANGE, "20000 assumed")
    assert "20000 h that are assumed" in life.advice and "operation.required_life_h" in life.advice
    for turns, judgement in ((20_000.0 * UP, GOOD), (20_000.0 * DOWN, CHANGE)):
        at_limit = replace(hybrid, reference_life=turns * 60.0 * 0.02)  # Mrev at 20,000 r/min
        assert found(at_limit)["life"].judgement == judgement
    for required, judgement in ((life.value * DOWN, GOOD), (life.value * UP, CHANGE)):
        asked = found(mounted(hybrid, "operation", required_life_h=required))["life"]
        assert asked.judgement == judgement
        assert ("that are asked for" in asked.advice) == (judgement == CHANGE)


@pytest.mark.parametrize(("hours", "text"), [(173_970_407.0, "> 1e6"), (1e6, "1000000"), (1013.0, "1013")])
def test_lives_that_say_no_more_are_capped(hybrid, hours, text):
    life = found(replace(hybrid, reference_life=hours * 60.0 * 0.02))["life"]
    assert life.text == text and life.value == pytest.approx(hours)
    basic = replace(hybrid, rating=hybrid.rating._replace(life=hours))
    assert found(basic)["life_basic"].text == text
    shown = "> 1e6 h" if hours > 1e6 else f"{float(f'{hours:.3g}'):,.0f} h"
    assert changed.shown_hours(hours) == shown


@pytest.mark.heavy
@pytest.mark.parametrize("angle", [12.0, 18.0, 20.0, 30.0, 40.0])
def test_no_figure_vanishes_at_other_contact_angles(steel, angle):
    """P and P0 have factors from 14 deg on: below, what needs them says so, and life stays judged."""
    by_key = found(bearing_at(steel.scene.replace({"bearing.contact_angle_deg": angle})))
    assert set(by_key) == set(found(steel))
    for key in ("static_safety", "life_basic", "life_modified"):
        assert (f"14 to 46 deg, not {angle:g}" in by_key[key].source) == (angle < 14.0)
        assert (by_key[key].value is None) == (angle < 14.0)
    assert by_key["life"].judgement != NONE and by_key["static_safety_pressure"].judgement != NONE
    between = 14.0 <= angle <= 26.0
    for key in ("preload_class", "speed"):
        assert (by_key[key].judgement == NONE) == (not between)
        assert between or "contact angle" in by_key[key].source


def test_hybrid_bearings_have_no_modified_life_and_steel_ones_do(hybrid, steel):
    assert "life_modified" not in found(hybrid) and "hybrid: no modified life" in found(hybrid)["life"].source
    modified = found(steel)["life_modified"]
    rating = steel.rating
    factor = iso281.life_modification(steel.viscosity_ratio, "high", rating.static, rating.equivalent, 60.0)
    assert modified.value == pytest.approx(factor * found(steel)["life"].value)
    assert "cleanliness high" in modified.source
    dirty = found(mounted(steel, "lubricant", cleanliness="severe"))["life_modified"]
    assert dirty.value < modified.value and "cleanliness severe" in dirty.source


def test_rings_of_ceramics_have_no_rated_life_and_no_static_safety(ceramic):
    by_key = found(ceramic)
    for key in ("life", "static_safety"):
        assert by_key[key].judgement == NONE and by_key[key].value is None
        assert "standards rate rings of steel only" in by_key[key].source
    assert not {"life_basic", "life_modified", "static_safety_pressure"} & set(by_key)
    # nor do limits that makers of steel and hybrid bearings give, whatever the figure
    fast = found(replace(contact(ceramic, spin_to_roll=1.0), speed_number=9e6, viscosity_ratio=0.1))
    for key in ("pressure", "preload_class", "speed", "kappa", "spin"):
        for verdict in (by_key[key], fast[key]):
            assert (verdict.judgement, verdict.limit, verdict.advice) == (NONE, "none", "")
            assert "steel" in verdict.source
    assert ceramic.speed_limit is None and "with rings of steel" in by_key["least_preload"].source
    other = mounted(ceramic, "materials", outer_ring="GCr15")
    assert other.scene.materials.kind == "other"
    assert found(replace(other, speed_limit=rate.speed_limit(other.scene)))["speed"].judgement == NONE


@pytest.mark.parametrize(
    ("name", "rpm", "ratio"),
    [("7003C-bare", 20_000.0, 1322 / 1200), ("7009C-steel", 12_000.0, 60_085 / 43_393)],
)
def test_reference_life_of_the_designers_cases(name, rpm, ratio):
    """Hybrid, 500 N axially, 20 degC: figures of an independent calculation of loads and life."""
    at = {f"operation.{part}_temperature_degC": 20.0 for part in ("oil", "inner_ring", "outer_ring")}
    point = bearing_at(
        read_scene(EXAMPLES / f"{name}.toml").replace(
            {**at, "operation.speed_rpm": rpm, "mounting.preload_N": 500.0, "materials.balls": "Si3N4"}
        )
    )
    basic = iso281.basic_life(point.rating.dynamic, point.rating.equivalent)
    assert point.reference_life / basic == pytest.approx(ratio, rel=0.01)


def test_wider_grooves_than_those_of_the_rating_are_not_rated(hybrid):
    wide = bearing_at(hybrid.scene.replace({"bearing.inner_conformity": 0.5201}))
    by_key = found(wide)
    assert wide.rating is None and by_key["life"].judgement == NONE
    assert "conformities of 0.52 (inner) and 0.53 (outer)" in by_key["life"].source
    # closer ones do not raise the rating
    close = bearing_at(hybrid.scene.replace({"bearing.inner_conformity": 0.51}))
    assert close.rating.dynamic == hybrid.rating.dynamic


def test_classes_of_cleanliness_are_those_of_the_scene():
    assert tuple(iso281.CLEANLINESS) == get_args(Cleanliness)


def test_friction_torque_is_that_of_a_settled_bearing(hybrid):
    """21.1 N mm in runs of the scene with its imperfections, fidelity full."""
    assert 1e3 * hybrid.friction_torque == pytest.approx(21.1, rel=0.02)
    back = mounted(hybrid, "operation", speed_rpm=-20_000.0)
    assert bearing_at(back.scene).friction_torque == pytest.approx(-hybrid.friction_torque, rel=1e-6)


def test_reference_life_under_a_radial_load_depends_on_the_rings_freedom_to_tilt():
    """7003C, 500 N axially and 300 N radially: 777 Mrev free to tilt at standstill, L10 636 Mrev.

    Friction at 1 r/min, which a ring free to tilt yields to, makes 1.1 % of it.
    """
    at = {f"operation.{part}_temperature_degC": 20.0 for part in ("oil", "inner_ring", "outer_ring")}
    still = {"operation.speed_rpm": 1.0, "operation.lowest_speed_rpm": 1000.0, "materials.balls": "Si3N4"}
    loads = {"mounting.preload_N": 500.0, "mounting.radial_load_z_N": -300.0}
    scene = read_scene(EXAMPLES / "7003C-bare.toml").replace({**at, **still, **loads})
    point = bearing_at(scene)
    assert point.reference_life == pytest.approx(777.0, rel=0.015)
    assert iso281.basic_life(point.rating.dynamic, point.rating.equivalent) == pytest.approx(636.0, rel=0.01)
    assert "inner ring free to tilt" in found(point)["life"].source
    held = {"mounting.tilt_support": {"stiffness_N_m_rad": 1e7, "damping_ratio": 0.05}}
    point = bearing_at(scene.replace({**held, "mounting.pedestal_rotational_ratio_mm2": 1e6}))
    assert point.reference_life == pytest.approx(960.0, rel=0.01)
    assert "inner ring held by tilt_support" in found(point)["life"].source


def test_life_in_turns_knows_no_speed(hybrid):
    slower = mounted(hybrid, "operation", speed_rpm=5000.0)
    assert found(slower)["life"].value == pytest.approx(4.0 * found(hybrid)["life"].value)


@pytest.mark.parametrize(("factor", "judgement"), [(UP, GOOD), (DOWN, CHANGE)])
def test_least_preload(hybrid, factor, judgement):
    verdict = found(mounted(hybrid, preload_N=factor * hybrid.least_preload))["least_preload"]
    assert verdict.judgement == judgement and ("skidding" in verdict.advice) == (judgement == CHANGE)


@pytest.mark.parametrize(
    ("preload", "judgement", "words"),
    [
        # GMN's shares of C: 29.8, 89.4 and 179 N; 10 % slack to the next
        (20.0, GOOD, "up to light"),
        (27.2, GOOD, "light"),
        (32.7, GOOD, "light"),
        (32.9, GOOD, "up to medium"),
        (98.2, GOOD, "medium"),
        (98.5, GOOD, "up to heavy"),
        (179.0, GOOD, "heavy"),
        (196.8, GOOD, "heavy"),
        (197.0, WATCH, "1.1 x heavy"),
    ],
)
def test_preload_class(hybrid, preload, judgement, words):
    verdict = found(mounted(hybrid, preload_N=preload))["preload_class"]
    assert (verdict.judgement, verdict.text, verdict.value) == (judgement, f"{preload:g}: {words}", preload)
    assert verdict.limit == "light 29.8, medium 89.4, heavy 179" and "GMN" in verdict.source
    assert ("of GMN, 179 N: give 179 N or less" in verdict.advice) == (judgement == WATCH)


def test_a_bearing_without_preload_has_no_class(hybrid):
    verdict = found(mounted(hybrid, preload_N=0.0))["preload_class"]
    assert (verdict.judgement, verdict.source) == (NONE, "no preload")


def test_the_designers_finding_is_told(hybrid):
    """500 N on a 7003C is 0.084 C, nearly three times the heavy class."""
    assert any(
        "500 N (0.084 C): 2.8 times the heavy class of GMN" in line
        for line in cautions(operating_point(EXAMPLES / "7003C-spindle.toml"))
    )


@pytest.mark.parametrize(("factor", "judgement"), [(DOWN, GOOD), (UP, CHANGE)])
def test_speed(hybrid, factor, judgement):
    limit = 1.25 * 1.75e6
    assert found(replace(hybrid, speed_number=factor * limit))["speed"].judgement == judgement
    # 500 N is beyond the heavy class: a rigid pair then reaches half the speed
    rigid = mounted(hybrid, preload_mode="rigid")
    assert found(replace(rigid, speed_number=0.5 * factor * limit))["speed"].judgement == judgement
    assert "as a rigid heavy pair" in found(rigid)["speed"].source
    medium = mounted(hybrid, preload_mode="rigid", preload_N=89.4)
    assert found(replace(medium, speed_number=0.7 * factor * limit))["speed"].judgement == judgement
    light = mounted(hybrid, preload_mode="rigid", preload_N=20.0)
    assert found(replace(light, speed_number=0.8 * factor * limit))["speed"].judgement == judgement
    steep = replace(hybrid, speed_limit=None)
    assert found(steep)["speed"].judgement == NONE


@pytest.mark.parametrize(("film", "judgement"), [(3.0, GOOD), (2.99, WATCH), (1.0, WATCH), (0.99, CHANGE)])
def test_film(hybrid, film, judgement):
    verdict = found(replace(hybrid, film=film))["film"]
    assert verdict.judgement == judgement and ("surfaces touch" in verdict.advice) == (judgement != GOOD)


@pytest.mark.parametrize(("kappa", "judgement"), [(1.0, GOOD), (0.99, WATCH), (0.4, WATCH), (0.39, CHANGE)])
def test_viscosity_ratio(hybrid, kappa, judgement):
    verdict = found(replace(hybrid, viscosity_ratio=kappa))["kappa"]
    assert verdict.judgement == judgement and ("ISO 281" in verdict.advice) == (judgement != GOOD)


@pytest.mark.parametrize(("spin", "judgement"), [(0.4, GOOD), (0.401, WATCH)])
def test_spin(hybrid, spin, judgement):
    verdict = found(contact(hybrid, spin_to_roll=spin))["spin"]
    assert verdict.judgement == judgement and "no standard" in verdict.source


@pytest.mark.parametrize(("needed", "judgement"), [(0.02, GOOD), (0.0201, WATCH)])
def test_gyroscopic_slip(hybrid, needed, judgement):
    assert found(replace(hybrid, gyroscopic_friction=needed))["gyroscopic"].judgement == judgement


def test_gyroscopic_friction_of_the_designers_case(hybrid):
    """7003C at 20,000 r/min under 500 N: 0.0010, with the spin axis by outer race control."""
    assert hybrid.gyroscopic_friction == pytest.approx(0.0010, rel=0.25)
    scene = hybrid.scene
    mass = math.pi / 6 * (4.5e-3) ** 3 * scene.materials.balls.density_kg_m3
    inertia = 0.1 * mass * (4.5e-3) ** 2
    orbit = 2.0 * math.pi * hybrid.frequencies.f_c
    spin = 2.0 * math.pi * hybrid.frequencies.f_b
    # the spin axis leans by about the contact angle
    moment = inertia * orbit * spin * math.sin(hybrid.contacts["inner"]["angle_mean"])
    load = np.sum(np.mean(hybrid.ball_loads, axis=1))
    assert hybrid.gyroscopic_friction == pytest.approx(2.0 * moment / (4.5e-3 * load), rel=0.1)


@pytest.mark.parametrize(("margin", "judgement"), [(2.001, GOOD), (1.9, WATCH), (0.0, WATCH), (-0.1, CHANGE)])
def test_shoulder(hybrid, margin, judgement):
    verdict = found(contact(hybrid, shoulder_margin=math.radians(margin)))["shoulder"]
    assert verdict.judgement == judgement and ("shoulder" in verdict.advice) == (judgement != GOOD)


def test_every_verdict_has_limit_and_source(hybrid, steel, ceramic):
    for point in (hybrid, steel, ceramic):
        for one in bearing_verdicts(point):
            assert one.limit and one.source and one.text and one.label
            assert bool(one.advice) == (one.judgement in (WATCH, CHANGE))
            if one.advice:
                assert any(word in one.advice for word in ("GMN", "ISO", "Harris", "no standard", "assumed"))


def test_at_standstill_there_is_no_film_and_no_hours():
    still = {"operation.speed_rpm": 0.0, "operation.lowest_speed_rpm": 1000.0}
    by_key = found(bearing_at(read_scene(EXAMPLES / "7003C-spindle.toml").replace(still)))
    assert not {"life", "life_basic", "film", "kappa"} & set(by_key)
    assert by_key["speed"].judgement == GOOD


def test_fmus_carry_what_is_fixed(hybrid):
    from fmu_bearing.interface import variables

    table = {one.name: one for one in variables(hybrid.scene, 0.0)}
    fixed = {name: one.value for name, one in table.items() if name.startswith("rating.")}
    assert fixed["rating.dynamic"] == pytest.approx(hybrid.rating.dynamic)
    assert fixed["rating.static"] == pytest.approx(0.7 * hybrid.rating.static)
    assert fixed["rating.preload_heavy"] == 179.0  # 0.03 C in three digits, as in the verdict
    assert fixed["rating.pressure_limit"] == makers.CLASS_PRESSURE["hybrid"]
    assert fixed["rating.speed_limit"] * 30 / math.pi == pytest.approx(hybrid.speed_limit / 26.0)
    assert all(table[name].variability == "constant" for name in fixed)
    ceramic = variables(read_scene(EXAMPLES / "7009C-full-ceramic.toml"), 0.0)
    assert not {one.name for one in ceramic if one.name.startswith("rating.")}
    printed = hybrid.scene.replace({"bearing.catalogue": "NSK-7010C"})
    classes = {one.name: one.value for one in variables(printed, 0.0) if ".preload_" in one.name}
    assert classes == {
        "rating.preload_extra_light": 75.0, "rating.preload_light": 150.0, "rating.preload_medium": 390.0,
        "rating.preload_heavy": 780.0,
    }  # fmt: skip
