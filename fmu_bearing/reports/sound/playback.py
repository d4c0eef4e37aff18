"""Sounds that a browser plays: 16-bit WAV, one scale for all, so that louder stays louder."""

import io
import math

import numpy as np
from scipy.io import wavfile

from fmu_bearing.acoustics.analysis.audio import WAV_RATE, resample
from fmu_bearing.reports.data.microphones import Microphones
from fmu_bearing.reports.page.blocks import Block, Section, Sound, Words

LONGEST = 3.0  # s of each sound: 16 bits at 48 kHz take 128 kB per second of a page
_PEAK = 0.9
_FADE = 5e-3  # s, at both ends: no click where the player repeats
_FULL = 32_767


def audio(microphones: Microphones) -> Section:
    """Put the chosen microphones into players."""
    recording = microphones.subject.recording
    samples = min(recording.size, round(LONGEST * recording.rate))
    signals = resample(microphones.pressure[microphones.shown][:, :samples], recording.rate)
    peak = float(np.max(np.abs(signals)))
    factor = _PEAK / peak if peak > 0.0 else 1.0
    seconds = signals.shape[1] / WAV_RATE
    at_full = 20.0 * math.log10(1.0 / factor / math.sqrt(2.0) / 2e-5) if peak > 0.0 else math.nan
    blocks: list[Block] = [
        Words(
            f"The first {seconds:.2g} s at each microphone, in a loop, with {1e3 * _FADE:g} ms of fading "
            f"at both ends. All "
            f"are scaled by the same factor, {factor:.4g} per Pa ({1.0 / factor:.3g} Pa, {at_full:.1f} dB "
            f"of a sine, is full scale): what "
            "is louder there is louder here. The loudness of your player is not calibrated."
        )
    ]
    for place, signal in zip(microphones.shown, signals, strict=True):
        words = f"{microphones.names[place]}, {microphones.levels['A']['total'][place]:.1f} dB(A)"
        blocks.append(Sound(microphones.names[place], words, wav(factor * signal)))
    return Section("audio", "Listen", blocks)


def wav(signal: np.ndarray) -> bytes:
    """Return a signal within -1 .. 1 as a WAV file, faded in and out."""
    length = min(round(_FADE * WAV_RATE), len(signal) // 2)
    rise = 0.5 - 0.5 * np.cos(np.pi * (np.arange(length) + 0.5) / length) if length else np.empty(0)
    shaped = np.array(signal, dtype=float)
    shaped[:length] *= rise
    shaped[len(shaped) - length :] *= rise[::-1]
    file = io.BytesIO()
    wavfile.write(file, WAV_RATE, np.round(_FULL * np.clip(shaped, -1.0, 1.0)).astype(np.int16))
    return file.getvalue()
