"""Whether the difference of two levels is a finding, and with what both were computed."""

from dataclasses import replace

import pytest

from fmu_bearing import compare
from fmu_bearing.recording.record import record
from fmu_bearing.recording.studies import finding
from fmu_bearing.recording.studies.finding import Finding
from fmu_bearing.scene.read import with_fidelity


@pytest.mark.parametrize(
    ("measured", "drawn", "verdict"),
    [
        (-4.2, (-4.5, -4.1), True),
        (4.2, (4.5, 0.1), True),
        (1.0, (1.5, -0.2), False),  # another sign with one seed
        (1.0, (-1.5, -0.2), False),  # the runs compared are another draw
        (0.04, (0.2, 0.3), False),  # smaller than tables show
        (0.0, (0.0, 0.0), False),
    ],
)
def test_a_finding_has_one_sign(measured, drawn, verdict):
    found = Finding("P1", measured, drawn)
    assert found.is_finding is verdict and found.summary()["is_finding"] is verdict
    assert f"is {'a' if verdict else 'no'} finding: draws of the surfaces with 2 seeds, " in found.words()
    assert "0.1 dB or more and has one sign with every seed" in found.words()


def test_what_is_not_judged_says_why():
    found = Finding("P1", 3.0, reason="the scene of B is not known")
    assert found.is_finding is None and found.words().endswith("not judged: the scene of B is not known.")


@pytest.fixture(scope="module")
def pair(scene):
    """Recordings of the bare 7003C without cage, one with a lighter preload, in fidelity response."""
    one = with_fidelity(scene("7003C-bare"), model="response").replace({"bearing.cage": None})
    return [
        record(each, 0.05, settle=0.03, radiation_model="compact")
        for each in (one, one.replace({"mounting.preload_N": 300}))
    ]


@pytest.fixture(scope="module")
def both(pair):
    """The comparison of the two."""
    return compare(*pair)


@pytest.mark.heavy
def test_of_two_recordings(both):
    assert both.conditions() == "fidelity response, radiation model compact"
    found = both.finding("P1", 3)
    assert found.microphone == "P1" and len(found.drawn) == 3
    assert found.measured == both.b.levels["P1"][1] - both.a.levels["P1"][1]
    # the first draw is the scenes' own, in a run twice as long
    assert found.drawn[0] == pytest.approx(found.measured, abs=1.0)
    assert found.is_finding
    assert both.summary()["a"]["fidelity"] == "response"
    assert both.summary()["b"]["radiation_model"] == "compact"


@pytest.mark.heavy
def test_of_a_recording_and_itself(both):
    found = replace(both, b=both.a).finding(seeds=1)
    assert found.measured == 0.0 and found.drawn == (0.0,) and found.is_finding is False


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("change", "words"),
    [
        ({"scene": None}, "the scene of B is not known"),
        ({"fidelity": "rings"}, "A has fidelity response and B has rings, whose difference is in it"),
        ({"radiation_model": "bem"}, "A has radiation model compact and B has bem"),
        ({"radiation_model": "paper"}, "radiation model paper needs channels of its own"),
    ],
)
def test_what_cannot_be_judged(both, change, words):
    other = replace(both, b=replace(both.b, **change))
    found = other.finding()
    assert words in found.reason and found.is_finding is None and found.drawn == ()
    assert ("B: " in other.conditions()) is ("scene" not in change)


def test_a_perfect_bearing_and_no_seeds_are_not_judged(both):
    assert "no seeds were requested" in both.finding(seeds=0).reason
    perfect = replace(both.a, scene=both.a.scene.replace({"imperfections": None}))
    assert "A has no imperfections" in replace(both, a=perfect).finding().reason


def test_draws_that_go_the_other_way_are_no_judgement(both, monkeypatch):
    """Two bearings whose cages are loud, of which draws in response know nothing."""
    sides = [
        replace(side, fidelity="full", levels={"P1": (0.0, level)})
        for side, level in ((both.a, 60.0), (both.b, 55.0))
    ]
    monkeypatch.setattr(finding, "_estimator", lambda *_: None)
    monkeypatch.setattr(finding, "_obstacle", lambda *_: "")
    for drawn, contradicts in ((7.0, True), (-3.0, False)):
        levels = iter([50.0, 50.0 + drawn] * 2)
        monkeypatch.setattr(finding, "_level", lambda *_, levels=levels: next(levels))
        found = finding.judged(*sides, "P1", seeds=2)
        assert ("full and response contradict each other" in found.reason) == contradicts
        assert found.drawn == (drawn, drawn) and (found.is_finding is None) == contradicts
