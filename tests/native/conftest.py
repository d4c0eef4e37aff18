"""The shim with kernels of a toy, compiled once, and masters on it."""

import shutil

import pytest

from . import toy
from .master import Master, load


@pytest.fixture(scope="session")
def compiler():
    if shutil.which("cc") is None:
        pytest.skip("there is no C compiler (cc) on this machine")
    return "cc"


@pytest.fixture(scope="session")
def library(compiler, tmp_path_factory):
    return toy.compile_library(tmp_path_factory.mktemp("toy library"))


@pytest.fixture(scope="session")
def functions(library):
    return load(library)


@pytest.fixture(scope="session")
def resources(tmp_path_factory):
    return toy.write_model(tmp_path_factory.mktemp("toy model"))


@pytest.fixture
def master(functions, resources):
    """Instances of the toy, freed at the end of the test."""
    made = []

    def instantiate(location=resources, **options):
        made.append(Master(functions, location, **options))
        return made[-1]

    yield instantiate
    for one in made:
        if one.instance:
            one.free()


@pytest.fixture(scope="session")
def host(compiler, tmp_path_factory):
    """The host written in C."""
    program = tmp_path_factory.mktemp("host") / "host"
    made = [*toy.HOST, "-o", str(program), "-ldl", "-lpthread", "-lm"]
    toy.run([compiler, *toy.WARNINGS, "-O2", f"-I{toy.HEADERS}", *made])
    return program
