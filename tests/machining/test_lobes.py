"""Lobes of scenes: against milling in time with the linearised scene, over speed, and what is refused."""

import csv
import math

import numpy as np
import pytest

from fmu_bearing import lobes, new_scene, read_scene, receptance
from fmu_bearing.machining.lobes_result import MARGIN, Limit
from fmu_bearing.machining.stability import Lobes
from fmu_bearing.machining.zero_order import Cut, angles, branches, depths, in_the_cut
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.modal.receptance import transfer
from fmu_bearing.scene import SceneError, read_scene_text
from tests.conftest import EXAMPLES
from tests.machining import delay

DB = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"
END_MILL = EXAMPLES.parent / "milling" / "7003C-QBC-end-mill.toml"
CUT = {"teeth": 4, "cutting_coefficient_N_mm2": 800.0, "radial_immersion": 1.0, "depth_mm": 1.0}


def cutting(**keys):
    return read_scene(DB).replace({"milling": CUT | keys})


@pytest.mark.parametrize(
    ("which", "rpm", "near"),
    [
        ("7003C-DB", 15_000.0, 0.02),
        ("7003C-DB", -11_000.0, 0.02),
        # its nose moves across a force by 0.43 of its motion along it
        ("7003C-QBC", 19_000.0, 0.02),
    ],
)
def test_the_limit_is_that_of_the_linearised_scene_in_time(which, rpm, near):
    """A slot by four teeth at the nose, all states of the scene; feed to 12 o'clock plus 40 deg."""
    source = EXAMPLES.parent / "spindle_set" / f"{which}.toml"
    feed = math.radians(40.0)
    scene = read_scene(source).replace(
        {"milling": CUT | {"feed_angle_deg": 40.0}, "operation.speed_rpm": rpm}
    )
    found = lobes(scene, [rpm])
    assert found.place == "nose" and found.own == found.limits[0]
    system = linearised(scene)
    out, into = transfer._ports(system)
    values, vectors = np.linalg.eig(system.matrix)
    along = np.array([-math.sin(feed), math.cos(feed)])
    # v is from where teeth turn to u: a quarter turn back from u, in the sense of the shaft
    before = np.array([along[1], -along[0]]) * math.copysign(1.0, rpm)
    axes = np.array([along, before])
    poles = (
        values, np.linalg.solve(vectors, into[:, 1:3].astype(complex)) @ axes.T,
        axes @ out[1:3] @ vectors,
    )  # fmt: skip
    above, below = (
        delay.growth(poles, found.own.depth * share, rpm, 4, 800e6, 0.3, 0.0, math.pi, turns=30)
        for share in (1.0 + near, 1.0 - near)
    )
    assert above > 0.0 > below


def test_one_direction_alone_would_be_wrong_where_the_nose_whirls():
    """Cross terms of 0.43 move the least limit by more than a fifth."""
    scene = read_scene(END_MILL)
    found = receptance(scene, np.linspace(1200.0, 1800.0, 601), at="tip").G[0, 0, :, 1:3, 1:3]
    cut = Cut(4, 800e6, 0.3, *angles(0.5, "down"))
    least = []
    for matrix in (found, found * np.eye(2)):
        depth = depths(cut, branches(cut, in_the_cut(matrix, math.pi / 2.0, True)))
        least.append(depth[depth > 0.0].min())
    assert abs(least[1] / least[0] - 1.0) > 0.2


@pytest.mark.heavy
def test_receptance_follows_the_speed_and_some_speeds_are_enough():
    speeds = np.linspace(5e3, 22e3, 35)
    few, many = (lobes(END_MILL, speeds, coarse=count) for count in (5, 9))
    apart = np.abs(few.depths / many.depths - 1.0)
    # on the flanks of a lobe a shift of 0.1 % in frequency is some per cent of depth
    assert np.median(apart) < 0.01 and apart.max() < 0.1
    stiff = lobes(END_MILL, speeds, coarse=2)
    assert np.abs(stiff.depths / many.depths - 1.0).max() > apart.max()


@pytest.mark.heavy
def test_verdict_and_the_way_out():
    found = lobes(END_MILL)
    assert found.place == "tip" and found.judgement == "change"
    assert "chatters: the limit at 18,000 r/min" in found.verdict()
    assert "the nearest speed for this depth is" in found.verdict()
    best = found.pockets()[0]
    words = f"is {best.speed:,.0f}, with a limit of {1e3 * best.depth:.3g} mm: stay below "
    assert f"{words}{1e3 * MARGIN * best.depth:.3g} mm, 0.7 of it" in found.verdict()
    assert found.least.depth < found.own.depth < found.pockets()[0].depth
    easy, close = (
        lobes(read_scene(END_MILL).replace({"milling.depth_mm": 1e3 * share * found.own.depth}), [18e3])
        for share in (0.6, 0.9)
    )
    assert (easy.judgement, close.judgement) == ("good", "watch")
    assert "is stable: " in easy.verdict() and "with little left" in close.verdict()
    none = read_scene(END_MILL).replace({"milling": CUT | {"depth_mm": None}})
    asked = lobes(none, [18e3])
    assert asked.judgement == "" and asked.verdict().startswith("The limit at 18,000 r/min is")


