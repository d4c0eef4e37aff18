"""From TOML, tables or another scene to a scene, or to a ``SceneError`` with one line per problem."""

import copy
import os
from collections.abc import Iterator, Mapping, Sequence
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from fmu_bearing.file_words import SCENE, text_of
from fmu_bearing.files import real_path
from fmu_bearing.scene import defect_conflicts, fit_conflicts, fit_file, surface, surface_file
from fmu_bearing.scene.assembly import Assembly, assembly_of
from fmu_bearing.scene.base import Conflict, SceneError
from fmu_bearing.scene.bearing import CLEARANCE_KEYS
from fmu_bearing.scene.designation import suggestion
from fmu_bearing.scene.entries import KEY as CATALOGUES, Entry, catalogue, entries, named, named_files
from fmu_bearing.scene.exclusions import conflicts_of
from fmu_bearing.scene.imperfections import RACES
from fmu_bearing.scene.lubricant import meant_supply
from fmu_bearing.scene.material import Materials
from fmu_bearing.scene.member import SceneBearing, bearings_of
from fmu_bearing.scene.preload import (
    CLASS,
    FORCE,
    OFFSET,
    TABLES,
    PreloadError,
    carried,
    differing_preload,
    preload,
    preload_key,
    preload_table,
)
from fmu_bearing.scene.problems import (
    Location,
    described,
    dotted,
    explain,
    is_material,
    missing,
    shown,
    too_long,
)
from fmu_bearing.scene.scene import Tables
from fmu_bearing.scene.toml_text import LONGEST, parse
from fmu_bearing.scene.values import plain, put, table_at

__all__ = ["Scene", "SceneError", "catalogue", "read_scene", "read_scene_text", "scene_of", "with_fidelity"]


#: Values that take the place of the preload in newtons, and which that is.
_PRELOADS = {".".join((*path, key)): ".".join((*path, FORCE)) for path in TABLES for key in (CLASS, OFFSET)}


