"""Heat of bearings at rest and in a set: what arises is what goes, and what the shaft supplies."""

import json
import math

import pytest

from fmu_bearing.design.heat import Heat, heat_in_all, heat_table
from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.engine.constants import RPM
from fmu_bearing.run.bearing import Bearing
from fmu_bearing.scene import read_scene
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import EXAMPLES

SINGLE = EXAMPLES / "7003C-spindle.toml"
SET = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"


@pytest.fixture(scope="module", params=[SINGLE, SET], ids=["single", "set"])
def point(request):
    return operating_point(request.param)


def test_heat_is_the_power_of_the_torque(point):
    """A settled bearing stores nothing: torque times speed is lost. To the rounding of the steady state."""
    speed = point.scene.operation.speed_rpm * RPM
    for one in point.bearings:
        assert one.heat.total == pytest.approx(one.friction_torque * speed, rel=1e-6)
    assert point.heat.total == pytest.approx(
        sum(one.friction_torque for one in point.bearings) * speed, rel=1e-6
    )


def test_what_arises_is_what_goes_and_where(point):
    """Half of what a contact loses warms its ring: the races' losses are those of sliding and rolling."""
    for heat in (*(one.heat for one in point.bearings), point.heat):
        assert heat.inner_ring + heat.outer_ring + heat.oil == pytest.approx(heat.total, rel=1e-9)
        assert heat.inner_race + heat.outer_race == pytest.approx(heat.sliding + heat.rolling, rel=1e-9)
        assert min(heat.sliding, heat.rolling, heat.cage, heat.drag) > 0.0


def test_heat_is_that_of_a_run():
    """The heat of a run of 50 ms, whose surfaces are wavy."""
    scene = with_fidelity(read_scene(SINGLE), model="rings").replace({"sound": None})
    bearing = Bearing(scene)
    bearing.init()
    bearing.step(0.05)
    found = operating_point(scene).bearings[0].heat
    for name in ("inner_ring", "outer_ring", "oil"):
        assert bearing.get(f"heat.{name}") == pytest.approx(getattr(found, name), rel=0.02)


def test_a_bearing_without_a_cage_loses_nothing_there():
    scene = read_scene(SINGLE).replace({"bearing.cage": None, "materials.cage": None})
    found = operating_point(scene).bearings[0]
    speed = scene.operation.speed_rpm * RPM
    assert found.heat.total == pytest.approx(found.friction_torque * speed, rel=1e-6)
    assert found.heat.cage == pytest.approx(0.0, abs=1e-6 * found.heat.total)


def test_no_heat_at_standstill():
    found = operating_point(
        read_scene(SINGLE).replace({"operation.speed_rpm": 0.0, "operation.lowest_speed_rpm": 3000.0})
    )
    assert found.heat.total == pytest.approx(0.0, abs=1e-9) and math.isfinite(
        found.bearings[0].friction_torque
    )


def test_heat_does_not_depend_on_the_direction_of_rotation():
    ways = [operating_point(read_scene(SINGLE).replace({"operation.speed_rpm": n})).heat for n in (2e4, -2e4)]
    assert ways[1].total == pytest.approx(ways[0].total, rel=1e-6)


def test_sums_and_table():
    one = Heat(1.0, 2.0, 3.0, 4.0, 0.5, 1.0, 8.5)
    whole = heat_in_all([one, one])
    assert whole == Heat(2.0, 4.0, 6.0, 8.0, 1.0, 2.0, 17.0) and whole.total == 20.0

    class Given:
        friction_torque, heat = 0.001, one

    assert heat_table([Given()])[0] == ("", "value")
    columns, rows = heat_table([Given(), Given()])
    assert columns == ("", "bearing 1", "bearing 2", "all")
    cells = {row[0]: row[1:] for row in rows}
    assert cells["friction torque, N mm"] == ["1.00", "1.00", "2.00"]
    assert cells["in all, W"] == ["10.00", "10.00", "20.00"]
    assert cells["of it in the outer race, W"] == ["2.00", "2.00", "4.00"]
    assert cells["of it to oil and balls, W"] == ["8.50", "8.50", "17.00"]


@pytest.mark.heavy
@pytest.mark.parametrize("file", [SINGLE, SET], ids=["single", "set"])
def test_info_prints_it_beside_the_torque(file, capsys):
    from typer.testing import CliRunner

    from fmu_bearing import cli

    found = operating_point(file)
    text = CliRunner().invoke(cli.app, ["info", str(file)]).stdout
    cells = {
        row[0].strip(): [c.strip() for c in row[1:]]
        for row in map(lambda x: x.strip("│").split("│"), text.splitlines())
    }
    for row in heat_table(found.bearings)[1]:
        assert cells[row[0]] == row[1:]
    data = json.loads(CliRunner().invoke(cli.app, ["info", str(file), "--json"]).stdout)
    assert data["heat_W"]["total"] == pytest.approx(found.heat.total)
    assert [one["heat_W"]["rolling"] for one in data["bearings"]] == pytest.approx(
        [one.heat.rolling for one in found.bearings]
    )
