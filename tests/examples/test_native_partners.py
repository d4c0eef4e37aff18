"""Motor and thermal network in C: every bit of the Python slaves, and FMI's rules for calls."""

import zipfile

import fmpy
import numpy as np
import pytest
from fmpy import extract, instantiate_fmu, read_model_description
from fmpy.fmi1 import FMICallException

from fmu_bearing.compiled import BuildError
from fmu_bearing.compiled.platforms import PLATFORMS, host

from .conftest import SPINDLE

FILES = {"motor": "SpindleMotor.fmu", "thermal": "SpindleThermal.fmu"}
PARAMETERS = {
    # a torque limit that is met, and a run-up that begins between two samples
    "motor": {
        "start_speed": 190.7, "target_speed": 260.3, "ramp_start": 0.00213, "ramp_time": 0.93,
        "torque_limit": 0.3, "bandwidth": 127.9, "rotor_inertia": 1.37e-4,
    },
    "thermal": {"initial_temperature": 311.3, "conductance.oil_ambient": 0.77, "capacity.oil": 0.031},
}  # fmt: skip
INPUTS = {"motor": ("load_torque",), "thermal": ("heat.inner_ring", "heat.outer_ring", "heat.oil")}
STEPS = (5e-4, 1e-4, 3.7e-4, 1e-3, 2.0**-9, 0.0123)


@pytest.fixture(autouse=True)
def needs_compiler(partners):
    if "native" not in partners:
        pytest.skip("no C compiler")


@pytest.fixture(params=FILES)
def model(request):
    return request.param


class Logged:
    """A native FMU through FMPy, with what it said."""

    def __init__(self, path, logging=True):
        self.said = []
        self.description = read_model_description(str(path))
        self.number = {v.name: v.valueReference for v in self.description.modelVariables}
        # FMPy passes the messages of all FMUs to the function given last
        self.slave = instantiate_fmu(
            extract(str(path)),
            self.description,
            fmi_type="CoSimulation",
            debug_logging=logging,
            logger=lambda _e, _n, status, category, text: self.said.append((status, category, text.decode())),
        )

    def start(self):
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        self.slave.exitInitializationMode()
        return self

    def refused(self, status, words, call, *arguments):
        with pytest.raises(FMICallException, match=status):
            call(*arguments)
        assert words in self.said[-1][2]


@pytest.fixture
def native(partners, model):
    fmu = Logged(partners["native"] / FILES[model])
    yield fmu
    fmu.slave.freeInstance()


def changing(variables):
    return [v.name for v in variables.values() if v.causality in ("input", "output")]


def test_every_bit_of_the_python_slave(partners, model):
    """600 steps of random inputs and lengths; the matrix of the thermal network is made again at times."""
    from coupling import Fmu

    random = np.random.default_rng(14)
    with (
        Fmu(partners["python"] / FILES[model], "python") as slave,
        Fmu(partners["native"] / FILES[model], "native") as native,
    ):
        shown = changing(native.variables)
        both = (slave, native)
        for fmu in both:
            fmu.enter_initialization(**PARAMETERS[model], **dict.fromkeys(INPUTS[model], 0.125))
            fmu.exit_initialization()
        assert native.get(shown) == slave.get(shown)
        time, found = 0.0, []
        for _ in range(600):
            step = float(random.choice(STEPS)) * (1.0 + 1e-11 * random.integers(-2, 3))
            values = {name: float(random.uniform(-0.4, 0.6)) for name in INPUTS[model]}
            for fmu in both:
                fmu.set(values)
                fmu.step(time, step)
            time += step
            assert native.get(shown) == slave.get(shown), time
            found.append(native.get(shown))
        if model == "motor":  # at its limit at times, and not at others
            limited = np.abs([row[shown.index("motor_torque")] for row in found]) == 0.3
            assert 0.1 < limited.mean() < 0.9
        # the comparison is worth something: outputs move, and to different places
        assert all(len(set(column)) > 100 for column in np.transpose(found))


def test_descriptions_differ_in_what_they_need_alone(partners, model):
    of = {flavour: folder / FILES[model] for flavour, folder in partners.items()}
    assert fmpy.validation.validate_fmu(str(of["native"])) == []
    python, native = (read_model_description(str(of[flavour])) for flavour in ("python", "native"))

    def rows(description):
        names = ("name", "valueReference", "causality", "variability", "unit", "start", "description")
        return [tuple(getattr(v, name) for name in names) for v in description.modelVariables]

    assert rows(native) == rows(python)
    assert native.guid != python.guid
    assert python.coSimulation.needsExecutionTool and not native.coSimulation.needsExecutionTool
    with zipfile.ZipFile(of["native"]) as archive:
        assert {name.split("/")[0] for name in archive.namelist()} == {"binaries", "modelDescription.xml"}


