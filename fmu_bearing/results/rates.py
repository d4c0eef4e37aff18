"""How fast the balls of each bearing orbit and spin, read from the state, and what passes how often.

A contact angle gives these rates only for rolling at one angle. A ball that meets its races at two angles,
as centrifugal force makes it, orbits faster and spins faster than it would at their mean: by 2 % in a
7010C with steel balls at 18,000 r/min.
"""

from collections.abc import Mapping

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.engine.layout import P, S, Y
from fmu_bearing.prepare.lengths import parts_of
from fmu_bearing.results.balls import Readable
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.bearing import Bearing

_ROWS = (Y.OM, Y.WX, Y.WR, Y.WT)
_MEANS = ("balls.orbit_mean", "balls.spin_mean")


class RatesWatch:
    """Reads the rates of the balls at each call, for ``simulate(watch=...)``."""

    def __init__(self) -> None:
        self._places: list[NDArray[np.int_]] | None = None  # of rates in the state
        self._rates: list[NDArray[np.float64]] = []

    def __call__(self, bearing: Readable) -> None:
        """Read the present state."""
        if self._places is None:
            self._places = _places(bearing)
        self._rates.append(np.array([_means(bearing.s[places]) for places in self._places]))

    @property
    def rates(self) -> NDArray[np.float64]:
        """Mean orbit and spin (rad/s) of the balls of each bearing, shape (calls, bearings, 2)."""
        return np.array(self._rates)

    def outputs(self, scene: Scene) -> dict[str, NDArray[np.float64]]:
        """Return the values of all calls by name, which `rates_of` takes."""
        rates = self.rates
        return {
            name: rates[:, k, column]
            for k, names in enumerate(_names(scene))
            for column, name in enumerate(names)
        }


def rates_of(outputs: Mapping[str, NDArray[np.float64]], scene: Scene) -> NDArray[np.float64] | None:
    """Return rates as `RatesWatch.rates` from values by name; None where they were not kept."""
    names = _names(scene)
    if any(name not in outputs for both in names for name in both):
        return None
    return np.stack([np.column_stack([outputs[name] for name in both]) for both in names], axis=1)


def ball_rates(part: Readable) -> tuple[float, float]:
    """Return mean orbit and spin (rad/s) of the balls of one bearing in its state."""
    count = int(part.p[P.BALLS])
    return _means(np.array([part.s[S.Y + row : S.Y + row + count] for row in _ROWS]))


def frequencies(shaft: float, orbit: float, spin: float, balls: int) -> KinematicFrequencies:
    """Return the frequencies (Hz) at rates of shaft, orbit and balls (rad/s)."""
    f_r, f_c, f_b = (abs(value) / (2.0 * np.pi) for value in (shaft, orbit, spin))
    return KinematicFrequencies(f_r, f_c, f_b, balls * (f_r - f_c), balls * f_c)


def by_cage(bearing: Bearing, speed: float, ratio: float) -> KinematicFrequencies:
    """Return the frequencies (Hz) of balls that roll, and orbit at a share of the shaft's speed (rad/s).

    Without sliding the orbit gives the share of the pitch that the balls' circles take.
    """
    b = si(bearing)
    share = 1.0 - 2.0 * ratio
    spin = 0.5 * speed * b.pitch_diameter / b.ball_diameter * (1.0 - share**2)
    return frequencies(speed, ratio * speed, spin, b.ball_count)


def _means(rates: NDArray[np.float64]) -> tuple[float, float]:
    """Return mean orbit and spin of the balls of a bearing; ``rates``: shape (4, balls)."""
    orbit, about_x, about_r, about_t = rates
    # spins are absolute: a wave of a ball passes a race by the spin in the axes that orbit
    spin = np.sqrt((about_x - orbit) ** 2 + about_r**2 + about_t**2)
    return float(np.abs(orbit.mean())), float(spin.mean())


def _names(scene: Scene) -> list[tuple[str, str]]:
    """Return the names of orbit and spin of each bearing."""
    orbit, spin = _MEANS
    return [(bearing.prefix + orbit, bearing.prefix + spin) for bearing in scene.bearings()]


def _places(bearing: Readable) -> list[NDArray[np.int_]]:
    """Return the places of the rates in the state, of each bearing an array of shape (4, balls)."""
    everything = np.arange(len(bearing.s))
    return [
        np.array([everything[at_s][S.Y + row : S.Y + row + int(bearing.p[at_p][P.BALLS])] for row in _ROWS])
        for at_p, at_s in parts_of(bearing.p)
    ]
