"""The decimator and the band limit: against SciPy, their stop bands, and meters against recordings."""

import numpy as np
import pytest
from scipy.signal import sosfilt, upfirdn

from fmu_bearing.acoustics.analysis.field import TAIL, Channels, joined
from fmu_bearing.acoustics.filters.fir import (
    band_limit,
    decimator,
    decimator_response,
    decimator_stages,
    outer_taps,
)
from fmu_bearing.acoustics.filters.weighting import FAST, a_weighting_sections, band_sections, level
from fmu_bearing.acoustics.radiation import sources
from fmu_bearing.acoustics.radiation.effective import ring_volumes
from fmu_bearing.acoustics.radiation.radiators import Air
from fmu_bearing.acoustics.registry import Radiation
from fmu_bearing.engine.layout import MO, SD, STRIDE, Z
from fmu_bearing.engine.sound import radiate
from tests.acoustics.playback import (
    PAPER_POINTS,
    RHO,
    SMALL,
    C,
    Player,
    ball,
    build,
    chain,
    low_limit,
    raw_time,
    still,
)
from tests.marks import heavy_but

BAND, STOP, NYQUIST = 20_000.0, 22_000.0, SD.RATE / 2
#: Rejection of the single filter of 64 taps that the two stages replaced.
BEFORE = 10 ** (-83.1 / 20)


