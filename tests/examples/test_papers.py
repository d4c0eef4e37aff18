"""The papers' pages: verdicts, calibration, levels on made-up signals, and a tiny run of each page."""

import csv
import math
import re

import numpy as np
import pytest

from examples.papers import case as case_module, circles, impact_noise, multi_source, page, sound_field
from examples.papers.calibration import calibrate
from examples.papers.case import Case
from examples.papers.hearing import Ear, a_weighted, equivalent, line, spectrum
from examples.papers.run import PAGES, run
from fmu_bearing.acoustics.filters.weighting import a_weighting_db

RATE = 51200.0


# --- verdicts ------------------------------------------------------------------------------------


def test_a_statement_holds_only_where_every_margin_is_positive():
    held = page.verdict("a above b", [("10,000", 0.3), ("20,000", 4.0)])
    assert held.verdict == page.HOLDS and held.figures == "+0.3 to +4.0 dB"
    equal = page.verdict("a above b", [("10,000", 0.0), ("20,000", 4.0)])
    assert equal.verdict == page.NOT and "in 1 of 2" in equal.figures and "10,000 (+0.0)" in equal.figures
    nowhere = page.verdict("a above b", [("10,000", -1.0), ("20,000", -4.0)], "%")
    assert nowhere.verdict == page.NOT and nowhere.figures == "nowhere: -4.0 to -1.0 %"
    assert page.verdict("a above b", []).verdict == page.UNSEEN
    assert page.verdict("a above b", [("10,000", math.nan)]).verdict == page.NOT
    assert page.counted([held, equal, nowhere, page.verdict("", [])]) == "1 of 3"


def test_trend_compares_changes_not_levels():
    since = (83.4, 83.0)
    assert page.Value("", 73.4, 60.0, since=since).trend == "-10.0 / -23.0: holds"
    assert page.Value("", 73.4, 90.0, since=since).trend == "-10.0 / +7.0: does not hold"
    assert page.Value("", 73.4, 90.0).trend == ""


# --- calibration ---------------------------------------------------------------------------------


def test_calibration_of_a_proportional_sound_takes_two_runs():
    found = calibrate(83.4, lambda scale: 74.0 + 20.0 * math.log10(scale))
    assert [db for db, _ in found.tries] == [0.0, 9.5]  # to the half decibel
    assert found.scale == pytest.approx(10 ** (9.5 / 20))
    assert (found.untouched, found.reached) == (pytest.approx(74.0), pytest.approx(83.5))


def test_calibration_across_a_jump_ends_at_the_nearest_try():
    # a threshold at 9.2 dB, as contacts that begin to part have it
    def level(scale):
        db = 20.0 * math.log10(scale)
        return 50.0 + db + (20.0 if db > 9.2 else 0.0)

    found = calibrate(74.0, level)
    tried = dict(found.tries)
    assert len(found.tries) <= 8 and max(tried) <= 20.0
    assert {9.0, 9.5} <= set(tried)  # both sides of the jump
    assert found.reached == tried[9.5] == pytest.approx(79.5)


def test_calibration_is_bounded():
    found = calibrate(74.0, lambda scale: 0.0)
    assert found.scale <= 10.0 and len(found.tries) <= 8


# --- levels of signals ---------------------------------------------------------------------------


def test_line_and_spectrum_read_a_tone():
    time = np.arange(8192) / RATE
    tone = np.sqrt(2.0) * 2e-2 * np.sin(2 * np.pi * 1311.0 * time + 0.3)  # 60 dB
    other = np.sqrt(2.0) * 2e-1 * np.sin(2 * np.pi * 1400.0 * time)  # 80 dB, five resolutions away
    # 0.1 dB: the search steps in 0.1 % of the frequency, the window's top is flat over that
    assert line(tone[None], RATE, 1309.0) == pytest.approx(60.0, abs=0.1)
    assert line((tone + other)[None], RATE, 1311.0) == pytest.approx(60.0, abs=0.5)  # leakage
    assert line(np.stack([tone, tone]), RATE, 1311.0) == pytest.approx(63.01, abs=0.1)  # energies
    levels = spectrum(tone[None], RATE, 20.0, 4000.0)
    assert len(levels) == 201 and int(np.argmax(levels)) * 20 in (1300, 1320)
    assert levels.max() == pytest.approx(60.0, abs=0.15)


