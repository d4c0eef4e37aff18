"""Sound as a sum of lines: transfer functions, filters' gains, mean squares and beats, by closed forms."""

import numpy as np
import pytest
from scipy import signal

from fmu_bearing.acoustics.filters.design import line_parameters, radiation_of
from fmu_bearing.acoustics.filters.fir import band_limit
from fmu_bearing.acoustics.filters.pack import MICROPHONE_LOW_LIMIT
from fmu_bearing.acoustics.filters.weighting import a_weighting_sections, band_sections
from fmu_bearing.acoustics.radiation.frequencies import fit_frequencies, interpolated_response
from fmu_bearing.engine.layout import SD, SL, Z
from fmu_bearing.engine.sound import beats
from fmu_bearing.engine.sound.transfer import add_channel, bound, clear_channels, radiate, write_gains

OMEGA = 2 * np.pi * np.array([3.0, 40.0, 812.3, 3456.7, -3456.7, 12_345.6, 20_900.0])


@pytest.fixture(scope="module")
def block(scene):
    """A scene with four microphones, two of them on one circle, its block of lines, state and work space."""
    one = scene("7003C-bare").replace({"sound.radiation_model": "compact", "sound.third_octaves": True})
    ps = line_parameters(one)
    return one, ps, np.zeros(int(ps[SD.H_STATE])), np.zeros(int(ps[SD.H_WORK]))


def rows_of(ps, ws, at, count):
    """Complex rows of microphones at ``ws[at:]``, in the scene's order."""
    n = int(ps[SD.H_MICS])
    order = ps[int(ps[SD.H_AT_ORDER]) :][:n].astype(int)
    parts = ws[at : at + 2 * count * n].reshape(2, count, n)[:, :, order]
    return parts[0] + 1j * parts[1]


@pytest.mark.parametrize("omega", OMEGA)
def test_pressures_are_those_of_the_paths(block, omega):
    """Random channels through every path, by a spline over all frequencies.

    Between nodes the cubic is that spline's, but for the product with the band limit: 4e-8 of the sum of
    magnitudes between 20 and 22 kHz, 8e-9 below (measured).
    """
    scene, ps, _, ws = block
    radiation = radiation_of(scene)
    positions = [place for _, place in scene.microphones]
    rng = np.random.default_rng(3)
    channels = rng.normal(size=radiation.channels) + 1j * rng.normal(size=radiation.channels)
    clear_channels(ps, ws)
    for channel, value in enumerate(channels):
        add_channel(ps, ws, channel, complex(value))
    assert radiate(ps, ws, omega)
    assert beats.weight_of_rows(ps, ws) < bound(ps, ws, omega) ** 2
    found = rows_of(ps, ws, int(ps[SD.H_W_ROWS]), SL.ROW_ALONE)
    hertz = np.array([abs(omega) / (2 * np.pi)])
    b, a = signal.butter(2, MICROPHONE_LOW_LIMIT, "high", fs=SD.RATE)
    limit = band_limit(hertz) * signal.freqz(b, a, hertz, fs=SD.RATE)[1]
    exact = np.zeros_like(found)
    size = 0.0
    for members in radiation.circles(positions):
        for path in radiation.paths(positions, members):
            response = (limit * interpolated_response(fit_frequencies(), path.response, path.flight, hertz))[
                0
            ]
            sound = (response if omega > 0.0 else response.conj()) * channels[path.channel] * path.weights
            rows = [SL.ROW_TOTAL, SL.ROW_PART + path.component, SL.ROW_KIND + path.kind]
            for row in rows[: 3 if path.kind != SD.BALLS_KIND else 2]:
                exact[row, members] += sound
            size += np.abs(sound).max()
    np.testing.assert_allclose(found, exact, rtol=0, atol=1e-7 * size)


def test_beyond_the_band_there_is_silence(block):
    _, ps, _, ws = block
    assert not radiate(ps, ws, 2 * np.pi * 22_000.0)


