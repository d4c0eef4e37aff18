"""Sound of one free rigid sphere that moves along a line, in time: exact, without any Fourier transform."""

import math

import numpy as np
import scipy
from numpy.typing import ArrayLike, NDArray

from fmu_bearing.acoustics.radiation.radiators import Air


def sphere_pressure(
    time: ArrayLike,
    acceleration: ArrayLike,
    radius: float,
    distance: float,
    cosine: float,
    air: Air | None = None,
) -> NDArray[np.float64]:
    """Pressure in Pa at a point, on the grid of ``time``, of a sphere at rest before it.

    The transfer function is that of `sources.oscillating_sphere`; with s = j omega and T = radius / c,

        p / a = rho radius^3 cos / r^2 * (1 + s r / c) / (2 + 2 s T + s^2 T^2) * e^{-s (r - radius) / c}:

    a ringing that decays as e^{-t/T}, and the flight from the surface. Exact for an acceleration that is
    linear between its samples, apart from the flight time, which is interpolated linearly.

    Parameters
    ----------
    time : array_like, shape (n,)
        s, uniform, rising.
    acceleration : array_like, shape (n,)
        m/s2, of the centre along a line.
    radius, distance : float
        m; the distance counts from the centre.
    cosine : float
        Of the angle between the line and the direction to the point.
    air : Air, optional
        Density and sound speed.

    Raises
    ------
    ValueError
        For a point inside the sphere, a time that is not uniform, arrays that do not match, infinite values.
    """
    t, a = np.asarray(time, dtype=float), np.asarray(acceleration, dtype=float)
    air = Air() if air is None else air
    if t.ndim != 1 or t.size < 2 or a.shape != t.shape:
        raise ValueError(
            f"time {t.shape} and acceleration {a.shape}: give two lists of one length, 2 or more"
        )
    steps = np.diff(t)
    if not (np.isfinite(a).all() and steps.min() > 0.0 and np.ptp(steps) < 1e-6 * steps.mean()):
        raise ValueError("time must rise in equal steps and the acceleration be finite")
    if not 0.0 < radius <= distance < math.inf:
        raise ValueError(f"distance {distance} m, radius {radius} m: give a point on or outside the sphere")
    if not -1.0 <= cosine <= 1.0:
        raise ValueError(f"cosine {cosine}: give a number from -1 to 1")
    late = (distance - radius) / air.sound_speed
    delayed = np.interp(t - late, t, a, left=0.0)
    ringing = radius / air.sound_speed  # the unit of time in which the coefficients are near 1
    _, shape, _ = scipy.signal.lsim(
        ([distance / radius, 1.0], [1.0, 2.0, 2.0]), delayed, (t - t[0]) / ringing
    )
    pressure: NDArray[np.float64] = (
        air.density * radius**3 * cosine / distance**2 * np.asarray(shape, dtype=float)
    )
    return pressure
