"""Stiffness and damping over speed, preload, frequency: gates, an independent way, symmetry, files."""

import csv
import dataclasses
import math
import re

import numpy as np
import pytest

from fmu_bearing import operating_point, stiffness
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import C, P, Q, S, U, Y as ROW
from fmu_bearing.instance import EngineError
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.steady.impedance import impedance, spaced
from fmu_bearing.steady.stiffness.stiffness_files import columns, unit
from tests.modal.energy import stiffness as energy_hessian
from tests.modal.orbit import along, circling

X, Y, Z, BY, BZ = range(5)


def table_of(*arguments, **options):
    """The table of a single bearing."""
    return stiffness(*arguments, **options).bearings[0]


@pytest.fixture(scope="module")
def spindle(scene):
    """The 7003C in its spindle without weight: equal ball loads."""
    return scene("7003C-spindle").replace(
        {"sound": None, "imperfections": None, "fidelity.terms.gravity": False}
    )


@pytest.fixture(scope="module")
def table(spindle):
    """Three speeds, three preloads, five frequencies."""
    return table_of(spindle, [5e3, 20e3, 28e3], [50, 200, 1e3, 3e3, 1e4], preloads=[200, 500, 1000])


@pytest.mark.parametrize("spacing", ["held", "free"])
def test_gate_of_the_7003C(spindle, spacing):
    # an independent program with all forces moving, 500 N, 20,000 r/min; 0.3 % by the specification
    k = table_of(spindle, [20e3], [1e3], spacing=spacing).K[0, 0, 0]
    assert k[X, X] == pytest.approx(5.563e7, rel=3e-3)
    assert k[Y, Y] == pytest.approx(1.623e8, rel=3e-3)
    assert k[BY, BY] == pytest.approx(4720.0, rel=3e-3)
    assert abs(k[Y, BZ]) == pytest.approx(7.94e5, rel=3e-3)


@pytest.mark.parametrize("name", ["7003C-spindle", "7009C-full-ceramic", "7003C-bare"])
@pytest.mark.parametrize("rpm", [-9000.0, 18e3])
def test_it_is_that_of_one_ball_in_orbiting_axes(scene, name, rpm):
    bare = scene(name).replace(
        {"sound": None, "imperfections": None, "fidelity.terms.gravity": False, "operation.speed_rpm": rpm,
         "mounting.radial_load_y_N": 0.0, "mounting.radial_load_z_N": 0.0, "mounting.flexure": None}
    )  # fmt: skip
    system = linearised(bare).bearings[0]
    assert system.equal_loads
    for w in 2.0 * math.pi * np.array([30.0, 700.0, 4e3, 15e3]):
        for spacing, matrix in (("free", system.matrix), ("held", spaced(system, system.matrix))):
            z = impedance(system, matrix, np.array([w]))[0]
            for way in (1, -1):
                expected = circling(system, w, way, spacing)
                found = np.array([[z[i, k] - 1j * way * z[i, k + 1] for k in (Y, BY)] for i in (Y, BY)])
                scale = np.sqrt(np.outer(abs(np.diag(expected)), abs(np.diag(expected))))
                # differences over a nanometre err by 1e-7 of a slope; losses are 1e-4 and more of it
                assert np.abs((found - expected) / scale).max() < 1e-6
            assert abs(z[X, X] - along(system, w)) < 1e-6 * abs(z[X, X])


def test_symmetry_under_axial_load(table):
    scale = np.sqrt(np.abs(np.diagonal(table.K, axis1=-2, axis2=-1)))
    scale = scale[..., :, None] * scale[..., None, :]
    w = 2.0 * math.pi * table.frequencies[:, None, None]
    for matrix in (table.K / scale, w * table.C / scale):
        # round the axis everything turns equally; differences of forces leave 1e-8
        for one, other in (((Y, Y), (Z, Z)), ((BY, BY), (BZ, BZ))):
            np.testing.assert_allclose(matrix[..., *one], matrix[..., *other], atol=1e-7)
        for one, other in (((Y, Z), (Z, Y)), ((BY, BZ), (BZ, BY)), ((Y, BZ), (Z, BY)), ((BZ, Y), (BY, Z))):
            np.testing.assert_allclose(matrix[..., *one], -matrix[..., *other], atol=1e-7)
        for i in (Y, Z, BY, BZ):  # a motion along the axis pushes nowhere else
            assert np.abs(matrix[..., X, i]).max() < 1e-7 and np.abs(matrix[..., i, X]).max() < 1e-7


