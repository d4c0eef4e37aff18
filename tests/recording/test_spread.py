"""Uncertainty of a level: ranges over seeds and surfaces against runs made one by one."""

import dataclasses

import numpy as np
import pytest

from fmu_bearing import record, spread
from fmu_bearing.recording.studies import spread as spreading
from fmu_bearing.scene.imperfections import Harmonic
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.surface import Surface


def changed(scene, **keys):
    """The scene in fidelity response with other imperfections."""
    flaws = scene.imperfections.model_copy(update=keys)
    return with_fidelity(scene.model_copy(update={"imperfections": flaws}), model="response")


def recorded(scene, places=None, **keys):
    made = record(changed(scene, **keys), 0.1, settle=0.03, progress=False, radiation_model="compact")
    return made if places is None else made.levels(places, weighting="A", resolution=20.0)


def scaled_surfaces(scene, factor):
    """Amplitudes of all surfaces, times a factor."""
    names = ("inner_race_amplitude_um", "outer_race_amplitude_um", "ball_form_nm")
    return {name: factor * getattr(scene.imperfections, name) for name in names}


@pytest.fixture(scope="module")
def bare(example):
    return example("7003C-bare")


@pytest.fixture(scope="module")
def found(bare):
    return spread(recorded(bare), ["P1", "P4"], seeds=3)


@pytest.mark.heavy
def test_range_holds_the_runs_made_one_by_one(bare, found):
    places = [place.position_m for place in bare.microphones if place.name in ("P1", "P4")]
    own = recorded(bare, places)
    runs = [recorded(bare, places, seed=seed) for seed in (2, 3, 4)]
    law = [
        recorded(bare, places, waviness_exponent=p, **scaled_surfaces(bare, factor))
        for p in (1.0, 1.8)
        for factor in (0.5, 2.0)
    ]
    every = np.array([own, *runs, *law]) - own
    # the same runs and the same short-time spectra: rounding of sums
    assert found.low - found.levels == pytest.approx(every.min(axis=0), abs=1e-6)
    assert found.high - found.levels == pytest.approx(every.max(axis=0), abs=1e-6)
    assert found.seeds == pytest.approx(np.ptp(every[:4], axis=0), abs=1e-6)


@pytest.mark.heavy
def test_draws_of_a_surface_take_the_place_of_the_assumed_law(bare):
    """Oracle: each draw's run made by itself; the range is theirs, without the assumed corners."""
    numbers = np.arange(4)
    surface = Surface(
        "7003C", "L = 41 um/s", np.array([0.2, 0.3, 0.4, 0.5]), np.array([1.5, 1.45, 1.6, 1.5]),
        np.full(4, 80.0), numbers, 10 + numbers,
    )  # fmt: skip
    places = [place.position_m for place in bare.microphones if place.name == "P1"]
    own = recorded(bare, places)
    runs = []
    for k in range(4):
        law = {
            "inner_race_amplitude_um": surface.amplitude_um[k],
            "outer_race_amplitude_um": surface.amplitude_um[k],
            "waviness_exponent": surface.exponent[k],
        }
        runs.append(recorded(bare, places, seed=k, order_scatter_seed=10 + k, ball_form_nm=80.0, **law))
    sure = spread(recorded(bare), ["P1"], seeds=1, surface=surface)
    change = np.array(runs) - own
    # the same runs and the same short-time spectra: rounding of sums
    assert sure.low - sure.levels == pytest.approx(change.min(axis=0), abs=1e-6)
    assert sure.high - sure.levels == pytest.approx(change.max(axis=0), abs=1e-6)
    assert "Range over 4 draws of the surface that was found: 60 %" in sure.remark()
    assert "what the measured surface leaves open" in sure.decides(0)
    explicit = changed(
        bare, inner_race_amplitude_um=None, inner_race_harmonic=(Harmonic(order=5, amplitude_um=0.1),)
    )
    with pytest.raises(ValueError, match="leave the harmonics out"):
        spread(explicit, ["P1"], surface=surface)


@pytest.mark.heavy
def test_amplitude_counts_in_proportion(found):
    # surfaces make nearly all of it, and the answer is linear but for the outer race's order 2, which also
    # changes the stiffness: a factor of 4 is 12 dB
    assert found.amplitude == pytest.approx([20.0 * np.log10(4.0)] * 2, abs=0.5)
    assert np.all(found.exponent < -5.0)  # steeper surfaces are quieter at the rings' modes
    assert "exponent" in found.decides(0)


def test_shares_are_those_of_each_imperfection_alone(bare, found):
    places = [place.position_m for place in bare.microphones if place.name in ("P1", "P4")]
    alone = {
        "inner race": {"outer_race_amplitude_um": 0.0, "ball_form_nm": 0.0},
        "outer race": {"inner_race_amplitude_um": 0.0, "ball_form_nm": 0.0},
    }
    others = {"unbalance_um": 0.0, "ball_diameter_spread_nm": 0.0}
    levels = {name: recorded(bare, places, **others, **keys) for name, keys in alone.items()}
    ratio = 10.0 ** ((levels["inner race"] - levels["outer race"]) / 10.0)
    assert found.sources["inner race"] / found.sources["outer race"] == pytest.approx(ratio, rel=1e-6)
    assert sum(found.sources.values()) == pytest.approx([1.0, 1.0], abs=1e-12)


