"""Motion of rings and cage: velocities over time and frequency, orbits of their centres."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import amplitude_spectrum, power_spectral_density
from fmu_bearing.engine.constants import RPM
from fmu_bearing.reports.data.curves import curve, curve_words, last_turns
from fmu_bearing.reports.data.microphones import ENDS
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Block, Chart, Choice, Option, Section, Table, Words, small
from fmu_bearing.reports.sections.kinematic_marks import end_words, mark_kinematics

AXES = ("x", "y", "z")
_AXIS_WORDS = {"x": "x, along the axis", "y": "y, horizontal", "z": "z, upwards"}
#: Frequency bands (Hz) in which ISO 15242-1 reads the vibration of bearings.
BANDS = ((50.0, 300.0), (300.0, 1800.0), (1800.0, 10_000.0))
_LOWEST, _HIGHEST = 20.0, 10_000.0  # Hz
_LONGEST_STEP = 45e-6  # s: what lies above 12 kHz, and would fold back to 10, hardly moves a ring
_CELLS = 160  # of an orbit's picture to either side: two pixels each
_IN_A_ROW = 3
_DECADES = 5.0  # of a spectrum
_ORBIT_TURNS = 5.0
_GREY = [[0.0, "rgba(127,127,127,0)"], [1.0 / 255.0, "rgba(127,127,127,0.2)"], [1.0, "rgba(127,127,127,0.9)"]]


def bodies_of(subject: Subject, motion: str = "velocity") -> list[str]:
    """Bodies whose velocity, or displacement, the recording holds, of a set those that move; as in names."""
    bodies = ["inner_ring", "outer_ring", "cage"]
    if subject.fidelity in ("rings", "response"):
        bodies.remove("cage")
    names = [prefix + body for prefix in subject.prefixes.values() for body in bodies]
    moving = [name for name in ("shaft.nose", "housing", *names) if subject.has(f"{name}.{motion}.x")]
    if not moving:
        subject.output(f"{names[0]}.{motion}.x")  # says what is missing
    if subject.several:  # outer rings in a housing at rest
        moving = [
            name for name in moving if any(np.ptp(subject.output(f"{name}.{motion}.{axis}")) for axis in AXES)
        ]
    if not moving:
        raise Absent("nothing moves")
    return moving


def velocities(subject: Subject) -> Section:
    """Velocities of ring and cage centres."""
    bodies = bodies_of(subject)
    blocks: list[Block] = [_over_time(subject, bodies), _rms_table(subject, bodies)]
    try:
        blocks += [_over_frequency(subject, bodies), _band_table(subject, bodies)]
    except Absent as reason:
        blocks.append(Words(f"No spectra of velocity: {reason}.", "absent"))
    return Section("velocities", "Velocities", blocks + _no_cage(subject, bodies))


def _no_cage(subject: Subject, bodies: list[str]) -> list[Block]:
    """Why the cage does not move here; nothing where it does."""
    if any(body.endswith("cage") for body in bodies):
        return []
    words = "The scene has no cage, or its motion was not kept."
    if subject.fidelity in ("rings", "response"):
        words = (
            f"With fidelity {subject.fidelity}, the cage turns with the balls, its centre does not move, and "
            "each ball sits where its contacts balance. Fidelity full computes the motion of cage and balls."
        )
    return [Words(words, "note")]


def _over_time(subject: Subject, bodies: list[str]) -> Chart:
    figure = look.figure(height=400)
    rpm = abs(subject.speed) / RPM
    for body in bodies:
        for axis in AXES:
            velocity = 1e3 * subject.output(f"{body}.velocity.{axis}")
            for part in curve(subject, velocity, _AXIS_WORDS[axis]):
                figure.add_scatter(
                    **part, meta={"body": body}, visible=body == bodies[0],
                    line={"color": look.colour(axis), "width": 1.2},
                    hovertemplate="%{x:.5f} s: %{y:.3f} mm/s<extra>" + axis + "</extra>",
                )  # fmt: skip
    window = last_turns(subject)
    figure.update_layout(
        xaxis=look.axis("time after initialisation, s", range=window.options[0].layout["xaxis.range"]),
        yaxis=look.axis("velocity, mm/s"),
    )
    return Chart(
        "velocity-time",
        "Velocity of the centres over time",
        figure,
        f"Curves of the velocity along three axes of {_listed(bodies)} over time, at {rpm:,.0f} r/min.",
        (Choice("body", "Body", [Option(look.words(body), body) for body in bodies]), window),
        note=f"Instantaneous values. {curve_words(subject)} Drag to zoom, double-click to see all.",
    )


def _rms_table(subject: Subject, bodies: list[str]) -> Table:
    rows = []
    for body in bodies:
        parts = [1e3 * subject.output(f"{body}.velocity.{axis}") for axis in AXES]
        rms = [float(np.std(part)) for part in parts]
        peak = max(float(np.max(np.abs(part - part.mean()))) for part in parts)
        whole = float(np.sqrt(np.sum(np.square(rms))))
        rows.append([look.words(body), *(f"{value:.4g}" for value in (*rms, whole, peak))])
    return Table(
        "Velocity of the centres about its mean, mm/s",
        ["body", "rms x", "rms y", "rms z", "rms, all axes", "largest of one axis"],
        rows,
        note="Over the whole recording, all frequencies.",
    )


def _sampled(subject: Subject) -> float:
    """Velocities per second; `Absent` where they are too few for spectra."""
    if subject.step > _LONGEST_STEP:
        raise Absent(
            f"variables were kept every {1e6 * subject.step:.4g} us, "
            f"spectra need {1e6 * _LONGEST_STEP:g} us or less"
        )
    return 1.0 / subject.step


def velocity_spectrum(
    subject: Subject, name: str, resolution: float
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Frequency (Hz) and rms velocity (m/s) of the lines of a variable, as far as it is sampled well."""
    frequency, rms = amplitude_spectrum(subject.output(name), _sampled(subject), resolution)
    keep = (frequency > _LOWEST - 1e-3) & (frequency < _HIGHEST + 1e-3)
    return frequency[keep], rms[keep]