def test_slow_motion_meets_the_stiffness_at_rest(spindle, table):
    slow = table_of(spindle, [20e3], [0.1], preloads=[200, 500, 1000])
    # the spin of the balls follows at 1e3 1/s here, K differs by the square of the ratio
    np.testing.assert_allclose(slow.K[0, :, 0], slow.static[0], rtol=1e-5, atol=1.0)
    np.testing.assert_array_equal(slow.static[0], table.static[1])
    # the balls' inertia is 1e-4 of it at 50 Hz, friction held or not 2e-3 on a bearing that carries this much
    assert table.against_static() < 1e-3
    for k, load in enumerate((200.0, 500.0, 1000.0)):
        arrays = linearised(spindle, {U.SPEED: 20e3 * RPM, U.PRELOAD: load}).bearings[0].arrays
        energy = np.diag(energy_hessian(arrays.p, arrays.s))
        np.testing.assert_allclose(np.diag(table.static[1, k]), energy, rtol=3e-3)


def test_a_light_load_at_speed_is_further_from_it(scene):
    light = scene("7009C-full-ceramic").replace(
        {"sound": None, "imperfections": None, "fidelity.terms.gravity": False}
    )
    found = table_of(light, [18e3], [0.1, 1e3], preloads=[175.0])
    arrays = linearised(light, {U.SPEED: 18e3 * RPM, U.PRELOAD: 175.0}).bearings[0].arrays
    # friction moves the balls with the ring; by the energy in the contacts there would be some per cent more
    off = np.diag(found.static[0, 0]) / np.diag(energy_hessian(arrays.p, arrays.s)) - 1.0
    assert 0.02 < np.abs(off).max() < 0.07
    assert not any("for frequency to 0" in line for line in found.cautions())
    faster = table_of(light, [18e3], [1e3], preloads=[175.0])
    # at 1 kHz spins do not follow any more
    assert faster.against_static() == pytest.approx(0.19, abs=0.01)
    assert any("K at 1000 Hz differs from K for frequency to 0" in line for line in faster.cautions())


@pytest.mark.parametrize(
    ("mode", "bends"), [("force", None), ("rigid", None), ("force", {"outer_ring": [2, 3]})]
)
def test_the_matrix_at_rest_is_that_of_the_operating_point(scene, mode, bends):
    known = scene("7003C-bare").replace({"mounting.preload_mode": mode, "mounting.flexure": bends})
    found = table_of(known, [12e3, 20e3], [500.0])
    np.testing.assert_array_equal(found.static[1, 0], operating_point(known).bearings[0].stiffness)
    assert found.static[0, 0, X, X] != found.static[1, 0, X, X]


@pytest.mark.heavy
@pytest.mark.parametrize("name", ["7009C-full-ceramic", "7009C-steel"])
def test_full_loaded_slowly_gives_way_by_the_matrix_at_rest(scene, name):
    """Ring and outer ring kept from tilting; the quasi-static matrix has 8 and 19 % more."""
    light = scene(name).replace(
        {
            "sound": None, "imperfections": None, "fidelity.terms.gravity": False,
            "operation.speed_rpm": 18e3, "mounting.preload_N": 350.0,
            "mounting.pedestal_stiffness_N_m": 1e11,
            "mounting.tilt_support": {"stiffness_N_m_rad": 1e6, "damping_ratio": 0.8},
        }
    )  # fmt: skip
    expected, force, places = operating_point(light).bearings[0].stiffness[Y, Y], 10.0, []
    for load in (force, -force):
        run = Arrays.of(light, CAGE=0.0)
        run.u[U.LOAD_Y] = load
        run.init()
        apart = []
        for _ in range(200):
            run.step(1e-3)
            body = run.s[S.Y + ROW.Q0 : S.Y + ROW.Q0 + Q.SIZE]
            apart.append(body[Q.Y] - body[Q.OUTER + Q.Y])
        places.append(np.mean(apart[50:]))
    # balls without a cage drift apart a little in 0.2 s: some per cent
    assert 2.0 * force / (places[0] - places[1]) == pytest.approx(expected, rel=0.03)


