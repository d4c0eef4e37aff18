"""The plugin for users' tests, run by pytest as users run it: a project of its own, a process of its own."""

import re
import shutil
import subprocess
import sys
import tomllib

import numpy as np
import pytest

from fmu_bearing.fmi.package import build
from fmu_bearing.prepare.model import prepare
from fmu_bearing.results.result import Run
from fmu_bearing.results.series import structured
from fmu_bearing.testing import Plan, compare, report, step_fmu
from tests.conftest import ROOT
from tests.pages import run_page

pytest_plugins = ["pytester"]

HARNESS = ROOT / "examples" / "harness"


# --- the comparison ----------------------------------------------------------------------------------------


def run(step=0.1, count=11, **columns):
    time = step * np.arange(count)
    values = {name: function(time) for name, function in columns.items()}
    return Run("a run", structured({"time": time} | values), {"force": "N", "mic[1].leq": "dB"})


def test_tolerance_is_relative_to_the_columns_magnitude():
    wanted = run(force=lambda t: 100.0 * np.sin(7.0 * t))
    near = run(force=lambda t: 100.0 * np.sin(7.0 * t) + 0.9e-3)  # of 100: 0.9e-5
    far = run(force=lambda t: 100.0 * np.sin(7.0 * t) + np.where(t > 0.35, 1.1e-3, 0.0))
    assert compare(near, wanted) == []
    (found,) = compare(far, wanted)
    # sin(7 t) comes nearest to 1 at 0.2 s: 0.98545
    assert (found.time, found.points, found.of) == (pytest.approx(0.4), 7, 11)
    assert found.allowed == pytest.approx(100.0 * np.max(np.abs(np.sin(0.7 * np.arange(11)))) * 1e-5)
    assert compare(far, wanted, rtol=2e-5) == []


def test_tolerances_by_name_go_before_those_by_unit():
    wanted = run(force=lambda t: 100.0 + t, other=lambda t: 100.0 + t)
    moved = run(force=lambda t: 100.5 + t, other=lambda t: 100.5 + t)
    assert [one.name for one in compare(moved, wanted)] == ["force", "other"]
    assert [one.name for one in compare(moved, wanted, rtol={"N": 1e-2})] == ["other"]
    assert [one.name for one in compare(moved, wanted, rtol={"N": 1e-2, "force": 0.0})] == ["force", "other"]
    assert compare(moved, wanted, atol={"N": 0.6, "": 0.6}) == []


def test_levels_have_absolute_tolerances_only():
    wanted = run(**{"mic[1].leq": lambda t: 80.0 + t})
    assert compare(run(**{"mic[1].leq": lambda t: 80.009 + t}), wanted) == []
    assert len(compare(run(**{"mic[1].leq": lambda t: 80.011 + t}), wanted)) == 1


def test_other_times_are_interpolated():
    wanted = run(force=lambda t: 3.0 * t)
    finer = run(0.025, 41, force=lambda t: 3.0 * t)
    assert compare(finer, wanted) == []
    shifted = run(0.03, 41, force=lambda t: 3.0 * t + (t > 0.5))
    found = compare(shifted, wanted)
    assert found[0].time == pytest.approx(0.5)  # between 0.48 and 0.51 s, where the line rises
    assert "the run's values interpolated to them" in report(shifted, wanted, "x.csv", found)


def test_what_is_no_number_departs():
    wanted = run(force=lambda t: 1.0 + t)
    (found,) = compare(run(force=lambda t: np.where(t > 0.55, np.nan, 1.0 + t)), wanted)
    assert (found.time, found.points, found.worst) == (
        pytest.approx(0.6),
        5,
        pytest.approx(np.nan, nan_ok=True),
    )


def test_a_run_that_lacks_something_is_no_match():
    wanted = run(force=lambda t: t, torque=lambda t: t)
    with pytest.raises(ValueError, match="the run lacks torque, which the reference holds"):
        compare(run(force=lambda t: t), wanted)
    with pytest.raises(ValueError, match=r"the run goes from 0 to 0.5 s, the reference from 0 to 1 s"):
        compare(run(0.1, 6, force=lambda t: t, torque=lambda t: t), wanted)


# --- fixtures, in a project of their own -------------------------------------------------------------------


@pytest.fixture(scope="module")
def fmu(example, tmp_path_factory):
    return build(prepare(example("7003C-spindle")), tmp_path_factory.mktemp("fmu") / "Bearing.fmu").path


