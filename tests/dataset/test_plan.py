"""Plans: classes by their shares, draws by Latin hypercube, what is refused and in which words."""

import numpy as np
import pytest

from fmu_bearing.dataset import lay_out, read_plan
from fmu_bearing.dataset.draw import drawn, latin
from fmu_bearing.interface.names import UnknownName
from fmu_bearing.prepare import defects
from fmu_bearing.sweeps import SweepError
from fmu_bearing.sweeps.point import nothing
from fmu_bearing.sweeps.runs import estimate
from tests.dataset import plans


@pytest.fixture(scope="module")
def bare(scene):
    return scene("7003C-bare")


def spalls(folder, scene, sizes, **parts):
    """Plan of healthy runs and of spalls of so many sizes."""
    classes = """[[class]]
name = "healthy"
share = 0.5
[[class]]
name = "outer"
share = 0.5
defect = { on = "outer", shape = "spall", length_mm = "0.3:0.6log", width_mm = 0.5, depth_um = 100.0 }
"""
    return plans.plan(
        folder, scene, head=plans.HEAD.replace("seed", f"sizes = {sizes}\nseed"), classes=classes, **parts
    )


def test_the_time_of_a_set_has_that_of_its_tables(bare, tmp_path, monkeypatch):
    """Six runs of 2 s on two processes and three sizes: one table is made and timed, two are left."""
    made_of = []

    def coarse(*given, **more):
        made_of.append(given)
        return computed(*given, approaches=4, places=9, cells=(16, 16), **more)

    computed = defects.computed
    monkeypatch.setenv("FMU_BEARING_CACHE", str(tmp_path / "cache"))
    monkeypatch.setattr(defects, "computed", coarse)
    defects.defect_table.cache_clear()
    made = lay_out(spalls(tmp_path, bare, 3))
    found = estimate(made, None, 2, run=lambda task: nothing(task, "", 2.0))
    assert len(made_of) == 1 and (found["tables"], found["workers"]) == (2, 2)
    assert found["table_s"] > 0.0 and found["tables_s"] == pytest.approx(2 * found["table_s"])
    assert found["estimate_s"] == pytest.approx(6 * 2.0 / 2 + found["tables_s"])
    # what is kept is not made a second time
    counts = [estimate(made, None, 2, run=lambda task: nothing(task, "", 2.0))["tables"] for _ in range(3)]
    assert counts == [1, 0, 0] and len(made_of) == 3
    defects.defect_table.cache_clear()


@pytest.mark.parametrize(("runs", "counts"), [(10, [3, 2, 5]), (11, [3, 3, 5]), (1000, [260, 250, 490])])
def test_classes_have_their_shares_within_one_run(bare, tmp_path, runs, counts):
    classes = "".join(
        f'[[class]]\nname = "{k}"\nshare = {share}\n' for k, share in enumerate((0.26, 0.25, 0.49))
    )
    head = plans.HEAD.replace("runs = 6", f"runs = {runs}")
    plan = plans.plan(tmp_path, bare, head=head, classes=classes)
    labels = [run.label for run in drawn(plan, bare)]
    assert [labels.count(name) for name in "012"] == counts == plan.counts() and len(labels) == runs
    assert labels != sorted(labels)  # mixed


def test_each_part_of_each_range_has_one_run():
    shares = latin(np.random.default_rng(5), 40, 3)
    for column in shares.T:
        assert sorted((column * 40).astype(int)) == list(range(40))
    assert abs(np.corrcoef(shares.T) - np.eye(3)).max() < 0.5  # 40 points: 3 of 1/sqrt(40)


def test_draws_are_even_even_by_the_logarithm_and_whole(bare, tmp_path):
    head = plans.HEAD.replace("runs = 6", "runs = 200")
    plan = plans.plan(tmp_path, bare, head=head)
    runs = drawn(plan, bare)
    across = [run.values for run in runs if run.label == "across"]
    speeds = np.array([values["operation.speed_rpm"] for values in across])
    # one in each hundredth of the range: the mean of a share is 0.5 to 0.5 / 100 at most
    assert speeds.mean() == pytest.approx(14_000.0, abs=0.005 * 12_000.0)
    loads = np.array([values["mounting.radial_load_z_N"] for values in across])
    assert loads.min() >= -100.0 and loads.max() <= -10.0
    assert np.log10(-loads).mean() == pytest.approx(1.5, abs=0.005)
    seeds = [values["imperfections.seed"] for values in across]
    assert all(isinstance(seed, int) and 1 <= seed <= 2147483647 for seed in seeds) and len(set(seeds)) == 100
    preloads = [run.values["mounting.preload_N"] for run in runs if run.label == "along"]
    assert preloads.count(300) == preloads.count(500) == 50
    assert runs == drawn(plan, bare) != drawn(plan.model_copy(update={"seed": 4}), bare)


