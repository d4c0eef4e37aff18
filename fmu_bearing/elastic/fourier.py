"""Solid of revolution for one circumferential harmonic: stiffness, mass, gyroscopic form, modes.

With u_x = X cos n theta, u_r = R cos n theta, u_t = T sin n theta all integrals over theta give pi (n > 0),
so that real arithmetic serves (Zienkiewicz and Taylor 2000, vol. 2, chapter 9: semi-analytical finite
elements). For n = 0 the factor would be 2 pi, the same in stiffness and mass; X and R then part from T,
torsion.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_matrix, csc_matrix, kron
from scipy.sparse.linalg import eigsh

from fmu_bearing.elastic.section import Grid
from fmu_bearing.extras import BENDING, need

if TYPE_CHECKING:
    from skfem import Basis

_X, _R, _T = range(3)
_COMPONENTS = 3
#: Eigenvalues are sought from minus this share of (wave speed / mean radius)^2: below zero, so that the
#: matrix can be factorised where rigid motion makes the stiffness singular, and small beside all elastic
#: ones.
_SHIFT = 1e-3
#: Rigid motion comes out at less than this share of the same scale (rounding), elastic modes well above it.
_RIGID = 1e-7


@dataclass(frozen=True)
class Elastic:
    """Isotropic elastic material: Young's modulus (Pa), Poisson's ratio, density (kg/m3)."""

    youngs_modulus: float
    poisson_ratio: float
    density: float

    @property
    def shear_modulus(self) -> float:
        """Shear modulus, Pa."""
        return self.youngs_modulus / (2.0 * (1.0 + self.poisson_ratio))

    @property
    def lame(self) -> float:
        """Lame's first constant, Pa."""
        nu = self.poisson_ratio
        return self.youngs_modulus * nu / ((1.0 + nu) * (1.0 - 2.0 * nu))


