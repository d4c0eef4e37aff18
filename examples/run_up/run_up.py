"""Run-up of the 7003C in its spindle: waterfall and order map of the sound at P1, 105 mm beside the bearing.

``python run_up.py [--quick]`` runs the scene from 4,000 to 36,000 r/min in a second, with fidelity full and
radiation model bem; ``--quick``: fidelity rings, radiation model compact, a third of the time. It writes
``waterfall.png``, ``orders.png``, ``orders.csv`` and ``peaks.md``.

Result: the shaft's order is loudest at 28,700 r/min, 70 dB: the critical speed at 27,900 r/min, a little
late, as the ramp goes by at 32,000 r/min per second. Waves of the races are louder where they come to 2.0
kHz, the rotor on the balls: the balls passing the outer race (order 5.04) 78 dB at 23,300 r/min, order 6.0 72
dB at 20,000 r/min, order 8.0 71 dB at 15,400 r/min.
"""

from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray

from fmu_bearing import read_scene, record
from fmu_bearing.acoustics.analysis.order import OrderMap, waterfall
from fmu_bearing.cli.base import refusals
from fmu_bearing.extras import need
from fmu_bearing.recording.measurements import (
    measure as sound_measure,
    pictures as sound_pictures,
    tables as sound_tables,
)
from fmu_bearing.results.table import markdown, write_csv
from fmu_bearing.scene.read import with_fidelity

SCENE = Path(__file__).resolve().parents[1] / "scenes" / "7003C-spindle.toml"
RPM = np.pi / 30.0
FROM, TO = 4000.0 * RPM, 36000.0 * RPM  # rad/s
SETTLE = 0.02  # s
HIGHEST = 12.0  # order: f_i of 12 balls is at 7.0
UP_TO = 8000.0  # Hz, in the waterfall


def peaks(orders: OrderMap, wanted: dict[str, float]) -> list[list[str]]:
    """Highest level of each order (dB), and the speed at which it is reached."""
    rows = []
    for name, order in wanted.items():
        along = levels_at(orders, order)
        best = int(np.argmax(along))
        rows.append([name, f"{order:.2f}", f"{along[best]:.1f}", f"{orders.speed[best] / RPM:.0f}"])
    return rows


def levels_at(orders: OrderMap, order: float) -> NDArray[np.float64]:
    """Levels along one order, the largest within 0.15 of it: contact angles move it a little."""
    near = np.abs(orders.orders - order) <= 0.15
    return orders.levels[:, near].max(axis=1)


def main(
    quick: Annotated[
        bool, typer.Option("--quick", help="A short run: fidelity rings, radiation model compact.")
    ] = False,
    output: Annotated[Path, typer.Option(help="Folder for pictures and table.")] = Path("out/run_up"),
) -> None:
    """Record a run-up and draw its sound."""
    with refusals():  # before minutes of computing
        need("matplotlib", "the picture")
    scene, duration, radiation_model = read_scene(SCENE), 1.0, "bem"
    if quick:
        scene, duration, radiation_model = with_fidelity(scene, model="rings"), 0.3, "compact"
    rate = (TO - FROM) / duration
    recording = record(
        scene,
        duration,
        speed=lambda t: FROM + rate * max(t - SETTLE, 0.0),
        settle=SETTLE,
        radiation_model=radiation_model,
    )
    place = recording.positions[0]
    orders = sound_measure.run_up(recording, place, highest=HIGHEST)
    fall = waterfall(recording.pressure([place])[0], recording.angle, recording.rate, highest=UP_TO)
    kinematic = recording.kinematics()
    title = f"{scene.name}, {FROM / RPM:,.0f} to {TO / RPM:,.0f} r/min in {duration:g} s, P1"
    end = recording.excitation_end
    turned = None if end is None else end / kinematic.f_r
    sound_pictures.save(sound_pictures.order_picture(orders, kinematic, title, end), output / "orders.png")
    sound_pictures.save(sound_pictures.waterfall_picture(fall, title, turned), output / "waterfall.png")
    write_csv(output / "orders.csv", *sound_tables.order_table(orders))
    outer, inner = kinematic.f_o / kinematic.f_r, kinematic.f_i / kinematic.f_r
    wanted = {"shaft": 1.0, "outer race": outer, "outer race and shaft": outer + 1.0}
    wanted |= {"inner race": inner, "inner race and shaft": inner + 1.0}
    table = markdown(("line", "order", "highest level, dB", "at r/min"), peaks(orders, wanted))
    (output / "peaks.md").write_text(f"# {title}: highest levels of the orders\n\n{table}", encoding="utf-8")
    typer.echo(table)


if __name__ == "__main__":
    typer.run(main)
