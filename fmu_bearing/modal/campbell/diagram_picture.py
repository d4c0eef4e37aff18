"""The Campbell diagram as a picture."""

import re
import textwrap
from typing import TYPE_CHECKING, Any, cast

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.extras import need
from fmu_bearing.modal.campbell.diagram import Branch, Crossing, Diagram
from fmu_bearing.modal.campbell.diagram_style import (
    ALIKE,
    LIMITS,
    SHORT,
    UNSTABLE,
    WIDTH_WORDS,
    WIDTHS,
    Content,
    End,
    colour,
    content,
    dot_area,
    end_of,
    last_of,
    level_band,
    names_beside,
    runs,
    spaced,
    unstable,
)
from fmu_bearing.results.picture_parts import empty, label

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from matplotlib.text import Annotation

_SIZE = (10.0, 7.2)  # inches
_LEFT, _BOTTOM, _ACROSS = 0.09, 0.225, 0.695  # of the figure: axes, names to the right
_TOP, _TOP_NAMED = 0.945, 0.865  # without names above the axes, and with them
_DASHES: dict[str, Any] = {"forward": "-", "backward": (0, (4.5, 2.0)), "": (0, (1.0, 1.3))}
_DIRECTIONS = {"forward": "forward", "backward": "backward", "": "no direction"}
_FONT = 8.5  # pt
_STEP = 1.32 * _FONT  # pt between the middles of names
_SLANTED = 1.5 * _FONT  # pt along the axis between slanted names
_BESIDE = 8  # lines that are named beside the axes, between the branches
_DARK, _FAINT, _BAND = "#4A545E", "#CBD2D8", "#F1F6FA"
_QUALITIES = (5.0, 25.0, 100.0)
_WRAP = 68  # characters of the text below the axes


def campbell_picture(campbell: Diagram) -> "Figure":
    """Draw branches, the lines that can excite them, crossings and the operating speed.

    Parameters
    ----------
    campbell : Diagram

    Returns
    -------
    Figure
        Its parts have a ``gid``: ``branch-K`` with K the place in ``campbell.branches``, ``crossings``,
        ``line-NAME``, ``operation``, ``nearest``, and ``name``, ``line-name``, ``margin`` and ``verdict`` of
        the texts.

    Raises
    ------
    MissingExtra
        Without Matplotlib (extra ``plots``).
    """
    figure = empty(_SIZE)
    # names are set by their sizes, so the axes must not move afterwards
    figure.set_layout_engine("none")
    shown = content(campbell)
    highest, speeds = shown.highest, shown.speeds
    curves = {line.name: curve for line, curve, _ in shown.lines}
    upper = _TOP_NAMED if any(curve[-1] > highest for curve in curves.values()) else _TOP
    ax = figure.add_axes((_LEFT, _BOTTOM, _ACROSS, upper - _BOTTOM))
    ax.set_xlim(float(speeds[0]), float(speeds[-1]))
    ax.set_ylim(0.0, highest)
    label(ax, "speed, r/min", "frequency, Hz", "")
    ax.xaxis.set_major_formatter("{x:,.0f}")
    ax.yaxis.set_major_formatter("{x:,.0f}")
    band = level_band(campbell)
    if band is not None:
        ax.axhspan(*band, color=_BAND, zorder=0, gid="band")
    drawn = {k: one for k, one in enumerate(campbell.branches) if float(one.frequency.min()) < highest}
    for k, branch in drawn.items():
        _draw_branch(ax, branch, f"branch-{k}")
    for line, curve, dark in shown.lines:
        tint = _between(_FAINT, _DARK, dark)
        ax.plot(speeds, curve, color=tint, linewidth=0.7, zorder=1.5, gid=f"line-{line.name}")
    _draw_crossings(ax, shown.crossings)
    _name_above(ax, speeds, curves)
    named = _name_beside(ax, list(drawn.values()), curves)
    _name_inside(ax, [branch for branch in drawn.values() if not _is_named(branch, named, highest)])
    _draw_operation(ax, shown)
    _explain(figure, campbell, len(campbell.branches) - len(drawn))
    figure.text(_LEFT, 0.988, _title(campbell), fontsize=11, ha="left", va="top")
    return figure


