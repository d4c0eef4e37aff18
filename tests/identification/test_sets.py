"""Sets of bearings: levels and velocities against runs, values found again, what is refused."""

import numpy as np
import pytest

from fmu_bearing import identify
from fmu_bearing.identification import IdentifyError
from fmu_bearing.identification.data import read_data
from fmu_bearing.identification.files import identified_toml
from fmu_bearing.identification.model import Levels
from fmu_bearing.identification.quantities import parse_quantity
from fmu_bearing.recording.record import record
from fmu_bearing.run.simulate import simulate
from fmu_bearing.scene import read_scene_text
from tests.identification.test_files import found_in
from tests.spindle import sets
from tests.spindle.one import MIDDLE, set_of_one

PRELOAD, RACES = "spindle.preload.preload_N", "imperfections.*_race_amplitude_um"
AMPLITUDES = tuple(RACES.replace("*", race) for race in ("inner", "outer"))
SPEED = 15000.0
FLAWS = {
    "seed": 3, "inner_race_amplitude_um": 0.3, "outer_race_amplitude_um": 0.3, "waviness_exponent": 1.35,
    "ball_diameter_spread_nm": 50.0, "ball_form_nm": 80.0,
}  # fmt: skip
HOUSING = {"mass_kg": 2.0, "diameter_mm": 100.0, "length_mm": 120.0, "pedestal_stiffness_N_m": 1e8}
SHORT = {"duration": 0.06, "settle": 0.02}  # s


def heard(x=65.0):
    place = {"name": "P", "x_mm": x, "y_mm": 205.0, "z_mm": 0.0}
    return {"sound": {"radiation_model": "compact", "microphone": [place]}}


def pair(housing=HOUSING, **more):
    """DB set in a housing that moves, at fidelity response."""
    given = heard() | {"imperfections": FLAWS, "fidelity.model": "response"}
    return sets.scene("+-", (40.0, 90.0), 150.0, SPEED, changes=given, housing=housing, **more)


def sprung(force=150.0, **more):
    """The same with springs behind its rear bearing."""
    spring = {"spindle.preload": {"kind": "spring", "force_N": force}, "spindle.bearing[2].seat": "sliding"}
    return pair(**more).replace(spring)


def rows(*quantities, **values):
    return [
        {"microphone": "" if q.startswith("velocity") else "P", "quantity": q, "value_dB": 70.0} | values
        for q in quantities
    ]


def levels(scene, table, seeds=(3,), **options):
    model = Levels(scene, read_data(table, scene), (), **options)
    return model.at(np.empty(0), seeds, "response").mean(axis=0)


def measured(truth, table, seeds, **options):
    """Return the rows with the levels of a machine, exactly."""
    exact = levels(truth, table, seeds, **options)
    return [row | {"value_dB": float(value), "std_dB": 1.0} for row, value in zip(table, exact, strict=True)]


@pytest.mark.heavy
def test_levels_are_those_of_a_recording():
    found = levels(pair(), rows("leq", "leq_a"))
    made = record(pair(), 0.4, settle=0.05, progress=False, warn=False)
    # other stretches of one steady sound: two bearings beat longer than 0.1 s
    assert found[0] == pytest.approx(made.levels()[0], abs=0.3)
    assert found[1] == pytest.approx(made.levels(weighting="A")[0], abs=0.3)


def test_velocities_are_those_of_a_run():
    names = ["bearing[1].outer_ring.z", "bearing[2].outer_ring.y", "bearing[2].inner_ring.x"]
    found = levels(pair(), rows(*(f"velocity[{name}]" for name in names)), duration=0.4)
    made = simulate(
        pair(), 0.5, step=1.0 / 51200.0,
        outputs=[".velocity.".join(name.rsplit(".", 1)) for name in names],
    )  # fmt: skip
    for level, name in zip(found, made.names, strict=False):
        swing = made[name][5000:] - made[name][5000:].mean()
        assert level == pytest.approx(20.0 * np.log10(np.sqrt((swing**2).mean()) / 1e-9), abs=0.05)


def test_a_set_of_one_has_the_levels_of_the_bearing():
    quantities = ("leq", "leq_a", "third_octave[2000]", "line[f_o]")
    both = [
        one.replace({"imperfections": FLAWS | {"unbalance_um": 0.5}, "fidelity.model": "response"} | heard(x))
        for one, x in zip(set_of_one(20e3, cage=False), (MIDDLE, 0.0), strict=True)
    ]
    several, single = (levels(one, rows(*quantities)) for one in both)
    # sound equal but for what losses do to the speed of the balls, 2e-4 of it
    assert several == pytest.approx(single, abs=0.1)
    bodies = (levels(one, rows(f"velocity[{name}outer_ring.y]")) for one, name in
              zip(both, ("bearing[1].", ""), strict=True))  # fmt: skip
    assert next(bodies) == pytest.approx(next(bodies), abs=0.1)


@pytest.mark.filterwarnings("ignore:bearing 1. the ellipse")
def test_a_line_is_looked_for_in_every_bearing():
    """A force loads the front bearing alone: its balls roll at a larger angle than the rear one's."""
    loaded = sprung(30.0, load={"force_x_N": 1000.0})
    made = record(loaded, 0.3, settle=0.05, step=4e-3, progress=False, warn=False)
    first, second = (one.f_o for one in made.bearing_kinematics())
    assert first / second - 1.0 > 0.008  # their mean is more than 0.4 % from either
    found = levels(loaded, rows("line[f_o]", f"line[{first:.3f} Hz]", f"line[{second:.3f} Hz]"), duration=0.3)
    assert found[0] == pytest.approx(max(found[1:]), abs=1e-3)  # frequencies are rounded to 1e-3 Hz


