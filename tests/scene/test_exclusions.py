"""What a scene cannot have: every row of the table is refused in its words, and by no other scene."""

import re
from typing import get_args

import pytest
from typer.testing import CliRunner

from fmu_bearing import (
    campbell,
    changes,
    compare,
    error_motion,
    fits,
    identify,
    modes,
    operating_point,
    read_scene,
    record,
    statics,
    stiffness,
)
from fmu_bearing.accuracy.sensitivity import sensitivity
from fmu_bearing.accuracy.tradeoff import tradeoff
from fmu_bearing.cli import app
from fmu_bearing.design.temperatures import temperatures
from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.recording.channels.sources import sources_of
from fmu_bearing.recording.studies.level_estimator import LevelEstimator
from fmu_bearing.reports import make
from fmu_bearing.run.settings import Setting
from fmu_bearing.scene import SceneError
from fmu_bearing.scene.exclusions import (
    EXCLUSIONS,
    Subject,
    exclusion,
    exclusions_of,
    refusal,
    require,
)
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.vibration_test.rig import rig
from tests.conftest import GATES, ROOT
from tests.messages import says
from tests.tables import DOCS

PAIR = ROOT / "examples" / "spindle_set" / "7003C-DB.toml"
PORT = ROOT / "examples" / "port" / "7003C-DB-port.toml"
SINGLE = read_scene(GATES / "7003C-bare.toml").replace({"sound": None})
MICROPHONE = {"name": "P", "x_mm": 55.0, "y_mm": 205.0, "z_mm": 0.0}


def pair(**changes):
    return read_scene(PAIR).replace({key.replace("__", "."): value for key, value in changes.items()})


def sounding(model="compact", given=SINGLE, **keys):
    return given.replace({"sound": {"radiation_model": model, "microphone": [MICROPHONE], **keys}})


def measured(scene, folder):
    """What the command prints that measures sound."""
    (folder / "scene.toml").write_text(scene.to_toml())
    done = CliRunner().invoke(app, ["sound", str(folder / "scene.toml"), "-o", str(folder / "out")])
    assert done.exit_code == 2 and not (folder / "out" / "recording.npz").exists()
    raise SceneError(done.stderr.removeprefix("error: ").strip())


SPRINGS = {
    "spindle.preload": {"kind": "spring", "force_N": 200.0},
    "spindle.bearing[1].seat": "sliding",
    "spindle.housing": {
        "mass_kg": 2.0, "diameter_mm": 100.0, "length_mm": 200.0, "pedestal_stiffness_N_m": 1e8,
    },
}  # fmt: skip
BENT = SINGLE.replace({"mounting.flexure": {"outer_ring": [2], "inner_ring": []}})
DIFFERING = pair(spindle__bearing=[
    {"position_mm": 40.0, "carries": "+x"},
    {"position_mm": 90.0, "carries": "-x", "bearing": "NSK-7002C"},
])  # fmt: skip
SPALL = {"on": "outer", "shape": "spall", "length_mm": 1.2, "depth_um": 100.0}
SPALLED = SINGLE.replace({"imperfections.defect": [SPALL]})
SEATED = {"spindle.fit": {"preload": "mounted", "shaft": {"interference_um": 2.0}}}
HOUSING = {"sound.radiator": "housing"}

#: For each row, in its order: a scene it holds for, one like it that it does not hold for, and who refuses,
#: by subject: a function of scene and folder, or values of the scene.
DOORS = (
    (pair(), SINGLE, {"against": lambda scene, folder: error_motion(scene, against="outer ring")}),
    (sounding("compact", pair()), sounding("compact", pair(**SPRINGS)), {"housing": HOUSING}),
    (sounding("compact", pair(**SPRINGS)), sounding("compact", pair()), {"housing": HOUSING}),
    (sounding("paper", pair()), sounding("compact", pair()), {"housing": HOUSING}),
    (read_scene(PORT), pair(), {
        "modes": lambda scene, folder: require(scene, "modes"),
        "receptance": lambda scene, folder: require(scene, "receptance"),
    }),
    (read_scene(PORT), pair(), {
        "statics": lambda scene, folder: require(scene, "statics"),
        "report": lambda scene, folder: make(scene, folder / "a.html"),
    }),
    (read_scene(PORT), pair(), {"fidelities": {"fidelity.model": "rings"}}),
    (read_scene(PORT), pair(), {
        "error motion": lambda scene, folder: error_motion(scene),
        "recording": lambda scene, folder: record(scene, 1e-3),
        "measurement": measured,
        "comparison": lambda scene, folder: compare(scene, scene),
        "changes": lambda scene, folder: changes(scene),
        "tradeoff": lambda scene, folder: tradeoff(scene),
        "sensitivity": lambda scene, folder: sensitivity(scene),
        "identification": lambda scene, folder: identify(scene, [], ["operation.speed_rpm"]),
    }),
    (read_scene(PORT), pair(), {"load": {"spindle.load.force_x_N": 5.0}}),
    (read_scene(PORT), pair(), {
        "tool": {
            "milling": {"teeth": 4, "cutting_coefficient_N_mm2": 800.0, "radial_immersion": 0.5},
        },
    }),
    (read_scene(PORT), pair(), {"shaft": {"spindle.shaft.flexible": True}}),
    (read_scene(PORT), pair(), {
        "unbalance": {"imperfections": {"grade": "P4", "seed": 1, "unbalance_um": 0.5}},
    }),
    (DIFFERING, pair(), {
        "changes": lambda scene, folder: changes(scene),
        "tradeoff": lambda scene, folder: tradeoff(scene),
        "sensitivity": lambda scene, folder: sensitivity(scene),
    }),
    (DIFFERING, pair(), {
        "fits": lambda scene, folder: fits(scene.replace(SEATED)),
        "temperatures": lambda scene, folder: temperatures(scene),
    }),
    (BENT, BENT.with_rigid_rings(), {"fidelities": {"fidelity.model": "response"}}),
    (with_fidelity(SINGLE, model="rings"), SINGLE, {"vibration test": lambda scene, folder: rig(scene)}),
    (SPALLED, SPALLED.replace({"imperfections.defect": []}), {"response": {"fidelity.model": "response"}}),
    (sounding("compact"), sounding("bem"), {"plane": {"sound.reflecting_plane_mm": -50.0}}),
    (sounding("table", table_file="a.npz"), sounding("compact"), {
        "channels": lambda scene, folder: sources_of(scene, "table", [(0.0, 1.0, 0.0)], 4),
    }),
    (sounding("paper"), sounding("compact"), {
        "short runs": lambda scene, folder: LevelEstimator([(0.0, 1.0, 0.0)], "paper", "A"),
    }),
)  # fmt: skip
ROWS = [(row, *door) for row, door in zip(EXCLUSIONS, DOORS, strict=True)]
CASES = [
    pytest.param(row, scene, subject, door, id=f"{subject}-{row.kind.name}")
    for row, scene, _, doors in ROWS
    for subject, door in doors.items()
]


