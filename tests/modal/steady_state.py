"""Oracle of the steady state: Newton's method for what is the same for all balls, bearings without cages.

The engine's own equations, differentiated by differences. A state is moved in the motions that all balls
share, in a set with the coordinates of shaft, housing and sliding rings along the axis, until nothing
accelerates.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import SP, P, Q, S, U, Y
from fmu_bearing.modal.equations.coordinates import Coordinates
from fmu_bearing.modal.equations.linearised import bearing_of
from fmu_bearing.modal.equations.plain import MOVE, RATE, BearingArrays, Plain
from fmu_bearing.modal.equations.shaft import ShaftMatrices, matrices, rows_of

_ROUNDS = 30
# Steps of the differences by which balls move against rings in a round, 0.5 um: contacts stay closed. What
# rings and balls do together, as on a soft pedestal, changes no contact and has no limit.
_LONGEST = 500.0
_SETTLED = 0.1  # of such steps: what the last round may move
_SPARED = 1e-9  # singular values below this share belong to motions that nothing holds
_ORBIT_ANGLE = 2  # ball state whose rate is the orbit itself


@dataclass(frozen=True)
class Tie:
    """What ties the bearings of a set along its axis, over its m coordinates that move along or about it.

    Attributes
    ----------
    load : ndarray, shape (m,)
        N: forces at the state where the bearings start, without forces of the bearings.
    stiffness, inverse : ndarray, shape (m, m)
        SI units; the inverse is that of the mass with all driven rings.
    motions : sequence of ndarray, shape (rows, m)
        Driven rows of each bearing's rings.
    inertia : sequence of ndarray, shape (rows,)
    """

    load: NDArray[np.float64]
    stiffness: NDArray[np.float64]
    inverse: NDArray[np.float64]
    motions: Sequence[NDArray[np.float64]]
    inertia: Sequence[NDArray[np.float64]]


def tie(run: Arrays, shaft: ShaftMatrices) -> Tie:
    """Return what ties the bearings where the run starts: shaft, housing and sliding rings along the axis."""
    head, n = run.p[int(run.p[P.SET]) :], shaft.count
    own = run.s[int(head[SP.AT_S]) :]
    lanes = SP.padded_size(n)
    q, held = own[SP.S_HEAD : SP.S_HEAD + n], own[SP.S_HEAD + SP.STATIC_LOAD * lanes :][:n]
    along = np.zeros(n, dtype=bool)
    along[:1] = True  # the whole shaft's
    along[shaft.shaft_count :] = True
    if shaft.housed:
        along[shaft.shaft_count : shaft.shaft_count + SP.HOUSING] = np.isin(
            np.arange(SP.HOUSING), (Q.X, Q.TURN)
        )
    at = np.ix_(along, along)
    return Tie(
        (held - shaft.stiffness @ q)[along], shaft.stiffness[at], shaft.inverse[at],
        [motion[:, along] for motion in shaft.motions], shaft.inertia,
    )  # fmt: skip


def settle(bearings: Sequence[Arrays | BearingArrays], tie: Tie | None = None) -> bool:
    """Move the states of bearings to the steady ones; False, and states as they were, where none is near.

    ``tie``: of a set; None: nothing ties the bearings.
    """
    parts = [_Part(one, None if tie is None else tie.inertia[k].size) for k, one in enumerate(bearings)]
    whole = _Whole(parts, tie)
    for _ in range(_ROUNDS):
        matrix, residual = whole.equations()
        if not (np.isfinite(matrix).all() and np.isfinite(residual).all()):
            return False
        change = np.linalg.lstsq(
            matrix * whole.scale / whole.heights[:, None], -residual / whole.heights, rcond=_SPARED
        )[0]  # fmt: skip
        largest = float(np.abs(change).max())
        if not np.isfinite(largest):
            return False
        whole.move(change * whole.scale)
        if largest < _SETTLED:
            for part in parts:
                part.keep()
            return True
    return False


class _Moved(Plain):
    """The equations of a bearing whose state moves."""

    def along(self, directions: NDArray[np.float64]) -> NDArray[np.float64]:
        """Return the derivatives of x' along directions in x, shape (n, directions)."""
        found = np.empty(directions.shape)
        for k, direction in enumerate(directions.T):
            step = float(np.min(self._steps[direction != 0.0] / np.abs(direction[direction != 0.0])))
            before = self.y.copy(), self._w.copy()
            self.move(step * direction)
            ahead = self.rates()
            self.y[:], self._w[:] = before
            self.move(-step * direction)
            found[:, k] = (ahead - self.rates()) / (2.0 * step)
            self.y[:], self._w[:] = before
        return found

    def move(self, change: NDArray[np.float64]) -> None:
        """Move the state by a change of x."""
        self.y[self._at_y] += change[: self._bodies]
        self._w[self._at_w] += change[self._bodies :]