def rows_of(player, motion, samples):
    """Channels at ``RATE`` while a player takes ``samples`` of a motion, shape (rows, channels)."""
    ps, depth, n = player.ps, int(player.ps[SD.H_ROWS]), int(player.ps[SD.H_CHANNELS])
    at = int(ps[SD.H_AT_LANES])
    lanes = ps[at : at + n].astype(int)
    first = int(ps[SD.H_S_CHANNELS])
    found = np.zeros((samples // SD.DECIMATION, n))
    for k in range(len(found)):
        player.play(motion, SD.DECIMATION)
        row = first + k % depth * n
        found[k] = player.ss[row : row + n][lanes]
    return found


@pytest.mark.parametrize("stage", [0, 1])
def test_stages_against_scipy(stage):
    """Sample for sample; 1e-12: forty sums of numbers of order one."""
    taps = decimator_stages()[stage]
    rows, wide, samples = len(taps) + 9, 20, 400
    x = np.random.default_rng(1).standard_normal((samples, wide))
    ps, ring = outer_taps(taps).copy(), np.zeros((rows, wide))
    out = np.zeros(wide)
    expected = np.array([upfirdn(taps, column, 1, SD.HALF) for column in x.T]).T
    for k in range(samples):
        ring[k % rows] = x[k]
        if k % SD.HALF == 0:
            radiate.halve(ps, 0, len(taps), ring.ravel(), 0, rows, k % rows, 1, out)
            assert np.max(np.abs(out - expected[k // SD.HALF])) < 1e-12
        if k % 8 == 6 and k > 8:  # four at once: the same bits
            four = np.zeros(4 * wide)
            radiate.halve(ps, 0, len(taps), ring.ravel(), 0, rows, (k - 6) % rows, 4, four)
            assert np.array_equal(four[3 * wide :], out)
            assert (
                np.max(np.abs(four.reshape(4, wide) - expected[k // SD.HALF - 3 : k // SD.HALF + 1])) < 1e-12
            )


def test_whole_decimator_in_the_stream_against_scipy():
    """From motion to channels: the whole filter over the whole signal, then the high-pass, to 1e-12."""
    samples = 4 * 600
    motion = still(SMALL, samples)
    motion[:, 12 + 4] = np.random.default_rng(2).standard_normal(samples)
    found = rows_of(Player(build("compact", SMALL, Air(), PAPER_POINTS)), motion, samples)
    late = len(decimator()) - 1
    before = np.full(late, motion[0, 12 + 4])  # the first sample lasted for ever
    x = upfirdn(decimator(), np.concatenate([before, motion[:, 12 + 4]]))[
        late : late + samples : SD.DECIMATION
    ]
    assert np.max(np.abs(found[:, SD.c_body(1, 1)] - low_limit(x))) < 1e-12
    assert late == 2 * SD.MIDDLE


def test_what_folds_is_rejected():
    """Whatever folds below 22 kHz when the rate falls to 51.2 kHz; the band is flat to 0.002 dB."""
    received = np.arange(0.0, STOP + 1.0, 20.0)
    for image in (SD.RATE - received, SD.RATE + received, 2 * SD.RATE - received):
        assert np.max(np.abs(decimator_response(image))) < BEFORE
    assert np.max(np.abs(20 * np.log10(np.abs(decimator_response(received))))) < 2e-3


def test_band_limit():
    inside, outside = np.arange(0.0, BAND + 1.0, 10.0), np.arange(STOP, NYQUIST, 10.0)
    assert np.max(np.abs(20 * np.log10(band_limit(inside)))) < 0.01
    assert np.max(np.abs(band_limit(outside))) < 10 ** (-70 / 20)


def test_balls_are_projected_behind_the_decimator_as_before_it():
    """Order 8 at 250 turns/s, tones to 17 kHz, which shift to 19: products first, then the filter, -80 dB."""
    samples = 4 * 3000
    t = raw_time(samples)
    motion = still(SMALL, samples)
    angle = 0.4 + 2 * np.pi * 250.0 * t
    signal = sum(np.cos(2 * np.pi * f * t + f) for f in (900.0, 7300.0, 17_000.0))
    motion[:, MO.COS + 5], motion[:, MO.SIN + 5] = np.cos(angle), np.sin(angle)
    motion[:, ball(5, MO.BALL_ACCELERATION, 2)] = signal
    found = rows_of(Player(build("compact", SMALL, Air(), PAPER_POINTS, 8)), motion, samples)
    for order, axis, turn in ((1, 0, np.cos), (8, 0, np.cos), (8, 1, np.sin)):
        product = signal * turn(order * angle)
        product = np.concatenate([np.full(2 * SD.MIDDLE, product[0]), product])  # as before the first sample
        x = upfirdn(decimator(), product)[2 * SD.MIDDLE : 2 * SD.MIDDLE + samples : SD.DECIMATION]
        expected = low_limit(x)
        error = found[100:, SD.c_ball(order, 2) + axis] - expected[100:]  # past the start, where they differ
        assert np.sqrt(np.mean(error**2) / np.mean(expected[100:] ** 2)) < 1e-4


def test_frequency_response_of_the_whole_path():
    """From the outer ring's acceleration to the pressure: the dipole within -50 dB, and -60 dB by 22 kHz."""
    size, at = 4 * 20_480, 20_000  # the low limit has its final gains before, and has faded behind
    motion = still(SMALL, size)
    motion[at, 12 + 4] = 1.0
    point = (0.0, 0.105, 0.0)
    pressure = Player(build("compact", SMALL, Air(), [point])).play(motion, size)[:, 0]
    # the spectrum of all samples at multiples of 12.5 Hz is that of their sum over whole periods of 12.5 Hz
    period = round(SD.RATE / 12.5)
    frequency = 12.5 * np.arange(8, period // 2)
    spectrum = np.fft.rfft(pressure.reshape(-1, period).sum(0))[8 : period // 2]
    # an impulse of one raw sample holds a fourth of what a tone's samples at RATE hold
    found = spectrum * np.exp(2j * np.pi * frequency * at / SD.RAW_RATE) * SD.DECIMATION
    inside = frequency <= BAND
    volume = ring_volumes(SMALL.outer_ring.outer, SMALL.outer_ring.inner, SMALL.outer_ring.width)[0]
    dipole = sources.compact_dipole(frequency, 0.105, -1.0, volume, RHO, C) * chain(frequency)
    error = np.abs(np.abs(found) - np.abs(dipole)) / np.abs(dipole)
    assert 20 * np.log10(error[inside].max()) < -50
    edge = np.abs(dipole[inside][-1])
    assert 20 * np.log10(np.abs(found[frequency >= STOP]).max() / edge) < -60


@pytest.mark.heavy
@pytest.mark.parametrize("kind", ["noise", "lines"])
@pytest.mark.parametrize("model", heavy_but(["compact", "paper_vector", "paper_contacts"], "compact"))
def test_meters_and_recordings_hear_the_same(model, kind):
    """Up to 100 kHz in every coordinate: 0.05 dB in Leq, LAeq and the third octaves."""
    samples = 4 * 12_000
    rng = np.random.default_rng(6)
    if kind == "noise":
        motion = rng.standard_normal((samples, MO.SIZE))
    else:  # 64 lines, half of them above 20 kHz; those from 20 to 25.6 kHz reached meters alone
        frequencies = np.concatenate([np.geomspace(100.0, 19_000.0, 32), np.linspace(20_500.0, 1e5, 32)])
        turns = np.exp(2j * np.pi * np.outer(raw_time(samples), frequencies))
        phases = np.exp(2j * np.pi * rng.uniform(size=(len(frequencies), MO.SIZE)))
        motion = np.ascontiguousarray((turns @ phases).real)
    motion[:, MO.COS : MO.FLEXURES] = still(SMALL, 1)[:, MO.COS : MO.FLEXURES]
    for row in range(MO.BALL_VELOCITY, MO.COS, STRIDE):
        motion[:, row + SMALL.ball_count : row + STRIDE] = 0.0  # spare lanes
    begin = 1000
    ps = build(model, SMALL, Air(), PAPER_POINTS, 4, details=False, thirds=True)
    player = Player(ps, metering_start=begin / SD.RATE)
    history = rows_of(player, motion, samples)
    last = len(history) - TAIL
    received = np.zeros((len(PAPER_POINTS), len(history)))
    for circle in joined([(Radiation(model, SMALL, Air(), 4), PAPER_POINTS)]):
        received[list(circle.members)] = Channels(history).pressures(circle)[""]
    again = Player(ps, metering_start=begin / SD.RATE)
    again.play(motion, 4 * (last + SD.LATENCY))
    weighted = sosfilt(a_weighting_sections(SD.RATE), received)
    span = slice(begin - SD.LATENCY, last)
    bands = np.array([sosfilt(band_sections(SD.RATE, band), received)[:, span] for band in Z.BANDS])
    weights = np.exp(-np.arange(last - begin + SD.LATENCY)[::-1] / (SD.RATE * FAST))
    expected = level(np.average(bands**2, axis=2, weights=weights)).T
    read = again.z[len(PAPER_POINTS) * len(Z.MIC_OUTPUTS) :].reshape(len(PAPER_POINTS), len(Z.BANDS))
    for mic in range(len(PAPER_POINTS)):
        for name, signal in (("leq", received[mic]), ("leq_a", weighted[mic])):
            found = float(level(np.mean(signal[span] ** 2)))
            assert again.reading(name, mic) == pytest.approx(found, abs=0.05), (name, mic)
        counted = expected[mic] > expected[mic].max() - 50.0  # dB; far below, filters remember the start
        assert counted.sum() > 10
        assert read[mic][counted] == pytest.approx(expected[mic][counted], abs=0.05), mic
