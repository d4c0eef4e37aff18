"""One figure per source: ours over theirs, with the range that the assumed inputs give."""

import math
from collections.abc import Sequence
from pathlib import Path

from benchmarks.measured.compared import Compared
from fmu_bearing.results.picture_parts import OTHERS, empty, label, save

_MANY = 16  # values: beyond them the axis names groups, not values


def group(one: Compared) -> str:
    """Return what values of a source have in common, for colours and the axis."""
    value = one.value
    if value.source in ("nsk", "tpi"):
        return f"{value.angle_deg:g} deg, {value.balls}"
    if value.source == "skf":
        return f"{value.viscosity_mm2_s:g} mm2/s"
    if value.source == "cwru":
        return value.remark
    return ""


def words(one: Compared) -> str:
    """Return a value's condition in few words."""
    value = one.value
    parts = [value.grade, f"{value.angle_deg:g} deg" if value.source == "ibc" else "",
             f"{value.speed_rpm:,.0f} r/min" if value.speed_rpm == value.speed_rpm else "",
             f"{value.load_N:g} N" if value.load_N == value.load_N else "",
             value.quantity.split(", ")[-1] if value.source == "kyk" else "",
             value.bearing.replace(" ", "\n") if value.source == "paderborn" else ""]  # fmt: skip
    return "\n".join(part for part in parts if part) or value.bearing


def draw(rows: Sequence[Compared], path: Path) -> None:
    """Write the figure of a source's values: one set of axes per quantity."""
    quantities = list(dict.fromkeys(_quantity(one) for one in rows))
    figure = empty((8.0, 2.6 * len(quantities) + 0.4))
    for place, name in enumerate(quantities):
        ax = figure.add_subplot(len(quantities), 1, place + 1)
        some = [one for one in rows if _quantity(one) == name]
        groups = list(dict.fromkeys(map(group, some)))
        some.sort(key=lambda one: groups.index(group(one)))
        for k, wanted in enumerate(groups):
            at = [j for j, one in enumerate(some) if group(one) == wanted]
            found = [some[j].found for j in at]
            ends = [sorted((some[j].beside(some[j].low), some[j].beside(some[j].high))) for j in at]
            bars = [
                [max(0.0, y - end[0]) for y, end in zip(found, ends, strict=True)],
                [max(0.0, end[1] - y) for y, end in zip(found, ends, strict=True)],
            ]
            ax.errorbar(at, found, yerr=bars, fmt="o", markersize=3.0, linewidth=0.7,
                        color=OTHERS[k % len(OTHERS)], label=wanted or None)  # fmt: skip
        ax.axhline(0.0 if some[0].difference else 1.0, color="0.4", linewidth=0.8)
        unit = "" if some[0].value.unit in ("-", "") else f", {some[0].value.unit}"
        label(ax, "", f"ours less theirs{unit}" if some[0].difference else "ours over theirs", name)
        if len(some) <= _MANY:
            ax.set_xticks(range(len(some)), [words(one) for one in some], fontsize=7)
        else:
            ax.set_xticks([])
        if any(groups):
            ax.legend(fontsize=7, ncols=len(groups), loc="best")
    save(figure, path)


def _quantity(one: Compared) -> str:
    return "vibration beside the limit" if one.value.source == "kyk" else one.value.quantity


def drawable(rows: Sequence[Compared]) -> list[Compared]:
    """Return the values of which a figure says something."""
    return [one for one in rows if one.counts and not math.isnan(one.ours)]
