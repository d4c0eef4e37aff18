"""Motor, ceramic spindle bearing and thermal network in one co-simulation.

Runs the spindle up, holds the speed, and writes under the output folder

* ``spindle.csv``, ``sound.csv``, ``preload.csv``, ``viscosity.csv`` - what was computed;
* ``spindle.png`` - speed, torque, temperatures, levels, spectrum;
* ``effects.png`` - contact angle, torque, film and level over preload and oil viscosity.

The FMUs come from ``build_fmu.py`` (bearing) and ``build.py`` in this folder (the other two).
"""

import math
import signal
import sys
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager
from pathlib import Path
from types import FrameType
from typing import Annotated

import figures
import numpy as np
import studies
import typer
from coupling import Fmu, Plan, Recording, SimulationError, run
from fmpy.util import write_csv
from numpy.typing import NDArray
from rich.box import SIMPLE
from rich.console import Console
from rich.progress import BarColumn, Progress, TextColumn, TimeElapsedColumn
from rich.table import Table

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.extras import MissingExtra, need
from fmu_bearing.results.levels import present

RPM = 30.0 / np.pi
BEARING, MOTOR, THERMAL = "Bearing7003C.fmu", "SpindleMotor.fmu", "SpindleThermal.fmu"

#: What the steady runs vary: axis label, factor from SI to the label's unit, multiples of the start value.
VARIED = {
    "preload": ("preload [N]", 1.0, (0.4, 0.7, 1.0, 1.5)),
    "lubricant.viscosity_ref": ("oil viscosity at 20 degC [mPa.s]", 1e3, (0.33, 1.0, 2.0, 3.0)),
}
CSV_NAMES = {"preload": "preload.csv", "lubricant.viscosity_ref": "viscosity.csv"}


class Interrupt:
    """Turns Ctrl-C into a flag, so that no FMU is left in the middle of a call and results are kept."""

    def __init__(self) -> None:
        self.asked = False

    @contextmanager
    def watching(self) -> Iterator[None]:
        """Take over Ctrl-C inside the block."""
        before = signal.signal(signal.SIGINT, self._ask)
        try:
            yield
        finally:
            signal.signal(signal.SIGINT, before)

    def _ask(self, _signal: int, _frame: FrameType | None) -> None:
        self.asked = True


class Watch:
    """Progress bars that also show how much time is simulated per second of waiting."""

    def __init__(self, console: Console, interrupt: Interrupt) -> None:
        self.interrupt = interrupt
        self.bars = Progress(
            TextColumn("{task.description:<13}"),
            BarColumn(),
            TextColumn("{task.completed:6.3f} of {task.total:.3f} s simulated"),
            TextColumn("{task.fields[ratio]:5.2f} simulated/wall"),
            TimeElapsedColumn(),
            console=console,
            refresh_per_second=4,
        )

    def task(self, name: str, total: float, adds: bool = False) -> Callable[[float], bool]:
        """Return a progress function: it takes the time reached, or a time to add; False is stop."""
        task = self.bars.add_task(name, total=total, ratio=0.0)
        begin = time.perf_counter()
        done = 0.0

        def report(seconds: float) -> bool:
            nonlocal done
            done = done + seconds if adds else seconds
            self.bars.update(task, completed=done, ratio=done / max(time.perf_counter() - begin, 1e-9))
            return not self.interrupt.asked

        return report


