"""A natural motion: what moves, at which frequency, how damped, in which direction; its remark."""

import math
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.cautions import GROWS
from fmu_bearing.results.base import Quantity, Result

MARGIN = 0.002  # damping ratio below which a mode counts as near the limit of stability (chosen)
LOWEST = 100.0  # Hz: slower motions that grow belong to the mounting
MOVES = 0.05  # of the kinetic energy: with less of it in the rings, a motion is one of the balls alone
_NAMED, _LEAST = 3, 0.05  # shares named in a row; smaller ones are left out
SPREAD = 0.01  # of the frequency over one ball pitch, beyond which it is reported


def largest(participation: dict[str, float]) -> str:
    """Return the largest shares of the kinetic energy in text, in per cent."""
    shares = [(name, share) for name, share in participation.items() if share >= _LEAST][:_NAMED]
    return ", ".join(f"{name} {100.0 * share:.0f}" for name, share in shares)


@dataclass(frozen=True)
class Mode(Result):
    """A natural motion of a bearing or a set."""

    quantities = (
        Quantity("frequency_Hz", "Hz", ",.1f"),
        Quantity("damping_ratio [1] = damping", "damping, %", ".2f", 100.0),
        Quantity("order [1]", "waves round"), Quantity("direction", "whirl", lambda words: words or "-"),
        "name",
        Quantity(" = _remarked", "what moves most"),
        Quantity("participation [1]", "kinetic energy, %", largest),
        Quantity("spread [1]", "moves as balls pass, %", ".1f", 100.0), "remark",
    )  # fmt: skip

    name: str
    """What moves most, by kinetic energy: ``inner radial``, ``outer axial``, ``ball n = 3``; of a set ``shaft
    bending``, ``housing axial``, ``outer tilt of bearing 1``..."""
    frequency: float
    """Hz, in fixed axes."""
    damping: float
    """Damping ratio; negative: the motion grows by itself."""
    order: int
    """Waves round the bearing: 0 axial and turning, 1 radial and tilting, n of a ring's flexure."""
    direction: str
    """``forward`` with the shaft, ``backward`` or empty: order 0, or neither whirl dominates threefold. Order
    1 of a set: the whirl at the shaft's nose."""
    participation: dict[str, float]
    """Shares of the kinetic energy by component, the largest first."""
    spread: float
    """Range of the frequency over one ball pitch, over the frequency; 0 where balls carry equal loads."""
    value: complex
    orbiting: complex
    """Eigenvalues (1/s) in fixed axes, and in the axes that orbit with the balls."""
    vector: NDArray[np.complex128]
    """Eigenvector in the order of ``Modes.linearised``."""

    @property
    def label(self) -> str:
        """Name with direction."""
        return f"{self.name} {self.direction}".rstrip()

    @property
    def ring_share(self) -> float:
        """Share of the rings in the kinetic energy."""
        return sum(share for name, share in self.participation.items() if not name.startswith("ball"))

    @property
    def remark(self) -> str:
        """``unstable`` or ``instability margin`` for modes of the rings with hardly any damping, or empty."""
        if self.damping >= MARGIN or self.ring_share <= MOVES:
            return ""
        if self.name.startswith("ball"):
            # balls have most of the energy of the fastest whirls of a ring; the ones that rings hardly take
            # part in are free along their orbits, and neutral
            return "unstable" if self.growth > GROWS else ""
        return "unstable" if self.damping < 0.0 else "instability margin"

    @property
    def _remarked(self) -> str:
        """Name with the remark."""
        return f"{self.name} ({self.remark})" if self.remark else self.name

    @property
    def growth(self) -> float:
        """Rate (1/s) at which the motion grows by itself; negative where it dies away."""
        return float(self.value.real)

    @property
    def quality(self) -> float:
        """Q, the magnification at resonance, 1/(2 zeta); infinite for a mode without damping."""
        return 0.5 / self.damping if self.damping > 0.0 else math.inf


def weak_words(mode: Mode) -> str:
    """Return the caution of a mode near or beyond the limit of stability."""
    where = f"'{mode.label}' at {mode.frequency:.0f} Hz"
    if mode.damping < 0.0:
        return (
            f"instability: {where} grows by itself (damping ratio {mode.damping:.4f}): the bearing whirls "
            "until its motion is large enough to limit itself; more preload or less speed may hold it"
        )
    return (
        f"instability margin: {where} has a damping ratio of {mode.damping:.4f} only: a little less preload "
        "or more speed may make it whirl by itself"
    )


def groups_of(alone: list[Mode]) -> list[list[Mode]]:
    """Group motions of the balls alone that differ in fixed axes by the turning of their pattern only."""
    groups: list[list[Mode]] = []
    for mode in sorted(alone, key=lambda mode: (_what(mode), abs(mode.orbiting.imag))):
        last = groups[-1][-1] if groups else None
        if last and _what(last) == _what(mode):
            apart = abs(mode.orbiting.imag) - abs(last.orbiting.imag)
            if apart <= SPREAD * abs(mode.orbiting.imag):
                groups[-1].append(mode)
                continue
        groups.append([mode])
    return groups


def _what(mode: Mode) -> str:
    """Name of a mode without its order."""
    return mode.name.partition(" n = ")[0]


def grouped(group: list[Mode]) -> Mode:
    """Return motions of the balls alone that are one motion in orbiting axes as one: its numbers there."""
    if len(group) == 1:
        return group[0]
    orders = sorted({mode.order for mode in group})
    value = complex(np.mean([mode.orbiting.real + 1j * abs(mode.orbiting.imag) for mode in group]))
    words = f"{orders[0]} to {orders[-1]}" if len(orders) > 1 else str(orders[0])
    return replace(
        group[0], frequency=value.imag / (2.0 * math.pi), damping=-value.real / abs(value),
        name=f"{_what(group[0])} n = {words}", direction="",
    )  # fmt: skip