def test_starts_of_the_description_are_those_of_the_instance(native):
    for variable in native.description.modelVariables:
        if variable.start is not None:
            assert native.slave.getReal([variable.valueReference]) == [float(variable.start)], variable.name


def test_initial_dependencies_are_true(partners, model):
    """In initialisation mode an output follows what its description names, and nothing else."""
    native = Logged(partners["native"] / FILES[model])
    native.slave.setupExperiment(startTime=0.0)
    native.slave.enterInitializationMode()
    variables = native.description.modelVariables
    unknowns = native.description.initialUnknowns
    assert len(unknowns) == len([v for v in variables if v.causality == "output"])
    references = [unknown.variable.valueReference for unknown in unknowns]
    followed = {unknown.variable.name: set() for unknown in unknowns}
    if model == "motor":
        native.slave.setReal([native.number["load_torque"]], [2.0])  # the limit of 1 N.m holds
    for variable in variables:
        if variable.causality == "output":
            continue
        (value,) = native.slave.getReal([variable.valueReference])
        before = native.slave.getReal(references)
        native.slave.setReal([variable.valueReference], [0.25 * value + 0.0625])
        after = native.slave.getReal(references)
        native.slave.setReal([variable.valueReference], [value])
        for unknown, one, other in zip(unknowns, before, after, strict=True):
            if one != other:
                followed[unknown.variable.name].add(variable.name)
    for unknown in unknowns:
        assert {v.name for v in unknown.dependencies} == followed[unknown.variable.name], (
            unknown.variable.name
        )
    native.slave.freeInstance()


def test_a_state_put_back_goes_on_as_before(native, model):
    native.start()
    shown = [native.number[v.name] for v in native.description.modelVariables if v.causality == "output"]

    def go_on():
        for k in range(5):
            native.slave.doStep(1e-3 + k * 3e-4, 3e-4)
        return native.slave.getReal(shown)

    native.slave.setReal([native.number[name] for name in INPUTS[model]], [0.5] * len(INPUTS[model]))
    native.slave.doStep(0.0, 1e-3)
    kept = native.slave.getFMUstate()
    data = native.slave.serializeFMUstate(kept)
    first = go_on()
    native.slave.setFMUstate(kept)
    assert go_on() == first
    native.slave.freeFMUstate(kept)
    again = native.slave.deSerializeFMUstate(data)
    native.slave.reset()
    native.slave.setFMUstate(again)
    assert go_on() == first
    other = bytes(data[:5]) + b"#" + bytes(data[6:])
    native.refused("error", "are not a state of this FMU", native.slave.deSerializeFMUstate, other)
    native.slave.freeFMUstate(again)


def test_calls_out_of_order_are_errors(native):
    slave = native.slave
    native.refused("error", "fmi2DoStep is not allowed: the instance is", slave.doStep, 0.0, 1e-3)
    native.refused("error", "fmi2ExitInitializationMode is not", slave.exitInitializationMode)
    native.start()
    native.refused("error", "fmi2EnterInitializationMode is not", slave.enterInitializationMode)
    native.refused("error", "but the FMU is at 0 s", slave.doStep, 0.5, 1e-3)
    for size in (0.0, -1e-3, float("nan"), float("inf")):
        native.refused("discard", "its size is not a positive number", slave.doStep, 0.0, size)
    native.refused("error", "there is no Real with value reference 99", slave.getReal, [99])
    native.refused("error", "has no Integers", slave.getInteger, [0])
    slave.terminate()
    native.refused("error", "not allowed: the instance is terminated", slave.setReal, [0], [1.0])


def test_values_that_cannot_be_are_refused(native, model):
    name = INPUTS[model][0]
    reference = [native.number[name]]
    native.start()
    native.slave.setReal(reference, [0.5])
    for value in (float("nan"), float("inf"), float("-inf")):
        native.refused("discard", f"value not taken: {name} = ", native.slave.setReal, reference, [value])
    assert native.slave.getReal(reference) == [0.5]
    output = next(v for v in native.description.modelVariables if v.causality == "output")
    parameter = next(v for v in native.description.modelVariables if v.causality == "parameter")
    native.refused("error", "is computed, not set", native.slave.setReal, [output.valueReference], [1.0])
    native.slave.setReal([parameter.valueReference], [float(parameter.start)])  # no change
    native.refused("error", "between steps", native.slave.setReal, [parameter.valueReference], [1.5])
    native.slave.doStep(0.0, 1e-3)


