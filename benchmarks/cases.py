"""Bearings, speeds and loads of the benchmarks with their goals, and the fidelities and methods to time."""

import pathlib
from dataclasses import dataclass

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.choices import FIDELITIES, METHODS
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import U
from fmu_bearing.scene import Scene, read_scene, si

#: Frozen scenes with every value written out: a better default does not change what a goal measures.
GATES = pathlib.Path(__file__).parents[1] / "tests" / "scenes" / "gates"
#: What users begin with: its speed is that of today's defaults, beside the gate scene of the same name.
EXAMPLES = pathlib.Path(__file__).parents[1] / "examples" / "scenes"
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
        Communication step (s) in which errors are taken, and the speed of fidelity full.
    folder : Path
        Folder of the scene: ``GATES`` or ``EXAMPLES``.
    """

    scene: str
    rpm: float
    goals: tuple[float, float, float]
    kind: str = "settled"
    load_y: float = 0.0
    window: float = 20e-3
    communication: float = 5e-4
    folder: pathlib.Path = GATES

    def goal(self, solver: "Solver") -> float:
        """Speed that a solver is to reach here; only the default integrator of ``full`` has a goal."""
        return self.goals[FIDELITIES.index(solver.fidelity)] if solver.method == "esdirk4" else 0.0

    @property
    def setting(self) -> tuple[float, float]:
        """Tolerance and largest internal step (s): of the goals on gate scenes, an example scene's own."""
        if self.folder == GATES:
            return 1e-3, 25e-6
        fidelity = si(self.quiet().fidelity)
        return fidelity.tolerance, fidelity.max_internal_step

    @property
    def name(self) -> str:
        """Scene, speed and what is special."""
        extra = {"settled": "", "start": ", first 4 ms", "radial": f", {self.load_y:.0f} N radial"}[self.kind]
        where = "" if self.folder == GATES else "example "
        return f"{where}{self.scene} {self.rpm:,.0f} r/min{extra}"

    def quiet(self, **fidelity: str) -> Scene:
        """Scene without its sound, with other choices of ``fidelity``."""
        return silent(self.scene, self.folder, **fidelity)

    def arrays(self, scene: Scene, **parameters: float) -> Arrays:
        """Bearing of a scene at the case's speed and load."""
        inputs = {U.SPEED: self.rpm * RPM, U.LOAD_Y: self.load_y, U.LOAD_Z: 0.0}
        return Arrays.of(scene, **parameters).at(inputs)

    def bearing(self, **parameters: float) -> Arrays:
        """Initialised bearing, run for ``WARM_UP`` unless the start itself is looked at."""
        bearing = self.arrays(self.quiet(), **parameters)
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


def _example(scene: str, rpm: float) -> Case:
    """Example scene at its own speed; it has no goal of its own."""
    return Case(scene, rpm, (0.0, 0.0, 0.0), folder=EXAMPLES)


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
    _example("7003C-bare", 20000),
    _example("7003C-spindle", 20000),
    _example("7009C-full-ceramic", 18000),
)
QUICK = (Case("7003C-spindle", 20000, (3.0, 30.0, 250.0)),)


def silent(name: str, folder: pathlib.Path = GATES, **fidelity: str) -> Scene:
    """Gate scene, or that of another folder, without its sound and with rigid rings.

    ``fidelity``: other choices, not checked. The peers' rings are rigid, too.
    """
    scene = read_scene(folder / f"{name}.toml").with_rigid_rings()
    return scene.model_copy(update={"sound": None, "fidelity": scene.fidelity.model_copy(update=fidelity)})
