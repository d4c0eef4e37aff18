"""Statics of sets whose outer rings give way: a housing on its pedestal, pedestals of their own, springs."""

import numpy as np
import pytest

from fmu_bearing import read_scene, simulate, statics
from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.layout import P, Q, S, U, Y
from fmu_bearing.prepare.spindle import one_of
from fmu_bearing.scene.mounting import Mounting, Rotor
from fmu_bearing.scene.read import with_fidelity
from tests.conftest import ROOT
from tests.engine.condensed import FIDELITIES
from tests.engine.helpers import Run
from tests.marks import heavy_but
from tests.oracles.cartesian_forces import turned_axes
from tests.spindle.rest import oracle
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene
from tests.spindle.test_dynamics_oracle import BODY, SEATS
from tests.spindle.test_runs import loaded

FORCES = ("force.x", "force.y", "force.z")


@pytest.mark.parametrize("flexible", [False, True], ids=["rigid", "beam"])
@pytest.mark.parametrize("seat", SEATS)
def test_statics_are_where_runs_start(seat, flexible):
    given = loaded(seat, rpm=0.0, **{"spindle.shaft.flexible": flexible})
    found, run = statics(given), SetRun(given).init()
    known = oracle(given)
    for b, (one, held) in enumerate(zip(found.bearings, known.held, strict=True)):
        ours = [run.value(name, b) for name in FORCES]
        assert one.force == pytest.approx(ours, rel=1e-9, abs=1e-9)
        # the balls of the run lean on the outer race by their weight, 0.1 N in all; tilts of a housing of
        # 3e-4 rad turn 500 N by 0.15 N
        assert held.force[:3] * (-one.sign, -1, -1) == pytest.approx(ours, abs=0.4)
    nose = [run.value(f"shaft.nose.displacement.{axis}") for axis in "xyz"]
    assert found.displacement[:3] == pytest.approx(nose, rel=1e-9, abs=1e-15)
    assert known.shaft[:3] == pytest.approx(nose, rel=2e-3, abs=1e-9)


@pytest.mark.parametrize("fidelity", [0.0, *FIDELITIES.values()], ids=["full", *FIDELITIES])
@pytest.mark.parametrize("flexible", heavy_but([False, True], 1), ids=["rigid", "beam"])
@pytest.mark.parametrize("seat", SEATS)
def test_the_stiffness_that_runs_tell_is_that_of_statics(seat, flexible, fidelity):
    given = loaded(seat, rpm=0.0, **{"spindle.shaft.flexible": flexible})
    run = SetRun(given, FIDELITY=fidelity).init()
    # of a rigid shaft where the same shaft rests, bending as it may
    found = statics(given)
    outputs = [run.value(f"shaft.stiffness.{name}") for name in ("axial", "radial", "tilt")]
    assert outputs == pytest.approx(
        [found.axial_stiffness, found.radial_stiffness, found.tilt_stiffness], rel=2e-3
    )


def test_the_stiffness_follows_the_preload():
    """In fidelities rings and response, which find the set's rest again, response within some 20 pieces."""
    given = scene(rpm=10e3)
    for fidelity in ("rings", "response"):
        run = SetRun(given, FIDELITY=FIDELITIES[fidelity]).init()
        before = run.value("shaft.stiffness.axial")
        for b in range(2):
            run.u[U.BEARINGS + b * U.ROW + U.INNER] += 10.0
        run.run(0.1 if fidelity == "response" else 1e-3, 1e-3)
        warm = SetRun(given, FIDELITY=FIDELITIES[fidelity])
        warm.u[:] = run.u
        warm.init()
        assert run.value("shaft.stiffness.axial") == pytest.approx(
            warm.value("shaft.stiffness.axial"), rel=1e-6
        )
        assert run.value("shaft.stiffness.axial") > 1.02 * before


