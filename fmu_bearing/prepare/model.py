"""The model: one scene as the flat parameter array of the engine, with the names of its variables."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.special import roots_jacobi

from fmu_bearing.acoustics.stream import sound_parameters
from fmu_bearing.engine import layout as at
from fmu_bearing.engine.sound import radiate
from fmu_bearing.interface import Variable, variables
from fmu_bearing.prepare import bodies
from fmu_bearing.prepare.hertz import PointContact, effective_modulus, point_contact
from fmu_bearing.prepare.imperfections import ball_oversizes, race_waves
from fmu_bearing.scene import Scene, SceneError, si
from fmu_bearing.scene.bearing import Cage
from fmu_bearing.scene.material import Material

# SKF friction model (SKF rolling bearings catalogue 2018, p. 65 ff): inlet shear heating, starvation
_SHEAR_HEATING = 1.84e-9
_ANGULAR_CONTACT_KZ = 4.4

# Assumed for the cage (see docs/theory): Hunt-Crossley factor, slip scales, dry stop of the lands.
_POCKET_DAMPING = 5.0  # s/m
_POCKET_SLIP = 0.05  # m/s
_STOP_STIFFNESS = 5e6  # N/m
_STOP_FRACTION = 0.96
_STOP_FRICTION = 0.05
_STOP_SLIP = 0.1  # m/s


@dataclass(frozen=True)
class Model:
    """What a run needs: numbers for the engine and the variables people see.

    Attributes
    ----------
    scene : Scene
    parameters : ndarray
        Flat parameter array ``p`` of the engine, read-only.
    variables : tuple of Variable
    """

    scene: Scene
    parameters: NDArray[np.float64]
    variables: tuple[Variable, ...]

    @property
    def n_balls(self) -> int:
        """Number of balls."""
        return int(self.parameters[at.P_BALLS])

    @property
    def n_mics(self) -> int:
        """Number of microphones."""
        return int(self.parameters[at.P_MICS])


def prepare(scene: Scene) -> Model:
    """Turn a scene into a model; ``SceneError`` where its sound cannot be computed."""
    try:
        sound = sound_parameters(scene)
    except ValueError as problem:
        raise SceneError(f"{scene.name}: {problem}") from None
    parameters = pack(scene, sound)
    parameters.setflags(write=False)
    rotating = bodies.inner_ring(scene) + bodies.rotor(scene)
    return Model(scene, parameters, variables(scene, rotor_inertia=rotating.polar))


def pack(scene: Scene, sound: NDArray[np.float64]) -> NDArray[np.float64]:
    """Parameter array ``p`` for a scene and its sound block (empty: no sound)."""
    strips = scene.fidelity.traction_strips
    nodes, weights = roots_jacobi(strips, 1.0, 1.0)
    lanes = 4 * math.ceil(scene.bearing.ball_count / 4)
    sizes = ball_oversizes(scene)
    oversize = np.full(at.STRIDE, sizes[0])
    oversize[: sizes.size] = sizes
    waves = race_waves(scene)
    parts = [nodes, weights / weights.sum(), oversize, waves, sound]
    starts = at.P_TABLES + np.cumsum([0] + [len(part) for part in parts])
    p = np.zeros(int(starts[-1]))
    for start, part in zip(starts, parts, strict=False):
        p[start : start + len(part)] = part
    p[at.P_BALLS] = scene.bearing.ball_count
    p[at.P_LANES] = lanes
    p[at.P_STRIPS] = strips
    p[at.P_AT_STRIPS] = starts[0]
    p[at.P_AT_OVERSIZE] = starts[2]
    p[at.P_AT_WAVES] = starts[3]
    p[at.P_WAVINESS] = float(waves.size > 0)
    p[at.P_AT_SOUND] = starts[4]
    p[at.P_SOUND_SIZE] = sound.size
    if sound.size:
        p[at.P_SOUND_STATE] = radiate.state_size(sound)
        p[at.P_SOUND_WORK] = radiate.work_size(sound)
        p[at.P_MICS] = len(scene.microphones)
    _fidelity(scene, p)
    _bearing(scene, p)
    _mounting(scene, p)
    if scene.bearing.cage is not None and scene.materials.cage is not None:
        _cage(scene, scene.bearing.cage, scene.materials.cage, p)
    return p


def _fidelity(scene: Scene, p: NDArray[np.float64]) -> None:
    fidelity = si(scene.fidelity)
    p[at.P_TOLERANCE] = fidelity.tolerance
    p[at.P_MAX_STEP] = fidelity.max_internal_step
    p[at.P_IMPERFECTION_SCALE] = 1.0
    if scene.sound is not None:
        sound = si(scene.sound)
        p[at.P_TIME_WEIGHTING] = 0.125 if scene.sound.time_weighting == "fast" else 1.0
        p[at.P_METERING_START] = sound.metering_start
    terms = scene.fidelity.terms
    p[at.P_GRAVITY] = terms.gravity
    p[at.P_DRAG] = terms.drag
    p[at.P_ROLLING] = terms.rolling_resistance
    p[at.P_LAND] = terms.land_film
    p[at.P_GYROSCOPIC] = terms.gyroscopic


def _bearing(scene: Scene, p: NDArray[np.float64]) -> None:
    b, oil = si(scene.bearing), si(scene.lubricant)
    d, dm, angle = b.ball_diameter, b.pitch_diameter, b.contact_angle
    p[at.P_PITCH_RADIUS] = dm / 2
    p[at.P_DIAMETER] = d
    p[at.P_BALL_MASS], p[at.P_BALL_INERTIA] = bodies.ball(scene)
    p[at.P_BALL_EXPANSION] = si(scene.materials.balls).expansion
    p[at.P_CONTACT_DAMPING] = b.contact_damping
    p[at.P_ROUGHNESS] = math.hypot(b.race_roughness, b.ball_roughness)
    p[at.P_MU] = oil.traction_max
    p[at.P_SLIDE_TO_ROLL] = oil.traction_slide_to_roll
    p[at.P_TRACTION_FLOOR] = oil.traction_floor
    p[at.P_VISCOSITY] = oil.viscosity
    p[at.P_VOGEL_B], p[at.P_VOGEL_C] = oil.vogel_B, oil.vogel_C
    p[at.P_OIL_DENSITY] = oil.density
    mean, bore, outside = 1e3 * dm, 1e3 * b.bore, 1e3 * b.outside_diameter
    p[at.P_SHEAR_HEATING] = _SHEAR_HEATING * mean**1.28
    p[at.P_STARVATION] = (
        oil.replenishment_constant
        * (bore + outside)
        * math.sqrt(_ANGULAR_CONTACT_KZ / (2.0 * (outside - bore)))
    )
    p[at.P_DRAG_FACTOR] = 0.5 * oil.oil_air_density * oil.drag_coefficient * math.pi * d**2 / 4
    gamma = d * math.cos(angle) / dm
    sides = (
        (-1.0, b.inner_conformity, scene.materials.inner_ring, gamma / (1.0 - gamma)),
        (1.0, b.outer_conformity, scene.materials.outer_ring, -gamma / (1.0 + gamma)),
    )
    for race, (side, conformity, material, curvature) in enumerate(sides):
        block = p[at.P_RACES + race * at.RACE_SIZE :][: at.RACE_SIZE]
        ring, ball = si(material), si(scene.materials.balls)
        modulus = effective_modulus(
            ring.youngs_modulus, ring.poisson_ratio, ball.youngs_modulus, ball.poisson_ratio
        )
        rx = d / 2.0 / (1.0 + curvature)
        ry = 1.0 / (2.0 / d - 1.0 / (conformity * d))
        _race(block, point_contact(rx, ry, modulus), rx, modulus, oil.pressure_viscosity)
        reach = (conformity - 0.5) * d
        block[at.RACE_PROFILE_RADIUS] = 2.0 * conformity * d / (2.0 * conformity + 1.0)
        block[at.RACE_GROOVE_X] = -side * reach * math.sin(angle)
        block[at.RACE_GROOVE_RADIUS] = dm / 2 - side * reach * math.cos(angle)
        block[at.RACE_GROOVE] = conformity * d
        block[at.RACE_EXPANSION] = ring.expansion


def _race(block: NDArray[np.float64], hertz: PointContact, rx: float, modulus: float, alpha: float) -> None:
    """Contact, rolling resistance (Houpert 1987) and film (Hamrock and Dowson 1977) of one race."""
    k = hertz.ellipticity
    material = alpha * modulus
    block[at.RACE_STIFFNESS] = hertz.stiffness
    block[at.RACE_HALF_LENGTH] = hertz.half_length
    block[at.RACE_PRESSURE] = hertz.pressure
    speed, load = modulus * rx, modulus * rx**2
    force = 2.86 * load * k**0.348 * material**0.022 * speed**-0.66 * load**-0.47
    # the moment pair that dissipates the inlet force on both surfaces at the entrainment speed
    block[at.RACE_ROLLING] = 2.0 * rx * force
    block[at.RACE_FILM] = (
        3.63 * rx * speed**-0.68 * material**0.49 * load**0.073 * (1.0 - math.exp(-0.68 * k))
    )


def _mounting(scene: Scene, p: NDArray[np.float64]) -> None:
    mounting = si(scene.mounting)
    inner = bodies.inner_ring(scene) + bodies.rotor(scene)
    outer = bodies.outer_ring(scene) + bodies.housing(scene)
    p[at.P_INNER_MASS], p[at.P_INNER_TRANSVERSE], p[at.P_INNER_POLAR] = (
        inner.mass,
        inner.transverse,
        inner.polar,
    )
    p[at.P_OUTER_MASS], p[at.P_OUTER_TRANSVERSE], p[at.P_OUTER_POLAR] = (
        outer.mass,
        outer.transverse,
        outer.polar,
    )
    p[at.P_AXIAL_RATIO] = mounting.pedestal_axial_ratio
    p[at.P_ROTATIONAL_RATIO] = mounting.pedestal_rotational_ratio
    p[at.P_PEDESTAL_ZETA] = mounting.pedestal_damping_ratio
    if scene.mounting.tilt_support is not None:
        support = si(scene.mounting.tilt_support)
        p[at.P_TILT_STIFFNESS] = support.stiffness
        p[at.P_TILT_DAMPING] = 2.0 * support.damping_ratio * math.sqrt(support.stiffness * inner.transverse)
    if scene.imperfections is not None:
        p[at.P_ECCENTRICITY] = si(scene.imperfections).unbalance


def _cage(scene: Scene, cage_table: Cage, material: Material, p: NDArray[np.float64]) -> None:
    b, c = si(scene.bearing), si(cage_table)
    body = bodies.cage(scene)
    p[at.P_CAGE] = 1.0
    p[at.P_CAGE_MASS], p[at.P_CAGE_TRANSVERSE], p[at.P_CAGE_POLAR] = body.mass, body.transverse, body.polar
    p[at.P_POCKET_CLEARANCE] = (c.pocket_diameter - b.ball_diameter) / 2
    ball, cage = si(scene.materials.balls), si(material)
    modulus = effective_modulus(
        cage.youngs_modulus, cage.poisson_ratio, ball.youngs_modulus, ball.poisson_ratio
    )
    # ball in a radial bore: closely conforming around the bore, a plain ball along it
    across = 1.0 / (2.0 / b.ball_diameter - 2.0 / c.pocket_diameter)
    p[at.P_POCKET_STIFFNESS] = point_contact(b.ball_diameter / 2, across, modulus).stiffness
    p[at.P_POCKET_DAMPING] = _POCKET_DAMPING
    p[at.P_POCKET_FRICTION] = c.pocket_friction
    p[at.P_POCKET_SLIP] = _POCKET_SLIP
    p[at.P_POCKET_FILM] = c.pocket_damping
    p[at.P_LAND_CLEARANCE] = c.land_clearance
    p[at.P_LAND_RADIUS] = c.bore / 2 - c.land_clearance
    p[at.P_LAND_LENGTH] = (c.width - c.pocket_diameter) / 2
    p[at.P_LAND_OFFSET] = (c.width + c.pocket_diameter) / 4
    p[at.P_LAND_VISCOSITY] = si(scene.lubricant).land_viscosity
    p[at.P_LAND_STOP_STIFFNESS] = _STOP_STIFFNESS
    p[at.P_LAND_STOP_FRACTION] = _STOP_FRACTION
    p[at.P_LAND_STOP_FRICTION] = _STOP_FRICTION
    p[at.P_LAND_STOP_SLIP] = _STOP_SLIP
