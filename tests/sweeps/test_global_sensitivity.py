"""Sensitivity to several values at once: against closed forms, against a grid, and what is refused."""

import math

import numpy as np
import pytest

from fmu_bearing import global_sensitivity, new_scene, sweep, with_fidelity
from fmu_bearing.scene.values import value_at
from fmu_bearing.sweeps import global_sensitivity as study, sampling
from fmu_bearing.sweeps.axes import SweepError
from fmu_bearing.sweeps.point import Outcome
from fmu_bearing.sweeps.ranges import parse_range, ranges_of
from tests.conftest import ROOT

PRELOAD, VISCOSITY, SEED = "mounting.preload_N", "lubricant.viscosity_Pa_s", "imperfections.seed"
VARY = {"preload": (100.0, 300.0), "viscosity": "0.004..0.016log", "seed": (1, 4)}


def ishigami(x, a=7.0, b=0.1):
    """Ishigami and Homma (1990), of shares of ranges from -pi to pi."""
    x = math.pi * (2.0 * x - 1.0)
    return np.sin(x[:, 0]) + a * np.sin(x[:, 1]) ** 2 + b * x[:, 2] ** 4 * np.sin(x[:, 0])


def ishigami_indices(a=7.0, b=0.1):
    """First order and total in closed form: Sobol and Levitan (1999)."""
    alone = 0.5 * (1.0 + b * math.pi**4 / 5.0) ** 2, a**2 / 8.0, 0.0
    jointly = 8.0 * b**2 * math.pi**8 / 225.0  # of the first and the third
    whole = sum(alone) + jointly
    return np.array(alone) / whole, (np.array(alone) + (jointly, 0.0, jointly)) / whole


def test_sobol_finds_the_indices_of_ishigamis_function():
    x = sampling.shares("sobol", 1024, 3, seed=1)
    found, whole = sampling.indices("sobol", x, ishigami(x), seed=1)
    assert x.shape == (1024 * 5, 3) and whole == 1024
    for name, exact in zip(("S1", "ST"), ishigami_indices(), strict=True):
        # half the width of 95 % is two standard errors; twice that leaves four
        assert np.all(np.abs(found[name] - exact) <= 2.0 * found[f"{name}_conf"] + 1e-3), name
        assert np.all(found[f"{name}_conf"] < 0.1)


def test_morris_finds_the_slopes_of_a_linear_function():
    x = sampling.shares("morris", 10, 3, seed=1)
    found, _ = sampling.indices("morris", x, 3.0 + x @ (1.0, -2.0, 0.5), seed=1)
    # all effects are equal: rounding of differences of numbers about 3 over steps of 2/3
    assert found["mu"] == pytest.approx((1.0, -2.0, 0.5), abs=1e-14)
    assert found["mu_star"] == pytest.approx((1.0, 2.0, 0.5), abs=1e-14)
    assert found["sigma"] == pytest.approx(0.0, abs=1e-14)


def slope(scene):
    """A figure that is linear in each share of the ranges: of the preload, of the viscosity's logarithm."""
    return 0.02 * value_at(scene, PRELOAD) - 3.0 * math.log(value_at(scene, VISCOSITY))


@pytest.fixture
def linear(monkeypatch):
    """`slope` in place of the runs; the tasks that ran are kept."""
    ran = []

    def run(plan, *more):
        ran.extend(plan.tasks)
        return {task.key: Outcome((slope(task.scene),)) for task in plan.tasks}

    monkeypatch.setattr(study, "run_plan", run)
    return ran


@pytest.mark.parametrize("method", sampling.METHODS)
def test_a_linear_figure_through_scenes_and_ranges(silent, linear, method):
    found = global_sensitivity(silent, VARY, method=method, samples=32, figures=["friction_torque"])
    assert found.keys == (PRELOAD, VISCOSITY, SEED)
    slopes = np.array([0.02 * 200.0, -3.0 * math.log(4.0), 0.0])
    if method == "morris":
        assert found.indices["mu"][0] == pytest.approx(slopes, abs=1e-12)
        assert found.indices["sigma"][0] == pytest.approx(0.0, abs=1e-12)
    else:
        exact = slopes**2 / np.sum(slopes**2)
        for name in ("S1", "ST"):
            # four standard errors, as above
            allowed = 2.0 * found.indices[f"{name}_conf"][0] + 1e-12
            assert np.all(np.abs(found.indices[name][0] - exact) <= allowed), name
    assert [key for key, _ in found.ranked("friction_torque")] == [VISCOSITY, PRELOAD, SEED]
    assert len(linear) == 32 * sampling.block(method, 3)
    for task in linear:
        assert 100.0 <= value_at(task.scene, PRELOAD) <= 300.0
        assert 0.004 <= value_at(task.scene, VISCOSITY) <= 0.016
        assert value_at(task.scene, SEED) in (1, 2, 3, 4)


