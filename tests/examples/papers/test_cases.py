"""Cases of the papers: keys of recordings, changes of scenes, every case a scene."""

import numpy as np
import pytest

from examples.papers import printed
from examples.papers.case import SEEDS, Case
from examples.papers.identification import BOTH
from examples.papers.run import PAGES


def test_recordings_are_distinguished_by_motion_alone():
    base = Case("7003C-spindle", 20000)
    assert base.key("compact") == base.key("bem") != base.key("paper")
    others = [
        Case("7003C-spindle", 20000, (("imperfections.unbalance_um", 0.7),)),
        Case("7003C-spindle", 20000, seed=2),
        Case("7003C-spindle", 20000, duration=0.2),
        Case("7003C-bare", 20000),
    ]
    assert len({one.key("compact") for one in (base, *others)}) == 5


def test_changes_reach_the_scene_and_the_later_one_counts():
    changes = (("imperfections.unbalance_um", 0.7), ("imperfections.unbalance_um", 0.9))
    flexure = (("mounting.flexure.outer_ring", (2, 3)), ("bearing.ball_springs", None))
    scene = Case("7003C-impact", 26000, (*changes, *flexure), seed=5).build()
    assert (scene.imperfections.unbalance_um, scene.imperfections.seed) == (0.9, 5)
    assert scene.operation.speed_rpm == 26000.0
    assert scene.mounting.flexure.outer_ring == (2, 3) and scene.bearing.ball_springs is None


@pytest.mark.parametrize("module", [*PAGES.values(), printed], ids=[*PAGES, "printed"])
def test_every_case_is_a_scene(module):
    changes = tuple((key, 0.5) for key in BOTH)
    found = module.cases(SEEDS, False) if module is printed else module.cases(changes, SEEDS, False)
    assert len(set(found)) == len(found)
    assert {one.seed for one in found} == set(SEEDS)
    speeds = {one.rpm for one in found}
    assert {value.rpm for value in module.VALUES} <= speeds  # every value of the paper is run
    for one in {(case.scene, case.changes, case.label): case for case in found}.values():
        assert one.build().operation.speed_rpm == one.rpm


def test_three_directions_hear_all_of_a_vector():
    places = np.array(printed.directions(0.105))
    cosines = places / np.linalg.norm(places, axis=1)[:, None]
    assert np.abs(cosines.T @ cosines) == pytest.approx(np.eye(3), abs=1e-12)
