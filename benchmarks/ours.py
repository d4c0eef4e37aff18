"""Time the engine's fidelities and integrators, and take their errors from the reference trajectory."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from benchmarks.cases import WARM_UP, Case, Solver
from benchmarks.table import Row
from fmu_bearing.accuracy.reference import explicit_rings, implicit_rings, relative_error
from fmu_bearing.arrays import Arrays, EngineError
from fmu_bearing.engine.layout import P
from fmu_bearing.run.metrics import SAMPLE
from fmu_bearing.run.paces import speed

#: Settings among which the fastest is sought whose error is within ``LIMIT``.
SETTINGS = (
    *((tolerance, step) for tolerance in (1e-2, 3e-3, 1e-3, 3e-4)
      for step in (40e-6, 30e-6, 25e-6, 20e-6, 15e-6, 10e-6)),
    (1e-4, 10e-6), (1e-4, 5e-6), (3e-5, 2.5e-6), (1e-5, 1e-6),
)  # fmt: skip
LIMIT = 1e-3


@dataclass(frozen=True)
class Reference:
    """A reference trajectory and an estimate of its error.

    Attributes
    ----------
    times : ndarray
        Times (s) after the start of the window.
    velocities : ndarray
        Inner ring x, y, z, outer ring x, y, z (m/s), one row per time, by the explicit method.
    agreement : float
        Relative rms difference of the implicit method's velocities.
    explicit_cost, implicit_cost : float
        CPU time (s) per simulated s.
    """

    times: NDArray[np.float64]
    velocities: NDArray[np.float64]
    agreement: float
    explicit_cost: float
    implicit_cost: float


def reference_from(
    bearing: Arrays,
    duration: float,
    *,
    sample: float = 1e-4,
    explicit_step: float = 4e-8,
    implicit_step: float = 5e-7,
    implicit_tolerance: float = 1e-8,
) -> Reference:
    """Integrate from the bearing's present state by both methods; that state is not changed.

    Parameters
    ----------
    bearing : Arrays
        Initialised, speed and inputs held.
    duration, sample : float
        Window and sampling interval (s).
    explicit_step, implicit_step : float
        Steps (s) of Runge-Kutta and of the engine's implicit method.
    implicit_tolerance : float
        Tolerance of the latter, relative to the rings' own velocity.
    """
    exact, explicit = explicit_rings(bearing, duration, sample, explicit_step)
    other, implicit = implicit_rings(bearing, duration, sample, implicit_step, implicit_tolerance)
    times = sample * np.arange(1.0, len(exact) + 1.0, dtype=np.float64)
    return Reference(times, exact, relative_error(other, exact), explicit / duration, implicit / duration)


def ring_rms(rows: NDArray[np.float64]) -> NDArray[np.float64]:
    """Rms velocity about the mean of inner and outer ring, the three axes together."""
    return np.asarray(np.sqrt(rows.var(axis=0).reshape(2, 3).sum(axis=1)))


def started(case: Case, solver: Solver, warm_up: float) -> Arrays:
    """Bearing of a case that has run by ``solver`` from its start for ``warm_up`` (s)."""
    scene = case.quiet(model=solver.fidelity, method=solver.method)
    tolerance, step = case.setting
    bearing = case.arrays(scene, **solver.parameters, TOLERANCE=tolerance, MAX_STEP=step)
    bearing.init()
    bearing.run(warm_up, case.communication)
    return bearing


class Full:
    """One integrator of fidelity ``full`` in one case, at any setting."""

    def __init__(self, case: Case, solver: Solver, start: Arrays, exact: Reference) -> None:
        self._case, self._solver, self._start = case, solver, start
        every = round(case.communication / SAMPLE)
        self._exact = exact.velocities[every - 1 :: every]

    def bearing(self, setting: tuple[float, float]) -> Arrays:
        """Bearing in the case's state."""
        tolerance, step = setting
        return self._start.with_parameters(**self._solver.parameters, TOLERANCE=tolerance, MAX_STEP=step)

    def error(self, setting: tuple[float, float]) -> float:
        """Error over the case's window."""
        rows = self.bearing(setting).rings(self._case.window, self._case.communication)
        return relative_error(rows, self._exact)

    def speed(self, setting: tuple[float, float], budget: float, repeats: int) -> tuple[float, float]:
        """Simulated s per wall s and per CPU s, a start for no longer than its window."""
        longest = self._case.window if self._case.kind == "start" else 1.0
        return speed(self.bearing(setting), budget, repeats, longest, self._case.communication)

    def fastest(self, budget: float) -> tuple[float, float] | None:
        """Fastest setting whose error is within ``LIMIT``, each looked at for an eighth of ``budget`` (s)."""
        found = {}
        for setting in SETTINGS:
            try:
                if self.error(setting) <= LIMIT:
                    found[setting] = self.speed(setting, budget / 8, 2)[1]
            except EngineError:
                continue
        return max(found, key=lambda setting: found[setting]) if found else None

    def row(self, setting: tuple[float, float], words: str, budget: float, repeats: int) -> Row:
        """Row of the main table."""
        row = Row(self._case.name, self._solver.name, goal=self._case.goal(self._solver))
        row.setting = f"{words}: tol {setting[0]:g}, h <= {1e6 * setting[1]:g} us"
        try:
            row.error = self.error(setting)
            row.wall, row.cpu = self.speed(setting, budget, repeats)
        except EngineError as problem:
            row.remark = f"refused: {problem}"
        return row


