"""Fidelity ``auto``: the cheapest fidelity, method and step whose measured error meets the required accuracy.

A scene is probed once, when its model is built. Every candidate, and fidelity ``full`` with the settings of
``FINEST``, runs at the scene's loads and temperatures under each of `conditions`: at the scene's speed, at
half of it or at its ``operation.lowest_speed_rpm``, and while the speed rises to the scene's; where the
lowest speed is the scene's own, that is held and nothing else is probed. A candidate is accurate where in
each of them

* the rms velocity of each ring, of all bearings, in dB, and with sound the A-weighted equivalent level at
  each microphone differ by no more than ``fidelity.accuracy.level_dB``;
* the mean contact load at each race and the mean friction torque differ by no more than
  ``fidelity.accuracy.relative`` of themselves.

``CANDIDATES`` are in the order of their usual cost. The first accurate one is taken, unless another is faster
by the factor ``CLEARLY``, so that noise of the clock does not change the choice. Tolerance and largest step
of the scene are upper bounds. ``FINEST`` is last and is accurate by definition. Nothing is decided at run
time. Where the rings bend, candidates with rigid rings are left out; so are fidelities rings and response
where a mode of the rings grows by itself or is weakly damped, which so short a window does not show.
"""

import dataclasses
import hashlib
import json
import math
import pathlib
from collections.abc import Sequence
from dataclasses import dataclass, replace

from fmu_bearing.arrays import EngineError
from fmu_bearing.engine.sources import source_hash
from fmu_bearing.files import cache_root, write_whole
from fmu_bearing.modal.campbell import doubts
from fmu_bearing.prepare.sound_block import Sounds
from fmu_bearing.progress import Stopped, keeping
from fmu_bearing.results.base import Quantity, Result, table
from fmu_bearing.results.table import Table, number
from fmu_bearing.run.conditions import RATE, WINDOW, Condition, conditions, without_others
from fmu_bearing.run.metrics import SILENT, SILENT_RAMP, Errors, Figures, errors, measure, measure_between
from fmu_bearing.run.settings import Setting
from fmu_bearing.scene import Scene
from fmu_bearing.scene.read import with_fidelity

WARM_UP = 0.03  # s
BUDGET = 0.05  # s of each of two timed runs, of which there are four pairs
CLEARLY = 1.5
#: What "sim/CPU" of the table is.
LEGEND = (
    "sim/CPU: simulated s per s of the processor, without sound: the slowest of constant inputs, a speed "
    "that changes or ripples, and temperatures that rise"
)
NOT_PROBED = "other loads, preloads and temperatures, jumps of inputs, faster changes of speed"


def bounded(setting: Setting, scene: Scene) -> Scene:
    """Return the scene computed in a setting, at no more than its own tolerance and step, with its strips."""
    own = scene.fidelity
    return with_fidelity(
        replace(setting, strips=own.traction_strips).scene(scene),
        tolerance=min(setting.tolerance, own.tolerance),
        max_internal_step_us=min(1e6 * setting.max_step, own.max_internal_step_us),
    )


CANDIDATES = (
    Setting("response", tolerance=1e-2, max_step=40e-6),
    Setting("rings", tolerance=1e-2),
    Setting("full", "esdirk4", 1e-2),
    Setting("full", "esdirk4", 1e-3, 10e-6),
    Setting("full", "esdirk4", 1e-4, 5e-6),
)
FINEST = Setting("full", "esdirk4", 1e-5, 2e-6)
NONE = -1

_LEFT_OUT = "left out: "


@dataclass(frozen=True)
class Probe:
    """Result of one candidate.

    Attributes
    ----------
    fidelity, method : str
    tolerance, max_step : float
        With which it ran; the step in s.
    errors : tuple of Errors
        Under each condition, up to where it was refused; none where it was left out.
    pace : float
        Simulated s per CPU s at the scene's speed, without sound: the slowest of `Paces`.
    reasons : tuple of str
        Why it is not accurate, by condition; empty: it is. One alone where it was left out.
    """

    fidelity: str
    method: str
    tolerance: float
    max_step: float
    errors: tuple[Errors, ...]
    pace: float
    reasons: tuple[str, ...] = ("",)

    @property
    def name(self) -> str:
        """Fidelity, and for full the method."""
        return f"{self.fidelity} / {self.method}" if self.fidelity == "full" else self.fidelity

    @property
    def reason(self) -> str:
        """Why it is not accurate, first of the conditions; empty: it is under all."""
        return next((one for one in self.reasons if one), "")

    @property
    def worst(self) -> Errors | None:
        """The largest error of each figure under all conditions; None where nothing was measured."""
        if not self.errors:
            return None
        names = [field.name for field in dataclasses.fields(Errors)]
        return Errors(**{name: max(getattr(error, name) for error in self.errors) for name in names})


