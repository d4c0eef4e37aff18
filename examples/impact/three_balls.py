"""Three steel balls in a row: the pressure 285 mm beside the middle one, and its sensitivity.

The test of Kuan, Chen, Shen and Chang (2026), section 3: balls O1, O2, O3 of 22.2 mm on the x axis, in
contact; O1 starts towards O2 and O3 at 0.5 m/s; the microphone is on the z axis, square to the row,
285 mm from O2. The model has Hertz contacts, and exact scattering of sound between the balls. Nothing is
fitted.
Writes

* ``three_balls.md`` and ``three_balls.csv`` - peaks beside the paper's, and their sensitivity;
* ``three_balls.png`` - pressure histories, and peaks over the gap between O2 and O3.

Usage: python examples/impact/three_balls.py [--output-dir out] [--short]
"""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray

from examples.papers.impact.chain import (
    Collision,
    Sphere,
    collide,
    contact_time,
    hertz_stiffness,
)
from examples.papers.impact.impact_sound import BAND, impact_pressure
from examples.papers.impact.scattering import SphereRow
from examples.papers.impact.sphere_field import sphere_pressure
from fmu_bearing.acoustics.radiation.radiators import Air
from fmu_bearing.cli.base import refusals
from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import empty
from fmu_bearing.results.table import machine, markdown, show, write_csv

Array = NDArray[np.float64]

BALL = Sphere(radius=11.1e-3, density=7900.0, modulus=195e9, poisson=0.3)
SPEED = 0.5  # m/s
MICROPHONE = (0.0, 0.285)  # m: along the row, away from it
DURATION = 4e-4  # s, of the collision: the widest gap is closed and opened again
TIMES = np.arange(0.0, 1.6e-3, 1e-6)
#: Measured in their reference [24]; computed there with rigid balls; computed by the paper with elastic ones.
PAPER = (("measured, ref. [24]", 0.524), ("computed, ref. [24], rigid", 0.352), ("the paper, elastic", 0.543))
GAPS = (0.0, 1.0, 2.0, 3.0, 5.0, 7.0, 10.0, 15.0, 20.0, 30.0, 50.0)  # um
COLUMNS = ("case", "paper", "no scattering, max", "rigid max", "rigid min", "elastic max", "elastic min")


@dataclass(frozen=True)
class Case:
    """One variation; lengths in m, stiffness over Hertz's, ``apart`` widens the row for the sound alone."""

    name: str
    gap: float = 0.0
    speed: float = SPEED
    stiffness: float = 1.0
    apart: float = 0.0
    microphone: tuple[float, float] = MICROPHONE


def collision(case: Case) -> Collision:
    """Motion of the three balls; O1 touches O2 at the start, the gap lies between O2 and O3."""
    hertz = hertz_stiffness(BALL, BALL) * case.stiffness
    return collide(
        [BALL] * 3, [case.speed, 0.0, 0.0], [0.0, case.gap], duration=DURATION, stiffness=[hertz] * 2
    )


def centres(case: Case) -> Array:
    """Places of the balls for the sound, m."""
    return (2.0 * BALL.radius + case.apart) * np.array([-1.0, 0.0, 1.0])


def alone(case: Case, chain: Collision) -> Array:
    """Pressure if each ball sounded as if the others were not there."""
    total = np.zeros(TIMES.size)
    for x, acceleration in zip(centres(case), chain.acceleration, strict=True):
        way = case.microphone[0] - x
        r = float(np.hypot(way, case.microphone[1]))
        shaken = np.interp(TIMES, chain.time, acceleration, right=0.0)
        total += sphere_pressure(TIMES, shaken, BALL.radius, r, way / r)
    return total


def together(case: Case, chain: Collision, elastic: bool) -> Array:
    """Pressure with all scattering between the balls."""
    # a shorter contact reaches higher frequencies in proportion
    shorter = contact_time(BALL, BALL, SPEED) / contact_time(
        BALL, BALL, case.speed, hertz_stiffness(BALL, BALL) * case.stiffness
    )
    band = BAND * max(1.0, shorter)
    order = int(2.0 * np.pi * band / Air().sound_speed * BALL.radius) + 12
    row = SphereRow(centres(case), [BALL.radius] * 3, order)
    bodies = [BALL] * 3 if elastic else None
    return impact_pressure(row, chain, [case.microphone], TIMES, spheres=bodies, band=band)[0]


