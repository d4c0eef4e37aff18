"""The oracle of sets in motion: one bearing as the engine runs it, energy, mirror, Newton matrix."""

from dataclasses import replace

import numpy as np
import pytest

from fmu_bearing import read_scene, statics
from fmu_bearing.elastic.shaft import ShaftModel, rigid_transform, shaft_model
from fmu_bearing.engine.layout import STRIDE, F, P, Q, S, U, Y
from fmu_bearing.engine.spindle import members, shaft as shaft_kernels
from fmu_bearing.prepare import bodies
from fmu_bearing.prepare.model import pack
from fmu_bearing.scene import si
from tests.conftest import GATES
from tests.engine.helpers import TILT_DAMPING, TILT_STIFFNESS, Run
from tests.marks import heavy_but
from tests.oracles import spindle_dynamics as oracle
from tests.spindle.dynamics import Bearing, at_rest, bearing_arrays, dense_answer, place_from, spindle_of
from tests.spindle.rest import oracle as rest
from tests.spindle.runs import SetRun
from tests.spindle.sets import scene

STEP = 2e-7  # s: with half of it rates differ by 1e-10 of the largest
NO_CAGE = {"bearing.cage": None, "materials.cage": None}
SLIDING = {
    "spindle.bearing[2].seat": "sliding",
    "spindle.preload": {"kind": "spring", "force_N": 500.0, "stiffness_N_m": 1e6},
}
BODY = {"mass_kg": 2.0, "diameter_mm": 100.0, "length_mm": 160.0, "pedestal_stiffness_N_m": 1e8}
SEATS = {
    "fixed": {},
    "pedestal": {"spindle.bearing[2].seat": "pedestal", "spindle.housing.pedestal_stiffness_N_m": 1e8},
    "sliding": SLIDING,
    "housing": {"spindle.housing": BODY},
    "sliding in housing": SLIDING | {"spindle.housing": BODY},
}


#: Shaft and inner rings are eccentric, and nothing else is wrong.
ECCENTRIC = {
    "unbalance_um": 2.0, "ball_diameter_spread_nm": 0.0, "inner_race_amplitude_um": 0.0,
    "outer_race_amplitude_um": 0.0,
}  # fmt: skip


def bent(scene):
    """The scene's shaft with two more coordinates at 3 kHz, which move its planes and are coupled by mass."""
    rigid, n, rng = shaft_model(scene, scene.spindle), 5, np.random.default_rng(3)

    def wider(matrix, corner, beside=None):
        side = np.zeros((n, 2)) if beside is None else beside
        return np.block([[matrix, side], [side.T, corner]])

    def moved(planes):
        shapes = rng.uniform(-1.0, 1.0, (len(planes), n, 2)) * np.array([1, 1, 1, 20, 20])[:, None]
        return tuple(np.hstack(both) for both in zip(planes, shapes, strict=True))

    return ShaftModel(
        wider(rigid.mass, 0.1 * np.eye(2), np.full((n, 2), 1e-3)),
        wider(rigid.damping, 20.0 * np.eye(2)),
        wider(rigid.stiffness, 0.1 * (2.0 * np.pi * 3e3) ** 2 * np.eye(2)),
        wider(rigid.gyroscopic, np.array([[0.0, 1e-3], [-1e-3, 0.0]])),
        np.hstack([rigid.across, [[0.01, 0.03], [0.02, -0.01]]]),
        moved([rigid.nose])[0],
        moved(rigid.planes),
        moved(rigid.spots),
        rigid.polar,
    )


def unbalanced(seat, cage=True, rpm=15e3):
    """Scene of a loaded and unbalanced DB pair with one of the seats."""
    changes = SEATS[seat] | ({} if cage else NO_CAGE)
    given = scene(
        "+-",
        (40.0, 70.0),
        None if "sliding" in seat else 500.0,
        rpm,
        changes={"fidelity.terms.gravity": True} | changes,
        load={"force_x_N": 100.0, "force_y_N": 30.0, "force_z_N": -100.0, "position_mm": -10.0},
    )
    heavy = [{"position_mm": 100.0, "amount_g_mm": 2.0, "angle_deg": 40.0}]
    return given.replace({"spindle.shaft.unbalance": heavy})