def test_a_housing_sinks_under_all_that_it_carries():
    given = scene(rpm=0.0, changes={"fidelity.terms.gravity": True, "spindle.housing": BODY})
    run = SetRun(given).init()
    down = given.replace({"spindle.housing": {}})
    still, moved = statics(down), statics(given)
    # at the middle between the bearings, where the housing's own middle is
    carried = sum(one.force[2] for one in still.bearings)
    rings = sum(run.of(run.p, b, "P")[P.OUTER_MASS] for b in range(2))
    lying = rings + 24.0 * run.p[P.BALL_MASS] + 2.0 * run.p[P.CAGE_MASS]
    sunk = (carried - GRAVITY * (BODY["mass_kg"] + lying)) / BODY["pedestal_stiffness_N_m"]
    # forces across have 0.008 N of traction, of balls that creep at the start beside a preload of 500 N
    assert run.value("housing.displacement.z") == pytest.approx(
        sunk, abs=0.02 / BODY["pedestal_stiffness_N_m"]
    )
    # what the bearings carry against each other does not depend on the pedestal, but for its tilt
    for one, other in zip(still.bearings, moved.bearings, strict=True):
        assert other.force == pytest.approx(one.force, abs=1e-3 * np.abs(one.force).max())
    apart = moved.displacement[2] - still.displacement[2]
    tilt = run.y(0)[Y.Q0 + Q.OUTER + Q.BY]
    assert apart == pytest.approx(sunk + 0.055 * tilt, rel=1e-3)


@pytest.mark.parametrize("fidelity", [0.0, *FIDELITIES.values()], ids=["full", *FIDELITIES])
def test_a_housing_goes_where_two_springs_at_an_angle_carry_it(fidelity):
    """A load above its middle, between a pair that is its own mirror: it does not tilt."""
    ratio, angle, stiffness = 0.4, 30.0, BODY["pedestal_stiffness_N_m"]
    axes = {"pedestal_stiffness_ratio": ratio, "pedestal_axis_angle_deg": angle}
    load = {"force_y_N": 150.0, "force_z_N": -50.0, "position_mm": 55.0}
    run = SetRun(scene(load=load, changes={"spindle.housing": BODY | axes}), FIDELITY=fidelity).init()
    springs = turned_axes(ratio * stiffness, stiffness, np.radians(angle))
    wanted = np.linalg.solve(springs, [load["force_y_N"], load["force_z_N"]])
    found = [run.value(f"housing.displacement.{axis}") for axis in "yz"]
    # forces across have 0.008 N of traction, see above; without balls of their own 3e-4, on equal springs too
    assert found == pytest.approx(wanted, rel=1e-3 if fidelity else 0.0, abs=0.02 / (ratio * stiffness))
    # 1.5 um along Y and 0.5 um along Z on equal springs: the soft axis takes them aside
    assert wanted == pytest.approx([2.86e-6, 0.29e-6], abs=0.01e-6)


@pytest.mark.parametrize("fidelity", [0.0, *FIDELITIES.values()], ids=["full", *FIDELITIES])
def test_a_misaligned_seat_is_a_misaligned_pedestal_that_does_not_give(fidelity):
    given = scene(
        rpm=10e3, load={"force_x_N": 100.0, "force_y_N": 30.0, "force_z_N": -50.0},
        bearings=[{"misalignment_y_mrad": 0.2}, {"misalignment_z_mrad": -0.3}],
    )  # fmt: skip
    straight = given.replace(
        {f"spindle.bearing[{k}].misalignment_{axis}_mrad": 0.0 for k in (1, 2) for axis in "yz"}
    )
    stiff = {f"spindle.bearing[{k}].seat": "pedestal" for k in (1, 2)} | {
        "spindle.housing": {"pedestal_stiffness_N_m": 1e12, "pedestal_rotational_ratio_mm2": 1e4}
    }
    runs = [SetRun(one, FIDELITY=fidelity).init() for one in (given, given.replace(stiff), straight)]
    tilts = [[one.value(f"shaft.nose.tilt.{axis}") for axis in "yz"] for one in runs]
    forces = [[one.value(name, b) for b in range(2) for name in FORCES] for one in runs]
    # 500 N press a pedestal by 0.5 nm, over a distance of 30 mm
    assert tilts[0] == pytest.approx(tilts[1], abs=1e-8)
    assert forces[0] == pytest.approx(forces[1], abs=0.01)
    # the shaft follows the mean of the seats part of the way, and bearings carry moments against each other
    assert np.abs(np.subtract(tilts[0], tilts[2])).min() > 2e-5
    assert np.abs(np.subtract(forces[0], forces[2])).max() > 2.0


