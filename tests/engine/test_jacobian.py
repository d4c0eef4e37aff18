"""The Jacobian's blocks against differences of the right-hand side.

The oracle is central differences, extrapolated from two steps (Richardson), of one ball or body at a time.
Entries are compared in groups: one acceleration by all places, or by all rates, each times the motion that
belongs to it. An error counts against the largest of its group, for that is what the Newton system feels.
"""

from dataclasses import dataclass

import numpy as np
import pytest

from fmu_bearing.compiled import call
from fmu_bearing.engine.choices import TRACTION_LAWS
from fmu_bearing.engine.layout import STRIDE, C, F, J, P, Q, S, U, W, Y
from fmu_bearing.engine.mechanics.conditions import conditions
from tests.engine.helpers import SUPPORTED, Run
from tests.engine.states import guided, shake

ANGLES = (3, 4, 8, 9, 10, 14, 15, 16)  # among the bodies' coordinates
# steps of the differences: their error goes with the fourth power, of 1e-3 of the contacts' approach and of
# the traction's scale; rounding of the right-hand side over them is 1e-7 of the largest entries
PLACE, ANGLE, VELOCITY, RATE = 1e-9, 1e-8, 1e-5, 1e-3
PITCH, BALL = 0.02, 0.003  # m: radii that make angles of bodies and spins of balls comparable to motions in m
SMOOTH = 2e-5
# Waviness is interpolated by cubics whose curvature jumps 2048 times per turn: where a step crosses a jump,
# the oracle itself is off. It holds to 1e-4 of the largest entries.
WAVY = 5e-4


@dataclass
class Point:
    """A state with all that its right-hand side depends on."""

    p: np.ndarray
    c: np.ndarray
    y: np.ndarray
    w: np.ndarray
    angle: float
    speed: float

    @property
    def balls(self):
        return int(self.p[P.BALLS])

    def accelerations(self, y):
        f = np.zeros(F.SIZE)
        call("right_hand_side", self.p, self.c, y, self.w, f, self.angle, self.speed, 0.0)
        return f

    def slope(self, places, h):
        """Change of the right-hand side by the motion of some places of y together."""

        def central(h):
            ahead, behind = self.y.copy(), self.y.copy()
            ahead[places] += h
            behind[places] -= h
            return (self.accelerations(ahead) - self.accelerations(behind)) / (2.0 * h)

        return (4.0 * central(0.5 * h) - central(h)) / 3.0

    def blocks(self):
        """Blocks B, C, D, E of the engine's Jacobian, without spare lanes."""
        jac = np.full(J.SIZE, np.nan)
        call("jacobian", self.p, self.c, self.y, self.w, jac, self.angle, self.speed, 0.0)
        return (
            jac[J.B : J.C].reshape(J.BALL, J.STATES, STRIDE)[..., : self.balls],
            jac[J.C : J.D].reshape(J.BALL, J.BODIES, STRIDE)[..., : self.balls],
            jac[J.D : J.E].reshape(Q.SIZE, J.STATES, STRIDE)[..., : self.balls],
            jac[J.E :].reshape(Q.SIZE, J.BODIES),
        )

    def differences(self):
        """Blocks by differences of the right-hand side."""
        n, lanes = self.balls, int(self.p[P.LANES])
        b, d = np.zeros((J.BALL, J.STATES, n)), np.zeros((Q.SIZE, J.STATES, n))
        c, e = np.zeros((J.BALL, J.BODIES, n)), np.zeros((Q.SIZE, J.BODIES))
        for k in range(J.STATES):
            h = ANGLE if k * STRIDE == Y.TH else (PLACE if k < J.PLACED else VELOCITY)
            h = RATE if k * STRIDE >= Y.OM else h
            for j in range(n):
                # the spare lanes copy ball 0
                moved = np.array([j, *range(n, lanes)] if j == 0 else [j]) + k * STRIDE
                found = self.slope(moved, h)
                b[:, k, j] = found[: F.BODY].reshape(J.BALL, STRIDE)[:, j]
                d[:, k, j] = found[F.BODY : F.WORK]
        for k in range(J.BODIES):
            angular = k % Q.SIZE in ANGLES
            h = (ANGLE if angular else PLACE) if k < Q.SIZE else (RATE if angular else VELOCITY)
            found = self.slope(np.array([Y.Q0 + k]), h)
            c[:, k] = found[: F.BODY].reshape(J.BALL, STRIDE)[:, :n]
            e[:, k] = found[F.BODY : F.WORK]
        return b, c, d, e


