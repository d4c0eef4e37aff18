"""Surface pressures of a scene's bodies over frequency, kept on disk, and what they sound like anywhere.

Drives, in this order: accelerations along x, then radially, then angular ones about a transverse axis, each
of inner ring, outer ring and cage; flexural shapes; then, per circumferential order, the balls' accelerations
along x, r and theta.
"""

import hashlib
import itertools
import os
import pathlib
import sys
from collections.abc import Callable, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from rich.console import Console
from rich.progress import Progress
from threadpoolctl import threadpool_limits

from fmu_bearing.acoustics.radiation.bem.meridian import Body, Mesh
from fmu_bearing.acoustics.radiation.bem.solver import (
    ROUGHNESS_FACTOR,
    Scatterer,
    orbit_dipoles,
    wall_admittance,
)
from fmu_bearing.engine.sources import digest
from fmu_bearing.files import cache_root, read_arrays

Complex = NDArray[np.complex128]

BODIES = 3  # inner ring, outer ring, cage
AXIAL, RADIAL, TILT = 0, BODIES, 2 * BODIES  # first drive of each kind
_COARSEST = 10_000.0  # Hz: meshes reach that far at least, whatever their band
_PER_WAVELENGTH = 6.0  # elements, two unknowns each
_GAP_ELEMENTS = 0.4  # longest element in a gap over the thickness of the thinnest ring


