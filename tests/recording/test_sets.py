"""Recordings of sets: meters of the same run, a set of one, sums over bearings, spread, comparison."""

import json

import numpy as np
import pytest
from typer.testing import CliRunner

from fmu_bearing import Recording, compare, measure, read_scene, record, simulate, spread, with_fidelity
from fmu_bearing.acoustics.analysis.field import joined
from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.cli import app
from fmu_bearing.engine.layout import SD
from fmu_bearing.recording.channels.sources import centre_of, sources_of
from fmu_bearing.recording.measurements.sound_analysis import analyse_sound
from fmu_bearing.scene import SceneError
from tests.conftest import ROOT
from tests.spindle.test_sound import LENGTH, single, sound, sounding

RPM = 20e3
PLACES = ((-100.0, 0.0, 0.0), (55.0, 105.0, 0.0), (60.0, -20.0, 110.0))
AHEAD = ((-100.0, 0.0, 0.0), (0.0, 100.0, 40.0))  # of a wall
STEP = 20 / SD.RATE
STEPS, BEGIN = 100, 20e-3  # 39 ms, metered from 20 ms on
HOUSING = {"mass_kg": 2.0, "diameter_mm": 100.0, "length_mm": 160.0, "pedestal_stiffness_N_m": 1e8}


def pair(model="compact", signs="+-", places=(40.0, 70.0), seed=1, **more):
    """A pair with microphones ahead, beside and behind, in fidelity rings."""
    keys = {"housing": HOUSING} if more.get("radiator") == "housing" else {}
    heard = AHEAD if more.get("radiator") == "baffle" else PLACES
    given = sounding(
        signs, places, 500.0, RPM, flaws=True, sound_keys=sound(model, *heard, **more), **keys,
    )  # fmt: skip
    return given.replace(
        {"fidelity.model": "rings", "sound.metering_start_s": BEGIN, "imperfections.seed": seed}
    )


def run(scene, **options):
    """A recording of the span that the meters of a run to ``STEPS`` cover."""
    first = round(BEGIN * SD.RATE)
    count = 20 * STEPS + 1
    return record(
        scene, (count - first) / SD.RATE, settle=(first - SD.LATENCY) / SD.RATE, step=STEP, progress=False,
        **options,
    )  # fmt: skip


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("model", "radiator"),
    [("compact", "bare"), ("paper", "bare"), ("bem", "bare"), ("compact", "housing"), ("bem", "baffle")],
)  # fmt: skip
def test_a_recording_reads_what_the_meters_of_the_set_read(model, radiator):
    """Meters have filters of their own for every bearing; a recording multiplies spectra exactly.

    The filters of one bearing follow the exact paths within 0.05 dB (test_meters_equal_recordings). Of the
    other papers' models a recording adds energies and a meter pressures, of one bearing too.
    """
    given = pair(model, radiator=radiator)
    count = len(given.microphones)
    names = [f"mic[{k + 1}].{name}" for k in range(count) for name in ("leq", "leq_a")]
    kept = simulate(given, STEPS * STEP, step=STEP, outputs=names, progress=False)
    read = np.array([kept[name][-1] for name in names]).reshape(-1, 2)
    made = run(given)
    assert made.levels() == pytest.approx(read[:, 0], abs=0.05)
    assert made.levels(weighting="A") == pytest.approx(read[:, 1], abs=0.05)


@pytest.mark.heavy
@pytest.mark.parametrize(("fidelity", "within"), [("full", 0.05), ("response", 0.2)])
def test_other_fidelities_read_as_their_meters(fidelity, within):
    """Meters of `response` are of lines, settled sums without a window's ends: 0.2 dB over 19 ms."""
    given = with_fidelity(pair(), model=fidelity)
    kept = simulate(given, STEPS * STEP, step=STEP, outputs=["mic[2].leq", "mic[3].leq"], progress=False)
    read = [kept[name][-1] for name in ("mic[2].leq", "mic[3].leq")]
    assert run(given).levels(["P2", "P3"]) == pytest.approx(read, abs=within)


@pytest.mark.heavy
def test_a_set_of_one_is_the_single_bearing_there():
    """The starts differ by 4e-5 m/s (tests/spindle/test_sound.py): levels agree within 0.03 dB."""
    x = 0.5 * LENGTH
    given = sounding(
        "+", (x,), None, RPM, sound_keys=sound("compact", (x, 105.0, 0.0), (x - 80.5, 0.0, 0.0)), flaws=True,
        shaft={"sections_mm": [[LENGTH, 15.0, 0.0]]}, bearings=[{"seat": "pedestal"}],
        housing={"pedestal_stiffness_N_m": 1e8},
        load={"force_x_N": 500.0, "force_z_N": -20.0, "position_mm": x},
    ).replace({"fidelity.tolerance": 1e-6})  # fmt: skip
    alone = single(given, x)
    ours, own = (record(scene, 0.05, settle=0.02, progress=False) for scene in (given, alone))
    assert ours.history.shape == own.history.shape
    assert ours.levels(weighting="A") == pytest.approx(own.levels(weighting="A"), abs=0.05)
    assert ours.outputs["bearing[1].contact.inner.load_mean"] == pytest.approx(
        own.outputs["contact.inner.load_mean"], rel=1e-3
    )
    # circles and spheres have their centre where the single bearing's is
    assert centre_of(given) == pytest.approx(1e-3 * x) and centre_of(alone) == 0.0
    planes = [measure.planes(one, 0.3, count=12) for one in (ours, own)]
    for plane, turn in planes[0].items():
        assert turn.levels == pytest.approx(planes[1][plane].levels, abs=0.05)
    powers = [measure.sound_power(one).level for one in (ours, own)]
    assert powers[0] == pytest.approx(powers[1], abs=0.05)


