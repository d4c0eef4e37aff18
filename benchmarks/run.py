"""Print simulated s per wall s of each fidelity beside its peers: ``python -m benchmarks.run``.

One process, one machine, one run. Timings are printed, never asserted.
"""

import argparse
import pathlib
import sys
import time

from benchmarks import bem, exudyn_peer, memory, ours, peers, sound, terms
from benchmarks.cases import CASES, GATES, QUICK, SOLVERS, Case
from benchmarks.first_order import FirstOrder
from benchmarks.fmu import calls, whole
from benchmarks.table import COLUMNS, Row, fill_ratios
from fmu_bearing.arrays import Arrays
from fmu_bearing.results import table

PEER_WINDOW = 2e-3  # s
EXUDYN_STEP = 5e-6  # s
RESULTS = pathlib.Path(__file__).parents[1] / "docs" / "results"


def machine() -> str:
    """Processor, cores and all versions that matter here."""
    names = ("SciPy", "EXUDYN", "scikit-sundae")
    return ", ".join([table.machine(), *(f"{name} {peers.version(name.lower())}" for name in names)])


def peer_rows(
    case: Case, start: Arrays, exact: ours.Reference, window: float, seconds: float, repeats: int
) -> list[Row]:
    """Rows of the peers in one case."""
    rows = []
    row = Row(case.name, "EXUDYN", f"h = {1e6 * EXUDYN_STEP:g} us", ours=False)
    if exudyn_peer.version() is None:
        row.remark = "not installed"
    else:
        run = exudyn_peer.timed(start, EXUDYN_STEP, 0.0 if case.kind == "start" else 5e-4, window)
        row.wall, row.cpu = run.simulated / run.wall, run.simulated / run.cpu
        row.remark = run.note or "own model: dry, contact angle 0, no waviness"
    rows.append(row)
    steps = max(1, round(window / ours.SAMPLE))
    problem = FirstOrder(start)
    for name, entry in peers.solvers().items():
        rows.append(
            peers.peer_row(
                case.name,
                name,
                entry,
                problem,
                exact.velocities[:steps],
                exact.times[:steps],
                ours.LIMIT,
                seconds,
                repeats,
            )  # fmt: skip
        )
    return rows


def measure(cases: tuple[Case, ...], quick: bool) -> tuple[list[Row], list[list[str]]]:
    """Rows of the main table, and one row per case on its reference."""
    budget, repeats, seconds = (0.05, 1, 5.0) if quick else (0.4, 3, 12.0)
    rows: list[Row] = []
    references = []
    for case in cases:
        begin = time.process_time()
        mine, start, exact = ours.rows_of(case, SOLVERS, budget, repeats)
        others = peer_rows(case, start, exact, PEER_WINDOW, seconds, repeats) if case.folder == GATES else []
        rows += mine + others
        references.append(
            [case.name, f"{1e3 * case.window:g} ms", f"{exact.agreement:.0e}", f"{exact.explicit_cost:.0f}",
             f"{exact.implicit_cost:.0f}"]
        )  # fmt: skip
        print(f"{case.name}: {time.process_time() - begin:.0f} s", file=sys.stderr, flush=True)
    fill_ratios(rows)
    rows.append(
        Row(
            "all",
            "the same right-hand side in C",
            remark="none: a second copy of the physics would have to be kept equal",
            ours=False,
        )
    )
    return rows, references


REFERENCE_COLUMNS = (
    "case", "window", "two integrators agree to", "CPU s per s, Runge-Kutta 40 ns", "ESDIRK4 0.5 us",
)  # fmt: skip

