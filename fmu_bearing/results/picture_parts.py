"""Parts of all pictures: figures without pyplot's global state, colours, labels, files."""

import math
import os
import pathlib
import warnings
from collections.abc import Iterable, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.lines import Line
from fmu_bearing.extras import need
from fmu_bearing.files import check_file, whole

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.collections import LineCollection
    from matplotlib.figure import Figure

#: Colours for all kinds of colour vision (Okabe and Ito, 2008); the total is black.
COLOURS = {
    "total": "#000000",
    "inner_ring": "#0072B2",
    "outer_ring": "#D55E00",
    "cage": "#009E73",
    "balls": "#CC79A7",
}
OTHERS = ("#0072B2", "#D55E00", "#009E73", "#CC79A7", "#E69F00", "#56B4E9", "#000000")
#: Dashes: the next kind where all colours are taken.
DASHES = ("-", "--", "-.", ":")
#: Ground of words that lie on curves or bars.
BEHIND = {"facecolor": "white", "alpha": 0.7, "pad": 0.5, "linewidth": 0.0}
#: Marks on curves whose dashes say something else.
_MARKS = ("", "s", "^", "D")
_WIDEST, _NARROWEST = 3.0, 0.9  # points: of curves that may lie on each other
_APART = len(OTHERS) * len(DASHES)  # curves that colours and dashes tell apart; more go from one to the other
_ENDS = ("#0072B2", "#E69F00")
_NAMED = 14  # names in a column of a legend
_BESIDE, _SAMPLE = 75, 6  # letters beside axes of ten inches, and in place of the sample of a curve
NAMES_TO = 0.2  # of the height: the rows of those names, from the top
_GAP = 2.0  # pixels between texts
_HEIGHTS = 12  # that are tried for a label, each one line of text above the last

_OWN_LETTERS = 0x2E7F  # DejaVu Sans has the scripts below in part; those of East Asia begin here
#: Fonts of systems that have the letters of East Asia.
_FONTS = (
    "Noto Sans CJK SC", "Noto Sans CJK JP", "Noto Sans SC", "Source Han Sans SC", "Microsoft YaHei", "SimHei",
    "PingFang SC", "Hiragino Sans", "Yu Gothic", "Malgun Gothic", "WenQuanYi Micro Hei",
)  # fmt: skip

#: Endings of files, and metadata left out of each: dates and versions.
_METADATA: dict[str, dict[str, None]] = {
    ".png": {"Software": None},
    ".svg": {"Date": None, "Creator": None},
    ".pdf": {"CreationDate": None, "Creator": None, "Producer": None},
}


def check_picture(path: str | os.PathLike[str]) -> pathlib.Path:
    """Return the path of a picture that is going to be written; called before a long computation.

    Raises
    ------
    ValueError
        For an ending other than those of `_METADATA`.
    OSError
        Where it cannot be written.
    MissingExtra
        Without Matplotlib (extra ``plots``).
    """
    target = check_file(path, tuple(_METADATA), "a picture")
    need("matplotlib", "a picture")
    return target


def save(figure: "Figure", path: str | os.PathLike[str]) -> None:
    """Write a figure to a file, its folder made where it is missing; the same figure gives the same bytes.

    Raises
    ------
    ValueError
        As `check_picture`.
    """
    target = check_picture(path)
    _give_fonts(figure)
    with (
        need("matplotlib", "a picture").rc_context({"svg.hashsalt": "fmu-bearing"}),
        warnings.catch_warnings(record=True) as caught,
        whole(target) as file,
    ):
        warnings.simplefilter("always")
        figure.savefig(file, format=target.suffix[1:], dpi=120, metadata=_METADATA[target.suffix])
    absent = [one for one in caught if "missing from font" in str(one.message)]
    for one in caught:
        if one not in absent:
            warnings.warn_explicit(one.message, one.category, one.filename, one.lineno)
    if absent:
        warnings.warn(
            f"{target} has boxes in place of letters that no font here has: install Noto Sans CJK, or name "
            "scenes and microphones in other letters",
            stacklevel=2,
        )


def _give_fonts(figure: "Figure") -> None:
    """Let texts with letters that Matplotlib's own font lacks look for them in fonts of the machine."""
    manager, text = need("matplotlib.font_manager", "a picture"), need("matplotlib.text", "a picture")
    beyond = [
        one
        for one in figure.findobj(text.Text)
        if any(ord(letter) > _OWN_LETTERS for letter in one.get_text())
    ]
    if beyond:
        there = {font.name for font in manager.fontManager.ttflist}
        for one in beyond:
            one.set_fontfamily(["DejaVu Sans", *(name for name in _FONTS if name in there)])


