"""FMUs of sets: both builds and the library give the same bits; states, refusals, names, checkers."""

import csv
import functools
import importlib.util
import io
import logging
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import pytest
from fmpy.validation import validate_fmu
from lxml import etree

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.fmi import reference
from fmu_bearing.fmi.description import FLAVOURS
from fmu_bearing.fmi.package import build
from fmu_bearing.fmi.terminals import TERMINALS_FILE
from fmu_bearing.instance import Instance
from fmu_bearing.interface import inputs
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene
from tests.conftest import EXAMPLES
from tests.marks import heavy_but
from tests.native_builds import no_native_fmu

from .conftest import DISCARD, OK, Master
from .differences import DIFFERENCES

SETS = EXAMPLES.parent / "spindle_set"
STEPS = (2e-4, 5e-5, 3.3e-4, 1e-4, 1e-6, 2.5e-4)  # s
INPUTS = {  # one of each kind, others at each step
    "shaft_speed": lambda i: 1600.0 + 20.0 * i,
    "nose.force.x": lambda i: 100.0 - 5.0 * i,
    "nose.moment.y": lambda i: 0.2 * i,
    "shaft_temperature": lambda i: 315.0 + 0.1 * i,
    "bearing[2].inner_ring_temperature": lambda i: 315.0 + 0.2 * i,
    "bearing[1].oil_temperature": lambda i: 313.0 + i,
}


@functools.cache
def model(name="DB", fidelity=None, **fmu):
    """A set of the examples with waves, sound and ``[fmu]``, at its own fidelity or another."""
    microphones = [{"name": "P1", "x_mm": 40.0, "y_mm": 90.0, "z_mm": 30.0}]
    sound = {"radiation_model": "compact", "metering_start_s": 0.0, "microphone": microphones}
    changes = {"imperfections": {"grade": "P4", "seed": 1}, "sound": sound}
    changes["fmu"] = {"terminals": True, **fmu}
    return prepare(read_scene(SETS / f"7003C-{name}.toml").replace(changes), fidelity=fidelity)


@pytest.fixture(scope="module")
def folders(tmp_path_factory):
    """A function that builds and unpacks the FMU of a flavour, once."""

    @functools.cache
    def folder(flavour, name="DB", **fmu):
        made = tmp_path_factory.mktemp("set")
        try:
            path = build(model(name, **fmu), made / "set.fmu", flavour).path
        except BuildError as problem:
            no_native_fmu(problem)
        with zipfile.ZipFile(path) as archive:
            archive.extractall(made / "in")
        return path, made / "in"

    return folder


@pytest.fixture
def masters(folders):
    """A function that makes instances, freed at the end."""
    made = []

    def instantiate(flavour, name="DB", **fmu):
        made.append(Master(folders(flavour, name, **fmu)[1]))
        return made[-1]

    yield instantiate
    for one in made:
        one.free()


@pytest.fixture
def answers():
    """A function that tells what a build answers to a value out of range, and to the step after it."""
    (row,) = [one for one in DIFFERENCES if one.behaviour == "value out of range"]
    return lambda flavour: getattr(row, flavour)


def march(one, first=0, last=None):
    """All values after each of the irregular steps, under changing inputs."""
    taken = []
    for i in range(first, last or len(STEPS)):
        for name, value in INPUTS.items():
            assert one.set(name, value(i)) == OK
        assert one.step(sum(STEPS[:i]), STEPS[i]) == OK, one.messages
        taken.append(one.everything())
    return taken


