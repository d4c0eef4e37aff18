"""`receptance`: motion of a scene's nose per force on it, over speed, preload and frequency."""

import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, get_args

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.modal.equations.linearised import Linearised, linearised
from fmu_bearing.modal.equations.remarks import remarks
from fmu_bearing.modal.modes.natural_modes import self_excited
from fmu_bearing.modal.modes.solve import may_grow, solved
from fmu_bearing.modal.receptance import receptance_files
from fmu_bearing.modal.receptance.receptance_picture import picture
from fmu_bearing.modal.receptance.receptance_table import Place, ReceptanceTable
from fmu_bearing.modal.receptance.tool import at_tip, tool_of
from fmu_bearing.modal.receptance.transfer import measurable, transfer
from fmu_bearing.modal.table_points import above_zero, table_points
from fmu_bearing.progress import keeping
from fmu_bearing.results.base import Quantity
from fmu_bearing.scene import Scene, SceneSource, scene_of
from fmu_bearing.scene.exclusions import require
from fmu_bearing.threads import one_thread

if TYPE_CHECKING:
    from matplotlib.figure import Figure

_UNIT = "m/N, 1/N, rad/(N m)"
#: Hz: what a table has where no frequencies are given, evenly spaced as universal files need it.
FREQUENCIES = tuple(float(value) for value in np.linspace(20.0, 5000.0, 2491))


@dataclass(frozen=True)
class Receptance(ReceptanceTable):
    """Motion of the nose per force on it over speed, preload and frequency.

    Examples
    --------
    >>> from fmu_bearing import receptance
    >>> found = receptance("examples/spindle_set/7003C-QBC.toml", [100.0, 2300.0, 2320.0])
    >>> found.G.shape, f"{1e-6 * found.peaks()[1].stiffness:.1f} N/um"
    ((1, 1, 3, 5, 5), '16.0 N/um')
    """

    quantities = (
        "scene = scene.name", "place", "speeds_rpm", "preloads_N", "frequencies_Hz",
        Quantity(f"real [{_UNIT}]", of=lambda found: found.G.real),
        Quantity(f"imaginary [{_UNIT}]", of=lambda found: found.G.imag),
        Quantity("peaks", of=lambda found: found.peaks()), "spread [1]", "steady", "cautions",
    )  # fmt: skip

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write all entries to ``.csv``, SI units, or the ones of x, y, z to ``.uff`` (universal file).

        Raises
        ------
        ValueError
            For another ending, and for ``.uff`` of frequencies that are not evenly spaced.
        OSError
            Where it cannot be written.
        """
        return receptance_files.save(self, path)

    def picture(self) -> "Figure":
        """Draw magnitude and phase by direction, cross terms dashed, a curve per speed and preload.

        Raises
        ------
        MissingExtra
            Without Matplotlib.
        """
        return picture(self)


@one_thread
def receptance(
    scene: SceneSource,
    frequencies: Sequence[float] | None = None,
    *,
    speeds: Sequence[float] | None = None,
    preloads: Sequence[float] | None = None,
    inputs: Mapping[str, float] | None = None,
    at: Place = "nose",
    track: Callable[[Sequence[float]], Iterable[float]] | None = None,
) -> Receptance:
    """Return the receptance of a scene's nose over speed, preload and frequency, without a run.

    Fidelity ``full`` is linearised about the steady state of each speed and preload, as for `modes`. Of a
    single bearing the nose is its inner ring, with the rotor on it, at the centre of the circle of balls.

    Parameters
    ----------
    scene : Scene or path
    frequencies : sequence of float, optional
        Hz, above 0; default: `FREQUENCIES`, 2 Hz apart to 5 kHz.
    speeds : sequence of float, optional
        r/min; default: the scene's own.
    preloads : sequence of float, optional
        N; default: the scene's own.
    inputs : mapping, optional
        Other inputs of the model by name, SI units: ``radial_load.z``, ``inner_ring_temperature``.
    at : {"nose", "tip"}
        ``tip``: of the scene's ``[tool]`` on the nose, by receptance coupling.
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
    >>> from fmu_bearing import receptance
    >>> found = receptance("examples/scenes/7003C-spindle.toml", [20.0, 2000.0], preloads=[200.0, 500.0])
    >>> [f"{1e-6 / abs(found.G[0, k, 0, 1, 1]):.1f} N/um" for k in (0, 1)]
    ['42.0 N/um', '44.7 N/um']
    """
    scene = scene_of(scene)
    require(scene, "receptance")
    if at not in get_args(Place):
        raise ValueError(f"at = {at!r} is refused: it is nose or tip")
    if at == "tip":
        tool_of(scene)
    hertz = above_zero(frequencies, FREQUENCIES, "a receptance is over frequencies above 0")
    rpm, loads, points = table_points(scene, speeds, preloads, inputs)
    rows: list[_Row] = []
    with keeping(rows, lambda: _table(scene, at, rpm[: len(rows)], loads, hertz, rows)):
        for speed in track(list(rpm)) if track else rpm:
            row = _Row(hertz, at)
            for load in loads:
                row.add(*points[speed, load])
            rows.append(row)
    return _table(scene, at, rpm, loads, hertz, rows)


class _Row:
    """What a table has at one speed, a value for each preload."""

    def __init__(self, hertz: NDArray[np.float64], at: Place) -> None:
        self._hertz, self._at = hertz, at
        self.g: list[NDArray[np.complex128]] = []
        self.spread: list[float] = []
        self.steady: list[bool] = []
        self.growing: list[float] = []
        self.remarks: list[str] = []

    def add(self, scene: Scene, inputs: dict[int, float]) -> None:
        """Take the numbers of the next preload."""
        system = linearised(scene, inputs)
        g = measurable(system, self._hertz)
        tip = self._at == "tip"
        self.g.append(at_tip(scene, g, self._hertz, system.speed) if tip else g)
        self.spread.append(_spread(system, self._hertz[:1]))
        self.steady.append(system.steady)
        growing = self_excited(solved(scene, system)) if may_grow(system.matrix) else None
        self.growing.append(0.0 if growing is None else growing.growth)
        self.remarks += remarks(system)


def _table(
    scene: Scene, place: Place, rpm: NDArray[np.float64], loads: NDArray[np.float64],
    hertz: NDArray[np.float64], rows: list[_Row],
) -> Receptance:  # fmt: skip
    return Receptance(
        scene, place, rpm, loads, hertz, np.array([row.g for row in rows]),
        np.array([row.spread for row in rows]), np.array([row.steady for row in rows]),
        np.array([row.growing for row in rows]),
        tuple(dict.fromkeys(line for row in rows for line in row.remarks)),
    )  # fmt: skip


def _spread(system: Linearised, hertz: NDArray[np.float64]) -> float:
    """Return the largest distance of a phase from the mean, of y and z, over it; 0 for equal ball loads."""
    if system.equal_loads:
        return 0.0
    across = slice(1, 3)
    mean = transfer(system, hertz)
    single = np.array([transfer(system, hertz, one) for one in system.phases])
    own, middle = (np.diagonal(part[..., across, across], axis1=-2, axis2=-1) for part in (single, mean))
    return float((np.abs(own - middle) / np.abs(middle)).max())
