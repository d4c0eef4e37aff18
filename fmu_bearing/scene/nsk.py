"""NSK's angular contact ball bearings of series 70 and 79, 15 and 25 deg, 10 to 70 mm bore.

``catalogue/nsk.csv`` holds the maker's figures: boundary dimensions, angle, C, C0, f0, limiting speeds, mass,
and the preload classes with the axial stiffness of a rigid pair (NSK, super-precision bearings, printed pages
138 to 147 and 152 to 157), and beside them the balls, which NSK does not print. Those are derived: the
standard ball and the number of balls that give C, C0 and f0 by ISO 281 and ISO 76. They were found from the
figures for 15 deg alone; the bearing for 25 deg has the same balls.

An entry of the catalogue is made of them: what neither is printed nor follows from print comes from the rules
of `fmu_bearing.scene.estimate`. Each value says in its remark which of the three it is.
"""

import csv
import functools
import math
from collections.abc import Iterator
from importlib import resources
from typing import Any, NamedTuple

from fmu_bearing.scene.estimate import Estimate, cage_estimates, estimates

PREFIX = "NSK-"
#: Names of the preload classes, as the columns of the file begin.
CLASSES = {"extra light": "EL", "light": "L", "medium": "M", "heavy": "H"}
_PRINTED = "maker's print (NSK)"
_STEEL, _PHENOLIC = 7.8e-6, 1.4e-6  # kg/mm3: rings and balls, cage
_STEEP = 20.0  # deg: beyond it the mass does not determine the shoulder, see `land_offset`
_LAND, _STEEP_LAND = 0.82, 0.7  # ball diameters off pitch: mean of the sizes whose mass gives it; the rule
_SURE = 0.05  # ball diameters: the mass gives it where half of the last digit printed moves it by less
_HALF_DIGIT = 5e-4  # kg
#: Inner and outer conformity, fitted to the 240 axial stiffnesses of pairs that NSK prints: median 1.00, rms
#: 2.4 %. These determine the sum alone (0.523 for both: 1.00, 2.3 %). The inner one is the widest that
#: ISO 281 rates without reduction, because C as printed follows from ISO 281 without one.
CONFORMITIES = (0.52, 0.526)


class Preload(NamedTuple):
    """A preload class: force (N), and axial stiffness (N/um) of a rigid pair under it."""

    force: float
    pair_stiffness: float


class Size(NamedTuple):
    """A bearing as NSK prints it (N, mm, kg, r/min), its balls as derived; ``f0``: NaN where not printed."""

    name: str
    bore: float
    outside: float
    width: float
    angle: float
    dynamic: float
    static: float
    f0: float
    grease_speed: float
    oil_speed: float
    mass: float
    balls: int
    ball: float
    preload: dict[str, Preload]

    @property
    def pitch(self) -> float:
        """Pitch diameter (mm): mean of bore and outside diameter."""
        return 0.5 * (self.bore + self.outside)

    def printed(self) -> dict[str, Any]:
        """Return what NSK prints beside dimensions and angle; units are in the keys."""
        classes = {
            name: {"force_N": one.force, "pair_stiffness_N_um": one.pair_stiffness}
            for name, one in self.preload.items()
        }
        figures = {
            "C_N": self.dynamic, "C0_N": self.static, "f0": self.f0, "speed_grease_rpm": self.grease_speed,
            "speed_oil_rpm": self.oil_speed, "mass_kg": self.mass,
        }  # fmt: skip
        return {key: value for key, value in figures.items() if not math.isnan(value)} | {"preload": classes}


@functools.cache
def sizes() -> dict[str, Size]:
    """Return all sizes by name."""
    file = resources.files("fmu_bearing.scene").joinpath("catalogue", "nsk.csv")
    rows = (_size(row) for row in csv.DictReader(file.read_text("utf-8").splitlines()))
    return {size.name: size for size in rows}


def _size(row: dict[str, str]) -> Size:
    def value(key: str) -> float:
        return float(row[key] or "nan")

    preload = {
        name: Preload(value(f"{short}_N"), value(f"{short}_pair_N_um")) for name, short in CLASSES.items()
    }
    keys = (
        "bore_mm", "outside_diameter_mm", "width_mm", "angle_deg", "C_N", "C0_N", "f0", "speed_grease_rpm",
        "speed_oil_rpm", "mass_kg",
    )  # fmt: skip
    bore, outside, width, angle, dynamic, static, f0, grease, oil, mass = map(value, keys)
    return Size(
        PREFIX + row["designation"], bore, outside, width, angle, dynamic, static, f0, grease, oil, mass,
        int(row["balls_derived"]), value("ball_mm_derived"), preload,
    )  # fmt: skip


