"""What is kept of a run: levels, lines and spectra, one function for each kind of case.

Results are numbers in mappings and lists, so that `medians.median` can join runs of neighbouring speeds, and
so that they can be kept as JSON.
"""

import math
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.signal import find_peaks

from examples.papers.case import Case
from examples.papers.hearing import Ear, Places, Sources, a_weighted, below, equivalent, line, spectrum
from fmu_bearing.acoustics.analysis.directivity import Directivity, directivity, plane_points
from fmu_bearing.acoustics.analysis.spectrum import power_spectral_density
from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.engine.layout import SD
from fmu_bearing.scene.sound import cylindrical

# Multi-source paper -------------------------------------------------------------------------------------

STEP, LAST = 20.0, 4000.0  # Hz, as the paper's figures 11 to 14
LINES = ("f_r", "2 f_r", "f_c", "f_b", "f_i", "f_o")
APART = (0.105, 0.150, 0.105, 0.0805)  # m, of P1 to P4 from the bearing's centre


def frequencies(ear: Ear) -> dict[str, float]:
    """Frequencies (Hz) of `LINES`, from the cage's mean speed in the recording."""
    recording = ear.recording
    ratio = float(np.mean(recording.outputs["cage.speed_ratio"][recording.output_time >= recording.start]))
    rolling = recording.kinematics()
    balls = recording.scene.bearing.ball_count
    f_r, f_c = rolling.f_r, ratio * rolling.f_r
    return {"f_r": f_r, "2 f_r": 2 * f_r, "f_c": f_c, "f_b": rolling.f_b, "f_i": balls * (f_r - f_c),
            "f_o": balls * f_c}  # fmt: skip


def spindle(ear: Ear, case: Case) -> dict[str, Any]:
    """Levels (dB) at the scene's four points by component; lines and spectra at the first of them."""
    recording = ear.recording
    sources = ear.sources(recording.positions)
    at = frequencies(ear)
    rate = recording.rate
    return {
        "levels": {name: equivalent(found).tolist() for name, found in sources.items()},
        "frequencies": at,
        "lines": {
            name: {key: line(found[:, 0], rate, f) for key, f in at.items()}
            for name, found in sources.items()
        },
        "spectra": {
            name: spectrum(found[:, 0], rate, STEP, LAST).round(2).tolist() for name, found in sources.items()
        },
    }


def directions(distance: float) -> Places:
    """Three places at one distance (m) in the directions of the axes.

    A vector's direction cosines towards them are 1 for one of its components each, so the sum of energies
    there is that of all components with all cosines 1.
    """
    return [(-distance, 0.0, 0.0), (0.0, distance, 0.0), (0.0, 0.0, distance)]


