"""Statics of sets: closed forms, the independent bearing on a rigid shaft, preload, springs, temperatures."""

import numpy as np
import pytest
from scipy.optimize import brentq

from fmu_bearing import operating_point, read_scene, statics
from fmu_bearing.elastic.shaft import rigid_transform
from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.instance import EngineError
from fmu_bearing.prepare.bodies import inner_ring
from tests.conftest import GATES
from tests.marks import heavy_but
from tests.oracles import B7003C
from tests.oracles.jones_harris import JonesHarris
from tests.oracles.shaft import shaft
from tests.spindle.sets import scene

WARM = {"operation.inner_ring_temperature_degC": 30.0, "spindle.shaft.temperature_degC": 20.0}
QBC = ("++--", (40.0, 52.0, 150.0, 162.0))
#: Of the largest load: traction of balls that creep at the start, see test_rest.
CREEP = 2e-4


def axials(found):
    return np.array([one.axial for one in found.bearings])


def about(found, position):
    """Stiffness with the shaft's displacement counted at a plane (m)."""
    back = np.linalg.inv(rigid_transform(1.0, position))
    return back.T @ found.stiffness @ back


@pytest.mark.parametrize(("signs", "side"), [("+-", 1.0), ("-+", -1.0)])
def test_stiffness_of_a_rigid_pair_follows_from_one_bearing(signs, side):
    found = statics(scene(signs), force=(0, 0, 0))
    own, half = found.bearings[0].stiffness, 0.015
    k = about(found, 0.055)
    # two bearings side by side: both are differentiated by themselves, which errs by 1e-8
    assert found.axial_stiffness == pytest.approx(2.0 * own[0, 0], rel=1e-7)
    assert k[2, 2] == pytest.approx(2.0 * own[2, 2], rel=1e-7)
    # balls roll along with the ring, so a tilt's force and a displacement's moment are not quite the same
    coupling = 0.5 * (abs(own[2, 3]) + abs(own[3, 2]))
    tilt = 2.0 * (own[3, 3] + half**2 * own[2, 2] + side * 2.0 * half * coupling)
    assert k[3, 3] == pytest.approx(tilt, rel=1e-7)
    assert found.tilt_stiffness == pytest.approx(tilt, rel=1e-7)
    nose = 1.0 / (1.0 / k[2, 2] + 0.055**2 / k[3, 3])
    assert found.nose_stiffness == pytest.approx(nose, rel=1e-7)


def test_stiffness_of_the_pair_is_that_of_the_independent_bearing():
    found = statics(scene(), force=(0, 0, 0))
    model = JonesHarris(B7003C, "outer", control="outer")
    own = model.stiffness(model.solve((500.0, 0.0, 0.0), moment=(0.0, 0.0)))
    # the oracle's differences over 20 nm of slopes that turn over 0.07 mm, its balls within 1e-6 N
    assert found.axial_stiffness == pytest.approx(2.0 * own[0, 0], rel=1e-6)
    # a load that turns about the axis rolls its ball along, which the oracle holds: half of 3.1e-4
    assert found.radial_stiffness == pytest.approx(2.0 * own[2, 2], rel=3e-4)
    tilt = 2.0 * (own[3, 3] + 0.015**2 * own[2, 2] + 0.03 * abs(own[2, 3]))
    assert found.tilt_stiffness == pytest.approx(tilt, rel=3e-4)
    # the design study's gate; its radial and tilt stiffness are of a closed form for equal balls that leaves
    # out that a load turns with the ring about its axis: 3.1e-4 and 4.1e-4 too much
    assert found.axial_stiffness == pytest.approx(1.11465e8, rel=1e-5)
    assert found.radial_stiffness == pytest.approx(3.24901e8, rel=4e-4)
    assert found.tilt_stiffness == pytest.approx(1.30302e5, rel=5e-4)


