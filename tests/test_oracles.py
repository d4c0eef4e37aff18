"""The oracles themselves: against printed numbers, against closed forms, and against first principles."""

from dataclasses import replace
from math import cos, degrees, pi, radians, sin

import numpy as np
import pytest
from scipy.sparse import lil_matrix
from scipy.sparse.linalg import spsolve
from scipy.spatial.transform import Rotation

from tests.oracles import B7003C, B7009C, hertz, journal, kinematics
from tests.oracles.jones_harris import Equilibrium, JonesHarris

# ---- Hertz -------------------------------------------------------------------------------------------------


@pytest.mark.parametrize(
    ("bearing", "inner", "outer"), [(B7003C, 2.541e10, 2.407e10), (B7009C, 3.575e10, 3.361e10)]
)
def test_contact_constants_have_the_printed_digits(bearing, inner, outer):
    # four digits are printed: half a unit of the last, and a hair for the rounding of the printer
    assert hertz.race_contact(bearing, "inner").constant == pytest.approx(inner, abs=0.00051e10)
    assert hertz.race_contact(bearing, "outer").constant == pytest.approx(outer, abs=0.00051e10)


@pytest.mark.parametrize("race", ["inner", "outer"])
def test_pressure_ellipse_presses_the_gap_shut(race):
    contact = hertz.race_contact(B7003C, race, load=115.0)
    for share_x, share_y in ((0.0, 0.0), (0.7, 0.0), (0.0, 0.6), (0.5, -0.5), (-0.3, 0.9)):
        x, y = share_x * contact.semi_major, share_y * contact.semi_minor
        gap = contact.long_curvature * x**2 + contact.short_curvature * y**2
        # quadrature is asked for 1e-10
        assert hertz.surface_displacement(contact, x, y) == pytest.approx(contact.approach - gap, rel=1e-8)


def test_nearly_round_contact_is_the_sphere():
    radius, modulus, load = 2e-3, 1e11, 50.0
    contact = hertz.point_contact(load, (1.0 + 1e-6) / radius, (1.0 - 1e-6) / radius, modulus)
    # the sphere's closed form; the curvatures' difference enters squared, the axes' difference to first order
    approach = (9.0 * load**2 / (16.0 * radius * modulus**2)) ** (1 / 3)
    assert contact.approach == pytest.approx(approach, rel=1e-9)
    assert contact.semi_major == pytest.approx((0.75 * load * radius / modulus) ** (1 / 3), rel=2e-6)


# ---- kinematics --------------------------------------------------------------------------------------------

# multi-source paper, Table 2: f_r, f_b, f_c, f_i, f_o in Hz
TABLE_2 = {
    20000: (333.33, 936.04, 138.80, 2334.34, 1665.62),
    25000: (416.67, 1170.07, 173.51, 2917.97, 2082.07),
    28000: (466.67, 1310.48, 194.33, 3268.13, 2331.91),
    30000: (500.0, 1404.07, 208.21, 3501.54, 2498.46),
}


@pytest.mark.parametrize("rpm", TABLE_2)
def test_defect_frequencies_are_table_2(rpm):
    # the table carries on with f_r rounded to 0.01 Hz, and rounds again
    found = kinematics.defect_frequencies(round(rpm / 60.0, 2), 4.5e-3, 26e-3, 12, radians(15.0))
    printed = TABLE_2[rpm]
    values = (found.rotation, found.ball, found.cage, found.inner, found.outer)
    assert values == pytest.approx(printed, abs=0.0051, rel=0.0)
    exact = kinematics.defect_frequencies(rpm / 60.0, 4.5e-3, 26e-3, 12, radians(15.0))
    assert (exact.ball, exact.cage, exact.inner, exact.outer) == pytest.approx(printed[1:], rel=1e-4)


ROLL = {"ball_diameter": 4.5e-3, "centre_radius": 13.01e-3}
ROLL |= {"inner_angle": radians(22.0), "outer_angle": radians(19.0)}


