"""Medians of results over neighbouring speeds."""

import pytest

from examples.papers.case import AROUND, FEW_AROUND, SEEDS, Case, around
from examples.papers.medians import by_seed, median


def test_each_number_has_its_own_median():
    results = [{"a": {"b": [k, -k]}, "c": float(k * k)} for k in (1, 2, 9)]
    assert median(results) == {"a": {"b": [2.0, -2.0]}, "c": 4.0}
    assert median([1.0, 3.0]) == 2.0
    with pytest.raises(ValueError, match="different forms"):
        median([{"a": 1.0}, {"b": 1.0}])
    with pytest.raises(ValueError):
        median([{"a": [1.0]}, {"a": [1.0, 2.0]}])


def test_results_are_joined_by_seed_and_speed():
    cases = around([Case("7003C-bare", rpm) for rpm in (10000, 20000)], (1, 2), FEW_AROUND)
    assert len(cases) == 20 and len(set(cases)) == 20
    found = by_seed((one, {"x": one.rpm * one.around + one.seed}) for one in cases)
    assert found[2] == {10000: {"x": pytest.approx(10002.0)}, 20000: {"x": pytest.approx(20002.0)}}


def test_speeds_around_a_speed_reach_the_scene():
    assert len(AROUND) == 9 and AROUND[0] == 0.96 and AROUND[-1] == 1.04 and len(SEEDS) == 4
    scene = around([Case("7003C-bare", 10000)], (3,), (0.96,))[0].build()
    assert scene.operation.speed_rpm == pytest.approx(9600.0) and scene.imperfections.seed == 3
