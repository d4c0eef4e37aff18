"""The page about a set of bearings on one shaft: its statics, and a short run."""

import math
from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from fmu_bearing.design.heat import heat_table
from fmu_bearing.design.operating_point import RINGS, OperatingPoint, operating_point
from fmu_bearing.design.verdict import Verdict, overall, shown_hours
from fmu_bearing.design.verdicts import cautions, shared_label, side_by_side, verdicts
from fmu_bearing.engine.layout import SP
from fmu_bearing.instance import EngineError
from fmu_bearing.progress import Tell
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page import look
from fmu_bearing.reports.page.blocks import CUT, Absent, Block, Card, Chart, Section, Table
from fmu_bearing.reports.page.look import axis
from fmu_bearing.reports.page.render import render
from fmu_bearing.reports.sections.error_motion import error_motion
from fmu_bearing.reports.sections.friction import range_table
from fmu_bearing.reports.sections.seats import seats
from fmu_bearing.reports.sections.set_conditions import level_range, set_assumptions, set_conditions
from fmu_bearing.reports.sections.summary import Tile, tile
from fmu_bearing.reports.sections.verdict_table import overall_of
from fmu_bearing.reports.sound.set_sound import sound_of_set
from fmu_bearing.results.table import tenths
from fmu_bearing.scene import Scene, SceneError
from fmu_bearing.scene.member import set_of
from fmu_bearing.scene.origins import Origin
from fmu_bearing.steady.drawing import pressure_centres
from fmu_bearing.steady.rest import forces, nose, preloads, started
from fmu_bearing.steady.statics import Statics

_STEPS = 13  # loads of the curve
_BEYOND = 1.2  # of the load that unloads a bearing: as far as the curve goes
_WARMER = (0.0, 5.0, 10.0, 15.0, 20.0)  # K


@dataclass(frozen=True)
class SetPage:
    """A page about a set, as text, with its contents.

    Attributes
    ----------
    text : str
        HTML.
    sections : dict
        By key, why a section is missing; empty: it is there.
    figures : dict
        The figures at the top, by name.
    warnings : list of str
    verdict : str
        The gravest of all verdicts.
    """

    text: str
    sections: dict[str, str]
    figures: dict[str, float]
    warnings: list[str]
    verdict: str


