"""What others measured beside what the package computes: gates, provenance, the page and its table."""

import csv
import re

import numpy as np
import pytest

from benchmarks.measured import compared, defects, friction, parts, stiffness
from benchmarks.measured.compared import SOURCES, everything, skf
from benchmarks.measured.findings import rms
from benchmarks.measured.page import COLUMNS, all_rows, page, tables
from benchmarks.measured.pictures import draw, drawable
from benchmarks.measured.sources import OTHER_BALLS, of, sources, values
from fmu_bearing import new_scene, statics
from fmu_bearing.design import measured
from fmu_bearing.formulas import iso76
from fmu_bearing.scene import read_scene_text
from fmu_bearing.scene.nsk import sizes
from tests.oracles.hertz import point_contact
from tests.pages import DOCS
from tests.tables import table

PAGE = (DOCS / "measured.md").read_text("utf-8")
TABLES = (DOCS / "results" / "measured.md").read_text("utf-8")


def test_every_value_has_its_source_with_all_that_was_assumed():
    counted = {key: len(of(key)) for key in sources()}
    assert counted == {
        "nsk": 240, "tpi": 360, "ibc": 6, "tp2275": 4, "asme": 4, "skf": 27, "ntn": 1, "cwru": 36,
        "cwru_pits": 7, "mfpt": 28, "paderborn": 8, "kyk": 30, "tnd7870": 1,
    }  # fmt: skip
    assert sum(counted.values()) == len(values()) and {one.__name__ for one in SOURCES} == set(counted)
    for one in values():
        source = sources()[one.source]
        assert one.place and one.quantity and one.unit and np.isfinite(one.published)
        assert source.kind and source.work and source.repository and source.given and source.assumed


def test_nsk_pairs_are_right_with_a_makers_grooves_and_too_stiff_with_the_papers():
    ratios = stiffness.ratios("nsk", (0.52, 0.53))
    assert len(ratios) == 240 and np.median(ratios) == pytest.approx(1.0, abs=0.05)
    assert np.median(ratios) == pytest.approx(0.980, abs=2e-3) and rms(ratios - 1.0) < 0.035
    # the rule now, and the one before
    assert np.median(stiffness.ratios("nsk", stiffness.RULE)) == pytest.approx(1.01, abs=5e-3)
    assert np.median(stiffness.ratios("nsk", (0.515, 0.52))) == pytest.approx(1.10, abs=5e-3)


def test_why_a_size_of_tpi_is_left_out():
    """TPI prints C0 = 2.64 kN for its 7001C; NSK's balls give 2.90 kN, so TPI's are others."""
    size = sizes()[f"NSK-{OTHER_BALLS}C"]
    rating = iso76.static_rating(size.balls, size.ball, size.pitch, np.radians(size.angle))
    assert rating == pytest.approx(2900.0, rel=0.01)
    assert len(of("tpi")) - sum(len(stiffness.kept("tpi", word)) for word in ("pair", "face")) == 24


def test_tpi_pairs_follow_with_one_number_for_both_races():
    """Nothing is fitted but this number; stiffness is printed without a digit after the point."""
    ratios = stiffness.ratios("tpi", stiffness.SYMMETRIC)
    assert len(ratios) == 168 and rms(ratios - 1.0) < 0.015
    kept = stiffness.kept("tpi", "pair")
    for angle, balls in ((15.0, "steel"), (25.0, "steel"), (15.0, "Si3N4")):
        some = ratios[[(one.angle_deg, one.balls) == (angle, balls) for one in kept]]
        assert len(some) == 56 and np.median(some) == pytest.approx(1.0, abs=0.004)
        assert rms(some - 1.0) < 0.015


def test_tpi_offsets_follow_within_the_rounding_of_the_print():
    """Two figures printed to 1 um differ by 0.41 um rms at most where nothing else does."""
    off = stiffness.offsets(stiffness.SYMMETRIC)
    assert len(off) == 168 and rms(off) < 0.4 and abs(np.mean(off)) < 0.1


def test_ceramic_balls_stiffen_a_pair_as_printed():
    pairs = [(printed, ours) for _, printed, ours in stiffness.ceramic_over_steel()]
    assert len(pairs) == 60
    printed, ours = np.array(pairs).T
    assert printed.mean() == pytest.approx(1.096, abs=0.015) and printed.std() < 0.015
    assert ours.mean() == pytest.approx(1.096, abs=0.015)
    # both vary about the mean by the angle under load; printed figures by their rounding, too
    assert np.abs(ours - printed).max() < 0.05


