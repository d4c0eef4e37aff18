"""Linear equations against the engine's own Jacobian, and against the axes that orbit with the balls."""

import numpy as np
import pytest

from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import STRIDE, C, J, Q, S, U, Y
from fmu_bearing.modal.equations.coordinates import Coordinates
from fmu_bearing.modal.equations.linearised import linearised
from fmu_bearing.modal.equations.plain import Plain

RPM = np.pi / 30.0
PLACES, STATES = 3, 9


@pytest.fixture(scope="module")
def system(gate):
    return linearised(gate("7003C-bare").with_rigid_rings(), {U.SPEED: 10_000 * RPM}).bearings[0]


def engine_jacobian(bearing):
    """Blocks of the engine's analytic Jacobian as one matrix, in the order of `Coordinates`, ball by ball."""
    balls, n = Coordinates.of(bearing.p).balls, Coordinates.of(bearing.p).size
    jac, w = np.zeros(J.SIZE), np.zeros(bearing.w.size)
    c, y = bearing.s[S.C : S.C + C.SIZE].copy(), bearing.s[S.Y : S.Y + Y.SIZE].copy()
    call("jacobian", bearing.p, c, y, w, jac, 0.0, float(bearing.u[U.SPEED]), 0.0)
    found = np.zeros((n, n))
    rings, rates = STATES * balls, STATES * balls + Q.RINGS
    for k in range(PLACES * balls):
        found[k, PLACES * balls + k] = 1.0
    found[rings:rates, rates:] = np.eye(Q.RINGS)
    for j in range(balls):
        own = np.arange(STATES) * balls + j
        for i in range(J.BALL):
            row = (PLACES + i) * balls + j
            for k in range(STATES):
                found[row, own[k]] = jac[J.B + (i * J.STATES + k) * STRIDE + j]
            for k in range(Q.RINGS):
                found[row, rings + k] = jac[J.C + (i * J.BODIES + k) * STRIDE + j]
                found[row, rates + k] = jac[J.C + (i * J.BODIES + Q.SIZE + k) * STRIDE + j]
        for i in range(Q.RINGS):
            for k in range(STATES):
                found[rates + i, own[k]] = jac[J.D + (i * J.STATES + k) * STRIDE + j]
    for i in range(Q.RINGS):
        for k in range(Q.RINGS):
            found[rates + i, rings + k] = jac[J.E + i * J.BODIES + k]
            found[rates + i, rates + k] = jac[J.E + i * J.BODIES + Q.SIZE + k]
    return found


def test_differences_are_the_derivatives_of_the_engine(system):
    """In units in which motions weigh equally; the engine's Jacobian leaves small parts of traction out."""
    plain = Plain(system.arrays, system.coordinates)
    own, other = plain.derivatives(), engine_jacobian(system.arrays)
    step = plain.steps()
    scaled, engine = (matrix * step / step[:, None] for matrix in (own, other))
    assert np.abs(scaled - engine).max() < 5e-3 * np.abs(engine).max()
    # what presses: accelerations of the balls along x and r by all places
    rows = slice(PLACES * 12, 5 * 12)
    assert scaled[rows, : 2 * 12] == pytest.approx(engine[rows, : 2 * 12], abs=1e-3 * np.abs(engine).max())


def test_fixed_axes_have_the_eigenvalues_of_orbiting_axes(gate, system):
    """Pairs of the rings turned back with the orbit: A - n w_c S on places and rates."""
    at = system.coordinates
    plain = Plain(system.arrays, at).derivatives()
    for first in (at.rings, at.ring_rates):
        for i in (Q.Y, Q.INNER_BY, Q.OUTER + Q.Y, Q.OUTER + Q.BY):
            plain[first + i, first + i + 1] += system.orbit
            plain[first + i + 1, first + i] -= system.orbit
    orbiting = np.linalg.eigvals(plain)
    fixed = np.linalg.eigvals(system.matrix)
    for value in fixed[fixed.imag > 2 * np.pi * 1e3]:
        shifted = value + 1j * np.arange(-6, 7) * system.orbit
        apart = np.abs(shifted[:, None] - orbiting).min()
        assert apart < 1e-5 * abs(value)


