"""lobes: what it prints, writes and refuses."""

import pytest

from tests.conftest import EXAMPLES

END_MILL = EXAMPLES.parent / "milling" / "7003C-QBC-end-mill.toml"
SHORT = ("--speeds", "16000:22000:25", "--frequencies", "600:3000:601")


@pytest.mark.heavy
def test_pockets_verdict_picture_and_numbers(run, tmp_path):
    out, picture = tmp_path / "l.csv", tmp_path / "l.png"
    done = run("lobes", END_MILL, *SHORT, "-o", out, "--plot", picture)
    assert done.exit_code == 0, done.output
    assert "deepest between lobes" in done.stdout
    assert "0.5 mm chatters: the limit at 18,000 r/min is" in " ".join(done.stdout.split())
    assert picture.stat().st_size > 20_000 and len(out.read_text("utf-8").splitlines()) == 26
    words = ("--set", "milling.depth_mm=0.05", "--set", "spindle.shaft.damping_ratio=0.02")
    data = run("lobes", END_MILL, *SHORT, *words, "--json").data
    assert data["judgement"] == "good" and data["depth_mm"] == pytest.approx(0.05)
    assert data["own"]["speed_rpm"] == 18000.0 and len(data["limits"]) == 25


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("--set", "milling.radial_immersion=0.1"), "= 0.1 is refused; allowed: 0.25 to 1"),
        (("--speeds", "-1000,1000"), "speeds are refused: give speeds of the sign"),
        (("-o", "l.uff"), "a table of lobes"),
    ],
)
def test_what_is_refused(run, words, why, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run("lobes", END_MILL, *words)
    assert done.exit_code == 2 and why in done.stderr and not list(tmp_path.iterdir())


def test_a_scene_without_a_cut_is_refused(run):
    done = run("lobes", EXAMPLES.parent / "spindle_set" / "7003C-DB.toml")
    assert done.exit_code == 2 and "there is no cut to judge: give [milling]" in done.stderr
