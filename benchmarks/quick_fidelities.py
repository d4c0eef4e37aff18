"""Fidelities `rings` and `response` beside `full` on fresh scenes. ``python -m benchmarks.quick_fidelities``

Parts (``--what``): ``grid``, every size of the catalogue at three speeds and three preload classes;
``lightest``, the same at the extra light class; ``drawn``, 200 bearings from boundary dimensions; ``time``,
cases in which `rings` grew and a sample of the grid, with `full`; ``radial``, ten bearings under radial
loads, with `full`. Scenes are those of ``scene new --no-sound --kind hybrid``. Rows are written to WHAT.csv
of the folder as they come, and a run that was interrupted goes on from them. WHAT.md lists what is bad, and
how ratios are distributed.
"""

import argparse
import csv
import io
import time
import warnings
from collections.abc import Callable, Iterable, Sequence
from concurrent.futures import ProcessPoolExecutor
from contextlib import ExitStack
from dataclasses import dataclass
from functools import partial
from multiprocessing import get_context
from pathlib import Path
from typing import Any

import numpy as np

from fmu_bearing import Dimensions, Scene, modes, new_scene, simulate, with_fidelity
from fmu_bearing.engine.sources import source_hash
from fmu_bearing.results.table import machine, markdown, number, write_csv
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.preload import classes

SPEEDS = (0.63e6, 1.08e6, 1.62e6)  # n d_m, mm r/min
CLASSES, LIGHTEST = ("light", "medium", "heavy"), ("extra light",)  # as of `scene new --preload-class`
LOADS = (0.0, 0.5, 1.0, 2.0)  # radial load over preload
DRAWN, RADIAL = 200, 10  # bearings
FIDELITIES = ("full", "rings", "response")
AXES = ("x", "y", "z")
PAIRS = (("rings", "response"), ("rings", "full"), ("response", "full"))
FAR = 3.0  # ratio of rms velocities beyond which a scene is bad (chosen)
STEP = 5e-5  # s: communication step, at whose end velocities are read
HIGHEST, LOWEST = 30e3, 100.0  # Hz: modes that are looked at; slower ones belong to the mounting
MOVES = 0.05  # of the kinetic energy: with less of it in the rings, a mode is one of the balls alone
BORES = (15.0, 30.0, 50.0, 80.0)  # mm
#: Outside diameters and widths, mm, at these bores (ISO 15); between them they are in proportion.
SERIES = {
    "70": ((32.0, 55.0, 80.0, 125.0), (9.0, 13.0, 16.0, 22.0)),
    "72": ((35.0, 62.0, 90.0, 140.0), (11.0, 16.0, 20.0, 26.0)),
    "79": ((28.0, 47.0, 72.0, 110.0), (7.0, 9.0, 12.0, 16.0)),
}
#: Bearing, r/min, preload (N): found in a scan of the grid, restarts every 4 to 8 ms in `rings`.
GREW: tuple[tuple[str | Dimensions, float, float], ...] = (
    ("NSK-7014C", 18_000.0, 290.0), ("NSK-7012C", 20_900.0, 200.0), ("NSK-7013C", 19_600.0, 250.0),
    ("NSK-7913C", 20_900.0, 150.0), ("NSK-7911C", 24_000.0, 120.0), ("NSK-7006AC", 25_400.0, 290.0),
    ("NSK-7909AC", 28_700.0, 340.0), ("NSK-7011AC", 14_900.0, 340.0), ("NSK-7912AC", 14_900.0, 200.0),
    (Dimensions(70.0, 100.0, 16.0, 15.0), 16_000.0, 200.0),
)  # fmt: skip


@dataclass(frozen=True)
class Plan:
    """Fidelities that are run, for how long, and over which last part velocities are read (s)."""

    fidelities: tuple[str, ...]
    seconds: float
    window: float


PLANS = {
    "grid": Plan(("rings", "response"), 0.04, 0.03),
    "lightest": Plan(("rings", "response"), 0.04, 0.03),
    "drawn": Plan(("rings", "response"), 0.04, 0.03),
    "time": Plan(FIDELITIES, 0.15, 0.1),
    "radial": Plan(FIDELITIES, 0.08, 0.06),
}

COLUMNS = (
    "scene", "r/min", "preload, N", "radial load, N", "steady", "growth, 1/s", "at, Hz", "mode",
    "growth of all, 1/s",
    *(f"restarts of {one}" for one in FIDELITIES),
    *(f"{one} {axis}, mm/s" for one in FIDELITIES for axis in AXES),
    *(f"{one}/{other} {axis}" for one, other in PAIRS for axis in AXES),
    *(f"{one}, CPU s" for one in FIDELITIES), "remark", "engine",
)  # fmt: skip

