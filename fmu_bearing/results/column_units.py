"""Units of columns as people write them: in titles (``time [s]``, ``preload (kN)``) and in rows of units."""

import math
import re
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.scene.units import UNITS, scaled, symbol

__all__ = ["Title", "Unit", "is_units", "suffixed", "unit_of_suffix", "unit_of_title", "written_unit"]


class Unit(NamedTuple):
    """A unit: SI = factor * value + offset; the SI unit; how messages write it."""

    factor: float
    offset: float
    si: str
    shown: str

    def to_si(self, values: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return values in SI units."""
        return scaled(values, self.factor, self.offset)

    def from_si(self, value: float) -> float:
        """Return an SI value in this unit."""
        return (value - self.offset) / self.factor


_TURN, _DEG = math.pi / 30.0, math.pi / 180.0
#: Per SI unit: factor, offset and spellings of it and its multiples; the first spelling is shown.
_WRITTEN: dict[str, tuple[tuple[float, float, str], ...]] = {
    "s": ((1.0, 0.0, "s sec secs second seconds sek"), (1e-3, 0.0, "ms msec"), (1e-6, 0.0, "us usec"),
          (60.0, 0.0, "min"), (3600.0, 0.0, "h")),
    "rad/s": ((1.0, 0.0, "rad/s rad.s-1 rad*s^-1"), (_DEG, 0.0, "deg/s"),
              (_TURN, 0.0, "r/min rpm 1/min min-1 min^-1 /min u/min rev/min tr/min")),
    "1/s": ((1.0, 0.0, "1/s s-1 s^-1"),),
    "K": ((1.0, 0.0, "K"), (1.0, 273.15, "degC C cel"), (5.0 / 9.0, 273.15 - 160.0 / 9.0, "degF F")),
    "N": ((1.0, 0.0, "N"), (1e3, 0.0, "kN"), (1e-3, 0.0, "mN")),
    "N.m": ((1.0, 0.0, "N.m Nm N*m"), (1e-3, 0.0, "N.mm Nmm N*mm mN.m mNm mN*m")),
    "N/m": ((1.0, 0.0, "N/m"), (1e6, 0.0, "N/um"), (1e3, 0.0, "N/mm")),
    "m": ((1.0, 0.0, "m"), (1e-3, 0.0, "mm"), (1e-6, 0.0, "um"), (1e-9, 0.0, "nm")),
    "m/s": ((1.0, 0.0, "m/s m.s-1 m*s^-1"), (1e-3, 0.0, "mm/s"), (1e-6, 0.0, "um/s")),
    "m/s2": ((1.0, 0.0, "m/s2 m/s^2 m.s-2 m*s^-2"), (1e-3, 0.0, "mm/s2 mm/s^2")),
    "Pa": ((1.0, 0.0, "Pa"), (1e3, 0.0, "kPa"), (1e6, 0.0, "MPa N/mm2 N/mm^2"), (1e9, 0.0, "GPa")),
    "Pa.s": ((1.0, 0.0, "Pa.s Pas Pa*s"), (1e-3, 0.0, "mPa.s mPas mPa*s")),
    "rad": ((1.0, 0.0, "rad"), (_DEG, 0.0, "deg"), (1e-3, 0.0, "mrad")),
    "W": ((1.0, 0.0, "W"), (1e3, 0.0, "kW"), (1e-3, 0.0, "mW")),
    "Hz": ((1.0, 0.0, "Hz"), (1e3, 0.0, "kHz")),
    "kg": ((1.0, 0.0, "kg"), (1e-3, 0.0, "g")),
    "dB": ((1.0, 0.0, "dB dB(A) dB(Z) dBA"),),
    "": ((1.0, 0.0, "- 1"), (1e-2, 0.0, "%")),
}  # fmt: skip
_UNITS = {
    spelling: Unit(factor, offset, si, spellings.split()[0])
    for si, rows in _WRITTEN.items()
    for factor, offset, spellings in rows
    for spelling in spellings.split()
}
#: Standard acceleration of free fall, as ISO 80000-3 gives it, which sensors are calibrated in; the title of
#: a mass, where ``g`` is a gram, names it.
_FREE_FALL = Unit(9.80665, 0.0, "m/s2", "g")
_MASSES = ("mass", "weight", "gewicht")
#: Name and unit: ``time [s]``, ``time (s)``, ``time{s}``, ``time, s`` as pandas writes ours, ``time/s``.
_TITLE = re.compile(
    r"(?P<name>.*?)(?P<room>\s*)(?:\[(?P<a>[^\[\]]*)\]|\((?P<b>[^()]*(?:\([AZ]\))?)\)|\{(?P<c>[^{}]*)\}"
    r"|[,/]\s*(?P<d>[^\s,]+))\s*"
)
_MARKS = str.maketrans(
    {"µ": "u", "μ": "u", "·": ".", "⋅": ".", "²": "2", "−": "-", "⁻": "-", "¹": "1", "°": "deg", " ": ""}
)


class Title(str):
    """The title of a column without its unit; ``unit``: as written, empty where none is; ``written``: whole.

    An index is no unit (``mic[1]``), nor is a word in brackets right behind a name that is none (``der(x)``).
    """

    written: str
    unit: str

    def __new__(cls, written: str, unit: str = "") -> "Title":
        """Make a title of a cell; ``unit``: of the row of units, for a title that has none."""
        match = _TITLE.fullmatch(written)
        name, found = written, ""
        if match is not None and match["name"] not in ("", "der"):
            found = _bare(next(text for text in match.group("a", "b", "c", "d") if text is not None))
            loose = match["d"] is None and bool(match["room"]) and bool(found)
            if found.isdigit() or not (loose or written_unit(found)):
                found = ""
            name = match["name"].strip() if found else written
        title = super().__new__(cls, name)
        title.written, title.unit = written, found or _bare(unit)
        return title


def _bare(cell: str) -> str:
    """Return a unit without the brackets round it, those of dB(A) kept."""
    cell = cell.strip()
    return cell[1:-1].strip() if (cell[:1] + cell[-1:]) in ("[]", "()", "{}") else cell


def written_unit(text: str) -> Unit | None:
    """Return the unit that people write so, in other capitals too where these make no other unit."""
    plain = text.translate(_MARKS)
    same = {unit for spelling, unit in _UNITS.items() if spelling.lower() == plain.lower()}
    return _UNITS.get(plain) or (same.pop() if len(same) == 1 else None)


def unit_of_title(title: Title) -> Unit | None:
    """Return the unit of a column; None for a title without one that is known.

    ``g`` is that of an acceleration, 9.80665 m/s2, but for a column that says mass or weight.
    """
    unit = written_unit(title.unit) if title.unit else None
    if unit is not None and unit.shown == "g" and not any(word in title.casefold() for word in _MASSES):
        return _FREE_FALL
    return unit


def is_units(cells: Sequence[str]) -> bool:
    """Whether cells are a row of units: units or nothing, one at least that is more than a digit."""
    given = [_bare(cell) for cell in cells if cell]
    return all(map(written_unit, given)) and not all(cell.isdigit() for cell in given)


def unit_of_suffix(suffix: str, si: str) -> Unit:
    """Return the unit of a suffix of names, as ``_rpm``; ``si``: its SI unit."""
    return Unit(*UNITS[suffix], si, symbol("x" + suffix))


def suffixed(title: Title) -> str:
    """Return the name with the suffix that names have for its unit: ``speed [r/min]`` is ``speed_rpm``."""
    if not title.unit:
        return str(title)
    unit = written_unit(title.unit)
    words = title.unit if unit is None else unit.shown
    known = (one for one in UNITS if unit is not None and written_unit(symbol("x" + one)) == unit)
    suffix = next(known, "_" + words.replace("/", "_"))
    return str(title) if title.endswith(suffix) else title + suffix
