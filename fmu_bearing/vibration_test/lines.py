"""Lines of a vibration test: their frequencies, the waves that make them, and the energy of each wave.

Of a ring that bends `acoustics.analysis.origins` holds with more sidebands: in a line k f_i + m f_r it bends
with |m| lobes. All waves k Z + m of the outer race sound at k f_o.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.acoustics.analysis.lines import strongest_lines
from fmu_bearing.acoustics.analysis.origins import (
    BALL_FORM,
    BALL_SIZES,
    INNER,
    OUTER,
    Origin,
    bearing_origins,
    shaft_origins,
)
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.engine.constants import RPM
from fmu_bearing.results.base import Quantity, Result
from fmu_bearing.results.rates import by_cage
from fmu_bearing.scene import Scene
from fmu_bearing.vibration_test.reading import Reading, share
from fmu_bearing.vibration_test.rig import BANDS, BENDING, bands

#: Imperfections by the names that lines have for what makes them; the rig has no unbalance.
_SOURCES = {
    INNER: "inner race", OUTER: "outer race", BALL_SIZES: "ball sizes", BALL_FORM: "form of the balls",
}  # fmt: skip
_LOBE = 2  # bins to either side: a line under a Hann window
_SLIP = 0.002  # share of its frequency by which a line may miss the kinematic one
_SHARE = 0.1  # of the energy that the strongest source makes there, for another to give a line its name
_SPIN = np.linspace(0.99, 1.01, 401)  # of the balls over that of rolling: searched


class OrderEnergies(NamedTuple):
    """What the waves of one source make.

    Attributes
    ----------
    orders : ndarray of int, shape (orders,)
        Waves per turn of the race; of the outer race the middle k Z of those that share a line; of the balls
        the order of the zonal wave.
    energies : ndarray, shape (3, orders)
        Mean square velocity in the bands L, M, H, (um/s)^2.
    """

    orders: NDArray[np.int64]
    energies: NDArray[np.float64]


def digits(velocity: float) -> str:
    """Return a velocity (um/s, or Anderon) with three digits, or one after the point."""
    if velocity < 0.05:
        return "0.0"
    return f"{velocity:.3g}" if velocity < 100.0 else f"{velocity:.0f}"


@dataclass(frozen=True)
class VibrationLine(Result):
    """A line of the spectrum of a vibration test."""

    quantities = (
        Quantity("frequency_Hz", "Hz", ".1f"), Quantity("velocity_um_s", "um/s", digits),
        Quantity("order [1]", "order", ".2f"), Quantity("name", "line", lambda name: name or "?"),
        Quantity("source", "source"), Quantity("wave [1]", "wave", lambda wave: str(wave or "")), "band",
    )  # fmt: skip

    frequency: float
    """In Hz."""
    velocity: float
    """Rms, um/s, mean over the places and seeds."""
    order: float
    """Frequency over the shaft's."""
    name: str
    """In kinematic frequencies, as ``2 f_i - f_r``; empty: none is near."""
    source: str
    """The imperfection that makes it; empty: none has a line there."""
    wave: int
    """Order of the wave of that source, see `OrderEnergies`; 0 without a name."""
    band: str
    """``"L"``, ``"M"`` or ``"H"``."""


def frequencies(scene: Scene, found: Reading) -> KinematicFrequencies:
    """Return the kinematic frequencies (Hz) of a test, from the speed at which its balls orbited."""
    return by_cage(scene.bearing, scene.operation.speed_rpm * RPM, found.orbit)


def waves(scene: Scene, rates: KinematicFrequencies, source: str) -> list[Origin]:
    """Return the lines of an imperfection up to the end of the bands, by frequency."""
    top = bands(scene)[BANDS[-1]][1] / rates.f_r
    lobes = BENDING[-1] if scene.bends else 1
    origins = bearing_origins(rates, top, sidebands=lobes, ball_sidebands=lobes)
    origins = [origin for origin in origins if _SOURCES[origin.source] == source]
    if source == _SOURCES[OUTER]:
        return [origin for origin in origins if origin.beside == 0]  # the load is the same all round
    if source == _SOURCES[INNER]:  # waves that turn with the shaft bend the outer ring
        origins += [replace(one, source=INNER, wave=one.terms) for one in shaft_origins(lobes)]
    return sorted(origins, key=lambda one: one.order)


