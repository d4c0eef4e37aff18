"""Fidelity rings on sets: against single bearings and fidelity full, symmetry, what is kept, refusals."""

import numpy as np
import pytest

from fmu_bearing import read_scene, simulate, with_fidelity
from fmu_bearing.engine.choices import FULL
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import SP, P, S, U, Z
from fmu_bearing.engine.status import OK, OTHER_FIDELITY
from tests.conftest import GATES, ROOT
from tests.engine.condensed import FIDELITIES
from tests.engine.helpers import Run
from tests.spindle import one
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene
from tests.spindle.test_dynamics_oracle import NO_CAGE, SEATS, bent
from tests.spindle.test_sound import pair, sound

RINGS = FIDELITIES["rings"]
WEIGHT = {"fidelity.terms.gravity": True}
LOAD = {"force_x_N": 100.0, "force_y_N": 30.0, "force_z_N": -100.0, "position_mm": -10.0}


def wavy(given):
    """The set with waves and unequal balls."""
    waves = read_scene(GATES / "7003C-bare.toml").imperfections.model_copy(update={"unbalance_um": 0.0})
    return given.model_copy(update={"imperfections": waves})


def velocities(run):
    """Velocities of all rings and of the nose (m/s)."""
    nose = int(run.p[run.block + SP.AT_Z]) + SP.Z_NOSE_VELOCITY
    return np.concatenate([*(run.of(run.z, b, "Z")[:6] for b in range(run.count)), run.z[nose : nose + 3]])


def recorded(run, duration, h=2e-5):
    """Those velocities after each step."""
    rows = []
    for _ in range(round(duration / h)):
        assert run.step(h) == OK
        rows.append(velocities(run))
    return np.array(rows)


def vibration(rows):
    """Root mean square velocity of each ring and of the nose, all axes together, mean removed."""
    apart = (rows - rows.mean(axis=0)).reshape(len(rows), -1, 3)
    return np.sqrt((apart**2).sum(axis=2).mean(axis=0))


#: Vibration by full, by scene and settings: rings and response are held against the same run.
BY_FULL = {}


def compared(given, shaft=None, settle=0.02, duration=0.05, fidelity=RINGS, **parameters):
    """Vibration by a fidelity over that by full, of all that moves."""

    def by(fidelity):
        run = SetRun(given, shaft=shaft, FIDELITY=fidelity, **parameters).init()
        run.run(settle, 1e-3)
        return vibration(recorded(run, duration))

    key = given.to_toml(), repr(shaft), settle, duration, *sorted(parameters.items())
    if key not in BY_FULL:
        BY_FULL[key] = by(0.0)
    full = BY_FULL[key]
    moving = full > 0.0
    return by(fidelity)[moving] / full[moving]


def set_of_one(flaws, rpm):
    """A bearing alone on its shaft, and the same as a single bearing with a rotor; with waves and weight."""
    pair = one.set_of_one(rpm, -20.0, changes={"fidelity.terms.gravity": flaws})
    return tuple(wavy(given) for given in pair) if flaws else pair


@pytest.mark.parametrize("flaws", [False, True])
def test_a_set_of_one_is_the_single_bearing(flaws):
    rpm = 20000.0
    given, alone = set_of_one(flaws, rpm)
    # at longer steps one of both corrects a step once more now and then, as tilts have other levers
    fine = {"FIDELITY": RINGS, "MAX_STEP": 5e-6}
    single = Run(alone, rpm, **fine)
    single.u[U.LOAD_Z] = -20.0
    single.init()
    run = SetRun(given, **fine).init()
    for _ in range(20):
        assert single.step(1e-4) == run.step(1e-4) == OK
        one, ours = single.z, run.of(run.z, 0, "Z")
        size = np.abs(one[:6]).max()
        # both find the even balls by steps that end at 3e-11 m, of an approach of 1e-6 m: measured 3e-4.
        # The perfect bearing is at rest
        assert np.abs(one[:6] - ours[:6]).max() < 2e-3 * size + 1e-8
        # the rings of a set under load are where quasi-static bearings hold them; measured 2e-3
        assert run.z[Z.TORQUE] == pytest.approx(one[Z.TORQUE], rel=5e-3)
    assert run.s[S.STEPS] == single.s[S.STEPS]
    assert run.value("friction_torque_mean") == pytest.approx(one[Z.MEAN_TORQUE], rel=5e-3)


