"""First guess of a step of fidelity `rings`: polynomials, their choice, and the displacement they give."""

import numpy as np
import pytest

from fmu_bearing.engine.fidelities.rings.predictor import continue_places, displaced, guess, judged
from fmu_bearing.engine.layout import STRIDE, H, L, T

STEP = 1e-5  # s
HISTORY = H.NUMBERS  # of the march: its numbers stand first
ROWS = [HISTORY + k * L.COLUMN for k in (H.A0, H.A1, H.A2, H.A3, H.A4)]
LEVERS = HISTORY + H.LEVERS * L.COLUMN
TRIAL, CHANGE, PLACE, RATE, SOFT = (k * L.COLUMN for k in range(5))  # of trial vectors; nothing holds SOFT
PLACES = (L.X, L.X1, L.X2, L.X3, L.X4)


class Block:
    """History of a march alone, with ``motion(n)`` as accelerations and balls' places ``n`` steps ago."""

    def __init__(self, motion, known=5.0):
        self.x = np.zeros(HISTORY + H.VECTORS * L.COLUMN)
        self.trial = np.zeros(5 * L.COLUMN)
        self.lv, self.w = np.zeros(L.SIZE), np.zeros(T.X + 2 * STRIDE)
        self.x[LEVERS : LEVERS + L.N] = 1.0
        self.lv[L.SETTLED : L.SETTLED + STRIDE] = 9.0
        self.x[H.KNOWN] = self.lv[L.KNOWN] = known
        for n, (row, places) in enumerate(zip(ROWS, PLACES, strict=True)):
            self.x[row : row + L.N] = motion(n)
            self.lv[places : places + 2 * STRIDE] = motion(n)

    def predict(self):
        """Trial vectors and places of the balls, a step on."""
        guess(self.x, 0, HISTORY, L.COLUMN, STEP, self.trial, TRIAL, CHANGE, PLACE, RATE)
        displaced(self.trial, CHANGE, SOFT, PLACE, L.COLUMN, STEP)
        continue_places(self.lv, 12, self.w)

    def judged(self, found):
        """Third difference and the degree chosen when the step ends with the acceleration ``found``."""
        self.trial[TRIAL : TRIAL + L.N] = found
        third = judged(self.x, 0, HISTORY, L.COLUMN, self.trial, TRIAL, CHANGE)
        return third, self.x[H.DEGREE]


@pytest.mark.parametrize("degree", range(5))
def test_polynomials_are_continued(degree):
    def motion(n):
        return (3.0 - n) ** degree + 2.0

    block = Block(motion)
    block.x[H.DEGREE] = degree
    block.predict()
    # small whole numbers: exact
    assert np.all(block.trial[TRIAL : TRIAL + L.N] == motion(-1))
    assert np.all(block.w[T.X : T.X + 12] == motion(-1))
    # Newmark's formulas with beta = 1/12 from rest
    now = motion(0)
    moved = STEP**2 * (5.0 / 12.0 * now + motion(-1) / 12.0)
    np.testing.assert_allclose(block.trial[PLACE:][: L.N], moved, rtol=1e-14)
    np.testing.assert_allclose(block.trial[RATE:][: L.N], 0.5 * STEP * (now + motion(-1)), rtol=1e-14)


def test_only_known_values_are_used():
    block = Block(lambda n: 4.0 - n, known=1.0)
    block.x[H.DEGREE] = 4.0
    for row, places in zip(ROWS[2:], PLACES[2:], strict=True):
        block.x[row : row + L.N] = 1e9
        block.lv[places : places + L.N] = 1e9
    block.predict()
    assert np.all(block.trial[TRIAL : TRIAL + L.N] == 5.0)
    assert np.all(block.w[T.X : T.X + 12] == 5.0)


def test_a_ball_without_rest_stays_where_it_is():
    block = Block(lambda n: 4.0 - n)
    block.lv[L.SETTLED + 7] = 3.0
    block.predict()
    assert block.w[T.X + 7] == block.w[T.R + 7] == 4.0
    assert block.w[T.X + 6] == 5.0


def test_the_degree_is_that_of_the_least_error():
    smooth = Block(lambda n: np.sin(0.3 * (2.0 - n)))
    assert smooth.judged(np.sin(0.9))[1] == 4.0
    # the highest modes turn by up to 2.2 rad per step, where every difference is larger than the last
    rough = Block(lambda n: np.cos(2.2 * n))
    assert rough.judged(np.cos(-2.2))[1] == 0.0
    # large errors are remembered for a while
    assert rough.judged(np.cos(2.2 * 0))[1] == 0.0


def test_the_third_difference_is_that_of_the_accelerations():
    block = Block(lambda n: (n - 1.5) ** 3)
    block.x[LEVERS + 2] = 2.0  # of an angle: its error counts at this radius
    assert block.judged(-(2.5**3))[0] == pytest.approx(2.0 * 6.0, rel=1e-12)
    assert Block(lambda n: n, known=1.0).judged(0.0)[0] == 0.0


@pytest.mark.parametrize("turned", [0.1, 0.5, 1.0])
def test_a_mode_turns_by_its_own_angle(turned):
    """Newmark's recursion of one mode against its exact turn: error of sixth order, (omega h)^6 / 12096."""
    trial = np.zeros(4 * L.COLUMN)
    # a change of the acceleration by 1, and B^-1 J_x times it
    trial[CHANGE : CHANGE + L.N] = 1.0
    trial[RATE : RATE + L.N] = -((turned / STEP) ** 2)
    displaced(trial, CHANGE, RATE, PLACE, L.COLUMN, STEP)
    beta = trial[PLACE] / STEP**2
    assert np.all(trial[PLACE : PLACE + L.N] == trial[PLACE])
    # 2 - 2 cos(w h) = (w h)^2 / (1 + beta (w h)^2) is Newmark's turn per step
    angle = np.arccos(1.0 - 0.5 * turned**2 / (1.0 + beta * turned**2))
    assert abs(angle / turned - 1.0) < turned**6 / 1e4
    assert abs(np.arccos(1.0 - 0.5 * turned**2 / (1.0 + turned**2 / 12.0)) / turned - 1.0) > turned**4 / 600
