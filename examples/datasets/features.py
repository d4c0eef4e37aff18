"""Numbers of a waveform from which a classifier tells defects of a ball bearing, and those of public records.

``python examples/datasets/features.py --cwru FOLDER --mfpt FOLDER`` derives ``public_features.csv`` from the
recordings of the Case Western Reserve University Bearing Data Center (drive end, 12 kHz, as .npz with ``DE``)
and of the Society for Machinery Failure Prevention Technology (MFPT, .mat). The recordings stay where they
are: CWRU states no licence, MFPT's is CC BY-NC-SA. Only numbers derived from them are kept here.

Lines are searched within 1.5 % of rolling at the nominal contact angle, as somebody has to who knows the
shaft's speed alone. Simulated waveforms are read in the same way.
"""

import argparse
import csv
import re
from math import gcd
from pathlib import Path

import numpy as np
import scipy

from fmu_bearing import measure

RATE = 12_000  # Hz to which all waveforms are brought
LENGTH = 0.5  # s of the parts whose numbers are averaged
BAND = (2000.0, 5500.0)  # Hz of the envelope
BANDS = ((20.0, 1000.0), (1000.0, 2000.0), (2000.0, 4000.0), (4000.0, 5800.0))  # Hz of shares of the power
SLIP = 0.015
#: Lines of the squared envelope over the median about them, dB, and side bands over their line, dB.
LINES = (
    "f_r", "outer", "2 outer", "inner", "2 inner", "ball", "2 ball", "outer sides", "inner sides",
    "ball sides",
)  # fmt: skip
SHAPES = ("kurtosis", "band kurtosis")
SHARES = tuple(f"{low:g} to {high:g} Hz" for low, high in BANDS)
NAMES = (*LINES, *SHAPES, *SHARES)
#: Balls, ball over pitch diameter; the drive end of CWRU is a 6205, MFPT a bearing of NICE.
CWRU, MFPT = (9, 7.94 / 39.04), (8, 0.235 / 1.245)
PUBLIC = Path(__file__).with_name("public_features.csv")


def features(signal, rate, shaft, bearing):
    """Return `NAMES` with their values, means over parts of `LENGTH`.

    Parameters
    ----------
    signal : ndarray, shape (samples,)
        Acceleration in any unit.
    rate, shaft : float
        Samples, and turns of the shaft, per second.
    bearing : (int, float)
        Balls, ball over pitch diameter.
    """
    common = gcd(int(rate), RATE)
    signal = scipy.signal.resample_poly(signal - np.mean(signal), RATE // common, int(rate) // common)
    size = min(len(signal), round(LENGTH * RATE))
    parts = [signal[k : k + size] for k in range(0, len(signal) - size + 1, size)]
    means = np.mean([_of_part(part, shaft, *bearing) for part in parts], axis=0)
    return dict(zip(NAMES, means.tolist(), strict=True))


def _of_part(part, f_r, balls, ratio):
    f_c = 0.5 * f_r * (1.0 - ratio)
    spectrum = measure.envelope(part, RATE, BAND)
    lines = {
        "outer": (balls * f_c, f_r), "inner": (balls * (f_r - f_c), f_r),
        "ball": (f_r / ratio * (1.0 - ratio**2), f_c),
    }  # fmt: skip
    decibels = {"f_r": _over(spectrum, f_r)}
    for name, (frequency, side) in lines.items():
        found, amplitude, over = spectrum.at(frequency, SLIP * frequency)
        decibels[name] = _dB(over)
        decibels[f"2 {name}"] = _over(spectrum, 2.0 * found)
        sides = [spectrum.at(found + way * side)[1] for way in (-1, 1)]
        decibels[f"{name} sides"] = _dB(np.mean(sides) / amplitude)
    shapes = [scipy.stats.kurtosis(part, fisher=False), spectrum.kurtosis]
    frequency, power = scipy.signal.welch(part, RATE, nperseg=2048)
    powers = [power[(frequency >= low) & (frequency < high)].sum() for low, high in BANDS]
    shares = [_dB(np.sqrt(one / sum(powers))) for one in powers]
    return [*(decibels[name] for name in LINES), *(_dB(one) for one in shapes), *shares]


def _over(spectrum, frequency):
    return _dB(spectrum.at(frequency)[2])


def _dB(ratio):
    return 20.0 * np.log10(max(float(ratio), 1e-6))


def read_public(path=PUBLIC):
    """Return rows of the public records: source, file, class, features."""
    with path.open(encoding="utf-8", newline="") as file:
        return [
            {key: float(value) if key in NAMES else value for key, value in row.items()}
            for row in csv.DictReader(file)
        ]


def _cwru(folder):
    """Yield name, class and features of the records at the drive end."""
    kinds = {"IR": "inner", "OR": "outer", "B": "ball", "Normal": "healthy"}
    for path in sorted(folder.glob("*.npz")):
        match = re.fullmatch(r"(\d+)_(IR|OR|B|Normal)(.*?)(_DE12)?", path.stem)
        if match and (match[4] or match[2] == "Normal"):
            # the records without fault were taken at 48 kHz
            rate = 48_000 if match[2] == "Normal" else 12_000
            signal = np.load(path)["DE"].ravel()
            yield path.stem, kinds[match[2]], features(signal, rate, int(match[1]) / 60.0, CWRU)


def _mfpt(folder):
    """Yield name, class and features of the records with known load."""
    for path in sorted(folder.glob("*RaceFault_vload_*.mat")):
        bearing = scipy.io.loadmat(path, squeeze_me=True, struct_as_record=False)["bearing"]
        kind = "outer" if path.stem.startswith("Outer") else "inner"
        # 48,828 Hz is taken as 48,800: lines are found 0.06 % off, within what is searched
        yield path.stem, kind, features(bearing.gs, 48_800, float(bearing.rate), MFPT)


def main():
    """Derive the numbers of the public records."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--cwru", type=Path, required=True)
    parser.add_argument("--mfpt", type=Path, required=True)
    asked = parser.parse_args()
    with PUBLIC.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow(["source", "file", "class", *NAMES])
        for source, records in (("CWRU", _cwru(asked.cwru)), ("MFPT", _mfpt(asked.mfpt))):
            for name, kind, numbers in records:
                writer.writerow([source, name, kind, *(f"{numbers[key]:.4g}" for key in NAMES)])


if __name__ == "__main__":
    main()
