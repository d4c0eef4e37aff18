"""Lines are explained by how cage and balls of the run turned, not by a contact angle."""

import numpy as np
import pytest

from fmu_bearing.acoustics.analysis.lines import (
    KinematicLine,
    Line,
    explain,
    kinematic_lines,
    strongest_lines,
)
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies, level_spectrum
from fmu_bearing.design.fresh import new_scene
from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.engine.layout import SD
from fmu_bearing.metrology.axis_watch import AxisWatch
from fmu_bearing.recording.channels.channel_history import ChannelHistory
from fmu_bearing.recording.measurements import measure, tables
from fmu_bearing.recording.measurements.at_frequency import NoiseAt
from fmu_bearing.recording.record import record
from fmu_bearing.scene.read import read_scene_text, with_fidelity


@pytest.fixture(scope="module")
def steel():
    """Steel balls at 18,000 r/min meet the races of this bearing at 9 and 24 deg."""
    text = new_scene("s", "NSK-7010C", kind="steel", speed_rpm=18_000.0, preload_class="medium", sound=True)
    return with_fidelity(read_scene_text(text, "s.toml"), model="full")


@pytest.fixture(scope="module")
def run(steel):
    watch = AxisWatch()
    made = record(steel, 0.25, settle=0.05, watch=watch, outputs=("cage.speed_ratio",), progress=False)
    return made, watch


@pytest.mark.heavy
def test_kinematics_are_those_of_the_run(run, steel):
    made, _ = run
    within = made.within()
    found = made.kinematics()
    # the cage goes with the balls: by the clearance of a pocket, 0.3 mm of 33 mm, in 33 turns at most
    assert found.f_c / found.f_r == pytest.approx(within["cage.speed_ratio"].mean(), rel=3e-4)
    assert found.f_o == pytest.approx(steel.bearing.ball_count * found.f_c, rel=1e-12)
    assert found.f_i + found.f_o == pytest.approx(steel.bearing.ball_count * found.f_r, rel=1e-12)
    # rolling at the mean of the angles turns the cage by more than 2 % too slowly, and the balls
    angles = [p.contacts[race]["angle_mean"] for p in operating_point(steel).bearings for race in p.contacts]
    rolling = made.kinematics(contact_angle=float(np.mean(angles)))
    assert found.f_c / rolling.f_c > 1.02 and found.f_b / rolling.f_b > 1.02
    # the steady state turns as the run does; waviness moves it by less than 0.05 %
    assert operating_point(steel).bearings[0].frequencies == pytest.approx(found, rel=5e-4)
    assert made.kinematics(speed=1000.0).f_i == pytest.approx(found.f_i * 1000.0 / made.speed.mean())


@pytest.mark.heavy
def test_lines_have_the_names_of_what_passes(run):
    made, _ = run
    pressure = made.pressure([made.microphones[0][0]])[0]
    frequency, levels = level_spectrum(pressure, made.rate, measure.fine(made))
    lines = measure.strongest(made, frequency, levels, 12)
    # of waves of the races: by the mean angle 3 f_o would lie 166 Hz lower, and 3 f_i - f_r as much higher
    assert {"3 f_o", "3 f_i - f_r"} <= {line.name for line in lines}
    assert all(line.name for line in lines[:3])
    third = next(line for line in lines if line.name == "3 f_o")
    # waves of one race alone make it: noise moves it by less than half a bin of 5 Hz
    assert third.frequency == pytest.approx(3.0 * made.kinematics().f_o, abs=2.5)


def test_a_tone_is_found_between_the_bins():
    time = np.arange(25_600) / 51_200.0
    for place in (1000.0, 1001.3, 1002.5, 1003.9):
        frequency, levels = level_spectrum(np.sin(2.0 * np.pi * place * time), 51_200.0, 5.0)
        (line,) = strongest_lines(frequency, levels, 1)
        # seven bins hold a flat-top lobe but for 0.5 % of a bin
        assert line.frequency == pytest.approx(place, abs=0.025)


