"""What error motion needs of a run beside its variables: the balls' rates, the tilt of a lone outer ring."""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.engine.layout import P, Q, S, Y
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.lengths import parts_of
from fmu_bearing.scene import Scene

_OUTER = S.Y + Y.Q0 + Q.OUTER
_AT_TILT = _OUTER + Q.BY  # rad, about y and z
_ROWS = (Y.OM, Y.WX, Y.WR, Y.WT)
#: Under these names a recording keeps what was read of a single bearing's outer ring (rad).
OUTER_TILTS = ("outer_ring.tilt.y", "outer_ring.tilt.z")


def outer_tilt(instance: Instance) -> NDArray[np.float64]:
    """Return the tilt of the outer ring of a single bearing (rad, about y and z)."""
    return instance.s[_AT_TILT : _AT_TILT + 2]


class AxisWatch:
    """Reads at each call, for ``record(watch=...)`` and ``simulate(watch=...)``."""

    def __init__(self) -> None:
        self._places: NDArray[np.int_] | None = None  # of rates in the state, shape (bearings, 4, balls)
        self._rates: list[NDArray[np.float64]] = []
        self._tilts: list[NDArray[np.float64]] = []

    def __call__(self, instance: Instance) -> None:
        """Read the present state."""
        if self._places is None:
            self._places = _places(instance)
        orbit, about_x, about_r, about_t = np.moveaxis(instance.s[self._places], 1, 0)
        # spins are absolute: a wave of a ball passes a race by the spin in the axes that orbit
        spin = np.sqrt((about_x - orbit) ** 2 + about_r**2 + about_t**2)
        self._rates.append(np.column_stack([np.abs(orbit.mean(axis=1)), spin.mean(axis=1)]))
        self._tilts.append(outer_tilt(instance).copy())

    @property
    def rates(self) -> NDArray[np.float64]:
        """Mean orbit and spin (rad/s) of the balls of each bearing, shape (calls, bearings, 2)."""
        return np.array(self._rates)

    def outputs(self, scene: Scene) -> dict[str, NDArray[np.float64]]:
        """Return the values of all calls by name, which `rates_of` takes; of a single bearing tilts, too."""
        rates, tilts = self.rates, np.array(self._tilts)
        found = {
            name: rates[:, k, column]
            for k, names in enumerate(_names(scene))
            for column, name in enumerate(names)
        }
        if scene.spindle is None:
            found |= dict(zip(OUTER_TILTS, tilts.T, strict=True))
        return found


def rates_of(outputs: Mapping[str, NDArray[np.float64]], scene: Scene) -> NDArray[np.float64] | None:
    """Return rates as `AxisWatch.rates` from values by name; None where they were not kept."""
    names = _names(scene)
    if any(name not in outputs for both in names for name in both):
        return None
    return np.stack([np.column_stack([outputs[name] for name in both]) for both in names], axis=1)


def frequencies(rates: NDArray[np.float64], scene: Scene) -> tuple[KinematicFrequencies, ...]:
    """Return the frequencies (Hz) of each bearing at the scene's speed from `AxisWatch.rates`."""
    shaft, balls = abs(scene.operation.speed_rpm) / 60.0, scene.bearing.ball_count
    return tuple(
        KinematicFrequencies(shaft, cage, spin, balls * (shaft - cage), balls * cage)
        for cage, spin in (rates.mean(axis=0) / (2.0 * np.pi)).tolist()
    )


def _names(scene: Scene) -> list[tuple[str, str]]:
    """Return the names of orbit and spin of each bearing."""
    return [(f"{one.prefix}balls.orbit_mean", f"{one.prefix}balls.spin_mean") for one in scene.bearings()]


def _places(instance: Instance) -> NDArray[np.int_]:
    everything = np.arange(len(instance.s))
    return np.array(
        [
            [everything[at_s][S.Y + row : S.Y + row + int(instance.p[at_p][P.BALLS])] for row in _ROWS]
            for at_p, at_s in parts_of(instance.p)
        ]
    )
