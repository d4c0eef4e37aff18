"""Sound power: from pressures on an enclosing surface (ISO 3744), and from the motion of compact bodies.

Pressures are computed in a perfect free field, so the corrections for background noise K1 and for the room K2
are zero. ISO 3744 takes p^2 / (rho c) at 400 N s/m3; here it is the air's own rho c, 0.18 dB apart for
the papers' air.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.acoustics.radiation.effective import cylinder_volumes, ring_volumes
from fmu_bearing.acoustics.radiation.radiators import Air, Radiators
from fmu_bearing.engine.layout import SD

REFERENCE_POWER = 1e-12  # W
_FLOOR = 1e-30  # W added, so that levels stay finite

# ISO 3744, annex B: ten places of equal areas on a hemisphere over a reflecting plane, in radii (quoted
# from memory; put on the sphere exactly below).
_TEN = (
    (-0.99, 0.0, 0.15), (0.50, -0.86, 0.15), (0.50, 0.86, 0.15), (-0.45, 0.77, 0.45), (-0.45, -0.77, 0.45),
    (0.89, 0.0, 0.45), (0.33, 0.57, 0.75), (-0.66, 0.0, 0.75), (0.33, -0.57, 0.75), (0.0, 0.0, 1.0),
)  # fmt: skip
# The further ten, turned half round, for sources of narrow directivity: the top counts twice there.
_TWENTY = _TEN + tuple((-x, -y, z) for x, y, z in _TEN)


@dataclass(frozen=True)
class Power:
    """Sound power of a source.

    Attributes
    ----------
    watts : float
    level : float
        In dB re 1 pW.
    surface_level : float
        Mean of the squared pressures over the surface, as a level (dB re 20 uPa).
    spread : float
        Largest minus smallest level on the surface (dB): above some 10 dB the points are too few.
    """

    watts: float
    level: float
    surface_level: float
    spread: float


def power_level(watts: ArrayLike) -> NDArray[np.float64]:
    """Level in dB re 1 pW of a power in W; always finite."""
    return 10.0 * np.log10((np.asarray(watts, dtype=float) + _FLOOR) / REFERENCE_POWER)


def hemisphere_points(radius: float, many: bool = False) -> NDArray[np.float64]:
    """Points (m) of ISO 3744 on a hemisphere about the bearing centre, shape (10 or 20, 3).

    The reflecting plane is normal to the bearing axis, through the centre, and the hemisphere lies on its +X
    side: x is the standard's z. ``many`` adds the second set of places.
    """
    table = np.array(_TWENTY if many else _TEN)
    table *= radius / np.linalg.norm(table, axis=1, keepdims=True)
    return table[:, [2, 0, 1]]


def sphere_points(radius: float, many: bool = False) -> NDArray[np.float64]:
    """Points (m) on a full sphere in a free field, shape (20 or 40, 3): the hemisphere's and their images."""
    half = hemisphere_points(radius, many)
    return np.concatenate([half, half * np.array([-1.0, 1.0, 1.0])])


def power_from_pressure(mean_squares: ArrayLike, radius: float, air: Air, hemisphere: bool = False) -> Power:
    """Sound power from mean squared pressures (Pa^2) at points of equal areas on a sphere of ``radius`` (m).

    ISO 3744: the surface's mean pressure level plus ten times the logarithm of its area. Near a dipole the
    pressure also holds what does not radiate: the power then reads 1 + 1/(kr)^2 times too high.

    Raises
    ------
    ValueError
        For no points, or a radius that is not positive.
    """
    squares = np.asarray(mean_squares, dtype=float).ravel()
    if squares.size == 0 or not radius > 0.0:
        raise ValueError(f"power needs points on a sphere of positive radius, not {squares.size=}, {radius=}")
    area = (2.0 if hemisphere else 4.0) * np.pi * radius**2
    watts = float(squares.mean()) * area / (air.density * air.sound_speed)
    spread = float(np.ptp(level(squares)))
    return Power(watts, float(power_level(watts)), float(level(squares.mean())), spread)


def dipoles(radiators: Radiators, channels: int) -> dict[str, NDArray[np.float64]]:
    """Weights that turn channels of accelerations into V a (m^4/s^2) along x, y, z, by component.

    V is the effective volume of each body (`effective`): displaced volume plus effective mass of air over the
    air's density. Shape (3, channels) each; balls count by the sum over all of them, which their
    circumferential order 1 holds. What moves as a dipole only: tilts and flexure are left out.
    """
    bodies = [("inner_ring", SD.C_INNER, radiators.inner_ring), ("cage", SD.C_CAGE, radiators.cage)]
    weights: dict[str, NDArray[np.float64]] = {}
    if radiators.housing is None:
        bodies.append(("outer_ring", SD.C_OUTER, radiators.outer_ring))
    else:
        weights["outer_ring"] = _body(
            channels, SD.C_OUTER, cylinder_volumes(radiators.housing.diameter, radiators.housing.length)
        )
    for name, channel, ring in bodies:
        if ring is not None:
            weights[name] = _body(channels, channel, ring_volumes(ring.outer, ring.inner, ring.width))
    balls = np.zeros((3, channels))
    first = SD.C_HARMONICS  # of order 1
    balls[0, SD.C_BALLS + SD.MEAN_X] = 1.0
    if channels >= first + SD.HARMONIC_SIZE:
        # a_y = -a_r sin - a_t cos, a_z = a_r cos - a_t sin
        balls[1, [first + SD.HARMONIC_R_SIN, first + SD.HARMONIC_T_COS]] = -1.0
        balls[2, [first + SD.HARMONIC_R_COS, first + SD.HARMONIC_T_SIN]] = 1.0, -1.0
    weights["balls"] = balls * (2.0 * np.pi * (radiators.ball_diameter / 2.0) ** 3)
    return weights


def _body(channels: int, first: int, volumes: tuple[float, float]) -> NDArray[np.float64]:
    radial, axial = volumes
    weights = np.zeros((3, channels))
    weights[[0, 1, 2], [first, first + 1, first + 2]] = axial, radial, radial
    return weights


def power_from_motion(
    frequency: ArrayLike, strength: ArrayLike, air: Air, radius: float = 0.0
) -> NDArray[np.float64]:
    """Power (W) radiated by a compact body at each frequency, shape (frequencies,).

    W = omega^2 |F|^2 / (12 pi rho c^3), where F = rho V a is the rate of momentum the body gives to the air.
    Source: Dowling and Ffowcs Williams (1983), the compact dipole.

    Parameters
    ----------
    frequency : array_like, shape (frequencies,)
        In Hz.
    strength : array_like, shape (..., frequencies)
        Rms of V a (m^4/s^2) along axes at right angles, V the body's effective volume (`effective`), which
        is its displaced volume and its effective mass of air; directions add in energy.
    radius : float
        Of a sphere whose departure from compactness is allowed for (m); 0: none.
    """
    omega = 2.0 * np.pi * np.asarray(frequency, dtype=float)
    squares = np.asarray(strength, dtype=float) ** 2
    if squares.ndim > 1:
        squares = squares.reshape(-1, squares.shape[-1]).sum(axis=0)
    ka = omega * radius / air.sound_speed
    compact: NDArray[np.float64] = omega**2 * air.density * squares / (12.0 * np.pi * air.sound_speed**3)
    return compact * 4.0 / ((2.0 - ka**2) ** 2 + 4.0 * ka**2)
