"""Eqs. 1 to 6 in plain NumPy: corrected they are the product's, printed they have their faults."""

import dataclasses
import math

import numpy as np
import pytest
from scipy.optimize import brentq

from examples.papers import printed_motion, printed_runs
from examples.papers.printed_equations import Corrections, Equations
from examples.papers.printed_forces import INNER, LAG, OM, OUTER, WX, Bearing, R, X, printed_pull
from examples.papers.printed_motion import ALONE, REPAIRED, apart, cells, main, page_of, results
from examples.papers.printed_runs import bearing_at, equations, growth, of_run, ours, run, settled, start
from fmu_bearing.engine.choices import TRACTION_LAWS
from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import STRIDE, C, P, Y
from tests.engine.states import case_of

PERFECT = {"WAVINESS": 0.0, "IMPERFECTION_SCALE": 0.0, "BALL_WAVES": 0.0}


def without(*names):
    return Corrections.all().changed(off=names)


@pytest.fixture(scope="module")
def found():
    """What the page shows, at one speed, with two corrections left out alone and runs of one turn."""
    return results((ALONE,), ("traction_law", "orbit_terms"), 1.0)


def shaken(scene, name, seed, law="regularised"):
    """A random state of a perfect bearing: the engine's case, its numbers, and the state (size,) here."""
    case = case_of(scene, name, seed=seed, TRACTION_LAW=TRACTION_LAWS.index(law), **PERFECT)
    rows = case.y[: Y.ROWS * STRIDE].reshape(Y.ROWS, STRIDE)[:, : case.n].copy()
    bodies = case.y[Y.Q0 :]
    rows[LAG] -= bodies[14] + 2.0 * np.pi / case.n * np.arange(case.n)
    rows[LAG] = (rows[LAG] + np.pi) % (2.0 * np.pi) - np.pi
    return case, Bearing(case.p, case.c), np.concatenate([rows.ravel(), bodies])


@pytest.mark.parametrize("name", ["7003C-bare", "7003C-spindle", "7009C-full-ceramic"])
@pytest.mark.parametrize(("law", "off"), [("regularised", ()), ("paper", ("traction_law",))])
def test_corrected_rates_are_the_engines(scene, name, law, off):
    """States with tilts, slip, a ball lifted, one in its pocket's wall: all rates, by either traction law."""
    case, bearing, state = shaken(scene, name, 3, law)
    system = Equations(bearing, case.speed, without(*off))
    wanted = case.engine()
    balls, _, rates = system.split(system(0.0, state)[:, None])
    for k in range(6):
        scale = np.abs(wanted.balls[:, k]).max()
        # 1e-6 m of displacement comes from radii of 1e-2 m: rounding gives 1e-12, powers and sums more
        assert balls[3 + k, :, 0] == pytest.approx(wanted.balls[:, k], rel=1e-9, abs=1e-9 * scale)
    ring = wanted.bodies[0, [0, 1, 2, 4, 5]]
    # the case has loads across, which the paper's scene has not
    ring[1] -= case.c[C.LOAD_Y] / case.p[P.INNER_MASS]
    ring[2] -= case.c[C.LOAD_Z] / case.p[P.INNER_MASS]
    bodies = np.concatenate([ring, wanted.bodies[1], wanted.bodies[2]])
    # the film of the lands ends in a series of differences: 1e-7 of the force
    assert rates[:, 0] == pytest.approx(bodies, rel=1e-6, abs=1e-9 * np.abs(bodies).max())


def test_several_states_at_once_are_each_as_alone():
    system = equations(ALONE, Corrections.none(), even=False)
    state = printed_runs.all_round(system, start(equations(ALONE, Corrections.none())))
    three = state[:, None] * np.array([1.0, 1.0 + 1e-6, 1.0 - 2e-6])
    together = system(0.0, three)
    for k in range(3):
        alone = system(0.0, three[:, k])
        assert together[:, k] == pytest.approx(alone, rel=1e-12, abs=1e-6)


