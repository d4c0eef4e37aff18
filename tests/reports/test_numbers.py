"""The page prints what the recording holds."""

import io
import math

import numpy as np
import pytest
from scipy.io import wavfile

from fmu_bearing.acoustics.analysis.directivity import PLANES
from fmu_bearing.acoustics.analysis.spectrum import amplitude_spectrum, level_spectrum
from fmu_bearing.acoustics.filters.fir import decimator_response
from fmu_bearing.design.torque_range import CAPTION, torque_range
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import SD
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import thinned
from fmu_bearing.reports.sections.ball_contacts import by_place
from fmu_bearing.reports.sections.ring_motion import velocity_spectrum
from fmu_bearing.results.balls import RACES, name_of
from tests.reports.reading import numbers


def test_levels_are_the_recordings(full, full_page):
    table = full_page.tables["Equivalent levels re 20 uPa"]
    head, rows = table[0], table[1:]
    z, a = full.levels(weighting="Z"), full.levels(weighting="A")
    assert [row[0] for row in rows] == [name for name, _ in full.microphones]
    parts = full.partial()
    for k, row in enumerate(rows):
        assert float(row[head.index("Leq, dB")]) == pytest.approx(z[k], abs=0.051)
        assert float(row[head.index("LAeq, dB(A)")]) == pytest.approx(a[k], abs=0.051)
        ring = 10 * np.log10(full.mean_square(parts["inner_ring"], "A")[k] / 4e-10)
        assert float(row[head.index("inner ring, dB(A)")]) == pytest.approx(ring, abs=0.051)


def test_the_loudest_level_is_the_tile(full, full_report):
    assert full_report.figures["laeq_dB"] == pytest.approx(full.levels(weighting="A").max(), abs=1e-9)
    assert full_report.figures["speed_rpm"] == pytest.approx(20_000.0)


def test_spectra_are_the_recordings(full, full_page):
    total = full.pressure()
    for k in range(len(full.microphones)):
        (trace,) = full_page.traces("spectrum", mic=str(k), component="total")
        frequency, levels = level_spectrum(total[k], full.rate, max(5.0, full.rate / full.size))
        keep = (frequency >= 20.0) & (frequency <= 20_000.0)
        # in steps of 1/64 dB
        assert numbers(trace["y"]) == pytest.approx(levels[keep], abs=1.0 / 128.0 + 1e-5)
        assert trace["x0"] == frequency[keep][0] and trace["dx"] == pytest.approx(frequency[1])


def test_pictures_open_with_every_line_that_the_page_names(full_page):
    """The least of 1, 5, 10 and 20 kHz that has the lines of the table: with 8 and 10 kHz none was seen."""
    (table,) = [rows for caption, rows in full_page.tables.items() if caption.startswith("Strongest lines")]
    highest = max(float(row[0]) for row in table[1:])
    ends = {full_page.figures[key]["layout"]["xaxis"]["range"][1] for key in ("spectrum", "waterfall")}
    (end,) = ends
    assert highest < end <= 20e3
    (trace,) = full_page.figures["waterfall"]["data"][:1]
    reached = trace["x0"] + trace["dx"] * (len(trace["z"][0]) - 1)
    assert end - trace["dx"] <= reached <= end
    assert (
        f'<option value="{end:g}"' in full_page.text.split('data-chart="spectrum" data-key="reach"')[1][:60]
    )


