"""Measurements on recordings: against what the same sound gives by another way."""

import csv
from dataclasses import replace

import numpy as np
import pytest
from matplotlib.figure import Figure

from fmu_bearing.acoustics.analysis.directivity import circle_points
from fmu_bearing.acoustics.analysis.order import waterfall
from fmu_bearing.acoustics.analysis.third_octave import third_octave_levels
from fmu_bearing.engine.layout import SD
from fmu_bearing.recording.measurements import measure, pictures, tables
from fmu_bearing.recording.measurements.sound_analysis import analyse_sound, write_all
from fmu_bearing.recording.record import Recording, record
from fmu_bearing.results.table import markdown, write_csv
from fmu_bearing.scene.read import with_fidelity

P1 = (0.0, 0.105, 0.0)


@pytest.fixture(scope="module")
def bare(scene):
    return record(with_fidelity(scene("7003C-bare"), model="rings"), 0.25)


@pytest.fixture(scope="module")
def run_up(scene):
    """From 7,000 to 19,000 r/min in half a second, fidelity rings."""
    spindle = with_fidelity(scene("7003C-spindle"), model="rings")
    return record(spindle, 0.5, speed=lambda t: 733.0 + 2417.0 * t, radiation_model="compact")


def made(recording, tones):
    """Return the recording with the outer ring shaken upwards (m/s2) in place of what was recorded."""
    history = np.zeros_like(recording.history)
    t = np.arange(len(history)) / SD.RATE
    for frequency, amplitude in tones.items():
        history[:, SD.C_OUTER + 2] += amplitude * np.cos(2 * np.pi * frequency * t)
    return Recording(
        recording.scene, "compact", SD.RATE, recording.start, recording.size, recording.output_time,
        recording.speed_points, {}, history, microphones=recording.microphones,
        harmonics=recording.harmonics,
    )  # fmt: skip


def test_a_shaken_ring_is_a_dipole(bare):
    """Known motion: cosine round the circle, DA up, 6 dB per doubling far off, power by points and motion."""
    ring = made(bare, {500.0: 100.0})
    found = measure.circle(ring, 1.0, 0.0)
    expected = 20 * np.log10(np.abs(np.cos(found.angles[:6])))
    assert found.levels[:6] - found.levels[0] == pytest.approx(expected, abs=0.01)
    assert np.degrees(found.directivity.da) in (0.0, 180.0)
    assert found.directivity.dv > 60  # nothing at 3 and 9 o'clock but rounding and leaked ends
    far = measure.sweep(ring, [4.0, 8.0, 16.0], [0.0], 4)
    assert far.over_r[0].per_doubling == pytest.approx(-6.02, abs=0.03) and far.over_l == ()
    motion = measure.motion_power(ring)
    assert motion.levels["total"] == pytest.approx(motion.levels["outer_ring"], abs=1e-9)
    measured = measure.sound_power(ring, radius=4.0)
    assert measured.level == pytest.approx(motion.levels["outer_ring"], abs=0.25)  # quadrature of 20 points
    # a plane in which the dipole lies doubles the pressure, so four times the power through half the surface
    behind = measure.sound_power(ring, radius=4.0, plane=-0.02)
    assert behind.level - measured.level == pytest.approx(3.0, abs=0.3)


def test_bare_bearing_radiates_what_its_motion_says(bare):
    """All bodies at once, as dipoles in the centre: 0.5 dB, for balls sit off it."""
    assert measure.sound_power(bare).level == pytest.approx(
        measure.motion_power(bare).levels["total"], abs=0.5
    )


def test_levels_by_blocks_are_the_levels(bare):
    """Short-time spectra against whole-time pressures; a steady sound agrees within 0.1 dB."""
    points = circle_points(0.21, 0.05, 8)
    for weighting in ("Z", "A"):
        exact = bare.levels(points, weighting=weighting)
        assert bare.levels(points, weighting=weighting, resolution=20.0) == pytest.approx(exact, abs=0.1)
    with pytest.raises(ValueError, match="weighting"):
        bare.levels(points, weighting="C")
    with pytest.raises(ValueError, match="resolution"):
        bare.levels(points, resolution=0.5)


def test_strongest_lines_are_kinematic(bare):
    frequency, spectra = measure.component_spectra(bare, P1, 5.0)
    lines = measure.strongest(bare, frequency, spectra["total"], 4)
    assert all(line.name for line in lines)
    assert {"total", "inner_ring", "outer_ring", "cage", "balls"} == set(spectra)
    assert any("f_i" in line.name or "f_o" in line.name for line in lines)