@pytest.mark.parametrize(
    ("file", "parameter"), [("SpindleMotor.fmu", "rotor_inertia"), ("SpindleThermal.fmu", "capacity.oil")]
)
def test_a_step_without_inertia_or_capacity_is_refused(partners, file, parameter):
    native = Logged(partners["native"] / file)
    native.slave.setReal([native.number[parameter]], [0.0])
    native.start()
    native.refused("discard", "is not positive", native.slave.doStep, 0.0, 1e-3)
    native.slave.freeInstance()


@pytest.mark.parametrize("flavour", ["native", "python"])
def test_a_control_period_without_end_is_refused(partners, flavour):
    motor = Logged(partners[flavour] / "SpindleMotor.fmu")
    motor.slave.setReal([motor.number["control_period"]], [1e-300])
    motor.start()
    with pytest.raises(FMICallException):
        motor.slave.doStep(0.0, 1e-3)
    motor.slave.freeInstance()


def test_nothing_is_said_unless_asked_for(partners, model):
    native = Logged(partners["native"] / FILES[model], logging=False)
    with pytest.raises(FMICallException):
        native.slave.doStep(0.0, 1e-3)
    assert native.said == []
    native.slave.setDebugLogging(True, ["logStatusError"])
    native.refused("error", "is not allowed", native.slave.doStep, 0.0, 1e-3)
    assert native.said[0][:2] == (3, b"logStatusError")
    native.slave.freeInstance()


def test_built_twice_it_is_the_same(builder, partners, model, tmp_path):
    again = builder.build(SPINDLE / f"{model}.py", tmp_path, "native")
    assert again.read_bytes() == (partners["native"] / FILES[model]).read_bytes()


def test_other_starts_make_another_library_and_guid(builder, partners, tmp_path):
    source = (SPINDLE / "motor.py").read_text().replace("209.43951023931953", "99.1")
    (tmp_path / "motor.py").write_text(source)
    slow = Logged(builder.build(tmp_path / "motor.py", tmp_path, "native")).start()
    assert slow.slave.getReal([slow.number["shaft_speed"]]) == [99.1]
    assert slow.description.guid != read_model_description(str(partners["native"] / FILES["motor"])).guid
    slow.slave.freeInstance()


@pytest.mark.heavy  # Zig builds the C libraries of both platforms first: 170 s
def test_other_platforms(builder, tmp_path):
    pytest.importorskip("ziglang")
    names = ["win64", "aarch64-linux"]
    path = builder.build(SPINDLE / "motor.py", tmp_path, "native", names)
    with zipfile.ZipFile(path) as archive:
        libraries = {name: archive.read(name)[:4] for name in archive.namelist() if "binaries" in name}
    expected = {f"binaries/{name}/SpindleMotor{PLATFORMS[name].suffix}" for name in names}
    assert libraries.keys() == expected
    assert libraries["binaries/win64/SpindleMotor.dll"][:2] == b"MZ"
    assert libraries["binaries/aarch64-linux/SpindleMotor.so"] == b"\x7fELF"


def run_command(builder, *arguments):
    from typer import Typer
    from typer.testing import CliRunner

    app = Typer()
    app.command()(builder.main)
    return CliRunner().invoke(app, [str(argument) for argument in arguments])


def test_command(builder, tmp_path):
    result = run_command(builder, "--output-dir", tmp_path)
    assert result.exit_code == 0, result.output
    assert result.output.count(": native\n") == 2
    with zipfile.ZipFile(tmp_path / "SpindleMotor.fmu") as archive:
        assert f"binaries/{host().name}/SpindleMotor{host().suffix}" in archive.namelist()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--flavour", "rust"], "there is no flavour 'rust'"),
        (["--flavour", "python", "--platforms", "win64"], "cannot be chosen for a python build"),
        (["--platforms", "amiga"], "there is no platform 'amiga'"),
    ],
)
def test_command_says_what_it_cannot_build(builder, tmp_path, arguments, words):
    result = run_command(builder, "--output-dir", tmp_path, *arguments)
    assert result.exit_code == 2
    assert result.output.startswith("error: ") and words in result.output


def test_without_a_compiler(builder, tmp_path, monkeypatch):
    def none(platform, prefer="auto"):
        raise BuildError(f"{platform.name}: there is no C compiler; install one")

    monkeypatch.setattr(builder, "compiler_for", none)
    result = run_command(builder, "--output-dir", tmp_path)
    assert result.exit_code == 0 and result.output.count(": python\n") == 2
    result = run_command(builder, "--output-dir", tmp_path, "--flavour", "native")
    assert result.exit_code == 2
    assert "there is no C compiler" in result.output
