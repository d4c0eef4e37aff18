"""Choices of a designer: against two operating points, against two recordings, and what is refused."""

import math

import numpy as np
import pytest

from fmu_bearing import record
from fmu_bearing.accuracy import changes as room
from fmu_bearing.accuracy.alternatives import Alternative, alternatives
from fmu_bearing.accuracy.change_levels import ChangeLevels
from fmu_bearing.accuracy.changed import Change, Changes, LevelBasis, Point, shown_level, shown_ratio
from fmu_bearing.accuracy.changes import changes, point
from fmu_bearing.design.operating_point import operating_point
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene.read import catalogue, with_fidelity


@pytest.fixture(scope="module")
def spindle(example):
    return example("7003C-spindle")


@pytest.fixture(scope="module")
def found(spindle):
    return changes(spindle, seeds=2)


def named(found, begin):
    (row,) = [each for each in found.changes if each.choice.words.startswith(begin)]
    return row


def only(monkeypatch, *choices):
    monkeypatch.setattr(room, "alternatives", lambda scene: list(choices))


def life_of(scene):
    """L10r (h) by the formulas of ISO 16281 on the mean loads of the operating point: own sums."""
    b, turning = scene.bearing, scene.operation.speed_rpm
    z, ball, pitch, a = b.ball_count, b.ball_diameter_mm, b.pitch_diameter_mm, math.radians(15.0)
    g = ball * math.cos(a) / pitch
    r = ((1 - g) / (1 + g)) ** 1.72
    fc = 38.20 * (1 + (1.04 * r) ** (10 / 3)) ** -0.3 * g**0.3 * (1 - g) ** 1.39 / (1 + g) ** (1 / 3)
    c = 1.3 * fc * 26**0.41 * math.cos(a) ** 0.7 * z ** (2 / 3) * ball**1.8
    # closer grooves than these do not raise a rating
    fi, fo = max(b.inner_conformity, 0.52), max(b.outer_conformity, 0.53)
    groove = 1.044 * r * (fi / fo * (2 * fo - 1) / (2 * fi - 1)) ** 0.41
    inner = c / (0.407 * z * math.cos(a) ** 0.7) * (1 + groove ** (10 / 3)) ** 0.3
    outer = c / (0.389 * z * math.cos(a) ** 0.7) * (1 + groove ** (-10 / 3)) ** 0.3
    loads = operating_point(scene).bearings[0].contacts
    shares = [(q / loads[k]["load_mean"]) ** (-10 / 3) for k, q in (("inner", inner), ("outer", outer))]
    return sum(shares) ** -0.9 * 1e6 / (60 * turning)


@pytest.mark.heavy
@pytest.mark.parametrize(
    "begin", ["preload 500 -> 350 N", "balls ceramic", "inner groove 0.515 -> 0.51", "oil 40 -> 50"]
)
def test_life_and_torque_are_those_of_two_operating_points(found, spindle, begin):
    row = named(found, begin)
    other = spindle.replace(row.choice.values)
    # weight, 20 N of rotor, spreads the loads by 1 %: means to powers differ by its square
    assert row.before.life == pytest.approx(life_of(spindle), rel=2e-3)
    assert row.after.life == pytest.approx(life_of(other), rel=2e-3)
    torques = []
    for one in (spindle, other):
        perfect = one.replace({"imperfections": None, "sound": None})
        bearing = Instance(prepare(perfect, fidelity="response"))
        bearing.initialise()
        torques.append(1e3 * bearing.get("friction_torque"))
    assert (row.before.torque, row.after.torque) == pytest.approx(torques, rel=1e-12)
    assert row.ratio("torque") == pytest.approx(torques[1] / torques[0], rel=1e-12)


def test_the_direction_of_turning_changes_no_figure(spindle):
    there, back = point(spindle), point(spindle.replace({"operation.speed_rpm": -20_000.0}))
    # gravity acts at other balls: 1 % of their load
    assert back.torque == pytest.approx(there.torque, rel=0.01) and there.torque > 0.0
    assert back.life == pytest.approx(there.life, rel=0.01)


