"""Slow, independent answers the tests hold the package against.

Nothing here imports the package: geometry and material enter as plain SI numbers, every equation is derived
again and solved with general-purpose tools, speed is of no concern.

==================  ================================================================================
module              answers
==================  ================================================================================
`hertz`             point contact by elliptic integrals at 30 digits, and a surface integral that proves them
`kinematics`        defect frequencies, ball spin and orbit under pure rolling
`jones_harris`      quasi-static bearing: ring displacement and all balls in one system
`shaft`             several of them on one rigid shaft, by a general root finder
`spindle_dynamics`  several of any kind on one shaft in motion, by dense systems
`journal`           short journal bearing: film force by quadrature of the pressure, and in closed form
`radiation`         sound of spheres, cylinders and faces in closed form
`cartesian`         equations of motion in global Cartesian axes, ball by ball
==================  ================================================================================

Axes: X along the bearing axis, Z up; the angle theta runs from Z, growing with positive rotation about X, so
that ``e_r = (0, -sin, cos)``, ``e_t = (0, -cos, -sin)`` and ``e_x x e_r = e_t``. The inner ring is pushed
towards +X.
"""

from dataclasses import dataclass
from math import cos, pi, radians, sin

import numpy as np


@dataclass(frozen=True)
class Bearing:
    """Geometry and materials of an angular-contact ball bearing (SI units, angle in radians)."""

    ball_diameter: float
    pitch_diameter: float
    ball_count: int
    ring_modulus: float
    ring_poisson: float
    inner_conformity: float = 0.515
    outer_conformity: float = 0.52
    contact_angle: float = radians(15.0)
    ball_modulus: float = 310e9
    ball_poisson: float = 0.26
    ball_density: float = 3200.0

    @property
    def ball_mass(self) -> float:
        """Mass of one ball in kg."""
        return self.ball_density * pi / 6.0 * self.ball_diameter**3

    @property
    def ball_inertia(self) -> float:
        """Moment of inertia of one ball about any diameter in kg m2."""
        return self.ball_mass * self.ball_diameter**2 / 10.0

    @property
    def inner_reach(self) -> float:
        """Distance from the inner groove centre to the centre of a ball that just touches, in m."""
        return (self.inner_conformity - 0.5) * self.ball_diameter

    @property
    def outer_reach(self) -> float:
        """Distance from the outer groove centre to the centre of a ball that just touches, in m."""
        return (self.outer_conformity - 0.5) * self.ball_diameter

    @property
    def inner_groove_centre(self) -> tuple[float, float]:
        """Axial and radial coordinate of the inner groove centre, unloaded, in m."""
        angle = self.contact_angle
        return self.inner_reach * sin(angle), 0.5 * self.pitch_diameter + self.inner_reach * cos(angle)

    @property
    def outer_groove_centre(self) -> tuple[float, float]:
        """Axial and radial coordinate of the outer groove centre in m."""
        angle = self.contact_angle
        return -self.outer_reach * sin(angle), 0.5 * self.pitch_diameter - self.outer_reach * cos(angle)


def cross(a: np.ndarray, b: np.ndarray) -> np.ndarray:
    """Return a x b of two vectors; ``np.cross`` spends 20 us on finding out that they are vectors."""
    return np.array([a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]])


# The two bearings of the papers. Conformities, the pitch diameter of the 7009C and the materials' elastic
# numbers are assumed: the papers leave them open.
B7003C = Bearing(
    ball_diameter=4.5e-3, pitch_diameter=26e-3, ball_count=12, ring_modulus=208e9, ring_poisson=0.3
)
B7009C = Bearing(
    ball_diameter=8.731e-3, pitch_diameter=60e-3, ball_count=17, ring_modulus=210e9, ring_poisson=0.3
)
