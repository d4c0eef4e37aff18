"""Memory: none is lost, running out of it is said, and no byte beyond it is touched."""

import ctypes
import os
import subprocess
import sys
from pathlib import Path

import pytest

from . import toy
from .master import DISCARD, ERROR, OK, Master, load

CYCLES = 10_000


def resident():
    """Memory of this process (bytes)."""
    pages = int(Path("/proc/self/statm").read_text().split()[1])
    return pages * os.sysconf("SC_PAGE_SIZE")


def life(functions, location):
    """What calls answer in the life of an instance, with refusals on the way; empty if there was none."""
    one = Master(functions, location)
    if not one.instance:
        return []
    answers = [one.setup(), one.enter(), one.read("angle")[0], one.exit(), one.step(0.0)]
    answers.append(one.set("load", float("nan")))
    state = ctypes.c_void_p()
    answers.append(one.call("GetFMUstate", ctypes.byref(state)))
    if state.value:
        data = one.to_bytes(state)
        status, copy = one.from_bytes(data)
        answers += [status, one.put_back(copy) if copy.value else ERROR, one.from_bytes(data[:-1])[0]]
        one.release(copy)
        one.release(state)
    answers.append(one.step(5.0))
    answers.append(one.call("Reset"))
    one.free()
    return answers


@pytest.mark.heavy
@pytest.mark.skipif(not Path("/proc/self/statm").exists(), reason="reads the memory in use from Linux")
def test_ten_thousand_instances_leave_nothing(functions, resources, tmp_path):
    def cycles(count):
        for _ in range(count):
            life(functions, resources)
        assert Master(functions, tmp_path).instance is None

    cycles(500)
    before = resident()
    cycles(CYCLES)
    assert resident() - before < 300_000  # 30 bytes each; an instance takes thousands


@pytest.fixture(scope="module")
def counting(compiler, tmp_path_factory):
    """The library on an allocator that counts and fails."""
    folder = tmp_path_factory.mktemp("counting")
    allocator = folder / "memory.o"
    source = str(toy.HERE / "toy_memory.c")
    toy.run([compiler, *toy.WARNINGS, "-fPIC", "-c", source, "-o", str(allocator)])
    renamed = [f"-D{name}=toy_{name}" for name in ("malloc", "calloc", "realloc", "free")]
    return load(toy.compile_library(folder, *renamed, objects=[str(allocator)]))


# Good calls, the NaN, the state, the bytes cut off, the wrong time, the reset.
ANSWERS = [OK] * 5 + [DISCARD] + [OK] * 3 + [ERROR, ERROR, OK]


def test_every_block_is_given_back(counting, resources):
    counting.toy_fail_after(-1)
    assert life(counting, resources) == ANSWERS
    assert counting.toy_held() == 0


def test_running_out_of_memory_is_survived(counting, resources):
    lives = []
    for count in range(1, 100):
        counting.toy_fail_after(count)
        lives.append(life(counting, resources))
        counting.toy_fail_after(-1)
        assert counting.toy_held() == 0, count
    without_instance = lives.index(ANSWERS[:5] + [DISCARD, ERROR, ERROR, OK])
    assert without_instance >= 5  # file, name, slots, arrays, instance
    assert not any(lives[:without_instance])
    assert lives[-1] == ANSWERS
    # copy of a state that cannot be made
    assert [OK, ERROR, ERROR, ERROR] in [one[6:10] for one in lives]


def test_steps_and_values_take_no_memory(counting, resources):
    """An exchange of a loop goes on where every allocation fails; a state is what needs one."""
    counting.toy_fail_after(-1)
    one, free = (Master(counting, resources).start() for _ in range(2))
    counting.toy_fail_after(1)
    held = counting.toy_held()
    for k in range(1000):
        assert one.set("load", 50.0 + k % 2) == OK
        assert one.step(0.1 * k) == OK
        assert one.read("angle")[0] == OK
    assert counting.toy_held() == held
    assert one.call("GetFMUstate", ctypes.byref(ctypes.c_void_p())) == ERROR
    counting.toy_fail_after(-1)
    for k in range(1000):
        free.set("load", 50.0 + k % 2)
        free.step(0.1 * k)
    assert one.everything() == free.everything()
    one.free()
    free.free()


def test_message_without_memory(counting, resources):
    counting.toy_fail_after(-1)
    one = Master(counting, resources).start()
    counting.toy_fail_after(1)
    assert one.set("load", -1.0) == DISCARD
    counting.toy_fail_after(-1)
    assert one.log[-1] == (DISCARD, "logStatusDiscard", "no memory for a message")
    assert one.step(0.0) == OK
    one.free()


@pytest.mark.heavy
def test_no_byte_beyond_the_arrays_is_touched(compiler, pytestconfig):
    runtime = subprocess.run(
        [compiler, "-print-file-name=libasan.so"], capture_output=True, text=True, timeout=600
    ).stdout.strip()
    if not Path(runtime).is_absolute():
        pytest.skip("this compiler has no AddressSanitizer")
    environment = {
        **os.environ,
        "LD_PRELOAD": runtime,
        "ASAN_OPTIONS": "detect_leaks=0",  # Python's own; leaks are counted above
        "UBSAN_OPTIONS": "print_stacktrace=1",
        "TOY_FLAGS": "-g -fsanitize=address,undefined -fno-sanitize-recover=undefined",
    }
    command = [sys.executable, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-m", "not heavy"]
    # left out: this file, libraries of real kernels, and the careless host with its own sanitised builds
    others = ("test_shim_memory.py", "test_cross_builds.py", "test_fuzz.py")
    command += [*(f"--ignore=tests/native/{name}" for name in others), "tests/native"]
    ran = subprocess.run(
        command, capture_output=True, text=True, env=environment, cwd=pytestconfig.rootpath, timeout=600
    )
    assert ran.returncode == 0, ran.stdout[-5000:] + ran.stderr[-5000:]
    assert " passed" in ran.stdout
