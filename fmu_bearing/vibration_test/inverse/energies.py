"""Energies per order in what was measured: bands and lines of the vibration test."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.scene import Scene
from fmu_bearing.vibration_test.inverse.runs import AMPLITUDE_UM, BALL_EXPONENTS, BENT_AT, EXPONENT, Spectra
from fmu_bearing.vibration_test.lines import frequencies, waves
from fmu_bearing.vibration_test.reading import Reading, share
from fmu_bearing.vibration_test.rig import bands

_LOBE = 2.5  # bins to either side of a line, half its own included: what a Hann window makes of it
_LEAST = 1e-12  # (um/s)^2
_GRID = np.linspace(0.0, 4.0, 81)  # exponents between which energies are interpolated


class Window(NamedTuple):
    """Frequencies whose energy is one measured value: from ``low`` up to ``high`` (Hz), left out.

    ``band``: place of the band that it is, or lies in.
    """

    name: str
    low: float
    high: float
    band: int


@dataclass(frozen=True, eq=False)
class Energies:
    """Energies (um/s)^2 in windows, by source and order.

    Attributes
    ----------
    names : tuple of str
        Of the windows.
    inner_orders, outer_orders : ndarray of int, shape (orders,)
    inner, outer : ndarray, shape (windows, orders)
        For A_1 = 1 um and the exponent `EXPONENT`.
    balls : ndarray, shape (windows, exponents, seeds)
        For a form of 1 nm, rings rigid, at `BALL_EXPONENTS`.
    bending : ndarray, shape (windows, some seeds)
        Ratio of the balls' energies with rings that bend to those with rigid rings.
    rest : ndarray, shape (windows, exponents), or None
        Energy of orders that are left out, for A_1 = 1 um at `_GRID`, without scatter.
    """

    names: tuple[str, ...]
    inner_orders: NDArray[np.int64]
    outer_orders: NDArray[np.int64]
    inner: NDArray[np.float64]
    outer: NDArray[np.float64]
    balls: NDArray[np.float64]
    bending: NDArray[np.float64]
    rest: NDArray[np.float64] | None = None

    @property
    def seeds(self) -> int:
        """How many draws of the balls there are."""
        return self.balls.shape[2]

    def races(
        self, exponent: NDArray[np.float64], inner: NDArray[np.float64] | float = 1.0,
        outer: NDArray[np.float64] | float = 1.0,
    ) -> NDArray[np.float64]:  # fmt: skip
        """Return the energy of both races for A_1 = 1 um, shape (draws, windows).

        Parameters
        ----------
        exponent : ndarray, shape (draws,)
        inner, outer : ndarray, shape (draws, orders)
            Factors on the energies of the orders.
        """
        total = np.zeros((len(exponent), len(self.names)))
        races = ((self.inner_orders, self.inner, inner), (self.outer_orders, self.outer, outer))
        for orders, energies, factors in races:
            steeper = np.exp(-2.0 * np.outer(exponent - EXPONENT, np.log(orders)))
            total += (steeper * factors) @ energies.T
        if self.rest is not None:
            total += np.array([np.exp(np.interp(exponent, _GRID, np.log(row))) for row in self.rest]).T
        return total

    def strong(self, exponent: float, share: float) -> "Energies":
        """Return the orders that make a share of any window at an exponent, the others in ``rest``."""
        whole = self.races(np.array([exponent]))[0]
        kept = []
        for orders, energies in ((self.inner_orders, self.inner), (self.outer_orders, self.outer)):
            here = energies * np.exp(-2.0 * (exponent - EXPONENT) * np.log(orders))
            kept.append((here > share * whole[:, None]).any(axis=0))
        some, others = (
            replace(
                self, inner_orders=self.inner_orders[one], inner=self.inner[:, one],
                outer_orders=self.outer_orders[two], outer=self.outer[:, two],
            )
            for one, two in (kept, [~one for one in kept])
        )  # fmt: skip
        return replace(some, rest=np.maximum(others.races(_GRID).T, _LEAST))

    def forms(
        self, exponent: NDArray[np.float64], seed: NDArray[np.int64], bent: NDArray[np.int64]
    ) -> NDArray[np.float64]:
        """Return the energy of the form of the balls of 1 nm, shape (draws, windows).

        Parameters
        ----------
        exponent : ndarray, shape (draws,)
        seed, bent : ndarray of int, shape (draws,)
            Which draw of the balls, and which of those that give the ratio with rings that bend.
        """
        low, middle, high = (np.log(np.maximum(self.balls[:, k], _LEAST)) for k in range(3))
        x = (exponent - BALL_EXPONENTS[1]) / (BALL_EXPONENTS[2] - BALL_EXPONENTS[1])
        slope, curve = 0.5 * (high - low), 0.5 * (high + low) - middle
        logarithm = middle[:, seed] + slope[:, seed] * x + curve[:, seed] * x**2
        return (np.exp(logarithm) * self.bending[:, bent]).T


def band_windows(scene: Scene) -> tuple[Window, ...]:
    """Return the bands of the test of a scene."""
    ends = bands(scene).items()
    return tuple(Window(name, low, high, k) for k, (name, (low, high)) in enumerate(ends))


def line_names(spectra: Spectra) -> dict[str, float]:
    """Return the lines of the races by name, with their frequencies (Hz), lowest first."""
    first = Reading(spectra.frequency, spectra.inner, 0.0, spectra.orbit)
    rates = frequencies(spectra.scene, first)
    known = [wave for race in ("inner race", "outer race") for wave in waves(spectra.scene, rates, race)]
    return {one.name: one.order * rates.f_r for one in sorted(known, key=lambda one: one.order)}


def line_window(spectra: Spectra, name: str) -> Window:
    """Return the window of a line by name.

    Raises
    ------
    ValueError
        For a name that is none, or a line outside the bands.
    """
    known = line_names(spectra)
    plain = " ".join(name.replace("+", " + ").replace("-", " - ").split())
    if plain not in known:
        first = ", ".join(list(known)[:6])
        raise ValueError(
            f"line '{name}': it is none of a race in this test; lines are named as f_i - f_r or 2 f_o, here "
            f"from the lowest on {first} (f_r: shaft, f_i, f_o: balls passing the inner and outer race)"
        )
    at, half = known[plain], _LOBE * spectra.frequency[1]
    for k, (low, high) in enumerate(bands(spectra.scene).values()):
        if low <= at < high:
            return Window(plain, at - half, at + half, k)
    raise ValueError(f"line '{name}' lies at {at:.0f} Hz, outside the bands of the test: name another one")


def energies(spectra: Spectra, windows: Sequence[Window]) -> Energies:
    """Return the energies per order of spectra in windows."""
    frequency = spectra.frequency
    masks = np.array([share(frequency, window.low, window.high) for window in windows])
    rates = frequencies(spectra.scene, Reading(frequency, spectra.inner, 0.0, spectra.orbit))
    known = waves(spectra.scene, rates, "inner race")
    places = rates.f_r * np.array([one.order for one in known])
    nearest = np.searchsorted(0.5 * (places[1:] + places[:-1]), frequency)
    inner_orders, index = np.unique([one.wave for one in known], return_inverse=True)
    inner = _binned(masks * spectra.inner, index[nearest], inner_orders.size)
    count = spectra.scene.bearing.ball_count
    passing = np.maximum(np.round(frequency / rates.f_o).astype(int), 1)
    outer_orders, outer = [], []
    for residue, energy in zip(spectra.residues, spectra.outer, strict=True):
        middle = residue if residue <= count // 2 else residue - count  # the nearest whole number of balls
        outer_orders.append(count * np.arange(passing.max() + 1) + middle)
        outer.append(_binned(masks * energy, passing, passing.max() + 1))
    orders, every = np.concatenate(outer_orders), np.concatenate(outer, axis=1)
    some = (every.sum(axis=0) > 0.0) & (orders > 0)
    whole = np.array([share(frequency, *ends) for ends in bands(spectra.scene).values()])
    bands_of = whole[[window.band for window in windows]]  # a line has the ratio of its band
    rigid = spectra.rigid[BENT_AT, : len(spectra.bent)]
    unit = AMPLITUDE_UM**2
    return Energies(
        tuple(one.name for one in windows), inner_orders, orders[some], inner / unit, every[:, some] / unit,
        np.einsum("wf,psf->wps", masks, spectra.rigid) / spectra.form_nm**2,
        (bands_of @ spectra.bent.T) / np.maximum(bands_of @ rigid.T, _LEAST),
    )  # fmt: skip


def _binned(energy: NDArray[np.float64], index: NDArray[np.int64], count: int) -> NDArray[np.float64]:
    """Return sums over bins of equal index, shape (windows, count)."""
    return np.array([np.bincount(index, row, count) for row in energy])
