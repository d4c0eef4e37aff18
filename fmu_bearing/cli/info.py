"""``fmu-bearing info``: a bearing or a set at its operating point, without a run."""

import math
import textwrap
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import typer

from fmu_bearing.cli.base import Refusal, app, print_json, refusals, show, tell
from fmu_bearing.cli.options import Catalogues, Json, SceneFile, Settings, Speed
from fmu_bearing.cli.settings import at_speed, source_of
from fmu_bearing.scene.words import bearings_words, conditions_words, materials_words, temperature_words

if TYPE_CHECKING:
    from fmu_bearing.design.fits import Column
    from fmu_bearing.design.operating_point import BearingPoint, OperatingPoint
    from fmu_bearing.design.temperatures import Temperatures
    from fmu_bearing.design.verdict import Verdict
    from fmu_bearing.scene import Scene
    from fmu_bearing.steady.statics import Statics

_FREEDOMS = ("axial", "radial y", "radial z", "tilt y", "tilt z")
#: Columns that a terminal has room for: of the bearings, and by race.
_OF_LOADS = ("bearing", "at, mm", "axial, N", "y, N", "z, N")
_OF_RACES = (
    "bearing", "ball inner, N", "ball outer, N", "angle inner, deg", "angle outer, deg", "inner, GPa",
    "outer, GPa",
)  # fmt: skip
_DEGC = ("oil_temperature_degC", "inner_ring_temperature_degC", "outer_ring_temperature_degC")
_PLACES = 3  # of them are displacements
_WIDTH = 80
_WORDS = {
    "f_r": "shaft", "f_c": "cage", "f_b": "ball about itself", "f_i": "balls past the inner race",
    "f_o": "balls past the outer race",
}  # fmt: skip