def system(seat, shaft=None, cage=True, speed_rate=0.0, rpm=15e3):
    """The oracle's system of that scene."""
    given = unbalanced(seat, cage, rpm)
    return spindle_of(given, shaft=None if shaft is None else shaft(given), speed_rate=speed_rate)


def shaken(spindle, seed=1):
    """Its start with everything displaced by parts of a micrometre, moving, and slipping by per cents."""
    rng, state = np.random.default_rng(seed), at_rest(spindle)
    places, rates = spindle.split(state)
    places += 3e-7 * rng.uniform(-1, 1, spindle.count)
    moved = 0.01 * rng.uniform(-1, 1, spindle.count)
    for one, own in zip(spindle.mounted, spindle.own, strict=True):
        n = one.bearing.balls
        spins = slice(own.start + 2 * n, own.start + 6 * n)
        moved[spins] *= rates[spins]
    rates += moved
    return state


def difference(at, h):
    """Central difference with the error of second order taken out."""
    first, second = (((at(k) - at(-k)) / (2.0 * k)) for k in (h, 0.5 * h))
    return (4.0 * second - first) / 3.0


@pytest.mark.parametrize("shaft", heavy_but([None, bent], 1), ids=["rigid", "bent"])
@pytest.mark.parametrize("seat", SEATS)
def test_newton_matrix_is_the_slope_of_the_residual(seat, shaft):
    spindle, gh, t = system(seat, shaft, speed_rate=3e4), 1e-5, 1e-3
    state = shaken(spindle)
    n = spindle.count
    accelerations = spindle.rate(t, state)[n : 2 * n]
    found = spindle.matrix(t, state, gh)
    left = np.abs(spindle.residual(t, state, accelerations))[spindle.carriers]
    assert left.max() < 1e-9  # N, of 500 N

    def column(k):
        def residual(d):
            trial, moved = state.copy(), accelerations.copy()
            trial[k] += gh * gh * d
            trial[n + k] += gh * d
            moved[k] += d
            return spindle.residual(t, trial, moved)

        # by 1e-5 m/s, rad/s of bodies, 1e-3 rad/s of balls: as for one bearing's Jacobian
        spin = any(
            own.start + 2 * one.bearing.balls <= k < own.start + 6 * one.bearing.balls
            for one, own in zip(spindle.mounted, spindle.own, strict=True)
        )
        return -difference(residual, (1e-3 if spin else 1e-5) / gh)

    slopes = np.array([column(k) for k in range(n)]).T
    error = np.abs(found - slopes).max(axis=1) / np.abs(slopes).max(axis=1)
    assert error.max() < 2e-5  # as one bearing's Jacobian, where the film of the cage's lands counts
    assert error[spindle.carriers].max() < 1e-7


