"""Error messages about a scene: one line per problem, with the keys and values of the file."""

import itertools
import types
import typing
from collections.abc import Iterable, Iterator, Mapping
from typing import Any, get_args

from pydantic import BaseModel, ValidationError
from pydantic.fields import FieldInfo

from fmu_bearing.formulas.tolerances import HOUSING_CLASSES, SHAFT_CLASSES
from fmu_bearing.likeness import nearest
from fmu_bearing.scene.base import LABEL
from fmu_bearing.scene.mounting import SUPPORTS
from fmu_bearing.scene.scene import NAME, Tables
from fmu_bearing.scene.seats import HOUSING_CLASS, SHAFT_CLASS
from fmu_bearing.scene.spindle import OR_CLASS
from fmu_bearing.scene.units import symbol
from fmu_bearing.scene.values import limits, table_of

Location = tuple[Any, ...]

#: Sources from which a table can take its values.
_SOURCES = {
    "bearing": 'catalogue = "7003C"',
    "lubricant": 'catalogue = "spindle-oil"',
    "imperfections": 'grade = "P4"',
}
#: What may be in the place of a key.
_INSTEAD = {("mounting", "preload_N"): OR_CLASS}
#: Keys that are in no source.
_OWN = {"seed", "ball_springs", "seal", "inner_race_harmonic", "outer_race_harmonic", "defect"}
_TEXTS = {
    LABEL: "text of 1 to 40 letters, digits, blanks and . , + - ( ) / _",
    NAME: "text of 1 to 60 letters, digits, blanks and . _ -, a letter or digit first",
    SHAFT_CLASS: f"{', '.join(SHAFT_CLASSES)}; or give interference_um",
    HOUSING_CLASS: f"{', '.join(HOUSING_CLASSES)}; or give interference_um",
}
_TEXT = 60  # longest value worth repeating
_MOST = 20  # problems listed one by one
#: Keys that are replaced by values before tables are checked.
_RESOLVED: dict[Location, tuple[str, ...]] = {
    (): ("catalogues",),
    ("bearing",): ("catalogue",),
    ("lubricant",): ("catalogue",),
    ("imperfections",): ("grade", "surface"),
    ("mounting",): ("preload_class", "preload_offset_um"),
    ("spindle", "preload"): ("preload_class", "preload_offset_um"),
}
#: Tables that one bearing of a set may have of its own.
OWN_TABLES = (("spindle", "bearing", "bearing"), ("spindle", "bearing", "materials"))
_HOMES = 3  # tables that are named where a key could belong
#: What a set has in place of keys of a single bearing's mounting, and the reverse.
_COUNTERPARTS = {
    ("mounting", "preload_N"): ("spindle", "preload", "preload_N"),
    ("mounting", "radial_load_y_N"): ("spindle", "load", "force_y_N"),
    ("mounting", "radial_load_z_N"): ("spindle", "load", "force_z_N"),
    ("mounting", "pedestal_stiffness_N_m"): ("spindle", "housing", "pedestal_stiffness_N_m"),
    ("mounting", "rotor"): ("spindle", "shaft"),
    **{("mounting", key): ("spindle", key) for key in SUPPORTS},
}
_FORCE_X = ("spindle", "load", "force_x_N")  # a single bearing's axial force is its preload


def explain(failure: ValidationError, data: dict[str, Any], skip: Iterable[Location] = ()) -> Iterator[str]:
    """Yield one line per problem that pydantic found in ``data``, none for tables under ``skip``.

    Beyond the first `_MOST` problems a last line gives the number of the others: a file of another program
    may have thousands, and each search for a likely key takes a millisecond.
    """
    skipped = tuple(skip)
    errors = [
        error
        for error in failure.errors(include_url=False)
        if not any(tuple(error["loc"])[: len(prefix)] == prefix for prefix in skipped)
    ]
    found = _lines(errors, data)
    yield from dict.fromkeys(itertools.islice(found, _MOST))
    every = sum(len(error["ctx"]["conflicts"]) if error["type"] == "conflict" else 1 for error in errors)
    if every > _MOST:
        yield f"and {every - _MOST} more problems, which are listed once these {_MOST} are corrected"


