"""Three pictures of the 7003C in its spindle: preload, spectrum by component, orders of a run-up.

``python gallery.py [--quick]`` writes ``preload.png``, ``spectrum.png`` and ``orders.png``, in half a minute.
Fidelity is ``rings``, for the levels over preload ``response``; the radiation model is ``compact``.
``--quick``: few preloads and seeds, a short run-up.

Result: at 20,000 r/min the level at P1 does not rise steadily with the preload. It peaks where the rotor's
resonance on the balls comes to f_o and 2 f_b - f_c, near 150 N, and to f_i - f_r, near 500 N (mean of eight
seeds 73 dB(A)), and has a valley of 65 dB(A) in between, at 300 N. Pressure and life set a limit of their
own: 1.5 GPa, makers' heavy class, comes at 230 N.
"""

from math import pi, sqrt
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np
import typer

from fmu_bearing import (
    Recording,
    Scene,
    measure,
    operating_point,
    pictures,
    read_scene,
    record,
    with_fidelity,
)
from fmu_bearing.cli.base import refusals
from fmu_bearing.design.operating_point import BearingPoint
from fmu_bearing.extras import need
from fmu_bearing.formulas.makers import CLASS_PRESSURE
from fmu_bearing.results.picture_parts import empty

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

SCENE = Path(__file__).resolve().parents[1] / "scenes" / "7003C-spindle.toml"
RPM = pi / 30.0
PRELOADS = (60.0, 80.0, 100.0, 120.0, 140.0, 160.0, 180.0, 200.0, 225.0, 250.0, 275.0, 300.0, 350.0, 400.0,
            450.0, 500.0, 550.0, 600.0)  # fmt: skip
SEEDS = 8
SOUND = {"radiation_model": "compact", "progress": False}
LEVEL, PRESSURE, LIFE = "#0072B2", "#D55E00", "#009E73"


def resonance(point: BearingPoint) -> float:
    """Hz: rotor and housing against each other on the radial stiffness of the balls."""
    mounting = point.scene.mounting
    assert mounting.rotor is not None and mounting.housing is not None
    masses = 1.0 / mounting.rotor.mass_kg + 1.0 / mounting.housing.mass_kg
    return sqrt(point.stiffness[1, 1] * masses) / (2.0 * pi)


def loudness(scene: Scene, seeds: int) -> list[float]:
    """Levels at P1 (dB(A)) of bearings drawn from seeds."""
    scene = with_fidelity(scene, model="response")
    drawn = (scene.replace({"imperfections.seed": seed}) for seed in range(1, seeds + 1))
    return [
        float(record(one, 0.2, settle=0.05, **SOUND).levels(["P1"], weighting="A")[0])  # type: ignore[arg-type]
        for one in drawn
    ]


def over_preload(scene: Scene, preloads: tuple[float, ...], seeds: int) -> "Figure":
    """Draw level, pressure and life over preload."""
    scenes = [scene.replace({"mounting.preload_N": preload}) for preload in preloads]
    points = [operating_point(one).bearings[0] for one in scenes]
    levels = np.array([loudness(one, seeds) for one in scenes])
    figure = empty((11.0, 4.4))
    left, right = figure.subplots(1, 2)
    left.fill_between(preloads, levels.min(axis=1), levels.max(axis=1), color=LEVEL, alpha=0.2)
    left.plot(preloads, levels.mean(axis=1), "o-", color=LEVEL, markersize=4)
    _mark_lines(left, preloads, points)
    left.set_ylabel(f"level at P1, dB(A): mean and range of {seeds} seeds")
    right.plot(preloads, [1e-9 * p.contacts["inner"]["pressure_max"] for p in points], color=PRESSURE)
    right.axhline(1e-9 * CLASS_PRESSURE["hybrid"], color=PRESSURE, linestyle=":")
    right.text(preloads[-1], 1.51, "makers' heavy class", color=PRESSURE, ha="right", va="bottom", fontsize=9)
    right.set_ylabel("largest pressure, GPa", color=PRESSURE)
    life = right.twinx()
    life.semilogy(preloads, [p.rating.life for p in points if p.rating], color=LIFE)
    life.set_ylabel("basic life L10, h", color=LIFE)
    for ax in (left, right):
        ax.set_xlabel("preload, N")
        ax.grid(alpha=0.3)
    figure.suptitle(f"{scene.name}, {scene.operation.speed_rpm:,.0f} r/min, waviness assumed", fontsize=10)
    return figure


def _mark_lines(ax: "Axes", preloads: tuple[float, ...], points: list[BearingPoint]) -> None:
    """Mark the preloads at which the resonance meets a line of the balls and races."""
    at = np.array([resonance(point) for point in points])
    found = [point.frequencies for point in points]
    lines = {
        "$f_o$": [f.f_o for f in found],
        "$2f_b - f_c$": [2.0 * f.f_b - f.f_c for f in found],
        "$f_i - f_r$": [f.f_i - f.f_r for f in found],
    }
    low, high = ax.get_ylim()
    ax.set_ylim(low, high + 4.0)
    for k, (name, frequencies) in enumerate(lines.items()):
        apart = at - np.array(frequencies)  # grows with the preload
        if apart[0] < 0.0 < apart[-1]:
            place = float(np.interp(0.0, apart, preloads))
            ax.axvline(place, color="black", linestyle=":", linewidth=0.8)
            ax.text(place, high + (0.4, 2.2)[k % 2], f" {name}", fontsize=9)


def spectrum(recording: Recording) -> "Figure":
    """Draw the spectrum at P1 by component."""
    frequency, spectra = measure.component_spectra(recording, "P1", 5.0)
    low = frequency <= 5000.0
    shown = {name: spectra[name][low] for name in ("total", "inner_ring", "balls")}
    end = recording.excitation_end
    return pictures.spectrum_picture(frequency[low], shown, recording.kinematics(), excitation_end=end)


def orders(scene: Scene, duration: float) -> "Figure":
    """Draw the order map of a run-up from 4,000 to 36,000 r/min."""
    first, last, settle = 4000.0 * RPM, 36000.0 * RPM, 0.02
    run_up = record(
        scene,
        duration,
        speed=lambda t: first + (last - first) * max(t - settle, 0.0) / duration,
        settle=settle,
        **SOUND,  # type: ignore[arg-type]
    )
    found = measure.run_up(run_up, "P1", highest=12.0)
    title = f"{scene.name}, 4,000 to 36,000 r/min in {duration:g} s, P1"
    return pictures.order_picture(found, run_up.kinematics(), title, run_up.excitation_end)


def main(
    quick: Annotated[bool, typer.Option("--quick", help="Few preloads and seeds, a short run-up.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for the pictures.")] = Path("out/gallery"),
) -> None:
    """Draw the pictures."""
    with refusals():  # before half a minute of computing
        need("matplotlib", "the pictures")
    scene = with_fidelity(read_scene(SCENE), model="rings")
    preloads, seeds = ((100.0, 300.0, 500.0), 2) if quick else (PRELOADS, SEEDS)
    pictures.save(over_preload(scene, preloads, seeds), output / "preload.png")
    pictures.save(spectrum(record(scene, 0.4, settle=0.1, **SOUND)), output / "spectrum.png")  # type: ignore[arg-type]
    pictures.save(orders(scene, 0.2 if quick else 1.0), output / "orders.png")
    typer.echo(f"wrote preload.png, spectrum.png and orders.png in {output}")


if __name__ == "__main__":
    typer.run(main)