#: Frequencies (Hz) solved in any case, one band per mesh: low frequencies need fewer elements. Between them,
#: intervals are halved where interpolation fails.
BASE_FREQUENCIES = (
    (20.0, 50.0, 100.0, 200.0, 350.0, 500.0, 750.0, *np.arange(1000.0, 6001.0, 1000.0)),
    tuple(np.arange(6000.0, 22_001.0, 1000.0)),
)
# Largest error of the cubic at the middle of an interval. The middle is then added, which makes the error of
# what is used about sixteen times smaller: -50 dB.
_INTERPOLATION = 5e-2
_NARROWEST = 16.0  # Hz: intervals are not halved below


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
    in that wall.
    """

    bodies: tuple[Body, ...]
    sound_speed: float
    density: float
    orbit: float
    harmonics: int
    shapes: tuple[Shape, ...] = ()
    plane: float | None = None
    baffled: bool = False

    def key(self) -> str:
        """Hash of all numbers and of the sources that solve them."""
        found = hashlib.sha256(digest(pathlib.Path(__file__).parent))
        numbers = [self.sound_speed, self.density, self.orbit, self.harmonics, self.baffled]
        found.update(repr((numbers, self.plane)).encode())
        for body in self.bodies:
            found.update(body.contour.tobytes() + repr(body.sides).encode())
        for shape in self.shapes:
            found.update(repr((shape.component, shape.order)).encode())
            found.update(shape.points.tobytes() + shape.shape.tobytes())
        return found.hexdigest()[:24]

    @property
    def orders(self) -> int:
        """Number of circumferential orders, 0 included."""
        highest = max([1, self.harmonics if self.orbit > 0.0 else 0] + [shape.order for shape in self.shapes])
        return highest + 1

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
    found = []
    for order, profile in ((0, normals[:, 0]), (1, normals[:, 1]), (1, lever)):
        found += [(order, profile * (component == body)) for body in range(BODIES)]
    for shape in task.shapes:
        found.append((shape.order, shape.at(points, normals) * (component == shape.component)))
    return found


class Band:
    """Surface pressures of a task over one band of frequencies, on one mesh, and fields computed from them.

    Attributes
    ----------
    frequencies : ndarray, shape (n,)
        Hz, rising.
    surface : ndarray, shape (n, drives, nodes)
        Pressures (Pa per unit of each drive) at `points`.
    """

    def __init__(self, task: Task, base: Sequence[float]) -> None:
        self.task = task
        self._scatterer = task.scatterer(max(base[-1], _COARSEST))
        self._drives = drives(task, self._scatterer.mesh)
        self._balls = task.harmonics + 1 if task.orbit > 0.0 else 0
        self.frequencies = np.array(base)
        self.surface = np.zeros((len(self.frequencies), self.count, self._scatterer.mesh.size), dtype=complex)

    @property
    def count(self) -> int:
        """Number of drives."""
        return len(self._drives) + 3 * self._balls

    def ball_drive(self, order: int, axis: int) -> int:
        """Place of the balls' drive of a circumferential order along x (0), r (1) or theta (2)."""
        return len(self._drives) + 3 * order + axis

    @property
    def points(self) -> NDArray[np.float64]:
        """Collocation points (x, r) in m, shape (nodes, 2)."""
        return self._scatterer.mesh.points

    def solve(self, frequency: float) -> Complex:
        """Surface pressures at a frequency (Hz), shape (drives, nodes)."""
        k = self._wavenumber(frequency)
        mesh = self._scatterer.mesh
        found = np.zeros((self.count, mesh.size), dtype=complex)
        system = self._scatterer.at(k, self._losses(k))
        cage_away = mesh.node_component() != BODIES - 1
        everything = np.concatenate([mesh.points, self._scatterer.inside])
        incoming = self._incoming(everything, k)
        none = np.zeros((mesh.size, 0))
        for order in range(self.task.orders):
            of_order = [i for i, (m, _) in enumerate(self._drives) if m == order]
            if of_order:
                driven = self.task.density * np.stack([self._drives[i][1] for i in of_order], axis=1)
                found[of_order] = system.pressure(order, driven).T
            if order < self._balls:
                # the balls sit in the cage's pockets: their sound does not pass through its solid parts
                places = [self.ball_drive(order, axis) for axis in range(3)]
                found[places] = system.pressure(order, none, incoming[:, order].T, keep=cage_away).T
        return found

    def field(self, points: NDArray[np.float64]) -> Complex:
        """Pressures (Pa per unit of each drive) at points (x, r), shape (points, drives, frequencies)."""
        potentials = self._scatterer.field_potentials(points)
        result = np.zeros((len(points), self.count, len(self.frequencies)), dtype=complex)
        for f, frequency in enumerate(self.frequencies):
            k = self._wavenumber(frequency)
            single, double = potentials(k)
            if not self.task.baffled:
                double = double - 1j * k * self._losses(k) * single
            for i, (order, shape) in enumerate(self._drives):
                own = self.task.density * (single[order] @ shape)
                result[:, i, f] = own + double[order] @ self.surface[f, i]
            direct = self._incoming(points, k)
            for order in range(self._balls):
                for axis in range(3):
                    i = self.ball_drive(order, axis)
                    result[:, i, f] = direct[axis, order] + double[order] @ self.surface[f, i]
        return result

    def refine(self, solved: Callable[[int], None] = lambda left: None) -> None:
        """Solve the base frequencies, then halve intervals until the cubic through neighbours fits.

        ``solved`` is called after each frequency with the number still known to be open. Frequencies are
        shared among the machine's cores; the result does not depend on how many there are.
        """
        with threadpool_limits(1), ThreadPoolExecutor() as pool:
            for f, found in enumerate(pool.map(self.solve, self.frequencies)):
                self.surface[f] = found
                solved(2 * len(self.frequencies) - f)
            ends = self.frequencies.tolist()
            open_ = list(itertools.pairwise(ends))
            while open_:
                middles = [0.5 * (low + high) for low, high in open_]
                halved = []
                surfaces = []
                for k, found in enumerate(pool.map(self.solve, middles)):
                    low, high = open_[k]
                    if high - low > 2.0 * _NARROWEST and self._missed(middles[k], found) > _INTERPOLATION:
                        halved += [(low, middles[k]), (middles[k], high)]
                    surfaces.append(found)
                    solved(len(open_) - k + len(halved))
                order = np.argsort(np.concatenate([self.frequencies, middles]))
                self.frequencies = np.concatenate([self.frequencies, middles])[order]
                self.surface = np.concatenate([self.surface, surfaces])[order]
                open_ = halved

    def _missed(self, frequency: float, found: Complex) -> float:
        """Largest error of the cubic through the four nearest frequencies, over each drive's own size."""
        place = int(np.searchsorted(self.frequencies, frequency))
        first = min(max(place - 2, 0), len(self.frequencies) - 4)
        near = slice(first, first + 4)
        f = self.frequencies[near]
        weights = [np.prod([(frequency - b) / (a - b) for b in f if b != a]) for a in f]
        wrong = np.linalg.norm(found - np.tensordot(weights, self.surface[near], axes=1), axis=1)
        size = np.linalg.norm(found, axis=1)
        return float(np.max(wrong / np.maximum(size, 1e-300)))

    def _incoming(self, points: NDArray[np.float64], k: float) -> Complex:
        """Sound of the balls in free space, shape (3, harmonics + 1, points)."""
        task = self.task
        if self._balls == 0:
            return np.zeros((3, 0, len(points)), dtype=complex)
        return task.density * orbit_dipoles(points, k, task.orbit, self._balls, task.plane)

    def _losses(self, k: float) -> complex:
        """Admittance of the skins."""
        return ROUGHNESS_FACTOR * wall_admittance(k, self.task.sound_speed)

    def _wavenumber(self, frequency: float) -> float:
        return 2.0 * np.pi * float(frequency) / self.task.sound_speed


