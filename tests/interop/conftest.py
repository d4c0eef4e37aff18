"""FMUs of one scene with compact sound, and the programs of the ecospy wheel where they can be run."""

import importlib.util
import os
import re
import shutil
import subprocess
import sys
import zipfile
from importlib import metadata
from pathlib import Path

import numpy as np
import pytest

from fmu_bearing.fmi.package import build
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from tests.native.toy import HOST

ROOT = Path(__file__).parents[2]
EXACT_STEP = 2.0**-9  # s: masters that count in ns and those that add up doubles agree on its multiples
STEPS = 16
WATCHED = ("friction_torque", "heat.oil", "cage.speed_ratio", "ball[1].velocity.x", "mic[1].pressure")

CSV_ERROR = 5.1e-7  # ecos writes six decimals

needs_linux64 = pytest.mark.skipif(
    not (sys.platform.startswith("linux") and os.uname().machine == "x86_64"),
    reason="ecospy, libcosimpy and tbb are installed on linux x86-64 only",
)


def alone(model, steps, names=WATCHED, **inputs):
    """Array of the named outputs, one row at the start and one after each step, without any FMU."""
    instance = Instance(model)
    for name, value in inputs.items():
        instance.set(name, value)
    instance.initialise(0.0)
    rows = [[instance.get(name) for name in names]]
    for _ in range(steps):
        instance.step(EXACT_STEP)
        rows.append([instance.get(name) for name in names])
    return np.array(rows)


def read_csv(path, instances=False):
    """Columns by variable name, or by ``instance::name``; ecos calls them ``instance::name[TYPE]``."""
    head, *lines = path.read_text().splitlines()
    names = [re.sub(r"\[\w+\]$", "", name) for name in head.split(", ")]
    if not instances:
        names = [name.rpartition("::")[2] for name in names]
    rows = [[float(value) for value in line.split(",")] for line in lines]
    return dict(zip(names, np.transpose(rows), strict=True))


@pytest.fixture(scope="session", autouse=True)
def example_modules():
    """The examples import their neighbours by bare names, as when they are run as scripts."""
    folders = [str(ROOT / "examples" / name) for name in ("ssp", "spindle_cosimulation")]
    sys.path[:0] = folders
    yield
    for folder in folders:
        sys.path.remove(folder)


@pytest.fixture(scope="session")
def model(scene):
    return prepare(scene("7003C-spindle"))


@pytest.fixture(scope="session")
def fmus(model, tmp_path_factory):
    """FMU by flavour of the build."""
    folder = tmp_path_factory.mktemp("interop")
    return {
        flavour: build(model, folder / flavour / "Bearing7003C.fmu", flavour=flavour).path
        for flavour in ("native", "python")
    }


@pytest.fixture(params=["native", "python"])
def fmu(request, fmus):
    """The FMU of each flavour, for tools inside a Python process."""
    return fmus[request.param]


@pytest.fixture(scope="session")
def native(fmus):
    """The FMU for tools without Python."""
    return fmus["native"]


@pytest.fixture(scope="session")
def unpacked(native, tmp_path_factory):
    return extracted(native, tmp_path_factory.mktemp("unpacked native"))


@pytest.fixture(scope="session")
def expected(model):
    """Values of ``WATCHED`` at the start and after each of ``STEPS`` steps, from the library itself."""
    return alone(model, STEPS)


@pytest.fixture(scope="session")
def clean_environment():
    """An environment in which no Python is to be found by accident."""
    return {
        name: value
        for name, value in os.environ.items()
        if not name.startswith("PYTHON") and name not in ("LD_PRELOAD", "VIRTUAL_ENV")
    }


@pytest.fixture(scope="session")
def ecos(clean_environment, tmp_path_factory):
    """Run the program ``ecos``: a function of its arguments and working folder.

    In the wheel neither ``ecos`` nor ``proxyfmu`` may be executed, so they are copied; and pip puts TBB's
    library where no loader looks.
    """
    folder = tmp_path_factory.mktemp("ecos")
    wheel = Path(importlib.util.find_spec("ecospy").submodule_search_locations[0]) / "binaries"
    for name in ("ecos", "proxyfmu"):
        shutil.copy(wheel / name, folder)
        (folder / name).chmod(0o755)
    library = next(file.locate() for file in metadata.files("tbb") if file.name == "libtbb.so.12")
    environment = clean_environment | {"LD_LIBRARY_PATH": str(Path(library).resolve().parent)}

    def run(*arguments, cwd, **variables):
        return subprocess.run(
            [str(folder / "ecos"), *map(str, arguments)],
            cwd=cwd,
            env=environment | variables,
            capture_output=True,
            text=True,
            timeout=120,
        )

    run.folder = folder
    return run


def extracted(fmu, folder):
    """Unpack an FMU into a folder, which is returned."""
    with zipfile.ZipFile(fmu) as archive:
        archive.extractall(folder)
    return folder


@pytest.fixture(scope="session")
def compiler():
    found = shutil.which("cc") or shutil.which("gcc")
    if found is None:
        pytest.skip("no C compiler on the path")
    return found


@pytest.fixture(scope="session")
def headers():
    """Folder of the FMI headers in the installed FMPy."""
    return Path(importlib.util.find_spec("fmpy").origin).parent / "c-code"


@pytest.fixture(scope="session")
def host(compiler, headers, tmp_path_factory):
    """The host program in C; it links nothing but the C library."""
    program = tmp_path_factory.mktemp("host") / "host"
    command = [compiler, "-std=c99", f"-I{headers}", *HOST, "-o", str(program), "-ldl", "-lpthread", "-lm"]
    subprocess.run(command, check=True, timeout=600)
    return program


@pytest.fixture(scope="session")
def archives(fmus, compiler, tmp_path_factory):
    """Path of motor, bearing and thermal network as one .ssp: all native, all Python, and one of each."""
    from write import write

    assert compiler
    folder = tmp_path_factory.mktemp("ssp")
    builds = {"native": ("native", "native"), "python": ("python", "python"), "mixed": ("native", "python")}
    return {
        name: write(
            fmus[bearing], folder / f"{name}.ssp", target_speed=2300.0, ramp_time=0.02, stop_time=0.1,
            partners=partners,
        )
        for name, (bearing, partners) in builds.items()
    }  # fmt: skip


#: What ecos is to write: it crashes now and then where it reads an Integer through proxyfmu.
CSV_CONFIG = """<?xml version="1.0" encoding="UTF-8"?>
<ecos:CsvConfig xmlns:ecos="http://github.com/Ecos-platform/libecos/resources/schema/CsvConfig">
  <ecos:components>{components}</ecos:components>
</ecos:CsvConfig>
"""


def csv_config(path, shown):
    """Write what ecos is to record: ``shown`` has the names of variables by component."""
    components = "".join(
        f'<ecos:component name="{component}">'
        + "".join(f'<ecos:variable name="{name}"/>' for name in names)
        + "</ecos:component>"
        for component, names in shown.items()
    )
    path.write_text(CSV_CONFIG.format(components=components))
    return path
