"""What error motion needs of a run beside its variables: the balls' rates, the tilt of a lone outer ring."""

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import Q, S, Y
from fmu_bearing.results import rates as run_rates
from fmu_bearing.results.balls import Readable
from fmu_bearing.results.rates import RatesWatch
from fmu_bearing.scene import Scene

_AT_TILT = S.Y + Y.Q0 + Q.OUTER + Q.BY  # rad, about y and z
#: Under these names a recording keeps what was read of a single bearing's outer ring (rad).
OUTER_TILTS = ("outer_ring.tilt.y", "outer_ring.tilt.z")


def outer_tilt(bearing: Readable) -> NDArray[np.float64]:
    """Return the tilt of the outer ring of a single bearing (rad, about y and z)."""
    return bearing.s[_AT_TILT : _AT_TILT + 2]


class AxisWatch(RatesWatch):
    """Reads at each call, for ``record(watch=...)`` and ``simulate(watch=...)``."""

    def __init__(self) -> None:
        super().__init__()
        self._tilts: list[NDArray[np.float64]] = []

    def __call__(self, bearing: Readable) -> None:
        """Read the present state."""
        super().__call__(bearing)
        self._tilts.append(outer_tilt(bearing).copy())

    def outputs(self, scene: Scene) -> dict[str, NDArray[np.float64]]:
        """Return the values of all calls by name; of a single bearing tilts, too."""
        values = super().outputs(scene)
        if not scene.assembly.joined:
            values |= dict(zip(OUTER_TILTS, np.array(self._tilts).T, strict=True))
        return values


def frequencies(rates: NDArray[np.float64], scene: Scene) -> tuple[KinematicFrequencies, ...]:
    """Return the frequencies (Hz) of each bearing at the scene's speed from `RatesWatch.rates`."""
    shaft = scene.operation.speed_rpm * RPM
    return tuple(
        run_rates.frequencies(shaft, orbit, spin, bearing.ball_count)
        for bearing, (orbit, spin) in zip(scene.geometries, rates.mean(axis=0).tolist(), strict=True)
    )
