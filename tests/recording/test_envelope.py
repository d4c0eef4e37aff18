"""Envelope analysis and kurtogram against closed forms, noise, other programs, and a bearing that runs."""

import json
import os
import re
import shlex
import subprocess
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
import scipy

from fmu_bearing import measure, record
from fmu_bearing.recording.measurements.envelope import squared_envelope
from fmu_bearing.recording.measurements.envelope_files import usual_signals
from fmu_bearing.recording.measurements.envelope_lines import EnvelopeLine
from fmu_bearing.results.base import table
from fmu_bearing.scene.read import read_scene, with_fidelity
from tests.conftest import EXAMPLES

OPENCONMO = os.environ.get("FMU_BEARING_OPENCONMO")
RATE = 51_200.0
MODE, ZETA = 6100.0, 0.03
#: What openconmo finds, as JSON: squared envelope's spectrum of the signal, and the best band.
SCRIPT = """
import json, sys
import numpy as np
from openconmo.benchmark_methods import envelope
from openconmo.kurtogram import fast_kurtogram
data = np.load(sys.argv[1])
frequency, lines = envelope(data["signal"], float(data["rate"]))
kurtosis, levels, _, centre, width = fast_kurtogram(data["noisy"].copy(), float(data["rate"]), nlevel=5)
rows = [[level, row.tolist()] for level, row in zip(levels.tolist(), kurtosis)]
print(json.dumps([frequency.tolist(), lines.tolist(), rows, float(centre), float(width)]))
"""


def strokes(period, size, decay=ZETA):
    """Impulses every ``period`` samples that a mode answers, from long before the signal begins."""
    ring = np.arange(4096) / RATE
    answer = np.exp(-2.0 * np.pi * MODE * decay * ring) * np.sin(2.0 * np.pi * MODE * ring)
    train = np.zeros(size + answer.size)
    train[::period] = 1.0
    return np.convolve(train, answer)[answer.size : answer.size + size]


@pytest.mark.parametrize("zeta", [0.01, 0.03])
@pytest.mark.parametrize("period", [400, 640])
def test_impulses_through_a_mode_have_the_lines_of_the_closed_form(period, zeta):
    # a whole number of periods; answers overlap by less than 1e-4 of their height with the larger damping
    found = measure.envelope(strokes(period, 64 * 640 * 2, zeta), RATE, (0.0, RATE / 2))
    time = period / RATE
    slope = np.pi / (zeta * 2.0 * np.pi * MODE * time)
    first = found.at(1.0 / time)[1]
    for k in range(1, 9):
        at, amplitude, _ = found.at(k / time)
        assert at == pytest.approx(k / time, abs=0.05 * found.resolution)
        wanted = np.sqrt((1.0 + slope**2) / (1.0 + (k * slope) ** 2))
        # in answers that overlap, those of other periods beat with this one by 1e-3
        assert amplitude / first == pytest.approx(wanted, rel=0.01)


def test_a_tone_that_swells_has_two_lines():
    time, depth = np.arange(40_000) / RATE, 0.3
    swell = 1.0 + depth * np.cos(2.0 * np.pi * 83.7 * time)
    found = measure.envelope(2.0 * swell * np.sin(2.0 * np.pi * 5000.0 * time), RATE, (4000.0, 6000.0))
    # (1 + m cos)^2 = 1 + m^2/2 + 2 m cos + m^2/2 cos 2; the band-pass takes 1e-3 at the sides
    for times, wanted in ((1, 4.0 * 2.0 * depth), (2, 4.0 * 0.5 * depth**2)):
        at, amplitude, over = found.at(times * 83.7)
        assert at == pytest.approx(times * 83.7, abs=0.02 * found.resolution)
        assert amplitude == pytest.approx(wanted, rel=0.01) and over > 1e3
    assert found.mean == pytest.approx(4.0 * (1.0 + 0.5 * depth**2), rel=0.01)


