"""Figures and their differences."""

import math

import numpy as np
import pytest

from fmu_bearing.run.metrics import SILENT, errors, measure


def figures(rings=(2e-2, 3e-3), loads=(115.0, 116.0), torque=0.02, levels=(80.0, 70.0)):
    found = {f"{ring}_ring.velocity": value for ring, value in zip(("inner", "outer"), rings, strict=True)}
    found |= {f"contact.{race}.load_mean": one for race, one in zip(("inner", "outer"), loads, strict=True)}
    found |= {f"mic[{k + 1}].leq_a": level for k, level in enumerate(levels)}
    return found | {"friction_torque": torque}


BASE = figures()


def test_the_worse_of_each_pair_counts():
    other = figures((2e-2, 3.3e-3), (115.0, 110.2), 0.018, (80.5, 68.0))
    found = errors(other, BASE)
    assert found.ring_rms == pytest.approx(0.1)
    assert found.ring_level == pytest.approx(20 * math.log10(1.1))
    assert found.load == pytest.approx(0.05)
    assert found.torque == pytest.approx(0.1)
    assert found.level == pytest.approx(2.0)


def test_what_is_silent_in_both_has_no_error():
    silent = figures((1e-9, 0.0), torque=0.0, levels=(-40.0, -200.0))
    other = figures((0.0, SILENT), torque=0.0, levels=(-300.0, -1.0))
    found = errors(other, silent)
    assert (found.ring_rms, found.ring_level, found.torque, found.level) == (0.0, 0.0, 0.0, 0.0)
    assert errors(BASE, silent).torque == math.inf


def test_a_measured_run(silent):
    run = measure(silent, np.empty(0), 5e-3, 5e-3)
    assert run.rings.shape == (50, 6) and math.isnan(run.paces.constant)
    for k, ring in enumerate(("inner", "outer")):
        about = run.rings[:, 3 * k : 3 * k + 3] - run.rings[:, 3 * k : 3 * k + 3].mean(axis=0)
        assert run.figures[f"{ring}_ring.velocity"] == pytest.approx(
            math.sqrt((about**2).sum(axis=1).mean()), rel=1e-12
        )
    # 500 N on 12 balls at the loaded angle of some 21 degrees
    angle = run.figures["contact.inner.angle_mean"]
    assert run.figures["contact.inner.load_mean"] == pytest.approx(500 / 12 / math.sin(angle), rel=0.01)
    assert run.figures["cage.speed_ratio"] == pytest.approx(0.42, abs=0.01)
    assert not any(name.startswith("mic") for name in run.figures)


def test_sound_is_read_from_the_engines_own_meters(scene):
    from fmu_bearing.prepare.sound_block import sound_block

    spindle = scene("7003C-spindle")
    run = measure(spindle, sound_block(spindle), 5e-3, 5e-3)
    levels = [run.figures[f"mic[{k}].leq_a"] for k in (1, 2, 3, 4)]
    assert all(60.0 < level < 120.0 for level in levels)
    assert levels[0] > levels[1]  # the second microphone stands farther away


def test_what_is_not_a_number_is_no_small_error():
    for place in (0, 1):
        pair = [115.0, 116.0]
        pair[place] = math.nan
        assert math.isnan(errors(figures(loads=pair), BASE).load)
    assert errors(figures(levels=(80.0, math.nan)), BASE).level == math.inf
