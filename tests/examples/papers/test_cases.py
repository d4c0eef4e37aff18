"""Cases of the papers: keys of recordings, changes of scenes, every case a scene."""

import numpy as np
import pytest

from examples.papers.case import Case
from examples.papers.identification import BOTH
from examples.papers.reduced import directions


def test_recordings_are_distinguished_by_motion_alone():
    base = Case("7003C-spindle", 20000)
    assert base.key("compact") == base.key("bem") != base.key("paper")
    others = [
        Case("7003C-spindle", 20000, (("imperfections.unbalance_um", 0.7),)),
        Case("7003C-spindle", 20000, seed=2),
        Case("7003C-spindle", 20000, duration=0.2),
        Case("7003C-spindle", 20000, around=1.01),
        Case("7003C-spindle", 20000, jump_from=500.0),
        Case("7003C-bare", 20000),
    ]
    assert len({one.key("compact") for one in (base, *others)}) == 7
    assert base.key("paper_contacts") != base.key("compact")


def test_changes_reach_the_scene_and_the_later_one_counts():
    changes = (("imperfections.unbalance_um", 0.7), ("imperfections.unbalance_um", 0.9))
    flexure = (("mounting.flexure.outer_ring", (2, 3)), ("bearing.ball_springs", None))
    scene = Case("7003C-impact", 26000, (*changes, *flexure), seed=5).build()
    assert (scene.imperfections.unbalance_um, scene.imperfections.seed) == (0.9, 5)
    assert scene.operation.speed_rpm == 26000.0
    assert scene.mounting.flexure.outer_ring == (2, 3) and scene.bearing.ball_springs is None


def test_three_directions_hear_all_of_a_vector():
    places = np.array(directions(0.105))
    cosines = places / np.linalg.norm(places, axis=1)[:, None]
    assert np.abs(cosines.T @ cosines) == pytest.approx(np.eye(3), abs=1e-12)


def test_a_jump_starts_at_rest_and_ends_at_the_speed():
    """Without friction and waves a ring may jump to any speed: nothing sounds, and the balls stay behind."""
    silent = tuple((key, 0.0) for key in BOTH)
    jump = Case("7003C-impact", 10000, silent, settle=0.0, duration=0.01, jump_from=500.0)
    recording = jump.recording("compact")
    assert recording.speed_points[-1] == pytest.approx(10000 * np.pi / 30)
    assert float(recording.levels(weighting="A").max()) < 0.0