_HEAD = """Made by `python -m benchmarks.quick_fidelities --what {what}{options}`: scenes of `scene new
--no-sound --kind hybrid`, rings and surfaces as it writes them (P4, seed 1). Runs of {seconds:g} ms, rms
velocities of the inner ring about their mean over the last {window:g} ms, read every {step:g} us; CPU seconds
are of the steps alone. *Growth*: the largest of modes at {lowest:g} Hz to {highest:g} kHz in which rings have
{moves:g} % of the energy, as `modes` gives it; *growth of all*: with the balls' own. *Bad* are scenes with
restarts, or with an rms velocity of `rings` above {far:g} times that of `response` or of `full`.
"""


@dataclass(frozen=True)
class Case:
    """A bearing at a speed (r/min); its preload by class, in N, or (``times_light``) over the light class."""

    name: str
    bearing: str | Dimensions
    rpm: float
    preload_class: str | None = None
    force: float | None = None
    times_light: float | None = None
    load: float = 0.0  # radial load over preload
    kind: str = "hybrid"

    def scene(self) -> Scene:
        """Return the scene as ``scene new`` writes it, without sound."""
        force = self.force
        if self.times_light is not None:
            found = classes(self._read(1.0).bearing)
            assert found is not None  # 15 and 25 deg have classes
            force = float(f"{self.times_light * found.loads['light']:.3g}")
        scene = self._read(force)
        radial = self.load * scene.mounted.preload_N
        return scene.replace({"mounting.radial_load_y_N": radial}) if radial else scene

    def _read(self, force: float | None) -> Scene:
        text = new_scene(
            self.name, self.bearing, speed_rpm=self.rpm, preload_N=force, sound=False,
            preload_class=self.preload_class, kind=self.kind,
        )  # fmt: skip
        return read_scene_text(text, self.name)


def speed(speed_number: float, pitch: float) -> float:
    """Return the speed (r/min, three digits) of n d_m (mm r/min) at a pitch diameter (mm)."""
    return float(f"{speed_number / pitch:.3g}")


def grid(preloads: Sequence[str] = CLASSES) -> list[Case]:
    """Return every size of the catalogue at each speed and each of some preload classes."""
    return [
        Case(f"{name}-{rpm:.0f}-{own.replace(' ', '-')}", name, rpm, own)
        for name, size in sizes().items()
        for rpm in (speed(one, size.pitch) for one in SPEEDS)
        for own in preloads
    ]


def drawn(count: int, seed: int) -> list[Case]:
    """Return bearings from boundary dimensions at each speed; all draws begin with the same bearings."""
    rng = np.random.default_rng(seed)
    found = []
    for k in range(count):
        series = str(rng.choice(list(SERIES)))
        bore, angle = float(rng.integers(15, 81)), float(rng.choice([15.0, 25.0]))
        outside, width = (round(2.0 * float(np.interp(bore, BORES, one))) / 2.0 for one in SERIES[series])
        for one in SPEEDS:
            rpm, times = speed(one, 0.5 * (bore + outside)), float(np.exp(rng.uniform(*np.log([0.5, 3.0]))))
            name = f"{k:03d}-{series}-{bore:g}x{outside:g}x{width:g}-{angle:g}-{rpm:.0f}-{times:.2f}"
            found.append(Case(name, Dimensions(bore, outside, width, angle), rpm, times_light=times))
    return found


def grew() -> list[Case]:
    """Return the cases in which `rings` grew."""
    names = [one if isinstance(one, str) else f"{one.bore:g}x{one.outside:g}" for one, _, _ in GREW]
    return [
        Case(f"{name}-{rpm:.0f}-{force:g}", bearing, rpm, force=force)
        for name, (bearing, rpm, force) in zip(names, GREW, strict=True)
    ]


def radial(share: float, seed: int) -> list[Case]:
    """Return bearings of the catalogue, evenly spread and of both angles, under each radial load."""
    names, apart = list(sizes()), len(sizes()) // RADIAL
    found = [(names[apart * k + k % 2], CLASSES[k % len(CLASSES)]) for k in range(RADIAL)]
    return [
        Case(f"{name}-{rpm:.0f}-{own}-{load:g}", name, rpm, own, load=load)
        for name, own in sampled(found, share, seed)
        for rpm in (speed(one, sizes()[name].pitch) for one in SPEEDS)
        for load in LOADS
    ]


def sampled(cases: list[Any], share: float, seed: int) -> list[Any]:
    """Return a share of cases, drawn, in their order; at least one."""
    count = max(1, round(share * len(cases)))
    places = np.random.default_rng(seed).permutation(len(cases))[:count]
    return [cases[k] for k in sorted(places)]


