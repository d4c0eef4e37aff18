"""Whether the difference of two levels is a finding, and with what both were computed."""

import pytest

from fmu_bearing import compare
from fmu_bearing.recording.record import record
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
    """Recordings of the bare 7003C, one of them with a lighter preload, in fidelity response."""
    one = with_fidelity(scene("7003C-bare"), model="response")
    return [
        record(each, 0.05, settle=0.03, radiation_model="compact")
        for each in (one, one.replace({"mounting.preload_N": 200}))
    ]


def test_of_two_recordings(pair):
    both = compare(*pair)
    assert both.conditions() == "fidelity response, radiation model compact"
    found = both.finding("P1", 3)
    assert found.microphone == "P1" and len(found.drawn) == 3
    assert found.measured == both.b.levels["P1"][1] - both.a.levels["P1"][1]
    # the first draw is the scenes' own, in a run twice as long
    assert found.drawn[0] == pytest.approx(found.measured, abs=1.0)
    assert found.is_finding
    assert both.summary()["a"]["fidelity"] == "response"
    assert both.summary()["b"]["radiation_model"] == "compact"


def test_of_a_recording_and_itself(pair):
    found = compare(pair[0], pair[0]).finding(seeds=1)
    assert found.measured == 0.0 and found.drawn == (0.0,) and found.is_finding is False


def test_what_cannot_be_judged(pair, scene):
    one, other = pair
    assert "no seeds were requested" in compare(one, other).finding(seeds=0).reason
    perfect = record(
        with_fidelity(scene("7003C-bare"), model="response").replace({"imperfections": None}), 0.05,
        radiation_model="compact",
    )  # fmt: skip
    assert "B has no imperfections" in compare(one, perfect).finding().reason
    rings = with_fidelity(one.scene, model="rings")
    both = compare(one, rings, duration=0.05, settle=0.03, radiation_model="compact")
    assert both.conditions() == (
        "A: fidelity response, radiation model compact; B: fidelity rings, radiation model compact"
    )
    assert "A has fidelity response and B has rings, whose difference is in it" in both.finding().reason
