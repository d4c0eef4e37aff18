"""Origin of each value of a scene file, and whether it is assumed, from the remarks in the files."""

from collections.abc import Iterator, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import tomlkit
from tomlkit.container import Container, OutOfOrderTableProxy
from tomlkit.items import AoT, Table

from fmu_bearing.scene import fit, fit_file
from fmu_bearing.scene.entries import KEY as CATALOGUES, Entry, entries, named_files
from fmu_bearing.scene.preload import CLASS, FORCE, OFFSET, TABLES, carried, preload, preload_table
from fmu_bearing.scene.problems import allowed
from fmu_bearing.scene.read import read_scene
from fmu_bearing.scene.scene import Tables
from fmu_bearing.scene.seats import SIDES
from fmu_bearing.scene.surface import KEYS, Surface
from fmu_bearing.scene.units import symbol
from fmu_bearing.scene.values import flat

#: Names that a file may give instead of values: key of the name, kind of catalogue.
_NAMED = {"bearing": "bearings", "lubricant": "lubricants", "materials": "materials"}
#: Tables whose defaults say how a scene is computed; these defaults are not assumptions.
_CHOICES = ("fidelity", "sound", "name")
_MARK = "assumed"
_GIVEN_BY_SURFACE = tuple(f"imperfections.{key}" for key in KEYS)


@dataclass(frozen=True)
class Origin:
    """One value of a scene.

    Attributes
    ----------
    key : str
        Dotted key.
    value : Any
    unit : str
    origin : str
        ``file``, ``catalogue NAME``, ``catalogue NAME of FILE``, ``grade NAME``, ``surface FILE`` or
        ``default``.
    assumed : bool
        Whether its remark says so, or it is a default of a physical value.
    remark : str
        Rest of the remark.
    allowed : str
        What the key may hold.
    """

    key: str
    value: Any
    unit: str
    origin: str
    assumed: bool
    remark: str
    allowed: str


def origins(path: str | Path) -> list[Origin]:
    """Return every value of a scene file with its origin, in the order of the models.

    Raises
    ------
    SceneError
        For a file that is not a scene.
    """
    scene = read_scene(path)
    document = tomlkit.parse(Path(path).read_text("utf-8-sig"))
    files, _ = named_files(document.unwrap().get(CATALOGUES), Path(path).parent)
    known: dict[str, tuple[str, str]] = {}
    for table, name, kind, origin in _references(document):
        entry = entries(kind, files)[name]
        words = origin if entry.file is None else f"{origin} of {entry.file.name}"
        known |= {key: (words, remark) for key, remark in _remarks(_table(entry, name), table)}
    if "spindle" in document:
        known.pop("imperfections.unbalance_um", None)  # a set takes none from a grade
    flaws = document.get("imperfections")
    if isinstance(flaws, Mapping) and "surface" in flaws:
        known |= dict.fromkeys(_GIVEN_BY_SURFACE, (f"surface {flaws['surface']}", ""))
    known |= {key: ("file", remark) for key, remark in _remarks(document, "")}
    known |= _preload(document, scene)
    known |= dict(_fit(document, scene, known))
    of_keys = [_origin(key, value, known.get(key)) for key, value in flat(scene).items()]
    ends = {key: f"{one.low:g} to {one.high:g} {one.unit}" for key, one in scene.size_limits().items()}
    return [replace(one, allowed=ends[one.key]) if one.key in ends else one for one in of_keys]


def with_surface(found: list[Origin], surface: Surface) -> list[Origin]:
    """Return origins of a scene's values where the median law of a surface has taken the place of its own."""
    law = {f"imperfections.{key}": value for key, value in surface.median().items()}
    return [
        replace(one, value=law[one.key], origin="surface", assumed=False, remark=surface.words)
        if one.key in law else one for one in found
    ]  # fmt: skip


def _table(entry: Entry, name: str) -> Table:
    """Return an entry with its remarks."""
    table = tomlkit.parse(entry.text)[name]
    assert isinstance(table, Table)
    return table


def _preload(document: Mapping[str, Any], scene: Tables) -> dict[str, tuple[str, str]]:
    """Return the origin of a preload that a class or an offset gives, in words."""
    known: dict[str, tuple[str, str]] = {}
    for path in TABLES:
        table = preload_table(document, path)
        if table is not None and (CLASS in table or OFFSET in table):
            found = preload(table, scene.bearing, scene.materials, carried(document), path)
            known |= {} if found is None else {".".join((*path, FORCE)): ("file", found.words)}
    return known


