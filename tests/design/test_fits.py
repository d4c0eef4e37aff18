"""`fits`: five columns computed in full, two seats, sets, numbers of the design page."""

import itertools
import math

import numpy as np
import pytest

from fmu_bearing import SceneError, fits, operating_point
from fmu_bearing.design import fits as study
from fmu_bearing.design.fit_curves import curves
from fmu_bearing.design.fit_table import fit_rows, head
from fmu_bearing.design.fits import SEED, TAKES
from fmu_bearing.design.fresh import new_scene
from fmu_bearing.design.mounted import mounted, with_fit
from fmu_bearing.engine.constants import RPM
from fmu_bearing.instance import EngineError
from fmu_bearing.scene import read_scene, read_scene_text
from fmu_bearing.steady.statics import point
from tests.conftest import EXAMPLES, GATES
from tests.spindle.sets import scene as pair

STEEL = {"youngs_modulus_GPa": 208.0, "poisson_ratio": 0.3, "density_kg_m3": 7800.0, "expansion_1e6_K": 11.8}
SHAFT = {"shaft_class": "js5", "material": STEEL}
HOUSING = {"housing_class": "JS5", "outside_diameter_mm": 60.0, "material": STEEL}
DB = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"


def bearing(rings="GCr15", balls="GCr15", warm=40.0, fit=None, **seats):
    """The page's bearing: 7003C in its spindle, 150 N rigid, 20,000 r/min, on a pedestal that does not give.

    Its figures are of a quasi-static oracle with such a pedestal.
    """
    scene = read_scene(GATES / "7003C-spindle.toml")
    values = {f"materials.{one}": rings for one in ("inner_ring", "outer_ring")}
    values |= {f"operation.{one}_temperature_degC": warm for one in ("oil", "inner_ring", "outer_ring")}
    values |= {
        "materials.balls": balls, "mounting.preload_mode": "rigid", "mounting.preload_N": 150.0,
        "mounting.pedestal_stiffness_N_m": 1e12, "operation.speed_rpm": 20e3,
        "mounting.fit": {"bearing_class": "P4", "preload": "unmounted"} | (fit or {}) | seats,
    }  # fmt: skip
    return scene.replace(values)


def tight(um, **keys):
    return {"interference_um": um, "material": STEEL} | keys


@pytest.fixture(scope="module")
def steel():
    return fits(bearing(shaft=SHAFT))


@pytest.fixture(scope="module")
def both():
    return bearing(shaft=SHAFT, housing=HOUSING)


def running(found):
    return [column.bearings[0].preloads["running"] for column in found.columns]


@pytest.mark.heavy
def test_columns_are_computed_in_full_and_first_order_would_fail(steel):
    """Page: 166, 166, 214, 359, 414 N, by first order 36, 82, 214, 347, 392 N (rounded: 0.5 N)."""
    full = running(steel)
    assert full == pytest.approx([166.0, 166.0, 214.0, 359.0, 414.0], abs=1.0)
    um = [2e6 * one.bearings[0].seats["inner"].states["mounted"].interference for one in steel.columns]
    assert um == pytest.approx([-4.0, 2.0 - math.sqrt(20.0), 2.0, 2.0 + math.sqrt(20.0), 8.0])
    slope = (running(fits(bearing(shaft=tight(2.1))))[0] - running(fits(bearing(shaft=tight(1.9))))[0]) / 0.2
    first = [full[2] + slope * (one - 2.0) for one in um]
    assert first == pytest.approx([36.0, 82.0, 214.0, 347.0, 392.0], abs=4.0)