@pytest.mark.parametrize("hertz", [31.5, 1000.0, 15_000.0])
def test_gains_are_those_of_the_filters(block, hertz):
    _, ps, _, ws = block
    write_gains(ps, ws, int(ps[SD.H_W_GAINS]), 2 * np.pi * hertz)
    sections = [a_weighting_sections(SD.RATE), *(band_sections(SD.RATE, nominal) for nominal in Z.BANDS)]
    exact = [np.abs(signal.sosfreqz(one, [hertz], fs=SD.RATE)[1][0]) ** 2 for one in sections]
    found = ws[int(ps[SD.H_W_GAINS]) :][: len(exact)]
    np.testing.assert_allclose(found, exact, rtol=1e-6, atol=1e-12)


def write(block, hertz, pressures, member=0.0):
    """Put lines of these frequencies and pressures (lines, microphones) to state and work space."""
    _, ps, ss, ws = block
    n, size = int(ps[SD.H_MICS]), beats.line_size(ps)
    ss[:] = 0.0
    ss[SD.SS_LINES] = len(hertz)
    table = ss[int(ps[SD.H_S_LINES]) :][: len(hertz) * size].reshape(-1, size)
    table[:, SL.LINE_BALL] = np.arange(len(hertz)) + 1.0  # every pair turns in its own way
    table[:, SL.LINE_SHAFT] = np.arange(len(hertz)) ** 2
    table[:, SL.LINE_MEMBER] = member
    parts = ws[int(ps[SD.H_W_PARTS]) :][: len(hertz) * beats.part_size(ps)].reshape(len(hertz), 2, -1, n)
    parts[:] = 0.0
    for row in (SL.ROW_TOTAL, SL.ROW_PART):
        parts[:, 0, row], parts[:, 1, row] = pressures.real, pressures.imag
    ws[int(ps[SD.H_W_INDEX]) :][: len(hertz)] = 2 * np.pi * np.asarray(hertz)


def beating(block):
    """Four clusters of close lines: frequencies (Hz) and complex pressures, settled in the block."""
    ps = block[1]
    rng = np.random.default_rng(11)
    hertz = np.concatenate([f + np.array([0.0, 0.4, 3.1, 9.7]) for f in (900.0, 2500.0, 6200.0, 9900.0)])
    shape = len(hertz), int(ps[SD.H_MICS])
    pressures = (rng.normal(size=shape) + 1j * rng.normal(size=shape)) * rng.uniform(0.2, 1.0, shape)
    order = rng.permutation(len(hertz))
    write(block, hertz[order], pressures[order])
    beats.settle_lines(*block[1:])
    beats.renew_means(*block[1:])
    return hertz[order], pressures[order]


def step(block, hertz, begin, h, tau):
    """Move the meters over one step from the time ``begin`` (s) on."""
    _, ps, ss, ws = block
    wide = beats.beat_size(ps)
    table = ss[int(ps[SD.H_S_BEATS]) :][: int(ss[SD.SS_BEATS]) * wide].reshape(-1, wide)
    lines = {(k + 1.0, float(k**2)): f for k, f in enumerate(hertz)}
    pairs = {(a[0] - b[0], a[1] - b[1]): lines[a] - lines[b] for a in lines for b in lines if a != b}
    rates = [2 * np.pi * pairs[row[SL.BEAT_BALL], row[SL.BEAT_SHAFT]] for row in table]
    turns = int(ps[SD.H_W_TURNS])
    for place, time in ((SL.TURN_BEGIN, begin), (SL.TURN_END, begin + h)):
        ws[turns + place :][: len(rates)] = np.array(rates) * time
    beats.turn_beats(ps, ss, ws, h)
    beats.follow(ps, ss, ws, h, tau)


