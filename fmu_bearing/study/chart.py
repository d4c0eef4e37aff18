"""The chart of a tradeoff study: error against speed, one panel per kind of error, the best marked."""

import math
import pathlib
from collections.abc import Sequence

from matplotlib.axes import Axes
from matplotlib.backends.backend_agg import FigureCanvasAgg
from matplotlib.figure import Figure
from matplotlib.lines import Line2D

from fmu_bearing.study.tradeoff import Row, Tradeoff

_FLOOR = 1e-7  # smaller errors are drawn here
#: Colour and marker of each level and method (colours: Okabe and Ito, 2008, told apart by all eyes).
_STYLES = {
    "full / esdirk4": ("#0072B2", "o"),
    "full / fast": ("#D55E00", "s"),
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


def front(points: Sequence[tuple[float, float]]) -> list[int]:
    """Places, fastest first, of those (speed, error) points that none betters in both (Pareto front)."""
    best, places = math.inf, []
    for k in sorted(range(len(points)), key=lambda k: (-points[k][0], points[k][1])):
        if points[k][1] < best:
            best = points[k][1]
            places.append(k)
    return places


def draw(study: Tradeoff, path: pathlib.Path) -> None:
    """Draw the four kinds of error against simulated s per wall s (log-log) into a PNG file."""
    figure = Figure(figsize=(13.0, 9.5), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(2, 2, sharex=True).ravel()
    for ax, (title, unit, kind) in zip(axes, _PANELS, strict=True):
        _panel(ax, study.rows, kind)
        ax.set_title(title)
        ax.set_ylabel(unit)
    for ax in axes[2:]:
        ax.set_xlabel("simulated s per wall s, without sound")
    figure.suptitle(f"{study.scene}, {study.rpm:,.0f} r/min: what accuracy costs (faster to the right)")
    used = {row.setting.name for row in study.rows if row.errors is not None}
    handles = [
        Line2D([], [], color=color, marker=marker, linestyle="", label=name)
        for name, (color, marker) in _STYLES.items()
        if name in used
    ]
    handles.append(
        Line2D(
            [],
            [],
            color="0.4",
            marker="o",
            markerfacecolor="none",
            linestyle="",
            label="terms or strips left out",
        )
    )
    handles.append(Line2D([], [], color="0.5", label="Pareto front"))
    figure.legend(handles=handles, loc="outside lower center", ncols=4, frameon=False)
    path.parent.mkdir(parents=True, exist_ok=True)
    figure.savefig(path, dpi=120, metadata={"Software": None})


def _panel(ax: Axes, rows: Sequence[Row], kind: str) -> None:
    shown = [
        (row, row.wall, max(getattr(row.errors, kind), _FLOOR))
        for row in rows
        if row.errors is not None and math.isfinite(row.wall) and math.isfinite(getattr(row.errors, kind))
    ]
    ax.set_xscale("log")
    ax.set_yscale("log")
    ax.grid(True, which="major", color="0.9")
    if not shown:
        ax.text(0.5, 0.5, "not in this scene", ha="center", va="center", transform=ax.transAxes)
        return
    for row, speed, error in shown:
        color, marker = _STYLES[row.setting.name]
        reduced = row.setting.without or row.setting.strips < 5
        face = "none" if reduced and marker != "x" else color
        ax.plot(speed, error, marker=marker, color=color, markerfacecolor=face, linestyle="")
    best = front([(speed, error) for _, speed, error in shown])
    ax.plot([shown[k][1] for k in best], [shown[k][2] for k in best], color="0.5", linewidth=1.0, zorder=0)
    ax.margins(x=0.18, y=0.12)
    _label(ax, [shown[k] for k in best])


def _label(ax: Axes, points: Sequence[tuple[Row, float, float]]) -> None:
    """Name the points of the front, fastest first, on alternate sides of it and clear of each other."""
    taken: list[tuple[float, float]] = []
    for k, (row, speed, error) in enumerate(points):
        right = k % 2 == 0
        # a label as far up or down as keeps it half a decade of error from those beside it
        shift = 4.0
        place = (math.log10(speed), math.log10(error))
        while any(abs(place[0] - x) < 0.5 and abs(place[1] + shift / 30.0 - y) < 0.35 for x, y in taken):
            shift += 8.0
        taken.append((place[0], place[1] + shift / 30.0))
        ax.annotate(
            _words(row), (speed, error), xytext=(6 if right else -6, shift), textcoords="offset points",
            fontsize=7.5, ha="left" if right else "right", color="0.2",
            arrowprops={"arrowstyle": "-", "color": "0.75", "linewidth": 0.6} if shift > 12.0 else None,
        )  # fmt: skip


def _words(row: Row) -> str:
    """Step, tolerance and what is left out; level and method are told by colour and marker."""
    s = row.setting
    if s.level == "response":
        return "response"
    text = f"{1e6 * s.max_step:g} us, {s.tolerance:g}"
    if s.strips < 5:
        text += f", {s.strips} strip" + ("s" if s.strips > 1 else "")
    if s.without:
        text += ", without " + s.left_out
    return text.replace("without all that can be", "fewest terms")
