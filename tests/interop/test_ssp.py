"""One .ssp of motor, bearing and thermal network: equal results with FMPy, ecos and libcosim."""

import io
import re
import zipfile
from pathlib import Path

import fmpy
import numpy as np
import pytest
from fmpy.fmi1 import FMICallException
from fmpy.ssp.simulation import simulate_ssp
from lxml import etree

from fmu_bearing.fmi.package import build
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene
from tests.conftest import GATES

from .conftest import EXACT_STEP, STEPS, needs_linux64

# Other masters; one FMU and three in FMPy are quick tests (tests/fmi, examples/test_cosimulation).
pytestmark = [needs_linux64, pytest.mark.heavy]


@pytest.fixture(params=["native", "python", "mixed"])
def archive(request, archives):
    return archives[request.param]


@pytest.fixture(scope="module")
def runs(archives):
    """Results by archive and engine."""
    from run import ENGINES

    return {
        flavour: {name: engine(path, STEPS, EXACT_STEP) for name, engine in ENGINES.items()}
        for flavour, path in archives.items()
    }


def read(path, name="SystemStructure.ssd"):
    """Root element of a file in an archive."""
    with zipfile.ZipFile(path) as archive:
        return etree.fromstring(archive.read(name))


def edited(archive, path, **edits):
    """Copy of an archive; ``motor_ssv=edit`` changes the text of the file ``motor.ssv``."""
    with zipfile.ZipFile(archive) as old, zipfile.ZipFile(path, "w") as new:
        for name in old.namelist():
            data = old.read(name)
            for end, edit in edits.items():
                if name.endswith(end.replace("_", ".")):
                    changed = edit(data.decode())
                    assert changed != data.decode()
                    data = changed.encode()
            new.writestr(name, data)
    return path


def faster(text):
    return re.sub(r'(ramp_time">\s*<ssv:Real value=")[^"]*', r"\g<1>0.005", text)


@pytest.fixture
def other_ramp(archives, tmp_path):
    """An archive whose parameters ask for a faster run-up than the start values inside its FMUs."""
    return edited(archives["native"], tmp_path / "other.ssp", motor_ssv=faster)


@pytest.fixture
def ramp_of_the_system(archives, tmp_path):
    """The same, with the motor's parameters bound to the system, by ``component.variable``."""
    bindings = r"<ssd:ParameterBindings>.*?motor.ssv.*?</ssd:ParameterBindings>"

    def structure(text):
        (found,) = re.findall(bindings, text, flags=re.DOTALL)
        return text.replace(found, "").replace("<ssd:Elements>", f"{found}<ssd:Elements>", 1)

    def parameters(text):
        return faster(text.replace('<ssv:Parameter name="', '<ssv:Parameter name="motor.'))

    path = tmp_path / "system.ssp"
    return edited(archives["native"], path, motor_ssv=parameters, SystemStructure_ssd=structure)


def schema(name):
    folder = Path(fmpy.__file__).parent / "ssp" / "schema"
    return etree.XMLSchema(etree.parse(folder / f"SystemStructure{name}.xsd"))


def test_files_are_valid(archive):
    schema("Description").assertValid(read(archive))
    sources = [binding.get("source") for binding in read(archive).iterfind(".//{*}ParameterBinding")]
    assert sources == ["resources/motor.ssv", "resources/thermal.ssv"]
    for source in sources:
        schema("ParameterValues").assertValid(read(archive, source))


def test_units_are_defined_where_they_are_used(archive):
    """SSP 1.0: a unit "must reference one of the unit definitions" of the file it stands in."""
    from build import UNITS

    files = ["SystemStructure.ssd", "resources/motor.ssv", "resources/thermal.ssv"]
    for root in (read(archive, name) for name in files):
        reals = list(root.iterfind(".//{*}Real"))
        defined = {
            unit.get("name"): {key: int(power) for key, power in unit[0].attrib.items()}
            for unit in root.iterfind("{*}Units/{*}Unit")
        }
        assert defined == {real.get("unit"): UNITS[real.get("unit")][0] for real in reals}


