"""Fast kurtogram: kurtosis of the envelope in bands over frequency and width, which finds repeated impulses.

Antoni (2007), Fast computation of the kurtogram for the detection of transient faults, Mechanical Systems and
Signal Processing 21, 108-124: a tree of filters halves the bands again and again, and divides those of each
level in three, too. Of a band's complex envelope c the kurtosis is <|c|^4> / <|c|^2>^2 - 2, which noise
brings to 0 and a steady tone to -1.
"""

import functools
import math
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.results.picture_parts import OTHERS, label, single

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_TAPS, _BETA = 24, 8.0  # of a filter per divisor, Kaiser's window: it stops by 80 dB
_FEWEST = 128  # samples of a band's envelope: noise then has a kurtosis of 0 to 0.2
#: Of the mean square between ``lowest`` and ``highest``: a band that is chosen holds that or more, a tenth of
#: the rms. Kurtosis is without scale, and largest where all else is quiet: balls that tap the cage of a sound
#: bearing are sharp strokes at 17 kHz with 3 % of the rms. 20 dB below the vibration are also a sensor's
#: distortion and a converter's steps. Of 21 records of races by the CWRU (1,797 r/min, drive end) the line of
#: the race was 28 dB over the median in the mean without this rule, and is 34 dB with it: higher in 12, lower
#: in 3 by 5 dB at most; of the MFPT's 14 records it changes one, from 13 to 37 dB.
_FAINT = 0.01
_INSIDE = 2.0 / 3.0  # of a band that counts


@dataclass(frozen=True)
class Band(Result):
    """A band of a kurtogram."""

    quantities = (
        Quantity("low_Hz", "from, Hz", ",.0f"), Quantity("high_Hz", "to, Hz", ",.0f"),
        Quantity("level [1]", "level", ".1f"), Quantity("kurtosis [1]", "kurtosis", ".2f"),
        Quantity("share [1]", "of the mean square, %", ".2g", 100.0),
    )  # fmt: skip

    low: float
    high: float
    level: float
    """How often the whole was halved; a third of a band counts 1.58."""
    kurtosis: float
    share: float
    """Of the signal's mean square."""


@dataclass(frozen=True)
class Kurtogram(Result):
    """Kurtosis in bands of a signal."""

    quantities = ("best", "bands = records")

    bands: tuple[Band, ...] = field(repr=False)
    """From the widest to the narrowest, by frequency."""
    lowest: float
    highest: float
    narrowest: float
    """Bands that count are to two thirds between the first two (Hz), and as wide as the last."""
    within: float = 1.0
    """Share of the signal's mean square between the first two."""

    def records(self) -> tuple[Band, ...]:
        """Return the bands."""
        return self.bands

    @property
    def best(self) -> Band:
        """The band with the largest kurtosis among those that count, and that hold 1 % of what is there."""
        counted = [band for band in self.bands if self.counts(band)] or self.bands[:1]
        loud = [band for band in counted if band.share >= _FAINT * self.within]
        return max(loud or counted, key=lambda band: band.kurtosis)

    @property
    def chosen(self) -> tuple[float, float]:
        """The best band within what counts, Hz."""
        return max(self.best.low, self.lowest), min(self.best.high, self.highest)

    def counts(self, band: Band) -> bool:
        """Whether a band is wide enough, and where the signal is."""
        width = band.high - band.low
        inside = min(band.high, self.highest) - max(band.low, self.lowest)
        return inside >= _INSIDE * width and width >= self.narrowest * (1.0 - 1e-9)

    def picture(self, title: str = "") -> "Figure":
        """Draw the kurtosis as colour over frequency and width, below 0 as 0; the best band is framed."""
        figure, ax = single((9.0, 4.5))
        levels = sorted({band.level for band in self.bands})
        # what does not count is not to take the colours of what does
        top = max(1.0, *(band.kurtosis for band in self.bands if self.counts(band)))
        widths = []
        for row, level in enumerate(levels):
            bands = [band for band in self.bands if band.level == level]
            widths.append(f"{1e-3 * (bands[0].high - bands[0].low):.3g}")
            edges = 1e-3 * np.array([bands[0].low, *(band.high for band in bands)])
            colours = np.array([[max(band.kurtosis, 0.0) for band in bands]])
            drawn = ax.pcolormesh(
                edges, [row - 0.5, row + 0.5], colours, vmin=0.0, vmax=top, cmap="viridis", rasterized=True
            )
        figure.colorbar(drawn, ax=ax, label="kurtosis of the envelope")
        best, row = self.best, levels.index(self.best.level)
        low, high = self.chosen
        x = 1e-3 * np.array([low, high, high, low, low])
        ax.plot(x, row + 0.5 * np.array([-1.0, -1.0, 1.0, 1.0, -1.0]), color=OTHERS[1], linewidth=2.0)
        ax.set_yticks(range(len(levels)), widths)
        ax.invert_yaxis()
        words = f"best: {kilohertz(low)} to {kilohertz(high)} kHz, kurtosis {best.kurtosis:.2g}"
        head = ", ".join(filter(None, (title, words)))
        label(ax, "frequency, kHz", "width of the bands, kHz", head, grid=False)
        return figure


