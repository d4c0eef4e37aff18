"""Level meters beyond the first nine, and third octaves."""

import numpy as np
import pytest
from scipy.signal import sosfreqz

from fmu_bearing.acoustics.filters.weighting import band_centre, band_sections
from fmu_bearing.acoustics.radiation.compact import Air
from fmu_bearing.engine.layout import MO, SD, Z
from fmu_bearing.engine.sound import meter
from tests.acoustics.playback import LARGE, PAPER_POINTS, SMALL, Player, build, lines, raw_time, still

PERIOD = 2048  # raw samples: 100 Hz
QUIET = 10 * np.log10(1e-20 / 4e-10)
# IEC 61260-1, class 1, octave filters: frequency ratio as power of G = 10^0.3, least and most attenuation
# (dB) of the 1995 edition, which is the stricter one; third octaves by the standard's mapping of ratios.
LIMITS = [
    (0.0, -0.3, 0.3), (1 / 8, -0.3, 0.4), (1 / 4, -0.3, 0.6), (3 / 8, -0.3, 1.3), (1 / 2, 2.0, 5.0),
    (1.0, 17.5, np.inf), (2.0, 42.0, np.inf), (3.0, 61.0, np.inf), (4.0, 70.0, np.inf),
]  # fmt: skip


def test_one_meter_per_name():
    assert len(Z.MIC_OUTPUTS) == SD.METERS


def tone(frequency=1000.0, amplitude=1.0, radiators=SMALL):
    motion = still(radiators, PERIOD)
    motion[:, 16] = amplitude * np.cos(2 * np.pi * frequency * raw_time(PERIOD))
    return motion


def pascal(ps):
    """Acceleration that makes 1 Pa rms at 1 kHz at the first microphone."""
    return np.sqrt(2) / abs(lines(Player(ps).play(tone(), 41 * PERIOD)[:, 0], [1000.0])[0])


def test_calibrator_on_all_meters():
    """1 Pa at 1 kHz: 93.98 dB and dB(A) everywhere, and in the 1 kHz band; its neighbours as the standard."""
    ps = build("compact", SMALL, Air(), PAPER_POINTS, thirds=True)
    player = Player(ps, metering_start=0.3)
    player.play(tone(amplitude=pascal(ps)), int(1.5 * SD.RAW_RATE))
    names = ("spl", "spl_a", "leq", "leq_a", "spl_fast", "spl_fast_a", "spl_slow", "spl_slow_a")
    for name in (*names, "spl_energy_sum", "spl_radial", "spl_outer_ring"):
        assert player.reading(name) == pytest.approx(93.979, abs=0.02), name
    for name in ("spl_axial", "spl_rotation", "spl_flexure", "spl_balls"):
        assert player.reading(name) == pytest.approx(QUIET), name
    bands = dict(zip(Z.BANDS, player.z[4 * SD.METERS : 4 * SD.METERS + len(Z.BANDS)], strict=True))
    assert bands[1000.0] == pytest.approx(93.979, abs=0.02)
    # the next band's middle is a ratio of 10^0.1 away, between the standard's points 17.5 and 42 dB
    for neighbour, least in ((800.0, 17.0), (1250.0, 17.0), (500.0, 42.0), (2000.0, 42.0), (250.0, 61.0)):
        assert bands[neighbour] < 93.979 - least, neighbour


@pytest.mark.parametrize(("frequency", "weighting"), [(100.0, -19.1), (1000.0, 0.0), (10_000.0, -2.5)])
def test_equivalent_level_of_a_tone_is_weighted_by_the_standards_table(frequency, weighting):
    """IEC 61672-1:2013, table 3, of the frequencies whose nominal value is the exact one.

    0.05 dB of rounding in the table, 0.06 dB of the filter.
    """
    player = Player(build("compact", SMALL, Air(), PAPER_POINTS[:1]), metering_start=0.3)
    player.play(tone(frequency), int(0.5 * SD.RAW_RATE))
    assert player.reading("leq_a") - player.reading("leq") == pytest.approx(weighting, abs=0.11)


@pytest.mark.parametrize("nominal", Z.BANDS)
def test_third_octaves_keep_class_1(nominal):
    """Every band at the standard's break points, up to 25 kHz where sampling ends."""
    middle, edge = band_centre(nominal), 10**0.05
    sections = band_sections(SD.RATE, nominal)
    for power, least, most in LIMITS:
        octave = 10 ** (0.3 * power)
        ratio = 1.0 + (edge - 1.0) / (np.sqrt(10**0.3) - 1.0) * (octave - 1.0)
        for frequency in (middle * ratio, middle / ratio):
            if frequency < 25_000.0:
                gain = abs(sosfreqz(sections, [frequency], fs=SD.RATE)[1][0])
                attenuation = -20 * np.log10(max(gain, 1e-12))
                assert least - 1e-6 <= attenuation <= most + 1e-6, (frequency, attenuation)


def test_bands_are_those_of_the_standard():
    assert [round(band_centre(n), 2) for n in (25.0, 31.5, 1000.0, 16_000.0)] == [
        25.12, 31.62, 1000.0, 15848.93,
    ]  # fmt: skip
    assert len(Z.BANDS) == 29


