"""Variables of a run over time, one panel per unit."""

import os
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from fmu_bearing.run.levels import present
from fmu_bearing.run.names import UnknownName, chosen_names, unit_of
from fmu_bearing.run.pictures import OTHERS, empty, label, save

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from fmu_bearing.run.result import Run

#: Variables drawn by default, as far as the run has them.
USUAL = (
    "shaft_speed", "friction_torque", "heat.*", "inner_ring.velocity.*", "outer_ring.velocity.*",
    "cage.velocity.*", "mic[*].spl_a", "cage.speed_ratio",
)  # fmt: skip
_MOST = 14  # curves in a panel whose legend can still be read
_WIDTHS = (1.2, 0.7)


def time_picture(run: "Run", patterns: Sequence[str] | None = None, title: str = "") -> "Figure":
    """Draw variables over time, one panel per unit; levels where there are any.

    Parameters
    ----------
    run : Run
    patterns : sequence of str, optional
        Names, with ``*`` for any text; default: those of `usual_names`.
    title : str
        Default: the run's name.

    Raises
    ------
    UnknownName
        For a pattern that matches nothing the run has.
    """
    names = usual_names(run) if patterns is None else chosen_names(patterns, run.names, ())
    panels: dict[str, list[str]] = {}
    for name in names:
        panels.setdefault(run.units.get(name) or unit_of(name), []).append(name)
    figure = empty((10.0, 1.2 + 2.4 * len(panels)))
    axes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
    for ax, (unit, members) in zip(axes, panels.items(), strict=True):
        width = _WIDTHS[len(run) > 500]
        drawn = False
        for k, name in enumerate(members):
            style = "-" if k < len(OTHERS) else "--"
            values = present(run[name], unit)
            drawn |= not np.isnan(values).all()
            ax.plot(run.time, values, style, color=OTHERS[k % len(OTHERS)], linewidth=width, label=name)
        label(ax, "", unit or "1", "")
        if not drawn:
            words = "no level: metering has not begun" if unit == "dB" else "no values"
            ax.text(0.5, 0.5, words, ha="center", va="center", transform=ax.transAxes)
            ax.set_yticks([])
        if len(members) <= _MOST:
            ax.legend(frameon=False, fontsize=7, loc="center left", bbox_to_anchor=(1.0, 0.5))
    axes[-1].set_xlabel("time, s")
    figure.suptitle(title or run.name)
    return figure


def usual_names(run: "Run") -> list[str]:
    """Return the variables drawn by default that the run has, or all where it has none of them."""
    found: list[str] = []
    for pattern in USUAL:
        try:
            found += chosen_names([pattern], run.names, ())
        except UnknownName:
            continue
    return found or run.names[:_MOST]


def draw(run: "Run", path: str | os.PathLike[str], patterns: Sequence[str] | None = None) -> None:
    """Write `time_picture` to a file (.png, .svg or .pdf)."""
    save(time_picture(run, patterns), path)
