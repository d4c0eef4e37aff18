"""Branches, lines and crossings of the Campbell diagram."""

from types import SimpleNamespace

import numpy as np
import pytest

from fmu_bearing import campbell
from fmu_bearing.modal.campbell import excitation_lines
from fmu_bearing.modal.campbell.diagram import Branch, Diagram
from fmu_bearing.modal.campbell.excitation_lines import Line, lines, rates
from fmu_bearing.modal.modes.points import modes
from tests.messages import says

RPM = np.pi / 30.0
#: Crossings of the spindle by an independent computation, r/min: line, mode.
SPINDLE = {
    ("f_r", "outer radial forward"): 27_978.0,
    ("f_i", "inner axial"): 21_209.0,
    ("f_i + f_r", "inner tilt forward"): 14_526.0,
    ("f_i - f_r", "inner tilt backward"): 19_361.0,
    ("f_o", "inner axial"): 29_291.0,
}


@pytest.fixture(scope="module")
def spindle(gate):
    return campbell(gate("7003C-spindle"), np.linspace(2_000, 30_000, 15))


@pytest.mark.parametrize(("line", "mode"), SPINDLE)
def test_crossings_of_the_spindle(spindle, line, mode):
    found = [one for one in spindle.crossings() if one.line.name == line and one.branch.label == mode]
    assert [one.rpm for one in found] == pytest.approx([SPINDLE[line, mode]], rel=3e-3)


def test_a_crossing_is_where_both_frequencies_are_one(gate, spindle):
    """Against the modes at that very speed, not the modes of the grid."""
    for one in spindle.crossings()[::25]:
        at = modes(gate("7003C-spindle"), {"shaft_speed": one.rpm * RPM})
        assert at.near(one.frequency).frequency == pytest.approx(one.frequency, rel=1e-4)


def test_order_and_direction_agree_at_every_crossing(spindle):
    assert len(spindle.crossings()) > 50
    for one in spindle.crossings():
        assert one.line.order == one.branch.order
        assert one.branch.direction in (one.line.direction, "")


def test_branches_run_over_all_speeds_and_keep_their_shape(spindle):
    assert len(spindle.branches) == 11
    for branch in spindle.branches:
        assert branch.rpm.size == 15
        assert {mode.name for mode in branch.modes} == {branch.name}
        assert {mode.direction for mode in branch.modes} == {branch.direction}


def test_what_a_wave_of_a_race_can_move():
    """Heights of N balls on a wave of order k make waves round the bearing: all orders, brute force."""
    balls, orders = 12, set(range(6))
    at = rates(np.array([1000.0, 1100.0]), np.array([420.0, 462.0]), np.array([2500.0, 2750.0]), balls)
    from fmu_bearing.scene import read_scene
    from tests.conftest import GATES

    scene = read_scene(GATES / "7003C-spindle.toml")
    reported = {
        (one.source, one.surface_order, one.order, one.direction): one.frequency[0]
        for one in lines(scene, at, orders, 40e3) if one.source.endswith("race")
    }  # fmt: skip
    shaft, orbit = 1000.0, 420.0
    times = np.arange(4096) / 4096 * (2.0 * np.pi / 20.0)  # all frequencies are multiples of 20 rad/s
    for k in (10, 11, 12, 13, 14, 23, 24, 25):
        for source, turning in (("inner race", shaft), ("outer race", 0.0)):
            places = 2.0 * np.pi * np.arange(balls) / balls + orbit * times[:, None]
            heights = np.cos(k * (places - turning * times[:, None]))
            for n in orders:
                wave = (heights * np.exp(1j * n * places)).mean(axis=1)
                spectrum = np.fft.fft(wave) / times.size
                for direction, sign in (("forward", 1), ("backward", -1)) if n else (("", 1),):
                    bins = np.flatnonzero(np.abs(spectrum) > 1e-6)
                    speeds = np.where(bins > 2048, bins - 4096, bins) * 20.0
                    own = [abs(speed) for speed in speeds if n == 0 or speed * sign > 0.0]
                    key = (source, k, n, direction)
                    assert (key in reported) == bool(own), key
                    if own:
                        assert 2.0 * np.pi * reported[key] == pytest.approx(max(own), rel=1e-9)


def test_lines_are_those_of_the_scene(gate):
    scene = gate("7003C-spindle")
    single = scene.replace(
        {
            "imperfections.inner_race_amplitude_um": None,
            "imperfections.outer_race_amplitude_um": 0.0,
            "imperfections.inner_race_harmonic": [{"order": 13, "amplitude_um": 0.1}],
            "imperfections.unbalance_um": 0.0,
            "imperfections.ball_diameter_spread_nm": 0.0,
            "imperfections.ball_waviness_nm": 0.0,
            "imperfections.ball_form_nm": 0.0,
        }
    )
    found = campbell(single, np.linspace(8e3, 24e3, 5))
    assert {
        (one.line.name, one.line.order, one.line.direction) for one in found.crossings(in_scene=True)
    } == {("f_i + f_r", 1, "forward")}
    bare = campbell(scene.replace({"imperfections": None}), np.linspace(8e3, 24e3, 5))
    assert bare.crossings() and not bare.crossings(in_scene=True) and bare.nearest() is None
    assert bare.verdict().startswith("No line that the scene contains meets a mode")


