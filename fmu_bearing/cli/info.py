"""``fmu-bearing info``: a bearing or a set at its operating point, without a run."""

import math
from typing import TYPE_CHECKING

import typer

from fmu_bearing.cli.base import Catalogues, Json, SceneFile, app, print_json, refusals, tell
from fmu_bearing.cli.spindle import show_set

if TYPE_CHECKING:
    from fmu_bearing.design.operating_point import OperatingPoint
    from fmu_bearing.design.verdicts import Verdict

_FREEDOMS = ("axial", "radial y", "radial z", "tilt y", "tilt z")
_PLACES = 3  # of them are displacements
_WORDS = {
    "f_r": "shaft", "f_c": "cage", "f_b": "ball about itself", "f_i": "balls past the inner race",
    "f_o": "balls past the outer race",
}  # fmt: skip


@app.command()
def info(scene: SceneFile, catalogue: Catalogues = None, as_json: Json = False) -> None:
    """Show a bearing at its operating point without a run: contacts, stiffness, frequencies, verdicts.

    Of a set of bearings on one shaft: the load of each, the stiffness of the shaft, lift-off, preload.
    """
    from fmu_bearing.design.operating_point import operating_point
    from fmu_bearing.design.verdicts import verdicts
    from fmu_bearing.scene import read_scene

    with refusals():
        given = read_scene(scene)
    if given.spindle is not None:
        show_set(given, as_json)
        return
    with refusals():
        point = operating_point(given)
    found = verdicts(point)
    told = [*point.remarks, *(one.advice for one in found if one.advice)]
    if as_json:
        print_json(point.summary() | {"verdicts": [one.as_dict() for one in found], "cautions": told})
        return
    _show(point, found)
    for line in told:
        tell(f"caution: {line}")


def _show(point: "OperatingPoint", found: "list[Verdict]") -> None:
    from fmu_bearing.results.table import show

    scene = point.scene
    operation, mounting = scene.operation, scene.mounted
    typer.echo(
        f"{scene.name}: {scene.bearing.designation}, {operation.speed_rpm:g} r/min, preload "
        f"{mounting.preload_N:g} N ({mounting.preload_mode}), oil {operation.oil_temperature_degC:g} degC; "
        "perfect bearing, rigid rings"
    )
    show("contacts", ("", "inner race", "outer race"), _contacts(point))
    show("stiffness at rest: N and N m per um and mrad", ("", *_FREEDOMS), _matrix(point))
    shaft = point.frequencies.f_r
    rows = [
        [name, _WORDS[name], f"{value:.1f}", f"{value / shaft:.3f}" if shaft else ""]
        for name, value in point.frequencies._asdict().items()
    ]
    show("kinematic frequencies", ("", "of", "Hz", "orders"), rows)
    show("oil and ratings", ("", "value", "source"), _ratings(point))
    rows = [[one.label, one.text, one.judgement, _limit(one)] for one in found]
    show("verdicts", ("figure", "value", "verdict", "limit (source)"), rows)


def _contacts(point: "OperatingPoint") -> list[list[str]]:
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


def _matrix(point: "OperatingPoint") -> list[list[str]]:
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


def _limit(one: "Verdict") -> str:
    return one.source if one.limit == "-" else f"{one.limit} ({one.source})"


def _ratings(point: "OperatingPoint") -> list[list[str]]:
    """Rows of the table of what is neither good nor bad by itself."""
    from fmu_bearing.design.rating import unrated

    rows = [["viscosity of the oil, mm2/s", f"{point.viscosity:.1f}", "at its temperature"]]
    rows.append(["friction torque, N mm", f"{1e3 * point.friction_torque:.2f}", "settled, without waviness"])
    found = point.rating
    if found is None:
        return [*rows, ["C, C0, life", "none", unrated(point.scene)]]
    rows.append(["C, N", f"{found.dynamic:.0f}", "ISO 281"])
    ceramic = point.scene.materials.kind == "hybrid"
    words = "ISO 76; ceramic balls 0.7 of it (GMN)" if ceramic else "ISO 76"
    rows.append(["C0, N", f"{found.static:.0f}", words])
    if found.equivalent is not None:
        rows.append(["P, N", f"{found.equivalent:.0f}", "ISO 281, factors of NSK"])
    return rows
