"""Lines in spectra: where the kinematics expect them, which exceed their surroundings, what explains them."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies

_LOBE = 5  # bins: a line under a flat-top window is that wide
_ABOVE = 6.0  # dB over what surrounds it makes a peak a line
_AROUND = 25  # bins to either side that surround a peak


@dataclass(frozen=True)
class KinematicLine:
    """A frequency (Hz) that rolling without sliding produces.

    ``name`` reads like ``2 f_o + f_c``; ``rank`` grows with harmonics and sidebands: the simpler explains.
    """

    frequency: float
    name: str
    rank: int


@dataclass(frozen=True)
class Line:
    """A line of a spectrum: frequency (Hz), level (dB), and what explains it, if anything.

    ``name`` is empty for an unexplained line; ``off`` is its distance (Hz) from the kinematic frequency.
    ``nearest`` names the nearest kinematic line of an unexplained one, ``nearest_off`` is its distance (Hz).
    """

    frequency: float
    level: float
    name: str = ""
    off: float = float("nan")
    nearest: str = ""
    nearest_off: float = float("nan")

    @property
    def explanation(self) -> str:
        """What explains it; else what is nearest, with a question mark and the distance; empty: nothing."""
        if self.name or not self.nearest:
            return self.name
        return f"{self.nearest}? {self.nearest_off:+.0f} Hz"


def kinematic_lines(
    frequencies: KinematicFrequencies, highest: float, harmonics: int = 12
) -> list[KinematicLine]:
    """Lines up to ``highest`` (Hz), in order of frequency.

    Harmonics of the shaft f_r, the cage f_c, the balls (f_b and, a defect touching both races, 2 f_b) and of
    the passing of balls at the races f_i and f_o; with sidebands by what modulates them: the inner race's
    harmonics and f_r, the balls' and f_c, the outer race's and both. Up to four sidebands by f_r, as waviness
    and unbalance of the turning ring make, and two by f_c: more would explain anything.
    """
    both = {"f_r": 4, "f_c": 2}
    modulators: dict[str, dict[str, int]] = {
        "f_i": both, "f_o": both, "f_b": {"f_c": 2}, "f_r": {}, "f_c": {},
    }  # fmt: skip
    lines = []
    for carrier, by in modulators.items():
        base = float(getattr(frequencies, carrier))
        # the shaft's own go on: f_i + f_o alone is as many times f_r as there are balls
        for n in range(1, (2 * harmonics if carrier == "f_r" else harmonics) + 1):
            lines.append(KinematicLine(n * base, combination(n, carrier), n - 1))
            for modulator, sidebands in by.items():
                step = float(getattr(frequencies, modulator))
                for m in range(1, sidebands + 1):
                    for sign in (1, -1):
                        name = combination(n, carrier, sign * m, modulator)
                        lines.append(KinematicLine(n * base + sign * m * step, name, n + 2 * m + 1))
    return sorted(
        (line for line in lines if 0.0 < line.frequency <= highest), key=lambda line: line.frequency
    )


def combination(n: int, carrier: str, m: int = 0, modulator: str = "") -> str:
    """Return the name of a sum of frequencies: ``2 f_i - f_r`` for n = 2, m = -1."""
    name = _times(n, carrier)
    return name if m == 0 else f"{name} {'+' if m > 0 else '-'} {_times(abs(m), modulator)}"


def _times(n: int, name: str) -> str:
    return name if n == 1 else f"{n} {name}"


def explain(frequency: float, lines: Sequence[KinematicLine], tolerance: float) -> KinematicLine | None:
    """Return the line that best explains a frequency (Hz); None when all are further than ``tolerance`` (Hz).

    Simplicity weighs as much as nearness: at the tolerance a line costs as much as eight ranks (assumed).
    """
    near = [line for line in lines if abs(line.frequency - frequency) <= tolerance]
    return min(
        near,
        key=lambda line: line.rank + 8.0 * ((line.frequency - frequency) / tolerance) ** 2,
        default=None,
    )


def nearest_line(frequency: float, lines: Sequence[KinematicLine]) -> KinematicLine | None:
    """Return the line nearest to a frequency (Hz), the simplest of equally near ones; None without lines."""
    return min(lines, key=lambda one: (abs(one.frequency - frequency), one.rank), default=None)


def strongest_lines(
    frequency: ArrayLike,
    levels: ArrayLike,
    count: int = 12,
    kinematic: Sequence[KinematicLine] = (),
    slip: float = 0.0015,
) -> list[Line]:
    """Return the strongest lines of a spectrum, strongest first.

    Parameters
    ----------
    frequency, levels : array_like, shape (bins,)
        As ``spectrum.level_spectrum`` gives them (Hz, evenly spaced; dB).
    count : int
        How many at most.
    kinematic : sequence of KinematicLine
        What may explain them.
    slip : float
        Share of its frequency by which a line may miss the kinematic one, as balls slide; at least one bin.

    Notes
    -----
    A line is a bin higher than all within five bins and 6 dB above the median of the 50 around it; its
    frequency is refined by a parabola through its neighbours.
    """
    f: NDArray[np.float64] = np.asarray(frequency, dtype=float)
    value: NDArray[np.float64] = np.asarray(levels, dtype=float)
    bin_width = float(f[1] - f[0])
    found = []
    for i in range(2, len(f) - 1):
        near = value[max(0, i - _LOBE) : i + _LOBE + 1]
        around = value[max(0, i - _AROUND) : i + _AROUND + 1]
        if value[i] < near.max() or value[i] < np.median(around) + _ABOVE:
            continue
        below, at, above = value[i - 1 : i + 2]
        curve = below - 2.0 * at + above
        place = f[i] + (0.5 * (below - above) / curve * bin_width if curve < 0.0 else 0.0)
        found.append(Line(float(place), float(at)))
    found = sorted(found, key=lambda line: -line.level)[:count]
    return [_explained(line, kinematic, max(bin_width, slip * line.frequency)) for line in found]


def _explained(line: Line, kinematic: Sequence[KinematicLine], tolerance: float) -> Line:
    """Return a line with what explains it within ``tolerance`` (Hz), else with what is nearest."""
    best = explain(line.frequency, kinematic, tolerance)
    if best is not None:
        return replace(line, name=best.name, off=line.frequency - best.frequency)
    near = nearest_line(line.frequency, kinematic)
    if near is None:
        return line
    return replace(line, nearest=near.name, nearest_off=line.frequency - near.frequency)
