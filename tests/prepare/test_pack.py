"""The parameter array: every option of a scene at its place, nothing stored that is left out."""

import math

import numpy as np
import pytest

from fmu_bearing.elastic.section import OUTER, ring_section
from fmu_bearing.engine.choices import GUIDANCES
from fmu_bearing.engine.layout import SP, STRIDE, P
from fmu_bearing.formulas.hertz import effective_modulus, point_contact
from fmu_bearing.prepare.bodies import cage
from fmu_bearing.prepare.contacts import inlet
from fmu_bearing.prepare.model import pack, prepare
from fmu_bearing.scene import SceneError, read_scene_text
from tests.conftest import GATES
from tests.oracles.friction import Inlet, leading_moment, shared_loss
from tests.oracles.hertz import point_contact as solved
from tests.spindle.sets import scene as spindle_scene

TEXT = (GATES / "7003C-bare.toml").read_text(encoding="utf-8")
NO_SOUND = np.empty(0)


def packed(*changes, text=TEXT):
    for old, new in changes:
        assert old in text, old
        text = text.replace(old, new, 1)
    return pack(read_scene_text(text), NO_SOUND)


def places(*names):
    return [getattr(P, name) for name in names]


@pytest.mark.parametrize(
    ("old", "new", "place", "before", "after"),
    [
        ('model = "full"', 'model = "rings"', "FIDELITY", 0, 1),
        ('model = "full"', 'model = "response"', "FIDELITY", 0, 2),
        ('method = "esdirk4"', 'method = "trbdf2"', "METHOD", 0, 2),
        ('method = "esdirk4"', 'method = "rk4"', "METHOD", 0, 3),
        ('race_control = "shared"', 'race_control = "outer"', "RACE_CONTROL", 0, 1),
        ('race_control = "shared"', 'race_control = "inner"', "RACE_CONTROL", 0, 2),
        ('traction_law = "regularised"', 'traction_law = "eyring"', "TRACTION_LAW", 0, 1),
        ('traction_law = "regularised"', 'traction_law = "paper"', "TRACTION_LAW", 0, 2),
        ('viscosity_law = "vogel"', 'viscosity_law = "walther"', "VISCOSITY_LAW", 0, 1),
        ("walther_slope = 5.53", "walther_slope = 3.5", "WALTHER_SLOPE", 5.53, 3.5),
        ("eyring_stress_MPa = 5.0", "eyring_stress_MPa = 7.0", "EYRING_STRESS", 5e6, 7e6),
        ("_1_GPa = 20.0", "_1_GPa = 10.0", "PRESSURE_VISCOSITY", 2e-8, 1e-8),
        ('preload_mode = "force"', 'preload_mode = "rigid"', "RIGID", 0, 1),
        ("misalignment_y_mrad = 0.0", "misalignment_y_mrad = 0.5", "MISALIGNMENT_Y", 0, 5e-4),
        ("misalignment_z_mrad = 0.0", "misalignment_z_mrad = -0.5", "MISALIGNMENT_Z", 0, -5e-4),
        ("rolling_reduction = true", "rolling_reduction = false", "REDUCTION", 1, 0),
        ('rolling_law = "houpert-1987-ehl"', 'rolling_law = "starved"', "ROLLING_LAW", 0, 1),
        ('supply = "oil-air"', 'supply = "bath"', None, 0, 0),
        ("replenishment_constant = 6e-8", "", None, 0, 0),
        ("replenishment_held = false", "replenishment_held = true", "STARVATION_HELD", 0, 1),
        ("mass_eccentricity_um = 0.0", "mass_eccentricity_um = 5.0", "CAGE_ECCENTRICITY", 0, 5e-6),
        ("contact_damping = true", "contact_damping = false", "CONTACT_DAMPING", 5e-7, 0),
        ("pocket_friction = true", "pocket_friction = false", "POCKET_FRICTION", 0.05, 0),
    ],
)
def test_an_option_changes_its_place_and_no_other(old, new, place, before, after):
    plain, other = packed(), packed((old, new))
    if place is None:  # what is given beside it wins, or it is the default
        assert (plain == other).all()
        return
    assert plain[getattr(P, place)] == pytest.approx(before)
    assert other[getattr(P, place)] == pytest.approx(after)
    differ = set(np.flatnonzero(plain != other))
    if place == "PRESSURE_VISCOSITY":  # films and rolling resistance follow from it
        differ = {i for i in differ if i < P.RACES}
    assert differ == {getattr(P, place)}


