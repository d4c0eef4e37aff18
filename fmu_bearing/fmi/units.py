"""Units of the interface as FMI describes them: base units, factor and offset of display units.

FMI 2.0 describes a unit by the exponents of the SI base units, and a display unit by
``shown = factor * value + offset`` (FMI 2.0.5, section 2.2.2).
"""

from dataclasses import dataclass, field
from math import pi

__all__ = ["NO_UNIT", "UNITS", "DisplayUnit", "Unit"]

NO_UNIT = "1"  # said of plain numbers, so that importers can distinguish them from a forgotten unit


@dataclass(frozen=True)
class DisplayUnit:
    """How tools may show a value: ``shown = factor * value + offset``."""

    name: str
    factor: float = 1.0
    offset: float = 0.0

    def shown(self, value: float) -> float:
        """Return what a tool shows for ``value`` given in the unit itself."""
        return self.factor * value + self.offset


@dataclass(frozen=True)
class Unit:
    """A unit by name, its SI base exponents (``{"kg": 1, "m": 2, "s": -2}``) and its display units.

    ``converts``: whether tools may convert it to units of the same exponents. Decibels are no plain number.
    """

    name: str
    base: dict[str, int] = field(default_factory=dict)
    displays: tuple[DisplayUnit, ...] = ()
    converts: bool = True

    def display(self, name: str) -> DisplayUnit:
        """Return the display unit ``name``; ``KeyError`` names what is missing."""
        for display in self.displays:
            if display.name == name:
                return display
        raise KeyError(f"unit {self.name!r} has no display unit {name!r}")


_ALL = (
    Unit(NO_UNIT),
    Unit("dB", converts=False),
    Unit("m", {"m": 1}, (DisplayUnit("mm", 1e3), DisplayUnit("um", 1e6), DisplayUnit("nm", 1e9))),
    Unit("s", {"s": 1}, (DisplayUnit("ms", 1e3), DisplayUnit("us", 1e6))),
    Unit("m/s", {"m": 1, "s": -1}, (DisplayUnit("mm/s", 1e3),)),
    Unit("m/s2", {"m": 1, "s": -2}),
    Unit("rad", {"rad": 1}, (DisplayUnit("deg", 180.0 / pi),)),
    Unit("rad/s", {"rad": 1, "s": -1}, (DisplayUnit("r/min", 30.0 / pi),)),
    Unit("1/s", {"s": -1}),
    Unit("K", {"K": 1}, (DisplayUnit("degC", 1.0, -273.15),)),
    Unit("kg", {"kg": 1}, (DisplayUnit("g", 1e3),)),
    Unit("kg.m", {"kg": 1, "m": 1}, (DisplayUnit("g.mm", 1e6),)),
    Unit("kg.m2", {"kg": 1, "m": 2}, (DisplayUnit("kg.mm2", 1e6), DisplayUnit("g.mm2", 1e9))),
    Unit("N", {"kg": 1, "m": 1, "s": -2}),
    Unit("N/m", {"kg": 1, "s": -2}, (DisplayUnit("N/um", 1e-6),)),
    Unit("N.m", {"kg": 1, "m": 2, "s": -2}, (DisplayUnit("N.mm", 1e3),)),
    Unit("N.m/rad", {"kg": 1, "m": 2, "s": -2, "rad": -1}),
    Unit("Pa", {"kg": 1, "m": -1, "s": -2}, (DisplayUnit("MPa", 1e-6), DisplayUnit("GPa", 1e-9))),
    Unit("Pa.s", {"kg": 1, "m": -1, "s": -1}, (DisplayUnit("mPa.s", 1e3),)),
    Unit("W", {"kg": 1, "m": 2, "s": -3}),
)

#: Every unit the interface may use, by name.
UNITS = {unit.name: unit for unit in _ALL}
