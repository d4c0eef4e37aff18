"""What a Campbell diagram holds: modes over speed, excitation lines, and the speeds where both meet."""

import math
from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy.interpolate import PchipInterpolator

from fmu_bearing.modal.campbell.excitation_lines import Line, Rates
from fmu_bearing.modal.equations.remarks import unsteady
from fmu_bearing.modal.modes.energies import NEITHER
from fmu_bearing.modal.modes.mode import MARGIN, MOVES, Mode
from fmu_bearing.modal.modes.natural_modes import Modes, self_excited
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.scene import Scene

WITHIN = 20.0  # dB below the largest: crossings that count
_SPIN = "spin"  # waves press along the contacts' normals, which have no lever about the axis


@dataclass(frozen=True)
class Branch:
    """One mode over speed, followed by its shape.

    Attributes
    ----------
    name, direction : str
        Of the mode at the middle of its speeds.
    order : int
    rpm, frequency, damping : ndarray
        r/min, Hz and damping ratio where the mode was found.
    modes : tuple of Mode
    """

    name: str
    direction: str
    order: int
    rpm: NDArray[np.float64]
    frequency: NDArray[np.float64]
    damping: NDArray[np.float64]
    modes: tuple[Mode, ...]

    @property
    def label(self) -> str:
        """Name with direction."""
        return f"{self.name} {self.direction}".rstrip()


@dataclass(frozen=True)
class Crossing(Result):
    """A speed at which an excitation has the frequency of a mode that it can move."""

    quantities = (
        Quantity("speed_rpm = rpm", "r/min", ",.0f"), Quantity("frequency_Hz", "Hz", ",.0f"),
        Quantity(" = branch.label", "mode"),
        Quantity("damping_ratio [1] = damping", "damping, %", ".2f", 100.0), "mode = branch.name",
        "direction = branch.direction", Quantity("line = line.name", "line"), "source = line.source",
        "surface_order [1] = line.surface_order", "in_scene = line.present",
        Quantity("", "made by, order", of=lambda c: f"{c.line.source} {c.line.surface_order or ''}".rstrip()),
        Quantity(" = quality", "Q", ".0f"),
        Quantity("velocity_um_s", "velocity, um/s", lambda v: f"{v:,.0f}" if v > 0.0 else "not in the scene",
                 factor=1e6),
    )  # fmt: skip

    rpm: float
    frequency: float
    damping: float
    """r/min, Hz, damping ratio."""
    branch: Branch
    line: Line
    velocity: float
    """m/s: amplitude of the surface times angular frequency times Q, an estimate that ranks crossings; 0
    where the scene does not contain the line."""

    @property
    def quality(self) -> float:
        """Q, 1/(2 zeta)."""
        return 0.5 / self.damping if self.damping > 0.0 else math.inf


