"""Conformities from a printed stiffness: forward and back, another maker's values, scenes, refusals."""

import numpy as np
import pytest

from benchmarks.measured.stiffness import kept, size_of
from fmu_bearing import Dimensions, conformity_from_stiffness, new_scene, read_scene, statics
from fmu_bearing.formulas.axial import StiffnessRange, axial, axial_stiffness, conformities
from fmu_bearing.scene import SceneError, read_scene_text
from fmu_bearing.scene.origins import origins
from tests.conftest import EXAMPLES

STEEL, CERAMIC = (208e9, 0.3), (310e9, 0.26)
OWN = Dimensions(40.0, 68.0, 15.0)


def own(**given):
    """Return a scene of a 7008 from its dimensions."""
    return read_scene_text(
        new_scene("own", OWN, kind="steel", sound=False, speed_rpm=100.0, preload_N=125.0, **given)
    )


@pytest.mark.parametrize("offset", [0.0, 0.005, -0.01])
@pytest.mark.parametrize("of", ["pair", "bearing"])
@pytest.mark.parametrize("kind", ["steel", "hybrid", "full-ceramic"])
def test_the_forward_computation_returns_the_stiffness(kind, of, offset):
    scene = read_scene_text(
        new_scene("own", OWN, kind=kind, sound=False, speed_rpm=1e4, preload_N=300.0)
    )  # fmt: skip
    b = scene.bearing
    elastic = [
        (1e9 * one.youngs_modulus_GPa, one.poisson_ratio)
        for one in (scene.materials.inner_ring, scene.materials.outer_ring, scene.materials.balls)
    ]
    for stiffness, load in ((42.0, 100.0), (75.0, 500.0)):
        each = stiffness if of == "pair" else 0.5 * stiffness
        found = conformity_from_stiffness(scene, each, load, of=of, offset=offset)
        assert found.outer - found.inner == pytest.approx(offset, abs=1e-15)
        bearing = axial(
            b.ball_count, b.ball_diameter_mm, b.pitch_diameter_mm, b.contact_angle_deg, found, elastic
        )
        assert axial_stiffness(bearing, load) == pytest.approx(0.5 * stiffness, rel=1e-6)


def test_another_makers_pairs_give_one_number():
    """TPI prints two or three digits: 1 to 4 % of a small stiffness, which are 0.001 to 0.004."""
    found = []
    for one in kept("tpi", "pair axial stiffness"):
        size, balls = size_of(one), CERAMIC if one.balls == "Si3N4" else STEEL
        inner, outer = conformities(
            0.5 * one.published, one.load_N, size.balls, size.ball, size.pitch, size.angle,
            (STEEL, STEEL, balls),
        )  # fmt: skip
        assert inner == outer
        found.append(inner)
    assert len(found) == 168
    assert np.median(found) == pytest.approx(0.522, abs=5e-4) and np.std(found) < 1.5e-3


def test_a_scene_made_with_it_has_this_stiffness():
    """By the engine's statics of a pair, which share no code with the fit."""
    text = new_scene(
        "pair", "NSK-7008C", kind="steel", sound=False, speed_rpm=100.0, preload_N=125.0, arrangement="DB",
        stiffness_N_um=53.0, stiffness_preload_N=125.0,
    )  # fmt: skip
    cold = {f"operation.{one}_temperature_degC": 20.0 for one in ("oil", "inner_ring", "outer_ring")}
    found = statics(read_scene_text(text).replace(cold))
    assert 1e-6 * found.axial_stiffness == pytest.approx(53.0, rel=5e-4)