@dataclass(frozen=True)
class Tried(Result):
    """A candidate under one condition; without errors where it was refused or left out."""

    quantities = (
        Quantity("fidelity = probe.fidelity", "fidelity"),
        Quantity("method", "method", of=lambda row: row.probe.method * (row.probe.fidelity == "full")),
        Quantity("tolerance [1] = probe.tolerance", "tolerance", "g"),
        Quantity("max_step_s = probe.max_step", "max step, us", "g", 1e6),
        Quantity("at", "at"),
        Quantity("ring_level_dB = errors.ring_level", "ring level, dB", number),
        Quantity("level_dBA = errors.level", "dB(A)", number),
        Quantity("load [1] = errors.load", "load", number),
        Quantity("torque [1] = errors.torque", "torque", number),
        Quantity("pace [1]", "sim/CPU", number),
        Quantity("verdict", "verdict"),
    )

    probe: Probe
    at: str
    errors: Errors | None
    pace: float | None
    verdict: str


@dataclass(frozen=True)
class Choice(Result):
    """The choice for a scene, and the figures of all candidates.

    Attributes
    ----------
    scene : str
        Name of the scene.
    level_dB, relative : float
        Required accuracy.
    probes : tuple of Probe
        In the order of ``CANDIDATES``, ``FINEST`` last.
    chosen : int
        Place of the chosen one among them; `NONE` where Ctrl-C came before all were probed.
    probed : tuple of str
        Names of the conditions, the scene's own speed first.
    missing : str
        Which conditions were not probed, and why; empty: all were.
    """

    quantities = (
        "scene", "level_dB = level_dB", "relative [1]",
        Quantity("chosen", of=lambda choice: None if choice.chosen == NONE else choice.words()),
        "candidates = records",
    )  # fmt: skip

    scene: str
    level_dB: float
    relative: float
    probes: tuple[Probe, ...]
    chosen: int
    probed: tuple[str, ...] = ("",)
    missing: str = ""

    @property
    def probe(self) -> Probe:
        """The chosen one."""
        return self.probes[self.chosen]

    def apply(self, scene: Scene) -> Scene:
        """Return the scene with the chosen fidelity, method, tolerance and largest step."""
        p = self.probe
        return bounded(Setting(p.fidelity, p.method, p.tolerance, p.max_step), scene)

    def words(self) -> str:
        """Return one line: which, why, under which conditions, and what was not probed."""
        p, asked = self.probe, f"{self.level_dB:g} dB and {self.relative:g} of loads and torque"
        how = f"{p.name}, internal steps up to {1e6 * p.max_step:g} us, tolerance {p.tolerance:g}"
        e = p.worst
        if self.chosen == len(self.probes) - 1 or e is None:
            why = f"nothing cheaper is within {asked} of fidelity full"
        else:
            sound = "" if math.isnan(e.level) else f", {number(e.level)} dB(A) at the worst microphone"
            why = (
                f"the cheapest within {asked} of fidelity full; measured at most "
                f"{number(e.ring_level)} dB of ring velocity{sound}, {number(e.load)} of the contact load, "
                f"{number(e.torque)} of the friction torque"
            )
        return f"fidelity auto: {how}: {why}{self._left_out()}; {self.conditions}"

    @property
    def conditions(self) -> str:
        """Return which operating conditions were probed, and which were not."""
        *others, last = self.probed
        names = f"{', '.join(others)} and {last}" if others else last
        missing = f"{self.missing}; " if self.missing else ""
        return f"probed at {names}; not probed: {missing}{NOT_PROBED}"

    def _left_out(self) -> str:
        """Which fidelities were no candidates, and why."""
        out = {one.fidelity: one.reason for one in self.probes if one.reason.startswith(_LEFT_OUT)}
        if not out:
            return ""
        reason = next(iter(out.values())).removeprefix(_LEFT_OUT)
        return f"; {' and '.join(out)} left out: {reason}"

    def records(self) -> tuple[Tried, ...]:
        """Return each candidate under each condition, the chosen one marked."""
        rows = []
        for k, probe in enumerate(self.probes):
            several = bool(probe.errors) or len(probe.reasons) > 1
            for n, reason in enumerate(probe.reasons):
                verdict = (reason or "accurate") + ", chosen" * (k == self.chosen and n == 0)
                rows.append(Tried(
                    probe, self.probed[n] if several else "all",
                    probe.errors[n] if n < len(probe.errors) else None, None if n else probe.pace, verdict,
                ))  # fmt: skip
        return tuple(rows)

    def cells(self) -> Table:
        """Return a table with a row for each candidate and condition."""
        return table(Tried, self.records())

    def table(self) -> Table:
        """Return a table with a row for each candidate, errors in the order of ``probed`` in a cell."""
        columns, cells = self.cells()
        at, pace = columns.index("at"), columns.index("sim/CPU")
        table_rows = []
        for k, probe in enumerate(self.probes):
            rows, cells = cells[: len(probe.reasons)], cells[len(probe.reasons) :]
            errors = [" / ".join(row[c] for row in rows) if rows[0][c] else "" for c in range(at + 1, pace)]
            reasons = [
                reason if reason.startswith(_LEFT_OUT) else f"{reason} at {where}"
                for reason, where in zip(probe.reasons, self.probed, strict=False)
                if reason
            ]
            verdict = ("; ".join(reasons) or "accurate") + ", chosen" * (k == self.chosen)
            table_rows.append([*rows[0][:at], *errors, rows[0][pace], verdict])
        return columns[:at] + columns[at + 1 :], table_rows


