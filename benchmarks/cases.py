"""Bearings, speeds and loads of the benchmarks, and the fidelities and methods to time in each."""

import pathlib
from dataclasses import dataclass

from fmu_bearing.engine.choices import FIDELITIES, METHODS
from fmu_bearing.run.arrays import Arrays
from fmu_bearing.scene import Scene, read_scene

#: Frozen scenes with every value written out: a better default does not change what a goal measures.
GATES = pathlib.Path(__file__).parents[1] / "tests" / "scenes" / "gates"
WARM_UP = 0.05  # s: ringing of the start has died away


@dataclass(frozen=True)
class Case:
    """One operating point.

    Attributes
    ----------
    kind : str
        ``settled``, ``start`` (the first milliseconds) or ``radial``.
    window : float
        Time (s) over which errors are taken.
    """

    scene: str
    rpm: float
    kind: str = "settled"
    load_y: float = 0.0
    window: float = 5e-3

    @property
    def name(self) -> str:
        """Scene, speed and what is special."""
        extra = {"settled": "", "start": ", first 4 ms", "radial": f", {self.load_y:.0f} N radial"}[self.kind]
        return f"{self.scene} {self.rpm:,.0f} r/min{extra}"

    def bearing(self, **parameters: float) -> Arrays:
        """Initialised bearing, run for ``WARM_UP`` unless the start itself is looked at."""
        bearing = Arrays(silent(self.scene), self.rpm, load_y=self.load_y, **parameters)
        bearing.init()
        if self.kind != "start":
            bearing.run(WARM_UP, 1e-3)
        return bearing


@dataclass(frozen=True)
class Solver:
    """A fidelity and an integrator of the engine, with the goals set for it (simulated s per wall s)."""

    fidelity: str
    method: str
    goal: float
    goal_hard: float = 0.0  # under radial load and in the first milliseconds; 0: none set

    @property
    def name(self) -> str:
        """As in a scene's fidelity table."""
        return f"{self.fidelity} / {self.method}" if self.fidelity == "full" else self.fidelity

    @property
    def parameters(self) -> dict[str, float]:
        """Places of ``p`` that choose it."""
        return {"FIDELITY": FIDELITIES.index(self.fidelity), "METHOD": METHODS[self.method]}


SOLVERS = (
    Solver("full", "esdirk4", 2.0, 0.5),
    Solver("full", "trbdf2", 0.0),
    Solver("full", "rk4", 0.0),
    Solver("rings", "esdirk4", 20.0),
    Solver("response", "esdirk4", 200.0),
)

CASES = (
    Case("7003C-bare", 1000),
    Case("7003C-bare", 10000),
    Case("7003C-bare", 28000),
    Case("7009C-full-ceramic", 3000),
    Case("7009C-full-ceramic", 18000),
    Case("7003C-spindle", 20000),
    Case("7003C-spindle", 20000, "start", window=4e-3),
    Case("7009C-full-ceramic", 18000, "start", window=4e-3),
    Case("7003C-spindle", 20000, "radial", 300.0),
    Case("7003C-spindle", 20000, "radial", 1000.0),
)
QUICK = (Case("7003C-spindle", 20000),)


def silent(name: str, **fidelity: str) -> Scene:
    """Gate scene without its sound, with other choices of ``fidelity`` (not checked) and rigid rings.

    The peers' rings are rigid, too.
    """
    scene = read_scene(GATES / f"{name}.toml").with_rigid_rings()
    return scene.model_copy(update={"sound": None, "fidelity": scene.fidelity.model_copy(update=fidelity)})
