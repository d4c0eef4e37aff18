"""Boundary dimensions of radial bearings by dimension series (ISO 15): 18, 19, 10, 02, 03.

The numbers were written from memory of makers' tables, which follow ISO 15; the standard was not read. NSK's
60 sizes of series 70 and 79 and 11 of 72 and 73, as printed, lie where the table has them (a test).
"""

import math

import numpy as np

__all__ = ["boundary", "series_of"]

_BORES = (
    10, 12, 15, 17, 20, 25, 30, 35, 40, 45, 50, 55, 60, 65, 70, 75, 80, 85, 90, 95, 100, 105, 110, 120,
)  # fmt: skip
#: Outside diameters and widths (mm) by series, at `_BORES`.
_TABLE = {
    "18": (
        (19, 21, 24, 26, 32, 37, 42, 47, 52, 58, 65, 72,
         78, 85, 90, 95, 100, 110, 115, 120, 125, 130, 140, 150),
        (5, 5, 5, 5, 7, 7, 7, 7, 7, 7, 7, 9, 10, 10, 10, 10, 10, 13, 13, 13, 13, 13, 16, 16),
    ),
    "19": (
        (22, 24, 28, 30, 37, 42, 47, 55, 62, 68, 72, 80,
         85, 90, 100, 105, 110, 120, 125, 130, 140, 145, 150, 165),
        (6, 6, 7, 7, 9, 9, 9, 10, 12, 12, 12, 13, 13, 13, 16, 16, 16, 18, 18, 18, 20, 20, 20, 22),
    ),
    "10": (
        (26, 28, 32, 35, 42, 47, 55, 62, 68, 75, 80, 90,
         95, 100, 110, 115, 125, 130, 140, 145, 150, 160, 170, 180),
        (8, 8, 9, 10, 12, 12, 13, 14, 15, 16, 16, 18, 18, 18, 20, 20, 22, 22, 24, 24, 24, 26, 28, 28),
    ),
    "02": (
        (30, 32, 35, 40, 47, 52, 62, 72, 80, 85, 90, 100,
         110, 120, 125, 130, 140, 150, 160, 170, 180, 190, 200, 215),
        (9, 10, 11, 12, 14, 15, 16, 17, 18, 19, 20, 21, 22, 23, 24, 25, 26, 28, 30, 32, 34, 36, 38, 40),
    ),
    "03": (
        (35, 37, 42, 47, 52, 62, 72, 80, 90, 100, 110, 120,
         130, 140, 150, 160, 170, 180, 190, 200, 215, 225, 240, 260),
        (11, 12, 13, 14, 15, 17, 19, 21, 23, 25, 27, 29, 31, 33, 35, 37, 39, 41, 43, 45, 47, 49, 50, 55),
    ),
}  # fmt: skip
#: Series of single-row angular contact ball bearings by the figures behind the 7 of their designations.
_OF_BEARINGS = {"18": "18", "8": "18", "19": "19", "9": "19", "0": "10", "2": "02", "3": "03"}
_NEAR = 0.1  # of D - d, as a logarithm: half of the distance between 19 and 10, the nearest neighbours


def boundary(series: str, bore: float) -> tuple[float, float] | None:
    """Return outside diameter and width (mm) of a series, by the figures behind the 7; None: not known."""
    if series not in _OF_BEARINGS or bore not in _BORES:
        return None
    outside, width = _TABLE[_OF_BEARINGS[series]]
    place = _BORES.index(int(bore))
    return outside[place], width[place]


def series_of(bore: float, outside: float) -> str:
    """Return the dimension series whose sections are as high as this one; empty: none of those known is."""
    if not _BORES[0] <= bore <= _BORES[-1]:
        bore, outside = (scale := min(max(bore, _BORES[0]), _BORES[-1]) / bore) * bore, scale * outside
    height = math.log(outside - bore)
    off = {
        name: abs(height - math.log(float(np.interp(bore, _BORES, sizes)) - bore))
        for name, (sizes, _) in _TABLE.items()
    }
    nearest = min(off, key=off.__getitem__)
    return nearest if off[nearest] <= _NEAR else ""
