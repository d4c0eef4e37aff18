"""Where shaft and sliding outer rings come to rest under loads: Newton's method in displacements.

Unknowns are x y z by bz of the shaft at its nose and, for each sliding outer ring, its displacement along the
bearing's own axis. Contacts are springs: a step is judged by the force along it, which must not turn round.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import P
from fmu_bearing.instance import EngineError
from fmu_bearing.spindle.assembly import Assembly
from fmu_bearing.spindle.member import Held

_ITERATIONS = 300
_BACKTRACKS = 12
_LONGEST = 5e-6  # m: step of a ring, tilts at the pitch radius; a tenth of the groove centres' distance
_FLOOR = 1.0  # N/m: moves a shaft that nothing holds by the longest step at most
_SHAFT = 5


@dataclass(frozen=True)
class Rest:
    """A set at rest.

    Attributes
    ----------
    shaft : ndarray, shape (5,)
        Displacement at the nose: x y z (m), tilts about y, z (rad).
    slides : ndarray
        Displacement (m) of each sliding outer ring along its own axis.
    held : tuple of Held
        The bearings, in their own axes.
    stiffness : ndarray, shape (5, 5)
        Of the shaft at its nose; sliding rings follow.
    residual : float
        N; moments over the pitch radius.
    """

    shaft: NDArray[np.float64]
    slides: NDArray[np.float64]
    held: tuple[Held, ...]
    stiffness: NDArray[np.float64]
    residual: float


def rest(
    assembled: Assembly, load: NDArray[np.float64], inputs: list[NDArray[np.float64]] | None = None
) -> Rest:
    """Return the equilibrium of a set.

    Parameters
    ----------
    assembled : Assembly
    load : ndarray, shape (5,)
        On the shaft at its nose: forces (N), moments about y, z (N m).
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
        raise EngineError(
            f"{name}: no equilibrium of the shaft was found, {size:.3g} N stay out of balance with its nose "
            f"moved by {around:.3g} um: the load pushes it out of bearings that nothing holds, or the "
            "bearings have lost their preload"
        )
    for number, one in enumerate(held, start=1):
        if one.force[0] > 1e-6 * (100.0 + total):
            raise EngineError(
                f"{assembled.scene.name}: bearing {number} would have to carry {one.force[0]:.4g} N against "
                "its direction, on the side of its races without shoulder: the load pushes the shaft the way "
                "that nothing holds, or temperatures pull the set apart"
            )
    return Rest(z[:_SHAFT], z[_SHAFT:], held, _condensed(matrix), size)


class _System:
    """Forces on shaft and sliding rings, and their derivatives."""

    def __init__(
        self, assembled: Assembly, load: NDArray[np.float64], inputs: list[NDArray[np.float64]] | None
    ) -> None:
        self.members, self.offsets = assembled.members, assembled.offsets
        self.inputs = inputs or [one.inputs for one in self.members]
        self.load, self.sliding = load, assembled.sliding
        self.spring = assembled.spring or (0.0, 0.0)
        self.lever = float(self.members[0].parameters[P.PITCH_RADIUS])
        self.count = _SHAFT + len(self.sliding)
        self.scale = np.ones(self.count)
        self.scale[3:_SHAFT] = self.lever

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
        force, matrix = np.zeros(self.count), np.zeros((self.count, self.count))
        force[:_SHAFT] = self.load
        bearings = []
        for k, (one, inputs) in enumerate(zip(self.members, self.inputs, strict=True)):
            moves = np.zeros((_SHAFT, self.count))
            moves[:, :_SHAFT] = one.transform
            if k in self.sliding:
                moves[0, _SHAFT + self.sliding.index(k)] = -1.0
            own = moves @ z
            own[0] += self.offsets[k]
            held = one.at(own, inputs)
            force += moves.T @ held.force
            matrix += moves.T @ held.stiffness @ moves
            bearings.append(held)
        push, stiffness = self.spring
        for place in range(_SHAFT, self.count):
            force[place] -= push + stiffness * z[place]
            matrix[place, place] += stiffness
        return force, matrix, tuple(bearings)

    def size(self, force: NDArray[np.float64]) -> float:
        """Length of forces (N), moments over the pitch radius."""
        return float(np.linalg.norm(force / self.scale[: len(force)]))

    def step(
        self, matrix: NDArray[np.float64], force: NDArray[np.float64], damping: float
    ) -> NDArray[np.float64]:
        """Newton's step, shortened so that no ring moves by more than the longest."""
        scaled = matrix / np.outer(self.scale, self.scale) + damping * np.eye(self.count)
        step = np.linalg.solve(scaled, force / self.scale) / self.scale
        longest = max(float(np.abs(step[_SHAFT:]).max()) if self.sliding else 0.0, 1e-300)
        for one in self.members:
            own = one.transform @ step[:_SHAFT]
            own[3:] *= self.lever
            longest = max(longest, float(np.abs(own).max()))
        return step * min(1.0, _LONGEST / longest)


def _condensed(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    """Stiffness of the shaft with sliding rings free to follow."""
    own, across = matrix[:_SHAFT, :_SHAFT], matrix[:_SHAFT, _SHAFT:]
    if across.shape[1] == 0:
        return own
    follow = np.linalg.solve(matrix[_SHAFT:, _SHAFT:] + 1e-3 * np.eye(across.shape[1]), across.T)
    return np.asarray(own - across @ follow)
