"""Squared envelopes of a 6205 with a defect: the lines of kinematics, side bands, place and preload.

Frequencies are those of the run: the cage of a radially loaded bearing is some 1 % off its kinematic speed.
"""

from dataclasses import dataclass
from functools import cache

import numpy as np
import pytest
from scipy.signal import hilbert

from fmu_bearing.engine.constants import RPM
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from tests.engine.deep_groove import deep_groove

SPEED, BALLS, CLEARANCE = 1797.0, 9, 12.0  # r/min, -, um
SAMPLE, WARM_UP, DURATION = 4e-5, 0.05, 0.6  # s: a run starts at the rest of a bearing without defect
BAND = 1e3, 1e4  # Hz: modes of the rings; above what balls do as they pass, below half the sampling rate
#: A pit of 0.021 inch, for which neither its depth counts nor, in the lines, how loud it is.
PIT = {"shape": "pit", "length_mm": 0.533, "depth_um": 280.0}
NEAR = 1  # bins: a line lies within one of its frequency
NO_IMPERFECTIONS = {
    "unbalance_um": 0.0, "ball_diameter_spread_nm": 0.0, "inner_race_amplitude_um": 0.0,
    "outer_race_amplitude_um": 0.0, "waviness_exponent": 1.0,
}  # fmt: skip
FIDELITIES = ("full", "rings")
TEN = 10**-0.5  # -10 dB, by 20 log: as `recording.measurements` counts lines of a squared envelope
pytestmark = pytest.mark.heavy  # tables of elastic contacts take a minute


@dataclass(frozen=True)
class Envelope:
    """Squared envelope of the outer ring's acceleration along the load.

    ``lines``: its amplitudes (m2/s4), ``bin`` (Hz) apart; ``cage``: mean speed of the cage (Hz).
    """

    lines: np.ndarray
    bin: float
    cage: float

    def strongest(self, frequency, within):
        """Frequency of the strongest line at most ``within`` (Hz) off."""
        first, last = (round((frequency + side * within) / self.bin) for side in (-1, 1))
        return self.bin * (first + int(np.argmax(self.lines[first : last + 1])))

    def line(self, frequency):
        """Amplitude of the line within a bin of a frequency."""
        at = round(frequency / self.bin)
        return float(self.lines[at - NEAR : at + NEAR + 1].max())


@cache
def envelope(fidelity, radial, axial=0.0, on=None, angle=0.0):
    """Return the envelope under loads (N) downwards and along the axis, with a pit on a race or without."""
    defect = [] if on is None else [PIT | {"on": on, "angle_deg": angle}]
    scene = deep_groove(
        radial, SPEED, CLEARANCE,
        {"mounting.preload_N": axial, "imperfections": NO_IMPERFECTIONS | {"defect": defect}},
    )  # fmt: skip
    bearing = Instance(prepare(scene, fidelity=fidelity))
    bearing.initialise()
    velocity = np.empty(round(DURATION / SAMPLE))
    ratio = np.empty(velocity.size)
    for _ in range(round(WARM_UP / SAMPLE)):
        bearing.step(SAMPLE)
    for k in range(velocity.size):
        bearing.step(SAMPLE)
        velocity[k], ratio[k] = bearing.get("outer_ring.velocity.z"), bearing.get("cage.speed_ratio")
    assert bearing.get("solver.restarts") == 0.0
    # acceleration in the band, as the derivative of the velocity
    spectrum = np.fft.rfft(velocity * np.hanning(velocity.size))
    frequency = np.fft.rfftfreq(velocity.size, SAMPLE)
    spectrum[(frequency < BAND[0]) | (frequency > BAND[1])] = 0.0
    acceleration = np.fft.irfft(2j * np.pi * frequency * spectrum, velocity.size)
    lines = np.abs(np.fft.rfft(np.abs(hilbert(acceleration)) ** 2)) / velocity.size
    return Envelope(lines, 1.0 / DURATION, float(ratio.mean()) * SPEED * RPM / (2.0 * np.pi))


def passing(found, on):
    """Frequency (Hz) at which balls pass a defect on a race, at the cage's speed in the run."""
    shaft = SPEED / 60.0
    return BALLS * (found.cage if on == "outer" else shaft - found.cage)


@pytest.mark.parametrize("fidelity", FIDELITIES)
@pytest.mark.parametrize(("on", "angle"), [("outer", 180.0), ("inner", 0.0)])
def test_a_line_where_balls_pass_the_defect(fidelity, on, angle):
    found, healthy = envelope(fidelity, 300.0, on=on, angle=angle), envelope(fidelity, 300.0)
    frequency = passing(found, on)
    assert abs(found.strongest(frequency, 10.0) - frequency) <= found.bin
    assert TEN * TEN * found.line(frequency) > healthy.line(frequency)


def side_bands(fidelity, axial):
    """Mean of the lines a turn of the shaft beside that of an inner defect over this one."""
    found = envelope(fidelity, 80.0, axial, "inner")
    frequency, shaft = passing(found, "inner"), SPEED / 60.0
    beside = 0.5 * (found.line(frequency - shaft) + found.line(frequency + shaft))
    return beside / found.line(frequency)


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_side_bands_of_an_inner_defect_fall_with_preload(fidelity):
    radial, light, heavy = (side_bands(fidelity, axial) for axial in (0.0, 50.0, 150.0))
    assert 0.9 < radial < 1.0
    assert radial > 1.5 * light > 1.5 * 1.1 * heavy


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_a_defect_of_the_outer_race_is_loud_where_the_load_is(fidelity):
    """12 o'clock over 6 o'clock, at axial loads of 0, 150 and 300 N beside 300 N across.

    In `full` a ball that nothing presses bounces in the pit: 0.11 without axial load, where rings has 3e-5.
    From the first load that holds the balls above on, 150 N, what they do there grows with it in both.
    """
    lines = {
        (axial, angle): found.line(passing(found, "outer"))
        for axial in (0.0, 150.0, 300.0)
        for angle in (0.0, 180.0)
        for found in (envelope(fidelity, 300.0, axial, "outer", angle),)
    }
    none, some, more = (lines[axial, 0.0] / lines[axial, 180.0] for axial in (0.0, 150.0, 300.0))
    assert none < TEN
    assert more > 2.0 * some > 2.0 * none
    assert lines[300.0, 0.0] > 1.5 * lines[150.0, 0.0]


@pytest.mark.parametrize(("length", "axial", "rpm"), [(0.356, 30.0, 1797.0), (0.533, 100.0, 6000.0)])
def test_rings_shakes_as_full_does(length, axial, rpm):
    """Found 1.10 and 1.12: rms acceleration of the outer ring along the load, up to 12.5 kHz."""
    defect = [PIT | {"on": "outer", "length_mm": length}]
    scene = deep_groove(
        300.0, rpm, CLEARANCE,
        {"mounting.preload_N": axial, "imperfections": NO_IMPERFECTIONS | {"defect": defect}},
    )  # fmt: skip
    found = []
    for fidelity in FIDELITIES:
        bearing = Instance(prepare(scene, fidelity=fidelity))
        bearing.initialise()
        velocity = []
        for _ in range(round(0.2 / SAMPLE)):
            bearing.step(SAMPLE)
            velocity.append(bearing.get("outer_ring.velocity.z"))
        assert bearing.get("solver.restarts") == 0.0
        found.append(np.diff(velocity[round(WARM_UP / SAMPLE) :]).std() / SAMPLE)
    assert 0.9 < found[1] / found[0] < 1.25