def test_orbits_have_the_extent_of_the_motion(full, full_page):
    kept = (full.output_time >= full.start - 1e-9) & (
        full.output_time <= full.time[-1] + 1 / full.rate + 1e-9
    )
    assert {trace["meta"]["orbit"] for trace in full_page.traces("orbits")} == {
        "inner_ring", "outer_ring", "cage",
    }  # fmt: skip
    for body in ("inner_ring", "outer_ring", "cage"):
        squares = full_page.traces("orbits", orbit=body)[0]
        for k, (axis, shown) in enumerate((("y", "x"), ("z", "y"))):
            place = 1e6 * full.outputs[f"{body}.displacement.{axis}"][kept]
            place -= place.mean()
            seen = np.flatnonzero(squares["z"].max(axis=k))
            cell, first = squares[f"d{shown}"], squares[f"{shown}0"]
            edges = first + cell * (seen[[0, -1]] + [-0.5, 0.5])
            assert edges[0] <= place.min() < edges[0] + cell and edges[1] - cell < place.max() <= edges[1]


@pytest.mark.parametrize("fidelity", ["full", "rings"])
def test_balls_add_up_to_the_bearing(fidelity, request):
    """One kernel for one ball and for all: mean and extreme over the balls are the variables'."""
    recording = request.getfixturevalue(fidelity)
    balls = range(1, recording.scene.bearing.ball_count + 1)
    for race in RACES:
        load = np.array([recording.outputs[name_of(j, "load", race)] for j in balls])
        angle = np.array([recording.outputs[name_of(j, "angle", race)] for j in balls])
        assert load.mean(0) == pytest.approx(recording.outputs[f"contact.{race}.load_mean"], rel=1e-12)
        assert load.max(0) == pytest.approx(recording.outputs[f"contact.{race}.load_max"], rel=1e-12)
        assert angle.mean(0) == pytest.approx(recording.outputs[f"contact.{race}.angle_mean"], rel=1e-12)


def test_the_cage_moves_as_its_velocity_says(full):
    """Its place, read from the state, moves by the variable of its velocity: trapezoidal rule over 39 us."""
    kept = full.output_time >= full.start
    moved = np.diff(full.outputs["cage.displacement.z"][kept])
    velocity, time = full.outputs["cage.velocity.z"][kept], full.output_time[kept]
    expected = 0.5 * (velocity[1:] + velocity[:-1]) * np.diff(time)
    # pockets push for less than a step: what the rule misses is a tenth at most
    assert np.std(moved - expected) < 0.1 * np.std(moved)


def test_velocity_over_frequency_is_that_of_the_sound_channels(full):
    """Velocities read 25,600 times a second, and accelerations at 51.2 kHz behind a filter over 2 pi f."""
    subject = Subject(full, "compact")
    for body, first in (("inner_ring", SD.C_INNER), ("outer_ring", SD.C_OUTER)):
        for k, axis in enumerate("xyz"):
            frequency, rms = velocity_spectrum(subject, f"{body}.velocity.{axis}", 20.0)
            f, acceleration = amplitude_spectrum(full.channels[:, first + k], full.rate, 20.0)
            inside = (f > frequency[0] - 1.0) & (f < frequency[-1] + 1.0)
            expected = (acceleration / np.abs(decimator_response(f)))[inside] / (2.0 * np.pi * frequency)
            strong = (frequency > 70.0) & (expected > 0.03 * expected[frequency > 70.0].max())
            assert strong.sum() > 5  # skirts of lines feel that the blocks differ by a sample
            assert rms[strong] == pytest.approx(expected[strong], rel=0.05)


def test_bands_hold_the_energy_of_the_motion(full_page):
    rows = full_page.tables["Rms velocity in three bands, um/s"][1:]
    rms = {row[0]: row for row in full_page.tables["Velocity of the centres about its mean, mm/s"][1:]}
    for body, axis, *bands in rows:
        if body == "cage":  # drifts about its middle, below the bands
            continue
        whole = 1e-3 * math.sqrt(sum(float(band) ** 2 for band in bands))
        assert whole == pytest.approx(float(rms[body]["xyz".index(axis) + 1]), rel=0.05, abs=2e-3)


