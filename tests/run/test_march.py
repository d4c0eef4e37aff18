"""Steps, what is read between them, and how a march ends."""

import os
import signal

import numpy as np
import pytest

from fmu_bearing.instance import EngineError, Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.run.march import begin, march, to_points, underway
from fmu_bearing.scene.read import with_fidelity


class Counted:
    """Adds up steps; the one to the time given is refused."""

    def __init__(self, refused=np.inf):
        self.time, self.refused = 0.0, refused

    def step(self, h):
        if self.time + h >= self.refused:
            raise EngineError("no step")
        self.time += h


def test_all_steps_are_made_and_read():
    bearing, read = Counted(), []
    assert march(bearing, [1.0, 2.0, 4.0], lambda: read.append(bearing.time))
    assert read == [1.0, 3.0, 7.0]


def test_what_was_read_stays_after_a_refused_step():
    bearing, read = Counted(refused=3.0), []
    with pytest.raises(EngineError, match="no step"):
        march(bearing, [1.0, 1.0, 1.0], lambda: read.append(bearing.time))
    assert read == [1.0, 2.0]


@pytest.mark.skipif(os.name != "posix", reason="signals of POSIX")
def test_ctrl_c_ends_after_the_step_and_a_second_one_at_once():
    bearing = Counted()
    before = signal.getsignal(signal.SIGINT)

    def read():
        if bearing.time >= 2.0:
            signal.raise_signal(signal.SIGINT)
        return bearing.time

    with underway("steps", 9.0, shown=False) as proceed:
        assert not march(bearing, [1.0] * 9, read, proceed)
        assert bearing.time == 2.0
        with pytest.raises(KeyboardInterrupt):
            march(bearing, [1.0] * 9, read, proceed)
    assert signal.getsignal(signal.SIGINT) is before
    bearing.time = 0.0
    with underway("steps", 9.0, shown=False, stops=False) as proceed:
        with pytest.raises(KeyboardInterrupt):
            march(bearing, [1.0] * 9, read, proceed)


def test_inputs_have_the_values_of_the_points(silent):
    """Numbers and functions of time; steps end at the points, whatever the engine's time has rounded to."""
    inputs = {"preload": 400.0, "shaft_speed": lambda time: 1000.0 + 1e5 * time}
    bearing = begin(Instance(prepare(with_fidelity(silent, model="rings"))), inputs)
    assert (bearing.get("preload"), bearing.get("shaft_speed")) == (400.0, 1000.0)
    points, read = [1e-4 * k for k in range(1, 6)], []
    march(bearing, to_points(bearing, points, inputs), lambda: read.append(bearing.get("shaft_speed")))
    assert read == [1000.0 + 1e5 * point for point in points]
    # rounding of some sums
    assert bearing.time == pytest.approx(points[-1], rel=1e-14)
