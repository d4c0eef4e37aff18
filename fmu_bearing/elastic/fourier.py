"""Solid of revolution for one circumferential harmonic: stiffness, mass, gyroscopic form, modes.

With u_x = X cos n theta, u_r = R cos n theta, u_t = T sin n theta all integrals over theta give pi (n > 0),
so that real arithmetic serves (Zienkiewicz and Taylor 2000, vol. 2, chapter 9: semi-analytical finite
elements). For n = 0 the factor would be 2 pi, the same in stiffness and mass; X and R then part from T,
torsion.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import csc_matrix
from scipy.sparse.linalg import eigsh
from skfem import Basis, BilinearForm, ElementQuad2, ElementVector

from fmu_bearing.elastic.section import Grid

_COMPONENTS = 3  # X, R, T
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


def _strain(u: Any, r: NDArray[np.float64]) -> tuple[tuple[Any, ...], tuple[Any, ...]]:
    """Strains xx, rr, tt, xr, rt, xt (shears doubled): what does not grow with n, and what does, per n."""
    (xx, xr), (rx, rr), (tx, tr) = u.grad
    x, radial, t = u[0], u[1], u[2]
    zero = 0.0 * x
    return (xx, rr, radial / r, xr + rx, tr - t / r, tx), (zero, zero, t / r, zero, -radial / r, -x / r)


def _energy(a: tuple[Any, ...], b: tuple[Any, ...], lame: float, shear: float) -> Any:
    """Work of the stresses of strain ``b`` on strain ``a``, per volume."""
    volume = lame * (a[0] + a[1] + a[2]) * (b[0] + b[1] + b[2])
    normal = 2.0 * (a[0] * b[0] + a[1] * b[1] + a[2] * b[2])
    return volume + shear * (normal + a[3] * b[3] + a[4] * b[4] + a[5] * b[5])


@BilinearForm
def _constant(u: Any, v: Any, w: Any) -> Any:
    return _energy(_strain(v, w.x[1])[0], _strain(u, w.x[1])[0], w.lame, w.shear) * w.x[1]


@BilinearForm
def _linear(u: Any, v: Any, w: Any) -> Any:
    (v0, v1), (u0, u1) = _strain(v, w.x[1]), _strain(u, w.x[1])
    return (_energy(v0, u1, w.lame, w.shear) + _energy(v1, u0, w.lame, w.shear)) * w.x[1]


@BilinearForm
def _quadratic(u: Any, v: Any, w: Any) -> Any:
    return _energy(_strain(v, w.x[1])[1], _strain(u, w.x[1])[1], w.lame, w.shear) * w.x[1]


@BilinearForm
def _inertia(u: Any, v: Any, w: Any) -> Any:
    return (u[0] * v[0] + u[1] * v[1] + u[2] * v[2]) * w.x[1]


@BilinearForm
def _coriolis(u: Any, v: Any, w: Any) -> Any:
    return (u[1] * v[2] + u[2] * v[1]) * w.x[1]


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

    def modes(self, order: int, count: int) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Lowest ``count`` modes of one harmonic: frequencies (Hz), shapes in columns, rigid ones at 0 Hz.

        The shapes' modal masses per pi are 1; same input, same bits (ARPACK starts from a fixed vector).
        """
        start = 1.0 + np.arange(self.mass.shape[0]) % _COMPONENTS  # touches X, R and T alike
        values, shapes = eigsh(
            self.stiffness(order),
            k=count,
            M=self.mass,
            sigma=-_SHIFT * self.scale,
            which="LM",
            v0=start + 0.1 * np.cos(np.arange(len(start))),
        )
        ascending = np.argsort(values)
        values = values[ascending]
        values[np.abs(values) < _RIGID * self.scale] = 0.0
        return np.sqrt(values) / (2.0 * np.pi), shapes[:, ascending]


def solid(grid: Grid, material: Elastic) -> Solid:
    """Assemble the matrices of a ring."""
    element = ElementVector(ElementQuad2(), _COMPONENTS)
    basis = Basis(grid.mesh, element, intorder=5)
    half = np.rint(2.0 * Basis(grid.reference, element, intorder=1).doflocs).astype(int)
    component = np.zeros(basis.N, dtype=int)
    for entity in (basis.nodal_dofs, basis.facet_dofs, basis.interior_dofs):
        for index, row in enumerate(entity):
            component[row] = index % _COMPONENTS
    nodes = np.full((2 * grid.columns + 1, 2 * grid.rows + 1, _COMPONENTS), -1, dtype=np.int64)
    nodes[half[0], half[1], component] = np.arange(basis.N)
    constants = {"lame": material.lame, "shear": material.shear_modulus}
    return Solid(
        grid=grid,
        material=material,
        nodes=nodes,
        points=np.moveaxis(basis.doflocs[:, nodes[..., 0]], 0, -1),
        k0=csc_matrix(_constant.assemble(basis, **constants)),
        k1=csc_matrix(_linear.assemble(basis, **constants)),
        k2=csc_matrix(_quadratic.assemble(basis, **constants)),
        mass=csc_matrix(material.density * _inertia.assemble(basis)),
        coriolis=csc_matrix(material.density * _coriolis.assemble(basis)),
    )
