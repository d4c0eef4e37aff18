"""Rows and columns of CSV files as people have them: any separator, decimal commas, titles with units."""

import csv
import io
import os
import re
import warnings
from array import array
from collections.abc import Iterator
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.file_words import TABLE, instead, trouble
from fmu_bearing.files import plain_file
from fmu_bearing.results.column_units import Title, is_units, written_unit

__all__ = ["Cell", "Columns", "read_columns", "read_rows"]

_SEPARATORS = (";", "\t", ",", "|")
_DECIMAL_COMMA = re.compile(r"[+-]?[0-9]*,[0-9]+(?:[eE][+-]?[0-9]+)?")
_GROUPED = re.compile(r"[+-]?[0-9]{1,3}(?:\.[0-9]{3})+")  # 15.000: thousands, or a decimal point
_NAMED = re.compile(r'"?sep=(.|\\t)"?', re.IGNORECASE)
_QUOTES = re.compile(r'"[^"]*"')
_TIME = re.compile(r"(?:time|t|zeit)(?:_(\w+))?", re.IGNORECASE)
_SECONDS = "s"
_BEGINNINGS = {b"\xff\xfe": "utf-16", b"\xfe\xff": "utf-16"}  # a spreadsheet's "Unicode text"
_UTF_32 = b"\xff\xfe\0\0"  # begins as UTF-16 does
_MARKED = (b"\xef\xbb\xbf", *_BEGINNINGS)  # their encoding is sure
_WINDOWS = "cp1252"
_NO_TEXT = re.compile(rb"[\x00-\x08\x0e-\x19\x1c-\x1f]")  # control characters that no table has
_LONGEST = 1e9  # bytes


class Cell(str):
    """A cell of a file, with a decimal point where the file has a comma; ``written``: as the file has it."""

    __slots__ = ("written",)

    written: str

    def __new__(cls, written: str, comma: bool = False) -> "Cell":
        """Make a cell of a text; ``comma``: whether numbers may have a decimal comma."""
        cell = super().__new__(cls, _with_point(written) if comma else written)
        cell.written = written
        return cell


def _with_point(written: str) -> str:
    """Return a cell, one that is a number with a decimal comma with a point."""
    return written.replace(",", ".") if _DECIMAL_COMMA.fullmatch(written) else written


class _Sheet(NamedTuple):
    """Titles, whether numbers may have a decimal comma, number and cells of each line."""

    titles: list[Title]
    comma: bool
    rows: Iterator[tuple[int, list[str]]]


class Columns(NamedTuple):
    """Columns of numbers over time, ``time`` (s) first: their titles, the line of each row, the values."""

    titles: list[Title]
    lines: NDArray[np.int64]
    values: NDArray[np.float64]


def read_rows(
    path: str | os.PathLike[str], due: str = TABLE
) -> tuple[list[Title], list[tuple[int, list[Cell]]]]:
    """Read a CSV file: the titles, and of every line that holds any the cells and its number.

    The first line says whether semicolons, tabs, commas or bars separate the cells; a line ``sep=;`` ahead of
    it does, too. Beside separators other than commas numbers may have a decimal comma. Lines that begin with
    # are remarks; where no line of titles follows, the last remark is one. Titles may have units, or a row of
    units below them. Empty cells beyond the titles, which separators at the ends of lines make, are left out,
    and so is a first column without title that counts the rows.

    Parameters
    ----------
    path : path
        Text in UTF-8, with or without byte order mark, in UTF-16 with one, or in Windows-1252, which a
        caution then names.
    due : str
        What the file had to hold, for the message about another one (`file_words`).

    Returns
    -------
    list of Title, list of (int, list of Cell)
        A cell in quotes may go on over several lines; the last one counts.

    Raises
    ------
    ValueError
        For a file that is not there, that is no text, or whose lines are no cells.
    """
    titles, comma, rows = _sheet(path, due)
    return titles, [(line, [Cell(cell, comma) for cell in cells]) for line, cells in rows]


