"""Bearings, speeds and loads of the benchmarks with their goals, and the fidelities and methods to time."""

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
    goals : tuple of float
        Simulated s per CPU s that fidelities full, rings and response are to reach; 0: no goal.
    kind : str
        ``settled``, ``start`` (the first milliseconds) or ``radial``.
    window : float
        Time (s) over which errors are taken.
    communication : float
        Communication step (s) in which both error and speed are taken.
    """

    scene: str
    rpm: float
    goals: tuple[float, float, float]
    kind: str = "settled"
    load_y: float = 0.0
    window: float = 20e-3
    communication: float = 5e-4

    def goal(self, solver: "Solver") -> float:
        """Speed that a solver is to reach here; only the default integrator of ``full`` has a goal."""
        return self.goals[FIDELITIES.index(solver.fidelity)] if solver.method == "esdirk4" else 0.0

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
    """A fidelity and an integrator of the engine."""

    fidelity: str
    method: str = "esdirk4"

    @property
    def name(self) -> str:
        """As in a scene's fidelity table."""
        return f"{self.fidelity} / {self.method}" if self.fidelity == "full" else self.fidelity

    @property
    def parameters(self) -> dict[str, float]:
        """Places of ``p`` that choose it."""
        return {"FIDELITY": FIDELITIES.index(self.fidelity), "METHOD": METHODS[self.method]}


SOLVERS = (
    Solver("full"), Solver("full", "trbdf2"), Solver("full", "rk4"), Solver("rings"), Solver("response"),
)  # fmt: skip


def _start(scene: str, rpm: float) -> Case:
    """The first 4 ms, in short communication steps."""
    return Case(scene, rpm, (1.0, 0.0, 0.0), "start", window=4e-3, communication=1e-4)


CASES = (
    Case("7003C-bare", 1000, (3.0, 30.0, 250.0)),
    Case("7003C-bare", 10000, (3.0, 30.0, 250.0)),
    Case("7003C-bare", 28000, (2.0, 20.0, 250.0)),
    Case("7009C-full-ceramic", 3000, (2.8, 30.0, 200.0)),
    Case("7009C-full-ceramic", 18000, (2.2, 20.0, 200.0)),
    Case("7003C-spindle", 20000, (3.0, 30.0, 250.0)),
    _start("7003C-spindle", 20000),
    _start("7009C-full-ceramic", 18000),
    Case("7003C-spindle", 20000, (2.3, 20.0, 100.0), "radial", 300.0),
    Case("7003C-spindle", 20000, (0.75, 20.0, 100.0), "radial", 1000.0),
    Case("7003C-bare", 10000, (2.3, 20.0, 100.0), "radial", 300.0),
    Case("7003C-bare", 10000, (0.75, 20.0, 100.0), "radial", 1000.0),
)
QUICK = (Case("7003C-spindle", 20000, (3.0, 30.0, 250.0)),)


def silent(name: str, **fidelity: str) -> Scene:
    """Gate scene without its sound, with other choices of ``fidelity`` (not checked) and rigid rings.

    The peers' rings are rigid, too.
    """
    scene = read_scene(GATES / f"{name}.toml").with_rigid_rings()
    return scene.model_copy(update={"sound": None, "fidelity": scene.fidelity.model_copy(update=fidelity)})