@pytest.mark.heavy
@pytest.mark.parametrize("begin", ["preload 500 -> 350 N", "grade P4 -> P2"])
def test_levels_are_those_of_two_recordings_with_the_same_seed(found, spindle, begin):
    row = named(found, begin)
    received = found.basis
    assert received.fidelity == "response" and len(received.seeds) == 2
    for k, seed in enumerate(received.seeds):
        levels = []
        for values in ({}, row.choice.values):
            drawn = with_fidelity(
                spindle.replace({"imperfections.seed": seed} | dict(values)), model="response"
            )
            run = record(drawn, received.duration, settle=received.settle, progress=False)
            levels.append(run.levels([received.microphone], weighting="A", resolution=20.0)[0])
        # the same sums in another order
        assert row.levels[k] == pytest.approx(levels[1] - levels[0], abs=1e-9)
        if k == 0:
            assert received.level == pytest.approx(levels[0], abs=1e-9)
            loudest = run.levels(weighting="A", resolution=20.0)
    assert len(loudest) > 1
    assert row.level == pytest.approx(row.levels.mean())
    assert row.level_range == (row.levels.min(), row.levels.max())


@pytest.mark.heavy
def test_the_microphone_is_the_loudest(found, spindle):
    run = record(with_fidelity(spindle, model="response"), 0.06, settle=0.02, progress=False)
    levels = run.levels(weighting="A", resolution=20.0)
    assert found.basis.microphone == run.microphones[int(np.argmax(levels))][0]


@pytest.mark.heavy
def test_every_choice_is_there_and_ranked(found):
    topics = {each.choice.topic for each in found.changes}
    assert topics == {
        "preload", "balls", "grade", "race grade", "ball grade",
        "oil", "conformity", "contact angle", "speed", "pedestal", "balance",
    }  # fmt: skip
    assert len({each.choice.words for each in found.changes}) == len(found.changes) >= 20
    assert found.figures == ("level", "life", "torque") and not found.refused
    for figure in found.figures:
        rows = found.ranked(figure)
        acting = [each for each in rows if each.acts(figure)]
        assert rows[: len(acting)] == acting  # what is no finding comes last
        gains = [each.gain(figure) for each in acting]
        assert gains == sorted(gains, reverse=True) and gains[0] > 0.0 > gains[-1]
    # less preload: longer life, less torque; oil does nothing to life, a grade nothing to torque
    assert named(found, "preload 500 -> 350 N").ratio("life") > 2.0
    assert not named(found, "oil 40 -> 50").acts("life") and not named(found, "grade P4 -> P5").acts("torque")


@pytest.mark.heavy
def test_summary_and_table_have_the_figures(found):
    reported = found.summary()
    assert reported["seeds"] == list(found.basis.seeds) and reported["microphone"] == found.basis.microphone
    columns, rows = found.table()
    assert columns[0] == "change" and {len(row) for row in rows} == {len(columns)}
    for each, row, data in zip(found.ranked("level"), rows, reported["changes"], strict=True):
        assert data["change"] == each.choice.words == row[0]
        assert data["level_change_dB"] == pytest.approx(np.mean(each.levels), abs=1e-12)
        assert (data["level_change_low_dB"], data["level_change_high_dB"]) == (
            min(each.levels), max(each.levels),
        )  # fmt: skip
        if each.acts("level"):
            assert float(row[1]) == pytest.approx(np.mean(each.levels), abs=0.0501)
        else:
            assert row[1] == ("no finding" if each.depends_on_seed else "none")
        for name, unit, column in (
            ("life", "h", "life"),
            ("torque", "N_mm", "torque"),
            ("stiffness", "N_um", "stiff."),
        ):
            ratio = data[f"{name}_{unit}"] / reported[f"{name}_{unit}"]
            assert data[f"{name}_ratio"] == pytest.approx(ratio, rel=1e-12)
            cell = row[columns.index(column)]
            shown = 1.0 if cell == "=" else float(cell.removeprefix("x"))
            # a hundredth of change is none; three digits, or two after the point
            assert shown == pytest.approx(ratio, abs=0.0101, rel=5e-3)


