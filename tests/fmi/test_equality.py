"""Both builds and the library give the same bits: in a run-up with sound, across states and processes."""

import subprocess
import sys
import zipfile

import pytest

from fmu_bearing.fmi.package import build
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import read_scene

from .conftest import OK, SPINDLE_SCENE, Master
from .run_up import FROM, SIZE, STEPS, TO, run_up, speed


@pytest.fixture
def pair(unpack):
    """Both builds, initialised at the foot of the run-up."""
    made = [Master(unpack(flavour)).start(shaft_speed=FROM) for flavour in ("native", "python")]
    yield made
    for one in made:
        one.free()


def test_run_up_of_both_builds_and_the_library(pair, model):
    alone = Instance(model)
    alone.set("shaft_speed", FROM)
    alone.initialise(0.0)
    names = [v.name for kind in ("Real", "Integer") for v in model.variables if v.type == kind]
    assert pair[0].everything() == pair[1].everything()
    native, python = (run_up(one) for one in pair)
    assert native == python
    for i, values in enumerate(native):
        alone.set("shaft_speed", speed(i))
        alone.set("preload", 500.0 - i)
        alone.step(SIZE)
        assert values == [alone.get(name) for name in names], i
    # there was sound, and it was a run-up
    last = dict(zip(names, native[-1], strict=True))
    loud = [name for name in names if name.endswith(".pressure") and abs(last[name]) > 1e-6]
    assert len(loud) == 4
    assert last["shaft_speed"] == TO


def test_state_saved_and_restored_in_the_middle(pair):
    straight = run_up(pair[0])
    for one in pair:
        one.reset()
        one.start(shaft_speed=FROM)
        half = run_up(one, 0, STEPS // 2)
        state = one.keep()
        run_up(one, STEPS // 2, STEPS - 5)
        assert one.put_back(state) == OK
        assert half + run_up(one, STEPS // 2) == straight
        assert one.release(state) == OK


CHILD = """
import sys
from pathlib import Path
sys.path.insert(0, sys.argv[1])
from tests.fmi.conftest import Master
from tests.fmi.run_up import FROM, STEPS, run_up
bearing = Master(Path(sys.argv[2]))
if len(sys.argv) > 3:
    state = bearing.from_bytes(Path(sys.argv[3]).read_bytes())[1]
    assert bearing.put_back(state) == 0
    taken = run_up(bearing, STEPS // 2)
else:
    taken = run_up(bearing.start(shaft_speed=FROM))
print(*(float(value).hex() for values in taken for value in values))
bearing.free()
"""


def in_another_process(pytestconfig, folder, *files):
    command = [sys.executable, "-c", CHILD, str(pytestconfig.rootpath), str(folder), *map(str, files)]
    ran = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert ran.returncode == 0, ran.stderr
    return ran.stdout.split()


def bits(taken):
    return [float(value).hex() for values in taken for value in values]


@pytest.mark.heavy
def test_serialised_state_continues_in_a_new_process(unpack, flavour, tmp_path, pytestconfig):
    one = Master(unpack(flavour)).start(shaft_speed=FROM)
    run_up(one, 0, STEPS // 2)
    file = tmp_path / "state.bin"
    file.write_bytes(one.to_bytes(one.keep()))
    here = bits(run_up(one, STEPS // 2))
    one.free()
    assert in_another_process(pytestconfig, unpack(flavour), file) == here


@pytest.mark.heavy
def test_instruction_sets_give_the_same_bits(unpack, pytestconfig, monkeypatch):
    # the library takes v3 where the processor has it; the variable is read when an instance is made
    one = Master(unpack("native")).start(shaft_speed=FROM)
    here = bits(run_up(one))
    one.free()
    monkeypatch.setenv("FMU_BEARING_ISA", "v2")
    assert in_another_process(pytestconfig, unpack("native")) == here


@pytest.mark.heavy
def test_long_run_up_with_the_sound_of_boundary_elements(tmp_path):
    model = prepare(read_scene(SPINDLE_SCENE))
    made = []
    for flavour in ("native", "python"):
        with zipfile.ZipFile(build(model, tmp_path / f"{flavour}.fmu", flavour).path) as archive:
            archive.extractall(tmp_path / flavour)
        made.append(Master(tmp_path / flavour).start(shaft_speed=FROM))
    time = 0.0
    for i in range(1000):
        for one in made:
            assert one.set("shaft_speed", FROM + 2.0 * i) == OK
            assert one.step(time, SIZE) == OK
        time += SIZE
        assert made[0].everything() == made[1].everything(), i
    assert abs(made[0].get("mic[1].pressure")) > 1e-5
    for one in made:
        one.free()
