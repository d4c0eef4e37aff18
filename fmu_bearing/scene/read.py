"""From TOML to a scene, or to a ``SceneError`` with one line per problem."""

import difflib
import tomllib
from importlib import resources
from os import PathLike
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from fmu_bearing.scene.imperfections import RACES
from fmu_bearing.scene.problems import Location, SceneError, explain, shown
from fmu_bearing.scene.scene import Scene

__all__ = ["SceneError", "catalogue", "read_scene", "read_scene_text", "with_fidelity"]


def catalogue(kind: str) -> dict[str, dict[str, Any]]:
    """Catalogue of ``bearings``, ``materials``, ``lubricants`` or ``grades``: name to values."""
    return tomllib.loads(catalogue_text(kind))


def catalogue_text(kind: str) -> str:
    """Text of a catalogue, with its remarks."""
    return resources.files("fmu_bearing.scene").joinpath("catalogue", f"{kind}.toml").read_text("utf-8")


def read_scene(path: str | PathLike[str]) -> Scene:
    """Read a scene file.

    Raises
    ------
    SceneError
        If the file cannot be read or does not hold a scene; its message has one line per problem.

    Examples
    --------
    >>> from fmu_bearing import read_scene
    >>> scene = read_scene("examples/scenes/7003C-spindle.toml")
    >>> scene.bearing.ball_count, scene.mounting.preload_N
    (12, 500.0)
    """
    try:
        # some editors put a byte order mark in front, which TOML does not know
        text = Path(path).read_text("utf-8-sig")
    except FileNotFoundError:
        raise SceneError(f"{path}: there is no such scene file") from None
    except UnicodeDecodeError as problem:
        raise SceneError(f"{path}: is not text in UTF-8: {problem}") from None
    except (OSError, ValueError) as problem:
        raise SceneError(f"{path}: cannot be read: {problem}") from None
    return read_scene_text(text, str(path), Path(path).parent)


def read_scene_text(text: str, name: str = "scene", folder: Path | None = None) -> Scene:
    """Read a scene from TOML text; ``name`` stands for the file in messages.

    Names of files in it count from ``folder`` (default: the current one).

    Raises
    ------
    SceneError
        As :func:`read_scene`.
    """
    try:
        data = tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError) as problem:
        raise SceneError(f"{name}: not valid TOML: {problem}") from None
    lines: list[str] = []
    unresolved: list[Location] = []
    _resolve(data, lines, unresolved)
    sound = data.get("sound")
    if folder is not None and isinstance(sound, dict) and isinstance(sound.get("table_file"), str):
        sound["table_file"] = str((folder / sound["table_file"]).resolve())
    try:
        scene = Scene.model_validate(data)
    except ValidationError as problem:
        lines += explain(problem, data, unresolved)
    else:
        if not lines:
            return scene
    raise SceneError("\n".join(f"{name}: {line}" for line in dict.fromkeys(lines))) from None


def with_fidelity(scene: Scene, **keys: Any) -> Scene:
    """Return the scene with other values at keys of ``[fidelity]``, checked against the same ranges.

    Raises
    ------
    SceneError
        If a key or a value is refused.

    Examples
    --------
    >>> from fmu_bearing import read_scene, with_fidelity
    >>> scene = with_fidelity(read_scene("examples/scenes/7003C-bare.toml"), model="rings", tolerance=1e-4)
    >>> scene.fidelity.model, scene.fidelity.tolerance
    ('rings', 0.0001)
    """
    data = scene.model_dump()
    data["fidelity"] |= keys
    try:
        return Scene.model_validate(data)
    except ValidationError as problem:
        lines = explain(problem, data)
        raise SceneError("\n".join(f"{scene.name}: {line}" for line in lines)) from None


def _resolve(data: dict[str, Any], lines: list[str], unresolved: list[Location]) -> None:
    """Replace catalogue names by their values; keys given in the file win.

    Messages about unknown names are added to ``lines``; their tables, which cannot be checked further, to
    ``unresolved``.
    """
    for table, kind in (("bearing", "bearings"), ("lubricant", "lubricants")):
        _fill(data, (table,), kind, lines, unresolved)
    bearing, materials = data.get("bearing"), data.get("materials")
    if isinstance(bearing, dict) and bearing.get("cage") is False:
        del bearing["cage"]  # how a file leaves out the cage that a catalogue entry has
    if isinstance(materials, dict):
        for key, value in materials.items():
            if isinstance(value, str):
                materials[key] = {"catalogue": value}
            _fill(materials, ("materials", key), "materials", lines, unresolved)
    _fill(data, ("imperfections",), "grades", lines, unresolved, key="grade")


def _fill(
    parent: dict[str, Any],
    path: Location,
    kind: str,
    lines: list[str],
    unresolved: list[Location],
    key: str = "catalogue",
) -> None:
    """Fill the table at the end of ``path`` from the catalogue entry it names under ``key``, if any."""
    given = parent.get(path[-1])
    if not isinstance(given, dict) or key not in given:
        return
    wanted = given.pop(key)
    entries = catalogue(kind)
    if not isinstance(wanted, str) or wanted not in entries:
        folded = {name.lower(): name for name in entries}
        near = difflib.get_close_matches(str(wanted).lower(), folded, n=1, cutoff=0.5)
        hint = f"did you mean '{folded[near[0]]}'? " if near else ""
        where = ".".join(path) + ("" if path[0] == "materials" else f".{key}")
        lines.append(f"{where} = {shown(wanted)} is not in the catalogue; {hint}known: {', '.join(entries)}")
        unresolved.append(path)
        return
    entry = _beside_harmonics(entries[wanted], given) if kind == "grades" else entries[wanted]
    nested = {
        name: {**value, **given[name]}
        for name, value in entry.items()
        if isinstance(value, dict) and isinstance(given.get(name), dict)
    }
    parent[path[-1]] = {**entry, **given, **nested}


def _beside_harmonics(entry: dict[str, Any], given: dict[str, Any]) -> dict[str, Any]:
    """Return a grade without the values that the file's own harmonics replace."""
    explicit = [race for race in RACES if given.get(f"{race}_race_harmonic")]
    unused = {f"{race}_race_amplitude_um" for race in explicit}
    if len(explicit) == len(RACES):
        unused |= {"highest_order"}
    return {name: value for name, value in entry.items() if name not in unused}
