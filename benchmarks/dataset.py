"""Processor seconds of a labelled second of a data set, by fidelity. ``python -m benchmarks.dataset [FILE]``

Runs of a 6205 with a load across, each of a speed and surfaces of its own, as workers make them: record,
waveforms at another rate, labels, file. Fidelities take turns, so that what else the machine does meets all;
figures are medians.
"""

import argparse
import statistics
import tempfile
import time
from pathlib import Path

from fmu_bearing import new_scene
from fmu_bearing.dataset import lay_out, read_plan
from fmu_bearing.dataset.run import run
from fmu_bearing.dataset.store import Runs
from fmu_bearing.results.table import machine, markdown, write_csv

COLUMNS = ("fidelity", "sensors", "CPU s per labelled second", "of full")
ROUNDS = 5
FIDELITIES = ("full", "rings")
#: What is kept of a run.
SENSORS = {
    "one acceleration": ("outer_ring.acceleration.z",),
    "one acceleration, one microphone": ("outer_ring.acceleration.z", "top"),
}
_PLAN = """scene = "6205.toml"
runs = {rounds}
length_s = {length}
sensors = {sensors}
[draw]
speed = "1000:3000"
"mounting.radial_load_z_N" = "-1000:-100log"
"imperfections.seed" = "1:2147483647"
"fidelity.model" = "{fidelity}"
"sound.radiation_model" = "compact"
[[class]]
name = "healthy"
share = 1
"""
_HEAD = """Made by `python -m benchmarks.dataset`: medians of {rounds} runs of {length:g} s at 25,600 Hz after
0.1 s, a steel 6205 at 1,000 to 3,000 r/min with 100 to 1,000 N across, kernels at hand, on one core.
Fidelities took turns while other work ran beside: the ratio is good to some 10 %, the seconds to a factor of
two."""


def measured(rounds: int = ROUNDS, length: float = 1.0) -> list[list[str]]:
    """Return a row per fidelity and choice of sensors."""
    rows = []
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "6205.toml").write_text(new_scene("6205", "6205", speed_rpm=1797.0), "utf-8")
        store = Runs(folder)
        for words, sensors in SENSORS.items():
            layouts = {}
            for fidelity in FIDELITIES:
                filled = {"rounds": rounds, "length": length, "sensors": list(sensors), "fidelity": fidelity}
                (folder / "plan.toml").write_text(_PLAN.format(**filled), "utf-8")
                layouts[fidelity] = lay_out(read_plan(folder / "plan.toml"))
                run(layouts[fidelity].tasks[0])  # kernels and transfer functions
            spent: dict[str, list[float]] = {fidelity: [] for fidelity in FIDELITIES}
            for k in range(rounds):
                for fidelity, layout in layouts.items():
                    begin = time.process_time()
                    store.keep(layout.tasks[k], run(layout.tasks[k]))
                    spent[fidelity].append((time.process_time() - begin) / length)
            middle = {fidelity: statistics.median(values) for fidelity, values in spent.items()}
            for fidelity, value in middle.items():
                rows.append([fidelity, words, f"{value:.2f}", f"{value / middle['full']:.2f}"])
    return rows


def main() -> None:
    """Print the table, or write it as Markdown and CSV."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("file", nargs="?", type=Path, help="Markdown file; the CSV lies beside it")
    asked = parser.parse_args()
    rows = measured()
    head = _HEAD.format(rounds=ROUNDS, length=1.0)
    page = "\n\n".join(["# Cost of a labelled second", machine(), head, markdown(list(COLUMNS), rows)])
    if asked.file is None:
        print(page)
        return
    asked.file.write_text(page, "utf-8")
    write_csv(asked.file.with_suffix(".csv"), list(COLUMNS), rows)


if __name__ == "__main__":
    main()
