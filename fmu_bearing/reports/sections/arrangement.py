"""The bearings on their shaft, without a run: what each carries, axial loads, preload over temperatures."""

import math

import numpy as np

from fmu_bearing.engine.layout import SP, U
from fmu_bearing.instance import EngineError
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import Absent, Chart, Section, Table
from fmu_bearing.reports.page.look import axis
from fmu_bearing.results.base import table
from fmu_bearing.scene import Scene, SceneError
from fmu_bearing.scene.member import set_of
from fmu_bearing.steady.rest import forces, nose, preloads, started
from fmu_bearing.steady.statics import BearingLoad

_STEPS = 13  # loads of the curve
_BEYOND = 1.2  # of the load that unloads a bearing: as far as the curve goes
_WARMER = (0.0, 5.0, 10.0, 15.0, 20.0)  # K


def arrangement(subject: Subject) -> Section:
    """Draw the shaft with its bearings, and list what each carries."""
    statics = subject.point.statics
    loads = Table(
        "What each bearing carries, in the axes of the shaft", *table(BearingLoad, statics.bearings),
        note="Ball load, contact angle and pressures are the largest of its balls.",
    )  # fmt: skip
    return Section("arrangement", "Arrangement", [_drawing(statics.scene), loads])


def _drawing(scene: Scene) -> Chart:
    """Shaft and bearings to scale, with the lines of contact."""
    spindle = set_of(scene)
    figure = look.figure(300, showlegend=False)
    start = 0.0
    for length, diameter, bore in spindle.shaft.sections_mm:
        for low, high in ((0.5 * bore, 0.5 * diameter), (-0.5 * diameter, -0.5 * bore)):
            figure.add_shape(
                type="rect", x0=start, x1=start + length, y0=low, y1=high, fillcolor="#C8CDD2",
                line={"color": "#7F7F7F", "width": 1}, layer="below",
            )  # fmt: skip
        start += length
    for one, bearing, centre in zip(spindle.bearing, scene.geometries, pressure_centres(scene), strict=True):
        inner, outer = 0.5 * bearing.bore_mm, 0.5 * bearing.outside_diameter_mm
        half, pitch = 0.5 * bearing.width_mm, 0.5 * bearing.pitch_diameter_mm
        slope = math.tan(bearing.nominal_angle)
        x = one.position_mm
        beyond = x + one.sign * (outer - pitch) * slope
        for side in (1.0, -1.0):
            figure.add_shape(
                type="rect", x0=x - half, x1=x + half, y0=side * inner, y1=side * outer,
                line={"color": "#7F7F7F", "width": 1},
            )  # fmt: skip
            figure.add_scatter(
                x=[centre, beyond], y=[0.0, side * outer], mode="lines", line={"color": look.colour("inner")},
                hoverinfo="skip",
            )  # fmt: skip
    places = [one.position_mm for one in spindle.bearing]
    labels = [f"bearing {k + 1}, carries {one.carries}" for k, one in enumerate(spindle.bearing)]
    pitches = [0.5 * bearing.pitch_diameter_mm for bearing in scene.geometries]
    for side in (1.0, -1.0):
        figure.add_scatter(
            x=places, y=[side * pitch for pitch in pitches], mode="markers", text=labels, hoverinfo="text",
            marker={"size": 9, "color": look.colour("balls")},
        )  # fmt: skip
    figure.update_xaxes(axis("from the nose, mm"))
    figure.update_yaxes(axis("mm", scaleanchor="x", scaleratio=1))
    words = f"{spindle.arrangement}: shaft and bearings to scale; lines of contact meet the axis"
    return Chart("arrangement", "Shaft, bearings, lines of contact", figure, words)


def pressure_centres(scene: Scene) -> list[float]:
    """Return where the lines of contact of each bearing of a set meet the shaft's axis, mm from the nose.

    With the nominal contact angle and pitch diameter, as makers give it.
    """
    return [
        one.position_mm - one.sign * 0.5 * bearing.pitch_diameter_mm * math.tan(bearing.nominal_angle)
        for one, bearing in zip(set_of(scene).bearing, scene.geometries, strict=True)
    ]


