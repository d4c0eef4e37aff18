"""Fidelity auto: what is chosen, why, and how it is kept."""

import dataclasses
import math

import numpy as np
import pytest

from fmu_bearing.arrays import EngineError
from fmu_bearing.engine.constants import RPM
from fmu_bearing.fmi import documentation
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.run import choose as choosing
from fmu_bearing.run.choose import (
    CANDIDATES,
    FINEST,
    Choice,
    Probe,
    bounded,
    choose,
    chosen,
    conditions,
    resolve,
    too_far,
)
from fmu_bearing.run.metrics import Errors
from fmu_bearing.scene import SceneError
from fmu_bearing.scene.read import with_fidelity

NONE = Errors(0.0, 0.0, 0.0, 0.0, math.nan)
SHORT = {"warm_up": 0.02, "window": 0.02, "budget": 0.01}
FEW = tuple(c for c in CANDIDATES if c.method == "esdirk4")[:3]


@pytest.fixture(scope="module")
def silent(scene):
    """The gate scene of the spindle without sound; at its own 0.5 us the axial mode is weakly damped."""
    return scene("7003C-spindle").replace({"sound": None, "bearing.contact_damping_us": 2.5})


@pytest.fixture(scope="module")
def automatic(silent):
    """Return the silent scene with fidelity auto and an accuracy."""

    def make(level_dB, relative):
        return with_fidelity(silent, model="auto", accuracy={"level_dB": level_dB, "relative": relative})

    return make


@pytest.fixture(scope="module")
def loose(automatic):
    return choose(automatic(6.0, 0.5), FEW, **SHORT)


@pytest.fixture(scope="module")
def tight(automatic):
    return choose(automatic(0.01, 1e-3), FEW, **SHORT)


@pytest.fixture(scope="module")
def between(automatic):
    return choose(automatic(0.13, 0.02), FEW, **SHORT)


@pytest.mark.heavy
def test_three_accuracies_three_fidelities(loose, between, tight):
    """Over these 20 ms, worst of three conditions, in dB of ring velocity and in torque.

    Response is 0.64 dB off, rings 0.016 dB (at half the speed) and 1.5 % (while the speed rises: balls are
    accelerated by friction), full 0.002 dB and 0.05 %.
    """
    assert [choice.probe.fidelity for choice in (loose, between, tight)] == ["response", "rings", "full"]
    # what was measured does not depend on what was asked for; what follows from it does
    velocity, torque = "too far: ring velocity", "friction torque"
    assert [probe.reasons for probe in between.probes] == [(velocity,) * 3, *[("",) * 3] * 3]
    load = f"{velocity}, contact load"
    assert [probe.reasons for probe in tight.probes] == [
        (load, load, f"{load}, {torque}"),
        ("", velocity, f"too far: {torque}"),
        ("",) * 3,
        ("",) * 3,
    ]
    for choice, words in ((loose, "response, "), (between, "rings, "), (tight, "full / esdirk4, ")):
        assert choice.words().startswith(
            f"fidelity auto: {words}internal steps up to 20 us, tolerance 0.001: "
        )
        assert choice.words().endswith(
            "; probed at 20,000 r/min, 10,000 r/min and 19,600 to 20,000 r/min in 20 ms; not probed: other "
            "loads, preloads and temperatures, jumps of inputs, faster changes of speed"
        )


@pytest.mark.heavy
def test_the_table_has_a_row_for_each_condition(between):
    columns, cells = between.cells()
    rows = [dict(zip(columns, row, strict=True)) for row in cells]
    assert len(rows) == 3 * len(between.probes)
    assert [row["at"] for row in rows[:3]] == list(between.probed)
    assert [row["fidelity"] for row in rows[:6]] == ["response"] * 3 + ["rings"] * 3
    assert [row["verdict"] for row in rows[3:6]] == ["accurate, chosen", "accurate", "accurate"]
    assert all(row["torque"] and row["ring level, dB"] for row in rows)
    columns, cells = between.table()
    short = [dict(zip(columns, row, strict=True)) for row in cells]
    assert [row["fidelity"] for row in short] == [probe.fidelity for probe in between.probes]
    assert short[1]["torque"] == " / ".join(row["torque"] for row in rows[3:6])
    assert short[0]["verdict"].startswith("too far: ring velocity at 20,000 r/min; too far: ring velocity at")
    assert [row["verdict"] for row in short[1:]] == ["accurate, chosen", "accurate", "accurate"]


def rpm(condition):
    return tuple(round(speed / RPM) for speed in (condition.first, condition.last))


