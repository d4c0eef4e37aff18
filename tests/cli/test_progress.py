"""A command whose output is redirected says now and then what goes on, on standard error."""

import re
import time

import pytest

from fmu_bearing import progress
from fmu_bearing.compiled.platforms import host
from fmu_bearing.fmi import package
from fmu_bearing.fmi.native import link


@pytest.mark.parametrize("as_json", [(), ("--json",)], ids=["tables", "json"])
def test_lines_of_a_run(run, rings_file, tmp_path, monkeypatch, as_json):
    monkeypatch.setattr(progress, "EVERY", 0.02)
    done = run(
        "simulate", rings_file, "-t", 0.1, "--step", 1e-4, "-v", "friction_torque",
        "-o", tmp_path / "run.csv",
        *as_json,
    )  # fmt: skip
    assert done.exit_code == 0, done.output
    told = [line for line in done.stderr.splitlines() if "7003C-bare: " in line]
    assert told
    form = (
        r"fmu-bearing: after \d+ s; 7003C-bare: [\d.e-]+ of 0\.1 s, ([\d.e+-]+ simulated/wall, )?after \d+ s"
    )
    assert all(re.fullmatch(form, line) for line in told), told
    assert not as_json or done.data["points"] == 1001


def test_a_short_run_is_silent(run, rings_file, tmp_path):
    done = run("simulate", rings_file, "-t", 1e-3, "-o", tmp_path / "run.csv")
    assert done.exit_code == 0 and done.stderr == ""


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("words", "what"),
    [
        (("modes", "{set}"), "modes of 7003C-DB: after 0 s"),
        (("modes", "{set}", "--speeds", "9000,12000,15000"), "Campbell diagram: 1 of 3 speeds, after "),
        (("stiffness", "{set}", "--speeds", "0,9000", "-o", "{folder}/k.csv"), "stiffness: 0 of 2 speeds"),
    ],
)
def test_lines_of_modes_and_stiffness_of_a_set(run, words, what, tmp_path, monkeypatch):
    from tests.conftest import ROOT

    monkeypatch.setattr(progress, "EVERY", 0.01)
    file = ROOT / "examples" / "spindle_set" / "7003C-DB.toml"
    done = run(*(word.format(set=file, folder=tmp_path) for word in words))
    assert done.exit_code == 0, done.output
    assert any(what in line for line in done.stderr.splitlines()), done.stderr


def test_lines_of_a_build(run, silent_file, tmp_path, monkeypatch):
    """Each of the long parts has a name: linking, which takes minutes the first time, and packing."""
    monkeypatch.setattr(progress, "EVERY", 0.02)
    monkeypatch.setattr(link, "prebuilt", lambda name: None)
    monkeypatch.setattr(link.disk_cache, "read", lambda path, tell: None)
    monkeypatch.setattr(link.disk_cache, "write", lambda path, data, tell: None)
    monkeypatch.setattr(link, "compiler_for", lambda *given: link.Compiler(("zig",), "zig 1"))
    monkeypatch.setattr(link, "kernels_of", lambda *given: [])
    monkeypatch.setattr(link, "link", lambda *given: time.sleep(0.2) or b"library")
    packed = package._zip
    monkeypatch.setattr(package, "_zip", lambda inside: time.sleep(0.2) or packed(inside))
    # not of this machine, whose library would be run
    other = "win64" if host() is None or host().name != "win64" else "linux64"
    done = run("build", silent_file, "--platforms", other, "-o", tmp_path / "a.fmu")
    assert done.exit_code == 0, done.output
    assert f"linking {other} (zig 1)" in done.stderr.splitlines()
    for what in (f"linking {other} (zig 1)", "packing a.fmu"):
        assert re.search(rf"^fmu-bearing: after \d s; {re.escape(what)}: after \d s$", done.stderr, re.M)