@pytest.mark.parametrize(
    ("um", "angle", "preload", "stiffness", "life"),
    [
        (1.0, 14.4, 185.0, 110.0, 16_700.0),
        (2.0, 13.8, 214.0, 116.0, 10_500.0),
        (6.5, 10.8, 360.0, 140.0, 2_055.0),
    ],
)  # fmt: skip
def test_what_leaving_the_fit_out_costs(um, angle, preload, stiffness, life):
    """The page's table; it is rounded to 0.1 deg, 1 N, 1 N/um."""
    (one,) = fits(bearing(shaft=tight(um))).column("mean").bearings
    assert math.degrees(one.free_angles["running"]) == pytest.approx(angle, abs=0.06)
    assert one.preloads["running"] == pytest.approx(preload, abs=1.0)
    assert 1e-6 * one.radial_stiffness == pytest.approx(stiffness, abs=1.0)
    assert one.point.life == pytest.approx(life, rel=0.02)


def test_a_loose_ring_grows_by_rotation_alone():
    """The page's row of fit 0 is of rings as drawn, 155 N and 29,300 h: a loose ring still grows, 11 N."""
    drawn = operating_point(bearing(shaft=tight(0.0)).replace({"mounting.fit": None}))
    assert drawn.statics.preloads["running"][0] == pytest.approx(155.0, abs=1.0)
    assert drawn.life == pytest.approx(29_300.0, rel=0.02)
    (one,) = fits(bearing(shaft=tight(0.0))).column("mean").bearings
    assert one.seats["inner"].states["running"].race == pytest.approx(0.154e-6, abs=0.001e-6)
    assert one.preloads["running"] == pytest.approx(166.0, abs=1.0)


def test_a_ceramic_ring_on_a_warm_steel_shaft():
    """Gate 5 of the page: 97 MPa, 423 N, 10.8 deg, and 37 K to slip it on."""
    found = fits(bearing("Si3N4", "Si3N4", 60.0, shaft=tight(2.0, bore_mm=8.0)))
    (one,) = found.column("mean").bearings
    seat = one.seats["inner"]
    assert 1e-6 * seat.states["running"].hoop == pytest.approx(96.77, rel=1e-3)
    assert 1e-6 * seat.states["mounted"].hoop == pytest.approx(24.30, rel=1e-3)
    assert one.preloads["running"] == pytest.approx(423.2, rel=2e-3)
    assert one.preloads["mounted"] == pytest.approx(209.8, rel=2e-3)
    assert math.degrees(one.free_angles["running"]) == pytest.approx(10.797, abs=0.01)
    assert seat.loss_speed / RPM == pytest.approx(416_154, rel=1e-3)
    assert (seat.ring_kelvin, seat.partner_kelvin) == pytest.approx((36.8, 10.0), abs=0.1)
    assert one.point.life is None and seat.breaking is None  # no strength is given


def test_closed_forms_are_those_of_the_engine(both):
    """The state that the engine starts in has the interference, stress, growth and angle of the study."""
    warm = {"operation.inner_ring_temperature_degC": 47.0, "mounting.fit.take": "max"}
    scene = both.replace(warm | {"mounting.fit.shaft.temperature_degC": 44.0})
    own, run = mounted(scene), point(scene).run
    for ring in ("inner", "outer"):
        state = own.at(ring, own.speed)
        assert run.get(f"fit.{ring}.interference") == pytest.approx(2.0 * state.interference, rel=1e-9)
        assert run.get(f"fit.{ring}.pressure") == pytest.approx(state.pressure, rel=1e-9)
        assert run.get(f"fit.{ring}.hoop_stress") == pytest.approx(state.hoop, rel=1e-9)
        assert run.get(f"fit.{ring}.race_growth") == pytest.approx(state.race, rel=1e-9)
    looser = scene.replace({"mounting.fit.take": "mean"})
    there = mounted(looser).free_angle(own.speed)
    assert there > 0.1
    assert point(looser).run.get("contact.free_angle") == pytest.approx(there, abs=1e-6)


def test_given_interferences_are_computed_once(monkeypatch):
    calls = []
    monkeypatch.setattr(study, "operating_point", lambda scene: calls.append(scene) or operating_point(scene))
    found = fits(bearing(shaft=tight(2.0)))
    assert len(calls) == 1 and "all columns are equal" in found.remarks[0]
    assert len(set(running(found))) == 1