def test_noise_has_no_line_and_falls_to_the_width_of_its_band():
    noise = np.random.default_rng(1).normal(size=400_000)
    found = measure.envelope(noise, RATE, (4000.0, 12_000.0))
    frequency = np.arange(0.0, RATE / 2, 20.0)
    sections = scipy.signal.butter(4, (4000.0, 12_000.0), "bandpass", fs=RATE, output="sos")
    density = np.abs(scipy.signal.freqz_sos(sections, frequency, fs=RATE)[1]) ** 4  # both ways
    # the density of the squared envelope is that of two noises apart by the frequency
    apart = np.correlate(density, density, "full")[density.size - 1 :]
    levels = []
    for low in np.arange(20.0, 8000.0, 500.0):
        some = found.amplitude[(found.frequency >= low) & (found.frequency < low + 500.0)]
        shape = np.mean(apart[(frequency >= low) & (frequency < low + 500.0)])
        levels.append(np.mean(some**2) / shape)
    # 3,900 independent numbers in each: 1.6 %; four standard deviations
    assert np.array(levels) / np.mean(levels) == pytest.approx(1.0, abs=0.07)
    assert found.kurtosis == pytest.approx(3.0, abs=0.05)
    # Rayleigh: none of 62,000 amplitudes is five times the median but by a chance of 1e-3
    assert found.amplitude.max() < 5.0 * np.median(found.amplitude[found.frequency < 4000.0])


def test_the_band_pass_has_order_four_and_no_phase():
    impulse = np.zeros(20_001)
    impulse[10_000] = 1.0
    values, _ = squared_envelope(impulse, RATE, (3000.0, 5000.0))
    # the constant that is taken from the impulse is 5e-5
    assert values[10_001:] == pytest.approx(values[9_999::-1], abs=1e-6)
    response = np.abs(np.fft.rfft(values))
    frequency = np.fft.rfftfreq(values.size, 1.0 / RATE)
    for at in (3000.0, 5000.0):  # both ways: half of the amplitude at the ends
        assert np.interp(at, frequency, response) == pytest.approx(0.5, abs=0.002)
    # Butterworth: with the bilinear transform's frequencies
    warped = np.tan(np.pi * np.array([2000.0, 3000.0, 5000.0]) / RATE)
    off = (warped[1] * warped[2] - warped[0] ** 2) / (warped[0] * (warped[2] - warped[1]))
    assert np.interp(2000.0, frequency, response) == pytest.approx(1.0 / (1.0 + off**8), rel=0.01)


@pytest.mark.parametrize("loud", [2.0, 3.0])
def test_the_kurtogram_finds_the_band_of_repeated_strokes(loud):
    noise = np.random.default_rng(2).normal(size=51_200)
    found = measure.kurtogram(noise + loud * strokes(640, noise.size), RATE, narrowest=1000.0)
    best = found.best
    assert best.low < MODE < best.high and best.high - best.low < 8600.0
    elsewhere = [band.kurtosis for band in found.bands if band.low > 2.0 * MODE]
    assert best.kurtosis > 1.0 and max(elsewhere) < 0.3 * best.kurtosis
    # the envelope of that band shows what the noise of the whole hides
    shown = measure.envelope(noise + loud * strokes(640, noise.size), RATE, narrowest=1000.0)
    whole = measure.envelope(noise + loud * strokes(640, noise.size), RATE, (0.0, RATE / 2))
    assert shown.at(80.0)[1] / shown.mean > 3.0 * whole.at(80.0)[1] / whole.mean
    assert (shown.low, shown.high) == (best.low, best.high) and shown.at(80.0)[2] > whole.at(80.0)[2]


