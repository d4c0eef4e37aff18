"""Entries of catalogues by name: the package's own, makers' sizes, and bearings of users' files."""

import copy
import functools
import os
import tomllib
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager
from contextvars import ContextVar
from importlib import resources
from pathlib import Path
from typing import Any, NamedTuple

import tomlkit
from pydantic import ValidationError

from fmu_bearing.file_words import CATALOGUE, text_of
from fmu_bearing.files import real_path
from fmu_bearing.scene import deep_groove, nsk
from fmu_bearing.scene.base import Part, SceneError
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.problems import explain, shown
from fmu_bearing.scene.toml_text import parse

#: Key at the head of a scene: files with bearings of one's own.
KEY = "catalogues"
_LONGEST = 10_000_000  # bytes of a file: thousands of bearings
#: Files that hold for all scenes, beside those that a scene names.
_in_use: ContextVar[tuple[Path, ...]] = ContextVar("catalogues", default=())


class Entry(NamedTuple):
    """An entry: its values, the TOML text that has it with its remarks, its file (None: the package's)."""

    values: dict[str, Any]
    text: str
    file: Path | None = None


class _Bearing(Part):
    """An entry as a scene has it, for the messages of a scene."""

    bearing: Bearing


def catalogue(kind: str) -> dict[str, dict[str, Any]]:
    """Catalogue of ``bearings``, ``materials``, ``lubricants`` or ``grades``: name to values."""
    return {name: copy.deepcopy(entry.values) for name, entry in entries(kind).items()}


def entries(kind: str, files: Sequence[Path] = ()) -> Mapping[str, Entry]:
    """Return all entries of a kind by name, bearings with those of users' files.

    ``files``: those that a scene names, beside those in use (`using`).

    Raises
    ------
    SceneError
        For a file that cannot be read, an entry that is not a bearing, or a name that is given twice.
    """
    by_name = _of_package(kind)
    wanted = tuple(dict.fromkeys(real_path(path) for path in (*_in_use.get(), *files)))
    if kind != "bearings" or not wanted:
        return by_name
    every = dict(by_name)
    problems = []
    for path in wanted:
        for name, entry in _of_file(path).items():
            if name in every:
                problems.append(_twice(name, path, every[name].file))
            else:
                every[name] = entry
    if problems:
        raise SceneError("\n".join(problems))
    return every


@functools.cache
def _of_package(kind: str) -> Mapping[str, Entry]:
    text = resources.files("fmu_bearing.scene").joinpath("catalogue", f"{kind}.toml").read_text("utf-8")
    by_name = {name: Entry(values, text) for name, values in tomllib.loads(text).items()}
    if kind == "bearings":
        made = {name: nsk.entry_text(size) for name, size in nsk.sizes().items()}
        made |= {name: deep_groove.entry_text(size) for name, size in deep_groove.sizes().items()}
        by_name |= {name: Entry(tomllib.loads(text)[name], text) for name, text in made.items()}
    return by_name


def _of_file(path: Path) -> dict[str, Entry]:
    """Return the bearings of a user's file, all checked."""
    try:
        text = text_of(path, CATALOGUE, _LONGEST, "catalogue file")
        tables = parse(text)
    except ValueError as problem:
        raise SceneError(f"{path}: {problem}") from None
    problems = [line for name, table in tables.items() for line in _faults(name, table)]
    if problems:
        raise SceneError("\n".join(f"{path}: {line}" for line in problems))
    return {name: Entry(table, text, path) for name, table in tables.items()}


def _faults(name: str, table: Any) -> Iterator[str]:
    """Yield what keeps a table of a user's file from being a bearing."""
    if not isinstance(table, dict):
        yield f"{name} = {shown(table)} is outside any table: a bearing is a table of its name, [{name}]"
        return
    try:
        _Bearing.model_validate({"bearing": table})
    except ValidationError as problem:
        for line in explain(problem, {"bearing": table}):
            yield f"[{name}] {line.partition('; or take all from')[0].removeprefix('bearing.')}"


def _twice(name: str, path: Path, first: Path | None) -> str:
    where = "is in the catalogue of the package" if first is None else f"is in {first}, too"
    return f"{path}: [{name}] {where}: give it a name of its own, for example [my-{name}]"


def entry_text(entry: Entry, name: str) -> str:
    """Return the TOML of one entry alone, with its remarks."""
    document = tomlkit.document()
    document[name] = tomlkit.parse(entry.text)[name]
    return tomlkit.dumps(document)


@contextmanager
def using(files: Sequence[str | os.PathLike[str]]) -> Iterator[None]:
    """Let all scenes that are read meanwhile know the bearings of these files, which are read then."""
    token = _in_use.set((*_in_use.get(), *map(Path, files)))
    try:
        yield
    finally:
        _in_use.reset(token)


def named_files(given: Any, folder: Path | None) -> tuple[list[Path], str]:
    """Return the files that a scene names under `KEY`, from its folder on, or what is wrong with them."""
    if given is None:
        return [], ""
    if not isinstance(given, list) or not all(isinstance(one, str) and one for one in given):
        return (
            [],
            f'{KEY} = {shown(given)} is refused; allowed: a list of files, as {KEY} = ["my-bearings.toml"]',
        )
    if bad := [one for one in given if "\0" in one]:
        return [], f"{KEY}: {shown(bad[0])} is refused: a file's name holds no NUL"
    return [(folder or Path()) / one for one in given], ""


def anchored(text: str, folder: Path) -> str:
    """Return the text of a scene with its users' catalogues by their whole paths, to be written elsewhere."""
    document = tomlkit.parse(text)
    files, _ = named_files(document.unwrap().get(KEY), folder)
    if files:
        document[KEY] = [str(real_path(path)) for path in files]
    return tomlkit.dumps(document)


def named(known: Mapping[str, Entry]) -> str:
    """Return names of entries; makers' sizes, which are many, by the first of them."""
    made = (
        [name for name in known if name.startswith(nsk.PREFIX)],
        [name for name in known if name in deep_groove.sizes()],
    )
    others = [name for name in known if not any(name in of_maker for of_maker in made)]
    more = [f"{len(one)} from {one[0]} on (`fmu-bearing scene catalogue`)" for one in made if one]
    return ", ".join([*others, *more])
