"""Directivity and attenuation: points around a source, and the figures that say how its sound is spread.

Angles count from 12 o'clock about +X in the bearing plane, as everywhere; `plane_points` says how in others.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

#: Planes through the bearing centre, and the unit vectors of 0 and 90 degrees in each.
PLANES = {
    "YZ": ((0.0, 0.0, 1.0), (0.0, -1.0, 0.0)),  # the bearing plane: from 12 o'clock with positive rotation
    "XY": ((1.0, 0.0, 0.0), (0.0, 1.0, 0.0)),
    "XZ": ((1.0, 0.0, 0.0), (0.0, 0.0, 1.0)),
}


@dataclass(frozen=True)
class Directivity:
    """How levels are spread round a circle (sound-field paper, eqs. 13 to 15).

    Attributes
    ----------
    da : float
        Directivity angle: direction of the largest level (rad), eq. 13.
    dl : float
        Directivity level: largest level over the mean of the levels in dB round the whole circle, eq. 14; NaN
        where that mean is not positive.
    dv : float
        Largest minus smallest level of the whole circle (dB), eq. 15.
    highest, lowest, mean : float
        Largest level in the range asked for, smallest and mean level of the whole circle (dB).
    """

    da: float
    dl: float
    dv: float
    highest: float
    lowest: float
    mean: float


@dataclass(frozen=True)
class Attenuation:
    """Line through levels over the logarithm of distance.

    Attributes
    ----------
    per_doubling : float
        Change of level per doubling of the distance (dB); -6.02 far from any source.
    at_one : float
        Level at unit distance (dB).
    residual : float
        Largest deviation of a level from the line (dB).
    """

    per_doubling: float
    at_one: float
    residual: float


def circle_points(radius: float, axial: float, count: int = 24) -> NDArray[np.float64]:
    """Points (x, y, z) in m on a circle about the bearing axis, shape (count, 3), the first at 12 o'clock."""
    angle = circle_angles(count)
    return np.stack([np.full(count, axial), -radius * np.sin(angle), radius * np.cos(angle)], axis=1)


def circle_angles(count: int = 24) -> NDArray[np.float64]:
    """Angles (rad) of ``count`` evenly spaced points, the first at zero."""
    return 2.0 * np.pi * np.arange(count) / count


def plane_points(plane: str, radius: float, count: int = 360) -> NDArray[np.float64]:
    """Points (x, y, z) in m round the bearing centre in one of `PLANES`, shape (count, 3).

    Raises
    ------
    ValueError
        For another plane.
    """
    if plane not in PLANES:
        raise ValueError(f'plane = "{plane}": known are {", ".join(PLANES)}')
    first, second = (np.array(vector) for vector in PLANES[plane])
    angle = circle_angles(count)[:, None]
    return radius * (np.cos(angle) * first + np.sin(angle) * second)


def directivity(angles: ArrayLike, levels: ArrayLike, zone: tuple[float, float] | None = None) -> Directivity:
    """Directivity of levels (dB) at ``angles`` (rad) that go round a whole circle.

    Parameters
    ----------
    zone : (from, to), optional
        Range of angles (rad, growing, ends included) in which the largest level is looked for, such as the
        paper's impact and friction zones; mean and smallest level stay values of the whole circle.

    Raises
    ------
    ValueError
        When shapes differ or no point lies in the zone.
    """
    phi, value = np.asarray(angles, dtype=float), np.asarray(levels, dtype=float)
    if phi.ndim != 1 or phi.shape != value.shape or phi.size < 2:
        raise ValueError(f"angles {phi.shape} and levels {value.shape} must be two lists of one length")
    inside = np.ones(phi.size, dtype=bool)
    if zone is not None:
        low, high = zone
        inside = np.mod(phi - low, 2.0 * np.pi) <= np.mod(high - low, 2.0 * np.pi) + 1e-9
        if not inside.any():
            raise ValueError(f"no point lies between {np.degrees(low):g} and {np.degrees(high):g} deg")
    best = int(np.flatnonzero(inside)[np.argmax(value[inside])])
    mean = float(value.mean())
    ratio = float(value[best]) / mean if mean > 0.0 else float("nan")
    return Directivity(
        float(phi[best]), ratio, float(value.max() - value.min()), float(value[best]),
        float(value.min()), mean,
    )  # fmt: skip


def attenuation(distance: ArrayLike, levels: ArrayLike) -> Attenuation:
    """Fit levels (dB) by a straight line over the logarithm of ``distance`` (m) (least squares).

    Raises
    ------
    ValueError
        With fewer than two distances, or one that is not positive.
    """
    r, value = np.asarray(distance, dtype=float), np.asarray(levels, dtype=float)
    if r.ndim != 1 or r.shape != value.shape or len(np.unique(r)) < 2 or not (r > 0.0).all():
        raise ValueError(f"two or more positive distances, one level each: not {r.shape} and {value.shape}")
    doublings = np.log2(r)
    slope, offset = np.polyfit(doublings, value, 1)
    residual = np.max(np.abs(value - offset - slope * doublings))
    return Attenuation(float(slope), float(offset), float(residual))
