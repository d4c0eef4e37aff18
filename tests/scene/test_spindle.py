"""Scenes of sets: arrangements, what is refused, origins, and what cannot take a set yet."""

import copy
import time

import pytest

from fmu_bearing import read_scene
from fmu_bearing.scene import Scene, SceneError, read_scene_text
from fmu_bearing.scene.origins import origins
from tests.conftest import GATES, ROOT
from tests.spindle.sets import scene, tables

SOUND = read_scene(GATES / "7003C-bare.toml").sound.model_dump()
FILE = ROOT / "examples" / "spindle_set" / "7003C-DB.toml"


def refused(data):
    with pytest.raises(SceneError) as caught:
        Scene.from_dict(data)
    return [line.removeprefix("7003C-bare: ") for line in caught.value.problems]


@pytest.mark.parametrize(
    ("signs", "name"),
    [
        ("+-", "DB (O)"), ("-+", "DF (X)"), ("++-", "TBT (O)"), ("--+", "TFT (X)"), ("++--", "QBC (O)"),
        ("--++", "QFC (X)"), ("+++-", "QBT (O)"), ("+-+-", "+-+-"),
    ],
)  # fmt: skip
def test_arrangements_have_their_names(signs, name):
    found = scene(signs, range(20, 20 + 20 * len(signs), 20))
    assert found.spindle.arrangement == name


def test_a_file_reads_back_what_it_means():
    found = read_scene(FILE)
    assert found.mounting is None and found.spindle.directions == "+-"
    assert found.spindle.shaft.length_mm == 160.0
    again = read_scene_text(found.to_toml())
    assert again == found
    assert found.replace(
        {"spindle.bearing[2].carries": "+x", "spindle.preload": None}
    ).spindle.arrangement == ("DT")
    steel = found.replace({"spindle.shaft.material": "Si3N4"}).spindle.shaft.material
    assert steel.expansion_1e6_K == 3.2


def test_origins_name_the_material_of_the_shaft():
    known = {one.key: one for one in origins(FILE)}
    assert known["spindle.shaft.material.expansion_1e6_K"].origin == "catalogue GCr15"
    assert known["spindle.bearing[2].position_mm"].origin == "file"
    assert known["spindle.bearing[2].stickout_um"].origin == "default"
    assert known["spindle.shaft.sections_mm"].allowed == "1 to 40 lists [length, diameter, bore], mm"
    assert known["spindle.shaft.temperature_degC"].assumed


def changed(path, value, **arguments):
    data = copy.deepcopy(tables(**arguments))
    *steps, last = path
    part = data
    for step in steps:
        part = part[step]
    if value is None:
        del part[last]
    else:
        part[last] = value
    return data


