"""A rotor that owns its shaft and takes the bearings' force at X = 0: rigid, or with a mass on a bending arm.

Its coordinates begin with the five of the port: x y z (m), tilts about y and z (rad). With the inner rings,
which are the rotor's: ``mass a + (damping + speed gyroscopic) v + stiffness q = force``.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

PORT = 5
GRAVITY = 9.81  # m/s2, as the bearings have it


@dataclass(frozen=True)
class Rotor:
    """Matrices of the rotor without inner rings, and the force of its weight."""

    mass: NDArray[np.float64]
    damping: NDArray[np.float64]
    stiffness: NDArray[np.float64]
    weight: NDArray[np.float64]

    @property
    def count(self) -> int:
        """Number of coordinates."""
        return len(self.weight)

    def with_rings(self, mass: float, static: float, transverse: float) -> "Rotor":
        """Return the rotor with inner rings: their mass (kg), static moment (kg m) and inertia (kg m2)."""
        rings = np.zeros_like(self.mass)
        rings[:PORT, :PORT] = np.diag([mass, mass, mass, transverse, transverse])
        rings[1, 4] = rings[4, 1] = static
        rings[2, 3] = rings[3, 2] = -static
        weight = self.weight.copy()
        weight[:PORT] -= GRAVITY * np.array([0.0, 0.0, mass, -static, 0.0])
        return Rotor(self.mass + rings, self.damping, self.stiffness, weight)


def cylinder(length: float, radius: float, speed: float, density: float = 7800.0) -> Rotor:
    """Return a solid cylinder from X = 0 on (m), at a speed (rad/s) that its gyroscopic moments have."""
    mass = density * np.pi * radius**2 * length
    polar, middle = 0.5 * mass * radius**2, 0.5 * length
    across = 0.25 * mass * radius**2 + mass * length**2 / 3.0
    matrix = np.diag([mass, mass, mass, across, across])
    matrix[1, 4] = matrix[4, 1] = mass * middle
    matrix[2, 3] = matrix[3, 2] = -mass * middle
    gyroscopic = np.zeros((PORT, PORT))
    gyroscopic[3, 4], gyroscopic[4, 3] = polar * speed, -polar * speed
    weight = -GRAVITY * np.array([0.0, 0.0, mass, -mass * middle, 0.0])
    return Rotor(matrix, gyroscopic, np.zeros((PORT, PORT)), weight)


def with_arm(rotor: Rotor, mass: float, at: float, frequency: float, damping_ratio: float) -> Rotor:
    """Return the rotor with a mass (kg) on a bending arm at X = ``at`` (m): one mode in each direction.

    ``frequency`` (Hz): of the mass with the rotor held.
    """
    n, omega = rotor.count, 2.0 * np.pi * frequency
    stiffness, damping = mass * omega**2, 2.0 * damping_ratio * mass * omega
    # how far each mass goes away from the arm's foot, y + at bz and z - at by
    apart = np.zeros((2, n + 2))
    apart[0, [1, 4, n]] = -1.0, -at, 1.0
    apart[1, [2, 3, n + 1]] = -1.0, at, 1.0
    spring = apart.T @ apart

    def wide(matrix: NDArray[np.float64]) -> NDArray[np.float64]:
        found = np.zeros((n + 2, n + 2))
        found[:n, :n] = matrix
        return found

    masses = wide(rotor.mass)
    masses[0, 0] += mass  # along the axis the arm is rigid
    masses[n, n] = masses[n + 1, n + 1] = mass
    weight = np.concatenate([rotor.weight, [0.0, -GRAVITY * mass]])
    return Rotor(
        masses, wide(rotor.damping) + damping * spring, wide(rotor.stiffness) + stiffness * spring, weight
    )