@pytest.mark.parametrize("seat", SEATS)
def test_dense_answer_stands_in_the_engines_layout(seat):
    spindle, gh = system(seat, bent), 2e-5
    state, rng = shaken(spindle), np.random.default_rng(4)
    residuals = [rng.uniform(-1e3, 1e3, F.SIZE) for _ in spindle.mounted]
    carriers = rng.uniform(-1.0, 1.0, spindle.total_mass[spindle.carriers].shape[0])
    found, moved = dense_answer(spindle, state, residuals, carriers, gh)
    # each bearing's own equations hold for its driven motion, as the engine would check them
    struct = spindle.mass[spindle.carriers, spindle.carriers] @ moved
    damping, stiffness = (one[spindle.carriers, spindle.carriers] for one in spindle.matrices(0.0))
    struct += (gh * damping + gh * gh * stiffness) @ moved
    for k, (one, d, r) in enumerate(zip(spindle.mounted, found, residuals, strict=True)):
        n, bearing = one.bearing.balls, one.bearing
        unknowns = np.concatenate([d[: F.BODY].reshape(6, STRIDE)[:, :n].ravel(), d[F.BODY : F.WORK]])
        by_places, by_rates = bearing.slopes(*spindle.bearing_state(k, 0.0, state))
        left = unknowns - (gh * gh * by_places + gh * by_rates) @ unknowns
        wanted = np.concatenate([r[: F.BODY].reshape(6, STRIDE)[:, :n].ravel(), r[F.BODY : F.WORK]])
        rows = np.arange(6 * n + Q.SIZE)
        own = np.concatenate([rows[: 6 * n], 6 * n + np.array(one.free, dtype=int)])
        free = left - wanted
        if one.seat == "sliding":  # its spring is not in the bearing's own equations
            (_, stretch, (_, constant), mass) = next(iter(spindle.springs()))
            whole = np.zeros(spindle.count)
            whole[spindle.own[k]] = unknowns[own]
            whole[spindle.carriers] = moved
            push = gh * gh * constant * (stretch @ whole)
            free[6 * n + 5] += push / mass
            struct += push * stretch[spindle.carriers]
        assert np.abs(free[own]).max() < 1e-7  # of 1e3
        weights = np.zeros(rows.size)
        weights[6 * n :][: oracle.RINGS] = bearing.masses[: oracle.RINGS]
        for body in spindle.carried(k):
            weights[6 * n + body] = bearing.masses[body]
        struct += spindle.motions[k][:, spindle.carriers].T @ (weights * left)
        ring = spindle.motions[k][6 * n : 6 * n + 5, spindle.carriers] @ moved
        np.testing.assert_allclose(d[F.BODY : F.BODY + 5], ring, rtol=1e-12)
        if seat == "fixed":
            assert not d[F.BODY + Q.OUTER : F.BODY + Q.CAGE].any()
    np.testing.assert_allclose(struct, carriers, rtol=0, atol=1e-7)


@pytest.mark.parametrize("seat", SEATS)
def test_elimination_of_each_bearing_gives_the_dense_answer(seat):
    """Bearings condensed to the rings that are carried, held (carried by nothing) or slide: the same answer.

    A sliding ring's x is one more coordinate beside shaft and housing, without mass of its own: so its spring
    may be between ring and housing, and the bearing's own equations stay as they are.
    """
    spindle, gh = system(seat, bent), 2e-5
    state, rng = shaken(spindle), np.random.default_rng(5)
    right = rng.uniform(-1.0, 1.0, spindle.count) * np.where(np.diag(spindle.mass) == 0.0, 1e3, 1.0)
    expected = np.linalg.solve(spindle.matrix(0.0, state, gh), right)
    slides = [place for place, *_ in spindle.springs()]
    joint = np.concatenate([np.arange(spindle.count)[spindle.carriers], np.array(slides, dtype=int)])
    damping, stiffness = spindle.matrices(0.0)
    matrix, force = spindle.mass + gh * damping + gh * gh * stiffness, right.copy()
    for place, stretch, (_, constant), mass in spindle.springs():
        matrix += gh * gh * constant * np.outer(stretch, stretch)
        force[place] *= mass
    matrix, force, kept = matrix[np.ix_(joint, joint)], force[joint], []
    for k, one in enumerate(spindle.mounted):
        size = 6 * one.bearing.balls
        by_places, by_rates = one.bearing.slopes(*spindle.bearing_state(k, 0.0, state))
        own = np.eye(size + Q.SIZE) - gh * by_rates - gh * gh * by_places
        last = Q.OUTER if one.seat == "pedestal" else Q.RINGS
        rings = size + np.arange(last)
        rest = np.array(
            [i for i in range(size + (Q.SIZE if one.bearing.caged else Q.RINGS)) if i not in rings]
        )
        carries = spindle.motions[k][np.ix_(rings, joint)]
        masses = one.bearing.masses[:last, None]
        alone = spindle.motions[k][rest] @ right  # residual of what moves by itself; zero in the rings' rows
        inverse = np.linalg.inv(own[np.ix_(rest, rest)])
        condensed = own[np.ix_(rings, rings)] - own[np.ix_(rings, rest)] @ inverse @ own[np.ix_(rest, rings)]
        at_once = np.linalg.solve(condensed, -own[np.ix_(rings, rest)] @ inverse @ alone)
        matrix += carries.T @ (masses * (condensed @ carries))
        force += carries.T @ (masses[:, 0] * (condensed @ at_once))
        kept.append((own, rest, rings, carries, inverse, alone))
    moved = np.linalg.solve(matrix, force)
    limit = 1e-9 * np.abs(expected).max()
    np.testing.assert_allclose(moved, expected[joint], rtol=0, atol=1e-9 * np.abs(expected[joint]).max())
    for k, (own, rest, rings, carries, inverse, alone) in enumerate(kept):
        found = inverse @ (alone - own[np.ix_(rest, rings)] @ carries @ moved)
        np.testing.assert_allclose(found, spindle.motions[k][rest] @ expected, rtol=0, atol=limit)


