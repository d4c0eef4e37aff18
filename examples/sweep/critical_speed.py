"""Critical speed over the stiffness of the pedestal: maps over speed and stiffness.

The 7003C in its spindle runs with fidelity ``rings`` and compact sound, over shaft speed and pedestal
stiffness, twice: as the scene has it, and with round rings and equal balls, so that unbalance alone excites
it. The first lateral mode, at 465 Hz (27,900 r/min) on the scene's pedestal, moves with about the square root
of the stiffness. The speed at which the unbalance excites it is compared with the mode computed from masses
and springs.
Writes

* ``sweep.md`` and ``sweep.csv`` - mode and ridges for each stiffness;
* ``sweep.png`` - sound level and once-per-turn velocity over speed and stiffness.

Usage: python examples/sweep/critical_speed.py [--output-dir out/critical_speed] [--short] [--workers N]
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray
from scipy.linalg import eigh
from scipy.signal import find_peaks

from fmu_bearing.arrays import Arrays
from fmu_bearing.cli.base import refusals
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import P
from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import empty, save
from fmu_bearing.results.table import machine, markdown, show, write_csv
from fmu_bearing.scene import Scene, read_scene
from fmu_bearing.sweeps import sweep
from fmu_bearing.sweeps.picture import draw_map, shown

Array = NDArray[np.float64]

SCENE = Path(__file__).parents[1] / "scenes" / "7003C-spindle.toml"
STATED = 7.1e7  # N/m: the scene's pedestal, chosen for a mode at 28,000 r/min
STIFFNESSES = tuple(float(f"{STATED * 1.2**k:.4g}") for k in range(-4, 5))
SPEEDS = tuple(np.arange(8000.0, 44001.0, 1000.0))
SHORT = (STIFFNESSES[::4], tuple(np.arange(16000.0, 44001.0, 4000.0)))
SOUND, TURN = "mic[1].leq_a", "outer_ring.velocity:1x"
BALLS = "stiffness.radial"
FIGURES = (SOUND, "mic[1].leq", "outer_ring.velocity", TURN, BALLS)
COLUMNS = (
    "pedestal, N/m", "mode, r/min", "1x ridge, r/min", "difference, %",
    "dB(A) ridge of unbalance alone, r/min", "difference, %", "loudest of the scene, r/min",
)  # fmt: skip


def scenes() -> dict[str, Scene]:
    """Return the spindle as it is, and excited by unbalance alone."""
    cheap = {"fidelity.model": "rings", "sound.radiation_model": "compact", "sound.details": False}
    found = read_scene(SCENE).replace(cheap)
    smooth = {
        "imperfections.inner_race_amplitude_um": 0.0,
        "imperfections.outer_race_amplitude_um": 0.0,
        "imperfections.ball_diameter_spread_nm": 0.0,
        "imperfections.ball_form_nm": 0.0,
    }
    return {"as the scene is": found, "unbalance alone": found.replace(smooth)}


def critical_speed(scene: Scene, stiffness: float, speeds: Array, balls: Array) -> float:
    """Speed (r/min) at which the shaft turns with the first lateral mode on a pedestal (N/m).

    Inner ring with rotor and outer ring with housing as two masses, the balls' radial stiffness (N/m,
    ``balls`` at ``speeds``) between them. Tilting, coupled to it by the contact angle, changes the mode by
    less than 0.01 % here; damping and gyroscopic moments are left out.
    """
    p = Arrays.of(scene).p
    mass = np.diag(p[[P.INNER_MASS, P.OUTER_MASS]])
    rpm = float(speeds[0])
    for _ in range(20):
        k = float(np.interp(rpm, speeds, balls))
        squares = eigh(np.array([[k, -k], [-k, k + stiffness]]), mass, eigvals_only=True)
        before, rpm = rpm, float(np.sqrt(squares[0]) / RPM)
        if abs(rpm - before) < 0.1:
            return rpm
    raise RuntimeError(f"no critical speed for {stiffness:g} N/m")


def ridge(speeds: Array, values: Array) -> float:
    """Speed of the most prominent peak, between the points by a parabola; NaN without a peak."""
    peaks, about = find_peaks(values, prominence=0.0)
    if not len(peaks):
        return float("nan")
    k = int(peaks[np.argmax(about["prominences"])])
    below, top, above = values[k - 1 : k + 2]
    shift = 0.5 * (below - above) / (below - 2.0 * top + above)
    return float(speeds[k] + shift * (speeds[k + 1] - speeds[k]))


def rows_of(found: dict, modes: Sequence[float]) -> list[list[str]]:
    """Return mode and ridges of each stiffness as texts in the order of ``COLUMNS``."""
    whole, alone = found.values()
    speeds = whole["speed_rpm"].values
    rows = []
    for k, (stiffness, mode) in enumerate(zip(whole["pedestal_stiffness_N_m"].values, modes, strict=True)):
        turn = ridge(speeds, 20.0 * np.log10(whole[TURN].values[k]))
        loud = ridge(speeds, alone[SOUND].values[k])
        loudest = speeds[int(np.argmax(whole[SOUND].values[k]))]
        rows.append(
            [
                f"{stiffness:.3g}", f"{mode:.0f}", f"{turn:.0f}", f"{100 * (turn / mode - 1):+.1f}",
                f"{loud:.0f}", f"{100 * (loud / mode - 1):+.1f}", f"{loudest:.0f}",
            ]
        )  # fmt: skip
    return rows


def draw(path: Path, found: dict, modes: Sequence[float]) -> None:
    """Draw three maps: sound and once-per-turn velocity of the scene, sound of unbalance alone."""
    panels = (("as the scene is", SOUND), ("as the scene is", TURN), ("unbalance alone", SOUND))
    figure = empty((15.0, 4.6))
    for ax, (name, kind) in zip(figure.subplots(1, 3), panels, strict=True):
        data = found[name]
        values, unit = shown(data[kind])
        map_ = values.transpose("pedestal_stiffness_N_m", "speed_rpm").values
        options = {"norm": "log"} if kind == TURN else {"vmin": map_.max() - 45.0}
        colours = draw_map(ax, data, "speed_rpm", "pedestal_stiffness_N_m", map_, **options)
        figure.colorbar(colours, ax=ax, label=unit)
        springs = data["pedestal_stiffness_N_m"].values
        ax.plot(modes, springs, "w--", linewidth=1.4, label="mode from springs and masses")
        ax.axhline(STATED, color="w", linewidth=0.6)
        ax.set_xlim(data["speed_rpm"].values.min(), data["speed_rpm"].values.max())
        words = "sound at P1" if kind == SOUND else "outer ring's velocity at shaft speed (1x)"
        ax.set_title(f"{words}, {name}", fontsize=10)
        ax.legend(loc="lower right", fontsize=7, facecolor="0.3", labelcolor="w", framealpha=0.6)
    figure.suptitle(
        f"7003C in its spindle: critical speed over pedestal stiffness (thin line: {STATED / 1e7:g}e7 N/m)"
    )
    save(figure, path)


def main(
    output_dir: Annotated[Path, typer.Option(help="Folder for table and points.")] = Path(
        "out/critical_speed"
    ),
    picture: Annotated[Path | None, typer.Option(help="PNG; by default beside the table.")] = None,
    short: Annotated[bool, typer.Option(help="Few points, short windows.")] = False,
    workers: Annotated[int | None, typer.Option(help="Processes; default: one per core.")] = None,
    scheduler: Annotated[str | None, typer.Option(help="Dask scheduler in their place.")] = None,
) -> None:
    """Sweep both scenes, print the table, write table and picture."""
    with refusals():  # before minutes of computing
        need("xarray", "a sweep")
        need("matplotlib", "the picture")
    stiffnesses, speeds = SHORT if short else (STIFFNESSES, SPEEDS)
    axes = {"pedestal": stiffnesses, "speed": speeds}
    window = 0.03 if short else 0.1
    options = {"window": window, "figures": FIGURES, "workers": workers, "scheduler": scheduler}
    found = {name: sweep(scene, axes, folder=output_dir, **options) for name, scene in scenes().items()}
    whole = found["as the scene is"]
    modes = [
        critical_speed(scenes()["as the scene is"], spring, np.array(speeds), whole[BALLS].values[k])
        for k, spring in enumerate(stiffnesses)
    ]
    rows = rows_of(found, modes)
    title = "Critical speed of the 7003C's spindle over pedestal stiffness"
    show(title, COLUMNS, rows)
    points = sum(data["wall"].size for data in found.values())
    busy = sum(float(data["wall"].sum()) for data in found.values())
    text = (
        f"# {title}\n\n{machine()}\n\n"
        "Made by `examples/sweep/critical_speed.py` with fidelity `rings` and radiation model `compact`:\n"
        f"{points} points of {1e3 * window:g} ms after 20 ms each, {busy:.0f} s of one core.\n"
        f"`docs/sweeps.md` explains the columns.\n\n{markdown(COLUMNS, rows)}"
    )
    (output_dir / "sweep.md").write_text(text, encoding="utf-8")
    write_csv(output_dir / "sweep.csv", COLUMNS, rows)
    draw(picture or output_dir / "sweep.png", found, modes)
    typer.echo(f"wrote sweep.md and sweep.csv in {output_dir}, and {picture or output_dir / 'sweep.png'}")


if __name__ == "__main__":
    typer.run(main)
