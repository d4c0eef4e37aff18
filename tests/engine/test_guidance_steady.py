"""Cages on the outer ring and on the balls in the long run: operating points, slip, torque."""

import numpy as np
import pytest

from fmu_bearing import new_scene, operating_point
from fmu_bearing.arrays import Arrays
from fmu_bearing.engine.layout import PT, C, P, Q, S, U, W, Y
from fmu_bearing.engine.steady.point import REST, WHIRL
from fmu_bearing.scene.read import read_scene_text, with_fidelity
from tests.engine.test_steady_point import balls, eigenvalues_at_rest, lost, scene_at, torque
from tests.marks import heavy_but


def guided(guidance, bearing, rpm, preload, load=0.0, **changes):
    changes |= {"bearing.cage.guidance": guidance}
    if guidance == "balls":
        changes["bearing.cage.land_clearance_mm"] = None
    return scene_at(bearing, rpm, preload, load).replace(changes)


def begun(scene, fidelity="full"):
    run = Arrays.of(with_fidelity(scene, model=fidelity))
    run.init()
    return run


def aside(run, state):
    """How far the cage is off the outer ring's middle in a state, over the clearance of the lands."""
    cage, ring = (state[Y.Q0 + k + Q.Y :][:2] for k in (Q.CAGE, Q.OUTER))
    return np.hypot(*(cage - ring)) / run.p[P.LAND_CLEARANCE]


@pytest.mark.parametrize(
    ("bearing", "rpm", "preload", "load", "kind"),
    [
        ("NSK-7008AC", 14000, 400, 0.0, WHIRL),
        ("NSK-7008AC", 14000, 400, -50.0, REST),
        ("NSK-7010C", 18000, 300, 0.0, WHIRL),
    ],
)
def test_a_cage_in_the_outer_ring_whirls_where_its_whirl_grows(bearing, rpm, preload, load, kind):
    """As on the inner ring, more slowly; runs stay where they start, and all fidelities have the torque."""
    scene = guided("outer", bearing, rpm, preload, load)
    run = begun(scene)
    assert run.s[S.SETTLED] == kind
    rest = run.w[W.PATTERN + PT.REST_STATE : W.PATTERN + PT.WHIRL_STATE].copy()
    values = eigenvalues_at_rest(run, rest) / run.u[U.SPEED]
    growth = values.real[(values.imag > 0.2) & (values.imag < 0.42)].max()
    assert (growth > 0.0) == (kind == WHIRL)
    start, before = torque(run), aside(run, run.s[S.Y :])
    assert lost(run, 0.03) == pytest.approx(start, rel=2e-3)
    # balls that pass move it by a few per cent
    assert aside(run, run.s[S.Y :]) == pytest.approx(before, rel=0.1)
    for fidelity in ("rings", "response"):
        assert torque(begun(scene, fidelity)) == pytest.approx(start, rel=1e-3)


def test_lands_on_either_ring_drive_or_brake_the_balls():
    """A cage on the balls leaves them alone; an inner land drives them, an outer one brakes them."""
    orbits = {}
    for guidance in ("inner", "balls", "outer"):
        run = begun(guided(guidance, "NSK-7010C", 18000, 300, -20.0))
        orbits[guidance] = balls(run, Y.OM).mean()
    assert orbits["inner"] > orbits["balls"] > orbits["outer"]


def test_torques_on_a_braked_cage_balance():
    """With even balls the pockets give Petroff's drag of both lands; the seat holds the shaft's."""
    terms = dict.fromkeys(("fidelity.terms.gravity", "fidelity.terms.pocket_friction"), False)
    scene = guided("outer", "NSK-7010C", 18000, 300, **terms)
    run = begun(scene)
    p, c = run.p, run.s[S.C : S.C + C.SIZE]
    even = run.w[W.PATTERN + PT.EVEN_STATE : W.PATTERN + PT.REST_STATE]
    w_cage = even[Y.V0 + Q.CAGE + Q.TURN]
    petroff = 2.0 * np.pi * c[C.LAND_VISCOSITY] * p[P.LAND_RADIUS] ** 3 * p[P.LAND_LENGTH]
    drag = 2.0 * petroff * w_cage / p[P.LAND_CLEARANCE]
    # balls lead in their pockets, and press
    radius = p[P.PITCH_RADIUS] + even[Y.R]
    lead, along = radius * np.sin(even[Y.TH]), even[Y.X] - even[Y.Q0 + Q.CAGE]
    apart = np.hypot(lead, along)
    push = p[P.POCKET_STIFFNESS] * (apart - p[P.POCKET_CLEARANCE]) ** 1.5
    assert lead > 0.0 and p[P.BALLS] * push * lead / apart * radius == pytest.approx(drag, rel=1e-3)
    # the outer ring's seat holds what the shaft puts in, but for the drag on the orbiting balls
    for fidelity in ("full", "rings"):
        one = begun(scene, fidelity)
        one.run(0.05, 1e-3)
        held = c[C.PEDESTAL_ROTATIONAL] * one.s[S.Y + Y.Q0 + Q.OUTER + Q.TURN]
        held += one.s[S.LOSS_DRAG] / balls(one, Y.OM).mean()
        assert held == pytest.approx(1e-3 * torque(one), rel=1e-2)


