"""Place, load and contact angle of every ball and the cage's place, out of the state.

The table of variables has means and extremes over the balls. The engine computes those in one kernel from
each ball's place; here the same kernel reads a bearing that has one ball, the one asked for, so that no
formula stands twice.
"""

import math

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine import layout as at
from fmu_bearing.engine import observe
from fmu_bearing.engine.jit import entry
from fmu_bearing.instance import Instance

_CONTACTS = entry(observe.contacts.py_func)  # kept compiled, as what Python calls
_ROWS = 9  # of the state, per ball
_PER_RACE = at.BEARING_OUTPUTS.index("contact.outer.load_mean") - observe.Z_CONTACT
_CAGE = at.S_Y + at.Y_Q + at.Q_CAGE
_LOAD, _ANGLE = 0, 2  # places behind the first of a race
RACES = ("inner", "outer")


def name_of(ball: int, what: str, race: str = "") -> str:
    """Name under which a recording keeps ``what`` ("azimuth", "load", "angle") of ball 1, 2, ..."""
    return f"ball[{ball}].contact.{race}.{what}" if race else f"ball[{ball}].{what}"


class Watch:
    """Reads balls and cage at each call, for ``study.recording.record(watch=...)``.

    Loads are the elastic ones, without waviness of the races, as ``contact.inner.load_mean`` is.
    """

    def __init__(self) -> None:
        self._balls: list[NDArray[np.float64]] = []
        self._cage: list[NDArray[np.float64]] = []
        self._has_cage = False

    def __call__(self, bearing: Instance) -> None:
        """Read the state as it is."""
        self._balls.append(read(bearing))
        self._cage.append(bearing.s[_CAGE : _CAGE + 3].copy())
        self._has_cage = bool(bearing.p[at.P_CAGE])

    def outputs(self) -> dict[str, NDArray[np.float64]]:
        """Return what was read, over the calls, by `name_of` (rad, N, rad), and the cage's place (m)."""
        table = np.array(self._balls)
        found = {}
        for j in range(table.shape[1]):
            found[name_of(j + 1, "azimuth")] = table[:, j, 0]
            for k, race in enumerate(RACES):
                found[name_of(j + 1, "load", race)] = table[:, j, 1 + 2 * k]
                found[name_of(j + 1, "angle", race)] = table[:, j, 2 + 2 * k]
        if self._has_cage:
            for axis, values in zip("xyz", np.array(self._cage).T, strict=True):
                found[f"cage.displacement.{axis}"] = values
        return found


def read(bearing: Instance) -> NDArray[np.float64]:
    """Azimuth (rad, from 12 o'clock about +X), load (N) and angle (rad) at the inner, then the outer race.

    Shape (balls, 5).
    """
    p = bearing.p.copy()
    balls, oversize = int(p[at.P_BALLS]), int(p[at.P_AT_OVERSIZE])
    state: NDArray[np.float64] = bearing.s[: at.S_AXES].copy()  # the kernel reads nothing behind
    z: NDArray[np.float64] = np.zeros(len(at.BEARING_OUTPUTS))
    rows = at.S_Y + at.STRIDE * np.arange(_ROWS)
    places = state[rows[:, None] + np.arange(balls)].copy()
    diameters = p[oversize : oversize + balls].copy()
    p[at.P_BALLS] = 1.0
    found = np.empty((balls, 5))
    for j in range(balls):
        state[rows] = places[:, j]
        p[oversize] = diameters[j]
        _CONTACTS(p, state, z)
        found[j, 0] = places[at.B_TH, j] % (2.0 * math.pi)
        for race in range(2):
            first = observe.Z_CONTACT + _PER_RACE * race
            found[j, 1 + 2 * race] = z[first + _LOAD]
            found[j, 2 + 2 * race] = z[first + _ANGLE]
    return found
