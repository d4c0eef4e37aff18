"""Order of convergence of the Runge-Kutta methods, with fixed steps and Newton's method run to rounding.

A smooth case: a perfect bearing without cage, unbalanced, its inner ring pushed once to swing. The driver
below is compiled with the engine's kernels (and kept in their cache), which takes a minute the first time.
"""

import numpy as np
import pytest

from fmu_bearing.engine.fidelities.full.methods.table import AT_ESDIRK4, AT_RK4, AT_TRBDF2, TABLEAUX
from fmu_bearing.engine.fidelities.full.runge_kutta import runge_kutta_step
from fmu_bearing.engine.jit import kernel
from fmu_bearing.engine.layout import STRIDE, TAB, A, C, F, J, S, W, Y
from fmu_bearing.engine.mechanics.equations import right_hand_side
from fmu_bearing.engine.newton.block_arrow import factor
from fmu_bearing.engine.newton.jacobian import jacobian
from tests.extremes.bearings import bearing, drive

SMOOTH = {
    "sound": None,
    "bearing.cage": None,
    "imperfections": {
        "seed": 1,
        "unbalance_um": 5.0,
        "ball_diameter_spread_nm": 0.0,
        "inner_race_amplitude_um": 0.0,
        "outer_race_amplitude_um": 0.0,
    },
}
DURATION = 6.4e-5  # s: two periods of the inner ring's fastest mode, 26 kHz
PUSH = 1e-3  # m/s


@kernel
def fixed_steps(p, c, y, axes, flexure, angle, speed, h, count, tableau, tolerance, w, jac, fac, f):
    """Advance ``y`` by ``count`` steps of ``h`` (s); number of steps that converged."""
    report = np.zeros(W.REPORT_SIZE)
    right_hand_side(p, c, y, angle, speed, 0.0, w, f)
    jacobian(p, c, y, angle, speed, 0.0, w, jac)
    gh = TABLEAUX[tableau + TAB.GAMMA] * h
    factor(p, jac, gh, gh * gh, gh * gh, fac, w)
    start = y[2 * STRIDE]
    for n in range(count):
        turned = y[2 * STRIDE] - start
        if not runge_kutta_step(
            p, c, y, f, axes, flexure, angle, speed, 0.0, h, tableau, fac, turned, tolerance, 0.1,
            True, w, report,
        ):  # fmt: skip
            return n
        for i in range(Y.SIZE):
            y[i] = w[W.STAGE + i]
        for i in range(F.SIZE):
            f[i] = w[W.LAST + i]
        angle += h * speed
    return count


@pytest.fixture(scope="module")
def swinging():
    """A settled bearing whose inner ring has just been pushed."""
    run = bearing("7003C-spindle", SMOOTH, {"rpm": 2e4}, tolerance=1e-5, max_internal_step=5e-6)
    run.initialise()
    drive(run, 0.02, 1e-3)
    run.s[S.Y + Y.V0 : S.Y + Y.V0 + 3] += PUSH
    return run


def rings_after(run, h, tableau, tolerance=1e-13):
    """Ring velocities (m/s) after ``DURATION`` in steps of ``h`` (s)."""
    s = run.s
    y = s[S.Y : S.Y + Y.SIZE].copy()
    c, axes = s[S.C : S.C + C.SIZE].copy(), s[S.AXES : S.JAC].copy()
    jac, fac, f = np.zeros(J.SIZE), np.zeros(A.SIZE), np.zeros(F.SIZE)
    rigid = np.zeros(0)  # rings without flexural modes
    count = round(DURATION / h)
    angle, speed = s[S.ANGLE], s[S.SPEED]
    w = np.zeros(W.size(run.p))
    done = fixed_steps(run.p, c, y, axes, rigid, angle, speed, h, count, tableau, tolerance, w, jac, fac, f)
    assert done == count
    return y[[Y.V0, Y.V0 + 1, Y.V0 + 2, Y.V0 + 5, Y.V0 + 6, Y.V0 + 7]]


def orders(run, tableau, steps, exact):
    """Orders of the error of the ring velocities from each step to its half."""
    errors = np.array([np.abs(rings_after(run, h, tableau) - exact).max() for h in steps])
    return np.log2(errors[:-1] / errors[1:])


@pytest.mark.heavy
def test_order_of_convergence(swinging):
    exact = rings_after(swinging, 6.25e-8, AT_ESDIRK4)
    # ESDIRK4 at 0.5 us is right to 5e-14 m/s, where rounding begins
    found = orders(swinging, AT_ESDIRK4, [2e-6, 1e-6, 5e-7], exact)
    assert found == pytest.approx(4.0, abs=0.2)
    found = orders(swinging, AT_TRBDF2, [2e-6, 1e-6, 5e-7, 2.5e-7], exact)
    assert found == pytest.approx(2.0, abs=0.01)
    # Traction at 20,000 r/min is stable below 1.4 us only, and the order is not yet reached at 0.8 us; at
    # 0.2 us the error is 9e-15 m/s and rounding up to a quarter of it, which takes 0.3 off the order.
    found = orders(swinging, AT_RK4, [4e-7, 2e-7], exact)
    assert found == pytest.approx(4.0, abs=0.5)
