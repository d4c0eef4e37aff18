"""The rig of the vibration test: what of a scene it keeps, what it sets, and what it refuses."""

import pytest

from fmu_bearing import read_scene, with_fidelity
from fmu_bearing.elastic.modes import ring_modes
from fmu_bearing.scene import SceneError
from fmu_bearing.vibration_test.anderon import micrometres
from fmu_bearing.vibration_test.rig import bands, rig
from fmu_bearing.vibration_test.subject import subject
from fmu_bearing.vibration_test.vibration import checked_values, vibration
from tests.conftest import ROOT

PAIR = ROOT / "examples" / "spindle_set" / "7003C-DB.toml"
PORT = ROOT / "examples" / "port" / "7003C-DB-port.toml"


@pytest.fixture(scope="module")
def bearing():
    return subject("7003C")


def test_geometry_oil_and_surfaces_are_the_scenes(bearing):
    tested = rig(bearing)
    for kept in ("bearing", "materials", "lubricant"):
        assert getattr(tested, kept) == getattr(bearing, kept)
    changed = {"unbalance_um": 0.0, "highest_frequency_kHz": 10.0}
    assert tested.imperfections == bearing.imperfections.model_copy(update=changed)
    assert tested.sound is None and not tested.fidelity.terms.gravity and tested.fidelity.model == "full"
    mounting = tested.mounting
    assert mounting.flexure.outer_ring == (2, 3, 4) and mounting.flexure.inner_ring == ()
    assert (mounting.rotor.mass_kg, mounting.fit, mounting.housing) == (1000.0, None, None)
    assert {value for key, value in tested.operation if "temperature" in key} == {22.0}
    assert (tested.operation.speed_rpm, mounting.preload_N) == (1800.0, 100.0)


def test_pieces_differ_in_their_rubber_and_rigid_rings_in_nothing_else(bearing):
    soft, firm = rig(bearing), rig(bearing, piece="firm")
    keys = ("pedestal_stiffness_N_m", "pedestal_damping_ratio")
    assert [getattr(soft.mounting, key) for key in keys] == [1e5, 0.1]
    assert [getattr(firm.mounting, key) for key in keys] == [1e6, 0.5]
    assert rig(bearing, rigid=True) == soft.with_rigid_rings()


@pytest.mark.parametrize(
    ("outside", "speed", "load"),
    [
        (10.0, 1800, 30), (25.0, 1800, 30), (26.0, 1800, 100), (100.0, 1800, 225), (101.0, 900, 600),
        (150.0, 900, 975), (200.0, 900, 1350),
    ],
)  # fmt: skip
def test_speed_and_load_go_by_the_outside_diameter(bearing, outside, speed, load):
    from fmu_bearing.vibration_test.rig import operation

    sized = bearing.bearing.model_copy(update={"outside_diameter_mm": outside})
    scene = bearing.model_copy(update={"bearing": sized})
    assert operation(scene) == (speed, load)
    assert bands(scene)["M"] == ((300.0, 1800.0) if outside <= 100.0 else (150.0, 900.0))


def test_a_set_is_tested_by_its_bearing_as_if_it_were_alone():
    pair = read_scene(PAIR)
    alone = subject("7003C").model_copy(
        update={name: getattr(pair, name) for name in ("name", "bearing", "materials", "lubricant")}
        | {"fidelity": pair.fidelity, "imperfections": pair.imperfections}
    )
    assert rig(pair) == rig(alone)
    assert rig(read_scene(PORT)).mounting == rig(alone).mounting  # another model's shaft plays no part


def test_a_grade_takes_the_place_of_a_scenes_surfaces():
    pair = read_scene(PAIR)
    for given in (pair, pair.model_copy(update={"imperfections": None}), subject("7003C", grade="P5")):
        found = subject(given, grade="P2").imperfections
        assert (found.inner_race_amplitude_um, found.ball_diameter_spread_nm) == (0.15, 30.0)


