"""`validate`: sound FMUs have no findings, each fault of a broken one is found, nothing ends the process."""

import errno
import importlib.util
import json
import os
import shutil
import subprocess
import sys
import zipfile
from pathlib import Path

import pytest
from typer.testing import CliRunner

from fmu_bearing import cli, extras, simulate
from fmu_bearing.compiled.errors import BuildError
from fmu_bearing.compiled.platforms import host
from fmu_bearing.fmi import reference
from fmu_bearing.fmi.package import build
from fmu_bearing.prepare.model import prepare
from fmu_bearing.results.result import ResultError
from fmu_bearing.run.simulate_fmu import open_fmu
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.validation import NotAnFmu, Result, abilities, life, refusals, tools, validate
from fmu_bearing.validation.checks import CHECKS, meaning_of, name_of
from fmu_bearing.validation.remarks import Skip
from fmu_bearing.validation.run import _unpack
from fmu_bearing.validation.subject import NoInstance, Subject
from tests.conftest import ROOT
from tests.native_builds import no_native_fmu

SPINDLE = ROOT / "examples" / "spindle_cosimulation"


def by_name(results):
    return {result.check: result for result in results}


def of(results, outcome):
    return {result.check for result in results if result.outcome == outcome}


# --- sound FMUs --------------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def model(scene):
    return prepare(with_fidelity(scene("7003C-spindle"), model="rings"))


@pytest.fixture(scope="module")
def native(model, tmp_path_factory):
    try:
        return build(model, tmp_path_factory.mktemp("native") / "Bearing.fmu", "native").path
    except BuildError as problem:
        no_native_fmu(problem)


def run(*arguments):
    return CliRunner().invoke(cli.app, ["validate", *map(str, arguments)])


def test_native_build_has_nothing_to_find(native):
    reported = run(native, "--json")
    assert reported.exit_code == 0, reported.output
    results = [Result(**result) for result in json.loads(reported.stdout)["results"]]
    assert of(results, "finding") == of(results, "note") == set(), results
    # the model gives no directional derivatives, and says so
    assert of(results, "skipped") == {"directional derivatives"}
    assert len(results) == len(CHECKS) + 2


@pytest.mark.heavy
def test_python_build_has_the_known_notes_only(model, tmp_path):
    results = validate(build(model, tmp_path / "Bearing.fmu", "python").path)
    assert of(results, "finding") == set(), results
    # tests/fmi/differences.py: pythonfmu does not compare the GUID; it declares no derivatives
    assert of(results, "note") == {"other guid"}
    skipped = {"input derivatives", "output derivatives", "directional derivatives"}
    assert of(results, "skipped") == skipped


@pytest.mark.heavy
@pytest.mark.parametrize(
    # pythonfmu compares no GUID, and the Python slave does not look at the time
    ("flavour", "notes"),
    [("python", {"other guid", "wrong time"}), ("native", set())],
)
def test_foreign_fmu_without_ranges(tmp_path, flavour, notes):
    command = [sys.executable, str(SPINDLE / "build.py"), "--output-dir", str(tmp_path), "--flavour", flavour]
    reported = subprocess.run(command, capture_output=True, text=True, timeout=600)
    if flavour == "native" and "no C compiler" in reported.stderr:
        pytest.skip(reported.stderr)
    assert reported.returncode == 0, reported.stderr
    results = by_name(validate(tmp_path / "SpindleMotor.fmu"))
    assert of(results.values(), "finding") == set(), results
    assert of(results.values(), "note") == notes, results
    assert results["states"].outcome == results["serialised states"].outcome == "passed"
    for name in ("reference results", "values out of range"):
        assert results[name].outcome == "skipped" and results[name].details[0], name


# --- broken ones -------------------------------------------------------------------------------------------

DESCRIPTION = """<?xml version="1.0" encoding="UTF-8"?>
<fmiModelDescription fmiVersion="2.0" modelName="Broken" guid="{{8c4e810f}}">
  <CoSimulation modelIdentifier="Broken" canHandleVariableCommunicationStepSize="true" {more}/>
  <DefaultExperiment startTime="0" stopTime="1" stepSize="0.125"/>
  <ModelVariables>
    <ScalarVariable name="u" valueReference="0" causality="input"><Real start="1"/></ScalarVariable>
    <ScalarVariable name="y" valueReference="1" causality="output"><Real/></ScalarVariable>
  </ModelVariables>
  <ModelStructure>
    <Outputs><Unknown index="2"/></Outputs>
    <InitialUnknowns><Unknown index="2"/></InitialUnknowns>
  </ModelStructure>
</fmiModelDescription>
"""
STATES = 'canGetAndSetFMUstate="true"'