def _finest(subject: Subject, wanted: float) -> float:
    """Spacing of lines (Hz) that the recording allows."""
    return max(wanted, 1.0 / (subject.step * len(subject.time)))


def _over_frequency(subject: Subject, bodies: list[str]) -> Chart:
    figure = look.figure(height=420)
    resolution = _finest(subject, 5.0)
    options = []
    for body in bodies:
        top = 0.0
        for axis in AXES:
            frequency, rms = velocity_spectrum(subject, f"{body}.velocity.{axis}", resolution)
            top = max(top, float(1e3 * rms.max()))
            figure.add_scatter(
                x0=float(frequency[0]), dx=float(frequency[1] - frequency[0]),
                y=small(1e3 * rms), mode="lines",
                name=_AXIS_WORDS[axis], meta={"body": body}, visible=body == bodies[0],
                line={"color": look.colour(axis), "width": 1.2},
                hovertemplate="%{x:.0f} Hz: %{y:.3g} mm/s<extra>" + axis + "</extra>",
            )  # fmt: skip
        decades = float(np.log10(top)) if top > 0.0 else 0.0
        options.append(Option(look.words(body), body, {"yaxis.range": [decades - _DECADES, decades + 0.5]}))
    mark_kinematics(figure, subject)
    figure.update_layout(
        xaxis=look.axis("frequency, Hz", range=[0.0, _HIGHEST]),
        yaxis=look.axis(
            "rms velocity, mm/s",
            type="log",
            dtick=1,
            exponentformat="power",
            range=options[0].layout["yaxis.range"],
        ),
    )
    return Chart(
        "velocity-spectrum",
        "Velocity of the centres over frequency",
        figure,
        f"Spectra of the velocity along three axes of {_listed(bodies)}, kinematic frequencies marked.",
        (Choice("body", "Body", options), reach(_HIGHEST, _HIGHEST)),
        note=f"Velocities read {1e-3 * _sampled(subject):.4g} thousand times a second; {resolution:.3g} Hz "
        "between lines, flat-top window: lines read true. Click a legend entry to show or hide it."
        + end_words(subject),
    )


def _band_table(subject: Subject, bodies: list[str]) -> Table:
    rows = []
    resolution = _finest(subject, 10.0)
    for body in bodies:
        for axis in AXES:
            values = subject.output(f"{body}.velocity.{axis}")
            frequency, density = power_spectral_density(values, _sampled(subject), resolution)
            cells = []
            for low, high in BANDS:
                inside = (frequency >= low) & (frequency < high)
                value = 1e6 * np.sqrt(np.sum(density[inside]) * frequency[1])
                cells.append(f"{value:.0f}" if value >= 1000.0 else f"{value:.3g}")
            rows.append([look.words(body), axis, *cells])
    return Table(
        "Rms velocity in three bands, um/s",
        ["body", "axis", *(f"{low:,.0f} to {high:,.0f} Hz" for low, high in BANDS)],
        rows,
        note="The bands of ISO 15242-1 (low, medium, high); speed and mounting here are the scene's, not "
        "the standard's.",
        folded=len(bodies) > 3,
    )


def orbits(subject: Subject) -> Section:
    """Orbits of the centres in the bearing plane, three in a row."""
    bodies = bodies_of(subject, "displacement")
    charts: list[Block] = [
        _orbits(subject, bodies[k : k + _IN_A_ROW], k) for k in range(0, len(bodies), _IN_A_ROW)
    ]
    return Section("orbits", "Orbits", charts + _no_cage(subject, bodies))


