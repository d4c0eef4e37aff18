"""Rates of a bearing at a state and their derivatives, ball by ball, by the engine's equations."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.arrays import Arrays
from fmu_bearing.compiled import bound
from fmu_bearing.engine.layout import FL, STRIDE, C, F, P, S, U, W, Y
from fmu_bearing.modal.equations.coordinates import Coordinates

# Steps of the central differences: contacts approach by 1 um and more, so a nanometre errs by 1e-7 of the
# slope; traction bends over 1e-3 m/s. Forces round to 1e-14 N.
MOVE = 1e-9  # m
RATE = 1e-6  # m/s


@dataclass(frozen=True)
class BearingArrays:
    """Arrays ``p``, ``u``, ``s`` and ``w`` of one bearing, laid out as of a single one."""

    p: NDArray[np.float64]
    u: NDArray[np.float64]
    s: NDArray[np.float64]
    w: NDArray[np.float64]


def flexure(bearing: Arrays | BearingArrays, at: Coordinates) -> NDArray[np.float64]:
    """Return the places (m) of the flexure in a bearing's state, two per mode: a view of ``s``."""
    return bearing.s[S.SOUND + int(bearing.p[P.SOUND_STATE]) :][: 2 * at.flexural]


class Plain:
    """The equations x' = g(x) of a bearing about the state it has, in the order of ``at``, ball by ball.

    Parameters
    ----------
    bearing : Arrays
        Initialised; only read.
    at : Coordinates
    """

    def __init__(self, bearing: Arrays | BearingArrays, at: Coordinates) -> None:
        self.p, self.at = bearing.p, at
        self.y = bearing.s[S.Y : S.Y + Y.SIZE].copy()
        self._c = bearing.s[S.C : S.C + C.SIZE].copy()
        self._speed = float(bearing.u[U.SPEED])
        self._f = np.zeros(F.SIZE)
        self._w = np.zeros(bearing.w.size)
        axes = slice(W.AXES, W.AXES + 3 * STRIDE)
        self._w[axes] = bearing.w[axes]
        bends = flexure(bearing, at)
        self._w[W.FLEX + FL.Q : W.FLEX + FL.Q + bends.size] = bends
        places = at.places(self.y, self._w, float(self.p[P.PITCH_RADIUS]), 0.5 * float(self.p[P.DIAMETER]))
        found = list(places)
        rows = [place for _, place, _ in found]
        self._bodies = sum(array is self.y for array, _, _ in found)  # in y; flexure is behind it, in w
        self._at_y, self._at_w = np.array(rows[: self._bodies]), np.array(rows[self._bodies :], dtype=int)
        self._steps = np.where(at.is_place, MOVE, RATE) / np.array([size for _, _, size in found])
        self._evaluate = bound("right_hand_side", self.p, self._c, self.y, self._w, self._f)
        self._rates = at.rates(self.y, self._f, self._w)

    def steps(self) -> NDArray[np.float64]:
        """Return the steps of the differences in the units of x: a nanometre or a micrometre per second."""
        return self._steps

    def rates(self) -> NDArray[np.float64]:
        """Return x' at the present state."""
        self._evaluate(0.0, self._speed, 0.0)
        return np.concatenate(self._rates)

    def derivatives(self) -> NDArray[np.float64]:
        """Return the derivatives of x' by x, shape (n, n), by central differences."""
        jacobian = np.empty((self.at.size, self.at.size))
        for k, step in enumerate(self._steps):
            array, place = (
                (self.y, self._at_y[k]) if k < self._bodies else (self._w, self._at_w[k - self._bodies])
            )
            kept = array[place]
            array[place] = kept + step
            ahead = self.rates()
            array[place] = kept - step
            jacobian[:, k] = (ahead - self.rates()) / (2.0 * step)
            array[place] = kept
        return jacobian
