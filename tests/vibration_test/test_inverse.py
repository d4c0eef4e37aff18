"""Surfaces from measured bands and lines: draws against closed forms and grids, round trips, refusals."""

from dataclasses import replace

import numpy as np
import pytest
from scipy.special import log_ndtr
from scipy.stats import norm

from fmu_bearing import read_scene, surface
from fmu_bearing.acoustics.filters.weighting import level
from fmu_bearing.recording.studies.level_estimator import LevelEstimator
from fmu_bearing.scene import SceneError
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.scene.surface import Surface
from fmu_bearing.vibration_test.inverse.energies import Energies, band_windows, energies, line_window
from fmu_bearing.vibration_test.inverse.posterior import Prior, Value, posterior
from fmu_bearing.vibration_test.inverse.runs import AMPLITUDE_UM, BALL_EXPONENTS, BENT_AT, EXPONENT
from fmu_bearing.vibration_test.lines import frequencies
from fmu_bearing.vibration_test.reading import Reading, reading, share
from fmu_bearing.vibration_test.rig import bands, rig
from tests.conftest import EXAMPLES
from tests.vibration_test import known

WIDE = Prior((1e-3, 20.0), (10.0, 160.0))
QUANTILES = (0.025, 0.5, 0.975)


@pytest.fixture
def quick(monkeypatch):
    """The table in the place of runs."""
    known.play(monkeypatch)


def simple(names, orders, balls=1e-12):
    """One order of the inner race per window, of energy 1e4 for A_1 = 1 um, and one ball form of any p."""
    count = len(names)
    form = np.ones((count, 3, 1)) * np.array(balls)[..., None, None] * np.ones((1, 3, 1))
    return Energies(
        tuple(names), np.array(orders), np.array([900]), 1e4 * np.eye(count), np.zeros((count, 1)),
        form, np.ones((count, 1)),
    )  # fmt: skip


# --- draws against closed forms and grids ---------------------------------------------------------


def test_two_bands_of_one_order_each_have_a_closed_form():
    """Oracle: ln v = ln A_1 - (p - p0) ln n + ln 100 is linear, so its posterior is normal."""
    deviation, truth = 0.05, np.array([np.log(0.3), 1.5])
    slopes = np.array([[1.0, -np.log(12.0)], [1.0, -np.log(100.0)]])
    values = np.exp(slopes @ (truth - [0.0, EXPONENT]) + np.log(100.0))
    found = posterior(
        simple("LH", (12, 100)), [Value(v, deviation) for v in values], WIDE, scatter=False, draws=8000
    )
    inverse = np.linalg.inv(slopes)
    covariance = deviation**2 * inverse @ inverse.T
    drawn = np.array([np.log(found.amplitude_um), found.exponent])
    # 1,000 draws: means to 3 % of a standard deviation, these to 2.2 %; four of each
    deviations = np.sqrt(np.diag(covariance))
    assert np.abs(drawn.mean(axis=1) - truth) / deviations == pytest.approx([0.0, 0.0], abs=0.13)
    assert drawn.std(axis=1) / deviations == pytest.approx([1.0, 1.0], abs=0.09)
    expected = covariance[0, 1] / deviations.prod()
    assert np.corrcoef(drawn)[0, 1] == pytest.approx(expected, abs=0.02)


def scattered(orders, values, deviation):
    """Quantiles of p and ln A_1 by a grid, each order's energy drawn from exp(1): the slow way."""
    factor = np.exp(np.linspace(-14.0, 3.0, 1500))
    weight = np.exp(-factor) * factor  # of ln factor
    p = np.linspace(0.9, 2.1, 121)[:, None]
    amplitude = np.linspace(np.log(1e-3), np.log(20.0), 400)
    density = np.ones((p.size, amplitude.size))
    for order, value in zip(orders, values, strict=True):
        mean = amplitude - (p - EXPONENT) * np.log(order) + np.log(100.0) - np.log(value)
        at = np.linspace(mean.min(), mean.max(), 2000)
        off = (at[:, None] + 0.5 * np.log(factor)) / deviation
        density *= np.interp(mean, at, (np.exp(-0.5 * off**2) * weight).sum(axis=1))
    return [
        np.interp(QUANTILES, np.cumsum(edge) / edge.sum(), axis)
        for edge, axis in ((density.sum(axis=1), p[:, 0]), (density.sum(axis=0), amplitude))
    ]


