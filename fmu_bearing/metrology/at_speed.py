"""Error motion at one speed: values by direction, lines, what each bearing and source makes alone."""

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.origins import SHAFT, SOURCES, Origin, bearing_origins, shaft_origins
from fmu_bearing.metrology.line_fit import LineFit
from fmu_bearing.metrology.nose import PER_REVOLUTION, Nose
from fmu_bearing.metrology.polar_values import asynchronous, contour, fundamental, revolutions_of, synchronous
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.results.table import number as digits

#: Directions in which motion counts, with the unit in which tables give it and its factor from SI.
#: Fixed: of a probe that does not turn; rotating: of a tool that turns with the shaft.
DIRECTIONS = {
    "fixed y": ("um", 1e6), "fixed z": ("um", 1e6), "rotating": ("um", 1e6), "axial": ("um", 1e6),
    "tilt about y": ("urad", 1e6), "tilt about z": ("urad", 1e6), "tilt rotating": ("urad", 1e6),
}  # fmt: skip
#: Radius of the base circle of a polar plot over the largest deviation.
BASE = 2.0
_COLUMN = {"fixed y": 1, "fixed z": 2, "axial": 0, "tilt about y": 3, "tilt about z": 4}
_TURNING = {"rotating": (1, 2), "tilt rotating": (3, 4)}
#: Lines of bearings are fitted to this order, whole orders to the other: what turns with the shaft makes
#: those, by unequal loads, and their amplitudes fall as the waves' do. A 7003C at 2000 r/min has a mode at
#: order 126, which form of the balls excites: to 120 the lines hold 79 % of the asynchronous energy, to 200
#: 96 % (rings, 50 revolutions).
HIGHEST, HIGHEST_WHOLE = 160.0, 40
#: A neighbour lets noise in a whole order grow by more than this: the fit does not part them.
_APART = 30.0
_NAMED = 4  # lines that a remark names
_SMALL = 0.02  # of the largest line: smaller ones are not named
_NOTHING = 1e-13  # m: what a scene without imperfections has from rounding
_LISTED = 12  # lines that a summary has
#: Figures of a direction, with their heads in tables.
_FIGURES = {
    "asynchronous": "asynchronous", "synchronous": "synchronous, averaged",
    "synchronous_by_line": "synchronous, by line", "fundamental": "fundamental, by line", "residual": None,
    "residual_by_line": "residual, by line",
}  # fmt: skip
_TILT = Quantity("tilt [rad]", "tilt, urad", digits, 1e6)


@dataclass(frozen=True)
class Values(Result):
    """Error motion in one direction (m, of tilts rad)."""

    quantities = (
        Quantity("direction", "direction"),
        Quantity("", "unit", of=lambda one: DIRECTIONS[one.direction][0]),
        *(Quantity(f"{name} [m, of tilts rad]", head, ".4f", 1e6) for name, head in _FIGURES.items()),
    )

    direction: str
    """One of `DIRECTIONS`."""
    asynchronous: float
    """Largest width of the polar plot at any angle."""
    synchronous: float
    """Range of the mean over the revolutions, from the centre of least squares: *averaged*. Axial: with the
    fundamental."""
    synchronous_by_line: float
    """The same of the whole orders that were fitted beside the lines of the bearings: *by line*. NaN, as all
    such values, where the rates of the balls are not known."""
    fundamental: float = float("nan")
    residual: float = float("nan")
    residual_by_line: float = float("nan")
    """Axial: range of order 1, and what is left without it; NaN in other directions."""


@dataclass(frozen=True)
class MotionLine(Result):
    """A line of the error motion: what makes it, and its amplitudes.

    ``radial`` (m) and ``tilt`` (rad) are the larger semi-axes of its ellipses, ``axial`` (m) its amplitude.
    """

    quantities = (
        Quantity("origin", of=lambda line: vars(line.origin)), Quantity(" = origin.name", "line"),
        Quantity(" = origin.order", "order", lambda order: f"{order:.{4 if order < 100.0 else 3}f}"),
        Quantity("radial [m]", "radial, nm", digits, 1e9), Quantity("axial [m]", "axial, nm", digits, 1e9),
        _TILT, Quantity(" = origin.source", "source"),
        Quantity(" = origin.bearing", "bearing", lambda bearing: str(bearing or "")),
    )  # fmt: skip

    origin: Origin
    radial: float
    axial: float
    tilt: float


@dataclass(frozen=True)
class Part(Result):
    """Asynchronous error motion (m, rad) that the lines of a bearing, or one of its sources, make alone.

    ``source`` is empty where all sources of the bearing count.
    """

    quantities = (
        Quantity("bearing [1]", "bearing"), Quantity("source", "source"),
        Quantity("radial [m]", "radial, um", digits, 1e6), Quantity("axial [m]", "axial, um", digits, 1e6),
        _TILT,
    )  # fmt: skip

    bearing: int
    source: str
    radial: float
    axial: float
    tilt: float


