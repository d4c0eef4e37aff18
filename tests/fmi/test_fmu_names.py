"""Names, inputs, outputs and terminals as ``[fmu]`` of the scene asks for them, in both builds."""

import importlib.util
import re
import zipfile
from pathlib import Path
from xml.etree import ElementTree

import fmpy
import pytest
from fmpy.validation import validate_fmu
from lxml import etree
from typer.testing import CliRunner

from fmu_bearing import cli
from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.fmi.description import description_xml
from fmu_bearing.fmi.fmu_model import as_fmu_model
from fmu_bearing.fmi.package import build
from fmu_bearing.fmi.terminals import TERMINALS_FILE, terminals_xml
from fmu_bearing.interface import flat
from fmu_bearing.prepare.model import prepare
from fmu_bearing.results.variable_names import unit_of
from fmu_bearing.scene import SceneError, read_scene
from tests.conftest import EXAMPLES
from tests.native_builds import no_native_fmu
from tests.spindle.port import as_port

from .conftest import ERROR, OK, Master

PROMOTED = ["usual", "inner_ring.displacement.*", "contact.*.load_max", "stiffness.radial", "rotor.inertia"]
OPTIONS = {
    "fmu.outputs": PROMOTED,
    "fmu.inputs": ["shaft_speed", "*_temperature"],
    "fmu.naming": "flat",
    "fmu.terminals": True,
}


@pytest.fixture(scope="session")
def built(scene_file, flavour, tmp_path_factory):
    """The FMU of the spindle with all options, and its folder."""
    folder = tmp_path_factory.mktemp("shown")
    try:
        path = build(prepare(read_scene(scene_file).replace(OPTIONS)), folder / "b.fmu", flavour).path
    except BuildError as problem:
        no_native_fmu(problem)
    with zipfile.ZipFile(path) as archive:
        archive.extractall(folder / "in")
    return path, folder / "in"


@pytest.fixture
def other(built):
    """An instance of that FMU."""
    made = Master(built[1])
    yield made
    made.free()


def changed(scene_file, **options):
    return as_fmu_model(prepare(read_scene(scene_file).replace({f"fmu.{k}": v for k, v in options.items()})))


def roles(model):
    return {variable.name: (variable.causality, variable.variability) for variable in model.variables}


def test_without_options_nothing_is_changed(model):
    assert as_fmu_model(model).variables == model.variables


def test_promoted_variables_are_outputs_that_masters_can_connect(model, scene_file):
    usual, promoted = roles(model), roles(changed(scene_file, outputs=PROMOTED))
    locals_left = {name for name in usual if name not in promoted}
    assert locals_left == {
        name for name, role in usual.items() if role[0] == "local" and role[1] != "constant"
    } - set(promoted)
    assert "film.lambda_min" in locals_left
    different = {name for name in promoted if usual[name] != promoted[name]}
    axes = [f"inner_ring.displacement.{axis}" for axis in "xyz"]
    assert different == {*axes, "contact.inner.load_max", "contact.outer.load_max", "stiffness.radial",
                         "rotor.inertia"}  # fmt: skip
    assert {promoted[name][0] for name in different} == {"output"}
    assert promoted["rotor.inertia"] == ("output", "constant")
    tree = etree.fromstring(description_xml(changed(scene_file, outputs=PROMOTED)))
    names = [variable.get("name") for variable in tree.find("ModelVariables")]
    places = {kind: {int(unknown.get("index")) - 1 for unknown in tree.find(f"ModelStructure/{kind}")}
              for kind in ("Outputs", "InitialUnknowns")}  # fmt: skip
    outputs = {place for place, name in enumerate(names) if promoted[name][0] == "output"}
    assert places["Outputs"] == outputs
    assert places["InitialUnknowns"] == outputs - {names.index("rotor.inertia")}


def test_other_inputs_become_tunable_parameters(model, scene_file):
    usual, found = roles(model), roles(changed(scene_file, inputs=["shaft_speed"]))
    for name, (causality, _) in usual.items():
        if causality == "input" and name != "shaft_speed":
            assert found[name] == ("parameter", "tunable")
        else:
            assert found[name] == usual[name]
    none = roles(changed(scene_file, inputs=[]))
    assert "input" not in {causality for causality, _ in none.values()}