def test_a_whirl_has_its_line(run):
    made, _ = run
    (whirl,) = made.whirls()
    # the cage's centre goes round at its own mean angular velocity
    speed = made.within()["cage.whirl_speed"]
    assert whirl == pytest.approx(speed.mean() / (2.0 * np.pi)) and 100.0 < whirl < 250.0
    assert "f_w" in {line.name for line in measure.known_lines(made, 1000.0)}


def test_without_rates_the_cage_decides_and_then_the_angle(run):
    made, _ = run
    bare = {name: values for name, values in made.outputs.items() if not name.startswith("balls.")}
    by_cage = history(made, bare)
    assert by_cage.turning_known
    assert by_cage.kinematics().f_c == pytest.approx(made.kinematics().f_c, rel=3e-4)
    none = history(made, {})
    assert not none.turning_known and np.isnan(none.whirls()).all()
    nominal = np.radians(made.scene.bearing.contact_angle_deg)
    assert none.kinematics() == made.kinematics(contact_angle=float(nominal))


def history(made, outputs):
    return ChannelHistory(
        made.scene, made.radiation_model, SD.RATE, made.start, made.size, made.output_time, made.speed_points,
        outputs,
    )  # fmt: skip


def test_bearings_that_turn_differently_have_lines_of_their_own(run):
    made, _ = run

    class Two(ChannelHistory):
        def bearing_kinematics(self, speed=None, contact_angle=None):
            one = made.kinematics()
            return one, KinematicFrequencies(one.f_r, *(1.01 * f for f in one[1:]))

        def whirls(self):
            return (100.0, 101.5)

    two = Two(made.scene, "bem", SD.RATE, made.start, made.size, made.output_time, made.speed_points)
    found = {line.name: line.frequency for line in measure.known_lines(two, 10_000.0)}
    assert found["f_o of bearing 2"] == pytest.approx(1.01 * found["f_o of bearing 1"])
    assert "f_o" not in found and [name for name in found if name.startswith("2 f_r")] == ["2 f_r"]
    assert found["f_w of bearing 1"] == 100.0


def test_the_simplest_of_those_that_fit_is_named_with_their_number():
    near = [
        KinematicLine(9898.0, "11 f_b", 10, 11), KinematicLine(9900.0, "5 f_o", 4, 5),
        KinematicLine(9899.0, "9 f_b - 2 f_c", 14, 11), KinematicLine(9990.0, "f_r", 0, 1),
    ]  # fmt: skip
    best, fits = explain(9898.0, near, 5.0)
    assert best.name == "5 f_o" and fits == 3
    assert explain(9898.0, near, 0.1)[0].name == "11 f_b" and explain(1.0, near, 0.1) == (None, 0)
    line = Line(9898.0, 50.0, "5 f_o", -2.0, fits=3, terms=5)
    assert line.words == "5 f_o, one of 3 that fit" and line.explanation == "5 f_o"
    assert tables.lines_table([line])[1] == [["9898.0", "50.0", "5 f_o, one of 3 that fit", "-2.0"]]
    alone, few = Line(1.0, 1.0, "5 f_o", fits=1, terms=5), Line(1.0, 1.0, "2 f_o", fits=9, terms=2)
    assert alone.words == "5 f_o" and few.words == "2 f_o"
    levels = {"total": np.array([50.0])}
    at = NoiseAt(9898.0, 10_000.0, ("P1",), levels, line, near[1], None)
    assert at.sentences()[-1] == (
        "the simplest of 3 multiples and sums of kinematic frequencies that fit is 5 f_o: waves of the outer "
        "race, and the balls passing"
    )
    assert at.summary()["line"]["fits"] == 3


def test_a_whirl_that_wanders_has_no_line():
    kinematics = KinematicFrequencies(300.0, 130.0, 1100.0, 3200.0, 2500.0)
    assert not any("f_w" in line.name for line in kinematic_lines(kinematics, 1000.0))
    whirl = [line for line in kinematic_lines(kinematics, 1000.0, whirl=150.0) if "f_w" in line.name]
    assert [line.frequency for line in whirl] == [150.0, 300.0, 450.0, 600.0]