@dataclass(frozen=True)
class AtSpeed(Result):
    """Error motion of the axis of rotation at one speed."""

    quantities = (
        "speed_rpm = rpm", "revolutions [1]", "explained [1]", "values",
        Quantity("lines", of=lambda one: one.lines[:_LISTED]), "per_bearing", "per_source",
        Quantity("cage_speed_ratios [1]", of=lambda one: [rates.f_c / rates.f_r for rates in one.nose.rates]),
    )  # fmt: skip

    nose: Nose
    """The run: motion at the point, and the rates of the balls."""

    @property
    def rpm(self) -> float:
        """Shaft speed (r/min)."""
        return self.nose.scene.operation.speed_rpm

    @property
    def revolutions(self) -> int:
        """Revolutions that were evaluated."""
        return self.nose.revolutions

    def signal(self, direction: str) -> NDArray[np.float64]:
        """Return motion in a direction, shape (revolutions, PER_REVOLUTION)."""
        return revolutions_of(self._along(self.nose.motion, direction), PER_REVOLUTION)

    def mean_contour(self, direction: str, by_line: bool = False) -> NDArray[np.float64]:
        """Return the mean contour over one revolution, with all its orders; averaged, or by line."""
        if not by_line:
            return self.signal(direction).mean(axis=0)
        angle = 2.0 * np.pi * np.arange(1, PER_REVOLUTION + 1) / PER_REVOLUTION
        places = self._places(lambda one: one.bearing == 0) + 1
        orders = self._fit.orders[places]
        motion = np.real(np.exp(1j * angle[:, None] * orders) @ self._amplitudes[places])
        return self._along(motion + self._amplitudes[0].real, direction)

    @cached_property
    def values(self) -> tuple[Values, ...]:
        """Values in each direction."""
        return tuple(self._values(direction) for direction in DIRECTIONS)

    @cached_property
    def lines(self) -> tuple[MotionLine, ...]:
        """Lines, the largest radial ones first."""
        a = self._amplitudes[1:]
        rows = zip(
            self._fit.lines, _semi_axis(a[:, 1], a[:, 2]), np.abs(a[:, 0]), _semi_axis(a[:, 3], a[:, 4]),
            strict=True,
        )  # fmt: skip
        lines = (MotionLine(origin, float(r), float(x), float(t)) for origin, r, x, t in rows)
        return tuple(sorted(lines, key=lambda one: -one.radial))

    @cached_property
    def per_source(self) -> tuple[Part, ...]:
        """What each source of each bearing makes alone, in the order of the bearings."""
        return tuple(
            self._part(number, source)
            for number in range(1, len(self.nose.rates) + 1)
            for source in SOURCES
            if source != SHAFT
        )

    @cached_property
    def per_bearing(self) -> tuple[Part, ...]:
        """What each bearing makes alone."""
        return tuple(self._part(number, "") for number in range(1, len(self.nose.rates) + 1))

    @cached_property
    def explained(self) -> float:
        """Share of the energy of the asynchronous radial motion that the lines hold."""
        everything = self._sum_of(lambda one: True) + self._amplitudes[0].real
        whole = self._sum_of(lambda one: one.bearing == 0) + self._amplitudes[0].real
        left = ((self.nose.motion - everything)[:, 1:3] ** 2).sum()
        total = ((self.nose.motion - whole)[:, 1:3] ** 2).sum()
        return 1.0 - float(left / total) if total > 0.0 else 1.0

    def remarks(self) -> list[str]:
        """Return which lines an average takes for synchronous, and which the fit does not part."""
        sentences = [] if self.nose.scene.imperfections else ["the scene has no imperfections: give a grade"]
        return sentences + [*self._near_whole(), *self._not_apart(), *self._shared()]

    def _near_whole(self) -> Iterable[str]:
        limit = 1.0 / self.revolutions
        largest = max(line.radial for line in self.lines)
        near = [
            line.origin
            for line in self.lines
            if line.origin.bearing
            and line.origin.off_whole < limit
            and line.radial > max(_SMALL * largest, _NOTHING)
        ]
        if near:
            words = ", ".join(f"{self._named(one)} ({one.off_whole:.4f})" for one in near[:_NAMED])
            more = f" and {len(near) - _NAMED} more" if len(near) > _NAMED else ""
            yield (
                f"{self.rpm:g} r/min: nearer to a whole order than 1/{self.revolutions}, so that the "
                f"averaged synchronous value holds a part of them: {words}{more}"
            )

    def _not_apart(self) -> Iterable[str]:
        """Say where the fit cannot tell a whole order from a line of a bearing."""
        whole = self._places(lambda one: one.bearing == 0)
        growth = self._fit.growth(whole)
        if growth.max() <= _APART:
            return
        worst = self._fit.lines[whole[np.argmax(growth)]]
        others = [line for line in self._fit.lines if line.bearing]
        nearest = min(others, key=lambda one: (abs(one.order - worst.order), one.terms))
        apart = abs(nearest.order - worst.order)
        needed = f"; {int(1.0 / apart) + 1} revolutions do" if 0.0 < apart < 1.0 / self.revolutions else ""
        yield (
            f"{self.rpm:g} r/min: {self.revolutions} revolutions do not part {worst.name} from "
            f"{self._named(nearest)}, {apart:.4f} orders beside it: the synchronous value by line, "
            f"and what each bearing makes alone, are uncertain{needed}"
        )

    def _shared(self) -> Iterable[str]:
        """Say where the fit cannot tell the largest line of a bearing from the same of another bearing."""
        largest = next((line.origin for line in self.lines if line.origin.bearing), None)
        if largest is None:
            return
        others = [
            line
            for line in self._fit.lines
            if line.name == largest.name and line.bearing not in (0, largest.bearing)
        ]
        if not others:
            return
        nearest = min(others, key=lambda one: abs(one.order - largest.order))
        apart = abs(nearest.order - largest.order)
        if apart * self.revolutions < 1.0 and self.lines[0].radial > _NOTHING:
            yield (
                f"{self.rpm:g} r/min: {self.revolutions} revolutions do not part {self._named(largest)} from "
                f"that of bearing {nearest.bearing}, {apart:.1g} orders beside it: such lines are shared "
                "equally, and what each bearing makes alone is uncertain"
            )

    def _named(self, one: Origin) -> str:
        return one.name if len(self.nose.rates) == 1 else f"{one.name} of bearing {one.bearing}"

    def _values(self, direction: str) -> Values:
        rows = self.signal(direction)
        mean = rows.mean(axis=0)
        fitted = self.mean_contour(direction, by_line=True) if self.nose.rates else np.full_like(mean, np.nan)
        if direction != "axial":
            return Values(direction, asynchronous(rows), synchronous(mean, 2), synchronous(fitted, 2))
        return Values(
            direction, asynchronous(rows), synchronous(mean, 1), synchronous(fitted, 1), fundamental(fitted),
            synchronous(mean, 2), synchronous(fitted, 2),
        )  # fmt: skip

    def polar(
        self, direction: str
    ) -> tuple[NDArray[np.float64], NDArray[np.float64], NDArray[np.float64], float]:
        """Return angles (rad), revolutions and mean contour as radii, and the radius of their base circle.

        The unit is that of `DIRECTIONS`. Deviations from the base circle, which is of least squares, have a
        scale; its radius is free, and clear of the middle.
        """
        mean, factor = self.mean_contour(direction), DIRECTIONS[direction][1]
        centred = contour(mean, 2 if direction != "axial" else 1)
        rows = factor * (self.signal(direction) - (mean - centred))
        base = BASE * max(float(np.abs(rows).max()), 1e-15 * factor)
        angle = np.sign(self.rpm) * 2.0 * np.pi * np.arange(1, mean.size + 1) / mean.size
        return angle, base + rows, base + factor * centred, base

    def _part(self, bearing: int, source: str) -> Part:
        """Return what the lines of a bearing make, of one source or ("") of all."""
        motion = self._sum_of(lambda one: one.bearing == bearing and source in ("", one.source))

        def width(*directions: str) -> float:
            signals = (self._along(motion, direction) for direction in directions)
            return max(asynchronous(revolutions_of(one, PER_REVOLUTION)) for one in signals)

        return Part(
            bearing,
            source,
            width("fixed y", "fixed z"),
            width("axial"),
            width("tilt about y", "tilt about z"),
        )

    def _sum_of(self, chosen: Callable[[Origin], bool]) -> NDArray[np.float64]:
        return self._fit.signals(self._amplitudes, self._places(chosen))

    def _places(self, chosen: Callable[[Origin], bool]) -> NDArray[np.int_]:
        """Return the places of some lines in the fit."""
        return np.array([k for k, line in enumerate(self._fit.lines) if chosen(line)], dtype=int)

    def _along(self, motion: NDArray[np.float64], direction: str) -> NDArray[np.float64]:
        """Return motion, shape (points, 5), in one direction."""
        if direction in _COLUMN:
            return motion[:, _COLUMN[direction]]
        y, z = _TURNING[direction]
        steps = np.arange(1, len(motion) + 1)
        angle = np.sign(self.rpm) * 2.0 * np.pi * steps / PER_REVOLUTION
        return motion[:, y] * np.cos(angle) + motion[:, z] * np.sin(angle)

    @cached_property
    def _fit(self) -> LineFit:
        lines = shaft_origins(HIGHEST_WHOLE)
        for number, rates in enumerate(self.nose.rates, start=1):
            lines += bearing_origins(rates, HIGHEST, number)
        return LineFit(lines, self.revolutions, PER_REVOLUTION)

    @cached_property
    def _amplitudes(self) -> NDArray[np.complex128]:
        return self._fit.amplitudes(self.nose.motion)


def _semi_axis(y: NDArray[np.complex128], z: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Return the larger semi-axis of the ellipse that two complex amplitudes make."""
    return 0.5 * (np.abs(y + 1j * z) + np.abs(y - 1j * z))
