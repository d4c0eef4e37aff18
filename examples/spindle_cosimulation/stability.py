"""Stability of explicit coupling of the bearing: speed and torque, heat and temperature.

``python stability.py [--quick]`` steps the bearing FMU (7003C in its spindle, fidelity ``full``,
20,000 r/min) beside

* a shaft, ``J dw/dt = drive torque - friction torque``, over communication step and inertia;
* the thermal FMU, over communication step and cooling of the oil,

with every value held over a step, as in the co-simulation. Each cell of a map is the factor by which a
disturbance changes from step to step. Between -1 and 1 it decays (below 0 with alternating sign), beyond it
grows. The script writes ``coupling.md``, ``coupling.csv`` and ``coupling.png``.

Result: with the spindle's own inertia (1.64e-4 kg m2) the disturbance decays at every step from 0.01 to
10 ms, at once. The bound of a torque that follows the speed, h < 2 J / (dT/dw), is 145 s there, because
dT/dw is only 2.3e-6 N m s. The inertia of balls and cage, Jb = 1.19e-7 kg m2, limits the coupling, because
it comes back as torque: the factor is -Jb / J, so a shaft lighter than Jb diverges at every step from 0.1 ms
on. Heat against temperature is stable at every step: the oil's cooling takes 2 to 6 times as much per kelvin
as friction heat falls.
"""

import math
import os
import tempfile
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import numpy as np
import typer
from build import best_flavour, build
from coupling import HEATS, TEMPERATURES, Fmu, SimulationError
from numpy.typing import NDArray

from fmu_bearing import build_fmu, read_scene
from fmu_bearing.cli.base import refusals
from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import empty, save
from fmu_bearing.results.table import machine, markdown, number, write_csv

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

ROOT = Path(__file__).resolve().parents[2]
SCENE = ROOT / "examples" / "scenes" / "7003C-spindle.toml"
SPEED = 20000.0 * math.pi / 30.0  # rad/s

STEPS = (1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2)  # s
INERTIAS = (3e-8, 6e-8, 1e-7, 1.5e-7, 2e-7, 4e-7, 1e-6, 1.64e-4)  # kg m2, the last is the spindle's
EXCHANGES = 24  # per cell: a factor of 1.03 a step then shows as a doubling
DISTURBANCE = 1.0  # rad/s

THERMAL_STEPS = (1e-3, 2e-3, 5e-3, 1e-2, 2e-2)  # s, with capacities a hundredth of the spindle's
COOLINGS = (1.0, 0.3, 0.1)  # of the oil's conductances
SCALE = 0.01  # of heat capacities: the oil then takes milliseconds, the bearing still settles faster
DIVERGED = 1.02  # factor per step: beyond what the measurement leaves uncertain


@dataclass(frozen=True)
class Slopes:
    """What the bearing answers to slow changes of speed.

    Attributes
    ----------
    torque : float
        Steady friction torque (N m).
    by_speed : float
        dT/dw (N m s).
    by_acceleration : float
        dT/d(dw/dt): inertia of balls and cage as the shaft feels it (kg m2).
    """

    torque: float
    by_speed: float
    by_acceleration: float

    def bound(self, inertia: float) -> float:
        """Longest stable step (s): 2 J / (dT/dw) with the inertia that is left; 0 where none is."""
        return max(0.0, 2.0 * (inertia - self.by_acceleration) / self.by_speed)

    def factor(self, step: float, inertia: float) -> float:
        """Factor per step of what alternates in ``w' = w - h/J T``, ``T = c w + Jb (w - w_before)/h``."""
        mass, rate = self.by_acceleration / inertia, step * self.by_speed / inertia
        return float(min(np.roots([1.0, mass + rate - 1.0, -mass]).real))


def settled(bearing: Fmu, speed: float) -> Any:
    """Initialise without imperfections, run 20 ms at a speed, and return the state."""
    bearing.enter_initialization(**{"shaft_speed": speed, "imperfection.scale": 0.0})
    bearing.exit_initialization()
    for k in range(20):
        bearing.step(k * 1e-3, 1e-3)
    return bearing.keep()


