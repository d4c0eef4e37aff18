"""`stiffness`: of a scene's bearings over speed, preload and frequency, and of their shaft at its nose."""

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, get_args

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.modal.equations.bearing import BearingLinearised
from fmu_bearing.modal.equations.coordinates import FREEDOMS
from fmu_bearing.modal.equations.linearised import Linearised, under_force
from fmu_bearing.modal.table_points import above_zero, table_points
from fmu_bearing.progress import keeping
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.exclusions import require
from fmu_bearing.steady.impedance import at_rest, impedance, spaced
from fmu_bearing.steady.statics import Statics, point
from fmu_bearing.steady.stiffness.bearing_stiffness import BearingStiffness
from fmu_bearing.steady.stiffness.nose_stiffness import NoseStiffness
from fmu_bearing.steady.stiffness.stiffness_table import Spacing
from fmu_bearing.threads import one_thread

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Hz: what a table has where no frequencies are given.
FREQUENCIES = tuple(float(f"{value:.3g}") for value in np.geomspace(50.0, 10e3, 8))


@dataclass(frozen=True)
class Stiffness(Result):
    """Stiffness of a scene's bearings, and of the shaft that they hold, over speed and preload.

    Examples
    --------
    >>> from fmu_bearing import stiffness
    >>> found = stiffness("examples/spindle_set/7003C-DB.toml", [0.0, 15e3], preloads=[100.0, 200.0])
    >>> (1e-6 * found.named("axial_stiffness")).round(1).tolist()
    [[37.7, 57.1], [36.5, 57.0]]
    >>> f"{1e-6 * found.bearings[0].K[1, 1, 0, 0, 0]:.1f} N/um"
    '33.4 N/um'
    """

    quantities = (
        "scene = scene.name", "speeds_rpm", "preloads_N", "frequencies_Hz",
        Quantity("spacing", of=lambda found: found.bearings[0].spacing), "bearings", "nose", "cautions",
    )  # fmt: skip

    scene: Scene
    speeds: NDArray[np.float64]
    """r/min, rising."""
    preloads: NDArray[np.float64]
    """N, rising: of a single bearing, of spacers, or the force of springs; 0 alone for a set without."""
    frequencies: NDArray[np.float64]
    """Hz, rising: of the bearings' tables."""
    bearings: tuple[BearingStiffness, ...]
    """Stiffness and damping of each bearing, in its own axes."""
    nose: NoseStiffness | None
    """Static stiffness of the shaft at its nose; None for a single bearing."""

    def named(self, attribute: str) -> NDArray[np.float64]:
        """Return a stiffness at the nose, ``nose_stiffness.NAMED``, by its attribute of `Statics`, SI units.

        Shape (speeds, preloads).

        Raises
        ------
        ValueError
            For a single bearing, which has no shaft.
        """
        if self.nose is None:
            raise ValueError(f"{self.scene.name}: one bearing has no nose of a shaft: read bearings[0]")
        return self.nose.named(attribute)

    def cautions(self) -> list[str]:
        """Return what limits these numbers and what a designer should look at, each line once."""
        lines = [] if self.nose is None else self.nose.cautions()
        for bearing in self.bearings:
            name = "" if self.nose is None else f"bearing {bearing.number}: "
            lines += [f"{name}{line}" for line in bearing.cautions()]
        return list(dict.fromkeys(lines))

    def files(self, path: str | os.PathLike[str]) -> tuple[Path, ...]:
        """Return the path for each bearing: ``NAME-1.csv`` and so on of a set, else the path itself."""
        path = Path(path)
        if self.nose is None:
            return (path,)
        return tuple(path.with_stem(f"{path.stem}-{bearing.number}") for bearing in self.bearings)

    def save(self, path: str | os.PathLike[str]) -> tuple[Path, ...]:
        """Write the bearings' tables, ``.csv`` or ``.nc``, to `files`; of a set ``.csv`` has the nose's too.

        Returns
        -------
        tuple of Path
            What was written: the table of the nose, then the tables of the bearings.

        Raises
        ------
        ValueError
            For another ending.
        MissingExtra
            For netCDF without xarray.
        OSError
            Where it cannot be written.
        """
        written = [bearing.save(file) for bearing, file in zip(self.bearings, self.files(path), strict=True)]
        if self.nose is not None and Path(path).suffix == ".csv":
            written.insert(0, self.nose.save(path))
        return tuple(written)

    def picture(self) -> "Figure":
        """Draw stiffness over speed, a curve per preload: of a single bearing, or of the shaft at its nose.

        Raises
        ------
        MissingExtra
            Without Matplotlib.
        """
        return self.bearings[0].picture() if self.nose is None else self.nose.picture()


