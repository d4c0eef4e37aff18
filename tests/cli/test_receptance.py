"""receptance: what it prints, writes and refuses."""

import pytest

from tests.conftest import EXAMPLES

QBC = EXAMPLES.parent / "spindle_set" / "7003C-QBC.toml"


def test_table_picture_and_numbers(run, tmp_path):
    out, picture = tmp_path / "g.csv", tmp_path / "g.png"
    words = ("--frequencies", "20:3000:299", "--preloads", "60,120", "--speeds", "10000")
    done = run("receptance", QBC, *words, "-o", out, "--plot", picture)
    assert done.exit_code == 0, done.output
    assert "7003C-QBC: the nose, from 20 Hz" in done.stdout and "cross" in done.stdout
    assert picture.stat().st_size > 20_000 and len(out.read_text("utf-8").splitlines()) == 1 + 2 * 299
    data = run("receptance", QBC, "--frequencies", "20:3000:299", "--json").data
    assert data["place"] == "nose" and len(data["real"][0][0]) == 299
    peak = next(one for one in data["peaks"] if one["direction"] == "y")
    # a cross term of 0.4 of the direct one: lobes of one direction alone would be wrong
    assert peak["frequency_Hz"] == pytest.approx(2320.0, abs=10.0) and peak["cross"] > 0.4


def test_it_is_written_for_modal_analysis_and_never_over_another_file(run, tmp_path):
    out = tmp_path / "g.uff"
    assert run("receptance", QBC, "--frequencies", "100:200:11", "-o", out).exit_code == 0
    again = run("receptance", QBC, "--frequencies", "100:200:11", "-o", out)
    assert again.exit_code == 2 and "there already" in again.stderr


@pytest.mark.parametrize(
    ("words", "why"),
    [
        (("--frequencies", "0:100:3"), "0 Hz is refused"),
        (("-o", "g.mat"), "a receptance"),
        (("--speeds", "1e6"), "--speeds 1e+06 r/min is refused"),
    ],
)
def test_what_is_refused(run, words, why, tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    done = run("receptance", QBC, *words)
    assert done.exit_code == 2 and why in done.stderr and not list(tmp_path.iterdir())
