"""A run as picture, spectrum and tables of other tools: names and units are kept."""

import numpy as np
import pytest

from fmu_bearing.interface.names import UnknownName
from fmu_bearing.results.result import Run
from fmu_bearing.results.series import structured

RATE, LINE = 1000.0, 125.0  # Hz


@pytest.fixture
def run():
    """A torque with a line of 3 N.m amplitude on a mean of 1 N.m, and a constant number with its own unit."""
    time = np.arange(801) / RATE
    torque = 1.0 + 3.0 * np.sin(2.0 * np.pi * LINE * time)
    table = structured({"time": time, "friction_torque": torque, "my.number": np.ones(len(time))})
    return Run("a <b>", table, {"my.number": "kg"})


def test_a_line_is_read_at_its_frequency(run):
    found = run.spectrum(["friction_torque", "my.*"])
    assert found.names == ("friction_torque", "my.number") and found.units == ("N.m", "kg")
    assert found.frequency[-1] == pytest.approx(RATE / 2.0, abs=1.0)
    torque = found["friction_torque"]
    assert found.frequency[torque.argmax()] == pytest.approx(LINE, abs=found.frequency[1])
    # the flat-top window reads a line within 0.1 dB
    assert torque.max() == pytest.approx(3.0 / np.sqrt(2.0), rel=10.0 ** (0.1 / 20.0) - 1.0)
    assert run.spectrum("friction_torque", resolution=10.0).frequency[1] == 10.0
    assert len(run.spectrum("friction_torque", settle=0.4).frequency) == 201
    with pytest.raises(KeyError, match="no variable 'heat' here; there are friction_torque"):
        found["heat"]


def test_a_spectrum_needs_even_steps(run):
    table = run.table.copy()
    table["time"][400:] += 0.5 / RATE
    with pytest.raises(ValueError, match="needs even steps"):
        Run("uneven", table).spectrum("friction_torque")
    with pytest.raises(ValueError, match="5 points are too few"):
        Run("short", run.table[:5]).spectrum("friction_torque")
    with pytest.raises(UnknownName, match="did you mean 'friction_torque'"):
        run.spectrum("friction_torqe")


def test_tables_keep_names_and_units(run):
    frame = run.to_pandas()
    assert frame.columns.tolist() == run.names and frame.index.name == "time, s"
    assert frame["friction_torque"].to_numpy().tolist() == run["friction_torque"].tolist()
    assert frame.attrs["units"] == {"friction_torque": "N.m", "my.number": "kg"}
    assert frame.attrs["name"] == "a <b>" and frame.attrs["ended"] == "complete"
    data = run.to_xarray()
    assert data["friction_torque"].attrs["units"] == "N.m" and data["time"].attrs["units"] == "s"
    found = run.spectrum(run.names)
    data = found.to_xarray()
    assert data["my.number"].dims == ("frequency",) and data["my.number"].attrs["units"] == "kg"
    assert data["frequency"].attrs["units"] == "Hz"
    frame = found.to_pandas()
    assert frame.attrs["units"]["my.number"] == "kg" and frame.index.name == "frequency, Hz"


def test_pictures_have_a_panel_per_unit(run):
    labels = [ax.get_ylabel() for ax in run.plot().axes]
    assert labels == ["N.m"]  # the usual variables alone
    figure = run.plot(["friction_torque", "my.*"], title="two")
    assert [ax.get_ylabel() for ax in figure.axes] == ["N.m", "kg"] and figure.get_suptitle() == "two"
    assert [ax.get_ylabel() for ax in run.plot("my.number").axes] == ["kg"]
    panels = run.spectrum(run.names).plot().axes
    assert [ax.get_ylabel() for ax in panels] == ["rms, N.m", "rms, kg"]
    assert [ax.get_yscale() for ax in panels] == ["log", "linear"]  # a constant has no line


def test_notebooks_see_a_table(run):
    page = run._repr_html_()
    assert "a &lt;b&gt; at 0.8 s" in page and "<td>N.m</td>" in page and "<td>kg</td>" in page
    early = Run("stopped", run.table[:3], ended="refused", note="no <way>")._repr_html_()
    assert "refused: no &lt;way&gt;" in early
    assert "<td>-</td>" in Run("nothing", run.table[:0])._repr_html_()
    page = run.spectrum("friction_torque")._repr_html_()
    assert "<td>friction_torque</td><td>2.1" in page and "<td>N.m</td><td>124.8" in page
