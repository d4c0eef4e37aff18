"""What an envelope says in words: which part strokes come from, and whether its highest line has a name."""

import numpy as np

from fmu_bearing.recording.measurements.envelope import SLIDING, Envelope
from fmu_bearing.recording.measurements.envelope_lines import FAR, EnvelopeLine

#: Kurtosis of a band from which there are strokes: noise has 3, and noise whose power swells as a sine
#: between nothing and twice its mean 4.5, which is as far as waves and loads that turn bring it.
STROKES = 4.5
#: Kurtosis below which there are steady tones: one tone has 1.5, two of one height 2.25.
_TONES = 2.5
#: Of the mean, from which strokes are strong: a train of short strokes has 2, and less by the share of other
#: energy in the band, so that half of the energy is strokes. In the fan of docs/learn/spall.md spalls in the
#: load have 1.7 or more, pits and what is away from the load 0.9 or less.
_STRONG = 1.0
#: Of the signal's energy, in a band that a kurtogram chose: strokes in less raise the rms by less than 1 %. A
#: kurtogram finds such bands in healthy bearings, too: balls that come into a load across the axis strike at
#: f_o, with 0.4 % (6205 at 1,797 r/min).
_LITTLE = 0.02
#: Of the mean, from which a line without a name is worth a word: healthy bearings of that page have up to
#: 0.35, pits 0.7 or more.
_WORTH = 0.5
#: Resolutions within which two peaks are one: the lobe of Hann's window.
_SAME = 2.0


def verdict(found: Envelope) -> str:
    """Return what strikes, in one sentence: by lines far over the median and the kurtosis of the band.

    A race or ball is named where its first line is there with the second or third: strokes are short, and a
    single line may be a swell. Empty for an envelope whose bearing is not known.
    """
    if not found.lines:
        return ""
    far = found.far()
    sharp = f"kurtosis {found.kurtosis:.{1 if found.kurtosis < 10.0 else 0}f}"
    struck = _struck(far)
    if found.kurtosis < STROKES:
        like = "steady tones" if found.kurtosis < _TONES else "noise"
        if not any(_kind(line) for line in far):
            return f"nothing named, and no strokes: {sharp} is that of {like}"
        return f"no strokes: {sharp} is that of {like}; lines of races without strokes may be waviness"
    if struck:
        return f"{_family(struck)}; {sharp}: {_strength(struck, found)}"
    single = next((line for line in far if _kind(line) and not line.is_sum), None)
    if single is None:
        return f"nothing named: {sharp} is that of strokes, but no race or ball has its lines"
    return (
        f"nothing named: {sharp} is that of strokes, but {single.name} ({single.over_median:.0f} dB over the "
        "median) has no multiples, which strokes of a defect have"
    )


def doubt(found: Envelope, rpm: float, speed_known: bool) -> str:
    """Return a sentence about a highest line that is not the bearing's, or a speed that is off; else nothing.

    ``rpm``: speed of the shaft (r/min); ``speed_known``: whether it is that of the run.
    """
    if not found.lines:
        return ""
    races = [line for line in found.far() if _kind(line).endswith("race") and not line.is_sum]
    last = max(races, key=lambda line: line.frequency, default=None)
    off = 0.0 if last is None else last.found - last.frequency
    # a short record leaves half of a resolution open
    if last and not speed_known and abs(off) > SLIDING * last.frequency + 0.5 * found.resolution:
        way, share = "above" if off > 0.0 else "below", abs(off) / last.frequency
        return (
            f"{last.name} is {100.0 * share:.1f} % {way} that at {rpm:.0f} r/min, more than cages slip; is "
            "the speed right?"
        )
    at, amplitude, ratio = found.at(float(found.frequency[np.argmax(found.amplitude)]))
    named = [line.found for line in found.far()]
    depth = amplitude / found.mean
    if depth < _WORTH or ratio < 10.0 ** (FAR / 20.0):
        return ""
    if any(abs(at - one) <= _SAME * found.resolution for one in named):
        return ""
    words = f"the highest line, {at:.1f} Hz ({100.0 * depth:.0f} % of the mean), is "
    near = [line for line in found.lines if abs(line.frequency - at) <= 0.5 * found.resolution]
    if near:  # left out of the names, as what it belongs to is not there
        line = min(near, key=lambda one: abs(one.frequency - at))
        words += f"{line.name}, without {line.needs or 'others'}"
    else:
        words += "none of the bearing's"
    words += f" at {rpm:.0f} r/min"
    return words if speed_known else f"{words}; is the speed right?"


def _kind(line: EnvelopeLine) -> str:
    """Return which part a line is of, race or ball; empty: shaft or cage."""
    return next((kind for kind in ("outer race", "inner race", "ball") if line.of.startswith(kind)), "")


def _struck(far: list[EnvelopeLine]) -> list[EnvelopeLine]:
    """Return the far lines of the part whose strokes are strongest, its first line in front; empty: none."""
    parts: list[list[EnvelopeLine]] = []
    for of in dict.fromkeys(line.of for line in far if _kind(line)):
        own = sorted((line for line in far if line.of == of), key=lambda line: (line.is_sum, line.frequency))
        base = {"outer race": ("f_o", 1), "inner race": ("f_i", 1), "ball": ("f_b", 2)}[_kind(own[0])]
        names = [f"{n * base[1]} {base[0]}".removeprefix("1 ") for n in (1, 2, 3)]
        if own[0].name == names[0] and any(line.name in names[1:] for line in own):
            parts.append(own)
    return max(parts, key=lambda own: own[0].depth, default=[])


def _family(lines: list[EnvelopeLine]) -> str:
    """Return a part, its first line, multiples and side bands in words."""
    first, *others = lines
    multiples = [line.name for line in others if not line.is_sum]
    shown = ", ".join(multiples[:2]) + (f" to {multiples[-1]}" if len(multiples) > 2 else "")
    sides = {line.name.split()[-1] for line in others if line.is_sum}
    more = f" and side bands at {sides.pop()}" if sides else ""
    return f"{first.of}: {first.name} {first.over_median:.0f} dB over the median, with {shown}{more}"


def _strength(lines: list[EnvelopeLine], found: Envelope) -> str:
    """Return how strong strokes are, by the first line over the mean and what the band has of the signal."""
    share = 1.0 if found.kurtogram is None else found.kurtogram.best.share
    if share < _LITTLE:
        return (
            f"strokes in {100.0 * share:.1g} % of the signal's energy, which balls that enter the load make, "
            "too; compare with the record when new"
        )
    if lines[0].depth >= _STRONG:
        return "strokes"
    return "weak strokes, as of a pit, or away from load or sensor"
