"""Fidelity `rings`: its equations written slowly, convergence with the step, and how it fails."""

import numpy as np
import pytest
from scipy.integrate import solve_ivp

from fmu_bearing.engine.fidelities.condensed.balls import set_angles
from fmu_bearing.engine.layout import STRIDE, C, H, L, P, S, T, Y
from fmu_bearing.engine.status import OK
from tests.engine.condensed import FIDELITIES, Slow, block, march, silent
from tests.engine.helpers import Run, quiet


@pytest.mark.parametrize("theta", [-3.0, 0.0, 1e-9, 2.7])
def test_race_heights_are_those_of_the_tables_cubics(scene, theta):
    run = Run(silent(scene("7009C-full-ceramic")), 18000, FIDELITY=1.0).init()
    slow, lv, w = Slow(run), block(run), run.w
    inner, outer, speed = 2.2, -1e-3, 1885.0
    set_angles(run.p, run.s[S.C : S.C + C.SIZE], lv, theta, 0.0, inner, outer, speed, w)
    orbit = lv[L.RATIO] * speed
    for j in range(slow.balls):
        here = theta + 2 * np.pi * j / slow.balls
        angle = here + slow.tau * orbit
        # angles are rounded at 1e-15 rad, the steepest slope is some 1e-5 m/rad
        assert w[T.COS + j] == pytest.approx(np.cos(angle), abs=1e-14)
        assert w[T.SIN + j] == pytest.approx(np.sin(angle), abs=1e-14)
        size = 0.5 * run.p[int(run.p[P.AT_OVERSIZE]) + j]
        for race, (turned, rate) in enumerate(((inner, orbit - speed), (outer, orbit))):
            row = race * STRIDE + j
            height = size + slow.height(race, here - turned, slow.tau * rate)
            assert w[T.INNER + row] == pytest.approx(height, abs=1e-18)


@pytest.mark.parametrize(
    ("name", "rpm", "kilohertz"), [("7003C-spindle", 20000, 21.9), ("7009C-full-ceramic", 9000, 4.6)]
)
def test_balls_swing_across_their_tracks(scene, name, rpm, kilohertz):
    """Frequency between held races; how balls at rest follow axial motion, by SciPy's places of rest."""
    run = Run(quiet(scene(name)), rpm, FIDELITY=1.0).init()
    slow = Slow(run)
    slow.height = lambda *_: 0.0
    lv = block(run)
    assert np.sqrt(lv[L.SIDE_SQUARE]) / (2e3 * np.pi) == pytest.approx(kilohertz, rel=0.01)
    assert np.linalg.norm(lv[L.SIDE : L.SIDE + 2]) == pytest.approx(1.0, rel=1e-12)
    move = 1e-8
    places = []
    for inner, outer in ((0.0, 0.0), (move, 0.0), (0.0, move)):
        q = lv[L.Q0 : L.Q0 + L.N].copy()
        q[0] += inner
        q[5] += outer
        slow.accelerations(0.0, q, np.zeros(L.N))
        places.append(np.mean(slow.places, axis=0))
    for k, moved in enumerate(places[1:]):
        follow = (moved - places[0]) / move
        # nothing left but the weights, which load the balls unequally by a thousandth
        np.testing.assert_allclose(
            slow.families[0].follow[:, k].real, follow, atol=5e-3 * np.abs(follow).max()
        )


@pytest.mark.heavy
def test_rings_against_scipy(scene):
    """0.2 ms by Radau on the same equations written slowly; velocities within 1e-4 of what they move.

    Four swings of the balls across their tracks and five periods of the inner ring's fastest mode.

    Steps of 2.5 us: at 20 us the first velocities after a start carry Newmark's h^2/12 term, 5e-3 here.
    """
    run = Run(silent(scene("7003C-spindle")), 20000, FIDELITY=1.0, MAX_STEP=2.5e-6).init()
    slow = Slow(run)
    lv = block(run)
    now = lv[L.MODES_NOW : L.MODES_NOW + L.BOTH]
    modes = np.concatenate([now[re] + 1j * now[im] for re, im in (one.now for one in slow.families)])
    start = np.concatenate([lv[L.Q0 : L.Q0 + L.N], lv[L.V0 : L.V0 + L.N], modes.real, modes.imag])
    rings, count = 2 * L.N, len(modes)

    def rate(t, y):
        z = y[rings : rings + count] + 1j * y[rings + count :]
        found = slow.accelerations(t, y[: L.N], y[L.N : rings], z)
        turned = found[L.N :]
        return np.concatenate([y[L.N : rings], found[: L.N].real, turned.real, turned.imag])

    # accelerations agree to the first-order treatment of the balls, so the solution may differ no more
    first = rate(0.0, start)
    np.testing.assert_allclose(first[L.N : rings], lv[L.A0 : L.A0 + L.N], atol=2e-2, rtol=1e-2)
    # friction decays within a microsecond: an implicit method. The Jacobian of the start serves to the end:
    # motions are small, and an iteration costs a 40th of a new one.
    moves = np.concatenate([np.full(L.N, 1e-10), np.full(L.N, 1e-5), np.full(2 * count, 1e-10)])
    slopes = np.column_stack(
        [
            (rate(0.0, start + move * one) - first) / move
            for move, one in zip(moves, np.eye(len(start)), strict=True)
        ]
    )
    least = 0.1 * moves
    exact = solve_ivp(rate, (0.0, 2e-4), start, method="Radau", rtol=1e-4, atol=least, jac=slopes).y[:, -1]
    run.run(2e-4, 2e-5)
    translations = [0, 1, 2, 5, 6, 7]
    velocities = run.s[S.Y + Y.V0 :][translations]
    moved = np.abs(exact[L.N : rings][translations]).max()
    np.testing.assert_allclose(velocities, exact[L.N : rings][translations], atol=1e-4 * moved)


