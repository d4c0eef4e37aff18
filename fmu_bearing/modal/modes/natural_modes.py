"""Natural motions of a mounted bearing, or of a set on its shaft: modes, cautions, table."""

import math
import os
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.modal.equations.linearised import Linearised
from fmu_bearing.modal.equations.remarks import remarks
from fmu_bearing.modal.modes import shaft_line
from fmu_bearing.modal.modes.energies import modal_assurance
from fmu_bearing.modal.modes.mode import (
    GROWS,
    LOWEST,
    MOVES,
    SPREAD,
    Mode,
    grouped,
    groups_of,
    weak_words,
)
from fmu_bearing.modal.modes.mode_files import write_modes
from fmu_bearing.modal.modes.mode_shape import Shape, shape
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.scene import Scene

if TYPE_CHECKING:
    from matplotlib.figure import Figure

STICKING = 1e-3  # of a revolution per second: slower, contacts stick


@dataclass(frozen=True)
class Modes(Result):
    """Modes of a bearing, or of a set, at one operating point.

    Examples
    --------
    >>> from fmu_bearing import modes
    >>> found = modes("examples/scenes/7003C-spindle.toml", {"preload": 300.0})
    >>> mode = found.near(2000.0)
    >>> mode.name, mode.order, bool(mode.damping > 0.0)
    ('inner radial', 1, True)
    """

    quantities = (
        "scene = scene.name", "speed_rpm = rpm", "modes = records",
        Quantity("apart", of=lambda found: found.records(apart=True)), "cautions",
    )  # fmt: skip

    scene: Scene
    rpm: float
    """Speed (r/min)."""
    modes: tuple[Mode, ...]
    """The ones that ring, by frequency; of a set the ones in which shaft, housing or rings move."""
    apart: tuple[Mode, ...]
    """Neutral and overdamped motions, which show as no peak; of a set motions of balls alone, too."""
    linearised: Linearised
    """The equations they belong to."""
    friction: bool = True
    """Whether contacts have friction."""

    def near(self, frequency: float) -> Mode:
        """Return the mode nearest to a frequency (Hz), by ratio."""
        if not (math.isfinite(frequency) and frequency > 0.0):
            raise ValueError(f"frequency = {frequency} Hz is refused: give a positive number of hertz")
        if not self.modes:
            raise ValueError(f"{self.scene.name}: nothing rings at {self.rpm:,.0f} r/min; see `apart`")
        return min(self.modes, key=lambda mode: abs(math.log(mode.frequency / frequency)))

    @property
    def on_shaft(self) -> bool:
        """Whether a set on its shaft moves, not a single bearing."""
        return self.linearised.shaft.count > 0

    @property
    def body(self) -> str:
        """What whirls, in a word: ``ring``, or ``set``."""
        return "set" if self.on_shaft else "ring"

    def shape(self, mode: Mode | int) -> Shape:
        """Return how rings and balls of a single bearing move in a mode, or in the one at a place in `modes`.

        Raises
        ------
        ValueError
            For a set, see `line` and `picture`.
        """
        if self.on_shaft:
            raise ValueError(
                f"{self.scene.name}: `shape` is for one bearing: `line` returns the motion of the shaft"
            )
        chosen = self._chosen(mode)
        return shape(self.linearised.bearings[0], chosen.vector, chosen.value)

    def line(self, mode: Mode | int, places: Sequence[float] | None = None) -> NDArray[np.complex128]:
        """Return y and z of a set's shaft along it, shape (2, places), over the largest of both.

        ``places``: m from the nose; default: nose and bearings. The real parts times e^(i w t) are
        the motion.

        Raises
        ------
        ValueError
            For a single bearing, see `shape`.
        """
        self._need_shaft("a line")
        return shaft_line.line(self.scene, self.linearised, self._chosen(mode), places)

    def picture(self) -> "Figure":
        """Draw the line of a set's shaft in its lowest modes across; needs the extra ``plots``.

        Raises
        ------
        ValueError
            For a single bearing, see `shape`.
        """
        self._need_shaft("the picture of a line")
        return shaft_line.picture(self.scene, self.linearised, self.modes, self.rpm)

    def save(self, path: str | os.PathLike[str]) -> Any:
        """Write `summary` and `records` as `Result.save`, or shapes to ``.uff``; return the file.

        A universal file has, for programs of modal analysis, eigenvalues, damping in them, and motions along
        x, y and z at stations of a set's shaft, or of the two rings of a bearing.
        """
        if Path(path).suffix == ".uff":
            return write_modes(path, self.scene, self.linearised, self.modes)
        return super().save(path)

    def _need_shaft(self, what: str) -> None:
        if not self.on_shaft:
            raise ValueError(
                f"{self.scene.name}: {what} is for the shaft of a set: `shape` returns a bearing's motion"
            )

    def _chosen(self, mode: Mode | int) -> Mode:
        return self.modes[mode] if isinstance(mode, int) else mode

    def named(self, name: str, direction: str = "") -> Mode:
        """Return the lowest mode of a name, such as ``inner radial``, and a direction if one is given."""
        for mode in self.modes:
            if mode.name == name and direction in ("", mode.direction):
                return mode
        names = ", ".join(dict.fromkeys(mode.label for mode in self.modes))
        wanted = f"{name} {direction}".rstrip()
        raise ValueError(f"there is no mode '{wanted}'; there are {names}")

    def weak(self) -> tuple[Mode, ...]:
        """Return the modes near or beyond the limit of stability: a damping ratio below ``MARGIN``.

        Balls that move alone are left out, unless rings move with them and the motion grows: they are free
        along their orbits.
        """
        return tuple(mode for mode in self.modes if mode.remark)

    def cautions(self) -> list[str]:
        """Return what limits these modes, in sentences."""
        sentences = [weak_words(mode) for mode in self.weak()] if self.friction else []
        sentences += remarks(self.linearised)
        of_rings = [mode for mode in self.modes if mode.ring_share > MOVES]
        spread = max((mode.spread for mode in of_rings), default=0.0)
        if spread > SPREAD:
            worst = max(of_rings, key=lambda mode: mode.spread)
            sentences.append(
                f"loads differ from ball to ball: '{worst.label}' moves by {100 * spread:.1f} % of its "
                "frequency while one ball pitch passes, so lines appear beside it; frequencies are means"
            )
        if self.friction and abs(self.rpm) < 60.0 * STICKING:
            sentences.append(
                "the shaft does not turn, so contacts stick; once they slide, the modes without friction hold"
            )
        if any(one.cage is not None for one in self.scene.geometries):
            sentences.append("the cage and its films are left out: it touches balls and lands with clearance")
        return sentences

    def records(self, highest: float = 50e3, apart: bool = False) -> list[Mode]:
        """Return the modes that a table has.

        Rows of balls alone that differ by their order only are one row.

        Parameters
        ----------
        highest : float
            Hz: modes above it are left out.
        apart : bool
            The neutral and overdamped motions instead.
        """
        chosen = [mode for mode in (self.apart if apart else self.modes) if mode.frequency <= highest]
        rows: list[Mode] = []
        alone: list[Mode] = []
        for mode in chosen:
            if mode.name.startswith("ball") and mode.order > 1 and mode.order not in self._bent:
                alone.append(mode)
            else:
                rows.append(mode)
        rows += [grouped(group) for group in groups_of(alone)]
        return sorted(rows, key=lambda row: row.frequency)

    def modal_assurance(self, before: list[Mode], now: list[Mode]) -> NDArray[np.float64]:
        """Return the modal assurance criterion of modes before against modes now, by kinetic energy."""
        one, other = (np.array([mode.vector for mode in some]).T for some in (before, now))
        return modal_assurance(one, other, self.linearised.masses)

    @property
    def _bent(self) -> set[int]:
        """Orders in which rings bend."""
        return {order for bearing in self.linearised.bearings for order in bearing.coordinates.orders}


def self_excited(modes: Modes) -> Mode | None:
    """Return the mode in which rings move that grows fastest by itself, by `GROWS` or more; None: none does.

    Its largest part may be the balls' orbits: at 7008AC, 20,000 r/min, 150 N balls have 85 % of its energy.
    One that takes long to grow beside a multiple of the orbit's speed is among `Modes.apart`.
    """
    growing = [
        one
        for one in (*modes.modes, *modes.apart)
        if one.growth > GROWS and one.ring_share > MOVES and one.frequency > LOWEST
    ]
    return max(growing, key=lambda one: one.growth, default=None)
