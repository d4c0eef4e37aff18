"""Measured values: files and tables read into rows, checked, with all problems listed at once."""

import math
import os
import pathlib
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any

import numpy as np

from fmu_bearing.acoustics.analysis.field import Position
from fmu_bearing.identification.errors import IdentifyError
from fmu_bearing.identification.quantities import Quantity, parse_quantity
from fmu_bearing.interface.names import UnknownName, known
from fmu_bearing.recording.channels.microphone_places import place_name
from fmu_bearing.results.column_units import suffixed
from fmu_bearing.results.rows import read_rows
from fmu_bearing.run.figures import A_LEVEL, LEVEL
from fmu_bearing.scene import Scene
from fmu_bearing.scene.values import fields_of, limits

#: Short names of frequent conditions, with the unit that a table carries; a set has its preload elsewhere.
CONDITIONS = {"speed_rpm": "operation.speed_rpm", "preload_N": "mounting.preload_N"}
_SHORT = {key: name for name, key in CONDITIONS.items()} | dict.fromkeys(
    ("spindle.preload.preload_N", "spindle.preload.force_N"), "preload_N"
)
PLACE = ("x_mm", "y_mm", "z_mm")
COLUMNS = ("microphone", *PLACE, *CONDITIONS, "quantity", "value_dB", "value_mm_s", "std_dB", "role")
FIT, CHECK = "fit", "check"
STD = 2.0  # dB, assumed where the data give no standard deviation: repeated set-ups of one machine differ so
BACKGROUND = "background_"
VELOCITY_REFERENCE = 1e-9  # m/s, ISO 1683
_LOWEST, _HIGHEST = -60.0, 220.0  # dB: beyond is no level of a bearing but another unit
#: dB: levels of machines that run, of sound and of velocities; a narrow band or a line may be quieter.
USUAL, QUIETEST_PART = (20.0, 160.0), 5.0
SLOWEST = 500.0  # r/min: slower spindles are hardly measured
_MOST = 12  # problems listed at once


@dataclass(frozen=True)
class Datum:
    """One measured value.

    Attributes
    ----------
    quantity : Quantity
    place : str
        Name of the microphone, or its coordinates in words; empty for a velocity.
    position : (x, y, z) or None
        Of the microphone, in m; None for a velocity.
    conditions : tuple of (key, value)
        Values of the scene under which it was measured: dotted keys, in the scene's units.
    value, std : float
        Level and its standard deviation (dB; pressure re 20 uPa, velocity re 1 nm/s).
    fit : bool
        Whether it is fitted; False: checked only.
    background : float
        Level (dB) that is there without the bearing, added to the computed one as energy; -inf: none.
    source : str
        File and line, for messages.
    """

    quantity: Quantity
    place: str
    position: Position | None
    conditions: tuple[tuple[str, float], ...]
    value: float
    std: float = STD
    fit: bool = True
    background: float = -math.inf
    source: str = ""

    @property
    def label(self) -> str:
        """Place, conditions and quantity in a few words."""
        parts = [f"{_SHORT.get(key, key)} {value:g}" for key, value in self.conditions]
        return " ".join(word for word in (self.place, *parts, self.quantity.text) if word)


Source = str | os.PathLike[str] | Iterable[Any] | Any


