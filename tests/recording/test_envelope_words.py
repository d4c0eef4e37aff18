"""Names of an envelope's lines and what it says in words: signals of known strokes, and a 6205 that runs."""

from dataclasses import replace

import numpy as np
import pytest

from fmu_bearing import measure, record
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.recording.measurements.envelope_lines import lines_of
from fmu_bearing.recording.measurements.envelope_words import STROKES, doubt, verdict
from fmu_bearing.scene.read import read_scene
from tests.conftest import EXAMPLES

RATE = 51_200.0
#: Of a 6205 at 1,797 r/min, in Hz, and what the frequency of its cage may be off.
MOTOR = KinematicFrequencies(29.95, 11.93, 70.59, 9 * (29.95 - 11.93), 9 * 11.93)
SLIP, RPM = 0.015, 1797.0


def shaken(period=None, swell=0.0, load=0.0, by=MOTOR.f_r, seconds=1.0):
    """Envelope of noise that swells at f_o, with strokes ``period`` (s) apart through a mode of 5 kHz.

    ``load``: share of their height that turns with ``by`` (Hz).
    """
    time = np.arange(round(seconds * RATE)) / RATE
    power = 1.0 + swell * np.cos(2.0 * np.pi * MOTOR.f_o * time)
    signal = 0.2 * np.sqrt(power) * np.random.default_rng(5).normal(size=time.size)
    for at in np.arange(0.003, seconds, period) if period else ():
        after = time[time >= at] - at
        height = 1.0 + load * np.cos(2.0 * np.pi * by * at)
        signal[time >= at] += (
            height * np.exp(-0.05 * 2.0 * np.pi * 5e3 * after) * np.sin(2.0 * np.pi * 5e3 * after)
        )
    found = measure.envelope(signal, RATE, (3000.0, 7000.0))
    return replace(found, lines=tuple(lines_of(found, MOTOR, "", {}, SLIP)))


def test_ten_multiples_of_a_slipping_cage_have_their_names_and_no_sum_takes_one():
    """Balls pass 1 % too slowly: 10 f_o is 11 resolutions away, and 4 f_o close to 6 f_b + f_c."""
    found = shaken(1.0 / (0.99 * MOTOR.f_o))
    names = {line.name: line for line in found.far()}
    assert set(names) == {"f_o", *(f"{n} f_o" for n in range(2, 11))}
    # a summit between bins of a quarter of 1 Hz is found within half of one
    assert all(line.found == pytest.approx(0.99 * line.frequency, abs=0.125) for line in names.values())
    assert verdict(found).startswith("outer race: f_o ")
    assert f"with 2 f_o, 3 f_o to 10 f_o; kurtosis {found.kurtosis:.0f}: strokes" in verdict(found)
    assert doubt(found, RPM, False) == ""


def test_side_bands_are_those_of_the_load():
    found = shaken(1.0 / MOTOR.f_i, load=1.0)
    names = [line.name for line in found.far()]
    assert {"f_i", "f_i - f_r", "f_i + f_r", "f_r", "2 f_i", "3 f_i - f_r"} <= set(names)
    assert not any("f_o" in name or "f_b" in name for name in names)
    assert "and side bands at f_r" in verdict(found) and verdict(found).startswith("inner race: f_i ")


def test_a_ball_turns_with_the_cage_through_the_load():
    """Of a ball that spins 0.6 % faster than the mean of all the multiples go on where the first one is."""
    found = shaken(1.0 / (1.006 * 2.0 * MOTOR.f_b), load=0.9, by=MOTOR.f_c)
    names = {line.name: line.found for line in found.far()}
    assert {"2 f_b", "4 f_b", "6 f_b", "2 f_b - f_c", "2 f_b + f_c", "4 f_b + f_c"} <= set(names)
    assert names["6 f_b"] == pytest.approx(1.006 * 6.0 * MOTOR.f_b, abs=0.125)
    assert verdict(found).startswith("ball: 2 f_b ") and "and side bands at f_c" in verdict(found)


