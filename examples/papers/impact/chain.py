"""Spheres on one line that hit each other: Hertz contacts, no friction, no loss, no waves inside."""

import math
from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.integrate import solve_ivp

Array = NDArray[np.float64]

#: Longest step of the integrator over the shortest contact time, so that no contact is stepped over.
_STEPS_PER_CONTACT = 40
#: Relative tolerance; the kink of d^1.5 at first touch then leaves 1e-9 in momentum and energy.
_TOLERANCE = 1e-11


@dataclass(frozen=True)
class Sphere:
    """A solid elastic ball: radius (m), density (kg/m3), Young's modulus (Pa), Poisson's ratio."""

    radius: float
    density: float
    modulus: float
    poisson: float

    def __post_init__(self) -> None:
        """Refuse what is not a ball."""
        for name in ("radius", "density", "modulus"):
            value = getattr(self, name)
            if not (math.isfinite(value) and value > 0.0):
                raise ValueError(f"{name} of a sphere is {value}: give a positive number (SI units)")
        if not -1.0 < self.poisson <= 0.5:
            raise ValueError(f"poisson of a sphere is {self.poisson}: elastic solids lie in (-1, 0.5]")

    @property
    def mass(self) -> float:
        """Mass in kg."""
        return 4.0 / 3.0 * math.pi * self.radius**3 * self.density


@dataclass(frozen=True)
class Collision:
    """Motion of a chain on a uniform grid of time; joint j lies between spheres j and j + 1.

    Attributes
    ----------
    time : ndarray, shape (n,)
        s, from the start.
    displacement, velocity, acceleration : ndarray, shape (spheres, n)
        m from the place at the start, m/s, m/s2, along +x.
    force : ndarray, shape (joints, n)
        Contact forces in N, pressing apart.
    """

    time: Array
    displacement: Array
    velocity: Array
    acceleration: Array
    force: Array

    def contact(self, joint: int, share: float = 0.0) -> tuple[float, float]:
        """First and last time in s at which a joint carries more than ``share`` of its peak force.

        Raises
        ------
        ValueError
            When the joint never touches.
        """
        load = self.force[joint]
        loaded = np.flatnonzero(load > share * load.max())
        if loaded.size == 0:
            raise ValueError(
                f"joint {joint} never touches within {self.time[-1]:g} s: take a longer duration"
            )
        return float(self.time[loaded[0]]), float(self.time[loaded[-1]])


def hertz_stiffness(one: Sphere, other: Sphere) -> float:
    """K of F = K d^1.5 in N/m^1.5. Hertz (1882); Johnson (1985), eq. 4.23.

    (Spheres need no elliptic integrals, and this room lies below `prepare`, which has them.)
    """
    compliance = (1.0 - one.poisson**2) / one.modulus + (1.0 - other.poisson**2) / other.modulus
    radius = one.radius * other.radius / (one.radius + other.radius)
    return 4.0 / 3.0 * math.sqrt(radius) / compliance


def contact_time(one: Sphere, other: Sphere, speed: float, stiffness: float | None = None) -> float:
    """Time in s for which two free spheres touch that meet at ``speed`` (m/s). Johnson (1985), eq. 11.24."""
    stiffness = hertz_stiffness(one, other) if stiffness is None else stiffness
    mass = one.mass * other.mass / (one.mass + other.mass)
    deepest = (1.25 * mass * speed**2 / stiffness) ** 0.4
    return 2.0 * math.sqrt(math.pi) * math.gamma(1.4) / math.gamma(0.9) * deepest / speed