def cases(short: bool) -> list[Case]:
    """Return the reference first, then what is varied."""
    gaps = (0.0, 5.0, 20.0) if short else GAPS
    found = [
        Case(f"gap O2-O3 {gap:g} um" if gap else "in contact, 0.5 m/s, Hertz", gap * 1e-6) for gap in gaps
    ]
    if short:
        return found
    found += [Case(f"stiffness x {k:g}", stiffness=k) for k in (0.5, 0.8, 1.25, 2.0)]
    found += [Case(f"speed {v:g} m/s", speed=v) for v in (0.4, 0.45, 0.55, 0.6)]
    found += [
        Case(f"{s * 1e6:g} um of air between the balls, same motion", apart=s) for s in (1e-6, 1e-5, 1e-4)
    ]
    found += [
        Case(f"microphone {x * 1e3:+g} mm along the row", microphone=(x, MICROPHONE[1]))
        for x in (-0.01, 0.01)
    ]
    return found


def compute(case: Case) -> tuple[Collision, Array, Array, Array]:
    """Collision and pressures in Pa: balls alone, rigid together, elastic together."""
    chain = collision(case)
    return chain, alone(case, chain), together(case, chain, False), together(case, chain, True)


def draw(path: Path, gaps: Sequence[float], results: Sequence[tuple[Collision, Array, Array, Array]]) -> None:
    """Histories without gap, and largest pressures over the gap."""
    figure = empty((11.0, 4.2))
    left, right = figure.subplots(1, 2)
    names, colors = ("no scattering", "rigid", "elastic"), ("0.5", "#0072B2", "#D55E00")
    for k, (name, color) in enumerate(zip(names, colors, strict=True), start=1):
        left.plot(1e3 * TIMES, results[0][k], color=color, label=name)
        right.plot(
            gaps, [entry[k].max() for entry in results], color=color, marker="o", markersize=3, label=name
        )
    for (name, value), line in zip(PAPER, ("-", ":", "--"), strict=True):
        for axes in (left, right):
            axes.axhline(value, color="0.25", linestyle=line, linewidth=0.9, label=f"{name}: {value} Pa")
    left.set(
        xlim=(0.75, 1.4), xlabel="time [ms]", ylabel="pressure [Pa]", title="balls in contact at the start"
    )
    right.set(xlabel="gap between O2 and O3 [um]", ylabel="largest pressure [Pa]", title="what the gap does")
    right.set_ylim(0.0, None)
    left.set_ylim(-0.5, 1.1)
    left.legend(fontsize=7, frameon=False, loc="upper right")
    for axes in (left, right):
        axes.grid(True, color="0.92")
    figure.savefig(path, dpi=90, metadata={"Software": None})


def main(
    output_dir: Annotated[Path, typer.Option(help="Folder for the tables.")] = Path("out"),
    picture: Annotated[Path | None, typer.Option(help="PNG; by default beside the tables.")] = None,
    short: Annotated[bool, typer.Option(help="Three gaps only.")] = False,
) -> None:
    """Compute all cases, print the table, write table and picture."""
    with refusals():  # before minutes of computing
        need("matplotlib", "the picture")
    listed = cases(short)
    results = [compute(case) for case in listed]
    rows = [[name, f"{value:.3f}", *[""] * (len(COLUMNS) - 2)] for name, value in PAPER]
    for case, (_, free, rigid, elastic) in zip(listed, results, strict=True):
        peaks = (free.max(), rigid.max(), rigid.min(), elastic.max(), elastic.min())
        rows.append([case.name, "", *[f"{value:.3f}" for value in peaks]])
    title = "Three steel balls of 22.2 mm: pressures in Pa, 285 mm beside the middle ball"
    show(title, COLUMNS, rows)
    motion = []
    for case, (chain, *_) in zip(listed, results, strict=True):
        speed, push = chain.velocity[1].max(), np.abs(chain.acceleration).max()
        motion.append(
            [case.name, f"{speed:.3f}", f"{push:.3g}", *[f"{f:.0f}" for f in chain.force.max(axis=1)]]
        )
    heads = (
        "case",
        "largest speed of O2, m/s",
        "largest acceleration, m/s2",
        "peak force O1-O2, N",
        "peak force O2-O3, N",
    )
    output_dir.mkdir(parents=True, exist_ok=True)
    page = f"# {title}\n\n{machine()}\n\n{markdown(COLUMNS, rows)}\nMotion:\n\n{markdown(heads, motion)}"
    (output_dir / "three_balls.md").write_text(page, encoding="utf-8")
    write_csv(output_dir / "three_balls.csv", COLUMNS, rows)
    first = [k for k, case in enumerate(listed) if "gap" in case.name or k == 0]
    picture = output_dir / "three_balls.png" if picture is None else picture
    draw(picture, [1e6 * listed[k].gap for k in first], [results[k] for k in first])
    typer.echo(f"wrote three_balls.md and three_balls.csv in {output_dir}, and {picture}")


if __name__ == "__main__":
    typer.run(main)
