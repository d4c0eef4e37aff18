"""Elements for ROSS 3: three planes, their errors, and the documented layout of the files."""

import dataclasses
import math
import tomllib

import numpy as np
import pytest

from fmu_bearing import new_scene, read_scene, stiffness
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import P, Q
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.scene import read_scene_text
from fmu_bearing.steady.impedance import at_rest
from fmu_bearing.steady.stiffness.planes import (
    Planes,
    arm,
    errors,
    mirrored_matrix,
    plane_matrices,
    sum_of_planes,
)
from tests.conftest import ROOT

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
    assert found.places == (-found.a, 0.0, found.a) and found.K.shape == found.C.shape == (3, 5, 6, 3, 3)
    # by the specification e = 4.89 and h = 2.27 mm at 500 N, so a^2 = e^2 + h^2 at least; 800 N has more
    assert 5.39e-3 < found.a < 6.2e-3 and found.a == arm(table.static)
    assert table.planes(800.0).a == table.planes(800.0, mirrored=True).a == found.a
    alone = table_of(table.scene, table.speeds[:1], [1e3], preloads=[500.0])
    assert 1e3 * alone.planes().a == pytest.approx(5.4, abs=0.051)


@pytest.mark.parametrize("a", [1e-3, 5e-3, 0.02])
def test_three_planes_are_any_matrix_whose_coupling_is_mutual(a):
    k = bearing(1.6e8, 4700.0, -7.9e5, cross=2e4)
    k[Y, Y] *= 1.3
    k[BY, BZ], k[BZ, BY] = 31.0, -12.0
    # force from a tilt and moment from a displacement: R and L of (y, z) and (bz, -by) are the same
    k[Y, BY], k[BZ, Z], k[Z, BZ], k[BY, Y] = -700.0, 700.0, 300.0, -300.0
    held = plane_matrices(k, a)
    np.testing.assert_allclose(sum_of_planes(held, a), k, rtol=1e-11, atol=1e-6)
    np.testing.assert_array_equal(held[[0, 2], 0], 0.0)  # the axial stiffness is in the middle
    assert held[1, 0, 0] == k[X, X]


def test_at_rest_the_middle_plane_is_empty_and_the_others_push_back():
    k = bearing(1.6e8, 4700.0, -7.9e5)
    a = math.sqrt(4700.0 / 1.6e8)
    assert arm(k) == pytest.approx(a, abs=1e-4) and arm(k) >= a
    held = plane_matrices(k, a)
    assert abs(held[1, 1, 1]) < 1e-6 and held[:, 1, 1].sum() == pytest.approx(1.6e8)
    assert held[0, 1, 1] > held[2, 1, 1] > 0.0  # the load centre is behind the balls
    assert arm(np.stack([k, bearing(1.6e8, 9000.0, -7.9e5)])) == arm(bearing(1.6e8, 9000.0, -7.9e5))


def test_a_mirrored_bearing_changes_its_planes_about():
    k = bearing(1.6e8, 4700.0, -7.9e5, cross=2e4)
    np.testing.assert_allclose(
        plane_matrices(mirrored_matrix(k), 5e-3), plane_matrices(k, 5e-3)[::-1], rtol=1e-12
    )
    # reversed are the axis and the tilts; what the shaft's rotation does across it stays
    assert mirrored_matrix(k)[Y, Z] == k[Y, Z] and mirrored_matrix(k)[Y, BZ] == -k[Y, BZ]


@pytest.mark.parametrize(("radial", "tilt"), [(0.0, 1000.0), (1e8, 0.0), (-1.0, 10.0)])
def test_planes_that_cannot_be_are_refused(radial, tilt):
    with pytest.raises(ValueError, match="it has no radial or no tilt stiffness at rest"):
        arm(bearing(radial, tilt, 0.0))


