"""Where the engine starts a set: its vectors, and what it refuses where the oracle of the rest does."""

import math

import numpy as np
import pytest

from fmu_bearing import read_scene, statics
from fmu_bearing.elastic.shaft import shaft_model
from fmu_bearing.engine.choices import FIDELITIES
from fmu_bearing.engine.layout import SP, F, P, Q, S, U
from fmu_bearing.engine.spindle.rest_unknowns import start_vector
from fmu_bearing.engine.status import NO_START, OK, OTHER_FIDELITY, TOO_SOFT
from fmu_bearing.engine.steady.point import REST
from fmu_bearing.instance import EngineError, Instance
from fmu_bearing.prepare.model import prepare
from tests.conftest import GATES
from tests.spindle.rest import oracle
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene
from tests.spindle.test_runs import loaded

ONE_WAY = {"signs": "++", "preload": None, "load": {"force_x_N": 500.0}}
HOUSING = {"mass_kg": 2.0, "diameter_mm": 100.0, "length_mm": 160.0, "pedestal_stiffness_N_m": 1e8}


@pytest.mark.parametrize("seat", ["fixed", "sliding", "pedestal", "housing", "bends"])
def test_vectors_of_the_start_do_not_overlap(seat):
    """Forces are written in whole groups of lanes: forces of a trial must not reach the step behind them."""
    if seat in ("fixed", "sliding", "pedestal"):
        run = SetRun(loaded(seat))
    elif seat == "housing":
        run = SetRun(scene(housing=HOUSING))
    else:
        given = scene(changes={"spindle.shaft.flexible": True})
        run = SetRun(given, shaft=shaft_model(given, given.spindle))
    apart = start_vector(run.p, SP.STEPS) - start_vector(run.p, SP.TRIAL_FORCES)
    assert apart >= int(run.p[run.block + SP.PADDED_SIZE])
    end = start_vector(run.p, SP.START_VECTORS - 1) + apart
    assert end <= run.w.size


@pytest.mark.parametrize("fidelity", range(3), ids=FIDELITIES)
def test_a_load_the_way_that_nothing_holds_is_refused_at_the_start(fidelity):
    run = SetRun(scene(**ONE_WAY), FIDELITY=fidelity)
    run.u[U.NOSE] = -500.0
    assert run.try_init() == NO_START
    run.u[U.NOSE] = 500.0
    assert run.try_init() == OK


# drawn sets that the engine once ran although the oracle refuses them: loads lie on sides without shoulder
@pytest.mark.parametrize(
    ("preload", "along", "upwards", "at", "rpm"),
    [(10.2, -1395.0, -1289.0, -27.0, 0.0), (1.1, 1295.0, -820.0, -4.0, 10e3)],
)
def test_what_the_oracle_refuses_the_engine_refuses(preload, along, upwards, at, rpm):
    load = {"force_x_N": along, "force_z_N": upwards, "position_mm": at}
    given = scene("-+", (40.0, 70.0), preload, rpm, load=load)
    with pytest.raises(EngineError, match="against its direction"):
        oracle(given)
    with pytest.raises(EngineError, match="and only in directions that a bearing carries"):
        statics(given)
    one = Instance(prepare(given))
    with pytest.raises(EngineError, match="and only in directions that a bearing carries"):
        one.initialise()


@pytest.mark.parametrize("fidelity", ["full", "rings", "response"])
def test_a_load_that_turns_round_in_a_run_is_told(fidelity):
    warnings = []
    one = Instance(
        prepare(scene(**ONE_WAY, rpm=5e3, changes={"fidelity.model": fidelity})), tell=warnings.append
    )
    one.initialise()
    assert warnings == []
    one.set("nose.force.x", -500.0)
    for _ in range(40):
        try:
            one.step(1e-3)
        except EngineError:
            break
    backward = [line for line in warnings if "the way that nothing holds" in line]
    assert len(backward) == 1, warnings
    assert backward[0].startswith("bearing 1: its contact angle is -")


@pytest.mark.parametrize(
    ("seat", "preload", "upwards", "at"), [("pedestal", 50.0, -300.0, 0.0), ("housing", 500.0, -1000.0, 55.0)]
)
def test_a_pedestal_far_too_soft_is_refused(seat, preload, upwards, at):
    """A bearing alone refuses it, too: angles of pockets and waves are series in the outer ring's place."""
    assert SetRun(softly(seat, 1e5, preload, upwards, at)).try_init() == TOO_SOFT
    assert SetRun(softly(seat, 1e6, preload, upwards, at)).try_init() == OK


def test_where_no_equilibrium_is_found_a_soft_pedestal_is_named():
    given = softly("pedestal", 1e5, 500.0, -50.0, 0.0)
    for use in (statics, lambda one: Instance(prepare(one)).initialise()):
        with pytest.raises(EngineError, match="or a stiffer pedestal where there is one"):
            use(given)


def softly(seat, stiffness, preload, upwards, at):
    """A pair on pedestals, or in a housing on one."""
    soft = {"pedestal_stiffness_N_m": stiffness}
    more = {"bearings": [{"seat": "pedestal"}] * 2, "housing": soft}
    if seat == "housing":
        more = {"housing": HOUSING | soft}
    return scene(preload=preload, load={"force_z_N": upwards, "position_mm": at}, **more)


