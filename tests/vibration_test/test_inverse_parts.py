"""Parts of the inverse vibration test by hand: which run is which, deviations, what is furthest off."""

import numpy as np
import pytest

from fmu_bearing.vibration_test.inverse import runs
from fmu_bearing.vibration_test.inverse.energies import Window
from fmu_bearing.vibration_test.inverse.measured import Measured, measured
from fmu_bearing.vibration_test.inverse.posterior import Draws, Prior, Value
from fmu_bearing.vibration_test.inverse.remarks import check_met
from fmu_bearing.vibration_test.reading import Reading
from tests.vibration_test import known


def test_each_run_is_what_its_scene_says(monkeypatch):
    """In place of the runs: energies that number them, and what their scenes have."""
    scenes = []

    def read(scene):
        scenes.append(scene)
        return Reading(np.arange(2.0), np.full(2, float(len(scenes))), 0.0, 0.4)

    monkeypatch.setattr(runs, "reading", read)
    found = runs._run(known.runs(), iter)

    def flaws(number):
        return scenes[round(number) - 1].imperfections

    assert flaws(found.inner[0]).inner_race_amplitude_um == runs.AMPLITUDE_UM
    assert not flaws(found.inner[0]).ball_form_nm and not flaws(found.inner[0]).outer_race_harmonic
    count = scenes[0].bearing.ball_count
    for residue, energy in zip(found.residues, found.outer, strict=True):
        assert {one.order % count for one in flaws(energy[0]).outer_race_harmonic} == {residue}
    for exponent, energies in zip(runs.BALL_EXPONENTS, found.rigid, strict=True):
        of_balls = [flaws(energy[0]) for energy in energies]
        assert {one.waviness_exponent for one in of_balls} == {exponent}
        assert [one.seed for one in of_balls] == list(range(runs.BALL_SEEDS))
    assert [flaws(energy[0]).seed for energy in found.bent] == list(range(runs.BENT_SEEDS))
    bends = [scenes[round(one[0]) - 1].bends for one in (found.bent[0], found.rigid[0, 0])]
    assert bends == [True, False]


@pytest.mark.parametrize(("deviation", "of_middle"), [(0.1, 0.38), (0.5, 0.5)])
def test_the_middle_band_is_known_no_better_than_its_loading_piece(deviation, of_middle):
    given = measured(known.stub(), {"L": 41.0, "M": 42.0, "H": 54.0}, {"f_o": 9.0}, deviation, True)
    assert [one.name for one in given.windows] == ["L", "M", "H", "f_o"]
    assert [one.deviation for one in given.values] == [deviation, of_middle, deviation, deviation]
    assert [one.at_most for one in given.values] == [True, True, True, False]


def test_the_value_furthest_off_counts_by_its_own_deviation():
    """A factor of 2 at 38 % is nearer than one of 1.7 at 10 %."""
    windows = tuple(Window(name, 50.0, 300.0, k) for k, name in enumerate("LMH"))
    given = Measured(windows, (Value(40.0, 0.1), Value(40.0, 0.38), Value(50.0, 0.1)))
    draws = np.ones(10)
    drawn = Draws(draws, draws, draws, draws, draws, 10.0, 20.0, np.log([1.1, 2.0, 1.7]))
    prior = Prior((1e-3, 20.0), (10.0, 160.0))
    with pytest.raises(ValueError, match="H = 50 um/s is furthest off, the nearest law has 1.7 times"):
        check_met(drawn, prior, given)
    low, high = prior.exponent
    check_met(drawn._replace(best=1.0, exponent=np.linspace(low + 0.1, high - 0.1, 10)), prior, given)
