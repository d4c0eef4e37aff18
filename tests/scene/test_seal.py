"""Seals in a scene: what they take from the shaft, and what is refused."""

import pytest

from fmu_bearing.scene import SceneError, read_scene
from tests.conftest import EXAMPLES

SCENE = EXAMPLES / "7009C-steel.toml"  # 45 x 75 mm, 15 deg


def sealed(**seal):
    return read_scene(SCENE).replace({"bearing.seal": seal}).bearing


def flat(**seal):
    """The same balls as a deep groove bearing's."""
    kind = {"kind": "deep-groove", "contact_angle_deg": None, "radial_clearance_um": 12.0}
    changes = {f"bearing.{key}": value for key, value in kind.items()}
    return read_scene(SCENE).replace(changes | {"bearing.seal": seal, "mounting.preload_N": 0.0}).bearing


def test_without_seals_there_is_no_torque():
    bearing = read_scene(SCENE).bearing
    assert bearing.seal is None and bearing.seal_torque == 0.0 and bearing.lip_diameter is None


def test_the_formula_takes_the_row_of_its_bearing():
    # 0.014 d_s^2 + 10 of angular contact bearings; 0.018 d_s^2.25 + 20 of deep groove ones of 62 to 80 mm
    assert sealed(kind="RS1", lip_diameter_mm=57.0).seal_torque == pytest.approx(0.014 * 57.0**2 + 10.0)
    assert flat(kind="RS1", lip_diameter_mm=54.0).seal_torque == pytest.approx(0.018 * 54.0**2.25 + 20.0)
    assert sealed(kind="RS1", lip_diameter_mm=57.0, sides=1).seal_torque == pytest.approx(27.743)
    assert sealed(kind="RZ").seal_torque == 0.0


def test_a_lip_that_is_not_given_lies_by_the_section():
    # 45 + 0.40 (75 - 45), and 45 + 0.33 (75 - 45)
    assert sealed(kind="RS1").lip_diameter == pytest.approx(57.0)
    assert flat(kind="RS1").lip_diameter == pytest.approx(54.9)


def test_a_torque_takes_the_place_of_the_formula():
    assert sealed(torque_N_mm=35.0).seal_torque == 35.0
    assert sealed(kind="RS1", torque_N_mm=35.0).seal_torque == 35.0
    assert sealed(kind="RSH", torque_N_mm=35.0).seal_torque == 35.0  # of which no row is read


@pytest.mark.parametrize(
    ("make", "seal", "words"),
    [
        (sealed, {}, ("bearing.seal.kind", "torque_N_mm", "RZ, RSL, RSH, RS1")),
        (
            sealed,
            {"kind": "RSH"},
            ("bearing.seal.kind", "RSH", "angular contact", "RZ and RS1", "torque_N_mm"),
        ),
        (flat, {"kind": "RSH"}, ("bearing.seal.kind", "75 mm", "above 0 up to 52 mm", "torque_N_mm")),
        (flat, {"kind": "LS"}, ("bearing.seal.kind", "LS")),
        (flat, {"kind": "RS1", "lip_diameter_mm": 80.0}, ("bearing.seal.lip_diameter_mm", "45", "75")),
        (sealed, {"torque_N_mm": -1.0}, ("bearing.seal.torque_N_mm", "N mm")),
        (sealed, {"kind": "RS1", "sides": 3}, ("bearing.seal.sides", "3")),
    ],
)
def test_what_is_refused_says_why(make, seal, words):
    with pytest.raises(SceneError) as refused:
        make(**seal)
    for word in words:
        assert word in str(refused.value)