def slopes(bearing: Fmu, state: Any) -> Slopes:
    """Measure torque at speeds 2 % apart, and on a ramp of 2000 rad/s2."""
    torque, means = bearing.reader(["friction_torque"]), []
    for change in (-0.02, 0.02):
        bearing.put_back(state)
        bearing.set({"shaft_speed": SPEED * (1.0 + change)})
        for k in range(20):
            bearing.step(0.02 + k * 1e-3, 1e-3)
        means.append(torque()[0])
    by_speed = (means[1] - means[0]) / (0.04 * SPEED)
    bearing.put_back(state)
    steady, rate, h, ramp = torque()[0], 2000.0, 1e-4, []
    for k in range(100):
        bearing.set({"shaft_speed": SPEED + rate * h * (k + 1)})
        bearing.step(0.02 + k * h, h)
        ramp.append((torque()[0] - steady - by_speed * rate * h * (k + 1)) / rate)
    return Slopes(steady, by_speed, float(np.mean(ramp[50:])))


def factor_of(values: Sequence[float]) -> float:
    """Factor by which increments change from one to the next, over the largest of them."""
    steps = np.diff(values)
    last = max(3, int(np.argmax(np.abs(steps))) + 1)  # what grows, to where it is largest
    first, second = steps[: last - 1], steps[1:last]
    return float(first @ second / max(first @ first, 1e-300))


def shaft(bearing: Fmu, state: Any, drive: float, step: float, inertia: float, taken: float = 0.0) -> float:
    """Let a disturbed shaft and the bearing exchange speed and torque; return the factor per step.

    ``taken``: inertia (kg m2) of the bearing that the shaft's equation takes over, so that the torque is left
    without it.
    """
    bearing.put_back(state)
    torque = bearing.reader(["friction_torque"])
    speeds = [SPEED, SPEED + DISTURBANCE]
    for k in range(EXCHANGES):
        try:
            bearing.set({"shaft_speed": speeds[-1]})
            bearing.step(0.02 + k * step, step)
        except SimulationError:
            break  # the speed left the range, or changed faster than the model follows
        rest = torque()[0] - taken * (speeds[-1] - speeds[-2]) / step
        speeds.append(speeds[-1] + step / (inertia + taken) * (drive - rest))
        if abs(speeds[-1] - SPEED) > 0.3 * SPEED:
            break
    return factor_of(speeds)


def warm(bearing: Fmu, state: Any, network: Path, step: float, cooling: float) -> tuple[float, float]:
    """Let bearing and thermal network exchange heats and temperatures.

    Returns the factor per step, and dQ/dT of the oil over its conductance where it ends.
    """
    bearing.put_back(state)
    with Fmu(network, "thermal") as thermal:
        oil = [name for name in thermal.variables if name.startswith("conductance.") and "oil" in name]
        values = {name: cooling * thermal.start(name) for name in oil}
        conductance = sum(values.values())
        for name in thermal.variables:
            if name.startswith("capacity."):
                values[name] = SCALE * thermal.start(name)
        thermal.enter_initialization(**values)
        thermal.exit_initialization()
        read, heats = thermal.reader(TEMPERATURES), bearing.reader(HEATS)
        history = [read()[0]]
        for k in range(EXCHANGES):
            bearing.set(dict(zip(TEMPERATURES, read(), strict=True)))
            bearing.step(0.02 + k * step, step)
            thermal.set(dict(zip(HEATS, heats(), strict=True)))
            thermal.step(k * step, step)
            history.append(read()[0])
    return factor_of(history), _by_temperature(bearing, state, history[-1]) / conductance


def _by_temperature(bearing: Fmu, state: Any, temperature: float) -> float:
    """Fall of the oil's heat with its temperature (W/K)."""
    found = []
    for change in (-2.0, 2.0):
        bearing.put_back(state)
        bearing.set({"oil_temperature": temperature + change})
        for k in range(10):
            bearing.step(0.02 + k * 1e-3, 1e-3)
        found.append(bearing.get(["heat.oil"])[0])
    return (found[0] - found[1]) / 4.0


@dataclass(frozen=True)
class Maps:
    """What was measured: factors by inertia and step, by cooling and step."""

    slopes: Slopes
    steps: Sequence[float]
    inertias: Sequence[float]
    torque: NDArray[np.float64]
    taken_over: NDArray[np.float64]
    thermal_steps: Sequence[float]
    coolings: Sequence[float]
    heat: NDArray[np.float64]
    ratios: NDArray[np.float64]


def measure(bearing: Fmu, network: Path, quick: bool) -> Maps:
    """Fill both maps; ``quick``: a few cells of each."""
    state = settled(bearing, SPEED)
    slope = slopes(bearing, state)
    steps, inertias = (STEPS[2:5], INERTIAS[1::3]) if quick else (STEPS, INERTIAS)
    times, coolings = (THERMAL_STEPS[:2], COOLINGS[:1]) if quick else (THERMAL_STEPS, COOLINGS)
    torque = [[shaft(bearing, state, slope.torque, h, j) for h in steps] for j in inertias]
    mass = slope.by_acceleration
    taken = [[shaft(bearing, state, slope.torque, h, j, mass) for h in steps] for j in inertias]
    warmed = np.array([[warm(bearing, state, network, h, g) for h in times] for g in coolings])
    return Maps(
        slope, steps, inertias, np.array(torque), np.array(taken), times, coolings,
        warmed[:, :, 0], warmed[:, -1, 1],
    )  # fmt: skip