def test_pedestals_of_their_own_stand_in_series_with_their_bearings():
    soft = {"spindle.bearing[1].seat": "pedestal", "spindle.bearing[2].seat": "pedestal"}
    stiffness = 1e8
    given = scene(changes=soft | {"spindle.housing.pedestal_stiffness_N_m": stiffness})
    held, found = statics(scene()), statics(given)
    each = held.axial_stiffness / 2.0
    assert found.axial_stiffness == pytest.approx(2.0 / (1.0 / each + 1.0 / stiffness), rel=1e-6)
    # pedestals take part of the way to lift-off, so that it needs less load
    assert found.preloads["cold"] == pytest.approx([500.0, 500.0], rel=1e-6)
    assert held.lift_off["+x"].load > found.lift_off["+x"].load > 1000.0


def test_a_single_bearing_on_its_pedestal_stands_as_a_mounted_one():
    given = scene(
        "+", (90.0,), None, changes={"fidelity.terms.gravity": True}, bearings=[{"seat": "pedestal"}],
        load={"force_x_N": 500.0, "position_mm": 90.0}, housing={"pedestal_stiffness_N_m": 1e8},
        shaft={"sections_mm": [[180.0, 15.0, 0.0]]},
    )  # fmt: skip
    found = statics(given)
    shaft = -found.load[2] / GRAVITY - SetRun(given).p[P.INNER_MASS]
    mounting = Mounting(
        preload_N=500.0, pedestal_stiffness_N_m=1e8,
        rotor=Rotor(mass_kg=shaft, length_mm=180.0, diameter_mm=15.0),
    )  # fmt: skip
    single = Run(one_of(given).model_copy(update={"mounting": mounting}), 0.0).init()
    y = single.s[S.Y : S.Y + Y.SIZE]
    ring = Y.Q0 + Q.OUTER
    assert found.bearings[0].force[:3] == pytest.approx(
        [500.0, 0.0, found.load[2]], abs=0.02
    )  # creeping balls: 0.004 N
    apart = y[Y.Q0 : Y.Q0 + 3] - y[ring : ring + 3]
    assert found.bearings[0].displacement[1:3] == pytest.approx(apart[1:], rel=1e-3, abs=1e-12)


@pytest.mark.heavy  # 10 s of CPU
def test_fidelities_agree_on_a_set_that_is_held_as_one_bearing_can_be():
    """A QBC on a bending shaft, misaligned, held against tilting, its housing on two springs at an angle."""
    axes = {"pedestal_stiffness_N_m": 2e8, "pedestal_stiffness_ratio": 0.5, "pedestal_axis_angle_deg": -20.0}
    given = read_scene(ROOT / "examples" / "spindle_set" / "7003C-QBC.toml").replace(
        {
            "sound": None,
            "imperfections.unbalance_um": 1.0,
            "spindle.bearing[2].misalignment_y_mrad": 0.1,
            "spindle.housing": BODY | {"mass_kg": 5.0} | axes,
            "spindle.tilt_support": {"stiffness_N_m_rad": 5e4, "damping_ratio": 0.05},
        }
    )
    names = [f"{body}.velocity.{axis}" for body in ("shaft.nose", "housing") for axis in "yz"]
    found = []
    for fidelity in ("full", "rings", "response"):
        run = simulate(
            with_fidelity(given, model=fidelity), 0.06, step=5e-5, outputs=[*names, "energy.residual"]
        )
        assert abs(run["energy.residual"][-1]) < 1e-5
        found.append([run[name][400:].std() for name in names])
    full, rings, response = np.array(found)
    # about 1.8 and 2.2 mm/s of the nose, 71 and 59 um/s of the housing
    assert rings == pytest.approx(full, rel=0.05)
    assert response == pytest.approx(full, rel=0.05)
    assert abs(full[2] / full[3] - 1.0) > 0.1
