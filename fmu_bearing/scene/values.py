"""Values of a scene by dotted key, such as ``mounting.preload_N`` or ``sound.microphone[1].y_mm``."""

import re
from collections.abc import Iterator, Mapping
from typing import Any, get_args

from pydantic import BaseModel
from pydantic.fields import FieldInfo

from fmu_bearing.scene import Scene

_STEP = re.compile(r"(\w+)(?:\[(\d+)\])?")


class NoSuchPlace(ValueError):
    """A dotted key whose table the scene does not have."""


def value_at(scene: Scene, key: str) -> Any:
    """Value at a dotted key of a scene; None where the scene has no such table or value."""
    part: Any = scene
    for name, place in steps(key):
        part = getattr(part, name, None)
        if place is not None and part is not None:
            part = part[place] if place < len(part) else None
    return part


def replaced(scene: Scene, values: Mapping[str, Any]) -> dict[str, Any]:
    """Return the scene as nested tables, with other values at dotted keys; nothing is checked.

    Raises
    ------
    NoSuchPlace
        Where the scene has no table for a key.
    """
    data = scene.model_dump()
    for key, value in values.items():
        *tables, (last, _) = steps(key)
        part: Any = data
        for name, place in tables:
            part = part.get(name)
            if place is not None and part is not None:
                part = part[place] if place < len(part) else None
            if part is None:
                table = key.rpartition(".")[0]
                raise NoSuchPlace(f"{key}: the scene has no table [{table}]; add it to vary what it holds")
        part[last] = value
    return data


def fields_of(scene: Scene) -> dict[str, FieldInfo]:
    """Return every dotted key that a scene may have, with its pydantic field; tables are left out."""
    return dict(_fields(type(scene), scene, ""))


def _fields(model: type[BaseModel], part: Any, prefix: str) -> Iterator[tuple[str, FieldInfo]]:
    for name, field in model.model_fields.items():
        value = getattr(part, name, None)
        table = _table(field.annotation)
        if table is None:
            yield prefix + name, field
        elif isinstance(value, tuple):
            for place, member in enumerate(value, start=1):
                yield from _fields(table, member, f"{prefix}{name}[{place}].")
        else:
            yield from _fields(table, value, f"{prefix}{name}.")


def _table(annotation: Any) -> type[BaseModel] | None:
    """Return the table that an annotation is, may be, or is an array of."""
    if isinstance(annotation, type) and issubclass(annotation, BaseModel):
        return annotation
    return next((found for part in get_args(annotation) if (found := _table(part)) is not None), None)


def steps(key: str) -> list[tuple[str, int | None]]:
    """Names along a dotted key, each with its place (from 0) where it is a member of an array."""
    steps = []
    for text in key.split("."):
        match = _STEP.fullmatch(text)
        name, place = (match[1], match[2]) if match else (text, None)
        steps.append((name, None if place is None else int(place) - 1))
    return steps