def entry_text(size: Size) -> str:
    """Return the entry of a bearing as TOML, with a remark on the origin of each value."""
    dimensions = (size.bore, size.outside, size.width)
    lines = [
        f"[{size.name}]",
        f'designation = "{size.name}"',
        f"bore_mm = {size.bore} # {_PRINTED}",
        f"outside_diameter_mm = {size.outside} # {_PRINTED}",
        f"width_mm = {size.width} # {_PRINTED}",
        f"contact_angle_deg = {size.angle} # {_PRINTED}",
    ]
    known = {one.key: one for one in _known(size)}
    for estimate in estimates(*dimensions, size.angle):
        if estimate.key != "contact_angle_deg":
            lines.append(_line(known.get(estimate.key, estimate)))
    lines += ["", f"[{size.name}.cage]"]
    lines += [_line(estimate) for estimate in cage_estimates(*dimensions, size.ball)]
    return "\n".join(lines) + "\n"


def _line(one: Estimate) -> str:
    return f"{one.key} = {one.text} # assumed" + (f": {one.rule}" if one.rule else "")


def _known(size: Size) -> Iterator[Estimate]:
    """Yield what follows from printed figures, or agrees with them better than the rules do."""
    whose = "NSK" if size.f0 == size.f0 else "NSK, 15 deg"
    balls = f"derived from C, C0 and f0 ({whose}) by ISO 281 and ISO 76"
    yield Estimate("ball_diameter_mm", size.ball, balls)
    yield Estimate("ball_count", size.balls, balls)
    for key, value in zip(("inner_conformity", "outer_conformity"), CONFORMITIES, strict=True):
        yield Estimate(key, value, "fitted to NSK's printed stiffness of pairs, both together")
    land, rule = land_offset(size)
    yield Estimate(
        "inner_ring_outer_diameter_mm", round(size.pitch - land * size.ball, 2), f"{rule} below pitch"
    )
    yield Estimate(
        "outer_ring_inner_diameter_mm", round(size.pitch + land * size.ball, 2), f"{rule} above pitch"
    )


def land_offset(size: Size) -> tuple[float, str]:
    """Return how many ball diameters the rings' effective diameters are off the pitch diameter, and why.

    Two steel rings, steel balls and a phenolic cage by the rules have the mass that is printed. The effective
    diameters are the shoulders of the contacts, too: at 25 deg those by the mass would leave no room for the
    contact ellipse of the maker's own heavy class. Such bearings have higher shoulders on the loaded side
    than the mean that the mass gives, and take the rule.
    """
    if size.angle > _STEEP:
        return _STEEP_LAND, f"{_STEEP_LAND} ball diameters, for the contact's shoulder,"
    low, middle, high = (_land_of_mass(size, size.mass + off) for off in (_HALF_DIGIT, 0.0, -_HALF_DIGIT))
    if high - low <= 2.0 * _SURE:
        return middle, f"derived from the mass (NSK), {middle:.2f} ball diameters"
    return _LAND, f"{_LAND} ball diameters, as masses of larger sizes give,"


def _land_of_mass(size: Size, mass: float) -> float:
    cage = {
        estimate.key: float(estimate.value)
        for estimate in cage_estimates(size.bore, size.outside, size.width, size.ball)
        if not isinstance(estimate.value, str)
    }
    inside, outside = cage["bore_mm"], cage["outside_diameter_mm"]
    pockets = size.balls * math.pi / 4.0 * cage["pocket_diameter_mm"] ** 2 * (outside - inside) / 2.0
    rest = mass - _PHENOLIC * (math.pi / 4.0 * (outside**2 - inside**2) * cage["width_mm"] - pockets)
    rest -= size.balls * _STEEL * math.pi / 6.0 * size.ball**3
    # both rings: D^2 - d^2 minus the space between them, 4 d_m k D_w
    solid = size.outside**2 - size.bore**2
    return (solid - rest / (_STEEL * size.width * math.pi / 4.0)) / (4.0 * size.pitch * size.ball)
