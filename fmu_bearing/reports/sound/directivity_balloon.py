"""Directivity: level over all directions at one distance, in bands, turned by hand and in three planes."""

import math
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.directivity import circle_points
from fmu_bearing.acoustics.filters.weighting import a_weighting_db, level
from fmu_bearing.recording.channels.sources import centre_of
from fmu_bearing.reports.data.microphones import Microphones
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import DECIBELS, Absent, Block, Chart, Choice, Option, Section, small
from fmu_bearing.results.levels import radial_range
from fmu_bearing.results.picture_parts import closed

_LATITUDES, _AROUND = 31, 36  # every 6 and 10 deg, so that the three planes are among the points
_CIRCLE = 72
_RESOLUTION = 20.0  # Hz
_RANGE = 30.0  # dB below the loudest direction that the balloon's radius shows
_PLACE = 1.0 / 1024.0  # of the largest radius: a third of a pixel
_OCTAVES = (125.0, 250.0, 500.0, 1000.0, 2000.0, 4000.0, 8000.0)
_PLANES = {"YZ, bearing plane": "x", "XY, horizontal": "y", "XZ, upright": "z"}  # and the colour of each

Rows = dict[str, NDArray[np.float64]]  # levels (dB) round a circle, by name


@dataclass(frozen=True)
class Sphere:
    """Directions of a sphere about the axis, and levels there.

    Attributes
    ----------
    polar, azimuth : ndarray
        Angles (rad) from +X, shape (latitudes,), and from 12 o'clock about +X, shape (around,).
    levels : dict of ndarray, shape (latitudes, around)
        In dB, by name of the band.
    """

    polar: NDArray[np.float64]
    azimuth: NDArray[np.float64]
    levels: dict[str, NDArray[np.float64]]

    def directions(self) -> NDArray[np.float64]:
        """Return unit vectors (x, y, z), shape (latitudes, around, 3)."""
        a, b = np.meshgrid(self.polar, self.azimuth, indexing="ij")
        return np.stack([np.cos(a), -np.sin(a) * np.sin(b), np.sin(a) * np.cos(b)], axis=-1)


def _bands(frequency: NDArray[np.float64]) -> dict[str, NDArray[np.float64]]:
    """Weights of the bins for each band."""
    found = {"A-weighted": 10.0 ** (a_weighting_db(frequency) / 10.0), "unweighted": np.ones(len(frequency))}
    for centre in _OCTAVES:
        inside = (frequency >= centre / math.sqrt(2.0)) & (frequency < centre * math.sqrt(2.0))
        name = f"octave {centre:g} Hz" if centre < 1000.0 else f"octave {centre / 1e3:g} kHz"
        found[name] = inside.astype(float)
    return found


def _unit(band: str) -> str:
    return "dB(A)" if band == "A-weighted" else "dB"


def sphere(subject: Subject) -> Sphere:
    """Levels at the report's radius; `Absent` where the recording does not allow other places."""
    recording = subject.recording
    if not recording.history.size:
        raise Absent("only pressures were recorded: levels at other places need recorded channels")
    if subject.radiation_model == "paper":
        raise Absent("radiation model paper gives the same level in all directions")
    polar = np.linspace(0.0, math.pi, _LATITUDES)
    azimuth = 2.0 * math.pi * np.arange(_AROUND) / _AROUND
    bare = Sphere(polar, azimuth, {})
    points = subject.radius * bare.directions() + [centre_of(recording.scene), 0.0, 0.0]
    # one point at each end of the axis
    places = [points[0, 0], points[-1, 0], *points[1:-1].reshape(-1, 3)]
    try:
        frequency, squares = recording.mean_squares(places, subject.radiation_model, _resolution(subject))
    except ValueError as problem:
        raise Absent(str(problem)) from None
    levels = {}
    for name, weights in _bands(frequency).items():
        values = level(squares @ weights)
        whole = np.empty((_LATITUDES, _AROUND))
        whole[0], whole[-1] = values[0], values[1]
        whole[1:-1] = values[2:].reshape(_LATITUDES - 2, _AROUND)
        levels[name] = whole
    return Sphere(polar, azimuth, levels)


