"""Error and speed of fidelities, methods, steps, strips and left-out terms, against a reference.

Every variant runs from its own steady state through its own warm-up; then its figures are taken over
the same window as the reference's. The reference is fidelity ``full`` by the default method at ``REFERENCE``,
and two results are compared with it: over the whole run, warm-up included, the explicit method at
``WITNESS``, which has to agree to 1e-6; and over ``CHECK`` after the warm-up, from one state, the two
integrators of :mod:`fmu_bearing.accuracy.reference`. The first difference is larger, because no force
restores the places of the balls on their orbit, so that differences from the warm-up remain.
"""

from collections.abc import Callable, Iterable, Sequence
from contextlib import suppress
from dataclasses import dataclass, field, fields, replace

import numpy as np

from fmu_bearing.accuracy.reference import explicit_rings, implicit_rings, relative_error
from fmu_bearing.arrays import Arrays, EngineError
from fmu_bearing.engine.constants import RPM
from fmu_bearing.prepare.sound_block import Sounds
from fmu_bearing.progress import keeping
from fmu_bearing.results.base import Quantity, Result, Study
from fmu_bearing.results.table import Table, machine, markdown, number
from fmu_bearing.run.choose import reason_against, too_far
from fmu_bearing.run.metrics import SAMPLE, Errors, errors, measure
from fmu_bearing.run.paces import COMMUNICATION, Paces
from fmu_bearing.run.settings import TERMS, Setting
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.exclusions import require

CHECK = 5e-3  # s over which two integrators are compared


#: Settings of the reference: 1 us is an error of 4e-7 in the 7003C's trajectory, 20,000 r/min, 150 ms.
REFERENCE = Setting(tolerance=1e-6, max_step=1e-6)
#: What it has to agree with: 0.5 us and 0.25 us agree to 2e-8 there.
WITNESS = Setting(method="rk4", tolerance=1e-6, max_step=5e-7)
_FULL = Setting()


def _steps(base: Setting, *pairs: tuple[float, float]) -> tuple[Setting, ...]:
    """Return ``base`` at pairs of tolerance and largest step (us)."""
    return tuple(replace(base, tolerance=tolerance, max_step=step / 1e6) for tolerance, step in pairs)


#: What is swept: one thing at a time from the default, and a small grid of tolerance and step.
SETTINGS = (
    *_steps(
        _FULL, (1e-2, 40), (1e-2, 25), (2e-3, 25), (1e-3, 25), (1e-3, 10), (1e-4, 10), (1e-4, 5), (1e-5, 4)
    ),
    *_steps(Setting(method="trbdf2"), (2e-3, 25), (1e-3, 10), (1e-4, 5)),
    *_steps(Setting(method="rk4"), (1e-3, 1), (1e-3, 0.5)),
    *_steps(Setting("rings"), (2e-3, 25), (1e-3, 10), (1e-4, 5)),
    Setting("response"),
    replace(_FULL, strips=3),
    replace(_FULL, strips=1),
    *(replace(_FULL, without=(term,)) for term in TERMS),
    replace(_FULL, strips=1, without=TERMS),
)
QUICK = (_FULL, Setting("rings"), Setting("response"), replace(_FULL, strips=1))


@dataclass(frozen=True)
class Row(Result):
    """One line: a setting, how far it is from the reference, how fast it is.

    Attributes
    ----------
    errors : Errors or None
        None where the engine refused or does not have it; ``remark`` then says so.
    trajectory : float
        Rms difference of the six ring velocities of every bearing over the rms of their fluctuation. NaN for
        fidelities other than ``full``, whose phases differ.
    paces : Paces
        Simulated s per CPU s, with constant inputs and with some that move.
    """

    quantities = (
        Quantity("fidelity = setting.fidelity", "fidelity"),
        Quantity("method", "method", of=lambda row: row.setting.method * (row.setting.fidelity == "full")),
        Quantity("tolerance [1]", "tolerance", "g", of=lambda row: row.stepped(row.setting.tolerance)),
        Quantity("max_step_s", "max step, us", "g", 1e6, of=lambda row: row.stepped(row.setting.max_step)),
        Quantity("strips [1] = setting.strips", "strips"),
        Quantity("left_out = setting.left_out", "left out"),
        Quantity("trajectory [1]", "trajectory", number),
        Quantity("ring_rms [1] = errors.ring_rms", "ring rms", number),
        Quantity("load [1] = errors.load", "load", number),
        Quantity("torque [1] = errors.torque", "torque", number),
        Quantity("level_dBA = errors.level", "dB(A)", number),
        *(Quantity(f"{one.name} [1] = paces.{one.name}", head, number)
          for one, head in zip(fields(Paces), ("sim/CPU", "ramp", "warming", "ripple"), strict=True)),
        Quantity("remark", "remark"),
    )  # fmt: skip

    setting: Setting
    errors: Errors | None = None
    trajectory: float = np.nan
    paces: Paces = field(default_factory=Paces)
    remark: str = ""

    @property
    def whole(self) -> bool:
        """Whether the setting has all terms and the usual strips: others describe another bearing."""
        return not self.setting.without and self.setting.strips == _FULL.strips

    @property
    def steps(self) -> tuple[float | None, float | None]:
        """Largest step (us) and tolerance; None where nothing is stepped."""
        return self.stepped(1e6 * self.setting.max_step), self.stepped(self.setting.tolerance)

    def stepped(self, value: float) -> float | None:
        """Return a value of the steps; the linear response is a sum of lines: nothing is stepped."""
        return None if self.setting.fidelity == "response" else value