@pytest.mark.heavy
@pytest.mark.parametrize("place", [0, 85, 166])
def test_the_closed_form_is_the_set_that_a_scene_computes(place):
    """The axial stiffness of a DB set of steel bearings, by the engine's statics at 100 r/min."""
    value = [one for one in stiffness.kept("nsk", "pair")][place]
    text = new_scene(
        "pair", f"NSK-{value.bearing}", kind="steel", sound=False, speed_rpm=100.0, preload_N=value.load_N,
        arrangement="DB",
    )  # fmt: skip
    cold = {f"operation.{one}_temperature_degC": 20.0 for one in ("oil", "inner_ring", "outer_ring")}
    scene = read_scene_text(text).replace(cold)
    found = statics(scene)
    grooves = (scene.bearing.inner_conformity, scene.bearing.outer_conformity)
    # the closed form holds the constants of the free contact angle; modulus of the catalogue's steel
    ours = stiffness.pair_stiffness(value, grooves)
    assert 1e-6 * found.axial_stiffness == pytest.approx(ours, rel=2e-3)
    first = found.lift_off["+x"].load / value.load_N
    closed = stiffness.axial_load(
        bearing := stiffness._axial(f"NSK-{value.bearing}", "steel", grooves),
        2.0 * stiffness.axial_displacement(bearing, value.load_N),
    )
    assert first == pytest.approx(closed / value.load_N, rel=2e-3)


@pytest.fixture(scope="module")
def torque():
    """Ours over SKF's."""
    return np.array([friction.contact_torque(one) / one.published for one in of("skf")])


@pytest.mark.heavy
def test_torque_and_heat_are_those_of_the_table(torque):
    """Misses are on the page with today's figures: where friction changes, `make measured` writes them."""
    rows = {key: [row for row in table("measured") if row["source"] == key] for key in ("skf", "tp2275")}
    assert torque == pytest.approx([float(row["ours over theirs"]) for row in rows["skf"]], rel=2e-3)
    heat = [friction.heat_35(one) for one in of("tp2275")]
    assert heat == pytest.approx([float(row["ours"]) for row in rows["tp2275"]], rel=2e-3)
    light = [friction.hybrid_over_steel(one) for one in of("asme")]
    shown = [float(row["ours"]) for row in table("measured") if row["source"] == "asme"]
    assert light == pytest.approx(shown, rel=2e-3)


@pytest.mark.heavy
def test_goal_of_torque(torque):
    assert np.sum((torque > 0.8) & (torque < 1.25)) >= 24 and 0.85 <= np.median(torque) <= 1.05


@pytest.mark.heavy
@pytest.mark.xfail(strict=True, reason="missed: 0.85, 1.13, 1.24, 1.23 of measured; the settled cage whirls")
def test_goal_of_heat():
    heat = np.array([friction.heat_35(one) / one.published for one in of("tp2275")])
    assert np.all((heat > 0.78) & (heat < 1.22))


@pytest.mark.heavy
def test_goal_of_hybrid_over_steel():
    light = np.array([friction.hybrid_over_steel(one) for one in of("asme")])
    assert np.all((light > 0.82) & (light < 0.92))


@pytest.mark.heavy
def test_a_heat_balance_says_what_is_compared():
    """SKF's model has no cage and no drag: the rest of the operating point's torque is not taken."""
    value = of("skf")[4]
    whole = friction.friction_coefficient(value) * value.load_N * 50.0 / 2e3
    assert friction.contact_torque(value) < whole < 1.3 * friction.contact_torque(value)


def test_the_table_has_every_value_with_its_provenance():
    rows = table("measured")
    assert list(rows[0]) == list(COLUMNS)
    derived = sum(row["quantity"].startswith("stiffness with") for row in rows)
    # rules are compared by class, angle and load: 6 values are 12 lines
    assert derived == 60 and len(rows) == len(values()) + derived + 6
    for row in rows:
        assert row["work"] and row["repository"] and row["place"] and row["assumed"] and row["theirs"]
        assert row["ours"] or row["source"] == "tnd7870"
        if row["ours"]:
            assert float(row["ours from"]) <= float(row["ours"]) <= float(row["ours to"])


@pytest.mark.pages
def test_the_page_has_misses_first_and_a_figure_per_source():
    rows = re.findall(r"^\| (\*\*missed\*\*|beside|met) \|", PAGE, flags=re.MULTILINE)
    order = [("**missed**", "beside", "met").index(one) for one in rows]
    assert len(rows) == 20 and order == sorted(order) and order.count(0) == 9
    for key in sources():
        several = sum(row["source"] == key and row["counts"] == "yes" for row in table("measured")) > 1
        assert (
            several
            == (DOCS / "images" / "measured" / f"{key}.png").exists()
            == (f"(images/measured/{key}.png)" in PAGE)
        )


@pytest.mark.pages
def test_the_tables_have_every_part_of_the_friction_and_all_that_is_assumed():
    for one in (*friction.MOVES_35, *parts.PARTS_7210B, *parts.PARTS_35, *parts.FRESH):
        assert re.search(rf"^\| (\*\*)?{re.escape(one)}(\*\*| \||,)", TABLES, flags=re.MULTILINE), one