@pytest.mark.parametrize(("preload", "ratio"), [(500.0, 4.387), (0.01, 2.831)])
def test_the_load_that_unloads_a_pair(preload, ratio):
    """It is the load of one bearing at twice its place: 2^1.5 F0 only while the contact angle stays."""
    found = statics(scene(preload=preload), force=(0, 0, 0))
    model = JonesHarris(B7003C)
    place = model.static_axial(preload)[2]
    expected = brentq(lambda load: model.static_axial(load)[2] - 2.0 * place, preload, 10.0 * preload)
    for way, sign, bearing in (("+x", 1.0, 2), ("-x", -1.0, 1)):
        # places are found within 1e-13 m, of 18 um at 500 N and 0.02 um at 0.01 N
        assert found.lift_off[way].load == pytest.approx(sign * expected, rel=1e-4)
        assert found.lift_off[way].load == pytest.approx(sign * ratio * preload, rel=5e-4)
        assert found.lift_off[way].bearing == bearing


def test_beyond_lift_off_the_pair_is_stiffer_than_before():
    beyond = statics(scene(), force=(4.5 * 500.0, 0, 0))
    assert beyond.bearings[1].axial == 0.0
    just = statics(scene(), force=(1.0001 * 4.387 * 500.0, 0, 0))
    ratio = just.axial_stiffness / statics(scene(), force=(0, 0, 0)).axial_stiffness
    assert ratio == pytest.approx(1.23, abs=0.005)  # the design study's gate, two digits


def test_loads_of_a_pair_are_those_of_independent_bearings():
    found = statics(scene(), force=(200.0, 0.0, -300.0), at=0.0)  # 40 mm ahead of the front bearing
    place = JonesHarris(B7003C).static_axial(500.0)[2]
    q, carried = shaft(B7003C, (0.04, 0.07), (1, -1), (place, place), (200.0, 0.0, -300.0), 0.0)
    for one, expected in zip(found.bearings, carried, strict=True):
        # same physics, other equations and solver: both stop at about 1e-6 N of 1e2 N; across, balls that
        # creep at the start have 0.036 N of traction, see test_rest
        np.testing.assert_allclose(one.axial, abs(expected[0]), rtol=0, atol=2e-4)
        np.testing.assert_allclose(one.force, expected[:3], rtol=0, atol=CREEP * 625.0)
        np.testing.assert_allclose(one.moment, expected[3:], rtol=0, atol=CREEP * 0.5)
    np.testing.assert_allclose(found.displacement, q, rtol=0, atol=1e-5 * np.abs(q).max())
    # the design study's gate, within 1e-4 of the largest load
    assert axials(found) == pytest.approx([624.774, 424.774], rel=1e-4)
    assert [one.force[2] for one in found.bearings] == pytest.approx(
        [-558.367, 258.367], abs=0.056 + CREEP * 558.0
    )


@pytest.mark.parametrize(
    ("signs", "positions", "preload", "name"),
    heavy_but(
        [
            ("+-", (40, 70), 500.0, "DB (O)"),
            ("-+", (40, 70), 500.0, "DF (X)"),
            (*QBC, 300.0, "QBC (O)"),
            ("++-", (40, 52, 150), 300.0, "TBT (O)"),
            ("-++-", (40, 60, 80, 100), 300.0, "-++-"),
            ("+" * 4 + "-" * 4, tuple(range(40, 280, 30)), 200.0, "++++----"),
        ],
        0,
        1,
        2,
        3,
    ),
)
def test_forces_balance_and_a_mirrored_set_does_the_same(signs, positions, preload, name):
    force, at, rpm = (150.0, 60.0, -200.0), -0.02, 12e3
    found = statics(scene(signs, positions, preload, rpm), force=force, at=at, moment=(1.0, -2.0))
    assert found.arrangement == name
    loads = rigid_transform(1.0, at).T @ np.array([*force, 1.0, -2.0])
    for one in found.bearings:
        loads -= rigid_transform(1.0, one.position).T @ np.array([*one.force, *one.moment])
    # at speed the start lets up to 0.5 N of traction across stay out of balance, of loads of 450 to 1,050 N,
    # and along 0.05 N; a moment has the levers of the bearings
    largest = max(np.abs(one.force).max() for one in found.bearings)
    assert np.abs(loads[:3]).max() < 2e-3 * largest and np.abs(loads[3:]).max() < 2e-4 * largest
    # in a mirror across the axis nothing but the signs of x and of the tilts changes
    back = "".join("+" if sign == "-" else "-" for sign in reversed(signs))
    places = [200.0 - place for place in reversed(positions)] if max(positions) < 200 else None
    if places is not None:
        other = statics(
            scene(back, places, preload, rpm), force=(-150.0, 60.0, -200.0), at=0.2 - at, moment=(-1.0, 2.0)
        )
        np.testing.assert_allclose(axials(other)[::-1], axials(found), rtol=1e-8, atol=1e-6)


