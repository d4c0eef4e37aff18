"""The mechanical port: bearings whose shaft another model moves, against sets with their own shaft."""

import numpy as np
import pytest

from fmu_bearing import SceneError, campbell, modes, statics
from fmu_bearing.compiled import call
from fmu_bearing.engine.constants import GRAVITY
from fmu_bearing.engine.layout import SP, P, S, U
from fmu_bearing.engine.status import OK
from fmu_bearing.instance import EngineError, Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.scene import Scene
from tests.spindle.port import PortRun, as_port, forces
from tests.spindle.sets import scene, tables
from tests.spindle.test_dynamics_oracle import SEATS
from tests.spindle.test_runs import loaded

STEP = 1e-5
SCALE = np.array([1.0, 1.0, 1.0, 30.0, 30.0])  # 1/m: a tilt at 33 mm is as far as a displacement


def followed(given, duration=1e-3, method="esdirk4"):
    """A set after a jump of its load by 100 N, and bearings led along its motion, at communication points."""
    changes = {"fidelity.method": method, "fidelity.tolerance": 5e-4}
    own, led = PortRun(given.replace(changes)).init(), PortRun(as_port(given.replace(changes)))
    led.lead(own.vector(0)[: SP.PLANE], 0.0).init()
    rows = [(forces(own), forces(led))]
    own.u[U.NOSE + 2] -= 100.0
    for _ in range(round(duration / STEP)):
        assert own.step(STEP) == OK
        led.go(own.vector(0)[: SP.PLANE], own.vector(1)[: SP.PLANE], STEP)
        rows.append((forces(own), forces(led)))
    return own, led, np.array(rows)


@pytest.mark.parametrize("seat", SEATS)
def test_led_along_a_shafts_motion_bearings_give_its_forces(seat):
    own, led, rows = followed(loaded(seat))
    change = np.ptp(rows[:, 0], axis=0).max(axis=0)
    assert change[2] > 100.0  # something happened
    # two solutions within the engine's tolerance: 1e-5 of the change; with 1e-3 once 7e-5
    apart = np.abs(rows[:, 0] - rows[:, 1]).max(axis=(0, 1))
    assert np.all(apart[:3] < 5e-5 * change[2])
    assert np.all(apart[3:] < 5e-5 * change[2] / SCALE[3])
    # the set's own work, with what moves the shaft; as for a set with its shaft
    assert abs(led.imbalance) < 1e-5 * led.heat
    assert abs(own.imbalance) < 1e-5 * own.heat


def test_led_along_a_shafts_motion_bearings_sound_as_on_that_shaft():
    microphone = {"name": "P", "x_mm": 55.0, "y_mm": 205.0, "z_mm": 0.0}
    sound = {"radiation_model": "compact", "microphone": [microphone]}
    given = loaded("fixed", **{"fidelity.tolerance": 1e-5, "sound": sound})
    own, led = (Instance(prepare(one)) for one in (given, as_port(given)))
    block = own.p[int(own.p[P.SET]) :]
    places = int(block[SP.AT_S]) + SP.S_HEAD + np.array([0, int(block[SP.PADDED_SIZE])])

    def lead():
        for first, into in zip(places, (U.PORT, U.PORT_RATE), strict=True):
            led.u[into : into + SP.PLANE] = own.s[first : first + SP.PLANE]

    own.initialise()
    lead()
    led.initialise()
    own.set("nose.force.z", own.get("nose.force.z") - 100.0)
    pressures = []
    for _ in range(400):
        own.step(STEP)
        lead()
        led.step(STEP)
        pressures.append([one.get("mic[1].pressure") for one in (own, led)])
    ours, theirs = np.array(pressures).T
    assert np.ptp(ours) > 1e-3  # Pa
    # two solutions within the engine's tolerance
    np.testing.assert_allclose(theirs, ours, rtol=0.0, atol=1e-3 * np.ptp(ours))


def test_force_at_the_port_is_that_of_all_bearings():
    _, led, _ = followed(loaded("sliding in housing"), 2e-4)
    wanted = np.zeros(SP.PLANE)
    for b, force in enumerate(forces(led)):
        place = 1e-3 * led.scene.spindle.bearing[b].position_mm
        wanted -= force
        wanted[3] -= -place * force[2]
        wanted[4] -= place * force[1]
    assert led.force() == pytest.approx(wanted, rel=1e-12, abs=1e-12 * np.abs(wanted).max())


def test_explicit_steps_lead_the_shaft_as_implicit_ones():
    implicit = followed(loaded("fixed"), 3e-4)[1]
    explicit = followed(loaded("fixed"), 3e-4, "rk4")[1]
    assert explicit.force() == pytest.approx(implicit.force(), abs=1e-2)
    assert abs(explicit.imbalance) < 1e-4 * explicit.heat


