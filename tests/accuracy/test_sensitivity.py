"""Sensitivity to assumed values: none is forgotten, each can be moved, and moves show."""

import csv
import re

import pytest

from fmu_bearing.accuracy.sensitivity import ASSUMED, QUICK, sensitivity, value_at
from tests.conftest import EXAMPLES
from tests.marks import heavy_but

#: Order of a waviness whose amplitude is zero.
IDLE = {"imperfections.ball_waviness_order"}


def assumed_keys(name):
    """Keys that a scene file's comments call assumed, alone or by their table."""
    table, whole, keys = "", False, set()
    for line in (EXAMPLES / f"{name}.toml").read_text("utf-8").splitlines():
        code, _, remark = line.partition("#")
        word = re.search(r"\bassumed\b", remark) is not None
        if not code.strip():
            whole = "all assumed" in remark
        elif code.startswith("["):
            table, whole = code.strip().strip("[]"), whole or word
        elif word or whole:
            keys.add(f"{table}.{code.split('=')[0].strip()}")
    return keys - IDLE


@pytest.mark.parametrize("name", ["7003C-spindle", "7003C-bare", "7009C-full-ceramic"])
def test_no_assumed_value_is_forgotten(example, name):
    found = assumed_keys(name)
    assert len(found) > 25
    assert found <= set(ASSUMED)
    for key in found:
        assert value_at(example(name), key) is not None


@pytest.mark.parametrize("name", heavy_but(["7003C-spindle", "7009C-full-ceramic"], 0))
def test_every_move_changes_what_it_names(scene, name):
    whole = scene(name)
    given = {key for key in ASSUMED if value_at(whole, key) is not None}
    assert len(given) > 25  # as many as its file calls assumed
    for key in given:
        value = value_at(whole, key)
        moves = list(ASSUMED[key](value))
        assert any(moved != value for moved in moves), key
        for moved in moves:
            other = whole.replace({key: moved})
            assert value_at(other, key) == moved
            assert other.replace({key: value}) == whole


def test_moves_show(silent, tmp_path):
    study = sensitivity(silent, QUICK, warm_up=0.01, window=0.01)
    by_key = {}
    for row in study.rows:
        by_key.setdefault(row.key, []).append(row.changes)
    low, high = by_key["lubricant.traction_max"]
    assert low[4] < -0.02 and high[4] > 0.02  # less traction, less torque
    # Walther's slope is not in use under Vogel's law: the very same bits
    assert all(change[:6] == (0.0,) * 6 for change in by_key["lubricant.walther_slope"])
    study.write(tmp_path)
    with (tmp_path / "sensitivity.csv").open(encoding="utf-8") as file:
        read = list(csv.reader(file))
    assert read[0] == study.table()[0] and {len(line) for line in read} == {len(read[0])}
    assert "Numba" in (tmp_path / "sensitivity.md").read_text("utf-8")
