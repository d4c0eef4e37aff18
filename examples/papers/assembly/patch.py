"""Springs of a contact patch between a ball and a ring."""

import math

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.fourier import Elastic
from fmu_bearing.formulas.hertz import effective_modulus

#: Tangential over normal stiffness of a patch that sticks: 2 (1 - nu) / (2 - nu) at nu = 0.3 (Mindlin 1949).
#: Steel on silicon nitride has 0.834.
TANGENTIAL = 0.82
#: Distance of a patch's four points from its middle, in patch radii. Springs k_n / 4 there resist turning out
#: of the surface with k_n distance^2 / 2. A stuck disc does so with 2/3 k_n a^2: 8 G a^3 / (3 (1 - nu))
#: beside k_n = 4 G a / (1 - nu) on a half space (Richart, Hall and Woods 1970, chapter 10). About the normal
#: the points resist with 1.09 k_n a^2, a stuck disc with 16 G a^3 / 3, 0.93 to 0.99 k_n a^2 on this pair.
SPREAD = 2.0 / math.sqrt(3.0)


def normal_stiffness(one: Elastic, other: Elastic, radius: float) -> float:
    """Stiffness 2 E* a (N/m) of two half spaces on a patch of the radius a (m): slope of Hertz's law.

    1/E* = (1 - nu1^2)/E1 + (1 - nu2^2)/E2; Johnson (1985), eqs. 4.22 to 4.24.

    Raises
    ------
    ValueError
        For a radius that is not positive.
    """
    if not (math.isfinite(radius) and radius > 0.0):
        raise ValueError(f"patch radius {radius} m: give a positive length")
    moduli = one.youngs_modulus, one.poisson_ratio, other.youngs_modulus, other.poisson_ratio
    return effective_modulus(*moduli) * radius  # effective_modulus is 2 E*


def points(bonded: bool, radius: float) -> NDArray[np.float64]:
    """Where springs act, across and along the race from the patch's middle (m), shape (points, 2)."""
    if not bonded:
        return np.zeros((1, 2))
    away = SPREAD * radius
    return away * np.array([[1.0, 0.0], [-1.0, 0.0], [0.0, 1.0], [0.0, -1.0]])
