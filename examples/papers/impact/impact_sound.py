"""From a collision to pressure histories: Fourier synthesis over `SphereRow`, balls rigid or elastic."""

from collections.abc import Sequence

import numpy as np
from numpy.typing import ArrayLike, NDArray

from examples.papers.impact.chain import Collision, Sphere
from examples.papers.impact.lamb import spheroidal_frequencies, surface_acceleration
from examples.papers.impact.scattering import SphereRow

Array = NDArray[np.float64]
Spectrum = NDArray[np.complex128]

#: Hz. A contact of 80 us leaves 1e-3 of its pulse's spectrum above (it falls as f^-2.5).
BAND = 80e3
#: Share of the band, at its upper end, over which the spectrum is faded out.
_FADE = 0.2
#: What is left of the sound after this many passages along the row counts as nothing (three balls: 1e-7).
_PASSAGES = 5.0
#: Orders above k a that an answer below 1 % needs, touching spheres aside.
_SPARE = 3


def transform(time: Array, signal: Array, frequency: Array) -> Spectrum:
    """Fourier integral of signals, shape (..., n), that are zero outside the uniform ``time``: (f, ...)."""
    step = time[1] - time[0]
    return np.exp(-2j * np.pi * frequency[:, None] * time) @ np.moveaxis(signal, -1, 0) * step


def rigid_drive(collision: Collision, frequency: Array) -> Spectrum:
    """Drive of `SphereRow.amplitudes` by rigid balls, per Hz: shape (f, spheres, 2)."""
    shaken = transform(collision.time, collision.acceleration, frequency)
    return np.stack([np.zeros_like(shaken), shaken], axis=-1)


def elastic_drive(collision: Collision, spheres: Sequence[Sphere], frequency: Array, orders: int) -> Spectrum:
    """Drive by elastic balls without damping, each pressed at a point by its neighbours' Hertz forces.

    The forces are computed for the rigid chain (assumed: waves inside do not change the contact). Shape
    (f, spheres, orders + 1), per Hz. Order 1 contains the motion of the ball as a whole.

    Raises
    ------
    ValueError
        When there are not as many spheres as in the collision.
    """
    count = len(collision.acceleration)
    if len(spheres) != count:
        raise ValueError(f"{len(spheres)} spheres, but the collision has {count}: give the same ones")
    force = transform(collision.time, collision.force, frequency)
    drive = np.zeros((frequency.size, count, orders + 1), dtype=complex)
    for i, ball in enumerate(spheres):
        before = force[:, i - 1] if i > 0 else 0.0  # presses at cos = -1
        after = force[:, i] if i < count - 1 else 0.0
        for n in range(orders + 1):
            stress = -(2 * n + 1) / (4.0 * np.pi * ball.radius**2) * (after + (-1) ** n * before)
            drive[:, i, n] = stress * surface_acceleration(ball, n, frequency)
    return drive


def impact_pressure(
    row: SphereRow,
    collision: Collision,
    points: ArrayLike,
    times: ArrayLike,
    *,
    spheres: Sequence[Sphere] | None = None,
    orders: int = 12,
    band: float = BAND,
) -> Array:
    """Pressure in Pa at points while the balls of a row hit each other, shape (points, times).

    The row is at rest: the balls move by micrometres. Zero before sound can arrive.

    Parameters
    ----------
    row : SphereRow
        Where the balls are. Exactly touching, or with whatever gaps one wants to hear.
    collision : Collision
        Of the same number of balls; all contacts must have ended.
    points : array_like, shape (points, 2)
        x and distance from the axis, m.
    times : array_like, shape (times,)
        s, on the collision's clock.
    spheres : sequence of Sphere, optional
        Makes the balls elastic (`elastic_drive`); without it they are rigid. The spectrum of an elastic
        surface does not die away with frequency: the history is that of a microphone that ends at ``band``.
    orders : int
        Highest order of the elastic surface, at most the row's.
    band : float
        Highest frequency in Hz, faded out over its last fifth.

    Raises
    ------
    ValueError
        For contacts that last beyond the end, other numbers of balls, an order too low for the band, a band
        that reaches the first mode of an elastic ball, points inside a ball.
    """
    place, when = row.outside(points), np.asarray(times, dtype=float)
    _check(row, collision, orders, band)
    for ball, radius in zip(spheres or (), row.radii, strict=False):  # numbers are compared by elastic_drive
        _elastic_enough(ball, radius, band)
    if not np.isfinite(when).all():
        raise ValueError(f"times hold {when[~np.isfinite(when)][0]}: give finite times in s")
    centres, radii = np.asarray(row.centres, dtype=float), np.asarray(row.radii, dtype=float)
    way = np.hypot(place[:, :1] - centres, place[:, 1:]) - radii
    first = way.min(axis=1) / row.air.sound_speed
    length = np.ptp(centres) + 2.0 * radii.max()
    window = collision.time[-1] + (np.ptp(way) + _PASSAGES * length) / row.air.sound_speed
    window = max(window, float(when.max(initial=0.0) - first.min()))  # else the period shows
    frequency = np.arange(int(np.ceil(band * window)) + 1) / window
    if spheres is None:
        drive = rigid_drive(collision, frequency)
    else:
        drive = elastic_drive(collision, spheres, frequency, orders)
    pressure = row.pressure(frequency, row.amplitudes(frequency, drive), place)
    end = np.clip((frequency / band - 1.0 + _FADE) / _FADE, 0.0, 1.0)
    weight = (2.0 - (frequency == 0.0)) / window * np.cos(0.5 * np.pi * end) ** 2
    history: Array = ((pressure.T * weight) @ np.exp(2j * np.pi * frequency[:, None] * when)).real
    return np.where(when >= first[:, None], history, 0.0)


def _elastic_enough(ball: Sphere, radius: float, band: float) -> None:
    """Refuse a ball of another size than in the row, and a band in which it would ring for ever, undamped."""
    if not np.isclose(ball.radius, radius, rtol=1e-9):
        raise ValueError(f"an elastic ball has radius {ball.radius:g} m, the row {radius:g} m: give the same")
    (first,) = spheroidal_frequencies(ball, 2)  # the lowest mode that forces on the axis excite
    if band >= first:
        raise ValueError(
            f"band {band:g} Hz reaches the first mode of an elastic ball, {first:g} Hz, which has no "
            "damping: take a lower band, or rigid balls"
        )


def _check(row: SphereRow, collision: Collision, orders: int, band: float) -> None:
    count = len(collision.acceleration)
    if len(row.radii) != count:
        raise ValueError(f"the row has {len(row.radii)} spheres, the collision {count}: give the same number")
    if collision.force[:, -1].any():
        raise ValueError(
            f"at the end, {collision.time[-1]:g} s, spheres still press with "
            f"{collision.force[:, -1].max():.3g} N: take a longer duration"
        )
    if not 0.0 < band < np.inf:
        raise ValueError(f"band {band} Hz: give a positive frequency")
    if not 0 <= orders <= row.order:
        raise ValueError(f"orders {orders}: give 0 to the row's order {row.order}")
    needed = 2.0 * np.pi * band / row.air.sound_speed * max(row.radii) + _SPARE
    if row.order < needed:
        raise ValueError(
            f"order {row.order} is too low for {band:g} Hz: take at least {int(np.ceil(needed))}, "
            "or a lower band"
        )
