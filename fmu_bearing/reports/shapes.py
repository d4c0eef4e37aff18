"""Shapes of modes as numbers that a page can move: rings, their flexure, balls."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import P, Q
from fmu_bearing.modal.campbell import Branch, Campbell
from fmu_bearing.modal.coordinates import Coordinates
from fmu_bearing.modal.drawing import colour
from fmu_bearing.modal.linearised import Linearised
from fmu_bearing.modal.modes import Mode, Modes
from fmu_bearing.reports.blocks import Shapes
from fmu_bearing.reports.campbell import moving

_DIGITS = 4
_BALL_PLACES = 3  # x, r, theta


def moving_shapes(found: Campbell) -> Shapes:
    """Return the shapes of all branches at all their speeds, as the page's script takes them."""
    points = {id(mode): point for point in found.points for mode in point.modes}
    own = abs(found.scene.operation.speed_rpm)
    near = found.nearest()
    chosen = next((k for k, branch in enumerate(found.branches) if near and branch is near.branch), 0)
    start = 0
    if found.branches:
        start = int(np.argmin(np.abs(np.abs(found.branches[chosen].rpm) - own)))
    bearing = found.scene.bearing
    return Shapes(
        "shape", "The chosen mode, enlarged",
        {
            "bearing": {
                "pitch": 0.5 * bearing.pitch_diameter_mm, "ball": 0.5 * bearing.ball_diameter_mm,
                "balls": bearing.ball_count, "width": bearing.width_mm,
                "inner": [0.5 * bearing.bore_mm, 0.5 * bearing.inner_ring_outer_diameter_mm],
                "outer": [0.5 * bearing.outer_ring_inner_diameter_mm, 0.5 * bearing.outside_diameter_mm],
            },
            "branches": [_branch(branch, points) for branch in found.branches],
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
                "what": moving(mode.participation), **shape(points[id(mode)].linearised, mode),
            }
            for rpm, mode in zip(branch.rpm, branch.modes, strict=True)
        ],
    }  # fmt: skip


def shape(system: Linearised, mode: Mode) -> dict[str, Any]:
    """Return the places of a mode as complex amplitudes, the largest motion of a body 1.

    Returns
    -------
    dict
        ``inner`` and ``outer``: x, turn (times the pitch radius), y, z, and tilts about y and z (times the
        pitch radius); ``flexure``: per ring rows of order, amplitudes of cos n theta and sin n theta, and
        what a unit of them moves along x, r and theta; ``balls``: x, r and theta (times the pitch radius) of
        the patterns 1, cos theta, sin theta, ...; ``orbit``, ``shaft``: turns per period of the mode. Complex
        numbers are pairs.
    """
    at, p, vector = system.coordinates, system.arrays.p, mode.vector
    pitch = float(p[P.PITCH_RADIUS])
    rings = vector[at.rings : at.ring_rates]
    outer = rings[Q.OUTER :]
    # the inner ring's turn is an input
    inner = rings[[Q.X, Q.X, Q.Y, Q.Z, Q.INNER_BY, Q.INNER_BZ]] * [1.0, 0.0, 1.0, 1.0, pitch, pitch]
    outside = outer[[Q.X, Q.TURN, Q.Y, Q.Z, Q.BY, Q.BZ]] * [1.0, pitch, 1.0, 1.0, pitch, pitch]
    balls = np.array([vector[at.ball_state(kind)] for kind in range(_BALL_PLACES)])
    balls[2] *= pitch
    bends = _bends(at, p, vector)
    everything = np.concatenate(
        [inner, outside, balls.ravel(), *[np.outer(row[3:], row[1:3]).ravel() for row in bends]]
    )
    largest = everything[int(np.argmax(abs(everything)))]
    # the largest part is at its end when the motion begins
    scale = 1.0 / largest if abs(largest) > 0.0 else 1.0
    turns = abs(mode.value.imag) or 1.0
    flexure: list[list[list[Any]]] = [[], []]
    for row, body in zip(bends, at.bodies, strict=True):
        flexure[body].append(
            [int(row[0].real), *_pairs(scale * row[1:3]), *np.round(row[3:].real, _DIGITS).tolist()]
        )
    return {
        "inner": _pairs(scale * inner), "outer": _pairs(scale * outside), "flexure": flexure,
        "balls": [_pairs(scale * row) for row in balls],
        "orbit": round(system.orbit / turns, 5), "shaft": round(system.speed / turns, 5),
    }  # fmt: skip


def _bends(
    at: Coordinates, p: NDArray[np.float64], vector: NDArray[np.complex128]
) -> list[NDArray[np.complex128]]:
    """Rows of the flexural modes: order, amplitudes of cos and sin, what a unit moves along x, r, theta."""
    places, table = vector[at.flexure : at.flexure_rates], int(p[P.AT_MODES])
    found = []
    for k, order in enumerate(at.orders):
        row = p[table + k * P.MODE_SIZE : table + (k + 1) * P.MODE_SIZE]
        units = row[[P.MODE_X, P.MODE_R, P.MODE_T]]
        found.append(np.array([order, places[2 * k], places[2 * k + 1], *units], dtype=complex))
    return found


def _pairs(values: NDArray[np.complex128]) -> list[list[float]]:
    return [[round(float(value.real), _DIGITS), round(float(value.imag), _DIGITS)] for value in values]