def test_springs_instead_of_a_cage():
    start, end = TEXT.index("[bearing.cage]"), TEXT.index("[materials.inner_ring]")
    springs = "[bearing.ball_springs]\nstiffness_N_m = 5e6\ndamping_N_s_m = 2\n\n"
    p = packed(text=TEXT[:start] + springs + TEXT[end:])
    assert list(p[places("SPRINGS", "SPRING_DAMPING", "CAGE", "CAGE_MASS")]) == [5e6, 2.0, 0.0, 0.0]
    assert list(packed()[places("SPRINGS", "SPRING_DAMPING", "CAGE")]) == [0.0, 0.0, 1.0]


def test_ball_waves_stand_in_their_table():
    plain = packed()
    p = packed(
        ("ball_waviness_nm = 0.0", "ball_waviness_nm = 20.0"),
        ("ball_waviness_order = 2", "ball_waviness_order = 3"),
    )
    assert p[P.BALL_WAVES] == 3
    assert p.size == plain.size + 4 * P.FORM_ROW + 3 * STRIDE
    rows = p[int(p[P.AT_FORM]) :][: 4 * P.FORM_ROW].reshape(4, P.FORM_ROW)
    # P_3 = 5/2 Q_3 with derivative P_0 + 5 P_2; P_2 = 3/2 Q_2
    assert list(rows[:, P.FORM_HEIGHT]) == [0.0, 0.0, 0.0, pytest.approx(2.5 * 20e-9)]
    assert list(rows[:, P.FORM_RISE]) == [pytest.approx(20e-9), 0.0, pytest.approx(7.5 * 20e-9), 0.0]
    assert list(rows[1:, P.FORM_BACK]) == [pytest.approx(n * n / (4 * n * n - 1)) for n in (1, 2, 3)]
    axes = p[int(p[P.AT_AXES]) :][: 3 * STRIDE].reshape(3, STRIDE)
    np.testing.assert_allclose(np.linalg.norm(axes, axis=0), 1.0, rtol=1e-15)
    assert np.array_equal(
        axes[:, 12:], np.repeat(axes[:, :1], STRIDE - 12, axis=1)
    )  # spare lanes copy ball 0
    # the other tables have kept their numbers
    for place, size in (("AT_OVERSIZE", STRIDE), ("AT_WAVES", 4 * int(p[P.WAVE_INTERVALS]))):
        old, new = (int(q[getattr(P, place)]) for q in (plain, p))
        assert np.array_equal(plain[old : old + size], p[new : new + size])


def test_what_is_left_out_takes_no_place(scene):
    bare = scene("7003C-bare")
    perfect = pack(bare.model_copy(update={"imperfections": None}), NO_SOUND)
    # five strips' nodes and weights, the balls' sizes; behind them the block of a set of one
    assert perfect[P.SET] == P.TABLES + 2 * 5 + STRIDE
    assert perfect.size == perfect[P.SET] + SP.HEAD + SP.ROW
    assert not perfect[
        places("AT_WAVES", "AT_ORDERS", "AT_FORM", "AT_AXES", "AT_SOUND", "BALL_WAVES", "WAVE_RATE")
    ].any()
    assert perfect[P.WAVINESS] == 0.0
    assert perfect[P.SOUND_SIZE] == 0.0


