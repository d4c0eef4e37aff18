"""Masses and moments of inertia from the scene's dimensions."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.elastic.shaft.sections import shaft_sections
from fmu_bearing.engine.layout import Q
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.mounting import SUPPORTS, Mounting
from fmu_bearing.scene.spindle import Spindle

#: Rows of the inner ring, or of a plane of the shaft, that a support holds.
_ROWS = {
    "axial": slice(Q.X, Q.Y),
    "radial": slice(Q.Y, Q.INNER_BY),
    "tilt": slice(Q.INNER_BY, Q.OUTER),
}


@dataclass(frozen=True)
class RigidBody:
    """Mass (kg), transverse and polar moment of inertia (kg m2) about the bearing's centre."""

    mass: float
    transverse: float
    polar: float

    def __add__(self, other: "RigidBody") -> "RigidBody":
        """Two bodies fixed to each other, both centred in the bearing."""
        return RigidBody(self.mass + other.mass, self.transverse + other.transverse, self.polar + other.polar)


def annulus(inner_diameter: float, outer_diameter: float, width: float, density: float) -> RigidBody:
    """Ring of rectangular section; diameters and width in m, density in kg/m3."""
    mass = density * math.pi / 4.0 * (outer_diameter**2 - inner_diameter**2) * width
    return of_mass(mass, inner_diameter, outer_diameter, width)


def of_mass(mass: float, inner_diameter: float, outer_diameter: float, width: float) -> RigidBody:
    """Ring of a given mass (kg)."""
    squares = (inner_diameter**2 + outer_diameter**2) / 4.0
    return RigidBody(mass, mass * (3.0 * squares + width**2) / 12.0, mass * squares / 2.0)


def inner_ring(scene: Scene) -> RigidBody:
    """Inner ring alone, from its effective outer diameter."""
    b = si(scene.bearing)
    return annulus(b.bore, b.inner_ring_outer_diameter, b.width, si(scene.materials.inner_ring).density)


def outer_ring(scene: Scene) -> RigidBody:
    """Outer ring alone, from its effective inner diameter."""
    b = si(scene.bearing)
    return annulus(
        b.outer_ring_inner_diameter, b.outside_diameter, b.width, si(scene.materials.outer_ring).density
    )


def cage(scene: Scene) -> RigidBody:
    """Cage: a ring minus its round pockets, inertia scaled with the mass; zero where there is none."""
    if scene.bearing.cage is None or scene.materials.cage is None:
        return RigidBody(0.0, 0.0, 0.0)
    b, c = si(scene.bearing), si(scene.bearing.cage)
    density = si(scene.materials.cage).density
    full = annulus(c.bore, c.outside_diameter, c.width, density)
    wall = (c.outside_diameter - c.bore) / 2.0
    share = 1.0 - density * b.ball_count * math.pi / 4.0 * c.pocket_diameter**2 * wall / full.mass
    return RigidBody(full.mass * share, full.transverse * share, full.polar * share)


def rotor(scene: Scene) -> RigidBody:
    """Rotor as a solid cylinder centred in the bearing; zero where the scene has none."""
    if scene.mounted.rotor is None:
        return RigidBody(0.0, 0.0, 0.0)
    r = si(scene.mounted.rotor)
    return of_mass(r.mass, 0.0, r.diameter, r.length)


class Support(NamedTuple):
    """A spring with a damper between shaft and ground.

    Attributes
    ----------
    stiffness, damping : ndarray
        Shape (5,): along x y z (N/m, N s/m), about y z (N m/rad, N m s/rad).
    position_mm : float, optional
        Plane of the shaft that it holds; None: a bearing's, or the middle of the bearings.
    """

    stiffness: NDArray[np.float64]
    damping: NDArray[np.float64]
    position_mm: float | None


def supports(given: Mounting | Spindle, mass: float, transverse: float) -> Iterator[Support]:
    """Yield springs and dampers from the shaft to ground.

    Damping over the critical one counts all that turns, of ``mass`` (kg) and ``transverse`` moment of inertia
    (kg m2), as it would move on this support alone.
    """
    inertia = np.array([mass] * 3 + [transverse] * 2)
    for key, direction in SUPPORTS.items():
        table = getattr(given, key)
        if table is not None:
            stiffness = np.zeros(Q.OUTER)
            stiffness[_ROWS[direction]] = si(table).stiffness
            damping = 2.0 * table.damping_ratio * np.sqrt(stiffness * inertia)
            yield Support(stiffness, damping, getattr(table, "position_mm", None))


def rotor_inertia(scene: Scene) -> float:
    """Polar inertia (kg m2) of all that turns with the shaft's speed: rotor or shaft, and inner rings."""
    shaft = scene.assembly.shaft
    turning = sum(section.polar for section in shaft_sections(scene, shaft)) if shaft else rotor(scene).polar
    return turning + sum(len(places) * ring.polar for ring, places in _inner_rings(scene).items())


def rings_at_port(scene: Scene) -> tuple[float, float, float]:
    """Mass (kg), mass times X (kg m), inertia about Y or Z at X = 0 (kg m2) of the inner rings."""
    mass = static = about = 0.0
    for ring, places in _inner_rings(scene).items():
        mass += len(places) * ring.mass
        static += ring.mass * sum(places)
        about += len(places) * ring.transverse + ring.mass * sum(x * x for x in places)
    return mass, static, about


def _inner_rings(scene: Scene) -> dict[RigidBody, list[float]]:
    """Return the different inner rings of a scene, each with its places (m from the nose)."""
    rings: dict[RigidBody, list[float]] = {}
    for bearing in scene.bearings():
        rings.setdefault(inner_ring(bearing.scene), []).append(bearing.position)
    return rings


def housing(scene: Scene) -> RigidBody:
    """Housing that moves with the outer ring, its mass put at the bearing's centre; zero if none."""
    if scene.mounted.housing is None:
        return RigidBody(0.0, 0.0, 0.0)
    h = si(scene.mounted.housing)
    return of_mass(h.mass, 0.0, h.diameter, h.length)


def ball(scene: Scene) -> tuple[float, float]:
    """Mass (kg) and moment of inertia (kg m2) of one ball."""
    diameter = si(scene.bearing).ball_diameter
    mass = si(scene.materials.balls).density * math.pi / 6.0 * diameter**3
    return mass, mass * diameter**2 / 10.0