def test_histories_are_peaks_of_the_weighted_pressure():
    time = np.arange(5120) / RATE  # 100 ms
    tone = 0.2 * np.sin(2 * np.pi * 3150.0 * time)
    peaks = impact_noise.histories(a_weighted(tone[None], RATE), RATE)
    assert peaks.shape == (1, 19)
    peak = 20 * math.log10(0.2 / 2e-5) + float(a_weighting_db([3150.0])[0])
    assert peaks[0] == pytest.approx([peak] * 19, abs=0.1)  # 16 samples a period: 0.17 dB at worst, rarely


# --- circles -------------------------------------------------------------------------------------


def pattern(angle, depth=3.0, level=80.0):
    """Field of circles with lobes at ``angle`` and opposite it, the former louder by 1 dB."""
    a = np.radians(np.array(circles.ANGLES) - angle)
    around = level + depth * np.cos(a) ** 2 + 0.5 * np.cos(a)
    return [[(around + 10 / r - x / 50).tolist() for x in circles.PLACES] for r in circles.RADII]


def test_circle_reads_angles_and_differences():
    c = circles.circle_at({"field": pattern(210)}, 210, 50)
    assert c.angle == 210 and c.zone(circles.IMPACT)[1] == 30 and c.zone(circles.FRICTION)[1] == 210
    assert c.zone(circles.FRICTION)[0] - c.zone(circles.IMPACT)[0] == pytest.approx(1.0)
    assert c.dv == pytest.approx(np.ptp(c.levels)) and c.dl == pytest.approx(c.top / c.mean)


def test_orderings_of_the_sound_field_follow_the_field():
    speeds = {3000: 15, 6000: 18, 12000: 36, 18000: 225}
    found = {rpm: {"field": pattern(a, level=60 + rpm / 1000)} for rpm, a in speeds.items()}
    judged = {one.statement: one.verdict for one in circles.orderings(found)}
    assert judged["both DA 180 deg apart (within 30)"] == page.HOLDS
    assert judged["3,000 r/min: zone 0-60 louder than 180-240"] == page.HOLDS
    assert judged["above: zone 180-240 louder than 0-60"] == page.NOT  # not yet at 6,000 and 12,000
    assert judged["points 1, 7, 13, 19 louder with every step of speed"] == page.HOLDS
    assert judged["both DA the same at all r (18,000 r/min)"] == page.HOLDS
    assert judged["DV grows with r at every l"] == page.NOT  # the same everywhere
    blind = {one.statement: one.verdict for one in circles.orderings(found, directive=False)}
    assert blind["both DA 180 deg apart (within 30)"] == page.UNSEEN
    assert blind["points 1, 7, 13, 19 louder with every step of speed"] == page.HOLDS
    sideways = {rpm: {"field": pattern(300)} for rpm in speeds}
    judged = {one.statement: one.verdict for one in circles.orderings(sideways)}
    assert judged["DA of the whole circle in or beside one of the zones (within 15 deg)"] == page.NOT


def test_load_points_to_its_angle():
    (_, y), (_, z) = sound_field.LOADED
    assert math.hypot(y, z) == pytest.approx(100.0)
    assert math.degrees(math.atan2(-y, z)) % 360.0 == pytest.approx(210.0)


# --- orderings of the multi-source paper ---------------------------------------------------------


def result(p1, p2, p3, p4, parts, lines):
    levels = {"total": [p1, p2, p3, p4]} | {name: [value] * 4 for name, value in parts.items()}
    return {"levels": levels, "lines": {name: dict(lines) for name in levels}}


