"""Error motion of runs: closed forms, what has to vanish, single bearing and set, refusals."""

from dataclasses import replace

import numpy as np
import pytest

from fmu_bearing import (
    SceneError,
    error_motion,
    new_scene,
    operating_point,
    read_scene,
    simulate,
    with_fidelity,
)
from fmu_bearing.acoustics.analysis.spectrum import KinematicFrequencies
from fmu_bearing.metrology.at_speed import DIRECTIONS, AtSpeed
from fmu_bearing.metrology.error_motion import BOUND
from fmu_bearing.metrology.nose import PER_REVOLUTION, Nose, nose_of_run, resampled
from fmu_bearing.prepare.imperfections import ball_oversizes
from fmu_bearing.scene import read_scene_text
from tests.conftest import EXAMPLES
from tests.spindle.one import MIDDLE, set_of_one

RPM = 2000.0
FEW = 20  # revolutions
NM = 1e-9
#: As of a new scene of this grade.
P4 = {
    "imperfections.inner_race_amplitude_um": 0.3,
    "imperfections.outer_race_amplitude_um": 0.3,
    "imperfections.waviness_exponent": 1.35,
    "imperfections.highest_order": None,
    "imperfections.highest_frequency_kHz": 20.0,
    "imperfections.contact_filter": True,
    "imperfections.ball_form_nm": 80.0,
}
WITHOUT = {
    "imperfections.unbalance_um": 0.0,
    "imperfections.inner_race_amplitude_um": 0.0,
    "imperfections.outer_race_amplitude_um": 0.0,
    "imperfections.ball_form_nm": 0.0,
}


@pytest.fixture(scope="module")
def bare(scene):
    """The 7003C alone at 2000 r/min, fidelity rings."""
    found = scene("7003C-bare").replace({"sound": None, "operation.speed_rpm": RPM})
    return with_fidelity(found, model="rings")


@pytest.fixture(scope="module")
def found(bare):
    return error_motion(bare, revolutions=FEW)


def by_direction(one):
    return {values.direction: values for values in one.values}


@pytest.mark.heavy
def test_without_surfaces_nothing_moves_in_rings(bare):
    still = error_motion(bare.replace({"imperfections": None}), revolutions=FEW)
    for values in still.speeds[0].values[:4]:
        # The rest of balls and cage is that of the linear operator within 3e-4 nm, and comes in by and by;
        # waves of the scene are 60 nm.
        assert values.asynchronous < 1e-3 * NM
        assert values.synchronous < 1e-3 * NM and values.synchronous_by_line < 1e-3 * NM
    assert any("no imperfections" in line for line in still.remarks())
    assert not any("nearer to a whole order" in line for line in still.remarks())


@pytest.mark.heavy
def test_without_surfaces_the_cage_alone_moves_the_nose_in_full(bare):
    """The cage of this scene, 5 um off balance, rests in its pockets and knocks."""
    scene = with_fidelity(bare.replace({"imperfections": None}), model="full")
    values = by_direction(error_motion(scene, revolutions=FEW).speeds[0])
    for direction in ("fixed y", "fixed z", "rotating"):
        # 3 to 13 nm measured, which the start changes; 2 % of it repeats with the shaft
        assert values[direction].asynchronous < 20.0 * NM
        assert values[direction].synchronous_by_line < 0.5 * NM