@pytest.mark.parametrize("seat", heavy_but(list(SEATS), "housing"))
def test_energy_closes(seat):
    """Work less heat less change of energy, with unbalance and a speed that rises: rounding of the sums."""
    spindle = system(seat, bent, speed_rate=3e4)
    state = at_rest(spindle)
    before, t = spindle.energy(0.0, state), 4e-5
    state = oracle.runge_kutta(spindle.rate, state, t, STEP)
    work, heat = state[-2:]
    assert heat > 4e-4
    assert abs(work - heat - (spindle.energy(t, state) - before)) < 1e-8 * heat


def test_a_ring_that_warms_does_work():
    """10 um within 1 ms push the pair apart: the same balance, which only the work of that push closes."""
    spindle = system("fixed")
    still = at_rest(spindle)
    spindle.mounted = (replace(spindle.mounted[0], growth=0.01), spindle.mounted[1])
    before, t = spindle.energy(0.0, still), 4e-5
    state = oracle.runge_kutta(spindle.rate, still, t, STEP)
    work, heat = state[-2:]
    change = spindle.energy(t, state) - before
    assert change > 0.1 * heat
    assert abs(work - heat - change) < 1e-8 * heat
    assert bearing_arrays(spindle, state, t)[0][Y.V0] != pytest.approx(
        state[spindle.count :][spindle.of_shaft][0]
    )


@pytest.mark.parametrize("shaft", [None, bent], ids=["rigid", "bent"])
def test_heavy_spots_of_a_shaft_that_speeds_up_push_as_in_the_oracle(shaft):
    """At 80 rad/s and 3e4 rad/s2 the tangential force is five times the radial one."""
    given = unbalanced("housing").replace({"imperfections": ECCENTRIC})
    own = None if shaft is None else shaft(given)
    spindle, run = spindle_of(given, shaft=own), SetRun(given, shaft=own)
    spindle.drive = replace(spindle.drive, nose=np.zeros(5), angle=0.7, speed=80.0, speed_rate=3e4)
    wanted = spindle.outside(0.0)[spindle.carriers]
    found = np.zeros(members.padded_size(run.p))
    shaft_kernels.unbalance_force(run.p, 0.7, 80.0, 3e4, found, 0)
    # of 0.06 N: two sums of the same products
    np.testing.assert_allclose(found[: wanted.size], wanted, rtol=0, atol=1e-13 * np.abs(wanted).max())
    assert not found[wanted.size :].any()


def test_both_bearings_turn_the_housing_with_the_shaft():
    """A mirror keeps turns about the axis, and friction without drag goes from ring to ring."""
    drag = {"fidelity.terms.drag": False}
    spindle = spindle_of(scene(rpm=15e3, changes=NO_CAGE | drag | {"spindle.housing": BODY}))
    force, power, _ = spindle.forces(0.0, at_rest(spindle))
    # balls orbit and spin steadily, so what they take from the shaft goes to the housing
    torque = power / spindle.drive.speed
    assert torque > 0.01
    assert force[spindle.of_housing][3] == pytest.approx(torque, rel=0.01)