@pytest.mark.parametrize("signs", ["+-", "++--", "++-"])
def test_preload_is_what_was_asked_for(signs):
    positions = (40, 60, 120, 140)[: len(signs)]
    found = statics(scene(signs, positions), force=(0, 0, 0))
    many = max(signs.count("+"), signs.count("-"))
    expected = [500.0 * many / signs.count(sign) for sign in signs]
    assert found.preloads["cold"] == pytest.approx(expected, rel=1e-6)
    assert axials(found) == pytest.approx(expected, rel=1e-6)


def alone(rpm=20e3, radial=0.0, **changes):
    """The single bearing of `scene`, with 500 N along its axis."""
    cold = {f"operation.{part}_temperature_degC": 20.0 for part in ("oil", "inner_ring", "outer_ring")}
    own = {
        "fidelity.terms.gravity": False, "fidelity.race_control": "outer", "operation.speed_rpm": rpm,
        "mounting.preload_N": 500.0, "mounting.radial_load_z_N": radial,
    }  # fmt: skip
    keys = {key.replace("__", "."): value for key, value in changes.items()}
    return read_scene(GATES / "7003C-bare.toml").replace(cold | own | keys)


def test_a_single_bearing_carries_its_loads_and_the_weight_of_its_rotor():
    """Bearing, pedestal and support of its tilt are springs in series and beside each other."""
    support = {"stiffness_N_m_rad": 1e4, "damping_ratio": 0.05}
    rotor = {"mass_kg": 1.0, "length_mm": 180.0, "diameter_mm": 30.0}
    given = alone(
        radial=-120.0, mounting__tilt_support=support, mounting__rotor=rotor, fidelity__terms__gravity=True
    )
    found = statics(given)
    (one,) = found.bearings
    assert one.axial == 500.0
    # the inner ring weighs some grams more
    assert -one.force[2] - 120.0 == pytest.approx(GRAVITY * (1.0 + inner_ring(given).mass), rel=1e-9)
    assert one.moment == pytest.approx(-1e4 * found.displacement[3:])
    # on the axis the bearing gives way, and its pedestal
    pedestal = given.mounting.pedestal_stiffness_N_m * given.mounting.pedestal_axial_ratio
    along = 1.0 / (1.0 / one.stiffness[0, 0] + 1.0 / pedestal)
    assert found.axial_stiffness == pytest.approx(along, rel=1e-3)  # coupled with tilts by the radial load
    assert found.nose_stiffness_bending == found.nose_stiffness
    assert (found.spacing, found.neutral_spacing, found.preloads) == (None, None, {})


def test_a_rigid_preload_has_the_load_that_its_place_means():
    given = alone(mounting__preload_mode="rigid", operation__inner_ring_temperature_degC=40.0)
    found = statics(given)
    assert found.preloads["cold"] == pytest.approx([500.0], rel=1e-8)
    assert found.preloads["warm"][0] > 600.0
    assert found.bearings[0].axial == pytest.approx(found.preloads["running"][0], rel=1e-8)
    (point,) = operating_point(given).bearings
    assert point.axial == found.bearings[0].axial and point.scene.mounting.preload_N == 500.0


def test_neutral_spacing_keeps_the_preload():
    found = statics(scene(), force=(0, 0, 0))
    assert 1e3 * found.neutral_spacing == pytest.approx(50.1, abs=0.05)  # the design study's gate
    assert found.spacing == pytest.approx(0.03)
    changes = {
        "operation.inner_ring_temperature_degC": 30.0, "spindle.shaft.temperature_degC": 30.0,
        "spindle.housing.temperature_degC": 20.0,
    }  # fmt: skip
    apart = 1e3 * found.neutral_spacing
    warm = statics(scene("+-", (40.0, 40.0 + apart), changes=changes), force=(0, 0, 0))
    assert warm.preloads["warm"] == pytest.approx([500.0, 500.0], rel=1e-6)
    assert statics(scene("-+"), force=(0, 0, 0)).neutral_spacing is None


