"""What a point measures, against runs made otherwise; what cannot be run."""

import math

import numpy as np
import pytest

from fmu_bearing import error_motion
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import S, U, Y, Z
from fmu_bearing.interface.names import UnknownName
from fmu_bearing.prepare.sound_block import sound_block
from fmu_bearing.run.figures import _once_per_turn
from fmu_bearing.run.metrics import measure
from fmu_bearing.run.simulate import simulate
from fmu_bearing.scene.read import with_fidelity
from fmu_bearing.sweeps import sweep
from fmu_bearing.sweeps.figures import figures_of
from fmu_bearing.sweeps.point import run_point, task_of
from tests.sweeps.points import small


@pytest.fixture(scope="module")
def rings(scene):
    return with_fidelity(scene("7003C-bare"), model="rings")


def test_figures_are_those_of_a_run_beside(rings):
    """A plain loop over the same engine, with statistics of its own."""
    means = [
        *(f"contact.{race}.{what}" for race in ("inner", "outer") for what in ("load_mean", "angle_mean")),
        "friction_torque", "cage.speed_ratio",
    ]  # fmt: skip
    names = ["*_ring.velocity", *means, "mic[*].leq_a"]
    data = sweep(rings, {"preload": [500]}, settle=0.01, window=0.02, figures=names, workers=1).squeeze()
    bearing = Arrays.of(rings, sound_block(rings), METERING_START=0.01)
    bearing.init()
    bearing.run(0.01, 1e-3)
    rows = np.empty((200, bearing.z.size))
    for row in rows:
        bearing.step(1e-4)
        row[:] = bearing.z
    read = dict(zip(Z.BEARING_OUTPUTS, rows.T, strict=False))
    expected = {name: read[name].mean() for name in means}
    for ring in ("inner_ring.velocity", "outer_ring.velocity"):
        expected[ring] = math.sqrt(sum(read[f"{ring}.{axis}"].var() for axis in "xyz"))
    level = Z.mics(rings.bearing.ball_count) + Z.MIC_OUTPUTS.index("leq_a")
    for k in range(4):
        expected[f"mic[{k + 1}].leq_a"] = rows[-1, level + k * len(Z.MIC_OUTPUTS)]
    assert set(expected) <= set(data)
    for name, value in expected.items():
        assert float(data[name]) == pytest.approx(value, rel=1e-12), name  # the order of a sum
    found = measure(rings, np.empty(0), 0.01, 0.02).figures
    for name, value in found.items():
        # without sound the balls are shown at their place of rest: 2e-6 of loads and angles
        assert value == pytest.approx(expected[name], rel=1e-5), name
    assert data["friction_torque"].attrs["units"] == "N.m"
    assert data["seed"] == 1 and data["reason"] == "" and data["wall"] > 0


def test_a_point_is_the_run_that_simulate_makes(rings):
    quiet = rings.model_copy(update={"sound": None})
    data = sweep(
        quiet, {"speed": [15000]}, settle=0.0, window=2e-3, figures=["friction_torque:last"], workers=1
    )
    turned = quiet.model_copy(update={"operation": quiet.operation.model_copy(update={"speed_rpm": 15000.0})})
    run = simulate(turned, 2e-3, step=1e-4, progress=False)
    assert float(data["friction_torque:last"].squeeze()) == pytest.approx(
        run["friction_torque"][-1], rel=1e-12
    )


@pytest.mark.parametrize("fidelity", ["response", "rings", "full"])
@pytest.mark.parametrize("side", [1, -1])
def test_no_line_folds_onto_the_shaft_speed(scene, fidelity, side):
    """A wave of the outer race that gives a line at 10 kHz more or less the shaft's: read every 0.1 ms, both
    are one. It is 20,000 times as strong as the unbalance's."""
    order, balls, smooth = 6, 12, [{"order": 2, "amplitude_um": 0.0}]
    silent = scene("7003C-bare").replace({
        "sound": None, "fidelity.model": fidelity, "bearing.cage": None, "fidelity.terms.gravity": False,
        "imperfections": {
            "seed": 1, "unbalance_um": 0.05, "ball_diameter_spread_nm": 0.0, "inner_race_harmonic": smooth,
            "outer_race_harmonic": smooth,
        },
    })  # fmt: skip
    figures = ["outer_ring.velocity:1x", "outer_ring.velocity"]

    def read(rpm, **flaws):
        one = silent.replace(flaws)
        data = sweep(one, {"speed": [rpm]}, settle=0.05, window=0.03, figures=figures, workers=1).squeeze()
        return [float(data[name]) for name in figures]

    rpm = 20_000.0
    for _ in range(3):  # 72 f_c = 10 kHz -+ f_r; balls orbit with f_c
        bearing = Arrays.of(silent.replace({"operation.speed_rpm": rpm}))
        bearing.init()
        rpm = 60.0 * 1e4 / (order * balls * bearing.s[S.Y + Y.OM] / bearing.u[U.SPEED] - side)
    alone = read(rpm)[0]
    wave = [{"order": order * balls + 1, "amplitude_um": 0.02, "phase_deg": 0.0}]
    with_line, whole = read(rpm, **{"imperfections.outer_race_harmonic": wave})
    assert whole > 2e4 * alone
    # the ring's stiffness changes by its second order, parts in 1e4; a ten-thousandth of the line would show
    assert with_line == pytest.approx(alone, rel=0.02)


