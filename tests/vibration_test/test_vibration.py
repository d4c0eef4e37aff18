"""The test over seeds, pieces and sources: its tables, lines, remarks, files."""

import csv

import numpy as np
import pytest

from fmu_bearing import vibration
from fmu_bearing.vibration_test.lines import frequencies
from fmu_bearing.vibration_test.reading import Reading
from fmu_bearing.vibration_test.rig import rig
from fmu_bearing.vibration_test.subject import subject
from tests.messages import says
from tests.vibration_test.played import play


@pytest.fixture
def quick(monkeypatch):
    """Runs are played; their scenes."""
    return play(monkeypatch)


def test_every_seed_runs_on_both_pieces_and_every_source_alone(quick):
    found = vibration("7003C", seeds=3)
    assert found.seeds == (1, 2, 3) and len(quick) == 10
    assert list(found.alone) == ["inner race", "outer race", "ball sizes", "form of the balls"]
    assert [scene.imperfections.seed for scene in quick] == [1, 1, 2, 2, 3, 3, 1, 1, 1, 1]
    low, middle, high = found.bands
    assert middle.soft == pytest.approx([80.0, 88.0, 96.0]) and middle.firm == pytest.approx([40, 44, 48])
    assert (low.name, low.low, low.high, low.limit) == ("L", 50.0, 300.0, None)
    assert low.alone == pytest.approx(dict.fromkeys(found.alone, 15.0))
    assert high.mean == pytest.approx(44.0)
    assert found.scene == rig(subject("7003C"))


def test_tables_have_pieces_ranges_limits_and_sources(quick):
    found = vibration("7003C", seeds=3, limits=(52.0, 18.0, 18.0))
    columns, rows = found.table()
    assert columns == ["um/s", "L, 50 to 300 Hz", "M, 300 to 1800 Hz", "H, 1800 to 10000 Hz"]
    assert rows[:5] == [
        ["soft piece, mean of 3 seeds", "33", "88", "44"],
        ["soft piece, range", "30 to 36", "80 to 96", "40 to 48"],
        ["firm piece, mean of 3 seeds", "33", "44", "39.6"],
        ["firm piece, range", "30 to 36", "40 to 48", "36 to 43.2"],
        ["limit", "52", "18", "18"],
    ]
    assert rows[5:] == [[f"{source} alone", "15", "40", "20"] for source in found.alone]
    in_anderon = found.table("anderon")[1]
    # 33 / 7.698, 18 / 7.698 and 18 / 7.531
    assert in_anderon[0][1] == "4.29" and in_anderon[4][2:] == ["2.34", "2.39"]
    assert found.anderon()["L"] == pytest.approx(33.0 / 7.698, rel=1e-4)
    assert found.remarks[:3] == (
        "M: 88 um/s on the soft piece (11.4 Anderon) is above its limit of 18 um/s (2.34 Anderon).",
        "H: 44 um/s on the soft piece (5.84 Anderon) is above its limit of 18 um/s (2.39 Anderon).",
        "M is not the bearing's alone: 88 um/s on the soft loading piece, 44 um/s on the firm one.",
    )


def test_remarks_name_what_is_no_test_by_the_standard(quick):
    usual = vibration("7003C", seeds=1).remarks
    assert usual[1:] == ("The balls have no waves that sound above 6.7 kHz, inside H.",)
    slow = vibration("7003C", seeds=1, speed_rpm=900.0, load_N=50.0, rigid=True).remarks
    assert "The rings stay round here, for comparison: a sensor touches a ring that bends." in slow
    assert says(slow[-1], "no test by the standard ... 1800 r/min ... 100 N")
    # within its tolerances it is one: +1 -2 % of the speed, 10 % of the load
    assert vibration("7003C", seeds=1, speed_rpm=1765.0, load_N=109.0).remarks[:-1] == usual[:1]
    assert vibration("7003C", seeds=1, speed_rpm=1820.0).remarks[-1] == slow[-1]


def test_lines_are_named_by_the_source_that_makes_them(monkeypatch):
    """A line at the same place as one of another source has the name of the one that is there alone."""

    def read(scene):
        rates = frequencies(scene, Reading(np.empty(0), np.empty(0), 0.0, 0.4178))
        frequency = np.arange(6251) * 2.0
        energy = np.full(frequency.size, 1e-4)
        lines = {
            "inner race": rates.f_i - rates.f_r,  # 179.6 Hz, 0.8 Hz from f_o + f_r
            "outer race": 3.0 * rates.f_o,  # 451.2 Hz, 2 Hz from 2 f_i + f_r
            "form of the balls": 1.001 * 24.0 * rates.f_b + rates.f_c,
        }
        for source, at in lines.items():
            if source in scene.imperfections.sources:
                energy[round(at / 2.0) + np.arange(-1, 2)] += np.array([25.0, 100.0, 25.0])
        return Reading(frequency, energy, 0.0, orbit=0.4178)

    monkeypatch.setattr("fmu_bearing.vibration_test.vibration.reading", read)
    found = vibration("7003C", seeds=1)
    assert [(one.band, one.name, one.source, one.wave) for one in found.lines] == [
        ("L", "f_i - f_r", "inner race", 11),
        ("M", "3 f_o", "outer race", 36),
        ("H", "24 f_b + f_c", "form of the balls", 24),
    ]
    # the line and its neighbours
    assert found.lines[0].velocity == pytest.approx(150.0**0.5, rel=1e-3)
    assert found.lines[0].order == pytest.approx(found.lines[0].frequency / 30.0)
    waves = found.by_order("inner race")
    assert waves.orders[waves.energies.sum(axis=0).argmax()] == 11
    with pytest.raises(ValueError, match="there is no source 'rust' here; there are inner race, outer race"):
        found.by_order("rust")


def test_files_are_a_picture_lines_and_spectra(quick, tmp_path):
    found = vibration("7003C", seeds=2, limits=(4.0, 4.0, 4.0), unit="anderon")
    files = found.save(tmp_path / "new", "anderon")
    assert [file.name for file in files] == ["bands.png", "lines.csv", "spectrum.csv"]
    with files[2].open(newline="") as file:
        head, *rows = csv.reader(file)
    assert head[:3] == ["frequency, Hz", "soft piece, um/s", "firm piece, um/s"] and len(head) == 7
    assert rows[500] == ["1000", *["84.1" if k == 0 else "42.05" if k == 1 else "40" for k in range(6)]]
    (axes,) = found.picture("anderon").axes
    heights = [bar.get_height() for bar in axes.patches]
    assert heights[:2] == pytest.approx([31.5 / 7.698, 84.0 / 7.698], rel=1e-4)
    assert axes.get_ylabel() == "Anderon" and len(axes.collections) >= 3  # the limits