def test_bands_divide_what_there_is():
    rng = np.random.default_rng(3)
    found = measure.kurtogram(rng.normal(size=51_200), RATE)
    levels = sorted({band.level for band in found.bands})
    assert levels[:5] == pytest.approx([0.0, 1.0, np.log2(3.0), 2.0, np.log2(6.0)])
    for level in levels:
        bands = [band for band in found.bands if band.level == level]
        assert (bands[0].low, bands[-1].high, len(bands)) == (0.0, RATE / 2, round(2.0**level))
        assert all(one.high == pytest.approx(other.low) for one, other in zip(bands, bands[1:], strict=False))
        # of n samples of noise the kurtosis is 0 within 4 standard deviations of 2 / sqrt(n), which filters
        # that overlap make a little larger
        spread = 5.0 * 2.0 / np.sqrt(51_200 / 2.0**level / 2.0)
        assert all(abs(band.kurtosis) < spread for band in bands), level
    # a steady tone is in one band of each level
    tone = measure.kurtogram(np.sin(2.0 * np.pi * 5000.0 * np.arange(51_200) / RATE), RATE)
    for band in tone.bands:
        width = band.high - band.low
        if band.low + 0.25 * width <= 5000.0 <= band.high - 0.25 * width:
            # two ends that are a quarter of the width away take a tenth of the square
            assert band.kurtosis == pytest.approx(-1.0, abs=1e-3) and 0.85 < band.share < 1.02
        elif not band.low - 0.5 * width <= 5000.0 <= band.high + 0.5 * width:
            assert band.share < 1e-7, band


def test_a_band_that_only_rounding_fills_is_never_the_best():
    rng = np.random.default_rng(4)
    spectrum = np.fft.rfft(rng.normal(size=51_200))
    spectrum[20_000:] = 0.0
    signal = np.fft.irfft(spectrum)
    signal[::5120] += 1e-5  # strokes in the empty band alone stand out
    found = measure.kurtogram(signal, RATE, narrowest=1000.0)
    assert found.best.low < 20_000.0
    assert max(found.bands, key=lambda band: band.kurtosis).low >= 20_000.0


def within(low, high, values):
    """Values between two frequencies (Hz) alone, of rms 1."""
    spectrum = np.fft.rfft(values)
    frequency = np.fft.rfftfreq(values.size, 1.0 / RATE)
    spectrum[(frequency < low) | (frequency > high)] = 0.0
    kept = np.fft.irfft(spectrum)
    return kept / kept.std()


@pytest.mark.parametrize(("strength", "taken"), [(0.05, False), (0.2, True)])
def test_sharp_strokes_in_a_band_that_holds_next_to_nothing_are_not_taken(strength, taken):
    rng = np.random.default_rng(6)
    noise = rng.normal(size=51_200)
    sharp = within(18_000.0, 20_800.0, np.repeat(rng.normal(size=100) ** 3, 512) * noise)
    # below: strokes of a defect, in all of 3 kHz; 0.05 of the rms is 0.25 % of the mean square, 0.2 is 4 %
    below = within(1000.0, 4000.0, (1.0 + 3.0 * (np.arange(51_200) % 640 < 60)) * noise)
    signal = below + strength * sharp + 1e-3 * rng.normal(size=51_200)
    found = measure.kurtogram(signal, RATE, lowest=200.0, narrowest=1000.0)
    sharpest = max((band for band in found.bands if found.counts(band)), key=lambda band: band.kurtosis)
    assert sharpest.low > 15_000.0 and sharpest.kurtosis > 2.0 * found.bands[0].kurtosis
    assert (found.best.low > 15_000.0) is taken and found.within == pytest.approx(1.0, abs=1e-6)
    # what is slow and strong takes nothing from the bands above
    slow = signal + 300.0 * np.sin(2.0 * np.pi * 30.0 * np.arange(51_200) / RATE)
    moved = measure.kurtogram(slow, RATE, lowest=200.0, narrowest=1000.0)
    assert moved.within == pytest.approx(1.0 / (0.5 * 300.0**2), rel=0.05)
    assert (moved.best.low > 15_000.0) is taken