def test_pockets_take_their_part_of_the_cage():
    """7003C by hand: a ring of 23.4 to 27.6 mm and 9.1 mm, 12 holes of 4.6 mm through its wall of 2.1 mm.

    1531.0 less 12 times 34.90 mm3 of bakelite, 1400 kg/m3.
    """
    found = cage(read_scene_text(TEXT))
    mass = 1400.0 * (1531.0 - 12.0 * 34.90) * 1e-9  # 1.557 g
    assert found.mass == pytest.approx(mass, rel=1e-4)
    # a ring's moments of inertia over its mass, in mm2: (11.7^2 + 13.8^2) / 2; half of that and 9.1^2 / 12
    assert found.polar == pytest.approx(mass * 163.665e-6, rel=1e-4)
    assert found.transverse == pytest.approx(mass * (81.8325 + 6.9008) * 1e-6, rel=1e-4)
    p = packed()
    assert p[P.CAGE_MASS] == found.mass and p[P.CAGE_POLAR] == found.polar


def test_a_pedestal_carries_housing_and_outer_rings():
    """Solid cylinder of 2 kg, 100 by 160 mm; rings of 7800 kg/m3, 29.6 to 35 mm, 10 mm: 21.37 g each.

    The damping ratio of the pedestal counts all. A bearing on a pedestal of its own is refused beside it.
    """
    changes = {
        "spindle.bearing[2].seat": "sliding",
        "spindle.preload": {"kind": "spring", "force_N": 500.0, "stiffness_N_m": 1e6},
        "spindle.housing": {
            "mass_kg": 2.0, "diameter_mm": 100.0, "length_mm": 160.0, "pedestal_stiffness_N_m": 1e8,
        },
    }  # fmt: skip
    given = spindle_scene("+-", (40.0, 70.0), None, changes=changes)
    p = pack(given, NO_SOUND)
    block = p[int(p[P.SET]) :]
    ring = 7800.0 * math.pi / 4.0 * (35.0**2 - 29.6**2) * 10.0 * 1e-9
    squares = (14.8**2 + 17.5**2) * 1e-6  # m2
    assert ring == pytest.approx(0.021369, rel=1e-4)
    assert block[SP.HOUSING_MASS] == pytest.approx(2.0 + 2.0 * ring, rel=1e-12)
    assert block[SP.HOUSING_POLAR] == pytest.approx(0.05**2 + ring * squares, rel=1e-12)
    turned = 2.0 * (0.05**2 / 4.0 + 0.16**2 / 12.0) + 2.0 * ring * (squares / 4.0 + 0.01**2 / 12.0)
    assert block[SP.HOUSING_TRANSVERSE] == pytest.approx(turned, rel=1e-12)
    with pytest.raises(SceneError, match="spindle.housing.mass_kg = 2.0 applies to a housing on a pedestal"):
        given.replace({"spindle.bearing[1].seat": "pedestal"})


def test_sound_comes_last(scene):
    p = prepare(scene("7003C-bare")).parameters
    assert p[P.SOUND_SIZE] > 0.0
    assert p[P.AT_SOUND] + p[P.SOUND_SIZE] == p[P.SET]


