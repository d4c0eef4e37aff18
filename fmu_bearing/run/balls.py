"""Place, load and contact angle of every ball, and the cage's place, read from the state.

The table of variables has means and extremes over the balls. The engine computes those in one kernel from
each ball's place. Here the same kernel is applied to a bearing with one ball, so that no formula is written
twice.
"""

import math
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.compiled import bound
from fmu_bearing.engine.layout import STRIDE, P, Q, S, Y, Z
from fmu_bearing.instance import Instance


class Readable(Protocol):
    """What has the parameters and the state of one bearing: an instance, or a part of a set's."""

    @property
    def p(self) -> NDArray[np.float64]:
        """Parameters."""

    @property
    def s(self) -> NDArray[np.float64]:
        """State."""


_ROWS = 9  # of the state, per ball
_CAGE = S.Y + Y.Q0 + Q.CAGE
RACES = ("inner", "outer")


def name_of(ball: int, what: str, race: str = "") -> str:
    """Name under which a recording keeps ``what`` ("azimuth", "load", "angle") of ball 1, 2, ..."""
    return f"ball[{ball}].contact.{race}.{what}" if race else f"ball[{ball}].{what}"


class Watch:
    """Reads balls and cage at each call, for ``fmu_bearing.record(watch=...)``.

    Loads are the elastic ones, without waviness of the races, as ``contact.inner.load_mean`` is.
    """

    def __init__(self) -> None:
        self._balls: list[NDArray[np.float64]] = []
        self._cage: list[NDArray[np.float64]] = []
        self._reader: Reader | None = None

    def __call__(self, bearing: Instance) -> None:
        """Read the present state."""
        if self._reader is None:
            self._reader = Reader(bearing)
        self._balls.append(self._reader.read(bearing))
        self._cage.append(bearing.s[_CAGE : _CAGE + 3].copy())

    def outputs(self) -> dict[str, NDArray[np.float64]]:
        """Return the values of all calls by `name_of` (rad, N, rad), and the cage's place (m)."""
        table = np.array(self._balls)
        found = {}
        for j in range(table.shape[1]):
            found[name_of(j + 1, "azimuth")] = table[:, j, 0]
            for k, race in enumerate(RACES):
                found[name_of(j + 1, "load", race)] = table[:, j, 1 + 2 * k]
                found[name_of(j + 1, "angle", race)] = table[:, j, 2 + 2 * k]
        if self._reader is not None and self._reader.has_cage:
            for axis, values in zip("xyz", np.array(self._cage).T, strict=True):
                found[f"cage.displacement.{axis}"] = values
        return found


class Reader:
    """Reads the balls of one initialised bearing.

    Parameters
    ----------
    bearing : Readable
    what : tuple of int
        What is read at each race, of the four numbers at ``Z.CONTACT``.
    """

    def __init__(self, bearing: Readable, what: tuple[int, ...] = (Z.LOAD_MEAN, Z.ANGLE_MEAN)) -> None:
        self._read = [Z.CONTACT + race * Z.CONTACT_SIZE + k for race in range(len(RACES)) for k in what]
        # without the sound block behind the tables, which is large
        end = int(bearing.p[P.AT_SOUND]) or len(bearing.p)
        self._p: NDArray[np.float64] = bearing.p[:end].copy()
        self._oversize = int(self._p[P.AT_OVERSIZE])
        self.balls = int(self._p[P.BALLS])
        self.has_cage = bool(self._p[P.CAGE])
        self._diameters = self._p[self._oversize : self._oversize + self.balls].copy()
        self._p[P.BALLS] = 1.0
        self._rows = S.Y + STRIDE * np.arange(_ROWS)
        self._z: NDArray[np.float64] = np.zeros(len(Z.BEARING_OUTPUTS))
        # a copy, for every ball is put in the first one's place; the kernel reads nothing behind
        self._s: NDArray[np.float64] = bearing.s[: S.AXES].copy()
        self._contacts = bound("contacts", self._p, self._s, self._z)

    def read(self, bearing: Readable) -> NDArray[np.float64]:
        """Return azimuth (rad, from 12 o'clock about +X), then what is read at inner and outer race.

        By default load (N) and angle (rad): shape (balls, 5).
        """
        self._s[:] = bearing.s[: S.AXES]
        places = self._s[self._rows[:, None] + np.arange(self.balls)]
        found = np.empty((self.balls, 1 + len(self._read)))
        for j in range(self.balls):
            self._s[self._rows] = places[:, j]
            self._p[self._oversize] = self._diameters[j]
            self._contacts()
            found[j, 0] = places[Y.TH // STRIDE, j] % (2.0 * math.pi)
            found[j, 1:] = self._z[self._read]
        return found
