"""Assemblies of rings and balls: a model of rigid bodies written by hand, closed forms, zero modes, gates.

The scene is that of the impact paper. 233 um is the patch of the gates: k_n = 6.31e7 N/m.
"""

import itertools
import math

import numpy as np
import pytest
from scipy.linalg import eigh

from examples.papers.assembly.basis import ring_basis, wall_limit
from examples.papers.assembly.conditions import BONDED, bodies, contact_modes
from examples.papers.assembly.patch import SPREAD, TANGENTIAL, normal_stiffness
from fmu_bearing.elastic.modes import elastic
from fmu_bearing.elastic.section import INNER, OUTER, ring_section
from fmu_bearing.engine.layout import F, P, W, Y
from fmu_bearing.engine.mechanics.springs import spring_forces
from fmu_bearing.prepare.model import pack
from fmu_bearing.scene import read_scene, si
from tests.conftest import GATES
from tests.elastic.rings import STEEL, THIN

# What only the papers' pages use.
pytestmark = pytest.mark.heavy

PATCH = 0.233e-3
SPRINGS = 2.5e7  # N/m between balls: the paper's final choice
CASES = list(itertools.product(BONDED, (True, False)))


@pytest.fixture(scope="module")
def paper():
    return read_scene(GATES / "7003C-impact.toml")


def cross(v):
    """Matrix of v x ."""
    return np.array([[0.0, -v[2], v[1]], [v[2], 0.0, -v[0]], [-v[1], v[0], 0.0]])


def rigid_ring(section, density):
    """Mass, centre (x), and moments of inertia about the axis and across it, by sums over the section."""
    x = np.linspace(*section.faces, 40_001)
    race = section.race(x)
    low, high = (race, section.high) if section.body == OUTER else (section.low, race)
    slices = 2.0 * np.pi * density * (high**2 - low**2) / 2.0
    polar = np.trapezoid(2.0 * np.pi * density * (high**4 - low**4) / 4.0, x)
    mass = np.trapezoid(slices, x)
    centre = np.trapezoid(slices * x, x) / mass
    return mass, centre, polar, polar / 2.0 + np.trapezoid(slices * (x - centre) ** 2, x)


