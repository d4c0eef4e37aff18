"""Forces of a linearised bearing on its inner ring per motion of that ring, the outer ring fixed.

The balls, and the rings' flexure where the scene has it, are eliminated at the frequency, with all their
inertia, so what is left depends on it. Inertia and gyroscopic moment of the inner ring are taken out, and the
support that holds its tilt: they belong to the rotor.
"""

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import lu_factor, lu_solve

from fmu_bearing.engine.layout import STRIDE, P, Y
from fmu_bearing.modal.equations.bearing import BearingLinearised
from fmu_bearing.modal.equations.coordinates import FREEDOMS

_BALL_PLACES = Y.PLACES // STRIDE  # ball states that are places
_ORBIT = Y.TH // STRIDE  # the place round the bearing
# rad/s: as good as rest. What is slowest in a bearing, the balls' spin, follows at some 1 to 1e3 1/s, and K
# errs by the square of the ratio.
_SLOW = 1e-3


def at_rest(system: BearingLinearised) -> NDArray[np.float64]:
    """Return the stiffness for frequency to 0 with balls that keep their spacing, shape (5, 5), SI units.

    Rows and columns as of `impedance`. Friction moves the balls with the ring, so the matrix is not
    quite symmetric.
    """
    return impedance(system, spaced(system, system.matrix), np.array([_SLOW]))[0].real


def spaced(system: BearingLinearised, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Return a matrix in which no force depends on a ball's place round the bearing.

    A ring that circles with the balls, at the frequency of their orbit, loads each ball differently for good:
    free balls drift apart and bunch, and the bearing's stiffness has a pole there. A cage keeps them apart.
    Where springs between the balls do that, the matrix stays.
    """
    at = system.coordinates
    if system.arrays.p[P.SPRINGS] != 0.0:
        return matrix
    even = matrix.copy()
    even[_BALL_PLACES * at.balls :, at.ball_state(_ORBIT)] = 0.0
    return even


def impedance(
    system: BearingLinearised, matrix: NDArray[np.float64], frequencies: NDArray[np.float64]
) -> NDArray[np.complex128]:
    """Return dynamic stiffness Z at frequencies (rad/s, above 0), force = -Z motion, shape (k, 5, 5).

    Rows are forces along x, y, z and moments about y, z, columns displacements and tilts of the inner ring;
    motion is the real part of its amplitude times exp(i w t). SI units.

    Parameters
    ----------
    system : BearingLinearised
        With rigid preload turned into a force: a ring that is fixed has no row.
    matrix : ndarray
        Its mean matrix or that of one phase.
    """
    at, p = system.coordinates, system.arrays.p
    inside = np.r_[0 : at.rings, at.flexure : at.size]
    place = at.rings + np.arange(len(FREEDOMS))
    rate = at.ring_rates + np.arange(len(FREEDOMS))
    own = matrix[np.ix_(inside, inside)]
    moved, driven = matrix[np.ix_(inside, place)], matrix[np.ix_(inside, rate)]
    stiffness = np.empty((len(frequencies), len(FREEDOMS), len(FREEDOMS)), dtype=complex)
    for k, w in enumerate(frequencies):
        s = 1j * w
        factors = lu_factor(s * np.eye(inside.size) - own, check_finite=False)
        answer = lu_solve(factors, moved + s * driven, check_finite=False)
        accelerations = matrix[np.ix_(rate, place)] + s * matrix[np.ix_(rate, rate)]
        accelerations = accelerations + matrix[np.ix_(rate, inside)] @ answer
        stiffness[k] = -at.masses[rate][:, None] * accelerations - _support(p, s, system.speed)
    return stiffness


def _support(p: NDArray[np.float64], s: complex, speed: float) -> NDArray[np.complex128]:
    """Return what springs to ground and the rotor's own turning put on the inner ring, shape (5, 5)."""
    springs, dampers = (
        p[place : place + len(FREEDOMS)] for place in (P.SUPPORT_STIFFNESS, P.SUPPORT_DAMPING)
    )
    stiffness = np.diag(springs + s * dampers)
    by, bz = FREEDOMS.index("by"), FREEDOMS.index("bz")
    stiffness[by, bz] = s * p[P.INNER_POLAR] * speed
    stiffness[bz, by] = -stiffness[by, bz]
    return stiffness