@pytest.mark.heavy
def test_example_passes_and_a_departure_is_reported(pytester, fmu):
    same, changed = (shutil.copytree(HARNESS, pytester.path / name) for name in ("same", "changed"))
    file = changed / "references" / "start.csv"
    wanted = Run.load(file)
    wanted.table["friction_torque"][20:] *= 1.001
    wanted.save(file)

    def go(*options):
        command = ("-p", "fmu_bearing.testing.plugin", "--import-mode=importlib", "--fmu", str(fmu), *options)
        result = pytester.runpytest_subprocess(*command)
        return result, "\n".join(result.outlines)

    result, reported = go()
    result.assert_outcomes(passed=3, failed=1)  # the example as it stands, and but for one reference
    line = next(line for line in reported.splitlines() if line.lstrip("E ").startswith("friction_torque: "))
    assert "first at t = 0.002 s" in line and "31 of 51 points" in line
    assert "departs from references/start.csv in 1 of 8 variables" in reported
    assert "Traceback" not in reported and "def " not in reported  # the departure, no code of the plugin
    result, reported = go("--record-references", "changed")
    result.assert_outcomes(passed=2)
    assert "reference recorded: " in reported and "(51 points, 8 variables)" in reported
    recorded = Run.load(file)
    assert [one.name for one in compare(recorded, wanted)] == ["friction_torque"]
    assert compare(recorded, Run.load(same / "references" / "start.csv")) == []


OWN = """
    import pytest
    from fmu_bearing.testing import Plan

    def test_unmarked(bearing_fmu):
        pass

    @pytest.mark.fmu("none.fmu")
    def test_missing(bearing_fmu):
        pass

    @pytest.mark.fmu("Bearing.fmu")
    def test_no_reference(bearing_fmu, assert_matches_reference):
        assert_matches_reference(bearing_fmu, "none.csv")

    @pytest.mark.fmu("Bearing.fmu")
    def test_refused(bearing_fmu, step_fmu):
        # nothing holds the outer ring against this load: the engine gives up after some milliseconds
        load, pedestal = lambda t: 3000.0 if t else 0.0, lambda t: 1e4 if t else 1e8
        step_fmu(bearing_fmu, Plan(0.1, 2e-3, {"radial_load.y": load, "pedestal_stiffness": pedestal}))

    @pytest.mark.fmu("Bearing.fmu")
    def test_without_plan(bearing_fmu, assert_matches_reference):
        assert len(assert_matches_reference(bearing_fmu, "given.csv")) == 3
"""


@pytest.mark.heavy
def test_what_is_missing_is_said(pytester, fmu):
    pytester.makepyfile(test_own=OWN)
    shutil.copy(fmu, pytester.path / "Bearing.fmu")
    step_fmu(fmu, Plan(2e-3, outputs=["friction_torque"])).save(pytester.path / "given.csv")
    result = pytester.runpytest_subprocess("-p", "fmu_bearing.testing.plugin", "--strict-markers")
    result.assert_outcomes(passed=1, failed=2, errors=2)
    reported = "\n".join(result.outlines)
    assert "which FMU? give --fmu PATH" in reported
    assert re.search(r"there is no FMU or scene at .*none\.fmu", reported)
    assert re.search(r"there is no reference .*none\.csv: record it with --record-references", reported)
    assert re.search(r"AssertionError: .*Bearing\.fmu came to t = 0\.\d+ s of 0\.1 s: .*refused", reported)


# --- the entry point ---------------------------------------------------------------------------------------


def test_plugin_is_declared_and_loads_little():
    project = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
    (name,) = project["entry-points"]["pytest11"].values()
    code = f"import sys; before = set(sys.modules); import {name}; print(*(set(sys.modules) - before))"
    done = subprocess.run(
        [sys.executable, "-c", f"import pytest; {code}"],
        capture_output=True,
        text=True,
        check=True,
        timeout=600,
    )
    ours = {module for module in done.stdout.split() if module.startswith("fmu_bearing")}
    assert ours == {"fmu_bearing", "fmu_bearing.testing", "fmu_bearing.testing.plugin"}
    assert not {"numpy", "numba", "fmpy"} & set(done.stdout.split())


@pytest.mark.heavy
def test_code_of_the_page_runs(tmp_path, monkeypatch):
    # as if the entry point were installed, which an old editable install need not have
    monkeypatch.setenv("PYTEST_PLUGINS", "fmu_bearing.testing.plugin")
    run_page(ROOT / "docs" / "testing.md", tmp_path, monkeypatch)
    assert (tmp_path / "references" / "start.csv").is_file()
