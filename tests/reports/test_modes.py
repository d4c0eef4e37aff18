"""Modes in the report and on their own page: figures of `campbell` and `modes`, or the reason why not."""

import dataclasses
import json
import re

import numpy as np
import pytest

from fmu_bearing import campbell
from fmu_bearing.modal.campbell.diagram_style import counted, drawn_lines
from fmu_bearing.modal.modes.points import modes
from fmu_bearing.recording.record import Recording
from fmu_bearing.reports import modes_page
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.modes import modes_section as room
from fmu_bearing.reports.modes.campbell_chart import campbell_chart, crossing_table, mode_table
from fmu_bearing.reports.modes.modes_section import section
from fmu_bearing.reports.modes.moving_shapes import moving_shapes
from fmu_bearing.reports.page.blocks import Absent
from tests.conftest import SHARES
from tests.reports.reading import Page, numbers
from tests.reports.test_browser import BROWSER, NAMES

SPEEDS = (12e3, 16e3, 20e3, 24e3)


@pytest.fixture(scope="module")
def found(example):
    return campbell(example("7003C-spindle"), SPEEDS)


@pytest.fixture(scope="module")
def ceramic(scene):
    """Rings that bend."""
    return campbell(scene("7009C-full-ceramic"), (14e3, 16e3, 18e3))


@pytest.fixture(scope="module")
def file(found, tmp_path_factory):
    return modes_page(found, tmp_path_factory.mktemp("page") / "modes.html")


def subject_of(scene, rpm):
    """A recording of nothing but its scene and its speed."""
    turning = np.full(64, rpm * np.pi / 30.0)
    time = np.arange(64) / 51_200.0
    return Subject(Recording(scene, "compact", 51_200.0, 0.0, 64, time, turning, {}), "compact")


def texts(made):
    return [block.text for block in made.blocks if block.sort == "words"]


def traces(chart, part):
    return [trace for trace in chart.figure.data if (trace.meta or {}).get("part") == part]


def test_the_report_has_the_section(full_page, full_report, full):
    assert full_report.sections["modes"] == ""
    rpm = float(np.mean(full.speed)) * 30.0 / np.pi
    (caption,) = [caption for caption in full_page.tables if caption.startswith("Modes at ")]
    assert caption == f"Modes at {rpm:,.0f} r/min"
    at = modes(full.scene.replace({"operation.speed_rpm": rpm}))
    rows = full_page.tables[caption][1:]
    wanted = at.records(20e3)
    assert [row[:4] for row in rows] == [
        [f"{one.frequency:,.1f}", f"{100.0 * one.damping:.2f}", str(one.order), one.direction or "-"]
        for one in wanted
    ]
    assert [row[4].partition(" (")[0] for row in rows] == [one.name for one in wanted]
    # the gate's scene has no imperfections
    assert "No line that the scene contains meets a mode" in full_page.sections["modes"]
    assert "campbell" in full_page.figures
    assert len({row[4] for row in rows} & {"inner tilt", "inner axial", "outer radial"}) == 3


def test_the_chart_has_branches_lines_and_crossings(found):
    chart = campbell_chart(found)
    points = traces(chart, "points")
    assert len(points) == len(found.branches)
    for trace, branch in zip(points, found.branches, strict=True):
        assert numbers(trace.y) == pytest.approx(branch.frequency, rel=2e-5)
        assert branch.label in trace.text[0] and f"{branch.damping[0]:.4f}" in trace.text[0]
    assert len(traces(chart, "line")) == len(drawn_lines(counted(found)))
    (dots,) = traces(chart, "crossings")
    assert sorted(numbers(dots.x)) == pytest.approx(sorted(one.rpm for one in counted(found)), rel=2e-5)
    for (k, i), rpm in zip(dots.customdata, dots.x, strict=True):
        speeds = found.branches[k].rpm
        assert abs(speeds[i] - rpm) == np.min(abs(speeds - rpm))
    (bar,) = traces(chart, "operation")
    assert list(numbers(bar.x)) == [20_000.0] * 2
    assert found.verdict() in chart.words


