"""Both builds of one scene, made once, and a master that keeps the status of every call and the log.

Every test here runs on both builds unless it says otherwise; where pythonfmu cannot do what is asked, the
test looks up the exact difference in ``differences``.
"""

import ctypes
import functools
import pathlib
import zipfile

import fmpy
import pytest

from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.platforms import host
from fmu_bearing.fmi.description import FLAVOURS
from fmu_bearing.fmi.package import build
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene
from tests.conftest import GATES
from tests.native import master as calls
from tests.native_builds import no_native_fmu

from .differences import DIFFERENCES

ROOT = pathlib.Path(__file__).parents[2]
SPINDLE_SCENE = GATES / "7003C-spindle.toml"
STEP = 2e-4  # s
OK, WARNING, DISCARD, ERROR = calls.OK, calls.WARNING, calls.DISCARD, calls.ERROR


@pytest.fixture(scope="session")
def model(scene_file):
    return prepare(read_scene(scene_file))


@pytest.fixture(scope="session", params=FLAVOURS)
def flavour(request):
    return request.param


@pytest.fixture(scope="session")
def fmus(model, tmp_path_factory):
    """A function that builds the FMU of a flavour, once."""
    folder = tmp_path_factory.mktemp("fmu")

    @functools.cache
    def of(flavour):
        try:
            return build(model, folder / flavour / "Bearing7003C.fmu", flavour).path
        except BuildError as problem:
            return str(problem)

    def built(flavour):
        path = of(flavour)
        if isinstance(path, str):
            no_native_fmu(path)
        return path

    return built


@pytest.fixture(scope="session")
def unpack(fmus, tmp_path_factory):
    """A function that unpacks the FMU of a flavour, once."""

    @functools.cache
    def unpacked(flavour):
        folder = tmp_path_factory.mktemp("unpacked fmu") / flavour  # the blank is on purpose
        with zipfile.ZipFile(fmus(flavour)) as archive:
            archive.extractall(folder)
        return folder

    return unpacked


@pytest.fixture(scope="session")
def fmu(fmus, flavour):
    return fmus(flavour)


@pytest.fixture(scope="session")
def unpacked(unpack, flavour):
    return unpack(flavour)


@pytest.fixture(scope="session")
def description(fmu):
    return fmpy.read_model_description(fmu)


@pytest.fixture(scope="session")
def expected(flavour):
    """What this build answers, by behaviour."""
    return {row.behaviour: row.native if flavour == "native" else row.python for row in DIFFERENCES}


read_description = functools.cache(fmpy.read_model_description)
load = functools.cache(calls.load)


def address(function):
    return ctypes.cast(function, ctypes.c_void_p).value


class Master(calls.Master):
    """One instance of an unpacked FMU; ``by_name`` holds its variables."""

    def __init__(self, folder, **options):
        self.folder = folder
        self.description = read_description(str(folder))
        self.by_name = {variable.name: variable for variable in self.description.modelVariables}
        platform = host()
        name = self.description.coSimulation.modelIdentifier
        self.library = str(folder / "binaries" / platform.name / f"{name}{platform.suffix}")
        references = {name: variable.valueReference for name, variable in self.by_name.items()}
        settings = {
            "guid": self.description.guid,
            "references": references,
            "memory": (address(fmpy.calloc), address(fmpy.free)),
            "location": folder / "resources",
            **options,
        }
        super().__init__(load(self.library), **settings)

    def kind_of(self, name):
        return "Integer" if self.by_name[name].type == "Enumeration" else self.by_name[name].type

    def set(self, name, value, kind=None):
        return super().set(name, value, kind or self.kind_of(name))

    def get(self, name, kind=None):
        return super().get(name, kind or self.kind_of(name))

    def everything(self):
        """All Reals and Integers, in the order of the table."""
        taken = []
        for kind in ("Real", "Integer"):
            names = [name for name in self.by_name if self.kind_of(name) == kind]
            status, values = self.read(*names, kind=kind)
            assert status == OK, self.messages
            taken += values
        return taken

    def start(self, time=0.0, tolerance=None, **inputs):
        """Initialise, whatever the values set are answered with."""
        assert self.setup(time, tolerance) == OK
        assert self.enter() == OK
        for name, value in inputs.items():
            self.set(name, value)
        assert self.exit() == OK, self.messages
        return self

    def step(self, time, size=STEP):
        return super().step(time, size)

    def run(self, count, time=0.0, size=STEP):
        """Values of all variables after each of so many steps."""
        return super().run(count, time, size)

    def reset(self):
        return self.call("Reset")


@pytest.fixture
def master(unpacked):
    """Instances of the unpacked FMU, freed at the end of the test."""
    made = []

    def instantiate(folder=unpacked, **options):
        made.append(Master(folder, **options))
        return made[-1]

    yield instantiate
    for one in made:
        if one.instance:
            one.free()