@pytest.mark.heavy
def test_run_up_follows_the_shaft(run_up):
    """The passing of balls at the inner race stands still in the order map while the speed grows 2.6-fold."""
    assert run_up.speed[0] == pytest.approx(733 + 2417 * 0.02, rel=1e-3)
    turned = 733.0 * run_up.time + 0.5 * 2417.0 * run_up.time**2
    # the speed ramps from point to point, which the formula at the points' speeds gives exactly
    assert run_up.angle == pytest.approx(turned, abs=1e-2)
    found = measure.run_up(run_up, P1, 20.0, 0.2)
    kinematics = run_up.kinematics()
    strongest = found.orders[np.argmax(found.levels[found.speed > 1400], axis=1)]
    assert strongest == pytest.approx(np.full(len(strongest), kinematics.f_i / kinematics.f_r), abs=0.2)


def test_fmu_pressures_are_the_recordings(scene, tmp_path):
    """What an FMU shows at every sample is what the channels give, LATENCY earlier; CSV included."""
    spindle = with_fidelity(scene("7003C-spindle"), model="rings")
    names = ("mic[1].pressure", "mic[4].pressure")
    own = record(
        spindle,
        0.01,
        radiation_model="compact",
        microphones=True,
        step=Recording.PRESSURE_STEP,
        outputs=names,
    )
    rows = np.array(
        list(zip(own.output_time, own.speed_points, *(own.outputs[name] for name in names), strict=True)),
        dtype=[(name, float) for name in ("time", "shaft_speed", *names)],
    )
    write_csv(tmp_path / "run.csv", rows.dtype.names, rows.tolist())
    for source in (rows, str(tmp_path / "run.csv")):
        recorded = Recording.from_fmu(source, spindle)
        assert recorded.rate == SD.RATE and [name for name, _ in recorded.microphones] == ["P1", "P4"]
        first = round(recorded.start * SD.RATE) - own.first
        assert recorded.start == pytest.approx(0.02 - SD.LATENCY / SD.RATE, abs=1.1 / SD.RATE)
        count = own.size - max(first, 0)
        exact = own.pressure([own.positions[0], own.positions[3]])[:, max(first, 0) :]
        found = recorded.pressure()[:, max(-first, 0) :][:, :count]
        assert np.linalg.norm(found - exact) < 10 ** (-50 / 20) * np.linalg.norm(exact)
    assert recorded.pressure([own.positions[3]]).shape == (1, recorded.size)
    assert recorded.levels() == pytest.approx(own.levels([own.positions[0], own.positions[3]]), abs=1.0)
    assert recorded.kinematics().f_r == pytest.approx(own.kinematics().f_r)
    for call in (recorded.partial, lambda: recorded.pressure([(9.0, 9.0, 9.0)])):
        with pytest.raises(ValueError, match=r"fmu_bearing\.record"):
            call()
    with pytest.raises(ValueError, match="motion"):
        measure.motion_power(recorded)


def test_fmu_results_that_do_not_serve():
    time = np.arange(1000) / 1000.0
    coarse = np.array(list(zip(time, time, strict=True)), dtype=[("time", float), ("mic[1].pressure", float)])
    with pytest.warns(UserWarning, match="PRESSURE_STEP"):
        assert Recording.from_fmu(coarse).rate == pytest.approx(1000.0)
    with pytest.warns(UserWarning), pytest.raises(ValueError, match="settle"):
        Recording.from_fmu(coarse, settle=1.5)
    with pytest.raises(ValueError, match="evenly"):
        Recording.from_fmu(np.delete(coarse, 500))
    with pytest.raises(ValueError, match="mic"):
        Recording.from_fmu(coarse[["time"]])


def test_paper_radiation_model_adds_energies(scene):
    """Its level is the engine's own (eqs. 43, 46: energy sums over sources), though filters are not used."""
    spindle = with_fidelity(scene("7003C-spindle"), model="rings")
    printed = spindle.model_copy(
        update={"sound": spindle.sound.model_copy(update={"radiation_model": "paper"})}
    )
    paper = record(
        printed, 0.05, settle=spindle.sound.metering_start_s, microphones=True, outputs=("mic[1].leq",)
    )
    assert paper.radiation_model == "paper" and set(paper.partial()) == {
        "inner_ring",
        "outer_ring",
        "cage",
        "balls",
    }
    # the meter is read at the communication point next to the recording's end, up to 0.5 ms of 50 off
    end = np.argmin(np.abs(paper.output_time - paper.time[-1] - SD.LATENCY / SD.RATE))
    assert paper.levels()[0] == pytest.approx(paper.outputs["mic[1].leq"][end], abs=0.1)
    assert np.array_equal(record(spindle, 0.05, radiation_model="paper").channels, paper.channels)
    with pytest.raises(ValueError, match='radiation_model="compact"'):
        paper.pressure([P1], "compact")
    with pytest.raises(ValueError, match="microphones=True"):
        record(printed, 0.05, radiation_model="compact", microphones=True)