def test_errors_are_what_springs_cannot_have():
    k, c = bearing(1e8, 5e3, -5e5), bearing(50.0, 5e-3, -0.2, axial=20.0)
    k[Y, BZ] *= 1.02  # the moment from a displacement is less
    c[Z, BY] *= 0.9
    k[X, Z] = 1e6
    a, w = 5e-3, np.array([1e3])
    found = errors(Planes(a, plane_matrices(k[None], a), plane_matrices(c[None], a)), k[None], c[None], w)
    assert found.shape == (1, 3)
    same, coupling, axial = found[0]
    radial, tilt = abs(1e8 + 1e3 * 50.0j), abs(5e3 + 1e3 * 5e-3j)
    assert same < 1e-14
    assert coupling == pytest.approx(0.01 * 5e5 / math.sqrt(radial * tilt), rel=1e-9)
    damped = errors(
        Planes(a, plane_matrices(k[None], a), plane_matrices(c[None], a)), k[None], c[None], 1e6 * w
    )
    size = math.sqrt(abs(1e8 + 1e9 * 50.0j) * abs(5e3 + 1e9 * 5e-3j))
    assert damped[0, 1] == pytest.approx(1e9 * 0.05 * 0.2 / size, rel=1e-6)
    assert axial == pytest.approx(1e6 / math.sqrt(abs(5e7 + 20.0e3j) * radial), rel=1e-9)


def test_errors_over_the_table(table):
    off = table.plane_errors(500.0)
    assert off.shape == (5, 6, 3)
    assert off[..., 0].max() < 1e-12  # rounding
    assert 1e-5 < off[..., 1].max() < 1e-3 and off[..., 2].max() < 0.03


def halves(matrix, static):
    """Tilt stiffness of two halves of the radial one in the planes e + h and e - h that are right at rest.

    K_r (e^2 + h^2), with e = W / R and e^2 + h^2 = T / R at rest.
    """
    return matrix[..., Y, Y] * static[BZ, BZ] / static[Y, Y]


#: Rows of the page: a scene or a bearing of the catalogue, speeds (r/min), preloads (N).
ROWS = {
    "7003C-bare": ([5e3, 15e3, 25e3], [100.0, 300.0, 1000.0]),
    "7003C-spindle": ([5e3, 15e3, 25e3], [100.0, 300.0, 1000.0]),
    "7009C-steel": ([3e3, 9e3, 18e3], [100.0, 350.0, 1000.0]),
    "NSK-7010AC": ([3e3, 9e3, 15e3], [100.0, 250.0, 1000.0]),
    "NSK-7014AC": ([3e3, 9e3, 12e3], [150.0, 500.0, 1500.0]),
}


@pytest.mark.pages
@pytest.mark.parametrize("name", ROWS)
def test_the_page_says_what_halves_missed_and_what_is_left(name):
    """The table of docs/stiffness.md: tilt by two halves and by three planes, then what no planes have, %."""
    speeds, preloads = ROWS[name]
    if name.startswith("NSK"):
        text = new_scene(name, name, kind="steel", speed_rpm=speeds[1], preload_N=preloads[1], sound=False)
        scene = read_scene_text(text, name, ROOT)
    else:
        scene = read_scene(ROOT / "examples" / "scenes" / f"{name}.toml")
    found = table_of(scene, speeds, [50.0, *np.linspace(500.0, 5000.0, 10)], preloads=preloads)
    z, before = found.impedance, 0.0
    for k in range(len(preloads)):
        tilt = z[:, k, :, BZ, BZ]
        before = max(before, float(np.abs(halves(z[:, k], found.static[1, k]) / tilt - 1.0).max()))
    off = np.stack([found.plane_errors(load) for load in preloads]).max(axis=(0, 1, 2))
    assert off[0] < 1e-12
    cells = [f"{float(f'{100.0 * value:.2g}'):g}" for value in (before, *off[1:])]
    span = [f"{one[0]:,.0f} to {one[-1]:,.0f}" for one in (speeds, preloads)]
    row = f"| {name} | {' | '.join(span)} | {cells[0]} | 1e-10 | {' | '.join(cells[1:])} |"
    assert row in (ROOT / "docs" / "stiffness.md").read_text(encoding="utf-8")


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
    k = sum_of_planes(plane_matrices(k, arm(k)), arm(k)) if whole else np.diag([0.0, k[Y, Y], 0.0, 0.0, 0.0])
    pair, pedestal = k[np.ix_([Y, BZ], [Y, BZ])], system.on_pedestal[1]
    found = np.block([[pair, -pair], [-pair, pair]])
    found += np.diag([0.0, p[P.SUPPORT_STIFFNESS + Q.INNER_BY], pedestal, pedestal * p[P.ROTATIONAL_RATIO]])
    highest = math.sqrt(np.linalg.eigvals(found / inertia[:, None]).real.max()) / (2.0 * math.pi)
    assert highest == pytest.approx(hertz, rel=1e-3)  # where half of the balls' mass is put counts 3e-4


