"""Files of a vibration test: a picture of the bands, the lines, the spectra."""

import os
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from fmu_bearing.results.picture_parts import COLOURS, OTHERS, label, save as save_picture, single
from fmu_bearing.results.table import write_csv
from fmu_bearing.vibration_test.anderon import Unit, micrometres
from fmu_bearing.vibration_test.rig import PIECES

if TYPE_CHECKING:
    from matplotlib.figure import Figure

    from fmu_bearing.vibration_test.vibration import Vibration

#: What `write` writes.
FILES = ("bands.png", "lines.csv", "spectrum.csv")
_WIDTH = 0.35  # of a bar; bands are one apart
_ROOM = 0.45  # to either side of a band that a limit's line reaches


def picture(found: "Vibration", unit: Unit = "um/s") -> "Figure":
    """Draw the bands as bars, by loading piece, with the range over the seeds and the limits."""
    scale = micrometres(found.scene, unit)
    figure, ax = single((6.5, 4.0))
    bands = found.bands
    for k, piece in enumerate(PIECES):
        of = [getattr(one, piece) / scale[one.name] for one in bands]
        means = np.array([values.mean() for values in of])
        reach = np.array([[mean - v.min(), v.max() - mean] for mean, v in zip(means, of, strict=True)]).T
        ax.bar(
            np.arange(len(bands)) + (k - 0.5) * _WIDTH, means, _WIDTH, yerr=reach, color=OTHERS[k], capsize=3,
            label=f"{piece} loading piece", error_kw={"elinewidth": 1.0, "ecolor": "0.3"},
        )  # fmt: skip
    for k, one in enumerate(bands):
        if one.limit is not None:
            named = "limit" if k == 0 else ""  # one entry of the legend
            ends = (k - _ROOM, k + _ROOM)
            ax.hlines(one.limit / scale[one.name], *ends, color=COLOURS["total"], linewidth=2.0, label=named)
    names = [f"{one.name}\n{one.low:g} to {one.high:g} Hz" for one in bands]
    ax.set_xticks(range(len(bands)), names)
    several = len(found.seeds) > 1
    title = f"{found.scene.name}, vibration test" + (f", {len(found.seeds)} seeds" if several else "")
    label(ax, "", "radial velocity, um/s rms" if unit == "um/s" else "Anderon", title, grid=False)
    ax.legend(frameon=False, fontsize=8)
    return figure


def write(found: "Vibration", folder: str | os.PathLike[str], unit: Unit = "um/s") -> list[Path]:
    """Write the picture and the tables into a folder, which is made, and return the files.

    ``spectrum.csv`` has the rms velocity of each bin on both pieces, and of each source alone.
    """
    target = Path(folder)
    target.mkdir(parents=True, exist_ok=True)
    files = [target / name for name in FILES]
    save_picture(picture(found, unit), files[0])
    rows = [
        [one.band, f"{one.frequency:.2f}", f"{one.velocity:.4g}", f"{one.order:.4f}", one.name, one.source,
         str(one.wave or "")]
        for one in found.lines
    ]  # fmt: skip
    columns = ("band", "frequency, Hz", "velocity, um/s", "order", "line", "source", "wave")
    write_csv(files[1], columns, rows)
    spectra = [found.frequency, *(found.spectrum(piece) for piece in PIECES)]
    spectra += [np.sqrt(one.energy) for one in found.alone.values()]
    heads = [*(f"{piece} piece, um/s" for piece in PIECES), *(f"{name} alone, um/s" for name in found.alone)]
    cells = [[f"{row[0]:g}", *(f"{value:.4g}" for value in row[1:])] for row in np.array(spectra).T]
    write_csv(files[2], ("frequency, Hz", *heads), cells)
    return files
