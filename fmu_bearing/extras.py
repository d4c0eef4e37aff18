"""Optional packages: imported where they are used; an error names the missing one.

Nothing imports an optional package by a statement of its own: `need` does it, at the first use, so that the
core works without it and its absence is reported in one way.
"""

import importlib
from collections.abc import Callable
from types import ModuleType

#: Package to import, and the extra of this package that installs it.
EXTRAS = {
    "skfem": "elastic",
    "matplotlib": "plots",
    "xarray": "results",
    "pandas": "results",
    "h5netcdf": "results",
    "plotly": "report",
    "jinja2": "report",
    "distributed": "cluster",
    "fmu_manipulation_toolbox": "validate",
    "mosqito": "psychoacoustics",
    "ziglang": "cross",
    "SALib": "salib",
}
#: What the extra ``elastic`` is for, in its error message.
BENDING = "bending of the rings (table `flexure`)"


class MissingExtra(ImportError):
    """A required package is not installed; the message names the extra that installs it."""


def install_command(package: str) -> str:
    """Return the command that installs an optional package with its extra."""
    return f"pip install 'fmu-bearing[{EXTRAS[package]}]'"


def need(name: str, purpose: str) -> ModuleType:
    """Import ``name`` (dotted); ``MissingExtra`` says which extra to install for ``purpose``."""
    try:
        return importlib.import_module(name)
    except ImportError as problem:
        package = name.split(".")[0]
        raise MissingExtra(
            f"{purpose} needs the package {package}: {install_command(package)} ({problem})"
        ) from None


def available(name: str, purpose: str, left_out: str, tell: Callable[[str], None]) -> bool:
    """Whether ``name`` can be imported; otherwise print what is left out, and the extra to install."""
    try:
        need(name, purpose)
    except MissingExtra as absent:
        tell(f"left out: {left_out}: {absent}")
        return False
    return True