def set_page(
    scene: Scene, title: str, tell: Tell, whence: Sequence[Origin], text: str, left: list[str]
) -> SetPage:  # fmt: skip
    """Return the page about a scene's set.

    ``whence``, ``text``: origins of its values and the text of its file, where it has one; ``left`` gets the
    keys of sections that Ctrl-C leaves out.

    Raises
    ------
    EngineError
        Where there is no equilibrium.
    """
    tell("operating point of the set")
    point = operating_point(scene)
    found, judged = point.statics, verdicts(point)
    warnings = cautions(point, judged)
    plan: tuple[tuple[str, str, Callable[[], list[Block]]], ...] = (
        ("verdicts", "Verdicts", lambda: [_verdicts(judged), _together(judged)]),
        ("conditions", "Operating point", lambda: [set_conditions(scene)]),
        ("arrangement", "Arrangement", lambda: [_drawing(scene), _bearings(found)]),
        ("balls", "Ball loads", lambda: [_balls(point)]),
        ("heat", "Friction and heat", lambda: [_heat(point), range_table(point.torque_range)]),
        ("axial", "Axial load", lambda: [_axial(scene, found, tell)]),
        ("warmth", "Preload and warmth", lambda: [_warmth(scene, found, tell)]),
    )
    if scene.fit is not None:
        plan = (*plan, ("fits", "Fits of the rings", lambda: seats(scene)))
    sections = []
    for key, heading, blocks in plan:
        try:
            sections.append(Section(key, heading, [], CUT) if left else Section(key, heading, blocks()))
        except Absent as problem:
            sections.append(Section(key, heading, [], str(problem)))
        except KeyboardInterrupt:
            sections.append(Section(key, heading, [], CUT))
        left += [key] if sections[-1].missing == CUT else []
    loudest: list[Tile] = []
    try:
        if left:
            raise KeyboardInterrupt
        sounding, microphones, run = sound_of_set(scene, tell)
        sections += [*sounding, _error_motion(run, tell)]
        level = float(microphones.levels["A"]["total"][microphones.loudest])
        sure = level_range(run, microphones, tell)
        label = f"loudest, at {microphones.names[microphones.loudest]}"
        if sure is not None:
            label += f"; {sure.low[0]:.0f} to {sure.high[0]:.0f} over {sure.over}"
        loudest.append(tile("laeq_dB", label, level, "dB(A)", ".1f"))
    except (Absent, ValueError) as problem:
        sections.append(Section("levels", "Levels and sources", [], str(problem)))
        why = (
            f"it is of the run for the sound, and there is none: {problem}; or give the command error-motion"
        )
        sections.append(Section("error-motion", "Error motion", [], why))
    except KeyboardInterrupt:
        both = {"levels": "Levels and sources", "error-motion": "Error motion"}
        due = both.keys() - {one.key for one in sections}
        sections += [Section(key, both[key], [], CUT) for key in sorted(due, reverse=True)]
        left += sorted(due, reverse=True) or ["the range of the level"]
    sections.append(Section("assumptions", "Assumptions", set_assumptions(scene, whence, text)))
    tiles, cards = _tiles(point) + loudest, [_card(point, k) for k in range(len(point.bearings))]
    whole = overall_of(judged, several=True)
    subtitle = (
        f"{len(found.bearings)} x {scene.bearing.designation}, {found.arrangement}, {scene.materials.kind}, "
        f"{scene.operation.speed_rpm:,.0f} r/min"
    )
    source = "statics of the set, perfect bearings; sound and error motion by a short run"
    page = render(
        title or scene.name, subtitle, source, sections, tiles, [], warnings, kind="Spindle report",
        overall=whole, cards=[_shown(number, card, judged) for number, card in enumerate(cards, start=1)],
    )  # fmt: skip
    missing = {section.key: section.missing for section in sections}
    figures = {one["key"]: one["value"] for one in tiles}
    for number, card in enumerate(cards, start=1):
        figures |= {f"bearing[{number}].{one['key']}": one["value"] for one in card}
    return SetPage(page, missing, figures, warnings, whole.judgement)


def _error_motion(run: Subject, tell: Tell) -> Section:
    tell("error motion")
    try:
        return error_motion(run)
    except Absent as problem:
        return Section("error-motion", "Error motion", [], str(problem))


def _tiles(point: OperatingPoint) -> list[Tile]:
    """Return the figures at the top."""
    found, life = point.statics, point.life
    lowest = min(found.bearings, key=lambda one: one.axial)
    tiles = []
    if found.preloads:
        preload = found.preloads["running"][0]
        tiles.append(tile("preload_N", "preload of bearing 1 at speed, without load", preload, "N", ".1f"))
    tiles += [
        tile("axial_stiffness", "axial stiffness of the shaft", 1e-6 * found.axial_stiffness, "N/um", ".1f"),
        tile("nose_stiffness", "radial stiffness at the nose", 1e-6 * found.nose_stiffness, "N/um", ".1f"),
        tile("least_axial_N", f"least axial load, bearing {lowest.number}", lowest.axial, "N", ".1f"),
    ]
    if found.lift_off:
        way, first = min(found.lift_off.items(), key=lambda pair: abs(pair[1].load))
        words = f"axial load {way} that unloads bearing {first.bearing}"
        tiles.append(tile("lift_off_N", words, abs(first.load), "N", ".0f"))
    tiles.append(tile("heat_W", "friction heat of all bearings", point.heat.total, "W", ".1f"))
    if life is not None and math.isfinite(life):
        shown = tile("life_h", "L10r of all bearings together", life, "h", ",.0f")
        tiles.append(shown | {"text": shown_hours(life)})
    return tiles