def by_hand(scene, condition, held, between=0.0):
    """Frequencies (Hz) of rigid rings and balls: six coordinates of each body in fixed Cartesian axes."""
    b = si(scene.bearing)
    density = si(scene.materials.balls).density
    radius, balls = b.ball_diameter / 2.0, b.ball_count
    ball_mass = density * np.pi / 6.0 * b.ball_diameter**3
    k = 2.0 * PATCH / ((1 - 0.3**2) / 208e9 + (1 - 0.26**2) / 310e9)
    inertias, stiffness = [], np.zeros((6 * (2 + balls), 6 * (2 + balls)))
    for body in (INNER, OUTER):
        mass, _, polar, across = rigid_ring(ring_section(scene, body), 7800.0)
        inertias += [mass] * 3 + [polar, across, across]
    inertias += ([ball_mass] * 3 + [0.4 * ball_mass * radius**2] * 3) * balls
    for body, j in itertools.product((INNER, OUTER), range(balls)):
        section = ring_section(scene, body)
        theta = 2.0 * np.pi * j / balls
        axis = np.array([1.0, 0.0, 0.0])
        out, ahead = np.array([0.0, -math.sin(theta), math.cos(theta)]), None
        ahead = np.cross(axis, out)
        side = 1.0 if body == OUTER else -1.0
        normal = side * (math.sin(b.contact_angle) * axis + math.cos(b.contact_angle) * out)
        tangent = math.cos(b.contact_angle) * axis - math.sin(b.contact_angle) * out
        _, centre, _, _ = rigid_ring(section, 7800.0)
        offsets, springs = [(0.0, 0.0)], [(normal, k)]
        if BONDED[condition][body]:
            a = 2.0 / math.sqrt(3.0) * PATCH
            offsets = [(a, 0.0), (-a, 0.0), (0.0, a), (0.0, -a)]
            springs = [(normal, k), (tangent, 0.82 * k), (ahead, 0.82 * k)]
        groove = section.groove
        for aside, along in offsets:
            angle = groove.angle + aside / groove.radius
            x = groove.x + groove.radius * math.sin(angle)
            r = groove.r + side * groove.radius * math.cos(angle)
            out_there = math.cos(along / r) * out + math.sin(along / r) * ahead
            place = x * axis + r * out_there
            difference = np.zeros((3, len(stiffness)))
            for which, arm, sign in (
                (body, place - centre * axis, 1.0), (2 + j, place - b.pitch_diameter / 2.0 * out, -1.0)
            ):  # fmt: skip
                difference[:, 6 * which : 6 * which + 6] = sign * np.hstack((np.eye(3), -cross(arm)))
            for direction, strength in springs:
                row = direction @ difference
                stiffness += strength / len(offsets) * np.outer(row, row)
    for j in range(balls):
        first, second = j, (j + 1) % balls
        angles = 2.0 * np.pi * np.array([first, second]) / balls
        chord = np.array([0.0, np.sin(angles[0]) - np.sin(angles[1]), np.cos(angles[1]) - np.cos(angles[0])])
        row = np.zeros(len(stiffness))
        row[12 + 6 * first : 15 + 6 * first] = -chord / np.linalg.norm(chord)
        row[12 + 6 * second : 15 + 6 * second] = chord / np.linalg.norm(chord)
        stiffness += between * np.outer(row, row)
    free = np.r_[0:6, 12 : len(stiffness)] if held else np.arange(len(stiffness))
    root = np.sqrt(np.array(inertias)[free])
    values = eigh(stiffness[np.ix_(free, free)] / np.outer(root, root), eigvals_only=True)
    return np.sqrt(np.maximum(values, 0.0)) / (2.0 * np.pi)


@pytest.mark.parametrize("springs", [0.0, SPRINGS])
@pytest.mark.parametrize(("condition", "held"), CASES)
def test_rigid_rings_are_those_written_by_hand(paper, condition, held, springs):
    expected = by_hand(paper, condition, held, springs)
    found = contact_modes(paper, condition, PATCH, held=held, ball_springs=springs, highest=0.0)
    # curved elements follow the groove to third order: mass within 1e-5, points between nodes
    assert found.frequencies[found.zero_modes :] == pytest.approx(expected[found.zero_modes :], rel=2e-4)
    assert np.all(expected[: found.zero_modes] < 1.0)


@pytest.mark.parametrize("rigid", [True, False], ids=["rigid", "elastic"])
@pytest.mark.parametrize(("condition", "held"), CASES)
def test_motions_without_resistance(paper, condition, held, rigid):
    """C2, C3 and C4 turn as ball joints do, for all normals of a race meet on the axis."""
    modes = contact_modes(paper, condition, PATCH, held=held, highest=0.0 if rigid else None)
    wanted = {"C1": (0, 6), "C2": (3, 9), "C3": (3, 9), "C4": (63, 69)}[condition]
    assert modes.zero_modes == wanted[0 if held else 1]
    assert modes.frequencies[modes.zero_modes] > 1e3
    assert modes.energies.sum(axis=1) == pytest.approx(1.0, abs=1e-12)


def gate(modes, expected):
    """Check lines one by one: frequencies in kHz and how many modes each stands for."""
    found = np.sort(modes.frequencies[modes.frequencies > 0.0])[: sum(count for _, count in expected)]
    wanted = np.repeat([f for f, _ in expected], [count for _, count in expected])
    assert found / 1e3 == pytest.approx(wanted, rel=0.01)


