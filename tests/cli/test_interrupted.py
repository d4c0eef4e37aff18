"""Ctrl-C ends a command with code 130 and one line, whatever it does at that moment."""

import importlib
import itertools
import os
import re
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from fmu_bearing import Recording, files, record
from fmu_bearing.acoustics.analysis.field import TAIL
from fmu_bearing.run import march as march_module
from tests.conftest import EXAMPLES
from tests.marks import heavy_but

# of these names the packages also have functions
changes, choose, error_motion, realtime, scene_stiffness, sensitivity, tradeoff, vibration = (
    importlib.import_module(f"fmu_bearing.{name}")
    for name in (
        "accuracy.changes", "run.choose", "metrology.error_motion", "run.realtime",
        "steady.stiffness.scene_stiffness", "accuracy.sensitivity", "accuracy.tradeoff",
        "vibration_test.vibration",
    )
)  # fmt: skip


SCENE = str(EXAMPLES / "7003C-bare.toml")

#: Interrupts the program while it loads its commands, within a text that is executed, as dataclasses do.
WHILE_LOADING = """
import os, signal, sys, time

class Interrupting:
    def find_spec(self, name, path=None, target=None):
        if name == "fmu_bearing.cli":
            sys.meta_path.remove(self)
            exec("os.kill(os.getpid(), signal.SIGINT); time.sleep(10)")

sys.meta_path.insert(0, Interrupting())
"""


@pytest.mark.skipif(not hasattr(os, "killpg"), reason="signals of POSIX")
@pytest.mark.parametrize(
    ("words", "seconds"),
    [
        (("simulate", "{scene}", "-t", "10000", "-o", "{folder}/a.csv"), 3.0),
        pytest.param(("sensitivity", "{scene}", "-o", "{folder}"), 3.0, marks=pytest.mark.heavy),
        # within a run
        pytest.param(("vibration", "{scene}", "-o", "{folder}"), 9.0, marks=pytest.mark.heavy),
    ],
    ids=["running", "studying", "in a run of a study"],
)
def test_ctrl_c_is_one_line(tmp_path, words, seconds):
    filled = [word.format(scene=SCENE, folder=tmp_path) for word in words]
    with subprocess.Popen(
        [sys.executable, "-m", "fmu_bearing", *filled], stdout=subprocess.PIPE, stderr=subprocess.PIPE,
        text=True, start_new_session=True,
    ) as program:  # fmt: skip
        time.sleep(seconds)
        os.killpg(program.pid, signal.SIGINT)
        try:
            _, reported = program.communicate(timeout=60)
        finally:
            program.kill()  # what does not end would hold up all other tests
    assert program.returncode == 130, reported
    assert "Traceback" not in reported
    assert len([line for line in reported.splitlines() if "interrupted" in line]) == 1


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_ctrl_c_while_modules_are_loaded(tmp_path):
    (tmp_path / "sitecustomize.py").write_text(WHILE_LOADING, encoding="utf-8")
    ended = subprocess.run(
        [sys.executable, "-m", "fmu_bearing", "--version"], capture_output=True, text=True, timeout=60,
        env=os.environ | {"PYTHONPATH": os.pathsep.join([str(tmp_path), *sys.path])},
    )  # fmt: skip
    assert (ended.returncode, ended.stderr, ended.stdout) == (130, "interrupted\n", "")


#: What each study calls once a row, and the number of the call that makes the first row.
PER_ROW = {
    "tradeoff": (tradeoff, "measure", 3),
    "sensitivity": (sensitivity, "measure", 2),
    "changes": (changes, "_changed", 1),
    "stiffness": (scene_stiffness, "_at", 1),
    "error-motion": (error_motion, "nose_of_run", 1),
    "vibration": (vibration, "reading", 3),  # a seed on two pieces
    "realtime": (realtime, "_timed", 1),
    "choose": (choose, "measure", 2),
}


#: What a study says that it lacks.
MISSING = {
    "vibration": "missing: 1 of 3 seeds, inner race alone, ",
    "realtime": "missing: response without sound\n",  # the third fidelity; the scene is silent
    "choose": "missing: 1 of 5 candidates, so that none is chosen\n",  # two are left out, two were run
}