@pytest.mark.parametrize("names", [("L", "H"), ("L", "f_o")])  # bands alone, and chosen by a line
def test_scatter_of_orders_is_that_of_a_grid(quick, names):
    orders, deviation = (8, 300), 0.1
    values = [100.0 * 0.3 * order ** -(1.5 - EXPONENT) for order in orders]
    found = posterior(simple(names, orders), [Value(v, deviation) for v in values], WIDE, draws=20_000)
    exponent, amplitude = scattered(orders, values, deviation)
    # ends of 95 % of 1,000 draws of a curved distribution: some 0.15 of its standard deviation
    assert np.quantile(found.exponent, QUANTILES) == pytest.approx(exponent, abs=0.04)
    assert np.quantile(np.log(found.amplitude_um), QUANTILES) == pytest.approx(amplitude, abs=0.15)


def test_form_of_the_balls_is_that_of_a_grid():
    """Three bands, of which the form makes most of one: a grid of three unknowns."""
    balls, deviations = (1e-2, 1.0, 1e-3), (0.1, 0.2, 0.1)
    found = simple("LMH", (12, 60, 300), balls)
    law = {"amplitude": 0.3, "exponent": 1.5, "form": 40.0}

    def velocities(amplitude, exponent, form):
        return [
            np.sqrt(1e4 * amplitude**2 * order ** (-2.0 * (exponent - EXPONENT)) + ball * form**2)
            for order, ball in zip((12, 60, 300), balls, strict=True)
        ]

    values = velocities(**law)
    drawn = posterior(
        found, [Value(*one) for one in zip(values, deviations, strict=True)], WIDE, False, 20_000
    )
    amplitude, exponent, form = np.meshgrid(
        np.geomspace(0.05, 2.0, 150), np.linspace(0.9, 2.1, 121), np.geomspace(10.0, 160.0, 80), indexing="ij"
    )
    model = velocities(amplitude, exponent, form)
    chi = sum((np.log(m / v) / d) ** 2 for m, v, d in zip(model, values, deviations, strict=True))
    weight = np.exp(-0.5 * chi)
    for values_of, axis, along in (
        (drawn.amplitude_um, amplitude[:, 0, 0], (1, 2)), (drawn.exponent, exponent[0, :, 0], (0, 2)),
        (drawn.ball_form_nm, form[0, 0], (0, 1)),
    ):  # fmt: skip
        edge = weight.sum(axis=along)
        expected = np.interp(QUANTILES, np.cumsum(edge) / edge.sum(), axis)
        # 1,000 draws, a grid of some per cent
        assert np.quantile(values_of, QUANTILES) == pytest.approx(expected, rel=0.08)


def test_form_of_the_balls_between_its_exponents():
    """A logarithm of second order in the exponent is met everywhere, for each draw and each of bending."""
    low, middle, high = BALL_EXPONENTS
    assert high - middle == pytest.approx(middle - low)
    rng = np.random.default_rng(6)
    first, second, third = rng.normal(size=(3, 2, 4))  # windows, draws
    balls = np.exp([first + x * second + x**2 * third for x in (-1.0, 0.0, 1.0)]).transpose(1, 0, 2)
    nothing, bending = np.zeros((2, 1)), rng.uniform(1.0, 2.0, (2, 3))
    found = Energies(("L", "H"), np.array([12]), np.array([900]), nothing, nothing, balls, bending)
    assert found.seeds == 4
    x, draw, bent = np.array([-1.2, 0.3, 0.8]), np.array([0, 3, 1]), np.array([2, 0, 1])
    wanted = np.exp(first[:, draw] + x * second[:, draw] + x**2 * third[:, draw]) * bending[:, bent]
    assert found.forms(middle + x * (high - middle), draw, bent) == pytest.approx(wanted.T, rel=1e-12)


def test_a_limit_cuts_one_side():
    """Oracle: the evenly spread bounds, times the chance to lie below the limit; one band beside a value."""
    prior = Prior((0.05, 1.0), (10.0, 160.0), (1.35, 1.3501))
    found = posterior(simple("LH", (1, 2)), [Value(30.0, 0.1, True), Value(40.0, 0.1, True)], prior, False)
    grid = np.linspace(np.log(0.05), np.log(1.0), 2000)
    weight = np.exp(sum(log_ndtr((np.log(v / 100.0) - grid) / 0.1) for v in (30.0, 40.0)))
    expected = np.interp(QUANTILES, np.cumsum(weight) / weight.sum(), grid)
    assert np.quantile(np.log(found.amplitude_um), QUANTILES) == pytest.approx(expected, abs=0.1)