def mounted(sign, in_housing):
    """The gate scene of a spindle as the engine runs it, and as a set of one bearing, its rotor a shaft."""
    base = read_scene(GATES / "7003C-spindle.toml").model_copy(update={"sound": None})
    run = Run(base, 20000.0, TOLERANCE=1e-6).init()
    bare = {"rotor": None} | ({"housing": None} if in_housing else {})
    alone = base.model_copy(update={"mounting": base.mounting.model_copy(update=bare)})
    p = pack(alone.with_rigid_rings(), np.empty(0))
    p[P.ECCENTRICITY] = p[TILT_STIFFNESS] = p[TILT_DAMPING] = 0.0
    u, position = run.u.copy(), 0.05
    u[U.PRELOAD] = 0.0
    bearing, plane = Bearing(p, u, own=not in_housing), rigid_transform(1.0, position)
    rotor = bodies.rotor(base)
    gyroscopic = np.zeros((5, 5))
    gyroscopic[3, 4], gyroscopic[4, 3] = rotor.polar, -rotor.polar
    tilts = np.diag([0.0, 0.0, 0.0, 1.0, 1.0])
    shaft = ShaftModel(
        plane.T @ np.diag([rotor.mass] * 3 + [rotor.transverse] * 2) @ plane,
        run.p[TILT_DAMPING][0] * tilts,
        run.p[TILT_STIFFNESS][0] * tilts,
        gyroscopic,
        rotor.mass * plane[1:3],
        rigid_transform(1.0, 0.0),
        (plane,),
        (plane,),
        rotor.polar,
    )
    drive = oracle.Drive(
        u[U.SPEED],
        nose=np.array([sign * run.u[U.PRELOAD], 0.0, 0.0, 0.0, 0.0]),
        spots=((run.p[P.INNER_MASS] * run.p[P.ECCENTRICITY], 0.0),),
    )
    body = None
    if in_housing:
        mount, size, ring = si(base.mounting), si(base.mounting.housing), bodies.outer_ring(base)
        body = oracle.Housing.cylinder(
            size.mass, size.diameter, size.length, position, mount.pedestal_stiffness,
            mount.pedestal_axial_ratio, mount.pedestal_rotational_ratio, mount.pedestal_damping_ratio,
            np.array([ring.mass] * 3 + [ring.polar] + [ring.transverse] * 2),
        )  # fmt: skip
    seat = "fixed" if in_housing else "pedestal"
    one = oracle.Mounted(bearing, sign, position, plane, seat=seat)
    return run, oracle.Spindle([one], shaft, drive, body)


@pytest.mark.parametrize(
    ("sign", "in_housing"), heavy_but([(1.0, False), (-1.0, False), (1.0, True), (-1.0, True)], "-1.0-True")
)
def test_one_bearing_runs_as_in_the_engine(sign, in_housing):
    """Rotor and housing of a mounted bearing as shaft and body of a set, mirrored or not."""
    run, spindle = mounted(sign, in_housing)
    y = run.s[S.Y : S.Y + Y.SIZE]
    q, v = y[Y.Q0 : Y.V0], y[Y.V0 :]
    own = oracle.at_plane(sign, 0.05)
    carriers = np.array([np.linalg.solve(own, part[:5]) for part in (q, v)])
    if in_housing:
        by_housing = oracle.of_housing(sign, 0.05)
        rings = np.array([np.linalg.solve(by_housing, part[5:11]) for part in (q, v)])
        carriers = np.hstack([carriers, rings])
    state = place_from(spindle, [y], carriers)
    np.testing.assert_allclose(bearing_arrays(spindle, state)[0][Y.Q0 :], y[Y.Q0 :], rtol=0, atol=1e-17)
    state = oracle.runge_kutta(spindle.rate, state, 4e-4, STEP)
    run.run(4e-4)
    rates = bearing_arrays(spindle, state)[0][Y.V0 :][: Q.RINGS]
    expected = run.s[S.Y + Y.V0 :][: Q.RINGS]
    size = np.abs(expected[:3]).max()
    assert size > 5e-3
    # the design study's gate of the engine is 1e-5; its tolerance here is 1e-6 of the same size
    np.testing.assert_allclose(rates, expected, rtol=0, atol=1e-6 * size)
    assert state[-2] == pytest.approx(run.s[S.WORK], rel=1e-6)
    assert state[-1] == pytest.approx(run.heat, rel=1e-6)