def _between(one: str, other: str, share: float) -> tuple[float, ...]:
    """Mix two colours."""
    colours = need("matplotlib.colors", "a picture")
    a, b = (np.array(colours.to_rgb(name)) for name in (one, other))
    return tuple(float(value) for value in a + share * (b - a))


def _draw_branch(ax: "Axes", branch: Branch, gid: str) -> None:
    tint, dash = colour(branch.name), _DASHES[branch.direction]
    for run in runs(branch):
        ax.plot(
            run.rpm, run.frequency, color=tint, linewidth=WIDTHS[run.weak], linestyle=dash, zorder=3, gid=gid,
            dash_capstyle="butt", alpha=0.6 if run.weak == len(LIMITS) else 1.0,
        )  # fmt: skip
        if run.weak == 0:
            ax.plot(
                run.rpm, run.frequency, color=UNSTABLE, linewidth=7.0, alpha=0.35, zorder=2.5,
                solid_capstyle="butt", gid="unstable",
            )  # fmt: skip


def _draw_crossings(ax: "Axes", ordered: list[Crossing]) -> None:
    inside = [one.velocity > 0.0 for one in ordered]
    tints = [colour(one.branch.name) for one in ordered]
    ax.scatter(
        [abs(one.rpm) for one in ordered], [one.frequency for one in ordered],
        s=[dot_area(one.quality) for one in ordered],
        c=[tint if own else "white" for tint, own in zip(tints, inside, strict=True)],
        edgecolors=["white" if own else tint for tint, own in zip(tints, inside, strict=True)],
        linewidths=0.7, zorder=4, gid="crossings",
    )  # fmt: skip