def page(maps: Maps, picture: str) -> str:
    """Write what was measured, beside what the formulas say, as Markdown."""
    c, mass = maps.slopes.by_speed, maps.slopes.by_acceleration
    head = ["J, kg m2", *(f"h = {1e3 * h:g} ms" for h in maps.steps), "-Jb/J", "2 (J - Jb)/c"]

    def rows(found: NDArray[np.float64]) -> list[list[str]]:
        return [
            [f"{j:.2g}", *(_cell(f) for f in row), f"{-mass / j:.2f}", _seconds(maps.slopes.bound(j))]
            for j, row in zip(maps.inertias, found, strict=True)
        ]

    warm_head = ["oil's cooling", *(f"h = {h / SCALE:g} s" for h in maps.thermal_steps), "r = (dQ/dT)/G"]
    warm_rows = [
        [f"{g:g}", *(_cell(f) for f in row), f"{ratio:.2f}"]
        for g, row, ratio in zip(maps.coolings, maps.heat, maps.ratios, strict=True)
    ]
    return PAGE.format(
        torque=1e3 * maps.slopes.torque, c=c, mass=mass, table=markdown(head, rows(maps.torque)),
        taken=markdown(head[:-2], [row[:-2] for row in rows(maps.taken_over)]),
        heat=markdown(warm_head, warm_rows), picture=picture, machine=machine(), exchanges=EXCHANGES,
        disturbance=DISTURBANCE,
    )  # fmt: skip


def _cell(factor: float) -> str:
    return f"**{factor:.2f}**" if abs(factor) > DIVERGED else f"{factor:.2f}"


def _seconds(bound: float) -> str:
    return f"{number(bound)} s" if bound > 0.0 else "none"


PAGE = """# Explicit coupling of the bearing: stability

{machine}

Written by `examples/spindle_cosimulation/stability.py`. The 7003C in its spindle runs with fidelity `full` at
20,000 r/min, without imperfections, so that no ripple hides the disturbance. All values are held over a
communication step h. Each number is the factor by which the increments of a disturbance change from one step
to the next, over {exchanges} steps. Between -1 and 1 the disturbance decays, with alternating sign where the
number is negative. **Bold** numbers mean that it grows.

![Factors over step and inertia, over step and cooling]({picture})

## Speed and torque

The master integrates `J dw/dt = T_drive - T` with the torque of the last step.
It starts {disturbance:g} rad/s away from the equilibrium, at a torque of {torque:.2f} N mm.
Two values were measured on the bearing alone: c = dT/dw = {c:.2g} N m s (between speeds 4 % apart), and
Jb = {mass:.3g} kg m2, the inertia that balls and cage add while the speed changes (on a ramp of
2000 rad/s2).

{table}
With T = T0 + c (w - w0) the factor is 1 - h c / J, and the bound is h < 2 J / c. The bearing's torque also
holds Jb dw/dt, and an explicit exchange returns this part a step late. The increments then change by -Jb / J,
whatever the step, and the bound falls to h < 2 (J - Jb) / c. **A shaft is safe when its inertia exceeds
that of balls and cage**, preferably by a few times; the spindle of the scene has 1400 times as much.
Steps up to 0.1 ms are milder than the formula, because the balls do not follow at once. Steps of 10 ms are a
fifth harsher.
Fidelity `rings` moves balls and cage kinematically, so their inertia is not in its torque.

Where a shaft must be lighter, let its equation take over Jb: `(J + Jb) dw/dt = T_drive - (T - Jb a)`, with
the acceleration a of the last step. The same cells are then:

{taken}
## Heat and temperature

The thermal FMU gets the heats of the step and returns temperatures for the next step. Its capacities are a
hundredth of the spindle's, and so are the steps. This leaves the factors unchanged and keeps the runs short.
The table names the real steps. The first column multiplies the oil's conductances (1.53 W/K).

{heat}
For one lump of capacity C and conductance G, the factor is e - (1 - e) r, with e = exp(-h G / C) and r the
fall of heat with temperature over G. Where r < 1, as here, no step is too long for stability. Where r > 1 the
bound is h < C / G ln((r + 1) / (r - 1)). Accuracy needs shorter steps: a fifth of the fastest lump's C / G,
which is 0.05 s for this oil.
"""