def test_layout_is_that_of_ross(table, tmp_path):
    """By what ROSS 3.1.0 saves: one table per file, names of arguments, K[speed, frequency] in SI units."""
    files = table.to_ross(tmp_path / "front.toml", 800.0, nodes=(3, 5, 6))
    assert [file.name for file in files] == ["front-1.toml", "front-2.toml", "front-3.toml"]
    planes = table.planes(800.0)
    for part, file in enumerate(files, 1):
        text = file.read_text(encoding="utf-8")
        assert "ROSS 3.1.0; release 2 cannot read it" in text and "preload 800 N" in text
        ((section, element),) = tomllib.loads(text).items()
        assert section == f"BearingElement_7003C {part} of 3" == f"BearingElement_{element['tag']}"
        assert element["n"] == (3, 5, 6)[part - 1]
        coefficients = {f"{letter}{pair}" for letter in "kc" for pair in ("xx", "xy", "yx", "yy", "zz")}
        assert set(element) == coefficients | {"tag", "n", "speed", "frequency"}
        np.testing.assert_array_equal(element["speed"], table.speeds * RPM)
        np.testing.assert_array_equal(element["frequency"], 2.0 * math.pi * table.frequencies)
        assert (np.diff(element["speed"]) > 0.0).all() and (np.diff(element["frequency"]) > 0.0).all()
        for letter, matrix in (("k", planes.K[part - 1]), ("c", planes.C[part - 1])):
            # x, y, z of ROSS are Y, Z, X
            for pair, (i, j) in {
                "xx": (Y, Y),
                "xy": (Y, Z),
                "yx": (Z, Y),
                "yy": (Z, Z),
                "zz": (X, X),
            }.items():
                np.testing.assert_array_equal(element[letter + pair], matrix[..., i, j])


def test_axes_of_one_value_are_left_out(table, tmp_path):
    one = dataclasses.replace(
        table, frequencies=table.frequencies[:1], K=table.K[:, :, :1], C=table.C[:, :, :1]
    )
    element = next(iter(tomllib.loads(one.to_ross(tmp_path / "a.toml", 500.0)[0].read_text()).values()))
    assert "frequency" not in element and np.shape(element["kxx"]) == (5,)
    point = dataclasses.replace(one, speeds=one.speeds[:1], K=one.K[:1], C=one.C[:1])
    element = next(iter(tomllib.loads(point.to_ross(tmp_path / "b.toml", 500.0)[0].read_text()).values()))
    assert "speed" not in element and element["kxx"] == point.planes(500.0).K[0, 0, 0, Y, Y]


def test_short_axes_and_other_endings_are_refused(table, tmp_path):
    few = dataclasses.replace(table, speeds=table.speeds[:3], K=table.K[:3], C=table.C[:3])
    with pytest.raises(ValueError, match="3 speeds are refused: ROSS interpolates between at least 5"):
        few.to_ross(tmp_path / "a.toml", 500.0)
    with pytest.raises(ValueError, match=r"an element for ROSS is written as \.toml"):
        table.to_ross(tmp_path / "a.json", 500.0)
    assert not list(tmp_path.iterdir())
