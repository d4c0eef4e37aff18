"""The base of results: each value is declared once on its class, with its unit and its heading for people.

A class lists its ``quantities``. Numbers for machines (`Result.summary`, JSON, CSV, netCDF, data frames) and
tables for people (`table`) follow from them. A quantity is a text ``key [unit] = path``: its name in files,
its unit, and the attribute that holds it, also of an attribute (``load.axial``); a method is called. The unit
may be left out where the key ends in one, as ``axial_N``, and the path where it is the key without that unit.
"""

import json
import math
import os
import re
import tempfile
from collections.abc import Callable, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, ClassVar

import numpy as np

from fmu_bearing.extras import need
from fmu_bearing.files import check_file, write_whole
from fmu_bearing.results.table import Table, write_csv

if TYPE_CHECKING:
    import pandas
    import xarray

#: Units by the endings that keys have for them; a torque's key, which ends as a stiffness's, gives its own.
ENDINGS = {
    "rpm": "r/min", "mm_rpm": "mm r/min", "s": "s", "h": "h", "Mrev": "Mrev", "Hz": "Hz", "Hz_1_s": "Hz, 1/s",
    "m": "m", "mm": "mm", "um": "um", "rad": "rad", "deg": "deg", "um_s": "um/s", "mm2_s": "mm2/s", "N": "N",
    "N_mm": "N mm", "N_m": "N/m", "N_um": "N/um", "N_m_rad": "N m/rad", "Pa": "Pa", "GPa": "GPa", "W": "W",
    "W_K": "W/K", "degC": "degC", "dB": "dB", "dBA": "dB(A)", "anderon": "Anderon",
}  # fmt: skip
_SPEC = re.compile(r"(?P<key>\w*)(?: \[(?P<unit>[^\]]+)\])?(?: = (?P<path>[\w.]+))?")


class Quantity:
    """One value of a result: key, unit, path; where people read it, its heading and how it is written.

    Attributes
    ----------
    key : str
        Empty: for people alone.
    unit : str
        ``1`` for plain numbers; empty for words, and where its parts have units of their own.
    head : str, optional
        Of its column, with the unit there; None: for machines alone.
    """

    def __init__(
        self, spec: str, head: str | None = None, form: str | Callable[[Any], str] = "", scale: float = 1.0,
        *, of: Callable[[Any], Any] | None = None, factor: float = 1.0,
    ) -> None:  # fmt: skip
        """Declare a value.

        ``form``: format, or function, of ``scale`` times the value, which is ``factor`` times what is at the
        path, or what ``of`` returns.
        """
        match = _SPEC.fullmatch(spec)
        assert match is not None, spec
        self.key, self.head, self._form, self._scale = match["key"], head, form, scale
        self._of, self._factor = of, factor
        ending = max((one for one in ENDINGS if f"_{self.key}".endswith(f"_{one}")), key=len, default="")
        self.unit = match["unit"] or ENDINGS.get(ending, "")
        self._path = (match["path"] or self.key.removesuffix(f"_{ending}")).split(".")

    def of(self, result: Any) -> Any:
        """Return the value of a result; None where there is none, or no such part."""
        if self._of is not None:
            return self._of(result)
        for name in self._path:
            result = None if result is None else getattr(result, name)
            result = result() if callable(result) else result
        return result if result is None or self._factor == 1.0 else self._factor * result

    def text(self, result: Any) -> str:
        """Return the value as people read it; empty where there is none."""
        value = self.of(result)
        if value is not None and self._scale != 1.0:
            value *= self._scale
        if callable(self._form):
            return self._form(value)
        return "" if value is None or value != value else f"{value:{self._form}}"  # NaN is not itself


class Result:
    """What a study returns: `quantities`, and all that follows from them."""

    quantities: ClassVar[Sequence[Quantity | str]] = ()
    declared: ClassVar[tuple[Quantity, ...]] = ()  # the same, read

    def __init_subclass__(cls) -> None:
        """Read the quantities of a class."""
        super().__init_subclass__()
        cls.declared = tuple(
            Quantity(quantity) if isinstance(quantity, str) else quantity for quantity in cls.quantities
        )

    def summary(self) -> dict[str, Any]:
        """Return all values by name, SI units but where a name ends in a unit, for machines."""
        return {quantity.key: plain(quantity.of(self)) for quantity in self.declared if quantity.key}

    def to_json(self) -> str:
        """Return `summary` as JSON; NaN and infinity become null."""
        return as_json(self.summary())

    def records(self) -> "Sequence[Result]":
        """Return the rows of its table; itself where it has none."""
        return (self,)

    def to_pandas(self) -> "pandas.DataFrame":
        """Return `records` as a table, a column per value; units by column are in ``attrs["units"]``.

        Raises
        ------
        MissingExtra
            Without pandas.
        """
        return _frame(self.records())

    def to_xarray(self) -> "xarray.Dataset":
        """Return `to_pandas` as a dataset over ``row``, units in attributes."""
        frame = _frame(self.records()).rename_axis("row")
        dataset: xarray.Dataset = need("xarray", "a dataset").Dataset.from_dataframe(frame)
        for key, unit in frame.attrs["units"].items():
            dataset[key].attrs["units"] = unit
        return dataset

    def save(self, path: str | os.PathLike[str]) -> Any:
        """Write `summary` to ``.json``, or `records` to ``.csv`` or ``.nc`` (netCDF); return the file.

        Raises
        ------
        ValueError
            For another ending.
        OSError
            Where it cannot be written.
        MissingExtra
            For netCDF without xarray.
        """
        target = check_file(path, (".json", ".csv", ".nc"), "a result")
        if target.suffix == ".json":
            return write_whole(target, self.to_json().encode())
        if target.suffix == ".nc":
            return write_netcdf(target, self.to_xarray())
        return write_rows(target, self.records())