@app.command()
def info(
    scene: SceneFile,
    speed: Speed = None,
    settings: Settings = None,
    temperatures: Annotated[
        bool,
        typer.Option(
            "--temperatures", help="At the temperatures at which heat leaves as it arises, with a range."
        ),
    ] = False,
    ambient: Annotated[
        float | None,
        typer.Option(metavar="DEGC", help="With --temperatures: around the spindle; default: 22."),
    ] = None,
    cooling: Annotated[
        float | None,
        typer.Option(
            metavar="W/K",
            help="With --temperatures: from the housing outwards; default: cooling water by the size.",
        ),
    ] = None,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Show a scene's bearings at their operating point without a run: contacts, stiffness, verdicts.

    Of a set of bearings on one shaft: the load of each, the stiffness of the shaft, lift-off, preload.
    """
    from fmu_bearing.design.measured import measured_elsewhere
    from fmu_bearing.design.operating_point import operating_point
    from fmu_bearing.design.verdicts import cautions, verdicts
    from fmu_bearing.results.defect_lines import defect_lines
    from fmu_bearing.scene import scene_of

    with refusals():
        given = source_of(scene, at_speed(speed, settings, scene))
        warm = _warm(given, temperatures, ambient, cooling)
        point = operating_point(given if warm is None else warm.scene)
        defects = defect_lines(scene_of(given), [one.frequencies for one in point.bearings])
    judgements = verdicts(point)
    lines = cautions(point, judgements)
    if warm is None:
        lines += _assumed(scene, settings, point)
    if as_json:
        judged = {"verdicts": judgements, "cautions": lines, "measured_elsewhere": measured_elsewhere()}
        seats = {} if point.scene.fit is None else {"fits": _seats(point)}
        steady = {} if warm is None else {"temperatures": warm}
        passing = [
            {"defect": one.defect, "words": one.words, "line": one.name, "frequency_Hz": one.frequency,
             "side_bands_Hz": one.side}
            for one in defects
        ]  # fmt: skip
        print_json(point.summary() | judged | seats | steady | ({"defects": passing} if passing else {}))
        return
    if point.scene.assembly.joined:
        _show_set(point.statics)
    else:
        _show_bearing(point.bearings[0])
    if defects:
        rows = [[one.defect, one.name, f"{one.frequency:.1f}", one.modulator] for one in defects]
        show("lines of local defects", ("", "line", "Hz", "side bands by"), rows)
        for one in defects:
            _show_heading(f"{one.defect}: {one.words}")
    if point.scene.fit is not None:
        _show_fits(point)
    _show_heat(point)
    if warm is not None:
        _show_temperatures(warm)
    _show_verdicts(judgements, len(point.bearings), point.scene)
    typer.echo("computed figures over what others measured or print:")
    for figure, words in measured_elsewhere().items():
        typer.echo(f"{figure}: {words}")
    for line in lines:
        tell(f"caution: {line}")


def _warm(
    given: "Path | Scene", wanted: bool, ambient: float | None, cooling: float | None
) -> "Temperatures | None":
    """Return the steady temperatures where they are wanted."""
    from fmu_bearing.design.temperatures import AMBIENT, temperatures
    from fmu_bearing.scene import scene_of

    if not wanted:
        if ambient is not None or cooling is not None:
            raise Refusal("--ambient and --cooling are of steady temperatures: give --temperatures")
        return None
    if ambient is not None and not -40.0 <= ambient <= 100.0:
        raise Refusal(f"--ambient {ambient:g} is refused; allowed: -40 to 100 degC")
    if cooling is not None and not 0.0 < cooling <= 1e6:
        raise Refusal(f"--cooling {cooling:g} is refused; allowed: above 0 to 1e6 W/K")
    return temperatures(scene_of(given), AMBIENT if ambient is None else ambient, cooling)


def _assumed(path: Path, settings: list[str] | None, point: "OperatingPoint") -> list[str]:
    """Return a caution where temperatures that nobody gave are far below those that the heat makes."""
    from fmu_bearing.design.temperatures import warmer
    from fmu_bearing.scene.origins import origins

    if not (heats := [one.heat for one in point.bearings]) or not warmer(point.scene, heats, _DEGC):
        return []
    given = " ".join(settings or ())
    assumed = {one.key.removeprefix("operation.") for one in origins(path) if one.assumed}
    keys = [key for key in _DEGC if key in assumed and key.removesuffix("_degC") not in given]
    words = warmer(point.scene, heats, keys)
    if not words:
        return []
    return [
        f"temperatures are assumed ({temperature_words(point.scene)}), and {words}: `--temperatures` finds "
        "those that the heat makes, or says that there are none"
    ]


def _show_temperatures(warm: "Temperatures") -> None:
    """Print the steady temperatures and what they rest on."""
    show(f"steady temperatures in {warm.ambient:g} degC", *warm.rows())
    show("what flows off, scaled from a 7003C", *warm.rules())


def _show_heading(text: str) -> None:
    """Print what the figures are of, within the width of a narrow terminal."""
    typer.echo(textwrap.fill(text, _WIDTH, subsequent_indent="  ", break_on_hyphens=False))


def _show_bearing(point: "BearingPoint") -> None:
    """Print contacts, stiffness, frequencies and ratings of a single bearing."""
    scene = point.scene
    mounting = scene.mounted
    _show_heading(
        f"{scene.name}: {scene.bearing.designation}, {materials_words(scene)}; "
        f"{scene.operation.speed_rpm:g} r/min, preload {mounting.preload_N:g} N ({mounting.preload_mode}); "
        f"{conditions_words(scene)}; perfect bearing, rigid rings"
    )
    show("contacts", ("", "inner race", "outer race"), _contacts(point))
    show("stiffness at rest: N and N m per um and mrad", ("", *_FREEDOMS), _matrix(point))
    shaft = point.frequencies.f_r
    rows = [
        [name, _WORDS[name], f"{value:.1f}", f"{value / shaft:.3f}" if shaft else ""]
        for name, value in point.frequencies._asdict().items()
    ]
    show("frequencies, as cage and balls turn", ("", "of", "Hz", "orders"), rows)
    show("oil and ratings", ("", "value", "source"), _ratings(point))


def _show_set(statics: "Statics") -> None:
    """Print what the bearings of a set carry, and how stiff they hold the shaft."""
    from fmu_bearing.results.base import table
    from fmu_bearing.steady.statics import BearingLoad

    scene = statics.scene
    _show_heading(
        f"{scene.name}: {bearings_words(scene)}, {materials_words(scene)}; "
        f"{scene.operation.speed_rpm:g} r/min; {conditions_words(scene)}; statics, "
        f"{'shaft that bends' if scene.spindle and scene.spindle.shaft.flexible else 'rigid shaft'}"
    )
    show("load of the bearings", *table(BearingLoad, statics.bearings, _OF_LOADS))
    title = "largest ball load, contact angle and pressure, by race"
    show(title, *table(BearingLoad, statics.bearings, _OF_RACES))
    show("shaft", ("", "value"), _shaft(statics))


def _seats(point: "OperatingPoint") -> "Column":
    """Return the seats with the interference that the scene takes."""
    from fmu_bearing.design.fits import column_at

    assert point.scene.fit is not None
    return column_at(point.scene, point.scene.fit.take, point)


def _show_fits(point: "OperatingPoint") -> None:
    """Print what the seats of each bearing do, from the drawing to speed."""
    from fmu_bearing.design.fit_table import STATE_COLUMNS, state_rows

    for bearing in _seats(point).bearings:
        name = f", bearing {bearing.number}" if len(point.bearings) > 1 else ""
        words = "; ".join(f"{ring} ring {seat.words}" for ring, seat in bearing.seats.items())
        show(f"fits{name}: {words}", STATE_COLUMNS, state_rows(bearing))


def _show_heat(point: "OperatingPoint") -> None:
    """Print the friction torque of each bearing and the heat it makes, with their ranges."""
    from fmu_bearing.design.heat import heat_table
    from fmu_bearing.design.torque_range import CAPTION

    show("friction and heat: settled, no waviness", *heat_table(point.bearings, point.torque_range))
    show(CAPTION, *point.torque_range.table())


def _show_verdicts(judgements: "tuple[Verdict, ...]", bearings: int, scene: "Scene") -> None:
    """Print the verdicts: of several bearings side by side, what is not good marked, then on the whole."""
    from fmu_bearing.design.verdicts import shared_label, shared_limit, side_by_side

    one_by_one = ("figure", "value", "verdict", "limit (source)")
    rows = [[one.label, one.text, one.judgement, f"{one.limit} ({one.source})"] for one in judgements]
    if bearings == 1:
        show("verdicts", one_by_one, rows)
        return
    together = [row for row, one in zip(rows, judgements, strict=True) if one.bearing is None]
    rows = []
    for same in side_by_side(judgements):
        first = next(one for one in same if one is not None)
        cells = [
            "" if one is None else one.text + (f" {one.judgement}" if one.advice else "") for one in same
        ]
        rows.append([shared_label(first), *cells, shared_limit(same, scene)])
    show("verdicts", ("figure", *(f"bearing {k + 1}" for k in range(bearings)), "limit"), rows)
    show("verdicts on the set", one_by_one, together)


def _shaft(statics: "Statics") -> list[list[str]]:
    """Rows of the table of the shaft."""
    from fmu_bearing.results.table import tenths

    x, y, z, by, bz = 1e6 * statics.displacement
    rows = [
        ["nose moves by x, y, z, um", ", ".join(tenths(value) for value in (x, y, z))],
        ["and tilts about y, z, urad", ", ".join(tenths(value) for value in (by, bz))],
        ["axial stiffness, N/um", f"{1e-6 * statics.axial_stiffness:.1f}"],
        ["radial stiffness, N/um", f"{1e-6 * statics.radial_stiffness:.1f}"],
        ["tilt stiffness, N m/mrad", f"{1e-3 * statics.tilt_stiffness:.2f}"],
        ["radial stiffness at the nose, N/um", f"{1e-6 * statics.nose_stiffness:.1f}"],
    ]
    for words, key in (
        ("preload at standstill and 20 degC, N", "cold"),
        ("preload at the temperatures, N", "warm"),
        ("preload at speed too, N", "running"),
    ):
        if key in statics.preloads:
            rows.append([words, ", ".join(f"{force:.1f}" for force in statics.preloads[key])])
    for way, one in statics.lift_off.items():
        rows.append(
            [f"axial load {way} that unloads bearing {one.bearing} at standstill, N", f"{abs(one.load):.0f}"]
        )
    if statics.spacing is not None:
        rows.append(["spacing of both directions, mm", f"{1e3 * statics.spacing:.1f}"])
    if statics.neutral_spacing is not None:
        rows.append(["temperature-neutral spacing, mm", f"{1e3 * statics.neutral_spacing:.1f}"])
    return rows


def _contacts(point: "BearingPoint") -> list[list[str]]:
    """Rows of the table of contacts."""
    rows = (
        ("load of a ball, mean, N", "load_mean", 1.0, ".1f"),
        ("load of a ball, largest, N", "load_max", 1.0, ".1f"),
        ("contact angle, mean, deg", "angle_mean", 180.0 / math.pi, ".2f"),
        ("pressure, largest, GPa", "pressure_max", 1e-9, ".3f"),
        ("spin over roll", "spin_to_roll", 1.0, ".3f"),
        ("ellipse to shoulder, deg", "shoulder_margin", 180.0 / math.pi, ".1f"),
    )
    return [
        [words, *(f"{factor * point.contacts[ring][key]:{form}}" for ring in ("inner", "outer"))]
        for words, key, factor, form in rows
    ]


def _matrix(point: "BearingPoint") -> list[list[str]]:
    """Rows of the stiffness matrix: what is below a millionth of its row and column is rounding."""
    k = point.stiffness
    rows = []
    for i, name in enumerate(_FREEDOMS):
        cells = []
        for j in range(len(_FREEDOMS)):
            small = abs(k[i, j]) < 1e-6 * math.sqrt(abs(k[i, i] * k[j, j]))
            factor = 1e-6 if j < _PLACES else 1e-3  # per um or mrad
            cells.append("0" if small else f"{factor * k[i, j]:.4g}")
        rows.append([name, *cells])
    return rows


def _ratings(point: "BearingPoint") -> list[list[str]]:
    """Rows of the table of what is neither good nor bad by itself."""
    from fmu_bearing.design.rating import unrated

    rows = [["viscosity of the oil, mm2/s", f"{point.viscosity:.1f}", "at its temperature"]]
    rating = point.rating
    if rating is None:
        return [*rows, ["C, C0, life", "none", unrated(point.scene)]]
    rows.append(["C, N", f"{rating.dynamic:.0f}", "ISO 281"])
    ceramic = point.scene.materials.kind == "hybrid"
    words = "ISO 76; ceramic balls 0.7 of it (GMN)" if ceramic else "ISO 76"
    rows.append(["C0, N", f"{rating.static:.0f}", words])
    if rating.equivalent is not None:
        rows.append(["P, N", f"{rating.equivalent:.0f}", "ISO 281"])
    if rating.factors is not None:
        e, x, y, y0 = rating.factors
        rows.append(["e, X, Y, Y0", f"{e:.2f}, {x:.2f}, {y:.2f}, {y0:.2f}", "ISO 281, ISO 76; single row"])
    return rows
