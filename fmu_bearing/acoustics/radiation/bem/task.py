"""What boundary elements solve for a scene: bodies, sources, and the drives that move them.

Drives, in this order: accelerations along x, then radially, then angular ones about a transverse axis, each
of inner ring, outer ring and cage; flexural shapes; then, per circumferential order, the balls' accelerations
along x, r and theta.
"""

import hashlib
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.radiation.bem.meridian import Body, Mesh
from fmu_bearing.acoustics.radiation.bem.solver import Scatterer
from fmu_bearing.engine.sources import rooms_digest

BODIES = 3  # inner ring, outer ring, cage
AXIAL, RADIAL, TILT = 0, BODIES, 2 * BODIES  # first drive of each kind
_PER_WAVELENGTH = 6.0  # elements, two unknowns each
_GAP_ELEMENTS = 0.4  # longest element in a gap over the thickness of the thinnest ring


@dataclass(frozen=True)
class Shape:
    """Flexural shape on the skin of one body: normal part of the displacement at points of the section.

    ``order`` is its circumferential order; ``points`` (n, 2) are x, r in m, ``shape`` (n, 2) the
    displacements along x and r there, per unit of its coordinate.
    """

    component: int
    order: int
    points: NDArray[np.float64]
    shape: NDArray[np.float64]

    def at(self, points: NDArray[np.float64], normals: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return normal displacements at skin points, shape (n,), between the nearest two of the shape."""
        offset = points[:, None, :] - self.points
        distance = np.hypot(offset[:, :, 0], offset[:, :, 1])
        nearest = np.argsort(distance, axis=1)[:, :2]
        near = np.take_along_axis(distance, nearest, axis=1) + 1e-12
        weights = near[:, ::-1] / near.sum(axis=1)[:, None]
        moved = (self.shape[nearest] * weights[:, :, None]).sum(axis=1)
        return (moved * normals).sum(axis=1)


@dataclass(frozen=True)
class Task:
    """What is to be solved; equal tasks share one solution.

    ``orbit`` is the radius (m) of the circle of ball centres, 0 for silent balls; ``harmonics`` their highest
    circumferential order; ``plane`` the axial place (m) of a rigid wall; ``baffled``: the bodies are faces
    in that wall. Pressures are those in air of 1 kg/m3: they are proportional to its density.
    """

    bodies: tuple[Body, ...]
    sound_speed: float
    orbit: float
    harmonics: int
    shapes: tuple[Shape, ...] = ()
    plane: float | None = None
    baffled: bool = False

    def key(self) -> str:
        """Hash of all numbers that pressures depend on, and of the sources that solve them."""
        digest = hashlib.sha256(rooms_digest("acoustics/radiation/bem", "engine/boundary_elements").encode())
        numbers = [self.sound_speed, self.orbit, self.harmonics, self.baffled]
        digest.update(repr((numbers, self.plane)).encode())
        for body in self.bodies:
            digest.update(body.contour.tobytes() + repr(body.sides).encode())
        for shape in self.shapes:
            digest.update(repr((shape.component, shape.order)).encode())
            digest.update(shape.points.tobytes() + shape.shape.tobytes())
        return digest.hexdigest()[:24]

    @property
    def orders(self) -> int:
        """Number of circumferential orders, 0 included."""
        highest = max([1, self.harmonics if self.orbit > 0.0 else 0] + [shape.order for shape in self.shapes])
        return highest + 1

    def sphere(self) -> tuple[float, float]:
        """Place on the axis (m) and radius (m) of a sphere around all bodies."""
        corners = np.concatenate([body.contour for body in self.bodies])
        middle = 0.5 * (corners[:, 0].min() + corners[:, 0].max())
        return float(middle), float(np.hypot(corners[:, 0] - middle, corners[:, 1]).max())

    def waves(self, low: float, high: float) -> float:
        """Wavelengths that a sphere round all bodies gains across, from ``low`` to ``high`` (Hz)."""
        return 2.0 * self.sphere()[1] * (high - low) / self.sound_speed

    def scatterer(self, highest: float) -> Scatterer:
        """Mesh and integrals up to a frequency (Hz)."""
        wavenumber = 2.0 * np.pi * highest / self.sound_speed
        sections = [np.ptp(body.contour, axis=0).min() for body in self.bodies if body.closed]
        size = 2.0 * np.pi / wavenumber / _PER_WAVELENGTH
        finest = min([size] + [_GAP_ELEMENTS * float(thin) for thin in sections])
        source = self.orbit if self.orbit > 0.0 else None
        return Scatterer(self.bodies, wavenumber, self.orders, size, finest, source, self.plane)


def drives(task: Task, mesh: Mesh) -> list[tuple[int, NDArray[np.float64]]]:
    """Order and normal acceleration at the nodes of each of the bodies' drives; nil for absent bodies."""
    normals, points, component = mesh.node_normals(), mesh.points, mesh.node_component()
    lever = normals[:, 0] * points[:, 1] - normals[:, 1] * points[:, 0]
    profiles = []
    for order, profile in ((0, normals[:, 0]), (1, normals[:, 1]), (1, lever)):
        profiles += [(order, profile * (component == body)) for body in range(BODIES)]
    for shape in task.shapes:
        profiles.append((shape.order, shape.at(points, normals) * (component == shape.component)))
    return profiles


def shapes_of(modes: Sequence) -> tuple[Shape, ...]:
    """Shapes on the skin of flexural modes (`elastic.modes.RingMode`)."""
    return tuple(
        Shape(
            int(mode.body), int(mode.order), np.asarray(mode.skin_points), np.asarray(mode.skin_shape)[:, :2]
        )
        for mode in modes
    )