def test_a_class_has_few_shapes_of_defects_and_many_places(bare, tmp_path):
    classes = """[[class]]
name = "outer"
share = 1
defect = { on = "outer", shape = "spall", length_mm = "0.2:3log", width_mm = "0.5:4", angle_deg = "120:240" }
"""
    head = plans.HEAD.replace("runs = 6", "runs = 60")
    for sizes in (12, 5):
        plan = plans.plan(
            tmp_path, bare, head=head.replace("seed", f"sizes = {sizes}\nseed"), classes=classes
        )
        (defects,) = zip(*(run.values["imperfections.defect"] for run in drawn(plan, bare)), strict=True)
        shapes = {(one["length_mm"], one["width_mm"]) for one in defects}
        assert len(shapes) == sizes and len({one["angle_deg"] for one in defects}) == 60
        # one length in each part of its range, by the logarithm
        parts = [int(sizes * np.log(length / 0.2) / np.log(15.0)) for length, _ in shapes]
        assert sorted(parts) == list(range(sizes))
        assert {one["on"] for one in defects} == {"outer"}


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ("runs = 6", "runs = 0", "runs = 0 is refused: Input should be greater than or equal to 1"),
        ("runs = 6", "", "runs is missing, for example runs = 1000"),
        ("runs = 6", "run = 6", "run is not a key of a plan; did you mean 'runs'?"),
        ("rate_Hz = 12800", "rate_Hz = 12801", "12801 is refused: Input should be a multiple of 100"),
        ("rate_Hz = 12800", "rate_Hz = 96000", "rate_Hz = 96000 is refused"),
        ("share = 0.5\ndraw = { p", "share = 0.4\ndraw = { p", "the shares of the classes add up to 0.9"),
        ('"along"', '"across"', "class across is there twice"),
        ("runs = 6", "runs = 1", "class along has no run: raise its share, or runs = 1"),
        ("share = 0.5\ndraw = { p", "shares = 0.5\ndraw = { p", "class[2].share is missing, for example"),
        ("share = 0.5\ndraw = { p", "shares = 0.5\ndraw = { p", "class[2].shares is not a key of a plan"),
        ("share = 0.5\ndraw = { p", "share = 1.5\ndraw = { p", "class[2].share = 1.5 is refused"),
        ('"8000:20000"', "{ low = 1 }", 'a range as text: "1000:3000"'),
        ("speed =", "operation.speed_rpm =", "draw.operation is refused: a key with dots goes in quotes"),
        ("[300, 500]", "[300, [5]]", "class[2].draw is refused: a key with dots goes in quotes"),
        ("settle_s = 0.03", "settle_s = 0.0", "settle_s = 0.0 is refused"),
    ],
)  # fmt: skip
def test_a_bad_plan_is_refused_in_words(bare, tmp_path, old, new, words):
    path = plans.file(tmp_path, bare)
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), "utf-8")
    with pytest.raises(SweepError) as caught:
        read_plan(path)
    assert words in str(caught.value) and str(caught.value).startswith(f"{path}: ")


@pytest.mark.parametrize(
    ("old", "new", "words"),
    [
        ('"8000:20000"', '"20000:8000"', "'20000:8000' is refused: give the lower end first"),
        ('"8000:20000"', '"8000:20000:5"', 'write "LOW:HIGH" or "LOW:HIGHlog"'),
        ('"-100:-10log"', '"-100:10log"', "a logarithmic range does not hold 0"),
        ('"1:2147483647"', '"1.5:7"', "it takes whole numbers"),
        ("preload = [300, 500]", "preload = []", "draw mounting.preload_N has no values"),
        ("preload =", "preloaded =", "preloaded"),
        ("speed =", '"mounting.rotor.mass_kg" =', "the scene has no table [mounting.rotor]"),
        ('"8000:20000"', '"8000:2e9"', "operation.speed_rpm"),
        ('"along"\n', '"along"\ndefect = { on = "outer", shape = "star" }\n', "imperfections.defect"),
    ],
)  # fmt: skip
def test_draws_that_the_scene_cannot_have_are_refused_before_a_run(bare, tmp_path, old, new, words):
    path = plans.file(tmp_path, bare)
    text = path.read_text("utf-8")
    assert old in text
    path.write_text(text.replace(old, new, 1), "utf-8")
    with pytest.raises(SweepError) as caught:
        lay_out(read_plan(path))
    assert words in str(caught.value)


def test_sensors_are_those_of_the_scene(bare, tmp_path):
    with pytest.raises(UnknownName, match="P1"):
        lay_out(plans.plan(tmp_path, bare, head=plans.HEAD.replace('"P1"', '"P11"')))
    silent = bare.replace({"sound": None})
    with pytest.raises(ValueError, match="has no accelerometer and no microphone"):
        lay_out(plans.plan(tmp_path, silent, head=plans.HEAD.replace("sensors", "#")))
    all_of_them = lay_out(plans.plan(tmp_path, bare, head=plans.HEAD.replace("sensors", "#")))
    assert all_of_them.sensors == dict.fromkeys(("P1", "P2", "P3", "P4"), "Pa")


def test_a_microphone_beyond_what_is_left_out_is_refused(bare, tmp_path):
    far = bare.replace({"sound.microphone[1].y_mm": 20_000.0})
    with pytest.raises(SweepError, match="settle_s = 0.03 is refused: sound takes 0.0588 s to microphone P1"):
        lay_out(plans.plan(tmp_path, far))


def test_a_plan_reads_back_equal(bare, tmp_path):
    plan = plans.plan(tmp_path, bare)
    (tmp_path / "again.toml").write_text(plan.model_copy(update={"scene": "scene.toml"}).to_toml(), "utf-8")
    assert read_plan(tmp_path / "again.toml") == plan


def test_a_plan_without_seeds_says_so(bare, tmp_path):
    made = lay_out(plans.plan(tmp_path, bare, draw='[draw]\nspeed = "8000:20000"\n'))
    assert "draws no imperfections.seed" in made.notes[-1]
    assert lay_out(plans.plan(tmp_path, bare)).notes == ()
