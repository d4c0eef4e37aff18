"""Fidelity `response`: the sum of its lines, a dense solve, and changes of load and speed."""

import numpy as np
import pytest

from fmu_bearing.engine.fidelities.response.lines import line_table
from fmu_bearing.engine.layout import STRIDE, C, L, S, U
from fmu_bearing.engine.status import OK
from tests.engine.condensed import answer, block, silent, vibration
from tests.engine.helpers import RPM, Run


def test_steps_do_not_matter_to_response(scene):
    """Phases are exact: any division into steps gives the same velocities."""
    rows = []
    for count in (1, 50):
        run = Run(silent(scene("7003C-bare")), 20000, FIDELITY=2.0).init()
        rows.append(run.run(5e-3, 5e-3 / count)[-1, :6])
    np.testing.assert_allclose(rows[0], rows[1], atol=1e-9 * np.abs(rows[0]).max())


def table(run, count):
    """Lines of a run, one row each."""
    return run.s[line_table(run.p) :][: count * L.LINE_SIZE].reshape(-1, L.LINE_SIZE)


def test_response_is_the_sum_of_its_lines(scene):
    """Displacements, velocities and accelerations by NumPy at the angles in the state, after a long run."""
    form = np.array([0.0, 20e-9, 5e-9])
    run = Run(silent(scene("7003C-spindle")), 20000, ball_waves=form, FIDELITY=2.0)
    run.u[U.LOAD_Z] = -1000.0
    run.init()
    lv = block(run)
    for h in [1.0] * 300 + [1e-3] * 7:
        assert run.step(h) == OK
    count = int(lv[L.COUNT])
    assert count > STRIDE  # more than one row of phases
    assert max(abs(lv[L.THETA]), abs(lv[L.ROLLED])) <= np.pi  # 1e5 turns later
    lines = table(run, count)
    real, imaginary = (lines[:, at : at + L.N] for at in (L.LINE_REAL, L.LINE_IMAGINARY))
    speed = run.s[S.SPEED]
    turns = lines[:, [L.LINE_BALL, L.LINE_SHAFT, L.LINE_ROLLED]]
    assert (abs(turns).max(0) > 1.0).all()
    omega = 1j * speed * turns @ [lv[L.RATIO], 1.0, lv[L.ROLL]]
    angles = [lv[L.THETA], run.s[S.ANGLE], lv[L.ROLLED]]
    moving = (real + 1j * imaginary) * np.exp(1j * turns @ angles)[:, None]
    for at, power in ((L.Q0, 0), (L.V0, 1), (L.A0, 2)):
        each = omega[:, None] ** power * moving
        exact = each.real.sum(0) + (lv[L.MEAN : L.MEAN + L.N] if power == 0 else 0.0)
        # phases of up to 72 half turns are rounded at 3e-14
        np.testing.assert_allclose(lv[at : at + L.N], exact, rtol=0, atol=1e-12 * np.abs(each).sum(0).max())


def test_response_against_a_dense_solve(scene):
    """The unbalance line against NumPy's complex solve with the matrices of the engine."""
    run = Run(silent(scene("7003C-spindle")), 20000, FIDELITY=2.0).init()
    speed = 20000 * RPM
    force = np.zeros(L.N, complex)
    push = run.s[S.C + C.ECCENTRICITY] * speed**2
    force[1], force[2] = 1j * push, push
    exact = answer(run, speed, force)
    lines = table(run, int(block(run)[L.COUNT]))
    (line,) = (row for row in lines if row[0] == 0.0 and row[1] == 1.0)
    solved = line[L.LINE_REAL :][: L.N] + 1j * line[L.LINE_IMAGINARY :][: L.N]
    exact[L.TURN] = 0.0  # no line turns the outer ring
    np.testing.assert_allclose(solved, exact, atol=1e-9 * np.abs(exact).max())


def test_response_follows_rings_under_radial_load(scene):
    """300 N radial: unequal balls, varying compliance and cross terms; the same class as without."""
    figures = []
    for fidelity in (1.0, 2.0):
        run = Run(silent(scene("7003C-spindle")), 12000, FIDELITY=fidelity)
        run.u[U.LOAD_Z] = -300.0
        run.init()
        run.run(0.03)
        figures.append(vibration(run.run(0.05, 5e-5)))
    np.testing.assert_allclose(figures[1], figures[0], rtol=0.25)


@pytest.mark.parametrize(("name", "rpm"), [("7003C-bare", 20_000), ("7009C-full-ceramic", 18_000)])
def test_response_after_a_step_of_the_load_is_that_of_a_start_under_it(scene, name, rpm):
    """3 kN radial: balls turn by rounds while the lines are renewed and must be found again, however far."""
    settled = Run(silent(scene(name)), rpm, FIDELITY=2.0)
    settled.u[U.LOAD_Z] = -3000.0
    settled.init()
    most = settled.run(2e-3, 2e-5)
    run = Run(silent(scene(name)), rpm, FIDELITY=2.0).init()
    run.run(1e-3)
    run.u[U.LOAD_Z] = -3000.0
    assert run.step(1e-4) == OK
    run.run(0.2, 1e-3)  # in pieces: see `renewal`; cage and balls under so high a load take most of them
    for h in (1e-4, 1e-4, 1e-3, 1e-3):
        assert run.step(h) == OK
        for side in ("inner", "outer"):
            loads = settled.value(f"contact.{side}.load_max", most)
            assert 0.9 * loads.min() <= run.value(f"contact.{side}.load_max") <= 1.1 * loads.max()
    np.testing.assert_allclose(
        block(run)[L.MEAN :][: L.N], block(settled)[L.MEAN :][: L.N], atol=1e-9, rtol=1e-6
    )


def test_response_follows_a_ramp_from_standstill(scene):
    """After 0 to 100,000 r/min within one step, amplitudes are those of a start at that speed."""
    scenes = silent(scene("7003C-spindle"))
    run = Run(scenes, 0, FIDELITY=2.0).init()
    run.u[U.SPEED] = 100_000 * RPM
    assert run.step(1e-3) == OK
    fresh = Run(scenes, 100_000, FIDELITY=2.0).init()
    moving, settled = (vibration(r.run(2e-3, 2e-5)) for r in (run, fresh))
    assert min(settled) > 0.0
    # 2 ms are no whole number of turns of the cage
    np.testing.assert_allclose(moving, settled, rtol=0.1)


def test_response_follows_a_steady_ramp(scene):
    """A ramp whose rate does not change leaves the speed that the lines were made for all the same.

    By 5,000 r/min per s, it moves by 1.4 % while lines serve, which are made for the middle of that: 0.69 %
    off at most, measured, and 0.94 % at the first renewal.
    """
    run = Run(silent(scene("7003C-spindle")), 10_000, FIDELITY=2.0).init()
    for i in range(1, 201):
        run.u[U.SPEED] = (10_000 + 5 * i) * RPM
        assert run.step(1e-3) == OK
        assert block(run)[L.FROZEN_SPEED] == pytest.approx(run.u[U.SPEED], rel=0.01)
    assert block(run)[L.FROZEN_SPEED] > 10_800 * RPM
