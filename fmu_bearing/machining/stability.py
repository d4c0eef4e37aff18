"""`lobes`: how deep a scene's spindle may cut over its speeds, before it chatters."""

import math
import os
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.files import check_file
from fmu_bearing.machining.lobes_picture import picture
from fmu_bearing.machining.lobes_result import WARMER, Limit, LobesTable
from fmu_bearing.machining.zero_order import Cut, angles, branches, in_the_cut, limit_at
from fmu_bearing.modal.receptance.receptance_table import Place, ReceptanceTable
from fmu_bearing.modal.receptance.scene_receptance import receptance
from fmu_bearing.modal.table_points import axis
from fmu_bearing.results.base import Quantity, write_rows
from fmu_bearing.scene import Scene, SceneError, SceneSource, scene_of, si
from fmu_bearing.scene.tool import Milling

if TYPE_CHECKING:
    from matplotlib.figure import Figure

#: Of the scene's speed: lowest and highest, and how many speeds between, where none are given.
RANGE, COUNT = (0.25, 1.25), 401
COARSE = 5  # speeds at which the receptance is computed, beside the scene's own
_BETWEEN = 4  # frequencies for each of the receptance, at which its inverse is interpolated
_ACROSS = slice(1, 3)  # y, z


@dataclass(frozen=True)
class Lobes(LobesTable):
    """Limit of the axial depth over speed: milling lobes.

    Examples
    --------
    >>> from fmu_bearing import lobes
    >>> found = lobes("examples/milling/7003C-QBC-end-mill.toml", [18e3, 21e3])
    >>> [f"{1e3 * one.depth:.2f} mm" for one in found.limits]
    ['0.14 mm', '2.20 mm']
    """

    quantities = (
        "scene = scene.name", "place", Quantity("speed_rpm = own.speed"),
        Quantity("depth_mm [mm] = depth", factor=1e3), "judgement", "verdict", "own", "warm", "least",
        Quantity("limits"), Quantity("coarse_rpm [r/min] = coarse"), "cautions",
    )  # fmt: skip

    def save(self, path: str | os.PathLike[str]) -> Path:
        """Write the limits to ``.csv``: speed, depth, frequency.

        Raises
        ------
        ValueError
            For another ending.
        OSError
            Where it cannot be written.
        """
        return write_rows(check_file(path, ".csv", "a table of lobes"), self.limits)

    def picture(self) -> "Figure":
        """Draw the limit over speed with the scene's own cut, and below it the frequency of chatter.

        Raises
        ------
        MissingExtra
            Without Matplotlib.
        """
        return picture(self)


def lobes(
    scene: SceneSource,
    speeds: Sequence[float] | None = None,
    *,
    frequencies: Sequence[float] | None = None,
    inputs: Mapping[str, float] | None = None,
    coarse: int = COARSE,
    track: Callable[[Sequence[float]], Iterable[float]] | None = None,
) -> Lobes:
    """Return how deep a scene's ``[milling]`` may cut over speed, before it chatters; zero order.

    The receptance is that of the tip of the scene's ``[tool]``, or of the nose without one, with its cross
    terms, and follows the speed: it is computed at some speeds, and its inverse is interpolated between them.

    Parameters
    ----------
    scene : Scene or path
    speeds : sequence of float, optional
        r/min, of one sign; default: `COUNT` from a quarter to 1.25 of the scene's, where the bearing may
        turn so.
    frequencies : sequence of float, optional
        Hz, rising: of chatter that is looked for; default: as of `receptance`.
    inputs : mapping, optional
        Inputs of the model by name, SI units, as for `receptance`.
    coarse : int
        Speeds at which the receptance is computed, beside the scene's own.
    track : callable, optional
        Wraps these speeds, to show progress.

    Raises
    ------
    SceneError
        Without ``[milling]``, for a shaft that does not turn, and where another model owns it.
    ValueError
        For values that are refused, and for less radial immersion than 0.25: lobes at twice the tooth period
        are not in a mean.

    Examples
    --------
    >>> from fmu_bearing import lobes
    >>> found = lobes("examples/milling/7003C-QBC-end-mill.toml", [18e3, 20e3, 22e3])
    >>> found.place, found.judgement
    ('tip', 'change')
    """
    scene = scene_of(scene)
    given = _milling(scene)
    own = scene.operation.speed_rpm
    rpm = axis("speeds", "r/min", speeds, list(_usual(scene)))
    if rpm[0] * rpm[-1] <= 0.0 or rpm[0] * own <= 0.0:
        raise ValueError(
            f"speeds are refused: give speeds of the sign of the scene's, {own:g} r/min, without 0"
        )
    most = scene.most_speed
    if np.abs(rpm).max() > most:
        raise ValueError(f"speeds are refused: allowed are up to {most:g} r/min")
    values = si(given)
    cut = Cut(
        given.teeth, values.cutting_coefficient, given.radial_ratio,
        *angles(given.radial_immersion, given.direction),
    )  # fmt: skip
    place: Place = "nose" if scene.tool is None else "tip"
    grid = [own] if len(rpm) == 1 and rpm[0] == own else [*np.linspace(rpm[0], rpm[-1], coarse), own]
    table = receptance(scene, frequencies, speeds=grid, inputs=inputs, at=place, track=track)
    stiff = _stiffness(table, values.feed_angle)
    found = [_limit(cut, table, stiff, float(speed)) for speed in (*rpm, own)]
    return Lobes(
        scene, place, tuple(found[:-1]), found[-1], tuple(map(float, table.speeds)),
        _warmed(scene, cut, frequencies, inputs), tuple(table.cautions()),
    )  # fmt: skip


