"""The plan of a test run, and its execution."""

import os
import warnings
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from fmu_bearing.results.result import Run
from fmu_bearing.run.simulate import Inputs, simulate


@dataclass(frozen=True)
class Plan:
    """A run of an FMU; arguments as for `fmu_bearing.simulate`.

    Attributes
    ----------
    stop_time, step : float
        s; variables are kept at the end of each communication step.
    inputs : mapping, structured array or path, optional
        Numbers or functions of time by name, or a table; SI units.
    start_values : mapping, optional
        Inputs and parameters at the start.
    outputs : sequence of str, optional
        Variables to keep, with ``*`` for any text; default: all outputs.

    Examples
    --------
    >>> from fmu_bearing.testing import Plan
    >>> plan = Plan(stop_time=0.02, inputs={"shaft_speed": 2000.0}, outputs=["friction_torque", "heat.*"])
    """

    stop_time: float
    step: float = 1e-3
    inputs: Inputs | None = None
    start_values: Mapping[str, float] | None = None
    outputs: Sequence[str] | None = None


def step_fmu(fmu: str | os.PathLike[str], plan: Plan) -> Run:
    """Run an FMU (or a scene) by a plan.

    Raises
    ------
    AssertionError
        When the FMU refuses a step before the end of the plan.
    ValueError
        For a plan that does not fit the FMU, or a file that is not an FMU.
    """
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")  # an early end is reported below
        run = simulate(
            os.fspath(fmu), plan.stop_time, step=plan.step, inputs=plan.inputs,
            start_values=plan.start_values, outputs=plan.outputs, progress=False,
        )  # fmt: skip
    if not run.complete:
        raise AssertionError(
            f"{os.fspath(fmu)} came to t = {run.time[-1]:g} s of {plan.stop_time:g} s: {run.note}"
        )
    return run
