"""Directivity of the full-ceramic 7009C: levels on a circle of 210 mm, 50 mm along the axis, and its twin.

``python directivity.py [--quick]`` records both bearings with fidelity full and radiation model bem;
``--quick``: a short run of the ceramic bearing with radiation model compact. It writes ``directivity.png``,
each circle about its mean, and ``directivity.csv``.

Result: the ceramic bearing's circle is loudest 1.9 dB(A) above its quietest place at 6,000 r/min (37.8 dB(A)
at 315 deg from 12 o'clock), 0.6 at 12,000 r/min (53.8 dB(A)) and 0.3 at 18,000 r/min (73.5 dB(A)). At 18,000
r/min the loose inner ring whirls by itself, at 1.4 kHz and without any imperfection too: the level is that of
the whirl, and even all round. The steel twin whirls more: 89.1 dB(A), even within 0.1 dB.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import numpy as np
import typer

from fmu_bearing import read_scene, record
from fmu_bearing.acoustics.analysis.directivity import directivity
from fmu_bearing.cli.base import refusals
from fmu_bearing.extras import need
from fmu_bearing.recording.measurements import measure as sound_measure, pictures as sound_pictures
from fmu_bearing.recording.measurements.measure import Round
from fmu_bearing.results.table import markdown, write_csv

SCENES = Path(__file__).resolve().parents[1] / "scenes"
RADIUS, AXIAL, COUNT = 0.21, 0.05, 24  # m; the sound-field paper's circle
CASES = (
    ("full ceramic, 6,000 r/min", "7009C-full-ceramic", 6000.0),
    ("full ceramic, 12,000 r/min", "7009C-full-ceramic", 12000.0),
    ("full ceramic, 18,000 r/min", "7009C-full-ceramic", 18000.0),
    ("steel, 18,000 r/min", "7009C-steel", 18000.0),
)
COLUMNS = ("case", "highest, dB", "at, deg", "lowest, dB", "DL, dB", "DV, dB")


def circle(scene: str, rpm: float, duration: float, radiation_model: str) -> Round:
    """Levels round the circle of a scene at a speed."""
    speed = rpm * np.pi / 30.0
    recording = record(
        read_scene(SCENES / f"{scene}.toml"),
        duration,
        speed=speed,
        settle=0.03,
        radiation_model=radiation_model,
    )
    return sound_measure.circle(recording, RADIUS, AXIAL, COUNT, weighting="A")


def cells(circles: dict[str, Round]) -> list[list[str]]:
    """Rows of the table."""
    return [
        [
            name, f"{one.directivity.highest:.1f}", f"{np.degrees(one.directivity.da):.0f}",
            f"{one.directivity.lowest:.1f}", f"{one.directivity.dl:.3f}", f"{one.directivity.dv:.1f}",
        ]
        for name, one in circles.items()
    ]  # fmt: skip


def about_mean(one: Round) -> Round:
    """Subtract the mean of a circle's levels, so that loud and quiet bearings can be compared."""
    relative = one.levels - one.levels.mean()
    return Round(one.angles, relative, directivity(one.angles, relative))


def levels(circles: dict[str, Round]) -> tuple[Sequence[str], list[list[str]]]:
    """Levels at every angle, one column per case."""
    angles = np.degrees(next(iter(circles.values())).angles)
    rows = [
        [f"{angle:.0f}", *(f"{one.levels[k]:.2f}" for one in circles.values())]
        for k, angle in enumerate(angles)
    ]
    return ["angle_deg", *circles], rows


def main(
    quick: Annotated[bool, typer.Option("--quick", help="One short run, radiation model compact.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for picture and table.")] = Path("out/directivity"),
) -> None:
    """Record the bearings, and measure and draw their circles."""
    with refusals():  # before minutes of computing
        need("matplotlib", "the picture")
    cases, duration, radiation_model = (CASES[2:3], 0.05, "compact") if quick else (CASES, 0.4, "bem")
    circles = {name: circle(scene, rpm, duration, radiation_model) for name, scene, rpm in cases}
    title = f"dB(A) beside the circle's mean, r {1e3 * RADIUS:g} mm, l {1e3 * AXIAL:g} mm"
    shown = {name: about_mean(one) for name, one in circles.items()}
    sound_pictures.save(sound_pictures.circle_picture(shown, title), output / "directivity.png")
    write_csv(output / "directivity.csv", *levels(circles))
    typer.echo(markdown(COLUMNS, cells(circles)))


if __name__ == "__main__":
    typer.run(main)
