"""Which levels and methods this build of the engine has."""

from collections.abc import Iterable

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.scene import Scene
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.study.arrays import Arrays, Refused
from fmu_bearing.study.figures import COMMUNICATION, SAMPLE

Solver = tuple[str, str]  # level, method
DEFAULT: Solver = ("full", "esdirk4")


def carries(scene: Scene, solver: Solver) -> bool:
    """Whether a level and method carry what the scene models: bending needs level full, not by ``fast``."""
    level, method = solver
    return not scene.bends or (level == "full" and method != "fast")


def absent(scene: Scene, solvers: Iterable[Solver], settle: float = 0.02) -> dict[Solver, str]:
    """Return those of ``solvers`` that cannot be had for a scene, with the reason.

    The engine refuses what it lacks, or ignores the choice and gives the default method's very bits: each is
    run for ``settle`` (s) and 2 ms more.
    """
    plain = _rings(scene, DEFAULT, settle)
    found: dict[Solver, str] = {}
    for solver in dict.fromkeys(solvers):
        if solver == DEFAULT:
            continue
        if not carries(scene, solver):
            found[solver] = "knows rigid rings only"
            continue
        try:
            if np.array_equal(_rings(scene, solver, settle), plain):
                found[solver] = "not built: the default method ran in its place"
        except Refused as problem:
            found[solver] = f"refused: {problem}"
    return found


def _rings(scene: Scene, solver: Solver, settle: float) -> NDArray[np.float64]:
    bearing = Arrays.of(with_fidelity(scene, level=solver[0], method=solver[1]))
    bearing.init()
    bearing.run(settle, COMMUNICATION)
    return bearing.rings(2e-3, SAMPLE)
