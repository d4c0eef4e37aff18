"""Tests of FMUs: fixtures for pytest, and comparison with recorded references.

``plan``        `Plan`: inputs, times and outputs of a run; `step_fmu`
``comparison``  `compare`: where a run first departs from a reference, and by how much
``plugin``      options, marker and fixtures; pytest finds it by itself once the package is installed

pytest reads this file in every project of the environment, so names are imported on first use.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from fmu_bearing.testing.comparison import Departure, compare, report
    from fmu_bearing.testing.plan import Plan, step_fmu

_PLACES = {
    "Departure": "comparison",
    "Plan": "plan",
    "compare": "comparison",
    "report": "comparison",
    "step_fmu": "plan",
}

__all__ = ["Departure", "Plan", "compare", "report", "step_fmu"]


def __getattr__(name: str) -> Any:
    if name not in _PLACES:
        raise AttributeError(f"fmu_bearing.testing has no '{name}'; public names are {', '.join(__all__)}")
    return getattr(import_module(f"fmu_bearing.testing.{_PLACES[name]}"), name)
