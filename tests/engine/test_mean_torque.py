"""Mean friction torque of a communication step: work of the shaft over the angle turned."""

import numpy as np
import pytest

from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.engine.layout import S, U
from tests.engine.helpers import RPM, Run, quiet

HEATS = tuple(f"heat.{part}" for part in ("inner_ring", "outer_ring", "oil"))


@pytest.fixture
def fine(scene):
    """Run of a perfect bearing, at a speed, whose numbers do not depend on how internal steps fall."""

    def make(rpm, fidelity="full"):
        number = FIDELITIES.index(fidelity)
        return Run(quiet(scene("7003C-bare")), rpm, FIDELITY=number, TOLERANCE=1e-5, MAX_STEP=5e-6).init()

    return make


@pytest.mark.parametrize("rpm", [15000, -15000])
def test_mean_torque_times_speed_is_the_heat_while_the_torque_itself_ripples(scene, rpm):
    """Over 40 turns what the bearing stores, 1e-4 J, is little beside the 0.16 s times 20 W that it loses."""
    run = Run(scene("7003C-spindle"), rpm).init()
    run.run(0.02, 1e-3)
    rows = run.run(0.16, 1e-3)
    power = run.value("friction_torque_mean", rows) * rpm * RPM
    heat = sum(run.value(name, rows) for name in HEATS)
    assert power.mean() == pytest.approx(heat.mean(), rel=2e-3)
    assert np.std(run.value("friction_torque", rows)) > 3.0 * np.std(run.value("friction_torque_mean", rows))


def test_one_long_step_is_the_sum_of_short_ones(fine):
    """In a ramp of the speed: the work of the long step is that of the short ones, over the whole angle."""
    long, short = fine(9000), fine(9000)
    steps, h = 20, 5e-5
    long.u[U.SPEED] = 10000 * RPM
    long.step(steps * h)
    work, begin = 0.0, 9000 * RPM
    for k in range(1, steps + 1):
        end = (9000 + 1000 * k / steps) * RPM
        short.u[U.SPEED] = end
        short.step(h)
        work += short.value("friction_torque_mean") * 0.5 * (begin + end) * h
        begin = end
    mean = work / (9500 * RPM * steps * h)
    # the long step has the rings' expansion of its mean speed throughout
    assert long.value("friction_torque_mean") == pytest.approx(mean, rel=1e-3)


@pytest.mark.parametrize("fidelity", ["rings", "response"])
@pytest.mark.parametrize("end", [10000, 9000, 300])
def test_where_heats_are_held_it_puts_them_in(fine, fidelity, end):
    """The heats of a ramp are those of the speed at its end."""
    run = fine(9000, fidelity)
    run.u[U.SPEED] = end * RPM
    run.step(1e-3)
    power = run.value("friction_torque_mean") * 0.5 * (9000 + end) * RPM
    assert power == pytest.approx(sum(run.value(name) for name in HEATS), rel=1e-9)


@pytest.mark.parametrize(("begin", "end"), [(60.0, -20.0), (0.0, 0.0)])
def test_a_shaft_that_turns_back_or_stands_has_the_mean_over_time(fine, begin, end):
    """Work over the net angle would be a torque that nothing exerts, or a division by zero."""
    long, short = fine(begin), fine(begin)
    steps, h = 40, 2.5e-5
    long.u[U.SPEED] = end * RPM
    long.step(steps * h)
    torques = []
    for k in range(1, steps + 1):
        short.u[U.SPEED] = (begin + (end - begin) * k / steps) * RPM
        short.step(h)
        torques.append(short.value("friction_torque_mean"))
    # steps on one side of the turning point weigh their torque by the speed, which varies in them; so does
    # the torque, as the balls leave the side of their pockets that they press: 6e-3 in all
    assert long.value("friction_torque_mean") == pytest.approx(np.mean(torques), rel=1e-2, abs=1e-9)


@pytest.mark.parametrize("rpm", [7000.0, 7001.0, 7003.3, -7007.7, 123.4])
@pytest.mark.parametrize("h", [1e-4, 3e-4, 7e-4])
def test_a_run_up_from_rest_has_the_work_over_the_angle(fine, rpm, h):
    """Whatever the rounding of the speed at the begin, which is 0."""
    run = fine(0.0, "rings")
    run.u[U.SPEED] = rpm * RPM
    run.step(h)
    assert run.value("friction_torque_mean") * 0.5 * rpm * RPM * h == pytest.approx(
        run.s[S.SHAFT_WORK], rel=1e-9
    )


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_before_the_first_step_it_is_the_torque_itself(fine, fidelity):
    run = fine(12000, fidelity)
    assert run.value("friction_torque_mean") == run.value("friction_torque") != 0.0
