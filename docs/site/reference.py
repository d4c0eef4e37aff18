"""References made from the code itself: keys of scene files, variables, commands, public names.

Each function returns Markdown; ``hooks.py`` puts it into the page that asks for it.
"""

import math
import re
import types
import typing
from pathlib import Path

import typer
from pydantic import BaseModel
from typer.cli import get_docs_for_click

import fmu_bearing
from fmu_bearing.cli import app
from fmu_bearing.fmi.documentation import range_of
from fmu_bearing.formulas.iso76 import static_rating
from fmu_bearing.formulas.iso281 import dynamic_rating
from fmu_bearing.interface import variables
from fmu_bearing.results.variable_names import any_sets
from fmu_bearing.scene import Scene, read_scene
from fmu_bearing.scene.exclusions import EXCLUSIONS
from fmu_bearing.scene.nsk import CLASSES, PREFIX, sizes as printed_sizes
from fmu_bearing.scene.read import catalogue
from fmu_bearing.scene.units import symbol

SCENES = Path(__file__).parents[2] / "examples" / "scenes"


def scene():
    """Every table of a scene file, and what the catalogue knows."""
    return "\n".join(["## Top level", "", *_table_of(Scene, ""), *_catalogue()])


def _table_of(model, path):
    """Lines for one table of a scene file and for the tables within it."""
    rows, nested = [], []
    for key, field in model.model_fields.items():
        inner, many = _inner(field.annotation)
        if inner is not None:
            nested.append((f"{path}.{key}" if path else key, inner, many, field))
            continue
        default = "required" if field.is_required() else _value(field.default)
        cells = (f"`{key}`", _unit(key, field), _range(field), default, _sentence(key, field))
        rows.append(_row(cells))
    lines = [_row(("key", "unit", "range", "default", "what")), _row(["---"] * 5), *rows, ""] if rows else []
    for where, inner, many, field in nested:
        brackets = f"[[{where}]]" if many else f"[{where}]"
        needed = "Required. " if field.is_required() else ""
        lines += [f"## `{brackets}`", "", f"{needed}{field.description or ''} {_summary(inner)}".strip(), ""]
        lines += _table_of(inner, where)
    return lines


def _summary(model):
    """First paragraph of a model's docstring."""
    text = (model.__doc__ or "").strip().split("\n\n")[0]
    return " ".join(text.split()).replace("``", "`")


def _inner(annotation):
    """Return the model inside an annotation, and whether there may be many of it."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation, False
    many = typing.get_origin(annotation) is tuple
    for part in typing.get_args(annotation):
        found, several = _inner(part)
        if found is not None:
            return found, many or several
    return None, False


def _unit(key, field):
    if symbol(key):
        return symbol(key)
    kinds = _kinds(field.annotation)
    if bool in kinds:
        return "true/false"
    return "text" if str in kinds else "-"


def _kinds(annotation):
    """Plain types inside an annotation; a choice of words counts as text."""
    if typing.get_origin(annotation) is typing.Literal:
        return {type(word) for word in typing.get_args(annotation)}
    if isinstance(annotation, type):
        return {annotation} - {types.NoneType}
    return set().union(*map(_kinds, typing.get_args(annotation)))


def _range(field):
    words = [word for word in typing.get_args(field.annotation) if isinstance(word, str)]
    if typing.get_origin(field.annotation) is typing.Literal:
        return ", ".join(f'`"{word}"`' for word in words)
    limits = field.metadata + [
        item
        for part in typing.get_args(field.annotation)
        if typing.get_origin(part) is typing.Annotated
        for extra in part.__metadata__
        for item in getattr(extra, "metadata", [])
    ]
    low = next((item.ge for item in limits if hasattr(item, "ge")), None)
    high = next((item.le for item in limits if hasattr(item, "le")), None)
    if low is None or high is None:
        return ""
    numbers = f"{low:,.10g} to {high:,.10g}"
    return f"list, each {numbers}" if typing.get_origin(field.annotation) is tuple else numbers


def _value(default):
    if default is None:
        return "absent"
    if isinstance(default, bool):
        return f"`{str(default).lower()}`"
    if isinstance(default, tuple):
        return f"`{list(default)}`"
    return f'`"{default}"`' if isinstance(default, str) else f"`{default:g}`"


def _sentence(key, field):
    """Sentence of a key without the unit at its end, which has a column of its own."""
    text = field.description or ""
    unit = symbol(key)
    return text.removesuffix(f", {unit}.") + "." if unit and text.endswith(f", {unit}.") else text


_SIZES = "The sizes of NSK have [a table of their own](sizes.md#sizes-with-a-makers-figures)."


def sizes():
    """Sizes with a maker's figures, one a row; what is derived is in italics."""
    heads = ("name", "d, D, B, mm", "C, C0, N", "f0", "n, r/min", "m, kg", *CLASSES, "balls, mm", "C, C0, %")
    lines = [_row(heads), _row(["---"] * len(heads))]
    for name, size in printed_sizes().items():
        shape = (size.balls, size.ball, size.pitch, math.radians(size.angle))
        errors = (dynamic_rating(*shape) / size.dynamic, static_rating(*shape) / size.static)
        cells = (
            f"`{name}`",
            f"{size.bore:g}, {size.outside:g}, {size.width:g}",
            f"{size.dynamic:g}, {size.static:g}",
            "" if math.isnan(size.f0) else f"{size.f0:g}",
            f"{size.grease_speed:g}, {size.oil_speed:g}",
            f"{size.mass:g}",
            *(f"{one.force:g}" for one in size.preload.values()),
            f"*{size.balls} x {size.ball:g}*",
            "*" + ", ".join(f"{100.0 * (error - 1.0):+.1f}" for error in errors) + "*",
        )
        lines.append(_row(cells))
    return "\n".join(lines)


