"""Shapes of modes as numbers that a page can move: rings, their flexure, balls."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.modal.campbell.diagram import Branch
from fmu_bearing.modal.campbell.diagram_style import colour
from fmu_bearing.modal.campbell.over_speed import Campbell
from fmu_bearing.modal.modes.mode_shape import Shape
from fmu_bearing.modal.modes.natural_modes import Modes
from fmu_bearing.reports.modes.campbell_chart import moving
from fmu_bearing.reports.page.blocks import Shapes

_DIGITS = 4


def moving_shapes(diagram: Campbell) -> Shapes:
    """Return the shapes of all branches at all their speeds, as the page's script takes them."""
    points = {id(mode): point for point in diagram.points for mode in point.modes}
    own = abs(diagram.scene.operation.speed_rpm)
    near = diagram.nearest()
    chosen = next((k for k, branch in enumerate(diagram.branches) if near and branch is near.branch), 0)
    start = 0
    if diagram.branches:
        start = int(np.argmin(np.abs(np.abs(diagram.branches[chosen].rpm) - own)))
    bearing = diagram.scene.bearing
    return Shapes(
        "shape", "The chosen mode, enlarged",
        {
            "bearing": {
                "pitch": 0.5 * bearing.pitch_diameter_mm, "ball": 0.5 * bearing.ball_diameter_mm,
                "balls": bearing.ball_count, "width": bearing.width_mm,
                "inner": [0.5 * bearing.bore_mm, 0.5 * bearing.inner_ring_outer_diameter_mm],
                "outer": [0.5 * bearing.outer_ring_inner_diameter_mm, 0.5 * bearing.outside_diameter_mm],
            },
            "branches": [_branch(branch, points) for branch in diagram.branches],
            "chosen": [chosen, start],
        },
        "Rings and balls of the bearing, moving as in the chosen mode: seen from +X, and cut along the axis.",
    )  # fmt: skip


def _branch(branch: Branch, points: dict[int, Modes]) -> dict[str, Any]:
    return {
        "label": branch.label,
        "colour": colour(branch.name),
        "points": [
            {
                "rpm": round(abs(float(rpm)), 1), "frequency": round(mode.frequency, 2),
                "damping": round(mode.damping, 5), "direction": mode.direction, "order": mode.order,
                "what": moving(mode.participation), **_numbers(points[id(mode)].shape(mode)),
            }
            for rpm, mode in zip(branch.rpm, branch.modes, strict=True)
        ],
    }  # fmt: skip


def _numbers(shape: Shape) -> dict[str, Any]:
    """Shape as the page's script takes it: complex numbers are pairs, bending by ring."""
    flexure: list[list[list[Any]]] = [[], []]
    for bend in shape.bends:
        units = np.round([bend.x, bend.r, bend.theta], _DIGITS).tolist()
        flexure[bend.ring].append([bend.order, *_pairs(np.array([bend.cosine, bend.sine])), *units])
    return {
        "inner": _pairs(shape.inner), "outer": _pairs(shape.outer), "flexure": flexure,
        "balls": [_pairs(row) for row in shape.patterns],
        "orbit": round(shape.orbit, 5), "shaft": round(shape.shaft, 5),
    }  # fmt: skip


def _pairs(values: NDArray[np.complex128]) -> list[list[float]]:
    return [[round(float(value.real), _DIGITS), round(float(value.imag), _DIGITS)] for value in values]