@pytest.mark.parametrize("file", ["7003C-bare", "7003C-spindle", "7009C-full-ceramic"])
def test_flat_names_are_identifiers_and_differ(scene, file):
    model = prepare(scene(file))
    names = [flat(variable.name) for variable in model.variables]
    assert len(set(names)) == len(names)
    assert all(re.fullmatch(r"[A-Za-z][A-Za-z0-9_]*", name) for name in names)
    assert flat("ball[3].velocity.y") == "ball_3_velocity_y"
    for variable in model.variables:
        assert unit_of(flat(variable.name)) == unit_of(variable.name)
    assert unit_of("mic_2_leq") == "dB"


def by_name(one, rows, shown=None):
    """Values of a run by flat names, of those ``shown`` alone."""
    names = [flat(name) for kind in ("Real", "Integer") for name in one.by_name if one.kind_of(name) == kind]
    every = [dict(zip(names, row, strict=True)) for row in rows]
    return [{name: row[name] for name in row if shown is None or name in shown} for row in every]


def test_results_are_the_same_bits(other, master):
    usual = master().start(shaft_speed=1500.0, preload=400.0)
    other.start(shaft_speed=1500.0, preload=400.0)
    assert by_name(other, other.run(3)) == by_name(usual, usual.run(3), other.by_name)
    name = "inner_ring.displacement.x"
    assert other.get(flat(name)) == usual.get(name) != 0.0
    # the preload, a tunable parameter there, is changed between steps like an input
    assert other.set("preload", 600.0) == usual.set("preload", 600.0) == OK
    assert by_name(other, other.run(2, 6e-4)) == by_name(usual, usual.run(2, 6e-4), other.by_name)


def test_tunable_parameters_have_no_rates_and_do_not_wait(other, flavour):
    if flavour == "native":  # pythonfmu answers fmi2Error to all rates
        assert other.rate("preload", 1.0) == ERROR
        assert "preload is not an input" in other.messages
    assert other.reset() == OK
    other.set("preload", -1.0)
    assert "value not taken: preload = -1.0 is refused" in other.messages


def test_checkers_find_nothing(built):
    path, folder = built
    assert validate_fmu(str(path)) == []
    schema = Path(importlib.util.find_spec("fmpy").origin).parent / "schema" / "fmi2"
    schema = etree.XMLSchema(etree.parse(schema / "fmi2ModelDescription.xsd"))
    tree = etree.parse(folder / "modelDescription.xml")
    assert schema.validate(tree), schema.error_log
    assert tree.getroot().get("variableNamingConvention") == "flat"
    header = (folder / "extra/org.fmi-standard.fmi-ls-ref/reference.csv").read_text().partition("\n")[0]
    assert "inner_ring_velocity_z" in header and "." not in header


def test_fmpy_runs_it_by_its_names(built):
    result = fmpy.simulate_fmu(
        str(built[0]),
        stop_time=1e-3,
        output_interval=5e-4,
        output=["heat_oil", "mic_1_spl_a", "rotor_inertia"],
        start_values={"preload": 450.0},
    )
    assert result["heat_oil"][-1] > 0.0 and result["rotor_inertia"][-1] > 0.0


# --- terminals --------------------------------------------------------------------------------------------


def test_terminals_follow_the_schema_and_name_variables(built):
    folder = built[1]
    schema = Path(importlib.util.find_spec("fmpy").origin).parent / "schema" / "fmi3"
    schema = etree.XMLSchema(etree.parse(schema / "fmi3TerminalsAndIcons.xsd"))
    tree = etree.parse(folder / TERMINALS_FILE)
    assert schema.validate(tree), schema.error_log
    known = {variable.name for variable in fmpy.read_model_description(str(folder)).modelVariables}
    assert {member.get("variableName") for member in tree.iter("TerminalMemberVariable")} <= known


def test_a_toolbox_reads_the_terminals(built):
    terminals = pytest.importorskip("fmu_manipulation_toolbox.terminals").Terminals(built[1]).terminals
    microphones = {f"mic_{k}" for k in (1, 2, 3, 4)}
    assert set(terminals) == {"shaft", "inner_ring", "outer_ring", "oil"} | microphones
    assert terminals["shaft"].members == {"w": "shaft_speed", "tau": "friction_torque"}
    assert terminals["oil"].members == {"T": "oil_temperature", "Q_flow": "heat_oil"}


