"""Fidelity ``auto``: the cheapest fidelity, method and step whose measured error meets the required accuracy.

A scene is probed once, when its model is built. Every candidate, and fidelity ``full`` with the settings of
``FINEST``, runs at the scene's speed, loads and temperatures. A candidate is accurate where

* the rms velocity of each ring, of all bearings, in dB, and with sound the A-weighted equivalent level at
  each microphone differ by no more than ``fidelity.accuracy.level_dB``;
* the mean contact load at each race and the mean friction torque differ by no more than
  ``fidelity.accuracy.relative`` of themselves.

``CANDIDATES`` are in the order of their usual cost. The first accurate one is taken, unless another is faster
by the factor ``CLEARLY``, so that noise of the clock does not change the choice. Tolerance and largest step
of the scene are upper bounds. ``FINEST`` is last and is accurate by definition. Only the scene's own speed
and loads are probed, and nothing is decided at run time. Where the rings bend, candidates with rigid rings
are left out.
"""

import dataclasses
import hashlib
import json
import math
import pathlib
from collections.abc import Sequence
from dataclasses import dataclass, replace

from fmu_bearing.engine.sources import source_hash
from fmu_bearing.files import cache_root, write_whole
from fmu_bearing.prepare.sound import sound_blocks
from fmu_bearing.run.arrays import Refused
from fmu_bearing.run.metrics import Errors, errors, measure
from fmu_bearing.run.settings import Setting
from fmu_bearing.run.table import number
from fmu_bearing.scene import Scene
from fmu_bearing.scene.read import with_fidelity

WARM_UP = 0.03  # s
WINDOW = 0.06  # s: twenty turns at 20,000 r/min
BUDGET = 0.15  # s of each of two timed runs
CLEARLY = 1.5


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

COLUMNS = (
    "fidelity", "method", "tolerance", "max step, us", "ring level, dB", "dB(A)", "load", "torque", "sim/CPU",
    "verdict",
)  # fmt: skip


@dataclass(frozen=True)
class Probe:
    """Result of one candidate; ``errors`` is None, with a ``reason``, where it could not run.

    ``tolerance`` and ``max_step`` (s) are those it ran with; ``pace``: simulated s per CPU s, without sound.
    """

    fidelity: str
    method: str
    tolerance: float
    max_step: float
    errors: Errors | None
    pace: float
    reason: str = ""

    @property
    def name(self) -> str:
        """Fidelity, and for full the method."""
        return f"{self.fidelity} / {self.method}" if self.fidelity == "full" else self.fidelity

    def cells(self) -> list[str]:
        """Texts in the order of ``COLUMNS``."""
        e = self.errors
        found = [""] * 4 if e is None else [number(x) for x in (e.ring_level, e.level, e.load, e.torque)]
        method = self.method if self.fidelity == "full" else ""
        return [
            self.fidelity, method, f"{self.tolerance:g}", f"{1e6 * self.max_step:g}", *found,
            number(self.pace), self.reason or "accurate",
        ]  # fmt: skip