@pytest.mark.parametrize(("race", "side", "sign"), [(0, "inner_ring", 1.0), (1, "outer_ring", -1.0)])
def test_contact_ellipse_and_central_film(scene, race, side, sign):
    bare = scene("7003C-bare")
    b, ring, ball = bare.bearing, getattr(bare.materials, side), bare.materials.balls
    block = pack(bare, NO_SOUND)[P.RACES + race * P.RACE_SIZE :][: P.RACE_SIZE]
    # radii of the contact from the four principal radii of ball and groove (Harris 2001, eq. 2.28 ff)
    d, dm = b.ball_diameter_mm * 1e-3, b.pitch_diameter_mm * 1e-3
    gamma = d * math.cos(math.radians(15.0)) / dm
    race_radius = d / 2 * (1.0 - sign * gamma) / gamma
    groove = (b.inner_conformity if race == 0 else b.outer_conformity) * d
    rx, ry = 1.0 / (2.0 / d + sign / race_radius), 1.0 / (2.0 / d - 1.0 / groove)
    elastic = effective_modulus(
        ring.youngs_modulus_GPa * 1e9, ring.poisson_ratio, ball.youngs_modulus_GPa * 1e9, ball.poisson_ratio
    )
    hertz = point_contact(rx, ry, elastic)
    assert block[P.RACE_HALF_WIDTH] == pytest.approx(hertz.half_width, rel=1e-12)
    assert block[P.RACE_HALF_LENGTH] / block[P.RACE_HALF_WIDTH] == pytest.approx(hertz.ellipticity, rel=1e-12)
    # Hamrock and Dowson (1977) with its dimensionless groups, at 0.02 Pa s, 8 m/s, 100 N
    eta, u, load, alpha = 0.02, 8.0, 100.0, 20e-9
    speed, force = eta * u / (elastic * rx), load / (elastic * rx**2)
    shape = 1.0 - 0.61 * math.exp(-0.73 * hertz.ellipticity)
    central = 2.69 * rx * speed**0.67 * (alpha * elastic) ** 0.53 * force**-0.067 * shape
    assert block[P.RACE_CENTRAL_FILM] * (eta * u) ** 0.67 * load**-0.067 == pytest.approx(central, rel=1e-12)
    thinnest = block[P.RACE_FILM] * (eta * u) ** 0.68 * load**-0.073
    assert 1.0 < central / thinnest < 2.0  # the constriction at the outlet is thinner than the middle


def test_rolling_force_takes_the_ratio_of_the_radii(scene):
    # one contact worked by hand from the printed formula: inner race, D 7.938, d_m 54 mm, 15 deg, f 0.52,
    # steel of 208 GPa on steel. Its R_x 3.4054 mm and R_y/R_x 30.303 are stated to 5 digits
    rx, ry = 3.4054e-3, 30.303 * 3.4054e-3
    elastic = effective_modulus(208e9, 0.3, 208e9, 0.3)
    block = np.zeros(P.RACE_SIZE)
    oil = scene("7003C-bare").lubricant.model_copy(update={"pressure_viscosity_1_GPa": 20.0})
    inlet(block, point_contact(rx, ry, elastic), rx, ry, elastic, oil)
    eta, u, load = 0.01, 20.0, 100.0
    force = block[P.RACE_ROLLING] / (2.0 * rx) * (eta * u) ** 0.66 * load**0.47
    # Houpert (1987) with k = R_y/R_x; with the ellipticity it would be 0.0763 N. Five digits are given
    assert force == pytest.approx(0.11677, rel=1e-4)


@pytest.mark.parametrize("race", [0, 1])
def test_rolling_force_of_a_scene_takes_its_own_radii(scene, race):
    bare = scene("7003C-bare")
    b = bare.bearing
    block = pack(bare, NO_SOUND)[P.RACES + race * P.RACE_SIZE :][: P.RACE_SIZE]
    d = b.ball_diameter_mm
    gamma = d * math.cos(math.radians(b.contact_angle_deg)) / b.pitch_diameter_mm
    rx = 0.5e-3 * d * (1.0 - gamma if race == 0 else 1.0 + gamma)
    f = (b.inner_conformity, b.outer_conformity)[race]
    ry = 1e-3 * d * f / (2.0 * f - 1.0)
    ring = (bare.materials.inner_ring, bare.materials.outer_ring)[race]
    ball = bare.materials.balls
    elastic = effective_modulus(
        ring.youngs_modulus_GPa * 1e9, ring.poisson_ratio, ball.youngs_modulus_GPa * 1e9, ball.poisson_ratio
    )
    alpha = bare.lubricant.pressure_viscosity_1_GPa * 1e-9
    # Houpert (1987) with his groups at 0.02 Pa s, 8 m/s, 100 N; only rounding is left
    speed, load = 0.02 * 8.0 / (elastic * rx), 100.0 / (elastic * rx**2)
    force = (
        2.86 * elastic * rx**2 * (ry / rx) ** 0.348
        * (alpha * elastic) ** 0.022 * speed**0.66 * load**0.47
    )  # fmt: skip
    moment = block[P.RACE_ROLLING] * (0.02 * 8.0) ** 0.66 * 100.0**0.47
    assert moment == pytest.approx(2.0 * rx * force, rel=1e-12)


