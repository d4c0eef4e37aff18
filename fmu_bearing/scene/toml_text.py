"""TOML text as tables; syntax errors name line, key and correction."""

import re
import tomllib
from typing import Any

import tomlkit
from tomlkit.exceptions import TOMLKitError

#: Levels of tables and brackets beyond which a file is not a scene or sweep; those have four at most.
DEEPEST = 50
#: Bytes of a scene's or sweep's file; the largest scene of all arrays takes a tenth, reading this a second.
LONGEST = 1_000_000
_PLACE = re.compile(r"\(at (?:line (\d+), column \d+|end of document)\)$")
_HEADER = re.compile(r"\s*\[{1,2}([^\[\]]+)\]{1,2}\s*(?:#.*)?$")
_QUOTED = re.compile(r'"(?:\\.|[^"\\])*"|' + r"'[^']*'|#.*")
#: A key with a number that TOML does not have: 150,0; 1.000,5; 20,000; ,5; 50 mm; 5%.
_NUMBER = re.compile(
    r"(?P<key>[\w.\"-]+)\s*=\s*(?P<number>[+-]?[0-9]*(?:[.,][0-9]+)*(?:[eE][+-]?[0-9]+)?)"
    r"(?P<rest>(?: [0-9]{3})+|\s*[^\s,\]}#0-9][^\s,\]}#]*)?(?=\s*(?:$|#|[,}]))"
)
_THOUSANDS = re.compile(r"(?: [0-9]{3})+")
_PRESENT = re.compile(r'Key "(.+)" already exists')
_TWICE = ("Cannot overwrite", "Duplicate inline table key", "Cannot declare", "Cannot mutate")


def parse(text: str) -> dict[str, Any]:
    """Return the tables of TOML text.

    Raises
    ------
    ValueError
        For text that is not TOML, with the line, and for a key that is given twice with both lines.
    """
    lines = text.splitlines()
    _check_names(lines)
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError(_too_deep(lines)) from None
    except tomllib.TOMLDecodeError as problem:
        words = _twice(lines, str(problem)) or _written_otherwise(lines, str(problem)) or str(problem)
        raise ValueError(words) from None


def _check_names(lines: list[str]) -> None:
    """Refuse names of tables with very many parts: tomllib takes the square of their number."""
    for number, line in enumerate(lines, start=1):
        if line.count(".") <= DEEPEST:
            continue
        name = _QUOTED.sub("", line).partition("=")[0]
        if name.count(".") > DEEPEST:
            raise ValueError(
                f"line {number} names a table {name.count('.') + 1} levels deep; the tables of a scene are "
                "at most four levels deep, as [mounting.rotor]"
            )


def _too_deep(lines: list[str]) -> str:
    depth = 0
    for number, line in enumerate(lines, start=1):
        plain = _QUOTED.sub("", line)
        depth += sum(plain.count(mark) for mark in "[{") - sum(plain.count(mark) for mark in "]}")
        if plain.count("[") + plain.count("{") > DEEPEST or depth > DEEPEST:
            return (
                f"line {number} opens brackets more than {DEEPEST} levels deep; the arrays and tables of a "
                "scene are at most four levels deep"
            )
    return "its brackets are nested too deeply to be read; those of a scene are at most four levels deep"


def _twice(lines: list[str], problem: str) -> str:
    """Say which key or table is given twice, and in which line again; empty for another error."""
    place = _PLACE.search(problem)
    if place is None or not problem.startswith(_TWICE):
        return ""
    last = int(place[1] or len(lines))
    if header := _HEADER.match(lines[last - 1]):
        thing = f"table [{header[1].strip()}]"
        remedy = "put their keys under one, or write [[ ]] for an array of tables"
    else:
        thing, remedy = f"key {_repeated(lines)}", "keep one of them"
    return f"line {last}: {thing} is given twice: {remedy}"


def _repeated(lines: list[str]) -> str:
    """Return the name of the first key that is given twice, which tomllib does not say."""
    try:
        tomlkit.parse("\n".join(lines))
    except (TOMLKitError, RecursionError) as problem:
        if found := _PRESENT.match(str(problem)):
            return found[1]
    return "of this line"


def _written_otherwise(lines: list[str], problem: str) -> str:
    """Say what a number is that TOML writes in another way: with commas, a unit, per cent; empty: none is."""
    place = _PLACE.search(problem)
    last = int(place[1] or len(lines)) if place is not None else 0
    line = lines[last - 1] if 0 < last <= len(lines) else ""
    found = _NUMBER.search(_QUOTED.sub(lambda part: "" if part[0][0] == "#" else '""', line))
    if found is None or not found["number"]:
        return ""
    given, rest = found["number"], (found["rest"] or "").strip()
    start = f"line {last}: {found['key']} = {given}{' ' * bool(rest)}{rest}"
    if not rest and "," not in given:
        return ""
    if _THOUSANDS.fullmatch(found["rest"] or ""):
        whole = given + "".join(filter(str.isdigit, rest))
        return f"{start}: a number has no marks between its thousands: write {whole}"
    if "," not in given:
        return f"{start}: a number has no unit behind it: the key's name has the unit; write {given}"
    plain = given.replace(".", "") if given.rfind(",") > given.rfind(".") else given.replace(",", "")
    point = plain.replace(",", ".", 1) if plain.count(",") == 1 else plain.replace(",", "")
    point = f"0{point}" if point.startswith(".") else point
    thousands = f", or {given.replace(',', '')} if the comma is between thousands"
    more = thousands if re.fullmatch(r"[+-]?[0-9]{1,3}(,[0-9]{3})+", given) else ""
    return f"{start}: a decimal number has a point: write {point}{more}"
