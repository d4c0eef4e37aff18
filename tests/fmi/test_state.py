"""The state of an FMU instance: complete, portable, bound to its model."""

import subprocess
import sys

import numpy as np
import pytest
from fmpy.fmi1 import FMICallException

from fmu_bearing.fmi import resources
from fmu_bearing.fmi.state import State, StateError

from .conftest import STEP, Master


def test_continuing_after_restore_gives_the_same_bits(master):
    bearing, fresh = master().start(preload=300.0), master()
    bearing.run(2)
    bearing.set("shaft_speed", 1500.0)
    state = bearing.slave.getFMUstate()
    expected = bearing.run(3, 2 * STEP)
    bearing.slave.setFMUstate(state)
    assert bearing.get("preload") == 300.0
    assert bearing.run(3, 2 * STEP) == expected
    # and in an instance that was never initialised
    data = bearing.slave.serializeFMUstate(state)
    fresh.slave.setFMUstate(fresh.slave.deSerializeFMUstate(data))
    assert fresh.run(3, 2 * STEP) == expected
    bearing.slave.freeFMUstate(state)


def test_state_before_initialisation_can_be_kept(master):
    bearing, other = master(), master().start(preload=300.0)
    bearing.set("preload", 300.0)
    state = bearing.slave.getFMUstate()
    bearing.start(preload=100.0).run(1)
    bearing.slave.setFMUstate(state)
    assert bearing.start().run(2) == other.run(2)


def test_refusals_belong_to_the_state(master):
    bearing = master().start()
    good = bearing.slave.getFMUstate()
    bearing.set("preload", -1.0)
    bad = bearing.slave.getFMUstate()
    bearing.slave.setFMUstate(good)
    bearing.step(0.0)
    bearing.slave.setFMUstate(bad)
    with pytest.raises(FMICallException):
        bearing.step(0.0)


CHILD = """
import sys
sys.path.insert(0, sys.argv[1])
from tests.fmi.conftest import Master, STEP
from pathlib import Path
bearing = Master(Path(sys.argv[2]))
data = Path(sys.argv[3]).read_bytes()
bearing.slave.setFMUstate(bearing.slave.deSerializeFMUstate(data))
for values in bearing.run(2, 2 * STEP):
    print(*(value.hex() for value in values))
bearing.slave.freeInstance()
"""


def test_another_process_continues_with_the_same_bits(master, unpacked, tmp_path, pytestconfig):
    bearing = master().start(preload=300.0)
    bearing.run(2)
    file = tmp_path / "state.bin"
    file.write_bytes(bearing.slave.serializeFMUstate(bearing.slave.getFMUstate()))
    command = [sys.executable, "-c", CHILD, str(pytestconfig.rootpath), str(unpacked), str(file)]
    child = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    assert child.returncode == 0, child.stderr
    expected = [" ".join(value.hex() for value in values) for values in bearing.run(2, 2 * STEP)]
    assert child.stdout.split("\n")[:-1] == expected


@pytest.mark.parametrize("damage", ["flip", "short", "empty", "version", "model"])
def test_foreign_or_damaged_state_is_refused(master, damage):
    bearing = master().start()
    data = bytearray(bearing.slave.serializeFMUstate(bearing.slave.getFMUstate()))
    if damage == "flip":
        data[-9] ^= 1
    elif damage == "short":
        del data[-8:]
    elif damage == "empty":
        data = bytearray(b"x")
    elif damage == "version":
        data[:19] = b"fmu-bearing state 0"
    else:
        data[20] ^= 1
    before = bearing.reals()
    good = bearing.slave.getFMUstate()
    bearing.slave.setFMUstate(bearing.slave.deSerializeFMUstate(bytes(data)))
    assert "state not taken" in bearing.messages
    assert bearing.reals() == before
    with pytest.raises(FMICallException):
        bearing.step(0.0)
    bearing.slave.setFMUstate(good)
    bearing.step(0.0)


def test_bytes_hold_every_bit(model):
    mark = resources.fingerprint(model)
    numbers = np.random.default_rng(1).standard_normal
    wrong = ((3, "preload = nan is refused: µ"), (-1, "x"))
    state = State(2, 0.1, numbers(8), numbers(7), numbers(50), numbers(1000), settled=True, wrong=wrong)
    back = State.from_bytes(state.to_bytes(mark), mark)
    assert (back.phase, back.time, back.settled, back.wrong) == (2, 0.1, True, wrong)
    for name in ("inputs", "tunables", "outputs", "engine"):
        assert np.array_equal(getattr(back, name), getattr(state, name))
    with pytest.raises(StateError, match="another model"):
        State.from_bytes(state.to_bytes(mark), mark[::-1])


def test_master_of_this_file_is_the_one_of_the_others():
    assert Master.__module__.endswith("conftest")
