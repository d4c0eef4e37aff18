"""Cost of each term: one right-hand side, and the run, with the term and without it."""

import time

import numpy as np

from benchmarks.cases import silent
from fmu_bearing.arrays import Arrays, EngineError
from fmu_bearing.compiled import call, ready
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import C, F, P, S, U, Y
from fmu_bearing.run.paces import speed

COLUMNS = ("scene", "variant", "right-hand side, us", "of all terms", "sim/CPU", "times all terms")
#: Switches of ``p``; one that a scene does not have on is left out of the table.
SWITCHES = {
    "without gravity": "GRAVITY",
    "without drag": "DRAG",
    "without rolling resistance": "ROLLING",
    "without its reduction factors": "REDUCTION",
    "without land film": "LAND_VISCOSITY",
    "without gyroscopic moments": "GYROSCOPIC",
    "without waviness": "WAVINESS",
    "without waviness of the balls": "BALL_WAVES",
    "without cage": "CAGE",
}


def evaluation(bearing: Arrays, times: int = 4000) -> float:
    """CPU seconds of one right-hand side."""
    s = bearing.s
    y, c, f = s[S.Y : S.Y + Y.SIZE].copy(), s[S.C : S.C + C.SIZE], np.zeros(F.SIZE)
    ready("study")  # before the clock
    clock = time.process_time()
    call("repeat", bearing.p, c, y, bearing.w, f, s[S.ANGLE], s[S.SPEED], times)
    return (time.process_time() - clock) / times


def variants(name: str):
    """Yield name, scene and changed parameters of everything that can be left out."""
    scene = silent(name)
    base = Arrays.of(scene).p
    yield "all terms, 5 strips", scene, {}
    for words, place in SWITCHES.items():
        if base[getattr(P, place)] != 0.0:
            yield words, scene, {place: 0.0}
    for strips in (3, 1):
        fidelity = scene.fidelity.model_copy(update={"traction_strips": strips})
        yield (
            f"{strips} strips" if strips > 1 else "1 strip",
            scene.model_copy(update={"fidelity": fidelity}),
            {},
        )
    fewest = scene.fidelity.model_copy(update={"traction_strips": 1})
    off = {place: 0.0 for place in SWITCHES.values() if base[getattr(P, place)] != 0.0}
    yield "nothing but contacts, 1 strip", scene.model_copy(update={"fidelity": fewest}), off


def rows(name: str, rpm: float, budget: float, repeats: int) -> list[list[str]]:
    """One row per variant of a scene, fidelity ``full`` by the default method.

    The variants take turns, so that what else the machine does falls on all of them.
    """
    bearings: dict[str, Arrays] = {}
    refused: dict[str, str] = {}
    for words, scene, changed in variants(name):
        bearing = Arrays.of(scene, **changed).at({U.SPEED: rpm * RPM})
        try:
            bearing.init()
            bearing.run(0.02, 1e-3)
            bearings[words] = bearing
        except EngineError as problem:
            refused[words] = str(problem)
    cost = dict.fromkeys(bearings, float("inf"))
    fast = dict.fromkeys(bearings, 0.0)
    for _ in range(repeats):
        for words, bearing in bearings.items():
            cost[words] = min(cost[words], evaluation(bearing))
            fast[words] = max(fast[words], speed(bearing, budget, 1, 1.0)[1])
    whole = next(iter(bearings))
    case = f"{name} {rpm:,.0f} r/min"
    found = [
        [case, words, f"{1e6 * cost[words]:.2f}", f"{cost[words] / cost[whole]:.0%}", f"{fast[words]:.3g}",
         f"{fast[words] / fast[whole]:.2f}"]
        for words in bearings
    ]  # fmt: skip
    return found + [[case, words, "", "", "", why] for words, why in refused.items()]
