"""The motor FMU alone, against the solution of its equations on paper."""

import math

import fmpy
import numpy as np
import pytest

START, TARGET, RAMP = 200.0, 2000.0, 0.6
INERTIA, BANDWIDTH = 2.0e-5, 120.0
ACCELERATION = (TARGET - START) / RAMP
PARAMETERS = {
    "start_speed": START,
    "target_speed": TARGET,
    "ramp_time": RAMP,
    "rotor_inertia": INERTIA,
    "bandwidth": BANDWIDTH,
}


@pytest.fixture(params=["python", "native"])
def fmus(request, partners):
    """Both builds: what follows shares no code with either."""
    if request.param not in partners:
        pytest.skip("no C compiler")
    return partners[request.param]


def simulate(fmus, step=5e-4, end=1.0, load=None, **parameters):
    kinds = [("time", float), ("load_torque", float)]
    return fmpy.simulate_fmu(
        str(fmus / "SpindleMotor.fmu"),
        stop_time=end,
        step_size=step,
        output_interval=step,
        start_values={**PARAMETERS, **parameters},
        input=None if load is None else np.array([(0.0, load), (end, load)], dtype=kinds),
        output=["shaft_speed", "speed_setpoint", "motor_torque", "electrical_power"],
    )


def lag(time):
    """Setpoint less speed of a loop with both poles at -w, from the start of a ramp: a t e^-wt."""
    since = np.maximum(time, 0.0)
    return ACCELERATION * since * np.exp(-BANDWIDTH * since)


def test_run_up_lags_as_the_linear_loop_does(fmus):
    run = simulate(fmus)
    time = run["time"]
    setpoint = START + np.minimum(time / RAMP, 1.0) * (TARGET - START)
    expected = setpoint - lag(time) + lag(time - RAMP)
    # Sampling at 0.1 ms delays the torque by half a period, w Ts / 2 = 0.6 % of the loop's time constant,
    # and the integral by one: together up to 2 % of the largest lag, a / (w e).
    assert np.abs(run["shaft_speed"] - expected).max() < 0.02 * ACCELERATION / BANDWIDTH / math.e


def test_torque_is_inertia_times_acceleration_plus_load(fmus):
    run = simulate(fmus, load=0.01)
    ramp = run[(run["time"] > 0.2) & (run["time"] < RAMP)]
    hold = run[run["time"] > 0.8]
    # 0.2 s are 24 time constants of the loop: nothing of a transient is left.
    assert ramp["motor_torque"] == pytest.approx(INERTIA * ACCELERATION + 0.01, rel=1e-6)
    assert hold["motor_torque"] == pytest.approx(0.01, rel=1e-5)
    assert hold["shaft_speed"] == pytest.approx(TARGET, rel=1e-9)


def test_electrical_power_is_shaft_power_and_copper_loss(fmus):
    last = simulate(fmus, load=0.03, torque_constant=0.05, winding_resistance=0.5)[-1]
    assert last["electrical_power"] == pytest.approx(0.03 * TARGET + 0.5 * 0.6**2, rel=1e-6)


def test_torque_limit_holds_and_leaves_no_windup(fmus):
    limit = 0.5 * INERTIA * ACCELERATION
    run = simulate(fmus, end=2.0, torque_limit=limit)
    assert np.abs(run["motor_torque"]).max() <= limit
    # at half the torque the run-up takes twice the time, but for the samples until the limit is reached;
    # afterwards it overshoots by no more than one time constant of the loop explains
    limited = run[(run["time"] > 0.1) & (run["time"] < 1.0)]
    assert np.diff(limited["shaft_speed"]) == pytest.approx(0.5 * ACCELERATION * 5e-4, rel=1e-9)
    assert run["shaft_speed"].max() < TARGET + ACCELERATION / BANDWIDTH
    assert run["shaft_speed"][-1] == pytest.approx(TARGET, rel=1e-6)


@pytest.mark.parametrize("step", [1e-4, 3.7e-4, 1e-3])
def test_result_does_not_depend_on_the_communication_step(fmus, step):
    fine, coarse = simulate(fmus, 1e-4, 0.2, load=0.01), simulate(fmus, step, 0.2, load=0.01)
    common = np.interp(coarse["time"], fine["time"], fine["shaft_speed"])
    # The same pieces are solved whatever the step; between them the speed is a straight line.
    assert coarse["shaft_speed"] == pytest.approx(common, rel=1e-9)


def test_reverse_rotation_is_the_mirror(fmus):
    forward = simulate(fmus, end=0.3, load=0.02)
    backward = simulate(fmus, end=0.3, load=-0.02, start_speed=-START, target_speed=-TARGET)
    assert backward["shaft_speed"] == pytest.approx(-forward["shaft_speed"], rel=1e-12)
    assert backward["electrical_power"] == pytest.approx(forward["electrical_power"], rel=1e-12)


def test_description_is_valid_with_units(fmus):
    path = str(fmus / "SpindleMotor.fmu")
    assert fmpy.validation.validate_fmu(path) == []
    units = {v.name: v.unit for v in fmpy.read_model_description(path).modelVariables}
    assert units["shaft_speed"] == "rad/s" and units["load_torque"] == "N.m"
    assert all(units.values())
    assert math.isclose(
        float(fmpy.read_model_description(path).modelVariables[6].start), 2000.0 * math.pi / 3.0
    )