def test_energies_of_a_law_are_sums_over_orders():
    found = known.kept()
    exponent = np.array([1.1, 1.6])
    factors = np.random.default_rng(1).exponential(size=(2, found.inner_orders.size))
    whole = found.races(exponent, factors)
    for draw, p in enumerate(exponent):
        for window in range(len(found.names)):
            expected = sum(
                energies[window, k] * order ** (-2.0 * (p - EXPONENT)) * (factors[draw, k] if inner else 1.0)
                for inner, orders, energies in (
                    (True, found.inner_orders, found.inner), (False, found.outer_orders, found.outer)
                )
                for k, order in enumerate(orders)
            )  # fmt: skip
            assert whole[draw, window] == pytest.approx(expected, rel=1e-10)
    strong = found.strong(1.4, 0.01)
    assert strong.inner_orders.size < 0.3 * found.inner_orders.size
    # what is left out is interpolated over the exponent, by steps of 0.05
    assert strong.races(exponent) == pytest.approx(found.races(exponent), rel=1e-3)


def test_energy_of_a_bin_belongs_to_the_order_whose_line_is_nearest():
    """Inner race: waves 11 at f_i - f_r, 24 at 2 f_i; outer of residues 1, -1: 25 at 2 f_o, 35 at 3 f_o."""
    given = known.stub()
    width, bins = given.frequency[1], given.frequency.size
    rates = frequencies(given.scene, Reading(given.frequency, given.inner, 0.0, given.orbit))

    def spectrum(**energies_at):
        found = np.zeros(bins)
        for name, energy in energies_at.items():
            found[round(places[name] / width)] = energy
        return found

    places = {"wave_11": rates.f_i - rates.f_r, "wave_24": 2.0 * rates.f_i, "low": 200.0}
    places |= {"wave_25": 2.0 * rates.f_o, "wave_35": 3.0 * rates.f_o}
    made = replace(
        given, inner=spectrum(wave_11=3.0, wave_24=5.0), residues=np.array([1, 11]),
        outer=np.array([spectrum(wave_25=7.0), spectrum(wave_35=11.0)]),
        rigid=np.tile(spectrum(low=4.0), (3, 2, 1)), bent=spectrum(low=6.0)[None],
    )  # fmt: skip
    windows = band_windows(given.scene)
    found = energies(made, windows)
    for orders, rows, wanted in (
        (found.inner_orders, found.inner, {11: 3.0, 24: 5.0}),
        (found.outer_orders, found.outer, {25: 7.0, 35: 11.0}),
    ):
        sums = dict(zip(orders.tolist(), AMPLITUDE_UM**2 * rows.sum(axis=0), strict=True))
        assert {order: energy for order, energy in sums.items() if energy} == pytest.approx(wanted)
    low = next(k for k, one in enumerate(windows) if one.low < 200.0 < one.high)
    balls = np.zeros((len(windows), 3, 2))
    balls[low] = 4.0 / given.form_nm**2
    assert found.balls == pytest.approx(balls)
    assert found.bending[low] == pytest.approx([1.5])


# --- the public function ---------------------------------------------------------------------------


def test_a_surface_explains_the_values(quick):
    found = surface("7003C", L=41.0, M=42.0, H=54.0)
    assert (found.bearing, found.measured) == ("7003C", "L = 41, M = 42, H = 54 um/s")
    assert found.law.exponent.low < EXPONENT < found.law.exponent.high  # nearly the class P4 itself
    assert found.order().low < 10.5 < found.order().high
    assert len(found) == 1000 and found.order_scatter_seed is not None
    words = " ".join(found.remarks)
    assert "Ask for the lines f_i - f_r (180 Hz) and f_o (150 Hz)" in words
    assert "form of the balls stays open" in words and "A_1 and p go together" in words
    again = surface("7003C", L=41.0, M=42.0, H=54.0)
    assert np.array_equal(found.amplitude_um, again.amplitude_um)
    anderon = surface("7003C", L=41.0 / 7.698, M=42.0 / 7.698, H=54.0 / 7.53, unit="anderon")
    assert anderon.law.exponent.median == pytest.approx(found.law.exponent.median, abs=0.02)