@pytest.mark.parametrize("corrections", [Corrections.all(), Corrections.none()])
def test_one_ball_stands_for_twelve(corrections):
    """Without weights twelve equal balls do what one does, and hold rings and cage on the axis."""
    one, twelve = equations(ALONE, corrections), equations(ALONE, corrections, even=False)
    twelve.weight = 0.0
    state = start(one)
    state[WX + 1 : WX + 3] += 30.0, 5.0
    wanted = one(0.0, state)
    rates = twelve(0.0, printed_runs.all_round(twelve, state))
    for whole, part in zip(twelve.split(rates[:, None]), one.split(wanted[:, None]), strict=True):
        scale = np.abs(part).max()
        np.testing.assert_allclose(whole, np.broadcast_to(part, whole.shape), rtol=1e-9, atol=1e-9 * scale)


@pytest.mark.heavy
def test_corrected_motion_is_the_products(found):
    """Nothing in the equations comes from the engine: what is printed differs by its faults alone."""
    of_speed = found["speeds"][str(ALONE)]
    for a, b in zip(of_speed["corrected"]["load"], of_speed["ours"]["load"], strict=True):
        assert a == pytest.approx(b, rel=5e-4)
    load, angle, orbit = apart(found, "corrected", "ours")
    # the run is within e^-4.6 of the cage's first distance to its place, and the integration within 1e-5
    assert load < 0.05 and angle < 0.01 and orbit < 1e-4
    corrected, ours = of_speed["corrected"], of_speed["ours"]
    assert corrected["spin"] == pytest.approx(ours["spin"], rel=1e-4)
    assert corrected["pitch"] == pytest.approx(ours["pitch"], abs=0.02)
    assert corrected["slide_along"] == pytest.approx(ours["slide_along"], abs=5e-4)
    assert corrected["ring_velocity"] < 1e-4


@pytest.mark.heavy
@pytest.mark.parametrize("rpm", [10_000, 40_000])
def test_corrected_motion_is_the_products_at_other_speeds(rpm):
    corrected = of_run(equations(rpm, Corrections.all()), settled(rpm))
    other = {"speeds": {str(rpm): {"corrected": corrected, "ours": ours(rpm)}}}
    load, angle, orbit = apart(other, "corrected", "ours")
    assert load < 0.05 and angle < 0.01 and orbit < 1e-4


# faults in closed form


def one_ball(corrections, spin=(-4600.0, 2200.0, 300.0), orbit=880.0, radial_rate=0.0):
    """Rates of eq. 1 for a ball without force, and its equations."""
    system = equations(ALONE, corrections)
    balls, _, _ = system.split(start(system)[:, None])
    balls = balls.copy()
    balls[WX:, 0, 0], balls[OM], balls[4] = spin, orbit, radial_rate
    return system, lambda moment: system.ball_rows(
        balls, np.zeros((1, 1)), np.zeros((3, 1, 1)), np.array(moment)[:, None, None]
    )[:, 0, 0]


def test_inertia_twice_halves_the_acceleration():
    moment = np.array([1e-6, -2e-6, 3e-6])
    for corrections, share in ((Corrections.all(), 1.0), (without("single_inertia"), 0.5)):
        system, rows = one_ball(corrections, orbit=0.0)
        assert rows(moment)[3:] == pytest.approx(share * moment / system.bearing.ball_inertia, rel=1e-12)


def test_gyroscopic_pair_has_no_power_but_as_printed():
    spin, orbit = np.array([-4600.0, 2200.0, 300.0]), 880.0
    for corrections, wanted in ((Corrections.all(), 0.0), (without("gyroscopic_pair"), -2.0)):
        system, rows = one_ball(corrections, spin, orbit)
        inertia = system.bearing.ball_inertia
        power = inertia * spin @ rows(np.zeros(3))[3:]
        assert power == pytest.approx(wanted * inertia * orbit * spin[1] * spin[2], abs=1e-15)


