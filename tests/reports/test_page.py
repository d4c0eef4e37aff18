"""The page as a file: whole, offline, honest about what it lacks; and the errors of making it."""

import math
import re
import sys

import numpy as np
import pytest
from plotly.offline import get_plotlyjs

from fmu_bearing.extras import MissingExtra
from fmu_bearing.recording.record import Recording, record
from fmu_bearing.reports import make, report
from fmu_bearing.reports.data.observed_run import observed
from fmu_bearing.reports.data.subject import Subject
from fmu_bearing.reports.page.blocks import Section, Table
from fmu_bearing.reports.page.render import POLICY, _code, render
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import GATES
from tests.reports.reading import Page

LARGEST = 3e6  # bytes


def test_nothing_is_loaded_from_elsewhere(full_page, full_report):
    assert full_report.size < LARGEST
    assert full_page.addresses and all(a.startswith(("#", "data:")) for a in full_page.addresses)
    style = re.search(r"<style>(.*?)</style>", full_page.text, re.S)[1]
    assert "url(" not in style and "@import" not in style
    assert (
        POLICY.startswith("default-src 'none'")
        and "http" not in POLICY
        and "Content-Security-Policy" in full_page.text
    )


def test_the_library_is_in_the_page_once_and_unchanged(full_page):
    """All Plotly needs in one text: of 4.9 MB in three kinds of charts no smaller bundle has all."""
    (library,) = full_page.libraries
    assert library == get_plotlyjs() and library not in full_page.text
    kinds = {trace["type"] for figure in full_page.figures.values() for trace in figure["data"]}
    assert {"scatter", "scatterpolar", "heatmap", "surface"} <= kinds


@pytest.mark.heavy  # a run of half a second and all its sections: 25 s of CPU
def test_half_a_second_at_four_microphones_takes_less_than_three_megabytes(scene, tmp_path):
    """The page of the example scene, sounds and all: 7.8 MB before figures and library were packed."""
    found = observed(with_fidelity(scene("7003C-spindle"), model="rings"), 0.5, settle=0.02)[0]
    made = make(found, tmp_path / "spindle.html", changes=False)
    page = Page(made.path)
    assert made.size < LARGEST and len(page.sounds) == 4
    whole = Subject(found, found.radiation_model)
    velocity = 1e3 * whole.output("inner_ring.velocity.z")
    before, last = [t for t in page.traces("velocity-time", body="inner_ring") if t["name"].startswith("z")]
    shown = len(last["y"])
    assert shown >= 10.0 * whole.turn / whole.step - 1.0
    assert last["y"] == pytest.approx(velocity[-shown:], rel=2e-5)
    # peaks of each column of pixels are exact, and where the thinning ends is said
    assert before["y"].max() == pytest.approx(velocity[:-shown].max(), rel=2e-5)
    assert before["y"].min() == pytest.approx(velocity[:-shown].min(), rel=2e-5)
    span = round(2.0 * before["dx"] / last["dx"])
    columns = velocity[:-shown].reshape(-1, span)
    assert len(before["y"]) == 2 * len(columns) <= 2000
    assert before["y"].reshape(-1, 2).max(axis=1) == pytest.approx(columns.max(axis=1), rel=2e-5)
    assert before["y"].reshape(-1, 2).min(axis=1) == pytest.approx(columns.min(axis=1), rel=2e-5)
    edge = float(whole.time[0]) + (len(velocity) - shown) * whole.step
    assert f"from {edge:.4g} s on. Before that, the smallest and the largest of each" in page.text
    assert before["x0"] + before["dx"] * len(before["y"]) == pytest.approx(last["x0"], abs=1e-9)


def test_the_page_is_in_order(full_page, full_report):
    assert set(full_report.sections.values()) == {""}
    assert len(set(full_page.ids)) == len(full_page.ids)
    levels = [depth for depth, _ in full_page.headings]
    assert levels[0] == 1 and levels.count(1) == 1
    assert all(later - earlier <= 1 for earlier, later in zip(levels, levels[1:], strict=False))
    assert all(figure["data"] for figure in full_page.figures.values()) and len(full_page.figures) >= 12
    assert {f"#{key}" for key in full_report.sections} <= set(full_page.addresses)


