"""New scenes: speed and preload by makers' rules, marked; no verdict worse than good, no ring that whirls."""

import pytest

from fmu_bearing import Dimensions, modes, new_scene, operating_point, verdicts
from fmu_bearing.modal.modes.natural_modes import self_excited
from fmu_bearing.scene import SceneError, origins, read_scene_text
from fmu_bearing.scene.nsk import sizes
from tests.marks import heavy_but

#: Of each series the least, a middle and the largest size, at both angles; the papers' bearings; dimensions.
BEARINGS = (
    "NSK-7900C", "NSK-7906AC", "NSK-7914C", "NSK-7000AC", "NSK-7004C", "NSK-7010C", "NSK-7014AC", "7003C",
    "7009C", Dimensions(8.0, 22.0, 7.0), Dimensions(40.0, 68.0, 15.0, 20.0),
    Dimensions(100.0, 150.0, 24.0, 25.0),
)  # fmt: skip


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("bearing", "kind"),
    [
        *((bearing, "hybrid") for bearing in BEARINGS),
        *((bearing, "steel") for bearing in ("NSK-7004C", "NSK-7914C", "7009C")),
        ("NSK-7010C", "full-ceramic"),
    ],
    ids=str,
)
def test_a_fresh_scene_is_good(bearing, kind):
    sound_and_good(bearing, kind)