class Scene(Tables):
    """All input of a model; the units are in the names of the values.

    A scene does not change: `replace` returns another one.

    Examples
    --------
    >>> from fmu_bearing import Scene, read_scene
    >>> scene = read_scene("examples/scenes/7003C-bare.toml")
    >>> isinstance(scene, Scene), [name for name, place in scene.microphones]
    (True, ['P1', 'P2', 'P3', 'P4'])
    >>> scene.to_toml().splitlines()[0]
    'name = "7003C-bare"'
    """

    def conflicts(self) -> Iterator[Conflict]:
        """Yield conflicts between tables, and what such a scene cannot have."""
        yield from super().conflicts()
        yield from fit_conflicts.conflicts(self)
        yield from defect_conflicts.conflicts(self)
        yield from conflicts_of(self)

    @property
    def assembly(self) -> Assembly:
        """What holds the bearings together: shaft, preload, and where the file has them."""
        return assembly_of(self)

    def bearings(self) -> "tuple[SceneBearing[Scene], ...]":
        """Return the bearings of the scene, in a set from the nose to the rear.

        A single bearing is the first and only one; its scene is this one.

        Examples
        --------
        >>> from fmu_bearing import read_scene
        >>> pair = read_scene("examples/spindle_set/7003C-DB.toml")
        >>> [(one.number, one.sign, one.prefix) for one in pair.bearings()]
        [(1, 1, 'bearing[1].'), (2, -1, 'bearing[2].')]
        >>> single = read_scene("examples/scenes/7003C-bare.toml")
        >>> [(one.number, one.prefix, one.scene is single) for one in single.bearings()]
        [(1, '', True)]
        """
        return bearings_of(self)

    @classmethod
    def from_dict(cls, data: Mapping[str, Any]) -> "Scene":
        """Return the scene that nested tables hold, checked and completed as a scene file is.

        Parameters
        ----------
        data : mapping
            Tables by name, values in the units of their keys; names of catalogue entries as in a file.
            Arrays of NumPy and parts of other scenes serve as values too. Files under ``catalogues`` count
            from the current folder.

        Raises
        ------
        SceneError
            With one line per problem.

        Examples
        --------
        >>> from fmu_bearing import Scene, read_scene
        >>> tables = read_scene("examples/scenes/7003C-bare.toml").model_dump()
        >>> scene = Scene.from_dict(tables | {"bearing": {"catalogue": "7003C"}, "sound": None})
        >>> scene.bearing.ball_count, scene.microphones
        (12, [])
        """
        if not isinstance(data, Mapping):
            raise TypeError(f"from_dict takes tables by name, not {type(data).__name__}")
        tables = plain(data)
        name = tables.get("name")
        return _checked(tables, name if isinstance(name, str) else "scene")

    def replace(self, values: Mapping[str, Any]) -> "Scene":
        """Return the scene with other values, checked as those of a scene file are.

        Parameters
        ----------
        values : mapping
            Values by dotted key, in the unit of the key: ``"mounting.preload_N"``,
            ``"sound.microphone[1].y_mm"``. Whole tables can be given, None takes an optional value or table
            out. The name of a catalogue entry (``"bearing.catalogue"``, ``"materials.balls"``) replaces all
            that the entry holds, ``"imperfections.grade"`` for the grade's values,
            ``"imperfections.surface"`` for those of a surface's file; keys given beside it win.
            ``"mounting.preload_class"`` or ``"mounting.preload_offset_um"`` gives another ``preload_N``, as
            do these keys of ``spindle.preload``.

        Raises
        ------
        SceneError
            With one line per problem: an unknown key, a value out of range, values that do not fit together.

        Examples
        --------
        >>> from fmu_bearing import read_scene
        >>> scene = read_scene("examples/scenes/7003C-bare.toml")
        >>> other = scene.replace({"mounting.preload_N": 300, "materials.balls": "GCr15"})
        >>> other.mounting.preload_N, other.materials.balls.density_kg_m3
        (300.0, 7800.0)
        >>> scene.replace({"mounting.prelaod_N": 300})
        Traceback (most recent call last):
        ...
        fmu_bearing.scene.base.SceneError: 7003C-bare: mounting.prelaod_N is not a key of a scene; did ...
        """
        data = self.model_dump()
        given = {key: plain(value) for key, value in values.items()}
        _make_room(data, given)
        return _checked(data, self.name, put(data, given))


#: A scene in memory, or the path of a scene file.
SceneSource = Scene | str | os.PathLike[str]


def scene_of(source: SceneSource) -> Scene:
    """Return a scene as it is, or read it from its file.

    Raises
    ------
    SceneError
        As :func:`read_scene`; for anything else, too.
    """
    return source if isinstance(source, Scene) else read_scene(source)


def read_scene(path: str | os.PathLike[str]) -> Scene:
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
    if not isinstance(path, str | os.PathLike):
        raise SceneError(
            f"a scene is a file, given by its path, or a Scene in memory, not {described(path)}; "
            "Scene.from_dict takes tables"
        )
    try:
        text = text_of(path, SCENE, LONGEST, "scene file")
    except ValueError as problem:
        raise SceneError(f"{path}: {problem}") from None
    return read_scene_text(text, str(path), Path(path).parent)


def read_scene_text(text: str, name: str = "scene", folder: Path | None = None) -> Scene:
    """Read a scene from TOML text; ``name`` names the file in messages.

    Names of files in it count from ``folder`` (default: the current one).

    Raises
    ------
    SceneError
        As :func:`read_scene`.
    """
    try:
        data = parse(text)
    except ValueError as problem:
        raise SceneError(f"{name}: {problem}") from None
    sound = data.get("sound")
    if folder is not None and isinstance(sound, dict):
        table = sound.get("table_file")
        if isinstance(table, str) and "\0" not in table:
            sound["table_file"] = str(real_path(folder / table))
    return _checked(data, name, folder=folder)


