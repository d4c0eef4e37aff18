"""Results of a run, and their files: CSV as FMPy reads and writes it, netCDF."""

import gc
import math
import os
import pathlib
import sys
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from fmpy.util import write_csv
from numpy.typing import NDArray

from fmu_bearing.engine.constants import RPM
from fmu_bearing.extras import need
from fmu_bearing.file_words import NETCDF, RESULT, trouble
from fmu_bearing.files import check_file, plain_file, write_whole
from fmu_bearing.interface.names import chosen_names
from fmu_bearing.results import uff
from fmu_bearing.results.base import Result, write_netcdf, written
from fmu_bearing.results.column_units import unit_of_suffix, unit_of_title
from fmu_bearing.results.defect_lines import defect_labels
from fmu_bearing.results.levels import present, shown
from fmu_bearing.results.rows import read_columns
from fmu_bearing.results.series import Series, structured
from fmu_bearing.results.spectra import Spectrum, of_variables
from fmu_bearing.results.table import html_table
from fmu_bearing.results.time_pictures import time_picture
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.units import split_unit

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

#: Why a run ended.
COMPLETE, REFUSED, INTERRUPTED = "complete", "refused", "interrupted"
#: Endings of files of results that can be read again, and of those that a run is written to.
ENDINGS = (".csv", ".nc")
WRITTEN = (*ENDINGS, ".uff")


class ResultError(ValueError):
    """A file that is not a result, or a name that a result does not have."""


