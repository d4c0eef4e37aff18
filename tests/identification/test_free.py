"""Free keys: their bounds, their scale, and what is refused."""

import math

import numpy as np
import pytest

from fmu_bearing.identification.errors import IdentifyError
from fmu_bearing.identification.free import box, free_numbers, scene_values, start_point


@pytest.fixture(scope="module")
def spindle(scene):
    return scene("7003C-spindle")


def test_positive_keys_are_logarithmic_and_reach_a_decade_each_way(spindle):
    (one,) = free_numbers(spindle, ["imperfections.unbalance_um"])
    assert (one.start, one.low, one.high, one.log, one.unit) == (0.5, 0.05, 5.0, True, "um")
    assert start_point([one])[0] == math.log(0.5)
    (wide,) = free_numbers(spindle, ["imperfections.unbalance_um=0.1:100"])
    assert (wide.low, wide.high) == (0.1, 100.0)


def test_other_keys_are_linear_between_their_bounds(spindle):
    (one,) = free_numbers(spindle, {"operation.oil_temperature_degC": (0.0, 80.0)})
    assert not one.log and one.scale == 80.0
    assert one.value(one.coordinate(35.0)) == pytest.approx(35.0)
    low, high = box([one])
    assert high - low == pytest.approx(1.0)


def test_a_pattern_is_one_factor_on_all_that_match(spindle):
    flaws = spindle.imperfections.model_copy(update={"outer_race_amplitude_um": 0.2})
    uneven = spindle.model_copy(update={"imperfections": flaws})
    (one,) = free_numbers(uneven, ["imperfections.*_race_amplitude_um"])
    assert one.keys == ("imperfections.inner_race_amplitude_um", "imperfections.outer_race_amplitude_um")
    found = scene_values([one], np.array([math.log(0.3)]))
    assert list(found.values()) == pytest.approx([0.3, 0.6])  # the ratio stays


@pytest.mark.parametrize(
    ("wanted", "message"),
    [
        ([], "no key is free: give KEY or KEY=LOW:HIGH"),
        (["imperfections.unbalance"], "did you mean 'imperfections.unbalance_um'"),
        (["imperfections.seed"], "imperfections.seed is 1, which is not a real number"),
        (["imperfections.ball_waviness_nm"], "starts at 0: give bounds above 0"),
        (["mounting.shaft_*"], "matches no number"),
        (["imperfections.unbalance_um=5:1"], "the lower bound must be below"),
        (["imperfections.unbalance_um=1:2"], "leaves out its start 0.5"),
        (["imperfections.unbalance_um=0:2"], "a logarithmic key needs bounds above 0"),
        (["imperfections.unbalance_um=0.1:1e6"], "reaches outside 0 to 100"),
        (["imperfections.unbalance_um=a:b"], "write KEY or KEY=LOW:HIGH"),
        (["imperfections.unbalance_um"] * 2, "is free twice"),
        (["imperfections.unbalance_um", "imperfections.unb*"], "is free under .* already"),
        (["operation.speed_rpm"], "is a condition of the data already"),
    ],
)
def test_what_is_refused(wanted, message, spindle):
    with pytest.raises(IdentifyError, match=message):
        free_numbers(spindle, wanted, conditions=["operation.speed_rpm"])


def test_a_key_that_starts_at_zero_begins_in_the_middle_of_its_bounds(spindle):
    (one,) = free_numbers(spindle, ["imperfections.ball_waviness_nm=1:100"])
    assert one.start == pytest.approx(10.0) and one.guessed
