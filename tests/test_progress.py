"""Progress: a bar on a terminal, else lines at equal distances, also while one call computes."""

import re
import sys
import time

import pytest

from fmu_bearing import progress
from fmu_bearing.progress import lines, steps, work

EVERY = 0.05  # s


@pytest.fixture
def said(monkeypatch):
    """Lines, printed often."""
    monkeypatch.setattr(progress, "EVERY", EVERY)
    return []


def test_a_line_is_told_now_and_then_also_during_one_call(said):
    with lines(said.append), work("matrix", 4.0, "rows") as one:
        one.at(1.0, "slow")
        time.sleep(10.5 * EVERY)  # one call that tells nothing
    assert 3 <= len(said) <= 10  # a busy machine tells fewer, none tells more
    assert set(said) == {"matrix: 1 of 4 rows, slow, after 0 s"} | {said[-1]}
    count = len(said)
    time.sleep(3 * EVERY)
    assert len(said) == count  # nothing after the end


def test_the_interval_is_ten_seconds():
    assert progress.EVERY == 10.0


def test_what_takes_less_than_the_interval_tells_nothing(monkeypatch):
    said = []
    monkeypatch.setattr(progress, "EVERY", 60.0)
    with lines(said.append), work("short"):
        pass
    assert said == []


def test_works_within_others_are_one_line(said):
    with lines(said.append), work("study"):
        for _ in steps(["a", "b"], "variants", "of them"):
            time.sleep(4 * EVERY)
    assert said[0] == "study: after 0 s; variants: 0 of 2 of them, after 0 s"
    assert any("variants: 1 of 2" in line for line in said)


def test_nothing_open_nothing_told(said):
    with lines(said.append):
        time.sleep(4 * EVERY)
    assert said == []


def test_a_work_that_fails_is_closed(said):
    with pytest.raises(ValueError, match="no"), work("fails"):
        raise ValueError("no")
    assert progress._open == []


def test_on_a_terminal_a_bar_is_drawn_and_no_line_is_told(said, monkeypatch, capsys):
    monkeypatch.setattr(type(sys.stderr), "isatty", lambda self: True, raising=False)
    monkeypatch.setenv("TERM", "xterm")
    with lines(said.append), work("run", 2.0, "s", keep=True) as one:
        assert one.bar
        with work("within", 1.0) as inner:
            assert not inner.bar  # one bar at a time
        one.at(2.0, "fast")
        time.sleep(3 * EVERY)
    assert said == []
    shown = capsys.readouterr().err
    assert "run" in shown and "2 of 2 s" in shown


def test_what_shows_itself_elsewhere_is_left_alone(said):
    with lines(said.append), work("command"), work("boundary elements", elsewhere=True):
        time.sleep(4 * EVERY)
    assert said == []


def test_shown_is_the_callers_choice():
    with work("quiet", shown=False) as one:
        assert not one.bar


@pytest.mark.parametrize(("total", "done", "words"), [(None, 0.0, "x: "), (None, 3.0, "x: 3 runs, ")])
def test_words_of_what_has_no_known_end(total, done, words):
    one = progress.Work("x", total, "runs", done)
    assert re.fullmatch(re.escape(words) + r"after 0 s", one.words())
    one.named("y")
    assert one.words().startswith("y: ")