@dataclass(repr=False)
class Run(Series, Result):
    """Variables of a bearing over time, SI units.

    Attributes
    ----------
    name : str
        Of the scene, or of the FMU's model.
    table : structured ndarray, shape (points,)
        ``time`` (s) and one column per variable, as ``fmpy.simulate_fmu`` returns it.
    units : dict
        Unit of each column, ``""`` for plain numbers.
    scene : Scene, optional
        The scene, where it is known.
    wall : float
        Seconds it took; NaN where it is not known.
    ended : str
        ``"complete"``, ``"refused"`` (the bearing or the FMU refused a step) or ``"interrupted"``.
    note : str
        Why it ended early, in words.

    Examples
    --------
    >>> from fmu_bearing import Run, simulate
    >>> simulate("examples/scenes/7003C-bare.toml", 2e-3, outputs=["heat.*"]).save("run.csv")
    PosixPath('run.csv')
    >>> run = Run.load("run.csv")
    >>> run.names, float(run.time[-1])
    (['heat.inner_ring', 'heat.outer_ring', 'heat.oil'], 0.002)
    """

    quantities = (
        "name", "ended", "note", "points [1] = __len__", "time_s = _reached", "wall_s", "last = _last",
    )  # fmt: skip

    wall: float = float("nan")
    ended: str = COMPLETE
    note: str = ""

    @property
    def complete(self) -> bool:
        """Whether the run reached its end."""
        return self.ended == COMPLETE

    def __repr__(self) -> str:
        ended = "" if self.complete else f", {self.ended}: {self.note}"
        points = f"{len(self)} points to {self._reached():g} s"
        return f"Run({self.name}, {points}, {len(self.names)} variables{ended})"

    def _repr_html_(self) -> str:
        last = {
            name: shown(self[name][-1], unit) if len(self) else "-" for name, unit in self._units().items()
        }
        ended = "" if self.complete else f", {self.ended}: {self.note}"
        rows = [[name, last[name], unit] for name, unit in self._units().items()]
        head = ["variable", "last value", "unit"]
        return html_table(f"{self.name} at {self._reached():g} s{ended}", head, rows)

    def save(self, path: str | os.PathLike[str]) -> pathlib.Path:
        """Write to ``.csv`` (as FMPy writes it: SI units, full precision), ``.nc`` (netCDF, with units).

        Or to ``.uff``, a universal file for programs of modal analysis: a function over time per variable,
        13 digits. Errors are those of `Result.save`; a universal file takes even steps alone.
        """
        path = check_target(path, endings=WRITTEN)
        if path.suffix == ".uff":
            places = {name: uff.place_of(name, unit) for name, unit in self._units().items()}
            functions = [uff.signal(place, self.time, self[name]) for name, place in places.items()]
            return uff.write_uff(path, functions, title=self.name)
        if path.suffix == ".csv":
            return write_whole(path, written(lambda file: write_csv(file, self.table), ".csv"))
        return write_netcdf(path, self.to_xarray())

    def to_xarray(self) -> "xarray.Dataset":
        """Return the run as a dataset over time, units in attributes, the scene as TOML text in ``scene``.

        The table of its local defects is JSON text in ``defects``.
        """
        xr = need("xarray", "a dataset")
        scene = "" if self.scene is None else self.scene.to_toml()
        head = {"name": self.name, "ended": self.ended, "note": self.note, "scene": scene}
        head |= defect_labels(self.scene)
        columns = {name: ("time", self[name], {"units": unit}) for name, unit in self._units().items()}
        return xr.Dataset(columns, {"time": ("time", self.time, {"units": "s"})}, head)

    def to_pandas(self) -> "pandas.DataFrame":
        """Return the run as a table over time (s), a column per variable, SI units.

        Units by column are in ``attrs["units"]``, name and end of the run in ``attrs``.

        Raises
        ------
        MissingExtra
            Without pandas.

        Examples
        --------
        >>> from fmu_bearing import simulate
        >>> run = simulate("examples/scenes/7003C-bare.toml", 2e-3, outputs=["friction_torque"])
        >>> frame = run.to_pandas()
        >>> frame.shape, frame.index.name, frame.attrs["units"]["friction_torque"]
        ((3, 1), 'time, s', 'N.m')
        """
        pd = need("pandas", "a data frame")
        columns = {name: self[name] for name in self.names}
        frame: pandas.DataFrame = pd.DataFrame(columns, pd.Index(self.time, name="time, s"))
        frame.attrs |= {"name": self.name, "ended": self.ended, "note": self.note, "units": self._units()}
        return frame

    def plot(self, variables: str | Sequence[str] | None = None, title: str = "") -> "Figure":
        """Draw variables over time, one panel per unit.

        Parameters
        ----------
        variables : str or sequence of str, optional
            Names, with ``*`` for any text; default: the usual ones that the run has.
        title : str
            Default: the run's name.

        Raises
        ------
        UnknownName
            For a name that matches nothing.
        MissingExtra
            Without Matplotlib.
        """
        return time_picture(self, _listed(variables), title)

    def spectrum(
        self, variables: str | Sequence[str], resolution: float | None = None, settle: float = 0.0
    ) -> Spectrum:
        """Return rms amplitudes of variables over frequency, up to half the rate of communication points.

        What lies above that frequency is folded below it: choose the step of the run accordingly.

        Parameters
        ----------
        variables : str or sequence of str
            Names, with ``*`` for any text.
        resolution : float, optional
            Spacing of the bins (Hz), by blocks averaged in energy; default: one block.
        settle : float
            Time (s) left out at the beginning.

        Raises
        ------
        UnknownName
            For a name that matches nothing.
        ValueError
            For uneven times, or a run too short for the resolution.

        Examples
        --------
        >>> from fmu_bearing import simulate, with_fidelity
        >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="rings")
        >>> run = simulate(scene, 0.06, step=1e-4, outputs=["outer_ring.velocity.*"])
        >>> spectrum = run.spectrum("outer_ring.velocity.*", resolution=50.0, settle=0.01)
        >>> spectrum.names[0], spectrum.units[0], round(float(spectrum.frequency[-1]))
        ('outer_ring.velocity.x', 'm/s', 5000)
        """
        names = chosen_names(_listed(variables), self.names, ())
        after = self.time >= self.time[0] + settle - 1e-9
        columns = {n: self[n][after] for n in names}
        return of_variables(self.time[after], columns, self._units(), resolution, self.excitation_end)

    @property
    def excitation_end(self) -> float | None:
        """Frequency (Hz) up to which the scene's surfaces excite it; None: not known.

        At the mean of ``shaft_speed`` where it was kept, else at the scene's speed.
        """
        if self.scene is None:
            return None
        from fmu_bearing.prepare.imperfections import excitation_end

        kept = "shaft_speed" in self.names
        speed = float(np.mean(self["shaft_speed"])) if kept else self.scene.operation.speed_rpm * RPM
        return excitation_end(self.scene, speed)

    @classmethod
    def load(cls, path: str | os.PathLike[str]) -> "Run":
        """Read ``.csv`` (ours, FMPy's, or any with ``time`` and numbers) or ``.nc`` as `save` writes it.

        A CSV file may come from a spreadsheet: semicolons or tabs, decimal commas, units in titles or in a
        row of their own, by which values are converted to SI.

        Raises
        ------
        ResultError
            For a file that is none of these.
        """
        path = pathlib.Path(path)
        if path.suffix == ".nc":
            return cls._load_netcdf(_plain(path))
        return cls(path.stem, *_read(path))

    @classmethod
    def _load_netcdf(cls, path: pathlib.Path) -> "Run":
        xr = need("xarray", "netCDF")
        need("h5netcdf", "netCDF")
        words = ""
        with _no_word_of_open_files():
            try:
                with xr.open_dataset(path, engine="h5netcdf", decode_times=False) as data:
                    data.load()
                if "time" not in data.coords or any(data[n].dims != ("time",) for n in data.data_vars):
                    raise ResultError("holds no variables over time; sweeps are read by xarray")
                columns = {"time": data["time"].values} | {str(n): data[n].values for n in data.data_vars}
                table = structured({n: values.astype(float) for n, values in columns.items()})
                units = {str(n): str(data[n].attrs.get("units", "")) for n in data.data_vars}
                scene, name, ended, note = (
                    str(data.attrs.get(key, default))
                    for key, default in (
                        ("scene", ""), ("name", path.stem), ("ended", COMPLETE), ("note", "")
                    )
                )  # fmt: skip
            except ResultError as problem:
                words = str(problem)
            except Exception as problem:  # its libraries raise what they come upon in damaged files
                words = trouble(path, NETCDF, problem, known=False)
            if words:
                gc.collect()  # closes what was opened in part, while nothing is printed of it
        if words:
            raise ResultError(f"{path}: {words}")
        read = read_scene_text(scene, str(path)) if scene else None
        return cls(name, table, units, read, ended=ended, note=note)

    def _last(self) -> dict[str, dict[str, Any]]:
        """Return the last values with their units; of a level None where metering has not begun."""
        return {
            name: {"value": None if math.isnan(value) else value, "unit": unit}
            for name, unit in self._units().items()
            for value in present(self[name][-1:], unit).tolist()
        }