def test_held_bearing_is_the_prototypes(paper):
    """Frequencies of an independent prototype; its ring modes end elsewhere, and point forces see that."""
    c1 = contact_modes(paper, "C1", PATCH)
    gate(c1, [(2.64, 2), (2.87, 1), (6.54, 1), (18.74, 2), (23.4, 2), (24.8, 12), (30.5, 2)])
    gate(contact_modes(paper, "C4", PATCH), [(6.31, 1), (18.89, 2), (23.6, 2), (30.6, 2), (52.4, 2)])
    lines = c1.lines(31e3)
    first = [next(iter(line.shares)) for line in lines]
    assert first[:5] == ["inner tilt", "inner spin", "inner axial", "inner radial", "inner flexure n = 2"]
    assert first[-1] == "inner flexure n = 2" and set(first[5:-1]) == {"balls turning"}
    assert all(bodies(line)["outer ring"] < 0.01 for line in lines)


def test_a_held_circumference_leaves_the_outer_ring_without_modes(paper):
    section, material = ring_section(paper, OUTER), elastic(paper.materials.outer_ring)
    held = ring_basis(section, material, held=True)
    assert held.frequency.min() > 266e3
    # the wall shears from its seat: a quarter of a wave over its height, less what its corners yield
    slow = math.sqrt(material.shear_modulus / material.density)
    assert held.frequency.min() == pytest.approx(slow / (4.0 * (section.high - section.low)), rel=0.05)
    assert not any(part.split()[1] in ("axial", "spin", "radial", "tilt") for part in held.parts)


def test_rigid_ball_joint_moves_along_the_axis_as_two_masses_do(paper):
    """C4, held, rigid: ring and balls on the springs of the normals alone."""
    b = si(paper.bearing)
    k = normal_stiffness(STEEL, elastic(paper.materials.balls), PATCH)
    mass, *_ = rigid_ring(ring_section(paper, INNER), 7800.0)
    ball = 3200.0 * np.pi / 6.0 * b.ball_diameter**3
    s = math.sin(b.contact_angle)
    values = eigh(12 * k * np.array([[s**2, s], [s, 2.0]]), np.diag([mass, 12 * ball]), eigvals_only=True)
    modes = contact_modes(paper, "C4", PATCH, highest=0.0)
    for value in np.sqrt(values) / (2.0 * np.pi):
        assert np.abs(modes.frequencies - value).min() < 1e-4 * value


def test_bonded_balls_turn_about_their_normals(paper):
    b = si(paper.bearing)
    k = normal_stiffness(STEEL, elastic(paper.materials.balls), PATCH)
    inertia = 0.4 * 3200.0 * np.pi / 6.0 * b.ball_diameter**3 * (b.ball_diameter / 2.0) ** 2
    alone = math.sqrt(2.0 * TANGENTIAL * k * (SPREAD * PATCH) ** 2 / inertia) / (2.0 * math.pi)
    assert alone == pytest.approx(24.8e3, rel=2e-3)
    found = [line for line in contact_modes(paper, "C1", PATCH).lines(26e3) if "balls turning" in line.shares]
    (most,) = [line for line in found if line.number >= 8]
    # points lie on a groove that is curved: they are nearer to the normal than on a plane, by (a/R)^2
    assert most.frequency == pytest.approx(alone, rel=5e-3)


@pytest.mark.parametrize("springs", [1e5, SPRINGS])
@pytest.mark.parametrize(("condition", "held"), CASES)
def test_springs_between_balls_resist_no_common_motion(paper, condition, held, springs):
    """A free bearing moves as a whole, and ball joints turn, as without springs; those tie each ball once.

    One of the balls' own motions is left of two in C4, for they slide across and along both races.
    """
    modes = contact_modes(paper, condition, PATCH, held=held, ball_springs=springs)
    wanted = {"C1": (0, 6), "C2": (3, 9), "C3": (3, 9), "C4": (63 - 12, 69 - 12)}[condition]
    assert modes.zero_modes == wanted[0 if held else 1]
    # softest of all: a tilt of the inner ring, 2.6 kHz; in C4 the softest wave of balls on 1e5 N/m
    assert modes.frequencies[modes.zero_modes] > (500.0 if condition == "C4" and springs < SPRINGS else 2e3)