def test_conditions_follow_the_scene(automatic):
    """Half the speed or the lowest of a run-up; the last 60 ms of a rise that takes a second from rest."""
    scene = automatic(1.0, 0.1)
    assert [rpm(one) for one in conditions(scene)] == [(20000, 20000), (10000, 10000), (18800, 20000)]
    for speed, lowest, wanted in ((20e3, 3e3, 3000), (-20e3, 3e3, -3000), (20e3, 2e4 - 1, 19999)):
        keys = {"operation.speed_rpm": speed, "operation.lowest_speed_rpm": lowest}
        own, second, rise = conditions(scene.replace(keys))
        assert rpm(own) == (speed, speed) and rpm(second) == (wanted, wanted)
        assert rpm(rise) == (0.94 * speed, speed)
    at_rest = {"operation.speed_rpm": 0.0, "operation.lowest_speed_rpm": 1e3}
    assert [rpm(one) for one in conditions(scene.replace(at_rest))] == [(0, 0)]
    for speed in (2e4, -2e4):
        held = {"operation.speed_rpm": speed, "operation.lowest_speed_rpm": 2e4}
        assert [rpm(one) for one in conditions(scene.replace(held))] == [(speed, speed)]


def test_a_held_speed_is_probed_alone(automatic):
    """Its lowest speed is its own; what is kept for the scene with a run-up is no choice for it."""
    scene = automatic(6.0, 0.5)
    held = scene.replace({"operation.lowest_speed_rpm": 2e4})
    found = choose(held, FEW[:1], warm_up=2e-3, window=2e-3, budget=1e-3)
    assert found.probed == ("20,000 r/min",) and len(found.probes[0].errors) == 1
    words = "not probed: another speed and a rise of speed, as 20,000 r/min are held (operation.lowest_speed"
    assert words in found.words()


def test_at_standstill_it_says_what_it_left_out(automatic):
    at_rest = {"operation.speed_rpm": 0.0, "operation.lowest_speed_rpm": 1e3}
    found = choose(automatic(6.0, 0.5).replace(at_rest), FEW[:1], warm_up=2e-3, window=2e-3, budget=1e-3)
    assert found.probed == ("0 r/min",)
    assert "not probed: another speed and a rise of speed, as the shaft does not turn; other" in found.words()


@pytest.mark.heavy
def test_a_bearing_that_whirls_by_itself_takes_full(automatic, example):
    """The 7009C at 18,000 r/min, and at 36,000: half of that is 18,000."""
    steel = example("7009C-steel").with_rigid_rings().replace({"sound": None})
    wide = steel.model_copy(update={"fidelity": automatic(20.0, 1.0).fidelity})
    found = choose(wide, FEW, warm_up=2e-3, window=2e-3, budget=1e-3)
    assert found.probe.fidelity == "full"
    for probe in found.probes[:2]:
        assert probe.errors == () and probe.worst is None and math.isnan(probe.pace)
        assert probe.reason.startswith("left out: the ring whirls by itself at ")
    assert "; response and rings left out: the ring whirls by itself at 1320 Hz" in found.words()
    assert found.table()[1][0][-1] == found.probes[0].reason and found.table()[1][0][4] == ""
    rows = found.cells()[1]
    assert len(rows) == 2 + 3 + 3 and rows[0][4] == "all" and rows[2][-1] == "accurate, chosen"
    lowest = wide.replace({"operation.speed_rpm": 9000.0, "operation.lowest_speed_rpm": 18000.0})
    found = choose(lowest, FEW[:2], warm_up=2e-3, window=2e-3, budget=1e-3)
    assert found.probes[0].reason.startswith("left out: at 18,000 r/min the ring whirls by itself at ")


def test_a_weakly_damped_bearing_takes_full(automatic, scene):
    """The gate scene at its own contact damping: its axial mode has a damping ratio of 0.006."""
    gate = scene("7003C-spindle").replace({"sound": None})
    wide = gate.model_copy(update={"fidelity": automatic(20.0, 1.0).fidelity})
    found = choose(wide, FEW, warm_up=2e-3, window=2e-3, budget=1e-3)
    assert found.probe.fidelity == "full" and "'inner axial'" in found.probes[0].reason


def test_a_speed_at_which_full_is_refused_is_said(automatic, monkeypatch):
    whole = choosing.measure_between

    def refused(scene, sounds, warm_up, window, first, last):
        if first == last:
            raise EngineError("no equilibrium")
        return whole(scene, sounds, warm_up, window, first, last)

    monkeypatch.setattr(choosing, "measure_between", refused)
    found = choose(automatic(6.0, 0.5), FEW[:1], warm_up=2e-3, window=2e-3, budget=1e-3)
    assert found.probed == ("20,000 r/min", "19,960 to 20,000 r/min in 2 ms")
    assert "not probed: 10,000 r/min, where fidelity full is refused (no equilibrium); " in found.words()


def read(scene):
    """Rms velocity of both rings (m/s), mean contact load (N) and torque (N m), over 20 ms after 20 ms."""
    run = Instance(prepare(scene))
    run.initialise()
    names = [f"{ring}_ring.velocity.{axis}" for ring in ("inner", "outer") for axis in "xyz"]
    rows = []
    for _ in range(400):
        run.step(1e-4)
        rows.append([run.get(name) for name in (*names, "contact.inner.load_mean", "friction_torque")])
    rings, load, torque = np.split(np.array(rows[200:]), (6, 7), axis=1)
    squares = rings.var(0)
    return np.sqrt([squares[:3].sum(), squares[3:].sum()]), load.mean(), torque.mean()