class _Part:
    """One bearing: motions that are equal for all its balls, and its rings along and about the axis."""

    def __init__(self, bearing: Arrays | BearingArrays, driven: int | None) -> None:
        self.bearing, self.at = bearing, Coordinates.of(bearing.p)
        self.plain = _Moved(bearing, self.at)
        self.spread, self.mean = _even_motions(self.at)
        self.driven = self.at.ring_rates + np.arange(driven or 0)
        led = np.zeros(self.at.size)
        led[self.driven] = led[self.driven - Q.RINGS] = 1.0
        self.own = self.spread.T @ led == 0.0
        # in steps of the differences all motions weigh the same
        self.scale = self.spread.T @ self.plain.steps() / np.maximum(self.spread.sum(axis=0), 1.0)
        # balls along and across the axis, and along it against both rings
        first = [int(self.spread[place].argmax()) for place in (0, self.at.balls)]
        rings = self.at.rings + np.array([Q.INNER, Q.OUTER])
        self._against = np.eye(len(self.scale))[[first[1], first[0], first[0]]]
        self._against[1:] -= self.spread[rings]
        self.follow = np.zeros((len(self.scale), 0))  # how these motions follow the unknowns of the whole

    def apart(self, change: NDArray[np.float64]) -> float:
        """Largest motion of balls against rings for a change of all unknowns, in steps of the differences."""
        return float(np.abs(self._against @ (self.follow @ change)).max() / self.scale[0])

    def keep(self) -> None:
        """Write the settled state back; spare lanes follow the first ball."""
        y = self.plain.y
        rows = y[: Y.Q0].reshape(Y.ROWS, -1)
        rows[:, self.at.balls : int(self.bearing.p[P.LANES])] = rows[:, :1]
        self.bearing.s[S.Y : S.Y + Y.SIZE] = y


class _Whole:
    """All bearings, alone or tied: unknowns are their own even motions, then the tie's coordinates."""

    def __init__(self, parts: list[_Part], tie: Tie | None) -> None:
        self.parts, self.tie = parts, tie
        tied = 0 if tie is None else tie.load.size
        scales = [part.scale[part.own] for part in parts]
        self.first = sum(scale.size for scale in scales)
        self.gone = np.zeros(tied)  # m, rad: of the tie's coordinates since the start
        self.scale = np.concatenate([*scales, np.full(tied, MOVE)])
        self.heights = np.concatenate([*scales, np.full(tied, RATE)])
        begin = 0
        for k, (part, scale) in enumerate(zip(parts, scales, strict=True)):
            part.follow = np.zeros((part.scale.size, self.scale.size))
            part.follow[part.own, begin + np.arange(scale.size)] = 1.0
            if tie is not None:
                part.follow[:, self.first :] = part.spread[part.driven - Q.RINGS].T @ tie.motions[k]
            begin += scale.size

    def equations(self) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the derivatives of what must vanish by the unknowns, and what must vanish."""
        slopes = [part.plain.along(part.spread) @ part.follow for part in self.parts]
        rates = [part.plain.rates() for part in self.parts]
        rows = [part.mean[part.own] @ slope for part, slope in zip(self.parts, slopes, strict=True)]
        out = [part.mean[part.own] @ rate for part, rate in zip(self.parts, rates, strict=True)]
        if self.tie is not None:
            force = self.tie.load - self.tie.stiffness @ self.gone
            by = np.zeros((self.gone.size, self.scale.size))
            by[:, self.first :] = -self.tie.stiffness
            for k, part in enumerate(self.parts):
                pull = self.tie.motions[k].T * self.tie.inertia[k]
                force = force + pull @ rates[k][part.driven]
                by += pull @ slopes[k][part.driven]
            rows.append(self.tie.inverse @ by)
            out.append(self.tie.inverse @ force)
        return np.concatenate(rows), np.concatenate(out)

    def move(self, change: NDArray[np.float64]) -> None:
        """Change the unknowns, by no more than contacts stay closed for."""
        change = change * min(1.0, _LONGEST / max(1e-300, *(part.apart(change) for part in self.parts)))
        self.gone += change[self.first :]
        for part in self.parts:
            part.plain.move(part.spread @ (part.follow @ change))


def _even_motions(at: Coordinates) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return what spreads motions that are equal for all balls over x, and what takes their mean from x'.

    They are the balls' states but the angle of the orbit, and the rings along and about the axis.
    """
    columns = []
    for kind in range(at.BALL_STATES):
        if kind != _ORBIT_ANGLE:
            column = np.zeros(at.size)
            column[at.ball_state(kind)] = 1.0
            columns.append(column)
    for first in (at.rings, at.ring_rates):
        for i in (Q.INNER, Q.OUTER, Q.OUTER + Q.TURN):
            if not (at.held and i == Q.INNER):
                column = np.zeros(at.size)
                column[first + i] = 1.0
                columns.append(column)
    spread = np.array(columns).T
    return spread, (spread / spread.sum(axis=0)).T


def settled(run: Arrays) -> list[BearingArrays]:
    """Return the bearings of an initialised scene without cages, moved to the steady state."""
    speed = float(run.u[U.SPEED])
    bearings = [bearing_of(run, row, speed) for row in rows_of(run.p)]
    assert settle(bearings, tie(run, matrices(run, speed)))
    return bearings
