"""Numbers of a waveform from which a classifier tells defects of a ball bearing: of a data set, of records.

``--set FOLDER`` derives ``features.csv`` beside this file from a data set that ``fmu-bearing dataset`` made
of ``plan.toml``. ``--cwru FOLDER --mfpt FOLDER`` derive ``public_features.csv`` from recordings of the Case
Western Reserve University Bearing Data Center (drive end, 12 kHz, as .npz with ``DE``) and of the Society for
Machinery Failure Prevention Technology (MFPT, .mat). The recordings stay where they are: CWRU states no
licence, MFPT's is CC BY-NC-SA. Only numbers derived from them are kept here.

All are read in the same way: parts of `LENGTH`, and lines searched within 1.5 % of rolling at the nominal
contact angle, as somebody has to who knows the shaft's speed alone.
"""

import argparse
import csv
import re
from collections.abc import Iterator
from math import gcd
from pathlib import Path

import numpy as np
import scipy

from fmu_bearing import measure

RATE = 12_000  # Hz to which all waveforms are brought
LENGTH = 0.5  # s of a part
PARTS = 4  # of a public record, evenly apart
BAND = (1500.0, 5500.0)  # Hz of the envelope: where the plan draws the structure's mode
BANDS = ((20.0, 1000.0), (1000.0, 2000.0), (2000.0, 4000.0), (4000.0, 5800.0))  # Hz of shares of the power
SLIP = 0.015
#: Lines of the squared envelope over the median about them, dB, and side bands over their line, dB.
LINES = (
    "f_r", "f_c", "outer", "2 outer", "inner", "2 inner", "ball", "2 ball", "outer sides", "inner sides",
    "ball sides",
)  # fmt: skip
#: Of the signal and of its band; 3 is Gaussian. dB.
SHAPES = ("kurtosis", "band kurtosis")
#: rms of bands over that of all of them, dB: they say most of the structure.
SHARES = tuple(f"{low:g} to {high:g} Hz" for low, high in BANDS)
NAMES = (*LINES, *SHAPES, *SHARES)
#: Balls, ball over pitch diameter; the drive end of CWRU is a 6205, MFPT a bearing of NICE.
OWN, CWRU, MFPT = (9, 7.938 / 38.5), (9, 7.94 / 39.04), (8, 0.235 / 1.245)
COMPUTED = Path(__file__).with_name("features.csv")
PUBLIC = Path(__file__).with_name("public_features.csv")