def test_a_constant_force_is_no_constant_place(spindle):
    warm = {"inner_ring_temperature": 293.15 + 20.0}
    cold, hot = (table_of(spindle, [20e3], [1e3], inputs=one).K[0, 0, 0] for one in ({}, warm))
    # the angle falls: -13 % and +7 % by the specification
    assert hot[X, X] / cold[X, X] - 1.0 == pytest.approx(-0.13, abs=0.01)
    assert hot[Y, Y] / cold[Y, Y] - 1.0 == pytest.approx(0.07, abs=0.01)
    # with rigid preload the load rises, and axial stiffness with it
    rigid = table_of(spindle.replace({"mounting.preload_mode": "rigid"}), [20e3], [1e3], inputs=warm)
    assert rigid.K[0, 0, 0, X, X] > 1.05 * hot[X, X] and rigid.K[0, 0, 0, Y, Y] > 1.02 * hot[Y, Y]


def test_rigid_preload_is_the_force_that_its_place_means(spindle):
    rigid = spindle.replace({"mounting.preload_mode": "rigid"})
    warm = {"inner_ring_temperature": 313.15}
    values = {U.SPEED: 20e3 * RPM, U.INNER_T: 313.15}
    arrays = linearised(rigid, values).bearings[0].arrays
    # what its place pushes the pedestal by
    force = arrays.s[S.Y + ROW.Q0 + Q.OUTER] * arrays.s[S.C + C.PEDESTAL_AXIAL]
    assert force > 550.0  # warmth presses what preload_N pressed with 500 N when cold
    one = table_of(rigid, [20e3], [300.0, 2e3], inputs=warm)
    other = table_of(spindle, [20e3], [300.0, 2e3], preloads=[force], inputs=warm)
    # the place is found to 1e-9 of the load
    np.testing.assert_allclose(one.K, other.K, rtol=1e-6, atol=1e-6 * np.abs(other.K[0, 0, 0, BY, BY]))
    assert one.K[0, 0, 0, X, X] > 1e7


def test_free_balls_bunch_at_the_frequency_of_their_orbit(spindle):
    f_c = table_of(spindle, [20e3], [1.0]).orbit[0, 0]
    assert f_c == pytest.approx(139.86, rel=1e-3)  # 0.4196 of the shaft
    around = f_c * np.array([0.5, 0.99, 1.01, 2.0, 20.0])
    held, free = (table_of(spindle, [20e3], around, spacing=one) for one in ("held", "free"))
    off = np.abs(free.K[0, 0, :, Y, Y] / held.K[0, 0, :, Y, Y] - 1.0)
    assert off[1] > 0.02 and off[2] > 0.02  # to both sides of a pole
    assert off[0] < 2e-3 and off[3] < 1e-3 and off[4] < 3e-4
    # smooth without it
    assert np.ptp(held.K[0, 0, :4, Y, Y]) < 1e-4 * held.K[0, 0, 0, Y, Y]
    assert any("bunch" in line for line in free.cautions())
    assert not any("bunch" in line for line in held.cautions())


def test_springs_between_balls_keep_them_apart(scene):
    found = linearised(scene("7003C-impact").replace({"sound": None})).bearings[0]
    if found.arrays.p[P.SPRINGS] == 0.0:
        pytest.skip("this scene has no springs between its balls")
    assert spaced(found, found.matrix) is found.matrix


def test_radial_load_is_a_mean_over_one_pitch(spindle):
    light, one, turned = (
        table_of(spindle, [20e3], [300.0, 3e3], inputs=load)
        for load in ({"radial_load.z": -300.0}, {"radial_load.z": -1e3}, {"radial_load.y": -1e3})
    )
    k = one.K[0, 0, 0]
    assert k[Z, Z] < 0.95 * k[Y, Y]  # balls opposite to the load carry little
    # while all of twelve balls carry load, their passing hardly shows
    assert light.spread[0, 0] < 1e-6
    assert 1e-3 < one.spread[0, 0] < 1e-2
    assert not any("single phases" in line for line in one.cautions())
    # a quarter of a turn maps twelve balls onto themselves
    np.testing.assert_allclose(turned.K[0, 0, 0, [Y, Z], [Y, Z]], k[[Z, Y], [Z, Y]], rtol=1e-6)
    more = dataclasses.replace(one, spread=np.array([[0.05]]))
    assert any("up to 5.0 %" in line for line in more.cautions())


