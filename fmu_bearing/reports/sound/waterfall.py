"""Waterfall: levels over frequency and time, or over shaft speed in a run-up."""

import math

import numpy as np
import scipy
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.order import Waterfall, waterfall
from fmu_bearing.acoustics.filters.weighting import a_weighting_sections, level
from fmu_bearing.engine.constants import RPM
from fmu_bearing.reports.data.microphones import Microphones, at_microphones
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Block, Chart, Section, Words, small
from fmu_bearing.reports.sections.kinematic_marks import END
from fmu_bearing.results.levels import RANGE, mapped

_STEP = 1.0 / 16.0  # dB: of the colours
_ROWS = 160  # at most
_LINES = ("f_r", "f_c", "f_i", "f_o")


def fall(microphones: Microphones, run_up: Subject | None = None) -> Section:
    """Waterfall of a run-up, or, without one, of the recording over time."""
    blocks: list[Block] = []
    if run_up is None:
        blocks.append(_map(microphones, microphones.reach, over_speed=False))
        blocks.append(
            Words(
                "The speed is steady, so lines keep their frequency; changes over time are beating and "
                "chance. Ask for a run-up to see resonances: fmu-bearing report ... --run-up 5000:30000.",
                "note",
            )
        )
        return Section("waterfall", "Waterfall", blocks)
    other = at_microphones(run_up)
    blocks += [_map(other, microphones.reach, over_speed=True), _over_speed(other)]
    blocks.append(
        Words(
            f"A run of its own: {run_up.source}. Ramps this fast smear high orders; slower ones show more.",
            "note",
        )
    )
    return Section("waterfall", "Run-up", blocks)


def _microphone(microphones: Microphones) -> tuple[str, NDArray[np.float64]]:
    """Name and pressure (Pa) of the loudest microphone."""
    return microphones.names[microphones.loudest], microphones.pressure[microphones.loudest]


def _waterfall(microphones: Microphones, highest: float) -> Waterfall:
    recording = microphones.subject.recording
    duration = recording.size / recording.rate
    resolution = max(20.0, 8.0 / duration)
    if resolution * duration < 8.0 - 1e-9 or recording.size < 512:
        raise Absent(f"the recording of {duration:.3g} s is too short")
    _, pressure = _microphone(microphones)
    overlap = (
        max(0.0, min(0.75, 1.0 - resolution * duration / _ROWS))
        if resolution * duration * 4.0 > _ROWS
        else 0.75
    )
    return waterfall(pressure, recording.angle, recording.rate, highest, resolution, overlap)


def _map(microphones: Microphones, highest: float, over_speed: bool) -> Chart:
    """Return the levels up to ``highest`` (Hz), over speed or time."""
    blocks = _waterfall(microphones, highest)
    name, _ = _microphone(microphones)
    start = microphones.subject.recording.start
    y = blocks.speed / RPM if over_speed else blocks.time + start
    order, levels, top = mapped(y, blocks.levels)
    figure = look.figure(height=520, modebar=look.TOOLS_ABOVE)
    unit = "r/min" if over_speed else "s"
    figure.add_heatmap(
        x0=float(blocks.frequency[0]), dx=float(blocks.frequency[1] - blocks.frequency[0]), y=small(y[order]),
        z=small(levels, _STEP), zmin=top - RANGE, zmax=top,
        zsmooth=False, colorscale="Magma", colorbar=look.bar("dB"),
        hovertemplate="%{x:.0f} Hz, %{y:.5g} " + unit + ": %{z:.1f} dB<extra></extra>",
    )  # fmt: skip
    if over_speed:
        _order_lines(figure, microphones.subject, y[order], highest)
    recording = microphones.subject.recording
    if recording.excitation_end is not None:
        ends = recording.excitation_end * blocks.speed[order] / float(np.mean(recording.speed))
        figure.add_scatter(
            x=small(np.where(ends < highest, ends, np.nan)), y=small(y[order]), mode="lines", name=END,
            line={"color": "#FFFFFF", "width": 1.5, "dash": "dash"}, showlegend=False,
            hovertemplate=END + "<extra></extra>",
        )  # fmt: skip
    figure.update_layout(
        xaxis=look.axis("frequency, Hz", range=[0.0, highest], constrain="domain"),
        yaxis=look.axis(
            "shaft speed, r/min" if over_speed else "time after initialisation, s",
            range=[float(y.min()), float(y.max())],
        ),
    )
    title = f"Level over frequency and {'shaft speed' if over_speed else 'time'} at {name}"
    return Chart(
        "waterfall", title, figure, title + ", in dB re 20 uPa, as colours.",
        note=f"Blocks of {1e3 / blocks.frequency[1]:.3g} ms, {blocks.frequency[1]:.3g} Hz between lines, "
        f"flat-top window."
        + (" Dotted: kinematic frequencies." if over_speed else "")
        + " Dashed: end of the excitation, where it lies within the picture. Levels below the scale are "
        "drawn at its lower end.",
    )  # fmt: skip


