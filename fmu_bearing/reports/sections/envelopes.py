"""Envelope spectra: how often a band of accelerations or pressures swells, with the lines of the bearing."""

from collections.abc import Sequence

from fmu_bearing.recording.measurements.envelope import Envelope, envelope_of
from fmu_bearing.recording.measurements.envelope_files import lines_table, usual_signals
from fmu_bearing.recording.measurements.envelope_lines import FAR
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Block, Chart, Choice, Option, Section, Table, Words, small
from fmu_bearing.reports.sections.kinematic_marks import mark_kinematics

_MOST = 8  # signals: of more bearings the first
_NAMED = 8  # lines of a signal whose names have room


def envelopes(subject: Subject) -> Section:
    """Return the envelope spectra of the usual signals, loudest first, and their lines.

    Raises
    ------
    Absent
        Where the recording has no such signal, or its speed changes.
    """
    recording = subject.recording
    try:
        names = usual_signals(recording)
        found = [envelope_of(recording, name, None, subject.radiation_model) for name in names[:_MOST]]
    except ValueError as problem:
        raise Absent(str(problem)) from None
    found.sort(key=_standing, reverse=True)
    blocks: list[Block] = [_chart(subject, found), *map(_table, found)]
    if len(names) > len(found):
        blocks.append(Words(f"The first {len(found)} of {len(names)} signals.", "note"))
    return Section("envelope", "Envelope", blocks)


def _standing(found: Envelope) -> float:
    """How far the farthest line is over the median, dB; 0 where there is none."""
    return max((line.over_median for line in found.far()), default=0.0)


def _chart(subject: Subject, found: Sequence[Envelope]) -> Chart:
    figure = look.figure(height=430)
    end = max(one.shown_to for one in found)
    for k, one in enumerate(found):
        shown, lines = one.frequency <= end, one.far()[:_NAMED]
        traces = (
            {"x0": float(one.frequency[0]), "dx": float(one.frequency[1] - one.frequency[0]),
             "y": small(100.0 * one.amplitude[shown] / one.mean), "mode": "lines",
             "line": {"color": look.colour("total"), "width": 1.2}, "name": "squared envelope"},
            {"x": small([line.found for line in lines]), "y": small([100.0 * line.depth for line in lines]),
             "text": [line.name for line in lines], "textposition": "top center", "mode": "markers+text",
             "marker": {"color": look.colour("outer_ring"), "size": 6}, "name": "lines of the bearing"},
        )  # fmt: skip
        for trace in traces:
            figure.add_scatter(
                **trace, meta={"signal": str(k)}, visible=k == 0,
                hovertemplate="%{x:.1f} Hz: %{y:.3g} %<extra>" + one.heading + "</extra>",
            )  # fmt: skip
    mark_kinematics(figure, subject, end)
    tops = [1.15 * 100.0 * float(one.amplitude[one.frequency <= end].max()) / one.mean for one in found]
    figure.update_layout(
        xaxis=look.axis("frequency, Hz", range=[0.0, end]),
        yaxis=look.axis("squared envelope, % of its mean", range=[0.0, tops[0]]),
    )
    options = [
        Option(one.heading, str(k), {"yaxis.range": [0.0, top]})
        for k, (one, top) in enumerate(zip(found, tops, strict=True))
    ]
    return Chart(
        "envelope", "Spectrum of the squared envelope", figure,
        f"How often the bands swell: {'; '.join(one.heading for one in found)}.",
        (Choice("signal", "Signal and band", options),),
        note=f"{found[0].resolution:.3g} Hz is the resolution, Hann window. The band is the one in which a "
        "kurtogram finds most strokes. A defect is a line at the passing of the balls, f_o, f_i or 2 f_b, "
        "with side bands; waves of the surfaces make lines at the same places, so that a line is no finding "
        "until it exceeds that of a sound bearing.",
    )  # fmt: skip


def _table(found: Envelope) -> Table:
    columns, rows = lines_table(found)
    words = (
        f"Lines {FAR:g} dB over the median about them" if rows else f"No line is {FAR:g} dB over the median"
    )
    return Table(
        f"{words}: {found.heading}", columns, rows, folded=True,
        note=f"Rms of the band {found.rms:.3g} {found.unit}, kurtosis {found.kurtosis:.2f} (noise: 3).",
    )  # fmt: skip