@pytest.mark.parametrize("name", heavy_but(["DB", "QBC"], "DB"))
def test_both_builds_and_the_library_give_the_same_bits(masters, name):
    native, python = (masters(flavour, name).start() for flavour in FLAVOURS)
    assert native.everything() == python.everything()
    taken = march(native)
    assert taken == march(python)
    alone = Instance(model(name))
    alone.initialise()
    names = [v.name for kind in ("Real", "Integer") for v in model(name).variables if v.type == kind]
    for i, size in enumerate(STEPS):
        for key, value in INPUTS.items():
            alone.set(key, value(i))
        alone.step(size)
        assert taken[i] == [alone.get(one) for one in names], i
    last = dict(zip(names, taken[-1], strict=True))
    assert abs(last["bearing[1].inner_ring.velocity.z"] - last["bearing[2].inner_ring.velocity.z"]) > 1e-6


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_state_continues_in_an_instance_of_its_own(masters, flavour):
    one, fresh = masters(flavour), masters(flavour)
    # tunable parameters go with the state, and hold for every bearing of the set
    assert one.set("lubricant.viscosity_ref", 0.5) == one.set("imperfection.scale", 0.5) == OK
    one.start()
    march(one, 0, 3)
    state = one.keep()
    data = one.to_bytes(state)
    after = march(one, 3)
    assert one.put_back(state) == OK
    assert march(one, 3) == after
    status, copy = fresh.from_bytes(data)
    assert status == fresh.put_back(copy) == OK
    assert march(fresh, 3) == after
    assert one.release(state) == fresh.release(copy) == OK
    # from the beginning again, with the default parameters: not the same
    assert one.reset() == OK
    assert march(one.start(), 0, 3)[-1] != after[-1]


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_reset_gives_the_first_run_again(masters, flavour):
    one = masters(flavour).start()
    first = march(one)
    assert one.reset() == OK
    assert march(one.start()) == first


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_refusals_name_the_inputs_of_the_set(masters, flavour, answers):
    one = masters(flavour).start()
    before, warm = one.everything(), one.get("bearing[2].oil_temperature")
    assert (one.set("bearing[2].oil_temperature", 1000.0), one.step(0.0)) == answers(flavour)
    assert "bearing[2].oil_temperature = 1000" in one.messages
    assert one.reset() == OK
    assert one.start().set("bearing[2].oil_temperature", warm) == OK
    assert one.everything() == before
    assert one.step(0.0) == OK


def test_warnings_name_the_bearing(masters):
    lines = []
    for flavour in FLAVOURS:
        one = masters(flavour)
        one.start(**{"nose.force.x": 3000.0, "nose.force.z": 0.0, "nose.moment.y": 0.0})
        assert one.step(0.0, 1e-4) == OK
        (line,) = [text for text in one.messages.splitlines() if "is unloaded" in text]
        lines.append(line[line.index("bearing 2") :])
    assert lines[0] == lines[1]
    assert lines[0].startswith("bearing 2: its inner race carries 0.")


@pytest.mark.heavy
@pytest.mark.parametrize("flavour", FLAVOURS)
def test_checkers_find_nothing(folders, flavour, caplog):
    path, folder = folders(flavour)
    assert validate_fmu(str(path)) == []
    tree = etree.parse(folder / "modelDescription.xml")
    for package in ("fmpy", "fmu_manipulation_toolbox"):
        at = Path(importlib.util.find_spec(package).origin).parent
        for schema in at.rglob("fmi2ModelDescription.xsd"):
            etree.XMLSchema(etree.parse(schema)).assertValid(tree)
    checker = pytest.importorskip("fmu_manipulation_toolbox.checker")
    operations = pytest.importorskip("fmu_manipulation_toolbox.operations")
    with caplog.at_level(logging.WARNING), operations.FMU(str(path)) as opened:
        for check in checker.get_checkers():
            opened.apply_operation(check())
    assert [record.getMessage() for record in caplog.records] == []


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_description_speaks_of_the_set(folders, flavour):
    _, folder = folders(flavour)
    root = ElementTree.parse(folder / "modelDescription.xml").getroot()
    assert root.find("CoSimulation").get("modelIdentifier") == "Spindle7003C"
    assert root.get("description").startswith("Shaft on 2 angular contact ball bearings 7003C, DB (O): ")
    page = (folder / "documentation" / "index.html").read_text("utf-8")
    assert "<h1>Shaft on 2 x 7003C</h1>" in page
    assert "40 mm (+x), 90 mm (-x)" in page and "bearing[2].friction_torque" in page
    assert "$" not in page