def test_bending_rings_count_where_loads_are_unequal(scene):
    rigid = scene("7003C-bare").replace(
        {"sound": None, "imperfections": None, "fidelity.terms.gravity": False, "mounting.flexure": None}
    )
    bending = rigid.replace({"mounting.flexure": {"outer_ring": [2, 3], "inner_ring": [2]}})
    one, other = (table_of(each, [10e3], [500.0]) for each in (rigid, bending))
    # round equal loads a motion of the ring has no share in orders 2 and more
    np.testing.assert_allclose(other.K[0, 0, 0, Y, Y], one.K[0, 0, 0, Y, Y], rtol=1e-7)
    np.testing.assert_allclose(one.static, other.static, rtol=1e-6, atol=1.0)
    assert any("bending of the rings" in line for line in other.cautions())
    load = {"radial_load.z": -600.0}
    one, other = (table_of(each, [10e3], [500.0], inputs=load) for each in (rigid, bending))
    assert other.K[0, 0, 0, Z, Z] < 0.999 * one.K[0, 0, 0, Z, Z]


def synthetic(table, k, c):
    """A table of one point at 100 rad/s with given matrices."""
    frequency = np.array([100.0 / (2.0 * math.pi)])
    shape = (1, 1, 1, 5, 5)
    return dataclasses.replace(
        table, speeds=np.array([1000.0]), preloads=np.array([100.0]), frequencies=frequency,
        K=np.broadcast_to(k, shape), C=np.broadcast_to(c, shape), static=np.broadcast_to(k, shape[1:]),
        orbit=np.array([[7.0]]), spread=np.zeros((1, 1)),
    )  # fmt: skip


def test_losses_are_those_of_springs_and_dampers(table):
    k = np.diag([4.0, 1.0, 1.0, 1.0, 1.0])
    damped = synthetic(table, k, 1e-3 * np.diag([2.0, 1.0, 1.0, 3.0, 3.0]))
    # w c / k
    np.testing.assert_allclose(damped.losses()[0][0, 0, 0], [0.05, 0.1, 0.1, 0.3, 0.3], rtol=1e-12)
    assert damped.cautions() == []


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_a_whirl_that_feeds_on_the_shaft_is_told(table, sign):
    k = np.eye(5)
    # forces at right angles to the motion: with -K, a force along y for z < 0 drives y ahead of z: forward
    k[Y, Z], k[Z, Y] = sign * 0.02, -sign * 0.02
    found = synthetic(table, k, 1e-4 * np.eye(5))
    least, motion = (part[0, 0, 0] for part in found.losses())
    assert least[0] == pytest.approx(0.01 - 0.02, rel=1e-9)
    (caution,) = found.cautions()
    # power of -K q on the circle y = cos, z = sin: -(K_yz z) y' - (K_zy y) z' = sign 0.02 w (sin^2 + cos^2)
    assert caution.startswith(f"a {'forward' if sign > 0 else 'backward'} radial whirl of up to 15.92 Hz")
    assert motion.shape == (5, 5)


@pytest.mark.parametrize(
    ("options", "words"),
    [
        ({"speeds": [2e5]}, "speeds are refused: allowed are -100000 to 100000 r/min"),
        ({"speeds": []}, "speeds = [] is refused: give finite numbers, in r/min"),
        ({"speeds": ["fast"]}, "speeds = ['fast'] is refused: give numbers, in r/min"),
        ({"frequencies": [0.0, 100.0]}, "frequencies: 0 Hz is refused: damping needs frequencies above 0"),
        ({"frequencies": [math.nan]}, "frequencies = [nan] is refused: give finite numbers, in Hz"),
        ({"preloads": [2e4]}, "preload = 20000.0 is refused: allowed are 0 to 10000 N"),
        ({"inputs": {"preload": 3.0}}, "preload is an axis of the table: give preloads, in N"),
        ({"inputs": {"shaft_speed": 3.0}}, "shaft_speed is an axis of the table: give speeds, in r/min"),
        ({"inputs": {"radial_load.x": 3.0}}, "radial_load.x"),
        ({"spacing": "cage"}, "spacing = 'cage' is refused: it is held or free"),
    ],
)
def test_values_that_are_refused(spindle, options, words):
    with pytest.raises(ValueError, match=re.escape(words)):
        table_of(spindle, **options)


