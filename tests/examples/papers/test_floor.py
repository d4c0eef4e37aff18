"""A floor by images: against the closed form of a source over a rigid plane, and where it cannot lie."""

import math

import numpy as np
import pytest

from examples.papers.case import Case
from examples.papers.floor import HEIGHTS, floors, mirrored
from examples.papers.hearing import Ear


def test_a_place_and_its_mirror_are_as_far_from_the_floor():
    (one,) = mirrored([(0.1, -0.2, 0.3)], 0.5)
    assert one == pytest.approx((0.1, -0.2, -1.3))
    with pytest.raises(ValueError, match="leaves no air"):
        mirrored([(0.0, 0.0, -0.5)], 0.5)


def test_a_microphone_on_the_floor_hears_twice_the_pressure(tmp_path):
    """On a rigid plane the normal velocity is zero and pressure doubles: 6.02 dB, whatever the source."""
    recording = Case("7003C-spindle", 28000, (), 1, 0.01, 0.052).recording("compact")
    ear = Ear(recording, "compact", tmp_path)
    on = [(0.05, 0.1, -0.3 + 1e-9)]
    once, twice = (np.sqrt((p**2).mean()) for p in (ear.pressure(on), ear.pressure(on) + ear.pressure(
        mirrored(on, 0.3))))  # fmt: skip
    assert 20.0 * math.log10(twice / once) == pytest.approx(6.0206, abs=1e-3)


def test_floors_are_far_from_the_lowest_microphone_and_fade_with_height(tmp_path):
    recording = Case("7003C-spindle", 28000, (), 1, 0.01, 0.052).recording("compact")
    found = floors(Ear(recording, "compact", tmp_path), Case("7003C-spindle", 28000))["floors"]
    assert list(found) == ["free", *(f"{height}" for height in HEIGHTS)]
    own = recording.levels(radiation_model="compact")
    assert found["free"] == pytest.approx(own, abs=0.01)
    # P1, beside the housing: an image ten times as far away changes little, a near one more
    changes = [abs(found[f"{height}"][0] - found["free"][0]) for height in (HEIGHTS[0], HEIGHTS[-1])]
    assert changes[1] < 1.0 and changes[0] > changes[1]
