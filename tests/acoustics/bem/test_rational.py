"""Rational functions of frequency: on known ones, and on boundary elements against direct solutions."""

import io
import re

import numpy as np
import pytest

from fmu_bearing.acoustics.radiation.bem import rational, solution as solved
from fmu_bearing.acoustics.radiation.bem.band import Band
from fmu_bearing.acoustics.radiation.bem.paths import task_of
from fmu_bearing.compiled import show
from tests.acoustics.bem.test_between import InTurn
from tests.acoustics.bem.test_paths import AIR, BARE

LOW, HIGH = 6000.0, 22_000.0
#: Frequencies (Hz) and quality factors of three resonances.
MODES = ((7100.0, 40.0), (9050.0, 90.0), (15_300.0, 25.0))


def response(f, seed=0, delay=2e-4):
    """Three drives with two parts of four quantities at frequencies (Hz): common poles and a delay."""
    draw = np.random.default_rng(seed)
    shape = (3, 2, 4)
    phase = np.exp(-2j * np.pi * f[:, None, None, None] * delay * draw.random(shape))
    found = phase * (1.0 + draw.random(shape))
    for mode, quality in MODES:
        strength = 0.05 * (draw.normal(size=shape) + 1j * draw.normal(size=shape))
        found = found + strength * mode**2 / (mode**2 - f**2 + 1j * f * mode / quality)[:, None, None, None]
    return found


class Counted:
    """Two groups, with the number of frequencies that were asked for."""

    def __init__(self, *functions):
        self.functions, self.asked = functions, []

    def __call__(self, frequencies):
        self.asked.append(len(frequencies))
        return [one(frequencies) for one in self.functions]


def test_search_follows_resonances_within_the_tolerance():
    measure = Counted(response, lambda f: response(f, 1))
    frequencies = rational.search(measure, LOW, HIGH, 60)
    assert len(frequencies) == sum(measure.asked) <= 26
    assert set(measure.asked[1:]) <= {1, 2}  # one where a pole is in doubt; the same on any number of cores
    wanted = np.linspace(LOW, HIGH, 2001)
    for function in measure.functions:
        group = rational.Group()
        group.renew(frequencies, function(frequencies))
        exact = function(wanted)
        assert np.abs(group.predicted(wanted) - exact).max() < rational.TYPICAL * np.abs(exact).max()


def test_poles_are_those_of_the_function():
    f = np.linspace(LOW, HIGH, 30)
    group = rational.Group()
    group.renew(f, response(f, delay=0.0))
    places, weights = group._fits[1]
    found = rational.poles(f[places], weights)
    for mode, quality in MODES:
        damped = mode * np.sqrt(1.0 - 0.25 / quality**2) + 0.5j * mode / quality
        assert np.abs(found - damped).min() < 1e-3 * mode / quality
    assert group.sharp(LOW, HIGH) == []


def test_a_pole_sharper_than_any_resonance_of_air_is_named():
    f = np.linspace(LOW, HIGH, 30)
    group = rational.Group()
    sharp = 1.0 / (1.0 - (f / 12_345.0) ** 2 + 1j * f / 12_345.0 / 900.0)
    group.renew(f, response(f, delay=0.0) + sharp[:, None, None, None])
    assert group.sharp(LOW, HIGH) == pytest.approx([12_345.0], rel=1e-4)
    assert group.sharp(LOW, 12_000.0) == []


def test_a_sharp_pole_that_does_no_harm_is_solved_once(monkeypatch):
    """It moves on with each fit, as one below the end of a band did until 80 frequencies were used up."""
    bound = [0.0]

    def sharp(group, low, high):
        bound[0] += 0.01
        return [HIGH - 1.0 + bound[0]]

    usual = rational.search(Counted(response), LOW, HIGH, 60)
    monkeypatch.setattr(rational.Group, "sharp", sharp)
    found = rational.search(Counted(response), LOW, HIGH, 60)
    assert len(found) == len(usual) + 1
    assert HIGH - 1.0 < found[-2] < HIGH - 0.9


def test_noise_does_not_end_the_search():
    """What no rational function of few poles follows is given back, for intervals to be halved."""

    def noise(f):
        draws = [np.random.default_rng(int(1e6 * one)).normal(size=(1, 1, 4)) for one in f]
        return np.array(draws) + 0j

    assert rational.search(Counted(noise), LOW, HIGH, 24) is None


def test_the_time_of_the_rest_is_right_within_half(monkeypatch):
    """Bare rings, whose frequencies take 1.4 s each, one at a time: a line after the first, then every 10 s.

    The part that is done never goes back.
    """
    now, log = [0.0], io.StringIO()
    monkeypatch.setattr(show.sys, "stderr", log)
    for clock in ("monotonic", "perf_counter"):
        monkeypatch.setattr(show.time, clock, lambda: now[0])
    monkeypatch.setattr(solved, "cores", lambda: 1)
    found = solved.Solution(task_of(BARE, AIR, 1))
    solve = Band.solve

    def timed(self, frequency):
        now[0] += 1.4
        return solve(self, frequency)

    monkeypatch.setattr(Band, "solve", timed)
    monkeypatch.setattr(solved, "ThreadPoolExecutor", InTurn)
    solved._solve_all(found)
    lines = [line for line in log.getvalue().splitlines() if "more" in line]
    assert "boundary elements of outer ring and inner ring, once for these bodies: " in lines[0]
    assert len(lines) >= 4
    parts = []
    for line in lines:
        shown = re.search(r"(\d+)% after (\d+) s, about (\d+) s more", line).groups()
        part, past, rest = (float(n) for n in shown)
        parts.append(part)
        assert line == lines[-1] or 1.0 / 1.5 < rest / (now[0] - past) < 1.5  # the last may be off by 1 s
    assert parts == sorted(parts)
    assert "after 1 s" in lines[0]