def test_text_and_pictures_name_the_same_band():
    noise = np.random.default_rng(2).normal(size=51_200)
    strong = within(17_200.0, 21_200.0, np.repeat(np.arange(100) % 10 == 0, 512) * noise)
    signal = 0.5 * strong + within(200.0, 16_000.0, np.random.default_rng(7).normal(size=51_200))
    found = measure.envelope(signal, RATE, name="a", unit="m/s2", highest=20_000.0, narrowest=4000.0)
    assert found.kurtogram.best.high > 20_000.0 == found.high
    words = re.search(r"between (\S+) and (\S+) kHz", found.strength).groups()
    assert words[1] == "20.0" and f"{words[0]} to {words[1]} kHz" in found.heading
    (ax, *_) = found.kurtogram.picture("a").axes
    assert f"best: {words[0]} to {words[1]} kHz" in ax.get_title(loc="left") + ax.get_title()
    frame = ax.lines[-1].get_xdata()
    assert [frame.min(), frame.max()] == pytest.approx([1e-3 * found.low, 1e-3 * found.high])
    assert f"of the signal's {signal.std():.3g} m/s2)" in found.strength
    assert found.whole == pytest.approx(signal.std()) and found.rms < found.whole


@pytest.mark.parametrize(
    ("signal", "band", "words"),
    [
        (np.ones(1000), None, "constant"), (np.zeros(100), None, "256 samples"),
        (np.full(1000, np.nan), None, "no finite"), (np.sin(np.arange(1000)), (5.0, 1.0), "from 5 to 1 Hz"),
        (np.sin(np.arange(1000)), (5.0, 60.0), "from 5 to 60 Hz"),
    ],
)  # fmt: skip
def test_what_has_no_envelope_is_refused(signal, band, words):
    with pytest.raises(ValueError, match=words):
        measure.envelope(signal, 100.0, band)


@pytest.fixture(scope="module")
def recording(scene):
    bare = with_fidelity(scene("7003C-bare"), model="rings")
    speeds = ["outer_ring.velocity.z", "cage.speed_ratio"]
    return record(bare, 0.2, step=1.0 / RATE, radiation_model="compact", outputs=speeds, warn=False)


def test_accelerations_are_the_rates_of_the_velocities_without_delay(recording):
    found, velocity = recording.signal("outer_ring.acceleration.z"), recording.signal("outer_ring.velocity.z")
    assert (found.unit, velocity.unit, found.bearing) == ("m/s2", "m/s", 1)
    assert found.time == pytest.approx(velocity.time, abs=1e-12)
    spectra = [np.fft.rfft(one.values * np.hanning(one.values.size)) for one in (found, velocity)]
    frequency = np.fft.rfftfreq(found.values.size, 1.0 / RATE)
    loud = (
        (np.abs(spectra[0]) > 0.1 * np.abs(spectra[0]).max()) & (frequency > 500.0) & (frequency < 19_000.0)
    )
    ratio = spectra[0][loud] / (2j * np.pi * frequency[loud] * spectra[1][loud])
    assert loud.sum() > 5
    # velocities at points are not band-limited: what is above 25.6 kHz is folded onto them
    assert np.abs(ratio) == pytest.approx(1.0, abs=0.02) and np.angle(ratio) == pytest.approx(0.0, abs=0.02)


def test_accelerations_of_a_pair_have_the_axes_of_its_shaft():
    pair = read_scene(EXAMPLES.parent / "spindle_set" / "7003C-DB.toml")
    assert [bearing.sign for bearing in pair.bearings()] == [1.0, -1.0]
    names = [f"bearing[{k}].inner_ring" for k in (1, 2)]
    forces = {
        f"nose.force.{way}": lambda t, f=f: 50.0 * np.sin(2.0 * np.pi * f * t)
        for way, f in (("x", 1600.0), ("y", 900.0), ("z", 700.0))
    }
    outputs = [f"{name}.velocity.{way}" for name in names for way in "xyz"]
    moved = record(
        with_fidelity(pair, model="rings"), 0.05, step=1.0 / RATE, inputs=forces, radiation_model="compact",
        outputs=outputs, warn=False,
    )  # fmt: skip
    for name in names:
        for way in "xyz":
            read, rate = (moved.signal(f"{name}.{kind}.{way}") for kind in ("acceleration", "velocity"))
            wanted = np.gradient(rate.values, 1.0 / RATE)
            # below some kHz, differences of samples are derivatives
            sections = scipy.signal.butter(4, (100.0, 4000.0), "bandpass", fs=RATE, output="sos")
            one, other = (scipy.signal.sosfiltfilt(sections, x)[200:-200] for x in (read.values, wanted))
            assert np.linalg.norm(one - other) < 0.05 * np.linalg.norm(one), (name, way)