def test_places_that_do_not_serve(bare):
    with pytest.raises(ValueError, match="inside the bearing"):
        bare.pressure([(0.0, 0.0, 0.01)])
    with pytest.raises(ValueError, match=r"\(x, y, z\)"):
        bare.pressure([(0.0, 0.1)])
    with pytest.raises(ValueError, match="radiation_model"):
        bare.pressure([P1], "none")
    with pytest.raises(ValueError, match="cuts the bearing"):
        measure.sound_power(bare, plane=0.0)
    with pytest.raises(ValueError, match="duration"):
        record(bare.scene, -1.0)


@pytest.mark.heavy
def test_pictures_and_tables(bare, run_up, tmp_path):
    """Every picture is drawn, with what it was given in it; every table has its rows."""
    frequency, spectra = measure.component_spectra(bare, P1)
    centres, levels = third_octave_levels(bare.pressure([P1])[0], bare.rate, 0.05)
    circle = measure.circle(bare, 0.21, 0.05)
    three = measure.planes(bare, 0.1, 12)
    sweep = measure.sweep(bare, [0.15, 0.21], [0.05, 0.1], 8)
    motion, power = measure.motion_power(bare), measure.sound_power(bare)
    orders = measure.run_up(run_up, P1, 10.0, 0.5)
    fall = waterfall(run_up.pressure([P1])[0], run_up.angle, run_up.rate, 5000.0, 50.0)
    drawn = {
        "spectrum": pictures.spectrum_picture(frequency, spectra, bare.kinematics(), "spectrum"),
        "thirds": pictures.third_octave_picture(centres, {"total": levels}),
        "orders": pictures.order_picture(orders, run_up.kinematics()),
        "waterfall": pictures.waterfall_picture(fall),
        "circle": pictures.circle_picture({"r 210": circle}),
        "planes": pictures.planes_picture(three),
        "sweep": pictures.sweep_picture(sweep),
        "power": pictures.power_picture(motion, {"sphere": power.level}),
    }
    # docs/analysis.md writes them all
    pictures.save(drawn["circle"], tmp_path / "pictures" / "circle.png")
    assert (tmp_path / "pictures" / "circle.png").stat().st_size > 5000
    assert all(isinstance(figure, Figure) and figure.axes[0].has_data() for figure in drawn.values())
    assert len(drawn["spectrum"].axes[0].lines) >= len(spectra)
    written = {
        "lines": (tables.lines_table(measure.strongest(bare, frequency, spectra["total"], 5)), None),
        "spectrum": (tables.spectrum_table(frequency, spectra), len(frequency)),
        "thirds": (tables.third_octave_table(centres, {"total": levels}), 31),
        "orders": (tables.order_table(orders), len(orders.time)),
        "circle": (tables.round_table(circle), 24),
        "planes": (tables.round_table(three), 12),
        "directivity": (tables.directivity_table(three), 3),
        "sweep": (tables.sweep_table(sweep), 4),
        "attenuation": (tables.attenuation_table(sweep), 4),
        "power": (tables.power_table({"sphere": power}, motion), 6),
    }
    for name, ((columns, rows), count) in written.items():
        assert rows and (count is None or len(rows) == count), name
        assert all(len(row) == len(columns) for row in rows), name
        write_csv(tmp_path / f"{name}.csv", columns, rows)
        assert markdown(columns, rows).count("\n") == len(rows) + 2
    assert [row[0] for row in written["directivity"][0][1]] == ["YZ", "XY", "XZ"]
    # heads have the unit of the weighting
    assert written["directivity"][0][0][-2:] == ["highest, dB", "mean, dB"]
    loud = {name: replace(each, weighting="A") for name, each in three.items()}
    assert tables.directivity_table(loud)[0][-2:] == ["highest, dB(A)", "mean, dB(A)"]
    assert tables.round_table(loud, " at 100 mm")[0][1] == "YZ at 100 mm, dB(A)"


@pytest.mark.heavy
def test_directivity_keeps_out_of_the_housing(example, tmp_path):
    """A circle through the nearest microphone, 80.5 mm ahead of the spindle, would meet its housing."""
    scene = with_fidelity(example("7003C-spindle"), model="response")
    made = record(scene, 0.05, progress=False, radiation_model="compact")
    said = []
    files = write_all(made, analyse_sound(made), tmp_path, wav=False, tell=said.append)
    assert "planes.csv" in {path.name for path in files}
    assert any("no directivity at 80 mm: " in text and "lies inside the housing" in text for text in said)
    with (tmp_path / "planes.csv").open(encoding="utf-8", newline="") as file:
        assert all(np.isfinite(float(row["XY at 1000 mm, dB(A)"])) for row in csv.DictReader(file))