@pytest.mark.parametrize("outside", [9.0, 210.0])
def test_other_sizes_need_speed_and_load(bearing, outside):
    sized = bearing.bearing.model_copy(update={"outside_diameter_mm": outside})
    scene = bearing.model_copy(update={"bearing": sized})
    words = f"outside_diameter_mm = {outside:g}: the vibration test is for 10 to 200 mm; give both --speed"
    for given in ({}, {"speed_rpm": 900.0}, {"load_N": 100.0}):
        with pytest.raises(SceneError, match=words):
            rig(scene, **given)


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"piece": "hard"}, "there is no loading piece 'hard': choose from soft, firm"),
        ({"speed_rpm": 0.0}, "at 0 r/min: the inner ring has to turn"),
        ({"speed_rpm": float("nan")}, "at nan r/min"),
        ({"load_N": 0.0}, "with 0 N: give an axial load above 0 N"),
        ({"load_N": -5.0}, "with -5 N"),
        ({"load_N": 1e5}, r"mounting.preload_N = 100000.0 is out of range|mounting.preload_N"),
    ],
)
def test_values_that_are_no_test_are_refused(bearing, values, words):
    with pytest.raises(SceneError, match=words):
        rig(bearing, **values)


@pytest.mark.parametrize("model", ["rings", "response"])
def test_fidelities_with_rigid_rings_are_for_rigid_rings(bearing, model):
    scene = with_fidelity(bearing, model=model)
    with pytest.raises(SceneError, match="cannot have a vibration test: its sensor touches the outer ring"):
        rig(scene)
    assert rig(scene, rigid=True).fidelity.model == model
    assert rig(with_fidelity(bearing, model="auto")).fidelity.model == "full"


def test_waves_that_would_be_sampled_as_others_are_refused(bearing):
    # f_r - f_c is 17.51 Hz: order 715 of the inner race passes a ball 12,518 times per second, 712 12,466
    for order in (712, 715):
        harmonic = [{"order": order, "amplitude_um": 0.01}]
        scene = bearing.replace(
            {"imperfections.inner_race_amplitude_um": None, "imperfections.inner_race_harmonic": harmonic}
        )
        if order == 712:
            rig(scene)
            continue
        words = r"above the 12.5 kHz that it samples; leave out the highest orders of \[\[imperfections.inner"
        with pytest.raises(SceneError, match=words):
            rig(scene)
    with pytest.raises(SceneError, match="leave out imperfections.highest_order"):
        rig(bearing.replace({"imperfections.highest_order": 900}))


@pytest.mark.parametrize(
    ("given", "words"),
    [
        (("7003X",), "7003X is neither a scene file .* nor a bearing of the catalogue; "),
        (("absent.toml",), "absent.toml: "),
        (("7003C", "wooden"), "there is no kind of bearing 'wooden'"),
        (("7003C", None, "P9"), "'P9'|\"P9\""),
        ((subject("7003C"), "steel"), "--kind steel .* a scene has its own materials"),
        ((subject("7003C").model_copy(update={"imperfections": None}),), "has no .*: give a tolerance class"),
    ],
)
def test_what_is_no_subject_is_refused(given, words):
    with pytest.raises(SceneError, match=words):
        subject(*given)


def test_limits_are_three_in_um_s_or_anderon(bearing):
    scene = rig(bearing)
    assert checked_values([52, 18, 18], scene, "um/s", "limits") == (52.0, 18.0, 18.0)
    ours = checked_values([1, 1, 1], scene, "anderon", "limits")
    # 7.698 um/s: Sugawara Laboratories, of a third of the octaves from 50 Hz to 10.8 kHz
    assert ours[:2] == pytest.approx([7.698, 7.698], abs=5e-4)
    assert ours[2] == pytest.approx(0.0254 * 188.496 * 2.4739**0.5, rel=1e-4)
    for wrong in ([52, 18], [52, 0, 18], [52, 2e4, 18], [52, float("nan"), 18]):
        with pytest.raises(ValueError, match=r"^limits: "):
            checked_values(wrong, scene, "um/s", "limits")
    with pytest.raises(ValueError, match="unit = mm/s: choose from um/s, anderon"):
        micrometres(scene, "mm/s")


@pytest.mark.parametrize("seeds", [0, 1.5, True, 2000])
def test_a_number_of_seeds_is_whole(seeds):
    with pytest.raises(ValueError, match=f"seeds = {seeds}: give a whole number from 1 to 1000"):
        vibration("7003C", seeds)


def test_the_outside_surface_moves_nearly_as_the_groove(bearing):
    """The reading takes the bending at the groove: the skin of a 7003C moves 1 to 2 % more (n = 2 to 4)."""
    ratios = [mode.seat**0.5 for mode in ring_modes(rig(bearing))]
    assert ratios == pytest.approx([1.009, 1.018, 1.024], abs=1e-3)