@pytest.mark.parametrize(("rpm", "force"), [(20_000, 1.5), (40_000, 6.1)])
def test_centrifugal_force_is_missing(rpm, force):
    orbit = 0.42 * rpm * RPM
    rows = [one_ball(corrections, orbit=orbit)[1](np.zeros(3)) for corrections in
            (Corrections.all(), without("orbit_terms"))]  # fmt: skip
    missing = bearing_at(rpm).ball_mass * (rows[0][1] - rows[1][1])
    assert missing == pytest.approx(force, abs=0.06)


def test_coriolis_keeps_angular_momentum():
    """A ball that moves outwards without force keeps r^2 theta'; as printed it keeps theta'."""
    rate, orbit = 0.5, 880.0
    system, rows = one_ball(Corrections.all(), orbit=orbit, radial_rate=rate)
    radius = system.bearing.pitch_radius + start(system)[R]
    drag = system.bearing.drag_factor * (radius * orbit) ** 2 / system.bearing.ball_mass / radius
    turning = rows(np.zeros(3))[2] + drag
    assert turning == pytest.approx(-2.0 * rate * orbit / radius, rel=1e-9)
    _, printed = one_ball(without("orbit_terms"), orbit=orbit, radial_rate=rate)
    assert printed(np.zeros(3))[2] + drag == pytest.approx(0.0, abs=1e-6)


def test_pedestal_drives_a_free_ring_away():
    """Without contact x = x_0 cosh(t sqrt(K/m)); with the sign repaired it swings within x_0."""
    for corrections in (Corrections.none(), Corrections.none().changed(on=("pedestal_sign",))):
        system = equations(ALONE, corrections)
        state = start(system)
        _, places, _ = system.split(state[:, None])
        # the inner ring is drawn back and the balls lie inwards: nothing touches for 20 us
        state[X], state[R] = 0.0, -1e-6
        places[0], places[5] = -2e-5, 5e-6
        b, time = system.bearing, 2e-5
        rate = math.sqrt(b.pedestal_axial / b.outer_mass)
        last = system.split(run(system, state, time, 1e-8).state[:, None])[1][5, 0]
        wanted = math.cosh(rate * time) if not corrections.pedestal_sign else math.cos(rate * time)
        assert last == pytest.approx(5e-6 * wanted, abs=1e-8)


def tilting(corrections):
    """Moments about y on inner and outer ring when one ball at 12 o'clock carries 5 um of preload."""
    system = equations(ALONE, corrections, even=False)
    state = printed_runs.all_round(system, settled(ALONE).state)
    balls, places, _ = system.split(state[:, None])
    angle = system.angles(balls, places)
    places[14] -= angle[0, 0]
    balls[R, 1:], balls[X, 1:] = -1e-3, 0.0  # off the outer race
    seen, touching = system.contacts(state[:, None])
    only = np.arange(system.balls)[:, None] == 0
    touching = dataclasses.replace(
        touching, load=touching.load * only, along=touching.along * only, across=touching.across * only,
        rolling=touching.rolling * only, couples=tuple(one * only for one in touching.couples),
    )  # fmt: skip
    rings = system.on_rings(system.angles(balls, places), touching, seen.of(slice(2)))
    return rings[4, :, 0], touching, system


@pytest.mark.heavy
def test_third_law_of_tilt_moments():
    """A ball pushes both rings apart along the axis, so their moments are opposite; printed they are not."""
    (inner, outer), touching, system = tilting(Corrections.all())
    assert inner < 0.0 < outer
    # both are the moments of equal and opposite forces at one place: their sum turns the orbiting ball
    assert inner + outer == pytest.approx(0.0, abs=0.02 * outer)
    (printed, same), *_ = tilting(without("inner_tilt", "contact_radii"))
    assert printed > 0.0 and same > 0.0
    b = system.bearing
    push = -touching.force[0, OUTER, 0, 0]
    radius = b.pitch_radius + b.ball_radius * b.races.curvature[1, 0, 0] * touching.e[1, OUTER, 0, 0]
    assert same == pytest.approx(push * radius, rel=1e-9)


