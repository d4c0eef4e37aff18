"""fmu-bearing envelope on records of a logger: their times, columns, units, the speed of the shaft."""

import numpy as np
import pytest

from fmu_bearing import Recording, Run, measure, read_scene, record

RATE, COUNT = 12_000.0, 24_000
TIME = np.arange(COUNT) / RATE
#: Hz: as balls pass the outer race of a 6205 at 1,750 r/min, 9/2 (1 - 7.94/39.04) times a turn.
STROKES = 3.585 * 1750.0 / 60.0


def values():
    """Acceleration (m/s2): strokes through a resonance of 3 kHz, in noise."""
    since = TIME % (1.0 / STROKES)
    noise = np.random.default_rng(5).normal(size=COUNT)
    return 20.0 * np.exp(-800.0 * since) * np.sin(2.0 * np.pi * 3000.0 * since) + noise


@pytest.fixture
def record_of(tmp_path):
    """Write columns under their titles; return the file."""

    def write(title="acceleration (m/s2)", time="{:.6f}", times=TIME, **others):
        columns = {title: values(), **others}
        path = tmp_path / "measured.csv"
        with path.open("w", encoding="utf-8") as file:
            file.write(",".join(["time", *columns]) + "\n")
            for t, *row in zip(times, *columns.values(), strict=True):
                file.write(",".join([time.format(t), *(f"{value:.6g}" for value in row)]) + "\n")
        return path

    return write


@pytest.mark.parametrize("time", ["{:.6f}", "{:.8g}", "{:.17g}"])
def test_times_that_were_rounded_are_taken(run, record_of, time):
    done = run("envelope", record_of(time=time), "--signal", "acceleration", "--json")
    (found,) = done.data["envelopes"]
    # 0.5 us at both ends of 1.9 s, and settle = 0.1 s of 2 s left out
    assert found["resolution_Hz"] == pytest.approx(1.0 / 1.9, rel=1e-4)


def test_uneven_times_are_refused_with_place_and_size(run, record_of):
    times = TIME + np.where(np.arange(COUNT) > 12_000, 0.5 / RATE, 0.0)
    refused = run("envelope", record_of(times=times), "--signal", "acceleration")
    assert refused.exit_code == 2 and "uneven" in refused.stderr and "too few" not in refused.stderr
    assert "at 1 s the step is 0.000125 s, the middle one 8.3e-05 s" in refused.stderr.replace("8.4e", "8.3e")
    assert "run " not in refused.stderr


def test_too_few_times_are_refused_with_their_number(run, record_of):
    few = run("envelope", record_of(), "--signal", "acceleration", "--settle", "1.9999")
    assert few.exit_code == 2 and "too few: 1, and 3 or more are needed" in few.stderr
    assert "uneven" not in few.stderr


@pytest.mark.parametrize(
    "title", ["acceleration", "acceleration (m/s2)", "acceleration [m/s2]", "DE", "a (g)"]
)
def test_a_sole_column_is_taken(run, record_of, title):
    (found,) = run("envelope", record_of(title), "--json").data["envelopes"]
    assert found["signal"] == title.split()[0]
    unit = {"(": "m/s2", "[": "m/s2"}.get(title.split()[-1][0], "")
    assert found["unit"] == unit


def test_of_several_columns_those_named_acceleration_are_taken(run, record_of):
    several = record_of("Acceleration y (m/s2)", torque=values(), shaft_speed=np.full(COUNT, 180.0))
    (found,) = run("envelope", several, "--json").data["envelopes"]
    assert found["signal"] == "Acceleration y"
    neither = run("envelope", record_of("torque", heat=values()))
    assert neither.exit_code == 2 and "there are torque, heat" in neither.stderr


def test_g_is_that_of_an_acceleration(run, record_of):
    one = run("envelope", record_of("acceleration (g)"), "--band", "2000:4000", "--json").data["envelopes"][0]
    plain = run("envelope", record_of(), "--band", "2000:4000", "--json").data["envelopes"][0]
    assert one["unit"] == plain["unit"] == "m/s2"
    assert one["rms"] / plain["rms"] == pytest.approx(9.80665, rel=1e-9)
    assert one["rms_share"] == pytest.approx(plain["rms_share"], rel=1e-9) and plain["rms_share"] < 1.0


@pytest.fixture(scope="module")
def scene_6205(run, tmp_path_factory):
    path = tmp_path_factory.mktemp("scene") / "6205.toml"
    done = run("scene", "new", path, "--bearing", "6205", "--clearance", "CN", "--radial-load", "300",
               "--speed", "1797")  # fmt: skip
    assert done.exit_code == 0
    return path


