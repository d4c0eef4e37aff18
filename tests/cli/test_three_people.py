"""Three people and a pair, from an empty folder, by the commands of the pages; answers as of the library.

Tests of each command guard its table, its options and what it refuses. Here the file that one command writes
goes to the next, and the library computes the same answers from a scene that it makes itself.
"""

import math
import shlex

import fmpy
import pytest
from fmpy.fmi2 import FMU2Slave

from fmu_bearing import new_scene, operating_point, read_scene, realtime, record
from fmu_bearing.fmi.description import interface_guid
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.recording.measurements.at_frequency import noise_at
from fmu_bearing.recording.measurements.sound_analysis import analyse_sound
from tests.pages import DOCS, blocks, commands

pytestmark = pytest.mark.pages

PAIR = "NSK-7010C-DB.toml"
BRIEF = ("--duration", "0.05", "--settle", "0.02", "--radiation-model", "compact", "--no-spread", "--no-wav")
SAME = 1e-9  # relative: JSON keeps all digits


def documented(page, *begin, scene=None):
    """Words after ``fmu-bearing`` of the first command of a page that begins so, for another scene."""
    every = [
        words[1:]
        for language, _, script in blocks(DOCS / page)
        if language == "sh"
        for words in commands(script)
        if words[0] == "fmu-bearing"
    ]
    found = next((words for words in every if words[: len(begin)] == list(begin)), None)
    assert found is not None, f"{page} has no command that begins with {shlex.join(begin)}"
    return [scene if scene is not None and word.endswith(".toml") else word for word in found]


@pytest.fixture
def answered(run, tmp_path, monkeypatch):
    """A function that runs a command in a folder that holds the new pair alone, and returns its JSON."""
    monkeypatch.chdir(tmp_path)
    made = run(*documented("spindle.md", "scene", "new"))
    assert made.exit_code == 0 and [path.name for path in tmp_path.iterdir()] == [PAIR]

    def call(words, *more):
        done = run(*words, *more, "--json")
        assert done.exit_code == 0, f"{shlex.join(words)}\n{done.output}"
        return done.data

    return call


@pytest.fixture(scope="module")
def pair(tmp_path_factory):
    """The same pair by the library alone."""
    text = new_scene(
        "NSK-7010C-DB", "NSK-7010C", kind="hybrid", arrangement="DB", preload_class="medium", speed_rpm=18e3
    )
    path = tmp_path_factory.mktemp("library") / "pair.toml"
    path.write_text(text, "utf-8")
    return read_scene(path)


def test_a_spindle_engineer_chooses_the_preload_class(answered, pair):
    """Which class, will it last 20,000 h, how stiff, how hot?"""
    info = documented("spindle.md", "info", PAIR)
    page = (DOCS / "spindle.md").read_text("utf-8").splitlines()
    stiff, heat, life = {}, {}, {}
    for name, options in (("light", ("--set", "spindle.preload.preload_class=light")), ("medium", ())):
        data = answered(info, *options)
        point = operating_point(pair.replace({"spindle.preload.preload_class": name}))
        at_rest, life[name] = data["statics"], data["life_h"]
        stiff[name], heat[name] = at_rest["nose_stiffness_N_m"], data["heat_W"]["total"]
        for state, forces in point.statics.preloads.items():
            assert at_rest["preloads_N"][state] == pytest.approx(list(forces), rel=SAME), (name, state)
        assert stiff[name] == pytest.approx(point.statics.nose_stiffness, rel=SAME)
        assert at_rest["axial_stiffness_N_m"] == pytest.approx(point.statics.axial_stiffness, rel=SAME)
        assert life[name] == pytest.approx(point.life, rel=SAME) and life[name] > 20e3
        torque = sum(one.friction_torque for one in point.bearings)
        assert heat[name] == pytest.approx(torque * 18e3 * math.pi / 30.0, rel=SAME)
        # the row of the page
        preloads = [at_rest["preloads_N"][state][0] for state in ("cold", "warm", "running")]
        cells = [*(f"{force:.0f}" for force in preloads), f"{1e-6 * stiff[name]:.0f}"]
        row = " | ".join([f"| {name}", *cells, f"{round(life[name], -2):,.0f} |"])
        assert any(line.startswith(row) for line in page), row
    assert stiff["medium"] > 1.5 * stiff["light"]
    assert heat["medium"] > heat["light"] and life["medium"] < life["light"]


