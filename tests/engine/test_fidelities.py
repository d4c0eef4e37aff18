"""Fidelities `rings` and `response`: against fidelity full, quasi-static theory, at their limits."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import STRIDE, P, U, Y, Z
from fmu_bearing.engine.status import OK
from tests.engine.condensed import FIDELITIES, silent, vibration
from tests.engine.helpers import RPM, Run, quiet


# Gates are shares by which (inner, outer) may differ, about twice what was measured. 7003C-bare at 20,000:
# its outer ring answers a tenth as strongly and through the contacts' curvature, which `response` leaves out.
# 7009C: close to an axial resonance with 4 % damping, where the damping of one mode decides.
@pytest.mark.heavy
@pytest.mark.parametrize(
    ("name", "rpm", "rings", "response"),
    [
        ("7003C-bare", 10000, (0.01, 0.10), (0.02, 0.20)),
        ("7003C-bare", 20000, (0.01, 0.10), (0.02, 0.50)),
        ("7003C-spindle", 12000, (0.02, 0.02), (0.05, 0.05)),
        ("7003C-spindle", 20000, (0.02, 0.02), (0.06, 0.06)),
        ("7009C-full-ceramic", 9000, (0.10, 0.35), (0.10, 0.40)),
        ("7009C-full-ceramic", 18000, (0.10, 0.20), (0.10, 0.20)),
    ],
)
def test_vibration_is_that_of_full(scene, name, rpm, rings, response):
    figures = []
    for fidelity in (0.0, 1.0, 2.0):
        run = Run(silent(scene(name)), rpm, FIDELITY=fidelity).init()
        run.run(0.03)
        figures.append(vibration(run.run(0.08, 2e-5)))
    full = np.array(figures[0])
    assert np.all(np.abs(figures[1] / full - 1.0) <= rings)
    assert np.all(np.abs(figures[2] / full - 1.0) <= response)


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_a_perfect_bearing_is_silent_at_the_quasi_static_point(scene, fidelity):
    from tests.engine.quasistatic import solve

    perfect = quiet(scene("7003C-bare"))
    run = Run(perfect, 20000, FIDELITY=FIDELITIES[fidelity], GRAVITY=0.0).init()
    rows = run.run(0.005)
    assert np.abs(rows[-20:, :6]).max() < 1e-9
    theory = solve(perfect, 20000, perfect.mounting.preload_N)
    for side in ("inner", "outer"):
        load = run.value(f"contact.{side}.load_mean", rows)[-1]
        angle = np.degrees(run.value(f"contact.{side}.angle_mean", rows)[-1])
        assert load == pytest.approx(theory[f"load_{side[0]}"], rel=1e-3)
        assert angle == pytest.approx(theory[f"angle_{side[0]}"], rel=1e-3)
    assert run.value("energy.residual", rows)[-1] == pytest.approx(0.0, abs=1e-9)


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_turned_backwards_it_is_the_mirror_image(scene, fidelity):
    """Without gravity and waves (whose phases do not mirror), -n gives y and z velocities turned round."""
    scenes = silent(scene("7003C-bare"))
    ahead, back = (
        Run(scenes, rpm, FIDELITY=FIDELITIES[fidelity], GRAVITY=0.0, WAVINESS=0.0) for rpm in (20000, -20000)
    )
    for run in (ahead, back):
        # unbalance alone: equal balls
        first = int(run.p[P.AT_OVERSIZE])
        run.p.setflags(write=True)
        run.p[first : first + STRIDE] = 0.0
        run.p.setflags(write=False)
        run.init()
    a, b = ahead.run(2e-3), back.run(2e-3)
    size = np.abs(a[:, :6]).max()
    mirror = np.array([1.0, -1.0, 1.0, 1.0, -1.0, 1.0])
    # axial velocities, zero but for second order, are differences of 100 N forces: 1e-4 of the rest
    np.testing.assert_allclose(a[:, :6], b[:, :6] * mirror, atol=1e-4 * size)


@pytest.mark.parametrize("fidelity", FIDELITIES)
@pytest.mark.parametrize(
    ("rpm", "preload", "load"),
    [
        (0, 500.0, 0.0),
        (100, 500.0, 0.0),
        (100_000, 500.0, 0.0),
        (20_000, 0.0, 0.0),
        (0, 0.0, 0.0),
        (20_000, 500.0, -1000.0),
    ],
)
def test_extremes_stay_finite(scene, fidelity, rpm, preload, load):
    run = Run(silent(scene("7003C-bare")), rpm, preload=preload, FIDELITY=FIDELITIES[fidelity])
    run.u[U.LOAD_Z] = load
    run.init()
    for h in (1e-6, 1e-5, 1e-3, 3e-3):
        assert run.step(h) == OK
        assert np.isfinite(run.z).all()
        assert np.abs(run.z[:6]).max() < 1.0


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_inputs_may_change(scene, fidelity):
    run = Run(silent(scene("7003C-spindle")), 10000, FIDELITY=FIDELITIES[fidelity]).init()
    run.run(1e-3)
    run.u[U.SPEED] = 20000 * RPM
    run.u[U.PRELOAD] = 300.0
    run.run(1e-3)
    settled = Run(silent(scene("7003C-spindle")), 20000, preload=300.0, FIDELITY=FIDELITIES[fidelity]).init()
    for name in ("friction_torque", "cage.speed_ratio"):
        assert run.value(name) == pytest.approx(settled.value(name), rel=2e-3)


@pytest.mark.parametrize("fidelity", FIDELITIES)
@pytest.mark.parametrize("rpm", [20_000, -9_000, 5])
def test_heats_are_torque_times_speed(scene, fidelity, rpm):
    """By construction of these fidelities; also the torques by source add up to it."""
    run = Run(silent(scene("7003C-bare")), rpm, FIDELITY=FIDELITIES[fidelity]).init()
    run.run(1e-3)
    friction = run.value("friction_torque")
    heats = sum(run.value(f"heat.{part}") for part in ("inner_ring", "outer_ring", "oil"))
    sources = sum(
        run.value(f"friction_torque_share.{part}") for part in ("contacts", "rolling", "cage", "drag")
    )
    assert heats > 0.0
    assert heats == pytest.approx(friction * rpm * RPM, rel=1e-9)
    assert sources == pytest.approx(friction, rel=1e-9)


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_balls_that_carry_nothing_have_no_false_rates(scene, fidelity):
    """Standstill without preload: no ball is faster than what the rings and gravity do in 4 ms, 0.04 m/s."""
    run = Run(silent(scene("7003C-bare")), 0, preload=0.0, FIDELITY=FIDELITIES[fidelity]).init()
    for h in (1e-6, 1e-5, 1e-3, 3e-3):
        assert run.step(h) == OK
        balls = run.z[Z.BALLS : Z.BALLS + 3 * int(run.p[P.BALLS])]
        assert np.abs(balls).max() < (0.05 if fidelity == "rings" else 1e-12)


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_balls_move_in_their_races(scene, fidelity):
    """Loaded balls do have rates across the track: those of full at the same place within a third."""
    run = Run(silent(scene("7003C-spindle")), 12_000, FIDELITY=FIDELITIES[fidelity])
    run.u[U.LOAD_Z] = -300.0
    run.init()
    full = Run(silent(scene("7003C-spindle")), 12_000)
    full.u[U.LOAD_Z] = -300.0
    full.init()
    sizes = []
    places = [Y.VX, Y.VR]
    for each in (run, full):
        rates = []
        for _ in range(100):
            assert each.step(1e-4) == OK
            rates.append(each.s[places])
        sizes.append(np.sqrt((np.array(rates) ** 2).mean(0)))
    np.testing.assert_allclose(sizes[0], sizes[1], rtol=0.33)


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_rings_that_lift_their_balls_go_on(scene, fidelity):
    """1 N of preload has a rest at the start; the rings' motion lifts balls off within a millisecond."""
    run = Run(silent(scene("7003C-spindle")), 60_000, preload=1.0, FIDELITY=FIDELITIES[fidelity]).init()
    for _ in range(30):
        assert run.step(1e-4) == OK
        assert np.isfinite(run.z).all()