def test_rings_converge_with_the_step(scene):
    """A tighter tolerance shortens the steps by the method's estimate and lowers the error in proportion."""
    ends = []
    for tolerance, longest in ((1e-2, 2e-5), (1e-4, 2e-5), (1e-6, 2.5e-6)):
        run = Run(
            silent(scene("7009C-full-ceramic")), 18000, FIDELITY=1.0, TOLERANCE=tolerance, MAX_STEP=longest
        ).init()
        run.run(0.04)
        ends.append(run.run(0.005)[:, :6])
    coarse, fine = (np.sqrt(((end - ends[2]) ** 2).mean() / (ends[2] ** 2).mean()) for end in ends[:2])
    assert coarse < 1e-2
    # 100 times the tolerance; what remains is the balls' first-order forces, 1e-4 of the motion: 3.8e-4
    assert fine < 5e-4


@pytest.mark.parametrize(("name", "rpm"), [("7003C-spindle", 20000), ("7009C-full-ceramic", 18000)])
def test_rings_error_of_the_default_step(scene, name, rpm):
    """Settled velocities within 2e-3 (rms) of those with steps an eighth as long and a tight tolerance.

    Measured 3e-4 and 1.3e-3: both scenes vibrate at a resonance, 20 and 10 mm/s.
    """
    rows = []
    for step, tolerance in ((2e-5, 1e-3), (2.5e-6, 1e-6)):
        run = Run(silent(scene(name)), rpm, FIDELITY=1.0, MAX_STEP=step, TOLERANCE=tolerance).init()
        run.run(0.04)
        rows.append(run.run(0.01)[:, :6])
    error = np.sqrt(((rows[0] - rows[1]) ** 2).mean()) / np.sqrt((rows[1] ** 2).mean())
    assert error < 2e-3


def test_a_new_jacobian_changes_nothing(scene):
    """A Jacobian renewed in full motion leaves the motion as it was."""
    rows = []
    for renewed in (False, True):
        run = Run(silent(scene("7009C-full-ceramic")), 18000, FIDELITY=1.0, MAX_STEP=5e-6).init()
        run.run(0.005)
        before = run.s[S.JACOBIANS]
        if renewed:
            march(run)[H.CONTRACTION] = 1.0
        rows.append(run.run(0.005)[:, :6])
        assert run.s[S.JACOBIANS] - before == renewed
    # both solve the same equations to the step's tolerance, 1e-4 of the motion at 5 us
    np.testing.assert_allclose(rows[0], rows[1], atol=1e-4 * np.abs(rows[0]).max())


def test_a_start_without_preload_is_found(scene):
    """Without preload the centrifugal force takes every ball off the inner race: rings hang in the balls."""
    run = Run(silent(scene("7003C-bare")), 104_000, preload=0.0, FIDELITY=FIDELITIES["rings"]).init()
    for _ in range(10):
        assert run.step(1e-4) == OK
    assert np.abs(run.z[:6]).max() < 0.1  # m/s


def test_balls_that_jump_to_and_fro_come_to_rest(scene):
    """Loose balls in wavy races at 20,000 r/min: whole Newton steps alone find no rest after 0.3 ms."""
    run = Run(silent(scene("7003C-bare")), 20_000, preload=1.0, FIDELITY=FIDELITIES["rings"]).init()
    for _ in range(20):
        assert run.step(1e-4) == OK
    assert np.abs(run.z[:6]).max() < 0.03  # m/s: loose balls rattle with the height of the waves


def test_late_times_and_odd_steps_end(scene):
    """Steps of a few rounding errors of the time are taken, not divided by zero."""
    run = Run(silent(scene("7003C-bare")), 20_000, FIDELITY=1.0).init()
    run.s[S.TIME] = 1e5
    for h in (1e-3, 1e-10, 1e-3):
        assert run.step(h) == OK
        assert np.isfinite(run.z).all()
