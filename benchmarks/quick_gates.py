"""Rings in fidelities `rings` and `response` over those in `full`. ``python -m benchmarks.quick_gates``

Parts (``--what``): ``drawn``, bearings of the catalogue at drawn speeds and preloads, with surfaces of grade
P4 and, perfect, after a kick of the inner ring; ``terms``, contact damping, clearances of the cage's lands,
fits, sets, from the gate scenes. Runs of 0.15 s beside those of `full`. Rows are printed and written to
WHAT.csv of the folder.
"""

import argparse
import warnings
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from functools import partial
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

from benchmarks.quick_fidelities import grew
from fmu_bearing import Scene, new_scene, read_scene, simulate, with_fidelity
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import H, L, Q, S, Y
from fmu_bearing.engine.spindle import members
from fmu_bearing.modal.campbell.doubts import doubt, is_of_levels
from fmu_bearing.results.table import write_csv
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.preload import classes

ROOT = Path(__file__).parents[1]
GATES, SETS = ROOT / "tests" / "scenes" / "gates", ROOT / "examples" / "spindle_set"
QUICK = ("rings", "response")
SECONDS, START, STEP = 0.15, 0.05, 2.5e-5  # s: of a run, of its first part that is left out, between samples
KICK = 1e-3  # m/s: at 1 kHz a tenth of the contacts' approach at light preload
SCALES = (1.0, 0.1)  # of the imperfections of a scene
SEEN = 0.1  # of the largest rms in `full`: smaller ones are left out
CLASSES = ("extra light", "light", "medium", "heavy")
HALF = "half"  # of the lightest class
SPEEDS = (0.4e6, 1.6e6)  # n d_m, mm r/min: least and most
#: Tighter than as drawn: a shaft's seat by 4 um; the housing's slides.
FIT = {"shaft": {"interference_um": 4.0}, "housing": {"interference_um": -4.0}}


@dataclass(frozen=True)
class Ratio:
    """Rms of one motion in `full` (m/s), and that of a quick fidelity over it."""

    name: str
    full: float
    ratio: float


def names_of(scene: Scene) -> list[str]:
    """Return the outputs that are read: velocities of all rings, tilts of inner rings."""
    count = 0 if scene.spindle is None else len(scene.spindle.bearing)
    first = [f"bearing[{k + 1}]." for k in range(count)] or [""]
    rings = [f"{ring}_ring.velocity.{axis}" for ring in ("inner", "outer") for axis in "xyz"]
    return [f"{one}{name}" for one in first for name in (*rings, "inner_ring.tilt.y", "inner_ring.tilt.z")]


def rates(scene: Scene, values: NDArray[np.float64], step: float) -> NDArray[np.float64]:
    """Return velocities (m/s), by columns as `names_of`: tilts as rates at the pitch radius."""
    tilts = [k for k, name in enumerate(names_of(scene)) if ".tilt." in name]
    found = values.copy()
    radius = 0.5e-3 * scene.bearing.pitch_diameter_mm
    found[:, tilts] = radius * np.gradient(values[:, tilts], step, axis=0)
    return found


def motion(scene: Scene, model: str, seconds: float = SECONDS, scale: float = 1.0) -> NDArray[np.float64]:
    """Return rms velocities (m/s), as `rates`, about their mean over a run but its first `START`.

    ``scale``: of the imperfections.
    """
    names = names_of(scene)
    run = simulate(
        with_fidelity(scene, model=model), seconds, step=STEP, outputs=names, progress=False,
        start_values=None if scale == 1.0 else {"imperfection.scale": scale},
    )  # fmt: skip
    if not run.complete:
        raise ValueError(run.note)
    values = np.array([run[name] for name in names]).T
    return rates(scene, values, STEP)[round(START / STEP) :].std(axis=0)


def ratios(scene: Scene, full: NDArray[np.float64], quick: NDArray[np.float64]) -> list[Ratio]:
    """Return the ratios of motions that count in `full`."""
    found = zip(names_of(scene), full, quick, strict=True)
    return [Ratio(name, one, other / one) for name, one, other in found if one >= SEEN * full.max() > 0.0]


def farthest(found: Sequence[Ratio]) -> tuple[float, float]:
    """Return the least and the largest ratio."""
    return min(one.ratio for one in found), max(one.ratio for one in found)


@dataclass(frozen=True)
class Drawn:
    """A bearing of the catalogue at a speed; its preload by class, or half of the lightest."""

    bearing: str
    rpm: float
    preload: str

    def scene(self) -> Scene:
        """Return the hybrid bearing as ``scene new`` writes it, without sound."""
        if self.preload != HALF:
            return self._read(preload_class=self.preload)
        found = classes(self._read(preload_N=1.0).bearing)
        assert found is not None  # 15 and 25 deg have classes
        return self._read(preload_N=float(f"{0.5 * found.loads[CLASSES[0]]:.3g}"))

    def _read(self, **preload: Any) -> Scene:
        name = f"{self.bearing}-{self.rpm:.0f}-{self.preload.replace(' ', '-')}"
        text = new_scene(
            name, self.bearing, speed_rpm=self.rpm, sound=False, kind="hybrid", **preload,
        )  # fmt: skip
        return read_scene_text(text, name)


