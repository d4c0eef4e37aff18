"""Variables of a run over time, one panel per unit."""

import math
import os
import re
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.interface.names import UnknownName, chosen_names
from fmu_bearing.results.levels import present
from fmu_bearing.results.picture_parts import coincident, empty, label, legend_beside, marked, save, series
from fmu_bearing.results.series import Series
from fmu_bearing.results.variable_names import unit_of

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

#: Variables drawn by default, as far as the run has them.
USUAL = (
    "shaft_speed", "friction_torque", "heat.*", "inner_ring.velocity.*", "outer_ring.velocity.*",
    "cage.velocity.*", "mic[*].spl_a", "cage.speed_ratio", "shaft.nose.velocity.*", "bearing[*].force.x",
)  # fmt: skip
_MOST = 14  # curves drawn by default where a run has none of the usual
#: Factor, offset and unit in pictures, where SI gives awkward numbers.
_SHOWN = {"rad/s": (30.0 / math.pi, 0.0, "r/min"), "K": (1.0, -273.15, "degC")}
# s: longer communication steps alias motion by waviness up to 10 kHz (imperfections.highest_frequency_kHz)
_FINE = 5e-5
# dB below its median: a level there at the beginning is what filters let through before sound arrives
_STARTING = 40.0
_AVERAGING = {"fast": 0.125, "slow": 1.0}  # s (IEC 61672-1)
_LEAST_ROOM = 0.5  # dB above and below levels that stay
_MICROPHONE = re.compile(r"mic\[(\d+)\]\.")
_WEIGHTED = (".spl_a", ".leq_a", ".spl_fast_a", ".spl_slow_a")
_WIDTHS = (1.2, 0.7)


def time_picture(run: Series, patterns: Sequence[str] | None = None, title: str = "") -> "Figure":
    """Draw variables over time, one panel per unit; levels where there are any.

    Parameters
    ----------
    run : Series
    patterns : sequence of str, optional
        Names, with ``*`` for any text; default: those of `usual_names`.
    title : str
        Default: the run's name.

    Speeds are drawn in r/min, temperatures in degC, microphones by their names where the run has its scene.
    The time that meters average over is grey, and the axis takes the levels after it.
    Velocities and pressures that the communication step is too long to follow are drawn as points, since a
    line between them would show motions that are not there.

    Raises
    ------
    UnknownName
        For a pattern that matches nothing the run has.
    """
    names = usual_names(run) if patterns is None else chosen_names(patterns, run.names, ())
    panels: dict[str, list[str]] = {}
    for name in names:
        panels.setdefault(run.units.get(name) or unit_of(name), []).append(name)
    if not panels:
        raise UnknownName(f"{run.name} has times alone: there is nothing to draw")
    figure = empty((10.0, 1.2 + 2.4 * len(panels)))
    axes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    for ax, (unit, members) in zip(axes, panels.items(), strict=True):
        _panel(ax, run, unit, members)
    axes[-1].set_xlabel("time, s")
    figure.suptitle(title or run.name)
    return figure


def _panel(ax: "Axes", run: Series, unit: str, members: Sequence[str]) -> None:
    """Draw the variables of one unit."""
    width = _WIDTHS[len(run) > 500]
    factor, offset, shown = _SHOWN.get(unit, (1.0, 0.0, unit or "1"))
    step = float(np.median(np.diff(run.time))) if len(run) > 1 else 0.0
    drawn = folded = False
    for k, name in enumerate(members):
        values = settled(run[name]) if unit == "dB" else factor * run[name] + offset
        drawn |= not np.isnan(values).all()
        points = step > _FINE and (".velocity." in name or ".flexure." in name or name.endswith(".pressure"))
        folded |= points
        style = series(k, len(members)) | {"linewidth": width}
        if unit == "dB" and _MICROPHONE.match(name):
            style = coincident(k, len(members))
        if points:
            style |= marked(k, "o") | {"linestyle": ""}
        silence = ": -" if unit == "dB" and np.isnan(values).all() else ""
        ax.plot(run.time, values, **style, markersize=1.8, label=spoken(name, run) + silence)
    label(ax, "", _unit(shown, members), "")
    if folded:
        words = (
            f"points every {1e3 * step:g} ms, too far apart for a curve: run with --step {_FINE:g} or less"
        )
        ax.set_title(words, fontsize=7, loc="left")
    if not drawn:
        words = "no level: metering has not begun" if unit == "dB" else "no values"
        ax.text(0.5, 0.5, words, ha="center", va="center", transform=ax.transAxes)
        ax.set_yticks([])
    if drawn and unit == "dB":
        _veil(ax, run, members)
    legend_beside(ax, markerscale=2.5 if folded else 1.0)


def _veil(ax: "Axes", run: Series, members: Sequence[str]) -> None:
    """Lay grey over the time that meters average over; the axis takes the levels after it, or the last ones.

    Before, levels are means of a few samples: they may lie tens of dB off.
    """
    slow = run.scene is not None and run.scene.sound is not None and run.scene.sound.time_weighting == "slow"
    seconds = _AVERAGING["slow" if slow or all(".spl_slow" in name for name in members) else "fast"]
    levels = np.array([settled(run[name]) for name in members])
    there = np.isfinite(levels).any(axis=0)
    begin = float(run.time[int(np.argmax(there))])
    after = there & (run.time >= begin + seconds)
    if not after.any():
        after = there & (run.time >= 0.5 * (begin + float(run.time[-1])))
    low, high = float(np.nanmin(levels[:, after])), float(np.nanmax(levels[:, after]))
    room = max(0.1 * (high - low), _LEAST_ROOM)
    ax.set_ylim(low - room, high + room)
    ax.axvspan(begin, min(begin + seconds, float(run.time[-1])), color="0.5", alpha=0.15, linewidth=0.0,
               gid="averaging")  # fmt: skip
    ax.set_title(f"grey: the meters average over {seconds:g} s", fontsize=7, loc="left")


def _unit(unit: str, members: Sequence[str]) -> str:
    """Return the unit of an axis: of levels dB(A) where all are A-weighted, both units where some are."""
    if unit != "dB":
        return unit
    weighted = [name.endswith(_WEIGHTED) for name in members]
    return "dB(A)" if all(weighted) else "dB, dB(A)" if any(weighted) else unit


def settled(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a level over time (dB) with NaN before it sounds: meters and filters start from nothing."""
    levels = present(values, "dB")
    if np.isnan(levels).all():
        return levels
    sounding = levels >= np.nanmedian(levels) - _STARTING
    levels[: int(np.argmax(sounding))] = np.nan
    return levels


def spoken(name: str, run: Series) -> str:
    """Return the name of a variable with its microphone's own name, where it is known."""
    match = _MICROPHONE.match(name)
    places = [] if run.scene is None else run.scene.microphones
    if match is None or not 0 < int(match[1]) <= len(places):
        return name
    return f"{places[int(match[1]) - 1].name}: {name[match.end() :]}"


def usual_names(run: Series) -> list[str]:
    """Return the variables drawn by default that the run has, or all where it has none of them."""
    names: list[str] = []
    for pattern in USUAL:
        try:
            names += chosen_names([pattern], run.names, ())
        except UnknownName:
            continue
    return names or run.names[:_MOST]


def draw(run: Series, path: str | os.PathLike[str], patterns: Sequence[str] | None = None) -> None:
    """Write `time_picture` to a file (.png, .svg or .pdf)."""
    save(time_picture(run, patterns), path)