# measured 0.6 % (DB), 1.8 % (QBC, 10,000 r/min) and 6 % (QBC, 20,000 r/min: the front pair, 5 mm/s beside a
# resonance of the rear one with 14 mm/s)
@pytest.mark.heavy
@pytest.mark.parametrize("rpm", [10e3, 20e3])
@pytest.mark.parametrize(
    ("signs", "positions"), [("+-", (40.0, 70.0)), ("++--", (40.0, 60.0, 200.0, 220.0))], ids=["DB", "QBC"]
)
def test_vibration_is_that_of_full(signs, positions, rpm):
    load = {"force_z_N": -50.0, "position_mm": 0.0}
    ratio = compared(wavy(scene(signs, positions, rpm=rpm, changes=WEIGHT, load=load)))
    assert np.abs(ratio - 1.0).max() < (0.02 if signs == "+-" else 0.1)


def back_to_back(preload, loaded, damping):
    """The example's pair at 20,000 r/min; ``preload`` in N, ``damping`` of its contacts in us."""
    given = read_scene(ROOT / "examples" / "spindle_set" / "7003C-DB.toml").replace(
        {
            "operation.speed_rpm": 20e3,
            "bearing.contact_damping_us": damping,
            "spindle.preload.preload_N": preload,
            "spindle.load.force_x_N": 100.0 if loaded else 0.0,
            "spindle.load.force_z_N": -50.0 if loaded else 0.0,
        }
    )
    return wavy(given.model_copy(update={"sound": None}))


PAIRS = [(500.0, False), (150.0, True), (60.0, False)]


@pytest.mark.heavy
@pytest.mark.parametrize("damping", [0.5, 2.5])
@pytest.mark.parametrize(("preload", "loaded"), PAIRS)
def test_a_pair_is_damped_as_in_full_at_any_preload(preload, loaded, damping):
    """With a tenth of the gate scene's flaws, to which all answers are linear."""
    given = back_to_back(preload, loaded, damping)
    for fidelity in FIDELITIES.values():
        ratio = compared(given, settle=0.05, fidelity=fidelity, IMPERFECTION_SCALE=0.1)
        assert np.abs(ratio - 1.0).max() < 0.05


# All of the flaws, 0.3 um on each race (rms), against an approach of 0.7 um at 60 N: contacts open, and what
# slips is then no linear damping. Shares of `full` as measured, where the gate of 0.95 to 1.05 is missed.
@pytest.mark.heavy
@pytest.mark.parametrize(
    ("preload", "loaded", "damping", "least", "most"),
    [
        (500.0, False, 2.5, 0.99, 1.01),
        (500.0, False, 0.5, 0.99, 1.01),
        (150.0, True, 2.5, 0.97, 1.03),
        (150.0, True, 0.5, 1.05, 1.15),
        (60.0, False, 2.5, 1.2, 1.4),
        (60.0, False, 0.5, 1.4, 2.8),
    ],
)
def test_waves_as_large_as_the_approach_move_a_pair_more_than_in_full(preload, loaded, damping, least, most):
    ratio = compared(back_to_back(preload, loaded, damping), settle=0.05)
    assert least < ratio.min()
    assert ratio.max() < most


# measured 4 % at 10,000 and 6 % at 20,000 r/min, of vibration below 3 mm/s
@pytest.mark.heavy
@pytest.mark.parametrize("rpm", [10e3, 20e3])
def test_vibration_of_a_motor_spindle_whose_shaft_bends_is_that_of_full(rpm):
    given = read_scene(ROOT / "examples" / "spindle_set" / "7003C-QBC.toml").replace(
        {"operation.speed_rpm": rpm}
    )
    ratio = compared(given.model_copy(update={"sound": None}))
    assert np.abs(ratio - 1.0).max() < 0.1


