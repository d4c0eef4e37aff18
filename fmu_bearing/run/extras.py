"""Packages that only some studies need: imported where they are used, named where they are missing."""

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
    """A package is needed that was not installed; the message says which extra brings it."""


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
