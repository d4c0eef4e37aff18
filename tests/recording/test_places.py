"""Microphones by name, by place, or both; the pressures of an FMU run without scene by their names."""

import dataclasses

import numpy as np
import pytest

from fmu_bearing import Recording, audio, measure, record, spread, with_fidelity
from fmu_bearing.recording.channels.microphone_places import named_places, place_name
from fmu_bearing.recording.measurements.sound_analysis import analyse_sound, stems, write_all

ELSEWHERE = (0.0, 0.3, 0.0)


@pytest.fixture(scope="module")
def recorded(scene):
    return record(with_fidelity(scene("7003C-bare"), model="rings"), 0.05)


@pytest.fixture(scope="module")
def pressures():
    """Run of an FMU with two pressures, whose scene is not known."""
    names = ("mic[1].pressure", "mic[2].pressure")
    table = np.zeros(3000, dtype=[("time", float), *((name, float) for name in names)])
    table["time"] = np.arange(3000) * Recording.PRESSURE_STEP
    for factor, name in enumerate(names, start=1):
        table[name] = 0.1 * factor * np.sin(2000.0 * np.pi * table["time"])
    return Recording.from_fmu(table)


def test_names_and_places_give_the_same(recorded):
    p1, p2 = recorded.positions[:2]
    by_name, by_place = (["P2", ELSEWHERE, "P1"], [p2, ELSEWHERE, p1])
    for take in (recorded.pressure, recorded.levels, recorded.places):
        assert np.array_equal(take(by_name), take(by_place))
    assert np.array_equal(
        recorded.levels(by_name, resolution=20.0), recorded.levels(by_place, resolution=20.0)
    )
    assert np.array_equal(recorded.mean_squares(by_name)[1], recorded.mean_squares(by_place)[1])
    parts = recorded.partial("P1")
    assert all(np.array_equal(part, recorded.partial([p1])[name]) for name, part in parts.items())
    assert np.array_equal(recorded.pressure("P1"), recorded.pressure([p1]))
    assert [c.members for c in recorded.paths(by_name)] == [c.members for c in recorded.paths(by_place)]


def test_measurements_take_names(recorded):
    ours, theirs = (measure.component_spectra(recorded, place)[1] for place in ("P3", recorded.positions[2]))
    assert all(np.array_equal(ours[name], theirs[name]) for name in theirs)
    ours, theirs = (
        measure.run_up(recorded, place, 10.0, 0.5).levels for place in ("P3", recorded.positions[2])
    )
    assert np.array_equal(ours, theirs)


@pytest.mark.heavy
def test_spread_and_listen_take_places_and_name_them(recorded, tmp_path):
    found = analyse_sound(recorded, ["P2", ELSEWHERE])
    assert found.names == ("P2", "(0, 300, 0) mm")
    assert found.levels[:, 0].tolist() == recorded.levels(["P2", ELSEWHERE]).tolist()
    files = write_all(recorded, found, tmp_path, directivity=False)
    assert {"P2.wav", "at-0-300-0-mm.wav"} <= {file.name for file in files}
    sure = spread(recorded, [ELSEWHERE, "P2"], seeds=1)
    assert sure.names == ("(0, 300, 0) mm", "P2")
    assert sure.levels.tolist() == recorded.levels([ELSEWHERE, "P2"], weighting="A").tolist()


def test_names_of_places_are_short_and_their_files_no_options():
    turned = 0.3 * np.array([np.cos(0.5 * np.pi), np.sin(0.5 * np.pi), -1e-17])
    places = [tuple(turned), (-0.005, 0.0, 0.0), (0.005, 0.0, 0.0), (0.0123456, -0.1, 0.0)]
    names = [place_name(place) for place in places]
    assert names == ["(0, 300, 0) mm", "(-5, 0, 0) mm", "(5, 0, 0) mm", "(12.346, -100, 0) mm"]
    assert stems([*names, ".1", "-x"]) == [
        "at-0-300-0-mm", "at--5-0-0-mm", "at-5-0-0-mm", "at-12.346--100-0-mm", "at-1", "at-x",
    ]  # fmt: skip


@pytest.mark.heavy
def test_every_microphone_has_a_sound_file_of_its_own(recorded, tmp_path):
    # the fourth and last differ from others by what some file systems, or file names, do not know
    names = ("A.1", "A-1", "A_1", "a-1", "A 1", "A/1", "A-1-2", ".1")
    places = tuple((name, (0.2 + 0.05 * k, 0.1, 0.0)) for k, name in enumerate(names))
    named = dataclasses.replace(recorded, microphones=places)
    written = write_all(named, analyse_sound(named), tmp_path, directivity=False)
    sounds = [file for file in written if file.suffix == ".wav"]
    assert [file.name for file in sounds[:4]] == ["A.1.wav", "A-1.wav", "A_1.wav", "a-1-2.wav"]
    assert len({file.name.casefold() for file in sounds}) == len(names)
    assert not [file.name for file in sounds if file.name.startswith(".") or file.parent != tmp_path]
    for file, pressure in zip(sounds, named.pressure(), strict=True):
        kept, rate = audio.read_wav(file)
        # 24 bits of a sample, and the scale of all
        np.testing.assert_allclose(kept, audio.resample(pressure, named.rate, rate), rtol=0, atol=1e-6)


@pytest.mark.parametrize("take", ["pressure", "levels", "partial", "mean_squares", "paths", "named"])
def test_unknown_names_are_refused_with_the_known_ones(recorded, take):
    with pytest.raises(ValueError, match="no microphone 'P9', 'p1'; there are P1, P2, P3, P4"):
        getattr(recorded, take)(["P1", "p1", "P9"])


def test_unknown_names_elsewhere(recorded):
    for call in (
        lambda: measure.component_spectra(recorded, "P9"),
        lambda: measure.run_up(recorded, "P9"),
        lambda: spread(recorded, ["P1", "P9"]),
        lambda: analyse_sound(recorded, "P9"),
    ):
        with pytest.raises(ValueError, match="no microphone 'P9'; there are P1, P2, P3, P4"):
            call()


def test_what_is_no_place(recorded):
    for wrong in ([(0.0, 0.1)], (0.0, 0.1, 0.2), [(0.0, np.nan, 0.1)]):
        with pytest.raises(ValueError, match=r"positions must be finite \(x, y, z\) in m or names"):
            recorded.levels(wrong)
    with pytest.raises(ValueError, match="no microphone to listen at"):
        recorded.levels([])
    with pytest.raises(ValueError, match="there is no microphone 'P1'; there are none: give the scene"):
        named_places([], "P1")


def test_pressures_without_scene_are_found_by_name(pressures):
    assert pressures.pressure().shape == (2, pressures.size)
    first, second = pressures.levels()
    assert second - first == pytest.approx(20.0 * np.log10(2.0), abs=1e-9)  # twice the pressure, exactly
    assert pressures.levels("mic[2].pressure")[0] == second
    with pytest.raises(ValueError, match="no microphone was recorded"):
        pressures.levels([ELSEWHERE])
