"""The operating point: a steady state of the full equations, found without a run."""

import numpy as np
import pytest
from scipy.optimize import root

from fmu_bearing.arrays import Arrays
from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import PT, STRIDE, C, F, J, P, Q, S, U, W, Y
from fmu_bearing.engine.status import OK
from fmu_bearing.engine.steady.point import EVEN_BALLS, REST, WHIRL
from fmu_bearing.scene.mounting import TiltSupport
from fmu_bearing.scene.read import read_scene_text, with_fidelity
from tests.engine.helpers import Run, quiet

SUPPORT = TiltSupport(stiffness_N_m_rad=2e4, damping_ratio=0.05)


SCENE = """
name = "{bearing}"
bearing.catalogue = "{bearing}"
materials = {{ inner_ring = "GCr15", outer_ring = "GCr15", balls = "Si3N4", cage = "bakelite" }}
lubricant.catalogue = "spindle-oil"
mounting = {{ preload_N = {preload}, pedestal_stiffness_N_m = 1e8, radial_load_z_N = {load} }}
operation.speed_rpm = {rpm}
"""


def scene_at(bearing, rpm, preload, load=0.0, support=SUPPORT, fidelity="full", **mounting):
    """Perfect bearing of the catalogue at 20 degC; ``load`` (N) upwards."""
    text = SCENE.format(bearing=bearing, rpm=float(rpm), preload=float(preload), load=float(load))
    made = read_scene_text(text, bearing)
    own = made.mounting.model_copy(update={"tilt_support": support, **mounting})
    return with_fidelity(made.model_copy(update={"mounting": own}), model=fidelity)


def started(*args, parameters=None, **kwargs) -> Arrays:
    made = Arrays.of(scene_at(*args, **kwargs), **(parameters or {}))
    made.init()
    return made


def right_hand_side(bearing, y):
    f = np.zeros(F.SIZE)
    c = bearing.s[S.C : S.C + C.SIZE]
    call("right_hand_side", bearing.p, c, y, bearing.w, f, 0.0, float(bearing.u[U.SPEED]), 0.0)
    return f


def torque(bearing):
    """Torque (N mm) that puts in the heats."""
    return 1e3 * bearing.s[S.F + F.HEAT : S.F + F.HEAT + 3].sum() / bearing.u[U.SPEED]


def balls(bearing, row):
    return bearing.s[S.Y + row : S.Y + row + int(bearing.p[P.BALLS])]


def lost(bearing, seconds, h=1e-3):
    """Mean torque (N mm) of a run, from what it dissipates."""
    before = bearing.s[S.HEAT : S.HEAT + 3].sum()
    bearing.run(seconds, h)
    return 1e3 * (bearing.s[S.HEAT : S.HEAT + 3].sum() - before) / seconds / bearing.u[U.SPEED]


def test_even_balls_are_a_root_of_the_equations():
    """SciPy finds the same place, spins and orbit from five per cent beside it."""
    bearing = started("NSK-7008AC", 14000, 400, parameters={"CAGE": 0.0, "GRAVITY": 0.0})
    found = bearing.s[S.Y : S.Y + Y.SIZE].copy()
    n, lanes = int(bearing.p[P.BALLS]), int(bearing.p[P.LANES])
    rows = [Y.X, Y.R, Y.OM, Y.WX, Y.WR, Y.WT]
    rings = [Y.Q0, Y.Q0 + Q.OUTER, Y.Q0 + Q.OUTER + Q.TURN]
    start = np.array([found[k] for k in rows + rings])
    unit = np.array([1e-6, 1e-6, 1.0, 1.0, 1.0, 1.0, 1e-6, 1e-6, 1e-6])

    def balance(x):
        y = found.copy()
        for row, value in zip(rows, x, strict=False):
            y[row : row + lanes] = value * unit[rows.index(row)]
        for k, ring in enumerate(rings):
            y[ring] = x[len(rows) + k] * unit[len(rows) + k]
        f = right_hand_side(bearing, y)
        body = [f[F.BODY], f[F.BODY + Q.OUTER], f[F.BODY + Q.OUTER + Q.TURN]]
        return np.array([f[i * STRIDE : i * STRIDE + n].mean() for i in range(6)] + body)

    beside = start / unit * np.where(unit == 1.0, 1.001, 1.0)
    answer = root(balance, beside, method="hybr", options={"xtol": 1e-12})
    assert answer.success
    # differences of SciPy's own Jacobian leave 1e-7
    assert answer.x == pytest.approx(start / unit, rel=1e-5, abs=1e-5)