def axial(spindle, state, t):
    """Axial force (N) of the balls on each inner ring, own axes."""
    return [
        spindle.answer(k, t, state).bodies[0] * one.bearing.masses[0] for k, one in enumerate(spindle.mounted)
    ]


@pytest.mark.heavy
def test_a_pair_stays_at_its_statics_and_in_its_mirror():
    """DB at 10,000 r/min under a load between its bearings: each does what the other does in a mirror."""
    given = scene(rpm=10e3, changes=NO_CAGE)
    spindle = spindle_of(given)
    state = oracle.runge_kutta(spindle.rate, at_rest(spindle), 1e-3, STEP)
    forces = np.array(axial(spindle, state, 1e-3))
    np.testing.assert_allclose(-forces, 500.0, rtol=0, atol=0.5)  # the design study's gate
    # statics leaves out drag, rolling resistance and traction along the rolling direction
    running = statics(given, force=(0.0, 0.0, 0.0)).preloads["running"]
    np.testing.assert_allclose(-forces, running, rtol=0, atol=0.05)
    loaded = {"force_z_N": -150.0, "force_y_N": 40.0, "position_mm": 200.0}  # where the shaft's middle is
    spindle = spindle_of(scene("+-", (185.0, 215.0), rpm=10e3, changes=NO_CAGE, load=loaded))
    state = oracle.runge_kutta(spindle.rate, at_rest(spindle), 2e-4, STEP)
    first, second = bearing_arrays(spindle, state)
    moved = np.abs(first[Y.V0 :][:3]).max()
    assert moved > 1e-6  # m/s: balls that pass make the shaft move
    np.testing.assert_allclose(first[: Y.VX], second[: Y.VX], rtol=0, atol=1e-12)
    np.testing.assert_allclose(first[Y.Q0 : Y.V0], second[Y.Q0 : Y.V0], rtol=0, atol=1e-14)
    np.testing.assert_allclose(first[Y.V0 :], second[Y.V0 :], rtol=0, atol=1e-6 * moved)


@pytest.mark.parametrize("seat", SEATS)
def test_the_start_is_an_equilibrium(seat):
    """Shaft and housing rest, but for products of tilts of a housing (3e-4 rad) with the preload of 500 N."""
    spindle = system(seat, bent, rpm=1.0, cage=False)
    left = spindle.residual(0.0, at_rest(spindle), np.zeros(spindle.count))[spindle.carriers]
    assert np.abs(left).max() < (0.5 if "housing" in seat else 0.02)


def test_place_of_the_start_is_that_of_the_oracle_of_statics():
    given = scene(rpm=10e3, load={"force_x_N": 200.0, "force_z_N": -300.0})
    spindle = spindle_of(given)
    places, _ = spindle.split(at_rest(spindle))
    found = rest(given).shaft
    np.testing.assert_allclose(places[spindle.of_shaft], found, rtol=0, atol=1e-9 * np.abs(found).max())
    # statics has the friction of the steady state: it turns the shaft aside by 7e-8 of 1.3e-4 rad
    found = statics(given).displacement
    np.testing.assert_allclose(places[spindle.of_shaft], found, rtol=0, atol=1e-3 * np.abs(found).max())
