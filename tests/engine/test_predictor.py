"""First guess of a step of fidelity `rings`: polynomials, their choice, and the displacement they give."""

import numpy as np
import pytest

from fmu_bearing.engine.fidelities.rings.predictor import displace, judge, predict
from fmu_bearing.engine.layout import STRIDE, L, P, T, W, Y

STEP = 1e-5  # s
ROWS = (L.A0, L.A1, L.A2, L.A3, L.A4)
PLACES = (L.X, L.X1, L.X2, L.X3, L.X4)


class Block:
    """State and work space alone, with ``motion(n)`` as accelerations ``n`` steps ago."""

    def __init__(self, motion, known=5.0):
        self.lv, self.w, self.p = np.zeros(L.SIZE), np.zeros(W.D), np.zeros(P.LANES + 1)
        self.p[P.LANES] = 12
        self.lv[L.LEVERS : L.LEVERS + L.N] = 1.0
        self.lv[L.SETTLED : L.SETTLED + STRIDE] = 9.0
        self.lv[L.KNOWN] = known
        for n, (row, places) in enumerate(zip(ROWS, PLACES, strict=True)):
            self.lv[row : row + L.N] = motion(n)
            self.lv[places : places + 2 * STRIDE] = motion(n)

    def judged(self, found):
        """Third difference and the degree chosen when the step ends with the acceleration ``found``."""
        self.w[T.A : T.A + L.N] = found
        return judge(self.lv, self.w), self.lv[L.DEGREE]


@pytest.mark.parametrize("degree", range(5))
def test_polynomials_are_continued(degree):
    def motion(n):
        return (3.0 - n) ** degree + 2.0

    block = Block(motion)
    block.lv[L.DEGREE] = degree
    predict(block.p, block.lv, STEP, block.w)
    # small whole numbers: exact
    assert np.all(block.w[T.A : T.A + L.N] == motion(-1))
    assert np.all(block.w[T.X : T.X + 12] == motion(-1))
    # Newmark's formulas with beta = 1/12 from rest
    now = motion(0)
    moved = STEP**2 * (5.0 / 12.0 * now + motion(-1) / 12.0)
    np.testing.assert_allclose(block.w[W.STAGE + Y.Q0 :][: L.N], moved, rtol=1e-14)
    np.testing.assert_allclose(block.w[W.STAGE + Y.V0 :][: L.N], 0.5 * STEP * (now + motion(-1)), rtol=1e-14)


def test_only_known_values_are_used():
    block = Block(lambda n: 4.0 - n, known=1.0)
    block.lv[L.DEGREE] = 4.0
    for row in ROWS[2:] + PLACES[2:]:
        block.lv[row : row + L.N] = 1e9
    predict(block.p, block.lv, STEP, block.w)
    assert np.all(block.w[T.A : T.A + L.N] == 5.0)
    assert np.all(block.w[T.X : T.X + 12] == 5.0)


def test_a_ball_without_rest_stays_where_it_is():
    block = Block(lambda n: 4.0 - n)
    block.lv[L.SETTLED + 7] = 3.0
    predict(block.p, block.lv, STEP, block.w)
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
    block.lv[L.LEVERS + 2] = 2.0  # of an angle: its error counts at this radius
    assert block.judged(-(2.5**3))[0] == pytest.approx(2.0 * 6.0, rel=1e-12)
    assert Block(lambda n: n, known=1.0).judged(0.0)[0] == 0.0


@pytest.mark.parametrize("turned", [0.1, 0.5, 1.0])
def test_a_mode_turns_by_its_own_angle(turned):
    """Newmark's recursion of one mode against its exact turn: error of sixth order, (omega h)^6 / 12096."""
    block = Block(lambda n: 0.0)
    for i in range(L.N):
        block.lv[L.SQUARES + L.DIAGONAL * i] = -((turned / STEP) ** 2)
    block.w[T.D : T.D + L.N] = 1.0
    displace(block.lv, STEP, block.w)
    beta = block.w[W.STAGE + Y.Q0] / STEP**2
    assert np.all(block.w[W.STAGE + Y.Q0 :][: L.N] == block.w[W.STAGE + Y.Q0])
    # 2 - 2 cos(w h) = (w h)^2 / (1 + beta (w h)^2) is Newmark's turn per step
    angle = np.arccos(1.0 - 0.5 * turned**2 / (1.0 + beta * turned**2))
    assert abs(angle / turned - 1.0) < turned**6 / 1e4
    assert abs(np.arccos(1.0 - 0.5 * turned**2 / (1.0 + turned**2 / 12.0)) / turned - 1.0) > turned**4 / 600
