"""Envelope analysis: how strongly a band of a signal swells, and at which of the bearing's frequencies.

A defect strikes once for each ball that passes it, and each stroke lets the structure ring. The ringing is in
a band of some kHz; how often it comes shows in the spectrum of its squared envelope, where the strokes of a
bearing and what modulates them are lines.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import TYPE_CHECKING

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from fmu_bearing.acoustics.analysis.lines import Line
from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.recording.channels.recorded_signals import recorded_signal
from fmu_bearing.recording.measurements.envelope_lines import FAR, EnvelopeLine, lines_of, turning_of
from fmu_bearing.recording.measurements.kurtogram import Kurtogram, checked, kilohertz, kurtogram
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.results.picture_parts import BEHIND, OTHERS, label, name_lines, single
from fmu_bearing.results.table import Table

if TYPE_CHECKING:
    from matplotlib.figure import Figure

SIMPLE = ("f_r", "f_c", "f_o", "f_i", "2 f_b")
_ROOM = 1.4  # of the highest point of a picture: above it are names
_ORDER = 4  # of the band-pass, which is run forwards and backwards
_FEWEST = 256  # samples
_FINER = 4  # bins in place of one: a line between two of them then reads low by less than 1 %
_AROUND = 25.0  # resolutions to either side, whose median is what a line is held against
_LOBE, _SKIRT = 2.0, 4.0  # resolutions: of a line under Hann's window, and of one whose frequency trembles
_BESIDE = 0.1  # of a line, which its skirt may have
SLIDING = 0.015  # of a frequency that is not known from the run: rolling at one contact angle
_SLIP = 3e-4  # of one that is: balls of a bearing spin as fast within that
_LOWEST = 200.0  # Hz: below it is the shaft's own motion
_BANDS = 3.0  # times the fastest passing of balls: the width of a band that shows it three times


@dataclass(frozen=True, eq=False)
class Envelope(Result):
    """Spectrum of the squared envelope of a band of a signal."""

    quantities = (
        "signal = name", "unit", "low_Hz", "high_Hz", "kurtosis [1]", "rms", "rms_share [1] = share",
        "resolution_Hz",
        Quantity("lines", of=lambda found: found.lines),
    )  # fmt: skip

    name: str
    unit: str
    """Of the signal; the squared envelope has its square."""
    low: float
    high: float
    """The band, Hz."""
    kurtosis: float
    """Of the band's signal: 3 for noise, 1.5 for a tone, more for strokes."""
    rms: float
    """Of the band, in the signal's unit; the mean of the squared envelope is twice its square."""
    resolution: float
    """1 over the signal's length, Hz."""
    frequency: NDArray[np.float64] = field(repr=False)
    """Hz, a quarter of the resolution apart, up to the width of the band. Shape (bins,)."""
    amplitude: NDArray[np.float64] = field(repr=False)
    """Of the lines of the squared envelope, in the square of the unit; 0 Hz is taken out. Shape (bins,)."""
    lines: tuple[EnvelopeLine, ...] = field(default=(), repr=False)
    whole: float = math.nan
    """Rms of the whole signal without its mean, in its unit."""
    kurtogram: Kurtogram | None = field(default=None, repr=False)
    """By which the band was chosen; None where it was given."""

    @property
    def mean(self) -> float:
        """Mean of the squared envelope."""
        return 2.0 * self.rms**2

    def records(self) -> Sequence[Result]:
        """Return the lines; itself where the bearing is not known."""
        return self.lines or (self,)

    def at(self, frequency: float, within: float | None = None) -> tuple[float, float, float]:
        """Return the highest point about a frequency: Hz, amplitude, and amplitude over the median about it.

        ``within``: distance (Hz); default: a resolution.
        """
        reach = max(within or 0.0, self.resolution)
        near = np.flatnonzero(np.abs(self.frequency - frequency) <= reach + 1e-9)
        if not near.size:
            return frequency, math.nan, math.nan
        values = self.amplitude
        inner = near[(near > 0) & (near < values.size - 1)]
        peaks = inner[(values[inner] >= values[inner - 1]) & (values[inner] > values[inner + 1])]
        # without a summit of its own it is the slope of a neighbour, or the ground
        best = (
            peaks[np.argmax(values[peaks])]
            if peaks.size
            else near[np.argmin(abs(self.frequency[near] - frequency))]
        )
        place, amplitude = _summit(values, int(best))
        found = float(self.frequency[0] + place * (self.frequency[1] - self.frequency[0]))
        around = np.abs(self.frequency - frequency) <= max(_AROUND * self.resolution, 4.0 * reach)
        return found, amplitude, amplitude / float(np.median(values[around]))

    def strongest(self, of: str = "") -> EnvelopeLine | None:
        """Return the first line of `far`, ``of`` one kind where that is named; None: there is none."""
        return next((line for line in self.far() if line.of.startswith(of)), None)

    def spectrum_table(self) -> Table:
        """Return frequency, and amplitude over the mean of the squared envelope."""
        rows = zip(self.frequency, self.amplitude, strict=True)
        columns = ["frequency, Hz", f"squared envelope, {self.unit or '1'} squared", "of its mean"]
        return columns, [[f"{f:.6g}", f"{a:.6g}", f"{a / self.mean:.6g}"] for f, a in rows]

    @property
    def heading(self) -> str:
        """Signal and band in words."""
        return f"{self.name}, {kilohertz(self.low)} to {kilohertz(self.high)} kHz"

    @property
    def share(self) -> float:
        """Rms of the band over that of the signal."""
        return self.rms / self.whole

    @property
    def strength(self) -> str:
        """Rms and kurtosis in words, with the band that both are of, and what it holds of the signal."""
        unit = f" {self.unit}" if self.unit else ""
        return (
            f"rms {self.rms:.3g}{unit} between {kilohertz(self.low)} and {kilohertz(self.high)} kHz "
            f"({100.0 * self.share:.2g} % of the signal's {self.whole:.3g}{unit}), "
            f"kurtosis {self.kurtosis:.1f}"
        )

    @property
    def shown_to(self) -> float:
        """Up to where a picture shows the spectrum (Hz): its lines, or all where it has none."""
        first = [line.frequency for line in self.lines if line.name in SIMPLE]
        whole = float(self.frequency[-1])
        return min(1.1 * max(first + [line.frequency for line in self.far()]), whole) if self.lines else whole

    def far(self) -> list[EnvelopeLine]:
        """Return the lines 10 dB over the median, farthest first: of those at one peak the nearest.

        Within two resolutions of a higher one, and within four of one ten times as high, a line may be the
        skirt of that one: it is left out. A side band needs its carrier, a multiple above the third its
        first line, of f_r and f_c above the second.
        """
        taken: dict[int, EnvelopeLine] = {}
        over = {(line.name, line.of): line.over_median for line in self.lines}
        first: dict[str, float] = {}
        for line in self.lines:
            first.setdefault(line.of, line.over_median)
        for line in sorted(self.lines, key=lambda line: self._fit(line, first[line.of])):
            needed = over.get((line.needs, line.of), math.inf)
            if min(line.over_median, needed) >= FAR and not self._on_a_skirt(line):
                taken.setdefault(round(line.found / self.resolution), line)
        return sorted(taken.values(), key=lambda line: -line.over_median)

    def _fit(self, line: EnvelopeLine, first: float) -> tuple[float, bool, float, bool, float, int, str]:
        """Rank a name for a peak: near ones first, of those multiples, then the nearest.

        Where the cage turns at 0.4 of the shaft, 3 f_o is 2 f_i: a defect that is there has its own before
        others, then the one whose first line, ``first`` dB, is farther over the median.
        """
        miss = line.miss
        if math.isnan(miss):
            miss = abs(line.found - line.frequency) / self.resolution
        if math.isnan(miss):
            miss = math.inf
        known = line.of.endswith(")") and not line.is_sum
        # peaks lie within half of a resolution; a quarter is what noise moves them by
        near, quarters = (miss, miss) if math.isinf(miss) else (round(miss), round(4.0 * miss))
        return near, line.is_sum, quarters, not known, -first, len(line.name), line.name

    def _on_a_skirt(self, line: EnvelopeLine) -> bool:
        """Whether a line is lower than what is within a lobe of the window, or far lower a little farther."""
        off, height = np.abs(self.frequency - line.found) / self.resolution, line.depth * self.mean
        within = [float(self.amplitude[off <= reach].max()) for reach in (_LOBE, _SKIRT)]
        return height < 0.98 * within[0] or height < _BESIDE * within[1]

    def picture(self, title: str = "", highest: float | None = None) -> "Figure":
        """Draw the spectrum in per cent of the mean, lines far over the median named.

        ``highest``: Hz; default: what the lines take.
        """
        end = self.shown_to if highest is None else highest
        shown = self.frequency <= end
        figure, ax = single((10.0, 4.5))
        depth = 100.0 * self.amplitude[shown] / self.mean
        ax.plot(self.frequency[shown], depth, color=OTHERS[0], linewidth=0.8, label=self.name)
        ax.set_xlim(0.0, end)
        ax.set_ylim(0.0, _ROOM * float(depth.max(initial=1e-9)))
        label(ax, "frequency, Hz", "squared envelope, % of its mean", title or self.heading)
        for line in self.lines:
            if line.name in SIMPLE and line.frequency <= end:
                ax.axvline(line.frequency, color="0.4", linewidth=0.6, linestyle=":", zorder=0)
                ax.text(
                    line.frequency, 0.99, line.name, rotation=90, fontsize=7, color="0.4", ha="right",
                    va="top", transform=ax.get_xaxis_transform(), bbox=BEHIND, gid="mark",
                )  # fmt: skip
        named = [Line(one.found, 100.0 * one.depth, one.name) for one in self.far() if one.found <= end]
        name_lines(ax, named)
        return figure