TEXT = """# Benchmark

{machine}

Simulated seconds per second, higher is faster, goals are met by CPU time; made by `make bench`, which
`benchmarks/README.md` explains. Best of {repeats} runs, no sound; error and speed over the same
communication steps of 0.5 ms, in the first 4 ms of 0.1 ms. Error: rms difference of the six ring velocities
to the reference over the rms of its fluctuation, over 20 ms after 50 ms of warm-up, or over the first 4 ms;
for `rings` and `response` to themselves at a quarter of the step, their speed in communication steps of 1
ms. `usual` is a tolerance of 1e-3, for which the goals were set, on gate scenes, and an example scene's own;
`fastest` the fastest within 1e-3 of {settings} settings of tolerance and step. A ratio is our speed over the
peer's in the same case and run, by CPU time, each at the error it states. EXUDYN computes another, simpler
model and has no error here. The peers' rows stand below ours; they are timed over {window:g} ms. On a
virtual machine absolute figures differ by up to 40 % from run to run; ratios within a row are surer.

"""


def report(rows: list[Row], references, costs, sizes, sounds, solved, hosts, called, repeats: int) -> str:
    """Everything as Markdown."""
    text = TEXT.format(
        machine=machine(), repeats=repeats, window=1e3 * PEER_WINDOW, settings=len(ours.SETTINGS)
    )
    text += table.markdown(COLUMNS, [row.cells() for row in rows])
    text += "\n## References\n\n" + table.markdown(REFERENCE_COLUMNS, references)
    text += "\n## Cost of terms\n\n" + table.markdown(terms.COLUMNS, costs)
    text += "\n## Memory of an instance\n\n" + table.markdown(memory.COLUMNS, sizes)
    text += "\n## Cost of sound\n\n" + table.markdown(sound.COLUMNS, sounds)
    text += "\n## Boundary elements on a ring\n\n" + table.markdown(bem.COLUMNS, solved)
    text += "\n## The same code through library and FMU\n\n" + table.markdown(whole.COLUMNS, hosts)
    return text + "\n## Calls of an FMU\n\n" + table.markdown(calls.COLUMNS, called)


def main(arguments: list[str] | None = None) -> None:
    """Run, print, and write the tables where ``--output`` says."""
    parser = argparse.ArgumentParser(prog="benchmarks", description=__doc__)
    parser.add_argument("--quick", action="store_true", help="one case, one repeat: half a minute")
    parser.add_argument("--output", type=pathlib.Path, help="directory for benchmark.md and benchmark.csv")
    given = parser.parse_args(arguments)
    rows, references = measure(QUICK if given.quick else CASES, given.quick)
    budget, repeats = (0.05, 1) if given.quick else (0.3, 3)
    costs = terms.rows("7003C-spindle", 20000.0, budget, repeats)
    if not given.quick:
        costs += terms.rows("7009C-full-ceramic", 18000.0, budget, repeats)
    sizes = memory.rows(("7003C-spindle", "7009C-full-ceramic"))
    models = ("compact",) if given.quick else ("bem", "compact", "paper", "paper_contacts")
    sounds = sound.rows("7003C-spindle", models, repeats)
    if not given.quick:
        sounds += sound.rows("7009C-full-ceramic", ("bem", "compact"), repeats)
    solved = bem.rows(given.quick)
    hosts = whole.rows(given.quick)
    called = calls.rows(given.quick)
    print(machine())
    table.show("Simulated s per wall s", COLUMNS, [row.cells() for row in rows])
    table.show("References", REFERENCE_COLUMNS, references)
    table.show("Cost of terms", terms.COLUMNS, costs)
    table.show("Memory of an instance", memory.COLUMNS, sizes)
    table.show("Cost of sound", sound.COLUMNS, sounds)
    table.show("Boundary elements", bem.COLUMNS, solved)
    table.show("The same code through library and FMU", whole.COLUMNS, hosts)
    table.show("Calls of an FMU", calls.COLUMNS, called)
    if given.output:
        given.output.mkdir(parents=True, exist_ok=True)
        text = report(rows, references, costs, sizes, sounds, solved, hosts, called, repeats)
        (given.output / "benchmark.md").write_text(text, "utf-8")
        table.write_csv(given.output / "benchmark.csv", COLUMNS, [row.cells() for row in rows])


if __name__ == "__main__":
    main()