def _lines(errors: Iterable[Any], data: dict[str, Any]) -> Iterator[str]:
    """Yield one line per problem."""
    for error in errors:
        path: Location = tuple(error["loc"])
        if error["type"] == "conflict":
            for conflict in error["ctx"]["conflicts"]:
                place = path + tuple(conflict.key.split(".") if conflict.key else ())
                yield _conflict(place, conflict.reason, data)
        elif error["type"] == "missing":
            yield missing(path)
        elif error["type"] == "extra_forbidden":
            yield _unknown(path, data)
        else:
            yield (
                f"{dotted(path)} = {shown(error['input'])} is refused; allowed: {allowed(path)}"
                f"{_quotes(error, path)}"
            )


def _quotes(error: Any, path: Location) -> str:
    """Say that a number or truth value is in quotes, or that text lacks them."""
    value, kind = error["input"], error["type"]
    if isinstance(value, str) and kind in ("float_type", "int_type", "bool_type"):
        if value in ("true", "false") if kind == "bool_type" else _is_number(value):
            key = f"{path[-1]} = " if isinstance(path[-1], str) else ""  # none of a member of an array
            return f"; it is text, as it is in quotes: write {key}{value}"
        return "; it is text, no truth value" if kind == "bool_type" else "; it is text, no number"
    if kind in ("string_type", "literal_error") and isinstance(value, int | float):
        return "; it is a number, and text in quotes is due"
    return ""


def _is_number(text: str) -> bool:
    try:
        float(text)
    except ValueError:
        return False
    return True


def dotted(path: Location) -> str:
    """Write a location as a file has it; members of an array count from 1, like ``mic[1]``."""
    steps = (f"[{step + 1}]" if isinstance(step, int) else f".{_short(step)}" for step in path)
    return "".join(steps).removeprefix(".")


def _short(text: str) -> str:
    """Write text in one line, shortened where it would drown the message."""
    if not text.isprintable():  # a line break in a value or key must not break the one line
        text = text.encode("unicode_escape").decode("ascii")
    return text if len(text) <= _TEXT else f"{text[: _TEXT - 3]}..."


def shown(value: Any) -> str:
    """Write a value as TOML has it, shortened where it would drown the message."""
    if isinstance(value, dict):
        return "a table"
    if isinstance(value, list | tuple):
        return "an array"
    if isinstance(value, bool):
        return str(value).lower()
    return _short(f"'{value}'" if isinstance(value, str) else str(value))


def described(value: Any) -> str:
    """Write an object that is of a wrong type: its type, and its value where that is short."""
    kind = f"of type {type(value).__name__}"
    return str(value) if value is None else f"{shown(value)} ({kind})"


def allowed(path: Location) -> str:
    """Say what the key at a location may hold, with its unit."""
    field = _field(path)
    if field is None and path and isinstance(path[-1], int):
        return allowed(path[:-1])  # a member of an array of numbers
    if field is None:
        return "a table"
    whole = field.annotation
    kinds = [kind for kind in get_args(whole) if kind is not type(None)]
    kind = kinds[0] if typing.get_origin(whole) in (typing.Union, types.UnionType) else whole
    if typing.get_origin(kind) is typing.Literal:
        return ", ".join(str(choice) for choice in get_args(kind))
    if typing.get_origin(kind) is tuple:
        most = [rule.max_length for rule in field.metadata if hasattr(rule, "max_length")]
        member = get_args(kind)[0]
        if typing.get_origin(get_args(member)[0] if get_args(member) else member) is tuple:
            return f"1 to {most[0]} lists [length, diameter, bore], {symbol(str(path[-1]))}"
        if typing.get_origin(member) is typing.Annotated:
            numbers = _range(get_args(member)[1], str(path[-1]))
            return f"at most {most[0]} whole numbers from {numbers}"
        if member is str:
            return f"a list of at most {most[0]} names in quotes"
        return f"at most {most[0]} tables [[{dotted(path)}]]"
    if kind is bool:
        return "true or false"
    if kind is str:
        patterns = [rule.pattern for rule in field.metadata if hasattr(rule, "pattern")]
        return _TEXTS[patterns[0]] if patterns else "the name of a file"
    if kind in (int, float):
        return _range(field, str(path[-1])) + (", whole numbers only" if kind is int else "")
    names = ", or the name of a catalogue entry" if is_material(path) else ""
    return f"a table [{dotted(path)}]{names}"