def _fit(
    document: Mapping[str, Any], scene: Tables, known: Mapping[str, tuple[str, str]]
) -> Iterator[tuple[str, tuple[str, str]]]:
    """Yield the origin of what a fit takes from other tables, and in words what its classes give."""
    where = "mounting.fit" if scene.mounting is not None else "spindle.fit"
    if scene.fit is None:
        return
    grade = document.get("imperfections", {}).get("grade")
    for key, origin in (("bearing_class", f"grade {grade}"), ("preload", "file")):
        if getattr(scene.fit, key) is not None and f"{where}.{key}" not in known:
            words = "a class or an offset is of the loose bearing" if key == "preload" else ""
            yield f"{where}.{key}", (origin, words)
    for side in SIDES:
        key = f"{where}.{side.seat}.{side.class_key}"
        if key in known:
            place, remark = known[key]
            found = fit.of_seat(scene, side)
            assert found is not None
            yield key, (place, "; ".join(filter(None, (remark, found.words))))


def _origin(key: str, value: Any, found: tuple[str, str] | None) -> Origin:
    table = key.split(".")[0]
    place, remark = found or ("default", _MARK if table not in _CHOICES else "")
    words = remark.removeprefix(_MARK).removesuffix(_MARK).strip(":;, ")
    location = tuple(part.split("[")[0] for part in key.split("."))
    unit = symbol(location[-1]) if isinstance(value, float) else ""
    return Origin(key, value, unit, place, _MARK in remark, words, allowed(location))


def _references(document: Mapping[str, Any]) -> Iterator[tuple[str, str, str, str]]:
    """Yield table, name, kind of catalogue, and words for each entry that a file names."""
    spindle = document.get("spindle")
    members = spindle.get("bearing", ()) if isinstance(spindle, Mapping) else ()
    own = [(f"spindle.bearing[{k}].{table}", table, member) for k, member in enumerate(members, start=1)
           for table in ("bearing", "materials")]  # fmt: skip
    for table, of_scene, parent in [*((name, name, document) for name in _NAMED), *own]:
        given, kind = parent.get(of_scene), _NAMED[of_scene]
        if of_scene == "bearing" and isinstance(given, str):
            given = {"catalogue": given}
        if not isinstance(given, Mapping):
            continue
        if "catalogue" in given:
            yield table, str(given["catalogue"]), kind, f"catalogue {given['catalogue']}"
        elif of_scene == "materials":
            for body, entry in given.items():
                name = entry.get("catalogue") if isinstance(entry, Mapping) else entry
                if name is not None:
                    yield f"{table}.{body}", str(name), kind, f"catalogue {name}"
    for path, body in fit_file.bodies(document):
        entry = body.get("material")
        name = entry.get("catalogue") if isinstance(entry, Mapping) else entry
        if name is not None:
            yield f"{'.'.join(path)}.material", str(name), "materials", f"catalogue {name}"
    imperfections = document.get("imperfections")
    if isinstance(imperfections, Mapping) and "grade" in imperfections:
        grade = str(imperfections["grade"])
        yield "imperfections", grade, "grades", f"grade {grade}"


def _remarks(
    table: Container | Table | OutOfOrderTableProxy, path: str, above: str = ""
) -> Iterator[tuple[str, str]]:
    """Yield the dotted key and the remark of every value; a table's remark holds for all in it."""
    if isinstance(table, Table) and not table.is_super_table():  # which shares the remark of its first one
        above = _words(table) or above
    for key, item in table.items():
        dotted = f"{path}.{key}".lstrip(".")
        if isinstance(item, AoT):
            for k, member in enumerate(item):
                yield from _remarks(member, f"{dotted}[{k + 1}]", above)
        elif isinstance(item, Table | Container | OutOfOrderTableProxy):  # the last: in several pieces
            yield from _remarks(item, dotted, above)
        elif isinstance(item, Mapping):  # an inline table
            yield from ((f"{dotted}.{name}", _words(item)) for name in item)
        else:
            yield dotted, _words(table.item(key) if hasattr(table, "item") else item) or above


def _words(item: Any) -> str:
    """Return the remark behind an item."""
    trivia = getattr(item, "trivia", None)
    return "" if trivia is None else trivia.comment.lstrip("# ").strip()