def test_what_omsimulator_reads(archive):
    """Rules of its source: prefixes as text, no other child of the root, one annotation with a master."""
    root = read(archive)
    prefixes = {"ssd", "ssc", "oms"}
    assert {element.prefix for element in root.iter()} == prefixes
    for prefix in prefixes - {"oms"}:
        assert root.nsmap[prefix].startswith("http://ssp-standard.org/SSP1/SystemStructure")
    assert [etree.QName(child).localname for child in root] == ["System", "Units", "DefaultExperiment"]
    system, _, experiment = root
    path = "{*}Annotations/{*}Annotation[@type='org.openmodelica']/{*}Annotations/{*}SimulationInformation"
    (master,) = system.find(path)
    assert etree.QName(master).localname == "FixedStepMaster"
    assert (master.get("description"), float(master.get("stepSize"))) == ("oms-ma", EXACT_STEP)
    assert "e" not in master.get("stepSize")  # a decimal in its schema
    assert float(master.get("relativeTolerance")) > 0.0
    assert experiment.find(path).get("resultFile").endswith(".csv")
    assert float(experiment.get("stopTime")) == 0.1
    for name in ("spindle", *(part.get("name") for part in root.iterfind(".//{*}Component"))):
        assert name.isidentifier()
    for parameters in ("resources/motor.ssv", "resources/thermal.ssv"):
        assert {element.prefix for element in read(archive, parameters).iter()} == {"ssv", "ssc"}


def test_every_end_of_a_connection_is_a_variable(archive, tmp_path):
    with zipfile.ZipFile(archive) as file:
        file.extractall(tmp_path)
    root = read(archive)
    descriptions = {
        component.get("name"): fmpy.read_model_description(str(tmp_path / component.get("source")))
        for component in root.iterfind(".//{*}Component")
    }
    variables = {(name, v.name): v for name, d in descriptions.items() for v in d.modelVariables}
    for connection in root.iterfind(".//{*}Connection"):
        output = variables[connection.get("startElement"), connection.get("startConnector")]
        given = variables[connection.get("endElement"), connection.get("endConnector")]
        assert (output.causality, given.causality) == ("output", "input")
        assert output.unit == given.unit
    for component in root.iterfind(".//{*}Component"):
        for connector in component.iterfind(".//{*}Connector"):
            variable = variables[component.get("name"), connector.get("name")]
            assert (variable.causality, variable.unit) == (connector.get("kind"), connector[0].get("unit"))
        for binding in component.iterfind(".//{*}ParameterBinding"):
            parameters = read(archive, binding.get("source"))
            assert parameters.get("name") == "operation"
            for parameter in parameters.iterfind(".//{*}Parameter"):
                variable = variables[component.get("name"), parameter.get("name")]
                assert variable.causality == "parameter"
                assert float(variable.start) == float(parameter[0].get("value"))
                assert variable.unit == parameter[0].get("unit")


def test_written_twice_it_is_the_same(fmus, archives, tmp_path):
    from write import write

    again = write(fmus["native"], tmp_path / "a.ssp", target_speed=2300.0, ramp_time=0.02, stop_time=0.1)
    # native partners are the default, as there is a compiler
    assert again.read_bytes() == archives["native"].read_bytes()


@pytest.mark.parametrize("engine", ["ecos", "libcosim"])
@pytest.mark.parametrize("flavour", ["native", "python", "mixed"])
def test_engines_agree_to_the_last_bit(runs, flavour, engine):
    # The same algorithm and times that all of them count exactly: nothing is left to differ.
    expected, found = runs[flavour]["fmpy"], runs[flavour][engine]
    assert found.dtype == expected.dtype
    for name in expected.dtype.names:
        assert np.array_equal(found[name], expected[name]), name


@pytest.mark.parametrize("flavour", ["python", "mixed"])
def test_builds_agree_to_the_last_bit(runs, flavour):
    """Motor and thermal network in C give what they give in Python, and so does the bearing."""
    expected, found = runs["native"]["fmpy"], runs[flavour]["fmpy"]
    assert len(expected.dtype.names) == 9
    for name in expected.dtype.names:
        assert np.array_equal(found[name], expected[name]), name


def needing_python(path):
    """Names of the FMUs in an archive that need a program beside them."""
    with zipfile.ZipFile(path) as archive:
        fmus = [name for name in archive.namelist() if name.endswith(".fmu")]
        descriptions = [fmpy.read_model_description(io.BytesIO(archive.read(name))) for name in fmus]
    return {d.modelName for d in descriptions if d.coSimulation.needsExecutionTool}


def test_the_native_archive_needs_no_python(archives):
    assert needing_python(archives["native"]) == set()
    assert needing_python(archives["mixed"]) == {"SpindleMotor", "SpindleThermal"}


def test_the_system_does_what_it_is_for(runs):
    run = runs["native"]["fmpy"]
    assert run["time"] == pytest.approx(np.arange(1, STEPS + 1) * EXACT_STEP, rel=1e-15)
    assert run["motor.shaft_speed"][0] == pytest.approx(2094.4, abs=5.0)
    # 50 ms of 20 Hz control behind a ramp of 20 ms: most of the way to 2300 rad/s
    assert 2200.0 < run["motor.shaft_speed"][-1] < 2400.0
    assert np.all(np.diff(run["thermal.oil_temperature"]) > 0.0)
    power = run["bearing.friction_torque"] * run["motor.shaft_speed"]
    heat = sum(run[f"bearing.heat.{part}"] for part in ("inner_ring", "outer_ring", "oil"))
    # Torque at twelve instants, which scatter by 17 of 57 W, against heat as a mean of the step: a standard
    # error of 9 %, and the run-up spins balls and cage up as well.
    assert heat[4:].mean() == pytest.approx(power[4:].mean(), rel=0.2)