def test_a_ring_in_fixed_axes_nutates_at_the_ratio_of_its_inertias():
    b = bearing_at(ALONE)
    for corrections, shift in ((Corrections.all(), 0.0), (without("fixed_axes"), -1.0)):
        system = equations(ALONE, corrections)
        rates = np.array([[1.0], [0.0]])
        turning = system.tilting("inner", np.zeros((2, 1)), rates, system.speed)[:, 0]
        assert turning[0] == pytest.approx(0.0, abs=1e-12)
        assert turning[1] / system.speed == pytest.approx(
            b.inner_polar / b.inner_transverse + shift, rel=1e-12
        )


def test_cage_turns_the_way_it_is_pushed():
    for corrections, sign in ((Corrections.all(), 1.0), (without("cage_rotation"), -1.0)):
        system = equations(ALONE, corrections)
        state = start(system)
        balls, places, rates = system.split(state[:, None])
        balls[LAG] = 1.2 * system.bearing.pocket_clearance / system.bearing.pitch_radius  # ahead, in the wall
        turning = system(0.0, state)[9 + 17 + 14]
        assert sign * turning > 1e4


def test_lands_push_both_rings_or_one():
    whole, half = (
        printed_motion.land_force(equations(ALONE, corrections, even=False), 0.5)
        for corrections in (Corrections.all(), without("land_reaction"))
    )
    assert whole == pytest.approx(0.0, abs=1e-12) and half > 0.01


@pytest.mark.heavy
def test_printed_traction_is_a_shadow_of_the_load():
    """Sliding of 5 % of entrainment gives T/Q of some 1e-5: eta V S / h at ambient viscosity."""
    system = equations(ALONE, Corrections.all())
    _, touching = system.contacts(settled(ALONE).state[:, None])
    b = system.bearing
    root = (touching.load / b.races.stiffness) ** (1.0 / 3.0)
    pull = printed_pull(b, touching.entrainment, touching.load, root).sum(axis=0)
    ratio = 0.05 * np.abs(touching.entrainment) * pull / touching.load
    assert (ratio > 1e-5).all() and (ratio < 1e-4).all()
    # an independent figure: pi a b eta V / h of the whole ellipse; strips sum to it within their quadrature
    ellipse = math.pi * b.races.half_length * b.races.half_width * root**2
    film = b.races.central_film * (b.viscosity * np.abs(touching.entrainment)) ** 0.67 * touching.load**-0.067
    assert pull == pytest.approx(ellipse * b.viscosity / film, rel=0.03)


@pytest.mark.heavy
@pytest.mark.parametrize(
    ("name", "least", "most"),
    [
        ("pedestal_sign", 6.8e4, 9e4),  # sqrt(K/m) and more: tilts of the ring leave faster
        ("cage_rotation", 3e4, 9e4),
        ("inner_tilt", 2e4, 6e4),
        ("gyroscopic_pair", 0.0, 0.0),  # traction holds the ball
        ("single_inertia", 0.0, 0.0),
    ],
)
def test_what_grows_about_the_steady_state(name, least, most):
    rate, _ = growth(ALONE, without(name))
    assert least <= rate <= most


@pytest.mark.heavy
def test_nothing_grows_in_the_corrected_equations():
    assert growth(ALONE, Corrections.all()) == (0.0, 0.0)


# what the page shows


@pytest.mark.heavy
def test_as_printed_the_ring_is_gone_at_once(found):
    """It leaves no faster than with the preload behind it, no slower than with all that it takes along."""
    printed = found["speeds"][str(ALONE)]["printed"]
    assert printed["ended"] == "the outer ring has left by 1 mm"
    b = bearing_at(ALONE)
    rest = b.preload / b.pedestal_axial  # where it starts
    rate = math.sqrt(b.pedestal_axial / b.outer_mass)
    pushed = brentq(lambda t: 2.0 * rest * math.cosh(rate * t) - rest - 1e-3, 0.0, 1e-3)
    # past the play of the balls the other flanks of both grooves carry balls and inner ring along
    rate = math.sqrt(b.pedestal_axial / (b.outer_mass + b.inner_mass + b.balls * b.ball_mass))
    loaded = brentq(lambda t: rest * math.cosh(rate * t) - 1e-3, 0.0, 1e-3)
    assert pushed < printed["seconds"] < loaded


