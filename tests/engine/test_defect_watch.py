"""Outputs of local defects: passages, entries and impacts beside numpy on the same ball angles."""

import math

import numpy as np
import pytest

from fmu_bearing.engine.layout import DE, P, Q, R, S, Y, Z
from fmu_bearing.engine.readout.defects import observe_defects, on_ring, watch_defects
from fmu_bearing.prepare.defect_blocks import Placed, block
from fmu_bearing.prepare.defects import Table

BALLS, PITCH, BALL = 9, 19.52e-3, 3.97e-3
RADII = (PITCH - BALL, PITCH + BALL)
LENGTH, ANGLE = 1.2e-3, math.pi
STEP, COUNT = 3e-5, 4000
ORBIT, SHAFT = 75.0, 188.0  # rad/s
TABLE = Table(
    *(np.array([-1e-3, 1e-3]), np.array([0.0, 1e-5])), *(np.zeros(2),) * 2, *(np.zeros((2, 2)),) * 4, 1e-3
)


def bearing(*defects):
    """Parameters of a bearing with these defects, its state, and its outputs of defects alone."""
    rows = block(defects)
    p = np.zeros(P.TABLES + rows.size)
    p[P.TABLES :] = rows
    p[P.AT_DEFECTS], p[P.DEFECTS] = P.TABLES, len(defects)
    p[P.BALLS], p[P.PITCH_RADIUS] = BALLS, PITCH
    return p, np.zeros(S.SOUND), np.zeros(Z.PER_DEFECT * len(defects))


def on_race(race):
    tables = tuple(TABLE if k == race else None for k in (0, 1))
    return Placed(0, race, LENGTH, tables, RADII, ANGLE)


def wrapped(angle):
    return (angle + math.pi) % (2.0 * math.pi) - math.pi


def rolled(p, s, z, move, count=COUNT, step=STEP):
    """Outputs of the defects after each step; ``move`` puts a time into the state."""
    rows = []
    for k in range(count):
        s[S.TIME] = step * k
        move(s, s[S.TIME])
        watch_defects(p, s, step)
        observe_defects(p, s, z, 0)
        rows.append(z.copy())
    return np.array(rows)


@pytest.mark.parametrize("race", [0, 1])
@pytest.mark.parametrize("way", [1.0, -1.0])
def test_passages_and_entries_are_those_of_the_balls_angles(race, way):
    p, s, z = bearing(on_race(race))
    places = 2.0 * math.pi * np.arange(BALLS) / BALLS + 0.1
    wobble = 1e-3 * np.sin(np.arange(BALLS))  # balls are not spaced evenly

    def angles(time):
        return places + wobble + way * ORBIT * time

    def move(state, time):
        state[S.Y + Y.TH : S.Y + Y.TH + BALLS] = wrapped(angles(time))
        state[S.ANGLE] = wrapped(way * SHAFT * time)
        state[S.CONTACTS + race * R.KEPT + R.KEPT_LOAD :][:BALLS] = 10.0 + np.arange(BALLS)

    rows = rolled(p, s, z, move)
    times = STEP * np.arange(COUNT)
    turned = way * SHAFT * times if race == 0 else 0.0 * times
    x = RADII[race] * wrapped(angles(times[:, None]) - turned[:, None] - ANGLE)
    near = np.argmin(np.abs(x), axis=1)
    least = x[np.arange(COUNT), near]
    # a ball passes where its place changes sign near zero
    crossed = (x[1:] * x[:-1] < 0.0) & (np.abs(x[1:]) < 1e-3) & (np.abs(x[:-1]) < 1e-3)
    passed = np.concatenate([[0], np.cumsum(crossed.sum(axis=1))])
    assert passed[-1] > 10
    assert np.array_equal(rows[:, 0], passed)
    assert np.array_equal(rows[:, 1], np.where(np.abs(least) < 1e-3, 10.0 + near, 0.0))
    # a ball enters at half a length before the middle, seen from where it comes
    rate = RADII[race] * way * (ORBIT - (SHAFT if race == 0 else 0.0))
    period = 2.0 * math.pi * RADII[race] / abs(rate)
    entries = []
    for j in range(BALLS):
        first = (-math.copysign(0.5 * LENGTH, rate) - x[0, j]) / rate
        entries += [first % period + n * period for n in range(5)]
    entries = np.sort([one for one in entries if STEP < one < times[-1]])
    last = np.array([entries[entries <= time].max(initial=0.0) for time in times])
    assert np.abs(rows[:, 3] - last).max() < 1e-12
    since = np.where(last > 0.0, times - last, 0.0)
    assert np.abs(rows[:, 2] - since).max() < 1e-12


