"""What to change: choices of a designer ranked by their effect on level, life and friction torque."""

import math
from dataclasses import replace
from typing import Any

from fmu_bearing.accuracy.changed import (
    LEAST,
    LEAST_DB,
    Change,
    Changes,
    shown_hours,
    shown_level,
    shown_ratio,
)
from fmu_bearing.accuracy.changes import changes
from fmu_bearing.progress import Tell
from fmu_bearing.recording.studies.spread import at_speed
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Block, Chart, Section, Table, Words

#: By figure: title of its chart, title of its axis, names of better and worse, how many sentences.
_SHOWN = {
    "level": ("Level", "change of the level, dB(A)", ("quieter", "louder"), 3),
    "life": ("Rating life", "life with the change over life without", ("longer", "shorter"), 2),
    "torque": ("Friction torque", "change of the friction torque, N mm", ("less", "more"), 2),
}
_BETTER, _WORSE = "inner", "outer"  # colours
_ROW, _AROUND = 40, 100  # px: a row with its text above the bar, and what surrounds the rows
_LIFTED = 15  # px of a text above the middle of its bar
_BENDS = "rings that bend need fidelity full, which takes about 40 s; --changes computes them"
_SEVERAL = "those of a set take about 10 s for each bearing; --changes computes them"
_MANY = 2.0  # ratio from which on a life is given as so many times as long


def section(subject: Subject, tell: Tell, levels: bool | None = None) -> Section:
    """Return the section; ``levels``: whether they are computed (None: of one bearing with rigid rings).

    Raises
    ------
    Absent
        Without a scene, at a speed that changes, or where the scene has no equilibrium.
    """
    try:
        scene = at_speed(subject.recording)
        wanted = levels if levels is not None else not (scene.bends or subject.several)
        study = changes(scene, levels=wanted, radiation_model=subject.radiation_model, tell=tell)
    except ValueError as problem:
        raise Absent(str(problem)) from None
    if levels is None and not wanted:
        study = replace(study, no_level=_BENDS if scene.bends else _SEVERAL)
    return shown(study)


def shown(study: Changes) -> Section:
    """Return the section of changes that were computed."""
    blocks: list[Block] = [Words(text) for text in (_opening(study), study.resonance()) if text]
    for figure in study.figures:
        blocks.append(_chart(study, figure))
        blocks += [Words(text) for text in _sentences(study, figure)]
    blocks.append(_table(study))
    blocks += [Words(text, "note") for text in study.remarks()]
    return Section("changes", "What to change", [_arrows(block) for block in blocks])


def _arrows(block: Block) -> Block:
    """Return a block of words with arrows that a page can show."""
    return Words(block.text.replace("->", "\u2192"), block.kind) if isinstance(block, Words) else block


def _words(change: Change) -> str:
    return change.choice.words.replace("->", "\u2192")


def _opening(study: Changes) -> str:
    return f"Each choice alone, against {study.unchanged()}. Effects of several choices need not add up."


def _sentences(study: Changes, figure: str) -> list[str]:
    """Return the best change of each topic, with its effect on the other figures."""
    title, _, _, count = _SHOWN[figure]
    gains = [each for each in study.ranked(figure) if each.acts(figure) and each.gain(figure) > 0.0]
    # one of each topic
    best = list({each.choice.topic: each for each in reversed(gains)}.values())
    best.sort(key=lambda each: -each.gain(figure))
    if not best:
        return [f"{title}: no choice makes it better."]
    return [_sentence(each, figure, study) for each in best[:count]]


def _sentence(change: Change, figure: str, study: Changes) -> str:
    others = [name for name in (*study.figures, "stiffness") if name != figure and change.acts(name)]
    gains = ", ".join(_phrase(change, name) for name in others if change.gain(name) > 0.0)
    losses = ", ".join(_phrase(change, name) for name in others if change.gain(name) < 0.0)
    text = f"{change.choice.words}: {_phrase(change, figure)}"
    if figure == "level":
        low, high = sorted(abs(value) for value in change.level_range)
        text += f" ({low:.1f} to {high:.1f} over {change.levels.size} seeds)"
    text += f"; {gains}" if gains else ""
    text += f"; but {losses}" if losses else ""
    return text[:1].upper() + text[1:] + "."


def _phrase(change: Change, figure: str) -> str:
    """Return the effect of a change on one figure, in words."""
    if figure == "level":
        return f"{abs(change.level):.1f} dB(A) {'quieter' if change.level < 0.0 else 'louder'}"
    ratio = change.ratio(figure)
    if figure == "life" and ratio >= _MANY:
        return f"life {float(f'{ratio:.2g}'):,.6g} times as long"
    name = "radial stiffness" if figure == "stiffness" else figure
    more, less = ("longer", "shorter") if figure == "life" else ("more", "less")
    return f"{name} {100.0 * abs(ratio - 1.0):.0f} % {more if ratio > 1.0 else less}"


def _value(change: Change, figure: str) -> float:
    """Return where the bar of a change ends: dB, decades of life, N mm."""
    if figure == "level":
        return change.level
    if figure == "life":
        return math.log10(change.ratio("life"))
    assert change.after is not None
    return change.after.torque - change.before.torque