@one_thread
def stiffness(
    scene: SceneSource,
    speeds: Sequence[float] | None = None,
    frequencies: Sequence[float] | None = None,
    *,
    preloads: Sequence[float] | None = None,
    inputs: Mapping[str, float] | None = None,
    spacing: Spacing = "held",
    track: Callable[[Sequence[float]], Iterable[float]] | None = None,
) -> Stiffness:
    """Return stiffness and damping of a scene's bearings over speed, preload and frequency.

    Fidelity ``full`` is linearised about the steady state of each speed and preload. The outer ring is
    held, the inner ring moves, and the balls follow with all their inertia and friction. Under radial load,
    weight or misalignment the derivatives are a mean over one ball pitch, and `BearingStiffness.spread` is
    how far single phases are from it. Of a set the static stiffness of the shaft at its nose is there too.

    Parameters
    ----------
    scene : Scene or path
    speeds : sequence of float, optional
        r/min; default: the scene's own.
    frequencies : sequence of float, optional
        Hz, above 0; default: `FREQUENCIES`.
    preloads : sequence of float, optional
        N; default: the scene's own.
    inputs : mapping, optional
        Other inputs of the model by name, SI units: ``radial_load.z``, ``inner_ring_temperature``.
    spacing : str
        ``held`` or ``free``, see `BearingStiffness`. At the frequency of the orbit free balls bunch under a
        ring that circles with them, and K has a pole there.
    track : callable, optional
        Wraps the speeds, to show progress.

    Raises
    ------
    SceneError
        If the scene cannot be read, or another model owns its shaft.
    ValueError
        For values that are refused.
    EngineError
        Where there is no equilibrium; a ``ValueError``.
    Stopped
        On Ctrl-C, a `KeyboardInterrupt` with what is finished as ``found``.

    Examples
    --------
    >>> from fmu_bearing import stiffness
    >>> found = stiffness(
    ...     "examples/scenes/7003C-spindle.toml", preloads=[200.0, 500.0], inputs={"radial_load.z": -100.0}
    ... )
    >>> [f"{value / 1e6:.0f} N/um" for value in found.bearings[0].static[0, :, 0, 0]]
    ['34 N/um', '57 N/um']
    """
    scene = scene_of(scene)
    require(scene, "statics")
    if spacing not in get_args(Spacing):
        raise ValueError(f"spacing = {spacing!r} is refused: it is held or free")
    rpm, loads, points = table_points(scene, speeds, preloads, inputs)
    hertz = above_zero(frequencies, FREQUENCIES, "damping needs frequencies above 0")
    filling = [_Filling((len(rpm), len(loads)), hertz, spacing) for _ in scene.bearings()]
    rows: list[tuple[Statics, ...]] = []
    with keeping(rows, lambda: _table(scene, rpm[: len(rows)], loads, hertz, spacing, filling, rows)):
        for i, speed in enumerate(track(list(rpm)) if track else rpm):
            row: list[Statics] = []
            for k, load in enumerate(loads):
                system = _at(points[speed, load], row)
                for one, bearing in zip(filling, system.bearings, strict=True):
                    one.fill(i, k, bearing)
            rows.append(tuple(row))
    return _table(scene, rpm, loads, hertz, spacing, filling, rows)


def _table(
    scene: Scene, rpm: NDArray[np.float64], loads: NDArray[np.float64], hertz: NDArray[np.float64],
    spacing: Spacing, filling: "list[_Filling]", rows: list[tuple[Statics, ...]],
) -> Stiffness:  # fmt: skip
    """Return the tables of the first speeds, of which there are as many as ``rows``."""
    n = len(rpm)
    on_shaft = scene.assembly.joined
    tables = tuple(
        BearingStiffness(
            bearing.scene.with_rigid_rings() if on_shaft else scene, rpm, loads, hertz, one.z.real[:n],
            one.z.imag[:n] / one.w[:, None, None], one.static[:n], one.orbit[:n], one.spread[:n],
            one.steady[:n], spacing, bearing.number, bearing.sign, on_shaft,
        )
        for bearing, one in zip(scene.bearings(), filling, strict=True)
    )  # fmt: skip
    nose = NoseStiffness(scene, rpm, loads, tuple(rows)) if on_shaft else None
    return Stiffness(scene, rpm, loads, hertz, tables, nose)


class _Filling:
    """The table of one bearing while it is filled, see `BearingStiffness`."""

    def __init__(self, shape: tuple[int, int], hertz: NDArray[np.float64], spacing: Spacing) -> None:
        five = (len(FREEDOMS), len(FREEDOMS))
        self.w = 2.0 * math.pi * hertz
        self.z = np.empty((*shape, len(hertz), *five), dtype=complex)
        self.static = np.empty((*shape, *five))
        self.orbit, self.spread, self.steady = np.empty(shape), np.zeros(shape), np.ones(shape, dtype=bool)
        self._ready = spaced if spacing == "held" else _as_it_is

    def fill(self, i: int, k: int, bearing: BearingLinearised) -> None:
        """Take the numbers of the ``i``-th speed and ``k``-th preload."""
        self.z[i, k] = impedance(bearing, self._ready(bearing, bearing.matrix), self.w)
        self.static[i, k] = at_rest(bearing)
        self.steady[i, k] = bearing.steady
        self.orbit[i, k] = abs(bearing.orbit) / (2.0 * math.pi)
        ends = [0, -1]
        for matrix in () if bearing.equal_loads else bearing.phases:
            other = impedance(bearing, self._ready(bearing, matrix), self.w[ends])
            self.spread[i, k] = max(self.spread[i, k], _apart(other, self.z[i, k][ends]))


def _at(scene_and_inputs: tuple[Scene, dict[int, float]], row: list[Statics]) -> Linearised:
    """Return the bearings linearised at a point; the statics of a set go to ``row``."""
    scene, inputs = scene_and_inputs
    if not scene.assembly.joined:
        return under_force(scene, inputs)
    statics = point(scene, inputs)
    row.append(statics.statics)
    return statics.system


def _as_it_is(_bearing: BearingLinearised, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    return matrix


def _apart(one: NDArray[np.complex128], other: NDArray[np.complex128]) -> float:
    """Largest difference of the diagonals over the stiffness of ``other``."""
    a, b = (np.diagonal(part, axis1=-2, axis2=-1) for part in (one, other))
    return float(np.max(np.abs(a - b) / np.abs(b.real)))
