"""Compilation as a user meets it: progress on a terminal and in a log, Ctrl-C, failures, bits."""

import io
import os
import signal
import subprocess
import sys
import time

import numpy as np
import pytest

from fmu_bearing.compiled import BuildError, call, make, show
from fmu_bearing.compiled.platforms import PLATFORMS, instruction_set, own
from fmu_bearing.compiled.settings import SETTINGS, TESTED, lean
from fmu_bearing.compiled.units import ENTRIES, UNITS
from tests.conftest import GATES

#: Compiles one entry of two kernels both ways; prints what it computes.
_BOTH_WAYS = """
import ctypes, sys
import numpy as np
from numba import carray
from fmu_bearing.compiled import lower, units
from fmu_bearing.compiled.load import _linked
from fmu_bearing.compiled.optimise import object_code
from fmu_bearing.compiled.platforms import instruction_set, own
from fmu_bearing.engine.dense import invert

def entry(a, b, n):
    invert(carray(a, (n[0],)), 0, 5, carray(b, (n[1],)), 0)
    return 0

units.ENTRIES["entry"] = units.Entry("entry", "ab")
lower.functions = lambda unit: {"entry": entry}
code = lower.portable_code("entry", lambda done: None, sys.argv[1] == "lean")
suffix = instruction_set(own())
engine = _linked(object_code(code, own(), suffix, lambda done: None))
call = ctypes.CFUNCTYPE(ctypes.c_int32, *[ctypes.c_void_p] * 3)(
    engine.get_function_address(units.symbol("entry", suffix))
)
a = np.random.default_rng(7).standard_normal(25)
b, n = np.zeros(25), np.array([25, 25])
call(a.ctypes.data, b.ctypes.data, n.ctypes.data)
print(b.tobytes().hex())
"""


#: Compiles a unit the plain way and keeps its object.
_PLAIN = """
import pathlib, sys
from fmu_bearing.compiled.lower import portable_code
from fmu_bearing.compiled.optimise import object_code
from fmu_bearing.compiled.platforms import own

unit, suffix, target = sys.argv[1:]
code = portable_code(unit, lambda done: None, False)
pathlib.Path(target).write_bytes(object_code(code, own(), suffix, lambda done: None))
"""