@contextmanager
def _no_word_of_open_files() -> Iterator[None]:
    """Print nothing when a file that was opened in part is closed, which h5netcdf does with a traceback."""
    before = sys.unraisablehook
    sys.unraisablehook = lambda _: None
    try:
        yield
    finally:
        sys.unraisablehook = before


def _listed(names: str | Sequence[str] | None) -> Sequence[str] | None:
    """Return names as a list, also where only one is given."""
    return [names] if isinstance(names, str) else names


def check_target(
    path: str | os.PathLike[str], what: str = "a result", endings: tuple[str, ...] = ENDINGS
) -> pathlib.Path:
    """Return the path of a result, or raise if it cannot be written there; called before a long run.

    ``what`` is written, for the message, to files of these ``endings``.

    Raises
    ------
    ValueError
        For another ending.
    OSError
        As `check_file`.
    MissingExtra
        For netCDF without xarray and h5netcdf.
    """
    target = check_file(path, endings, what)
    if target.suffix == ".nc":
        need("xarray", "netCDF")
        need("h5netcdf", "netCDF")
    return target


def read_table(path: str | os.PathLike[str]) -> NDArray[Any]:
    """Read a CSV file of numbers over time as a table in SI units; see `results.rows.read_columns`.

    Raises
    ------
    ResultError
        Naming the file, the column and what is wrong.
    """
    return _read(path)[0]


def _read(path: str | os.PathLike[str]) -> tuple[NDArray[Any], dict[str, str]]:
    """Return a CSV file's table, and the units that its titles state, in SI where they are known."""
    try:
        titles, _, values = read_columns(path, RESULT)
    except ValueError as problem:
        raise ResultError(str(problem)) from None
    columns: dict[str, NDArray[np.float64]] = {}
    units = {}
    for place, title in enumerate(titles):
        unit = unit_of_title(title)
        base, suffix = split_unit(title)
        # a name with the suffix of its unit, as speed_rpm: SI values have the name without
        same = unit is not None and suffix and unit_of_suffix(suffix, unit.si)[:2] == unit[:2]
        name = base if same else str(title)
        if not name or name in columns:
            words = f"'{title.written}' is given more than once" if name else f"{place + 1} has no title"
            raise ResultError(f"{path}: column {words}")
        columns[name] = values[:, place] if unit is None else unit.to_si(values[:, place])
        if title.unit:
            units[name] = title.unit if unit is None else unit.si
    return structured(columns), units


def _plain(path: str | os.PathLike[str]) -> pathlib.Path:
    """Return the path of a file that can be read; `ResultError` where there is none."""
    try:
        return plain_file(path)
    except OSError as problem:
        raise ResultError(f"{path}: {trouble(path, NETCDF, problem)}") from None
