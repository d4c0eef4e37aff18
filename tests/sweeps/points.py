"""Points that do as they are asked: what worker processes run in the tests; and small plans."""

import json
import os
import time
from pathlib import Path

from fmu_bearing.sweeps.plan import plan
from fmu_bearing.sweeps.point import Outcome

#: Folder where points leave word that they ran; workers inherit it.
TRACE = "FMU_BEARING_TEST_TRACE"
SPEEDS = range(1000, 7000, 1000)


def small(scene, **axes):
    """Silent points of a few milliseconds, distinguished by their speed."""
    made = {
        "fidelity": ["response"],
        "speed": [float(rpm) for rpm in axes.pop("speeds", range(1000, 7000, 1000))],
    }
    return plan(scene, made | axes, settle=0.0, window=1e-3, figures=["contact.inner.load_mean"])


def rpm(task):
    return task.scene.operation.speed_rpm


def leave_word(task):
    """Note one try of a point; return how many there were before."""
    folder = Path(os.environ[TRACE])
    before = len(list(folder.glob(f"{rpm(task):g}-*")))
    (folder / f"{rpm(task):g}-{os.getpid()}-{time.monotonic_ns()}").write_text(json.dumps(os.getpid()))
    return before


def tries(folder):
    """Tries per speed."""
    found = {}
    for path in folder.iterdir():
        speed = float(path.name.split("-")[0])
        found[speed] = found.get(speed, 0) + 1
    return found


def plain(task, block=None):
    leave_word(task)
    return Outcome((rpm(task),), "", 0.0)


def troubled(task, block=None):
    """At 2000 r/min a point takes its worker with it at the first try, at 4000 at every; at 3000 it fails."""
    before = leave_word(task)
    if rpm(task) == 4000.0 or (rpm(task) == 2000.0 and before == 0):
        os._exit(9)
    if rpm(task) == 3000.0:
        raise KeyError("a fault of the program")
    return Outcome((rpm(task),), "", 0.0)


def slow(task, block=None):
    """Points that leave time to lose a worker in their middle."""
    leave_word(task)
    time.sleep(0.2)
    return Outcome((rpm(task),), "", 0.2)
