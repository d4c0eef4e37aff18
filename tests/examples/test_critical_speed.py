"""The sweep example in short: the ridge is where masses and springs put the mode, and moves with it."""

import csv
import subprocess
import sys

import pytest

from tests.examples.conftest import ROOT


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    out = tmp_path_factory.mktemp("critical")
    command = [sys.executable, str(ROOT / "examples" / "sweep" / "critical_speed.py")]
    command += ["--short", "--workers", "1", "--output-dir", str(out)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=300)
    assert done.returncode == 0, done.stderr
    return out


def rows(path):
    with path.open(encoding="utf-8", newline="") as file:
        return [[float(cell) for cell in row] for row in list(csv.reader(file))[1:]]


@pytest.mark.heavy
def test_the_ridge_moves_with_the_root_of_the_stiffness(folder):
    assert (folder / "sweep.png").stat().st_size > 10_000 and (folder / "sweep.md").exists()
    found = rows(folder / "sweep.csv")
    assert [row[0] for row in found] == [3.42e7, 7.1e7, 1.47e8]
    assert found[1][1] == pytest.approx(28000.0, rel=5e-3)  # what the scene's pedestal was chosen for
    for stiffness, mode, turn, *_ in found:
        # the balls are in series with it: 2.3 times as stiff as the scene's pedestal
        assert mode / found[1][1] == pytest.approx((stiffness / 7.1e7) ** 0.5, rel=7e-3)
        # points are 4,000 r/min apart, a parabola in between: within a third of the distance
        assert turn == pytest.approx(mode, abs=1300.0)


@pytest.mark.heavy
def test_the_committed_table_has_the_same_modes(folder):
    known = {row[0]: row[1] for row in rows(ROOT / "docs" / "results" / "sweep.csv")}
    for stiffness, mode, *_ in rows(folder / "sweep.csv"):
        assert known[stiffness] == pytest.approx(mode, rel=2e-4)  # stiffness of the balls at other speeds
