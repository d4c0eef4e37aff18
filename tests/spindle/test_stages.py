"""Where Newton's method begins at the stages of a set's step, and how many iterations it then takes."""

import numpy as np
import pytest

from fmu_bearing import read_scene
from fmu_bearing.engine.fidelities.full.methods.table import AT_ESDIRK4, AT_RK4, AT_TRBDF2, TABLEAUX
from fmu_bearing.engine.fidelities.full.stages import ahead_of
from fmu_bearing.engine.layout import SP, TAB, F, P, S
from fmu_bearing.instance import Instance
from fmu_bearing.modal.equations.shaft import rows_of
from fmu_bearing.prepare.model import prepare
from tests.conftest import ROOT


def running(name="7003C-DB"):
    """A set on a rigid shaft that has run for 2 ms, silent."""
    given = read_scene(ROOT / "examples" / "spindle_set" / f"{name}.toml").replace(
        {"operation.speed_rpm": 20e3, "spindle.shaft.flexible": False}
    )
    one = Instance(prepare(given.model_copy(update={"sound": None})), tell=lambda text: None)
    one.initialise()
    for _ in range(20):
        one.step(1e-4)
    return one


def test_stages_lie_on_the_line_through_the_two_before():
    for tableau in (AT_ESDIRK4, AT_TRBDF2):
        count = int(TABLEAUX[tableau + TAB.COUNT])
        nodes = TABLEAUX[tableau + TAB.NODES :][:count]
        beyond = TABLEAUX[tableau + TAB.BEYOND :][:count]
        assert beyond[:2].tolist() == [0.0, 0.0]
        for one, two, three, share in zip(nodes, nodes[1:], nodes[2:], beyond[2:], strict=False):
            assert two + share * (two - one) == pytest.approx(three, abs=1e-15)
    assert not TABLEAUX[AT_RK4 + TAB.BEYOND :][: int(TABLEAUX[AT_RK4 + TAB.COUNT])].any()


def test_the_first_implicit_stage_goes_on_from_the_step_before():
    """By the share of its distance in the time of the change, unless that belongs to a much shorter step."""
    s = np.zeros(S.AXES)
    t = 0.5e-5
    assert ahead_of(s, t, 1, AT_ESDIRK4) == 0.0  # at the start nothing is known
    for over, share in ((0.5, 0.5), (2.9, 2.9), (3.1, 0.0)):
        s[S.CHANGE_TIME] = t / over
        assert ahead_of(s, t, 1, AT_ESDIRK4) == pytest.approx(share)
        assert ahead_of(s, t, 2, AT_ESDIRK4) == ahead_of(s, t, 1, AT_RK4) == 0.0


def test_shaft_and_bearings_keep_the_same_change():
    """The driven rows of a bearing's rings change as the coordinates that carry them do."""
    one = running()
    p, s = one.p, one.s
    bearings = rows_of(p)
    count, padded = (int(p[int(p[P.SET]) + place]) for place in (SP.COUNT, SP.PADDED_SIZE))
    own = s[int(bearings[-1][SP.ROW_S] + bearings[-1][SP.ROW_S_SIZE]) :]
    change = own[SP.S_HEAD + SP.CHANGE * padded :][:count]
    assert np.abs(change).max() > 0.0
    for row in bearings:
        moves = p[int(row[SP.ROW_AT_T]) :][: count * SP.LANES].reshape(count, SP.LANES)
        wanted = (change @ moves)[: int(row[SP.ROW_DRIVEN])]
        found = s[int(row[SP.ROW_S]) :][S.CHANGE + F.BODY :][: wanted.size]
        # in each iteration to rounding of forces over masses
        assert found == pytest.approx(wanted, abs=1e-6 * np.abs(wanted).max())


def test_a_set_of_four_takes_little_more_than_an_iteration_a_stage():
    """1.24 at 20,000 r/min over five implicit stages; 1.8 from the accelerations of the stage before."""
    one = running("7003C-QBC")
    steps, iterations = one.s[S.STEPS], one.s[S.NEWTON]
    for _ in range(50):
        one.step(1e-4)
    assert (one.s[S.NEWTON] - iterations) / (one.s[S.STEPS] - steps) < 5 * 1.45