def rolling_contact(scene, race, load):
    """A ball of a scene on one of its races, solved by the oracle, and R_x (m)."""
    b, ball = scene.bearing, scene.materials.balls
    ring = (scene.materials.inner_ring, scene.materials.outer_ring)[race]
    d = 1e-3 * b.ball_diameter_mm
    gamma = b.ball_diameter_mm * math.cos(math.radians(b.contact_angle_deg)) / b.pitch_diameter_mm
    f = (b.inner_conformity, b.outer_conformity)[race]
    rx, ry = 0.5 * d * (1.0 - gamma if race == 0 else 1.0 + gamma), d * f / (2.0 * f - 1.0)
    yields = [(1.0 - one.poisson_ratio**2) / (1e9 * one.youngs_modulus_GPa) for one in (ring, ball)]
    return solved(load, 1.0 / rx, 1.0 / ry, 1.0 / sum(yields)), rx


@pytest.mark.parametrize(
    ("supply", "given", "viscosity"),
    [
        ("oil-air", None, 0.006),
        ("grease", None, 0.006),
        ("jet", None, None),
        ("bath", None, None),
        ("jet", 0.002, 0.002),
    ],
)
def test_oil_of_the_lands(scene, supply, given, viscosity):
    """The mist's assumed viscosity, the oil's own where it fills the gap, or what the scene gives."""
    bare = scene("7003C-bare")
    keys = {"lubricant.supply": supply, "lubricant.land_viscosity_Pa_s": given}
    p = pack(bare.replace(keys), NO_SOUND)
    b = bare.bearing
    gamma = b.ball_diameter_mm * math.cos(math.radians(b.contact_angle_deg)) / b.pitch_diameter_mm
    # the cage turns at half of 1 - gamma of the speed, the land at all of it
    slides = (1.0 - 0.5 * (1.0 - gamma)) * p[P.LAND_RADIUS]
    assert p[P.LAND_VISCOSITY] == (viscosity or 0.0)
    assert p[P.LAND_SLIDE] == pytest.approx(0.0 if viscosity else slides, rel=1e-12)
    off = pack(bare.replace(keys | {"fidelity.terms.land_film": False}), NO_SOUND)
    assert off[P.LAND_VISCOSITY] == off[P.LAND_SLIDE] == 0.0


@pytest.mark.parametrize(
    ("base", "given", "largest"),
    [
        ("mineral", None, 0.05),
        ("synthetic", None, 0.04),
        ("traction fluid", None, 0.1),
        ("synthetic", 0.03, 0.03),
    ],
)
def test_base_oil_limits_traction(scene, base, given, largest):
    keys = {"lubricant.base_oil": base, "lubricant.traction_max": given}
    assert pack(scene("7003C-bare").replace(keys), NO_SOUND)[P.MU] == largest


def test_thermal_traction_takes_what_bodies_conduct(scene):
    on = {
        "fidelity.terms.thermal_traction": True,
        "materials.inner_ring": "GCr15",
        "materials.balls": "Si3N4",
    }
    p = pack(scene("7003C-bare").replace(on | {"materials.outer_ring": "GCr15"}), NO_SOUND)
    both = math.sqrt(46.0 * 7800.0 * 460.0) + math.sqrt(25.0 * 3200.0 * 700.0)
    assert p[P.THERMAL_TRACTION] == 1.0 and p[P.OIL_CONDUCTIVITY] == 0.14
    assert p[P.RACES + P.RACE_EFFUSIVITY] == pytest.approx(both, rel=1e-12)
    bare = {
        "youngs_modulus_GPa": 208.0,
        "poisson_ratio": 0.3,
        "density_kg_m3": 7800.0,
        "expansion_1e6_K": 11.8,
    }
    with pytest.raises(SceneError, match=r"materials.outer_ring.conductivity_W_mK is missing, for example"):
        scene("7003C-bare").replace(on | {"materials.outer_ring": bare})


