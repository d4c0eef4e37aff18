"""What fidelities and settings cost and miss over scenes, speeds and loads: ``python -m benchmarks.scenes``.

Every setting is held against fidelity ``full`` with short steps (`REFERENCE`). Levels, velocities and torques
stand as differences with their sign, so that a page can say which way a fidelity errs. Some minutes of one
core, boundary elements of the scenes not counted.
"""

import argparse
import pathlib
from contextlib import suppress
from dataclasses import dataclass

from benchmarks.cases import EXAMPLES, GATES
from fmu_bearing.arrays import EngineError
from fmu_bearing.prepare.sound_block import sound_blocks
from fmu_bearing.results.table import machine, markdown, number, write_csv
from fmu_bearing.run.metrics import Figures, Measured, measure, of_kind
from fmu_bearing.run.settings import Setting
from fmu_bearing.scene import Scene, read_scene

REFERENCE = Setting(tolerance=1e-5, max_step=4e-6)
SETTINGS = (Setting(), Setting(tolerance=1e-3, max_step=10e-6), Setting("rings"), Setting("response"))
WARM_UP, WINDOW = 0.05, 0.1  # s
COLUMNS = (
    "scene", "r/min", "radial, N", "fidelity", "tolerance", "max step, us", "inner ring", "outer ring",
    "load", "torque", "loudest, dB(A)", "quietest, dB(A)", "sim/CPU",
)  # fmt: skip


@dataclass(frozen=True)
class Case:
    """A scene at a speed (r/min) under a radial load (N), of one of the two folders of scenes."""

    scene: str
    rpm: float
    radial: float = 0.0
    folder: pathlib.Path = EXAMPLES

    def read(self) -> Scene:
        """Return the scene with rigid rings, which all fidelities have; gate scenes without sound."""
        found = read_scene(self.folder / f"{self.scene}.toml").with_rigid_rings()
        if self.folder == GATES:
            found = found.model_copy(update={"sound": None})
        return found.replace({"operation.speed_rpm": self.rpm, "mounting.radial_load_y_N": self.radial})

    @property
    def name(self) -> str:
        """Name of the scene; gate scenes, whose balls are round, say so."""
        return f"gate {self.scene}" if self.folder == GATES else self.scene


_SPEEDS = {
    "7003C-spindle": (5e3, 10e3, 12e3, 20e3, 30e3),
    "7003C-bare": (5e3, 10e3, 20e3),
    "7009C-full-ceramic": (9e3, 12e3, 15e3, 18e3),
    "7009C-steel": (6e3, 9e3, 12e3),
}
CASES = (
    *(Case(scene, rpm) for scene, speeds in _SPEEDS.items() for rpm in speeds),
    *(Case("7003C-spindle", 20e3, radial) for radial in (300.0, 1000.0)),
    *(
        Case(scene, rpm, folder=GATES)
        for scene, rpm in (
            ("7003C-bare", 10e3), ("7003C-bare", 20e3), ("7003C-spindle", 12e3), ("7003C-spindle", 20e3),
            ("7009C-full-ceramic", 9e3), ("7009C-full-ceramic", 18e3),
        )
    ),
)  # fmt: skip


def off(value: float, true: float) -> str:
    """Relative difference in per cent, with its sign."""
    return f"{100.0 * (value / true - 1.0):+.2f} %"


def cells(case: Case, setting: Setting, found: Measured | None, truth: Figures) -> list[str]:
    """One line of the table; ``found`` is None where the engine refused."""
    tolerance, step = ("", "")
    if setting.fidelity == "full":
        tolerance, step = f"{setting.tolerance:g}", f"{1e6 * setting.max_step:g}"
    begin = [case.name, f"{case.rpm:,.0f}", f"{case.radial:g}", setting.fidelity, tolerance, step]
    if found is None:
        return [*begin, "refused", *[""] * (len(COLUMNS) - len(begin) - 1)]
    own = found.figures

    def pairs(end: str) -> list[tuple[float, float]]:
        return list(zip(of_kind(own, end), of_kind(truth, end), strict=True))

    levels, sound = [(true, value - true) for value, true in pairs(".leq_a")], ["", ""]
    if levels:
        sound = [f"{max(levels)[1]:+.2f}", f"{min(levels)[1]:+.2f}"]
    loads = [a / b - 1.0 for a, b in pairs(".load_mean")]
    return [
        *begin, *(f"{a / b:.3f}" for a, b in pairs("_ring.velocity")),
        f"{100.0 * max(loads, key=abs):+.2f} %", off(own["friction_torque"], truth["friction_torque"]),
        *sound, number(found.paces.constant),
    ]  # fmt: skip


def rows_of(case: Case, budget: float, warm_up: float = WARM_UP, window: float = WINDOW) -> list[list[str]]:
    """Lines of one case."""
    scene = case.read()
    sounds = sound_blocks(scene)
    truth = measure(REFERENCE.scene(scene), sounds, warm_up, window).figures
    rows = []
    for setting in SETTINGS:
        found: Measured | None = None
        with suppress(EngineError):
            found = measure(setting.scene(scene), sounds, warm_up, window, budget=budget)
        rows.append(cells(case, setting, found, truth))
    return rows


_PAGE = """# Fidelities over scenes, speeds and loads

{machine}

Made by `python -m benchmarks.scenes`. Figures over {window:g} ms after {warm_up:g} ms, rings rigid, against
fidelity `full` with steps up to {step:g} us at a tolerance of {tolerance:g}: ratio of the rms velocity of
each ring, difference of the mean load at the worse race, of the mean friction torque, and of the A-weighted
level at the loudest and at the quietest microphone. Speeds are simulated seconds per second of the processor,
settled, without sound. Gate scenes have round balls.

{table}"""


def page(rows: list[list[str]]) -> str:
    """Return the table as a page."""
    return _PAGE.format(
        machine=machine(), window=1e3 * WINDOW, warm_up=1e3 * WARM_UP, step=1e6 * REFERENCE.max_step,
        tolerance=REFERENCE.tolerance, table=markdown(COLUMNS, rows),
    )  # fmt: skip


def main() -> None:
    """Print the table, or write it to the folder that is named."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--output", type=pathlib.Path, help="folder for scenes.md and scenes.csv")
    given = parser.parse_args()
    rows = [row for case in CASES for row in rows_of(case, 0.3)]
    if given.output is None:
        print(page(rows))
        return
    (given.output / "scenes.md").write_text(page(rows), encoding="utf-8")
    write_csv(given.output / "scenes.csv", COLUMNS, rows)


if __name__ == "__main__":
    main()
