"""Local defects: what their tables leave of a contact, the forces from that, energy, and turning balls."""

import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from fmu_bearing.compiled import call
from fmu_bearing.engine.layout import DE, STRIDE, C, F, P, Q, R, S, W, X, Y
from fmu_bearing.engine.mechanics.ball_waves import advance_axes, first_axes, turn_axes
from fmu_bearing.engine.mechanics.defects import acts_across, left_over, scaled_left_over
from fmu_bearing.engine.mechanics.energy import stored_energy
from fmu_bearing.prepare.defect_blocks import rows
from tests.engine.defects import left, on_ball, on_race, smooth, with_defects
from tests.engine.test_jacobian import agree, shaken

AT = 3  # where a table begins in these parameters
TABLE = smooth()
SHALLOW = smooth(touch=3e-7, lost=4e-6, deepest=2e-5)  # balls of shaken states go on touching
ASIDE = 2e-4  # m: how far a contact is from the defect's middle
DEFECTS = ("inner", "outer", "two", "ball at inner", "ball at outer", "both")


def places(count, seed=1):
    """Approaches, some beyond the last of the table, and places within it."""
    rng = np.random.default_rng(seed)
    x = 0.999 * rng.uniform(*TABLE.places[[0, -1]], count)
    return zip(rng.uniform(-1e-6, 1.2e-5, count), x, strict=True)


def test_a_table_is_interpolated_as_by_splines():
    p = np.concatenate([np.zeros(AT), rows(TABLE)])
    for delta, x in places(300):
        # rounding of 1e-5 m
        assert left_over(p, AT, delta, x)[0] == pytest.approx(left(TABLE, delta, x), abs=1e-20)


def test_slopes_and_bends_are_those_of_what_is_left():
    p, d, dx, ds = np.concatenate([np.zeros(AT), rows(TABLE)]), 1e-10, 1e-8, 1e-5
    for scale, (delta, x) in zip(np.linspace(0.3, 1.5, 60), places(60, 2), strict=True):

        def at(delta=delta, x=x, scale=scale):
            return np.array(scaled_left_over(p, AT, scale, delta, x))

        _, gain, slope, twice, both, along, by_scale = at()
        by_delta = (at(delta=delta + d) - at(delta=delta - d)) / (2.0 * d)
        by_x = (at(x=x + dx) - at(x=x - dx)) / (2.0 * dx)
        growing = (at(scale=scale + ds) - at(scale=scale - ds)) / (2.0 * ds)
        # bends jump at nodes: 1e6/m2 times the step of the differences
        assert by_delta[:3] == pytest.approx([gain, twice, both], rel=1e-3, abs=1e-3)
        assert by_x[:3] == pytest.approx([slope, both, along], rel=1e-3, abs=1e-3)
        assert growing[0] == pytest.approx(by_scale, rel=1e-4, abs=1e-13)


def test_a_number_that_is_none_meets_no_place():
    p = np.concatenate([np.zeros(AT), rows(TABLE)])
    assert np.isnan(left_over(p, AT, np.nan, 0.0)[0])
    assert np.isfinite(left_over(p, AT, np.inf, 0.0)[1])


def test_a_ball_s_defect_fades_across_the_track():
    at = [acts_across(y, 2e-4, 6e-4) for y in (-7e-4, -4e-4, 0.0, 2e-4, 4e-4, 6e-4)]
    assert [share for share, _ in at] == pytest.approx([0.0, 0.5, 1.0, 1.0, 0.5, 0.0])
    # steepest half way: 3/2 over the 0.4 mm
    assert [slope for _, slope in at] == pytest.approx([0.0, 3750.0, 0.0, 0.0, -3750.0, 0.0])


def pressed(point):
    """Ball that both races press most."""
    approach = [point.w[W.RACE + race * R.SIZE + R.APPROACH :][: point.balls] for race in range(2)]
    return int(np.argmax(np.min(approach, axis=0)))


def direction(point, race, ball):
    """Direction of a defect of a ball that its contact with a race meets aside, in the orbiting axes."""
    e, m = (point.w[W.RACE + race * R.SIZE + place + ball :: STRIDE][:3] for place in (R.EN, R.EM))
    t = point.w[W.POSE + race * X.SIZE + X.T + ball :: STRIDE][:3]
    d = e - 0.05 * t + 0.03 * m
    return tuple(d / np.linalg.norm(d))


def flawed(point, kind, ball):
    """Put defects under and on a ball of a state; returns the axes of the state with their directions."""
    p, y = point.p, point.y
    turned = point.angle, y[Y.Q0 + Q.OUTER + Q.TURN]

    def race(k, aside=ASIDE, number=0):
        one = on_race(p, k, SHALLOW, number=number)
        return one._replace(angle=y[Y.TH + ball] - turned[k] - aside / one.radii[k])

    def own(k, number=0):
        return on_ball(p, (SHALLOW, SHALLOW), ball, direction(point, k, ball), number=number)

    placed = {
        "inner": lambda: [race(0)], "outer": lambda: [race(1)], "two": lambda: [race(1), race(1, -ASIDE, 1)],
        "ball at inner": lambda: [own(0)], "ball at outer": lambda: [own(1)],
        "both": lambda: [race(1), own(1, 1)],
    }[kind]()  # fmt: skip
    point.p = with_defects(p, *placed)
    point.c[C.DEFECT_SCALE : C.DEFECT_SCALE + len(placed)] = 0.9
    axes = np.zeros(S.JAC - S.AXES)
    first_axes(point.p, axes)
    turn_axes(point.p, axes, y, int(p[P.LANES]), 0.0, point.w)
    return axes