def _warmed(
    scene: Scene, cut: Cut, frequencies: Sequence[float] | None, inputs: Mapping[str, float] | None
) -> Limit | None:
    """Return the limit at the scene's own speed with inner rings that are `WARMER`; None: no equilibrium."""
    key = "inner_ring_temperature_degC"
    values = {f"operation.{key}": getattr(scene.operation, key) + WARMER}
    for number, member in enumerate(scene.assembly.members, start=1):
        if (own := getattr(member, key)) is not None:
            values[f"{scene.assembly.temperature_table(number)}.{key}"] = own + WARMER
    try:
        warm = scene.replace(values)
        table = receptance(warm, frequencies, inputs=inputs, at="nose" if scene.tool is None else "tip")
    except ValueError:  # hotter than a scene may be, or pressed together until nothing holds
        return None
    stiff = _stiffness(table, si(_milling(scene)).feed_angle)
    return _limit(cut, table, stiff, scene.operation.speed_rpm)


def _milling(scene: Scene) -> Milling:
    """Return the cut of a scene that turns."""
    if scene.milling is None:
        raise SceneError(
            f"{scene.name}: there is no cut to judge: give [milling] with teeth, cutting_coefficient_N_mm2 "
            "and radial_immersion"
        )
    if scene.operation.speed_rpm == 0.0:
        raise SceneError(f"{scene.name}: its shaft does not turn, so no tooth cuts: give operation.speed_rpm")
    return scene.milling


def _usual(scene: Scene) -> NDArray[np.float64]:
    own = scene.operation.speed_rpm
    low, high = (abs(own) * share for share in RANGE)
    return np.asarray(math.copysign(1.0, own) * np.linspace(low, min(high, scene.most_speed), COUNT))


def _stiffness(table: ReceptanceTable, feed: float) -> NDArray[np.complex128]:
    """Return the inverse of the receptance in the axes of the cut, shape (speeds, frequencies, 2, 2)."""
    across = table.G[:, 0, :, _ACROSS, _ACROSS]
    return _inverse(in_the_cut(across, feed, bool(table.speeds[0] > 0.0)))


def _inverse(matrices: NDArray[np.complex128]) -> NDArray[np.complex128]:
    return np.asarray(np.linalg.inv(matrices), dtype=np.complex128)


def _limit(cut: Cut, table: ReceptanceTable, stiff: NDArray[np.complex128], rpm: float) -> Limit:
    """Return the limit at a speed; between two speeds the inverse of the receptance is interpolated."""
    grid = table.speeds
    if len(grid) == 1:
        here = stiff[0]
    else:
        k = int(np.clip(np.searchsorted(grid, rpm) - 1, 0, len(grid) - 2))
        share = (rpm - grid[k]) / (grid[k + 1] - grid[k])
        here = stiff[k] + share * (stiff[k + 1] - stiff[k])
    hertz, here = _finer(table.frequencies, here)
    return Limit(rpm, *limit_at(cut, branches(cut, _inverse(here)), hertz, rpm))


def _finer(
    hertz: NDArray[np.float64], stiff: NDArray[np.complex128]
) -> tuple[NDArray[np.float64], NDArray[np.complex128]]:
    """Return frequencies with more between them, and stiffness there: it is smooth where receptance peaks."""
    share = np.arange(_BETWEEN) / _BETWEEN
    fine = np.append((hertz[:-1, None] + share * np.diff(hertz)[:, None]).ravel(), hertz[-1:])
    steps = np.diff(stiff, axis=0)[:, None]
    between = stiff[:-1, None] + share[:, None, None] * steps
    return fine, np.concatenate([between.reshape(-1, 2, 2), stiff[-1:]])
