"""Motor, motor spindle on four bearings (QBC) and thermal network as three FMUs, from rest until warm.

``python cosimulate.py [--short]`` builds the FMUs of 7003C-QBC.toml and of
``examples/spindle_cosimulation`` (motor as it is, thermal network with four bearings), runs the spindle up to
20,000 r/min in 0.7 s, holds the speed, and writes ``spindle.csv``, ``preload.csv`` and ``spindle_set.png``.
``--short``: a quick run-up and a minute of warmth.

The motor takes a second, warmth a quarter of an hour. To 1 s all three share one time; then the thermal
network runs ahead, by 500 s per second of motor and bearings (``Plan.true_until``, ``Plan.thermal_rate``):
what turns is settled within milliseconds, so heat and forces follow the temperatures as if these took their
time. Rows have the time of motor and bearings; ``thermal_time`` is the time of the temperatures.

Result: after 900 s the shaft has 31 degC, the inner rings 32, the outer 24 and the housing 23. The pairs
are further apart than the neutral spacing, so the spacers' preload falls from 117 N to 49 N; axial loads of
the run agree with statics at its temperatures within 1.5 N. With the rear pair 26 mm behind the front one
it would grow to 152 N; springs keep their 120 N.
"""

from pathlib import Path
from sys import path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer
from fmpy.util import write_csv
from numpy.typing import NDArray

from fmu_bearing import Scene, build_fmu, read_scene, statics
from fmu_bearing.cli.base import refusals
from fmu_bearing.compiled import BuildError
from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import empty

if TYPE_CHECKING:
    from matplotlib.axes import Axes

HERE = Path(__file__).resolve().parent
path.insert(0, str(HERE.parent / "spindle_cosimulation"))
from build import best_flavour, build  # noqa: E402
from coupling import Fmu, Plan, SimulationError, run  # noqa: E402

SCENE = HERE / "7003C-QBC.toml"
RPM = np.pi / 30.0
ZERO_CELSIUS = 273.15  # K
TOTALS = ("friction_torque", "friction_torque_mean", "heat.inner_ring", "heat.outer_ring", "heat.oil")
#: Network times (s) at which statics are compared; the last is the run's end.
CHECKED = (0.7, 1.0, 3.0, 10.0, 30.0, 60.0, 120.0, 240.0, 480.0, np.inf)
MEAN = 0.02  # s of the run about such a time: forces of waves and of the heavy spot average out
LONG = Plan(end_time=2.8, communication_step=1e-3, start_speed=0.0, true_until=1.0, thermal_rate=500.0)
SHORT = Plan(
    end_time=0.6, communication_step=1e-3, start_speed=0.0, ramp_time=0.35, true_until=0.4, thermal_rate=300.0
)


def build_all(scene: Scene, folder: Path) -> dict[str, Path]:
    """Build the three FMUs into a folder; return their paths by name."""
    flavour, spindle = best_flavour(), HERE.parent / "spindle_cosimulation"
    folder.mkdir(parents=True, exist_ok=True)
    bearings = len(bearing_prefixes(scene))
    return {
        "motor": build(spindle / "motor.py", folder, flavour),
        "bearing": Path(build_fmu(scene, folder / f"{scene.name}.fmu").path),
        "thermal": build(spindle / "thermal.py", folder, flavour, bearings=bearings),
    }


def bearing_prefixes(scene: Scene) -> list[str]:
    """``bearing[1].`` and so on, from the nose."""
    assert scene.spindle is not None
    return [f"bearing[{number}]." for number, _ in enumerate(scene.spindle.bearing, 1)]