def test_tables_are_those_of_modes_and_crossings(found):
    """Every row is a crossing, the nearest to 20,000 r/min by ratio first; printed to the last digit."""
    table, left = crossing_table(found), list(counted(found))
    assert len(table.rows) == len(left) >= 5
    speeds = []
    for apart, rpm, hertz, mode, damping, line, source, quality, velocity in table.rows:
        speeds.append(float(rpm.replace(",", "")))
        (one,) = [
            each for each in left
            if (each.line.name, each.branch.label) == (line, mode) and abs(each.rpm - speeds[-1]) < 0.501
        ]  # fmt: skip
        left.remove(one)
        assert float(apart) == pytest.approx(100.0 * (one.rpm / 20e3 - 1.0), abs=0.0501)
        assert source == f"{one.line.source} {one.line.surface_order or ''}".rstrip()
        assert float(hertz.replace(",", "")) == pytest.approx(one.frequency, abs=0.501)
        assert float(damping) == pytest.approx(100.0 * one.damping, abs=5.01e-3)
        assert float(quality) == pytest.approx(0.5 / one.damping, abs=0.501)
        assert float(velocity.replace(",", "")) == pytest.approx(1e6 * one.velocity, abs=0.501)
    assert not left
    apart = np.abs(np.log(np.array(speeds) / 20e3))
    assert (np.diff(apart) > -1e-4).all()  # speeds are rounded to 1 r/min
    near = found.nearest()
    assert (table.rows[0][5], table.rows[0][3]) == (near.line.name, near.branch.label)
    assert table.rows[0][1] == f"{near.rpm:,.0f}"


def test_the_instability_margin_is_named_in_table_and_report(scene, monkeypatch):
    """7009C at 18,000 r/min: forward tilting with a damping ratio of about 0.0001."""
    monkeypatch.setattr(room, "_SHARES", SHARES)
    made = section(subject_of(scene("7009C-full-ceramic"), 18_000.0))
    (table,) = [b for b in made.blocks if b.sort == "table" and b.caption.startswith("Modes at 18,000")]
    (row,) = [row for row in table.rows if row[4].startswith("inner tilt (") and row[3] == "forward"]
    assert abs(float(row[1])) < 0.2
    assert "instab" in row[4] or "unstable" in row[4]
    assert any(t.startswith("Instability") and "'inner tilt forward'" in t for t in texts(made))
    (chart,) = [block for block in made.blocks if block.sort == "chart"]
    assert traces(chart, "unstable")


def test_at_standstill_there_are_modes_with_and_without_friction(scene):
    made = section(subject_of(scene("7003C-spindle"), 0.0))
    assert not [block for block in made.blocks if block.sort == "chart"]
    assert texts(made)[0].startswith("No Campbell diagram: the shaft does not turn")
    stuck, sliding = (block for block in made.blocks if block.sort == "table")
    assert "contacts stick" in stuck.caption and "without friction" in sliding.caption
    tilts = [
        float(next(r for r in t.rows if r[4] == "inner tilt")[0].replace(",", "")) for t in (stuck, sliding)
    ]
    assert tilts[0] > tilts[1]


@pytest.mark.heavy
def test_a_scene_without_imperfections_and_sound(scene):
    bare = scene("7003C-bare").model_copy(update={"imperfections": None, "sound": None})
    made = section(subject_of(bare, 20_000.0))
    (chart,) = [block for block in made.blocks if block.sort == "chart"]
    assert "has no imperfections" in chart.note and "sound levels" not in chart.note
    assert not chart.figure.layout.shapes and texts(made)[0].startswith("No line that the scene contains")
    (crossings,) = [b for b in made.blocks if b.sort == "table" and b.caption.startswith("Crossings")]
    assert all(row[-1] == "not in the scene" for row in crossings.rows)


