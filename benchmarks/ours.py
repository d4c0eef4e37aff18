"""Time the engine's fidelities and integrators, and take their errors from the reference trajectory."""

from collections.abc import Sequence

import numpy as np

from benchmarks.cases import WARM_UP, Case, Solver, silent
from benchmarks.table import Row
from fmu_bearing.accuracy.reference import Reference, reference_from, relative_error
from fmu_bearing.engine.layout import P
from fmu_bearing.run.arrays import Arrays, Refused
from fmu_bearing.run.metrics import COMMUNICATION, SAMPLE, ring_rms, speed

#: Tolerance and largest internal step (s): the scenes' default, then finer until the error is met.
SETTINGS = ((1e-3, 25e-6), (3e-4, 10e-6), (1e-4, 10e-6), (1e-4, 5e-6), (3e-5, 2.5e-6), (1e-5, 1e-6))
LIMIT = 1e-3


def started(case: Case, solver: Solver, warm_up: float) -> Arrays:
    """Bearing of a case that has run by ``solver`` from its start for ``warm_up`` (s)."""
    scene = silent(case.scene, model=solver.fidelity, method=solver.method)
    bearing = Arrays(scene, case.rpm, load_y=case.load_y, **solver.parameters)
    bearing.init()
    bearing.run(warm_up, COMMUNICATION)
    return bearing


def full_rows(
    case: Case, solver: Solver, start: Arrays, exact: Reference, budget: float, repeats: int
) -> list[Row]:
    """Rows of one integrator of fidelity ``full``: at the scene's settings, and where the error is met."""
    goal = solver.goal if case.kind == "settled" else solver.goal_hard
    rows = []
    for place, (tolerance, step) in enumerate(SETTINGS):
        row = Row(case.name, solver.name, f"tol {tolerance:g}, h <= {1e6 * step:g} us", goal=goal)
        bearing = start.with_parameters(**solver.parameters, TOLERANCE=tolerance, MAX_STEP=step)
        try:
            row.error = relative_error(bearing.with_parameters().rings(case.window, SAMPLE), exact.velocities)
            met = row.error <= LIMIT
            if place == 0 or met or place == len(SETTINGS) - 1:
                longest = case.window if case.kind == "start" else 1.0
                row.wall, row.cpu = speed(bearing, budget, repeats, longest)
                rows.append(row)
        except Refused as problem:
            row.remark = f"refused: {problem}"
            rows.append(row)
            met = False
        if met:
            break
    return rows


def fidelity_row(case: Case, solver: Solver, start: Arrays, budget: float, repeats: int) -> Row:
    """Row of a fidelity that approximates ``full``: error is that of the rings' rms velocity, larger ring.

    The remark gives both rings, and the integration error against itself at a quarter of the step.
    """
    row = Row(case.name, solver.name, goal=solver.goal if case.kind == "settled" else 0.0)
    row.limit = float("inf")
    window = 0.05
    try:
        full = ring_rms(start.with_parameters().rings(window, SAMPLE))
        bearing = started(case, solver, WARM_UP)
        step = bearing.p[P.MAX_STEP]
        row.setting = f"h <= {1e6 * step:g} us"
        state = bearing.with_parameters()
        own = state.rings(window, SAMPLE)
        errors = ring_rms(own) / full - 1.0
        row.error = float(np.abs(errors).max())
        finer = bearing.with_parameters(MAX_STEP=step / 4, TOLERANCE=1e-5)
        few = round(5e-3 / SAMPLE)
        integration = relative_error(own[:few], finer.rings(5e-3, SAMPLE))
        row.remark = f"rms inner {errors[0]:+.1%}, outer {errors[1]:+.1%}; integration {integration:.0e}"
        row.wall, row.cpu = speed(bearing, budget, repeats, 1.0)
    except Refused as problem:
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
