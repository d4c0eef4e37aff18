"""Variables over time for charts: the last turns as they are, before them smallest and largest values."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import Choice, Option, small, thinned

SHOWN_TURNS = 10.0  # at first: one sees the shaft's turns
_WHOLE = 4000  # values up to which a curve stays as it is, and of its last turns at most
_BEFORE = 2000  # of what comes before them: two a column of pixels


def _split(subject: Subject) -> tuple[int, int]:
    """Where the last turns begin, and how many values before share their smallest and largest."""
    count = len(subject.time)
    if count <= _WHOLE:
        return 0, 1
    last = min(_WHOLE, SHOWN_TURNS * subject.turn / subject.step)
    span = -(-2 * (count - int(last)) // _BEFORE)
    return (count - int(last)) // span * span, span


def curve(subject: Subject, values: NDArray[np.float64], name: str) -> list[dict[str, Any]]:
    """Return one curve over time as parts of scatter traces: what comes before the last turns, then these.

    Both are one entry of the legend.
    """
    start, first = _split(subject)[0], float(subject.time[0])
    shared = {"mode": "lines", "name": name, "legendgroup": name}
    last = {"x0": first + start * subject.step, "dx": subject.step, "y": small(values[start:])}
    if start == 0:
        return [shared | last]
    few, span = thinned(values[:start], _BEFORE)
    before = {"x0": first, "dx": span * subject.step, "y": small(few), "showlegend": False}
    return [shared | before, shared | last]


def curve_words(subject: Subject) -> str:
    """Say which values `curve` keeps, for the note of a chart."""
    start, span = _split(subject)
    every = f"Every value, {1e6 * subject.step:.4g} us apart"
    if start == 0:
        return f"{every}."
    edge = float(subject.time[0]) + start * subject.step
    return (
        f"{every}, from {edge:.4g} s on. Before that, the smallest and the largest of each "
        f"{1e3 * span * subject.step:.3g} ms: peaks are exact, but a closer look there shows no more."
    )


def last_turns(subject: Subject) -> Choice:
    """Choose how much of the time is shown, in turns of the shaft; few at first."""
    first, last = float(subject.time[0]), float(subject.time[-1])
    spans = [("all", last - first)]
    spans += [(f"{n:g} turns", n * subject.turn) for n in (100.0, 30.0, SHOWN_TURNS, 3.0)]
    options = [
        Option(text, text, {"xaxis.range": [max(first, last - span), last], "yaxis.autorange": True})
        for text, span in spans
        if text == "all" or span < 0.9 * (last - first)
    ]
    # the first of the list is what is shown at first
    options.sort(key=lambda option: option.text != f"{SHOWN_TURNS:g} turns")
    return Choice("window", "Show the last", options)