def too_far(errors: Errors, scene: Scene) -> str:
    """Name the figures whose error exceeds the scene's accuracy; empty: none."""
    bounds = scene.fidelity.accuracy
    checks = (
        ("ring velocity", errors.ring_level, bounds.level_dB),
        ("sound", 0.0 if math.isnan(errors.level) else errors.level, bounds.level_dB),
        ("contact load", errors.load, bounds.relative),
        ("friction torque", errors.torque, bounds.relative),
    )
    names = [name for name, error, bound in checks if not error <= bound]
    return "too far: " + ", ".join(names) if names else ""


def choose(
    scene: Scene, candidates: Sequence[Setting] = CANDIDATES, *, warm_up: float = WARM_UP,
    window: float = WINDOW, budget: float = BUDGET,
) -> Choice:  # fmt: skip
    """Probe a scene, whatever its fidelity, and choose.

    ``warm_up``, ``window`` (s): how long each candidate runs before and while it is measured; ``budget``
    (s): wall time of each of two timed runs.

    Raises
    ------
    EngineError
        If fidelity ``full`` itself is refused.
    Stopped
        On Ctrl-C, a `KeyboardInterrupt` with the candidates that are finished as ``found``; none is chosen.
    """
    sounds = Sounds(scene)
    candidates = [c for c in candidates if c.carries(scene)]
    planned = conditions(scene, window)
    against = _against(scene, planned)
    finest = bounded(FINEST, scene)
    first = measure(finest, sounds.at(finest.fidelity.model), warm_up, window, budget=budget)
    truth: dict[Condition, Figures] = {planned[0]: first.figures}
    missing = without_others(scene)
    for one in planned[1:]:
        try:
            truth[one] = measure_between(
                finest, sounds.at(finest.fidelity.model), warm_up, window, one.first, one.last
            )
        except EngineError as problem:
            missing += f"{'; ' if missing else ''}{one.name}, where fidelity full is refused ({problem})"
    probes: list[Probe] = []
    # bounds of the scene may make two candidates one
    variants = {(made := bounded(candidate, scene)).fidelity: made for candidate in candidates}
    accuracy = scene.fidelity.accuracy

    def study(place: int = NONE) -> Choice:
        f, none = finest.fidelity, tuple(errors(true, true) for true in truth.values())
        last = Probe(f.model, f.method, f.tolerance, 1e-6 * f.max_internal_step_us, none, first.paces.slowest,
                     ("",) * len(none))  # fmt: skip
        return Choice(
            scene.name, accuracy.level_dB, accuracy.relative, (*probes, last), place,
            tuple(one.name for one in truth), missing,
        )  # fmt: skip

    def left() -> str:
        return f"{len(variants) - len(probes)} of {len(variants)} candidates, so that none is chosen"

    with keeping(probes, study, left):
        for fidelity, variant in variants.items():
            found, pace, reasons = list[Errors](), math.nan, list[str]()
            if against and fidelity.model != "full":
                reasons.append(f"{_LEFT_OUT}{against}")
            else:
                try:
                    own = sounds.at(fidelity.model)
                    run = measure(variant, own, warm_up, window, budget=budget)
                    pace = run.paces.slowest
                    for one, true in truth.items():
                        figures = run.figures
                        if one is not planned[0]:
                            figures = measure_between(variant, own, warm_up, window, one.first, one.last)
                        silent = SILENT if one.first == one.last else SILENT_RAMP
                        found.append(errors(figures, true, silent))
                        reasons.append(too_far(found[-1], scene))
                except EngineError as problem:
                    reasons.append(f"refused: {problem}")
            probes.append(
                Probe(fidelity.model, fidelity.method, fidelity.tolerance,
                      1e-6 * fidelity.max_internal_step_us, tuple(found), pace, tuple(reasons))
            )  # fmt: skip
    return study(_cheapest(study().probes))