def test_how_differences_and_ratios_are_printed():
    assert [shown_level(x) for x in (-3.14159, 0.06, -0.04, 12.34)] == ["-3.1", "+0.1", "0.0", "+12.3"]
    assert [shown_level(x, 2) for x in (-3.14159, 12.34)] == ["-3.1", "+12"]
    ratios = {0.8512: "x0.85", 1.005: "=", 0.995: "=", 1.02: "x1.02", 12.34: "x12.3", 250.4: "x250"}
    assert {ratio: shown_ratio(ratio) for ratio in ratios} == ratios
    assert shown_ratio(math.nan) == ""


def one_change(levels, **ratios):
    before = Point(10.0, 1000.0, 100.0)
    after = Point(
        *(b * ratios.get(k, 1.0) for k, b in zip(("torque", "life", "stiffness"), before, strict=False))
    )
    return Change(Alternative("preload", "x", {"mounting.preload_N": 1.0}), before, after, np.array(levels))


def test_a_sign_that_depends_on_the_seed_is_no_finding():
    assert one_change([-3.0, -1.0]).acts("level")
    assert not one_change([-3.0, 1.0]).acts("level") and one_change([-3.0, 1.0]).depends_on_seed
    assert not one_change([-3.0, -1.0]).depends_on_seed and not one_change([-0.01, 0.01]).depends_on_seed
    assert not one_change([-0.05, -0.04]).acts("level")  # nobody hears it
    # printed as -0.1, as one that counts
    assert one_change([-0.09, -0.07]).acts("level")
    assert one_change([], life=2.0).gain("life") == pytest.approx(math.log(2.0))
    assert one_change([], torque=2.0).gain("torque") == pytest.approx(-math.log(2.0))
    assert not one_change([], life=1.005).acts("life")


def test_a_resonance_is_reported_where_less_and_more_are_quieter(spindle):
    def study(low, high):
        rows = [
            Change(
                Alternative("preload", str(force), {"mounting.preload_N": force}),
                before,
                before,
                np.array(db),
            )
            for force, db in ((350.0, low), (30.0, [-9.0, -9.0]), (700.0, high))
        ]
        return Changes(spindle, before, LevelBasis(), tuple(rows))

    before = Point(1.0, 1.0, 1.0)
    assert study([-2.0, -3.0], [-1.0, -4.0]).resonances() == ["preload"]
    assert "resonance" in study([-2.0, -3.0], [-1.0, -4.0]).resonance()
    assert study([-2.0, -3.0], [-1.0, 4.0]).resonance() == ""  # no finding above
    assert study([2.0, 3.0], [-1.0, -4.0]).resonance() == ""  # quieter one way only


