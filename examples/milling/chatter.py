"""A spindle's FMU in a loop with the cutting force of an end mill, below and above the limit of stability.

``python chatter.py [--short]`` takes 7003C-QBC-end-mill.toml with its tool as the first sections of a shaft
that bends (of the shaft's steel), finds the limit of the axial depth at the scene's speed by `lobes`,
builds the FMU and runs it with 0.7 and 1.3 of that depth. Each communication step the force of every tooth
follows from the chip between the tip and the surface that earlier teeth left; a tooth that leaves the cut
has no force. Writes ``chatter.csv`` and ``chatter.png``.

A stable cut repeats with every tooth: the tip is at the same place whenever a tooth has the same angle.
What is left of that, over the feed per tooth, is printed, with the frequency at which the tip moves beside
those of the teeth. The force is that of the middle of a step, from place and velocity at its beginning: a
force a step late would feed the vibration.

Result: with 0.7 of the limit places differ by 0.0002 of the feed after 0.2 s, with 1.3 by a quarter of it
and growing, at the frequency that `lobes` names.
"""

import math
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from sys import path
from typing import Annotated

import numpy as np
import typer
from numpy.typing import NDArray

from fmu_bearing import Scene, build_fmu, lobes, read_scene
from fmu_bearing.cli.base import refusals
from fmu_bearing.compiled import BuildError
from fmu_bearing.extras import need
from fmu_bearing.machining.zero_order import angles
from fmu_bearing.results.picture_parts import empty
from fmu_bearing.results.table import write_csv

HERE = Path(__file__).resolve().parent
path.insert(0, str(HERE.parent / "spindle_cosimulation"))
from coupling import Fmu, SimulationError  # noqa: E402

SCENE = HERE / "7003C-QBC-end-mill.toml"
FEED = 50e-6  # m per tooth
SHARES = (0.7, 1.3)  # of the limit
STEPS = 80  # of a tooth period
LONG, SHORT = 0.3, 0.1  # s
PLACES = [f"shaft.nose.displacement.{axis}" for axis in "yz"]
RATES = [f"shaft.nose.velocity.{axis}" for axis in "yz"]
Vector = NDArray[np.float64]


def with_tool_in_shaft(scene: Scene) -> Scene:
    """Return a scene whose shaft begins with its tool and holder, so that its nose is the tip."""
    assert scene.spindle is not None and scene.tool is not None
    holder = scene.tool.holder.sections_mm if scene.tool.holder else ()
    ahead = [list(row) for row in (*scene.tool.sections_mm, *holder)]
    length = sum(row[0] for row in ahead)
    rows = [list(row) for row in scene.spindle.shaft.sections_mm]
    moved = {
        f"spindle.bearing[{k}].position_mm": one.position_mm + length
        for k, one in enumerate(scene.spindle.bearing, start=1)
    }
    keys = {"tool": None, "spindle.shaft.sections_mm": ahead + rows, "spindle.shaft.unbalance": []}
    return scene.replace(keys | moved | {"spindle.load": {}})


@dataclass
class Teeth:
    """Teeth and the surface that they leave, in axes u along the feed and v, from which they turn to u.

    ``surface``: m, of what stands out at each angle, in the axes of the tool, to which the feed moves it.
    """

    scene: Scene
    depth: float

    def __post_init__(self) -> None:
        cut = self.scene.milling
        assert cut is not None
        self.count, self.ratio = cut.teeth, cut.radial_ratio
        self.stiffness = 1e6 * cut.cutting_coefficient_N_mm2 * self.depth
        self.begin, self.end = angles(cut.radial_immersion, cut.direction)
        feed, sign = math.radians(cut.feed_angle_deg), math.copysign(1.0, self.scene.operation.speed_rpm)
        c, s = math.cos(feed), math.sin(feed)
        self.axes = np.array([[-s, c], [sign * c, sign * s]])  # u, v of y, z
        self.surface = np.zeros(STEPS * self.count)

    def force(self, step: int, place: Vector) -> Vector:
        """Return the force y, z (N) on a tip at ``place`` (y, z: m) in the middle of a step."""
        u, v = self.axes @ place
        total = np.zeros(2)
        for tooth in range(self.count):
            k = (step + tooth * STEPS) % self.surface.size
            p = 2.0 * math.pi * (k + 0.5) / self.surface.size
            if not self.begin <= p <= self.end:
                continue
            s, c = math.sin(p), math.cos(p)
            out = s * u + c * v
            left = self.surface[k] - FEED * s
            self.surface[k] = max(left, out)
            chip = out - left
            if chip > 0.0:
                total += self.stiffness * chip * np.array([-c - self.ratio * s, s - self.ratio * c])
        return np.asarray(self.axes.T @ total)


def step_of(scene: Scene) -> float:
    """Return the communication step (s)."""
    assert scene.milling is not None
    return 60.0 / (scene.milling.teeth * abs(scene.operation.speed_rpm)) / STEPS


