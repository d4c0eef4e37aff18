"""Polar plots of error motion about the circle of least squares: revolutions pale, mean contour bold."""

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

import numpy as np

from fmu_bearing.metrology.at_speed import BASE, DIRECTIONS, AtSpeed
from fmu_bearing.results.picture_parts import COLOURS, closed, empty

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_MOST = 6  # speeds that are drawn: of more, six evenly among them
_BESIDE = 3  # plots in a row
_TICKS = 2  # to either side of the base circle


def polar_plot(speeds: Sequence[AtSpeed], direction: str) -> "Figure":
    """Return polar plots at six speeds at most, deviations on a base circle of free radius.

    Raises
    ------
    MissingExtra
        Without Matplotlib (extra ``plots``).
    """
    chosen = np.unique(np.linspace(0, len(speeds) - 1, min(len(speeds), _MOST)).round().astype(int))
    beside = min(len(chosen), _BESIDE)
    rows = -(-len(chosen) // beside)
    figure = empty((4.6 * beside, 4.9 * rows))
    for place, k in enumerate(chosen, start=1):
        _draw(figure.add_subplot(rows, beside, place, projection="polar"), speeds[k], direction)
    return figure


def _draw(ax: Any, one: AtSpeed, direction: str) -> None:
    unit, factor = DIRECTIONS[direction]
    angle, rows, mean, base = one.polar(direction)
    largest = base / BASE
    step = _round_below(largest / _TICKS)
    ax.plot(np.tile(angle, len(rows)), rows.ravel(), color="0.6", linewidth=0.4, alpha=0.5)
    ax.plot(closed(angle), closed(mean), color=COLOURS["inner_ring"], linewidth=2.0)
    around = np.linspace(0.0, 2.0 * np.pi, 181)
    ax.plot(around, np.full_like(around, base), color="0.2", linewidth=0.8, linestyle="--")
    ax.set_theta_zero_location("N")
    ax.set_ylim(0.0, base + 1.1 * largest)
    ticks = step * np.arange(-_TICKS, _TICKS + 1)
    ax.set_yticks(base + ticks, [f"{tick:+g}" if tick else "0" for tick in ticks], fontsize=7)
    ax.grid(True, color="0.9")
    values = next(each for each in one.values if each.direction == direction)
    ax.set_title(
        f"{direction}, {one.rpm:,.0f} r/min, {one.revolutions} revolutions pale, their mean bold\n"
        f"asynchronous {factor * values.asynchronous:#.3g}, synchronous {factor * values.synchronous:#.2g} "
        f"(averaged), {factor * values.synchronous_by_line:#.2g} (by line) {unit}",
        fontsize=8,
    )  # fmt: skip


def _round_below(value: float) -> float:
    """Return 1, 2 or 5 times a power of ten, at most ``value``."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(one for one in (1.0, 2.0, 5.0) if one * power <= value) * power)
