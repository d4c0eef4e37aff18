"""What ``fmu-bearing info`` and ``stiffness`` show of a set of bearings on one shaft."""

from collections.abc import Iterable
from pathlib import Path
from typing import TYPE_CHECKING

import typer

from fmu_bearing.cli.base import print_json, progress, refusals, tell

if TYPE_CHECKING:
    from fmu_bearing.design.verdicts import Verdict
    from fmu_bearing.scene import Scene
    from fmu_bearing.spindle.statics import ShaftStatics


def show_set(scene: "Scene", as_json: bool) -> None:
    """Print the statics of a scene's set, and what is to be said about its bearings."""
    from fmu_bearing.design.set_points import life_of_set, operating_points, set_verdicts
    from fmu_bearing.design.verdicts import side_by_side, verdicts
    from fmu_bearing.spindle.statics import shaft_statics

    with refusals():
        found = shaft_statics(scene)
        points = operating_points(scene)
    judged = [verdicts(point) for point in points]
    life, together = life_of_set(points), set_verdicts(found, points)
    if as_json:
        own = [point.summary() for point in points]
        for one, told in zip(own, judged, strict=True):
            one["verdicts"] = [verdict.as_dict() for verdict in told]
        print_json(found.summary() | {
            "operating_points": own, "life_of_set_h": life, "verdicts": [one.as_dict() for one in together],
        })  # fmt: skip
        return
    _show(found)
    _judge(list(side_by_side(points)), together)
    for line in found.cautions():
        tell(f"caution: {line}")
    for number, told in enumerate(judged, start=1):
        for verdict in told:
            if verdict.advice:
                tell(f"caution: bearing {number}: {verdict.advice}")
    for verdict in together:
        if verdict.advice:
            tell(f"caution: {verdict.advice}")


def _judge(judged: "list[list[Verdict | None]]", together: "list[Verdict]") -> None:
    """Print figures of all bearings side by side, with what is not good marked, and those of the set."""
    from fmu_bearing.results.table import show

    rows = []
    for alike in judged:
        first = next(one for one in alike if one is not None)
        cells = [
            "" if one is None else one.text + (f" {one.judgement}" if one.advice else "") for one in alike
        ]
        label = first.label.split(":")[0].replace(", inner race", "").replace(", outer race", "")
        rows.append([label, *cells, first.limit])
    columns = ("figure", *(f"bearing {k + 1}" for k in range(len(judged[0]))), "limit")
    show("verdicts", columns, rows)
    if together:
        rows = [[one.label, one.text, one.judgement, f"{one.limit} ({one.source})"] for one in together]
        show("verdicts on the set", ("figure", "value", "verdict", "limit (source)"), rows)


def _show(found: "ShaftStatics") -> None:
    from fmu_bearing.results.table import show

    scene = found.scene
    typer.echo(
        f"{scene.name}: {len(found.bearings)} x {scene.bearing.designation}, {found.arrangement}, "
        f"{scene.operation.speed_rpm:g} r/min; statics, "
        f"{'shaft that bends' if scene.spindle and scene.spindle.shaft.flexible else 'rigid shaft'}"
    )
    rows = [
        [
            f"{row['bearing']}, {row['carries']}", f"{row['position_mm']:g}", _tenths(row["axial_N"]),
            _tenths(row["force_y_N"]), _tenths(row["force_z_N"]), f"{row['ball_load_max_N']:.1f}",
            f"{row['angle_inner_max_deg']:.2f}", f"{row['pressure_inner_GPa']:.3f}",
            f"{row['pressure_outer_GPa']:.3f}",
        ]
        for row in found.table()
    ]  # fmt: skip
    columns = (
        "bearing", "at, mm", "axial, N", "y, N", "z, N", "ball, N", "angle, deg", "inner, GPa", "outer, GPa",
    )  # fmt: skip
    show("bearings: load; largest ball load, angle, pressure", columns, rows)
    show("shaft", ("", "value"), _shaft(found))


def _tenths(value: float) -> str:
    """Return a number with one decimal; what rounds to nothing has no sign."""
    return f"{round(value, 1) + 0.0:.1f}"


def _shaft(found: "ShaftStatics") -> list[list[str]]:
    """Rows of the table of the shaft."""
    x, y, z, by, bz = 1e6 * found.displacement
    rows = [
        ["nose moves by x, y, z, um", ", ".join(_tenths(value) for value in (x, y, z))],
        ["and tilts about y, z, urad", ", ".join(_tenths(value) for value in (by, bz))],
        ["axial stiffness, N/um", f"{1e-6 * found.axial_stiffness:.1f}"],
        ["radial stiffness, N/um", f"{1e-6 * found.radial_stiffness:.1f}"],
        ["tilt stiffness, N m/mrad", f"{1e-3 * found.tilt_stiffness:.2f}"],
        ["radial stiffness at the nose, N/um", f"{1e-6 * found.nose_stiffness:.1f}"],
    ]
    for words, key in (
        ("preload at standstill and 20 degC, N", "cold"),
        ("preload at the temperatures, N", "warm"),
        ("preload at speed too, N", "running"),
    ):
        if key in found.preloads:
            rows.append([words, ", ".join(f"{force:.1f}" for force in found.preloads[key])])
    for way, one in found.lift_off.items():
        rows.append(
            [f"axial load {way} that unloads bearing {one.bearing} at standstill, N", f"{abs(one.load):.0f}"]
        )
    if found.spacing is not None:
        rows.append(["spacing of both directions, mm", f"{1e3 * found.spacing:.1f}"])
    if found.neutral_spacing is not None:
        rows.append(["temperature-neutral spacing, mm", f"{1e3 * found.neutral_spacing:.1f}"])
    return rows


def stiffness_of_set(
    scene: "Scene", speeds: list[float] | None, preloads: list[float] | None, target: Path,
    picture: Path | None, as_json: bool,
) -> None:  # fmt: skip
    """Write the static stiffness of a set over speed and preload, and print it."""
    from fmu_bearing.design.set_stiffness import NAMED, set_stiffness
    from fmu_bearing.results.picture_parts import save
    from fmu_bearing.results.table import show

    def track(values: Iterable[float]) -> Iterable[float]:
        return values if as_json else progress(values, "speeds", transient=True)

    with refusals():
        found = set_stiffness(scene, speeds, preloads, track)
        files = [found.save(target)]
        if picture is not None:
            save(found.picture(), picture)
            files.append(picture)
    if as_json:
        print_json(found.summary() | {"files": files})
        return
    rows = [
        [
            f"{speed:g}",
            f"{preload:g}",
            *(f"{factor * found.named(attribute)[i, k]:.2f}" for _, attribute, _, factor in NAMED),
        ]
        for i, speed in enumerate(found.speeds)
        for k, preload in enumerate(found.preloads)
    ]
    columns = ("r/min", "N", *(f"K {words}" for words, *_ in NAMED))
    show(f"{scene.name} at the nose, static: K in N/um and N m/mrad", columns, rows)
    for line in found.cautions():
        tell(f"caution: {line}")
    tell(f"written: {', '.join(map(str, files))}")
