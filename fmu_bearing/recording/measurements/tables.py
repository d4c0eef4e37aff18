"""Tables of sound measurements: columns and rows of text, for `markdown` and `write_csv`.

Examples
--------
>>> from fmu_bearing import tables
>>> print(tables.markdown(*tables.third_octave_table([500.0, 1000.0], {"total": [60.0, 72.5]})), end="")
| band, Hz | total, dB |
| --- | --- |
| 500 | 60.00 |
| 1000 | 72.50 |
"""

import math
from collections.abc import Mapping, Sequence

import numpy as np
from numpy.typing import ArrayLike

from fmu_bearing.acoustics.analysis.lines import Line
from fmu_bearing.acoustics.analysis.order import OrderMap
from fmu_bearing.acoustics.analysis.power import Power
from fmu_bearing.acoustics.analysis.third_octave import nominal_frequency
from fmu_bearing.recording.measurements.measure import MotionPower, Round, Sweep
from fmu_bearing.results.levels import decibels
from fmu_bearing.results.table import Table, markdown, write_csv

__all__ = [
    "Table",
    "attenuation_table",
    "directivity_table",
    "lines_table",
    "markdown",
    "order_table",
    "power_table",
    "round_table",
    "spectrum_table",
    "sweep_table",
    "third_octave_table",
    "write_csv",
]


def lines_table(lines: Sequence[Line]) -> Table:
    """Strongest lines and what explains them; of one that nothing explains, what is nearest."""
    rows = []
    for line in lines:
        name, off = (line.words, line.off) if line.name else ("none", line.nearest_off)
        words = f"{name}; nearest {line.nearest}" if line.nearest else name
        distance = "" if math.isnan(off) else f"{round(off, 1) + 0.0:+.1f}"
        rows.append([f"{line.frequency:.1f}", f"{line.level:.1f}", words, distance])
    return ["frequency, Hz", "level, dB", "explained by", "off by, Hz"], rows


def spectrum_table(frequency: ArrayLike, spectra: Mapping[str, ArrayLike], unit: str = "Hz") -> Table:
    """Levels (dB) over frequency or order, one column each; a dash where there is silence."""
    columns = [f"frequency, {unit}" if unit == "Hz" else unit, *(f"{name}, dB" for name in spectra)]
    values = np.column_stack([np.asarray(frequency, dtype=float), *(np.asarray(v) for v in spectra.values())])
    return columns, [[f"{row[0]:.6g}", *(decibels(value, 2) for value in row[1:])] for row in values]


def third_octave_table(centres: ArrayLike, levels: Mapping[str, ArrayLike]) -> Table:
    """Levels (dB) over nominal centre frequencies."""
    columns, rows = spectrum_table([nominal_frequency(f) for f in np.asarray(centres)], levels)
    return ["band, Hz", *columns[1:]], rows


def order_table(found: OrderMap) -> Table:
    """Levels (dB) of an order map: one row per block, one column per order."""
    columns = ["time, s", "speed, r/min", *(f"order {order:g}, dB" for order in found.orders)]
    rows = [
        [f"{time:.4f}", f"{speed * 30.0 / math.pi:.1f}", *(f"{value:.2f}" for value in levels)]
        for time, speed, levels in zip(found.time, found.speed, found.levels, strict=True)
    ]
    return columns, rows


def round_table(found: Round | Mapping[str, Round], where: str = "") -> Table:
    """Levels over angle, one column per circle or plane, in its unit; ``where``: words on its place."""
    named = {"level": found} if isinstance(found, Round) else dict(found)
    first = next(iter(named.values()))
    levels = np.column_stack([each.levels for each in named.values()])
    rows = [
        [f"{math.degrees(angle):g}", *(f"{value:.2f}" for value in row)]
        for angle, row in zip(first.angles, levels, strict=True)
    ]
    return ["angle, deg", *(f"{name}{where}, {each.unit}" for name, each in named.items())], rows


def directivity_table(found: Mapping[str, Round]) -> Table:
    """DA, DL and DV of circles or planes by name."""
    rows = []
    for name, each in found.items():
        d = each.directivity
        rows.append(
            [
                name,
                f"{math.degrees(d.da):.0f}",
                f"{d.dl:.4f}",
                f"{d.dv:.2f}",
                f"{d.highest:.2f}",
                f"{d.mean:.2f}",
            ]
        )
    unit = " / ".join(dict.fromkeys(each.unit for each in found.values()))
    return ["", "DA, deg", "DL", "DV, dB", f"highest, {unit}", f"mean, {unit}"], rows


def sweep_table(found: Sweep) -> Table:
    """Directivity figures over radial and axial distance."""
    rows, head = [], [""]
    for r, row in zip(found.radii, found.circles, strict=True):
        for x, each in zip(found.axials, row, strict=True):
            head, (figures,) = directivity_table({"": each})
            rows.append([f"{1e3 * r:g}", f"{1e3 * x:g}", *figures[1:]])
    return ["r, mm", "l, mm", *head[1:]], rows


def attenuation_table(found: Sweep) -> Table:
    """Fits of the largest level over distance: dB per doubling."""
    rows = []
    for x, fit in zip(found.axials, found.over_r, strict=False):
        rows.append(["r", f"l = {1e3 * x:g} mm", f"{fit.per_doubling:.2f}", f"{fit.residual:.2f}"])
    for r, fit in zip(found.radii, found.over_l, strict=False):
        rows.append(["l", f"r = {1e3 * r:g} mm", f"{fit.per_doubling:.2f}", f"{fit.residual:.2f}"])
    return ["over", "at", "dB per doubling", "largest deviation, dB"], rows


def power_table(measured: Mapping[str, Power], motion: MotionPower | None = None) -> Table:
    """Sound power by points and, if given, from motion."""
    rows = [
        [
            name,
            f"{power.level:.2f}",
            f"{power.watts:.3e}",
            f"{power.surface_level:.2f}",
            f"{power.spread:.1f}",
        ]
        for name, power in measured.items()
    ]
    if motion is not None:
        for name, level in motion.levels.items():
            rows.append([f"motion, {name}", f"{level:.2f}", f"{motion.watts[name].sum():.3e}", "", ""])
    return ["", "power level, dB", "power, W", "surface level, dB", "spread of points, dB"], rows
