"""What ``fmu-bearing info`` shows of a set of bearings on one shaft."""

from typing import TYPE_CHECKING

import typer

from fmu_bearing.cli.base import print_json, refusals, tell

if TYPE_CHECKING:
    from fmu_bearing.scene import Scene
    from fmu_bearing.spindle.statics import ShaftStatics


def show_set(scene: "Scene", as_json: bool) -> None:
    """Print the statics of a scene's set."""
    from fmu_bearing.spindle.statics import shaft_statics

    with refusals():
        found = shaft_statics(scene)
    if as_json:
        print_json(found.summary())
        return
    _show(found)
    for line in found.cautions():
        tell(f"caution: {line}")


def _show(found: "ShaftStatics") -> None:
    from fmu_bearing.run.table import show

    scene = found.scene
    typer.echo(
        f"{scene.name}: {len(found.bearings)} x {scene.bearing.designation}, {found.arrangement}, "
        f"{scene.operation.speed_rpm:g} r/min; statics, rigid shaft"
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