@pytest.mark.parametrize(
    ("bearing", "rpm", "preload", "load", "kind"),
    [
        ("NSK-7008AC", 20000, 400, 0.0, WHIRL),
        ("NSK-7010C", 14000, 150, 0.0, WHIRL),
        ("NSK-7008AC", 20000, 400, -120.0, REST),
        ("NSK-7010C", 20000, 400, -200.0, REST),
        ("NSK-7010C", -20000, 400, -40.0, REST),
        ("NSK-7010C", 1000, 390, -100.0, REST),
    ],
)
def test_each_ball_does_what_the_one_ahead_did(bearing, rpm, preload, load, kind):
    """After the time from ball to ball the run shows the same pattern, one ball further and turned."""
    run = started(bearing, rpm, preload, load)
    assert run.s[S.SETTLED] == kind
    n = int(run.p[P.BALLS])
    first = {row: balls(run, row).copy() for row in (Y.X, Y.R, Y.OM, Y.WX, Y.WR, Y.WT)}
    k = S.Y + Y.Q0 + Q.CAGE + Q.Y
    cage = complex(*run.s[k : k + 2])
    orbit = first[Y.OM].mean()
    rate = S.Y + Y.V0 + Q.CAGE + Q.Y
    whirl = 0.0 if kind == REST else abs(complex(*run.s[rate : rate + 2])) / abs(cage) * np.sign(rpm)
    # balls run through a pattern that turns itself
    passing = 2 * np.pi / n / abs(orbit - whirl)
    before = torque(run)
    run.run(passing, passing / 4)
    behind = 1 if (orbit - whirl) * orbit > 0 else -1
    step = behind * int(np.sign(rpm))
    for row, size in (
        (Y.X, 3e-7),
        (Y.R, 3e-7),
        (Y.OM, 5e-3 * abs(orbit)),
        (Y.WX, 5e-3 * np.abs(first[Y.WX]).max()),
    ):
        # a slope of third order, and steps of the run that err by some 1e-3 of what varies
        assert np.abs(balls(run, row) - np.roll(first[row], -step)).max() < size
    # the cage turned on; or it rests, but for what it moves as the balls pass
    turned = complex(*run.s[k : k + 2]) * np.exp(-1j * whirl * passing)
    assert abs(turned - cage) < (0.1 if kind == REST else 0.03) * run.p[P.LAND_CLEARANCE]
    assert torque(run) == pytest.approx(before, rel=0.02)


@pytest.mark.parametrize("fidelity", ["rings", "response"])
@pytest.mark.parametrize("load", [0.0, -120.0])
def test_fidelities_agree_on_torque_heat_and_orbit(fidelity, load):
    full = started("NSK-7008AC", 20000, 400, load)
    other = started("NSK-7008AC", 20000, 400, load, fidelity=fidelity)
    # the same point, found from starts that differ in what weights do
    assert torque(other) == pytest.approx(torque(full), rel=5e-3)
    assert balls(other, Y.OM).mean() == pytest.approx(balls(full, Y.OM).mean(), rel=1e-4)


@pytest.mark.parametrize(
    ("rpm", "preload", "share", "support"),
    [
        (20000, 400, 0.3, None),
        (20000, 400, 0.5, None),
        (14000, 150, 0.3, None),
        (14000, 150, 0.5, None),
        (14000, 150, 0.8, None),
        (20000, 150, 0.3, SUPPORT),
        (20000, 150, 0.5, SUPPORT),
    ],
)
def test_large_radial_loads_have_their_point(rpm, preload, share, support):
    """Where balls run into their pockets and out again; all fidelities have it."""
    point = started("NSK-7008AC", rpm, preload, share * preload, support)
    assert point.s[S.SETTLED] == REST
    other = started("NSK-7008AC", rpm, preload, share * preload, support, fidelity="rings")
    assert torque(other) == pytest.approx(torque(point), rel=5e-3)
    n = int(point.p[P.BALLS])
    y = point.s[S.Y : S.Y + Y.SIZE]
    f = right_hand_side(point, y)
    # with what its pattern means nothing is left: rates pass from ball to ball
    through = y[Y.OM : Y.OM + n].mean()
    for acceleration, rate, size in ((F.X, Y.VX, 9.81), (F.R, Y.VR, 9.81)):
        passed = through * slopes(y[rate : rate + n])
        assert np.abs(f[acceleration : acceleration + n] - passed).max() < 1e-2 * size


