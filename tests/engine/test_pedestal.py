"""A pedestal that is stiffer along one axis: where rings rest on it, and how all fidelities vibrate."""

import numpy as np
import pytest

from fmu_bearing.engine.fidelities.response.lines import line_table
from fmu_bearing.engine.layout import C, L, P, Q, S, U, Y
from fmu_bearing.modal.equations.quick import operator_matrix
from tests.engine.condensed import FIDELITIES, Slow, answer, block, silent
from tests.engine.helpers import Run
from tests.oracles.cartesian_forces import turned_axes

RATIO, ANGLE = 0.4, 30.0  # stiffness along y' over the one along z', deg
OUTER = [Q.OUTER + Q.Y, Q.OUTER + Q.Z]


def on_pedestal(scene, ratio=RATIO, angle=ANGLE):
    """The spindle on such a pedestal."""
    spindle = silent(scene("7003C-spindle"))
    keys = {"pedestal_stiffness_ratio": ratio, "pedestal_axis_angle_deg": angle}
    return spindle.model_copy(update={"mounting": spindle.mounting.model_copy(update=keys)})


def unbalanced(scene, ratio, angle=ANGLE):
    """The same with nothing that excites it but the unbalance."""
    made = on_pedestal(scene, ratio, angle)
    keys = {"ball_diameter_spread_nm": 0.0, "inner_race_amplitude_um": 0.0, "outer_race_amplitude_um": 0.0}
    return made.model_copy(update={"imperfections": made.imperfections.model_copy(update=keys)})


def test_one_all_round_is_the_pedestal_without_axes(scene):
    """Any angle of equal axes: the very parameters of a scene that knows none."""
    p = Run(on_pedestal(scene, 1.0, 0.0), 20000).p
    assert (p == Run(silent(scene("7003C-spindle")), 20000).p).all()
    turned = Run(on_pedestal(scene, 1.0, 37.0), 20000).p
    np.testing.assert_allclose(turned, p, rtol=1e-15, atol=0.0)


@pytest.mark.parametrize("fidelity", ["full", "rings"])
def test_rings_rest_where_the_springs_carry_them(scene, fidelity):
    """Load and weight along both axes: the outer ring goes where two springs at an angle let it."""
    run = Run(unbalanced(scene, RATIO), 1000, FIDELITY=FIDELITIES.get(fidelity, 0.0), IMPERFECTION_SCALE=0.0)
    run.u[U.LOAD_Y], run.u[U.LOAD_Z] = 150.0, -50.0
    run.init()
    p = run.p
    mass = p[P.INNER_MASS] + p[P.OUTER_MASS] + p[P.BALLS] * p[P.BALL_MASS]
    mass += p[P.CAGE_MASS] if fidelity == "full" else 0.0  # rings knows no cage
    stiffness = turned_axes(RATIO * run.u[U.PEDESTAL], run.u[U.PEDESTAL], np.radians(ANGLE))
    wanted = np.linalg.solve(stiffness, [150.0, -50.0 - 9.81 * mass])
    found = run.s[S.Y + Y.Q0 :][OUTER]
    np.testing.assert_allclose(found, wanted, rtol=1e-3, atol=1e-9)
    assert abs(found[0] / 150.0) > 1.5 * abs(found[1] / 75.0)  # the soft way gives


def test_rings_equations_with_the_pedestals_axes(scene):
    run = Run(on_pedestal(scene), 20000, FIDELITY=1.0, MAX_STEP=2.5e-6).init()
    run.run(1e-3)
    lv = block(run)
    slow = Slow(run, RATIO, np.radians(ANGLE))
    plain = Slow(run)
    rows = [
        one.rings(0.0, np.zeros(L.N), lv[L.Q0 :][: L.N], lv[L.V0 :][: L.N], one.c) for one in (slow, plain)
    ]
    assert np.abs(rows[0] - rows[1])[OUTER].max() > 1.0  # m/s2: the axes are felt
    run = Run(on_pedestal(scene), 20000, FIDELITY=1.0, MAX_STEP=2.5e-6).init()
    lv = block(run)
    slow = Slow(run, RATIO, np.radians(ANGLE))
    found = slow.accelerations(0.0, lv[L.Q0 :][: L.N].copy(), lv[L.V0 :][: L.N].copy())
    # as in test_rings: accelerations agree to the first-order treatment of the balls
    np.testing.assert_allclose(found, lv[L.A0 : L.A0 + L.N], atol=2e-2, rtol=1e-2)