@pytest.mark.parametrize("race", [0, 1])
@pytest.mark.parametrize(
    ("supply", "law", "powers"),
    [
        ("oil-air", "starved", (0.66, 0.47, 0.636, 0.364)),
        ("grease", "starved", (0.66, 0.47, 0.636, 0.364)),
        ("jet", "flooded", (0.75, 1 / 3, 2 / 3, 1 / 3)),
        ("bath", "flooded", (0.75, 1 / 3, 2 / 3, 1 / 3)),
    ],
)
def test_supply_sets_the_rolling_forces(scene, race, supply, law, powers):
    bare = scene("7003C-bare")
    given = {"lubricant.supply": supply, "lubricant.rolling_law": None}
    p = pack(bare.replace(given | {"lubricant.replenishment_constant": None}), NO_SOUND)
    assert p[P.ROLLING_LAW] == {"starved": 1, "flooded": 2}[law]
    starved, constant = packed()[P.STARVATION], {"starved": 6e-8, "flooded": 3e-8}[law]
    assert p[P.STARVATION] == pytest.approx(starved * constant / 6e-8, rel=1e-12)
    block = p[P.RACES + race * P.RACE_SIZE :][: P.RACE_SIZE]
    eta, u, load = 0.02, 8.0, 100.0
    contact, rx = rolling_contact(bare, race, load)
    wanted = Inlet(contact, eta, u, 1e-9 * bare.lubricant.pressure_viscosity_1_GPa)
    s, w, rigid_s, rigid_w = powers
    elastic = block[P.RACE_ROLLING] * (eta * u) ** s * load**w / (2.0 * rx)
    rigid = block[P.RACE_RIGID] * (eta * u) ** rigid_s * load**rigid_w / (2.0 * rx)
    # both solve the contact exactly; only rounding is left
    assert elastic == pytest.approx(wanted.elastic_force(law), rel=1e-9)
    assert rigid == pytest.approx(wanted.rigid_force(law), rel=1e-9)
    regime = block[P.RACE_REGIME] * load * (eta * u) ** -0.75
    assert 6.6 * regime == pytest.approx(wanted.regime, rel=1e-9)


@pytest.mark.parametrize("race", [0, 1])
@pytest.mark.parametrize(
    ("ring_loss", "ball_loss"), [(None, None), (0.01, None), (None, 0.03), (0.005, 0.0), (0.0, 0.0)]
)
def test_hysteresis_takes_its_share_of_the_leading_moment(scene, race, ring_loss, ball_loss):
    bare = scene("7003C-bare")  # steel rings, Si3N4 balls
    side = ("inner_ring", "outer_ring")[race]
    changes = {f"materials.{side}.hysteresis_loss": ring_loss, "materials.balls.hysteresis_loss": ball_loss}
    on = bare.replace({"fidelity.terms.rolling_hysteresis": True} | changes)
    block = pack(on, NO_SOUND)[P.RACES + race * P.RACE_SIZE :][: P.RACE_SIZE]
    contact, _ = rolling_contact(bare, race, 100.0)
    ring, ball = getattr(bare.materials, side), bare.materials.balls
    share = shared_loss(
        (0.021 if ring_loss is None else ring_loss, ring.youngs_modulus_GPa, ring.poisson_ratio),
        (0.0 if ball_loss is None else ball_loss, ball.youngs_modulus_GPa, ball.poisson_ratio),
    )
    # the oracle integrates the pressure to 1e-7
    wanted = share * leading_moment(contact)
    assert block[P.RACE_HYSTERESIS] * 100.0 * contact.semi_major == pytest.approx(wanted, rel=1e-6, abs=1e-15)
    assert not pack(bare, NO_SOUND)[P.RACES + race * P.RACE_SIZE + P.RACE_HYSTERESIS]