def test_ranges_reach_from_end_to_end(silent):
    preload, viscosity, seed = ranges_of(silent, VARY)
    at = np.array([0.0, 0.5, 1.0])
    assert preload.at(at) == [100.0, 200.0, 300.0]
    assert viscosity.at(at) == pytest.approx([0.004, 0.008, 0.016], rel=1e-12)
    numbers = seed.at((np.arange(400) + 0.5) / 400)
    assert [numbers.count(k) for k in (1, 2, 3, 4)] == [100] * 4
    assert seed.at(at)[-1] == 4
    assert (preload.words(), viscosity.words()) == (
        "mounting.preload_N 100 to 300 N",
        "lubricant.viscosity_Pa_s 0.004 to 0.016 Pa s, by its logarithm",
    )


@pytest.mark.parametrize("method", sampling.METHODS)
def test_a_sample_with_a_point_without_figure_is_left_out_whole(method):
    x = sampling.shares(method, 16, 2, seed=1)
    y = x @ (1.0, 2.0)
    gaps, size = y.copy(), sampling.block(method, 2)
    gaps[[0, 1, 5 * size]] = math.nan  # of the first and the sixth sample
    found, whole = sampling.indices(method, x, gaps, seed=1)
    kept = np.r_[size : 5 * size, 6 * size : 16 * size]
    expected, _ = sampling.indices(method, x[kept], y[kept], seed=1)
    assert whole == 14
    for name, values in expected.items():
        assert np.array_equal(found[name], values), name
    gaps[: 13 * size : size] = math.nan
    found, whole = sampling.indices(method, x, gaps, seed=1)
    assert whole == 3 and all(np.isnan(values).all() for values in found.values())


@pytest.mark.parametrize("method", sampling.METHODS)
def test_a_figure_that_does_not_change_rests_on_nothing(method):
    x = sampling.shares(method, 8, 2, seed=1)
    found, _ = sampling.indices(method, x, np.full(len(x), 5.0) + 1e-12 * x[:, 0], seed=1)
    assert all(np.array_equal(values, np.zeros(2)) for values in found.values())


def test_points_that_are_refused_are_counted_with_their_reason(silent, monkeypatch):
    def run(plan, *more):
        found = {task.key: Outcome((slope(task.scene),)) for task in plan.tasks}
        return found | {plan.tasks[0].key: Outcome((math.nan,), "no equilibrium")}

    monkeypatch.setattr(study, "run_plan", run)
    asked = {"samples": 8, "figures": ["friction_torque"], "method": "sobol"}
    found = global_sensitivity(silent, VARY, **asked)
    assert found.complete == (7,) and found.reasons == ("no equilibrium",)
    assert any("7 of 8 samples" in line and "no equilibrium" in line for line in found.remarks())
    monkeypatch.setattr(
        study, "run_plan", lambda plan, *more: {t.key: Outcome((math.nan,), "no oil") for t in plan.tasks}
    )
    with pytest.raises(SweepError, match="0 of 8 samples.*narrow the ranges.*no oil"):
        global_sensitivity(silent, VARY, **asked)


@pytest.mark.parametrize(
    ("vary", "more", "words"),
    [
        ({"preload": (1, 2)}, {}, "give two ranges or more"),
        ({"preload": (2, 1), "speed": (1e3, 2e3)}, {}, "the lower one first"),
        ({"preload": (1, math.inf), "speed": (1e3, 2e3)}, {}, "finite ends"),
        ({"preload": "1:2:3", "speed": (1e3, 2e3)}, {}, "write KEY=LOW..HIGH"),
        ({"preload": "a..b", "speed": (1e3, 2e3)}, {}, "give two numbers"),
        ({"preload": (1, 2, 3), "speed": (1e3, 2e3)}, {}, "give two numbers"),
        ({"preload": "0..9log", "speed": (1e3, 2e3)}, {}, "lies above 0"),
        ({"seed": (1, 2.5), "speed": (1e3, 2e3)}, {}, "whole numbers"),
        ({"seed": "1..8log", "speed": (1e3, 2e3)}, {}, "no logarithmic range"),
        ({"fidelity": (1, 2), "speed": (1e3, 2e3)}, {}, "it is 'full', and numbers alone"),
        ({"preload": (1, 2), PRELOAD: (1, 2)}, {}, "given twice"),
        ({"sped": (1, 2), "preload": (1, 2)}, {}, "did you mean 'speed'"),
        ({"speed": (1e3, 2e6), "preload": (100, 200)}, {}, "allowed: -100000 to 100000 r/min"),
        (VARY, {"method": "fast"}, "allowed are morris and sobol"),
        (VARY, {"samples": 3}, "allowed are 4 to 65536"),
        (VARY, {"method": "sobol", "samples": 100}, "powers of two, as 64 and 128"),
        (VARY, {"seed": 0}, "give 1 or more"),
        (VARY, {"workers": 0}, "give 1 or more"),
        (VARY, {"window": 0.0}, "allowed are 0.001 to 1000 s"),
        (VARY, {"figures": ["friction_torqe"]}, "friction_torque"),
    ],
)
def test_what_is_refused_before_anything_runs(silent, monkeypatch, vary, more, words):
    monkeypatch.setattr(study, "run_plan", lambda *given: pytest.fail("it ran"))
    with pytest.raises(ValueError, match=words):
        global_sensitivity(silent, vary, **more)


