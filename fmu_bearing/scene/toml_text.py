"""TOML text as tables; syntax errors name line, text and correction."""

import re
import tomllib
from typing import Any

#: Levels of tables and brackets beyond which a file is not a scene or sweep; those have four at most.
DEEPEST = 50
#: Bytes of a scene's or sweep's file; the largest scene of all arrays takes a tenth, reading this a second.
LONGEST = 1_000_000
_PLACE = re.compile(r"\(at (?:line (\d+), column \d+|end of document)\)$")
_QUOTED = re.compile(r'"(?:\\.|[^"\\])*"|' + r"'[^']*'|#.*")
#: A key with a number that TOML does not have: 150,0; 1.000,5; 20,000; ,5; 50 mm; 5%.
_NUMBER = re.compile(
    r"(?P<key>[\w.\"-]+)\s*=\s*(?P<number>[+-]?[0-9]*(?:[.,][0-9]+)*(?:[eE][+-]?[0-9]+)?)"
    r"(?P<rest>(?: [0-9]{3})+|\s*[^\s,\]}#0-9][^\s,\]}#]*)?(?=\s*(?:$|#|[,}]))"
)
_THOUSANDS = re.compile(r"(?: [0-9]{3})+")
_FOUR = "tables and arrays of a scene are at most four levels deep, as [mounting.rotor]"
_NOT = "not valid TOML:"
_TWICE = ("Cannot overwrite", "Duplicate inline table key", "Cannot declare", "Cannot mutate")


def parse(text: str) -> dict[str, Any]:
    """Return the tables of TOML text.

    Raises
    ------
    ValueError
        For text that is not TOML, with the line.
    """
    lines = text.splitlines()
    for number, line in enumerate(lines, start=1):
        # tomllib takes the square of the number of a name's parts
        if line.count(".") > DEEPEST and _QUOTED.sub("", line).partition("=")[0].count(".") > DEEPEST:
            raise ValueError(f"{_NOT} line {number} names a table more than {DEEPEST} levels deep; {_FOUR}")
    try:
        return tomllib.loads(text)
    except RecursionError:
        raise ValueError(f"{_NOT} its brackets are nested too deeply to be read; {_FOUR}") from None
    except tomllib.TOMLDecodeError as problem:
        raise ValueError(f"{_NOT} {_corrected(lines, str(problem)) or problem}") from None


def _corrected(lines: list[str], problem: str) -> str:
    """Say how a line is written that TOML writes in another way; empty: not known.

    A key or table that is given twice, a number with commas, a unit or per cent.
    """
    place = _PLACE.search(problem)
    last = int(place[1] or len(lines)) if place is not None else 0
    line = lines[last - 1] if 0 < last <= len(lines) else ""
    if problem.startswith(_TWICE):
        return f"line {last}: '{line.strip()}' gives a key or table twice: keep one of them"
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
