"""Flexible shaft in a few coordinates: Craig-Bampton on the planes of nose and bearings.

Order of the coordinates: x y z by bz of the nose; y z by bz of each bearing from the nose to the rear; y z of
each mode with nose and bearings clamped, m at its largest deflection. A bearing at the nose shares its plane.
x is that of the whole shaft, which is rigid along its axis. Statics at nose and bearings equal those of the
whole beam. (Craig and Bampton, AIAA Journal 6, 1968, 1313-1319.)
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from fmu_bearing.elastic.shaft.beam import Beam, beam
from fmu_bearing.elastic.shaft.model import FREEDOMS, ShaftModel
from fmu_bearing.elastic.shaft.sections import Section
from fmu_bearing.threads import one_thread


@one_thread
def flexible_model(
    sections: Sequence[Section],
    bearings: Sequence[float],
    spots: Sequence[float] = (),
    fixed_modes: int = 2,
    damping_ratio: float = 0.0,
) -> ShaftModel:
    """Return a shaft that bends.

    Parameters
    ----------
    sections : sequence of Section
    bearings, spots : sequence of float
        Planes of bearings and heavy spots from the nose, m.
    fixed_modes : int
        Modes per direction with nose and bearings clamped.
    damping_ratio : float
        Damping in proportion to stiffness: over the critical one at the lowest bending frequency of the free
        shaft. It acts in fixed axes, as if from outside; a rigid motion is not damped.
    """
    whole = beam(sections, [0.0, *bearings, *spots])
    planes = sorted({whole.node(place) for place in (0.0, *bearings)})
    basis = reduction(whole, planes, fixed_modes)
    mass, stiffness, spin = (basis.T @ one @ basis for one in (whole.mass, whole.stiffness, whole.spin))
    first, second = _both(len(planes), fixed_modes)

    def spread(one: NDArray[np.float64]) -> NDArray[np.float64]:
        return np.asarray(first.T @ one @ first + second.T @ one @ second)

    def at(position: float) -> NDArray[np.float64]:
        moved = whole.motion(position) @ basis
        found = np.zeros((FREEDOMS, first.shape[1]))
        found[0, 0] = 1.0
        found[[1, 4]] = moved @ first
        found[[2, 3]] = moved @ second
        found[3] *= -1.0
        return found

    full = spread(mass)
    full[0, 0] = sum(section.mass for section in sections)
    rise = np.tile([1.0, 0.0], len(whole.nodes))
    lift = basis.T @ (whole.mass @ rise)
    rigid = spread(stiffness)
    return ShaftModel(
        full,
        2.0 * damping_ratio / whole.free_frequency() * rigid,
        rigid,
        first.T @ spin @ second - second.T @ spin @ first,
        np.array([lift @ first, lift @ second]),
        at(0.0),
        tuple(at(place) for place in bearings),
        tuple(at(place) for place in spots),
        sum(section.polar for section in sections),
        at,
    )


def reduction(whole: Beam, planes: Sequence[int], modes: int) -> NDArray[np.float64]:
    """Return the columns of Craig and Bampton in one plane: w and t of each plane's node, then modes.

    Modes have a largest deflection of 1, so their coordinates are in m.
    """
    interface = np.array([2 * node + k for node in planes for k in (0, 1)])
    free = np.setdiff1d(np.arange(len(whole.mass)), interface)
    inner = whole.stiffness[np.ix_(free, free)]
    basis = np.zeros((len(whole.mass), len(interface) + modes))
    basis[interface, np.arange(len(interface))] = 1.0
    basis[free, : len(interface)] = -np.linalg.solve(inner, whole.stiffness[np.ix_(free, interface)])
    basis[free, len(interface) :] = eigh(inner, whole.mass[np.ix_(free, free)])[1][:, :modes]
    for k in range(len(interface), len(interface) + modes):
        deflection = basis[::2, k]
        basis[:, k] /= deflection[np.argmax(np.abs(deflection))]
    return basis


def _both(planes: int, modes: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return what picks the coordinates of (y, bz) and of (z, -by) out of all."""
    size = 2 * planes + modes
    first, second = np.zeros((size, 1 + 2 * size)), np.zeros((size, 1 + 2 * size))
    for k in range(planes):
        column = 1 + 4 * k  # y z by bz
        first[2 * k, column] = first[2 * k + 1, column + 3] = 1.0
        second[2 * k, column + 1], second[2 * k + 1, column + 2] = 1.0, -1.0
    for k in range(modes):
        row, column = 2 * planes + k, 1 + 4 * planes + 2 * k  # y z
        first[row, column] = second[row, column + 1] = 1.0
    return first, second
