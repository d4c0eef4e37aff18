"""Renewals in pieces (fidelities `rings` and `response`): what they come to, when, and in how many steps."""

import numpy as np
import pytest

from fmu_bearing.engine.fidelities.response.lines import line_table
from fmu_bearing.engine.layout import SP, L, S, U
from fmu_bearing.engine.status import OK
from tests.engine.condensed import FIDELITIES, block, march, silent
from tests.engine.helpers import RPM, Run
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene as set_scene
from tests.spindle.test_rings import wavy

STEP = 1e-3  # s: one piece each
CHANGED = {U.SPEED: 10_400.0 * RPM, U.PRELOAD: 160.0, U.LOAD_Y: 15.0}


def started(scene, fidelity, rpm=10_000.0, **inputs):
    """A single bearing on waves under a preload of 150 N; ``inputs`` by their names in ``U``."""
    run = Run(silent(scene("7003C-spindle")), rpm, preload=150.0, FIDELITY=FIDELITIES[fidelity])
    for name, value in inputs.items():
        run.u[getattr(U, name)] = value
    return run.init()


def changed(run):
    """The run with other inputs, not started again."""
    for place, value in CHANGED.items():
        run.u[place] = value
    return run


def step(run, count, h=STEP):
    """Make steps."""
    for _ in range(count):
        assert run.step(h) == OK


def pieces(run):
    """Stage of a renewal, how many pieces of it were made, and whether a search is going."""
    own = march(run)
    return int(own[SP.STAGE]), int(own[SP.MADE]), int(block(run)[L.SEARCH_STATE])


def lines(run):
    """Lines by their multiples: complex displacements."""
    count = int(block(run)[L.COUNT])
    table = run.s[line_table(run.p) :][: count * L.LINE_SIZE].reshape(count, -1)
    values = table[:, L.LINE_REAL : L.LINE_REAL + L.N] + 1j * table[:, L.LINE_IMAGINARY :][:, : L.N]
    return {tuple(row[: L.LINE_ROLLED + 1]): value for row, value in zip(table, values, strict=True)}


def fresh(scene, fidelity):
    """A start at the changed inputs."""
    run = Run(silent(scene("7003C-spindle")), 10_000.0, preload=150.0, FIDELITY=FIDELITIES[fidelity])
    return changed(run).init()


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_what_pieces_come_to_is_what_a_start_finds(scene, fidelity):
    """Torque, heats and orbit by the same search; rest and lines by Newton's method from elsewhere."""
    run = changed(started(scene, fidelity))
    step(run, 150)
    wanted = fresh(scene, fidelity)
    now, then = block(run), block(wanted)
    assert now[L.SEARCH_STATE] == L.IDLE
    assert now[L.MORE] != 0.0  # a whirl, and balls that the load makes uneven
    for first, count in (
        (L.RATIO, L.FROZEN_SPEED - L.RATIO),
        (L.MORE_RATIO, 1 + L.LOST),
        (L.FAMILY, 2 * L.FAMILY_SIZE),
    ):
        found, expected = (one[first : first + count] for one in (now, then))
        near = 1e-7 if fidelity == "rings" else 5e-6  # lines are found for a speed within 1e-6
        np.testing.assert_allclose(found, expected, rtol=near, atol=1e-9 * np.abs(expected).max())
    if fidelity == "response":
        np.testing.assert_allclose(now[L.MEAN :][: L.N], then[L.MEAN :][: L.N], rtol=1e-5, atol=1e-12)
        ours, theirs = lines(run), lines(wanted)
        assert ours.keys() == theirs.keys()
        most = max(np.abs(one).max() for one in theirs.values())
        for key, value in theirs.items():
            np.testing.assert_allclose(ours[key], value, rtol=5e-5, atol=1e-8 * most)


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_a_step_makes_no_more_pieces_than_its_time(scene, fidelity):
    """One per ms; what is in use stays until all are made."""
    run = changed(started(scene, fidelity))
    held = block(run)[L.FROZEN_SPEED]
    made, searched = 0, 0
    while block(run)[L.FROZEN_SPEED] == held:
        before = pieces(run)
        step(run, 1)
        after = pieces(run)
        made += 1
        if fidelity == "response":
            assert after[1] - before[1] <= 1
            assert made < 40
    assert made > (0 if fidelity == "rings" else 5)
    while pieces(run)[2] == L.GOING:
        step(run, 1)
        searched += 1
    assert 5 < searched < 150
    # the same in one long step
    long = changed(started(scene, fidelity))
    step(long, 1, 0.5)
    step(run, 150)
    near = 1e-9 if fidelity == "rings" else 1e-5  # lines of the run were found for a speed within 1e-6
    assert block(long)[L.MORE_RATIO] == pytest.approx(block(run)[L.MORE_RATIO], rel=near)
    assert block(long)[L.TORQUE] == pytest.approx(block(run)[L.TORQUE], rel=near)