def cosimulate(scene: Scene, folder: Path, plan: Plan) -> tuple[NDArray[np.void], dict[str, float]]:
    """Build and run the three FMUs.

    Returns
    -------
    table : structured array
        One row per communication point: time and thermal_time (s), outputs of motor, thermal network and
        spindle, SI.
    constants : dict
        ``rotor.inertia`` (kg m2) and the thermal network's energies at the end (J).
    """
    fmus = build_all(scene, folder)
    each = ("force.x", "force.y", "force.z", "heat.inner_ring", "heat.outer_ring", "heat.oil")
    recorded = [*TOTALS, *(prefix + name for prefix in bearing_prefixes(scene) for name in each)]
    with (
        Fmu(fmus["motor"], "motor") as motor,
        Fmu(fmus["bearing"], "spindle") as bearing,
        Fmu(fmus["thermal"], "thermal") as thermal,
    ):
        recording = run(motor, bearing, thermal, plan, recorded=recorded)
        energies = ("energy.supplied", "energy.stored", "energy.given_off")
        constants = dict(zip(energies, thermal.get(energies), strict=True))
        constants["rotor.inertia"] = bearing.get(["rotor.inertia"])[0]
    recording.names.insert(1, "thermal_time")
    for row in recording.rows:
        row.insert(1, plan.thermal_time(row[0]))
    return recording.table(), constants


def warm_scene(scene: Scene, row: np.void) -> Scene:
    """Return the scene at the speed and temperatures of a row."""
    keys: dict[str, float] = {
        "operation.speed_rpm": float(row["shaft_speed"]) / RPM,
        "spindle.shaft.temperature_degC": float(row["shaft_temperature"]) - ZERO_CELSIUS,
        "spindle.housing.temperature_degC": float(row["housing_temperature"]) - ZERO_CELSIUS,
    }
    for number, prefix in enumerate(bearing_prefixes(scene), 1):
        for ring in ("inner_ring", "outer_ring"):
            key = f"spindle.bearing[{number}].{ring}_temperature_degC"
            keys[key] = float(row[f"{prefix}{ring}_temperature"]) - ZERO_CELSIUS
    return scene.replace(keys)


def on_springs(scene: Scene) -> Scene:
    """Return the set with springs behind its rear bearings, as strong as the preload of the spacers."""
    assert scene.spindle is not None
    cold = scene.spindle.preload.preload_N
    rear = {
        f"spindle.bearing[{number}].seat": "sliding"
        for number, bearing in enumerate(scene.spindle.bearing, 1)
        if bearing.carries == "-x"
    }
    return scene.replace({"spindle.preload": {"kind": "spring", "force_N": cold}, **rear})


def closer(scene: Scene) -> Scene:
    """Return the set with its rear pair moved ahead: 26 mm between the pairs in place of 116."""
    return scene.replace({"spindle.bearing[3].position_mm": 62.0, "spindle.bearing[4].position_mm": 73.0})


