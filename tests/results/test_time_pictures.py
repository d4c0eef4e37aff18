"""Pictures over time: what was asked, in units people read, without motions that are not there."""

import numpy as np
import pytest

from fmu_bearing import simulate
from fmu_bearing.results.result import Run
from fmu_bearing.results.series import structured
from fmu_bearing.results.time_pictures import settled, time_picture
from fmu_bearing.scene.read import with_fidelity


def made(step=1e-3, count=100, **columns):
    time = step * np.arange(count)
    table = structured({"time": time} | {name: values * np.ones(count) for name, values in columns.items()})
    return Run("any", table)


def curves(figure):
    return {line.get_label(): line for ax in figure.axes for line in ax.lines}


@pytest.fixture(scope="module")
def run(scene):
    return simulate(with_fidelity(scene("7003C-bare"), model="rings"), 0.04)


def test_every_variable_asked_is_drawn_and_named(run):
    names = [name for name in run.names if name.startswith("ball[")][:30]
    figure = time_picture(run, names)
    assert list(curves(figure)) == names
    reported = [text.get_text() for ax in figure.axes for text in ax.get_legend().get_texts()]
    assert reported == names


def test_speeds_are_in_r_min_and_temperatures_in_degC():
    figure = time_picture(made(shaft_speed=100.0 * np.pi, oil_temperature=313.15))
    assert [ax.get_ylabel() for ax in figure.axes] == ["r/min"]  # the usual ones
    figure = time_picture(made(shaft_speed=100.0 * np.pi, oil_temperature=313.15), ["*"])
    found = curves(figure)
    assert [ax.get_ylabel() for ax in figure.axes] == ["r/min", "degC"]
    np.testing.assert_allclose(found["shaft_speed"].get_ydata(), 3000.0)
    np.testing.assert_allclose(found["oil_temperature"].get_ydata(), 40.0)


def test_microphones_have_their_names_where_the_scene_is_known(run, scene):
    assert list(curves(time_picture(run, ["mic[*].leq_a"]))) == [f"P{k}: leq_a" for k in (1, 2, 3, 4)]
    alone = Run("any", run.table)
    assert "mic[1].leq_a" in curves(time_picture(alone, ["mic[1].leq_a"]))


def test_levels_begin_where_they_sound():
    level = np.full(100, 50.0)
    level[:5] = [-106.0, -104.0, -73.9, 5.0, 48.0]
    level[60] = -20.0  # a pause later on is no start
    found = settled(level)
    assert np.isnan(found[:4]).all() and np.array_equal(found[4:], level[4:])
    assert np.isnan(settled(np.full(10, -106.0))).all()


@pytest.mark.parametrize(("step", "style"), [(1e-3, "None"), (2e-5, "-")])
def test_motions_faster_than_the_step_are_points_not_curves(step, style):
    names = {"inner_ring.velocity.y": 1.0, "mic[1].pressure": 1.0, "friction_torque": 1.0}
    figure = time_picture(made(step, **names), ["*"])
    found = curves(figure)
    assert found["inner_ring.velocity.y"].get_linestyle() == style
    assert found["mic[1].pressure"].get_linestyle() == style
    assert found["friction_torque"].get_linestyle() == "-"
    reported = [ax.get_title(loc="left") for ax in figure.axes]
    assert ("points every 1 ms" in reported[0]) == (style == "None") and reported[-1] == ""