def test_equal_loads_need_one_phase_and_unequal_ones_six(gate, system):
    assert system.equal_loads and len(system.phases) == 1
    loaded = linearised(gate("7003C-bare"), {U.SPEED: 1000.0, U.LOAD_Z: -100.0})
    assert not loaded.equal_loads and len(loaded.phases) == 6
    # one pitch on, the balls are where their neighbours were: the mean covers the whole pitch
    assert np.ptp(loaded.phases, axis=0).max() > 0.0


@pytest.mark.parametrize(
    ("name", "load", "tilt"),
    [("7003C-spindle", -100.0, 0.4), ("7003C-bare", -200.0, 0.0), ("7009C-full-ceramic", -300.0, 0.0)],
)
def test_phases_are_those_of_a_new_start_with_loads_turned_back(gate, name, load, tilt):
    """Interpolated round the bearing: 3e-6 of a frequency, where phases of the 7009C differ by 8e-4.

    The new start has its first ball at 12 o'clock; loads and seat (``tilt``: misalignment in mrad) are turned
    back by what the balls are ahead. Seen from the balls both are the same, so eigenvalues are equal.
    """

    def start(turn):
        c, s = np.cos(turn), np.sin(turn)
        tilts = dict(zip(("y", "z"), (c * tilt, -s * tilt), strict=True))
        keys = {f"mounting.misalignment_{axis}_mrad": float(value) for axis, value in tilts.items()}
        given = gate(name, **keys)
        return linearised(given, {U.SPEED: 1000.0, U.LOAD_Y: s * load, U.LOAD_Z: c * load})

    system = start(0.0)
    pitch = 2.0 * np.pi / system.bearings[0].coordinates.balls
    apart = []
    for k in range(1, len(system.phases)):
        values = np.linalg.eigvals(system.phases[k])
        swings = values[(values.imag > 2e3) & (-values.real < 0.2 * abs(values))]
        others = np.linalg.eigvals(start(pitch * k / len(system.phases)).phases[0])
        apart.append(max(abs(others - value).min() / abs(value) for value in swings))
        assert len(swings) >= 9
    assert max(apart) < 1e-5


def test_a_pedestal_of_two_stiffnesses_still_has_constant_coefficients(gate):
    scene = gate("7003C-spindle", **{"mounting.pedestal_stiffness_ratio": 2.0})
    loads = {U.SPEED: 1000.0, U.LOAD_Z: -1e-3}  # enough to ask for six phases
    system = linearised(scene, loads).bearings[0]
    at = system.coordinates
    rings = np.ix_(range(at.ring_rates, at.flexure), range(at.rings, at.ring_rates))
    y, z = (system.matrix[at.ring_rates + k, at.rings + k] for k in (Q.OUTER + Q.Y, Q.OUTER + Q.Z))
    apart = abs(y - z)
    assert apart > 0.05 * abs(z)
    # with a seat that turns with the balls the phases differ by 0.4 of the difference of y and z
    assert np.ptp(system.phases, axis=0)[rings].max() < 1e-5 * apart


def test_the_state_is_steady(system):
    """What is equal for all balls does not accelerate any more."""
    at = system.coordinates
    rates = Plain(system.arrays, at).rates()
    means = [rates[at.ball_state(kind)].mean() for kind in range(PLACES, STATES)]
    # a thousandth of what weight would do to them
    assert np.abs(means[:2]).max() < 1e-2
    assert np.abs(rates[at.ring_rates : at.flexure]).max() < 1e-2


def test_weight_counts_as_a_load_where_the_scene_has_it(gate):
    light = linearised(gate("7003C-spindle"))
    heavy = linearised(gate("7003C-spindle").replace({"fidelity.terms.gravity": True}))
    assert light.equal_loads and not heavy.equal_loads