def test_every_subject_is_in_the_table_and_has_a_door_here():
    assert {subject for row in EXCLUSIONS for subject in row.what} == set(get_args(Subject))
    for row, _, _, doors in ROWS:
        assert set(row.what) == set(doors)


@pytest.mark.parametrize(("row", "scene", "other"), [row[:3] for row in ROWS])
def test_a_row_holds_for_its_scenes_alone(row, scene, other):
    assert row.kind.holds(scene) and row in exclusions_of(scene)
    for free in (other, SINGLE):
        assert not row.kind.holds(free) and row not in exclusions_of(free)


@pytest.mark.parametrize(("row", "scene", "subject", "door"), CASES)
def test_what_a_row_names_is_refused_in_its_words(row, scene, subject, door, tmp_path):
    with pytest.raises(ValueError, match=re.escape(f"{row.reason}; {row.way_out}")) as caught:
        scene.replace(door) if isinstance(door, dict) else door(scene, tmp_path)
    if isinstance(door, dict):  # by name, key and value, as all that does not fit in a file
        line = rf"^{scene.name}: [\w.]+( = .+|:) is refused: {re.escape(row.reason)}"
        assert re.search(line, str(caught.value), flags=re.MULTILINE), str(caught.value)
    else:
        assert row.words(subject) in str(caught.value)


@pytest.mark.parametrize(
    "use",
    [
        statics, operating_point, stiffness, modes,
        lambda scene: campbell(scene, [5e3, 1e4, 2e4]),
    ],
)  # fmt: skip
def test_statics_and_modes_of_another_models_shaft_are_refused(use):
    with pytest.raises(SceneError, match="^7003C-DB-port: .*another model owns the shaft"):
        use(read_scene(PORT))


def test_a_refusal_names_the_scene_what_why_and_the_way_out():
    words = "7003C-DB ... error motion against an outer ring ... leave `against` out, or give `ground`"
    assert says(refusal(pair(), "against"), words)


def test_a_scene_with_nothing_special_can_have_everything():
    assert exclusions_of(SINGLE) == ()
    for subject in get_args(Subject):
        assert exclusion(SINGLE, subject) is None and refusal(SINGLE, subject) == ""
        require(SINGLE, subject)


def test_a_port_is_refused_at_once_where_auto_would_have_to_be_probed(tmp_path, monkeypatch):
    monkeypatch.setattr("fmu_bearing.run.choose.choose", lambda *args, **keys: pytest.fail("probed"))
    given = with_fidelity(read_scene(PORT), model="auto")
    for use in (lambda: record(given, 1e-3), lambda: compare(given, given)):
        with pytest.raises(SceneError, match="another model moves the shaft"):
            use()


@pytest.mark.parametrize("scene", [BENT, read_scene(PORT)], ids=["bending", "port"])
def test_settings_ask_the_table(scene):
    assert [Setting(name).carries(scene) for name in FIDELITIES] == [name == "full" for name in FIDELITIES]
    assert all(Setting(name).carries(pair()) for name in FIDELITIES)


def test_settings_leave_out_response_alone_where_contacts_lose_load():
    assert [Setting(name).carries(SPALLED) for name in FIDELITIES] == [True, True, False]
    assert "it is linear, and a contact over a defect loses its load" in Setting("response").against(SPALLED)
    assert with_fidelity(SPALLED, model="rings").fidelity.model == "rings"


@pytest.mark.pages
def test_the_page_on_limits_has_the_table():
    """The site makes it of every row; no cell ends the row early."""
    page = (DOCS / "limits.md").read_text(encoding="utf-8")
    assert "<!-- generated: exclusions -->" in page.split("## What a scene cannot have\n")[1]
    assert not [row for row in EXCLUSIONS if "|" in f"{row.kind.name}{row.all}{row.reason}{row.way_out}"]