def test_lines_are_those_of_the_cage_as_it_ran(recording):
    found = measure.envelope_of(recording, "outer_ring.acceleration.z", (5000.0, 15_000.0))
    turned, nominal = recording.kinematics(), recording.kinematics(contact_angle=np.radians(15.0))
    lines = {line.name: line for line in found.lines}
    assert lines["f_o"].frequency == pytest.approx(turned.f_o, rel=1e-12)
    assert lines["2 f_i - f_r"].frequency == pytest.approx(2.0 * turned.f_i - turned.f_r, rel=1e-12)
    assert lines["2 f_b + f_c"].frequency == pytest.approx(2.0 * turned.f_b + turned.f_c, rel=1e-12)
    assert (lines["f_o"].of, lines["f_c"].of, lines["2 f_b"].of) == ("outer race", "cage", "ball")
    # nominal kinematics would miss the line by more than a resolution
    assert abs(nominal.f_o - turned.f_o) > found.resolution
    # balls pass the waves of the rings and the load of the shaft's weight
    assert lines["f_o"].over_median > 20.0
    assert abs(lines["f_o"].found - turned.f_o) < found.resolution
    columns, rows = table(type(found.lines[0]), found.records())
    assert len(rows) == len(found.lines) == 118 and columns[0] == "line"


def test_a_peak_has_the_name_of_the_nearest_line_and_its_skirt_has_none():
    time = np.arange(25_600) / RATE  # 2 Hz
    # a motor's 6205: 3 f_o = 322.7 is a resolution from 2 f_i = 324.9, and 2 f_b - f_c close to f_o
    swell = sum(np.cos(2.0 * np.pi * 107.566 * k * time) for k in range(1, 5))
    found = measure.envelope((5.0 + swell) * np.sin(2.0 * np.pi * 5000.0 * time), RATE, (4000.0, 6000.0))
    given = {"f_o": 107.566, "3 f_o": 322.698, "2 f_i": 324.868, "f_i - 2 f_r": 102.434, "f_r": 30.0}
    lines = [
        EnvelopeLine(name, "", f, at, amplitude / found.mean, 20.0 * np.log10(over))
        for name, f in given.items()
        for at, amplitude, over in [found.at(f)]
    ]
    named = replace(found, lines=tuple(lines)).far()
    assert [line.name for line in sorted(named, key=lambda line: line.frequency)] == ["f_o", "3 f_o"]


def test_microphones_and_variables_have_envelopes_too(recording):
    pressure = measure.envelope_of(recording, "P1")
    assert pressure.unit == "Pa" and pressure.kurtogram is not None and pressure.high <= 20_000.0
    fastest = max(recording.kinematics().f_i, 2.0 * recording.kinematics().f_b)
    assert pressure.high - pressure.low >= 2.0 * fastest
    velocity = measure.envelope_of(recording, "outer_ring.velocity.z", (5000.0, 15_000.0))
    assert velocity.unit == "m/s" and velocity.at(recording.kinematics().f_o)[2] > 10.0
    assert "inner_ring.acceleration.x" in recording.signal_names
    with pytest.raises(ValueError, match="did you mean 'outer_ring.acceleration"):
        measure.envelope_of(recording, "outer_ring.aceleration.z")