@pytest.mark.heavy
def test_meters_follow_beats_as_samples_do(block):
    """Against exponential averages of the samples of the sum: ripple of the clusters' distance is left."""
    hertz, pressures = beating(block)
    _, ps, ss, _ = block
    n = int(ps[SD.H_MICS])
    assert ss[SD.SS_BEATS] == 4 * 6
    h, tau, count = 1e-3, 0.125, 700
    rate = 51_200
    time = np.arange(1, round(count * h * rate) + 1) / rate
    sound = (pressures[:, :, None] * np.exp(2j * np.pi * hertz[:, None, None] * time)).real.sum(0)
    fraction = 1 - np.exp(-1 / (rate * tau))
    mean = signal.lfilter([fraction], [1, fraction - 1], sound**2)
    found = []
    for k in range(count):
        step(block, hertz, k * h, h, tau)
        found.append(ss[int(ps[SD.H_S_METERS]) + SD.M_LEVEL * n :][:n].copy())
    exact = mean[:, np.round(np.arange(1, count + 1) * h * rate).astype(int) - 1].T
    levels = 10 * np.log10(exact[100:])
    assert np.ptp(levels, axis=0).min() > 1.0  # the beats are there
    assert np.abs(10 * np.log10(np.array(found)[100:]) - levels).max() < 0.02
    sums = ss[int(ps[SD.H_S_METERS]) + SD.M_SUM * n :][:n]
    np.testing.assert_allclose(sums / ss[SD.SS_METERED], (sound**2).mean(1), rtol=2e-3)


@pytest.mark.heavy
def test_steps_do_not_matter_to_meters(block):
    hertz, _ = beating(block)
    _, ps, ss, _ = block
    meters = slice(int(ps[SD.H_S_METERS]), int(ps[SD.H_S_LINES]))
    found = []
    for count in (1, 40):
        ss[: SD.SS_LINES], ss[meters] = 0.0, 0.0
        for k in range(count):
            step(block, hertz, 0.08 * k / count, 0.08 / count, 1.0)
        found.append(ss[meters].copy())
    assert found[0].max() > 0.1
    np.testing.assert_allclose(found[0], found[1], rtol=0, atol=1e-9 * found[0].max())


@pytest.mark.heavy
def test_lines_beyond_the_reach_do_not_beat(block):
    write(block, [1000.0, 1000.0 + 1.01 * SL.REACH / (2 * np.pi)], np.ones((2, int(block[1][SD.H_MICS]))))
    beats.settle_lines(*block[1:])
    beats.renew_means(*block[1:])
    assert block[2][SD.SS_BEATS] == 0


def test_lines_are_sorted(block):
    _, ps, _, ws = block
    hertz = np.random.default_rng(2).permutation(700) + 1.0
    ws[int(ps[SD.H_W_INDEX]) :][: len(hertz)] = hertz
    beats.sort_lines(ps, ws, len(hertz))
    order = ws[int(ps[SD.H_W_INDEX]) + SL.INDEX_SORTED * int(ps[SD.H_LINES]) :][: len(hertz)].astype(int)
    np.testing.assert_array_equal(hertz[order], np.arange(700) + 1.0)


def test_weak_lines_are_left_out_and_backward_ones_turned(block):
    """A line that turns backwards is the conjugate of one forwards."""
    _, ps, ss, ws = block
    n = int(ps[SD.H_MICS])
    pressures = np.array([1.0 + 2.0j, 1e-6, 0.5j])[:, None] * np.ones(n)
    write(block, [500.0, 700.0, -900.0], pressures)
    assert beats.settle_lines(ps, ss, ws) == 2
    size = beats.line_size(ps)
    table = ss[int(ps[SD.H_S_LINES]) :][: 2 * size].reshape(2, size)
    np.testing.assert_array_equal(table[:, SL.LINE_BALL], [1.0, -3.0])
    found = table[:, SL.LINE_PRESSURE :][:, :n] + 1j * table[:, SL.LINE_PRESSURE + n :]
    np.testing.assert_array_equal(found, np.array([1.0 + 2.0j, -0.5j])[:, None] * np.ones(n))
