"""Numbers of computed runs and of public records, their plan, and the notebook that learns from them."""

import csv
import importlib.util
import re

import numpy as np
import pytest

from fmu_bearing.dataset import lay_out, read_plan
from fmu_bearing.dataset.run import computed
from tests.conftest import ROOT
from tests.examples.test_notebooks import run

FOLDER = ROOT / "examples" / "datasets"
SHAFT = 29.5  # Hz


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("features", FOLDER / "features.py")
    module = importlib.util.module_from_spec(spec)
    spec.loader.exec_module(module)
    return module


@pytest.fixture(scope="module")
def layout():
    return lay_out(read_plan(FOLDER / "plan.toml"))


def rows(name):
    with (FOLDER / name).open(encoding="utf-8", newline="") as file:
        return list(csv.DictReader(file))


def frequencies(script):
    """Of rolling at the nominal contact angle, by name of the line."""
    balls, ratio = script.OWN
    cage = 0.5 * SHAFT * (1.0 - ratio)
    return {
        "outer": balls * cage, "inner": balls * (SHAFT - cage), "ball": SHAFT / ratio * (1.0 - ratio**2),
    }  # fmt: skip


def strokes(rate, each, seed=0):
    """Noise, and a mode of 3 kHz struck ``each`` times per second, of half a second."""
    time = np.arange(rate // 2) / rate
    since = time % (1.0 / each)
    noise = np.random.default_rng(seed).standard_normal(time.size)
    return np.exp(-600.0 * since) * np.sin(2.0 * np.pi * 3000.0 * since) + 0.02 * noise


@pytest.mark.parametrize("kind", ["outer", "inner", "ball"])
def test_what_is_struck_has_its_line(script, kind):
    # 1 % off the nominal contact angle: within what is searched
    found = script.features(strokes(12_000, 0.99 * frequencies(script)[kind]), 12_000, SHAFT, script.OWN)
    lines = {name: found[name] for name in ("outer", "inner", "ball")}
    assert max(lines, key=lines.get) == kind and lines[kind] > 20.0 + sorted(lines.values())[1]
    assert found[f"2 {kind}"] > 20.0 and found[f"{kind} sides"] < -20.0
    assert tuple(found) == script.NAMES


def test_neither_scale_nor_rate_matters(script):
    struck = frequencies(script)["outer"]
    signal = strokes(12_000, struck)
    one, other, scaled = (
        script.features(values, rate, SHAFT, script.OWN)
        for values, rate in (
            (signal, 12_000), (strokes(48_000, struck), 48_000), (1e3 * signal + 5.0, 12_000),
        )
    )  # fmt: skip
    assert scaled == pytest.approx(one)
    # the same strokes at another rate; the noise is another, and is denser below 6 kHz the lower the rate
    assert other["outer"] == pytest.approx(one["outer"], abs=15.0) and other["outer"] > 30.0


def test_the_kept_numbers_are_of_the_runs_of_the_plan(layout):
    kept = rows("features.csv")
    assert len(kept) == len(layout.runs) == 600
    for row, drawn in zip(kept, layout.runs, strict=True):
        assert row["class"] == drawn.label
        (defect,) = drawn.values.get("imperfections.defect", [{}])
        for key in ("length_mm", "width_mm"):
            assert row[key] == (f"{defect[key]:.3g}" if defect else "")
    assert sum(path.stat().st_size for path in FOLDER.iterdir() if path.suffix == ".csv") < 200_000


def test_the_public_numbers_are_of_all_records_that_the_page_names():
    kept = rows("public_features.csv")
    counts = {}
    for row in kept:
        counts.setdefault((row["source"], row["class"]), []).append(row["record"])
    assert all(len(names) == 4 * len(set(names)) for names in counts.values())
    assert {key: len(set(names)) for key, names in counts.items()} == {
        ("CWRU", "healthy"): 1, ("CWRU", "outer"): 28, ("CWRU", "inner"): 16, ("CWRU", "ball"): 16,
        ("MFPT", "outer"): 7, ("MFPT", "inner"): 7,
    }  # fmt: skip


@pytest.mark.heavy
def test_runs_give_the_kept_numbers_again(script, layout):
    """One of each class; elsewhere rounding differs, and with it what is not a line of the class."""
    kept = rows("features.csv")
    for kind in ("healthy", "outer", "inner", "ball"):
        place = next(k for k, row in enumerate(kept) if row["class"] == kind)
        task = layout.tasks[place]
        labels, waveforms = computed(task.scene, task.settle, task.window, task.rate, task.figures)
        found = script.features(waveforms[0].astype(float), script.RATE, float(labels["f_r_Hz"]), script.OWN)
        assert found["kurtosis"] == pytest.approx(float(kept[place]["kurtosis"]), abs=1.0)
        if kind != "healthy":
            assert found[kind] == pytest.approx(float(kept[place][kind]), abs=1.0)


def number(pattern, text):
    """The numbers of the only match."""
    (found,) = re.findall(pattern, text)
    return [float(one) for one in (found if isinstance(found, tuple) else (found,))]


def counts(text, head):
    """Counts below a line that begins with ``head``: by class, as healthy, outer, inner and ball are said."""
    (after,) = re.findall(rf"^{head}.*\n(?:  counts .*\n)?    is .*\n((?:    .*\n)+)", text, re.MULTILINE)
    return {cells[0]: [int(one) for one in cells[1:]] for cells in map(str.split, after.splitlines())}


@pytest.mark.heavy
def test_notebook():
    """Figures of its last cell and of docs/datasets.md; another scikit-learn may grow other trees."""
    pytest.importorskip("sklearn", reason="there is no scikit-learn")
    text, pictures = run("defects")
    assert pictures == 1 and "runs: 150 healthy, 150 outer, 150 inner, 150 ball" in text
    of = r"([\d.]+) \(([\d.]+) to ([\d.]+)\)"
    assert number(f"computed, lines and shapes: balanced accuracy {of}", text) == pytest.approx(
        [0.930, 0.906, 0.947], abs=0.02
    )
    assert number(f"computed, shapes and shares: balanced accuracy {of}", text)[0] == pytest.approx(
        0.652, abs=0.03
    )
    unseen = number("sizes not seen, .*: balanced accuracy " + ", ".join(["([\\d.]+)"] * 4), text)
    assert unseen == pytest.approx([0.901, 0.987, 0.811, 0.993], abs=0.04)
    table = counts(text, "computed, lines and shapes")
    assert table["outer"][1] == sum(table["outer"]) and table["ball"][0] == pytest.approx(77, abs=15)
    table = counts(text, "CWRU, lines and shapes")
    for kind, said in {
        "healthy": [1, 0, 0, 0], "outer": [4, 14, 10, 0], "inner": [4, 0, 12, 0], "ball": [6, 0, 2, 8],
    }.items():  # fmt: skip
        assert table[kind] == pytest.approx(said, abs=2 if kind != "healthy" else 0), kind
    single = r"CWRU, lines and shapes: (\d+) of 61 records right \(single forests (\d+) to (\d+)\)"
    assert number(single, text) == pytest.approx([35, 28, 36], abs=4)
    assert counts(text, "MFPT, lines and shapes") == {"outer": [0, 7, 0, 0], "inner": [0, 0, 7, 0]}
    assert number(r"CWRU, shapes and shares: (\d+) of", text)[0] == pytest.approx(23, abs=5)
    assert number(r"MFPT, shapes and shares: (\d+) of", text)[0] <= 5
    # the rule has no chance in it
    assert "CWRU, faulty records by their highest line: 43 of 60 right" in text
    assert number(r"CWRU, by the forests, which .*: (\d+) of 60", text)[0] == pytest.approx(39, abs=3)


def test_the_rule_and_the_lines_that_the_notebook_explains_by():
    """Without scikit-learn: what the kept numbers themselves show."""
    own, public = rows("features.csv"), rows("public_features.csv")

    def median(kind, line):
        return float(np.median([float(row[line]) for row in own if row["class"] == kind]))

    for kind in ("outer", "inner", "ball"):
        assert median(kind, kind) > 12.0 + median("healthy", kind)
    assert median("inner", "f_r") > 15.0 > 5.0 > median("outer", "f_r")
    means = {}
    for row in public:
        name = row["source"], row["record"], row["class"]
        means.setdefault(name, []).append([float(row[line]) for line in ("outer", "inner", "ball", "f_r")])
    means = {name: np.mean(values, axis=0) for name, values in means.items()}
    right = [
        ("outer", "inner", "ball")[int(np.argmax(values[:3]))] == kind
        for (source, _, kind), values in means.items()
        if source == "CWRU" and kind != "healthy"
    ]
    assert (sum(right), len(right)) == (43, 60)
    large = [values for (_, name, _), values in means.items() if re.search(r"OR@\d+_21", name)]
    assert len(large) == 12
    assert all(9.0 < values[0] < 20.0 and abs(values[3] - values[0]) < 3.0 for values in large)
    for missed in ("OR@6_14", "IR_28"):
        assert all(max(values[:3]) < 11.0 for (_, name, _), values in means.items() if missed in name)