def test_accelerometers_are_signals_and_the_usual_ones(recording, monkeypatch):
    read = recording.signal("outer_ring.acceleration.z").values
    monkeypatch.setattr(type(recording), "accelerometers", ("DE",), raising=False)
    monkeypatch.setattr(type(recording), "acceleration", lambda self, name: 2.0 * read, raising=False)
    assert "DE" in recording.signal_names and usual_signals(recording) == ["DE"]
    signal = recording.signal("DE")
    assert (signal.unit, signal.rate, signal.highest) == ("m/s2", RATE, 20_000.0)
    found, ring = (
        measure.envelope_of(recording, name, (5e3, 15e3)) for name in ("DE", "outer_ring.acceleration.z")
    )
    assert found.rms == pytest.approx(2.0 * ring.rms)
    assert [line.name for line in found.far()] == [line.name for line in ring.far()]


def test_lines_of_local_defects_name_them(recording, monkeypatch):
    lines = tuple(
        SimpleNamespace(bearing=0, carrier=carrier, defect=f"defect {number}")
        for number, carrier in enumerate(("f_o", "f_b", "f_o"), start=1)
    )
    monkeypatch.setattr(type(recording), "defect_lines", lambda self: lines, raising=False)
    found = measure.envelope_of(recording, "outer_ring.acceleration.z", (5e3, 15e3))
    of = {line.name: line.of for line in found.lines}
    assert (of["f_o"], of["9 f_o"]) == ("outer race (defect 1, defect 3)",) * 2
    assert (of["2 f_b"], of["f_i"], of["f_c"]) == ("ball (defect 2)", "inner race", "cage")
    assert found.strongest("outer race").of == of["f_o"] and found.strongest("no such") is None


def test_a_speed_that_changes_is_refused(scene):
    bare = with_fidelity(scene("7003C-bare"), model="rings")
    ramp = record(bare, 0.05, speed=lambda t: 1000.0 + 2000.0 * t, radiation_model="compact", warn=False)
    with pytest.raises(ValueError, match="the speed changes.*record at one speed"):
        measure.envelope_of(ramp, "outer_ring.acceleration.z")


@pytest.mark.skipif(OPENCONMO is None, reason="FMU_BEARING_OPENCONMO names no Python with openconmo 0.0.6")
def test_openconmo_finds_the_same(tmp_path):
    noise = np.random.default_rng(2).normal(size=51_200)
    signal, noisy = strokes(640, 51_200), noise + 6.0 * strokes(640, 51_200)
    np.savez(tmp_path / "signals.npz", signal=signal, noisy=noisy, rate=RATE)
    done = subprocess.run(
        [*shlex.split(str(OPENCONMO)), "-c", SCRIPT, tmp_path / "signals.npz"],
        capture_output=True, text=True, timeout=600,
    )  # fmt: skip
    assert done.returncode == 0, done.stderr
    frequency, lines, rows, centre, width = json.loads(done.stdout.splitlines()[-1])
    found = measure.envelope(signal, RATE, (0.0, RATE / 2))
    for k in range(1, 9):
        # theirs are bins of a whole number of periods, without a window
        theirs = lines[round(80.0 * k / (frequency[1] - frequency[0]))]
        assert found.at(80.0 * k)[1] == pytest.approx(theirs, rel=0.002)
    own = measure.kurtogram(noisy, RATE, narrowest=RATE / 64.0)
    assert own.best.low < MODE < own.best.high and abs(centre - MODE) < 0.5 * width
    pairs = []
    for level, row in rows:
        bands = [band for band in own.bands if band.level == pytest.approx(level, abs=1e-6)]
        assert len(bands) == round(2.0**level)
        places = ((np.arange(len(bands)) + 0.5) / len(bands) * len(row)).astype(int)
        pairs += [(band.kurtosis, row[k]) for band, k in zip(bands, places, strict=True)]
    # theirs have filters of 17 taps, which let more of a neighbour through
    assert np.corrcoef(np.array(pairs).T)[0, 1] > 0.9
