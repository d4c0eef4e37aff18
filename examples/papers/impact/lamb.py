"""The free elastic sphere: its natural frequencies, and its surface under a force on the axis.

Displacements u = grad(phi) + curl curl(r psi), with spherical Bessel functions j_n of w r / c_l in phi and of
w r / c_t in psi, c_l and c_t the speeds of compression and shear waves. Lamb (1882); Love (1944), chapter 12;
Eringen and Suhubi (1975), section 8.14.
"""

import math
from collections.abc import Callable

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import brentq

from examples.papers.impact import multipoles as waves
from examples.papers.impact.chain import Sphere

Array = NDArray[np.float64]

#: Frequencies of shear waves on the radius below which a sphere is taken at its limit of zero frequency.
_STATIC = 1e-4
#: Step in w a / c_t between which two roots do not hide: roots of one family lie about 1 apart.
_SCAN = 0.02
#: Share of a natural frequency beside it at which its residue is read: rounding of the determinant's root
#: over it, and its square, are both below 1e-7.
_RESIDUE = 1e-5


def wave_speeds(ball: Sphere) -> tuple[float, float]:
    """Speeds in m/s of compression and of shear waves.

    Raises
    ------
    ValueError
        For Poisson's ratio 0.5: compression waves would be infinitely fast.
    """
    if ball.poisson == 0.5:
        raise ValueError(
            "poisson of an elastic sphere is 0.5: give less, compression waves need a finite speed"
        )
    shear = ball.modulus / (2.0 * (1.0 + ball.poisson))
    ratio = 2.0 * (1.0 - ball.poisson) / (1.0 - 2.0 * ball.poisson)
    return math.sqrt(ratio * shear / ball.density), math.sqrt(shear / ball.density)


def torsional_frequencies(ball: Sphere, order: int, count: int = 1) -> tuple[float, ...]:
    """Lowest natural frequencies in Hz of twisting modes of order n >= 1: (n-1) j_n(x) = x j_{n+1}(x)."""

    def traction(x: Array) -> Array:
        q = waves.finite(order + 1, x)
        free: Array = (order - 1) * q[order] - x**2 / (2 * order + 3) * q[order + 1]
        return free

    return _roots(traction, ball, order, count)


def spheroidal_frequencies(ball: Sphere, order: int, count: int = 1) -> tuple[float, ...]:
    """Lowest natural frequencies in Hz of modes without twist, of order n >= 0 (0: breathing)."""

    def traction(x: Array) -> Array:
        stress, _ = _surface(ball, order, x)
        free: Array = stress[:, 0, 0] if order == 0 else np.linalg.det(stress)
        return free

    return _roots(traction, ball, order, count)


def pole_modes(ball: Sphere, order: int, highest: float) -> tuple[Array, Array]:
    """Modes without twist of order n up to a frequency, as a force on the axis excites them.

    Returns
    -------
    frequencies : ndarray (m,)
        Hz.
    poles : ndarray (m,)
        Radial displacement of the pole on the axis at modal mass 1 kg (kg^-1/2), so that a force F there
        moves it by the sum of poles^2 / ((2 pi f_k)^2 - w^2) F. On the opposite pole times (-1)^n, outwards.
    """
    count = 1
    while spheroidal_frequencies(ball, order, count)[-1] <= highest:
        count *= 2
    found = np.array([f for f in spheroidal_frequencies(ball, order, count) if f <= highest])
    # residues of the response to a point force, whose stress has (2n + 1) / (4 pi a^2) of P_n; symmetric
    # steps about the pole cancel what the other modes add, up to the step
    ends = (1.0 - _RESIDUE, 1.0 + _RESIDUE)
    near = np.array([surface_acceleration(ball, order, share * found) for share in ends])
    omega = 2.0 * np.pi * found
    share = (2 * order + 1) / (4.0 * np.pi * ball.radius**2)
    moved = [-(1.0 - end**2) / end**2 * a for end, a in zip(ends, near, strict=True)]
    return found, np.sqrt(share * np.mean(moved, axis=0)) if found.size else omega