def test_ball_sizes_move_the_axis_by_their_closed_form(bare):
    """Balls of unequal size shift the inner ring until their excess loads balance.

    Springs of one stiffness at the contact angle a: the ring's shift along a ball is its excess times
    2 / (Z cos a), summed as vectors, in the plane where the contact lines meet the axis. There a tilt of the
    ring does not move it sideways.
    """
    spread = bare.replace(WITHOUT)
    count, pitch = spread.bearing.ball_count, 1e-3 * spread.bearing.pitch_diameter_mm
    angle = operating_point(spread).bearings[0].contacts["inner"]["angle_mean"]
    turned = 2.0 * np.pi * np.arange(count) / count
    wanted = 2.0 / (count * np.cos(angle)) * abs((ball_oversizes(spread) * np.exp(1j * turned)).sum())
    apex = -0.5 * pitch * np.tan(angle)  # behind the balls: preload pushes the inner ring towards +X
    one = error_motion(spread, at=apex, revolutions=FEW).speeds[0]
    line = one.lines[0]
    assert (line.origin.name, line.origin.source) == ("f_c", "ball sizes, cage")
    # contact angles differ by the loads: 0.3 % measured
    assert line.radial == pytest.approx(wanted, rel=5e-3)
    assert wanted == pytest.approx(13.7 * NM, abs=0.1 * NM)
    # what repeats: unequal loads, far below the ball spread
    assert by_direction(one)["rotating"].synchronous_by_line < 0.1 * NM
    middle = error_motion(spread, revolutions=FEW).speeds[0].lines[0]
    assert middle.radial == pytest.approx(11.8 * NM, abs=0.1 * NM)
    # the point moves with the ring as a rigid body, in phase here
    assert line.radial == pytest.approx(middle.radial - apex * middle.tilt, rel=1e-3)


@pytest.mark.heavy
def test_table_lines_and_parts(found):
    columns, rows = found.table()
    assert [row[2] for row in rows] == list(DIRECTIONS)
    assert len(columns) == len(rows[0])
    one = found.speeds[0]
    assert found.lines(3)[1][0][1] == one.lines[0].origin.name
    sources = {part.source: part for part in one.per_source}
    (whole,) = one.per_bearing
    # a part is no more than the whole, and widths of parts add up to no less
    assert max(part.radial for part in sources.values()) < whole.radial
    assert sum(part.radial for part in sources.values()) > whole.radial
    # order 126 of the balls lies on a mode: lines hold 97 % of the energy (measured)
    assert 0.95 < one.explained <= 1.0
    # what is left of the bearing's own lines is what the whole is: the lines hold the rest, 3 % of the energy
    assert whole.radial == pytest.approx(
        max(by_direction(one)[name].asynchronous for name in ("fixed y", "fixed z")), rel=0.15
    )
    assert BOUND in found.remarks()
    assert any("nearer to a whole order than 1/20" in line for line in found.remarks())


@pytest.mark.heavy
def test_files(found, tmp_path):
    files = found.save(tmp_path / "out")
    assert [file.name for file in files] == [
        "error-motion.csv", "lines.csv", "bearings.csv", "sources.csv", "polar.png",
    ]  # fmt: skip
    assert all(file.stat().st_size > 50 for file in files)


@pytest.mark.heavy
def test_against_ground_holds_what_the_outer_ring_does(bare, found):
    ground = error_motion(bare, revolutions=FEW, against="ground")
    assert (found.against, ground.against) == ("outer ring", "ground")
    ours, theirs = by_direction(found.speeds[0]), by_direction(ground.speeds[0])
    # a pedestal of 1e8 N/m gives way by a tenth of what the contacts do
    assert ours["axial"].asynchronous != theirs["axial"].asynchronous
    assert ours["axial"].asynchronous == pytest.approx(theirs["axial"].asynchronous, rel=0.1)


def test_a_run_that_was_read_at_other_times_has_the_same_motion(bare):
    """The last 20 revolutions of a run at 20,000 r/min, read 77 times per revolution as a report does."""
    fast = bare.replace({"operation.speed_rpm": 20e3})
    turn = 60.0 / 20e3
    names = [f"{ring}_ring.displacement.{axis}" for ring in ("inner", "outer") for axis in "xyz"]
    run = simulate(fast, 32.0 * turn, step=turn / 77.0, outputs=names, progress=False)
    places = np.column_stack([run[name] for name in names])
    motion = np.hstack([places[:, :3] - places[:, 3:], np.zeros((len(places), 2))])
    found = AtSpeed(resampled(fast, run["time"], motion))
    wanted = AtSpeed(nose_of_run(fast, 0.0, FEW, True))
    for direction in ("fixed y", "fixed z", "rotating", "axial"):
        a, b = found.signal(direction)[-FEW:], wanted.signal(direction)
        # between readings lies a cubic: waves of order 30 are a quarter of the rate, and small
        assert np.abs(a - b).max() < 0.05 * np.ptp(b)
    with pytest.raises(ValueError, match=r"19 whole revolutions were kept.*run for 0\.06 s or longer"):
        resampled(fast, run["time"][: 19 * 77 + 5], motion[: 19 * 77 + 5])


