"""Sound files in pascals: WAV at 48 kHz, float or PCM, with the calibration written into the file.

A sample of 1.0 is the *full scale*, a pressure the caller states. It is kept as a comment in the file
(``full scale = 20 Pa``), so that `read_wav` gives pascals back.
"""

import io
import math
import os
import pathlib
import re
import struct
import warnings
import wave

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray
from scipy.io import wavfile

from fmu_bearing.file_words import one_line, why
from fmu_bearing.files import plain_file

WAV_RATE = 48_000
FULL_SCALE = 20.0  # Pa: 117 dB of a sine, above any bearing
_PASS, _STOP = 20_000.0, 24_000.0  # Hz
_ATTENUATION = 100.0  # dB of the resampler's stop band
#: Formats of the samples: 32-bit float, and whole numbers of 16 and 24 bits (PCM).
FORMATS = ("float", "16", "24")
_CALIBRATION = re.compile(r"full scale = ([0-9.eE+-]+) Pa")


def resample(pressure: ArrayLike, sample_rate: float, wanted: float = WAV_RATE) -> NDArray[np.float64]:
    """Resample along the last axis; 0.001 dB flat to 20 kHz (0.42 of the lower rate), -100 dB above 24 kHz.

    Raises
    ------
    ValueError
        When the rates are not whole numbers of hertz.
    """
    signal = np.asarray(pressure, dtype=float)
    if sample_rate == wanted:
        return signal
    rates = round(sample_rate), round(wanted)
    if abs(rates[0] - sample_rate) > 1e-6 * sample_rate or abs(rates[1] - wanted) > 1e-6 * wanted:
        raise ValueError(f"rates must be whole numbers of Hz, not {sample_rate} and {wanted}")
    common = math.gcd(*rates)
    up, down = rates[1] // common, rates[0] // common
    fine = rates[0] * up
    low = min(rates) / WAV_RATE
    width = 2.0 * math.pi * (_STOP - _PASS) * low / fine
    taps = 2 * math.ceil(0.5 * (_ATTENUATION - 8.0) / (2.285 * width)) + 1
    beta = 0.1102 * (_ATTENUATION - 8.7)
    kernel = scipy.signal.firwin(taps, 0.5 * (_PASS + _STOP) * low, window=("kaiser", beta), fs=fine)
    return scipy.signal.resample_poly(signal, up, down, axis=-1, window=kernel)


def check_format(sample_format: str) -> None:
    """Refuse what is none of `FORMATS`.

    Raises
    ------
    ValueError
        With the formats that there are.
    """
    if sample_format not in FORMATS:
        raise ValueError(f"there is no WAV format '{sample_format}': choose from {', '.join(FORMATS)}")


def write_wav(
    path: str | os.PathLike[str],
    pressure: ArrayLike,
    sample_rate: float,
    full_scale: float = FULL_SCALE,
    sample_format: str = FORMATS[0],
) -> None:
    """Write pressures (Pa) as a 48 kHz WAV file.

    Parameters
    ----------
    pressure : array_like, shape (samples,) or (channels, samples)
    full_scale : float
        Pressure (Pa) of a sample of 1.0. Players clip beyond; a file of floats itself does not.
    sample_format : str
        ``float`` (32 bits), ``16`` or ``24`` (PCM): whole numbers are rounded, by half a step at most, and
        clipped at the full scale.

    Raises
    ------
    ValueError
        When ``full_scale`` is not positive, or for another format.
    """
    check_format(sample_format)
    if not (math.isfinite(full_scale) and full_scale > 0.0):
        raise ValueError(f"full_scale = {full_scale} Pa must be positive")
    signal = resample(pressure, sample_rate) / full_scale
    peak = float(np.max(np.abs(signal), initial=0.0))
    if peak > 1.0:
        who = "players clip" if sample_format == "float" else "the file is clipped"
        warnings.warn(
            f"the peak of {peak * full_scale:.3g} Pa exceeds full_scale = {full_scale:g} Pa: {who}",
            stacklevel=2,
        )
    if sample_format == "float":
        wavfile.write(path, WAV_RATE, np.ascontiguousarray(signal.T, dtype=np.float32))
    else:
        _write_pcm(path, signal, int(sample_format))
    _comment(pathlib.Path(path), f"full scale = {full_scale!r} Pa")


def read_wav(
    path: str | os.PathLike[str], full_scale: float | None = None
) -> tuple[NDArray[np.float64], float]:
    """Pressures (Pa), shape (samples,) or (channels, samples), and sample rate (Hz) of a WAV file.

    Raises
    ------
    ValueError
        When the file cannot be read, or does not state its calibration and ``full_scale`` (Pa) is not given.
    """
    try:
        data = plain_file(path).read_bytes()
    except OSError as problem:
        raise ValueError(f"{path}: cannot be read: {why(problem)}") from None
    if full_scale is None:
        calibration = _CALIBRATION.search(data.decode("latin-1"))
        if calibration is None:
            raise ValueError(f"{path} does not say what pressure its full scale is: give full_scale in Pa")
        full_scale = float(calibration[1])
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", wavfile.WavFileWarning)  # parts that are no samples
            rate, samples = wavfile.read(io.BytesIO(data))
    except Exception as problem:  # SciPy raises what it comes upon in damaged files
        raise ValueError(f"{path}: is not a WAV file, or damaged: {one_line(problem)}") from None
    if samples.dtype == np.uint8:  # alone of all formats it has its zero in the middle
        samples = samples / 128.0 - 1.0
    elif np.issubdtype(samples.dtype, np.integer):
        samples = samples / -float(np.iinfo(samples.dtype).min)
    return np.asarray(samples, dtype=float).T * full_scale, float(rate)


def _write_pcm(path: str | os.PathLike[str], signal: NDArray[np.float64], bits: int) -> None:
    """Write samples of -1 to 1 as whole numbers of 16 or 24 bits."""
    most = 2.0 ** (bits - 1)
    whole = np.clip(np.rint(np.atleast_2d(signal).T * most), -most, most - 1.0).astype("<i4", order="C")
    data = whole.view(np.uint8).reshape(*whole.shape, 4)[..., : bits // 8].tobytes()
    with wave.open(os.fspath(path), "wb") as file:
        file.setnchannels(whole.shape[1])
        file.setsampwidth(bits // 8)
        file.setframerate(WAV_RATE)
        file.writeframes(data)


def _comment(path: pathlib.Path, text: str) -> None:
    """Append an INFO list with one comment, which every player skips, and mend the file's length."""
    words = text.encode("ascii") + b"\0"
    words += b"\0" * (len(words) % 2)
    body = b"INFO" + b"ICMT" + struct.pack("<I", len(words)) + words
    with path.open("r+b") as file:
        if file.seek(0, os.SEEK_END) % 2:
            file.write(b"\0")  # parts begin at even places
        file.write(b"LIST" + struct.pack("<I", len(body)) + body)
        length = file.tell() - 8
        file.seek(4)
        file.write(struct.pack("<I", length))
