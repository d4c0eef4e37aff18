"""Loudness, sharpness and roughness by MoSQITo (extra ``psychoacoustics``)."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from fmu_bearing.acoustics.analysis.audio import WAV_RATE, resample
from fmu_bearing.extras import need


@dataclass(frozen=True)
class Sensation:
    """How a steady sound is perceived.

    Attributes
    ----------
    loudness : float
        In sone: ISO 532-1 (Zwicker), free field, stationary.
    sharpness : float
        In acum: DIN 45692, from that loudness.
    roughness : float
        In asper: Daniel and Weber (1997), mean over time; NaN below 0.2 s.
    """

    loudness: float
    sharpness: float
    roughness: float


def sensation(pressure: ArrayLike, sample_rate: float) -> Sensation:
    """Psychoacoustic figures of a steady recording of pressures (Pa), shape (samples,).

    Raises
    ------
    MissingExtra
        Without MoSQITo.
    ValueError
        For less than 0.05 s.
    """
    metrics = need("mosqito.sq_metrics", "a figure of loudness, sharpness and roughness")
    signal = resample(pressure, sample_rate)
    if signal.ndim != 1 or signal.size < 0.05 * WAV_RATE:
        raise ValueError(
            f"one microphone's recording of 0.05 s or more is needed, not {signal.shape} at 48 kHz"
        )
    loudness = metrics.loudness_zwst(signal, WAV_RATE)[0]
    sharpness = metrics.sharpness_din_st(signal, WAV_RATE, weighting="din")
    roughness = float("nan")
    if signal.size >= 0.2 * WAV_RATE:
        roughness = float(np.mean(metrics.roughness_dw(signal, WAV_RATE, overlap=0.5)[0]))
    return Sensation(float(loudness), float(sharpness), roughness)