def test_verdict_names_the_nearest_crossing(gate, spindle):
    """Operation at 20,000 r/min; f_i meets the axial mode 6 % above."""
    assert spindle.scene.operation.speed_rpm == 20_000.0
    words = "f_i (inner race) ... inner axial ... 21,208 r/min ... 6.0 % above ... 0.56 %"
    assert says(spindle.verdict(), words)


def straight(gate, own, meets, damping=0.02, amplitude=1e-8):
    """Diagram of modes at 1000 Hz, each with a line through it at one of the speeds ``meets`` (r/min)."""
    rpm = np.array([2e3, 10e3, 18e3, 26e3])
    points = tuple(SimpleNamespace(rpm=one) for one in rpm)
    branches = [
        Branch("inner radial", "forward", order, rpm, np.full(4, 1e3), np.full(4, damping), ())
        for order in range(len(meets))
    ]
    found = [
        Line(f"line {order}", "inner race", 12, order, "forward", 1e3 * rpm / speed, amplitude, 12)
        for order, speed in enumerate(meets)
    ]
    scene = gate("7003C-spindle").replace({"operation.speed_rpm": own})
    return Diagram(scene, points, tuple(branches), tuple(found), None, 20e3)


def test_velocity_of_a_crossing_by_hand(gate):
    """10 nm at 1000 Hz and Q = 1 / (2 0.02) = 25: 2 pi 1000 1e-8 25 = 1.5708 mm/s."""
    (one,) = straight(gate, 10e3, [12e3]).crossings()
    assert (one.rpm, one.frequency) == pytest.approx((12e3, 1e3), rel=1e-9)
    assert one.quality == pytest.approx(25.0) and one.velocity == pytest.approx(1.570796e-3, rel=1e-6)
    # with less damping than the margin of stability the margin counts: Q = 250
    (weak,) = straight(gate, 10e3, [12e3], damping=1e-4).crossings()
    assert weak.velocity == pytest.approx(15.70796e-3, rel=1e-6)


@pytest.mark.parametrize(
    ("meets", "nearest"),
    [([5_500.0, 15_000.0], 15_000.0), ([7_500.0, 13_000.0], 13_000.0), ([8_000.0, 13_000.0], 8_000.0)],
)
def test_nearest_crossing_on_either_side_of_operation_is_that_of_the_least_ratio(gate, meets, nearest):
    """At 10,000 r/min: 0.55 and 1.5, 0.75 and 1.3, 0.8 and 1.3 times the speed."""
    found = straight(gate, 10e3, meets)
    assert [one.rpm for one in found.crossings(in_scene=True)] == pytest.approx(meets)
    assert found.nearest().rpm == pytest.approx(nearest)


def test_amplitude_of_alternating_ball_sizes(gate, monkeypatch):
    """Balls larger and smaller by 100 nm of diameter in turn: a wave of 50 nm, of order 6 for 12 balls.

    Of that order only the cosine fits the balls; of order 2 cosine and sine do.
    """
    at, angle = rates(*np.array([[1000.0], [420.0], [2500.0]]), 12), 2.0 * np.pi * np.arange(12) / 12
    for order in (2, 6):
        monkeypatch.setattr(excitation_lines, "ball_oversizes", lambda _, n=order: 1e-7 * np.cos(n * angle))
        found = {
            line.order: line.amplitude
            for line in lines(gate("7003C-spindle"), at, {1, 2, 6}, 20e3)
            if line.source == "ball sizes"
        }
        assert found == pytest.approx({n: 5e-8 * (n == order) for n in (1, 2, 6)}, abs=1e-20)


def test_instability_is_told_with_its_speed(gate):
    found = campbell(gate("7009C-full-ceramic").with_rigid_rings(), [6e3, 12e3, 18e3])
    (line,) = [text for text in found.cautions() if "instability" in text]
    assert "'inner tilt forward'" in line and "18,000 r/min" in line


def test_standstill_is_left_out_and_speeds_are_sorted(gate):
    found = campbell(gate("7003C-spindle"), [20_000.0, 0.0, 10_000.0, 15_000.0])
    assert found.rpm == pytest.approx([10_000.0, 15_000.0, 20_000.0])
    back = campbell(gate("7003C-spindle"), [-20_000.0, -10_000.0, -15_000.0])
    own = [branch.frequency[-1] for branch in found.branches]
    assert [branch.frequency[-1] for branch in back.branches] == pytest.approx(own, rel=1e-6)


@pytest.mark.parametrize(
    ("speeds", "more", "words"),
    [
        ([1e4, 2e4], {}, "at least 3 different ones"),
        ([-1e4, 1e4, 2e4], {}, "in one direction"),
        (["fast"], {}, "give numbers, in r/min"),
        ([1e4, 2e4, 1e6], {}, "shaft_speed"),
        (None, {"inputs": {"shaft_speed": 1.0}}, "give speeds, in r/min"),
        (None, {"highest": 0.0}, "positive number of hertz"),
    ],
)
def test_refusals(gate, speeds, more, words):
    with pytest.raises(ValueError, match=words):
        campbell(gate("7003C-spindle"), speeds, **more)


@pytest.mark.heavy
def test_fifteen_speeds_take_less_than_20_s(gate):
    import time

    begin = time.process_time()
    campbell(gate("7009C-full-ceramic"), np.linspace(2e3, 3e4, 15))
    assert time.process_time() - begin < 20.0
