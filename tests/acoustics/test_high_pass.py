"""The microphones' high-pass: SciPy's Butterworth once settled, and a start that leaves nothing behind."""

import numpy as np
import pytest

from fmu_bearing import record
from fmu_bearing.acoustics.filters.weighting import high_pass_gains
from fmu_bearing.acoustics.radiation.radiators import Air
from fmu_bearing.engine.layout import SD
from fmu_bearing.engine.sound.high_pass import high_pass
from fmu_bearing.scene.imperfections import Harmonic
from fmu_bearing.scene.read import with_fidelity
from tests.acoustics.playback import PAPER_POINTS, SMALL, build, low_limit
from tests.marks import heavy_but


def filtered(signals):
    """Signals at ``RATE``, shape (samples, n), through the kernel."""
    ps = build("compact", SMALL, Air(), PAPER_POINTS[:1])
    n, width = int(ps[SD.H_CHANNELS]), signals.shape[1]
    lanes = ps[int(ps[SD.H_AT_FORMED]) :][:n].astype(int)
    row = int(ps[SD.H_S_CHANNELS])
    ss, x, found = np.zeros(SD.state_size(ps)), np.zeros(n), np.empty_like(signals)
    for count, sample in enumerate(signals):
        x[:width] = sample
        high_pass(ps, ss, x, 0, count)
        assert np.array_equal(ss[row : row + n][lanes], x)
        found[count] = x[:width]
    return found


def test_against_scipy():
    """Through the start and the change to constant gains at 45 ms."""
    signals = np.random.default_rng(3).standard_normal((6000, 3)) + [0.0, 1.0, -100.0]
    found = filtered(signals)
    for k in range(3):
        expected = low_limit(signals[:, k])
        # SciPy's coefficients are rounded: 1e-16 of one is 3e-10 of what they leave of constants
        assert np.max(np.abs(found[:, k] - expected)) < 1e-9 * np.max(np.abs(signals[:, k]))


def test_constants_leave_nothing_whatever_their_size():
    """The balls' centripetal acceleration is 1e5 m/s2: rounding alone remains, 1e-16 of it a sample."""
    found = filtered(np.tile([1.2e5, -3.0], (6000, 1)))
    assert np.max(np.abs(found)) < 1e-9
    assert high_pass_gains(SD.RATE, 5.0)[1] * SD.RATE == pytest.approx(np.sqrt(2) * 2 * np.pi * 5, rel=1e-3)


@pytest.mark.parametrize("frequency", [50.0, 333.3])
@pytest.mark.parametrize("phase", [0.0, 90.0, 200.0])
def test_a_sine_that_begins_at_once_leaves_no_slow_part(frequency, phase):
    """On a constant a thousand times as large: the offset from 20 ms on, and the line itself.

    The weighted mean keeps 2 / (w t)^2 of the sine, at 50 Hz 5 % at 20 ms and 0.8 % at 50 ms; taking the
    first sample for the mean would keep all of it.
    """
    t = np.arange(8192) / SD.RATE
    found = filtered((1000.0 + np.cos(2 * np.pi * frequency * t + np.radians(phase)))[:, None])[:, 0]
    period = SD.RATE / frequency
    for begin in (0.02, 0.05):
        first = round(begin * SD.RATE)
        whole = np.arange(first, first + round(2 * period))
        basis = np.column_stack(
            [np.ones(len(whole)), *(f(2 * np.pi * frequency * t[whole]) for f in (np.cos, np.sin))]
        )
        offset, *line = np.linalg.lstsq(basis, found[whole], rcond=None)[0]
        assert abs(offset) < 2.0 / (2 * np.pi * frequency * begin) ** 2 + 5e-4
        assert 20 * np.log10(np.hypot(*line)) == pytest.approx(0.0, abs=0.1)


@pytest.mark.parametrize("fidelity", heavy_but(["response", "rings", "full"], 1))
def test_order_one_waviness_reads_its_level_at_once(scene, fidelity):
    """The ring whirls at f_r: 50 ms after the start as after half a second, to 0.1 dB.

    When the high-pass took the first sample for the mean, the microphone above read 15 dB more after 50 ms
    (the whirl begins at its largest acceleration upwards), and the one ahead 20 dB in fidelity full.
    """
    bare = with_fidelity(scene("7003C-bare"), model=fidelity)
    whirl = bare.imperfections.model_copy(
        update={"unbalance_um": 0.0, "ball_diameter_spread_nm": 0.0, "outer_race_amplitude_um": 0.0}
        | {"inner_race_amplitude_um": None, "inner_race_harmonic": (Harmonic(order=1, amplitude_um=0.1),)}
    )
    run = record(bare.model_copy(update={"imperfections": whirl}), 0.48, settle=0.02)
    turn = round(SD.RATE * 60.0 / 20_000.0 * 25)  # 25 turns: 75 ms, 3840 samples
    pressure = run.pressure()
    n = np.arange(turn) * (2 * np.pi * 20_000.0 / 60.0 / SD.RATE)
    basis = np.column_stack([np.ones(turn), n / n[-1], np.cos(n), np.sin(n)])
    late = np.linalg.lstsq(basis, pressure[:, -turn:].T, rcond=None)[0]
    line = np.hypot(late[2], late[3])
    for begin in (0, round(0.03 * SD.RATE)):  # 20 and 50 ms after the start
        part = pressure[:, begin : begin + turn]
        found = np.linalg.lstsq(basis, part.T, rcond=None)[0]
        # the slow part against the line that order 1 makes at the sides: 0.1 dB of energy; in fidelity full
        # the cage is still on its way to where weight and film leave it, and 0.17 is measured
        slow = np.hypot(found[0], found[1])
        assert np.max(slow) < (0.25 if fidelity == "full" else 0.1) * line.max()
    if fidelity != "full":  # where the balls' own modes, struck at the start, ring for longer
        levels = [
            10 * np.log10(np.mean(pressure[:3, b : b + turn] ** 2, axis=1)) for b in (0, 1536, -turn - 1)
        ]
        assert levels[0] == pytest.approx(levels[2], abs=0.1)
        assert levels[1] == pytest.approx(levels[2], abs=0.02)
