"""The search on a problem with a closed solution, and what it refuses."""

import numpy as np
import pytest

from fmu_bearing import identify
from fmu_bearing.identification import IdentifyError, search as module
from fmu_bearing.identification.data import read_data
from fmu_bearing.identification.free import free_numbers, start_point
from fmu_bearing.identification.model import Levels
from fmu_bearing.progress import Stopped
from fmu_bearing.scene.read import with_fidelity

KEYS = ["imperfections.unbalance_um", "imperfections.inner_race_amplitude_um"]
QUANTITIES = ("leq", "leq_a", "line[f_r]", "line[f_o]")
STD, NOISE = 1.0, 0.05  # dB: residuals far below what soft_l1 counts less


@pytest.fixture(scope="module")
def spindle(scene):
    return with_fidelity(scene("7003C-spindle"), model="response")


class Linear(Levels):
    """Levels that are linear in the coordinates: the best values have a closed form."""

    slopes = np.random.default_rng(3).uniform(1.0, 9.0, (8, 2))
    swing = 0.0  # dB over seeds

    def at(self, x, seeds, fidelity, check=False):
        steady = 60.0 + self.slopes @ (x - start_point(self.free))
        off = [self.swing * np.random.default_rng(seed).normal(size=len(steady)) for seed in seeds]
        return steady + np.array(off)


@pytest.fixture
def linear(monkeypatch):
    monkeypatch.setattr(module, "Levels", Linear)
    monkeypatch.setattr(Linear, "swing", 0.0)
    return Linear


def table(values):
    return [
        {"microphone": name, "quantity": quantity, "value_dB": float(value), "std_dB": STD}
        for (name, quantity), value in zip(
            [(name, quantity) for name in ("P1", "P2") for quantity in QUANTITIES], values, strict=True
        )
    ]


def test_solution_and_covariance_are_those_of_weighted_least_squares(spindle, linear):
    off = linear.slopes @ [0.4, -0.3] + np.random.default_rng(4).normal(0.0, NOISE, 8)
    found = identify(spindle, table(60.0 + off), KEYS, seeds=2, starts=2, progress=False)
    best, *_ = np.linalg.lstsq(linear.slopes, off, rcond=None)
    moved = [np.log(one.value / one.free.start) for one in found.estimates]
    assert moved == pytest.approx(best, abs=2e-3)  # where the search may stop: 1e-3 of the cost
    assert found.jacobian == pytest.approx(linear.slopes)
    assert found.covariance == pytest.approx(
        STD**2 * np.linalg.inv(linear.slopes.T @ linear.slopes), rel=1e-6
    )
    assert found.rms() == pytest.approx(np.std(off - linear.slopes @ best), rel=0.1)
    assert found.rms(before=True) == pytest.approx(np.sqrt(np.mean(off**2)))
    assert found.residual_scale == 1.0 and found.correlation[0, 1] == pytest.approx(-0.88, abs=0.01)
    assert [remark.split(" (")[0] for remark in found.remarks] == [
        f"{' and '.join(KEYS)} trade against each other"
    ]


def test_what_seeds_change_is_uncertain(spindle, linear, monkeypatch):
    values = table(60.0 + linear.slopes @ [0.4, -0.3])
    still = identify(spindle, values, KEYS, seeds=4, starts=1, progress=False)
    monkeypatch.setattr(linear, "swing", 2.0)
    moving = identify(spindle, values, KEYS, seeds=4, starts=1, progress=False)
    spread = np.array([one.spread for one in moving.compared])
    assert spread.mean() == pytest.approx(2.0, rel=0.3)  # twelve seeds
    # variances 1 + (1 + 1/4) 4 in place of 1
    widened = np.trace(moving.covariance) / np.trace(still.covariance)
    assert widened == pytest.approx(6.0, rel=0.4)


def test_six_levels_carry_two_keys(spindle, linear):
    values = table(np.full(8, 60.0))
    three = [*KEYS, "mounting.pedestal_stiffness_N_m"]
    with pytest.raises(
        IdentifyError, match=r"8 fitted values carry 2 free keys \(3 values each\), and 3 are free"
    ):
        identify(spindle, values, three)
    with pytest.raises(IdentifyError, match="1 fitted values cannot determine 2 free keys"):
        identify(spindle, values[:1], KEYS, few=True)
    with pytest.raises(IdentifyError, match="carry 1 free keys.*free 1 of them"):
        identify(spindle, values[:4] + [row | {"role": "check"} for row in values[4:]], KEYS)


def test_few_values_are_allowed_knowingly(spindle, linear, monkeypatch):
    monkeypatch.setattr(linear, "slopes", linear.slopes[:3])
    found = identify(spindle, table(np.full(8, 61.0))[:3], KEYS, few=True, starts=1, progress=False)
    assert any("3 fitted values carry 1 free keys" in remark for remark in found.remarks)


@pytest.mark.parametrize(
    ("options", "message"),
    [
        ({"fidelity": "best"}, "fidelity 'best' is unknown: there are full, rings, response"),
        ({"seeds": 0}, "seeds = 0 is refused"),
        ({"duration": -1.0}, "duration = -1.0 s lies outside"),
    ],
)
def test_settings_that_are_refused(options, message, spindle):
    with pytest.raises(IdentifyError, match=message):
        identify(spindle, table(np.full(8, 60.0)), KEYS, **options)


def test_a_scene_that_cannot_be_run_is_refused_with_the_reason(spindle):
    rows = [
        {"microphone": "P1", "quantity": "line[20 f_i]", "value_dB": 60.0, "speed_rpm": speed}
        for speed in (18000.0, 19000.0, 20000.0)
    ]
    with pytest.raises(IdentifyError, match="the scene as it is cannot be run .* line at"):
        identify(spindle, rows, KEYS[:1])


