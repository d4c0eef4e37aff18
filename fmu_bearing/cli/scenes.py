"""``fmu-bearing scene``: write a scene, check it, show its values, show the catalogue."""

import re
import warnings
from collections.abc import Mapping
from dataclasses import asdict
from pathlib import Path
from typing import TYPE_CHECKING, Annotated, Any

import typer

from fmu_bearing.cli import base
from fmu_bearing.cli.base import FOUND, Refusal, app, check_new, print_json, refusals, tell
from fmu_bearing.cli.options import Catalogues, Force, Json, SceneFile
from fmu_bearing.files import write_whole
from fmu_bearing.formulas.clearances import GROUPS
from fmu_bearing.scene import Scene, SceneError, deep_groove, read_scene
from fmu_bearing.scene.designation import suggestion
from fmu_bearing.scene.entries import Entry, entries, entry_text
from fmu_bearing.scene.exclusions import Exclusion, exclusion, exclusions_of
from fmu_bearing.scene.lubricant import SUPPLIES
from fmu_bearing.scene.nsk import PREFIX, sizes
from fmu_bearing.scene.origins import Origin, origins
from fmu_bearing.scene.own_bearing import Dimensions, balls_of
from fmu_bearing.scene.scene import scene_name
from fmu_bearing.scene.template import FITTED, MATERIALS
from fmu_bearing.scene.words import bearings_words

if TYPE_CHECKING:
    from fmu_bearing.prepare.model import Model

scene_app = typer.Typer(help="Scene files: new, check, show; what the catalogue has.", no_args_is_help=True)
app.add_typer(scene_app, name="scene")

KINDS = ("bearings", "materials", "lubricants", "grades")
#: What of the assumed values `new` prints: those that decide most, and what radiates.
_SAID = (
    "mounting.preload_N", "spindle.preload.preload_N", "spindle.load.force_x_N", "spindle.shaft.sections_mm",
    "operation.speed_rpm", "lubricant.supply", "sound.radiator", "materials.balls",
    "bearing.contact_angle_deg", "mounting.radial_load_z_N",
)  # fmt: skip


def _own(words: str, *names: str) -> Any:
    """Return the declaration of a dimension of a bearing of one's own."""
    return typer.Option(*names, help=f"{words} Needed for a bearing that is not in the catalogue.")