def _orbits(subject: Subject, bodies: list[str], first: int) -> Chart:
    """Draw orbits side by side; ``first``: number of the first one, from 0."""
    orbits: dict[str, list[NDArray[np.float64]]] = {}
    for body in bodies:
        both = [1e6 * subject.output(f"{body}.displacement.{axis}") for axis in "yz"]
        orbits[body] = [values - values.mean() for values in both]
    count = len(orbits)
    figure = look.figure(height=340, showlegend=False)
    turns = min(_ORBIT_TURNS, (subject.time[-1] - subject.time[0]) / subject.turn)
    last = max(2, round(turns * subject.turn / subject.step)) if np.isfinite(turns) else len(subject.time)
    narrow: dict[str, Any] = {"height": 360 * count}
    for k, (body, (y, z)) in enumerate(orbits.items()):
        number = "" if k == 0 else str(k + 1)
        reach = 1.08 * max(float(np.max(np.abs(y))), float(np.max(np.abs(z))), 1e-6)
        bins = np.linspace(0.0, 1.0, count * 100 + 1)
        begin, end = (
            bins[k * 100] + (0.07 if count > 1 else 0.25),
            bins[(k + 1) * 100] - (0.01 if count > 1 else 0.25),
        )
        figure.add_heatmap(
            **_places(y, z, reach), xaxis=f"x{number}", yaxis=f"y{number}", meta={"orbit": body},
            colorscale=_GREY, zmin=0, zmax=255, zsmooth=False, showscale=False, hoverinfo="skip",
        )  # fmt: skip
        figure.add_scatter(
            x=small(y[-last:]), y=small(z[-last:]), mode="lines", xaxis=f"x{number}", yaxis=f"y{number}",
            name=f"{look.words(body)}, last {turns:.3g} turns", meta={"orbit": body},
            line={"color": look.colour(body), "width": 1.6},
            hovertemplate="y %{x:.3f} um, z %{y:.3f} um<extra>" + look.words(body) + "</extra>",
        )  # fmt: skip
        # on a narrow page one above the other
        low = 1.0 - (k + 0.78) / count
        narrow |= {
            f"xaxis{number}.domain": [0.1, 0.95], f"yaxis{number}.domain": [low, 1.0 - (k + 0.06) / count],
            f"annotations.{k}.x": 0.5, f"annotations.{k}.y": 1.0 - (k + 0.05) / count,
        }  # fmt: skip
        figure.update_layout({
            f"xaxis{number}": look.axis(
                "y, um", domain=[begin, end], range=[-reach, reach], anchor=f"y{number}",
                constrain="domain",
            ),
            f"yaxis{number}": look.axis(
                "z, um" if k == 0 else "", range=[-reach, reach], anchor=f"x{number}",
                scaleanchor=f"x{number}", constrain="domain", constraintoward="top",
            ),
        })  # fmt: skip
        figure.add_annotation(
            text=look.words(body), x=0.5 * (begin + end), y=1.02, xref="paper", yref="paper", showarrow=False,
            xanchor="center", yanchor="bottom", font={"size": 14},
        )  # fmt: skip
    figure.layout.meta = {"narrow": narrow}
    return Chart(
        f"orbits-{first}" if first else "orbits",
        "Orbits of the centres in the bearing plane, about their mean",
        figure,
        "Paths of the centres of "
        + _listed(list(orbits))
        + " in the plane across the axis, in micrometres: "
        + "; ".join(f"{look.words(body)} {_extent(y, z)}" for body, (y, z) in orbits.items()),
        note=f"Seen from +X: y grows to the right, z upwards, positive rotation runs anticlockwise. Grey: "
        f"places of the whole recording in squares of 1/{_CELLS} of a picture, the more often, the darker; "
        f"in colour every value of its last {turns:.3g} turns. "
        + "; ".join(f"{look.words(body)}: {_extent(y, z)}" for body, (y, z) in orbits.items())
        + ".",
    )


def _places(y: NDArray[np.float64], z: NDArray[np.float64], reach: float) -> dict[str, Any]:
    """Return a heatmap of how often a centre was in each square: the logarithm, 0 to 255."""
    counts, _, _ = np.histogram2d(z, y, _CELLS, [[-reach, reach], [-reach, reach]])
    tones = np.log1p(counts)
    cell = 2.0 * reach / _CELLS
    middle = 0.5 * cell - reach
    shown = np.ceil(255.0 * tones / max(float(tones.max()), 1e-9)).astype(np.uint8)
    return {"x0": middle, "dx": cell, "y0": middle, "dy": cell, "z": shown}


def _extent(y: NDArray[np.float64], z: NDArray[np.float64]) -> str:
    return f"{np.ptp(y):.3g} by {np.ptp(z):.3g} um"


def _listed(bodies: list[str]) -> str:
    return ", ".join(look.words(body) for body in bodies)


def reach(first: float, highest: float = ENDS[-1]) -> Choice:
    """Choose how far a frequency axis goes: at first to ``first``, else to `ENDS` up to ``highest`` (Hz)."""
    linear = [
        Option(f"{f / 1e3:g} kHz", f"{f:g}", {"xaxis.type": "linear", "xaxis.range": [0.0, f]})
        for f in sorted(ENDS, key=lambda end: (end != first, end))
        if f <= highest
    ]
    whole = {"xaxis.type": "log", "xaxis.range": [float(np.log10(20.0)), float(np.log10(highest))]}
    words = f"{highest / 1e3:g} kHz, logarithmic"
    return Choice("reach", "Frequencies to", [*linear, Option(words, "log", whole)])
