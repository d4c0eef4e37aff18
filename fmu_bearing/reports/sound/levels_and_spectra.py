"""Levels, spectra, third octaves, ranking of components and strongest lines."""

import math
from dataclasses import replace
from typing import Any

import numpy as np

from fmu_bearing.acoustics.analysis.lines import Line
from fmu_bearing.acoustics.analysis.third_octave import spread
from fmu_bearing.acoustics.filters.weighting import level as level_of
from fmu_bearing.recording.measurements.measure import BEYOND
from fmu_bearing.recording.measurements.pictures import band_place
from fmu_bearing.recording.measurements.tables import lines_table
from fmu_bearing.reports.data.microphones import Microphones
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import (
    DECIBELS,
    Block,
    Chart,
    Choice,
    Option,
    Section,
    Table,
    Words,
    small,
)
from fmu_bearing.reports.sections.kinematic_marks import END, end_words, mark_kinematics
from fmu_bearing.reports.sections.ring_motion import reach
from fmu_bearing.results.levels import RANGE, decibels
from fmu_bearing.results.picture_parts import free_heights

_UNSURE = 2.0  # dB of spread beyond which a third octave is more chance than level
_ROWS = 8  # microphones of which each has a row of bars
_WORDS = 0.12  # of the range of third octaves: a row of words
_ABOVE = 20.0  # dB above the highest line, for names
#: Pixels of the spectrum's axes on a page of the usual width, and of names in it.
_PLOT_WIDTH, _PLOT_HEIGHT = 800.0, 310.0
_LETTER, _LINE_HEIGHT, _LEAST_RISE = 6.5, 16.0, 8.0


def levels(subject: Subject, microphones: Microphones) -> Section:
    """Overall levels, the ranking of components, the strongest lines."""
    blocks: list[Block] = [_level_table(microphones)]
    if len(microphones.components) > 1:
        blocks.append(_ranking(microphones))
    else:
        blocks.append(Words("There are no components, because only pressures were recorded.", "absent"))
    if subject.several and subject.recording.history.size:
        blocks.append(_by_bearing(subject, microphones))
    total = len(subject.recording.microphones)
    if total > len(microphones.names):
        blocks.append(Words(f"The first {len(microphones.names)} of {total} microphones.", "note"))
    return Section("levels", "Levels and sources", blocks)


def spectra(subject: Subject, microphones: Microphones) -> Section:
    """Spectra, lines and third octaves."""
    blocks: list[Block] = [_spectrum(subject, microphones), _line_table(subject, microphones)]
    if subject.recording.size / microphones.rate >= 0.02:
        blocks.append(_third_octaves(microphones))
    return Section("spectra", "Spectra", blocks)


def _level_table(microphones: Microphones) -> Table:
    rows = []
    levels, names = microphones.levels, list(microphones.signals.pressures)
    for k, (name, place) in enumerate(zip(microphones.names, microphones.positions, strict=True)):
        where = ", ".join("?" if math.isnan(v) else f"{1e3 * v:.4g}" for v in place)
        cells = [decibels(levels["A"][c][k]) for c in names]
        rows.append([name, where, decibels(levels["Z"]["total"][k]), *cells])
    parts = [f"{look.words(c)}, dB(A)" for c in names[1:]]
    duration = microphones.subject.recording.size / microphones.rate
    return Table(
        "Equivalent levels re 20 uPa",
        ["microphone", "x, y, z, mm", "Leq, dB", "LAeq, dB(A)", *parts],
        rows,
        note=f"Over {duration:.3g} s. Pressures of components add with their phases, so their levels need "
        f"not sum to the total. A dash: silent.",
        folded=len(rows) > 8,
    )


def _by_bearing(subject: Subject, microphones: Microphones) -> Table:
    """Return the level of each bearing alone."""
    recording = subject.recording
    parts = recording.partial(microphones.positions, subject.radiation_model, by="bearing").values()
    levels = np.array([level_of(recording.mean_square(part, "A")) for part in parts])
    rows = [[name, *map(decibels, levels[:, k])] for k, name in enumerate(microphones.names)]
    heads = [f"bearing {number + 1}, dB(A)" for number in range(len(levels))]
    return Table(
        "Levels of each bearing alone", ["microphone", *heads], rows, folded=len(rows) > 8,
        note="Over the same time as the levels above. Pressures add with their phases. A dash: silent. What "
        "moves with several bearings, as a housing, counts for the first.",
    )  # fmt: skip


