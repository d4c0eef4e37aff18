"""Accelerometers of runs: against the motion of the body, in all fidelities, of sets, in recordings."""

import numpy as np
import pytest
from lxml import etree

from fmu_bearing import record, simulate
from fmu_bearing.acoustics.analysis.field import Channels
from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import SD, P
from fmu_bearing.fmi.description import description_xml
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.accelerometers import sensors_of
from fmu_bearing.prepare.model import prepare
from fmu_bearing.prepare.unread_outputs import without_unread
from fmu_bearing.recording.recording import Recording
from fmu_bearing.scene import read_scene
from fmu_bearing.sweeps import sweep
from tests.conftest import GATES
from tests.scene.test_accelerometer import with_sensors
from tests.spindle.sets import scene as set_of

FIDELITIES = ("full", "rings", "response")
BARE = read_scene(GATES / "7003C-bare.toml")
MODE = {"frequency_Hz": 3100.0, "damping_ratio": 0.02, "mass_kg": 4.0}
PAIR = [
    {"name": f"{way} {angle:g}", "direction": way, "angle_deg": angle}
    for way in ("radial", "axial")
    for angle in (0.0, 180.0)
]
FLAWS = {
    "unbalance_um": 2.0,
    "ball_diameter_spread_nm": 0.0,
    "inner_race_amplitude_um": 0.0,
    "outer_race_amplitude_um": 0.0,
    "waviness_exponent": 1.0,
}
#: Unbalance alone: round races and equal balls, without tilts by a load.
UNBALANCED = BARE.replace(
    {
        "sound": None,
        "imperfections": FLAWS,
        "operation.speed_rpm": 15000.0,
        "mounting.radial_load_z_N": 0.0,
        "mounting.radial_load_y_N": 0.0,
        "fidelity.terms.gravity": False,
    }
)
HOUSED = {"mass_kg": 3.0, "diameter_mm": 100.0, "length_mm": 120.0, "pedestal_stiffness_N_m": 2e7}


def line(values, time, frequency):
    """Complex amplitude of a line, with the mean and two harmonics beside it, by least squares."""
    columns = [np.ones_like(time)]
    for order in (1, 2, 3):
        phase = 2.0 * np.pi * order * frequency * time
        columns += [np.cos(phase), np.sin(phase)]
    found = np.linalg.lstsq(np.array(columns).T, values, rcond=None)[0]
    return found[1] - 1j * found[2]


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_a_ring_driven_by_unbalance_is_read_as_w2_x(fidelity):
    scene = with_sensors(UNBALANCED, {})
    recording = record(
        scene.replace({"fidelity.model": fidelity}), 0.06, settle=0.1, step=1e-4, warn=False,
        outputs=["outer_ring.displacement.z", "accelerometer[1].acceleration"],
    )  # fmt: skip
    turning = UNBALANCED.operation.speed_rpm / 60.0
    late = recording.output_time >= recording.start
    place = line(recording.outputs["outer_ring.displacement.z"][late], recording.output_time[late], turning)
    signals = recording.acceleration()
    found = line(signals[0], recording.time, turning)
    omega = 2.0 * np.pi * turning
    # the low limit of 5 Hz turns the phase by sqrt(2) x 5 / 250
    assert abs(found) == pytest.approx(omega**2 * abs(place), rel=1e-3)
    assert abs(np.angle(-found / place)) < 0.03
    # what the run shows is the same signal, as late as the filters are
    time = recording.output_time - SD.LATENCY / SD.RATE
    inside = (time > recording.time[0]) & (time < recording.time[-1])
    shown = recording.outputs["accelerometer[1].acceleration"][inside]
    again = np.interp(time[inside], recording.time, signals[0])
    # a sample may be a whole one older than the communication point: 250 Hz turns by 0.03 in one
    assert np.abs(shown - again).max() < 0.03 * np.abs(shown).max()


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_meters_read_what_a_recording_has(fidelity):
    scene = with_sensors(BARE, {"mode": [MODE], "resonance_kHz": 28.0}).replace({"fidelity.model": fidelity})
    names = [f"accelerometer[1].{label}" for label in ("rms", "peak", "kurtosis")]
    start = BARE.sound.metering_start_s
    recording = record(
        scene, 0.05, settle=start, step=2e-4, outputs=names, warn=False, radiation_model="compact"
    )
    rms, peak, kurtosis = (recording.outputs[name][-1] for name in names)
    begin = round(recording.start * SD.RATE)
    # all that was metered by then, with the latency
    count = round(recording.output_time[-1] * SD.RATE) - begin - SD.LATENCY
    whole = recording.acceleration("DE")[: count - SD.LATENCY]
    assert rms == pytest.approx(np.sqrt(np.mean(whole**2)), rel=0.03)
    assert peak >= np.abs(whole).max() * (1.0 - 1e-9)
    central = whole - whole.mean()
    assert kurtosis == pytest.approx(np.mean(central**4) / np.mean(central**2) ** 2, rel=0.1)


