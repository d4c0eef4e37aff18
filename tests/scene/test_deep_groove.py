"""Keys, catalogue and new scenes of deep groove bearings."""

import math

import numpy as np
import pytest

from fmu_bearing import Scene, SceneError, new_scene
from fmu_bearing.engine.layout import P
from fmu_bearing.formulas import clearances, iso76, iso281
from fmu_bearing.prepare.model import pack
from fmu_bearing.scene import deep_groove, read_scene_text
from fmu_bearing.scene.bearing import Bearing
from fmu_bearing.scene.dimension_series import boundary
from fmu_bearing.scene.read import catalogue
from tests.deep_groove import PUBLISHED, scene_of

SIZES = deep_groove.sizes()
ENTRY = catalogue("bearings")["6205"]


def tables():
    """A scene of the published size as a file has it."""
    return scene_of(PUBLISHED).model_dump(exclude_none=True)


def refusal(**bearing):
    """What is said of a scene whose bearing has other keys; None takes one out."""
    data = tables()
    data["bearing"] = {key: value for key, value in (data["bearing"] | bearing).items() if value is not None}
    with pytest.raises(SceneError) as refused:
        Scene.from_dict(data)
    return str(refused.value)


def test_one_key_gives_the_clearance():
    assert scene_of(PUBLISHED).bearing.radial_clearance == 0.0
    missing = refusal(radial_clearance_um=None)
    assert missing.startswith("deep-groove: bearing.radial_clearance_um is missing, for example ")
    assert "bearing.clearance = 'CN' cannot be given with radial_clearance_um" in refusal(clearance="CN")
    assert "bearing.contact_angle_deg = 15.0 is of angular contact bearings" in refusal(
        contact_angle_deg=15.0
    )
    assert "bearing.contact_angle_deg is missing" in refusal(kind="angular-contact", radial_clearance_um=None)
    other = refusal(kind="angular-contact", contact_angle_deg=15.0)
    assert "bearing.radial_clearance_um = 0.0 is of deep groove bearings" in other
    assert "bearing.kind = 'roller' is refused; allowed: angular-contact, deep-groove" in refusal(
        kind="roller"
    )
    # 2 A (1 - cos 45 deg), A 0.575 mm
    assert "bearing.radial_clearance_um = 400.0 must be below 337" in refusal(radial_clearance_um=400.0)


@pytest.mark.parametrize(
    ("bore", "group", "um"),
    [(10.0, "CN", 7.5), (10.5, "CN", 10.5), (18.0, "C3", 18.0), (25.0, "C2", 6.0), (50.0, "C4", 40.5)],
)
def test_the_middle_of_a_group(bore, group, um):
    assert clearances.limits(group, bore).middle == um


def test_groups_have_the_rows_of_the_specification():
    """ISO 5753-1 as the specification has it: bores up to 18, 24, 30, 40, 50 and 65 mm."""
    rows = {
        18: (0, 9, 3, 18, 11, 25), 24: (0, 10, 5, 20, 13, 28), 30: (1, 11, 5, 20, 13, 28),
        40: (1, 11, 6, 20, 15, 33), 50: (1, 11, 6, 23, 18, 36), 65: (1, 15, 8, 28, 23, 43),
    }  # fmt: skip
    for bore, row in rows.items():
        assert sum((clearances.limits(group, bore) for group in ("C2", "CN", "C3")), ()) == row
    assert clearances.limits("CN", 121.0) is None and clearances.limits("CN", 2.0) is None
    assert "is known for bores of 2.5 to 120 mm" in refusal(
        clearance="CN", radial_clearance_um=None, bore_mm=2.0
    )


def test_grooves_lie_in_the_middle_plane():
    """R_ci = d_m/2 + (f_i - 1/2) D - G_r/4 and R_co = d_m/2 - (f_o - 1/2) D + G_r/4."""
    p = pack(scene_of(PUBLISHED).replace({"bearing.radial_clearance_um": 12.0}), np.empty(0))
    blocks = [p[P.RACES + race * P.RACE_SIZE :][: P.RACE_SIZE] for race in range(2)]
    assert [block[P.RACE_GROOVE_X] for block in blocks] == [0.0, 0.0]
    radii = [21.75 + 0.02 * 11.5 - 0.003, 21.75 - 0.03 * 11.5 + 0.003]
    assert [block[P.RACE_GROOVE_RADIUS] for block in blocks] == pytest.approx(
        [1e-3 * r for r in radii], rel=1e-14
    )


