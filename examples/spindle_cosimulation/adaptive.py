"""Co-simulation of motor, bearing and thermal network with a communication step that follows the error.

``python adaptive.py [--quick]`` runs the spindle up from 2,000 to 20,000 r/min in 40 ms and holds it, at
fixed communication steps and at adaptive ones, and writes ``adaptive.md``, ``adaptive.csv`` and
``adaptive.png``.

Before each step the state of all three FMUs is kept. After the step the values held over it are compared with
the new ones. A change of torque from T to T' causes an error of speed of h |T' - T| / (2 J); for temperatures
the change itself is the error. Where either exceeds its tolerance, all three FMUs go back and take a shorter
step. Where both are far below, the next step is longer. No step is computed twice unless it is refused.

The shaft here is light, without the motor's rotor: 8.4e-6 kg m2, so that its speed feels the torque.

Result, without imperfections: within 0.03 rad/s a step, 100 steps of 0.1 to 4.1 ms and 17 refused ones come
to within 0.41 rad/s of a reference at 20 us; 150 fixed ones of 1 ms to 0.48. Within 0.1 rad/s a step, 75
steps come to 0.58 and as many fixed ones of 2 ms to 0.70. With the scene's imperfections the torque
fluctuates by a tenth with the balls and adaptive steps follow the ripple: 538 steps for 0.42 rad/s, where 300
fixed ones reach 0.34. There, choose a fixed step by the table. With the scene's own rotor, 20 times the
inertia and 0.7 s of run-up, fixed steps of 5 ms are within 0.02 rad/s: there is no error to follow.
"""

import tempfile
import time as clock
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer
from build import MODELS, best_flavour, build
from coupling import TEMPERATURES, Fmu, Plan, SimulationError, exchanger, initialise
from numpy.typing import NDArray

from fmu_bearing import build_fmu, read_scene
from fmu_bearing.cli.base import refusals
from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import empty, save
from fmu_bearing.results.series import structured
from fmu_bearing.results.table import markdown, number, write_csv
from fmu_bearing.scene import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "examples" / "scenes" / "7003C-spindle.toml"
LIGHT = {"mass_kg": 0.25, "length_mm": 180.0, "diameter_mm": 15.0}  # a shaft without the motor's rotor
RPM = 30.0 / np.pi
RUN_UP, END = 0.04, 0.15  # s
FINE = 2e-5  # s: the reference; the controller in the motor samples five times as slowly
FIXED = (1e-4, 2e-4, 5e-4, 1e-3, 2e-3)  # s
SPEEDS = (0.03, 0.1, 0.3)  # rad/s: tolerances of the speed
TEMPERATURE = 0.2  # K: changes the heat by 0.1 %
SHORTEST, LONGEST = 2e-5, 5e-3  # s
KEPT = ("time", "step", "shaft_speed", "friction_torque", "oil_temperature")


@dataclass(frozen=True)
class Outcome:
    """One run: its table (``KEPT``), how many steps were refused, how long it took (s)."""

    name: str
    table: NDArray[np.void]
    refused: NDArray[np.float64]
    wall: float


class Exchange:
    """The three FMUs, advanced together, with a way back."""

    def __init__(self, folder: Path, plan: Plan, imperfections: float) -> None:
        self.motor = Fmu(folder / "SpindleMotor.fmu", "motor")
        self.bearing = Fmu(folder / "Bearing7003C.fmu", "bearing")
        self.thermal = Fmu(folder / "SpindleThermal.fmu", "thermal")
        self.fmus = (self.motor, self.bearing, self.thermal)
        self.bearing.set({name: imperfections for name in self.bearing.having(["imperfection.scale"])})
        initialise(*self.fmus, plan)
        self._exchange = exchanger(*self.fmus)
        self.inertia = self.bearing.get(["rotor.inertia"])[0]

    def free(self) -> None:
        """Free all."""
        for fmu in self.fmus:
            fmu.__exit__()

    def values(self) -> list[float]:
        """Speed, torque and temperatures."""
        speed, torque = self.motor.get(["shaft_speed"]), self.bearing.get(["friction_torque"])
        return [*speed, *torque, *self.thermal.get(TEMPERATURES)]

    def step(self, now: float, h: float, judge: Callable[[list[float], list[float]], float]) -> float:
        """Advance by ``h``; go back if ``judge`` of the values before and after is above 1; return it."""
        before, states = self.values(), [fmu.keep() for fmu in self.fmus]
        try:
            try:
                self._exchange(now, now + h)
                error = judge(before, self.values())
            except SimulationError:
                error = np.inf  # an FMU refuses so long a step
            if error > 1.0:
                for fmu, state in zip(self.fmus, states, strict=True):
                    fmu.put_back(state)
            return error
        finally:
            for fmu, state in zip(self.fmus, states, strict=True):
                fmu.forget(state)


def with_shaft(scene: Scene, shaft: dict[str, float]) -> Scene:
    """Return the scene with other values of ``[mounting.rotor]``."""
    return scene.replace({f"mounting.rotor.{key}": value for key, value in shaft.items()})


def run(folder: Path, plan: Plan, tolerance: float | None = None, imperfections: float = 0.0) -> Outcome:
    """Run at ``plan.communication_step``, or adaptively within a tolerance of the speed (rad/s)."""
    begin = clock.perf_counter()
    together = Exchange(folder, plan, imperfections)
    try:
        rows, refused = _march(together, plan, tolerance)
    finally:
        together.free()
    name = (
        f"fixed, {1e3 * plan.communication_step:g} ms"
        if tolerance is None
        else f"adaptive, {tolerance:g} rad/s"
    )
    columns = dict(zip(KEPT, np.array(rows).T, strict=True))
    return Outcome(name, structured(columns), np.array(refused), clock.perf_counter() - begin)


