"""Imperfections as numbers: waviness of races and balls, ball sizes; drawn once from the scene's seed."""

from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray

from fmu_bearing.prepare.surfaces import ball_profile, frequencies, highest_orders, law, mean_patches
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.imperfections import HIGHEST_ORDER, RACES

_INTERVALS = 2048  # of a race's table at least
#: Intervals per wave at least: the table's cubics then follow the shortest wave within 0.1 %.
_PER_WAVE = 8


class Harmonics(NamedTuple):
    """Waviness of a race, one entry per harmonic: amplitudes (m), waves per turn, phases (rad)."""

    amplitudes: NDArray[np.float64]
    orders: NDArray[np.int64]
    phases: NDArray[np.float64]


NONE = Harmonics(np.empty(0), np.empty(0, dtype=np.int64), np.empty(0))


def intervals(highest: int) -> int:
    """Intervals of a table for waves up to the order ``highest``: a power of two, 2048 or more."""
    count = _INTERVALS
    while count < _PER_WAVE * highest:
        count *= 2
    return count


def wave_table(harmonics: Harmonics, count: int) -> NDArray[np.float64]:
    """Height and slope of a wavy race at ``count`` equal angles.

    Returns
    -------
    ndarray
        Shape ``(2 * count,)``: height (m, positive towards the ball) and slope (m per interval) interleaved,
        as the engine's Hermite interpolation wants them.
    """
    lines = np.zeros(count // 2 + 1, dtype=complex)
    lines[harmonics.orders] = 0.5 * count * harmonics.amplitudes * np.exp(1j * harmonics.phases)
    table = np.empty(2 * count)
    table[0::2] = np.fft.irfft(lines, count)
    table[1::2] = np.fft.irfft(1j * np.arange(lines.size) * lines, count) * (2.0 * np.pi / count)
    return table


def order_table(harmonics: Harmonics, highest: int) -> NDArray[np.float64]:
    """Complex amplitudes W_n (m) of orders 1 .. ``highest``, real and imaginary parts interleaved.

    The height is the real part of the sum of W_n e^(i n angle).
    """
    table = np.zeros(highest, dtype=complex)
    table[harmonics.orders - 1] = harmonics.amplitudes * np.exp(1j * harmonics.phases)
    return table.view(np.float64)


def race_harmonics(scene: Scene) -> tuple[Harmonics, Harmonics]:
    """Waviness of inner and outer race; no harmonics where there is none."""
    if scene.imperfections is None:
        return NONE, NONE
    inner, outer = (_harmonics(scene, race) for race in range(len(RACES)))
    return inner, outer


def _harmonics(scene: Scene, race: int) -> Harmonics:
    flaws = scene.imperfections
    assert flaws is not None
    explicit = getattr(flaws, f"{RACES[race]}_race_harmonic")
    if explicit:
        rows = [si(harmonic) for harmonic in explicit]
        return Harmonics(
            np.array([row.amplitude for row in rows]),
            np.array([row.order for row in rows], dtype=np.int64),
            np.array([row.phase for row in rows]),
        )
    first = getattr(si(flaws), f"{RACES[race]}_race_amplitude")
    if not first:
        return NONE
    # the scene has checked that an amplitude has its exponent
    assert flaws.waviness_exponent is not None
    orders = np.arange(flaws.lowest_order, highest_orders(scene)[race] + 1)
    patch = mean_patches(scene)[race]
    wave_length = patch.half_width / patch.radius if flaws.contact_filter else 0.0
    amplitudes = law(first, flaws.waviness_exponent, orders, wave_length)
    if flaws.order_scatter_seed is not None:
        amplitudes *= np.sqrt(order_energies(flaws.order_scatter_seed, race, orders))
    return Harmonics(amplitudes, orders, _phases(scene, race)[orders - 1])


def order_energies(seeds: ArrayLike, race: int, orders: ArrayLike) -> NDArray[np.float64]:
    """Energies of orders of a race over those of the law, by seed: the exponential distribution of mean 1.

    It is that of one line of a Gaussian random surface whose mean spectrum is the law (Bendat and Piersol
    2010, sec. 8.5.1: two degrees of freedom). A factor belongs to its order, race and seed, whatever else is
    drawn: minus the logarithm of a number of the sequence SplitMix64 (Steele, Lea and Flood 2014, fig. 14)
    at the place that the three give.

    Parameters
    ----------
    seeds, orders : array_like of int
        Of any shapes that go together; orders from 1 to `HIGHEST_ORDER`.
    race : int
        Its place in `RACES`.
    """
    seed, order = np.broadcast_arrays(np.asarray(seeds, np.uint64), np.asarray(orders, np.uint64))
    place = np.atleast_1d((seed << np.uint64(11)) | np.uint64(race << 10) | order)
    z = (place + np.uint64(1)) * np.uint64(0x9E3779B97F4A7C15)  # wraps round, as meant
    z = (z ^ (z >> np.uint64(30))) * np.uint64(0xBF58476D1CE4E5B9)
    z = (z ^ (z >> np.uint64(27))) * np.uint64(0x94D049BB133111EB)
    z ^= z >> np.uint64(31)
    between = ((z >> np.uint64(11)).astype(float) + 0.5) * 2.0**-53  # above 0, below 1
    return -np.log(between).reshape(seed.shape)


def _phases(scene: Scene, race: int) -> NDArray[np.float64]:
    """Phases (rad) of all orders from 1 on: a phase belongs to its order, whatever the band.

    Phases of orders from 2 on are one draw; order 1 has a draw of its own.
    """
    assert scene.imperfections is not None
    seed, turn = scene.imperfections.seed, 2.0 * np.pi
    first = np.random.default_rng([seed, race, 1]).uniform(0.0, turn, 1)
    others = np.random.default_rng([seed, race]).uniform(0.0, turn, HIGHEST_ORDER - 1)
    return np.concatenate([first, others])


def ball_oversizes(scene: Scene) -> NDArray[np.float64]:
    """Deviation of each ball's diameter from their mean (m), uniform within the scene's spread."""
    count = scene.bearing.ball_count
    if scene.imperfections is None:
        return np.zeros(count)
    spread = si(scene.imperfections).ball_diameter_spread
    drawn = np.random.default_rng([scene.imperfections.seed, 2]).uniform(-spread, spread, count)
    return drawn - drawn.mean()


def ball_waves(scene: Scene) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Waviness of the balls: zonal harmonics about an axis fixed in each ball.

    Returns
    -------
    amplitudes : ndarray
        Of the orders 1 and up (m); empty where the scene has no ball waviness.
    axes : ndarray
        Shape ``(3, balls)``: where each ball's axis points at the start, unit vectors in the orbiting axes
        (x, r, theta), uniform on the sphere.
    """
    flaws = scene.imperfections
    if flaws is None or (flaws.ball_form_nm == 0.0 and flaws.ball_waviness_nm == 0.0):
        return np.empty(0), np.empty((3, 0))
    if flaws.ball_form_nm > 0.0:
        width = mean_patches(scene)[0].half_width if flaws.contact_filter else 0.0
        amplitudes = ball_profile(
            flaws, highest_orders(scene).balls, 2.0 * width / si(scene.bearing).ball_diameter
        )
    else:
        amplitudes = np.zeros(flaws.ball_waviness_order)
    if flaws.ball_waviness_nm > 0.0:
        amplitudes = np.pad(amplitudes, (0, max(flaws.ball_waviness_order - amplitudes.size, 0)))
        amplitudes[flaws.ball_waviness_order - 1] += si(flaws).ball_waviness
    # three normal deviates, normalised, point equally often into every direction
    drawn = np.random.default_rng([flaws.seed, 3]).normal(size=(scene.bearing.ball_count, 3))
    return amplitudes, (drawn / np.linalg.norm(drawn, axis=1)[:, None]).T


def excitation_end(scene: Scene, speed: float) -> float | None:
    """Highest frequency (Hz) at which waves of races and balls pass a contact at a shaft speed (rad/s).

    Above it the surfaces of the scene excite nothing. None: there are no waves, or the shaft does not turn.
    """
    alone = [bearing.scene for bearing in scene.bearings()]
    fastest = max(fastest_wave(one, race_harmonics(one), ball_waves(one)[0].size) for one in alone)
    return fastest * abs(speed) / (2.0 * np.pi) or None


def fastest_wave(scene: Scene, races: tuple[Harmonics, Harmonics], ball_orders: int) -> float:
    """Fastest phase of a wave under the balls, in rad per rad of the shaft; 0: there are no waves."""
    rates = frequencies(scene, 2.0 * np.pi)  # at one turn per second
    passing = (rates.f_r - rates.f_c, rates.f_c)
    fastest = [rate * max(race.orders, default=0) for rate, race in zip(passing, races, strict=True)]
    return float(max(*fastest, rates.f_b * ball_orders))