def too_long(tables: dict[str, Any], path: Location = ()) -> Iterator[tuple[Location, str]]:
    """Take out arrays longer than their keys allow; yield where each was, and a line about it.

    All members would be checked, one after the other: seconds, where there are very many.
    """
    for key, value in tables.items():
        here = (*path, key)
        if isinstance(value, dict):
            yield from too_long(value, here)
        elif isinstance(value, list | tuple) and (field := _field(here)) is not None:
            most = [rule.max_length for rule in field.metadata if hasattr(rule, "max_length")]
            if most and len(value) > most[0]:
                tables[key] = False  # no array at all: what depends on its members is not checked
                yield here, f"{dotted(here)} has {len(value)} members; allowed: {allowed(here)}"


def is_material(path: Location) -> bool:
    """Whether a material is there, which a catalogue entry can name."""
    return path[0] == "materials" or "materials" in path[:-1] or path[-1] == "material"


def _range(field: FieldInfo, key: str) -> str:
    low, high = limits(field)
    return f"{_number(low)} to {_number(high)} {symbol(key)}".rstrip()


def _number(value: float) -> str:
    return str(value) if isinstance(value, int) else f"{value:g}"


def _conflict(path: Location, reason: str, data: dict[str, Any]) -> str:
    value: Any = data
    for step in path:
        try:
            value = value[step]
        except (KeyError, IndexError, TypeError):
            return f"{dotted(path)} {reason}"
    if value is None:  # taken out by `Scene.replace`, or never given
        return f"{dotted(path)} {reason}"
    if isinstance(value, dict | list | tuple):
        return f"{dotted(path)}: {reason}"
    return f"{dotted(path)} = {shown(value)} {reason}"


def missing(path: Location) -> str:
    """Say that a key or a table is missing, and what it holds."""
    if isinstance(path[-1], int):
        return f"{dotted(path)} is missing; allowed: {allowed(path)}"
    field, key = _field(path), path[-1]
    model = table_of(None if field is None else field.annotation)
    if field is None or (model is not None and not field.examples):
        keys = ", ".join(model.model_fields) if model is not None else ""
        source = _SOURCES.get(str(key)) if len(path) == 1 else None
        hint = f", or {source}" if source else ""
        return f"{dotted(path)} is missing: the table [{dotted(path)}] with {keys}{hint}"
    example = field.examples[0] if field.examples else ""
    value = f'"{example}"' if isinstance(example, str) else shown(example)
    source = _SOURCES.get(str(path[0])) if len(path) > 1 and not _OWN & set(path) else None
    hint = f"; or take all from {source}" if source else f"; {_INSTEAD[path]}" if path in _INSTEAD else ""
    return f"{dotted(path)} is missing, for example {key} = {value} ({field.description}){hint}"