def features(signal, rate, shaft, bearing):
    """Return `NAMES` with their values, of a part.

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
    part = scipy.signal.resample_poly(signal - np.mean(signal), RATE // common, int(rate) // common)
    balls, ratio = bearing
    cage = 0.5 * shaft * (1.0 - ratio)
    spectrum = measure.envelope(part, RATE, BAND)
    lines = {
        "outer": (balls * cage, shaft), "inner": (balls * (shaft - cage), shaft),
        "ball": (shaft / ratio * (1.0 - ratio**2), cage),
    }  # fmt: skip
    found = {"f_r": _dB(spectrum.at(shaft)[2]), "f_c": _dB(spectrum.at(cage)[2])}
    for name, (frequency, side) in lines.items():
        here, amplitude, over = spectrum.at(frequency, SLIP * frequency)
        found[name] = _dB(over)
        found[f"2 {name}"] = _dB(spectrum.at(2.0 * here)[2])
        sides = [spectrum.at(here + way * side)[1] for way in (-1, 1)]
        found[f"{name} sides"] = _dB(np.mean(sides) / amplitude)
    found["kurtosis"], found["band kurtosis"] = (
        _dB(scipy.stats.kurtosis(part, fisher=False)), _dB(spectrum.kurtosis),
    )  # fmt: skip
    frequency, power = scipy.signal.welch(part, RATE, nperseg=2048)
    powers = [power[(frequency >= low) & (frequency < high)].sum() for low, high in BANDS]
    found |= {name: _dB(np.sqrt(one / sum(powers))) for name, one in zip(SHARES, powers, strict=True)}
    return {name: found[name] for name in NAMES}


def parts(signal, rate, count=PARTS):
    """Return parts of `LENGTH`, evenly apart, shape (count, samples)."""
    size = round(LENGTH * rate)
    starts = np.linspace(0, len(signal) - size, count).astype(int)
    return np.stack([signal[start : start + size] for start in starts])


def _dB(ratio):
    return 20.0 * np.log10(max(float(ratio), 1e-6))


def _computed(folder):
    """Yield length and width of the defect (mm; empty: none), class, and features of the runs of a set."""
    import h5py

    with (folder / "labels.csv").open(encoding="utf-8", newline="") as file:
        labels = list(csv.DictReader(file))
    head = "imperfections.defect[1]."
    with h5py.File(folder / "waveforms.nc") as file:
        for label, waveforms in zip(labels, file["waveforms"], strict=True):
            if not label["reason"]:
                size = [f"{float(one):.3g}" if one else "" for one in
                        (label[f"{head}length_mm"], label[f"{head}width_mm"])]  # fmt: skip
                signal = waveforms[0].astype(float)
                yield [*size, label["class"]], features(signal, RATE, float(label["f_r_Hz"]), OWN)


def _cwru(folder: Path) -> Iterator[tuple[str, str, np.ndarray, float, float]]:
    """Yield name, class, signal, samples and turns per second of the records at the drive end."""
    kinds = {"IR": "inner", "OR": "outer", "B": "ball", "Normal": "healthy"}
    for path in sorted(folder.glob("*.npz")):
        match = re.fullmatch(r"(\d+)_(IR|OR|B|Normal)(.*?)(_DE12)?", path.stem)
        if match and (match[4] or match[2] == "Normal"):
            # the record without fault was taken at 48 kHz
            rate = 48_000.0 if match[2] == "Normal" else 12_000.0
            yield path.stem, kinds[match[2]], np.load(path)["DE"].ravel(), rate, int(match[1]) / 60.0


def _mfpt(folder: Path) -> Iterator[tuple[str, str, np.ndarray, float, float]]:
    """Yield the same of the records with one load each."""
    for path in sorted(folder.glob("*RaceFault_vload_*.mat")):
        bearing = scipy.io.loadmat(path, squeeze_me=True, struct_as_record=False)["bearing"]
        kind = "outer" if path.stem.startswith("Outer") else "inner"
        # 48,828 Hz is taken as 48,800: lines are found 0.06 % off, within what is searched
        yield path.stem, kind, np.asarray(bearing.gs), 48_800.0, float(bearing.rate)


def _write(path, columns, rows):
    with path.open("w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file, lineterminator="\n")
        writer.writerow([*columns, *NAMES])
        for head, numbers in rows:
            writer.writerow([*head, *(f"{numbers[key]:.1f}" for key in NAMES)])


def main():
    """Derive the files that are asked for."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--set", type=Path, help="folder of a data set made of plan.toml")
    parser.add_argument("--cwru", type=Path, help="folder of the records; with --mfpt")
    parser.add_argument("--mfpt", type=Path, help="folder of the records; with --cwru")
    asked = parser.parse_args()
    if asked.set:
        _write(COMPUTED, ["length_mm", "width_mm", "class"], _computed(asked.set))
    if asked.cwru and asked.mfpt:
        rows = [
            ([source, name, kind], features(part, rate, shaft, bearing))
            for source, records, bearing in (
                ("CWRU", _cwru(asked.cwru), CWRU), ("MFPT", _mfpt(asked.mfpt), MFPT),
            )
            for name, kind, signal, rate, shaft in records
            for part in parts(signal, rate)
        ]  # fmt: skip
        _write(PUBLIC, ["source", "record", "class"], rows)


if __name__ == "__main__":
    main()
