"""Outputs of the contacts: what the contacts carry, in every fidelity, with sizes, waves and damping."""

import math

import numpy as np
import pytest

from fmu_bearing.engine.constants import RPM
from fmu_bearing.engine.layout import F, P, S
from fmu_bearing.instance import Instance
from fmu_bearing.prepare.model import prepare
from fmu_bearing.results.balls import Reader
from tests.engine.helpers import quiet
from tests.oracles import B7003C
from tests.oracles.hertz import race_contact
from tests.oracles.kinematics import cage_ratio

FIDELITIES = ("full", "rings", "response")


def _run(scene, fidelity, scale, **flaws):
    flawed = scene.model_copy(update={"imperfections": scene.imperfections.model_copy(update=flaws)})
    run = Instance(prepare(flawed, fidelity=fidelity), tell=lambda _: None)
    run.set("imperfection.scale", scale)
    run.initialise()
    return run


@pytest.mark.parametrize("fidelity", FIDELITIES)
def test_sizes_without_scale_change_nothing(silent, fidelity):
    names = [f"contact.{race}.{what}" for race in ("inner", "outer") for what in ("load_max", "pressure_max")]
    plain, sized = (_run(silent, fidelity, 0.0, ball_diameter_spread_nm=spread) for spread in (0.0, 5000.0))
    for run in (plain, sized):
        run.step(1e-3)
    assert [sized.get(name) for name in names] == [plain.get(name) for name in names]


@pytest.mark.parametrize(
    ("fidelity", "scale", "spread"),
    [
        *((fidelity, *flaws) for fidelity in ("full", "rings") for flaws in ((1, 0), (5, 0), (1, 1000))),
        ("response", 1, 0),  # at scale 5 its lines, linear in the surfaces, are 120 N off
    ],
)
def test_loads_move_the_ring(silent, fidelity, scale, spread):
    """Along the axis the balls' loads are the preload less what the inner ring's acceleration takes."""
    run = _run(silent, fidelity, float(scale), ball_diameter_spread_nm=float(spread))
    reader, rest, loads = Reader(run), [], []
    for _ in range(200):
        run.step(5e-5)
        load = (reader.loads(run)[0] * np.sin(reader.angles(run)[0])).sum()
        taken = run.p[P.INNER_MASS] * run.s[S.F + F.BODY]
        loads.append(load)
        rest.append(run.get("preload") - load - taken)
    # loads vary by 75 to 410 N; friction across the tracks takes 1.3 N. Without surfaces in them loads would
    # leave all of the ring's acceleration over: as much as they vary by.
    assert np.std(loads) > 70.0
    assert np.std(rest) < (0.04 if fidelity == "response" else 0.02) * np.std(loads)
    assert abs(np.mean(rest)) < (4.0 if fidelity == "response" else 2.0)


@pytest.mark.parametrize("flaws", [{}, {"ball_form_nm": 500.0}, {"ball_diameter_spread_nm": 1000.0}])
def test_fidelities_agree(silent, flaws):
    """Largest load, mean and largest over 10 ms: `rings` has the balls of `full` without their inertia."""
    found = []
    for fidelity in ("full", "rings"):
        run = _run(silent, fidelity, 1.0, **flaws)
        values = []
        for _ in range(200):
            run.step(5e-5)
            values.append([run.get(f"contact.{race}.load_max") for race in ("inner", "outer")])
        found.append([np.mean(values, axis=0), np.max(values, axis=0)])
    assert found[1][0] == pytest.approx(found[0][0], rel=0.01)
    assert found[1][1] == pytest.approx(found[0][1], rel=0.03)


@pytest.fixture(scope="module", params=[100.0, 500.0])
def smooth(request, scene):
    """The bare bearing without surfaces, weight and cage under an axial load (N), at 20 degC."""
    given = {"mounting.preload_N": request.param, "bearing.cage": None, "materials.cage": None}
    bare = quiet(scene("7003C-bare")).replace(given | {"fidelity.terms.gravity": False})
    run = Instance(prepare(bare, fidelity="full"), tell=lambda _: None)
    run.initialise()
    return bare, run


@pytest.mark.parametrize("race", ["inner", "outer"])
def test_shoulder_margin_in_closed_form(smooth, race):
    """Angle of the shoulder less that of the contact and of half the ellipse, by an own Hertzian contact.

    The groove's arc of radius f D about its centre meets the shoulder at the ring's diameter; the ellipse
    lies on Hertz's profile of radius 2 f D/(2 f + 1). Equal but for digits of elliptic integrals.
    """
    scene, run = smooth
    b = scene.bearing
    inner = race == "inner"
    diameter, angle = 1e-3 * b.ball_diameter_mm, math.radians(b.contact_angle_deg)
    conformity = b.inner_conformity if inner else b.outer_conformity
    reach = (conformity - 0.5) * diameter * math.cos(angle)
    centre = 0.5e-3 * b.pitch_diameter_mm + (reach if inner else -reach)
    shoulder = 0.5e-3 * (b.inner_ring_outer_diameter_mm if inner else b.outer_ring_inner_diameter_mm)
    ends = math.acos(abs(centre - shoulder) / (conformity * diameter))
    load = run.get(f"contact.{race}.load_max")
    contact = race_contact(B7003C, race, load)
    half = math.asin(contact.semi_major * (2.0 * conformity + 1.0) / (2.0 * conformity * diameter))
    expected = ends - run.get(f"contact.{race}.angle_mean") - half
    assert run.get(f"contact.{race}.shoulder_margin") == pytest.approx(expected, abs=1e-6)
    assert 0.02 < half < 0.3 and 0.0 < expected  # rad


def test_film_over_roughness_in_closed_form(smooth):
    """Hamrock and Dowson (1977), minimum film of the thinner race; balls that roll without slip.

    To 0.5 %: that the balls go round with the speed of rolling at both angles.
    """
    scene, run = smooth
    b, oil = scene.bearing, scene.lubricant
    angles = (run.get(f"contact.{race}.angle_mean") for race in ("inner", "outer"))
    ratio = cage_ratio(b.ball_diameter_mm, b.pitch_diameter_mm, *angles)
    turning = scene.operation.speed_rpm * RPM
    films = {}
    for race, side in (("inner", -1.0), ("outer", 1.0)):
        angle = run.get(f"contact.{race}.angle_mean")
        load = run.get(f"contact.{race}.load_mean")
        contact = race_contact(B7003C, race, load)
        places = 0.5e-3 * (b.pitch_diameter_mm + side * b.ball_diameter_mm * math.cos(angle))
        rolling = places * turning * (ratio if side > 0.0 else 1.0 - ratio)
        free = b.ball_diameter_mm * math.cos(math.radians(b.contact_angle_deg)) / b.pitch_diameter_mm
        radius = 0.5e-3 * b.ball_diameter_mm * (1.0 + side * free)
        modulus = 2.0 * contact.modulus
        speed = oil.viscosity_Pa_s * rolling / (modulus * radius)
        material = 1e-9 * oil.pressure_viscosity_1_GPa * modulus
        force = load / (modulus * radius**2)
        shape = 1.0 - math.exp(-0.68 * contact.semi_major / contact.semi_minor)
        films[race] = 3.63 * radius * speed**0.68 * material**0.49 * force**-0.073 * shape
    roughness = 1e-6 * math.hypot(b.race_roughness_um, b.ball_roughness_um)
    assert films["inner"] < films["outer"]
    assert run.get("film.lambda_min") == pytest.approx(films["inner"] / roughness, rel=5e-3)