@dataclass(frozen=True)
class Tradeoff(Study):
    """The rows of one scene, and the accuracy of the reference.

    Attributes
    ----------
    agreement : float
        Relative difference of the trajectories of reference and witness over the window; NaN where the
        engine lacks or refuses the witness.
    pair : float
        Relative difference of the two integrators over ``CHECK``, from one state.
    reference_error : float
        Relative difference of the reference's settings from the explicit one of the pair.
    """

    quantities = (
        "scene", "rpm", "warm_up_s", "window_s", "agreement [1]", "pair [1]", "reference_error [1]",
        "settings = rows", "advice",
    )  # fmt: skip
    stem, row = "tradeoff", Row

    scene: str
    rpm: float
    warm_up: float
    window: float
    agreement: float
    pair: float
    reference_error: float
    rows: tuple[Row, ...]
    advice: str = ""
    """Which setting to take, in a sentence."""

    def short(self) -> Table:
        """Return the columns that decide, for a terminal, of the settings that leave nothing out."""
        rows = [
            [
                row.setting.name, *(f"{value:g}" if value else "" for value in row.steps),
                *(number(None if row.errors is None else value(row.errors)) for value in _DECIDE),
                number(row.paces.slowest), row.remark,
            ]
            for row in self.rows
            if row.whole
        ]  # fmt: skip
        heads = ["fidelity", "max step, us", "tolerance", "rings, dB", "torque", "dB(A)", "sim/CPU", "remark"]
        kept = [k for k in range(len(heads)) if k < len(heads) - 1 or any(row[k] for row in rows)]
        return [heads[k] for k in kept], [[row[k] for k in kept] for row in rows]

    def records(self) -> tuple[Row, ...]:
        """Return the rows."""
        return self.rows

    def markdown(self) -> str:
        """Return the study as a page."""
        return _PAGE.format(
            scene=self.scene, rpm=self.rpm, machine=machine(), warm_up=1e3 * self.warm_up,
            window=1e3 * self.window, check=1e3 * CHECK, agreement=number(self.agreement) or "?",
            pair=self.pair, own=self.reference_error, step=1e6 * REFERENCE.max_step,
            tolerance=REFERENCE.tolerance, table=markdown(*self.table()),
        )  # fmt: skip


#: Errors that `Tradeoff.short` has.
_DECIDE: tuple[Callable[[Errors], float], ...] = (
    lambda one: one.ring_level, lambda one: one.torque, lambda one: one.level,
)  # fmt: skip


def _advice(rows: Sequence[Row], scene: Scene, against: str) -> str:
    """Return which row to take: the fastest with moving inputs within the scene's ``fidelity.accuracy``.

    ``against``: why only fidelity full is trusted, as in `run.choose.choose`; "": nothing is against others.
    """
    bounds = scene.fidelity.accuracy
    asked = f"{bounds.level_dB:g} dB and {bounds.relative:g} of loads and torque (fidelity.accuracy)"
    good = [
        row for row in rows
        if row.whole and row.errors is not None and not too_far(row.errors, scene)
        and not (against and row.setting.fidelity != _FULL.fidelity)
    ]  # fmt: skip
    left_out = f"; rings and response are left out: {against}" if against else ""
    if not good:
        return f"Nothing that was measured is within {asked}{left_out}: ask for less, or take shorter steps."
    best = max(good, key=lambda row: row.paces.slowest)
    step, tolerance = best.steps
    how = "" if step is None else f", {step:g} us, tolerance {tolerance:g}"
    return (
        f"Take {best.setting.name}{how}: the fastest within {asked}, at this speed{left_out}. sim/CPU here "
        "is the slowest of constant and moving inputs; `fmu-bearing choose` probes other speeds too."
    )