def _card(point: OperatingPoint, place: int) -> list[Tile]:
    """Return the figures of one bearing."""
    one, preloads = point.bearings[place], point.statics.preloads
    stiffness = 1e-6 * one.stiffness
    radial = 0.5 * (stiffness[1, 1] + stiffness[2, 2])
    found = [
        tile("axial_N", "axial load", one.axial, "N", ".1f"),
        tile("radial_N", "radial load", one.radial, "N", ".1f"),
    ]
    if preloads:
        found.append(tile("preload_N", "preload at speed", preloads["running"][place], "N", ".1f"))
    pressure = max(one.contacts[ring]["pressure_max"] for ring in RINGS)
    found += [
        tile("pressure_GPa", "contact pressure", 1e-9 * pressure, "GPa", ".2f"),
        tile("heat_W", "friction heat", one.heat.total, "W", ".1f"),
        tile("axial_stiffness", "axial stiffness", stiffness[0, 0], "N/um", ".1f"),
        tile("radial_stiffness", "radial stiffness", radial, "N/um", ".1f"),
    ]
    if one.life is not None and math.isfinite(one.life):
        life = tile("life_h", "L10r", one.life, "h", ",.0f")
        found.append(life | {"text": shown_hours(one.life)})
    return found


def _shown(number: int, card: list[Tile], judged: tuple[Verdict, ...]) -> Card:
    """Return the card of a bearing with the gravest verdict on it."""
    rows = [(one["label"], one["text"], one["unit"]) for one in card]
    return Card(f"Bearing {number}", overall(one for one in judged if one.bearing == number), rows)


def _drawing(scene: Scene) -> Chart:
    """Shaft and bearings to scale, with the lines of contact."""
    spindle, bearing = set_of(scene), scene.bearing
    inner, outer = 0.5 * bearing.bore_mm, 0.5 * bearing.outside_diameter_mm
    figure = look.figure(300, showlegend=False)
    start = 0.0
    for length, diameter, bore in spindle.shaft.sections_mm:
        for low, high in ((0.5 * bore, 0.5 * diameter), (-0.5 * diameter, -0.5 * bore)):
            figure.add_shape(
                type="rect", x0=start, x1=start + length, y0=low, y1=high, fillcolor="#C8CDD2",
                line={"color": "#7F7F7F", "width": 1}, layer="below",
            )  # fmt: skip
        start += length
    half, pitch = 0.5 * bearing.width_mm, 0.5 * bearing.pitch_diameter_mm
    slope = math.tan(math.radians(bearing.contact_angle_deg))
    for one, centre in zip(spindle.bearing, pressure_centres(scene), strict=True):
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
    for side in (pitch, -pitch):
        figure.add_scatter(
            x=places, y=[side] * len(places), mode="markers", text=labels, hoverinfo="text",
            marker={"size": 9, "color": look.colour("balls")},
        )  # fmt: skip
    figure.update_xaxes(axis("from the nose, mm"))
    figure.update_yaxes(axis("mm", scaleanchor="x", scaleratio=1))
    words = f"{spindle.arrangement}: shaft and bearings to scale; lines of contact meet the axis"
    return Chart("arrangement", "Shaft, bearings, lines of contact", figure, words)


def _bearings(found: Statics) -> Table:
    """Return the loads of each bearing."""
    columns = (
        "bearing", "at, mm", "axial, N", "y, N", "z, N", "largest ball load, N", "unloaded balls",
        "angle, deg", "pressure, GPa",
    )  # fmt: skip
    rows = [
        [
            f"{row['bearing']}, {row['carries']}", f"{row['position_mm']:g}", tenths(row["axial_N"]),
            tenths(row["force_y_N"]), tenths(row["force_z_N"]), f"{row['ball_load_max_N']:.1f}",
            str(row["balls_unloaded"]), f"{row['angle_inner_max_deg']:.2f}",
            f"{max(row['pressure_inner_GPa'], row['pressure_outer_GPa']):.3f}",
        ]
        for row in found.table()
    ]  # fmt: skip
    return Table("What each bearing carries, in the axes of the shaft", columns, rows)


def _heat(point: OperatingPoint) -> Table:
    """Friction torque of each bearing, and the heat it makes, by where it arises and what it warms."""
    columns, rows = heat_table(point.bearings, point.torque_range)
    return Table("Friction and heat of the settled bearings, without waviness", list(columns), rows)


