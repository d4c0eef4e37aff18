"""The end of the excitation: how far the surfaces of a scene reach, and its mark in every spectrum."""

import math

import numpy as np
import pytest

from fmu_bearing import pictures, simulate
from fmu_bearing.acoustics.analysis.lines import Line
from fmu_bearing.acoustics.analysis.order import OrderMap, Waterfall
from fmu_bearing.acoustics.analysis.spectrum import kinematic_frequencies, level_spectrum
from fmu_bearing.acoustics.analysis.third_octave import centre_frequencies
from fmu_bearing.prepare.imperfections import excitation_end
from fmu_bearing.recording.measurements.measure import BEYOND, strongest
from fmu_bearing.recording.record import record
from fmu_bearing.recording.studies.compare import compare
from fmu_bearing.reports.data.microphones import at_microphones
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.sound.levels_and_spectra import spectra
from fmu_bearing.scene.read import with_fidelity

RPM = math.pi / 30.0
BARE = (12, 4.5, 26.0, math.radians(15.0))  # balls, mm, mm, rad


@pytest.fixture(scope="module")
def made(example):
    return record(with_fidelity(example("7003C-bare"), model="rings"), 0.1, settle=0.02, progress=False)


@pytest.mark.parametrize(("rpm", "reach"), [(20_000.0, 10.0), (20_000.0, 20.0), (5_000.0, 20.0)])
def test_end_is_the_highest_order_times_its_rate(example, rpm, reach):
    bare = example("7003C-bare").replace(
        {"operation.speed_rpm": rpm, "imperfections.highest_frequency_kHz": reach}
    )
    at = kinematic_frequencies(rpm * RPM, *BARE)
    # whole orders within the band; a ball has 80 at most
    rates = (at.f_r - at.f_c, at.f_c)
    of_races = (rate * math.floor(1e3 * reach / rate) for rate in rates)
    expected = max(*of_races, at.f_b * min(80, math.floor(1e3 * reach / at.f_b)))
    assert excitation_end(bare, rpm * RPM) == pytest.approx(expected, rel=1e-9)
    # orders stay, so that the end goes with the speed
    assert excitation_end(bare, -0.5 * rpm * RPM) == pytest.approx(0.5 * expected, rel=1e-9)
    assert excitation_end(bare, 0.0) is None
    assert excitation_end(bare.replace({"imperfections": None}), rpm * RPM) is None


def test_harmonics_of_a_list_count_by_their_orders(scene):
    given = scene("7003C-bare")
    one = {"order": 40, "amplitude_um": 0.1, "phase_deg": 0.0}
    listed = given.replace({
        "imperfections.inner_race_amplitude_um": None, "imperfections.outer_race_amplitude_um": 0.0,
        "imperfections.inner_race_harmonic": [one], "imperfections.ball_form_nm": 0.0,
        "imperfections.ball_waviness_nm": 0.0,
    })  # fmt: skip
    at = kinematic_frequencies(1000.0, *BARE)
    assert excitation_end(listed, 1000.0) == pytest.approx(40.0 * (at.f_r - at.f_c), rel=1e-9)


def marks(axes):
    return [line.get_xdata()[0] for line in axes.lines if line.get_gid() == "excitation-end"]


def test_pictures_mark_it_where_the_axis_reaches_so_far():
    frequency = np.linspace(0.0, 20e3, 401)
    levels = {"total": np.full(401, 40.0)}
    (axes,) = pictures.spectrum_picture(frequency, levels, excitation_end=9993.8).axes
    assert marks(axes) == [9993.8] and "end of the excitation, 9.99 kHz " in [
        one.get_text() for one in axes.texts
    ]
    for end in (None, 25e3):
        (axes,) = pictures.spectrum_picture(frequency, levels, excitation_end=end).axes
        assert marks(axes) == []
    (axes,) = pictures.spectrum_picture(frequency, levels, excitation_end={"A": 5e3, "B": 9e3}).axes
    assert marks(axes) == [5e3, 9e3]
    bands = centre_frequencies()
    (axes,) = pictures.third_octave_picture(
        bands, {"total": np.full(len(bands), 40.0)}, excitation_end=1e4
    ).axes
    # 10 kHz is the middle of its band, the fourth from the end of those to 20 kHz
    assert marks(axes) == pytest.approx([len(bands) - 4], abs=0.01)


