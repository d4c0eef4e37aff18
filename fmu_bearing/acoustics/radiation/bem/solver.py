"""Exterior Helmholtz problem of rigid and flexing bodies of revolution, one circumferential order at a time.

Time factor e^{+j omega t}, normals out of the bodies, accelerations a_n along them. Kirchhoff-Helmholtz:

    c p = integral of p dG/dn + rho a_n G over the surface, plus what comes in,  G = exp(-jkR) / (4 pi R)

with c = 1 in the air, 1/2 on the surface and 0 inside a body. Points inside closed bodies are added as
further equations, so that the resonances of the bodies' inside do not spoil the solution (CHIEF, Schenck
1968). Collocation with discontinuous linear elements.

Walls may take in a little air: `wall_admittance` represents the losses to viscosity and heat conduction in
a thin layer on them. They matter in narrow gaps only, whose resonances would otherwise ring for ever.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.radiation.bem.integrals import Potentials
from fmu_bearing.acoustics.radiation.bem.meridian import NODES, Body, mesh_of

Complex = NDArray[np.complex128]

_RING_ANGLES = 256  # round an orbit, for fields of ring sources: exact to exp(-256 gap / radius)
_DEPTH = 0.12  # of a body's smaller extent: inner points keep this far from the skin
#: Inner points: one for each resonance, between these numbers, and no fewer than this share of resonances.
#: Where they are too few, sound of weak drives has narrow dips and peaks, which take frequencies to follow:
#: from 14 kHz on d 150 x 300 mm without a cage takes 70 with a share of 0.25, 51 with 0.5, 39 with 1, where
#: each takes longer.
_MOST_POINTS, _LEAST_POINTS, _SHARE = 60, 6, 0.5
_KINEMATIC_VISCOSITY, _PRANDTL, _HEAT_RATIO = 1.51e-5, 0.71, 1.40  # of air at 20 degC; m2/s
# Losses in real gaps over losses of smooth parallel walls: pockets, balls, oil and grooves (assumed).
# Without it the air between a solid cage and the rings would ring with a quality factor of 75.
ROUGHNESS_FACTOR = 3.0
_SAFE = 0.8  # of a ring section's first resonance: below, no inner points are needed


def wall_admittance(k: float, sound_speed: float) -> complex:
    """Admittance (over 1 / (rho c)) of a rigid wall with air at 20 degC on it, for waves that graze it.

    ``k`` in 1/m. beta = (1 + j)/2 k (d_v + (gamma - 1) d_t) with the thicknesses of the viscous and of the
    thermal layer; in a tube it gives Kirchhoff's attenuation. Source: Pierce (1989, section 10-4).
    """
    viscous = np.sqrt(2.0 * _KINEMATIC_VISCOSITY / (k * sound_speed))
    return complex(0.5 * (1.0 + 1.0j) * k * viscous * (1.0 + (_HEAT_RATIO - 1.0) / np.sqrt(_PRANDTL)))


class Scatterer:
    """A set of bodies, meshed, ready to be solved at any frequency up to the one it is made for.

    Parameters
    ----------
    bodies : sequence of Body
        They must not touch.
    highest : float
        Highest wavenumber (1/m).
    orders : int
        Circumferential orders 0 .. orders - 1.
    size : float, optional
        Largest element (m); by default an eighth of the shortest wavelength.
    finest : float, optional
        Largest element (m) where bodies face each other closely; by default ``size``.
    source : float, optional
        Radius (m) of a circle of sources at x = 0, near which elements are small enough for it.
    plane : float, optional
        Axial place (m) of a rigid plane normal to the axis.
    """

    def __init__(
        self,
        bodies: Sequence[Body],
        highest: float,
        orders: int,
        size: float | None = None,
        finest: float | None = None,
        source: float | None = None,
        plane: float | None = None,
    ) -> None:
        self.bodies, self.highest, self.orders, self.plane = tuple(bodies), highest, orders, plane
        orbit = None if source is None else np.array([0.0, source])
        self.mesh = mesh_of(bodies, size or 2.0 * np.pi / highest / 8.0, finest, orbit)
        self.inside = inner_points(bodies, highest)
        self._potentials: Potentials | None = None

    def prepare(self) -> Potentials:
        """Return the potentials on the skins and inside bodies; they are large, and kept until `release`."""
        if self._potentials is None:
            owner = np.repeat(np.arange(len(self.mesh.ends)), NODES)
            owner = np.concatenate([owner, np.full(len(self.inside), -1)])
            points = np.concatenate([self.mesh.points, self.inside])
            self._potentials = Potentials(points, owner, self.mesh, self.orders, self.plane)
        return self._potentials

    def release(self) -> None:
        """Give up what `prepare` keeps."""
        self._potentials = None

    def field_potentials(self, points: NDArray[np.float64]) -> Potentials:
        """Potentials at points (x, r) in the air, shape (n, 2), m."""
        return Potentials(points, np.full(len(points), -1), self.mesh, self.orders, self.plane)

    def at(self, k: float, admittance: complex = 0.0) -> "System":
        """Equations at wavenumber ``k`` (1/m) for walls of an ``admittance`` (over 1 / (rho c)).

        Raises
        ------
        ValueError
            Beyond the wavenumber the mesh is made for.
        """
        if k > self.highest * (1.0 + 1e-9):
            raise ValueError(
                f"a wavenumber of {k:g} 1/m is beyond this mesh, which reaches {self.highest:g} 1/m; "
                "make it for a higher one"
            )
        single, double = self.prepare()(k)
        for one, other in zip(single, double, strict=True):  # order by order: whole arrays are large
            other -= 1j * k * admittance * one
        return System(single, double, self.mesh.size)


class System:
    """The equations of a `Scatterer` at one wavenumber."""

    def __init__(self, single: Complex, double: Complex, size: int) -> None:
        self._single, self._double, self._size = single, double, size

    def pressure(
        self,
        order: int,
        driven: NDArray[np.float64],
        incident: Complex | None = None,
        keep: NDArray[np.bool_] | None = None,
    ) -> Complex:
        """Surface pressures (Pa) of order ``order``, shape (nodes, drives).

        Parameters
        ----------
        driven : ndarray, shape (nodes, n)
            Normal accelerations times the air's density, for n drives.
        incident : ndarray, shape (nodes + inner points, more), optional
            Pressures that come in on resting bodies: further drives, after the others.
        keep : ndarray of bool, shape (nodes,), optional
            Nodes of the bodies that are there for what comes in; the others are taken away for it.
        """
        size, count = self._size, driven.shape[1]
        matrix = -self._double[order]
        matrix[np.arange(size), np.arange(size)] += 0.5
        right = self._single[order] @ driven
        if incident is not None:
            right = np.concatenate([right, incident], axis=1)
        square, given = matrix[:size], right[:size]
        if len(matrix) > size:
            # Equations of inner points, multiplied from the left by their conjugate transpose, are added: the
            # solution fulfils both, and waves of the inside, which the skin's equations let pass, none.
            adjoint = matrix[size:].conj().T
            square += adjoint @ matrix[size:]
            given += adjoint @ right[size:]
        if keep is None or keep.all():
            return np.linalg.solve(square, given)
        # The nodes that stay are solved for once: for what comes in, and for what the others' pressures and
        # the drives do to them. The others follow from what is left of their own equations.
        kept, away = np.flatnonzero(keep), np.flatnonzero(~keep)
        result = np.zeros((size, right.shape[1]), dtype=complex)
        across = square[np.ix_(kept, away if count else away[:0])]
        pressures = np.linalg.solve(square[np.ix_(kept, kept)], np.concatenate([across, given[kept]], axis=1))
        across, pressures = pressures[:, : across.shape[1]], pressures[:, across.shape[1] :]
        if count:
            back = square[np.ix_(away, kept)]
            own = square[np.ix_(away, away)] - back @ across
            result[away, :count] = np.linalg.solve(own, given[away, :count] - back @ pressures[:, :count])
            pressures[:, :count] -= across @ result[away, :count]
        result[kept] = pressures
        return result


def inner_points(bodies: Sequence[Body], highest: float) -> NDArray[np.float64]:
    """Points inside those bodies whose inside resonates below ``highest`` (1/m), shape (n, 2)."""
    points = []
    for body in bodies:
        corners = body.polygon()
        low, high = corners.min(axis=0), corners.max(axis=0)
        extent = high - low
        first = np.pi / float(extent.max()) if not body.closed else float(np.hypot(*(np.pi / extent)))
        if highest < _SAFE * first:
            continue
        modes = float(np.prod(highest * extent / np.pi))
        count = int(np.ceil(max(np.clip(modes, _LEAST_POINTS, _MOST_POINTS), _SHARE * modes)))
        points.append(_spread(body, low, high, count))
    return np.concatenate(points) if points else np.zeros((0, 2))


def _spread(
    body: Body, low: NDArray[np.float64], high: NDArray[np.float64], count: int
) -> NDArray[np.float64]:
    """Evenly spread points (Halton's) inside a body, away from its skin."""
    depth = _DEPTH * float(min(high - low))
    kept: list[NDArray[np.float64]] = []
    for k in range(20):
        candidates = low + halton(4 * count * k, 4 * count) * (high - low)
        there = candidates[(body.distance(candidates) > depth) & body.contains(candidates)]
        kept += list(there[: count - len(kept)])
        if len(kept) == count:
            return np.array(kept)
        depth *= 0.7
    return np.array(kept).reshape(-1, 2)


def halton(first: int, count: int) -> NDArray[np.float64]:
    """Points of the sequence in the unit square from number ``first`` on, shape (count, 2).

    Digits of the number in base 2 and in base 3, mirrored at the point (Halton 1960). SciPy has it among its
    statistics, which take longer to load than these points to use.
    """
    points = np.zeros((count, 2))
    for axis, base in enumerate((2, 3)):
        left, place = np.arange(first, first + count), 1.0 / base
        while left.any():
            points[:, axis] += left % base * place
            left, place = left // base, place / base
    return points


def orbit_dipoles(
    points: NDArray[np.float64], k: float, radius: float, orders: int, plane: float | None = None
) -> Complex:
    """Pressure at meridian points of a point dipole on the circle x = 0, r = ``radius``.

    Shape (3, orders, points): harmonics of the gradient of exp(-jkR) / (4 pi R) with respect to the source's
    place along x, r and theta; the first two belong to cos m(phi - theta), the third to sin m(phi - theta),
    where phi and theta are the angles of field point and source. ``plane``: as in `Scatterer`.
    """
    phi = 2.0 * np.pi * np.arange(_RING_ANGLES) / _RING_ANGLES
    total = np.zeros((3, orders, len(points)), dtype=complex)
    weights = np.full(orders, 2.0 / _RING_ANGLES)
    weights[0] = 1.0 / _RING_ANGLES
    order = np.arange(orders)
    cosines = weights[:, None] * np.cos(order[:, None] * phi)
    sines = weights[:, None] * np.sin(order[:, None] * phi)
    for mirrored in (False, True) if plane is not None else (False,):
        x = 2.0 * plane - points[:, 0] if mirrored and plane is not None else points[:, 0]
        r = points[:, 1]
        to = np.stack(
            [
                np.broadcast_to(x, (len(phi), len(points))),
                np.cos(phi)[:, None] * r - radius,
                np.sin(phi)[:, None] * r,
            ]
        )
        distance = np.sqrt((to**2).sum(axis=0))
        slope = (1.0 + 1j * k * distance) * np.exp(-1j * k * distance) / (4.0 * np.pi * distance**3)
        total[0] += cosines @ (slope * to[0])
        total[1] += cosines @ (slope * to[1])
        total[2] += sines @ (slope * to[2])
    return total
