"""How long the steps of `full` may be where a bearing has neither waves nor sound nor cage."""

import math

import numpy as np
import pytest

from fmu_bearing import new_scene, read_scene, with_fidelity
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import Q, S, Y
from fmu_bearing.prepare.imperfections import frequencies
from fmu_bearing.prepare.step_limits import longest_internal_step
from fmu_bearing.scene.read import read_scene_text
from tests.conftest import ROOT

STILL = {"imperfections": None, "bearing.cage": None}
TILTS = S.Y + Y.Q0 + np.array([Q.BY, Q.BZ])


@pytest.fixture(scope="module")
def spindle():
    return read_scene(ROOT / "examples" / "scenes" / "7003C-spindle.toml").replace({"sound": None})


def steps_per_ms(scene, rpm=None, **parameters):
    """Steps of a settled run, and its mean torque (N m)."""
    run = Arrays.of(scene if rpm is None else scene.replace({"operation.speed_rpm": rpm}), **parameters)
    run.init()
    run.run(0.04, 1e-3)
    begin = run.s[S.STEPS]
    run.run(0.01, 1e-3)
    return (run.s[S.STEPS] - begin) / 10.0, run.s[S.MEAN_TORQUE]


def test_a_still_bearing_takes_the_steps_that_its_whirls_allow(spindle):
    """0.75 rad of twice the balls' turning are 60 us at 20,000 r/min; the torque is that of 24 us."""
    still = spindle.replace(STILL)
    rates = frequencies(still, 20e3 * RPM)
    allowed = 0.75 / (2.0 * 2.0 * math.pi * (rates.f_b + rates.f_c))
    assert longest_internal_step(still) == pytest.approx(allowed, rel=1e-12)
    assert 55e-6 < allowed < 65e-6
    count, torque = steps_per_ms(still)
    assert count == math.ceil(1e-3 / allowed)
    usual, same = steps_per_ms(still, MAX_STEP=24e-6)
    assert usual == 42.0  # a step that the user gives is kept
    assert torque == pytest.approx(same, rel=1e-6)
    # 100 us at most, and never less than the default
    assert steps_per_ms(still, 2e3)[0] == 10.0
    assert steps_per_ms(still, 60e3)[0] == 40.0


@pytest.mark.parametrize(
    "kept", ["bearing.cage", "imperfections", "sound", "method", "max_internal_step_us", "model"]
)
def test_whatever_asks_for_short_steps_keeps_the_default(spindle, kept):
    scene = spindle.replace({name: value for name, value in STILL.items() if name != kept})
    if kept == "sound":
        scene = read_scene(ROOT / "examples" / "scenes" / "7003C-spindle.toml").replace(STILL)
    elif kept == "method":
        scene = with_fidelity(scene, method="trbdf2")
    elif kept == "max_internal_step_us":
        scene = with_fidelity(scene, max_internal_step_us=20.0)
    elif kept == "model":
        scene = with_fidelity(scene, model="rings")
    assert longest_internal_step(scene) == (20e-6 if kept == "max_internal_step_us" else 25e-6)
    if kept not in ("sound", "model"):
        assert steps_per_ms(scene)[0] >= 40.0


def test_a_set_follows_its_slowest_bearing_and_keeps_short_steps_for_one_cage():
    pair = read_scene(ROOT / "examples" / "spindle_set" / "7003C-DB.toml").replace({"sound": None})
    assert longest_internal_step(pair) == 25e-6
    still = pair.replace(STILL)
    rates = frequencies(still.bearings()[0].scene, still.operation.speed_rpm * RPM)
    allowed = 0.75 / (2.0 * 2.0 * math.pi * (rates.f_b + rates.f_c))
    assert longest_internal_step(still) == pytest.approx(allowed, rel=1e-12)
    assert steps_per_ms(still)[0] == math.ceil(1e-3 / allowed)


@pytest.mark.parametrize(
    ("bearing", "rpm", "preload", "first", "last", "growth"),
    [("NSK-7014C", 18000.0, 290.0, 60, 100, 58.9), ("NSK-7911AC", 24000.0, 200.0, 8, 16, 650.0)],
)
def test_a_ring_whirls_by_itself_at_the_rate_of_short_steps(bearing, rpm, preload, first, last, growth):
    """Growth (1/s) of the tilt between two instants (ms), with steel balls, kicked by 1e-8 rad."""
    text = new_scene("whirl", bearing, speed_rpm=rpm, preload_N=preload, sound=False, kind="steel")
    scene = read_scene_text(text, "whirl").replace(STILL)
    found = []
    for parameters in ({}, {"MAX_STEP": 4e-6}):
        run = Arrays.of(scene, **parameters)
        run.init()
        begin = run.s[TILTS].copy()
        run.s[TILTS[0]] += 1e-8
        sizes = []
        for _ in range(last + 1):
            run.step(1e-3)
            sizes.append(np.hypot(*(run.s[TILTS] - begin)))
        found.append(math.log(sizes[last] / sizes[first]) / (1e-3 * (last - first)))
    assert found[1] == pytest.approx(growth, rel=0.01)
    assert found[0] == pytest.approx(found[1], rel=0.03)
