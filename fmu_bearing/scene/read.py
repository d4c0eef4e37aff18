"""From a TOML file to a scene, or to an error that names file, key, value, range and the way out."""

import difflib
import tomllib
from importlib import resources
from pathlib import Path
from typing import Any, Union, get_args, get_origin

from pydantic import BaseModel, ValidationError

from fmu_bearing.scene.scene import Scene


class SceneError(ValueError):
    """A scene cannot be used; one line per problem."""


def catalogue(kind: str) -> dict[str, Any]:
    """Catalogue of ``bearings``, ``materials`` or ``lubricants``: name to values."""
    text = resources.files("fmu_bearing.scene").joinpath("catalogue", f"{kind}.toml").read_text("utf-8")
    return tomllib.loads(text)


def read_scene(path: str | Path) -> Scene:
    """Read a scene file; ``SceneError`` tells what is wrong with it."""
    try:
        text = Path(path).read_text("utf-8")
    except FileNotFoundError:
        raise SceneError(f"{path}: there is no such scene file") from None
    except (OSError, UnicodeDecodeError) as problem:
        raise SceneError(f"{path}: cannot be read as text: {problem}") from None
    return read_scene_text(text, str(path))


def read_scene_text(text: str, name: str = "scene") -> Scene:
    """Read a scene from TOML text; ``name`` stands for the file in messages."""
    try:
        data = tomllib.loads(text)
    except tomllib.TOMLDecodeError as problem:
        raise SceneError(f"{name}: not valid TOML: {problem}") from None
    _resolve(data, name)
    try:
        return Scene.model_validate(data, strict=False)
    except ValidationError as problem:
        lines = [f"{name}: {_explain(error, data)}" for error in problem.errors()]
        raise SceneError("\n".join(dict.fromkeys(lines))) from None


def _choose(name: str, where: str, given: Any, kind: str) -> dict[str, Any]:
    entries = catalogue(kind)
    if not isinstance(given, str) or given not in entries:
        near = difflib.get_close_matches(str(given), entries, n=1, cutoff=0.0)
        hint = f"did you mean '{near[0]}'? " if near else ""
        raise SceneError(
            f"{name}: {where} = {given!r} is not in the catalogue; {hint}known: {', '.join(entries)}"
        )
    return dict(entries[given])


def _resolve(data: dict[str, Any], name: str) -> None:
    """Replace catalogue names by their values; keys given in the file win."""
    for table, kind in (("bearing", "bearings"), ("lubricant", "lubricants")):
        part = data.get(table)
        if isinstance(part, dict) and "catalogue" in part:
            entry = _choose(name, f"{table}.catalogue", part.pop("catalogue"), kind)
            if isinstance(part.get("cage"), dict):
                part["cage"] = {**entry.get("cage", {}), **part["cage"]}
            data[table] = {**entry, **part}
    materials = data.get("materials")
    if isinstance(materials, dict):
        for key, value in materials.items():
            if isinstance(value, str):
                materials[key] = _choose(name, f"materials.{key}", value, "materials")


def _model_at(path: tuple[Any, ...]) -> type[BaseModel] | None:
    """Model class of the table at a location, as far as it can be followed."""
    model: Any = Scene
    for step in path:
        if isinstance(step, int):
            continue
        field = getattr(model, "model_fields", {}).get(step)
        if field is None:
            return None
        model = field.annotation
        while get_origin(model) is not None:
            choices = [a for a in get_args(model) if a not in (type(None), Ellipsis)]
            if get_origin(model) not in (Union, tuple) and not hasattr(model, "__args__"):
                return None
            model = choices[0]
    return model if isinstance(model, type) and issubclass(model, BaseModel) else None


def _range(model: type[BaseModel] | None, key: Any) -> str:
    """Say what a key may hold, in the unit of its name."""
    field = None if model is None else model.model_fields.get(key)
    if field is None:
        return ""
    bounds = {}
    for rule in field.metadata:
        for name in ("ge", "gt", "le", "lt"):
            if hasattr(rule, name):
                bounds[name[0]] = getattr(rule, name)
    if len(bounds) == 2:
        return f"allowed: {bounds['g']:g} to {bounds['l']:g}"
    choices = get_args(field.annotation)
    if choices and all(isinstance(c, str | int) for c in choices):
        return "allowed: " + ", ".join(str(c) for c in choices)
    return ""


def _explain(error: Any, data: dict[str, Any]) -> str:
    """One pydantic error in the user's terms."""
    path = tuple(error["loc"])
    key = ".".join(f"[{p + 1}]" if isinstance(p, int) else str(p) for p in path).replace(".[", "[")
    model = _model_at(path[:-1])
    kind = error["type"]
    if kind == "missing":
        field = model.model_fields.get(path[-1]) if model else None
        example = f", for example {path[-1]} = {field.examples[0]!r}" if field and field.examples else ""
        return f"{key} is missing{example}"
    if kind == "extra_forbidden":
        near = difflib.get_close_matches(str(path[-1]), model.model_fields if model else [], n=1, cutoff=0.3)
        hint = f"; did you mean '{near[0]}'?" if near else ""
        known = ", ".join(model.model_fields) if model else ""
        return f"{key} is not a key of a scene{hint}" + ("" if near else f"; known here: {known}")
    if kind == "value_error":
        where = f"{key}: " if key else ""
        return where + str(error["ctx"]["error"])
    value = error["input"]
    shown = "a table" if isinstance(value, dict) else repr(value)
    allowed = _range(model, path[-1]) if path else ""
    reason = allowed or error["msg"][0].lower() + error["msg"][1:]
    return f"{key} = {shown} is refused; {reason}"