def test_a_jump_within_a_short_step_is_not_forgotten(scene):
    """It is out of date in one step of 0.1 ms, in which no piece is due, and renewed in a later one."""
    for fidelity in ("rings", "response"):
        run = changed(started(scene, fidelity))
        step(run, 2_000, 1e-4)
        assert block(run)[L.FROZEN_SPEED] == pytest.approx(run.u[U.SPEED], rel=2e-6), fidelity


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_no_loss_is_no_reason_to_search_again(scene, fidelity):
    """Standstill without preload: nothing is lost, and a search that found that is over."""
    run = Run(silent(scene("7003C-spindle")), 0.0, preload=0.0, FIDELITY=FIDELITIES[fidelity]).init()
    run.u[U.PRELOAD] = 1e-6
    step(run, 3, 1.0)
    assert pieces(run)[0] == 0
    assert block(run)[L.SEARCH_STATE] == L.IDLE


def test_short_steps_wait_for_a_millisecond(scene):
    run = started(scene, "response")
    run.u[U.PRELOAD] = 160.0
    counts = []
    for _ in range(40):
        step(run, 1, 0.25 * STEP)
        counts.append(pieces(run)[1])
    assert np.diff(counts).max() == 1
    assert 5 <= max(counts) <= 10


def test_a_ramp_is_met_in_the_middle_of_the_time_in_which_lines_serve(scene):
    """Lines of a ramp of 5,000 r/min per s are those of speeds before and after that of the step."""
    run = started(scene, "response", rpm=3_000.0)
    ahead = []
    for k in range(400):
        run.u[U.SPEED] = (3_000.0 + 5.0 * (k + 1)) * RPM
        step(run, 1)
        ahead.append(block(run)[L.FROZEN_SPEED] / run.u[U.SPEED] - 1.0)
    settled = np.array(ahead[100:])
    assert settled.min() < 0.0 < settled.max()
    assert np.abs(settled).max() < 0.025


def test_lines_are_renewed_once_more_where_a_ramp_ends(scene):
    """For the speed at which it rests, and then no more."""
    run = started(scene, "response")
    for k in range(100):
        run.u[U.SPEED] = (10_000.0 + 5.0 * (k + 1)) * RPM
        step(run, 1)
    step(run, 250)
    found = block(run)[L.FROZEN_SPEED]
    assert found == pytest.approx(run.u[U.SPEED], rel=2e-6)
    step(run, 60)
    assert block(run)[L.FROZEN_SPEED] == found
    assert pieces(run)[0] == 0


def test_noise_of_the_speed_is_no_ramp(scene):
    """A speed that scatters by 0.01 % renews nothing, though its rate is then 1,000 r/min per s."""
    run = started(scene, "response")
    found = block(run)[L.FROZEN_SPEED]
    for deviation in np.random.default_rng(1).normal(0.0, 1e-4, 300):
        run.u[U.SPEED] = found * (1.0 + deviation)
        step(run, 1)
    assert block(run)[L.FROZEN_SPEED] == found
    assert pieces(run)[0] == 0


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_a_speed_that_runs_away_is_not_waited_for(scene, fidelity):
    run = started(scene, fidelity)
    run.u[U.SPEED] = 14_000.0 * RPM
    step(run, 1)
    assert block(run)[L.FROZEN_SPEED] == run.u[U.SPEED]
    assert block(run)[L.SEARCH_STATE] == L.IDLE
    wanted = started(scene, fidelity, rpm=14_000.0)
    assert block(run)[L.TORQUE] == pytest.approx(block(wanted)[L.TORQUE], rel=1e-6)


