"""Contact conditions C1 to C4: natural frequencies of rings and balls that stick or slide."""

import math
from dataclasses import dataclass
from typing import Literal, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import eigh

from examples.papers.assembly.basis import RingBasis, ring_basis
from examples.papers.assembly.patch import TANGENTIAL, normal_stiffness, points
from fmu_bearing.elastic.modes import elastic
from fmu_bearing.elastic.section import INNER, OUTER, RACES, ring_section
from fmu_bearing.scene import Scene, si

Array = NDArray[np.float64]
Condition = Literal["C1", "C2", "C3", "C4"]

#: Whether balls are bonded to the inner and to the outer ring; else they slide without friction and without
#: separation (Kuan et al. 2026, table 8).
BONDED: dict[Condition, tuple[bool, bool]] = {
    "C1": (True, True),
    "C2": (True, False),
    "C3": (False, True),
    "C4": (False, False),
}
_BALL = 6  # coordinates of a ball: displacement along x, r, t (m), turn about them (rad)
#: Below this share of the highest natural frequency a motion has none: rounding leaves 1e-8 of it.
_ZERO = 3e-6
_SAME = 3e-4  # of the frequency: motions that near are one line; twins differ by rounding


class Line(NamedTuple):
    """Motions of one frequency (Hz): how many, and their mean shares of kinetic energy, the largest first."""

    frequency: float
    number: int
    shares: dict[str, float]


@dataclass(frozen=True, eq=False)
class ContactModes:
    """Modes of an assembly.

    Attributes
    ----------
    condition : str
        ``C1`` to ``C4``.
    held : bool
        Whether the outer ring's circumference is fixed.
    frequencies : ndarray, shape (m,)
        Hz, ascending; exactly 0 for motions without resistance.
    shapes : ndarray, shape (c, m)
        Of modal mass 1 kg. Rows: the inner ring's coordinates, the outer ring's, six of each ball.
    rings : tuple of RingBasis
        Inner and outer ring: what their rows mean.
    parts : tuple of str
        What can move: motions of the rings, ``balls moving``, ``balls turning``.
    energies : ndarray, shape (m, parts)
        Shares of the kinetic energy.
    """

    condition: Condition
    held: bool
    frequencies: Array
    shapes: Array
    rings: tuple[RingBasis, RingBasis]
    parts: tuple[str, ...]
    energies: Array

    @property
    def zero_modes(self) -> int:
        """Motions without resistance."""
        return int(np.sum(self.frequencies == 0.0))

    def lines(self, highest: float) -> list[Line]:
        """Lines above 0 and up to a frequency (Hz)."""
        found: list[Line] = []
        chosen = np.flatnonzero((self.frequencies > 0.0) & (self.frequencies <= highest))
        breaks = np.flatnonzero(np.diff(self.frequencies[chosen]) > _SAME * self.frequencies[chosen][:-1])
        for group in np.split(chosen, breaks + 1) if chosen.size else []:
            mean = self.energies[group].mean(axis=0)
            ranked = sorted(zip(self.parts, mean, strict=True), key=lambda pair: -pair[1])
            shares = {part: float(share) for part, share in ranked if share >= 0.01}
            found.append(Line(float(self.frequencies[group].mean()), len(group), shares))
        return found


def contact_modes(
    scene: Scene,
    condition: Condition,
    patch_radius: float,
    *,
    held: bool = True,
    ball_springs: float = 0.0,
    highest: float | None = None,
) -> ContactModes:
    """Modes of the scene's bearing at rest under one contact condition.

    Rings are free solids with the real groove, by Fourier modes; balls are rigid. A ball is tied to each ring
    by springs where it touches unloaded: 2 E* a along the normal, at one point if it slides; if it is bonded,
    `TANGENTIAL` times as much across, and both shared by four points, so that turning is resisted too.
    Source: Kuan, Chen, Shen and Chang (2026), sections 4.2 and 4.3.1, whose finite elements bond faces.

    Parameters
    ----------
    scene : Scene
        Bearing and materials; nothing else is read.
    condition : str
        ``C1`` both rings bonded, ``C2`` the inner, ``C3`` the outer, ``C4`` none.
    patch_radius : float
        Radius a (m) of all patches. The paper's bonded faces are as large as its mesh makes them.
    held : bool
        Whether the outer ring's circumference is fixed in all directions; else all is free.
    ball_springs : float
        Stiffness (N/m) between neighbouring balls' centres, along the chord; 0: none.
    highest : float, optional
        Ring modes up to this frequency (Hz); 0: rigid rings. By default `wall_limit` of each ring. Point
        forces make the result depend on it, as a logarithm.

    Raises
    ------
    ValueError
        For an unknown condition, a patch that is not positive, negative springs, a frequency that the mesh
        does not resolve, or rings that are impossible.
    MissingExtra
        Without scikit-fem (extra ``elastic``).
    """
    if condition not in BONDED:
        raise ValueError(f"condition {condition!r} is unknown: give {', '.join(BONDED)}")
    if not (math.isfinite(ball_springs) and ball_springs >= 0.0):
        raise ValueError(f"ball_springs = {ball_springs} N/m: give 0 or more")
    ring_materials = scene.materials.inner_ring, scene.materials.outer_ring
    materials = [elastic(material) for material in ring_materials]
    rings = (
        ring_basis(ring_section(scene, INNER), materials[INNER], False, highest),
        ring_basis(ring_section(scene, OUTER), materials[OUTER], held, highest),
    )
    ball = elastic(scene.materials.balls)
    bonded = BONDED[condition]
    stiffness = _chain(scene, rings, ball_springs)
    for body in (INNER, OUTER):
        normal = normal_stiffness(materials[body], ball, patch_radius)
        stiffness += _contacts(scene, rings, body, bonded[body], patch_radius, normal)
    own = np.concatenate([ring.mass * (2.0 * np.pi * ring.frequency) ** 2 for ring in rings])
    stiffness[np.arange(len(own)), np.arange(len(own))] += own
    return _solved(condition, held, rings, _masses(scene, rings), stiffness)