def test_a_recording_and_the_channels_of_sound_agree():
    scene = with_sensors(BARE, *PAIR).replace({"fidelity.model": "rings"})
    recording = record(scene, 0.04, warn=False, radiation_model="compact")
    up, down, along, opposite = recording.acceleration()
    # without modes and resonance the radial one at 12 o'clock is the outer ring's acceleration upwards, to
    # the filter's -90 dB
    exact = motion(recording, SD.c_body(1, 2))
    assert np.abs(up - exact).max() < 1e-3 * np.abs(exact).max()
    # half a turn apart radial motion is opposite, axial motion equal but for the tilt
    assert np.abs(up + down).max() < 1e-12 * np.abs(up).max()
    exact = motion(recording, SD.c_body(1, 0))
    assert np.abs(0.5 * (along + opposite) - exact).max() < 1e-3 * np.abs(exact).max()
    tilting = 0.5 * BARE.bearing.outside_diameter_mm / 1e3 * motion(recording, SD.c_tilt(1, 0))
    assert np.abs(0.5 * (along - opposite) - tilting).max() < 1e-3 * np.abs(tilting).max()


def motion(recording, channel):
    """A channel of the sound, without the decimator and as band-limited as pressures are."""
    channels = Channels(recording.history[:, [channel]])
    spectrum = np.zeros(channels.size // 2 + 1, complex)
    spectrum[: channels.spectra.shape[1]] = channels.spectra[0]
    return np.fft.irfft(spectrum, channels.size)[recording.first :][: recording.size]


def test_without_accelerometers_nothing_differs():
    plain = BARE.replace({"fidelity.model": "rings"})
    runs = [Instance(prepare(scene)) for scene in (plain, with_sensors(plain, {"mode": [MODE]}))]
    for run in runs:
        run.initialise()
        for _ in range(20):
            run.step(1e-4)
    names = [one.name for one in runs[0].model.variables if one.causality in ("output", "local")]
    assert [runs[0].get(name) for name in names] == [runs[1].get(name) for name in names]
    assert runs[1].get("accelerometer[1].acceleration") != 0.0


def test_unread_accelerometers_cost_nothing_and_read_ones_are_the_same():
    model = prepare(with_sensors(UNBALANCED, {}).replace({"fidelity.model": "rings"}))
    read = [one for one in model.variables if one.name in ("accelerometer[1].rms", "outer_ring.velocity.z")]
    assert without_unread(model.parameters, read)[P.READ_SENSORS] == 1.0
    others = [one for one in read if one.name.startswith("outer")]
    assert without_unread(model.parameters, others)[P.READ_SENSORS] == 0.0


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_housing_and_rings_of_a_set(fidelity):
    sensors = [{"name": "middle", "on": "housing", "radius_mm": 0.0}]
    for way in ("radial", "tangential"):
        place = {"direction": way, "x_mm": 70.0, "radius_mm": 16.0, "angle_deg": 40.0}
        sensors += [{"name": f"ring {way}", "bearing": 2} | place]
        sensors += [{"name": f"housing {way}", "on": "housing"} | place]
    sensors += [{"name": f"along {b}", "bearing": b, "direction": "axial", "angle_deg": 90.0} for b in (1, 2)]
    pair = set_of("+-", (40.0, 70.0), rpm=15000.0, housing=HOUSED, load={"force_z_N": -100.0})
    pair = pair.replace({"imperfections": FLAWS, "fidelity.model": fidelity})
    recording = record(
        with_sensors(pair, *sensors), 0.04, settle=0.1, step=1e-4, warn=False,
        outputs=["housing.displacement.z"],
    )  # fmt: skip
    late = recording.output_time >= recording.start
    place = line(recording.outputs["housing.displacement.z"][late], recording.output_time[late], 250.0)
    signals = recording.acceleration()
    found = {
        name: line(one, recording.time, 250.0)
        for name, one in zip(recording.accelerometers, signals, strict=True)
    }
    # shown is the displacement in the pedestal's plane, which is the housing's middle
    assert abs(found["middle"]) == pytest.approx((500.0 * np.pi) ** 2 * abs(place), rel=1e-3)
    # a ring that is fixed in the housing moves with it, though the one that shows this is the other, mirrored
    for way in ("radial", "tangential"):
        assert found[f"ring {way}"] == pytest.approx(found[f"housing {way}"], rel=1e-9)
    assert found["along 1"] == pytest.approx(found["along 2"], rel=1e-9)


def test_bending_is_read_at_its_angle():
    scene = read_scene(GATES / "7009C-full-ceramic.toml").replace({"sound": None})
    order = scene.mounting.flexure.outer_ring[0]
    sensed = with_sensors(scene, {"name": "a"}, {"name": "b", "angle_deg": 180.0 / order})
    (sensors,) = sensors_of(sensed)
    first = SD.R_FLEXURES + 2 * len(scene.mounting.flexure.inner_ring)
    one, other = (sensor.reads[first] for sensor in sensors.each)
    # half a wave on it has the opposite sign; the shape is 1 at the groove and about that outside
    assert other == pytest.approx(-one, rel=1e-9)
    assert 0.5 < one < 1.5
    run = simulate(sensed, 2e-3, step=1e-4, outputs=["accelerometer[1].acceleration"])
    assert np.abs(run["accelerometer[1].acceleration"]).max() > 0.0


def test_noise_is_of_the_seed_and_of_recordings_alone():
    scene = with_sensors(UNBALANCED, {"noise_m_s2": 0.5}, {"name": "other", "noise_m_s2": 0.5})
    recording = record(scene.replace({"fidelity.model": "rings"}), 0.1, warn=False)
    noise = recording.acceleration() - recording.acceleration(noise=False)
    assert noise.std(axis=1) == pytest.approx(0.5, rel=0.05)  # 5120 draws: 1 %
    assert abs(np.corrcoef(noise)[0, 1]) < 0.05
    assert np.array_equal(recording.acceleration("DE"), recording.acceleration("DE"))


def test_recordings_are_kept_in_files_and_data_sets(tmp_path):
    scene = with_sensors(UNBALANCED, {"noise_m_s2": 0.5}, {"name": "b", "direction": "axial"})
    recording = record(scene.replace({"fidelity.model": "rings"}), 0.03, warn=False)
    recording.save(tmp_path / "run.npz")
    again = Recording.load(tmp_path / "run.npz")
    assert np.array_equal(again.acceleration(), recording.acceleration())
    with pytest.raises(ValueError, match="there is no accelerometer 'c'; there are DE, b"):
        recording.acceleration("c")
    data = recording.to_xarray()
    assert data["acceleration"].dims == ("accelerometer", "time")
    assert list(data["accelerometer"].values) == ["DE", "b"]
    assert data["acceleration"].attrs["units"] == "m/s2"
    with pytest.raises(ValueError, match="add \\[\\[accelerometer\\]\\] to the scene"):
        record(UNBALANCED.replace({"fidelity.model": "rings"}), 0.02, warn=False).acceleration()


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_copies_of_a_state_hold_what_accelerometers_go_on_from(fidelity):
    run = Instance(prepare(with_sensors(BARE, {"mode": [MODE]}).replace({"fidelity.model": fidelity})))
    run.initialise()
    run.step(1e-3)
    kept = np.full(run.s.size, np.nan)  # what is left out is not read
    assert call("copy", run.p, run.s, kept) == 0
    names = [f"accelerometer[1].{label}" for label in ("acceleration", "rms", "peak", "kurtosis")]
    found = []
    for state in (run.s.copy(), kept):
        run.s[:] = state
        run.step(1e-3)
        found.append([run.get(name) for name in names])
    assert found[0] == found[1]
    assert found[0][0] != 0.0


def test_the_fmu_describes_them():
    model = prepare(with_sensors(UNBALANCED, {}, {"name": "b"}).replace({"fidelity.model": "rings"}))
    tree = etree.fromstring(description_xml(model, "native"))
    found = {one.get("name"): one for one in tree.find("ModelVariables")}
    for k in (1, 2):
        for label in ("acceleration", "rms", "peak", "kurtosis"):
            one = found[f"accelerometer[{k}].{label}"]
            assert one.get("causality") == "output"
            assert one[0].get("unit") == ("1" if label == "kurtosis" else "m/s2")
    assert "accelerometer b" in found["accelerometer[2].rms"].get("description")
    # they begin to meter without sound, too
    assert found["sound.metering_start"].get("causality") == "parameter"


def test_sweeps_read_what_is_metered_over_their_window():
    scene = with_sensors(BARE, {}).replace({"fidelity.model": "rings", "sound": None})
    names = ["accelerometer[1].rms", "accelerometer[1].kurtosis"]
    data = sweep(scene, {"preload": [400, 500]}, settle=0.02, window=0.02, figures=names, workers=1)
    run = Instance(prepare(scene))
    run.set("sound.metering_start", 0.02)
    run.initialise()
    run.step(0.02)
    for _ in range(20):
        run.step(1e-3)
    # other steps cut the solver's steps elsewhere
    assert float(data[names[0]][1]) == pytest.approx(run.get(names[0]), rel=0.02)
    assert float(data[names[1]][1]) == pytest.approx(run.get(names[1]), rel=0.05)
    assert float(data[names[0]][0]) != float(data[names[0]][1])
