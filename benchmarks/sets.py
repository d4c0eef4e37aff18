"""Sets of bearings: what a set of K costs beside K single bearings. ``python -m benchmarks.sets [FILE]``.

One table: the single bearing on a rotor, and sets of the same bearings at the same speed and tolerance, at
fidelity full without sound, all in one run in turns; times are those of the fastest round. *Over one* is the
speed times the number of bearings over that of the single one: the median of the rounds' own ratios, and
between which their middle half lies. *Per bearing and iteration* is the time of an iteration of
Newton's method over the number of bearings, with all else that a step costs, Jacobians too; of these the mean
over the bearings is counted, because each has its own when it needs one. Errors are rms
differences of ring velocities over 5 ms from a run with a tolerance of 1e-6, over the rms of their
fluctuation.
"""

import argparse
import pathlib
import time
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft import shaft_model
from fmu_bearing.engine.layout import S
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.lengths import parts_of
from fmu_bearing.prepare.model import Model, prepare
from fmu_bearing.results.table import machine, markdown, number, write_csv
from fmu_bearing.scene import Scene, read_scene
from fmu_bearing.scene.mounting import Mounting, Rotor

_EXAMPLES = pathlib.Path(__file__).parents[1] / "examples" / "spindle_set"
_RPM = 20e3
_STEP = 1e-4  # s: communication step
_SETTLED, _TIMED, _COMPARED = 200, 100, 50  # communication steps
_ROUNDS = 41
_FINE = 1e-6
_PEDESTAL = 1e8  # N/m
_LENGTH, _DIAMETER = 90.0, 19.0  # mm: of the shaft of one bearing, 0.2 kg of steel
COLUMNS = (
    "case", "bearings", "coordinates", "sim/CPU", "times K", "over one", "middle half", "steps", "iterations",
    "Jacobians", "us per bearing and iteration", "error",
)  # fmt: skip


@dataclass
class Timed:
    """A case, the CPU time (s) of its rounds, and what its timed steps took."""

    name: str
    model: Model
    bearings: int
    coordinates: int
    rounds: list[float] = field(default_factory=list)
    steps: float = 0.0
    iterations: float = 0.0
    jacobians: float = 0.0

    @property
    def cpu(self) -> float:
        """CPU time of the fastest round, s."""
        return min(self.rounds)


def one_of(scene: Scene) -> Scene:
    """Return a single bearing of a set, equally preloaded, on a rotor as heavy as its share of a shaft."""
    mounting = Mounting(
        preload_N=scene.spindle.preload.preload_N,
        pedestal_stiffness_N_m=_PEDESTAL,
        rotor=Rotor(mass_kg=0.2, length_mm=_LENGTH, diameter_mm=_DIAMETER),
    )
    return scene.model_copy(update={"spindle": None, "mounting": mounting})


def set_of_one(scene: Scene) -> Scene:
    """Return the bearing of `one_of` alone on a shaft of the rotor's size, in the middle, as a set."""
    assert scene.spindle is not None
    data = scene.model_dump()
    data["spindle"] = {
        "shaft": {"sections_mm": [[_LENGTH, _DIAMETER, 0.0]]},
        "bearing": [{"position_mm": 0.5 * _LENGTH, "carries": "+x", "seat": "pedestal"}],
        "housing": {"pedestal_stiffness_N_m": _PEDESTAL},
        "load": {"force_x_N": scene.spindle.preload.preload_N, "position_mm": 0.5 * _LENGTH},
    }
    return Scene.from_dict(data)


def cases() -> list[tuple[str, Scene]]:
    """Return names and scenes: the single bearing first."""
    pair, quad = (read_scene(_EXAMPLES / f"7003C-{name}.toml") for name in ("DB", "QBC"))
    flaws = quad.imperfections
    speed = {"operation.speed_rpm": _RPM}
    pair = pair.model_copy(update={"imperfections": flaws}).replace(speed)
    quad = quad.replace(speed)
    return [
        ("single 7003C on a rotor", one_of(quad)),
        ("set of one, rigid shaft", set_of_one(quad)),
        ("DB, rigid shaft", pair.replace({"spindle.shaft.flexible": False})),
        ("DB, flexible shaft", pair.replace({"spindle.shaft.flexible": True})),
        ("QBC, rigid shaft", quad.replace({"spindle.shaft.flexible": False})),
        ("QBC, flexible shaft", quad.replace({"spindle.shaft.flexible": True})),
    ]