def compare(scene: Scene, table: NDArray[np.void]) -> list[dict[str, float]]:
    """Return axial loads (N) of run and statics at its temperatures, and preloads of other sets at these."""
    rows = []
    asked = [at for at in CHECKED if at < table["thermal_time"][-1]]
    for at in [*asked, float(table["thermal_time"][-1])]:
        last = int(np.searchsorted(table["thermal_time"], at, side="right")) - 1
        about = table[(table["time"] > table["time"][last] - MEAN) & (table["time"] <= table["time"][last])]
        there = warm_scene(scene, about[len(about) // 2])
        spacers = statics(there)
        sets = {"spacers": spacers, "springs": statics(on_springs(there))}
        sets["closer"] = statics(closer(there))
        row = {"thermal_time_s": float(table["thermal_time"][last])}
        row |= {f"{name}_N": float(np.mean(found.preloads["running"])) for name, found in sets.items()}
        for prefix, static in zip(bearing_prefixes(scene), spacers.table(), strict=True):
            number = int(static["bearing"])
            row[f"run_{number}_N"] = float(np.abs(about[f"{prefix}force.x"].mean()))
            row[f"statics_{number}_N"] = float(static["axial_N"])
        rows.append(row)
    return rows


def draw(table: NDArray[np.void], rows: list[dict[str, float]], scene: Scene, plan: Plan, to: Path) -> None:
    """Four plots: run-up; temperatures; axial load per bearing with statics; preloads of three sets."""
    figure = empty((10.0, 7.0))
    axes = figure.subplots(2, 2)
    _run_up(axes[0, 0], table, plan)
    _temperatures(axes[0, 1], table, scene)
    at = [row["thermal_time_s"] for row in rows]
    width = max(1, round(MEAN / plan.communication_step))
    for number, prefix in enumerate(bearing_prefixes(scene), 1):
        color = f"C{number - 1}"
        mean = np.convolve(np.abs(table[f"{prefix}force.x"]), np.ones(width) / width, "valid")
        axes[1, 0].plot(table["thermal_time"][width - 1 :], mean, color=color, label=f"bearing {number}")
        axes[1, 0].plot(at, [row[f"statics_{number}_N"] for row in rows], "o", color=color, markersize=4)
    axes[1, 0].set_ylabel("axial load [N]; dots: statics")
    sets = {
        "spacers": "spacers, as run",
        "springs": "springs",
        "closer": "spacers, rear pair at 62 and 73 mm",
    }
    for (name, text), mark in zip(sets.items(), "os^", strict=True):
        axes[1, 1].plot(at, [row[f"{name}_N"] for row in rows], f"{mark}-", label=text)
    axes[1, 1].set_ylabel("mean preload without load [N]")
    axes[1, 1].set_ylim(bottom=0.0)
    for axis in axes.flat[1:]:
        axis.set_xscale("log")
        axis.set_xlim(0.1, table["thermal_time"][-1])
        axis.set_xlabel("time of the temperatures [s]")
    for axis in axes.flat:
        axis.grid(alpha=0.3)
        axis.legend(fontsize=8)
    figure.savefig(to, dpi=100, metadata={"Software": None})


def _run_up(axis: "Axes", table: NDArray[np.void], plan: Plan) -> None:
    shown = table[table["time"] <= min(plan.true_until, plan.end_time)]
    axis.plot(shown["time"], shown["shaft_speed"] / RPM / 1e3, label="speed [1000 r/min]")
    axis.plot(shown["time"], 1e2 * shown["motor_torque"], label="torque of the motor [N.cm]")
    axis.plot(shown["time"], 1e2 * shown["friction_torque"], label="friction torque [N.cm]")
    axis.set_xlabel("time [s]")


def _temperatures(axis: "Axes", table: NDArray[np.void], scene: Scene) -> None:
    for number, prefix in enumerate(bearing_prefixes(scene), 1):
        for ring, style in (("inner_ring", "-"), ("outer_ring", "--")):
            label = f"bearing {number}; outer ring dashed" if ring == "inner_ring" else None
            shown = table[f"{prefix}{ring}_temperature"] - ZERO_CELSIUS
            axis.plot(table["thermal_time"], shown, style, color=f"C{number - 1}", label=label)
    for name, color in (("shaft", "black"), ("housing", "gray")):
        axis.plot(table["thermal_time"], table[f"{name}_temperature"] - ZERO_CELSIUS, color=color, label=name)
    axis.set_ylabel("temperature [degC]")


def main(
    short: Annotated[bool, typer.Option(help="A quick run-up and a minute of warmth.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for FMUs, tables and picture.")] = Path(
        "out/spindle_set"
    ),
) -> None:
    """Run motor, motor spindle and thermal network from rest to 20,000 r/min and until they are warm."""
    with refusals():
        need("matplotlib", "the picture")
    scene, plan = read_scene(SCENE), SHORT if short else LONG
    try:
        table, _ = cosimulate(scene, output, plan)
    except (OSError, BuildError, SimulationError) as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None
    rows = compare(scene, table)
    write_csv(output / "spindle.csv", table)
    names = np.dtype([(name, np.float64) for name in rows[0]])
    write_csv(output / "preload.csv", np.array([tuple(row.values()) for row in rows], dtype=names))
    draw(table, rows, scene, plan, output / "spindle_set.png")
    for row in rows:
        typer.echo("  ".join(f"{name} {value:.1f}" for name, value in row.items()))


if __name__ == "__main__":
    typer.run(main)