def _resolution(subject: Subject) -> float:
    return max(_RESOLUTION, 2.0 * subject.recording.rate / subject.recording.size)


def directivity(subject: Subject, microphones: Microphones | None) -> Section:
    """Balloon, three planes, and a circle through the first microphone."""
    levels = sphere(subject)
    blocks: list[Block] = [_balloon(subject, levels), _planes(subject, levels)]
    if microphones is not None and (chart := _circle(subject, microphones)) is not None:
        blocks.append(chart)
    return Section("directivity", "Directivity", blocks)


def _balloon(subject: Subject, levels: Sphere) -> Chart:
    figure = look.figure(
        height=560, margin={"l": 0, "r": 0, "t": 10, "b": 10}, showlegend=False, modebar=look.TOOLS_ABOVE
    )
    directions = levels.directions()
    closed = np.concatenate([directions, directions[:, :1]], axis=1)
    spots = _spots(levels)
    for k, (name, values) in enumerate(levels.levels.items()):
        whole = np.concatenate([values, values[:, :1]], axis=1)
        top = float(values.max())
        radius = np.maximum(whole - (top - _RANGE), 0.0) / _RANGE
        x, y, z = (radius * closed[..., axis] for axis in range(3))
        figure.add_surface(
            x=small(x, _PLACE), y=small(y, _PLACE), z=small(z, _PLACE), surfacecolor=small(whole, DECIBELS),
            cmin=max(top - _RANGE, float(values.min()) - 0.05),
            cmax=top, colorscale="Viridis", meta={"band": name}, visible=k == 0, customdata=spots,
            colorbar=look.bar(_unit(name), 0.75),
            hovertemplate="%{surfacecolor:.1f} " + _unit(name) + " at %{customdata[0]:.0f} deg from +X, "
            "%{customdata[1]:.0f} deg from 12 o'clock<extra></extra>",
            lighting={"ambient": 0.75, "diffuse": 0.5, "specular": 0.1}, showscale=True,
        )  # fmt: skip
    figure.add_scatter3d(
        x=[-1.15, 1.15], y=[0, 0], z=[0, 0], mode="lines+text", text=["-X", "+X, axis"], hoverinfo="skip",
        line={"color": look.colour("grey"), "width": 5}, textposition="top center",
    )  # fmt: skip
    axis = {"showticklabels": False, "range": [-1.2, 1.2], "showspikes": False}
    figure.update_layout(
        scene={
            "xaxis": axis | {"title": {"text": "X, axis"}}, "yaxis": axis | {"title": {"text": "Y"}},
            "zaxis": axis | {"title": {"text": "Z, up"}}, "aspectmode": "cube",
            "camera": {"eye": {"x": 1.25, "y": 1.15, "z": 0.75}},
        }
    )  # fmt: skip
    a = levels.levels["A-weighted"]
    return Chart(
        "balloon", f"Level over direction at {subject.radius:g} m", figure,
        f"Three-dimensional directivity at {subject.radius:g} m: levels from {a.min():.1f} to {a.max():.1f} "
        "dB(A).",
        (Choice("band", "Level", [Option(name, name) for name in levels.levels]),), solid=True,
        note=f"Drag to turn, scroll to zoom. Distance from the centre and colour both are the level; the "
        f"centre is "
        f"{_RANGE:g} dB below the loudest direction. {_LATITUDES * _AROUND - 2 * (_AROUND - 1)} "
        f"directions, radiation model {subject.radiation_model}, "
        f"{_resolution(subject):.3g} Hz blocks.",
    )  # fmt: skip


