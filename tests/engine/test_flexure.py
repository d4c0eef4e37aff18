"""Equations of bending rings: forces of the balls, power, a free mode, samples of the motion."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import FL, MO, STRIDE, C, F, P, Q, W, X, Y
from fmu_bearing.engine.readout.motion import flexure_motion
from tests.engine.flexible import FRICTIONLESS, MODES, SCENE, Flexure, shaken, thin_ring, untouched
from tests.engine.helpers import RPM, Run


def of_lanes(w, at, count=1):
    """Rows of the work space over twelve balls."""
    rows = w[at : at + count * STRIDE].reshape(count, STRIDE)[:, :12]
    return rows[0] if count == 1 else rows


def test_groove_moves_as_the_shapes_say(problem):
    """Places and velocities of the balls against bent rings, less those against round ones, by definition."""
    one, round_rings = problem(), problem([])
    x = shaken(one)
    y, speed = one.evaluate(0.0, x)
    round_rings.evaluate(0.0, x[: one.modes_at])
    q, v = x[one.modes_at :].reshape(2, -1, 2)
    for race, spin in ((0, speed), (1, y[Y.V0 + Q.OUTER + Q.TURN])):
        pose = W.POSE + race * X.SIZE
        n, h, t = (of_lanes(round_rings.w, pose + at, 3) for at in (X.N, X.H, X.T))
        c, s = of_lanes(round_rings.w, W.COS), of_lanes(round_rings.w, W.SIN)
        phi = np.arctan2(s * h[1] + c * h[2], c * h[1] - s * h[2])
        axial, radial, vx, vr, turn = np.zeros((5, 12))
        for row, (a, b), (va, vb) in zip(MODES, q, v, strict=True):
            if row[P.MODE_BODY] == race:
                order = row[P.MODE_ORDER]
                c, s = np.cos(order * phi), np.sin(order * phi)
                shape, rate = a * c + b * s, va * c + vb * s + order * spin * (b * c - a * s)
                axial, radial = axial + row[P.MODE_X] * shape, radial + row[P.MODE_R] * shape
                vx, vr = vx + row[P.MODE_X] * rate, vr + row[P.MODE_R] * rate
                turn = turn + row[P.MODE_TILT] * rate
        for place, moved in ((X.A, axial), (X.RHO, radial)):
            found = of_lanes(round_rings.w, pose + place) - of_lanes(one.w, pose + place)
            np.testing.assert_allclose(found, moved, rtol=1e-9, atol=1e-16)  # of 1e-2 m: rounding 2e-18
        groove = C.RACES + race * C.RACE_SIZE
        sx = of_lanes(one.w, pose + X.A) - one.c[groove + C.GROOVE_X]
        sr = of_lanes(one.w, pose + X.RHO) - one.c[groove + C.GROOVE_RADIUS]
        velocity = (vx - turn * sr) * n + (vr + turn * sx) * h
        for place, moved in ((X.DV, velocity), (X.DW, turn * t)):
            before = of_lanes(round_rings.w, pose + place, 3)
            found = before - of_lanes(one.w, pose + place, 3)
            # rounding of what is subtracted, 30 m/s or 1e4 rad/s
            np.testing.assert_allclose(found, moved, rtol=1e-9, atol=1e-15 * np.abs(before).max())


@pytest.mark.parametrize("tilt", [0.0, 1.0])
def test_balls_push_on_the_modes_as_the_stored_energy_says(problem, tilt):
    """Without friction and damping the balls' forces are minus the gradient of the contacts' energy.

    The groove's circumferential motion takes no normal load with it, and a turn about the centre of the
    groove's circle none either: the gradient has no part of them.
    """
    modes = np.array(MODES)
    modes[:, P.MODE_TILT] *= tilt
    one = problem(modes, **FRICTIONLESS)
    x = shaken(one)
    found = one.contact_forces(x)
    strain = np.repeat(modes[:, P.MODE_STIFFNESS], 2)
    still = x.copy()
    still[one.modes_at + found.size :] = 0.0
    for i, force in enumerate(found):
        k, step = one.modes_at + i, 1e-10
        ahead, behind = still.copy(), still.copy()
        ahead[k] += step
        behind[k] -= step
        # kinetic energy as seen on the turning ring changes with the place too: taken away as k/2 Omega^2
        gradient = (one.energy(0.0, ahead) - one.energy(0.0, behind)) / (2.0 * step)
        row = modes[i // 2]
        turning = row[P.MODE_MASS] * (row[P.MODE_ORDER] * (one.speed, 2.0)[int(row[0])]) ** 2
        wanted = (strain[i] + turning) * still[k] - gradient
        assert abs(force) > 5.0  # N
        # rounding of an energy of 1 J over the step of 2e-10 m
        assert force == pytest.approx(wanted, abs=2e-2)


@pytest.mark.parametrize("size", [1e-7, 1e-6])
def test_power_balance(problem, size):
    """Work less heat is the rate of the stored energy, with friction, spin-up and damping of the modes."""
    one = problem(speed_rate=3e4)
    x = shaken(one, size=size)
    rate = one(0.0, x)
    work, heat = one.f[F.WORK], one.f[F.HEAT : F.HEAT + 3].sum()
    ahead, behind = [], []
    for step in (2e-8, 4e-8):
        # along the parabola of places and the tangent of rates
        curve = np.zeros_like(x)
        n, m, v = 3 * one.balls, one.modes_at, x.size - one.modes_at
        curve[:n] = rate[n : 2 * n]
        curve[3 * n : 3 * n + 17] = rate[3 * n + 17 : m]
        curve[m : m + v // 2] = rate[m + v // 2 :]
        ahead.append(one.energy(step, x + step * rate + 0.5 * step**2 * curve))
        behind.append(one.energy(-step, x - step * rate + 0.5 * step**2 * curve))
    stored = (8.0 * (ahead[0] - behind[0]) - (ahead[1] - behind[1])) / (12.0 * 2e-8)
    # rounding of some joules over 1e-7 s
    assert work - heat - stored == pytest.approx(0.0, abs=2e-8 * work)
    # the modes take part: leaving their force out would show
    forces, velocity = one.contact_forces(x), x[one.modes_at :].reshape(2, -1)[1]
    assert np.abs(forces * velocity).max() > 1e-4 * work


def test_equation_of_a_free_mode(problem):
    """The complex equation of the fixed frame, at constant spin, against the two real ones."""
    one = problem([untouched(row) for row in MODES])
    x = shaken(one)
    one.evaluate(0.0, x)
    q, v = x[one.modes_at :].reshape(2, -1)
    found = one.flexure.array(FL.A).copy()
    outer_spin = x[9 * one.balls + 17 + 8]
    for k, row in enumerate(MODES):
        n, g, mass = row[P.MODE_ORDER], row[P.MODE_GYROSCOPIC], row[P.MODE_MASS]
        spin = one.speed if row[P.MODE_BODY] == 0 else outer_spin
        spin_up = 0.0 if row[P.MODE_BODY] == 0 else one.f[F.BODY + Q.OUTER + 3]
        z, dz = q[2 * k] - 1j * q[2 * k + 1], v[2 * k] - 1j * v[2 * k + 1]
        w0_2 = row[P.MODE_STIFFNESS] / mass
        wanted = -2j * spin * (n + g) * dz - (w0_2 - n**2 * spin**2 - 2 * n * g * spin**2) * z
        wanted -= row[P.MODE_DAMPING] * (dz + 1j * n * spin * z) + 1j * n * spin_up * z
        assert found[2 * k] - 1j * found[2 * k + 1] == pytest.approx(wanted, rel=1e-12)


@pytest.mark.parametrize("rpm", [0, 20000, -60000])
def test_spin_splits_a_mode(problem, rpm):
    """Frequencies of a free inner ring in the fixed frame: -(n + g) Omega +- sqrt(w0^2 + g^2 Omega^2)."""
    row = untouched(thin_ring(0, 2, 5640.0, 0.1))
    one = problem([row], rpm=rpm)
    columns = []
    for k in range(4):
        x = one.start.copy()
        x[one.modes_at :] = np.eye(4)[k]  # the equation is linear: any size will do
        columns.append(one(0.0, x)[one.modes_at :])
    found = np.sort(np.linalg.eigvals(np.array(columns).T).imag)
    n, g, spin, free = 2, -0.8, rpm * RPM, 2.0 * np.pi * 5640.0
    split = np.hypot(free, g * spin) + np.array([1.0, -1.0]) * (n + g) * spin
    np.testing.assert_allclose(found, np.sort([*split, *-split]), rtol=1e-9)
    if rpm == 20000:
        # the design's 6 % between both waves of the 7009C inner ring, as seen on the turning ring
        assert 2 * 0.8 * spin / free == pytest.approx(0.095, abs=0.01)


def test_modes_at_rest_change_nothing_of_the_right_hand_side(problem):
    one, rigid = problem(), problem([])
    x = shaken(one)
    x[one.modes_at :] = 0.0
    one.evaluate(0.0, x)
    rigid.evaluate(0.0, x[: one.modes_at])
    np.testing.assert_array_equal(one.f, rigid.f)


def test_motion_sample_holds_the_accelerations(scene):
    run = Run(scene(SCENE), 20000, modes=MODES).init()
    run.run(1e-3, 1e-4)
    flexure = Flexure(run.p, run.w)
    rng = np.random.default_rng(3)
    flexure.array(FL.V)[:], flexure.array(FL.A)[:] = rng.normal(size=(2, flexure.count))
    first = W.MOTION + MO.FLEXURES
    sample = run.w[first : first + flexure.count]
    _, v0, a0 = flexure.state(run.s)
    h = 1e-5
    for t, wanted in ((0.0, a0), (1.0, flexure.array(FL.A))):
        flexure_motion(run.p, run.s, run.w, h, t)
        np.testing.assert_allclose(sample, wanted, rtol=1e-9)
    flexure_motion(run.p, run.s, run.w, h, 0.5)
    jump = flexure.array(FL.V) - v0
    np.testing.assert_allclose(sample, 1.5 * jump / h - 0.25 * (a0 + flexure.array(FL.A)))
