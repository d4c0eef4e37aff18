"""The steady state of a bearing without cage: what is alike for all balls comes to rest.

The engine starts from a quasi-static state whose balls hold their gyroscopic moments by an assumed share of
friction at each race. There the mean of the balls still accelerates: contact angles, orbit and spin drift to
where the friction in the contacts itself is balanced. On the 7009C at 18,000 r/min that moves natural
frequencies by 0.6 %, on the 7003C at 10,000 r/min by 0.001 %. Newton's method goes there at once.
"""

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import P, Q, S, Y
from fmu_bearing.modal.coordinates import Coordinates
from fmu_bearing.modal.plain import Plain
from fmu_bearing.run.arrays import Arrays

_ROUNDS = 30
_LONGEST = 500.0  # steps of the differences: balls and rings move by 0.5 um a round, so contacts stay closed
_SETTLED = 0.1  # of such steps: what the last round may move
_SPARED = 1e-9  # singular values below this share belong to motions that nothing holds
_ORBIT_ANGLE = 2  # ball state whose rate is the orbit itself


def settle(bearing: Arrays) -> bool:
    """Move a bearing's state to the steady one; False, and the state as it was, where there is none near."""
    at = Coordinates.of(bearing.p)
    plain = Plain(bearing, at)
    spread, mean = _even_motions(at)
    # in steps of the differences all motions weigh alike
    scale = spread.T @ plain.steps() / np.maximum(spread.sum(axis=0), 1.0)
    is_place = (spread.T @ at.is_place) > 0.0
    for _ in range(_ROUNDS):
        matrix = mean @ plain.along(spread)
        residual = mean @ plain.rates()
        change = np.linalg.lstsq(
            matrix * scale / scale[:, None], -residual / scale, rcond=_SPARED
        )[0]  # fmt: skip
        largest, longest = float(np.abs(change).max()), float(np.abs(change[is_place]).max())
        if not np.isfinite(largest):
            return False
        plain.move(spread @ (change * scale * min(1.0, _LONGEST / max(longest, 1e-300))))
        if largest < _SETTLED:
            _keep(bearing, plain, at)
            return True
    return False


def _even_motions(at: Coordinates) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Return what spreads motions that are alike for all balls over x, and what takes their mean from x'.

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


def _keep(bearing: Arrays, plain: Plain, at: Coordinates) -> None:
    """Write the settled state back; spare lanes follow the first ball."""
    rows = plain.y[: Y.Q0].reshape(Y.ROWS, -1)
    rows[:, at.balls : int(bearing.p[P.LANES])] = rows[:, :1]
    bearing.s[S.Y : S.Y + Y.SIZE] = plain.y