def test_ctrl_c_gives_the_best_so_far(spindle, linear, monkeypatch):
    off = linear.slopes @ [0.4, -0.3]
    plain, calls = linear.at, []

    def stop(self, *arguments, **options):
        calls.append(1)
        if len(calls) > 25:
            raise KeyboardInterrupt
        return plain(self, *arguments, **options)

    monkeypatch.setattr(linear, "at", stop)
    with pytest.raises(Stopped) as caught:
        identify(spindle, table(60.0 + off), KEYS, starts=1, progress=False)
    best = caught.value.found
    assert not best.complete and best.rms() < best.rms(before=True)
    assert np.isnan(best[KEYS[0]].std) and "interrupted" in best.remarks[0]


def test_another_fidelity_of_the_scene_moves_the_levels_the_search_is_compared_with(
    spindle, linear, monkeypatch
):
    """The scene's own fidelity reads 2 dB more: the search lands where that fits, not where its own would."""
    full = with_fidelity(spindle, model="full")
    plain = linear.at

    def at(self, x, seeds, fidelity, check=False):
        return plain(self, x, seeds, fidelity, check) + 2.0 * (fidelity == "full")

    monkeypatch.setattr(linear, "at", at)
    off = linear.slopes @ [0.4, -0.3]
    found = identify(full, table(62.0 + off), KEYS, fidelity="response", starts=1, progress=False)
    moved = [np.log(one.value / one.free.start) for one in found.estimates]
    assert moved == pytest.approx([0.4, -0.3], abs=2e-3)
    assert found.fidelity == "response" and found.rms() < 0.05


def test_velocities_need_channels_that_hold_them(spindle):
    paper = spindle.model_copy(
        update={"sound": spindle.sound.model_copy(update={"radiation_model": "paper"})}
    )
    rows = [{"quantity": "velocity[housing.z]", "value_dB": 100.0, "speed_rpm": v} for v in (1e4, 2e4, 3e4)]
    with pytest.raises(IdentifyError, match="velocities cannot be computed beside radiation_model"):
        identify(paper, rows, KEYS[:1])


def test_free_keys_of_the_data_are_refused(spindle):
    rows = [row | {"preload_N": 300.0} for row in table(np.full(8, 60.0))]
    with pytest.raises(IdentifyError, match="is a condition of the data already"):
        identify(spindle, rows, ["mounting.preload_N"])


def test_a_value_of_zero_in_the_scene_is_reported(spindle, linear):
    keys = ["imperfections.unbalance_um", "imperfections.ball_waviness_nm=1:100"]
    found = identify(spindle, table(np.full(8, 60.0)), keys, seeds=1, starts=1, progress=False)
    said = (
        "imperfections.ball_waviness_nm is 0 in the scene: the search, and the values under 'before', begin"
    )
    assert [text for text in found.remarks if text.startswith(said) and text.endswith("of its bounds, 10")]


def test_values_by_name(spindle, linear):
    found = identify(spindle, table(np.full(8, 60.0)), KEYS, seeds=1, starts=1, progress=False)
    assert found[KEYS[0]].value == pytest.approx(0.5, rel=1e-3)
    with pytest.raises(KeyError, match="free: imperfections.unbalance_um"):
        found["mounting.preload_N"]
    assert free_numbers(spindle, KEYS) == tuple(one.free for one in found.estimates)
    assert len(read_data(table(np.full(8, 60.0)), spindle)) == len(found.compared)


def test_values_far_off_are_named(spindle, linear):
    values = 60.0 + linear.slopes @ [0.4, -0.3]
    values[5] += 12.0
    found = identify(spindle, table(values), KEYS, seeds=1, starts=1, progress=False)
    (doubt,) = found.doubts  # the residuals left are 11 dB there and below 1 dB elsewhere, of 1 dB
    assert doubt.startswith("P2 leq_a (fitted, row 5): measured ") and " standard deviations apart" in doubt
    values[5] -= 12.0
    assert identify(spindle, table(values), KEYS, seeds=1, starts=1, progress=False).doubts == ()


def test_checked_values_far_above_the_fitted_are_said(spindle, linear):
    values = 60.0 + linear.slopes @ [0.4, -0.3]
    rows = [row | {"role": "check" if k in (3, 7) else "fit"} for k, row in enumerate(table(values))]
    assert identify(spindle, rows, KEYS, seeds=1, starts=1, progress=False).doubts == ()
    for k in (3, 7):
        rows[k]["value_dB"] += 4.0
    (doubt,) = identify(spindle, rows, KEYS, seeds=1, starts=1, progress=False).doubts
    assert doubt.startswith("checked values are 4.0 dB rms off, fitted ones 0.0 dB")


def test_a_result_worse_than_the_scene_is_said(spindle, linear, monkeypatch):
    """Two seeds whose levels differ from the others': what the search sees is not what is reported."""
    full = with_fidelity(spindle, model="full")
    plain = linear.at

    def at(self, x, seeds, fidelity, check=False):
        # the scene's own fidelity falls where the search's rises: no round of corrections meets it
        levels = plain(self, x, seeds, fidelity, check)
        return levels if fidelity == "response" else 2.0 * 60.0 - levels

    monkeypatch.setattr(linear, "at", at)
    found = identify(
        full, table(60.0 + linear.slopes @ [0.4, -0.3]), KEYS, fidelity="response", starts=1, progress=False
    )
    assert found.rms() > found.rms(before=True)
    assert any(f"fitted values are {found.rms():.1f} dB rms off" in doubt for doubt in found.doubts)
