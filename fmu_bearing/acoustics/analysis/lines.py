"""Lines in spectra: where the kinematics expect them, which exceed their surroundings, what explains them."""

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies

_LOBE = 5  # bins: a line under a flat-top window is that wide
_ABOVE = 6.0  # dB over what surrounds it makes a peak a line
_AROUND = 25  # bins to either side that surround a peak
_PASSING = ("f_i", "f_o", "f_b")
#: Side bands to either side of multiples of high order: the inner race's waves turn with the shaft, the form
#: of the balls with the cage.
_HIGH: dict[str, dict[str, int]] = {"f_i": {"f_r": 2}, "f_b": {"f_c": 1}}
_FEW = 3  # frequencies that a line may add up and be named without those that fit as well
_WHIRL = 4  # multiples of a whirl's frequency: it varies, and with it many times as much
_WIDE = 3  # bins to either side: the lobe of a flat-top window
_NEAR = 0.75  # bins by which noise and neighbours move a line
_LATER = 1000  # added to the rank of sums: multiples that are as near come first
_ALONE = 20.0  # tolerances between multiples of high order: closer ones fit one line in ten by chance
_MOST = 400  # multiples of the passing of balls


@dataclass(frozen=True)
class KinematicLine:
    """A frequency (Hz) that a turning bearing produces.

    ``name`` reads like ``2 f_o + f_c``; ``rank`` grows with harmonics and sidebands: the simpler explains.
    ``terms``: how many frequencies are added up, 3 for ``2 f_o + f_c``. ``apart``: Hz between this line of a
    high order and its neighbour of the same kind; infinite for all others.
    """

    frequency: float
    name: str
    rank: int
    terms: int = 1
    apart: float = math.inf


@dataclass(frozen=True)
class Line:
    """A line of a spectrum: frequency (Hz), level (dB), and what explains it, if anything.

    ``name`` is empty for an unexplained line; ``off`` is its distance (Hz) from the kinematic frequency.
    ``nearest`` names the nearest kinematic line of an unexplained one, ``nearest_off`` is its distance (Hz).
    ``fits``: how many kinematic lines are as near as the one that explains it has to be; ``terms``: how many
    frequencies that one adds up.
    """

    frequency: float
    level: float
    name: str = ""
    off: float = float("nan")
    nearest: str = ""
    nearest_off: float = float("nan")
    fits: int = 0
    terms: int = 0

    @property
    def words(self) -> str:
        """What explains it, as one of how many where it is a sum of many; empty: nothing."""
        if self.fits > 1 and self.terms > _FEW:
            return f"{self.name}, one of {self.fits} that fit"
        return self.name

    @property
    def explanation(self) -> str:
        """What explains it; else what is nearest, with a question mark and the distance; empty: nothing."""
        if self.name or not self.nearest:
            return self.name
        return f"{self.nearest}? {self.nearest_off:+.0f} Hz"


def kinematic_lines(
    frequencies: KinematicFrequencies,
    highest: float,
    harmonics: int = 12,
    whirl: float = float("nan"),
    defects: Mapping[str, str] = MappingProxyType({}),
) -> list[KinematicLine]:
    """Lines up to ``highest`` (Hz), in order of frequency.

    Harmonics of the shaft f_r, the cage f_c, the balls (f_b and, a defect touching both races, 2 f_b) and of
    the passing of balls at the races f_i and f_o. Those of f_i, f_o and f_b go on to ``highest``, as waves of
    any order are on the surfaces. Up to the number ``harmonics`` they have sidebands by what modulates them:
    the inner race's harmonics and f_r, the balls' and f_c, the outer race's and both. Up to four sidebands by
    f_r, as waviness and unbalance of the turning ring make, and two by f_c: more would explain anything.
    Above that number f_i has two by f_r, 2 f_b one by f_c, f_o none. Multiples of f_i, f_o and 2 f_b are
    simpler than any sum, and so are up to three times f_r, f_c and f_b.
    ``whirl``: f_w (Hz), at which the cage goes round off its middle; NaN: it does not. ``defects``: which
    local defects make the lines at multiples of ``f_o``, ``f_i`` and ``2 f_b``, by these names, with what
    modulates each: f_r, of a ball f_c. Their lines are named after them, and count as simpler than others.
    """
    both = {"f_r": 4, "f_c": 2}
    modulators: dict[str, dict[str, int]] = {
        "f_i": both, "f_o": both, "f_b": {"f_c": 2}, "f_r": {}, "f_c": {},
    }  # fmt: skip
    lines: list[KinematicLine] = []

    def add(n: int, carrier: str, frequency: float, m: int = 0, modulator: str = "") -> None:
        name, beside = combination(n, carrier, m, modulator), abs(m)
        pair = carrier == "f_b"
        # even orders of a ball act on both races; higher odd ones rank as sums do
        simple = n <= _FEW or carrier in ("f_i", "f_o") or (pair and n % 2 == 0)
        base = float(getattr(frequencies, carrier)) * (2.0 if pair else 1.0)
        shares = 1 + 2 * _HIGH.get(carrier, {}).get(modulator, 0)  # lines for each multiple
        apart = base / shares if n > harmonics and carrier in _PASSING else math.inf
        source = defects.get(f"2 {carrier}" if pair else carrier, "")
        if source and not (pair and n % 2) and modulator in ("", "f_c" if pair else "f_r"):
            lines.append(KinematicLine(frequency, f"{name} ({source})", n - 1 + beside, n + beside, apart))
        else:
            rank = n + 2 * beside + 1 if beside else n - 1
            rank += 0 if simple and not beside else _LATER
            lines.append(KinematicLine(frequency, name, rank, n + beside, apart))

    for carrier, by in modulators.items():
        base = float(getattr(frequencies, carrier))
        # the shaft's own go on: f_i + f_o alone is as many times f_r as there are balls
        last = 2 * harmonics if carrier == "f_r" else harmonics
        if carrier in _PASSING and base > 0.0:
            last = max(last, min(int(highest / base) + 1, _MOST))
        for n in range(1, last + 1):
            add(n, carrier, n * base)
            high = _HIGH.get(carrier, {}) if carrier != "f_b" or n % 2 == 0 else {}
            for modulator, sidebands in (by if n <= harmonics else high).items():
                step = float(getattr(frequencies, modulator))
                for m in range(1, sidebands + 1):
                    for sign in (1, -1):
                        add(n, carrier, n * base + sign * m * step, sign * m, modulator)
    if not math.isnan(whirl):
        lines += [KinematicLine(n * whirl, combination(n, "f_w"), n - 1, n) for n in range(1, _WHIRL + 1)]
    return sorted(
        (line for line in lines if 0.0 < line.frequency <= highest), key=lambda line: line.frequency
    )