@pytest.mark.heavy
def test_lines_narrow_it_and_an_exact_law_does_more(quick):
    plain = surface("7003C", L=41.0, M=42.0, H=54.0)
    lines = surface("7003C", L=41.0, M=42.0, H=54.0, lines={"f_i - f_r": 9.0, "f_o": 10.0})
    exact = surface("7003C", L=41.0, M=42.0, H=54.0, exact_law=True)
    widths = [one.law.exponent.high - one.law.exponent.low for one in (plain, lines, exact)]
    assert widths[1] < widths[0] and widths[2] < 0.7 * widths[0]
    assert exact.order_scatter_seed is None
    assert not any("Ask for" in one for one in (*lines.remarks, *exact.remarks))


def test_limits_leave_the_lower_end_to_what_is_assumed(quick):
    found = surface("7003C", L=65.0, M=46.0, H=35.0, at_most=True)
    assert found.measured == "L at most 65, M at most 46, H at most 35 um/s"
    assert any("a limit is no value" in one and "p 1 to 1.8" in one for one in found.remarks)
    assert found.law.amplitude_um.low < 0.05  # an eighth of P4's 0.3 um is the bound


@pytest.mark.parametrize(
    ("keys", "words"),
    [
        ({"L": 41.0}, "L alone: amplitude and exponent are two numbers: give two bands"),
        ({}, "no value alone"),
        ({"L": 0.0, "H": 54.0}, "L = 0 um/s: give um/s rms above 0, 10000 at most"),
        ({"L": 2e4, "H": 54.0}, r"L = 20000 um/s: give um/s rms above 0"),
        ({"L": float("nan"), "H": 54.0}, "L = nan um/s"),
        ({"L": 41.0, "H": 54.0, "deviation": 0.02}, "a standard deviation of 2 %: give 3 to 100 %"),
        (
            {"L": 41.0, "H": 4000.0},
            r"no exponent from 0.9 to 2.1 meets .* the nearest law has .* --unit ander",
        ),
        ({"L": 20.0, "H": 140.0}, "lie at the end of what is searched, p = 0.9|no exponent from 0.9 to 2.1"),
        ({"L": 41.0, "lines": {"f_x": 9.0}}, "line 'f_x': it is none of a race in this test"),
        ({"L": 41.0, "H": 54.0, "unit": "mm/s"}, "unit = mm/s: choose from"),
    ],
)
def test_values_that_are_refused(quick, keys, words):
    with pytest.raises(ValueError, match=words):
        surface("7003C", **keys)


def test_scenes_that_are_refused(quick):
    bare = read_scene(EXAMPLES / "7003C-bare.toml")
    explicit = bare.replace({
        "imperfections.inner_race_amplitude_um": None,
        "imperfections.inner_race_harmonic": [{"order": 5, "amplitude_um": 0.1}],
    })  # fmt: skip
    wide = bare.replace({"sound": None, "bearing.outside_diameter_mm": 210.0})
    for scene, words in (
        (explicit, "leave the harmonics out"),
        (bare.replace({"imperfections": None}), "smooth surfaces make no vibration"),
        (with_fidelity(bare, model="rings"), "sensor touches the outer ring"),
        (wide, "outside_diameter_mm = 210: the vibration test is for 10 to 200 mm"),
    ):
        with pytest.raises((SceneError, ValueError), match=words):
            surface(scene, L=41.0, H=54.0)


def test_names_of_lines_are_read_with_any_blanks():
    found = known.stub()
    assert line_window(found, "f_i-f_r") == line_window(found, "f_i  -  f_r")
    window = line_window(found, "2 f_i + f_r")
    assert window.band == 1 and window.high - window.low == pytest.approx(10.0)
    with pytest.raises(ValueError, match="lies at 30 Hz, outside the bands"):
        line_window(found, "f_r")


# --- the model against runs -------------------------------------------------------------------------


