"""Tools that run inside a Python process: both builds give what the library gives, to the last bit."""

from contextlib import ExitStack

import fmpy
import numpy as np
import pytest

from .conftest import EXACT_STEP, STEPS, WATCHED, alone, needs_linux64
from .masters import in_ecospy, in_fmpy, in_libcosim


def test_fmpy(fmu, expected):
    assert np.array_equal(in_fmpy(fmu, WATCHED), expected)


def test_fmpy_with_start_values_and_inputs(fmu, model):
    times = np.array([0.0, 3 * EXACT_STEP, 3 * EXACT_STEP, 8 * EXACT_STEP])
    loads = np.array([500.0, 500.0, 400.0, 400.0])
    signal = np.array(
        list(zip(times, loads, strict=True)), dtype=[("time", np.float64), ("preload", np.float64)]
    )
    found = fmpy.simulate_fmu(
        str(fmu),
        stop_time=8 * EXACT_STEP,
        output_interval=EXACT_STEP,
        start_values={"shaft_speed": 1500.0, "lubricant.viscosity_ref": 0.02},
        input=signal,
        output=["preload", "friction_torque", "contact.inner.load_mean"],
    )
    before, after = found["contact.inner.load_mean"][[2, -1]]
    assert found["preload"][[0, -1]].tolist() == [500.0, 400.0]
    assert after < 0.95 * before
    base = alone(model, 0, shaft_speed=1500.0)[0, WATCHED.index("friction_torque")]
    thinner = alone(model, 0, **{"shaft_speed": 1500.0, "lubricant.viscosity_ref": 0.02})[0]
    assert found["friction_torque"][0] == thinner[WATCHED.index("friction_torque")] < base


@needs_linux64
def test_ecospy(fmu, expected):
    assert np.array_equal(in_ecospy(fmu, WATCHED), expected)


@needs_linux64
def test_one_instance_of_ecospy_after_the_other(fmu, expected):
    """The same FMU twice in one process, by name in one structure and in simulations one after the other."""
    from run import load_ecos

    ecospy = load_ecos()
    for _ in range(2):
        with ecospy.EcosSimulationStructure() as structure:
            for each in ("one", "other"):
                structure.add_model(each, str(fmu))
            with ecospy.EcosSimulation(structure=structure, step_size=EXACT_STEP) as run:
                assert run.init()
                run.step(STEPS)
                for each in ("one", "other"):
                    assert [run.get_real(f"{each}::{name}") for name in WATCHED] == expected[-1].tolist()
                run.terminate()


@needs_linux64
def test_libcosimpy(fmu, expected):
    assert np.array_equal(in_libcosim(fmu, WATCHED), expected[1:])


@pytest.fixture(scope="module")
def companions(tmp_path_factory):
    """Two FMUs of pythonfmu with different code: motor and thermal network of the spindle example."""
    from build import HERE, MODELS, build

    folder = tmp_path_factory.mktemp("companions")
    return {name: build(HERE / f"{name}.py", folder) for name in MODELS}


def test_four_fmus_in_one_process_do_not_disturb_each_other(fmus, companions):
    """Two other pythonfmu FMUs and both builds of ours, stepped in turn: as each of them alone."""
    from coupling import Fmu

    inputs = {
        "motor": {"load_torque": 0.02},
        "thermal": {"heat.oil": 20.0, "heat.inner_ring": 5.0},
        "native": {"shaft_speed": 2200.0},
        "python": {"shaft_speed": 1900.0},
    }
    shown = {
        "motor": ["shaft_speed", "motor_torque"],
        "thermal": ["oil_temperature", "energy.stored"],
        "native": list(WATCHED),
        "python": list(WATCHED),
    }
    paths = fmus | companions

    def run(names):
        rows = {name: [] for name in names}
        with ExitStack() as stack:
            opened = {name: stack.enter_context(Fmu(paths[name], name)) for name in names}
            for name, fmu in opened.items():
                fmu.enter_initialization(**inputs[name])
                fmu.exit_initialization()
            for k in range(5):
                for name, fmu in opened.items():
                    fmu.step(k * EXACT_STEP, EXACT_STEP)
                    rows[name].append(fmu.get(shown[name]))
        return rows

    together = run(list(paths))
    for name in paths:
        assert together[name] == run([name])[name], name
    assert together["native"] != together["python"]
    assert together["motor"][-1][0] != together["motor"][0][0]
    assert together["thermal"][-1][0] > together["thermal"][0][0]
