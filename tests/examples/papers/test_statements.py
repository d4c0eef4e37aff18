"""Statements of the papers: verdicts from margins and trends, classes over seeds, reasons."""

import math

import pytest

from examples.papers import statements
from examples.papers.statements import BUILT, CHANCE, HOLDS, NOT, UNSEEN, Judged, Remark


def test_a_statement_holds_only_where_every_margin_is_positive():
    held = statements.verdict("a above b", [("10,000", 0.3), ("20,000", 4.0)])
    assert held.verdict == HOLDS and held.figures == "+0.3 to +4.0 dB"
    equal = statements.verdict("a above b", [("10,000", 0.0), ("20,000", 4.0)])
    assert equal.verdict == NOT and "in 1 of 2" in equal.figures and "10,000 (+0.0)" in equal.figures
    nowhere = statements.verdict("a above b", [("10,000", -1.0), ("20,000", -4.0)], "%")
    assert nowhere.verdict == NOT and nowhere.figures == "nowhere: -4.0 to -1.0 %"
    assert statements.verdict("a above b", []).verdict == UNSEEN
    assert statements.verdict("a above b", [("10,000", math.nan)]).verdict == NOT


@pytest.mark.parametrize(
    ("paper", "ours", "holds"),
    [
        (10.0, 12.9, True),  # within 3 dB
        (10.0, 14.9, True),  # within a factor of 1.5
        (10.0, 15.1, False),
        (10.0, 6.8, True),
        (10.0, 6.6, False),  # neither 3 dB nor 1 / 1.5
        (1.0, 3.9, True),
        (1.0, 4.1, False),
        (1.0, -0.5, False),  # near, but the other way
        (-4.0, -6.5, True),
        (-4.0, 0.1, False),
        (-4.0, -7.1, False),
    ],
)
def test_a_trend_holds_by_sign_and_size(paper, ours, holds):
    found = statements.trend("rises", [("20,000", paper, ours)])
    assert found.verdict == (HOLDS if holds else NOT)


def test_order_and_size_are_both_wanted():
    order = statements.verdict("grows", [("a", 1.0), ("b", 2.0)])
    small = statements.trend("", [("a to b", 9.0, 2.0)])
    assert statements.both(order, small).verdict == NOT
    fits = statements.both(order, statements.trend("", [("a to b", 3.0, 2.0)]))
    assert fits.verdict == HOLDS and fits.statement == "grows" and len(fits.margins) == 3
    assert statements.both(order, statements.trend("", [])).verdict == HOLDS  # nothing printed


def _seeds(holds, count=4):
    margins = [1.0] * holds + [-1.0] * (count - holds)
    return [[statements.verdict("s", [("x", margin)])] for margin in margins]


@pytest.mark.parametrize(("holds", "kind"), [(4, HOLDS), (3, CHANCE), (1, CHANCE), (0, NOT)])
def test_classes_follow_the_count_over_the_seeds(holds, kind):
    (found,) = statements.classed(_seeds(holds), {})
    assert (found.kind, found.holds, found.seeds) == (kind, holds, 4)
    assert found.share == pytest.approx(holds / 4)


def test_no_argument_gives_a_class_but_an_input_that_was_set():
    why = Remark("a line of mechanics")
    for holds, kind in ((4, HOLDS), (2, CHANCE), (0, NOT)):
        (found,) = statements.classed(_seeds(holds), {"s": why})
        assert (found.kind, found.remark, found.refutable) == (kind, "a line of mechanics", True)
    for holds in (4, 0):  # whatever the runs give
        (found,) = statements.classed(_seeds(holds), {"s": Remark("set to it", built=True)})
        assert (found.kind, found.refutable) == (BUILT, False)
    with pytest.raises(ValueError, match="nobody states: t"):
        statements.classed(_seeds(0), {"t": why})


def test_what_runs_cannot_refute_is_counted_apart():
    unseen = Judged("t", UNSEEN, "")
    found = statements.classed([[*one, unseen] for one in _seeds(4)], {"t": Remark("", built=True)})
    assert statements.counts(found) == (
        "Of 1 statements that runs can refute: 1 *holds*, 0 *does not hold*, 0 *chance*; beside them "
        "1 *not decidable*"
    )


def test_each_class_is_defined_once():
    table = statements.classes_table()
    assert [kind in table for kind in statements.CLASSES] == [True] * 5
    assert {statements.by_count(*pair) for pair in ((4, 4), (2, 4), (0, 4), (0, 0))} | {BUILT} == set(
        statements.CLASSES
    )
