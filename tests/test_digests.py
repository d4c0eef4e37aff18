"""Digests of results: equal for equal runs, and different for the smallest difference."""

import numpy as np

from benchmarks.digests import digest, settings, variants
from fmu_bearing.run.settings import Setting


def test_equal_runs_have_equal_digests_and_others_have_not(silent):
    rings = Setting("rings")
    assert digest(silent, rings) == digest(silent, rings)
    assert digest(silent, rings) != digest(silent, rings, jump=np.nextafter(1.01, 2.0))


def test_every_fidelity_and_method_is_run_where_it_carries_the_scene(scene):
    assert len(settings()) == 5  # three methods of full, rings, response
    bending = variants(scene("7009C-steel"))
    assert [sum(one.carries(made) for one in settings()) for made in bending.values()] == [3, 5]