def _order_lines(figure, subject: Subject, rpm: NDArray[np.float64], highest: float) -> None:
    """Kinematic frequencies rise with speed: one line each."""
    if subject.recording.scene is None:
        return
    ends = np.array([rpm[0], rpm[-1]])
    for whose, base in subject.recording.kinematics_by_name(speed=RPM).items():  # at 1 r/min
        for name in _LINES:
            words = f"{name} of {whose}" if whose and name != "f_r" else name
            figure.add_scatter(
                x=small(getattr(base, name) * ends), y=small(ends), mode="lines", name=words,
                line={"color": "#FFFFFF", "width": 1, "dash": "dot"}, showlegend=False,
                hovertemplate=words + "<extra></extra>",
            )  # fmt: skip
            inside = getattr(base, name) * ends[1] < highest
            figure.add_annotation(
                x=float(getattr(base, name) * ends[1]) if inside else highest, y=float(ends[1]), text=words,
                showarrow=False, yanchor="bottom", font={"size": 12},
            )  # fmt: skip


def _over_speed(microphones: Microphones) -> Chart:
    """A-weighted level of each microphone over speed."""
    recording = microphones.subject.recording
    figure = look.figure(height=340)
    span = max(64, recording.size // 80)
    blocks = recording.size // span
    rpm = recording.speed[: blocks * span].reshape(blocks, span).mean(axis=1) / RPM
    for place, k in enumerate(microphones.shown):
        weighted = _weighted(microphones, k)[: blocks * span].reshape(blocks, span)
        figure.add_scatter(
            x=small(rpm), y=small(level(np.mean(weighted**2, axis=1))), mode="lines",
            name=microphones.names[k],
            line=look.microphone(place, len(microphones.shown)),
            hovertemplate="%{x:.0f} r/min: %{y:.1f} dB(A)<extra>" + microphones.names[k] + "</extra>",
        )  # fmt: skip
    figure.update_layout(
        xaxis=look.axis("shaft speed, r/min"), yaxis=look.axis("level, dB(A)"), showlegend=True
    )
    return Chart(
        "run-up-levels", "Level over shaft speed", figure, "A-weighted level over shaft speed, one curve "
        "per microphone.",
        note=f"Over {1e3 * span / recording.rate:.3g} ms at each point.",
    )  # fmt: skip


def _weighted(microphones: Microphones, k: int) -> NDArray[np.float64]:
    return np.asarray(scipy.signal.sosfilt(a_weighting_sections(microphones.rate), microphones.pressure[k]))


def ramp(first: float, last: float, duration: float, settle: float):
    """Return a shaft speed (rad/s) over time that rises evenly between two over ``duration`` (s)."""

    def speed(time: float) -> float:
        share = min(max((time - settle) / duration, 0.0), 1.0)
        return first + (last - first) * share

    assert math.isfinite(first) and math.isfinite(last)
    return speed