def test_what_is_said_is_said_to_the_end(full, full_page):
    summary, conditions = full_page.sections["summary"], full_page.sections["conditions"]
    part = max(full.partial().items(), key=lambda item: full.mean_square(item[1], "A").max())[0]
    assert f"the {part.replace('_', ' ')} is loudest (" in summary and "dB(A) alone), then the" in summary
    assert "Its strongest line is at" in summary and "ka = 0.5" in summary
    assert "None" not in conditions and "waviness orders from 2 to " in conditions
    assert "5 strips per contact" in conditions and "% from the balls." in conditions
    assert "7003C at 20,000 r/min, preload 500 N" in full_page.text


def test_names_of_commands_are_set_as_code(full_page):
    assert _code("as `info` & <b> have it") == "as <code>info</code> &amp; &lt;b&gt; have it"
    words = re.sub(r"<(pre|script|style)\b.*?</\1>", "", full_page.text, flags=re.DOTALL)
    assert "`" not in words and "<code>info</code>" in words


def test_scales_of_velocity_have_powers_and_toolbars_lie_on_no_axis(full_page):
    """Plotly's own prefixes say 100u before mm/s; beside a scale of colours the toolbar is on top."""
    axis = full_page.figures["velocity-spectrum"]["layout"]["yaxis"]
    assert (axis["type"], axis["exponentformat"], axis["dtick"]) == ("log", "power", 1)
    scaled = [
        figure["layout"]
        for figure in full_page.figures.values()
        if any("colorbar" in trace for trace in figure["data"])
    ]
    assert len(scaled) >= 2 and all(layout["modebar"]["orientation"] == "h" for layout in scaled)


@pytest.mark.heavy
@pytest.mark.usefixtures("brief")
def test_assumed_values_carry_the_files_remarks(tmp_path):
    made = make(
        GATES / "7003C-bare.toml", tmp_path / "a.html",
        duration=0.02, settle=0.0, radiation_model="compact", changes=False,
    )  # fmt: skip
    page = Page(made.path)
    (caption,) = [caption for caption in page.tables if caption.endswith("values are assumed")]
    rows = {row[0]: row for row in page.tables[caption][1:]}
    assert caption.startswith(f"{len(rows)} of ")
    assert rows["bearing.inner_ring_outer_diameter_mm"][5] == "effective, for the ring's mass"
    assert "bearing.bore_mm" not in rows
    assert any("turns of the cage" in warning for warning in made.warnings)


@pytest.mark.heavy
@pytest.mark.usefixtures("brief")
def test_fidelity_rings_says_what_does_not_move(rings, tmp_path):
    page = Page(report(rings, tmp_path / "rings.html", changes=False))
    assert {t["meta"]["orbit"] for t in page.traces("orbits")} == {"inner_ring", "outer_ring"}
    for section in ("velocities", "orbits"):
        assert "Fidelity full computes the motion of cage and balls" in page.sections[section]
    assert "With fidelity rings, torque and heats" in page.sections["friction"]
    assert "cage" not in {row[0] for row in page.tables["Velocity of the centres about its mean, mm/s"]}
    assert "many of these was measured" not in page.text
    assert any("values that the papers leave open" in caption for caption in page.tables)
    # the housing moves against the inner ring's shaft or not: the sentence follows the levels
    summary, table = page.sections["summary"], page.tables["Equivalent levels re 20 uPa"]
    loudest = max(table[1:], key=lambda row: float(row[3]))
    assert loudest[table[0].index("cage, dB(A)")] == "-"  # it does not move, so it is silent
    parts = [float(cell) for cell in loudest[4:] if cell != "-"]
    cancels = max(parts) > float(loudest[3]) + 1.0
    assert ("in phase opposition" in summary) == cancels


