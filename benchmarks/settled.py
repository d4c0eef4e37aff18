"""Runs of `full` against the steady operating point. ``python -m benchmarks.settled [FILE]``

The bearings are chosen by a rule, see `cases`: every third one of the catalogue, which makes 20, and two
sizes beyond it. Each is a fresh scene, as ``scene new`` writes it, and the same without its tilt support,
where more rings whirl by themselves. Surfaces are perfect, weight is on, as in a fresh scene.
"""

import argparse
import math
import time
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from fmu_bearing.design.heat import ARISES, Heat, heat_of
from fmu_bearing.design.operating_point import OperatingPoint, operating_point
from fmu_bearing.design.rating import speed_limit
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import P, S
from fmu_bearing.engine.steady.point import EVEN_BALLS, NOT_FOUND, REST, WHIRL
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.progress import silent
from fmu_bearing.results.table import machine, markdown, write_csv
from fmu_bearing.scene import Scene, read_scene_text
from fmu_bearing.scene.member import still_of
from fmu_bearing.scene.nsk import sizes
from fmu_bearing.scene.template import Dimensions, new_scene

NEAR = 0.02  # of the torque: what the point is asked for
_SAME = 0.5  # of the frequency: that of the NSK-7913AC grows with its size from 877 to 1,170 Hz
_VERDICTS = ("agrees", "named", "other", "unsteady", "weight", "missed")
_SHARES = (0.2, 0.35, 0.5, 0.65, 0.8)  # of makers' n d_m with oil, which holds on springs
_CLASSES = ("light", "medium", "heavy")
_KINDS = ("hybrid", "steel")
#: ISO 15, dimension series 10, beyond the catalogue.
_LARGER = {"7016C": (80.0, 125.0, 22.0, 15.0), "7020AC": (100.0, 150.0, 24.0, 25.0)}
_STEP, _SAMPLE, _MEAN = 1e-3, 1e-4, 0.1  # s: communication steps, those that are averaged, for how long
_OWN, _ELSEWHERE = 0.2, 0.6  # s: runs from the point, and from the quasi-static state
_NO_FIDELITY = -1.0  # the engine then settles nothing at the start
_STATES = {NOT_FOUND: "not found", EVEN_BALLS: "balls even", REST: "cage rests", WHIRL: "cage whirls"}
COLUMNS = (
    "bearing", "kind", "tilt support", "r/min", "n d_m, 1e6", "preload, N", "point", "growth, 1/s", "at, Hz",
    "torque of the point, N mm", "of full", "ratio", "cage speed", "ratio from elsewhere",
    "cage speed from elsewhere", "ratio without weight", *(f"{one}, W" for one in ARISES), "ring, um",
    "from elsewhere, um", "turns at, Hz", "verdict", "CPU s",
)  # fmt: skip

_HEAD = f"""Made by `python -m benchmarks.settled`, one process. Bearings are chosen by a rule and not by
their result: every third of the catalogue's, in its order, and two sizes of ISO 15 beyond it. In turns they
are hybrid and steel (two each), of light, medium and heavy preload class, at
{", ".join(map(str, _SHARES))} of makers' n d_m with oil. Scenes are those of `scene new --bearing NAME --kind
KIND --preload-class CLASS --speed RPM` (of the two larger ones with `--bore`, `--outside`, `--width`,
`--contact-angle`), with their tilt support and without it; weight on, surfaces perfect, speed constant.

* *Point* is what `operating_point` and `info` give; *growth* and *at*: of the whirl that they name, where a
  mode of the rings grows.
* *Of full*: mean of the last {1e3 * _MEAN:g} ms of a run of {1e3 * _OWN:g} ms from the state it starts in,
  which is the point. *Ratio* and *cage speed* are of full over the point.
* *From elsewhere*: the same of the last {1e3 * _MEAN:g} of {1e3 * _ELSEWHERE:g} ms from the quasi-static
  state without cage.
* *Without weight*: the ratio of a run from the point, both without weight, where no whirl is named.
* *Sliding, rolling, cage, drag*: heat of the point / of the run from it.
* *Ring*: rms of the inner ring's path across the axis about its mean, in both runs; *turns at*: where most
  of it is in the second, negative against the shaft.
* *Verdict*: *agrees* where both torques are within {100 * NEAR:g} % of the point's. Else *named*: the point
  names a whirl, and the ring turns forward at {1.0 - _SAME:g} to {1.0 + _SAME:g} of its frequency; *other*:
  it names one, and the ring turns otherwise; *unsteady*: it says that it found no steady state; *weight*: it
  says nothing, and agrees without weight; *missed*: it says nothing, and weight is not the reason.
"""


