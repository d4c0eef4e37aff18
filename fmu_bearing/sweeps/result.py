"""Results of a sweep: a dataset over its axes, netCDF and CSV."""

import math
import os
import pathlib
from importlib.metadata import version
from typing import TYPE_CHECKING, Any

import numba
import numpy as np

from fmu_bearing.engine.sources import source_hash
from fmu_bearing.extras import need
from fmu_bearing.results.base import write_netcdf
from fmu_bearing.results.table import write_csv
from fmu_bearing.sweeps.figures import HOW
from fmu_bearing.sweeps.plan import Plan
from fmu_bearing.sweeps.point import Outcome, code_digest

if TYPE_CHECKING:
    import xarray

NOT_RUN = "not run"
#: Values of each point, beside the figures.
SEED, WALL, REASON = "seed", "wall", "reason"


def dataset(plan: Plan, outcomes: dict[str, Outcome]) -> "xarray.Dataset":
    """Return figures over the axes; points without figures have NaN and a ``reason``."""
    xr = need("xarray", "a sweep")
    rows = [outcomes.get(task.key) for task in plan.tasks]
    blank = (math.nan,) * len(plan.figures)
    dims = [axis.name for axis in plan.axes]

    def grid(values: list[Any], kind: Any = np.float64) -> np.ndarray:
        return np.array(values, dtype=kind).reshape(plan.shape)

    variables: dict[str, Any] = {}
    for place, figure in enumerate(plan.figures):
        about = {"units": figure.unit, "long_name": figure.words, "statistic": HOW[figure.statistic]}
        values = [(blank if row is None else row.figures)[place] for row in rows]
        variables[figure.name] = (dims, grid(values), about)
    if SEED not in dims:
        seeds = [-1 if (i := task.scene.imperfections) is None else i.seed for task in plan.tasks]
        about = {"long_name": "Seed of the imperfections; -1: a perfect bearing"}
        variables[SEED] = (dims, grid(seeds, np.int64), about)
    walls = [math.nan if row is None else row.wall for row in rows]
    variables[WALL] = (dims, grid(walls), {"units": "s", "long_name": "Wall time of the point"})
    reasons = [NOT_RUN if row is None else row.reason for row in rows]
    words = {"long_name": "Why there are no figures; empty: there are"}
    variables[REASON] = (dims, grid(reasons, object), words)
    coords = {}
    for axis in plan.axes:
        about = {"units": axis.unit, "long_name": axis.words, "key": axis.key}
        coords[axis.name] = (axis.name, _values(axis.values), about)
    return xr.Dataset(variables, coords, _attributes(plan))


def _values(values: tuple[Any, ...]) -> np.ndarray:
    if any(isinstance(value, str) for value in values):
        return np.array(values, dtype=object)
    return np.array(values)


def _attributes(plan: Plan) -> dict[str, Any]:
    """Return the attributes of the dataset: scene, settings, versions, to repeat the sweep."""
    return {
        "title": f"Sweep of {plan.scene.name} over " + ", ".join(axis.key for axis in plan.axes),
        "scene": plan.scene.to_toml(),
        "settle_s": plan.settle,
        "window_s": plan.window,
        "fmu_bearing": version("fmu-bearing"),
        "engine": source_hash(),
        "code": code_digest(),
        "numpy": np.__version__,
        "numba": numba.__version__,
        "note": plan.note,
    }


def save(data: "xarray.Dataset", folder: str | os.PathLike[str]) -> dict[str, pathlib.Path]:
    """Write ``sweep.nc`` (netCDF) and ``sweep.csv`` (a row per point, SI units) into a folder.

    Raises
    ------
    MissingExtra
        Without h5netcdf.
    """
    need("h5netcdf", "netCDF")
    netcdf = write_netcdf(pathlib.Path(folder) / "sweep.nc", data)
    columns, rows = table_of(data)
    cells = [[text_of(value) for value in row] for row in rows]
    return {"netcdf": netcdf, "csv": write_csv(netcdf.with_suffix(".csv"), columns, cells)}


def table_of(data: "xarray.Dataset") -> tuple[list[str], list[list[Any]]]:
    """Return heads, with units, and one row per point, axes first."""
    dims = [str(name) for name in data.dims]
    names = [*dims, *(str(name) for name in data.data_vars)]
    units = [data[name].attrs.get("units", "") for name in names]
    heads = [f"{name} [{unit}]" if unit else name for name, unit in zip(names, units, strict=True)]
    whole = [data[name].broadcast_like(data[REASON]).transpose(*dims).values.ravel() for name in names]
    return heads, [list(row) for row in zip(*whole, strict=True)]


def text_of(value: Any) -> str:
    """Return the text of a cell: numbers with all their digits, nothing for NaN."""
    if isinstance(value, float):  # NumPy's numbers are of this kind too
        return "" if math.isnan(value) else repr(float(value))
    return str(value)


#: Heads of `extremes`.
COLUMNS = ("figure", "unit", "least", "at", "largest", "at")


def extremes(data: "xarray.Dataset") -> list[dict[str, Any]]:
    """Return the least and the largest of each figure and where they are, in the order of the axes."""
    ends = []
    for name, values in data.data_vars.items():
        if name in (SEED, WALL, REASON) or not np.isfinite(values).any():
            continue
        row: dict[str, Any] = {"figure": str(name), "unit": values.attrs["units"]}
        for word, place in (("least", values.argmin(...)), ("largest", values.argmax(...))):
            one = values.isel(place)
            row[word] = float(one)
            row[f"{word}_at"] = ", ".join(_short(one[dim].item()) for dim in values.dims)
        ends.append(row)
    return ends


def _short(value: Any) -> str:
    return f"{value:.6g}" if isinstance(value, float) else str(value)
