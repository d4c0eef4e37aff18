"""Options of fidelity full over milliseconds: traction, springs, rigid preload, misalignment, outputs."""

import numpy as np
import pytest

from fmu_bearing.engine.layout import STRIDE, P, Q, R, S, U, W, Y
from fmu_bearing.engine.status import OK
from tests.engine.helpers import Run, quiet
from tests.engine.lubrication import film_places

pytestmark = pytest.mark.heavy
NAME = "7003C-spindle"


def lubricated(scene, law, rpm=20000):
    run = Run(scene, rpm)
    run.p = film_places(scene, run.p.copy(), law)
    run.p.setflags(write=False)  # a writable array is another type, which would compile the engine again
    return run


def kinematic_ratio(run, rows):
    """Speed of the orbit over that of the shaft for balls that roll: (1 - D cos(alpha) / d_m) / 2."""
    angle = run.value("contact.inner.angle_mean", rows)[-1]
    return 0.5 * (1.0 - 4.5 / 26.0 * np.cos(angle))


@pytest.mark.parametrize(("law", "slip"), [("eyring", False), ("paper", True)])
def test_every_traction_law_runs(scene, law, slip):
    """Eyring's law drives the balls at the kinematic speed; the paper's lets them run ahead of it."""
    run = lubricated(scene(NAME).model_copy(update={"sound": None}), law).init()
    rows = run.run(0.01)
    assert abs(run.imbalance) < 1e-4 * run.heat
    off = run.value("cage.speed_ratio", rows)[20:] - kinematic_ratio(run, rows)
    if slip:  # traction of 3e-5 of the load does not drive the balls: up to a seventh
        assert off.min() > 0.01 and 0.03 < off.max() < 0.07
    else:  # slip of some 1e-4, and the cage's play in its pockets
        assert abs(off.mean()) < 3e-4 and np.abs(off).max() < 2e-3


@pytest.mark.parametrize(
    ("rpm", "within"), [(1, 0.08), (100, 2e-3), (100000, 2e-3)], ids=["1", "100", "100000"]
)
def test_eyring_at_any_speed(scene, rpm, within):
    """The cage follows at the kinematic speed; at 1 r/min it still settles, by a fifth."""
    run = lubricated(scene(NAME).model_copy(update={"sound": None}), "eyring", rpm).init()
    rows = run.run(0.002)
    assert abs(run.imbalance) < 1e-4 * run.heat + 1e-9
    ratio = run.value("cage.speed_ratio", rows)[10:]
    assert np.abs(ratio - kinematic_ratio(run, rows)).max() < within


def test_eyring_at_standstill(scene):
    """Nothing is driven: rings and rotor ring after the start by some micrometres per second."""
    run = lubricated(scene(NAME).model_copy(update={"sound": None}), "eyring", 0).init()
    rows = run.run(0.002)
    assert abs(run.imbalance) < 1e-9
    for name in ("inner_ring.velocity.x", "inner_ring.velocity.z", "outer_ring.velocity.z"):
        assert np.abs(run.value(name, rows)[10:]).max() < 1e-5, name


@pytest.mark.parametrize("stiffness", [1e5, 5e6, 2.5e7])
def test_springs_hold_the_balls_apart(scene, stiffness):
    one = scene(NAME).model_copy(update={"sound": None})
    run = Run(one, 20000, CAGE=0.0, SPRINGS=stiffness, SPRING_DAMPING=10.0, TOLERANCE=1e-4)
    run.init()
    run.run(0.01)
    balls = int(run.p[P.BALLS])
    theta = np.unwrap(run.s[2 * STRIDE :][:balls])
    apart = np.diff([*theta, theta[0] + 2 * np.pi]) - 2 * np.pi / balls
    apart = (apart + np.pi) % (2 * np.pi) - np.pi
    assert np.abs(apart).max() < 1e-3
    assert abs(run.imbalance) < 1e-3 * run.heat