@dataclass(frozen=True)
class Case:
    """A bearing, its kind of materials, preload class, and speed as a share of makers' n d_m."""

    name: str
    bearing: str | Dimensions
    kind: str
    preload_class: str
    share: float

    def scene(self, supported: bool = True) -> Scene:
        """Return the fresh scene; ``supported``: with its tilt support."""
        draft = self._at(1e3)
        limit = speed_limit(draft)
        assert limit is not None  # rings of steel, 15 or 25 deg
        found = self._at(float(f"{self.share * limit / draft.bearing.pitch_diameter_mm:.3g}"))
        return found if supported else found.replace({"mounting.tilt_support": None})

    def _at(self, rpm: float) -> Scene:
        text = new_scene(
            self.name, self.bearing, kind=self.kind, speed_rpm=rpm, preload_N=0.0,
            preload_class=self.preload_class, sound=False,
        )  # fmt: skip
        return read_scene_text(text, self.name)


def cases() -> tuple[Case, ...]:
    """Return every third bearing of the catalogue in its order, then the two beyond it.

    By their number from 0: each third preload class, each fifth speed, and two hybrid before two of steel. So
    both angles have both kinds, and all classes and speeds.
    """
    chosen: list[tuple[str, str | Dimensions]] = [(name, name) for name in list(sizes())[::3]]
    chosen += [(name, Dimensions(*size)) for name, size in _LARGER.items()]
    return tuple(
        Case(name, bearing, _KINDS[k // 2 % 2], _CLASSES[k % 3], _SHARES[k % 5])
        for k, (name, bearing) in enumerate(chosen)
    )


@dataclass(frozen=True)
class Means:
    """Of a run's last part: torque (N m), cage speed over the shaft's, heat (W), and how the ring moves.

    ``ring``: m, rms of the inner ring's path across the axis; ``turns``: Hz, where most of it is, negative
    against the shaft.
    """

    torque: float
    cage: float
    heat: Heat
    ring: float
    turns: float


@dataclass(frozen=True)
class Compared:
    """A scene's point, with the state that ``full`` starts in and its cage speed, and means of two runs.

    ``weightless``: torque of full over the point's without weight; NaN where the point names a whirl.
    """

    case: Case
    point: OperatingPoint
    state: int
    cage: float
    own: Means
    elsewhere: Means
    weightless: float
    cpu: float

    @property
    def ratios(self) -> tuple[float, float]:
        """Torques of both runs over the point's."""
        torque = self.point.bearings[0].friction_torque
        return self.own.torque / torque, self.elsewhere.torque / torque

    @property
    def verdict(self) -> str:
        """Whether both torques agree; if not, whether the point said so."""
        if max(abs(ratio - 1.0) for ratio in self.ratios) <= NEAR:
            return "agrees"
        if not self.point.steady:
            return "unsteady"
        if self.point.whirl is not None:
            frequency, _ = self.point.whirl
            return "named" if abs(self.elsewhere.turns - frequency) <= _SAME * frequency else "other"
        return "weight" if abs(self.weightless - 1.0) <= NEAR else "missed"

    def cells(self) -> list[str]:
        """Texts in the order of `COLUMNS`."""
        scene, (one,), whirl = self.point.scene, self.point.bearings, self.point.whirl
        heats = [f"{getattr(one.heat, key):.3g} / {getattr(self.own.heat, key):.3g}" for key in ARISES]
        return [
            self.case.name, self.case.kind, "no" if scene.mounted.tilt_support is None else "yes",
            f"{scene.operation.speed_rpm:.0f}", f"{1e-6 * one.speed_number:.2f}",
            f"{scene.mounted.preload_N:g} ({self.case.preload_class})", _STATES[self.state],
            *(("", "") if whirl is None else (f"{whirl[1]:.0f}", f"{whirl[0]:.0f}")),
            f"{1e3 * one.friction_torque:.2f}", f"{1e3 * self.own.torque:.2f}", f"{self.ratios[0]:.3f}",
            f"{self.own.cage / self.cage:.4f}", f"{self.ratios[1]:.3f}",
            f"{self.elsewhere.cage / self.cage:.4f}",
            "" if math.isnan(self.weightless) else f"{self.weightless:.3f}", *heats,
            f"{1e6 * self.own.ring:.2g}", f"{1e6 * self.elsewhere.ring:.2g}", f"{self.elsewhere.turns:.0f}",
            self.verdict, f"{self.cpu:.1f}",
        ]  # fmt: skip


def started(scene: Scene, elsewhere: bool = False) -> Instance:
    """Return `full` of the perfect bearing at the point, or ``elsewhere``: in the quasi-static state."""
    run = Instance(prepare(still_of(scene), fidelity="full"), tell=silent)
    fidelity = run.p[P.FIDELITY]
    if elsewhere:
        run.p[P.FIDELITY] = _NO_FIDELITY
    run.initialise()
    run.p[P.FIDELITY] = fidelity
    return run


def settled(run: Instance, seconds: float) -> Means:
    """Return means over the last part of a run that takes so long."""
    for _ in range(round((seconds - _MEAN) / _STEP)):
        run.step(_STEP)
    names = [
        "friction_torque_mean", "cage.speed_ratio", "inner_ring.displacement.y", "inner_ring.displacement.z",
        *(name for name in run.by_name if name.startswith(("friction_torque_share.", "heat."))),
    ]  # fmt: skip
    rows = []
    for _ in range(round(_MEAN / _SAMPLE)):
        run.step(_SAMPLE)
        rows.append([run.get(name) for name in names])
    samples = dict(zip(names, np.array(rows).T, strict=True))
    torque, cage = (float(samples[name].mean()) for name in names[:2])
    scene = run.model.scene
    heat = heat_of(lambda name: float(samples[name].mean()), scene.operation.speed_rpm * RPM, scene.bearing)
    path = samples[names[2]] + 1j * samples[names[3]]
    return Means(torque, cage, heat, *moved(path - path.mean(), _SAMPLE))


def moved(path: np.ndarray, step: float) -> tuple[float, float]:
    """Return the rms of a path about 0, places in a plane as complex numbers, and where most of it is, Hz.

    Negative: it turns backwards.
    """
    lines = np.abs(np.fft.fft(path))
    at = np.fft.fftfreq(path.size, step)[int(lines.argmax())]
    return math.sqrt(float(np.mean(np.abs(path) ** 2))), float(at)


def compared(case: Case, supported: bool = True) -> Compared:
    """Return a bearing's point beside runs of `full`."""
    begin = time.process_time()
    scene = case.scene(supported)
    point, own = operating_point(scene), started(scene)
    state, cage = int(own.s[S.SETTLED]), own.get("cage.speed_ratio")
    runs = settled(own, _OWN), settled(started(scene, elsewhere=True), _ELSEWHERE)
    weightless = math.nan
    if point.whirl is None:
        light = scene.replace({"fidelity.terms.gravity": False})
        torque = operating_point(light).bearings[0].friction_torque
        weightless = settled(started(light), _OWN).torque / torque
    return Compared(case, point, state, cage, *runs, weightless, time.process_time() - begin)


def summary(found: Iterable[Compared]) -> str:
    """Return how many rows have each verdict, and of how many a whirl is named."""
    rows = list(found)
    verdicts = [one.verdict for one in rows]
    whirls = sum(one.point.whirl is not None for one in rows)
    words = [f"{word} {verdicts.count(word)}" for word in _VERDICTS]
    return f"{len(rows)} bearings, verdicts: {', '.join(words)}. A whirl is named of {whirls}."


def tables(chosen: Sequence[Case]) -> Iterator[tuple[str, list[Compared]]]:
    """Yield heading and rows of the table with tilt support, then of the one without; print what comes."""
    for heading, supported in (("Fresh scenes", True), ("Without tilt support", False)):
        found = []
        for case in chosen:
            found.append(compared(case, supported))
            print(*found[-1].cells(), sep=" | ", flush=True)
        yield heading, found


def main() -> None:
    """Print the rows as they come; write the tables to a file where one is named."""
    parser = argparse.ArgumentParser(description=__doc__.split("\n")[0])
    parser.add_argument("file", nargs="?", type=Path, help="where to write the tables, .md and .csv")
    given = parser.parse_args()
    text, rows = f"# Settled runs beside the operating point\n\n{machine()}\n\n{_HEAD}", []
    for heading, found in tables(cases()):
        cells = [one.cells() for one in found]
        text += f"\n## {heading}\n\n{summary(found)}\n\n{markdown(COLUMNS, cells)}"
        rows += cells
    if given.file is not None:
        given.file.with_suffix(".md").write_text(text, encoding="utf-8")
        write_csv(given.file.with_suffix(".csv"), COLUMNS, rows)


if __name__ == "__main__":
    main()
