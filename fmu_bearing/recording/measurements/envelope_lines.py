"""Lines of an envelope: where the frequencies of a bearing ask for them, and where the spectrum has them."""

import math
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from typing import Protocol

from fmu_bearing.acoustics.analysis.lines import combination
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.recording.channels.recorded_signals import RecordedSignal
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.results.levels import decibels

FAR = 10.0  # dB over the median, from which a line is named
_MULTIPLES = 10  # of what passes races and balls: short strokes have many
_SHAFT = {"f_r": 5, "f_c": 3}  # multiples; Z f_c is f_o
_SIDES = 2  # side bands to either side of each
#: What modulates the strokes: with the shaft a defect passes the load, on a ball with the cage. One of the
#: outer race rests in the load.
_FAMILIES = (("outer race", 1, "f_o", ""), ("inner race", 1, "f_i", "f_r"), ("ball", 2, "f_b", "f_c"))


@dataclass(frozen=True)
class EnvelopeLine(Result):
    """A line that the bearing's frequencies lead to expect."""

    quantities = (
        Quantity("name", "line"), Quantity("of", "of"), Quantity("frequency_Hz", "Hz", ".1f"),
        Quantity("found_Hz", "found at, Hz", ".1f"), Quantity("depth [1]", "of the mean, %", ".3g", 100.0),
        Quantity("over_median_dB", "over the median, dB", decibels),
    )  # fmt: skip

    name: str
    """As ``2 f_o + f_r``."""
    of: str
    """What strikes: ``outer race``, ``inner race``, ``ball``, ``shaft``, ``cage``; of a set whose, and the
    local defects there: ``outer race (defect 1)``."""
    frequency: float
    """Hz, as cage and balls turned."""
    found: float
    """Hz: the highest point within a resolution, or within how far the frequency is known."""
    depth: float
    """Amplitude of the line over the mean of the squared envelope."""
    over_median: float
    """dB: twenty times the logarithm of the amplitude over the median about it."""
    miss: float = math.nan
    """Distance from where it was sought, over how far it may be from there; NaN: take its frequency for that
    place, and a resolution."""

    @property
    def is_sum(self) -> bool:
        """Whether it is a side band: ``f_i - f_r``."""
        return not {"+", "-"}.isdisjoint(self.name.split())

    @property
    def needs(self) -> str:
        """Name of the line without which this one means nothing; empty: none."""
        if self.is_sum:
            return self.name.replace(" + ", " - ").split(" - ")[0]
        times, _, base = self.name.rpartition(" ")
        if base in _SHAFT:
            return base if int(times or 1) > 2 else ""
        first = 2 if base == "f_b" else 1
        return combination(first, base) if int(times or 1) > 3 * first else ""


class Spectrum(Protocol):
    """What lines are read from: an `Envelope`."""

    @property
    def resolution(self) -> float:
        """Hz."""

    @property
    def mean(self) -> float:
        """Mean of the squared envelope."""

    def at(self, frequency: float, within: float | None = None) -> tuple[float, float, float]:
        """Return the highest point about a frequency: Hz, amplitude, and that over the median about it."""


def turning_of(
    recording: ChannelHistory, signal: RecordedSignal
) -> list[tuple[KinematicFrequencies, str, dict[str, str]]]:
    """Return frequencies that may show in a signal, whose they are, and the defects at each carrier.

    Those of its bearing, of a signal of no single one those of all.
    """
    every = recording.bearing_kinematics()
    lines = recording.defect_lines()
    found = []
    for number, one in enumerate(every, start=1):
        if signal.bearing in (None, number):
            struck: dict[str, str] = {}
            for line in lines:
                if line.bearing == number - 1:
                    more = f"{struck[line.carrier]}, " if line.carrier in struck else ""
                    struck[line.carrier] = more + line.defect
            found.append((one, f"bearing {number}" if len(every) > 1 else "", struck))
    return found


def lines_of(
    found: Spectrum, one: KinematicFrequencies, whose: str, struck: Mapping[str, str], slip: float
) -> Iterator[EnvelopeLine]:
    """Yield the lines of a bearing as the spectrum has them.

    The first of a family may miss its frequency by ``slip`` of it. The others lie within a resolution of
    multiples and sums of that frequency, or of what the lower multiples of the family showed: cages slip, and
    under a load across the axis a ball with a spall spins 0.7 % faster than the mean of all (6205).
    """
    for kind, name in (("shaft", "f_r"), ("cage", "f_c")):
        of = f"{kind} of {whose}" if whose and kind != "shaft" else kind
        for n in range(1, _SHAFT[name] + 1):
            at = n * getattr(one, name)
            yield _read(found, combination(n, name), of, at, at)
    for kind, per, name, side in _FAMILIES:
        of = f"{kind} of {whose}" if whose else kind
        of += f" ({struck[name]})" if name in struck else ""
        base = per * getattr(one, name)
        shown = base  # Hz, by the highest multiple that is far over the median
        for n in range(1, _MULTIPLES + 1):
            label, reach = combination(n * per, name), slip * base if n == 1 else 0.0
            places = {n * base, n * shown}
            line = max((_read(found, label, of, n * base, at, reach) for at in places), key=_height)
            yield line
            off = abs(line.found / n - base)
            if line.over_median >= FAR and off <= max(found.resolution, slip * base):
                shown = line.found / n
        for n in range(1, _MULTIPLES + 1) if side else ():
            for m in (m for m in range(-_SIDES, _SIDES + 1) if m):
                apart = m * getattr(one, side)
                if n * base + apart > 0.0:
                    label = combination(n * per, name, m, side)
                    places = {n * base + apart, n * shown + apart}
                    yield max((_read(found, label, of, n * base + apart, at) for at in places), key=_height)


def _height(line: EnvelopeLine) -> float:
    """Return how high a line is, for comparison; of one beyond the spectrum 0."""
    return 0.0 if math.isnan(line.depth) else line.depth


def _read(
    found: Spectrum, name: str, of: str, frequency: float, sought: float, reach: float = 0.0
) -> EnvelopeLine:
    """Return a line as the spectrum has it about ``sought`` (Hz), within a resolution or ``reach`` (Hz).

    NaN where the spectrum does not reach so far.
    """
    at, amplitude, ratio = found.at(sought, reach)
    over = 20.0 * math.log10(ratio) if ratio > 0.0 else math.nan
    miss = abs(at - sought) / max(reach, found.resolution)
    return EnvelopeLine(name, of, frequency, at, amplitude / found.mean, over, miss)
