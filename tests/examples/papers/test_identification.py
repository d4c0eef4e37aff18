"""Identification for the papers' pages: one number for each fitted value, and the search for them."""

import math

import numpy as np
import pytest

from examples.papers import impact_noise, multi_source, sound_field
from examples.papers.identification import BOTH, Number, amplitude, check_numbers, exponent, identify
from examples.papers.values import Interval, Met, Value

UNBALANCE = "imperfections.unbalance_um"


def value(name, level, role="fit"):
    return Value(name, role, "measured", "leq", "P1", 10000.0, Interval(level, level), "made up")


@pytest.mark.parametrize("module", [multi_source, sound_field, impact_noise], ids=lambda module: module.NAME)
def test_each_page_has_one_number_for_each_fitted_value(module):
    check_numbers(module.NUMBERS, module.VALUES)
    with pytest.raises(ValueError, match="but fitted values are"):
        check_numbers((*module.NUMBERS, amplitude("a value that is not there")), module.VALUES)
    with pytest.raises(ValueError, match="but fitted values are"):
        check_numbers(module.NUMBERS[1:], module.VALUES)


@pytest.mark.parametrize("slope", [1.0, 0.5, 2.5])
def test_the_search_ends_at_the_value(slope):
    target = value("a", 74.0)

    def levels(changes):
        (_, inner), (_, outer) = changes
        assert inner == outer  # both races together
        loud = 70.0 + slope * 20.0 * math.log10(inner)
        return {"a": Met(target, {1: (loud - 1.0, loud + 1.0), 2: (loud, loud)})}

    found = identify("7003C-spindle", (), (amplitude("a"),), [target], levels)
    (one,) = found.found
    assert one.fitted.level == pytest.approx(74.0, abs=0.11)  # it ends within 0.1 dB, at four digits
    assert one.after == pytest.approx(10.0 ** (4.0 / 20.0 / slope), rel=0.015 / slope)
    assert [key for key, _ in found.changes] == list(BOTH) and one.before == 0.3
    assert one.seeds == pytest.approx((one.after, one.after))  # both seeds have one median
    assert "| 74.0 | 74" in found.words


def test_two_numbers_are_found_together_and_seeds_give_a_range():
    """A level of waves with some unbalance in it, and a line of the unbalance alone: energies add."""
    loud, tone = value("loud", 80.0), value("tone", 84.0)

    def levels(changes):
        waves, unbalance = dict(changes)[BOTH[0]], dict(changes)[UNBALANCE]
        of_waves, of_unbalance = 10.0 * waves**2, 0.1 * unbalance**2
        total = 70.0 + 10.0 * math.log10(of_waves + 0.03 * of_unbalance)
        line = 70.0 + 10.0 * math.log10(of_unbalance)
        return {
            "loud": Met(loud, {1: (total + 2.0,), 2: (total - 2.0,)}),
            "tone": Met(tone, {1: (line,), 2: (line,)}),
        }

    numbers = (amplitude("loud"), Number("unbalance", "um", (UNBALANCE,), "tone", (0.05, 20.0), str))
    found = identify("7003C-spindle", (), numbers, [loud, tone], levels)
    waves, unbalance = found.found
    wanted = math.sqrt(10.0 ** (14.0 / 10.0) / 0.1)
    assert unbalance.after == pytest.approx(wanted, rel=0.015)  # 0.1 dB
    assert waves.after == pytest.approx(math.sqrt((10.0 - 0.03 * 10.0**1.4) / 10.0), rel=0.02)
    low, high = waves.seeds
    # waves carry 92 % of the level's energy: 4 dB of it are 4 / 0.92 dB of their amplitude
    assert high / low == pytest.approx(10.0 ** (4.0 / 0.92 / 20.0), rel=0.1) and low < waves.after < high
    assert found.tries <= 8


@pytest.mark.parametrize("held", [90.0, 40.0])
def test_an_exponent_is_found_from_a_second_speed_whatever_order_the_search_holds(held):
    """Waves of order 100 sound at the lower speed and of order 50 at twice it, each as A_1 n^-p."""
    low, high = value("low", 60.0), value("high", 68.0)

    def levels(changes):
        first, p = dict(changes)[BOTH[0]], dict(changes)["imperfections.waviness_exponent"]
        amounts = [first * n**-p for n in (100.0, 50.0)]
        one, other = (120.0 + 20.0 * math.log10(a) - 4.0 * k for k, a in enumerate(amounts))
        return {"low": Met(low, {1: (one,)}), "high": Met(high, {1: (other,)})}

    numbers = (amplitude("low", 20.0), exponent("high", "low", held))
    found = identify("7003C-spindle", (), numbers, [low, high], levels)
    wanted = 12.0 / (20.0 * math.log10(2.0))  # 8 dB and the 4 that the higher speed loses here
    assert found.found[1].after == pytest.approx(wanted, abs=0.05)
    assert found.found[0].after == pytest.approx(1e-3 * 100.0**wanted, rel=0.2)
    assert found.tries <= 8 and "ground races have 1 to 2" in found.words


def test_the_search_is_bounded_and_says_so():
    target = value("a", 74.0)
    found = identify(
        "7003C-spindle", (), (amplitude("a"),), [target],
        lambda changes: {"a": Met(target, {1: (10.0 + math.log10(changes[0][1]),)})},
    )  # fmt: skip
    assert found.found[0].after == pytest.approx(5.0) and "at its upper bound" in found.words


def test_a_search_that_cannot_end_gives_its_best():
    """A level that jumps over its value: the nearest try is the answer."""
    target, asked = value("a", 74.0), []

    def levels(changes):
        asked.append(changes[0][1])
        return {"a": Met(target, {1: (77.0 if changes[0][1] > 0.4 else 73.0,)})}

    found = identify("7003C-spindle", (), (amplitude("a"),), [target], levels)
    assert found.found[0].fitted.level == 73.0 and found.tries == len(asked) <= 8
    assert np.isfinite(found.found[0].after)