def read_data(
    source: Source, scene: Scene, background: Source | None = None, *, accept: bool = False
) -> tuple[Datum, ...]:
    """Return the measured values in a table, checked against a scene.

    Parameters
    ----------
    source : path, pandas.DataFrame, xarray.Dataset, sequence of mapping, or sequence of Datum
        Columns as in `COLUMNS`; any other column is a dotted key of the scene. A file has commas,
        semicolons or tabs between its values (beside semicolons and tabs, a decimal comma is read too) and
        may have lines of remarks that begin with #. In a dataset, NaN means that nothing was measured.
    scene : Scene
        Its microphones are known by name; a condition that is left out is the scene's.
    background : like source, optional
        Background levels with the same columns, without ``std_dB`` and ``role``. They may also be among
        the data, as quantities ``background_leq``, ``background_line[f_r]`` and so on.
    accept : bool
        Take levels and speeds that no machine usually has as they are; by default they are asked about.

    Raises
    ------
    IdentifyError
        With a line per problem: place, value, what is allowed.
    """
    problems: list[str] = []
    rows = _rows(source, scene, problems)
    extra = () if background is None else _rows(background, scene, problems, background=True)
    asked = [] if problems or accept else [one for row in (*rows, *extra) for one in _questions(row)]
    if problems or asked:
        lines = problems or asked
        more = [f"and {len(lines) - _MOST} more"] if len(lines) > _MOST else []
        way_out = ["correct these, or if they are what was measured allow them: --accept (accept=True)"]
        raise IdentifyError("\n".join(lines[:_MOST] + more + (way_out if asked else [])))
    if not rows:
        raise IdentifyError(f"{_name(source)} holds no measured value: give rows with {', '.join(COLUMNS)}")
    loud = {_identity(row): row for row in (*rows, *extra) if row.quantity.text.startswith(BACKGROUND)}
    data = []
    for row in rows:
        if row.quantity.text.startswith(BACKGROUND):
            continue
        noise = loud.pop(_identity(row, BACKGROUND), None)
        data.append(row if noise is None else replace(row, background=noise.value))
    if loud:
        lost = ", ".join(f"{row.source} ({row.label})" for row in list(loud.values())[:3])
        raise IdentifyError(f"background without a measured value beside it: {lost}")
    if not data:
        raise IdentifyError(f"{_name(source)} holds backgrounds only: give measured values too")
    return tuple(data)


def _questions(row: Datum) -> Iterable[str]:
    """Ask about a level or a speed that is probably another unit, or no measurement."""
    low = USUAL[0] if row.quantity.kind in (LEVEL, A_LEVEL) else QUIETEST_PART
    where = f"{row.source}: " if row.source else ""
    if not low <= row.value <= USUAL[1]:
        pressure = row.quantity.channel is None and 0.0 < row.value < low
        in_dB = 20.0 * math.log10(row.value / 2e-5) if pressure else 0.0
        asked = (
            "is this microphone dead?" if row.value == 0.0
            else f"is it a pressure in Pa? {row.value:g} Pa are {in_dB:.1f} dB" if pressure
            else "is it another unit?"
        )  # fmt: skip
        yield (
            f"{where}{row.label} = {row.value:g} dB lies outside {low:g} to {USUAL[1]:g} dB, where "
            f"{'levels' if low == USUAL[0] else 'bands and lines'} of machines lie: {asked}"
        )
    for key, value in row.conditions:
        if key == CONDITIONS["speed_rpm"] and abs(value) < SLOWEST:
            yield (
                f"{where}speed_rpm = {value:g} is below {SLOWEST:g} r/min: is it in Hz? {value:g} Hz are "
                f"{60.0 * value:g} r/min"
            )


def _identity(row: Datum, prefix: str = "") -> tuple[Any, ...]:
    return row.position, row.conditions, prefix + row.quantity.text


def _as_background(row: Datum) -> Datum:
    text = BACKGROUND + row.quantity.text.removeprefix(BACKGROUND)
    return replace(row, quantity=replace(row.quantity, text=text))


def _name(source: Source) -> str:
    return str(source) if isinstance(source, str | os.PathLike) else "the data"


