"""Stages of a Runge-Kutta step against the same sums by NumPy."""

import numpy as np
import pytest

from fmu_bearing.compiled import call
from fmu_bearing.engine.fidelities.full.methods.table import AT_ESDIRK4, TABLEAUX
from fmu_bearing.engine.fidelities.full.norms import newton_size
from fmu_bearing.engine.fidelities.full.runge_kutta import (
    complete_torque,
    correct,
    keep_velocities,
    newton_residual,
    predict,
)
from fmu_bearing.engine.fidelities.full.vectors import add_scaled, sum_scaled
from fmu_bearing.engine.layout import STRIDE, TAB, C, F, P, Q, S, W, Y
from fmu_bearing.engine.status import OK
from tests.engine.explicit import Motion
from tests.engine.helpers import Run

LANES, STAGE, H, GH = 12, 3, 2e-5, 5e-6
BODIES = slice(F.BODY, F.BODY + Q.SIZE)
# sums of some ten products of numbers of size 1: rounding of each is 1e-16
ROUNDING = {"rtol": 1e-14, "atol": 1e-15}


@pytest.fixture
def w():
    return np.random.default_rng(4).normal(size=W.SOUND)


@pytest.fixture
def y():
    return np.random.default_rng(5).normal(size=Y.SIZE)


def area(w, first, number=0, size=F.SIZE):
    """One vector of a row of vectors in ``w``."""
    return w[first + number * size : first + (number + 1) * size]


def parts(vector):
    """Live rows of balls, then bodies, of a vector in the layout of accelerations."""
    return vector[: 6 * STRIDE].reshape(6, STRIDE)[:, :LANES], vector[BODIES]


@pytest.mark.parametrize(("stage", "ahead"), [(1, 0.0), (1, 1.3), (2, 0.0), (STAGE, 0.0)])
def test_predicted_stage_is_the_sum_over_the_stages_before(w, y, stage, ahead):
    """Its first guess is on the line through the two stages before; of the first one, goes on as before."""
    before = w.copy()
    change = np.random.default_rng(6).normal(size=F.WORK)
    predict(y, change, ahead, LANES, H, GH, stage, AT_ESDIRK4, w)
    weights = H * TABLEAUX[AT_ESDIRK4 + TAB.A + stage * TAB.ROW :][:stage]
    nodes = TABLEAUX[AT_ESDIRK4 + TAB.NODES :][: stage + 1]
    acc = [parts(area(before, W.ACC, m)) for m in range(stage)]
    vel = [parts(area(before, W.VEL, m)) for m in range(stage)]
    if stage == 1:
        guess = [one + ahead * more for one, more in zip(acc[0], parts(change), strict=True)]
    else:
        share = (nodes[-1] - nodes[-3]) / (nodes[-2] - nodes[-3])
        guess = [one + share * (two - one) for one, two in zip(acc[-2], acc[-1], strict=True)]
    places = y[: 3 * STRIDE].reshape(3, STRIDE)[:, :LANES]
    rates = y[Y.VX : Y.Q0].reshape(6, STRIDE)[:, :LANES]
    v = [known + GH * guess[k] for k, known in enumerate((rates, y[Y.V0 :]))]
    x = [places.copy(), y[Y.Q0 : Y.V0].copy()]
    for m, a in enumerate(weights):
        v = [v[k] + a * acc[m][k] for k in range(2)]
        x = [x[0] + a * vel[m][0][:3], x[1] + a * vel[m][1]]
    x = [x[0] + GH * v[0][:3], x[1] + GH * v[1]]
    found = area(w, W.STAGE, size=Y.SIZE)
    np.testing.assert_allclose(found[: 3 * STRIDE].reshape(3, STRIDE)[:, :LANES], x[0], **ROUNDING)
    np.testing.assert_allclose(found[Y.VX : Y.Q0].reshape(6, STRIDE)[:, :LANES], v[0], **ROUNDING)
    np.testing.assert_allclose(found[Y.Q0 : Y.V0], x[1], **ROUNDING)
    np.testing.assert_allclose(found[Y.V0 :], v[1], **ROUNDING)
    for one, wanted in zip(parts(area(w, W.ACC, stage)), guess, strict=True):
        np.testing.assert_allclose(one, wanted, **ROUNDING)