def test_temperature_and_stick_out_change_the_preload_as_they_must():
    def preload(signs, changes):
        return statics(scene(signs, changes=changes), force=(0, 0, 0)).preloads["warm"][0]

    shaft_warm = {"spindle.shaft.temperature_degC": 40.0}
    for signs, loosens in (("+-", True), ("-+", False)):
        assert preload(signs, {}) == pytest.approx(500.0, rel=1e-6)
        assert preload(signs, WARM) > 510.0
        assert (preload(signs, shaft_warm) < 490.0) == loosens
        assert (preload(signs, {"spindle.housing.temperature_degC": 40.0}) > 510.0) == loosens
    # one ring pushed in by 2 um is each by 1 um
    one = preload("+-", {"spindle.bearing[1].stickout_um": 2.0})
    both = preload("+-", {"spindle.bearing[1].stickout_um": 1.0, "spindle.bearing[2].stickout_um": 1.0})
    assert one == pytest.approx(both, rel=1e-9)
    model = JonesHarris(B7003C)
    place = model.static_axial(500.0)[2] + 1e-6
    assert both == pytest.approx(brentq(lambda f: model.static_axial(f)[2] - place, 400, 700), rel=1e-6)


def test_one_warm_bearing_of_a_set():
    found = statics(
        scene(*QBC, changes={"spindle.bearing[1].inner_ring_temperature_degC": 30.0}), force=(0, 0, 0)
    )
    loads = found.preloads["warm"]
    assert loads[0] > 1.05 * loads[1]  # the warm one of a tandem takes more of the same force
    assert loads[0] + loads[1] == pytest.approx(loads[2] + loads[3], rel=1e-9)


def test_a_spring_keeps_its_force_whatever_the_temperature():
    spring = {"spindle.preload": {"kind": "spring", "force_N": 300.0}, "spindle.bearing[2].seat": "sliding"}
    for changes in ({}, WARM, {"spindle.shaft.temperature_degC": 45.0}):
        given = scene(preload=None, changes=spring | changes)
        assert statics(given, force=(0, 0, 0)).preloads["warm"] == pytest.approx([300.0] * 2, rel=1e-6)
        found = statics(given, force=(100.0, 0.0, -50.0))
        assert axials(found) == pytest.approx([400.0, 300.0], rel=1e-6)
    # nothing unloads the bearing behind the spring; the other gives way at the force of the spring
    assert set(found.lift_off) == {"-x"}
    assert found.lift_off["-x"].load == pytest.approx(-300.0, rel=1e-6)
    own = found.bearings[0].stiffness
    assert found.axial_stiffness == pytest.approx(own[0, 0], rel=1e-3)


def test_springs_without_force_hold_nothing():
    """The ring behind them follows its bearing, which an axial load the other way keeps loaded."""
    spring = {"kind": "spring", "force_N": 0.0}
    given = scene(
        preload=None, load={"force_x_N": 200.0},
        changes={"spindle.preload": spring, "spindle.bearing[2].seat": "sliding"},
    )  # fmt: skip
    found = statics(given)
    assert axials(found) == pytest.approx([200.0, 0.0], abs=1e-3)
    assert set(found.lift_off) <= {"-x"}


@pytest.mark.parametrize("changes", [{"fixed_modes": 4}, {"damping_ratio": 0.02}])
def test_what_runs_alone_read_of_a_bending_shaft_changes_no_statics(changes):
    shaft = {"sections_mm": [[400.0, 17.0, 0.0]], "flexible": True}
    plain, other = (statics(scene(shaft=shaft | more), force=(0, 0, -50.0)) for more in ({}, changes))
    assert other.displacement == pytest.approx(plain.displacement, rel=1e-9)
    assert other.nose_stiffness_bending == pytest.approx(plain.nose_stiffness_bending, rel=1e-9)
    assert plain.nose_stiffness == pytest.approx(plain.nose_stiffness_bending, rel=1e-9)


@pytest.mark.parametrize("stiffness", [1.0, 1e5])
def test_a_soft_spring_never_lets_go(stiffness):
    spring = {"kind": "spring", "force_N": 300.0, "stiffness_N_m": stiffness}
    given = scene(preload=None, changes={"spindle.preload": spring, "spindle.bearing[2].seat": "sliding"})
    found = statics(given).lift_off
    # unloaded, its ring would have gone 3 mm and more; the other bearing gives way a little above 300 N
    assert list(found) == ["-x"] and -305.0 < found["-x"].load < -300.0


