"""Move the axial mode of a spindle away from the balls that pass its inner race.

The 7003C in its spindle shall run at 10,000 r/min. The Campbell diagram shows at which speed f_i, the
frequency at which balls pass a place of the inner race, meets the axial mode: 4 % above operation, with a
damping ratio of 1.5 %. Preload moves the mode. For each preload this computes the mode, the speeds at which
f_i and 2 f_b (the form of the balls) meet it, and by runs with fidelity `response` the axial velocity of both
rings.

Writes

* ``axial_mode.md`` and ``axial_mode.csv`` - one row per preload.

Usage: python examples/modes/axial_mode.py [--output-dir out/axial_mode] [--short]
"""

import datetime
import math
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from fmu_bearing import campbell, read_scene, simulate
from fmu_bearing.cli.base import quiet_warnings, refusals
from fmu_bearing.modal.campbell.over_speed import Campbell
from fmu_bearing.results.table import machine, markdown, show, write_csv
from fmu_bearing.scene import Scene

SCENE = Path(__file__).parents[1] / "scenes" / "7003C-spindle.toml"
OPERATION = 10_000.0  # r/min
PRELOADS = (200.0, 250.0, 300.0, 400.0, 500.0, 650.0, 800.0)  # N
SHORT = (200.0, 500.0, 650.0)
SPEEDS = np.linspace(6_000.0, 15_000.0, 7)
LINES = ("f_i", "2 f_b")
SETTLE, WINDOW, STEP = 0.05, 0.2, 2e-5  # s: a step is a fortieth of the mode's period
COLUMNS = (
    "preload, N", "axial mode, Hz", "damping, %", "f_i meets it at, r/min", "margin, %",
    "2 f_b meets it at, r/min", "margin, %", "inner ring, mm/s rms", "outer ring, mm/s rms",
)  # fmt: skip


def spindle(preload: float) -> Scene:
    """Return the spindle at the speed of operation with a preload (N), without sound."""
    keys = {"operation.speed_rpm": OPERATION, "mounting.preload_N": preload, "sound": None}
    return read_scene(SCENE).replace(keys | {"fidelity.model": "response"})


def meets(diagram: Campbell, line: str) -> float:
    """Return the speed (r/min) at which a line meets the axial mode; NaN: at none computed."""
    found = [
        one.rpm for one in diagram.crossings() if one.line.name == line and one.branch.name == "inner axial"
    ]
    return found[0] if found else math.nan


def velocities(scene: Scene) -> tuple[float, float]:
    """Return rms axial velocities (m/s) of inner and outer ring in steady operation."""
    names = [f"{ring}_ring.velocity.x" for ring in ("inner", "outer")]
    run = simulate(scene, SETTLE + WINDOW, step=STEP, outputs=names, progress=False)
    steady = run.time > SETTLE
    inner, outer = (float(run[name][steady].std()) for name in names)
    return inner, outer


def row(preload: float) -> list[str]:
    """Return the row of a preload."""
    scene = spindle(preload)
    diagram = campbell(scene, SPEEDS)
    (branch,) = (branch for branch in diagram.branches if branch.name == "inner axial")
    cells = [f"{preload:g}"]
    cells.append(f"{np.interp(OPERATION, branch.rpm, branch.frequency):.0f}")
    cells.append(f"{100.0 * np.interp(OPERATION, branch.rpm, branch.damping):.2f}")
    for line in LINES:
        speed = meets(diagram, line)
        shown = (f"{speed:.0f}", f"{100.0 * (speed / OPERATION - 1.0):+.1f}")
        cells += ["", ""] if math.isnan(speed) else shown
    return cells + [f"{1e3 * value:.2f}" for value in velocities(scene)]


def note(rows: Sequence[Sequence[str]]) -> str:
    """Return the results file in Markdown."""
    return (
        "# The axial mode and the preload\n\n"
        f"{datetime.date.today()}, {machine()}.\n\n"
        f"Made by `examples/modes/axial_mode.py` for the 7003C in its spindle at {OPERATION:,.0f} r/min.\n"
        "Modes are from `fmu-bearing modes`, velocities from runs with fidelity `response` and the\n"
        "surfaces of the scene. Margins are counted from the speed of operation.\n\n"
        + markdown(COLUMNS, rows)
    )


def main(
    output_dir: Annotated[Path, typer.Option(help="Folder for the results.")] = Path("out/axial_mode"),
    short: Annotated[bool, typer.Option("--short", help="Three preloads.")] = False,
) -> None:
    """Move the axial mode away from the balls that pass the inner race."""
    with refusals(), quiet_warnings():
        rows = [row(preload) for preload in (SHORT if short else PRELOADS)]
    output_dir.mkdir(parents=True, exist_ok=True)
    write_csv(output_dir / "axial_mode.csv", COLUMNS, rows)
    (output_dir / "axial_mode.md").write_text(note(rows), "utf-8")
    show("axial mode and preload", COLUMNS, rows)
    typer.echo(f"written: {output_dir}")


if __name__ == "__main__":
    typer.run(main)