@pytest.mark.heavy
def test_harmonics_stated_one_by_one_are_a_race_too(bare):
    """Three of the inner race are all of its share, and none of the outer race's."""
    harmonics = tuple(Harmonic(order=n, amplitude_um=0.1, phase_deg=20.0 * n) for n in (5, 9, 12))
    none = {"inner_race_amplitude_um": None, "outer_race_amplitude_um": 0.0}
    scene = changed(bare, **none, ball_form_nm=0.0, unbalance_um=2.0, inner_race_harmonic=harmonics)
    made = record(scene, 0.1, settle=0.03, progress=False, radiation_model="compact")
    found = spread(made, ["P1"], seeds=1)
    assert set(found.sources) == {"unbalance", "inner race", "ball sizes"}
    alone = record(
        changed(scene, unbalance_um=0.0, ball_diameter_spread_nm=0.0), 0.1, settle=0.03, progress=False,
        radiation_model="compact",
    )  # fmt: skip
    places = [place for name, place in made.microphones if name == "P1"]
    levels = [one.levels(places, weighting="A", resolution=20.0)[0] for one in (made, alone)]
    assert found.sources["inner race"][0] == pytest.approx(10.0 ** ((levels[1] - levels[0]) / 10.0), abs=0.02)


def test_a_line_is_a_finding_where_it_stays(found):
    kept, drawn = found.stays
    assert drawn == 3 + 4
    # the bare bearing's loudest line, order 36 of the inner race near 7 kHz, is that of every draw
    assert (kept, found.line_is_found) == (7, True)
    assert not dataclasses.replace(found, stays=(3, 7)).line_is_found


def test_table_names_every_microphone(found):
    columns, rows = found.rows()
    assert columns[1] == "dB(A)" and [row[0] for row in rows] == ["P1", "P4"]
    low, high = (float(word) for word in rows[0][2].split(" to "))
    assert low <= float(rows[0][1]) <= high


@pytest.mark.heavy
def test_a_weakly_damped_bearing_is_drawn_with_full(bare, example, monkeypatch):
    """Levels of the dry 7003C at 8,000 r/min are 18 dB(A) off in response, and so would be their range."""
    made = spreading._drawn
    drawn = []

    def cheap(scene, flaws, fidelity):
        drawn.append(fidelity)
        return made(scene, flaws, "response")

    monkeypatch.setattr(spreading, "_drawn", cheap)
    dry = with_fidelity(example("7003C-impact"), model="response").replace({"operation.speed_rpm": 8000.0})
    flaws = bare.imperfections.model_dump(mode="json", exclude_none=True)
    recording = record(dry.replace({"imperfections": flaws}), 0.06, progress=False, radiation_model="compact")
    found = spread(recording, [(0.105, 0.0, 0.0)])
    assert set(drawn) == {"full"} and found.drawn == 3
    assert found.weak and f"Drawn with fidelity full, because {found.weak}" in found.remark()
    # the mode is weakly damped, and a run of 56 ms departs from full by it
    assert found.doubt == found.summary()["doubt"] and "inner tilt" in found.doubt
    assert found.doubt.startswith("levels and velocities of fidelity response")
    drawn.clear()
    assert spread(recorded(bare), ["P1"], seeds=1).doubt == ""
    assert set(drawn) == {"response"}


def test_refusals(bare):
    recording = recorded(bare)
    with pytest.raises(ValueError, match="no microphone 'P9'; there are P1, P2"):
        spread(recording, ["P1", "P9"])
    with pytest.raises(ValueError, match="seeds = 0"):
        spread(recording, seeds=0)
    perfect = bare.model_copy(update={"imperfections": None})
    with pytest.raises(ValueError, match="no imperfections"):
        spread(
            record(with_fidelity(perfect, model="response"), 0.02, radiation_model="compact", progress=False)
        )
    rising = record(
        changed(bare), 0.02, speed=lambda t: 1000.0 + 2e4 * t, radiation_model="compact", progress=False
    )
    with pytest.raises(ValueError, match="speed changes"):
        spread(rising)


def test_response_knows_the_outer_race_out_of_round(example):
    """Order 2 of the outer race makes the stiffness differ along y and z: beside a mode by 2 dB in sound.

    Levels beside and above the spindle, where fidelity ``rings`` has 71.3 and 73.4 dB(A) and a response with
    a round outer race 72.4 in both.
    """
    spindle = example("7003C-spindle")
    levels = []
    for fidelity in ("rings", "response"):
        made = record(
            with_fidelity(spindle, model=fidelity), 0.1, settle=0.05, progress=False,
            radiation_model="compact", outputs=(),
        )  # fmt: skip
        levels.append(made.levels(weighting="A")[[0, 2]])
    rings, response = levels
    assert rings[1] - rings[0] > 1.5
    assert response == pytest.approx(rings, abs=0.3)