@scene_app.command()
def new(
    path: Annotated[
        Path | None,
        typer.Argument(metavar="FILE", help="Scene file to write; default: named after the bearing."),
    ] = None,
    bearing: Annotated[str | None, typer.Option(help="A bearing of the catalogue.")] = None,
    bore: Annotated[float | None, _own("Bore, mm.")] = None,
    outside_diameter: Annotated[float | None, _own("mm.", "--outside-diameter", "--outside")] = None,
    width: Annotated[float | None, _own("mm.")] = None,
    contact_angle: Annotated[
        float | None,
        typer.Option(help="deg; with --bore; default: what --designation says, else 15, assumed."),
    ] = None,
    dynamic_rating: Annotated[
        float | None, typer.Option(help="N, C as the maker prints it; with C0 the balls follow; with --bore.")
    ] = None,
    static_rating: Annotated[
        float | None, typer.Option(help="N, C0 as the maker prints it; with --dynamic-rating.")
    ] = None,
    designation: Annotated[str | None, typer.Option(help="Designation of the bearing.")] = None,
    kind: Annotated[
        str | None,
        typer.Option(
            metavar="|".join(MATERIALS),
            help="Materials; default: what the designation says, else hybrid, assumed.",
        ),
    ] = None,
    speed: Annotated[
        float | None, typer.Option(help="r/min; default: half of the limit with oil or grease, assumed.")
    ] = None,
    preload: Annotated[
        float | None,
        typer.Option(help="N; default: light class or more, as verdicts and modes ask; assumed."),
    ] = None,
    radial_load: Annotated[
        float | None,
        typer.Option(help="N, downwards; default: 0, of a deep groove bearing 0.05 C, assumed."),
    ] = None,
    clearance: Annotated[
        str | None, typer.Option(metavar="|".join(GROUPS), help="Radial clearance of a deep groove bearing.")
    ] = None,
    preload_class: Annotated[
        str | None,
        typer.Option(metavar="extra light|light|medium|heavy", help="Class of makers' pairs instead of N."),
    ] = None,
    preload_offset: Annotated[
        float | None, typer.Option(help="Offset of the ring faces instead of N, um.")
    ] = None,
    arrangement: Annotated[
        str | None, typer.Option(metavar="DB|DF|DT|TBT|QBC|...", help="A set of these bearings on one shaft.")
    ] = None,
    distance: Annotated[
        float | None, typer.Option(help="mm between neighbouring ball planes of a set; default: the width.")
    ] = None,
    spring: Annotated[
        float | None,
        typer.Option(help="N of springs on each bearing of a set that carries as the last one; no spacers."),
    ] = None,
    stiffness: Annotated[
        float | None,
        typer.Option(
            help="Axial stiffness, N/um, as printed of the bearing with the materials of --kind, to "
            "which the conformities are fitted."
        ),
    ] = None,
    stiffness_preload: Annotated[
        float | None, typer.Option(help="N: the preload for which --stiffness is printed.")
    ] = None,
    stiffness_of: Annotated[
        str, typer.Option(metavar="pair|bearing", help="What --stiffness is of.")
    ] = "pair",
    grade: Annotated[
        str | None,
        typer.Option(
            help="Tolerance class of the imperfections; default: what the designation says, else P4."
        ),
    ] = None,
    spall: Annotated[
        float | None,
        typer.Option(help="Length of a spall of the outer race at 6 o'clock, mm; default: none."),
    ] = None,
    lubricant: Annotated[str, typer.Option(help="Oil of the catalogue.")] = "spindle-oil",
    supply: Annotated[
        str | None,
        typer.Option(
            metavar="|".join(SUPPLIES),
            help="How oil comes to the contacts, as grease or a bath; default: oil-air, assumed.",
        ),
    ] = None,
    sound: Annotated[bool, typer.Option(help="With four microphones.")] = True,
    catalogue: Catalogues = None,
    force: Force = False,
    as_json: Json = False,
) -> None:
    """Write a scene from the catalogue, or from boundary dimensions with the rest estimated.

    A deep groove bearing has a clearance and a radial load in the place of contact angle and preload.

    One bearing on its mounting, or with --arrangement a set on one shaft whose sections are assumed. A
    preload class is the offset of the loose rings' faces; the loads of a set follow from it. Bearings that
    all carry one way (DT) get the axial force that loads each so, assumed.

    Speed and preload that are not given follow makers' rules, so that all verdicts are good and no ring
    whirls by itself. Where no speed and preload within the rules do that, or where given ones do not, the
    cautions of `scene check` say what is not good.
    """
    from fmu_bearing.design.fresh import new_scene

    with refusals():
        dimensions = (bore, outside_diameter, width)
        if bearing is not None and any(value is not None for value in dimensions):
            raise Refusal("give --bearing or dimensions, not both")
        rated = dynamic_rating is not None or static_rating is not None
        if rated and bearing is not None:
            raise Refusal("--dynamic-rating and --static-rating are for --bore: the catalogue has balls")
        if contact_angle is not None and bearing is not None:
            raise Refusal("--contact-angle is for --bore: the catalogue has the angle")
        if sum(value is not None for value in (preload, preload_class, preload_offset, spring)) > 1:
            raise Refusal("give one of --preload, --preload-class, --preload-offset and --spring")
        if arrangement is None and (distance is not None or spring is not None):
            raise Refusal("--distance and --spring are of a set: give its --arrangement, as DB")
        if (stiffness is None) != (stiffness_preload is None):
            raise Refusal(
                "give --stiffness and --stiffness-preload together: a printed stiffness holds at one preload"
            )
        if bearing is not None:
            chosen: str | Dimensions = bearing
        elif bore is not None and outside_diameter is not None and width is not None:
            chosen = Dimensions(bore, outside_diameter, width, contact_angle, dynamic_rating, static_rating)
        elif any(value is not None for value in dimensions):
            raise Refusal("a bearing of your own needs --bore, --outside-diameter and --width")
        else:
            raise Refusal(
                "which bearing? give --bearing NAME (`fmu-bearing scene catalogue` lists them), or --bore, "
                "--outside-diameter and --width"
            )
        path = path or _named(bearing or designation or "bearing", arrangement)
        check_new(force, path)
        text = new_scene(
            scene_name(path.stem), chosen, kind=kind, speed_rpm=speed, grade=grade, lubricant=lubricant,
            supply=supply, sound=sound, designation=designation, preload_N=preload,
            preload_class=preload_class, preload_offset_um=preload_offset, folder=path.parent,
            arrangement=arrangement, distance_mm=distance, spring_N=spring, stiffness_N_um=stiffness,
            stiffness_preload_N=stiffness_preload, stiffness_of=stiffness_of, tell=tell,
            clearance=clearance, spall_mm=spall,
            **({} if radial_load is None else {"radial_load_N": radial_load}),
        )  # fmt: skip
        write_whole(path, text.encode("utf-8"))
        found = [origin for origin in origins(path) if origin.assumed]
    cautions = _findings(path)[1]
    if isinstance(chosen, Dimensions) and (doubt := balls_of(chosen, kind, designation).doubt):
        cautions = [doubt, *cautions]
    if as_json:
        print_json({"file": path, "assumed": [asdict(one) for one in found], "cautions": cautions})
        return
    typer.echo(f"written: {path}; {len(found)} values are assumed: `fmu-bearing scene show {path} --assumed`")
    for one in found:
        if (one.key in _SAID or one.remark.startswith(FITTED)) and one.origin == "file":
            typer.echo(f"assumed: {one.key} = {_shown(one)}: {one.remark}")
    for line in cautions:
        tell(f"caution: {line}")


