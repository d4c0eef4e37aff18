"""Optional packages: imported where they are used; an error names the missing one."""

import importlib
from types import ModuleType

#: Package to import, and the extra of this package that installs it.
EXTRAS = {
    "xarray": "results",
    "h5netcdf": "results",
    "plotly": "report",
    "jinja2": "report",
    "distributed": "cluster",
    "fmu_manipulation_toolbox": "validate",
}


class MissingExtra(ImportError):
    """A required package is not installed; the message names the extra that installs it."""


def need(name: str, purpose: str) -> ModuleType:
    """Import ``name`` (dotted); ``MissingExtra`` says which extra to install for ``purpose``."""
    try:
        return importlib.import_module(name)
    except ImportError as problem:
        package = name.split(".")[0]
        extra = EXTRAS[package]
        raise MissingExtra(
            f"{purpose} needs the package {package}: pip install 'fmu-bearing[{extra}]' ({problem})"
        ) from None