@pytest.mark.heavy
def test_printed_spin_grows_at_half_the_orbit_speed(found):
    """With traction too weak: w_r' = -theta' w_theta / 2 and back, so |w| grows as exp(theta' t / 2)."""
    system = equations(40_000, Corrections.none().changed(on=REPAIRED))
    first = run(system, start(system), 60.0 / 40_000)
    second = run(system, first.state, 30.0 / 40_000)
    sizes = [np.linalg.norm(system.split(one.state[:, None])[0][WX + 1 :]) for one in (first, second)]
    orbit = system.split(second.state[:, None])[0][OM, 0, 0]
    assert math.log(sizes[1] / sizes[0]) == pytest.approx(0.5 * orbit * 30.0 / 40_000, rel=0.05)
    running = found["speeds"][str(ALONE)]["running"]
    # sideways spin of thousands of rad/s slides across the track; ours slides by mm/s there
    assert running["ended"] == "" and min(running["slide_across"]) > 5.0
    assert max(found["speeds"][str(ALONE)]["ours"]["slide_across"]) < 0.01


@pytest.mark.heavy
def test_printed_loads_have_no_centrifugal_force(found):
    of_speed = found["speeds"][str(ALONE)]
    for key in ("running", "carried"):
        inner, outer = of_speed[key]["load"]
        assert inner == pytest.approx(outer, abs=0.2)  # N: rings still ring
    inner, outer = of_speed["ours"]["load"]
    # the radial balance of a ball: Q_o cos a_o - Q_i cos a_i
    angles = np.radians(of_speed["ours"]["angle"])
    assert outer * math.cos(angles[OUTER]) - inner * math.cos(angles[INNER]) == pytest.approx(1.54, abs=0.05)
    left_out = found["alone"]["orbit_terms"]
    assert left_out["load"][INNER] == pytest.approx(left_out["load"][OUTER], abs=0.05)


@pytest.mark.heavy
def test_page_shows_what_the_runs_gave(found):
    page = page_of(found)
    of_speed = found["speeds"][str(ALONE)]
    for key, title in printed_motion.READINGS.items():
        assert " | ".join(["| 20,000", title, *cells(of_speed[key])]) + " |" in page
    assert of_speed["printed"]["ended"] in page
    assert page.index("## Verdict\n\nAs printed no run lasts") > 0
    assert "| `orbit_terms` | 1 | 112." in page and "1.5 N missing" in page
    assert all(len(line) <= 110 for line in page.splitlines() if not line.startswith("|"))


def test_every_correction_has_its_equation():
    assert tuple(printed_motion.EQUATIONS) == Corrections.names()


@pytest.mark.parametrize(
    ("arguments", "words"),
    [
        (["--speed", "999"], "not within 1,000 to 60,000 r/min"),
        (["--speed", "60001"], "not within 1,000 to 60,000 r/min"),
        (["--speed", "nan"], "not within 1,000 to 60,000 r/min"),
        (["--correct", "gyroscope"], "no such correction: gyroscope; there are gyroscopic_pair"),
        (["--without", "orbit_terms", "spin"], "no such correction: spin"),
        (["--turns", "0"], "--turns 0: not above 0 and up to 100"),
        (["--correct", "orbit_terms", "--without", "orbit_terms"], "not allowed with"),
    ],
)
def test_command_refuses_what_it_does_not_know(arguments, words, capsys):
    with pytest.raises(SystemExit) as stop:
        main(arguments)
    assert stop.value.code == 2
    assert words in capsys.readouterr().err


@pytest.mark.heavy
def test_command_prints_one_reading(capsys):
    main(["--speed", str(ALONE), "--correct", "orbit_terms"])
    printed = capsys.readouterr().out
    assert "The run ended: the outer ring has left by 1 mm." in printed
    assert "Q_i, N" in printed
