"""Deep groove ball bearings of the catalogue: series 60, 62 and 63, 10 to 50 mm bore.

``catalogue/deep_groove.csv`` holds boundary dimensions (ISO 15), C and C0 as NSK prints them, and the balls,
which no maker prints: the standard ball and the number of balls whose C and C0 by ISO 281 and ISO 76 are
nearest to both (`fmu_bearing.scene.estimate.balls_of_ratings`). They come within 1 %, those of 6303 and 6310
within 2 %. C and C0 were written from memory of the maker's table; that a whole number of standard balls
meets both of each bearing is what confirms them.
"""

import csv
import functools
from collections.abc import Iterator
from importlib import resources
from typing import Any, NamedTuple

from fmu_bearing.scene.bearing import DEEP_GROOVE
from fmu_bearing.scene.dimension_series import series_of
from fmu_bearing.scene.estimate import Estimate, cage_estimates, estimates

#: Series by the figures before the bore of their designations.
SERIES = ("60", "62", "63")
LEAST_BORE, MOST_BORE = 10.0, 50.0  # mm
#: Group of the clearance without another one in the designation.
NORMAL = "CN"
_GROOVES = (0.52, 0.53)
#: Ball diameters off pitch: inner shoulders that SKF prints of 60, 62 and 63, from memory of six.
_LAND = 0.6


class Size(NamedTuple):
    """A bearing: dimensions (mm), C and C0 as printed (N), its balls as derived."""

    name: str
    bore: float
    outside: float
    width: float
    dynamic: float
    static: float
    balls: int
    ball: float

    @property
    def pitch(self) -> float:
        """Pitch diameter (mm): mean of bore and outside diameter."""
        return 0.5 * (self.bore + self.outside)

    def printed(self) -> dict[str, Any]:
        """Return what is printed beside the dimensions; units are in the keys."""
        return {"C_N": self.dynamic, "C0_N": self.static}


@functools.cache
def sizes() -> dict[str, Size]:
    """Return all sizes by name."""
    file = resources.files("fmu_bearing.scene").joinpath("catalogue", "deep_groove.csv")
    rows = csv.DictReader(file.read_text("utf-8").splitlines())
    return {row["designation"]: _size(row) for row in rows}


def _size(row: dict[str, str]) -> Size:
    keys = ("bore_mm", "outside_diameter_mm", "width_mm", "C_N", "C0_N")
    bore, outside, width, dynamic, static = (float(row[key]) for key in keys)
    number, ball = int(row["balls_derived"]), float(row["ball_mm_derived"])
    return Size(row["designation"], bore, outside, width, dynamic, static, number, ball)


def entry_text(size: Size) -> str:
    """Return the entry of a bearing as TOML, with a remark on the origin of each value."""
    dimensions = (size.bore, size.outside, size.width)
    source = f"ISO 15, dimension series {series_of(size.bore, size.outside)}"
    lines = [
        f"[{size.name}]",
        f'kind = "{DEEP_GROOVE}"',
        f'designation = "{size.name}"',
        f"bore_mm = {size.bore} # {source}",
        f"outside_diameter_mm = {size.outside} # {source}",
        f"width_mm = {size.width} # {source}",
        f'clearance = "{NORMAL}" # assumed: a designation without another one',
    ]
    known = {one.key: one for one in _known(size)}
    lines += [
        _line(known.get(one.key, one))
        for one in estimates(*dimensions, 0.0)
        if one.key != "contact_angle_deg"
    ]
    lines += ["", f"[{size.name}.cage]"]
    lines += [_line(one) for one in cage_estimates(*dimensions, size.ball, size.balls, pressed=True)]
    return "\n".join(lines) + "\n"


def _line(one: Estimate) -> str:
    return f"{one.key} = {one.text} # assumed" + (f": {one.rule}" if one.rule else "")


def _known(size: Size) -> Iterator[Estimate]:
    """Yield what follows from printed figures, or is another one than of an angular contact bearing."""
    balls = f"derived from C {size.dynamic:g} N and C0 {size.static:g} N (NSK) by ISO 281 and ISO 76"
    yield Estimate("ball_diameter_mm", size.ball, balls)
    yield Estimate("ball_count", size.balls, balls)
    for key, value in zip(("inner_conformity", "outer_conformity"), _GROOVES, strict=True):
        yield Estimate(key, value, "the groove that ISO 281 and ISO 76 rate")
    off = _LAND * size.ball
    rule = f"{_LAND} ball diameters"
    yield Estimate("inner_ring_outer_diameter_mm", round(size.pitch - off, 2), f"{rule} below pitch")
    yield Estimate("outer_ring_inner_diameter_mm", round(size.pitch + off, 2), f"{rule} above pitch")