@pytest.mark.parametrize(
    ("words", "files"),
    heavy_but(
        [
            (["tradeoff", "--quick"], ["tradeoff.csv", "tradeoff.md", "tradeoff.png"]),
            (["sensitivity", "--quick"], ["sensitivity.csv", "sensitivity.md"]),
            (["changes", "--no-levels"], []),
            (["stiffness", "--speeds", "9000,12000,15000", "--frequencies", "100"], ["stiffness.csv"]),
            (["error-motion", "--speeds", "2000,3000,4000", "--revolutions", "20"], ["lines.csv"]),
            (["vibration", "--rigid", "--fidelity", "rings", "--seeds", "3"], ["lines.csv", "bands.png"]),
            (["realtime", "--duration", "0.01"], ["realtime.csv"]),
            (["choose"], []),
        ],
        2, 3, 6,
    ),
    ids=lambda words: words[0] if words else "",
)  # fmt: skip
def test_a_study_keeps_what_is_finished(words, files, run, silent_file, tmp_path, monkeypatch):
    """Interrupted within the third of its rows: two are printed and written."""
    calls = itertools.count(1)
    module, name, first = PER_ROW[words[0]]
    whole = getattr(module, name)

    def row(*given, **more):
        if next(calls) == first + 2:
            raise KeyboardInterrupt
        return whole(*given, **more)

    monkeypatch.setattr(module, name, row)
    monkeypatch.setattr(choose, "cache_file", lambda scene: tmp_path / "none")
    target = tmp_path / f"{words[0]}.csv" if words[0] in ("stiffness", "realtime") else tmp_path
    where = [] if words[0] in ("changes", "choose") else ["-o", target]
    done = run(words[0], silent_file, *words[1:], *where)
    assert done.exit_code == 130
    assert done.stderr.count("interrupted") == 1
    assert MISSING.get(words[0], "") in done.stderr
    assert done.stdout
    for file in files:
        assert (tmp_path / file).stat().st_size > 0


@pytest.fixture
def press(monkeypatch):
    """Press Ctrl-C at a step of a recording, by its number."""

    def at(number):
        steps, whole = itertools.count(), march_module.set_inputs

        def drive(*given):
            if next(steps) == number:
                os.kill(os.getpid(), signal.SIGINT)
            whole(*given)

        monkeypatch.setattr(march_module, "set_inputs", drive)

    return at


@pytest.mark.heavy
@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_sound_keeps_what_was_recorded(run, rings_file, tmp_path, press):
    """200 steps of 0.4 ms are 80 ms, 10 of them left out."""
    press(200)
    done = run("sound", rings_file, "--duration", "0.5", "--settle", "0.01", "-o", tmp_path / "out", "--json")
    assert done.exit_code == 130
    first, second = done.stderr.splitlines()[:2]
    assert re.fullmatch(r"interrupted: .*; missing: 0\.4[23]\d s of the 0\.5 s of the run", first)
    assert second.startswith("without directivity and range: `fmu-bearing sound ")
    kept = Recording.load(tmp_path / "out" / "recording.npz")
    # the flight to the farthest place lies behind what is analysed
    assert kept.size / kept.rate == pytest.approx(0.07 - TAIL / kept.rate, abs=0.001)
    assert len(done.data["levels"]) and (tmp_path / "out" / "levels.csv").is_file()
    whole = record(rings_file, 0.08, settle=0.01, warn=False).history
    assert np.array_equal(kept.history, whole[: len(kept.history)])


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_envelope_keeps_what_was_recorded(run, rings_file, tmp_path, press):
    """200 steps of 0.4 ms are 80 ms, 10 of them left out."""
    press(200)
    done = run("envelope", rings_file, "--settle", "0.01", "-o", tmp_path / "out", "--json")
    assert done.exit_code == 130 and done.stderr.startswith("interrupted: ")
    kept = Recording.load(tmp_path / "out" / "recording.npz")
    assert kept.size / kept.rate == pytest.approx(0.07 - TAIL / kept.rate, abs=0.001)
    (resolution,) = {one["resolution_Hz"] for one in done.data["envelopes"]}
    assert resolution == pytest.approx(kept.rate / kept.size) and (tmp_path / "out" / "signals.uff").is_file()


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_sound_says_why_nothing_is_kept(run, rings_file, tmp_path, press):
    press(20)
    done = run("sound", rings_file, "--duration", "0.5", "--settle", "0.01", "-o", tmp_path / "out")
    assert done.exit_code == 130 and done.stdout == "" and not (tmp_path / "out").exists()
    assert re.fullmatch(
        r"interrupted at 0\.008\d* s of the run: nothing is kept, as levels need 0\.02 s behind the 0\.01 s "
        r"that are left out\n",
        done.stderr,
    )