def _march(together: Exchange, plan: Plan, tolerance: float | None) -> tuple[list[list[float]], list[float]]:
    now, h, rows, refused = 0.0, plan.communication_step, [[0.0, 0.0, *together.values()[:3]]], []

    def judge(before: list[float], after: list[float]) -> float:
        if tolerance is None or h <= SHORTEST:
            return 0.0
        speed = 0.5 * h * abs(after[1] - before[1]) / together.inertia
        change = max(abs(b - a) for a, b in zip(before[2:], after[2:], strict=True))
        return max(speed / tolerance, change / TEMPERATURE)

    while plan.end_time - now > 1e-9:
        h = min(h, plan.end_time - now)
        error = together.step(now, h, judge)
        # held values make errors of second order in the step
        factor = 1.0 if tolerance is None else float(np.clip(0.8 / np.sqrt(max(error, 1e-12)), 0.2, 2.0))
        if error <= 1.0:
            factor = min(factor, 1.0) if refused and refused[-1] == now else factor
            now += h
            rows.append([now, h, *together.values()[:3]])
        else:
            refused.append(now)
        h = (
            float(np.clip(h * factor, SHORTEST, LONGEST))
            if tolerance is not None
            else plan.communication_step
        )
    return rows, refused


def errors(outcome: Outcome, reference: Outcome) -> tuple[float, float]:
    """Largest departures of speed (rad/s) and oil temperature (K) from a reference, at a run's own points."""
    found = []
    for name in ("shaft_speed", "oil_temperature"):
        there = np.interp(outcome.table["time"], reference.table["time"], reference.table[name])
        found.append(float(np.max(np.abs(outcome.table[name] - there))))
    return found[0], found[1]


COLUMNS = (
    "steps",
    "accepted",
    "refused",
    "shortest, ms",
    "longest, ms",
    "speed off, rad/s",
    "oil off, K",
    "wall, s",
)


def cells(outcomes: list[Outcome], reference: Outcome) -> list[list[str]]:
    """Rows of the table, without the reference."""
    rows = []
    for one in outcomes:
        lengths = 1e3 * one.table["step"][1:-1]  # the last one is what is left
        speed, oil = errors(one, reference)
        rows.append([
            one.name, str(len(one.table) - 1), str(len(one.refused)), number(lengths.min()),
            number(lengths.max()), number(speed), number(oil), number(one.wall),
        ])  # fmt: skip
    return rows


def draw(outcomes: list[Outcome], reference: Outcome) -> "Figure":
    """Speed, lengths of the steps, and errors over time."""
    figure = empty((9.0, 8.0))
    top, middle, bottom = figure.subplots(3, 1, sharex=True)
    top.plot(1e3 * reference.table["time"], RPM * reference.table["shaft_speed"], color="black")
    top.set_ylabel("speed, r/min")
    shown = [one for one in outcomes if one.name.startswith("adaptive") or one.name == "fixed, 1 ms"]
    for one, colour in zip(shown, ("0.5", "#0072B2", "#D55E00", "#009E73"), strict=False):
        time = 1e3 * one.table["time"][1:]
        middle.step(
            time, 1e3 * one.table["step"][1:], where="pre", color=colour, label=one.name, linewidth=1.0
        )
        middle.plot(1e3 * one.refused, np.full(len(one.refused), 1e3 * SHORTEST), "|", color=colour)
        there = np.interp(one.table["time"], reference.table["time"], reference.table["shaft_speed"])
        off = np.abs(one.table["shaft_speed"] - there)[1:]
        bottom.plot(time, np.maximum(off, 1e-5), color=colour, label=one.name, linewidth=0.8)
    middle.set(yscale="log", ylabel="communication step, ms\n(marks: refused)")
    bottom.set(yscale="log", ylabel="speed beside the reference, rad/s", xlabel="time, ms")
    middle.legend(fontsize=8, loc="upper right")
    return figure


def main(
    quick: Annotated[bool, typer.Option("--quick", help="A shorter run with fewer variants.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for table and picture.")] = Path("out/adaptive"),
) -> None:
    """Compare adaptive communication steps with fixed ones."""
    with refusals():  # before minutes of computing
        need("matplotlib", "the picture")
    scene = with_shaft(read_scene(SCENE).replace({"sound": None}), LIGHT)
    end, fixed, tolerances = (0.06, FIXED[3:4], SPEEDS[::2]) if quick else (END, FIXED, SPEEDS)
    with tempfile.TemporaryDirectory() as place:
        folder = Path(place)
        for model in MODELS:
            build(Path(__file__).with_name(f"{model}.py"), folder, best_flavour())
        build_fmu(scene, folder / "Bearing7003C.fmu")

        def plan(step: float) -> Plan:
            return Plan(end_time=end, communication_step=step, ramp_time=RUN_UP)

        reference = run(folder, plan(FINE))
        outcomes = [run(folder, plan(step)) for step in fixed]
        outcomes += [run(folder, plan(1e-4), tolerance) for tolerance in tolerances]
    rows = cells(outcomes, reference)
    output.mkdir(parents=True, exist_ok=True)
    table = markdown(COLUMNS, rows)
    title = f"Communication steps, fixed and adaptive; the reference has {1e6 * FINE:g} us"
    (output / "adaptive.md").write_text(f"# {title}\n\n{table}", encoding="utf-8")
    write_csv(output / "adaptive.csv", COLUMNS, rows)
    save(draw(outcomes, reference), output / "adaptive.png")
    typer.echo(table)


if __name__ == "__main__":
    typer.run(main)