@dataclass(frozen=True, eq=False)
class Solid:
    """Matrices of a ring, per pi: stiffness of order n is ``k0 + n k1 + n^2 k2`` (N/m), ``mass`` in kg.

    ``coriolis`` (kg) is the symmetric form whose ratio to the mass is g (see `modes.RingMode`); ``nodes``
    gives the unknown at (half column, half row, component) of the grid, ``points`` the place (x, r) of a
    node in m.
    """

    grid: Grid
    material: Elastic
    nodes: NDArray[np.int64]
    points: NDArray[np.float64]
    k0: csc_matrix
    k1: csc_matrix
    k2: csc_matrix
    mass: csc_matrix
    coriolis: csc_matrix

    def stiffness(self, order: int) -> csc_matrix:
        """Stiffness of one harmonic."""
        return csc_matrix(self.k0 + order * self.k1 + order**2 * self.k2)

    @cached_property
    def scale(self) -> float:
        """Square of the bar wave speed over the mean radius, 1/s2: the size of the ring's eigenvalues."""
        radius = float(self.points[..., 1].mean())
        return self.material.youngs_modulus / self.material.density / radius**2

    def modes(
        self, order: int, count: int, clamped: bool = False
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lowest ``count`` modes of one harmonic: frequencies (Hz), shapes in columns, rigid ones at 0 Hz.

        The shapes' modal masses per pi are 1; same input, same bits (ARPACK starts from a fixed vector).
        ``clamped``: the seat's cylinder is fixed in all directions.
        """
        start = 1.0 + np.arange(self.mass.shape[0]) % _COMPONENTS  # has parts along X, R and T
        start += 0.1 * np.cos(np.arange(len(start)))
        stiffness, mass = self.stiffness(order), self.mass
        moving = np.arange(len(start))
        if clamped:
            moving = np.setdiff1d(moving, self.nodes[:, self.grid.seat_row].ravel())
            stiffness, mass = stiffness[moving][:, moving], mass[moving][:, moving]
        values, vectors = eigsh(
            stiffness, k=count, M=mass, sigma=-_SHIFT * self.scale, which="LM", v0=start[moving]
        )
        ascending = np.argsort(values)
        values = values[ascending]
        values[np.abs(values) < _RIGID * self.scale] = 0.0
        shapes = vectors[:, ascending]
        if clamped:
            shapes = np.zeros((len(start), count))
            shapes[moving] = vectors[:, ascending]
        return np.sqrt(values) / (2.0 * np.pi), shapes


def solid(grid: Grid, material: Elastic) -> Solid:
    """Assemble the matrices of a ring."""
    skfem = need("skfem", BENDING)
    basis = skfem.Basis(grid.mesh, skfem.ElementQuad2(), intorder=5)
    whole = skfem.Basis(grid.reference, skfem.ElementQuad2(), intorder=1)
    half = np.rint(2.0 * whole.doflocs).astype(int)
    place = np.zeros((2 * grid.columns + 1, 2 * grid.rows + 1), dtype=np.int64)
    place[half[0], half[1]] = np.arange(basis.N)
    value, weight, constant, growing = _strains(basis)
    stress, lame = np.diag([2.0, 2.0, 2.0, 1.0, 1.0, 1.0]) * material.shear_modulus, material.lame
    stress[:3, :3] += lame
    # integration points and strain components in one line: products of matrices, one per element
    stressed = [np.matmul(stress, strain) * weight[..., None, None] for strain in (constant, growing)]
    lines = [part.reshape(len(part), -1, part.shape[-1]) for part in (constant, growing, *stressed)]
    s0, s1, d0, d1 = lines
    dofs = (_COMPONENTS * basis.element_dofs.T[..., None] + np.arange(_COMPONENTS)).reshape(len(s0), -1)
    mixed = np.matmul(s0.transpose(0, 2, 1), d1)
    inertia = material.density * np.einsum("iep,jep,ep->eij", value, value, weight)
    mass = _gathered(inertia, basis.element_dofs.T)
    swapped = np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 1.0], [0.0, 1.0, 0.0]])
    return Solid(
        grid=grid,
        material=material,
        nodes=_COMPONENTS * place[..., None] + np.arange(_COMPONENTS),
        points=np.moveaxis(basis.doflocs[:, place], 0, -1),
        k0=_gathered(np.matmul(s0.transpose(0, 2, 1), d0), dofs),
        k1=_gathered(mixed + mixed.transpose(0, 2, 1), dofs),
        k2=_gathered(np.matmul(s1.transpose(0, 2, 1), d1), dofs),
        mass=csc_matrix(kron(mass, np.eye(_COMPONENTS))),
        coriolis=csc_matrix(kron(mass, swapped)),
    )


def _strains(basis: "Basis") -> tuple[NDArray[np.float64], ...]:
    """Strains xx, rr, tt, xr, rt, xt (shears doubled) of the elements' shape functions.

    Returns
    -------
    value : ndarray (functions, elements, points)
        The shape functions.
    weight : ndarray (elements, points)
        The integration points' shares of the integral of r over the section (m3).
    constant, growing : ndarray (elements, points, 6, 3 * functions)
        What does not depend on the order n, and what grows with it, per n (1/m).
    """
    functions = [function[0] for function in basis.basis]
    value = np.array([np.broadcast_to(function, basis.dx.shape) for function in functions])
    dx, dr = np.moveaxis(np.array([function.grad for function in functions]), 1, 0)
    r = np.asarray(basis.global_coordinates())[1]
    over = value / r
    constant = np.zeros((*basis.dx.shape, 6, len(functions), _COMPONENTS))
    growing = np.zeros_like(constant)
    terms = [
        (constant, 0, _X, dx),
        (constant, 1, _R, dr),
        (constant, 2, _R, over),
        (constant, 3, _X, dr),
        (constant, 3, _R, dx),
        (constant, 4, _T, dr - over),
        (constant, 5, _T, dx),
        (growing, 2, _T, over),
        (growing, 4, _R, -over),
        (growing, 5, _X, -over),
    ]
    for strain, row, component, values in terms:
        strain[:, :, row, :, component] = np.moveaxis(values, 0, -1)
    shape = (*basis.dx.shape, 6, -1)
    return value, basis.dx * r, constant.reshape(shape), growing.reshape(shape)


def _gathered(elements: NDArray[np.float64], dofs: NDArray[np.int64]) -> csc_matrix:
    """Sum the elements' matrices into that of all unknowns."""
    rows = np.broadcast_to(dofs[:, :, None], elements.shape)
    columns = np.broadcast_to(dofs[:, None, :], elements.shape)
    size = int(dofs.max()) + 1
    made = coo_matrix((elements.ravel(), (rows.ravel(), columns.ravel())), shape=(size, size))
    return csc_matrix(made)
