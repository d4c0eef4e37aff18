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
