"""The quasi-static kernel in five degrees of freedom: independent solution, stiffness, extremes, symmetry."""

import numpy as np
import pytest

from fmu_bearing.compiled import call
from fmu_bearing.engine.choices import RACE_CONTROLS
from fmu_bearing.engine.layout import EQ, ST, STRIDE, C, F, P, Q, Y
from fmu_bearing.engine.statics.axial import quasistatic
from fmu_bearing.engine.statics.stiffness import series_stiffness
from fmu_bearing.engine.status import OK
from tests.engine.helpers import RPM, TILT_STIFFNESS, quiet
from tests.engine.quasistatic import Bearing
from tests.oracles import B7003C, B7009C
from tests.oracles.jones_harris import JonesHarris

CONTROL = {"shared": "mean", "outer": "outer", "inner": "inner"}


_COMBINED = ("7003C-bare", B7003C, 20e3, (500, 80, -300, 0.5, -1.0))
_LARGE = ("7009C-full-ceramic", B7009C, 12e3, (350, 150, -200, 3.0, 0))


@pytest.mark.parametrize(
    ("name", "geometry", "rpm", "load", "control"),
    [
        ("7003C-bare", B7003C, 0.0, (500, 0, -300, 0, 0), "shared"),
        ("7003C-bare", B7003C, -40e3, (500, 0, 0, 2.0, 0), "shared"),
        (*_COMBINED, "shared"),
        (*_COMBINED, "outer"),
        (*_COMBINED, "inner"),
        # some balls unloaded; the independent solver takes seconds there and for the large bearing
        pytest.param("7003C-bare", B7003C, 20e3, (200, 0, -1000, 0, 0), "shared", marks=pytest.mark.heavy),
        pytest.param(*_LARGE, "shared", marks=pytest.mark.heavy),
        pytest.param(*_LARGE, "outer", marks=pytest.mark.heavy),
        pytest.param(*_LARGE, "inner", marks=pytest.mark.heavy),
    ],
)
def test_against_the_independent_solution(scene, name, geometry, rpm, load, control):
    bearing = Bearing(scene(name), RACE_CONTROL=RACE_CONTROLS.index(control)).solve(rpm, load)
    theory = JonesHarris(geometry, CONTROL[control], control=control).solve(
        load[:3], rpm * RPM, moment=load[3:]
    )
    # same physics from other equations; both stop at about 1e-6 N, loads are 1e2 N
    scale = np.abs(theory.displacement[:3]).max()
    np.testing.assert_allclose(bearing.shift[:3], theory.displacement[:3], rtol=0, atol=1e-6 * scale)
    # the engine's tilts are components of the ring's axis, the oracle's those of a rotation vector
    turned = np.array(theory.displacement[3:])
    size = np.linalg.norm(turned)
    turned *= np.sinc(size / np.pi)
    np.testing.assert_allclose(bearing.shift[3:], turned, rtol=0, atol=1e-6 * max(size, 1e-6))
    for row, field in (
        (EQ.LOAD_I, "inner_load"),
        (EQ.LOAD_O, "outer_load"),
        (EQ.OM, "orbit_speed"),
    ):
        expected = np.array([getattr(b, field) for b in theory.balls])
        np.testing.assert_allclose(
            bearing.row(row), expected, rtol=1e-6, atol=1e-6 * np.abs(expected).max() + 1e-12
        )
    held = bearing.row(EQ.LOAD_I) > 1.0
    for row, field in ((EQ.ANGLE_I, "inner_angle"), (EQ.ANGLE_O, "outer_angle")):
        expected = np.array([getattr(b, field) for b in theory.balls])
        np.testing.assert_allclose(bearing.row(row)[held], expected[held], rtol=1e-6, atol=1e-7)
    spin = np.array([b.spin_speed * np.sin(b.pitch) for b in theory.balls])
    np.testing.assert_allclose(bearing.row(EQ.WR), spin, rtol=1e-6, atol=1e-6 * np.abs(spin).max() + 1e-9)


