"""Run-up of the motor spindle 7003C-QBC on its own: vibration of its nose over speed.

``python run_up.py [--quick]`` runs the set from rest to 30,000 r/min in 0.75 s with its scene's waves, heavy
spot and temperatures, and writes ``run_up.csv`` and ``run_up.png``: levels of the nose's velocity along y
over speed and frequency, and its rms value over speed beside that of a rigid shaft. ``--quick``: 0.15 s.

Result: the shaft bends on its bearings at 2.31 kHz. Its unbalance would meet that at 139,000 r/min, yet waves
of the races do so from 5,000 r/min on: the balls passing the outer race at 27,900 r/min with 5.2 mm/s, one
order above it at 23,000 r/min, order 7.9 at 17,900 r/min. The largest rms value of the nose is 6.0 mm/s, with
a rigid shaft 1.2 mm/s.
"""

from pathlib import Path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray
from scipy.signal import stft

from fmu_bearing import Scene, read_scene, simulate, statics
from fmu_bearing.cli.base import refusals
from fmu_bearing.elastic.shaft import shaft_model
from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import empty, label

SCENE = Path(__file__).resolve().parent / "7003C-QBC.toml"
RPM = np.pi / 30.0
TO = 30000.0 * RPM  # rad/s
STEP = 1e-4  # s: vibrations up to 5 kHz
WINDOW = 512  # steps: lines of 20 Hz
UP_TO = 3000.0  # Hz in the picture
NOSE = "shaft.nose.velocity.y"
CAGE = "bearing[1].cage.speed_ratio"


def run(scene: Scene, duration: float) -> dict[str, NDArray[np.float64]]:
    """Speed (r/min), velocity of the nose along y (mm/s) and cage speed over shaft speed, every ``STEP``."""
    speed = {"shaft_speed": lambda t: TO * t / duration}
    found = simulate(scene, duration, step=STEP, inputs=speed, outputs=[NOSE, CAGE])
    rpm = TO * found.time / duration / RPM
    return {"rpm": rpm, "velocity": 1e3 * found[NOSE], "cage": found[CAGE]}


def over_speed(found: dict[str, NDArray[np.float64]]) -> tuple[NDArray[np.float64], ...]:
    """Frequencies (Hz), speeds (r/min) and rms values of lines (mm/s), frequencies by speeds."""
    frequencies, times, values = stft(
        found["velocity"], 1.0 / STEP, nperseg=WINDOW, noverlap=WINDOW * 7 // 8, boundary=None, padded=False
    )
    return frequencies, found["rpm"][np.round(times / STEP).astype(int)], np.sqrt(2.0) * np.abs(values)


def rms(found: dict[str, NDArray[np.float64]]) -> NDArray[np.float64]:
    """Return the moving rms value (mm/s) over a window, at each step from the window's end on."""
    return np.sqrt(np.convolve(found["velocity"] ** 2, np.ones(WINDOW) / WINDOW, "valid"))


def shaft_frequencies(scene: Scene) -> NDArray[np.float64]:
    """Return frequencies (Hz) of the whirling shaft in bearings as stiff as statics finds them.

    At the scene's speed, without damping and without the mass of rings and balls: linear algebra, with none
    of the run's equations.
    """
    assert scene.spindle is not None
    model = shaft_model(scene, scene.spindle)
    stiffness, n = model.stiffness.copy(), len(model.mass)
    for bearing, plane in zip(statics(scene).bearings, model.planes, strict=True):
        own = np.diag([bearing.sign, 1.0, 1.0, bearing.sign, bearing.sign]) @ plane
        stiffness += own.T @ bearing.stiffness @ own
    whirl = scene.operation.speed_rpm * RPM * model.gyroscopic
    rates = -np.linalg.solve(model.mass, np.hstack([stiffness, whirl]))
    roots = np.linalg.eigvals(np.vstack([np.hstack([np.zeros((n, n)), np.eye(n)]), rates]))
    return np.sort(roots.imag[roots.imag > 1.0]) / (2.0 * np.pi)


