"""Universal files: read back column by column as their description has them, and by pyuff."""

import json
import os
import shlex
import subprocess
from dataclasses import replace

import numpy as np
import pytest

from fmu_bearing import Run, simulate
from fmu_bearing.results.result import ResultError
from fmu_bearing.results.uff import Place, Shape, place_of, responses, signal, write_uff
from fmu_bearing.scene.read import with_fidelity

PYUFF = os.environ.get("FMU_BEARING_PYUFF")
RATE = 51_200.0
TIME = 0.1 + np.arange(25_601) / RATE  # half a second
PRESSURE = 0.02 * np.sin(2.0 * np.pi * 1234.5 * TIME)
FREQUENCY = np.linspace(20.0, 5000.0, 250)
OUTPUTS = (Place("nose y", "m", 3, "y"), Place("nose about z", "rad", 3, "tz"))
INPUTS = (Place("force y", "N", 3, "y"), Place("moment about z", "N.m", 3, "tz"))
NODES = {1: (0.0, 0.1, 0.2), 2: (-0.02, 0.0, 0.0), 3: (0.0, 0.0, 0.0)}
SHAPES = (
    Shape("shaft bending forward", -12.5 + 2000.0j, np.array([[0, 1, -1j], [0, 0.5, 0.25j], [0, -1, 0]])),
    Shape("axial", -3.0 + 900.0j, np.array([[1, 0, 0], [1, 0, 0], [-0.5, 0, 0]])),
)
#: What pyuff reads, as JSON: complex numbers as real and imaginary parts, one after the other.
SCRIPT = """
import json, sys
import numpy as np
import pyuff

def plain(value):
    if isinstance(value, (np.ndarray, list)):
        return np.ascontiguousarray(value).astype(complex).view(float).tolist()
    return [value.real, value.imag] if isinstance(value, complex) else value

sets = pyuff.UFF(sys.argv[1]).read_sets()
print(json.dumps([{key: plain(value) for key, value in one.items()} for one in sets]))
"""


def matrix():
    """Receptances, in m/N and so on, of two modes, shape (frequencies, outputs, inputs)."""
    s = 2j * np.pi * FREQUENCY
    parts = [np.outer(v, v)[None] / (s**2 + 60.0 * s + w**2)[:, None, None]
             for v, w in (((1.0, -20.0), 5e3), ((0.5, 35.0), 2e4))]  # fmt: skip
    return sum(parts)


@pytest.fixture(scope="module")
def file(tmp_path_factory):
    contents = [
        signal(Place("P1", "Pa", 1), TIME, PRESSURE),
        signal(Place("seat force", "N", 2, "z"), TIME[:10], np.arange(10.0)),
        *responses(FREQUENCY, matrix(), OUTPUTS, INPUTS),
        *SHAPES,
    ]
    return write_uff(tmp_path_factory.mktemp("uff") / "all.uff", contents, NODES, "7008C pair")


def sets_of(file):
    """Lines of each dataset by its number, in order."""
    lines, found = file.read_text("ascii").splitlines(), []
    ends = [k for k, line in enumerate(lines) if line == "    -1"]
    assert ends[0] == 0 and len(ends) % 2 == 0
    for begin, end in zip(ends[::2], ends[1::2], strict=True):
        found.append((int(lines[begin + 1]), lines[begin + 2 : end]))
    return found


def columns(line, *widths):
    """Fields of a line by their widths."""
    ends = np.cumsum(widths)
    return [line[end - width : end].strip() for width, end in zip(widths, ends, strict=True)]


def test_each_record_is_in_its_columns(file):
    sets = sets_of(file)
    assert [kind for kind, _ in sets] == [164, 15, 58, 58, 58, 58, 58, 58, 55, 55]
    assert all(len(line) <= 80 for _, lines in sets for line in lines)
    units = sets[0][1]
    assert columns(units[0], 10, 20, 10) == ["1", "SI: Meter (newton)", "2"]
    assert [float(one.replace("D", "e")) for one in " ".join(units[1:]).split()] == [1.0, 1.0, 1.0, 273.15]
    assert [columns(line, 10, 10, 10, 10, 13, 13, 13)[0] for line in sets[1][1]] == ["1", "2", "3"]
    head = sets[2][1]
    assert head[0] == "P1" and head[3] == "7008C pair" and all(head[:5])
    assert columns(head[5], 5, 10, 5, 10, 1, 10, 10, 4, 1, 10, 10, 4)[:8] == [
        "1",
        "0",
        "0",
        "0",
        "",
        "P1",
        "1",
        "0",
    ]
    kind, count, even, start, step, _ = columns(head[6], 10, 10, 10, 13, 13, 13)
    assert (kind, int(count), even) == ("4", TIME.size, "1")
    # the spacing is exact, so that the last of many samples is at its time
    assert (float(start), float(step)) == (0.1, 1.0 / RATE)
    assert columns(head[7], 10, 5, 5, 5, 1, 20, 1, 20) == ["17", "0", "0", "0", "", "Time", "", "s"]
    assert columns(head[8], 10, 5, 5, 5, 1, 20, 1, 20) == ["15", "-2", "1", "0", "", "P1", "", "Pa"]
    values = [float(line[k : k + 20]) for line in head[11:] for k in range(0, len(line), 20)]
    # 13 digits are written
    assert values == pytest.approx(PRESSURE, rel=1e-12, abs=1e-15)