def cells(maps: Maps) -> list[list[str]]:
    """Every cell of both maps as a row of the CSV file."""
    rows = []
    for j, row, taken in zip(maps.inertias, maps.torque, maps.taken_over, strict=True):
        for h, factor, other in zip(maps.steps, row, taken, strict=True):
            predicted = maps.slopes.factor(h, j)
            rows.append(["torque", f"{h:g}", f"{j:g}", f"{factor:.4g}", f"{predicted:.4g}", f"{other:.4g}"])
    for g, row, ratio in zip(maps.coolings, maps.heat, maps.ratios, strict=True):
        for h, factor in zip(maps.thermal_steps, row, strict=True):
            rows.append(["heat", f"{h / SCALE:g}", f"{g:g}", f"{factor:.4g}", f"r = {ratio:.3g}", ""])
    return rows


COLUMNS = ("coupling", "step_s", "inertia_kg_m2_or_cooling", "factor", "predicted", "factor_taken_over")


def draw(maps: Maps) -> "Figure":
    """Both maps side by side, with the inertia of balls and cage as a line."""
    figure = empty((11.0, 4.6))
    left, right = figure.subplots(1, 2, width_ratios=(3, 2))
    _panel(left, [1e3 * h for h in maps.steps], maps.inertias, maps.torque)
    mass = maps.slopes.by_acceleration
    place = np.interp(math.log(mass), np.log(maps.inertias), np.arange(len(maps.inertias)))
    left.axhline(float(place), color="black", linewidth=2.0)
    left.annotate(
        f"Jb = {mass:.2g} kg m2", (len(maps.steps) - 0.45, place), annotation_clip=False, fontsize=8
    )
    left.set(xlabel="communication step h, ms", ylabel="inertia of the shaft J, kg m2")
    left.set_title("speed and torque")
    _panel(right, [h / SCALE for h in maps.thermal_steps], maps.coolings, maps.heat)
    right.set(xlabel="communication step h, s", ylabel="cooling of the oil, relative")
    right.set_title("heat and temperature")
    title = "factor of a disturbance from step to step; beyond 1 (red) it grows; 7003C, 20,000 r/min"
    figure.suptitle(title, fontsize=10)
    return figure


def _panel(ax: "Axes", steps: Sequence[float], others: Sequence[float], factors: NDArray[np.float64]) -> None:
    norm = need("matplotlib.colors", "the picture").TwoSlopeNorm(vcenter=1.0, vmin=0.0, vmax=2.0)
    ax.imshow(np.abs(factors), cmap="RdBu_r", norm=norm, alpha=0.8, aspect="auto", origin="lower")
    for (row, column), factor in np.ndenumerate(factors):
        ax.annotate(f"{factor:.2f}", (column, row), ha="center", va="center", fontsize=8)
    ax.set_xticks(range(len(steps)), [f"{step:g}" for step in steps])
    ax.set_yticks(range(len(others)), [f"{other:.2g}" for other in others])


def main(
    quick: Annotated[bool, typer.Option("--quick", help="A few cells, to see that it works.")] = False,
    results: Annotated[Path, typer.Option(help="Folder for table and page.")] = Path("out/coupling"),
    images: Annotated[
        Path | None, typer.Option(help="Folder for the picture; default: that of the page.")
    ] = None,
) -> None:
    """Measure where explicit coupling settles, and write page, table and picture."""
    with refusals():  # before minutes of computing
        need("matplotlib", "the picture")
    # finer than the default of 2e-3: the torque has to follow small increments of speed
    scene = read_scene(SCENE).replace({"sound": None, "fidelity.tolerance": 1e-3})
    with tempfile.TemporaryDirectory() as place:
        network = build(Path(__file__).with_name("thermal.py"), Path(place), best_flavour())
        with Fmu(build_fmu(scene, Path(place) / "Bearing7003C.fmu").path, "bearing") as bearing:
            maps = measure(bearing, network, quick)
    results.mkdir(parents=True, exist_ok=True)
    picture = (images or results) / "coupling.png"
    text = page(maps, Path(os.path.relpath(picture, results)).as_posix())
    (results / "coupling.md").write_text(text, encoding="utf-8")
    write_csv(results / "coupling.csv", COLUMNS, cells(maps))
    save(draw(maps), picture)
    typer.echo(text)


if __name__ == "__main__":
    typer.run(main)
