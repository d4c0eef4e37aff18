"""Studies of sets: sensitivity, changes and trade-off against the single bearing, recordings and statics."""

import math

import numpy as np
import pytest

from fmu_bearing import changes, operating_point, record, simulate, statics, with_fidelity
from fmu_bearing.accuracy import changes as room
from fmu_bearing.accuracy.alternatives import Alternative, alternatives
from fmu_bearing.accuracy.changes import point
from fmu_bearing.accuracy.sensitivity import ASSUMED, sensitivity, value_at
from fmu_bearing.accuracy.tradeoff import check, tradeoff
from fmu_bearing.run.settings import Setting
from fmu_bearing.scene import Scene
from fmu_bearing.scene.preload import preload
from tests.spindle.sets import tables
from tests.spindle.test_sound import LENGTH, single, sound, sounding

RPM = 20e3
SPOT = {"position_mm": 10.0, "amount_g_mm": 0.2}


def pair(signs="+-", places=(40.0, 70.0), **more):
    """A pair with surfaces and two microphones."""
    return sounding(
        signs, places, 200.0, RPM, flaws=True,
        sound_keys=sound("compact", (-100.0, 0.0, 0.0), (55.0, 105.0, 0.0)), **more,
    ).replace({"fidelity.tolerance": 2e-3})  # fmt: skip


@pytest.fixture(scope="module")
def lonely():
    """A set of one on its own pedestal, and the mounted bearing that it is."""
    x = 0.5 * LENGTH
    given = sounding(
        "+", (x,), None, RPM, flaws=True, sound_keys=sound("compact", (x, 105.0, 0.0)),
        shaft={"sections_mm": [[LENGTH, 15.0, 0.0]]}, bearings=[{"seat": "pedestal"}],
        housing={"pedestal_stiffness_N_m": 1e8},
        load={"force_x_N": 500.0, "force_z_N": -20.0, "position_mm": x},
    )  # fmt: skip
    return given, single(given, x)


@pytest.mark.heavy
def test_sensitivity_of_a_set_of_one_is_that_of_the_single_bearing(lonely):
    keys = ("lubricant.traction_max", "bearing.inner_conformity")
    ours, own = (sensitivity(scene, keys, warm_up=0.01, window=0.02) for scene in lonely)
    assert len(ours.rows) == 4
    for mine, its in zip(ours.rows, own.rows, strict=True):
        assert (mine.key, mine.moved) == (its.key, its.moved)
        # starts differ by 4e-5 m/s of 2 mm/s: 2 % of a velocity, 0.1 dB of a level; means by far less
        assert mine.changes[:2] == pytest.approx(its.changes[:2], abs=0.02)
        assert mine.changes[2:5] == pytest.approx(its.changes[2:5], abs=2e-3)
        assert mine.changes[6] == pytest.approx(its.changes[6], abs=0.15)


def test_sensitivity_of_a_pair_shows_the_bearing_that_changed_most():
    study = sensitivity(pair(), ["spindle.preload.preload_N"], warm_up=5e-3, window=5e-3)
    less, more = study.rows
    # axial balance: a fifth of the preload is a fifth of the load over the sine of the angle, which grows by
    # a few per cent; centrifugal forces do not act at the inner race
    assert less.changes[2] == pytest.approx(-0.18, abs=0.03) and more.changes[2] == pytest.approx(
        0.18, abs=0.03
    )
    assert "of bearing 1" in study.markdown()
    given = pair()
    there = [key for key in ASSUMED if key.startswith("spindle.") and value_at(given, key) is not None]
    assert {"spindle.preload.preload_N", "spindle.shaft.flexible"} <= set(there)
    for key in there:
        assert any(moved != value_at(given, key) for moved in ASSUMED[key](value_at(given, key))), key


def test_points_of_changes_are_those_of_statics(lonely):
    ours, own = (point(scene) for scene in lonely)
    assert (ours.torque, ours.life) == pytest.approx((own.torque, own.life), rel=1e-4)
    given = pair()
    found, held = point(given), operating_point(given)
    assert found.torque == pytest.approx(1e3 * sum(one.friction_torque for one in held.bearings), rel=1e-12)
    # of ten of a hundred sets one bearing fails first: with lives L, L^(-10/9) add up
    lives = [one.life for one in held.bearings]
    assert found.life == pytest.approx(sum(one ** (-10 / 9) for one in lives) ** -0.9, rel=1e-9)
    # the flexibility at the nose of a rigid shaft: deflection per force, by the inverse of its matrix
    flexibility = np.linalg.inv(statics(given).stiffness)
    assert 1e6 * found.stiffness * flexibility[2, 2] == pytest.approx(1.0, rel=1e-9)


