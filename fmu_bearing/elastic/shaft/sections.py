"""Cylindrical sections of a shaft."""

import math
from dataclasses import dataclass

from fmu_bearing.scene import Scene, si
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
    material = si(shaft.material or scene.materials.inner_ring)
    elastic = (material.density, material.youngs_modulus, material.poisson_ratio)
    sections, start = [], 0.0
    for length, diameter, bore in shaft.sections_mm:
        sections.append(Section(start, 1e-3 * length, 5e-4 * diameter, 5e-4 * bore, *elastic))
        start += 1e-3 * length
    return sections