def slopes(row):
    """Slope (1/rad) of a row of balls, of third order, as of ``steady.pattern``."""
    ahead, behind, two_behind = np.roll(row, -1), np.roll(row, 1), np.roll(row, 2)
    return row.size / (2 * np.pi) * (ahead / 3 + row / 2 - behind + two_behind / 6)


def eigenvalues_at_rest(bearing, y):
    """Eigenvalues (1/s) of a bearing about a pattern at rest, in the order of states, from the Jacobian."""
    p, z = bearing.p, int(bearing.p[P.BALLS])
    jac = np.zeros(J.SIZE)
    call("jacobian", p, bearing.s[S.C : S.C + C.SIZE], y, bearing.w, jac, 0.0, float(bearing.u[U.SPEED]), 0.0)

    def block(first, rows, columns, of_balls=True):
        if not of_balls:
            return jac[first:][: rows * columns].reshape(rows, columns)
        return jac[first:][: rows * columns * STRIDE].reshape(rows, columns, STRIDE)[:, :, :z]

    own, by_body = block(J.B, J.BALL, J.STATES), block(J.C, J.BALL, J.BODIES)
    by_ball, bodies = block(J.D, Q.SIZE, J.STATES), block(J.E, Q.SIZE, J.BODIES, False)
    passing = y[Y.V0 + Q.CAGE + Q.TURN] * np.array([slopes(column) for column in np.eye(z)]).T
    last = J.STATES * z
    a = np.zeros((last + J.BODIES, last + J.BODIES))
    for k in range(J.STATES):
        for i in range(J.BALL):
            a[(J.PLACED + i) * z :, k * z :][range(z), range(z)] = own[i, k]
        a[last + Q.SIZE :, k * z :][: Q.SIZE, :z] = by_ball[:, k]
    for i in range(J.BALL):
        a[(J.PLACED + i) * z :, last:][:z] = by_body[i].T
    for k in range(J.PLACED):
        a[k * z :, (J.PLACED + k) * z :][range(z), range(z)] = 1.0
    for k in range(J.STATES):
        a[k * z :, k * z :][:z, :z] -= passing
    a[last : last + Q.SIZE, last + Q.SIZE :] = np.eye(Q.SIZE)
    a[last + Q.SIZE :, last:] = bodies
    return np.linalg.eigvals(a)


@pytest.mark.parametrize(
    ("bearing", "rpm", "preload", "load", "support", "kind"),
    [
        # in runs of full the cage whirls with 4 and 7 N across, and rests with 10 and 40
        ("NSK-7008AC", 20000, 400, 4.0, SUPPORT, WHIRL),
        ("NSK-7008AC", 20000, 400, 7.0, SUPPORT, WHIRL),
        ("NSK-7008AC", 20000, 400, 10.0, SUPPORT, REST),
        ("NSK-7008AC", 20000, 400, 40.0, SUPPORT, REST),
        ("NSK-7010C", 20000, 400, 0.0, SUPPORT, WHIRL),
        ("NSK-7008AC", 8000, 400, 0.0, SUPPORT, REST),
        # its weight alone: full holds 245.7 N mm, 217.6 with a cage at rest
        ("NSK-7014C", 12000, 300, 0.0, TiltSupport(stiffness_N_m_rad=5e4, damping_ratio=0.05), WHIRL),
    ],
)
def test_a_cage_whirls_where_its_whirl_grows(bearing, rpm, preload, load, support, kind):
    point = started(bearing, rpm, preload, load, support)
    assert point.s[S.SETTLED] == kind
    rest = point.w[W.PATTERN + PT.REST_STATE : W.PATTERN + PT.WHIRL_STATE].copy()
    values = eigenvalues_at_rest(point, rest)
    # a whirl of the cage: about half of shaft speed
    ratio = values.imag / point.u[U.SPEED]
    growth = values.real[(ratio > 0.3) & (ratio < 0.7)].max()
    assert (growth > 0.0) == (kind == WHIRL)


