"""Measured values of a vibration test: bands and lines, checked, with their standard deviations."""

import math
from collections.abc import Mapping, Sequence
from typing import NamedTuple

from fmu_bearing.vibration_test.inverse.energies import Window, band_windows, line_window
from fmu_bearing.vibration_test.inverse.posterior import Value
from fmu_bearing.vibration_test.inverse.runs import Spectra
from fmu_bearing.vibration_test.rig import BANDS

#: Relative standard deviation of a measured value: assumed.
DEVIATION = 0.1
_LEAST_DEVIATION, _MOST_DEVIATION = 0.03, 1.0
#: Of M at least: its value hangs on the loading piece (31 to 107 um/s on the 7003C) and on the form's size.
_MIDDLE_DEVIATION = 0.38
_HIGHEST = 1e4  # um/s


class Measured(NamedTuple):
    """What was measured: windows of the spectrum and their values."""

    windows: tuple[Window, ...]
    values: tuple[Value, ...]

    @property
    def words(self) -> str:
        """All values in words."""
        return ", ".join(
            f"{window.name} {'at most' if value.at_most else '='} {value.velocity:.3g}"
            for window, value in zip(self.windows, self.values, strict=True)
        ) + " um/s"  # fmt: skip


def check(bands: Mapping[str, float], lines: Mapping[str, float], deviation: float) -> None:
    """Refuse values that no test reads, and too few, before anything is run.

    ``bands``, ``lines``: um/s by name.

    Raises
    ------
    ValueError
        With the name, the value and what is allowed.
    """
    for name, value in {**bands, **lines}.items():
        if not (isinstance(value, int | float) and math.isfinite(value) and 0.0 < value <= _HIGHEST):
            raise ValueError(
                f"{name} = {value:g} um/s: give um/s rms above 0, {_HIGHEST:g} at most; values in Anderon "
                "need --unit anderon (unit=)"
            )
    if len(bands) + len(lines) < 2:
        given = ", ".join([*bands, *lines]) or "no value"
        raise ValueError(
            f"{given} alone: amplitude and exponent are two numbers: give two bands, as L=41,H=54, or a band "
            'and a line, as --line "f_i - f_r=9" (lines=)'
        )
    if not _LEAST_DEVIATION <= deviation <= _MOST_DEVIATION:
        raise ValueError(
            f"a standard deviation of {100.0 * deviation:g} %: give {100.0 * _LEAST_DEVIATION:g} to "
            f"{100.0 * _MOST_DEVIATION:g} %; two testers and the model agree no better"
        )


def measured(
    spectra: Spectra, bands: Mapping[str, float], lines: Mapping[str, float], deviation: float, at_most: bool
) -> Measured:
    """Return bands and lines as windows of the spectra, with their values.

    Raises
    ------
    ValueError
        For a line that is none.
    """
    windows: Sequence[Window] = [one for one in band_windows(spectra.scene) if one.name in bands]
    values = [
        Value(
            bands[window.name], max(deviation, _MIDDLE_DEVIATION if window.name == BANDS[1] else 0.0), at_most
        )
        for window in windows
    ]
    of_lines = [line_window(spectra, name) for name in lines]
    # a line is read from a spectrum: a value, also beside limits of the bands
    values += [Value(value, deviation) for value in lines.values()]
    return Measured((*windows, *of_lines), tuple(values))
