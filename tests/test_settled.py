"""Runs of `full` beside the operating point: which bearings, the table's arithmetic, some of its rows."""

import math
from collections import Counter
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest

from benchmarks import settled
from benchmarks.settled import NEAR, Compared, Means
from fmu_bearing import modes
from fmu_bearing.design.heat import Heat
from fmu_bearing.scene.nsk import sizes
from tests.tables import table

CASES = {one.name: one for one in settled.cases()}


def test_bearings_are_chosen_by_their_place_in_the_catalogue():
    names = list(sizes())
    catalogue = [name for name in CASES if name in names]
    assert len(catalogue) == 20 and catalogue == names[::3]
    bores = [sizes()[name].bore for name in catalogue]
    # the catalogue has 10 to 70 mm; the third from the end of a series has 65
    assert (min(bores), max(bores)) == (10.0, 65.0)
    assert [CASES[name].bearing.bore for name in CASES if name not in names] == [80.0, 100.0]


@pytest.mark.parametrize("angle", ["C", "AC"])
def test_both_angles_have_all_kinds_classes_and_speeds(angle):
    of_angle = [
        one for name, one in CASES.items() if name in sizes() and name.endswith("AC") == (angle == "AC")
    ]
    assert Counter(one.kind for one in of_angle) == {"hybrid": 5, "steel": 5}
    assert set(Counter(one.preload_class for one in of_angle).values()) == {3, 4}
    assert set(Counter(one.share for one in of_angle).values()) == {2}


def test_scenes_are_fresh_and_at_their_share_of_the_speed():
    scene = CASES["NSK-7913AC"].scene()
    # 1.88e6 mm r/min: GMN's limit at 25 deg with ceramic balls, of d_m = 77.5 mm, to three digits
    assert scene.operation.speed_rpm == 19400.0
    assert scene.mounted.preload_N == sizes()["NSK-7913AC"].preload["light"].force == 200.0
    assert scene.materials.kind == "hybrid" and scene.mounted.tilt_support is not None
    assert CASES["NSK-7913AC"].scene(supported=False).mounted.tilt_support is None


def means(torque, cage=0.44):
    heat = Heat(sliding=1.0, rolling=2.0, cage=3.0, drag=4.0, inner_ring=1.0, outer_ring=1.0, oil=8.0)
    return Means(torque, cage, heat, ring=1e-6, turns=800.0)


def found(own, elsewhere, whirl=None, steady=True, weightless=math.nan):
    one = SimpleNamespace(friction_torque=0.1, heat=means(0.1).heat, speed_number=1.2e6)
    scene = CASES["NSK-7913AC"].scene()
    point = SimpleNamespace(scene=scene, bearings=(one,), whirl=whirl, steady=steady)
    runs = means(own), means(elsewhere, 0.33)
    return Compared(CASES["NSK-7913AC"], point, settled.WHIRL, 0.44, *runs, weightless, 1.0)


@pytest.mark.parametrize(
    ("case", "verdict"),
    [
        (found(0.1, 0.1), "agrees"),
        (found(0.1 * (1.0 + 0.9 * NEAR), 0.1 * (1.0 - 0.9 * NEAR), whirl=(800.0, 5.0)), "agrees"),
        (found(0.1 * (1.0 + 1.1 * NEAR), 0.1, whirl=(800.0, 5.0)), "named"),
        (found(0.1, 0.1 * (1.0 - 1.1 * NEAR), whirl=(800.0, 5.0)), "named"),
        (found(0.1, 0.12, whirl=(1700.0, 5.0)), "other"),
        (found(0.1, 0.12, steady=False), "unsteady"),
        (found(0.1, 0.12, weightless=1.0), "weight"),
        (found(0.1, 0.12, weightless=1.1), "missed"),
    ],
)
def test_a_case_that_is_off_has_a_reason_or_is_missed(case, verdict):
    assert case.verdict == verdict
    # a torque that is not a number agrees with nothing
    assert replace(case, own=means(math.nan), elsewhere=means(math.nan)).verdict != "agrees"


