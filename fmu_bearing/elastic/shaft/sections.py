"""Cylindrical sections of a shaft."""

import math
from collections.abc import Iterable
from dataclasses import dataclass

from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.material import Material
from fmu_bearing.scene.shaft import Shaft


@dataclass(frozen=True)
class Section:
    """A cylinder of the shaft: start, length, outer and inner radius (m), its material in SI units."""

    start: float
    length: float
    radius: float
    bore: float
    density: float
    youngs_modulus: float
    poisson_ratio: float

    @property
    def mass(self) -> float:
        """Mass, kg."""
        return self.density * math.pi * (self.radius**2 - self.bore**2) * self.length

    @property
    def polar(self) -> float:
        """Moment of inertia about the axis, kg m2."""
        return 0.5 * self.mass * (self.radius**2 + self.bore**2)

    @property
    def transverse(self) -> float:
        """Moment of inertia about an axis across, through its middle, kg m2."""
        return 0.5 * self.polar + self.mass * self.length**2 / 12.0


def shaft_sections(scene: Scene, shaft: Shaft) -> list[Section]:
    """Return the sections of a scene's shaft from the nose on."""
    return sections_of(shaft.sections_mm, shaft.material or scene.materials.inner_ring)


def sections_of(
    rows: Iterable[tuple[float, float, float]], material: Material, start: float = 0.0
) -> list[Section]:  # fmt: skip
    """Return cylinders of one material from rows of length, diameter, bore (mm), the first at ``start``."""
    found = si(material)
    elastic = (found.density, found.youngs_modulus, found.poisson_ratio)
    sections = []
    for length, diameter, bore in rows:
        sections.append(Section(start, 1e-3 * length, 5e-4 * diameter, 5e-4 * bore, *elastic))
        start += 1e-3 * length
    return sections