class Solution:
    """A task solved in all bands, and the fields anywhere in the air."""

    def __init__(self, task: Task) -> None:
        self.task = task
        self.bands = [Band(task, base) for base in BASE_FREQUENCIES]

    @property
    def frequencies(self) -> NDArray[np.float64]:
        """Hz, rising, shape (n,)."""
        return np.concatenate([band.frequencies[i > 0 :] for i, band in enumerate(self.bands)])

    @property
    def points(self) -> NDArray[np.float64]:
        """Points (x, r) on the skins in m, shape (nodes, 2)."""
        return self.bands[-1].points

    def ball_drive(self, order: int, axis: int) -> int:
        """Place of the balls' drive of a circumferential order along x (0), r (1) or theta (2)."""
        return self.bands[0].ball_drive(order, axis)

    def field(self, points: NDArray[np.float64]) -> Complex:
        """Pressures (Pa per unit of each drive) at points (x, r), shape (points, drives, frequencies)."""
        # the first frequency of a band is the last of the one below, which has the coarser mesh
        parts = [band.field(points)[:, :, i > 0 :] for i, band in enumerate(self.bands)]
        return np.concatenate(parts, axis=2)


@lru_cache(maxsize=4)
def _remembered(key: str) -> list[Solution]:
    return []


def solution(task: Task) -> Solution:
    """Solution of a task: from memory, from disk, or solved now with a progress bar on a terminal.

    Solutions are kept beside the compiled kernels, in the folder ``sound`` (`files.cache_root`).
    """
    key = task.key()
    known = _remembered(key)
    if known:
        return known[0]
    found = Solution(task)
    if not task.baffled:  # faces in a rigid wall do not hear each other: nothing to solve
        path = cache_root() / "sound" / f"{key}.npz"
        if not _load(path, found):
            _solve_all(found)
            _save(path, found)
    known.append(found)
    return found


def _solve_all(found: Solution) -> None:
    console = Console(file=sys.stderr)
    with Progress(console=console, transient=True, disable=not console.is_terminal) as progress:
        for i, band in enumerate(found.bands):
            words = f"radiation of the bodies, band {i + 1} of {len(found.bands)}"
            bar = progress.add_task(words, total=None)

            def moved(left: int, bar=bar) -> None:
                done = progress.tasks[bar].completed + 1
                progress.update(bar, completed=done, total=done + left)

            band.refine(moved)


def _load(path: pathlib.Path, found: Solution) -> bool:
    try:
        kept = read_arrays(path)
        tables = [(kept[f"frequencies{i}"], kept[f"surface{i}"]) for i in range(len(found.bands))]
    except (OSError, ValueError, KeyError):
        return False  # absent or damaged: solve again
    for band, (frequencies, surface) in zip(found.bands, tables, strict=True):
        if surface.shape != (len(frequencies), *band.surface.shape[1:]) or not np.isfinite(surface).all():
            return False
        band.frequencies, band.surface = frequencies, surface
    return True


def _save(path: pathlib.Path, found: Solution) -> None:
    """Keep a solution; a cache that cannot be written is no reason to fail."""
    tables: dict[str, Any] = {f"frequencies{i}": band.frequencies for i, band in enumerate(found.bands)}
    tables |= {f"surface{i}": band.surface for i, band in enumerate(found.bands)}
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        partial = path.with_suffix(f".{os.getpid()}.npz")
        np.savez(partial, **tables)
        partial.replace(path)
    except OSError:
        pass


def shapes_of(modes: Sequence) -> tuple[Shape, ...]:
    """Shapes on the skin of flexural modes (`elastic.modes.RingMode`)."""
    return tuple(
        Shape(
            int(mode.body), int(mode.order), np.asarray(mode.skin_points), np.asarray(mode.skin_shape)[:, :2]
        )
        for mode in modes
    )
