"""The table of flexure: what it means, what is refused, what does not go with it."""

import pytest

from fmu_bearing.scene import SceneError, read_scene_text, si
from tests.elastic.rings import bent, text_with
from tests.messages import says

LINES = "outer_ring = [2, 4]\ninner_ring = [3]\n"


def refused(name, flexure):
    with pytest.raises(SceneError) as caught:
        bent(name, flexure)
    return [line.removeprefix("scene: mounting.flexure.") for line in caught.value.problems]


def test_values_and_defaults():
    flexure = si(bent("7003C-bare", LINES + "outer_seat_stiffness_N_m = 1e7").mounting.flexure)
    assert (flexure.outer_ring, flexure.inner_ring) == ((2, 4), (3,))
    assert flexure.damping_ratio == 0.005
    assert (flexure.outer_seat_stiffness, flexure.inner_seat_stiffness) == (1e7, 0.0)


def test_absent_table_means_rigid_rings_and_an_empty_one_no_order(scene):
    assert scene("7003C-spindle").mounting.flexure is None
    flexure = bent("7003C-spindle", "").mounting.flexure
    assert flexure.outer_ring == flexure.inner_ring == ()


def test_written_table_reads_back_equal():
    scene = bent("7003C-bare", LINES)
    assert read_scene_text(scene.to_toml()) == scene
    assert "outer_ring" in text_with("7003C-bare", LINES)


@pytest.mark.parametrize(
    ("line", "expected"),
    [
        ("outer_ring = [1]", "outer_ring[1] = 1 is refused; allowed: at most 7 whole numbers from 2 to 8"),
        ("inner_ring = [2, 9]", "inner_ring[2] = 9 is refused; allowed: at most 7 whole numbers from 2 to 8"),
        ("outer_ring = [2.5]", "outer_ring[1] = 2.5 is refused; allowed: at most 7 whole numbers"),
        ("outer_ring = [true]", "outer_ring[1] = true is refused; allowed: at most 7 whole numbers"),
        ('outer_ring = ["2"]', "outer_ring[1] = '2' is refused; allowed: at most 7 whole numbers"),
        ("outer_ring = 2", "outer_ring = 2 is refused; allowed: at most 7 whole numbers from 2 to 8"),
        ("outer_ring = [2, 3, 4, 5, 6, 7, 8, 8]", "outer_ring has 8 members; allowed: at most 7"),
        ("outer_ring = [3, 2]", "outer_ring: must rise, each order once: [2, 3]"),
        ("inner_ring = [2, 2]", "inner_ring: must rise, each order once: [2]"),
        ("damping_ratio = 0.6", "damping_ratio = 0.6 is refused; allowed: 0 to 0.5"),
        ("damping_ratio = -1e-9", "damping_ratio = -1e-09 is refused; allowed: 0 to 0.5"),
        (
            "outer_seat_stiffness_N_m = -1",
            "outer_seat_stiffness_N_m = -1 is refused; allowed: 0 to 1e+12 N/m",
        ),
        (
            "inner_seat_stiffness_N_m = 1e13",
            "inner_seat_stiffness_N_m = 10000000000000.0 is refused; allowed",
        ),
        ("outer_rings = [2]", "outer_rings is not a key of a scene; did you mean 'outer_ring'?"),
    ],
)
def test_refusals(line, expected):
    (reported,) = refused("7003C-bare", line)
    assert reported.startswith(expected)


@pytest.mark.parametrize(("ring", "body"), [("inner", "rotor"), ("outer", "housing")])
def test_a_ring_on_a_tight_seat_does_not_bend(ring, body):
    (reported,) = refused("7003C-spindle", f"{ring}_ring = [2]")
    ways = f"{ring}_ring = [] ... {ring}_seat_stiffness_N_m ... leave out the {body}"
    assert says(reported, f"{ring}_ring ... [mounting.{body}] ... {ways}")
    loose = bent("7003C-spindle", f"{ring}_ring = [2]\n{ring}_seat_stiffness_N_m = 1e6")
    assert getattr(loose.mounting.flexure, f"{ring}_ring") == (2,)


def test_problems_of_both_rings_come_together():
    assert len(refused("7003C-spindle", "outer_ring = [2]\ninner_ring = [2]")) == 2
