"""What the first sound costs by size of housing: ``python -m benchmarks.first_sound [FILE]``.

Boundary elements of the 7003C with its cage in housings, solved on one core without the cache, each in a
process of its own: processor time, memory, the estimates of the time of the rest, and the error of levels
between solved frequencies. Some five minutes of one core.
"""

import argparse
import dataclasses
import json
import os
import pathlib
import subprocess
import sys
import time
import types
from unittest.mock import patch

import numpy as np

from fmu_bearing.acoustics.filters.design import radiation_of
from fmu_bearing.acoustics.radiation.bem import band, solution as solved
from fmu_bearing.acoustics.radiation.bem.paths import task_of
from fmu_bearing.acoustics.radiation.bem.task import Task
from fmu_bearing.acoustics.radiation.radiators import Housing
from fmu_bearing.compiled.show import Display
from fmu_bearing.results.table import machine, markdown, number, write_csv
from fmu_bearing.scene import read_scene

ROOT = pathlib.Path(__file__).parents[1]
COLUMNS = (
    "housing, mm", "bands", "frequencies", "most unknowns", "CPU s", "MB", "first estimate over true",
    "least", "largest", "then off by, %", "levels, dB",
)  # fmt: skip
#: Diameter and length, mm, and whether there is a cage.
CASES = (
    (60.0, 60.0, True), (100.0, 160.0, True), (300.0, 60.0, True), (80.0, 400.0, True), (150.0, 300.0, True),
    (150.0, 300.0, False), (200.0, 400.0, True),
)  # fmt: skip
_AHEAD = 0.01  # m that a housing's front face lies ahead of the bearing's
_EARLY = 0.8  # of the time, up to which estimates are held against the true rest; then against the whole
_LEVELS = 12  # frequencies drawn in each band at which levels are compared
_HEARD = 1e-3  # of the loudest drive of a kind: weaker ones are left out
_HEAD = """# The first sound by size of housing

{machine}

Made by `python -m benchmarks.first_sound`: boundary elements of the 7003C with nine orders, on one core,
without the cache. MB: largest memory of the process, some 150 of them before it begins. Estimates: the time
of the rest that is shown over the true one, by the processor's clock, from the first frequency until
{early:.0%} of the time; then by how much of the whole time it is off. Levels: largest difference of a drive
of a body from direct solutions on the same mesh, at frequencies drawn at random.

"""


def task(diameter: float, length: float, cage: bool) -> Task:
    """Bodies of the example spindle in a housing of another size (mm)."""
    radiation = radiation_of(read_scene(ROOT / "examples" / "scenes" / "7003C-spindle.toml"))
    front = 0.5 * radiation.radiators.outer_ring.width + _AHEAD
    housing = Housing(1e-3 * diameter, 1e-3 * length, 0.5e-3 * length - front)
    radiators = dataclasses.replace(radiation.radiators, housing=housing)
    if not cage:
        radiators = dataclasses.replace(radiators, cage=None)
    return task_of(radiators, radiation.air, radiation.harmonics)


class Watched(Display):
    """Keeps when what was shown: s, part done, s of the rest."""

    kept: list[tuple[float, float, float]]

    def at(self, done: float, rest: float | None = None) -> None:
        """Show, and keep."""
        self.kept.append((time.process_time(), done, float("nan") if rest is None else rest))
        super().at(done, rest)


def estimates(shown: list[tuple[float, float, float]], begun: float, ended: float) -> list[float]:
    """First, least and largest time of the rest over the true one up to `_EARLY`; then % of the whole."""
    at, _, rest = np.array(shown).T
    true, whole = ended - at, ended - begun
    early = at - begun < _EARLY * whole
    ratio = rest[early] / true[early]
    late = 100.0 * np.abs(rest - true)[~early] / whole
    return [float(one) for one in (ratio[0], ratio.min(), ratio.max(), late.max())]


def levels(found: solved.Solution) -> float:
    """Largest difference (dB) of the bodies' drives, summed over a band, from direct solutions.

    At frequencies drawn at random, at three places beside, ahead of and behind the housing.
    """
    middle, radius = found.task.sphere()
    places = np.array([[middle, 1.3 * radius], [middle - 1.3 * radius, 0.3 * radius],
                       [middle + 1.3 * radius, 0.5 * radius]])  # fmt: skip
    draw = np.random.default_rng(3)
    worst = 0.0
    for part in found.bands:
        wanted = np.sort(draw.uniform(part.frequencies[0], part.frequencies[-1], _LEVELS))
        sounding = part._sounding(places)
        exact = np.stack([sounding(f, part.solve(f)) for f in wanted], axis=-1)
        bodies = slice(0, part.ball_drive(0, 0))
        power = [(np.abs(one[:, bodies]) ** 2).sum(axis=2) for one in (part.transfer(places, wanted), exact)]
        heard = power[1] > _HEARD**2 * power[1].max(axis=1, keepdims=True)
        worst = max(worst, float(np.abs(10.0 * np.log10(power[0][heard] / power[1][heard])).max()))
    return worst


def row(case: int) -> list[str]:
    """Return the row of one of `CASES`; what it takes is that of this process."""
    diameter, length, cage = CASES[case]
    found = solved.Solution(task(diameter, length, cage))
    Watched.kept = []
    # Other programs take turns with this one: by its processor's clock it is alone.
    alone = types.SimpleNamespace(perf_counter=time.process_time)
    with patch.multiple(solved, Display=Watched, cores=lambda: 1), patch.object(band, "time", alone):
        begun = time.process_time()
        solved._solve_all(found)
        ended = time.process_time()
    first, least, largest, late = estimates(Watched.kept, begun, ended)
    memory = _memory()
    return [
        f"d {diameter:g} x {length:g}{'' if cage else ', no cage'}", str(len(found.bands)),
        str(sum(one.done for one in found.bands)), str(max(len(one.points) for one in found.bands)),
        number(ended - begun), f"{memory:.0f}", f"{first:.2f}", f"{least:.2f}", f"{largest:.2f}",
        f"{late:.0f}", f"{levels(found):.3f}",
    ]  # fmt: skip


def _memory() -> float:
    """Largest memory of this process so far, MB; NaN on Windows."""
    try:
        import resource
    except ImportError:
        return float("nan")
    most = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
    return most / 1e6 if sys.platform == "darwin" else most / 1e3


def rows() -> list[list[str]]:
    """One row per housing, each from a process of its own."""
    found = []
    environment = os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"}
    for case in range(len(CASES)):
        command = [sys.executable, "-m", "benchmarks.first_sound", "--case", str(case)]
        made = subprocess.run(command, cwd=ROOT, env=environment, stdout=subprocess.PIPE, check=True)
        found.append(json.loads(made.stdout))
    return found


def main() -> None:
    """Print the table; write it to a file where one is named."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0] if __doc__ else None)
    parser.add_argument("file", nargs="?", type=pathlib.Path, help="where to write the table, .md and .csv")
    parser.add_argument("--case", type=int, help="number of one housing: print its row as JSON")
    given = parser.parse_args()
    if given.case is not None:
        print(json.dumps(row(given.case)))
        return
    found = rows()
    text = markdown(COLUMNS, found)
    print(text)
    if given.file is not None:
        head = _HEAD.format(machine=machine(), early=_EARLY)
        given.file.with_suffix(".md").write_text(head + text, encoding="utf-8")
        write_csv(given.file.with_suffix(".csv"), COLUMNS, found)


if __name__ == "__main__":
    main()
