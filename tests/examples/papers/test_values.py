"""Values of the papers: intervals that rounded percentages leave, residuals, slopes, faulty tables."""

import math

import numpy as np
import pytest

from examples.papers import page, values
from examples.papers.identification import Answer, Found, amplitude
from examples.papers.statements import classed, verdict
from examples.papers.values import Interval, Met, Value, recovered
from tests.examples.papers.fitted import FITTED


@pytest.mark.parametrize(
    ("difference", "percent", "low", "high"),
    [
        ("0.24", "0.28", 82.46, 89.09),  # 0.235 / 0.285 % and 0.245 / 0.275 %
        ("2.36", "2.83", 83.07, 83.72),
        ("3.4", "4.12", 81.21, 83.84),  # one decimal of the difference: half a tenth each way
        ("2", "4", 33.33, 71.43),  # no decimals at all
    ],
)
def test_a_rounded_percentage_gives_an_interval(difference, percent, low, high):
    found = recovered(difference, percent)
    assert (found.low, found.high) == (pytest.approx(low, abs=0.005), pytest.approx(high, abs=0.005))


def test_every_value_that_rounds_so_lies_in_the_interval():
    draw = np.random.default_rng(1)
    for _ in range(2000):
        value, difference = draw.uniform(60, 95), draw.uniform(0.1, 4.0)
        shown = f"{difference:.2f}", f"{100 * difference / value:.2f}"
        found = recovered(*shown)
        assert found.low - 1e-9 <= value <= found.high + 1e-9, (value, shown)
    # and its ends are reached: just beyond them another percentage is printed
    for value, inside in ((found.low * 1.0001, True), (found.low * 0.999, False)):
        d = float(shown[0]) - 0.004999
        assert (f"{100 * d / value:.2f}" == shown[1]) is inside


@pytest.mark.parametrize(("difference", "percent"), [("0.24", "0.00"), ("0.2", "0"), ("-1.0", "1.0")])
def test_what_is_too_coarse_is_refused(difference, percent):
    with pytest.raises(ValueError, match="too coarsely"):
        recovered(difference, percent)


def test_residual_is_the_distance_to_the_interval():
    interval = Interval(82.5, 89.1)
    assert [interval.distance(v) for v in (80.0, 82.5, 86.0, 90.0)] == pytest.approx([-2.5, 0, 0, 0.9])
    value = Value("P1", "check", "measured", "leq", "P1", 26000, interval, "")
    one = Met(value, {1: (89.0, 93.0)})
    assert (one.level, one.residual, one.from_middle) == pytest.approx((91.0, 1.9, 5.2))


def test_a_bound_is_missed_from_one_side_alone(tmp_path, monkeypatch):
    head = "name,role,group,quantity,place,rpm,value,difference,percent,above,source,without,marked"
    (tmp_path / "x.csv").write_text(f"{head}\na,check,g,leq,P4,1,>80.9,,,,s,,\n")
    monkeypatch.setattr(values, "DATA", tmp_path)
    (bound,) = values.read("x")
    assert page.printed(bound.paper) == "at least 80.9"
    residuals = [Met(bound, {1: (level,)}).residual for level in (60.9, 80.9, 120.0)]
    assert residuals == pytest.approx([-20.0, 0.0, 0.0])
    assert Met(bound, {1: (60.9,)}).from_middle == pytest.approx(-20.0)


def test_ours_is_the_median_over_speeds_and_seeds():
    """One speed at which a line meets a mode moves nothing: all nine count the same, all seeds together."""
    value = Value("P1", "check", "measured", "leq", "P1", 1.0, Interval(70.0, 70.0), "")
    runs = [(1, {"P1": level}) for level in (70.0, 70.2, 69.8, 90.0, 70.1)]
    runs += [(2, {"P1": level, "other": 0.0}) for level in (71.0, 71.2, 70.8, 71.1, 50.0)]
    (one,) = values.met([value], runs)
    assert one.by_seed == pytest.approx((70.1, 71.0))
    assert one.level == pytest.approx(0.5 * (70.2 + 70.8))  # the middle two of ten
    assert values.met([value], [(1, {"other": 0.0})]) == []


def _met(paper, *ours, role="check", group="measured", without="", rpm=1.0, marked=""):
    value = Value(
        f"{paper} {rpm}", role, group, "leq", "P1", rpm, Interval(paper, paper), "", without, marked
    )
    return Met(value, {seed: (level,) for seed, level in enumerate(ours, 1)})


def test_rms_counts_distances_and_leaves_out_what_is_said_to_stay_out():
    found = [_met(70.0, 73.0, 73.0), _met(80.0, 75.0, 77.0), _met(82.5, 0.0, without="is not in the scene")]
    assert values.rms(found) == pytest.approx(math.sqrt((9 + 16) / 2))
    assert math.isnan(values.rms(found[2:]))
    assert values.rms_by_seed(found) == pytest.approx((math.sqrt((9 + 25) / 2), math.sqrt((9 + 9) / 2)))