@pytest.mark.parametrize("preload", [50.0, 500.0])
@pytest.mark.parametrize("stiffness", [1e6, 1e7])
def test_the_oracle_and_the_start_agree_on_soft_pedestals(stiffness, preload):
    """Rings go aside by up to a millimetre, together: only what they move against each other is small.

    The oracle takes tilts of outer rings as small; here they are up to 1 deg.
    """
    given = softly("pedestal", stiffness, preload, -300.0, 0.0)
    found, known = statics(given), oracle(given)
    assert known.shaft[:3] == pytest.approx(found.displacement[:3], rel=5e-3, abs=2e-7)
    assert set(found.lift_off) == {"+x", "-x"}
    for one in found.lift_off.values():
        free = statics(given, force=(one.load, 0.0, 0.0), at=0.0).bearings
        assert free[one.bearing - 1].axial == pytest.approx(0.0, abs=1e-4 * abs(one.load))
        assert free[2 - one.bearing].axial == pytest.approx(abs(one.load), rel=1e-4)


AXIS = {"force_x_N": 100.0, "force_z_N": -300.0, "position_mm": 0.0}


def with_cage(given):
    """The set with the cage of the gate scene, under its own weight."""
    bearing = read_scene(GATES / "7003C-spindle.toml").bearing
    caged = given.bearing.model_copy(update={"cage": bearing.cage})
    return given.model_copy(update={"bearing": caged}).replace({"fidelity.terms.gravity": True})


@pytest.mark.parametrize(
    ("seat", "stiffness", "left"),
    [
        ("fixed", None, 1e-8),
        ("cage", None, 1e-8),
        # a bearing that has sunk by F/k: air drags balls about the fixed axis, and gyroscopes count from it
        ("housing", 1e8, 2e-3),
        ("housing", 1e7, 2e-2),
        ("pedestal", 1e8, 1e-3),
        ("pedestal", 1e7, 1e-2),
        ("pedestal", 1e6, 1e-1),
    ],
)
def test_a_set_starts_in_balance(seat, stiffness, left):
    """Forces (N) that the shaft, housing and free rings are left with, of 316 N on the nose.

    With quasi-static forces across the axis it was 0.2 N on fixed seats and up to 2.7 N on pedestals.
    """
    more = {}
    if seat == "housing":
        more = {"housing": HOUSING | {"pedestal_stiffness_N_m": stiffness}}
    elif seat == "pedestal":
        more = {"bearings": [{"seat": "pedestal"}] * 2, "housing": {"pedestal_stiffness_N_m": stiffness}}
    given = scene(rpm=10e3, load=AXIS, **more)
    run = SetRun(with_cage(given) if seat == "cage" else given).init()
    head = run.p[run.block :]
    n, lanes = int(head[SP.COUNT]), int(head[SP.PADDED_SIZE])
    inverse = head[int(head[SP.AT_INVERSE]) :][: n * lanes].reshape(n, lanes)[:, :n]
    lever = float(run.p[P.PITCH_RADIUS])
    shaft = np.linalg.solve(inverse, run.vector(2))
    assert np.abs(shaft[:3]).max() < left
    assert np.abs(shaft[3:5]).max() < left * lever
    for b in range(run.count):
        assert run.state(b)[S.SETTLED] == REST
        own = run.p[int(run.row(b)[SP.ROW_P]) :]
        free = run.state(b)[S.F + F.BODY + Q.OUTER :][: Q.RINGS - Q.OUTER]
        if seat == "pedestal":
            assert np.abs(free[: Q.TURN]).max() * own[P.OUTER_MASS] < left
            assert abs(free[Q.TURN]) * own[P.OUTER_POLAR] < left * lever
            assert np.abs(free[Q.BY :]).max() * own[P.OUTER_TRANSVERSE] < left * lever


def test_a_set_stays_where_it_starts():
    """Without imperfections the nose stays in place for 2 ms; the balls' passing alone moves it."""
    run = SetRun(scene(rpm=10e3, load=AXIS)).init()
    before = np.array([run.value(f"shaft.nose.displacement.{axis}") for axis in "xyz"])
    run.run(2e-3)
    after = np.array([run.value(f"shaft.nose.displacement.{axis}") for axis in "xyz"])
    assert np.abs(after - before).max() < 2e-10  # m, of 8e-6; from the quasi-static state it was 5e-9


def test_a_state_without_room_for_lines_is_not_run_in_response():
    run = SetRun(scene(rpm=10e3)).init()
    run.p[P.FIDELITY] = list(FIDELITIES).index("response")
    assert run.try_init() == OTHER_FIDELITY


def test_unloaded_bearings_are_no_load_backwards():
    """A push that frees the front bearing: it carries nothing, and nothing the wrong way."""
    found = SetRun(scene(rpm=10e3, preload=20.0, load={"force_x_N": -400.0}))
    assert found.try_init() == OK
    assert math.isclose(found.value("force.x", 0) + found.value("force.x", 1), -400.0, rel_tol=1e-3)