def full_rows(
    case: Case, solver: Solver, start: Arrays, exact: Reference, budget: float, repeats: int
) -> list[Row]:
    """Rows of one integrator of fidelity ``full``: at the case's setting, and at the fastest within 1e-3.

    RK4 has only the first, as stability alone decides on its step.
    """
    full = Full(case, solver, start, exact)
    rows = [full.row(case.setting, "usual", budget, repeats)]
    if solver.method != "rk4":
        best = full.fastest(budget)
        if best is not None:
            rows.append(full.row(best, "fastest", budget, repeats))
    return rows


def fidelity_row(case: Case, solver: Solver, start: Arrays, budget: float, repeats: int) -> Row:
    """Row of a fidelity that approximates ``full``: its error is that of integration.

    It is taken against itself at a quarter of the step, the speed in communication steps of 1 ms: each costs
    as much as many internal steps. The remark gives the difference of both rings' rms velocity from ``full``.
    """
    row = Row(case.name, solver.name, goal=case.goal(solver))
    window = 0.05
    try:
        full = ring_rms(start.with_parameters().rings(window, SAMPLE))
        bearing = started(case, solver, WARM_UP)
        step = bearing.p[P.MAX_STEP]
        row.setting = f"h <= {1e6 * step:g} us"
        state = bearing.with_parameters()
        own = state.rings(window, SAMPLE)
        apart = ring_rms(own) / full - 1.0
        finer = bearing.with_parameters(MAX_STEP=step / 4, TOLERANCE=1e-5)
        few = round(case.window / SAMPLE)
        row.error = relative_error(own[:few], finer.rings(case.window, SAMPLE))
        row.remark = f"rms from full: inner {apart[0]:+.1%}, outer {apart[1]:+.1%}"
        row.wall, row.cpu = speed(bearing, budget, repeats, 1.0)
    except EngineError as problem:
        row.remark = f"refused: {problem}"
    return row


def rows_of(
    case: Case, solvers: Sequence[Solver], budget: float, repeats: int
) -> tuple[list[Row], Arrays, Reference]:
    """Rows of all solvers, with the state they started from and the reference."""
    start = case.bearing()
    exact = reference_from(start, case.window, sample=SAMPLE)
    rows = []
    for solver in solvers:
        if solver.fidelity == "full":
            rows += full_rows(case, solver, start, exact, budget, repeats)
        elif case.kind != "start":
            rows.append(fidelity_row(case, solver, start, budget, repeats))
    return rows, start, exact