def _rows(source: Source, scene: Scene, problems: list[str], background: bool = False) -> list[Datum]:
    """Read rows; problems are added to the list."""
    listed = list(source) if isinstance(source, Sequence) and not isinstance(source, str) else None
    if listed and all(isinstance(one, Datum) for one in listed):
        return [_as_background(one) for one in listed] if background else listed
    rows = []
    reader = _Reader(scene, background)
    try:
        table = list(_records(source))
    except IdentifyError as problem:
        problems.append(str(problem))
        return []
    if table:
        try:
            reader.check_columns(_name(source), list(dict.fromkeys(key for _, row in table for key in row)))
        except IdentifyError as problem:
            problems.append(str(problem))
            return []
    for where, row in table:
        try:
            rows.append(reader.read(where, row))
        except IdentifyError as problem:
            problems += [f"{where}: {line}" for line in str(problem).splitlines()]
    twice: dict[Any, Datum] = {}
    for one in rows:
        first = twice.setdefault(_identity(one), one)
        if first is not one:
            problems.append(
                f"{one.source}: {one.label} was given before, in {first.source}; give a mean once"
            )
    return rows


def _records(source: Source) -> Iterable[tuple[str, dict[str, Any]]]:
    """Yield file and line of each row, and the row as a mapping."""
    if isinstance(source, str | os.PathLike):
        yield from _file(pathlib.Path(source))
        return
    if hasattr(source, "to_dataframe"):  # xarray: a grid has holes
        frame = source.to_dataframe().reset_index()
        values = [name for name in ("value_dB", "value_mm_s") if name in frame]
        if not values:
            raise IdentifyError("the dataset has no variable value_dB")
        source = frame.dropna(subset=values, how="all")
    if hasattr(source, "to_dict") and hasattr(source, "columns"):  # pandas
        source = source.to_dict("records")
    if not isinstance(source, Iterable) or isinstance(source, Mapping):
        raise IdentifyError(
            f"data of type {type(source).__name__} cannot be read: give a CSV file, a DataFrame, a Dataset, "
            "or a list of mappings"
        )
    for place, row in enumerate(source):
        if not isinstance(row, Mapping):
            raise IdentifyError(f"row {place} of the data is a {type(row).__name__}, not a mapping by column")
        yield f"row {place}", {str(key): value for key, value in row.items()}


def _file(path: pathlib.Path) -> Iterable[tuple[str, dict[str, Any]]]:
    try:
        titles, rows = read_rows(path)
    except ValueError as problem:
        raise IdentifyError(str(problem)) from None
    if not titles:
        raise IdentifyError(f"{path}: is empty; its first line names the columns: {', '.join(COLUMNS)}")
    columns = [suffixed(title) for title in titles]
    for number, cells in rows:
        where = f"{path}, line {number}"
        if len(cells) != len(columns):
            raise IdentifyError(f"{where}: {len(cells)} values for {len(columns)} columns")
        yield where, dict(zip(columns, cells, strict=True))