def _unknown(path: Location, data: Mapping[str, Any]) -> str:
    key, table = str(path[-1]), path[:-1]
    model = _model_at(table)
    known = list(model.model_fields) if model is not None else []
    like = table[-1:] if _plain(table) in OWN_TABLES else table
    known += ("catalogue",) if table[:1] == ("materials",) else _RESOLVED.get(like, ())
    is_set = data.get("spindle") is not None or table[:1] == ("spindle",)
    other = "mounting" if is_set else "spindle"
    homes = [
        (where, one)
        for where, one in _tables(Tables)
        if where not in (table, _plain(table)) and where[:3] not in OWN_TABLES  # like those of all bearings
    ]
    mine = [(where, one) for where, one in homes if where[:1] != (other,)]
    elsewhere = any("fit" not in where and key in one.model_fields for where, one in homes)
    exact = [
        where
        for where, one in mine
        if (key in one.model_fields or key in _RESOLVED.get(where, ())) and (*where, key) != (other,)
        if not ("fit" in where and elsewhere)  # a seat has names of other tables, as material
    ]
    if 1 <= len(exact) <= _HOMES:
        hint = f"; it belongs in {' or '.join(_place(where, key) for where in exact)}"
        hint = hint if exact[0] else "; it is written above all tables"
    elif near := nearest(key, known):
        hint = f"; did you mean '{near}'?"
    elif hint := _of_others(
        key,
        is_set,
        [where for where, one in homes if where and key in one.model_fields and "fit" not in where],
    ):
        pass
    elif away := nearest(key, [name for _, one in mine for name in one.model_fields if "_" in name]):
        where = next(where for where, one in mine if away in one.model_fields)
        hint = f"; did you mean {away} in [{dotted(where)}]?" if where else f"; did you mean '{away}'?"
    else:
        hint = f"; known here: {', '.join(known)}"
    return f"{dotted(path)} is not a key of a scene{hint}"


def _plain(path: Location) -> Location:
    """Return a location without places in arrays."""
    return tuple(step for step in path if not isinstance(step, int))


def _place(where: Location, key: str) -> str:
    """Return the table a key belongs in; of a table, the table itself."""
    field = _field((*where, key))
    if field is None or table_of(field.annotation) is None or is_material((*where, key)):
        return f"[{dotted(where)}]"
    name = dotted((*where, key))
    many = any(typing.get_origin(kind) is tuple for kind in (field.annotation, *get_args(field.annotation)))
    return f"[[{name}]]" if many else f"[{name}]"


def _of_others(key: str, is_set: bool, homes: list[Location]) -> str:
    """Return what such a scene has in place of a key that only scenes of the other kind have."""
    if not homes:
        return ""
    ways = (
        {own: other for own, other in _COUNTERPARTS.items()}
        if is_set
        else {other: own for own, other in _COUNTERPARTS.items()}
        | {_FORCE_X: ("mounting", "preload_N"), ("spindle", "preload"): ("mounting", "preload_N")}
    )
    kind = "a set on one shaft" if is_set else "one bearing"
    for where in homes:
        if found := ways.get((*where, key)):
            return f"; {kind} has {_key(found)}"
    others = "one bearing" if is_set else "a set on one shaft"
    return f"; it is of [{dotted(homes[0])}], which {others} has, and this scene is of {kind}"


def _key(path: Location) -> str:
    """Return a key and its table; of a table, the table."""
    field = _field(path)
    if field is not None and table_of(field.annotation) is not None:
        return f"[{dotted(path)}]"
    return f"{path[-1]} in [{dotted(path[:-1])}]"


def _tables(model: type[BaseModel], path: Location = ()) -> Iterator[tuple[Location, type[BaseModel]]]:
    yield path, model
    for key, field in model.model_fields.items():
        inner = table_of(field.annotation)
        if inner is not None:
            yield from _tables(inner, (*path, key))


def _field(path: Location) -> FieldInfo | None:
    model = _model_at(path[:-1])
    return None if model is None or not path else model.model_fields.get(str(path[-1]))


def _model_at(path: Location) -> type[BaseModel] | None:
    model: type[BaseModel] | None = Tables
    for step in path:
        if isinstance(step, int):
            continue  # a member of an array has the model of the array
        field = model.model_fields.get(step) if model is not None else None
        model = None if field is None else table_of(field.annotation)
    return model