def test_where_there_is_no_equilibrium(spindle):
    soft = {"pedestal_stiffness": 1e4, "radial_load.z": -3e3}
    with pytest.raises(EngineError, match="7003C-spindle: initialisation: the loads push the outer ring"):
        table_of(spindle, [20e3], [100.0], inputs=soft)


def test_a_bearing_without_preload_is_told(spindle):
    assert any("loose balls" in line for line in table_of(spindle, [1e4], [100.0], preloads=[0.0]).cautions())


def test_standstill_is_told(spindle):
    still = table_of(spindle, [0.0], [1e3])
    assert any(line.startswith("0 r/min: contacts that do not roll stick") for line in still.cautions())
    # nothing turns: no force at right angles to the motion, no whirl that feeds on the shaft
    assert abs(still.K[0, 0, 0, Y, Z]) < 1e-6 * still.K[0, 0, 0, Y, Y]
    assert still.losses()[0].min() > 0.0


def test_preloads_are_found_by_value(table):
    assert table.at_preload(500) == 1
    with pytest.raises(ValueError, match="preload = 300 N is not in this table: it has 200, 500, 1000 N"):
        table.at_preload(300)
    with pytest.raises(ValueError, match="several preloads: give one of 200, 500, 1000 N"):
        table.planes()


def test_units_of_entries():
    assert [unit("x", "y"), unit("x", "by"), unit("by", "x"), unit("by", "bz")] == [
        "N/m", "N/rad", "N", "N.m/rad",
    ]  # fmt: skip
    assert [unit(*pair, damping=True) for pair in (("x", "y"), ("x", "by"), ("by", "x"), ("by", "bz"))] == [
        "N.s/m", "N.s/rad", "N.s", "N.m.s/rad",
    ]  # fmt: skip


def test_csv_holds_every_number(table, tmp_path):
    path = table.save(tmp_path / "new" / "k.csv")
    with path.open(newline="", encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    assert list(rows[0]) == columns() and len(rows) == 9 * 6
    static = [row for row in rows if row["matrix"] == "static"]
    assert len(static) == 9 and {row["frequency_Hz"] for row in static} == {""}
    assert float(static[4]["K_y_bz [N/rad]"]) == table.static[1, 1, Y, BZ]
    assert static[4]["C_y_bz [N.s/rad]"] == ""
    one = next(
        r
        for r in rows
        if (r["speed_rpm"], r["preload_N"], r["frequency_Hz"]) == ("28000.0", "200.0", "3000.0")
    )
    assert float(one["K_bz_y [N]"]) == table.K[2, 0, 3, BZ, Y]
    assert float(one["C_by_by [N.m.s/rad]"]) == table.C[2, 0, 3, BY, BY]


def test_netcdf_holds_every_number(table, tmp_path):
    xarray = pytest.importorskip("xarray")
    pytest.importorskip("h5netcdf")
    path = table.save(tmp_path / "k.nc")
    with xarray.open_dataset(path, engine="h5netcdf") as data:
        found = data.K.sel(speed=20e3, preload=500.0, force="y", motion="bz")
        np.testing.assert_array_equal(found, table.K[1, 1, :, Y, BZ])
        np.testing.assert_array_equal(data.C, table.C)
        np.testing.assert_array_equal(data.static, table.static)
        assert data.f_c.attrs["units"] == "Hz" and "7003C" in data.attrs["scene"]


def test_other_endings_are_refused(table, tmp_path):
    with pytest.raises(ValueError, match=r"a table of stiffness is written as \.csv or \.nc"):
        table.save(tmp_path / "k.xls")
    assert not list(tmp_path.iterdir())


def test_picture_shows_each_preload(table):
    pytest.importorskip("matplotlib")
    figure = table.picture(900.0)
    above, below = figure.axes[:3], figure.axes[3:6]
    assert "1000 Hz" in figure.get_suptitle()
    for i, (k, c) in zip((X, Y, BZ), zip(above, below, strict=True), strict=True):
        solid = [line for line in k.lines if line.get_linestyle() == "-"]
        assert len(solid) == 3 and len(c.lines) == 3
        drawn = solid[1].get_ydata() / table.K[:, 1, 2, i, i]
        np.testing.assert_allclose(drawn, drawn[0], rtol=1e-12)
    labels = [text.get_text() for text in figure.legends[0].get_texts()]
    assert labels == ["200 N", "500 N", "1000 N", "frequency to 0"]
