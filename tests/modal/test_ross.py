"""Elements for ROSS 3: two planes, their errors, and the documented layout of the files."""

import dataclasses
import math
import tomllib

import numpy as np
import pytest

from fmu_bearing import stiffness
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import P, Q
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.steady.impedance import at_rest
from fmu_bearing.steady.stiffness.planes import errors, mirrored_matrix, planes

X, Y, Z, BY, BZ = range(5)


def table_of(*arguments, **options):
    """The table of a single bearing."""
    return stiffness(*arguments, **options).bearings[0]


def bearing(radial, tilt, coupling, axial=5e7, cross=0.0):
    """Stiffness matrix of equal ball loads."""
    k = np.diag([axial, radial, radial, tilt, tilt])
    k[Y, BZ] = k[BZ, Y] = coupling
    k[Z, BY] = k[BY, Z] = -coupling
    k[Y, Z], k[Z, Y] = cross, -cross
    return k


@pytest.fixture(scope="module")
def table(scene):
    """Five speeds and six frequencies."""
    spindle = scene("7003C-spindle").replace({"sound": None, "imperfections": None})
    return table_of(spindle, np.linspace(8e3, 28e3, 5), np.geomspace(50, 8e3, 6), preloads=[500.0, 800.0])


def test_planes_of_the_7003C(table):
    found = table.planes(500.0)
    # 4.89 and 2.27 mm by the specification, from a tilt stiffness of 4720 N m/rad, known to 0.3 %, which h^2
    # has 2.8 times
    assert 1e3 * found.centre == pytest.approx(-4.89, rel=3e-3)
    assert 1e3 * found.half == pytest.approx(2.27, rel=0.012)
    assert found.places == (found.centre + found.half, found.centre - found.half)


def test_two_planes_are_exact_where_they_stand_for_one_matrix():
    k = bearing(1.6e8, 4700.0, -7.9e5)
    np.testing.assert_allclose(planes(k).equivalent(k), k, rtol=1e-12, atol=1e-9)
    assert np.abs(errors(planes(k), k, k)).max() < 1e-12
    # cross-coupling of the radial motions takes its own tilt along, which is not the bearing's
    crossed = bearing(1.6e8, 4700.0, -7.9e5, cross=2e4)
    assert np.abs((planes(k).equivalent(crossed) - crossed)[:3, :3]).max() < 1e-6


def test_a_mirrored_bearing_has_its_planes_on_the_other_side():
    k = bearing(1.6e8, 4700.0, -7.9e5, cross=2e4)
    one, other = planes(k), planes(k, mirrored=True)
    assert other.centre == -one.centre > 0.0 and other.half == one.half
    assert planes(mirrored_matrix(k)) == other
    # reversed are the axis and the tilts; what the shaft's rotation does across it stays
    assert mirrored_matrix(k)[Y, Z] == k[Y, Z] and mirrored_matrix(k)[Y, BZ] == -k[Y, BZ]


def test_planes_that_cannot_be_are_refused():
    with pytest.raises(ValueError, match=r"tilt stiffness of 1000 N m/rad is less than the 3901 N m/rad"):
        planes(bearing(1.6e8, 1000.0, -7.9e5))
    with pytest.raises(ValueError, match="it has no radial stiffness"):
        planes(bearing(0.0, 1000.0, 0.0))


def test_errors_are_those_of_each_entry():
    k = bearing(1e8, 5e3, -5e5)
    found = planes(k)
    softer = bearing(1e8, 4e3, -4e5)  # this point needs other planes
    damped = bearing(50.0, 5e-3, -0.2)
    tilt, coupling, tilt_c, coupling_c = errors(found, softer, damped)
    assert tilt == pytest.approx(5e3 / 4e3 - 1.0) and coupling == pytest.approx(5e5 / 4e5 - 1.0)
    square = found.centre**2 + found.half**2
    assert tilt_c == pytest.approx(50.0 * square / 5e-3 - 1.0)
    assert coupling_c == pytest.approx(50.0 * found.centre / -0.2 - 1.0)


def test_errors_over_the_table(table):
    off = table.plane_errors(500.0)
    assert off.shape == (5, 6, 4)
    # planes of the matrix at rest: 1 % of tilt and coupling stiffness; dampers would need other planes
    assert np.abs(off[..., :2]).max() < 0.02
    assert np.abs(off[..., 2]).max() > 0.2