def kurtogram(
    signal: ArrayLike, rate: float, *, lowest: float = 0.0, highest: float | None = None,
    narrowest: float = 0.0,
) -> Kurtogram:  # fmt: skip
    """Return the kurtosis of a signal's envelope in bands over frequency and width.

    Parameters
    ----------
    signal : array_like, shape (samples,)
    rate : float
        Samples per second.
    lowest, highest : float, optional
        Where bands have to be (Hz), to two thirds, to be the best one; default: anywhere.
    narrowest : float
        Width (Hz) that they have to have. The spectrum of an envelope ends at the width of its band.

    Raises
    ------
    ValueError
        For fewer than 256 samples, and for a signal that is constant or no number.

    Examples
    --------
    >>> import numpy as np
    >>> from fmu_bearing import measure
    >>> noise = np.random.default_rng(1).normal(size=51200)
    >>> noise[::512] += 10.0  # a hundred impulses per second, which are in all bands
    >>> best = measure.kurtogram(noise, 51200.0).best
    >>> bool(best.kurtosis > 1.0)
    True
    """
    values = checked(signal, 2 * _FEWEST)
    nyquist, square = 0.5 * rate, 2.0 * float(np.mean(values**2))
    top, width = highest or nyquist, max(narrowest, 0.0)
    found = [
        Band(nyquist * k / count, nyquist * (k + 1) / count, math.log2(count), *_moments(part, square))
        for count, parts in _tree(scipy.signal.hilbert(values), nyquist, width)
        for k, part in enumerate(parts)
    ]
    bands = tuple(sorted(found, key=lambda band: (band.level, band.low)))
    powers = np.abs(scipy.fft.rfft(values)) ** 2
    frequency = np.arange(powers.size) * (rate / values.size)
    within = float(powers[(frequency >= lowest) & (frequency <= top)].sum() / powers.sum())
    return Kurtogram(bands, lowest, top, narrowest, within)


def kilohertz(frequency: float) -> str:
    """Return a frequency (Hz) in kHz with three digits, as texts and pictures name the ends of a band."""
    return f"{1e-3 * frequency:#.3g}".rstrip(".")


def checked(signal: ArrayLike, fewest: int) -> NDArray[np.float64]:
    """Return a signal without its mean; `ValueError` for one that is too short, constant or no number."""
    values = np.asarray(signal, dtype=float)
    if values.ndim != 1 or values.size < fewest:
        raise ValueError(
            f"a signal of shape {values.shape} is refused: give one row of {fewest} samples or more"
        )
    if not np.isfinite(values).all():
        raise ValueError("the signal holds values that are no finite numbers")
    moved: NDArray[np.float64] = values - values.mean()
    if float(np.abs(moved).max()) <= 1e-12 * float(np.abs(values).max()):
        raise ValueError("the signal is constant, and has no envelope")
    return moved


def _tree(
    whole: NDArray[np.complex128], nyquist: float, narrowest: float
) -> Iterator[tuple[int, Sequence[NDArray[np.complex128]]]]:
    """Yield how many bands divide the whole, and their envelopes by frequency, level after level."""
    parts, count = [whole], 1
    while parts[0].size >= _FEWEST and nyquist / count >= narrowest:
        yield count, parts
        thirds = [third for part in parts for third in _divided(part, 3)]
        if thirds[0].size >= _FEWEST and nyquist / (3 * count) >= narrowest:
            yield 3 * count, thirds
        parts, count = [half for part in parts for half in _divided(part, 2)], 2 * count


def _divided(part: NDArray[np.complex128], by: int) -> list[NDArray[np.complex128]]:
    """Return the envelopes of two or three equal parts of a band, which fills 0 to half of its rate."""
    found = []
    for k, taps in enumerate(_filters(by)):
        if part.size < taps.size + by:
            return [part[:0]] * by
        kept = scipy.signal.oaconvolve(part, taps, mode="valid")[::by]
        # at the lower rate every second part comes to lie below 0 Hz: it is turned up by half of that rate
        found.append(kept * (1.0 - 2.0 * (np.arange(kept.size) % 2)) if k % 2 else kept)
    return found


@functools.cache
def _filters(by: int) -> tuple[NDArray[np.complex128], ...]:
    """Return the taps of low-passes that are moved to the middles of the parts of a band."""
    taps = scipy.signal.firwin(_TAPS * by + 1, 0.5 / by, window=("kaiser", _BETA))
    n = np.arange(taps.size)
    return tuple(taps * np.exp(2j * np.pi * (2 * k + 1) / (4 * by) * n) for k in range(by))


def _moments(part: NDArray[np.complex128], square: float) -> tuple[float, float]:
    """Return the kurtosis of an envelope, and its share of a mean square."""
    squares = np.abs(part) ** 2
    mean = float(squares.mean())
    return (float(np.mean(squares**2)) / mean**2 - 2.0 if mean > 0.0 else 0.0), mean / square