def test_two_seats_have_corners_and_a_probable_pair(both):
    found = fits(both)
    assert "draws" in found.remarks[0]
    angles = [column.bearings[0].together.free_angle(20e3 * RPM) for column in found.columns]
    assert angles == sorted(angles, reverse=True)
    for shaft, housing in (("min", "max"), ("max", "min")):  # the other corners are between
        seats = {
            "shaft": both.fit.shaft.model_copy(update=given(found, shaft, "inner", "shaft_class")),
            "housing": both.fit.housing.model_copy(update=given(found, housing, "outer", "housing_class")),
        }
        corner = mounted(with_fit(both, both.fit.model_copy(update=seats)))
        assert angles[-1] <= corner.free_angle(corner.speed) <= angles[0]
    # seats have their own probable interference, narrower figures of both rings need not
    tightest = found.column("probable max").bearings[0]
    own = 2e6 * tightest.seats["inner"].states["mounted"].interference
    assert (
        own == pytest.approx(2.0 + math.sqrt(20.0)) and own > 2e6 * tightest.together.at("inner", 0.0, 0.0)[0]
    )


def given(found, take, ring, key):
    seat = found.column(take).bearings[0].seats[ring]
    return {"interference_um": 1e6 * seat.drawn, key: None}


@pytest.mark.heavy
def test_as_many_draws_as_of_three_sigma_lie_beyond_the_probable_pairs(both):
    """0.135 % of draws of their own: 270 of 200,000, +-16 by chance; the pairs are from 27 of 20,000, +-5."""
    classes = {"shaft.shaft_class": "k5", "housing.housing_class": "K5", "bearing_class": "P5"}
    found = fits(both.replace({f"mounting.fit.{key}": value for key, value in classes.items()}))
    draw = np.random.default_rng(SEED + 7)

    def part(low, high):
        return draw.normal(0.5 * (low + high), (high - low) / 6.0, 200_000)

    um = {
        "inner": part(1.0, 9.0) - part(-5.0, 0.0),  # k5 and the bore of P5, 17 mm
        "outer": part(-7.0, 0.0) - part(-9.0, 2.0),  # outside of P5 and K5, 35 mm
    }

    def squeeze(mounted_with):
        """By both races, in the state of the scene, with interferences (um) by ring."""
        total = 0.0
        for ring, one in mounted_with.items():
            fit = found.columns[2].bearings[0].apart.seats[ring].fit
            still = fit.at(0.0, 20e3 * RPM, 313.15, 313.15).interference
            total = total + abs(fit.share) * np.maximum(0.0, still + 0.5e-6 * one)
        return total

    drawn = squeeze(um)
    for take, sign in (("probable min", -1.0), ("probable max", 1.0)):
        probable = found.column(take).bearings[0].together
        own = squeeze({ring: 2e6 * seat.interference for ring, seat in probable.seats.items()})
        assert own > 0.0
        assert np.mean(sign * drawn > sign * own) == pytest.approx(0.00135, abs=0.0006)


@pytest.mark.heavy
@pytest.mark.parametrize("number", [1, 2])
def test_a_set_has_each_bearing_and_its_own_interference(number):
    fit = {"spindle.fit": {"bearing_class": "P4", "preload": "unmounted", "shaft": {"shaft_class": "js5"}}}
    scene = read_scene(DB).replace(fit | {f"spindle.bearing[{number}].shaft_interference_um": 3.0})
    found = fits(scene)
    first, second = ([column.bearings[k] for column in found.columns] for k in (2 - number, number - 1))
    assert first[0].preloads["running"] < first[2].preloads["running"] < first[4].preloads["running"]
    assert [1e6 * one.seats["inner"].drawn for one in second] == pytest.approx([3.0] * 5)
    assert [1e6 * one.seats["inner"].drawn for one in first][::2] == pytest.approx([-4.0, 2.0, 8.0])
    assert first[2].preloads["drawing"] == second[2].preloads["drawing"] == 150.0
    assert first[2].point.scene.mounting.preload_N == 150.0  # classes are of the loose bearing
    for one in (first[2], second[2]):  # without load both carry the same
        assert one.preloads["running"] == pytest.approx(first[2].preloads["running"], rel=1e-6)
    run = point(found.column("mean").point.scene).run
    for k, one in zip((3 - number, number), (first[2], second[2]), strict=True):
        assert run.get(f"bearing[{k}].contact.free_angle") == pytest.approx(
            one.free_angles["running"], abs=1e-6
        )


