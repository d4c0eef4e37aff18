"""A recording as picture, spectrum and tables of other tools: microphones and units are kept."""

import numpy as np
import pytest

from fmu_bearing import Recording, record, with_fidelity
from fmu_bearing.recording.measurements.sound_analysis import analyse_sound
from fmu_bearing.scene import read_scene_text

ELSEWHERE = (0.0, 0.3, 0.0)


@pytest.fixture(scope="module")
def recorded(scene):
    return record(with_fidelity(scene("7003C-bare"), model="rings"), 0.05)


@pytest.fixture(scope="module")
def mute(scene):
    """A recording of a scene without microphones."""
    return record(with_fidelity(scene("7003C-bare").replace({"sound": None}), model="rings"), 0.02)


def test_spectrum_is_that_of_listen(recorded):
    found, known = recorded.spectrum(["P2", ELSEWHERE]), analyse_sound(recorded, ["P2", ELSEWHERE])
    assert found.names == known.names and found.units == ("dB", "dB") and found.kind == "microphone"
    assert np.array_equal(found.frequency, known.frequency)
    # partial pressures added up, against their sum at once: rounding
    assert found.values == pytest.approx(known.spectra["total"], abs=1e-6)
    assert recorded.spectrum(resolution=40.0).frequency[1] == 40.0
    with pytest.raises(KeyError, match="no microphone 'P1' here; there are P2"):
        found["P1"]


def test_spectrum_in_tables(recorded):
    found = recorded.spectrum(["P1", "P3"])
    data = found.to_xarray()
    assert data["level"].dims == ("microphone", "frequency") and data["level"].attrs["units"] == "dB"
    assert data["level"].sel(microphone="P3").values.tolist() == found["P3"].tolist()
    frame = found.to_pandas()
    assert frame.columns.name == "microphone" and frame["P1"].to_numpy().tolist() == found["P1"].tolist()
    assert frame.attrs["units"] == {"P1": "dB", "P3": "dB"}
    assert [ax.get_ylabel() for ax in found.plot().axes] == ["level, dB re 20 uPa"]


def test_recording_in_tables(recorded):
    data = recorded.to_xarray(["P1", ELSEWHERE])
    assert data["microphone"].values.tolist() == ["P1", "(0, 300, 0) mm"]
    assert data["pressure"].attrs["units"] == "Pa" and data["y"].values.tolist() == [
        recorded.positions[0][1],
        0.3,
    ]
    assert np.array_equal(data["pressure"].sel(microphone="P1"), recorded.pressure("P1")[0])
    assert data["time"].values.tolist() == recorded.time.tolist() and data["x"].attrs["units"] == "m"
    units = {name: data[name].attrs["units"] for name in recorded.outputs}
    assert units["friction_torque"] == "N.m" and units["contact.inner.angle_mean"] == "rad"
    assert data["shaft_speed"].attrs["units"] == "rad/s"
    assert read_scene_text(data.attrs["scene"]) == recorded.scene and data.attrs["rate_Hz"] == recorded.rate
    frame = recorded.to_pandas("P1")
    assert frame.shape == (recorded.size, 1) and frame.attrs["units"] == {"P1": "Pa"}
    assert frame.index[0] == recorded.start


def test_recordings_without_microphones(mute):
    data = mute.to_xarray()
    assert "pressure" not in data and data["friction_torque"].dims == ("output_time",)
    assert mute.to_xarray([ELSEWHERE])["pressure"].shape == (1, mute.size)
    with pytest.raises(ValueError, match="the scene has no microphones"):
        mute.to_pandas()
    assert "friction_torque" in mute._repr_html_()


@pytest.mark.heavy
def test_picture(recorded):
    (ax,) = recorded.plot(["P1", "P4"], highest=5000.0, title="two").axes
    assert [line.get_label() for line in ax.lines[:2]] == ["P1", "P4"]
    assert ax.get_xlim()[1] <= 5000.0 and ax.get_title() == "two"
    assert len(ax.lines) > 2  # kinematic frequencies
    assert np.array_equal(
        ax.lines[0].get_ydata(), recorded.spectrum("P1")["P1"][: len(ax.lines[0].get_ydata())]
    )


def test_notebooks_see_microphones_and_means(recorded, monkeypatch):
    monkeypatch.setattr(Recording, "pressure", None)  # a notebook shows it at once: no sound is computed
    page = recorded._repr_html_()
    assert "<td>P1</td><td>0, 105, 0</td><td>mm</td>" in page
    within = recorded.output_time >= recorded.start
    mean = recorded.outputs["contact.inner.load_mean"][within].mean()
    assert f"<td>contact.inner.load_mean</td><td>{mean:.3g}</td><td>N</td>" in page
