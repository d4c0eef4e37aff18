"""Files of a vibration test: a picture of the bands, the lines, the spectra."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.results.base import write_rows
from fmu_bearing.results.picture_parts import COLOURS, OTHERS, label, save as save_picture, single
from fmu_bearing.results.table import write_csv
from fmu_bearing.vibration_test.anderon import Unit
from fmu_bearing.vibration_test.band import Band
from fmu_bearing.vibration_test.lines import VibrationLine
from fmu_bearing.vibration_test.rig import PIECES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: What `write` writes.
FILES = ("bands.png", "lines.csv", "spectrum.csv")
_WIDTH = 0.35  # of a bar; bands are one apart
_ROOM = 0.45  # to either side of a band that a limit's line reaches


def picture(title: str, bands: Sequence[Band], scale: Mapping[str, float], unit: Unit) -> "Figure":
    """Draw bands as bars, by loading piece, with the range over the seeds and the limits.

    ``scale``: um/s per unit by band.
    """
    figure, ax = single((6.5, 4.0))
    for k, piece in enumerate(PIECES):
        of = [getattr(band, piece) / scale[band.name] for band in bands]
        means = np.array([values.mean() for values in of])
        reach = np.array([[mean - v.min(), v.max() - mean] for mean, v in zip(means, of, strict=True)]).T
        ax.bar(
            np.arange(len(bands)) + (k - 0.5) * _WIDTH, means, _WIDTH, yerr=reach if reach.any() else None,
            color=OTHERS[k], capsize=3, label=f"{piece} loading piece",
            error_kw={"elinewidth": 1.0, "ecolor": "0.3"},
        )  # fmt: skip
    for k, one in enumerate(bands):
        if one.limit is not None:
            named = "limit" if k == 0 else ""  # one entry of the legend
            ends = (k - _ROOM, k + _ROOM)
            ax.hlines(one.limit / scale[one.name], *ends, color=COLOURS["total"], linewidth=2.0, label=named)
    names = [f"{band.name}\n{band.low:g} to {band.high:g} Hz" for band in bands]
    ax.set_xticks(range(len(bands)), names)
    label(ax, "", "radial velocity, um/s rms" if unit == "um/s" else "Anderon", title, grid=False)
    ax.legend(frameon=False, fontsize=8)
    return figure


def write(
    folder: Path, figure: "Figure", lines: Sequence[VibrationLine], spectra: Mapping[str, NDArray[np.float64]]
) -> list[Path]:
    """Write a picture, lines, and spectra by the heads of their columns; return the files."""
    drawn, listed, table = (folder / name for name in FILES)
    save_picture(figure, drawn)
    cells = [
        [f"{row[0]:g}", *(f"{value:.4g}" for value in row[1:])] for row in zip(*spectra.values(), strict=True)
    ]
    return [drawn, write_rows(listed, lines), write_csv(table, list(spectra), cells)]
