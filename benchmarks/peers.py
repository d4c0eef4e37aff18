"""General-purpose integrators on the same right-hand side, from the same state, to about the same error.

SciPy's Radau, LSODA and BDF, and SUNDIALS' CVODE through scikit-sundae. Each gets the right-hand side as one
compiled call on flat arrays, the engine's own Jacobian (derived, not by 142 evaluations), and absolute
tolerances by component. The tolerance is loosened step by step as far as the error allows.
"""

import importlib.metadata
import time
from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from benchmarks.first_order import FirstOrder
from benchmarks.table import Row
from fmu_bearing.accuracy.reference import relative_error

#: Relative tolerances; absolute ones are these times the scale of each component. Each solver starts at the
#: one that usually meets the error and moves by what it finds there.
TOLERANCES = (3e-3, 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 3e-6, 1e-6, 3e-7, 1e-7, 1e-8)
SCIPY = {"Radau": 1e-3, "LSODA": 1e-4, "BDF": 3e-5}
CVODE = 3e-5

Solve = Callable[[FirstOrder, NDArray[np.float64], float, float], NDArray[np.float64]]


class OverTime(Exception):
    """The solver has used its share of the clock."""


def scipy_solver(method: str) -> Solve:
    """Integrator of SciPy by its name in ``solve_ivp``."""

    def solve(
        problem: FirstOrder, times: NDArray[np.float64], tolerance: float, deadline: float
    ) -> NDArray[np.float64]:
        from scipy.integrate import solve_ivp

        def rate(t, x):
            if time.perf_counter() > deadline:
                raise OverTime
            dx = np.empty(problem.size)
            problem.rate(t, np.ascontiguousarray(x), dx)
            return dx

        def jacobian(t, x):
            out = np.empty((problem.size, problem.size))
            problem.jacobian(t, np.ascontiguousarray(x), out)
            return out

        found = solve_ivp(
            rate, (0.0, times[-1]), problem.start, method, t_eval=times, rtol=tolerance,
            atol=tolerance * problem.scale, jac=jacobian,
        )  # fmt: skip
        return found.y.T

    return solve


def cvode(
    problem: FirstOrder, times: NDArray[np.float64], tolerance: float, deadline: float
) -> NDArray[np.float64]:
    """CVODE's BDF with dense LAPACK factors."""
    from sksundae.cvode import CVODE as Solver

    def rate(t, y, yp):
        problem.rate(t, np.array(y), yp)

    out = np.empty((problem.size, problem.size))

    def jacobian(t, y, yp, matrix):
        problem.jacobian(t, np.array(y), out)
        matrix[:] = out

    solver = Solver(
        rate, jacfn=jacobian, rtol=tolerance, atol=tolerance * problem.scale, linsolver="lapackdense",
        max_num_steps=10**6,
    )  # fmt: skip
    solver.init_step(0.0, problem.start.copy())
    rows = np.empty((len(times), problem.size))
    for n, t in enumerate(times):
        if time.perf_counter() > deadline:
            raise OverTime
        rows[n] = solver.step(t).y
    return rows


def solvers() -> dict[str, tuple[Solve, float] | None]:
    """Every peer with its first tolerance; None where its package is missing."""
    found: dict[str, tuple[Solve, float] | None] = {
        name: (scipy_solver(name), first) for name, first in SCIPY.items()
    }
    try:
        import sksundae.cvode  # noqa: F401

        found["CVODE"] = (cvode, CVODE)
    except ImportError:
        found["CVODE"] = None
    return found


def version(package: str) -> str:
    """Installed version, or "not installed"."""
    try:
        return importlib.metadata.version(package)
    except importlib.metadata.PackageNotFoundError:
        return "not installed"


def peer_row(
    case: str, name: str, entry: tuple[Solve, float] | None, problem: FirstOrder,
    exact: NDArray[np.float64], times: NDArray[np.float64], limit: float, seconds: float,
    repeats: int = 0,
) -> Row:  # fmt: skip
    """The loosest tolerance with an error within ``limit``, or the tightest that ``seconds`` allowed."""
    row = Row(case, name, ours=False)
    if entry is None:
        row.remark = "not installed"
        return row
    solve, first = entry
    warm(problem)
    deadline = time.perf_counter() + seconds
    place = TOLERANCES.index(first)
    best: Row | None = None
    tried: dict[int, float] = {}
    while 0 <= place < len(TOLERANCES) and place not in tried:
        setting = f"rtol {TOLERANCES[place]:g}"
        clock, used = time.perf_counter(), time.process_time()
        try:
            found = solve(problem, times, TOLERANCES[place], deadline)
        except OverTime:
            row.remark = f"stopped after {seconds:g} s"
            break
        except RuntimeError as problem_met:
            row.remark = f"failed at {setting}: {problem_met}"
            break
        wall, cpu = time.perf_counter() - clock, time.process_time() - used
        if len(found) < len(times):
            tried[place] = float("inf")
        else:
            tried[place] = relative_error(found[:, problem.rings], exact)
            trial = Row(case, name, setting, tried[place], times[-1] / wall, times[-1] / cpu, ours=False)
            fits = trial.error <= limit
            better = best is None or (
                (trial.wall > best.wall or best.error > limit) if fits else trial.error < best.error
            )
            if better:
                best = trial
        place += -1 if tried[place] <= limit else 1
    if best is None:
        return row
    best.remark = row.remark
    again(best, solve, problem, times, repeats)
    return best


def warm(problem: FirstOrder) -> None:
    """Compile what every peer calls, so that no peer's clock pays for it."""
    problem.jacobian(0.0, problem.start, np.empty((problem.size, problem.size)))
    problem.rate(0.0, problem.start, np.empty(problem.size))


def again(row: Row, solve: Solve, problem: FirstOrder, times: NDArray[np.float64], repeats: int) -> None:
    """Time the chosen setting ``repeats`` times more where it takes less than a second; keep the best."""
    tolerance = float(row.setting.split()[1])
    for _ in range(repeats if row.wall > times[-1] else 0):
        clock, used = time.perf_counter(), time.process_time()
        solve(problem, times, tolerance, np.inf)
        row.wall = max(row.wall, times[-1] / (time.perf_counter() - clock))
        row.cpu = max(row.cpu, times[-1] / (time.process_time() - used))
