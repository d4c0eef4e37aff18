"""Dataset, files, pictures, and a sweep as a file."""

import csv
import math

import numpy as np
import pytest

from fmu_bearing.sweeps import save
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.description import Description, is_description, read_description
from fmu_bearing.sweeps.picture import sweep_picture
from fmu_bearing.sweeps.plan import plan
from fmu_bearing.sweeps.point import Outcome, nothing
from fmu_bearing.sweeps.result import dataset, extremes
from tests.conftest import GATES

xarray = pytest.importorskip("xarray", reason="xarray is not installed: extra 'results'")


@pytest.fixture(scope="module")
def given(scene):
    """Three axes, one of texts, with figures that tell their place and points without any."""
    silent = scene("7003C-bare").model_copy(update={"sound": None})
    axes = {"fidelity": ["rings", "response"], "speed": "1000:4000:4", "pedestal": "1e6:1e8:3log"}
    made = plan(silent, axes, figures=["friction_torque", "outer_ring.velocity"])
    outcomes = {task.key: Outcome((float(k), 0.5), "", 0.25) for k, task in enumerate(made.tasks)}
    outcomes[made.tasks[5].key] = nothing(made.tasks[5], "no equilibrium", 0.1, lasting=True)
    del outcomes[made.tasks[6].key]
    return made, dataset(made, outcomes)


def test_dataset_has_axes_units_reasons_and_what_made_it(given):
    made, data = given
    assert dict(data.sizes) == {"fidelity": 2, "speed_rpm": 4, "pedestal_stiffness_N_m": 3}
    assert (
        data["speed_rpm"].attrs["units"] == "r/min"
        and data["speed_rpm"].attrs["key"] == "operation.speed_rpm"
    )
    torque = data["friction_torque"]
    assert torque.attrs["units"] == "N.m" and torque.attrs["statistic"].startswith("mean")
    assert float(torque.sel(fidelity="response", speed_rpm=2000, pedestal_stiffness_N_m=1e7)) == 16.0
    flat = torque.values.ravel()
    assert math.isnan(flat[5]) and math.isnan(flat[6]) and np.isfinite(np.delete(flat, [5, 6])).all()
    assert data["reason"].values.ravel()[[4, 5, 6]].tolist() == ["", "no equilibrium", "not run"]
    assert (data["seed"] == 1).all()
    assert data.attrs["scene"] == made.scene.to_toml() and len(data.attrs["engine"]) == 16
    rows = {row["figure"]: row for row in extremes(data)}
    assert rows["friction_torque"]["largest"] == 23.0
    assert rows["friction_torque"]["largest_at"] == "response, 4000, 1e+08"


def test_netcdf_reads_back_and_the_table_has_a_row_per_point(given, tmp_path):
    _, data = given
    files = save(data, tmp_path / "new")
    with xarray.open_dataset(files["netcdf"], engine="h5netcdf") as read:
        for name in data.data_vars:
            np.testing.assert_array_equal(read[name].values, data[name].values, err_msg=name)
        assert read["fidelity"].values.tolist() == ["rings", "response"]
        assert read.attrs["scene"] == data.attrs["scene"]
        assert read["friction_torque"].attrs["units"] == "N.m"
    with files["csv"].open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    assert len(rows) == 24
    assert rows[16]["fidelity"] == "response" and float(rows[16]["friction_torque [N.m]"]) == 16.0
    assert rows[5]["friction_torque [N.m]"] == "" and rows[5]["reason"] == "no equilibrium"
    assert {path.name for path in (tmp_path / "new").iterdir()} == {"sweep.nc", "sweep.csv"}


def test_maps_curves_and_what_has_neither(given):
    _, data = given
    map_ = sweep_picture(data.isel(fidelity=0))
    assert [ax.get_title() for ax in map_.axes][:2] == ["outer_ring.velocity", "friction_torque"]
    assert map_.axes[0].get_yscale() == "log" and map_.axes[0].get_xscale() == "linear"
    assert map_.axes[0].get_xlabel() == "speed, r/min"
    edges = map_.axes[0].collections[0].get_coordinates()
    # the first and the last cell end at their points: beyond them nothing was computed
    np.testing.assert_allclose(edges[:, 0, 1], [1e6, 10**6.5, 10**7.5, 1e8], rtol=1e-9)
    np.testing.assert_allclose(edges[0, :, 0], [1000.0, 1500.0, 2500.0, 3500.0, 4000.0], rtol=1e-9)
    curves = sweep_picture(data.isel(pedestal_stiffness_N_m=1), ["friction_torque"])
    (ax,) = curves.axes
    assert [line.get_label() for line in ax.get_lines()] == ["rings", "response"]
    np.testing.assert_allclose(ax.get_lines()[1].get_ydata(), 1e3 * np.array([13.0, 16.0, 19.0, 22.0]))
    assert ax.get_ylabel() == "N.mm"
    with pytest.raises(SweepError, match=r"data.isel\(fidelity=0\)"):
        sweep_picture(data)
    with pytest.raises(SweepError, match="single point"):
        sweep_picture(data.isel(fidelity=0, speed_rpm=0, pedestal_stiffness_N_m=0))


def test_a_picture_has_every_figure_asked(given):
    """Twelve figures made nine panels, and the command line drew four of them."""
    _, data = given
    many = data.isel(fidelity=0).assign(
        {f"figure_{k}": data["friction_torque"].isel(fidelity=0) for k in range(12)}
    )
    names = [f"figure_{k}" for k in range(12)]
    drawn = [ax.get_title() for ax in sweep_picture(many, names).axes]
    assert [title for title in drawn if title] == names
    with pytest.raises(SweepError, match="choose at most 300"):
        sweep_picture(
            data.assign({f"f{k}": data["friction_torque"] for k in range(301)}).isel(fidelity=0), ["f*"]
        )


def test_a_sweep_as_a_file(tmp_path):
    path = tmp_path / "sweep.toml"
    axes = '[axes]\nspeed = "1000:2000:2"\n"mounting.preload_N" = [300, 500]\n'
    path.write_text('scene = "bare.toml"\nwindow_s = 0.05\n' + axes)
    found = read_description(path)
    assert found.scene == str(tmp_path / "bare.toml") and found.window_s == 0.05 and found.settle_s == 0.02
    assert found.axes == {"speed": "1000:2000:2", "mounting.preload_N": [300, 500]}
    path.write_text(found.to_toml())
    assert read_description(path) == found
    assert is_description(path) and not is_description(GATES / "7003C-bare.toml")
    assert isinstance(found, Description)


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("[axes]\nspeed = [1]\n", 'scene is missing, for example scene = "my-scene.toml"'),
        ('scene = "a"\n', "axes is missing"),
        (
            'scene = "a"\nwindows_s = 1.0\n[axes]\nspeed = [1]\n',
            "windows_s is not a key of a sweep; did you mean 'window_s'",
        ),
        (
            'scene = "a"\nwindow_s = 0.0\n[axes]\nspeed = [1]\n',
            "window_s = 0.0 is refused: Input should be greater",
        ),
        ('scene = "a"\n[axes]\nspeed = 3\n', "axes.speed is refused: an array of values"),
        ("scene = \n", "not valid TOML"),
    ],
)
def test_a_file_that_is_refused(tmp_path, text, reported):
    path = tmp_path / "sweep.toml"
    path.write_text(text)
    with pytest.raises(SweepError) as caught:
        read_description(path)
    assert reported in str(caught.value) and str(path) in str(caught.value) and "\n" not in str(caught.value)
