"""Picture of an identification: computed over measured levels, and the identified values."""

import math
from collections.abc import Mapping
from typing import TYPE_CHECKING

from fmu_bearing.extras import need
from fmu_bearing.identification.result import Identified
from fmu_bearing.results.picture_parts import OTHERS, empty, label, save
from fmu_bearing.run.figures import A_LEVEL

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = ["identified_picture", "save"]

_ROLES = ((True, "fit", "o", OTHERS[0]), (False, "check", "^", OTHERS[1]))
_ROOM = 3.0  # dB beyond the outermost level
_NARROW, _WIDE = 5.0, 1e3  # high over low: ticks in even steps; at 1, 2, 5 of each decade; of decades alone


def identified_picture(result: Identified, truth: Mapping[str, float] | None = None) -> "Figure":
    """Draw computed over measured levels, before and after, fitted and checked; and values with intervals.

    Parameters
    ----------
    found : Identified
    truth : mapping, optional
        True values by key, where the measured machine was computed.
    """
    figure = empty((11.0, 4.8))
    left, right = figure.subplots(1, 2, width_ratios=(1.1, 1.0))
    _levels(left, result)
    _values(right, result, truth or {})
    return figure


def _levels(ax: "Axes", result: Identified) -> None:
    measured = [one.datum.value for one in result.compared]
    computed = [v for one in result.compared for v in (one.before, one.after) if math.isfinite(v)]
    low, high = min(measured + computed) - _ROOM, max(measured + computed) + _ROOM
    ax.plot([low, high], [low, high], color="0.4", linewidth=0.8)
    for fit, name, marker, colour in _ROLES:
        rows = [one for one in result.compared if one.datum.fit is fit]
        if not rows:
            continue
        x = [row.datum.value for row in rows]
        ax.plot(x, [row.before for row in rows], marker, color=colour, fillstyle="none", alpha=0.5,
                label=f"{name}, before ({result.rms(fit, before=True):.1f} dB rms)")  # fmt: skip
        spread, std = [row.spread for row in rows], [row.datum.std for row in rows]
        ax.errorbar(x, [row.after for row in rows], spread, std, marker, color=colour, elinewidth=0.6,
                    markersize=5, label=f"{name}, after ({result.rms(fit):.1f} dB rms)")  # fmt: skip
    ax.set_xlim(low, high)
    ax.set_ylim(low, high)
    ax.set_aspect("equal")
    ax.legend(frameon=False, fontsize=8)
    weighted = [one.datum.quantity.kind == A_LEVEL for one in result.compared]
    unit = "dB(A)" if all(weighted) else "dB, dB(A)" if any(weighted) else "dB"
    label(ax, f"measured, {unit}", f"computed, {unit}", result.scene.name)


def _values(ax: "Axes", result: Identified, truth: Mapping[str, float]) -> None:
    """Draw each value over its start, with two standard deviations; grey: not determined; cross: truth."""
    shown = [estimate for estimate in result.estimates if estimate.free.log]
    for place, one in enumerate(reversed(shown)):
        colour = OTHERS[0] if one.determined else "0.6"
        low, high = one.interval()
        if math.isfinite(low):
            ax.plot(
                [low / one.free.start, high / one.free.start], [place, place], color=colour, linewidth=2.0
            )
        ax.plot(one.value / one.free.start, place, "o", color=colour)
        if one.key in truth:
            ax.plot(
                truth[one.key] / one.free.start, place, "x", color=OTHERS[1], markersize=9, markeredgewidth=2
            )
    ax.axvline(1.0, color="0.4", linewidth=0.8)
    ax.set_xscale("log")
    ax.set_yticks(range(len(shown)), [one.key.replace(".", ".\n", 1) for one in reversed(shown)], fontsize=8)
    ax.set_ylim(-0.6, len(shown) - 0.4)
    low, high = ax.get_xlim()
    ticker = need("matplotlib.ticker", "a picture")
    if high < _NARROW * low:
        ax.xaxis.set_major_locator(ticker.MaxNLocator(6, steps=[1, 2, 5, 10]))
    else:
        ax.xaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0) if high < _WIDE * low else (1.0,)))
    ax.xaxis.set_major_formatter("{x:g}")
    ax.minorticks_off()
    label(ax, "identified over start, with two standard deviations", "", "")
