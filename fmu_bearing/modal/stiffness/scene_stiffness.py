"""Stiffness and damping of a bearing over speed, preload and frequency, for rotor programs."""

import math
import os
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, get_args

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.constants import RPM
from fmu_bearing.modal.equations.bearing import BearingLinearised
from fmu_bearing.modal.equations.linearised import under_force
from fmu_bearing.modal.modes.points import given
from fmu_bearing.modal.stiffness.impedance import FREEDOMS, at_rest, impedance, spaced
from fmu_bearing.modal.stiffness.ross import write
from fmu_bearing.modal.stiffness.stiffness_files import dataset, save
from fmu_bearing.modal.stiffness.stiffness_limits import limits_of
from fmu_bearing.modal.stiffness.stiffness_picture import picture
from fmu_bearing.modal.stiffness.stiffness_table import Spacing, StiffnessTable
from fmu_bearing.scene import SceneSource, scene_of
from fmu_bearing.scene.operation import Operation
from fmu_bearing.scene.problems import allowed
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.values import limits
from fmu_bearing.threads import one_thread

if TYPE_CHECKING:
    import xarray
    from matplotlib.figure import Figure

#: Hz: what a table has where no frequencies are given.
FREQUENCIES = tuple(float(f"{value:.3g}") for value in np.geomspace(50.0, 10e3, 8))


