"""A silicon nitride bearing on its steel shaft: preload and hoop stress while the spindle gets warm.

``python warm_up.py [--short]`` runs motor, bearing and thermal network of ``examples/spindle_cosimulation``
twice, with the rings as drawn and with the shaft's fit, from rest to 20,000 r/min until warm, and writes
``loose.csv``, ``fitted.csv`` and ``fits.png``. The thermal network has a shaft here. It gives its temperature
and the housing's to the bearing's inputs ``shaft_temperature`` and ``housing_temperature``.

The preload is 150 N of the loose bearing, held by the rings' place (``preload_mode = "rigid"``). Steel
expands 3.7 times as much as silicon nitride: a warm shaft tightens its fit, widens the inner ring and adds
preload.

From ``Plan.true_until`` on the network runs ahead of what turns, see ``examples/spindle_set/cosimulate.py``.
"""

from pathlib import Path
from sys import path
from typing import Annotated

import numpy as np
import typer
from fmpy.util import write_csv
from numpy.typing import NDArray

from fmu_bearing import Scene, build_fmu, read_scene
from fmu_bearing.cli.base import refusals
from fmu_bearing.compiled import BuildError
from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import empty

HERE = Path(__file__).resolve().parent
SPINDLE = HERE.parent / "spindle_cosimulation"
path.insert(0, str(SPINDLE))
from build import best_flavour, build  # noqa: E402
from coupling import Fmu, Plan, SimulationError, run  # noqa: E402

SCENE = HERE / "7003C-ceramic.toml"
AMBIENT = 22.0  # degC: where all begin
#: Heat capacities (J/K) of rings of silicon nitride, 700 J/(kg K), and of the scene's rotor of steel.
CAPACITIES = {"capacity.inner_ring": 3.9, "capacity.outer_ring": 6.1, "capacity.shaft": 550.0}
ZERO_CELSIUS = 273.15  # K
MEAN = 0.02  # s of the run: loads of waves average out
SPEED = 20000.0 * np.pi / 30.0
LONG = Plan(
    end_time=2.6, communication_step=1e-3, start_speed=100.0, target_speed=SPEED, ramp_time=0.4,
    true_until=0.6, thermal_rate=900.0,
)  # fmt: skip
SHORT = Plan(
    end_time=0.5, communication_step=1e-3, start_speed=100.0, target_speed=SPEED, ramp_time=0.2,
    true_until=0.3, thermal_rate=900.0,
)  # fmt: skip
RECORDED = (
    "contact.inner.load_mean", "contact.inner.angle_mean", "friction_torque", "heat.inner_ring",
    "heat.outer_ring", "heat.oil",
)  # fmt: skip
OF_FIT = (
    "contact.free_angle", "fit.inner.interference", "fit.inner.pressure", "fit.inner.hoop_stress",
    "fit.inner.race_growth", "fit.outer.interference",
)  # fmt: skip


def scenes() -> dict[str, Scene]:
    """Return the bearing with its rings as drawn and with its fit."""
    fitted = read_scene(SCENE).replace(
        {f"mounting.fit.{seat}.temperature_degC": AMBIENT for seat in ("shaft", "housing")}
    )
    return {"loose": fitted.replace({"mounting.fit": None}), "fitted": fitted}


def cosimulate(name: str, scene: Scene, folder: Path, plan: Plan) -> NDArray[np.void]:
    """Build and run the three FMUs.

    Returns
    -------
    structured array
        One row per communication point: time and thermal_time (s), outputs of motor, thermal network and
        bearing, and ``preload``, the axial load of the bearing (N).
    """
    flavour = best_flavour()
    folder.mkdir(parents=True, exist_ok=True)
    recorded = [*RECORDED, *(OF_FIT if scene.fit is not None else ())]
    with (
        Fmu(build(SPINDLE / "motor.py", folder, flavour), "motor") as motor,
        Fmu(Path(build_fmu(scene, folder / f"{name}.fmu").path), "bearing") as bearing,
        Fmu(build(SPINDLE / "thermal.py", folder, flavour, shaft=True), "thermal") as thermal,
    ):
        thermal.set(CAPACITIES)
        recording = run(motor, bearing, thermal, plan, recorded=recorded)
    table = recording.table()
    balls = scene.bearing.ball_count
    preload = balls * table["contact.inner.load_mean"] * np.sin(table["contact.inner.angle_mean"])
    more = {"thermal_time": np.array([plan.thermal_time(t) for t in table["time"]]), "preload": preload}
    kinds = [*((key, np.float64) for key in table.dtype.names), *((key, np.float64) for key in more)]
    whole = np.empty(len(table), dtype=np.dtype(kinds))
    for key in table.dtype.names:
        whole[key] = table[key]
    for key, values in more.items():
        whole[key] = values
    return whole


def draw(tables: dict[str, NDArray[np.void]], plan: Plan, to: Path) -> None:
    """Three plots over the time of the temperatures: these, preload with and without fit, hoop stress."""
    figure = empty((11.0, 3.6))
    warm, preload, hoop = figure.subplots(1, 3)
    fitted, width = tables["fitted"], max(1, round(MEAN / plan.communication_step))
    for name in ("inner_ring", "shaft", "outer_ring", "housing"):
        label = name.replace("_", " ")
        warm.plot(fitted["thermal_time"], fitted[f"{name}_temperature"] - ZERO_CELSIUS, label=label)
    warm.set_ylabel("temperature with fit [degC]")
    for name, label in (("loose", "rings as drawn"), ("fitted", "2 um tight on the shaft")):
        mean = np.convolve(tables[name]["preload"], np.ones(width) / width, "valid")
        preload.plot(tables[name]["thermal_time"][width - 1 :], mean, label=label)
    preload.axhline(150.0, color="gray", linestyle=":", label="of the loose bearing, cold")
    preload.set_ylabel("preload [N]")
    preload.set_ylim(bottom=0.0)
    hoop.plot(fitted["thermal_time"], 1e-6 * fitted["fit.inner.hoop_stress"], color="C3")
    hoop.set_ylabel("hoop stress in the inner ring's bore [MPa]")
    hoop.set_ylim(bottom=0.0)
    for axis in (warm, preload, hoop):
        axis.set_xscale("log")
        axis.set_xlim(0.1, fitted["thermal_time"][-1])
        axis.set_xlabel("time of the temperatures [s]")
        axis.grid(alpha=0.3)
    warm.legend(fontsize=8)
    preload.legend(fontsize=8)
    figure.savefig(to, dpi=100, metadata={"Software": None})


def main(
    short: Annotated[bool, typer.Option(help="A quick run-up and three minutes of warmth.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for FMUs, tables and picture.")] = Path("out/fits"),
) -> None:
    """Run the spindle with rings as drawn and with its fit, from rest to 20,000 r/min and until warm."""
    with refusals():
        need("matplotlib", "the picture")
    plan = SHORT if short else LONG
    try:
        tables = {name: cosimulate(name, scene, output, plan) for name, scene in scenes().items()}
    except (OSError, BuildError, SimulationError) as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None
    for name, table in tables.items():
        write_csv(output / f"{name}.csv", table)
        tail = table[-round(MEAN / plan.communication_step) :]
        words = f"{name}: preload {tail['preload'].mean():.0f} N"
        if name == "fitted":
            words += f", hoop stress {1e-6 * tail['fit.inner.hoop_stress'].mean():.0f} MPa"
        typer.echo(words)
    draw(tables, plan, output / "fits.png")


if __name__ == "__main__":
    typer.run(main)
