"""One bearing linearised in its own axes: constant first-order equations x' = A x in fixed axes.

Coordinates of the balls count in axes that orbit with them, coordinates of the rings in fixed axes, so the
plain derivatives change as the balls orbit. As patterns round the bearing (1, cos k theta, sin k theta, with
theta the angle in fixed axes: Coleman and Feingold 1958, for rotor blades) the balls are in fixed axes, too.
Equal ball loads then give constant coefficients, also on a pedestal of two stiffnesses. Under a radial load,
weight or misalignment they repeat with each ball that passes: their mean over one pitch is used, and the
matrices at single phases show how much that neglects.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from fmu_bearing.engine.layout import STRIDE, C, P, Q, S, U, Y
from fmu_bearing.modal.equations.coordinates import Coordinates
from fmu_bearing.modal.equations.plain import BearingArrays, Plain, flexure

_PHASES = 6  # of one ball pitch
_EQUAL = 1e-12  # m: balls whose places differ less carry equal loads
#: What a pedestal has along y, along z and between both.
_TENSORS = (
    (C.PEDESTAL_Y, C.PEDESTAL_Z, C.PEDESTAL_YZ),
    (C.DAMPING_Y, C.DAMPING_Z, C.DAMPING_YZ),
)


@dataclass(frozen=True)
class BearingLinearised:
    """Small motions x of a bearing by itself: x' = A x, in fixed axes of its own.

    Attributes
    ----------
    coordinates : Coordinates
        What the numbers of x are.
    matrix : ndarray
        A (SI units), mean over the phases, shape (n, n).
    phases : ndarray
        A at single phases of one ball pitch, shape (phases, n, n): one where the balls' loads are equal.
    orbit, spin : float
        rad/s: mean speed of the balls' orbit; mean speed of a ball about its axis in orbiting axes.
    speed : float
        rad/s, of the shaft.
    arrays : BearingArrays
        Parameters, conditions and state at the first phase.
    steady : bool
        Whether the steady state was found; else all holds for the state in which a run starts.
    """

    coordinates: Coordinates
    matrix: NDArray[np.float64]
    phases: NDArray[np.float64]
    orbit: float
    spin: float
    speed: float
    arrays: BearingArrays
    steady: bool

    @cached_property
    def equal_loads(self) -> bool:
        """Whether one phase serves for all: the balls carry equal loads."""
        return len(self.phases) == 1


def phases_of(bearings: Sequence[BearingArrays]) -> int:
    """Return how many phases of a ball pitch serve for bearings: one where all balls carry equal loads."""
    return 1 if all(_even(bearing) for bearing in bearings) else _PHASES


def in_fixed_axes(bearing: BearingArrays, count: int, steady: bool) -> BearingLinearised:
    """Return the derivatives of a bearing about its state, at ``count`` phases of a ball pitch.

    ``steady``: whether the state is the steady one.
    """
    at = Coordinates.of(bearing.p)
    orbit = _mean(bearing, Y.OM)
    pitch = 2.0 * math.pi / at.balls
    phases = np.array([_at_phase(bearing, at, pitch * k / count, orbit) for k in range(count)])
    # about its own axis, against the axes that orbit with the ball
    spin = math.hypot(_mean(bearing, Y.WX) - orbit, _mean(bearing, Y.WR))
    speed = float(bearing.u[U.SPEED])
    return BearingLinearised(at, phases.mean(axis=0), phases, orbit, spin, speed, bearing, steady)


def _of_balls(bearing: BearingArrays, row: int) -> NDArray[np.float64]:
    first = S.Y + row
    return bearing.s[first : first + int(bearing.p[P.BALLS])]


def _mean(bearing: BearingArrays, row: int) -> float:
    return float(np.mean(_of_balls(bearing, row)))


def _even(bearing: BearingArrays) -> bool:
    """Whether all balls have the same place in their bearing."""
    return all(np.ptp(_of_balls(bearing, row)) < _EQUAL for row in (Y.X, Y.R))


def _at_phase(bearing: BearingArrays, at: Coordinates, phase: float, orbit: float) -> NDArray[np.float64]:
    """Return A in fixed axes with the balls ``phase`` (rad) further on; ``orbit``: rad/s of the balls."""
    plain = Plain(_turned(bearing, at, phase), at).derivatives()
    angles = 2.0 * math.pi * np.arange(at.balls) / at.balls + phase
    patterns, rates = at.patterns(angles)
    back = np.linalg.inv(patterns)
    turning = block_diag(*[back @ rates * orbit] * at.BALL_STATES)
    into = block_diag(*[patterns] * at.BALL_STATES, at.turned(phase))
    matrix = np.linalg.solve(into, plain @ into)
    matrix[: at.rings, : at.rings] -= turning
    return np.asarray(matrix)


def _turned(bearing: BearingArrays, at: Coordinates, phase: float) -> BearingArrays:
    """Return the bearing with its balls ``phase`` (rad) further on, in axes that went with them.

    Each ball has the state that one had at its place, interpolated round the bearing. Rings, their flexure
    and the outer ring's pedestal turn back. Loads and misalignment are constant forces, which no derivative
    has, and stay.
    """
    if phase == 0.0:
        return bearing
    further = replace(bearing, s=bearing.s.copy())
    n, lanes = at.balls, int(further.p[P.LANES])
    where = 2.0 * math.pi * np.arange(n) / n
    across = at.patterns(where + phase)[0] @ np.linalg.inv(at.patterns(where)[0])
    y = further.s[S.Y : S.Y + Y.SIZE]
    rows = y[: Y.Q0].reshape(Y.ROWS, -1)
    angle = Y.TH // STRIDE
    rows[angle, :n] -= where  # what is left repeats round the bearing
    rows[:, :n] = rows[:, :n] @ across.T
    rows[angle, :n] += where
    rows[:, n:lanes] = rows[:, :1]
    turn, rings = at.turned(phase), slice(0, Q.RINGS)
    for part in (y[Y.Q0 :][rings], y[Y.V0 :][rings]):
        part[:] = turn[rings, rings] @ part
    bends = flexure(further, at)
    behind = slice(2 * Q.RINGS, 2 * Q.RINGS + bends.size)
    bends[:] = turn[behind, behind] @ bends
    conditions = further.s[S.C : S.C + C.SIZE]
    axes = turn[Q.Y : Q.Z + 1, Q.Y : Q.Z + 1]
    for y_place, z_place, between in _TENSORS:
        tensor = np.array(
            [[conditions[y_place], conditions[between]], [conditions[between], conditions[z_place]]]
        )
        tensor = axes @ tensor @ axes.T
        conditions[y_place], conditions[z_place], conditions[between] = (
            tensor[0, 0],
            tensor[1, 1],
            tensor[0, 1],
        )
    return further