def read_columns(path: str | os.PathLike[str], due: str = TABLE) -> Columns:
    """Read a CSV file of numbers over time; times may repeat (a jump) but not fall.

    The first column is the time, in seconds or in the unit of its title.

    Raises
    ------
    ValueError
        As `read_rows`; with line and column of the first cell that is no finite number.
    """
    titles, comma, rows = _sheet(path, due)
    if not titles:
        raise ValueError(f"{path}: holds no values: write a line of names, such as time,shaft_speed_rpm")
    time = _TIME.fullmatch(titles[0])
    unit = None if time is None else written_unit(titles[0].unit or time[1] or _SECONDS)
    if unit is None or unit.si != _SECONDS:
        words = f"the first column must be 'time' (s), not '{titles[0].written}'"
        raise ValueError(f"{path}: {instead(path, due) or words}")
    numbers, lines = array("d"), array("q")
    commas, grouped = False, ""
    for line, cells in rows:
        if len(cells) != len(titles):
            raise ValueError(
                f"{path}: line {line} has {len(cells)} values for {len(titles)} columns; with decimal commas "
                "separate the columns by semicolons"
            )
        try:
            numbers.extend(map(float, map(_with_point, cells) if comma else cells))
        except ValueError:
            wrong = next(k for k, cell in enumerate(cells) if not _is_number(_with_point(cell)))
            shown = " ".join(cells[wrong].split())  # a cell may have several lines, a message has one
            raise ValueError(
                f"{path}: line {line}, column '{titles[wrong].written}': '{shown}' is not a finite number"
            ) from None
        lines.append(line)
        if comma and not (commas and grouped):
            commas = commas or any("," in cell for cell in cells)
            wrong = next((k for k, cell in enumerate(cells) if _GROUPED.fullmatch(cell)), -1)
            if wrong >= 0 and not grouped:
                grouped = f"line {line}, column '{titles[wrong].written}': '{cells[wrong]}'"
    if commas and grouped:
        raise ValueError(
            f"{path}: {grouped} has a point where other numbers have a decimal comma: thousands or not? "
            "Write all numbers with one mark, and none between thousands"
        )
    if not lines:
        raise ValueError(f"{path}: holds no values below the line of names")
    values = np.array(numbers).reshape(len(lines), len(titles))
    if not np.isfinite(values).all():
        row, column = np.argwhere(~np.isfinite(values))[0]
        raise ValueError(
            f"{path}: line {lines[row]}, column '{titles[column].written}': '{values[row, column]:g}' is not "
            "a finite number"
        )
    values[:, 0] = unit.to_si(values[:, 0])
    if (falls := np.flatnonzero(np.diff(values[:, 0]) < 0.0)).size:
        before, after = values[falls[0] : falls[0] + 2, 0]
        raise ValueError(
            f"{path}: line {lines[falls[0] + 1]}: time falls from {before:g} to {after:g} s; "
            "it must rise, or repeat where values jump"
        )
    titles[0] = Title("time")
    return Columns(titles, np.array(lines), values)