def test_slope_is_per_decade():
    assert values.slope([1000, 10000, 100000], [50, 70, 90]) == pytest.approx(20.0)
    levels = [_met(50.0, 52.0, 48.0, rpm=1000.0), _met(70.0, 81.0, 79.0, rpm=10000.0)]
    table = page.slope_table(page.slopes("P1", levels))
    assert "| P1 | 2 | 0 | 20.0 | 30.0 | 29.0 to 31.0 | +10.0 | **not met** |" in table


def test_a_slope_counts_where_one_of_its_levels_was_fitted_at_most():
    one = [_met(50.0, 50.0, role="fit", rpm=1000.0), _met(70.0, 72.0, rpm=10000.0)]
    assert page.slopes("P1", one)[0].verdict == "met"
    two = [_met(50.0, 50.0, role="fit", rpm=1000.0), _met(70.0, 70.0, role="fit", rpm=10000.0)]
    (fitted,) = page.slopes("P1", [*two, _met(60.0, 99.0, rpm=5000.0)])
    assert not fitted.checked and fitted.verdict == "not counted: fitted"
    assert page.slopes("P1", two[:1]) == []


def test_what_is_marked_is_given_with_and_without():
    levels = [
        _met(50.0, 50.0, role="fit", rpm=1000.0), _met(70.0, 70.0, rpm=10000.0),
        _met(80.0, 71.0, rpm=20000.0, marked="raised by the motor"),
    ]  # fmt: skip
    whole, without = page.slopes("P3", levels)
    assert without.name == "P3, without 20,000" and without.ours == pytest.approx(20.0)
    assert whole.ours < without.ours
    text = page.values_part(levels)
    assert "| measured | 2 | 6.4 | 6.4 to 6.4 | 6.4 | **not met** |" in text  # sqrt((0 + 81) / 2)
    assert "| measured, without what is marked | 1 | 0.0 | 0.0 to 0.0 | 0.0 | met |" in text
    assert "80.0 20000.0 (raised by the motor)" in text


def test_the_verdict_says_what_was_fitted_and_how_far_off_the_rest_is():
    levels = [
        _met(50.0, 50.0, 50.0, role="fit", rpm=1000.0), _met(70.0, 72.0, 74.0, rpm=10000.0),
        _met(82.5, 0.0, 0.0, without="is not in the scene"),
    ]  # fmt: skip
    number = amplitude("50.0 1000.0")
    answer = Answer((Found(number, 0.3, 1.25, levels[0], (1.1, 1.4)),), (), 3)
    judged = classed([[verdict("a", [("x", m)]), verdict("b", [("x", 1.0)])] for m in (1.0, -1.0)], {})
    text = page.verdict_part(answer, levels, page.slopes("P1", levels[:2]), judged, "the seat.")
    assert max(map(len, text.splitlines())) <= 110 and "Missed" not in text
    text = " ".join(text.split())
    short = "1 number identified, each from one value; 2 values predicted, 1 within 3 dB; 2 statements"
    assert f"**In short:** {short} predicted, 1 hold." in text
    assert "**Fitted:** A_1 of both races, 1.25 um (start: 0.3), from 50.0 1000.0. Nothing else." in text
    assert "one value is 3.00 dB rms off (seeds 2.0 to 4.0), goal of 3 met." in text
    assert "Slope, P1: 23.0 dB per decade (seeds 22.0 to 24.0), paper 20.0: goal of 3 met." in text
    # what stays out of the averages is named all the same where values are farthest off
    assert "**Farthest off:** 82.5 1.0 -82.5 dB; 70.0 10000.0 +3.0 dB." in text
    assert "**Nobody could know:** the seat." in text


@pytest.mark.parametrize("name", FITTED)
def test_fitted_values_are_those_fixed_beforehand(name):
    found = values.read(name)
    assert {value.name for value in found if value.role == "fit"} == FITTED[name]
    assert all(value.source for value in found)


@pytest.mark.parametrize(
    ("row", "words"),
    [
        ("a,fit,g,leq,P1,1,80,2,3,,s,,", "give value, or difference and percent"),
        ("a,fit,g,leq,P1,1,,2,,,s,,", "give value, or difference and percent"),
        ("a,tuned,g,leq,P1,1,80,,,,s,,", "role is fit or check"),
        ("a,fit,g,leq,P1,1,80,,,,s,,\na,fit,g,leq,P1,1,81,,,,s,,", "two values are called a"),
    ],
)
def test_a_faulty_table_of_values_is_refused(tmp_path, monkeypatch, row, words):
    head = "name,role,group,quantity,place,rpm,value,difference,percent,above,source,without,marked"
    (tmp_path / "x.csv").write_text(f"{head}\n{row}\n")
    monkeypatch.setattr(values, "DATA", tmp_path)
    with pytest.raises(ValueError, match=words):
        values.read("x")


def test_a_number_beside_its_goal_shows_its_side():
    assert [page.near(x, 3.0) for x in (2.9, 2.996, 3.04, 3.06)] == ["2.9", "3.00", "3.04", "3.1"]
