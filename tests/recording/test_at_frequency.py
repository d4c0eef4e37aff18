"""Which source makes the noise at a frequency: components, lines, what excites them."""

import csv
import json

import numpy as np
import pytest
from typer.testing import CliRunner

from fmu_bearing import cli
from fmu_bearing.recording.measurements.at_frequency import noise_at
from fmu_bearing.recording.measurements.sound_analysis import analyse_sound
from fmu_bearing.recording.record import record
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import EXAMPLES


@pytest.fixture(scope="module")
def recording():
    scene = with_fidelity(read_scene(EXAMPLES / "7003C-bare.toml"), model="rings")
    return record(scene, 0.2, settle=0.05, radiation_model="compact", progress=False)


@pytest.fixture(scope="module")
def found(recording):
    return analyse_sound(recording)


def test_the_line_of_the_inner_race_is_found_and_explained(recording, found):
    """2 f_i, in the band of 5 kHz: waves of the inner race, whoever radiates them."""
    at = noise_at(recording, found, 4640.0)
    assert at.band == 5000.0 and at.names == found.names and at.line == at.strongest
    assert at.line.name == "2 f_i" and at.line.frequency == pytest.approx(
        2 * recording.kinematics().f_i, rel=2e-3
    )
    words = "; ".join(at.sentences())
    assert words.endswith("it is 2 f_i: waves of the inner race")
    k = at.loudest
    parts = {name: row[k] for name, row in at.levels.items() if name != "total"}
    first = max(parts, key=parts.get)
    assert words.startswith(f"at {at.names[k]} {first.replace('_', ' ')} radiates most")


def test_the_line_that_is_asked_for_is_explained_and_a_stronger_one_is_named_beside(recording, found):
    kind = recording.kinematics()
    at = noise_at(recording, found, 1675.0)
    assert at.line.frequency == pytest.approx(kind.f_o, abs=0.3 * found.frequency[1])
    assert at.strongest.level > at.line.level + 3.0
    said = at.sentences()
    assert said[-2] == "it is f_o: waves of the outer race, and the balls passing"
    assert said[-1].startswith("the strongest line of the third octave is at 1741.4 Hz")
    assert said[-1].endswith("dB: 2 f_b - f_c")
    data = at.summary()
    assert data["line"]["explained_by"] == "f_o" and data["strongest"]["explained_by"] == "2 f_b - f_c"


def test_levels_are_those_of_the_third_octaves(found, recording):
    at = noise_at(recording, found, 1050.0)  # within the band of 1 kHz, 891 to 1122 Hz
    place = int(np.argmin(np.abs(found.bands - 1000.0)))
    assert at.band == 1000.0
    assert at.levels["total"] == pytest.approx(found.third_octaves[:, place])
    for name, values in found.third_octave_parts.items():
        assert at.levels[name] == pytest.approx(values[:, place])


def test_parts_add_up_to_the_total(found):
    """As pressures do: no total exceeds the sum of the parts' amplitudes."""
    most = 20.0 * np.log10(sum(10.0 ** (parts / 20.0) for parts in found.third_octave_parts.values()))
    assert (found.third_octaves <= most + 1e-6).all()


def test_the_line_of_the_balls_is_where_they_spin(recording, found):
    """They spin faster than a ball that rolls at the mean angle: that one has its line 5.8 Hz beside."""
    at = noise_at(recording, found, 1741.0)
    kind = recording.kinematics()
    assert at.line.name == at.nearest.name == "2 f_b - f_c"
    assert at.line.frequency == pytest.approx(2.0 * kind.f_b - kind.f_c, abs=0.3 * found.frequency[1])
    assert at.sentences()[-1] == "it is 2 f_b - f_c: form of the balls"


def test_where_nothing_fits_the_nearest_is_named_with_its_distance(recording, found):
    at = noise_at(recording, found, 150.0)
    cage = recording.kinematics().f_c
    assert at.line is None and at.nearest.name == "f_c" and at.nearest.frequency == pytest.approx(cage)
    assert at.sentences()[-2:] == [
        "no line stands out in the band",
        f"no kinematic frequency fits; the nearest is f_c, {150.0 - cage:.1f} Hz below: the cage, or one "
        "ball larger than the others",
    ]


def test_beyond_the_excitation_no_surface_is_named(recording, found):
    at = noise_at(recording, found, 12e3)
    assert at.sentences()[-1] == "no surface of the scene excites it: they end at 9.99 kHz"


@pytest.mark.parametrize("frequency", [1.0, 30e3, 0.0, -5.0, float("nan"), float("inf")])
def test_a_frequency_beside_the_bands_is_refused(recording, found, frequency):
    with pytest.raises(ValueError, match=r"there are third octaves from 17.8 to 22\d+ Hz only"):
        noise_at(recording, found, frequency)


@pytest.mark.heavy
def test_the_command_prints_it_and_the_table_has_components(recording, found, tmp_path):
    recording.save(tmp_path / "run.npz")
    words = [
        "sound",
        str(tmp_path / "run.npz"),
        "--no-directivity",
        "--no-wav",
        "--no-spread",
        "--force",
        "-o",
        str(tmp_path / "out"),
    ]
    done = CliRunner().invoke(cli.app, [*words, "--at", "4.64e3", "--at", "12e3"])
    assert done.exit_code == 0, done.output
    printed = done.stdout.splitlines()
    for frequency in (4.64e3, 12e3):
        for line in noise_at(recording, found, frequency).sentences():
            assert f"{frequency:g} Hz: {line}" in printed
    data = json.loads(CliRunner().invoke(cli.app, [*words, "--at", "4.64e3", "--json"]).stdout)["at"]
    assert data[0]["line"]["explained_by"] == "2 f_i" and data[0]["third_octave_Hz"] == 5000.0
    with (tmp_path / "out" / "third-octaves.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    place = [float(row["band, Hz"]) for row in rows].index(5000.0)
    for name, values in found.third_octave_parts.items():
        shown = rows[place][f"P2 {name}, dB"]
        if shown == "-":  # silent
            assert values[1, place] < -100.0
        else:
            assert float(shown) == pytest.approx(values[1, place], abs=0.006)
    refused = CliRunner().invoke(cli.app, [*words, "--at", "1"])
    assert refused.exit_code == 2 and refused.stderr.startswith("error: at 1 Hz: there are third octaves")