def _draw_operation(ax: "Axes", shown: Content) -> None:
    """Draw the operating speed as a bar, the nearest crossing in a ring, and how far it is."""
    own, near = shown.operation, shown.near
    if own is None:
        return
    low, high = ax.get_xlim()
    half = 0.003 * (high - low)
    ax.axvspan(own - half, own + half, color="black", alpha=0.22, linewidth=0.0, zorder=2, gid="operation")
    if near is not None:
        ax.scatter(
            [abs(near.rpm)], [near.frequency], s=dot_area(near.quality) + 90.0, facecolors="none",
            edgecolors="black", linewidths=1.3, zorder=5, gid="nearest",
        )  # fmt: skip
        ax.plot([own, abs(near.rpm)], [near.frequency] * 2, color="black", linewidth=1.3, zorder=5)
    text = ax.annotate(
        "\n".join(filter(None, shown.words)), (own, 0.0), xytext=(0.0, 0.0), textcoords="offset points",
        va="center", fontsize=_FONT, fontweight="bold", zorder=6, gid="margin", linespacing=1.25,
        bbox={"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 1.0},
    )  # fmt: skip
    heights = np.linspace(1.3 * _STEP, _height(ax) - 1.3 * _STEP, 24)
    _put(ax, text, [(side * 5.0, float(dy)) for dy in heights for side in (-1.0, 1.0)])


def _figure(ax: "Axes") -> "Figure":
    return cast("Figure", ax.get_figure())


def _height(ax: "Axes") -> float:
    """Height of the axes in points."""
    return float(72.0 * _figure(ax).get_size_inches()[1] * ax.get_position().height)


def _width(ax: "Axes") -> float:
    """Width of the axes in points."""
    return float(72.0 * _figure(ax).get_size_inches()[0] * ax.get_position().width)


def _name_beside(
    ax: "Axes", branches: "list[Branch]", curves: dict[str, NDArray[np.float64]]
) -> "list[Branch]":
    """Name what reaches the right edge in a column beside it, in the order of the ends, each tied to its own.

    Both directions of a mode share a name where they end close together. Return the branches named.
    """
    highest, (left, right) = ax.get_ylim()[1], ax.get_xlim()
    reaching = [branch for branch in branches if _reaches(branch, right, highest)]
    # curves come with the strongest first
    lines = [End(curve[-1], name, "", _DARK) for name, curve in curves.items() if curve[-1] <= highest]
    ends, span = [*map(end_of, reaching), *lines[:_BESIDE]], right - left
    for height, words, group in names_beside(ends, highest, _height(ax), _STEP):
        tint = group[0].tint
        for end in group:
            ax.plot(
                right + span * np.array([0.0, 0.006, 0.03, 0.036]), [end.frequency] * 2 + [height] * 2,
                color=tint, linewidth=0.8, clip_on=False, gid="tie",
            )  # fmt: skip
        ax.text(
            right + 0.042 * span, height, words, color=tint, fontsize=_FONT, va="center_baseline", ha="left",
            gid="name",
        )  # fmt: skip
    return reaching


def _reaches(branch: Branch, right: float, highest: float) -> bool:
    """Whether a branch ends at the right edge."""
    return abs(float(branch.rpm[last_of(branch)])) > 0.999 * right and end_of(branch).frequency <= highest


def _is_named(branch: Branch, named: "list[Branch]", highest: float) -> bool:
    """Whether a branch, or another one of its name and height, is among those named."""
    return any(
        branch is other
        or (
            branch.label == other.label
            and abs(end_of(branch).frequency - end_of(other).frequency) < ALIKE * highest
        )
        for other in named
    )


def _name_inside(ax: "Axes", branches: "list[Branch]") -> None:
    """Name branches that end within the axes there, out of the way of curves and other names."""
    highest = ax.get_ylim()[1]
    for branch in branches:
        *_, run = (run for run in runs(branch) if run.frequency.min() <= highest)
        last = np.flatnonzero(run.frequency <= highest)[-1]
        text = ax.annotate(
            f"{branch.name} {SHORT[branch.direction]}".rstrip(),
            (float(run.rpm[last]), float(run.frequency[last])), xytext=(0.0, 0.0),
            textcoords="offset points", fontsize=_FONT, color=colour(branch.name), va="center", zorder=6,
            gid="name", bbox={"facecolor": "white", "alpha": 0.8, "edgecolor": "none", "pad": 0.5},
        )  # fmt: skip
        steps = sorted((0.5 * k * _STEP for k in range(-10, 11)), key=abs)
        _put(ax, text, [(side * 4.0, dy) for dy in steps for side in (1.0, -1.0)])


def _put(ax: "Axes", text: "Annotation", places: list[tuple[float, float]]) -> None:
    """Set a text to the first of the places (pt from its point) where it hides least.

    Other texts and dots count more than curves, and the edge of the axes counts as a text.
    """
    renderer = _figure(ax).canvas.get_renderer()  # type: ignore[attr-defined]
    frame = ax.get_window_extent(renderer)
    taken = [other.get_window_extent(renderer) for other in ax.texts if other is not text]
    marks = np.concatenate(
        [
            ax.transData.transform(np.asarray(line.get_xydata()))
            for line in ax.lines
            if line.get_zorder() >= 2.0
        ]
    )
    dots = [part for part in ax.collections if part.get_gid() in ("crossings", "nearest")]
    middles = np.concatenate(
        [np.empty((0, 2))] + [ax.transData.transform(part.get_offsets()) for part in dots]
    )
    areas = np.concatenate([np.empty(0)] + [part.get_sizes() for part in dots])  # type: ignore[attr-defined]
    radii = np.sqrt(areas) * _figure(ax).dpi / 144.0  # areas are of squares around, in square points

    def hidden(place: tuple[float, float]) -> float:
        text.set_position(place)
        text.set_horizontalalignment("left" if place[0] > 0.0 else "right")
        box = text.get_window_extent(renderer).padded(1.0)
        outside = box.x0 < frame.x0 or box.x1 > frame.x1 or box.y0 < frame.y0 or box.y1 > frame.y1
        x, y = marks.T
        under = np.count_nonzero((x > box.x0) & (x < box.x1) & (y > box.y0) & (y < box.y1))
        apart = np.maximum(np.maximum([box.x0, box.y0] - middles, middles - [box.x1, box.y1]), 0.0)
        hit = np.count_nonzero(np.hypot(*apart.T) < radii)
        return 1e4 * (outside + sum(box.overlaps(other) for other in taken) + hit) + under

    hidden(min(places, key=hidden))


def _name_above(ax: "Axes", speeds: NDArray[np.float64], curves: dict[str, NDArray[np.float64]]) -> None:
    """Name the lines that leave through the top where they leave, as many of the strongest as have room."""
    highest, (left, right) = ax.get_ylim()[1], ax.get_xlim()
    unit = _width(ax) / (right - left)
    leaving = [name for name, curve in curves.items() if curve[-1] > highest]
    # excitations rise with speed
    at = sorted(
        (float(np.interp(highest, curves[name], speeds)), name)
        for name in leaving[: int(_width(ax) / _SLANTED)]
    )
    if not at:
        return
    wanted = np.array([(rpm - left) * unit for rpm, _ in at])
    places = spaced(wanted, _SLANTED, 0.0, _width(ax)) / unit + left
    for (rpm, name), place in zip(at, places, strict=True):
        ax.plot([rpm, place], [highest, 1.02 * highest], color=_DARK, linewidth=0.6, clip_on=False, gid="tie")
        ax.text(
            place, 1.025 * highest, name, rotation=50.0, rotation_mode="anchor", ha="left", va="center",
            fontsize=_FONT - 1.0, color=_DARK, gid="line-name",
        )  # fmt: skip


def _title(campbell: Diagram) -> str:
    return f"{campbell.scene.name}: natural frequencies over speed, and what excites them"


def _explain(figure: "Figure", campbell: Diagram, hidden: int) -> None:
    """Say below the axes how to read them, and what the diagram says."""
    line = need("matplotlib.lines", "a picture").Line2D
    grey: dict[str, Any] = {"color": "0.25"}
    weak = any(unstable(branch).any() for branch in campbell.branches)
    first = (
        line([], [], color=UNSTABLE, alpha=0.35, linewidth=7.0, label=f"damping {WIDTH_WORDS[0]}")
        if weak
        else line([], [], linestyle="none", label=" ")
    )
    handles = [
        *(line([], [], linestyle=dash, linewidth=1.7, label=_DIRECTIONS[way], **grey)
          for way, dash in _DASHES.items()),
        first,
        *(line([], [], linewidth=width, label=f"damping {words}", **grey)
          for width, words in zip(WIDTHS[1:], WIDTH_WORDS[1:], strict=True)),
        *(line([], [], linestyle="none", marker="o", markersize=dot_area(q) ** 0.5, markeredgecolor="white",
               label=f"Q = {q:.0f}", **grey) for q in _QUALITIES),
    ]  # fmt: skip
    figure.legend(
        handles=handles, loc="upper left", bbox_to_anchor=(_LEFT - 0.01, _BOTTOM - 0.072), ncols=3,
        frameon=False, fontsize=_FONT, handlelength=2.6, columnspacing=1.4, borderpad=0.0,
    )  # fmt: skip
    remarks = [campbell.verdict()]
    band = level_band(campbell)
    remarks += [f"{words[0].upper()}{words[1:]}." for words in campbell.cautions()[:2]]
    if hidden:
        modes = "1 mode lies" if hidden == 1 else f"{hidden} modes lie"
        remarks.append(f"{modes} above, where nothing drawn meets them.")
    if band is not None:
        remarks.append(f"Shaded: {band[0]:g} Hz to {1e-3 * band[1]:g} kHz, the band of the sound levels.")
    words = _wrapped(remarks)
    # pt: smaller where there are more lines than have room down to the edge
    size = min(_FONT - 0.5, 72.0 * _SIZE[1] * (_BOTTOM - 0.08) / (1.5 * (1 + words.count("\n"))))
    figure.text(
        0.575, _BOTTOM - 0.075, words, fontsize=size,
        va="top", ha="left", gid="verdict", linespacing=1.3,
    )  # fmt: skip


def _wrapped(remarks: list[str]) -> str:
    """Break lines, but not between a number and its unit."""
    unit = re.compile(r"(?<=\d) (?=%|Hz|kHz|r/min)")
    return "\n".join(textwrap.fill(unit.sub("\u00a0", words), _WRAP) for words in remarks)