def _ball_vectors(rule, speed):
    """Orbit (about e_x) and absolute ball velocity in the (x, r, t) frame."""
    beta = kinematics.pitch_angle(rule, **ROLL)
    orbit, spin = kinematics.rolling(speed, **ROLL, pitch=beta)
    return np.array([orbit, 0, 0]), np.array([orbit - spin * cos(beta), spin * sin(beta), 0.0])


@pytest.mark.parametrize("speed", [1000.0, -300.0])
@pytest.mark.parametrize("rule", ["mean", "outer", "inner"])
def test_pure_rolling_leaves_no_slip(rule, speed):
    orbit, ball = _ball_vectors(rule, speed)
    centre = np.array([0.0, ROLL["centre_radius"], 0.0])
    radius, a_i, a_o = 0.5 * ROLL["ball_diameter"], ROLL["inner_angle"], ROLL["outer_angle"]
    to_outer = radius * np.array([sin(a_o), cos(a_o), 0.0])
    to_inner = -radius * np.array([sin(a_i), cos(a_i), 0.0])
    ring = np.array([speed, 0.0, 0.0])
    on_ball = [np.cross(orbit, centre) + np.cross(ball, arm) for arm in (to_outer, to_inner)]
    on_race = [np.zeros(3), np.cross(ring, centre + to_inner)]
    assert np.allclose(on_ball, on_race, atol=1e-12 * abs(speed))
    # race control: nothing spins about that contact's normal
    if rule == "outer":
        assert ball @ to_outer == pytest.approx(0.0, abs=1e-15 * abs(speed))
    if rule == "inner":
        assert (ball - ring) @ to_inner == pytest.approx(0.0, abs=1e-15 * abs(speed))
    # against a turning inner ring the ball spins backwards
    assert np.sign(ball[0]) == -np.sign(speed)


def test_orbit_speed_has_harris_closed_forms():
    # Harris, Rolling Bearing Analysis: orbit over shaft speed under outer and inner race control
    a_i, a_o = ROLL["inner_angle"], ROLL["outer_angle"]
    ratio = 0.5 * ROLL["ball_diameter"] / ROLL["centre_radius"]
    outer = (1.0 - ratio * cos(a_i)) / (1.0 + cos(a_i - a_o))
    inner = (cos(a_i - a_o) - ratio * cos(a_o)) / (1.0 + cos(a_i - a_o))
    assert _ball_vectors("outer", 1.0)[0][0] == pytest.approx(outer, rel=1e-13)
    assert _ball_vectors("inner", 1.0)[0][0] == pytest.approx(inner, rel=1e-13)


def test_cage_ratio_with_equal_angles_is_equation_47():
    angle = radians(15.0)
    orbit, _ = kinematics.rolling(2.0, 4.5e-3, 13e-3, angle, angle, angle)
    assert kinematics.cage_ratio(4.5e-3, 26e-3, angle, angle) == pytest.approx(0.5 * orbit, rel=1e-14)
    found = kinematics.defect_frequencies(2.0, 4.5e-3, 26e-3, 12, angle)
    assert found.cage == pytest.approx(orbit, rel=1e-14)


def test_unknown_pitch_rule_is_named():
    with pytest.raises(ValueError, match="'half'"):
        kinematics.pitch_angle("half", **ROLL)


# ---- Jones-Harris ------------------------------------------------------------------------------------------

PRELOAD = {B7003C: 500.0, B7009C: 350.0}


@pytest.fixture(scope="module", params=[B7003C, B7009C], ids=["7003C", "7009C"])
def standstill(request):
    model = JonesHarris(request.param)
    return model, model.solve((PRELOAD[request.param], 0.0, 0.0))


def test_static_preload_gates(standstill):
    model, state = standstill
    load, angle, axial = (115.62, 21.12, 18.01) if model.bearing is B7003C else (70.11, 17.08, 11.58)
    # printed to 0.01: half a unit of the last digit
    for ball in state.balls:
        assert ball.inner_load == pytest.approx(load, abs=0.0051)
        assert ball.outer_load == pytest.approx(load, abs=0.0051)
        assert degrees(ball.inner_angle) == pytest.approx(angle, abs=0.0051)
        assert degrees(ball.outer_angle) == pytest.approx(angle, abs=0.0051)
    assert state.displacement[0] * 1e6 == pytest.approx(axial, abs=0.0051)
    assert np.allclose(state.displacement[1:], 0.0, atol=1e-12)