class Study(Result):
    """Many runs of one scene: `records` are the rows of a table, in a page that says how they came about."""

    stem: ClassVar[str]  # of the names of its files
    row: ClassVar[type[Result]]

    def table(self) -> Table:
        """Return columns and rows of texts."""
        return table(self.row, self.records())

    def markdown(self) -> str:
        """Return the study as a page."""
        raise NotImplementedError

    def write(self, folder: str | os.PathLike[str]) -> list[Path]:
        """Write `markdown` and `table` (CSV) into a folder, which is made; return the files."""
        page = write_whole(Path(folder) / f"{self.stem}.md", self.markdown().encode("utf-8"))
        return [page, write_csv(page.with_suffix(".csv"), *self.table())]


def table(kind: type[Result], rows: Sequence[Result], heads: Sequence[str] | None = None) -> Table:
    """Return columns and rows for people: the quantities that have a heading, or those of ``heads``."""
    named = {quantity.head: quantity for quantity in kind.declared if quantity.head is not None}
    columns = list(named) if heads is None else list(heads)
    return columns, [[named[head].text(row) for head in columns] for row in rows]


def _frame(rows: Sequence[Result]) -> "pandas.DataFrame":
    """Return rows as a table with units by column."""
    frame: pandas.DataFrame = need("pandas", "a data frame").DataFrame([_scalars(row) for row in rows])
    units = {quantity.key: quantity.unit for quantity in rows[0].declared} if rows else {}
    frame.attrs["units"] = {key: units.get(key, "") for key in frame.columns}
    return frame


def _scalars(row: Result) -> dict[str, Any]:
    """Return the values of a row; lists and tables as people read them, or left out where people do not."""
    texts = {quantity.key: quantity.text(row) for quantity in row.declared if quantity.head is not None}
    several = {key: value for key, value in row.summary().items() if isinstance(value, dict | list)}
    found = row.summary() | {key: texts.get(key) for key in several}
    return {key: value for key, value in found.items() if value is not None or key not in several}


def write_rows(path: Path, rows: Sequence[Result | dict[str, Any]]) -> Path:
    """Write rows as CSV, numbers with nine digits, and return the file."""
    values = [_scalars(row) if isinstance(row, Result) else row for row in rows]
    cells = [
        [f"{v:.9g}" if isinstance(v, float) else "" if v is None else str(v) for v in row.values()]
        for row in values
    ]
    return write_csv(path, list(values[0]) if values else [], cells)


def write_netcdf(path: Path, data: "xarray.Dataset") -> Path:
    """Write a dataset as netCDF, all of the file or none, and return the file."""
    need("h5netcdf", "netCDF")
    return write_whole(path, written(lambda file: data.to_netcdf(file, engine="h5netcdf"), ".nc"))


def written(write: Callable[[Path], Any], suffix: str) -> bytes:
    """Return the bytes that a writer puts into a file."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / f"result{suffix}"
        write(file)
        return file.read_bytes()


def as_json(value: Any) -> str:
    """Return values as JSON; NaN and infinity become null, because JSON does not have them."""
    return json.dumps(_finite(plain(value)), indent=2, ensure_ascii=False)


def plain(value: Any) -> Any:
    """Return a value with results as their summaries, arrays and tuples as lists, paths as text."""
    if isinstance(value, Result):
        return value.summary()
    if isinstance(value, dict):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, list | tuple):
        return [plain(item) for item in value]
    if isinstance(value, np.ndarray | np.generic):
        return value.tolist()
    return str(value) if isinstance(value, Path) else value


def _finite(value: Any) -> Any:
    if isinstance(value, dict):
        return {key: _finite(item) for key, item in value.items()}
    if isinstance(value, list):
        return [_finite(item) for item in value]
    return None if isinstance(value, float) and not math.isfinite(value) else value
