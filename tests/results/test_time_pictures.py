"""Pictures over time: what was asked, in units people read, without motions that are not there."""

import warnings

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


def test_many_curves_leave_the_axes_room_and_look_different():
    """Sixty long names: some are named, and the axes keep half the width; nine motions: nine looks."""
    many = {f"mic[{k}].spl_a_of_a_long_name": 50.0 + 0.1 * k for k in range(1, 61)}
    figure = time_picture(made(**many), ["*"])
    with warnings.catch_warnings():
        warnings.simplefilter("error")
        figure.draw_without_rendering()
    (ax,) = figure.axes
    legend, page = ax.get_legend(), figure.bbox
    box = legend.get_window_extent()
    assert box.x1 <= page.x1 and box.y0 >= page.y0 and box.y1 <= page.y1
    assert ax.get_window_extent().width > 0.5 * page.width
    assert legend.get_title().get_text() == "60 curves, 1 of 5 named" and len(legend.get_texts()) == 12
    assert len({line.get_color() for line in ax.lines}) == 60
    nine = {f"{body}.velocity.{axis}": 1.0 for body in ("inner_ring", "outer_ring", "cage") for axis in "xyz"}
    (ax,) = time_picture(made(**nine)).axes
    assert len({(line.get_color(), line.get_marker()) for line in ax.lines}) == 9


def test_ticks_have_no_offset():
    figure = time_picture(made(**{"cage.speed_ratio": 0.4184 + 1e-5 * np.sin(np.arange(100))}))
    figure.set_size_inches(10.0, 1.8)  # so low that Matplotlib would take one
    figure.draw_without_rendering()
    (ax,) = figure.axes
    assert ax.yaxis.get_offset_text().get_text() == ""


@pytest.mark.parametrize(("count", "until"), [(400, 0.145), (100, 0.099)])
def test_the_time_that_meters_average_over_is_grey_and_sets_no_scale(count, until):
    level = np.full(count, 50.0) + 0.1 * np.sin(np.arange(count))
    level[:20], level[20:23] = -106.0, [30.0, 47.0, 49.0]
    (ax,) = time_picture(made(count=count, **{"mic[1].spl_a": level})).axes
    (grey,) = [one for one in ax.patches if one.get_gid() == "averaging"]
    left, right = grey.get_window_extent().transformed(ax.transData.inverted()).intervalx
    assert (left, right) == pytest.approx((0.02, until), abs=1e-9)
    low, high = ax.get_ylim()
    assert 49.0 < low < 49.9 and 50.1 < high < 51.0


def test_a_run_of_times_alone_is_refused_by_name():
    with pytest.raises(ValueError, match="any has times alone: there is nothing to draw"):
        time_picture(made(), None)
