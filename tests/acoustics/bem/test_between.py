"""Transfer functions between solved frequencies, against boundary elements solved at each frequency."""

import contextlib

import numpy as np
import pytest

from fmu_bearing.acoustics.filters.design import radiation_of
from fmu_bearing.acoustics.radiation.bem import band as bands, solution as solved
from fmu_bearing.acoustics.radiation.bem.paths import task_of
from fmu_bearing.scene import read_scene
from tests.acoustics.bem.test_paths import AIR, BARE
from tests.conftest import EXAMPLES

#: Beside the bearing, ahead of it and close to its edge, m: none is where symmetry makes a drive silent.
POINTS = np.array([[0.02, 0.105], [-0.09, 0.01], [0.01, 0.06]])
_SILENT = 1e-3  # of the loudest harmonic of the balls: what is weaker is compared with this


class InTurn(contextlib.nullcontext):
    """A pool that solves one frequency after the other."""

    def __enter__(self):
        return self

    map = staticmethod(map)


def errors(found, count):
    """Largest error of each drive over its largest size, at frequencies drawn at random in each band."""
    draw = np.random.default_rng(7)
    wrong, largest = [], []
    for band in found.bands:
        wanted = np.sort(draw.uniform(band.frequencies[0], band.frequencies[-1], count))
        sounding = band._sounding(POINTS)
        exact = np.stack([sounding(f, band.solve(f)) for f in wanted], axis=-1)
        wrong.append(np.abs(band.transfer(POINTS, wanted) - exact).max(axis=(0, 2)))
        largest.append(np.abs(exact).max(axis=(0, 2)))
    size = np.max(largest, axis=0)
    balls = size[band.ball_drive(0, 0) :]
    size[band.ball_drive(0, 0) :] = np.maximum(balls, _SILENT * balls.max(initial=0.0))
    there = size > 1e-9 * size.max()
    return (np.max(wrong, axis=0)[there] / size[there]).max()


def solved_now(task):
    """Solve a task without the cache."""
    found = solved.Solution(task)
    for band in found.bands:
        band.search(InTurn())
    return found


def test_rational_functions_are_within_forty_decibels_of_direct_solutions():
    """-40 dB of each drive's largest pressure, with less than half of the frequencies that halving takes."""
    found = solved_now(task_of(BARE, AIR, 2))
    assert all(len(band.probed) for band in found.bands)
    assert sum(len(band.frequencies) for band in found.bands) <= 40
    assert errors(found, 25) < 10 ** (-40 / 20)


def test_intervals_are_halved_where_rational_functions_fail(monkeypatch):
    """Cubics miss the balls' weakest drive by -30 dB of its largest: what rational functions improve on."""
    monkeypatch.setattr(bands, "MOST", 10)
    found = solved_now(task_of(BARE, AIR, 1))
    assert not any(len(band.probed) for band in found.bands)
    for band, base in zip(found.bands, solved.BASE_FREQUENCIES, strict=True):
        assert set(base) < set(band.frequencies)
    assert errors(found, 10) < 10 ** (-28 / 20)


@pytest.mark.heavy
@pytest.mark.parametrize("name", ["7003C-spindle", "7009C-steel"])
def test_examples_are_within_forty_decibels_of_direct_solutions(name):
    """-40 dB; of the balls' harmonics those within 60 dB of the loudest."""
    radiation = radiation_of(read_scene(EXAMPLES / f"{name}.toml"))
    task = task_of(radiation.radiators, radiation.air, radiation.harmonics, radiation.modes)
    found = solved_now(task)
    assert all(len(band.probed) for band in found.bands)
    assert errors(found, 40) < 10 ** (-40 / 20)
