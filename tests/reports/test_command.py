"""The command ``fmu-bearing report``."""

import json

import pytest
from typer.testing import CliRunner

from fmu_bearing.cli import app
from fmu_bearing.scene.read import with_fidelity
from tests.reports.reading import Page


def run(*arguments):
    return CliRunner().invoke(app, ["report", *(str(a) for a in arguments)])


@pytest.mark.usefixtures("brief")
def test_a_recording_becomes_a_page(rings, tmp_path):
    page, kept = tmp_path / "page.html", tmp_path / "run.npz"
    rings.save(kept)
    made = run(kept, "-o", page, "--title", "Try <1>", "--no-changes", "--json")
    assert made.exit_code == 0, made.output
    reported = json.loads(made.stdout)
    assert reported["bytes"] == page.stat().st_size
    assert Page(page).headings[0] == (1, "Try <1>") and "changes" not in reported["sections"]


@pytest.mark.heavy
@pytest.mark.usefixtures("brief")
def test_a_scene_at_another_speed_with_run_up_and_its_recording_again(scene, tmp_path):
    file, page, kept = tmp_path / "s.toml", tmp_path / "new" / "page.html", tmp_path / "run.npz"
    file.write_text(with_fidelity(scene("7003C-spindle"), model="rings").to_toml(), "utf-8")
    made = run(
        file, "-o", page, "--speed", 12_000, "--duration", 0.05, "--title", "Try <1>", "--keep", kept,
        "--run-up", "6000:12000", "--run-up-time", 0.2, "--no-changes", "--json",
    )  # fmt: skip
    assert made.exit_code == 0, made.output
    reported = json.loads(made.stdout)
    assert reported["figures"]["speed_rpm"] == pytest.approx(12_000)
    # 0.05 s are 10 revolutions
    assert set(reported["missing"]) == {"error-motion"}
    assert "error motion needs 20: run for 0.1 s or longer" in reported["missing"]["error-motion"]
    assert reported["bytes"] == page.stat().st_size
    read = Page(page)
    assert read.headings[0] == (1, "Try <1>")
    low, high = read.figures["waterfall"]["layout"]["yaxis"]["range"]
    assert 6000 < low < 7000 and 11_000 < high < 12_000  # blocks are named by their middles
    assert "from 6,000 to 12,000 r/min" in read.sections["waterfall"]
    assert "changes" not in reported["sections"] and "#changes" not in read.addresses
    again = run(kept, "-o", tmp_path / "again.html", "--no-changes", "--json")
    assert json.loads(again.stdout)["figures"] == pytest.approx(reported["figures"], nan_ok=True)


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["none.toml"], "there is no such scene file"),
        (["none.npz"], "there is no such file"),
        (["none.toml", "--run-up", "fast"], "5000:30000"),
        (["none.toml", "--duration", "-1"], "duration = -1"),
    ],
)
def test_refusals_take_one_line(arguments, words, tmp_path):
    reported = run(*arguments, "-o", tmp_path / "page.html")
    lines = reported.output.splitlines()
    assert reported.exit_code == 2 and words in lines[-1] and lines[-1].startswith("error: ")
    assert "Traceback" not in reported.output and not (tmp_path / "page.html").exists()
