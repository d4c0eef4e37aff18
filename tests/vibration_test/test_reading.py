"""What the sensor reads of a motion that is known, and of a wave whose motion has a closed form."""

import math

import numpy as np
import pytest

from fmu_bearing import with_fidelity
from fmu_bearing.vibration_test import reading as module
from fmu_bearing.vibration_test.lines import by_order, frequencies, named_lines
from fmu_bearing.vibration_test.reading import Reading, levels, reading, share
from fmu_bearing.vibration_test.rig import STEP, rig
from fmu_bearing.vibration_test.subject import subject

FLAT = {
    "unbalance_um": 0.0, "ball_diameter_spread_nm": 0.0, "inner_race_amplitude_um": 0.0,
    "outer_race_amplitude_um": 0.0, "seed": 1,
}  # fmt: skip


@pytest.fixture
def played(monkeypatch):
    """A reading of given motions: functions of time (s) by variable, m/s; the ball goes round at 12 Hz."""

    def read(**motions):
        time = np.arange(15_001) * STEP

        def run(scene, variables):
            names = {name.replace(".", "_"): name for name in variables}
            assert set(motions) <= set(names)
            found = {name: motions.get(key, np.zeros_like)(time) for key, name in names.items()}
            for part, wave in (("y", np.cos), ("z", np.sin)):
                found[f"ball[1].velocity.{part}"] = wave(2.0 * np.pi * 12.0 * time)
            return found

        monkeypatch.setattr(module, "_run", run)
        return reading(rig(subject("7003C")))

    return read


def line(amplitude, frequency):
    """A line of so many um/s."""
    return lambda time: 1e-6 * amplitude * np.sin(2.0 * np.pi * frequency * time)


def test_energies_of_lines_are_means_over_the_places(played):
    found = played(
        outer_ring_velocity_z=line(10.0, 123.4),
        outer_ring_velocity_y=line(20.0, 1000.7),
        outer_ring_flexure_n2_cosine=line(30.0, 5000.0),
    )
    # rms; a line's square is halved by the mean of cos^2 and sin^2 over three places round the ring.
    # 1e-4: what a Hann window leaks over the edges of the bands
    for low, high, amplitude in ((50, 300, 10.0), (300, 1800, 20.0), (1800, 10_000, 30.0)):
        assert found.rms(low, high) == pytest.approx(0.5 * amplitude, rel=1e-4)
    assert found.frequency[1] == 2.0
    assert found.orbit == pytest.approx(12.0 / 30.0, rel=1e-12)


def test_bending_adds_to_the_motion_of_the_ring(played):
    # order 4 has at 120 and 240 deg the cosine of order 1: the ring moves twice as much
    alone = played(outer_ring_velocity_z=line(10.0, 700.0))
    both = played(outer_ring_velocity_z=line(10.0, 700.0), outer_ring_flexure_n4_cosine=line(10.0, 700.0))
    assert both.rms(300, 1800) == pytest.approx(2.0 * alone.rms(300, 1800), rel=1e-12)
    # order 2 has the opposite sine of order 1 there, and y moves with the opposite sine: 10 + 10
    other = played(outer_ring_velocity_y=line(10.0, 700.0), outer_ring_flexure_n2_sine=line(10.0, 700.0))
    assert other.rms(300, 1800) == pytest.approx(2.0 * alone.rms(300, 1800), rel=1e-12)


def test_a_bin_on_an_edge_lies_in_both_bands():
    frequency = np.arange(0.0, 12.0, 2.0)
    assert share(frequency, 2.0, 6.0).tolist() == [0.0, 0.5, 1.0, 0.5, 0.0, 0.0]
    total = sum(share(frequency, low, low + 3.0) for low in (-1.0, 2.0, 5.0, 8.0))
    assert total == pytest.approx(np.ones(6))
    found = Reading(frequency, np.ones(6), 0.0)
    assert found.rms(2.0, 6.0) == pytest.approx(math.sqrt(2.0))


@pytest.mark.parametrize(
    ("race", "wave", "name"),
    [("inner", 11, "f_i - f_r"), ("inner", 13, "f_i + f_r"), ("outer", 11, "f_o"), ("outer", 25, "2 f_o")],
)
def test_a_wave_moves_the_ring_by_its_height(race, wave, name):
    """A ring that rests on 12 balls follows a wave of order 12 k +- 1: it moves by its amplitude."""
    flaws = FLAT | {f"{race}_race_harmonic": [{"order": wave, "amplitude_um": 0.01}]}
    flaws.pop(f"{race}_race_amplitude_um")
    scene = with_fidelity(subject("7003C").replace({"imperfections": flaws}), model="rings")
    assert scene.imperfections.sources == (f"{race} race",)
    tested = rig(scene, rigid=True)
    found = reading(tested)
    rates = frequencies(tested, found)
    alone = {f"{race} race": found}
    (first, *_) = sorted(
        named_lines(tested, found.frequency, found.energy, alone, rates, 3), key=lambda one: -one.velocity
    )
    middle = {"inner": wave, "outer": 12 * round(wave / 12)}[race]
    assert (first.name, first.wave, first.source) == (name, middle, f"{race} race")
    asked = 2.0 * np.pi * first.frequency * 0.01 / math.sqrt(2.0)
    # 0.955 at f_o and f_i -+ f_r: the ring tilts as well, and the contacts of the other race give way
    assert first.velocity == pytest.approx(0.96 * asked, rel=0.08)
    # all the energy is that wave's
    shares = by_order(tested, found, rates, f"{race} race")
    assert shares.energies.sum(axis=1) == pytest.approx(
        [value**2 for value in levels(tested, found).values()], rel=1e-9
    )
    by_wave = shares.energies.sum(axis=0)
    assert shares.orders[by_wave.argmax()] == middle
    assert by_wave.max() == pytest.approx(by_wave.sum(), rel=0.01)