def test_a_name_needs_the_line_within_a_resolution():
    """3 Hz beside 3 f_i - f_r is no line of the bearing, within 1.5 % or not."""
    time = np.arange(51_200) / RATE
    at = 3.0 * MOTOR.f_i - MOTOR.f_r + 3.0
    swell = np.cos(2.0 * np.pi * at * time) + np.cos(2.0 * np.pi * 3.0 * MOTOR.f_i * time)
    found = measure.envelope((4.0 + swell) * np.sin(2.0 * np.pi * 5e3 * time), RATE, (4000.0, 6000.0))
    named = replace(found, lines=tuple(lines_of(found, MOTOR, "", {}, SLIP))).far()
    # nor is 6 f_i, which the square of the swell has, but without f_i
    assert [line.name for line in named] == ["3 f_i"]


def test_another_speed_is_asked_about():
    """Strokes of the outer race at a speed 2.7 % lower than that of the scene."""
    found = shaken(1.0 / (0.973 * MOTOR.f_o))
    words = doubt(found, RPM, False)
    assert words.startswith(f"the highest line, {0.973 * MOTOR.f_o:.1f} Hz (1")
    assert words.endswith("% of the mean), is none of the bearing's at 1797 r/min; is the speed right?")
    assert doubt(found, RPM, True).endswith("is none of the bearing's at 1797 r/min")
    assert verdict(found).startswith("nothing named: kurtosis")
    # in 0.3 s the first line is within a resolution, and the tenth shows how far it is off
    short = shaken(1.0 / (0.973 * MOTOR.f_o), seconds=0.3)
    assert "10 f_o" in {line.name for line in short.far()}
    assert doubt(short, RPM, False) == (
        "10 f_o is 2.7 % below that at 1797 r/min, more than cages slip; is the speed right?"
    )
    assert doubt(short, RPM, True) == ""


def test_noise_and_waves_are_no_strokes():
    """Noise whose power swells from nothing to twice its mean has a kurtosis of 3 x 1.5."""
    for swell, words in ((0.0, "nothing named, and no strokes: "), (1.0, "no strokes: ")):
        found = shaken(swell=swell)
        # 8,000 independent numbers in the band of 4 kHz: 0.1; four standard deviations of the larger
        assert found.kurtosis == pytest.approx(3.0 * (1.0 + 0.5 * swell**2), abs=0.5)
        calm = replace(found, kurtosis=min(found.kurtosis, STROKES - 0.1))
        assert verdict(calm).startswith(words) and "is that of noise" in verdict(calm)
    assert "may be waviness" in verdict(calm)
    # sharp, but with one line alone: a swell, whatever makes the kurtosis
    assert "f_o (" in verdict(replace(found, kurtosis=9.0)) and "no multiples" in verdict(
        replace(found, kurtosis=9.0)
    )
    assert "steady tones" in verdict(replace(found, kurtosis=1.6))
    assert verdict(replace(found, lines=())) == doubt(replace(found, lines=()), RPM, False) == ""


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("on", "words"),
    [
        (None, ""), ("outer", "outer race (defect 1): f_o "), ("inner", "inner race (defect 1): f_i "),
    ],
)  # fmt: skip
def test_a_6205_says_what_strikes(on, words):
    """In the band of 2 to 10 kHz of docs/learn/spall.md, and in that of a kurtogram."""
    scene = read_scene(EXAMPLES / "6205-outer-spall.toml")
    spall = {"on": on, "shape": "spall", "length_mm": 1.2, "width_mm": 3.0, "depth_um": 100.0}
    spall |= {"angle_deg": 180.0} if on == "outer" else {}
    scene = scene.replace({"imperfections.defect": [spall] if on else []})
    made = record(scene, 0.5, settle=0.05, radiation_model="compact", progress=False, warn=False)
    for band in ((2000.0, 10_000.0), None):
        found = measure.envelope_of(made, "outer_ring.acceleration.z", band)
        said = verdict(found)
        if on:
            assert said.startswith(words) and said.endswith(": strokes"), said
        else:
            # balls that come into the load strike; multiples of no race are in it
            assert said.startswith(("nothing named", "no strokes")), said
        assert doubt(found, RPM, made.turning_known) == ""