def combination(n: int, carrier: str, m: int = 0, modulator: str = "") -> str:
    """Return the name of a sum of frequencies: ``2 f_i - f_r`` for n = 2, m = -1."""
    name = _times(n, carrier)
    return name if m == 0 else f"{name} {'+' if m > 0 else '-'} {_times(abs(m), modulator)}"


def _times(n: int, name: str) -> str:
    return name if n == 1 else f"{n} {name}"


def explain(
    frequency: float, lines: Sequence[KinematicLine], tolerance: float
) -> tuple[KinematicLine | None, int]:
    """Return the simplest line within ``tolerance`` (Hz) of a frequency (Hz), and how many lie there.

    None when all are further. Of equally simple ones the nearest.
    """
    near = [line for line in lines if abs(line.frequency - frequency) <= tolerance]
    best = min(near, key=lambda line: (line.rank, abs(line.frequency - frequency)), default=None)
    return best, len(near)


def separable(lines: Sequence[KinematicLine], within: float) -> list[KinematicLine]:
    """Return the lines but those of high orders that are too close to mean anything ``within`` some Hz."""
    return [line for line in lines if line.apart >= _ALONE * within]


def tolerance(frequency: float, bin_width: float, slip: float = 0.0) -> float:
    """Return how far (Hz) a line may be from the one that explains it, in a spectrum with these bins (Hz)."""
    return max(_NEAR * bin_width, slip * frequency)


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
        Share of its frequency by which a line may miss the kinematic one; at least three quarters of a bin.
        Default: as balls slide against rolling at one contact angle.

    Notes
    -----
    A line is a bin higher than all within five bins and 6 dB above the median of the 50 around it; its
    frequency is the middle of the energy of seven bins, which for a tone under a flat-top window is right
    within 0.5 % of a bin.
    """
    f: NDArray[np.float64] = np.asarray(frequency, dtype=float)
    value: NDArray[np.float64] = np.asarray(levels, dtype=float)
    bin_width = float(f[1] - f[0])
    peaks = []
    for i in range(2, len(f) - 1):
        near = value[max(0, i - _LOBE) : i + _LOBE + 1]
        around = value[max(0, i - _AROUND) : i + _AROUND + 1]
        if value[i] < near.max() or value[i] < np.median(around) + _ABOVE:
            continue
        about = slice(max(0, i - _WIDE), i + _WIDE + 1)
        energy = 10.0 ** (0.1 * (value[about] - value[i]))
        peaks.append(Line(float(f[about] @ energy / energy.sum()), float(value[i])))
    peaks = sorted(peaks, key=lambda line: -line.level)[:count]
    return [_explained(line, kinematic, tolerance(line.frequency, bin_width, slip)) for line in peaks]


def _explained(line: Line, kinematic: Sequence[KinematicLine], within: float) -> Line:
    """Return a line with what explains it ``within`` some Hz, else with what is nearest."""
    kinematic = separable(kinematic, within)
    best, fits = explain(line.frequency, kinematic, within)
    if best is not None:
        off = line.frequency - best.frequency
        return replace(line, name=best.name, off=off, fits=fits, terms=best.terms)
    near = nearest_line(line.frequency, kinematic)
    if near is None:
        return line
    return replace(line, nearest=near.name, nearest_off=line.frequency - near.frequency)
