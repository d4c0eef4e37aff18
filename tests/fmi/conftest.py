"""An FMU of the default scene, built once, and a master that keeps the log."""

import itertools
import pathlib
import zipfile

import fmpy
import fmpy.fmi2
import pytest

from fmu_bearing.fmi.package import build
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene

ROOT = pathlib.Path(__file__).parents[2]
DEFAULT_SCENE = ROOT / "examples" / "scenes" / "7003C-spindle.toml"
STEP = 2e-4  # s


@pytest.fixture(scope="session")
def model():
    return prepare(read_scene(DEFAULT_SCENE))


@pytest.fixture(scope="session")
def fmu(model, tmp_path_factory):
    return build(model, tmp_path_factory.mktemp("fmu") / "Bearing7003C.fmu").path


@pytest.fixture(scope="session")
def description(fmu):
    return fmpy.read_model_description(fmu)


@pytest.fixture(scope="session")
def unpacked(fmu, tmp_path_factory):
    folder = tmp_path_factory.mktemp("unpacked fmu")  # the blank is on purpose
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    return folder


class Master:
    """One instance of an FMU with variables by name; ``log`` holds (status, category, message)."""

    numbers = itertools.count()

    def __init__(self, folder, logging=True):
        self.description = fmpy.read_model_description(str(folder))
        self.by_name = {variable.name: variable for variable in self.description.modelVariables}
        self.log = []
        self.slave = fmpy.fmi2.FMU2Slave(
            guid=self.description.guid,
            unzipDirectory=str(folder),
            modelIdentifier=self.description.coSimulation.modelIdentifier,
            instanceName=f"bearing{next(self.numbers)}",
        )
        self.callbacks = fmpy.fmi2.fmi2CallbackFunctions()
        self.callbacks.logger = fmpy.fmi2.fmi2CallbackLoggerTYPE(self._message)
        self.callbacks.allocateMemory = fmpy.fmi2.fmi2CallbackAllocateMemoryTYPE(fmpy.fmi2.calloc)
        self.callbacks.freeMemory = fmpy.fmi2.fmi2CallbackFreeMemoryTYPE(fmpy.fmi2.free)
        self.slave.instantiate(callbacks=self.callbacks, loggingOn=logging)

    def _message(self, _environment, _instance, status, category, message):
        self.log.append((status, (category or b"").decode(), message.decode()))

    @property
    def messages(self):
        return "\n".join(message for _, _, message in self.log)

    def start(self, time=0.0, tolerance=None, **inputs):
        self.slave.setupExperiment(startTime=time, tolerance=tolerance)
        self.slave.enterInitializationMode()
        for name, value in inputs.items():
            self.set(name, value)
        self.slave.exitInitializationMode()
        return self

    def set(self, name, value):
        variable = self.by_name[name]
        call = self.slave.setReal if variable.type == "Real" else self.slave.setInteger
        call([variable.valueReference], [value])

    def get(self, name):
        variable = self.by_name[name]
        call = self.slave.getReal if variable.type == "Real" else self.slave.getInteger
        return call([variable.valueReference])[0]

    def reals(self):
        """All Reals, in the order of the table."""
        found = [v.valueReference for v in self.description.modelVariables if v.type == "Real"]
        return self.slave.getReal(found)

    def step(self, time, size=STEP):
        self.slave.doStep(time, size)

    def run(self, steps, time=0.0, size=STEP):
        """Values of all Reals after each of so many steps."""
        taken = []
        for i in range(steps):
            self.step(time + i * size, size)
            taken.append(self.reals())
        return taken


@pytest.fixture
def master(unpacked):
    """Instances of the unpacked FMU, freed at the end of the test."""
    made = []

    def instantiate(folder=unpacked, **options):
        made.append(Master(folder, **options))
        return made[-1]

    yield instantiate
    for one in made:
        one.slave.freeInstance()