# --- fidelities and overrides --------------------------------------------------------------------


def test_auto_must_be_resolved():
    auto = read_scene_text(TEXT.replace('model = "full"', 'model = "auto"')).model_copy(
        update={"sound": None}
    )
    for attempt in (lambda: prepare(auto), lambda: pack(auto, NO_SOUND)):
        with pytest.raises(
            SceneError, match=r"model = 'auto' must be resolved first, to one of full, rings, resp"
        ):
            attempt()
    model = prepare(auto, fidelity="rings")
    assert model.parameters[P.FIDELITY] == 1.0
    assert model.scene.fidelity.model == "rings"  # what is written into an FMU needs no resolving again


def test_overrides_of_fidelity_method_and_step(scene):
    bare = scene("7003C-bare").model_copy(update={"sound": None})
    plain = prepare(bare)
    assert plain.scene is bare
    other = prepare(bare, fidelity="response", method="rk4", max_step=5e-6)
    assert list(other.parameters[places("FIDELITY", "METHOD", "MAX_STEP")]) == [2.0, 3.0, 5e-6]
    same = np.delete(other.parameters, places("FIDELITY", "METHOD", "MAX_STEP"))
    assert np.array_equal(same, np.delete(plain.parameters, places("FIDELITY", "METHOD", "MAX_STEP")))
    assert bare.fidelity.model == "full"


@pytest.mark.parametrize(
    ("keys", "message"),
    [
        ({"fidelity": "ring"}, "fidelity.model = 'ring' is refused; allowed: full, rings, response, auto"),
        ({"method": "euler"}, "fidelity.method = 'euler' is refused; allowed: esdirk4"),
        ({"max_step": 1.0}, "max_internal_step_us = 1000000.0 is refused; allowed: 0.1 to 100 us"),
        ({"fidelity": "auto"}, "must be resolved first"),
    ],
)
def test_overrides_are_held_against_the_same_ranges(scene, keys, message):
    with pytest.raises(SceneError, match="7003C-bare: ") as caught:
        prepare(scene("7003C-bare"), **keys)
    assert message in str(caught.value)


GIVEN = "land_clearance_mm = 0.04 # assumed\n"


def test_lands_of_a_cage_from_the_shoulders_that_guide_it():
    """7003C: shoulders of 22.924 mm (docs/elastic.md) under a bore of 23.4 mm."""
    given, found = packed(), packed((GIVEN, ""))
    assert given[P.LAND_CLEARANCE] == pytest.approx(40e-6)
    assert found[P.LAND_CLEARANCE] == pytest.approx(0.5e-3 * (23.4 - 22.924), abs=1e-6)
    assert found[P.LAND_RADIUS] + found[P.LAND_CLEARANCE] == pytest.approx(11.7e-3, rel=1e-12)
    assert set(np.flatnonzero(given != found)) == set(places("LAND_CLEARANCE", "LAND_RADIUS"))