def drawn(count: int, seed: int) -> list[Drawn]:
    """Return bearings of 15 and 25 degrees in turns, two at a class and two at half of the lightest."""
    rng, found = np.random.default_rng(seed), []
    by_angle = [[name for name in sizes() if name.endswith("AC") == steep] for steep in (False, True)]
    for k in range(count):
        name = str(rng.choice(by_angle[k % 2]))
        rpm = float(f"{rng.uniform(*SPEEDS) / sizes()[name].pitch:.3g}")
        preload = str(rng.choice(CLASSES))
        found.append(Drawn(name, rpm, preload if k // 2 % 2 == 0 else HALF))
    return found


def kicked(scene: Scene, model: str, cage: bool, seconds: float = SECONDS) -> NDArray[np.float64]:
    """Return rms velocities (m/s), as `motion`, of the perfect single bearing after a kick of its inner ring.

    The kick is `KICK` along x and y, and at the pitch radius about z. There is no weight, for what it moves
    goes on; with a ``cage`` the forces of its whirl in `full` go on, too.
    """
    perfect = with_fidelity(scene.model_copy(update={"imperfections": None}), model=model)
    run = Arrays.of(perfect if cage else cageless(perfect), GRAVITY=0.0)
    run.init()
    radius = 0.5e-3 * scene.bearing.pitch_diameter_mm
    for place, kick in ((Q.X, KICK), (Q.Y, KICK), (Q.INNER_BZ, KICK / radius)):
        run.s[S.Y + Y.V0 + Q.INNER + place] += kick
        if model == "rings":
            march = members.set_state(run.p, run.s)[members.history(run.p) :]
            march[H.V0 * L.COLUMN + place] += kick
    rows = np.empty((round(seconds / STEP), Q.RINGS))
    for row in rows:
        run.step(STEP)
        row[:] = run.s[S.Y + Y.V0 : S.Y + Y.V0 + Q.RINGS]
    rows[:, Q.INNER_BY : Q.INNER_BZ + 1] *= radius
    places = [Q.X, Q.Y, Q.Z, *(Q.OUTER + k for k in (Q.X, Q.Y, Q.Z)), Q.INNER_BY, Q.INNER_BZ]
    return np.asarray(np.sqrt((rows[:, places] ** 2).mean(axis=0)))


def cageless(scene: Scene) -> Scene:
    """Return the scene without a cage."""
    return scene.replace({"bearing.cage": None, "materials.cage": None})


def terms() -> Iterator[tuple[str, Scene]]:
    """Yield what is varied and its scene, silent: of gate scenes and examples that no version has changed."""
    spindle = silent(read_scene(GATES / "7003C-spindle.toml"))
    for name in ("7003C-bare", "7009C-full-ceramic"):
        scene = silent(read_scene(GATES / f"{name}.toml"))
        for damping in (0.5, 2.5, 10.0):
            yield (
                f"{name}, contact damping {damping:g} us",
                scene.replace({"bearing.contact_damping_us": damping}),
            )
    for damping in (0.5, 2.5, 10.0):
        changed = spindle.replace({"bearing.contact_damping_us": damping})
        yield f"7003C-spindle, contact damping {damping:g} us", changed
    for clearance in (0.03, 0.1, 0.3):
        changed = spindle.replace({"bearing.cage.land_clearance_mm": clearance})
        yield f"7003C-spindle, land clearance {clearance:g} mm", changed
    for clearance in (0.03, 0.1, 0.3):
        mounting = {"tilt_support": None, "housing": None, "pedestal_stiffness_N_m": 2.6e6}
        soft = spindle.model_copy(update={"mounting": spindle.mounting.model_copy(update=mounting)})
        soft = soft.replace({"operation.speed_rpm": 28e3, "bearing.cage.land_clearance_mm": clearance})
        yield f"beside the rotor's mode (467 Hz, pedestal 2.6e6 N/m), land clearance {clearance:g} mm", soft
    yield from _sets(spindle)


def _sets(single: Scene) -> Iterator[tuple[str, Scene]]:
    """Yield fits and sets."""
    yield "7003C-spindle, fits", single.replace({"mounting.fit": FIT})
    waves = single.imperfections
    assert waves is not None
    waves = waves.model_copy(update={"unbalance_um": 0.0})
    pair = silent(read_scene(SETS / "7003C-DB.toml")).model_copy(update={"imperfections": waves})
    four = silent(read_scene(SETS / "7003C-QBC.toml"))
    places = ((40.0, "+x"), (52.0, "+x"), (90.0, "-x"))
    rows = [{"position_mm": place, "carries": way} for place, way in places]
    for name, scene in (("DB", pair), ("TBT", pair.replace({"spindle.bearing": rows})), ("QBC", four)):
        for bends in (False, True):
            changed = scene.replace({"spindle.shaft.flexible": bends})
            yield f"{name} of 7003C, {'bending' if bends else 'rigid'} shaft", changed
    housing = FIT["housing"] | {"outside_diameter_mm": 60.0}
    yield "DB of 7003C, fits", pair.replace({"spindle.fit": FIT | {"housing": housing, "preload": "mounted"}})
    for preload in (60.0, 500.0):
        loads = {"spindle.load.force_x_N": 0.0, "spindle.load.force_z_N": 0.0}
        loads |= {"operation.speed_rpm": 20e3, "spindle.preload.preload_N": preload}
        for damping in (0.5, 2.5):
            changed = pair.replace(loads | {"bearing.contact_damping_us": damping})
            yield f"DB of 7003C, {preload:g} N, contact damping {damping:g} us", changed


def silent(scene: Scene) -> Scene:
    """Return the scene without sound, with rigid rings: both quick fidelities refuse bending ones."""
    return scene.with_rigid_rings().model_copy(update={"sound": None})


def said(scene: Scene, model: str) -> str:
    """Return what is in doubt of a quick fidelity, in a word; empty: nothing."""
    text = doubt(with_fidelity(scene, model=model))
    if not text or is_of_levels(text):
        return "levels" if text else ""
    return "velocities" if "are in doubt" in text else "all"


def rows_of_terms() -> Iterator[list[str]]:
    """Yield what is varied, then, at each of `SCALES`, the least and the largest ratio of either fidelity."""
    for what, scene in terms():
        cells = [what]
        for scale in SCALES:
            full = motion(scene, "full", scale=scale)
            cells.append(f"{1e3 * full.max():.3g}")
            for model in QUICK:
                cells += ends(scene, full, motion(scene, model, scale=scale))
        yield cells


def rows_of_drawn(count: int, seed: int) -> Iterator[list[str]]:
    """Yield the rows of drawn bearings; one of which there is no scene is left out."""
    for one in drawn(count, seed):
        try:
            scene = one.scene()
            full = motion(scene, "full")
        except ValueError as problem:
            print(one, problem)
            continue
        cells = [scene.name, f"{scene.mounted.preload_N:g}", f"{1e3 * full.max():.3g}"]
        for model in QUICK:
            cells += [said(scene, model), *ends(scene, full, motion(scene, model))]
        for cage in (False, True):
            cells += ends(scene, kicked(scene, "full", cage), kicked(scene, "rings", cage))
        bare = cageless(scene)
        yield cells + ends(bare, motion(bare, "full"), motion(bare, "rings"))


def rows_of_grew() -> Iterator[list[str]]:
    """Yield the rows of cases in which `rings` once grew: motion across the axis, what it consists of."""
    for case in grew():
        scene = case.scene()
        perfect, bare = scene.replace({"imperfections": None}), cageless(scene)
        cells = [scene.name, said(scene, "rings")]
        for one, scale in ((scene, 1.0), (scene, 0.1), (perfect, 1.0), (bare, 1.0), (bare, 0.1)):
            full = motion(one, "full", scale=scale)[1]
            cells.append(f"{1e3 * full:.3g}")
            if one is not perfect:
                cells += [f"{motion(one, model, scale=scale)[1] / full:.3f}" for model in QUICK]
        yield cells


def ends(scene: Scene, full: NDArray[np.float64], quick: NDArray[np.float64]) -> list[str]:
    """Return the cells of the least and the largest ratio."""
    return [f"{one:.3f}" for one in farthest(ratios(scene, full, quick))]


def columns(what: str) -> list[str]:
    """Return the columns of a part."""
    both = [f"{model} {end}" for model in QUICK for end in ("least", "most")]
    if what == "terms":
        tenth = [f"a tenth: {one}" for one in ("full, mm/s", *both)]
        return ["scene", "full, mm/s", *both, *tenth]
    if what == "grew":
        found = ["scene", "in doubt"]
        for part in ("", "a tenth: ", "perfect: ", "without cage: ", "without cage, a tenth: "):
            found += [f"{part}{model}" for model in ("full, mm/s", *(QUICK if part != "perfect: " else ()))]
        return found
    found = ["scene", "preload, N", "full, mm/s"]
    found += [f"{model} {cell}" for model in QUICK for cell in ("in doubt", "least", "most")]
    parts = ("kicked without cage: ", "kicked: ", "without cage: ")
    return found + [f"{one}rings {end}" for one in parts for end in ("least", "most")]


def main(arguments: Sequence[str] | None = None) -> None:
    """Measure a part and write its rows."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("--what", choices=["drawn", "grew", "terms"], required=True)
    parser.add_argument("--output", type=Path, required=True, help="folder for WHAT.csv")
    parser.add_argument("--count", type=int, default=64, help="of drawn bearings")
    parser.add_argument("--seed", type=int, default=52, help="of draws")
    given = parser.parse_args(arguments)
    rows = {
        "drawn": partial(rows_of_drawn, given.count, given.seed), "grew": rows_of_grew, "terms": rows_of_terms
    }[given.what]()  # fmt: skip
    given.output.mkdir(parents=True, exist_ok=True)
    found = []
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        for row in rows:
            print(*row, sep=" | ", flush=True)
            found.append(row)
    write_csv(given.output / f"{given.what}.csv", columns(given.what), found)


if __name__ == "__main__":
    main()