def empty(size: tuple[float, float]) -> "Figure":
    """Return a figure of a size (inches) that needs no screen.

    Raises
    ------
    MissingExtra
        Without Matplotlib (extra ``plots``).
    """
    figure: Figure = need("matplotlib.figure", "a picture").Figure(figsize=size, layout="constrained")
    need("matplotlib.backends.backend_agg", "a picture").FigureCanvasAgg(figure)
    return figure


def single(size: tuple[float, float]) -> "tuple[Figure, Axes]":
    """Return such a figure with one set of axes."""
    figure = empty(size)
    return figure, figure.add_subplot()


def series(place: int, count: int = 0) -> dict[str, Any]:
    """Return colour and dashes of a curve by its place: no two of the first 28 look the same.

    Of ``count`` that are more, the colour goes from blue to orange.
    """
    if count > _APART:
        share = place / (count - 1)
        one, other = (bytes.fromhex(end[1:]) for end in _ENDS)
        mixed = bytes(round(a + share * (b - a)) for a, b in zip(one, other, strict=True))
        return {"color": f"#{mixed.hex().upper()}", "linestyle": DASHES[0]}
    return {
        "color": OTHERS[place % len(OTHERS)], "linestyle": DASHES[place // len(OTHERS) % len(DASHES)],
    }  # fmt: skip


def marked(place: int, mark: str = "") -> dict[str, Any]:
    """Return colour and mark of a curve whose dashes say something else; ``mark``: of the first ones."""
    return {
        "color": OTHERS[place % len(OTHERS)],
        "marker": _MARKS[place // len(OTHERS) % len(_MARKS)] or mark,
    }


def coincident(place: int, count: int) -> dict[str, Any]:
    """Return colour, dashes and width of a curve out of ``count`` that may lie on each other.

    Microphones at mirrored places have one curve: each is narrower than the one below, and dashed in turn.
    """
    if count > _APART:
        return series(place, count) | {"linewidth": _NARROWEST}
    share = place / max(count - 1, 1)
    width = _WIDEST + (_NARROWEST - _WIDEST) * share
    return series(place) | {"linestyle": DASHES[place % len(DASHES)], "linewidth": width}


def closed(values: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return values round a circle with the first one again at the end."""
    return np.append(values, values[:1])


def free_heights(
    places: Sequence[Iterable[float]], base: Sequence[float], widths: Sequence[float], line: float, top: float
) -> list[float | None]:
    """Return a height for each label at which it covers no other; None where it has no room.

    Parameters
    ----------
    places : sequence of iterable of float
        Middle of each label along the axis, pixels, the most important label first; several where the same
        labels are shown on several axes.
    base : sequence of float
        Lowest height of each label, pixels.
    widths : sequence of float
        Of the labels.
    line, top : float
        Height of a label, and that of the picture.
    """
    taken: list[tuple[list[float], float, float]] = []
    heights: list[float | None] = []
    for middles, low, wide in zip(places, base, widths, strict=True):
        own = list(middles)
        free = None
        for height in (low + k * line for k in range(_HEIGHTS)):
            if height + line <= top and not any(
                abs(height - other) < line
                and any(abs(a - b) < 0.5 * (wide + width) for a, b in zip(own, those, strict=True))
                for those, other, width in taken
            ):
                free = height
                taken.append((own, height, wide))
                break
        heights.append(free)
    return heights


def mark_excitation(
    ax: "Axes", end: float | None, place: float | None = None, whose: str = "", row: float | None = None
) -> None:
    """Draw an upright line at the end of the excitation (Hz), where the axis reaches so far.

    ``place``: on the axis, where that is not the frequency itself; ``whose``: said behind the words;
    ``row``: height of level words, of that of the axis (default: upright ones at the top).
    """
    at = end if place is None else place
    if end is None or at is None or not ax.get_xlim()[0] < at < ax.get_xlim()[1]:
        return
    ax.axvline(at, color="0.35", linestyle="--", linewidth=1.0, gid="excitation-end")
    words = f"end of the excitation{whose}, {1e-3 * end:.3g} kHz "
    left, right = ax.get_xlim()
    side = "right" if row is None or at > 0.5 * (left + right) else "left"
    ax.text(at, row or 0.98, words if side == "right" else f" {words}", rotation=90 if row is None else 0,
            fontsize=7, ha=side, va="top", color="0.35", gid="excitation-words",
            transform=ax.get_xaxis_transform(), bbox=BEHIND)  # fmt: skip


def legend_beside(ax: "Axes", **more: Any) -> None:
    """Name the curves to the right of the axes; of more than have room, some at even places, and their count.

    ``more``: of Matplotlib's legend.
    """
    lines, names = ax.get_legend_handles_labels()
    widest = max(map(len, names), default=0) + _SAMPLE
    all_fit = len(names) <= _NAMED * max(1, _BESIDE // widest)
    every = 1 if all_fit else math.ceil(len(names) / _NAMED)
    title = f"{len(names)} curves, 1 of {every} named" if every > 1 else None
    ax.legend(
        lines[::every], names[::every], frameon=False, fontsize=7, loc="center left",
        bbox_to_anchor=(1.0, 0.5), ncols=max(1, math.ceil(len(names[::every]) / _NAMED)), title=title,
        title_fontsize=7, **more,
    )  # fmt: skip


def label(ax: "Axes", x: str, y: str, title: str, grid: bool = True) -> None:
    """Name axes and picture, with a faint grid behind the curves; ticks have whole numbers, no offset."""
    for axis in (ax.xaxis, ax.yaxis):
        plain = getattr(axis.get_major_formatter(), "set_useOffset", None)
        if plain is not None:
            plain(False)
    ax.set_xlabel(x)
    ax.set_ylabel(y)
    ax.set_title(title)
    ax.set_axisbelow(True)
    if grid:
        ax.grid(True, color="0.92")


def name_lines(ax: "Axes", lines: Sequence[Line]) -> None:
    """Write at peaks what explains them, the strongest first, as far as no text covers another."""
    named = [line for line in lines if line.explanation]
    if not named:
        return
    figure = ax.get_figure(root=True)
    assert figure is not None
    figure.draw_without_rendering()  # type: ignore[attr-defined]  # places the axes
    peaks = ax.transData.transform([(line.frequency, line.level) for line in named])
    texts = [
        ax.text(line.frequency, line.level, line.explanation, fontsize=7, ha="center", va="bottom",
                gid="line-name", bbox=BEHIND)
        for line in named
    ]  # fmt: skip
    boxes = [text.get_window_extent() for text in texts]
    high = max(box.height for box in boxes) + _GAP
    inside = ax.get_window_extent()
    # the frequencies' names have their own rows on top
    top = inside.y1 - (NAMES_TO * inside.height if any(t.get_gid() == "mark" for t in ax.texts) else 0.0)
    middles = [
        min(max(x, inside.x0 + 0.5 * box.width), inside.x1 - 0.5 * box.width)
        for (x, _), box in zip(peaks, boxes, strict=True)
    ]
    # beside the words at the end of the excitation
    for words in (text.get_window_extent() for text in ax.texts if text.get_gid() == "excitation-words"):
        middles = [
            x if abs(x - 0.5 * (words.x0 + words.x1)) >= 0.5 * (box.width + words.width) + _GAP
            else words.x0 - 0.5 * box.width - _GAP if peak <= words.x1 or words.x1 + box.width > inside.x1
            else words.x1 + 0.5 * box.width + _GAP
            for x, (peak, _), box in zip(middles, peaks, boxes, strict=True)
        ]  # fmt: skip
    curves = np.vstack(
        [ax.transData.transform(line.get_xydata()) for line in ax.lines if line.get_label()[:1] != "_"]  # type: ignore[index]
    )
    # above all curves that a name reaches over
    base = [
        _GAP + max(y, np.nanmax(curves[np.abs(curves[:, 0] - x) <= 0.5 * box.width, 1], initial=y))
        for (_, y), x, box in zip(peaks, middles, boxes, strict=True)
    ]
    heights = free_heights([[x] for x in middles], base, [box.width + _GAP for box in boxes], high, top)
    back = ax.transData.inverted()
    leaders = []
    for text, line, x, height in zip(texts, named, middles, heights, strict=True):
        if height is None:
            text.remove()
        else:
            across, level = map(float, back.transform((x, height)))
            text.set_position((across, level))
            leaders.append([(line.frequency, line.level), (across, level)])
    ax.add_collection(_leaders(leaders), autolim=False)


def _leaders(ways: Sequence[Sequence[tuple[float, float]]]) -> "LineCollection":
    """Thin lines from peaks to their names."""
    collections = need("matplotlib.collections", "a picture")
    found: LineCollection = collections.LineCollection(
        ways, colors="0.5", linewidths=0.6, zorder=1.5, gid="line-leader"
    )
    return found
