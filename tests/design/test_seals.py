"""Seals at the operating point: torque, heat and its way, range, verdict, and what is printed of them."""

import numpy as np
import pytest

from fmu_bearing.cautions import cautions
from fmu_bearing.design.heat import heat_table
from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.design.temperatures import temperatures
from fmu_bearing.design.torque_range import SEALS, torque_range
from fmu_bearing.design.verdicts import verdicts
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import P, Z
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import pack, prepare
from fmu_bearing.scene import read_scene
from tests.conftest import EXAMPLES

SINGLE = EXAMPLES / "7003C-spindle.toml"
SET = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"
# 7003C, 17 x 35 mm, angular contact, RS1: 0.014 24.2^2 + 10, the lip at 17 + 0.40 18
BOTH = 0.014 * 24.2**2 + 10.0  # N mm


def sealed(file=SINGLE, rpm=None, **seal):
    scene = read_scene(file).replace({"bearing.seal": seal or {"kind": "RS1"}, "sound": None})
    return scene if rpm is None else scene.replace({"operation.speed_rpm": rpm})


@pytest.fixture(scope="module", params=[SINGLE, SET], ids=["single", "set"])
def points(request):
    """Operating points with seals and without."""
    return operating_point(sealed(request.param)), operating_point(sealed(request.param, torque_N_mm=0.0))


def test_parameter_is_the_torque_in_newton_metres():
    assert pack(sealed(), np.empty(0))[P.SEAL_TORQUE] == pytest.approx(1e-3 * BOTH, rel=1e-12)
    assert pack(read_scene(SINGLE), np.empty(0))[P.SEAL_TORQUE] == 0.0


def test_torque_and_heat_are_those_without_seals_and_the_seals(points):
    ours, plain = points
    speed = ours.scene.operation.speed_rpm * RPM
    lost = 1e-3 * BOTH * speed
    for one, other in zip(ours.bearings, plain.bearings, strict=True):
        assert one.friction_torque - other.friction_torque == pytest.approx(1e-3 * BOTH, rel=1e-9)
        assert one.heat.seals == pytest.approx(lost, rel=1e-9) and other.heat.seals == 0.0
        assert one.heat.total - other.heat.total == pytest.approx(lost, rel=1e-9)
        assert one.heat.inner_ring - other.heat.inner_ring == pytest.approx(lost, rel=1e-9)
        assert one.heat.inner_race == pytest.approx(other.heat.inner_race, rel=1e-9)
        assert one.heat.inner_ring + one.heat.outer_ring + one.heat.oil == pytest.approx(
            one.heat.total, rel=1e-9
        )


def test_the_table_has_a_row_where_there_are_seals(points):
    ours, plain = (dict((row[0], row[1:]) for row in heat_table(point.bearings)[1]) for point in points)
    speed = points[0].scene.operation.speed_rpm * RPM
    assert ours["seals, W"][0] == f"{1e-3 * BOTH * speed:.2f}"
    assert "seals, W" not in plain


def test_without_a_cage_the_dampers_have_no_share_of_the_seals():
    scene = sealed().replace({"bearing.cage": None, "materials.cage": None})
    heat = operating_point(scene).bearings[0].heat
    assert heat.cage == pytest.approx(0.0, abs=1e-6 * heat.total)
    assert heat.seals == pytest.approx(1e-3 * BOTH * 2e4 * RPM, rel=1e-9)


def test_range():
    """Half of the torque either way, and nothing else of the bearing moves with it."""
    found = torque_range(sealed())
    (one,) = (one for one in found.inputs if one.name == "seals")
    for share, end in zip(SEALS, (one.low, one.high), strict=True):
        assert end.torques[0] - found.torques[0] == pytest.approx(1e-3 * (share - 1.0) * BOTH, rel=1e-4)
    assert found.total.low < found.torques[0] - 0.4e-3 * BOTH
    for scene in (read_scene(SINGLE), sealed(kind="RZ"), sealed(torque_N_mm=0.0)):
        assert "seals" not in {one.name for one in torque_range(scene).inputs}


@pytest.mark.parametrize(("rpm", "judgement"), [(11e3, "good"), (12e3, "watch"), (13e3, "change")])
def test_verdict_on_the_speed_of_the_lips(rpm, judgement):
    """24.2 mm at 11,049 r/min run at 14 m/s, and at 12,627 at 16."""
    found = verdicts(operating_point(sealed(rpm=rpm)))
    (one,) = (one for one in found if one.key == "lip_speed")
    assert one.judgement == judgement
    assert one.value == pytest.approx(rpm * RPM * 12.1e-3, rel=1e-9)
    assert ("11049 r/min" in one.advice) == (judgement != "good")


def test_no_verdict_on_seals_that_hardly_touch_or_of_which_nothing_is_known():
    for scene in (sealed(kind="RZ"), sealed(torque_N_mm=5.0), read_scene(SINGLE)):
        assert "lip_speed" not in {one.key for one in verdicts(operating_point(scene))}


def test_heat_of_the_seals_makes_the_inner_ring_warmer():
    ours, plain = (temperatures(sealed(torque_N_mm=torque)) for torque in (15.0, 0.0))
    rises = {
        node: ours.places[1, node] - plain.places[1, node] for node in ("inner_ring", "outer_ring", "oil")
    }
    # 31 W more into the inner ring, whose ways out are 0.57 W/K to the shaft and 0.21 to the oil and more
    assert rises["inner_ring"] > 10.0
    assert rises["inner_ring"] > rises["oil"] > rises["outer_ring"] > 0.0


@pytest.mark.parametrize("fidelity", ["full", "rings", "response"])
def test_outputs(fidelity):
    run = Instance(prepare(sealed(), fidelity=fidelity))
    run.initialise()
    run.step(1e-4)
    assert run.get("friction_torque_share.seals") == pytest.approx(1e-3 * BOTH, rel=1e-6)
    open_ = prepare(read_scene(SINGLE), fidelity=fidelity)
    assert "friction_torque_share.seals" not in {one.name for one in open_.variables}


def test_seals_do_not_count_where_traction_cannot_drive_the_balls():
    """The warning's threshold is the traction of the contacts and the torque of the seals, by hand."""
    ours, plain = (prepare(sealed(torque_N_mm=torque), fidelity="rings") for torque in (100.0, 0.0))
    limits = []
    for model in (ours, plain):
        (found,) = (one for one in cautions(model) if one.index == Z.TORQUE and one.above)
        limits.append(found)
    assert limits[0].threshold - limits[1].threshold == pytest.approx(0.1, rel=1e-9)
    assert "seals take 100" in limits[0].after and "seals" not in limits[1].after