class _Reader:
    """Reads rows for one scene."""

    def __init__(self, scene: Scene, background: bool) -> None:
        self.scene, self.background = scene, background
        self.places: dict[str, Position] = {place.name: place.position_m for place in scene.microphones}
        self.fields = fields_of(scene)
        self.keys = CONDITIONS | {"preload_N": scene.assembly.preload_key}

    def check_columns(self, name: str, columns: list[str]) -> None:
        """Refuse columns that are neither of ours nor keys of the scene, and tables without values."""
        for column in columns:
            if column not in COLUMNS:
                try:
                    known(column, [*COLUMNS, *self.fields], "column")
                except UnknownName as problem:
                    raise IdentifyError(
                        f"{name}: {problem}; columns are {', '.join(COLUMNS)} and dotted keys of the scene"
                    ) from None
        missing = [] if "quantity" in columns else ["quantity"]
        if "value_dB" not in columns and "value_mm_s" not in columns:
            missing.append("value_dB")
        if missing:
            raise IdentifyError(f"{name}: column {' and '.join(missing)} is missing; there are {columns}")

    def read(self, where: str, row: dict[str, Any]) -> Datum:
        """Return one row; IdentifyError where a value is refused."""
        text = str(row.get("quantity", "") or "").strip()
        quiet = text.startswith(BACKGROUND)
        quantity = parse_quantity(text.removeprefix(BACKGROUND), self.scene)
        if quiet or self.background:
            quantity = replace(quantity, text=BACKGROUND + quantity.text)
        place, position = ("", None) if quantity.channel is not None else self._position(row)
        std = _number(row, "std_dB", STD)
        if not std > 0.0:
            raise IdentifyError(f"std_dB = {std:g} must be above 0; an exact value does not exist: try 0.5")
        role = FIT if _blank(row.get("role")) else str(row["role"]).strip()
        if role not in (FIT, CHECK):
            raise IdentifyError(f"role = '{role}' is unknown: write {FIT} or {CHECK}")
        conditions = self._conditions(row)
        value = _value(row, quantity)
        return Datum(quantity, place, position, conditions, value, std, role == FIT, -math.inf, where)

    def _position(self, row: dict[str, Any]) -> tuple[str, Position]:
        given = [axis for axis in PLACE if not _blank(row.get(axis))]
        name = "" if _blank(row.get("microphone")) else str(row["microphone"]).strip()
        if given and name:
            raise IdentifyError(f"microphone = '{name}' and {', '.join(given)} are given: leave out one")
        if given:
            if len(given) < 3:
                raise IdentifyError(f"{', '.join(given)} alone is not a place: give {', '.join(PLACE)}")
            x, y, z = (1e-3 * _number(row, axis) for axis in PLACE)
            return place_name((x, y, z)), (x, y, z)
        if name not in self.places:
            there = ", ".join(self.places) or "none"
            lost = f"there is no microphone '{name}'" if name else "a sound level needs its microphone"
            raise IdentifyError(f"{lost}; the scene has {there}; or give {', '.join(PLACE)}")
        return name, self.places[name]

    def _conditions(self, row: dict[str, Any]) -> tuple[tuple[str, float], ...]:
        conditions = {}
        for column, cell in row.items():
            key = self.keys.get(column, column)
            if (column in COLUMNS and column not in CONDITIONS) or _blank(cell):
                continue
            if key in conditions:
                raise IdentifyError(f"{column} and {key} are the same condition: give one column")
            value = _number(row, column)
            low, high = limits(self.fields[key])
            if not low <= value <= high:
                raise IdentifyError(f"{column} = {value:g} lies outside {low:g} to {high:g}")
            conditions[key] = value
        return tuple(sorted(conditions.items()))


def _blank(cell: Any) -> bool:
    return cell is None or (isinstance(cell, str) and not cell.strip()) or (
        isinstance(cell, float) and math.isnan(cell)
    )  # fmt: skip


def _number(row: dict[str, Any], column: str, default: float | None = None) -> float:
    cell = row.get(column)
    if default is not None and _blank(cell):
        return default
    try:
        value = float(cell)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        raise IdentifyError(f"{column} = '{cell}' is not a number") from None
    if not math.isfinite(value):
        raise IdentifyError(f"{column} = {cell} is not finite: leave the row out where nothing was measured")
    return value


def _value(row: dict[str, Any], quantity: Quantity) -> float:
    """Level (dB) of a row."""
    speed = row.get("value_mm_s")
    if not _blank(speed) and _blank(row.get("value_dB")):
        if quantity.channel is None:
            raise IdentifyError(
                f"value_mm_s belongs to a velocity, '{quantity.text}' is a sound level: value_dB"
            )
        rms = 1e-3 * _number(row, "value_mm_s")
        if not rms > 0.0:
            raise IdentifyError(f"value_mm_s = {1e3 * rms:g} must be above 0")
        return 20.0 * float(np.log10(rms / VELOCITY_REFERENCE))
    if not _blank(speed):
        raise IdentifyError("value_dB and value_mm_s are both given: leave out one")
    value = _number(row, "value_dB")
    if not _LOWEST <= value <= _HIGHEST:
        raise IdentifyError(
            f"value_dB = {value:g} is not a level in dB (re 20 uPa, velocities re 1 nm/s), which lies "
            f"between {_LOWEST:g} and {_HIGHEST:g}"
        )
    return value