@pytest.mark.heavy
@pytest.mark.parametrize("model", ["rings", "response", "auto"])
def test_every_fidelity_has_modes(scene, model, monkeypatch):
    """They are modes of `full`, so only the speeds are cut down here."""
    monkeypatch.setattr(room, "_SHARES", SHARES)
    given = scene("7003C-spindle")
    given = given.model_copy(update={"fidelity": given.fidelity.model_copy(update={"model": model})})
    made = section(subject_of(given, 20_000.0))
    assert [block.key for block in made.blocks if block.sort == "chart"] == ["campbell"]


@pytest.mark.heavy
def test_speeds_without_equilibrium_are_told(scene, monkeypatch):
    lowest = room.campbell

    def failing(scene, speeds, **options):
        found = lowest(scene, speeds[:4], **options)
        return dataclasses.replace(found, skipped=((28_000.0, "no equilibrium"),))

    monkeypatch.setattr(room, "campbell", failing)
    made = section(subject_of(scene("7003C-spindle"), 20_000.0))
    assert any("28,000 r/min is left out: no equilibrium" in text for text in texts(made))
    # the shaft's own speed was not computed: the table says which one it has
    assert any(b.caption == "Modes at 14,000 r/min" for b in made.blocks if b.sort == "table")

    def none(scene, speeds, **options):
        raise ValueError("only 1 of 9 speeds have an equilibrium")

    monkeypatch.setattr(room, "campbell", none)
    made = section(subject_of(scene("7003C-spindle"), 20_000.0))
    assert texts(made)[0] == "No Campbell diagram: only 1 of 9 speeds have an equilibrium."
    assert any(b.caption == "Modes at 20,000 r/min" for b in made.blocks if b.sort == "table")
    with pytest.raises(Absent, match="which scene"):
        section(subject_of(None, 20_000.0))


def test_shapes_turn_the_way_that_their_mode_does(found, ceramic):
    """Rings' centres, or their axes, go round with the shaft in forward modes; bends travel with it."""
    seen = set()
    for diagram in (found, ceramic):
        points = {id(mode): point for point in diagram.points for mode in point.modes}
        for branch in diagram.branches:
            mode = branch.modes[0]
            moving = points[id(mode)].shape(mode)
            parts = [moving.inner, moving.outer]
            values = np.concatenate([*parts, moving.patterns.ravel()])
            assert np.abs(values).max() <= 1.0 + 1e-9
            if branch.order == 1 and branch.direction:
                pairs = [(part[k], part[k + 1]) for part in parts for k in (2, 4)]
            elif branch.order > 1 and branch.direction:
                pairs = [(one.cosine, one.sine) for one in moving.bends if one.order == branch.order]
            else:
                continue
            a, b = max(pairs, key=lambda pair: abs(pair[0]) ** 2 + abs(pair[1]) ** 2)
            forward = abs(a + 1j * b) > abs(a - 1j * b)
            assert forward == (branch.direction == "forward"), branch.label
            seen.add((min(branch.order, 2), branch.direction))
    assert len(seen) == 4


def test_data_of_the_shapes_hold_every_point(ceramic):
    data = json.loads(moving_shapes(ceramic).json)
    assert [len(one["points"]) for one in data["branches"]] == [one.rpm.size for one in ceramic.branches]
    k, i = data["chosen"]
    assert ceramic.branches[k] is ceramic.nearest().branch
    assert data["branches"][k]["points"][i]["rpm"] == pytest.approx(18_000.0)
    balls = data["branches"][0]["points"][0]["balls"]
    assert len(balls) == 3 and {len(row) for row in balls} == {ceramic.scene.bearing.ball_count}


def test_the_page_is_whole_and_offline(file, found):
    page = Page(file)
    assert 1.9e6 < file.stat().st_size < 2.3e6
    assert page.addresses and all(a.startswith(("#", "data:")) for a in page.addresses)
    assert len(set(page.ids)) == len(page.ids)
    assert set(page.sections) == {"summary", "diagram", "modes", "crossings"}
    assert found.verdict() in page.sections["summary"]
    assert "Content-Security-Policy" in page.text and "Modes of a bearing" in page.text
    assert "Modes at 20,000 r/min" in page.tables
    other = mode_table(found.points[0], found.highest)
    assert other.caption not in page.tables