def test_cells_of_a_row():
    row = dict(zip(settled.COLUMNS, found(0.12, 0.05, whirl=(800.0, 5.0)).cells(), strict=True))
    assert (row["torque of the point, N mm"], row["of full"], row["ratio"]) == ("100.00", "120.00", "1.200")
    assert (row["ratio from elsewhere"], row["cage speed"]) == ("0.500", "1.0000")
    assert (row["cage speed from elsewhere"], row["growth, 1/s"], row["at, Hz"]) == ("0.7500", "5", "800")
    assert (row["cage, W"], row["ring, um"], row["ratio without weight"]) == ("3 / 3", "1", "")
    assert settled.summary([found(0.1, 0.1, (800.0, 5.0)), found(0.1, 0.2)]) == (
        "2 bearings, verdicts: agrees 1, named 0, other 0, unsteady 0, weight 0, missed 1. "
        "A whirl is named of 1."
    )


def test_how_a_ring_moves_is_read_from_its_path():
    times = np.arange(1000) * 1e-4
    path = 3e-6 * np.exp(-2j * np.pi * 870.0 * times) + 1e-6 * np.exp(2j * np.pi * 200.0 * times)
    # whole numbers of turns: rounding alone
    assert settled.moved(path, 1e-4) == pytest.approx((1e-6 * math.sqrt(10.0), -870.0), rel=1e-9)


def test_the_table_has_every_case_and_nothing_is_missed():
    rows = table("settled")
    assert [one["bearing"] for one in rows] == 2 * list(CASES)
    assert all(one["verdict"] != "missed" for one in rows)
    for one in rows:
        off = max(abs(float(one[key]) - 1.0) for key in ("ratio", "ratio from elsewhere"))
        # the table's third decimal
        assert off <= NEAR + 5e-4 if one["verdict"] == "agrees" else off >= NEAR - 5e-4
        assert (one["verdict"] in ("named", "other")) <= bool(one["growth, 1/s"])


@pytest.mark.heavy
@pytest.mark.parametrize("name", ["NSK-7001AC", "NSK-7010AC", "NSK-7006C"])
def test_full_settles_at_the_point(name):
    """A cage at rest, a whirling one, and a fast one: torque from both starts within what the table asks."""
    one = settled.compared(CASES[name])
    assert one.point.whirl is None and one.point.steady
    assert one.ratios == pytest.approx((1.0, 1.0), abs=NEAR)
    # the gate of the steady state, `tests/engine/test_steady_gates.py`
    assert (one.own.cage, one.elsewhere.cage) == pytest.approx((one.cage, one.cage), rel=2e-3)
    heat, run = one.point.bearings[0].heat, one.own.heat
    for share in ("sliding", "rolling", "cage", "drag"):
        # of all heat: a share may be a hundredth of it
        assert getattr(run, share) == pytest.approx(getattr(heat, share), abs=NEAR * heat.total)
    assert one.weightless == pytest.approx(1.0, abs=NEAR)


@pytest.mark.heavy
def test_a_ring_that_whirls_in_full_was_named():
    """Growth of 707 1/s at 1,246 Hz: `full` has 12 % more torque, and its ring turns at that frequency."""
    one = settled.compared(CASES["NSK-7013AC"])
    assert one.verdict == "named"
    frequency, growth = one.point.whirl
    assert growth > 100.0 and min(one.ratios) > 1.0 + NEAR
    # the mode is that of small motions, and this one is limited by its size
    assert one.elsewhere.turns == pytest.approx(frequency, rel=0.1)


@pytest.mark.heavy
def test_a_backward_whirl_of_ring_and_cage_is_driven_by_the_film_of_the_lands():
    """Without cage, as modes are, it decays. With a tenth of the film's drag the forward whirl is left."""
    scene = CASES["NSK-7003C"].scene(supported=False)
    (backward,) = (
        one for one in modes(scene).modes if one.direction == "backward" and 500.0 < one.frequency < 900.0
    )
    assert backward.growth < -100.0
    thick, thin = (
        settled.settled(settled.started(scene.replace({"lubricant.land_viscosity_Pa_s": film})), 0.2)
        for film in (6e-3, 6e-4)
    )
    # the cage adds to the ring's mass: a tenth below the mode
    assert thick.turns == pytest.approx(-backward.frequency, rel=0.15)
    assert thin.turns > 1500.0
