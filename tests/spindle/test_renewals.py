"""Which bearings of a set get new Jacobians, and that a set whose bearings differ much runs as it should."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import S, U, Y
from fmu_bearing.engine.status import OK
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene

STEP = 1e-4  # s
SLOW = 0.2 / 2  # contraction of a bearing of a pair beyond which its Jacobian is renewed
WAVY = {"imperfections": {"grade": "P4", "seed": 3}}
CONTRACTIONS = slice(S.CONTRACTION, S.CONTRACTION + 2)
SIDEWAYS = {"force_z_N": -100.0, "position_mm": -10.0}  # more on the front bearing


def pair(**changes):
    return scene("+-", (40.0, 70.0), 500.0, 15e3, load=SIDEWAYS, changes=changes)


def counts(run):
    """Jacobians made so far, of each bearing."""
    return np.array([run.state(b)[S.JACOBIANS] for b in range(run.count)])


@pytest.fixture
def running():
    """A pair between two renewals, with contractions at which none is due."""
    run = SetRun(pair(**WAVY)).init()
    run.run(5 * STEP)
    for b in range(2):
        run.state(b)[CONTRACTIONS] = 0.5 * SLOW
        assert run.state(b)[S.JACOBIAN_TIME] != run.s[S.TIME]
    return run


def one_step(run):
    """Which bearings' Jacobians a single internal step renews."""
    before = counts(run)
    run.s[S.STEPS] = 1.0  # no multiple of four: the contraction is not measured for its own sake
    assert run.step(2e-5) == OK
    assert run.s[S.STEPS] == 2.0
    return (counts(run) - before).tolist()


@pytest.mark.parametrize("stages", [0, 1], ids=["first", "others"])
@pytest.mark.parametrize("slow", [(False, False), (True, False), (False, True), (True, True)])
def test_the_bearing_that_contracts_slowly_is_renewed_alone(running, slow, stages):
    for b in range(2):
        running.state(b)[S.CONTRACTION + stages] = SLOW * (1.1 if slow[b] else 0.9)
    assert one_step(running) == [float(one) for one in slow]


@pytest.mark.parametrize("old", [0, 1])
def test_an_old_jacobian_is_renewed_alone(running, old):
    running.state(old)[S.JACOBIAN_TIME] = running.s[S.TIME] - 5.1e-3
    assert one_step(running) == [float(b == old) for b in range(2)]


@pytest.mark.parametrize("wrong", [0, 1])
def test_all_are_renewed_where_newtons_method_fails(running, wrong):
    """The step then is the one that new Jacobians give at once."""
    kept = running.s.copy()
    for b in range(2):
        running.state(b)[S.JACOBIAN_TIME] = -1e300
    assert one_step(running) == [1.0, 1.0]
    wanted = [running.y(b).copy() for b in range(2)]
    running.s[:] = kept
    running.state(wrong)[S.JAC : S.FAC] *= -1.0
    running.state(wrong)[S.FACTOR_STEP] = 0.0
    assert one_step(running) == [1.0, 1.0]
    for b in range(2):
        np.testing.assert_array_equal(running.y(b), wanted[b])


@pytest.mark.parametrize("wrong", [0, 1])
def test_a_jacobian_that_does_not_fit_is_found(running, wrong):
    """It is 20 % off: the increments that are left are its bearing's; that one is renewed, the other not."""
    rng = np.random.default_rng(1)
    blocks = running.state(wrong)[S.JAC : S.FAC]
    blocks *= 1.0 + 0.2 * rng.uniform(-1.0, 1.0, blocks.size)
    running.state(wrong)[S.FACTOR_STEP] = 0.0
    running.s[S.STEPS] = 0.0  # measured in this step
    assert running.step(2e-5) == OK
    slow, fine = (running.state(b)[CONTRACTIONS].max() for b in (wrong, 1 - wrong))
    assert slow > 3.0 * fine and slow > 0.8 * SLOW and fine > 0.0


def test_a_state_between_renewals_goes_on_with_the_same_bits():
    run = SetRun(pair()).init()
    for _ in range(20):
        run.run(STEP)
        if run.state(0)[S.JACOBIAN_TIME] != run.state(1)[S.JACOBIAN_TIME]:
            break
    else:
        pytest.fail("both bearings were renewed at the same times")
    kept = run.s.copy()
    wanted = run.run(5 * STEP)
    run.s[:] = kept
    run.w[:] = np.nan  # nothing in the work space survives a call
    np.testing.assert_array_equal(run.run(5 * STEP), wanted)


def led(**changes):
    """Ring velocities (m/s) and Jacobians while the pair speeds up and the rear bearing loses its load."""
    run = SetRun(pair(**changes)).init()
    rows = []
    for k in range(40):
        run.u[U.SPEED] += 2.0
        run.u[U.NOSE] = 1500.0 * min(1.0, k / 20.0)
        run.run(STEP)
        rows.append([run.y(b)[Y.V0 + i] for b in range(2) for i in range(3)])
    return run, np.array(rows)


def test_bearings_that_differ_run_as_with_a_tight_tolerance():
    run, found = led()
    _, wanted = led(**{"fidelity.tolerance": 1e-6})
    assert run.value("force.x", 0) > 1400.0 and abs(run.value("force.x", 1)) < 100.0
    # the scene's own tolerance: 1e-3 of the rings' velocity
    assert np.sqrt(np.mean((found - wanted) ** 2)) < 1e-3 * np.sqrt(np.mean(wanted**2))
    # orbits of balls without load are soft, and their places change
    made = counts(run)
    assert made[1] > 1.2 * made[0] > 0.0