def main(
    fmu_dir: Annotated[Path, typer.Option(help="Folder with the three FMUs.")] = Path("out"),
    output_dir: Annotated[Path, typer.Option(help="Folder for tables and pictures.")] = Path("out"),
    end_time: Annotated[float, typer.Option(min=0.02, help="Simulated time in s.")] = 1.0,
    communication_step: Annotated[
        float, typer.Option(min=1e-4, max=1e-3, help="Time between exchanges in s, 0.0001 to 0.001.")
    ] = 5e-4,
    start_rpm: Annotated[float, typer.Option(min=0.0, max=40e3, help="Speed at the start in r/min.")] = 2e3,
    target_rpm: Annotated[float, typer.Option(min=0.0, max=40e3, help="Speed held, in r/min.")] = 2e4,
    short: Annotated[
        bool, typer.Option(help="The last 3000 r/min in a tenth of a second, for a first look.")
    ] = False,
) -> None:
    """Run the spindle up and hold its speed: motor, bearing and thermal FMU together."""
    console = Console()
    if short:
        end_time = min(end_time, 0.1)
        start_rpm = max(start_rpm, target_rpm - 3e3)  # the motor turns up the rotor by no more in that time
    plan = Plan(
        end_time=end_time,
        communication_step=communication_step,
        start_speed=start_rpm / RPM,
        target_speed=target_rpm / RPM,
        ramp_time=0.7 * end_time,
        metering_start=min(studies.METERING_START, 0.2 * end_time),
    )
    try:
        need("matplotlib", "the pictures")  # refused before the run
        output_dir.mkdir(parents=True, exist_ok=True)
        _demo(console, fmu_dir, output_dir, plan, short)
    except (MissingExtra, OSError, SimulationError) as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None


def _demo(console: Console, fmu_dir: Path, output_dir: Path, plan: Plan, short: bool) -> None:
    interrupt = Interrupt()
    watch = Watch(console, interrupt)
    with interrupt.watching(), watch.bars:
        with (
            Fmu(fmu_dir / MOTOR, "motor") as motor,
            Fmu(fmu_dir / BEARING, "bearing") as bearing,
            Fmu(fmu_dir / THERMAL, "thermal") as thermal,
        ):
            console.print(
                f"{plan.start_speed * RPM:.0f} to {plan.target_speed * RPM:.0f} r/min "
                f"in {plan.ramp_time:.4g} s, held to {plan.end_time:.4g} s; "
                f"exchange every {1e3 * plan.communication_step:.4g} ms",
                highlight=False,
            )
            labels = _labels(bearing)
            try:
                recording = run(motor, bearing, thermal, plan, watch.task("co-simulation", plan.end_time))
            except SimulationError as error:
                raise SimulationError(f"{error}{_keep(error.recording, output_dir)}") from error
            table = recording.table()
            write_csv(output_dir / "spindle.csv", table)
            marks = studies.frequencies(bearing, float(table[-1]["shaft_speed"]))
            nominal = {name: bearing.start(name) for name in bearing.having(VARIED)}
        point = studies.point_at_end(table)
        sound = None
        if labels and not interrupt.asked:
            duration = 0.02 if short else 0.2
            report = watch.task("spectrum", studies.SETTLE + duration)
            sound = studies.record_sound(fmu_dir / BEARING, point, duration, report).table()
            write_csv(output_dir / "sound.csv", sound)
        varied = _vary(watch, fmu_dir / BEARING, point, nominal, output_dir, short)
    _print(console, table, labels, marks, plan)
    figures.overview(output_dir / "spindle.png", table, labels, sound, studies.SAMPLE_RATE, marks)
    if varied:
        figures.effects(output_dir / "effects.png", varied, labels)
    if interrupt.asked:
        console.print(f"stopped by Ctrl-C; what was computed up to {table[-1]['time']:.4g} s is kept")
    console.print(f"tables and pictures are in {output_dir}", highlight=False)


def _keep(recording: Recording | None, output_dir: Path) -> str:
    """Write what a refused run had computed; say in words where it is."""
    if recording is None:
        return ""
    path = output_dir / "spindle.csv"
    table = recording.table()
    write_csv(path, table)
    return f"; what was computed up to {table[-1]['time']:.4g} s is in {path}"


def _vary(
    watch: Watch,
    bearing: Path,
    point: studies.Point,
    nominal: dict[str, float],
    output_dir: Path,
    short: bool,
) -> dict[str, tuple[str, float, NDArray[np.void]]]:
    """Steady runs over each of VARIED, written to CSV; none after Ctrl-C."""
    found = {}
    duration = 0.01 if short else 0.05
    for parameter, start in nominal.items():
        label, factor, multiples = VARIED[parameter]
        values = [start * multiple for multiple in (multiples[1:3] if short else multiples)]
        if watch.interrupt.asked:
            break
        report = watch.task(
            Path(CSV_NAMES[parameter]).stem, len(values) * (studies.SETTLE + duration), adds=True
        )
        rows = studies.vary(bearing, point, parameter, values, duration, report)
        if len(rows):
            write_csv(output_dir / CSV_NAMES[parameter], rows)
            found[parameter] = (label, factor, rows)
    return found