def _spots(levels: Sphere) -> NDArray[np.int16]:
    """Directions (deg) for the pointer: from +X, and from 12 o'clock, shape (latitudes, around + 1, 2)."""
    around = np.append(np.degrees(levels.azimuth), 0.0)
    both = np.stack(np.meshgrid(np.degrees(levels.polar), around, indexing="ij"), axis=-1)
    return np.round(both).astype(np.int16)


def _rounds(values: NDArray[np.float64]) -> Rows:
    """Levels round the three planes out of those on the sphere.

    In YZ from 12 o'clock with positive rotation, in the others from +X: towards +Y, and upwards.
    """
    quarter = _AROUND // 4
    yz = values[(_LATITUDES - 1) // 2]
    # azimuth 270 deg is +Y, 90 deg is -Y, 0 is up, 180 deg is down
    xy = np.concatenate([values[:, 3 * quarter], values[-2:0:-1, quarter]])
    xz = np.concatenate([values[:, 0], values[-2:0:-1, 2 * quarter]])
    return dict(zip(_PLANES, (yz, xy, xz), strict=True))


def _radial(band: str, rows: Rows) -> dict[str, Any]:
    """Return what a polar chart's radial axis shows: the range of a band's levels, and their unit."""
    levels = np.concatenate(list(rows.values()))
    ends = radial_range(float(levels.min()), float(levels.max()))
    return {"range": list(ends), "title": {"text": _unit(band)}}


def _polar(height: int, bands: dict[str, Rows]) -> tuple[Any, Choice]:
    """Return a polar chart of levels round circles by band and name, and the choice of the band."""
    figure, options = look.polar(height, _radial(*next(iter(bands.items())))), []
    for k, (band, rows) in enumerate(bands.items()):
        for name, row in rows.items():
            figure.add_scatterpolar(
                theta=small(np.linspace(0.0, 360.0, len(row) + 1)), r=small(closed(row), DECIBELS),
                mode="lines", name=name, meta={"band": band}, visible=k == 0, showlegend=bool(name),
                line={"color": look.colour(_PLANES.get(name, "outer_ring")), "width": 2},
                hovertemplate="%{theta:.0f} deg: %{r:.1f} " + _unit(band) + "<extra>" + name + "</extra>",
            )  # fmt: skip
        options.append(Option(band, band, {"polar.radialaxis": look.radial_axis(_radial(band, rows))}))
    return figure, Choice("band", "Level", options)


def _planes(subject: Subject, levels: Sphere) -> Chart:
    figure, choice = _polar(520, {band: _rounds(values) for band, values in levels.levels.items()})
    return Chart(
        "planes", f"Level in three planes at {subject.radius:g} m", figure,
        "Polar chart of the level in the bearing plane, the horizontal and the upright plane through the "
        "axis.",
        (choice,),
        note="YZ: from 12 o'clock with positive rotation, as seen from +X. XY: from +X towards +Y. XZ: "
        "from +X upwards.",
    )  # fmt: skip


def _circle(subject: Subject, microphones: Microphones) -> Chart | None:
    """Levels round the axis through the microphone farthest off it; none where all are on the axis."""
    places = [(math.hypot(y, z), x) for x, y, z in microphones.positions]
    radius, axial = max(places)
    if not radius > 1e-6:
        return None
    points = list(circle_points(radius, axial, _CIRCLE))
    frequency, squares = subject.recording.mean_squares(points, subject.radiation_model, _resolution(subject))
    bands = {name: {"": level(squares @ weights)} for name, weights in _bands(frequency).items()}
    figure, choice = _polar(480, bands)
    where = f"r = {1e3 * radius:g} mm, l = {1e3 * axial:g} mm"
    return Chart(
        "circle", f"Level round the axis at {where}", figure,
        f"Polar chart of the level on the circle about the axis with {where}.",
        (choice,),
        note=f"{_CIRCLE} places on the circle through the microphone farthest from the axis, 12 o'clock on "
        f"top, seen from +X.",
    )  # fmt: skip