@pytest.mark.parametrize(("whole", "hertz"), [(False, 4196.0), (True, 4218.0)])
def test_tilt_counts_in_the_spindle(scene, whole, hertz):
    """Radial mode of the inner ring by the specification, with radial stiffness alone and with all of it."""
    system = linearised(scene("7003C-spindle").replace({"sound": None}))
    (one,) = system.bearings
    p, masses = one.arrays.p, one.coordinates.masses[one.coordinates.ring_rates :]
    rows = [Q.Y, Q.INNER_BZ, Q.OUTER + Q.Y, Q.OUTER + Q.BZ]
    inertia = masses[rows]
    inertia[[0, 2]] += 0.5 * p[P.BALLS] * p[P.BALL_MASS]  # balls follow half of each ring
    k = at_rest(one)
    k = planes(k).equivalent(k) if whole else np.diag([0.0, k[Y, Y], 0.0, 0.0, 0.0])
    pair, pedestal = k[np.ix_([Y, BZ], [Y, BZ])], system.on_pedestal[1]
    found = np.block([[pair, -pair], [-pair, pair]])
    found += np.diag([0.0, p[P.TILT_STIFFNESS], pedestal, pedestal * p[P.ROTATIONAL_RATIO]])
    highest = math.sqrt(np.linalg.eigvals(found / inertia[:, None]).real.max()) / (2.0 * math.pi)
    assert highest == pytest.approx(hertz, rel=1e-3)  # where half of the balls' mass is put counts 3e-4


def test_layout_is_that_of_ross(table, tmp_path):
    """By what ROSS 3.1.0 saves: one table per file, names of arguments, K[speed, frequency] in SI units."""
    files = table.to_ross(tmp_path / "front.toml", 800.0, nodes=(3, 5))
    assert [file.name for file in files] == ["front-1.toml", "front-2.toml"]
    for part, file in enumerate(files, 1):
        text = file.read_text(encoding="utf-8")
        assert "ROSS 3.1.0; release 2 cannot read it" in text and "preload 800 N" in text
        ((section, element),) = tomllib.loads(text).items()
        assert section == f"BearingElement_7003C {part} of 2" == f"BearingElement_{element['tag']}"
        assert element["n"] == (3, 5)[part - 1]
        coefficients = {f"{letter}{pair}" for letter in "kc" for pair in ("xx", "xy", "yx", "yy", "zz")}
        assert set(element) == coefficients | {"tag", "n", "speed", "frequency"}
        np.testing.assert_array_equal(element["speed"], table.speeds * RPM)
        np.testing.assert_array_equal(element["frequency"], 2.0 * math.pi * table.frequencies)
        assert (np.diff(element["speed"]) > 0.0).all() and (np.diff(element["frequency"]) > 0.0).all()
        for letter, matrix in (("k", table.K[:, 1]), ("c", table.C[:, 1])):
            # x, y, z of ROSS are Y, Z, X
            for pair, (i, j) in {
                "xx": (Y, Y),
                "xy": (Y, Z),
                "yx": (Z, Y),
                "yy": (Z, Z),
                "zz": (X, X),
            }.items():
                np.testing.assert_array_equal(element[letter + pair], 0.5 * matrix[..., i, j])


def test_axes_of_one_value_are_left_out(table, tmp_path):
    one = dataclasses.replace(
        table, frequencies=table.frequencies[:1], K=table.K[:, :, :1], C=table.C[:, :, :1]
    )
    element = next(iter(tomllib.loads(one.to_ross(tmp_path / "a.toml", 500.0)[0].read_text()).values()))
    assert "frequency" not in element and np.shape(element["kxx"]) == (5,)
    point = dataclasses.replace(one, speeds=one.speeds[:1], K=one.K[:1], C=one.C[:1])
    element = next(iter(tomllib.loads(point.to_ross(tmp_path / "b.toml", 500.0)[0].read_text()).values()))
    assert "speed" not in element and element["kxx"] == 0.5 * point.K[0, 0, 0, Y, Y]


def test_short_axes_and_other_endings_are_refused(table, tmp_path):
    few = dataclasses.replace(table, speeds=table.speeds[:3], K=table.K[:3], C=table.C[:3])
    with pytest.raises(ValueError, match="3 speeds are refused: ROSS interpolates between at least 5"):
        few.to_ross(tmp_path / "a.toml", 500.0)
    with pytest.raises(ValueError, match=r"elements for ROSS are written as \.toml"):
        table.to_ross(tmp_path / "a.json", 500.0)
    assert not list(tmp_path.iterdir())