def exclusions():
    """List what a scene cannot have, with the reason and the way out."""
    lines = [_row(("scene", "cannot have", "because", "way round")), _row(["---"] * 4)]
    for one in EXCLUSIONS:
        kind = f"{one.kind.name[0].upper()}{one.kind.name[1:]}"
        lines.append(_row((kind, one.all, one.reason, one.way_out)))
    return "\n".join(lines)


def _catalogue():
    lines = ["## Catalogue", ""]
    for kind, where in (
        ("bearings", '`[bearing] catalogue = "7003C"`'),
        ("materials", '`[materials] balls = "Si3N4"`'),
        ("lubricants", '`[lubricant] catalogue = "spindle-oil"`'),
        ("grades", '`[imperfections] grade = "P4"`'),
    ):
        # makers' sizes are too many for columns: `sizes` lists them
        entries = {name: entry for name, entry in catalogue(kind).items() if not name.startswith(PREFIX)}
        keys = [key for key, value in next(iter(entries.values())).items() if not isinstance(value, dict)]
        more = f" {_SIZES}" if kind == "bearings" else ""
        lines += [f"### {kind.capitalize()}", "", f"{where}; keys written beside it win.{more}", ""]
        lines += [_row(("key", *entries)), _row(["---"] * (1 + len(entries)))]
        lines += [_row((f"`{key}`", *(f"{e.get(key, '')}" for e in entries.values()))) for key in keys]
        lines.append("")
    return lines


#: The group of what only sets have, and how its names begin.
_SETS, _OF_SETS = (
    "Sets of bearings on one shaft",
    ("nose.", "shaft.", "housing.", "bearing[", "port."),
)
_AT_RACES = ("contact.", "film.", "stiffness.", "fit.")
#: Heading, then what a variable of that group must satisfy; the first group that fits takes it.
GROUPS = (
    ("Inputs", lambda v: v.causality == "input"),
    ("Parameters", lambda v: v.causality == "parameter"),
    ("Outputs: torque and heat", lambda v: v.causality == "output" and v.unit in ("N.m", "W")),
    ("Outputs: sound", lambda v: v.causality == "output" and v.name.startswith("mic[")),
    ("Outputs: local defects", lambda v: v.causality == "output" and v.name.startswith("defect[")),
    ("Outputs: motion", lambda v: v.causality == "output"),
    ("Constants: how the model was built", lambda v: v.variability == "constant"),
    ("Local: sound by component and type of motion", lambda v: v.name.startswith("mic[")),
    ("Local: contacts, fits, film, stiffness", lambda v: v.name.startswith(_AT_RACES)),
    ("Local: places, cage, shares of torque, solver", lambda v: True),
)

