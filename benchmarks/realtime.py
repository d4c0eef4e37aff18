"""Steps in a loop of 1 ms with motor and thermal partners. ``python -m benchmarks.realtime [FILE]``

Motor, bearing and thermal network as three FMUs, exchanged every millisecond as in
``examples/spindle_cosimulation``: a run-up from 1,500 to 6,500 r/min in 1 s, then the speed held, then the
radial load on the bearings jumps to and fro. Times are the bearing's alone: the processor's time of this
thread in ``fmi2DoStep``, which other work on the machine does not enter, though it slows caches. *Late* are
exchanges of all three that take longer on the clock than the millisecond that they simulate. *Worst over
mean* is taken within the phase: what a step may cost beside the usual one.
"""

import argparse
import sys
import tempfile
import time
from collections.abc import Iterator
from pathlib import Path

import numpy as np

from fmu_bearing import Scene, build_fmu, read_scene, with_fidelity
from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.results.base import table
from fmu_bearing.results.table import machine, markdown, write_csv
from fmu_bearing.run import step_times
from fmu_bearing.run.step_times import Timed

_EXAMPLES = Path(__file__).parents[1] / "examples"
sys.path.insert(0, str(_EXAMPLES / "spindle_cosimulation"))
from build import best_flavour, build  # noqa: E402
from coupling import Fmu, Plan, exchanger, initialise  # noqa: E402

COLUMNS = ("bearings", *step_times.COLUMNS)
_STEP = 1e-3  # s
_START, _TARGET = 1500.0, 6500.0  # r/min
_RUN_UP, _HELD, _JUMPS = 1000, 500, 200  # steps of each phase
_JUMP = 40.0  # N, every tenth step
_RPM = np.pi / 30.0


def scenes() -> dict[str, Scene]:
    """Return the single bearing in its spindle, and the example sets; all with four microphones."""
    single = read_scene(_EXAMPLES / "scenes" / "7003C-spindle.toml")
    sets = {name: _sounding(name, single) for name in ("DB", "QBC")}
    return {"single": single, **sets}


def _sounding(name: str, single: Scene) -> Scene:
    """Return the example set of that arrangement, the surfaces of the single bearing and microphones."""
    assert single.sound is not None
    given = read_scene(_EXAMPLES / "spindle_set" / f"7003C-{name}.toml").model_dump()
    around = [
        {"name": f"P{k + 1}", "x_mm": x, "y_mm": y, "z_mm": z}
        for k, (x, y, z) in enumerate(
            [(65.0, 105.0, 0.0), (65.0, 150.0, 0.0), (65.0, 0.0, 105.0), (-20.0, 60.0, 0.0)]
        )
    ]
    given["sound"] = {"radiation_model": "bem", "microphone": around}
    flaws = single.imperfections.model_dump(exclude={"unbalance_um"})
    given["imperfections"] = flaws
    given["spindle"]["shaft"]["unbalance"] = [{"position_mm": 65.0, "amount_g_mm": 0.2}]  # assumed
    return Scene.from_dict(given)


def phases(load: str, quick: bool) -> Iterator[tuple[str, dict[str, float]]]:
    """Name of the phase and the bearing's inputs of every step."""
    scale = 50 if quick else 1
    for _ in range(_RUN_UP // scale):
        yield "run-up", {}
    for _ in range(_HELD // scale):
        yield "held", {}
    for k in range(_JUMPS // scale):
        yield "jumps", {load: _JUMP if k // 10 % 2 == 0 else 0.0} if k % 10 == 0 else {}


def timed(scene: Scene, partners: dict[str, Path], folder: Path, quick: bool) -> Iterator[Timed]:
    """Run a scene with its partners; the bearing's time of the processor, that of all three on the clock."""
    path = Path(build_fmu(scene, folder / f"{scene.name}.fmu", only_here=True).path)
    plan = Plan(start_speed=_START * _RPM, target_speed=_TARGET * _RPM, ramp_time=_RUN_UP * _STEP)
    found: dict[str, list[tuple[float, float]]] = {}
    with (
        Fmu(partners["motor"], "motor") as motor,
        Fmu(path, "bearing") as bearing,
        Fmu(partners["thermal"], "thermal") as thermal,
    ):
        initialise(motor, bearing, thermal, plan)
        exchange, step = exchanger(motor, bearing, thermal), bearing.step
        spent = 0.0

        def of_thread(now: float, h: float) -> None:
            nonlocal spent
            begin = time.thread_time()
            step(now, h)
            spent = time.thread_time() - begin

        bearing.step = of_thread  # type: ignore[method-assign]
        load = bearing.having(["radial_load.y", "nose.force.y"])[0]
        for k, (phase, inputs) in enumerate(phases(load, quick)):
            begin = time.perf_counter()
            bearing.set(inputs)
            exchange(k * _STEP, (k + 1) * _STEP)
            found.setdefault(phase, []).append((spent, time.perf_counter() - begin))
    microphones = 0 if scene.sound is None else len(scene.sound.points())
    for phase, times in found.items():
        yield Timed(scene.fidelity.model, microphones, phase, *np.array(times).T, _STEP)


def rows(quick: bool = False) -> list[list[str]]:
    """Return the rows of the table; ``quick``: a fiftieth of the steps, of the single bearing alone."""
    found = []
    with tempfile.TemporaryDirectory() as name:
        folder, flavour = Path(name), best_flavour()
        for words, scene in scenes().items():
            bearings = len(scene.bearings())
            if quick and bearings > 1:
                break
            spindle = _EXAMPLES / "spindle_cosimulation"
            partners = {
                "motor": build(spindle / "motor.py", folder, flavour),
                "thermal": build(spindle / "thermal.py", folder, flavour, bearings=bearings),
            }
            for fidelity in FIDELITIES:
                for sounding in (False, True):
                    of = with_fidelity(scene, model=fidelity)
                    of = of if sounding else of.model_copy(update={"sound": None})
                    found += [[words, *row] for row in table(Timed, [*timed(of, partners, folder, quick)])[1]]
    return found


def main() -> None:
    """Print the table; write it to a file where one is named."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", nargs="?", type=Path, help="where to write the table, .md and .csv")
    parser.add_argument(
        "--quick", action="store_true", help="a fiftieth of the steps, the single bearing alone"
    )
    given = parser.parse_args()
    found = rows(given.quick)
    text = markdown(COLUMNS, found)
    print(text)
    if given.file is not None:
        head = (
            f"# Steps in real time\n\n{machine()}\n\nMade by `python -m benchmarks.realtime`: communication "
            f"steps of {1e3 * _STEP:g} ms with motor and thermal network,\n{_START:,.0f} to {_TARGET:,.0f} "
            f"r/min in {_RUN_UP * _STEP:g} s, then held, then jumps of {_JUMP:g} N across every 10 ms.\n\n"
        )
        given.file.with_suffix(".md").write_text(head + text, encoding="utf-8")
        write_csv(given.file.with_suffix(".csv"), COLUMNS, found)


if __name__ == "__main__":
    main()
