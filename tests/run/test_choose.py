"""Fidelity auto: what is chosen, why, and how it is kept."""

import dataclasses
import math

import pytest

from fmu_bearing.fmi import documentation
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

NONE = Errors(0.0, 0.0, 0.0, 0.0, math.nan)
SHORT = {"warm_up": 0.02, "window": 0.02, "budget": 0.01}
FEW = tuple(c for c in CANDIDATES if c.method == "esdirk4")[:3]


@pytest.fixture(scope="module")
def loose(automatic):
    return choose(automatic(6.0, 0.5), FEW, **SHORT)


@pytest.fixture(scope="module")
def tight(automatic):
    return choose(automatic(0.01, 1e-3), FEW, **SHORT)


def test_two_scenes_two_choices(automatic, loose, tight):
    """Loose bounds take the linear response; tight ones the whole bearing."""
    assert tight.probe.level == "full"
    assert too_far(tight.probe.errors, automatic(0.01, 1e-3)) == ""
    assert loose.probe.level in ("rings", "response")
    assert "response" in loose.summary or "rings" in loose.summary
    assert all(probe.reason.startswith("too far") for probe in tight.probes[:2])


def test_the_resolved_scene_is_concrete(automatic, tight):
    made = tight.apply(automatic(0.01, 1e-3)).fidelity
    assert made.level == "full" and made.method == tight.probe.method
    assert made.max_internal_step_us == pytest.approx(1e6 * tight.probe.max_step)
    assert prepare(tight.apply(automatic(0.01, 1e-3))).scene.fidelity.model == "full"


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