@pytest.mark.parametrize("bearing", ["NSK-7008C", OWN])
def test_a_new_scene_says_that_its_conformities_are_fitted(bearing, tmp_path):
    path = tmp_path / "fitted.toml"
    given = {"kind": "steel", "sound": False, "speed_rpm": 9e3, "preload_N": 300.0}
    usual = read_scene_text(new_scene("a", bearing, **given)).bearing
    text = new_scene("fitted", bearing, **given, stiffness_N_um=53.0, stiffness_preload_N=125.0)
    path.write_text(text, "utf-8")
    fitted = read_scene(path).bearing
    offsets = [one.outer_conformity - one.inner_conformity for one in (fitted, usual)]
    assert offsets[0] == pytest.approx(offsets[1], abs=2e-6) and fitted != usual
    found = {one.key: one for one in origins(path)}
    for race in ("inner", "outer"):
        one = found[f"bearing.{race}_conformity"]
        assert one.assumed and one.origin == "file"
        assert one.remark == "fitted to the stiffness given, 53 N/um of a pair at 125 N"


def test_a_preload_by_offset_follows_the_fitted_grooves():
    """Bearings that all carry one way: their force is that of the offset with these grooves."""
    given = {"kind": "steel", "sound": False, "speed_rpm": 9e3, "preload_offset_um": 8.0}
    fit = {"stiffness_N_um": 70.0, "stiffness_preload_N": 125.0}
    alone = read_scene_text(new_scene("a", "NSK-7008C", **given, **fit))
    tandem = read_scene_text(new_scene("a", "NSK-7008C", **given, **fit, arrangement="DT"))
    assert tandem.spindle.load.force_x_N == pytest.approx(2.0 * alone.mounting.preload_N)


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ((500.0, 125.0), r"500 N/um of a pair at 125 N is refused: conformities of 0.505 to 0.6 give 33"),
        ((1.0, 125.0), r"give 33\.\d+ to 94\.\d+ N/um with 16 balls of 8.12 mm at 15 deg \(steel\); check"),
        ((0.0, 125.0), "stiffness 0.0 N/um is refused: allowed are positive finite numbers"),
        ((53.0, float("nan")), "preload nan N is refused"),
        ((53.0, -1.0), "preload -1.0 N is refused"),
        (("53", 125.0), "stiffness '53' N/um is refused"),
    ],
)
def test_what_no_groove_gives_is_refused_with_the_range(given, words):
    with pytest.raises(SceneError, match=words):
        conformity_from_stiffness(own(), *given)


def test_other_refusals():
    with pytest.raises(SceneError, match="of a pair or a bearing, not of 'trio'"):
        conformity_from_stiffness(own(), 53.0, 125.0, of="trio")
    with pytest.raises(SceneError, match="offset 0.2 of the outer conformity is refused: allowed are less"):
        conformity_from_stiffness(own(), 53.0, 125.0, offset=0.2)
    with pytest.raises(SceneError, match="give stiffness_N_um and stiffness_preload_N together"):
        own(stiffness_N_um=53.0)
    with pytest.raises(SceneError, match="none.toml: there is no such scene file"):
        conformity_from_stiffness("none.toml", 53.0, 125.0)


def test_the_range_is_what_the_ends_give():
    shape = (12, 4.5, 26.0, 15.0, (STEEL, STEEL, STEEL))
    with pytest.raises(StiffnessRange) as problem:
        conformities(1.0, 40.0, *shape)
    for stiffness, inner in ((problem.value.least, 0.6), (problem.value.most, 0.505)):
        assert conformities(stiffness, 40.0, *shape) == pytest.approx((inner, inner), abs=1e-9)


def test_a_path_serves_as_a_scene():
    path = EXAMPLES / "7003C-spindle.toml"
    assert conformity_from_stiffness(path, 25.0, 40.0) == conformity_from_stiffness(
        read_scene(path), 25.0, 40.0
    )


@pytest.mark.parametrize("part, other", [("inner", "0.52"), ("outer", "0.526")])
def test_a_remark_loses_its_mark_and_the_sign_after_it(part, other, tmp_path):
    """`scene show` and the report print "assumed: " before it: no ": ;" between."""
    path = tmp_path / "own.toml"
    path.write_text(new_scene("own", "7003C", kind="hybrid", speed_rpm=15e3, preload_N=100.0), "utf-8")
    found = {one.key: one for one in origins(path)}
    one = found[f"bearing.{part}_conformity"]
    assert one.assumed and one.remark == f"makers' printed stiffness agrees with {other}"
