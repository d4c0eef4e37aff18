"""Figures and their differences."""

import math

import numpy as np
import pytest

from fmu_bearing.run.metrics import SILENT, Figures, errors, measure, ring_rms

BASE = Figures((2e-2, 3e-3), (115.0, 116.0), (0.37, 0.36), 0.02, 0.42, (80.0, 70.0))


def test_the_worse_of_each_pair_counts():
    other = Figures((2e-2, 3.3e-3), (115.0, 110.2), (0.37, 0.36), 0.018, 0.42, (80.5, 68.0))
    found = errors(other, BASE)
    assert found.ring_rms == pytest.approx(0.1)
    assert found.ring_level == pytest.approx(20 * math.log10(1.1))
    assert found.load == pytest.approx(0.05)
    assert found.torque == pytest.approx(0.1)
    assert found.level == pytest.approx(2.0)


def test_what_is_silent_in_both_has_no_error():
    silent = Figures((1e-9, 0.0), (115.0, 116.0), (0.37, 0.36), 0.0, 0.42, (-40.0, -200.0))
    other = Figures((0.0, SILENT), (115.0, 116.0), (0.37, 0.36), 0.0, 0.42, (-300.0, -1.0))
    found = errors(other, silent)
    assert (found.ring_rms, found.ring_level, found.torque, found.level) == (0.0, 0.0, 0.0, 0.0)
    assert errors(BASE, silent).torque == math.inf


def test_a_measured_run(silent):
    run = measure(silent, np.empty(0), 5e-3, 5e-3)
    assert run.rings.shape == (50, 6) and math.isnan(run.paces.constant)
    assert run.figures.ring_rms == pytest.approx(tuple(ring_rms(run.rings)))
    # 500 N on 12 balls at the loaded angle of some 21 degrees
    assert run.figures.load[0] == pytest.approx(500 / 12 / math.sin(run.figures.angle[0]), rel=0.01)
    assert run.figures.cage_ratio == pytest.approx(0.42, abs=0.01)
    assert run.figures.levels == ()


def test_sound_is_read_from_the_engines_own_meters(scene):
    from fmu_bearing.prepare.sound import sound_block

    spindle = scene("7003C-spindle")
    run = measure(spindle, sound_block(spindle), 5e-3, 5e-3)
    assert len(run.figures.levels) == 4
    assert all(60.0 < level < 120.0 for level in run.figures.levels)
    assert run.figures.levels[0] > run.figures.levels[1]  # the second microphone stands farther away


def test_what_is_not_a_number_is_no_small_error():
    for place in (0, 1):
        pair = [115.0, 116.0]
        pair[place] = math.nan
        assert math.isnan(errors(Figures(BASE.ring_rms, tuple(pair), *_rest()), BASE).load)
    levels = (80.0, math.nan)
    assert errors(Figures(BASE.ring_rms, BASE.load, *_rest()[:3], levels), BASE).level == math.inf


def _rest():
    return BASE.angle, BASE.torque, BASE.cage_ratio, BASE.levels
