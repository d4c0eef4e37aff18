"""Imperfections as numbers: waviness of races and balls, ball sizes; drawn once from the scene's seed."""

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import P
from fmu_bearing.scene import Scene, si
from fmu_bearing.scene.imperfections import RACES, Imperfections


def wave_table(amplitudes: NDArray[np.float64], orders: NDArray[np.int64], phases: NDArray[np.float64]):
    """Height and slope of a wavy race at ``WAVE_INTERVALS`` equal angles.

    Parameters
    ----------
    amplitudes, orders, phases
        One entry per harmonic: m, waves per turn, rad.

    Returns
    -------
    ndarray
        Shape ``(2 * WAVE_INTERVALS,)``: height (m, positive towards the ball) and slope (m per interval)
        interleaved, as the engine's Hermite interpolation wants them.
    """
    angle = 2.0 * np.pi * np.arange(P.WAVE_INTERVALS) / P.WAVE_INTERVALS
    argument = np.outer(orders, angle) + phases[:, None]
    table = np.empty(2 * P.WAVE_INTERVALS)
    table[0::2] = amplitudes @ np.cos(argument)
    table[1::2] = -(amplitudes * orders) @ np.sin(argument) * (2.0 * np.pi / P.WAVE_INTERVALS)
    return table


def race_waves(scene: Scene) -> NDArray[np.float64]:
    """Tables of inner and outer race one after the other; empty where the scene has no waviness."""
    if scene.imperfections is None:
        return np.empty(0)
    found = [race_harmonics(scene.imperfections, race) for race in RACES]
    if not any(amplitudes.any() for amplitudes, _, _ in found):
        return np.empty(0)
    return np.concatenate([wave_table(*harmonics) for harmonics in found])


def race_harmonics(
    flaws: Imperfections, race: str
) -> tuple[NDArray[np.float64], NDArray[np.int64], NDArray[np.float64]]:
    """Amplitudes (m), orders and phases (rad) of the ``inner`` or ``outer`` race's waviness."""
    explicit = getattr(flaws, f"{race}_race_harmonic")
    amplitude = getattr(si(flaws), f"{race}_race_amplitude")
    if explicit:
        rows = [si(harmonic) for harmonic in explicit]
        return (
            np.array([row.amplitude for row in rows]),
            np.array([row.order for row in rows], dtype=np.int64),
            np.array([row.phase for row in rows]),
        )
    if not amplitude:
        return np.empty(0), np.empty(0, dtype=np.int64), np.empty(0)
    # the scene has checked that an amplitude comes with its orders
    assert flaws.lowest_order is not None and flaws.highest_order is not None
    orders = np.arange(flaws.lowest_order, flaws.highest_order + 1)
    draw = np.random.default_rng([flaws.seed, RACES.index(race)])
    return np.full(orders.size, amplitude), orders, draw.uniform(0.0, 2.0 * np.pi, orders.size)


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
    if flaws is None or flaws.ball_waviness_nm == 0.0:
        return np.empty(0), np.empty((3, 0))
    amplitudes = np.zeros(flaws.ball_waviness_order)
    amplitudes[-1] = si(flaws).ball_waviness
    # three normal deviates, normalised, point equally often into every direction
    drawn = np.random.default_rng([flaws.seed, 3]).normal(size=(scene.bearing.ball_count, 3))
    return amplitudes, (drawn / np.linalg.norm(drawn, axis=1)[:, None]).T