def _balls(point: OperatingPoint) -> Chart:
    """Draw the loads at the inner race round each bearing."""
    figure = look.polar(420, {"title": {"text": "N"}})
    for number, one in enumerate(point.bearings, start=1):
        loads = one.ball_loads[0]
        angles = 360.0 * np.arange(len(loads)) / len(loads)
        figure.add_scatterpolar(
            r=[*loads, loads[0]], theta=[*angles, 360.0], name=f"bearing {number}", mode="lines+markers",
            line=look.series(number - 1),
        )  # fmt: skip
    words = "Load of each ball at the inner race over its place, 12 o'clock on top, seen from the rear"
    return Chart("ball_loads", "Loads of the balls at the inner races", figure, words)


def _axial(scene: Scene, found: Statics, tell: Tell) -> Chart:
    """How the bearings share an axial load alone, and how far the shaft goes.

    Raises
    ------
    Absent
        Where no load unloads a bearing.
    """
    if not found.lift_off:
        raise Absent("no axial load unloads a bearing of this set")
    tell("axial load")
    reach = [_BEYOND * one.load for one in found.lift_off.values()]
    low, high = min(0.0, *reach), max(0.0, *reach)
    loads, shares, places = [], [], []
    signs = np.array([one.sign for one in found.bearings])
    alone = dict.fromkeys(range(SP.U_NOSE, SP.U_NOSE + SP.PLANE), 0.0)
    for load in np.linspace(low, high, _STEPS):
        try:
            run = started(scene, alone | {SP.U_NOSE: float(load)})
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
    for one in found.lift_off.values():
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
    return Chart("axial", "Axial load alone: shares and displacement", figure, words)


def _warmth(scene: Scene, found: Statics, tell: Tell) -> Chart:
    """How preload follows the temperature of inner rings, of the shaft, and of both.

    Raises
    ------
    Absent
        For a set without preload, and where it cannot be warmer.
    """
    if not found.preloads:
        raise Absent("a set that carries one way has no preload")
    tell("preload over temperature")
    rings, shaft = _warm_keys(scene)
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
                curve.append(preloads(started(scene.replace(changes)))["running"][0])
            except (SceneError, EngineError) as problem:
                raise Absent(f"{name} by {rise:g} K: {problem}") from None
        figure.add_scatter(x=_WARMER, y=curve, name=name, line={"color": colour})
    figure.update_xaxes(axis("warmer than in the scene, K"))
    figure.update_yaxes(axis("preload of bearing 1 at speed, N", rangemode="tozero"))
    words = "Preload of the first bearing at speed, without load on the shaft, over temperatures"
    return Chart("warmth", "Preload over temperatures", figure, words)


def _warm_keys(scene: Scene) -> tuple[dict[str, float], dict[str, float]]:
    """Return keys and values (degC) of what warms the inner rings, and the shaft."""
    spindle, warm = set_of(scene), scene.operation.inner_ring_temperature_degC
    rings = {"operation.inner_ring_temperature_degC": warm}
    for number, one in enumerate(spindle.bearing, start=1):
        if one.inner_ring_temperature_degC is not None:
            key = f"spindle.bearing[{number}].inner_ring_temperature_degC"
            rings[key] = one.inner_ring_temperature_degC
    own = spindle.shaft.temperature_degC
    return rings, {"spindle.shaft.temperature_degC": warm if own is None else own}


def _together(judged: tuple[Verdict, ...]) -> Block:
    """Verdicts on the set as a whole."""
    rows = [
        [one.label, one.text, one.judgement, one.limit, one.source] for one in judged if one.bearing is None
    ]
    columns = ("", "value", "verdict", "limit", "source of the limit")
    return Table("Verdicts on the set", columns, rows, stacked=True)


def _verdicts(judged: tuple[Verdict, ...]) -> Block:
    """Verdicts on all bearings side by side."""
    rows = []
    for same in side_by_side(judged):
        first = next(one for one in same if one is not None)
        cells = ["" if one is None else f"{one.text} ({one.judgement})" for one in same]
        rows.append([shared_label(first), *cells, first.limit, first.source])
    columns = ("", *(f"bearing {k + 1}" for k in range(len(rows[0]) - 3)), "limit", "source of the limit")
    return Table("Verdicts on each bearing from its own loads", columns, rows, stacked=True)