@dataclass(frozen=True)
class Choice:
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
        Place of the chosen one among them.
    """

    scene: str
    level_dB: float
    relative: float
    probes: tuple[Probe, ...]
    chosen: int

    @property
    def probe(self) -> Probe:
        """The chosen one."""
        return self.probes[self.chosen]

    def apply(self, scene: Scene) -> Scene:
        """Return the scene with the chosen fidelity, method, tolerance and largest step."""
        p = self.probe
        return bounded(Setting(p.fidelity, p.method, p.tolerance, p.max_step), scene)

    @property
    def summary(self) -> str:
        """One line: which, and why."""
        p, asked = self.probe, f"{self.level_dB:g} dB and {self.relative:g} of loads and torque"
        how = f"{p.name}, internal steps up to {1e6 * p.max_step:g} us, tolerance {p.tolerance:g}"
        if self.chosen == len(self.probes) - 1 or p.errors is None:
            return f"fidelity auto: {how}: nothing cheaper is within {asked} of fidelity full"
        e = p.errors
        sound = "" if math.isnan(e.level) else f", {number(e.level)} dB(A) at the worst microphone"
        return (
            f"fidelity auto: {how}: the cheapest within {asked} of fidelity full; measured "
            f"{number(e.ring_level)} dB of ring velocity{sound}, {number(e.load)} of the contact load, "
            f"{number(e.torque)} of the friction torque"
        )

    def cells(self) -> list[list[str]]:
        """Table of all candidates, the chosen one marked."""
        rows = [probe.cells() for probe in self.probes]
        rows[self.chosen][-1] += ", chosen"
        return rows


def too_far(found: Errors, scene: Scene) -> str:
    """Name the figures whose error exceeds the scene's accuracy; empty: none."""
    bounds = scene.fidelity.accuracy
    checks = (
        ("ring velocity", found.ring_level, bounds.level_dB),
        ("sound", 0.0 if math.isnan(found.level) else found.level, bounds.level_dB),
        ("contact load", found.load, bounds.relative),
        ("friction torque", found.torque, bounds.relative),
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
    Refused
        If fidelity ``full`` itself is refused.
    """
    sounds = sound_blocks(scene)
    candidates = [c for c in candidates if c.carries(scene)]
    finest = bounded(FINEST, scene)
    truth = measure(finest, sounds, warm_up, window, budget=budget)
    probes = []
    # bounds of the scene may make two candidates one
    variants = {(made := bounded(candidate, scene)).fidelity: made for candidate in candidates}
    for fidelity, variant in variants.items():
        found, pace = None, math.nan
        try:
            run = measure(variant, sounds, warm_up, window, budget=budget)
            found, pace = errors(run.figures, truth.figures), run.cpu
            reason = too_far(found, scene)
        except Refused as problem:
            reason = f"refused: {problem}"
        probes.append(
            Probe(fidelity.model, fidelity.method, fidelity.tolerance, 1e-6 * fidelity.max_internal_step_us,
                  found, pace, reason)
        )  # fmt: skip
    f = finest.fidelity
    none = errors(truth.figures, truth.figures)
    probes.append(Probe(f.model, f.method, f.tolerance, 1e-6 * f.max_internal_step_us, none, truth.cpu))
    accuracy = scene.fidelity.accuracy
    return Choice(scene.name, accuracy.level_dB, accuracy.relative, tuple(probes), _cheapest(probes))


def _cheapest(probes: list[Probe]) -> int:
    """Place of the first accurate probe, unless another is clearly faster."""
    places = [k for k, probe in enumerate(probes) if not probe.reason]
    best = places[0]
    for k in places[1:]:
        if probes[k].pace > CLEARLY * probes[best].pace:
            best = k
    return best


def cache_file(scene: Scene) -> pathlib.Path:
    """Cache file of a scene's choice, named by a hash of scene, engine and candidates."""
    way = repr((CANDIDATES, FINEST, WARM_UP, WINDOW, CLEARLY))
    key = hashlib.sha256("\0".join((scene.to_toml(), source_hash(), way)).encode()).hexdigest()
    return cache_root() / "choices" / f"{key}.json"


def chosen(scene: Scene) -> Choice:
    """Choice for a scene, from the cache or probed now; a damaged cache entry is replaced."""
    path = cache_file(scene)
    try:
        return _from_text(path.read_text("utf-8"))
    except (OSError, ValueError, TypeError, KeyError):
        pass
    choice = choose(scene)
    _keep(path, json.dumps(dataclasses.asdict(choice), indent=1))
    return choice


def resolve(scene: Scene) -> tuple[Scene, Choice | None]:
    """Return the scene with a concrete fidelity, and the choice; None where nothing was probed."""
    if scene.fidelity.model != "auto":
        return scene, None
    choice = chosen(scene)
    return choice.apply(scene), choice


def _from_text(text: str) -> Choice:
    """Read a choice back; ``ValueError``, ``TypeError`` or ``KeyError`` where it is damaged."""
    data = json.loads(text)
    probes = tuple(
        Probe(**probe | {"errors": None if probe["errors"] is None else Errors(**probe["errors"])})
        for probe in data["probes"]
    )
    choice = Choice(**data | {"probes": probes})
    if not 0 <= choice.chosen < len(probes) or choice.probe.reason:
        raise ValueError("the choice is none of the probes")
    return choice


def _keep(path: pathlib.Path, text: str) -> None:
    """Write the cache entry. A failure to write is ignored, because it only costs time later."""
    try:
        write_whole(path, text.encode("utf-8"))
    except OSError:
        pass