def test_another_step_changes_no_more_than_rounding_at_first(archives):
    from run import largest_difference, run_fmpy, run_libcosim

    # 0.5 ms is no exact binary number: sums and nanoseconds differ by 1e-16 s, and the motion amplifies it
    # a hundredfold each millisecond or so.
    one, other = (engine(archives["native"], 6, 5e-4) for engine in (run_fmpy, run_libcosim))
    assert largest_difference(one, other) < 1e-9


def test_the_spindle_scene_for_a_fifth_of_a_second(tmp_path):
    from run import ENGINES
    from write import write

    model = prepare(read_scene(GATES / "7003C-spindle.toml"))
    bearing = build(model, tmp_path / "Bearing7003C.fmu", flavour="native").path
    archive = write(bearing, tmp_path / "spindle.ssp", target_speed=2300.0, ramp_time=0.1, stop_time=0.2)
    expected, *others = (engine(archive, 100, EXACT_STEP) for engine in ENGINES.values())
    for found in others:
        for name in expected.dtype.names:
            assert np.array_equal(found[name], expected[name]), name
    assert expected["motor.shaft_speed"][-1] == pytest.approx(2300.0, rel=2e-3)


def test_parameters_of_the_archive(archives, other_ramp):
    from run import run_ecos, run_fmpy, run_libcosim

    def speed(engine, path, **options):
        return engine(path, 4, EXACT_STEP, **options)["motor.shaft_speed"]

    slow, fast = speed(run_fmpy, archives["native"]), speed(run_libcosim, other_ramp)
    assert fast[-1] > slow[-1] + 20.0
    assert np.array_equal(speed(run_ecos, other_ramp, parameter_set="operation"), fast)
    # What the page on other tools says of them: without the name ecos keeps the start values, FMPy always.
    assert np.array_equal(speed(run_ecos, other_ramp), slow)
    assert np.array_equal(speed(run_fmpy, other_ramp), slow)


@pytest.mark.parametrize("engine", ["ecos", "libcosim"])
def test_parameters_of_the_system_are_not_read(archives, ramp_of_the_system, engine):
    """Why each set is bound to its component."""
    from run import run_ecos, run_fmpy, run_libcosim

    schema("Description").assertValid(read(ramp_of_the_system))
    slow = run_fmpy(archives["native"], 4, EXACT_STEP)["motor.shaft_speed"]
    if engine == "ecos":
        found = run_ecos(ramp_of_the_system, 4, EXACT_STEP, parameter_set="operation")
    else:
        found = run_libcosim(ramp_of_the_system, 4, EXACT_STEP)
    assert np.array_equal(found["motor.shaft_speed"], slow)


def test_fmpy_alone_begins_at_absolute_zero(archive):
    # The reason for what run_fmpy does before the first step.
    with pytest.raises(FMICallException, match="discard"):
        simulate_ssp(str(archive), stop_time=2 * EXACT_STEP, step_size=EXACT_STEP)


def test_unequal_temperatures_are_refused(fmus, monkeypatch):
    from coupling import Fmu, SimulationError
    from write import operating_point

    get = Fmu.get
    monkeypatch.setattr(Fmu, "get", lambda self, names: [float(k) for k, _ in enumerate(get(self, names))])
    with pytest.raises(SimulationError, match="oil_temperature 3 K.*equal temperatures"):
        operating_point(fmus["native"])


def test_commands(fmus, tmp_path):
    import run
    import write
    from typer import Typer
    from typer.testing import CliRunner

    archive = tmp_path / "made" / "spindle.ssp"
    for module, arguments, words in (
        (write, [str(fmus["native"]), "-o", str(archive), "--partners", "python"], "wrote"),
        (run, [str(archive), "--output-dir", str(tmp_path), "--steps", "3"], "libcosim"),
    ):
        app = Typer()
        app.command()(module.main)
        result = CliRunner().invoke(app, arguments)
        assert result.exit_code == 0, result.output
        assert words in result.output
    assert needing_python(archive) == {"SpindleMotor", "SpindleThermal"}
    assert result.output.count("largest difference to FMPy 0\n") == 3
    assert len((tmp_path / "spindle_ecos.csv").read_text().splitlines()) == 4