def test_a_single_bearing_with_a_rotor_has_lobes_as_a_set_has():
    tool = {"sections_mm": [[20.0, 9.0, 0.0]], "material": "tungsten-carbide"}
    scene = read_scene(EXAMPLES / "7003C-spindle.toml").replace({"milling": CUT, "tool": tool})
    found = lobes(scene, [20e3])
    assert found.place == "tip" and 0.0 < found.own.depth < 0.01
    # at the front end of the rotor, not at the bearing
    middle = lobes(scene.replace({"tool.position_mm": 0.0}), [20e3])
    half = 0.5 * scene.mounting.rotor.length_mm
    front = lobes(scene.replace({"tool.position_mm": -half}), [20e3])
    assert front.own == found.own and middle.own.depth > 1.2 * front.own.depth


@pytest.mark.heavy
@pytest.mark.parametrize(("bearing", "arrangement"), [("7009C", None), ("NSK-7010C", "DB")])
def test_bearings_of_the_catalogue_have_lobes(bearing, arrangement):
    made = read_scene_text(new_scene("drawn", bearing, arrangement=arrangement, sound=False))
    scene = made.replace({"milling": CUT | {"radial_immersion": 0.5, "direction": "up"}})
    found = lobes(scene, [scene.operation.speed_rpm], frequencies=np.linspace(50.0, 6000.0, 1191))
    assert 1e-5 < found.own.depth < 1.0


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"milling": None}, r"there is no cut to judge: give \[milling\] with teeth"),
        ({"milling.radial_immersion": 0.1}, r"radial_immersion = 0\.1 is refused; allowed: 0\.25 to 1"),
        ({"operation.speed_rpm": 0.0}, "does not turn, so no tooth cuts"),
    ],
)
def test_what_a_scene_must_have(keys, words):
    with pytest.raises(ValueError, match=words):
        lobes(cutting().replace(keys))


@pytest.mark.parametrize(
    ("speeds", "words"),
    [
        ([0.0, 1e4], "give speeds of the sign"),
        ([-1e4], "give speeds of the sign"),
        ([1e6], "allowed are up to"),
    ],
)
def test_speeds_that_are_refused(speeds, words):
    with pytest.raises(ValueError, match=words):
        lobes(cutting(), speeds)


def test_files_and_picture(tmp_path):
    found = lobes(cutting(), [14e3, 15e3])
    with found.save(tmp_path / "l.csv").open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert [float(row["speed_rpm"]) for row in rows] == [14e3, 15e3]
    assert float(rows[1]["depth_mm"]) == pytest.approx(1e3 * found.limits[1].depth)
    found.picture().savefig(tmp_path / "l.png")
    assert (tmp_path / "l.png").stat().st_size > 20_000
    with pytest.raises(ValueError, match="a table of lobes is written as"):
        found.save(tmp_path / "l.txt")


def test_a_warmer_ring_is_said_where_it_moves_the_limit():
    """Of spacers; springs hold their force, and the limit stays within the 5 %."""
    found = lobes(END_MILL, [18e3])
    key = "operation.inner_ring_temperature_degC"
    scene = read_scene(END_MILL)
    warm = lobes(scene.replace({key: scene.operation.inner_ring_temperature_degC + 10.0}), [18e3])
    assert found.warm == warm.own
    words = f"{1e3 * warm.own.depth:.3g} mm in place of {1e3 * found.own.depth:.3g} mm"
    (line,) = [line for line in found.cautions() if "10 K warmer" in line]
    assert words in line
    tool = {"sections_mm": [[20.0, 9.0, 0.0]], "material": "tungsten-carbide"}
    sprung = read_scene(EXAMPLES / "7003C-spindle.toml").replace({"milling": CUT, "tool": tool})
    held = lobes(sprung, [20e3])
    assert held.warm.depth == pytest.approx(held.own.depth, rel=0.05)
    assert not any("10 K warmer" in line for line in held.cautions())


def test_rings_that_may_not_be_warmer_are_said():
    """199 degC is the highest that a scene takes."""
    key = "operation.inner_ring_temperature_degC"
    found = lobes(read_scene(EXAMPLES / "7003C-spindle.toml").replace({"milling": CUT, key: 195.0}), [20e3])
    assert found.warm is None and any("nothing holds at 20,000 r/min" in one for one in found.cautions())


def limits_of(*millimetres):
    """Lobes with these limits at 1,000, 2,000, ... r/min; the scene's own speed is the first."""
    limits = tuple(Limit(1e3 * k, 1e-3 * depth, 500.0) for k, depth in enumerate(millimetres, start=1))
    return Lobes(cutting(), "nose", limits, limits[0], (1e3,))


def test_the_picture_shows_the_best_speed_and_its_legend_covers_no_curve():
    """The best lobe has 40 times the least limit; the axis once ended at 4 times."""
    figure = limits_of(0.5, 0.3, 12.0, 0.4).picture()
    axes = figure.axes[0]
    low, high = axes.get_ylim()
    assert low < 0.3 and high > 12.0
    figure.draw_without_rendering()
    assert axes.get_legend().get_window_extent().y0 >= axes.get_window_extent().y1 - 1.0


def test_speeds_without_a_limit_are_said_and_drawn():
    inf = math.inf
    assert "is 2,000, with no limit below the highest frequency." in limits_of(0.5, inf, 2.0).verdict()
    for depths_mm in ((0.5, inf, 2.0), (inf, inf)):
        limits_of(*depths_mm).picture().draw_without_rendering()


def test_a_tip_needs_a_tool():
    with pytest.raises(SceneError, match=r"there is no tip without a tool: give \[tool\]"):
        receptance(DB, [100.0], at="tip")
    with pytest.raises(ValueError, match="it is nose or tip"):
        receptance(DB, [100.0], at="toe")
