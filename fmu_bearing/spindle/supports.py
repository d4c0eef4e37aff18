"""What holds the outer rings of a set and gives way: springs at sliding rings, housing, pedestals.

Coordinates: the place of each sliding ring along its bearing's own axis; six of a housing that moves (x y z,
rotation about X, tilts about y and z at X = 0); x y z and tilts of each ring on a pedestal of its own.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft.model import FREEDOMS
from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.layout import SP, P, Q
from fmu_bearing.prepare.spindle import housing_of, in_housing
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.spindle import SetHousing, Spindle
from fmu_bearing.spindle.member import Member

_PLANE = [Q.X, Q.Y, Q.Z, Q.BY, Q.BZ]  # of an outer ring's six: its own rotation is left out
_TILTS = (False, False, False, True, True)


@dataclass(frozen=True)
class Supports:
    """Springs behind the outer rings of a set, SI units, for ``m`` coordinates.

    Attributes
    ----------
    rings : tuple of ndarray, shape (5, m)
        Motion of each outer ring, x y z and tilts, in its bearing's own axes.
    stiffness : ndarray, shape (m, m)
    force : ndarray, shape (m,)
        Of springs that push, and weights.
    tilts : ndarray of bool, shape (m,)
        Which coordinates are angles.
    """

    rings: tuple[NDArray[np.float64], ...]
    stiffness: NDArray[np.float64]
    force: NDArray[np.float64]
    tilts: NDArray[np.bool_]

    @property
    def count(self) -> int:
        """Number of coordinates."""
        return len(self.force)


def supports(
    scene: Scene, spindle: Spindle, members: tuple[Member, ...], spring: tuple[float, float] | None
) -> Supports:
    """Return the supports of a set; ``spring``: force (N) and stiffness (N/m) at each sliding ring."""
    sliding = [k for k, one in enumerate(members) if one.place.seat == "sliding"]
    own = [k for k, one in enumerate(members) if one.place.seat == "pedestal"]
    moves = spindle.housing.moves
    housing = len(sliding)
    first = housing + (SP.HOUSING if moves else 0)
    m = first + FREEDOMS * len(own)
    rings = [np.zeros((FREEDOMS, m)) for _ in members]
    stiffness, force, tilts = np.zeros((m, m)), np.zeros(m), np.zeros(m, dtype=bool)
    if moves:
        tilts[housing + Q.TURN : first] = True
        _feet(scene, stiffness[housing:first, housing:first], force[housing:first])
        for one, ring in zip(members, rings, strict=True):
            ring[:, housing:first] = in_housing(int(one.sign), one.position)[_PLANE]
    push, constant = spring or (0.0, 0.0)
    for place, k in enumerate(sliding):
        pressed = -rings[k][0]  # how far the seat goes from under its ring
        pressed[place] = 1.0
        stiffness += constant * np.outer(pressed, pressed)
        force -= push * pressed
        rings[k][0] = np.eye(m)[place]
    for number, k in enumerate(own):
        at = slice(first + FREEDOMS * number, first + FREEDOMS * (number + 1))
        rings[k][:, at] = np.eye(FREEDOMS)
        stiffness[at, at] = np.diag(_along(spindle.housing)[_PLANE])
        tilts[at] = _TILTS
    if scene.fidelity.terms.gravity:
        for one, ring in zip(members, rings, strict=True):
            force -= GRAVITY * _lying(one) * ring[Q.Z]
    return Supports(tuple(rings), stiffness, force, tilts)


def axial_springs(spindle: Spindle, spring: tuple[float, float] | None) -> dict[int, tuple[float, float]]:
    """Force (N) and stiffness (N/m) behind each outer ring that gives way along its axis by itself."""
    found = {}
    for k, one in enumerate(spindle.bearing):
        if one.seat == "sliding":
            found[k] = spring or (0.0, 0.0)
        elif one.seat == "pedestal":
            found[k] = (0.0, float(_along(spindle.housing)[Q.X]))
    return found


def _along(housing: SetHousing) -> NDArray[np.float64]:
    """Stiffness of a pedestal along and about x y z (N/m, N m/rad)."""
    radial, table = housing.pedestal_stiffness_N_m or 0.0, si(housing.model_copy(update={"material": None}))
    axial, turning = table.pedestal_axial_ratio * radial, table.pedestal_rotational_ratio * radial
    return np.array([axial, radial, radial, turning, turning, turning])


def _feet(scene: Scene, stiffness: NDArray[np.float64], force: NDArray[np.float64]) -> None:
    """Put the pedestal's stiffness and the housing's weight into their parts of matrix and vector."""
    assert scene.spindle is not None
    body, middle = housing_of(scene)
    motion = in_housing(1, middle)
    stiffness += motion.T @ np.diag(_along(scene.spindle.housing)) @ motion
    if scene.fidelity.terms.gravity:
        force -= GRAVITY * body.mass * motion[Q.Z]


def _lying(one: Member) -> float:
    """Mass (kg) of an outer ring and of what lies in it."""
    p = one.parameters
    cage = p[P.CAGE_MASS] if p[P.CAGE] else 0.0
    return float(p[P.OUTER_MASS] + p[P.BALLS] * p[P.BALL_MASS] + cage)