#: Runs scenes for 2 ms, with objects of a folder if one is named; prints state and outputs at each step.
_RUN = """
import hashlib, pathlib, sys
from fmu_bearing.compiled import load
from fmu_bearing.arrays import Arrays
from fmu_bearing.scene import read_scene

scenes, folders = sys.argv[1].split(":"), sys.argv[2:]
lean = load.objects
for folder in folders:
    load.objects = lambda platform, units, sets: lean(platform, units, sets) | {
        ("step", one): pathlib.Path(folder, "step.o").read_bytes() for one in sets
    }
for path in scenes:
    bearing = Arrays.of(read_scene(path).model_copy(update={"sound": None}))
    bearing.init()
    for _ in range(20):
        bearing.step(1e-4)
        print(hashlib.sha256(bearing.s.tobytes() + bearing.z.tobytes()).hexdigest())
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
    """Half a minute of one optimisation pass reports nothing: the bar goes on at the pace so far."""
    now = [10.0]
    monkeypatch.setattr(make.time, "monotonic", lambda: now[0])
    worker = make._Worker({"step": ["v3"]}, own())
    worker._begin = worker._since = 0.0
    worker._messages.put(0.4)
    assert worker.part() == 0.4
    now[0] = 11.0
    assert worker.part() == pytest.approx(0.44)
    now[0] = 100.0
    assert worker.part() == pytest.approx(0.5)  # never far ahead of what was reported
    worker._messages.put(0.5)
    assert worker.part() == 0.5


def test_a_failure_names_the_unit_and_the_reason(tmp_path, monkeypatch):
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path))
    monkeypatch.setitem(SETTINGS, "NUMBA_OPT", "3")  # no portable code with it: lower refuses

    def broken(self, sizes):
        return [sys.executable, "-c", "import sys; sys.exit('no such thing')"]

    monkeypatch.setattr(make._Worker, "_command", broken)
    with pytest.raises(BuildError) as refusal:
        make.objects(own(), ["study"], ["v0"])
    assert str(refusal.value) == "the kernels could not be compiled (study): no such thing"


@pytest.mark.parametrize(
    ("code", "reason"),
    [(3, "the process ended with code 3 and gave no reason"), (0, "not received: study-{platform}-v0.o")],
)
def test_a_worker_that_ends_at_once_is_a_failure_of_the_compilation(code, reason, tmp_path, monkeypatch):
    """It leaves a broken pipe: portable code larger than any pipe is on its way to it."""
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path))
    monkeypatch.setattr(make, "_there", lambda name: bytes(10**7) if name.endswith(".bc") else None)
    command = [sys.executable, "-c", f"import os; os._exit({code})"]
    monkeypatch.setattr(make._Worker, "_command", lambda self, sizes: command)
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
    [["fmu_bearing.compiled.worker", "lean"], ["fmu_bearing.fmi.native.prebuilt", "folder"]],
    ids=["worker", "prebuilt"],
)
def test_an_unknown_platform_is_refused_by_name(module, tmp_path):
    ran = subprocess.run(
        [sys.executable, "-m", *module, "linux32"], cwd=tmp_path, stdin=subprocess.DEVNULL,
        capture_output=True, text=True, timeout=600,
    )  # fmt: skip
    assert ran.returncode == 1
    assert f"there is no platform 'linux32': choose from {', '.join(PLATFORMS)}" in ran.stderr
    assert "Traceback" not in ran.stderr
    assert not (tmp_path / "folder").exists()


@pytest.mark.skipif(os.name == "nt", reason="no SIGINT for a child process on Windows")
def test_ctrl_c_ends_it_at_once(tmp_path):
    environment = {**os.environ, "FMU_BEARING_CACHE": str(tmp_path)}
    process = subprocess.Popen(
        [sys.executable, "-m", "fmu_bearing", "warm-up"], env=environment, text=True,
        stdout=subprocess.PIPE, stderr=subprocess.PIPE, start_new_session=True,
        preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),  # a shell's background ignores it
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


@pytest.mark.skipif(not lean(make.version("numba")), reason="this Numba is compiled with the plain way only")
def test_the_lean_way_computes_the_plain_ways_bits():
    found = {}
    for way in ("lean", "plain"):
        ran = subprocess.run(
            [sys.executable, "-c", _BOTH_WAYS, way], env={**os.environ, **SETTINGS},
            capture_output=True, text=True, timeout=600,
        )  # fmt: skip
        assert ran.returncode == 0, ran.stderr
        found[way] = np.frombuffer(bytes.fromhex(ran.stdout.strip()))
    a = np.random.default_rng(7).standard_normal(25).reshape(5, 5)
    np.testing.assert_allclose(found["plain"].reshape(5, 5) @ a, np.eye(5), atol=1e-12)
    assert found["lean"].tobytes() == found["plain"].tobytes()


@pytest.mark.heavy
@pytest.mark.skipif(not lean(make.version("numba")), reason="this Numba is compiled with the plain way only")
def test_a_run_has_the_same_bits_both_ways(tmp_path):
    """Fidelity full on rigid and on bending rings; the plain way takes 5 minutes of a processor.

    The unit of the steps alone: it has the kernels of the start, too.
    """
    suffix, target = instruction_set(own()), tmp_path / "step.o"
    lean_object = make.objects(own(), ("step",), [suffix])["step", suffix]
    compiled = subprocess.run(
        [sys.executable, "-c", _PLAIN, "step", suffix, str(target)],
        env={**os.environ, **SETTINGS}, stderr=subprocess.PIPE, text=True, timeout=2400,
    )  # fmt: skip
    assert compiled.returncode == 0, compiled.stderr
    assert target.read_bytes() != lean_object  # two ways, two objects
    scenes = ":".join(str(GATES / f"{name}.toml") for name in ("7003C-spindle", "7009C-steel"))
    lean_run, plain_run = (
        subprocess.run(
            [sys.executable, "-c", _RUN, scenes, *folder],
            check=True,
            stdout=subprocess.PIPE,
            text=True,
            timeout=600,
        ).stdout.splitlines()
        for folder in ([], [str(tmp_path)])
    )
    assert len(set(lean_run)) == 40  # 20 steps of two scenes, none of which stands still
    assert plain_run == lean_run


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
            call("contacts", wrong, z, z)
