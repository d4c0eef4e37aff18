"""Measurements on a recording: spectra by component, circles, planes, sweeps, sound power, run-ups.

Each function places its own microphones and evaluates the pressures with ``acoustics.analysis``. Functions
with ``resolution`` average over blocks of 1 / resolution s, which is fast at many places.

Examples
--------
>>> import numpy as np
>>> from fmu_bearing import measure
>>> time = np.arange(25600) / 51200.0
>>> centres, levels = measure.third_octave_levels(np.sin(2000.0 * np.pi * time), 51200.0)  # 1 Pa at 1 kHz
>>> round(float(centres[levels.argmax()])), round(float(levels.max()))  # Hz, dB re 20 uPa
(1000, 91)
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fmu_bearing.acoustics.analysis.directivity import (
    PLANES,
    Attenuation,
    Directivity,
    attenuation,
    circle_angles,
    circle_points,
    directivity,
    plane_points,
)
from fmu_bearing.acoustics.analysis.field import Blocks
from fmu_bearing.acoustics.analysis.lines import KinematicLine, Line, kinematic_lines, strongest_lines
from fmu_bearing.acoustics.analysis.order import OrderMap, order_map, order_spectrum, waterfall
from fmu_bearing.acoustics.analysis.power import (
    Power,
    dipoles,
    hemisphere_points,
    power_from_motion,
    power_from_pressure,
    power_level,
    sphere_points,
)
from fmu_bearing.acoustics.analysis.psychoacoustics import sensation
from fmu_bearing.acoustics.analysis.third_octave import third_octave_levels
from fmu_bearing.acoustics.filters.design import radiators_of
from fmu_bearing.acoustics.filters.weighting import REFERENCE_PRESSURE
from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.recording.channels.sources import air_of, bodies_of, centre_of
from fmu_bearing.recording.measurements.envelope import envelope, envelope_of
from fmu_bearing.recording.measurements.kurtogram import kurtogram
from fmu_bearing.recording.measurements.signals import signals_at
from fmu_bearing.results.defect_lines import marked
from fmu_bearing.scene import si

__all__ = [
    "MotionPower",
    "Round",
    "Sweep",
    "circle",
    "component_spectra",
    "directivity",
    "envelope",
    "envelope_of",
    "kurtogram",
    "motion_power",
    "order_spectrum",
    "planes",
    "run_up",
    "sensation",
    "sound_power",
    "strongest",
    "sweep",
    "third_octave_levels",
    "waterfall",
]

#: In place of a kinematic line's name, above the end of the excitation.
BEYOND = "beyond the excitation"
RESOLUTION = 20.0  # Hz, as in the multi-source paper's spectra
_FINE = 5.0  # Hz: separates neighbouring lines
#: Share of a frequency by which a line may miss the kinematic one: balls of a bearing spin as fast within
#: 0.03 % of their mean (steel 7010C at 18,000 r/min); and where only a contact angle is known, sliding.
_MEASURED, _SLIDING = 3e-4, 1.5e-3
_SAME, _WHIRLS = 2e-4, 1e-2  # by which rates, and whirls, of bearings may differ that share their lines


@dataclass(frozen=True)
class Round:
    """Levels (dB) at ``angles`` (rad) round a circle, shape (points,), their directivity and weighting."""

    angles: NDArray[np.float64]
    levels: NDArray[np.float64]
    directivity: Directivity
    weighting: str = "Z"

    @property
    def unit(self) -> str:
        """Unit of the levels: dB, or that with the weighting: dB(A)."""
        return "dB" if self.weighting == "Z" else f"dB({self.weighting})"


@dataclass(frozen=True)
class Sweep:
    """Circles over radial distance r and axial distance l.

    Attributes
    ----------
    radii, axials : ndarray
        In m.
    circles : tuple of tuple of Round
        ``circles[i][k]`` at ``radii[i]``, ``axials[k]``.
    over_r, over_l : tuple of Attenuation
        Fits of the largest level over r at each l, and over l at each r; empty with one distance only.
    """

    radii: NDArray[np.float64]
    axials: NDArray[np.float64]
    circles: tuple[tuple[Round, ...], ...]
    over_r: tuple[Attenuation, ...]
    over_l: tuple[Attenuation, ...]


@dataclass(frozen=True)
class MotionPower:
    """Power that the bodies' motion radiates, each taken as a compact dipole with its effective mass of air.

    Attributes
    ----------
    frequency : ndarray, shape (bins,)
        In Hz.
    watts : dict
        Power (W) in each bin by component, and of all together (``"total"``, coherent).
    levels : dict
        Over all bins, dB re 1 pW.
    """

    frequency: NDArray[np.float64]
    watts: dict[str, NDArray[np.float64]]
    levels: dict[str, float]


def component_spectra(
    recording: ChannelHistory,
    position: str | ArrayLike,
    resolution: float = RESOLUTION,
    radiation_model: str | None = None,
) -> tuple[NDArray[np.float64], dict[str, NDArray[np.float64]]]:
    """Frequencies (Hz) and levels (dB) at one place, in all (``"total"``) and by component.

    The place is in m, or the name of a microphone. A recording of pressures gives the total only.
    """
    frequency, spectra = signals_at(recording, [position], radiation_model).spectra(resolution)
    return frequency, {name: levels for name, (levels,) in spectra.items()}


def fine(recording: ChannelHistory) -> float:
    """Return the resolution (Hz) of a fine spectrum: 5 Hz, or what a shorter recording allows."""
    return max(_FINE, recording.rate / recording.size)


def known_lines(recording: ChannelHistory, highest: float) -> list[KinematicLine]:
    """Return the lines of the recording's bearings up to ``highest`` (Hz), as cages and balls turned.

    Bearings that turned as fast share their lines; else the name of a line says whose it is. Lines of local
    defects are named after them.
    """
    every, whirls = recording.bearing_kinematics(), recording.whirls()
    defects = recording.defect_lines()
    values, rounds = np.array(every), np.nan_to_num(whirls)
    same = (np.ptp(values, axis=0) <= _SAME * values.max(axis=0)).all()
    if same and np.ptp(rounds) <= _WHIRLS * rounds.max():
        return kinematic_lines(
            recording.kinematics(), highest, whirl=float(np.mean(whirls)), defects=marked(defects)
        )
    lines: dict[str, KinematicLine] = {}
    for number, (one, whirl) in enumerate(zip(every, whirls, strict=True), start=1):
        own = marked([defect for defect in defects if defect.bearing == number - 1])
        for line in kinematic_lines(one, highest, whirl=whirl, defects=own):
            shared = set(line.name.removesuffix("f_r")) <= set("0123456789 ")  # a multiple of f_r alone
            shared = shared or line.name.endswith(")")  # a defect's, which says whose it is
            name = line.name if shared else f"{line.name} of bearing {number}"
            lines[name] = replace(line, name=name)
    return sorted(lines.values(), key=lambda line: line.frequency)


def strongest(
    recording: ChannelHistory, frequency: NDArray[np.float64], levels: NDArray[np.float64], count: int = 12
) -> list[Line]:
    """Return the strongest lines of a spectrum of the recording and the kinematic line behind each.

    A fine spectrum, such as 5 Hz, separates neighbouring lines better than one of 20 Hz. A line above the
    end of the excitation comes from no surface of the scene, so that no kinematic line is named for it.
    """
    end = math.inf if recording.excitation_end is None else recording.excitation_end
    known = known_lines(recording, min(float(frequency[-1]), end))
    slip = _MEASURED if recording.turning_known else _SLIDING
    peaks = strongest_lines(frequency, levels, count, known, slip)
    return [Line(line.frequency, line.level, BEYOND) if line.frequency > end else line for line in peaks]


def circle(
    recording: ChannelHistory,
    radius: float,
    axial: float,
    count: int = 24,
    weighting: str = "Z",
    resolution: float | None = RESOLUTION,
    radiation_model: str | None = None,
) -> Round:
    """Levels at ``count`` places on a circle about the axis (m), the first at 12 o'clock."""
    angles = circle_angles(count)
    levels = recording.levels(
        list(circle_points(radius, axial, count)), radiation_model, weighting, resolution
    )
    return Round(angles, levels, directivity(angles, levels), weighting)


