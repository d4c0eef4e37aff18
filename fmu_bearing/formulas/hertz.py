"""Hertz contact of two bodies with exact elliptic integrals."""

import math
from dataclasses import dataclass

from scipy.optimize import brentq
from scipy.special import ellipe, ellipk


@dataclass(frozen=True)
class PointContact:
    """Constants of an elliptical point contact.

    Attributes
    ----------
    stiffness : float
        K of Q = K d^1.5 (N/m^1.5), Q load, d approach.
    half_length : float
        Semi-major axis over the root of the approach (m^0.5).
    half_width : float
        Semi-minor axis over the root of the approach (m^0.5).
    pressure : float
        Peak pressure over the root of the approach (Pa/m^0.5).
    ellipticity : float
        Major over minor axis.
    """

    stiffness: float
    half_length: float
    half_width: float
    pressure: float
    ellipticity: float


def effective_modulus(modulus_1: float, poisson_1: float, modulus_2: float, poisson_2: float) -> float:
    """Modulus E' = 2 / ((1 - nu1^2)/E1 + (1 - nu2^2)/E2) in Pa, as Hamrock and Dowson use it."""
    return 2.0 / ((1.0 - poisson_1**2) / modulus_1 + (1.0 - poisson_2**2) / modulus_2)


def ellipticity(ratio: float) -> float:
    """Major over minor axis for the ratio R_y / R_x >= 1 of the effective radii, by exact integrals.

    Root of R_y/R_x = (k^2 E - K) / (K - E), complete integrals of m = 1 - 1/k^2 (Johnson 1985, eq. 4.25).
    """
    if ratio < 1.0:
        raise ValueError(f"radius ratio {ratio} is below 1: give the larger effective radius across rolling")
    if ratio < 1.0 + 1e-9:
        return 1.0

    def mismatch(k: float) -> float:
        m = 1.0 - 1.0 / k**2
        return (k**2 * ellipe(m) - ellipk(m)) / (ellipk(m) - ellipe(m)) - ratio

    return float(brentq(mismatch, 1.0 + 1e-9, 1e4, xtol=1e-14, rtol=1e-14))


def point_contact(radius_x: float, radius_y: float, modulus: float) -> PointContact:
    """Constants for effective radii along and across the minor axis (m) and E' (Pa).

    Hamrock and Brewe (1983), with elliptic integrals instead of their fits.
    """
    k = ellipticity(radius_y / radius_x)
    m = 1.0 - 1.0 / k**2
    first, second = float(ellipk(m)), float(ellipe(m))
    radius = 1.0 / (1.0 / radius_x + 1.0 / radius_y)
    stiffness = math.pi * k * modulus * math.sqrt(radius * second / (4.5 * first**3))
    cube = stiffness ** (1.0 / 3.0)
    a = (6.0 * k**2 * second * radius / (math.pi * modulus)) ** (1.0 / 3.0) * cube
    b = a / k
    return PointContact(stiffness, a, b, 1.5 * stiffness / (math.pi * a * b), k)
