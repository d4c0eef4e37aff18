"""What moves in a mode, with its kinetic energy: the parts of each bearing, of a set its shaft and housing.

Kinetic energy of the shaft with the inner rings is divided into its rigid motion along the axis, across it
and tilting about the centre of mass, and bending, which is the rest; the energy of the housing with the rings
in it likewise.
"""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft import rigid_transform
from fmu_bearing.elastic.shaft.model import FREEDOMS
from fmu_bearing.engine.layout import SP, Q
from fmu_bearing.modal.equations.linearised import Linearised
from fmu_bearing.modal.equations.shaft import ShaftMatrices
from fmu_bearing.modal.modes.energies import Part, parts, whirl


class Bodies:
    """The bodies of a linearised scene.

    Parameters
    ----------
    system : Linearised
    """

    def __init__(self, system: Linearised) -> None:
        self._system = system
        self._rigid = _rigid_bodies(system.shaft)
        self._turning = math.copysign(1.0, system.speed)

    def parts(self, vector: NDArray[np.complex128]) -> list[Part]:
        """Return what moves in an eigenvector, complex, for a positive frequency."""
        return [*self._of_shaft(vector), *self._of_bearings(vector)]

    def whirl(self, vector: NDArray[np.complex128]) -> str:
        """Return the direction in which the nose of a set's shaft whirls, see `energies.whirl`."""
        nose = self._system.shaft.nose @ vector[self._system.rates :]
        turn = 1j * self._turning
        return whirl(abs(nose[1] + turn * nose[2]), abs(nose[1] - turn * nose[2]))

    def _of_shaft(self, vector: NDArray[np.complex128]) -> Iterator[Part]:
        """Yield the parts of shaft, housing and sliding rings; `whirl` has their direction."""
        shaft, rates = self._system.shaft, vector[self._system.rates :]
        for body in self._rigid:
            own = rates[body.numbers]
            rest = own.copy()
            for word, order, columns in body.words:
                moved = body.motions[:, columns]
                inertia = moved.T @ body.mass @ moved
                amount = np.linalg.solve(inertia, moved.T @ (body.mass @ own))
                yield Part(f"{body.name} {word}", order, _energy(inertia, amount), 0.0)
                rest -= moved @ amount
            if body.bends:
                yield Part(f"{body.name} bending", 1, _energy(body.mass, rest), 0.0)
        sliding = shaft.shaft_count + (SP.HOUSING if shaft.housed else 0)
        if sliding < shaft.count:
            yield Part("sliding rings", 0, _energy(shaft.total[sliding:, sliding:], rates[sliding:]), 0.0)

    def _of_bearings(self, vector: NDArray[np.complex128]) -> Iterator[Part]:
        """Yield the parts of the bearings, of a set without the inner rings, which are its shaft's."""
        for k, bearing in enumerate(self._system.bearings):
            found = parts(bearing.coordinates, self._system.of_bearing(k, vector), self._turning)
            if not self._system.shaft.count:
                yield from found
                continue
            for part in found:
                if part.name.startswith("inner") and "flexure" not in part.name:
                    continue
                yield part._replace(name=f"{part.name} of bearing {k + 1}")


@dataclass(frozen=True)
class _Body:
    """Rigid motions of a body about its centre of mass in columns: shape (n, motions), and its mass."""

    name: str
    numbers: slice
    mass: NDArray[np.float64]
    motions: NDArray[np.float64]
    words: tuple[tuple[str, int, tuple[int, ...]], ...]
    bends: bool


def _rigid_bodies(shaft: ShaftMatrices) -> list[_Body]:
    """Return shaft and housing, where the set has them."""
    if not shaft.count:
        return []
    own = slice(0, shaft.shaft_count)
    total = shaft.total
    planes = [shaft.nose[:, own]]
    wanted = [rigid_transform(1.0, 0.0)]
    for motion, sign, position in zip(shaft.motions, shaft.signs, shaft.positions, strict=True):
        planes.append(rigid_transform(sign, 0.0) @ motion[:FREEDOMS, own])
        wanted.append(rigid_transform(1.0, float(position)))
    rigid = np.linalg.lstsq(np.vstack(planes), np.vstack(wanted), rcond=1e-12)[0]
    mass = total[own, own]
    words = (("axial", 0, (0,)), ("radial", 1, (1, 2)), ("tilt", 1, (3, 4)))
    bodies = [
        _Body("shaft", own, mass, _about_centre(rigid, mass, 1, 2, 3, 4), words, shaft.shaft_count > FREEDOMS)
    ]
    if shaft.housed:
        six = slice(shaft.shaft_count, shaft.shaft_count + SP.HOUSING)
        names = (
            ("axial", 0, (Q.X,)), ("radial", 1, (Q.Y, Q.Z)), ("spin", 0, (Q.TURN,)),
            ("tilt", 1, (Q.BY, Q.BZ)),
        )  # fmt: skip
        mass = total[six, six]
        motions = _about_centre(np.eye(SP.HOUSING), mass, Q.Y, Q.Z, Q.BY, Q.BZ)
        bodies.append(_Body("housing", six, mass, motions, names, False))
    return bodies


def _about_centre(
    motions: NDArray[np.float64], mass: NDArray[np.float64], y: int, z: int, by: int, bz: int
) -> NDArray[np.float64]:
    """Return motions with tilts about the centre of mass, so that energies add up."""
    moved = motions.copy()
    heavy = float(moved[:, y] @ mass @ moved[:, y])
    moved[:, bz] -= moved[:, y] * float(moved[:, y] @ mass @ moved[:, bz]) / heavy
    moved[:, by] -= moved[:, z] * float(moved[:, z] @ mass @ moved[:, by]) / heavy
    return moved


def _energy(mass: NDArray[np.float64], rates: NDArray[Any]) -> float:
    """Mean kinetic energy (J) of complex rates."""
    return 0.25 * float((rates.conj() @ mass @ rates).real)
