"""Modes as a universal file: shapes at the stations of a shaft, or at the rings of a bearing."""

import os
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.modal.equations.linearised import Linearised
from fmu_bearing.modal.modes import shaft_line
from fmu_bearing.modal.modes.mode import Mode
from fmu_bearing.modal.modes.mode_shape import shape
from fmu_bearing.results.uff import Shape, write_uff
from fmu_bearing.scene import Scene

_WAYS = [0, 2, 3]  # x, y, z among the places of a ring


def write_modes(
    path: str | os.PathLike[str], scene: Scene, system: Linearised, modes: tuple[Mode, ...]
) -> Path:
    """Write shapes, the largest amplitude of each 1; of a bearing the rings are nodes 1 and 2.

    Nodes of a set are along its shaft, from its nose on. Modes in which they do not move, as those of balls
    alone, are left out. Errors as `write_uff`.
    """
    on_shaft = system.shaft.count > 0
    places = shaft_line.stations(scene, system) if on_shaft else [0.0, 0.0]
    shapes = []
    for mode in modes:
        motion = shaft_line.motion(scene, system, mode, places) if on_shaft else _rings(system, mode)
        largest = motion.ravel()[int(np.argmax(abs(motion)))]
        if abs(largest) > 0.0:
            shapes.append(Shape(mode.label, mode.value, motion / largest))
    nodes = {number: (place, 0.0, 0.0) for number, place in enumerate(places, start=1)}
    return write_uff(path, shapes, nodes, scene.name)


def _rings(system: Linearised, mode: Mode) -> NDArray[np.complex128]:
    """Return x, y and z of the inner and the outer ring of a single bearing, shape (2, 3)."""
    found = shape(system.bearings[0], mode.vector, mode.value)
    return np.array([found.inner[_WAYS], found.outer[_WAYS]])