def test_a_stiff_spring_is_a_spacer():
    spring = {"kind": "spring", "force_N": 500.0}
    soft, stiff = (
        scene(
            preload=None,
            changes={
                "spindle.bearing[2].seat": "sliding",
                "spindle.preload": spring | {"stiffness_N_m": k},
            },
        )
        for k in (2e6, 1e9)
    )
    found = statics(soft, force=(200.0, 0, 0))
    # the spring and the bearing it loads in series, beside the other bearing
    first, second = (one.stiffness[0, 0] for one in found.bearings)
    assert found.axial_stiffness == pytest.approx(first + 1.0 / (1.0 / second + 1.0 / 2e6), rel=1e-6)
    held = statics(scene(), force=(200.0, 0, 0))
    # 5.6e7 N/m of the bearing against 1e9 N/m of the spring
    assert axials(statics(stiff, force=(200.0, 0, 0))) == pytest.approx(axials(held), rel=0.01)


def test_a_tandem_is_held_by_its_load_alone():
    found = statics(scene("++", (40, 60), None, load={"force_x_N": 800.0}))
    assert axials(found) == pytest.approx([400.0, 400.0], rel=1e-9)
    assert found.preloads == found.lift_off == {}
    pushed = scene("++", (40, 60), None, load={"force_x_N": 800.0}, bearings=[{"stickout_um": 1.0}, {}])
    first, second = axials(statics(pushed))
    assert 1.05 < first / second < 1.25  # 1 um of stick-out unbalances a tandem by several per cent
    with pytest.raises(EngineError, match="only in directions that a bearing carries"):
        statics(pushed, force=(-100.0, 0.0, 0.0))


def test_face_to_face_hardly_resists_tilt_at_one_spacing():
    own = statics(scene("-+"), force=(0, 0, 0)).bearings[0].stiffness
    coupling = 0.5 * (abs(own[2, 3]) + abs(own[3, 2]))
    least = 2.0 * coupling / own[2, 2]
    assert 1e3 * least == pytest.approx(9.8, abs=0.05)  # the design study's figure
    expected = 2.0 * (own[3, 3] - coupling**2 / own[2, 2])
    side_by_side, apart = (
        statics(scene("-+", (40.0, 40.0 + gap)), force=(0, 0, 0)).tilt_stiffness for gap in (10.0, 30.0)
    )
    # 0.2 mm off the least, of which the tilt stiffness is a parabola
    assert side_by_side == pytest.approx(expected + 0.5 * own[2, 2] * (0.01 - least) ** 2, rel=1e-6)
    assert side_by_side < 0.4 * apart


def test_weight_of_shaft_and_rings_is_carried():
    given = scene(changes={"fidelity.terms.gravity": True})
    found = statics(given, force=(0, 0, 0))
    b, density = given.bearing, given.materials.inner_ring.density_kg_m3
    ring = np.pi / 4 * (b.inner_ring_outer_diameter_mm**2 - b.bore_mm**2) * b.width_mm
    mass = 1e-9 * density * (np.pi / 4 * 17.0**2 * 400.0 + 2 * ring)
    assert found.load[2] == pytest.approx(-9.81 * mass, rel=1e-9)
    # 0.008 N beside a preload of 500 N
    assert sum(one.force[2] for one in found.bearings) == pytest.approx(-9.81 * mass, abs=CREEP * 500.0)


def test_large_loads_and_unloaded_bearings_end_well():
    for force in ((8e3, 0, 0), (-8e3, 0, 0), (0, 0, -6e3), (3e3, 2e3, -2e3)):
        found = statics(scene(*QBC), force=force, at=0.0)
        carried = sum(one.force for one in found.bearings)
        assert carried == pytest.approx(np.array(force, dtype=float), abs=CREEP * 8e3)
    bare = statics(scene(preload=None), force=(300.0, 0.0, 0.0))
    assert bare.bearings[1].axial < 0.011 and bare.bearings[0].axial == pytest.approx(300.0, rel=1e-4)
    assert any("bearing 2" in line for line in bare.cautions())


def test_numbers_that_are_none_are_refused():
    with pytest.raises(ValueError, match="finite"):
        statics(scene(), force=(float("nan"), 0.0, 0.0))
