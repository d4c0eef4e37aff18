"""Files of a receptance: CSV, and a universal file for programs of modal analysis."""

import os
from collections.abc import Iterator
from pathlib import Path

from fmu_bearing.files import check_file
from fmu_bearing.modal.equations.coordinates import FREEDOMS
from fmu_bearing.modal.receptance.receptance_table import ReceptanceTable
from fmu_bearing.results import uff
from fmu_bearing.results.table import write_csv

ENDINGS = (".csv", ".uff")
_TILTS = ("by", "bz")
_NODE = 1  # of a universal file
_DIRECTIONS = {"x": "x", "y": "y", "z": "z", "by": "ty", "bz": "tz"}


def save(found: ReceptanceTable, path: str | os.PathLike[str]) -> Path:
    """Write a receptance to ``.csv`` or ``.uff``; see `Receptance.save`."""
    target = check_file(path, ENDINGS, "a receptance")
    if target.suffix == ".csv":
        return write_csv(target, _columns(), list(_rows(found)))
    functions = []
    for i, k in _points(found):
        words = f"{found.place} {found.speeds[i]:g} rpm {found.preloads[k]:g} N"
        motions = [
            uff.Place(f"{name} {words}", "rad" if name in _TILTS else "m", _NODE, way)
            for name, way in _DIRECTIONS.items()
        ]
        forces = [
            uff.Place(f"force {name}", "N.m" if name in _TILTS else "N", _NODE, way)
            for name, way in _DIRECTIONS.items()
        ]
        functions += uff.responses(found.frequencies, found.G[i, k], motions, forces)
    return uff.write_uff(target, functions, {_NODE: (0.0, 0.0, 0.0)}, found.scene.name)


def _points(found: ReceptanceTable) -> list[tuple[int, int]]:
    return [(i, k) for i in range(len(found.speeds)) for k in range(len(found.preloads))]


def _columns() -> list[str]:
    """Heads of the CSV file."""
    heads = ["speed_rpm", "preload_N", "frequency_Hz"]
    for part in ("real", "imag"):
        heads += [
            f"{part}_{motion}_{force} [{unit(motion, force)}]" for motion in FREEDOMS for force in FREEDOMS
        ]
    return heads


def unit(motion: str, force: str) -> str:
    """Return the unit of an entry: a displacement or tilt by a force or moment."""
    if motion in _TILTS:
        return "rad/(N.m)" if force in _TILTS else "rad/N"
    return "1/N" if force in _TILTS else "m/N"


def _rows(found: ReceptanceTable) -> Iterator[list[str]]:
    for i, k in _points(found):
        for frequency, entries in zip(found.frequencies, found.G[i, k], strict=True):
            numbers = [
                found.speeds[i],
                found.preloads[k],
                frequency,
                *entries.real.ravel(),
                *entries.imag.ravel(),
            ]
            yield [repr(float(number)) for number in numbers]