def sources_at(ear: Ear, distance: float) -> Sources:
    """Return each component's sources at a distance, shape (sources, 1, size), and ``total``."""
    if ear.radiation_model == "paper":
        return ear.sources([(0.0, distance, 0.0)])
    many = len(SD.KINDS)
    parts = ear.parts(directions(distance), lambda path: many * path.component + path.kind)
    found = {
        name: np.concatenate([part[:, None] for key, part in parts.items() if key // many == k])
        for k, name in enumerate(SD.COMPONENTS)
        if any(key // many == k for key in parts)
    }
    return found | {"total": np.concatenate(list(found.values()))}


def printed(ear: Ear, case: Case) -> dict[str, Any]:
    """Levels up to 4 kHz at the four distances by component, and lines at the first."""
    rate = ear.recording.rate
    at = frequencies(ear)
    levels: dict[str, list[float]] = {}
    lines: dict[str, dict[str, float]] = {}
    by_distance = {distance: sources_at(ear, distance) for distance in set(APART)}
    for distance in APART:
        for name, found in by_distance[distance].items():
            levels.setdefault(name, []).append(float(below(found, rate, LAST)[0]))
    for name, found in by_distance[APART[0]].items():
        lines[name] = {key: line(found[:, 0], rate, at[key]) for key in LINES}
    return {"levels": levels, "lines": lines, "frequencies": at}


# Sound-field paper --------------------------------------------------------------------------------------

RADII, PLACES = (30, 90, 150, 210, 270), (20, 50, 100, 150, 200)  # mm
R, L = 210, 50  # mm: the paper's circle
ANGLES = tuple(range(0, 360, 15))
WHOLE = 18000  # r/min, at which the paper speaks of the whole field
#: The paper's load zones (deg), and the whole circle.
ZONES: dict[str, tuple[int, int] | None] = {"whole": None, "impact": (0, 60), "friction": (180, 240)}


def circles(ear: Ear, case: Case) -> dict[str, Any]:
    """Levels (dB) round circles, shape (radii, places, 24), their figures, components on the paper's circle.

    The whole field at 18,000 r/min, of which the paper speaks; at other speeds its circle alone.
    """
    recording = ear.recording
    radii, places = (RADII, PLACES) if case.rpm == WHOLE else ((R,), (L,))
    # a housing has its front at -X; angles grow with the shaft's turn (the paper's eq. 10) on either side
    side = 1.0 if ear.scene.mounting.housing is None else -1.0
    grid = [cylindrical(a, r, side * x) for r in radii for x in places for a in ANGLES]
    field = ear.levels(grid).reshape(len(radii), len(places), len(ANGLES))
    own = ear.sources([cylindrical(a, R, side * L) for a in ANGLES])
    late = recording.output_time >= recording.start
    return {
        "field": field.round(3).tolist(),
        "parts": {name: equivalent(found).round(3).tolist() for name, found in own.items()},
        "cage_ratio": float(np.mean(recording.outputs["cage.speed_ratio"][late])),
    } | directivities(field)


def directivities(field: ArrayLike) -> dict[str, Any]:
    """DV, and SPLmax and DL of `ZONES`, of each circle of a field (dB) of shape (radii, places, 24).

    They are read from each run, since a median of circles is smoother than any of them.
    """
    levels = np.asarray(field, dtype=float)
    found = {
        name: [[_directivity(circle, zone) for circle in circles_of] for circles_of in levels]
        for name, zone in ZONES.items()
    }
    return {
        "dv": [[one.dv for one in row] for row in found["whole"]],
        "top": {name: [[one.highest for one in row] for row in rows] for name, rows in found.items()},
        "dl": {name: [[one.dl for one in row] for row in rows] for name, rows in found.items()},
    }


def _directivity(levels: NDArray[np.float64], zone: tuple[int, int] | None) -> Directivity:
    ends = None if zone is None else (math.radians(zone[0]), math.radians(zone[1]))
    return directivity(np.radians(ANGLES), levels, ends)


# Impact-noise paper -------------------------------------------------------------------------------------

ABOVE = (0.0, 0.0, 0.1)  # m
RADIUS = 0.1  # m, of the three planes
COUNT = 72  # points of a plane: every 5 degrees, the paper's are one degree apart
WINDOW = 5e-3  # s: the paper's whole history
BANDS = ((0.0, 5e3), (5e3, 1e4), (1e4, 2e4))  # Hz
#: The paper's planes (its Y is the bearing's axis, its X horizontal) and ours.
SIDES = {"XY": "XY", "YZ": "XZ", "XZ": "YZ"}
_SILENT = -106.0  # dB: the least level that is ever given


def histories(pressure: NDArray[np.float64], rate: float) -> NDArray[np.float64]:
    """Largest A-weighted pressure of each 5 ms history but the first (dB), shape (mics, histories)."""
    size = round(WINDOW * rate)
    count = pressure.shape[-1] // size
    cut = pressure[:, size : count * size].reshape(len(pressure), count - 1, size)
    return level((cut**2).max(axis=2))


def above(ear: Ear, case: Case) -> dict[str, Any]:
    """Levels (dB, dB(A)) 100 mm above the bearing by component."""
    rate = ear.recording.rate
    skip = round(WINDOW * rate)
    parts = {}
    for name, found in ear.sources([ABOVE]).items():
        pressure = found.sum(axis=0)
        weighted = a_weighted(pressure, rate)
        peaks, _ = find_peaks(np.abs(weighted[0, skip:]))
        parts[name] = {
            "largest_A": float(histories(weighted, rate)[0].mean()),
            "leq": float(level((pressure[:, skip:] ** 2).mean())),
            "leq_A": float(level((weighted[:, skip:] ** 2).mean())),
            "average_peak": float(level((np.abs(weighted[0, skip:])[peaks] ** 2).mean()))
            if len(peaks)
            else _SILENT,
            "bands": _bands(pressure[0], rate),
        }
    return {"above": parts}


def planes(ear: Ear, case: Case) -> dict[str, Any]:
    """Levels above the bearing, and largest A-weighted levels (dB(A)) round the three planes."""
    points = np.concatenate([plane_points(ours, RADIUS, COUNT) for ours in SIDES.values()])
    around = a_weighted(ear.pressure(points), ear.recording.rate)  # planes share circles: one call
    found = {}
    for k, name in enumerate(SIDES):
        largest = histories(around[k * COUNT : (k + 1) * COUNT], ear.recording.rate)
        found[name] = {
            "largest": largest.mean(axis=1).round(3).tolist(),
            "range": float(np.ptp(largest, axis=0).mean()),
            "maximum": float(largest.max(axis=0).mean()),
        }
    return above(ear, case) | {"planes": found}


def start(ear: Ear, case: Case) -> dict[str, Any]:
    """Largest A-weighted level (dB(A)) above the bearing in the first 5 ms, and mean of later histories."""
    rate = ear.recording.rate
    weighted = a_weighted(ear.pressure([ABOVE]), rate)
    first = weighted[0, : round(WINDOW * rate)]
    return {"first_A": float(level((first**2).max())), "later_A": float(histories(weighted, rate)[0].mean())}


def _bands(pressure: NDArray[np.float64], rate: float) -> list[float]:
    """Share of the unweighted energy in each of `BANDS`."""
    frequency, density = power_spectral_density(pressure, rate, 100.0)
    shares = [density[(frequency >= low) & (frequency < high)].sum() for low, high in BANDS]
    return [float(share / sum(shares)) for share in shares]
