"""Loads and angles of the balls around the circle, and the figures derived from them."""

import itertools
import math
from collections.abc import Iterator

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.reports.data.curves import curve, curve_words
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Block, Chart, Choice, Option, Section, Table, Words, small
from fmu_bearing.results.balls import RACES, name_of
from fmu_bearing.results.picture_parts import closed

_BINS = 72  # of the circle
_WHAT = {"load": ("contact load", "N", 1.0), "angle": ("contact angle", "deg", 180.0 / math.pi)}
#: Variables of the table: name behind ``contact.<race>.``, words, factor, unit, which extreme counts.
_FIGURES = (
    ("load_mean", "mean load of a ball", 1.0, "N"),
    ("load_max", "largest load of a ball", 1.0, "N"),
    ("angle_mean", "mean contact angle", 180.0 / math.pi, "deg"),
    ("pressure_max", "largest contact pressure", 1e-9, "GPa"),
    ("shoulder_margin", "ellipse ends before the shoulder", 180.0 / math.pi, "deg"),
    ("spin_to_roll", "spin over roll", 1.0, ""),
    ("slip", "sliding over entrainment speed", 1.0, ""),
)
_FILM = ("film.lambda_min", "thinnest film over composite roughness")
_EMPTY = ["", "", ""]


def contacts(subject: Subject) -> Section:
    """Show loads and angles around the circle and ball by ball, of one bearing at a time."""
    first = next(iter(subject.prefixes.values()))
    subject.output(f"{first}contact.inner.load_mean")  # says what is missing
    blocks: list[Block] = []
    balls = _ball_count(subject, first)
    if balls:
        blocks += [_around(subject, balls), _ball_by_ball(subject, balls)]
    else:
        blocks.append(
            Words(
                "Single balls cannot be shown: this recording kept means and extremes over the "
                "balls only. "
                "Make the report from the scene to see each ball.",
                "absent",
            )
        )
        blocks.append(_over_time(subject))
    blocks += [_table(subject, number) for number in range(len(subject.prefixes))]
    return Section("contacts", "Contacts", blocks)


def _ball_count(subject: Subject, prefix: str) -> int:
    count = 0
    while subject.has(prefix + name_of(count + 1, "load", "inner")):
        count += 1
    return count


def _of_balls(subject: Subject, prefix: str, balls: int, what: str, race: str = "") -> NDArray[np.float64]:
    """Values of each ball of a bearing over time, shape (balls, points)."""
    return np.array([subject.output(prefix + name_of(j + 1, what, race)) for j in range(balls)])


def _each(subject: Subject) -> Iterator[tuple[str, str, dict[str, str], bool]]:
    """Yield prefix, what is shown, ``meta`` of its traces and whether it is shown at first."""
    for number, (words, prefix) in enumerate(subject.prefixes.items()):
        for what in _WHAT:
            yield prefix, what, {"what": what, "bearing": words}, number == 0 and what == "load"


def _whose(subject: Subject) -> Choice:
    return Choice("bearing", "Of", [Option(words, words) for words in subject.prefixes])