def _label(change: Change, figure: str) -> str:
    words = _words(change)
    if figure == "level":
        low, high = change.level_range
        return f"{words}: {shown_level(change.level)} dB(A) ({shown_level(low)} to {shown_level(high)})"
    if figure == "life":
        assert change.after is not None
        return f"{words}: {shown_ratio(change.ratio('life'))} ({shown_hours(change.after.life)})"
    share = 100.0 * (change.ratio("torque") - 1.0)
    return f"{words}: {_value(change, figure):+.2f} N mm ({share:+.0f} %)"


def _chart(study: Changes, figure: str) -> Chart:
    """Bars of the changes that are findings, the best on top, each with its words above it."""
    title, axis, names, _ = _SHOWN[figure]
    rows = [each for each in study.ranked(figure) if each.acts(figure)]
    drawn = look.figure(
        height=_AROUND + _ROW * max(1, len(rows)),
        margin={"l": 14, "r": 14, "t": 34, "b": 52},
        barmode="overlay",
    )
    for name, tint, better in ((names[0], _BETTER, True), (names[1], _WORSE, False)):
        places = [k for k, each in enumerate(rows) if (each.gain(figure) > 0.0) == better]
        if places:
            drawn.add_bar(**_bars(figure, rows, places), name=name, marker={"color": look.colour(tint)})
    texts = [
        {
            "text": _label(each, figure), "x": 0.0, "xref": "paper", "xanchor": "left", "y": k,
            "yshift": _LIFTED, "showarrow": False, "font": {"size": 12},
        }
        for k, each in enumerate(rows)
    ]  # fmt: skip
    drawn.update_layout(
        annotations=texts,
        meta={"narrow": {"annotations": [text | {"font": {"size": 10}} for text in texts]}},
        xaxis=look.axis(axis, zeroline=True, **(_decades(rows) if figure == "life" else {})),
        yaxis={"visible": False, "range": [len(rows) - 0.4, -0.9], "fixedrange": True},
    )
    return Chart(
        f"changes-{figure}", f"{title}: what changes it", drawn,
        "Bars, the best change first. " + "; ".join(_label(each, figure) for each in rows) + ".",
        note=_note(study, figure),
    )  # fmt: skip


def _note(study: Changes, figure: str) -> str:
    """Return which changes have no bar, and why."""
    idle = [each for each in study.ranked(figure) if not each.acts(figure)]
    unsure = [each for each in idle if figure == "level" and each.depends_on_seed]
    parts = {
        "No finding, quieter with one seed and louder with another": unsure,
        f"No effect, below {LEAST_DB:g} dB"
        if figure == "level"
        else f"No effect, below {100.0 * LEAST:g} %": [each for each in idle if each not in unsure],
    }
    texts = ["Thin lines: range of the difference over the seeds."] if figure == "level" else []
    texts += [f"{why}: {'; '.join(_words(each) for each in some)}." for why, some in parts.items() if some]
    return " ".join(texts)


def _bars(figure: str, rows: list[Change], places: list[int]) -> dict[str, Any]:
    values = [_value(rows[k], figure) for k in places]
    bars: dict[str, Any] = {
        "x": values, "y": places, "orientation": "h", "width": 0.26,
        "customdata": [_label(rows[k], figure) for k in places],
        "hovertemplate": "%{customdata}<extra></extra>",
    }  # fmt: skip
    if figure == "level":
        ranges = [rows[k].level_range for k in places]
        bars["error_x"] = {
            "type": "data", "symmetric": False, "thickness": 1.4, "width": 3, "color": look.colour("grey"),
            "array": [high - value for (_, high), value in zip(ranges, values, strict=True)],
            "arrayminus": [value - low for (low, _), value in zip(ranges, values, strict=True)],
        }  # fmt: skip
    return bars


def _decades(rows: list[Change]) -> dict[str, Any]:
    """Return ticks at round ratios on an axis of their decades."""
    ends = [_value(each, "life") for each in rows] or [0.0]
    low, high = min(0.0, *ends), max(0.0, *ends)
    steps = (1.0,) if high - low > 2.0 else (1.0, 2.0, 5.0)
    ratios = [m * 10.0**k for k in range(math.floor(low), math.ceil(high) + 1) for m in steps]
    return {
        "tickvals": [math.log10(ratio) for ratio in ratios],
        "ticktext": [f"x{ratio:g}" for ratio in ratios],
    }


def _table(study: Changes) -> Table:
    columns, rows = study.table()
    head = {
        "dB(A)": "level, dB(A)", "over seeds": "range over seeds, dB(A)", "life": "life, h",
        "torque": "torque, N mm", "stiff.": "radial stiffness",
    }  # fmt: skip
    ranked = study.ranked(study.figures[0])
    for each, row in zip(ranked, rows, strict=True):
        assert each.after is not None
        row[0] = _words(each)
        if "life" in columns:
            row[columns.index("life")] = shown_hours(each.after.life).removesuffix(" h")
        if "over seeds" in columns:
            low, high = each.level_range
            row[columns.index("over seeds")] = f"{shown_level(low)} to {shown_level(high)}"
        if "torque" in columns:
            row[columns.index("torque")] = f"{each.after.torque:.2f}"
    return Table(
        "What each choice changes", [head.get(name, name) for name in columns], rows, note=study.conditions()
    )
