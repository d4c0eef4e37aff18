"""Upright lines at the bearing's kinematic frequencies."""

from typing import Any

import numpy as np

from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, small

#: The field's other names.
OTHER_NAMES = {"f_r": "", "f_c": "FTF", "f_b": "BSF", "f_i": "BPFI", "f_o": "BPFO"}
HARMONICS = 5
END = "end of the excitation"
_COLOURS = {"f_r": "grey", "f_c": "cage", "f_b": "balls", "f_i": "inner_ring", "f_o": "outer_ring"}
_AT_FIRST = ("f_i", "f_o")


def mark_kinematics(figure: Any, subject: Subject, highest: float = 20_000.0) -> None:
    """Add the end of the excitation, and a trace of upright lines per kinematic frequency with harmonics.

    Nothing without a scene.
    """
    _mark_end(figure, subject.recording.excitation_end, highest)
    try:
        kinematics = subject.kinematics
    except Absent:
        return
    for whose, found in kinematics.items():
        for name, base in found._asdict().items():
            _mark(figure, name, base, whose, highest)
    for line in subject.recording.defect_lines():
        _mark(figure, line.name, line.frequency, line.defect, highest)
    figure.update_layout(
        yaxis9={"overlaying": "y", "range": [0.0, 1.0], "visible": False, "fixedrange": True}
    )


def _mark(figure: Any, name: str, base: float, whose: str, highest: float) -> None:
    """Add a trace of upright lines at the multiples of one frequency (Hz).

    ``whose``: of which bearing or local defect; those of a defect are shown at first.
    """
    multiples = [n for n in range(1, HARMONICS + 1) if 0.0 < n * base <= highest]
    if not multiples:
        return
    of_one = whose and f" of {whose}"
    carrier, defect = name.rpartition(" ")[2], whose.startswith("defect")
    x, y, text = [], [], []
    for n in multiples:
        words = f"{_times(n, name)}{of_one} = {n * base:.1f} Hz"
        x += [n * base, n * base, np.nan]
        y += [0.0, 1.0, np.nan]
        text += [words, words, ""]
    figure.add_scatter(
        x=small(x), y=small(y), text=text, mode="lines", yaxis="y9", name=label(name) + of_one,
        line={"color": look.colour(_COLOURS[carrier]), "width": 1, "dash": "dash" if defect else "dot"},
        hovertemplate="%{text}<extra></extra>",
        visible=True if defect or name in _AT_FIRST else "legendonly",
    )  # fmt: skip


def _times(n: int, name: str) -> str:
    """Name of n times a frequency: of ``2 f_b`` and n = 3 ``6 f_b``."""
    twice, _, carrier = name.rpartition(" ")
    count = n * int(twice or 1)
    return carrier if count == 1 else f"{count} {carrier}"


def _mark_end(figure: Any, end: float | None, highest: float) -> None:
    """Add an upright line at the end of the excitation (Hz) below ``highest``."""
    if end is None or end >= highest:
        return
    words = f"{END}, {1e-3 * end:.3g} kHz"
    figure.add_scatter(
        x=[end, end], y=[0.0, 1.0], mode="lines", yaxis="y9", name=words,
        line={"color": look.colour("grey"), "width": 1.8, "dash": "dash"},
        hovertemplate=f"{words}<extra></extra>",
    )  # fmt: skip


def end_words(subject: Subject) -> str:
    """Say where the excitation ends, for the note of a chart."""
    end = subject.recording.excitation_end
    if end is None:
        return ""
    return (
        f" The surfaces of this scene excite up to {1e-3 * end:.3g} kHz at this speed (dashed); levels above "
        "are too low, and their source is no finding: raise imperfections.highest_frequency_kHz for more."
    )


def label(name: str) -> str:
    """Both names of a kinematic frequency, or of twice one."""
    other = OTHER_NAMES.get(name, "")
    return f"{name} ({other})" if other else name
