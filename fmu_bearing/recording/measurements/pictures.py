"""Pictures of sound measurements: each function returns a Matplotlib figure, `save` writes it.

Examples
--------
>>> from fmu_bearing import pictures
>>> figure = pictures.third_octave_picture([500.0, 1000.0, 2000.0], {"total": [60.0, 72.5, 65.0]})
>>> pictures.save(figure, "third-octaves.png")
"""

import math
from collections.abc import Mapping, Sequence
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fmu_bearing.acoustics.analysis.lines import Line
from fmu_bearing.acoustics.analysis.order import OrderMap, Waterfall
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.acoustics.analysis.third_octave import nominal_frequency
from fmu_bearing.recording.measurements.measure import MotionPower, Round, Sweep
from fmu_bearing.results.defect_lines import DefectLine
from fmu_bearing.results.levels import RANGE, mapped, radial_range, sounding
from fmu_bearing.results.picture_parts import (
    COLOURS,
    NAMES_TO,
    OTHERS,
    closed,
    coincident,
    empty,
    label,
    legend_beside,
    mark_excitation,
    name_lines,
    save,
    series,
    single,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

__all__ = [
    "circle_picture",
    "order_picture",
    "planes_picture",
    "power_picture",
    "sides_picture",
    "save",
    "spectrum_picture",
    "sweep_picture",
    "third_octave_picture",
    "waterfall_picture",
]

_ROOM = 34.0  # dB above the highest level for names of lines
_NAME_ROOM = 0.035  # of an axis: what the name of a frequency takes
_ABOVE = 10  # curves whose names have room above the axes
_ROW = 0.05  # of the height of third octaves: a row of words at the end of the excitation
_HATCHES = ("", "///", "...", "xxx")  # of bars, where all colours are taken
_HARMONICS = 3  # of each kinematic frequency that are marked


def spectrum_picture(
    frequency: ArrayLike,
    spectra: Mapping[str, ArrayLike],
    kinematics: KinematicFrequencies | None = None,
    title: str = "",
    excitation_end: float | Mapping[str, float] | None = None,
    lines: Sequence[Line] = (),
    defects: Sequence[DefectLine] = (),
) -> "Figure":
    """Draw levels (dB) over frequency (Hz), one curve each, kinematic frequencies and harmonics marked.

    A silent component has a dash behind its name and no curve.

    Parameters
    ----------
    frequency : array_like, shape (bins,)
        In Hz.
    spectra : mapping
        Levels (dB) of each curve by its name, shape (bins,).
    kinematics : KinematicFrequencies, optional
        In Hz; default: none are marked.
    title : str
    excitation_end : float or mapping, optional
        Frequency (Hz) where the excitation ends (``Recording.excitation_end``), or several by name.
    lines : sequence of Line
        Strongest lines, strongest first, as `measure.strongest` gives them: as many are named at their peaks
        as have room. One that no kinematic line explains has the nearest with a question mark and its
        distance.
    defects : sequence of DefectLine
        Whose first lines are marked, one entry of the legend each.
    """
    figure, ax = single((10.0, 5.0))
    f = np.asarray(frequency, dtype=float)
    for name, style in _styles(spectra).items():
        values = sounding(spectra[name])
        ax.plot(f, values, **style, label=_entry(name, values))
    top = max(float(np.max(np.asarray(levels)[1:])) for levels in spectra.values())
    ax.set_ylim(top - RANGE, top + (_ROOM if lines else 12.0))
    ax.set_xlim(0.0, float(f[-1]))
    for whose, end in _ends(excitation_end):
        mark_excitation(ax, end, whose=whose)
    _mark_defects(ax, defects, float(f[-1]))
    label(ax, "frequency, Hz", "level, dB re 20 uPa", title)
    if len(spectra) > _ABOVE:
        legend_beside(ax)
    else:
        beyond = 1.05 if title else 1.0
        ax.legend(frameon=False, ncols=5, loc="lower center", bbox_to_anchor=(0.5, beyond))
    if kinematics is not None:
        _mark(ax, kinematics, float(f[-1]))
    name_lines(ax, [line for line in lines if line.frequency <= f[-1]])
    _lower(ax, top + 12.0)
    return figure


def _lower(ax: "Axes", least: float) -> None:
    """Lower the end of an axis to ``least``, or as far as curves and names of lines let it."""
    low, high = ax.get_ylim()
    inverse = ax.transData.inverted()
    boxes = [(text.get_gid(), text.get_window_extent().transformed(inverse)) for text in ax.texts]
    # names of frequencies have rows on top, and the end of the excitation its words, above what lies there
    marked = max((box.x1 for kind, box in boxes if kind == "mark"), default=-math.inf)
    rows = [(-math.inf, marked, NAMES_TO)] + [
        (box.x0, box.x1, 0.02 + box.height / (high - low))
        for kind, box in boxes
        if kind == "excitation-words"
    ]
    names = [(box.x0, box.x1, box.y1) for kind, box in boxes if kind == "line-name"]
    needed = [least, *(low + (y - low) / (1.0 - (NAMES_TO if x <= marked else 0.02)) for x, _, y in names)]
    drawn = [line for line in ax.lines if not str(line.get_label()).startswith("_")]
    curves = np.vstack([np.asarray(line.get_xydata(), dtype=float) for line in drawn])
    for first, last, share in rows:
        there = curves[(curves[:, 0] >= first) & (curves[:, 0] <= last), 1]
        needed.append(low + (float(np.nanmax(there, initial=low)) - low) / (1.0 - share))
    ax.set_ylim(low, min(high, max(needed)))


def sides_picture(
    frequency: ArrayLike, sides: Mapping[str, ArrayLike], title: str = "",
    excitation_ends: Mapping[str, float] | None = None,
) -> "Figure":  # fmt: skip
    """Draw spectra (dB) one above the other on one scale, each over the others in grey: none hides another.

    ``excitation_ends``: as of `spectrum_picture`, by the names of ``sides``.
    """
    figure = empty((10.0, 0.8 + 2.6 * len(sides)))
    axes = figure.subplots(len(sides), 1, sharex=True, sharey=True, squeeze=False)[:, 0]
    f = np.asarray(frequency, dtype=float)
    top = max(float(np.max(np.asarray(levels)[1:])) for levels in sides.values())
    for k, (ax, name) in enumerate(zip(axes, sides, strict=True)):
        colour = OTHERS[k % len(OTHERS)]
        for other in sides:
            if other != name:
                ax.plot(f, sounding(sides[other]), color="0.8", linewidth=0.8, gid="other")
        ax.plot(f, sounding(sides[name]), color=colour, linewidth=0.8, label=name)
        ax.set_xlim(0.0, float(f[-1]))
        ax.set_ylim(top - RANGE, top + 12.0)
        mark_excitation(ax, (excitation_ends or {}).get(name))
        label(ax, "", "dB re 20 uPa", "")
        ax.set_title(_entry(name, sounding(sides[name])), fontsize=9, loc="left", color=colour)
    axes[-1].set_xlabel("frequency, Hz")
    figure.suptitle(title)
    return figure


def third_octave_picture(
    centres: ArrayLike, levels: Mapping[str, ArrayLike], title: str = "",
    excitation_end: float | Mapping[str, float] | None = None,
) -> "Figure":  # fmt: skip
    """Draw third-octave levels (dB) as bars side by side; ``excitation_end`` as in `spectrum_picture`."""
    figure, ax = single((10.0, 4.5))
    bands = np.arange(len(np.asarray(centres)))
    width = 0.8 / len(levels)
    top = max(float(np.max(np.asarray(values))) for values in levels.values())
    for k, (name, style) in enumerate(_styles(levels).items()):
        values = sounding(levels[name])
        height = np.maximum(values - (top - RANGE), 0.0)
        hatch = _HATCHES[k // len(OTHERS) % len(_HATCHES)]
        ax.bar(bands + (k + 0.5) * width - 0.4, height, width, top - RANGE, color=style["color"],
               hatch=hatch, edgecolor="white", linewidth=0.0, label=_entry(name, values))  # fmt: skip
    ax.set_xlim(-0.6, len(bands) - 0.4)
    ends = list(_ends(excitation_end))
    # words lie in rows above all bars
    ax.set_ylim(top - RANGE, top - RANGE + RANGE / (1.0 - 0.02 - _ROW * max(1, len(ends))))
    for row, (whose, end) in enumerate(ends):
        mark_excitation(ax, end, band_place(centres, end), whose, 0.98 - _ROW * row)
    ax.set_xticks(bands[::3], [f"{nominal_frequency(f):g}" for f in np.asarray(centres)[::3]])
    label(ax, "third-octave band, Hz", "level, dB re 20 uPa", title)
    ax.legend(frameon=False)
    return figure


def order_picture(
    levels: OrderMap, kinematics: KinematicFrequencies | None = None, title: str = "",
    excitation_end: float | None = None,
) -> "Figure":  # fmt: skip
    """Draw an order map: colour is the level (dB), upright lines are the kinematic orders.

    ``excitation_end``: where the excitation ends (Hz), at the speed of ``kinematics``.
    """
    figure, ax = single((9.0, 5.5))
    rpm = levels.speed * 30.0 / math.pi
    _colour_map(figure, ax, levels.orders, rpm, levels.levels)
    if kinematics is not None:
        orders = KinematicFrequencies(*(f / kinematics.f_r for f in kinematics))
        _mark(ax, orders, float(levels.orders[-1]), "white")
        if excitation_end is not None:
            _end_line(ax, np.full(2, excitation_end / kinematics.f_r), rpm[[0, -1]])
    label(ax, "order (multiples of the shaft's turns)", "shaft speed, r/min", title, grid=False)
    return figure


def waterfall_picture(
    levels: Waterfall, title: str = "", excitation_order: float | None = None
) -> "Figure":  # fmt: skip
    """Draw spectra over time: colour is the level (dB).

    ``excitation_order``: where the excitation ends, in multiples of the shaft's turns
    (``recording.excitation_end / recording.kinematics().f_r``).
    """
    figure, ax = single((9.0, 5.5))
    _colour_map(figure, ax, levels.frequency, levels.time, levels.levels)
    if excitation_order is not None:
        _end_line(ax, excitation_order * np.abs(levels.speed) / (2.0 * math.pi), levels.time)
    label(ax, "frequency, Hz", "time, s", title, grid=False)
    return figure


def circle_picture(circles: Mapping[str, Round], title: str = "") -> "Figure":
    """Draw levels, in the unit of their weighting, round circles as seen from +X, with 12 o'clock on top."""
    figure = empty((6.5, 6.5))
    units = ", ".join(dict.fromkeys(each.unit for each in circles.values()))
    _polar(figure.add_subplot(projection="polar"), circles, "N", title, units)
    return figure


def planes_picture(planes: Mapping[str, Round], title: str = "") -> "Figure":
    """Draw levels in three planes in their unit, on one scale.

    0 deg is 12 o'clock in YZ and +X in the others.
    """
    figure = empty((13.0, 4.8))
    ends = _scale(planes)
    for k, (name, each) in enumerate(planes.items()):
        ax = figure.add_subplot(1, len(planes), k + 1, projection="polar")
        _polar(ax, {name: each}, "N" if name == "YZ" else "E", f"plane {name}, {each.unit}", ends=ends)
    figure.suptitle(title)
    return figure


def sweep_picture(sweep: Sweep, title: str = "") -> "Figure":
    """Draw largest level, DL and DV over the radial distance, one curve per axial distance."""
    figure = empty((13.0, 4.2))
    axes = figure.subplots(1, 3)
    unit = sweep.circles[0][0].unit
    for ax, (name, words) in zip(
        axes, (("highest", f"largest level, {unit}"), ("dl", "DL"), ("dv", "DV, dB")), strict=True
    ):
        for k, x in enumerate(sweep.axials):
            values = [getattr(row[k].directivity, name) for row in sweep.circles]
            ax.plot(1e3 * sweep.radii, values, marker="o", **series(k), label=f"l = {1e3 * x:g} mm")
        label(ax, "r, mm", words, "")
    axes[0].legend(frameon=False)
    figure.suptitle(title)
    return figure


def power_picture(motion: MotionPower, measured: Mapping[str, float], title: str = "") -> "Figure":
    """Draw power levels (dB) of the bodies' motion, and, by name, those measured by pressure."""
    figure, ax = single((8.0, 4.2))
    levels = {f"motion, {_words(name)}": value for name, value in motion.levels.items()} | dict(measured)
    low = max(levels.values()) - RANGE
    ax.barh(list(levels), [max(value - low, 0.0) for value in levels.values()], left=low, color="#0072B2")
    label(ax, "sound power level, dB re 1 pW", "", title)
    return figure


def band_place(centres: ArrayLike, frequency: float) -> float:
    """Return where a frequency (Hz) lies among third octaves by number, whole in their middles."""
    return 10.0 * math.log10(frequency / float(np.asarray(centres)[0]))


def _ends(given: float | Mapping[str, float] | None) -> list[tuple[str, float]]:
    """Return what to say behind the words, and each end of the excitation (Hz)."""
    if given is None:
        return []
    if not isinstance(given, Mapping):
        return [("", given)]
    # one line and one text where several end at the same frequency
    return [
        (" of " + " and ".join(name for name, its in given.items() if its == end), end)
        for end in dict.fromkeys(given.values())
    ]


def _words(name: str) -> str:
    """Name of a component in words; other names, such as microphones' names, stay as they are."""
    return name.replace("_", " ") if name in COLOURS else name


def _entry(name: str, values: NDArray[np.float64]) -> str:
    """Return the legend's entry: a name in words, with a dash where the curve has no level."""
    return f"{_words(name)}: -" if np.isnan(values).all() else _words(name)


def _styles(names: Mapping[str, object]) -> dict[str, dict[str, Any]]:
    """Return colour, dashes and width of each name: components keep their colours, others may coincide."""
    return {
        name: {"color": COLOURS[name], "linewidth": 1.4 if name == "total" else 0.8}
        if name in COLOURS
        else coincident(k, len(names))
        for k, name in enumerate(names)
    }


def _mark(ax: "Axes", kinematics: KinematicFrequencies, highest: float, colour: str = "black") -> None:
    """Upright lines at the kinematic frequencies and their harmonics, named on top."""
    left, right = ax.get_xlim()
    for k, (name, base) in enumerate(zip(kinematics._fields, kinematics, strict=True)):
        last = -math.inf
        for n in range(1, _HARMONICS + 1):
            if n * base > highest:
                break
            ax.axvline(n * base, color=colour, linewidth=0.5, linestyle=":", alpha=0.6)
            words = f"${name[0]}_{name[2]}$" if n == 1 else f"${n}{name[0]}_{name[2]}$"
            # five heights, so that neighbours do not hide each other; on one height they need room
            if n * base - last < _NAME_ROOM * (right - left):
                continue
            last = n * base
            height = 0.98 - 0.035 * k
            room = 0.5 * _NAME_ROOM * (right - left)
            side = "left" if n * base < left + room else "right" if n * base > right - room else "center"
            ax.text(
                n * base,
                height,
                words,
                fontsize=7,
                ha=side,
                va="top",
                color=colour,
                gid="mark",
                transform=ax.get_xaxis_transform(),
            )


def _mark_defects(ax: "Axes", defects: Sequence[DefectLine], highest: float) -> None:
    """Upright lines at what passes each local defect and its multiples, with an entry of the legend."""
    for k, line in enumerate(defects):
        for n in range(1, _HARMONICS + 1):
            if 0.0 < n * line.frequency <= highest:
                ax.axvline(
                    n * line.frequency, color=OTHERS[-1 - k % len(OTHERS)], linewidth=0.8,
                    linestyle="--", gid="defect", label=f"{line.defect}, {line.name}" if n == 1 else None,
                )  # fmt: skip


def _end_line(ax: "Axes", place: NDArray[np.float64], along: NDArray[np.float64]) -> None:
    """Draw the end of the excitation into a map, whose limits stay."""
    limits = ax.get_xlim()
    ax.plot(place, along, "w--", linewidth=1.0, gid="excitation-end", label="end of the excitation")
    ax.set_xlim(limits)
    if place.min() < limits[1]:
        ax.legend(frameon=False, labelcolor="white", loc="upper right")


def _colour_map(
    figure: "Figure", ax: "Axes", x: NDArray[np.float64], y: NDArray[np.float64], levels: NDArray[np.float64]
) -> None:
    order, shown, top = mapped(y, levels)
    drawn = ax.pcolormesh(
        x, y[order], shown, vmin=top - RANGE, vmax=top, cmap="magma", shading="nearest",
        rasterized=True,
    )  # fmt: skip
    figure.colorbar(drawn, ax=ax, label="level, dB re 20 uPa")


def _scale(circles: Mapping[str, Round]) -> tuple[float, float]:
    """Return the ends of a radial axis (dB) for levels round circles."""
    levels = np.concatenate([each.levels for each in circles.values()])
    return radial_range(float(levels.min()), float(levels.max()))


def _polar(
    ax: "Axes", circles: Mapping[str, Round], zero: str, title: str, unit: str = "",
    ends: tuple[float, float] | None = None,
) -> None:  # fmt: skip
    """Levels round a circle; the largest one's direction is marked. ``ends``: of the radial axis."""
    for k, (name, each) in enumerate(circles.items()):
        colour = OTHERS[k % len(OTHERS)]
        marker = "o" if len(each.levels) <= 36 else ""
        ax.plot(closed(each.angles), closed(each.levels), **series(k), marker=marker, markersize=3,
                label=name)  # fmt: skip
        ax.plot([each.directivity.da], [each.directivity.highest], color=colour, marker="*", markersize=10)
    # seen from +X, positive rotation runs anticlockwise: as polar axes do
    ax.set_theta_zero_location(zero)  # type: ignore[attr-defined]
    ax.set_ylim(*(ends or _scale(circles)))
    ax.set_title(", ".join(filter(None, (title, unit))))
    if len(circles) > 1:
        ax.legend(frameon=False, loc="lower right", bbox_to_anchor=(1.1, -0.05))
