"""Sound levels as they are drawn and listed: absent where there is none.

A variable has to hold a number at all times, so a meter without signal, because metering has not
begun or because its source is silent, reads the floor of -106 dB. That is no level: pictures leave a gap.
"""

import math

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: What a meter reads of nothing (dB re 20 uPa): 1e-20 Pa^2, see `acoustics.filters.weighting.level`.
SILENCE = 10.0 * math.log10(1e-20 / 4e-10)
#: What rounding leaves of a silent component in a whole recording stays below it (dB; 7003C-spindle: -99).
ROUNDING = -80.0
#: dB below the highest level: what spectra and maps show.
RANGE = 70.0
_ROOM = 1.0  # dB above: there four fifths of what is read is the floor itself


def present(values: ArrayLike, unit: str) -> NDArray[np.float64]:
    """Return values of a variable with NaN in place of levels (unit ``"dB"``) that are not there."""
    levels = np.array(values, dtype=float)
    if unit == "dB":
        levels[levels < SILENCE + _ROOM] = np.nan
    return levels


def decibels(value: float | None, digits: int = 1) -> str:
    """Return a level (dB) as text for a table; a dash for that of a silent component, and for none."""
    return "-" if value is None or not value >= ROUNDING else f"{value:.{digits}f}"


def sounding(values: ArrayLike) -> NDArray[np.float64]:
    """Return levels (dB) of a component as they are, all of them NaN where it is silent."""
    levels = np.array(values, dtype=float)
    return levels if np.max(levels) >= ROUNDING else np.full_like(levels, np.nan)


def shown(value: float, unit: str) -> str:
    """Return a value as text for a table, six digits; a dash for a level that is not there."""
    there = float(present(value, unit))
    return "-" if math.isnan(there) else f"{there:.6g}"


def radial_range(low: float, high: float) -> tuple[float, float]:
    """Return the ends of a radial axis for levels (dB): whole steps of 5 dB, 10 to 40 dB apart."""
    end = 5.0 * math.ceil((high + 0.5) / 5.0)
    return max(min(5.0 * math.floor((low - 1.0) / 5.0), end - 10.0), end - 40.0), end


def mapped(
    places: NDArray[np.float64], levels: NDArray[np.float64]
) -> tuple[NDArray[np.intp], NDArray[np.float64], float]:
    """Return the rows of a map (dB) in the order of their places, levels no lower than drawn, the highest."""
    order, top = np.argsort(places), float(levels.max())
    return order, np.maximum(levels[order], top - RANGE), top
