"""Points of a table over speed and preload: axes that are checked, and the scene at each point."""

from collections.abc import Mapping, Sequence
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.constants import RPM
from fmu_bearing.modal.modes.points import given
from fmu_bearing.scene import Scene
from fmu_bearing.scene.member import still_of
from fmu_bearing.scene.read import with_fidelity


class TablePoints(NamedTuple):
    """Speeds (r/min) and preloads (N), rising, and scene and inputs by speed and preload."""

    speeds: NDArray[np.float64]
    preloads: NDArray[np.float64]
    at: dict[tuple[float, float], tuple[Scene, dict[int, float]]]


def table_points(
    scene: Scene,
    speeds: Sequence[float] | None,
    preloads: Sequence[float] | None,
    inputs: Mapping[str, float] | None,
) -> TablePoints:
    """Return the points of a table; default of both axes: the scene's own value.

    ``inputs``: others of the model by name, SI units.

    Raises
    ------
    ValueError
        For values that are refused.
    """
    fixed = dict(inputs or {})
    for name, instead in (("shaft_speed", "speeds, in r/min"), ("preload", "preloads, in N")):
        if name in fixed:
            raise ValueError(f"{name} is an axis of the table: give {instead}")
    rpm = axis("speeds", "r/min", speeds, [scene.operation.speed_rpm])
    loads = axis("preloads", "N", preloads, [scene.assembly.preload_N])
    if preloads is not None and not scene.assembly.can_preload:
        raise ValueError(f"{scene.name}: has no [spindle.preload] that could be changed: leave preloads out")
    most = scene.most_speed
    if rpm[0] < -most or rpm[-1] > most:
        raise ValueError(f"speeds are refused: allowed are {-most:g} to {most:g} r/min")
    at = {(speed, load): _point(scene, fixed, speed, load) for speed in rpm for load in loads}
    return TablePoints(rpm, loads, at)


def axis(
    name: str, unit: str, values: Sequence[float] | None, default: Sequence[float]
) -> NDArray[np.float64]:
    """Return the values of an axis, rising, each once.

    Raises
    ------
    ValueError
        For what is no finite number.
    """
    try:
        found = np.unique([float(value) for value in (default if values is None else values)])
    except (TypeError, ValueError):
        raise ValueError(f"{name} = {values!r} is refused: give numbers, in {unit}") from None
    if found.size == 0 or not np.isfinite(found).all():
        raise ValueError(f"{name} = {values!r} is refused: give finite numbers, in {unit}")
    return found


def above_zero(values: Sequence[float] | None, default: Sequence[float], why: str) -> NDArray[np.float64]:
    """Return frequencies (Hz), rising, each once; ``ValueError``, with ``why``, where one is not above 0."""
    hertz = axis("frequencies", "Hz", values, default)
    if hertz[0] <= 0.0:
        raise ValueError(f"frequencies: {hertz[0]:g} Hz is refused: {why}")
    return hertz


def _point(
    scene: Scene, fixed: Mapping[str, float], speed: float, preload: float
) -> tuple[Scene, dict[int, float]]:  # fmt: skip
    """Return scene and inputs of a point, checked; a set has its preload in the scene."""
    if not scene.assembly.joined:
        values = {**fixed, "shaft_speed": speed * RPM, "preload": preload}
        return with_fidelity(scene, model="full"), given(scene, values)
    changed: dict[str, Any] = {"operation.speed_rpm": float(speed)}
    if scene.assembly.can_preload:
        changed[scene.assembly.preload_key] = float(preload)
    there = still_of(scene).replace(changed)
    return there, given(there, fixed)