_PAGE = """# Accuracy and cost: {scene}, {rpm:,.0f} r/min

{machine}

Made by `fmu-bearing tradeoff`: page "What accuracy costs, and how fidelity `auto` chooses" of the
documentation. Figures over {window:g} ms after a warm-up
of {warm_up:g} ms. Errors of trajectory, rms ring velocity, contact load and friction torque are relative;
those of sound are in dB(A) at the worst microphone. Speeds are simulated s per CPU s without sound, in steps
of 1 ms: with constant inputs (sim/CPU), with a speed that falls and rises by 1,000 rad/s2 (ramp), with all
temperatures rising by 5 K/s (warming), and with a speed that ripples by 0.05 % at 50 Hz (ripple).

Reference: fidelity `full`, `esdirk4`, {step:g} us, tolerance {tolerance:g}. Its trajectory and that of `rk4`
at 0.5 us, each with its own warm-up, agree to {agreement} over the whole window. Over {check:g} ms from one
state, Runge-Kutta at 40 ns and ESDIRK4 at 0.5 us agree to {pair:.0e}; the reference's settings differ from
them by {own:.0e}.

{table}"""


def check(scene: Scene, warm_up: float, length: float) -> tuple[float, float]:
    """Return the agreement of two integrators over ``length`` (s), and the error of ``REFERENCE`` there."""
    bearing = Arrays.of(REFERENCE.scene(scene)).init()
    bearing.run(warm_up, COMMUNICATION)
    exact, _ = explicit_rings(bearing, length, SAMPLE, 4e-8)
    other, _ = implicit_rings(bearing, length, SAMPLE, 5e-7, 1e-8)
    own, _ = implicit_rings(bearing, length, SAMPLE, REFERENCE.max_step, REFERENCE.tolerance)
    return relative_error(other, exact), relative_error(own, exact)


def tradeoff(
    source: SceneSource,
    settings: Sequence[Setting] = SETTINGS,
    *,
    warm_up: float = 0.05,
    window: float = 0.1,
    budget: float = 0.4,
    track: Callable[[Sequence[Setting]], Iterable[Setting]] = iter,
) -> Tradeoff:
    """Run a scene in every setting and hold each against the reference.

    Parameters
    ----------
    source : Scene or path
        Run at its own speed, loads and temperatures. Of its ``fidelity`` only the left-out terms count.
    settings : sequence of Setting
    warm_up, window : float
        Time (s) that each variant runs before its figures are taken, and over which they are taken.
    budget : float
        Wall time (s) of each of two timed runs, of which there are four pairs.
    track : callable
        Wraps the settings, for a progress bar.

    Raises
    ------
    EngineError
        If the engine refuses the reference.
    SceneError
        For bearings on another model's shaft.
    Stopped
        On Ctrl-C, a `KeyboardInterrupt` with what is finished as ``found``.
    """
    scene = scene_of(source)
    require(scene, "tradeoff")
    sounds = Sounds(scene)
    pair, own = check(scene, warm_up, min(CHECK, 0.5 * window))
    truth = measure(REFERENCE.scene(scene), sounds.at(REFERENCE.fidelity), warm_up, window)
    agreement = np.nan
    if WITNESS.carries(scene):
        with suppress(EngineError):
            witness = measure(WITNESS.scene(scene), np.empty(0), warm_up, window)
            agreement = relative_error(truth.rings, witness.rings)
    rows: list[Row] = []
    rpm = scene.operation.speed_rpm
    against = reason_against(scene, rpm * RPM)

    def study() -> Tradeoff:
        advice = _advice(rows, scene, against)
        return Tradeoff(scene.name, rpm, warm_up, window, agreement, pair, own, tuple(rows), advice)

    with keeping(rows, study):
        for setting in track(settings):
            if against := setting.against(scene):
                rows.append(Row(setting, remark=against))
                continue
            try:
                run = measure(
                    setting.scene(scene), sounds.at(setting.fidelity), warm_up, window, budget=budget
                )
            except EngineError as problem:
                rows.append(Row(setting, remark=f"refused: {problem}"))
                continue
            error = relative_error(run.rings, truth.rings) if setting.fidelity == "full" else np.nan
            rows.append(Row(setting, errors(run.figures, truth.figures), error, run.paces))
    return study()