@pytest.mark.parametrize("name", ["7003C-bare", "7009C-full-ceramic"])
@pytest.mark.parametrize("load", [(500, 0, 0, 0, 0), (500, 100, -300, 1.0, -0.5), (100, 0, -800, 0, 0)])
def test_stiffness_is_the_derivative_of_the_load(scene, name, load):
    """The flexibility by central differences of the equilibrium at standstill is the matrix's inverse."""
    bearing = Bearing(scene(name))
    matrix = bearing.solve(0.0, load, (1e-4, -2e-4)).stiffness
    # 0.01 % of the loads: second-order error 1e-8, the solution's tolerance 1e-9 over 1e-4
    steps = np.array([0.05, 0.05, 0.05, 5e-4, 5e-4])
    flexibility = np.zeros((5, 5))
    for k in range(5):
        move = np.zeros(5)
        move[k] = steps[k]
        plus = bearing.solve(0.0, load + move, (1e-4, -2e-4)).shift
        minus = bearing.solve(0.0, load - move, (1e-4, -2e-4)).shift
        flexibility[:, k] = (plus - minus) / (2 * steps[k])
    lever = np.array([1, 1, 1, bearing.p[P.PITCH_RADIUS], bearing.p[P.PITCH_RADIUS]])
    product = flexibility @ matrix * lever[:, None] / lever[None, :]
    np.testing.assert_allclose(product, np.eye(5), atol=2e-4)


@pytest.mark.parametrize("control", [0, 1, 2])
@pytest.mark.parametrize("name", ["7003C-bare", "7003C-spindle", "7009C-full-ceramic"])
def test_extremes(scene, name, control):
    """Free, lost and crushed contacts: a solution with a small residual, in both senses of rotation."""
    bearing = Bearing(scene(name), RACE_CONTROL=control)
    for rpm in (0.0, 1.0, 100.0, 20e3, -40e3, 100e3):
        for axial in (0.0, 1.0, 500.0, 1e4):
            for radial, moment, tilt in ((0, 0, 0), (0, 0, 3e-3), (300, 2, 0), (3000, 0, 0), (3000, 0, 3e-3)):
                load = (axial, 0.3 * radial, -radial, moment, 0.0)
                bearing.solve(rpm, load, (tilt, -0.5 * tilt))
                assert np.isfinite(bearing.out).all()
                # a slow ball that nothing presses lacks 0.01 N at most
                assert bearing.out[EQ.RESIDUAL] <= 0.01 + 1e-6 * sum(np.abs(load))
                # a lost ball stays in the outer race and never passes through a groove
                assert np.abs(bearing.row(EQ.R)).max() < 2e-4
                assert (bearing.row(EQ.LOAD_O) >= 0).all()


def test_free_play_at_small_radial_loads(scene):
    """Without preload a ring drops through its play until a ball or two hold it."""
    for name in ("7003C-bare", "7009C-full-ceramic"):
        bearing = Bearing(scene(name))
        for rpm in (0.0, 100.0, 2e4):
            # large balls thrown out: without slopes of friction 3e-4 N of 0.3 N stay out of balance
            light = 3.0 if rpm == 2e4 and name.startswith("7009C") else 0.3
            for weight in (light, 3.0):
                bearing.solve(rpm, (0, 0, -weight, 0, 0))
                held = bearing.row(EQ.LOAD_I) @ np.cos(bearing.row(EQ.ANGLE_I)).clip(0.5)
                assert held == pytest.approx(weight, rel=0.3)


def test_turning_backwards_is_the_mirror_image(scene):
    """Mirroring y turns the sense of rotation: loads y and moments z stay with the mirror's signs."""
    bearing = Bearing(scene("7009C-full-ceramic"))
    mirror = np.array([1, -1, 1, 1, -1])
    load = np.array([350, 80, -200, 3.0, -2.0])
    ahead = bearing.solve(12e3, load).shift
    loads = bearing.row(EQ.LOAD_I)
    orbits = bearing.row(EQ.OM)
    back = bearing.solve(-12e3, load * mirror).shift
    np.testing.assert_allclose(back * mirror, ahead, rtol=1e-7, atol=1e-14)
    opposite = -np.arange(bearing.balls) % bearing.balls
    np.testing.assert_allclose(bearing.row(EQ.LOAD_I)[opposite], loads, rtol=1e-6)
    np.testing.assert_allclose(bearing.row(EQ.OM)[opposite], -orbits, rtol=1e-9)


