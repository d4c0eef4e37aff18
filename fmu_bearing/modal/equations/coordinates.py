"""What the numbers of a linearised bearing are: balls by kind and pattern, rings, flexure; their inertia."""

import math
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import block_diag

from fmu_bearing.engine.layout import FL, F, P, Q, W, Y

#: Motions of an inner ring or of a shaft's nose: m, and tilts (rad).
FREEDOMS = ("x", "y", "z", "by", "bz")
_PLACES = (Y.X, Y.R, Y.TH)
_RATES = (Y.VX, Y.VR, Y.OM, Y.WX, Y.WR, Y.WT)
_ACCELERATIONS = (F.X, F.R, F.TH, F.WX, F.WR, F.WT)
_PAIRS = (
    (Q.Y, Q.Z),
    (Q.INNER_BY, Q.INNER_BZ),
    (Q.OUTER + Q.Y, Q.OUTER + Q.Z),
    (Q.OUTER + Q.BY, Q.OUTER + Q.BZ),
)


@dataclass(frozen=True)
class Coordinates:
    """Order of the numbers: for each of nine ball states its patterns, then rings, then flexure.

    Ball states: places x, r (m), theta (rad), their rates, spin about x, r, theta (rad/s). Patterns: 1, then
    cos k theta and sin k theta for k = 1, 2, ..., and for an even number of balls one that alternates, in
    orbiting axes. Rings: 11 places (layout Q), 11 rates. Flexure: two places per mode (m), then their rates.

    Attributes
    ----------
    balls : int
        Number of balls.
    masses : ndarray
        Inertia of the rates: balls (kg, kg m2; 0 for places), rings, flexure; shape (n,).
    orders : tuple of int
        Circumferential order of each flexural mode.
    bodies : tuple of int
        Its ring: 0 inner, 1 outer.
    held : bool
        Whether rigid preload holds the inner ring along its axis.
    """

    balls: int
    masses: NDArray[np.float64]
    orders: tuple[int, ...]
    bodies: tuple[int, ...]
    held: bool

    BALL_STATES = len(_PLACES) + len(_RATES)

    @classmethod
    def of(cls, p: NDArray[np.float64]) -> "Coordinates":
        """Return the coordinates of a bearing with the parameters ``p``."""
        balls, modes, table = int(p[P.BALLS]), int(p[P.MODES]), int(p[P.AT_MODES])
        rows = [p[table + k * P.MODE_SIZE : table + (k + 1) * P.MODE_SIZE] for k in range(modes)]
        pitch = p[P.PITCH_RADIUS]
        own = [p[P.BALL_MASS]] * 2 + [p[P.BALL_MASS] * pitch**2] + [p[P.BALL_INERTIA]] * 3
        # a sum over the balls of squares of a pattern: all for the even and the alternating one, half else
        count = np.full(balls, 0.5 * balls)
        count[0] = balls
        if balls % 2 == 0:
            count[-1] = balls
        of_balls = np.concatenate([np.zeros(len(_PLACES) * balls), np.outer(own, count).ravel()])
        # in the order of layout Q: translations and tilts, of the outer ring its rotation between them
        places = [P.INNER_MASS] * 3 + [P.INNER_TRANSVERSE] * 2
        places += [P.OUTER_MASS] * 3 + [P.OUTER_POLAR] + [P.OUTER_TRANSVERSE] * 2
        rings = [float(p[place]) for place in places]
        flexure = np.repeat([row[P.MODE_MASS] for row in rows], 2) if rows else np.zeros(0)
        masses = np.concatenate([of_balls, np.zeros(Q.RINGS), rings, np.zeros(2 * modes), flexure])
        orders = tuple(int(row[P.MODE_ORDER]) for row in rows)
        return cls(balls, masses, orders, tuple(int(row[P.MODE_BODY]) for row in rows), bool(p[P.RIGID]))

    @property
    def flexural(self) -> int:
        """Number of flexural modes."""
        return len(self.orders)

    @property
    def rings(self) -> int:
        """First number of the rings."""
        return self.BALL_STATES * self.balls

    @property
    def ring_rates(self) -> int:
        """First number of the rings' rates."""
        return self.rings + Q.RINGS

    @property
    def flexure(self) -> int:
        """First number of the flexure's places."""
        return self.rings + 2 * Q.RINGS

    @property
    def flexure_rates(self) -> int:
        """First number of its rates."""
        return self.flexure + 2 * self.flexural

    @property
    def size(self) -> int:
        """How many numbers."""
        return self.flexure + 4 * self.flexural

    @property
    def is_place(self) -> NDArray[np.bool_]:
        """Which numbers are places, not rates."""
        places = np.zeros(self.size, dtype=bool)
        places[: len(_PLACES) * self.balls] = True
        places[self.rings : self.ring_rates] = True
        places[self.flexure : self.flexure_rates] = True
        return places

    @property
    def pairs(self) -> tuple[NDArray[np.int64], NDArray[np.int64]]:
        """Numbers of the places, and of the rate of each."""
        places = np.flatnonzero(self.is_place)
        moved = np.where(places < self.rings, len(_PLACES) * self.balls, Q.RINGS)
        return places, places + np.where(places < self.flexure, moved, 2 * self.flexural)

    def ball_state(self, kind: int) -> slice:
        """Numbers of one of the nine ball states."""
        return slice(kind * self.balls, (kind + 1) * self.balls)

    def patterns(self, angles: NDArray[np.float64]) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Return the patterns at the balls' angles (rad), and their rates over the speed of the orbit.

        The alternating pattern goes with the balls.
        """
        columns: list[NDArray[np.float64]] = [np.ones(self.balls)]
        rates: list[NDArray[np.float64]] = [np.zeros(self.balls)]
        for k in range(1, (self.balls - 1) // 2 + 1):
            c, s = np.cos(k * angles), np.sin(k * angles)
            columns += [c, s]
            rates += [-k * s, k * c]
        if self.balls % 2 == 0:
            columns.append(np.where(np.arange(self.balls) % 2, -1.0, 1.0))
            rates.append(np.zeros(self.balls))
        return np.array(columns).T, np.array(rates).T

    def turned(self, phase: float) -> NDArray[np.float64]:
        """Return what takes rings and flexure from fixed axes to axes turned by ``phase`` (rad)."""

        def turn(angle: float) -> NDArray[np.float64]:
            c, s = math.cos(angle), math.sin(angle)
            return np.array([[c, s], [-s, c]])

        rings = np.eye(Q.RINGS)
        for i, k in _PAIRS:
            rings[np.ix_([i, k], [i, k])] = turn(phase)
        flexure = block_diag(*[turn(n * phase) for n in self.orders]) if self.orders else np.zeros((0, 0))
        return np.asarray(block_diag(rings, rings, flexure, flexure))

    def places(
        self, y: NDArray[np.float64], w: NDArray[np.float64], pitch: float, ball: float
    ) -> Iterator[tuple[NDArray[np.float64], int, float]]:
        """Yield array, place and lever (m or 1: what makes a length of it) of each number, ball by ball."""
        sizes = (1.0, 1.0, pitch, 1.0, 1.0, pitch, ball, ball, ball)
        for row, size in zip((*_PLACES, *_RATES), sizes, strict=True):
            for j in range(self.balls):
                yield y, row + j, size
        levers = np.where(np.isin(np.arange(Q.RINGS), self.angles()), pitch, 1.0)
        for first in (Y.Q0, Y.V0):
            for i in range(Q.RINGS):
                yield y, first + i, float(levers[i])
        for first in (FL.Q, FL.V):
            for i in range(2 * self.flexural):
                yield w, W.FLEX + first + i, 1.0

    @staticmethod
    def angles() -> list[int]:
        """Coordinates of the rings that are angles."""
        outer = Q.OUTER
        return [Q.INNER_BY, Q.INNER_BZ, outer + Q.TURN, outer + Q.BY, outer + Q.BZ]

    def rates(
        self, y: NDArray[np.float64], f: NDArray[np.float64], w: NDArray[np.float64]
    ) -> list[NDArray[np.float64]]:
        """Return the parts of x', ball by ball, of a state and the right-hand side there: views of both."""
        n = self.balls
        parts = [y[row : row + n] for row in _RATES[: len(_PLACES)]]
        parts += [f[row : row + n] for row in _ACCELERATIONS]
        parts += [y[Y.V0 : Y.V0 + Q.RINGS], f[F.BODY : F.BODY + Q.RINGS]]
        for first in (FL.V, FL.A):
            parts.append(w[W.FLEX + first : W.FLEX + first + 2 * self.flexural])
        return parts