@dataclass(frozen=True)
class Diagram(Result):
    """Branches, lines and crossings over speed; `Campbell` adds the picture."""

    quantities = "campbell = table", "crossings", "verdict"

    scene: Scene
    points: tuple[Modes, ...]
    """One per speed, in order."""
    branches: tuple[Branch, ...]
    """Modes in which rings move, up to ``highest``."""
    lines: tuple[Line, ...]
    """Excitations of their orders."""
    rates: Rates
    """Kinematic frequencies by the states, not by the nominal contact angle; of bearings that differ those of
    the first."""
    highest: float
    """Hz: what lies above is left out."""
    skipped: tuple[tuple[float, str], ...] = ()
    """Speeds (r/min) without equilibrium, and why."""

    @property
    def rpm(self) -> NDArray[np.float64]:
        """Speeds (r/min) in order."""
        return np.array([point.rpm for point in self.points])

    def crossings(self, in_scene: bool = False) -> list[Crossing]:
        """Return the crossings by speed.

        Parameters
        ----------
        in_scene : bool
            Those only that the scene contains and that come within 20 dB of the largest.
        """
        crossings = self._all_crossings
        if in_scene:
            largest = max((crossing.velocity for crossing in crossings), default=0.0)
            return [
                crossing for crossing in crossings if crossing.velocity > largest * 10.0 ** (-WITHIN / 20.0)
            ]
        return list(crossings)

    @cached_property
    def _all_crossings(self) -> list[Crossing]:
        crossings = [
            crossing
            for branch in self.branches
            for line in self.lines
            if can_move(line, branch)
            for crossing in _meet(branch, line, self.rpm)
        ]
        return sorted(crossings, key=lambda crossing: crossing.rpm)

    def nearest(self) -> Crossing | None:
        """Return the crossing of the scene nearest to its operating speed, by ratio; None: there is none."""
        own = abs(self.scene.operation.speed_rpm)
        found = self.crossings(in_scene=True)
        if not found or own == 0.0:
            return None
        return min(found, key=lambda crossing: abs(math.log(abs(crossing.rpm) / own)))

    def verdict(self) -> str:
        """Return the nearest crossing of the scene in a sentence."""
        near, own = self.nearest(), abs(self.scene.operation.speed_rpm)
        if near is None:
            low, high = np.abs(self.rpm[[0, -1]])
            return (
                f"No line that the scene contains meets a mode between {low:,.0f} and {high:,.0f} r/min "
                f"below {1e-3 * self.highest:g} kHz."
            )
        share = abs(near.rpm) / own - 1.0
        side = "above" if share >= 0.0 else "below"
        return (
            f"Nearest: {near.line.name} ({near.line.source}) with {near.branch.label}, "
            f"{abs(near.rpm):,.0f} r/min, {100.0 * abs(share):.1f} % {side} operation, damping ratio "
            f"{100.0 * near.damping:.2g} %."
        )

    def cautions(self) -> list[str]:
        """Return weak damping over the speeds, and speeds that could not be computed, in sentences."""
        sentences = []
        for branch in self.branches:
            least = int(np.argmin(branch.damping))
            if branch.damping[least] < MARGIN:
                word = "grows by itself" if branch.damping[least] < 0.0 else "is hardly damped"
                sentences.append(
                    f"instability margin: '{branch.label}' {word} at {branch.rpm[least]:,.0f} r/min "
                    f"({branch.frequency[least]:.0f} Hz, damping ratio {branch.damping[least]:.4f})"
                )
        sentences += self._unseen()
        sentences += [
            f"{point.rpm:,.0f} r/min: {unsteady(point.linearised)}"
            for point in self.points
            if not point.linearised.steady
        ]
        return sentences + [f"{rpm:,.0f} r/min is left out: {why}" for rpm, why in self.skipped]

    def _unseen(self) -> list[str]:
        """Return the fastest whirl that no branch shows, because balls have most of its energy."""
        grown = [(point.rpm, self_excited(point)) for point in self.points if point.linearised.steady]
        rings = [(rpm, mode) for rpm, mode in grown if mode is not None and not is_of_rings(mode)]
        if not rings:
            return []
        rpm, mode = max(rings, key=lambda one: one[1].growth)
        return [
            f"instability: the {self.points[0].body} whirls by itself at {rpm:,.0f} r/min "
            f"({mode.frequency:.0f} Hz, growth {mode.growth:.0f} 1/s); balls have most of its energy, and no "
            "branch shows it"
        ]

    def table(self) -> list[dict[str, Any]]:
        """Return a row per branch and speed: what `campbell.csv` holds."""
        return [
            {
                "speed_rpm": float(rpm), "frequency_Hz": float(frequency), "damping_ratio": float(damping),
                "mode": branch.name, "direction": branch.direction, "order": branch.order,
            }
            for branch in self.branches
            for rpm, frequency, damping in zip(branch.rpm, branch.frequency, branch.damping, strict=True)
        ]  # fmt: skip

    def records(self) -> list[Crossing]:
        """Return `crossings`."""
        return self.crossings()


def is_of_rings(mode: Mode) -> bool:
    """Whether rings move, not only the turning of the balls."""
    return mode.ring_share > MOVES and not mode.name.startswith(("ball spin", "ball orbit"))


def can_move(line: Line, branch: Branch | Mode) -> bool:
    """Whether order and direction agree; a mode without direction answers to both, turning to none."""
    agree = line.order == branch.order and branch.direction in (line.direction, NEITHER)
    return agree and _SPIN not in branch.name.split()


def _meet(branch: Branch, line: Line, rpm: NDArray[np.float64]) -> list[Crossing]:
    """Crossings of a branch and a line, on curves through the computed speeds."""
    # interpolation wants rising speeds
    order = np.argsort(branch.rpm)
    speeds = branch.rpm[order]
    by_speed = np.argsort(rpm)
    at_speeds = np.interp(speeds, rpm[by_speed], line.frequency[by_speed])
    # the curves have no extremes between the speeds, so without a change of sign there is no root
    if abs(np.sign(branch.frequency[order] - at_speeds).sum()) == speeds.size:
        return []
    excitation = PchipInterpolator(rpm[by_speed], line.frequency[by_speed])
    apart = PchipInterpolator(speeds, branch.frequency[order] - excitation(speeds))
    damping = PchipInterpolator(speeds, branch.damping[order])
    crossings = []
    for root in np.unique(apart.roots(extrapolate=False)):
        frequency, zeta = float(excitation(root)), float(damping(root))
        magnified = 0.5 / max(zeta, MARGIN)  # below it the size of the motion limits itself
        velocity = line.amplitude * 2.0 * math.pi * frequency * magnified
        crossings.append(Crossing(float(root), frequency, zeta, branch, line, velocity))
    return crossings