def test_reference_results_are_those_of_both_builds(folders, masters):
    texts = [(folders(one)[1] / reference.FOLDER / "reference.csv").read_text("ascii") for one in FLAVOURS]
    assert texts[0] == texts[1]
    names, *rows = csv.reader(io.StringIO(texts[0]))
    assert {"friction_torque", "shaft.nose.velocity.z", "bearing[1].force.x"} <= set(names)
    one = masters("native").start()
    for i, row in enumerate(rows):
        if i:
            assert one.step((i - 1) * reference.STEP_SIZE, reference.STEP_SIZE) == OK
        assert [f"{value:.9g}" for value in one.read(*names[1:])[1]] == row[1:], i


@pytest.mark.parametrize("flavour", FLAVOURS)
def test_flat_names_and_terminals(folders, masters, flavour):
    _, folder = folders(flavour, naming="flat")
    names = {v.get("name") for v in ElementTree.parse(folder / "modelDescription.xml").iter("ScalarVariable")}
    assert {"bearing_2_cage_velocity_x", "nose_force_x", "bearing_1_ball_12_velocity_z"} <= names
    root = ElementTree.parse(folder / TERMINALS_FILE).getroot()
    found = {
        terminal.get("name"): {
            member.get("memberName"): member.get("variableName") for member in terminal
        }
        for terminal in root.iter("Terminal")
    }  # fmt: skip
    ports = [f"bearing_{b}_{port}" for b in (1, 2) for port in ("inner_ring", "outer_ring", "oil")]
    assert list(found) == ["shaft", "nose", *ports, "mic_1"]
    assert found["shaft"] == {"w": "shaft_speed", "tau": "friction_torque"}
    assert found["bearing_2_oil"] == {"T": "bearing_2_oil_temperature", "Q_flow": "bearing_2_heat_oil"}
    assert set().union(*(members.values() for members in found.values())) <= names
    # values do not depend on names
    structured = masters(flavour).start()
    assert masters(flavour, naming="flat").start().everything() == structured.everything()


def test_a_refused_step_leaves_the_state_as_it_was(masters, monkeypatch):
    # 0.5 MN m tears the shaft out of its bearings: no step is short enough. It is beyond the range otherwise
    monkeypatch.setattr(inputs, "_OVERLOAD", 1e3)
    texts = []
    for flavour in FLAVOURS:
        one, other = masters(flavour, terminals=True).start(), masters(flavour, terminals=True).start()
        first = march(one, 0, 3)
        assert march(other, 0, 3) == first
        moment, at = one.get("nose.moment.y"), sum(STEPS[:3])
        assert one.set("nose.moment.y", 5e5) == OK
        assert one.step(at, 1e-4) == DISCARD
        (text,) = [text for text in one.messages.splitlines() if "could not be solved" in text]
        texts.append(text[text.index("inputs were") :])
        assert one.set("nose.moment.y", moment) == OK
        assert one.everything() == first[-1]
        assert march(one, 3) == march(other, 3)
    assert texts[0] == texts[1]
    assert "nose.moment.y = 500000, " in texts[0]


def test_rings_that_begin_again_warn_once(masters):
    """A shaft 15 K warmer within 1 ns pushes the races at kilometres per second: no step leads on."""
    texts = []
    for flavour in FLAVOURS:
        one = masters(flavour, fidelity="rings").start()
        at = 0.0
        for kelvin in (330.0, 315.0, 330.0):
            assert one.set("shaft_temperature", kelvin) == OK
            for h in (1e-9, 1e-4):
                assert one.step(at, h) == OK, one.messages
                at += h
        assert one.get("solver.restarts") >= 3
        texts.append([text for text in one.messages.splitlines() if "restarted from rest" in text])
        assert len(texts[-1]) == 1
        assert "1 times so far (solver.restarts)" in texts[-1][0]