def test_powers_of_units_tell_forces_from_moments_and_ways_from_angles(file):
    functions = [lines for kind, lines in sets_of(file) if kind == 58][2:]
    ends = [tuple(columns(line, 10, 5, 5)[:3] for line in lines[8:10]) for lines in functions]
    way, angle, force, moment = ["8", "1", "0"], ["8", "0", "0"], ["13", "0", "1"], ["13", "1", "1"]
    assert ends == [(way, force), (way, moment), (angle, force), (angle, moment)]
    dofs = [columns(lines[5], 5, 10, 5, 10, 1, 10, 10, 4, 1, 10, 10, 4) for lines in functions]
    assert [(one[0], one[7], one[11]) for one in dofs] == [
        ("4", "2", "2"), ("4", "2", "6"), ("4", "6", "2"), ("4", "6", "6"),
    ]  # fmt: skip


@pytest.mark.parametrize(
    ("time", "words"),
    [([0.0, 1.0, 1.9], "0.9 to 1 s apart"), ([0.0], "fewer than two"), ([1.0, 0.0], "-1 to")],
)
def test_what_has_no_even_spacing_is_refused(time, words):
    with pytest.raises(ValueError, match=f"the times are {words}.*evenly spaced"):
        signal(Place("a", "N"), time, time)


def test_other_endings_and_values_without_number_are_refused(tmp_path):
    with pytest.raises(ValueError, match="a universal file is written as .uff"):
        write_uff(tmp_path / "a.unv.txt", [])
    with pytest.raises(ValueError, match=r"mic\[1\].leq is not a number at all times"):
        signal(Place("mic[1].leq", "dB"), [0.0, 1.0], [np.nan, 60.0])


@pytest.mark.parametrize(
    ("name", "unit", "place"),
    [
        ("bearing[2].force.x", "N", (2, "x")), ("bearing[12].moment.y", "N.m", (12, "ty")),
        ("inner_ring.tilt.z", "rad", (0, "tz")), ("friction_torque", "N.m", (0, "")),
        ("ball[3].velocity.y", "m/s", (0, "y")), ("mic[1].pressure", "Pa", (0, "")),
    ],
)  # fmt: skip
def test_names_of_variables_say_where_and_which_way(name, unit, place):
    assert place_of(name, unit) == (name, unit, *place)


def test_a_run_is_written_with_its_units(scene, tmp_path):
    kept = ["outer_ring.velocity.z", "friction_torque"]
    run = simulate(with_fidelity(scene("7003C-bare"), model="rings"), 2e-3, step=1e-4, outputs=kept)
    functions = [lines for kind, lines in sets_of(run.save(tmp_path / "run.uff")) if kind == 58]
    assert [lines[0] for lines in functions] == kept
    units = [columns(lines[8], 10, 5, 5, 5, 1, 20, 1, 20)[-1] for lines in functions]
    assert units == ["m/s", "N.m"]
    for name, lines in zip(kept, functions, strict=True):
        values = [float(line[k : k + 20]) for line in lines[11:] for k in range(0, len(line), 20)]
        assert values == pytest.approx(run[name], rel=1e-12)
    with pytest.raises(ValueError, match="evenly spaced"):
        replace(run, table=run.table[[0, 1, 4]]).save(tmp_path / "uneven.uff")


def test_it_is_known_where_another_file_is_due(file):
    with pytest.raises(
        ResultError, match=r"all\.uff: .*a universal file \(\.uff\).*pyuff in Python reads it"
    ):
        Run.load(file)


@pytest.mark.skipif(PYUFF is None, reason="FMU_BEARING_PYUFF names no Python with pyuff 2.5")
def test_pyuff_reads_what_was_written(file):
    done = subprocess.run(
        [*shlex.split(str(PYUFF)), "-c", SCRIPT, file], capture_output=True, text=True, timeout=300
    )
    assert done.returncode == 0, done.stderr
    units, nodes, pressure, force, *others = json.loads(done.stdout)
    assert (units["units_code"], units["length"], units["force"], units["temp_offset"]) == (
        1,
        1.0,
        1.0,
        273.15,
    )
    assert np.array(nodes["z"])[::2] == pytest.approx([0.2, 0.0, 0.0])
    assert np.array(pressure["x"])[::2] == pytest.approx(TIME, abs=1e-9)
    assert np.array(pressure["data"])[::2] == pytest.approx(PRESSURE, rel=1e-12, abs=1e-15)
    assert (force["rsp_node"], force["rsp_dir"], force["ordinate_spec_data_type"]) == (2, 3, 13)
    found = np.array([one["data"] for one in others[:4]]).view(complex).T.reshape(-1, 2, 2)
    # 13 digits of numbers from 1e-9 to 1e-6
    assert found == pytest.approx(matrix(), rel=1e-11)
    for shape, one in zip(SHAPES, others[4:], strict=True):
        assert complex(*one["eig"]) == pytest.approx(shape.value, rel=1e-5)  # E13.5
        motion = np.array([one["r1"], one["r2"], one["r3"]]).view(complex).T
        assert motion == pytest.approx(shape.motion, abs=1e-5)
    assert [one["mode_n"] for one in others[4:]] == [1, 2]