def worst(found, wanted):
    """Largest error of each block over the largest entry of its group; see the module's docstring."""
    ball = np.array([1.0, 1.0, PITCH, 1.0, 1.0, PITCH, BALL, BALL, BALL])
    bodies = np.ones(J.BODIES)
    bodies[[k + part for k in ANGLES for part in (0, Q.SIZE)]] = PITCH
    errors = []
    for block, right, unit in zip(found, wanted, (ball, bodies, ball, bodies), strict=True):
        assert np.isfinite(block).all()
        columns = (1, -1, 1) if block.ndim == 3 else (1, -1)
        placed = J.PLACED if unit is ball else Q.SIZE
        largest = 0.0
        for part in (slice(0, placed), slice(placed, None)):
            per = unit.reshape(columns)[:, part]
            size = np.abs(right[:, part] / per).max(axis=tuple(range(1, block.ndim)), keepdims=True)
            error = np.abs(block[:, part] - right[:, part]) / per
            largest = max(largest, (error / np.where(size == 0.0, 1.0, size)).max())
        errors.append(largest)
    return errors


def at_state(run):
    """The state in which a run is."""
    s = run.s
    return Point(
        run.p, s[S.C : S.C + C.SIZE].copy(), s[S.Y : S.Y + Y.SIZE].copy(), run.w, s[S.ANGLE], s[S.SPEED]
    )


def shaken(scene, rpm=20000, seed=1, tilt=1e-4, cage_offset=0.5, **parameters):
    """All displaced and sliding, one ball off its races, one pressed into its pocket."""
    run = Run(scene, rpm, **parameters).init()
    run.u[U.LOAD_Y], run.u[U.LOAD_Z], run.u[U.OIL_T] = 70.0, -40.0, 310.0
    c = np.zeros(C.SIZE)
    conditions(run.p, run.u, run.u[U.SPEED], c)
    y = run.s[S.Y : S.Y + Y.SIZE].copy()
    shake(y, run, np.random.default_rng(seed), tilt, cage_offset, 8e-6)
    rows = y[: J.STATES * STRIDE].reshape(J.STATES, STRIDE)
    rows[:, int(run.p[P.BALLS]) :] = rows[:, :1]
    return Point(run.p, c, y, run.w, 0.7, run.u[U.SPEED])


def agree(point, tolerance=SMOOTH, landed=None):
    """All blocks within ``tolerance``; ``landed``: of block E, where the film of the lands counts."""
    limits = np.array([tolerance, tolerance, tolerance, tolerance if landed is None else landed])
    errors = np.array(worst(point.blocks(), point.differences()))
    assert (errors <= limits).all(), errors


@pytest.mark.parametrize("name", ["7003C-spindle", "7009C-full-ceramic"])
@pytest.mark.parametrize("seed", range(3))
def test_far_from_equilibrium(scene, name, seed):
    """Lost contact, a ball in its pocket's wall, tilted bodies and slip, all at once."""
    agree(shaken(scene(name), seed=seed), WAVY)


@pytest.mark.parametrize("name", ["7003C-spindle", "7009C-full-ceramic"])
def test_far_from_equilibrium_without_waves(scene, name):
    """The mechanics alone is smooth, and so is its oracle."""
    agree(shaken(scene(name), WAVINESS=0.0))


@pytest.mark.parametrize(
    ("name", "rpm", "load"),
    [
        ("7003C-spindle", 20000, 0.0),
        ("7003C-bare", 10000, -300.0),
        ("7003C-bare", 10000, -1000.0),
        ("7009C-full-ceramic", 18000, 0.0),
        ("7009C-full-ceramic", 18000, -1000.0),
    ],
)
def test_running(scene, name, rpm, load):
    """Settled or loaded after 5 ms: the unloaded side loses contact at 1000 N."""
    run = Run(scene(name), rpm)
    run.u[U.LOAD_Z] = load
    run.init().run(5e-3, 1e-3)
    agree(at_state(run), WAVY)


@pytest.mark.parametrize("name", ["7003C-bare", "7009C-full-ceramic"])
def test_just_started(scene, name):
    """The film of a cage in the middle of its lands changes within 1e-10 m: its differences see 3e-3."""
    run = Run(scene(name), 10000).init()
    run.run(2e-4)
    agree(at_state(run), WAVY, landed=5e-3)


@pytest.mark.parametrize("law", TRACTION_LAWS)
def test_traction_laws(scene, law):
    agree(shaken(scene("7003C-spindle"), TRACTION_LAW=float(TRACTION_LAWS.index(law))), WAVY)


@pytest.mark.parametrize(
    "parameters",
    [
        {"CAGE": 0.0},
        {"LAND": 0.0},
        {"ROLLING": 0.0},
        {"GYROSCOPIC": 0.0},
        {"DRAG": 0.0},
        {"GRAVITY": 0.0},
        {"RIGID": 1.0},
        {"CONTACT_DAMPING": 0.0},
        SUPPORTED,
    ],
    ids=lambda parameters: next(iter(parameters)),
)
def test_with_and_without(scene, parameters):
    agree(shaken(scene("7003C-spindle"), WAVINESS=0.0, **parameters))