def test_mean_force_is_that_over_the_step():
    run = PortRun(as_port(loaded("fixed"))).lead(0.0, 0.0).init()
    kept, h, parts = run.s.copy(), 1e-4, 50
    goal, rate = np.array([1e-6, 2e-6, -1e-6, 1e-5, -2e-5]), np.array([0.01, 0.0, 0.03, 0.2, 0.1])
    run.go(goal, rate, h)
    coarse, at_end = run.force(mean=True), run.force()
    run.s[:] = kept
    fine = []
    for k in range(1, parts + 1):
        t = k / parts
        place = goal * t * t * (3.0 - 2.0 * t) + h * rate * t * t * (t - 1.0)
        speed = goal * 6.0 * t * (1.0 - t) / h + rate * t * (3.0 * t - 2.0)
        run.go(place, speed, h / parts)
        fine.append(run.force(mean=True))
    # forces change by hundreds of N within the step; the engine's tolerance leaves a part in 1e4
    span = np.abs(at_end - coarse).max()
    assert np.abs(np.mean(fine, axis=0) - coarse).max() < 1e-3 * span
    assert np.abs(run.force() - at_end).max() < 1e-3 * span


def test_one_bearing_alone_carries_its_preload_where_the_port_is_at_zero():
    given = Scene.from_dict(tables("+", (0.0,), 500.0, shaft={"external": True}))
    run = PortRun(given).lead(0.0, 0.0).init()
    assert run.force()[0] == pytest.approx(-500.0, abs=1e-5)
    assert np.abs(run.force()[1:]).max() < 1e-6
    assert run.go(0.0, 0.0, 1e-3)[0] == pytest.approx(-500.0, abs=1e-2)


def test_rotor_has_the_rings_inertia_and_weight():
    given = as_port(scene("+-", changes={"fidelity.terms.gravity": True}))
    run = PortRun(given).lead(0.0, 0.0).init()
    mass, transverse = run.p[P.INNER_MASS], run.p[P.INNER_TRANSVERSE]
    places = np.array([0.04, 0.07])
    constants = {one.name: one.value for one in prepare(given).variables if one.variability == "constant"}
    assert constants["port.mass"] == pytest.approx(2.0 * mass, rel=1e-12)
    assert constants["port.static_moment"] == pytest.approx(mass * places.sum(), rel=1e-12)
    wanted = 2.0 * transverse + mass * (places**2).sum()
    assert constants["port.inertia.transverse"] == pytest.approx(wanted, rel=1e-12)
    assert constants["port.inertia.polar"] == pytest.approx(2.0 * run.p[P.INNER_POLAR], rel=1e-12)
    assert "rotor.inertia" not in constants  # it would be the inertia of the rings alone
    # at rest balls weigh on the outer rings, rings are the rotor's: the weight that is left is small
    assert abs(run.force()[2]) < 0.5 * GRAVITY * mass
    # a free fall of everything: force without the rings' inertia
    still = run.s.copy()
    slow = run.go(np.array([0, 0, 1e-9, 0, 0]), np.array([0, 0, 2e-5, 0, 0]), 1e-4)
    run.s[:] = still
    stiff = -given_resistance(run, 1e-4)[2, 2] * 1e-9
    assert slow[2] - run.go(0.0, 0.0, 1e-4)[2] == pytest.approx(stiff, rel=0.01)


def given_resistance(run, h):
    """Resistance to places with rates that follow from them by the trapezoidal rule (5 x 5)."""
    place, rate = derivatives(run, h)
    return -(place + 2.0 / h * rate)


def derivatives(run, h):
    """Derivatives of the force with place and rate, 5 x 5 each."""
    columns, size = [], run.u.size
    for k in range(2 * SP.PLANE):
        change = np.concatenate((run.u, np.zeros(size)))
        change[size + U.PORT + k] = 1.0
        z = np.zeros(run.z.size)
        assert call("derivative", run.p, change, np.tile(run.s, 2), z, np.zeros(run.w.size), h) == OK
        first = int(run.p[run.block + SP.AT_Z]) + SP.Z_PORT
        columns.append(z[first : first + SP.PLANE])
    both = np.array(columns).T
    return both[:, : SP.PLANE], both[:, SP.PLANE :]


def differences(run, h, near):
    """Derivatives as `derivatives` gives them, by steps of the run itself to places ``near`` (m) apart."""
    kept, given, columns = run.s.copy(), run.u.copy(), []
    for k in range(2 * SP.PLANE):
        far = near * SCALE[k % SP.PLANE] * (1.0 if k < SP.PLANE else 2.0 / h)
        ends = []
        for sign in (1.0, -1.0):
            run.s[:], run.u[:] = kept, given
            run.u[U.PORT + k] += sign * far
            assert run.step(h) == OK
            ends.append(run.force())
        columns.append((ends[0] - ends[1]) / (2.0 * far))
    run.s[:], run.u[:] = kept, given
    both = np.array(columns).T
    return both[:, : SP.PLANE], both[:, SP.PLANE :]


def moving(seat):
    """A set that was led somewhere, with its shaft on the way."""
    run = PortRun(as_port(loaded(seat))).lead(0.0, 0.0).init()
    for k in range(1, 11):
        run.go(np.full(SP.PLANE, k * 2e-8), np.full(SP.PLANE, 2e-4), 1e-4)
    return run


