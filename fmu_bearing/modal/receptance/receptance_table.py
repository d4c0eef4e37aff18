"""Receptance of a nose over speed, preload and frequency: numbers, and what follows from them."""

from dataclasses import dataclass
from typing import Literal

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.modal.equations.coordinates import FREEDOMS
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.scene import Scene

#: What moves: the nose, of a single bearing its inner ring; or the tip of the tool on it.
Place = Literal["nose", "tip"]
_STRONG = 0.05  # of the direct receptance: cross terms that count
_SPREAD = 0.01  # between phases of a ball pitch: more is said
_NONE = 1e-20  # m/N: less is rounding, as along the axis of a ring that is held
DIRECT = ("x", "y", "z")


@dataclass(frozen=True)
class Peak(Result):
    """The largest receptance along one direction at one speed and preload."""

    quantities = (
        Quantity("speed_rpm = speed", "r/min", "g"), Quantity("preload_N = preload", "N", "g"),
        Quantity("direction", "along"),
        Quantity("stiffness_N_m = stiffness", "lowest frequency, N/um", ".2f", 1e-6),
        Quantity("frequency_Hz = frequency", "peak, Hz", ",.0f"),
        Quantity("dynamic_stiffness_N_m = dynamic", "there, N/um", ".2f", 1e-6),
        Quantity("least_real_part [m/N] = least_real", "least real part, um/N", ".3f", 1e6),
        Quantity("cross [1]", "cross over direct", ".2f"),
    )  # fmt: skip

    speed: float
    preload: float
    direction: str
    stiffness: float
    """N/m: 1 over the receptance at the lowest frequency."""
    frequency: float
    """Hz, of the largest receptance."""
    dynamic: float
    """N/m: 1 over the receptance there."""
    least_real: float
    """m/N: least real part, below 0: by it a cut along this direction alone loses stability."""
    cross: float
    """Largest receptance across, of y and z for each other, over the largest along; 0 for x."""


@dataclass(frozen=True)
class ReceptanceTable(Result):
    """Numbers of `Receptance`, which adds files and a picture."""

    scene: Scene
    place: Place
    """``nose``, of a single bearing its inner ring; ``tip`` of the tool."""
    speeds: NDArray[np.float64]
    """r/min, rising."""
    preloads: NDArray[np.float64]
    """N, rising."""
    frequencies: NDArray[np.float64]
    """Hz, rising."""
    G: NDArray[np.complex128]
    """m/N, 1/N, rad/(N m): motions x, y, z and tilts about y, z per forces and moments there; shape (speed,
    preload, frequency, 5, 5)."""
    spread: NDArray[np.float64]
    """Largest distance of a single phase of a ball pitch from the mean, of the receptance of y and z at the
    lowest frequency, over it; 0 for equal ball loads. Shape (speed, preload)."""
    steady: NDArray[np.bool_]
    """Whether the steady state was found. Shape (speed, preload)."""
    growing: NDArray[np.float64]
    """1/s: of the motion of the rings or of the set that grows fastest by itself; 0: none. Shape (speed,
    preload)."""
    remarks: tuple[str, ...] = ()
    """Of the steady states."""

    def peaks(self) -> tuple[Peak, ...]:
        """Return the largest receptance along x, y and z, at each speed and preload."""
        return tuple(
            self._peak(i, k, name)
            for i in range(len(self.speeds))
            for k in range(len(self.preloads))
            for name in DIRECT
        )

    def records(self) -> tuple[Peak, ...]:
        """Return `peaks`."""
        return self.peaks()

    def _peak(self, i: int, k: int, name: str) -> Peak:
        one = FREEDOMS.index(name)
        other = {"y": FREEDOMS.index("z"), "z": FREEDOMS.index("y")}.get(name)
        g = self.G[i, k]
        along = np.abs(g[:, one, one])
        at = int(along.argmax())
        largest = float(along[at])
        aside = 0.0 if other is None or largest == 0.0 else float(np.abs(g[:, other, one]).max()) / largest
        return Peak(
            float(self.speeds[i]), float(self.preloads[k]), name, _stiffness(float(along[0])),
            float(self.frequencies[at]), _stiffness(largest), float(g[:, one, one].real.min()), aside,
        )  # fmt: skip

    def cautions(self) -> list[str]:
        """Return what limits these numbers, in sentences."""
        sentences = list(self.remarks)
        largest = float(self.spread.max())
        if largest > _SPREAD:
            sentences.append(
                f"single phases of a ball pitch differ by up to {100.0 * largest:.1f} % from these means: "
                "the balls' loads are unequal, and the nose is softer and stiffer as they pass"
            )
        for i, k in np.argwhere(self.growing > 0.0)[:1]:
            sentences.append(
                f"{self.speeds[i]:g} r/min, {self.preloads[k]:g} N: a motion grows by itself by "
                f"{self.growing[i, k]:.3g} 1/s, see `modes`: no receptance can be measured there"
            )
        if self.scene.assembly.joined and not self._bends:
            sentences.append(
                "the shaft is rigid here: one that bends is softer at its nose: set "
                "spindle.shaft.flexible = true"
            )
        if any(one.cage is not None for one in self.scene.geometries):
            sentences.append("the cage and its films are left out: it touches balls and lands with clearance")
        return sentences

    @property
    def _bends(self) -> bool:
        shaft = self.scene.assembly.shaft
        return shaft is not None and shaft.flexible


def _stiffness(receptance: float) -> float:
    return 1.0 / receptance if receptance > _NONE else float("inf")