def _checked(
    data: dict[str, Any], name: str, problems: Sequence[str] = (), folder: Path | None = None
) -> Scene:  # fmt: skip
    """Return the scene that tables hold; `SceneError` with all problems, those found before included."""
    lines = list(problems)
    unresolved: list[Location] = []
    if line := surface_file.fill(data.get("imperfections"), folder or Path()):
        lines.append(line)
        unresolved.append(("imperfections",))
    _resolve(data, _bearings(data, folder, lines), lines, unresolved)
    for where, line in too_long(data):
        lines.append(line)
        unresolved.append(where)
    try:
        scene = Scene.model_validate(data)
    except ValidationError as problem:
        both = data.get("mounting") is not None and data.get("spindle") is not None
        wrong = fit_file.misplaced(data).partition(".")[0] or "mounting"
        lines += explain(problem, data, [*unresolved, *([(wrong,)] if both else [])])
        lines += _one_mounting(data)
    else:
        lines += _one_mounting(data)
        if not lines:
            return scene
    raise SceneError("\n".join(f"{name}: {line}" for line in dict.fromkeys(lines))) from None


def _one_mounting(data: Mapping[str, Any]) -> list[str]:
    """Return a line unless there is one of the tables that say how bearings are mounted."""
    given = [key for key in ("mounting", "spindle") if data.get(key) is not None]
    if not given:
        return [f"{missing(('mounting',))}; several bearings on one shaft have [spindle] instead"]
    if misplaced := fit_file.misplaced(data):
        return [misplaced]
    if len(given) > 1:
        return [
            "mounting: cannot be given with [spindle]: one bearing has [mounting], a set on one shaft has "
            "[spindle]; keep one"
        ]
    return []


def with_fidelity(scene: SceneSource, **keys: Any) -> Scene:
    """Return a scene, or that of a file, with other values at keys of ``[fidelity]``; see `Scene.replace`.

    Raises
    ------
    SceneError
        If a key or a value is refused.

    Examples
    --------
    >>> from fmu_bearing import with_fidelity
    >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="rings", tolerance=1e-4)
    >>> scene.fidelity.model, scene.fidelity.tolerance
    ('rings', 0.0001)
    """
    return scene_of(scene).replace({f"fidelity.{key}": value for key, value in keys.items()})


def _make_room(data: dict[str, Any], given: Mapping[str, Any]) -> None:
    """Take out of a scene's tables what names of catalogue entries among new values set again."""
    fit_file.make_room(data, given)
    for key, name in given.items():
        *tables, last = key.split(".")
        part: Any = table_at(data, tables)
        if not isinstance(part, dict):
            continue
        named = tables[-1:] in (["bearing"], ["lubricant"]) or "materials" in tables[:-1]
        if last == "catalogue" and named:
            part.clear()
        elif name is not None and tables == ["bearing"] and last in CLEARANCE_KEYS:
            for other in CLEARANCE_KEYS:
                if f"bearing.{other}" not in given:
                    part.pop(other, None)
        elif name is not None and key in _PRELOADS and _PRELOADS[key] not in given:
            part.pop(FORCE, None)
        elif key == "imperfections.grade" and isinstance(name, str):
            for value in catalogue("grades").get(name, {}):
                part.pop(value, None)
        elif key == surface_file.KEY and isinstance(name, str):
            for value in surface.KEYS:
                part.pop(value, None)


def _bearings(data: dict[str, Any], folder: Path | None, lines: list[str]) -> Mapping[str, Entry] | None:
    """Take the users' catalogues out of a scene; return all bearings that it can name.

    None: a catalogue is faulty, as ``lines`` say then.
    """
    files, refusal = named_files(data.pop(CATALOGUES, None), folder)
    if refusal:
        lines.append(refusal)
    try:
        return entries("bearings", files)
    except SceneError as problem:
        lines += problem.problems
        return None


