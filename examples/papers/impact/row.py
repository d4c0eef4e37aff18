"""Modes of balls in a row that touch: stuck together, or sliding without friction and separation.

The row is a solid of revolution about its line, so that motions part by their circumferential order: n = 0
along the line and about it, n = 1 across it with turning, each of these twice. Balls of one material are
tied by the springs of a patch of radius a as in `examples.papers.assembly.patch`: 2 E* a along the line;
stuck ones also `TANGENTIAL` times as much across, on four points.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from examples.papers.assembly.patch import SPREAD, TANGENTIAL, normal_stiffness
from examples.papers.impact.chain import Sphere
from examples.papers.impact.lamb import pole_modes
from fmu_bearing.elastic.fourier import Elastic

Array = NDArray[np.float64]

#: Below this share of the highest natural frequency a motion has none.
_ZERO = 3e-6


@dataclass(frozen=True)
class RowModes:
    """Natural frequencies (Hz) of a row of balls, ascending; exactly 0 for motion without resistance.

    Attributes
    ----------
    axial : ndarray
        n = 0, along the line; with the balls' own modes, if asked for.
    twist : ndarray
        n = 0, turning about the line; rigid balls.
    transverse : ndarray
        n = 1, across the line and turning; rigid balls. Each represents two modes.
    """

    axial: Array
    twist: Array
    transverse: Array

    @property
    def zero_modes(self) -> int:
        """Motions without resistance, modes of n = 1 twice."""
        still = [int(np.sum(found == 0.0)) for found in (self.axial, self.twist, self.transverse)]
        return still[0] + still[1] + 2 * still[2]


def row_modes(
    balls: Sequence[Sphere], patch_radius: float, *, bonded: bool, highest: float = 0.0
) -> RowModes:
    """Modes of free balls in a row.

    Parameters
    ----------
    balls : sequence of Sphere
        Two or more, in order along the line.
    patch_radius : float
        Radius a (m) of all patches.
    bonded : bool
        Whether neighbours stick together; else they slide and stay together.
    highest : float
        The balls' own modes along the line (Lamb 1882) up to this frequency, Hz; 0: rigid balls. Forces act
        on points, so that the lowest frequencies keep falling in proportion to it.

    Raises
    ------
    ValueError
        For fewer than two balls or a patch that is not positive.
    """
    if len(balls) < 2:
        raise ValueError(f"{len(balls)} balls do not make a row: give two or more")
    normal = [
        normal_stiffness(_material(one), _material(other), patch_radius)
        for one, other in zip(balls[:-1], balls[1:], strict=True)
    ]
    across = [TANGENTIAL * k if bonded else 0.0 for k in normal]
    lever = SPREAD * patch_radius
    inertia = np.array([0.4 * ball.mass * ball.radius**2 for ball in balls])
    twist = _chain([lever**2 * k for k in across], len(balls))
    turning = [k * lever**2 / 2.0 if bonded else 0.0 for k in normal]
    return RowModes(
        axial=_axial(balls, normal, highest),
        twist=_frequencies(twist, inertia),
        transverse=_transverse(balls, across, turning),
    )


def _material(ball: Sphere) -> Elastic:
    return Elastic(ball.modulus, ball.poisson, ball.density)


def _chain(springs: Sequence[float], count: int) -> Array:
    """Stiffness of a chain of ``count`` coordinates."""
    total = np.zeros((count, count))
    for j, k in enumerate(springs):
        total[j : j + 2, j : j + 2] += k * np.array([[1.0, -1.0], [-1.0, 1.0]])
    return total


def _axial(balls: Sequence[Sphere], springs: Sequence[float], highest: float) -> Array:
    """Along the line, n = 0: each ball as a whole and by its modes, which move its two poles."""
    poles = {ball: _poles(ball, highest) for ball in balls}
    own, right, left = (np.concatenate([poles[ball][k] for ball in balls]) for k in range(3))
    owner = np.concatenate([np.full(poles[ball][0].size, j) for j, ball in enumerate(balls)])
    total = np.diag(own)
    for j, k in enumerate(springs):
        opening = np.where(np.equal(owner, j + 1), left, 0.0) - np.where(np.equal(owner, j), right, 0.0)
        total += k * np.outer(opening, opening)
    return _frequencies(total, np.ones(len(own)))


def _poles(ball: Sphere, highest: float) -> tuple[Array, Array, Array]:
    """Squares of a ball's natural frequencies (1/s2), the rigid one first; motion of its right and left pole.

    Both along the line, at modal mass 1 kg.
    """
    rigid = np.array([ball.mass**-0.5])
    own, right, left = [np.zeros(1)], [rigid], [rigid]
    order, found = 0, np.ones(1)
    while highest > 0.0 and (found.size or order <= 2):  # from 2 on every order begins higher
        found, poles = pole_modes(ball, order, highest)
        own.append((2.0 * np.pi * found) ** 2)
        right.append(poles)
        left.append(-((-1.0) ** order) * poles)
        order += 1
    return np.concatenate(own), np.concatenate(right), np.concatenate(left)


def _transverse(balls: Sequence[Sphere], across: Sequence[float], turning: Sequence[float]) -> Array:
    """Across the line, n = 1: displacement and turn of each rigid ball in one plane."""
    count = len(balls)
    total = np.zeros((2 * count, 2 * count))
    for j, (k, twist) in enumerate(zip(across, turning, strict=True)):
        slide, turn = np.zeros((2, 2 * count))
        slide[2 * j : 2 * j + 4] = [-1.0, -balls[j].radius, 1.0, -balls[j + 1].radius]
        turn[[2 * j + 1, 2 * j + 3]] = -1.0, 1.0
        total += k * np.outer(slide, slide) + twist * np.outer(turn, turn)
    masses = np.ravel([[ball.mass, 0.4 * ball.mass * ball.radius**2] for ball in balls])
    return _frequencies(total, masses)


def _frequencies(stiffness: Array, masses: Array) -> Array:
    """Natural frequencies (Hz), exactly 0 where rounding alone is left."""
    values = eigh(stiffness / np.sqrt(np.outer(masses, masses)), eigvals_only=True)
    found: Array = np.sqrt(np.maximum(values, 0.0)) / (2.0 * np.pi)
    found[found <= _ZERO * found[-1]] = 0.0
    return found