def state(scene, kind, ball_waves=None):
    """A state with defects, its axes, and the ball that meets them."""
    point = shaken(scene("7003C-spindle"), WAVINESS=0.0, ball_waves=ball_waves)
    point.accelerations(point.y)
    ball = pressed(point)
    return point, flawed(point, kind, ball), ball


def energy(point, axes, y, t):
    """Stored energy (J) of a state that ``t`` (s) of motion lead to."""
    turn_axes(point.p, axes, point.y, int(point.p[P.LANES]), t, point.w)
    angle, f = point.angle + t * point.speed, np.zeros(F.SIZE)
    call("right_hand_side", point.p, point.c, y, point.w, f, angle, point.speed, 0.0)
    return stored_energy(point.p, point.c, y, point.w)


@pytest.mark.parametrize("waves", [None, 1e-7 * np.array([0.0, 1.0, 0.5])], ids=["round", "wavy"])
@pytest.mark.parametrize("kind", DEFECTS)
def test_stored_energy_grows_by_what_is_put_in_less_what_is_lost(scene, kind, waves):
    """Forces on balls and rings, moments and damping belong to one energy of the contact."""
    point, axes, ball = state(scene, kind, waves)
    y, f = point.y, point.accelerations(point.y)
    gains = [point.w[W.RACE + race * R.SIZE + R.GAIN + ball] for race in range(2)]
    assert min(gains) < 0.95
    rate = np.concatenate([y[Y.VX : Y.OM + STRIDE], f[: F.BODY], y[Y.V0 :], f[F.BODY : F.WORK]])

    def central(h):
        return (energy(point, axes, y + h * rate, h) - energy(point, axes, y - h * rate, -h)) / (2.0 * h)

    h = 1e-7
    wanted = f[F.WORK] - f[F.HEAT : F.HEAT + 3].sum()
    # rounding of an energy of some 10 J over the step
    assert (4.0 * central(0.5 * h) - central(h)) / 3.0 == pytest.approx(wanted, rel=1e-5, abs=1e-5)


@pytest.mark.parametrize("kind", DEFECTS)
def test_races_get_the_opposite_force_at_the_same_point(scene, kind):
    point, _, _ = state(scene, kind)
    point.accelerations(point.y)
    w, n = point.w, point.balls
    angle = point.y[Y.TH : Y.TH + n]
    for race, first in enumerate((0, Q.OUTER)):
        x, r, t = w[W.FORCE + race * W.FORCE_SIZE :][: 3 * STRIDE].reshape(3, STRIDE)[:, :n]
        on_ball = np.array([x, -np.sin(angle) * r - np.cos(angle) * t, np.cos(angle) * r - np.sin(angle) * t])
        on_ring = w[W.BODY + first * STRIDE :][: 3 * STRIDE].reshape(3, STRIDE)[:, :n]
        assert on_ring == pytest.approx(-on_ball, abs=1e-9 * abs(on_ball).max())


@pytest.mark.parametrize("kind", DEFECTS)
def test_slopes_over_defects(scene, kind):
    """Of a defect on a ball what its place changes with the ball's own orbit is left out."""
    point, _, _ = state(scene, kind)
    agree(point, 2e-5 if kind in ("inner", "outer", "two") else 0.06)


def test_a_defect_of_no_depth_leaves_all_as_it_is(scene):
    point = shaken(scene("7003C-spindle"))
    wanted, flat = point.accelerations(point.y), smooth(touch=0.0, lost=0.0)
    p, y = point.p, point.y
    one = on_race(p, 1, flat)
    one = one._replace(angle=y[Y.TH + pressed(point)] - y[Y.Q0 + Q.OUTER + Q.TURN] - ASIDE / one.radii[1])
    point.p = with_defects(p, one)
    point.c[C.DEFECT_SCALE] = 1.0
    assert point.accelerations(point.y) == pytest.approx(wanted, rel=1e-12)
    point.c[C.DEFECT_SCALE] = 0.0
    assert (point.accelerations(point.y) == wanted).all()


def test_a_ball_carries_its_defect_along():
    """As `Rotation` turns it: exactly in a stage, and over steps with the mean of the spins."""
    p = with_defects(
        np.zeros(P.TABLES), *[on_ball(np.zeros(P.TABLES), (None, None), ball) for ball in (3, 0)]
    )
    y, w, axes = np.zeros(Y.SIZE), np.zeros(W.ROWS), np.zeros(S.JAC - S.AXES)
    places = axes[S.DEFECT_AXES - S.AXES :].reshape(-1, DE.VECTOR)
    places[:2] = (0.6, 0.0, 0.8), (0.0, 1.0, 0.0)
    before, t = places.copy(), 7e-6
    y[Y.OM], y[Y.OM + 3] = 800.0, 900.0
    spins = 5e3 * np.random.default_rng(4).normal(size=(3, 2))
    for row, spin in zip((Y.WX, Y.WR, Y.WT), spins, strict=True):
        y[row + 3], y[row] = spin
    turn_axes(p, axes, y, 4, t, w)
    advance_axes(p, axes, y, y, 4, t)
    for k, ball in enumerate((3, 0)):
        wanted = Rotation.from_rotvec(t * (spins[:, k] - [y[Y.OM + ball], 0.0, 0.0])).apply(before[k])
        np.testing.assert_allclose(w[W.DEFECT_AXES + DE.VECTOR * k :][: DE.VECTOR], wanted, atol=2e-15)
        np.testing.assert_allclose(places[k], wanted, atol=2e-15)