def collide(
    spheres: Sequence[Sphere],
    velocities: Sequence[float],
    gaps: Sequence[float] | float = 0.0,
    *,
    duration: float,
    step: float = 1e-7,
    stiffness: Sequence[float] | None = None,
) -> Collision:
    """Let a chain of spheres hit each other, in order along +x.

    Parameters
    ----------
    spheres : sequence of Sphere
        Two or more.
    velocities : sequence of float
        At the start, m/s along +x.
    gaps : sequence of float or float
        Between neighbours at the start, m, zero or more; one number for all joints.
    duration, step : float
        s, of the whole and between the points returned. The integrator chooses its own steps.
    stiffness : sequence of float, optional
        K of F = K d^1.5 of each joint, N/m^1.5; by default `hertz_stiffness`.

    Raises
    ------
    ValueError
        For too few spheres, lists of other lengths, negative gaps, stiffness or times, infinite values.
    """
    speed0, gap, hardness = _checked(spheres, velocities, gaps, stiffness)
    if not (math.isfinite(duration) and 0.0 < step < duration < math.inf):
        raise ValueError(f"step {step} s and duration {duration} s: give 0 < step < duration")
    mass = np.array([ball.mass for ball in spheres])
    count = mass.size

    def forces(displacement: Array) -> Array:
        overlap = displacement[:-1] - displacement[1:] - (gap if displacement.ndim == 1 else gap[:, None])
        return (hardness * np.maximum(overlap, 0.0).T ** 1.5).T

    def rate(_: float, state: Array) -> Array:
        return np.concatenate(
            [state[count:], -np.diff(forces(state[:count]), prepend=0.0, append=0.0) / mass]
        )

    time = step * np.arange(math.floor(duration / step + 1e-9) + 1, dtype=np.float64)
    pace = float(np.ptp(speed0))
    if pace == 0.0:
        raise ValueError(f"all velocities are {speed0[0]} m/s: no sphere reaches another")
    shortest = min(contact_time(spheres[j], spheres[j + 1], pace, hardness[j]) for j in range(count - 1))
    scale = np.repeat([pace * shortest, pace], count)
    done = solve_ivp(
        rate, (0.0, time[-1]), np.concatenate([np.zeros(count), speed0]), "DOP853", time,
        rtol=_TOLERANCE, atol=_TOLERANCE * scale, max_step=shortest / _STEPS_PER_CONTACT,
    )  # fmt: skip
    if not done.success:
        raise RuntimeError(f"the integration stopped at {done.t[-1]:g} s: {done.message}")
    displacement, velocity = done.y[:count], done.y[count:]
    force = forces(displacement)
    acceleration: Array = -np.diff(force, axis=0, prepend=0.0, append=0.0) / mass[:, None]
    return Collision(time, displacement, velocity, acceleration, force)


def _checked(
    spheres: Sequence[Sphere],
    velocities: Sequence[float],
    gaps: Sequence[float] | float,
    stiffness: Sequence[float] | None,
) -> tuple[Array, Array, Array]:
    """Velocities, gaps and stiffnesses as arrays of the right lengths."""
    count = len(spheres)
    if count < 2:
        raise ValueError(f"{count} spheres cannot hit each other: give two or more")
    if stiffness is None:
        stiffness = [hertz_stiffness(spheres[j], spheres[j + 1]) for j in range(count - 1)]
    gap = np.full(count - 1, gaps, dtype=float) if np.ndim(gaps) == 0 else np.asarray(gaps, dtype=float)
    speed, hardness = np.asarray(velocities, dtype=float), np.asarray(stiffness, dtype=float)
    for name, array, size in (
        ("velocities", speed, count), ("gaps", gap, count - 1), ("stiffness", hardness, count - 1)
    ):  # fmt: skip
        if array.shape != (size,):
            raise ValueError(f"{name} has shape {array.shape}: {count} spheres need {size} numbers")
        if not np.isfinite(array).all():
            raise ValueError(f"{name} holds {array[~np.isfinite(array)][0]}: give finite numbers")
    if gap.min() < 0.0:
        raise ValueError(f"a gap of {gap.min()} m: spheres overlap at the start; give 0 (touching) or more")
    if hardness.min() <= 0.0:
        raise ValueError(f"a stiffness of {hardness.min()} N/m^1.5: give a positive number")
    return speed, gap, hardness
