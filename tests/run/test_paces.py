"""How inputs move while a bearing is timed."""

import math

import numpy as np
import pytest

from fmu_bearing import with_fidelity
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import U
from fmu_bearing.run.paces import Paces, motions, paces, speed
from tests.conftest import ROOT


def bearing(name="scenes/7003C-bare.toml", model="response"):
    found = Arrays.of(with_fidelity(ROOT / "examples" / name, model=model))
    found.init()
    return found


def test_motions_start_from_the_present_inputs_and_stay_near():
    one = bearing()
    speed = one.u[U.SPEED]
    moves = motions(one)
    seen = {name: [] for name in moves}
    for name, move in moves.items():
        u = one.u.copy()
        for k in range(401):
            if move is not None:
                move(u, 1e-3 * k)
            seen[name].append(u.copy())
    ramp, warming, ripple = (np.array(seen[name]) for name in ("ramp", "warming", "ripple"))
    assert ramp[0, U.SPEED] == ripple[0, U.SPEED] == speed
    assert np.abs(np.diff(ramp[:, U.SPEED])).max() == pytest.approx(1.0)  # 1,000 rad/s2
    assert ramp[100, U.SPEED] == pytest.approx(speed - 100.0) and ramp[200, U.SPEED] == pytest.approx(speed)
    warm = slice(U.SHAFT_T, None)
    np.testing.assert_allclose(warming[400, warm] - warming[0, warm], 2.0)
    assert np.delete(warming, range(U.SHAFT_T, U.SIZE), 1).std(0).max() == 0.0
    assert np.abs(ripple[:, U.SPEED] / speed - 1.0).max() == pytest.approx(5e-4)


def test_a_slow_shaft_loses_half_of_its_speed_and_one_at_rest_none():
    for rpm, lost in ((100.0, 0.5), (-100.0, 0.5), (0.0, 0.0)):
        one = bearing()
        one.u[U.SPEED] = speed = rpm * math.pi / 30.0
        u = one.u.copy()
        motions(one)["ramp"](u, 0.1)
        assert u[U.SPEED] == pytest.approx((1.0 - lost) * speed)


def test_temperatures_of_a_set_are_all_warmed():
    pair = bearing("spindle_set/7003C-DB.toml")
    u = pair.u.copy()
    motions(pair)["warming"](u, 1.0)
    moved = np.flatnonzero(u != pair.u)
    assert set(moved) == set(range(U.SHAFT_T, pair.u.size))


def test_a_bearing_stays_where_it_is_timed():
    one = bearing()
    state, inputs = one.s.copy(), one.u.copy()
    found = paces(one, 2e-3)
    np.testing.assert_array_equal(one.s, state)
    np.testing.assert_array_equal(one.u, inputs)
    assert found.slowest == min(found.constant, found.ramp, found.warming, found.ripple) > 0.0
    assert math.isnan(Paces().slowest)


class Stub:
    """A bearing that takes time and does nothing."""

    s, u = np.zeros(1), np.zeros(1)

    def step(self, h):
        sum(range(30_000))  # its time must not be nothing


def test_inputs_move_with_the_time_that_is_simulated():
    """Two steps to see how long one takes, then as many as the longest time has, from the begin again."""
    times = []
    speed(Stub(), 1.0, 1, 0.01, motion=lambda u, time: times.append(time))
    np.testing.assert_allclose(times, [1e-3, 2e-3, *(1e-3 * np.arange(1, 11))], rtol=1e-12)


def test_a_run_shorter_than_a_tick_of_the_processors_clock_counts_as_what_passes(monkeypatch):
    monkeypatch.setattr("fmu_bearing.run.paces.time.process_time", lambda: 1.0)
    wall, cpu = speed(Stub(), 1.0, 2, 0.01)
    assert cpu == wall > 0.0
