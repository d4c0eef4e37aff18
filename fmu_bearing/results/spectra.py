"""Spectra of variables and of microphones, with their names and units."""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import amplitude_spectrum
from fmu_bearing.extras import need
from fmu_bearing.results.even_steps import spacing
from fmu_bearing.results.picture_parts import coincident, empty, label, legend_beside, mark_excitation, series
from fmu_bearing.results.table import html_table, number

if TYPE_CHECKING:
    import pandas
    import xarray
    from matplotlib.figure import Figure

#: What the rows of a spectrum are.
VARIABLE, MICROPHONE = "variable", "microphone"
LEVEL = {"units": "dB", "long_name": "level re 20 uPa"}


@dataclass(frozen=True, eq=False, repr=False)
class Spectrum:
    """Values over frequency, one row per variable or microphone.

    Attributes
    ----------
    names : tuple of str
        Variables, or microphones.
    frequency : ndarray, shape (bins,)
        In Hz.
    values : ndarray, shape (names, bins)
        Rms amplitudes of variables in their units; levels (dB re 20 uPa) of microphones. A line's value is
        read at its bin within 0.1 dB (flat-top window).
    units : tuple of str
        Of each row.
    kind : str
        ``"variable"`` or ``"microphone"``.
    excitation_end : float, optional
        Hz: beyond it the surfaces of the scene excite nothing; None: not known.
    """

    names: tuple[str, ...]
    frequency: NDArray[np.float64]
    values: NDArray[np.float64]
    units: tuple[str, ...]
    kind: str = VARIABLE
    excitation_end: float | None = None

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        if name not in self.names:
            raise KeyError(f"there is no {self.kind} '{name}' here; there are {', '.join(self.names)}")
        return np.asarray(self.values[self.names.index(name)])

    def __iter__(self) -> Iterator[str]:
        return iter(self.names)

    def __len__(self) -> int:
        return len(self.names)

    def __repr__(self) -> str:
        return f"Spectrum({', '.join(self.names)}; {len(self.frequency)} bins to {self.frequency[-1]:g} Hz)"

    def _repr_html_(self) -> str:
        rows = [
            [name, number(float(row[top])), unit, f"{self.frequency[top]:.6g}"]
            for name, row, unit in zip(self.names, self.values, self.units, strict=True)
            for top in [1 + int(np.argmax(row[1:]))]  # the first bin is the mean's
        ]
        return html_table(repr(self), [self.kind, "highest", "unit", "at, Hz"], rows)

    def to_xarray(self) -> "xarray.Dataset":
        """Return a dataset over frequency; microphones are a coordinate, units are attributes."""
        xr = need("xarray", "a dataset")
        coords: dict[str, Any] = {"frequency": ("frequency", self.frequency, {"units": "Hz"})}
        if self.kind == MICROPHONE:
            coords["microphone"] = list(self.names)
            return xr.Dataset({"level": (("microphone", "frequency"), self.values, LEVEL)}, coords)
        rows = zip(self.names, self.values, self.units, strict=True)
        about = {"long_name": "rms amplitude"}
        columns = {name: ("frequency", row, about | {"units": unit}) for name, row, unit in rows}
        return xr.Dataset(columns, coords)

    def to_pandas(self) -> "pandas.DataFrame":
        """Return a table over frequency (Hz), a column per name; units by column in ``attrs["units"]``."""
        pd = need("pandas", "a data frame")
        index = pd.Index(self.frequency, name="frequency, Hz")
        frame: pandas.DataFrame = pd.DataFrame(self.values.T, index, list(self.names))
        frame.columns.name = self.kind
        frame.attrs["units"] = dict(zip(self.names, self.units, strict=True))
        return frame

    def plot(self, title: str = "") -> "Figure":
        """Draw the rows over frequency, one panel per unit; amplitudes on a logarithmic scale."""
        panels: dict[str, list[int]] = {}
        for k, unit in enumerate(self.units):
            panels.setdefault(unit, []).append(k)
        figure = empty((10.0, 1.5 + 2.8 * len(panels)))
        axes = figure.subplots(len(panels), 1, sharex=True, squeeze=False)[:, 0]
        for ax, (unit, rows) in zip(axes, panels.items(), strict=True):
            for k, row in enumerate(rows):
                # without the first bin, which is the mean's
                style = series(k, len(rows)) | {"linewidth": 0.8}
                if self.kind == MICROPHONE:
                    style = coincident(k, len(rows))
                ax.plot(self.frequency[1:], self.values[row, 1:], **style, label=self.names[row])
            label(ax, "", "level, dB re 20 uPa" if self.kind == MICROPHONE else f"rms, {unit or '1'}", "")
            if unit != "dB" and (self.values[rows, 1:] > 0.0).any():
                ax.set_yscale("log")
            mark_excitation(ax, self.excitation_end)
            legend_beside(ax)
        axes[-1].set_xlabel("frequency, Hz")
        figure.suptitle(title)
        return figure


def of_variables(
    time: NDArray[np.float64], columns: dict[str, NDArray[np.float64]], units: dict[str, str],
    resolution: float | None, excitation_end: float | None = None,
) -> Spectrum:  # fmt: skip
    """Return the spectrum of variables over evenly spaced times (s).

    Raises
    ------
    ValueError
        For uneven times, or a run too short for the resolution (Hz).
    """
    if len(time) < 8:
        raise ValueError(f"{len(time)} points are too few for a spectrum: take a step that gives 8 or more")
    found = spacing(time)
    if not found.even:
        raise ValueError(
            f"times are {found.words('s')}, and a spectrum needs even steps: take a step that divides the "
            "time, and inputs without jumps between"
        )
    rate = 1.0 / found.step
    spectra = [amplitude_spectrum(values, rate, resolution) for values in columns.values()]
    rows = np.array([rms for _, rms in spectra])
    return Spectrum(tuple(columns), spectra[0][0], rows, tuple(units[name] for name in columns),
                    excitation_end=excitation_end)  # fmt: skip
