"""What the default tolerance and longest step leave as error of the rings' velocities."""

import pytest

from fmu_bearing.accuracy.reference import implicit_rings, relative_error
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import S, U
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.fidelity import Fidelity
from tests.conftest import GATES

DEFAULT = {"TOLERANCE": Fidelity().tolerance, "MAX_STEP": 1e-6 * Fidelity().max_internal_step_us}
SAMPLE = 1e-4


@pytest.fixture(scope="module")
def bare():
    return read_scene(GATES / "7003C-bare.toml").model_copy(update={"sound": None})


def error(bearing, window):
    """Error over ``window`` (s) from the present state, to steps of 1 us at a tolerance of 1e-6."""
    exact, _ = implicit_rings(bearing, window, SAMPLE, 1e-6, 1e-6)
    return relative_error(bearing.with_parameters().rings(window, SAMPLE), exact)


@pytest.mark.heavy
@pytest.mark.parametrize(("rpm", "load"), [(1e3, 0.0), (28e3, 0.0), (1e4, -300.0), (1e4, -1000.0)])
def test_the_default_keeps_its_tolerance_once_settled(bare, rpm, load):
    """Measured 5e-5, 9e-4, 1.5e-3, 1.8e-3 at the default of 2e-3; at 1e-3 4e-5, 4e-4, 8e-4, 9e-4."""
    bearing = Arrays.of(bare, **DEFAULT).at({U.SPEED: rpm * RPM, U.LOAD_Z: load})
    bearing.init()
    bearing.run(0.03, 1e-3)
    assert error(bearing, 0.02) < 3e-3


@pytest.mark.heavy
@pytest.mark.parametrize("load", [500.0, 1000.0])
def test_rings_under_loads_across_keep_the_tolerance(load):
    """Where balls rattle between the races, Newton's method may not leave more than the tolerance of 1e-3.

    Measured 7.5e-4 and 3.8e-4 with 7.6 iterations per step; 2.2e-3 and 1.1e-3 with 8.7 and 9.2 when it began
    at the accelerations of the stage before and could leave half of the tolerance.
    """
    spindle = read_scene(GATES / "7003C-spindle.toml").model_copy(update={"sound": None})
    bearing = Arrays.of(spindle, TOLERANCE=1e-3, MAX_STEP=25e-6)
    bearing.at({U.SPEED: 2e4 * RPM, U.LOAD_Y: load})
    bearing.init()
    bearing.run(0.05, 1e-3)
    steps, newton = bearing.s[S.STEPS], bearing.s[S.NEWTON]
    found = error(bearing, 0.02)
    bearing.run(0.02, SAMPLE)
    assert found < 1.5e-3
    assert (bearing.s[S.NEWTON] - newton) / (bearing.s[S.STEPS] - steps) < 8.2


def test_a_cage_that_is_flung_about_is_followed(bare):
    """Measured 7e-4. With a tenth of the cage's velocity in Newton's norm it was 0.18, see ``full/norms``."""
    table = [(2, 0.1, 40.0), (12, 0.05, 100.0), (13, 0.05, -75.0)]
    rows = [{"order": n, "amplitude_um": a, "phase_deg": p} for n, a, p in table]
    flaws = {"seed": 1, "unbalance_um": 2.0, "ball_diameter_spread_nm": 50.0}
    imperfections = {**flaws, "inner_race_harmonic": rows, "outer_race_harmonic": rows[1:]}
    scene = bare.model_validate(bare.model_dump(exclude_none=True) | {"imperfections": imperfections})
    inputs = {U.SPEED: 2e4 * RPM, U.LOAD_Y: 30.0, U.LOAD_Z: 10.0}
    bearing = Arrays.of(scene, **DEFAULT).at(inputs)
    bearing.init()
    assert error(bearing, 5e-3) < 5e-3
