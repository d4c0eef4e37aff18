"""Rings with their grooves on their partners by elements: quadratic, axisymmetric, without friction.

The ring's mesh and the matrices of both solids are those of its modes (`fmu_bearing.elastic`), for order 0.
The partner is meshed at the ring's own stations, so that nodes meet, and goes on to both sides of it.
"""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from scipy.sparse import bmat, csc_matrix
from scipy.sparse.linalg import spsolve
from skfem import Basis, ElementQuad2, MeshQuad, MeshQuad2

from fmu_bearing.elastic import fourier
from fmu_bearing.elastic.section import Grid, grid
from tests.formulas.seats import RPM, Load, Seat, material

REACH = 1.5  # seat radii of the partner beyond the ring, on each side
SHARP = 0.1  # width of the ring at each face whose hoop stress is left out: sharp corners press more there


class Body:
    """Elements of one solid: free unknowns are x and r of its nodes, forces are those per radian."""

    def __init__(self, made, solid):
        self.elastic = fourier.Elastic(solid.youngs_modulus, solid.poisson_ratio, solid.density)
        self.grid, self.solid = made, fourier.solid(made, self.elastic)
        moving = self.solid.nodes[..., :2]  # without torsion
        fixed = [moving[made.columns, made.seat_row, 0]]  # nothing else holds it along the axis
        if np.any(self.solid.points[:, 0, 1] == 0.0):
            fixed.extend(moving[:, 0, 1])
        self.free = np.setdiff1d(moving, fixed)
        self.stiffness = self.solid.k0[self.free][:, self.free]
        radius = np.zeros(self.solid.mass.shape[0])
        radius[self.solid.nodes[..., 1]] = self.solid.points[..., 1]
        self.spin = (self.solid.mass @ radius)[self.free]  # N per radian and speed^2: rho r^2 by the shapes

    def at(self, columns, row, found):
        """Radial displacement (m) at nodes."""
        return found[np.searchsorted(self.free, self.solid.nodes[columns, row, 1])]

    def seat(self, columns):
        """Which unknowns the seat's radial displacements are, as a matrix."""
        places = np.searchsorted(self.free, self.solid.nodes[columns, self.grid.seat_row, 1])
        rows = np.arange(len(places))
        return csc_matrix((np.ones(len(places)), (rows, places)), shape=(len(places), len(self.free)))

    def hoop(self, found, row):
        """Place (m) and hoop stress (Pa) along a surface, at the middle of each of its elements.

        Extrapolated from the two points across an element where quadratic ones have accurate stresses.
        """
        values = np.zeros(self.solid.mass.shape[0])
        values[self.free] = found
        mesh = self.grid.reference
        rows = np.rint(mesh.p[1, mesh.t[:4]].min(axis=0))
        edge = np.flatnonzero(rows == min(row // 2, self.grid.rows - 1))
        near, far = 0.5 + np.array([1.0, -1.0]) * (-0.5 if row == 0 else 0.5) / math.sqrt(3.0)
        points = np.array([[near, far], [0.5, 0.5]])  # an element's first coordinate runs along r
        basis = Basis(self.grid.mesh, ElementQuad2(), elements=edge, quadrature=(points, np.ones(2)))
        axial, radial = basis.interpolate(values[0::3]), basis.interpolate(values[1::3])
        x, r = np.asarray(basis.global_coordinates())
        around = np.asarray(radial) / r
        trace = axial.grad[0] + radial.grad[1] + around
        stress = self.elastic.lame * trace + 2.0 * self.elastic.shear_modulus * around
        return x[:, 0], stress[:, 0] + 0.5 * (math.sqrt(3.0) - 1.0) * (stress[:, 0] - stress[:, 1])


def partner_grid(stations, seat, other, reach):
    """Mesh of a partner, and how many stations it has before the ring's.

    Elements beyond the ring grow by a fifth each from the size of the ring's last one.
    """
    first = stations[-1] - stations[-3]
    count = math.ceil(math.log1p(0.2 * reach / first) / math.log(1.2))
    edges = np.concatenate(([0.0], np.cumsum(1.2 ** np.arange(count))))
    edges *= reach / max(edges[-1], 1.0)
    beyond = np.sort(np.concatenate((edges[1:], 0.5 * (edges[1:] + edges[:-1]))))
    x = np.concatenate((stations[0] - beyond[::-1], stations, stations[-1] + beyond))
    columns, rows = (len(x) - 1) // 2, max(6, math.ceil(abs(seat - other) / first))
    squares = MeshQuad.init_tensor(np.arange(columns + 1.0), np.arange(rows + 1.0))
    reference = MeshQuad2.from_mesh(squares)
    half = np.rint(2.0 * reference.doflocs).astype(int)
    low, high = sorted((seat, other))
    mesh = MeshQuad2(np.vstack((x[half[0]], low + half[1] / (2.0 * rows) * (high - low))), reference.t)
    far_row, seat_row = (0, 2 * rows) if seat > other else (2 * rows, 0)
    return Grid(mesh, reference, columns, rows, columns, far_row, seat_row), len(beyond)


@dataclass(frozen=True)
class Answer:
    """State by elements: mean pressure and largest hoop stress (Pa), motion of the race (m)."""

    pressure: float
    hoop: float
    race: float


class Pair:
    """A ring and its partner; without its groove the ring is a rectangle to the effective diameter."""

    def __init__(self, seat: Seat, fineness: int, reach: float, grooved: bool):
        section = seat.section() if grooved else seat.rectangle()
        made = grid(section, fineness)
        self.seat, self.inner, (self.radius, *_, self.width) = seat, seat.kind == "inner", seat.dimensions
        self.ring = Body(made, material(seat.ring))
        stations = self.ring.solid.points[:, made.seat_row, 0]
        other = 0.5e-3 * seat.partner_mm
        meshed, before = partner_grid(stations, self.radius, other, reach * self.radius)
        self.partner = Body(meshed, material(seat.partner))
        self.columns = slice(before, before + len(stations))

    @property
    def spin(self):
        """Interference per square of the speed (m s2): mean growth of the free seats."""
        grown = [
            np.average(body.at(columns, body.grid.seat_row, spsolve(body.stiffness, body.spin)), weights=w)
            for body, columns, w in self._seats()
        ]
        return grown[1] - grown[0]

    def _seats(self):
        x = self.ring.solid.points[:, self.ring.grid.seat_row, 0]
        weights = np.zeros(len(x))  # by Simpson's rule
        for share, place in ((1.0, slice(0, -2, 2)), (4.0, slice(1, -1, 2)), (1.0, slice(2, None, 2))):
            weights[place] += share * (x[2::2] - x[:-2:2])
        return (self.ring, slice(None), weights), (self.partner, self.columns, weights)

    def at(self, interference, speed):
        """State for an interference (m on radius) without rotation; where it is below 0, the ring alone."""
        square = speed**2 if self.inner else 0.0
        ring, partner = self.ring, self.partner
        if interference <= 0.0:
            return self._answer(spsolve(ring.stiffness, square * ring.spin), 0.0)
        ties = ring.seat(slice(None)), partner.seat(self.columns)
        count = ties[0].shape[0]
        gap = np.full(count, interference if self.inner else -interference)
        matrix = bmat(
            [
                [ring.stiffness, None, ties[0].T],
                [None, partner.stiffness, -ties[1].T],
                [ties[0], -ties[1], None],
            ],
            format="csc",
        )
        right = np.concatenate((square * ring.spin, square * partner.spin, gap))
        found = spsolve(matrix, right)
        forces = found[-count:] * (-1.0 if self.inner else 1.0)
        assert forces.min() > 0.0  # pressed everywhere: the tied seat is the true one
        return self._answer(found[: len(ring.free)], forces.sum() / (self.radius * self.width))

    def _answer(self, ring, pressure):
        made = self.ring.grid
        x, hoop = self.ring.hoop(ring, made.seat_row if self.inner else made.race_row)
        kept = np.abs(hoop[np.abs(x) < (0.5 - SHARP) * self.width])
        race = self.ring.at(made.contact, made.race_row, ring)
        return Answer(pressure, math.copysign(kept.max(), hoop[0]), float(race))


@lru_cache(maxsize=16)
def pair(seat: Seat, fineness: int = 12, reach: float = REACH, grooved: bool = True) -> Pair:
    """Elements of a seat."""
    return Pair(seat, fineness, reach, grooved)


def state(made: Pair, load: Load) -> Answer:
    """State under a load; growth by warmth is uniform in each body and only changes the interference."""
    seat = made.seat.fit()
    speed = load.rpm * RPM
    still = load.of(seat).interference - seat.spin * speed**2
    return made.at(still, speed)
