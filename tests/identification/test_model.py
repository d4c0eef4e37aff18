"""Computed levels against recordings measured another way, and superposition of excitations against runs."""

import numpy as np
import pytest

from fmu_bearing.acoustics.analysis.third_octave import third_octave_levels
from fmu_bearing.identification.data import read_data
from fmu_bearing.identification.free import free_numbers, start_point
from fmu_bearing.identification.model import Levels
from fmu_bearing.recording.record import record
from fmu_bearing.run.simulate import simulate
from fmu_bearing.scene.read import with_fidelity

SPEED = 18000.0


@pytest.fixture(scope="module")
def spindle(scene):
    return with_fidelity(scene("7003C-spindle"), model="response")


def rows(*quantities, **values):
    return [
        {"microphone": "P1", "speed_rpm": SPEED, "quantity": q, "value_dB": 70.0} | values for q in quantities
    ]


def levels(scene, table, **options):
    return Levels(scene, read_data(table, scene), (), **options).at(np.empty(0), [1], "response")[0]


@pytest.mark.heavy
def test_levels_are_those_of_a_recording(spindle):
    found = levels(spindle, rows("leq", "leq_a", "third_octave[2000]", "line[f_r]"))
    made = record(spindle.replace({"operation.speed_rpm": SPEED}), 0.4, settle=0.05, progress=False)
    # other stretches of one steady sound: its beats last longer than 0.1 s
    assert found[0] == pytest.approx(made.levels()[0], abs=0.1)
    assert found[1] == pytest.approx(made.levels(weighting="A")[0], abs=0.1)
    centres, bands = third_octave_levels(made.pressure(), made.rate, settle=0.05)
    assert found[2] == pytest.approx(bands[0, np.argmin(np.abs(centres - 2000.0))], abs=0.3)
    frequency, squares = made.mean_squares(resolution=20.0)
    near = np.abs(frequency - SPEED / 60.0) < 50.0  # a Hann window spreads a line over three bins
    assert found[3] == pytest.approx(10.0 * np.log10(squares[0, near].sum() / 4e-10), abs=0.1)


@pytest.mark.heavy
@pytest.mark.parametrize("model", ["paper", "paper_vector", "paper_contacts"])
def test_radiation_models_of_the_papers_add_energies_as_recordings_do(spindle, model):
    sound = spindle.sound.model_copy(update={"radiation_model": model})
    received = spindle.model_copy(update={"sound": sound})
    made = record(received.replace({"operation.speed_rpm": SPEED}), 0.2, settle=0.05, progress=False)
    assert levels(received, rows("leq_a"))[0] == pytest.approx(made.levels(weighting="A")[0], abs=0.1)


def test_velocities_are_those_of_a_run(spindle):
    found = levels(spindle, rows("velocity[outer_ring.z]", "velocity[inner_ring.y]", "velocity[housing.z]"))
    made = simulate(
        spindle.replace({"operation.speed_rpm": SPEED}), 0.4, step=1.0 / 51200.0,
        outputs=["outer_ring.velocity.z", "inner_ring.velocity.y"],
    )  # fmt: skip
    for level, name in zip(found, made.names, strict=False):
        swing = made[name][2000:] - made[name][2000:].mean()
        # a tenth of a second resolves no beats below 20 Hz
        assert level == pytest.approx(20.0 * np.log10(np.sqrt((swing**2).mean()) / 1e-9), abs=0.05)
    assert found[0] == found[2]  # the housing moves with the outer ring


def test_energies_of_excitations_add_in_a_linear_response(spindle):
    """Fidelity response is linear.

    Unbalance gives the shaft's line alone, waviness none of it: twice the unbalance is 6.02 dB more there and
    nothing elsewhere.
    """
    table = rows("line[f_r]", "third_octave[2000]")
    free = free_numbers(spindle, ["imperfections.unbalance_um", "imperfections.*_race_amplitude_um"])
    model = Levels(spindle, read_data(table, spindle), free)
    x = start_point(free)
    here = model.at(x, [1], "response")[0]
    unbalance = model.at(x + [np.log(2.0), 0.0], [1], "response")[0] - here
    races = model.at(x + [0.0, np.log(2.0)], [1], "response")[0] - here
    # lines 1e-5 of the strongest are left out
    assert unbalance == pytest.approx([6.02, 0.0], abs=0.02)
    assert races == pytest.approx([0.0, 6.02], abs=0.02)


def test_background_adds_as_energy(spindle):
    table = rows("leq") + rows("background_leq", value_dB=73.0)
    model = Levels(spindle, read_data(table, spindle), ())
    assert model.with_background(np.array([[73.0]]), np.zeros(1))[0, 0] == pytest.approx(76.01, abs=0.01)
    assert model.with_background(np.array([[40.0]]), np.zeros(1))[0, 0] == pytest.approx(73.0, abs=0.01)


def test_kept_runs_are_not_run_again_and_damaged_ones_are(spindle, tmp_path):
    table = rows("leq", "leq_a")
    data = read_data(table, spindle)
    first = Levels(spindle, data, (), folder=tmp_path)
    one = first.at(np.empty(0), [1, 2], "response")
    second = Levels(spindle, data, (), folder=tmp_path)
    assert np.array_equal(second.at(np.empty(0), [1, 2], "response"), one)
    assert (first.runs, second.runs) == (2, 0)
    path = tmp_path / "runs.jsonl"
    lines = path.read_text().splitlines()
    path.write_text(lines[0].replace("1", "2") + "\n" + lines[1][: len(lines[1]) // 2])
    third = Levels(spindle, data, (), folder=tmp_path, workers=2)
    assert np.array_equal(third.at(np.empty(0), [1, 2], "response"), one)
    assert third.runs == 2


def test_checked_conditions_are_run_when_asked(spindle):
    table = rows("leq") + rows("leq", speed_rpm=12000.0, role="check")
    model = Levels(spindle, read_data(table, spindle), ())
    assert np.isnan(model.at(np.empty(0), [1], "response")).tolist() == [[False, True]]
    assert not np.isnan(model.at(np.empty(0), [1], "response", check=True)).any()


def test_what_cannot_be_run_has_a_reason(spindle):
    table = rows("leq", "line[20 f_i]")  # beyond what is recorded
    model = Levels(spindle, read_data(table, spindle), ())
    assert np.isnan(model.at(np.empty(0), [1], "response")).all()
    assert "Hz lies outside what a recording holds" in model.reason(np.empty(0), 1, "response")
