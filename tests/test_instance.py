"""The library face: one running bearing by name."""

import math
import re
import warnings

import numpy as np
import pytest

from fmu_bearing.engine.abi import _LONGEST
from fmu_bearing.engine.layout import S
from fmu_bearing.engine.status import NOT_CONVERGED
from fmu_bearing.instance import EngineError, Instance
from fmu_bearing.prepare.model import prepare


@pytest.fixture(scope="module")
def model(scene):
    return prepare(scene("7003C-spindle"))


def stepped(bearing, count, h=1e-3):
    for _ in range(count):
        bearing.step(h)
    return bearing


def test_reset_is_a_fresh_instance(model):
    used, fresh = Instance(model), Instance(model)
    used.set("preload", 300.0)
    used.initialise()
    stepped(used, 3)
    used.reset()
    for bearing in (used, fresh):
        bearing.initialise()
        stepped(bearing, 3)
    np.testing.assert_array_equal(used.z, fresh.z)
    np.testing.assert_array_equal(used.s, fresh.s)


def test_interleaved_instances_equal_lone_ones(model):
    slow, fast, lone = Instance(model), Instance(model), Instance(model)
    slow.set("shaft_speed", 1000.0)
    for bearing in (slow, fast, lone):
        bearing.initialise()
    for _ in range(3):
        slow.step(1e-3)
        fast.step(1e-3)
    stepped(lone, 3)
    np.testing.assert_array_equal(fast.s, lone.s)


def test_a_reader_gives_what_get_gives(model):
    """Every variable, in reverse order, at each call; a row that was read stays as it is."""
    bearing = Instance(model)
    names = [name for name, v in reversed(bearing.by_name.items()) if v.array or v.value is not None]
    read = bearing.reader(names)
    bearing.initialise()
    first = read()
    kept = first.copy()
    for _ in range(2):
        bearing.step(1e-4)
        np.testing.assert_array_equal(read(), [bearing.get(name) for name in names])
    np.testing.assert_array_equal(first, kept)
    assert bearing.reader([])().size == 0
    with pytest.raises(KeyError, match="no variable 'speed'"):
        bearing.reader(["speed"])


def test_bad_values_are_refused_and_not_taken(model):
    bearing = Instance(model)
    bearing.initialise()
    for value in (math.nan, math.inf, -1.0, 1.0001e4):
        with pytest.raises(ValueError, match=r"preload = .* is refused: allowed are 0 to 10000 N"):
            bearing.set("preload", value)
    assert bearing.get("preload") == 500.0
    with pytest.raises(ValueError, match="friction_torque cannot be set: its causality is output"):
        bearing.set("friction_torque", 1.0)
    with pytest.raises(ValueError, match="fixed once the bearing is initialised"):
        bearing.set("tolerance", 1e-4)
    with pytest.raises(KeyError, match="no variable 'speed'"):
        bearing.get("speed")


@pytest.mark.parametrize("h", [0.0, -1e-3, math.nan, math.inf, _LONGEST, 2e9])
def test_bad_steps_leave_the_state_alone(model, h):
    bearing = Instance(model)
    with pytest.raises(EngineError, match="must be initialised"):
        bearing.step(1e-3)
    bearing.initialise()
    before = bearing.s.copy()
    with pytest.raises(EngineError, match="communication step must be above 0 s and below 1e6 s") as refusal:
        bearing.step(h)
    assert float(re.search(r"below (\S+) s", str(refusal.value))[1]) == _LONGEST
    np.testing.assert_array_equal(bearing.s, before)
    bearing.step(1e-3)


def test_levels_and_torque_do_not_depend_on_the_communication_step(model):
    """0.1 ms against 1 ms: 0.5 % in heat, 0.3 dB in level, as the interface promises."""
    found = []
    for h in (1e-4, 1e-3):
        bearing = Instance(model)
        bearing.initialise()
        stepped(bearing, round(0.02 / h), h)
        heats = []
        for _ in range(round(0.1 / h)):
            bearing.step(h)
            heats.append(sum(bearing.get(f"heat.{part}") for part in ("inner_ring", "outer_ring", "oil")))
        found.append((np.mean(heats), [bearing.get(f"mic[{k}].leq") for k in range(1, 5)]))
    assert found[0][0] == pytest.approx(found[1][0], rel=5e-3)
    np.testing.assert_allclose(found[0][1], found[1][1], atol=0.3)


def test_speed_ramps_from_the_value_last_reached(model):
    bearing = Instance(model)
    bearing.set("shaft_speed", 1000.0)
    bearing.initialise()
    bearing.set("shaft_speed", 1100.0)
    bearing.step(1e-4)
    # linear from 1000 to 1100 rad/s: the shaft has turned by the mean speed
    assert bearing.s[S.SPEED] == 1100.0
    assert bearing.s[S.ANGLE] == pytest.approx(1050.0 * 1e-4, rel=1e-12)
    stepped(bearing, 4, 1e-4)
    assert bearing.s[S.ANGLE] == pytest.approx(1050.0 * 1e-4 + 1100.0 * 4e-4, rel=1e-12)