@pytest.mark.parametrize("rpm", [600.0, -600.0])
def test_a_vector_that_turns_with_the_shaft_is_constant_in_the_rotating_direction(scene, rpm):
    angle = np.sign(rpm) * 2.0 * np.pi * np.arange(1, FEW * PER_REVOLUTION + 1) / PER_REVOLUTION
    motion = np.column_stack([0.0 * angle, np.cos(angle), np.sin(angle), np.cos(angle), np.sin(angle)])
    rates = KinematicFrequencies(10.0, 4.2, 28.0, 69.6, 50.4)
    turned = scene("7003C-bare").replace({"operation.speed_rpm": rpm})
    one = AtSpeed(Nose(turned, FEW, motion, (rates,)))
    np.testing.assert_allclose(one.signal("rotating"), 1.0, rtol=1e-12)
    # an artefact off centre is no error: order 1 of a fixed direction, the circle of the rotating one
    for values in one.values:
        if values.direction != "axial":
            assert values.synchronous < 1e-9 and values.synchronous_by_line < 1e-4


@pytest.mark.parametrize(("other", "shared"), [(0.42001, True), (0.47, False)])
def test_a_remark_says_where_lines_of_bearings_are_shared(bare, other, shared):
    """The inner race of one of two bearings moves the nose; with cages of nearly one rate each has a half."""
    rates = [
        KinematicFrequencies(1.0, cage, 2.8 + cage, 12.0 * (1.0 - cage), 12.0 * cage)
        for cage in (0.42, other)
    ]
    angle = 2.0 * np.pi * np.arange(1, FEW * PER_REVOLUTION + 1) / PER_REVOLUTION
    motion = np.zeros((len(angle), 5))
    order = rates[0].f_i - 1.0
    motion[:, 1:3] = 10.0 * NM * np.column_stack([np.cos(order * angle), np.sin(order * angle)])
    one = AtSpeed(Nose(bare, FEW, motion, tuple(rates)))
    # the pull of the fit to small amplitudes leaves a half to each: 5 % off, because the lines drift a little
    assert one.lines[0].radial == pytest.approx((5.0 if shared else 10.0) * NM, rel=0.1 if shared else 0.01)
    assert any("such lines are shared equally" in line for line in one.remarks()) == shared


@pytest.mark.heavy
def test_a_set_of_one_moves_as_the_bearing_does(scene):
    """Of a set on its own pedestal, at the plane of its balls, against the ground."""
    flaws = scene("7003C-bare").imperfections.model_copy(update={"unbalance_um": 0.0})
    several, one = set_of_one(RPM, changes={"fidelity.model": "rings"}, imperfections=flaws)
    several = several.model_copy(update={"imperfections": flaws})
    ours = error_motion(several, at=1e-3 * MIDDLE, revolutions=FEW).speeds[0]
    theirs = error_motion(one, against="ground", revolutions=FEW).speeds[0]
    for a, b in zip(ours.values, theirs.values, strict=True):
        # a set has its losses where forces put its rings across the axis (tests/test_set_of_one.py), and its
        # widths are sums of a hundred lines, some on weakly damped modes
        assert a.asynchronous == pytest.approx(b.asynchronous, rel=0.02), a.direction
    assert [line.origin.name for line in ours.lines[:3]] == [line.origin.name for line in theirs.lines[:3]]


