"""Every extreme case finishes, with bounded work and plausible outputs, in every level and method."""

import numpy as np
import pytest

from fmu_bearing.engine import abi
from fmu_bearing.engine import layout as at
from fmu_bearing.instance import EngineError
from fmu_bearing.scene import SceneError, read_scene_text
from tests.conftest import SCENES
from tests.extremes.bearings import RPM, Trace, bearing, drive, feed
from tests.extremes.cases import CASES, COMPUTED, WORK
from tests.extremes.checks import balanced, finite, plausible


@pytest.mark.parametrize("case", CASES, ids=lambda case: case.name)
@pytest.mark.parametrize(("level", "method"), COMPUTED)
def test_finishes(case, level, method):
    run = bearing(case.scene, case.all_changes, case.start, level, method)
    run.initialise()
    trace = Trace([run.time], [run.z.copy()])
    for duration, inputs, h in case.legs:
        feed(run, inputs)
        drive(run, duration, h, trace)
    finite(run)
    plausible(run, trace)
    assert run.time == pytest.approx(sum(duration for duration, _, _ in case.legs), rel=1e-12)
    assert max(trace.attempts) <= case.per_ms * WORK[level, method]
    if level == "full":
        balanced(run, case.energy)


@pytest.mark.parametrize(("level", "method"), COMPUTED)
def test_a_jump_that_stores_megajoules_is_refused_within_bounds(level, method):
    """On 1e4 N/m the preload pushes the outer ring 50 mm; 1e12 N/m there would be a force of 5e10 N."""
    run = bearing("7003C-bare", {"sound": None}, {"rpm": 2e4, "pedestal_stiffness": 1e4}, level, method)
    run.initialise()
    drive(run, 1e-3, 1e-4)
    kept, shown = run.s.copy(), run.z.copy()
    run.set("pedestal_stiffness", 1e12)
    with pytest.raises(EngineError, match=r"reached .* could not be solved.*pedestal_stiffness = 1e\+12"):
        run.step(1e-4)
    np.testing.assert_array_equal(run.s, kept)
    np.testing.assert_array_equal(run.z, shown)
    run.set("pedestal_stiffness", 1e4)
    drive(run, 1e-3, 1e-4)
    finite(run)


@pytest.mark.parametrize(
    ("key", "value", "reason"),
    [
        ("pedestal_stiffness_N_m", "0.0", r"pedestal_stiffness_N_m.* 0"),
        ("pedestal_stiffness_N_m", "2e12", r"pedestal_stiffness_N_m"),
        ("preload_N", "-1.0", r"preload_N"),
        ("preload_N", "10001.0", r"preload_N"),
        ("contact_damping_us", "25.1", r"contact_damping_us"),
        ("speed_rpm", "100001.0", r"speed_rpm"),
        ("oil_temperature_degC", "-41.0", r"oil_temperature_degC"),
        ("oil_temperature_degC", "201.0", r"oil_temperature_degC"),
        ("radial_load_y_N", "3001.0", r"radial_load_y_N"),
    ],
)
def test_scenes_beyond_the_extremes_are_refused_with_their_key(key, value, reason):
    lines = (SCENES / "7003C-bare.toml").read_text(encoding="utf-8").splitlines()
    changed = [f"{key} = {value}" if line.split(" = ")[0] == key else line for line in lines]
    assert changed != lines
    with pytest.raises(SceneError, match=reason):
        read_scene_text("\n".join(changed))


@pytest.mark.parametrize(
    ("name", "value"),
    [
        ("pedestal_stiffness", 0.0),
        ("pedestal_stiffness", -1e8),
        ("shaft_speed", 1.001e5 * RPM),
        ("preload", -1.0),
        ("oil_temperature", 200.0),
        ("radial_load.y", float("nan")),
    ],
)
def test_inputs_beyond_the_extremes_are_refused_with_the_range(name, value):
    run = bearing("7003C-bare", {"sound": None}, {})
    run.initialise()
    before = run.get(name)
    with pytest.raises(ValueError, match=rf"{name} = .* is refused: allowed are"):
        run.set(name, value)
    assert run.get(name) == before


@pytest.mark.parametrize(
    ("place", "value"),
    [
        (at.U_PEDESTAL, 0.0),
        (at.U_PEDESTAL, -1.0),
        (at.U_SPEED, 1.2e4),
        (at.U_OIL_T, 100.0),
        *((place, bad) for place in range(len(at.INPUTS)) for bad in (np.nan, np.inf)),
    ],
)
def test_the_engine_refuses_such_inputs_by_itself(place, value):
    """Who calls the engine without the library's checks gets a status, and an untouched state."""
    run = bearing("7003C-bare", {"sound": None}, {})
    run.initialise()
    kept, shown = run.s.copy(), run.z.copy()
    run.u[place] = value
    assert abi.step(run._p, run.u, run.s, run.z, run._w, 1e-4) == at.BAD_INPUT
    assert abi.init(run._p, run.u, run.s, run.z, run._w, 0.0) == at.BAD_INPUT
    np.testing.assert_array_equal(run.s, kept)
    np.testing.assert_array_equal(run.z, shown)