def surface_acceleration(ball: Sphere, order: int, frequency: ArrayLike) -> Array:
    """Radial acceleration of the surface per radial stress, both of shape P_n, without damping (m/s2 per Pa).

    Order 1 contains the motion of the sphere as a whole. ``frequency`` in Hz, shape (f,). At resonance the
    result is as large as rounding lets it be.

    Raises
    ------
    ValueError
        For a negative order.
    """
    if order < 0:
        raise ValueError(f"order {order}: give 0 or more")
    omega = 2.0 * np.pi * np.asarray(frequency, dtype=float)
    x = omega * ball.radius / wave_speeds(ball)[1]
    static = x < _STATIC
    stress, radial = _surface(ball, order, np.where(static, 1.0, x))
    size = 1 if order == 0 else 2
    side = np.zeros((x.size, size, 1))
    side[:, 0] = 1.0
    part = np.linalg.solve(stress[:, :size, :size], side)[:, :, 0]
    moved = np.einsum("fs,fs->f", part, radial[:, :size])
    rigid = 1.0 / (ball.density * ball.radius) if order == 1 else 0.0
    accelerated: Array = np.where(static, rigid, -(omega**2) * moved)
    return accelerated


def _surface(ball: Sphere, order: int, x: Array) -> tuple[Array, Array]:
    """Stresses (radial, along the surface; Pa) and radial displacement (m) of phi and psi at w a / c_t = x.

    Shapes (x, 2 stresses, 2 potentials) and (x, 2 potentials); each potential is 1 m2 (psi: 1 m) times
    q_n(w r / c) (r / a)^n.
    """
    fast, slow = wave_speeds(ball)
    a, many = ball.radius, order * (order + 1)
    stress, radial = np.zeros((x.size, 2, 2)), np.zeros((x.size, 2))
    for column, wave in enumerate((x * slow / fast, x)):
        q = waves.finite(order + 1, wave)
        value, slope = q[order], waves.finite_slope(order, wave, q)[order]
        bend = -2.0 * slope - (wave**2 - many) * value  # a^2 times the second derivative
        if column == 0:
            # lambda / mu = (c_l / c_t)^2 - 2 multiplies the dilatation -(w / c_l)^2 phi
            bulk = ((fast / slow) ** 2 - 2.0) * wave**2
            radial[:, 0] = slope / a
            stress[:, 0, 0] = (2.0 * bend - bulk * value) / a**2
            stress[:, 1, 0] = 2.0 * (slope - value) / a**2
        else:
            radial[:, 1] = many * value / a
            stress[:, 0, 1] = 2.0 * many * (slope - value) / a**2
            stress[:, 1, 1] = (bend + (many - 2) * value) / a**2
    return slow**2 * ball.density * stress, radial


def _roots(traction: Callable[[Array], Array], ball: Sphere, order: int, count: int) -> tuple[float, ...]:
    """First ``count`` sign changes of the traction over w a / c_t, as frequencies in Hz."""
    if order < 0 or count < 1:
        raise ValueError(f"order {order}, count {count}: give an order from 0 on and a count from 1 on")
    found: list[float] = []
    start = 0.5  # no natural frequency lies below
    while len(found) < count:
        x = start + _SCAN * np.arange(201, dtype=np.float64)
        stress = traction(x)
        for k in np.flatnonzero(stress[:-1] * stress[1:] < 0.0)[: count - len(found)]:
            root = brentq(lambda y: traction(np.array([y]))[0], x[k], x[k + 1], xtol=1e-13)
            found.append(float(root))
        start = float(x[-1])
    scale = wave_speeds(ball)[1] / (2.0 * math.pi * ball.radius)
    return tuple(scale * root for root in found)