def test_increment_moves_accelerations_rates_and_places(w):
    before = w.copy()
    correct(area(w, W.ACC, STAGE), LANES, GH, w)
    d, bodies = parts(area(before, W.D))
    changes = [parts(area(w, W.ACC, STAGE))[k] - parts(area(before, W.ACC, STAGE))[k] for k in range(2)]
    np.testing.assert_allclose(changes[0], d, rtol=0, atol=2e-15)
    np.testing.assert_allclose(changes[1], bodies, rtol=0, atol=2e-15)
    stage = area(w, W.STAGE, size=Y.SIZE) - area(before, W.STAGE, size=Y.SIZE)
    rates, places = stage[Y.VX : Y.Q0].reshape(6, STRIDE), stage[: Y.VX].reshape(3, STRIDE)
    np.testing.assert_allclose(rates[:, :LANES], GH * d, rtol=0, atol=2e-15)
    np.testing.assert_allclose(places[:, :LANES], GH**2 * d[:3], rtol=0, atol=2e-15)
    np.testing.assert_allclose(stage[Y.V0 :], GH * bodies, rtol=0, atol=2e-15)
    np.testing.assert_allclose(stage[Y.Q0 : Y.V0], GH**2 * bodies, rtol=0, atol=2e-15)
    assert not rates[:, LANES:].any() and not places[:, LANES:].any()


def test_residual_and_kept_velocities(w, y):
    newton_residual(area(w, W.ACC, STAGE), LANES, w)
    for got, f, acc in zip(*(parts(area(w, *at)) for at in ((W.D,), (W.F,), (W.ACC, STAGE))), strict=True):
        np.testing.assert_array_equal(got, f - acc)
    kept = np.full(F.SIZE, np.nan)
    keep_velocities(y, LANES, kept)
    np.testing.assert_array_equal(parts(kept)[0][:3], y[Y.VX :][: 3 * STRIDE].reshape(3, STRIDE)[:, :LANES])
    np.testing.assert_array_equal(kept[BODIES], y[Y.V0 :])


def evaluated(run, y):
    """Right-hand side of a bearing at positions and velocities ``y``."""
    f = np.zeros(F.SIZE)
    c = run.s[S.C : S.C + C.SIZE]
    call("right_hand_side", run.p, c, y, run.w, f, run.s[S.ANGLE], run.s[S.SPEED], 0.0)
    return f


def test_torque_of_a_stage_is_that_behind_the_last_increment(silent):
    """Balls that slide by millimetres per second: their torque from that of the state before they did."""
    run = Run(silent, 20000).init()
    run.run(1e-3)
    balls = int(run.p[P.BALLS])
    random = np.random.default_rng(6)
    y = run.s[S.Y : S.Y + Y.SIZE].copy()
    before = evaluated(run, y)
    d = np.zeros(F.SIZE)
    # 4 mm/s at the pitch radius and on a ball, 1 mm/s at the cage, 10 um/s at the outer ring
    d[F.TH : F.TH + balls] = 0.3 / GH * random.normal(1.0, 0.5, balls)
    d[F.WX : F.WX + balls] = 1.5 / GH * random.normal(1.0, 0.5, balls)
    d[F.BODY + Q.CAGE + Q.TURN] = 0.1 / GH
    d[F.BODY + Q.OUTER + Q.TURN] = 1e-3 / GH
    for rate, at in ((Y.OM, F.TH), (Y.WX, F.WX)):
        y[rate : rate + STRIDE] += GH * d[at : at + STRIDE]
    for body in (Q.OUTER, Q.CAGE):
        y[Y.V0 + body + Q.TURN] += GH * d[F.BODY + body + Q.TURN]
        y[Y.Q0 + body + Q.TURN] += GH**2 * d[F.BODY + body + Q.TURN]
    behind = evaluated(run, y)
    run.w[W.F : W.F + F.SIZE], run.w[W.D : W.D + F.SIZE] = before, d
    kept = behind.copy()
    kept[F.WORK :] = np.nan
    speed = run.s[S.SPEED]
    turn = F.BODY + Q.OUTER + Q.TURN
    gained = run.p[P.OUTER_POLAR] * (kept[turn] - run.w[W.F + turn])
    complete_torque(run.p, run.s[S.C : S.C + C.SIZE], speed, GH, gained, kept, run.w)
    change = behind[F.TORQUE] - before[F.TORQUE]
    assert abs(change) > 0.1 * abs(before[F.TORQUE])
    # balls are up to 10 um from the pitch circle of 13 mm at whose radius their orbit is counted: 8e-4
    assert kept[F.TORQUE] == pytest.approx(behind[F.TORQUE], abs=2e-3 * abs(change))
    assert kept[F.WORK] - before[F.WORK] == pytest.approx(speed * (kept[F.TORQUE] - before[F.TORQUE]))
    np.testing.assert_array_equal(kept[F.HEAT : F.TORQUE], before[F.HEAT : F.TORQUE])


