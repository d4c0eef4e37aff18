"""Compilation as a user meets it: progress on a terminal and in a log, Ctrl-C, failures, bits."""

import io
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from fmu_bearing.compiled import BuildError, call, lower, make, show
from fmu_bearing.compiled.platforms import PLATFORMS, own
from fmu_bearing.compiled.settings import SETTINGS, TESTED, lean
from fmu_bearing.compiled.units import ENTRIES, UNITS
from fmu_bearing.engine import abi
from fmu_bearing.engine.fidelities.rings import frozen_points, march
from tests.compiled import both_ways

#: An entry of two kernels.
_INVERTS = """
from fmu_bearing.engine.dense import invert

def entry(a, b, n):
    invert(carray(a, (n[0],)), 0, 5, carray(b, (n[1],)), 0)
    return 0
"""


class Terminal(io.StringIO):
    def isatty(self):
        return True


def test_a_log_gets_lines(monkeypatch):
    log, now = io.StringIO(), [100.0]
    monkeypatch.setattr(show.sys, "stderr", log)
    monkeypatch.setattr(show.time, "monotonic", lambda: now[0])
    with show.Display("compiling") as display:
        for second in range(26):
            now[0] = 100.0 + second
            display.at(second / 25)
    assert log.getvalue().splitlines() == [
        "compiling ...",
        "compiling: 40% after 10 s",
        "compiling: 80% after 20 s",
        "compiling: done after 25 s",
    ]


def test_the_time_of_the_rest_is_shown_where_it_is_known(monkeypatch):
    """At once where it is worth a line, then with each line."""
    log, now = io.StringIO(), [100.0]
    monkeypatch.setattr(show.sys, "stderr", log)
    monkeypatch.setattr(show.time, "monotonic", lambda: now[0])
    with show.Display("solving") as display:
        for now[0], done, rest in ((101.0, 0.0, None), (102.0, 0.1, 28.0), (112.0, 0.4, 18.0)):
            display.at(done, rest)
    assert log.getvalue().splitlines()[1:-1] == [
        "solving: 10% after 2 s, about 28 s more",
        "solving: 40% after 12 s, about 18 s more",
    ]


def test_a_short_rest_gets_no_line_of_its_own(monkeypatch):
    log, now = io.StringIO(), [100.0]
    monkeypatch.setattr(show.sys, "stderr", log)
    monkeypatch.setattr(show.time, "monotonic", lambda: now[0])
    with show.Display("solving") as display:
        now[0] = 101.0
        display.at(0.5, 1.0)
    assert log.getvalue().splitlines() == ["solving ...", "solving: done after 1 s"]


def test_what_is_shown_as_done_never_goes_back(monkeypatch):
    """More work turns up than was expected: the part done waits, the time of the rest follows."""
    log, now = io.StringIO(), [100.0]
    monkeypatch.setattr(show.sys, "stderr", log)
    monkeypatch.setattr(show.time, "monotonic", lambda: now[0])
    with show.Display("solving") as display:
        for done, rest in ((0.8, 5.0), (0.5, 40.0), (0.9, 7.0)):
            now[0] += 20.0
            display.at(done, rest)
    assert log.getvalue().splitlines()[1:4] == [
        "solving: 80% after 20 s, about 5 s more",
        "solving: 80% after 40 s, about 40 s more",
        "solving: 90% after 60 s, about 7 s more",
    ]


def test_a_terminal_gets_a_bar(monkeypatch):
    terminal = Terminal()
    monkeypatch.setattr(show.sys, "stderr", terminal)
    with show.Display("compiling") as display:
        display.at(0.5)
        display.tell("a remark")
    assert "compiling" in terminal.getvalue()
    assert "50%" in terminal.getvalue()
    assert "a remark" in terminal.getvalue()


def test_the_part_that_is_done_moves_on_between_reports(monkeypatch):
    """Many seconds of one optimisation pass report nothing: the bar goes on at the pace so far."""
    now = [10.0]
    monkeypatch.setattr(make.time, "monotonic", lambda: now[0])
    worker = make._Worker(["step"], own(), "v3")
    worker._begin = worker._since = 0.0
    worker._messages.put(0.1)
    assert worker.part() == pytest.approx(0.1)
    now[0] = 11.0
    assert worker.part() == pytest.approx(0.11)
    now[0] = 100.0
    assert worker.part() == pytest.approx(0.7)  # never farther ahead of what was reported than a pass is long
    worker._messages.put(0.5)
    assert worker.part() == pytest.approx(0.7)  # never back
    worker._messages.put(0.9)
    assert worker.part() == pytest.approx(0.9)


def test_units_count_by_the_time_they_take(monkeypatch):
    monkeypatch.setattr(make, "_SECONDS", {"step": (30.0, 0.0), "init": (10.0, 0.0)})
    worker = make._Worker(["step", "init"])
    shares = {units: worker._share(units) for units in (0.0, 0.5, 1.0, 1.5, 2.0)}
    assert shares == {0.0: 0.0, 0.5: 0.375, 1.0: 0.75, 1.5: 0.875, 2.0: 1.0}


def test_the_kernels_of_a_unit_are_counted_wherever_they_are_named():
    """Most are called through their module, as ``frozen_points.freeze_all``."""
    counted = lower._reached([abi.step.py_func])
    assert {frozen_points.freeze_all.py_func, march.try_step.py_func, abi.outputs.py_func} <= counted
    assert abi.init.py_func not in counted


