"""Files of a table of stiffness and damping: CSV, netCDF."""

import os
from collections.abc import Iterator
from importlib.metadata import version
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.sources import source_hash
from fmu_bearing.extras import need
from fmu_bearing.modal.equations.coordinates import FREEDOMS
from fmu_bearing.results.base import write_netcdf
from fmu_bearing.results.result import check_target
from fmu_bearing.results.table import write_csv
from fmu_bearing.steady.stiffness.stiffness_table import StiffnessTable

if TYPE_CHECKING:
    import xarray

_TILTS = ("by", "bz")
STATIC, DYNAMIC = "static", "dynamic"


def save(table: StiffnessTable, path: str | os.PathLike[str]) -> Path:
    """Write a table to ``.csv`` or ``.nc``; see `BearingStiffness.save`."""
    target = check_target(path, "a table of stiffness")
    if target.suffix == ".csv":
        return write_csv(target, columns(), list(_rows(table)))
    return write_netcdf(target, dataset(table))


def columns() -> list[str]:
    """Heads of the CSV file."""
    entries = [(force, motion) for force in FREEDOMS for motion in FREEDOMS]
    heads = ["matrix", "speed_rpm", "preload_N", "frequency_Hz"]
    heads += [f"K_{force}_{motion} [{unit(force, motion)}]" for force, motion in entries]
    return heads + [f"C_{force}_{motion} [{unit(force, motion, damping=True)}]" for force, motion in entries]


def unit(force: str, motion: str, damping: bool = False) -> str:
    """Return the unit of an entry: a force or moment by a displacement or tilt."""
    above = ["N"] + ["m"] * (force in _TILTS) + ["s"] * damping
    below = "rad" if motion in _TILTS else "m"
    if below in above:
        above.remove(below)
        return ".".join(above)
    return f"{'.'.join(above)}/{below}"


def _rows(table: StiffnessTable) -> Iterator[list[str]]:
    """Yield the rows of the CSV file: of each point that for frequency to 0, then one per frequency."""
    empty = [""] * len(FREEDOMS) ** 2
    for i, speed in enumerate(table.speeds):
        for k, preload in enumerate(table.preloads):
            point = [_text(speed), _text(preload)]
            yield [STATIC, *point, "", *map(_text, table.static[i, k].ravel()), *empty]
            for f, frequency in enumerate(table.frequencies):
                numbers = np.concatenate([table.K[i, k, f].ravel(), table.C[i, k, f].ravel()])
                yield [DYNAMIC, *point, _text(frequency), *map(_text, numbers)]


def _text(value: float) -> str:
    return repr(float(value))


def dataset(table: StiffnessTable) -> "xarray.Dataset":
    """Return a table as a dataset; see `BearingStiffness.to_xarray`."""
    xr = need("xarray", "a dataset")
    over = ("speed", "preload", "frequency")
    pair = ("force", "motion")
    si = "SI: N or N.m per m or rad"
    names: NDArray[np.object_] = np.array(FREEDOMS, dtype=object)
    variables = {
        "K": ((*over, *pair), table.K, {"units": si, "long_name": "Stiffness"}),
        "C": ((*over, *pair), table.C, {"units": f"{si}, times s", "long_name": "Damping"}),
        "static": (
            (*over[:2], *pair),
            table.static,
            {"units": si, "long_name": "Stiffness for frequency to 0"},
        ),
        "f_c": (over[:2], table.orbit, {"units": "Hz", "long_name": "Frequency of the balls' orbit"}),
        "spread": (over[:2], table.spread, {"units": "", "long_name": "Range over one ball pitch, over K"}),
    }
    coords = {
        "speed": ("speed", table.speeds, {"units": "r/min", "long_name": "Shaft speed"}),
        "preload": ("preload", table.preloads, {"units": "N", "long_name": "Preload"}),
        "frequency": ("frequency", table.frequencies, {"units": "Hz", "long_name": "Frequency"}),
        "force": ("force", names, {"long_name": "Force along, or moment about, on the inner ring"}),
        "motion": ("motion", names, {"long_name": "Displacement along, or tilt about, of the inner ring"}),
    }
    head = {
        "title": f"Stiffness and damping of {table.scene.name}",
        "scene": table.scene.to_toml(),
        "spacing": table.spacing,
        "fmu_bearing": version("fmu-bearing"),
        "engine": source_hash(),
    }
    return xr.Dataset(variables, coords, head)