def _against(scene: Scene, planned: Sequence[Condition]) -> str:
    """Return why fidelities rings and response are no candidates at one of the speeds; "": they are."""
    for one in planned:
        if one.first == one.last and (reason := reason_against(scene, one.last)):
            return reason if one is planned[0] else f"at {one.name} {reason}"
    return ""


def _cheapest(probes: Sequence[Probe]) -> int:
    """Place of the first accurate probe, unless another is clearly faster."""
    places = [k for k, probe in enumerate(probes) if not probe.reason]
    best = places[0]
    for k in places[1:]:
        if probes[k].pace > CLEARLY * probes[best].pace:
            best = k
    return best


def cache_file(scene: Scene) -> pathlib.Path:
    """Cache file of a scene's choice, named by a hash of scene, engine and candidates."""
    way = repr((CANDIDATES, FINEST, WARM_UP, CLEARLY, RATE, conditions(scene)))
    key = hashlib.sha256("\0".join((scene.to_toml(), source_hash(), way)).encode()).hexdigest()
    return cache_root() / "choices" / f"{key}.json"


def chosen(scene: Scene) -> Choice:
    """Choice for a scene, from the cache or probed now; a damaged cache entry is replaced."""
    path = cache_file(scene)
    try:
        return _from_text(path.read_text("utf-8"))
    except Exception:  # not there, or damaged in any way
        pass
    choice = choose(scene)
    _keep(path, json.dumps(dataclasses.asdict(choice), indent=1))
    return choice


def resolve(scene: Scene) -> tuple[Scene, Choice | None]:
    """Return the scene with a concrete fidelity, and the choice; None where nothing was probed."""
    if scene.fidelity.model != "auto":
        return scene, None
    try:
        choice = chosen(scene)
    except Stopped:  # no study of the caller's
        raise KeyboardInterrupt from None
    return choice.apply(scene), choice


def _from_text(text: str) -> Choice:
    """Read a choice back; ``ValueError``, ``TypeError`` or ``KeyError`` where it is damaged."""
    data = json.loads(text)
    probes = tuple(
        Probe(
            **probe
            | {"errors": tuple(Errors(**one) for one in probe["errors"]), "reasons": tuple(probe["reasons"])}
        )
        for probe in data["probes"]
    )
    choice = Choice(**data | {"probes": probes, "probed": tuple(data["probed"])})
    if not 0 <= choice.chosen < len(probes) or choice.probe.reason:
        raise ValueError("the choice is none of the probes")
    return choice


def _keep(path: pathlib.Path, text: str) -> None:
    """Write the cache entry. A failure to write is ignored, because it only costs time later."""
    try:
        write_whole(path, text.encode("utf-8"))
    except OSError:
        pass


def reason_against(scene: Scene, speed: float) -> str:
    """Return why fidelities rings and response are no candidates at a speed (rad/s); "": they are.

    A mode of the rings grows by itself or is weakly damped, or no steady state was found: what a window of
    some hundredths of a second shows then means little.
    """
    at = {"shaft_speed": speed}
    return "no steady state was found" if doubts.unsteady(scene, at) else doubts.reason_for_doubt(scene, at)
