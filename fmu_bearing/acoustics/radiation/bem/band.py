"""Surface pressures over one band of frequencies, on one mesh, and the fields around the bodies."""

import itertools
import time
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Executor

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import CubicSpline

from fmu_bearing.acoustics.radiation.bem import rational
from fmu_bearing.acoustics.radiation.bem.solver import ROUGHNESS_FACTOR, orbit_dipoles, wall_admittance
from fmu_bearing.acoustics.radiation.bem.task import BODIES, Task, drives

Real = NDArray[np.float64]
Complex = NDArray[np.complex128]

_COARSEST = 10_000.0  # Hz: meshes reach that far at least, whatever their band
# Where rational functions fail: largest error of the cubic at the middle of an interval. The middle is then
# added, which makes the error of what is used about sixteen times smaller: -50 dB.
_INTERPOLATION = 5e-2
_NARROWEST = 16.0  # Hz: intervals are not halved below
#: Points around the bodies whose pressures say which frequencies to solve: distances over the radius of a
#: sphere round all bodies, and angles (rad) from the axis.
_SPHERES = (1.2, 4.0)
_ANGLES = (0.3, 0.9, 1.6, 2.2, 2.8)
#: Frequencies that a band takes: some, and more for each wavelength that a sphere round the bodies gains from
#: the band's begin to its end. Measured: 14 and 18 (bare 7003C), 14 and 26 (7009C), 20 and 43 (in a housing).
_FEWEST, _PER_WAVE = 12.0, 3.5
_HALVED = 3.0  # times as many where intervals are halved: 226 for 68, 177 for 67
#: Frequencies left, at least: a share of those done, as a search that lasts goes on lasting. Where the last
#: predictions were right, which may be luck, `_LUCK` at least, and the geometric mean of that and of what the
#: bodies' size lets expect. Chosen on d 60 x 60, 100 x 160, 300 x 60, 80 x 400 mm, and 150 x 300 mm without
#: a cage.
_LASTING, _LUCK = 0.2, 5.0
#: The time of one frequency grows by this power of the number of nodes, and by so many nodes for each inner
#: point: within 15 % from 258 to 628 nodes, within 30 % to 770.
_GROWTH, _INNER = 2.6, 1.5
_ROUNDING = 1e-6  # of the loudest drive at a point: what is weaker there may be rounding
#: Frequencies beyond which a band's intervals are halved.
MOST = 80