def test_pressures_are_the_sum_of_the_bearings_and_far_ones_add_in_energy():
    """Two bearings with surfaces of their own: their sounds differ, so energies add on the mean."""
    made = run(pair(seed=3))
    parts = made.partial(by="bearing")
    assert list(parts) == ["bearing[1]", "bearing[2]"]
    assert sum(parts.values()) == pytest.approx(made.pressure(), abs=1e-12)
    whole = sum(made.partial(by="component").values())
    assert whole == pytest.approx(made.pressure(), abs=1e-12)
    far = [(0.055, 20.0 * np.cos(t), 20.0 * np.sin(t)) for t in np.linspace(0.0, 6.0, 24)]
    with pytest.warns(UserWarning, match="sound takes"):
        alone = made.partial(far, by="bearing")
    energies = sum(np.mean(part**2) for part in alone.values())
    together = np.mean(sum(alone.values()) ** 2)
    # cross terms of 24 places and 19 ms of lines, found 2.73 dB; equal motion would give 3.01 dB exactly
    assert abs(10.0 * np.log10(together / energies)) < 2.9


def test_a_mirrored_pair_hears_the_same_of_either_bearing():
    """Bearings with equal surfaces that face each other: places that are mirror images hear the same."""
    given = pair(seed=1, signs="+-", places=(40.0, 70.0))
    places = [(0.055 - 0.2, 0.1, 0.0), (0.055 + 0.2, 0.1, 0.0)]
    made = run(given)
    each = made.history.shape[1] // 2
    twin = Recording(
        made.scene, made.radiation_model, made.rate, made.start, made.size, made.output_time,
        made.speed_points, {}, np.hstack([made.history[:, :each]] * 2), harmonics=made.harmonics,
    )  # fmt: skip
    found = twin.levels(places)
    assert found[0] == pytest.approx(found[1], abs=1e-9)
    alone = twin.partial([(0.055, 0.105, 0.0)], by="bearing")
    assert alone["bearing[1]"] == pytest.approx(alone["bearing[2]"], abs=1e-12)
    both = level(np.mean(twin.pressure([(0.055, 0.105, 0.0)]) ** 2))
    assert both - level(np.mean(alone["bearing[1]"] ** 2)) == pytest.approx(6.02, abs=0.01)


@pytest.mark.parametrize(("axis", "sign"), [(0, -1.0), (1, 1.0), (2, 1.0)])
def test_a_face_in_a_wall_sounds_the_same_whichever_way_its_bearing_carries(axis, sign):
    """Own axes of a bearing that carries towards -X are mirrored, and so are its channels along the axis."""
    found = {}
    for signs in ("+-", "-+"):
        given = pair("bem", signs=signs, radiator="baffle")
        side = [given.microphones[1].position_m]
        (circle,) = joined(sources_of(given, "bem", side, 4))
        channel = SD.c_body(0, axis)
        paths = [path for path in circle.paths if path.channel == channel]
        assert {path.bearing for path in circle.paths} == {0}
        found[signs] = sum(path.response * path.weights[0] for path in paths)
    assert found["-+"] == pytest.approx(sign * found["+-"], rel=1e-9, abs=1e-12)


def test_files_and_analysis(tmp_path):
    made = run(pair())
    made.save(tmp_path / "a.npz")
    again = Recording.load(tmp_path / "a.npz")
    assert np.array_equal(again.pressure(), made.pressure())
    found = analyse_sound(again)
    assert found.names == ("P1", "P2", "P3") and found.lines
    energy = sum(10.0 ** (part / 10.0) for part in found.parts.values())
    # components interfere, so that their energies add to the level within some decibels
    assert 10.0 * np.log10(energy) == pytest.approx(found.levels[:, 1], abs=3.0)
    assert len([name for name in made.outputs if name.endswith("angle_mean")]) == 4
    one, other = made.bearing_kinematics()
    assert again.kinematics() == made.kinematics() == pytest.approx(np.mean([one, other], axis=0))
    shaft = made.within()["shaft_speed"].mean() / (2.0 * np.pi)
    orbits = [made.within()[f"bearing[{k}].balls.orbit_mean"].mean() / (2.0 * np.pi) for k in (1, 2)]
    assert [one.f_c, other.f_c] == pytest.approx(orbits) and one.f_r == pytest.approx(shaft)