def _ranking(microphones: Microphones) -> Chart:
    names, count = microphones.components, len(microphones.names)
    upright = count > _ROWS  # a circle of microphones
    along, across = ("y", "x") if upright else ("x", "y")
    figure = look.figure(height=380 if upright else max(320, 90 + 44 * count))
    level = "LAeq, dB(A)"
    for weighting, unit in (("A", "dB(A)"), ("Z", "dB")):
        for name in names:
            figure.add_bar(
                **{along: small(microphones.levels[weighting][name]), across: microphones.names},
                orientation="v" if upright else "h", name=look.words(name),
                marker={"color": look.colour(name)}, meta={"weighting": weighting}, visible=weighting == "A",
                hovertemplate=f"%{{{across}}}: %{{{along}:.1f}} {unit}<extra>{look.words(name)}</extra>",
            )  # fmt: skip
    shown = np.array([microphones.levels[weighting][name] for weighting in "AZ" for name in names])
    low, highest = 10.0 * math.floor((float(shown.min()) - 5.0) / 10.0), float(shown.max())
    ends, which = [max(low, highest - 60.0), highest + 3.0], f"{along}axis"
    figure.update_layout(
        {which: look.axis(level, range=ends), f"{across}axis": look.axis("", type="category")},
        barmode="group", bargap=0.15 if upright else 0.25,
    )  # fmt: skip
    if not upright:
        figure.layout.yaxis.autorange = "reversed"
    loudest = _loudest(microphones)
    return Chart(
        "ranking", "Which component is loudest", figure,
        f"Bars of the level of each component at each microphone. Loudest component by A-weighted level: "
        f"{loudest}.",
        (Choice("weighting", "Weighting", [
            Option("A", "A", {f"{which}.title.text": level}),
            Option("none", "Z", {f"{which}.title.text": "Leq, dB"}),
        ]),),
        note=f"Loudest component, A-weighted: {loudest}. The outer ring includes what moves with it.",
    )  # fmt: skip


def _loudest(microphones: Microphones) -> str:
    """Loudest component at each microphone, in words; once where it is the same at all."""
    parts = microphones.components[1:]
    first = [
        look.words(max(parts, key=lambda name: microphones.levels["A"][name][k]))
        for k in range(len(microphones.names))
    ]
    if len(first) > 1 and len(set(first)) == 1:
        return f"the {first[0]} at all {len(first)} microphones"
    return ", ".join(f"{mic}: {part}" for mic, part in zip(microphones.names, first, strict=True))


def _microphone_choice(microphones: Microphones) -> Choice:
    order = sorted(
        range(len(microphones.shown)), key=lambda k: -microphones.levels["A"]["total"][microphones.shown[k]]
    )
    return Choice(
        "mic", "Microphone", [Option(microphones.names[microphones.shown[k]], str(k)) for k in order]
    )


def _spectrum(subject: Subject, microphones: Microphones) -> Chart:
    figure = look.figure(height=470)
    choice = _named(microphones, _microphone_choice(microphones))
    first = choice.options[0].value
    top = -math.inf
    frequency, levels = microphones.spectra
    keep = (frequency >= 20.0) & (frequency <= 20_000.0)
    # the total is drawn first, below the others
    for name, rows in levels.items():
        for k, values in enumerate(rows):
            top = max(top, float(values[keep].max()))
            figure.add_scatter(
                x0=float(frequency[keep][0]), dx=float(frequency[1] - frequency[0]),
                y=small(values[keep], DECIBELS), mode="lines",
                name=look.words(name), meta={"mic": str(k), "component": name},
                visible=str(k) == first,
                line={"color": look.colour(name), "width": 2.4 if name == "total" else 1.1},
                hovertemplate="%{x:.0f} Hz: %{y:.1f} dB<extra>" + look.words(name) + "</extra>",
            )  # fmt: skip
    mark_kinematics(figure, subject)
    figure.update_layout(
        xaxis=look.axis("frequency, Hz", range=[0.0, microphones.reach]),
        yaxis=look.axis("level, dB re 20 uPa", range=[top - RANGE, top + _ABOVE]),
        annotations=choice.options[0].layout["annotations"],
        meta={"narrow": {"annotations": []}},  # no room: the table has them
    )
    return Chart(
        "spectrum", "Spectrum, whole and by component", figure,
        f"Levels over frequency at {', '.join(microphones.names[k] for k in microphones.shown)}, of all "
        f"components together and of each.",
        (choice, reach(microphones.reach)),
        note=f"{frequency[1]:.3g} Hz between lines, flat-top window: a line's level is right "
        f"within 0.1 dB. Dotted: "
        "kinematic frequencies, as cage and balls turned, and harmonics to the fifth; click a legend entry "
        "to show or hide. The strongest lines are named as far as there is room, one that nothing explains "
        "by the nearest kinematic line with a question mark and its distance." + end_words(subject),
    )  # fmt: skip


def _named(microphones: Microphones, choice: Choice) -> Choice:
    """Return the choice of a microphone with the names of its strongest lines at their peaks."""
    frequency, levels = microphones.spectra
    total = levels["total"]
    top = float(total[:, (frequency >= 20.0) & (frequency <= 20_000.0)].max())
    options = [
        replace(option, layout={"annotations": _labels(microphones.lines[int(option.value)], top)})
        for option in choice.options
    ]
    return replace(choice, options=options)


