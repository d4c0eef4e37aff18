"""Scenes with a few keys changed, and bearings driven leg by leg for the tests of this folder."""

from dataclasses import dataclass, field

import numpy as np

from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import Z
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import Scene, read_scene
from tests.conftest import GATES

SILENT = {"sound": None}
PERFECT = {"sound": None, "imperfections": None}
#: Changes that give the 7009C the most balls that the engine has room for, smaller ones.
MOST_BALLS = {
    "bearing.ball_count": 36,
    "bearing.ball_diameter_mm": 4.366,
    "bearing.cage.pocket_diameter_mm": 4.55,
}
RINGS = [f"{ring}_ring.velocity.{axis}" for ring in ("inner", "outer") for axis in "xyz"]


def edited(name: str, changes: dict) -> Scene:
    """Gate scene ``name`` with ``table.table.key`` replaced, held against the scene's rules.

    Rings are rigid unless ``changes`` give ``mounting.flexure``.
    """
    data = read_scene(GATES / f"{name}.toml").with_rigid_rings().model_dump()
    for path, value in changes.items():
        *tables, key = path.split(".")
        table = data
        for part in tables:
            table = table[part]
        table[key] = value
    return Scene.model_validate(data)


def bearing(
    name: str, changes: dict, inputs: dict, fidelity="full", method="esdirk4", **settings
) -> Instance:
    """Return a bearing, not yet initialised; ``inputs`` and ``settings`` in SI, speed as ``rpm``."""
    instance = Instance(prepare(edited(name, changes), fidelity=fidelity, method=method))
    feed(instance, inputs)
    for key, value in settings.items():
        instance.set(key, value)
    return instance


def feed(instance: Instance, inputs: dict) -> None:
    """Set inputs; ``rpm`` stands for the shaft speed in r/min."""
    for key, value in inputs.items():
        if key == "rpm":
            instance.set("shaft_speed", value * RPM)
        else:
            instance.set(key, value)


@dataclass
class Trace:
    """What a run left behind: times (s) and outputs at the communication points, and the work it took."""

    times: list = field(default_factory=list)
    rows: list = field(default_factory=list)
    attempts: list = field(default_factory=list)  # accepted and rejected internal steps per simulated ms

    def column(self, name: str, since: float = -np.inf):
        """An output over the points after ``since`` (s)."""
        rows = np.array(self.rows)[np.array(self.times) > since]
        return rows[:, Z.BEARING_OUTPUTS.index(name)]

    def columns(self, names, since: float = -np.inf):
        return np.array([self.column(name, since) for name in names]).T


def drive(instance: Instance, duration: float, h: float, trace: Trace | None = None) -> Trace:
    """Step for ``duration`` (s) at communication step ``h`` (s) with the inputs as they are."""
    trace = Trace() if trace is None else trace
    before = work(instance)
    for _ in range(round(duration / h)):
        instance.step(h)
        trace.times.append(instance.time)
        trace.rows.append(instance.z.copy())
    trace.attempts.append((work(instance) - before) / (1e3 * duration))
    return trace


def work(instance: Instance) -> float:
    """Internal steps so far, rejected ones included."""
    return instance.get("solver.steps") + instance.get("solver.rejected")
