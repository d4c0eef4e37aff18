"""The coupling maps: what the example measures on a few cells is what its formula and its page say."""

import csv

import pytest

from tests.examples.conftest import ROOT

PAGE = ROOT / "docs" / "results" / "coupling.csv"


def cells(path):
    with path.open(encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    return {(row["coupling"], row["step_s"], row["inertia_kg_m2_or_cooling"]): row for row in rows}


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("coupling")
    import stability

    stability.main(quick=True, results=out, images=None)
    return out


@pytest.mark.heavy
def test_shafts_lighter_than_the_balls_diverge_and_others_settle(folder):
    from stability import DIVERGED

    found = cells(folder / "coupling.csv")
    for step in ("0.0001", "0.0003", "0.001"):
        light, middle, own = (found["torque", step, inertia] for inertia in ("6e-08", "2e-07", "0.000164"))
        assert float(light["factor"]) < -DIVERGED and float(light["predicted"]) < -1.9
        if step == "0.001":  # in less the balls do not follow such jumps of speed: they slip
            assert float(light["factor"]) == pytest.approx(float(light["predicted"]), rel=0.1)
        # one number, the inertia of balls and cage, tells the factor within a few hundredths
        assert float(middle["factor"]) == pytest.approx(float(middle["predicted"]), abs=0.05)
        assert abs(float(own["factor"])) < 3e-3  # Jb / J is 7e-4
        assert all(abs(float(row["factor_taken_over"])) < 0.1 for row in (light, middle, own))


@pytest.mark.heavy
def test_heat_settles_without_turns_of_sign(folder):
    rows = [row for key, row in cells(folder / "coupling.csv").items() if key[0] == "heat"]
    factors = [float(row["factor"]) for row in rows]
    assert len(factors) == 2 and 1.0 > factors[0] > factors[1] > 0.0  # the longer step forgets more


@pytest.mark.heavy
def test_page_repeats_what_the_example_measures(folder):
    assert (folder / "coupling.png").stat().st_size > 10_000
    assert "](coupling.png)" in (folder / "coupling.md").read_text("utf-8")
    kept = cells(PAGE)
    for key, row in cells(folder / "coupling.csv").items():
        if abs(float(row["factor"])) < 1.0:  # where it grows, rounding grows with it
            assert float(row["factor"]) == pytest.approx(float(kept[key]["factor"]), abs=0.02), key