def test_static_system_equals_the_one_unknown_solution(standstill):
    model, state = standstill
    load, angle, axial = model.static_axial(PRELOAD[model.bearing])
    # 1e-6 N may be left over in a residual
    assert state.balls[3].inner_load == pytest.approx(load, rel=1e-7)
    assert state.balls[3].inner_angle == pytest.approx(angle, rel=1e-7)
    assert state.displacement[0] == pytest.approx(axial, rel=1e-7)


def test_static_stiffness_gates():
    model = JonesHarris(B7003C)
    state = model.solve((500.0, 0.0, 0.0))
    axial, radial_y, radial_z, tilt_y, tilt_z = np.diag(model.stiffness(state))
    # three digits are printed and the design asks for 0.5 %; see the closed form below for what the model
    # itself gives
    assert axial == pytest.approx(5.57e7, rel=5e-3)
    assert (radial_y, radial_z) == pytest.approx((1.63e8, 1.63e8), rel=5e-3)
    assert (tilt_y, tilt_z) == pytest.approx((4.73e3, 4.73e3), rel=5e-3)


def test_static_stiffness_has_the_closed_form(standstill):
    model, state = standstill
    bearing, count = model.bearing, model.bearing.ball_count
    load, angle, _ = model.static_axial(PRELOAD[bearing])
    approach = sum((load / k) ** (2 / 3) for k in (model.inner_constant, model.outer_constant))
    # one ball between two grooves is a string: stiff along the line of contact, Q / length across it
    along, across = 1.5 * load / approach, load / (bearing.inner_reach + bearing.outer_reach + approach)
    axial = count * (along * sin(angle) ** 2 + across * cos(angle) ** 2)
    # shifted sideways, the groove circle turns away from the balls' planes: minus Q cos a over its radius
    turned = load * cos(angle) / bearing.inner_groove_centre[1]
    radial = 0.5 * count * (along * cos(angle) ** 2 + across * sin(angle) ** 2 - turned)
    found = model.stiffness(state)
    # differences over 20 nm of about 2 um, residuals of 1e-6 N
    assert found[0, 0] == pytest.approx(axial, rel=1e-5)
    assert found[1, 1] == pytest.approx(radial, rel=1e-5)
    assert found[2, 2] == pytest.approx(radial, rel=1e-5)
    # a conservative system; the scale is the geometric mean of the diagonal
    scale = np.sqrt(np.outer(np.diag(found), np.diag(found)))
    assert np.max(np.abs(found - found.T) / scale) < 1e-5


def _stored_energy(model: JonesHarris, state: Equilibrium) -> float:
    # integral of K delta^1.5: 2/5 Q delta
    return sum(
        0.4 * ball.inner_load * (ball.inner_load / model.inner_constant) ** (2 / 3)
        + 0.4 * ball.outer_load * (ball.outer_load / model.outer_constant) ** (2 / 3)
        for ball in state.balls
    )


def test_ring_force_at_rest_is_the_gradient_of_the_stored_energy():
    model = JonesHarris(B7003C)
    place = np.array([18e-6, 1.5e-6, -2e-6, 1e-4, -2e-4])
    state = model.at_displacement(place)
    steps = np.array([1e-8, 1e-8, 1e-8, 1e-6, 1e-6])
    for k, step in enumerate(steps):
        move = np.zeros(5)
        move[k] = step
        plus = _stored_energy(model, model.at_displacement(place + move, start=state))
        minus = _stored_energy(model, model.at_displacement(place - move, start=state))
        # tilts as rotation vector: at 2e-4 rad the moment differs from the gradient by their product
        assert -(plus - minus) / (2.0 * step) == pytest.approx(state.force[k], rel=1e-4 if k > 2 else 1e-5)