def test_maps_mark_it_at_every_speed():
    speed = np.linspace(500.0, 1500.0, 11)  # rad/s
    frequency = np.linspace(0.0, 20e3, 41)
    fall = Waterfall(frequency, np.linspace(0.0, 1.0, 11), speed, np.full((11, 41), 40.0))
    (axes, _) = pictures.waterfall_picture(fall, excitation_order=60.0).axes
    (line,) = [one for one in axes.lines if one.get_gid() == "excitation-end"]
    assert line.get_xdata() == pytest.approx(60.0 * speed / (2.0 * math.pi), rel=1e-12)
    orders = OrderMap(np.linspace(0.0, 80.0, 41), speed, np.linspace(0.0, 1.0, 11), np.full((11, 41), 40.0))
    at = kinematic_frequencies(1000.0, *BARE)
    (axes, _) = pictures.order_picture(orders, at, excitation_end=60.0 * at.f_r).axes
    (line,) = [one for one in axes.lines if one.get_gid() == "excitation-end"]
    assert line.get_xdata() == pytest.approx([60.0, 60.0], rel=1e-12)


@pytest.mark.heavy
def test_runs_recordings_and_comparisons_know_it(made):
    end = made.excitation_end
    assert end == pytest.approx(excitation_end(made.scene, float(np.mean(made.speed))), rel=1e-12)
    (axes,) = made.plot(["P1"]).axes
    assert marks(axes) == [end]
    run = simulate(made.scene, 0.02, step=2.5e-5, outputs=["outer_ring.velocity.z"], progress=False)
    assert run.spectrum("outer_ring.velocity.z").excitation_end == pytest.approx(end, rel=1e-6)
    slow = made.scene.replace({"operation.speed_rpm": 3_000.0, "imperfections.highest_frequency_kHz": 5.0})
    both = compare(made, slow, duration=0.05, settle=0.02, progress=False)
    assert [marks(ax) for ax in both.plot("P1").axes] == [[end], [both.b.excitation_end]]
    assert both.b.excitation_end == pytest.approx(excitation_end(slow, 3_000.0 * RPM), rel=1e-9)


@pytest.mark.heavy
def test_reports_mark_it_and_name_no_source_beyond(made):
    subject = Subject(made, made.radiation_model)
    recorded, end = at_microphones(subject), made.excitation_end
    spectrum, lines, thirds = spectra(subject, recorded).blocks
    (mark,) = [trace for trace in spectrum.figure.data if trace.name.startswith("end of the excitation")]
    assert list(mark.x) == [end, end] and mark.visible is not False
    assert "excite up to" in spectrum.note and "no finding" in spectrum.note
    for row in lines.rows:
        assert (row[-1] == "beyond the excitation") == (float(row[0]) > end)
    (line,) = thirds.figure.layout.shapes
    assert line.x0 == pytest.approx(10.0 * math.log10(end / recorded.third_octaves[0][0]))


def test_no_kinematic_line_is_named_beyond(example):
    """The bare 7003C excited to 4 kHz only: its strongest lines above are of no surface."""
    scene = example("7003C-bare").replace({"imperfections.highest_frequency_kHz": 4.0})
    made = record(with_fidelity(scene, model="response"), 0.05, settle=0.02, progress=False)
    frequency, levels = level_spectrum(made.pressure()[0], made.rate)
    for low, named in ((0.0, True), (1.2 * made.excitation_end, False)):
        part = frequency > low
        found = strongest(made, frequency[part], levels[part], 6)
        names = [line.name for line in found]
        assert (set(names) == {BEYOND}) != named, names


def test_axes_end_a_little_above_the_highest_level():
    """Levels to 40 dB: an axis to 70 or 100 dB was empty by half. Words on the end lie above all bars."""
    bands = centre_frequencies()
    levels = np.full(len(bands), 40.0)
    (axes,) = pictures.third_octave_picture(bands, {"total": levels}, excitation_end=1e4).axes
    assert 40.0 < axes.get_ylim()[1] < 50.0
    frequency = np.linspace(0.0, 20e3, 2001)
    total = np.full(2001, -20.0)
    total[1000] = 38.0  # at 10 kHz
    line = Line(1e4, 38.0, "3 f_i")
    (axes,) = pictures.spectrum_picture(frequency, {"total": total}, excitation_end=9.95e3, lines=[line]).axes
    assert 38.0 + 12.0 <= axes.get_ylim()[1] < 60.0
    (name,) = [text for text in axes.texts if text.get_gid() == "line-name"]
    (words,) = [text for text in axes.texts if text.get_gid() == "excitation-words"]
    axes.get_figure().draw_without_rendering()
    assert not name.get_window_extent().overlaps(words.get_window_extent())