@pytest.mark.heavy
def test_a_probable_pair_is_of_the_classes_although_one_bearing_has_its_own():
    fit = {"bearing_class": "P4", "preload": "unmounted"}
    fit |= {"shaft": {"shaft_class": "js5"}, "housing": HOUSING}
    scene = read_scene(DB).replace({"spindle.fit": fit})
    own = scene.replace({"spindle.bearing[1].shaft_interference_um": 7.0})
    pairs = [
        fits(one).column("probable min").bearings[1].together.seats["inner"].interference
        for one in (scene, own)
    ]
    assert pairs[0] == pairs[1] < 1e-6


def test_a_set_of_one_is_the_single_bearing():
    fit = {"bearing_class": "P4", "shaft": SHAFT | {"bore_mm": 0.0}}
    keys = {"signs": "+", "positions": (40.0,), "preload": None, "rpm": 12e3, "fit": fit}
    of_one = fits(pair(load={"force_x_N": 500.0, "position_mm": 0.0}, **keys))
    cold = {f"operation.{key}_temperature_degC": 20.0 for key in ("oil", "inner_ring", "outer_ring")}
    single = fits(
        read_scene(GATES / "7003C-bare.toml").replace(
            cold
            | {
                "operation.speed_rpm": 12e3, "mounting.preload_N": 500.0, "mounting.fit": fit,
                "fidelity.race_control": "outer", "fidelity.terms.gravity": False,
            }
        )
    )  # fmt: skip
    for column, other in zip(of_one.columns, single.columns, strict=True):
        (ours,), (theirs,) = column.bearings, other.bearings
        for key, state in ours.seats["inner"].states.items():
            assert state == pytest.approx(theirs.seats["inner"].states[key], rel=1e-12)
        assert ours.free_angles == pytest.approx(theirs.free_angles, rel=1e-12)
        # one solves for the force within 1e-8 of it, the other for the place
        assert ours.radial_stiffness == pytest.approx(theirs.radial_stiffness, rel=1e-5)
        assert ours.point.life == pytest.approx(theirs.point.life, rel=1e-5)


def test_numbers_for_machines(steel):
    document = steel.summary()
    assert [one["take"] for one in document["columns"]] == list(TAKES)
    (mean,) = document["columns"][2]["bearings"]
    assert mean["seats"]["inner"]["interference_m"]["drawn"] == pytest.approx(2e-6)
    assert mean["preload_N"]["drawing"] == 150.0
    assert mean["seats"]["inner"]["loss_speed_rpm"] == pytest.approx(52_112, rel=1e-3)


def test_a_measured_preload_has_no_drawing():
    (one,) = fits(bearing(fit={"preload": "mounted"}, shaft=tight(2.0))).column("mean").bearings
    assert list(one.preloads) == ["mounted", "warm", "running"]
    assert one.preloads["mounted"] == pytest.approx(150.0, rel=1e-3)


@pytest.mark.heavy
def test_roughness_is_between_drawn_and_mounted():
    rough = SHAFT | {"roughness_Rz_um": 2.0}
    seat = fits(bearing(shaft=rough)).column("mean").bearings[0].seats["inner"]
    assert 1e6 * seat.drawn == pytest.approx(2.0)
    assert 2e6 * seat.states["mounted"].interference == pytest.approx(2.0 - 0.4 * 2.0)