REPORT = ("--duration", "0.5", "--settle", "0.01", "--json")


@pytest.mark.heavy
@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_a_report_of_a_run_that_was_cut(run, rings_file, tmp_path, press):
    """The page is made of 0.1 s less the flight to microphones; what takes longest is left out."""
    press(1408)  # steps of 1/25600 s, after 10 ms and 45 ms
    page, kept = tmp_path / "page.html", tmp_path / "run.npz"
    done = run("report", rings_file, *REPORT, "-o", page, "--keep", kept)
    assert done.exit_code == 130, done.output
    assert re.search(r"missing: 0\.4[56]\d* s of the 0\.5 s of the run, changes, directivity\n", done.stderr)
    cut = {key for key, reason in done.data["missing"].items() if reason.startswith("interrupted")}
    assert cut == {"changes", "directivity"} and page.stat().st_size > 1e6
    found = Recording.load(kept)
    assert found.size / found.rate == pytest.approx(0.045 - TAIL / found.rate, abs=0.001)
    assert "of which the last 0.04" in page.read_text("utf-8")


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("place", "cut"),
    [
        ("error_motion.error_motion", {"error-motion", "contacts", "friction", "assumptions"}),
        ("at_microphones", {"levels", "spectra", "audio", "waterfall", "directivity"}),
        ("_spread", set()),
    ],
)
def test_a_report_has_the_sections_that_are_finished(run, rings_file, tmp_path, monkeypatch, place, cut):
    def pressed(*given, **more):
        raise KeyboardInterrupt

    home = importlib.import_module("fmu_bearing.reports.make")
    module, _, name = place.rpartition(".")
    monkeypatch.setattr(getattr(home, module) if module else home, name, pressed)
    page = tmp_path / "page.html"
    done = run("report", rings_file, "--duration", "0.05", "--no-changes", "--json", "-o", page)
    assert done.exit_code == 130, done.output
    missing = {key for key, reason in done.data["missing"].items() if reason.startswith("interrupted")}
    assert missing == cut and page.stat().st_size > 5e5
    assert (
        f"missing: {', '.join(key for key in done.data['sections'] if key in cut) or 'the range'}"
        in done.stderr
    )


@pytest.mark.heavy
def test_the_report_of_a_set_has_the_sections_that_are_finished(run, tmp_path, monkeypatch):
    def pressed(*given):
        raise KeyboardInterrupt

    monkeypatch.setattr("fmu_bearing.reports.sections.arrangement.axial", pressed)
    page, scene = tmp_path / "page.html", EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"
    words = ("--fidelity", "response", "--duration", "0.05", "--settle", "0", "--json")
    done = run("report", scene, *words, "-o", page)
    assert done.exit_code == 130, done.output
    sections = list(done.data["sections"])
    missing = sections[sections.index("axial") :]
    assert "arrangement" not in done.data["missing"] and len(missing) == 15
    assert [key for key, why in done.data["missing"].items() if why.startswith("interrupted")] == missing
    assert f"missing: {', '.join(missing)}\n" in done.stderr and page.is_file()


def test_files_follow_the_users_mask(run, silent_file, tmp_path):
    before = os.umask(0o077)
    try:
        assert run("simulate", silent_file, "-t", "0.002", "-o", tmp_path / "a.csv").exit_code == 0
        files.write_whole(tmp_path / "b", b"")
        os.umask(0o002)
        files.write_whole(tmp_path / "c", b"")
    finally:
        os.umask(before)
    modes = {path.name: path.stat().st_mode & 0o777 for path in tmp_path.iterdir()}
    # that others write to what the cache keeps would be refused
    assert modes == {"a.csv": 0o600, "b": 0o600, "c": 0o644}