@pytest.mark.parametrize(
    ("given", "words"),
    [
        ({"speeds": [0.0]}, "0 r/min is refused: an axis of rotation needs a shaft that turns"),
        ({"speeds": [2e5]}, "200000 r/min is refused: allowed are"),
        ({"speeds": []}, "none is given"),
        ({"speeds": ["fast"]}, "speeds = 'fast' is refused: give a number"),
        ({"speeds": lambda t: 1e3 * t}, "a speed that changes is refused, because no revolution repeats"),
        ({"revolutions": 19}, "revolutions = 19 is refused: allowed are whole numbers from 20"),
        ({"revolutions": 20.5}, "revolutions = 20.5 is refused"),
        ({"revolutions": 10**6}, "to 2000"),
        ({"at": 6.0}, "at = 6000 mm is refused, no place of the shaft or ahead of it"),
        ({"at": float("nan")}, "at = nan mm is refused"),
        ({"against": "housing"}, "against = 'housing' is refused: it is outer ring or ground"),
        ({"inputs": {"shaft_speed": 100.0}}, "give speeds, in r/min"),
        ({"inputs": {"preloud": 100.0}}, "preload"),
    ],
)
def test_refusals(bare, given, words):
    with pytest.raises(ValueError, match=words):
        error_motion(bare, **given)


def test_refusals_of_sets():
    quad = read_scene(EXAMPLES.parent / "spindle_set" / "7003C-QBC.toml")
    with pytest.raises(SceneError, match="cannot have error motion against an outer ring: it has several"):
        error_motion(quad, against="outer ring")
    with pytest.raises(ValueError, match="from the nose of the shaft"):
        error_motion(quad, at=4.0)


@pytest.mark.heavy
def test_of_many_speeds_six_are_drawn_evenly_among_them(found):
    one = found.speeds[0]
    speeds = [replace(one, nose=replace(one.nose, scene=one.nose.scene.replace(
        {"operation.speed_rpm": 1000.0 * (k + 1)}))) for k in range(11)]  # fmt: skip
    axes = replace(found, speeds=tuple(speeds)).polar().axes
    assert [ax.get_title().split(" r/min")[0] for ax in axes] == [
        f"rotating, {rpm},000" for rpm in (1, 3, 5, 7, 9, 11)
    ]


def test_unknown_direction(found):
    with pytest.raises(ValueError, match="direction = 'radial' is refused: it is fixed y"):
        found.polar("radial")


@pytest.mark.heavy
@pytest.mark.parametrize(("model", "within"), [("rings", 1.0), ("full", 3.0)])
def test_by_line_agrees_from_16_revolutions_on(bare, model, within):
    """A 7003C alone of grade P4 at 2000 r/min; an average over 16 revolutions reads 30 nm."""
    scene = with_fidelity(bare.replace(P4), model=model)
    found = {count: by_direction(AtSpeed(nose_of_run(scene, 0.0, count, True))) for count in (16, 32, 200)}
    for direction in ("fixed y", "fixed z", "rotating"):
        true = found[200][direction].synchronous_by_line
        for count in (16, 32):
            # 0.6 and 2.1 nm measured: with full the cage's knocks are no line
            assert found[count][direction].synchronous_by_line == pytest.approx(true, abs=within * NM)
        assert found[16][direction].synchronous > 25.0 * NM


@pytest.mark.heavy
def test_grades_of_a_7003C():
    """Asynchronous radial motion of a new 7003C hybrid at 2000 r/min by grade, mean of four seeds.

    The package's own figures; an earlier trial read 0.11, 0.18 (0.14 to 0.21) and 0.34 um, with 8 seeds.
    """
    for grade, wanted in (("P2", 0.10), ("P4", 0.15), ("P5", 0.285)):
        given = {"kind": "hybrid", "grade": grade, "sound": False}
        text = new_scene("one", "7003C", speed_rpm=20e3, preload_N=94.0, **given)
        scene = with_fidelity(read_scene_text(text), model="rings")
        found = []
        for seed in (1, 2, 3, 4):
            one = error_motion(scene.replace({"imperfections.seed": seed}), RPM, revolutions=50).speeds[0]
            values = by_direction(one)
            found.append(max(values[name].asynchronous for name in ("fixed y", "fixed z")))
        # seeds scatter by 15 %, their mean by half of that
        assert 1e6 * np.mean(found) == pytest.approx(wanted, rel=0.1), grade
        assert np.ptp(found) < 0.6 * np.mean(found)
