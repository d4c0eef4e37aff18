"""What is of a wrong type is refused by name, in the library as in files."""

import numpy as np
import pytest

from fmu_bearing import Bearing, SceneError, simulate
from fmu_bearing.scene.read import with_fidelity


@pytest.fixture(scope="module")
def bearing(silent):
    return Bearing(with_fidelity(silent, model="rings"))


@pytest.mark.parametrize("source", [[1], None, 3.5, b"scene.toml"])
@pytest.mark.parametrize("use", [Bearing, lambda source: simulate(source, 1e-3)])
def test_a_source_that_is_no_scene(source, use):
    kind = "None" if source is None else type(source).__name__
    with pytest.raises(SceneError, match=rf"a scene is a file.*not .*{kind}"):
        use(source)


@pytest.mark.parametrize("value", ["2000", b"2000", None, True, [2000.0], np.zeros(2), 10**400])
def test_a_value_that_is_no_number(bearing, value):
    with pytest.raises(ValueError, match="shaft_speed = .*is refused: give a number") as caught:
        bearing.init(shaft_speed=value)
    assert len(str(caught.value)) < 120


@pytest.mark.parametrize("value", [2000, 2000.0, np.float64(2000.0), np.array(2000.0), np.int64(2000)])
def test_a_value_that_is_a_number(bearing, value):
    bearing.init(shaft_speed=value)
    assert bearing["shaft_speed"] == 2000.0


@pytest.mark.parametrize("values", [[1.0], 2000.0, "shaft_speed", {3: 1.0}])
def test_inputs_without_names(bearing, values):
    with pytest.raises(ValueError, match="are given by name"):
        bearing.init(values)
    with pytest.raises(ValueError, match="are given by name"):
        simulate(bearing.scene, 1e-3, start_values=values)


@pytest.mark.parametrize("step", ["1e-3", None, [1e-3], True])
def test_a_step_that_is_no_number(bearing, step):
    bearing.init()
    with pytest.raises(ValueError, match="step h = .*give a number"):
        bearing.step(step)
    assert bearing.time == 0.0
    with pytest.raises(ValueError, match="stop_time = .*give a number"):
        simulate(bearing.scene, step)


@pytest.mark.parametrize("names", ["heat.oil", 3, [3]])
def test_variables_that_are_no_list_of_names(bearing, names):
    with pytest.raises(ValueError, match="variables are given as a list of names"):
        simulate(bearing.scene, 1e-3, outputs=names)