def test_race_control_moves_the_gyroscopic_friction(scene):
    """Under control of one race the other one has no friction along its major axis."""
    load, rpm = (350, 0, 0, 0, 0), 18e3
    found = {}
    for control in (0, 1, 2):
        bearing = Bearing(scene("7009C-full-ceramic"), RACE_CONTROL=control).solve(rpm, load)
        x, r = bearing.row(EQ.X)[0], bearing.row(EQ.R)[0]
        qi, qo = bearing.row(EQ.LOAD_I)[0], bearing.row(EQ.LOAD_O)[0]
        ai, ao = bearing.row(EQ.ANGLE_I)[0], bearing.row(EQ.ANGLE_O)[0]
        # friction along each race's major axis is what the axial load lacks
        found[control] = (
            load[0] / bearing.balls - qi * np.sin(ai),
            qo * np.sin(ao) - load[0] / bearing.balls,
        )
        assert np.isfinite([x, r]).all()
    inner, outer = np.transpose([found[k] for k in (0, 1, 2)])
    # positive friction on the ball inside pushes it along +x, on the outer race's ball along -x
    assert inner[1] == pytest.approx(0.0, abs=1e-6) and outer[1] < -0.5
    assert outer[2] == pytest.approx(0.0, abs=1e-6) and inner[2] > 0.5
    assert inner[0] > 0.2 and outer[0] < -0.2


def test_without_gyroscopic_term_no_friction(scene):
    bearing = Bearing(scene("7009C-full-ceramic"), GYROSCOPIC=0.0).solve(18e3, (350, 0, 0, 0, 0))
    axial = bearing.row(EQ.LOAD_I) * np.sin(bearing.row(EQ.ANGLE_I))
    np.testing.assert_allclose(axial, 350 / bearing.balls, rtol=1e-7)


def test_tilt_support_and_offset(scene):
    """A stiff support holds the inner ring upright while the outer one is tilted."""
    bearing = Bearing(scene("7003C-bare"))
    bearing.p[TILT_STIFFNESS] = 1e9
    bearing.solve(0.0, (500, 0, 0, 0, 0), (5e-4, 0))
    assert bearing.shift[3] == pytest.approx(-5e-4, rel=1e-4)
    free = Bearing(scene("7003C-bare")).solve(0.0, (500, 0, 0, 0, 0), (5e-4, 0))
    # a free ring follows the other but for the small moment of an axial load on a tilted bearing
    assert abs(free.shift[3]) < 0.05 * 5e-4


def test_pedestal_tilt_balances_the_moments(scene):
    """A pedestal's springs against the tilt support of the inner ring."""
    bearing = Bearing(scene("7003C-spindle"), MISALIGNMENT_Y=1e-3)
    load = np.array([500.0, 0.0, -300.0, 0.0, 0.0])
    tilt = bearing.rest(0.0, load).tilt
    # the support takes the moment that the pedestal's springs give, but for loads on displaced centres
    support = bearing.p[TILT_STIFFNESS][0] * (bearing.shift[3] + tilt[0])
    spring = bearing.c[C.PEDESTAL_ROTATIONAL] * (tilt[0] - 1e-3)
    displaced = bearing.shift[2] * load[0] - bearing.shift[0] * load[2]
    assert support + spring == pytest.approx(displaced, rel=1e-4, abs=1e-5 * abs(spring))


def closed_form(p, c, out):
    """Axial, radial (N/m) and tilt stiffness (N m/rad) of equal balls, and radial-tilt coupling (N).

    From the contacts of one ball in series at the equilibrium ``out`` of `quasistatic`.
    """
    inner = C.RACES
    radius = p[P.PITCH_RADIUS] + out[ST.AXIAL_R]
    shifts = out[ST.AXIAL_SHIFT], 0.0

    def contact(race):
        held = C.RACES + race * C.RACE_SIZE
        x = out[ST.AXIAL_X] - shifts[race] - c[held + C.GROOVE_X]
        r = radius - c[held + C.GROOVE_RADIUS]
        distance = np.hypot(x, r)
        hertz = p[P.RACES + race * P.RACE_SIZE + P.RACE_STIFFNESS]
        return hertz, distance - c[held + C.FREE], distance, x / distance, r / distance

    kxx, kxr, krr = series_stiffness(contact(0), contact(1))
    # a tilt b about the tangent moves the groove centre by (-b R_c, b x_c)
    gx, gr = -c[inner + C.GROOVE_RADIUS], c[inner + C.GROOVE_X]
    half = 0.5 * p[P.BALLS]
    tilt = half * (kxx * gx * gx + 2.0 * kxr * gx * gr + krr * gr * gr)
    return p[P.BALLS] * kxx, half * krr, tilt, half * (kxr * gx + krr * gr)