@pytest.mark.heavy
def test_houperts_force_is_larger_with_the_ratio_of_the_radii():
    """By the power 0.348 of that ratio over the ellipticity, here of an independent Hertz contact."""
    scene = parts.fresh("7003C")
    b = scene.bearing
    gamma = b.ball_diameter_mm * np.cos(np.radians(b.contact_angle_deg)) / b.pitch_diameter_mm
    for grown, conformity, side in zip(
        parts.radii_over_ellipticity(scene), (b.inner_conformity, b.outer_conformity), (-1, 1), strict=True
    ):
        along, across = 0.5 * (1.0 + side * gamma), conformity / (2.0 * conformity - 1.0)
        contact = point_contact(1.0, 1.0 / along, 1.0 / across, 1.0)
        ellipticity = contact.semi_major / contact.semi_minor
        assert grown == pytest.approx((across / along / ellipticity) ** 0.348, rel=1e-6) and grown > 1.4


def test_figures_of_info_are_those_of_the_table():
    rows = [row for row in table("measured") if row["counts"] == "yes"]
    for found, quantity in (
        (measured.STIFFNESS, "pair axial stiffness"), (measured.TORQUE, "rolling and sliding torque"),
        (measured.HEAT, "heat"),
    ):  # fmt: skip
        each = [float(row["ours over theirs"]) for row in rows if row["quantity"] == quantity]
        assert found == pytest.approx((min(each), max(each)), abs=5e-3)
    assert measured.PAGE == f'page "{PAGE.splitlines()[0].removeprefix("# ")}" of the documentation'
    lines = measured.measured_elsewhere()
    assert list(lines) == ["torque", "stiffness", "life and level", "all values"]
    assert lines["all values"] == measured.PAGE


@pytest.mark.pages
def test_a_figure_is_drawn_with_the_ends_of_what_is_assumed(tmp_path, monkeypatch):
    monkeypatch.setattr(compared, "of", lambda source: of(source)[:2])
    rows = drawable(skf())
    assert len(rows) == 2 and all(one.low < one.ours < one.high for one in rows)
    draw(rows, tmp_path / "skf.png")
    assert (tmp_path / "skf.png").read_bytes().startswith(b"\x89PNG")


@pytest.mark.heavy
def test_the_table_is_of_todays_package(monkeypatch):
    """All values made again, numbers to half a per cent; of what is assumed one move of each table.

    `make measured` writes table and page with all moves. Here both pages are made, whatever their ranges.
    Runs over defects take five minutes, and balls that bounce in a pit follow rounding: their rows are kept.
    """
    kept = {
        (row["source"], row["place"], row["quantity"]): float(row["ours"] or "nan")
        for row in table("measured")
    }
    for name in ("cwru_value", "mfpt_value"):
        monkeypatch.setattr(defects, name, lambda one, _: kept[one.source, one.place, one.quantity])
    for name in ("MOVES_7210B", "MOVES_35"):
        monkeypatch.setattr(friction, name, dict([*getattr(friction, name).items()][-1:]))
    found = everything()
    fresh = [dict(zip(COLUMNS, row, strict=True)) for row in all_rows(found)]
    for new, old in zip(fresh, table("measured"), strict=True):
        for key in COLUMNS:
            if not key.startswith("ours"):
                assert new[key] == old[key]
            elif new[key] and old[key] and not key.startswith(("ours from", "ours to")):
                assert float(new[key]) == pytest.approx(float(old[key]), rel=5e-3, abs=5e-3), (key, old)
        if new["ours"] and old["ours"]:
            low, high = (float(old[key]) for key in ("ours from", "ours to"))
            slack = 5e-3 * (1.0 + max(abs(low), abs(high)))
            assert low - slack <= float(new["ours from"]) <= float(new["ours to"]) <= high + slack, old
    heads = re.findall(r"^## .*$", PAGE, flags=re.MULTILINE)
    assert re.findall(r"^## .*$", page(found), flags=re.MULTILINE) == heads
    assert len(tables(found)) > 0.8 * len(TABLES)


@pytest.mark.heavy
def test_line_of_a_fault_of_the_inner_race():
    """Its frequency over the shaft's is the cage's doing: the table's, whatever balls do in the spall."""
    value = next(one for one in of("mfpt", "line of") if one.load_N == 1112.0)
    (shown,) = (
        float(row["ours"]) for row in table("measured")
        if row["place"] == value.place and row["quantity"] == value.quantity
    )  # fmt: skip
    found = defects.mfpt("inner", value.load_N, defects.SIZES[0])
    assert found.over_shaft == pytest.approx(shown, rel=1e-3)
    # 0.5 mm and more of load zone modulate the strokes once per turn
    assert found.side_bands > 0.5 and found.kurtosis > 3.0


def test_csv_of_values_holds_numbers_alone():
    """Where a cell is words, they name a place, a quantity or a bearing; none is a sentence of a source."""
    text = (DOCS.parent / "benchmarks" / "measured" / "values.csv").read_text("utf-8")
    rows = list(csv.DictReader(text.splitlines()))
    assert len(rows) == 512 and max(len(cell) for row in rows for cell in row.values()) < 90