@pytest.mark.heavy
def test_the_chosen_fidelity_is_as_accurate_as_asked_for(automatic, silent, loose, tight):
    """Run as a user would, beside fidelity full in steps ten times as fine as the scene's."""
    truth = read(prepare(silent, max_step=2e-6).scene)
    for choice, level_dB, relative in ((loose, 6.0, 0.5), (tight, 0.01, 1e-3)):
        rings, load, torque = read(choice.apply(automatic(level_dB, relative)))
        assert np.abs(20 * np.log10(rings / truth[0])).max() < level_dB
        assert load == pytest.approx(truth[1], rel=relative)
        assert torque == pytest.approx(truth[2], rel=relative)
    # the loose one would not have done for the tight bounds
    rings, _, _ = read(loose.apply(silent))
    assert np.abs(20 * np.log10(rings / truth[0])).max() > 0.1


@pytest.mark.heavy
def test_the_resolved_scene_is_the_one_written_by_hand(automatic, silent, loose, between, tight):
    """The scene's own 20 us and 1e-3 bound every candidate, so that nothing but the fidelity is new."""
    asked = automatic(0.01, 1e-3)
    with pytest.raises(SceneError, match="must be resolved first"):
        prepare(asked)
    for choice, fidelity in ((loose, "response"), (between, "rings"), (tight, "full")):
        by_hand = prepare(silent, fidelity=fidelity).parameters
        # 20 us to s and back may cost the last digit
        np.testing.assert_allclose(prepare(choice.apply(asked)).parameters, by_hand, rtol=1e-15, atol=0)


def test_the_scenes_tolerance_and_step_are_upper_bounds(automatic):
    scene = automatic(1.0, 0.1)
    for candidate in (*CANDIDATES, FINEST):
        made = bounded(candidate, scene).fidelity
        assert made.tolerance <= scene.fidelity.tolerance
        assert made.max_internal_step_us <= scene.fidelity.max_internal_step_us


def test_every_bound_is_held(automatic):
    scene = automatic(1.0, 0.1)
    assert too_far(NONE, scene) == ""
    for field, value, word in (
        ("ring_level", 1.1, "ring velocity"),
        ("level", 1.1, "sound"),
        ("load", 0.11, "contact load"),
        ("torque", math.inf, "friction torque"),
        ("load", math.nan, "contact load"),
    ):
        assert too_far(dataclasses.replace(NONE, **{field: value}), scene) == f"too far: {word}"


def _probes(*given):
    return [Probe("full", "esdirk4", 1e-3, 2e-5, (NONE,), pace, (reason,)) for pace, reason in given]


def test_noise_of_the_clock_does_not_change_the_choice():
    assert choosing._cheapest(_probes((9.0, "too far: sound"), (2.0, ""), (2.4, ""), (0.1, ""))) == 1
    assert choosing._cheapest(_probes((9.0, "too far: sound"), (2.0, ""), (3.4, ""), (0.1, ""))) == 2


@pytest.fixture
def counted(monkeypatch, tmp_path):
    """Probing replaced by a count; the cache is this test's own."""
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path))
    calls = []

    def counting(scene):
        calls.append(scene)
        probes = _probes((100.0, "too far: sound"), (2.0, ""))
        return Choice(scene.name, 1.0, 0.1, (dataclasses.replace(probes[0], errors=()), probes[1]), 1)

    monkeypatch.setattr(choosing, "choose", counting)
    return calls


def test_a_choice_is_kept_and_remade_when_damaged(automatic, counted):
    scene = automatic(1.0, 0.1)
    first = chosen(scene)
    assert repr(chosen(scene)) == repr(first) and len(counted) == 1
    path = choosing.cache_file(scene)
    for damage in (
        "",
        "{",
        "[]",
        '{"probes": []}',
        path.read_text().replace('"chosen": 1', '"chosen": 0'),
        "\0",
    ):
        path.write_text(damage)
        before = len(counted)
        assert repr(chosen(scene)) == repr(first) and len(counted) == before + 1
    assert choosing.cache_file(automatic(2.0, 0.1)) != path


def test_a_cache_that_cannot_be_written_costs_time_only(automatic, counted, monkeypatch, tmp_path):
    (tmp_path / "file").write_text("")
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path / "file"))
    assert chosen(automatic(1.0, 0.1)).chosen == 1


def test_resolve_reports_in_the_fmu(automatic, silent, counted):
    assert resolve(silent) == (silent, None)
    scene, choice = resolve(automatic(1.0, 0.1))
    assert scene.fidelity.model == "full"
    page = documentation.pages(prepare(scene, note=choice.words()))["index.html"].decode()
    assert "fidelity auto: full / esdirk4" in page
    assert "fidelity auto" not in documentation.pages(prepare(scene))["index.html"].decode().split("<pre>")[0]