def draw(
    bends: dict[str, NDArray[np.float64]], rigid: dict[str, NDArray[np.float64]], scene: Scene, to: Path
) -> None:
    """Spectrum over speed with the lines of shaft and balls; rms value over speed."""
    figure = empty((9.0, 7.0))
    map_axis, rms_axis = figure.subplots(2, 1, sharex=True, height_ratios=(2, 1))
    frequencies, rpm, values = over_speed(bends)
    shown = frequencies <= UP_TO
    levels = 20.0 * np.log10(np.maximum(values[shown], 1e-4))
    mesh = map_axis.pcolormesh(rpm, frequencies[shown], levels, vmin=-60.0, vmax=0.0, rasterized=True)
    figure.colorbar(mesh, ax=map_axis, label="dB re 1 mm/s")
    ratio = float(np.median(bends["cage"][len(bends["cage"]) // 2 :]))
    passing = scene.bearing.ball_count * ratio
    inner = scene.bearing.ball_count - passing
    lines = {"shaft": 1.0, "balls pass the outer race": passing, "the inner race": inner}
    bending = shaft_frequencies(scene)[1]  # the first is that along the axis
    map_axis.axhline(bending, color="C1", linestyle="--", linewidth=0.8)
    map_axis.annotate("shaft bends", (0.02 * rpm[-1], bending + 40.0), color="C1", fontsize=8)
    for name, order in lines.items():
        end = min(rpm[-1], UP_TO * 60.0 / order)
        map_axis.plot((rpm[0], end), (rpm[0] * order / 60.0, end * order / 60.0), "w:", linewidth=0.8)
        map_axis.annotate(name, (0.6 * end, 0.6 * end * order / 60.0), color="white", fontsize=8)
    label(map_axis, "", "frequency [Hz]", "Nose of the motor spindle, along y", grid=False)
    for found, name in ((bends, "shaft bends"), (rigid, "rigid shaft")):
        rms_axis.plot(found["rpm"][WINDOW - 1 :], rms(found), label=name)
    label(rms_axis, "speed [r/min]", "rms [mm/s]", "")
    rms_axis.legend()
    map_axis.set_xlim(0.0, rpm[-1])
    map_axis.set_ylim(0.0, UP_TO)
    figure.savefig(to, dpi=100, metadata={"Software": None})


def main(
    quick: Annotated[bool, typer.Option("--quick", help="A fifth of the time.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for table and picture.")] = Path("out/spindle_set"),
) -> None:
    """Run the motor spindle up on its own and draw the vibration of its nose."""
    with refusals():
        need("matplotlib", "the picture")
    scene, duration = read_scene(SCENE), 0.15 if quick else 0.75
    output.mkdir(parents=True, exist_ok=True)
    bends = run(scene, duration)
    stiff = {"flexible": False, "fixed_modes": None, "damping_ratio": None}
    rigid = run(scene.replace({f"spindle.shaft.{key}": value for key, value in stiff.items()}), duration)
    rows = np.column_stack([bends["rpm"][WINDOW - 1 :], rms(bends), rms(rigid)])
    head = "speed_rpm,bending_mm_s,rigid_mm_s"
    np.savetxt(output / "run_up.csv", rows[::20], "%.6g", ",", header=head, comments="")
    draw(bends, rigid, scene, output / "run_up.png")
    for name, found in (("shaft bends", bends), ("rigid shaft", rigid)):
        best = int(np.argmax(rms(found)))
        frequencies, rpm, values = over_speed(found)
        line, at = np.unravel_index(int(np.argmax(values)), values.shape)
        at_best = found["rpm"][best + WINDOW // 2]
        typer.echo(
            f"{name}: rms up to {rms(found)[best]:.2f} mm/s, at {at_best:.0f} r/min; "
            f"largest line {values[line, at]:.2f} mm/s, {frequencies[line]:.0f} Hz at {rpm[at]:.0f} r/min"
        )


if __name__ == "__main__":
    typer.run(main)