def test_choices_follow_the_scene(scene, spindle):
    def words(one, topic):
        return [each.words for each in alternatives(one) if each.topic == topic]

    assert words(spindle, "balls") == ["balls ceramic -> steel"]
    steel = spindle.replace({"materials.balls": "GCr15"})
    assert words(steel, "balls") == ["balls steel -> Si3N4"]
    ceramic = scene("7009C-full-ceramic")
    assert words(ceramic, "balls") == [] and not any("heavy" in text for text in words(ceramic, "preload"))
    grades = list(catalogue("grades"))
    assert grades == ["P0", "P6", "P5", "P4", "P2"]  # from coarse to fine, as `alternatives` reads them
    for name, finer, coarser in (("P0", "P6", ""), ("P4", "P2", "P5"), ("P2", "", "P4")):
        made = spindle.replace({"imperfections.grade": name})
        assert words(made, "grade") == [f"grade {name} -> {other}" for other in (finer, coarser) if other]
    own = spindle.replace(
        {"imperfections.inner_race_amplitude_um": 0.2, "imperfections.outer_race_amplitude_um": 0.2}
    )
    assert words(own, "grade") == ["own surfaces -> grade P2", "own surfaces -> grade P4"]
    assert words(spindle.replace({"imperfections": None}), "grade") == []
    # races and balls alone: the next finer and coarser, each without the values of the other
    assert words(spindle, "race grade") == ["races P4 -> P2", "races P4 -> P5"]
    assert words(spindle, "ball grade") == ["balls G3 -> G5"]
    assert words(spindle.replace({"imperfections.grade": "P5"}), "ball grade") == [
        "balls G5 -> G3",
        "balls G5 -> G10",
    ]
    assert words(own, "race grade") == ["own races -> P2", "own races -> P4"]
    uneven = spindle.replace({"imperfections.inner_race_amplitude_um": 0.2})
    assert words(uneven, "race grade") == ["own races -> P2", "own races -> P4"]
    values = {each.topic: set(each.values) for each in alternatives(spindle)}
    assert values["race grade"] == {f"imperfections.{race}_race_amplitude_um" for race in ("inner", "outer")}
    assert values["ball grade"] == {"imperfections.ball_form_nm", "imperfections.ball_diameter_spread_nm"}
    round_balls = spindle.replace({"imperfections.ball_form_nm": 0.0})
    assert words(round_balls, "ball grade") == []
    # grades are of one law: with another exponent their amplitudes say nothing
    flat = spindle.replace({"imperfections.waviness_exponent": 1.0})
    halved, doubled = (each for each in alternatives(flat) if each.topic == "grade")
    assert halved.values["imperfections.inner_race_amplitude_um"] == 0.15
    assert doubled.values["imperfections.ball_form_nm"] == 160.0
    wide = spindle.replace({"bearing.contact_angle_deg": 25.0})
    assert words(wide, "contact angle") == ["contact angle 25 -> 15 deg"]
    # makers' classes are shares of C: 0.015 of 5956 N at 15 deg (designers' notes)
    assert "preload 500 -> 89.4 N medium" in words(spindle, "preload")
    # NSK's own ones are printed, and at 40 deg no maker gives any
    printed = words(spindle.replace({"bearing.catalogue": "NSK-7003C"}), "preload")
    assert [one for one in printed if one.endswith("light")] == [
        "preload 500 -> 14 N extra light", "preload 500 -> 29 N light",
    ]  # fmt: skip
    assert len(words(spindle.replace({"bearing.contact_angle_deg": 40.0}), "preload")) == 2


def test_what_the_scene_or_the_engine_refuses_is_reported(spindle, monkeypatch):
    only(
        monkeypatch,
        Alternative("preload", "too much", {"mounting.preload_N": 2e4}),
        Alternative("preload", "less", {"mounting.preload_N": 400.0}),
    )
    found = changes(spindle, levels=False)
    (refused,) = found.refused
    assert refused.choice.words == "too much" and "10000" in refused.reason.replace(",", "")
    assert not refused.reason.startswith(spindle.name) and "Left out: too much" in " ".join(found.remarks())
    assert [each.choice.words for each in found.ranked("life")] == ["less"]
    assert found.summary()["changes"][-1]["reason"] == refused.reason


@pytest.mark.heavy
def test_a_warning_of_the_choice_alone_is_reported(found):
    angle = named(found, "contact angle")
    assert any("beyond its shoulder" in text for text in angle.cautions)
    assert named(found, "oil 40 -> 50").cautions == ()
    assert any("contact angle" in text and "shoulder" in text for text in found.remarks())


@pytest.mark.parametrize(
    ("values", "words"),
    [
        ({"sound": None}, "no microphones"),
        ({"imperfections": None}, "perfect bearing is silent"),
        ({"sound.radiation_model": "paper"}, "paper"),
    ],
)
def test_without_levels_life_and_torque_remain(spindle, monkeypatch, values, words):
    only(monkeypatch, Alternative("preload", "less", {"mounting.preload_N": 400.0}))
    found = changes(spindle.replace(values))
    assert found.figures == ("life", "torque") and words in found.no_level and words in found.conditions()
    assert math.isnan(found.changes[0].level) and found.table()[0] == ["change", "life", "torque", "stiff."]