def planes(
    recording: ChannelHistory,
    radius: float,
    count: int = 360,
    weighting: str = "Z",
    resolution: float | None = RESOLUTION,
    radiation_model: str | None = None,
) -> dict[str, Round]:
    """Levels round the bearing centre at ``radius`` (m) in the planes YZ, XY and XZ, by plane.

    Of a set round the middle between its first and its last bearing.
    """
    angles = circle_angles(count)
    centre = np.array([centre_of(recording.scene), 0.0, 0.0])
    # all at once: planes through the axis meet the same circles about it
    points = [centre + point for plane in PLANES for point in plane_points(plane, radius, count)]
    together = recording.levels(points, radiation_model, weighting, resolution).reshape(len(PLANES), count)
    return {
        plane: Round(angles, levels, directivity(angles, levels), weighting)
        for plane, levels in zip(PLANES, together, strict=True)
    }


def sweep(
    recording: ChannelHistory,
    radii: Sequence[float],
    axials: Sequence[float],
    count: int = 24,
    weighting: str = "Z",
    resolution: float | None = RESOLUTION,
    radiation_model: str | None = None,
) -> Sweep:
    """Circles over radial and axial distances (m), with the attenuation along both.

    Attenuation is that of the largest level of each circle, over r at fixed l and over l at fixed r, in dB
    per doubling of that coordinate (the sound-field paper's sweeps).
    """
    circles = tuple(
        tuple(circle(recording, r, x, count, weighting, resolution, radiation_model) for x in axials)
        for r in radii
    )
    highest = np.array([[at.directivity.highest for at in row] for row in circles])
    r, x = np.asarray(radii, dtype=float), np.asarray(axials, dtype=float)
    over_r = tuple(attenuation(r, column) for column in highest.T) if len(r) > 1 else ()
    over_l = tuple(attenuation(np.abs(x), row) for row in highest) if len(x) > 1 and np.all(x != 0.0) else ()
    return Sweep(r, x, circles, over_r, over_l)