#: What differs between variables of one kind: in the name, and in the sentence.
_INDICES = (
    (r"bearing\[\d+\]", "bearing[b]", r"Bearing \d+", "Bearing b"),
    (r"ball\[\d+\]", "ball[i]", r"ball \d+", "ball i"),
    (r"mic\[\d+\]", "mic[k]", r"microphone [^,;]+", "microphone k"),
    (r"third_octave\[\d+\]", "third_octave[f]", r"around [\d.]+ Hz", "around f Hz"),
    (r"flexure\.n\d+", "flexure.n*", r"of order \d+", "of order *"),
    (r"defect\[\d+\]", "defect[k]", r": (spall|pit|dent|scratch) .*", ""),
)


def shown(name):
    """Name of the row in which a variable is shown."""
    for pattern, index, _, _ in _INDICES:
        name = re.sub(pattern, index, name)
    return name


def fmu():
    """Every variable of an FMU, grouped; one row stands for all balls, microphones, bands, orders."""
    groups = {title: {} for title in (*dict(GROUPS), _SETS)}
    for variable in all_variables():
        title = _SETS
        if not variable.name.startswith(_OF_SETS):
            title = next(title for title, fits in GROUPS if fits(variable))
        name, sentence = shown(variable.name), variable.description
        for in_name, _, in_sentence, words in _INDICES:
            if re.search(in_name, variable.name):
                sentence = re.sub(in_sentence, words, sentence)
        groups[title].setdefault(name, (variable, sentence))
    lines = []
    for title, rows in groups.items():
        lines += [f"## {title}", "", _row(("name", "causality", "unit", "range", "what")), _row(["---"] * 5)]
        for name, (variable, sentence) in rows.items():
            kind = "constant" if variable.variability == "constant" else variable.causality
            unit = variable.unit or ("-" if variable.type == "Real" else variable.type)
            lines.append(_row((f"`{name}`", kind, unit, range_of(variable), sentence)))
        lines.append("")
    return "\n".join(lines)


def all_variables():
    """Variables of scenes that have everything: third octaves, bending, fits, defects, clearance, a set.

    Of the set those that no single bearing has.
    """
    spindle = read_scene(SCENES / "7003C-spindle.toml")
    spindle = spindle.model_copy(update={"sound": spindle.sound.model_copy(update={"third_octaves": True})})
    bending = read_scene(SCENES / "7009C-full-ceramic.toml")
    seats = {"shaft": ("interference_um", 2.0), "housing": ("interference_um", -4.0)}
    fitted = spindle.replace(
        {"mounting.fit": {k: {key: value, "temperature_degC": 40.0} for k, (key, value) in seats.items()}}
        | {"mounting.fit.housing.outside_diameter_mm": 60.0}
    )
    deep_groove = read_scene(SCENES / "6205-outer-spall.toml")
    scenes = spindle, fitted, bending, deep_groove
    single = [one for scene in scenes for one in variables(scene, 0.0)]
    names = {variable.name for variable in single}
    sets = {one.name: one for found in any_sets(spindle) for one in variables(found, 0.0)}
    return [*single, *(one for name, one in sets.items() if name.split("].", 1)[-1] not in names)]


def commands():
    """Every command with its arguments and options, from the application itself."""
    command = typer.main.get_command(app)
    text = get_docs_for_click(obj=command, ctx=typer.Context(command), name="fmu-bearing")
    text = text[text.index("\n## ") :]
    return re.sub(r"(?<!`)<(\w+)>(?![^\n]*`)", r"`<\1>`", text)


def names():
    """Every public name of the package, described by its docstring."""
    places = fmu_bearing._PLACES
    return "\n\n".join(f"::: fmu_bearing.{places[name]}.{name}" for name in fmu_bearing.__all__)


def _row(cells):
    return "| " + " | ".join(str(cell).replace("|", "\\|") for cell in cells) + " |"