# Q_i, Q_o in N; a_i, a_o in deg; dx in um: this oracle's own results, kept against accidents
SPEED_TABLE = [
    (B7003C, 10e3, 115.3455, 115.7024, 21.1601, 21.0917, 18.0038),
    (B7003C, 20e3, 114.5344, 115.9615, 21.2691, 20.9947, 17.9787),
    (B7003C, 28e3, 113.5062, 116.3023, 21.4091, 20.8696, 17.9451),
    (B7003C, 40e3, 111.3587, 117.0606, 21.7083, 20.5995, 17.8684),
    (B7009C, 3e3, 69.6605, 70.2452, 17.1569, 17.0097, 11.5627),
    (B7009C, 12e3, 63.2853, 72.6172, 18.3873, 15.9494, 11.1247),
    (B7009C, 18e3, 56.1232, 77.0721, 19.9932, 14.3838, 9.9590),
]


@pytest.mark.parametrize(
    "row",
    [
        pytest.param(
            row, id=f"{row[0].ball_count}-balls-{row[1]:.0f}", marks=[pytest.mark.heavy] * (k % 3 > 0)
        )
        for k, row in enumerate(SPEED_TABLE)
    ],
)
def test_axial_load_at_speed(row):
    bearing, rpm, inner_load, outer_load, inner_angle, outer_angle, axial = row
    state = JonesHarris(bearing).solve((PRELOAD[bearing], 0.0, 0.0), kinematics.rad_s(rpm))
    ball = state.balls[0]
    # the digits written above
    assert (ball.inner_load, ball.outer_load) == pytest.approx((inner_load, outer_load), abs=6e-5)
    angles = degrees(ball.inner_angle), degrees(ball.outer_angle)
    assert angles == pytest.approx((inner_angle, outer_angle), abs=6e-5)
    assert state.displacement[0] * 1e6 == pytest.approx(axial, abs=6e-5)
    sizes = bearing.ball_diameter, bearing.pitch_diameter
    simple = kinematics.cage_ratio(*sizes, ball.inner_angle, ball.outer_angle)
    # the one-angle formula: 0.15 % is what the design asks of the dynamic model
    assert ball.orbit_speed / kinematics.rad_s(rpm) == pytest.approx(simple, rel=1.5e-3)


def test_ball_obeys_newton_and_euler_in_the_fixed_frame():
    """Rotate the solved ball through a small angle and difference its momenta: all signs at once."""
    bearing, speed = B7009C, kinematics.rad_s(18e3)
    ball = JonesHarris(bearing).solve((350.0, 0.0, 0.0), speed).balls[5]
    e_x, e_r = np.array([1.0, 0, 0]), np.array([0, -sin(ball.angle), cos(ball.angle)])
    normal_i = sin(ball.inner_angle) * e_x + cos(ball.inner_angle) * e_r
    normal_o = sin(ball.outer_angle) * e_x + cos(ball.outer_angle) * e_r
    pair = ball.gyroscopic_moment / bearing.ball_diameter
    # friction along each race in the plane of the axis, opposite at the two contacts
    e_t = np.cross(e_x, e_r)
    force_i = ball.inner_load * normal_i - pair * np.cross(e_t, normal_i)
    force_o = -ball.outer_load * normal_o + pair * np.cross(e_t, normal_o)
    radius = 0.5 * bearing.ball_diameter
    moment = np.cross(-radius * normal_i, force_i) + np.cross(radius * normal_o, force_o)

    spin = ball.orbit_speed * e_x + ball.spin_speed * (-cos(ball.pitch) * e_x + sin(ball.pitch) * e_r)
    centre = ball.axial * e_x + ball.radial * e_r

    def turned(vector, time):
        return Rotation.from_rotvec(ball.orbit_speed * time * e_x).apply(vector)

    tiny = 1e-4 / ball.orbit_speed
    acceleration = (turned(centre, tiny) - 2.0 * centre + turned(centre, -tiny)) / tiny**2
    euler = bearing.ball_inertia * (turned(spin, tiny) - turned(spin, -tiny)) / (2.0 * tiny)
    # differences over 1e-4 rad: error 1e-9 of truncation, 1e-8 of rounding
    assert np.allclose(force_i + force_o, bearing.ball_mass * acceleration, atol=1e-6 * ball.outer_load)
    assert np.allclose(moment, euler, atol=1e-7 * np.linalg.norm(euler))
    # the ring carries its load: what the ball gives it is the reaction
    assert 17.0 * np.array(ball.ring_force) @ e_x == pytest.approx(-350.0, abs=1e-5)
    assert np.allclose(ball.ring_force, -force_i, atol=1e-6)