def _labels(bearing: Fmu) -> dict[str, str]:
    """Microphone prefix to a legend: a number and the place in mm."""
    labels = {}
    for number, prefix in enumerate(studies.microphones(bearing), 1):
        axes = bearing.having(f"{prefix}.position.{axis}" for axis in "xyz")
        place = ", ".join(f"{1e3 * bearing.start(name):.5g}" for name in axes)
        labels[prefix] = f"P{number} ({place}) mm" if place else f"P{number}"
    return labels


def _print(
    console: Console,
    run: NDArray[np.void],
    labels: dict[str, str],
    marks: KinematicFrequencies | None,
    plan: Plan,
) -> None:
    """Two tables: the operating point at the end, and the sound."""
    # Means over the last tenth: torque and heat fluctuate with every passing ball.
    tail = run[-max(1, len(run) // 10) :]
    last = run[-1]
    state = Table(title=f"Operating point at {last['time']:.4g} s", show_header=False)
    state.add_column()
    state.add_column(justify="right")

    def mean(name: str) -> float:
        return float(tail[name].mean())

    def row(text: str, name: str, factor: float, unit: str, digits: int = 2, offset: float = 0.0) -> None:
        if name in run.dtype.names:
            state.add_row(text, f"{mean(name) * factor + offset:.{digits}f} {unit}")

    row("speed", "shaft_speed", RPM, "r/min", 1)
    row("motor torque", "motor_torque", 1e3, "N.mm")
    row("friction torque of the bearing", "friction_torque", 1e3, "N.mm")
    row("electrical power of the motor", "electrical_power", 1.0, "W")
    for place in ("inner_ring", "outer_ring", "oil"):
        row(f"heat to the {place.replace('_', ' ')}", f"heat.{place}", 1.0, "W")
    for lump in figures.LUMPS:
        row(f"temperature, {lump.replace('_', ' ')}", f"{lump}_temperature", 1.0, "degC", 2, -273.15)
    for race in ("inner", "outer"):
        row(f"contact angle, {race} race", f"contact.{race}.angle_mean", 180.0 / np.pi, "deg")
        row(f"ball load, {race} race", f"contact.{race}.load_mean", 1.0, "N")
    row("smallest film parameter lambda", "film.lambda_min", 1.0, "")
    row("cage speed over shaft speed", "cage.speed_ratio", 1.0, "", 4)
    if marks is not None:
        for name, value in marks._asdict().items():
            state.add_row(f"{name} (kinematic)", f"{value:.1f} Hz")
    console.print(state)
    if labels:
        console.print(_sound_table(run, labels, plan))


def _sound_table(run: NDArray[np.void], labels: dict[str, str], plan: Plan) -> Table:
    last = run[-1]
    columns = {
        "SPL": "spl",
        "dB(A)": "spl_a",
        "inner": "spl_inner_ring",
        "outer": "spl_outer_ring",
        "cage": "spl_cage",
        "balls": "spl_balls",
    }
    shown = {
        title: name for title, name in columns.items() if f"{next(iter(labels))}.{name}" in run.dtype.names
    }
    sound = Table(
        title="Sound, dB: all and by component at the end (Fast), and Leq of the hold",
        box=SIMPLE,
        pad_edge=False,
    )
    sound.add_column("microphone, mm", no_wrap=True)
    for title in (*shown, "Leq", "Leq(A)"):
        sound.add_column(title, justify="right")
    for prefix, label in labels.items():
        levels = [last[f"{prefix}.{name}"] for name in shown.values()]
        levels += [studies.later_leq(run, f"{prefix}.{name}", plan) for name in ("leq", "leq_a")]
        texts = ("-" if math.isnan(level) else f"{level:.1f}" for level in present(levels, "dB"))
        sound.add_row(label.removesuffix(" mm"), *texts)
    return sound


if __name__ == "__main__":
    sys.exit(typer.run(main))