def test_what_is_no_input_or_output_is_in_no_terminal(scene_file):
    found = ElementTree.fromstring(terminals_xml(changed(scene_file, inputs=["shaft_speed"])))
    names = {member.get("variableName") for member in found.iter("TerminalMemberVariable")}
    assert "heat.oil" in names and "oil_temperature" not in names


def terminals(model):
    """Names of terminals, with the names of their members and what is said of them."""
    return {
        one.get("name"): ({member.get("memberName") for member in one}, one.get("description"))
        for one in ElementTree.fromstring(terminals_xml(model)).iter("Terminal")
    }


def test_what_a_terminal_does_names_the_members_it_has(scene_file):
    whole = terminals(changed(scene_file))
    assert whole["oil"] == (
        {"T", "Q_flow"}, "Heat to the oil: the bearing gives the heat Q_flow and is given the temperature T"
    )  # fmt: skip
    assert whole["shaft"][1] == "Shaft: the bearing is given the speed w and takes the torque tau"
    assert whole["mic[1]"][1] == "Sound at microphone 1"
    reduced = terminals(changed(scene_file, inputs=["inner_ring_temperature"]))
    assert reduced["oil"] == ({"Q_flow"}, "Heat to the oil: the bearing gives the heat Q_flow")
    assert reduced["inner_ring"] == ({"T", "Q_flow"}, whole["inner_ring"][1])
    assert reduced["shaft"] == ({"tau"}, "Shaft: the bearing takes the torque tau")


def test_what_terminals_of_a_set_do_names_the_members_they_have():
    sets = EXAMPLES.parent / "spindle_set"
    some = terminals(changed(sets / "7003C-DB.toml", inputs=["nose.force.*"], naming="flat"))
    assert some["nose"][1] == "Nose of the shaft: it takes a force and gives its place, tilt and velocity"
    assert some["bearing_2_oil"] == ({"Q_flow"}, "Heat to the oil: the bearing gives the heat Q_flow")
    assert not [name for name in some if not re.fullmatch(r"\w+", name)]
    said = "Nose of the shaft: it takes a force, takes a moment and gives its place, tilt and velocity"
    assert terminals(changed(sets / "7003C-DB.toml"))["nose"][1] == said
    port = prepare(as_port(read_scene(sets / "7003C-DB.toml")))
    said = "Shaft of another model: it gives its motion at X = 0 and takes force and moment of the bearings"
    assert terminals(as_fmu_model(port))["port"][1] == said


def test_terminals_are_written_on_request_alone(fmu):
    with zipfile.ZipFile(fmu) as archive:
        assert TERMINALS_FILE not in archive.namelist()


# --- refusals ---------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("options", "said"),
    [
        ({"outputs": ["inner_ring.displcement.x"]}, "did you mean 'inner_ring.displacement.x'?"),
        ({"outputs": ["shaft_speed"]}, "fmu.outputs: 'shaft_speed' is an input; leave it out"),
        ({"inputs": ["heat.oil"]}, "fmu.inputs: 'heat.oil' is not an input: it is computed; leave it out"),
        ({"inputs": ["heat.*"]}, "fmu.inputs: there is no variable 'heat.*'"),
        ({"naming": "camel"}, "fmu.naming = 'camel' is refused; allowed: structured, flat"),
        ({"outputs": "heat.oil"}, "fmu.outputs = 'heat.oil' is refused; allowed: a list of"),
        ({"outputs": [1]}, "fmu.outputs[1] = 1 is refused; allowed: a list of"),
    ],
)
def test_refusals_name_the_key_and_the_way_out(scene_file, options, said):
    with pytest.raises(SceneError, match=re.escape(said)):
        changed(scene_file, **options)


def test_scene_check_looks_at_the_names(scene_file, tmp_path):
    file = tmp_path / "s.toml"
    file.write_text(read_scene(scene_file).replace({"fmu.outputs": ["stifness.axial"]}).to_toml())
    done = CliRunner().invoke(cli.app, ["scene", "check", str(file)])
    assert done.exit_code != 0
    assert "there is no variable 'stifness.axial'; did you mean 'stiffness.axial'?" in done.output
