"""Receptance of a linearised scene at its nose: G = N (i w - A)^-1 B, motion per force there.

N reads the five motions of the nose, of a single bearing those of its inner ring, from the state. B lets a
force there accelerate what it acts on: inverse mass times N transposed. By the eigenvectors of A all
frequencies take one product. Eigenvectors of balls that are free along their orbits may be close to parallel;
so three frequencies are solved directly beside it, and where they differ, all are, which takes some ten times
as long. In `measurable` neutral motions of the balls are damped.
"""

import math

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.modal.equations.coordinates import FREEDOMS
from fmu_bearing.modal.equations.linearised import Linearised
from fmu_bearing.modal.modes.solve import without_needles

_EXACT = 1e-6  # of the root of both entries on the diagonal: within this the eigenvectors are taken
_FEW = 8  # frequencies that are solved directly in the time that eigenvectors take


def measurable(system: Linearised, frequencies: NDArray[np.float64]) -> NDArray[np.complex128]:
    """Return the receptance at the nose without the needles of neutral motions of the balls.

    The axes of the balls' spins turn over so slowly that a force which turns with the balls, as one part of a
    force at the cage's frequency does, meets hardly any resistance of theirs. `transfer` has needles at that
    frequency and its multiples, a fraction of a hertz wide, and as high as a damping of them says that is
    zero within the accuracy of the steady state. `modes` puts these motions apart; here they have a damping
    with which nothing rings.

    Parameters
    ----------
    system : Linearised
    frequencies : ndarray
        Hz, above 0.

    Returns
    -------
    ndarray, shape (frequencies, 5, 5)
    """
    values, vectors = eigen = _eigen(system.matrix)
    found = transfer(system, frequencies, eigen=eigen)
    calm = without_needles(system, values, vectors)
    chosen = calm != values
    out, into = _ports(system)
    try:
        of_modes = np.linalg.solve(vectors, into.astype(complex)).astype(complex)[chosen]
    except np.linalg.LinAlgError:  # two eigenvectors are parallel to the last digit
        return found
    s = 2j * math.pi * frequencies.astype(complex)
    needles, instead = (_summed(out @ vectors[:, chosen], one[chosen], of_modes, s) for one in (values, calm))
    return np.asarray(found - needles + instead)


def transfer(
    system: Linearised, frequencies: NDArray[np.float64], matrix: NDArray[np.float64] | None = None,
    eigen: tuple[NDArray[np.complex128], NDArray[np.complex128]] | None = None,
) -> NDArray[np.complex128]:  # fmt: skip
    """Return the receptance at the nose, shape (frequencies, 5, 5), m and rad per N and N m.

    Rows are motions x, y, z and tilts about y, z, columns forces and moments; a motion is the real part of
    its amplitude times exp(i w t).

    Parameters
    ----------
    system : Linearised
    frequencies : ndarray
        Hz, above 0.
    matrix : ndarray, optional
        That of one phase of a ball pitch; default: the mean.
    eigen : tuple of ndarray, optional
        Eigenvalues and vectors of the matrix, where they are known.
    """
    a = system.matrix if matrix is None else matrix
    out, into = _ports(system)
    s = 2j * math.pi * frequencies.astype(complex)
    if len(s) <= _FEW:
        return _direct(a, out, into, s)
    values, vectors = eigen or _eigen(a)
    sample = np.unique([0, len(s) // 2, len(s) - 1])
    direct = _direct(a, out, into, s[sample])
    try:
        of_modes = np.linalg.solve(vectors, into.astype(complex)).astype(complex)
        found = _summed(out @ vectors, values, of_modes, s)
    except np.linalg.LinAlgError:  # two eigenvectors are parallel to the last digit
        return _direct(a, out, into, s)
    size = np.sqrt(np.abs(np.diagonal(direct, axis1=1, axis2=2)).max(axis=0))
    if np.all(np.abs(found[sample] - direct).max(axis=0) <= _EXACT * np.outer(size, size)):
        return found
    return _direct(a, out, into, s)


def _eigen(a: NDArray[np.float64]) -> tuple[NDArray[np.complex128], NDArray[np.complex128]]:
    """Return eigenvalues and vectors, complex also where all are real."""
    values, vectors = (part.astype(complex) for part in np.linalg.eig(a))
    return values, vectors


def _ports(system: Linearised) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return N (5, n) and B (n, 5) of a linearised scene."""
    n, five = len(system.matrix), len(FREEDOMS)
    out, into = np.zeros((five, n)), np.zeros((n, five))
    shaft = system.shaft
    if shaft.count:
        out[:, system.places : system.places + shaft.count] = shaft.nose
        into[system.rates : system.rates + shaft.count] = shaft.inverse @ shaft.nose.T
        return out, into
    (one,) = system.bearings
    at = one.coordinates
    places, rates = (first + np.arange(five) for first in (at.rings, at.ring_rates))
    out[np.arange(five), places] = 1.0
    into[rates, np.arange(five)] = 1.0 / at.masses[rates]
    if at.held:  # rigid preload holds the ring along its axis
        into[rates[0], 0] = 0.0
    return out, into


def _summed(
    out: NDArray[np.complex128], values: NDArray[np.complex128], into: NDArray[np.complex128],
    s: NDArray[np.complex128],
) -> NDArray[np.complex128]:  # fmt: skip
    """Return out . diag(1 / (s - values)) . into at each s."""
    pairs = (out[:, None, :] * into.T[None, :, :]).reshape(-1, len(values))
    five = len(out)
    return np.asarray((pairs @ (1.0 / (s[None, :] - values[:, None]))).T.reshape(-1, five, five))


def _direct(
    a: NDArray[np.float64], out: NDArray[np.float64], into: NDArray[np.float64], s: NDArray[np.complex128]
) -> NDArray[np.complex128]:
    """Return out . (s - a)^-1 . into at each s, each by a solution of its own."""
    return np.array([out @ np.linalg.solve(one * np.eye(len(a)) - a, into) for one in s])