def axial(subject: Subject) -> Section:
    """Show how the bearings share an axial load alone, and how far the shaft goes.

    Raises
    ------
    Absent
        Where no load unloads a bearing.
    """
    statics = subject.point.statics
    if not statics.lift_off:
        raise Absent("no axial load unloads a bearing of this set")
    reach = [_BEYOND * one.load for one in statics.lift_off.values()]
    low, high = min(0.0, *reach), max(0.0, *reach)
    loads, shares, places = [], [], []
    signs = np.array([bearing.sign for bearing in statics.bearings])
    alone = dict.fromkeys(range(U.NOSE, U.NOSE + SP.PLANE), 0.0)
    for load in np.linspace(low, high, _STEPS):
        try:
            run = started(statics.scene, alone | {U.NOSE: float(load)})
        except EngineError:
            continue
        loads.append(load)
        shares.append(signs * forces(run)[:, 0])
        places.append(1e6 * nose(run)[0])
    figure = look.figure(380, modebar=look.TOOLS_ABOVE)
    for k, curve in enumerate(np.array(shares).T):
        figure.add_scatter(
            x=loads, y=curve, name=f"bearing {k + 1}", line=look.series(k),
        )  # fmt: skip
    figure.add_scatter(
        x=loads, y=places, name="nose, um", yaxis="y2", line={"color": "#7F7F7F", "dash": "dash"}
    )
    for one in statics.lift_off.values():
        figure.add_vline(x=one.load, line={"color": "#8C6D1F", "dash": "dot"})
    figure.update_xaxes(axis("axial load on the shaft, N"))
    figure.update_layout(
        yaxis=axis("axial load of a bearing, N"),
        yaxis2=axis("nose, um", overlaying="y", side="right", showgrid=False),
    )
    words = (
        "What each bearing carries over an axial load alone at the scene's speed and temperatures, and where "
        "the nose goes; dotted: the load that unloads a bearing at standstill"
    )
    chart = Chart("axial", "Axial load alone: shares and displacement", figure, words)
    return Section("axial", "Axial load", [chart])


def warmth(subject: Subject) -> Section:
    """Show how preload follows the temperature of inner rings, of the shaft, and of both.

    Raises
    ------
    Absent
        For a set without preload, and where it cannot be warmer.
    """
    statics = subject.point.statics
    if not statics.preloads:
        raise Absent("a set that carries one way has no preload")
    rings, shaft = _warm_keys(statics.scene)
    figure = look.figure(380)
    for name, keys, colour in (
        ("inner rings warmer", rings, "#D55E00"),
        ("shaft warmer", shaft, "#0072B2"),
        ("both", rings | shaft, "#000000"),
    ):
        curve = []
        for rise in _WARMER:
            changes = shaft | {key: value + rise for key, value in keys.items()}
            try:
                curve.append(preloads(started(statics.scene.replace(changes)))["running"][0])
            except (SceneError, EngineError) as problem:
                raise Absent(f"{name} by {rise:g} K: {problem}") from None
        figure.add_scatter(x=_WARMER, y=curve, name=name, line={"color": colour})
    figure.update_xaxes(axis("warmer than in the scene, K"))
    figure.update_yaxes(axis("preload of bearing 1 at speed, N", rangemode="tozero"))
    words = "Preload of the first bearing at speed, without load on the shaft, over temperatures"
    chart = Chart("warmth", "Preload over temperatures", figure, words)
    return Section("warmth", "Preload and warmth", [chart])


def _warm_keys(scene: Scene) -> tuple[dict[str, float], dict[str, float]]:
    """Return keys and values (degC) of what warms the inner rings, and the shaft."""
    spindle, warm = set_of(scene), scene.operation.inner_ring_temperature_degC
    rings = {"operation.inner_ring_temperature_degC": warm}
    for number, bearing in enumerate(spindle.bearing, start=1):
        if bearing.inner_ring_temperature_degC is not None:
            key = f"spindle.bearing[{number}].inner_ring_temperature_degC"
            rings[key] = bearing.inner_ring_temperature_degC
    own = spindle.shaft.temperature_degC
    return rings, {"spindle.shaft.temperature_degC": warm if own is None else own}