@pytest.mark.parametrize("seat", ["fixed", "sliding in housing"])
@pytest.mark.parametrize("h", [1e-6, 2e-6, 5e-6, 1e-5, 2e-5, 5e-5, 1e-4])
def test_derivatives_are_partial_ones(h, seat):
    """By place at fixed rate and by rate at fixed place, each alone."""
    run = moving(seat)
    kept, inputs = run.s.tobytes(), run.u.tobytes()
    found = derivatives(run, h)
    assert run.s.tobytes() == kept and run.u.tobytes() == inputs
    # Less than this, and the step control does not see the balls' contact modes; more, and friction and
    # contact damping bend. In longer steps it need not see them.
    near = {1e-6: 3e-9, 2e-6: 4e-9, 5e-6: 1e-8, 1e-5: 3e-8, 2e-5: 3e-8}.get(h, 5e-9)
    measured = differences(run, h, near)
    # Changes of different size may take different numbers of Newton iterations. In steps of 50 us the rates'
    # derivatives then differ by 1.1 %; both are 2.8 and 3.5 % from those of steps of 1 us at 1e-7.
    within = 0.02 if h == 5e-5 else 0.01
    for one, other in zip(found, measured, strict=True):
        weights = np.outer(SCALE, SCALE)
        assert np.linalg.norm((one - other) * weights, 2) < within * np.linalg.norm(other * weights, 2)


@pytest.mark.parametrize("h", [1e-6, 2e-6, 5e-6, 1e-5, 2e-5])
def test_derivatives_are_those_of_the_equations(h):
    """Against steps of 0.1 us and changes of 0.1 nm: neither step control nor size of the change count."""
    run = moving("fixed")
    found = derivatives(run, h)
    run.p[P.MAX_STEP] = run.s[S.STEP] = 1e-7
    for one, other in zip(found, differences(run, h, 1e-10), strict=True):
        weights = np.outer(SCALE, SCALE)
        assert np.linalg.norm((one - other) * weights, 2) < 0.01 * np.linalg.norm(other * weights, 2)


@pytest.mark.heavy
def test_resistance_at_rest_is_the_static_stiffness():
    run = PortRun(as_port(scene("+-", (0.0, 30.0)))).lead(0.0, 0.0).init()
    # gate 1 of the design study, 7003C DB; balls come to rest slowly: 2.7e-3 are left after 2 ms, 2e-4
    # after 0.1 s
    for h, tolerance in ((0.1, 5e-4), (2e-3, 3e-3)):
        found = given_resistance(run, h)
        assert found[0, 0] == pytest.approx(1.11465e8, rel=tolerance)
        assert found[2, 2] == pytest.approx(3.24901e8, rel=tolerance)


def test_state_goes_round():
    run = PortRun(as_port(loaded("sliding in housing"))).lead(0.0, 0.0).init()
    place, rate = np.full(SP.PLANE, 1e-6), np.full(SP.PLANE, 0.02)
    run.go(place, rate, 3e-5)
    kept = run.s.copy()
    first = [run.go(k * place, rate, 2e-5) for k in (1.5, 2.0)]
    end = run.s.tobytes()
    run.s[:] = kept
    again = [run.go(k * place, rate, 2e-5) for k in (1.5, 2.0)]
    assert np.array_equal(first, again) and run.s.tobytes() == end


def test_library_has_a_port():
    one = Instance(prepare(as_port(loaded("fixed"))))
    names = set(one.by_name)
    assert {"port.displacement.x", "port.tilt_rate.z", "port.force_mean.y", "port.mass"} <= names
    assert not {name for name in names if name.startswith(("nose.", "shaft.nose."))}
    with pytest.raises(EngineError, match="must be initialised"):
        one.port_derivatives(1e-4)
    one.initialise()
    one.set("port.displacement.z", 1e-6)
    one.set("port.velocity.z", 0.02)
    one.step(1e-4)
    place, rate = one.port_derivatives(1e-4)
    assert one.get("port.force.z") < -100.0
    assert place[2, 2] < -3e8 and rate[2, 2] < 0.0
    single = Instance(prepare(loaded("fixed")))
    single.initialise()
    with pytest.raises(EngineError, match="no other model owns the shaft"):
        single.port_derivatives(1e-4)


@pytest.mark.parametrize(
    ("changes", "words"),
    [
        ({"shaft": {}}, "shaft.sections_mm is missing"),
        (
            {"shaft": {"external": True, "sections_mm": [[10.0, 5.0, 0.0]]}},
            "sections_mm: is refused: they are given in the model",
        ),
        (
            {"shaft": {"external": True, "flexible": True}},
            "flexible = true is refused: they are given",
        ),
        ({"shaft": {"external": True}, "load": {"force_x_N": 1.0}}, "load: is refused: it acts on the shaft"),
    ],
)
def test_what_a_port_does_not_read_is_refused(changes, words):
    with pytest.raises(SceneError, match=words):
        Scene.from_dict(tables(**changes))


@pytest.mark.parametrize("use", [statics, modes, lambda one: campbell(one, [5e3, 1e4, 2e4])])
def test_statics_and_modes_of_another_models_shaft_are_refused(use):
    with pytest.raises(SceneError, match="another model owns the shaft"):
        use(as_port(loaded("fixed")))