def test_the_part_at_shaft_speed_is_found_beside_a_stronger_line():
    time = np.arange(1, 1001) * 1e-4
    speed = 2.0 * np.pi * 467.0
    turn = np.stack([np.cos(speed * time), np.sin(speed * time)], 1)
    other = 20.0 * np.stack([np.sin(2.0 * np.pi * 2440.0 * time), np.ones(time.size)], 1)
    # two axes of amplitude 1: rms 1 together; of the other line what Hann's window lets through
    assert _once_per_turn(turn + other, time, speed) == pytest.approx(1.0, abs=2e-3)
    assert np.isnan(_once_per_turn(turn[:50], time[:50], speed))  # 2.3 turns


def test_a_point_without_equilibrium_is_refused_and_stops_nothing(scene):
    quiet = with_fidelity(scene("7003C-bare").model_copy(update={"sound": None}), model="rings")
    loose = quiet.model_copy(
        update={"mounting": quiet.mounting.model_copy(update={"radial_load_z_N": -2000.0})}
    )
    data = sweep(
        loose, {"preload": [0, 800], "pedestal": [1e4, 1e8]}, settle=0.0, window=1e-3, workers=1,
        figures=["contact.inner.load_mean"],
    )  # fmt: skip
    reasons = data["reason"].values.ravel().tolist()
    assert reasons[3] == "" and np.isfinite(data["contact.inner.load_mean"].values[1, 1])
    soft = data.sel(pedestal_stiffness_N_m=1e4)
    assert np.isnan(soft["contact.inner.load_mean"].values).all()
    assert all(reason.startswith("initialisation: ") for reason in soft["reason"].values)


def test_a_figure_that_only_some_points_have(scene):
    """An axis may take a ball away: its figures are missing there."""
    made = small(scene("7003C-bare").model_copy(update={"sound": None}), speeds=[5000])
    data = sweep(
        made.scene, {"bearing.ball_count": [12, 11], "fidelity": ["response"]}, settle=0.0, window=1e-3,
        figures=["ball[12].velocity", "friction_torque"], workers=1,
    ).squeeze()  # fmt: skip
    assert np.isfinite(data["friction_torque"]).all()
    assert np.isfinite(data["ball[12].velocity"][0]) and np.isnan(data["ball[12].velocity"][1])


@pytest.mark.heavy
def test_error_motion_is_a_figure_of_a_run_of_its_own(rings):
    """At the middle of the bearing, as `error_motion` has it; a speed of 0 has none."""
    wanted = ["friction_torque", "error_motion.asynchronous.rotating", "error_motion.asynchronous.tilt_*"]
    scene = rings.replace({"sound": None, "operation.speed_rpm": 20e3})
    there = figures_of(scene, wanted)
    assert [one.name for one in there] == [
        "friction_torque", "error_motion.asynchronous.rotating", "error_motion.asynchronous.tilt_about_y",
        "error_motion.asynchronous.tilt_about_z", "error_motion.asynchronous.tilt_rotating",
    ]  # fmt: skip
    assert [one.unit for one in there[:3]] == ["N.m", "m", "rad"]
    done = run_point(task_of(scene, 0.0, 1e-3, tuple(one.name for one in there), None))
    assert done.reason == "", done.reason
    values = {one.direction: one.asynchronous for one in error_motion(scene).speeds[0].values}
    # the same run: the same bits
    assert done.figures[1:] == tuple(
        values[name] for name in ("rotating", "tilt about y", "tilt about z", "tilt rotating")
    )
    with pytest.raises(UnknownName, match="is a value over revolutions already"):
        figures_of(scene, ["error_motion.synchronous.axial:max"])
    assert not any(one.name.startswith("error_motion") for one in figures_of(scene, ["*"]))