@pytest.mark.parametrize(
    ("law", "hysteresis"),
    [("starved", False), ("flooded", False), ("houpert-1987-ehl", True), ("flooded", True)],
)
@pytest.mark.parametrize("preload", [500.0, 20.0])
def test_rolling_laws(scene, law, hysteresis, preload):
    """Heavy and light contacts: EHL and the change to rigid surfaces; hysteresis follows load and ellipse.

    Viscosity and loss are large, so that rolling counts beside traction and contact.
    """
    changes = {"lubricant.rolling_law": law, "fidelity.terms.rolling_hysteresis": hysteresis}
    changes |= {"lubricant.viscosity_Pa_s": 1.0, "fidelity.terms.rolling_reduction": False}
    changes |= {"lubricant.traction_max": 1e-3, "materials.inner_ring.hysteresis_loss": 1.0}
    agree(shaken(scene("7003C-spindle").replace(changes | {"mounting.preload_N": preload}), WAVINESS=0.0))


@pytest.mark.parametrize("law", ["regularised", "eyring"])
def test_traction_in_oil_that_friction_heats(scene, law):
    changes = {"fidelity.terms.thermal_traction": True, "lubricant.traction_law": law}
    materials = {
        f"materials.{body}": name for body, name in (("inner_ring", "GCr15"), ("outer_ring", "GCr15"))
    }
    one = scene("7003C-spindle").replace(changes | materials | {"materials.balls": "Si3N4"})
    agree(shaken(one, WAVINESS=0.0))


def test_lands_in_the_oil_of_a_jet(scene):
    one = scene("7003C-spindle").replace({"lubricant.supply": "jet", "lubricant.land_viscosity_Pa_s": None})
    point = shaken(one, WAVINESS=0.0)
    assert point.c[C.LAND_VISCOSITY] > 0.006
    agree(point)


def test_cage_on_its_dry_stop(scene):
    agree(shaken(scene("7003C-spindle"), cage_offset=1.02, WAVINESS=0.0))


@pytest.mark.parametrize(("guidance", "cage_offset"), [("outer", 0.5), ("outer", 1.02), ("balls", 0.5)])
def test_cage_guided_by_the_outer_ring_or_the_balls(scene, guidance, cage_offset):
    """In the film of the outer ring's lands and on the dry stop; in spherical pockets."""
    agree(shaken(guided(scene("7003C-spindle"), guidance), cage_offset=cage_offset, WAVINESS=0.0))


@pytest.mark.parametrize("eccentricity", [5e-6, 1e-3])
def test_heavy_spot_of_the_cage(scene, eccentricity):
    agree(shaken(scene("7003C-spindle"), WAVINESS=0.0, CAGE_ECCENTRICITY=eccentricity))


def test_orthotropic_pedestal(scene):
    """A pedestal a hundred times as stiff as the scene's, so that its entries count beside the contacts'."""
    one = scene("7003C-spindle")
    keys = {"pedestal_stiffness_ratio": 0.3, "pedestal_axis_angle_deg": 30.0, "pedestal_stiffness_N_m": 2e9}
    one = one.model_copy(update={"mounting": one.mounting.model_copy(update=keys)})
    agree(shaken(one, WAVINESS=0.0))


def test_standstill(scene):
    agree(shaken(scene("7003C-spindle"), rpm=0, WAVINESS=0.0), 1e-4)


def test_wavy_balls(scene):
    """What the balls' own slopes change with the place is left out."""
    bumps = np.array([0.0, 2e-8, 1e-8, 5e-9, 5e-9, 3e-9])
    agree(shaken(scene("7003C-spindle"), WAVINESS=0.0, ball_waves=bumps), WAVY)


def test_bent_rings(scene):
    """What the groove's shape changes with the place is left out."""
    agree(shaken(scene("7009C-full-ceramic"), bends=True), WAVY)


def test_spare_lanes_follow_the_first_ball(scene):
    """17 balls in 20 lanes: the others answer as ball 0 does, and put nothing on the bodies."""
    point = shaken(scene("7009C-full-ceramic"))
    jac = np.zeros(J.SIZE)
    call("jacobian", point.p, point.c, point.y, point.w, jac, point.angle, point.speed, 0.0)
    rows = jac[: J.D].reshape(-1, STRIDE)
    lanes = int(point.p[P.LANES])
    assert point.balls < lanes
    assert (rows[:, point.balls : lanes] == rows[:, :1]).all()
    assert not jac[J.D : J.E].reshape(-1, STRIDE)[:, point.balls : lanes].any()


def test_leaves_the_rows_of_its_state(scene):
    """Energy and losses are read from the rows afterwards; the right-hand side is at ``W.F0``."""
    point = shaken(scene("7003C-spindle"), TRACTION_LAW=float(TRACTION_LAWS.index("eyring")))
    wanted = point.accelerations(point.y)
    rows = point.w[: W.ROWS].copy()
    point.blocks()
    assert (point.w[: W.ROWS] == rows).all()
    assert (point.w[W.F0 : W.F0 + F.SIZE] == wanted).all()