def started(model: Model, fine: bool = False) -> Instance:
    """Return an instance that has settled."""
    found = Instance(model, tell=lambda text: None)
    if fine:
        found.set("tolerance", _FINE)
    found.initialise()
    return found


def velocities(one: Instance) -> NDArray[np.float64]:
    """Velocities of all inner rings after each communication step."""
    names = [name for name in one.by_name if "inner_ring.velocity." in name]
    rows = []
    for _ in range(_COMPARED):
        one.step(_STEP)
        rows.append([one.get(name) for name in names])
    return np.array(rows)


def error(model: Model) -> float:
    """Error of the model's own tolerance over the first milliseconds."""
    exact, own = velocities(started(model, fine=True)), velocities(started(model))
    return float(np.linalg.norm(own - exact) / np.linalg.norm(exact - exact.mean(axis=0)))


def jacobians(one: Instance) -> float:
    """Jacobians made so far, the mean over the bearings."""
    return float(np.mean([one.s[part][S.JACOBIANS] for _, part in parts_of(one.p)]))


def once(case: Timed) -> None:
    """Time one round of a case."""
    one = started(case.model)
    for _ in range(_SETTLED):
        one.step(_STEP)
    counts, made = one.s[[S.STEPS, S.NEWTON]], jacobians(one)
    begin = time.thread_time()
    for _ in range(_TIMED):
        one.step(_STEP)
    case.rounds.append(time.thread_time() - begin)
    case.steps, case.iterations = one.s[[S.STEPS, S.NEWTON]] - counts
    case.jacobians = jacobians(one) - made


def measured() -> list[Timed]:
    """Return all cases, timed in turns."""
    found = []
    for name, scene in cases():
        model = prepare(scene)
        count = 1 if scene.spindle is None else len(scene.spindle.bearing)
        found.append(Timed(name, model, count, coordinates(scene)))
    for _ in range(_ROUNDS):
        for case in found:
            once(case)
    return found


def coordinates(scene: Scene) -> int:
    """Coordinates of the shaft; 0 for a single bearing."""
    return 0 if scene.spindle is None else shaft_model(scene, scene.spindle).count


def table(found: list[Timed]) -> list[list[str]]:
    """Return the rows of the table."""
    rows, first = [], found[0]
    simulated = _TIMED * _STEP
    for case in found:
        over = case.bearings * np.array(first.rounds) / np.array(case.rounds)
        low, high = np.quantile(over, (0.25, 0.75))
        each = case.cpu / case.iterations / case.bearings
        rows.append(
            [
                case.name, str(case.bearings), str(case.coordinates), number(simulated / case.cpu),
                number(case.bearings * simulated / case.cpu), f"{np.median(over):.2f}",
                f"{low:.2f} to {high:.2f}", f"{case.steps:.0f}", f"{case.iterations:.0f}",
                f"{case.jacobians:.0f}", f"{1e6 * each:.2f}", f"{error(case.model):.1e}",
            ]
        )  # fmt: skip
    return rows


def main() -> None:
    """Print the table; write it to a file where one is named."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", nargs="?", type=pathlib.Path, help="where to write the table, .md and .csv")
    given = parser.parse_args()
    rows = table(measured())
    text = markdown(COLUMNS, rows)
    print(text)
    if given.file is not None:
        head = (
            f"# Sets of bearings\n\n{machine()}\n\nMade by `python -m benchmarks.sets`: fidelity full "
            f"without sound, {_RPM:,.0f} r/min, communication steps of 0.1 ms,\n"
            f"{1e3 * _TIMED * _STEP:g} ms after {1e3 * _SETTLED * _STEP:g} ms, {_ROUNDS} rounds "
            "in turns.\n\n"
        )
        given.file.with_suffix(".md").write_text(head + text + "\n", encoding="utf-8")
        write_csv(given.file.with_suffix(".csv"), COLUMNS, rows)


if __name__ == "__main__":
    main()