def test_fast_and_slow_decay_at_their_rates():
    """IEC 61672-1: 34.7 and 4.3 dB/s after a sound has stopped, whatever the chosen weighting is."""
    ps = build("compact", SMALL, Air(), PAPER_POINTS[:1])
    player = Player(ps, time_weighting=0.4)
    player.play(tone(amplitude=pascal(ps)), int(0.5 * SD.RAW_RATE))
    player.play(still(SMALL, 4), int(0.1 * SD.RAW_RATE))
    before = {name: player.reading(name) for name in ("spl_fast", "spl_slow", "spl")}
    player.play(still(SMALL, 4), int(0.2 * SD.RAW_RATE))
    fall = {name: (level - player.reading(name)) / 0.2 for name, level in before.items()}
    assert fall["spl_fast"] == pytest.approx(10 / np.log(10) / 0.125, rel=0.02)
    # these two still gather weight: the mean falls by as much more slowly as the weights' sum grows
    for name, constant, since in (("spl_slow", 1.0, 0.6), ("spl", 0.4, 0.6)):
        grown = (1 - np.exp(-(since + 0.2) / constant)) / (1 - np.exp(-since / constant))
        expected = 10 / np.log(10) / constant + 10 * np.log10(grown) / 0.2
        assert fall[name] == pytest.approx(expected, rel=0.02), name


@pytest.mark.parametrize("model", ["compact", "paper_vector"])
def test_energy_sum_beside_the_coherent_one(model):
    """Two bodies driven against each other with equal sound: silence, and by eq. 46 each plus 3 dB."""
    ps = build(model, SMALL, Air(), PAPER_POINTS[:1])
    levels = {}
    for body in (0, 1):
        player = Player(ps)
        motion = still(SMALL, PERIOD)
        motion[:, 12 * body + 4] = 1000 * np.sin(2 * np.pi * 200 * raw_time(PERIOD))
        pressure = player.play(motion, 41 * PERIOD)[:, 0]
        levels[body] = lines(pressure, [200.0])[0]
    motion = still(SMALL, PERIOD)
    t = raw_time(PERIOD)
    ratio = -levels[0] / levels[1]
    motion[:, 4] = 1000 * np.sin(2 * np.pi * 200 * t)
    motion[:, 16] = 1000 * np.imag(ratio * np.exp(2j * np.pi * 200 * t))
    player = Player(ps, metering_start=0.3)
    player.play(motion, 41 * PERIOD)
    one = player.reading("spl_inner_ring")
    assert player.reading("spl_outer_ring") == pytest.approx(one, abs=0.01)
    assert player.reading("spl_energy_sum") == pytest.approx(one + 3.0103, abs=0.01)
    assert player.reading("spl") < one - 60
    assert player.reading("spl_radial") < one - 60  # one kind, metered as one


def test_kinds_are_distinguished():
    ps = build("compact", SMALL, Air(), [(0.05, 0.06, 0.07)])
    place = {"spl_axial": 12 + 3, "spl_radial": 12 + 4, "spl_balls": MO.BALL_ACCELERATION}
    for received, column in place.items():
        motion = still(SMALL, PERIOD)
        motion[:, column] = 1000 * np.sin(2 * np.pi * 1000 * raw_time(PERIOD))
        player = Player(ps)
        player.play(motion, 41 * PERIOD)
        assert player.reading(received) == pytest.approx(player.reading("spl"), abs=1e-6)
        for other in {*place, "spl_rotation", "spl_flexure"} - {received}:
            # axial tones leave the high-pass rest of nothing behind: the floor
            assert player.reading(other) == pytest.approx(QUIET), (received, other)


def test_levels_without_details_cost_nothing_and_read_the_floor():
    plain = build("compact", LARGE, Air(), PAPER_POINTS, details=False)
    player = Player(plain)
    player.play(tone(radiators=LARGE), 20 * PERIOD)
    whole = Player(build("compact", LARGE, Air(), PAPER_POINTS))
    whole.play(tone(radiators=LARGE), 20 * PERIOD)
    for name in Z.MIC_OUTPUTS[:9]:
        assert player.reading(name) == whole.reading(name), name
    for name in Z.MIC_OUTPUTS[9:]:
        assert player.reading(name) == pytest.approx(QUIET), name
    thirds = build("compact", LARGE, Air(), PAPER_POINTS, thirds=True)
    assert thirds[SD.H_STATE] > plain[SD.H_STATE]


def gathered(order, first, by_microphone):
    """A block's head, and a work space with rows of three microphones in the block's own lanes."""
    at = SD.HEAD_SIZE + first
    ps, ws = np.zeros(at + 3), np.zeros(first + 3 * SD.METERS)
    ps[SD.H_MICS], ps[SD.H_AT_ORDER], ps[SD.H_W_METERS] = 3, at, first
    ps[at:] = order
    ws[first:].reshape(SD.METERS, 3)[:, order] = by_microphone
    return ps, ws


def test_rows_of_two_blocks_add_by_microphone_whatever_lanes_each_gives_them():
    rows = np.arange(2.0 * 3 * SD.METERS).reshape(2, SD.METERS, 3)
    rows[1] *= 100.0
    orders = [2, 0, 1], [1, 2, 0]
    first, second = gathered(orders[0], 7, rows[0]), gathered(orders[1], 4, rows[1])
    meter.add(*first, *second, 1)
    assert np.array_equal(first[1][7:].reshape(SD.METERS, 3)[:, orders[0]], rows[0] + rows[1])
    assert np.array_equal(second[1][4:].reshape(SD.METERS, 3)[:, orders[1]], rows[1])


def test_opposite_bodies_of_the_paper_model_do_not_cancel():
    """Eq. 46 is the paper's own law: energies add, and the energy sum is the level."""
    ps = build("paper", SMALL, Air(), PAPER_POINTS[:1])
    motion = still(SMALL, PERIOD)
    motion[:, 3] = 1000 * np.sin(2 * np.pi * 1000 * raw_time(PERIOD))
    motion[:, 15] = -motion[:, 3]
    player = Player(ps)
    player.play(motion, 41 * PERIOD)
    assert player.reading("spl") == player.reading("spl_energy_sum") > player.reading("spl_inner_ring")
    assert player.reading("spl_axial") == pytest.approx(player.reading("spl"), abs=1e-9)