@pytest.mark.parametrize(("mass", "film"), [(10.0, 0.3), (1.0, 0.03)])
def test_a_whirl_that_the_dry_stop_limits(mass, film):
    """A heavy cage, or a film of a thirtieth of the viscosity: the cage runs along the lands' stop."""
    usual = started("NSK-7008AC", 20000, 400).p
    changed = {
        "CAGE_MASS": mass * usual[P.CAGE_MASS],
        "LAND_VISCOSITY": film * usual[P.LAND_VISCOSITY],
    }
    run = started("NSK-7008AC", 20000, 400, parameters=changed)
    assert run.s[S.SETTLED] == WHIRL
    y = run.s[S.Y : S.Y + Y.SIZE]
    inner, cage = (complex(*y[Y.Q0 + k + Q.Y : Y.Q0 + k + Q.Y + 2]) for k in (Q.INNER, Q.CAGE))
    assert abs(cage - inner) > run.p[P.LAND_STOP_FRACTION] * run.p[P.LAND_CLEARANCE]
    first = torque(run)
    run.run(0.1, 1e-3)
    assert lost(run, 0.05) == pytest.approx(first, rel=0.03)


def test_balls_between_springs_start_where_loads_put_them(scene):
    """Patterns do not know springs between balls: orbit and spin alone are settled, and the loads count."""
    run = Run(quiet(scene("7003C-bare")), 20000, CAGE=0.0, SPRINGS=1e5)
    run.u[U.LOAD_Z] = 100.0
    run.init()
    assert run.s[S.SETTLED] == EVEN_BALLS
    z = S.Y + Y.Q0 + Q.Z
    first = run.s[z]
    places = []
    for _ in range(100):
        assert run.step(1e-4) == OK
        places.append(run.s[z])
    assert first > 3e-6
    # balls that a radial load spreads settle between their springs
    assert np.abs(np.array(places) - first).max() < 0.1 * first


def test_rigid_preload_keeps_its_place_and_finds_its_load():
    run = started("NSK-7008AC", 14000, 400, preload_mode="rigid")
    place = run.s[S.Y + Y.Q0]
    assert place == run.s[S.PLACE]
    start = torque(run)
    assert lost(run, 0.02) == pytest.approx(start, rel=0.01)
    assert run.s[S.Y + Y.Q0] == pytest.approx(place, abs=1e-15)


@pytest.mark.parametrize("fidelity", ["rings", "response"])
def test_torque_follows_the_load_of_a_rigid_preload(fidelity):
    """Warm rings, a jump of temperature, a jump of the preload: settled, and 2 ms after the jump.

    `response` renews what it holds, and then its lines, in some 20 pieces of 1 ms each: it is settled then.
    """
    kinds = {}
    for kind in ("full", fidelity):
        run = started("NSK-7008AC", 8000, 400, preload_mode="rigid", fidelity=kind)
        found = []
        for place, value, rest in (
            (U.INNER_T, 323.15, 0.06),
            (U.INNER_T, 353.15, 0.06),
            (U.PRELOAD, 200.0, 0.06),
        ):
            run.u[place] = value
            run.run(2e-3, 1e-3)
            found.append(1e3 * run.s[S.MEAN_TORQUE])
            run.run(rest, 1e-3)
            found.append(1e3 * run.s[S.MEAN_TORQUE])
        kinds[kind] = np.array(found)
    assert kinds["full"].max() > 1.3 * kinds["full"].min()
    # a new preload moves the ring of full over one step, and its cage takes its time
    compared = slice(1, None, 2) if fidelity == "response" else slice(None)
    assert kinds[fidelity][compared] == pytest.approx(kinds["full"][compared], rel=0.03)


def test_a_bearing_at_rest_starts_as_before():
    run = started("NSK-7008AC", 0, 400)
    assert run.s[S.SETTLED] == 0.0
    assert np.isfinite(run.z).all()