def by_place(
    azimuth: NDArray[np.float64], values: NDArray[np.float64], bins: int = _BINS
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Middles (rad) of equal parts of the circle, and mean, least and largest value there, shape (3, parts).

    Parts in which no ball was seen are left out.
    """
    part = np.minimum((azimuth.ravel() * bins / (2.0 * math.pi)).astype(int), bins - 1)
    flat = values.ravel()
    count = np.bincount(part, minlength=bins)
    seen = count > 0
    mean = np.bincount(part, flat, bins)[seen] / count[seen]
    low, high = np.full(bins, np.inf), np.full(bins, -np.inf)
    np.minimum.at(low, part, flat)
    np.maximum.at(high, part, flat)
    middles = (np.arange(bins) + 0.5) * 2.0 * math.pi / bins
    return middles[seen], np.array([mean, low[seen], high[seen]])


def _around(subject: Subject, balls: int) -> Chart:
    figure = look.polar(560)
    loads = []
    for prefix, what, meta, shown in _each(subject):
        azimuth = _of_balls(subject, prefix, balls, "azimuth")
        _, unit, factor = _WHAT[what]
        for race in RACES:
            values = factor * _of_balls(subject, prefix, balls, what, race)
            loads += [values] if what == "load" and race == "outer" else []
            middles, (mean, low, high) = by_place(azimuth, values)
            angle, tint = np.degrees(closed(middles)), look.colour(race)
            round_trip = np.concatenate([angle, angle[::-1]])
            band = np.concatenate([high, high[:1], low[:1], low[::-1]])
            figure.add_scatterpolar(
                theta=small(round_trip), r=small(band), mode="lines", line={"width": 0}, fill="toself",
                fillcolor=look.faint(race), hoverinfo="skip", showlegend=False, meta=meta, visible=shown,
            )  # fmt: skip
            figure.add_scatterpolar(
                theta=small(angle), r=small(closed(mean)), mode="lines",
                name=f"{race} race, mean", line={"color": tint, "width": 2}, meta=meta, visible=shown,
                hovertemplate=f"%{{theta:.0f}} deg: %{{r:.4g}} {unit}<extra>{race} race</extra>",
            )  # fmt: skip
            figure.add_scatterpolar(
                theta=small(np.degrees(azimuth[:, -1])), r=small(values[:, -1]),
                mode="markers+text" if race == "outer" else "markers",
                text=[str(j + 1) for j in range(balls)], textposition="top center", textfont={"size": 12},
                name=f"{race} race, balls at the end", marker={"color": tint, "size": 8}, meta=meta,
                visible=shown,
                hovertemplate=f"ball %{{text}}: %{{r:.4g}} {unit}<extra>{race} race</extra>",
            )  # fmt: skip
    figure.data = sorted(figure.data, key=lambda trace: trace.fill != "toself")  # bands behind all lines
    return Chart(
        "contacts-around",
        "Around the circle",
        figure,
        f"Polar chart of contact load and angle of {balls} balls over their place on the circle, inner and "
        f"outer race; "
        f"loads at the outer race run from {np.min(loads):.1f} to {np.max(loads):.1f} N.",
        (_whose(subject), _what_to_show()),
        note="Seen from +X, 12 o'clock on top, positive rotation anticlockwise. Line: mean of all balls "
        "that pass a place; "
        "band: smallest to largest; numbers: balls at the end of the recording. Elastic loads, without "
        "waviness of the "
        "races.",
    )


def _what_to_show() -> Choice:
    return Choice("what", "Show", [Option(words, what) for what, (words, _, _) in _WHAT.items()])


def _ball_by_ball(subject: Subject, balls: int) -> Chart:
    figure = look.figure(height=360, barmode="group")
    numbers = list(range(1, balls + 1))
    units = {what: f"{words}, {unit}" for what, (words, unit, _) in _WHAT.items()}
    for prefix, what, meta, shown in _each(subject):
        _, unit, factor = _WHAT[what]
        for race in RACES:
            values = factor * _of_balls(subject, prefix, balls, what, race)
            mean = values.mean(axis=1)
            figure.add_scatter(
                x=np.array(numbers) + (-0.12 if race == "inner" else 0.12), y=small(mean), mode="markers",
                name=f"{race} race", marker={"color": look.colour(race), "size": 9}, meta=meta,
                visible=shown, customdata=np.array(numbers),
                error_y={
                    "type": "data", "symmetric": False, "array": small(values.max(axis=1) - mean),
                    "arrayminus": small(mean - values.min(axis=1)), "color": look.colour(race),
                    "thickness": 1.4,
                },
                hovertemplate=f"ball %{{customdata}}: %{{y:.5g}} {unit}<extra>{race} race</extra>",
            )  # fmt: skip
    figure.update_layout(
        xaxis=look.axis("ball", tickmode="array", tickvals=numbers), yaxis=look.axis(units["load"])
    )
    options = [
        Option(words, what, {"yaxis.title.text": units[what], "yaxis.autorange": True})
        for what, (words, _, _) in _WHAT.items()
    ]
    return Chart(
        "contacts-balls",
        "Ball by ball",
        figure,
        f"Mean contact load and angle of each of {balls} balls at both races, with the range over time.",
        (_whose(subject), Choice("what", "Show", options)),
        note="Mean over the recording; bars reach from the smallest to the largest value.",
    )


def _over_time(subject: Subject) -> Chart:
    figure, first = look.figure(height=340), next(iter(subject.prefixes))
    for race, (what, dash), (words, prefix) in itertools.product(
        RACES, (("load_mean", "solid"), ("load_max", "dot")), subject.prefixes.items()
    ):
        if subject.has(f"{prefix}contact.{race}.{what}"):
            name = f"{race} race, {'mean' if what == 'load_mean' else 'largest'}"
            for part in curve(subject, subject.output(f"{prefix}contact.{race}.{what}"), name):
                line = {"color": look.colour(race), "width": 1.2, "dash": dash}
                figure.add_scatter(**part, line=line, meta={"bearing": words}, visible=words == first)
    figure.update_layout(
        xaxis=look.axis("time after initialisation, s"), yaxis=look.axis("load of a ball, N")
    )
    return Chart(
        "contacts-time",
        "Loads over time",
        figure,
        "Mean load of the balls at both races over time.",
        (_whose(subject),),
        note=curve_words(subject),
    )


def _table(subject: Subject, number: int) -> Table:
    words, prefix = list(subject.prefixes.items())[number]
    caption, rows = f"Contacts over the recording{words and ', '}{words}", []
    for name, words, factor, unit in _FIGURES:
        cells = []
        for race in RACES:
            if not subject.has(f"{prefix}contact.{race}.{name}"):
                break
            values = factor * subject.output(f"{prefix}contact.{race}.{name}")
            cells += [f"{values.mean():.4g}", f"{values.min():.4g}", f"{values.max():.4g}"]
        else:
            rows.append([words, unit, *cells])
    name, words = _FILM
    if subject.has(prefix + name):
        values = subject.output(prefix + name)
        shown = [f"{value:.4g}" for value in (values.mean(), values.min(), values.max())]
        rows.append([words, "", *shown, *_EMPTY])
    rows += [[*row, "", "", *_EMPTY] for row in _stiffness(subject, number)]
    columns = ["", "unit", *(f"{race}, {what}" for race in RACES for what in ("mean", "least", "largest"))]
    return Table(
        caption,
        columns,
        rows,
        note="Figures of the whole bearing are in the first three columns. Stiffness: perfect "
        "bearing at the mean speed, for frequency to 0, as `info` has it.",
        folded=number > 0,
    )


def _stiffness(subject: Subject, number: int) -> list[list[str]]:
    """Rows of the stiffness at rest: words, unit, value; none without scene or equilibrium."""
    try:
        stiffness = subject.point.bearings[number].stiffness
    except Absent:
        return []
    sizes = (("axial", stiffness[0, 0]), ("radial", 0.5 * (stiffness[1, 1] + stiffness[2, 2])))
    return [[f"{way} stiffness at rest", "N/um", f"{1e-6 * size:.4g}"] for way, size in sizes]
