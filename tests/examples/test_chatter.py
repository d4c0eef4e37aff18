"""An FMU with a cutting force, in short: stable below the limit of `lobes`, chatter above it."""

import csv
import subprocess
import sys

import numpy as np
import pytest

from tests.conftest import ROOT

MILLING = ROOT / "examples" / "milling"


@pytest.fixture
def chatter():
    """The example's module, imported as its script imports its neighbours."""
    sys.path.insert(0, str(MILLING))
    import chatter

    yield chatter
    sys.path.remove(str(MILLING))
    del sys.modules["chatter"]


@pytest.mark.heavy
def test_it_dies_below_the_limit_and_grows_above(tmp_path):
    command = [sys.executable, str(MILLING / "chatter.py"), "--short", "--output", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    with (tmp_path / "chatter.csv").open(newline="", encoding="utf-8") as file:
        below, above = csv.DictReader(file)
    assert (tmp_path / "chatter.png").stat().st_size > 20_000
    for row, grows in ((below, False), (above, True)):
        middle, last = float(row["middle_third"]), float(row["last_third"])
        assert last > 1.5 * middle if grows else last < 0.7 * middle, row
    named = float(done.stdout.split("chatters at ")[1].split(" Hz")[0])
    assert float(above["frequency_Hz"]) == pytest.approx(named, rel=0.02)


def test_teeth_cut_what_the_feed_brings_and_leave_their_waves(chatter):
    """A tip at rest: each tooth cuts the feed times sin p; one that springs back leaves the cut."""
    scene = chatter.read_scene(chatter.SCENE).replace({"milling.radial_immersion": 1.0})
    teeth = chatter.Teeth(scene, 1e-3)
    total = np.zeros(2)
    for step in range(2 * chatter.STEPS):
        total = teeth.force(step, np.zeros(2))
    # two of four teeth are in the slot: sin^2 + cos^2 of their angles; directions as of the mean
    expected = teeth.stiffness * chatter.FEED
    across = teeth.axes @ total
    assert across[0] == pytest.approx(-teeth.ratio * expected, rel=1e-9)
    assert across[1] == pytest.approx(expected, rel=1e-9)
    # a tip that springs back by more than the feed leaves the cut
    assert not teeth.force(2 * chatter.STEPS, teeth.axes.T @ np.array([-1e-3, -1e-3])).any()