def test_text_that_is_no_range_is_refused():
    assert parse_range(" speed = 1e3..2e3 ") == ("speed", "1e3..2e3")
    for text in ("speed", "speed=", "=1..2"):
        with pytest.raises(SweepError, match="write KEY=LOW..HIGH"):
            parse_range(text)


def grid_indices(values):
    """First order and total of a figure on a grid of equally likely points, (n, m), by their definition."""
    mean, whole = values.mean(), values.var()
    alone = [((values.mean(axis=other) - mean) ** 2).mean() / whole for other in (1, 0)]
    total = [values.var(axis=own).mean() / whole for own in (0, 1)]
    return np.array(alone), np.array(total)


@pytest.mark.heavy
def test_a_bearing_as_on_a_grid(silent, tmp_path):
    """Settled at once: the figures are those of the steady state, smooth in both values."""
    scene = with_fidelity(silent, model="rings")
    ends = {"preload": (250.0, 350.0), "speed": (5000.0, 25000.0)}
    figures = ["friction_torque", "contact.outer.angle_mean"]
    short = {"settle": 0.0, "window": 1e-3, "figures": figures, "workers": 1}
    middles = (np.arange(12) + 0.5) / 12  # of the cells: their mean errs by some (1/12)^2 / 24 of a curvature
    axes = {key: [low + share * (high - low) for share in middles] for key, (low, high) in ends.items()}
    data = sweep(scene, axes, **short)
    asked = {"method": "sobol", "samples": 128, "folder": tmp_path}
    found = global_sensitivity(scene, ends, **short, **asked)
    for place, figure in enumerate(figures):
        grid = data[figure].transpose("preload_N", "speed_rpm").values
        for name, exact in zip(("S1", "ST"), grid_indices(grid), strict=True):
            half = found.indices[f"{name}_conf"][place]
            # four standard errors, and the grid's own error below 0.01
            assert np.all(np.abs(found.indices[name][place] - exact) <= 2.0 * half + 0.01), (figure, name)
        assert found.indices["ST"][place].min() > 0.05, figure  # both values matter
    kept = list((tmp_path / "points").iterdir())
    assert len(kept) == len({task.key for task in found.layout.plan.tasks}) == 128 * 4
    again = global_sensitivity(scene, ends, **short, **asked)
    assert np.array_equal(again.values, found.values)
    assert all(np.array_equal(again.indices[name], found.indices[name]) for name in again.indices)


@pytest.mark.heavy
def test_a_pair_is_ranked_as_a_single_bearing(tmp_path):
    """Of each bearing and of the whole set; the preload by the short name that it has elsewhere in a set."""
    path = tmp_path / "pair.toml"
    path.write_text(new_scene("pair", "7003C", speed_rpm=15000.0, preload_N=150.0, arrangement="DB"), "utf-8")
    found = global_sensitivity(
        with_fidelity(path, model="rings").replace({"sound": None}),
        {"preload": (100.0, 200.0), "speed": (8000.0, 15000.0)},
        samples=4,
        settle=0.0,
        window=1e-3,
        figures=["friction_torque", "bearing[*].contact.inner.pressure_max"],
        workers=1,
    )
    assert found.keys == ("spindle.preload.preload_N", "operation.speed_rpm")
    for number in (1, 2):
        (first, effect), _ = found.ranked(f"bearing[{number}].contact.inner.pressure_max")
        assert first == "spindle.preload.preload_N"
        # Hertz: pressure goes with the cube root of the load, 1.5 GPa at 150 N: +26 % over the range
        # the contact angle grows with the load and takes some of it
        assert effect == pytest.approx(0.26 * 1.5e9, rel=0.4)


def test_bearings_on_another_models_shaft_are_refused():
    with pytest.raises(ValueError, match="cannot have a sensitivity study"):
        global_sensitivity(
            ROOT / "examples" / "port" / "7003C-DB-port.toml", {"preload": (100, 200), "speed": (8000, 15000)}
        )
