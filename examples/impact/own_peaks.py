"""A ball of the impact paper's bearing: peaks of its acceleration in our run, beside our modes and chance.

Scene `7003C-impact` with the paper's springs between the balls, run from rest in its equilibrium. The
acceleration of ball 1 is taken apart along the axis, outwards and along its orbit, in its own axes; so modes
are those in the axes that orbit with the balls. Writes ``own_peaks.md`` and ``own_peaks.csv``.

Usage: python examples/impact/own_peaks.py [--output-dir out]
"""

import datetime
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray
from scipy.signal import find_peaks

from examples.papers.chance import chance
from fmu_bearing import Scene, modes, read_scene, simulate
from fmu_bearing.results.table import machine, markdown, show, write_csv
from fmu_bearing.scene import si

Array = NDArray[np.float64]

SCENE = Path(__file__).parents[1] / "scenes" / "7003C-impact.toml"
SPEEDS = (10000, 20000)  # r/min
BANDS = (
    (54e3, 200e3),
    (5e3, 70e3),
)  # Hz: where the paper compares the balls' peaks, and the peaks of the sound
DURATION, STEP = 0.02, 1e-6  # s: lines are 50 Hz wide
#: Of the run, so that waves up to 200 kHz are followed: 10 steps to a period at most.
ACCURACY = {"max_internal_step_us": 0.5, "tolerance": 1e-6}
COUNT = 9  # strongest peaks of a band, as many as the paper's sound has
APART = TOLERANCE = 0.02  # peaks nearer than that are one; a mode that near is a match
PROMINENCE = 6.0  # dB above both sides
WEAKEST = 30.0  # dB below the strongest of its band: weaker ones are in the noise of the steps
HEADS = ("r/min", "band, kHz", "direction", "peaks, kHz", "matches", "covered, %", "expected by chance", "p")


def acceleration(scene: Scene, rpm: float) -> dict[str, Array]:
    """Return the acceleration (m/s2) of ball 1 in its own axes."""
    names = [f"ball[1].velocity.{axis}" for axis in "xyz"]
    run = simulate(scene, DURATION, step=STEP, inputs={"shaft_speed": rpm * np.pi / 30.0}, outputs=names)
    along, y, z = (np.array(run[name]) for name in names)
    across = z - 1j * y  # at angle theta from 12 o'clock the ball is at r exp(i theta)
    way = np.concatenate(([0.0], np.cumsum(across[1:] + across[:-1]) * STEP / 2.0))
    turned = across * np.exp(-1j * np.angle(si(scene.bearing).pitch_diameter / 2.0 + way))
    parts = {"axial": along, "radial": turned.real, "tangential": turned.imag}
    return {name: np.diff(velocity) / STEP for name, velocity in parts.items()}


def peaks(signal: Array, low: float, high: float) -> Array:
    """Return the strongest peaks of a signal's spectrum in a band, Hz, rising."""
    padded = 4 * signal.size
    spectrum = np.abs(np.fft.rfft((signal - signal.mean()) * np.hanning(signal.size), padded))
    frequency = np.fft.rfftfreq(padded, STEP)
    found, _ = find_peaks(20.0 * np.log10(spectrum + 1e-300), prominence=PROMINENCE)
    found = found[(frequency[found] >= low) & (frequency[found] <= high)]
    kept: list[float] = []
    found = found[np.argsort(-spectrum[found])]
    for place in found[spectrum[found] >= 10.0 ** (-WEAKEST / 20.0) * spectrum[found[:1]].sum()]:
        f = float(frequency[place])
        if len(kept) < COUNT and all(abs(f / other - 1.0) > APART for other in kept):
            kept.append(f)
    return np.sort(kept)


def judged(scene: Scene) -> list[list[str]]:
    """Return a row for each speed, band and direction."""
    exact = scene.model_copy(update={"fidelity": scene.fidelity.model_copy(update=ACCURACY)})
    rows = []
    for rpm in SPEEDS:
        found = modes(scene, {"shaft_speed": rpm * np.pi / 30.0}).modes
        own = np.array([abs(mode.orbiting.imag) / (2.0 * np.pi) for mode in found])
        own = own[own > 0.0]
        signals = acceleration(exact, rpm)
        for low, high in BANDS:
            for name, signal in signals.items():
                r = chance(lines := peaks(signal, low, high), own, TOLERANCE, low, high)
                near = [np.abs(own / f - 1.0).min() <= TOLERANCE for f in lines]
                shown = [
                    f"**{f / 1e3:.2f}**" if hit else f"{f / 1e3:.2f}"
                    for f, hit in zip(lines, near, strict=True)
                ]
                rows.append([
                    f"{rpm:,}", f"{low / 1e3:g} to {high / 1e3:g}", name, ", ".join(shown),
                    f"{r.matches} of {r.peaks}", f"{100 * r.coverage:.0f}", f"{r.expected:.1f}",
                    f"{r.probability:.4f}",
                ])  # fmt: skip
    return rows


def main(output_dir: Annotated[Path, typer.Option(help="Folder for the table.")] = Path("out")) -> None:
    """Run, compare, print and write the table."""
    rows = judged(read_scene(SCENE))
    title = "Peaks of a ball's acceleration at our own modes"
    show(title, HEADS, rows)
    page = (
        f"# {title}\n\n{machine()}; {datetime.datetime.now(datetime.UTC).date()}\n\n"
        f"Made by `examples/impact/own_peaks.py`: scene `7003C-impact`, {1e3 * DURATION:g} ms from rest in "
        f"equilibrium. The {COUNT} strongest peaks "
        f"of a band at most, {WEAKEST:g} dB below its strongest at most; within 2 % of a mode in bold.\n\n"
        f"{markdown(HEADS, rows)}"
    )
    output_dir.mkdir(parents=True, exist_ok=True)
    (output_dir / "own_peaks.md").write_text(page, encoding="utf-8")
    write_csv(output_dir / "own_peaks.csv", HEADS, rows)
    typer.echo(f"wrote own_peaks.md and own_peaks.csv in {output_dir}")


if __name__ == "__main__":
    typer.run(main)