def _masses(scene: Scene, rings: tuple[RingBasis, RingBasis]) -> Array:
    """Masses (kg) and moments of inertia (kg m2) of all coordinates."""
    radius = si(scene.bearing).ball_diameter / 2.0
    mass = 4.0 / 3.0 * np.pi * radius**3 * si(scene.materials.balls).density
    ball = np.repeat([mass, 0.4 * mass * radius**2], 3)
    return np.concatenate([*(ring.mass for ring in rings), np.tile(ball, scene.bearing.ball_count)])


def _chain(scene: Scene, rings: tuple[RingBasis, RingBasis], spring: float) -> Array:
    """Stiffness of all coordinates by the springs along the chords between neighbouring balls' centres.

    In the axes of a ball the chord to the next one is cos(pi / Z) t - sin(pi / Z) r, in the next one's axes
    cos(pi / Z) t + sin(pi / Z) r: what moves all balls together changes no chord.
    """
    first, balls = sum(len(ring.parts) for ring in rings), scene.bearing.ball_count
    half = math.pi / balls
    outwards = first + _BALL * np.arange(balls) + 1
    longer = np.zeros((balls, first + _BALL * balls))
    for own, (r, t) in enumerate(zip(outwards, outwards + 1, strict=True)):
        longer[own, [r, t]] += math.sin(half), -math.cos(half)
        longer[own - 1, [r, t]] += math.sin(half), math.cos(half)
    total: Array = spring * longer.T @ longer
    return total


def _contacts(
    scene: Scene,
    rings: tuple[RingBasis, RingBasis],
    body: int,
    bonded: bool,
    patch_radius: float,
    normal: float,
) -> Array:
    """Stiffness of all contacts with one ring."""
    b = si(scene.bearing)
    first = sum(len(ring.parts) for ring in rings)
    ring, start = rings[body], body * len(rings[INNER].parts)
    side = -1.0 if body == INNER else 1.0
    outwards = side * np.array([math.sin(b.contact_angle), math.cos(b.contact_angle), 0.0])
    across = np.array([math.cos(b.contact_angle), -math.sin(b.contact_angle), 0.0])
    axes, springs = outwards[None], np.array([normal])
    if bonded:
        axes = np.vstack((outwards, across, [0.0, 0.0, 1.0]))
        springs = normal * np.array([1.0, TANGENTIAL, TANGENTIAL])
    centre = np.array([0.0, b.pitch_diameter / 2.0, 0.0])
    spots = points(bonded, patch_radius)
    rows = np.zeros((b.ball_count, len(spots), len(axes), first + _BALL * b.ball_count))
    for j in range(b.ball_count):
        for k, (aside, ahead) in enumerate(spots):
            place, motion = ring.at(aside, ahead, 2.0 * np.pi * j / b.ball_count)
            x, r, t = place - centre
            turned = np.array([[0.0, t, -r], [-t, 0.0, x], [r, -x, 0.0]])  # turn times lever
            own = first + _BALL * j
            rows[j, k, :, start : start + len(ring.parts)] = axes @ motion
            rows[j, k, :, own : own + _BALL] = -axes @ np.hstack((np.eye(3), turned))
    weighted = rows * (springs / len(spots))[:, None]
    size = rows.shape[-1]
    total: Array = rows.reshape(-1, size).T @ weighted.reshape(-1, size)
    return total


def _solved(
    condition: Condition, held: bool, rings: tuple[RingBasis, RingBasis], masses: Array, stiffness: Array
) -> ContactModes:
    """Eigenvalues and energies."""
    root = np.sqrt(masses)
    values, vectors = eigh(stiffness / np.outer(root, root))
    frequencies = np.sqrt(np.maximum(values, 0.0)) / (2.0 * np.pi)
    frequencies[frequencies < _ZERO * frequencies[-1]] = 0.0
    names = [*rings[INNER].parts, *rings[OUTER].parts]
    balls = (len(masses) - len(names)) // _BALL
    names += (["balls moving"] * 3 + ["balls turning"] * 3) * balls
    parts = tuple(dict.fromkeys(names))
    energies = np.array([[part == name for name in names] for part in parts]) @ vectors**2
    shapes = vectors / root[:, None]
    return ContactModes(condition, held, frequencies, shapes, rings, parts, energies.T)


def bodies(line: Line) -> dict[str, float]:
    """Shares of ``inner ring``, ``outer ring`` and ``balls`` in a line's kinetic energy."""
    found = {f"{race} ring": 0.0 for race in RACES} | {"balls": 0.0}
    for part, share in line.shares.items():
        word = part.split()[0]
        found["balls" if word == "balls" else f"{word} ring"] += share
    return found