def test_balls_alone_are_a_ring_of_masses(paper):
    """Closed form: (1/pi) sqrt(k/m) of the root of cos^2(pi/N) sin^2(pi j/N) + sin^2(pi/N) cos^2(pi j/N).

    j = 0 is the breathing ring; a ring of N masses on N springs has no other motion with resistance.
    """
    balls = 12
    ball = 3200.0 * np.pi / 6.0 * si(paper.bearing).ball_diameter ** 3
    wave, half = np.pi * np.arange(balls) / balls, np.pi / balls
    form = np.hypot(np.cos(half) * np.sin(wave), np.sin(half) * np.cos(wave))
    exact = np.sort(math.sqrt(SPRINGS / ball) / np.pi * form)
    loose = 1e-18  # m: a patch whose springs are nothing beside those between the balls
    modes = contact_modes(paper, "C4", loose, held=False, ball_springs=SPRINGS, highest=0.0)
    assert modes.frequencies[modes.zero_modes :] == pytest.approx(exact, rel=1e-9)  # rounding of 84 rows


def answers_of_a_run(paper):
    """Stiffness over mass (1/s^2) of the engine's springs, over radii and arcs of evenly standing balls."""
    balls, step = 12, 1e-8
    p, answer = pack(paper, np.empty(0)), np.zeros((2 * balls, 2 * balls))
    assert p[P.SPRINGS] == SPRINGS
    for one in range(2 * balls):
        kind, ball = divmod(one, balls)
        accelerations = []
        for move in (-step, step):
            y, w, f = np.zeros(Y.SIZE), np.zeros(W.SOUND), np.zeros(F.SIZE)
            y[Y.TH : Y.TH + balls] = 2.0 * np.pi * np.arange(balls) / balls
            y[(Y.TH if kind else Y.R) + ball] += move / (p[P.PITCH_RADIUS] if kind else 1.0)
            w[W.COS : W.COS + balls] = np.cos(y[Y.TH : Y.TH + balls])
            w[W.SIN : W.SIN + balls] = np.sin(y[Y.TH : Y.TH + balls])
            spring_forces(p, y, w, f)
            arcs = p[P.PITCH_RADIUS] * f[F.TH : F.TH + balls]
            accelerations.append(np.concatenate([f[F.R : F.R + balls], arcs]))
        answer[:, one] = (accelerations[0] - accelerations[1]) / (2.0 * step)
    return p, answer


def test_springs_of_a_run_along_the_balls_way(paper):
    """Closed form (1/pi) sqrt(k/m) cos(pi/N) sin(pi j/N), in the engine, where races hold the radii."""
    p, answer = answers_of_a_run(paper)
    balls = 12
    exact = math.sqrt(SPRINGS / p[P.BALL_MASS]) / math.pi * np.sin(math.pi * np.arange(1, 7) / balls)
    exact *= math.cos(math.pi / balls)
    found = np.sqrt(np.sort(np.linalg.eigvals(answer[balls:, balls:]).real)[1:]) / (2.0 * np.pi)
    # central differences of 1e-8 m on a chord of 6 mm
    assert found == pytest.approx(np.sort([*exact[:-1], *exact]), rel=1e-6)


def test_springs_of_a_run_pull_equally_and_leave_common_motions_free(paper):
    _, answer = answers_of_a_run(paper)
    angles = 2.0 * np.pi * np.arange(12) / 12
    zero, one = np.zeros(12), np.ones(12)
    common = {
        "turning": (zero, one),
        "growing": (one, zero),
        # from 12 o'clock, along Z and Y
        "along z": (np.cos(angles), -np.sin(angles)),
        "along y": (np.sin(angles), np.cos(angles)),
    }
    largest = np.abs(answer).max()
    for name, motion in common.items():
        moved = np.concatenate(motion)
        assert np.abs(answer @ moved).max() < 1e-7 * largest, name
        # and what each ball feels adds up to no force and no moment
        assert np.abs(moved @ answer).max() < 1e-7 * largest, name
    assert answer == pytest.approx(answer.T, abs=1e-7 * largest)


