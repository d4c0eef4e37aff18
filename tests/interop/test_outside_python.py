"""Hosts without Python: a program in C, ``ecos simulate`` and ``proxyfmu``."""

import re
import subprocess
import sys
import zipfile
from xml.etree import ElementTree

import fmpy
import numpy as np
import pytest

from . import masters
from .conftest import CSV_ERROR, EXACT_STEP, STEPS, WATCHED, alone, csv_config, needs_linux64, read_csv


@pytest.mark.skipif(not sys.platform.startswith("linux"), reason="watches the loader of glibc")
def test_c_host(host, unpacked, clean_environment, expected):
    rows, loaded = masters.in_c(host, unpacked, WATCHED, clean_environment | {"LD_DEBUG": "files"})
    assert np.array_equal(rows, expected)
    (library,) = map(str, unpacked.glob("binaries/*linux*/*.so"))
    assert library in loaded
    # With it only what every C program has: no Python, no NumPy, no compiler's run-time library.
    others = {name.rpartition("/")[2].partition(".")[0].partition("-")[0] for name in loaded - {library}}
    assert others <= {"libc", "libm", "libdl", "libpthread", "ld"}


@pytest.fixture
def in_c(host, unpacked):
    """A function: carry out commands of the host in C; its returned code and the lines that it printed.

    ``{name}`` in a command stands for the value reference of a variable.
    """
    description = fmpy.read_model_description(str(unpacked))
    references = {v.name: str(v.valueReference) for v in description.modelVariables}
    library = next(unpacked.glob("binaries/*linux*/*.so"))

    def play(*commands):
        filled = [re.sub(r"{(.*?)}", lambda found: references[found[1]], text) for text in commands]
        where = (unpacked / "resources").as_uri()
        command = [str(host), str(library), description.guid, where, *filled]
        ran = subprocess.run(command, capture_output=True, text=True, timeout=600)
        return ran.returncode, ran.stdout.splitlines()

    return play


RUN = ("step:0.000244140625:8", "float:nearest", "get:{friction_torque},{ball[3].velocity.y},{mic[1].spl}")


@needs_linux64
@pytest.mark.parametrize("mode", ["up", "down", "zero", "flush"])
def test_c_host_that_rounds_otherwise_gets_the_same_bits(in_c, mode):
    assert in_c("start", f"float:{mode}", *RUN) == in_c("start", *RUN)
    # and from before initialisation on
    assert in_c(f"float:{mode}", "start", *RUN) == in_c("start", *RUN)


@needs_linux64
@pytest.mark.parametrize(
    ("given", "taken"), [("0", "1e-6"), ("1e-7", "1e-6"), ("0.5", "0.1"), ("1e-4", "1e-4")]
)
def test_c_host_that_always_passes_a_tolerance(in_c, given, taken):
    code, lines = in_c(f"setup:0:{given}", "enter", "exit", "get:{tolerance}", *RUN)
    assert code == 0  # every call was answered with fmi2OK
    warnings = [line for line in lines if line.startswith("log 1 logStatusWarning")]
    assert len(warnings) == (given != taken)
    assert (code, [line for line in lines if line not in warnings]) == in_c(
        "set:{tolerance}:" + taken, "start", "get:{tolerance}", *RUN
    )


@needs_linux64
def test_c_host_that_passes_no_number_as_tolerance(in_c):
    code, lines = in_c("expect:3", "setup:0:nan", "expect:3", "enter", "reset", "start")
    assert code == 0
    assert "the experiment's tolerance nan is not a finite number" in lines[0]


@needs_linux64
def test_c_host_that_sets_zeros_while_it_loads(in_c):
    """Zeros before initialisation: the start values serve, and steps wait for values that are possible."""
    inputs = ["pedestal_stiffness", "oil_temperature", "inner_ring_temperature", "outer_ring_temperature"]
    zeros = [f"set:{{{name}}}:0" for name in inputs]
    code, lines = in_c(*zeros, "start", "get:{contact.inner.load_mean}", "expect:2", "step:0.001")
    assert code == 0
    assert [line.split()[1] for line in lines if line.startswith("log")] == ["1"] * 4 + ["2"]
    assert all(f"{name} = 0.0 is refused: allowed are" in lines[-1] for name in inputs)
    assert [line for line in lines if not line.startswith("log")] == in_c(
        "start", "get:{contact.inner.load_mean}"
    )[1]
    # true values, the inputs' starts, and it is the run of a host that set nothing
    true = [f"set:{{{name}}}:{'293.15' if 'temperature' in name else '1e7'}" for name in inputs]
    code, lines = in_c(*zeros, "start", *true, *RUN)
    assert (code, lines[-1:]) == (0, in_c("start", *true, *RUN)[1][-1:])


@needs_linux64
def test_ecos_simulate(ecos, native, expected, tmp_path):
    assert masters.in_ecos(ecos, native, WATCHED, tmp_path) == pytest.approx(expected, abs=CSV_ERROR)