def test_the_page_takes_modes_of_another_point(found, tmp_path):
    page = Page(modes_page(found, tmp_path / "a.html", found.points[0]))
    assert "Modes at 12,000 r/min" in page.tables


def test_a_report_has_no_script_of_shapes(full_page):
    assert "shapes-data" not in re.sub(r"<style>.*?</style>", "", full_page.text, flags=re.S)


@pytest.mark.heavy  # the browser takes some seconds of a processor
@pytest.mark.skipif(
    BROWSER is None, reason=f"no browser: none of {', '.join(NAMES)} is installed (Debian: chromium)"
)
def test_a_click_chooses_the_mode_that_moves(file, found):
    """The page in a browser: nothing complains, shapes move, stop, and follow click, list and slider."""
    sync_api = pytest.importorskip("playwright.sync_api", reason="playwright is not installed")
    with sync_api.sync_playwright() as player:
        browser = player.chromium.launch(executable_path=BROWSER, headless=True, args=["--no-sandbox"])
        page = browser.new_context(viewport={"width": 1400, "height": 1000}, offline=True).new_page()
        complaints, asked = [], []
        page.on("console", lambda line: complaints.append(line.text))
        page.on("pageerror", lambda error: complaints.append(str(error)))
        page.on("request", lambda request: asked.append(request.url))
        page.goto(file.as_uri())
        page.wait_for_function("document.documentElement.dataset.ready === 'true'", timeout=60_000)
        words = lambda: page.text_content(".shape-words")  # noqa: E731
        assert words().startswith(found.nearest().branch.label)
        drawn = "document.querySelector('.shape-picture .inner').getAttribute('d')"
        before = page.evaluate(drawn)
        page.wait_for_function(f"was => {drawn} !== was", arg=before)
        page.click(".shape-pause")
        assert page.text_content(".shape-pause") == "Move"
        # the axes' own scales say where a point of the axial mode is
        (k,) = [k for k, one in enumerate(found.branches) if one.name == "inner axial"]
        branch = found.branches[k]
        x, y = page.evaluate(
            """([rpm, f]) => {
                const plot = document.getElementById('plot-campbell');
                const { xaxis, yaxis } = plot._fullLayout;
                const box = plot.getBoundingClientRect();
                return [box.x + xaxis._offset + xaxis.d2p(rpm), box.y + yaxis._offset + yaxis.d2p(f)];
            }""",
            [float(branch.rpm[1]), float(branch.frequency[1])],
        )
        page.mouse.move(x, y)
        page.wait_for_selector("#plot-campbell .hoverlayer .hovertext")
        assert "inner axial" in page.text_content("#plot-campbell .hoverlayer")
        page.mouse.click(x, y)
        page.wait_for_function("document.querySelector('.shape-words').textContent.startsWith('inner axial')")
        assert f"at {branch.rpm[1]:,.0f} r/min" in words()
        assert page.input_value(".shape-mode") == str(k) and page.input_value(".shape-speed") == "1"
        chosen = "document.getElementById('plot-campbell').data.filter(t => t.meta?.part === 'chosen')"
        assert page.evaluate(f"{chosen}.map(t => [t.x[0], t.y[0]])") == [
            pytest.approx([branch.rpm[1], branch.frequency[1]], abs=0.1)
        ]
        # other colours: drawn again, the mark comes back, once
        page.click("#theme")
        page.wait_for_function(f"{chosen}.length === 1")
        page.select_option(".shape-mode", "0")
        assert words().startswith(found.branches[0].label)
        browser.close()
    assert complaints == []
    assert all(url.startswith(("file:", "data:", "blob:")) for url in asked)