def test_a_scene_reads_back():
    scene = scene_of(PUBLISHED)
    assert read_scene_text(scene.to_toml()) == scene
    other = scene.replace({"bearing.clearance": "C3"})
    assert other.bearing.radial_clearance_um is None and other.bearing.clearance == "C3"
    again = other.replace({"bearing.radial_clearance_um": 5.0})
    assert again.bearing.clearance is None and again.bearing.radial_clearance == pytest.approx(5e-6)


@pytest.mark.parametrize("name", SIZES)
def test_sizes_of_the_catalogue(name):
    """33 bearings: boundary dimensions by ISO 15, ratings of the derived balls within 2 % of print."""
    size, entry = SIZES[name], catalogue("bearings")[name]
    assert boundary({"60": "0", "62": "2", "63": "3"}[name[:2]], size.bore) == (size.outside, size.width)
    assert name[:2] in deep_groove.SERIES and deep_groove.LEAST_BORE <= size.bore <= deep_groove.MOST_BORE
    bearing = Bearing.model_validate(entry)
    assert (bearing.kind, bearing.clearance, bearing.designation) == ("deep-groove", "CN", name)
    found = bearing.for_ratings
    within = 0.02 if name in ("6303", "6310") else 0.01
    assert iso281.dynamic_rating(*found) == pytest.approx(size.dynamic, rel=within)
    assert iso76.static_rating(*found) == pytest.approx(size.static, rel=within)


def test_the_catalogue_is_whole():
    assert len(SIZES) == 33
    text = deep_groove.entry_text(SIZES["6205"])
    assert (
        "ball_count = 9 # assumed: derived from C 14000 N and C0 7850 N (NSK) by ISO 281 and ISO 76" in text
    )


def test_new_scenes():
    text = new_scene("motor", "6205", clearance="C3", radial_load_N=500.0, sound=False)
    scene = read_scene_text(text)
    assert scene.bearing.clearance == "C3" and scene.bearing.radial_clearance == pytest.approx(20.5e-6)
    assert (scene.mounting.radial_load_z_N, scene.mounting.preload_N) == (-500.0, 0.0)
    assert scene.materials.kind == "steel" and scene.operation.speed_rpm == 6490.0
    usual = new_scene("motor", "6205", sound=False)
    assert "radial_load_z_N = -701.0 # assumed: 0.05 C, a light load" in usual  # C 14,019 N
    preloaded = read_scene_text(new_scene("motor", "6205", preload_N=-100.0, speed_rpm=3e3, sound=False))
    assert (preloaded.mounting.preload_N, preloaded.mounting.radial_load_z_N) == (-100.0, 0.0)
    for bearing, keys, words in (
        ("7003C", {"clearance": "C3"}, "is of a deep groove bearing"),
        ("6205", {"arrangement": "DB"}, "new scenes of sets are without deep groove bearings"),
        ("6205", {"preload_class": "light"}, "mounting.preload_class is of angular contact bearings"),
        ("6205", {"stiffness_N_um": 50.0, "stiffness_preload_N": 100.0}, "no axial stiffness of deep groove"),
    ):
        with pytest.raises(SceneError, match=words):
            new_scene(
                "a",
                bearing,
                sound=False,
                speed_rpm=3e3,
                preload_N=1.0 if "pre" not in str(keys) else None,
                **keys,
            )


def test_free_and_nominal_angle():
    """cos(alpha_f) = 1 - G_r/(2 A); balls that are pressed touch at 0."""
    size = Bearing.model_validate(ENTRY)
    assert math.cos(size.free_angle) == pytest.approx(1.0 - 12.5e-3 / (2.0 * 0.05 * 7.938))
    assert size.nominal_angle == size.nominal_angle_deg == 0.0
    pressed = Bearing.model_validate(
        {key: value for key, value in ENTRY.items() if key != "clearance"} | {"radial_clearance_um": -5.0}
    )
    assert pressed.free_angle == 0.0
    angular = Bearing.model_validate(catalogue("bearings")["7003C"])
    assert angular.free_angle == angular.nominal_angle == math.radians(15.0)
