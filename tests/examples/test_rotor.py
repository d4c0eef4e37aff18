"""The rotor in ROSS: this side without it, the whole of it where it is there, and the result that is kept."""

import csv
import importlib.util
import math
import os
import subprocess
import sys

import numpy as np
import pytest

from fmu_bearing import stiffness
from tests.examples.conftest import ROOT

SCRIPT = ROOT / "examples" / "rotor" / "round_trip.py"
#: Command of a Python with ROSS 3, such as /path/to/environment/bin/python.
ROSS = os.environ.get("FMU_BEARING_ROSS")


def table_of(*arguments, **options):
    """The table of a single bearing."""
    return stiffness(*arguments, **options).bearings[0]


@pytest.fixture(scope="module")
def script():
    spec = importlib.util.spec_from_file_location("round_trip", SCRIPT)
    module = importlib.util.module_from_spec(spec)
    sys.modules["round_trip"] = module  # for its dataclass
    spec.loader.exec_module(module)
    yield module
    del sys.modules["round_trip"]


@pytest.fixture(scope="module")
def table(script):
    return table_of(script.SCENE, script.SPEEDS[[0, 2]], [100.0, 1000.0, 10000.0])


def test_nodes_stand_at_the_planes(script, table):
    nodes, planes = script.layout(table), table.planes()
    assert nodes.places == sorted(nodes.places) and len(set(nodes.places)) == len(nodes.places)
    front, rear = script.PLACES
    at = [centre + place for centre in script.PLACES for place in planes.places]
    np.testing.assert_allclose([nodes.places[k] for k in nodes.planes], at, rtol=1e-12)
    assert [nodes.places[k] for k in nodes.centres] == [front, rear]
    # load centres are between the planes, behind the balls of the first and ahead of those of the second
    loads = [nodes.places[k] for k in nodes.loads]
    assert at[0] < loads[0] < front and rear < loads[1] < at[5]
    # seats reach from plane to plane
    seats = [(nodes.places[k], nodes.places[k + 1]) for k in nodes.seats]
    assert seats[0][0] == at[0] and seats[-1][1] == at[5]
    assert sum(b - a for a, b in seats) == pytest.approx(4.0 * planes.a)


def test_a_rigid_body_on_its_bearings(script):
    """Axial and radial mode of a body held at one node by a bearing and its mirror image."""
    mass, size = 0.5, script.FREEDOMS
    shaft = {name: np.zeros((size, size)) for name in "KCG"}
    shaft["M"] = np.diag([mass] * 3 + [1e-3] * 3)
    one = table_of(script.SCENE, script.SPEEDS[[2]], [100.0, 1000.0, 10000.0])
    k, c = script.rotor(shaft, [0, 0], script.whole(one))
    w = 2.0 * math.pi * 1000.0  # a frequency of the table
    own = one.K[0, 0, 1]
    np.testing.assert_allclose(np.diag(k(w))[[2, 0, 1]], 2.0 * np.diag(own)[:3], rtol=1e-12)
    # three planes on rigid arms are the same: a row of a node's forces per plane, moved to the centre
    a, (stiff, _) = 5e-3, script.whole(one)[0]
    held = [k_and_c[0](w) for k_and_c in script.in_planes(one, a)[:3]]
    np.testing.assert_allclose(sum(held)[0, 0], stiff(w)[0, 0], rtol=1e-12)
    np.testing.assert_allclose(a**2 * (held[0] + held[2])[1, 1], stiff(w)[4, 4], rtol=1e-12)
    # tilt and radial motion do not couple: the mirror image takes that away
    assert abs(k(w)[0, 4]) < 1e-9 * own[1, 1]
    still = (lambda w: k(2.0 * math.pi * 1000.0)), (lambda w: c(2.0 * math.pi * 1000.0))
    found = script.modes(shaft, 0.0, *still, [1e3] * 5)
    expected = math.sqrt(2.0 * own[0, 0] / mass)
    assert min(abs(value / expected - 1.0) for value, _ in found) < 1e-3  # damped, 1 %


@pytest.mark.heavy
def test_a_python_without_ross_is_reported(script, tmp_path):
    command = [sys.executable, str(SCRIPT), "--ross", f"{sys.executable} -S", "-o", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert done.returncode == 1 and "failed" in done.stderr and not (tmp_path / "ross.md").exists()


def rows(path):
    with path.open(encoding="utf-8", newline="") as file:
        return list(csv.reader(file))[1:]


@pytest.mark.pages
def test_the_result_that_is_kept():
    page = (ROOT / "docs" / "results" / "ross.md").read_text(encoding="utf-8")
    assert "ROSS 3.1.0" in page and "reads the same again: True" in page
    found = rows(ROOT / "docs" / "results" / "ross.csv")
    assert len(found) == 28
    for seat, _, _, of_ross, _, planes, _, five, *_ in found:
        assert float(of_ross) == pytest.approx(float(planes), rel=1e-5)
        if seat == "rigid":  # the arms carry tilt to both planes
            assert float(of_ross) == pytest.approx(float(five), rel=5e-4)


@pytest.mark.skipif(ROSS is None, reason="FMU_BEARING_ROSS names no Python with ROSS 3")
def test_ross_gives_that_result(tmp_path):
    command = [sys.executable, str(SCRIPT), "--ross", str(ROSS), "-o", str(tmp_path)]
    done = subprocess.run(command, capture_output=True, text=True, timeout=600)
    assert done.returncode == 0, done.stderr
    assert "reads the same again: True" in done.stdout
    kept = rows(ROOT / "docs" / "results" / "ross.csv")
    for one, other in zip(rows(tmp_path / "ross.csv"), kept, strict=True):
        assert one[:3] == other[:3]
        np.testing.assert_allclose(
            [float(cell) for cell in one[3::2]], [float(cell) for cell in other[3::2]], rtol=1e-4
        )