def test_size_of_an_increment(w):
    p, c = np.zeros(P.TABLES), np.zeros(C.SIZE)
    p[P.LANES], p[P.PITCH_RADIUS], c[C.BALL_RADIUS] = LANES, 0.013, 0.002
    d = area(w, W.D)
    rows, bodies = parts(d)
    mean = (rows**2).sum(1) / LANES
    tilts = np.isin(np.arange(Q.SIZE), [3, 4, 8, 9, 10, 14, 15, 16])
    weights = np.where(tilts, 0.013, 1.0)
    square = ((weights * bodies) ** 2).sum() + 0.03 * mean[:2].sum()
    square += (0.1 * 0.013) ** 2 * mean[2] + (0.03 * 0.002) ** 2 * mean[3:].sum()
    assert newton_size(p, c, d, -2.0) == pytest.approx(2.0 * np.sqrt(square), rel=1e-14)


def test_error_estimate_of_an_explicit_step_by_hand(silent):
    """Classical Runge-Kutta and its companion differ by h / 6 (k4 - k5), k5 at the step's end.

    Over what is allowed: a tenth of the tolerance, which goes with the rings' root mean square velocity,
    within a tenth and four times 5 um at the shaft's speed.
    """
    run = Run(silent, 20000, METHOD=3.0, TOLERANCE=1e-4).init()
    run.run(1e-4)
    motion, square, steps = Motion(run), run.s[S.RING_SQUARE], run.s[S.STEPS]
    y, h = motion.start, 2e-7
    k1 = motion.rate(0.0, y)
    k2 = motion.rate(0.5 * h, y + 0.5 * h * k1)
    k3 = motion.rate(0.5 * h, y + 0.5 * h * k2)
    k4 = motion.rate(h, y + h * k3)
    k5 = motion.rate(h, y + h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4))
    apart = h / 6.0 * (k4 - k5)
    d = np.zeros(F.SIZE)
    d[: F.BODY], d[F.BODY : F.WORK] = apart[Y.VX : Y.Q0], apart[Y.V0 : Y.SIZE]
    size = newton_size(run.p, run.s[S.C : S.C + C.SIZE], d, 1.0)
    usual = 1e-4 * 5e-6 * run.s[S.SPEED]
    allowed = 0.1 * min(4.0 * usual, max(0.1 * usual, 1e-4 * np.sqrt(square)))
    assert run.step(h) == OK and run.s[S.STEPS] == steps + 1
    assert run.w[W.REPORT + W.ERROR] == pytest.approx(size / allowed, rel=1e-6)


@pytest.mark.parametrize("n", [3, 17, 24])
def test_scaled_sums_touch_what_they_are_asked_to(w, n):
    x, out = w[1:60].copy(), w[100:160].copy()
    y = out.copy()
    add_scaled(0.3, x, out, n)
    np.testing.assert_array_equal(out, [*(y[:n] + 0.3 * x[:n]), *y[n:]])
    sum_scaled(x, 0.7, y, out, n)
    np.testing.assert_array_equal(out[:n], x[:n] + 0.7 * y[:n])


def test_scratch_does_not_get_into_the_state(silent):
    """Stages fill lanes in use alone: beyond them the work space holds anything, and the state zeros."""
    clean, dirty = Run(silent, 20000).init(), Run(silent, 20000).init()
    for _ in range(3):
        dirty.w[:] = 7.0
        assert clean.step(1e-4) == dirty.step(1e-4) == OK
    np.testing.assert_array_equal(clean.s[: S.C], dirty.s[: S.C])
    lanes = int(clean.p[P.LANES])
    for first, rows in ((S.Y, 9), (S.F, 6)):
        assert not dirty.s[first : first + rows * STRIDE].reshape(rows, STRIDE)[:, lanes:].any()