@pytest.mark.heavy
def test_the_command_prints_what_python_measures(tmp_path):
    given = pair()
    (tmp_path / "pair.toml").write_text(given.to_toml(), "utf-8")
    words = [
        "sound",
        str(tmp_path / "pair.toml"),
        "-t",
        "0.03",
        "--settle",
        "0.02",
        "-o",
        str(tmp_path / "out"),
        "--json",
    ]
    done = CliRunner().invoke(app, [*words, "--no-spread", "--no-directivity"])
    assert done.exit_code == 0, done.output
    made = record(given, 0.03, progress=False)
    shown = json.loads(done.stdout)["levels"]
    assert [one["laeq_dB"] for one in shown.values()] == pytest.approx(made.levels(weighting="A"), abs=1e-9)
    assert (tmp_path / "out" / "P2.wav").stat().st_size > 2 * made.size


def test_power_from_motion_is_refused():
    with pytest.raises(ValueError, match="bearings of a set are apart: use sound_power"):
        measure.motion_power(run(pair()))


def test_a_hemisphere_behind_a_set_and_one_that_cuts_it():
    made = run(pair())
    assert measure.sound_power(made, 0.5, plane=0.0).level > 0.0
    with pytest.raises(ValueError, match="cuts the bearing: give at most 0.035 m"):
        measure.sound_power(made, 0.5, plane=0.04)


@pytest.mark.heavy
def test_spread_of_a_set_against_runs_made_one_by_one():
    heavy = [{"position_mm": 10.0, "amount_g_mm": 0.2}]
    given = with_fidelity(pair(), model="response").replace(
        {"spindle.shaft.unbalance": heavy, "bearing.cage": None}  # a loud cage needs draws in full
    )

    def recorded(scene):
        return record(scene, 0.1, settle=0.03, progress=False, radiation_model="compact")

    made = recorded(given)
    found = spread(made, seeds=2)
    own = made.levels(weighting="A", resolution=20.0)
    # the pair draws with seeds 1 and 2, the other draws with 3 and 4, 5 and 6
    seeds = [given.replace({"imperfections.seed": seed}) for seed in (3, 5)]
    others = [recorded(one).levels(weighting="A", resolution=20.0) for one in seeds]
    assert found.seeds == pytest.approx(np.ptp([own, *others], axis=0), abs=1e-6)
    # of its heavy spots alone: without waves and forms
    assert set(found.sources) == {"inner race", "outer race", "ball sizes", "unbalance"}
    gone = {"imperfections.ball_diameter_spread_nm": 0.0, "imperfections.outer_race_amplitude_um": 0.0}
    spots = given.replace(gone | {"imperfections.inner_race_amplitude_um": 0.0})
    races = given.replace(gone | {"spindle.shaft.unbalance": []})
    alone = [10.0 ** (recorded(one).levels(weighting="A", resolution=20.0) / 10.0) for one in (spots, races)]
    assert found.sources["unbalance"] / found.sources["inner race"] == pytest.approx(
        alone[0] / alone[1], rel=1e-6
    )


@pytest.mark.heavy
def test_a_comparison_of_two_sets():
    given = pair()
    other = given.replace({"spindle.preload.preload_N": 250.0})
    found = compare(given, other, duration=0.05, settle=0.02, progress=False)
    assert found.keys == {"spindle.preload.preload_N": (500.0, 250.0)}
    made = [record(one, 0.05, settle=0.02, progress=False) for one in (given, other)]
    for side, one in zip((found.a, found.b), made, strict=True):
        own = dict(zip(("P1", "P2", "P3"), one.levels(weighting="A"), strict=True))
        assert {name: pair[1] for name, pair in side.levels.items()} == pytest.approx(own, abs=1e-9)
    for side, preload in ((found.a, 500.0), (found.b, 250.0)):
        # axial balance: Q sin(angle) of all balls; waves let load and angle of a ball vary together
        load, angle = (side.figures[f"bearing[2].contact.inner.{name}_mean"] for name in ("load", "angle"))
        assert given.bearing.ball_count * load * np.sin(angle) == pytest.approx(preload, rel=0.05)
    rows = [row[0] for row in found.figures_table()[1]]
    assert rows[:2] == [f"bearing[{k}].contact.inner.load_mean" for k in (1, 2)]
    assert rows[-1] == "friction_torque"


@pytest.mark.parametrize("use", [lambda scene: record(scene, 1e-3), lambda scene: compare(scene, scene)])
def test_bearings_on_another_models_shaft_are_not_recorded(use):
    with pytest.raises(SceneError, match="another model moves the shaft"):
        use(read_scene(ROOT / "examples" / "port" / "7003C-DB-port.toml"))