def test_more_ring_modes_lower_every_frequency(paper):
    """Rayleigh. A point force sees all: the axial mode falls by 1 to 2 % for each doubling."""
    limits = (150e3, 300e3, 600e3)
    steps = [contact_modes(paper, "C4", PATCH, highest=highest).lines(60e3) for highest in limits]
    for before, after in itertools.pairwise(steps):
        assert [line.number for line in before] == [line.number for line in after]
        assert all(a.frequency <= b.frequency for a, b in zip(after, before, strict=True))
    axial = [lines[0].frequency for lines in steps]
    assert 0.98 < axial[2] / axial[1] < 0.995 and 0.98 < axial[1] / axial[0] < 1.0


def test_rigid_columns_are_rigid(paper):
    """Displacement and turn about the centre of mass, at points off the contact and any azimuth."""
    section, material = ring_section(paper, INNER), elastic(paper.materials.inner_ring)
    basis = ring_basis(section, material)
    assert basis.parts[:6] == (
        "inner axial", "inner spin", "inner radial", "inner radial", "inner tilt", "inner tilt"
    )  # fmt: skip
    mass, centre, polar, across = rigid_ring(section, material.density)
    assert basis.mass[:6] == pytest.approx([mass, polar, mass, mass, across, across], rel=2e-5)
    for theta, aside, along in ((0.0, 0.0, 0.0), (1.1, 2e-4, -1e-4), (4.0, -3e-4, 3e-4)):
        place, motion = basis.at(aside, along, theta)
        axes = np.array([[1, 0, 0], [0, -math.sin(theta), math.cos(theta)]])
        axes = np.vstack((axes, np.cross(*axes)))
        arm = axes.T @ place - [centre, 0.0, 0.0]
        moved = axes.T @ motion[:, :6]
        down, left = np.array([0.0, 0.0, -1.0]), np.array([0.0, -1.0, 0.0])
        for column, expected in enumerate(
            [
                np.array([1.0, 0.0, 0.0]),
                np.cross([-1.0, 0.0, 0.0], arm),
                -down,
                left,
                np.cross(-left, arm),
                np.cross(-down, arm),
            ]
        ):
            assert moved[:, column] == pytest.approx(expected, abs=1e-8), column  # sums over 40,000 strips


def test_thin_ring_is_loves():
    n = 2
    speed = math.sqrt(STEEL.youngs_modulus / STEEL.density)
    love = speed * math.sqrt(1e-6 / 12.0) / 0.05**2 * n * (n**2 - 1) / math.sqrt(n**2 + 1) / (2.0 * math.pi)
    basis = ring_basis(THIN, STEEL, highest=300.0)
    pick = [k for k, part in enumerate(basis.parts) if part == "outer flexure n = 2"]
    assert len(pick) == 4  # in and out of its plane
    assert basis.frequency[pick[2:]] == pytest.approx(love, rel=2e-3)
    # half a shear wave across 1 mm
    assert wall_limit(THIN, STEEL) == pytest.approx(math.sqrt(80e9 / 7800.0) / 2e-3, rel=1e-12)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        ({"condition": "C5"}, "'C5' is unknown: give C1, C2, C3, C4"),
        ({"patch_radius": 0.0}, "patch radius 0.0 m"),
        ({"ball_springs": -1.0}, "ball_springs = -1.0 N/m"),
        ({"highest": 1e7}, "highest = 1e"),
        ({"highest": -1.0}, "highest = -1 Hz is refused"),
    ],
)
def test_refusals(paper, change, message):
    arguments = {"condition": "C1", "patch_radius": PATCH} | change
    with pytest.raises(ValueError, match=message):
        contact_modes(paper, **arguments)
