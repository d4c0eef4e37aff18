"""Steps beside the clock: the rows, the advice and the refusals; the times themselves are never asserted."""

import math

import numpy as np
import pytest

from fmu_bearing import realtime
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import P
from fmu_bearing.run.step_times import COLUMNS, SHORT, Realtime, Timed
from tests.messages import says


def made(scene, *costs, step=1e-3, late=0):
    """Times of cases ``(fidelity, microphones, usual, worst)`` (s): a run-up with every tenth step the worst,
    then held, without; ``late`` of each phase's steps are late by the clock."""
    timed = []
    for fidelity, microphones, usual, worst in costs:
        rising = np.where(np.arange(100) % 10 == 5, worst, usual)
        for phase, cpu in (("run-up", rising), ("held", np.full(100, usual))):
            clock = np.where(np.arange(100) < late, 2.0 * step, 0.5 * step)
            timed.append(Timed(fidelity, microphones, phase, cpu, clock, step))
    return Realtime(scene("7003C-spindle"), step, tuple(timed), {}, "a machine")


def test_rows_have_quantiles_and_late_steps(scene):
    found = made(scene, ("rings", 4, 1e-4, 2e-3), late=3)
    columns, rows = found.table()
    assert tuple(columns) == COLUMNS
    # 10 of 100 steps take 2 ms, the others 0.1: mean 0.29
    assert rows[0] == ["rings", "4", "run-up", "100", "290", "100", "2000", "2000", "6.90", "3"]
    assert found.table(SHORT)[1][1] == ["rings", "4", "held", "100", "100", "100", "100", "3"]
    one = found.summary()["steps"][0]
    assert one["mean_s"] == pytest.approx(2.9e-4) and one["worst_s"] == 2e-3 and one["late"] == 3


def test_all_keep_a_long_step(scene):
    costs = [(name, count, 1e-3, 2e-3) for name in ("full", "rings", "response") for count in (0, 4)]
    advice = made(scene, *costs, step=1e-2).advice()
    assert says(advice, "Full with 4 microphones keeps ... 10 ms ... 2 ms, 20 % ... every other")
    assert "margin" not in advice and "not" not in advice


def test_one_alone_is_compared_with_nothing(scene):
    advice = made(scene, ("rings", 4, 1e-4, 9.997e-3), step=1e-2).advice()
    assert says(advice, "Rings with 4 microphones keeps ... 10 ms ... 10 ms, 100 % ... little margin")
    assert advice.count(". ") == 0


def test_the_most_complete_that_keeps_is_named_with_what_the_next_needs(scene):
    costs = ("full", 0, 9e-4, 1.4e-3), ("full", 4, 1.2e-3, 2e-3), ("rings", 0, 1e-4, 2e-4)
    advice = made(scene, *costs, ("rings", 4, 3e-4, 9.96e-4), late=2).advice()
    assert says(
        advice,
        "Rings with 4 microphones keeps ... 1 ms ... 996 us, 99.6 % ... little margin ... Full with 4 "
        "microphones does not ... 1.28 ms on average ... take fidelity rings, fewer microphones, no "
        "sound ... imperfections.highest_frequency_kHz ... faster machine ... 4 of its steps came late",
    )


def test_sound_alone_may_be_too_much(scene):
    advice = made(scene, ("response", 0, 1e-5, 5e-4), ("response", 1, 1e-3, 2e-3)).advice()
    assert "Response without sound keeps the step of 1 ms" in advice
    assert "With sound none does: steps of response with 1 microphone take 1.1 ms on average" in advice
    assert advice.endswith("; take no sound, or a faster machine.")  # response has no faster fidelity


def test_none_keeps_but_at_a_held_speed_or_in_longer_steps(scene):
    """One step of ten takes 3.5 ms: four in a row take 3.5 and three of 0.1, which is 3.8."""
    advice = made(scene, ("rings", 4, 1e-4, 3.5e-3), ("rings", 0, 5e-5, 3.4e-3)).advice()
    assert says(
        advice,
        "No fidelity keeps ... 1 ms ... rings without sound ... 3.4 ms ... held speed rings with 4 "
        "microphones does ... 100 us, 10 % ... To change: rings with 4 microphones ... step of 4 ms",
    )


def test_where_none_keeps_the_fastest_on_average_is_named(scene):
    """Full never takes above 9.6 ms, rings and response have steps of 34 and 44 ms, and are far cheaper."""
    timed = []
    for fidelity, run_up, worst, held in (
        ("full", 5e-3, 9.6e-3, 5e-3), ("rings", 1.1e-3, 34e-3, 0.61e-3), ("response", 0.8e-3, 44e-3, 0.13e-3)
    ):  # fmt: skip
        rising, late = np.full(100, run_up), np.full(100, held)
        rising[::50], late[10] = worst, 1.5e-3
        for phase, cpu in (("run-up", rising), ("held", np.maximum(late, held))):
            timed.append(Timed(fidelity, 0, phase, cpu, cpu, 1e-3))
    found = Realtime(scene("7003C-spindle"), 1e-3, tuple(timed), {}, "a machine")
    # response: (98 x 0.8 + 2 x 44) / 100; 1.5 and 0.61 ms do not fit into two steps, 1.5 and twice 0.61 do
    # into three
    assert says(
        found.advice(),
        "No fidelity keeps the step of 1 ms: response without sound takes 1.66 ms on average, which is "
        "least, and up to 44 ms. At the held speed rings without sound keeps it on average, by 619 us, and "
        "with a buffer of 3 ms; response without sound takes 144 us. To change: let the run-up take longer "
        "... steps of response without sound take 1.66 ms on average ... take a faster machine",
    )


