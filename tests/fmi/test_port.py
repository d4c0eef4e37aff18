"""FMUs with a mechanical port: the native build answers for its derivatives, and both say so."""

import importlib.util
import math
from pathlib import Path
from xml.etree.ElementTree import fromstring

import pytest
from fmpy import extract, instantiate_fmu, read_model_description
from fmpy.fmi1 import FMICallException
from fmpy.validation import validate_fmu
from lxml import etree

from fmu_bearing import read_scene
from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.fmi.description import description_xml
from fmu_bearing.fmi.package import build
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from tests.examples.conftest import ROOT
from tests.native_builds import no_native_fmu

SCENE = ROOT / "examples" / "port" / "7003C-DB-port.toml"
STEP = 1e-4
OUTPUTS = [f"port.force.{axis}" for axis in "xyz"] + ["port.moment.y", "port.moment.z"]
INPUTS = [
    *(f"port.displacement.{axis}" for axis in "xyz"), "port.tilt.y", "port.tilt.z",
    *(f"port.velocity.{axis}" for axis in "xyz"), "port.tilt_rate.y", "port.tilt_rate.z",
]  # fmt: skip
MOTION = dict(zip(INPUTS, [1e-6, -2e-6, 2e-6, 1e-5, 2e-5, 0.01, -0.02, 0.02, 0.1, 0.2], strict=True))


@pytest.fixture(scope="module")
def model():
    return prepare(read_scene(SCENE).replace({"fidelity.model": "full"}))


@pytest.fixture(scope="module")
def fmu(model, tmp_path_factory):
    try:
        built = build(model, tmp_path_factory.mktemp("port") / "port.fmu", flavour="native")
    except BuildError as problem:
        no_native_fmu(problem)
    return str(built.path)


class Slave:
    """The native FMU, by names."""

    def __init__(self, fmu, initialise=True):
        description = read_model_description(fmu)
        self.numbers = {v.name: v.valueReference for v in description.modelVariables}
        self.slave = instantiate_fmu(extract(fmu), description, fmi_type="CoSimulation")
        self.slave.setupExperiment(startTime=0.0)
        self.slave.enterInitializationMode()
        if initialise:
            self.slave.exitInitializationMode()

    def of(self, names):
        return [self.numbers[name] for name in names]

    def step(self, time):
        self.slave.setReal(self.of(MOTION), list(MOTION.values()))
        self.slave.doStep(time, STEP)

    def derivative(self, unknown, known):
        return self.slave.getDirectionalDerivative(self.of(unknown), self.of(known), [1.0] * len(known))


@pytest.mark.parametrize(("flavour", "provides"), [("native", "true"), ("python", "false")])
def test_description_says_who_has_derivatives(model, flavour, provides):
    can = fromstring(description_xml(model, flavour)).find("CoSimulation")
    assert can.get("providesDirectionalDerivative") == provides


@pytest.mark.heavy
@pytest.mark.parametrize("flavour", ["native", "python"])
def test_checkers_find_nothing(model, fmu, tmp_path, flavour):
    path = fmu if flavour == "native" else str(build(model, tmp_path / "port.fmu", flavour="python").path)
    assert validate_fmu(path) == []
    tree = etree.parse(Path(extract(path, tmp_path / "fmu")) / "modelDescription.xml")
    schema = Path(importlib.util.find_spec("fmpy").origin).parent / "schema" / "fmi2"
    etree.XMLSchema(etree.parse(schema / "fmi2ModelDescription.xsd")).assertValid(tree)
    # the description says what a master adds to its rotor
    (reported,) = tree.xpath("//ScalarVariable[@name='port.mass']/Real/@start")
    (mass,) = (one.value for one in model.variables if one.name == "port.mass")
    assert float(reported) == mass > 0.01
    text = (tmp_path / "fmu" / "documentation" / "index.html").read_text("utf-8")
    assert "carry a rotor that another model owns" in text and "loads on the nose" not in " ".join(
        text.split()
    )


def test_native_derivatives_are_the_librarys(model, fmu):
    slave, one = Slave(fmu), Instance(model)
    one.initialise()
    slave.step(0.0)
    for name, value in MOTION.items():
        one.set(name, value)
    one.step(STEP)
    assert slave.slave.getReal(slave.of(OUTPUTS)) == [one.get(name) for name in OUTPUTS]
    place, rate = one.port_derivatives(STEP)
    for k, name in enumerate(INPUTS):
        column = place[:, k] if k < len(OUTPUTS) else rate[:, k - len(OUTPUTS)]
        assert slave.derivative(OUTPUTS, [name]) == list(column)
    # the state is as it was
    slave.step(STEP)
    one.step(STEP)
    assert slave.slave.getReal(slave.of(OUTPUTS)) == [one.get(name) for name in OUTPUTS]


def test_derivatives_are_known_while_initialising(fmu):
    """Whatever was read before: the state is found when it is asked for."""
    slave = Slave(fmu, initialise=False)
    begin = slave.derivative(["port.force.z"], ["port.displacement.z"])
    slave.slave.exitInitializationMode()
    assert slave.derivative(["port.force.z"], ["port.displacement.z"]) == begin
    assert begin[0] < -1e8


def test_before_the_first_step_rates_change_nothing(fmu):
    slave = Slave(fmu)
    assert slave.derivative(["port.force.z"], ["port.velocity.z"]) == [0.0]
    assert slave.derivative(["port.force.z"], ["port.displacement.z"])[0] < -1e8


@pytest.mark.parametrize(
    ("unknown", "known"),
    [
        ("port.force.z", "shaft_speed"),
        ("friction_torque", "port.displacement.z"),
        ("port.mass", "port.tilt.y"),
    ],
)
def test_what_there_is_not_is_an_error_and_the_fmu_goes_on(fmu, unknown, known):
    slave = Slave(fmu)
    with pytest.raises(FMICallException) as refused:
        slave.derivative([unknown], [known])
    assert refused.value.status == 3  # fmi2Error
    slave.step(0.0)
    assert math.isfinite(slave.slave.getReal(slave.of(["port.force.z"]))[0])


def test_rates_of_place_end_where_they_lead(model, fmu):
    """A place with an input derivative is led to its value at the step's end, as the speed is."""
    slave, one = Slave(fmu), Instance(model)
    one.initialise()
    slave.slave.setRealInputDerivatives(slave.of(["port.displacement.z"]), [1], [0.01])
    slave.slave.doStep(0.0, STEP)
    one.set("port.displacement.z", 0.01 * STEP)
    one.step(STEP)
    assert slave.slave.getReal(slave.of(OUTPUTS)) == [one.get(name) for name in OUTPUTS]
