"""Limit of stability of milling by the mean of the cutting forces over a revolution (zero order).

A tooth at the angle p cuts a chip whose thickness is what it moves now less what the tooth before it left:
F = a K_t / 2 A(p) (d(t) - d(t - T)), tangential and radial force on the tool across its axis. The mean of A
over a revolution, N/2 pi times the directional coefficients, leaves constant coefficients with one delay T
(Altintas and Budak, CIRP Annals 44, 1995, 357-362). At the limit the tool vibrates at a frequency w:

    det(I + L A G(i w)) = 0,  L = -N a K_t / 4 pi (1 - exp(-i w T)),

so of each eigenvalue 1/L of -A G the real depth is a = -2 pi |L|^2 / (N K_t Re L), and the time between teeth
follows from exp(-i w T) = 1 + 4 pi L / (N a K_t). G is the whole 2 x 2 receptance with its cross terms.

Axes of the cut: u along the feed, v so that a tooth turns from v to u; p counts from v.
"""

import math
from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

#: Least radial immersion: with less, teeth are out of the cut for most of the time, and the mean misses the
#: lobes at twice the period (flip), which limit the depth there.
LEAST_IMMERSION = 0.25


@dataclass(frozen=True)
class Cut:
    """A cut by equally spaced teeth, SI units.

    Attributes
    ----------
    teeth : int
    coefficient : float
        K_t, Pa.
    ratio : float
        Radial over tangential force.
    entry, exit : float
        Angles at which a tooth enters and leaves, rad.
    """

    teeth: int
    coefficient: float
    ratio: float
    entry: float
    exit: float

    @property
    def directions(self) -> NDArray[np.float64]:
        """Directional coefficients, the integral of A over the angles in the cut, shape (2, 2)."""

        def at(p: float) -> NDArray[np.float64]:
            c, s, k = math.cos(2.0 * p), math.sin(2.0 * p), self.ratio
            return 0.5 * np.array(
                [
                    [c - 2.0 * k * p + k * s, -s - 2.0 * p + k * c],
                    [-s + 2.0 * p + k * c, -c - 2.0 * k * p - k * s],
                ]
            )

        return at(self.exit) - at(self.entry)


def angles(immersion: float, direction: Literal["up", "down"]) -> tuple[float, float]:
    """Return where a tooth enters and leaves (rad), by the radial depth over the diameter.

    Raises
    ------
    ValueError
        Below `LEAST_IMMERSION`.
    """
    if immersion < LEAST_IMMERSION:
        raise ValueError(
            f"milling.radial_immersion = {immersion:g} is refused; allowed: {LEAST_IMMERSION:g} to 1: with "
            "less the teeth are out of the cut most of the time, and the mean of their forces, which these "
            "lobes are from, misses the limit at twice the tooth period; run the cut in time instead "
            "(examples/milling/chatter.py)"
        )
    wide = math.acos(1.0 - 2.0 * immersion)
    return (0.0, wide) if direction == "up" else (math.pi - wide, math.pi)


def in_the_cut(across: NDArray[np.complex128], feed: float, positive: bool) -> NDArray[np.complex128]:
    """Return receptances of y, z (shape (..., 2, 2)) in the axes of the cut.

    ``feed``: rad about +X from 12 o'clock; ``positive``: whether the shaft turns positively about +X.
    """
    c, s = math.cos(feed), math.sin(feed)
    sign = 1.0 if positive else -1.0
    axes = np.array([[-s, c], [sign * c, sign * s]])
    return np.asarray(axes @ across @ axes.T)


def branches(cut: Cut, receptance: NDArray[np.complex128]) -> NDArray[np.complex128]:
    """Return both eigenvalues of A G over frequency, each continuous, shape (2, frequencies).

    Parameters
    ----------
    cut : Cut
    receptance : ndarray, shape (frequencies, 2, 2)
        In the axes of the cut, m/N.
    """
    product = cut.directions @ receptance
    half = 0.5 * (product[:, 0, 0] + product[:, 1, 1])
    root = np.sqrt(half**2 - (product[:, 0, 0] * product[:, 1, 1] - product[:, 0, 1] * product[:, 1, 0]))
    turns = np.where((np.conj(root[:-1]) * root[1:]).real < 0.0, -1.0, 1.0)
    root[1:] *= np.cumprod(turns)
    return np.array([half + root, half - root])


def depths(cut: Cut, eigenvalues: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Return the depth (m) at which each eigenvalue of A G is at the limit; not above 0: at none."""
    inverse = 1.0 / eigenvalues
    with np.errstate(divide="ignore"):
        return np.asarray(2.0 * math.pi / (cut.teeth * cut.coefficient) * np.abs(inverse) ** 2 / inverse.real)


def phases(eigenvalues: NDArray[np.complex128]) -> NDArray[np.float64]:
    """Return w T (rad, up to whole turns) at the limit of each eigenvalue of A G."""
    inverse = 1.0 / eigenvalues
    # 4 pi L / (N a K_t) with L = -1/eigenvalue
    delayed = 1.0 - 2.0 * inverse.real * inverse / np.abs(inverse) ** 2
    return np.asarray(-np.angle(delayed))


def limit_at(
    cut: Cut, eigenvalues: NDArray[np.complex128], frequencies: NDArray[np.float64], rpm: float
) -> tuple[float, float]:
    """Return the least depth (m) at the limit at one speed, and its frequency (Hz); infinite: there is none.

    Where w T passes a whole number of turns between two frequencies, both are interpolated.

    Parameters
    ----------
    eigenvalues : ndarray, shape (branches, frequencies)
    frequencies : ndarray
        Hz.
    rpm : float
        r/min, of any sign but not 0.
    """
    turns = 60.0 / (cut.teeth * abs(rpm)) * frequencies
    left = turns - phases(eigenvalues) / (2.0 * math.pi)
    left -= np.round(left)
    depth = depths(cut, eigenvalues)
    before, after = left[:, :-1], left[:, 1:]
    meets = (before * after <= 0.0) & (np.abs(after - before) < 0.5)
    meets &= (depth[:, :-1] > 0.0) & (depth[:, 1:] > 0.0)
    if not meets.any():
        return math.inf, math.nan
    b, k = np.nonzero(meets)
    gap = before[b, k] - after[b, k]
    share = np.where(gap == 0.0, 0.0, before[b, k] / np.where(gap == 0.0, 1.0, gap))
    found = depth[b, k] + share * (depth[b, k + 1] - depth[b, k])
    least = int(np.argmin(found))
    at = frequencies[k[least]] + share[least] * (frequencies[k[least] + 1] - frequencies[k[least]])
    return float(found[least]), float(at)