@pytest.fixture
def lone(native, tmp_path):
    """An archive with the bearing alone, or some of one source; and parameters for the first."""

    def write(source, *others, **values):
        from write import _element, bind, parameter_set

        root = _element(None, "ssd:SystemStructureDescription", version="1.0", name="lone")
        elements = _element(_element(root, "ssd:System", name="lone"), "ssd:Elements")
        kind = "application/x-fmu-sharedlibrary"
        for each in ("bearing", *others):
            component = _element(elements, "ssd:Component", name=each, type=kind, source=source)
            connectors = _element(component, "ssd:Connectors")
            for name in WATCHED:
                _element(_element(connectors, "ssd:Connector", name=name, kind="output"), "ssc:Real")
            if each == "bearing":
                bind(component, "resources/bearing.ssv")
        path = tmp_path / "lone.ssp"
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("SystemStructure.ssd", ElementTree.tostring(root, xml_declaration=True))
            archive.writestr("resources/bearing.ssv", parameter_set(values, {}))
            archive.write(native, "resources/Bearing7003C.fmu")
        return path

    return write


@needs_linux64
@pytest.mark.parametrize("start", ["", "proxyfmu://localhost?file="], ids=["in ecos", "by proxyfmu"])
def test_ecos_simulate_archive(ecos, lone, start, model, tmp_path):
    path = lone(f"{start}resources/Bearing7003C.fmu", preload=450.0, shaft_speed=2200.0)
    config = csv_config(tmp_path / "csv.xml", {"bearing": WATCHED})
    ran = ecos(
        "simulate",
        *("--path", path, "--csvConfig", config, "--stepSize", EXACT_STEP, "--stopTime", STEPS * EXACT_STEP),
        *("--parameterSet", "operation", "--logLevel", "debug"),
        cwd=tmp_path,
    )
    output = ran.stdout + ran.stderr
    assert ran.returncode == 0, output
    assert "[error]" not in output
    if start:
        assert "External process for instance 'bearing' returned with status 0" in output
    found = read_csv(tmp_path / "lone.csv")
    expected = alone(model, STEPS, preload=450.0, shaft_speed=2200.0)
    for name, values in zip(WATCHED, expected.T, strict=True):
        assert found[name] == pytest.approx(values, abs=CSV_ERROR), name


@needs_linux64
def test_one_fmu_twice_in_ecos_simulate(ecos, lone, model, expected, tmp_path):
    """ecos closes and opens the library of two components of one source; each has its own values."""
    path = lone("resources/Bearing7003C.fmu", "other", preload=450.0, shaft_speed=2200.0)
    config = csv_config(tmp_path / "csv.xml", {"bearing": WATCHED, "other": WATCHED})
    ran = ecos(
        "simulate",
        *("--path", path, "--csvConfig", config, "--stepSize", EXACT_STEP, "--stopTime", STEPS * EXACT_STEP),
        *("--parameterSet", "operation"),
        cwd=tmp_path,
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr
    found = read_csv(tmp_path / "lone.csv", instances=True)
    own = alone(model, STEPS, preload=450.0, shaft_speed=2200.0)
    for instance, values in (("bearing", own), ("other", expected)):
        for name, column in zip(WATCHED, values.T, strict=True):
            assert found[f"{instance}::{name}"] == pytest.approx(column, abs=CSV_ERROR), (instance, name)


@needs_linux64
def test_proxyfmu_from_ecospy(ecos, native, expected, tmp_path, monkeypatch):
    from run import load_ecos

    ecospy = load_ecos()
    monkeypatch.chdir(ecos.folder)  # ecospy looks for the program there first
    with ecospy.EcosSimulationStructure() as structure:
        structure.add_model("bearing", f"proxyfmu://localhost?file={native}")
        with ecospy.EcosSimulation(structure=structure, step_size=EXACT_STEP) as run:
            assert run.init()
            run.step(STEPS)
            found = [run.get_real(f"bearing::{name}") for name in WATCHED]
            run.terminate()
    assert found == expected[-1].tolist()


@pytest.mark.heavy
@needs_linux64
def test_the_whole_spindle_in_ecos_simulate(ecos, archives, tmp_path):
    """Native bearing, motor and thermal network in a program without Python, against FMPy's .ssp runner."""
    from run import run_fmpy, signals

    shown = {}
    for component, name in signals(archives["native"]):
        shown.setdefault(component, []).append(name)
    config = csv_config(tmp_path / "csv.xml", shown)
    ran = ecos(
        "simulate",
        *("--path", archives["native"], "--csvConfig", config),
        *("--stepSize", EXACT_STEP, "--stopTime", STEPS * EXACT_STEP, "--parameterSet", "operation"),
        cwd=tmp_path,
        LD_DEBUG="files",
    )
    assert ran.returncode == 0, ran.stdout + ran.stderr[-2000:]
    assert "[error]" not in ran.stdout
    paths = re.findall(r"calling init: (.+)$", ran.stderr, flags=re.MULTILINE)
    loaded = {path.rpartition("/")[2] for path in paths}
    assert {"SpindleMotor.so", "Bearing7003C.so", "SpindleThermal.so"} <= loaded
    assert not [name for name in loaded if "python" in name]
    found = read_csv(tmp_path / "native.csv", instances=True)
    expected = run_fmpy(archives["native"], STEPS, EXACT_STEP)
    for component, names in shown.items():
        for name in names:
            values = found[f"{component}::{name}"][1:]
            assert values == pytest.approx(expected[f"{component}.{name}"], abs=CSV_ERROR), name
