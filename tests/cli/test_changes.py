"""changes: choices of a designer on the command line."""

import pytest

from fmu_bearing.accuracy import changes as room
from fmu_bearing.accuracy.alternatives import Alternative
from fmu_bearing.accuracy.changes import changes


@pytest.fixture
def few(monkeypatch):
    chosen = [
        Alternative("preload", "preload 500 -> 350 N", {"mounting.preload_N": 350.0}),
        Alternative("preload", "too much", {"mounting.preload_N": 2e4}),
    ]
    monkeypatch.setattr(room, "alternatives", lambda scene: chosen)


def test_it_prints_what_the_function_returns(run, few, example_file):
    reported = run("changes", example_file, "--seeds", 2, "--json")
    assert reported.exit_code == 0, reported.output
    found = changes(example_file, seeds=2)
    first = reported.data["changes"][0]
    assert first["level_change_dB"] == pytest.approx(found.changes[0].level, abs=1e-9)
    assert first["life_h"] == pytest.approx(found.changes[0].after.life)
    assert reported.data["changes"][1]["reason"] and reported.data["changes"][1]["life_h"] is None
    assert "preload 500 -> 350 N" in reported.stderr  # progress


@pytest.mark.heavy
def test_its_table_fits_a_terminal(run, example_file, monkeypatch):
    monkeypatch.setenv("COLUMNS", "80")
    reported = run("changes", example_file, "--no-levels")
    assert reported.exit_code == 0 and max(map(len, reported.stdout.splitlines())) <= 80
    for words in ("preload 500 -> 29.8 N light", "L10r", "No levels", "ISO 16281", "radial stiffness"):
        assert words in reported.stdout


def test_what_is_refused_is_refused_in_one_line(run, example_file, tmp_path):
    assert run("changes", tmp_path / "none.toml").exit_code == 2
    reported = run("changes", example_file, "--seeds", 0)
    assert reported.exit_code == 2 and "seeds = 0" in reported.stderr