def test_mirror_reversed_speed_changes_nothing():
    model = JonesHarris(B7003C)
    forward, back = (model.solve((500.0, 0.0, 300.0), kinematics.rad_s(n)) for n in (20e3, -20e3))
    assert np.allclose(forward.displacement, back.displacement, atol=1e-12)
    assert forward.balls[2].orbit_speed == pytest.approx(-back.balls[2].orbit_speed, rel=1e-10)


def test_combined_load_is_balanced_and_turns_with_the_load():
    model, speed = JonesHarris(B7003C), kinematics.rad_s(20e3)
    load, moment = np.array([500.0, 100.0, -300.0]), (0.4, -0.2)
    free = model.solve(tuple(load), speed, moment=moment)
    # six residuals of 1e-6 N at most, arms of 13 mm
    assert np.allclose(free.force, [*-load, *np.negative(moment)], atol=1e-5)
    # held at the tilt it found, the ring is where it was, and each ball alone too
    held = model.solve(tuple(load), speed, tilt=free.displacement[3:])
    assert np.allclose(held.displacement[:3], free.displacement[:3], atol=1e-12)
    alone = model.at_displacement(np.array(free.displacement), speed)
    assert np.allclose(alone.force, free.force, atol=1e-5)
    # a load turned by 90 degrees moves each ball's state on by a quarter of the balls (12)
    up = model.solve((500.0, 0.0, 200.0), speed)
    aside = model.solve((500.0, -200.0, 0.0), speed)
    moved = [aside.balls[(j + 3) % 12].inner_load for j in range(12)]
    assert [ball.inner_load for ball in up.balls] == pytest.approx(moved)
    assert up.displacement[2] == pytest.approx(-aside.displacement[1])
    # Z load upwards: the ball at 12 o'clock carries the most
    assert max(up.balls, key=lambda b: b.inner_load) is up.balls[0]


def test_strong_radial_load_unloads_balls():
    state = JonesHarris(B7003C).solve((500.0, 0.0, 3000.0))
    unloaded = [ball for ball in state.balls if ball.inner_load < 1e-5]
    assert len(unloaded) == 7
    assert np.allclose(state.force, [-500.0, 0.0, -3000.0, *state.force[3:]], atol=1e-5)


def test_axial_load_must_seat_the_balls():
    with pytest.raises(ValueError, match="positive"):
        JonesHarris(B7003C).solve((0.0, 0.0, 10.0))


# ---- journal -----------------------------------------------------------------------------------------------

FILM = journal.Film(viscosity=6e-3, radius=11.66e-3, length=2.25e-3, clearance=40e-6)


def _motion(eps, rate, wedge, sleeve=850.0, angle=0.7, journal_speed=2094.0):
    """Eccentricity ratio, its rate in 1/s, and the whirl speed that leaves the wedge speed asked for."""
    return journal.Motion(
        eccentricity=eps * FILM.clearance,
        eccentricity_rate=rate * FILM.clearance,
        angle=angle,
        angle_rate=0.5 * (journal_speed + sleeve - wedge),
        journal_speed=journal_speed,
        sleeve_speed=sleeve,
    )


@pytest.mark.parametrize("wedge", [2944.0, 200.0, -1500.0])
@pytest.mark.parametrize("eps", [1e-3, 0.3, 0.7, 0.95])
def test_journal_wedge_alone_is_the_half_sommerfeld_solution(eps, wedge):
    found = journal.force_by_quadrature(FILM, _motion(eps, 0.0, wedge))
    assert found == pytest.approx(journal.wedge_alone(FILM, eps, wedge), rel=1e-8)


@pytest.mark.parametrize("rate", [-400.0, 150.0])
@pytest.mark.parametrize("eps", [0.0, 1e-3, 0.4, 0.9])
def test_journal_squeeze_alone_has_one_half_of_the_film(eps, rate):
    motion = _motion(eps, rate, 0.0)
    assert motion.wedge_speed == 0.0
    along, across = journal.force_by_quadrature(FILM, motion)
    assert along == pytest.approx(journal.squeeze_alone(FILM, eps, rate), rel=1e-8)
    assert abs(across) < 1e-9 * abs(along)
    # closing the gap is resisted, and so is opening it: by the film on the far side
    assert np.sign(along) == -np.sign(rate)


