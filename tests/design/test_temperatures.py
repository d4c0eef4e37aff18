"""Steady temperatures without a run: balance, scaling by size, range, refusals."""

import sys

import numpy as np
import pytest

from fmu_bearing.design.fresh import new_scene
from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.design.temperatures import AMBIENT, FACTOR, conductances, temperatures
from fmu_bearing.scene import read_scene, read_scene_text
from tests.conftest import EXAMPLES

PAIR = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"


@pytest.fixture(scope="module")
def found():
    return temperatures(read_scene(EXAMPLES / "7003C-spindle.toml"))


def away(made):
    """W that leave: to what surrounds the bearings."""
    places = made.places
    return sum(
        one.value * (value - made.ambient)
        for one in made.conductances
        for (_, node), value in places.items()
        if one.other == "ambient" and node == one.one
    )


def test_as_much_heat_leaves_as_arises(found):
    heat = sum(one.total for one in found.heats)
    assert away(found) == pytest.approx(heat, rel=1e-9)  # one linear solution
    # temperatures are settled within 0.001 K, and a kelvin changes the heat by 1 %
    assert operating_point(found.scene).heat.total == pytest.approx(heat, rel=2e-5)


def test_the_reference_is_the_network_of_the_examples(found, monkeypatch):
    """The example's thermal FMU, whose balls are a lump of their own, is at rest at these temperatures."""
    monkeypatch.syspath_prepend(str(EXAMPLES.parent / "spindle_cosimulation"))
    monkeypatch.delitem(sys.modules, "thermal", raising=False)
    import thermal

    fmu = thermal.SpindleThermal(instance_name="it", resources="")
    matrix = np.array(fmu._matrix(1.0, [0.0] * len(thermal.LUMPS)))
    heat = found.heats[0]
    given = [getattr(heat, kind) if kind in thermal.SOURCES else 0.0 for _, kind in thermal.LUMPS]
    rises = np.linalg.solve(matrix, given)
    rests = {kind: AMBIENT + rise for (_, kind), rise in zip(thermal.LUMPS, rises, strict=True)}
    # two conductances in series, rounded to two figures, stand for the way through the balls
    for (_, kind), value in found.places.items():
        assert value == pytest.approx(rests[kind], abs=0.15)


def test_the_range_is_that_of_all_conductances(found):
    for place, value in found.places.items():
        assert AMBIENT < found.low[place] < value < found.high[place]
    heat = FACTOR * away(found.__class__(**vars(found) | {"places": found.low}))
    # colder oil makes more heat
    assert heat > sum(one.total for one in found.heats)


def test_a_set_has_a_shaft_and_a_housing():
    made = temperatures(read_scene(PAIR))
    assert away(made) == pytest.approx(sum(one.total for one in made.heats), rel=1e-9)
    scene = made.scene
    assert scene.spindle.shaft.temperature_degC == made.places[0, "shaft"]
    assert scene.spindle.bearing[1].inner_ring_temperature_degC == made.places[2, "inner_ring"]
    assert set(made.places) >= {(1, "oil"), (2, "oil"), (0, "shaft"), (0, "housing")}


def test_conductances_follow_size_material_and_supply():
    def of(size, **more):
        text = new_scene("a", size, sound=False, speed_rpm=9e3, preload_N=200.0, **more)
        return {(one.one, one.other): one.value for one in conductances(read_scene_text(text))}

    small, large = of("NSK-7003C", kind="hybrid"), of("NSK-7010C", kind="hybrid")
    # seats grow as circumference times width, 80 x 16 over 35 x 10 mm
    seat = ("outer_ring", "housing")
    assert large[seat] / small[seat] == pytest.approx(80.0 * 16.0 / (35.0 * 10.0))
    steel = of("NSK-7010C", kind="steel")
    through = ("inner_ring", "outer_ring")
    assert steel[through] > large[through]  # steel balls conduct better than silicon nitride
    scene = read_scene(EXAMPLES / "7003C-spindle.toml")
    ways = {
        supply: [one for one in conductances(scene.replace({"lubricant.supply": supply})) if one.one == "oil"]
        for supply in ("oil-air", "grease", "jet")
    }
    assert not ways["grease"] and ways["jet"][0].value > ways["oil-air"][0].value


def test_a_runaway_is_said():
    keys = {"operation.speed_rpm": 60e3, "mounting.preload_N": 1500.0, "lubricant.supply": "grease"}
    hot = read_scene(EXAMPLES / "7003C-spindle.toml").replace(keys)
    with pytest.raises(ValueError, match=r"no steady temperature: .* reaches \d+ degC, and 150 are the"):
        temperatures(hot)


def test_nothing_turns_nothing_warms():
    still = read_scene(EXAMPLES / "7003C-spindle.toml").replace(
        {"operation.speed_rpm": 0.0, "imperfections": None}
    )
    made = temperatures(still)
    assert np.array(list(made.places.values())) == pytest.approx(AMBIENT, abs=1e-9)
