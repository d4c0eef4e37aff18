"""Options of level full over milliseconds: traction, springs, rigid preload, misalignment, outputs."""

import numpy as np
import pytest

from fmu_bearing.engine import layout as at
from tests.engine.helpers import Run, quiet
from tests.engine.lubrication import film_places

pytestmark = pytest.mark.heavy
NAME = "7003C-spindle"


def lubricated(scene, law, rpm=20000):
    run = Run(scene, rpm)
    run.p = film_places(scene, run.p.copy(), law)
    run.p.setflags(write=False)  # a writable array is another type, which would compile the engine anew
    return run


@pytest.mark.parametrize("law", ["eyring", "paper"])
def test_every_traction_law_runs(scene, law):
    run = lubricated(scene(NAME).model_copy(update={"sound": None}), law).init()
    rows = run.run(0.01)
    assert np.isfinite(rows).all()
    assert abs(run.imbalance) < 1e-3 * run.heat
    ratio = run.value("cage.speed_ratio", rows)
    if law == "eyring":  # drives the balls at the kinematic speed, as the regularised law does
        assert np.abs(ratio[20:] - 0.42).max() < 0.01


@pytest.mark.parametrize("stiffness", [1e5, 5e6, 2.5e7])
def test_springs_hold_the_balls_apart(scene, stiffness):
    one = scene(NAME).model_copy(update={"sound": None})
    run = Run(one, 20000, P_CAGE=0.0, P_SPRINGS=stiffness, P_SPRING_DAMPING=10.0).init()
    run.run(0.01)
    balls = int(run.p[at.P_BALLS])
    theta = np.unwrap(run.s[2 * at.STRIDE :][:balls])
    apart = np.diff([*theta, theta[0] + 2 * np.pi]) - 2 * np.pi / balls
    apart = (apart + np.pi) % (2 * np.pi) - np.pi
    assert np.abs(apart).max() < 1e-3
    assert abs(run.imbalance) < 1e-3 * run.heat


def axial_load(scene, rpm, rigid, inner=293.15):
    """Axial load (N) of the inner contacts, mean over the last 2 of 5 ms."""
    run = Run(quiet(scene(NAME)), rpm, P_RIGID=float(rigid))
    run.u[at.U_INNER_T] = inner
    rows = run.init().run(0.005)[-20:]
    # energy over a few milliseconds without imperfections: the heat is small, the gate is of its size
    assert abs(run.imbalance) < 1e-3 * run.heat
    load, angle = (run.value(f"contact.inner.{name}", rows) for name in ("load_mean", "angle_mean"))
    return (run.p[at.P_BALLS] * load * np.sin(angle)).mean()


def test_rigid_preload_grows_with_speed_and_heat(scene):
    """Balls pressed outwards and a warm inner ring push the rings apart; a rigid mount does not let them."""
    slow, middle, fast = (axial_load(scene, rpm, True) for rpm in (100, 20000, 40000))
    assert slow == pytest.approx(500.0, rel=1e-3)
    # centrifugal force grows with the square of the speed; friction adds some newtons axially at most
    assert fast - slow > 3.0 * (middle - slow) > 0.0
    assert axial_load(scene, 20000, True, inner=303.15) > 1.05 * middle


@pytest.mark.parametrize(("rpm", "inner"), [(40000, 293.15), (20000, 303.15)])
def test_constant_force_stays(scene, rpm, inner):
    assert axial_load(scene, rpm, False, inner) == pytest.approx(500.0, rel=5e-3)


def test_rigid_preload_moves_with_its_input(scene):
    run = Run(quiet(scene(NAME)), 20000, P_RIGID=1.0).init()
    run.run(0.002)
    before, load = run.value("inner_ring.displacement.x"), run.value("contact.inner.load_mean")
    run.u[at.U_PRELOAD] *= 0.5
    assert run.step(1e-3) == at.OK
    after = run.value("inner_ring.displacement.x")
    run.run(0.002)
    assert run.value("inner_ring.displacement.x") == after < before
    assert run.value("contact.inner.load_mean") < 0.8 * load
    assert run.value("inner_ring.velocity.x") == 0.0
    assert abs(run.imbalance) < 1e-3 * run.heat


def test_misalignment_makes_the_loads_uneven_twice_a_turn(scene):
    """To first order a leaning seat loads one side, but the inner ring is free to move radially and takes
    that load off again; what remains changes the contact angles, twice a turn. Both rings tilt with the seat.
    """
    lean = 1e-3
    run = Run(quiet(scene(NAME)), 20000, P_MISALIGNMENT_Y=lean).init()
    run.run(0.02)
    tilts = []
    for _ in range(100):  # the outer ring still swings on its springs
        run.run(1e-4)
        tilts.append(run.s[at.S_Y + at.Y_Q + at.Q_OUTER + 4])
    load = run.w[(at.W_RACE + at.R_LOAD) * at.STRIDE :][: int(run.p[at.P_BALLS])]
    turns = np.abs(np.fft.rfft(load)) / load.sum()
    assert turns[2] > 3.0 * turns[1]
    assert 0.02 < turns[2] < 0.2
    assert np.mean(tilts) == pytest.approx(lean, rel=0.1)
    assert 0.0 < run.value("inner_ring.tilt.y") < 0.5 * lean
    assert abs(run.imbalance) < 1e-3 * run.heat


def test_torque_by_source_adds_up(scene):
    """Steady, perfect: the drive's power is what contacts, rolling, cage and drag lose."""
    run = Run(quiet(scene(NAME)), 20000).init()
    rows = run.run(0.02)[100:]
    parts = {
        name: run.value(f"friction_torque.{name}", rows).mean()
        for name in ("contacts", "rolling", "cage", "drag")
    }
    assert min(parts.values()) > 0.0
    assert sum(parts.values()) == pytest.approx(run.value("friction_torque", rows).mean(), rel=0.02)
    assert run.value("contact.inner.spin_to_roll", rows).max() < 0.5
    assert 0.0 < run.value("contact.outer.slip", rows).mean() < 0.05
    assert run.value("cage.whirl_radius", rows).max() < run.p[at.P_LAND_CLEARANCE]


def test_at_standstill_the_torque_has_no_sources(scene):
    run = Run(quiet(scene(NAME)), 0).init()
    run.run(0.001)
    for name in ("contacts", "rolling", "cage", "drag"):
        assert run.value(f"friction_torque.{name}") == 0.0