def run(fmu: Fmu, scene: Scene, depth: float, duration: float) -> Vector:
    """Return places y, z of the tip (m) from that without a cut, a row per communication step."""
    teeth = Teeth(scene, depth)
    h = step_of(scene)
    fmu.enter_initialization()
    fmu.exit_initialization()
    places, rates = fmu.reader(PLACES), fmu.reader(RATES)
    read: Callable[[], tuple[Vector, Vector]] = lambda: (np.array(places()), np.array(rates()))  # noqa: E731
    rest, _ = read()
    found = np.empty((round(duration / h), 2))
    for step in range(len(found)):
        place, rate = read()
        found[step] = place - rest
        force = teeth.force(step, found[step] + 0.5 * h * rate)
        fmu.set({"nose.force.y": float(force[0]), "nose.force.z": float(force[1])})
        fmu.step(step * h, h)
    return found


def spread(places: Vector) -> tuple[float, float]:
    """Return how far places at one angle of the teeth are apart (rms) over the feed: middle, last third."""
    rows = places[: len(places) // STEPS * STEPS].reshape(-1, STEPS, 2)
    third = len(rows) // 3
    thirds = rows[third : 2 * third], rows[2 * third :]
    middle, last = (float(np.sqrt(part.var(axis=0).sum(axis=1).mean())) / FEED for part in thirds)
    return middle, last


def frequency(places: Vector, h: float) -> float:
    """Return the frequency (Hz) at which the tip moves most in the last half, lines of the teeth left out."""
    half = places[len(places) // 2 :, 0]
    half = half[: len(half) // STEPS * STEPS]
    size = np.abs(np.fft.rfft((half - half.mean()) * np.hanning(len(half)))) ** 2
    lines = np.arange(len(size))
    per_tooth = len(half) // STEPS  # of the bins
    size[np.abs(lines - np.round(lines / per_tooth) * per_tooth) <= 3] = 0.0
    return float(np.argmax(size) / (len(half) * h))


def draw(runs: dict[float, Vector], h: float, to: Path) -> None:
    """Draw the tip over time, and once per tooth as dots."""
    figure = empty((9.0, 5.6))
    panels = figure.subplots(len(runs), 1, sharex=True)
    for ax, (share, places) in zip(panels, runs.items(), strict=True):
        time = 1e3 * h * np.arange(len(places))
        ax.plot(time, 1e6 * places[:, 0], lw=0.4, color="0.6")
        ax.plot(time[::STEPS], 1e6 * places[::STEPS, 0], ".", ms=3, color="#0072B2", label="once per tooth")
        ax.set_title(f"{share:g} of the limit")
        ax.set_ylabel("tip along Y, um")
        ax.legend(loc="upper right", frameon=False)
    panels[-1].set_xlabel("time, ms")
    figure.savefig(to, dpi=100, metadata={"Software": None})


def main(
    short: Annotated[bool, typer.Option("--short", help="0.1 s in the place of 0.3 s.")] = False,
    output: Annotated[Path, typer.Option(help="Folder for FMU, table and picture.")] = Path("out/milling"),
) -> None:
    """Run the spindle's FMU with a cutting force below and above the limit."""
    with refusals():
        need("matplotlib", "the picture")
        scene = with_tool_in_shaft(read_scene(SCENE))
        rpm = scene.operation.speed_rpm
        limit = lobes(scene, [rpm]).own
    h = step_of(scene)
    output.mkdir(parents=True, exist_ok=True)
    rows, runs = [], {}
    try:
        built = Path(build_fmu(scene.replace({"milling": None}), output / "end_mill.fmu").path)
        for share in SHARES:
            with Fmu(built, "spindle") as fmu:
                runs[share] = run(fmu, scene, share * limit.depth, SHORT if short else LONG)
            numbers = *spread(runs[share]), frequency(runs[share], h)
            texts = [f"{value:{form}}" for value, form in zip(numbers, (".4f", ".4f", ".0f"), strict=True)]
            rows.append([f"{share:g}", f"{1e3 * share * limit.depth:.3f}", *texts])
    except (OSError, BuildError, SimulationError) as error:
        typer.echo(f"error: {error}", err=True)
        raise typer.Exit(2) from None
    write_csv(
        output / "chatter.csv", ["share", "depth_mm", "middle_third", "last_third", "frequency_Hz"], rows
    )
    draw(runs, h, output / "chatter.png")
    typer.echo(f"limit {1e3 * limit.depth:.3f} mm at {rpm:,.0f} r/min, chatters at {limit.frequency:.0f} Hz")
    for share, depth, middle, last, hertz in rows:
        words = f"places differ by {middle}, later by {last} of the feed; {hertz} Hz"
        typer.echo(f"{share} of it, {depth} mm: {words}")


if __name__ == "__main__":
    typer.run(main)
