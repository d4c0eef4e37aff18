"""Shapes of modes in universal files are those of the shaft's line, and of the rings."""

import numpy as np
import pytest

from fmu_bearing import modes
from tests.conftest import EXAMPLES


def sets_of(path):
    """Lines of the datasets of a file by their number."""
    lines, found = path.read_text("ascii").splitlines(), []
    ends = [k for k, line in enumerate(lines) if line == "    -1"]
    for begin, end in zip(ends[::2], ends[1::2], strict=True):
        found.append((int(lines[begin + 1]), lines[begin + 2 : end]))
    return found


def numbers(line):
    return [float(line[k : k + 13]) for k in range(0, len(line), 13)]


def shape_of(lines):
    """Eigenvalue and amplitudes, shape (nodes, 3), of a dataset 55."""
    real, imaginary = numbers(lines[7])[:2]
    parts = np.array([numbers(line) for line in lines[9::2]])
    return complex(real, imaginary), parts[:, ::2] + 1j * parts[:, 1::2]


def test_a_set_has_the_line_of_its_shaft(tmp_path):
    found = modes(EXAMPLES.parent / "spindle_set" / "7003C-DB.toml")
    (_, units), (kind, nodes), *shapes = sets_of(found.save(tmp_path / "set.uff"))
    assert kind == 15 and units[0].split()[0] == "1"
    places = [float(line[40:53]) for line in nodes]
    bearings = found.linearised.shaft.positions
    # E13.5
    assert places[0] == 0.0 and all(np.abs(np.array(places) - place).min() < 1e-6 for place in bearings)
    assert len(shapes) == len(found.modes) and all(kind == 55 for kind, _ in shapes)
    for mode, (_, lines) in zip(found.modes, shapes, strict=True):
        value, motion = shape_of(lines)
        assert lines[0] == mode.label and value == pytest.approx(mode.value, rel=1e-5)
        assert abs(motion).max() == pytest.approx(1.0, abs=1e-5)
        across = found.line(mode, places)
        # up to one factor, where the shaft moves across at all
        k = np.unravel_index(np.argmax(abs(across)), across.shape)
        factor = motion[k[1], 1 + k[0]]
        assert motion[:, 1:].T == pytest.approx(factor * across, abs=2e-5)
    axial = next(shape_of(lines)[1] for mode, (_, lines) in zip(found.modes, shapes, strict=True)
                 if mode.name == "shaft axial")  # fmt: skip
    assert axial[:, 0] == pytest.approx(1.0, abs=1e-5)


def test_a_bearing_has_its_rings(tmp_path):
    found = modes(EXAMPLES / "7003C-bare.toml")
    _, (_, nodes), *shapes = sets_of(found.save(tmp_path / "one.uff"))
    assert len(nodes) == 2 and len(shapes) == len(found.modes)
    for mode, (_, lines) in zip(found.modes, shapes, strict=True):
        _, motion = shape_of(lines)
        own = found.shape(mode)
        rings = np.array([one[[0, 2, 3]] for one in (own.inner, own.outer)])
        largest = rings.ravel()[np.argmax(abs(rings))]
        assert motion == pytest.approx(rings / largest, abs=1e-5)
    # every other ending is that of all results
    assert found.save(tmp_path / "one.csv").read_text().startswith("frequency_Hz")