@pytest.fixture(scope="module")
def broken(tmp_path_factory):
    """A function that compiles a slave with a fault and packs it."""
    compiler = shutil.which("cc") or shutil.which("gcc")
    if compiler is None or host() is None or host().suffix != ".so":
        pytest.skip("no C compiler on the path, or no platform whose libraries end in .so")
    headers = Path(importlib.util.find_spec("fmpy").origin).parent / "c-code"
    folder = tmp_path_factory.mktemp("broken")

    def make(fault, more="", bounds=""):
        library, path = folder / f"{fault}.so", folder / f"{fault}.fmu"
        source = Path(__file__).with_name("broken.c")
        command = [compiler, "-shared", "-fPIC", "-O1", f"-I{headers}", f"-DFAULT={fault}", str(source)]
        subprocess.run([*command, "-o", str(library), "-lm"], check=True, timeout=600)
        with zipfile.ZipFile(path, "w") as archive:
            text = DESCRIPTION.format(more=more).replace('start="1"', f'start="1" {bounds}')
            archive.writestr("modelDescription.xml", text)
            archive.write(library, f"binaries/{host().name}/Broken.so")
        return path

    return make


@pytest.fixture
def found(broken, tmp_path):
    """Results of one check in this process, by an FMU that does not end it."""

    def run(check, fault, more=STATES, bounds=""):
        with zipfile.ZipFile(broken(fault, more, bounds)) as archive:
            archive.extractall(tmp_path)
        return [str(remark) for remark in check(Subject(tmp_path))]

    return run


FAULTS = {
    "KEEPS": (life.reset, "fresh and after fmi2Reset: y = 0.0 and"),
    "SHARES": (life.independent, "in turns with a second instance"),
    "FORGETS": (abilities.states, "fmi2GetFMUstate and fmi2SetFMUstate: y ="),
    "NAN_OUT": (life.finite, "y = nan; expected finite numbers (FMI 2.0, section 2.1.7)"),
}


@pytest.mark.parametrize("fault", FAULTS)
def test_each_fault_is_found(found, fault):
    check, words = FAULTS[fault]
    assert found(check, "NONE") == []
    remarks = found(check, fault)
    assert any(words in remark for remark in remarks), remarks


def test_a_host_that_repeats_a_refused_step_for_ever_is_found(found):
    def seen(fault):
        return found(refusals.start_value_out_of_range, fault, bounds='max="10"')

    assert seen("NONE") == seen("ENDS") == []  # taken, and an end
    (remark,) = seen("REPEATS")
    assert remark.startswith("5 times the same fmi2DoStep, with u = 20.0 set before initialisation")
    assert "fmi2Discard each time, without fmi2Terminated; expected an end" in remark


@pytest.mark.parametrize(
    ("check", "flag"),
    [
        (abilities.input_derivatives, "canInterpolateInputs"),
        (abilities.directional_derivatives, "providesDirectionalDerivative"),
        (abilities.serialised_states, "canSerializeFMUstate"),
    ],
    ids=lambda value: getattr(value, "__name__", ""),
)
def test_ability_that_is_not_there_is_found(found, check, flag):
    with pytest.raises(Skip, match=flag):
        found(check, "NONE")
    (remark,) = found(check, "NONE", f'{flag}="true"')
    assert "fmi2Error; expected fmi2OK" in remark


@pytest.mark.heavy
def test_a_crash_is_a_finding_and_checks_before_it_stand(broken):
    results = by_name(validate(broken("CRASH")))
    assert of(results.values(), "finding") == {"finite"}
    for detail in results["finite"].details:  # among others, and alone
        assert "the process ended by signal 6 (SIGABRT)" in detail
    for name in ("instantiates", "versions", "start values"):  # they take no step
        assert results[name].outcome == "passed", results[name]
    assert results["reset"].details == ["'finite' did not come to an end"]


@pytest.mark.heavy
def test_a_step_that_does_not_return_is_ended(broken):
    result = by_name(validate(broken("HANGS"), limit=2.0))["finite"]
    assert result.outcome == "finding"
    assert result.details[-1] == "the check took longer than 2 s and was ended"


@pytest.mark.heavy
def test_another_tool_that_takes_long_is_ended(tmp_path):
    """FMPy takes minutes for the names of very many variables."""
    variable = '<ScalarVariable name="v{0}" valueReference="{0}" causality="local"><Real/></ScalarVariable>'
    many = "".join(variable.format(number) for number in range(2, 120_000))
    path = tmp_path / "many.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        text = DESCRIPTION.format(more="").replace("</ModelVariables>", many + "</ModelVariables>")
        archive.writestr("modelDescription.xml", text)
    result = by_name(validate(path, limit=0.5))["FMPy"]
    assert (result.outcome, result.details) == ("skipped", ["the check took longer than 0.5 s and was ended"])


def test_a_full_folder_of_temporary_files_is_no_fault_of_the_fmu(broken, monkeypatch):
    def full(self, *_, **__):
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC))

    path = broken("NONE")
    monkeypatch.setattr(zipfile.ZipFile, "extractall", full)
    words = "cannot be unpacked: no space left on device in .*: name a folder with room in TMPDIR"
    with pytest.raises(NotAnFmu, match=words):
        validate(path)
    with pytest.raises(ResultError, match=words):
        simulate(path, 1.0)