@pytest.mark.heavy
# of every fifth size, beside those above, a half with both angles and kinds
@pytest.mark.parametrize(
    ("name", "kind"),
    [(name, ("hybrid", "steel")[k // 2 % 2]) for k, name in enumerate(list(sizes())[::5]) if k % 4 in (0, 3)],
)
def test_a_fresh_scene_of_any_size_is_good(name, kind):
    sound_and_good(name, kind)


def sound_and_good(bearing, kind):
    scene = read_scene_text(new_scene("fresh", bearing, kind=kind, sound=False))
    point = operating_point(scene)
    worse = [one.label for one in verdicts(point) if one.judgement not in ("good", "not judged")]
    assert not worse
    assert (
        scene.mounting.preload_N >= 1.2 * point.bearings[0].least_preload * 0.97
    )  # angles change with the preload
    assert scene.mounting.tilt_support is not None
    assert scene.operation.oil_temperature_degC == 40.0
    found = modes(scene)
    assert found.linearised.steady
    assert self_excited(found) is None


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("bearing", "kind", "arrangement"),
    heavy_but(
        [
            ("NSK-7010C", "hybrid", "DB"), ("NSK-7004C", "hybrid", "DF"), ("7003C", "hybrid", "DT"),
            ("NSK-7010C", "hybrid", "TBT"), ("NSK-7014AC", "hybrid", "QBC"),
        ],
        0,
    ),
)  # fmt: skip
def test_a_fresh_set_is_good(bearing, kind, arrangement):
    """No verdict on a bearing or the set is worse than good, and each has what its balls need at least."""
    lines = []
    text = new_scene("fresh", bearing, kind=kind, arrangement=arrangement, sound=False, tell=lines.append)
    scene = read_scene_text(text)
    assert len(lines) == 1 and "looking for a preload" in lines[0]
    point = operating_point(scene)
    assert not [
        (one.label, one.bearing) for one in verdicts(point) if one.judgement not in ("good", "not judged")
    ]
    assert all(one.axial >= one.least_preload for one in point.bearings)
    least = point.bearings[0].scene.replace({"mounting.preload_class": "light"}).mounting.preload_N
    loads = point.statics.preloads.get("cold") or [scene.spindle.load.force_x_N / 2] * 2
    # a class by its printed newtons; of the triplet's lighter side 0.68 of it and more
    assert min(loads) >= (0.68 if arrangement == "TBT" else 1.0) * least * (1.0 - 1e-6)


@pytest.mark.heavy
def test_rules_stand_in_the_marks(tmp_path):
    path = tmp_path / "my.toml"
    path.write_text(new_scene("my", "NSK-7010C", kind="hybrid"), "utf-8")
    found = {one.key: one for one in origins.origins(path)}
    size = sizes()["NSK-7010C"]
    assert found["operation.speed_rpm"].value == 0.5 * size.oil_speed
    assert found["operation.speed_rpm"].remark == "half of NSK's limiting speed with oil"
    preload = found["mounting.preload_N"]
    # the light class of 150 N would leave 0.031 of gyroscopic friction, makers' limit is 0.02
    assert preload.remark == "light class of NSK: 150 N, raised from 150 N against gyroscopic slip"
    assert size.preload["light"].force < preload.value < size.preload["medium"].force
    for key in (
        "operation.speed_rpm", "mounting.preload_N", "operation.oil_temperature_degC",
        "operation.inner_ring_temperature_degC", "mounting.tilt_support.stiffness_N_m_rad",
        "imperfections.highest_frequency_kHz", "sound.radiator",
    ):  # fmt: skip
        assert found[key].assumed, key
    assert found["imperfections.highest_frequency_kHz"].value == 20.0
    assert found["sound.radiator"].value == "bare"
    assert found["mounting.tilt_support.stiffness_N_m_rad"].value == pytest.approx(3e7 * 0.065**2, rel=0.005)


def test_what_is_given_stays_and_is_not_marked(tmp_path):
    path = tmp_path / "my.toml"
    path.write_text(new_scene("my", "NSK-7010C", kind="hybrid", speed_rpm=9000.0, preload_N=77.0), "utf-8")
    found = {one.key: one for one in origins.origins(path)}
    for key, value in (("operation.speed_rpm", 9000.0), ("mounting.preload_N", 77.0)):
        assert found[key].value == value and not found[key].assumed
    # at a given speed the preload follows it: makers' light class suffices at a low one
    slow = read_scene_text(new_scene("my", "NSK-7010C", kind="hybrid", speed_rpm=6000.0))
    assert slow.operation.speed_rpm == 6000.0 and slow.mounting.preload_N == 150.0
    with pytest.raises(SceneError, match="preload_N = 77 cannot be given with preload_class: give one of"):
        new_scene("my", "NSK-7010C", kind="hybrid", preload_N=77.0, preload_class="heavy")
    heavy = read_scene_text(new_scene("my", "NSK-7010C", kind="hybrid", preload_class="heavy"))
    assert heavy.mounting.preload_N == sizes()["NSK-7010C"].preload["heavy"].force
    assert heavy.operation.speed_rpm == 13_500.0


@pytest.mark.heavy
def test_angles_without_classes_and_limits_have_rules_of_their_own():
    scene = read_scene_text(new_scene("my", Dimensions(40.0, 68.0, 15.0, 40.0), sound=False))
    # n d_m 0.75e6, three digits
    assert scene.operation.speed_rpm * 54.0 == pytest.approx(0.75e6, rel=0.005)
    assert scene.mounting.preload_N >= 1.15 * operating_point(scene).bearings[0].least_preload


@pytest.mark.heavy
def test_a_speed_without_a_good_preload_gets_the_most_that_makers_would_not_caution_of():
    fast = read_scene_text(new_scene("my", "NSK-7004C", kind="steel", speed_rpm=36_000.0, sound=False))
    judged = {one.key: one.judgement for one in verdicts(operating_point(fast))}
    assert judged["gyroscopic"] == "watch"
    # the shoulder's margin is 1.3 to 1.5 deg at any preload there
    assert {judged[key] for key in ("pressure", "preload_class")} == {"good"}


@pytest.mark.heavy
def test_ahead_is_towards_minus_x():
    scene = read_scene_text(new_scene("my", "7003C"))
    places = {place.name: place.position_m for place in scene.microphones}
    assert places["front"][0] < 0.0 < places["back"][0]


def test_unknown_names_are_refused():
    with pytest.raises(SceneError, match="did you mean '7003C'"):
        new_scene("my", "7003D")
    with pytest.raises(SceneError, match="the outside diameter must exceed the bore"):
        new_scene("my", Dimensions(40.0, 40.0, 10.0))