@pytest.mark.heavy
def test_the_amplitude_of_all_races_is_found_again():
    table = rows("leq_a", "third_octave[2000]", "velocity[bearing[2].outer_ring.z]")
    data = measured(pair(), table, (3, 5), **SHORT)
    start = pair().replace(dict.fromkeys(AMPLITUDES, 0.45))
    found = identify(start, data, [RACES], seeds=2, starts=1, accept=True, progress=False, **SHORT)
    assert found.seeds == (3, 5)  # seeds 3 and 4, 5 and 6: no surface twice
    # balls have a share of their own, so the search takes steps: it ends where the cost changes by 1e-3
    assert [found.values[key] for key in AMPLITUDES] == pytest.approx([0.3, 0.3], rel=0.01)
    assert found.rms() < 0.05 < 1.0 < found.rms(before=True) and found.doubts == ()


@pytest.mark.heavy
def test_preload_and_amplitude_are_found_again():
    """Exact levels: what is left is where the search stops, 1e-3 of a cost that is nothing there."""
    quantities = ("leq_a", "leq", "velocity[bearing[2].outer_ring.z]", "velocity[bearing[1].inner_ring.y]")
    table = [row for rpm in (9000.0, 15000.0, 21000.0) for row in rows(*quantities, speed_rpm=rpm)]
    data = measured(pair(), table, (3, 5))
    start = pair().replace(dict.fromkeys(AMPLITUDES, 0.5) | {PRELOAD: 200.0})
    found = identify(start, data, [PRELOAD, RACES], seeds=2, starts=1, accept=True, progress=False)
    assert found[PRELOAD].value == pytest.approx(150.0, rel=0.01)
    assert found[RACES].value == pytest.approx(0.3, rel=0.01)
    assert found.rms() < 0.05 < 2.0 < found.rms(before=True)


def test_preload_is_a_condition_by_its_short_name():
    for scene, key in ((pair(), PRELOAD), (sprung(), "spindle.preload.force_N")):
        (row,) = read_data(rows("leq", preload_N=200.0), scene)
        assert row.conditions == ((key, 200.0),) and row.label == "P preload_N 200 leq"
        with pytest.raises(IdentifyError, match="is a condition of the data already"):
            identify(scene, rows("leq", preload_N=200.0), [key])


def test_values_are_written_into_the_file_of_a_set():
    text = pair(shaft={
        "sections_mm": [[400.0, 17.0, 0.0]], "unbalance": [{"position_mm": 20.0, "amount_g_mm": 0.2}],
    }).to_toml().replace("preload_N = 150.0", 'preload_class = "light"')  # fmt: skip
    values = {
        PRELOAD: 120.0, "spindle.bearing[2].stickout_um": 1.5, "spindle.shaft.unbalance[1].amount_g_mm": 0.4,
        "spindle.housing.mass_kg": 3.0,
    }  # fmt: skip
    bounded = {key: f"{key}=-5:5" if "stickout" in key else key for key in values}
    made = identified_toml(found_in(text, values, bounded.values()), text)
    spindle = read_scene_text(made).spindle
    assert spindle.preload.preload_N == 120.0 and "preload_class" not in made
    assert [one.stickout_um for one in spindle.bearing] == [0.0, 1.5]
    assert spindle.shaft.unbalance[0].amount_g_mm == 0.4 and spindle.housing.mass_kg == 3.0
    assert made.count("# identified: ") == 4


@pytest.mark.heavy
def test_the_unbalance_of_a_set_is_found_again():
    """Levels of a linear response: the search needs its line at the speed of the shaft alone."""
    key, truth = "imperfections.unbalance_um", 0.5
    rings = "bearing[1].inner_ring.y", "bearing[2].inner_ring.z", "bearing[2].outer_ring.z"
    table = rows(*(f"velocity_line[{name} f_r]" for name in rings))
    data = measured(pair().replace({key: truth}), table, (3,), **SHORT)
    found = identify(
        pair().replace({key: 0.2}), data, [f"{key}=0.05:5"], seeds=1, starts=1, accept=True, progress=False,
        **SHORT,
    )  # fmt: skip
    # waves of the inner race have a line there, too, and few bins
    assert found.values[key] == pytest.approx(truth, rel=0.01)


@pytest.mark.parametrize(
    "body", ["housing.z", "outer_ring.z", "bearing[3].outer_ring.z", "bearing[1].cage.z"]
)
def test_a_body_needs_a_ring_of_the_set(body):
    with pytest.raises(IdentifyError, match=r"set of 2 bearings; write .* velocity\[bearing\[1\].outer_ring"):
        parse_quantity(f"velocity[{body}]", pair())
    with pytest.raises(IdentifyError, match="is not a direction of a body"):
        parse_quantity("velocity[bearing[1].outer_ring.z]")


def test_rings_in_a_housing_at_rest_have_no_velocity():
    fixed, sliding = pair({}), sprung(housing={})
    with pytest.raises(IdentifyError, match="does not move; give the housing's mass_kg"):
        parse_quantity("velocity[bearing[2].outer_ring.x]", fixed)
    assert parse_quantity("velocity[bearing[2].inner_ring.x]", fixed).bearing == 1
    assert parse_quantity("velocity_line[bearing[2].outer_ring.x f_r]", sliding).bearing == 1
    with pytest.raises(IdentifyError, match="does not move"):
        parse_quantity("velocity[bearing[2].outer_ring.y]", sliding)


def test_keys_of_a_single_bearing_are_refused_with_those_of_the_set():
    with pytest.raises(IdentifyError, match=f"mounting.preload_N is not set.*; it has {PRELOAD}"):
        identify(pair(), rows("leq"), ["mounting.preload_N"])
