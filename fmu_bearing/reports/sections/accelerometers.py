"""What the accelerometers of a scene read: figures over the recording, and spectra."""

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import amplitude_spectrum
from fmu_bearing.recording.measurements.measure import fine
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Block, Chart, Choice, Option, Section, Table, small
from fmu_bearing.reports.sections.kinematic_marks import end_words, mark_kinematics

_LOWEST, _HIGHEST = 20.0, 20_000.0  # Hz
_DECADES = 5.0  # of a spectrum


def accelerometers(subject: Subject) -> Section:
    """Rms, peak, kurtosis and spectrum of each accelerometer."""
    recording = subject.recording
    names = recording.accelerometers
    if not names:
        raise Absent("the recording was made without its accelerometers: make the report from the scene")
    signals = recording.acceleration()
    blocks: list[Block] = [_figures(subject, signals), _spectra(subject, signals)]
    return Section("accelerometers", "Accelerometers", blocks)


def _figures(subject: Subject, signals: NDArray[np.float64]) -> Table:
    rows = []
    for sensor, signal in zip(subject.scene.accelerometers, signals, strict=True):
        rest = signal - signal.mean()
        variance = float(np.mean(rest**2))
        kurtosis = f"{np.mean(rest**4) / variance**2:.3g}" if variance > 0.0 else "-"
        body = sensor.on if sensor.bearing is None else f"{sensor.on} {sensor.bearing}"
        place = f"{body}, {sensor.angle_deg:g} deg, {sensor.direction}"
        rms, peak = np.sqrt(np.mean(signal**2)), np.abs(signal).max()
        rows.append([sensor.name, place, f"{rms:.3g}", f"{peak:.3g}", kurtosis])
    return Table(
        "Acceleration over the recording",
        ["accelerometer", "place", "rms, m/s2", "peak, m/s2", "kurtosis"],
        rows,
        note="Up to 20 kHz; the noise that the scene gives a sensor included. Kurtosis 3: normally "
        "distributed; impacts raise it.",
    )


def _spectra(subject: Subject, signals: NDArray[np.float64]) -> Chart:
    figure = look.figure(height=420)
    recording, names = subject.recording, subject.recording.accelerometers
    resolution, options = fine(recording), []
    for name, signal in zip(names, signals, strict=True):
        frequency, rms = amplitude_spectrum(signal, recording.rate, resolution)
        keep = (frequency > _LOWEST - 1e-3) & (frequency < _HIGHEST + 1e-3)
        frequency, rms = frequency[keep], rms[keep]
        figure.add_scatter(
            x0=float(frequency[0]), dx=float(frequency[1] - frequency[0]), y=small(rms), mode="lines",
            name=name, meta={"sensor": name}, visible=name == names[0],
            line={"color": look.colour("total"), "width": 1.2},
            hovertemplate="%{x:.0f} Hz: %{y:.3g} m/s2<extra>" + name + "</extra>",
        )  # fmt: skip
        decades = float(np.log10(rms.max())) if rms.max() > 0.0 else 0.0
        options.append(Option(name, name, {"yaxis.range": [decades - _DECADES, decades + 0.5]}))
    mark_kinematics(figure, subject)
    figure.update_layout(
        xaxis=look.axis("frequency, Hz", range=[0.0, _HIGHEST]),
        yaxis=look.axis(
            "rms acceleration, m/s2", type="log", dtick=1, exponentformat="power",
            range=options[0].layout["yaxis.range"],
        ),
    )  # fmt: skip
    return Chart(
        "acceleration-spectrum",
        "Acceleration over frequency",
        figure,
        f"Spectra of the acceleration at {', '.join(names)}, kinematic frequencies marked.",
        (Choice("sensor", "Accelerometer", options),),
        note=f"{resolution:.3g} Hz between lines, flat-top window: lines read true." + end_words(subject),
    )