def squared_envelope(
    signal: ArrayLike, rate: float, band: tuple[float, float] | None = None
) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return a band of a signal, and the square of the modulus of its analytic signal, shape (samples,) each.

    The band-pass has order 4 and no phase, as it is run forwards and backwards; default: the whole signal,
    without its mean.

    Raises
    ------
    ValueError
        For a band beyond half of ``rate`` (samples per second), and for a signal as `kurtogram` refuses it.
    """
    values = checked(signal, _FEWEST)
    nyquist = 0.5 * rate
    low, high = band or (0.0, nyquist)
    if not 0.0 <= low < high <= nyquist * (1.0 + 1e-9):
        raise ValueError(
            f"a band from {low:g} to {high:g} Hz is refused: it rises between 0 and half of the "
            f"{rate:g} samples per second"
        )
    kinds = {
        (False, True): ("highpass", low),
        (True, False): ("lowpass", high),
        (False, False): ("bandpass", band),
    }
    whole = (low <= 0.0, high >= nyquist * (1.0 - 1e-9))
    if whole != (True, True):
        kind, ends = kinds[whole]
        sections = scipy.signal.butter(_ORDER, ends, kind, fs=rate, output="sos")
        pad = min(values.size - 1, max(64, round(8.0 * rate / (high - low))))
        values = scipy.signal.sosfiltfilt(sections, values, padlen=pad)
    return values, np.abs(scipy.signal.hilbert(values)) ** 2


def envelope(
    signal: ArrayLike, rate: float, band: tuple[float, float] | None = None, *, name: str = "signal",
    unit: str = "", lowest: float = _LOWEST, highest: float | None = None, narrowest: float = 0.0,
) -> Envelope:  # fmt: skip
    """Return the spectrum of the squared envelope of a band of a signal.

    Parameters
    ----------
    signal : array_like, shape (samples,)
    rate : float
        Samples per second.
    band : (float, float), optional
        Hz; default: the best one of the `kurtogram` between ``lowest`` and ``highest`` (Hz), ``narrowest``
        (Hz) wide or wider.
    name, unit : str
        Of the signal.

    Notes
    -----
    Hann window, in four times as many bins as the signal has: amplitudes of single lines are right within
    1 %. Impulses every T through one mode (f_n, zeta) give lines at k/T that fall as
    1 / sqrt(1 + (k pi / (2 pi f_n zeta T))^2).

    Raises
    ------
    ValueError
        As `squared_envelope`.

    Examples
    --------
    >>> import numpy as np
    >>> from fmu_bearing import measure
    >>> time = np.arange(51200) / 51200.0
    >>> tone = (1.0 + 0.1 * np.cos(2.0 * np.pi * 80.0 * time)) * np.sin(2.0 * np.pi * 5000.0 * time)
    >>> found = measure.envelope(tone, 51200.0, (4000.0, 6000.0))
    >>> [round(value, 2) for value in found.at(80.0)[:2]]  # 2 x 0.1 of the amplitude's square
    [80.0, 0.2]
    """
    chosen = None
    if band is None:
        chosen = kurtogram(signal, rate, lowest=lowest, highest=highest, narrowest=narrowest)
        band = chosen.chosen
    values, squares = squared_envelope(signal, rate, band)
    window = scipy.signal.get_window("hann", values.size)
    size = scipy.fft.next_fast_len(_FINER * values.size, real=True)
    spectrum = scipy.fft.rfft((squares - squares.mean()) * window, size)
    frequency = np.arange(spectrum.size) * (rate / size)
    keep = (frequency <= min(band[1] - band[0], 0.5 * rate)) & (frequency >= 2.0 * rate / values.size)
    amplitude = 2.0 * np.abs(spectrum[keep]) / window.sum()
    rms = float(np.sqrt(np.mean(squares) / 2.0))
    kurtosis = float(np.mean(values**4) / np.mean(values**2) ** 2)
    return Envelope(
        name, unit, float(band[0]), float(band[1]), kurtosis, rms, rate / values.size, frequency[keep],
        amplitude, whole=float(np.std(np.asarray(signal, dtype=float))), kurtogram=chosen,
    )  # fmt: skip


def envelope_of(
    recording: ChannelHistory, name: str, band: tuple[float, float] | None = None,
    radiation_model: str | None = None,
) -> Envelope:  # fmt: skip
    """Return the envelope of a recording's signal, with the lines of its bearing.

    Parameters
    ----------
    recording : ChannelHistory
    name : str
        Of a signal, see `Recording.signal`.
    band : (float, float), optional
        Hz; default: the best one of the kurtogram above 200 Hz that is three times as wide as the fastest
        passing of the balls, so that three lines of it show.
    radiation_model : str, optional
        For a microphone, in place of the recording's own.

    Raises
    ------
    UnknownName
        For another name.
    ValueError
        For a signal that is constant, as the acceleration of a ring in a rigid housing, and for a speed that
        changes, over which lines spread.

    Examples
    --------
    >>> from fmu_bearing import measure, record, with_fidelity
    >>> scene = with_fidelity("examples/scenes/7003C-bare.toml", model="rings")
    >>> recording = record(scene, 0.2, radiation_model="compact")
    >>> found = measure.envelope_of(recording, "outer_ring.acceleration.z", (5000.0, 15000.0))
    >>> [line.name for line in found.lines[:3]], round(found.resolution, 3)
    (['f_r', '2 f_r', '3 f_r'], 5.0)
    """
    signal = recorded_signal(recording, name, radiation_model)
    if recording.changes_speed:
        raise ValueError(
            f"the speed changes between {signal.start:g} and {signal.time[-1]:g} s, and the lines of an "
            "envelope spread with it: record at one speed"
        )
    turning = [] if recording.scene is None else turning_of(recording, signal)
    fastest = max((max(one.f_i, one.f_o, 2.0 * one.f_b) for one, _, _ in turning), default=0.0)
    reach = 0.5 * (signal.highest - _LOWEST)
    try:
        found = envelope(
            signal.values, signal.rate, band, name=name, unit=signal.unit, highest=signal.highest,
            narrowest=min(_BANDS * fastest, reach), lowest=min(_LOWEST, 0.1 * signal.highest),
        )  # fmt: skip
    except ValueError as problem:
        raise ValueError(f"{name}: {problem}") from None
    slip = _SLIP if recording.turning_known else SLIDING
    read = [line for place in turning for line in lines_of(found, *place, slip)]
    once = {(line.name, line.of): line for line in read}  # the shaft's own are those of every bearing
    return replace(found, lines=tuple(once.values()))


def _summit(values: NDArray[np.float64], k: int) -> tuple[float, float]:
    """Return place and height of the parabola through the logarithms of a summit and its neighbours."""
    if not 0 < k < values.size - 1 or values[k - 1 : k + 2].min() <= 0.0:
        return float(k), float(values[k])
    left, middle, right = np.log(values[k - 1 : k + 2]).tolist()
    bend = left - 2.0 * middle + right
    if bend >= 0.0 or max(left, right) > middle:
        return float(k), float(values[k])
    off = 0.5 * (left - right) / bend
    return k + off, math.exp(middle - 0.25 * (left - right) * off)
