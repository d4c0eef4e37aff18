"""Spheres on one axis in each other's sound: all multiple scattering between rigid surfaces, m = 0.

Each sphere sends out waves h_n P_n; waves of the others are re-expanded about its centre (addition theorem);
the radial acceleration of its surface then fixes its own waves. One linear system per frequency, exact but
for the order at which the waves end. Sources: Gumerov and Duraiswami (2002; multiple scattering from N
spheres), Martin (2006), chapter 4. Spheres that touch or nearly touch need high orders: the wave squeezed
out of the gap is sharp. `docs/impact.md` shows how fast the order converges.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import eval_legendre

from examples.papers.impact import multipoles as waves
from fmu_bearing.acoustics.radiation.radiators import Air

Array = NDArray[np.float64]
Spectrum = NDArray[np.complex128]

#: Two spheres may come this much closer than touching (over their radii): rounding of the caller's centres.
_TOUCHING = 1e-12
#: Points may lie this much inside a sphere (over its radius) and still count as on it.
_SURFACE = 1e-9
#: Waves between spheres are kept to this order at most: beyond, factorials leave double precision.
MAX_ORDER = 150
#: Bytes of the matrices solved at once.
_MEMORY = 200_000_000


@dataclass(frozen=True)
class SphereRow:
    """Rigid spheres with centres on the x axis.

    Parameters
    ----------
    centres, radii : sequence of float
        m; the spheres must not overlap, touching is allowed.
    order : int
        Highest order n of the waves of each sphere, at least 1. Needs k a + 5 at the highest frequency, more
        when spheres nearly touch.
    air : Air, optional
        Density and sound speed.

    Raises
    ------
    ValueError
        For overlapping spheres, bad radii or lists of different lengths, an order out of range.
    """

    centres: Sequence[float]
    radii: Sequence[float]
    order: int
    air: Air = field(default_factory=Air)

    def __post_init__(self) -> None:
        """Refuse what cannot be computed."""
        x, a = np.asarray(self.centres, dtype=float), np.asarray(self.radii, dtype=float)
        if x.ndim != 1 or x.size == 0 or x.shape != a.shape:
            raise ValueError(f"centres {x.shape} and radii {a.shape}: give one number of each per sphere")
        if not (np.isfinite(x).all() and np.isfinite(a).all() and (a > 0.0).all()):
            raise ValueError(f"centres {x} m, radii {a} m: give finite centres and positive radii")
        if not 1 <= self.order <= MAX_ORDER:
            raise ValueError(f"order {self.order}: give 1 to {MAX_ORDER}")
        for i in range(x.size):
            for j in range(i):
                room = abs(x[i] - x[j]) - a[i] - a[j]
                if room < -_TOUCHING * (a[i] + a[j]):
                    raise ValueError(
                        f"spheres {j} and {i} overlap by {-room:.3g} m: move their centres apart to at least "
                        f"{a[i] + a[j]:.6g} m"
                    )

    def amplitudes(self, frequency: ArrayLike, drive: ArrayLike) -> Spectrum:
        """Waves sent out by each sphere.

        Parameters
        ----------
        frequency : array_like, shape (f,)
            Hz, zero allowed.
        drive : array_like, shape (f, spheres, orders)
            Radial acceleration of the surfaces in m/s2, per order n of its expansion in P_n(cos theta), theta
            from +x: column 0 breathing, 1 motion along x. Up to ``order + 1`` columns; those left out are 0.

        Returns
        -------
        ndarray, shape (f, spheres, order + 1)
            Radius times the radial pressure gradient of the wave on its own sphere (Pa); `pressure`
            and `far_field` read it.
        """
        k = self._wavenumber(frequency)
        drive = np.asarray(drive, dtype=complex)
        count, size = len(self.radii), self.order + 1
        if drive.ndim != 3 or drive.shape[:2] != (k.size, count) or not 1 <= drive.shape[2] <= size:
            raise ValueError(
                f"drive has shape {drive.shape}: give ({k.size} frequencies, {count} spheres, "
                f"1 to {size} orders)"
            )
        side = np.zeros((k.size, count, size), dtype=complex)
        side[:, :, : drive.shape[2]] = -self.air.density * np.asarray(self.radii)[:, None] * drive
        block = max(1, _MEMORY // (16 * (count * size) ** 2))
        pieces = [slice(start, start + block) for start in range(0, k.size, block)]
        return np.concatenate([self._solve(k[piece], side[piece]) for piece in pieces])

    def _solve(self, k: Array, side: Spectrum) -> Spectrum:
        count, size = side.shape[1:]
        system = np.zeros((k.size, count, size, count, size), dtype=complex)
        for i in range(count):
            system[:, i, range(size), i, range(size)] = 1.0
            for j in range(count):
                if j != i:
                    system[:, i, :, j, :] = self._onto(k, i, j)
        flat = system.reshape(k.size, count * size, count * size)
        solved = np.linalg.solve(flat, side.reshape(k.size, -1, 1)).reshape(side.shape)
        return np.asarray(solved, dtype=np.complex128)

    def pressure(self, frequency: ArrayLike, amplitudes: Spectrum, points: ArrayLike) -> Spectrum:
        """Pressure in Pa at ``points`` (m, shape (points, 2): x and distance from the axis), (f, points).

        Raises
        ------
        ValueError
            When a point lies inside a sphere.
        """
        k = self._wavenumber(frequency)
        place = self.outside(points)
        total: Spectrum = np.zeros((k.size, len(place)), dtype=complex)
        for i, (centre, radius) in enumerate(zip(self.centres, self.radii, strict=True)):
            r = np.hypot(place[:, 0] - centre, place[:, 1])
            cosine = (place[:, 0] - centre) / r
            own = self._own(k, radius)
            for j, (distance, mu) in enumerate(zip(r, cosine, strict=True)):
                g = waves.leaving(self.order, k * distance)
                n = np.arange(self.order + 1)
                shape = (radius / distance) ** (n + 1) * eval_legendre(n, mu)
                total[:, j] += np.einsum("nf,n,fn->f", g / own, shape, amplitudes[:, i])
        return total

    def far_field(self, frequency: ArrayLike, amplitudes: Spectrum, cosines: ArrayLike) -> Spectrum:
        """Limit of r p e^{jkr} in Pa m at great distance r from x = 0, shape (f, cosines)."""
        k = self._wavenumber(frequency)
        mu = np.asarray(cosines, dtype=float)
        n = np.arange(self.order + 1)[:, None]
        total: Spectrum = np.zeros((k.size, mu.size), dtype=complex)
        for i, (centre, radius) in enumerate(zip(self.centres, self.radii, strict=True)):
            # g_n grows like (2n-1)!!^{-1} x^n j^{n+1}: logarithms, since x^n alone may leave double precision
            with np.errstate(divide="ignore"):
                size = n * np.log(k * radius) - waves.log_double_factorial(2 * n - 1)
            size = np.where(n == 0, 0.0, size)
            own = np.exp(size) * 1j ** (n + 1) / self._own(k, radius) * radius
            pattern = np.einsum("fn,nf,nm->fm", amplitudes[:, i], own, eval_legendre(n, mu[None, :]))
            total = total + pattern * np.exp(1j * k[:, None] * centre * mu)
        return total

    def _wavenumber(self, frequency: ArrayLike) -> Array:
        f = np.asarray(frequency, dtype=float)
        if f.ndim != 1 or f.size == 0 or not np.isfinite(f).all() or f.min() < 0.0:
            raise ValueError(f"frequencies {f}: give a list of finite numbers from 0 on, in Hz")
        return 2.0 * np.pi * f / self.air.sound_speed

    def _own(self, k: Array, radius: float) -> Spectrum:
        """Slope x h_n'(x) on the sphere's own surface without (2n-1)!! and powers of x; (orders, f)."""
        g = waves.leaving(self.order + 1, k * radius)
        return g[:-1] * waves.leaving_slope(self.order, k * radius, g)

    def _onto(self, k: Array, i: int, j: int) -> Spectrum:
        """Gradients on sphere i by the waves of sphere j: shape (f, order + 1 of i, order + 1 of j)."""
        a, b = self.radii[i], self.radii[j]
        distance = abs(self.centres[i] - self.centres[j])
        log, el = waves.coupling(self.order)
        v = np.arange(self.order + 1)
        log = log + waves.log_double_factorial(2 * el - 1)
        log -= waves.log_double_factorial(2 * v + 1)[:, None, None]
        log -= waves.log_double_factorial(2 * v - 1)[None, :, None]
        log += (v * math.log(a / distance))[:, None, None]
        log += ((v + 1) * math.log(b / distance))[None, :, None]
        g = waves.leaving(2 * self.order, k * distance).T
        with np.errstate(divide="ignore"):
            log_kd = np.log(k * distance)[:, None, None]
        total = np.zeros((k.size, v.size, v.size), dtype=complex)
        for s in v:
            block = log[s:, s:, s] + (2 * s * log_kd if s else 0.0)
            total[:, s:, s:] += (1 - 2 * (s % 2)) * np.exp(block) * g[:, el[s:, s:, s]]
        # (-1)^(v-s) of the theorem, and P_l(-1) when sphere i lies before sphere j; (-1)^s is in the loop
        sign = (-1.0) ** v[:, None] * (np.sign(self.centres[i] - self.centres[j]) ** (v[:, None] + v))
        slope = waves.finite_slope(self.order, k * a, waves.finite(self.order + 1, k * a))
        onto: Spectrum = total * sign * slope.T[:, :, None] / self._own(k, b).T[:, None, :]
        return onto

    def outside(self, points: ArrayLike) -> Array:
        """Points as an array, shape (points, 2), if none lies inside a sphere (else ValueError)."""
        place = np.asarray(points, dtype=float)
        if place.ndim != 2 or place.shape[1] != 2 or not np.isfinite(place).all():
            raise ValueError(f"points have shape {place.shape}: give pairs (x, distance from the axis) in m")
        for i, (centre, radius) in enumerate(zip(self.centres, self.radii, strict=True)):
            r = np.hypot(place[:, 0] - centre, place[:, 1])
            if (r < radius * (1.0 - _SURFACE)).any():
                x, s = place[r.argmin()]
                raise ValueError(
                    f"point ({x:g}, {s:g}) m lies {radius - r.min():.3g} m inside sphere {i} "
                    f"(centre {centre:g} m, radius {radius:g} m): move it out"
                )
        return place