def _labels(lines: list[Line], top: float) -> list[dict[str, Any]]:
    """Return names above peaks, the strongest first, of which none covers another.

    They are placed for the chart at its usual width, with 20 kHz linear and logarithmic; closer up there is
    more room.
    """
    named = [line for line in lines if line.explanation and 20.0 < line.frequency < 20_000.0]
    scale = _PLOT_HEIGHT / (RANGE + _ABOVE)
    places = [
        (_PLOT_WIDTH * line.frequency / 20e3, _PLOT_WIDTH * math.log(line.frequency / 20.0) / math.log(1e3))
        for line in named
    ]
    base = [_PLOT_HEIGHT - scale * (top + _ABOVE - line.level) + _LEAST_RISE for line in named]
    widths = [_LETTER * len(line.explanation) + _LETTER for line in named]
    heights = free_heights(places, base, widths, _LINE_HEIGHT, _PLOT_HEIGHT)
    return [
        {
            "x": line.frequency, "y": line.level, "text": line.explanation, "font": {"size": 11},
            "ax": 0, "ay": low - _LEAST_RISE - height, "arrowhead": 0, "arrowwidth": 0.8, "yanchor": "bottom",
            "arrowcolor": look.colour("grey"), "bgcolor": look.BEHIND, "borderpad": 1,
        }
        for line, low, height in zip(named, base, heights, strict=True)
        if height is not None
    ]  # fmt: skip


def _line_table(subject: Subject, microphones: Microphones) -> Table:
    place = max(
        range(len(microphones.shown)), key=lambda k: microphones.levels["A"]["total"][microphones.shown[k]]
    )
    frequency, levels = microphones.spectra
    lines = microphones.lines[place]
    columns, rows = lines_table(lines)
    end = subject.recording.excitation_end
    for row, line in zip(rows, lines, strict=True):
        at = int(np.argmin(np.abs(frequency - line.frequency)))
        parts = {name: levels[name][place, at] for name in microphones.components[1:]}
        beyond = end is not None and line.frequency > end
        loudest = look.words(max(parts, key=lambda name: parts[name])) if parts else ""
        row.append(BEYOND if beyond else loudest)
    return Table(
        f"Strongest lines at {microphones.names[microphones.shown[place]]}",
        [*columns, "loudest component"],
        rows,
        note="Explained by the simplest harmonic or sideband of f_r, f_c, f_b, f_i, f_o, or of the cage's "
        "whirl f_w, that fits; a sum of many is named with how many fit as well. Where none fits, the "
        "nearest is named with its distance.",
    )


def _third_octaves(microphones: Microphones) -> Chart:
    bands, levels = microphones.third_octaves
    figure = look.figure(height=400, barmode="group", bargap=0.12)
    names = [f"{band:g}" for band in bands]
    choice = _microphone_choice(microphones)
    top = max(float(values.max()) for values in levels.values())
    low = top - RANGE
    for name, values in levels.items():
        for k, row in enumerate(values):
            figure.add_bar(
                x=names, y=small(np.maximum(row - low, 0.0)), base=low, name=look.words(name),
                marker={"color": look.colour(name)}, meta={"mic": str(k), "component": name},
                visible=str(k) == choice.options[0].value, customdata=small(row),
                hovertemplate="%{x} Hz: %{customdata:.1f} dB<extra>" + look.words(name) + "</extra>",
            )  # fmt: skip
    figure.update_layout(
        xaxis=look.axis("third-octave band, Hz", type="category", tickangle=-45),
        # a row of words has room above the bars
        yaxis=look.axis("level, dB re 20 uPa", range=[low, top + _WORDS * (top - low)]),
    )
    end = microphones.subject.recording.excitation_end
    if end is not None and (place := band_place(bands, end)) < len(names) - 0.5:
        figure.add_vline(
            place, line={"color": look.colour("grey"), "width": 1.8, "dash": "dash"},
            annotation={"text": f"{END}, {1e-3 * end:.3g} kHz", "font": {"size": 11}},
            annotation_position="top left" if place > 0.5 * len(names) else "top right",
        )  # fmt: skip
    deviations = spread(np.array(bands), microphones.third_octave_time)
    unsure = [band for band, deviation in zip(bands, deviations, strict=True) if deviation > _UNSURE]
    chance = (
        f" In {microphones.third_octave_time:.3g} s the bands up to {unsure[-1]:g} Hz scatter by more than "
        f"{_UNSURE:g} dB if they hold "
        "noise: record longer if they matter."
        if unsure
        else ""
    )
    return Chart(
        "third-octaves", "Third octaves", figure,
        "Third-octave levels at the chosen microphone, of all components together and of each.",
        (choice,), note="IEC 61260-1, class 1." + end_words(microphones.subject) + chance,
    )  # fmt: skip