@pytest.mark.parametrize("absolute", [True, False])
def test_members_that_point_outside_stay_inside(broken, tmp_path, absolute):
    outside = tmp_path.parent / "outside.txt"
    name = outside.as_posix() if absolute else "../outside.txt"
    path = tmp_path / "it.fmu"
    path.write_bytes(broken("NONE").read_bytes())
    with zipfile.ZipFile(path, "a") as archive:
        archive.writestr(name, "x")
    if absolute:
        with pytest.raises(ResultError, match="is not an FMU, or damaged: .*outside"):
            simulate(path, 1.0)
    else:
        simulate(path, 1.0)  # the dots are left out
    assert not outside.exists()


def test_damaged_archives_are_refused_in_one_line(broken, tmp_path):
    """By each byte that a disk or a transfer damages; some change nothing that is read."""
    whole, refused = broken("NONE").read_bytes(), 0
    path = tmp_path / "it.fmu"
    for at in range(len(whole) - 200, len(whole), 4):  # the list of members
        path.write_bytes(whole[:at] + bytes([whole[at] ^ 0x55]) + whole[at + 1 :])
        for number, read in enumerate((open_fmu, lambda it: _unpack(it, tmp_path / "unpacked"))):
            try:
                read(path)
            except (ResultError, NotAnFmu) as refusal:
                refused += 1
                assert "\n" not in str(refusal) and str(path) in str(refusal), (at, number)
    assert refused >= 20  # of 100


# --- damaged files -----------------------------------------------------------------------------------------


def test_description_that_is_no_xml(tmp_path):
    path = tmp_path / "damaged.fmu"
    with zipfile.ZipFile(path, "w") as archive:
        archive.writestr("modelDescription.xml", DESCRIPTION[: len(DESCRIPTION) // 2])
    results = by_name(validate(path))
    assert results["FMPy"].outcome == results["fmutool"].outcome == "finding"
    assert all(results[name_of(check)].outcome == "skipped" for check in CHECKS)
    assert results["reset"].details[0].startswith("the description cannot be read: ")


@pytest.fixture
def damaged(native, tmp_path):
    """A function that changes a file of the native FMU and returns the unpacked FMU."""

    def make(inside, change):
        with zipfile.ZipFile(native) as archive:
            archive.extractall(tmp_path)
        (tmp_path / inside).write_bytes(change((tmp_path / inside).read_bytes()))
        return Subject(tmp_path)

    return make


def test_model_that_does_not_hold_together(damaged):
    subject = damaged("resources/model.bin", lambda data: data[:-9] + b"damaged!!")
    (remark,) = life.instantiates(subject)
    assert "model.bin" in remark.returned and "2.1.5" in str(remark)
    with pytest.raises(NoInstance, match="model.bin"):
        list(life.reset(subject))


def test_reference_results_that_are_not_those_of_the_fmu(damaged):
    def change(data):
        lines = data.decode().splitlines()
        cells = lines[20].split(",")
        lines[20] = ",".join([cells[0], repr(1.001 * float(cells[1])), *cells[2:]])
        return "\n".join(lines).encode()

    assert abilities.FOLDER == reference.FOLDER
    subject = damaged(f"{reference.FOLDER}/reference.csv", change)
    (remark,) = abilities.reference_results(subject)
    assert remark.called == "friction_torque at 0.0019 s of the reference results"


# --- the command -------------------------------------------------------------------------------------------


def test_command_reports_and_its_exit_code_says_it(broken):
    reported = run(broken("KEEPS", STATES))
    assert reported.exit_code == 1
    assert "2 note, 1 finding" in reported.output  # it looks at neither GUID nor time
    assert "2.1.6" in reported.output  # where FMI says what reset is to do


@pytest.mark.parametrize("kind", ["missing", "text", "zip", "exchange", "third"])
def test_what_is_no_fmu_is_refused(tmp_path, kind):
    path = tmp_path / "x.fmu"
    words = {
        "missing": "there is no such FMU",
        "text": "is not an FMU",
        "zip": "holds no modelDescription.xml",
        "exchange": "FMI 2.0, model exchange only",
        "third": "is FMI 3.0",
    }[kind]
    if kind == "text":
        path.write_text("not a zip")
    elif kind != "missing":
        text = DESCRIPTION.format(more="")
        text = text.replace("CoSimulation", "ModelExchange") if kind == "exchange" else text
        text = text.replace('fmiVersion="2.0"', 'fmiVersion="3.0"') if kind == "third" else text
        with zipfile.ZipFile(path, "w") as archive:
            archive.writestr("other.txt" if kind == "zip" else "modelDescription.xml", text)
    with pytest.raises(NotAnFmu, match=words):
        validate(path)
    reported = run(path)
    assert reported.exit_code == 2
    assert reported.stderr.splitlines()[-1].startswith("error: ") and "Traceback" not in reported.output


def test_fmutool_that_is_not_installed_is_said(broken, monkeypatch):
    def need(name, purpose):
        raise extras.MissingExtra(f"{purpose} needs the package fmu_manipulation_toolbox")

    monkeypatch.setattr(tools, "need", need)
    result = tools.fmutool(broken("NONE"))
    assert result.outcome == "skipped" and "needs the package" in result.details[0]


def test_every_check_says_what_it_asks():
    for check in CHECKS:
        assert meaning_of(check).endswith("."), check
    assert len({name_of(check) for check in CHECKS}) == len(CHECKS)