@pytest.mark.parametrize(
    ("data", "message"),
    [
        (changed(("spindle", "bearing", 1, "carries"), "+x"), "has nothing to act against: all carry +x"),
        (tables("++", (40, 60), None), "nothing holds the shaft the other way: turn one to carries = \"-x\""),
        (tables("--", (40, 60), None, load={"force_x_N": 5.0}), "load.force_x_N < 0"),
        (tables(positions=(40.0, 45.0)), "is 5 mm behind the bearing before it; each is 10 mm wide"),
        (tables(positions=(70.0, 40.0)), "bearings are given from the nose to the rear"),
        (tables(positions=(40.0, 500.0)), "is beyond the shaft's end at 400 mm"),
        (
            tables(tilt_support={"stiffness_N_m_rad": 1e5, "damping_ratio": 0.0, "position_mm": 500.0}),
            "spindle.tilt_support.position_mm = 500.0 is beyond the shaft's end at 400 mm",
        ),
        (changed(("spindle", "bearing", 0, "seat"), "sliding"), "a sliding seat needs a spring"),
        (
            changed(("spindle", "preload"), {"kind": "spring", "force_N": 5.0}),
            "a spring needs a ring that it pushes",
        ),
        (changed(("spindle", "preload"), {"kind": "spring", "preload_N": 5.0}), "force_N is missing"),
        (changed(("spindle", "preload"), {"force_N": 5.0}), "force_N = 5.0 is not read with kind"),
        (
            changed(("spindle", "bearing", 0, "stickout_um"), 900.0),
            "spindle.bearing[1].stickout_um = 900.0 is refused; allowed: -200 to 200 um",
        ),
        (
            changed(("spindle", "shaft", "sections_mm"), [[10.0, 20.0]]),
            "allowed: 1 to 40 lists [length, diameter, bore], mm",
        ),
        (
            changed(("spindle", "shaft", "sections_mm"), [[99.0, 20.0, 20.0]]),
            "section 1 has a bore of 20 mm in a diameter of 20",
        ),
        (changed(("spindle", "shaft", "material"), "Steal"), "shaft.material = 'Steal' is not in the"),
        (changed(("spindle", "shaft", "elastic"), True), "spindle.shaft.elastic is not a key of a scene"),
        (
            changed(("spindle", "housing"), {"mass_kg": 2.0}),
            "spindle.housing.diameter_mm is missing, for example diameter_mm = 100",
        ),
        (
            changed(("spindle", "housing"), {"length_mm": 100.0}),
            "spindle.housing.length_mm = 100.0 has no effect without mass_kg",
        ),
        (
            changed(("spindle", "housing"), {"pedestal_stiffness_N_m": 1e8}),
            "spindle.housing.pedestal_stiffness_N_m = 100000000.0 has no effect",
        ),
        (
            changed(("spindle", "housing"), {"pedestal_damping_ratio": 0.1}),
            "spindle.housing.pedestal_damping_ratio = 0.1 has no effect",
        ),
        (
            changed(("spindle", "shaft", "damping_ratio"), 0.02),
            "spindle.shaft.damping_ratio = 0.02 applies to a shaft that bends: give flexible = true",
        ),
        (changed(("spindle", "shaft", "fixed_modes"), 4), "spindle.shaft.fixed_modes = 4 applies to a shaft"),
        (
            changed(("spindle", "shaft", "unbalance"), [{"position_mm": 900.0, "amount_g_mm": 1.0}]),
            "spindle.shaft.unbalance[1].position_mm = 900 is beyond the shaft's end",
        ),
        (changed(("operation", "lowest_speed_rpm"), 5e3), "lowest_speed_rpm = 5000.0 has no effect"),
        (changed(("mounting",), {}), "mounting: cannot be given with [spindle]"),
        (changed(("spindle",), None), "mounting is missing: the table [mounting]"),
    ],
)  # fmt: skip
def test_what_does_not_fit_is_refused_with_the_way_out(data, message):
    lines = refused(data)
    assert any(message in line for line in lines), lines


def test_loads_of_the_shaft_are_of_sets():
    from fmu_bearing import statics

    for load in ({"force": (1.0, 0.0, 0.0)}, {"at": 0.1}, {"moment": (1.0, 0.0)}):
        with pytest.raises(SceneError, match=r"are of the shaft of a set; .* of \[mounting\]"):
            statics(GATES / "7003C-bare.toml", **load)


@pytest.mark.heavy
@pytest.mark.parametrize("section", [[1.0, 17.0, 0.0], [0.0, "wide", -1.0]])
def test_very_many_sections_are_counted_not_checked(section):
    """0.6 s of a core of an AMD EPYC; checked one by one, those of the second kind take 4 s."""
    begin = time.process_time()
    (line,) = refused(changed(("spindle", "shaft", "sections_mm"), [section] * 200_000))
    assert line == (
        "spindle.shaft.sections_mm has 200000 members; allowed: 1 to 40 lists [length, diameter, bore], mm"
    )
    assert time.process_time() - begin < 3.0


@pytest.mark.parametrize(("count", "said"), [(200_000, r"it has 3.\d+ MB; allowed: up to 1 MB"),
                                             (40_000, "sections_mm has 40000 members")])  # fmt: skip
def test_a_file_of_very_many_sections_is_answered_at_once(count, said, tmp_path):
    text = FILE.read_text("utf-8")
    before = next(line for line in text.splitlines() if line.startswith("sections_mm"))
    file = tmp_path / "many.toml"
    file.write_text(text.replace(before, f"sections_mm = [{', '.join(['[1.0, 17.0, 0.0]'] * count)}]"))
    begin = time.process_time()
    with pytest.raises(SceneError, match=said):
        read_scene(file)
    assert time.process_time() - begin < 3.0  # 0.4 s for the shorter one, which is read


def test_every_array_of_a_scene_has_its_longest(scene_file):
    many = {
        "sound.microphone": (361, "at most 360 tables"),
        "fmu.outputs": (1001, "a list of at most 1000 names"),
        "imperfections.inner_race_harmonic": (201, "at most 200 tables"),
    }
    for key, (count, allowed) in many.items():
        with pytest.raises(SceneError, match=f"{key} has {count} members; allowed: {allowed}") as refusal:
            read_scene(scene_file).replace({key: [3] * count})
        assert len(refusal.value.problems) == 1