def test_lands_of_a_cage_on_the_outer_ring():
    """The journal is the cage, whose bore needs no clearance, and which alone shears the oil of a jet.

    It turns at (1 - gamma)/2 of the shaft's speed.
    """
    outer = ('guidance = "inner"', 'guidance = "outer"')
    wide_bore = ("bore_mm = 23.4", "bore_mm = 22.65")
    wide = ("outside_diameter_mm = 27.6", "outside_diameter_mm = 28.6")
    found = packed(outer, wide_bore, wide)
    assert found[P.GUIDANCE] == GUIDANCES.index("outer") and found[P.LAND] == 1.0
    assert list(found[places("LAND_RADIUS", "LAND_CLEARANCE")]) == pytest.approx([14.3e-3, 40e-6])
    # without a clearance: up to the outer ring's shoulders, which are outside of its effective diameter
    own = packed(outer, wide_bore, ("outside_diameter_mm = 27.6", "outside_diameter_mm = 29.2"), (GIVEN, ""))
    shoulder = ring_section(read_scene_text(TEXT), OUTER).low
    assert own[P.LAND_CLEARANCE] == pytest.approx(shoulder - 14.6e-3, rel=1e-9)
    jet = packed(
        outer, wide_bore, wide, ('supply = "oil-air"', 'supply = "jet"'), ("land_viscosity_Pa_s = 0.006", "")
    )
    gamma = 4.5 * math.cos(math.radians(15.0)) / 26.0
    assert jet[P.LAND_SLIDE] == pytest.approx(0.5 * (1.0 - gamma) * 14.3e-3)


def test_a_cage_on_the_balls_has_spheres_and_no_lands():
    """Ball and sphere conform both ways: stiffness goes with the root of 1/(2/D - 2/D_p)."""
    bores, found = packed(), packed(('guidance = "inner"', 'guidance = "balls"'), (GIVEN, ""))
    assert found[P.GUIDANCE] == GUIDANCES.index("balls") and found[P.LAND] == 0.0
    sphere = 1.0 / (2.0 / 4.5e-3 - 2.0 / 4.6e-3)
    modulus = bores[P.POCKET_STIFFNESS] / point_contact(2.25e-3, sphere, 1.0).stiffness
    assert found[P.POCKET_STIFFNESS] == pytest.approx(2.0 / 3.0 * modulus * math.sqrt(sphere), rel=1e-9)


@pytest.mark.parametrize(
    ("old", "new", "reported"),
    [
        ("bore_mm = 23.4", "bore_mm = 22.9", r"bore_mm = 22\.9 leaves -0\.012 mm .* shoulders of 22\.92 mm"),
        (
            "inner_ring_outer_diameter_mm = 22.6",
            "inner_ring_outer_diameter_mm = 20.5",
            r"groove fits no ring of the mass .* or give land_clearance_mm",
        ),
    ],
)
def test_diameters_that_leave_no_land_are_refused(old, new, reported):
    with pytest.raises(
        SceneError, match=r"7003C-bare: bearing\.cage\.land_clearance_mm is absent, .*" + reported
    ):
        packed((GIVEN, ""), (old, new))


def test_pedestal_axes():
    """Stiffness along y' three times that along z', turned by a quarter and by an eighth of a turn."""
    ratio = ("pedestal_stiffness_ratio = 1.0", "pedestal_stiffness_ratio = 3.0")
    names = "PEDESTAL_Y", "PEDESTAL_Z", "PEDESTAL_YZ"
    assert list(packed(ratio)[places(*names)]) == [3.0, 1.0, 0.0]
    for angle, wanted in ((90.0, [1.0, 3.0, 0.0]), (45.0, [2.0, 2.0, 1.0]), (-45.0, [2.0, 2.0, -1.0])):
        turned = ("pedestal_axis_angle_deg = 0.0", f"pedestal_axis_angle_deg = {angle}")
        p = packed(ratio, turned)
        assert list(p[places(*names)]) == pytest.approx(wanted, abs=1e-12)
        damping = p[places("PEDESTAL_DAMPING_Y", "PEDESTAL_DAMPING_Z", "PEDESTAL_DAMPING_YZ")]
        # as stiff as damped: the roots of 3 and 1 along the same axes
        root = np.sqrt(3.0)
        share = (np.array(wanted) - [1.0, 1.0, 0.0]) / 2.0 * (root - 1.0) + [1.0, 1.0, 0.0]
        assert list(damping) == pytest.approx(list(share), abs=1e-12)