@pytest.mark.heavy
def test_no_life_for_ceramic_rings_and_open_grooves(scene, spindle, monkeypatch):
    only(
        monkeypatch,
        Alternative("preload", "less", {"mounting.preload_N": 300.0}),
        Alternative("speed", "slower", {"operation.speed_rpm": 15_000.0}),
    )
    found = changes(scene("7009C-full-ceramic"), levels=False)
    assert found.figures == ("torque",) and "rings of steel" in found.conditions()
    assert all(math.isnan(each.ratio("life")) for each in found.changes)
    assert math.isnan(point(spindle.replace({"bearing.inner_conformity": 0.525})).life)


@pytest.mark.heavy
def test_rings_that_bend_are_run_with_fidelity_full(scene, monkeypatch):
    only(monkeypatch, Alternative("preload", "less", {"mounting.preload_N": 300.0}))
    found = changes(scene("7009C-steel"), seeds=5)
    assert found.basis.fidelity == "full" and len(found.basis.seeds) == 3
    assert found.changes[0].levels.shape == (3,)


@pytest.mark.heavy
def test_a_weakly_damped_bearing_is_judged_by_full(spindle, example, monkeypatch):
    """`response` and `rings` agree on the dry 7003C at 8,000 r/min, 18 dB(A) away from `full`."""
    only(monkeypatch)
    received = []

    def levels(self, scene, fidelity, seed):
        received.append(fidelity)
        return np.full(len(scene.microphones), 50.0)

    monkeypatch.setattr(ChangeLevels, "_all", levels)
    flaws = spindle.imperfections.model_dump(mode="json", exclude_none=True)
    dry = example("7003C-impact").replace({"operation.speed_rpm": 8000.0, "imperfections": flaws})
    found = changes(with_fidelity(dry, model="full"), seeds=5)
    assert found.basis.fidelity == "full" and set(received) == {"full"} and len(found.basis.seeds) == 3
    assert found.basis.doubt == found.summary()["doubt"] == ""
    # a scene that asks for one of the others gets it, with the remark
    asked = changes(with_fidelity(dry, model="rings"), seeds=1)
    assert asked.basis.fidelity == "rings"
    assert any("of fidelity rings are in doubt" in line for line in asked.remarks())
    received.clear()
    assert changes(spindle, seeds=1).basis.fidelity == "response"
    assert received[:2] == ["full", "response"] and set(received[1:]) == {"response"}


@pytest.mark.heavy
def test_a_loud_cage_is_judged_by_full(spindle, monkeypatch):
    """Levels of full decide: 6 dB above, with the cage's sound, neither of the others is taken."""
    only(monkeypatch)
    levels = {"full": 56.0, "rings": 50.0, "response": 50.0}
    monkeypatch.setattr(
        ChangeLevels, "_all",
        lambda self, scene, fidelity, seed: np.full(len(scene.microphones), levels[fidelity]),
    )  # fmt: skip
    loud = changes(spindle, seeds=5)
    assert loud.basis.fidelity == "full" and len(loud.basis.seeds) == 3
    levels["rings"] = 55.5
    assert changes(spindle, seeds=5).basis.fidelity == "rings"


@pytest.mark.heavy
def test_the_seeds_begin_with_the_scenes(spindle, monkeypatch):
    only(monkeypatch)
    last = spindle.replace({"imperfections.seed": 2**31 - 1})
    assert changes(last, seeds=2).basis.seeds == (2**31 - 1, 0)
    with pytest.raises(ValueError, match="seeds = 0"):
        changes(spindle, seeds=0)


@pytest.mark.heavy
def test_a_scene_without_any_figure_is_refused(spindle, example):
    still = spindle.replace({"operation.speed_rpm": 0.0, "operation.lowest_speed_rpm": 1000.0})
    with pytest.raises(ValueError, match="nothing to compare.*does not turn"):
        changes(still)
    # the papers' impact model knows no friction
    smooth = changes(example("7003C-impact"), levels=False)
    assert smooth.figures == ("life",) and "no friction" in smooth.conditions()
    assert smooth.table()[0] == ["change", "life", "stiff."]


def test_warnings_of_the_unchanged_scene_stand_first(spindle, monkeypatch):
    only(monkeypatch)
    found = changes(spindle.replace({"mounting.preload_N": 0.0}), levels=False)
    assert found.remarks()[0].startswith("Unchanged: preload = 0 N")