def test_lines_are_those_of_the_speed_that_is_given(run, record_of, scene_6205, tmp_path):
    def lines(*more):
        folder = tmp_path / str(len(list(tmp_path.iterdir())))
        done = run("envelope", record_of(), "--scene", scene_6205, "-o", folder, *more)
        assert done.exit_code == 0, done.stderr
        text = (folder / "lines-acceleration.csv").read_text("utf-8").splitlines()
        columns = text[0].split(",")
        rows = [dict(zip(columns, line.split(","), strict=True)) for line in text[1:]]
        return done, {row["name"]: float(row["frequency_Hz"]) for row in rows}

    _, of_scene = lines()
    done, given = lines("--speed", "1750")
    assert of_scene["f_r"] == pytest.approx(1797.0 / 60.0) and given["f_r"] == pytest.approx(1750.0 / 60.0)
    assert given["f_o"] == pytest.approx(STROKES, rel=0.01)
    for name, frequency in given.items():
        assert frequency / of_scene[name] == pytest.approx(1750.0 / 1797.0)
    assert (
        "outer race" in done.stdout and " m/s2 between " in done.stdout and "of the signal's" in done.stdout
    )


def test_a_speed_that_cannot_act_is_refused(run, record_of, scene_6205):
    no_scene = run("envelope", record_of(), "--speed", "1750")
    assert no_scene.exit_code == 2 and "--speed 1750 r/min is refused: without --scene" in no_scene.stderr
    held = record_of(shaft_speed=np.full(COUNT, 180.0))
    twice = run("envelope", held, "--scene", scene_6205, "--speed", "1750")
    assert twice.exit_code == 2 and "it has a column shaft_speed" in twice.stderr
    fast = run("envelope", record_of(), "--scene", scene_6205, "--speed", "1e6")
    assert fast.exit_code == 2 and "--speed 1e+06 r/min is refused: allowed are" in fast.stderr
    for command in ("envelope", "sound"):
        finished = run(command, "a.npz", "--speed", "1750")
        assert finished.exit_code == 2 and "a.npz is finished, and turned as it did" in finished.stderr


def test_a_recording_of_a_record_keeps_its_units(record_of, tmp_path):
    found = Recording.from_run(record_of("acceleration (g)"))
    assert found.signal("acceleration").unit == "m/s2"
    assert found.signal("acceleration").values.std() == pytest.approx(9.80665 * values().std(), rel=1e-5)
    found.save(tmp_path / "kept.npz")
    assert Recording.load(tmp_path / "kept.npz").signal("acceleration").unit == "m/s2"


def test_a_mass_in_g_stays_a_mass(record_of):
    run = Run.load(record_of("mass (g)", **{"weight of oil [g]": values(), "x (g)": values()}))
    assert run.units == {"mass": "kg", "weight of oil": "kg", "x": "m/s2"}
    for name, factor in (("mass", 1e-3), ("weight of oil", 1e-3), ("x", 9.80665)):
        assert run[name].std() == pytest.approx(factor * values().std(), rel=1e-5)


@pytest.mark.heavy  # two runs of fidelity full: 15 s
def test_a_spall_looks_worse_than_a_sound_bearing(run, scene_6205):
    """The kurtogram without its least share took 17 to 20 kHz of both, where the sound one was sharper."""
    sensor = {"name": "S", "on": "housing", "angle_deg": 0.0, "direction": "radial"}
    housing = {"mass_kg": 2.0, "diameter_mm": 100.0, "length_mm": 60.0, "front_face_mm": 20.0}
    spall = {"on": "outer", "shape": "spall", "length_mm": 0.5, "depth_um": 100.0}
    found = {}
    for name, defects in {"sound": [], "spall": [spall | {"angle_deg": 180.0}]}.items():
        keys = {"mounting.housing": housing, "accelerometer": [sensor], "imperfections.defect": defects}
        recording = record(read_scene(scene_6205).replace(keys), 0.5, settle=0.1, progress=False, warn=False)
        found[name] = measure.envelope_of(recording, "S")
    lines = {name: {line.name: line.over_median for line in one.lines} for name, one in found.items()}
    assert found["spall"].kurtosis > 1.5 * found["sound"].kurtosis
    assert found["spall"].rms > 1.5 * found["sound"].rms and min(one.share for one in found.values()) > 0.1
    assert lines["spall"]["f_o"] > 20.0 > 10.0 > lines["sound"]["f_o"]
    assert found["spall"].far()[0].of.startswith("outer race")