# measured 2.4 % at most, of the set in a housing on a shaft that bends: modes of the housing at 1 to 2 kHz,
# whose damping by the balls is estimated with each bearing's share of it
@pytest.mark.heavy
@pytest.mark.parametrize("shaft", [None, bent], ids=["rigid", "bent"])
@pytest.mark.parametrize("seat", SEATS)
def test_vibration_on_all_seats_is_that_of_full(seat, shaft):
    preload = None if "sliding" in seat else 500.0
    heavy = [{"position_mm": 100.0, "amount_g_mm": 2.0, "angle_deg": 40.0}]
    given = scene("+-", (40.0, 70.0), preload, 15e3, changes=WEIGHT | SEATS[seat], load=LOAD)
    given = wavy(given.replace({"spindle.shaft.unbalance": heavy}))
    ratio = compared(given, None if shaft is None else shaft(given), duration=0.03)
    assert np.abs(ratio - 1.0).max() < 0.05


@pytest.mark.parametrize("model", ["compact", "paper_contacts"])
def test_sound_is_that_of_full(model):
    """Without cages, whose rattle rings leave out: 0.3 dB apart, a resonance of the set at this speed."""
    given = pair(sound(model, (55.0, 0.0, 1000.0)), flaws=True).replace(NO_CAGE)
    given = with_fidelity(given, tolerance=1e-3)
    names = ["mic[1].spl_slow", "mic[1].spl_bearing[1]", "mic[1].spl_bearing[2]", "mic[1].spl_inner_ring"]
    full, rings = (
        simulate(with_fidelity(given, model=one), 0.05, step=1e-3, outputs=names) for one in ("full", "rings")
    )
    for name in names:
        assert rings[name][-1] == pytest.approx(full[name][-1], abs=1.0)


def test_a_perfect_pair_stands_still_under_its_preload():
    run = SetRun(scene("+-", (40.0, 70.0), rpm=20e3), FIDELITY=RINGS).init()
    rows = run.run(0.005, 1e-3)
    assert np.abs(velocities(run)).max() < 1e-9
    full = SetRun(scene("+-", (40.0, 70.0), rpm=20e3)).init()
    for b, sign in enumerate((1.0, -1.0)):
        # full's ring forces contain friction across the tracks at the start
        assert run.value("force.x", b) == pytest.approx(full.value("force.x", b), rel=0.01)
        assert sign * run.value("force.x", b) > 0.0
    assert run.value("friction_torque") == pytest.approx(run.value("friction_torque_mean"), rel=1e-9)
    assert run.value("energy.residual") == pytest.approx(0.0, abs=1e-9)
    heats = sum(run.value(f"heat.{name}") for name in ("inner_ring", "outer_ring", "oil"))
    assert heats == pytest.approx(run.value("friction_torque_mean") * 20e3 * RPM, rel=1e-6)
    assert np.isfinite(rows).all()


def test_mirrored_bearings_do_the_same():
    """A pair in DB about the middle of its shaft, with load and heavy spot there: own axes see the same."""
    given = scene(
        "+-", (40.0, 70.0), 500.0, 15e3, changes=WEIGHT, shaft={"sections_mm": [[110.0, 17.0, 0.0]]},
        load={"force_y_N": 40.0, "force_z_N": -60.0, "position_mm": 55.0},
    )  # fmt: skip
    spot = [{"position_mm": 55.0, "amount_g_mm": 3.0, "angle_deg": 20.0}]
    run = SetRun(given.replace({"spindle.shaft.unbalance": spot}), FIDELITY=RINGS).init()
    rows = recorded(run, 2e-3)
    front, rear = rows[:, :3], rows[:, 6:9]
    size = np.abs(rows).max()
    assert size > 1e-4
    # outputs are in the shaft's axes; rounding of Newton's corrections
    assert np.abs(front[:, 1:] - rear[:, 1:]).max() < 1e-7 * size
    assert np.abs(rows[:, -3]).max() < 1e-7 * size


