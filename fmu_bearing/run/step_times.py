"""Times of communication steps: their table, which fidelity keeps the step, and what to change."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.results.base import Quantity, Result, table
from fmu_bearing.results.table import Table, number
from fmu_bearing.scene import Scene

__all__ = ["COLUMNS", "HELD", "SHORT", "Realtime", "Timed", "name_of"]

#: The columns of a table for a terminal: the steps of all rows are as many.
SHORT = ("fidelity", "microphones", "phase", "mean, us", "p50", "p99", "worst", "late")
_AMPLE = 0.8  # of the step: what takes more has little margin
_SHORT = 1e-4  # s: internal steps are some tens of microseconds long, and a call computes one at least
_NAMES = 5  # of outputs that are printed
HELD = "held"


def _microseconds(value: float) -> str:
    return f"{value:.0f}" if value >= 10.0 else f"{value:.1f}"


@dataclass(frozen=True)
class Timed(Result):
    """What the steps of one phase took."""

    quantities = (
        Quantity("fidelity", "fidelity"),
        Quantity("microphones [1]", "microphones", lambda count: str(count or "none")),
        Quantity("phase", "phase"),
        Quantity("steps [1] = cpu.size", "steps"),
        Quantity("mean_s = cpu.mean", "mean, us", _microseconds, 1e6),
        Quantity("p50_s", "p50", _microseconds, 1e6, of=lambda one: np.quantile(one.cpu, 0.5)),
        Quantity("p99_s", "p99", _microseconds, 1e6, of=lambda one: np.quantile(one.cpu, 0.99)),
        Quantity("worst_s = cpu.max", "worst", _microseconds, 1e6),
        Quantity("", "worst over mean", ".2f", of=lambda one: one.cpu.max() / one.cpu.mean()),
        Quantity("late [1]", "late"),
    )

    fidelity: str
    microphones: int
    """0: the sound is not computed."""
    phase: str
    cpu: NDArray[np.float64]
    """Time of the processor for this thread (s): other work on the machine enters through caches alone. Shape
    (steps,)."""
    clock: NDArray[np.float64]
    """Time of the clock (s). Shape (steps,)."""
    step: float
    """What each step simulates (s)."""

    @property
    def case(self) -> tuple[str, int]:
        """Fidelity and microphones."""
        return self.fidelity, self.microphones

    def late(self) -> int:
        """Return how many steps took longer on the clock than they simulate."""
        return int((self.clock > self.step).sum())


#: Heads of the table.
COLUMNS = tuple(table(Timed, ())[0])


@dataclass(frozen=True)
class _Cost:
    """What a case costs over all of its phases."""

    case: tuple[str, int]  # fidelity, and number of microphones
    phases: dict[str, NDArray[np.float64]]

    @property
    def worst(self) -> float:
        """Longest step (s)."""
        return max(float(cpu.max()) for cpu in self.phases.values())

    @property
    def mean(self) -> float:
        """Mean of the phase that takes most (s)."""
        return max(float(cpu.mean()) for cpu in self.phases.values())

    @property
    def name(self) -> str:
        """Fidelity and sound in words."""
        return name_of(*self.case)

    @property
    def held(self) -> NDArray[np.float64]:
        """Times of the steps at the held speed (s)."""
        return self.phases[HELD]

    def longer(self, step: float, phases: Sequence[str] = ()) -> float:
        """Return the shortest multiple of ``step`` (s) that so many steps in a row keep; infinite: none.

        ``phases``: in which; default: in all.
        """
        sums = [np.concatenate(([0.0], np.cumsum(self.phases[one]))) for one in phases or self.phases]
        for count in range(2, min(one.size for one in sums) // 2):
            if all((one[count:] - one[:-count]).max() <= count * step for one in sums):
                return count * step
        return math.inf


@dataclass(frozen=True)
class Realtime(Result):
    """Times of the steps of a scene."""

    quantities = (
        "scene = scene.name", "step_s", "machine", "steps = timed", "left_out", "outputs", "advice",
    )  # fmt: skip

    scene: Scene
    step: float
    """Communication step (s)."""
    timed: tuple[Timed, ...]
    """By fidelity, without sound before with it, by phase."""
    left_out: dict[str, str]
    """Reasons by fidelity, or fidelity and sound, that could not run."""
    machine: str

    def records(self) -> tuple[Timed, ...]:
        """Return the phases."""
        return self.timed

    def table(self, columns: Sequence[str] = COLUMNS) -> Table:
        """Return columns, of `COLUMNS`, and rows."""
        return table(Timed, self.timed, columns)

    def outputs(self) -> str:
        """Return which outputs are computed, as in the FMU of the scene, and what that takes away."""
        named = None if self.scene.fmu is None else self.scene.fmu.outputs
        if named is None:
            return "all outputs are computed; an FMU whose scene names few (fmu.outputs) may be faster"
        more = f" and {len(named) - _NAMES} more" if len(named) > _NAMES else ""
        return (
            f"computed as in the FMU, for fmu.outputs = {', '.join(named[:_NAMES])}{more}: balls, contacts, "
            "sound and sensors only as far as these show them"
        )

    def advice(self) -> str:
        """Return in two or three sentences which fidelity keeps the step and what to change.

        A fidelity keeps the step if its worst step takes no more of the processor than the step is long. The
        most complete one that does is named, with sound where there is any.
        """
        costs = self._costs()
        kept = [cost for cost in costs if cost.worst <= self.step]
        if not kept:
            return self._none(costs)
        best = kept[0]
        words = [f"{_capital(best.name)} keeps the step of {_time(self.step)}: {self._share(best.worst)}."]
        sounding = max(count for _, count in (cost.case for cost in costs))
        missed = [cost for cost in costs if cost.worst > self.step]
        if best.case[1] < sounding:
            words.append(f"With sound none does: {self._change([one for one in missed if one.case[1]])}.")
        elif not missed and len(costs) > 1:
            words.append("So does every other that was timed.")
        elif missed:
            words.append(f"{_capital(missed[0].name)} does not: {self._change(missed[:1], 'it')}.")
        if late := sum(one.late() for one in self.timed if one.case == best.case):
            words.append(
                f"By the clock {late} of its steps came late all the same, as other work took the processor."
            )
        return " ".join(words)

    def _none(self, costs: list[_Cost]) -> str:
        """Advice where nothing keeps the step."""
        none = f"No fidelity keeps the step of {_time(self.step)}"
        buffered = [cost for cost in costs if cost.longer(self.step) < math.inf]
        # a single long step says little of a fidelity: with a buffer, or else on average, is what counts
        near = min(buffered, key=lambda one: one.worst) if buffered else min(costs, key=lambda one: one.mean)
        took = f"takes up to {_time(near.worst)}"
        if not buffered:
            took = f"takes {_time(near.mean)} on average, which is least, and up to {_time(near.worst)}"
        words = [f"{none}: {near.name} {took}.", self._at_held(costs)]
        change = self._change(costs)
        if not buffered and near.mean > near.held.mean() and near.case[0] != FIDELITIES[0]:
            change = f"let the run-up take longer, so that less is renewed in a second; {change}"
        return " ".join([*filter(None, words), f"To change: {change}."])

    def _at_held(self, costs: list[_Cost]) -> str:
        """Return what keeps the step at the held speed, in every step or on average; "": none does."""
        if kept := [cost for cost in costs if cost.held.max() <= self.step]:
            return f"At the held speed {kept[0].name} does: {self._share(float(kept[0].held.max()))}."
        usual = [cost for cost in costs if cost.held.mean() <= self.step]
        if not usual:
            return ""
        first, fastest = usual[0], min(usual, key=lambda one: one.held.mean())
        words = f"At the held speed {first.name} keeps it on average, by {_time(first.held.mean())}"
        if (longer := first.longer(self.step, [HELD])) < math.inf:
            words += f", and with a buffer of {_time(longer)}"
        if fastest is not first:
            words += f"; {fastest.name} takes {_time(fastest.held.mean())}"
        return f"{words}."

    def _costs(self) -> list[_Cost]:
        """Costs with sound, the most complete fidelity first, then without."""
        cases = list(dict.fromkeys(one.case for one in self.timed))
        cases.sort(key=lambda case: (-case[1], FIDELITIES.index(case[0])))  # type: ignore[arg-type]
        return [_Cost(case, {o.phase: o.cpu for o in self.timed if o.case == case}) for case in cases]

    def _share(self, worst: float) -> str:
        """Words for the worst step beside the step."""
        share = worst / self.step
        margin = ", which leaves little margin" if share > _AMPLE else ""
        return f"its worst step takes {_time(worst)}, {number(100.0 * share)} % of it{margin}"

    def _change(self, costs: list[_Cost], who: str = "") -> str:
        """Words for what lets one of several cases keep up: a longer step where one helps, else less work.

        ``who``: in place of the name of a case that was named already.
        """
        for cost in costs:
            if (longer := cost.longer(self.step)) < math.inf:
                return f"{who or cost.name} would keep a step of {_time(longer)}, or a buffer as long"
        first = min(costs, key=lambda one: one.mean)
        if self.step < _SHORT:
            return f"give a longer step; below {_time(_SHORT)} the cost of a step falls less than its length"
        steps = "its steps" if who else f"steps of {first.name}"
        reason = f"{steps} take {_time(first.mean)} on average, so that a longer one helps little"
        return f"{reason}; take {_either(self._less(first), 'a faster machine')}"

    def _less(self, cost: _Cost) -> list[str]:
        """Name what the scene could leave out."""
        fidelity, count = cost.case
        faster = [one.case[0] for one in self._costs() if one.case[1] == count and one.mean < self.step]
        ways = [f"fidelity {faster[0]}"] if faster else []
        if count:
            ways += ["fewer microphones", "no sound"] if count > 1 else ["no sound"]
        if fidelity == FIDELITIES[0] and self.scene.imperfections is not None:  # others hardly change
            ways.append("a lower highest order of waves (`imperfections.highest_frequency_kHz`)")
        return ways


def name_of(fidelity: str, microphones: int) -> str:
    """Return a fidelity and its sound in words."""
    sound = f"with {microphones} microphone{'s' * (microphones > 1)}" if microphones else "without sound"
    return f"{fidelity} {sound}"


def _either(ways: Sequence[str], last: str) -> str:
    return ", ".join([*ways, f"or {last}"]) if ways else last


def _capital(words: str) -> str:
    return words[0].upper() + words[1:]


def _time(seconds: float) -> str:
    """Return a time in the unit that suits it."""
    for unit, scale in (("s", 1.0), ("ms", 1e3)):
        if seconds * scale >= 0.9995:  # what three digits round to 1
            return f"{seconds * scale:.3g} {unit}"
    return f"{seconds * 1e6:.3g} us"
