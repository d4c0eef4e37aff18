"""fmu-bearing fits: table, picture, numbers, and what it refuses; the block of info."""

import pytest

from fmu_bearing import fits
from fmu_bearing.design.fit_curves import curves
from fmu_bearing.design.fit_pictures import picture
from fmu_bearing.scene import read_scene
from tests.conftest import EXAMPLES
from tests.design.test_fits import HOUSING, SHAFT, STEEL, bearing, tight

DB = EXAMPLES.parent / "spindle_set" / "7003C-DB.toml"


@pytest.fixture
def file(fitted_file):
    return fitted_file


def test_table_csv_and_numbers(run, file, tmp_path):
    out = tmp_path / "fits.csv"
    shown = run("fits", file, "-o", out)
    assert shown.exit_code == 0, shown.output
    lines = {
        line.split("│")[1].strip(): line.split("│")[2:-1] for line in shown.stdout.splitlines() if "│" in line
    }
    cells = [float(cell) for cell in lines["preload, N, at speed"]]
    rows = [line.split(",") for line in out.read_text("utf-8").splitlines()]
    assert rows[0] == ["bearing", "", "min", "prob. min", "mean", "prob. max", "max"]
    data = run("fits", file, "--json").data
    full = [column["bearings"][0]["preload_N"]["running"] for column in data["columns"]]
    assert cells == pytest.approx(full, abs=0.5) and full[2] == pytest.approx(214.3, abs=0.1)
    assert data["files"] == []
    refused = run("fits", file, "-o", out)
    assert refused.exit_code == 2 and "--force" in refused.stderr
    at_rest = run("fits", file, "--speed", "0", "--set", "mounting.fit.shaft.shaft_class=k5", "--json").data
    tight_at_least = at_rest["columns"][0]["bearings"][0]["seats"]["inner"]
    assert tight_at_least["interference_m"]["running"] == pytest.approx(1e-6)  # k5 is 1 um and more
    assert tight_at_least["race_growth_m"]["running"] == tight_at_least["race_growth_m"]["warm"]


@pytest.mark.parametrize(
    ("words", "says"),
    [
        (("--plot", "x.gif"), ".png"),
        (("-o", "x.txt"), "the table is written as .csv"),
        (("--set", "mounting.fit.shaft.shaft_class=z9"), "mounting.fit.shaft.shaft_class"),
    ],
)
def test_refusals(run, file, words, says):
    refused = run("fits", file, *words)
    assert refused.exit_code == 2 and says in refused.stderr and refused.stdout == ""


def test_a_scene_without_a_fit_is_refused(run):
    refused = run("fits", EXAMPLES / "7003C-bare.toml")
    assert refused.exit_code == 2
    assert "has no fit" in refused.stderr and "[mounting.fit.shaft]" in refused.stderr


@pytest.mark.heavy
def test_pictures_have_bands_limits_and_the_speed_of_loss():
    """Curves are the study's at the scene's speed and temperatures; a ring that lets go has its mark."""
    strong = {"youngs_modulus_GPa": 310.0, "poisson_ratio": 0.26, "density_kg_m3": 3200.0}
    strong |= {"expansion_1e6_K": 3.2, "bending_strength_MPa": 900.0, "weibull_modulus": 12.0}
    found = fits(bearing(strong, "Si3N4", 60.0, shaft=SHAFT | {"bore_mm": 8.0}))
    (one,) = curves(found)
    assert one.speed.free_angle.shape == (5, 41) and one.speed.held.shape == one.temperature.held.shape == (
        5,
        6,
    )
    mean = found.column("mean").bearings[0]
    assert one.speed.held[2, 4] == pytest.approx(mean.preloads["running"], rel=1e-9)  # 1.0 of the speed
    assert one.temperature.held[2, 0] == pytest.approx(mean.preloads["mounted"], rel=0.05)  # at speed
    at = one.speed.fine.searchsorted(20e3)
    assert one.speed.hoop[2, at] == pytest.approx(mean.seats["inner"].states["running"].hoop, rel=1e-3)
    panels = picture(found, [one]).axes
    assert len(panels) == 6
    (hoop,) = [panel for panel in panels if "hoop" in panel.get_title()]
    assert [text.get_text() for text in hoop.get_legend().get_texts()] == [
        "breaks with 1e-06", "breaks with 0.0001",
    ]  # fmt: skip
    steel = fits(bearing(shaft=tight(0.3)))
    (curve,) = curves(steel)
    (left,) = [panel for panel in picture(steel, [curve]).axes if "interference" in panel.get_title()]
    loss = steel.column("mean").bearings[0].seats["inner"].loss_speed
    marks = [line.get_xdata()[0] for line in left.lines if line.get_marker() == "o"]
    assert marks == pytest.approx([1e-3 * loss * 9.549297] * 5) and marks[0] < 25.0


@pytest.mark.heavy
def test_pictures_of_a_bearing_on_springs_with_a_housing_alone(tmp_path, run):
    scene = bearing(warm=20.0, housing=HOUSING).replace({"mounting.preload_mode": "force"})
    path, target = tmp_path / "housing.toml", tmp_path / "fits.png"
    path.write_text(scene.model_copy(update={"sound": None}).to_toml(), "utf-8")
    done = run("fits", path, "--plot", target)
    assert done.exit_code == 0 and target.stat().st_size > 10_000
    (one,) = curves(fits(scene))
    assert one.held_by_force and one.temperature is None and one.speed.hoop.size == 0


@pytest.mark.heavy
def test_info_has_the_seats_of_each_bearing(run, file, tmp_path):
    shown = run("info", file).stdout
    assert "fits: inner ring js5 on P4, mean 2.0 um of -4.0 to 8.0" in " ".join(shown.split())
    data = run("info", file, "--json").data
    assert data["fits"]["bearings"][0]["preload_N"]["running"] == pytest.approx(214.3, abs=0.1)
    assert {"hoop_inner", "fit_loss", "mounted_preload"} <= {one["key"] for one in data["verdicts"]}
    fit = {"spindle.fit": {"preload": "unmounted", "shaft": {"interference_um": 2.0, "material": STEEL}}}
    path = tmp_path / "pair.toml"
    path.write_text(read_scene(DB).replace(fit).to_toml(), "utf-8")
    of_set = " ".join(run("info", path).stdout.split())
    assert "fits, bearing 1: inner ring 2 um as given" in of_set and "fits, bearing 2" in of_set
    assert "fits" not in run("info", DB, "--json").data


@pytest.mark.heavy
def test_equal_columns_and_rows_of_all_bearings_are_shown_once(run, file, tmp_path):
    fit = {"spindle.fit": {"preload": "unmounted", "shaft": {"interference_um": 2.0, "material": STEEL}}}
    path = tmp_path / "pair.toml"
    path.write_text(read_scene(DB).replace(fit).to_toml(), "utf-8")

    def cells(shown, name):
        return [line.split("│")[2:-1] for line in shown.splitlines() if name in line]

    shown = run("fits", path).stdout
    assert cells(shown, "inner ring, fit, um, mounted") == [[" +2.0     "]]
    assert len(cells(shown, "pressure of balls")) == 2  # the load is not the same
    assert shown.index("all bearings, inner ring") < shown.index("bearing 1, ") < shown.index("bearing 2, ")
    ((*row,),) = cells(run("fits", file).stdout, "inner ring, fit, um, mounted")
    assert len(row) == 5
