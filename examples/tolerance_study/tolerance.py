"""Spread of sound and vibration among bearings of one tolerance class: 7003C in its spindle, P5, P4 and P2.

``python tolerance.py [--quick]`` builds bearings from seeds (phases of the waviness, diameters of the balls)
and records each at 20,000 r/min: 12 of each class with fidelity full and radiation model bem, 0.2 s after
0.05 s; ``--quick``: 3 of each with fidelity rings and radiation model compact, 0.05 s. It writes
``tolerance.csv``, ``tolerance.md`` and ``tolerance.png``.

Assumed are the amplitudes of each class: a standard limits runout, not waviness. The catalogue has 0.6, 0.3
and 0.15 um for order 1 of the races of P5, P4 and P2, less unbalance with it, and 130, 80 and 80 nm for the
form of the balls (G5, G3, G3). All amplitudes are at their limit; the seed draws where on the races and balls
they lie. No other tolerance (clearance, conformity, contact angle) is varied.

Result, mean and standard deviation of 12 bearings: P5 79.7 +/- 1.6 dB(A), P4 74.3 +/- 1.3, P2 70.3 +/- 2.5 at
P1; outer ring 1.33, 0.71, 0.46 mm/s rms; torque 15.8 N mm, whatever the class. From one class to the next it
is 4 to 5 dB(A); two bearings of one class differ by up to 7.5 dB(A), bearings of P2 most, whose balls are no
rounder than balls of P4.
"""

from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer
from rich.console import Console
from rich.progress import track

from fmu_bearing import Scene, read_scene, record
from fmu_bearing.cli.base import refusals
from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import empty, save
from fmu_bearing.results.table import markdown, write_csv
from fmu_bearing.scene.read import with_fidelity

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SCENE = Path(__file__).resolve().parents[1] / "scenes" / "7003C-spindle.toml"
GRADES = ("P5", "P4", "P2")
SEEDS = 12
COLOURS = ("#D55E00", "#0072B2", "#009E73")
COLUMNS = ("grade", "seed", "spl_a_dB", "velocity_rms_mm_s", "torque_mean_N_mm")
TITLES = ("level at P1, dB(A)", "outer ring, mm/s rms", "friction torque, N mm")

Sample = tuple[str, int, float, float, float]


def of_grade(scene: Scene, grade: str, seed: int) -> Scene:
    """Return the scene with the catalogue's imperfections of a class, drawn from a seed."""
    return scene.replace({"imperfections": {"grade": grade, "seed": seed}})


def sample(scene: Scene, duration: float, radiation_model: str) -> tuple[float, float, float]:
    """Level at P1 (dB(A)), rms velocity of the outer ring in its plane (mm/s), mean torque (N mm)."""
    velocities = ("outer_ring.velocity.y", "outer_ring.velocity.z")
    kept = ("friction_torque", *velocities)
    # torque and velocities at 10 kHz: the pedestal's modes are far below
    recording = record(
        scene, duration, settle=0.05, step=1e-4, radiation_model=radiation_model, outputs=kept, progress=False
    )
    later = recording.output_time >= recording.start
    squares = sum(np.mean(recording.outputs[name][later] ** 2) for name in velocities)
    level = recording.levels([recording.positions[0]], weighting="A")[0]
    torque = recording.outputs["friction_torque"][later].mean()
    return float(level), 1e3 * float(np.sqrt(squares)), 1e3 * float(torque)


def summary(samples: list[Sample]) -> str:
    """Mean, standard deviation and range of each class, as a Markdown table."""
    rows = []
    for grade in dict.fromkeys(one[0] for one in samples):
        mine = np.array([one[2:] for one in samples if one[0] == grade])
        row = [grade, str(len(mine))]
        for column in mine.T:
            deviation = column.std(ddof=1)
            row.append(f"{column.mean():.2f} +/- {deviation:.2f} ({column.min():.2f} to {column.max():.2f})")
        rows.append(row)
    return markdown(("class", "bearings", *TITLES), rows)


def draw(samples: list[Sample]) -> "Figure":
    """Boxes over classes, and every bearing as a point."""
    figure = empty((10.0, 4.0))
    grades = list(dict.fromkeys(one[0] for one in samples))
    for number, (ax, title) in enumerate(zip(figure.subplots(1, 3), TITLES, strict=True), start=2):
        groups = [[one[number] for one in samples if one[0] == grade] for grade in grades]
        ax.boxplot(groups, tick_labels=grades, widths=0.5, showfliers=False, medianprops={"color": "black"})
        for place, (values, colour) in enumerate(zip(groups, COLOURS, strict=False), start=1):
            beside = place + 0.12 * np.sin(2.4 * np.arange(len(values)))
            ax.plot(beside, values, "o", color=colour, markersize=4, alpha=0.8)
        ax.set_title(title)
        ax.grid(axis="y", alpha=0.3)
    figure.suptitle(
        "7003C in its spindle, 20,000 r/min, bearings drawn from seeds; amplitudes assumed", fontsize=10
    )
    return figure


def main(
    quick: Annotated[bool, typer.Option("--quick", help="Few bearings, short runs, fidelity rings.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for table and picture.")] = Path("out/tolerance_study"),
) -> None:
    """Draw bearings of each class, record them, and write their spread."""
    with refusals():  # before minutes of computing
        need("matplotlib", "the picture")
    scene, seeds, duration, radiation_model = read_scene(SCENE), SEEDS, 0.2, "bem"
    if quick:
        scene, seeds, duration, radiation_model = with_fidelity(scene, model="rings"), 3, 0.05, "compact"
    wanted = [(grade, seed) for grade in GRADES for seed in range(1, seeds + 1)]
    samples: list[Sample] = [
        (grade, seed, *sample(of_grade(scene, grade, seed), duration, radiation_model))
        for grade, seed in track(wanted, "bearings", console=Console(stderr=True))
    ]
    output.mkdir(parents=True, exist_ok=True)
    rows = [[grade, str(seed), *(f"{value:.4f}" for value in values)] for grade, seed, *values in samples]
    write_csv(output / "tolerance.csv", COLUMNS, rows)
    (output / "tolerance.md").write_text(
        f"# Spread among bearings of a class\n\n{summary(samples)}", encoding="utf-8"
    )
    save(draw(samples), output / "tolerance.png")
    typer.echo(summary(samples))


if __name__ == "__main__":
    typer.run(main)
