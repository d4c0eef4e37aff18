"""Place, load and contact angle of every ball, and the cage's place, read from the state.

The table of variables has means and extremes over the balls. The engine makes those of rows that the state
keeps of each ball's contacts, and the same rows are read here.
"""

import math
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import P, Q, R, S, Y


class Readable(Protocol):
    """What has the parameters and the state of one bearing: an instance, or a part of a set's."""

    @property
    def p(self) -> NDArray[np.float64]:
        """Parameters."""

    @property
    def s(self) -> NDArray[np.float64]:
        """State."""


_CAGE = S.Y + Y.Q0 + Q.CAGE
RACES = ("inner", "outer")


def name_of(ball: int, what: str, race: str = "") -> str:
    """Name under which a recording keeps ``what`` ("azimuth", "load", "angle") of ball 1, 2, ..."""
    return f"ball[{ball}].contact.{race}.{what}" if race else f"ball[{ball}].{what}"


class Watch:
    """Reads balls and cage at each call, for ``fmu_bearing.record(watch=...)``.

    Loads are those that the balls feel, as ``contact.inner.load_mean`` is.
    """

    def __init__(self) -> None:
        self._balls: list[NDArray[np.float64]] = []
        self._cage: list[NDArray[np.float64]] = []
        self._reader: Reader | None = None

    def __call__(self, bearing: Readable) -> None:
        """Read the present state of a bearing, of a set that of one of its parts."""
        if self._reader is None:
            self._reader = Reader(bearing)
        self._balls.append(self._reader.read(bearing))
        self._cage.append(bearing.s[_CAGE : _CAGE + 3].copy())

    def outputs(self) -> dict[str, NDArray[np.float64]]:
        """Return the values of all calls by `name_of` (rad, N, rad), and the cage's place (m)."""
        table = np.array(self._balls)
        by_name = {}
        for j in range(table.shape[1]):
            by_name[name_of(j + 1, "azimuth")] = table[:, j, 0]
            for k, race in enumerate(RACES):
                by_name[name_of(j + 1, "load", race)] = table[:, j, 1 + 2 * k]
                by_name[name_of(j + 1, "angle", race)] = table[:, j, 2 + 2 * k]
        if self._reader is not None and self._reader.has_cage:
            for axis, values in zip("xyz", np.array(self._cage).T, strict=True):
                by_name[f"cage.displacement.{axis}"] = values
        return by_name


class Reader:
    """Reads the balls of one initialised bearing, of a set one at a time."""

    def __init__(self, bearing: Readable) -> None:
        self.balls = int(bearing.p[P.BALLS])
        self.has_cage = bool(bearing.p[P.CAGE])
        numbers = P.RACES + P.RACE_SIZE * np.arange(len(RACES))
        self._stiffness: NDArray[np.float64] = bearing.p[numbers + P.RACE_PRESSURE]  # Pa/m^0.5

    def _row(self, bearing: Readable, row: int) -> NDArray[np.float64]:
        kept = bearing.s[S.CONTACTS : S.CONTACTS + len(RACES) * R.KEPT].reshape(len(RACES), R.KEPT)
        return kept[:, row : row + self.balls]

    def loads(self, bearing: Readable) -> NDArray[np.float64]:
        """Return the balls' loads (N), shape (2, balls)."""
        return self._row(bearing, R.KEPT_LOAD).copy()

    def angles(self, bearing: Readable) -> NDArray[np.float64]:
        """Return the contact angles (rad), shape (2, balls)."""
        sides = np.array([[-1.0], [1.0]])
        sine, cosine = self._row(bearing, R.KEPT_SINA), self._row(bearing, R.KEPT_COSA)
        return np.asarray(np.arctan2(sides * sine, sides * cosine))

    def pressures(self, bearing: Readable) -> NDArray[np.float64]:
        """Return the largest contact pressures (Pa), shape (2, balls)."""
        approach = np.maximum(self._row(bearing, R.KEPT_APPROACH), 0.0)
        return np.asarray(self._stiffness[:, None] * np.sqrt(approach))

    def read(self, bearing: Readable) -> NDArray[np.float64]:
        """Return azimuth (rad, from 12 o'clock about +X), load (N) and angle (rad) at inner, then outer race.

        Shape (balls, 5).
        """
        azimuth = bearing.s[S.Y + Y.TH : S.Y + Y.TH + self.balls] % (2.0 * math.pi)
        (load_i, load_o), (angle_i, angle_o) = self.loads(bearing), self.angles(bearing)
        return np.column_stack([azimuth, load_i, angle_i, load_o, angle_o])
