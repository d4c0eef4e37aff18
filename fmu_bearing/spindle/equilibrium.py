"""Where shaft and sliding outer rings come to rest under loads: Newton's method in displacements.

Unknowns are the coordinates of the shaft and, for each sliding outer ring, its displacement along the
bearing's own axis. The first five of a shaft are x y z by bz of its nose. Contacts are springs: a step is
judged by the force along it, which must not turn round.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft import ShaftModel
from fmu_bearing.elastic.shaft.model import FREEDOMS
from fmu_bearing.engine.layout import P
from fmu_bearing.instance import EngineError
from fmu_bearing.scene.member import set_of
from fmu_bearing.spindle.assembly import Assembly
from fmu_bearing.spindle.member import Held

_ITERATIONS = 300
_BACKTRACKS = 12
_LONGEST = 5e-6  # m: step of a ring, tilts at the pitch radius; a tenth of the groove centres' distance
_FLOOR = 1.0  # N/m: moves a shaft that nothing holds by the longest step at most


@dataclass(frozen=True)
class Rest:
    """A set at rest.

    Attributes
    ----------
    shaft : ndarray, shape (n,)
        Coordinates of the shaft; the first five are x y z (m), tilts about y, z (rad) of its nose.
    apart : tuple of ndarray, shape (5,)
        Displacement of each inner ring against its outer one, in the bearing's own axes.
    held : tuple of Held
        The bearings, in their own axes.
    residual : float
        N; moments over the pitch radius.
    """

    shaft: NDArray[np.float64]
    apart: tuple[NDArray[np.float64], ...]
    held: tuple[Held, ...]
    residual: float


def rest(
    assembled: Assembly, load: NDArray[np.float64], inputs: list[NDArray[np.float64]] | None = None
) -> Rest:
    """Return the equilibrium of a set.

    Parameters
    ----------
    assembled : Assembly
    load : ndarray, shape (n,)
        On the shaft's coordinates: forces (N), moments (N m).
    inputs : list of ndarray, optional
        Of the engine, per bearing; default: those of the operating point.

    Raises
    ------
    EngineError
        Where there is no equilibrium.
    """
    system = _System(assembled, load, inputs)
    z = system.start()
    force, matrix, held = system.at(z)
    total = system.size(load) + sum(abs(one.force[0]) for one in held)
    limit = 1e-8 + 1e-10 * total
    damping = _FLOOR
    for _ in range(_ITERATIONS):
        size = system.size(force)
        if size <= limit:
            break
        step = system.step(matrix, force, damping)
        ahead = float(step @ force)
        if not ahead > 0.0:
            damping = max(10.0 * damping, 1e3)
            continue
        share = 1.0
        for n in range(_BACKTRACKS):
            trial = system.at(z + share * step)
            after = float(trial[0] @ step)
            if after >= -0.9 * ahead or system.size(trial[0]) < 0.5 * size or n == _BACKTRACKS - 1:
                break
            share *= min(max(ahead / (ahead - after), 0.1), 0.7)
        damping = max(0.3 * damping, _FLOOR) if share > 0.5 else 4.0 * damping
        z = z + share * step
        force, matrix, held = trial
    size = system.size(force)
    if not size <= 1e-6 * (100.0 + total):
        name, around = assembled.scene.name, 1e6 * z[0]
        pedestal = set_of(assembled.scene).housing.pedestal_stiffness_N_m
        soft = "" if pedestal is None else f" or a stiffer pedestal (pedestal_stiffness_N_m is {pedestal:g})"
        raise EngineError(
            f"{name}: no equilibrium of the shaft was found, {size:.3g} N stay out of balance with its nose "
            f"moved by {around:.3g} um: the load pushes it out of bearings that nothing holds, or the "
            f"bearings have lost their preload; give more preload or less load{soft}"
        )
    for number, one in enumerate(held, start=1):
        if one.force[0] > 1e-6 * (100.0 + total):
            raise EngineError(
                f"{assembled.scene.name}: bearing {number} would have to carry {one.force[0]:.4g} N against "
                "its direction, on the side of its races without shoulder: the load pushes the shaft the way "
                "that nothing holds, or temperatures pull the set apart; give more preload or less load"
            )
    count = assembled.shaft.count
    own = [moves @ z for moves in system.moves]
    for k, offset in enumerate(assembled.offsets):
        own[k][0] += offset
    return Rest(z[:count], tuple(own), held, size)


class _System:
    """Forces on shaft and supports, and their derivatives."""

    def __init__(
        self, assembled: Assembly, load: NDArray[np.float64], inputs: list[NDArray[np.float64]] | None
    ) -> None:
        self.members, self.offsets = assembled.members, assembled.offsets
        self.inputs = inputs or [one.inputs for one in self.members]
        self.load, self.supports = load, assembled.supports
        self.lever = float(self.members[0].parameters[P.PITCH_RADIUS])
        self.shaft, self.first = assembled.shaft, assembled.shaft.count
        self.count = self.first + self.supports.count
        self.scale = np.ones(self.count)
        self.scale[np.concatenate([self.shaft.tilts, self.supports.tilts])] = self.lever
        self.moves = [self._moves(k) for k in range(len(self.members))]

    def _moves(self, k: int) -> NDArray[np.float64]:
        """How unknowns move a bearing's inner ring against the outer one, in its own axes."""
        inner = self.members[k].mirror[:, None] * self.shaft.planes[k]
        return np.hstack([inner, -self.supports.rings[k]])

    def start(self) -> NDArray[np.float64]:
        """Place the shaft where preloaded bearings stand; a set that carries one way, where its load is."""
        z = np.zeros(self.count)
        signs = {one.sign for one in self.members}
        if len(signs) == 1:
            (sign,) = signs
            each = abs(self.load[0]) / len(self.members)
            z[0] = sign * (self.members[0].place_under(each, self.inputs[0]) - float(self.offsets.mean()))
        return z

    def at(self, z: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64], tuple[Held, ...]]:
        """Return forces out of balance, stiffness matrix, and the bearings."""
        force = np.zeros(self.count)
        force[: self.first] = self.load - self.shaft.stiffness @ z[: self.first]
        bearings = []
        for k, (one, inputs) in enumerate(zip(self.members, self.inputs, strict=True)):
            own = self.moves[k] @ z
            own[0] += self.offsets[k]
            held = one.at(own, inputs)
            force += self.moves[k].T @ held.force
            bearings.append(held)
        force[self.first :] += self.supports.force - self.supports.stiffness @ z[self.first :]
        return force, self.matrix([one.stiffness for one in bearings]), tuple(bearings)

    def matrix(self, bearings: Sequence[NDArray[np.float64]]) -> NDArray[np.float64]:
        """Return the stiffness matrix of shaft, bearings of these stiffnesses, and supports."""
        found = np.zeros((self.count, self.count))
        found[: self.first, : self.first] = self.shaft.stiffness
        for moves, stiffness in zip(self.moves, bearings, strict=True):
            found += moves.T @ stiffness @ moves
        found[self.first :, self.first :] += self.supports.stiffness
        return found

    def size(self, force: NDArray[np.float64]) -> float:
        """Length of forces (N), moments over the pitch radius."""
        return float(np.linalg.norm(force / self.scale[: len(force)]))

    def step(
        self, matrix: NDArray[np.float64], force: NDArray[np.float64], damping: float
    ) -> NDArray[np.float64]:
        """Newton's step, shortened so that no ring moves by more than the longest against the other."""
        scaled = matrix / np.outer(self.scale, self.scale) + damping * np.eye(self.count)
        step = np.linalg.solve(scaled, force / self.scale) / self.scale
        longest = 1e-300
        for moves in self.moves:
            own = moves @ step
            own[3:] *= self.lever
            longest = max(longest, float(np.abs(own).max()))
        return step * min(1.0, _LONGEST / longest)


def stiffness_with(
    assembled: Assembly, shaft: ShaftModel, bearings: Sequence[NDArray[np.float64]]
) -> NDArray[np.float64]:  # fmt: skip
    """Return the stiffness at the nose of a shaft, (5, 5); bearings have these, in their own axes."""
    other = _System(replace(assembled, shaft=shaft), np.zeros(shaft.count), None)
    return _condensed(other.matrix(bearings))


def _condensed(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Stiffness of the shaft at its nose with all else free to follow."""
    own, across = matrix[:FREEDOMS, :FREEDOMS], matrix[:FREEDOMS, FREEDOMS:]
    if across.shape[1] == 0:
        return own
    follow = np.linalg.solve(
        matrix[FREEDOMS:, FREEDOMS:] + 1e-3 * np.eye(across.shape[1]), matrix[FREEDOMS:, :FREEDOMS]
    )
    return np.asarray(own - across @ follow)