def test_a_run_up_and_a_held_speed_are_timed_in_every_fidelity(scene):
    found = realtime(scene("7003C-bare"), 1e-3, duration=0.01, microphones=1)
    assert [one.case for one in found.timed] == [
        (name, count) for name in ("full", "rings", "response") for count in (0, 0, 1, 1)
    ]
    assert [one.phase for one in found.timed] == ["run-up", "held"] * 6
    for one in found.timed:
        assert one.cpu.shape == one.clock.shape == (10,)
        assert (one.cpu > 0.0).all() and (one.clock > 0.0).all()
    assert not found.left_out and "Python" in found.machine


def test_what_the_fmu_does_not_show_is_not_computed(scene, monkeypatch):
    """Switches of the engine, with the scene's names and with flat ones."""
    seen = []

    def kept(p, u):
        seen.append([bool(p[place]) for place in (P.READ_BALLS, P.READ_SOUND)])
        return Arrays(p, u)

    monkeypatch.setattr("fmu_bearing.run.realtime.Arrays", kept)
    bare, held = scene("7003C-bare"), {"duration": 4e-3, "fidelities": ["response"]}
    for outputs, naming, wanted in (
        (None, "structured", [[True, True], [True, True]]),
        (("friction_torque",), "structured", [[False, False], [False, False]]),
        (("mic[1].leq",), "flat", [[False, False], [False, True]]),
        (("contact.inner.load_max",), "flat", [[True, False], [True, False]]),
    ):
        seen.clear()
        found = realtime(bare.replace({"fmu.outputs": outputs, "fmu.naming": naming}), 1e-3, **held)
        assert seen == wanted, outputs
        assert ("all outputs are computed" in found.outputs()) == (outputs is None)
    assert "fmu.outputs = contact.inner.load_max: " in found.summary()["outputs"]


def test_nobody_keeps_a_tiny_step_and_response_a_long_one(scene):
    """A call alone takes above 0.1 us of any processor; lines over 0.2 s take some 20 us at held speed."""
    bare = scene("7003C-bare")
    advice = realtime(bare, 1e-7, duration=1e-6).advice()
    assert advice.startswith("No fidelity keeps the step of 0.1 us: ")
    assert "To change: give a longer step; below 100 us the cost" in advice
    held = (1e4 * RPM, 1e4 * RPM)
    found = realtime(bare, 0.2, duration=1.0, speeds=held, fidelities=["response"], microphones=0)
    assert [one.phase for one in found.timed] == ["held"]
    assert found.advice().startswith("Response without sound keeps the step of 200 ms: its worst step takes ")


def test_what_a_scene_cannot_have_is_named(example):
    """Bending rings have fidelity full alone."""
    found = realtime(example("7009C-full-ceramic").replace({"sound": None}), 1e-4, duration=1e-3)
    assert {one.fidelity for one in found.timed} == {"full"}
    assert set(found.left_out) == {"rings", "response"}
    assert all("rigid rings only" in reason for reason in found.left_out.values())


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"step": 0.0}, "step = 0 s is refused: give a finite time above 0"),
        ({"step": -1e-3}, "step = -0.001 s is refused"),
        ({"step": math.nan}, "step = nan s is refused"),
        ({"duration": math.inf}, "duration = inf s is refused"),
        ({"step": 1.0}, "allowed are 2 to 1,000,000 steps; give a duration of 2 to 1e"),
        ({"step": 1e-9}, "allowed are 2 to 1,000,000 steps; give a duration of 2e-09 to 0.001 s"),
        ({"fidelities": ["ful"]}, "fidelity = 'ful' is refused: known are full, rings, response"),
        ({"microphones": 5}, "microphones = 5 is refused: the scene has 4"),
        ({"microphones": -1}, "microphones = -1 is refused"),
    ],
)
def test_refusals(scene, given, words):
    with pytest.raises(ValueError, match=words.replace("(", r"\(")):
        realtime(scene("7003C-spindle"), **given)


def test_where_nothing_runs_the_reason_is_given_once(scene):
    """3 kN on a pedestal of 0.1 N/um: the ring would move by 30 mm."""
    soft = {"mounting.pedestal_stiffness_N_m": 1e5, "mounting.radial_load_z_N": -3000.0}
    with pytest.raises(
        ValueError, match="no fidelity of 7003C-bare could be timed: initialisation"
    ) as refused:
        realtime(scene("7003C-bare").replace(soft), 1e-3, duration=2e-3)
    assert str(refused.value).count("the loads push the outer ring sideways") == 1