@pytest.mark.parametrize(
    ("bearing", "rpm", "preload"),
    [("NSK-7010C", 18000, 300), ("NSK-7008AC", 14000, 400), ("7003C", 20000, 50)],
)
@pytest.mark.parametrize("load", [0.0, -20.0])
def test_a_cage_on_the_balls_hangs_in_its_pockets(bearing, rpm, preload, load):
    """By its weight; no film moves it. Runs and the other fidelities have the torque of the start."""
    scene = guided("balls", bearing, rpm, preload, load)
    run = begun(scene)
    assert run.s[S.SETTLED] == REST
    start = torque(run)
    inner, outer, cage = (run.s[S.Y + Y.Q0 + k + Q.Z] for k in (Q.INNER, Q.OUTER, Q.CAGE))
    assert -1.1 < (cage - 0.5 * (inner + outer)) / run.p[P.POCKET_CLEARANCE] < -0.5
    assert lost(run, 0.03) == pytest.approx(start, rel=1e-3)
    for fidelity in ("rings", "response"):
        assert torque(begun(scene, fidelity)) == pytest.approx(start, rel=1e-3)


SLIP = """
name = "6203"
materials = {{ inner_ring = "GCr15", outer_ring = "GCr15", balls = "GCr15", cage = "bakelite" }}
lubricant = {{ catalogue = "spindle-oil", supply = "grease" }}
mounting = {{ preload_N = 0.0, pedestal_stiffness_N_m = 1e8, radial_load_z_N = -1000.0 }}
operation.speed_rpm = 1500.0

[bearing]
designation = "6203"
bore_mm = 17.0
outside_diameter_mm = 40.0
width_mm = 12.0
pitch_diameter_mm = 28.5
ball_diameter_mm = 6.747
ball_count = 8
contact_angle_deg = 10.0
inner_conformity = 0.52
outer_conformity = 0.53
inner_ring_outer_diameter_mm = 23.8
outer_ring_inner_diameter_mm = 33.2
contact_damping_us = 2.5
race_roughness_um = 0.03
ball_roughness_um = 0.01

[bearing.cage]
guidance = "{guidance}"
outside_diameter_mm = 31.0
bore_mm = 26.0
width_mm = 8.5
pocket_diameter_mm = {pocket}
pocket_damping_N_s_m = 0.02
pocket_friction = 0.05
{land}
"""


def slip(guidance, pocket, land=""):
    """Slip of the orbit of a 6203 with 10 um of clearance under 1 kN across, over ten turns of the shaft."""
    run = begun(read_scene_text(SLIP.format(guidance=guidance, pocket=pocket, land=land), "6203"))
    run.run(0.2, 1e-3)
    orbits = []
    for _ in range(800):
        run.run(5e-4, 5e-4)
        orbits.append(balls(run, Y.OM).mean())
    return 1.0 - np.mean(orbits) / (0.5 * (1.0 - 6.747 / 28.5) * run.u[U.SPEED])


def test_a_ribbon_cage_on_its_balls_leads_by_its_clearance_alone():
    """Within 0.5 % with 0.1 mm more pocket than ball; with lands on the inner ring it leads by more."""
    found = slip("balls", 6.847)
    assert abs(found) < 0.005
    assert slip("inner", 6.847, "land_clearance_mm = 0.2") < 2.0 * found < 0.0


@pytest.mark.parametrize(
    ("guidance", "heat", "of_cage"),
    heavy_but([("inner", 378, 104), ("outer", 368, 94), ("balls", 274, 0)], 0),
)
def test_heat_of_a_new_pair(guidance, heat, of_cage):
    """Watts per bearing, as docs/catalogue.md has them."""
    text = new_scene("pair", "NSK-7010C", arrangement="DB", speed_rpm=18e3, sound=False)
    changes = {"bearing.cage.guidance": guidance}
    if guidance == "balls":
        changes["bearing.cage.land_clearance_mm"] = None
    for one in operating_point(read_scene_text(text, "pair").replace(changes)).bearings:
        found = one.heat
        total = found.sliding + found.rolling + found.cage + found.drag
        assert (round(total), round(found.cage)) == (heat, of_cage)