@pytest.mark.parametrize(
    ("name", "rpm"), [("7003C-bare", 0.0), ("7003C-bare", 2e4), ("7009C-full-ceramic", 1.2e4)]
)
def test_the_axial_solution_is_the_same(scene, name, rpm):
    """One unknown against five; the closed form leaves out how a tilt turns the loads."""
    bearing = Bearing(scene(name)).solve(rpm, (400, 0, 0, 0, 0))
    bearing.c[C.PRELOAD] = 400.0
    found = np.zeros(8)
    assert quasistatic(bearing.p, bearing.c, rpm * RPM, found) == OK
    rows = [bearing.row(k)[0] for k in (EQ.X, EQ.R, EQ.OM, EQ.WX, EQ.WR)]
    np.testing.assert_allclose(found[:6], [bearing.shift[0], *rows], rtol=1e-7, atol=1e-14)
    axial, radial, tilt, coupling = closed_form(bearing.p, bearing.c, found)
    k = bearing.stiffness
    assert axial == pytest.approx(k[0, 0], rel=1e-6)
    assert radial == pytest.approx(k[2, 2], rel=1e-3)
    assert tilt == pytest.approx(k[3, 3], rel=5e-3)
    # A tilt about +Y moves the inner groove along the preload (+X) at the top (+Z) and against it at the
    # bottom: balls press harder on the top, less on the bottom, and a force along +Z must hold the ring. The
    # closed form counts the tilt about the tangent of the top ball, which is -Y. What it leaves out, the load
    # turned with the ring, is 200 N of 7e5.
    assert k[2, 3] > 0.0
    assert coupling == pytest.approx(-k[2, 3], rel=1e-3)
    assert k[1, 4] == pytest.approx(-k[2, 3], rel=1e-9)  # about Z it is a quarter turn on: Z goes to -Y


def test_static_gates_of_the_matrix(scene):
    """The design study's numbers for the 7003C under 500 N, within 0.5 %, from the 5 x 5 matrix."""
    bearing = Bearing(scene("7003C-bare")).solve(0.0, (500, 0, 0, 0, 0))
    k = bearing.stiffness
    np.testing.assert_allclose(k, k.T, atol=1e-6 * k[1, 1])
    assert k[0, 0] == pytest.approx(5.57e7, rel=5e-3)
    assert k[1, 1] == pytest.approx(1.63e8, rel=5e-3) and k[1, 1] == pytest.approx(k[2, 2], rel=1e-9)
    assert k[3, 3] == pytest.approx(4.73e3, rel=5e-3)


@pytest.mark.heavy
@pytest.mark.parametrize("name", ["7003C-bare", "7003C-spindle"])
@pytest.mark.parametrize("tilt", [0.0, 3e-3])
def test_the_full_level_stands_still_there(scene, name, tilt):
    """Same geometry: at standstill the right-hand side leaves inner ring and balls (x, r) where they are."""
    off = dict.fromkeys(("GRAVITY", "DRAG", "ROLLING", "CAGE", "WAVINESS"), 0.0)
    bearing = Bearing(quiet(scene(name)), **off).solve(0.0, (500, 100, -300, 0, 0), (tilt, -0.5 * tilt))
    bearing.c[[C.PRELOAD, C.LOAD_Y, C.LOAD_Z]] = 500, 100, -300
    y, f = np.zeros(Y.SIZE), np.zeros(F.SIZE)
    for row, found in ((Y.X // STRIDE, EQ.X), (Y.R // STRIDE, EQ.R)):
        y[row * STRIDE :][: bearing.balls] = bearing.row(found)
    y[Y.TH :][: bearing.balls] = 2 * np.pi * np.arange(bearing.balls) / bearing.balls
    outer = Y.Q0 + Q.OUTER
    y[outer + 4 : outer + 6] = bearing.tilt
    y[Y.Q0 : Y.Q0 + 5] = bearing.shift
    y[Y.Q0 + 3 : Y.Q0 + 5] += y[outer + 4 : outer + 6]
    call("right_hand_side", bearing.p, bearing.c, y, bearing.w, f, 0.0, 0.0, 0.0)
    p = bearing.p
    force = f[F.BODY : F.BODY + 3] * p[P.INNER_MASS]
    moment = f[F.BODY + 3 : F.BODY + 5] * p[P.INNER_TRANSVERSE] / p[P.PITCH_RADIUS]
    np.testing.assert_allclose([*force, *moment], 0.0, atol=1e-5)
    balls = f[: 2 * STRIDE].reshape(2, -1)[:, : bearing.balls] * p[P.BALL_MASS]
    np.testing.assert_allclose(balls, 0.0, atol=1e-6)