@pytest.mark.parametrize("fidelity", [FULL, *FIDELITIES.values()], ids=["full", *FIDELITIES])
def test_nothing_but_the_state_is_kept(fidelity):
    """Work space full of rubbish between steps, and a state put back, change no bit."""
    given = wavy(scene("+-", (40.0, 70.0), 500.0, 20e3, changes=WEIGHT, load=LOAD))
    clean, dirty = (SetRun(given, FIDELITY=fidelity).init() for _ in range(2))
    for k in range(8):
        kept = dirty.s.copy()
        for run in (clean, dirty):
            run.u[U.SHAFT_T] = 293.15 + 0.5 * k
            dirty.w[:] = 1e30 * (k + 1)
            assert run.step(1e-4) == OK
        assert np.array_equal(clean.s, dirty.s)
    again = dirty.s.copy()
    dirty.s[:] = kept
    assert dirty.step(1e-4) == OK
    assert np.array_equal(again, dirty.s)


def test_preload_grows_with_temperature_as_in_full():
    """Inner rings and shaft warmed by 8 K in 8 ms: forces on the way as by fidelity full."""
    given = scene("+-", (40.0, 70.0), 500.0, 10e3)
    found = []
    for fidelity in (RINGS, 0.0):
        run = SetRun(given, FIDELITY=fidelity).init()
        rows = []
        for k in range(1, 9):
            run.u[U.SHAFT_T] = 293.15 + k
            for b in range(2):
                run.u[U.BEARINGS + b * U.ROW + U.INNER] = 293.15 + k
            assert run.step(1e-3) == OK
            rows.append(run.value("force.x", 0))
        found.append(rows)
    grown = found[1][-1] - 500.0
    assert abs(grown) > 40.0
    # the jump of a ring's temperature rings on in both, with their own damping
    assert np.abs(np.subtract(*found)).max() < 0.05 * abs(grown)


def test_loads_find_the_held_points_anew():
    """After an axial load its bearings hold the heats of a run that starts under it."""
    given = scene("+-", (40.0, 70.0), 500.0, 10e3)
    jumped, started = (SetRun(given, FIDELITY=RINGS) for _ in range(2))
    started.u[U.NOSE] = 200.0
    started.init()
    jumped.init()
    before = jumped.value("heat.inner_ring")
    jumped.u[U.NOSE] = 200.0
    jumped.run(10e-3, 1e-3)  # eight pieces
    started.run(10e-3, 1e-3)
    for name in ("heat.inner_ring", "heat.oil", "friction_torque"):
        # found from other guesses: to the tolerance of the set's rest
        assert jumped.value(name) == pytest.approx(started.value(name), rel=1e-5)
    assert abs(jumped.value("heat.inner_ring") / before - 1.0) > 1e-3


@pytest.mark.parametrize(
    ("signs", "preload", "rpm", "force"),
    [("+-", 500.0, 0.0, 0.0), ("+-", 50.0, 20e3, 600.0), ("++", None, 15e3, 300.0), ("+-", 500.0, 60e3, 0.0)],
)
def test_extremes_stay_finite(signs, preload, rpm, force):
    """Standstill, a bearing without load, tandem, and a fast shaft."""
    load = {"force_x_N": force, "force_z_N": -30.0, "position_mm": 0.0}
    run = SetRun(
        wavy(scene(signs, (40.0, 70.0), preload, rpm, changes=WEIGHT, load=load)), FIDELITY=RINGS
    ).init()
    rows = run.run(5e-3, 5e-4)
    assert np.isfinite(rows).all()
    assert np.abs(velocities(run)).max() < 0.2


@pytest.mark.parametrize(("made", "asked"), [(0.0, RINGS), (RINGS, 0.0), (0.0, FIDELITIES["response"])])
def test_a_set_keeps_the_fidelity_that_it_was_made_for(made, asked):
    """Rings on pedestals of their own are coordinates of the set in all fidelities but full."""
    seats = {"bearings": [{}, {"seat": "pedestal"}], "housing": {"pedestal_stiffness_N_m": 1e8}}
    run = SetRun(scene("+-", (40.0, 70.0), **seats), FIDELITY=made)
    assert run.try_init() == OK
    run.p[P.FIDELITY] = asked
    assert run.try_init() == OTHER_FIDELITY


def test_other_sets_change_between_full_and_rings():
    run = SetRun(scene("+-", (40.0, 70.0), rpm=10e3)).init()
    run.p[P.FIDELITY] = RINGS
    assert run.try_init() == OK
    assert run.step(1e-3) == OK
    assert np.abs(velocities(run)).max() < 1e-9