def test_directivity_is_the_recordings(full, full_page):
    for plane, (first, second) in PLANES.items():
        (trace,) = [t for t in full_page.traces("planes", band="unweighted") if t["name"].startswith(plane)]
        shown = numbers(trace["r"])
        quarter = (len(shown) - 1) // 4
        expected = full.levels([first, second], resolution=20.0)
        assert shown[[0, quarter]] == pytest.approx(expected, abs=1.0 / 128.0 + 1e-4)
        assert shown[-1] == shown[0]
    surface = full_page.traces("balloon", band="A-weighted")[0]
    levels = numbers(surface["surfacecolor"])
    x = numbers(surface["x"])
    assert levels[0] == pytest.approx(
        full.levels([(1.0, 0.0, 0.0)], weighting="A", resolution=20.0)[0], abs=1.0 / 128.0 + 1e-4
    )
    assert (x[0] > 0).all() and (x[-1] < 0).all() and np.abs(x).max() <= 1.0


def test_sounds_keep_their_ratio(full, full_page):
    """Louder there is louder here, within the fades and 16 bits."""
    received = []
    for data in full_page.sounds:
        rate, samples = wavfile.read(io.BytesIO(data))
        assert rate == 48_000 and samples.dtype == np.int16
        assert len(samples) / rate == pytest.approx(full.size / full.rate, abs=1e-3)
        received.append(10 * np.log10(np.mean(samples.astype(float) ** 2)))
    levels = full.levels()
    assert np.array(received) - received[0] == pytest.approx(levels - levels[0], abs=0.3)
    assert max(np.abs(wavfile.read(io.BytesIO(data))[1]).max() for data in full_page.sounds) > 0.85 * 32767


def test_friction_shares_are_the_variables(full, full_page):
    rows = {row[0]: row for row in full_page.tables["Friction and heat, means over the recording"]}
    kept = full.output_time >= full.start - 1e-9
    for name, key in (("rolling resistance", "rolling"), ("cage: pockets and lands", "cage")):
        mean = 1e3 * full.outputs[f"friction_torque_share.{key}"][kept].mean()
        assert float(rows[name][1]) == pytest.approx(mean, abs=2e-3)
    assert float(rows["all shares"][3]) == 100.0


def test_the_range_of_the_torque_is_the_settled_one(full, full_page):
    """At the mean speed of the run, to the three digits that are shown."""
    found = torque_range(full.scene.replace({"operation.speed_rpm": float(np.mean(full.speed)) / RPM}))
    rows = dict(full_page.tables["Friction and heat of the settled bearings, without waviness"])
    for unit, one in zip(("N mm", "W"), found.shown[0], strict=True):
        shown = [float(rows[f"its range: {end}, {unit}"]) for end in ("low", "high")]
        assert shown == pytest.approx(list(one), rel=5e-3)
    _, *inputs = full_page.tables[f"F{CAPTION[1:]}"]
    assert [row[:3] for row in inputs] == [row[:3] for row in found.table()[1]]


def test_thinning_keeps_the_peaks():
    rng = np.random.default_rng(1)
    signal = rng.normal(size=100_000)
    signal[54_321], signal[77_777] = 30.0, -40.0
    few, span = thinned(signal, 6000)
    assert len(few) <= 6000 and len(few) * span == pytest.approx(len(signal), rel=1e-3)
    assert few.max() == 30.0 and few.min() == -40.0
    assert np.argmax(few) * span == pytest.approx(54_321, abs=2 * span)
    assert np.array_equal(thinned(signal[:50], 6000)[0], signal[:50])


def test_parts_of_the_circle():
    azimuth = np.radians([[5.0, 355.0], [6.0, 185.0]])
    values = np.array([[1.0, 7.0], [3.0, 5.0]])
    middles, (mean, low, high) = by_place(azimuth, values, 36)
    assert np.degrees(middles) == pytest.approx([5.0, 185.0, 355.0])
    assert (
        mean.tolist() == [2.0, 5.0, 7.0]
        and low.tolist() == [1.0, 5.0, 7.0]
        and high.tolist() == [3.0, 5.0, 7.0]
    )