@pytest.mark.parametrize(("file", "table"), [(GATES / "7003C-bare.toml", "mounting"), (DB, "spindle")])
def test_a_scene_without_a_fit_is_refused_with_the_table(file, table):
    with pytest.raises(SceneError, match=rf"has no fit.*add \[{table}.fit\] with \[{table}.fit.shaft\]"):
        fits(file)


def test_a_preload_that_warmth_takes_away_takes_no_other_column():
    """NSK-7003AC, Si3N4 ring and balls in ZrO2, 90 N rigid as given loose, warm by 60 K, 25,000 r/min.

    Warm and still the balls are loose by 3.7 um along the axis; at speed `full` has 27.0 N, an independent
    model 26.8 N.
    """
    text = new_scene("warm", "NSK-7003AC", kind="hybrid", speed_rpm=25e3, preload_N=90.0)
    warm = read_scene_text(text, "warm.toml").replace(
        {
            "materials.inner_ring": "Si3N4", "materials.outer_ring": "ZrO2", "mounting.preload_mode": "rigid",
            **{f"operation.{one}_temperature_degC": 80.0 for one in ("oil", "inner_ring", "outer_ring")},
            "mounting.fit": {
                "bearing_class": "P4", "preload": "unmounted",
                "shaft": tight(-1.0, temperature_degC=80.0),
                "housing": {
                    "interference_um": 8.0, "outside_diameter_mm": 60.0, "material": "aluminium",
                    "temperature_degC": 70.0,
                },
            },
        }
    )  # fmt: skip
    found = fits(warm)
    one = found.columns[0].bearings[0]
    # N: rounding of a place that is held over a stiffness
    assert one.preloads["warm"] == pytest.approx(0.0, abs=1e-9)
    assert one.preloads["running"] == pytest.approx(26.8, rel=0.02)
    # held at 20 degC under 258 N; 60 K of both rings and their fits move the touching place by this much
    assert one.gaps == {"warm": pytest.approx(3.7e-6, abs=0.05e-6)}
    assert ["balls loose by, um, warm", *5 * ["3.7"]] in fit_rows(found, 1)
    assert any("warm, the rigid preload is lost: balls are loose by 3.7 um" in said
               for said in operating_point(warm).statics.cautions())  # fmt: skip


def test_a_fit_without_an_equilibrium_takes_no_other_column(monkeypatch):
    """20 N rigid as given loose, 20 to 54 K warm: the loosest shaft leaves loose balls."""
    text = new_scene("cool", "NSK-7003AC", kind="hybrid", speed_rpm=1e3, preload_N=20.0)
    seats = {
        "shaft": {"shaft_class": "js5", "material": STEEL, "temperature_degC": 62.0},
        "housing": {
            "interference_um": 0.0, "outside_diameter_mm": 60.0, "material": STEEL, "temperature_degC": 62.0,
        },
    }  # fmt: skip
    warm = read_scene_text(text, "cool.toml").replace(
        {
            "materials.outer_ring": "ZrO2", "mounting.preload_mode": "rigid",
            **{f"operation.{one}_temperature_degC": 62.0 for one in ("oil", "inner_ring", "outer_ring")},
            "mounting.fit": {"bearing_class": "P4", "preload": "unmounted"} | seats,
        }
    )  # fmt: skip
    loose = fits(warm)
    assert ["balls loose by, um, warm", "0.6", "0.6", "", "", ""] in fit_rows(loose, 1)

    points = itertools.cycle([None, None, *(column.point for column in loose.columns[2:])])

    def without_loose(scene):
        if (point := next(points)) is None:
            raise EngineError("no quasi-static equilibrium")
        return point

    monkeypatch.setattr(study, "operating_point", without_loose)
    found = fits(warm)
    assert [one.take for one in found.columns] == ["mean", "probable max", "max"]
    assert head(found) == ("", "mean", "prob. max", "max")
    lost = next(one for one in found.remarks if one.startswith("no column: "))
    assert "no quasi-static equilibrium" in lost and "at the min interference" in lost
    with pytest.raises(EngineError, match="no column"):
        curves(found)