def test_states_of_rings_restored_within_a_run_up_give_equal_bits(scene):
    """The work space holds nothing that a piece of a search or of a renewal needs: it is spoilt."""
    run = started(scene, "rings")

    def speed_up(begin, spoil=False):
        stages = set()
        for k in range(30):
            run.u[U.SPEED] = (begin + 40.0 * k) * RPM
            if spoil:
                run.w[:] = np.nan
            step(run, 1)
            stages.add(pieces(run)[::2])
        return stages

    speed_up(10_000.0)
    kept = run.s.copy()
    assert {(0, L.GOING), (2, L.GOING)} <= speed_up(11_200.0)
    wanted = run.s.copy()
    run.s[:] = kept
    speed_up(11_200.0, spoil=True)
    np.testing.assert_array_equal(run.s, wanted)


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_a_set_comes_to_what_its_start_finds(fidelity):
    """A DB of wavy bearings after a jump of speed and of its shaft's temperature."""
    given = wavy(set_scene("+-", (40.0, 70.0), 200.0, 10e3))
    run, wanted = (SetRun(given, FIDELITY=FIDELITIES[fidelity]) for _ in range(2))
    run.init()
    for one in (run, wanted):
        one.u[U.SPEED] *= 1.04
        one.u[U.SHAFT_T] += 1.0
    wanted.init()
    run.run(0.2, STEP)
    for b in range(2):
        ours, theirs = (one.of(one.s, b, "S")[S.CONDENSED :] for one in (run, wanted))
        assert ours[L.SEARCH_STATE] == L.IDLE
        # what uneven balls add was searched with the set on its way, within 5 % of where it comes to
        assert ours[L.TORQUE] == pytest.approx(theirs[L.TORQUE], rel=2e-4)
        assert ours[L.RATIO] == pytest.approx(theirs[L.RATIO], rel=2e-5)
    # rest without loads across the axis is no reason to search again and again
    steady = run.s.copy()
    run.run(0.05, STEP)
    for b in range(2):
        at = int(run.row(b)[SP.ROW_S]) + S.CONDENSED
        np.testing.assert_array_equal(run.s[at + L.CONDITIONS :][:20], steady[at + L.CONDITIONS :][:20])
        assert run.s[at + L.SEARCH_STATE] == L.IDLE


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_loads_that_go_leave_nothing(fidelity):
    """3 kN across for 45 ms: a search for what its uneven balls lose is given up when it has gone.

    Before, torque was off for 230 ms more.
    """
    run = SetRun(set_scene("+-", (40.0, 70.0), 200.0, 10e3), FIDELITY=FIDELITIES[fidelity]).init()
    wanted = run.value("friction_torque")
    run.u[U.NOSE + 1] = 3_000.0
    run.run(0.045, STEP)
    run.u[U.NOSE + 1] = 0.0
    run.run(0.015, STEP)
    assert run.value("friction_torque") == pytest.approx(wanted, rel=0.01)
    run.run(0.1, STEP)
    assert run.value("friction_torque") == pytest.approx(wanted, rel=1e-3)


def test_inputs_that_move_within_a_renewal_leave_a_set_as_its_start_finds_it():
    """Rings 0.3 K warmer, then 0.8 K at each piece: points are held where the set rests at the same inputs.

    Held for other inputs than its rest, a bearing's torque stayed 2 % off.
    """
    given = set_scene("+-", (40.0, 70.0), 200.0, 10e3)

    def warmed(run, by):
        for b in range(2):
            run.u[U.BEARINGS + b * U.ROW + U.INNER] += by
        return run

    fresh = warmed(SetRun(given, FIDELITY=FIDELITIES["rings"]), 1.1)
    wanted = fresh.init().value("friction_torque")
    for steps in range(1, 8):
        run = warmed(SetRun(given, FIDELITY=FIDELITIES["rings"]).init(), 0.3)
        run.run(steps * STEP, STEP)
        warmed(run, 0.8).run(0.3, STEP)
        assert run.value("friction_torque") == pytest.approx(wanted, rel=2e-4), steps


def test_a_search_that_has_ended_is_not_lost(scene):
    """In a fast run-up a renewal gives up the search that was going when it began, which then ends."""
    run = started(scene, "response", rpm=1_500.0, LOAD_Y=60.0)
    known = []
    for k in range(400):
        run.u[U.SPEED] = (1_500.0 + 30.0 * (k + 1)) * RPM
        step(run, 1)
        known.append(block(run)[L.MORE_SPEED])
    assert len(set(known)) > 5
    assert np.diff(known).min() >= 0.0
