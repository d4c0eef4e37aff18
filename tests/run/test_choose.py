"""Fidelity auto: what is chosen, why, and how it is kept."""

import dataclasses
import math

import numpy as np
import pytest

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
    resolve,
    too_far,
)
from fmu_bearing.run.metrics import Errors
from fmu_bearing.scene import SceneError

NONE = Errors(0.0, 0.0, 0.0, 0.0, math.nan)
SHORT = {"warm_up": 0.02, "window": 0.02, "budget": 0.01}
FEW = tuple(c for c in CANDIDATES if c.method == "esdirk4")[:3]


@pytest.fixture(scope="module")
def loose(automatic):
    return choose(automatic(6.0, 0.5), FEW, **SHORT)


@pytest.fixture(scope="module")
def tight(automatic):
    return choose(automatic(0.01, 1e-3), FEW, **SHORT)


@pytest.fixture(scope="module")
def between(automatic):
    return choose(automatic(0.13, 0.02), FEW, **SHORT)


def test_three_accuracies_three_fidelities(loose, between, tight):
    """Response is 0.27 dB off over these 20 ms, rings 0.010 dB and 0.1 % in torque, full 0.002 dB."""
    assert [choice.probe.fidelity for choice in (loose, between, tight)] == ["response", "rings", "rings"]
    # what was measured does not depend on what was asked for; what follows from it does
    assert [probe.reason for probe in between.probes] == ["too far: ring velocity", "", "", ""]
    assert [probe.reason for probe in tight.probes] == [
        "too far: ring velocity, contact load",
        "",
        "",
        "",
    ]
    for choice, words in ((loose, "response, "), (between, "rings, "), (tight, "rings, ")):
        assert choice.summary.startswith(
            f"fidelity auto: {words}internal steps up to 20 us, tolerance 0.001: "
        )


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


def test_the_resolved_scene_is_the_one_written_by_hand(automatic, silent, loose, between, tight):
    """The scene's own 20 us and 1e-3 bound every candidate, so that nothing but the fidelity is new."""
    asked = automatic(0.01, 1e-3)
    with pytest.raises(SceneError, match="must be resolved first"):
        prepare(asked)
    for choice, fidelity in ((loose, "response"), (between, "rings"), (tight, "rings")):
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
    return [Probe("full", "esdirk4", 1e-3, 2e-5, NONE, pace, reason) for pace, reason in given]


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
        return Choice(scene.name, 1.0, 0.1, (dataclasses.replace(probes[0], errors=None), probes[1]), 1)

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


def test_resolve_tells_in_the_fmu(automatic, silent, counted):
    assert resolve(silent) == (silent, None)
    scene, choice = resolve(automatic(1.0, 0.1))
    assert scene.fidelity.model == "full"
    page = documentation.pages(prepare(scene, note=choice.summary))["index.html"].decode()
    assert "fidelity auto: full / esdirk4" in page
    assert "fidelity auto" not in documentation.pages(prepare(scene))["index.html"].decode().split("<pre>")[0]
