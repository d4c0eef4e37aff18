"""Frequencies in the labels are those of the envelope: a computed run with a pit on either race."""

import csv

import numpy as np
import pytest

from fmu_bearing import measure, new_scene
from fmu_bearing.dataset import dataset

h5py = pytest.importorskip("h5py")
PLAN = """scene = "6205.toml"
runs = 2
rate_Hz = 25600
sizes = 1
sensors = ["outer_ring.acceleration.z"]
[draw]
"mounting.radial_load_z_N" = -300.0
"mounting.preload_N" = 30.0
"imperfections.seed" = "1:1000"
[[class]]
name = "outer"
share = 0.5
defect = { on = "outer", shape = "spall", length_mm = 0.6, width_mm = 3.0, depth_um = 100.0 }
[[class]]
name = "inner"
share = 0.5
defect = { on = "inner", shape = "spall", length_mm = 0.6, width_mm = 3.0, depth_um = 100.0 }
"""


@pytest.mark.heavy
def test_frequencies_of_the_labels_are_lines_of_the_envelope(tmp_path):
    (tmp_path / "6205.toml").write_text(new_scene("6205", "6205", speed_rpm=1797.0), "utf-8")
    (tmp_path / "plan.toml").write_text(PLAN, "utf-8")
    files = dataset(tmp_path / "plan.toml", tmp_path / "set", workers=1)
    with files["labels"].open(encoding="utf-8", newline="") as file:
        labels = list(csv.DictReader(file))
    with h5py.File(files["waveforms"]) as file:
        waveforms = file["waveforms"][:, 0].astype(np.float64)
    assert {row["class"] for row in labels} == {"outer", "inner"}
    for row, waveform in zip(labels, waveforms, strict=True):
        assert row["reason"] == ""
        column, other = ("f_o_Hz", "f_i_Hz") if row["class"] == "outer" else ("f_i_Hz", "f_o_Hz")
        found = measure.envelope(waveform, 25_600, (2000.0, 10_000.0))
        wanted = float(row[column])
        line, amplitude, over = found.at(wanted, 0.015 * wanted)  # as wide as a cage may slide
        assert abs(line - wanted) <= found.resolution and over > 10.0  # a bin; 20 dB
        beside = found.at(float(row[other]))[1]
        assert amplitude > 3.0 * beside
        # a second of passages, to one at either end
        assert abs(int(row["defect[1].passages"]) - wanted) <= 1.5
        assert float(row["imperfections.defect[1].length_mm"]) == 0.6
        assert row["imperfections.defect[1].on"] == row["class"]