def test_orderings_of_the_multi_source_paper_follow_the_levels():
    parts = {"outer_ring": 80.0, "inner_ring": 70.0, "balls": 60.0, "cage": 50.0}
    tones = {"f_r": 40.0, "2 f_r": 10.0, "f_c": 30.0, "f_b": 60.0, "f_i": 50.0, "f_o": 55.0}
    found = {
        rpm: result(80 + up, 70 + up, 81 + up, 75 + up, {k: v + up for k, v in parts.items()}, tones)
        for rpm, up in ((20000, 0.0), (28000, 9.0), (30000, 3.0))
    }
    judged = {one.statement: one.verdict for one in multi_source.orderings(found)}
    for words in (
        "P2 below P1 at every speed",
        "P4 between P2 and P1",
        "every point loudest at 28,000 r/min",
        "P1: every component loudest at 28,000 r/min",
        "balls: f_b largest",
        "balls: f_o above f_i",
        "inner ring: 2 f_r smallest",
        "P1: balls above cage at every speed",
    ):
        assert judged[words] == page.HOLDS, words
    for words in ("P3 below P1 at other speeds", "cage: f_c largest", "outer ring: f_o largest"):
        assert judged[words] == page.NOT, words


# --- cases ---------------------------------------------------------------------------------------


def test_recordings_are_told_apart_by_motion_alone():
    base = Case("7003C-spindle", 20000)
    assert base.key("compact") == base.key("bem") != base.key("paper")
    others = [
        Case("7003C-spindle", 20000, scale=1.1),
        Case("7003C-spindle", 20000, (("imperfections.seed", 2),)),
        Case("7003C-spindle", 20000, duration=0.2),
        Case("7003C-bare", 20000),
    ]
    assert len({one.key("compact") for one in (base, *others)}) == 5


def test_scale_multiplies_all_amplitudes():
    one = Case("7003C-spindle", 20000, multi_source.CHANGES).build().imperfections
    two = Case("7003C-spindle", 20000, multi_source.CHANGES, scale=2.0).build().imperfections
    assert one.ball_waviness_nm == 20.0
    for key in case_module.AMPLITUDES:
        assert getattr(two, key) == pytest.approx(2.0 * getattr(one, key)), key


@pytest.mark.parametrize("module", PAGES.values(), ids=list(PAGES))
def test_every_case_is_a_scene(module):
    found = module.cases(1.5, False)
    assert len(set(found)) == len(found)
    assert module.calibration_case(1.5, False) in found  # the calibration run serves as a case
    for one in found:
        assert one.build().operation.speed_rpm == one.rpm


# --- pages ---------------------------------------------------------------------------------------


@pytest.fixture(scope="module")
def tiny(tmp_path_factory):
    """All pages from tiny cases: some ten seconds of one core."""
    root = tmp_path_factory.mktemp("papers")
    with pytest.MonkeyPatch.context() as patch:
        # an instance in a worker warns of ellipses beyond the shoulder at the calibration's largest factor
        patch.setenv("PYTHONWARNINGS", "ignore")
        pages = run(list(PAGES), "compact", quick=True, jobs=1, cache=root / "cache", root=root)
    return root, pages


def test_tiny_pages_are_whole(tiny):
    root, pages = tiny
    assert [path.name for path in pages] == [f"{name}.md" for name in PAGES]
    for path in pages:
        text = path.read_text("utf-8")
        assert not re.search(r"\{\w*\}", text)  # nothing left to fill in
        assert "| calibrated |" in text and "| what the paper states |" in text
        assert "1e+" not in text and "nan" not in text
        for picture in re.findall(r"\]\(\.\./images/papers/([\w-]+\.png)\)", text):
            assert (root / "docs" / "images" / "papers" / picture).stat().st_size < 200_000
    for module in PAGES.values():
        assert module.CALIBRATION[0].split(",")[0] in (root / "docs/papers" / f"{module.NAME}.md").read_text()
    # radiation model compact shows no circle of the 7009C, and says so
    field = (root / "docs" / "papers" / "sound-field.md").read_text("utf-8")
    assert sound_field.NO_CIRCLE in field and "sound-field.png" not in field