@pytest.mark.heavy
def test_an_nvh_engineer_asks_what_makes_the_noise(answered, pair, tmp_path):
    """How loud, which source at 1700 Hz, what helps?"""
    data = answered([*documented("quick-start.md", "sound", scene=PAIR), *BRIEF])
    recording = record(pair, 0.05, settle=0.02, radiation_model="compact", warn=False)
    names = [one.name for one in pair.microphones]
    assert list(data["levels"]) == names
    for weighting, key in (("Z", "leq_dB"), ("A", "laeq_dB")):
        levels = recording.levels(weighting=weighting)
        assert [data["levels"][name][key] for name in names] == pytest.approx(list(levels), abs=SAME)
    # the second command reads the recording that the first one left
    asked = answered(documented("learn/noise.md", "sound", "out/sound/recording.npz"))
    assert asked["levels"] == data["levels"]
    library = noise_at(recording, analyse_sound(recording), 1700.0)
    (said,) = asked["at"]
    for k, name in enumerate(names):
        parts = {source: row[k] for source, row in library.levels.items()}
        assert said["levels_dB"][name] == pytest.approx(parts, abs=SAME)
    assert said["words"] == library.sentences()
    # a change of the class is what the spindle engineer's scene of that class has
    changed = answered(documented("spindle.md", "changes", scene=PAIR))
    light = next(one for one in changed["changes"] if one["change"] == "preload 390 -> 150 N light")
    point = operating_point(pair.replace({"spindle.preload.preload_class": "light"}))
    assert changed["life_h"] == pytest.approx(operating_point(pair).life, rel=SAME)
    # 150 N are the class's offset but for what Newton's iteration leaves
    assert light["life_h"] == pytest.approx(point.life, rel=1e-6)
    assert 1e6 * light["stiffness_N_um"] == pytest.approx(point.statics.nose_stiffness, rel=1e-6)


def test_a_harness_author_steps_the_fmu(answered, pair, tmp_path):
    """Does the scene keep 1 ms, and does the FMU give the library's numbers?"""
    built = answered(documented("spindle.md", "build", PAIR))
    model = prepare(pair)
    assert built["guid"] == interface_guid(model, built["flavour"])
    loop = documented("realtime.md", "realtime", "scene.toml", "--step", "1e-3", "--speed", scene=PAIR)
    said = answered(loop, "--duration", "5e-3")
    speed = 12e3 * math.pi / 30.0
    library = realtime(
        pair, 1e-3, duration=5e-3, speeds=(speed, speed), fidelities=["rings", "response"], microphones=0
    ).summary()
    kept = ("fidelity", "microphones", "phase", "steps")  # the rest are times
    assert [[one[key] for key in kept] for one in said["steps"]] == [
        [one[key] for key in kept] for one in library["steps"]
    ]
    assert said["machine"] == library["machine"] and said["left_out"] == library["left_out"] == {}
    in_time = any(one["worst_s"] <= said["step_s"] for one in said["steps"])
    assert in_time is not said["advice"].startswith("No fidelity keeps the step")
    # three steps of the master; the nose takes a load before the second
    alone = Instance(model, tell=lambda text: None)
    alone.initialise()
    names = ["friction_torque", "heat.oil", "bearing[1].force.x", "bearing[2].force.z", "mic[1].pressure"]
    description = fmpy.read_model_description(built["path"])
    assert description.guid == built["guid"]
    references = {one.name: one.valueReference for one in description.modelVariables}
    slave = FMU2Slave(
        guid=description.guid, unzipDirectory=fmpy.extract(built["path"], tmp_path / "in"),
        modelIdentifier=description.coSimulation.modelIdentifier, instanceName="pair",
    )  # fmt: skip
    slave.instantiate()
    slave.setupExperiment(startTime=0.0)
    slave.enterInitializationMode()
    slave.exitInitializationMode()
    forces = []
    for k in range(3):
        if k == 1:
            slave.setReal([references["nose.force.x"]], [100.0])
            alone.set("nose.force.x", 100.0)
        slave.doStep(currentCommunicationPoint=k * 1e-3, communicationStepSize=1e-3)
        alone.step(1e-3)
        values = slave.getReal([references[name] for name in names])
        assert values == [alone.get(name) for name in names], k
        forces.append(values[2])
    slave.terminate()
    slave.freeInstance()
    assert forces[2] - forces[0] > 20.0  # N: the front bearing takes its part