def spinning(rates: KinematicFrequencies, alone: Reading) -> KinematicFrequencies:
    """Return the frequencies with the f_b at which the lines of the balls' form lie, from its run alone.

    Balls spin a little faster than rolling asks, because their axis tilts: by 0.15 % in the 7003C.
    """
    orders = np.arange(1, int(alone.frequency[-1] / (1.02 * rates.f_b)))
    width = float(alone.frequency[1])

    def energy(scale: float) -> float:
        places = np.concatenate([orders * scale * rates.f_b + m * rates.f_c for m in (-1, 0, 1)])
        bins = np.clip(np.round(places / width).astype(int), 0, alone.energy.size - 1)
        return float(alone.energy[np.unique(bins)].sum())

    best = max(_SPIN, key=energy)
    return rates._replace(f_b=float(best) * rates.f_b)


def by_order(scene: Scene, alone: Reading, rates: KinematicFrequencies, source: str) -> OrderEnergies:
    """Return the energy of each wave of a source, from a reading of that source alone.

    Each bin counts for the nearest line. What the cage makes by itself is in it.
    """
    known = waves(scene, rates, source)
    if not known:
        return OrderEnergies(np.empty(0, dtype=np.int64), np.empty((len(BANDS), 0)))
    places = rates.f_r * np.array([one.order for one in known])
    nearest = np.searchsorted(0.5 * (places[1:] + places[:-1]), alone.frequency)
    orders, index = np.unique([one.wave for one in known], return_inverse=True)
    energies = [
        np.bincount(index[nearest], alone.energy * share(alone.frequency, *ends), orders.size)
        for ends in bands(scene).values()
    ]
    return OrderEnergies(orders, np.array(energies))


def named_lines(
    scene: Scene, frequency: NDArray[np.float64], energy: NDArray[np.float64], alone: dict[str, Reading],
    rates: KinematicFrequencies, count: int,
) -> tuple[VibrationLine, ...]:  # fmt: skip
    """Return the strongest lines of each band, by band and strongest first.

    Parameters
    ----------
    frequency, energy : ndarray, shape (bins,)
        Of the spectrum, as a `Reading` has them.
    alone : dict of str to Reading
        Readings of each source alone: the one that makes most of a line and has one there gives its name.
    rates : KinematicFrequencies
    count : int
        Most lines of a band.
    """
    level = 10.0 * np.log10(np.maximum(energy, 1e-12))
    ranked = strongest_lines(frequency, level, frequency.size)
    known = {source: waves(scene, rates, source) for source in alone}
    lines: list[VibrationLine] = []
    for band, (low, high) in bands(scene).items():
        inside = [one.frequency for one in ranked if low <= one.frequency < high][:count]
        named = [_named(at, band, frequency, energy, alone, known, rates.f_r) for at in inside]
        lines += sorted(named, key=lambda one: -one.velocity)
    return tuple(lines)


def _named(
    at: float, band: str, frequency: NDArray[np.float64], energy: NDArray[np.float64],
    alone: dict[str, Reading], known: dict[str, list[Origin]], shaft: float,
) -> VibrationLine:  # fmt: skip
    width = float(frequency[1] - frequency[0])
    middle = round(at / width)
    bins = slice(max(middle - _LOBE, 0), middle + _LOBE + 1)
    velocity = float(np.sqrt(energy[bins].sum()))
    core = slice(max(middle - 1, 0), middle + 2)
    makes = {source: float(one.energy[core].sum()) for source, one in alone.items()}
    most = max(makes.values(), default=0.0)
    for source in sorted(makes, key=lambda name: -makes[name]):
        near = _nearest(at / shaft, known[source], max(width, _SLIP * at) / shaft)
        if near is not None and makes[source] > _SHARE * most:
            return VibrationLine(at, velocity, at / shaft, near.name, source, near.wave, band)
    return VibrationLine(at, velocity, at / shaft, "", "", 0, band)


def _nearest(order: float, known: Sequence[Origin], tolerance: float) -> Origin | None:
    best = min(known, key=lambda one: abs(one.order - order), default=None)
    return best if best is not None and abs(best.order - order) <= tolerance else None