def test_tiny_results_stand_in_csv(tiny):
    root, _ = tiny
    with (root / "docs" / "results" / "papers" / "multi-source-levels.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert {row["radiation_model"] for row in rows} == {"compact", "paper"}
    total = next(row for row in rows if (row["radiation_model"], row["component"]) == ("compact", "total"))
    assert float(total["P1"]) > float(total["P2"]) > 40.0  # a spindle, 105 and 150 mm from it
    with (root / "docs" / "results" / "papers" / "impact-noise-planes.csv").open() as file:
        angles = [float(row["angle_deg"]) for row in csv.DictReader(file)]
    assert angles == [15.0 * k for k in range(24)]


def test_a_repeated_run_takes_what_is_kept(tiny, monkeypatch):
    root, pages = tiny
    before = [path.read_text("utf-8") for path in pages]

    def refuse(*_, **__):
        raise AssertionError("a kept case was run again")

    monkeypatch.setattr(case_module, "record", refuse)
    again = run(list(PAGES), "compact", quick=True, jobs=1, cache=root / "cache", root=root)
    assert [path.read_text("utf-8") for path in again] == before


@pytest.mark.parametrize("radiation_model", ["compact", "paper"])
def test_sources_add_up_to_the_recordings_own_level(tiny, radiation_model, tmp_path):
    root, _ = tiny
    one = next(iter(multi_source.cases(1.0, True)))
    kept = sorted((root / "cache").glob("*.npz"))
    names = {path.stem for path in kept}
    scale = next(
        s for s in (10 ** (k / 40) for k in range(-40, 41))
        if multi_source.cases(s, True)[0].key(radiation_model) in names
    )  # fmt: skip
    recording = Case(one.scene, one.rpm, one.changes, scale, one.settle, one.duration).recording(
        radiation_model, root / "cache"
    )
    sources = Ear(recording, radiation_model, tmp_path).sources(recording.positions)
    assert set(sources) == {"inner_ring", "outer_ring", "cage", "balls", "total"}
    # the paper's energy sum, or the coherent one: two ways through the same paths
    assert equivalent(sources["total"]) == pytest.approx(
        recording.levels(radiation_model=radiation_model), abs=0.01
    )


@pytest.mark.heavy
def test_short_pages_say_what_is_known(tmp_path, monkeypatch):
    monkeypatch.setattr(multi_source, "SPEEDS", (20000, 30000))
    monkeypatch.setattr(sound_field, "SPEEDS", (3000, 18000))
    monkeypatch.setattr(sound_field, "STEEL_SPEEDS", (18000,))
    monkeypatch.setattr(sound_field, "SEEDS", ())
    monkeypatch.setattr(impact_noise, "SPEEDS", (10000, 20000))
    monkeypatch.setenv("PYTHONWARNINGS", "ignore")
    pages = run(list(PAGES), "compact", quick=False, jobs=2, cache=tmp_path / "cache", root=tmp_path)
    text = {path.stem: path.read_text("utf-8") for path in pages}
    # a dipole seen from 105 and 150 mm, and the paper's cylinder, which grows with distance (eqs. 35 to 40)
    row = next(r for r in text["multi-source"].splitlines() if "P2 below P1 at every speed" in r)
    cells = [cell.strip() for cell in row.split("|")]
    assert cells[2] == page.HOLDS and page.NOT in cells[4]
    assert "level grows with speed | holds" in text["impact-noise"]
    # one scalar, one point: reached to the half decibel where sound follows the scalar
    for name in ("multi-source", "sound-field"):
        left = re.search(r"left over: ([+-]\d+\.\d) dB", text[name])
        assert abs(float(left.group(1))) <= 0.5