def _named(bearing: str, arrangement: str | None) -> Path:
    """Return the name of a new scene's file, in letters that names of scenes may have."""
    name = bearing if arrangement is None else f"{bearing}-{arrangement}"
    return Path((re.sub(r"[^\w.-]+", "-", name).strip("-.") or "bearing") + ".toml")


@scene_app.command()
def check(
    paths: Annotated[list[Path], typer.Argument(metavar="SCENE...", help="Scene files.")],
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Read scenes and find their equilibrium; print errors, warnings, and limits that are passed.

    Last come what such a scene cannot have, and why.
    """
    with refusals():
        for file in paths:
            if not file.is_file():  # nothing to check: a refusal, no finding
                read_scene(file)
        findings = {str(path): _findings(path) for path in paths}
    rows = {
        path: [] if scene is None else [row for row in exclusions_of(scene) if "against" not in row.what]
        for path, (scene, _) in findings.items()
    }  # `against` is a value of one study, which says so by itself, and every set has that row
    if as_json:
        print_json({
            path: {"ok": scene is not None, "findings": lines, "cannot": list(map(_cannot, rows[path]))}
            for path, (scene, lines) in findings.items()
        })  # fmt: skip
    else:
        for path, (scene, lines) in findings.items():
            for line in lines:
                typer.echo(f"{'error' if scene is None else 'caution'}: {line}", err=scene is None)
            if scene is not None:
                typer.echo(f"{path}: a scene, with an equilibrium at its operating point")
            for row in rows[path]:
                typer.echo(row.words())
    if any(scene is None for scene, _ in findings.values()):
        raise typer.Exit(FOUND)


def _cannot(row: Exclusion) -> dict[str, Any]:
    """Return a row of what a scene cannot have, for machines."""
    return {"what": list(row.what.values()), "reason": row.reason, "way_out": row.way_out}


def _findings(path: Path) -> tuple[Scene | None, list[str]]:
    """Return a scene that can be run, else None, and the messages about it."""
    from fmu_bearing.design.operating_point import operating_point
    from fmu_bearing.design.verdicts import cautions, verdicts
    from fmu_bearing.instance import EngineError, Instance
    from fmu_bearing.interface import fmu_variables, variables

    try:
        scene = read_scene(path)
        fmu_variables(scene, variables(scene, 0.0))
        _check_table(scene)
        bearing = Instance(_silent(scene))
        with warnings.catch_warnings(record=True) as caught:
            warnings.simplefilter("always")
            bearing.initialise()
        lines = [str(one.message) for one in caught]
        if exclusion(scene, "statics") is None:
            point = operating_point(scene)
            # the bearing itself has warned of an ellipse beyond the shoulder
            judged = [one for one in verdicts(point) if (one.key, one.judgement) != ("shoulder", "change")]
            lines += cautions(point, judged)
        return scene, [f"{path}: {line}" for line in lines]
    except SceneError as problem:
        return None, list(problem.problems)
    except EngineError as problem:
        return None, [f"{path}: {problem}"]


def _check_table(scene: Scene) -> None:
    """Read the transfer functions that the scene brings; `SceneError` where they do not serve."""
    if scene.sound is None or scene.sound.table_file is None:
        return
    from fmu_bearing.acoustics.filters.bearings import check_table

    try:
        check_table(scene)
    except ValueError as problem:
        raise SceneError(f"{scene.name}: {problem}") from None


@scene_app.command()
def show(
    path: SceneFile,
    assumed: Annotated[bool, typer.Option("--assumed", help="Only values that are assumed.")] = False,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """Show every value of a scene with its unit, range and origin, and which values are assumed."""
    from fmu_bearing.extras import BENDING, available

    with refusals():
        scene = read_scene(path)
        values = [origin for origin in origins(path) if origin.assumed or not assumed]
        known = not scene.bends or available("skfem", BENDING, "fidelity and sizes", tell)
        sizes = _sizes(scene) if known else {}
    if as_json:
        print_json({"scene": scene.name, "computed": sizes, "values": [asdict(one) for one in values]})
        return
    rows = [[one.key, _shown(one), one.allowed, one.origin, _remark(one)] for one in values]
    base.show(scene.name, ("key", "value", "allowed", "from", "remark"), rows)
    for name, value in sizes.items():
        typer.echo(f"{name:10} {value}")


@scene_app.command("catalogue")
def show_catalogue(
    kind: Annotated[str, typer.Argument(metavar="|".join(KINDS))] = KINDS[0],
    name: Annotated[str | None, typer.Argument(metavar="[NAME]", help="One entry, with its remarks.")] = None,
    catalogue: Catalogues = None,
    as_json: Json = False,
) -> None:
    """List the catalogue: bearings, materials, lubricants, tolerance classes."""
    with refusals():
        if kind not in KINDS:
            raise Refusal(f"there is no catalogue of '{kind}': choose from {', '.join(KINDS)}")
        known = entries(kind)
        if name is not None and name not in known:
            raise Refusal(
                f"there is no '{name}' among the {kind}: {suggestion(name, known)}"
                f"`fmu-bearing scene catalogue {kind}` lists them"
            )
    if name is not None:
        _show_entry(name, known[name], as_json)
    elif as_json:
        print_json({one: entry.values for one, entry in known.items()})
    elif kind == KINDS[0]:
        _show_bearings(known)
    else:
        _show_entries(kind, known)


def _show_entries(kind: str, known: Mapping[str, Entry]) -> None:
    """Print a column per entry."""
    keys = list(dict.fromkeys(key for entry in known.values() for key in entry.values))
    rows = [[key, *(str(entry.values.get(key, "")) for entry in known.values())] for key in keys]
    base.show(kind, ("key", *known), rows)


def _show_bearings(known: Mapping[str, Entry]) -> None:
    """Print a row per bearing: what is printed of it, and its balls."""
    keys = (
        "bore_mm",
        "outside_diameter_mm",
        "width_mm",
        "contact_angle_deg",
        "ball_count",
        "ball_diameter_mm",
    )
    rows = [
        [name, *(f"{entry.values[key]:g}" if key in entry.values else "-" for key in keys)]
        for name, entry in known.items()
    ]
    base.show("bearings", ("name", "d, mm", "D, mm", "B, mm", "angle", "balls", "ball, mm"), rows)
    tell(
        f"balls of {PREFIX}... and of deep groove bearings (-) are derived; one in full: `fmu-bearing scene "
        "catalogue bearings NAME`"
    )


def _show_entry(name: str, entry: Entry, as_json: bool) -> None:
    """Print an entry with its remarks, and what a maker prints of it."""
    size = sizes().get(name) or deep_groove.sizes().get(name)
    printed = None if size is None else size.printed()
    if as_json:
        print_json({"values": entry.values, "printed": printed})
        return
    typer.echo(entry_text(entry, name).rstrip())
    if printed is None:
        return
    classes = printed.pop("preload", {})
    typer.echo("\n# printed by NSK")
    for key, value in printed.items():
        typer.echo(f"# {key} = {value:g}")
    for key, one in classes.items():
        force, stiffness = one.values()
        typer.echo(f"# preload {key}: {force:g} N, pair {stiffness:g} N/um")


def _silent(scene: Scene) -> "Model":
    """Return the model without its sound: boundary elements may take minutes."""
    from fmu_bearing.prepare.model import prepare

    fidelity = "full" if scene.fidelity.model == "auto" else None
    return prepare(scene.model_copy(update={"sound": None}), fidelity=fidelity)


def _shown(one: Origin) -> str:
    value = f"{one.value:g}" if isinstance(one.value, float) else str(one.value)
    return f"{value} {one.unit}".rstrip()


def _remark(one: Origin) -> str:
    if not one.assumed:
        return one.remark
    return f"assumed: {one.remark}" if one.remark else "assumed"


def _sizes(found: Scene) -> dict[str, Any]:
    """Return fidelity, method, sound and sizes of a scene, in words."""
    from fmu_bearing.prepare.step_limits import longest_internal_step

    auto = found.fidelity.model == "auto"
    model = _silent(found)
    p, fidelity = model.parameters, found.fidelity
    # an instance copies the parameters and keeps its last state beside the present one
    sizes = model.lengths
    places = p.size + 2 * sizes.state + sizes.work + sizes.outputs
    if auto and found.on_other_shaft:
        words = "auto: full, which alone follows another model's shaft"
    elif auto:
        bounds = fidelity.accuracy
        words = (
            f"auto, within {bounds.level_dB:g} dB and {bounds.relative:g} of fidelity full; "
            "`fmu-bearing choose` prints which; sizes are of fidelity full"
        )
    else:
        method = f", method {fidelity.method}" if fidelity.model == "full" else ""
        words = (
            f"{fidelity.model}{method}, internal steps up to {1e6 * longest_internal_step(found):.3g} us, "
            f"tolerance {fidelity.tolerance:g}"
        )
    sound = "none"
    if found.sound is not None:
        sound = f"{found.sound.radiation_model}, {found.sound.radiator}, {len(found.microphones)} microphones"
    return {
        "scene": f"{found.name}: {bearings_words(found)}, {found.operation.speed_rpm:g} r/min",
        "fidelity": words,
        "balls": f"{model.n_balls}, traction strips {fidelity.traction_strips}",
        "sound": sound,
        "memory": f"{8e-6 * places:.2f} MB for the arrays of one instance, without sound",
    }
