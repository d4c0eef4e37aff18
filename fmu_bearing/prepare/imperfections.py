"""Imperfections as numbers: race waviness tables and ball sizes, drawn once from the scene's seed."""

import numpy as np
from numpy.typing import NDArray

from fmu_bearing.engine.layout import WAVE_INTERVALS
from fmu_bearing.scene import Scene, si


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
    angle = 2.0 * np.pi * np.arange(WAVE_INTERVALS) / WAVE_INTERVALS
    argument = np.outer(orders, angle) + phases[:, None]
    table = np.empty(2 * WAVE_INTERVALS)
    table[0::2] = amplitudes @ np.cos(argument)
    table[1::2] = -(amplitudes * orders) @ np.sin(argument) * (2.0 * np.pi / WAVE_INTERVALS)
    return table


def race_waves(scene: Scene) -> NDArray[np.float64]:
    """Tables of inner and outer race one after the other; empty where the scene has no waviness."""
    flaws = scene.imperfections
    if flaws is None or max(flaws.inner_race_amplitude_um, flaws.outer_race_amplitude_um) == 0.0:
        return np.empty(0)
    orders = np.arange(flaws.lowest_order, flaws.highest_order + 1)
    values = si(flaws)
    tables = []
    for stream, amplitude in enumerate((values.inner_race_amplitude, values.outer_race_amplitude)):
        phases = np.random.default_rng([flaws.seed, stream]).uniform(0.0, 2.0 * np.pi, orders.size)
        tables.append(wave_table(np.full(orders.size, amplitude), orders, phases))
    return np.concatenate(tables)


def ball_oversizes(scene: Scene) -> NDArray[np.float64]:
    """Deviation of each ball's diameter from their mean (m), uniform within the scene's spread."""
    count = scene.bearing.ball_count
    if scene.imperfections is None:
        return np.zeros(count)
    spread = si(scene.imperfections).ball_diameter_spread
    drawn = np.random.default_rng([scene.imperfections.seed, 2]).uniform(-spread, spread, count)
    return drawn - drawn.mean()