def cases(what: str, share: float, seed: int) -> list[Case]:
    """Return the cases of a part."""
    if what == "drawn":
        return drawn(max(1, round(share * DRAWN)), seed)
    if what == "radial":
        return radial(share, seed)
    found = sampled(grid(LIGHTEST if what == "lightest" else CLASSES), share, seed)
    return grew() + found if what == "time" else found


def growth(scene: Scene) -> dict[str, str]:
    """Return the cells about the growth of modes."""
    found = modes(scene)
    seen = [one for one in (*found.modes, *found.apart) if LOWEST < one.frequency <= HIGHEST]
    cells = {"steady": "yes" if found.linearised.steady else "no"}
    cells["growth of all, 1/s"] = f"{max(one.growth for one in seen):.4g}"
    most = max((one for one in seen if one.ring_share > MOVES), key=lambda one: one.growth)
    cells |= {"growth, 1/s": f"{most.growth:.4g}", "at, Hz": f"{most.frequency:.0f}", "mode": most.label}
    return cells


def motion(scene: Scene, fidelity: str, plan: Plan) -> tuple[np.ndarray, float, float]:
    """Return rms velocities of the inner ring (mm/s), the number of restarts, CPU seconds of the steps."""
    clock: list[float] = []
    names = [f"inner_ring.velocity.{axis}" for axis in AXES]
    run = simulate(
        with_fidelity(scene, model=fidelity), plan.seconds, step=STEP, outputs=[*names, "solver.restarts"],
        progress=False, watch=lambda _: clock.append(time.process_time()),
    )  # fmt: skip
    if run.ended == "interrupted":
        raise KeyboardInterrupt
    if not run.complete:
        raise ValueError(run.note)
    last = np.array([run[name][-round(plan.window / STEP) :] for name in names])
    return 1e3 * last.std(axis=1), float(run["solver.restarts"][-1]), clock[-1] - clock[0]


def row_of(case: Case, plan: Plan) -> dict[str, str]:
    """Return the cells of one case; what is refused leaves its cells empty, with a remark."""
    row = dict.fromkeys(COLUMNS, "") | {"scene": case.name, "r/min": f"{case.rpm:g}", "engine": source_hash()}
    remarks, rms = [], {}
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        try:
            scene = case.scene()
            row["preload, N"] = f"{scene.mounted.preload_N:g}"
            row["radial load, N"] = f"{scene.mounted.radial_load_y_N:g}"
            row |= growth(scene)
        except ValueError as problem:
            return row | {"remark": f"no scene, or no modes: {problem}"}
        for one in plan.fidelities:
            try:
                rms[one], restarts, cpu = motion(scene, one, plan)
            except ValueError as problem:
                remarks.append(f"{one}: {problem}")
                continue
            row |= {f"restarts of {one}": f"{restarts:.0f}", f"{one}, CPU s": f"{cpu:.4f}"}
            row |= {f"{one} {axis}, mm/s": f"{value:.5g}" for axis, value in zip(AXES, rms[one], strict=True)}
    for one, other in PAIRS:
        if one in rms and other in rms:
            ratios = zip(AXES, rms[one] / np.maximum(rms[other], 1e-12), strict=True)
            row |= {f"{one}/{other} {axis}": f"{value:.4g}" for axis, value in ratios}
    return row | {"remark": "; ".join(remarks)}


def kept(path: Path) -> list[dict[str, str]]:
    """Return the rows that a file has whole; those of another engine or of other columns are refused."""
    if not path.exists():
        return []
    text = path.read_text("utf-8")
    reader = csv.DictReader(io.StringIO(text[: text.rfind("\n") + 1]))
    rows = list(reader)
    if tuple(reader.fieldnames or ()) != COLUMNS or any(row["engine"] != source_hash() for row in rows):
        raise SystemExit(f"{path} was not made by engine {source_hash()}: give another --output")
    return rows


def measured(chosen: Sequence[Case], plan: Plan, path: Path, jobs: int) -> list[dict[str, str]]:
    """Return the rows of all cases; those that the file lacks are computed and added to it as they come."""
    found = {row["scene"]: row for row in kept(path)}
    write_csv(path, COLUMNS, [list(row.values()) for row in found.values()])  # whole lines only
    missing = [case for case in chosen if case.name not in found]
    with path.open("a", newline="", encoding="utf-8") as file, ExitStack() as stack:
        run: Callable[..., Iterable[dict[str, str]]] = map
        if jobs > 1:
            run = stack.enter_context(ProcessPoolExecutor(jobs, mp_context=get_context("spawn"))).map
        writer = csv.DictWriter(file, COLUMNS, lineterminator="\n")
        for k, row in enumerate(run(partial(row_of, plan=plan), missing)):
            writer.writerow(row)
            file.flush()
            found[row["scene"]] = row
            print(k + 1, "of", len(missing), row["scene"], *faults(row), row["remark"], flush=True)
    return [found[case.name] for case in chosen]


