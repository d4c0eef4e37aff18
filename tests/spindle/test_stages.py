"""Where Newton's method begins at the stages of a set's step, and how many iterations it then takes."""

import numpy as np
import pytest

from fmu_bearing import read_scene
from fmu_bearing.engine.fidelities.full.methods.table import AT_ESDIRK4, AT_RK4, AT_TRBDF2, TABLEAUX
from fmu_bearing.engine.fidelities.full.stages import extrapolate, extrapolation
from fmu_bearing.engine.layout import STRIDE, TAB, F, S, W, Y
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from tests.conftest import ROOT


@pytest.mark.parametrize("tableau", [AT_ESDIRK4, AT_TRBDF2])
def test_accelerations_that_grow_evenly_are_met_at_once(tableau, scene):
    """From the second implicit stage on, and places and rates with them."""
    work = prepare(scene("7003C-bare")).lengths.work
    lanes, gh, rng = 16, 1e-5, np.random.default_rng(3)
    count = int(TABLEAUX[tableau + TAB.COUNT])
    nodes = TABLEAUX[tableau + TAB.NODES : tableau + TAB.NODES + count]
    begin, growth = rng.normal(size=(2, F.SIZE))
    live = np.zeros(F.SIZE, bool)
    live[F.BODY : F.WORK] = True
    for row in range(F.BODY // STRIDE):
        live[row * STRIDE : row * STRIDE + lanes] = True
    for stage in range(2, count):
        w = np.zeros(work)
        for k, node in enumerate(nodes[:stage]):
            w[W.ACC + k * F.SIZE : W.ACC + (k + 1) * F.SIZE] = begin + node * growth
        here = slice(W.ACC + stage * F.SIZE, W.ACC + (stage + 1) * F.SIZE)
        w[here] = before = begin + nodes[stage - 1] * growth
        extrapolate(w, lanes, gh, stage, extrapolation(stage, tableau))
        wanted = begin + nodes[stage] * growth
        assert w[here][live] == pytest.approx(wanted[live], abs=1e-13)
        moved = (w[here] - before)[F.X : F.X + lanes]
        # to rounding of numbers of order gh and gh * gh
        assert w[W.STAGE + Y.VX : W.STAGE + Y.VX + lanes] == pytest.approx(gh * moved, abs=1e-19)
        assert w[W.STAGE + Y.X : W.STAGE + Y.X + lanes] == pytest.approx(gh * gh * moved, abs=1e-24)


def test_the_first_implicit_stage_and_explicit_ones_know_no_line():
    assert extrapolation(1, AT_ESDIRK4) == 0.0
    assert all(extrapolation(stage, AT_RK4) == 0.0 for stage in range(1, 4))


def test_a_set_of_four_takes_little_more_than_an_iteration_a_stage():
    """1.3 at 20,000 r/min over five implicit stages; 1.8 from the accelerations of the stage before."""
    given = read_scene(ROOT / "examples" / "spindle_set" / "7003C-QBC.toml").replace(
        {"operation.speed_rpm": 20e3, "spindle.shaft.flexible": False}
    )
    one = Instance(prepare(given.model_copy(update={"sound": None})), tell=lambda text: None)
    one.initialise()
    for _ in range(20):
        one.step(1e-4)
    steps, iterations = one.s[S.STEPS], one.s[S.NEWTON]
    for _ in range(50):
        one.step(1e-4)
    assert (one.s[S.NEWTON] - iterations) / (one.s[S.STEPS] - steps) < 5 * 1.45
