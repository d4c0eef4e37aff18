"""Axes as people write them, and what is reported of those that are refused."""

import numpy as np
import pytest

from fmu_bearing.sweeps.axes import SweepError, axes_of, key_of, parse_axis
from tests.spindle.sets import scene as of_set


def test_text_of_the_command_line():
    assert parse_axis("operation.speed_rpm=10000:40000:7")[1] == [1e4, 1.5e4, 2e4, 2.5e4, 3e4, 3.5e4, 4e4]
    key, values = parse_axis("pedestal=1e6:1e8:5log")
    assert key == "pedestal" and values == pytest.approx([1e6, 10**6.5, 1e7, 10**7.5, 1e8], rel=1e-11)
    assert values[2] == 1e7  # not 10000000.000000002
    assert parse_axis("mounting.preload_N = 500,800, 1200") == ("mounting.preload_N", [500, 800, 1200])
    assert parse_axis("fidelity.model=rings,full")[1] == ["rings", "full"]
    assert parse_axis("fidelity.terms.drag=true,false")[1] == [True, False]


@pytest.mark.parametrize(
    ("text", "reported"),
    [
        ("speed", "write KEY=LOW:HIGH:COUNT"),
        ("speed=1:2", "write KEY=LOW:HIGH:COUNT"),
        ("speed=1:2:1", "2 or more values"),
        ("speed=0:10:3log", "bounds above 0"),
        ("speed=a:b:3", "bounds must be numbers"),
        ("speed=1:inf:3", "finite bounds"),
    ],
)
def test_text_that_is_no_axis(text, reported):
    with pytest.raises(SweepError, match=reported):
        parse_axis(text)


def test_axes_have_names_units_and_meaning(scene):
    axes = axes_of(
        scene("7003C-spindle"), {"speed": "1000:2000:2", "mounting.rotor.mass_kg": np.array([0.2, 0.3])}
    )
    assert [axis.name for axis in axes] == ["speed_rpm", "mass_kg"]
    assert [axis.unit for axis in axes] == ["r/min", "kg"]
    assert axes[1].words == "Mass of the rotor, kg." and axes[1].values == (0.2, 0.3)


def test_short_names_are_those_of_a_set():
    spring = {"spindle.preload": {"kind": "spring", "force_N": 300.0}, "spindle.bearing[2].seat": "sliding"}
    spacers, springs = of_set(), of_set(changes=spring)
    for found, key in ((spacers, "spindle.preload.preload_N"), (springs, "spindle.preload.force_N")):
        assert [axis.key for axis in axes_of(found, {"preload": "100:300:3"})] == [key]
    assert key_of(spacers, "pedestal") == "spindle.housing.pedestal_stiffness_N_m"
    assert key_of(spacers, "speed") == "operation.speed_rpm"


def test_axes_with_equal_ends_keep_their_whole_keys(scene):
    axes = axes_of(
        scene("7003C-spindle"), {"mounting.rotor.mass_kg": [0.2], "mounting.housing.mass_kg": [2, 3]}
    )
    assert [axis.name for axis in axes] == ["mounting.rotor.mass_kg", "mounting.housing.mass_kg"]


def test_a_range_of_whole_numbers_serves_a_whole_number(scene):
    (axis,) = axes_of(scene("7003C-spindle"), {"seed": "1:4:4"})
    assert axis.values == (1, 2, 3, 4) and all(isinstance(value, int) for value in axis.values)


def test_all_that_is_wrong_is_reported_at_once(scene):
    wrong = {"spede": [1], "mounting.preload": [1], "speed": [1, 1], "pedestal": [], "fidelity": [None]}
    with pytest.raises(SweepError) as caught:
        axes_of(scene("7003C-spindle"), wrong)
    reported = str(caught.value).splitlines()
    assert reported[0] == "no key of a scene 'spede'; did you mean 'speed'?"
    assert "did you mean 'mounting.preload_N'?" in reported[1]
    assert reported[2] == "axis operation.speed_rpm: 1 is given more than once"
    assert reported[3] == "axis mounting.pedestal_stiffness_N_m has no values"
    assert "None is refused" in reported[4] and len(reported) == 5
    with pytest.raises(SweepError, match="given twice"):
        axes_of(scene("7003C-spindle"), {"speed": [1], "operation.speed_rpm": [2]})
    with pytest.raises(SweepError, match="needs an axis"):
        axes_of(scene("7003C-spindle"), {})