def axial_load(scene, rpm, rigid, inner=293.15):
    """Axial force (N) of the balls on the inner ring, friction included, mean over the last 2 of 5 ms."""
    run = Run(quiet(scene(NAME)), rpm, RIGID=float(rigid))
    run.u[U.INNER_T] = inner
    run.init().run(0.003)
    forces = []
    for _ in range(200):
        run.run(1e-5, 1e-5)
        forces.append(-run.w[W.BODY :][: int(run.p[P.BALLS])].sum())
    # energy over a few milliseconds without imperfections: the heat is small, the gate is of its size
    assert abs(run.imbalance) < 1e-3 * run.heat
    return np.mean(forces)


def test_rigid_preload_grows_with_speed_and_heat(scene):
    """Balls pressed outwards and a warm inner ring push the rings apart; a rigid mount does not let them."""
    slow, middle, fast = (axial_load(scene, rpm, True) for rpm in (100, 20000, 40000))
    assert slow == pytest.approx(500.0, rel=1e-3)
    # centrifugal force grows with the square of the speed
    assert fast - slow == pytest.approx(4.0 * (middle - slow), rel=0.2)
    assert fast > slow
    assert axial_load(scene, 20000, True, inner=303.15) > 1.05 * middle


@pytest.mark.parametrize(("rpm", "inner"), [(40000, 293.15), (20000, 303.15)])
def test_constant_force_stays(scene, rpm, inner):
    assert axial_load(scene, rpm, False, inner) == pytest.approx(500.0, rel=1e-3)


def test_rigid_preload_moves_with_its_input(scene):
    run = Run(quiet(scene(NAME)), 20000, RIGID=1.0).init()
    run.run(0.002)
    before, load = run.value("inner_ring.displacement.x"), run.value("contact.inner.load_mean")
    run.u[U.PRELOAD] *= 0.5
    assert run.step(1e-3) == OK
    after = run.value("inner_ring.displacement.x")
    run.run(0.002)
    assert run.value("inner_ring.displacement.x") == after < before
    assert run.value("contact.inner.load_mean") < 0.8 * load
    assert run.value("inner_ring.velocity.x") == 0.0
    assert abs(run.imbalance) < 1e-3 * run.heat


def test_misalignment_makes_the_loads_uneven(scene):
    """To first order a leaning seat loads one side, but the inner ring moves radially and takes most of that
    off again (once a turn is left what the moment on the pedestal asks for); the rest changes the contact
    angles, twice a turn. Seat, bearing and tilt support share the tilt as springs in series: the linear
    estimate of the start holds to a per cent at 1 mrad.
    """
    lean = 1e-3
    run = Run(quiet(scene(NAME)), 20000, MISALIGNMENT_Y=lean).init()
    at_outer = S.Y + Y.Q0 + Q.OUTER + 4
    estimate = run.s[at_outer]
    assert 0.5 * lean < estimate < lean
    run.run(0.02)
    load = run.w[W.RACE + R.LOAD :][: int(run.p[P.BALLS])]
    turns = np.abs(np.fft.rfft(load)) / load.sum()
    assert turns[2] > turns[1] > 10.0 * turns[3]
    assert 0.01 < turns[2] < 0.1
    assert run.s[at_outer] == pytest.approx(estimate, rel=0.01)
    assert 0.0 < run.value("inner_ring.tilt.y") < 0.05 * lean
    assert abs(run.imbalance) < 1e-3 * run.heat


def test_torque_by_source_adds_up(scene):
    """Steady, perfect: the drive's power is what contacts, rolling, cage and drag lose."""
    run = Run(quiet(scene(NAME)), 20000).init()
    rows = run.run(0.02)[100:]
    parts = {
        name: run.value(f"friction_torque_share.{name}", rows).mean()
        for name in ("contacts", "rolling", "cage", "drag")
    }
    assert min(parts.values()) > 0.0
    assert sum(parts.values()) == pytest.approx(run.value("friction_torque", rows).mean(), rel=0.02)
    assert run.value("contact.inner.spin_to_roll", rows).max() < 0.5
    assert 0.0 < run.value("contact.outer.slip", rows).mean() < 0.05
    assert run.value("cage.whirl_radius", rows).max() < run.p[P.LAND_CLEARANCE]


def test_at_standstill_the_torque_has_no_sources(scene):
    run = Run(quiet(scene(NAME)), 0).init()
    run.run(0.001)
    for name in ("contacts", "rolling", "cage", "drag"):
        assert run.value(f"friction_torque_share.{name}") == 0.0
