"""Motion of the rings in fidelities `rings` and `response` beside `full`, within bounds that were measured.

The table of docs/results/quick_fidelities.md has the figures; bounds leave the runs of another machine room.
"""

import numpy as np
import pytest

from benchmarks.quick_fidelities import cases
from benchmarks.quick_gates import (
    HALF,
    QUICK,
    Drawn,
    drawn,
    farthest,
    grew,
    kicked,
    motion,
    ratios,
    said,
    terms,
)
from tests.engine.test_condensed_modes import assert_equal_poles
from tests.marks import heavy_but

SEED, COUNT = 52, 16
FASTEST = 100e3  # r/min: the limit of scenes
#: Missed by a ball motion of 0.018 mm/s that stays after the kick, and by unsteady balls.
STAYS = ("NSK-7906C-30000-heavy", "NSK-7906C-19100-half")
#: Of the gates of 5 % and 10 %, as found over 64 bearings: 0.88 to 1.14 at a class, 0.75 to 1.10 at half.
AT_A_CLASS, AT_HALF = (0.87, 1.16), (0.72, 1.12)


def of_full(scene, model, scale=1.0):
    """Least and largest ratio of the rings' rms velocities."""
    return farthest(ratios(scene, motion(scene, "full", scale=scale), motion(scene, model, scale=scale)))


def assert_kicked_as_full(scene):
    """A perfect bearing without a cage moves as in `full` after a kick: found within 2 %."""
    full, rings = (kicked(scene, model, cage=False) for model in ("full", "rings"))
    found = farthest(ratios(scene, full, rings))
    assert 0.97 < found[0] and found[1] < 1.03, (scene.name, found)


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("bearing", "rpm", "preload"),
    heavy_but(
        [("NSK-7910C", 11e3, "heavy"), ("NSK-7910AC", 18e3, "heavy"), ("NSK-7013AC", 7.3e3, "medium")], 0
    ),
)
def test_a_calm_bearing_is_within_the_gates(bearing, rpm, preload):
    """Found 0.98 to 1.01 in `rings` and 0.98 to 1.02 in `response`."""
    scene = Drawn(bearing, rpm, preload).scene()
    assert_kicked_as_full(scene)
    for model, within in (("rings", 0.05), ("response", 0.1)):
        assert np.abs(np.subtract(of_full(scene, model), 1.0)).max() < within
        assert said(scene, model) == ""


def assert_modes_of_full(share):
    """Complex frequencies below 30 kHz equal those of `full` without its cage, and no more grows.

    Found in all 1,134 scenes: within 1e-6 in 1,128 and 2.3e-6 in all, by the differences of `linearised`.
    """
    for what in ("grid", "drawn"):
        for case in cases(what, share, SEED):
            if case.rpm <= FASTEST:
                assert_equal_poles(case.scene(), 3e-6)


def test_a_share_of_the_catalogue_and_of_drawn_bearings_has_the_modes_of_full():
    assert_modes_of_full(0.01)


@pytest.mark.heavy
def test_the_catalogue_and_drawn_bearings_have_the_modes_of_full():
    assert_modes_of_full(0.3)


#: Least and largest ratio of `rings` and `response` with a tenth of the surfaces, by the start of the name.
TENTH = {
    # Missed: a cage beside a ring that tilts freely, waves under strong contact damping
    "7003C-bare": (0.92, 1.03),
    "7009C-full-ceramic": (0.95, 1.07),
    "7003C-spindle, contact damping 10": (0.98, 1.005),
    "7003C-spindle": (0.99, 1.005),
    "beside": (0.96, 1.03),
    "TBT": (0.985, 1.01),
    "QBC": (0.96, 1.09),
    "DB of 7003C, 60": (0.98, 1.03),
    "DB": (0.99, 1.01),
}


def bounds(what):
    return next(found for name, found in TENTH.items() if what.startswith(name))


def assert_terms(chosen):
    for what, scene in chosen:
        low, high = bounds(what)
        full = motion(scene, "full", scale=0.1)
        for model in QUICK:
            least, most = farthest(ratios(scene, full, motion(scene, model, scale=0.1)))
            assert low < least and most < high, (what, model, least, most)


@pytest.mark.heavy
def test_some_terms_and_sets_are_as_in_full():
    found = dict(terms())
    names = ("7003C-spindle, land clearance 0.3 mm", "DB of 7003C, bending shaft")
    assert_terms((name, found[name]) for name in names)


@pytest.mark.heavy
def test_all_terms_and_sets_are_as_in_full():
    assert_terms(terms())


@pytest.mark.heavy
def test_drawn_bearings_that_are_not_in_doubt():
    """At a class and at half of the lightest; those that move otherwise are named."""
    seen = 0
    for one in drawn(COUNT, SEED):
        scene = one.scene()
        low, high = AT_HALF if one.preload == HALF else AT_A_CLASS
        for model in QUICK:
            if said(scene, model) not in ("", "levels"):
                continue
            least, most = of_full(scene, model)
            assert low < least and most < high, (scene.name, model, least, most)
            if model == "rings" and scene.name not in STAYS:
                assert_kicked_as_full(scene)
                seen += 1
    assert seen >= COUNT // 2


@pytest.mark.heavy
def test_the_ten_that_diverged_are_as_in_full_or_named():
    """Across the axis 0.83 to 0.98 of `full` where nothing is said, 0.55 where it is."""
    for case in grew():
        scene = case.scene()
        full = motion(scene, "full")[1]
        for model in QUICK:
            ratio = motion(scene, model)[1] / full
            assert 0.5 < ratio < 1.05
            assert ratio > 0.8 or said(scene, model) == "velocities", (scene.name, model, ratio)