def test_inertia_of_the_rotor_is_reported_to_the_drive(model, scene):
    reported = Instance(model).get("rotor.inertia")
    bore, outside, width, density = 17e-3, 22.6e-3, 10e-3, 7800.0
    ring = density * math.pi / 4 * (outside**2 - bore**2) * width * (bore**2 + outside**2) / 8
    assert reported == pytest.approx(0.25 * 15e-3**2 / 8 + ring, rel=1e-9)


def test_an_ellipse_beyond_the_shoulder_is_reported(scene):
    bearing = Instance(prepare(scene("7003C-bare")))
    bearing.set("imperfection.scale", 0.0)  # waves under the balls press more or less at this instant
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        bearing.initialise()
    margins = [math.degrees(bearing.get(f"contact.{ring}.shoulder_margin")) for ring in ("inner", "outer")]
    assert min(margins) == pytest.approx(3.0, abs=0.1)  # at 500 N; 1.9 by the largest of the balls
    bearing.reset()
    bearing.set("preload", 1e4)
    with pytest.warns(UserWarning, match="beyond its shoulder"):
        bearing.initialise()
    assert bearing.get("contact.inner.shoulder_margin") < 0.0


def test_a_run_up_beyond_the_scenes_speed_is_reported(example):
    """Waves up to 10 kHz at 5,000 r/min lie at 30 kHz at 15,000 and shorten every step there."""
    scene = example("7003C-bare")
    slow = scene.model_copy(update={"operation": scene.operation.model_copy(update={"speed_rpm": 5000.0})})
    reported = []
    bearing = Instance(prepare(slow, fidelity="rings"), reported.append)
    bearing.initialise()
    # 10 kHz: a radian takes 1 / (2 pi 10 kHz) = 15.9 us; whole orders reach somewhat less far
    assert bearing.get("solver.wave_time") == pytest.approx(15.9e-6, rel=0.02) and not reported
    before = bearing.get("solver.steps")
    bearing.step(1e-3)
    bearing.set("shaft_speed", 15000.0 * math.pi / 30.0)
    for _ in range(2):
        bearing.step(1e-3)
    assert len(reported) == 1 and "by one radian in 5.3 us" in reported[0]
    assert bearing.get("solver.steps") - before > 2 * 1e-3 / 5.3e-6  # the second step is at full speed
    with pytest.warns(UserWarning, match="by one radian"):
        fast = prepare(slow.model_copy(update={"operation": slow.operation.model_copy(
            update={"speed_rpm": 15000.0, "lowest_speed_rpm": 5000.0})}), fidelity="rings")  # fmt: skip
        Instance(fast).initialise()


def test_a_perfect_bearing_has_no_waves_to_follow(example):
    reported = []
    bearing = Instance(prepare(example("7003C-bare"), fidelity="rings"), reported.append)
    bearing.set("imperfection.scale", 0.0)
    bearing.set("shaft_speed", 90000.0 * math.pi / 30.0)
    bearing.initialise()
    assert bearing.get("solver.wave_time") == 1.0 and not any("wave" in text for text in reported)


def test_a_pedestal_too_soft_for_the_load_is_refused(scene):
    bearing = Instance(prepare(scene("7003C-bare")))
    bearing.set("pedestal_stiffness", 1e4)
    bearing.set("radial_load.y", 99.0)
    with pytest.raises(EngineError, match="stiffer pedestal"):
        bearing.initialise()


def refused_once(calls, steps):
    """A step that goes as far as one does, and fails; those after it succeed."""

    def step(h):
        steps(h)
        calls.step = steps
        return NOT_CONVERGED

    return step


@pytest.mark.parametrize("model", ["response", "rings", "full"])
def test_a_refused_step_is_undone_to_the_last_bit(example, model):
    """Steps since the last copy of the state are repeated; state and outputs are those before the refusal."""
    scene = example("7003C-spindle").model_copy(update={"sound": None})
    one, other = (Instance(prepare(scene, fidelity=model), tell=lambda _: None) for _ in range(2))
    steps = one._calls.step
    for run in (one, other):
        run.initialise()
    for i in range(40):
        for run in (one, other):
            run.set("shaft_speed", 1000.0 + 20.0 * i)
            run.set("preload", 150.0 + i)
        if i in (0, 1, 20, 33):
            one._calls.step = refused_once(one._calls, steps)
            with pytest.raises(EngineError, match="could not be solved"):
                one.step(1e-3)
            assert one._calls.step is steps
            assert one.get("preload") == 150.0 + i
        for run in (one, other):
            run.step(1e-3)
        if i in (0, 20, 21, 39):
            np.testing.assert_array_equal(one.s, other.s)
            if i != 0:
                np.testing.assert_array_equal(one.z, other.z)