@pytest.mark.parametrize(("ring", "last"), [(2e-3, True), (-1e-4, True), (-2e-3, False)])
def test_a_ball_strikes_where_it_last_turns_round_near_its_deepest(ring, last):
    """On the outer race a ball sinks outwards; its own and the ring's motion count, against each other.

    ``ring``: m/s, of the outer ring upwards. The ball swings in the defect and turns round twice; ``last``:
    whether the second time, in 0.3 ms, it has risen by less than a tenth of the 0.35 um of its way down.
    """
    p, s, z = bearing(on_race(1))
    rate, amplitude, middle, step = 2e4, 5e-3, 2e-3, 1e-6

    def move(state, time):
        phase = rate * (time - middle)
        state[S.Y + Y.TH] = wrapped(ANGLE + ORBIT * (time - middle))
        state[S.Y + Y.TH + 1 : S.Y + Y.TH + BALLS] = 0.0
        state[S.Y + Y.R] = amplitude / rate * math.sin(phase)
        state[S.Y + Y.VR] = amplitude * math.cos(phase)
        state[S.Y + Y.Q0 + Q.OUTER + Q.Z] = ring * (time - middle)
        state[S.Y + Y.V0 + Q.OUTER + Q.Z] = ring

    rows = rolled(p, s, z, move, 3000, step)
    # it sinks by v_r and by what the ring rises at its lowest place: until cos = -ring / amplitude
    turn = math.acos(-ring / amplitude)
    first, second = (middle + (turn + 2.0 * math.pi * k) / rate for k in (-1, 0))
    assert RADII[1] * ORBIT * max(middle - first, second - middle) < 0.5 * LENGTH  # inside, both
    # 16 mrad beside its lowest place a ring rises by 1e-4 less: 3 ns
    assert rows[round((second - 2e-5) / step), 4] == pytest.approx(first, abs=1e-8)
    assert rows[-1, 4] == pytest.approx(second if last else first, abs=1e-8)
    assert not rows[: int(first / step), 4].any()


def test_a_moved_ring_sees_a_ball_at_another_angle():
    p, s, _ = bearing(on_race(1))
    s[S.Y + Y.TH] = 0.5 * math.pi  # at -Y
    s[S.Y + Y.Q0 + Q.OUTER + Q.Z] = 1e-4
    angle, depth, _ = on_ring(p, s, 1, 0)
    assert abs(depth) < 1e-6  # it moved along the track
    # from a ring that is higher the ball is lower: further on its way from 12 o'clock to 6
    assert angle == pytest.approx(0.5 * math.pi + math.atan2(1e-4, PITCH), rel=1e-5)


def test_a_balls_defect_meets_both_races_in_a_turn():
    edges = ((0.0, 1e-3), (0.0, 1e-3))
    p, s, z = bearing(
        Placed(0, DE.BALL, 0.3e-3, (TABLE, TABLE), (BALL, BALL), 0.0, 2, (0.0, 0.0, 1.0), edges)
    )
    for race, sign in ((0, -1.0), (1, 1.0)):
        kept = S.CONTACTS + race * R.KEPT + 2
        s[kept + R.KEPT_SINA], s[kept + R.KEPT_COSA] = 0.0, sign
        s[kept + R.KEPT_LOAD] = 100.0 + race
    spin = 400.0  # rad/s

    def move(state, time):
        turned = spin * time
        state[S.DEFECT_AXES : S.DEFECT_AXES + 3] = 0.0, -math.sin(turned), math.cos(turned)

    rows = rolled(p, s, z, move)
    # it begins a quarter of a turn before the inner race
    assert rows[-1, 0] == math.floor(spin * STEP * (COUNT - 1) / math.pi + 0.5)
    assert set(rows[:, 1]) == {0.0, 100.0, 101.0}
    # misses both where the ball rolls beside it
    p, s, z = bearing(
        Placed(0, DE.BALL, 0.3e-3, (TABLE, TABLE), (BALL, BALL), 0.0, 2, (1.0, 0.0, 0.0), edges)
    )
    s[S.DEFECT_AXES] = 1.0
    for race, sign in ((0, -1.0), (1, 1.0)):
        s[S.CONTACTS + race * R.KEPT + 2 + R.KEPT_COSA] = sign
    rows = rolled(p, s, z, lambda state, time: None, 50)
    assert not rows.any()