@pytest.mark.heavy
def test_levels_of_changes_are_those_of_two_recordings(monkeypatch):
    given = pair()
    choice = Alternative("preload", "more", {"spindle.preload.preload_N": 280.0})
    monkeypatch.setattr(room, "alternatives", lambda scene: [choice])
    found = changes(given, seeds=1)
    (row,) = found.changes
    basis = found.basis
    # the cages are loud at P2: 65.9 dB(A), of which rings have 61.1 and response 50.3
    assert basis.fidelity == "full" and basis.microphone == "P2"
    levels = [
        record(
            with_fidelity(scene, model=basis.fidelity), basis.duration, settle=basis.settle, progress=False
        ).levels(["P2"], weighting="A", resolution=20.0)[0]
        for scene in (given, given.replace(dict(choice.values)))
    ]
    assert row.levels[0] == pytest.approx(levels[1] - levels[0], abs=1e-9)
    assert row.ratio("life") < 0.6  # 1.4 ** -3 in pure axial load, less the growth of the angle
    assert "stiffness across at the nose" in found.unchanged()
    assert found.table()[1][0][0] == "more"


def test_choices_of_a_set():
    given = pair(
        shaft={"sections_mm": [[400.0, 17.0, 0.0]], "unbalance": [SPOT, SPOT | {"position_mm": 20.0}]},
        housing={"mass_kg": 2.0, "diameter_mm": 100.0, "length_mm": 160.0, "pedestal_stiffness_N_m": 1e8},
    )
    found = {one.words: one.values for one in alternatives(given)}
    assert found["preload 200 -> 140 N"] == {"spindle.preload.preload_N": 140.0}
    assert found["pedestal 100 -> 50 N/um"] == {"spindle.housing.pedestal_stiffness_N_m": 5e7}
    spots = found["unbalance of the shaft x0.5"]["spindle.shaft.unbalance"]
    assert [(one["position_mm"], one["amount_g_mm"]) for one in spots] == [(10.0, 0.1), (20.0, 0.1)]
    for values in found.values():
        given.replace(values)
    assert not any(one.topic in ("pedestal", "balance") for one in alternatives(pair()))


def test_preload_choices_by_kind():
    """A class is an offset of ground faces: uneven sets share it, springs have none, and some none at all."""
    uneven = Scene.from_dict(tables("++-", (30.0, 45.0, 70.0), 100.0))
    words = {one.words: one.values for one in alternatives(uneven) if one.topic == "preload"}
    medium = preload({"preload_class": "medium"}, uneven.bearing, uneven.materials).force
    shared = next(v["spindle.preload.preload_N"] for w, v in words.items() if w.endswith("medium"))
    assert 0.6 * medium < shared < 0.75 * medium  # flush faces: 0.68 of the pair's load each
    springs = uneven.replace(
        {"spindle.preload": {"kind": "spring", "force_N": 100.0}, "spindle.bearing[3].seat": "sliding"}
    )
    words = [one.words for one in alternatives(springs) if one.topic == "preload"]
    assert words == ["preload 100 -> 70 N", "preload 100 -> 140 N"]
    one_way = Scene.from_dict(tables("++", preload=None, load={"force_x_N": 300.0}))
    assert not [one for one in alternatives(one_way) if one.topic == "preload"]


@pytest.mark.heavy
def test_two_integrators_of_a_pair_agree():
    """The engine's explicit method at 40 ns and its implicit one share the equations alone."""
    agree, own = check(pair(), 5e-3, 1e-3)
    assert agree < 1e-7 and own < 1e-6


@pytest.mark.heavy
def test_tradeoff_of_a_pair():
    given = pair()
    warm_up, window = 0.01, 0.02
    settings = (Setting(), Setting(max_step=5e-6, tolerance=1e-4), Setting("rings"))
    study = tradeoff(given, settings, warm_up=warm_up, window=window, budget=0.01)
    coarse, fine, rings = study.rows
    assert study.pair < 1e-6 and study.agreement < 1e-5
    assert 0.0 < fine.trajectory < 0.3 * coarse.trajectory < 1e-2
    assert math.isnan(rings.trajectory) and rings.remark == ""
    # levels and torque by runs through the other door
    read = {}
    for model in ("full", "rings"):
        scene = with_fidelity(given, model=model).replace({"sound.metering_start_s": warm_up})
        kept = simulate(
            scene, warm_up + window, step=1e-4, outputs=["mic[1].leq_a", "mic[2].leq_a", "friction_torque"],
            progress=False,
        )  # fmt: skip
        levels = [kept[f"mic[{k}].leq_a"][-1] for k in (1, 2)]
        read[model] = levels, kept["friction_torque"][kept.time > warm_up + 1e-9].mean()
    apart = np.abs(np.subtract(read["rings"][0], read["full"][0])).max()
    assert rings.errors.level == pytest.approx(apart, abs=0.05)
    torque = abs(read["rings"][1] / read["full"][1] - 1.0)
    assert rings.errors.torque == pytest.approx(torque, abs=1e-3)
