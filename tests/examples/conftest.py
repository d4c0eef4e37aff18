"""FMUs of the spindle example, built once per worker, and the example's folder as a place to import from."""

import importlib.util
import pathlib
import sys

import pytest

from fmu_bearing import build_fmu

ROOT = pathlib.Path(__file__).parents[2]
SPINDLE = ROOT / "examples" / "spindle_cosimulation"


@pytest.fixture(scope="session", autouse=True)
def spindle_modules():
    """The example's modules import each other by their bare names, as when it is run as a script."""
    sys.path.insert(0, str(SPINDLE))
    yield
    sys.path.remove(str(SPINDLE))


@pytest.fixture(scope="session")
def builder():
    """The example's build.py, under a name of its own: `build` is a common name for a module."""
    spec = importlib.util.spec_from_file_location("spindle_build", SPINDLE / "build.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    module.UNITS |= {name: ({}, None) for name in ("N", "m", "Pa", "Pa.s", "rad", "dB")}
    return module


@pytest.fixture(scope="session")
def partners(builder, tmp_path_factory):
    """Folder with motor and thermal FMU by flavour; native ones where a C compiler is there."""
    folders = {"python": tmp_path_factory.mktemp("python"), "native": tmp_path_factory.mktemp("native")}
    if builder.best_flavour() != "native":
        del folders["native"]
    for flavour, folder in folders.items():
        for model in builder.MODELS:
            builder.build(SPINDLE / f"{model}.py", folder, flavour)
    return folders


@pytest.fixture(scope="session")
def fmus(builder, tmp_path_factory):
    """Folder with motor and thermal FMU and, under the bearing's name, a stand-in for the bearing."""
    folder = tmp_path_factory.mktemp("fmus")
    for model in builder.MODELS:
        builder.build(SPINDLE / f"{model}.py", folder)
    stub = builder.build(pathlib.Path(__file__).parent / "stub_bearing.py", folder)
    stub.rename(folder / "Bearing7003C.fmu")
    return folder


@pytest.fixture(scope="session")
def real_fmus(builder, example, tmp_path_factory):
    """Folder with all three FMUs, the bearing built from the example scene with compact sound."""
    folder = tmp_path_factory.mktemp("real")
    for model in builder.MODELS:
        builder.build(SPINDLE / f"{model}.py", folder)
    build_fmu(example("7003C-spindle"), folder / "Bearing7003C.fmu")
    return folder