def test_journal_film_carries_no_suction():
    """Opening at 20 mm/s and e = 0.9 c without wedge: a film that pulled would hold with 65 N and more."""
    opening = _motion(0.9, -0.02 / FILM.clearance, 0.0)
    along, _ = journal.force_by_quadrature(FILM, opening)
    closing, _ = journal.force_by_quadrature(FILM, _motion(0.9, 0.02 / FILM.clearance, 0.0))
    pulled = journal.squeeze_alone(FILM, 0.9, -0.02 / FILM.clearance) + closing
    assert abs(pulled) > 60.0
    assert 0.0 < along < 0.01 * abs(closing)


def test_journal_film_presses_where_it_is_taken_to():
    for wedge in (1000.0, -1000.0):
        motion = _motion(0.6, 0.0, wedge)
        behind = [motion.angle - np.sign(wedge) * share * pi for share in (0.1, 0.5, 0.9)]
        assert all(journal.pressure(FILM, motion, angle, 0.0) > 0.0 for angle in behind)
        radial, tangential = journal.force_by_quadrature(FILM, motion)
        # back to the middle, and forward with the wedge
        assert radial < 0.0
        assert np.sign(tangential) == np.sign(wedge)


def test_journal_mirror():
    motion = _motion(0.5, 80.0, 900.0)
    turned = {n: -getattr(motion, n) for n in ("angle", "angle_rate", "journal_speed", "sleeve_speed")}
    mirrored = replace(motion, **turned)
    radial, tangential = journal.force_by_quadrature(FILM, motion)
    assert journal.force_by_quadrature(FILM, mirrored) == pytest.approx((radial, -tangential), rel=1e-9)


def test_short_bearing_pressure_solves_the_full_reynolds_equation():
    """Finite differences in both directions on a slender land, where flow around it hardly matters."""
    film = journal.Film(viscosity=6e-3, radius=10e-3, length=0.4e-3, clearance=40e-6)
    motion = journal.Motion(16e-6, 4e-3, 0.3, 500.0, 2000.0, 700.0)
    around, along = 180, 21
    theta, step_t = np.linspace(0.0, 2.0 * pi, around, endpoint=False), 2.0 * pi / around * film.radius
    axial, step_z = np.linspace(-0.5 * film.length, 0.5 * film.length, along + 2, retstep=True)
    e, phi = motion.eccentricity, motion.angle

    def thickness(angle, time):
        distance, place = e + motion.eccentricity_rate * time, phi + motion.angle_rate * time
        return film.clearance - distance * np.cos(angle - place)

    # both surfaces drag: their mean speed convects the gap, and the gap itself changes with time
    mean = 0.5 * (motion.journal_speed + motion.sleeve_speed)
    source = mean * (thickness(theta + 1e-5, 0) - thickness(theta - 1e-5, 0)) / 2e-5
    source += (thickness(theta, 1e-9) - thickness(theta, -1e-9)) / 2e-9
    matrix, right = lil_matrix((around * along, around * along)), np.repeat(source, along)
    for i in range(around):
        here = thickness(theta[i], 0) ** 3 / (12.0 * film.viscosity)
        for k in range(along):
            row = i * along + k
            for side in (-1, 1):
                half = thickness(theta[i] + side * pi / around, 0) ** 3 / (12.0 * film.viscosity) / step_t**2
                matrix[row, (i + side) % around * along + k] += half
                matrix[row, row] -= half + here / step_z**2
                if 0 <= k + side < along:
                    matrix[row, row + side] += here / step_z**2
    full = spsolve(matrix.tocsr(), right).reshape(around, along)
    short = np.array([[journal.pressure(film, motion, t, z) for z in axial[1:-1]] for t in theta])
    # what is left out is of the order (L/R)^2 = 0.16 % times a few
    assert np.max(np.abs(full - short)) < 0.01 * np.max(np.abs(short))