def test_response_couples_both_whirls(scene):
    """Stiffness and damping of the linear system by plain springs; the unbalance line by a dense solve.

    On equal axes the unbalance whirls forwards alone; unequal ones answer with a backward whirl as well.
    """
    speed = 15000 * np.pi / 30.0
    backward = []
    for ratio in (1.0, RATIO):
        run = Run(unbalanced(scene, ratio), 15000, FIDELITY=2.0).init()
        lv = block(run)
        matrix = operator_matrix(run)
        stiff, damp = matrix[L.N : 2 * L.N, : L.N], matrix[L.N : 2 * L.N, L.N : 2 * L.N]
        if ratio == 1.0:
            equal = stiff, damp
        own = run.p[P.OUTER_MASS]
        force = np.zeros(L.N, complex)
        push = run.s[S.C + C.ECCENTRICITY] * speed**2
        force[1], force[2] = 1j * push, push
        exact = answer(run, speed, force)
        lines = run.s[line_table(run.p) :][: int(lv[L.COUNT]) * L.LINE_SIZE].reshape(-1, L.LINE_SIZE)
        (line,) = (row for row in lines if row[0] == 0.0 and row[1] == 1.0)
        solved = line[L.LINE_REAL :][: L.N] + 1j * line[L.LINE_IMAGINARY :][: L.N]
        exact[L.TURN] = 0.0  # no line turns the outer ring
        np.testing.assert_allclose(solved, exact, atol=1e-9 * np.abs(exact).max())
        y, z = solved[OUTER]
        backward.append(abs(y - 1j * z) / abs(y + 1j * z))
    along = np.array([RATIO, 1.0]) * run.u[U.PEDESTAL]
    angle = np.radians(ANGLE)
    zeta = 2.0 * run.p[P.PEDESTAL_ZETA]
    for k, (found, axes, plain) in enumerate(
        ((stiff, along, along[1]), (damp, zeta * np.sqrt(along * own), zeta * np.sqrt(along[1] * own)))
    ):
        change = -(turned_axes(*axes, angle) - plain * np.eye(2)) / own
        # differences at two equilibria, under weights that the softer axis lets sink deeper
        size = np.abs(equal[k]).max()
        np.testing.assert_allclose(
            (found - equal[k])[np.ix_(OUTER, OUTER)], change, rtol=1e-3, atol=1e-5 * size
        )
    assert min(backward) < 0.02 < 0.2 < max(backward)


@pytest.mark.heavy
@pytest.mark.parametrize("rpm", [12000, 24000])
def test_fidelities_agree_on_such_a_pedestal(scene, rpm):
    """Unbalance alone: velocities of the outer ring along y and z, which differ, by all three fidelities."""
    found = []
    for fidelity in (0.0, 1.0, 2.0):
        run = Run(unbalanced(scene, RATIO), rpm, FIDELITY=fidelity).init()
        run.run(0.06, 1e-3)
        rows = run.run(0.05, 1e-4)[:, 3:6]
        found.append((rows - rows.mean(0)).std(0)[1:])
        if fidelity == 0.0:
            assert abs(run.imbalance) < 1e-3 * run.heat
    along_y, along_z = found[0]
    assert not 0.8 < along_y / along_z < 1.25
    # rings and response take the balls' traction as damping of modes: some per cent beside a resonance
    np.testing.assert_allclose(found[1], found[0], rtol=0.05)
    np.testing.assert_allclose(found[2], found[0], rtol=0.05)