class Stiffness(StiffnessTable):
    """Stiffness and damping of the inner ring against the held outer ring, SI units.

    Forces on the ring are -K q - C q' with q = x, y, z (m) and tilts about y, z (rad), at the centre of the
    circle of balls. The balls' inertia and friction are in K and C; mass, gyroscopic moment and supports of
    the ring are not. Cage, imperfections and sound are left out.

    Attributes
    ----------
    scene : Scene
    speeds : ndarray
        r/min, rising.
    preloads : ndarray
        N, rising: values of the input ``preload``.
    frequencies : ndarray
        Hz, rising.
    K, C : ndarray, shape (speed, preload, frequency, 5, 5)
        N/m, N/rad, N m/rad and these times s.
    static : ndarray, shape (speed, preload, 5, 5)
        K for frequency to 0, always of balls that keep their distances: what the bearing has at rest.
    own : ndarray, shape (preload, 5, 5)
        The same at the scene's own speed.
    orbit : ndarray, shape (speed, preload)
        Hz: frequency of the balls' orbit, f_c.
    spread : ndarray, shape (speed, preload)
        Largest distance of a single phase of a ball pitch from the mean, on the diagonal of K and C w, over
        K, at the lowest and the highest frequency; 0 for equal ball loads.
    steady : ndarray of bool, shape (speed, preload)
        Whether the steady state was found; else the entries hold for the state in which a run starts.
    spacing : str
        ``held``: balls keep their distances along the orbit, as in a cage; ``free``: they do not.

    Examples
    --------
    >>> from fmu_bearing import stiffness
    >>> found = stiffness("examples/scenes/7003C-spindle.toml", [10e3, 20e3], [200.0, 1000.0])
    >>> found.K.shape, f"{found.K[1, 0, 1, 1, 1] / 1e6:.0f} N/um"
    ((2, 1, 2, 5, 5), '159 N/um')
    """

    def cautions(self) -> list[str]:
        """Return what limits these numbers, in sentences."""
        return [*limits_of(self)]

    def to_xarray(self) -> "xarray.Dataset":
        """Return all as a dataset over speed, preload and frequency, the scene as TOML text in ``scene``.

        Raises
        ------
        MissingExtra
            Without xarray.
        """
        return dataset(self)

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write to ``.csv`` (a row per matrix, SI units) or ``.nc`` (netCDF).

        Raises
        ------
        ValueError
            For another ending.
        MissingExtra
            For netCDF without xarray.
        """
        return save(self, path)

    def to_ross(
        self, path: str | os.PathLike[str], preload: float | None = None, *, mirrored: bool = False,
        nodes: tuple[int, int] = (0, 1),
    ) -> tuple[Path, Path]:  # fmt: skip
        """Write two bearing elements for ROSS 3, each a file with half of the bearing; see ``ross``.

        Parameters
        ----------
        path : path
            ``NAME.toml`` makes ``NAME-1.toml`` and ``NAME-2.toml``, for the planes of `planes` in order.
        preload, mirrored
            As for `planes`.
        nodes : tuple of int
            Nodes of the rotor at both planes.

        Raises
        ------
        ValueError
            As for `planes`, for another ending, and for an axis of two to four values.
        """
        return write(self, path, preload, mirrored, nodes)

    def picture(self, frequency: float | None = None) -> "Figure":
        """Draw K and C over speed, a curve per preload, K for frequency to 0 dashed.

        Parameters
        ----------
        frequency : float, optional
            Hz: the nearest one of the table is drawn; default: the middle one.

        Raises
        ------
        MissingExtra
            Without Matplotlib.
        """
        return picture(self, frequency)


@one_thread
def stiffness(
    scene: SceneSource,
    speeds: Sequence[float] | None = None,
    frequencies: Sequence[float] | None = None,
    *,
    preloads: Sequence[float] | None = None,
    inputs: Mapping[str, float] | None = None,
    spacing: Spacing = "held",
    track: Callable[[Sequence[float]], Any] | None = None,
) -> Stiffness:
    """Return stiffness and damping of a scene's bearing over speed, preload and frequency.

    Fidelity ``full`` is linearised about the steady state of each speed and preload. The outer ring is
    held, the inner ring moves, and the balls follow with all their inertia and friction. Under radial load,
    weight or misalignment the derivatives are a mean over one ball pitch, and `Stiffness.spread` tells how
    far single phases are from it.

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
        ``held`` or ``free``, see `Stiffness`. At the frequency of the orbit free balls bunch under a ring
        that circles with them, and K has a pole there.
    track : callable, optional
        Wraps the speeds, to show progress.

    Raises
    ------
    ValueError
        For values that are refused.
    EngineError
        Where there is no equilibrium; a ``ValueError``.

    Examples
    --------
    >>> from fmu_bearing import stiffness
    >>> found = stiffness(
    ...     "examples/scenes/7003C-spindle.toml", preloads=[200.0, 500.0], inputs={"radial_load.z": -100.0}
    ... )
    >>> [f"{value / 1e6:.0f} N/um" for value in found.static[0, :, 0, 0]]
    ['34 N/um', '57 N/um']
    """
    scene = scene_of(scene)
    if scene.spindle is not None:
        raise scene.unmounted("a table of stiffness over frequency", "take `set_stiffness`")
    if spacing not in get_args(Spacing):
        raise ValueError(f"spacing = {spacing!r} is refused: it is held or free")
    fixed = dict(inputs or {})
    for name, instead in (("shaft_speed", "speeds, in r/min"), ("preload", "preloads, in N")):
        if name in fixed:
            raise ValueError(f"{name} is an axis of the table: give {instead}")
    rpm = _axis("speeds", "r/min", speeds, [scene.operation.speed_rpm])
    loads = _axis("preloads", "N", preloads, [scene.mounted.preload_N])
    low, high = limits(Operation.model_fields["speed_rpm"])
    if rpm[0] < low or rpm[-1] > high:
        raise ValueError(f"speeds are refused: allowed are {allowed(('operation', 'speed_rpm'))}")
    hertz = _axis("frequencies", "Hz", frequencies, FREQUENCIES)
    if hertz[0] <= 0.0:
        raise ValueError(f"frequencies: {hertz[0]:g} Hz is refused: damping needs frequencies above 0")
    full = with_fidelity(scene, model="full")

    def point(speed: float, load: float) -> dict[int, float]:
        return given(full, fixed | {"shaft_speed": speed * RPM, "preload": load})

    points = {(speed, load): point(speed, load) for speed in rpm for load in loads}  # all checked first
    shape = (len(rpm), len(loads))
    z = np.empty((*shape, len(hertz), len(FREEDOMS), len(FREEDOMS)), dtype=complex)
    static = np.empty((*shape, len(FREEDOMS), len(FREEDOMS)))
    own = np.empty((len(loads), len(FREEDOMS), len(FREEDOMS)))
    home = scene.operation.speed_rpm
    orbit, spread, steady = np.empty(shape), np.zeros(shape), np.ones(shape, dtype=bool)
    w = 2.0 * math.pi * hertz
    for i, speed in enumerate(track(list(rpm)) if track else rpm):
        for k, load in enumerate(loads):
            system = under_force(full, points[speed, load]).bearings[0]
            ready = spaced if spacing == "held" else _as_it_is
            z[i, k] = impedance(system, ready(system, system.matrix), w)
            static[i, k] = at_rest(system)
            steady[i, k] = system.steady
            orbit[i, k] = abs(system.orbit) / (2.0 * math.pi)
            ends = w[[0, -1]]
            for matrix in () if system.equal_loads else system.phases:
                other = impedance(system, ready(system, matrix), ends)
                spread[i, k] = max(spread[i, k], _apart(other, z[i, k][[0, -1]]))
    for k, load in enumerate(loads):
        there = np.flatnonzero(rpm == home)
        own[k] = (
            static[there[0], k] if there.size else at_rest(under_force(full, point(home, load)).bearings[0])
        )
    damping = z.imag / w[:, None, None]
    return Stiffness(scene, rpm, loads, hertz, z.real, damping, static, own, orbit, spread, steady, spacing)


def _as_it_is(_system: BearingLinearised, matrix: NDArray[np.float64]) -> NDArray[np.float64]:
    return matrix


def _axis(
    name: str, unit: str, values: Sequence[float] | None, default: Sequence[float]
) -> NDArray[np.float64]:
    """Return the values of an axis, rising, each once."""
    try:
        found = np.unique([float(value) for value in (default if values is None else values)])
    except (TypeError, ValueError):
        raise ValueError(f"{name} = {values!r} is refused: give numbers, in {unit}") from None
    if found.size == 0 or not np.isfinite(found).all():
        raise ValueError(f"{name} = {values!r} is refused: give finite numbers, in {unit}")
    return found


def _apart(one: NDArray[np.complex128], other: NDArray[np.complex128]) -> float:
    """Largest difference of the diagonals over the stiffness of ``other``."""
    a, b = (np.diagonal(part, axis1=-2, axis2=-1) for part in (one, other))
    return float(np.max(np.abs(a - b) / np.abs(b.real)))
