"""The chart of a tradeoff study: error against speed, one panel per kind of error, the best marked."""

import itertools
import math
import pathlib
from collections.abc import Sequence
from typing import TYPE_CHECKING

from fmu_bearing.accuracy.tradeoff import Row, Tradeoff
from fmu_bearing.extras import need
from fmu_bearing.results.picture_parts import empty, save

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Point = tuple[Row, float, float]  # row, speed, error

_FLOOR = 1e-7  # smaller errors are drawn here
#: Colour and marker of each fidelity and method (colours by Okabe and Ito, 2008, for all colour vision).
_STYLES = {
    "full / esdirk4": ("#0072B2", "o"),
    "full / trbdf2": ("#56B4E9", "v"),
    "full / rk4": ("#000000", "x"),
    "rings": ("#009E73", "D"),
    "response": ("#CC79A7", "P"),
}
_PANELS = (
    ("rms ring velocity", "relative error", "ring_rms"),
    ("mean contact load", "relative error", "load"),
    ("friction torque", "relative error", "torque"),
    ("sound, worst microphone", "error, dB(A)", "level"),
)


def pareto_front(points: Sequence[tuple[float, float]]) -> list[int]:
    """Places, fastest first, of those (speed, error) points that none betters in both (Pareto front)."""
    best, places = math.inf, []
    for k in sorted(range(len(points)), key=lambda k: (-points[k][0], points[k][1])):
        if points[k][1] < best:
            best = points[k][1]
            places.append(k)
    return places


def draw(study: Tradeoff, path: pathlib.Path) -> None:
    """Draw the four kinds of error against simulated s per CPU s in use (log-log) into a PNG file."""
    Line2D = need("matplotlib.lines", "the chart").Line2D
    figure = empty((13.0, 9.5))
    axes = figure.subplots(2, 2, sharex=True).ravel()
    drawn = []
    for ax, (title, unit, kind) in zip(axes, _PANELS, strict=True):
        drawn.append((ax, *_panel(ax, study.rows, kind)))
        ax.set_title(title)
        ax.set_ylabel(unit)
    for ax in axes[2:]:
        ax.set_xlabel("simulated s per CPU s, without sound, as inputs of a co-simulation move")
    figure.suptitle(f"{study.scene}, {study.rpm:,.0f} r/min: what accuracy costs (faster to the right)")
    used = {row.setting.name for row in study.rows if row.errors is not None}
    handles = [
        Line2D([], [], color=color, marker=marker, linestyle="", label=name)
        for name, (color, marker) in _STYLES.items()
        if name in used
    ]
    hollow = Line2D([], [], color="0.4", marker="o", linestyle="", label="terms or strips left out")
    hollow.set_markerfacecolor("none")
    handles.append(hollow)
    handles.append(Line2D([], [], color="0.5", label="best of those with all terms (Pareto front)"))
    figure.legend(handles=handles, loc="outside lower center", ncols=4, frameon=False)
    figure.draw_without_rendering()  # the layout is settled: labels are placed in pixels
    for ax, best, points in drawn:
        _label(ax, best, points)
    save(figure, path)


def _panel(ax: "Axes", rows: Sequence[Row], kind: str) -> tuple[list[Point], list[Point]]:
    """Draw one kind of error; return the points of the front and all points."""
    shown = [
        (row, row.paces.slowest, max(getattr(row.errors, kind), _FLOOR))
        for row in rows
        if row.errors is not None
        and math.isfinite(row.paces.slowest)
        and math.isfinite(getattr(row.errors, kind))
    ]
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.grid(True, which="major", color="0.9")
    if not shown:
        ax.text(0.5, 0.5, "not in this scene", ha="center", va="center", transform=ax.transAxes)
        return [], []
    for row, speed, error in shown:
        color, marker = _STYLES[row.setting.name]
        face = "none" if _reduced(row) and marker != "x" else color
        ax.plot(speed, error, marker=marker, color=color, markerfacecolor=face, linestyle="")
    whole = [entry for entry in shown if not _reduced(entry[0])]
    best = [whole[k] for k in pareto_front([(speed, error) for _, speed, error in whole])]
    ax.plot([entry[1] for entry in best], [entry[2] for entry in best], color="0.5", linewidth=1.0, zorder=0)
    ax.margins(x=0.16, y=0.12)
    return best, shown


def _reduced(row: Row) -> bool:
    """Whether a row leaves out terms or strips: it may be fast, but computes another bearing."""
    return bool(row.setting.without) or row.setting.strips < 5


def _label(ax: "Axes", best: Sequence[Point], points: Sequence[Point]) -> None:
    """Name the points of the front, each at the nearest place that hides no point and no other name."""
    if not points:
        return
    pixels = ax.transData.transform([point[1:] for point in points])
    unit = ax.figure.dpi / 72.0
    Bbox = need("matplotlib.transforms", "the chart").Bbox
    taken = [Bbox.from_bounds(x - 5 * unit, y - 5 * unit, 10 * unit, 10 * unit) for x, y in pixels]
    for row, speed, error in best:
        words = _words(row)
        x, y = ax.transData.transform((speed, error))
        width, height = 4.3 * unit * len(words), 9.0 * unit
        for shift, right in itertools.product((0, 11, -11, 22, -22, 33, -33, 44, -44, 55), (True, False)):
            left = x + 9 * unit if right else x - 9 * unit - width
            box = Bbox.from_bounds(left, y + shift * unit - height / 2, width, height)
            if not box.count_overlaps(taken):
                break
        taken.append(box)
        ax.annotate(
            words, (speed, error), xytext=(9 if right else -9, shift), textcoords="offset points",
            fontsize=7.5, ha="left" if right else "right", va="center", color="0.2",
            arrowprops={"arrowstyle": "-", "color": "0.75", "linewidth": 0.6} if shift else None,
        )  # fmt: skip


def _words(row: Row) -> str:
    """Step and tolerance; colour and marker show fidelity and method."""
    s = row.setting
    if s.fidelity == "response":
        return "response"
    return f"{1e6 * s.max_step:g} us, tol {s.tolerance:.0e}".replace("e-0", "e-")