def test_a_failure_names_the_unit_and_the_reason(tmp_path, monkeypatch):
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path))
    monkeypatch.setitem(SETTINGS, "NUMBA_OPT", "3")  # no portable code with it: lower refuses

    def broken(self):
        return [sys.executable, "-c", "import sys; sys.exit('no such thing')"]

    monkeypatch.setattr(make._Worker, "_command", broken)
    with pytest.raises(BuildError) as refusal:
        make.objects(own(), ["study"], ["v0"])
    assert str(refusal.value) == "the kernels could not be compiled (study): no such thing"


def test_a_long_failure_keeps_both_ends(tmp_path, monkeypatch):
    """Numba gives the reason first, then thousands of characters of where."""
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path))
    words = "import sys; sys.exit('the reason ' + 5000 * 'calls ' + 'the last call')"
    monkeypatch.setattr(make._Worker, "_command", lambda self: [sys.executable, "-c", words])
    with pytest.raises(BuildError) as refusal:
        make.objects(own(), ["study"], ["v0"])
    said = str(refusal.value)
    assert ": the reason calls" in said and said.endswith("the last call") and len(said) < 2200


@pytest.mark.parametrize(
    ("code", "reason"),
    [(3, "the process ended with code 3 and gave no reason"), (0, "not received: study-{platform}-v0.o")],
)
def test_a_worker_that_ends_at_once_is_a_failure_of_the_compilation(code, reason, tmp_path, monkeypatch):
    """It leaves a broken pipe: portable code larger than any pipe is on its way to it."""
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path))
    monkeypatch.setattr(make, "_there", lambda name: bytes(10**7) if name.endswith(".bc") else None)
    command = [sys.executable, "-c", f"import os; os._exit({code})"]
    monkeypatch.setattr(make._Worker, "_command", lambda self: command)
    with pytest.raises(BuildError) as refusal:
        make.objects(own(), ["study"], ["v0"])
    reason = reason.format(platform=own().name)
    assert str(refusal.value) == f"the kernels could not be compiled (study): {reason}"


def test_another_checkout_in_the_current_folder_is_not_compiled(tmp_path, monkeypatch):
    """Its kernels would be kept under the key of these."""
    (tmp_path / "fmu_bearing").mkdir()
    (tmp_path / "fmu_bearing" / "__init__.py").write_text("raise SystemExit('another checkout')")
    monkeypatch.chdir(tmp_path)
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path))
    monkeypatch.setattr(make, "_there", lambda name: b"no code" if name.endswith(".bc") else None)
    with pytest.raises(BuildError) as refusal:
        make.objects(own(), ["study"], ["v0"])
    assert "another checkout" not in str(refusal.value)
    assert "fmu_bearing/compiled" in str(refusal.value).replace("\\", "/")


@pytest.mark.parametrize(
    "module",
    [
        ["fmu_bearing.compiled.worker", "linux32", "step", "v2"],
        ["fmu_bearing.fmi.native.prebuilt", "folder", "linux32"],
    ],
    ids=["worker", "prebuilt"],
)
def test_an_unknown_platform_is_refused_by_name(module, tmp_path):
    ran = subprocess.run(
        [sys.executable, "-m", *module], cwd=tmp_path, stdin=subprocess.DEVNULL,
        capture_output=True, text=True, timeout=600,
    )  # fmt: skip
    assert ran.returncode == 1
    assert f"there is no platform 'linux32': choose from {', '.join(PLATFORMS)}" in ran.stderr
    assert "Traceback" not in ran.stderr
    assert not (tmp_path / "folder").exists()


@pytest.mark.heavy
@pytest.mark.skipif(os.name == "nt", reason="no SIGINT for a child process on Windows")
def test_ctrl_c_ends_it_at_once(tmp_path):
    environment = {**os.environ, "FMU_BEARING_CACHE": str(tmp_path)}
    process = subprocess.Popen(
        [sys.executable, "-m", "fmu_bearing", "warm-up"], env=environment, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
    )  # fmt: skip
    assert "compiling the kernels" in process.stderr.readline()
    time.sleep(3.0)  # deep in Numba
    process.send_signal(signal.SIGINT)  # to this process alone: it ends its workers itself
    out, complaint = process.communicate(timeout=15)  # compiling would take longer on any machine
    assert process.returncode != 0
    assert "Traceback" not in complaint + out
    left = subprocess.run(
        ["ps", "-o", "pid=", "-s", str(process.pid)], capture_output=True, text=True, timeout=600
    ).stdout
    assert left.strip() == ""


@pytest.mark.heavy
@pytest.mark.skipif(not lean(make.version("numba")), reason="this Numba is compiled with the plain way only")
def test_the_lean_way_computes_the_plain_ways_bits():
    found = {}
    for way in ("lean", "plain"):
        ran = both_ways.run(_INVERTS, way)
        assert ran.returncode == 0, ran.stderr
        found[way] = np.frombuffer(bytes.fromhex(ran.stdout.strip()))
    a = np.random.default_rng(7).standard_normal(25).reshape(5, 5)
    np.testing.assert_allclose(found["plain"].reshape(5, 5) @ a, np.eye(5), atol=1e-12)
    assert found["lean"].tobytes() == found["plain"].tobytes()


def test_other_numbas_get_the_plain_way():
    assert lean(f"{TESTED[0]}.1")
    assert not lean("0.59.0")
    assert not lean("1.0.0")


def test_every_entry_belongs_to_a_unit():
    assert {entry.unit for entry in ENTRIES.values()} == set(UNITS)


def test_arrays_of_another_kind_are_refused():
    z = np.zeros(400)
    for wrong in (np.zeros(800)[::2], np.zeros(400, dtype=np.float32)):
        with pytest.raises(TypeError, match="float64 arrays without gaps"):
            call("outputs", wrong, z, z)