@pytest.mark.heavy
def test_the_table_is_what_runs_give():
    """A part of the 214 runs: inner race at another exponent, an outer residue, balls; 15 s of CPU."""
    table, made = known.kept(), known.runs()

    def in_bands(scene):
        found = reading(scene)
        return np.array([found.energy @ share(found.frequency, *ends) for ends in bands(scene).values()])

    steep = made.inner().replace({"imperfections.waviness_exponent": 1.7})
    # by the orders' energies at 1.35: the answer is linear but for the contacts, 0.1 %, and four digits kept
    none = np.zeros((1, table.outer_orders.size))
    assert 0.3**2 * table.races(np.array([1.7]), 1.0, none)[0, :3] == pytest.approx(in_bands(steep), rel=0.03)
    residue, scene = list(made.outer())[1]
    own = table.outer_orders % 12 == residue
    # the table is of steps that resolve every mode of the ring, runs resolve those up to 20 kHz: 0.24 %
    assert 0.3**2 * table.outer[:3, own].sum(axis=1) == pytest.approx(in_bands(scene), rel=4e-3)
    for place in (0, 2):
        rigid = next(iter(made.balls(BALL_EXPONENTS[place], 1, rigid=True)))
        # small energies of H at the steepest exponent keep four digits, too
        assert made.form**2 * table.balls[:3, place, 0] == pytest.approx(in_bands(rigid), rel=1e-3)
    bent = in_bands(next(iter(made.balls(BALL_EXPONENTS[BENT_AT], 1, rigid=False))))
    ratio = bent / (made.form**2 * table.balls[:3, BENT_AT, 0])
    assert table.bending[:3, 0] == pytest.approx(ratio, rel=2e-3)


TRUTHS = 20


def truths():
    """Laws with other seeds: order 12 of 4 to 16 nm, exponents 1.15 to 1.75, balls of 12 to 120 nm."""
    rng = np.random.default_rng(77)
    for k in range(TRUTHS):
        exponent = float(rng.uniform(1.15, 1.75))
        order = float(np.exp(rng.uniform(np.log(4.0), np.log(16.0))))
        form = float(np.exp(rng.uniform(np.log(12.0), np.log(120.0))))
        amplitude = 1e-3 * order * 12.0**exponent
        yield {
            "inner_race_amplitude_um": amplitude, "outer_race_amplitude_um": amplitude,
            "waviness_exponent": exponent, "ball_form_nm": form, "seed": 1000 + k,
            "order_scatter_seed": 900_000 + k,
        }  # fmt: skip


@pytest.mark.heavy
def test_round_trips_by_full():
    """From a law to the test by fidelity full, and back: 20 laws with other seeds; 200 s of a processor.

    Measured values have the scatter of the tester that the standard deviation of 10 % says. The level at P1
    of the spindle is that of each law by fidelity response.
    """
    table = known.only(known.kept(), "LMH")
    spindle = read_scene(EXAMPLES / "7003C-spindle.toml")
    places = [one.position_m for one in spindle.microphones if one.name == "P1"]
    estimator = LevelEstimator(places, "compact", "A")

    def heard(flaws):
        scene = with_fidelity(spindle.model_copy(update={"imperfections": flaws}), model="response")
        return float(level(estimator.spectrum(scene).sum(axis=1))[0])

    rng = np.random.default_rng(5)
    scores, inside = [], []
    for law in truths():
        scene = rig(known.bearing().replace({f"imperfections.{key}": value for key, value in law.items()}))
        read: Reading = reading(scene)
        values = [
            np.sqrt(read.energy @ share(read.frequency, *ends)) * np.exp(0.1 * rng.normal())
            for ends in bands(scene).values()
        ]
        given = [Value(value, deviation) for value, deviation in zip(values, (0.1, 0.38, 0.1), strict=True)]
        drawn = posterior(table, given, WIDE, draws=12_000)
        order = drawn.amplitude_um * 12.0**-drawn.exponent
        own = law["inner_race_amplitude_um"] * 12.0 ** -law["waviness_exponent"]
        below = [
            (drawn.amplitude_um < law["inner_race_amplitude_um"]).mean(),
            (drawn.exponent < law["waviness_exponent"]).mean(),
            (order < own).mean(),
        ]
        scores.append(norm.ppf(np.clip(below, 5e-4, 1.0 - 5e-4)))  # of 1,000 draws
        found = Surface(
            "7003C", "", drawn.amplitude_um, drawn.exponent, drawn.ball_form_nm, drawn.seed, drawn.scatter
        )
        levels = [heard(flaws) for flaws in found.draws(40, spindle.imperfections)]
        inside.append(min(levels) <= heard(spindle.imperfections.model_copy(update=law)) <= max(levels))
    squares = np.mean(np.square(scores), axis=0)
    # 20 laws: the mean of z^2 has a standard deviation of 0.32; two of it
    assert np.all((squares > 0.4) & (squares < 1.6)), squares
    assert np.all((np.abs(scores) < 1.96).sum(axis=0) >= 18)
    assert sum(inside) >= 18