def sound_power(
    recording: ChannelHistory,
    radius: float = 1.0,
    plane: float | None = None,
    many: bool = False,
    weighting: str = "Z",
    resolution: float | None = RESOLUTION,
    radiation_model: str | None = None,
) -> Power:
    """Sound power by the measurement points of ISO 3744, corrections K1 = K2 = 0.

    Parameters
    ----------
    radius : float
        Of the measurement surface (m), about the bearing's centre, of a set the middle between its first and
        its last bearing. In the open a dipole's near field adds 1 + 1/(kr)^2: 0.2 dB at 250 Hz and 1 m.
    plane : float, optional
        Place along the axis (m) of a rigid plane behind the bearing (-X): the points are then on a
        hemisphere about the plane's centre. Its reflection is added as the pressures at the
        mirrored points. Without a plane the points are on a full sphere in a free field.
    many : bool
        With the standard's second set of points.

    Raises
    ------
    ValueError
        When the plane cuts the bearing or its housing, or a point lies inside a body.
    """
    if recording.scene is None or not recording.history.size:
        raise ValueError("sound power needs a recording with its scene and channels: fmu_bearing.record")
    air = air_of(recording.scene)
    if plane is None:
        points = sphere_points(radius, many) + np.array([centre_of(recording.scene), 0.0, 0.0])
        squares = _squares(recording.levels(list(points), radiation_model, weighting, resolution))
        return power_from_pressure(squares, radius, air)
    bearings = recording.scene.bearings()
    rear = bearings[0].position - 0.5 * si(bearings[0].scene.bearing).width
    for number, body in bodies_of(recording.scene):
        if body.housing is not None:
            one = bearings[number]
            rear = min(rear, one.position + one.sign * body.housing.centre - body.housing.length / 2)
    if plane > rear:
        raise ValueError(f"plane = {plane:g} m cuts the bearing: give at most {rear:g} m, its rear")
    points = hemisphere_points(radius, many) + np.array([plane, 0.0, 0.0])
    mirrored = points * np.array([-1.0, 1.0, 1.0]) + np.array([2.0 * plane, 0.0, 0.0])
    pressure = recording.pressure(list(points), radiation_model) + recording.pressure(
        list(mirrored), radiation_model
    )
    squares = recording.mean_square(pressure, weighting)
    return power_from_pressure(squares, radius, air, hemisphere=True)


def motion_power(
    recording: ChannelHistory, resolution: float = RESOLUTION, highest: float = 20_000.0
) -> MotionPower:
    """Sound power from surface velocity: bodies as compact dipoles with effective masses of air.

    This is an upper estimate, because it leaves out shielding between bodies, and their size, which lowers
    the radiation. It is valid up to ka of about 0.5 (ring d35: 1.5 kHz; housing d100 x 160: 0.5 kHz); a d100
    housing at 2.3 kHz reads 14 dB too high.

    Raises
    ------
    ValueError
        For a recording without channels of accelerations; for a set.
    """
    if recording.scene is not None and recording.scene.assembly.joined:
        raise ValueError(
            "power from motion takes all bodies as one compact source, and the bearings of a set are apart: "
            "use sound_power"
        )
    if recording.scene is None or not recording.history.size or recording.radiation_model.startswith("paper"):
        raise ValueError(
            "power from motion needs accelerations: record with a radiation model that is not a paper's"
        )
    blocks = Blocks(recording.channels, resolution)
    keep = blocks.frequency <= highest
    frequency = blocks.frequency[keep]
    radiators, air = radiators_of(recording.scene), air_of(recording.scene)
    weights = dipoles(radiators, recording.channels.shape[1])
    radius = {"balls": radiators.ball_diameter / 2}
    weights["total"] = sum(weights.values(), np.zeros_like(weights["balls"]))
    watts = {}
    for name, weight in weights.items():
        used = np.flatnonzero(weight.any(axis=0))
        strength = np.tensordot(weight[:, used], blocks.spectra[used][:, :, keep], 1)
        rms = np.sqrt((np.abs(strength) ** 2).sum(axis=1))
        watts[name] = power_from_motion(frequency, rms, air, radius.get(name, 0.0))
    levels = {name: float(power_level(values.sum())) for name, values in watts.items()}
    return MotionPower(frequency, watts, levels)


def run_up(
    recording: ChannelHistory,
    position: str | ArrayLike,
    highest: float = 40.0,
    resolution: float = 0.1,
    radiation_model: str | None = None,
) -> OrderMap:
    """Order map of the pressure at one place (m, or a microphone's name), up to order ``highest``."""
    pressure = recording.pressure([position], radiation_model)[0]
    return order_map(pressure, recording.angle, recording.rate, highest, resolution)


def _squares(levels: NDArray[np.float64]) -> NDArray[np.float64]:
    return REFERENCE_PRESSURE**2 * 10.0 ** (levels / 10.0)
