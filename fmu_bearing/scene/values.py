"""Values of a scene by dotted key, such as ``mounting.preload_N`` or ``sound.microphone[1].y_mm``."""

import math
import os
import re
from collections.abc import Iterator, Mapping, Sequence
from typing import Any, get_args

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from fmu_bearing.scene.scene import Tables

_STEP = re.compile(r"(\w+)(?:\[(\d+)\])?")


def value_at(scene: Tables, key: str) -> Any:
    """Value at a dotted key of a scene; None where the scene has no such table or value."""
    part: Any = scene
    for name, place in steps(key):
        part = getattr(part, name, None)
        if place is not None and part is not None:
            part = part[place] if place < len(part) else None
    return part


def put(data: dict[str, Any], values: Mapping[str, Any]) -> list[str]:
    """Put values at dotted keys into the nested tables of a scene; return a line for each that has no place.

    A table that is not there is made, as a file makes it by its first key: the check of the scene reports
    what it lacks, or that there is no such table.
    """
    problems = []
    for key, value in values.items():
        try:
            _put(data, key, value)
        except LookupError as problem:
            problems.append(problem.args[0])
    return problems


def table_at(data: Any, tables: Sequence[str]) -> Any:
    """Return the table of a scene's nested ones under names as in dotted keys; None: there is none."""
    for text in tables:
        name, place = steps(text)[0]
        data = data.get(name) if isinstance(data, dict) else None
        if place is not None:
            data = data[place] if isinstance(data, list | tuple) and 0 <= place < len(data) else None
    return data


def _put(data: dict[str, Any], key: str, value: Any) -> None:
    """Put one value; ``LookupError`` says why there is no place for it."""
    *tables, (last, place) = steps(key)
    part: Any = data
    path = ""
    for name, member in tables:
        if part.get(name) is None:
            part[name] = {}
        inner = part[name]
        path = f"{path}.{name}".lstrip(".")
        if member is not None:
            inner = _member(inner, member, key, path)
        if not isinstance(inner, dict):
            raise LookupError(f"{key} is not a key of a scene; {path} is {_kind(inner)}")
        part = inner
    if place is None:
        part[last] = value
        return
    path = f"{path}.{last}".lstrip(".")
    _member(part.get(last), place, key, path)
    part[last] = [*part[last][:place], value, *part[last][place + 1 :]]


def _member(array: Any, place: int, key: str, path: str) -> Any:
    """Member of an array; ``LookupError`` where there is none."""
    if not isinstance(array, list | tuple):
        raise LookupError(f"{key} is not a key of a scene; {path} is not an array")
    if place < 0:
        raise LookupError(f"{key}: members of [{path}] are counted from 1, the first one is [1]")
    if not place < len(array):
        raise LookupError(f"{key}: [{path}] has {len(array)} members; give the whole array to lengthen it")
    return array[place]


def _kind(value: Any) -> str:
    """Return what is in a table's place, in words."""
    return "an array: name a member, as in [1]" if isinstance(value, list | tuple) else "a value, no table"


def plain(value: Any) -> Any:
    """Return a value as TOML gives it: dictionaries, lists, texts, numbers; nothing of the original is kept.

    Parts of scenes, arrays and numbers of NumPy, and paths are turned into these.
    """
    if isinstance(value, BaseModel):
        return value.model_dump()
    if isinstance(value, Mapping):
        return {key: plain(member) for key, member in value.items()}
    if isinstance(value, list | tuple):
        return [plain(member) for member in value]
    if hasattr(value, "tolist"):
        return value.tolist()
    return os.fspath(value) if isinstance(value, os.PathLike) else value


def flat(scene: Tables) -> dict[str, Any]:
    """Return every value of a scene by its dotted key; what is not given is left out."""
    return dict(_flat(scene.model_dump(mode="json", exclude_none=True), ""))


def _flat(table: Mapping[str, Any], path: str) -> Iterator[tuple[str, Any]]:
    for key, value in table.items():
        dotted = f"{path}.{key}".lstrip(".")
        if isinstance(value, Mapping):
            yield from _flat(value, dotted)
        elif value == []:
            continue  # nothing is given there
        elif isinstance(value, list) and isinstance(value[0], Mapping):
            for k, member in enumerate(value):
                yield from _flat(member, f"{dotted}[{k + 1}]")
        else:
            yield dotted, value


def fields_of(scene: Tables) -> dict[str, FieldInfo]:
    """Return every dotted key that a scene may have, with its pydantic field; tables are left out."""
    return dict(_fields(type(scene), scene, ""))


def _fields(model: type[BaseModel], part: Any, prefix: str) -> Iterator[tuple[str, FieldInfo]]:
    for name, field in model.model_fields.items():
        value = getattr(part, name, None)
        table = table_of(field.annotation)
        if table is None:
            yield prefix + name, field
        elif isinstance(value, tuple):
            for place, member in enumerate(value, start=1):
                yield from _fields(table, member, f"{prefix}{name}[{place}].")
        else:
            yield from _fields(table, value, f"{prefix}{name}.")


def table_of(annotation: Any) -> type[BaseModel] | None:
    """Return the table that an annotation is, may be, or is an array of."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((found for part in get_args(annotation) if (found := table_of(part)) is not None), None)


def limits(field: FieldInfo) -> tuple[float, float]:
    """Return the least and the largest number that a field may hold, infinite where it has no limit."""
    low = next((rule.ge for rule in field.metadata if hasattr(rule, "ge")), -math.inf)
    high = next((rule.le for rule in field.metadata if hasattr(rule, "le")), math.inf)
    return low, high


def steps(key: str) -> list[tuple[str, int | None]]:
    """Names along a dotted key, each with its place (from 0) where it is a member of an array."""
    steps = []
    for text in key.split("."):
        match = _STEP.fullmatch(text)
        name, place = (match[1], match[2]) if match else (text, None)
        steps.append((name, None if place is None else int(place) - 1))
    return steps