def faults(row: dict[str, str]) -> list[str]:
    """Return what is bad of a row, in words."""
    found = [f"{one} restarts {n}" for one in FIDELITIES if (n := row[f"restarts of {one}"]) not in ("", "0")]
    for other in ("response", "full"):
        ratios = [float(value) for axis in AXES if (value := row[f"rings/{other} {axis}"])]
        if ratios and not max(ratios) <= FAR:
            found.append(f"rings/{other} {max(ratios):.3g}")
    return found


def distribution(rows: Iterable[dict[str, str]], plan: Plan) -> str:
    """Return a table of the ratios: median, 5 and 95 %, least and most."""
    lines, given = [], list(rows)
    for one, other in PAIRS:
        for axis in AXES:
            values = [float(row[key]) for row in given if row[key := f"{one}/{other} {axis}"]]
            if values and {one, other} <= set(plan.fidelities):
                spread = np.quantile(values, (0.5, 0.05, 0.95, 0.0, 1.0))
                lines.append([f"{one}/{other} {axis}", str(len(values)), *map(number, spread.tolist())])
    return markdown(("ratio of rms", "scenes", "median", "5 %", "95 %", "least", "most"), lines)


def page(what: str, rows: Sequence[dict[str, str]], plan: Plan, options: str) -> str:
    """Return counts, the list of bad scenes, and the distribution of ratios."""
    bad = [row for row in rows if faults(row)]
    fine = [row for row in rows if not faults(row) and not row["remark"]]
    above = sum(any("/" in one for one in faults(row)) for row in rows)
    restarted = sum(any("restarts" in one for one in faults(row)) for row in rows)
    whirl = sum(float(row["growth, 1/s"] or 0.0) > 0.0 for row in rows)
    keys = ["scene", "preload, N", "radial load, N", "growth, 1/s", "at, Hz"]
    keys += [f"{one} {axis}, mm/s" for one in plan.fidelities for axis in AXES]
    listed = [[*(row[key] for key in keys), ", ".join(faults(row))] for row in bad]
    head = _HEAD.format(
        what=what, options=options, seconds=1e3 * plan.seconds, window=1e3 * plan.window, step=1e6 * STEP,
        lowest=LOWEST, highest=1e-3 * HIGHEST, moves=100.0 * MOVES, far=FAR,
    )  # fmt: skip
    used = ((one, sum(float(row[f"{one}, CPU s"] or 0.0) for row in rows)) for one in plan.fidelities)
    cpu = ", ".join(f"{one} {seconds:.1f}" for one, seconds in used)
    refused = [[row["scene"], row["remark"]] for row in rows if row["remark"]]
    return (
        f"# Quick fidelities: {what}\n\n{machine()}\n\n{head}\n{len(rows)} scenes, {len(refused)} with a "
        f"refusal; {len(bad)} are bad: {above} above {FAR:g} times, {restarted} with restarts. Of {whirl} "
        f"a mode of the rings grows. CPU s of all runs: {cpu}.\n\n## Bad scenes\n\n"
        f"{markdown((*keys, 'bad'), listed)}\n## Ratios of all scenes\n\n{distribution(rows, plan)}\n"
        f"## Ratios of scenes that are not bad\n\n{distribution(fine, plan)}\n"
        f"## Refused\n\n{markdown(('scene', 'why'), refused)}"
    )


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure a part, or the rest of it, and write its rows and its page."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--what", choices=list(PLANS), required=True)
    parser.add_argument("--output", type=Path, required=True, help="folder for WHAT.csv and WHAT.md")
    parser.add_argument("--share", type=float, help="of the scenes, in (0, 1]; default: 1, of time 0.05")
    parser.add_argument("--seed", type=int, default=1, help="of draws and samples")
    parser.add_argument("--jobs", type=int, default=1, help="processes")
    given = parser.parse_args(arguments)
    what, share = given.what, given.share
    share = (0.05 if what == "time" else 1.0) if share is None else share
    if not 0.0 < share <= 1.0 or given.jobs < 1 or given.seed < 0 or given.output.is_file():
        parser.error("--share must be in (0, 1], --jobs >= 1, --seed >= 0, --output a folder")
    given.output.mkdir(parents=True, exist_ok=True)
    rows = measured(cases(what, share, given.seed), PLANS[what], given.output / f"{what}.csv", given.jobs)
    text = page(what, rows, PLANS[what], f" --share {share:g} --seed {given.seed}")
    (given.output / f"{what}.md").write_text(text, "utf-8")


if __name__ == "__main__":
    main()