def _resolve(
    data: dict[str, Any], bearings: Mapping[str, Entry] | None, lines: list[str], unresolved: list[Location]
) -> None:
    """Replace catalogue names by their values; keys given in the file win.

    Messages about unknown names are added to ``lines``; their tables, which cannot be checked further, to
    ``unresolved``.
    """
    spindle = data.get("spindle")
    members = spindle.get("bearing") if isinstance(spindle, dict) else None
    owners: list[tuple[Location, dict[str, Any]]] = [((), data)]
    for k, member in enumerate(members if isinstance(members, list | tuple) else ()):
        if isinstance(member, dict):
            owners.append((("spindle", "bearing", k), member))
            if isinstance(member.get("bearing"), str):
                member["bearing"] = {"catalogue": member["bearing"]}
    for path, owner in owners:
        _resolve_bearing(owner, path, bearings, lines, unresolved)
    _fill(data, ("lubricant",), entries("lubricants"), lines, unresolved)
    for path, owner in owners:
        materials: Any = owner.get("materials")
        named = Materials.model_fields if isinstance(materials, dict) else ()
        for key in (name for name in named if name in materials):
            if isinstance(materials[key], str):
                materials[key] = {"catalogue": materials[key]}
            _fill(materials, (*path, "materials", key), entries("materials"), lines, unresolved)
    for path, part in fit_file.bodies(data):
        if isinstance(part.get("material"), str):
            part["material"] = {"catalogue": part["material"]}
        _fill(part, (*path, "material"), entries("materials"), lines, unresolved)
    fit_file.give_class(data)
    flaws = data.get("imperfections")
    if spindle is not None and isinstance(flaws, dict):
        flaws.setdefault("unbalance_um", 0.0)  # a grade's is of one bearing's rotor
    _fill(data, ("imperfections",), entries("grades"), lines, unresolved, key="grade")
    _give_preload(data, lines)


def _resolve_bearing(
    parent: dict[str, Any], path: Location, bearings: Mapping[str, Entry] | None, lines: list[str],
    unresolved: list[Location],
) -> None:  # fmt: skip
    """Fill ``bearing`` at a path: of the scene, or of one bearing of a set."""
    bearing = parent.get("bearing")
    name = bearing.get("catalogue") if isinstance(bearing, dict) else None
    if bearings is not None or name in entries("bearings"):
        _fill(parent, (*path, "bearing"), bearings or entries("bearings"), lines, unresolved)
    elif name is not None:  # it may be in the faulty catalogue
        unresolved.append((*path, "bearing"))
    bearing = parent.get("bearing")
    if isinstance(bearing, dict) and bearing.get("cage") is False:
        del bearing["cage"]  # how a file leaves out the cage that a catalogue entry has


def _give_preload(data: dict[str, Any], lines: list[str]) -> None:
    """Put newtons in place of a class or an offset."""
    for path in TABLES:
        table = preload_table(data, path)
        if not isinstance(table, dict):
            continue
        found = None
        try:
            key = preload_key(table, path)
            if key is not None:
                lines += fit_file.loose_preload(data, path[0], ".".join((*path, key)))
                lines += differing_preload(data, ".".join((*path, key)))
                found = preload(table, data.get("bearing"), data.get("materials"), carried(data), path)
        except PreloadError as problem:
            key = CLASS
            lines.append(str(problem))
        table.pop(CLASS, None)
        table.pop(OFFSET, None)
        if found is not None:
            table[FORCE] = found.force
        elif key is not None and table.get("kind") != "spring":
            table[FORCE] = 0.0  # of a scene that is refused: what is wrong is reported already


def _fill(
    parent: dict[str, Any],
    path: Location,
    known: Mapping[str, Entry],
    lines: list[str],
    unresolved: list[Location],
    key: str = "catalogue",
) -> None:
    """Fill the table at the end of ``path`` from the catalogue entry it names under ``key``, if any."""
    given = parent.get(path[-1])
    if not isinstance(given, dict) or key not in given:
        return
    wanted = given.pop(key)
    if not isinstance(wanted, str) or wanted not in known:
        where = dotted(path) + ("" if is_material(path) else f".{key}")
        others = f"{suggestion(str(wanted), known)}known: {named(known)}"
        others += meant_supply(wanted) if path == ("lubricant",) else ""
        lines.append(f"{where} = {shown(wanted)} is not in the catalogue; {others}")
        unresolved.append(path)
        return
    entry = copy.deepcopy(known[wanted].values)
    entry = _beside_harmonics(entry, given) if key == "grade" else entry
    if path[-1] == "bearing" and not given.keys().isdisjoint(CLEARANCE_KEYS):
        entry = {name: value for name, value in entry.items() if name not in CLEARANCE_KEYS}
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