class Band:
    """Surface pressures of a task over one band of frequencies, on one mesh, and fields computed from them.

    Attributes
    ----------
    frequencies : ndarray, shape (n,)
        Hz, rising.
    surface : ndarray, shape (n, drives, nodes)
        Pressures (Pa per unit of each drive, in air of 1 kg/m3) at `points`.
    probed : ndarray, shape (n, drives, spheres, points)
        Pressures around the bodies, which rational functions of frequency are fitted to; empty: cubics.
    done, left, expected : float
        Frequencies solved, how many more are probably needed, and how many in all before any was solved.
    cost : float
        Time of one frequency, in proportion to that of other bands of the task.
    seconds : list of float
        Time of each frequency solved in a search, s.
    """

    def __init__(self, task: Task, base: Sequence[float]) -> None:
        self.task = task
        self._scatterer = task.scatterer(max(base[-1], _COARSEST))
        self._drives = drives(task, self._scatterer.mesh)
        self._balls = task.harmonics + 1 if task.orbit > 0.0 else 0
        self.groups = self._groups()
        self.frequencies = np.array(base)
        self.surface = np.zeros((len(self.frequencies), self.count, self._scatterer.mesh.size), dtype=complex)
        self.probed = self._unprobed()
        self.done = 0
        self.expect(_FEWEST + _PER_WAVE * task.waves(base[0], base[-1]))
        self.seconds: list[float] = []
        nodes, inner = self._scatterer.mesh.size, len(self._scatterer.inside)
        self.cost = float(nodes) ** _GROWTH * (1.0 + _INNER * inner / nodes)

    def expect(self, frequencies: float) -> None:
        """Take a number of frequencies that a search will probably need."""
        self.expected = self.left = frequencies

    @property
    def count(self) -> int:
        """Number of drives."""
        return len(self._drives) + 3 * self._balls

    def ball_drive(self, order: int, axis: int) -> int:
        """Place of the balls' drive of a circumferential order along x (0), r (1) or theta (2)."""
        return len(self._drives) + 3 * order + axis

    @property
    def points(self) -> Real:
        """Collocation points (x, r) in m, shape (nodes, 2)."""
        return self._scatterer.mesh.points

    def _groups(self) -> list[list[int]]:
        """Drives whose pressures have the same poles: of one order, with or without the solid cage."""
        groups = []
        for order in range(self.task.orders):
            bodies = [i for i, (m, shape) in enumerate(self._drives) if m == order and shape.any()]
            # balls do not radiate along theta in order 0
            balls = [self.ball_drive(order, axis) for axis in range(3 if order else 2)]
            groups += [bodies] if bodies else []
            groups += [balls] if order < self._balls else []
        return groups

    def solve(self, frequency: float) -> Complex:
        """Surface pressures at a frequency (Hz), shape (drives, nodes)."""
        k = self._wavenumber(frequency)
        mesh = self._scatterer.mesh
        pressures = np.zeros((self.count, mesh.size), dtype=complex)
        system = self._scatterer.at(k, self._losses(k))
        cage_away = mesh.node_component() != BODIES - 1
        everything = np.concatenate([mesh.points, self._scatterer.inside])
        incoming = self._incoming(everything, k)
        for order in range(self.task.orders):
            of_order = [i for i, (m, _) in enumerate(self._drives) if m == order]
            driven = np.zeros((mesh.size, len(of_order)))
            for column, i in enumerate(of_order):
                driven[:, column] = self._drives[i][1]
            coming = None
            if order < self._balls:
                # the balls sit in the cage's pockets: their sound does not pass through its solid parts
                coming = incoming[:, order].T
                of_order += [self.ball_drive(order, axis) for axis in range(3)]
            if of_order:
                pressures[of_order] = system.pressure(order, driven, coming, keep=cage_away).T
        return pressures

    def _timed(self, frequency: float) -> Complex:
        """Solve, and keep how long it took."""
        begun = time.perf_counter()
        pressures = self.solve(frequency)
        self.seconds.append(time.perf_counter() - begun)
        return pressures

    def field(self, points: Real) -> Complex:
        """Pressures (Pa per unit of each drive, in air of 1 kg/m3) at points (x, r) and `frequencies`.

        Shape (points, drives, frequencies).
        """
        sounding = self._sounding(points)
        return np.stack([sounding(*each) for each in zip(self.frequencies, self.surface, strict=True)], -1)

    def _sounding(self, points: Real) -> Callable[[float, Complex], Complex]:
        """Return what gives pressures (points, drives) at a frequency (Hz) from the surface's."""
        potentials = self._scatterer.field_potentials(points)

        def at(frequency: float, surface: Complex) -> Complex:
            k = self._wavenumber(frequency)
            single, double = potentials(k)
            if not self.task.baffled:
                double = double - 1j * k * self._losses(k) * single
            found = np.zeros((len(points), self.count), dtype=complex)
            for i, (order, shape) in enumerate(self._drives):
                found[:, i] = single[order] @ shape + double[order] @ surface[i]
            direct = self._incoming(points, k)
            for order in range(self._balls):
                for axis in range(3):
                    i = self.ball_drive(order, axis)
                    found[:, i] = direct[axis, order] + double[order] @ surface[i]
            return found

        return at

    def flights(self, points: Real) -> Real:
        """Return the times (s) that sound takes to points from the nearest part of the bodies."""
        offset = points[:, None, :] - self.points
        return np.hypot(offset[:, :, 0], offset[:, :, 1]).min(axis=1) / self.task.sound_speed

    def transfer(self, points: Real, wanted: Real) -> Complex:
        """Pressures at points, as `field`, at any frequencies (Hz) of the band, from those solved."""
        flights = self.flights(points)[:, None, None]
        still = self.field(points) * np.exp(2j * np.pi * self.frequencies * flights)
        if len(self.probed):
            pressures = np.stack([self._between(one, wanted) for one in still])
        else:
            pressures = CubicSpline(self.frequencies, still, axis=2)(wanted)
        return pressures * np.exp(-2j * np.pi * wanted * flights)

    def _between(self, still: Complex, wanted: Real) -> Complex:
        """Pressures (drives, wanted) of one point between those solved, by rational functions.

        Their poles follow from the pressures around the bodies and at the point itself.
        """
        pressures = np.zeros((len(still), len(wanted)), dtype=complex)
        point = np.repeat(still.T[:, :, None, None], self.probed.shape[3], axis=3)
        values = np.concatenate([self.probed, point], axis=2)
        groups = [rational.Group() for _ in self.groups]
        share = np.array([rational.SILENT] * len(_SPHERES) + [_ROUNDING])
        rational.renew(
            groups, self.frequencies, [values[:, own] for own in self.groups], self._family(), share
        )
        for group, members in zip(groups, self.groups, strict=True):
            group.sharp(self.frequencies[0], self.frequencies[-1])
            pressures[members] = group.predicted(wanted)[:, :, -1, 0].T
        return pressures

    def _family(self) -> list[int]:
        """Harmonics of the balls are equally strong; of the bodies, the drives of one order move together."""
        return [-1 if group[0] >= len(self._drives) else i for i, group in enumerate(self.groups)]

    def _unprobed(self) -> Complex:
        return np.zeros((0, self.count, len(_SPHERES), 1), dtype=complex)

    def search(self, pool: Executor, solved: Callable[[], None] = lambda: None) -> None:
        """Solve where rational functions of frequency are uncertain; halve intervals where they fail.

        ``solved`` is called after each frequency.
        """
        base = self.frequencies
        self._scatterer.prepare()
        known: dict[float, Complex] = {}
        probed: dict[float, Complex] = {}
        points = self._probes()
        sounding, flights = self._sounding(points), self.flights(points)

        def measure(frequencies: Real) -> list[Complex]:
            received = []
            for frequency, surface in zip(frequencies, pool.map(self._timed, frequencies), strict=True):
                known[frequency] = surface
                still = sounding(frequency, surface) * np.exp(2j * np.pi * frequency * flights)[:, None]
                received.append(still.T)
                self._count(solved)
            parts = np.array(received).reshape(len(received), self.count, len(_SPHERES), -1)
            probed.update(zip(frequencies, parts, strict=True))
            return [parts[:, group] for group in self.groups]

        def expect(least: float, certain: bool) -> None:
            usual = max(least, self.expected - self.done, _LASTING * self.done)
            lucky = least < _LUCK
            self.left = least if certain else (_LUCK * usual) ** 0.5 if lucky else usual

        found = rational.search(measure, base[0], base[-1], MOST, self._family(), expect)
        if found is None:
            self.halve(pool, solved, known)
        else:
            self.frequencies = found
            self.surface = np.array([known[f] for f in found])
            self.probed = np.array([probed[f] for f in found])
        self._scatterer.release()
        self.left = 0.0
        solved()

    def _count(self, solved: Callable[[], None], left: float | None = None) -> None:
        """Count a frequency; ``left``: by default one less than before, but one at least."""
        self.done, self.left = self.done + 1, max(self.left - 1.0, 1.0) if left is None else left
        solved()

    def _probes(self) -> Real:
        """Points (x, r) around the bodies, sphere by sphere, on their side of a wall."""
        middle, size = self.task.sphere()
        radii, angles = np.repeat(size * np.array(_SPHERES), len(_ANGLES)), np.tile(_ANGLES, len(_SPHERES))
        points = np.stack([middle + radii * np.cos(angles), radii * np.sin(angles)], axis=1)
        if self.task.plane is not None:
            front = (points[:, 0] - self.task.plane) * (middle - self.task.plane) > 0.0
            # as many of each sphere: angles whose points are all before the wall
            points = points[np.tile(front.reshape(-1, len(_ANGLES)).all(axis=0), len(_SPHERES))]
        return points

    def halve(self, pool: Executor, solved: Callable[[], None], known: Mapping[float, Complex]) -> None:
        """Solve the base frequencies, then halve intervals until the cubic through neighbours fits.

        ``known``: surface pressures solved before, by frequency (Hz).
        """
        expected = _HALVED * self.expected
        there = {f: known[f] for f in self.frequencies if f in known}
        missing = [f for f in self.frequencies if f not in known]
        for f, pressures in zip(missing, pool.map(self._timed, missing), strict=True):
            there[f] = pressures
            self._count(solved, expected - len(known))
        for f, pressures in known.items():  # close neighbours would spoil the cubic
            if min(abs(f - other) for other in there) > 2.0 * _NARROWEST:
                there[f] = pressures
        self.frequencies = np.array(sorted(there))
        self.surface = np.array([there[f] for f in self.frequencies])
        open_ = list(itertools.pairwise(self.frequencies.tolist()))
        while open_:
            middles = [0.5 * (low + high) for low, high in open_]
            halved = []
            surfaces = []
            for k, pressures in enumerate(pool.map(self._timed, middles)):
                low, high = open_[k]
                if high - low > 2.0 * _NARROWEST and self._missed(middles[k], pressures) > _INTERPOLATION:
                    halved += [(low, middles[k]), (middles[k], high)]
                surfaces.append(pressures)
                rest = len(open_) - k - 1.0 + len(halved)
                self._count(solved, max(rest, expected - len(self.frequencies) - k))
            order = np.argsort(np.concatenate([self.frequencies, middles]))
            self.frequencies = np.concatenate([self.frequencies, middles])[order]
            self.surface = np.concatenate([self.surface, surfaces])[order]
            open_ = halved
        self.probed = self._unprobed()

    def _missed(self, frequency: float, pressures: Complex) -> float:
        """Largest error of the cubic through the four nearest frequencies, over each drive's own size."""
        place = int(np.searchsorted(self.frequencies, frequency))
        first = min(max(place - 2, 0), len(self.frequencies) - 4)
        near = slice(first, first + 4)
        f = self.frequencies[near]
        weights = [np.prod([(frequency - b) / (a - b) for b in f if b != a]) for a in f]
        wrong = np.linalg.norm(pressures - np.tensordot(weights, self.surface[near], axes=1), axis=1)
        size = np.linalg.norm(pressures, axis=1)
        return float(np.max(wrong / np.maximum(size, 1e-300)))

    def _incoming(self, points: Real, k: float) -> Complex:
        """Sound of the balls in free space, shape (3, harmonics + 1, points)."""
        if self._balls == 0:
            return np.zeros((3, 0, len(points)), dtype=complex)
        return orbit_dipoles(points, k, self.task.orbit, self._balls, self.task.plane)

    def _losses(self, k: float) -> complex:
        """Admittance of the skins."""
        return ROUGHNESS_FACTOR * wall_admittance(k, self.task.sound_speed)

    def _wavenumber(self, frequency: float) -> float:
        return 2.0 * np.pi * float(frequency) / self.task.sound_speed
