"""Sets of bearings at the extremes: unloaded and reversed, warmed and cooled, one to eight, few balls."""

import numpy as np
import pytest

from fmu_bearing import statics
from fmu_bearing.engine.layout import S, U
from fmu_bearing.engine.status import BAD_INPUT, BAD_STEP, OK
from tests.marks import heavy_but
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene

WEIGHT = {"fidelity.terms.gravity": True}
STEP = 1e-4


def pair(signs="+-", preload=500.0, changes=None, **spindle):
    return scene(signs, (40.0, 70.0), preload, 10e3, changes=WEIGHT | (changes or {}), **spindle)


def march(run, count, each=None):
    """Step ``count`` times, ``each(run, k)`` before each; outputs stay finite and energy closes."""
    for k in range(count):
        if each is not None:
            each(run, k)
        assert run.step(STEP) == OK
        assert np.isfinite(run.z).all()
    # jumps of load and temperature leave some 1e-4 of the heat of milliseconds
    assert abs(run.value("energy.residual")) < 1e-3
    return run


def forces(run):
    return np.array([run.value("force.x", b) for b in range(run.count)])


def warmed(run, rise):
    """Inner rings and shaft warmer by ``rise`` (K)."""
    run.u[U.SHAFT_T] = 293.15 + rise
    for b in range(run.count):
        run.u[U.BEARINGS + U.ROW * b + U.INNER] = 293.15 + rise


@pytest.mark.parametrize("load", [1e3, 3e3, 6e3])
def test_thrust_that_unloads_the_rear_bearing_and_is_reversed(load):
    def each(run, k):
        run.u[U.NOSE] = load if k < 30 else -load

    run = march(SetRun(pair()).init(), 60, each)
    # the last load's mean over a period of the axial mode, some 0.5 ms: within what still vibrates
    mean = np.mean([forces(march(run, 1)).sum() for _ in range(20)])
    assert mean == pytest.approx(-load, rel=0.3)


def test_a_rear_bearing_without_load_at_the_start():
    run = march(SetRun(pair(load={"force_x_N": 4000.0})).init(), 30)
    front, rear = forces(run)
    assert front == pytest.approx(4000.0, rel=0.01) and -30.0 < rear < 0.0


@pytest.mark.parametrize("rise", heavy_but([10.0, 40.0, -40.0], 1))
def test_warmth_in_a_ramp_ends_at_the_loads_of_statics(rise):
    still = statics(
        pair(
            changes={
                "operation.inner_ring_temperature_degC": 20.0 + rise,
                "spindle.shaft.temperature_degC": 20.0 + rise,
            }
        )
    )
    run = march(SetRun(pair()).init(), 300, lambda run, k: warmed(run, rise * min(k / 200.0, 1.0)))
    found = np.mean([forces(march(run, 1)) for _ in range(40)], axis=0)
    # statics lack the drag of oil and cage on the balls; what still vibrates is 1 %
    assert found == pytest.approx([one.force[0] for one in still.bearings], rel=0.03)


@pytest.mark.parametrize("rise", [40.0, -40.0])
def test_a_jump_of_temperature_finishes(rise):
    march(SetRun(pair()).init(), 50, lambda run, k: warmed(run, rise if k >= 10 else 0.0))


@pytest.mark.parametrize("count", range(1, 9))
def test_one_to_eight_bearings(count):
    signs = "+" * ((count + 1) // 2) + "-" * (count // 2)
    places = [30.0 + 15.0 * k for k in range(count)]
    one = {"load": {"force_x_N": 300.0}} if count == 1 else {}
    run = march(SetRun(scene(signs, places, None if one else 300.0, 10e3, changes=WEIGHT, **one)).init(), 20)
    carried = forces(run)
    assert carried.sum() == pytest.approx(300.0 if one else 0.0, abs=2.0)
    assert np.abs(carried[: (count + 1) // 2]) == pytest.approx(300.0, rel=0.01)


@pytest.mark.parametrize("signs", ["-+", "++-", "--+", "++--", "+-+-", "+++-"])
def test_arrangements_start_and_run(signs):
    places = [30.0 + 15.0 * k for k in range(len(signs))]
    run = march(SetRun(scene(signs, places, 300.0, 10e3, changes=WEIGHT)).init(), 10)
    assert forces(run).sum() == pytest.approx(0.0, abs=2.0)


def test_without_preload_a_pair_runs_on_what_its_balls_weigh():
    run = march(SetRun(pair(preload=None)).init(), 50)
    assert np.abs(forces(run)).max() < 50.0


def test_run_up_from_rest_and_back_through_it():
    def each(run, k):
        run.u[U.SPEED] = 1000.0 * np.sin(0.1 * k)

    run = SetRun(pair(), rpm=0.0).init()
    march(run, 63, each)
    assert run.s[S.SPEED] == pytest.approx(1000.0 * np.sin(6.2))


@pytest.mark.parametrize("balls", [3, 4])
def test_bearings_of_few_balls(balls):
    run = SetRun(pair(changes={"bearing.ball_count": balls, "bearing.cage": None, "materials.cage": None}))
    run = march(run.init(), 20)
    carried = [run.value("force.x", b) for b in range(2)]
    # nothing but the preload along the axis: both carry the same
    assert sum(carried) == pytest.approx(0.0, abs=1.0) and carried[0] > 400.0


def test_bad_inputs_are_refused_and_change_nothing():
    run = SetRun(pair()).init()
    before, good = run.s.copy(), run.u.copy()
    for place in range(run.u.size):
        for bad in (np.nan, np.inf):
            run.u[:] = good
            run.u[place] = bad
            assert run.step(STEP) == BAD_INPUT
            assert run.try_init() == BAD_INPUT
            assert np.array_equal(run.s, before)
    run.u[:] = good
    for h in (0.0, -1e-4, np.nan, np.inf):
        assert run.step(h) == BAD_STEP
    assert np.array_equal(run.s, before)


def test_a_state_copied_goes_on_with_the_same_bits():
    run = march(SetRun(pair(load={"force_z_N": -100.0})).init(), 7)
    kept = run.s.copy()
    march(run, 5)
    first, end = run.z.copy(), run.s.copy()
    run.s[:] = kept
    run.w[:] = np.nan  # nothing in the work space survives a call
    assert np.array_equal(march(run, 5).z, first) and np.array_equal(run.s, end)