def _sheet(path: str | os.PathLike[str], due: str) -> _Sheet:
    """Return the titles of a file, and its rows one after the other."""
    lines = list(io.StringIO(_text(path, due)))
    separator, remark = "", ""
    for k, line in enumerate(lines):
        if named := _NAMED.fullmatch(line.strip()):
            separator, lines[k] = named[1].replace("\\t", "\t"), ""
        elif line.lstrip().startswith("#"):
            remark, lines[k] = line.lstrip().lstrip("#").strip(), ""
        elif line.strip():
            break
    first = _QUOTES.sub("", next((line for line in lines if line.strip()), ""))
    separator = separator or next((mark for mark in _SEPARATORS if mark in first), ",")
    rows = _rows(path, lines, separator)
    head = next(rows, None)
    if head is None:
        return _Sheet([], False, iter(()))
    names, ahead = head[1], []
    if remark and all(map(_is_number, filter(None, map(_with_point, head[1])))):
        names, ahead = [cell.strip().strip('"') for cell in remark.split(separator)], [head]
    units = next(rows, None) if not ahead else None
    if units is not None and not is_units(units[1]):
        ahead, units = [units], None
    below = [] if units is None else units[1]
    counted = len(names) > 1 and not names[0]
    titles = [Title(name, unit) for name, unit in zip(names, [*below, *[""] * len(names)], strict=False)]
    for title, unit in zip(titles, below, strict=False):
        if unit and written_unit(title.unit) != written_unit(Title("x", unit).unit):
            raise ValueError(
                f"{path}: column '{title.written}' has {title.unit} in its title and {unit} in the row of "
                "units"
            )
    while titles and not titles[-1].written:
        titles.pop()
    return _Sheet(titles[counted:], separator != ",", _within(path, len(titles), counted, ahead, rows))


def _within(
    path: str | os.PathLike[str],
    width: int,
    counted: bool,
    ahead: list[tuple[int, list[str]]],
    rows: Iterator[tuple[int, list[str]]],
) -> Iterator[tuple[int, list[str]]]:
    """Yield rows without the empty cells beyond the titles, and without the count of rows ahead of them."""
    for part in (ahead, rows):
        for line, cells in part:
            while len(cells) > width and not cells[-1]:
                cells.pop()
            if counted and not cells[0].isdigit():
                raise ValueError(f"{path}: line {line}: '{cells[0]}' has no title above it")
            yield line, cells[counted:]


def _is_number(cell: str) -> bool:
    try:
        float(cell)
    except ValueError:
        return False
    return True


def _text(path: str | os.PathLike[str], due: str) -> str:
    try:
        data = plain_file(path, _LONGEST).read_bytes()
        wide = "" if data.startswith(_UTF_32) else _BEGINNINGS.get(data[:2], "")
        text = data.decode(wide) if wide else _narrow(path, data)
    except (OSError, UnicodeDecodeError) as problem:
        raise ValueError(f"{path}: {trouble(path, due, problem)}") from None
    if mistaken := instead(path, due):
        raise ValueError(f"{path}: {mistaken}")
    return text.replace("\u2212", "-")


def _narrow(path: str | os.PathLike[str], data: bytes) -> str:
    """Return text in UTF-8, or in Windows-1252 where it is not; `UnicodeDecodeError` for what is no text."""
    try:
        return data.decode("utf-8-sig")
    except UnicodeDecodeError as problem:
        if data.startswith(_MARKED) or _NO_TEXT.search(data):
            raise
        try:
            text = data.decode(_WINDOWS)
        except UnicodeDecodeError:
            raise problem from None
        # the words about the first such letter show whether it was taken as meant
        at = problem.start
        words = text[:at].rpartition("\n")[2][-30:] + text[at : at + 30].partition("\n")[0]
        warnings.warn(
            f"{path} is not UTF-8 and is read as Windows-1252: '{words.strip()}'; save it as UTF-8 where "
            "letters are wrong",
            stacklevel=2,
        )
        return text


def _rows(
    path: str | os.PathLike[str], lines: list[str], separator: str
) -> Iterator[tuple[int, list[str]]]:  # fmt: skip
    """Yield number and cells of every line that holds any."""
    # remarks become empty, so that lines keep their numbers and quotes in remarks open no cell
    plain = ("" if line.lstrip().startswith("#") else line for line in lines)
    reader = csv.reader(plain, delimiter=separator, skipinitialspace=True)
    try:
        for row in reader:
            cells = [cell.strip() for cell in row]
            if any(cells):
                yield reader.line_num, cells
    except csv.Error as problem:
        raise ValueError(f"{path}: line {reader.line_num}: is not a line of a table: {problem}") from None