def test_pressures_of_an_fmu_alone(tmp_path):
    """No scene, no channels: what can be shown is shown, the rest says why."""
    rate, size = 51_200.0, 5120
    time = np.arange(size) / rate
    tone = 0.02 * math.sqrt(2) * np.sin(2 * np.pi * 1000.0 * time)
    recording = Recording(
        None, "recorded", rate, 0.0, size, time, np.full(size, math.nan), {}, recorded=tone[None],
        microphones=(("mic[1].pressure", (math.nan,) * 3),),
    )  # fmt: skip
    with pytest.raises(ValueError, match='radiation_model = "compact".*pressures only.*give the scene'):
        make(recording, tmp_path / "other.html", radiation_model="compact")
    made = make(recording, tmp_path / "fmu.html")
    page = Page(made.path)
    missing = {key for key, reason in made.sections.items() if reason}
    assert missing == {
        "conditions",
        "directivity",
        "velocities",
        "orbits",
        "error-motion",
        "contacts",
        "friction",
        "assumptions",
        "changes",
        "modes",
    }
    assert "does not know its scene" in made.sections["changes"]
    assert "which scene" in made.sections["conditions"] and "pressures" in made.sections["directivity"]
    assert "inner_ring.velocity.x" in made.sections["velocities"]
    assert float(page.tables["Equivalent levels re 20 uPa"][1][2]) == pytest.approx(60.0, abs=0.05)
    assert float(page.tables["Strongest lines at mic[1].pressure"][1][0]) == pytest.approx(1000.0, abs=1.0)


@pytest.mark.heavy
@pytest.mark.usefixtures("brief")
def test_a_recording_of_few_variables_and_a_papers_radiation_model(scene, tmp_path):
    rings = with_fidelity(scene("7003C-spindle"), model="rings")
    recording = record(rings, 0.03, radiation_model="paper", outputs=("inner_ring.velocity.x",))
    recording.outputs |= {
        f"inner_ring.velocity.{a}": recording.outputs["inner_ring.velocity.x"] for a in "yz"
    }
    made = make(recording, tmp_path / "paper.html", changes=False)
    page = Page(made.path)
    assert "velocity-time" in page.figures and "velocity-spectrum" not in page.figures
    assert "kept every 400 us" in page.sections["velocities"]
    assert "the same level in all directions" in made.sections["directivity"]
    assert "contact.inner.load_mean" in made.sections["contacts"]


@pytest.mark.heavy
@pytest.mark.usefixtures("brief")
def test_a_scene_without_microphones(rings, tmp_path):
    deaf = Recording(
        **{name: getattr(rings, name) for name in rings.__dataclass_fields__ if name != "_spectra"}
    )
    deaf.microphones = ()
    made = make(deaf, tmp_path / "deaf.html", changes=False)
    assert all("no microphones" in made.sections[key] for key in ("levels", "spectra", "audio", "waterfall"))
    assert made.sections["directivity"] == ""


def test_errors_name_the_way_out(rings, tmp_path, monkeypatch):
    page = tmp_path / "page.html"
    with pytest.raises(IsADirectoryError, match="is a folder: name the file to write"):
        make(rings, tmp_path)
    (tmp_path / "file").write_text("")
    with pytest.raises(OSError, match="name another folder"):
        make(rings, tmp_path / "file" / "page.html")
    (tmp_path / "bad.npz").write_bytes(b"nothing")
    with pytest.raises(ValueError, match="bad.npz: is not a recording"):
        make(tmp_path / "bad.npz", page)
    with pytest.raises(ValueError, match="cannot be changed"):
        make(rings, page, speed=100.0)
    with pytest.raises(ValueError, match="needs other channels"):
        make(rings, page, radiation_model="paper")
    with pytest.raises(ValueError, match="duration = 0"):
        make(rings, page, duration=0.0)
    with pytest.raises(ValueError, match="two speeds that differ"):
        make(rings, page, run_up=(100.0, 100.0))
    monkeypatch.setitem(sys.modules, "plotly", None)
    monkeypatch.setitem(sys.modules, "plotly.graph_objects", None)
    with pytest.raises(MissingExtra, match=r"fmu-bearing\[report\]"):
        make(rings, page)
    assert not page.exists()


def test_print_has_the_first_rows_of_a_long_table():
    """Crossings took 8 of 34 pages: 20 rows are printed, and how many more there are is said."""
    rows = [[str(k), "a"] for k in range(75)]
    page = render("a", "b", "c", [Section("s", "S", [Table("long", ["k", "v"], rows)])], [], [], [])
    assert page.count('<tr class="more">') == 55 and "55 more rows are on screen" in page
    printed = page[page.index("@media print") :]
    assert ".more { display: none; }" in printed and ".printed { display: block; }" in printed
    short = render("a", "b", "c", [Section("s", "S", [Table("short", ["k", "v"], rows[:60])])], [], [], [])
    assert 'class="more"' not in short and "on screen" not in short
